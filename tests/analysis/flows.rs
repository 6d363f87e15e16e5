//! Flow matrices, exponents and sensitivities against closed forms.

use std::sync::atomic::{AtomicUsize, Ordering};

use affine_runtime::analysis::{FlowMatrix, Sensitivities, lyapunov_spectrum};
use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::model::Model;
use affine_runtime::nalgebra::DMatrix;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

use crate::models::{Disc, FreeTop, Top, turning};

/// With constraints and potentials: columns are those of neighbouring motions, and the flow is
/// symplectic on what the constraint leaves.
#[test]
fn constraints_keep_the_form() {
    #[affine_model(dim = 3, constraint = isochoric, kinetic(dalembert = diag(1, 1.5, 2)), potential = tr(G)/2)]
    struct Stretched;
    #[affine_model(dim = 3, constraint = rigid, kinetic(dalembert = diag(1, 1.5, 2)), potential = 0.7*phi[3,3])]
    struct Swung;
    let one = Matrix::<3>::identity();
    let skew = Matrix::<3>::new(0.0, -0.3, 0.2, 0.3, 0.0, -0.5, -0.2, 0.5, 0.0);
    let start =
        Stretched.at_velocity(one, skew + Matrix::from_diagonal(&Vector::<3>::new(0.2, -0.3, 0.1))).unwrap();
    let mut flow = FlowMatrix::new(&Stretched, (0.0, &start), 1e-12);
    flow.advance_to(0.7).unwrap();
    assert!(flow.defect() < 1e-11, "{}", flow.defect());
    let run = Simulation::new(&Stretched, start).until(0.7).tolerance(1e-13).run().unwrap();
    assert!((run.end().1.phi() - flow.point().phi()).norm() < 1e-10);
    let start = Swung.at_velocity(one, skew).unwrap();
    let mut flow = FlowMatrix::new(&Swung, (0.0, &start), 1e-12);
    flow.advance_to(2.0).unwrap();
    assert!(flow.defect() < 1e-11, "{}", flow.defect());
}

/// Friction is not symplectic, and the defect shows it.
#[test]
fn friction_shrinks_the_form() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr(G)/2, dissipation(body_inertia = 0.3))]
    struct Damped;
    let start = Damped.at_velocity(Matrix::<2>::identity(), turning(0.3)).unwrap();
    let mut flow = FlowMatrix::new(&Damped, (0.0, &start), 1e-10);
    flow.advance_to(1.0).unwrap();
    assert!(flow.defect() > 1e-2, "{}", flow.defect());
}

/// Potentials of single stretches, from where these coincide.
#[test]
fn stretches_that_coincide_have_a_flow() {
    #[affine_model(dim = 3, kinetic(dalembert = 1), potential = cosh(2*q1) + cosh(2*q2) + cosh(2*q3) + pairs(cosh(d)))]
    struct Stretched;
    let rate = Matrix::<3>::new(0.2, 0.1, -0.3, 0.0, -0.1, 0.2, 0.1, 0.3, 0.1);
    let start = Stretched.at_velocity(Matrix::<3>::identity(), rate).unwrap();
    let mut flow = FlowMatrix::new(&Stretched, (0.0, &start), 1e-11);
    flow.advance_to(1.0).unwrap();
    assert!(flow.defect() < 1e-9, "{}", flow.defect());
}

/// Exponents of integrable motions vanish within their bound, which falls like `ln t/t`, and come in pairs.
fn assert_integrable<const N: usize, M: Model<N>>(model: &M, start: &M::Point<f64>) {
    for time in [60.0, 240.0_f64] {
        let spectrum = lyapunov_spectrum(model, start, time, 1e-9).unwrap();
        for (exponent, error) in spectrum.exponents.iter().zip(&spectrum.errors) {
            assert!(exponent.abs() <= *error && *error < 4.0 * time.ln() / time, "{time}: {spectrum:?}");
        }
    }
}

/// The unit of time makes no difference: neither for what is called growth, nor for how long it takes to find.
#[test]
fn exponents_are_those_of_any_unit_of_time() {
    for (slow, times) in [(1e-8, &[0.05, 1.0][..]), (1.0, &[0.05, 0.5]), (1e8, &[0.05, 60.0])] {
        let stiffness = 1.0 / (slow * slow);
        let disc = Disc { i: 1.0, kappa: 4.0 * stiffness, c1: 0.3 * stiffness }.prepare().unwrap();
        let start = disc.at_velocity(Matrix::<2>::new(1.1, 0.0, 0.0, 1.1), turning(0.3 / slow)).unwrap();
        for &time in times {
            let spectrum = lyapunov_spectrum(&disc, &start, time * slow, 1e-9).unwrap();
            for (exponent, error) in spectrum.exponents.iter().zip(&spectrum.errors) {
                assert!(exponent.abs() <= *error, "{slow:e}, {time}: {spectrum:?}");
            }
        }
    }
}

