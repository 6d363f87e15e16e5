//! The derivation of one model: from its quadratic form to straight-line programs, ready to be written down.

mod lattice;
mod metrics;
mod mixed;
mod prepared;
mod programs;
mod quantities;
pub mod second_order;
pub mod splitting;
mod stated;

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::check::{Energy, Form, eigenvalues, signature};
use crate::ir::Program;
use crate::ir::fuse::fuse;
use crate::ir::tangent::with_tangent;
use crate::ir::taylor::Recurrence;
use crate::mechanics::balance::Laws;
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::conserved::{Candidate, conserved};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::describe::{self, Formula};
use crate::mechanics::equations::{self, hamilton};
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::kinetic::{Frame, Kinetic};
use crate::mechanics::loads::loads;
use crate::mechanics::potential::{Base, Potential};
use crate::mechanics::reduce::{self, ClosedForm, Reduction};
use crate::mechanics::symmetry::Group;
use crate::mechanics::weight::Weight;
use crate::optimise::{Batch, straight_line};
use crate::spec::{Capability, Spanned};

pub use lattice::{PieceProgram, PiecePrograms, RatioProgram, TwoPolar};
pub use metrics::ChangeOfBases;
use prepared::{coefficient_program, conditions, damping, numeric_blocks};
use programs::{Asked, Reduced, best_reduction, full_chart, full_equations, power_batch};

/// Everything that is emitted about a model.
pub struct Model {
    /// Dimension of space.
    pub dim: usize,
    /// The group that the motion is confined to; `None` for GL+(n).
    pub constraint: Option<Constraint>,
    /// Is the affine momentum projected for it? Otherwise the constraint acts through its multiplier.
    pub projected: bool,
    /// Frame of the internal motion.
    pub frame: Frame,
    /// Frame of the translational energy.
    pub translation: Option<Frame>,
    /// Coefficients that depend on the fields, and the program that computes them when the model is prepared.
    pub coefficients: Program,
    /// Inverse blocks that need numbers.
    pub numeric_blocks: Vec<NumericBlock>,
    /// What `prepare()` must find different from zero.
    pub conditions: Vec<Condition>,
    /// What `prepare()` must find not negative in the dissipation.
    pub damping: Damping,
    /// What starts from velocities; with `phi` where the mass matrix depends on it, as in the next ones. `None` where
    /// they do not determine the momentum.
    pub velocity_side: Option<VelocitySide>,
    /// `X -> O`.
    pub velocity: Program,
    /// `1/m` and `m` of the translation.
    pub mass: Option<Program>,
    /// Translation with masses in body and space.
    pub mixed_masses: Option<MixedMasses>,
    /// What decides whether the mass matrix is regular at a placement, where that is not known for all.
    pub regularity: Option<Regularity>,
    /// The configuration metric, where asked for.
    pub metric: Option<Metric>,
    /// Point -> acceleration of the centre of mass, where asked for.
    pub acceleration: Option<Program>,
    /// The balance laws, where asked for.
    pub balance: Option<Balance>,
    /// Point -> `H`.
    pub hamiltonian: Program,
    /// Point -> power of the forces that no potential has.
    pub power: Option<Program>,
    /// Hamilton's equations in the model's own frames.
    pub full: Equations,
    /// The reduced equations.
    pub reduced: Equations,
    /// How the state was reduced.
    pub reduction: Reduction,
    /// The constants of a trajectory as functions of its conserved momenta.
    pub trajectory: Program,
    /// Components of the affine momentum that are constants of the trajectory while others are state.
    pub fixed: Vec<String>,
    /// Closed form of the geodesics; whether it needs `p = 0`.
    pub closed_form: Option<(ClosedForm, bool)>,
    /// `1/alpha`, `1/beta`, `1/mu` of an isotropic model, and the coefficient of `C(3)/3` where there is one.
    pub isotropic: Option<Program>,
    /// `1/m`, the stiffness and the scale of the dilatational motion, where it is taken out of the state.
    pub dilatation: Option<Program>,
    /// Conserved quantities.
    pub conserved: Vec<Candidate>,
    /// Conserved quantities of motions with `p = 0`.
    pub conserved_at_rest: Vec<Candidate>,
    /// Numbers of positive and negative squares.
    pub signature: Option<(usize, usize)>,
    /// Is there a potential or any other force?
    pub has_forces: bool,
    /// Symmetry groups of space and body that leave the kinetic energy unchanged.
    pub groups: (Group, Group),
    /// Metrics other than the identity.
    pub metrics: Option<ChangeOfBases>,
    /// `T`, `H`, and the equations.
    pub formulas: Formulas,
    /// The two-polar form, where it is asked for.
    pub two_polar: Option<TwoPolar>,
    /// Taylor coefficients of the reduced equations, if asked for.
    pub taylor: Option<Recurrence>,
    /// Exact flows of the pieces of the reduced motion, if asked for.
    pub splitting: Option<splitting::Programs>,
    /// State and its change -> rates and their changes, if asked for.
    pub tangent: Option<Program>,
    /// The equations as `q' = V(p)`, `p' = F(t, q)`, if asked for.
    pub second_order: Option<second_order::Halves>,
}

