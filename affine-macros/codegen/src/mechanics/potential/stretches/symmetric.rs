//! Symmetric polynomials in log-stretches and stretches, through `q`, `tr G` and `tr G^2` where they are such functions.

use std::collections::BTreeMap;

use crate::algebra::rational::exponent;
use crate::algebra::{Arena, Expr, Rational};
use crate::mechanics::potential::base::{Base, HIGHEST_MULTIPLE, log_stretches};

use super::form::{Form, Key};

/// Exponents of `q_a` and of `Q_a`, with a coefficient each.
type Part = BTreeMap<(Vec<u32>, Vec<Rational>), Rational>;

/// Writes every homogeneous part of `form` that is a function of `sum q_a = n q` and a symmetric polynomial of even powers
/// of the stretches, up to a power of `Q_1 ... Q_n = exp(n q)`, in terms of `q`, `tr G` and `tr G^2`.
pub(super) fn through_traces(arena: &mut Arena, n: usize, form: Form) -> Form {
    let stretches = log_stretches(arena, n);
    let mut result = Form::default();
    let mut parts: BTreeMap<(Key, u32, Rational), Part> = BTreeMap::new();
    for (key, c) in form.terms {
        let plain =
            key.powers.iter().all(|power| *power == 0) && key.exponents[..n].iter().all(Rational::is_zero);
        let inside = key
            .others
            .iter()
            .any(|(factor, _)| arena.any_symbol(*factor, &mut |symbol| stretches.contains(&symbol)));
        if plain || inside {
            result.add(key, &c);
            continue;
        }
        let mut outside = Key { others: key.others, ..Key::one(n) };
        outside.exponents[n] = key.exponents[n].clone();
        let degree = key.powers.iter().sum();
        let growth = key.exponents[..n].iter().fold(Rational::ZERO, |sum, c| &sum + c);
        let part = parts.entry((outside, degree, growth)).or_default();
        part.insert((key.powers, key.exponents[..n].to_vec()), c);
    }
    for ((outside, degree, _), part) in parts {
        match written(arena, n, degree, &part) {
            Some(value) => result.add_scaled(&value.mul(&Form::term(outside, Rational::ONE)), &Rational::ONE),
            None => {
                for ((powers, exponents), c) in part {
                    let mut key = Key { powers, ..outside.clone() };
                    key.exponents[..n].clone_from_slice(&exponents);
                    result.add(key, &c);
                }
            }
        }
    }
    result
}

/// The part as `(n q)^degree` times a symmetric function of even powers of the stretches, if it is one.
fn written(arena: &mut Arena, n: usize, degree: u32, part: &Part) -> Option<Form> {
    if !is_symmetric(n, part) {
        return None;
    }
    let value = even_powers(arena, n, over_power_of_sum(n, degree, part)?)?;
    let exponent = i32::try_from(degree).ok()?;
    let mut sum = Key::one(n);
    if degree > 0 {
        sum.others.push((Base::MeanLogStretch.symbol(arena), exponent));
    }
    Some(value.mul(&Form::term(sum, Rational::whole(n).pow(exponent)?)))
}

/// Unchanged by exchanges of neighbours, which make all permutations.
fn is_symmetric(n: usize, part: &Part) -> bool {
    (1..n).all(|b| {
        part.iter().all(|((powers, exponents), c)| {
            let (mut powers, mut exponents) = (powers.clone(), exponents.clone());
            powers.swap(b - 1, b);
            exponents.swap(b - 1, b);
            part.get(&(powers, exponents)) == Some(c)
        })
    })
}

/// What of exponentials stands beside `(q_1 + ... + q_n)^degree`, if the part is such a product: by the multinomial theorem.
fn over_power_of_sum(n: usize, degree: u32, part: &Part) -> Option<BTreeMap<Vec<Rational>, Rational>> {
    let leading = part.iter().filter(|((powers, _), _)| powers[0] == degree);
    let quotient: BTreeMap<Vec<Rational>, Rational> =
        leading.map(|((_, exponents), c)| (exponents.clone(), c.clone())).collect();
    let agrees = part.iter().all(|((powers, exponents), c)| {
        quotient.get(exponents).is_some_and(|leading| *c == leading * &multinomial(powers))
    });
    // None of the monomials of the power is missing.
    let monomials = multinomial(&[degree, exponent(n - 1).unsigned_abs()]);
    let count = &monomials * &Rational::whole(quotient.len());
    (agrees && count == Rational::whole(part.len())).then_some(quotient)
}

