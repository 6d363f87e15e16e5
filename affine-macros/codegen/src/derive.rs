//! The derivation of one model: from its quadratic form to straight-line programs, ready to be written down.

mod prepared;
mod programs;

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::check::{Form, eigenvalues, signature};
use crate::ir::Program;
use crate::ir::fuse::fuse;
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::conserved::{Candidate, conserved};
use crate::mechanics::describe::{self, Formula};
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::kinetic::{Frame, Kinetic};
use crate::mechanics::potential::Base;
use crate::mechanics::reduce::{self, ClosedForm, Reduction};
use crate::mechanics::symmetry::Group;
use crate::optimise::{Batch, straight_line};

use prepared::{coefficient_program, conditions, damping, numeric_blocks};
use programs::{best_reduction, full_chart, full_equations, power_batch};

/// Everything that is emitted about a model.
pub struct Model {
    /// Dimension of space.
    pub dim: usize,
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
    /// `O -> X`.
    pub legendre: Program,
    /// `X -> O`.
    pub velocity: Program,
    /// `1/m` and `m` of the translation.
    pub mass: Option<Program>,
    /// `(O, v) -> T`.
    pub kinetic_energy: Program,
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
    /// `1/alpha`, `1/beta`, `1/mu` of an isotropic model.
    pub isotropic: Option<Program>,
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
    /// `T`, `H`, and the equations.
    pub formulas: Formulas,
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
    /// Array -> its rate.
    pub program: Program,
}

/// A quantity that must not vanish once the fields have values.
pub struct Condition {
    /// `I + A`.
    pub name: &'static str,
    /// Which velocities lose their momentum.
    pub directions: &'static str,
    /// Must it be positive?
    pub positive: bool,
    /// Computes the value, then the terms whose sizes make the threshold.
    pub program: Program,
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
    /// Size.
    pub size: usize,
    /// Must it be positive definite?
    pub positive: bool,
}

