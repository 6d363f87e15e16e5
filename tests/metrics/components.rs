//! Potentials that name components: those of the user's bases, `G_AB = g_ij phi^i_A phi^j_B`,
//! `Ct^ij = eta^AB phi^i_A phi^j_B`.

use affine_oracle::{Differential, Kinetic, Place as Where, State, Term, rational};
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

use super::{agrees_under, moving, plane, product, space};

/// `sum over k, l of metric[k][l] phi(k) phi(l)`.
fn contracted<const N: usize>(
    metric: &Matrix<N>,
    left: impl Fn(usize) -> Differential,
    right: impl Fn(usize) -> Differential,
) -> Differential {
    let pairs = (0..N * N).map(|k| (k / N, k % N));
    pairs.fold(Differential::constant(0.0), |sum, (k, l)| sum + left(k + 1) * right(l + 1) * metric[(k, l)])
}

/// `G_AB`.
fn green<const N: usize>(g: &Matrix<N>, place: &Where, a: usize, b: usize) -> Differential {
    contracted(g, |i| place.phi(i, a), |j| place.phi(j, b))
}

/// `Ct^ij`.
fn finger<const N: usize>(eta_inverse: &Matrix<N>, place: &Where, i: usize, j: usize) -> Differential {
    contracted(eta_inverse, |a| place.phi(i, a), |b| place.phi(j, b))
}

#[test]
fn beside_numbers() {
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
        kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2),
        potential = G[1,1]*G[1,2] + abs(Ct[2,2])^3 + phi[1,2]*x[2] + ln(G[2,2]) + norm(x)^2
    )]
    struct Body;
    let [g, _, eta, eta_inverse] = plane();
    let kinetic = Kinetic::new(
        2,
        vec![
            Term::BodyTensor(product(2, &eta, &eta_inverse)),
            Term::Casimir2(rational(1, 5)),
            Term::BodyTranslationMetric(eta.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    let [g, eta_inverse] = [&g, &eta_inverse].map(|m| Matrix::<2>::from_row_slice(&m.to_f64()));
    let under = |state: &State| {
        let energy = |place: &Where| {
            green(&g, place, 1, 1) * green(&g, place, 1, 2)
                + finger(&eta_inverse, place, 2, 2).power(3)
                + place.phi(1, 2) * place.x(2)
                + green(&g, place, 2, 2).ln()
                + contracted(&g, |i| place.x(i), |j| place.x(j))
        };
        kinetic.motion(state).unwrap().under(0.0, &energy).unwrap().expected().unwrap()
    };
    let (at, back) = moving!(Body, 2);
    agrees_under(&Body, &kinetic, under, at, back);
}

#[test]
fn beside_fields() {
    #[affine_model(
        dim = 3,
        metrics(space = g, body = eta),
        kinetic(dalembert = j, space_translation = 2),
        potential = c*G[1,3]^2 + 0.5*Ct[1,2] + x[3]*phi[2,1] + hyperbolic_dilatation(1)
    )]
    struct Body {
        g: Matrix<3>,
        eta: Matrix<3>,
        j: Matrix<3>,
        c: f64,
    }
    let [g, _, eta, eta_inverse] = space();
    let inertia = super::twentieths(3, &[30, 5, 0, 5, 40, -10, 0, -10, 25]);
    let kinetic = Kinetic::new(
        3,
        vec![
            Term::FlatTensor(product(3, &g, &inertia)),
            Term::SpaceTranslationMetric(g.scaled(&rational(2, 1))),
        ],
    )
    .unwrap();
    let [g, eta, eta_inverse, j] =
        [&g, &eta, &eta_inverse, &inertia].map(|m| Matrix::<3>::from_row_slice(&m.to_f64()));
    let volumes = (g.determinant() / eta.determinant()).ln() / 6.0;
    let model = Body { g, eta, j, c: 0.75 }.prepare().unwrap();
    let under = |state: &State| {
        let energy = |place: &Where| {
            let sinh = (place.q() + Differential::constant(volumes)).sinh();
            green(&g, place, 1, 3).power(2) * 0.75
                + finger(&eta_inverse, place, 1, 2) * 0.5
                + place.x(3) * place.phi(2, 1)
                + sinh * sinh * 0.5
        };
        kinetic.motion(state).unwrap().under(0.0, &energy).unwrap().expected().unwrap()
    };
    let (at, back) = moving!(model, 3);
    agrees_under(&model, &kinetic, under, at, back);
}

