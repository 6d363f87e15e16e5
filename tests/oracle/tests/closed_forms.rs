//! The oracle against closed formulas of Slawianowski et al., Part I, which it does not use. Everything is exact.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_oracle::{
    Isotropic, Kinetic, Matrix, Observable, Random, Rational, Signature, State, Term, rational,
};

const DIMENSIONS: [usize; 2] = [2, 3];
const SAMPLES: usize = 4;

#[derive(Clone, Copy, Debug)]
enum Side {
    Body,
    Space,
}

const SIDES: [Side; 2] = [Side::Body, Side::Space];

/// `T` with inertia `J`, the Casimir terms of `isotropic`, and its mass where `translation` is asked for.
fn anisotropic(n: usize, side: Side, j: Matrix, isotropic: &Isotropic, translation: bool) -> Kinetic {
    let m = isotropic.m.clone();
    let mut terms = vec![Term::Casimir2(isotropic.a.clone()), Term::Casimir1Squared(isotropic.b.clone())];
    terms.push(match side {
        Side::Body => Term::BodyInertia(j),
        Side::Space => Term::SpaceInertia(j),
    });
    if translation {
        terms.push(match side {
            Side::Body => Term::BodyTranslation(m),
            Side::Space => Term::SpaceTranslation(m),
        });
    }
    Kinetic::new(n, terms).unwrap()
}

fn isotropic(n: usize, side: Side, coefficients: &Isotropic, translation: bool) -> Kinetic {
    anisotropic(n, side, times_identity(n, &coefficients.i), coefficients, translation)
}

fn times_identity(n: usize, c: &Rational) -> Matrix {
    Matrix::identity(n).scaled(c)
}

/// `J O^T + A O + B tr(O) 1`.
fn legendre(j: &Matrix, coefficients: &Isotropic, o: &Matrix) -> Matrix {
    let trace = times_identity(o.shape().0, &(o.trace().entry(0, 0) * &coefficients.b));
    &(&(j * &o.transpose()) + &o.scaled(&coefficients.a)) + &trace
}

/// `O` and `X` of the side: co-moving velocity and spin, or spatial ones.
fn frame(side: Side, state: &State, phi_dot: &Matrix) -> (Matrix, Matrix) {
    let inverse = state.phi.inverse().unwrap();
    match side {
        Side::Body => (&inverse * phi_dot, &state.pi * &state.phi),
        Side::Space => (phi_dot * &inverse, &state.phi * &state.pi),
    }
}

fn power(base: &Rational, exponent: usize) -> Rational {
    (0..exponent).fold(rational(1, 1), |product, _| product * base)
}

#[test]
fn legendre_transformation_of_isotropic_and_anisotropic_energies() {
    let mut random = Random::new(418);
    for n in DIMENSIONS {
        for side in SIDES {
            for _ in 0..SAMPLES {
                let coefficients = random.isotropic(n);
                for j in [times_identity(n, &coefficients.i), random.inertia(n)] {
                    let kinetic = anisotropic(n, side, j.clone(), &coefficients, true);
                    let (x, phi) = (random.matrix(n, 1), random.placement(n));
                    let (x_dot, phi_dot) = (random.matrix(n, 1), random.matrix(n, n));
                    let state = kinetic.legendre(&x, &phi, &x_dot, &phi_dot).unwrap();
                    let (o, spin) = frame(side, &state, &phi_dot);
                    // (4.18), (4.20), and X = J O^T + A O + B tr(O) 1 for (4.17).
                    assert_eq!(spin, legendre(&j, &coefficients, &o), "{n} {side:?}");
                    // (4.7): p = m C x_dot; R: p = m x_dot.
                    let inverse = phi.inverse().unwrap();
                    let p = match side {
                        Side::Body => &(&inverse.transpose() * &inverse) * &x_dot,
                        Side::Space => x_dot.clone(),
                    };
                    assert_eq!(state.p, p.scaled(&coefficients.m));
                    assert_eq!(kinetic.velocity(&state).unwrap(), (x_dot, phi_dot));
                }
            }
        }
    }
}

