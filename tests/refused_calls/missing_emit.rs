//! What a call needs and `emit(...)` lacks is named.
use affine_runtime::lattice::{Lattice, LatticeFlow};
use affine_runtime::prelude::*;
use affine_runtime::variation::Variation;

#[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1))]
struct Body;

fn together(starts: Vec<<Body as Model<3>>::Point<f64>>) {
    let _ = Ensemble::new(&Body, starts).until(1.0).run();
}

fn lattice(start: Lattice<3>) {
    let _ = LatticeFlow::new(&Body, 0.0, start);
}

fn varied(start: &<Body as Model<3>>::Point<f64>) {
    let _ = Variation::new(&Body, (0.0, start), &[0.0; 18], 1e-9);
}

fn main() {}
