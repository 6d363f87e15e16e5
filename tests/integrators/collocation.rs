//! Gauss collocation where rounding is all that is left of the equations of a step: momenta that friction has taken away, and
//! forces of contact whose derivative jumps.

use affine_runtime::force::{AtPoint, Force, Motion, PointForce, Translation};
use affine_runtime::frames::Space as OnSpace;
use affine_runtime::frames::Vector;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;
use affine_runtime::simulate::Reason;

#[affine_model(
    dim = 3,
    kinetic(casimir2 = 0.2, body_inertia = 1),
    potential = 0.5*(tr(G)*exp(-2*q) - n) + 0.5*q^2,
    dissipation(body_inertia = r)
)]
struct Viscous {
    r: f64,
}

#[affine_model(
    dim = 2,
    kinetic(dalembert = 1),
    potential = (tr(G) - n)^2,
    dissipation(casimir1_squared = r, body_inertia = 0.1)
)]
struct Bulk {
    r: f64,
}

fn viscous_start() -> (Matrix<3>, Matrix<3>) {
    let phi = Matrix::<3>::new(1.1, 0.2, 0.0, -0.1, 0.95, 0.1, 0.05, 0.0, 1.02);
    (phi, Matrix::<3>::new(0.1, 0.4, 0.0, -0.3, 0.2, 0.1, 0.0, 0.2, -0.1))
}

fn bulk_start() -> (Matrix<2>, Matrix<2>) {
    (Matrix::<2>::new(1.1, 0.2, -0.1, 0.95), Matrix::<2>::new(0.1, 0.4, -0.3, 0.2))
}

/// Rounding, and what stiffness makes of it.
const SOLVED: f64 = 1e-12;

#[test]
fn overdamped_bodies_come_to_their_end() {
    for (r, step, t_end) in [(1e3, 1e-2, 0.5), (1e4, 1e-3, 0.1)] {
        let model = Viscous { r }.prepare().unwrap();
        let (phi, phi_dot) = viscous_start();
        let simulation = || {
            let start = model.at_velocity(phi, phi_dot).unwrap();
            Simulation::new(&model, start).until(t_end).output([t_end])
        };
        let exact = simulation().method(Method::RungeKutta8).tolerance(1e-12).run().unwrap();
        for stages in [2, 3, 4, 6] {
            let run = simulation().method(Method::Gauss { stages, step }).run();
            let run = run.unwrap_or_else(|halt| panic!("r = {r:e}, {stages} stages: {halt}"));
            assert!(run.computation().residual.unwrap() < SOLVED, "{r:e} {stages}: {}", run.why());
            let error = (run.end().1.phi() - exact.end().1.phi()).norm() / phi.norm();
            assert!(error < 1e-6, "r = {r:e}, {stages} stages: phi errs by {error:e}");
        }
    }
}

/// Where friction ends velocities ten thousand times within a step, Gauss collocation turns them around at every step, and its
/// stages balance energy and work all the same. The report says so.
#[test]
fn a_wrong_motion_whose_balance_closes_is_named() {
    let run = |r: f64, method: Method| {
        let model = Viscous { r }.prepare().unwrap();
        let (phi, phi_dot) = viscous_start();
        let start = model.at_velocity(phi, phi_dot).unwrap();
        Simulation::new(&model, start).until(1.0).method(method).run().unwrap()
    };
    let gauss = Method::Gauss { stages: 2, step: 0.01 };
    let wrong = run(1e6, gauss);
    assert!(wrong.power_balance().unwrap().relative() < 1e-6, "{}", wrong.power_balance().unwrap());
    assert!(
        wrong.computation().unresolved_power > 100.0 && wrong.why().to_string().contains("Method::Radau")
    );
    let right = run(1e6, Method::Automatic);
    let apart = wrong.end().1.pi().0.0 - right.end().1.pi().0.0;
    assert!(apart.norm() > 0.1, "velocities that friction has ended: {apart}");
    for resolved in [run(1.0, gauss), right] {
        assert_eq!(resolved.computation().unresolved_power, 0.0, "{}", resolved.why());
    }
}

/// Steps of a hundred times the time in which friction stops a dilatation, and the rounding of its forces as many times
/// larger than that of the momentum.
#[test]
fn rounding_of_stiff_friction_is_a_solution() {
    let model = Bulk { r: 1e5 }.prepare().unwrap();
    let (phi, phi_dot) = bulk_start();
    let run = Simulation::new(&model, model.at_velocity(phi, phi_dot).unwrap()).until(0.1);
    let run = run.method(Method::Gauss { stages: 2, step: 1e-2 }).run().unwrap();
    assert_eq!(run.statistics().steps, 10);
    assert!(run.computation().residual.unwrap() < SOLVED, "{}", run.why());
}

