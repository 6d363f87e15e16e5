//! Every family of models, n = 2 and 3, with its energy stated a second time for the oracle.

use affine_oracle::{
    Isotropic, Kinetic, Matrix as Exact, Random, Rational, State, Term, exact, rational, rounded,
};
use affine_runtime::prelude::*;

pub(crate) use affine_tests::charts::{matrix, vector};

/// Values of all fields that the models have between them.
pub(crate) struct Parameters {
    n: usize,
    isotropic: Isotropic,
    /// Symmetric and positive definite.
    j: Exact,
    /// Symmetric, of any signature, no two diagonal entries equal.
    h: Exact,
    /// A tensor of order 1, regular beside `casimir2 = small`.
    k: Exact,
    /// `T` given by a tensor of order 1 stays regular with this much of `casimir2`.
    small: Rational,
}

impl Parameters {
    /// Condition of the isotropic form up to 1e4, of `J` up to 1e3; scales 1e-3 to 1e3; half of the isotropic
    /// forms indefinite.
    pub(crate) fn random(n: usize, random: &mut Random) -> Self {
        let isotropic = random.isotropic(n);
        // S J S with S = diag(1 .. 8): symmetric and definite as J is.
        let stretch = (0..n).fold(Exact::zeros(n, n), |sum, a| {
            &sum + &Exact::unit(n, a, a).scaled(&rational(1 << random.integer(0, 3), 1))
        });
        let scale = rational(1 << random.integer(0, 7), 1 << random.integer(0, 13));
        let j = (&(&stretch * &random.inertia(n)) * &stretch).scaled(&scale);
        let small = rational(random.integer(4, 12) * (1 - 2 * random.integer(0, 1)), 32);
        let h = indefinite(n, &isotropic, random);
        let k = random_tensor(n, &small, random);
        Parameters { n, isotropic, j, h, k, small }
    }

    /// Is `I/2 tr(O^T O) + A/2 tr O^2 + B/2 (tr O)^2` indefinite?
    pub(crate) fn is_indefinite(&self) -> bool {
        self.isotropic.is_indefinite(self.n)
    }

    /// The least and the largest of |I+A|, |I-A|, |I+A+nB|, |m|.
    pub(crate) fn extremes(&self) -> [f64; 2] {
        let eigenvalues = self.isotropic.eigenvalues(self.n);
        let sizes = eigenvalues.iter().chain([&self.isotropic.m]).map(|value| rounded(value).abs());
        sizes.fold([f64::INFINITY, 0.0], |[least, largest], size| [least.min(size), largest.max(size)])
    }

    /// The value of a field of the models.
    pub(crate) fn field(&self, name: &str) -> f64 {
        let Isotropic { i, a, b, m } = &self.isotropic;
        let value = match name {
            "i" => i.clone(),
            "a" => a.clone(),
            "b" => b.clone(),
            "m" => m.clone(),
            "alpha" => i + a,
            "mass" => {
                if *m < rational(0, 1) {
                    -m
                } else {
                    m.clone()
                }
            }
            "small" => self.small.clone(),
            "j13" | "j23" | "j33" | "h13" | "h23" | "h33" if self.n == 2 => rational(0, 1),
            entry => {
                let place = |k: usize| usize::from(entry.as_bytes()[k] - b'1');
                let inertia = if entry.starts_with('h') { &self.h } else { &self.j };
                inertia.entry(place(1), place(2))
            }
        };
        let field = rounded(&value);
        assert_eq!(exact(field), Some(value), "{name} is an f64");
        field
    }

    fn rational(&self, name: &str) -> Rational {
        exact(self.field(name)).unwrap()
    }
}

/// An inertia for an affine frame: the form with `casimir2 = a`, `casimir1_squared = b` has a condition below 1e3, with
/// its diagonal as well as with all of it.
fn indefinite(n: usize, isotropic: &Isotropic, random: &mut Random) -> Exact {
    loop {
        let mut h = Exact::zeros(n, n);
        for (a, size) in (0..n).zip([4, 7, 10]) {
            let sign = 1 - 2 * random.integer(0, 1);
            let entry = rational(sign * (size + random.integer(0, 2)), 4);
            h = &h + &Exact::unit(n, a, a).scaled(&entry);
            for b in 0..a {
                let both = &Exact::unit(n, a, b) + &Exact::unit(n, b, a);
                h = &h + &both.scaled(&rational(random.integer(1, 4), 4));
            }
        }
        let h = h.scaled(&(&isotropic.i + &isotropic.a));
        let condition = |j: Exact| {
            let casimirs = [Term::Casimir2(isotropic.a.clone()), Term::Casimir1Squared(isotropic.b.clone())];
            let form = Kinetic::new(n, [vec![Term::BodyInertia(j)], casimirs.to_vec()].concat()).unwrap();
            form.condition(&Exact::identity(n)).unwrap()
        };
        if condition(diagonal(&h)) < 1e3 && condition(h.clone()) < 1e3 {
            return h;
        }
    }
}

