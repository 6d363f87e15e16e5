//! Measured orders on a driven, nonlinear body, against the same motion by steps of order 8 on SL(n) with the multiplier
//! eliminated: another method and another form of the equations.

use affine_integrators::lie::Chart;
use affine_integrators::rattle::Composition;
use affine_integrators::{Rattle, RungeKutta8};
use affine_runtime::frames::Matrix;
use affine_runtime::model::{Constraint, Group, Quantity};

use crate::body::{DISC, DRIVEN, Elastic, distance, groups, part, run, start, state};

const T_END: f64 = 2.0;

/// The constrained equations: the force gets the multiple of `phi^-1` that keeps `tr(phi^-1 phi_dot) = 0`,
/// `tr(phi^-1 phi_ddot) = tr((phi^-1 phi_dot)^2)`.
fn constrained<const N: usize, const D: usize>(
    body: Elastic<N>,
) -> impl Fn(f64, &[f64; D]) -> [f64; D] + Copy {
    let free = body.equations::<D>();
    move |t, y| {
        let rates = free(t, y);
        let (velocity, force) = (part::<N>(&rates, 0), part::<N>(&rates, 1));
        let inverse = part::<N>(y, 0).try_inverse().unwrap();
        let accelerated = |force: &Matrix<N>| Matrix::<N>::from_fn(|i, a| force[(a, i)] / body.inertia[a]);
        let oh = inverse * velocity;
        let missing = (oh * oh).trace() - (inverse * accelerated(&force)).trace();
        let factor = missing / (inverse * accelerated(&inverse)).trace();
        state(&velocity, &(force + inverse * factor))
    }
}

fn reference<const N: usize, const D: usize>(body: Elastic<N>) -> [f64; D] {
    let chart = Chart::<N>::new(Constraint::Isochoric, 0);
    let begin = (0.0, start::<N, D>(&body));
    let f = constrained::<N, D>(body);
    let mut run = RungeKutta8::within(chart, f, groups::<N>(), begin, T_END, 1e-15).unwrap();
    while !run.is_finished() {
        run.advance().unwrap();
    }
    *run.y()
}

fn observed<const N: usize, const D: usize>(body: Elastic<N>, order: usize, n: f64) -> f64 {
    let expected = reference::<N, D>(body);
    let error = |n: f64| {
        let run = run::<N, D, _>(body.equations(), order, (0.0, start(&body)), T_END, T_END / n);
        distance(run.y(), &expected)
    };
    let (first, last) = (error(n), error(2.0 * n));
    assert!(last > 3e-14, "rounding hides the order: {last:e}");
    (first / last).log2()
}

#[test]
fn orders_are_2_4_6_and_8() {
    for (order, n) in [(2, 100.0), (4, 20.0), (6, 10.0), (8, 6.0)] {
        let (space, plane) = (observed::<3, 18>(DRIVEN, order, n), observed::<2, 8>(DISC, order, n));
        println!("RATTLE {order}: {space:.3} in space, {plane:.3} in the plane");
        for found in [space, plane] {
            let tolerance = if order == 8 { 0.8 } else { 0.3 };
            assert!((found - order as f64).abs() < tolerance, "{order}: {space} {plane}");
        }
    }
}

/// The energy that the drive gives is the work, to the order of the steps: the energies are those of the reference.
#[test]
fn works_are_of_the_order_of_the_steps() {
    const GROUPS: &[Group] = &[
        Group::new(Quantity::Placement, 9),
        Group::new(Quantity::CanonicalMomentum, 9),
        Group::new(Quantity::Work, 1),
    ];
    let free = DRIVEN.equations::<18>();
    let drive = |t: f64, y: &[f64; 18]| {
        let gram = part::<3>(y, 0).transpose() * part::<3>(y, 0);
        [DRIVEN.e * (DRIVEN.w * t).sin(), DRIVEN.e * DRIVEN.w * (DRIVEN.w * t).cos()]
            .map(|f| f * gram[(0, 0)])
    };
    let with_work = |y: &[f64; 18], work: f64| {
        let mut state = [work; 19];
        state[..18].copy_from_slice(y);
        state
    };
    let alone = |y: &[f64; 19]| {
        let mut state = [0.0; 18];
        state.copy_from_slice(&y[..18]);
        state
    };
    let equations = |t: f64, y: &[f64; 19]| with_work(&free(t, &alone(y)), drive(t, &alone(y))[1]);
    let begin = start::<3, 18>(&DRIVEN);
    let energy = |t: f64, y: &[f64; 18]| DRIVEN.energy(y) + drive(t, y)[0];
    let expected = energy(T_END, &reference(DRIVEN)) - energy(0.0, &begin);
    for (order, n) in [(2, 100.0), (4, 20.0), (6, 10.0), (8, 6.0)] {
        let error = |n: f64| {
            let composition = Composition::of_order(order).unwrap();
            let begin = (0.0, with_work(&begin, 0.0));
            let mut run =
                Rattle::<3, _, _>::new(equations, GROUPS, composition, begin, T_END, T_END / n).unwrap();
            while !run.is_finished() {
                run.advance().unwrap();
            }
            (run.y()[18] - expected).abs()
        };
        let (first, last) = (error(n), error(2.0 * n));
        let found = (first / last).log2();
        println!("work by RATTLE {order}: {found:.3}, {last:e}");
        assert!(last > 1e-14 && (found - order as f64).abs() < 0.3, "{order}: {found} {last:e}");
    }
}

#[test]
fn output_between_steps_is_of_the_order_of_the_steps_and_leaves_them_alone() {
    let composition = Composition::of_order(6).unwrap();
    let new = || {
        let begin = (0.0, start::<3, 18>(&DRIVEN));
        Rattle::<3, _, _>::new(DRIVEN.equations(), groups::<3>(), composition, begin, T_END, 0.05).unwrap()
    };
    let (mut plain, mut watched) = (new(), new());
    while !plain.is_finished() {
        let begin = plain.t();
        plain.advance().unwrap();
        watched.advance().unwrap();
        let t = begin + 0.37 * (watched.t() - begin);
        let between = watched.at(t).unwrap();
        let expected = *run::<3, 18, _>(DRIVEN.equations(), 8, (0.0, start(&DRIVEN)), t, 0.02).y();
        assert!(distance(&between, &expected) < 1e-7, "{t}");
        assert_eq!(plain.y(), watched.y());
        assert_eq!(watched.at(watched.t()).unwrap(), *watched.y());
    }
}
