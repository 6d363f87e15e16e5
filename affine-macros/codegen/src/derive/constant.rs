//! A model whose mass matrix is constant in one frame.

use super::domain::domain;
use super::model::{Formulas, Model, VelocitySide};
use super::prepared::{coefficient_program, conditions, damping, numeric_blocks};
use super::programs::{Reduced, best_reduction, full_chart, full_equations, power_batch};
use super::ways::Ways;
use super::{ChangeOfBases, lattice, quantities, stated};
use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::ir::fuse::fuse;
use crate::mechanics::balance::Laws;
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::conserved::{Candidate, candidates, still};
use crate::mechanics::describe::{self, Described, Notation};
use crate::mechanics::equations::{Form as Written, Load};
use crate::mechanics::forces::Forces;
use crate::mechanics::form::Form;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::kinetics::Kinetics;
use crate::mechanics::loads::loads;
use crate::mechanics::potential::{Base, Potential};
use crate::mechanics::reduce;
use crate::mechanics::shared::CentreVelocity;
use crate::mechanics::weight::Weight;
use crate::optimise::{Batch, straight_line};
use crate::symbol::Quantity;

/// Derives the model of an energy whose mass matrix is constant in one frame.
pub(super) fn constant(form: Form, require_positive: bool) -> Option<Model> {
    let signature = match require_positive || form.kinetic.is_dalembert() {
        // `prepare()` refuses anything else.
        true => Some((form.kinetic.degrees_of_freedom(), 0)),
        false => form.signature(),
    };
    let groups = (form.space_group, form.body_group);
    let eigenvalues = form.hessian.eigenvalues();
    let Form {
        mut arena, kinetic, stated, hessian, potential, forces, metrics, rebased, unitary, asked, ..
    } = form;
    let arena = &mut arena;
    let cubic = stated.as_ref().filter(|stated| stated.is_cubic());
    let h = match cubic {
        None => Hamiltonian::new(arena, &kinetic, &hessian)?,
        Some(stated) => stated.hamiltonian(arena),
    };
    let ways = potential.map(|u| Ways::new(arena, &u, h.dim, &h.momenta()));
    let at_points = ways.as_ref().map(|ways| &ways.at_points);
    let potential = ways.as_ref().map(|ways| &ways.along_motions);
    let own = reduce::own_chart(arena, &h);
    let own_h = reduce::own_hamiltonian(&h, &own);
    let mut coefficients = Constants::new(Quantity::Coefficient);

    let Kept { moving: conserved_now, at_rest: conserved_at_rest, rotations } =
        kept(arena, &h, (&own, &own_h), potential, &forces);
    let commuting = reduce::commuting(arena, &h, potential, &forces);
    let closed_form = match potential {
        None if forces.is_empty() => reduce::closed_form(&h, &commuting),
        _ => None,
    };

    let (full_chart, full_h) = full_chart(arena, &h);
    let full = full_equations(arena, &h, &full_chart, &full_h, at_points, &forces, &mut coefficients);
    let Reduced { reduction, equations: reduced, pieces, trajectory, fixed } =
        { best_reduction(arena, &h, potential, &forces, (rotations, asked), &mut coefficients)? };
    let energies = std::slice::from_ref(&kinetic);
    let metrics_of = metrics.as_ref();
    let described = Described {
        energies,
        blocks: &h.numeric_blocks,
        forces: &forces,
        metrics: metrics_of,
        rebased: &rebased,
    };
    let notation = Notation::new(arena, &described);
    let energy = (&h, &kinetic);
    let formulas = Formulas {
        kinetic_energy: match cubic {
            None => describe::kinetic_energy(arena, &notation, &kinetic),
            Some(_) => describe::kinetic_energy_of_momenta(arena, &notation, &h),
        },
        hamiltonian: describe::hamiltonian(arena, &notation, energy, potential, &forces),
        equations: describe::equations(arena, &notation, energy, (&full_chart, &full_h), potential, &forces),
        reduced: describe::system(arena, &notation, &reduction.system),
        left_out: describe::left_out(&h, &reduction, closed_form),
    };

    let points = point_inputs(arena, &full_chart, potential, &forces);
    let domain = domain(arena, &full_chart, potential, &mut coefficients, &points);
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
    let internal = defined(result("energy", full_h.substitute(&projected)), h.weight.as_ref());
    let far_away = potential.and_then(|u| u.energy_far_away(arena, &full_chart));
    let far_away =
        far_away.map(|value| energy_of(arena, &full_chart, internal.clone(), Some(value), &forces));
    let near = potential.map(|u| u.energy_at_a_point(arena, &full_chart));
    let energy = energy_of(arena, &full_chart, internal, near, &forces);
    let power = power_batch(arena, &h, &full_chart, &full_h, potential, &forces);
    let power = power.map(|batch| inline(arena, batch, points.clone()));
    let hamiltonian = inline(arena, energy, points.clone());
    let hamiltonian_far_away = far_away.map(|energy| inline(arena, energy, points));
    let mass = mass(arena, &h, &kinetic, cubic.is_none()).map(|batch| inline(arena, batch, Vec::new()));
    let isotropic = isotropic(&h).map(|batch| inline(arena, batch, Vec::new()));
    let dilatation = reduction.separation.as_ref().map(|s| inline(arena, s.batch(), Vec::new()));
    if unitary {
        // Nothing but the lattice is emitted: no other coefficient is computed.
        coefficients = Constants::new(Quantity::Coefficient);
    }
    let two_polar = asked
        .two_polar
        .then(|| lattice::two_polar(arena, &notation, &h, potential, (unitary, asked), &mut coefficients));
    let numeric_blocks = numeric_blocks(arena, &h, require_positive || kinetic.is_dalembert());
    let metric = match asked.metric {
        true => Some(quantities::metric(arena, std::slice::from_ref(&kinetic), Some(&h), &mut coefficients)?),
        false => None,
    };
    let time = potential.and_then(Potential::time).or_else(|| forces.time(arena));
    let acceleration = asked.acceleration.then(|| {
        let mut system = Kinetics::polynomial(arena, &full_chart, &full_h).system(Written::ThroughVelocity);
        loads(arena, &full_chart, &h, potential, &forces).iter().for_each(|load| system.add(load));
        quantities::acceleration(arena, &full_chart, &system, time, &mut coefficients)
    });
    let balance = asked.balance.then(|| {
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
        hamiltonian_far_away,
        domain,
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
        metrics: metrics.map(|metrics| ChangeOfBases::of(arena, metrics, &rebased)),
        formulas,
        two_polar,
        taylor: None,
        tangent: None,
        splitting: pieces.splitting,
        second_order: pieces.second_order,
        packed: None,
    })
}

