//! Rounding, elimination, generators and refusals.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_oracle::{
    Error, Kinetic, Matrix, Random, Rational, Signature, State, Term, exact, rational, rounded,
};
use num_traits::Signed;

#[test]
fn rounding_is_to_the_nearest_even_float() {
    let mut random = Random::new(1);
    let two = rational(2, 1);
    for _ in 0..2000 {
        let long =
            |random: &mut Random| Rational::from_integer((random.bits() >> random.integer(0, 60)).into());
        let value = (long(&mut random) - long(&mut random)) * long(&mut random) / (long(&mut random) + &two);
        let near = rounded(&value);
        let error = (exact(near).unwrap() - &value).abs();
        for neighbour in [near.next_down(), near.next_up()] {
            let other = (exact(neighbour).unwrap() - &value).abs();
            assert!(error < other || (error == other && near.to_bits().is_multiple_of(2)), "{value}");
        }
    }
    // Halfway cases go to the even neighbour.
    let ulp = rational(1, 1 << 52);
    assert_eq!(rounded(&(rational(1, 1) + &ulp / &two)), 1.0);
    assert_eq!(rounded(&(rational(1, 1) + &ulp * rational(3, 2))), 1.0 + 2.0 * f64::EPSILON);
}

#[test]
fn every_finite_float_is_taken_exactly() {
    for value in [0.0, -0.1, f64::MAX, f64::MIN_POSITIVE, f64::from_bits(1), 1.0 / 3.0] {
        assert_eq!(rounded(&exact(value).unwrap()), value);
    }
    assert_eq!(exact(0.1).unwrap() - rational(1, 10), rational(1, 180_143_985_094_819_840));
    assert_eq!(exact(f64::NAN), None);
    assert_eq!(exact(f64::INFINITY), None);
}

#[test]
fn elimination_and_adjugate_agree() {
    let mut random = Random::new(2);
    for n in 1..=3 {
        for _ in 0..20 {
            let matrix = random.matrix(n, n);
            let identity = Matrix::identity(n);
            let Some(inverse) = matrix.inverse() else {
                assert_eq!(matrix.determinant(), rational(0, 1));
                continue;
            };
            assert_eq!(&matrix * &inverse, identity);
            assert_eq!(matrix.eliminated_inverse().unwrap(), inverse);
            assert_eq!(matrix.determinant() * inverse.determinant(), rational(1, 1));
        }
    }
    let large = random.matrix(12, 12);
    assert_eq!(&large.eliminated_inverse().unwrap() * &large, Matrix::identity(12));
    let singular = Matrix::from_rationals(2, 2, &[1, 2, 2, 4].map(|entry| rational(entry, 3)));
    assert_eq!(singular.eliminated_inverse(), Err(Error::SingularMass));
    assert_eq!(singular.inverse().map(|inverse| inverse.to_f64()), None);
}

#[test]
fn signature_counts_squares() {
    let signature = |size: usize, entries: &[i64]| {
        let entries: Vec<_> = entries.iter().map(|&entry| rational(entry, 2)).collect();
        let found = Matrix::from_rationals(size, size, &entries).signature();
        (found.positive, found.negative, found.zero)
    };
    assert_eq!(signature(2, &[0, 1, 1, 0]), (1, 1, 0));
    assert_eq!(signature(2, &[-3, 1, 1, 5]), (1, 1, 0));
    assert_eq!(signature(2, &[1, 1, 1, 1]), (1, 0, 1));
    assert_eq!(signature(3, &[0, 1, 1, 1, 0, 1, 1, 1, 0]), (1, 2, 0));
    assert_eq!(signature(3, &[0, 0, 0, 0, 0, 7, 0, 7, 0]), (1, 1, 1));
    assert_eq!(signature(3, &[0; 9]), (0, 0, 3));
    // Sylvester: the signature of C^T D C is that of D.
    let mut random = Random::new(3);
    for _ in 0..20 {
        let signs: Vec<i64> = (0..6).map(|_| random.integer(-1, 1)).collect();
        let mut form = Matrix::zeros(6, 6);
        for (i, &sign) in signs.iter().enumerate() {
            form = &form + &Matrix::unit(6, i, i).scaled(&rational(sign, 1));
        }
        let change = random.matrix(6, 6);
        assert_ne!(change.determinant(), rational(0, 1));
        let count = |wanted: i64| signs.iter().filter(|&&sign| sign == wanted).count();
        let expected = Signature { positive: count(1), negative: count(-1), zero: count(0) };
        assert_eq!((&(&change.transpose() * &form) * &change).signature(), expected);
    }
}

