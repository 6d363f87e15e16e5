//! A run for each frame of a picture.

use affine_runtime::prelude::*;

#[affine_model(
    dim = 2,
    kinetic(dalembert = 1),
    potential = 0.5*(tr(G) - 2)^2,
    emit(splitting)
)]
struct Body;

/// The times of a frame are rounded, and by more than its length is in the end.
#[test]
fn every_frame_has_the_steps_it_is_divided_into() {
    let phi_dot = Matrix::<2>::new(0.1, 0.4, -0.3, 0.2);
    let mut point = Body.at_velocity(Matrix::<2>::new(1.1, 0.2, -0.1, 0.95), phi_dot).unwrap();
    let dt: f64 = 1.0 / 60.0;
    let mut steps = 0;
    for frame in 0..60 {
        let [begin, end] = [0, 1].map(|k| f64::from(frame + k) * dt);
        let method = Method::Splitting { order: 2, step: 0.25 * dt };
        let run =
            Simulation::new(&Body, point).from(begin).until(end).method(method).output([]).run().unwrap();
        steps += run.statistics().steps;
        point = *run.end().1;
    }
    assert_eq!(steps, 240);
}