/// A tensor `K`, of any signature, for which `K` and `casimir2 = small` together have a condition below 1e3. It draws
/// from a source of its own.
fn random_tensor(n: usize, small: &Rational, random: &Random) -> Exact {
    let mut random = random.clone();
    loop {
        let k = random.tensor(n);
        let terms = vec![Term::BodyTensor(k.clone()), Term::Casimir2(small.clone())];
        if Kinetic::new(n, terms)
            .unwrap()
            .condition(&Exact::identity(n))
            .is_ok_and(|condition| condition < 1e3)
        {
            return k;
        }
    }
}

/// The rows of a matrix.
pub(crate) fn rows<const N: usize>(matrix: &Exact) -> [[f64; N]; N] {
    let entries = matrix.to_f64();
    core::array::from_fn(|i| core::array::from_fn(|j| entries[N * i + j]))
}

/// The diagonal of a matrix, as a matrix.
fn diagonal(j: &Exact) -> Exact {
    let n = j.shape().0;
    (0..n).fold(Exact::zeros(n, n), |sum, a| &sum + &Exact::unit(n, a, a).scaled(&j.entry(a, a)))
}

/// The oracle's term of each name.
macro_rules! terms {
    ($($name:ident = |$n:ident, $p:ident| $term:expr;)*) => {
        impl Parameters {
            $(fn $name(&self) -> Term {
                let ($n, $p) = (self.n, self);
                $term
            })*
        }
    };
}

terms! {
    body_inertia = |n, p| Term::body_inertia(n, p.rational("i"));
    space_inertia = |n, p| Term::space_inertia(n, p.rational("i"));
    casimir2 = |_n, p| Term::Casimir2(p.rational("a"));
    casimir2_alone = |_n, p| Term::Casimir2(p.rational("alpha"));
    casimir2_small = |_n, p| Term::Casimir2(p.rational("small"));
    casimir1_squared = |_n, p| Term::Casimir1Squared(p.rational("b"));
    body_translation = |_n, p| Term::BodyTranslation(p.rational("m"));
    space_translation = |_n, p| Term::SpaceTranslation(p.rational("m"));
    body_translation_of_masses = |_n, p| Term::BodyTranslation(p.rational("mass"));
    space_translation_of_masses = |_n, p| Term::SpaceTranslation(p.rational("mass"));
    dalembert_scalar = |n, p| Term::dalembert(n, p.rational("j11"));
    dalembert_diagonal = |_n, p| Term::DAlembert(diagonal(&p.j));
    dalembert_matrix = |_n, p| Term::DAlembert(p.j.clone());
    body_tensor = |n, _p| Term::BodyTensor(tensor(n));
    space_tensor = |n, _p| Term::SpaceTensor(tensor(n));
    flat_tensor = |n, _p| Term::FlatTensor(tensor(n));
    body_tensor_field = |_n, p| Term::BodyTensor(p.k.clone());
    space_tensor_field = |_n, p| Term::SpaceTensor(p.k.clone());
    flat_tensor_field = |_n, p| Term::FlatTensor(p.k.clone());
    dalembert_small = |n, p| Term::dalembert(n, p.rational("small") * p.rational("small"));
    body_inertia_diagonal = |_n, p| Term::BodyInertia(diagonal(&p.h));
    body_inertia_matrix = |_n, p| Term::BodyInertia(p.h.clone());
    space_inertia_diagonal = |_n, p| Term::SpaceInertia(diagonal(&p.h));
    space_inertia_matrix = |_n, p| Term::SpaceInertia(p.h.clone());
}

/// When motions are geodesics in closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Closed {
    Always,
    AtRest,
    Never,
}

/// A generated model with random parameters, and the same energy for the oracle.
pub(crate) trait Family<const N: usize>: Model<N> + Sized {
    /// Does the model have `x` and `p`?
    const TRANSLATION: bool;
    /// When there must be a closed form.
    const CLOSED: Closed;

