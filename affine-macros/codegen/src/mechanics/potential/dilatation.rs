//! What of a potential is a function of `q` with a motion in closed form.

use crate::algebra::{Arena, Polynomial, Rational};

use super::rewriting::through_dilatation;
use super::{Base, Potential};
use crate::mechanics::separation::Slope;

impl Potential {
    /// `U_dil'(q)` where `U = U_dil(q) + U_sh(Psi)` and the closed form of its motion is known: the derivative along
    /// `phi -> e^s phi`, `dU/dq + 2 tr G dU/d(tr G) + ..`, is then a function of `q` alone.
    pub(in crate::mechanics) fn dilatational_slope(&self, arena: &mut Arena) -> Option<Slope> {
        let mut slope = Polynomial::zero();
        for (base, partial) in &self.slopes {
            let partial = through_dilatation(arena, *partial);
            let partial = Polynomial::normal_form(arena, partial);
            let symbol = Polynomial::atom(base.symbol(arena));
            match base {
                Base::MeanLogStretch => slope.add_scaled(&partial, &Rational::ONE),
                Base::Trace | Base::Green(..) | Base::Finger(..) => {
                    slope.add_product(&partial, &symbol, &Rational::from(2));
                }
                Base::TraceOfSquare => slope.add_product(&partial, &symbol, &Rational::from(4)),
                Base::Placement(..) => slope.add_product(&partial, &symbol, &Rational::ONE),
                // The centre of mass stays where it is.
                Base::Position(_) => {}
                // The axes of single stretches are those of phi, not of Psi.
                Base::LogStretch(_) => return None,
            }
        }
        let others: Vec<_> = Base::all(self.dim)
            .into_iter()
            .filter(|base| *base != Base::MeanLogStretch)
            .map(|base| base.symbol(arena))
            .collect();
        if slope.any_symbol(arena, &mut |s| others.contains(&s)) {
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
                let partial = Polynomial::normal_form(arena, partial);
                Slope::stiffest_in(arena, &partial)?
            }
        };
        let own = slope.derivative(arena)?;
        let mut rest = self.clone();
        let partial = &mut rest.slopes[place].1;
        *partial = arena.linear(&[(*partial, Rational::ONE), (own, Rational::MINUS_ONE)]);
        let left = through_dilatation(arena, *partial);
        if Polynomial::normal_form(arena, left).is_zero() {
            rest.slopes.remove(place);
        }
        Some((slope, rest))
    }
}
