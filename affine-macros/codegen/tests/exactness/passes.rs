//! Every pass keeps the exact value of every result, and none makes a program longer that promises not to.

use std::collections::HashMap;

use affine_codegen::algebra::bind::Constants;
use affine_codegen::algebra::evaluate::evaluate_polynomial;
use affine_codegen::algebra::factor::{First, complete_sums, factored, scale_atoms};
use affine_codegen::algebra::{Arena, Expr, Function, Polynomial, Rational};
use affine_codegen::ir::build::{Builder, Ways};
use affine_codegen::ir::count::Operations;
use affine_codegen::ir::fuse::fuse;
use affine_codegen::ir::inverse_root::with_inverse_roots;
use affine_codegen::ir::tangent::with_tangent;
use affine_codegen::ir::{Op, Program};
use affine_codegen::optimise::{Batch, straight_line};
use affine_codegen::symbol::{Quantity, Symbol};
use affine_oracle::Random;

use super::points::{fraction, own, run};

/// Polynomials in symbols that vary, `x_1 ... x_5`, and symbols that do not, `k_1 ... k_3`.
struct System {
    arena: Arena,
    polynomials: Vec<Polynomial>,
    point: HashMap<String, Rational>,
}

impl System {
    fn random(random: &mut Random) -> Self {
        let mut arena = Arena::new();
        let moving: Vec<Expr> = (1..=5).map(|k| arena.symbol(Quantity::Position.at([k]))).collect();
        let fixed: Vec<Expr> = (1..=3).map(|k| arena.symbol(Quantity::Constant.at([k]))).collect();
        let point = (1..=5).map(|k| format!("x_{k}")).chain((1..=3).map(|k| format!("k_{k}")));
        let point = point.map(|name| (name, own(&fraction(random)))).collect();
        // Few weights, so that sums share them as equations of motion do.
        let weights = [1, 1, 1, -1, 2, -3].map(Rational::from);
        let pick = |random: &mut Random, list: &[Expr]| {
            list[usize::try_from(random.integer(0, i64::try_from(list.len()).unwrap() - 1)).unwrap()]
        };
        let polynomials = (0..random.integer(1, 6))
            .map(|_| {
                let mut sum = Polynomial::zero();
                for _ in 0..random.integer(1, 9) {
                    let mut monomial = Vec::new();
                    (0..random.integer(0, 3)).for_each(|_| monomial.push(pick(random, &moving)));
                    (0..random.integer(0, 2)).for_each(|_| monomial.push(pick(random, &fixed)));
                    let weight = &weights[usize::try_from(random.integer(0, 5)).unwrap()];
                    let weight =
                        if random.integer(0, 3) == 0 { own(&fraction(random)) } else { weight.clone() };
                    sum.add_term(monomial, &weight);
                }
                sum
            })
            .collect();
        Self { arena, polynomials, point }
    }

    fn value(&self, polynomial: &Polynomial) -> Rational {
        evaluate_polynomial(&self.arena, polynomial, &|symbol| self.point.get(&symbol.to_string()).cloned())
            .unwrap()
    }

    fn values(&self) -> Vec<Rational> {
        self.polynomials.iter().map(|p| self.value(p)).collect()
    }

    /// Gives definitions their values, in an order in which each is known before it is used.
    fn define(&mut self, definitions: &[(Expr, Polynomial)]) {
        for (symbol, polynomial) in definitions {
            let value = self.value(polynomial);
            self.point.insert(self.arena.symbol_name(*symbol), value);
        }
    }

    fn moving(&self, atom: Expr) -> bool {
        self.arena.quantity(atom) == Some(Quantity::Position)
    }
}

fn lowered(
    arena: &mut Arena,
    polynomials: &[Polynomial],
    form: impl Fn(&mut Arena, &Polynomial) -> Expr,
) -> Program {
    let mut builder = Builder::new();
    for (k, polynomial) in polynomials.iter().enumerate() {
        let value = form(arena, polynomial);
        builder.output(arena, result(k), value);
    }
    builder.finish()
}

/// Names of results, and of other values.
fn result(place: usize) -> Symbol {
    Quantity::Value.at([place])
}

fn named(place: usize) -> Symbol {
    Quantity::Scaled.at([place])
}

