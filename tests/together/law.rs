//! The motion of each pair by the oracle: its energy stated a second time, with forces by plain definitions.

use affine_oracle::{
    Constraint, Differential, Hamiltonian, Invariant, Kinetic, Matrix as Exact, Place, Rational, Slopes,
    State, Term, rational, rounded,
};
use affine_runtime::decompose::LinearMap;
use affine_runtime::frames::Matrix;
use affine_tests::reference::entries;

use crate::forms::matrix;
use crate::lists::{Drawn, Pair};
use crate::squeeze::squeezed;

/// What moves the points of a pair.
pub(crate) struct Law {
    pair: Pair,
    drawn: Drawn,
    n: usize,
    energy: Energy,
    pub(crate) constraint: Option<Constraint>,
    friction: Option<Kinetic>,
}

enum Energy {
    Of(Kinetic),
    /// With a cube of momenta, which no kinetic energy of velocities has.
    Cubic(Hamiltonian),
}

/// At a point and a time.
#[derive(Clone, Debug)]
pub(crate) struct Expected {
    pub(crate) energy: f64,
    pub(crate) power: f64,
    /// Rates of `x, phi, p, Pi`.
    pub(crate) rates: [Vec<f64>; 4],
    /// What acts on `p` and on `Pi` beside the kinetic energy.
    pub(crate) push: [Vec<f64>; 2],
    pub(crate) condition: f64,
}

impl Law {
    pub(crate) fn new(pair: Pair, drawn: Drawn) -> Self {
        let n = pair.dim();
        let number = |name: char| rational(drawn.sixty_fourths(name)[0], 64);
        let energy = match pair.energy.name {
            "cubic momenta" => Energy::Cubic(Hamiltonian::new(
                [Invariant::Casimir2(number('c')), Invariant::Casimir3(number('a'))]
                    .into_iter()
                    .chain(centre_of_momenta(&pair, &drawn))
                    .collect(),
            )),
            _ => Energy::Of(Kinetic::new(n, terms(&pair, &drawn)).unwrap()),
        };
        let constraint = match pair.feature.name {
            "isochoric" => Some(Constraint::Isochoric),
            "conformal" => Some(Constraint::Conformal),
            "rigid" => Some(Constraint::Rigid),
            _ => None,
        };
        let friction = pair
            .feature
            .name
            .ends_with("friction")
            .then(|| Kinetic::new(n, vec![Term::Casimir1Squared(number('i'))]).unwrap());
        Self { pair, drawn, n, energy, constraint, friction }
    }

    /// A kinetic energy of velocities, where there is one.
    pub(crate) fn kinetic(&self) -> Option<&Kinetic> {
        match &self.energy {
            Energy::Of(kinetic) => Some(kinetic),
            Energy::Cubic(_) => None,
        }
    }

    /// The potential by its plain definition.
    fn potential(&self, place: &Place) -> Differential {
        let [k, w, s] = ['k', 'w', 's'].map(|name| self.drawn.value(name));
        match self.pair.feature.name {
            "potential" => place.trace_green() * k,
            "driven" => place.trace_green() * (place.t() * w).cos() * k,
            "stretches" => place.pairs(|d| d.power(4)) * k,
            "field" => place.trace_green() * s,
            "gravity" => gravity(place) * k,
            "metrics" => {
                let [g, eta] = metrics(&self.pair, &self.drawn);
                let volume = 0.5 * (rounded(&g.determinant()) / rounded(&eta.determinant())).ln();
                (place.q() + volume / place.n()).power(2) * k
            }
            "friction" | "force" | "gyroscope" | "kick" => place.q().power(2) * k,
            "driven friction" => place.q().power(2) * (place.t() * w).cos() * k,
            "pulled" => place.x(1).power(2) * k,
            "free" | "isochoric" | "conformal" | "rigid" => Differential::constant(0.0),
            other => panic!("no potential is stated for {other}"),
        }
    }

    /// What the field of a force adds to the rate of `Pi`.
    fn pushed<const N: usize>(&self, t: f64, state: &State, rate: &State) -> Option<Vec<f64>> {
        let strength = self.drawn.value('s');
        let (phi, phi_dot) = (matrix::<N>(&state.phi.to_f64()), matrix::<N>(&rate.phi.to_f64()));
        let (x, x_dot) = (state.x.to_f64(), rate.x.to_f64());
        let on_pi = match self.pair.feature.name {
            "force" => {
                let friction = phi_dot * phi.transpose();
                let along = Matrix::<N>::from_fn(|i, j| (x_dot[i] + x[j]) * phi[(j, 0)] - friction[(i, j)]);
                phi.inverse() * along * (strength * t.cos())
            }
            "gyroscope" => {
                let mut skew = Matrix::<N>::zeros();
                (skew[(0, 1)], skew[(1, 0)]) = (strength, -strength);
                skew * phi_dot.transpose()
            }
            "kick" => squeezed(strength, &phi),
            _ => return None,
        };
        Some(entries(&on_pi))
    }

