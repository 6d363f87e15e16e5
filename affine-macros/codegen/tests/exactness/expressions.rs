//! Constructors of expressions: canonical, and equal in value to what they are asked to build.

use affine_codegen::algebra::evaluate::evaluate;
use affine_codegen::algebra::{Arena, Expr, Polynomial, Rational};
use affine_codegen::symbol::{Quantity, Symbol};
use affine_oracle::Random;

use super::points::{fraction, own};

/// Where to evaluate: a value for each symbol `x_1`, `x_2`, ...
pub(crate) struct Point(Vec<Rational>);

const SYMBOLS: usize = 4;

pub(crate) fn symbol(arena: &mut Arena, k: usize) -> Expr {
    arena.symbol(Quantity::Position.at([k + 1]))
}

impl Point {
    pub(crate) fn random(random: &mut Random) -> Self {
        Point((0..SYMBOLS).map(|_| own(&fraction(random))).collect())
    }

    pub(crate) fn value(&self, symbol: &Symbol) -> Option<Rational> {
        let k = (0..SYMBOLS).find(|k| *symbol == Quantity::Position.at([k + 1]))?;
        Some(self.0[k].clone())
    }

    /// The value of an expression; `None` at a pole.
    pub(crate) fn of(&self, arena: &Arena, expr: Expr) -> Option<Rational> {
        evaluate(arena, expr, &|symbol| self.value(symbol))
    }

    fn shifted(&self, k: usize, step: &Rational) -> Self {
        let mut values = self.0.clone();
        values[k] = &values[k] + step;
        Point(values)
    }
}

/// An expression together with how it was asked for, to be evaluated without the arena.
#[derive(Clone, Debug)]
pub(crate) enum Tree {
    Number(Rational),
    Symbol(usize),
    Sum(Vec<(Tree, Rational)>),
    Product(Vec<(Tree, i32)>),
}

impl Tree {
    pub(crate) fn random(random: &mut Random, depth: usize) -> Self {
        let choice = if depth == 0 { random.integer(0, 3) } else { random.integer(0, 9) };
        let several = |random: &mut Random| -> Vec<Tree> {
            (0..random.integer(1, 3)).map(|_| Tree::random(random, depth.saturating_sub(1))).collect()
        };
        match choice {
            0 => Tree::Number(own(&fraction(random))),
            1..=3 => Tree::Symbol(usize::try_from(random.integer(0, 3)).unwrap()),
            4..=6 => Tree::Sum(
                several(random)
                    .into_iter()
                    .map(|tree| {
                        (tree, if random.bits() & 1 == 0 { Rational::ONE } else { own(&fraction(random)) })
                    })
                    .collect(),
            ),
            _ => Tree::Product(
                several(random).into_iter().map(|tree| (tree, random_exponent(random))).collect(),
            ),
        }
    }

    /// `None` for a negative power of zero.
    pub(crate) fn build(&self, arena: &mut Arena) -> Option<Expr> {
        Some(match self {
            Tree::Number(value) => arena.constant(value.clone()),
            Tree::Symbol(k) => symbol(arena, *k),
            Tree::Sum(summands) => {
                let summands: Vec<(Expr, Rational)> = summands
                    .iter()
                    .map(|(tree, c)| Some((tree.build(arena)?, c.clone())))
                    .collect::<Option<_>>()?;
                arena.linear(&summands)
            }
            Tree::Product(factors) => {
                let factors: Vec<(Expr, i32)> =
                    factors.iter().map(|(tree, e)| Some((tree.build(arena)?, *e))).collect::<Option<_>>()?;
                arena.product(&factors)?
            }
        })
    }

    pub(crate) fn value(&self, point: &Point) -> Option<Rational> {
        match self {
            Tree::Number(value) => Some(value.clone()),
            Tree::Symbol(k) => Some(point.0[*k].clone()),
            Tree::Sum(summands) => summands
                .iter()
                .try_fold(Rational::ZERO, |sum, (tree, c)| Some(&sum + &(&tree.value(point)? * c))),
            Tree::Product(factors) => factors
                .iter()
                .try_fold(Rational::ONE, |product, (tree, e)| Some(&product * &tree.value(point)?.pow(*e)?)),
        }
    }
}

