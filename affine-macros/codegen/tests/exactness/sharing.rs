//! What several programs compute alike, taken out of them, leaves the exact value of every result.

use std::collections::HashMap;

use affine_codegen::algebra::Rational;
use affine_codegen::ir::Program;
use affine_codegen::ir::common::Common;
use affine_codegen::symbol::Symbol;
use affine_oracle::Random;

use super::models::derived;
use super::points::{fraction, own};

/// A sum of frames, whose mass matrix is factorised, one with other frames, and an inertia tensor with a full inverse; how many
/// of energy, equations, reduced equations and velocity share the velocity. The energy of the last is shorter in its momenta.
const MODELS: [(&str, usize); 3] = [
    ("dim = 3, kinetic(body_inertia = 1, space_inertia = diag(1, 1.5, 2))", 4),
    ("dim = 2, kinetic(dalembert = 2, casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 3)", 4),
    ("dim = 3, kinetic(casimir2 = 0.2, body_inertia = [[2, 0.5, 0.25], [0.5, 3, 0.75], [0.25, 0.75, 4]])", 3),
];

#[test]
fn what_is_shared_keeps_the_value() {
    let mut random = Random::new(97);
    for (args, sharing) in MODELS {
        let mut taken = 0;
        let model = derived(args, "struct Model;");
        let others =
            [&model.point.hamiltonian, &model.dynamics.full.program, &model.dynamics.reduced.program];
        let common = Common::of(&model.point.velocity, others).expect("much in common");
        for program in others.into_iter().chain([&model.point.velocity]) {
            let Some(rest) = common.taken_from(program) else { continue };
            let mut point: HashMap<String, Rational> =
                program.symbols().map(|symbol| (symbol.to_string(), own(&fraction(&mut random)))).collect();
            let run = |program: &Program, point: &HashMap<String, Rational>| {
                program
                    .run(&|symbol: &Symbol| point.get(&symbol.to_string()).cloned())
                    .expect("every input has a value")
            };
            let expected = run(program, &point);
            let shared = run(&common.program, &point);
            let names = common.program.results().map(Symbol::to_string);
            point.extend(names.zip(shared));
            assert_eq!(run(&rest, &point), expected, "{args}");
            assert!(rest.steps.len() < program.steps.len(), "{args}");
            taken += 1;
        }
        assert_eq!(taken, sharing, "{args}");
    }
}