/// The Legendre transformation and the energy in velocities.
pub struct VelocitySide {
    /// `O -> X`.
    pub legendre: Program,
    /// `(O, v) -> T`.
    pub kinetic_energy: Program,
}

/// The derivation as formulas.
pub struct Formulas {
    /// `T`.
    pub kinetic_energy: Formula,
    /// `H`.
    pub hamiltonian: Formula,
    /// Hamilton's equations.
    pub equations: Vec<Formula>,
    /// The reduced equations, component by component.
    pub reduced: Vec<Formula>,
    /// What was taken out of the state.
    pub left_out: Vec<String>,
}

/// A first-order system as a program over a plain array.
pub struct Equations {
    /// Groups of the array: name and component symbols.
    pub groups: Vec<(&'static str, Vec<String>)>,
    /// Entries of the affine momentum that are linear in components of the array.
    pub dependent: Program,
    /// Array -> its rate.
    pub program: Program,
}

/// Legendre transformation of the centre of mass where it depends on `phi`.
pub struct MixedMasses {
    /// `(phi, x_dot) -> p`.
    pub momentum: Program,
    /// `(phi, p) -> x_dot`.
    pub velocity: Program,
}

/// The mass matrix in blocks that do not mix.
pub struct Regularity {
    /// `phi ->` upper triangle, row after row, then the sizes of the summands of each diagonal entry.
    pub blocks: Vec<(Program, usize)>,
    /// Must it be positive definite?
    pub positive: bool,
}

/// The configuration metric over `(x_dot, phi_dot)`.
pub struct Metric {
    /// Number of rows.
    pub size: usize,
    /// `phi ->` entries, row after row.
    pub entries: Program,
    /// `phi ->` entries of the inverse, row after row.
    pub inverse: Program,
}

/// Programs of the balance laws of a d'Alembert model, the entries of one quantity after the other.
pub struct Balance {
    /// Point -> [quantities](crate::mechanics::balance::INTERNAL) of the internal motion.
    pub internal: Program,
    /// Point -> [quantities](crate::mechanics::balance::CENTRE) of the centre of mass, where it moves.
    pub centre: Option<Program>,
}

/// A quantity that must not vanish once the fields have values.
pub struct Condition {
    /// `I + A`.
    pub name: &'static str,
    /// Which velocities lose their momentum, or which momenta their velocity.
    pub directions: &'static str,
    /// What it multiplies.
    pub relation: Relation,
    /// Must it be positive?
    pub positive: bool,
    /// Computes the value, then the terms whose sizes make the threshold.
    pub program: Program,
}

/// What an eigenvalue is a factor of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// The momentum is the eigenvalue times the velocity.
    MomentumOfVelocity,
    /// The velocity is the eigenvalue times the momentum.
    VelocityOfMomentum,
}

