//! Random models: the text of a specification beside the oracle of the same energy.

use affine_codegen::check;
use affine_codegen::derive::{Model, derive};
use affine_codegen::diagnostics::{Rejected, gate};
use affine_codegen::mechanics::form::Form;
use affine_codegen::spec;
use affine_oracle::{Kinetic, Matrix, Random, Rational, Signature, Term, rational};

use super::points::{Values, fraction, own};

/// The internal energy of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Internal {
    /// `casimir2`, `casimir1_squared`.
    Affine,
    /// With `body_inertia`.
    Body,
    /// With `space_inertia`.
    Space,
    /// `dalembert` with a scalar, a diagonal, or a matrix.
    DalembertScalar,
    DalembertDiagonal,
    DalembertMatrix,
    /// A symmetric `n^2 x n^2` tensor.
    BodyTensor,
    SpaceTensor,
    /// A tensor beside the named terms of its frame.
    BodySum,
    SpaceSum,
    /// The Casimirs with `body_inertia` or `space_inertia` a diagonal or a matrix of any signature.
    BodyDiagonal,
    SpaceDiagonal,
    BodyMatrix,
    SpaceMatrix,
    /// `flat_tensor`, alone or beside `dalembert` with a matrix.
    FlatTensor,
    FlatSum,
}

pub(crate) const FAMILIES: [Internal; 16] = [
    Internal::Affine,
    Internal::Body,
    Internal::Space,
    Internal::DalembertScalar,
    Internal::DalembertDiagonal,
    Internal::DalembertMatrix,
    Internal::BodyTensor,
    Internal::SpaceTensor,
    Internal::BodySum,
    Internal::SpaceSum,
    Internal::BodyDiagonal,
    Internal::SpaceDiagonal,
    Internal::BodyMatrix,
    Internal::SpaceMatrix,
    Internal::FlatTensor,
    Internal::FlatSum,
];

/// The translational energy of a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Translation {
    None,
    Body,
    Space,
}

pub(crate) const TRANSLATIONS: [Translation; 3] = [Translation::None, Translation::Body, Translation::Space];

/// A model as its user writes it, and what it means.
pub(crate) struct Sample {
    pub(crate) n: usize,
    pub(crate) internal: Internal,
    pub(crate) translation: Translation,
    /// The attribute's arguments, all coefficients numbers.
    pub(crate) args: String,
    /// The terms as written.
    texts: Vec<(&'static str, String)>,
    /// The same energy, and its terms.
    pub(crate) kinetic: Kinetic,
    pub(crate) terms: Vec<Term>,
    /// `A`, `B`, `I`, `m`; zero where the family has none.
    pub(crate) a: Rational,
    pub(crate) b: Rational,
    pub(crate) i: Rational,
    pub(crate) m: Rational,
}

/// A number as a user writes it.
pub(crate) fn literal(value: &Rational) -> String {
    if value.is_integer() { format!("{value}") } else { format!("({value})") }
}

/// A nested literal matrix.
pub(crate) fn matrix_literal(matrix: &Matrix) -> String {
    let (rows, columns) = matrix.shape();
    let row = |i| (0..columns).map(|j| literal(&matrix.entry(i, j))).collect::<Vec<_>>().join(", ");
    format!("[{}]", (0..rows).map(|i| format!("[{}]", row(i))).collect::<Vec<_>>().join(", "))
}

/// `diag(...)`.
pub(crate) fn diagonal_literal(entries: &[Rational]) -> String {
    format!("diag({})", entries.iter().map(literal).collect::<Vec<_>>().join(", "))
}

/// The matrix of these diagonal entries.
pub(crate) fn diagonal_matrix(entries: &[Rational]) -> Matrix {
    let n = entries.len();
    let zero = Matrix::zeros(n, n);
    entries.iter().enumerate().fold(zero, |sum, (k, value)| &sum + &Matrix::unit(n, k, k).scaled(value))
}

/// A symmetric matrix of small fractions, with zeros now and then.
pub(crate) fn symmetric(random: &mut Random, size: usize) -> Matrix {
    let mut entries = vec![rational(0, 1); size * size];
    for i in 0..size {
        for j in 0..=i {
            let entry = if random.integer(0, 2) == 0 { rational(0, 1) } else { fraction(random) };
            entries[i * size + j] = entry.clone();
            entries[j * size + i] = entry;
        }
    }
    Matrix::from_rationals(size, size, &entries)
}

/// `G G^T + 1`.
fn positive(random: &mut Random, size: usize) -> Matrix {
    let factor: Vec<Rational> = (0..size * size).map(|_| fraction(random)).collect();
    let factor = Matrix::from_rationals(size, size, &factor);
    &(&factor * &factor.transpose()) + &Matrix::identity(size)
}

impl Sample {
    /// A regular model of the family with random coefficients.
    pub(crate) fn new(random: &mut Random, n: usize, internal: Internal, translation: Translation) -> Self {
        loop {
            let sample = Self::any(random, n, internal, translation);
            if sample.signature().zero == 0 {
                return sample;
            }
        }
    }

