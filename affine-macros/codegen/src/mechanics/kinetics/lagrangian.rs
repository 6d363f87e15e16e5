//! A kinetic energy as a sum of parts, each in velocities of its own, and what the chain rule makes of it.
//!
//! A part `T(w, q)` is a polynomial in velocities `w` and in quantities `q` of the placement; `w` are the velocities `O` of
//! the chart, or linear in them with coefficients in `q`. With `s = dT/dw` its momentum is `m = s dw/dO`, and its force at
//! fixed velocity is `E T = s E w + E T|w`, `E` the [derivations](super::action) of the chart.

use crate::algebra::ring::{Square, table};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::metric::Definitions;

use super::action::Action;

/// A part of the kinetic energy.
#[derive(Clone, Debug)]
pub struct Part {
    /// Its velocities `w`.
    pub velocities: Vec<Expr>,
    /// What they are of the velocities of the chart; `None` where they are those.
    pub definitions: Option<Vec<Polynomial>>,
    /// `T(w, q)`.
    pub energy: Polynomial,
    /// Names of `s`; none where `s` stands for itself.
    pub slopes: Vec<Expr>,
    /// Names of `m`; none where `m` stands for itself.
    pub momenta: Vec<Expr>,
}

/// A kinetic energy in the velocities that are conjugate to some momenta of a chart.
#[derive(Clone, Debug)]
pub struct Lagrangian {
    /// The chart.
    pub chart: Chart,
    /// The momenta with their velocities.
    pub conjugate: Vec<(Coordinate, Expr)>,
    /// The parts of the energy.
    pub parts: Vec<Part>,
    /// What `phi^-1` and `G` are on the group that the motion is confined to, where they are not kept as symbols.
    pub on_the_group: Definitions,
}

/// What a part adds to the momentum and to the force.
#[derive(Clone, Debug)]
pub(super) struct Contribution {
    /// Its velocities and `s`.
    pub(super) shared: Definitions,
    /// `m`, with the names that it goes by.
    pub(super) momentum: Vec<(Polynomial, Polynomial)>,
    /// `E T` through the names of `m`.
    pub(super) force: Square<Polynomial>,
    /// `E T` as the chain rule gives it.
    pub(super) written_out: Square<Polynomial>,
}

/// Derivatives of a part along its velocities and along those of the chart.
struct Slopes {
    /// The velocities, and `s` where it has names.
    shared: Definitions,
    /// `s`.
    own: Vec<Polynomial>,
    /// `m`, in the order of the momenta.
    momentum: Vec<Polynomial>,
}

impl Contribution {
    /// The names of `m`, where it has names, with what they stand for.
    pub(super) fn named(&self) -> impl Iterator<Item = (Expr, &Polynomial)> {
        let has_names = |(name, sum): &&(Polynomial, Polynomial)| name != sum;
        let named = self.momentum.iter().filter(has_names);
        named.filter_map(|(name, sum)| Some((*name.atoms().next()?, sum)))
    }
}

impl Lagrangian {
    /// The contributions of the parts.
    pub(super) fn contributions(&self, arena: &mut Arena) -> Vec<Contribution> {
        let action = Action::new(arena, &self.chart);
        self.parts.iter().map(|part| self.contribution(part, &action)).collect()
    }

    fn contribution(&self, part: &Part, action: &Action) -> Contribution {
        let Slopes { shared, own, momentum } = self.slopes(part, true);
        let words: Vec<(Polynomial, Polynomial)> =
            shared.iter().map(|(symbol, value)| (Polynomial::atom(*symbol), value.clone())).collect();
        let written_out = table(self.chart.dim, |a, b| {
            let moved =
                part.definitions.iter().flatten().map(|w| action.derivative(w, a, b).by_names(&words));
            chain(&own, moved).add(&action.derivative(&part.energy, a, b))
        });
        let names = named(&part.momenta, momentum.clone(), &mut Definitions::new());
        let momentum: Vec<_> = names.into_iter().zip(momentum).collect();
        let force = table(self.chart.dim, |a, b| written_out[a][b].by_names(&momentum));
        Contribution { shared, momentum, force, written_out }
    }

    fn slopes(&self, part: &Part, by_names: bool) -> Slopes {
        let mut shared = Definitions::new();
        let own = part.energy.gradient(&part.velocities);
        let Some(values) = &part.definitions else {
            let velocities: Vec<Expr> = self.conjugate.iter().map(|(_, o)| *o).collect();
            return Slopes { shared, momentum: part.energy.gradient(&velocities), own };
        };
        shared.extend(part.velocities.iter().copied().zip(values.iter().cloned()));
        let own = if by_names { named(&part.slopes, own, &mut shared) } else { own };
        let along = |(_, o): &(Coordinate, Expr)| chain(&own, values.iter().map(|w| w.derivative(*o)));
        Slopes { momentum: self.conjugate.iter().map(along).collect(), own, shared }
    }

    /// The Legendre transformation: what the parts share, `dT/dO` in the order of the momenta, and `T`; with names for `s` or
    /// without.
    pub fn legendre(&self, by_names: bool) -> (Definitions, Vec<Polynomial>, Polynomial) {
        let mut shared = Definitions::new();
        let mut momentum = vec![Polynomial::zero(); self.conjugate.len()];
        let energy: Polynomial = self.parts.iter().map(|part| &part.energy).sum();
        for part in &self.parts {
            let slopes = self.slopes(part, by_names);
            shared.extend(slopes.shared);
            momentum.iter_mut().zip(&slopes.momentum).for_each(|(sum, m)| *sum = sum.add(m));
        }
        let each = |p: &Polynomial| self.placed(p);
        let shared = shared.iter().map(|(symbol, value)| (*symbol, each(value))).collect();
        (shared, momentum.iter().map(each).collect(), each(&energy))
    }

    /// With the values that quantities of the placement have on the group.
    pub(super) fn placed(&self, p: &Polynomial) -> Polynomial {
        p.substitute(&listed(&self.on_the_group))
    }
}

/// `sum over k of slopes_k values_k`.
fn chain(slopes: &[Polynomial], values: impl Iterator<Item = Polynomial>) -> Polynomial {
    slopes.iter().zip(values).map(|(slope, value)| slope.mul(&value)).sum()
}

/// The values by their names, where there are names; values that are symbols already stay what they are.
pub fn named(symbols: &[Expr], values: Vec<Polynomial>, shared: &mut Definitions) -> Vec<Polynomial> {
    if symbols.is_empty() || values.iter().all(|value| value.as_atom().is_some()) {
        return values;
    }
    shared.extend(symbols.iter().copied().zip(values));
    Polynomial::vector(symbols)
}
