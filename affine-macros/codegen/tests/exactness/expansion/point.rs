//! Points of reduced charts with their rates, and the phase points that they expand to.

use affine_codegen::algebra::Polynomial;
use affine_codegen::algebra::kernel::Callee;
use affine_codegen::mechanics::charts::{Chart, Linear, Momentum};
use affine_codegen::mechanics::constraint::Constraint;
use affine_codegen::mechanics::reduction::Reduction;
use affine_codegen::mechanics::term::Frame;
use affine_codegen::symbol::Quantity;
use affine_oracle::Random;

use super::equations::Named;
use super::number::{Jet, Number, Stretches, Table};

/// What a reduction took out of the state, in numbers.
pub(super) struct Taken {
    pub(super) dim: usize,
    pub(super) confined: Option<Constraint>,
    /// The affine momentum of the reduced chart.
    pub(super) momentum: Momentum,
    /// Which momentum the reduced chart holds beside `x`, if it holds them.
    pub(super) linear: Option<Linear>,
    /// Is space turned, so that a constant `p` has one component?
    turned: bool,
    /// Is `p` state, and with that any vector later on?
    pushed: bool,
    /// Is all of the affine momentum conserved?
    affine: bool,
    /// Do the forces read single stretches?
    single: bool,
    /// `1/mu` of `|Vort|^2/(2 mu)` (body) or `|S|^2/(2 mu)` (space).
    pub(super) rotation: Option<(Frame, Number)>,
    /// `1/m` of a free centre of mass.
    pub(super) drift: Option<Number>,
    pub(super) dilatation: Option<Dilatation>,
}

impl Taken {
    /// What a reduction took out; `number` is the value of a coefficient.
    pub(super) fn new(
        confined: Option<Constraint>,
        reduction: &Reduction,
        dilatation: Option<Dilatation>,
        number: &dyn Fn(&Polynomial) -> Number,
    ) -> Self {
        let rotation = reduction.commuting.rotation.as_ref();
        let rotation = rotation.map(|rotation| (rotation.frame, number(&rotation.inverse_mass)));
        let drift = reduction.commuting.drift.as_ref().map(|drift| number(&drift.inverse_mass));
        let pushed = reduction
            .states
            .iter()
            .any(|(group, _)| [Quantity::LinearMomentum, Quantity::ComovingLinearMomentum].contains(group));
        let chart = Self::of(confined, &reduction.chart, reduction.conserved.affine);
        let single = reduction
            .system
            .kernels
            .iter()
            .any(|kernel| matches!(kernel.callee, Callee::Stretches | Callee::LogStretches));
        Self { turned: reduction.turn.is_some(), pushed, single, rotation, drift, dilatation, ..chart }
    }

    /// What a chart leaves out.
    pub(super) fn of(confined: Option<Constraint>, chart: &Chart, affine: bool) -> Self {
        Self {
            dim: chart.dim,
            confined,
            momentum: chart.momentum,
            linear: chart.linear,
            turned: false,
            pushed: true,
            affine,
            single: false,
            rotation: None,
            drift: None,
            dilatation: None,
        }
    }
}

/// The motion of `q` with its momentum.
pub(super) struct Dilatation {
    /// `alpha`: the affine velocity of the shear is the traceless part of the momentum over it.
    pub(super) alpha: Number,
    /// `1/m`.
    pub(super) inverse_mass: Number,
    pub(super) slope: Slope,
}

/// `U_dil'`
pub(super) enum Slope {
    Zero,
    /// `stiffness q`
    Linear(Number),
    /// `stiffness (D^j - D^-j)/(2 j)`
    Hyperbolic(Number, i64),
}

/// A point in the coordinates of all charts, and the constants of its motion.
pub(super) struct Point {
    pub(super) t: Number,
    pub(super) stretches: Stretches,
    /// The placement, or its isochoric part where the dilatation is taken out.
    phi: Table,
    x: Vec<Jet>,
    p: Vec<Jet>,
    /// The affine momentum of the reduced chart, or `O = s + w`.
    momentum: Table,
    /// `tr Sigma`, where the dilatation is taken out.
    expansion: Number,
    /// Turns space back.
    turn: Table,
    /// Chooses the time that has passed since the start, for what moves in closed form.
    elapsed: Jet,
}

/// Names of entries.
fn entries(stem: &str, n: usize) -> Vec<Vec<String>> {
    (1..=n).map(|i| (1..=n).map(|j| format!("{stem}_{i}{j}")).collect()).collect()
}