    fn any(random: &mut Random, n: usize, internal: Internal, translation: Translation) -> Self {
        let (mut texts, mut terms) = (Vec::new(), Vec::new());
        let mut add = |name: &'static str, value: String, term: Term| {
            texts.push((name, value));
            terms.push(term);
        };
        let zero = || rational(0, 1);
        let (mut a, mut b, mut i, mut m) = (zero(), zero(), zero(), zero());
        let named = matches!(
            internal,
            Internal::Affine
                | Internal::Body
                | Internal::Space
                | Internal::BodySum
                | Internal::SpaceSum
                | Internal::BodyDiagonal
                | Internal::SpaceDiagonal
                | Internal::BodyMatrix
                | Internal::SpaceMatrix
        );
        if named {
            (a, b) = (fraction(random), fraction(random));
            add("casimir2", literal(&a), Term::Casimir2(a.clone()));
            add("casimir1_squared", literal(&b), Term::Casimir1Squared(b.clone()));
        }
        match internal {
            Internal::Body | Internal::BodySum => {
                i = fraction(random);
                add("body_inertia", literal(&i), Term::body_inertia(n, i.clone()));
            }
            Internal::Space | Internal::SpaceSum => {
                i = fraction(random);
                add("space_inertia", literal(&i), Term::space_inertia(n, i.clone()));
            }
            Internal::DalembertScalar => {
                i = rational(random.integer(1, 9), random.integer(1, 7));
                add("dalembert", literal(&i), Term::dalembert(n, i.clone()));
            }
            Internal::DalembertDiagonal => {
                let diagonal: Vec<Rational> =
                    (0..n).map(|_| rational(random.integer(1, 9), random.integer(1, 7))).collect();
                add("dalembert", diagonal_literal(&diagonal), Term::DAlembert(diagonal_matrix(&diagonal)));
            }
            Internal::BodyDiagonal | Internal::SpaceDiagonal => {
                let diagonal: Vec<Rational> = (0..n).map(|_| fraction(random)).collect();
                let (text, j) = (diagonal_literal(&diagonal), diagonal_matrix(&diagonal));
                match internal {
                    Internal::BodyDiagonal => add("body_inertia", text, Term::BodyInertia(j)),
                    _ => add("space_inertia", text, Term::SpaceInertia(j)),
                }
            }
            Internal::BodyMatrix | Internal::SpaceMatrix => {
                let j = symmetric(random, n);
                match internal {
                    Internal::BodyMatrix => add("body_inertia", matrix_literal(&j), Term::BodyInertia(j)),
                    _ => add("space_inertia", matrix_literal(&j), Term::SpaceInertia(j)),
                }
            }
            Internal::DalembertMatrix | Internal::FlatSum => {
                let j = positive(random, n);
                add("dalembert", matrix_literal(&j), Term::DAlembert(j.clone()));
            }
            Internal::Affine | Internal::BodyTensor | Internal::SpaceTensor | Internal::FlatTensor => {}
        }
        if matches!(internal, Internal::BodyTensor | Internal::BodySum) {
            let k = symmetric(random, n * n);
            add("body_tensor", matrix_literal(&k), Term::BodyTensor(k.clone()));
        }
        if matches!(internal, Internal::SpaceTensor | Internal::SpaceSum) {
            let k = symmetric(random, n * n);
            add("space_tensor", matrix_literal(&k), Term::SpaceTensor(k.clone()));
        }
        if matches!(internal, Internal::FlatTensor | Internal::FlatSum) {
            let k = symmetric(random, n * n);
            add("flat_tensor", matrix_literal(&k), Term::FlatTensor(k.clone()));
        }
        if translation != Translation::None {
            m = rational(random.integer(1, 9), random.integer(1, 7));
            let masses = [
                Internal::DalembertScalar,
                Internal::DalembertDiagonal,
                Internal::DalembertMatrix,
                Internal::FlatSum,
            ];
            if !masses.contains(&internal) && random.integer(0, 3) == 0 {
                m = -m;
            }
        }
        match translation {
            Translation::None => {}
            Translation::Body => add("body_translation", literal(&m), Term::BodyTranslation(m.clone())),
            Translation::Space => add("space_translation", literal(&m), Term::SpaceTranslation(m.clone())),
        }
        let args = arguments(n, &texts);
        let kinetic = Kinetic::new(n, terms.clone()).unwrap();
        Self { n, internal, translation, args, texts, kinetic, terms, a, b, i, m }
    }

