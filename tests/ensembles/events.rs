//! Events of emitted models against closed forms.

use core::cell::Cell;

use affine_runtime::prelude::*;

use crate::models::{Elastic, Sampled, Vibrating};

/// Times: the error of the motion at the finest tolerances over rates of order 1.
const TIME: f64 = 1e-12;

/// Affine in space and in the body: `c = cosh(q1 - q2)` obeys `c'' = (4 E c + S V/A)/A`, `A = 1/2`.
#[affine_model(dim = 2, symmetry(space = affine, body = affine), kinetic(casimir2 = 0.5), emit(taylor))]
pub(crate) struct PlanarBody;

const A: f64 = 0.5;

type Planar = <PlanarBody as Model<2>>::Point<f64>;

/// `cosh(q1 - q2) = tr G/(2 det phi)`.
fn stretch(point: &Planar) -> f64 {
    point.phi().norm_squared() / (2.0 * point.phi().determinant())
}

#[test]
fn planar_geodesics_meet_a_stretch_when_they_should() {
    let phi = Matrix::<2>::new(1.2, 0.3, -0.1, 0.9);
    let start = PlanarBody.at_momentum(phi, Comoving(Matrix::<2>::new(0.3, 0.2, 0.1, -0.3))).unwrap();
    let energy = PlanarBody.hamiltonian(0.0, &start);
    assert!(energy > 0.0, "escaping");
    let rest = -start.spin().0.0[(0, 1)] * start.vorticity().0.0[(0, 1)] / (4.0 * A * energy);
    let w = 2.0 * (energy / A).sqrt();
    let (c0, rate) =
        (stretch(&start) - rest, phi.dot(&PlanarBody.velocity(&start).phi_dot) / phi.determinant());
    for level in [1.5, 4.0, 20.0] {
        // c0 cosh(w t) + rate/w sinh(w t) = level - rest, quadratic in exp(w t).
        let (plus, minus, value) = (0.5 * (c0 + rate / w), 0.5 * (c0 - rate / w), level - rest);
        let exact = ((value + (value * value - 4.0 * plus * minus).sqrt()) / (2.0 * plus)).ln() / w;
        for method in [Method::ClosedForm, Method::RungeKutta8, Method::Taylor { order: None }] {
            let run = Simulation::new(&PlanarBody, start)
                .until(6.0)
                .tolerance(1e-14)
                .method(method)
                .event(Event::new("level", |_, point| stretch(point) - level).rising().stop())
                .run()
                .unwrap();
            assert_eq!(run.stopped_by(), Some("level"));
            assert!((run.end().0 - exact).abs() < TIME, "{method:?}: {} and {exact}", run.end().0);
        }
    }
}

#[test]
fn forward_and_back_through_events_with_resumption() {
    let start = Elastic.samples(1, 31)[0];
    let simulation = |method| {
        Simulation::new(&Elastic, start)
            .until(3.0)
            .tolerance(1e-13)
            .method(method)
            .every(0.4)
            .event(Event::determinant(1.0))
            .event(Event::largest_stretch(1.2))
    };
    for method in [Method::RungeKutta8, Method::Taylor { order: None }] {
        let whole = simulation(method).run().unwrap();
        assert!(whole.events().len() > 2, "{}", whole.events().len());
        // Backward the same events come in the opposite order and sense.
        let back = Simulation::new(&Elastic, *whole.end().1)
            .from(3.0)
            .until(0.0)
            .tolerance(1e-13)
            .method(method)
            .event(Event::determinant(1.0))
            .event(Event::largest_stretch(1.2))
            .run()
            .unwrap();
        assert_eq!(back.events().len(), whole.events().len());
        for (back, there) in back.events().iter().rev().zip(whole.events()) {
            assert!((back.t - there.t).abs() < 1e-11, "{} and {}", back.t, there.t);
            assert_eq!((back.name, back.rising), (there.name, !there.rising));
        }
        assert!((back.end().1.phi() - start.phi()).norm() < 1e-11);

        let first = simulation(method).max_steps(4).run().unwrap_err().trajectory;
        let rest = simulation(method).resume(first.checkpoint().unwrap()).run().unwrap();
        let points: Vec<_> = first.points().iter().chain(rest.points()).copied().collect();
        assert_eq!(points, whole.points());
        let events: Vec<_> = first.events().iter().chain(rest.events()).copied().collect();
        assert_eq!(events, whole.events());
        assert_eq!(rest.statistics(), whole.statistics());
    }
}