/// Ten times as stiff the equations of the first step have no solution near the start.
#[test]
fn steps_without_a_solution_still_end() {
    let model = Bulk { r: 1e6 }.prepare().unwrap();
    let (phi, phi_dot) = bulk_start();
    for stages in [2, 4, 6] {
        let run = Simulation::new(&model, model.at_velocity(phi, phi_dot).unwrap()).until(0.1);
        let halt = run.method(Method::Gauss { stages, step: 1e-2 }).run().unwrap_err();
        assert!(
            matches!(halt.stop.reason, Reason::NoSolution { residual, .. } if residual > 1e-3),
            "{stages} stages: {halt}"
        );
    }
}

/// Half a sum over the corners of a unit cube of how deep each is below `z = 0`.
fn pressed<T: Scalar>(motion: &Motion<3, T>, mut each: impl FnMut([T; 3], T)) {
    let half = T::constant(0.5, 0.0);
    for corner in 0..8 {
        let side = |bit: usize| if corner >> bit & 1 == 1 { half } else { T::zero() - half };
        let arm: [T; 3] = core::array::from_fn(|i| {
            motion.phi[(i, 0)] * side(0) + motion.phi[(i, 1)] * side(1) + motion.phi[(i, 2)] * side(2)
        });
        let z = motion.x[2] + arm[2];
        each(arm, half * (z.abs() - z));
    }
}

/// A ground that presses with `stiffness` times the depth, and weight.
#[derive(Clone, Debug)]
struct Ground {
    stiffness: f64,
}

impl Force<3> for Ground {
    type Form = Translation;
    fn force<T: Scalar>(&self, motion: &Motion<3, T>) -> Vector<3, T> {
        let mut depth = T::zero();
        pressed(motion, |_, of_corner| depth += of_corner);
        let upward = T::constant(self.stiffness, 0.0) * depth - T::constant(9.81, 0.0);
        Vector::<3, T>::from_fn(|i, _| if i == 2 { upward } else { T::zero() })
    }
}

/// The moments of the same pressures.
#[derive(Clone, Debug)]
struct Moments {
    stiffness: f64,
}

impl Force<3> for Moments {
    type Form = OnSpace;
    fn force<T: Scalar>(&self, motion: &Motion<3, T>) -> Matrix<3, T> {
        let mut moments = [T::zero(); 3];
        let stiffness = T::constant(self.stiffness, 0.0);
        pressed(motion, |arm, depth| {
            for (moment, arm) in moments.iter_mut().zip(arm) {
                *moment += arm * stiffness * depth;
            }
        });
        Matrix::<3, T>::from_fn(|i, j| if j == 2 { moments[i] } else { T::zero() })
    }
}

#[affine_model(
    dim = 3,
    kinetic(dalembert = 0.0833333333333, space_translation = 1),
    potential = orthogonality(stiffness),
    forces = custom(ground, translation) + custom(moments, spatial)
)]
struct Cube {
    stiffness: f64,
    ground: Ground,
    moments: Moments,
}

/// Bodies that meet the ground within the step, `x`, `phi`, `p`, `Pi`: their number of stages and the frame they are in.
const AT_A_KINK: [(usize, f64, [f64; 24]); 4] = [
    (
        2,
        57.0,
        [
            0.0,
            0.0,
            0.5715990373864868,
            0.7930843466553121,
            0.1679812684282997,
            0.5858282378901559,
            -0.6092603420714866,
            0.19030579302238745,
            0.772908824163806,
            0.023658871988068285,
            -0.9650826952167495,
            0.2483306619222282,
            0.0,
            0.0,
            -2.0418970877806495,
            -0.005215462605529044,
            0.004254492678856444,
            -0.22551934619150743,
            -0.1566139122875284,
            0.14974824524801394,
            0.00694261411953976,
            0.042412598370202004,
            -0.03917667603209247,
            0.024594886541308994,
        ],
    ),
    (
        3,
        21.0,
        [
            0.0,
            0.0,
            0.48944962057896274,
            0.09972094530522797,
            0.9932449453531647,
            0.060210526944516445,
            0.05530211252470595,
            0.05769641236486138,
            -0.9997861954363402,
            -0.9936539514170714,
            0.10564721235531173,
            -0.05456815991057047,
            0.0,
            0.0,
            -0.2780600122048478,
            0.49664724044946396,
            -0.030969365877474828,
            0.05353862190845344,
            -0.0532176044612135,
            -0.00647033504766982,
            0.4814708989756123,
            0.016601768326533553,
            -0.0028415951219887964,
            0.06586437841375493,
        ],
    ),
    (
        3,
        21.0,
        [
            0.0,
            0.0,
            0.5503991607435995,
            -0.9899572230772625,
            -0.008303979695457951,
            -0.14858370217903913,
            0.15268864731552867,
            0.02696576622599858,
            -0.9858646743301609,
            0.014746278328621153,
            -0.9983376774086697,
            -0.025344704045031214,
            0.0,
            0.0,
            1.3349092430708849,
            -0.003131921744387256,
            -0.006718470123309304,
            -0.1480371794440261,
            0.12430073530350336,
            -0.10256757782499024,
            -0.013158415750297019,
            0.011988780685990436,
            -0.003960744905469618,
            0.07952819679948703,
        ],
    ),
    (
        3,
        30.0,
        [
            0.0,
            0.0,
            0.5942376113105845,
            0.9566135896212979,
            0.0027971892261923967,
            -0.28147483134522355,
            0.281705892484136,
            -0.04045080306829701,
            0.9568892673179408,
            -0.014818474428555552,
            -0.9972304257618007,
            -0.0349568517931038,
            0.0,
            0.0,
            0.34110960954984826,
            0.016278098975582925,
            -0.03924929313968146,
            0.02204367335253006,
            0.05633092540676296,
            -0.236555692474126,
            -0.013435367113644243,
            0.03536295815177952,
            0.008137556545106915,
            -0.2733734084960668,
        ],
    ),
];

