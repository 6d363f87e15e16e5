//! The derivation of a model whose mass matrix depends on the placement.

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::check::{MixedForm, Positive, eigenvalues};
use crate::ir::Program;
use crate::ir::fuse::fuse;
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::conserved::Candidate;
use crate::mechanics::describe;
use crate::mechanics::equations::{self, System, gradient, hamilton};
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::hessian::Hessian;
use crate::mechanics::kinetic::{Frame, Kinetic, TermKind};
use crate::mechanics::metric::{Definitions, inverse_placement};
use crate::mechanics::mixed::{self, Factorisation, Internal, Legendre, Masses, Mixed};
use crate::mechanics::potential::{Base, Potential};
use crate::mechanics::reduce::{self, ClosedForm, Commuting, Reduction};
use crate::optimise::{Batch, straight_line};

use super::prepared::{coefficient_program, conditions, leading_minors, numeric_blocks, summands, unbound};
use super::programs::{batch, shortest, shortest_reduction};
use super::{
    Condition, Formulas, MixedMasses, Model, NumericBlock, Regularity, legendre_batch, matrix_batch,
    quantities, result,
};

/// The internal motion: of one frame, or of several.
enum Inner {
    /// Its mass matrix is constant; only the translation mixes frames.
    Constant(Box<Kinetic>, Box<Hamiltonian>),
    /// Its mass matrix depends on `phi`.
    Varying(Box<Internal>),
}

/// Derives a model; `None` only for energies that the checks refuse.
pub(super) fn derive(form: MixedForm, require_positive: bool) -> Option<Model> {
    let MixedForm { mut arena, mixed, hessian, positive, space_group, body_group, potential, quantities } =
        form;
    let arena = &mut arena;
    let inner = Inner::new(arena, &mixed, hessian.as_ref())?;
    let body = Body { inner, masses: Masses::of(&mixed), potential: potential.as_ref(), mixed: &mixed };
    let mut coefficients = Constants::new("c");
    let chart = body.chart(arena, true);
    let systems = body.systems(arena, &chart)?;
    let ways: Vec<Batch> = systems.iter().map(|system| batch(arena, system)).collect();
    let full = shortest(arena, &chart, &ways, &mut coefficients);
    let (conserved, conserved_at_rest) = body.conserved(arena, &chart)?;
    let rotations = conserved.contains(&Candidate::TotalAngularMomentum);
    let reductions = body.reductions(arena, rotations)?;
    let (reduction, reduced, trajectory, fixed) = shortest_reduction(arena, reductions, &mut coefficients)?;
    let closed_form = body.closed_form(arena);
    let formulas = body.formulas(arena, &chart, &reduction, closed_form);
    let programs = body.programs(arena, &chart, &mut coefficients)?;
    let regularity = body.regularity(arena, positive, require_positive, &mut coefficients)?;
    let metric = match quantities.metric {
        true => Some(quantities::metric(arena, &mixed.parts(), None, &mut coefficients)?),
        false => None,
    };
    let acceleration = quantities
        .acceleration
        .then(|| quantities::acceleration(arena, &chart, &systems[0], &mut coefficients));
    let signature = body.signature(hessian.as_ref(), positive, require_positive);
    Some(Model {
        dim: mixed.dim,
        frame: body.inner.frame(),
        translation: body.translation(),
        conditions: body.conditions(arena, hessian.as_ref(), require_positive),
        numeric_blocks: body.numeric_blocks(arena, require_positive),
        coefficients: coefficient_program(arena, &coefficients),
        legendre: programs.legendre,
        velocity: programs.velocity,
        mass: programs.mass,
        mixed_masses: programs.mixed_masses,
        kinetic_energy: programs.kinetic_energy,
        regularity,
        metric,
        acceleration,
        hamiltonian: programs.hamiltonian,
        full,
        reduced,
        reduction,
        trajectory,
        fixed,
        closed_form,
        isotropic: programs.isotropic,
        conserved,
        conserved_at_rest,
        signature,
        has_potential: potential.is_some(),
        groups: (space_group, body_group),
        formulas,
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
            Self::Varying(_) => Frame::Flat,
        }
    }
}

/// The programs of one placement.
struct Programs {
    legendre: Program,
    velocity: Program,
    mass: Option<Program>,
    mixed_masses: Option<MixedMasses>,
    kinetic_energy: Program,
    hamiltonian: Program,
    isotropic: Option<Program>,
}

