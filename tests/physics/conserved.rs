//! The lists of conserved quantities against exact brackets: what is listed has bracket 0 with `H`, exactly; what
//! is not listed has not.

use affine_oracle::{Kinetic, Observable, Random, State};
use affine_runtime::model::Conserved;

use crate::families::{Family, Parameters};
pub(crate) use affine_tests::charts::{exists, listed_as_a_whole};

fn assert_conserved(kinetic: &Kinetic, state: &State, listed: &[Conserved], translation: bool) {
    let motion = kinetic.motion(state).unwrap();
    let n = state.dimension();
    let brackets = |of| vec![motion.bracket(of).unwrap()];
    let listed = listed_as_a_whole(listed, |of| exists(of, n, translation), 0.0, brackets);
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