/// Nor does the unit of length, where places and placements are coupled: about as many evaluations find them.
#[test]
fn exponents_are_found_in_any_unit_of_length() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = m),
        potential = tr(G)/2 - ln(det) + 1.5*m*norm(x)^2 + c*x[1]*phi[1,2],
        forces = custom(counted, translation)
    )]
    struct Held {
        m: f64,
        c: f64,
        counted: Counted,
    }
    let evaluations = |unit: f64| {
        let model = Held { m: 1.0 / (unit * unit), c: 0.25 / unit, counted: Counted }.prepare().unwrap();
        let (x, v) = (Vector::<2>::new(0.3, -0.2) * unit, Vector::<2>::new(0.3, 0.2) * unit);
        let (phi, rate) = (Matrix::<2>::new(1.2, 0.1, 0.0, 0.9), Matrix::<2>::new(0.1, -0.3, 0.4, -0.1));
        let start = model.at_velocity(x, phi, v, rate).unwrap();
        let before = EVALUATIONS.load(Ordering::Relaxed);
        lyapunov_spectrum(&model, &start, 20.0, 1e-6).unwrap();
        EVALUATIONS.load(Ordering::Relaxed) - before
    };
    let [usual, other] = [1.0, 1e6].map(evaluations);
    // Columns of all units take shorter steps.
    assert!(other < 10 * usual, "{usual}, {other}");
}

static EVALUATIONS: AtomicUsize = AtomicUsize::new(0);

/// A force that is none, and counts how often it is asked for.
#[derive(Clone, Copy, Debug)]
struct Counted;

impl Force<2> for Counted {
    type Form = Translation;
    fn force<T: Scalar>(&self, _: &Motion<2, T>) -> Vector<2, T> {
        EVALUATIONS.fetch_add(1, Ordering::Relaxed);
        Vector::<2, T>::zeros()
    }
}

#[test]
fn exponents_of_integrable_motions_vanish() {
    let disc = Disc { i: 1.0, kappa: 4.0, c1: 0.3 }.prepare().unwrap();
    assert_integrable(&disc, &disc.at_velocity(Matrix::<2>::new(1.1, 0.0, 0.0, 1.1), turning(0.3)).unwrap());
    let skew = Matrix::<3>::new(0.0, -0.3, 0.2, 0.3, 0.0, -0.5, -0.2, 0.5, 0.0);
    assert_integrable(&FreeTop, &FreeTop.at_velocity(Matrix::<3>::identity(), skew).unwrap());
    let top = Top { j1: 1.0, j3: 0.5, u: 0.7 }.prepare().unwrap();
    let (sin, cos) = 0.6_f64.sin_cos();
    let tilted = Matrix::<3>::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos);
    assert_integrable(&top, &top.at_velocity(tilted, tilted * skew).unwrap());
}

/// The end of a motion.
fn end<const N: usize, M: Model<N>>(model: &M, start: M::Point<f64>) -> DMatrix<f64> {
    let run = Simulation::new(model, start).until(0.7).tolerance(1e-13).run().unwrap();
    DMatrix::from_row_slice(
        1,
        M::DESCRIPTION.full.iter().map(|one| one.len).sum(),
        model.flatten(run.end().1).as_ref(),
    )
}

/// Its derivative, by differences of order 4.
fn difference(end: impl Fn(f64) -> DMatrix<f64>) -> DMatrix<f64> {
    const H: f64 = 2e-3;
    ((end(H) - end(-H)) * 8.0 - (end(2.0 * H) - end(-2.0 * H))) / (12.0 * H)
}