#[test]
fn legendre_transformation_of_tensors_and_dalembert() {
    let mut random = Random::new(46);
    for n in DIMENSIONS {
        for _ in 0..SAMPLES {
            let (k, j) = (random.tensor(n), random.inertia(n));
            let (x, phi, zero) = (Matrix::zeros(n, 1), random.placement(n), Matrix::zeros(n, 1));
            let phi_dot = random.matrix(n, n);
            // X = (dT/dO)^T with T = K O O/2: X^T = K O as columns.
            let transposed = |o: &Matrix| (&k * &o.clone().reshaped(n * n, 1)).reshaped(n, n).transpose();
            for (side, term) in
                [(Side::Body, Term::BodyTensor(k.clone())), (Side::Space, Term::SpaceTensor(k.clone()))]
            {
                let kinetic = Kinetic::new(n, vec![term]).unwrap();
                let state = kinetic.legendre(&x, &phi, &zero, &phi_dot).unwrap();
                let (o, spin) = frame(side, &state, &phi_dot);
                assert_eq!(spin, transposed(&o), "{n} {side:?}");
            }
            let flat = Kinetic::new(n, vec![Term::FlatTensor(k.clone())]).unwrap();
            assert_eq!(flat.legendre(&x, &phi, &zero, &phi_dot).unwrap().pi, transposed(&phi_dot));
            // (2.2): Pi = J phi_dot^T.
            let dalembert = Kinetic::new(n, vec![Term::DAlembert(j.clone())]).unwrap();
            let state = dalembert.legendre(&x, &phi, &zero, &phi_dot).unwrap();
            assert_eq!(state.pi, &j * &phi_dot.transpose());
        }
    }
}

#[test]
fn isotropic_energy_as_tensor_has_the_same_mass_matrix() {
    let mut random = Random::new(419);
    for n in DIMENSIONS {
        for side in SIDES {
            let c = random.isotropic(n);
            let mut entries = Vec::new();
            for row in 0..n * n {
                for column in 0..n * n {
                    let (a, b, c_, d) = (row / n, row % n, column / n, column % n);
                    let on = |yes: bool, value: &Rational| if yes { value.clone() } else { rational(0, 1) };
                    entries.push(
                        on(a == c_ && b == d, &c.i)
                            + on(a == d && b == c_, &c.a)
                            + on(a == b && c_ == d, &c.b),
                    );
                }
            }
            let k = Matrix::from_rationals(n * n, n * n, &entries);
            let term = match side {
                Side::Body => Term::BodyTensor(k),
                Side::Space => Term::SpaceTensor(k),
            };
            let tensor = Kinetic::new(n, vec![term]).unwrap();
            let phi = random.placement(n);
            let named = isotropic(n, side, &c, false).mass_matrix(&phi).unwrap();
            assert_eq!(tensor.mass_matrix(&phi).unwrap(), named, "{n} {side:?}");
        }
    }
}

#[test]
fn hamiltonian_of_isotropic_energies() {
    let mut random = Random::new(424);
    for n in DIMENSIONS {
        for side in SIDES {
            for _ in 0..SAMPLES {
                let c = random.isotropic(n);
                let kinetic = isotropic(n, side, &c, false);
                let state = random.state(n).at_rest();
                let (_, x) = frame(side, &state, &Matrix::zeros(n, n));
                // (5.10), (5.11).
                let [symmetric, skew, trace] = c.eigenvalues(n);
                let scalar = |matrix: &Matrix| matrix.trace().entry(0, 0);
                let (sigma, w, dilatational) = (x.deviator(), x.skew(), scalar(&x));
                let count = rational(i64::try_from(n).unwrap(), 1);
                let expected = scalar(&(&sigma * &sigma)) / (rational(2, 1) * &symmetric)
                    + &dilatational * &dilatational / (rational(2, 1) * count * trace)
                    - &c.i * scalar(&(&w * &w)) / (rational(4, 1) * symmetric * skew);
                assert_eq!(kinetic.hamiltonian(&state).unwrap().entry(0, 0), expected, "{n} {side:?}");
                assert_eq!(*kinetic.motion(&state).unwrap().energy(), expected);
            }
        }
    }
}