/// What must not be negative once the fields have values.
#[derive(Default)]
pub struct Damping {
    /// Eigenvalues and coefficients.
    pub conditions: Vec<Condition>,
    /// Blocks whose eigenvalues need numbers; no inverse is formed.
    pub blocks: Vec<NumericBlock>,
}

/// A block to invert numerically.
pub struct NumericBlock {
    /// Computes the upper triangle, row after row, then the terms whose sizes make the threshold.
    pub program: Program,
    /// Names of the entries of the inverse, upper triangle, row after row.
    pub inverse: Vec<String>,
    /// The velocities that it is written in: row-major places and weights.
    pub basis: Vec<Vec<(usize, Rational)>>,
    /// Size.
    pub size: usize,
    /// Must it be positive definite?
    pub positive: bool,
}

/// Derives a model; `None` only for energies that the checks refuse.
pub fn derive(energy: impl Into<Energy>, require_positive: bool) -> Option<Model> {
    match energy.into() {
        Energy::Constant(form) => constant(*form, require_positive),
        Energy::Mixed(form) => mixed::derive(*form, require_positive),
    }
}

/// A model whose mass matrix is constant in one frame.
fn constant(form: Form, require_positive: bool) -> Option<Model> {
    let signature = match require_positive || form.kinetic.is_dalembert() {
        // `prepare()` refuses anything else.
        true => Some((form.kinetic.degrees_of_freedom(), 0)),
        false => signature(&form),
    };
    let groups = (form.space_group, form.body_group);
    let eigenvalues = eigenvalues(&form.hessian);
    let Form {
        mut arena,
        kinetic,
        stated,
        hessian,
        potential,
        forces,
        metrics,
        split,
        nystrom,
        two_polar,
        ratios,
        unitary,
        quantities,
        ..
    } = form;
    let potential = potential.as_ref();
    let arena = &mut arena;
    let cubic = stated.as_ref().filter(|stated| stated.is_cubic());
    let h = match cubic {
        None => Hamiltonian::new(arena, &kinetic, &hessian)?,
        Some(stated) => stated.hamiltonian(arena),
    };
    let own = reduce::own_chart(arena, &h);
    let own_h = reduce::own_hamiltonian(&h, &own);
    let mut coefficients = Constants::new("c");

    let mut conserved_now = conserved(arena, &own, &own_h);
    let mut conserved_at_rest = at_rest(arena, &h, &conserved_now);
    if let Some(reaction) = multiplier(arena, &h) {
        conserved_now.retain(|candidate| reaction.keeps(*candidate));
        conserved_at_rest.retain(|candidate| reaction.keeps(*candidate));
    }
    if let Some(u) = potential {
        conserved_now.retain(|candidate| u.keeps(*candidate));
        conserved_at_rest.retain(|candidate| u.keeps(*candidate));
        // A force on the centre of mass does not leave it at rest.
        if u.moves_the_centre() {
            conserved_at_rest.clone_from(&conserved_now);
        }
    }
    // Of the undamped motion: the forces are held against the same rotations on their own.
    let rotations =
        conserved_now.contains(&Candidate::TotalAngularMomentum) && forces.are_isotropic_in_space();
    if !forces.is_empty() {
        conserved_now = forces.keep(arena, &own, &h, conserved_now);
        conserved_at_rest = match forces.push_from_rest() {
            true => conserved_now.clone(),
            false => forces.at_rest().keep(arena, &own, &h, conserved_at_rest),
        };
    }
    let commuting = reduce::commuting(arena, &h, potential, &forces);
    let closed_form = match potential {
        None if forces.is_empty() => reduce::closed_form(arena, &h, &commuting),
        _ => None,
    };

    let (full_chart, full_h) = full_chart(arena, &h);
    let full = full_equations(arena, &h, &full_chart, &full_h, potential, &forces, &mut coefficients);
    let Reduced { reduction, equations: reduced, pieces, trajectory, fixed } = {
        let asked = (rotations, Asked { split, nystrom });
        best_reduction(arena, &h, potential, &forces, asked, &mut coefficients)?
    };
    let formulas = Formulas {
        kinetic_energy: match cubic {
            None => describe::kinetic_energy(arena, &kinetic),
            Some(_) => describe::kinetic_energy_of_momenta(arena, &h),
        },
        hamiltonian: describe::hamiltonian(arena, &h, &full_h, potential, &forces),
        equations: describe::equations(arena, &h, &full_chart, &full_h, potential, &forces),
        reduced: describe::system(arena, &reduction.system),
        left_out: describe::left_out(&h, &reduction, closed_form),
    };

    let mut inline = |arena: &mut Arena, batch: Batch, inputs: Vec<Expr>| {
        fuse(&straight_line(arena, &batch, &mut coefficients, &|a| inputs.contains(&a)))
    };
    let velocities: Vec<Expr> = kinetic.velocity.0.iter().flatten().copied().collect();
    let placement = match h.weight {
        Some(_) => full_chart.phi.0.concat(),
        None => Vec::new(),
    };
    let weighted = |batch: Batch| weighted(batch, h.weight.as_ref());
    let velocities = [velocities, placement.clone()].concat();
    let momenta: Vec<Expr> = [h.momentum.0.concat(), placement].concat();
    let legendre = cubic.is_none().then(|| {
        let legendre = weighted(legendre_batch(arena, &kinetic));
        inline(arena, legendre, velocities.clone())
    });
    let dependent = own.dependent();
    let projected =
        |atom: Expr| dependent.iter().find(|(symbol, _)| *symbol == atom).map(|(_, value)| value.clone());
    let velocities_of: Vec<Vec<Polynomial>> =
        h.velocity.iter().map(|row| row.iter().map(|o| o.substitute(&projected)).collect()).collect();
    let velocity = defined(matrix_batch(arena, &kinetic.velocity, &velocities_of), h.weight.as_ref());
    let velocity = inline(arena, velocity, momenta);
    let velocity_side = legendre.map(|legendre| {
        let internal = weighted(result("energy", kinetic.internal_energy()));
        let (energy, inputs) = energy_batch(arena, &kinetic, internal, velocities);
        VelocitySide { legendre, kinetic_energy: inline(arena, energy, inputs) }
    });
    let mut points: Vec<Expr> = full_chart.coordinates().into_iter().map(|z| full_chart.symbol(z)).collect();
    let mut energy = defined(result("energy", full_h.substitute(&projected)), h.weight.as_ref());
    if let Some(u) = potential {
        let (value, shared) = u.energy_at_a_point(arena, &full_chart);
        energy.results[0].1.add_scaled(&value, &Rational::ONE);
        energy.shared.extend(shared);
        points.push(Base::MeanLogStretch.symbol(arena));
        points.extend((0..kinetic.dim).map(|a| Base::LogStretch(a).symbol(arena)));
        points.extend(u.time());
    }
    for custom in &forces.customs {
        if let Some((value, kernel)) = custom.energy(arena, &full_chart) {
            energy.results[0].1.add_scaled(&value, &Rational::ONE);
            energy.kernels.push(kernel);
        }
    }
    points.extend(forces.time(arena));
    let power = power_batch(arena, &h, &full_chart, &full_h, potential, &forces);
    let power = power.map(|batch| inline(arena, batch, points.clone()));
    let hamiltonian = inline(arena, energy, points);
    let mass = h.translation.as_ref().zip(kinetic.translation).map(|((_, inverse), t)| {
        let mut results = vec![("inverse_mass".into(), inverse.clone())];
        if cubic.is_none() {
            results.push(("mass".into(), Polynomial::normal_form(arena, t.mass)));
        }
        inline(arena, Batch { results, ..Batch::default() }, Vec::new())
    });
    let isotropic = h.isotropic.as_ref().map(|iso| {
        let named = [
            ("inverse_alpha", &iso.casimir2),
            ("inverse_beta", &iso.casimir1_squared),
            ("inverse_mu", &iso.skew),
        ];
        let mut results = named.map(|(name, p)| (name.to_owned(), p.clone())).to_vec();
        if !iso.casimir3.is_zero() {
            results.push(("casimir3".to_owned(), iso.casimir3.clone()));
        }
        inline(arena, Batch { results, ..Batch::default() }, Vec::new())
    });
    let dilatation = reduction.separation.as_ref().map(|s| inline(arena, s.batch(), Vec::new()));
    if unitary {
        // Nothing but the lattice is emitted: no other coefficient is computed.
        coefficients = Constants::new("c");
    }
    let asked = lattice::Asked { unitary, split, ratios };
    let two_polar = two_polar.then(|| lattice::two_polar(arena, &h, potential, asked, &mut coefficients));
    let numeric_blocks = numeric_blocks(arena, &h, require_positive || kinetic.is_dalembert());
    let metric = match quantities.metric {
        true => Some(quantities::metric(arena, std::slice::from_ref(&kinetic), Some(&h), &mut coefficients)?),
        false => None,
    };
    let time = potential.and_then(Potential::time).or_else(|| forces.time(arena));
    let acceleration = quantities.acceleration.then(|| {
        let mut system = hamilton(arena, &full_chart, &full_h, equations::Form::ThroughVelocity);
        loads(arena, &full_chart, &h, potential, &forces).iter().for_each(|load| system.add(load));
        quantities::acceleration(arena, &full_chart, &system, time, &mut coefficients)
    });
    let balance = quantities.balance.then(|| {
        let loads = loads(arena, &full_chart, &h, potential, &forces);
        let laws = Laws::new(arena, &full_chart, &h, &full_h, &loads);
        quantities::balance(arena, &full_chart, &laws, time, &mut coefficients)
    });
    Some(Model {
        dim: kinetic.dim,
        constraint: kinetic.constraint,
        projected: kinetic.confined().is_some(),
        frame: kinetic.frame,
        translation: kinetic.translation.map(|t| t.frame),
        conditions: match &stated {
            None => conditions(arena, &kinetic, eigenvalues, require_positive),
            Some(stated) => stated::conditions(arena, stated, require_positive),
        },
        coefficients: coefficient_program(arena, &coefficients),
        numeric_blocks,
        damping: damping(arena, &forces),
        velocity_side,
        velocity,
        mass,
        mixed_masses: None,
        regularity: None,
        metric,
        acceleration,
        balance,
        hamiltonian,
        power,
        full,
        reduced,
        reduction,
        trajectory,
        fixed,
        closed_form,
        isotropic,
        dilatation,
        conserved: conserved_now,
        conserved_at_rest,
        signature,
        has_forces: potential.is_some() || !forces.is_empty(),
        groups,
        metrics: metrics.map(|metrics| ChangeOfBases::of(arena, metrics)),
        formulas,
        two_polar,
        taylor: None,
        tangent: None,
        splitting: pieces.splitting,
        second_order: pieces.second_order,
    })
}

