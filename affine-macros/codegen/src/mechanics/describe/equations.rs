//! Affine velocity and Hamilton's equations, by matrices where a known form holds.

use super::hamiltonian::trace_coefficient;
use super::inertia::inertial;
use super::known_forms::{Shape, known_forms};
use super::{Notation, Sentence, Sum, Summand, momentum, velocity};
use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Linear, Momentum};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::equations::Form;
use crate::mechanics::forces::Forces;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::kinetics::Kinetics;
use crate::mechanics::notation::{Letter, letters, product, rate, slope, trace};
use crate::mechanics::potential::Potential;

/// Affine velocity and Hamilton's equations: as matrices where the known forms hold, by components otherwise.
/// A potential adds its generalised force, named.
pub fn equations(
    arena: &mut Arena,
    notation: &Notation,
    (h, kinetic): (&Hamiltonian, &Kinetic),
    (chart, full): (&Chart, &Polynomial),
    potential: Option<&Potential>,
    forces: &Forces,
) -> Vec<Sentence> {
    let kinetics = Kinetics::polynomial(arena, chart, full);
    // A tensor's velocity stays a symbol: written out, nothing in its commutators cancels.
    let form = if h.is_tensor() { Form::ThroughVelocity } else { Form::Expanded };
    let known = known_forms(arena, notation, h, chart, &kinetics.affine_velocity(form));
    // For the canonical momentum the velocity is the rate of phi itself.
    let mut list = match chart.momentum {
        Momentum::Canonical => Vec::new(),
        _ => vec![affine_velocity(arena, notation, (h, kinetic), chart)],
    };
    let names = force_names(arena, notation, h, chart, potential, forces);
    let mut written: Vec<Polynomial> = Vec::new();
    let mut projects = false;
    for group in groups(chart) {
        let derived: Vec<Polynomial> = group.coordinates.iter().map(|z| kinetics.rate(form, *z)).collect();
        let known = known.iter().find(|known| known.components == derived);
        let known = known.map(|known| (known.value.clone(), known.shape));
        let known = match (known, &group.coordinates[0], chart.momentum) {
            (Some((known, shape)), Coordinate::Phi(..), Momentum::Canonical) => {
                let inertial = inertial(arena, notation, h, kinetic).filter(|found| found.is_on_rows());
                Some((inertial.map_or(known, |inertial| inertial.velocity[1].clone()), shape))
            }
            (known, ..) => known,
        };
        let force = match group.coordinates[0] {
            Coordinate::P(_) => names[0].as_ref(),
            Coordinate::M(..) => names[1].as_ref(),
            Coordinate::X(_) | Coordinate::Phi(..) | Coordinate::Carried(_) => None,
        };
        match known {
            Some(known) => {
                let (mut value, shape) = with_force(known, force);
                if matches!(group.coordinates[0], Coordinate::M(..)) && h.constraint.is_some() {
                    (value, projects) = under_constraint(value, shape);
                }
                list.push(value.of(rate(group.of)));
            }
            None => {
                list.extend(group.rates(arena, notation, chart, &derived, force));
                written.extend(derived);
            }
        }
    }
    list.extend(names.into_iter().flatten().map(|(name, definition)| definition.of(name)));
    list.extend(notation.definitions(arena, written.iter()));
    list.extend(forces.formulas(arena, notation));
    list.extend(h.constraint.filter(|_| projects).map(projection));
    list
}

/// Coordinates that one matrix or vector equation is for.
struct Group {
    /// What they are the components of.
    of: Sentence,
    coordinates: Vec<Coordinate>,
}

/// The groups of a chart that are not empty.
fn groups(chart: &Chart) -> Vec<Group> {
    let linear = match chart.linear {
        Some(Linear::Body) => letters::COMOVING_LINEAR_MOMENTUM,
        _ => letters::LINEAR_MOMENTUM,
    };
    let all: [(Sentence, Vec<Coordinate>); 4] = [
        (letters::CENTRE.into(), (0..chart.x.len()).map(Coordinate::X).collect()),
        (letters::PLACEMENT.into(), pairs(chart.dim, Coordinate::Phi)),
        (linear.into(), (0..chart.p.len()).map(Coordinate::P).collect()),
        (momentum(chart.momentum), pairs(chart.dim, Coordinate::M)),
    ];
    let group = |(of, coordinates)| Group { of, coordinates };
    all.map(group).into_iter().filter(|group| !group.coordinates.is_empty()).collect()
}

impl Group {
    /// The equations of each of them.
    fn rates(
        &self,
        arena: &mut Arena,
        notation: &Notation,
        chart: &Chart,
        derived: &[Polynomial],
        force: Option<&ForceName>,
    ) -> Vec<Sentence> {
        let mut list = Vec::new();
        for (z, derived) in self.coordinates.iter().zip(derived) {
            let index = match z {
                Coordinate::M(a, b) | Coordinate::Phi(a, b) => format!("{}{}", a + 1, b + 1),
                Coordinate::X(i) | Coordinate::P(i) => format!("{}", i + 1),
                Coordinate::Carried(_) => String::new(),
            };
            let mut sum = Sum::default();
            sum.push(Summand::plus(notation.polynomial(arena, derived)));
            sum.extend(force.map(|(name, _)| Summand::plus(Sentence::Component(*name, index))));
            list.push(sum.of(rate(notation.scalar(arena, chart.symbol(*z)))));
        }
        list
    }
}