/// Derives a model; `None` only for forms that the checks refuse.
pub fn derive(form: Form, require_positive: bool) -> Option<Model> {
    let signature = match require_positive || form.kinetic.is_dalembert() {
        // `prepare()` refuses anything else.
        true => Some((form.kinetic.degrees_of_freedom(), 0)),
        false => signature(&form),
    };
    let groups = (form.space_group, form.body_group);
    let eigenvalues = eigenvalues(&form);
    let Form { mut arena, kinetic, hessian, potential, forces, .. } = form;
    let potential = potential.as_ref();
    let arena = &mut arena;
    let h = Hamiltonian::new(arena, &kinetic, &hessian)?;
    let own = reduce::own_chart(arena, &h);
    let own_h = reduce::own_hamiltonian(&h, &own);
    let mut coefficients = Constants::new("c");

    let mut conserved_now = conserved(arena, &own, &own_h);
    let mut conserved_at_rest = at_rest(arena, &h, &conserved_now);
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
    let (reduction, reduced, trajectory, fixed) =
        best_reduction(arena, &h, potential, &forces, rotations, &mut coefficients)?;
    let formulas = Formulas {
        kinetic_energy: describe::kinetic_energy(arena, &kinetic),
        hamiltonian: describe::hamiltonian(arena, &h, &full_h, potential, &forces),
        equations: describe::equations(arena, &h, &full_chart, &full_h, potential, &forces),
        reduced: describe::system(arena, &reduction.system),
        left_out: describe::left_out(&h, &reduction, closed_form),
    };

    let mut inline = |arena: &mut Arena, batch: Batch, inputs: Vec<Expr>| {
        fuse(&straight_line(arena, &batch, &mut coefficients, &|a| inputs.contains(&a)))
    };
    let velocities: Vec<Expr> = kinetic.velocity.0.iter().flatten().copied().collect();
    let momenta: Vec<Expr> = h.momentum.0.iter().flatten().copied().collect();
    let legendre = legendre_batch(arena, &kinetic);
    let legendre = inline(arena, legendre, velocities.clone());
    let velocity = matrix_batch(arena, &kinetic.velocity, &h.velocity);
    let velocity = inline(arena, velocity, momenta);
    let (energy, energy_inputs) = energy_batch(arena, &kinetic, velocities);
    let kinetic_energy = inline(arena, energy, energy_inputs);
    let mut points: Vec<Expr> = full_chart.coordinates().into_iter().map(|z| full_chart.symbol(z)).collect();
    let mut energy = result("energy", full_h.clone());
    if let Some(u) = potential {
        let (value, shared) = u.energy_at_a_point(arena, &full_chart);
        energy.results[0].1.add_scaled(&value, &Rational::ONE);
        energy.shared = shared;
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
    let power = power_batch(arena, &h, &full_chart, &full_h, &forces);
    let power = power.map(|batch| inline(arena, batch, points.clone()));
    let hamiltonian = inline(arena, energy, points);
    let mass = h.translation.as_ref().zip(kinetic.translation).map(|((_, inverse), t)| {
        let mass = Polynomial::normal_form(arena, t.mass);
        let batch = Batch {
            results: vec![("inverse_mass".into(), inverse.clone()), ("mass".into(), mass)],
            ..Batch::default()
        };
        inline(arena, batch, Vec::new())
    });
    let isotropic = h.isotropic.as_ref().map(|iso| {
        let named = [
            ("inverse_alpha", &iso.casimir2),
            ("inverse_beta", &iso.casimir1_squared),
            ("inverse_mu", &iso.skew),
        ];
        let results = named.map(|(name, p)| (name.to_owned(), p.clone())).to_vec();
        inline(arena, Batch { results, ..Batch::default() }, Vec::new())
    });
    let numeric_blocks = numeric_blocks(arena, &h, require_positive || kinetic.is_dalembert());
    Some(Model {
        dim: kinetic.dim,
        frame: kinetic.frame,
        translation: kinetic.translation.map(|t| t.frame),
        conditions: conditions(arena, &kinetic, eigenvalues, require_positive),
        coefficients: coefficient_program(arena, &coefficients),
        numeric_blocks,
        damping: damping(arena, &forces),
        legendre,
        velocity,
        mass,
        kinetic_energy,
        hamiltonian,
        power,
        full,
        reduced,
        reduction,
        trajectory,
        fixed,
        closed_form,
        isotropic,
        conserved: conserved_now,
        conserved_at_rest,
        signature,
        has_forces: potential.is_some() || !forces.is_empty(),
        groups,
        formulas,
    })
}

fn result(name: &str, polynomial: Polynomial) -> Batch {
    Batch { results: vec![(name.to_owned(), polynomial)], ..Batch::default() }
}

/// The list for `p = 0`: translation dropped, and with it what it alone makes meaningful.
fn at_rest(arena: &mut Arena, h: &Hamiltonian, moving: &[Candidate]) -> Vec<Candidate> {
    if h.translation.is_none() {
        return moving.to_vec();
    }
    let chart = Chart::new(arena, h.dim, Momentum::of(h.frame), None);
    conserved(arena, &chart, &h.internal())
}

/// `X_ab = dT/dO_ba`.
fn legendre_batch(arena: &mut Arena, kinetic: &Kinetic) -> Batch {
    let energy = kinetic.internal_energy();
    let n = kinetic.dim;
    let mut momenta = vec![vec![Polynomial::zero(); n]; n];
    for (a, row) in kinetic.velocity.0.iter().enumerate() {
        for (b, velocity) in row.iter().enumerate() {
            momenta[b][a] = energy.derivative(*velocity);
        }
    }
    let names = Matrix::symbols(arena, kinetic.frame.momentum_name(), n);
    matrix_batch(arena, &names, &momenta)
}

fn matrix_batch(arena: &Arena, names: &Matrix, values: &[Vec<Polynomial>]) -> Batch {
    let name = |s: &Expr| arena.name(*s).unwrap_or("entry").to_owned();
    let results = names.0.concat().iter().map(name).zip(values.concat()).collect();
    Batch { results, ..Batch::default() }
}

/// `T_int(O) + m/2 |v|^2`, with its inputs.
fn energy_batch(arena: &mut Arena, kinetic: &Kinetic, mut inputs: Vec<Expr>) -> (Batch, Vec<Expr>) {
    let mut energy = kinetic.internal_energy();
    if let Some(t) = kinetic.translation {
        let mass = Polynomial::normal_form(arena, t.mass);
        let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
        for i in 1..=kinetic.dim {
            let v = arena.symbol(&format!("v_{i}"));
            energy.add_product(&Polynomial::term(vec![v, v], Rational::ONE), &mass, &half);
            inputs.push(v);
        }
    }
    (result("energy", energy), inputs)
}