/// What a motion conserves.
struct Kept {
    moving: Vec<Candidate>,
    /// With `p = 0`.
    at_rest: Vec<Candidate>,
    /// Do rotations of space leave the motion unchanged, and the forces of themselves as well? Friction takes the angular
    /// momentum all the same.
    rotations: bool,
}

/// What is conserved by the kinetic energy, and then by what is added to it.
fn kept(
    arena: &mut Arena,
    h: &Hamiltonian,
    (own, own_h): (&Chart, &Polynomial),
    potential: Option<&Potential>,
    forces: &Forces,
) -> Kept {
    let whole = motion(arena, h, own, own_h);
    let mut moving = still(arena, own, &whole, candidates(own));
    let resting = Chart::new(arena, h.dim, Momentum::of(h.frame), None).under(h.confined());
    let internal = motion(arena, h, &resting, &h.internal());
    // Translation dropped, and with it what it alone makes meaningful.
    let mut at_rest = match h.translation {
        None => moving.clone(),
        Some(_) => still(arena, &resting, &internal, candidates(&resting)),
    };
    if let Some(reaction) = multiplier(arena, h) {
        moving.retain(|candidate| reaction.keeps(*candidate));
        at_rest.retain(|candidate| reaction.keeps(*candidate));
    }
    if let Some(u) = potential {
        moving.retain(|candidate| u.keeps(*candidate));
        at_rest.retain(|candidate| u.keeps(*candidate));
        // A force on the centre of mass does not leave it at rest.
        if u.moves_the_centre() {
            at_rest.clone_from(&moving);
        }
    }
    // Of the undamped motion: the forces are held against the same rotations on their own.
    let rotations = moving.contains(&Candidate::TotalAngularMomentum) && forces.are_isotropic_in_space();
    if !forces.is_empty() {
        let shared = |loads: &[Load]| loads.iter().flat_map(|load| load.shared.clone()).collect::<Vec<_>>();
        moving = forces.keep(arena, own, (&h.centre_velocity(), &shared(&whole)), moving);
        at_rest = match forces.push_from_rest() {
            true => moving.clone(),
            false => {
                let fixed = (&CentreVelocity::Fixed, &shared(&internal));
                forces.at_rest().keep(arena, &resting, fixed, at_rest)
            }
        };
    }
    Kept { moving, at_rest, rotations }
}