    /// The motion through a point.
    pub(crate) fn at(&self, t: f64, state: &State) -> Expected {
        let n = self.n;
        let slopes = Slopes::of(&|place| self.potential(place), t, &state.x.to_f64(), &state.phi.to_f64());
        let transposed: Vec<f64> = (0..n * n).map(|k| -slopes.phi[n * (k % n) + k / n]).collect();
        let push = [slopes.x.iter().map(|slope| -slope).collect::<Vec<f64>>(), transposed];
        match &self.energy {
            Energy::Of(kinetic) => self.of_velocities(kinetic, (t, state), (slopes.t, push)),
            Energy::Cubic(hamiltonian) => {
                let State { x, phi, p, pi } = hamiltonian.rate(state);
                let sum = |a: Vec<f64>, b: &[f64]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
                let energy = rounded(&hamiltonian.energy(state).entry(0, 0)) + slopes.value;
                let rates = [x.to_f64(), phi.to_f64(), sum(p.to_f64(), &push[0]), sum(pi.to_f64(), &push[1])];
                Expected { energy, power: slopes.t, rates, push, condition: 10.0 }
            }
        }
    }

    /// The motion of a kinetic energy, to which constraint, friction and forces are added; the potential has `dU/dt` and `push`.
    fn of_velocities(
        &self,
        kinetic: &Kinetic,
        (t, state): (f64, &State),
        (mut power, mut push): (f64, [Vec<f64>; 2]),
    ) -> Expected {
        let n = self.n;
        let (motion, condition) = match self.constraint {
            Some(constraint) => (
                kinetic.constrained_motion(constraint, state, t, &|place| self.potential(place)).unwrap(),
                kinetic.constrained_condition(constraint, &state.phi).unwrap(),
            ),
            None => (
                kinetic.motion(state).unwrap().under(t, &|place| self.potential(place)).unwrap(),
                kinetic.condition(&state.phi).unwrap(),
            ),
        };
        let before = motion.rate().clone();
        let motion = match &self.friction {
            Some(friction) => motion.damped(friction).unwrap(),
            None => motion,
        };
        let force =
            if n == 2 { self.pushed::<2>(t, state, &before) } else { self.pushed::<3>(t, state, &before) };
        let motion = match force {
            Some(on_pi) => motion.pushed(&vec![0.0; n], &on_pi).unwrap(),
            None => motion,
        };
        // Whatever was added to Pi' after the potential, and its work.
        let added = (&motion.rate().pi - &before.pi).to_f64();
        let phi_dot = before.phi.transpose().to_f64();
        power += added.iter().zip(&phi_dot).map(|(force, velocity)| force * velocity).sum::<f64>();
        push[1].iter_mut().zip(&added).for_each(|(push, added)| *push += added);
        let State { x, phi, p, pi } = motion.rate();
        let rates = [x, phi, p, pi].map(Exact::to_f64);
        Expected { energy: rounded(motion.energy()), power, rates, push, condition }
    }

    /// How the rates change as the point does, by differences of order 4.
    pub(crate) fn change(&self, t: f64, state: &State, along: &State) -> [Vec<f64>; 4] {
        const STEPS: i64 = 1 << 14;
        let at = |steps: i64| {
            let moved = |value: &Exact, slope: &Exact| value + &slope.scaled(&rational(steps, STEPS));
            let State { x, phi, p, pi } = state;
            let moved = State {
                x: moved(x, &along.x),
                phi: moved(phi, &along.phi),
                p: moved(p, &along.p),
                pi: moved(pi, &along.pi),
            };
            self.at(t, &moved).rates
        };
        let [ahead, behind, far_ahead, far_behind] = [1, -1, 2, -2].map(at);
        core::array::from_fn(|of| {
            let slope = |k: usize| {
                let near = ahead[of][k] - behind[of][k];
                (8.0 * near - (far_ahead[of][k] - far_behind[of][k])) * STEPS as f64 / 12.0
            };
            (0..ahead[of].len()).map(slope).collect()
        })
    }

    /// A Hamiltonian in momenta is that of the kinetic energy which stands for it.
    pub(crate) fn assert_stated_twice(&self, state: &State) {
        let (Energy::Of(kinetic), "momenta") = (&self.energy, self.pair.energy.name) else { return };
        // The oracle's vorticity is that of orthonormal bases.
        if self.pair.feature.name == "metrics" {
            return;
        }
        let number = |name: char| rational(self.drawn.sixty_fourths(name)[0], 64);
        let internal = [Invariant::Casimir2(number('c')), Invariant::VorticitySquared(number('d'))];
        let stated = internal.into_iter().chain(centre_of_momenta(&self.pair, &self.drawn)).collect();
        let stated = Hamiltonian::new(stated).energy(state).entry(0, 0);
        assert_eq!(kinetic.hamiltonian(state).unwrap().entry(0, 0), stated);
    }
}

