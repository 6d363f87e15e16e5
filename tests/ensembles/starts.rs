//! Starts that are drawn.

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;
use affine_runtime::starts::{Gaussian, MomentumLevel, latin_hypercube};
use rand::SeedableRng;
use rand::distr::Distribution;
use rand::rngs::StdRng;

use crate::models::{DrunkMissile, Elastic, Sampled, Unprotected};

const DRAWN: usize = 20_000;
/// A mean of that many, over the standard deviation of one: six standard deviations.
const MEAN: f64 = 6.0 / 141.4;

fn random() -> StdRng {
    StdRng::seed_from_u64(91)
}

/// Mean and standard deviation of each kind of number; the placement is so far from the boundary that none is drawn again.
#[test]
fn gaussian_starts_have_the_deviations_that_were_asked_for() {
    let point = Unprotected.samples(1, 92)[0];
    let around = Gaussian::around(&Unprotected, point)
        .placement(0.05)
        .momentum(0.2)
        .position(0.3)
        .linear_momentum(0.4);
    let points: Vec<_> = around.sample_iter(random()).take(DRAWN).collect();
    let centre = Unprotected.flatten(&point);
    let deviations = [0.3, 0.3, 0.05, 0.05, 0.05, 0.05, 0.4, 0.4, 0.2, 0.2, 0.2, 0.2];
    for place in 0..12 {
        let off: Vec<f64> =
            points.iter().map(|point| Unprotected.flatten(point)[place] - centre[place]).collect();
        let mean = off.iter().sum::<f64>() / DRAWN as f64;
        let square = off.iter().map(|off| off * off).sum::<f64>() / DRAWN as f64;
        // The order of numbers is that of the model.
        let deviation = deviations
            .into_iter()
            .min_by(|a, b| (a - square.sqrt()).abs().total_cmp(&(b - square.sqrt()).abs()));
        let deviation = deviation.unwrap();
        assert!(mean.abs() < MEAN * deviation, "{place}: {mean}");
        assert!((square.sqrt() / deviation - 1.0).abs() < MEAN, "{place}: {} and {deviation}", square.sqrt());
    }
    let of = |number: fn(&<Unprotected as Model<2>>::Point<f64>) -> f64| {
        let off = points.iter().map(|drawn| (number(drawn) - number(&point)).powi(2));
        (off.sum::<f64>() / DRAWN as f64).sqrt()
    };
    let found = [of(|p| p.phi()[(0, 1)]), of(|p| p.pi().0.0[(1, 0)]), of(|p| p.x()[1]), of(|p| p.p()[0])];
    for (found, asked) in found.into_iter().zip([0.05, 0.2, 0.3, 0.4]) {
        assert!((found / asked - 1.0).abs() < MEAN, "{found} and {asked}");
    }
    let wide = Gaussian::around(&Unprotected, point).placement(2.0);
    assert!(wide.sample_iter(random()).take(500).all(|point| point.phi().determinant() > 0.0));
    assert_eq!(Gaussian::around(&Unprotected, point).sample(&mut random()), point);
    // Nothing near a mirrored point is a placement, and what is drawn is one that a run refuses.
    let mut mirrored = Unprotected.flatten(&point);
    (2..4).for_each(|k| mirrored[k] = -mirrored[k]);
    let near = Gaussian::around(&Unprotected, Unprotected.unflatten(&mirrored)).placement(1e-3);
    assert!(near.sample(&mut random()).phi().determinant() < 0.0);
}

/// Energies are those of the level, and each direction has its part of them: `T = |p|^2/2 + |Pi|^2/2`, six directions in all.
#[test]
fn starts_of_a_level_of_energy_are_spread_evenly() {
    let (point, t) = (Unprotected.samples(1, 93)[0], 0.7);
    let rest = Unprotected
        .at_momentum(point.x(), *point.phi(), Vector::<2>::zeros(), TwoPoint(Matrix::<2>::zeros()))
        .unwrap();
    let free = 1.7;
    let energy = Unprotected.hamiltonian(t, &rest) + free;
    let level = MomentumLevel::of_energy(&Unprotected, (t, point), energy).unwrap();
    let points: Vec<_> = level.sample_iter(random()).take(DRAWN).collect();
    let mut parts = [0.0; 6];
    for drawn in &points {
        assert!((Unprotected.hamiltonian(t, drawn) - energy).abs() < 1e-13);
        assert_eq!((drawn.phi(), drawn.x()), (point.phi(), point.x()));
        let pi = drawn.pi().0.0;
        let momenta = [drawn.p()[0], drawn.p()[1], pi[(0, 0)], pi[(0, 1)], pi[(1, 0)], pi[(1, 1)]];
        parts.iter_mut().zip(momenta).for_each(|(part, momentum)| *part += 0.5 * momentum * momentum);
    }
    for part in parts {
        assert!((part / DRAWN as f64 - free / 6.0).abs() < MEAN * free / 2.0, "{part}");
    }
    assert!(MomentumLevel::of_energy(&Unprotected, (t, point), energy - 1.01 * free).is_none());
    // Another frame, and a mass matrix that is full; in space.
    let point = DrunkMissile.samples(1, 94)[0];
    let energy = DrunkMissile.hamiltonian(0.0, &point);
    let level = MomentumLevel::of_energy(&DrunkMissile, (0.0, point), energy).unwrap();
    for drawn in level.sample_iter(random()).take(100) {
        assert!((DrunkMissile.hamiltonian(0.0, &drawn) / energy - 1.0).abs() < 1e-12);
    }
}

