//! What RATTLE refuses, and what it says.

use affine_integrators::rattle::Composition;
use affine_integrators::{Failure, Rattle};
use affine_runtime::model::{Group, Quantity};

use crate::body::{DISC, PLANE, SPACE, TRIAXIAL, determinant, part, start};

type Run<F> = Rattle<3, [f64; 18], F>;

fn new<F: Fn(f64, &[f64; 18]) -> [f64; 18]>(
    f: F,
    groups: &[Group],
    y: [f64; 18],
    step: f64,
) -> Result<Run<F>, Failure> {
    Rattle::new(f, groups, Composition::of_order(2).unwrap(), (0.0, y), 1e3, step)
}

#[test]
fn starts_off_the_constraints() {
    let off = |change: &dyn Fn(&mut [f64; 18])| {
        let mut y = start(&TRIAXIAL);
        change(&mut y);
        new(TRIAXIAL.equations(), SPACE, y, 0.1).map(|run| run.t())
    };
    assert!(matches!(off(&|y| y[0] += 1e-6), Err(Failure::OffConstraint { defect }) if defect > 1e-7));
    assert!(matches!(off(&|y| y[9] += 1e-6), Err(Failure::OffConstraint { defect }) if defect > 1e-8));
    assert_eq!(off(&|y| y[9] = f64::NAN), Err(Failure::NotFinite));
    assert_eq!(off(&|_| ()), Ok(0.0));
    assert!(Failure::OffConstraint { defect: 1e-3 }.to_string().contains("1e-3"));
}

#[test]
fn equations_that_are_not_separable() {
    let free = TRIAXIAL.equations::<18>();
    let coupled = |t: f64, y: &[f64; 18]| {
        let mut rates = free(t, y);
        rates[0] *= y[0];
        rates
    };
    let y = start(&TRIAXIAL);
    assert_eq!(new(coupled, SPACE, y, 0.1).map(|run| run.t()), Err(Failure::NotSeparable));
    let quartic = |t: f64, y: &[f64; 18]| {
        let mut rates = free(t, y);
        rates[0] *= 1.0 + y[9] * y[9];
        rates
    };
    assert_eq!(new(quartic, SPACE, y, 0.1).map(|run| run.t()), Err(Failure::NotSeparable));
    const LIE_POISSON: &[Group] =
        &[Group::new(Quantity::Placement, 9), Group::new(Quantity::ComovingAffineSpin, 9)];
    assert_eq!(new(free, LIE_POISSON, y, 0.1).map(|run| run.t()), Err(Failure::NotSeparable));
}

#[test]
fn steps_without_solution() {
    // In the plane `det phi = 1` is quadratic in the multiplier, and has no real root where the step is far too long.
    let disc = |step: f64| {
        let composition = Composition::of_order(2).unwrap();
        Rattle::<2, _, _>::new(DISC.equations(), PLANE, composition, (0.0, start::<2, 8>(&DISC)), 1e3, step)
    };
    let mut run = disc(4.0).unwrap();
    let failure = loop {
        if let Err(failure) = run.advance() {
            break failure;
        }
    };
    assert!(matches!(failure, Failure::NoSolution { residual } if residual > 1e-10), "{failure:?}");
    assert_eq!(run.advance(), Err(failure), "and again");
    assert!((determinant(&part::<2>(run.y(), 0)) - 1.0).abs() < 1e-13, "the last good state stands");
    for step in [0.0, -1.0, f64::NAN] {
        assert!(matches!(disc(step), Err(Failure::Step { t_end: 1e3, .. })));
    }
    assert_eq!(Composition::of_order(3), None);
}
