//! Double-double models, and derivatives with respect to fields, against exact arithmetic.

use affine_oracle::{Random, Rational, rational, rounded};
use affine_runtime::Error;
use affine_runtime::dual::Dual;
use affine_runtime::parametric::{Field, Fields, Parametric};
use affine_runtime::prelude::*;
use qd::Quad;

use crate::models::{Anisotropic, Drawn, Ellipsoid, Missile, Oblique, PreparedMissile, Split, Wind, start};
use crate::numbers::{Coefficients, as_rational, coefficients, nearest, vector};
use crate::rates::{exactly, of_full, of_reduced, over};

/// Of the largest entry: eight digits are left to conditions of mass matrices, far from the 16 of doubles.
const QUAD: f64 = 1e-26;
/// Likewise of derivatives by doubles.
const DOUBLE: f64 = 1e-11;

fn largest<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> f64 {
    numbers.into_iter().fold(0.0, |most, number| f64::max(most, number.abs()))
}

/// The largest difference from exact numbers, in units of the largest of these.
fn error(found: &[Quad], expected: &[Rational]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let differences: Vec<f64> =
        found.iter().zip(expected).map(|(found, exact)| rounded(&(as_rational(*found) - exact))).collect();
    assert!(differences.iter().all(|difference| difference.is_finite()));
    largest(&differences) / largest(&expected.iter().map(rounded).collect::<Vec<_>>())
}

fn double_doubles_have_their_digits<const N: usize, F: Drawn<N>>() {
    let mut random = Random::new(41);
    for _ in 0..5 {
        let values = F::drawn(&mut random);
        let model = F::prepared(&vector(|k| rounded(&values[k])));
        let full = start::<N, F::Prepared>(&mut random);
        let expected = exactly::<N, F::Prepared>(&F::kinetic(&values).unwrap(), &full);
        let precise: Coefficients<N, F, Quad> = coefficients::<N, F, _>(|k| nearest(&values[k]));
        let rough = model.coefficients::<Quad>();
        let full = over::<N, F::Prepared, Quad>(&full);
        let [found, rough] = [&precise, &rough].map(|from| error(&of_full(&model, from, &full), &expected));
        assert!(found < QUAD, "{found:e}");
        assert!(rough > 1e-19, "with fields that are doubles there are the digits of doubles, {rough:e}");
        let (there, rates) = of_reduced(&model, &precise, &full);
        let expected: Vec<Rational> =
            of_full(&model, &precise, &there).into_iter().map(as_rational).collect();
        let found = error(&rates, &expected);
        assert!(found < QUAD, "reduced equations: {found:e}");
    }
}

#[test]
fn equations_of_double_double_coefficients_are_exact_to_their_precision() {
    double_doubles_have_their_digits::<3, Missile>();
    double_doubles_have_their_digits::<3, Ellipsoid>();
    double_doubles_have_their_digits::<2, Anisotropic>();
}

/// The place of the entry of a matrix that is exchanged with the entry at a place; that of a number is its own.
fn exchanged(fields: &[Field], place: usize) -> usize {
    let mut first = 0;
    for field in fields {
        let within = place - first;
        if within < field.rows.pow(2) {
            return first + within % field.rows * field.rows + within / field.rows;
        }
        first += field.rows.pow(2);
    }
    panic!("no such value")
}

/// `(f(values + h e_k) - f(values - h e_k))/(2h)`, with `h` so small that its square is none of a double. Matrices stay symmetric:
/// only their symmetric parts have a meaning.
fn difference<T: Into<Difference>>(
    values: &[Rational],
    [k, other]: [usize; 2],
    f: impl Fn(&[Rational]) -> Vec<T>,
) -> Vec<f64> {
    let h = rational(1, 1 << 40);
    let at = |sign: i64| {
        let mut moved = values.to_vec();
        [k, other].iter().for_each(|place| moved[*place] += &h * rational(sign, 2));
        f(&moved).into_iter().map(|number| number.into().0).collect::<Vec<_>>()
    };
    let quotient = |(above, below): (Rational, Rational)| rounded(&((above - below) / (&h * rational(2, 1))));
    at(1).into_iter().zip(at(-1)).map(quotient).collect()
}

/// A number whose differences have digits.
struct Difference(Rational);

impl From<Rational> for Difference {
    fn from(number: Rational) -> Self {
        Difference(number)
    }
}

impl From<Quad> for Difference {
    fn from(number: Quad) -> Self {
        Difference(as_rational(number))
    }
}

/// The values of the fields, of which one moves.
fn moving<const N: usize, F: Fields<N>>(values: &[Rational], moved: usize) -> Coefficients<N, F, Dual<f64>> {
    coefficients::<N, F, _>(|k| Dual {
        value: rounded(&values[k]),
        slope: if k == moved { 1.0 } else { 0.0 },
    })
}

fn assert_slopes(what: &str, found: &[Dual<f64>], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    let differences: Vec<f64> = found.iter().zip(expected).map(|(dual, exact)| dual.slope - exact).collect();
    let size = largest(expected) + largest(&found.iter().map(|dual| dual.value).collect::<Vec<_>>());
    let is_near = differences.iter().all(|difference| difference.abs() <= DOUBLE * size);
    assert!(is_near, "{what}: {differences:?} of {size:e}");
}

