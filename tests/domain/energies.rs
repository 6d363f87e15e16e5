//! The energy as a witness.

use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;
use affine_runtime::simulate::Reason;

#[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = -1/norm(x))]
struct Kepler;

fn kepler(speed: f64) -> <Kepler as Model<2>>::Point<f64> {
    let (x, v) = (Vector::<2>::new(1.0, 0.0), Vector::<2>::new(0.0, speed));
    Kepler.at_velocity(x, Matrix::<2>::identity(), v, Matrix::<2>::zeros()).unwrap()
}

/// A fall into the centre, which no function loses its sign at: it ends about when it should, however steps fall there, and though
/// the energy may be off by less than a tenth of what kinetic and potential energy were at the centre.
#[test]
fn a_fall_into_the_centre() {
    let exact = core::f64::consts::PI / 8.0_f64.sqrt();
    let tolerances = (0..=64).map(|k| 10.0_f64.powf(-2.0 - f64::from(k) / 16.0));
    for tolerance in tolerances.chain([1e-8, 1e-10, 1e-13]) {
        let halt = Simulation::new(&Kepler, kepler(0.0)).until(2.0).tolerance(tolerance).run().unwrap_err();
        let typed = matches!(
            halt.stop.reason,
            Reason::EnergyLost { .. } | Reason::StepUnderflow { .. } | Reason::NotFinite
        );
        assert!(typed && (halt.stop.t - exact).abs() < 0.2, "{halt}");
    }
}

/// An orbit that comes near the centre keeps its energy, and nothing is said of it.
#[test]
fn an_eccentric_orbit_is_no_fall() {
    for tolerance in [1e-3, 1e-6, 1e-10] {
        let run = Simulation::new(&Kepler, kepler(0.1)).until(5.0).tolerance(tolerance).run().unwrap();
        assert!(!run.why().to_string().contains("energy is off"), "{}", run.why());
    }
}

/// Long explicit steps damp a stiff dilatation as far as a loose tolerance allows: nothing ends, and what is lost is named. A
/// tolerance that keeps most of it is not warned of, nor one that the motion is followed at.
#[test]
fn a_stiff_vibration_that_is_damped_is_named() {
    #[affine_model(dim = 2, kinetic(casimir2 = 0.3, body_inertia = 1), potential = kappa*q^2 + 0.1*phi[1,1])]
    struct Stiff {
        kappa: f64,
    }
    let run = |kappa: f64, tolerance: f64| {
        let model = Stiff { kappa }.prepare().unwrap();
        let (phi, phi_dot) = (Matrix::<2>::new(1.02, 0.1, 0.0, 1.03), Matrix::<2>::new(0.3, 0.5, -0.2, 0.1));
        let start = model.at_velocity(phi, phi_dot).unwrap();
        Simulation::new(&model, start).until(1.0).tolerance(tolerance).run().unwrap()
    };
    for (kappa, tolerance, is_named) in [
        (1e6, 1e-1, true),
        (1e6, 1e-2, true),
        (1e8, 1e-1, true),
        (1e8, 1e-2, true),
        (1e6, 1e-3, false),
        (1e8, 1e-4, false),
        (1e6, 1e-10, false),
    ] {
        let run = run(kappa, tolerance);
        let lost = run.conservation().of(Conserved::Energy).unwrap().relative();
        assert_eq!(lost > 0.5, is_named, "{kappa:e}, {tolerance:e}: {lost:e}");
        let why = run.why().to_string();
        assert_eq!(why.contains("energy is off"), is_named, "{kappa:e}, {tolerance:e}: {why}");
    }
}

/// A vibration of a tenth of the tolerance, about: steps that follow it keep its energy, whatever is allowed.
#[test]
fn a_tiny_vibration_is_not_warned_of() {
    #[affine_model(dim = 2, kinetic(casimir2 = 0.3, body_inertia = 1), potential = 100*q^2)]
    struct Tiny;
    for (amplitude, tolerance) in [(1e-4, 1e-3), (1e-7, 1e-6), (1e-11, 1e-10)] {
        let phi = Matrix::<2>::identity() * (1.0 + amplitude);
        let start = Tiny.at_velocity(phi, Matrix::<2>::zeros()).unwrap();
        let run = Simulation::new(&Tiny, start).until(1.0).tolerance(tolerance).run().unwrap();
        assert!(!run.why().to_string().contains("energy is off"), "{}", run.why());
    }
}