#[test]
fn generators_keep_their_promises() {
    // Outputs published for the seed 1234567 (Rosetta Code, "Pseudo-random numbers/Splitmix64").
    let mut random = Random::new(1_234_567);
    assert_eq!(random.bits(), 6_457_827_717_110_365_317);
    assert_eq!(random.bits(), 3_203_168_211_198_807_973);
    for n in [2, 3] {
        let mut random = Random::new(4);
        let (mut indefinite, mut steepest) = (0, 1.0_f64);
        for _ in 0..300 {
            let c = random.isotropic(n);
            indefinite += usize::from(c.is_indefinite(n));
            let mut sizes = c.eigenvalues(n).to_vec();
            sizes.push(c.m.clone());
            let sizes: Vec<f64> = sizes.iter().map(|value| rounded(&value.abs())).collect();
            let largest = sizes.iter().copied().fold(0.0, f64::max);
            let smallest = sizes.iter().copied().fold(f64::INFINITY, f64::min);
            assert!(smallest > 0.0);
            steepest = steepest.max(largest / smallest);
            for number in [&c.i, &c.a, &c.b, &c.m] {
                assert_eq!(exact(rounded(number)).as_ref(), Some(number));
            }
        }
        assert!((100..=200).contains(&indefinite), "{indefinite} of 300 indefinite");
        assert!((1e3..=1e4).contains(&steepest), "condition up to {steepest}");

        let mut definite = 0;
        for _ in 0..40 {
            let state = random.state(n);
            assert!(state.phi.determinant() > rational(3, 10));
            assert_eq!(Matrix::from_f64("phi", n, n, &state.phi.to_f64()), Ok(state.phi));
            let tensor = random.tensor(n);
            assert_eq!(tensor, tensor.transpose());
            let signature = tensor.signature();
            assert_eq!(signature.zero, 0);
            definite += usize::from(signature.negative == 0);
            assert_eq!(random.inertia(n).signature(), Signature { positive: n, negative: 0, zero: 0 });
        }
        assert!((10..=30).contains(&definite), "{definite} of 40 tensors definite");
    }
}

#[test]
fn condition_at_the_unit_placement_is_the_ratio_of_eigenvalues() {
    let terms = vec![Term::body_inertia(3, rational(2, 1)), Term::Casimir2(rational(3, 1))];
    let kinetic = Kinetic::new(3, terms).unwrap();
    // I + A = 5, I - A = -1; the eigenvalue solver works in f64.
    let condition = kinetic.condition(&Matrix::identity(3)).unwrap();
    assert!((condition - 5.0).abs() < 1e-12, "{condition}");
}