/// Slopes of coefficients, of Hamilton's equations and of the reduced ones; against the oracle where it has the model, else
/// against differences of the model itself in double-doubles.
fn slopes_are_differences<const N: usize, F: Drawn<N>>() {
    let mut random = Random::new(43);
    let values = F::drawn(&mut random);
    let model = F::prepared(&vector(|k| rounded(&values[k])));
    let full = start::<N, F::Prepared>(&mut random);
    let in_quads = |values: &[Rational]| coefficients::<N, F, _>(|k| nearest::<Quad>(&values[k]));
    let mut largest_slope = 0.0;
    for moved in 0..values.len() {
        let slopes = moving::<N, F>(&values, moved);
        let moved = [moved, exchanged(F::FIELDS, moved)];
        let expected = difference(&values, moved, |values| in_quads(values).as_ref().to_vec());
        assert_slopes("coefficients", slopes.as_ref(), &expected);
        let expected = match F::kinetic(&values) {
            Some(_) => difference(&values, moved, |values| {
                exactly::<N, F::Prepared>(&F::kinetic(values).unwrap(), &full)
            }),
            None => difference(&values, moved, |values| {
                of_full(&model, &in_quads(values), &over::<N, F::Prepared, Quad>(&full))
            }),
        };
        largest_slope = f64::max(largest_slope, largest(&expected));
        let full = over::<N, F::Prepared, _>(&full);
        assert_slopes("Hamilton's equations", &of_full(&model, &slopes, &full), &expected);
        let (there, rates) = of_reduced(&model, &slopes, &full);
        let expected: Vec<f64> = of_full(&model, &slopes, &there).iter().map(|number| number.slope).collect();
        assert_slopes("reduced equations", &rates, &expected);
    }
    assert!(largest_slope > 1e-3, "the equations depend on the fields: {largest_slope:e}");
}

#[test]
fn derivatives_with_respect_to_fields_are_those_of_the_oracle() {
    slopes_are_differences::<3, Missile>();
    slopes_are_differences::<3, Ellipsoid>();
    slopes_are_differences::<2, Anisotropic>();
}

#[test]
fn derivatives_with_respect_to_fields_are_limits_of_differences() {
    slopes_are_differences::<2, Oblique<Wind>>();
    slopes_are_differences::<2, Split>();
}

#[test]
fn energies_and_their_slopes_are_exact() {
    let mut random = Random::new(47);
    let values = Missile::drawn(&mut random);
    let model = Missile::prepared(&vector(|k| rounded(&values[k])));
    let full = start::<3, PreparedMissile>(&mut random);
    let energy = |coefficients: &[Dual<f64>; 19]| {
        let point = model.unflatten_with(coefficients, &full.map(Dual::fixed));
        let hamiltonian = model.hamiltonian_with(coefficients, Dual::fixed(0.0), &point);
        let velocity = model.velocity_with(coefficients, &point);
        (hamiltonian, model.kinetic_energy_with(coefficients, point.phi(), &velocity))
    };
    for moved in 0..4 {
        let expected = difference(&values, [moved; 2], |values| {
            let kinetic = Missile::kinetic(values).unwrap();
            vec![crate::rates::energy::<3, PreparedMissile>(&kinetic, &full)]
        });
        let (hamiltonian, kinetic) = energy(&moving::<3, Missile>(&values, moved));
        assert_slopes("H", &[hamiltonian], &expected);
        assert_slopes("T", &[kinetic], &expected);
        assert!(hamiltonian.value == model.hamiltonian(0.0, &model.unflatten(&full)));
    }
}

#[test]
fn fields_are_listed_with_their_values() {
    let missile = Missile::FIELDS.iter().map(|field| (field.name, field.rows)).collect::<Vec<_>>();
    assert_eq!(missile, [("a", 1), ("b", 1), ("i", 1), ("m", 1)]);
    let ellipsoid = Ellipsoid::FIELDS.iter().map(|field| (field.name, field.rows)).collect::<Vec<_>>();
    assert_eq!(ellipsoid, [("m", 1), ("j", 3)]);
    let body = Oblique::<Wind>::FIELDS.iter().map(|field| (field.name, field.rows)).collect::<Vec<_>>();
    assert_eq!(body, [("s", 1), ("eta", 2), ("j", 2), ("k", 4)]);
}

#[test]
fn what_prepare_refuses_is_refused_in_every_number() {
    // I + A = 0, and no number that is small enough to be told from it by doubles.
    let values = [-1.0, 0.0, 1.0, 1.0];
    let refused = |result: Result<_, Error>| match result {
        Err(Error::IllPosed(defect)) => defect.condition,
        _ => panic!("accepted, or for another reason"),
    };
    let in_doubles = Missile::coefficients_of(&values).map(|_: [f64; 19]| ());
    let in_duals = Missile::coefficients_of(&values.map(Dual::fixed)).map(|_: [Dual<f64>; 19]| ());
    let in_quads = Missile::coefficients_of(&values.map(Quad::from)).map(|_: [Quad; 19]| ());
    for refused in [in_doubles, in_duals, in_quads].map(refused) {
        assert_eq!(refused, "I + A != 0");
    }
}

#[test]
fn equal_principal_values_have_no_slopes_of_axes() {
    let with = |slope: f64| {
        let off = Dual { value: 0.0, slope };
        let [one, two] = [1.0, 2.0].map(Dual::fixed);
        Split::coefficients_of(&[one, two, off, off, two])
    };
    assert!(with(0.0).is_ok());
    assert!(matches!(with(1.0), Err(Error::IllPosed(_))));
}
