//! Lattices of stretches against the charts of placements.

use affine_oracle::Constraint;
use affine_tests::reference::norm;

use crate::case::{Case, T0, cases};
use crate::lattice::Lattices;
use crate::runs::{count, slope, through_the_chart};

/// Roundings of decompositions. The largest error seen is 1e-15.
const ROUNDING: f64 = 1e-13;
/// Differences of order 6 in steps of 2^-9. The largest error seen is 6e-12.
const DIFFERENCES: f64 = 1e-10;

fn balanced(case: &Case) -> bool {
    case.law.constraint == Some(Constraint::Isochoric)
}

/// The state that a phase point comes to, which moves by Hamilton's equations for a moment.
fn along_the_chart(case: &Case, lattices: &dyn Lattices, state: &[f64]) -> Vec<f64> {
    let full = lattices.full(state);
    let rates = case.subject.body.hamilton(T0, &full);
    let moved = |time: f64| -> Vec<f64> {
        full.iter().zip(&rates).map(|(value, rate)| value + time * rate).collect()
    };
    slope(|time| lattices.of_full(&moved(time), state))
}

/// Energies, equations with frames, and the way there and back.
#[test]
fn equations_of_lattices() {
    let mut tried = 0;
    for case in cases() {
        let Some(lattices) = &case.subject.two_polar else { continue };
        tried += 1;
        let state = lattices.start(balanced(&case));
        let full = lattices.full(&state);
        case.assert_close("there and back", &lattices.of_full(&full, &state), &state, norm(&state), ROUNDING);
        let energy = case.law.at(T0, &case.subject.body.point(&full).state()).energy;
        case.assert_close("H", &[lattices.energy(&state)], &[energy], energy.abs(), ROUNDING);
        let (found, expected) = (lattices.rates(&state), along_the_chart(&case, &**lattices, &state));
        case.assert_close("lattice", &found, &expected, norm(&expected), DIFFERENCES);
    }
    assert_eq!(tried, count("two_polar"));
}

/// Pieces of a lattice lead where Hamilton's equations do.
#[test]
fn pieces_of_lattices() {
    let time = 0.25;
    let mut tried = 0;
    for case in cases() {
        let (Some(lattices), Some(pieces)) = (&case.subject.two_polar, &case.subject.pieces) else {
            continue;
        };
        tried += 1;
        let state = lattices.start(balanced(&case));
        let end = through_the_chart(&case, &lattices.full(&state), time);
        let error = |steps: u32| {
            let found = pieces.after(&state, 4, time, time / f64::from(steps));
            let expected = lattices.of_full(&end, &found);
            norm(&found.iter().zip(&expected).map(|(f, e)| f - e).collect::<Vec<f64>>())
        };
        let [coarse, fine] = [error(4), error(8)];
        let seen = (coarse / fine).log2();
        assert!(
            fine < 1e-4 && (fine < 1e-10 || seen > 3.25),
            "{}: {coarse:e} {fine:e}, order {seen}",
            case.name
        );
    }
    assert_eq!(
        tried,
        cases()
            .iter()
            .filter(|case| case.subject.two_polar.is_some() && case.subject.splitting.is_some())
            .count()
    );
}

/// In ratios, the rates are those of the lattice.
#[test]
fn ratios_of_stretches() {
    let mut tried = 0;
    for case in cases() {
        let (Some(lattices), Some(ratios)) = (&case.subject.two_polar, &case.subject.ratios) else {
            continue;
        };
        tried += 1;
        let n = case.dim();
        let state = lattices.start(balanced(&case));
        let rates = lattices.rates(&state);
        // Two couplings stand before the places of the plane.
        let before = if n == 2 { 2 } else { 0 };
        let (places, speeds) = (&state[before..], &rates[before..]);
        let (found, inverse_alpha, mean) = ratios.rates(&state);
        let stretched = (1..n).map(|b| (places[b] - places[b - 1]).exp() * (speeds[b] - speeds[b - 1]));
        let momenta = speeds[n..2 * n].iter().map(|rate| rate * inverse_alpha);
        let expected: Vec<f64> = stretched.chain(momenta).collect();
        case.assert_close("ratios", &found, &expected, norm(&expected), ROUNDING);
        let expected = speeds[..n].iter().sum::<f64>() / n as f64;
        case.assert_close("the mean", &[mean], &[expected], 1.0, ROUNDING);
    }
    assert_eq!(tried, count("ratios"));
}
