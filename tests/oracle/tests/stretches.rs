//! The oracle's stretches against functions of them that need no eigenvalues, also where they coincide.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_oracle::{Differential, Place, Random, Slopes};

/// Random placements, and one turned and scaled, whose stretches coincide.
fn placements(n: usize) -> Vec<Vec<f64>> {
    let turned: Vec<f64> = match n {
        2 => vec![1.2, -1.6, 1.6, 1.2],
        _ => vec![1.2, -1.6, 0.0, 1.6, 1.2, 0.0, 0.0, 0.0, 2.0],
    };
    let mut list: Vec<Vec<f64>> = (0..6).map(|seed| Random::new(90 + seed).placement(n).to_f64()).collect();
    list.push(turned);
    list
}

fn sum(terms: impl IntoIterator<Item = Differential>) -> Differential {
    terms.into_iter().fold(Differential::constant(0.0), |sum, term| sum + term)
}

#[test]
fn symmetric_functions() {
    type Route = fn(&Place) -> Differential;
    let routes: [(Route, Route); 4] = [
        (|place| sum(place.log_stretches()), |place| place.det().ln()),
        (|place| sum(place.stretches().into_iter().map(|q| q * q)), Place::trace_green),
        (|place| sum(place.stretches().into_iter().map(|q| q.power(4))), Place::trace_green_squared),
        // sum over a < b of (Q_a/Q_b)^2 + (Q_b/Q_a)^2 = tr G tr G^-1 - n; cosh(2d) is half of each.
        (
            |place| place.pairs(|d| (d * 2.0).cosh()) * 2.0 + place.n(),
            |place| {
                let inverse_trace = match place.n() as usize {
                    2 => place.trace_green() / place.det().power(2),
                    _ => {
                        let square = place.trace_green() * place.trace_green();
                        (square - place.trace_green_squared()) * 0.5 / place.det().power(2)
                    }
                };
                place.trace_green() * inverse_trace
            },
        ),
    ];
    for n in [2, 3] {
        for phi in placements(n) {
            for (stretches, other) in routes {
                let zero = vec![0.0; n];
                let [found, expected] = [stretches, other].map(|route| Slopes::of(&route, 0.0, &zero, &phi));
                let size =
                    expected.phi.iter().fold(1.0 + expected.value.abs(), |size, slope| size + slope.abs());
                let tolerance = 1e-10 * size;
                assert!((found.value - expected.value).abs() <= tolerance, "{found:?} {expected:?}");
                for (slope, other) in found.phi.iter().zip(&expected.phi) {
                    assert!((slope - other).abs() <= tolerance, "{phi:?}: {found:?} {expected:?}");
                }
            }
        }
    }
}