    /// The prepared model and its energy.
    fn with(parameters: &Parameters) -> (Self, Kinetic);
    /// The phase point at an exact state.
    fn at(&self, state: &State) -> Self::Point<f64>;
    /// The phase point with a velocity.
    fn at_velocity(&self, x: Vector<N>, phi: Matrix<N>, velocity: &Velocity<N>) -> Self::Point<f64>;

    /// A random state of this model; `x = p = 0` without translation.
    fn random_state(random: &mut Random) -> State {
        let state = random.state(N);
        if Self::TRANSLATION { state } else { State { x: Exact::zeros(N, 1), ..state.at_rest() } }
    }
}

pub(crate) use affine_runtime::model::Velocity;

/// Symmetric, of both signs, no symmetry beyond: every |eigenvalue| is above 1/2 (Gershgorin).
macro_rules! with_tensor {
    (2 $callback:ident $($rest:tt)*) => { $callback! { 2 [
        [2.0, 0.5, -0.25, 0.5],
        [0.5, -3.0, 0.75, 0.0],
        [-0.25, 0.75, 1.75, 0.125],
        [0.5, 0.0, 0.125, 4.0],
    ] $($rest)* } };
    (3 $callback:ident $($rest:tt)*) => { $callback! { 3 [
        [2.0, 0.25, 0.0, -0.125, 0.0, 0.5, 0.0, 0.0, 0.25],
        [0.25, 1.5, 0.125, 0.0, 0.25, 0.0, 0.0, -0.25, 0.0],
        [0.0, 0.125, -1.75, 0.25, 0.0, 0.0, 0.5, 0.0, 0.125],
        [-0.125, 0.0, 0.25, 2.5, 0.125, 0.0, 0.0, 0.75, 0.0],
        [0.0, 0.25, 0.0, 0.125, 3.0, -0.5, 0.25, 0.0, 0.5],
        [0.5, 0.0, 0.0, 0.0, -0.5, -2.25, 0.125, 0.25, 0.0],
        [0.0, 0.0, 0.5, 0.0, 0.25, 0.125, 1.75, 0.0, -0.25],
        [0.0, -0.25, 0.0, 0.75, 0.0, 0.25, 0.0, 2.0, 0.125],
        [0.25, 0.0, 0.125, 0.0, 0.5, 0.0, -0.25, 0.125, 2.25],
    ] $($rest)* } };
}

macro_rules! exact_tensor {
    ($n:literal $k:tt) => {{
        let rows: [[f64; $n * $n]; $n * $n] = $k;
        Exact::from_f64("K", $n * $n, $n * $n, rows.as_flattened()).unwrap()
    }};
}

fn tensor(n: usize) -> Exact {
    if n == 2 { with_tensor!(2 exact_tensor) } else { with_tensor!(3 exact_tensor) }
}

