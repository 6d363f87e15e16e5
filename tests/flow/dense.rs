//! `Trajectory::at`: between the outputs, a run that was asked to be dense is where a run with outputs there is.

use affine_runtime::error::{Reason, Setting};
use affine_runtime::prelude::*;

use crate::models::{Cube, Driven, Drop, Free, Skewed, block, sheared, strained, thrown};

/// The default of a simulation; polynomials may be a tenth of it off, of the size of what they stand for.
const TOLERANCE: f64 = 1e-10;

/// Times on the way to an end, in no order and at no step.
fn times(t_end: f64) -> Vec<f64> {
    (0..=60).map(|k| t_end * (f64::from(k * 23 % 61) / 60.0).powf(1.3)).collect()
}

/// Distance of two points, of placement and momentum: each of the largest that it is at the given ones. Momenta are held against
/// what moves the placement, as steps hold them.
fn distance<const N: usize, P: Phase<N>>(a: &P, b: &P, momentum: f64) -> f64 {
    let placement = (a.phi() - b.phi()).norm() + (a.x() - b.x()).norm();
    let size = b.phi().norm() + b.x().norm();
    placement / size + ((a.p() - b.p()).norm() + (a.pi().0.0 - b.pi().0.0).norm()) / momentum
}

type Thrown = <Cube as Model<3>>::Point<f64>;

/// A dense run takes the same steps and has the same outputs, and is at every time where a run is that has an output there.
fn is_where_outputs_are<const N: usize, M: Model<N>>(
    model: &M,
    start: M::Point<f64>,
    method: Method,
    t_end: f64,
) {
    let simulation = || Simulation::new(model, start).until(t_end).method(method);
    let (plain, dense) = (simulation().run().unwrap(), simulation().dense().run().unwrap());
    assert_eq!((plain.times(), plain.points()), (dense.times(), dense.points()), "{method:?}");
    assert_eq!(plain.statistics().steps, dense.statistics().steps, "{method:?}");
    let momentum =
        dense.points().iter().map(|point| point.p().norm() + point.pi().0.0.norm()).fold(0.0, f64::max);
    for (t, point) in dense.iter() {
        let found = dense.at(t).unwrap();
        match method {
            // 101 times of a motion that has no steps.
            Method::ClosedForm => assert_eq!(found, *point, "{t}"),
            _ => assert!(found == *point, "{method:?}, at the end of a step: {t}"),
        }
    }
    let mut sorted = times(t_end);
    sorted.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    sorted.dedup();
    let outputs = simulation().output(sorted).run().unwrap();
    let mut worst = 0.0_f64;
    for (t, point) in outputs.iter() {
        worst = worst.max(distance(&dense.at(t).unwrap(), point, momentum));
    }
    assert!(worst <= if method == Method::ClosedForm { 0.0 } else { TOLERANCE }, "{method:?}: {worst:e}");
    // Any order, any number of times.
    let again: Vec<_> = times(t_end).into_iter().map(|t| dense.at(t).unwrap()).collect();
    assert!(times(t_end).into_iter().zip(again).all(|(t, point)| dense.at(t).unwrap() == point));
}

#[test]
fn free_bodies_by_every_method() {
    let cube = block(9.81);
    let start = thrown(&cube);
    let by_error = [
        Method::RungeKutta8,
        Method::RungeKutta5,
        Method::RungeKuttaNystrom12,
        Method::RungeKuttaNystrom8,
        Method::Taylor { order: None },
        Method::Radau { stages: None },
        Method::AdaptiveSplitting { order: None },
        Method::Automatic,
    ];
    let step = 1.0 / 64.0;
    let equal = [
        Method::Splitting { order: 2, step },
        Method::Splitting { order: 6, step },
        Method::Gauss { stages: 2, step },
        Method::Gauss { stages: 6, step: 4.0 * step },
    ];
    for method in by_error.into_iter().chain(equal) {
        is_where_outputs_are(&cube, start, method, 1.5);
        is_where_outputs_are(&cube, start, method, -0.7);
    }
}

/// A step over many radians of a vibration is a long one for a polynomial.
#[test]
fn a_step_over_many_radians() {
    let cube = crate::models::Block { stiffness: 1e4, g: 9.81 }.prepare().unwrap();
    is_where_outputs_are(&cube, thrown(&cube), Method::AdaptiveSplitting { order: None }, 0.1);
    is_where_outputs_are(&cube, thrown(&cube), Method::Splitting { order: 2, step: 0.002 }, 0.1);
}

