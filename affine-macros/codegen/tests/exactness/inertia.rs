//! Inertias `J` in the affine frames against the formulas of (4.17) in an eigenbasis of `J`, and forms that can be
//! written in two ways.

use affine_codegen::derive::{Condition, Model};
use affine_codegen::diagnostics::{Diagnostic, FormMistake};
use affine_oracle::{Matrix, Random, Rational, rational};
use num_traits::{Signed, Zero};

use super::fields::prepared;
use super::models::{
    Internal, Sample, Translation, derived, diagonal_literal, diagonal_matrix, form, literal, matrix_literal,
    symmetric,
};
use super::points::{Values, exact, fraction, own, put, run};
use super::tensors::programs;

/// `1/2 tr(O J O^T) + A/2 tr O^2 + B/2 (tr O)^2` with `J = diag j`.
struct Anisotropic {
    j: Vec<Rational>,
    a: Rational,
    b: Rational,
}

impl Anisotropic {
    fn random(random: &mut Random, n: usize) -> Self {
        loop {
            let j = (0..n).map(|_| fraction(random)).collect();
            let energy = Anisotropic { j, a: fraction(random), b: fraction(random) };
            if !energy.determinant().is_zero() && energy.diagonal().iter().all(|d| !d.is_zero()) {
                return energy;
            }
        }
    }

    /// `j_a + A`.
    fn diagonal(&self) -> Vec<Rational> {
        self.j.iter().map(|j| j + &self.a).collect()
    }

    /// `j_a j_b - A^2`, a < b.
    fn pairs(&self) -> Vec<Rational> {
        let n = self.j.len();
        let pairs = (0..n).flat_map(|a| (a + 1..n).map(move |b| (a, b)));
        pairs.map(|(a, b)| &self.j[a] * &self.j[b] - &self.a * &self.a).collect()
    }

    /// `prod_{a<b} (j_a j_b - A^2) (prod_a (j_a + A) + B sum_a prod_{b != a} (j_b + A))`.
    fn determinant(&self) -> Rational {
        let d = self.diagonal();
        let product = |without: Option<usize>| {
            let factors = d.iter().enumerate().filter(|(k, _)| Some(*k) != without);
            factors.fold(rational(1, 1), |product, (_, factor)| product * factor)
        };
        let sum = (0..d.len()).fold(rational(0, 1), |sum, a| sum + product(Some(a)));
        self.pairs().into_iter().fold(product(None) + &self.b * sum, |product, pair| product * pair)
    }

    /// `j_a j_b > A^2`, and `diag(j + A) + B 1 1^T > 0`; no `j_a + A` is zero.
    fn is_definite(&self) -> bool {
        let d = self.diagonal();
        let negative = d.iter().filter(|d| d.is_negative()).count();
        let schur = d.iter().fold(rational(1, 1), |sum, d| sum + &self.b / d);
        let trace = match negative {
            0 => schur.is_positive(),
            1 => self.b.is_positive() && schur.is_negative(),
            _ => false,
        };
        trace && self.pairs().iter().all(Rational::is_positive)
    }

    /// `O_ab = (j_a X_ba - A X_ab)/(j_a j_b - A^2)` off the diagonal, `O_aa = (X_aa - B t)/(j_a + A)` on it, with
    /// `t = tr O = (sum of X_aa/(j_a + A))/(1 + B sum of 1/(j_a + A))`.
    fn velocity(&self, x: &Matrix) -> Matrix {
        let (n, d) = (self.j.len(), self.diagonal());
        let sum = |of: &dyn Fn(usize) -> Rational| (0..n).fold(rational(0, 1), |sum, a| sum + of(a));
        let trace = sum(&|a| x.entry(a, a) / &d[a]) / (rational(1, 1) + &self.b * sum(&|a| d[a].recip()));
        let entry = |a: usize, b: usize| match a == b {
            true => (x.entry(a, a) - &self.b * &trace) / &d[a],
            false => {
                (&self.j[a] * x.entry(b, a) - &self.a * x.entry(a, b))
                    / (&self.j[a] * &self.j[b] - &self.a * &self.a)
            }
        };
        let entries: Vec<Rational> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        Matrix::from_rationals(n, n, &entries)
    }