fn outputs(program: &Program, point: &HashMap<String, Rational>) -> Vec<Rational> {
    let results = run(program, point);
    (0..results.len()).map(|k| results[&result(k).to_string()].clone()).collect()
}

/// Every step reads earlier ones only.
fn well_formed(program: &Program) {
    for (k, step) in program.steps.iter().enumerate() {
        assert!(step.operands().iter().all(|v| *v < k), "{step:?} at {k}");
    }
    assert!(program.outputs.iter().all(|(_, v)| *v < program.steps.len()));
    assert!(program.names.iter().all(|(v, _)| *v < program.steps.len()));
}

const ROUNDS: usize = 150;

#[test]
fn binding_constants_keeps_the_value() {
    let mut random = Random::new(71);
    for _ in 0..ROUNDS {
        let mut system = System::random(&mut random);
        let expected = system.values();
        let names = varying(&system);
        let mut constants = Constants::new(Quantity::Coefficient);
        let bound: Vec<Polynomial> = system
            .polynomials
            .clone()
            .iter()
            .map(|p| constants.bind(&mut system.arena, p, &|atom| names.contains(&atom)))
            .collect();
        for (symbol, definition) in &constants.entries {
            assert!(constants.contains(*symbol));
            assert!(!definition.mentions(|atom| names.contains(&atom)), "constants do not vary");
            assert!(definition.as_constant().is_none(), "numbers stay numbers");
        }
        system.define(&constants.entries);
        system.polynomials = bound;
        assert_eq!(system.values(), expected);
        for polynomial in &system.polynomials {
            for (monomial, _) in polynomial.terms() {
                let fixed = monomial.iter().filter(|atom| !names.contains(atom));
                assert!(fixed.clone().all(|atom| constants.contains(*atom)) && fixed.count() <= 1);
            }
        }
    }
}

fn varying(system: &System) -> Vec<Expr> {
    let atoms =
        system.polynomials.iter().flat_map(|p| p.terms().flat_map(|(m, _)| m.clone()).collect::<Vec<_>>());
    let mut atoms: Vec<Expr> = atoms.filter(|atom| system.moving(*atom)).collect();
    atoms.sort_unstable();
    atoms.dedup();
    atoms
}

/// `scale_atoms` and `complete_sums`: definitions first, then the rest with them in place.
#[test]
fn scaling_and_completing_keep_the_value() {
    let mut random = Random::new(72);
    let (mut scaled_once, mut completed_once) = (0, 0);
    for round in 0..2 * ROUNDS {
        let mut system =
            if round % 2 == 0 { System::random(&mut random) } else { nearly_shared(&mut random) };
        let expected = system.values();
        let names = varying(&system);
        let mut polynomials = system.polynomials.clone();
        let sums = complete_sums(&mut system.arena, &mut polynomials, &|atom| names.contains(&atom));
        completed_once += usize::from(!sums.is_empty());
        system.define(&sums);
        system.polynomials = polynomials.clone();
        assert_eq!(system.values(), expected);
        let moving: Vec<Expr> = names.iter().copied().chain(sums.iter().map(|(s, _)| *s)).collect();
        let scaled = scale_atoms(&mut system.arena, &mut polynomials, &|atom| moving.contains(&atom));
        scaled_once += usize::from(!scaled.is_empty());
        system.define(&scaled);
        system.polynomials = polynomials;
        assert_eq!(system.values(), expected);
    }
    assert!(scaled_once > 50 && completed_once > 50, "{scaled_once} {completed_once}");
}

/// `y_k = c (x1 + ... + x5) + d_k x_k`.
fn nearly_shared(random: &mut Random) -> System {
    let mut system = System::random(random);
    let atoms: Vec<Expr> = (1..=5).map(|k| system.arena.symbol(Quantity::Position.at([k]))).collect();
    let (c, d) = (own(&fraction(random)), own(&fraction(random)));
    let k1 = system.arena.symbol(Quantity::Constant.at([1]));
    system.polynomials = (0..4)
        .map(|odd| {
            let mut sum = Polynomial::zero();
            atoms.iter().for_each(|atom| sum.add_term(vec![*atom, k1], &c));
            sum.add_term(vec![atoms[odd]], &d);
            sum
        })
        .collect();
    system
}

