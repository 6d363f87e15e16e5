//! Operations of the forces, as the table of energies weighs them: a division as four, a root, an exponential or a logarithm as
//! sixteen additions or multiplications.
//!
//! Along motions `phi` is rounded itself, and forces are the shortest that lose no more than that; at a given point they keep the
//! digits of `phi - 1`, which takes differences that no other tool takes.

use affine_runtime::model::Operations;

use crate::energies;
use crate::table::Energy;

fn weight(operations: &Operations) -> usize {
    let Operations { mul, add, div, sqrt, exp, ln } = *operations;
    mul + add + 4 * div + 16 * (sqrt + exp + ln)
}

/// What it costs at a point and along a motion at most, and what the natural formula costs in the best of three tools that look for
/// common subexpressions (SymPy, CasADi, SymForce); these have no single stretches.
const COSTS: [(&str, [usize; 2], Option<usize>); 39] = [
    ("nh_iso_3", [136, 114], Some(117)),
    ("nh_ln_3", [98, 77], Some(89)),
    ("nh_2d_2", [28, 18], Some(25)),
    ("mooney_3", [224, 192], Some(265)),
    ("yeoh_iso_3", [146, 121], Some(126)),
    ("yeoh_3", [130, 108], Some(105)),
    ("iso3_3", [202, 162], Some(102)),
    ("trace4_3", [35, 30], Some(30)),
    ("trace6_3", [36, 31], Some(31)),
    ("trace8_3", [37, 32], Some(32)),
    ("trace16_3", [38, 33], Some(33)),
    ("arruda_3", [155, 130], Some(172)),
    ("gent_2", [73, 41], Some(51)),
    ("gent_3", [140, 108], Some(105)),
    ("fung_i1_3", [143, 121], Some(116)),
    ("fung_e_3", [126, 117], Some(117)),
    ("ogden_3", [157, 191], Some(251)),
    ("ogden_real_3", [2812, 1606], None),
    ("svk_2", [32, 29], Some(32)),
    ("svk_3", [93, 88], Some(93)),
    ("hencky_2", [544, 333], None),
    ("hencky_3", [2671, 1528], None),
    ("abd_2", [28, 26], Some(27)),
    ("abd_3", [87, 84], Some(87)),
    ("det2_2", [11, 9], Some(9)),
    ("det2_3", [49, 43], Some(43)),
    ("barrier_3", [157, 150], Some(130)),
    ("lndet2_2", [39, 20], Some(28)),
    ("lndet2_3", [77, 67], Some(62)),
    ("volume_2", [19, 13], Some(13)),
    ("volume_3", [57, 75], Some(47)),
    ("blatz_3", [189, 187], Some(145)),
    ("fibre_3", [87, 88], Some(69)),
    ("hgo_3", [129, 108], Some(104)),
    ("cubic2_3", [118, 118], Some(126)),
    ("i2_3_3", [117, 101], Some(124)),
    ("tide_3", [211, 200], Some(230)),
    ("spring_2", [45, 45], Some(46)),
    ("driven_2", [65, 111], Some(64)),
];

/// Where a motion costs more than those tools find: it carries `1/D` and `q` past the range of `det phi`, in place of a division and a
/// logarithm, and takes cofactors of `phi/D`, whose nine multiplications are what is above; keeps the second order of `tr(G)/D^2 - 3`;
/// has `I2` through tensors and not through cofactors; or integrates the power of a drive too.
const ABOVE: [&str; 11] = [
    "yeoh_3",
    "iso3_3",
    "gent_3",
    "fung_i1_3",
    "barrier_3",
    "lndet2_3",
    "volume_3",
    "blatz_3",
    "fibre_3",
    "hgo_3",
    "driven_2",
];

#[test]
fn operations_of_forces() {
    let mut wrong = Vec::new();
    for Energy { name, operations, .. } in &energies::all() {
        let found = operations.each_ref().map(weight);
        let (_, most, tools) = COSTS.iter().find(|(known, ..)| known == name).unwrap();
        if found.iter().zip(most).any(|(found, most)| found > most) {
            wrong.push(format!("{name}: {found:?} where {most:?} were enough"));
        }
        if tools.is_some_and(|tools| (found[1] > tools) != ABOVE.contains(name)) {
            wrong.push(format!("{name}: {} along a motion beside {tools:?}", found[1]));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
