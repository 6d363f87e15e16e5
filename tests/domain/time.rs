//! Forces whose sizes are absolute values of functions of the time.

use core::f64::consts::TAU;

use affine_runtime::prelude::*;
use affine_runtime::simulate::Reason;

mod root {
    use affine_runtime::prelude::*;
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = 0.3*sqrt(sin(4*t)^2)*phi[1,2] + (tr(G) - 2)^2)]
    pub(super) struct Driven;
}

mod absolute {
    use affine_runtime::prelude::*;
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = 0.3*abs(sin(4*t))*phi[1,2] + (tr(G) - 2)^2)]
    pub(super) struct Driven;
}

mod plus {
    use affine_runtime::prelude::*;
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = 0.3*sin(4*t)*phi[1,2] + (tr(G) - 2)^2)]
    pub(super) struct Driven;
}

mod minus {
    use affine_runtime::prelude::*;
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = -0.3*sin(4*t)*phi[1,2] + (tr(G) - 2)^2)]
    pub(super) struct Driven;
}

/// The same motion as that of the sine and of its opposite, each in its half of the period.
#[test]
fn either_sign_in_turn() {
    let phi = Matrix::<2>::new(1.1, 0.2, -0.1, 0.9);
    let phi_dot = Matrix::<2>::new(0.1, 0.4, -0.3, 0.0);
    let half = core::f64::consts::FRAC_PI_4;
    let tolerance = 1e-12;
    let first = plus::Driven.at_velocity(phi, phi_dot).unwrap();
    let first = Simulation::new(&plus::Driven, first).until(half).tolerance(tolerance).run().unwrap();
    let between = first.end().1;
    let second = minus::Driven.at_momentum(*between.phi(), between.pi()).unwrap();
    let second = Simulation::new(&minus::Driven, second).from(half).until(2.0 * half).tolerance(tolerance);
    let second = second.run().unwrap();
    let works = first.work().last().unwrap() + second.work().last().unwrap();
    let start = root::Driven.at_velocity(phi, phi_dot).unwrap();
    let by_root = Simulation::new(&root::Driven, start).until(2.0 * half).tolerance(tolerance).run().unwrap();
    let start = absolute::Driven.at_velocity(phi, phi_dot).unwrap();
    let by_size =
        Simulation::new(&absolute::Driven, start).until(2.0 * half).tolerance(tolerance).run().unwrap();
    assert_eq!(by_root.end().1, by_size.end().1);
    let error = (by_root.end().1.phi() - second.end().1.phi()).norm();
    assert!(error < 1e-10, "{error:e}");
    // The power jumps where the sine vanishes, and steps, which do not depend on it, do not look for that.
    let found = by_root.work().last().unwrap();
    assert!((found - works).abs() < 1e-4, "{found} {works}");
}

/// A force `h sin(w t)` that turns 1600 times a unit of time: at the few places where steps look at it it has no mean of its own.
#[test]
fn a_drive_faster_than_the_steps_is_named() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1),
        potential = h*sin(w*t)*phi[1,2] + (tr(G) - 2)^2,
        emit(nystrom)
    )]
    struct Driven {
        h: f64,
        w: f64,
    }
    let phi = Matrix::<2>::new(1.1, 0.2, -0.1, 0.9);
    let phi_dot = Matrix::<2>::new(0.1, 0.4, -0.3, 0.0);
    let run = |w: f64, method: Method| {
        let model = Driven { h: 0.3, w }.prepare().unwrap();
        let start = model.at_velocity(phi, phi_dot).unwrap();
        Simulation::new(&model, start).until(3.0).tolerance(1e-3).method(method).run()
    };
    let methods = [
        Method::Automatic,
        Method::RungeKutta8,
        Method::RungeKutta5,
        Method::Gauss { stages: 3, step: 0.01 },
    ];
    for method in methods {
        let fast = run(1e4, method).unwrap();
        let (part, turns) = fast.computation().turns.unwrap();
        assert_eq!(part, "sin(w*t)");
        assert!(turns > 1.0, "{method:?}: {turns}");
        if let Method::Gauss { step, .. } = method {
            assert!((turns - 1e4 * step / TAU).abs() < 1e-6, "{turns}");
        }
        assert!(fast.why().to_string().contains("`sin(w*t)` makes"), "{}", fast.why());
        let slow = run(4.0, method).unwrap();
        assert!(!slow.why().to_string().contains("turns within"), "{}", slow.why());
        assert!(slow.computation().turns.unwrap().1 < 1.0);
    }
    // Beside a work the steps lose their balance, and the run ends.
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = 0.3*sin(1e4*t)*phi[1,2] + (tr(G) - 2)^2)]
    struct Balanced;
    let start = Balanced.at_velocity(phi, phi_dot).unwrap();
    let halt = Simulation::new(&Balanced, start).until(5.0).tolerance(1e-3).run().unwrap_err();
    assert!(matches!(halt.stop.reason, Reason::EnergyLost { .. }), "{halt}");
    assert!(halt.trajectory.why().to_string().contains("`sin(1"), "{}", halt.trajectory.why());
}

/// The time alone counts, and what it does not turn has no angle.
#[test]
fn angles_that_the_time_turns() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = 0.1*cos(40*x[1] - t) + sin(phi[1,1]) + 0.1*tan(0.1*t)*phi[1,2] + (tr(G) - 2)^2
    )]
    struct Wave;
    let start = Wave
        .at_velocity(
            Vector::<2>::zeros(),
            Matrix::<2>::identity(),
            Vector::<2>::new(100.0, 0.0),
            Matrix::<2>::zeros(),
        )
        .unwrap();
    let run = Simulation::new(&Wave, start)
        .until(1.0)
        .method(Method::Gauss { stages: 6, step: 1e-2 })
        .run()
        .unwrap();
    assert_eq!(run.description().angles, ["cos(40*x[1] - t)", "tan(0.1*t)"]);
    let (part, turns) = run.computation().turns.unwrap();
    assert_eq!(part, "cos(40*x[1] - t)");
    assert!((turns - 1e-2 / TAU).abs() < 1e-12, "{turns}");
}
