//! Right-hand sides in vectors of four keep the exact value of every rate.

use affine_codegen::algebra::Rational;
use affine_codegen::derive::Model;
use affine_codegen::ir::packed::{Four, Packed, Step};
use affine_codegen::ir::{Op, Program};
use affine_codegen::symbol::Symbol;
use affine_oracle::Random;

use super::in_vectors::run;
use super::models::{FAMILIES, Sample, TRANSLATIONS, derived};
use super::points::{fraction, own};

/// Holds the packed program of a model against the scalar one at a random point, whether it pays or not.
fn agrees(model: &Model, random: &mut Random) -> Option<(Packed, usize)> {
    let program: &Program = &model.dynamics.reduced.program;
    let (packed, cost) = Packed::cheapest(program, &model.dynamics.reduced.components())?;
    let values: Vec<Rational> = program.steps.iter().map(|_| own(&fraction(random))).collect();
    let input = |symbol: &Symbol| {
        let place = program.steps.iter().position(|op| matches!(op, Op::Input(known) if known == symbol))?;
        Some(values[place].clone())
    };
    let expected = program.run(&input);
    assert!(expected.is_some(), "the scalar program runs");
    assert_eq!(run(&packed, &input), expected);
    in_order(&packed);
    Some((packed, cost))
}

/// Every step reads what was computed before it, and none is computed twice.
fn in_order(packed: &Packed) {
    for (place, step) in packed.steps.iter().enumerate() {
        assert!(!packed.steps[..place].contains(step), "{step:?} twice");
        for operand in packed.operands(*step) {
            let is_input =
                matches!(operand, Step::Scalar(v) if matches!(packed.program.steps[v], Op::Input(_)));
            assert!(is_input || packed.steps[..place].contains(&operand), "{operand:?} before {step:?}");
        }
    }
}

#[test]
fn random_models() {
    let mut random = Random::new(53);
    let mut compared = 0;
    for n in [2, 3] {
        for internal in FAMILIES {
            for translation in TRANSLATIONS {
                let sample = Sample::new(&mut random, n, internal, translation);
                compared += usize::from(agrees(&sample.derived(), &mut random).is_some());
            }
        }
    }
    assert_eq!(compared, 2 * FAMILIES.len() * TRANSLATIONS.len());
}

const VIBRATING: &str = "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), \
     potential = hyperbolic_dilatation(10) + neo_hookean(0.5)";
const MISSILE: &str =
    "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)";
const STIFF_MISSILE: &str = "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, \
     body_translation = 1), potential = hyperbolic_dilatation(1e4) + neo_hookean(0.5)";
const ELASTIC: &str = "dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), \
     potential = hyperbolic_dilatation(10) + neo_hookean(0.5)";

/// Vectors of the state, computed vectors, scalar steps, and about how many instructions a stage takes.
#[test]
fn benchmark_problems() {
    let mut random = Random::new(54);
    let mut counts = |args| {
        let (packed, cost) = agrees(&derived(args, "struct Body;"), &mut random).unwrap();
        let arithmetic =
            packed.vectors.iter().filter(|v| v.made.makes() && !matches!(v.made, Four::State(_)));
        let is_scalar = |step: &&Step| match step {
            Step::Scalar(value) => !matches!(packed.program.steps[*value], Op::Constant(_) | Op::Neg(_)),
            Step::Vector(_) => false,
        };
        (packed.state.len(), arithmetic.count(), packed.steps.iter().filter(is_scalar).count(), cost)
    };
    assert_eq!(
        [VIBRATING, MISSILE, STIFF_MISSILE, ELASTIC].map(&mut counts),
        [(5, 21, 9, 125), (4, 12, 6, 101), (8, 29, 28, 203), (7, 14, 49, 198)]
    );
}

/// Symmetric matrices stand by rows, with what two rows share in both.
#[test]
fn rows_of_a_symmetric_matrix() {
    let model = derived(VIBRATING, "struct Body;");
    let (packed, _) =
        Packed::cheapest(&model.dynamics.reduced.program, &model.dynamics.reduced.components()).unwrap();
    let row = |components: [usize; 3]| {
        let [a, b, c] = components.map(Some);
        [a, b, c, None]
    };
    assert_eq!(packed.state, [[0, 1, 2], [3, 4, 5], [6, 7, 8], [9, 10, 11], [10, 12, 13]].map(row));
}

/// What pays not, or has nothing to integrate, has no such program.
#[test]
fn left_out() {
    for args in [
        "dim = 2, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), potential = neo_hookean(0.5)",
        "dim = 3, kinetic(dalembert = 1)",
        "dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1)",
        "dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = q1^4 + q2^4 + q3^4",
        "dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), constraint = isochoric, potential = neo_hookean(0.5)",
    ] {
        assert!(derived(args, "struct Body;").methods.packed.is_none(), "{args}");
    }
    for args in [VIBRATING, MISSILE, STIFF_MISSILE, ELASTIC] {
        assert!(derived(args, "struct Body;").methods.packed.is_some(), "{args}");
    }
}