impl Model {
    /// Derives what `emit(...)` asks for.
    #[must_use]
    pub fn with(mut self, capabilities: &[Spanned<Capability>]) -> Self {
        let states: Vec<String> = self.reduced.groups.iter().flat_map(|(_, names)| names.clone()).collect();
        let program = &self.reduced.program;
        for capability in capabilities {
            match capability.value {
                Capability::Taylor => self.taylor = Some(Recurrence::of(program, &states)),
                Capability::Tangent => {
                    let own = (1..=self.trajectory.outputs.len()).map(|k| format!("k_{k}"));
                    let changing: Vec<String> = states.iter().cloned().chain(own).collect();
                    let along = with_tangent(program, &|name| changing.iter().any(|known| known == name));
                    self.tangent = Some(fuse(&along));
                }
                _ => {}
            }
        }
        self
    }
}

fn result(name: &str, polynomial: Polynomial) -> Batch {
    Batch { results: vec![(name.to_owned(), polynomial)], ..Batch::default() }
}

/// The list for `p = 0`: translation dropped, and with it what it alone makes meaningful.
fn at_rest(arena: &mut Arena, h: &Hamiltonian, moving: &[Candidate]) -> Vec<Candidate> {
    if h.translation.is_none() {
        return moving.to_vec();
    }
    let chart = Chart::new(arena, h.dim, Momentum::of(h.frame), None).under(h.confined());
    conserved(arena, &chart, &h.internal())
}