    fn args(&self, key: &str) -> String {
        format!(
            "dim = {}, kinetic({key} = {}, casimir2 = {}, casimir1_squared = {})",
            self.j.len(),
            diagonal_literal(&self.j),
            literal(&self.a),
            literal(&self.b)
        )
    }
}

/// `O(X)` and `H = 1/2 tr(X O)` at a random `X`.
fn inverts(random: &mut Random, energy: &Anisotropic, model: &Model, coefficients: &Values) {
    let n = energy.j.len();
    let x = random.matrix(n, n);
    let o = energy.velocity(&x);
    let (velocity, spin) = (model.frame.velocity().stem(), model.frame.momentum().stem());
    let (mut inputs, mut expected) = (coefficients.clone(), Values::new());
    put(&mut inputs, spin, &x);
    put(&mut expected, velocity, &o);
    assert_eq!(run(&model.point.velocity, &inputs), expected);
    let energy = (&x * &o).trace().scaled(&rational(1, 2)).entry(0, 0);
    assert_eq!(exact(&run(&model.point.hamiltonian, &inputs)["energy"]), energy);
}

#[test]
fn velocities_of_diagonal_inertias() {
    let mut random = Random::new(111);
    for n in [2, 3] {
        for key in ["body_inertia", "space_inertia"] {
            for _ in 0..4 {
                let energy = Anisotropic::random(&mut random, n);
                let model = derived(&energy.args(key), "struct Model;");
                assert_eq!(model.prepared.inverted().count(), 0);
                inverts(&mut random, &energy, &model, &Values::new());
            }
        }
    }
}

/// With fields: one block for each pair `O_ab, O_ba` and one for the diagonal.
#[test]
fn velocities_of_diagonal_inertias_with_fields() {
    let mut random = Random::new(112);
    for n in [2, 3] {
        for key in ["body_inertia", "space_inertia"] {
            let energy = Anisotropic::random(&mut random, n);
            let inertia = if n == 2 { "diag(j1, j2)" } else { "diag(j1, j2, j3)" };
            let args = format!("dim = {n}, kinetic({key} = {inertia}, casimir2 = a, casimir1_squared = b)");
            let model = derived(&args, "struct Model { j1: f64, j2: f64, j3: f64, a: f64, b: f64 }");
            let mut sizes: Vec<usize> = model.prepared.inverted().map(|block| block.size).collect();
            sizes.sort_unstable();
            assert_eq!(sizes, if n == 2 { vec![2, 2] } else { vec![2, 2, 2, 3] });
            assert!(model.prepared.inverted().all(|block| !block.positive));
            let mut fields: Values =
                [("self.a".to_owned(), own(&energy.a)), ("self.b".to_owned(), own(&energy.b))].into();
            let inertias = energy.j.iter().enumerate();
            fields.extend(inertias.map(|(k, j)| (format!("self.j{}", k + 1), own(j))));
            inverts(&mut random, &energy, &model, &prepared(&model, &fields));
        }
    }
}

