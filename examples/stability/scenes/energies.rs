//! Energies and motions under potentials that are made of `q` and tensors together, far from the undeformed state.

use affine_runtime::prelude::*;
use affine_runtime::report::{Demand, Oracle, StabilityReport};

use super::shared::{relative_distance, run, scene};
use super::stretches::{SAME, generic};

/// Bodies whose potential is a function of the shear alone, each written in another way.
macro_rules! shears {
    ($($name:ident $n:literal ($($inertia:tt)*) $words:literal ($($potential:tt)*);)*) => {
        $(
            #[affine_model(dim = $n, kinetic(casimir2 = 0.2, body_inertia = $($inertia)*), potential = $($potential)*)]
            pub(crate) struct $name;
        )*

        fn each(report: &mut StabilityReport) -> affine_runtime::Result<()> {
            $(of_shear::<$n, _>(
                report,
                ($words, &$name),
                |phi, rate| $name.at_velocity(phi, phi * rate),
                |phi, spin| $name.at_momentum(phi, spin),
            )?;)*
            Ok(())
        }
    };
}

shears! {
    NeoHookean 3 (diag(1, 1.5, 2)) "neo-Hookean" (0.5*(tr(G)*exp(-2*q) - 3));
    SecondInvariant 3 (diag(1, 1.5, 2)) "I2/D^4" (I2*exp(-4*q));
    Logarithm 3 (diag(1, 1.5, 2)) "ln(tr G) - 2q" (ln(tr(G)) - 2*q);
    Root 3 (diag(1, 1.5, 2)) "sqrt(1 + tr Ct/D^2)" (sqrt(1 + tr(Ct)*exp(-2*q)));
    Quotient 3 (diag(1, 1.5, 2)) "1/(1 + tr G^2/D^4)" (1/(1 + tr(G*G)*D^(-4)));
    Stretches 3 (diag(1, 1.5, 2)) "sum Q_a^2/D^2" ((Q1^2 + Q2^2 + Q3^2)*exp(-2*q));
    NeoHookeanDisc 2 (diag(1, 1.5)) "neo-Hookean" (0.5*(tr(G)*exp(-2*q) - 2));
    SquareDisc 2 (diag(1, 1.5)) "tr G^2/D^4" (tr(G*G)*exp(-4*q));
    EntriesDisc 2 (diag(1, 1.5)) "G_12^2/D^4 + G_11/D^2" (G[1,2]^2*exp(-4*q) + G[1,1]*D^(-2));
}

/// Some fifty roundings of an energy that is a difference.
const DIGITS: f64 = 1e-14;

pub(super) fn cases(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    report.heading("potentials of q and tensors together");
    each(report)?;
    coefficients(report)
}

/// `phi -> c phi` with the same co-moving momentum changes neither the energy nor `phi/c`.
fn of_shear<const N: usize, M: Model<N>>(
    report: &mut StabilityReport,
    (name, model): (&'static str, &M),
    moving: impl Fn(Matrix<N>, Matrix<N>) -> affine_runtime::Result<M::Point<f64>>,
    start: impl Fn(Matrix<N>, Comoving<AffineSpin<N>>) -> affine_runtime::Result<M::Point<f64>>,
) -> affine_runtime::Result<()> {
    let (phi, rate) = generic();
    let [phi, rate] = [phi, rate].map(|m| Matrix::<N>::from_fn(|i, j| m[(i, j)]));
    let plain = moving(phi, rate)?;
    let motion = run(model, plain, 2.0)?;
    for q in [1.0_f64, 5.0, 18.0, 50.0, 150.0, 300.0].into_iter().flat_map(|q| [q, -q]) {
        let from = start(phi * q.exp(), plain.sigma_hat())?;
        let named = |quantity| scene(name, N, format!("q = {q}"), quantity, Oracle::Invariance);
        report.case(named("H"), Demand::Held(DIGITS), || {
            let [found, expected] = [&from, &plain].map(|point| model.hamiltonian(0.0, point));
            Ok((((found - expected) / expected).abs(), 0))
        });
        report.case(named("phi"), Demand::Held(SAME), || {
            let mapped = run(model, from, 2.0)?;
            let error = relative_distance(&(mapped.end().1.phi() / q.exp()), motion.end().1.phi());
            Ok((error, mapped.statistics().steps))
        });
    }
    Ok(())
}

/// Powers of `D` with coefficients that make up for them.
#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = a*exp(q) + b*exp(-q) + c*tr(G),
)]
pub(crate) struct Weighed {
    a: f64,
    b: f64,
    c: f64,
}

fn coefficients(report: &mut StabilityReport) -> affine_runtime::Result<()> {
    let (phi, rate) = generic();
    let plain = Weighed { a: 0.3, b: 0.2, c: 0.1 }.prepare()?;
    let expected = plain.hamiltonian(0.0, &plain.at_velocity(phi, rate)?);
    for q in [18.0_f64, 150.0, 300.0].into_iter().flat_map(|q| [q, -q]) {
        let named = scene("d'Alembert, D, 1/D, tr G", 3, format!("q = {q}"), "H", Oracle::Invariance);
        report.case(named, Demand::Held(DIGITS), || {
            let d = q.exp();
            let mapped = Weighed { a: 0.3 / d, b: 0.2 * d, c: 0.1 / (d * d) }.prepare()?;
            let found = mapped.hamiltonian(0.0, &mapped.at_velocity(phi * d, rate)?);
            Ok((((found - expected) / expected).abs(), 0))
        });
    }
    Ok(())
}
