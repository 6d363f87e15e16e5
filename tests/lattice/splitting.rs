//! The lattice by exact flows of its pieces: orders, what is kept to rounding, and where a fixed step ends.

use affine_runtime::frames::Matrix;
use affine_runtime::integrate::Failure;
use affine_runtime::lattice::{
    CircleFlow, Lattice, LatticeFlow, LatticePieces, LatticeSplitting, StopReason, TwoPolarForm,
};
use affine_runtime::prelude::*;

use crate::reduced_flow::{distance, start};

macro_rules! models {
    ($($name:ident $n:literal ($($kinetic:tt)*) $(, $potential:expr)?;)*) => { $(
        #[affine_model(dim = $n, kinetic($($kinetic)*), $(potential = $potential,)? emit(two_polar, splitting))]
        struct $name;
    )* };
}

models! {
    Plane 2 (casimir2 = 1.2, casimir1_squared = 0.1);
    PlaneInWell 2 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), 0.3*(tr(G)*exp(-2*q) - n) + sinh(q)^2;
    PlaneDalembert 2 (dalembert = 1.5), 0.4*(tr(G) - n) + 0.1*tr(G*G);
    Space 3 (casimir2 = 1.2, casimir1_squared = 0.1);
    Body 3 (casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), 0.3*(tr(G)*exp(-2*q) - n) + sinh(q)^2;
    Mirrored 3 (casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1), q1^2 + q2^2 + q3^2;
    Dalembert 3 (dalembert = 1.5), 0.4*(tr(G) - n) + 0.1*tr(G*G);
}

fn split<const N: usize, M: LatticePieces<N>>(model: &M, order: usize, t: f64, step: f64) -> Lattice<N> {
    LatticeSplitting::new(model, order, (0.0, start()), t, step).unwrap().unwrap().finish().unwrap()
}

fn assert_orders<const N: usize, M: LatticePieces<N> + TwoPolarForm<N>>(model: &M, steps: [f64; 4]) {
    let t = 1.0;
    let expected = *LatticeFlow::new(model, 0.0, start()).tolerance(1e-15).advance_to(t).unwrap();
    for (order, step) in [2, 4, 6, 8].into_iter().zip(steps) {
        let [coarse, fine] = [step, 0.5 * step].map(|h| distance(&split(model, order, t, h), &expected));
        let measured = (coarse / fine).log2();
        println!("{} {order}: {coarse:.1e} {fine:.1e} {measured:.2}", M::DESCRIPTION.name);
    }
}

#[test]
fn orders() {
    let steps = [1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0, 1.0 / 16.0];
    assert_orders(&Plane, steps);
    assert_orders(&PlaneInWell, steps);
    assert_orders(&PlaneDalembert, steps);
    assert_orders(&Space, steps);
    assert_orders(&Body, steps);
    assert_orders(&Mirrored, steps);
    assert_orders(&Dalembert, steps);
    println!("{:?} {:?} {}", Space::PIECES, Body::PIECES, Plane::NYSTROM);
}
