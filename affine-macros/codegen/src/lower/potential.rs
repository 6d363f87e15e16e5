//! The potential energy as the user wrote it, and where it has a value.

use super::base_functions::{Reading, value};
use super::traces::{self, Trace};
use super::{NoValue, components, domain};
use crate::algebra::vanishing::vanishes;
use crate::algebra::{Arena, Expr, Rational};
use crate::mechanics::metrics::{Metrics, Rebased};
use crate::mechanics::potential::stretches::{canonical, is_stretched};
use crate::mechanics::potential::{Base, Guard};
use crate::spec::{Expression, ExpressionKind, Spec};
use crate::symbol::Quantity;

/// A potential energy as it was stated.
pub struct PotentialEnergy {
    /// In symbols of [base functions](Base).
    pub energy: Expr,
    /// Where it has a value.
    pub domain: Vec<Guard>,
    /// Its slopes by base functions, where they are known from matrices.
    pub slopes: Option<Vec<(Base, Expr)>>,
    /// The energy with traces of polynomials in matrices multiplied out, where that is another expression.
    pub multiplied_out: Option<Expr>,
}

/// The potential energy, if the model states one that is not zero. Beside metrics it stands in orthonormal bases; what
/// `prepare()` has to know of them is added to `rebased`.
///
/// # Errors
/// [`NoValue`] where it has none.
pub fn potential(
    arena: &mut Arena,
    spec: &Spec,
    metrics: Option<&Metrics>,
    rebased: &mut Vec<Rebased>,
) -> Result<Option<PotentialEnergy>, NoValue> {
    let Some(stated) = &spec.potential else { return Ok(None) };
    let written = &stated.energy;
    let (n, given) = (spec.dim.value, metrics.is_some());
    let reading = Reading { given, ..Reading::default() };
    let mut energy = value(arena, n, written, reading)?;
    let mut multiplied_out = match value(arena, n, written, Reading { multiplied_out: true, ..reading }) {
        // There are too many products.
        Err(NoValue::Malformed) => None,
        multiplied_out => Some(multiplied_out?),
    };
    let mut domain = domain::guards(arena, n, written, given);
    if let Some(metrics) = metrics {
        let mut all = vec![energy];
        all.extend(domain.iter().map(|guard| guard.value));
        let carried = components::carried(arena, n, &all, metrics, rebased);
        energy = carried[0];
        multiplied_out = None;
        domain.iter_mut().zip(&carried[1..]).for_each(|(guard, value)| guard.value = *value);
    }
    let mut through = None;
    if is_stretched(arena, n, energy) {
        energy = multiplied_out.take().unwrap_or(energy);
        // It decides; what needs the single stretches after all stays as it is written.
        let symmetric = canonical(arena, n, energy);
        if !is_stretched(arena, n, symmetric) {
            energy = symmetric;
        }
    } else if metrics.is_none() {
        through = Through::traces(arena, n, written);
    }
    // Slopes by the factors of products are another way too.
    let is_another = |other: &Expr| {
        *other != energy || through.as_ref().is_some_and(|through: &Through| !through.is_of_powers)
    };
    let multiplied_out = multiplied_out.filter(is_another);
    let slopes = through.map(|through| through.slopes);
    Ok((!vanishes(arena, energy)).then_some(PotentialEnergy { energy, domain, slopes, multiplied_out }))
}

/// The slopes of an energy through those of its traces; `None` where all of these are base functions.
struct Through {
    slopes: Vec<(Base, Expr)>,
    /// Are all of them traces of powers?
    is_of_powers: bool,
}

impl Through {
    fn traces(arena: &mut Arena, n: usize, written: &Expression) -> Option<Self> {
        let mut found: Vec<Trace> = Vec::new();
        let mut open = vec![written];
        while let Some(part) = open.pop() {
            if !matches!(part.kind, ExpressionKind::Trace(_) | ExpressionKind::PolynomialTrace(_)) {
                open.extend(part.operands());
                continue;
            }
            let trace =
                traces::slopes(arena, n, part, &|arena, part| value(arena, n, part, Reading::default()));
            found.extend(trace.filter(|trace| found.iter().all(|known| known.value != trace.value)));
        }
        if found.is_empty() {
            return None;
        }
        let is_of_powers = found.iter().all(|trace| trace.is_of_powers);
        let symbols = (0..found.len()).map(|k| arena.symbol(Quantity::PolynomialTrace.at([k + 1])));
        let named: Vec<(Expr, Expr)> = found.iter().map(|trace| trace.value).zip(symbols).collect();
        let energy = value(arena, n, written, Reading { named: &named, ..Reading::default() }).ok()?;
        let mut parts: Vec<(Expr, Expr)> = Vec::new();
        for (symbol, outer) in arena.gradient(energy, &|_| true) {
            match named.iter().position(|(_, known)| *known == symbol) {
                None => parts.push((symbol, outer)),
                Some(k) => parts.extend(
                    found[k].slopes.iter().map(|(symbol, inner)| (*symbol, arena.mul(outer, *inner))),
                ),
            }
        }
        let value = |symbol: Expr| named.iter().find(|(_, known)| *known == symbol).map(|(value, _)| *value);
        let mut slopes = Vec::new();
        for base in Base::all(n) {
            let symbol = base.symbol(arena);
            let own = parts.iter().filter(|(known, _)| *known == symbol);
            let own: Vec<(Expr, Rational)> = own.map(|(_, slope)| (*slope, Rational::ONE)).collect();
            let slope = arena.linear(&own);
            slopes.push((base, arena.substitute(slope, &value)?));
        }
        Some(Self { slopes, is_of_powers })
    }
}