/// What the equations are derived from.
struct Body<'a> {
    inner: Inner,
    masses: Masses,
    potential: Option<&'a Potential>,
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

    /// The chart of the internal motion with spatial `p`, or without translation.
    fn chart(&self, arena: &mut Arena, moving: bool) -> Chart {
        let linear = (moving && !self.masses.are_none()).then_some(Linear::Space);
        Chart::new(arena, self.mixed.dim, Momentum::of(self.inner.frame()), linear)
    }

    /// Hamilton's equations of a chart, in each form that may be the shortest.
    fn systems(&self, arena: &mut Arena, chart: &Chart) -> Option<Vec<System>> {
        let internal = match &self.inner {
            Inner::Varying(internal) => vec![internal.system(arena, self.mixed, chart)],
            Inner::Constant(_, h) => {
                let energy = h.internal();
                let mut forms = vec![hamilton(arena, chart, &energy, equations::Form::ThroughVelocity)];
                if !h.is_tensor() {
                    forms.push(hamilton(arena, chart, &energy, equations::Form::Expanded));
                }
                forms
            }
        };
        let mut loads = Vec::new();
        if chart.linear.is_some() {
            loads.push(self.masses.load(arena, chart)?);
        }
        // Last: where it has a root of det phi, 1/det phi comes from that.
        loads.extend(self.potential.iter().map(|u| u.load(arena, chart)));
        let joined = |mut system: System| {
            for load in &loads {
                // What two of them use has one name.
                system.shared.retain(|(symbol, _)| !load.shared.iter().any(|(s, _)| s == symbol));
                system.add(load);
            }
            system.tidied(arena)
        };
        Some(internal.into_iter().map(joined).collect())
    }

    /// What is conserved, and what is with `p = 0`.
    fn conserved(&self, arena: &mut Arena, chart: &Chart) -> Option<(Vec<Candidate>, Vec<Candidate>)> {
        let still = self.chart(arena, false);
        let (slopes, mut shared) = match &self.inner {
            Inner::Varying(internal) => {
                let system = internal.system(arena, self.mixed, &still);
                (mixed::slopes_of(&system), system.shared)
            }
            Inner::Constant(_, h) => (gradient(&still, &h.internal()), Vec::new()),
        };
        let mut at_rest = mixed::conserved(arena, &still, &slopes, &shared);
        let mut moving = at_rest.clone();
        if chart.linear.is_some() {
            let load = self.masses.load(arena, chart)?;
            shared.extend(load.shared);
            let slopes = [slopes, self.masses.slopes(arena)].concat();
            moving = mixed::conserved(arena, chart, &slopes, &shared);
        }
        if let Some(u) = self.potential {
            moving.retain(|candidate| u.keeps(*candidate));
            at_rest.retain(|candidate| u.keeps(*candidate));
            // A force on the centre of mass does not leave it at rest.
            if u.moves_the_centre() {
                at_rest.clone_from(&moving);
            }
        }
        Some((moving, at_rest))
    }

    /// `|p|^2/(2m)` commutes with what contains neither `x` nor `p`.
    fn drifts(&self) -> Option<Expr> {
        let free = self.masses.body.is_none() && self.potential.is_none_or(|u| !u.moves_the_centre());
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
        if self.potential.is_some() {
            return None;
        }
        let commuting = reduce::commuting(arena, h, None);
        reduce::closed_form(arena, h, &commuting).map(|(form, _)| (form, true))
    }

    fn formulas(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        reduction: &Reduction,
        closed: Option<(ClosedForm, bool)>,
    ) -> Formulas {
        let (internal, mut equations) = match &self.inner {
            Inner::Varying(_) => {
                let mut list = mixed::internal_equations(self.mixed, &self.masses, self.potential);
                list.extend(mixed::centre_equations(&self.masses, self.potential));
                (mixed::internal_hamiltonian(), list)
            }
            Inner::Constant(_, h) => {
                let system = describe::system(arena, &reduction.system);
                (describe::hamiltonian(arena, h, &h.internal(), None), system)
            }
        };
        let hamiltonian = mixed::hamiltonian(arena, internal, &self.masses, self.potential);
        let reduced = equations.clone();
        if matches!(self.inner, Inner::Constant(..)) {
            equations = self.systems(arena, chart).map_or_else(Vec::new, |s| describe::system(arena, &s[0]));
        }
        let mut left_out = Vec::new();
        if self.masses.are_none() {
            left_out.push("x and p: the model has no translation".to_owned());
        }
        if !reduction.commuting.is_empty() {
            left_out.push("x and p: the centre of mass moves freely, x = x0 + t p/m".to_owned());
        } else if reduction.turned {
            left_out
                .push("p: conserved; space is turned so that only its first component is left".to_owned());
        }
        if closed.is_some() {
            left_out.push("integration of motions with p = 0: they have a closed form".to_owned());
        }
        Formulas {
            kinetic_energy: mixed::energy(arena, self.mixed),
            hamiltonian,
            equations,
            reduced,
            left_out,
        }
    }

    fn programs(&self, arena: &mut Arena, chart: &Chart, coefficients: &mut Constants) -> Option<Programs> {
        let n = self.mixed.dim;
        let phi = chart.phi.0.concat();
        let mut inline = |arena: &mut Arena, batch: &Batch, inputs: &[Expr]| {
            fuse(&straight_line(arena, batch, coefficients, &|a| inputs.contains(&a) || phi.contains(&a)))
        };
        let vector = |arena: &mut Arena, stem: &str| -> Vec<Expr> {
            (1..=n).map(|i| arena.symbol(&format!("{stem}_{i}"))).collect()
        };
        let velocities = Matrix::symbols(arena, self.inner.frame().velocity_name(), n);
        let momenta = Matrix::symbols(arena, self.inner.frame().momentum_name(), n);
        let (mut legendre, mut velocity, mut energy) = match &self.inner {
            Inner::Constant(kinetic, h) => (
                legendre_batch(arena, kinetic),
                matrix_batch(arena, &velocities, &h.velocity),
                result("energy", kinetic.internal_energy()),
            ),
            Inner::Varying(internal) => {
                let Legendre { shared, momentum, energy } = Legendre::new(arena, self.mixed);
                let values: Vec<Vec<Polynomial>> = internal
                    .velocity
                    .0
                    .iter()
                    .map(|row| row.iter().map(|symbol| Polynomial::atom(*symbol)).collect())
                    .collect();
                (
                    matrix_batch(arena, &momenta, &momentum),
                    matrix_batch(arena, &velocities, &values),
                    Batch { shared, ..result("energy", energy) },
                )
            }
        };
        if let Inner::Varying(internal) = &self.inner {
            legendre.shared.clone_from(&energy.shared);
            velocity.shared.clone_from(&internal.shared);
        }
        let v = vector(arena, "v");
        self.centre_energy(arena, &v, &mut energy);
        let inputs = [velocities.0.concat(), v].concat();
        Some(Programs {
            legendre: inline(arena, &legendre, &inputs),
            velocity: inline(arena, &velocity, &momenta.0.concat()),
            kinetic_energy: inline(arena, &energy, &inputs),
            mass: match (self.masses.body, self.masses.space) {
                (Some(mass), None) | (None, Some(mass)) => {
                    let reciprocal = arena.pow(mass, -1)?;
                    let [inverse, mass] = [reciprocal, mass].map(|m| Polynomial::normal_form(arena, m));
                    let results = vec![("inverse_mass".into(), inverse), ("mass".into(), mass)];
                    Some(inline(arena, &Batch { shared: Vec::new(), results }, &[]))
                }
                _ => None,
            },
            mixed_masses: match self.masses.are_mixed() {
                true => {
                    let (x_dot, p) = (vector(arena, "x_dot"), vector(arena, "p"));
                    let (_, shared) = self.masses.velocity(arena)?;
                    let momentum = self.centre_momentum(arena, &x_dot);
                    let named = |arena: &Arena, s: &Expr| arena.name(*s).unwrap_or("x_dot").to_owned();
                    let results = x_dot.iter().map(|s| (named(arena, s), Polynomial::atom(*s))).collect();
                    Some(MixedMasses {
                        momentum: inline(arena, &momentum, &x_dot),
                        velocity: inline(arena, &Batch { shared, results }, &p),
                    })
                }
                false => None,
            },
            hamiltonian: {
                let (batch, inputs) = self.hamiltonian(arena, chart)?;
                inline(arena, &batch, &inputs)
            },
            isotropic: match &self.inner {
                Inner::Constant(_, h) => h.isotropic.as_ref().map(|iso| {
                    let named = [
                        ("inverse_alpha", &iso.casimir2),
                        ("inverse_beta", &iso.casimir1_squared),
                        ("inverse_mu", &iso.skew),
                    ];
                    let results = named.map(|(name, p)| (name.to_owned(), p.clone())).to_vec();
                    inline(arena, &Batch { shared: Vec::new(), results }, &[])
                }),
                Inner::Varying(_) => None,
            },
        })
    }

    /// Adds `m/2 |v|^2` in the frame of the translation; with two masses `v = x_dot`.
    fn centre_energy(&self, arena: &mut Arena, v: &[Expr], energy: &mut Batch) {
        let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
        let mixed = self.masses.are_mixed();
        let mut squares = |mass: Option<Expr>, symbols: &[Expr]| {
            let Some(mass) = mass else { return };
            let mass = Polynomial::normal_form(arena, mass);
            for s in symbols {
                let square = Polynomial::term(vec![*s, *s], Rational::ONE);
                energy.results[0].1.add_product(&square, &mass, &half);
            }
        };
        squares(self.masses.space, v);
        if !mixed {
            squares(self.masses.body, v);
            return;
        }
        let v_hat: Vec<Expr> = (1..=v.len()).map(|a| arena.symbol(&format!("v_hat_{a}"))).collect();
        let mut squares = |arena: &mut Arena, mass: Expr| {
            let mass = Polynomial::normal_form(arena, mass);
            for s in &v_hat {
                let square = Polynomial::term(vec![*s, *s], Rational::ONE);
                energy.results[0].1.add_product(&square, &mass, &half);
            }
        };
        if let Some(mass) = self.masses.body {
            squares(arena, mass);
        }
        let comoving = comoving(arena, v);
        let known = |symbol: Expr| energy.shared.iter().any(|(s, _)| *s == symbol);
        let fresh: Definitions = comoving.into_iter().filter(|(s, _)| !known(*s)).collect();
        energy.shared.extend(fresh);
    }

    /// `p = m_space x_dot + m_body phi^-T phi^-1 x_dot`.
    fn centre_momentum(&self, arena: &mut Arena, x_dot: &[Expr]) -> Batch {
        let n = x_dot.len();
        let inverse = Matrix::symbols(arena, "inverse_phi", n).0;
        let shared = comoving(arena, x_dot);
        let mass = |arena: &mut Arena, mass: Option<Expr>| {
            mass.map_or_else(Polynomial::zero, |m| Polynomial::normal_form(arena, m))
        };
        let (body, space) = (mass(arena, self.masses.body), mass(arena, self.masses.space));
        let results = (0..n)
            .map(|i| {
                let mut pulled = Polynomial::zero();
                for (a, row) in inverse.iter().enumerate() {
                    let v_hat = arena.symbol(&format!("v_hat_{}", a + 1));
                    pulled.add_term(vec![row[i], v_hat], &Rational::ONE);
                }
                let mut momentum = space.mul(&Polynomial::atom(x_dot[i]));
                momentum.add_product(&body, &pulled, &Rational::ONE);
                (format!("p_{}", i + 1), momentum)
            })
            .collect();
        Batch { shared, results }
    }

    /// `H` at a point, with its inputs.
    fn hamiltonian(&self, arena: &mut Arena, chart: &Chart) -> Option<(Batch, Vec<Expr>)> {
        let mut batch = match &self.inner {
            Inner::Varying(internal) => {
                Batch { shared: internal.shared.clone(), ..result("energy", internal.energy(chart)) }
            }
            Inner::Constant(_, h) => result("energy", h.internal()),
        };
        let mut inputs: Vec<Expr> = chart.coordinates().into_iter().map(|z| chart.symbol(z)).collect();
        let join = |batch: &mut Batch, value: &Polynomial, shared: Definitions| {
            batch.results[0].1.add_scaled(value, &Rational::ONE);
            let fresh: Definitions = shared
                .into_iter()
                .filter(|(s, _)| !batch.shared.iter().any(|(known, _)| known == s))
                .collect();
            batch.shared.extend(fresh);
        };
        if !self.masses.are_none() {
            let (_, shared) = self.masses.velocity(arena)?;
            join(&mut batch, &self.masses.energy(arena, chart), shared);
        }
        if let Some(u) = self.potential {
            let (value, shared) = u.energy_at_a_point(arena, chart);
            join(&mut batch, &value, shared);
            inputs.push(Base::MeanLogStretch.symbol(arena));
        }
        Some((batch, inputs))
    }

    /// What tells at a placement whether the mass matrix is regular, where that is not known for all.
    fn regularity(
        &self,
        arena: &mut Arena,
        positive: Positive,
        required: bool,
        coefficients: &mut Constants,
    ) -> Option<Option<Regularity>> {
        let mut parts: Vec<(Factorisation, Definitions)> = Vec::new();
        if let Inner::Varying(internal) = &self.inner
            && !positive.internal
        {
            parts.push((internal.factorisation.clone(), internal.shared.clone()));
        }
        if self.masses.are_mixed() && !positive.centre {
            parts.push(self.masses.factorised(arena)?);
        }
        if parts.is_empty() {
            return Some(None);
        }
        let phi = Matrix::symbols(arena, "phi", self.mixed.dim).0.concat();
        let mut blocks = Vec::new();
        for (factorisation, shared) in parts {
            for (block, count) in factorisation.blocks() {
                let sizes: Vec<Polynomial> =
                    block.diagonal().into_iter().map(|entry| size(arena, entry)).collect();
                let values = block.upper.iter().chain(&sizes).enumerate();
                let results = values.map(|(k, p)| (format!("value_{}", k + 1), p.clone())).collect();
                let batch = Batch { shared: shared.clone(), results }.pruned(arena);
                let program = fuse(&straight_line(arena, &batch, coefficients, &|a| phi.contains(&a)));
                blocks.extend(std::iter::repeat_n((program, block.size), count));
            }
        }
        Some(Some(Regularity { blocks, positive: required }))
    }

    /// Numbers of positive and negative squares, where they are the same at every placement that a motion reaches.
    fn signature(
        &self,
        hessian: Option<&Hessian>,
        positive: Positive,
        required: bool,
    ) -> Option<(usize, usize)> {
        if required || (positive.internal && positive.centre) {
            return Some((self.mixed.degrees_of_freedom(), 0));
        }
        let blocks = hessian.filter(|_| positive.centre)?.blocks.iter();
        let inertias: Vec<_> = blocks.map(|block| block.inertia(self.mixed.dim)).collect::<Option<_>>()?;
        let squares = self.mixed.degrees_of_freedom();
        let negative: usize = inertias.iter().map(|inertia| inertia.negative).sum();
        Some((squares - negative, negative))
    }

    /// What `prepare()` has to check: masses, the inertia of d'Alembert's energy, and a constant mass matrix.
    fn conditions(&self, arena: &mut Arena, hessian: Option<&Hessian>, required: bool) -> Vec<Condition> {
        let mut list = match (&self.inner, hessian) {
            (Inner::Constant(kinetic, _), Some(hessian)) => {
                conditions(arena, kinetic, eigenvalues(hessian), required)
            }
            _ => Vec::new(),
        };
        let mut add = |arena: &mut Arena, name, directions, positive, value: Polynomial| {
            if value.as_constant().is_none() {
                let sizes = summands(&value);
                let program = unbound(arena, std::iter::once(value).chain(sizes));
                list.push(Condition { name, directions, positive, program });
            }
        };
        let terms = self.mixed.internal.iter().flat_map(|part| &part.terms);
        let inertia = terms.filter(|term| term.kind == TermKind::Dalembert).map(|term| &term.value).next();
        if let (Inner::Varying(_), Some(inertia)) = (&self.inner, inertia) {
            for minor in leading_minors(arena, inertia) {
                add(arena, "a leading minor of J", "a row of phi_dot", true, minor);
            }
        }
        for mass in [self.masses.body, self.masses.space].into_iter().flatten() {
            let mass = Polynomial::normal_form(arena, mass);
            add(arena, "m", "the velocity of the centre of mass", required || inertia.is_some(), mass);
        }
        list
    }

    fn numeric_blocks(&self, arena: &mut Arena, required: bool) -> Vec<NumericBlock> {
        match &self.inner {
            Inner::Constant(kinetic, h) => numeric_blocks(arena, h, required || kinetic.is_dalembert()),
            Inner::Varying(_) => Vec::new(),
        }
    }
}

/// `v_hat = phi^-1 x_dot`, with what leads there.
fn comoving(arena: &mut Arena, x_dot: &[Expr]) -> Definitions {
    let (inverse, mut shared) = inverse_placement(arena, x_dot.len());
    for (a, row) in inverse.0.iter().enumerate() {
        let mut value = Polynomial::zero();
        row.iter().zip(x_dot).for_each(|(psi, v)| value.add_term(vec![*psi, *v], &Rational::ONE));
        shared.push((arena.symbol(&format!("v_hat_{}", a + 1)), value));
    }
    shared
}

/// The sum of the sizes of the terms of a polynomial.
fn size(arena: &mut Arena, polynomial: &Polynomial) -> Polynomial {
    let mut sum = Polynomial::zero();
    for (monomial, c) in polynomial.terms() {
        let value = Polynomial::term(monomial.clone(), Rational::ONE).expression(arena);
        let size = match monomial.is_empty() {
            true => value,
            false => arena.apply(Function::Abs, value),
        };
        sum.add_scaled(&Polynomial::normal_form(arena, size), &c.abs());
    }
    sum
}
