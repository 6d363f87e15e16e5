//! The fast subset of the stability report: what has to be held is held, what is refused is refused in words.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[allow(dead_code, reason = "the example tries more than the fast subset")]
#[path = "../../examples/stability/scenes/mod.rs"]
mod scenes;

use std::sync::LazyLock;

use affine_runtime::report::{Finding, StabilityReport};
use scenes::Extent;

/// One of several hundred runs, for all tests.
static REPORT: LazyLock<StabilityReport> = LazyLock::new(report);

fn report() -> StabilityReport {
    scenes::report(Extent::Fast).unwrap()
}

#[test]
fn promises_are_kept() {
    let short: Vec<_> = REPORT.fell_short().collect();
    assert!(short.is_empty(), "{short:#?}");
}

/// Where the dilatation separates, steps do not know its stiffness; and how many they are.
#[test]
fn steps_do_not_grow_with_the_stiffness() {
    let steps = |model: &str, n: usize| -> Vec<u64> {
        let separable = REPORT.cases().iter().filter(|case| case.heading == "stiff dilatation, separable");
        let of_model = separable.filter(|case| case.model == model && case.n == n);
        of_model
            .map(|case| match case.finding {
                Finding::Ran { steps, .. } => steps,
                Finding::Stopped(_) => panic!("{case:?}"),
            })
            .collect()
    };
    for (model, n, pinned, count) in
        [("body-metric", 3, 642, 22), ("space-metric", 3, 632, 11), ("body-metric", 2, 123, 11)]
    {
        let steps = steps(model, n);
        assert_eq!(steps.len(), count, "{model}, n = {n}");
        let (least, most) = (steps.iter().min().unwrap(), steps.iter().max().unwrap());
        assert_eq!(least, most, "{model}, n = {n}: the same for every kappa");
        // The last bits of elementary functions differ between machines.
        assert!(most.abs_diff(pinned) <= 5, "{model}, n = {n}: {most}");
    }
}

#[test]
fn two_runs_give_the_same_bytes() {
    let again = report();
    assert_eq!(REPORT.to_csv(), again.to_csv());
    assert_eq!(REPORT.to_svg().unwrap(), again.to_svg().unwrap());
}
