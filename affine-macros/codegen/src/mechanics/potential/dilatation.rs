//! What of a potential is a function of `q` with a motion in closed form.

use crate::algebra::evaluate::Field;
use crate::algebra::residue::{Residue, depends_on};
use crate::algebra::vanishing::vanishes;
use crate::algebra::{Arena, Polynomial, Rational};

use super::rewriting::through_dilatation;
use super::sums::Sums;
use super::{Base, Potential};
use crate::mechanics::separation::Slope;
use crate::symbol::{Quantity, Symbol};

impl Potential {
    /// `U_dil'(q)` where `U = U_dil(q) + U_sh(Psi)` and the closed form of its motion is known: the derivative along
    /// `phi -> e^s phi`, `dU/dq + 2 tr G dU/d(tr G) + ..`, is then a function of `q` alone.
    pub(in crate::mechanics) fn dilatational_slope(&self, arena: &mut Arena) -> Option<Slope> {
        let mut terms = Vec::new();
        for (base, partial) in &self.slopes {
            let partial = through_dilatation(arena, *partial);
            let symbol = base.symbol(arena);
            match base {
                Base::MeanLogStretch => terms.push((partial, Rational::ONE)),
                // The centre of mass stays where it is.
                Base::Position(_) => {}
                // The axes of single stretches are those of phi, not of Psi.
                Base::LogStretch(_) => return None,
                _ => terms.push((arena.mul(partial, symbol), Rational::whole(base.degree()))),
            }
        }
        let slope = arena.linear(&terms);
        let others: Vec<Symbol> = Base::all(self.dim).into_iter().map(Base::quantity).collect();
        let sample = |symbol: &Symbol| Residue::sample(&symbol.to_string());
        let kept = |symbol: &Symbol| match symbol.quantity() {
            Some(Quantity::InverseDilatation) => sample(&Quantity::Dilatation.into()).recip(),
            Some(Quantity::MeanLogStretch) => Some(sample(symbol)),
            _ => (!others.contains(symbol)).then(|| sample(symbol)),
        };
        if depends_on(arena, slope, &kept) {
            return None;
        }
        let slope = Polynomial::normal_form(arena, slope);
        let mut is_another = |symbol| arena.as_symbol(symbol).is_some_and(|symbol| kept(symbol).is_none());
        if slope.any_symbol(arena, &mut is_another) {
            return None;
        }
        Slope::of(arena, &slope)
    }