/// The force of the multiplier of a constraint that acts through one: it has the directions of that of a potential in
/// `q`, and no other is known of it.
fn multiplier(arena: &mut Arena, h: &Hamiltonian) -> Option<Potential> {
    let acts = h.constraint.is_some() && h.confined().is_none();
    acts.then(|| {
        let q = Base::MeanLogStretch.symbol(arena);
        Potential::new(arena, h.dim, q)
    })
}

/// `X_ab = dT/dO_ba`, projected under a constraint.
fn legendre_batch(arena: &mut Arena, kinetic: &Kinetic) -> Batch {
    let energy = kinetic.internal_energy();
    let n = kinetic.dim;
    let mut momenta = vec![vec![Polynomial::zero(); n]; n];
    for (a, row) in kinetic.velocity.0.iter().enumerate() {
        for (b, velocity) in row.iter().enumerate() {
            momenta[b][a] = energy.derivative(*velocity);
        }
    }
    if let Some(group) = kinetic.confined() {
        momenta = group.projected(&momenta);
    }
    let names = Matrix::symbols(arena, kinetic.frame.momentum_name(), n);
    matrix_batch(arena, &names, &momenta)
}

fn matrix_batch(arena: &Arena, names: &Matrix, values: &[Vec<Polynomial>]) -> Batch {
    let name = |s: &Expr| arena.name(*s).unwrap_or("entry").to_owned();
    let results = names.0.concat().iter().map(name).zip(values.concat()).collect();
    Batch { results, ..Batch::default() }
}

