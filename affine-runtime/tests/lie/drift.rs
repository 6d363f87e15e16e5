//! Long runs stay on the group as well as rounding allows: no projection holds them there.

use affine_integrators::gauss::Tableau;
use affine_integrators::lie::Chart;
use affine_integrators::radau::{self, Differences};
use affine_integrators::{Gauss, Radau, RungeKutta8};
use affine_runtime::frames::Matrix;
use affine_runtime::model::{Constraint, Group, Quantity};

use crate::curve::{GROUPS, defect, project, write};

/// Unoptimised, a part of them: the bound grows with the root of the number of steps.
const STEPS: u64 = if cfg!(debug_assertions) { 3_000 } else { 100_000 };

const PLACEMENT: &[Group] = &[Group::new(Quantity::Placement, 9)];

/// `phi' = phi P(A sin t + B cos t phi^T phi + ...)`: bounded, neither periodic nor constant.
fn equations(constraint: Constraint) -> impl Fn(f64, &[f64; 9]) -> [f64; 9] {
    move |t, y| {
        let phi = Matrix::<3>::from_row_slice(y);
        let a = Matrix::<3>::new(0.1, 0.9, -0.4, 0.3, -0.5, 0.2, 0.7, -0.6, 0.4);
        // What pulls the strain back: large stretches would amplify roundings, as they do anything else.
        let gram = phi.transpose() * phi;
        let oh = project(constraint, &(a * (1.1 * t).sin() + a.transpose() * a * t.cos() - gram * 0.5));
        let mut rates = [0.0; 9];
        write(&mut rates, &(phi * oh));
        rates
    }
}

/// Largest defect: over the first hundredth of the run and over all of it.
fn largest(constraint: Constraint, mut advance: impl FnMut() -> [f64; 9]) -> [f64; 2] {
    let mut largest = [0.0f64; 2];
    for step in 0..STEPS {
        let defect = defect(constraint, &Matrix::<3>::from_row_slice(&advance()));
        largest[1] = largest[1].max(defect);
        if step < STEPS / 100 {
            largest[0] = largest[1];
        }
    }
    largest
}

/// Half a rounding of each of nine entries, which differ from one another, in a product; steps add a rounding of
/// their own length at most, at random.
fn check(constraint: Constraint, largest: [f64; 2]) {
    let bound = 16.0 * f64::EPSILON + f64::EPSILON * (STEPS as f64).sqrt();
    println!("{constraint:?}: {:e} after {} steps, {:e} after {STEPS}", largest[0], STEPS / 100, largest[1]);
    assert!(largest[1] < bound, "{constraint:?} {largest:?} against {bound:e}");
}

fn start() -> (f64, [f64; 9]) {
    (0.0, [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])
}

fn by_gauss(constraint: Constraint) {
    let (chart, f) = (Chart::<3>::new(constraint, 0), equations(constraint));
    let mut run = Gauss::within(chart, f, &Tableau::TWO, start(), 0.05 * STEPS as f64, 0.05).unwrap();
    check(
        constraint,
        largest(constraint, || {
            run.advance().unwrap();
            *run.y()
        }),
    );
}

#[test]
fn gauss_stays_on_sl() {
    by_gauss(Constraint::Isochoric);
}

#[test]
fn gauss_stays_on_so() {
    by_gauss(Constraint::Rigid);
}

#[test]
fn gauss_stays_on_conformal_maps() {
    by_gauss(Constraint::Conformal);
}

fn by_runge_kutta(constraint: Constraint) {
    let (chart, f) = (Chart::<3>::new(constraint, 0), equations(constraint));
    let mut run = RungeKutta8::within(chart, f, PLACEMENT, start(), 1e9, 1e-12).unwrap();
    check(
        constraint,
        largest(constraint, || {
            run.advance().unwrap();
            *run.y()
        }),
    );
}

#[test]
fn runge_kutta_stays_on_sl() {
    by_runge_kutta(Constraint::Isochoric);
}

#[test]
fn runge_kutta_stays_on_so() {
    by_runge_kutta(Constraint::Rigid);
}

/// Stage equations are solved to a part of the tolerance, and for all entries of `xi`: what is left over must not lead off the group.
#[test]
fn radau_stays_on_every_group_at_a_coarse_tolerance() {
    const COARSE: usize = 300;
    for constraint in GROUPS {
        let (chart, f) = (Chart::<3>::new(constraint, 0), (equations(constraint), Differences));
        let mut run = Radau::within(chart, f, &radau::Tableau::THREE, PLACEMENT, start(), 1e9, 1e-4).unwrap();
        let defects = (0..COARSE).map(|_| {
            run.advance().unwrap();
            defect(constraint, &Matrix::<3>::from_row_slice(run.y()))
        });
        let largest = defects.fold(0.0, f64::max);
        println!("{constraint:?}: {largest:e} after {COARSE} steps");
        assert!(largest < f64::EPSILON * (16.0 + (COARSE as f64).sqrt()), "{constraint:?} {largest:e}");
    }
}

#[test]
fn uniform_rotation_repeats_no_rounding() {
    // A constant velocity makes the same factor at every step: what it lacks would add up step by step.
    let whirl = Matrix::<3>::new(0.0, -0.7, 0.2, 0.7, 0.0, -0.4, -0.2, 0.4, 0.0);
    let f = |_: f64, y: &[f64; 9]| {
        let mut rates = [0.0; 9];
        write(&mut rates, &(Matrix::<3>::from_row_slice(y) * whirl));
        rates
    };
    let chart = Chart::<3>::new(Constraint::Rigid, 0);
    let mut run = Gauss::within(chart, f, &Tableau::TWO, start(), 0.05 * STEPS as f64, 0.05).unwrap();
    check(
        Constraint::Rigid,
        largest(Constraint::Rigid, || {
            run.advance().unwrap();
            *run.y()
        }),
    );
}