/// Calls `$callback! { $arguments rows }` with one row per family: centre, closed form, energy for the oracle, and
/// the energy as a user states it, for n = 2 | n = 3 where they differ.
macro_rules! families {
    ($callback:ident $($arguments:tt)*) => { $callback! { $($arguments)*
left: pinned Always [body_inertia casimir2 casimir1_squared]
    (body_inertia = i, casimir2 = a, casimir1_squared = b);
left_body_translation: moving AtRest [body_inertia casimir2 casimir1_squared body_translation]
    (body_inertia = i, casimir2 = a, casimir1_squared = b, body_translation = m);
left_space_translation: moving Always [body_inertia casimir2 casimir1_squared space_translation]
    (body_inertia = i, casimir2 = a, casimir1_squared = b, space_translation = m);
right: pinned Always [space_inertia casimir2 casimir1_squared]
    (space_inertia = i, casimir2 = a, casimir1_squared = b);
right_space_translation: moving Always [space_inertia casimir2 casimir1_squared space_translation]
    (space_inertia = i, casimir2 = a, casimir1_squared = b, space_translation = m);
right_body_translation: moving AtRest [space_inertia casimir2 casimir1_squared body_translation]
    (space_inertia = i, casimir2 = a, casimir1_squared = b, body_translation = m);
affine_affine: pinned Always [casimir2_alone casimir1_squared]
    (casimir2 = alpha, casimir1_squared = b);
affine_affine_body_translation: moving AtRest [casimir2_alone casimir1_squared body_translation]
    (casimir2 = alpha, casimir1_squared = b, body_translation = m);
affine_affine_space_translation: moving Always [casimir2_alone casimir1_squared space_translation]
    (casimir2 = alpha, casimir1_squared = b, space_translation = m);
dalembert_scalar: pinned Always [dalembert_scalar]
    (dalembert = j11);
dalembert_scalar_space_translation: moving Always [dalembert_scalar space_translation_of_masses]
    (dalembert = j11, space_translation = mass);
dalembert_scalar_body_translation: moving AtRest [dalembert_scalar body_translation_of_masses]
    (dalembert = j11, body_translation = mass);
dalembert_diagonal: pinned Always [dalembert_diagonal]
    (dalembert = diag(j11, j22))
    | (dalembert = diag(j11, j22, j33));
dalembert_diagonal_space_translation: moving Always [dalembert_diagonal space_translation_of_masses]
    (dalembert = diag(j11, j22), space_translation = mass)
    | (dalembert = diag(j11, j22, j33), space_translation = mass);
dalembert_diagonal_body_translation: moving AtRest [dalembert_diagonal body_translation_of_masses]
    (dalembert = diag(j11, j22), body_translation = mass)
    | (dalembert = diag(j11, j22, j33), body_translation = mass);
dalembert_matrix: pinned Always [dalembert_matrix]
    (dalembert = [[j11, j12], [j12, j22]])
    | (dalembert = [[j11, j12, j13], [j12, j22, j23], [j13, j23, j33]]);
dalembert_matrix_space_translation: moving Always [dalembert_matrix space_translation_of_masses]
    (dalembert = [[j11, j12], [j12, j22]], space_translation = mass)
    | (dalembert = [[j11, j12, j13], [j12, j22, j23], [j13, j23, j33]], space_translation = mass);
dalembert_matrix_body_translation: moving AtRest [dalembert_matrix body_translation_of_masses]
    (dalembert = [[j11, j12], [j12, j22]], body_translation = mass)
    | (dalembert = [[j11, j12, j13], [j12, j22, j23], [j13, j23, j33]], body_translation = mass);
body_tensor: pinned Never [body_tensor casimir2_small]
    (body_tensor = K, casimir2 = small);
body_tensor_body_translation: moving Never [body_tensor casimir2_small body_translation]
    (body_tensor = K, casimir2 = small, body_translation = m);
body_tensor_space_translation: moving Never [body_tensor casimir2_small space_translation]
    (body_tensor = K, casimir2 = small, space_translation = m);
space_tensor: pinned Never [space_tensor casimir2_small]
    (space_tensor = K, casimir2 = small);
space_tensor_body_translation: moving Never [space_tensor casimir2_small body_translation]
    (space_tensor = K, casimir2 = small, body_translation = m);
space_tensor_space_translation: moving Never [space_tensor casimir2_small space_translation]
    (space_tensor = K, casimir2 = small, space_translation = m);
body_inertia_diagonal: pinned Never [body_inertia_diagonal casimir2 casimir1_squared]
    (body_inertia = diag(h11, h22), casimir2 = a, casimir1_squared = b)
    | (body_inertia = diag(h11, h22, h33), casimir2 = a, casimir1_squared = b);
body_inertia_diagonal_body_translation: moving Never [body_inertia_diagonal casimir2 casimir1_squared body_translation]
    (body_inertia = diag(h11, h22), casimir2 = a, casimir1_squared = b, body_translation = m)
    | (body_inertia = diag(h11, h22, h33), casimir2 = a, casimir1_squared = b, body_translation = m);
body_inertia_diagonal_space_translation: moving Never [body_inertia_diagonal casimir2 casimir1_squared space_translation]
    (body_inertia = diag(h11, h22), casimir2 = a, casimir1_squared = b, space_translation = m)
    | (body_inertia = diag(h11, h22, h33), casimir2 = a, casimir1_squared = b, space_translation = m);
body_inertia_matrix: pinned Never [body_inertia_matrix casimir2 casimir1_squared]
    (body_inertia = [[h11, h12], [h12, h22]], casimir2 = a, casimir1_squared = b)
    | (body_inertia = [[h11, h12, h13], [h12, h22, h23], [h13, h23, h33]], casimir2 = a, casimir1_squared = b);
body_inertia_matrix_body_translation: moving Never [body_inertia_matrix casimir2 casimir1_squared body_translation]
    (body_inertia = [[h11, h12], [h12, h22]], casimir2 = a, casimir1_squared = b, body_translation = m)
    | (body_inertia = [[h11, h12, h13], [h12, h22, h23], [h13, h23, h33]], casimir2 = a, casimir1_squared = b, body_translation = m);
space_inertia_diagonal: pinned Never [space_inertia_diagonal casimir2 casimir1_squared]
    (space_inertia = diag(h11, h22), casimir2 = a, casimir1_squared = b)
    | (space_inertia = diag(h11, h22, h33), casimir2 = a, casimir1_squared = b);
space_inertia_diagonal_body_translation: moving Never [space_inertia_diagonal casimir2 casimir1_squared body_translation]
    (space_inertia = diag(h11, h22), casimir2 = a, casimir1_squared = b, body_translation = m)
    | (space_inertia = diag(h11, h22, h33), casimir2 = a, casimir1_squared = b, body_translation = m);
space_inertia_diagonal_space_translation: moving Never [space_inertia_diagonal casimir2 casimir1_squared space_translation]
    (space_inertia = diag(h11, h22), casimir2 = a, casimir1_squared = b, space_translation = m)
    | (space_inertia = diag(h11, h22, h33), casimir2 = a, casimir1_squared = b, space_translation = m);
space_inertia_matrix: pinned Never [space_inertia_matrix casimir2 casimir1_squared]
    (space_inertia = [[h11, h12], [h12, h22]], casimir2 = a, casimir1_squared = b)
    | (space_inertia = [[h11, h12, h13], [h12, h22, h23], [h13, h23, h33]], casimir2 = a, casimir1_squared = b);
space_inertia_matrix_body_translation: moving Never [space_inertia_matrix casimir2 casimir1_squared body_translation]
    (space_inertia = [[h11, h12], [h12, h22]], casimir2 = a, casimir1_squared = b, body_translation = m)
    | (space_inertia = [[h11, h12, h13], [h12, h22, h23], [h13, h23, h33]], casimir2 = a, casimir1_squared = b, body_translation = m);
body_inertia_diagonal_alone: pinned Never [body_inertia_diagonal]
    (body_inertia = diag(h11, h22))
    | (body_inertia = diag(h11, h22, h33));
flat_tensor: pinned Always [flat_tensor dalembert_small]
    (flat_tensor = K, dalembert = small^2);
flat_tensor_space_translation: moving Always [flat_tensor space_translation]
    (flat_tensor = K, space_translation = m);
flat_tensor_body_translation: moving AtRest [flat_tensor body_translation]
    (flat_tensor = K, body_translation = m);
flat_tensor_dalembert: moving Always [flat_tensor dalembert_small space_translation_of_masses]
    (flat_tensor = K, dalembert = small^2, space_translation = mass);
body_inertia_field: moving Never [body_inertia_matrix casimir2 casimir1_squared body_translation]
    (body_inertia = h, casimir2 = a, casimir1_squared = b, body_translation = m);
space_inertia_field: pinned Never [space_inertia_matrix casimir2 casimir1_squared]
    (space_inertia = h, casimir2 = a, casimir1_squared = b);
dalembert_field: moving Always [dalembert_matrix space_translation_of_masses]
    (dalembert = j, space_translation = mass);
body_tensor_field: pinned Never [body_tensor_field casimir2_small]
    (body_tensor = k, casimir2 = small);
space_tensor_field: moving Never [space_tensor_field casimir2_small body_translation]
    (space_tensor = k, casimir2 = small, body_translation = m);
flat_tensor_field: pinned Always [flat_tensor_field]
    (flat_tensor = k);
    } };
}

