//! Models of every way by which fields become coefficients: formulas, inverse blocks, bases, principal axes.

use affine_oracle::{Kinetic, Matrix as Exact, Random, Rational, Term, rational};
use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::model::StateVector;
use affine_runtime::parametric::Fields;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

/// A struct whose fields are drawn.
pub(crate) trait Drawn<const N: usize>: Fields<N> {
    /// The struct with these values of its fields, prepared as users prepare it.
    fn prepared(values: &Self::Values<f64>) -> Self::Prepared;
    /// Values that no double is.
    fn drawn(random: &mut Random) -> Vec<Rational>;
    /// The kinetic energy with these values, as the oracle has it, where it is all of the energy.
    fn kinetic(_values: &[Rational]) -> Option<Kinetic> {
        None
    }
}

/// Isotropic, with an inertia of the centre of mass in the body.
#[affine_model(
    dim = 3,
    kinetic(casimir2 = a, casimir1_squared = b, body_inertia = i, body_translation = m),
    emit(lanes)
)]
pub(crate) struct Missile {
    a: f64,
    b: f64,
    i: f64,
    m: f64,
}

impl Drawn<3> for Missile {
    fn prepared(&[a, b, i, m]: &[f64; 4]) -> PreparedMissile {
        Missile { a, b, i, m }.prepare().unwrap()
    }
    fn drawn(random: &mut Random) -> Vec<Rational> {
        [(-10, 10), (1, 20), (21, 60), (10, 60)].map(|(low, high)| number(random, low, high)).to_vec()
    }
    fn kinetic(values: &[Rational]) -> Option<Kinetic> {
        let [a, b, i, m] = values else { panic!("four fields") };
        let terms = vec![
            Term::Casimir2(a.clone()),
            Term::Casimir1Squared(b.clone()),
            Term::body_inertia(3, i.clone()),
            Term::BodyTranslation(m.clone()),
        ];
        Some(Kinetic::new(3, terms).unwrap())
    }
}

/// An inertia that is inverted when it is prepared.
#[affine_model(dim = 3, kinetic(dalembert = j, space_translation = m))]
pub(crate) struct Ellipsoid {
    j: Matrix<3>,
    m: f64,
}

impl Drawn<3> for Ellipsoid {
    fn prepared(values: &[f64; 10]) -> PreparedEllipsoid {
        let j = Matrix::<3>::from_row_slice(&values[1..]);
        Ellipsoid { j, m: values[0] }.prepare().unwrap()
    }
    fn drawn(random: &mut Random) -> Vec<Rational> {
        [vec![number(random, 10, 60)], form(random, 3)].concat()
    }
    fn kinetic(values: &[Rational]) -> Option<Kinetic> {
        let terms =
            vec![Term::DAlembert(symmetric(3, &values[1..])), Term::SpaceTranslation(values[0].clone())];
        Some(Kinetic::new(3, terms).unwrap())
    }
}

/// A tensor that is inverted when it is prepared.
#[affine_model(dim = 2, kinetic(body_tensor = k))]
pub(crate) struct Anisotropic {
    k: [[f64; 4]; 4],
}

impl Drawn<2> for Anisotropic {
    fn prepared(values: &[f64; 16]) -> PreparedAnisotropic {
        let k = std::array::from_fn(|row| std::array::from_fn(|column| values[4 * row + column]));
        Anisotropic { k }.prepare().unwrap()
    }
    fn drawn(random: &mut Random) -> Vec<Rational> {
        form(random, 4)
    }
    fn kinetic(values: &[Rational]) -> Option<Kinetic> {
        Some(Kinetic::new(2, vec![Term::BodyTensor(symmetric(4, values))]).unwrap())
    }
}

/// What blows, stronger where the body is stretched; its own numbers are no coefficients.
#[derive(Clone)]
pub(crate) struct Wind;