type Solid = <Elastic as Model<3>>::Point<f64>;

fn solid<'a>(start: Solid, tolerance: f64) -> Simulation<'a, 3, Elastic> {
    Simulation::new(&Elastic, start).until(6.0).tolerance(tolerance).method(Method::RungeKutta8)
}

/// A function that stays away from zero takes four values a step, and the equations none.
#[test]
fn steps_whose_ends_tell_are_not_evaluated_within() {
    for start in Elastic.samples(4, 61) {
        let plain = solid(start, 1e-9).run().unwrap().statistics();
        let calls = Cell::new(0);
        let far = |_: f64, point: &Solid| {
            calls.set(calls.get() + 1);
            point.phi()[(0, 0)] + 9.0
        };
        let watched = solid(start, 1e-9).event(Event::new("far", far)).run().unwrap().statistics();
        assert_eq!(watched, plain);
        assert_eq!(calls.get(), 1 + 4 * plain.steps);
    }
}

/// A level just below an extreme is crossed twice within a step, which both ends of it do not show.
#[test]
fn there_and_back_within_a_step() {
    let mut looked_at = 0;
    for (start, tolerance) in
        Elastic.samples(4, 90).into_iter().flat_map(|start| [1e-5, 1e-9, 1e-12].map(|eps| (start, eps)))
    {
        for (i, k) in [(0, 0), (0, 1), (2, 2)] {
            let rate = move |_: f64, point: &Solid| Elastic.velocity(point).phi_dot[(i, k)];
            let run = solid(start, tolerance).event(Event::new("extreme", rate)).run().unwrap();
            for extreme in run.events() {
                let after = run.times().partition_point(|t| *t <= extreme.t);
                let Some(end) = run.times().get(after) else { continue };
                let begin = run.times()[after - 1];
                let [from, to, most] =
                    [&run.points()[after - 1], &run.points()[after], &extreme.point].map(|p| p.phi()[(i, k)]);
                let nearer = if (most - from).abs() < (most - to).abs() { (begin, from) } else { (*end, to) };
                // Samples are a quarter of the step apart.
                if (nearer.0 - extreme.t).abs() < 0.2 * (end - begin) {
                    continue;
                }
                let level = nearer.1 + 0.25 * (most - nearer.1);
                let crossed = move |_: f64, point: &Solid| point.phi()[(i, k)] - level;
                let found = solid(start, tolerance).event(Event::new("level", crossed)).run().unwrap();
                let within = found.events().iter().filter(|event| (begin..=*end).contains(&event.t));
                assert_eq!(within.count(), 2, "{tolerance:e}: {i}{k} from {begin} to {end}");
                looked_at += 1;
            }
        }
    }
    assert!(looked_at > 50, "{looked_at}");
}

/// A stiff dilatation in closed form turns several times within a step: the ends of steps do not pass for what is between them.
#[test]
fn crossings_that_steps_pass_over() {
    let model = Vibrating { kappa: 1e5, c1: 0.5 }.prepare().unwrap();
    let spin = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05);
    let start = model.at_momentum(1.5 * Matrix::<3>::identity(), Comoving(spin)).unwrap();
    let simulation = || Simulation::new(&model, start).until(1.0).tolerance(1e-8).method(Method::RungeKutta8);
    let fine = simulation().every(1e-4).run().unwrap();
    let beyond: Vec<bool> = fine.points().iter().map(|point| point.phi().determinant() > 1.0).collect();
    let changes = beyond.windows(2).filter(|pair| pair[0] != pair[1]).count();
    let found = simulation().event(Event::determinant(1.0)).run().unwrap();
    // The rate where a sample stands tells where the next one does, and what it was before, since it vanishes at turning points.
    let (steps, found) = (found.statistics().steps as usize, found.events().len());
    assert!(found > 2 * steps && found + 2 >= changes && found <= changes, "{found} of {changes} in {steps}");
}
