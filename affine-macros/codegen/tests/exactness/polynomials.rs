//! The polynomial normal form against the evaluator.

use affine_codegen::algebra::evaluate::evaluate_polynomial;
use affine_codegen::algebra::{Arena, Expr, Polynomial, Rational};
use affine_codegen::symbol::Symbol;
use affine_oracle::Random;

use super::expressions::{Point, Tree, symbol};
use super::points::{fraction, own};

fn value(arena: &Arena, polynomial: &Polynomial, point: &Point) -> Option<Rational> {
    evaluate_polynomial(arena, polynomial, &|symbol| point.value(symbol))
}

/// A random polynomial of degree at most three in four symbols.
fn random_polynomial(random: &mut Random, arena: &mut Arena) -> Polynomial {
    let mut sum = Polynomial::zero();
    for _ in 0..random.integer(0, 6) {
        let atoms: Vec<Expr> = (0..random.integer(0, 3))
            .map(|_| {
                let k = usize::try_from(random.integer(0, 3)).unwrap();
                symbol(arena, k)
            })
            .collect();
        sum.add_term(atoms, &own(&fraction(random)));
    }
    sum
}

#[test]
fn the_normal_form_has_the_value_of_the_expression() {
    let mut random = Random::new(61);
    let mut compared = 0;
    for _ in 0..300 {
        let mut arena = Arena::new();
        let tree = Tree::random(&mut random, 3);
        let Some(expr) = tree.build(&mut arena) else { continue };
        let form = Polynomial::normal_form(&mut arena, expr);
        let back = form.expression(&mut arena);
        let point = Point::random(&mut random);
        let Some(expected) = point.of(&arena, expr) else { continue };
        assert_eq!(value(&arena, &form, &point), Some(expected.clone()), "{}", arena.text(expr));
        assert_eq!(point.of(&arena, back), Some(expected), "{}", arena.text(expr));
        compared += 1;
    }
    assert!(compared > 200);
}

/// Expanding decides equality: `(x + y)(x - y) = x^2 - y^2`, term by term.
#[test]
fn equal_polynomials_have_equal_forms() {
    let mut random = Random::new(62);
    for _ in 0..100 {
        let mut arena = Arena::new();
        let [x, y] = [0, 1].map(|_| random_polynomial(&mut random, &mut arena));
        let [a, b] = [&x, &y].map(|p| p.expression(&mut arena));
        let (sum, difference) = (arena.add(a, b), arena.sub(a, b));
        let product = arena.mul(sum, difference);
        let squares = [a, b].map(|e| arena.mul(e, e));
        let expected = arena.sub(squares[0], squares[1]);
        let (left, right) =
            (Polynomial::normal_form(&mut arena, product), Polynomial::normal_form(&mut arena, expected));
        assert_eq!(left, right);
        let mut by_hand = x.mul(&x);
        by_hand.add_product(&y, &y, &Rational::MINUS_ONE);
        assert_eq!(left, by_hand);
        let mut nothing = left.clone();
        nothing.add_scaled(&right, &Rational::MINUS_ONE);
        assert!(nothing.is_zero() && nothing.terms().len() == 0);
        assert!(left.terms().all(|(_, c)| !c.is_zero()), "no zero is stored");
    }
}

#[test]
fn ring_operations_and_derivatives() {
    let mut random = Random::new(63);
    for _ in 0..100 {
        let mut arena = Arena::new();
        let [x, y] = [0, 1].map(|_| random_polynomial(&mut random, &mut arena));
        let weight = own(&fraction(&mut random));
        let point = Point::random(&mut random);
        let of = |p: &Polynomial, arena: &Arena| value(arena, p, &point).unwrap();
        let mut sum = x.clone();
        sum.add_scaled(&y, &weight);
        assert_eq!(of(&sum, &arena), &of(&x, &arena) + &(&weight * &of(&y, &arena)));
        assert_eq!(of(&x.mul(&y), &arena), &of(&x, &arena) * &of(&y, &arena));
        assert_eq!(of(&x.scaled(&weight), &arena), &of(&x, &arena) * &weight);
        let mut plus = y.clone();
        plus.add_product(&x, &x, &weight);
        assert_eq!(of(&plus, &arena), &of(&y, &arena) + &(&weight * &(&of(&x, &arena) * &of(&x, &arena))));
        let expr = x.expression(&mut arena);
        for k in 0..4 {
            let s = symbol(&mut arena, k);
            let slope = arena.derivative(expr, s);
            let slope = Polynomial::normal_form(&mut arena, slope);
            assert_eq!(x.derivative(s), slope);
            assert_eq!(x.mentions(|atom| atom == s), x.terms().any(|(m, _)| m.contains(&s)));
        }
        let constant = x.as_constant();
        assert_eq!(constant.is_some(), x.terms().all(|(m, _)| m.is_empty()));
        if let Some(constant) = constant {
            assert_eq!(constant, of(&x, &arena));
        }
    }
}

/// Substituting polynomials and evaluating is evaluating where the atoms have their values, all at once.
#[test]
fn substitution() {
    let mut random = Random::new(64);
    for _ in 0..100 {
        let mut arena = Arena::new();
        let form = random_polynomial(&mut random, &mut arena);
        // x_1 and x_2 are replaced, each by a polynomial that contains both again.
        let images = [0, 1].map(|_| random_polynomial(&mut random, &mut arena));
        let replaced = form.substitute(&|atom| match arena.as_symbol(atom) {
            Some(Symbol::Component(_, place)) if place[0] <= 2 => Some(images[place[0] - 1].clone()),
            _ => None,
        });
        let point = Point::random(&mut random);
        let expected = evaluate_polynomial(&arena, &form, &|symbol| match symbol {
            Symbol::Component(_, place) if place[0] <= 2 => value(&arena, &images[place[0] - 1], &point),
            _ => point.value(symbol),
        });
        assert_eq!(value(&arena, &replaced, &point), expected);
    }
}
