//! Named quantities at an exact point, and their rates along the exact motion.

use std::collections::HashMap;

use affine_codegen::algebra::Rational;
use affine_codegen::ir::Program;
use affine_codegen::symbol::Symbol;
use affine_oracle::{Kinetic, Matrix, Motion, Observable, Random, Rational as Exact, State, rational};

/// Values by name.
pub(crate) type Values = HashMap<String, Rational>;

/// The generator's number for the oracle's.
pub(crate) fn own(value: &Exact) -> Rational {
    let whole = |digits: String| Rational::parse_decimal(&digits).unwrap();
    let size = whole(value.numer().magnitude().to_string())
        .checked_div(&whole(value.denom().magnitude().to_string()))
        .unwrap();
    if *value.numer() < 0.into() { -&size } else { size }
}

/// The oracle's number for the generator's.
pub(crate) fn exact(value: &Rational) -> Exact {
    value.to_string().parse().unwrap()
}

/// A fraction with a small numerator and denominator, not zero.
pub(crate) fn fraction(random: &mut Random) -> Exact {
    let above = random.integer(1, 9) * if random.bits() & 1 == 0 { 1 } else { -1 };
    rational(above, random.integer(1, 7))
}

/// Puts the entries of a vector under `name_1`, ... or of a matrix under `name_11`, ...
pub(crate) fn put(values: &mut Values, name: &str, matrix: &Matrix) {
    let (rows, columns) = matrix.shape();
    for i in 0..rows {
        for j in 0..columns {
            let key =
                if columns == 1 { format!("{name}_{}", i + 1) } else { format!("{name}_{}{}", i + 1, j + 1) };
            values.insert(key, own(&matrix.entry(i, j)));
        }
    }
}

/// A square matrix with its symmetric part `name_sym` and the differences `name_skew = M - M^T`.
fn put_split(values: &mut Values, name: &str, matrix: &Matrix) {
    put(values, name, matrix);
    put(values, &format!("{name}_sym"), &(matrix + &matrix.transpose()).scaled(&rational(1, 2)));
    put(values, &format!("{name}_skew"), &matrix.skew());
}

const VECTORS: [(&str, Observable); 2] =
    [("p", Observable::LinearMomentum), ("p_hat", Observable::ComovingLinearMomentum)];

const MATRICES: [(&str, Observable); 4] = [
    ("sigma", Observable::AffineSpin),
    ("sigma_hat", Observable::ComovingAffineSpin),
    ("total", Observable::TotalAffineMomentum),
    ("pi", Observable::CanonicalMomentum),
];

fn collect(x: &Matrix, phi: &Matrix, of: impl Fn(Observable) -> Matrix) -> Values {
    let mut values = Values::new();
    put(&mut values, "x", x);
    put(&mut values, "phi", phi);
    VECTORS.iter().for_each(|(name, observable)| put(&mut values, name, &of(*observable)));
    MATRICES.iter().for_each(|(name, observable)| put_split(&mut values, name, &of(*observable)));
    values
}

/// All coordinates of all charts.
pub(crate) fn coordinates(kinetic: &Kinetic, state: &State) -> Values {
    collect(&state.x, &state.phi, |observable| observable.value(kinetic, state).unwrap())
}

/// Their rates, under the names of the coordinates.
pub(crate) fn rates(motion: &Motion) -> Values {
    collect(&motion.rate().x, &motion.rate().phi, |observable| motion.bracket(observable).unwrap())
}

/// What is known of a placement that moves: the velocities of all frames, and `phi^-1`.
pub(crate) fn velocities(kinetic: &Kinetic, state: &State) -> Values {
    let (x_dot, phi_dot) = kinetic.velocity(state).unwrap();
    let inverse = state.phi.inverse().unwrap();
    let mut values = Values::new();
    put(&mut values, "v_hat", &(&inverse * &x_dot));
    put(&mut values, "x_dot", &x_dot);
    put(&mut values, "phi_inverse", &inverse);
    put(&mut values, "omega_hat", &(&inverse * &phi_dot));
    put(&mut values, "omega", &(&phi_dot * &inverse));
    put(&mut values, "phi_dot", &phi_dot);
    values
}

/// What symbols are called.
pub(crate) fn names(symbols: &[Symbol]) -> Vec<String> {
    symbols.iter().map(Symbol::to_string).collect()
}

/// Runs a program exactly; its results by name.
pub(crate) fn run(program: &Program, inputs: &Values) -> Values {
    let results = program
        .run::<Rational>(&|symbol| inputs.get(&symbol.to_string()).cloned())
        .expect("every input, and no division by zero");
    assert_eq!(results.len(), program.outputs.len());
    program.results().map(Symbol::to_string).zip(results).collect()
}

/// Every result has the value expected under its name, without the prefix; there are `count` of them.
pub(crate) fn agree(what: &str, results: &Values, prefix: &str, expected: &Values, count: usize) {
    assert_eq!(results.len(), count, "{what}: number of results");
    for (name, value) in results {
        let key = name.strip_prefix(prefix).unwrap_or_else(|| panic!("{what}: {name}"));
        let expected = expected.get(key).unwrap_or_else(|| panic!("{what}: unexpected {name}"));
        assert_eq!(value, expected, "{what}: {name}");
    }
}