/// Results of the internal energy times its weight `D^2`, if it has one.
fn weighted(batch: Batch, weight: Option<&Weight>) -> Batch {
    let Some(Weight { square, .. }) = weight else { return batch };
    let results =
        batch.results.into_iter().map(|(name, value)| (name, value.mul(&Polynomial::atom(*square))));
    defined(Batch { results: results.collect(), ..batch }, weight)
}

/// With what defines the weight of the internal energy, if it has one.
fn defined(mut batch: Batch, weight: Option<&Weight>) -> Batch {
    batch.shared.extend(weight.iter().flat_map(|weight| weight.definitions.clone()));
    batch
}

/// `T_int(O) + m/2 |v|^2`, with its inputs.
fn energy_batch(
    arena: &mut Arena,
    kinetic: &Kinetic,
    mut batch: Batch,
    mut inputs: Vec<Expr>,
) -> (Batch, Vec<Expr>) {
    let energy = &mut batch.results[0].1;
    if let Some(t) = kinetic.translation {
        let mass = Polynomial::normal_form(arena, t.mass);
        let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
        for i in 1..=kinetic.dim {
            let v = arena.symbol(&format!("v_{i}"));
            energy.add_product(&Polynomial::term(vec![v, v], Rational::ONE), &mass, &half);
            inputs.push(v);
        }
    }
    (batch, inputs)
}
