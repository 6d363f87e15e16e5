//! Powers of `D = det^(1/n)` through `det`, `1/det` and `1/D`: `D^n = det`, and a root only where a fractional power of `det` is
//! asked for.

use crate::algebra::arena::Node;
use crate::algebra::rational::exponent;
use crate::algebra::ring::{adjugate, dot};
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::metric::Definitions;
use crate::symbol::Quantity;

use super::base::Base;
use super::scaled::collected;

/// The symbols of one volume.
#[derive(Clone, Copy)]
pub(super) struct Volume {
    pub(super) n: usize,
    pub(super) det: Expr,
    pub(super) inverse_det: Expr,
    pub(super) d: Expr,
    pub(super) inverse_d: Expr,
}

impl Volume {
    pub(super) fn new(arena: &mut Arena, n: usize) -> Self {
        let [det, inverse_det, d, inverse_d] = arena.symbols([
            Quantity::Determinant,
            Quantity::InverseDeterminant,
            Quantity::Dilatation,
            Quantity::InverseDilatation,
        ]);
        Self { n, det, inverse_det, d, inverse_d }
    }

    /// The normal form of an expression in powers of `D` and `1/D`.
    pub(super) fn collected(&self, arena: &mut Arena, expr: Expr) -> Polynomial {
        let reciprocal = arena.reciprocal(self.d);
        let inverse_d = self.inverse_d;
        // Powers of D are not zero.
        let expr = arena.replaced(expr, &|s| (s == inverse_d).then_some(reciprocal));
        let form = collected(arena, expr, self.d);
        let mut result = Polynomial::zero();
        for (monomial, c) in form.terms() {
            let monomial = monomial.iter().map(|atom| if *atom == reciprocal { inverse_d } else { *atom });
            // Divisors and the arguments of functions too.
            let factors: Vec<Expr> =
                monomial.map(|atom| if atom == self.d { atom } else { self.rebuilt(arena, atom) }).collect();
            result.add_term(factors, c);
        }
        self.reduced(&result)
    }

    /// The expression with each power of `D` in one form.
    fn rebuilt(&self, arena: &mut Arena, expr: Expr) -> Expr {
        match arena.node(expr).clone() {
            Node::Symbol(_) if expr == self.d => self.power(arena, 1),
            Node::Product(factors) => {
                let mut product = Vec::with_capacity(factors.len());
                for (base, exponent) in factors {
                    product.push(match base == self.d {
                        true => (self.power(arena, exponent), 1),
                        false => (self.rebuilt(arena, base), exponent),
                    });
                }
                // The bases keep their values, and were not the number zero.
                arena.certain_product(&product)
            }
            _ => arena.rebuilt(expr, &mut |arena, part| self.rebuilt(arena, part)),
        }
    }

    /// `D^exponent`.
    fn power(&self, arena: &mut Arena, exponent: i32) -> Expr {
        let factors: Vec<(Expr, i32)> = self.factors(exponent).into_iter().map(|atom| (atom, 1)).collect();
        arena.certain_product(&factors)
    }

    /// The atoms of `D^power`.
    fn factors(&self, power: i32) -> Vec<Expr> {
        let Self { det, inverse_det, inverse_d, .. } = *self;
        let n = exponent(self.n);
        let (whole, rest) = match power {
            // D^k = det^m (1/D)^(n m - k)
            1.. => ((det, power.div_euclid(n) + i32::from(power % n != 0)), (-power).rem_euclid(n)),
            _ => ((inverse_det, -power / n), -power % n),
        };
        let times = |count: i32| count.unsigned_abs() as usize;
        let mut atoms = vec![whole.0; times(whole.1)];
        atoms.extend(vec![inverse_d; times(rest)]);
        atoms
    }

    /// The polynomial with each power of `D` in one form.
    pub(super) fn reduced(&self, form: &Polynomial) -> Polynomial {
        let n = exponent(self.n);
        let mut result = Polynomial::zero();
        for (monomial, c) in form.terms() {
            let mut exponent = 0;
            let mut kept = Vec::with_capacity(monomial.len());
            for atom in monomial {
                match *atom {
                    a if a == self.det => exponent += n,
                    a if a == self.inverse_det => exponent -= n,
                    a if a == self.d => exponent += 1,
                    a if a == self.inverse_d => exponent -= 1,
                    other => kept.push(other),
                }
            }
            kept.extend(self.factors(exponent));
            result.add_term(kept, c);
        }
        result
    }

    /// `det`, `1/D`, `D`, `1/det` and `q`, with one root where there is any.
    pub(super) fn definitions(&self, arena: &mut Arena, chart: &Chart, uses_root: bool) -> Definitions {
        let n = self.n;
        let Self { det, inverse_det, d, inverse_d, .. } = *self;
        let root = arena.apply(if n == 2 { Function::Sqrt } else { Function::Cbrt }, det);
        let logarithm = arena.apply(Function::Ln, det);
        let nth = Rational::one_over(n);
        // Symbols and functions of symbols are not the number zero.
        let reciprocal = |arena: &mut Arena, of: Expr| Polynomial::atom(arena.reciprocal(of));
        let inverse = match uses_root {
            true => Polynomial::term(vec![inverse_d; n], Rational::ONE),
            false => reciprocal(arena, det),
        };
        let determinant = dot(chart.placement()[0].iter().zip(&first_cofactors(arena, chart)));
        let product = [vec![inverse_d; n - 1], vec![det]].concat();
        vec![
            (det, determinant),
            (inverse_d, reciprocal(arena, root)),
            (d, Polynomial::monomial(product)),
            (inverse_det, inverse),
            (Base::MeanLogStretch.symbol(arena), Polynomial::term(vec![logarithm], nth)),
        ]
    }
}

/// The cofactors of the first row of `phi`. The forces on `Pi` contain the cofactors themselves; elsewhere the determinant alone
/// is needed.
pub(super) fn first_cofactors(arena: &mut Arena, chart: &Chart) -> Vec<Polynomial> {
    match chart.momentum {
        Momentum::Canonical => Matrix::symbols(arena, Quantity::Cofactor, chart.dim).atoms().swap_remove(0),
        _ => adjugate(&chart.placement()).iter().map(|row| row[0].clone()).collect(),
    }
}