#[test]
fn refusals() {
    assert_eq!(Kinetic::new(4, vec![]).unwrap_err(), Error::Dimension(4));
    let shape = Kinetic::new(3, vec![Term::BodyTensor(Matrix::identity(3))]).unwrap_err();
    assert_eq!(shape, Error::Shape { quantity: "K", expected: (9, 9), found: (3, 3) });

    let skew_lost =
        Kinetic::new(2, vec![Term::body_inertia(2, rational(1, 1)), Term::Casimir2(rational(1, 1))]);
    let (skew_lost, mut random) = (skew_lost.unwrap(), Random::new(7));
    let state = random.state(2);
    assert_eq!(skew_lost.velocity(&state.at_rest()), Err(Error::SingularMass));
    assert_eq!(skew_lost.velocity(&state), Err(Error::MomentumWithoutTranslation));
    assert_eq!(skew_lost.velocity(&random.state(3)).unwrap_err().to_string(), "phi must be 2 x 2, not 3 x 3");

    let flat = State { phi: Matrix::unit(2, 0, 0), ..state.at_rest() };
    assert_eq!(skew_lost.hamiltonian(&flat).unwrap_err(), Error::SingularPlacement);
    let spin = Matrix::identity(2);
    let made = State::with_affine_spin(flat.x.clone(), flat.phi.clone(), flat.p.clone(), &spin);
    assert_eq!(made.unwrap_err(), Error::SingularPlacement);
    let nan = State::from_f64(2, &[0.0, f64::NAN], &[1.0; 4], &[0.0; 2], &[0.0; 4]);
    assert_eq!(nan.unwrap_err(), Error::NotFinite { quantity: "x" });
    let short = State::from_f64(2, &[0.0], &[1.0; 4], &[0.0; 2], &[0.0; 4]);
    assert_eq!(short.unwrap_err(), Error::Shape { quantity: "x", expected: (2, 1), found: (1, 1) });
}

#[test]
fn affine_spins_determine_the_canonical_momentum() {
    let mut random = Random::new(8);
    let state = random.state(3);
    let (sigma, sigma_hat) = (&state.phi * &state.pi, &state.pi * &state.phi);
    let State { x, phi, p, pi } = state;
    let spatial = State::with_affine_spin(x.clone(), phi.clone(), p.clone(), &sigma).unwrap();
    let comoving = State::with_comoving_affine_spin(x, phi, p, &sigma_hat).unwrap();
    assert_eq!(spatial.pi, pi);
    assert_eq!(comoving.pi, pi);
}

/// The summary of a point against the same numbers one by one, at a point given in arbitrary floats.
#[test]
fn expected_values_are_the_rounded_exact_ones() {
    let terms = vec![
        Term::body_inertia(3, rational(1, 1)),
        Term::Casimir2(rational(1, 5)),
        Term::Casimir1Squared(rational(1, 10)),
        Term::BodyTranslation(rational(1, 1)),
    ];
    let kinetic = Kinetic::new(3, terms).unwrap();
    let phi = [1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05];
    let spin = [0.1, 0.4, -0.3, -0.2, -0.15, 0.25, 0.35, -0.1, 0.05];
    let phi = Matrix::from_f64("phi", 3, 3, &phi).unwrap();
    let spin = Matrix::from_f64("Sigma_hat", 3, 3, &spin).unwrap();
    let p = Matrix::from_f64("p", 3, 1, &[0.3, -0.2, 0.5]).unwrap();
    let state = State::with_comoving_affine_spin(Matrix::zeros(3, 1), phi, p, &spin).unwrap();
    let motion = kinetic.motion(&state).unwrap();
    let expected = kinetic.expected(&state).unwrap();
    assert_eq!(expected, motion.expected().unwrap());
    assert_eq!(expected.hamiltonian, rounded(motion.energy()));
    assert_eq!(expected.phi_dot, motion.rate().phi.to_f64());
    assert_eq!(expected.p_dot, [0.0; 3]);
    // d(phi Pi)/dt = phi_dot Pi + phi Pi_dot, d(Pi phi)/dt likewise.
    let State { phi, pi, .. } = motion.state();
    let rate = motion.rate();
    assert_eq!(expected.sigma_dot, (&(&rate.phi * pi) + &(phi * &rate.pi)).to_f64());
    assert_eq!(expected.sigma_hat_dot, (&(&rate.pi * phi) + &(pi * &rate.phi)).to_f64());
    assert_eq!(expected.p_hat_dot, (&rate.phi.transpose() * &state.p).to_f64());
}