fn put(named: &mut Named, stem: &str, table: &Table) {
    let names = entries(stem, table.size()).concat();
    named.extend(names.into_iter().zip(table.0.concat()).map(|(name, jet)| (name, jet.value)));
}

fn put_vector(named: &mut Named, stem: &str, vector: &[Jet]) {
    named.extend(vector.iter().enumerate().map(|(i, jet)| (format!("{stem}_{}", i + 1), jet.value)));
}

/// Where the rates of a state are known by name, and zero where there are none.
fn moving_table(table: &Table, stem: &str, rates: &Named) -> Table {
    let rate = |i: usize, j: usize| rates.get(&format!("{stem}_{}{}", i + 1, j + 1)).copied();
    let moving = Table::new(table.size(), |i, j| Jet::constant(rate(i, j).unwrap_or(Number::ZERO)));
    table.moving(&moving)
}

fn moving_vector(vector: &[Jet], stem: &str, rates: &Named) -> Vec<Jet> {
    let rate = |i: usize| rates.get(&format!("{stem}_{}", i + 1)).copied().unwrap_or(Number::ZERO);
    vector.iter().enumerate().map(|(i, jet)| Jet { value: jet.value, rate: rate(i) }).collect()
}

/// A matrix from entries that determine the others under a constraint: those above the diagonal, and of the diagonal all
/// but the last of a traceless one, the first of one with equal entries.
fn completed(group: Constraint, m: &Table) -> Table {
    let n = m.size();
    let zero = Jet::constant(Number::ZERO);
    match group {
        Constraint::Isochoric => Table::new(n, |i, j| match (i, j) == (n - 1, n - 1) {
            true => (0..n - 1).fold(zero, |sum, a| sum - m.0[a][a]),
            false => m.0[i][j],
        }),
        Constraint::Rigid | Constraint::Conformal => Table::new(n, |i, j| match i.cmp(&j) {
            std::cmp::Ordering::Less => m.0[i][j],
            std::cmp::Ordering::Greater => zero - m.0[j][i],
            std::cmp::Ordering::Equal if group == Constraint::Conformal => m.0[0][0],
            std::cmp::Ordering::Equal => zero,
        }),
    }
}

/// The part of a matrix that acts on the Lie algebra of a group.
fn projected(group: Constraint, m: &Table) -> Table {
    let n = m.size();
    let half = Jet::constant(Number::integer(2).inverse());
    let share = Jet::constant(Number::integer(n as i64).inverse()) * m.trace();
    match group {
        Constraint::Isochoric => m - &Table::identity(n).scaled(share),
        Constraint::Rigid => m.skew().scaled(half),
        Constraint::Conformal => &m.skew().scaled(half) + &Table::identity(n).scaled(share),
    }
}

impl Point {
    /// A random point in the space that the reduction turns to.
    pub(super) fn random(random: &mut Random, taken: &Taken) -> Self {
        let n = taken.dim;
        let stretches = random_stretches(random, n, taken.confined);
        stretches.install(taken.single);
        let [left, right, turn, frame] = [0; 4].map(|_| Table::random_rotation(random, n));
        let (turned, q) = (taken.turned, &stretches.each);
        let diagonal = Table::new(n, |i, j| Jet::constant(if i == j { q[i] } else { Number::ZERO }));
        let mut phi = &(&left * &diagonal) * &right;
        if taken.dilatation.is_some() {
            phi = phi.scaled(Jet::constant(stretches.mean.inverse()));
        }
        // |x| is known.
        let length = Jet::constant(Number::random(random));
        let x = frame.0.iter().map(|row| length * row[0]).collect();
        let p = (0..n).map(|i| match turned && !taken.pushed && i > 0 {
            true => Jet::constant(Number::ZERO),
            false => Jet::constant(Number::random(random)),
        });
        let p = p.collect();
        let mut momentum = Table::random(random, n);
        if let Some(group) = taken.confined {
            momentum = projected(group, &momentum);
        }
        // I(O)_13 = 0 where I(O) is constant.
        if turned && taken.momentum == Momentum::Total && taken.affine && n == 3 {
            momentum.0[0][2] = Jet::constant(Number::ZERO);
        }
        if taken.dilatation.is_some() {
            momentum = projected(Constraint::Isochoric, &momentum);
        }
        Self {
            t: Number::random(random),
            stretches,
            phi,
            x,
            p,
            momentum,
            expansion: Number::random(random),
            turn: if turned { turn } else { Table::identity(n) },
            elapsed: Jet::constant(Number::random(random)),
        }
    }

    /// The same point with `p = 0`.
    pub(super) fn at_rest(self) -> Self {
        let p = vec![Jet::constant(Number::ZERO); self.p.len()];
        Self { p, ..self }
    }