    /// `U_dil'(q)` and `W`, of which the forces alone are meant, where `U = U_dil(q) + W` and the closed form of the motion
    /// under `U_dil` is known. `W` is what no dilatation changes where there is such a sum; else `U_dil` is the stiffest among
    /// the terms in `q` alone.
    pub(in crate::mechanics) fn own_dilatation(&self, arena: &mut Arena) -> Option<(Slope, Self)> {
        let place = self.slopes.iter().position(|(base, _)| *base == Base::MeanLogStretch)?;
        let slope = match self.dilatational_slope(arena) {
            Some(Slope::Zero) => return None,
            Some(slope) => slope,
            None => {
                let partial = through_dilatation(arena, self.slopes[place].1);
                let partial = Sums::default().named(arena, partial);
                let partial = Polynomial::normal_form(arena, partial);
                Slope::stiffest_in(arena, &partial)?
            }
        };
        let own = slope.derivative(arena)?;
        // The other slopes hold all of it.
        let mut rest = Self { other_slopes: None, ..self.clone() };
        let partial = &mut rest.slopes[place].1;
        *partial = arena.linear(&[(*partial, Rational::ONE), (own, Rational::MINUS_ONE)]);
        let left = through_dilatation(arena, *partial);
        if vanishes(arena, left) {
            rest.slopes.remove(place);
        }
        Some((slope, rest))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::algebra::{Expr, Function};

    /// A sum of `c q^2`, `c sinh(q)^2`, `c exp(-2q)`, `c q` and any other terms.
    struct Sum(Arena, Vec<(Expr, Rational)>);

    impl Sum {
        fn new() -> Self {
            Self(Arena::new(), Vec::new())
        }

        fn plus(mut self, factors: &[(Factor, i32)], weight: (i64, i64)) -> Self {
            let arena = &mut self.0;
            let q = arena.symbol(Quantity::MeanLogStretch);
            let factors: Vec<_> = factors
                .iter()
                .map(|(factor, power)| match factor {
                    Factor::Sinh => (arena.apply(Function::Sinh, q), *power),
                    Factor::Exp => {
                        let argument = arena.scale(q, &Rational::from(i64::from(*power)));
                        (arena.apply(Function::Exp, argument), 1)
                    }
                    Factor::Symbol(symbol) => (arena.symbol(symbol.clone()), *power),
                })
                .collect();
            let product = arena.product(&factors).unwrap();
            self.1.push((product, Rational::ratio(weight.0, weight.1).unwrap()));
            self
        }

        /// What is taken of it, and how many base functions are left.
        fn own(mut self) -> Option<(Slope, usize)> {
            let energy = self.0.linear(&self.1);
            let potential = Potential::new(&mut self.0, 3, energy);
            let (slope, rest) = potential.own_dilatation(&mut self.0)?;
            Some((slope, rest.slopes.len()))
        }
    }

    enum Factor {
        Sinh,
        Exp,
        Symbol(Symbol),
    }

    fn base(base: Base) -> Factor {
        Factor::Symbol(base.quantity())
    }

    fn kappa() -> Factor {
        Factor::Symbol(Symbol::Field("kappa".to_owned()))
    }

    fn hyperbolic(stiffness: Polynomial) -> Slope {
        Slope::Hyperbolic { stiffness, scale: Rational::ONE }
    }

    fn number(n: i64) -> Polynomial {
        Polynomial::constant(Rational::from(n))
    }

    #[test]
    fn functions_of_q_are_taken_from_a_sum() {
        // kappa/2 sinh(q)^2 + 3/10 tr G: nothing of q is left.
        let sum = Sum::new()
            .plus(&[(kappa(), 1), (Factor::Sinh, 2)], (1, 2))
            .plus(&[(base(Base::Trace(1)), 1)], (3, 10));
        let (slope, rest) = sum.own().unwrap();
        assert!(matches!(slope, Slope::Hyperbolic { scale: Rational::ONE, .. }), "{slope:?}");
        assert_eq!(rest, 1);
        // 5 sinh(q)^2 + 3/10 exp(-2q): as much of both exponentials as is odd.
        let sum = Sum::new().plus(&[(Factor::Sinh, 2)], (5, 1)).plus(&[(Factor::Exp, -2)], (3, 10));
        assert_eq!(sum.own(), Some((hyperbolic(number(10)), 1)));
        // q^2 + x_1^2
        let sum = Sum::new()
            .plus(&[(base(Base::MeanLogStretch), 2)], (1, 1))
            .plus(&[(base(Base::Position(0)), 2)], (1, 1));
        assert_eq!(sum.own(), Some((Slope::Linear(number(2)), 1)));
        // Single stretches.
        let sum = Sum::new()
            .plus(&[(base(Base::MeanLogStretch), 2)], (1, 1))
            .plus(&[(base(Base::LogStretch(0)), 2)], (1, 1));
        assert_eq!(sum.own(), Some((Slope::Linear(number(2)), 1)));
    }

    #[test]
    fn the_stiffest_is_taken_and_what_binds() {
        let trace = || Sum::new().plus(&[(base(Base::Trace(1)), 1)], (1, 1));
        let sum = trace().plus(&[(base(Base::MeanLogStretch), 2)], (3, 2)).plus(&[(Factor::Sinh, 2)], (5, 1));
        assert_eq!(sum.own(), Some((hyperbolic(number(10)), 2)));
        let sum =
            trace().plus(&[(base(Base::MeanLogStretch), 2)], (30, 1)).plus(&[(Factor::Sinh, 2)], (5, 1));
        assert_eq!(sum.own(), Some((Slope::Linear(number(60)), 2)));
        // A field may be of any size.
        let sum = trace()
            .plus(&[(kappa(), 1), (base(Base::MeanLogStretch), 2)], (1, 2))
            .plus(&[(Factor::Sinh, 2)], (5, 1));
        assert!(matches!(sum.own(), Some((Slope::Linear(_), 2))));
        // What has no closed form, drives apart, changes in time or with anything else stays.
        assert_eq!(trace().plus(&[(base(Base::MeanLogStretch), 1)], (-3, 1)).own(), None);
        assert_eq!(trace().plus(&[(base(Base::MeanLogStretch), 2)], (-3, 1)).own(), None);
        assert_eq!(trace().plus(&[(Factor::Sinh, 2)], (-1, 2)).own(), None);
        assert_eq!(trace().plus(&[(base(Base::MeanLogStretch), 4)], (1, 1)).own(), None);
        assert_eq!(
            trace()
                .plus(&[(base(Base::MeanLogStretch), 2), (Factor::Symbol(Quantity::Time.into()), 1)], (1, 1))
                .own(),
            None
        );
        assert_eq!(
            trace().plus(&[(base(Base::MeanLogStretch), 2), (base(Base::Position(0)), 1)], (1, 1)).own(),
            None
        );
        // Alone, a function of q may do either.
        assert_eq!(
            Sum::new().plus(&[(base(Base::MeanLogStretch), 2)], (-3, 1)).own(),
            Some((Slope::Linear(number(-6)), 0))
        );
    }
}
