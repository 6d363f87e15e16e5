//! The derivation of a model whose mass matrix depends on the placement.

mod checks;
mod programs;

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr, Matrix, Polynomial};
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::conserved::{Candidate, candidates, still};
use crate::mechanics::describe::{self, Described, Notation, Scope, closed_form};
use crate::mechanics::equations::{Form, Load, System};
use crate::mechanics::forces::Forces;
use crate::mechanics::form::MixedForm;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::hessian::{self, Hessian};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::kinetics::Kinetics;
use crate::mechanics::loads::beside;
use crate::mechanics::metric::Definitions;
use crate::mechanics::mixed::{self, Factorisation, ForceNames, Internal, Masses, Mixed};
use crate::mechanics::potential::Potential;
use crate::mechanics::reduce::{self, ClosedForm, Commuting, Reduction};
use crate::mechanics::shared::CentreVelocity;
use crate::mechanics::term::Frame;
use crate::optimise::Batch;
use crate::symbol::Quantity;

use super::batch::batch;
use super::prepared::{coefficient_program, damping};
use super::programs::{Pieces, Reduced, shortest, shortest_reduction};
use super::ways::Ways;
use super::{Formulas, Model, VelocitySide, quantities};

/// The internal motion: of one frame, or of several.
enum Inner {
    /// Its mass matrix is constant; only the translation mixes frames.
    Constant(Box<Kinetic>, Box<Hamiltonian>),
    /// Its mass matrix depends on `phi`.
    Varying(Box<Internal>),
}

/// Derives a model; `None` only for energies that the checks refuse.
pub(super) fn derive(form: MixedForm, require_positive: bool) -> Option<Model> {
    let MixedForm { mut arena, mixed, hessian, positive, space_group, body_group, potential, forces, asked } =
        form;
    let arena = &mut arena;
    let inner = Inner::new(arena, &mixed, hessian.as_ref())?;
    let masses = Masses::of(&mixed);
    let momenta = [Momentum::of(inner.frame())];
    let written = potential.map(|u| Ways::new(arena, &u, mixed.dim, &momenta));
    let potential = written.as_ref().map(|ways| &ways.along_motions);
    let kinetics = inner.kinetics(arena);
    let body = Body { inner, kinetics, masses, potential, forces: &forces, mixed: &mixed };
    let mut coefficients = Constants::new(Quantity::Coefficient);
    let chart = body.chart(arena, true);
    let at_points = written.as_ref().map(|ways| &ways.at_points);
    let systems = body.systems_under(arena, &chart, at_points)?;
    // The plain array has no place for the work.
    let workless = |system: &System| System { work: None, ..system.clone() };
    let ways: Vec<Batch> =
        systems.iter().map(|system| batch(arena, &workless(system).tidied(arena))).collect();
    let time = body.time(arena);
    let full = shortest(arena, &chart, &ways, time, &mut coefficients);
    let (conserved, conserved_at_rest, rotations) = body.conserved(arena, &chart)?;
    let reductions = body.reductions(arena, rotations)?;
    let Reduced { reduction, equations: reduced, trajectory, fixed, .. } =
        shortest_reduction(arena, reductions, time, |_, _, _| Pieces::default(), &mut coefficients)?;
    let closed_form = body.closed_form(arena);
    let formulas = body.formulas(arena, &chart, &reduction, closed_form);
    let programs = body.programs(arena, &chart, &mut coefficients)?;
    let regularity = body.regularity(arena, positive, require_positive, &mut coefficients)?;
    let metric = match asked.metric {
        true => Some(quantities::metric(arena, &mixed.parts(), None, &mut coefficients)?),
        false => None,
    };
    let acceleration = asked
        .acceleration
        .then(|| quantities::acceleration(arena, &chart, &systems[0], time, &mut coefficients));
    let signature = body.signature(hessian.as_ref(), positive, require_positive);
    Some(Model {
        dim: mixed.dim,
        constraint: mixed.constraint,
        projected: mixed.constraint.is_some(),
        frame: body.inner.frame(),
        translation: body.translation(),
        conditions: body.conditions(arena, hessian.as_ref(), require_positive),
        numeric_blocks: body.numeric_blocks(arena, require_positive),
        coefficients: coefficient_program(arena, &coefficients),
        damping: damping(arena, &forces),
        velocity_side: Some(VelocitySide {
            legendre: programs.legendre,
            kinetic_energy: programs.kinetic_energy,
        }),
        velocity: programs.velocity,
        mass: programs.mass,
        mixed_masses: programs.mixed_masses,
        regularity,
        metric,
        acceleration,
        balance: None,
        hamiltonian: programs.hamiltonian,
        hamiltonian_far_away: programs.hamiltonian_far_away,
        domain: programs.domain,
        power: programs.power,
        full,
        reduced,
        reduction,
        trajectory,
        fixed,
        closed_form,
        isotropic: programs.isotropic,
        dilatation: None,
        conserved,
        conserved_at_rest,
        signature,
        has_forces: body.potential.is_some() || !forces.is_empty(),
        groups: (space_group, body_group),
        metrics: None,
        two_polar: None,
        formulas,
        taylor: None,
        tangent: None,
        splitting: None,
        second_order: None,
        packed: None,
    })
}

