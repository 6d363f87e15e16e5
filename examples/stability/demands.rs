//! What the report has to show.

use affine_runtime::report::{Finding, StabilityCase, StabilityReport};

/// Models whose dilatation separates, with the steps that they take whatever its stiffness, and the number of their cases.
const SEPARABLE: [(&str, usize, u64, usize); 3] =
    [("body-metric", 3, 642, 22), ("space-metric", 3, 632, 11), ("body-metric", 2, 123, 11)];

/// The last bits of elementary functions differ between machines, and steps with them.
const MACHINES: u64 = 5;

/// The promises that are not kept, in words.
pub(crate) fn broken(report: &StabilityReport) -> Vec<String> {
    let short = report.fell_short().map(|case| format!("{case:?} fell short"));
    short.chain(SEPARABLE.iter().filter_map(|counts| steps_grow(report, *counts))).collect()
}

/// Do two reports have the same bytes?
pub(crate) fn are_same(one: &StabilityReport, other: &StabilityReport) -> bool {
    let same_picture = one.to_svg() == other.to_svg();
    same_picture && one.to_csv() == other.to_csv()
}

/// Where the dilatation separates, steps do not know its stiffness.
fn steps_grow(
    report: &StabilityReport,
    (model, n, pinned, count): (&str, usize, u64, usize),
) -> Option<String> {
    let of_model = |case: &&StabilityCase| {
        case.heading == "stiff dilatation, separable" && case.model == model && case.n == n
    };
    let steps: Option<Vec<u64>> = report
        .cases()
        .iter()
        .filter(of_model)
        .map(|case| match case.finding {
            Finding::Ran { steps, .. } => Some(steps),
            _ => None,
        })
        .collect();
    let held = steps.as_ref().is_some_and(|steps| {
        steps.len() == count
            && steps.windows(2).all(|pair| pair[0] == pair[1])
            && steps.iter().all(|steps| steps.abs_diff(pinned) <= MACHINES)
    });
    (!held).then(|| {
        format!("{model}, n = {n}: {pinned} steps for every stiffness, {count} cases; found {steps:?}")
    })
}