    /// What the reduced equations and the constants of the trajectory read.
    pub(super) fn reduced(&self, taken: &Taken) -> Named {
        let mut named = Named::from([
            ("t".to_owned(), self.t),
            ("inverse_dilatation".to_owned(), self.stretches.mean.inverse()),
            ("q".to_owned(), self.stretches.mean_logarithm),
        ]);
        if taken.dilatation.is_some() {
            put(&mut named, "psi", &self.phi);
            let (symmetric, skew) = self.parts();
            for (i, j) in (0..taken.dim).flat_map(|i| (i..taken.dim).map(move |j| (i, j))) {
                named.insert(format!("shear_{}{}", i + 1, j + 1), symmetric.0[i][j].value);
                named.insert(format!("turn_{}{}", i + 1, j + 1), skew.0[i][j].value);
            }
            return named;
        }
        put(&mut named, "phi", &self.phi);
        if taken.linear.is_some() {
            put_vector(&mut named, "x", &self.x);
        }
        match taken.linear {
            Some(Linear::Space) => put_vector(&mut named, "p", &self.p),
            Some(Linear::Body) => put_vector(&mut named, "p_hat", &self.phi.transpose().times(&self.p)),
            None => {}
        }
        put(&mut named, taken.momentum.quantity().stem(), &self.momentum);
        named
    }

    /// `s` and `w` of `O = s + w`.
    fn parts(&self) -> (Table, Table) {
        let half = Jet::constant(Number::integer(2).inverse());
        let transposed = self.momentum.transpose();
        ((&self.momentum + &transposed).scaled(half), (&self.momentum - &transposed).scaled(half))
    }

    /// The affine momentum of the reduced chart under these rates.
    pub(super) fn moving_momentum(&self, taken: &Taken, rates: &Named) -> Table {
        if let Some(dilatation) = &taken.dilatation {
            let (symmetric, skew) = self.parts();
            let symmetric = moving_table(&symmetric, "shear", rates);
            let upper = moving_table(&skew, "turn", rates);
            let n = taken.dim;
            // O_ab = s_ab + w_ab above the diagonal, s_ab - w_ab below it.
            let velocity = Table::new(n, |i, j| match i.cmp(&j) {
                std::cmp::Ordering::Less => symmetric.0[i][j] + upper.0[i][j],
                std::cmp::Ordering::Greater => symmetric.0[j][i] - upper.0[j][i],
                std::cmp::Ordering::Equal => symmetric.0[i][i],
            });
            let shear = completed(Constraint::Isochoric, &velocity).scaled(Jet::constant(dilatation.alpha));
            let share = Jet::constant(Number::integer(n as i64).inverse()) * self.expansion(dilatation);
            return &shear + &Table::identity(n).scaled(share);
        }
        let moving = moving_table(&self.momentum, taken.momentum.quantity().stem(), rates);
        taken.confined.map_or(moving.clone(), |group| completed(group, &moving))
    }

    /// `tr Sigma` with its rate `-U_dil'(q)`.
    fn expansion(&self, dilatation: &Dilatation) -> Jet {
        let Stretches { mean, mean_logarithm, .. } = self.stretches;
        let slope = match dilatation.slope {
            Slope::Zero => Number::ZERO,
            Slope::Linear(stiffness) => stiffness * mean_logarithm,
            Slope::Hyperbolic(stiffness, j) => {
                stiffness * (mean.power(j) - mean.power(-j)) * Number::integer(2 * j).inverse()
            }
        };
        Jet { value: self.expansion, rate: -slope }
    }

    /// The phase point and its rate, from the rates of the reduced state.
    pub(super) fn expanded(&self, taken: &Taken, rates: &Named) -> Phase {
        let Stretches { mean, .. } = self.stretches;
        let phi = match &taken.dilatation {
            None => moving_table(&self.phi, "phi", rates),
            Some(dilatation) => {
                let rate = mean * dilatation.inverse_mass * self.expansion;
                moving_table(&self.phi, "psi", rates).scaled(Jet { value: mean, rate })
            }
        };
        let p = match taken.linear {
            Some(Linear::Body) => {
                let comoving = self.phi.transpose().times(&self.p);
                phi.inverse().transpose().times(&moving_vector(&comoving, "p_hat", rates))
            }
            _ => moving_vector(&self.p, "p", rates),
        };
        let mut x = moving_vector(&self.x, "x", rates);
        if let Some(inverse_mass) = taken.drift {
            x.iter_mut().zip(&p).for_each(|(x, p)| x.rate = inverse_mass * p.value);
        }
        let momentum = self.moving_momentum(taken, rates);
        let sigma_hat = match taken.momentum {
            Momentum::Body => momentum,
            Momentum::Space => &(&phi.inverse() * &momentum) * &phi,
            Momentum::Total => {
                let orbital = Table::new(taken.dim, |i, j| x[i] * p[j]);
                let spin = &momentum - &orbital;
                let spin = taken.confined.map_or(spin.clone(), |group| projected(group, &spin));
                &(&phi.inverse() * &spin) * &phi
            }
            Momentum::Canonical => &momentum * &phi,
        };
        let phase = Phase { x, phi, p, sigma_hat };
        let phase =
            taken.rotation.map_or(phase.clone(), |(frame, mu)| phase.rotated(frame, mu, self.elapsed));
        Phase {
            x: self.turn.times(&phase.x),
            phi: &self.turn * &phase.phi,
            p: self.turn.times(&phase.p),
            ..phase
        }
    }
}

