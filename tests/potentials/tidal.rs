//! `x . Ct x` beside other functions, in every chart: forces against differences of the energy as it is written here, and runs
//! against their own energy.

use affine_runtime::prelude::*;

/// A difference of order 4, whose error is that of rounding over the step, or of the fifth derivative.
const STEP: f64 = 1e-4;
const NEAR: f64 = 1e-10;

fn derivative(energy: &dyn Fn(f64) -> f64) -> f64 {
    (8.0 * (energy(STEP) - energy(-STEP)) - (energy(2.0 * STEP) - energy(-2.0 * STEP))) / (12.0 * STEP)
}

/// An energy of the position and the placement.
type Energy<const N: usize> = dyn Fn(&Vector<N>, &Matrix<N>) -> f64;

fn place<const N: usize>() -> (Vector<N>, Matrix<N>) {
    let strain = [[0.13, -0.08, 0.05], [0.11, -0.09, 0.07], [-0.04, 0.12, 0.06]];
    let phi = Matrix::<N>::from_fn(|i, a| f64::from(u8::from(i == a)) + strain[i][a]);
    (Vector::<N>::from_fn(|i, _| [1.3, -0.7, 0.4][i]), phi)
}

/// The rates of the momenta at rest, and the energy along a run.
fn check<const N: usize, M: Model<N>>(label: &str, model: &M, start: &M::Point<f64>, energy: &Energy<N>) {
    let (x, phi) = place::<N>();
    let unit = |i: usize| Vector::<N>::from_fn(|k, _| f64::from(u8::from(k == i)));
    let force = Vector::<N>::from_fn(|i, _| -derivative(&|h| energy(&(x + unit(i) * h), &phi)));
    let slopes = Matrix::<N>::from_fn(|i, a| {
        derivative(&|h| {
            let mut moved = phi;
            moved[(i, a)] += h;
            energy(&x, &moved)
        })
    });
    let spin = -phi * slopes.transpose();
    let rates = model.hamilton_equations(0.0, &model.flatten(start));
    let (mut at, mut seen) = (0, 0);
    for group in M::DESCRIPTION.full {
        let (name, len) = (&group.name(), &group.len);
        let entries = &rates.as_ref()[at..at + len];
        let expected = match *name {
            "p" => Some(force.as_slice().to_vec()),
            "p_hat" => Some((phi.transpose() * force).as_slice().to_vec()),
            // Rows, as matrices stand in a state.
            "Pi" => Some(slopes.map(|s| -s).as_slice().to_vec()),
            "Sigma_hat" => Some((-slopes.transpose() * phi).transpose().as_slice().to_vec()),
            "Sigma" => Some(spin.transpose().as_slice().to_vec()),
            _ => None,
        };
        if let Some(expected) = expected {
            seen += 1;
            let size = expected.iter().map(|e| e.abs()).fold(0.0, f64::max);
            for (found, expected) in entries.iter().zip(&expected) {
                assert!((found - expected).abs() < NEAR * size, "{label}, {name}: {found} {expected}");
            }
        }
        at += len;
    }
    assert_eq!(seen, 2, "{label}");
    let run = Simulation::new(model, *start).until(1.0).tolerance(1e-13).run().unwrap();
    let drift = run.conservation().worst();
    assert!(drift < 1e-10, "{label}: {drift:e}");
}

/// One energy, as written for the macro and here, in the charts of three kinetic energies and two masses of the centre.
macro_rules! in_charts {
    ($($name:ident: $dim:literal, [$($potential:tt)*], $energy:expr;)*) => {
        $(#[test]
        fn $name() {
            let energy: &Energy<$dim> = &$energy;
            let ((x, phi), rest, still) = (place::<$dim>(), Vector::<$dim>::zeros(), Matrix::<$dim>::zeros());
            in_charts!(@ $dim, (dalembert = 1, space_translation = 1), [$($potential)*], (x, phi, rest, still), energy);
            in_charts!(@ $dim, (casimir2 = 0.2, body_inertia = 1, space_translation = 2), [$($potential)*],
                (x, phi, rest, still), energy);
            in_charts!(@ $dim, (casimir2 = 0.2, body_inertia = 1, body_translation = 2), [$($potential)*],
                (x, phi, rest, still), energy);
            in_charts!(@ $dim, (casimir2 = 0.2, space_inertia = 1, space_translation = 2), [$($potential)*],
                (x, phi, rest, still), energy);
        })*
    };
    (@ $dim:literal, ($($kinetic:tt)*), [$($potential:tt)*], ($($start:expr),*), $energy:ident) => {{
        #[affine_model(dim = $dim, kinetic($($kinetic)*), potential = $($potential)*)]
        struct Body;
        check(stringify!($($kinetic)*), &Body, &Body.at_velocity($($start),*).unwrap(), $energy);
    }};
}

/// `x . Ct x`.
fn carried<const N: usize>(x: &Vector<N>, phi: &Matrix<N>) -> f64 {
    (phi.transpose() * x).norm_squared()
}

in_charts! {
    gradient_of_gravity: 3, [-1/norm(x) + 0.05*tr(G)/norm(x)^3 - 0.15*(Ct[1,1]*x[1]^2 + Ct[2,2]*x[2]^2 + Ct[3,3]*x[3]^2
        + 2*(Ct[1,2]*x[1]*x[2] + Ct[1,3]*x[1]*x[3] + Ct[2,3]*x[2]*x[3]))/norm(x)^5 + (tr(G*G) - 2*tr(G) + 3)], |x, phi| {
        let (r, green) = (x.norm(), phi.transpose() * phi);
        -1.0 / r + 0.05 * green.trace() / r.powi(3) - 0.15 * carried(x, phi) / r.powi(5)
            + (green * green).trace() - 2.0 * green.trace() + 3.0
    };
    function_of_the_square: 2, [exp(-(Ct[1,1]*x[1]^2 + Ct[2,2]*x[2]^2 + 2*Ct[1,2]*x[1]*x[2]))*(1 + q^2) + 0.5*tr(G)
        + (x[1]^2 + x[2]^2)*(Ct[1,1]*x[1]^2 + Ct[2,2]*x[2]^2 + 2*Ct[1,2]*x[1]*x[2])^2 + q^2], |x, phi| {
        let (square, q) = (carried(x, phi), 0.5 * phi.determinant().ln());
        (-square).exp() * (1.0 + q * q) + 0.5 * phi.norm_squared() + x.norm_squared() * square * square + q * q
    };
    // No function of the square: it has an entry more.
    beside_an_entry: 2, [Ct[1,1]*x[1]^2 + Ct[2,2]*x[2]^2 + 2*Ct[1,2]*x[1]*x[2] + 0.3*Ct[1,2] + q^2], |x, phi| {
        carried(x, phi) + 0.3 * (phi * phi.transpose())[(0, 1)] + (0.5 * phi.determinant().ln()).powi(2)
    };
}