/// A function of `G` leaves the spin, one of `Ct` the vorticity, whatever the bases. `T` is affine in space, so that of `Sigma` stays
/// what leaves the rows of `phi` that `U` reads: `{U, Sigma^i_j} = phi^i_A dU/dphi^j_A`.
#[test]
fn what_they_conserve() {
    macro_rules! kept {
        ($(($($potential:tt)*) $kept:expr, $components:expr;)*) => { $( {
            #[affine_model(
                dim = 2,
                metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
                kinetic(casimir2 = 0.2, body_inertia = 1),
                potential = $($potential)*
            )]
            struct Body;
            let components: [&str; _] = $components;
            let (whole, rest) = Body::DESCRIPTION.conserved.split_at($kept.len());
            assert_eq!(whole, $kept, "{}", stringify!($($potential)*));
            let rest: Vec<&str> = rest.iter().map(|quantity| quantity.symbol()).collect();
            assert_eq!(rest, components, "{}", stringify!($($potential)*));
            let (phi, spin) = (Matrix::<2>::new(1.1, 0.2, -0.1, 0.9), Matrix::<2>::new(0.1, 0.4, -0.3, -0.2));
            let start = Body.at_momentum(phi, Comoving(spin)).unwrap();
            let run = Simulation::new(&Body, start).until(1.0).tolerance(1e-13).run().unwrap();
            assert!(run.conservation().worst() < 1e-11, "{}", run.conservation());
        } )* };
    }
    use Conserved::{Energy, Spin, SpinNorm, Vorticity, VorticityNorm};
    kept! {
        (G[1,2]^2) [Energy, Spin, SpinNorm], [];
        (Ct[1,2]^2) [Energy, Vorticity, VorticityNorm], ["sigma_11 - sigma_22"];
        (phi[1,2]^2) [Energy], ["sigma_12", "sigma_22"];
    }
}

/// Of `phi_dot` alone, `T` is the same after `phi -> phi exp(E)` with `E J + J E^T = 0`, which conserves
/// `J_b sigma_hat_ab - J_a sigma_hat_ba`, in the user's bases with the user's `J`; a potential of `det phi` does not change that.
/// In orthonormal bases it is `J' = B J B^T`, here `diag(3 1.5, 7 2, 2 3)`, and the change of bases has roots of 3, 7 and 2.
#[test]
fn what_the_carried_inertia_conserves() {
    #[affine_model(
        dim = 3,
        metrics(space = diag(2, 3, 5), body = diag(3, 7, 2)),
        kinetic(dalembert = diag(1.5, 2, 3)),
        potential = hyperbolic_dilatation(1)
    )]
    struct Body;
    #[affine_model(dim = 3, kinetic(dalembert = diag(4.5, 14, 6)), potential = hyperbolic_dilatation(1))]
    struct Carried;
    let listed = |conserved: &[Conserved], components: [&str; 3]| {
        let symbols: Vec<&str> = conserved.iter().map(|quantity| quantity.symbol()).collect();
        assert_eq!(symbols, [&["H", "S = Sigma - Sigma^T", "|S|^2"][..], &components].concat());
    };
    let there = [
        "28*sigma_hat_12 - 9*sigma_hat_21",
        "4*sigma_hat_13 - 3*sigma_hat_31",
        "3*sigma_hat_23 - 7*sigma_hat_32",
    ];
    listed(Carried::DESCRIPTION.conserved, there);
    let here = [
        "4*sigma_hat_12 - 3*sigma_hat_21",
        "2*sigma_hat_13 - sigma_hat_31",
        "3*sigma_hat_23 - 2*sigma_hat_32",
    ];
    listed(Body::DESCRIPTION.conserved, here);

    let phi = Matrix::<3>::new(1.1, 0.2, -0.1, 0.3, 0.9, 0.15, -0.2, 0.05, 1.2);
    let spin = Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, 0.5, 0.7, 0.6, -0.4, 0.3);
    let start = Body.at_momentum(phi, Comoving(spin)).unwrap();
    let run = Simulation::new(&Body, start).until(1.0).tolerance(1e-13).run().unwrap();
    assert_eq!(run.conservation().drifts().len(), 6);
    assert!(run.conservation().worst() < 1e-11, "{}", run.conservation());
}