/// By a metric: a start that is held in the bases of its points moves in those in which the metric is the identity.
#[test]
fn metrics_have_sensitivities() {
    #[affine_model(
        dim = 2,
        metrics(space = g, body = e),
        kinetic(dalembert = 1, space_translation = m),
        potential = tr(G)/2 - q + x[1]^2*phi[1,2]
    )]
    struct Measured {
        g: Matrix<2>,
        e: Matrix<2>,
        m: f64,
    }
    let fields = |change: [f64; 3]| Measured {
        g: Matrix::<2>::new(2.0 + change[0], 0.3, 0.3, 1.0),
        e: Matrix::<2>::new(1.0, 0.2, 0.2, 1.5 + change[1]),
        m: 1.3 + change[2],
    };
    let begun = |change: [f64; 3]| {
        let model = fields(change).prepare().unwrap();
        let (x, x_dot) = (Vector::<2>::new(0.3, -0.2), Vector::<2>::new(0.1, 0.2));
        let (phi, phi_dot) = (Matrix::<2>::new(1.1, 0.2, -0.1, 0.9), Matrix::<2>::new(0.1, 0.4, -0.3, -0.2));
        let start = model.at_velocity(x, phi, x_dot, phi_dot).unwrap();
        (model, start)
    };
    let (model, start) = begun([0.0; 3]);
    let found = Sensitivities::of(&fields([0.0; 3]), &model, (0.0, &start), 0.7, 1e-12).unwrap();
    // m, then g row by row, then e.
    for (column, change) in [(1, [1.0, 0.0, 0.0]), (8, [0.0, 1.0, 0.0]), (0, [0.0, 0.0, 1.0])] {
        let at_velocity = difference(|h| {
            let (model, start) = begun(change.map(|one| one * h));
            end(&model, start)
        });
        let off = (found.by_fields_at_velocity.column(column) - at_velocity.transpose()).norm();
        assert!(off < 1e-8 && at_velocity.norm() > 0.01, "{column}: {off:e}");
        // The plain array of the start is held.
        let plain = model.flatten(&start);
        let by_array = difference(|h| {
            let (model, _) = begun(change.map(|one| one * h));
            end(&model, model.unflatten(&plain))
        });
        let off = (found.by_fields.column(column) - by_array.transpose()).norm();
        assert!(off < 1e-8, "{column}: {off:e}");
    }
}

/// Under constraints, that of a multiplier too: by fields where the velocity of the start is held, and by the velocity.
#[test]
fn constraints_have_sensitivities() {
    #[affine_model(dim = 2, constraint = isochoric, kinetic(dalembert = diag(j, 2)), potential = k/2*tr(G))]
    struct Held {
        j: f64,
        k: f64,
    }
    let of = |dj: f64, dk: f64, faster: f64| {
        let model = Held { j: 1.0 + dj, k: 0.7 + dk }.prepare().unwrap();
        let rate = Matrix::<2>::new(0.3, -0.5, 0.4, -0.3) * (1.0 + faster);
        let start = model.at_velocity(Matrix::<2>::identity(), rate).unwrap();
        (model, start)
    };
    let (model, start) = of(0.0, 0.0, 0.0);
    let found = Sensitivities::of(&Held { j: 1.0, k: 0.7 }, &model, (0.0, &start), 0.7, 1e-12).unwrap();
    let by = |change: &dyn Fn(f64) -> [f64; 3]| {
        difference(|h| {
            let [dj, dk, faster] = change(h);
            let (model, start) = of(dj, dk, faster);
            end(&model, start)
        })
        .transpose()
    };
    let faster = DMatrix::from_column_slice(8, 1, &[0.0, 0.0, 0.0, 0.0, 0.3, -0.5, 0.4, -0.3]);
    for (found, known) in [
        (found.by_fields_at_velocity.columns(0, 1).into_owned(), by(&|h| [h, 0.0, 0.0])),
        (found.by_fields_at_velocity.columns(1, 1).into_owned(), by(&|h| [0.0, h, 0.0])),
        (&found.by_velocity * faster, by(&|h| [0.0, 0.0, h])),
    ] {
        assert!((&found - &known).norm() < 1e-8, "{found}{known}");
    }
    // The potential alone does not change the momentum of a velocity.
    let held = (found.by_fields.column(1) - found.by_fields_at_velocity.column(1)).norm();
    assert!(held < 1e-12, "{held}");

    let of = |du: f64, faster: f64| {
        let model = Top { j1: 1.0, j3: 0.5, u: 0.7 + du }.prepare().unwrap();
        let start = model.at_velocity(Matrix::<3>::identity(), turning(1.0 + faster)).unwrap();
        (model, start)
    };
    let (model, start) = of(0.0, 0.0);
    let found =
        Sensitivities::of(&Top { j1: 1.0, j3: 0.5, u: 0.7 }, &model, (0.0, &start), 0.7, 1e-12).unwrap();
    let turn: Matrix<3> = turning(1.0);
    let mut faster = DMatrix::zeros(18, 1);
    (0..9).for_each(|k| faster[(9 + k, 0)] = turn[(k / 3, k % 3)]);
    let known = difference(|h| {
        let (model, start) = of(0.0, h);
        end(&model, start)
    });
    assert!((&found.by_velocity * faster - known.transpose()).norm() < 1e-8, "{found:?}");
}