/// `g` and `eta`.
fn metrics(pair: &Pair, drawn: &Drawn) -> [Exact; 2] {
    let n = pair.dim();
    match pair.feature.name {
        "metrics" => ['G', 'H'].map(|name| symmetric(n, drawn, name)),
        _ => [Exact::identity(n), Exact::identity(n)],
    }
}

/// The centre of mass in a Hamiltonian of momenta.
fn centre_of_momenta(pair: &Pair, drawn: &Drawn) -> Option<Invariant> {
    let [in_space, in_body] = metrics(pair, drawn)
        .map(|metric| metric.inverse().unwrap().scaled(&rational(drawn.sixty_fourths('m')[0], 64)));
    match pair.centre.name {
        "held" => None,
        "space" => Some(Invariant::SpaceTranslationMetric(in_space)),
        "body" => Some(Invariant::BodyTranslationMetric(in_body)),
        other => panic!("no centre is stated for {other}"),
    }
}

/// Terms of the kinetic energy, with the metrics written out.
fn terms(pair: &Pair, drawn: &Drawn) -> Vec<Term> {
    let n = pair.dim();
    let number = |name: char| rational(drawn.sixty_fourths(name)[0], 64);
    let [g, eta] = metrics(pair, drawn);
    let [g_inverse, eta_inverse] = [&g, &eta].map(|metric| metric.inverse().unwrap());
    let body = |i: Rational| Term::BodyTensor(product(n, &eta, &eta_inverse).scaled(&i));
    let space = |i: Rational| Term::SpaceTensor(product(n, &g, &g_inverse).scaled(&i));
    let flat = |j: Rational| Term::FlatTensor(product(n, &g, &eta_inverse).scaled(&j));
    let mut terms = match pair.energy.name {
        "body" => vec![Term::Casimir2(number('a')), body(number('i'))],
        "space" => vec![Term::Casimir2(number('a')), space(number('i'))],
        "flat" => vec![flat(number('j'))],
        "flat and body" => vec![flat(number('j')), body(number('i'))],
        "flat, space and Casimir" => vec![flat(number('j')), space(number('i')), Term::Casimir2(number('a'))],
        // a = 1/(I + A) and c = I/(I^2 - A^2).
        "momenta" => {
            let (a, c) = (number('c'), number('d'));
            let i = &c / (&a * (rational(2, 1) * &c - &a));
            vec![Term::Casimir2(rational(1, 1) / a - &i), body(i)]
        }
        other => panic!("no energy is stated for {other}"),
    };
    // In momenta the coefficient is that of `|p|^2/2`.
    let mass = if pair.energy.name == "momenta" { rational(1, 1) / number('m') } else { number('m') };
    terms.extend(match pair.centre.name {
        "held" => None,
        "space" => Some(Term::SpaceTranslationMetric(g.scaled(&mass))),
        "body" => Some(Term::BodyTranslationMetric(eta.scaled(&mass))),
        other => panic!("no centre is stated for {other}"),
    });
    terms
}

fn symmetric(n: usize, drawn: &Drawn, name: char) -> Exact {
    let entries: Vec<Rational> = drawn.sixty_fourths(name).iter().map(|entry| rational(*entry, 64)).collect();
    Exact::from_rationals(n, n, &entries)
}

/// `K[(A,B),(C,D)] = left[A,C] right[B,D]`: the form `tr(right O^T left O)`.
fn product(n: usize, left: &Exact, right: &Exact) -> Exact {
    let pairs = || (0..n * n).map(|k| (k / n, k % n));
    let entries: Vec<Rational> = pairs()
        .flat_map(|(a, b)| pairs().map(move |(c, d)| (a, b, c, d)))
        .map(|(a, b, c, d)| left.entry(a, c) * right.entry(b, d))
        .collect();
    Exact::from_rationals(n * n, n * n, &entries)
}

/// `-3/10 int_0^inf ds/sqrt(det(G + s))`, the energy of a homogeneous ellipsoid in its own gravity, with `s = e^u` by the
/// trapezoidal rule, which converges like `exp(-2 pi^2/h)`: `s` has no singularity nearer to the real axis than `i pi`.
fn gravity(place: &Place) -> Differential {
    let (trace, det) = (place.trace_green(), place.det());
    let second = (trace * trace - place.trace_green_squared()) * 0.5;
    let (step, first, last) = (0.5, -80, 160);
    let term = |k: i32| {
        let s = (step * f64::from(k)).exp();
        let cubic = ((Differential::constant(s) + trace) * s + second) * s + det * det;
        Differential::constant(s) / cubic.sqrt()
    };
    (first..=last).map(term).fold(Differential::constant(0.0), |sum, term| sum + term) * (-0.3 * step)
}