/// A phase point and its rate.
#[derive(Clone)]
pub(super) struct Phase {
    pub(super) x: Vec<Jet>,
    pub(super) phi: Table,
    pub(super) p: Vec<Jet>,
    pub(super) sigma_hat: Table,
}

impl Phase {
    /// The flow of the squared vorticity or spin, at a time at which its rotation is Cayley's of a multiple of the
    /// generator: `phi exp(-t Vort/mu)`, or `exp(-t S/mu) phi`.
    fn rotated(self, frame: Frame, inverse_mu: Number, elapsed: Jet) -> Self {
        let sigma = &(&self.phi * &self.sigma_hat) * &self.phi.inverse();
        let spin = if frame == Frame::Body { self.sigma_hat.skew() } else { sigma.skew() };
        let still = spin.0.iter().flatten().all(|entry| entry.rate == Number::ZERO);
        assert!(still, "the generator of the rotation moves");
        let rotation = Table::rotation(&spin.scaled(elapsed));
        let rate = (&spin * &rotation).scaled(Jet::constant(-inverse_mu));
        let rotation = rotation.moving(&rate);
        match frame {
            Frame::Body => Self {
                phi: &self.phi * &rotation,
                sigma_hat: &(&rotation.transpose() * &self.sigma_hat) * &rotation,
                ..self
            },
            _ => Self { phi: &rotation * &self.phi, ..self },
        }
    }

    /// The point in the coordinates of a chart with `p` spatial, or `p_hat` too, and its rates.
    pub(super) fn coordinates(&self, frame: Frame) -> (Named, Named) {
        let mut named: Vec<(String, Jet)> = Vec::new();
        let n = self.phi.size();
        let mut table = |stem: &str, table: &Table| {
            named.extend(entries(stem, n).concat().into_iter().zip(table.0.concat()))
        };
        table("phi", &self.phi);
        match frame {
            Frame::Body => table("sigma_hat", &self.sigma_hat),
            Frame::Space => table("sigma", &(&(&self.phi * &self.sigma_hat) * &self.phi.inverse())),
            Frame::Flat => table("pi", &(&self.sigma_hat * &self.phi.inverse())),
        }
        let p_hat = self.phi.transpose().times(&self.p);
        for (stem, vector) in [("x", &self.x), ("p", &self.p), ("p_hat", &p_hat)] {
            named.extend(vector.iter().enumerate().map(|(i, jet)| (format!("{stem}_{}", i + 1), *jet)));
        }
        let values = named.iter().map(|(name, jet)| (name.clone(), jet.value)).collect();
        (values, named.into_iter().map(|(name, jet)| (name, jet.rate)).collect())
    }
}

/// Stretches of a placement in a group.
fn random_stretches(random: &mut Random, n: usize, group: Option<Constraint>) -> Stretches {
    let (mean, mean_logarithm) = match group {
        Some(Constraint::Isochoric | Constraint::Rigid) => (Number::ONE, Number::ZERO),
        Some(Constraint::Conformal) | None => (Number::random(random), Number::random(random)),
    };
    let alike = matches!(group, Some(Constraint::Rigid | Constraint::Conformal));
    let (mut each, mut logarithms) = (vec![mean; n], vec![mean_logarithm; n]);
    if !alike {
        for a in 1..n {
            let (factor, logarithm) = (Number::random(random), Number::random(random));
            each[0] = each[0] * factor.inverse();
            each[a] = each[a] * factor;
            logarithms[0] = logarithms[0] - logarithm;
            logarithms[a] = logarithms[a] + logarithm;
        }
    }
    Stretches { each, logarithms, mean, mean_logarithm }
}