/// `(k_1 + ... + k_n)!/(k_1! ... k_n!)`
fn multinomial(powers: &[u32]) -> Rational {
    let factors = powers.iter().flat_map(|power| 1..=*power as usize).zip(1..);
    factors.fold(Rational::ONE, |product, (below, above)| {
        &product * &(&Rational::whole(above) * &Rational::one_over(below))
    })
}

/// `sum c prod Q_a^(r + 2 k_a)`, symmetric, with integers `k_a >= 0`: Gauss's algorithm for the fundamental theorem on
/// symmetric polynomials, in the invariants `I_k = e_k(Q^2)`. Exponents that no one writes out as products are left alone.
fn even_powers(arena: &mut Arena, n: usize, laurent: BTreeMap<Vec<Rational>, Rational>) -> Option<Form> {
    let least = laurent.keys().flatten().min()?.clone();
    let half = Rational::HALF;
    // In powers of Q^2.
    let mut open = Form::default();
    for (exponents, c) in laurent {
        let doubled = |exponent: &Rational| {
            let k = &(exponent - &least) * &half;
            let k = k.is_integer().then(|| k.to_i64()).flatten().and_then(|k| u32::try_from(k).ok())?;
            (2 * u64::from(k) <= u64::from(HIGHEST_MULTIPLE)).then_some(k)
        };
        let powers = exponents.iter().map(doubled).collect::<Option<_>>()?;
        open.add(Key { powers, ..Key::one(n) }, &c);
    }
    let invariants: Vec<Form> = (1..n).map(|k| invariant(arena, n, k)).collect::<Option<_>>()?;
    let mut result = Form::default();
    while let Some((leading, c)) = open.terms.last_key_value() {
        // prod e_k^(a_k - a_(k+1)) has the same leading monomial.
        let leading = &leading.powers;
        let steps: Vec<u32> = (0..n)
            .map(|k| leading[k].checked_sub(*leading.get(k + 1).unwrap_or(&0)))
            .collect::<Option<_>>()?;
        let mut determinant = Key::one(n);
        let power = &least + &Rational::from(2 * i64::from(steps[n - 1]));
        determinant.exponents[n] = &power * &Rational::whole(n);
        let mut value = Form::term(determinant, c.clone());
        let mut expanded = Form::term(Key::one(n), -c);
        for (k, step) in steps.iter().enumerate() {
            expanded = expanded.mul(&elementary(n, k + 1).power(n, *step));
        }
        for (invariant, step) in invariants.iter().zip(&steps) {
            value = value.mul(&invariant.power(n, *step));
        }
        result.add_scaled(&value, &Rational::ONE);
        open.add_scaled(&expanded, &Rational::ONE);
    }
    Some(result)
}

/// `e_k` of what a key has the powers of.
fn elementary(n: usize, k: usize) -> Form {
    let mut sum = Form::default();
    for subset in (0..1u32 << n).filter(|subset| subset.count_ones() as usize == k) {
        let powers = (0..n).map(|a| subset >> a & 1).collect();
        sum.add(Key { powers, ..Key::one(n) }, &Rational::ONE);
    }
    sum
}

/// `I_k` in `tr G` and `tr G^2`, `k < n <= 3`.
fn invariant(arena: &mut Arena, n: usize, k: usize) -> Option<Form> {
    let [first, second] = [1, 2].map(|power| Base::Trace(power).symbol(arena));
    let factor = |symbol: Expr, power: i32| Key { others: vec![(symbol, power)], ..Key::one(n) };
    match k {
        1 => Some(Form::term(factor(first, 1), Rational::ONE)),
        2 => {
            let half = Rational::HALF;
            let mut value = Form::term(factor(first, 2), half.clone());
            value.add(factor(second, 1), &-&half);
            Some(value)
        }
        _ => None,
    }
}