#[test]
fn a_kink_of_a_force_within_a_step_is_no_failure() {
    let (ground, moments) = (Ground { stiffness: 200.0 }, Moments { stiffness: 200.0 });
    let cube = Cube { stiffness: 1e3, ground, moments }.prepare().unwrap();
    let dt = 1.0 / 60.0;
    for (stages, frame, state) in &AT_A_KINK {
        let (stages, start) = (*stages, cube.unflatten(state));
        let run = Simulation::new(&cube, start).from(frame * dt).until((frame + 1.0) * dt);
        let run = run.method(Method::Gauss { stages, step: dt }).run();
        let run = run.unwrap_or_else(|halt| panic!("{stages} stages, frame {frame}: {halt}"));
        assert_eq!(run.statistics().steps, 1);
        assert!(run.computation().residual.unwrap() < SOLVED, "{}", run.why());
    }
}

/// A ground that presses with 300 times the depth, and rubs by the depth.
#[derive(Clone, Copy, Debug)]
struct Rubbing;

impl PointForce<2> for Rubbing {
    fn force<T: Scalar>(&self, _: T, x: &Vector<2, T>, v: &Vector<2, T>) -> Vector<2, T> {
        let depth = (-x[1]).max(T::zero());
        Vector::<2, T>::new(-(depth * v[0]), T::constant(300.0, 0.0) * depth)
    }
}

#[affine_model(
    dim = 2,
    kinetic(dalembert = 0.1, space_translation = 1),
    potential = orthogonality(30) + 9.81*x[2],
    forces = custom(press, translation) + custom(turn, spatial)
)]
struct Trolley {
    press: AtPoint<2, Rubbing, Translation, 2>,
    turn: AtPoint<2, Rubbing, OnSpace, 2>,
}

/// Where a foot has left the ground at one stage and not half-way through the step, its work at that stage falls by a constant
/// factor in each correction, down to 1e-216 and on: that is no way still to go.
#[test]
fn a_stage_without_contact_is_solved() {
    let feet = [[-1.0, -0.5], [1.0, -0.5]];
    let model = Trolley { press: AtPoint::new(feet, Rubbing), turn: AtPoint::new(feet, Rubbing) };
    let model = model.prepare().unwrap();
    let (x, v) = (Vector::<2>::new(0.0, 0.8), Vector::<2>::new(1.0, -0.3));
    let (phi, phi_dot) = (Matrix::<2>::new(1.0, 0.1, -0.1, 1.0), Matrix::<2>::new(0.0, -0.4, 0.4, 0.1));
    let simulation = || {
        let start = model.at_velocity(x, phi, v, phi_dot).unwrap();
        Simulation::new(&model, start).until(3.0).output([3.0])
    };
    let exact = simulation().method(Method::RungeKutta8).tolerance(1e-10).run().unwrap();
    for step in [0.02, 0.01] {
        for stages in [2, 3, 4, 6] {
            let run = simulation().method(Method::Gauss { stages, step }).run();
            let run = run.unwrap_or_else(|halt| panic!("{stages} stages, steps of {step}: {halt}"));
            assert!(run.computation().residual.unwrap() < SOLVED, "{}", run.why());
            let error = (run.end().1.phi() - exact.end().1.phi()).norm();
            assert!(error < 12.0 * step, "{stages} stages, steps of {step}: phi errs by {error:e}");
        }
    }
}
