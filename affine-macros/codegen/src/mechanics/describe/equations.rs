//! Affine velocity and Hamilton's equations, by matrices where a known form holds.

use super::hamiltonian::trace_coefficient;
use super::inertia::inertial;
use super::known_forms::{Shape, known_forms};
use super::{Formula, Notation, Sum, Summand, momentum_names, velocity_names};
use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Linear, Momentum};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::equations::Form;
use crate::mechanics::forces::Forces;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::kinetics::Kinetics;
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
) -> Vec<Formula> {
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
                list.push(value.of(group.left.0, group.left.1));
            }
            None => {
                list.extend(group.rates(arena, notation, chart, &derived, force));
                written.extend(derived);
            }
        }
    }
    for (name, name_latex, definition) in names.into_iter().flatten() {
        list.push(definition.of(name, name_latex));
    }
    list.extend(notation.definitions(arena, written.iter()));
    list.extend(forces.formulas(arena, notation));
    let projection = h.constraint.filter(|_| projects).map(Constraint::projection);
    list.extend(projection.map(|(text, latex)| Formula { text: text.to_owned(), latex: latex.to_owned() }));
    list
}

/// Coordinates that one matrix or vector equation is for.
struct Group {
    /// Their rate, in text and LaTeX.
    left: (&'static str, &'static str),
    coordinates: Vec<Coordinate>,
}

/// The groups of a chart that are not empty.
fn groups(chart: &Chart) -> Vec<Group> {
    let (_, _, rate, rate_latex) = momentum_names(chart.momentum);
    let linear = match chart.linear {
        Some(Linear::Body) => ("dp_hat/dt", "\\dot{\\hat p}"),
        _ => ("dp/dt", "\\dot p"),
    };
    let all = [
        (("dx/dt", "\\dot x"), (0..chart.x.len()).map(Coordinate::X).collect()),
        (("dphi/dt", "\\dot\\varphi"), pairs(chart.dim, Coordinate::Phi)),
        (linear, (0..chart.p.len()).map(Coordinate::P).collect()),
        ((rate, rate_latex), pairs(chart.dim, Coordinate::M)),
    ];
    let group =
        |(left, coordinates): ((&'static str, &'static str), Vec<Coordinate>)| Group { left, coordinates };
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
    ) -> Vec<Formula> {
        let mut list = Vec::new();
        for (z, rate) in self.coordinates.iter().zip(derived) {
            let left = notation.formula(arena, chart.symbol(*z));
            let Formula { text, latex } = notation.polynomial(arena, rate);
            let index = match z {
                Coordinate::M(a, b) | Coordinate::Phi(a, b) => format!("{}{}", a + 1, b + 1),
                Coordinate::X(i) | Coordinate::P(i) => format!("{}", i + 1),
                Coordinate::Carried(_) => String::new(),
            };
            let (text, latex) = match force {
                None => (text, latex),
                Some((name, name_latex, _)) => {
                    (format!("{text} + {name}_{index}"), format!("{latex} + {name_latex}_{{{index}}}"))
                }
            };
            let right = Formula { text, latex };
            list.push(right.of(&format!("d{}/dt", left.text), &format!("\\dot{{{}}}", left.latex)));
        }
        list
    }
}

/// The rate of a group with the force by name.
fn with_force((kinetic, shape): (Formula, Shape), force: Option<&ForceName>) -> (Formula, Shape) {
    let Some((name, name_latex, _)) = force else { return (kinetic, shape) };
    let with = |kinetic: String, force: &str| match shape {
        Shape::Zero => force.to_owned(),
        Shape::Commutator | Shape::Other => format!("{kinetic} + {force}"),
    };
    (Formula { text: with(kinetic.text, name), latex: with(kinetic.latex, name_latex) }, Shape::Other)
}

/// What a constraint makes of the rate of the affine momentum, and whether that is a projection.
fn under_constraint(rate: Formula, shape: Shape) -> (Formula, bool) {
    let Formula { text, latex } = rate;
    match shape {
        // [X, O] of a momentum that is projected and a velocity in the algebra is projected already.
        Shape::Zero | Shape::Commutator => (Formula { text, latex }, false),
        Shape::Other => {
            let latex = format!("P\\left({latex}\\right)");
            (Formula { text: format!("P({text})"), latex }, true)
        }
    }
}