#[test]
fn other_bodies() {
    let step = 1.0 / 64.0;
    let driven = Driven.at_velocity(strained(), sheared()).unwrap();
    for method in [Method::Automatic, Method::Splitting { order: 4, step }, Method::Gauss { stages: 3, step }]
    {
        is_where_outputs_are(&Driven, driven, method, 2.0);
    }
    let drop = Drop.at_velocity(Matrix::identity(), Matrix::<2>::new(0.3, 1.0, -0.5, -0.3)).unwrap();
    for method in [Method::Automatic, Method::RungeKutta5, Method::Rattle { order: 4, step }] {
        is_where_outputs_are(&Drop, drop, method, 2.0);
        is_where_outputs_are(&Drop, drop, method, -2.0);
    }
}

/// A closed form is computed where it is asked for, with the bits that an output has.
#[test]
fn closed_forms_have_the_bits_of_outputs() {
    let free = Free.at_velocity(strained(), sheared()).unwrap();
    is_where_outputs_are(&Free, free, Method::ClosedForm, 40.0);
    is_where_outputs_are(&Free, free, Method::ClosedForm, -3.0);
    is_where_outputs_are(&Free, free, Method::RungeKutta8, 3.0);
    let skewed = Skewed.at_velocity(strained(), sheared()).unwrap();
    is_where_outputs_are(&Skewed, skewed, Method::ClosedForm, 5.0);
    let at_once = Simulation::new(&Free, free).from(2.0).until(2.0).dense().run().unwrap();
    assert_eq!(at_once.at(2.0).unwrap(), free);
}

/// A rotation that the skew part of the energy makes, over thousands of radians in a step.
#[affine_model(dim = 2, kinetic(casimir2 = a, body_inertia = 1), potential = neo_hookean(0.5) + 2*q^2)]
struct Whirling {
    a: f64,
}

#[affine_model(dim = 3, kinetic(casimir2 = a, body_inertia = 1, body_translation = 1))]
struct WhirlingMissile {
    a: f64,
}

/// A dilatation in closed form, over thousands of radians in a step.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = kappa*sinh(q)^2 + neo_hookean(0.5)
)]
struct Stiff {
    kappa: f64,
}

/// A dense run is within a third of its tolerance, placement and momentum each, of a run with outputs, or says that it is not: how
/// often.
fn is_close_or_refused<const N: usize, M: Model<N>>(
    model: &M,
    start: M::Point<f64>,
    t_end: f64,
    tolerance: f64,
) -> usize {
    let times = (1..500).map(|k| t_end * f64::from(k) / 500.0);
    let simulation = || Simulation::new(model, start).until(t_end).tolerance(tolerance);
    let (outputs, dense) = (simulation().output(times).run().unwrap(), simulation().dense().run().unwrap());
    let momentum = |point: &M::Point<f64>| point.sigma_hat().0.0.norm();
    let largest = outputs.points().iter().map(momentum).fold(0.0, f64::max);
    let mut refused = 0;
    for (t, point) in outputs.iter() {
        let found = match dense.at(t) {
            Ok(found) => found,
            Err(stop) => {
                assert!(matches!(stop.reason, Reason::Setting(Setting::NotKept { .. })), "{stop}");
                assert!(stop.to_string().contains(&format!(".output([{t}])")), "{stop}");
                refused += 1;
                continue;
            }
        };
        let placement = (found.phi() - point.phi()).norm() / point.phi().norm()
            + (found.x() - point.x()).norm() / (point.phi().norm() + point.x().norm());
        let spin = (found.sigma_hat().0.0 - point.sigma_hat().0.0).norm() / largest;
        let off = placement.max(spin);
        assert!(off < 0.3 * tolerance + 1e-10, "{t} at {tolerance:e}: {placement:e} {spin:e}");
    }
    refused
}

/// What steps leave out is kept as well, however fast it is, or a time of it is refused.
#[test]
fn motions_that_steps_leave_out() {
    let (plane, spin) = (Matrix::<2>::new(1.1, 0.2, -0.1, 0.9), Matrix::<2>::new(0.1, 0.6, -0.5, 0.2));
    let space = Matrix::<3>::new(1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05);
    let space_spin = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    for (a, t_end, tolerance, is_kept) in
        [(0.999, 1.0, 1e-9, true), (0.9999, 1.0, 1e-3, true), (1.0 - 1e-9, 1.0, 1e-3, false)]
    {
        let whirling = Whirling { a }.prepare().unwrap();
        let start = whirling.at_momentum(plane, Comoving(spin)).unwrap();
        let missile = WhirlingMissile { a }.prepare().unwrap();
        let (x, p) = (Vector::<3>::zeros(), Vector::<3>::new(0.3, -0.2, 0.5));
        let thrown = missile.at_momentum(x, space, p, Comoving(space_spin)).unwrap();
        let of_both = [
            is_close_or_refused(&whirling, start, t_end, tolerance),
            is_close_or_refused(&missile, thrown, t_end, tolerance),
        ];
        assert_eq!(of_both.map(|refused| refused == 0), [is_kept; 2], "{a} {tolerance:e}");
    }
    for (kappa, t_end) in [(1e4, 3.0), (1e6, 1.0), (1e8, 0.1)] {
        let stiff = Stiff { kappa }.prepare().unwrap();
        let phi = plane * (1.001 / plane.determinant().sqrt());
        let start = stiff.at_velocity(phi, Matrix::<2>::new(0.4, 0.4, -0.3, 0.3)).unwrap();
        for tolerance in [1e-2, 1e-9] {
            let refused = is_close_or_refused(&stiff, start, t_end, tolerance);
            assert_eq!(refused, 0, "{kappa:e} {tolerance:e}");
        }
    }
}