#[test]
fn balance_laws_of_affine_models() {
    let mut random = Random::new(49);
    for n in DIMENSIONS {
        for _ in 0..SAMPLES {
            let m = random.isotropic(n).m;
            let k = random.tensor(n);
            let state = random.state(n);
            let left = vec![Term::BodyTensor(k.clone()), Term::BodyTranslation(m.clone())];
            let left = Kinetic::new(n, left).unwrap();
            let motion = left.motion(&state).unwrap();
            let (oh, sigma_hat) = frame(Side::Body, &state, &motion.rate().phi);
            let p_hat = &state.phi.transpose() * &state.p;
            let inverse_mass = m.recip();
            // (4.9): dSigma/dt = -(1/m) (phi phi^T p) p^T, (4.10): dI(O)/dt = 0.
            let flux = (&(&state.phi * &p_hat) * &state.p.transpose()).scaled(&inverse_mass);
            assert_eq!(&motion.bracket(Observable::AffineSpin).unwrap() + &flux, Matrix::zeros(n, n));
            assert!(motion.bracket(Observable::TotalAffineMomentum).unwrap().is_zero());
            // dSh/dt = [Sh, Oh] - ph ph^T/m, dph/dt = Oh^T ph, dx/dt = phi ph/m.
            let commutator = &(&sigma_hat * &oh) - &(&oh * &sigma_hat);
            let expected = &commutator - &(&p_hat * &p_hat.transpose()).scaled(&inverse_mass);
            assert_eq!(motion.bracket(Observable::ComovingAffineSpin).unwrap(), expected);
            assert_eq!(motion.bracket(Observable::ComovingLinearMomentum).unwrap(), &oh.transpose() * &p_hat);
            assert_eq!(motion.rate().x, (&state.phi * &p_hat).scaled(&inverse_mass));

            let right = vec![Term::SpaceTensor(k), Term::SpaceTranslation(m)];
            let right = Kinetic::new(n, right).unwrap();
            let motion = right.motion(&state).unwrap();
            let (om, sigma) = frame(Side::Space, &state, &motion.rate().phi);
            // (4.11): dSh/dt = 0, dSigma/dt = [Om, Sigma].
            assert!(motion.bracket(Observable::ComovingAffineSpin).unwrap().is_zero());
            let commutator = &(&om * &sigma) - &(&sigma * &om);
            assert_eq!(motion.bracket(Observable::AffineSpin).unwrap(), commutator);
            assert!(motion.rate().p.is_zero());
        }
    }
}

#[test]
fn balance_laws_of_the_dalembert_model() {
    let mut random = Random::new(31);
    for n in DIMENSIONS {
        let j = random.inertia(n);
        let kinetic = vec![Term::DAlembert(j.clone()), Term::SpaceTranslation(rational(3, 2))];
        let kinetic = Kinetic::new(n, kinetic).unwrap();
        let state = random.state(n);
        let motion = kinetic.motion(&state).unwrap();
        let (om, sigma) = frame(Side::Space, &state, &motion.rate().phi);
        // Pi = const, (3.1): dSigma/dt = Om Sigma, (3.2): Sigma = J[phi] Om^T.
        assert!(motion.rate().pi.is_zero());
        assert_eq!(motion.bracket(Observable::AffineSpin).unwrap(), &om * &sigma);
        let quadrupole = &(&state.phi * &j) * &state.phi.transpose();
        assert_eq!(sigma, &quadrupole * &om.transpose());
    }
}

#[test]
fn determinant_of_the_hessian() {
    let mut random = Random::new(5);
    for n in DIMENSIONS {
        for side in SIDES {
            for _ in 0..SAMPLES {
                let c = random.isotropic(n);
                let phi = random.placement(n);
                // On the Lie algebra times the Jacobian det(phi)^(-2n) of O -> phi_dot.
                let jacobian = power(&phi.determinant(), 2 * n).recip();
                let [symmetric, skew, trace] = c.eigenvalues(n);
                let (pairs, squares) = (n * (n - 1) / 2, n * (n + 1) / 2 - 1);
                let expected = power(&symmetric, squares) * power(&skew, pairs) * trace * &jacobian;
                let mass = isotropic(n, side, &c, false).mass_matrix(&phi).unwrap();
                assert_eq!(mass.determinant(), expected, "{n} {side:?}");

                // (4.17) with J = diag(j_a): prod (j_a j_b - A^2) [prod (j_a + A) + B sum_a prod_{b != a} (j_b + A)].
                let diagonal: Vec<Rational> = (0..n).map(|_| rational(random.integer(1, 9), 4)).collect();
                let mut j = Matrix::zeros(n, n);
                for (a, entry) in diagonal.iter().enumerate() {
                    j = &j + &Matrix::unit(n, a, a).scaled(entry);
                }
                let mut skew_part = rational(1, 1);
                let mut sum = rational(0, 1);
                for a in 0..n {
                    for b in 0..a {
                        skew_part *= &diagonal[a] * &diagonal[b] - &c.a * &c.a;
                    }
                    let others = (0..n).filter(|&b| b != a);
                    sum += others.fold(rational(1, 1), |product, b| product * (&diagonal[b] + &c.a));
                }
                let product = diagonal.iter().fold(rational(1, 1), |product, entry| product * (entry + &c.a));
                let expected = skew_part * (product + &c.b * sum) * jacobian;
                let mass = anisotropic(n, side, j, &c, false).mass_matrix(&phi).unwrap();
                assert_eq!(mass.determinant(), expected, "{n} {side:?}");
            }
        }
    }
}