impl Inner {
    fn new(arena: &mut Arena, mixed: &Mixed, hessian: Option<&Hessian>) -> Option<Self> {
        match (mixed.internal.as_slice(), hessian) {
            ([one], Some(hessian)) => {
                let h = Hamiltonian::new(arena, one, hessian)?;
                Some(Self::Constant(Box::new(one.clone()), Box::new(h)))
            }
            _ => Some(Self::Varying(Box::new(Internal::new(arena, mixed)?))),
        }
    }

    fn frame(&self) -> Frame {
        match self {
            Self::Constant(kinetic, _) => kinetic.frame,
            Self::Varying(internal) => internal.frame(),
        }
    }

    /// Hamilton's equations of the internal motion, in each form that may be the shortest.
    fn kinetics(&self, arena: &mut Arena) -> Vec<(Kinetics, Form)> {
        match self {
            Self::Varying(internal) => {
                let ways = internal.kinetics(arena).into_iter();
                ways.map(|kinetics| (kinetics, Form::ThroughVelocity)).collect()
            }
            Self::Constant(_, h) => {
                let chart = Chart::new(arena, h.dim, Momentum::of(h.frame), None);
                let kinetics = Kinetics::polynomial(arena, &chart, &h.internal());
                let expanded = (!h.is_tensor()).then(|| (kinetics.clone(), Form::Expanded));
                [(kinetics, Form::ThroughVelocity)].into_iter().chain(expanded).collect()
            }
        }
    }

    /// The factorised mass matrix, where it depends on the placement.
    fn factorised(&self) -> Option<(&Factorisation, &Definitions)> {
        match self {
            Self::Constant(..) => None,
            Self::Varying(internal) => Some((&internal.factorisation, &internal.shared)),
        }
    }
}

/// What the equations are derived from.
struct Body<'a> {
    inner: Inner,
    /// The internal motion by its equations.
    kinetics: Vec<(Kinetics, Form)>,
    masses: Masses,
    potential: Option<&'a Potential>,
    forces: &'a Forces,
    mixed: &'a Mixed,
}

