//! Forces whose sizes are absolute values of functions of the time.

use affine_runtime::prelude::*;

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
