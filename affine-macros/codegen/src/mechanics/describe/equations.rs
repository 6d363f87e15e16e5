//! Affine velocity and Hamilton's equations, by matrices where a known form holds.

use super::forces::{on_affine, on_linear};
use super::hamiltonian::trace_coefficient;
use super::inertia::inertial;
use super::known_forms::{Shape, known_forms};
use super::{Notation, Sentence, Sum, Summand, momentum, velocity};
use crate::algebra::ring::pairs;
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
use crate::mechanics::term::Frame;

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
    let (mut list, mut projects) = match chart.momentum {
        Momentum::Canonical => (Vec::new(), false),
        _ => {
            let (velocity, projects) = affine_velocity(arena, notation, (h, kinetic), chart);
            (vec![velocity], projects)
        }
    };
    let names = force_names(arena, notation, h, chart, potential, forces);
    let mut written: Vec<Polynomial> = Vec::new();
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
                    let is_projected;
                    (value, is_projected) = under_constraint(value, shape);
                    projects |= is_projected;
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
        (letters::PLACEMENT.into(), pairs(chart.dim).map(|(i, a)| Coordinate::Phi(i, a)).collect()),
        (linear.into(), (0..chart.p.len()).map(Coordinate::P).collect()),
        (momentum(chart.momentum), pairs(chart.dim).map(|(a, b)| Coordinate::M(a, b)).collect()),
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
            let mut sum = Sum::new([Summand::plus(notation.polynomial(arena, derived))]);
            sum.extend(force.map(|(name, _)| Summand::plus(Sentence::Component(*name, index))));
            list.push(sum.of(rate(notation.scalar(arena, chart.symbol(*z)))));
        }
        list
    }
}

/// The rate of a group with the force by name.
fn with_force((kinetic, shape): (Sentence, Shape), force: Option<&ForceName>) -> (Sentence, Shape) {
    let Some((name, _)) = force else { return (kinetic, shape) };
    let kinetic = (shape != Shape::Zero).then(|| Summand::plus(kinetic));
    let sum = Sum::new(kinetic.into_iter().chain([Summand::plus(*name)]));
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
    let linear = match chart.linear {
        Some(Linear::Body) => letters::COMOVING_FORCE,
        _ => letters::FORCE,
    };
    let affine = match chart.frame() {
        Frame::Body => letters::COMOVING_AFFINE_FORCE,
        Frame::Space => letters::AFFINE_FORCE,
        Frame::Flat => letters::CANONICAL_FORCE,
    };
    let (mut pulls, mut pushes) = (Vec::new(), Vec::new());
    if potential.is_some_and(Potential::moves_the_centre) {
        let pull = slope(letters::POTENTIAL, letters::CENTRE);
        pulls.push(Summand::minus(on_linear(chart, pull)));
    }
    if h.weight.is_some() {
        let share = &Rational::from(2) * &Rational::one_over(h.dim);
        let mut sum = Sum::default();
        let energy = product([letters::INTERNAL_ENERGY.into(), Sentence::One]);
        sum.add(arena, notation, &Polynomial::constant(share), energy);
        pushes.push(Summand::plus(sum.value()));
    }
    if potential.is_some() {
        let push = slope(letters::POTENTIAL, letters::PLACEMENT).transposed();
        pushes.push(Summand::minus(on_affine(chart, push)));
    }
    forces.name_on(chart, &mut pulls, &mut pushes);
    let joined =
        |name: Letter, parts: Vec<Summand>| (!parts.is_empty()).then(|| (name, Sum::new(parts).value()));
    [joined(linear, pulls), joined(affine, pushes)]
}

/// The inverse Legendre transformation, and whether that is a projection.
fn affine_velocity(
    arena: &mut Arena,
    notation: &Notation,
    (h, kinetic): (&Hamiltonian, &Kinetic),
    chart: &Chart,
) -> (Sentence, bool) {
    let (x, omega) = (|| momentum(chart.momentum), velocity(chart.momentum));
    let Some(iso) = &h.isotropic else {
        if let Some(inertial) = inertial(arena, notation, h, kinetic) {
            let [left, right] = inertial.velocity;
            return (right.of(left), false);
        }
        // Of momenta in the algebra: any function of matrices that is H there has the same projection of its slope.
        let slope = slope(letters::HAMILTONIAN, x()).transposed();
        let (value, projects) = match h.constraint {
            Some(_) => under_constraint(slope, Shape::Other),
            None => (slope, false),
        };
        return (value.of(omega), projects);
    };
    let mut sum = Sum::default();
    let mut add = |coefficient: &Polynomial, body: Sentence| sum.add(arena, notation, coefficient, body);
    add(&iso.casimir2, x());
    add(&trace_coefficient(h, iso), product([trace(x()), Sentence::One]));
    add(&iso.skew.neg(), skew(x()));
    add(&iso.casimir3, x().power(2));
    (sum.of(omega), false)
}

/// What the projection on the Lie algebra of a constraint is.
pub(in crate::mechanics) fn projection(group: Constraint) -> Sentence {
    let x = || Sentence::from(letters::SPIN_IN_THE_BODY);
    let mean = || Summand::plus(product([Sentence::OverDimension(Box::new(trace(x()))), Sentence::One]));
    let half_skew = || Summand::plus(Sentence::Over(Box::new(skew(x())), 2));
    let sum = match group {
        Constraint::Isochoric => Sum::new([Summand::plus(x()), Summand { negative: true, ..mean() }]),
        Constraint::Rigid => Sum::new([half_skew()]),
        Constraint::Conformal => Sum::new([half_skew(), mean()]),
    };
    sum.of(product([letters::PROJECTION.into(), x()]))
}

/// `x - x^T`.
fn skew(x: Sentence) -> Sentence {
    Sum::new([Summand::plus(x.clone()), Summand::minus(x.transposed())]).value()
}
