//! A dilatation that moves by itself, `q'' = -U_dil'(q)/m`, in closed form.

use crate::algebra::passage::DilatationalMotion;
use crate::algebra::polynomial::add_to;
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::symbol::Quantity;

use super::hamiltonian::Isotropic;

/// The motion of `q` with its momentum `p = tr Sigma`.
#[derive(Clone, Debug)]
pub struct Separation {
    /// `U_dil'`.
    pub slope: Slope,
    /// `1/m = 1/(n (I + A + n B))`.
    pub inverse_mass: Polynomial,
}

/// Derivatives `U_dil'(q)` under which `q'' = -U_dil'(q)/m` has a closed form.
#[derive(Clone, Debug, PartialEq)]
pub enum Slope {
    /// `0`
    Zero,
    /// `stiffness q`
    Linear(Polynomial),
    /// `stiffness sinh(2 scale q)/(2 scale)`
    Hyperbolic {
        /// `U_dil''(0)`.
        stiffness: Polynomial,
        /// Half the power of `D`.
        scale: Rational,
    },
}

impl From<&Slope> for DilatationalMotion {
    fn from(slope: &Slope) -> Self {
        match slope {
            Slope::Zero => Self::Free,
            Slope::Linear(_) => Self::Harmonic,
            Slope::Hyperbolic { .. } => Self::Hyperbolic,
        }
    }
}

impl Slope {
    /// `U_dil'` as an expression in `q`, `D` and `1/D`.
    pub(super) fn derivative(&self, arena: &mut Arena) -> Option<Expr> {
        let [q, up, down] =
            arena.symbols([Quantity::MeanLogStretch, Quantity::Dilatation, Quantity::InverseDilatation]);
        match self {
            Self::Zero => Some(arena.constant(Rational::ZERO)),
            Self::Linear(stiffness) => {
                let stiffness = stiffness.expression(arena);
                arena.product(&[(stiffness, 1), (q, 1)])
            }
            Self::Hyperbolic { stiffness, scale } => {
                // stiffness (D^j - D^-j)/(2 j), j = 2 scale.
                let j = i32::try_from((scale * &Rational::from(2)).to_i64()?).ok()?;
                let weight = Rational::ratio(1, 2 * i64::from(j))?;
                let (up, down) = (arena.pow(up, j)?, arena.pow(down, j)?);
                let difference = arena.linear(&[(up, weight.clone()), (down, -&weight)]);
                let stiffness = stiffness.expression(arena);
                arena.product(&[(stiffness, 1), (difference, 1)])
            }
        }
    }

    /// Reads `U_dil'` off a polynomial in `q`, `D` and `1/D` with coefficients in parameters.
    pub(super) fn of(arena: &mut Arena, slope: &Polynomial) -> Option<Self> {
        let powers = powers(arena, slope)?;
        // Not time, nor q inside other functions.
        if powers.iter().any(|(_, c)| c.any_symbol(arena, &mut |s| !arena.is_parameter(s))) {
            return None;
        }
        match powers.as_slice() {
            [] => Some(Self::Zero),
            [((1, 0), stiffness)] => Some(Self::Linear(stiffness.clone())),
            [((0, low), lower), ((0, high), upper)] if *low == -*high => {
                (*lower == upper.neg()).then(|| Self::hyperbolic(upper, *high))?
            }
            _ => None,
        }
    }

    /// The stiffest slope with a closed form among the terms of a polynomial in `q`, `D`, `1/D` and anything else, as far as numbers
    /// tell: one whose stiffness has fields in it is taken before them. Only what binds the dilatation is taken: what drives it apart
    /// is not stiff, and would leave in a finite time without the rest.
    pub(super) fn stiffest_in(arena: &mut Arena, slope: &Polynomial) -> Option<Self> {
        let powers = powers(arena, slope)?;
        let mut found: Option<(_, Self)> = None;
        for (key, coefficient) in &powers {
            let binding = match *key {
                (1, 0) => binding(arena, coefficient, None),
                (0, 1..) => {
                    let opposite = listed(&powers)((0, -key.1));
                    opposite.map_or_else(Polynomial::zero, |c| binding(arena, coefficient, Some(&c)))
                }
                _ => continue,
            };
            let one = match *key {
                _ if binding.is_zero() => continue,
                (0, power) => Self::hyperbolic(&binding, power)?,
                _ => Self::Linear(binding),
            };
            let stiffness = one.stiffness_by_fields();
            if found.as_ref().is_none_or(|(most, _)| *most <= stiffness) {
                found = Some((stiffness, one));
            }
        }
        found.map(|(_, slope)| slope)
    }

    /// `upper (D^j - D^-j) = 2 upper sinh(j q)`, `j = 2 scale`.
    fn hyperbolic(upper: &Polynomial, j: i64) -> Option<Self> {
        let scale = Rational::ratio(j, 2)?;
        Some(Self::Hyperbolic { stiffness: upper.scaled(&Rational::from(2 * j)), scale })
    }

    /// Is the stiffness set by fields, whose values may be of any size, and what is it where they are all 1?
    fn stiffness_by_fields(&self) -> (bool, Rational) {
        let (Self::Linear(stiffness) | Self::Hyperbolic { stiffness, .. }) = self else {
            return (false, Rational::ZERO);
        };
        let size = stiffness.terms().fold(Rational::ZERO, |size, (_, weight)| &size + weight);
        (stiffness.as_constant().is_none(), size)
    }
}

/// A slope by the powers of `q` and `D`, in their order.
type Powers = Vec<((usize, i64), Polynomial)>;

fn powers(arena: &mut Arena, slope: &Polynomial) -> Option<Powers> {
    let [q, up, down] =
        arena.symbols([Quantity::MeanLogStretch, Quantity::Dilatation, Quantity::InverseDilatation]);
    let mut powers = Powers::new();
    for (monomial, weight) in slope.terms() {
        let count = |symbol: Expr| monomial.iter().filter(|atom| **atom == symbol).count();
        let power = i64::try_from(count(up)).ok()? - i64::try_from(count(down)).ok()?;
        let key = (count(q), power);
        let rest = monomial.iter().copied().filter(|atom| ![q, up, down].contains(atom)).collect();
        add_to(&mut powers, key, &Polynomial::term(rest, weight.clone()));
    }
    powers.retain(|(_, coefficient)| !coefficient.is_zero());
    powers.sort_by_key(|(key, _)| *key);
    Some(powers)
}

/// The terms in parameters alone that are positive and, where an opposite is asked for, as much of them as it has with the
/// other sign.
fn binding(arena: &Arena, coefficient: &Polynomial, opposite: Option<&Polynomial>) -> Polynomial {
    let mut part = Polynomial::zero();
    for (monomial, weight) in coefficient.terms() {
        if monomial.iter().any(|atom| arena.any_symbol(*atom, &mut |s| !arena.is_parameter(s))) {
            continue;
        }
        let against = |(_, w): (_, &Rational)| -w;
        let limit = opposite.map(|o| o.terms().find(|(m, _)| *m == monomial).map_or(Rational::ZERO, against));
        let weight = limit.map_or_else(|| weight.clone(), |limit| weight.clone().min(limit));
        if weight > Rational::ZERO {
            part.add_term(monomial.clone(), &weight);
        }
    }
    part
}

impl Isotropic {
    /// `1/m` of `p^2/(2 m)`, the energy of the dilatational momentum `p = tr Sigma`: `1/(n alpha) + 1/beta`.
    pub(super) fn inverse_dilatational_mass(&self, n: usize) -> Polynomial {
        self.casimir2.scaled(&Rational::one_over(n)).add(&self.casimir1_squared)
    }
}
