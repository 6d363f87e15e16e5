//! What RATTLE keeps: the constraints, spin and vorticity to rounding, the energy without drift, the symplectic form.

use affine_integrators::Rattle;
use affine_integrators::rattle::Composition;
use affine_runtime::frames::Matrix;

use crate::body::{Elastic, ISOTROPIC, TRIAXIAL, determinant, distance, groups, part, run, start};

/// Unoptimised, a tenth: the bounds grow with the root of the number of steps.
const STEPS: u32 = if cfg!(debug_assertions) { 10_000 } else { 100_000 };

fn spin(y: &[f64]) -> Matrix<3> {
    let sigma = part::<3>(y, 0) * part::<3>(y, 1);
    sigma - sigma.transpose()
}

fn vorticity(y: &[f64]) -> Matrix<3> {
    let sigma = part::<3>(y, 1) * part::<3>(y, 0);
    sigma - sigma.transpose()
}

struct Largest {
    determinant: f64,
    expansion: f64,
    spin: f64,
    vorticity: f64,
    energy: [f64; 2],
}

fn largest(body: Elastic<3>, order: usize, step: f64) -> Largest {
    let start = start::<3, 18>(&body);
    let composition = Composition::of_order(order).unwrap();
    let t_end = step * f64::from(STEPS);
    let mut run =
        Rattle::<3, _, _>::new(body.equations(), groups::<3>(), composition, (0.0, start), t_end, step)
            .unwrap();
    let mut largest =
        Largest { determinant: 0.0, expansion: 0.0, spin: 0.0, vorticity: 0.0, energy: [0.0; 2] };
    for k in 0..STEPS {
        run.advance().unwrap();
        let y = run.y();
        let max = |a: &mut f64, b: f64| *a = a.max(b);
        max(&mut largest.determinant, (determinant(&part::<3>(y, 0)) - 1.0).abs());
        max(&mut largest.expansion, body.expansion(y).abs());
        max(&mut largest.spin, (spin(y) - spin(&start)).norm());
        max(&mut largest.vorticity, (vorticity(y) - vorticity(&start)).norm());
        let half = usize::from(2 * k >= STEPS);
        max(&mut largest.energy[half], (body.energy(y) - body.energy(&start)).abs());
    }
    println!(
        "RATTLE {order}, {STEPS} steps: det {:.1e}, trace {:.1e}, spin {:.1e}, vorticity {:.1e}, energy {:.1e} {:.1e}",
        largest.determinant,
        largest.expansion,
        largest.spin,
        largest.vorticity,
        largest.energy[0],
        largest.energy[1]
    );
    largest
}

#[test]
fn constraints_spin_and_vorticity_to_rounding() {
    for order in [2, 6] {
        let found = largest(ISOTROPIC, order, 0.05);
        // Some roundings of products of a few numbers up to 2, whatever the number of steps.
        assert!(found.determinant < 2e-14, "{:e}", found.determinant);
        assert!(found.expansion < 2e-14, "{:e}", found.expansion);
        // A rounding for each step at random; momenta are of order 1.
        let bound = 8.0 * f64::EPSILON * f64::from(STEPS).sqrt();
        assert!(found.spin < bound && found.vorticity < bound, "{:e} {:e}", found.spin, found.vorticity);
        assert!(found.energy[0] > 1e-12, "the energy is none of these: {:?}", found.energy);
        assert!(found.energy[1] < 1.2 * found.energy[0], "no drift: {:?}", found.energy);
    }
}

#[test]
fn vorticity_of_a_triaxial_inertia_is_not_kept() {
    let found = largest(TRIAXIAL, 2, 0.05);
    assert!(found.vorticity > 0.1 && found.spin < 1e-11, "{:e}", found.vorticity);
}

/// The map on the constrained phase space keeps `sum dPi_k ^ dphi_k` on tangent vectors: by differences of the flow along
/// curves of points on both constraints.
#[test]
fn steps_are_symplectic() {
    let body = TRIAXIAL;
    // Curves through the start within the constraints: the flows of other bodies.
    let others =
        [Elastic { c: -2.0, ..body }, Elastic { d: 3.0, ..body }, Elastic { c: 0.0, d: -1.5, ..body }];
    let d = 1e-3;
    let image = |y: [f64; 18]| *run::<3, 18, _>(body.equations(), 2, (0.0, y), 1.2, 0.4).y();
    let along = |other: Elastic<3>, s: f64| {
        *run::<3, 18, _>(other.equations(), 8, (0.0, start(&body)), s, s.abs()).y()
    };
    let tangent = |other: Elastic<3>, map: &dyn Fn([f64; 18]) -> [f64; 18]| {
        let at = |s: f64| map(along(other, s));
        let (a, b, c, e) = (at(d), at(-d), at(2.0 * d), at(-2.0 * d));
        core::array::from_fn::<f64, 18, _>(|k| (8.0 * (a[k] - b[k]) - (c[k] - e[k])) / (12.0 * d))
    };
    let form = |u: &[f64; 18], v: &[f64; 18]| -> f64 {
        let pair = |i: usize, a: usize| (3 * i + a, 9 + 3 * a + i);
        let mut sum = 0.0;
        for i in 0..3 {
            for a in 0..3 {
                let (q, p) = pair(i, a);
                sum += u[p] * v[q] - u[q] * v[p];
            }
        }
        sum
    };
    let before = others.map(|other| tangent(other, &|y| y));
    let after = others.map(|other| tangent(other, &image));
    for (k, l) in [(0, 1), (1, 2), (0, 2)] {
        let (old, new) = (form(&before[k], &before[l]), form(&after[k], &after[l]));
        assert!(old.abs() > 1e-3, "{old}");
        // The differences are right to d^4; the error of so long steps is a tenth.
        assert!((new - old).abs() < 1e-9, "{old} {new}");
    }
    let precise = *run::<3, 18, _>(body.equations(), 8, (0.0, start(&body)), 1.2, 0.02).y();
    assert!(distance(&image(start(&body)), &precise) > 1e-3);
}

#[test]
fn back_to_the_start() {
    for order in [2, 4, 6, 8] {
        let begin = start::<3, 18>(&TRIAXIAL);
        let there = *run::<3, 18, _>(TRIAXIAL.equations(), order, (0.0, begin), 10.0, 0.1).y();
        let back = *run::<3, 18, _>(TRIAXIAL.equations(), order, (10.0, there), 0.0, 0.1).y();
        assert!(distance(&back, &begin) < 1e-12, "{order}");
    }
}
