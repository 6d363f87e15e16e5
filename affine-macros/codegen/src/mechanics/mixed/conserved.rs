//! What a mixed energy conserves.
//!
//! The brackets with `H` are rational functions of the coordinates whose written-out form would be long. They are
//! evaluated modulo the prime `2^61 - 1` at two points that have nothing to do with the model: a bracket that does not
//! vanish identically vanishes at both with a probability below `(degree/2^61)^2` (Schwartz, J. ACM 27 (1980) 701),
//! about 1e-33.

use crate::algebra::evaluate::Field;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, adjugate, product, table};
use crate::algebra::{Arena, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Momentum};
use crate::mechanics::conserved::{Candidate, conserved_at_points};
use crate::mechanics::equations::Load;
use crate::mechanics::flow::{Flow, Push};
use crate::mechanics::group_point::POINTS;
use crate::mechanics::metric::Definitions;

use super::sample::Sample;

/// The candidates whose brackets with `H` vanish; `slopes` are the derivatives of `H` in a chart with spatial `p`,
/// polynomials in coordinates and `shared` quantities.
#[must_use]
pub fn conserved(
    arena: &Arena,
    chart: &Chart,
    slopes: &[(Coordinate, Polynomial)],
    shared: &Definitions,
) -> Vec<Candidate> {
    let points = points(arena, chart, shared);
    let values: Vec<_> = points.iter().map(|point| |p: &Polynomial| point.value(arena, p)).collect();
    let values: Vec<&dyn Fn(&Polynomial) -> Residue> = values.iter().map(|value| value as _).collect();
    conserved_at_points(chart, slopes, &values)
}

/// Those of the candidates that forces leave at rest, but for the energy, which they take: the rates that they give are
/// linear in the momenta, or of degree 2 for a norm, and those of `H` one degree above, so that each vanish for
/// themselves.
#[must_use]
pub fn unmoved(
    arena: &Arena,
    chart: &Chart,
    load: &Load,
    shared: &Definitions,
    mut candidates: Vec<Candidate>,
) -> Vec<Candidate> {
    candidates.retain(|candidate| *candidate != Candidate::Energy);
    let defined = [shared.clone(), load.shared.clone()].concat();
    for point in points(arena, chart, &defined) {
        let value = |p: &Polynomial| point.value(arena, p);
        let flow = Flow::vertical(chart, push(chart, load, &value), &value);
        candidates.retain(|candidate| flow.leaves(*candidate));
    }
    candidates
}

fn points(arena: &Arena, chart: &Chart, shared: &Definitions) -> Vec<Sample> {
    let mut points: Vec<Sample> = match chart.confined {
        None => ["first.", "second."].map(Sample::generic).to_vec(),
        Some(group) => (0..POINTS).map(|seed| Sample::on_the_group(arena, chart, group, seed)).collect(),
    };
    points.iter_mut().for_each(|point| point.define(arena, shared));
    points
}

/// The forces on `p` and `Pi`, times `det phi` where the affine momentum of the chart is not `Pi`.
fn push(chart: &Chart, load: &Load, value: &dyn Fn(&Polynomial) -> Residue) -> Push<Residue> {
    let force = |z: Coordinate| {
        let found = load.forces.iter().filter(|(known, _)| *known == z);
        found.fold(Residue::ZERO, |sum, (_, force)| sum.add(&value(force)))
    };
    let own = table(chart.dim, |a, b| force(Coordinate::M(a, b)));
    let p: Vec<Residue> = (0..chart.p.len()).map(|i| force(Coordinate::P(i))).collect();
    if chart.momentum == Momentum::Canonical {
        return Push { p, pi: own };
    }
    let phi = table(chart.dim, |i, a| value(&Polynomial::atom(chart.phi.0[i][a])));
    let cofactors = adjugate(&phi);
    let mut det = Residue::ZERO;
    phi[0].iter().zip(&cofactors).for_each(|(entry, row)| det.plus_product(entry, &row[0], &Rational::ONE));
    let pi = match chart.momentum {
        Momentum::Body => product(&own, &cofactors),
        _ => product(&cofactors, &own),
    };
    Push { p: p.iter().map(|force| force.mul(&det)).collect(), pi }
}