/// The energy, which the points of a run keep, is kept between them: a route that knows no outputs.
#[test]
fn energy_is_kept_in_between() {
    let cube = block(9.81);
    let run = Simulation::new(&cube, thrown(&cube)).until(2.0).dense().run().unwrap();
    let energy = |point: Thrown| cube.hamiltonian(0.0, &point);
    let start = energy(thrown(&cube));
    for t in times(2.0) {
        assert!((energy(run.at(t).unwrap()) - start).abs() < 1e-8 * start.abs(), "{t}");
    }
}

/// A body that falls on the ground and bounces: the motion goes on from another point, and ends at an event.
#[test]
fn events_that_change_and_end_the_motion() {
    let cube = block(9.81);
    let start = thrown(&cube);
    let simulation = |method| {
        let ground = Event::new("ground", |_, p: &Thrown| p.x()[2]).falling();
        let bounced = |_: f64, p: &Thrown| {
            let (v, phi_dot) = (p.p(), p.pi().0.0.transpose() / 0.25);
            cube.at_velocity(p.x(), *p.phi(), Vector::<3>::new(v[0], v[1], -0.8 * v[2]), phi_dot)
        };
        let over = Event::new("over", |_, p: &Thrown| p.x()[0] - 2.0).stop();
        Simulation::new(&cube, start).until(9.0).method(method).event(ground.change(bounced)).event(over)
    };
    for method in [Method::RungeKutta8, Method::Splitting { order: 4, step: 1.0 / 64.0 }] {
        let run = simulation(method).dense().run().unwrap();
        assert_eq!((run.stopped_by(), run.events().len()), (Some("over"), 2), "{method:?}");
        let bounce = run.events()[0].t;
        assert_eq!(run.at(bounce).unwrap(), run.events()[0].point, "before the change, as an output there");
        assert_eq!(run.at(run.end().0).unwrap(), *run.end().1);
        let momentum = start.p().norm() + start.pi().0.0.norm();
        let ends = [bounce - 1e-7, bounce, bounce.next_up(), bounce + 1e-7, run.end().0];
        let mut asked: Vec<f64> = times(run.end().0).into_iter().chain(ends).collect();
        asked.sort_by(f64::total_cmp);
        asked.dedup();
        let outputs = simulation(method).output(asked).run().unwrap();
        assert!(outputs.len() > 50);
        for (t, point) in outputs.iter() {
            assert!(distance(&run.at(t).unwrap(), point, momentum) < TOLERANCE, "{method:?} {t}");
        }
        assert!(run.at(run.end().0.next_up()).is_err(), "it ended there");
    }
}

/// What is refused, in words that say what to write.
#[test]
fn times_that_are_refused() {
    let cube = block(9.81);
    let simulation = || Simulation::new(&cube, thrown(&cube)).until(0.5);
    let plain = simulation().run().unwrap();
    let stop = plain.at(0.25).unwrap_err();
    assert_eq!(stop.reason, Reason::Setting(Setting::NotDense { t: 0.25 }));
    assert!(stop.to_string().contains(".dense()") && stop.to_string().contains(".output("), "{stop}");
    let dense = simulation().dense().run().unwrap();
    for (t, says) in [(-1e-9, ".until("), (0.5_f64.next_up(), ".until("), (f64::INFINITY, "inf is no time")] {
        let stop = dense.at(t).unwrap_err();
        assert_eq!(stop.reason, Reason::Setting(Setting::OutsideRun { t, from: 0.0, to: 0.5 }));
        assert!(stop.to_string().contains(says), "{stop}");
    }
    let stop = dense.at(f64::NAN).unwrap_err();
    assert!(stop.to_string().contains("NaN is no time"), "{stop}");
    // Before the start of a run that goes backward, its end is no way to get there.
    let back = Simulation::new(&cube, thrown(&cube)).from(0.5).until(-0.5).dense().run().unwrap();
    let stop = back.at(0.6).unwrap_err().to_string();
    assert!(stop.contains("before the start") && stop.contains(".from(0.6)"), "{stop}");
    let stop = back.at(-0.6).unwrap_err().to_string();
    assert!(stop.contains("behind the end") && stop.contains(".until(-0.6)"), "{stop}");
    let error: affine_runtime::Error = dense.at(2.0).unwrap_err().into();
    assert!(error.to_string().contains("2"), "{error}");
}