/// Sharing a sum that nearly all forms contain takes fewer operations, unless factoring alone finds it.
#[test]
fn completing_sums_shortens_programs() {
    let mut random = Random::new(73);
    let mut shorter = 0;
    for _ in 0..20 {
        let mut system = nearly_shared(&mut random);
        let before =
            lowered(&mut system.arena, &system.polynomials, |arena, form| factored(arena, form, First::Atom))
                .operations()
                .weight();
        let results = system.polynomials.iter().enumerate().map(|(k, p)| (result(k), p.clone()));
        let batch = Batch { results: results.collect(), ..Batch::default() };
        let names = varying(&system);
        let mut constants = Constants::new(Quantity::Coefficient);
        let after = straight_line(&mut system.arena, &batch, &mut constants, &|a| names.contains(&a));
        let after = after.operations().weight();
        assert!(after <= before);
        shorter += usize::from(after < before);
    }
    assert!(shorter >= 15);
}

#[test]
fn factoring_keeps_the_value_and_saves_multiplications() {
    let mut random = Random::new(74);
    for _ in 0..ROUNDS {
        let mut system = System::random(&mut random);
        let expected = system.values();
        for k in 0..system.polynomials.len() {
            let polynomial = [system.polynomials[k].clone()];
            let plain = lowered(&mut system.arena, &polynomial, |arena, p| p.expression(arena));
            assert_eq!(outputs(&plain, &system.point), [expected[k].clone()]);
            let plain = plain.operations();
            for first in [First::Atom, First::Number] {
                let factored = |arena: &mut Arena, form: &Polynomial| factored(arena, form, first);
                let short = lowered(&mut system.arena, &polynomial, factored);
                well_formed(&short);
                assert_eq!(outputs(&short, &system.point), [expected[k].clone()]);
                let short = short.operations();
                assert!(short.add <= plain.add && short.weight() <= plain.weight(), "{plain:?} {short:?}");
            }
        }
    }
}

#[test]
fn the_whole_pipeline_keeps_the_value() {
    let mut random = Random::new(75);
    for _ in 0..ROUNDS {
        let mut system = System::random(&mut random);
        let expected = system.values();
        let names = varying(&system);
        // The first polynomial becomes a quantity that the others share.
        let shared = system.arena.symbol(Quantity::Position.at([6]));
        let mut results: Vec<Polynomial> = system.polynomials.clone();
        let first = results[0].clone();
        results
            .iter_mut()
            .skip(1)
            .for_each(|p| p.add_product(&Polynomial::atom(shared), &first, &Rational::ONE));
        let results = results.into_iter().enumerate().map(|(k, p)| (result(k), p)).collect();
        let batch = Batch { shared: vec![(shared, first)], results, ..Batch::default() };
        let mut constants = Constants::new(Quantity::Coefficient);
        let program = straight_line(&mut system.arena, &batch, &mut constants, &|a| names.contains(&a));
        let square = &expected[0] * &expected[0];
        let expected: Vec<Rational> =
            expected.iter().enumerate().map(|(k, v)| if k == 0 { v.clone() } else { v + &square }).collect();
        system.define(&constants.entries);
        well_formed(&program);
        assert_eq!(outputs(&program, &system.point), expected);
        let fused = fuse(&program);
        well_formed(&fused);
        assert_eq!(outputs(&fused, &system.point), expected);
        same_operations(&program, &fused);
        assert_eq!(program.without_dead_steps(), program, "nothing is left over");
    }
}

/// A multiply-add counts as both of its operations: fusing neither adds nor saves any.
fn same_operations(program: &Program, fused: &Program) {
    assert_eq!(program.operations(), fused.operations());
    let unread = |p: &Program| p.uses().iter().filter(|uses| **uses == 0).count();
    assert_eq!((unread(program), unread(fused)), (0, 0));
}