/// The rate of a group with the force by name.
fn with_force((kinetic, shape): (Sentence, Shape), force: Option<&ForceName>) -> (Sentence, Shape) {
    let Some((name, _)) = force else { return (kinetic, shape) };
    let mut sum = Sum::default();
    match shape {
        Shape::Zero => {}
        Shape::Commutator | Shape::Other => sum.push(Summand::plus(kinetic)),
    }
    sum.push(Summand::plus(*name));
    (sum.value(), Shape::Other)
}

/// What a constraint makes of the rate of the affine momentum, and whether that is a projection.
fn under_constraint(rate: Sentence, shape: Shape) -> (Sentence, bool) {
    match shape {
        // [X, O] of a momentum that is projected and a velocity in the algebra is projected already.
        Shape::Zero | Shape::Commutator => (rate, false),
        Shape::Other => (Sentence::Applied(letters::PROJECTION, vec![rate]), true),
    }
}

/// Name and definition of the generalised forces on the linear and the affine momentum.
type ForceName = (Letter, Sentence);

fn force_names(
    arena: &mut Arena,
    notation: &Notation,
    h: &Hamiltonian,
    chart: &Chart,
    potential: Option<&Potential>,
    forces: &Forces,
) -> [Option<ForceName>; 2] {
    let placement = || Sentence::from(letters::PLACEMENT);
    let (pull, push) = (
        slope(letters::POTENTIAL, letters::CENTRE),
        slope(letters::POTENTIAL, letters::PLACEMENT).transposed(),
    );
    let (linear, of_linear) = match chart.linear {
        Some(Linear::Body) => (letters::COMOVING_FORCE, product([placement().transposed(), pull])),
        _ => (letters::FORCE, pull),
    };
    let (affine, of_affine) = match chart.momentum {
        Momentum::Body => (letters::COMOVING_AFFINE_FORCE, product([push, placement()])),
        Momentum::Space | Momentum::Total => (letters::AFFINE_FORCE, product([placement(), push])),
        Momentum::Canonical => (letters::CANONICAL_FORCE, push),
    };
    let moves = potential.is_some_and(Potential::moves_the_centre);
    let (mut on_linear, mut on_affine) = (Vec::new(), Vec::new());
    on_linear.extend(moves.then(|| Summand::minus(of_linear)));
    if h.weight.is_some() {
        let share = &Rational::from(2) * &Rational::one_over(h.dim);
        let mut sum = Sum::default();
        let energy = product([letters::INTERNAL_ENERGY.into(), Sentence::One]);
        sum.add(arena, notation, &Polynomial::constant(share), energy);
        on_affine.push(Summand::plus(sum.value()));
    }
    on_affine.extend(potential.map(|_| Summand::minus(of_affine)));
    forces.name_on(chart, &mut on_linear, &mut on_affine);
    let joined = |name: Letter, parts: Vec<Summand>| {
        let mut sum = Sum::default();
        let acts = !parts.is_empty();
        sum.extend(parts);
        acts.then(|| (name, sum.value()))
    };
    [joined(linear, on_linear), joined(affine, on_affine)]
}

/// The inverse Legendre transformation.
fn affine_velocity(
    arena: &mut Arena,
    notation: &Notation,
    (h, kinetic): (&Hamiltonian, &Kinetic),
    chart: &Chart,
) -> Sentence {
    let (x, omega) = (|| momentum(chart.momentum), velocity(chart.momentum));
    let Some(iso) = &h.isotropic else {
        if let Some(inertial) = inertial(arena, notation, h, kinetic) {
            let [left, right] = inertial.velocity;
            return right.of(left);
        }
        return slope(letters::HAMILTONIAN, x()).transposed().of(omega);
    };
    let mut sum = Sum::default();
    let mut add = |coefficient: &Polynomial, body: Sentence| sum.add(arena, notation, coefficient, body);
    add(&iso.casimir2, x());
    add(&trace_coefficient(h, iso), product([trace(x()), Sentence::One]));
    let mut skew = Sum::default();
    skew.extend([Summand::plus(x()), Summand::minus(x().transposed())]);
    add(&iso.skew.neg(), skew.value());
    add(&iso.casimir3, x().power(2));
    sum.of(omega)
}

/// What the projection on the Lie algebra of a constraint is.
pub(in crate::mechanics) fn projection(group: Constraint) -> Sentence {
    let x = || Sentence::from(letters::SPIN_IN_THE_BODY);
    let mean = || Summand::plus(product([Sentence::OverDimension(Box::new(trace(x()))), Sentence::One]));
    let mut sum = Sum::default();
    let skew = || {
        let mut skew = Sum::default();
        skew.extend([Summand::plus(x()), Summand::minus(x().transposed())]);
        Summand::plus(Sentence::Over(Box::new(skew.value()), 2))
    };
    match group {
        Constraint::Isochoric => {
            sum.extend([Summand::plus(x()), Summand { negative: true, ..mean() }]);
        }
        Constraint::Rigid => sum.push(skew()),
        Constraint::Conformal => sum.extend([skew(), mean()]),
    }
    sum.of(product([letters::PROJECTION.into(), x()]))
}

fn pairs(n: usize, make: fn(usize, usize) -> Coordinate) -> Vec<Coordinate> {
    (0..n).flat_map(|i| (0..n).map(move |j| make(i, j))).collect()
}
