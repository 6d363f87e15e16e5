//! The lists of conserved quantities against exact brackets: what is listed has bracket 0 with `H`, exactly; what
//! is not listed has not.

use affine_oracle::{Kinetic, Observable, Random, State};
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

use crate::families::{Family, Parameters};
pub(crate) use affine_tests::charts::{exists, listed_as_a_whole};

fn assert_conserved(kinetic: &Kinetic, state: &State, listed: &[Conserved], translation: bool) {
    let motion = kinetic.motion(state).unwrap();
    let n = state.dimension();
    let brackets = |of| vec![motion.bracket(of).unwrap()];
    let listed = listed_as_a_whole(listed, &|of| exists(of, n, translation), 0.0, &brackets);
    for &quantity in Observable::ALL {
        if !exists(quantity, n, translation) {
            assert!(!listed.contains(&quantity), "{quantity:?} does not exist");
        } else {
            let conserved = motion.bracket(quantity).unwrap().is_zero();
            assert_eq!(listed.contains(&quantity), conserved, "{quantity:?} listed");
        }
    }
}

fn lists_are_exact<const N: usize, F: Family<N>>() {
    for seed in 0..2 {
        let mut random = Random::new(49 + seed);
        let (_, kinetic) = F::with(&Parameters::random(N, &mut random));
        let state = F::random_state(&mut random);
        assert_conserved(&kinetic, &state, F::DESCRIPTION.conserved, F::TRANSLATION);
        assert_conserved(&kinetic, &state.at_rest(), F::DESCRIPTION.conserved_at_rest, false);
    }
}

each_family!(lists_are_exact);

/// A soft body, symmetric about its third axis, in a field of gravity.
#[test]
fn components_of_a_heavy_top_stay() {
    #[affine_model(
        dim = 3,
        kinetic(dalembert = diag(2, 2, 3), space_translation = 5),
        potential = tr(G)^2 + 1/det + 9.81*x[3]
    )]
    struct Top;
    let symbols: Vec<&str> = Top::DESCRIPTION.conserved.iter().map(|quantity| quantity.symbol()).collect();
    let whole = ["H", "S = Sigma - Sigma^T", "|S|^2"];
    assert_eq!(symbols, [&whole[..], &["p_1", "p_2", "x_1*p_2 - x_2*p_1", "Vort_12"]].concat());

    let (x, p) = (Vector::<3>::new(0.3, -0.2, 0.1), Vector::<3>::new(1.0, 0.5, -0.25));
    let phi = Matrix::<3>::new(0.9, 0.1, 0.0, -0.2, 1.1, 0.05, 0.1, 0.0, 0.95);
    let spin = Matrix::<3>::new(0.1, 0.7, -0.2, -0.4, 0.2, 0.3, 0.5, -0.1, 0.0);
    let start = Top.at_momentum(x, phi, p, Comoving(spin)).unwrap();
    let value = |quantity: &Conserved| quantity.of(&start, None).map(|value| value.as_slice().to_vec());
    let values: Vec<_> = Top::DESCRIPTION.conserved[3..].iter().map(value).collect();
    let near = |value: &Option<Vec<f64>>, expected: f64| {
        assert!((value.as_ref().unwrap()[0] - expected).abs() < 1e-15, "{value:?} is not {expected}");
    };
    // x_1 p_2 - x_2 p_1 = 0.3 0.5 + 0.2, Vort_12 = 0.7 + 0.4.
    values.iter().zip([1.0, 0.5, 0.35, 1.1]).for_each(|(value, expected)| near(value, expected));

    let run = Simulation::new(&Top, start).until(2.0).tolerance(1e-12).run().unwrap();
    let conservation = run.conservation();
    assert_eq!(conservation.drifts().len(), 7);
    assert!(conservation.worst() < 1e-9, "{conservation}");
    assert!(conservation.to_string().contains("\nVort_12 "), "{conservation}");
    // What is not listed changes.
    let across = [(1, 3), (2, 3)].map(|(row, column)| {
        let entry = |point: &<Top as Model<3>>::Point<f64>| point.vorticity().0.0[(row - 1, column - 1)];
        (entry(run.end().1) - entry(&start)).abs()
    });
    assert!(across.iter().all(|change| *change > 1e-3), "{across:?}");
}