/// Random programs with every operation, dead steps included.
fn random_program(random: &mut Random) -> Program {
    let mut program = Program::default();
    for k in 0..4 {
        program.steps.push(Op::Input(Quantity::Position.at([k + 1])));
    }
    program.steps.push(Op::Constant(own(&fraction(random))));
    for _ in 0..random.integer(5, 25) {
        let mut value =
            || usize::try_from(random.integer(0, i64::try_from(program.steps.len()).unwrap() - 1)).unwrap();
        let (a, b, c) = (value(), value(), value());
        let op = match random.integer(0, 9) {
            0..=3 => Op::Mul(a, b),
            4 | 5 => Op::Add(a, b),
            6 | 7 => Op::Sub(a, b),
            8 => Op::Neg(a),
            _ => Op::MulAdd(a, b, c),
        };
        program.steps.push(op);
    }
    let last = program.steps.len() - 1;
    program.outputs = (0..3).map(|k| (result(k), last - k)).collect();
    program.names = vec![(last - 1, named(0)), (last / 2, named(1))];
    program
}

#[test]
fn fusing_and_pruning_any_program() {
    let mut random = Random::new(76);
    let (mut fused_some, mut pruned_some) = (0, 0);
    for _ in 0..4 * ROUNDS {
        let point = (1..=4).map(|k| (format!("x_{k}"), own(&fraction(&mut random)))).collect();
        let program = random_program(&mut random);
        let expected = outputs(&program, &point);
        let pruned = program.without_dead_steps();
        well_formed(&pruned);
        assert_eq!(outputs(&pruned, &point), expected);
        assert!(pruned.uses().iter().all(|uses| *uses > 0));
        assert!(pruned.operations().weight() <= program.operations().weight());
        pruned_some += usize::from(pruned.steps.len() < program.steps.len());
        let fused = fuse(&pruned);
        well_formed(&fused);
        assert_eq!(outputs(&fused, &point), expected);
        assert_eq!(fused.operations(), pruned.operations());
        let count = |p: &Program| p.steps.iter().filter(|s| matches!(s, Op::MulAdd(..))).count();
        fused_some += usize::from(count(&fused) > count(&pruned));
        // What has a name is still computed, and still called so.
        let named = |p: &Program| p.names.iter().map(|(_, name)| name.clone()).collect::<Vec<_>>();
        assert_eq!(named(&fused), named(&pruned));
    }
    assert!(fused_some > 100 && pruned_some > 100);
}

/// `2 x y + x z - w^3/(x + 1)`, by hand: `x (2 y + z) - w w w/(x + 1)`.
#[test]
fn operations_by_hand() {
    let mut arena = Arena::new();
    let [x, y, z, w] = [1, 2, 3, 4].map(|k| arena.symbol(Quantity::Position.at([k])));
    let one = arena.constant(Rational::ONE);
    let below = arena.add(x, one);
    let quotient = arena.product(&[(w, 3), (below, -1)]).unwrap();
    let [xy, xz] = [y, z].map(|other| arena.mul(x, other));
    let plain =
        arena.linear(&[(xy, Rational::from(2)), (xz, Rational::ONE), (quotient, Rational::MINUS_ONE)]);
    let count = |arena: &Arena, expr| {
        let mut builder = Builder::new();
        builder.output(arena, result(0), expr);
        builder.finish().operations()
    };
    // x y, 2 (x y), x z, w w, w w w; three sums; one quotient.
    assert_eq!(count(&arena, plain), Operations { mul: 5, add: 3, div: 1, ..Operations::default() });
    let mut form = Polynomial::term(vec![x, y], Rational::from(2));
    form.add_term(vec![x, z], &Rational::ONE);
    let short = factored(&mut arena, &form, First::Atom);
    // 2 y, x (...); one sum.
    assert_eq!(count(&arena, short), Operations { mul: 2, add: 1, div: 0, ..Operations::default() });
    assert_eq!(Operations { mul: 5, add: 3, div: 1, ..Operations::default() }.weight(), 16);
    // A change of sign is free, and so is reading an input.
    let minus = arena.neg(x);
    assert_eq!(count(&arena, minus), Operations::default());
    assert_eq!(count(&arena, y), Operations::default());
    // x^3 by two products, x^4 by squares, x^15 as (x^3)^5 or (x^5)^3, x^-2 as 1/(x x).
    for (exponent, mul) in
        [(2, 1), (3, 2), (4, 2), (6, 3), (7, 4), (8, 3), (15, 5), (16, 4), (30, 6), (49, 7)]
    {
        let power = arena.pow(x, exponent).unwrap();
        let found = count(&arena, power);
        assert_eq!(found, Operations { mul, ..Operations::default() }, "x^{exponent}");
    }
    let power = arena.pow(x, -2).unwrap();
    assert_eq!(count(&arena, power), Operations { mul: 1, add: 0, div: 1, ..Operations::default() });
}