impl Body<'_> {
    /// The frame of the translational energy, of `x_dot` where there are two.
    fn translation(&self) -> Option<Frame> {
        match (self.masses.body, self.masses.space) {
            (None, None) => None,
            (Some(_), None) => Some(Frame::Body),
            (_, Some(_)) => Some(Frame::Space),
        }
    }

    /// The time as a symbol, where any force depends on it.
    fn time(&self, arena: &mut Arena) -> Option<Expr> {
        self.potential.and_then(Potential::time).or_else(|| self.forces.time(arena))
    }

    /// How the velocity of the centre of mass is known to forces.
    fn centre_velocity(&self, arena: &mut Arena) -> CentreVelocity {
        if self.masses.are_none() {
            return CentreVelocity::Fixed;
        }
        let mut symbols = |of: Quantity| arena.components(of, self.mixed.dim);
        let x_dot = symbols(Quantity::CentreVelocity);
        CentreVelocity::Defined {
            x_dot,
            v_hat: self.masses.body.map(|_| symbols(Quantity::ComovingCentreVelocity)),
        }
    }

    /// The velocity `(dH/dM)^T` of the chart under the name that forces know, where the energy has another.
    fn velocity_names(&self, arena: &mut Arena, chart: &Chart) -> Load {
        let Inner::Varying(internal) = &self.inner else { return Load::default() };
        let symbols = Matrix::symbols(arena, chart.momentum.velocity(), chart.dim).0.concat();
        let values = internal.velocity.0.concat();
        let renamed = symbols.into_iter().zip(values).filter(|(name, symbol)| name != symbol);
        let shared = renamed.map(|(name, symbol)| (name, Polynomial::atom(symbol))).collect();
        Load { shared, ..Load::default() }
    }

    /// What a potential and the forces add.
    fn pushes(&self, arena: &mut Arena, chart: &Chart, potential: Option<&Potential>) -> Vec<Load> {
        let centre = self.centre_velocity(arena);
        let mut list = Vec::new();
        if !self.forces.is_empty() {
            list.push(self.velocity_names(arena, chart));
        }
        // Last: where it has a root of det phi, 1/det phi comes from that.
        let mut loads = beside(arena, chart, &centre, potential, self.forces);
        if potential.is_some() {
            loads.rotate_left(1);
        }
        list.extend(loads);
        list
    }

    /// The chart of the internal motion with spatial `p`, or without translation.
    fn chart(&self, arena: &mut Arena, moving: bool) -> Chart {
        let linear = (moving && !self.masses.are_none()).then_some(Linear::Space);
        let chart = Chart::new(arena, self.mixed.dim, Momentum::of(self.inner.frame()), linear);
        chart.under(self.mixed.constraint)
    }

    /// What the motion of the centre of mass adds.
    fn of_the_centre(&self, arena: &mut Arena, chart: &Chart) -> Option<Load> {
        let load = self.masses.kinetics(arena, chart)?.load();
        Some(match chart.confined {
            Some(group) => load.confined(arena, chart, group),
            None => load,
        })
    }

    /// Hamilton's equations of a chart, in each form that may be the shortest.
    fn systems(&self, arena: &mut Arena, chart: &Chart) -> Option<Vec<System>> {
        self.systems_under(arena, chart, self.potential)
    }

    /// The same with another potential in place of its own.
    fn systems_under(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        potential: Option<&Potential>,
    ) -> Option<Vec<System>> {
        let mut loads = Vec::new();
        if chart.linear.is_some() {
            loads.push(self.of_the_centre(arena, chart)?);
        }
        loads.extend(self.pushes(arena, chart, potential));
        let joined = |mut system: System| {
            for load in &loads {
                // What two of them use has one name.
                system.shared.retain(|(symbol, _)| !load.shared.iter().any(|(s, _)| s == symbol));
                system.add(load);
            }
            system.tidied(arena)
        };
        let internal = self.kinetics.iter().map(|(kinetics, form)| kinetics.beside(chart).system(*form));
        Some(internal.map(joined).collect())
    }

    /// What is conserved, what is with `p = 0`, and whether rotations of space leave the motion and the forces unchanged.
    fn conserved(&self, arena: &mut Arena, chart: &Chart) -> Option<(Vec<Candidate>, Vec<Candidate>, bool)> {
        let resting = self.chart(arena, false);
        let internal = |chart: &Chart| Some(self.kinetics.first()?.0.beside(chart).load());
        let mut at_rest = still(arena, &resting, &[internal(&resting)?], candidates(&resting));
        let mut moving = at_rest.clone();
        let mut loads = vec![internal(chart)?];
        if chart.linear.is_some() {
            loads.push(self.masses.kinetics(arena, chart)?.load());
            moving = still(arena, chart, &loads, candidates(chart));
        }
        if let Some(u) = self.potential {
            moving.retain(|candidate| u.keeps(*candidate));
            at_rest.retain(|candidate| u.keeps(*candidate));
            // A force on the centre of mass does not leave it at rest.
            if u.moves_the_centre() {
                at_rest.clone_from(&moving);
            }
        }
        let rotations =
            moving.contains(&Candidate::TotalAngularMomentum) && self.forces.are_isotropic_in_space();
        if !self.forces.is_empty() {
            let centre = self.centre_velocity(arena);
            let named = |names: Load, loads: &[Load]| -> Definitions {
                loads.iter().chain([&names]).flat_map(|load| load.shared.clone()).collect()
            };
            let shared = named(self.velocity_names(arena, chart), &loads);
            moving = self.forces.keep(arena, chart, (&centre, &shared), moving);
            at_rest = match self.forces.push_from_rest() {
                true => moving.clone(),
                false => {
                    let shared = named(self.velocity_names(arena, &resting), &loads[..1]);
                    let fixed = (&CentreVelocity::Fixed, &shared);
                    self.forces.at_rest().keep(arena, &resting, fixed, at_rest)
                }
            };
        }
        Some((moving, at_rest, rotations))
    }

    /// `|p|^2/(2m)` commutes with what contains neither `x` nor `p`.
    fn drifts(&self) -> Option<Expr> {
        let free = self.masses.body.is_none()
            && self.potential.is_none_or(|u| !u.moves_the_centre())
            && self.forces.leave_the_centre();
        self.masses.space.filter(|_| free)
    }

    fn reductions(&self, arena: &mut Arena, rotations: bool) -> Option<Vec<Reduction>> {
        let drift = self.drifts();
        let chart = self.chart(arena, drift.is_none());
        let systems = self.systems(arena, &chart)?;
        let commuting = match drift {
            Some(mass) => {
                let reciprocal = arena.pow(mass, -1)?;
                vec![Commuting::Drift(Polynomial::normal_form(arena, reciprocal))]
            }
            None => Vec::new(),
        };
        let turn = rotations && chart.linear.is_some();
        let reduced = |system: System| reduce::reduced(arena, chart.clone(), commuting.clone(), turn, system);
        Some(systems.into_iter().map(reduced).collect())
    }

    /// Geodesics with `p = 0` are those of the internal motion.
    fn closed_form(&self, arena: &mut Arena) -> Option<(ClosedForm, bool)> {
        let Inner::Constant(_, h) = &self.inner else { return None };
        if self.potential.is_some() || !self.forces.is_empty() {
            return None;
        }
        let commuting = reduce::commuting(arena, h, None, &Forces::default());
        reduce::closed_form(h, &commuting).map(|(form, _)| (form, true))
    }

    fn formulas(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        reduction: &Reduction,
        closed: Option<(ClosedForm, bool)>,
    ) -> Formulas {
        let energies = self.mixed.parts();
        let blocks: &[hessian::NumericBlock] = match &self.inner {
            Inner::Constant(_, h) => &h.numeric_blocks,
            Inner::Varying(_) => &[],
        };
        let described =
            Described { energies: &energies, blocks, forces: self.forces, metrics: None, rebased: &[] };
        let notation = &Notation::new(arena, &described);
        let masses = &self.masses;
        let (internal, mut equations) = match &self.inner {
            Inner::Varying(internal) => {
                let names = ForceNames::of(chart, self.forces);
                let pulls = (masses, self.potential);
                let (hamiltonian, mut list) = match internal.group() {
                    None => (
                        mixed::internal_hamiltonian(),
                        mixed::internal_equations(
                            arena,
                            notation,
                            self.mixed,
                            masses,
                            self.potential,
                            &names,
                        ),
                    ),
                    Some(group) => (
                        mixed::confined_hamiltonian(),
                        mixed::confined_equations(arena, notation, self.mixed, group, pulls, &names),
                    ),
                };
                list.extend(mixed::centre_equations(arena, notation, masses, self.potential, &names));
                (hamiltonian, list)
            }
            Inner::Constant(kinetic, h) => {
                let system = describe::system(arena, notation, &reduction.system);
                let energy = (&**h, &**kinetic);
                let none = Forces::default();
                (describe::hamiltonian(arena, notation, energy, None, &none), system)
            }
        };
        let hamiltonian = mixed::hamiltonian(arena, notation, internal, masses, self.potential, self.forces);
        let reduced = equations.clone();
        if matches!(self.inner, Inner::Constant(..)) {
            equations = self
                .systems(arena, chart)
                .map_or_else(Vec::new, |s| describe::system(arena, notation, &s[0]));
        }
        equations.extend(self.forces.formulas(arena, notation));
        let mut left_out = Vec::new();
        if self.masses.are_none() {
            left_out.push(Scope::Model.without("x and p: the model has no translation"));
        }
        if !reduction.commuting.is_empty() {
            left_out
                .push(Scope::Reduction.without("x and p: the centre of mass moves freely, x = x0 + t p/m"));
        } else if reduction.turned {
            let turned = "p: conserved; space is turned so that only its first component is left";
            left_out.push(Scope::Reduction.without(turned));
        }
        left_out.extend(closed.map(|_| closed_form(true)));
        Formulas {
            kinetic_energy: mixed::energy(arena, notation, self.mixed),
            hamiltonian,
            equations,
            reduced,
            left_out,
        }
    }
}
