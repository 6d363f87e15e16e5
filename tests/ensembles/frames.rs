//! The same bodies in a frame loop, by steps of their own.

use affine_oracle::Random;
use affine_runtime::capability::InLanes;
use affine_runtime::model::Handle;
use affine_runtime::prelude::*;

use crate::models::{
    Blown, DrunkMissile, Elastic, PreparedBlown, Sampled, Unprotected, Wind, between, matrix, vibrating,
};

type PointOf<const N: usize, H> = <<H as Handle<N>>::Model as Model<N>>::Point<f64>;

/// Frames of many steps, of parts of one and back again: each body is where it is by itself, to the bit, and in its lane.
fn are_where_each_is<const N: usize, H: Handle<N> + Send + Sync>(bodies: &[(H, PointOf<N, H>)])
where
    H::Model: InLanes<N>,
    PointOf<N, H>: Send,
{
    let name = <H::Model as Model<N>>::DESCRIPTION.name;
    for tolerance in [1e-4, 1e-9, 1e-13] {
        let flow = |(model, start): &(H, PointOf<N, H>)| {
            let mut flow = Flow::by(Method::RungeKutta8, model.clone(), (0.5, *start)).unwrap();
            flow.set_tolerance(tolerance).unwrap();
            flow
        };
        let mut alone: Vec<_> = bodies.iter().map(flow).collect();
        let mut flows = Flows::by_runge_kutta(tolerance, 0.5, bodies.iter().cloned()).unwrap();
        for dt in [1.0 / 60.0, 0.5, 0.3, 1e-7, 2.0 / 60.0, -0.4, 0.1] {
            flows.advance(dt).unwrap();
            alone.iter_mut().for_each(|flow| flow.advance(dt).unwrap());
            assert!(flows.points().eq(alone.iter().map(Flow::point)), "{name}: {dt}");
            assert_eq!(flows.t(), alone[0].t());
        }
        assert!(format!("{flows:?}").contains("alone: 0"), "{flows:?}");
    }
}

fn of_one_model<const N: usize, M: Sampled<N>>(model: &M)
where
    M::Point<f64>: Send,
{
    let bodies: Vec<_> = model.samples(11, 7).into_iter().map(|start| (model, start)).collect();
    are_where_each_is(&bodies);
}

#[test]
fn bodies_of_every_kind_in_frames() {
    of_one_model(&DrunkMissile);
    of_one_model(&vibrating());
    of_one_model(&Elastic);
    of_one_model(&Unprotected);
    let mut random = Random::new(3);
    let models: Vec<_> = (0..11)
        .map(|_| {
            let a = Matrix::<2>::identity() + matrix::<2>(&mut random, 0.3);
            let (j, wind) = (between(&mut random, 0.5, 2.0), Wind(between(&mut random, -1.0, 1.0)));
            Blown { eta: a.transpose() * a, j, s: 0.5, wind }.prepare().unwrap()
        })
        .collect();
    let start = |model: &PreparedBlown| {
        let (phi, rate) = (Matrix::<2>::new(1.1, 0.1, -0.2, 0.9), Matrix::<2>::new(0.1, 0.4, -0.3, 0.2));
        model.at_velocity(Vector::<2>::zeros(), phi, Vector::<2>::new(0.1, 0.2), rate).unwrap()
    };
    let bodies: Vec<_> = models.iter().map(|model| (model, start(model))).collect();
    are_where_each_is(&bodies);
}
