//! Bodies in lanes are where each of them is alone, to the bit.

use affine_oracle::Random;
use affine_runtime::capability::{InLanes, Splitting};
use affine_runtime::prelude::*;

/// More than the lanes, and no multiple of them.
const BODIES: usize = 11;
const STEP: f64 = 0.01;
/// Frames of one step and of several, of parts of a step, and backward.
const FRAMES: [f64; 5] = [0.31, 0.3455, 0.35, 0.4, 0.38];

fn goes_in_lanes<const N: usize, M: Model<N> + InLanes<N> + Splitting<N> + Sync>(
    name: &str,
    model: &M,
    start: M::Point<f64>,
) where
    M::Point<f64>: Send,
{
    let mut random = Random::new(17);
    let mut near = || {
        let mut numbers = model.flatten(&start);
        numbers.as_mut().iter_mut().for_each(|number| *number += 3e-4 * random.integer(-100, 100) as f64);
        model.unflatten(&numbers)
    };
    let starts: [M::Point<f64>; BODIES] = core::array::from_fn(|_| near());
    for order in [2, 4, 6, 8] {
        let bodies = starts.iter().map(|start| (model, *start));
        let mut flows = Flows::by_splitting((order, STEP), 0.3, bodies).unwrap();
        assert!(format!("{flows:?}").contains("alone: 0"), "{name}: {flows:?}");
        let method = Method::Splitting { order, step: STEP };
        let mut alone = starts.map(|start| Flow::by(method, model, (0.3, start)).unwrap());
        assert!(flows.points().zip(&alone).all(|(point, alone)| point == alone.point()), "{name}");
        for t in FRAMES {
            flows.advance_to(t).unwrap();
            for (number, (body, point)) in alone.iter_mut().zip(flows.points()).enumerate() {
                body.advance_to(t).unwrap();
                let [here, there] = [point, body.point()].map(|point| model.flatten(&point));
                let same = here.as_ref().iter().zip(there.as_ref()).all(|(a, b)| a.to_bits() == b.to_bits());
                assert!(same, "{name}, order {order}, body {number} at {t}: {here:?} {there:?}");
            }
        }
        assert!(format!("{flows:?}").contains("alone: 0"), "{name}: {flows:?}");
    }
}

#[test]
fn bodies_are_where_each_is_alone() {
    macro_rules! visit {
        ($name:expr, $n:literal, $model:expr, $start:expr) => {
            goes_in_lanes::<$n, _>($name, $model, $start)
        };
    }
    crate::models::each_in_lanes!(visit);
}