#[test]
fn signature_of_isotropic_energies() {
    let mut random = Random::new(55);
    for n in DIMENSIONS {
        for pattern in 0..8 {
            let sign = |bit: i64| if pattern >> bit & 1 == 0 { 1 } else { -1 };
            let [symmetric, skew, trace] =
                [0, 1, 2].map(|bit| rational(sign(bit) * random.integer(1, 20), 7));
            let count = rational(i64::try_from(n).unwrap(), 1);
            let half = rational(1, 2);
            let coefficients = Isotropic {
                i: (&symmetric + &skew) * &half,
                a: (&symmetric - &skew) * half,
                b: (trace - symmetric) / count,
                m: rational(-2, 3),
            };
            let multiplicities = [n * (n + 1) / 2 - 1, n * (n - 1) / 2, 1];
            let of = |wanted: i64| {
                (0..3)
                    .filter(|&bit| sign(bit) == wanted)
                    .map(|bit| multiplicities[bit as usize])
                    .sum::<usize>()
            };
            let phi = random.placement(n);
            for side in SIDES {
                let pinned = isotropic(n, side, &coefficients, false).signature(&phi).unwrap();
                assert_eq!(pinned, Signature { positive: of(1), negative: of(-1), zero: 0 });
                let free = isotropic(n, side, &coefficients, true).signature(&phi).unwrap();
                assert_eq!(free, Signature { positive: of(1), negative: of(-1) + n, zero: 0 });
            }
        }
        // I = A: the skew directions are lost.
        let degenerate =
            Isotropic { i: rational(1, 1), a: rational(1, 1), b: rational(0, 1), m: rational(1, 1) };
        let signature = isotropic(n, Side::Body, &degenerate, false).signature(&random.placement(n)).unwrap();
        assert_eq!(signature.zero, n * (n - 1) / 2);
    }
}

/// `dH/dq`, `dH/dP` by dual numbers through mass matrix and elimination, against the route through `T` alone.
#[test]
fn two_routes_to_the_gradient_of_the_hamiltonian() {
    let mut random = Random::new(6);
    for n in DIMENSIONS {
        let j = random.inertia(n);
        let terms = vec![
            Term::BodyInertia(random.inertia(n)),
            Term::SpaceTensor(random.tensor(n)),
            Term::DAlembert(j),
            Term::Casimir2(rational(-1, 3)),
            Term::BodyTranslation(rational(5, 4)),
            Term::SpaceTranslation(rational(1, 2)),
        ];
        let kinetic = Kinetic::new(n, terms).unwrap();
        let state = random.state(n);
        let motion = kinetic.motion(&state).unwrap();
        let rate = motion.rate();
        let zero = State {
            x: Matrix::zeros(n, 1),
            phi: Matrix::zeros(n, n),
            p: Matrix::zeros(n, 1),
            pi: Matrix::zeros(n, n),
        };
        let gradient =
            |direction: &State| kinetic.hamiltonian(&state.along(direction)).unwrap().slope().entry(0, 0);
        for i in 0..n {
            let unit = Matrix::identity(n).rows(i, 1).transpose();
            assert_eq!(gradient(&State { p: unit.clone(), ..zero.clone() }), rate.x.entry(i, 0));
            assert_eq!(gradient(&State { x: unit, ..zero.clone() }), -rate.p.entry(i, 0));
            for a in 0..n {
                let direction = State { phi: Matrix::unit(n, i, a), ..zero.clone() };
                assert_eq!(gradient(&direction), -rate.pi.entry(a, i));
                let direction = State { pi: Matrix::unit(n, a, i), ..zero.clone() };
                assert_eq!(gradient(&direction), rate.phi.entry(i, a));
            }
        }
        assert!(motion.bracket(Observable::Energy).unwrap().is_zero());
    }
}
