//! Flows of pieces: their slopes add up to the equations of motion, and their times add.

use affine_runtime::capability::Splitting;
use affine_runtime::model::StateVector;
use affine_runtime::prelude::*;

use crate::models::each_model;

/// Central differences of flows with steps of 1e-4: `h^2` times third derivatives, `eps/h`.
const SLOPE: f64 = 1e-6;
/// Flows in one and in two parts: roundings of a few products.
const GROUP: f64 = 1e-14;

/// Components of the state that are no functions of the rest.
fn moved<const N: usize, M: Model<N>>() -> Vec<usize> {
    let mut start = 0;
    let ranges = M::DESCRIPTION.reduced.iter().map(|group| {
        start += group.len;
        (group.name(), start - group.len..start)
    });
    ranges.filter(|(name, _)| !["1/D", "q"].contains(name)).flat_map(|(_, range)| range).collect()
}

fn after<const N: usize, M: Splitting<N>>(
    model: &M,
    constants: &M::Constants<f64>,
    state: &M::Reduced<f64>,
    piece: usize,
    h: f64,
) -> M::Reduced<f64> {
    let (mut state, mut carry) = (*state, M::Reduced::<f64>::zeros());
    model.flow(piece, 0.3, h, constants, &mut state, &mut carry);
    state
}

fn assert_pieces<const N: usize, M: Splitting<N>>(name: &str, model: &M, start: M::Point<f64>) {
    let (state, constants) = model.reduce(0.0, &start);
    let exact = model.reduced_equations(0.3, &constants, &state);
    let h = 1e-4;
    let mut sum = M::Reduced::<f64>::zeros();
    for piece in 0..M::PIECES.len() {
        let [there, back] = [h, -h].map(|h| after(model, &constants, &state, piece, h));
        for (k, slope) in sum.as_mut().iter_mut().enumerate() {
            *slope += (there.as_ref()[k] - back.as_ref()[k]) / (2.0 * h);
        }
        let whole = after(model, &constants, &state, piece, 0.7);
        let parts = after(model, &constants, &after(model, &constants, &state, piece, 0.4), piece, 0.3);
        let return_trip = after(model, &constants, &whole, piece, -0.7);
        for k in moved::<N, M>() {
            let size = 1.0 + whole.as_ref()[k].abs();
            assert!(
                (whole.as_ref()[k] - parts.as_ref()[k]).abs() <= GROUP * size,
                "{name}: piece {piece}, {k}"
            );
            assert!(
                (return_trip.as_ref()[k] - state.as_ref()[k]).abs() <= GROUP * size,
                "{name}: back, {piece}, {k}"
            );
        }
        assert!(whole != state, "{name}: piece {piece} moves nothing");
    }
    for k in moved::<N, M>() {
        let (sum, exact) = (sum.as_ref()[k], exact.as_ref()[k]);
        assert!((sum - exact).abs() <= SLOPE * (1.0 + exact.abs()), "{name}: component {k}: {sum} {exact}");
    }
}

#[test]
fn slopes_add_up_and_times_add() {
    let mut count = 0;
    macro_rules! visit {
        ($name:literal, $n:literal, $model:expr, $start:expr) => {
            assert_pieces::<$n, _>($name, $model, $start);
            count += 1;
        };
    }
    each_model!(visit);
    assert_eq!(count, 43);
}

#[test]
fn a_dilatation_of_its_own_beside_any_potential() {
    fn own<M: Splitting<N>, const N: usize>(_: &M) -> (usize, bool, bool, bool) {
        (M::PIECES.len(), M::PIECES[0].contains("dilatation"), M::NYSTROM, M::DILATES)
    }
    use crate::models::*;
    assert_eq!(own(&Inflated { kappa: 1.0 }.prepare().unwrap()), (2, true, true, true));
    assert_eq!(own(&Pulled { kappa: 1.0 }.prepare().unwrap()), (2, true, true, true));
    assert_eq!(own(&Tied), (2, true, true, true));
    // Translation moves the centre, which the weight reads.
    assert_eq!(own(&Falling), (3, true, false, true));
    let (towed, moored) = (Towed { kappa: 1.0, m: 1.0 }.prepare(), Moored { kappa: 1.0 }.prepare());
    assert_eq!(own(&towed.unwrap()), (2, true, true, true));
    assert_eq!(own(&moored.unwrap()), (3, true, false, true));
    // What it moves is the affine spin in the total affine momentum.
    for groups in [PreparedTowed::DESCRIPTION.reduced, PreparedMoored::DESCRIPTION.reduced] {
        assert!(groups.iter().any(|group| group.name() == "I(O)"), "{groups:?}");
    }
    // Where the reduction takes it out of the state, and where nothing has a closed form.
    assert_eq!(own(&Vibrating), (2, false, true, false));
    assert_eq!(own(&Attracted), (3, false, false, false));
}