fn random_exponent(random: &mut Random) -> i32 {
    [1, 1, 1, 2, -1, -1, -2, 0][usize::try_from(random.integer(0, 7)).unwrap()]
}

#[test]
fn constructors_keep_the_value() {
    let mut random = Random::new(51);
    let mut compared = 0;
    for _ in 0..400 {
        let mut arena = Arena::new();
        let tree = Tree::random(&mut random, 4);
        let point = Point::random(&mut random);
        let Some(expr) = tree.build(&mut arena) else { continue };
        // A pole of the tree may cancel in the expression, never the other way round.
        if let Some(value) = tree.value(&point) {
            assert_eq!(point.of(&arena, expr), Some(value), "{}", arena.text(expr));
            compared += 1;
        }
    }
    assert!(compared > 300);
}

/// The same sum or product in another order, in parts, or with terms that cancel, is the same node.
#[test]
fn equal_by_the_rules_is_the_same_node() {
    let mut random = Random::new(52);
    let mut cancelled = 0;
    for _ in 0..200 {
        let mut arena = Arena::new();
        let trees: Vec<Tree> = (0..3).map(|_| Tree::random(&mut random, 2)).collect();
        let Some(parts) = trees.iter().map(|t| t.build(&mut arena)).collect::<Option<Vec<_>>>() else {
            continue;
        };
        let [x, y, z] = parts.as_slice() else { panic!("three parts") };
        let arena = &mut arena;
        assert_eq!(arena.add(*x, *y), arena.add(*y, *x));
        assert_eq!(arena.mul(*x, *y), arena.mul(*y, *x));
        let (left, right) = (arena.add(*x, *y), arena.add(*y, *z));
        assert_eq!(arena.add(left, *z), arena.add(*x, right));
        let (left, right) = (arena.mul(*x, *y), arena.mul(*y, *z));
        assert_eq!(arena.mul(left, *z), arena.mul(*x, right));
        let sum = arena.add(*x, *y);
        assert_eq!(arena.sub(sum, *y), *x);
        let minus = arena.neg(*x);
        assert_eq!(arena.neg(minus), *x);
        let rest = arena.add(sum, minus);
        assert_eq!(arena.sub(rest, *y), arena.constant(Rational::ZERO));
        let Some(inverse) = arena.pow(*x, -1) else { continue };
        assert_eq!(arena.mul(*x, inverse), arena.constant(Rational::ONE));
        let product = arena.mul(*x, *y);
        let quotient = arena.div(product, *x).unwrap();
        // A sum comes back as a number times the sum with leading coefficient 1.
        let difference = arena.sub(quotient, *y);
        assert!(Polynomial::normal_form(arena, difference).is_zero());
        cancelled += 1;
    }
    assert!(cancelled > 100);
}

/// Reciprocals of proportional sums share a node: `1/(2a + 2b) = (1/2) (1/(a + b))`.
#[test]
fn reciprocals_of_multiples() {
    let mut arena = Arena::new();
    let (a, b) = (symbol(&mut arena, 0), symbol(&mut arena, 1));
    let half = Rational::ratio(1, 2).unwrap();
    let three = Rational::from(3);
    for weight in [Rational::from(2), Rational::MINUS_ONE, Rational::ratio(-5, 3).unwrap()] {
        let once = arena.linear(&[(a, Rational::ONE), (b, three.clone())]);
        let scaled = arena.linear(&[(a, weight.clone()), (b, &three * &weight)]);
        let (left, right) = (arena.pow(scaled, -1).unwrap(), arena.pow(once, -1).unwrap());
        let right = arena.scale(right, &weight.recip().unwrap());
        assert_eq!(left, right, "{}", arena.text(left));
        let quotient = arena.div(scaled, once).unwrap();
        let expected = arena.constant(weight);
        let point = Point(vec![half.clone(), three.clone(), Rational::ONE, Rational::ONE]);
        assert_eq!(point.of(&arena, quotient), point.of(&arena, expected));
    }
    let zero = arena.constant(Rational::ZERO);
    assert_eq!(arena.pow(zero, -1), None);
    assert_eq!(arena.div(a, zero), None);
    assert_eq!(arena.pow(zero, 2), Some(zero));
}

