//! Conservation under Hamiltonians with potentials: what a kinetic energy alone never tells apart, against brackets
//! of the quantities written out in canonical coordinates.

use affine_codegen::algebra::{Arena, Polynomial, Rational};
use affine_codegen::mechanics::brackets::poisson;
use affine_codegen::mechanics::charts::{Chart, Linear, Momentum};
use affine_codegen::mechanics::conserved::{Candidate, Conservation};
use affine_codegen::mechanics::kinetics::Kinetics;

use super::brackets::Canonical;

type Square = Vec<Vec<Polynomial>>;

fn table(n: usize, entry: impl Fn(usize, usize) -> Polynomial) -> Square {
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

fn times(a: &Square, b: &Square) -> Square {
    table(a.len(), |i, j| {
        let mut sum = Polynomial::zero();
        (0..a.len()).for_each(|k| sum.add_product(&a[i][k], &b[k][j], &Rational::ONE));
        sum
    })
}

fn plus(a: &Square, b: &Square, weight: i64) -> Square {
    table(a.len(), |i, j| {
        let mut sum = a[i][j].clone();
        sum.add_scaled(&b[i][j], &Rational::from(weight));
        sum
    })
}

fn transposed(a: &Square) -> Square {
    table(a.len(), |i, j| a[j][i].clone())
}

fn trace(a: &Square) -> Polynomial {
    let mut sum = Polynomial::zero();
    (0..a.len()).for_each(|k| sum.add_scaled(&a[k][k], &Rational::ONE));
    sum
}

/// `n X - tr(X) 1`: the deviator without its denominator.
fn deviator(a: &Square) -> Square {
    let n = i64::try_from(a.len()).unwrap();
    let trace = trace(a);
    table(a.len(), |i, j| {
        let mut entry = a[i][j].scaled(&Rational::from(n));
        if i == j {
            entry.add_scaled(&trace, &Rational::MINUS_ONE);
        }
        entry
    })
}

/// `det a` by the first row.
fn determinant(a: &Square) -> Polynomial {
    let n = a.len();
    if n == 1 {
        return a[0][0].clone();
    }
    let mut sum = Polynomial::zero();
    for j in 0..n {
        let rest = a[1..].iter().map(|row| (0..n).filter(|k| *k != j).map(|k| row[k].clone()).collect());
        let sign = if j % 2 == 0 { Rational::ONE } else { Rational::MINUS_ONE };
        sum.add_product(&a[0][j], &determinant(&rest.collect()), &sign);
    }
    sum
}

fn power_trace(a: &Square, k: usize) -> Polynomial {
    trace(&(1..k).fold(a.clone(), |power, _| times(&power, a)))
}

/// Quantities in canonical coordinates.
struct Quantities {
    x: Vec<Polynomial>,
    p: Vec<Polynomial>,
    phi: Square,
    pi: Square,
    sigma: Square,
    sigma_hat: Square,
}

impl Quantities {
    fn new(canonical: &Canonical) -> Self {
        let chart = &canonical.chart;
        let n = chart.dim;
        Self {
            x: chart.x.iter().map(|x| Polynomial::atom(*x)).collect(),
            p: chart.p.iter().map(|p| Polynomial::atom(*p)).collect(),
            phi: table(n, |i, a| Polynomial::atom(chart.phi.0[i][a])),
            pi: table(n, |a, i| Polynomial::atom(chart.m.0[a][i])),
            sigma: table(n, |i, j| canonical.sigma(i, j)),
            sigma_hat: table(n, |a, b| canonical.sigma_hat(a, b)),
        }
    }

    fn orbital(&self) -> Square {
        table(self.x.len(), |i, j| self.x[i].mul(&self.p[j]))
    }

    fn components(&self, candidate: Candidate) -> Vec<Polynomial> {
        let skew = |a: &Square| plus(a, &transposed(a), -1);
        let norm = |a: &Square| vec![power_trace(&skew(a), 2)];
        let n = self.x.len();
        match candidate {
            Candidate::Energy => Vec::new(),
            Candidate::LinearMomentum => self.p.clone(),
            Candidate::ComovingLinearMomentum => {
                let p = table(n, |i, j| if j == 0 { self.p[i].clone() } else { Polynomial::zero() });
                times(&transposed(&self.phi), &p).concat()
            }
            Candidate::OrbitalAngularMomentum => skew(&self.orbital()).concat(),
            Candidate::TotalAffineMomentum => plus(&self.orbital(), &self.sigma, 1).concat(),
            Candidate::TotalAngularMomentum => skew(&plus(&self.orbital(), &self.sigma, 1)).concat(),
            Candidate::AffineSpin => self.sigma.concat(),
            Candidate::Deviator => deviator(&self.sigma).concat(),
            Candidate::Spin => skew(&self.sigma).concat(),
            Candidate::SpinNorm => norm(&self.sigma),
            Candidate::ComovingAffineSpin => self.sigma_hat.concat(),
            Candidate::ComovingDeviator => deviator(&self.sigma_hat).concat(),
            Candidate::Vorticity => skew(&self.sigma_hat).concat(),
            Candidate::VorticityNorm => norm(&self.sigma_hat),
            Candidate::CanonicalMomentum => self.pi.concat(),
            Candidate::Casimir1 => vec![trace(&self.sigma)],
            Candidate::Casimir2 => vec![power_trace(&self.sigma, 2)],
            Candidate::Casimir3 => vec![power_trace(&self.sigma, 3)],
            Candidate::DeviatorCasimir2 => vec![power_trace(&deviator(&self.sigma), 2)],
            Candidate::DeviatorCasimir3 => vec![power_trace(&deviator(&self.sigma), 3)],
        }
    }
}

/// All candidates in the order of the list.
const CANDIDATES: [Candidate; 20] = [
    Candidate::Energy,
    Candidate::LinearMomentum,
    Candidate::ComovingLinearMomentum,
    Candidate::OrbitalAngularMomentum,
    Candidate::TotalAffineMomentum,
    Candidate::TotalAngularMomentum,
    Candidate::AffineSpin,
    Candidate::Deviator,
    Candidate::Spin,
    Candidate::SpinNorm,
    Candidate::ComovingAffineSpin,
    Candidate::ComovingDeviator,
    Candidate::Vorticity,
    Candidate::VorticityNorm,
    Candidate::CanonicalMomentum,
    Candidate::Casimir1,
    Candidate::Casimir2,
    Candidate::Casimir3,
    Candidate::DeviatorCasimir2,
    Candidate::DeviatorCasimir3,
];

/// The canonical bracket of every component with `h`.
fn expected(canonical: &Canonical, h: &Polynomial) -> Vec<Candidate> {
    let quantities = Quantities::new(canonical);
    let still = |c: &Candidate| {
        quantities.components(*c).iter().all(|part| poisson(&canonical.chart, part, h).is_zero())
    };
    let plane = canonical.chart.dim == 2;
    let exists = |c: &Candidate| !plane || !matches!(c, Candidate::Casimir3 | Candidate::DeviatorCasimir3);
    CANDIDATES.into_iter().filter(exists).filter(still).collect()
}

/// Hamiltonians over any chart: kinetic parts and potentials by name.
fn hamiltonians(chart: &Chart) -> Vec<(&'static str, Polynomial)> {
    let n = chart.dim;
    let vector =
        |symbols: &[_]| -> Vec<Polynomial> { symbols.iter().map(|s| Polynomial::atom(*s)).collect() };
    let (x, p) = (vector(&chart.x), vector(&chart.p));
    let phi = table(n, |i, a| Polynomial::atom(chart.phi.0[i][a]));
    let m = table(n, |i, j| Polynomial::atom(chart.m.0[i][j]));
    let dot = |a: &[Polynomial], b: &[Polynomial]| {
        let mut sum = Polynomial::zero();
        a.iter().zip(b).for_each(|(a, b)| sum.add_product(a, b, &Rational::ONE));
        sum
    };
    let sum = |parts: &[&Polynomial]| {
        let mut sum = Polynomial::zero();
        parts.iter().for_each(|part| sum.add_scaled(part, &Rational::ONE));
        sum
    };
    let (casimir2, frobenius) = (power_trace(&m, 2), trace(&times(&m, &transposed(&m))));
    let det = determinant(&phi);
    let (green, cauchy) = (times(&transposed(&phi), &phi), times(&phi, &transposed(&phi)));
    let (isotropic, oscillator) = (trace(&green), sum(&[&dot(&p, &p), &dot(&x, &x)]));
    vec![
        ("tr M^2 + det phi", sum(&[&casimir2, &det])),
        ("tr M^2 + tr G", sum(&[&casimir2, &isotropic])),
        ("tr M^2 + G_11", sum(&[&casimir2, &green[0][0]])),
        ("tr M^2 + (phi phi^T)_11", sum(&[&casimir2, &cauchy[0][0]])),
        ("|M|^2 + det phi + |p|^2 + |x|^2", sum(&[&frobenius, &det, &oscillator])),
        ("tr M^2 + |p|^2 + x_1^2", sum(&[&casimir2, &dot(&p, &p), &x[0].mul(&x[0])])),
        ("tr M^2 + x.p", sum(&[&casimir2, &dot(&x, &p)])),
        ("det phi", det.clone()),
    ]
}

/// What the motion of a Hamiltonian keeps.
fn conserved(arena: &mut Arena, chart: &Chart, h: &Polynomial) -> Vec<Candidate> {
    let motion = Kinetics::polynomial(arena, chart, h).load();
    let mut conservation = Conservation::of(chart, None);
    conservation.under(arena, &[motion]);
    conservation.whole
}

#[test]
fn with_potentials() {
    for n in [2, 3] {
        for momentum in [Momentum::Canonical, Momentum::Space, Momentum::Body] {
            let mut arena = Arena::new();
            let chart = Chart::new(&mut arena, n, momentum, Some(Linear::Space));
            let canonical = Canonical::new(&mut arena, n);
            for (name, h) in hamiltonians(&chart) {
                let expected = expected(&canonical, &canonical.pulled_back(&chart, &h));
                assert_eq!(conserved(&mut arena, &chart, &h), expected, "{name}, M = {momentum:?}, n = {n}");
            }
        }
    }
}

/// A dilatational potential keeps the deviator and its Casimirs, and nothing that contains the trace.
#[test]
fn deviators_outlive_their_traces() {
    for n in [2, 3] {
        let mut arena = Arena::new();
        let chart = Chart::new(&mut arena, n, Momentum::Body, Some(Linear::Space));
        let (_, h) = hamiltonians(&chart).swap_remove(0);
        let list = conserved(&mut arena, &chart, &h);
        for kept in [Candidate::Deviator, Candidate::ComovingDeviator, Candidate::DeviatorCasimir2] {
            assert!(list.contains(&kept), "{kept:?}");
        }
        for lost in [Candidate::AffineSpin, Candidate::Casimir1, Candidate::Casimir2] {
            assert!(!list.contains(&lost), "{lost:?}");
        }
    }
}
