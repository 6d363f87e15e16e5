//! A potential of the user's that has no value somewhere, where its slopes have some: every way to move a body ends there.

use affine_runtime::model::Owned;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Reason, Stop};

use crate::models::{Barrier, Confined};

type Point = <Confined as Model<2>>::Point<f64>;

const MODEL: Confined = Confined { barrier: Barrier };

/// Steps so long that they end behind a wall.
const METHODS: [Method; 2] = [Method::RungeKutta8, Method::Splitting { order: 2, step: 0.05 }];
const TOLERANCE: f64 = 1e-1;

fn at(x: f64, speed: f64) -> Point {
    let (x, x_dot) = (Vector::<2>::new(x, 0.3), Vector::<2>::new(speed, 0.0));
    MODEL.at_velocity(x, Matrix::identity(), x_dot, Matrix::zeros()).unwrap()
}

fn has_left(stop: &Stop) -> bool {
    matches!(stop.reason, Reason::Energy { energy, .. } if energy.is_nan())
}

fn together(method: Method, starts: &[Point]) -> Result<Flows<'static, 2, Owned<Confined>>, Stop> {
    let bodies: Vec<_> = starts.iter().map(|start| (Owned(MODEL), *start)).collect();
    match method {
        Method::RungeKutta8 => Flows::by_runge_kutta(TOLERANCE, 0.0, bodies),
        _ => Flows::by_splitting((2, 0.05), 0.0, bodies),
    }
}

#[test]
fn bodies_end_at_the_wall() {
    for method in METHODS {
        let mut flow = Flow::by(method, &MODEL, (0.0, at(0.0, 3.0))).unwrap();
        flow.set_tolerance(TOLERANCE).unwrap();
        let stop = flow.advance(2.0).unwrap_err();
        assert!(has_left(&stop), "{method:?}: {stop}");
        assert!(flow.point().x()[0] < 1.0 && flow.t() < 0.5, "{method:?}: {stop}");
        // Whatever is asked for on the way.
        for outputs in [vec![], vec![2.0]] {
            let run = Simulation::new(&MODEL, at(0.0, 3.0)).until(2.0).tolerance(TOLERANCE).method(method);
            let halt = run.output(outputs).run().unwrap_err();
            assert!(has_left(&halt.stop) && halt.stop.t == stop.t, "{method:?}: {}", halt.stop);
        }
        let mut starts = vec![at(0.0, 0.1); 9];
        starts[3] = at(0.0, 3.0);
        let mut flows = together(method, &starts).unwrap();
        let of_all = flows.advance(2.0).unwrap_err();
        assert!(has_left(&of_all) && of_all.t == stop.t, "{method:?}: {of_all}");
        assert_eq!(flows.stopped().map(|(number, _)| number).collect::<Vec<_>>(), [3]);
        assert_eq!(flows.point(3), Some(flow.point()));
        let mut other = Flow::by(method, &MODEL, (0.0, starts[0])).unwrap();
        other.set_tolerance(TOLERANCE).unwrap();
        other.advance(2.0).unwrap();
        assert!((0..9).all(|number| number == 3 || flows.point(number) == Some(other.point())), "{method:?}");
    }
}

#[test]
fn ensembles_end_as_runs_do() {
    let starts = [at(0.0, 0.1), at(0.0, 3.0), at(0.2, -2.5), at(0.5, 0.0)];
    let ends = Ensemble::new(&MODEL, starts).until(2.0).tolerance(TOLERANCE).run().unwrap();
    let mut left = 0;
    for (start, end) in starts.into_iter().zip(ends) {
        let run = Simulation::new(&MODEL, start).until(2.0).tolerance(TOLERANCE).output([]);
        let alone = run.method(Method::RungeKutta8).run();
        left += usize::from(end.as_ref().is_err_and(has_left));
        // In words, since the energy is no number.
        let alone = alone.map(|run| *run.end().1).map_err(|halt| halt.stop.to_string());
        assert_eq!(end.map_err(|stop| stop.to_string()), alone);
    }
    assert_eq!(left, 2);
}

#[test]
fn no_body_starts_behind_the_wall() {
    for method in METHODS {
        assert!(has_left(&Flow::by(method, &MODEL, (0.0, at(1.5, 0.0))).unwrap_err()), "{method:?}");
        assert!(has_left(&together(method, &[at(0.0, 0.1), at(1.5, 0.0)]).unwrap_err()), "{method:?}");
        let mut flows = together(method, &[at(0.0, 0.1), at(0.1, 0.0)]).unwrap();
        assert!(has_left(&flows.set_point(1, at(1.5, 0.0)).unwrap_err()), "{method:?}");
        flows.advance(0.5).unwrap();
        assert!(flows.point(1).unwrap().x()[0] < 1.0);
    }
}