/// `f' = lim (f(s + h) - f(s))/h`, in exact arithmetic through dual numbers.
#[test]
fn derivatives() {
    let mut random = Random::new(53);
    let mut compared = 0;
    for _ in 0..300 {
        let mut arena = Arena::new();
        let tree = Tree::random(&mut random, 3);
        let point = Point::random(&mut random);
        let k = usize::try_from(random.integer(0, 3)).unwrap();
        let Some(expr) = tree.build(&mut arena) else { continue };
        let s = symbol(&mut arena, k);
        let slope = arena.derivative(expr, s);
        let Some((_, expected)) = dual(&tree, &point, k) else { continue };
        let gradient = arena.gradient(expr, &|symbol| symbol == s);
        // What the canonical form cancelled has no slope.
        let met = gradient.first().map_or(Some(Rational::ZERO), |(_, slope)| point.of(&arena, *slope));
        let what = format!("d/d{} of {}", arena.text(s), arena.text(expr));
        assert_eq!(met.as_ref(), Some(&expected), "{what}, from the whole to its parts");
        assert_eq!(point.of(&arena, slope), Some(expected), "{what}");
        compared += 1;
    }
    assert!(compared > 200);
}

/// Value and derivative of a tree, by the rules for sums and powers alone.
fn dual(tree: &Tree, point: &Point, k: usize) -> Option<(Rational, Rational)> {
    match tree {
        Tree::Number(value) => Some((value.clone(), Rational::ZERO)),
        Tree::Symbol(s) => Some((point.0[*s].clone(), if *s == k { Rational::ONE } else { Rational::ZERO })),
        Tree::Sum(summands) => {
            summands.iter().try_fold((Rational::ZERO, Rational::ZERO), |sum, (tree, c)| {
                let (value, slope) = dual(tree, point, k)?;
                Some((&sum.0 + &(&value * c), &sum.1 + &(&slope * c)))
            })
        }
        Tree::Product(factors) => {
            factors.iter().try_fold((Rational::ONE, Rational::ZERO), |product, (tree, e)| {
                let (value, slope) = dual(tree, point, k)?;
                let power = value.pow(*e)?;
                let power_slope = match *e {
                    0 => Rational::ZERO,
                    e => &(&Rational::from(i64::from(e)) * &value.pow(e - 1)?) * &slope,
                };
                Some((&product.0 * &power, &(&product.1 * &power) + &(&product.0 * &power_slope)))
            })
        }
    }
}

/// A quadratic's derivative is its central difference quotient, whatever the step.
#[test]
fn difference_quotients_of_quadratics() {
    let mut random = Random::new(54);
    for _ in 0..50 {
        let mut arena = Arena::new();
        let arena = &mut arena;
        let symbols: Vec<Expr> = (0..SYMBOLS).map(|k| symbol(arena, k)).collect();
        let mut summands = Vec::new();
        for x in &symbols {
            for y in &symbols {
                summands.push((arena.mul(*x, *y), own(&fraction(&mut random))));
            }
            summands.push((*x, own(&fraction(&mut random))));
        }
        let quadratic = arena.linear(&summands);
        let (point, step) = (Point::random(&mut random), own(&fraction(&mut random)));
        for (k, s) in symbols.iter().enumerate() {
            let slope = arena.derivative(quadratic, *s);
            let ahead = point.shifted(k, &step).of(arena, quadratic).unwrap();
            let behind = point.shifted(k, &-&step).of(arena, quadratic).unwrap();
            let quotient = (&ahead - &behind).checked_div(&(&step + &step));
            assert_eq!(point.of(arena, slope), quotient);
        }
    }
}