/// A heavy centre beside a light deformation, under a potential that is large where nothing moves.
#[affine_model(
    dim = 2,
    kinetic(body_inertia = 1, casimir2 = 0.2, body_translation = m),
    potential = offset + 0.1*q^2,
    emit(lanes),
)]
struct Offset {
    m: f64,
    offset: f64,
}

/// Neither the unit of mass nor the zero of energies makes a difference: a twelfth of the kinetic energy, or a sixth in the plane,
/// is in each direction.
#[test]
fn a_level_of_energy_is_found_in_any_units() {
    for (m, offset) in [(2.0, 0.0), (1e-200, 0.0), (1e100, 0.0), (1e200, 0.0), (2.0, 1e9)] {
        let model = Offset { m, offset }.prepare().unwrap();
        let zero = Vector::<2>::zeros();
        let rest = model.at_velocity(zero, Matrix::<2>::identity(), zero, Matrix::<2>::zeros()).unwrap();
        let level = MomentumLevel::of_energy(&model, (0.0, rest), offset + 3.0).unwrap();
        let mut of_centre = 0.0;
        for drawn in level.sample_iter(random()).take(DRAWN) {
            let velocity = model.velocity(&drawn);
            let part = 0.5 * drawn.p().dot(&velocity.x_dot);
            let whole = part + 0.5 * (drawn.pi().0.0 * velocity.phi_dot).trace();
            assert!((whole - 3.0).abs() < 1e-13, "{m:e}, {offset:e}: {whole}");
            of_centre += part;
        }
        assert!((of_centre / DRAWN as f64 - 1.0).abs() < 2.0 * MEAN, "{m:e}: {of_centre}");
    }
}

/// What is drawn with a deviation that is no number has no numbers, and its run says so.
#[test]
fn a_deviation_that_is_no_number_is_found_by_the_run() {
    let point = Unprotected.samples(1, 97)[0];
    for deviation in [f64::NAN, f64::INFINITY] {
        let starts = Gaussian::around(&Unprotected, point).placement(deviation).sample_iter(random()).take(3);
        let ends = Ensemble::new(&Unprotected, starts).until(0.1).run().unwrap();
        assert!(
            ends.iter().all(|end| end.as_ref().is_err_and(|stop| stop.reason == Reason::NotFinite)),
            "{ends:?}"
        );
    }
}

#[test]
fn starts_of_a_level_of_momentum_are_spread_evenly() {
    let point = Elastic.samples(1, 95)[0];
    let level = MomentumLevel::of_norm(&Elastic, point, 0.8);
    let mut squares = Matrix::<3>::zeros();
    for drawn in level.sample_iter(random()).take(DRAWN) {
        let pi = drawn.pi().0.0;
        assert!((pi.norm() - 0.8).abs() < 1e-14 && drawn.phi() == point.phi());
        squares += pi.component_mul(&pi);
    }
    for square in squares.iter() {
        assert!((square / DRAWN as f64 - 0.64 / 9.0).abs() < MEAN * 0.64 / 9.0 * 2.0, "{square}");
    }
    let moving = Unprotected.samples(1, 95)[0];
    let drawn = MomentumLevel::of_norm(&Unprotected, moving, 0.8).sample(&mut random());
    assert_eq!((drawn.x(), drawn.p()), (moving.x(), moving.p()));
}

#[test]
fn every_part_of_every_side_has_one_place() {
    let bounds = [(0.0, 1.0), (-3.0, 5.0), (10.0, 10.5), (-1e308, 1e308), (f64::MAX, -f64::MAX)];
    let places = latin_hypercube(&mut random(), 40, &bounds);
    assert_eq!(places.len(), 40);
    for (side, (low, high)) in bounds.iter().enumerate() {
        let part = |number: f64| 40.0 * ((0.5 * number - 0.5 * low) / (0.5 * high - 0.5 * low));
        let mut parts: Vec<usize> = places.iter().map(|place| part(place[side]) as usize).collect();
        assert_ne!(parts, (0..40).collect::<Vec<_>>(), "not in order");
        parts.sort_unstable();
        assert_eq!(parts, (0..40).collect::<Vec<_>>());
    }
    assert!(latin_hypercube(&mut random(), 0, &bounds).is_empty());
}