impl Force<2> for Wind {
    type Form = Translation;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        let stretch = motion.phi[(0, 0)] * motion.phi_dot[(1, 1)];
        Vector::<2, T>::new(stretch + motion.x[0], motion.x_dot[0] * motion.phi[(1, 0)])
    }
}

/// Axes of the body's own, in which an inertia, a friction and a force are stated.
#[affine_model(
    dim = 2,
    metrics(body = eta),
    kinetic(dalembert = j, space_translation = 1),
    potential = s*tr(G),
    dissipation(space_tensor = k),
    forces = custom(wind, translation)
)]
pub(crate) struct Oblique<W: Clone + Force<2, Form = Translation>> {
    eta: Matrix<2>,
    j: [[f64; 2]; 2],
    k: [[f64; 4]; 4],
    s: f64,
    wind: W,
}

impl Drawn<2> for Oblique<Wind> {
    fn prepared(values: &[f64; 25]) -> PreparedOblique<Wind> {
        let square =
            |first: usize| [[values[first], values[first + 1]], [values[first + 2], values[first + 3]]];
        let [[a, b], [c, d]] = square(1);
        let eta = Matrix::<2>::new(a, b, c, d);
        let k = std::array::from_fn(|row| std::array::from_fn(|column| values[9 + 4 * row + column]));
        Oblique { eta, j: square(5), k, s: values[0], wind: Wind }.prepare().unwrap()
    }
    fn drawn(random: &mut Random) -> Vec<Rational> {
        [vec![number(random, 10, 60)], form(random, 2), form(random, 2), form(random, 4)].concat()
    }
}

/// Exact flows of its pieces ask for the principal axes of its inertia.
#[affine_model(dim = 2, kinetic(body_inertia = j), potential = s*(tr(G)/2 - ln(det)), emit(splitting))]
pub(crate) struct Split {
    j: Matrix<2>,
    s: f64,
}

impl Drawn<2> for Split {
    fn prepared(values: &[f64; 5]) -> PreparedSplit {
        let j = Matrix::<2>::from_row_slice(&values[1..]);
        Split { j, s: values[0] }.prepare().unwrap()
    }
    fn drawn(random: &mut Random) -> Vec<Rational> {
        [vec![number(random, 10, 60)], form(random, 2)].concat()
    }
}

/// Twenty-firsts between two of them.
fn number(random: &mut Random, low: i64, high: i64) -> Rational {
    // A multiple of three would be a double where it is one of seven as well.
    rational(3 * random.integer(low, high) + 1, 63)
}

/// Entries of a positive symmetric form, row after row, whose principal values differ.
fn form(random: &mut Random, size: usize) -> Vec<Rational> {
    let entries: Vec<Rational> = (0..size * size).map(|_| number(random, -5, 5)).collect();
    let entry = |row: usize, column: usize| match row == column {
        true => &entries[row * size + column] + rational(2 + row as i64, 1),
        false => entries[row.min(column) * size + row.max(column)].clone(),
    };
    (0..size * size).map(|k| entry(k / size, k % size)).collect()
}

/// The symmetric part of a square matrix.
fn symmetric(size: usize, entries: &[Rational]) -> Exact {
    let matrix = Exact::from_rationals(size, size, entries);
    (&matrix + &matrix.transpose()).scaled(&rational(1, 2))
}

/// A plain array that is a phase point, of doubles.
pub(crate) fn start<const N: usize, M: Model<N>>(random: &mut Random) -> M::Full<f64> {
    let mut full = M::Full::<f64>::zeros();
    let mut rest = full.as_mut();
    for group in M::DESCRIPTION.full {
        let (part, after) = rest.split_at_mut(group.len);
        let is_placement = group.quantity == affine_runtime::model::Quantity::Placement;
        for (k, entry) in part.iter_mut().enumerate() {
            let unit = if is_placement && k % (N + 1) == 0 { 1.0 } else { 0.0 };
            *entry = unit + random.integer(-20, 20) as f64 / 64.0;
        }
        rest = after;
    }
    full
}
