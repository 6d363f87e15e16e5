//! Symmetric polynomials in log-stretches and stretches, through `q`, `tr G` and `tr G^2` where they are such functions.

use std::collections::BTreeMap;

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
    let mut laurent: BTreeMap<Vec<Rational>, Rational> = BTreeMap::new();
    for ((rest, exponents), c) in through_sum(n, part) {
        if rest.iter().any(|power| *power > 0) {
            return None;
        }
        laurent.insert(exponents, c);
    }
    let value = even_powers(arena, n, laurent)?;
    let mut sum = Key::one(n);
    let count = Rational::from(i64::try_from(n).ok()?).pow(i32::try_from(degree).ok()?)?;
    if degree > 0 {
        sum.others.push((Base::MeanLogStretch.symbol(arena), i32::try_from(degree).ok()?));
    }
    Some(value.mul(&Form::term(sum, count)))
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

/// The part in terms of `s = q_1 + ... + q_n` and `q_2, ..., q_n`: exponents of those, for one power of `s`.
fn through_sum(n: usize, part: &Part) -> Part {
    let mut result = Part::new();
    for ((powers, exponents), c) in part {
        // Exponents of s and q_2, ..., q_n; q_1 = s - q_2 - ... - q_n.
        let mut sum: BTreeMap<Vec<u32>, Rational> = BTreeMap::from([(vec![0; n], c.clone())]);
        for _ in 0..powers[0] {
            let mut next: BTreeMap<Vec<u32>, Rational> = BTreeMap::new();
            for (monomial, c) in &sum {
                for k in 0..n {
                    let mut monomial = monomial.clone();
                    monomial[k] += 1;
                    let held = next.entry(monomial).or_insert(Rational::ZERO);
                    *held = if k == 0 { &*held + c } else { &*held - c };
                }
            }
            sum = next;
        }
        for (monomial, c) in sum {
            let rest: Vec<u32> = monomial[1..].iter().zip(&powers[1..]).map(|(a, b)| a + b).collect();
            let held = result.entry((rest, exponents.clone())).or_insert(Rational::ZERO);
            *held = &*held + &c;
        }
    }
    result.retain(|_, c| !c.is_zero());
    result
}

/// `sum c prod Q_a^(r + 2 k_a)`, symmetric, with integers `k_a >= 0`: Gauss's algorithm for the fundamental theorem on
/// symmetric polynomials, in the invariants `I_k = e_k(Q^2)`. Exponents that no one writes out as products are left alone.
fn even_powers(arena: &mut Arena, n: usize, laurent: BTreeMap<Vec<Rational>, Rational>) -> Option<Form> {
    let least = laurent.keys().flatten().min()?.clone();
    let half = Rational::HALF;
    let mut open: BTreeMap<Vec<u32>, Rational> = BTreeMap::new();
    for (exponents, c) in laurent {
        let doubled = |exponent: &Rational| {
            let k = &(exponent - &least) * &half;
            let k = k.is_integer().then(|| k.to_i64()).flatten().and_then(|k| u32::try_from(k).ok())?;
            (2 * u64::from(k) <= u64::from(HIGHEST_MULTIPLE)).then_some(k)
        };
        open.insert(exponents.iter().map(doubled).collect::<Option<Vec<u32>>>()?, c);
    }
    let elementary: Vec<Form> = (1..n).map(|k| invariant(arena, n, k)).collect::<Option<_>>()?;
    let mut result = Form::default();
    while let Some((leading, c)) = open.pop_last() {
        // prod e_k^(a_k - a_(k+1)) has the same leading monomial.
        let steps: Vec<u32> = (0..n)
            .map(|k| leading[k].checked_sub(*leading.get(k + 1).unwrap_or(&0)))
            .collect::<Option<_>>()?;
        let mut value = Form::term(Key::one(n), c.clone());
        for (e, step) in elementary.iter().zip(&steps) {
            value = value.mul(&e.power(n, *step));
        }
        let mut determinant = Key::one(n);
        let power = &least + &Rational::from(2 * i64::from(steps[n - 1]));
        determinant.exponents[n] = &power * &Rational::from(i64::try_from(n).ok()?);
        result.add_scaled(&value.mul(&Form::term(determinant, Rational::ONE)), &Rational::ONE);
        open.insert(leading, c.clone());
        for (monomial, weight) in expanded(n, &steps) {
            let held = open.entry(monomial.clone()).or_insert(Rational::ZERO);
            *held = &*held - &(&weight * &c);
            if held.is_zero() {
                open.remove(&monomial);
            }
        }
    }
    Some(result)
}

/// `I_k` in `tr G` and `tr G^2`, `k < n <= 3`.
fn invariant(arena: &mut Arena, n: usize, k: usize) -> Option<Form> {
    let [first, second] = [Base::Trace, Base::TraceOfSquare].map(|base| base.symbol(arena));
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

/// `prod e_k(y)^(steps_k)` multiplied out.
fn expanded(n: usize, steps: &[u32]) -> BTreeMap<Vec<u32>, Rational> {
    let mut product: BTreeMap<Vec<u32>, Rational> = BTreeMap::from([(vec![0; n], Rational::ONE)]);
    for (k, step) in steps.iter().enumerate() {
        let chosen = (0..1usize << n).filter(|subset| subset.count_ones() as usize == k + 1);
        for _ in 0..*step {
            let mut next: BTreeMap<Vec<u32>, Rational> = BTreeMap::new();
            for subset in chosen.clone() {
                for (monomial, c) in &product {
                    let monomial =
                        (0..n).map(|a| monomial[a] + u32::from(subset >> a & 1 == 1)).collect::<Vec<u32>>();
                    let held = next.entry(monomial).or_insert(Rational::ZERO);
                    *held = &*held + c;
                }
            }
            product = next;
        }
    }
    product
}
