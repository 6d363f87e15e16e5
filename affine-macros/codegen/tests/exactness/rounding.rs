//! Ways of writing forces are told apart by sums over all operations of what rounding one of them does: here against runs of the
//! same programs in doubles and in exact numbers, from which chance is not kept away.

use affine_codegen::algebra::bind::Constants;
use affine_codegen::algebra::{Arena, Expr, Function, Rational};
use affine_codegen::ir::Program;
use affine_codegen::mechanics::charts::{Chart, Momentum};
use affine_codegen::mechanics::potential::{Base, Potential, Way};
use affine_codegen::optimise::{Batch, straight_line};
use affine_codegen::symbol::{Quantity, Symbol};

const N: usize = 3;

/// Bits of the entries of a strain: with those before them no more than a double holds.
const FRACTION: u32 = 31;

/// Energies whose forces are fractions of polynomials: `(tr G - 3)^2 + ..` and the like.
fn energies(arena: &mut Arena) -> Vec<Expr> {
    let [first, second, third] = [1, 2, 3].map(|power| Base::Trace(power).symbol(arena));
    let q = Base::MeanLogStretch.symbol(arena);
    let mut volume = |k: i64| {
        let argument = arena.scale(q, &Rational::from(3 * k));
        arena.apply(Function::Exp, argument)
    };
    let (det, inverse) = (volume(1), volume(-1));
    let three = arena.constant(Rational::from(3));
    let squared = arena.mul(first, first);
    let minors = arena.linear(&[(squared, Rational::HALF), (second, -&Rational::HALF)]);
    let mut raised = |of: Expr, number: Expr, power: i32| {
        let difference = arena.sub(of, number);
        arena.power(difference, power)
    };
    let (trace, of_minors) = (raised(first, three, 4), raised(minors, three, 3));
    let sum = |arena: &mut Arena, terms: &[(Expr, i64)]| {
        let terms: Vec<_> = terms.iter().map(|(of, c)| (*of, Rational::from(*c))).collect();
        arena.linear(&terms)
    };
    let square = arena.mul(det, det);
    let foam = arena.mul(minors, inverse);
    let foam = arena.mul(foam, inverse);
    vec![
        trace,
        of_minors,
        sum(arena, &[(second, 1), (first, -2)]),
        sum(arena, &[(square, 1), (det, -2)]),
        sum(arena, &[(second, 1), (inverse, 4)]),
        sum(arena, &[(third, 1), (first, -3)]),
        sum(arena, &[(foam, 1), (det, 2)]),
    ]
}

/// The force on the affine momentum.
fn program(arena: &mut Arena, potential: &Potential, chart: &Chart, way: Way) -> Program {
    let load = potential.load_by(arena, chart, way);
    let results = load.forces.into_iter().enumerate();
    let results = results.map(|(k, (_, force))| (Quantity::Value.at([k]), force)).collect();
    let batch = Batch { shared: load.shared, kernels: load.kernels, results }.pruned(arena);
    let inputs = chart.phi.0.concat();
    straight_line(arena, &batch, &mut Constants::new(Quantity::Coefficient), &|atom| inputs.contains(&atom))
}

/// `1 + 2^-m R` with entries that doubles hold: the numerator of an entry over `2^m`.
fn numerator(symbol: &Symbol, m: u32, draw: i64) -> Option<i64> {
    let Symbol::Component(Quantity::Placement, entry) = symbol else { return None };
    let (i, a) = (i64::try_from(entry[0]).ok()?, i64::try_from(entry[1]).ok()?);
    let mixed = (37 * i + 101 * a + 59 * draw + 7 * i * a * draw).wrapping_mul(0x5851_f42d_4c95_7f2d);
    Some((i64::from(i == a) << (m + FRACTION)) + (mixed >> (63 - FRACTION)))
}

/// What is lost, and the bound on that, in roundings of the force.
fn lost(program: &Program, m: u32, draw: i64) -> Option<(f64, f64)> {
    let below = 1 << (m + FRACTION);
    let entry = |symbol: &Symbol| numerator(symbol, m, draw);
    let exact = program.run(&|symbol| Rational::ratio(entry(symbol)?, below))?;
    let input = |symbol: &Symbol| Some(entry(symbol)? as f64 / below as f64);
    let rounding = program.rounding(&input, &|_| 0.0)?;
    let size = rounding.own.iter().map(|own| own * own).sum::<f64>().sqrt();
    let exact: Vec<f64> = exact
        .iter()
        .zip(&rounding.results)
        .map(|(exact, found)| (exact - &whole(*found)).to_doubles().0)
        .collect();
    let error = exact.iter().map(|d| d * d).sum::<f64>().sqrt();
    Some((error, size * f64::EPSILON / 2.0))
}

/// A double as a fraction.
fn whole(value: f64) -> Rational {
    let bits = value.abs().to_bits();
    let (exponent, fraction) = ((bits >> 52) as i32, bits & ((1 << 52) - 1));
    let mantissa = i64::try_from(if exponent == 0 { fraction } else { fraction | (1 << 52) }).unwrap();
    let power = Rational::from(2).pow(exponent.max(1) - 1075).unwrap();
    let size = &Rational::from(mantissa) * &power;
    if value < 0.0 { -&size } else { size }
}

#[test]
fn bounds_tell_what_runs_tell() {
    let arena = &mut Arena::new();
    let mut compared = 0;
    for energy in energies(arena) {
        let potential = Potential::new(arena, N, energy);
        let chart = Chart::new(arena, N, Momentum::Canonical, None);
        for m in [2, 7, 13, 20] {
            let mut ways = Vec::new();
            for way in potential.ways(arena, &chart) {
                let program = program(arena, &potential, &chart, way);
                let runs: Vec<_> = (0..6).filter_map(|draw| lost(&program, m, draw)).collect();
                // Roots have no exact values.
                if runs.is_empty() {
                    continue;
                }
                for (error, bound) in &runs {
                    assert!(error <= bound, "{way:?} 2^-{m}: {error:e} {bound:e}");
                }
                let worst = |part: fn(&(f64, f64)) -> f64| runs.iter().map(part).fold(0.0, f64::max);
                let (error, bound) = (worst(|run| run.0), worst(|run| run.1));
                assert!(error > bound / 100.0, "{way:?} 2^-{m}: {error:e} {bound:e}");
                ways.push((way, error, bound));
            }
            for (way, error, bound) in &ways {
                for (other, less, least) in ways.iter().filter(|(_, _, least)| 100.0 * least < *bound) {
                    assert!(less < error, "{way:?} and {other:?} 2^-{m}: {least:e} {bound:e}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 20, "{compared}");
}
