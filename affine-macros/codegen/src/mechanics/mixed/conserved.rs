//! What a mixed energy conserves.
//!
//! The brackets with `H` are rational functions of the coordinates whose written-out form would be long. They are
//! evaluated modulo the prime `2^61 - 1` at two points that have nothing to do with the model: a bracket that does not
//! vanish identically vanishes at both with a probability below `(degree/2^61)^2` (Schwartz, J. ACM 27 (1980) 701),
//! about 1e-33.

use crate::algebra::{Arena, Polynomial};
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::conserved::{Candidate, conserved_at_points};
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
    let points = ["first.", "second."].map(|name| {
        let mut point = Sample::generic(name);
        point.define(arena, shared);
        point
    });
    let [first, second] = points.each_ref().map(|point| |p: &Polynomial| point.value(arena, p));
    conserved_at_points(chart, slopes, &[&first, &second])
}