    /// The terms without the translation.
    pub(crate) fn internal_terms(&self) -> Vec<Term> {
        self.terms.iter().filter(|term| !is_translational(term)).cloned().collect()
    }

    /// The translation.
    pub(crate) fn translational_term(&self) -> Option<Term> {
        self.terms.iter().find(|term| is_translational(term)).cloned()
    }

    /// At `phi = 1`, and by Sylvester's law everywhere.
    pub(crate) fn signature(&self) -> Signature {
        self.kinetic.signature(&Matrix::identity(self.n)).unwrap()
    }

    /// Squares of both signs.
    pub(crate) fn is_indefinite(&self) -> bool {
        let signature = self.signature();
        signature.positive > 0 && signature.negative > 0
    }

    /// The arguments with a field for every scalar coefficient, the struct, and the values of the fields.
    pub(crate) fn with_fields(&self) -> (String, &'static str, Values) {
        let field = |name: &str, value: &String| match name {
            "casimir2" => "a".to_owned(),
            "casimir1_squared" => "b".to_owned(),
            "body_inertia" | "space_inertia" if !self.is_anisotropic() => "i".to_owned(),
            "dalembert" if self.internal == Internal::DalembertScalar => "i".to_owned(),
            "body_translation" | "space_translation" => "m".to_owned(),
            _ => value.clone(),
        };
        let texts: Vec<_> = self.texts.iter().map(|(name, value)| (*name, field(name, value))).collect();
        let values = [("a", &self.a), ("b", &self.b), ("i", &self.i), ("m", &self.m)];
        let values = values.map(|(name, value)| (format!("self.{name}"), own(value)));
        (arguments(self.n, &texts), "struct Model { a: f64, b: f64, i: f64, m: f64 }", values.into())
    }

    /// An inertia `J` that is no multiple of the identity, in an affine frame?
    pub(crate) fn is_anisotropic(&self) -> bool {
        matches!(
            self.internal,
            Internal::BodyDiagonal | Internal::SpaceDiagonal | Internal::BodyMatrix | Internal::SpaceMatrix
        )
    }

    /// The derivation.
    pub(crate) fn derived(&self) -> Model {
        derived(&self.args, "struct Model;")
    }

    /// The same internal energy without the part that `O - O^T` has of its own, as the reduced equations have it:
    /// the inverse of `I + A` on symmetric momenta is extended to all of them.
    pub(crate) fn without_skew_part(&self) -> Vec<Term> {
        vec![Term::Casimir2(&self.i + &self.a), Term::Casimir1Squared(self.b.clone())]
    }
}

fn arguments(n: usize, texts: &[(&str, String)]) -> String {
    let terms: Vec<String> = texts.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    format!("dim = {n}, kinetic({})", terms.join(", "))
}

fn is_translational(term: &Term) -> bool {
    matches!(term, Term::BodyTranslation(_) | Term::SpaceTranslation(_))
}

/// The form that the checks let through.
pub(crate) fn form(args: &str, item: &str) -> Result<Form, Rejected> {
    let spec = gate(|found| spec::parse(args.parse().unwrap(), item.parse().unwrap(), found))?;
    gate(|found| check::as_written(&spec, found))?;
    gate(|found| check::energy(&spec, found))
}

/// The derivation of an accepted model.
pub(crate) fn derived(args: &str, item: &str) -> Model {
    let form = form(args, item).unwrap_or_else(|refusal| {
        panic!("{args}: {:?}", refusal.diagnostics().map(ToString::to_string).collect::<Vec<_>>())
    });
    derive(form, false).expect("a derivation")
}