/// The masses of needles and of stars are of no account.
#[test]
fn heavy_bodies_have_sensitivities() {
    #[affine_model(dim = 2, kinetic(dalembert = j), potential = hyperbolic_dilatation(k) + neo_hookean(c))]
    struct Heavy {
        j: f64,
        k: f64,
        c: f64,
    }
    let by_velocity = |mass: f64| {
        let fields = Heavy { j: mass, k: 4.0 * mass, c: 0.3 * mass };
        let model = fields.prepare().unwrap();
        let (phi, rate) = (Matrix::<2>::new(1.1, 0.0, 0.0, 0.9), Matrix::<2>::new(0.0, -0.3, 0.3, 0.1));
        let start = model.at_velocity(phi, rate).unwrap();
        Sensitivities::of(&fields, &model, (0.0, &start), 2.0, 1e-11)
            .unwrap()
            .by_velocity
            .rows(0, 4)
            .clone_owned()
    };
    let known = by_velocity(1.0);
    assert!(known.norm() > 1.0);
    for mass in [1e-12, 1e9, 1e12, 1e20] {
        assert!((by_velocity(mass) - &known).norm() < 1e-8 * known.norm(), "{mass:e}");
    }
}

/// Off the group of a constraint nothing decays, and rounding there does not outlast what does: `x'' = -x - 3 x'`, twice, and a body
/// that turns as it likes.
#[test]
fn decay_under_constraints_has_exponents() {
    #[affine_model(
        dim = 2,
        constraint = rigid,
        kinetic(dalembert = 1/2, space_translation = 1),
        potential = norm(x)^2/2,
        dissipation(space_translation = 3)
    )]
    struct Bead;
    let (x, v) = (Vector::<2>::new(0.1, 0.2), Vector::<2>::new(0.1, 0.1));
    let start = Bead.at_velocity(x, Matrix::<2>::identity(), v, Matrix::<2>::zeros()).unwrap();
    let spectrum = lyapunov_spectrum(&Bead, &start, 60.0, 1e-9).unwrap();
    let sum: f64 = spectrum.exponents.iter().sum();
    assert!((sum + 6.0).abs() < 1e-6, "{spectrum:?}");
    let fast = -(3.0 + 5.0_f64.sqrt()) / 2.0;
    for k in 4..6 {
        assert!((spectrum.exponents[k] - fast).abs() < 0.1, "{spectrum:?}");
    }
}

/// A field that has no effect but by rounding does not shorten steps.
#[test]
fn fields_without_effect_have_sensitivities() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = tr((G - 1)^2)/4 + c*G[1,2]^2)]
    struct Sheared {
        c: f64,
    }
    let fields = Sheared { c: 0.4 };
    let model = fields.prepare().unwrap();
    let (sin, cos) = 0.3_f64.sin_cos();
    let turn = Matrix::<2>::new(cos, -sin, sin, cos);
    let along = |a: f64, b: f64| turn * Matrix::<2>::new(a, 0.0, 0.0, b);
    let start = model.at_velocity(along(1.2, 0.9), along(0.2, -0.3)).unwrap();
    for t in [1e-6, 1.0] {
        let found = Sensitivities::of(&fields, &model, (0.0, &start), t, 1e-9).unwrap();
        assert!(found.by_fields.norm() < 1e-14, "{t}: {}", found.by_fields);
    }
}

/// Nor do columns that have decayed to nothing: `x'' = -x - 3 x'` over a time after which they are below all numbers.
#[test]
fn decay_to_nothing_has_a_flow() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1),
        potential = ((phi[1,1] - 1)^2 + phi[1,2]^2 + phi[2,1]^2 + (phi[2,2] - 1)^2)/2,
        dissipation(dalembert = 3)
    )]
    struct Damped;
    let start = Damped.at_velocity(Matrix::<2>::new(1.1, 0.1, -0.2, 0.9), Matrix::<2>::zeros()).unwrap();
    let mut flow = FlowMatrix::new(&Damped, (0.0, &start), 1e-9);
    flow.advance_to(1930.0).unwrap();
    assert!(flow.matrix().norm() < 1e-150, "{}", flow.matrix());
}

/// `x'' = x` from rest at the top: columns grow to `exp(t)/2`, whose square is no number.
#[test]
fn growth_has_a_defect() {
    #[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = tr(G)/2 - ln(det) - norm(x)^2/2)]
    struct Hill;
    let (x, still) = (Vector::<2>::zeros(), Matrix::<2>::zeros());
    let start = Hill.at_velocity(x, Matrix::<2>::identity() * 1.1, x, still).unwrap();
    let mut flow = FlowMatrix::new(&Hill, (0.0, &start), 1e-9);
    flow.advance_to(400.0).unwrap();
    assert!((flow.matrix()[(0, 0)].ln() - (400.0 - 2.0_f64.ln())).abs() < 1e-4);
    assert!(flow.defect() < 1e-6, "{}", flow.defect());
}