/// Steps that are far too long for the motion: a method of equal steps goes on, and says so.
#[test]
fn coarse_equal_steps_are_named() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = 500*x[1]^2,
        emit(splitting)
    )]
    struct Stiff;
    let (x, v) = (Vector::<2>::new(1.0, 0.0), Vector::<2>::zeros());
    let start = Stiff.at_velocity(x, Matrix::<2>::identity(), v, Matrix::<2>::zeros()).unwrap();
    let run =
        |step| Simulation::new(&Stiff, start).until(1.0).method(Method::Splitting { order: 2, step }).run();
    let fine = run(1e-3).unwrap();
    assert!(!fine.why().to_string().contains("energy is off"), "{}", fine.why());
    let coarse = run(0.05).unwrap();
    let worst = coarse.computation().energy_defect;
    assert!(worst > 0.1 && coarse.why().to_string().contains("the steps do not resolve"), "{}", coarse.why());
}

/// A potential that leaves the range of numbers, at the start and on the way.
#[test]
fn an_energy_that_overflows() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = -exp(exp(q)))]
    struct Steep;
    let at =
        |scale: f64| Steep.at_velocity(Matrix::<2>::identity() * scale, Matrix::<2>::identity()).unwrap();
    let halt = Simulation::new(&Steep, at(800.0)).until(1.0).run().unwrap_err();
    assert!(matches!(halt.stop.reason, Reason::Energy { t: 0.0, .. }), "{halt}");
    assert!(halt.to_string().contains("the energy is -inf"), "{halt}");
}

/// An event that changes the point changes the energy, and the witness looks from there on.
#[test]
fn a_change_is_no_loss() {
    #[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = 9.81*x[2])]
    struct Ball;
    type Point = <Ball as Model<2>>::Point<f64>;
    let (x, v) = (Vector::<2>::new(0.0, 1.0), Vector::<2>::zeros());
    let start = Ball.at_velocity(x, Matrix::<2>::identity(), v, Matrix::<2>::zeros()).unwrap();
    let bounced = |_: f64, point: &Point| {
        let p = Vector::<2>::new(point.p()[0], -0.2 * point.p()[1]);
        Ball.at_momentum(point.x(), *point.phi(), p, point.pi())
    };
    let floor = || Event::position(2, 0.0).falling().change(bounced);
    let run = Simulation::new(&Ball, start).until(0.5).tolerance(1e-6).event(floor()).run().unwrap();
    assert_eq!(run.events().len(), 1);
    assert!(run.computation().energy_defect < 1e-6);
}

/// A force `max(0, t - t_1)^k` along the first axis.
#[derive(Clone, Copy)]
struct Onset {
    k: i32,
    t_1: f64,
}

impl Force<2> for Onset {
    type Form = Translation;

    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        let since = (motion.t - T::constant(self.t_1, 0.0)).max(T::zero());
        Vector::<2, T>::new((0..self.k).fold(T::one(), |power, _| power * since), T::zero())
    }
}

/// A force sets in at a kink on a body at rest: within the step there is hardly any energy yet, and what is lost of that is no more
/// than the tolerance lets a momentum lose.
#[test]
fn a_force_that_sets_in_is_no_loss() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = orthogonality(1),
        forces = custom(onset, translation)
    )]
    struct Pushed {
        onset: Onset,
    }
    for t_1 in [0.123456, 0.5, 0.51234, 1.7] {
        for k in [1, 2, 3] {
            let pushed = Pushed { onset: Onset { k, t_1 } }.prepare().unwrap();
            let (x, phi, still) = (Vector::<2>::new(1.0, 0.0), Matrix::identity(), Matrix::zeros());
            let start = pushed.at_velocity(x, phi, Vector::zeros(), still).unwrap();
            let exact = (4.0 - t_1).powi(k + 1) / f64::from(k + 1);
            for method in [Method::Automatic, Method::RungeKutta5] {
                for tolerance in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
                    let run = Simulation::new(&pushed, start).until(4.0).tolerance(tolerance).method(method);
                    let label = format!("power {k} from {t_1}, {method:?} at {tolerance:e}");
                    let run = run.run().unwrap_or_else(|halt| panic!("{label}: {halt}"));
                    let error = (run.end().1.p()[0] - exact).abs() / exact;
                    assert!(error < 100.0 * tolerance, "{label}: {error:e}");
                }
            }
        }
    }
}

