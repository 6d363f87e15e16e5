//! A tensor that is isotropic in disguise is derived like the named terms it stands for.

use affine_codegen::derive::Model;
use affine_codegen::ir::Program;
use affine_oracle::{Matrix, Random, Rational, rational};

use super::models::{Internal, Sample, TRANSLATIONS, Translation, derived, literal, matrix_literal};

/// `I/2 tr(O O^T) + A/2 tr O^2 + B/2 (tr O)^2` as `1/2 K[nA+B][nC+D] O[A][B] O[C][D]`.
pub(crate) fn isotropic(n: usize, i: &Rational, a: &Rational, b: &Rational) -> Matrix {
    let mut k = vec![rational(0, 1); n.pow(4)];
    let mut add = |row: (usize, usize), column: (usize, usize), value: &Rational| {
        k[(n * row.0 + row.1) * n * n + n * column.0 + column.1] += value;
    };
    for p in 0..n {
        for q in 0..n {
            add((p, q), (p, q), i);
            add((p, q), (q, p), a);
            add((p, p), (q, q), b);
        }
    }
    Matrix::from_rationals(n * n, n * n, &k)
}

pub(crate) fn programs(model: &Model) -> Vec<(&'static str, &Program)> {
    let velocity_side = model.point.velocity_side.as_ref().expect("the velocity determines the momentum");
    let mut list = vec![
        ("full", &model.dynamics.full.program),
        ("reduced", &model.dynamics.reduced.program),
        ("trajectory", &model.dynamics.trajectory),
        ("legendre", &velocity_side.legendre),
        ("velocity", &model.point.velocity),
        ("kinetic energy", &velocity_side.kinetic_energy),
        ("hamiltonian", &model.point.hamiltonian),
    ];
    list.extend(model.point.isotropic.as_ref().map(|program| ("isotropic", program)));
    list
}

#[test]
fn isotropic_tensors_have_the_programs_of_their_named_terms() {
    let mut random = Random::new(91);
    for n in [2, 3] {
        for (internal, tensor) in [(Internal::Body, "body_tensor"), (Internal::Space, "space_tensor")] {
            for translation in TRANSLATIONS {
                let sample = Sample::new(&mut random, n, internal, translation);
                let mass = match translation {
                    Translation::None => String::new(),
                    Translation::Body => format!(", body_translation = {}", literal(&sample.m)),
                    Translation::Space => format!(", space_translation = {}", literal(&sample.m)),
                };
                let k = matrix_literal(&isotropic(n, &sample.i, &sample.a, &sample.b));
                let disguised =
                    derived(&format!("dim = {n}, kinetic({tensor} = {k}{mass})"), "struct Model;");
                let named = sample.derived();
                for ((name, found), (_, expected)) in programs(&disguised).into_iter().zip(programs(&named)) {
                    assert_eq!(found, expected, "{name} of {}", sample.args);
                }
                assert_eq!(programs(&disguised).len(), programs(&named).len());
                assert_eq!(disguised.dynamics.full.groups, named.dynamics.full.groups);
                assert_eq!(disguised.dynamics.reduced.groups, named.dynamics.reduced.groups);
                assert_eq!(disguised.description.conserved, named.description.conserved);
                assert_eq!(disguised.description.conserved_at_rest, named.description.conserved_at_rest);
                assert_eq!(disguised.dynamics.closed_form, named.dynamics.closed_form);
                assert_eq!(disguised.description.groups, named.description.groups);
                assert_eq!(disguised.description.signature, named.description.signature);
            }
        }
    }
}