/// One test per family and dimension: `$check::<N, F>()`.
macro_rules! each_family {
    ($check:ident) => { families! { each_family @ $check } };
    (@ $check:ident $($name:ident: $centre:ident $closed:ident $terms:tt $spec:tt $(| $spec3:tt)?;)*) => { $(
        mod $name {
            #[test]
            fn in_plane() {
                super::$check::<2, $crate::families::$name::plane::PreparedBody>();
            }
            #[test]
            fn in_space() {
                super::$check::<3, $crate::families::$name::space::PreparedBody>();
            }
        }
    )* };
}

macro_rules! define {
    ($($name:ident: $centre:ident $closed:ident $terms:tt $spec:tt $(| $spec3:tt)?;)*) => { $(
        pub(crate) mod $name {
            define! { @ $centre $closed $terms $spec $($spec3)? }
        }
    )* };
    (@ $centre:ident $closed:ident $terms:tt $spec:tt) => {
        define! { @ $centre $closed $terms $spec $spec }
    };
    (@ $centre:ident $closed:ident $terms:tt $spec:tt $spec3:tt) => {
        pub(crate) mod plane { define! { 2 $centre $closed $terms $spec } }
        pub(crate) mod space { define! { 3 $centre $closed $terms $spec3 } }
    };
    (2 $centre:ident $closed:ident $terms:tt ($key:ident = K, $($spec:tt)*)) => {
        with_tensor! { 2 define $key $centre $closed $terms ($($spec)*) }
    };
    (3 $centre:ident $closed:ident $terms:tt ($key:ident = K, $($spec:tt)*)) => {
        with_tensor! { 3 define $key $centre $closed $terms ($($spec)*) }
    };
    ($n:tt $k:tt $key:ident $centre:ident $closed:ident $terms:tt ($($spec:tt)*)) => {
        define! { $n $centre $closed $terms ($key = $k, $($spec)*) }
    };
    (2 $centre:ident $closed:ident $terms:tt $spec:tt) => { define! { @model 2 4 $centre $closed $terms $spec } };
    (3 $centre:ident $closed:ident $terms:tt $spec:tt) => { define! { @model 3 9 $centre $closed $terms $spec } };
    (@model $n:literal $pairs:literal $centre:ident $closed:ident [$($term:ident)*] ($($spec:tt)*)) => {
        #[allow(clippy::wildcard_imports)]
        use super::super::*;

        /// A model of this family; it reads those fields that its energy names.
        #[affine_model(dim = $n, kinetic($($spec)*))]
        #[allow(dead_code, reason = "one list of fields serves every family; each reads its own")]
        pub(crate) struct Body {
            i: f64, a: f64, b: f64, m: f64, alpha: f64, mass: f64, small: f64,
            j11: f64, j12: f64, j13: f64, j22: f64, j23: f64, j33: f64,
            h11: f64, h12: f64, h13: f64, h22: f64, h23: f64, h33: f64,
            j: Matrix<$n>, h: [[f64; $n]; $n], k: Matrix<$pairs>,
        }

        impl Family<$n> for PreparedBody {
            const TRANSLATION: bool = define!(@translation $centre);
            const CLOSED: Closed = Closed::$closed;

            fn with(parameters: &Parameters) -> (Self, Kinetic) {
                let field = |name: &str| parameters.field(name);
                let body = Body {
                    i: field("i"), a: field("a"), b: field("b"), m: field("m"), alpha: field("alpha"),
                    mass: field("mass"), small: field("small"), j11: field("j11"), j12: field("j12"),
                    j13: field("j13"), j22: field("j22"), j23: field("j23"), j33: field("j33"),
                    h11: field("h11"), h12: field("h12"), h13: field("h13"), h22: field("h22"),
                    h23: field("h23"), h33: field("h33"),
                    j: matrix(&parameters.j.to_f64()),
                    h: rows(&parameters.h),
                    k: matrix(&parameters.k.to_f64()),
                };
                let kinetic = Kinetic::new($n, vec![$(parameters.$term()),*]).unwrap();
                (body.prepare().unwrap(), kinetic)
            }

            define! { @points $n $centre }
        }
    };
    (@translation pinned) => { false };
    (@translation moving) => { true };
    (@points $n:literal pinned) => {
        fn at(&self, state: &State) -> Self::Point<f64> {
            self.at_momentum(matrix(&state.phi.to_f64()), TwoPoint(matrix(&state.pi.to_f64()))).unwrap()
        }
        fn at_velocity(&self, _x: Vector<$n>, phi: Matrix<$n>, velocity: &Velocity<$n>) -> Self::Point<f64> {
            PreparedBody::at_velocity(self, phi, velocity.phi_dot).unwrap()
        }
    };
    (@points $n:literal moving) => {
        fn at(&self, state: &State) -> Self::Point<f64> {
            let (x, p) = (vector(&state.x.to_f64()), vector(&state.p.to_f64()));
            let (phi, pi) = (matrix(&state.phi.to_f64()), matrix(&state.pi.to_f64()));
            self.at_momentum(x, phi, p, TwoPoint(pi)).unwrap()
        }
        fn at_velocity(&self, x: Vector<$n>, phi: Matrix<$n>, velocity: &Velocity<$n>) -> Self::Point<f64> {
            PreparedBody::at_velocity(self, x, phi, velocity.x_dot, velocity.phi_dot).unwrap()
        }
    };
}

families!(define);
