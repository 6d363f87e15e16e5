//! What a run says of `emit(splitting)` that its model was not given, beside what the same model does with it.

use affine_runtime::prelude::*;

use crate::models::*;

/// Models without and with pieces, of one energy.
macro_rules! models {
    ($name:ident: $($energy:tt)*) => {
        mod $name {
            use affine_runtime::prelude::*;

            #[affine_model(dim = 3, kinetic(casimir2 = 0.3, body_inertia = 1, space_translation = 1), $($energy)*)]
            pub(super) struct Without {
                pub(super) kappa: f64,
            }

            #[affine_model(
                dim = 3,
                kinetic(casimir2 = 0.3, body_inertia = 1, space_translation = 1),
                $($energy)*,
                emit(splitting)
            )]
            pub(super) struct With {
                pub(super) kappa: f64,
            }
        }
    };
}

models! {
    harmonic: potential = kappa*q^2 + x[1]^2 + 0.1*phi[1,1]*x[1]
}
models! {
    hyperbolic: potential = hyperbolic_dilatation(kappa) + (q - 1)*tr(G)
}
models! {
    sheared: potential = kappa*q^2 + kappa*phi[1,2]^2 + tr(G)
}
// No closed form of the dilatation.
models! {
    quartic: potential = kappa*(q - 1)^4 + x[1]^2
}

fn run<M: Model<3>>((model, point): (&M, M::Point<f64>), tolerance: f64) -> Trajectory<3, M::Point<f64>> {
    let run = Simulation::new(model, point).until(1.0).tolerance(tolerance).output([]);
    // Explicit steps that lose the energy of a stiff motion say as much as others.
    run.max_steps(1_000_000).run().unwrap_or_else(|halt| *halt.trajectory)
}

/// Whether a run without pieces names them, and whether that with pieces takes them.
fn said_and_done<A: Model<3>, B: Model<3>>(
    without: (&A, A::Point<f64>),
    with: (&B, B::Point<f64>),
    tolerance: f64,
) -> (bool, bool) {
    let (without, with) = (run(without, tolerance), run(with, tolerance));
    let why = without.why().to_string();
    assert_eq!(without.computation().method, Method::RungeKutta8, "{why}");
    assert!(!with.why().to_string().contains("not emitted"), "{}", with.why());
    let taken = Method::AdaptiveSplitting { order: None };
    (why.contains("not emitted: with `emit(splitting)`"), with.computation().method == taken)
}

#[test]
fn hint_of_pieces_comes_true() {
    macro_rules! said_and_done {
        ($model:ident, $kappa:expr, $tolerance:expr) => {{
            let without = $model::Without { kappa: $kappa }.prepare().unwrap();
            let with = $model::With { kappa: $kappa }.prepare().unwrap();
            let points = (
                without.at_velocity(x3(), phi3(), p3(), spin3()).unwrap(),
                with.at_velocity(x3(), phi3(), p3(), spin3()).unwrap(),
            );
            said_and_done((&without, points.0), (&with, points.1), $tolerance)
        }};
    }
    for tolerance in [1e-1, 1e-2] {
        assert_eq!(said_and_done!(harmonic, 1e8, tolerance), (true, true), "{tolerance:e}");
        assert_eq!(said_and_done!(hyperbolic, 1e8, tolerance), (true, true), "{tolerance:e}");
        // The interval is too short for a trial, or a trial fails.
        assert_eq!(said_and_done!(harmonic, 1e4, tolerance), (false, false), "{tolerance:e}");
        assert_eq!(said_and_done!(sheared, 1e8, tolerance), (false, false), "{tolerance:e}");
        assert_eq!(said_and_done!(quartic, 1e8, tolerance), (false, false), "{tolerance:e}");
    }
    // What a trial shows at tighter tolerances, the pieces alone tell.
    for tolerance in [1e-3, 1e-8] {
        let (said, _) = said_and_done!(hyperbolic, 1e8, tolerance);
        assert!(!said, "{tolerance:e}");
    }
}