/// The determinant of the Hessian decides what is refused, the conditions of (4.17) what is positive definite.
#[test]
fn determinants_and_signs() {
    let mut random = Random::new(113);
    let (mut degenerate, mut definite) = (0, 0);
    for n in [2, 3] {
        for k in 0..150 {
            let small = |random: &mut Random, low| rational(random.integer(low, 3), 1);
            let low = if k % 2 == 0 { -2 } else { 1 };
            let j: Vec<Rational> = (0..n).map(|_| small(&mut random, low)).collect();
            let b = small(&mut random, -2);
            let energy = Anisotropic { j, a: rational(random.integer(-2, 2), 2), b };
            let key = ["body_inertia", "space_inertia"][k / 2 % 2];
            let args = energy.args(key);
            let form = form(&args, "struct Model;");
            let determinant = energy.determinant();
            match &form {
                Ok(form) => {
                    let hessian = form.mass.constant().unwrap().matrix.concat();
                    let entries: Vec<Rational> =
                        hessian.iter().map(|entry| exact(&entry.as_constant().unwrap())).collect();
                    let hessian = Matrix::from_rationals(n * n, n * n, &entries);
                    assert_eq!(hessian.determinant(), determinant, "{args}");
                    assert!(!determinant.is_zero());
                }
                Err(refusal) => {
                    degenerate += 1;
                    assert_eq!(determinant, rational(0, 1), "{args}");
                    let refused = |d: &Diagnostic| {
                        matches!(
                            d,
                            Diagnostic::Form(
                                FormMistake::DegenerateTensor { .. } | FormMistake::NoKineticEnergy
                            )
                        )
                    };
                    assert!(refusal.diagnostics().all(refused), "{args}");
                }
            }
            if form.is_ok() && energy.diagonal().iter().all(|d| !d.is_zero()) {
                let required =
                    super::models::form(&format!("require(positive_definite), {args}"), "struct Model;");
                assert_eq!(required.is_ok(), energy.is_definite(), "{args}");
                definite += usize::from(energy.is_definite());
            }
        }
    }
    assert!(degenerate >= 10 && definite >= 10, "{degenerate} degenerate, {definite} definite");
}

/// The tensor `K[(A,B),(C,D)] = delta_AC J_BD` of `tr(O J O^T)`.
fn as_tensor(j: &Matrix) -> Matrix {
    let n = j.shape().0;
    let entry = |r: usize, s: usize| match r / n == s / n {
        true => j.entry(r % n, s % n),
        false => rational(0, 1),
    };
    let size = n * n;
    let entries: Vec<Rational> = (0..size * size).map(|k| entry(k / size, k % size)).collect();
    Matrix::from_rationals(size, size, &entries)
}

fn same_programs(one: &str, other: &str) {
    let [first, second] = same_motions(one, other);
    assert_eq!(first.description.groups, second.description.groups, "{one}");
}

/// The same but for what the energies are invariant under, which is said of them without their constraint.
fn same_motions(one: &str, other: &str) -> [Model; 2] {
    let (first, second) = (derived(one, "struct Model;"), derived(other, "struct Model;"));
    for ((name, found), (_, expected)) in programs(&first).into_iter().zip(programs(&second)) {
        assert_eq!(found, expected, "{name} of {one}");
    }
    assert_eq!(programs(&first).len(), programs(&second).len());
    assert_eq!(first.description.conserved, second.description.conserved, "{one}");
    assert_eq!(first.dynamics.closed_form, second.dynamics.closed_form, "{one}");
    assert_eq!(first.description.signature, second.description.signature, "{one}");
    [first, second]
}

/// An inertia has the programs of its tensor, in every frame; a multiple of the identity those of its factor.
#[test]
fn inertias_have_the_programs_of_their_tensors() {
    let mut random = Random::new(114);
    for n in [2, 3] {
        for (inertia, tensor, internal) in [
            ("body_inertia", "body_tensor", Internal::BodyMatrix),
            ("space_inertia", "space_tensor", Internal::SpaceMatrix),
            ("dalembert", "flat_tensor", Internal::DalembertMatrix),
        ] {
            for mass in ["", ", body_translation = 2", ", space_translation = 2"] {
                // Definite, as `dalembert` asks for.
                let j = &symmetric(&mut random, n) + &Matrix::identity(n).scaled(&rational(40, 1));
                let k = as_tensor(&j);
                let args = |term: &str, value: &Matrix| {
                    format!("dim = {n}, kinetic({term} = {}{mass})", matrix_literal(value))
                };
                same_programs(&args(inertia, &j), &args(tensor, &k));
                let i = fraction(&mut random).abs();
                let multiple = diagonal_matrix(&vec![i.clone(); n]);
                let scalar = format!("dim = {n}, kinetic({inertia} = {}{mass})", literal(&i));
                same_programs(&args(inertia, &multiple), &scalar);
            }
            let sample = Sample::new(&mut random, n, internal, Translation::None);
            assert_eq!(
                sample.derived().prepared.inverted().count(),
                0,
                "numbers are inverted when the model is compiled"
            );
        }
    }
}