/// Name in text and LaTeX, and definition, of the generalised forces on the linear and the affine momentum.
type ForceName = (&'static str, &'static str, Formula);

fn force_names(
    arena: &mut Arena,
    notation: &Notation,
    h: &Hamiltonian,
    chart: &Chart,
    potential: Option<&Potential>,
    forces: &Forces,
) -> [Option<ForceName>; 2] {
    let (linear, of_linear) = match chart.linear {
        Some(Linear::Body) => (("F_hat", "\\hat F"), ("phi^T dU/dx", "\\varphi^T \\partial U/\\partial x")),
        _ => (("F", "F"), ("dU/dx", "\\partial U/\\partial x")),
    };
    let (affine, of_affine) = match chart.momentum {
        Momentum::Body => {
            (("Q_hat", "\\hat Q"), ("(dU/dphi)^T phi", "(\\partial U/\\partial\\varphi)^T \\varphi"))
        }
        Momentum::Space | Momentum::Total => {
            (("Q", "Q"), ("phi (dU/dphi)^T", "\\varphi (\\partial U/\\partial\\varphi)^T"))
        }
        Momentum::Canonical => (("N", "N"), ("(dU/dphi)^T", "(\\partial U/\\partial\\varphi)^T")),
    };
    let moves = potential.is_some_and(Potential::moves_the_centre);
    let (mut on_linear, mut on_affine) = (Vec::new(), Vec::new());
    on_linear.extend(moves.then(|| Summand::minus(of_linear.0, of_linear.1)));
    if h.weight.is_some() {
        let share = &Rational::from(2) * &Rational::one_over(h.dim);
        let mut sum = Sum::default();
        sum.add(arena, notation, &Polynomial::constant(share), ("T_int 1", "T_{\\mathrm{int}}\\,1"));
        let Formula { text, latex } = sum.value();
        on_affine.push(Summand::plus(text, latex));
    }
    on_affine.extend(potential.map(|_| Summand::minus(of_affine.0, of_affine.1)));
    forces.name_on(chart, &mut on_linear, &mut on_affine);
    let joined = |(name, latex): (&'static str, &'static str), parts: Vec<Summand>| {
        let mut sum = Sum::default();
        sum.extend(&parts);
        (!parts.is_empty()).then(|| (name, latex, sum.value()))
    };
    [joined(linear, on_linear), joined(affine, on_affine)]
}

/// The inverse Legendre transformation.
fn affine_velocity(
    arena: &mut Arena,
    notation: &Notation,
    (h, kinetic): (&Hamiltonian, &Kinetic),
    chart: &Chart,
) -> Formula {
    let (x, x_latex, ..) = momentum_names(chart.momentum);
    let (omega, omega_latex) = velocity_names(chart.momentum);
    let Some(iso) = &h.isotropic else {
        if let Some(inertial) = inertial(arena, notation, h, kinetic) {
            let [left, right] = inertial.velocity;
            return right.of(&left.text, &left.latex);
        }
        return Formula {
            text: format!("{omega} = (dH/d{x})^T"),
            latex: format!("{omega_latex} = (\\partial H/\\partial {x_latex})^T"),
        };
    };
    let mut sum = Sum::default();
    let mut add = |coefficient: &Polynomial, text: &str, latex: &str| {
        sum.add(arena, notation, coefficient, (text, latex));
    };
    add(&iso.casimir2, x, x_latex);
    let trace = (format!("tr({x}) 1"), format!("\\operatorname{{tr}}({x_latex})\\,1"));
    add(&trace_coefficient(h, iso), &trace.0, &trace.1);
    let skew = (format!("({x} - {x}^T)"), format!("({x_latex} - {x_latex}^T)"));
    add(&iso.skew.scaled(&Rational::MINUS_ONE), &skew.0, &skew.1);
    add(&iso.casimir3, &format!("{x}^2"), &format!("{x_latex}^2"));
    sum.of(omega, omega_latex)
}

fn pairs(n: usize, make: fn(usize, usize) -> Coordinate) -> Vec<Coordinate> {
    (0..n).flat_map(|i| (0..n).map(move |j| make(i, j))).collect()
}