/// `H` as a function of a phase point, from its kinetic part and the potential with what it shares.
fn energy_of(
    arena: &mut Arena,
    chart: &Chart,
    mut energy: Batch,
    potential: Option<(Polynomial, Vec<(Expr, Polynomial)>)>,
    forces: &Forces,
) -> Batch {
    if let Some((value, shared)) = potential {
        energy.results[0].1.add_scaled(&value, &Rational::ONE);
        energy.shared.extend(shared);
    }
    for custom in &forces.customs {
        if let Some((value, kernel)) = custom.energy(arena, chart) {
            energy.results[0].1.add_scaled(&value, &Rational::ONE);
            energy.kernels.push(kernel);
        }
    }
    energy
}

/// What functions of a phase point read.
fn point_inputs(
    arena: &mut Arena,
    chart: &Chart,
    potential: Option<&Potential>,
    forces: &Forces,
) -> Vec<Expr> {
    let mut points: Vec<Expr> = chart.coordinates().into_iter().map(|z| chart.symbol(z)).collect();
    if let Some(u) = potential {
        points.extend(placement_inputs(arena, chart.dim));
        points.extend(u.time());
    }
    points.extend(forces.time(arena));
    points
}

/// Functions of the placement that potentials are evaluated with.
pub(super) fn placement_inputs(arena: &mut Arena, n: usize) -> Vec<Expr> {
    let mut inputs = vec![Base::MeanLogStretch.symbol(arena), arena.symbol(Quantity::Dilatation)];
    inputs.extend((0..n).map(|a| Base::LogStretch(a).symbol(arena)));
    inputs
}

/// `1/m`, and `m` where momenta are determined by velocities.
fn mass(arena: &mut Arena, h: &Hamiltonian, kinetic: &Kinetic, determined: bool) -> Option<Batch> {
    let ((_, inverse), translation) = h.translation.as_ref().zip(kinetic.translation)?;
    let mut results = vec![("inverse_mass".into(), inverse.clone())];
    if determined {
        results.push(("mass".into(), Polynomial::normal_form(arena, translation.mass)));
    }
    Some(Batch { results, ..Batch::default() })
}

/// `1/alpha`, `1/beta`, `1/mu`, and the coefficient of `C(3)/3` where there is one.
fn isotropic(h: &Hamiltonian) -> Option<Batch> {
    let iso = h.isotropic.as_ref()?;
    let named = [
        ("inverse_alpha", &iso.casimir2),
        ("inverse_beta", &iso.casimir1_squared),
        ("inverse_mu", &iso.skew),
    ];
    let mut results = named.map(|(name, p)| (name.to_owned(), p.clone())).to_vec();
    if !iso.casimir3.is_zero() {
        results.push(("casimir3".to_owned(), iso.casimir3.clone()));
    }
    Some(Batch { results, ..Batch::default() })
}

pub(super) fn result(name: &str, polynomial: Polynomial) -> Batch {
    Batch { results: vec![(name.to_owned(), polynomial)], ..Batch::default() }
}

/// What moves the coordinates of a chart without potential and forces.
fn motion(arena: &mut Arena, h: &Hamiltonian, chart: &Chart, energy: &Polynomial) -> Vec<Load> {
    let kinetics = Kinetics::polynomial(arena, chart, energy).load();
    h.weight.iter().map(|weight| weight.load(chart, &h.internal())).chain([kinetics]).collect()
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
pub(super) fn legendre_batch(arena: &mut Arena, kinetic: &Kinetic) -> Batch {
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
    let names = Matrix::symbols(arena, kinetic.frame.momentum(), n);
    matrix_batch(arena, &names, &momenta)
}

pub(super) fn matrix_batch(arena: &Arena, names: &Matrix, values: &[Vec<Polynomial>]) -> Batch {
    let name = |s: &Expr| arena.symbol_name(*s);
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
        let half = Rational::HALF;
        for i in 1..=kinetic.dim {
            let v = arena.symbol(Quantity::GivenVelocity.at([i]));
            energy.add_product(&Polynomial::term(vec![v, v], Rational::ONE), &mass, &half);
            inputs.push(v);
        }
    }
    (batch, inputs)
}
