//! Does a potential split into a function of `q` and one that no dilatation changes?

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
                // The axes of single stretches are those of phi, not of Psi.
                Base::Position(_) | Base::LogStretch(_) => return None,
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
    /// `U - U_dil(q)`, of which the forces alone are meant: what moves the rest beside a dilatation of its own.
    pub(in crate::mechanics) fn beside_dilatation(&self, arena: &mut Arena, slope: &Slope) -> Option<Self> {
        let own = slope.derivative(arena)?;
        let mut rest = self.clone();
        let (_, partial) = rest.slopes.iter_mut().find(|(base, _)| *base == Base::MeanLogStretch)?;
        *partial = arena.linear(&[(*partial, Rational::ONE), (own, Rational::MINUS_ONE)]);
        Some(rest)
    }
}
