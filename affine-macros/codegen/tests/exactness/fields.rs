//! Models with fields: what `prepare()` computes, and the same exact motion once the fields have values.

use affine_codegen::algebra::Rational;
use affine_codegen::derive::{Model, NumericBlock};
use affine_oracle::{Kinetic, Matrix, Random, Term, rational};

use super::derivation::{check, point};
use super::models::{FAMILIES, Internal, Sample, TRANSLATIONS, derived, literal};
use super::points::{Values, exact, own, run};
use super::reduction::{equations, rest, turned};

/// The coefficients of the prepared model, numeric blocks inverted by the oracle.
pub(crate) fn prepared(model: &Model, fields: &Values) -> Values {
    let mut inputs = fields.clone();
    for NumericBlock { program, inverse, size, .. } in model.prepared.inverted() {
        let values = run(program, fields);
        let places: Vec<(usize, usize)> = (0..*size).flat_map(|i| (i..*size).map(move |j| (i, j))).collect();
        let entry = |i: usize, j: usize| {
            let k = places.iter().position(|place| *place == (i.min(j), i.max(j))).unwrap();
            exact(&values[&format!("value_{}", k + 1)])
        };
        let entries: Vec<_> = (0..size * size).map(|k| entry(k / size, k % size)).collect();
        let inverted = Matrix::from_rationals(*size, *size, &entries).eliminated_inverse().unwrap();
        for ((i, j), name) in places.iter().zip(inverse) {
            inputs.insert(name.to_string(), own(&inverted.entry(*i, *j)));
        }
    }
    run(&model.prepared.coefficients, &inputs)
}

#[test]
fn every_family_with_fields() {
    let mut random = Random::new(81);
    for n in [2, 3] {
        for internal in FAMILIES {
            // Tensors have no fields; beside named terms they make blocks that only prepare() can invert.
            let large = n == 3
                && matches!(
                    internal,
                    Internal::BodySum | Internal::SpaceSum | Internal::BodyMatrix | Internal::SpaceMatrix
                );
            for translation in TRANSLATIONS {
                let sample = Sample::new(&mut random, n, internal, translation);
                let (args, item, fields) = sample.with_fields();
                let model = derived(&args, item);
                let coefficients = prepared(&model, &fields);
                let rest = rest(&sample, &model.dynamics.reduction);
                for _ in 0..if large { 1 } else { 2 } {
                    let mut state = point(&mut random, &sample.kinetic);
                    check(&args, &model, &sample.kinetic, &state, &coefficients);
                    if model.dynamics.reduction.turn.is_some() {
                        state = turned(state);
                    }
                    if !rest.has_translation() {
                        state = state.at_rest();
                    }
                    equations(&args, &model, &rest, &state, &coefficients);
                }
                if !large {
                    let numeric = sample.derived();
                    assert_eq!(model.description.conserved, numeric.description.conserved, "{args}");
                    assert_eq!(
                        model.description.conserved_at_rest, numeric.description.conserved_at_rest,
                        "{args}"
                    );
                    assert_eq!(model.dynamics.reduced.groups, numeric.dynamics.reduced.groups, "{args}");
                }
            }
        }
    }
}

/// An inertia with fields, whose inverse only numbers can give.
#[test]
fn inertia_with_fields() {
    let mut random = Random::new(82);
    let j = [[4, 1, 2], [1, 3, 0], [2, 0, 5]];
    for n in [2, 3] {
        let text = match n {
            2 => "[[4*i, a], [a, 3]]",
            _ => "[[4*i, a, 2], [a, 3, 0], [2, 0, 5*i]]",
        };
        let entries: Vec<_> = (0..n * n).map(|k| rational(j[k / n][k % n], 1)).collect();
        let j = Matrix::from_rationals(n, n, &entries);
        let args = format!("dim = {n}, kinetic(dalembert = {text}, space_translation = m)");
        let model = derived(&args, "struct Model { i: f64, a: f64, m: f64 }");
        let positive: Vec<bool> = model.prepared.inverted().map(|block| block.positive).collect();
        assert_eq!(positive, [true], "one block for all rows");
        let terms = vec![Term::DAlembert(j), Term::SpaceTranslation(rational(2, 3))];
        let kinetic = Kinetic::new(n, terms).unwrap();
        let fields = [("self.i", rational(1, 1)), ("self.a", rational(1, 1)), ("self.m", rational(2, 3))];
        let fields: Values = fields.map(|(name, value)| (name.to_owned(), own(&value))).into();
        let coefficients = prepared(&model, &fields);
        let state = point(&mut random, &kinetic);
        check(&args, &model, &kinetic, &state, &coefficients);
    }
}

/// What must not vanish: the three eigenvalues and the mass, each with the summands that set the threshold.
#[test]
fn conditions_of_prepare() {
    let mut random = Random::new(83);
    for n in [2_usize, 3] {
        for internal in [Internal::Affine, Internal::Body, Internal::Space, Internal::DalembertScalar] {
            for translation in TRANSLATIONS {
                let sample = Sample::new(&mut random, n, internal, translation);
                let (args, item, fields) = sample.with_fields();
                let model = derived(&args, item);
                let count = rational(i64::try_from(n).unwrap(), 1);
                let (i, a, b) = (&sample.i, &sample.a, &sample.b);
                let mut expected = match internal {
                    Internal::DalembertScalar => vec![("J", i.clone())],
                    _ => vec![("I + A", i + a), ("I - A", i - a), ("I + A + n B", i + a + count * b)],
                };
                if model.point.mass.is_some() {
                    expected.push(("m", sample.m.clone()));
                }
                let mut found: Vec<(&str, _)> = Vec::new();
                for condition in model.prepared.conditions() {
                    let values = run(&condition.program, &fields);
                    let sizes = values.iter().filter(|(name, _)| *name != "value_1");
                    let sum = sizes.fold(Rational::ZERO, |sum, (_, value)| &sum + value);
                    assert_eq!(sum, values["value_1"], "the value is the sum of its summands");
                    assert_eq!(condition.positive, internal == Internal::DalembertScalar);
                    found.push((condition.factor.name(), exact(&values["value_1"])));
                }
                found.sort();
                expected.sort();
                assert_eq!(found, expected, "{args}");
            }
        }
    }
}

/// A coefficient that is an expression in fields and `n` means what the same expression means in numbers.
#[test]
fn expressions_in_fields() {
    let mut random = Random::new(84);
    for n in [2_usize, 3] {
        let count = rational(i64::try_from(n).unwrap(), 1);
        let (a, i) = (rational(2, 7), rational(5, 3));
        let inertia = (&i * &i + rational(1, 2)) / (&a + rational(1, 1));
        let casimir = -&a * &count - rational(1, 10);
        let args = format!("dim = {n}, kinetic(body_inertia = (i^2 + 0.5)/(a + 1), casimir2 = -a*n - 1e-1)");
        let model = derived(&args, "struct Model { a: f64, i: f64 }");
        let terms = vec![Term::body_inertia(n, inertia.clone()), Term::Casimir2(casimir.clone())];
        let kinetic = Kinetic::new(n, terms).unwrap();
        let fields: Values = [("self.a".to_owned(), own(&a)), ("self.i".to_owned(), own(&i))].into();
        let state = point(&mut random, &kinetic);
        check(&args, &model, &kinetic, &state, &prepared(&model, &fields));
        let text = format!("body_inertia = {}, casimir2 = {}", literal(&inertia), literal(&casimir));
        let numeric = derived(&format!("dim = {n}, kinetic({text})"), "struct Model;");
        check(&text, &numeric, &kinetic, &state, &Values::new());
    }
}
