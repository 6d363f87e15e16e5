//! Matrix forms that the derived components are compared with.

use super::{Formula, Notation, Sum, momentum_names, velocity_names};
use crate::algebra::ring::{Square, difference, outer, product, times, transpose};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Linear};
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::term::Frame;

/// A matrix or vector formula with its components.
pub(super) struct Known {
    pub(super) value: Formula,
    pub(super) shape: Shape,
    pub(super) components: Vec<Polynomial>,
}

/// What the constraints have to know of a formula.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Zero,
    /// `[X, O]` of a momentum and a velocity: in the algebra where both are.
    Commutator,
    Other,
}

/// Balance laws of section 4 and (3.1), as candidates to compare the derived equations with.
pub(super) fn known_forms(
    arena: &mut Arena,
    notation: &Notation,
    h: &Hamiltonian,
    chart: &Chart,
    o: &Square<Polynomial>,
) -> Vec<Known> {
    let n = chart.dim;
    let atoms = |rows: &Vec<Vec<Expr>>| -> Vec<Vec<Polynomial>> {
        rows.iter().map(|row| row.iter().map(|e| Polynomial::atom(*e)).collect()).collect()
    };
    let (phi, m) = (atoms(&chart.phi.0), atoms(&chart.m.0));
    let p: Vec<Polynomial> = chart.p.iter().map(|e| Polynomial::atom(*e)).collect();
    let (x, x_latex, ..) = momentum_names(chart.momentum);
    let (omega, omega_latex) = velocity_names(chart.momentum);
    let mut known = Vec::new();
    let mut add = |shape: Shape, text: String, latex: String, components: Vec<Polynomial>| {
        known.push(Known { value: Formula { text, latex }, shape, components });
    };
    add(Shape::Zero, "0".into(), "0".into(), vec![Polynomial::zero(); n]);
    add(Shape::Zero, "0".into(), "0".into(), vec![Polynomial::zero(); n * n]);
    let [comoving, spatial] = [product(&phi, o), product(o, &phi)].map(|velocity| velocity.concat());
    add(Shape::Other, format!("phi {omega}"), format!("\\varphi\\,{omega_latex}"), comoving);
    add(Shape::Other, format!("{omega} phi"), format!("{omega_latex}\\,\\varphi"), spatial);
    add(Shape::Other, "(dH/dPi)^T".into(), "(\\partial H/\\partial \\Pi)^T".into(), o.concat());
    let (xo, ox) = (product(&m, o), product(o, &m));
    let body_commutator = difference(&xo, &ox);
    let space_commutator = difference(&ox, &xo);
    let commutator = |a: &str, b: &str| format!("[{a}, {b}]");
    let body = (commutator(x, omega), commutator(x_latex, omega_latex));
    add(Shape::Commutator, body.0, body.1, body_commutator.concat());
    let space = (commutator(omega, x), commutator(omega_latex, x_latex));
    add(Shape::Commutator, space.0, space.1, space_commutator.concat());
    if let Some((frame, inverse_mass)) = &h.translation {
        known.extend(translation(arena, notation, chart, (*frame, inverse_mass), [&phi, &m, o], &p));
    }
    known
}

/// Those that the energy `|p_hat|^2/(2 m)` or `|p|^2/(2 m)` of the centre of mass has.
fn translation(
    arena: &mut Arena,
    notation: &Notation,
    chart: &Chart,
    (frame, inverse_mass): (Frame, &Polynomial),
    [phi, m, o]: [&Square<Polynomial>; 3],
    p: &[Polynomial],
) -> Vec<Known> {
    let n = chart.dim;
    let (x, x_latex, ..) = momentum_names(chart.momentum);
    let (omega, omega_latex) = velocity_names(chart.momentum);
    let comoving = chart.linear == Some(Linear::Body);
    let ph: Vec<Polynomial> = if comoving { p.to_vec() } else { times(&transpose(phi), p) };
    let scaled = |v: &[Polynomial]| -> Vec<Polynomial> { v.iter().map(|c| c.mul(inverse_mass)).collect() };
    // rest + coefficient * body
    let mut sum =
        |rest: (&str, &str), weight: &Polynomial, body: (&str, &str), components: Vec<Polynomial>| {
            let mut sum = Sum::default();
            if !rest.0.is_empty() {
                sum.push(false, rest.0, rest.1);
            }
            sum.add(arena, notation, weight, body);
            Known { value: sum.value(), shape: Shape::Other, components }
        };
    let (one, none) = (Polynomial::constant(Rational::ONE), ("", ""));
    let minus = inverse_mass.scaled(&Rational::MINUS_ONE);
    let phi_p =
        if comoving { ("phi p_hat", "\\varphi \\hat p") } else { ("phi phi^T p", "\\varphi \\varphi^T p") };
    let turned = (format!("{omega}^T p_hat"), format!("{omega_latex}^T \\hat p"));
    let mut list = vec![
        sum(none, inverse_mass, ("p", "p"), scaled(p)),
        sum(none, inverse_mass, phi_p, scaled(&times(phi, &ph))),
        sum(none, &one, (&turned.0, &turned.1), times(&transpose(o), p)),
    ];
    if frame == Frame::Body {
        let (xo, ox) = (product(m, o), product(o, m));
        let in_body = (format!("[{x}, {omega}]"), format!("[{x_latex}, {omega_latex}]"));
        let in_space = (format!("[{omega}, {x}]"), format!("[{omega_latex}, {x_latex}]"));
        let thrust = match comoving {
            true => ("p_hat p_hat^T", "\\hat p \\hat p^T"),
            false => ("(phi^T p) (phi^T p)^T", "(\\varphi^T p) (\\varphi^T p)^T"),
        };
        let zero = vec![vec![Polynomial::zero(); n]; n];
        let body = difference(&difference(&xo, &ox), &outer(&scaled(&ph), &ph));
        let space = difference(&difference(&ox, &xo), &outer(&scaled(&times(phi, &ph)), p));
        let flat = difference(&zero, &outer(&scaled(&ph), p));
        let spatial = ("phi phi^T p p^T", "\\varphi\\varphi^T p\\,p^T");
        list.extend([
            sum((&in_body.0, &in_body.1), &minus, thrust, body.concat()),
            sum((&in_space.0, &in_space.1), &minus, spatial, space.concat()),
            sum(none, &minus, ("phi^T p p^T", "\\varphi^T p\\,p^T"), flat.concat()),
        ]);
    }
    list
}