/// With `phi` a rotation `tr(phi_dot J phi_dot^T)` is `tr(Oh J Oh^T)`: of a disc, too, whose `J` is singular and whose
/// `tr J - J` is not.
#[test]
fn masses_of_a_rigid_body_are_its_inertia() {
    let mut random = Random::new(116);
    for n in [2, 3] {
        let disc = diagonal_matrix(&(0..n).map(|k| rational(i64::from(k < 2), 1)).collect::<Vec<_>>());
        for j in [disc, symmetric(&mut random, n), diagonal_matrix(&vec![rational(2, 1); n])] {
            for mass in ["", ", body_translation = 2", ", space_translation = -2"] {
                let args = |term: &str, value: &str| {
                    format!("dim = {n}, constraint = rigid, kinetic({term} = {value}{mass})")
                };
                let value = matrix_literal(&j);
                same_motions(&args("dalembert", &value), &args("body_inertia", &value));
                same_motions(&args("dalembert", "3"), &args("body_inertia", "3"));
            }
        }
    }
}

/// And `prepare()` asks the same of both.
#[test]
fn fields_of_a_rigid_body_are_asked_the_same() {
    let asked = |term: &str, value: &str| {
        let args = format!("dim = 3, constraint = rigid, kinetic({term} = {value}, space_translation = m)");
        let model = derived(&args, "struct Model { a: f64, b: f64, c: f64, m: f64 }");
        let asked = |condition: &Condition| (condition.factor, condition.positive, condition.program.clone());
        let conditions: Vec<_> = model.prepared.conditions().map(asked).collect();
        let blocks: Vec<_> =
            model.prepared.inverted().map(|block| (block.positive, block.program.clone())).collect();
        assert!(conditions.iter().all(|(_, positive, _)| !positive), "{args}");
        (conditions, blocks)
    };
    for value in ["a", "diag(a, b, c)", "diag(a, b, 0)", "[[a, b, 0], [b, a, 0], [0, 0, c]]"] {
        assert_eq!(asked("dalembert", value), asked("body_inertia", value), "{value}");
    }
}

/// Straight geodesics without positivity: an indefinite tensor over `phi_dot` is no energy of masses.
#[test]
fn flat_tensors_may_be_indefinite() {
    let mut random = Random::new(115);
    let mut indefinite = 0;
    for n in [2, 3] {
        for (internal, translation) in [
            (Internal::FlatTensor, Translation::None),
            (Internal::FlatTensor, Translation::Space),
            (Internal::FlatSum, Translation::Space),
        ] {
            let sample = Sample::new(&mut random, n, internal, translation);
            let (args, item, _) = sample.with_fields();
            let model = derived(&args, item);
            indefinite += usize::from(sample.is_indefinite());
            // The mass is that of the masses of `dalembert`.
            let positive = internal == Internal::FlatSum;
            assert!(model.prepared.conditions().all(|condition| condition.positive == positive), "{args}");
        }
    }
    assert!(indefinite >= 3);
}

/// `J` beside a flat tensor is positive by its leading minors, although the sum need not be.
#[test]
fn masses_beside_a_flat_tensor() {
    let tensor = "flat_tensor = [[-9, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]";
    let model = derived(
        &format!("dim = 2, kinetic({tensor}, dalembert = [[i, a], [a, 3]])"),
        "struct Model { i: f64, a: f64 }",
    );
    assert!(model.prepared.inverted().all(|block| !block.positive));
    let minors: Vec<_> = model.prepared.conditions().filter(|condition| condition.positive).collect();
    let fields: Values =
        [("self.i".to_owned(), own(&rational(5, 1))), ("self.a".to_owned(), own(&rational(2, 1)))].into();
    let values: Vec<Rational> =
        minors.iter().map(|condition| exact(&run(&condition.program, &fields)["value_1"])).collect();
    assert_eq!(values, [rational(5, 1), rational(11, 1)]);
    assert_eq!(model.description.signature, None);
}