/// Powers by few products and one from the other, divided by and multiplied with reciprocals: the same values, exactly.
#[test]
fn powers_are_what_they_are() {
    for exponent in 1..=50 {
        let mut arena = Arena::new();
        let [x, y] = [Quantity::Position, Quantity::LinearMomentum].map(|of| arena.symbol(of));
        let power = arena.product(&[(x, exponent), (y, -exponent)]).unwrap();
        for k in 0..4 {
            let ways = Ways { steps_through_powers: k % 2 == 1, inverts_divisors: k > 1 };
            let mut builder = Builder::by(ways);
            builder.output(&arena, result(0), power);
            let (three, half) = (Rational::from(3), Rational::ratio(1, 2).unwrap());
            let input = |symbol: &Symbol| {
                Some(if symbol.quantity() == Some(Quantity::Position) { three.clone() } else { half.clone() })
            };
            let found = builder.finish().run(&input);
            let expected = (0..exponent).fold(Rational::ONE, |value, _| &value * &Rational::from(6));
            assert_eq!(found, Some(vec![expected]), "x^{exponent}/y^{exponent}");
        }
    }
}

/// Equal subexpressions are computed once, whichever result asks first.
#[test]
fn common_subexpressions_are_shared() {
    let mut arena = Arena::new();
    let [x, y] = [Quantity::Position, Quantity::LinearMomentum].map(|of| arena.symbol(of));
    let sum = arena.add(x, y);
    let (square, cube) = (arena.mul(sum, sum), arena.pow(sum, 3).unwrap());
    let mut builder = Builder::new();
    for (k, value) in [square, cube, sum].into_iter().enumerate() {
        builder.output(&arena, result(k), value);
    }
    let program = builder.finish();
    assert_eq!(program.operations(), Operations { mul: 2, add: 1, div: 0, ..Operations::default() });
}

/// Quotients by cube roots that nothing else reads, of 1 and of something else; one whose root is read twice, one whose root
/// has a name, and a square root stay as they are.
#[test]
fn inverse_cube_roots() {
    let input = |of: Quantity| Op::Input(of.into());
    let steps = vec![
        input(Quantity::Position),
        input(Quantity::LinearMomentum),
        Op::Constant(Rational::ONE),
        Op::Call(Function::Cbrt, 0),
        Op::Div(2, 3),
        Op::Add(0, 1),
        Op::Call(Function::Cbrt, 5),
        Op::Div(1, 6),
        Op::Mul(0, 1),
        Op::Call(Function::Cbrt, 8),
        Op::Div(2, 9),
        Op::Add(9, 10),
        Op::Call(Function::Cbrt, 1),
        Op::Div(2, 12),
        Op::Call(Function::Sqrt, 1),
        Op::Div(2, 14),
    ];
    let outputs = [4, 7, 11, 13, 15].map(|v| (result(v), v)).to_vec();
    let program = Program { steps, names: vec![(12, named(12))], outputs, ..Program::default() };
    let inverted = with_inverse_roots(&program);
    well_formed(&inverted);
    let count = |function: Function| {
        inverted.steps.iter().filter(|step| matches!(step, Op::Call(f, _) if *f == function)).count()
    };
    assert_eq!([Function::InverseCbrt, Function::Cbrt, Function::Sqrt].map(count), [2, 2, 1]);
    assert_eq!(inverted.names.len(), 1);

    // Values, and changes along a direction, which have a rule of their own.
    let point = |symbol: &Symbol| Some(if symbol.to_string().ends_with('x') { 0.7 } else { 1.9 });
    let [plain, other] = [&program, &inverted].map(|program| program.run::<f64>(&point).unwrap());
    let along = |program: &Program| with_tangent(program, &|_| true).run::<f64>(&point).unwrap();
    for (plain, other) in [(plain, other), (along(&program), along(&inverted))] {
        assert!(plain.len() == other.len() && plain.iter().all(|value| value.is_finite() && *value != 0.0));
        assert!(
            plain.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-14 * a.abs()),
            "{plain:?} {other:?}"
        );
    }
}