/// Viscous bodies under a slow load `sin(w t)`, whose energies are far below the work that goes through them: the placement is as
/// near as the tolerance, and that is all that steps longer than the friction tell.
#[test]
fn slow_viscous_bodies_lose_nothing() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        dissipation(space_translation = r),
        potential = orthogonality(1) - sin(w*t)*x[1]
    )]
    struct Dragged {
        r: f64,
        w: f64,
    }
    let t = 5.0_f64;
    for r in [1e3, 1e4, 1e5, 1e6] {
        for w in [0.5_f64, 1.0, 2.0, 5.0] {
            let dragged = Dragged { r, w }.prepare().unwrap();
            let (zero, phi, still) = (Vector::<2>::zeros(), Matrix::identity(), Matrix::zeros());
            let start = dragged.at_velocity(zero, phi, zero, still).unwrap();
            // The integral of (r sin(w t) - w cos(w t) + w exp(-r t))/(r^2 + w^2).
            let exact = (r / w * (1.0 - (w * t).cos()) - (w * t).sin() + w / r) / (r * r + w * w);
            for tolerance in [1e-3, 1e-4, 1e-6, 1e-8, 1e-10] {
                let run = Simulation::new(&dragged, start).until(t).tolerance(tolerance);
                let label = format!("{r:e} {w} at {tolerance:e}");
                let run = run.run().unwrap_or_else(|halt| panic!("{label}: {halt}"));
                let error = (run.end().1.x()[0] - exact).abs();
                assert!(error < 10.0 * tolerance, "{label}: {error:e}");
                assert!(!run.why().to_string().contains("energy is off"), "{label}: {}", run.why());
            }
        }
    }
}

/// A spring from the centre of mass to a point that goes round the unit circle once in a time of 2 pi.
#[derive(Clone, Copy)]
struct Anchor {
    k: f64,
}

impl Force<2> for Anchor {
    type Form = Translation;

    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        let ((sine, cosine), k) = (motion.t.sin_cos(), T::constant(self.k, 0.0));
        Vector::<2, T>::new(k * (cosine - motion.x[0]), k * (sine - motion.x[1]))
    }
}

/// A body that is dragged for long through a viscous medium, by a work that goes on growing while its energies do not. In the steady
/// motion `x_1 + i x_2 = k/(k - 1 + i r) exp(i t)`.
#[test]
fn a_work_that_goes_on_is_no_loss() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        dissipation(space_translation = r),
        potential = orthogonality(20),
        forces = custom(anchor, translation),
        emit(lanes)
    )]
    struct Dragged {
        r: f64,
        anchor: Anchor,
    }
    for (r, k) in [(3.0, 1e2), (10.0, 1e4)] {
        let dragged = Dragged { r, anchor: Anchor { k } }.prepare().unwrap();
        let size = (k - 1.0) * (k - 1.0) + r * r;
        let (a, b) = (k * (k - 1.0) / size, -k * r / size);
        let exact = |t: f64| Vector::<2>::new(a * t.cos() - b * t.sin(), a * t.sin() + b * t.cos());
        let (phi, still) = (Matrix::identity(), Matrix::zeros());
        let start = dragged.at_velocity(exact(0.0), phi, Vector::<2>::new(-b, a), still).unwrap();
        for tolerance in [1e-3, 1e-4, 1e-5] {
            let run = Simulation::new(&dragged, start).until(600.0).tolerance(tolerance).every(1.0);
            let run = run.run().unwrap_or_else(|halt| panic!("{r} {k:e} at {tolerance:e}: {halt}"));
            let errors = run.iter().map(|(t, point)| (point.x() - exact(t)).norm());
            let worst = errors.fold(0.0, f64::max);
            assert!(worst < tolerance, "{r} {k:e} at {tolerance:e}: {worst:e}");
            let ends = Ensemble::new(&dragged, [start]).until(600.0).tolerance(tolerance).run().unwrap();
            let error = (ends[0].as_ref().unwrap().x() - exact(600.0)).norm();
            assert!(error < tolerance, "{r} {k:e} at {tolerance:e}, in lanes: {error:e}");
        }
    }
}
