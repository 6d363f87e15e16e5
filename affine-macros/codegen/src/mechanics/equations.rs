//! Systems of ordinary differential equations in the coordinates of a chart, and what is added to them.

use rustc_hash::FxHashSet;

use crate::algebra::definitions::used;
use crate::algebra::ring::table;
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Kernel, Matrix, Polynomial, Rational};

use crate::symbol::Symbol;

use super::charts::{Chart, Coordinate};
use super::metric::share;

/// Straight-line system: quantities that several equations share, then the rates of the coordinates.
#[derive(Clone, Debug, Default)]
#[must_use]
pub struct System {
    /// Shared quantities, each a polynomial in coordinates and earlier ones.
    pub shared: Vec<(Expr, Polynomial)>,
    /// Calls of runtime functions, whose results are shared quantities too.
    pub kernels: Vec<Kernel>,
    /// Coordinates and their time derivatives.
    pub rates: Vec<(Coordinate, Expr, Polynomial)>,
    /// The work of forces that no potential has, as one more variable, and its rate, their power.
    pub work: Option<(Expr, Polynomial)>,
}

/// What a potential, a dissipation or a force adds to a system.
#[derive(Clone, Debug, Default)]
#[must_use]
pub struct Load {
    /// Quantities that the forces share.
    pub shared: Vec<(Expr, Polynomial)>,
    /// Calls of runtime functions that they need.
    pub kernels: Vec<Kernel>,
    /// Coordinates and what their rates gain.
    pub forces: Vec<(Coordinate, Polynomial)>,
    /// The symbol of the work and the power of the forces, where no potential has them.
    pub work: Option<(Expr, Polynomial)>,
}

/// How the rate of a coordinate is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Expanded and collected: what cancels is gone.
    Expanded,
    /// Through the affine velocity: products stay products.
    ThroughVelocity,
}

impl Load {
    /// The force on a coordinate.
    pub(super) fn force(&self, z: Coordinate) -> Polynomial {
        listed(&self.forces)(z).unwrap_or_else(Polynomial::zero)
    }

    /// The load with other forms of the same polynomials.
    pub(super) fn mapped(&self, each: &mut impl FnMut(&Polynomial) -> Polynomial) -> Self {
        Self {
            shared: self.shared.iter().map(|(s, p)| (*s, each(p))).collect(),
            kernels: self.kernels.iter().map(|kernel| kernel.with_arguments(&mut *each)).collect(),
            forces: self.forces.iter().map(|(z, p)| (*z, each(p))).collect(),
            work: self.work.as_ref().map(|(s, p)| (*s, each(p))),
        }
    }

    /// What it moves by itself, of the coordinates that determine the others.
    pub(super) fn alone(self, chart: &Chart) -> System {
        let rates = chart.independent().into_iter().map(|z| (z, chart.symbol(z), self.force(z))).collect();
        System { rates, shared: self.shared, kernels: self.kernels, work: self.work }
    }
}

impl System {
    /// Under a constraint: rates of the affine momentum projected, and entries of momentum and velocity that are linear
    /// in others written through those.
    pub(super) fn confined(mut self, chart: &Chart, velocity: &Matrix) -> Self {
        let Some(group) = chart.confined else { return self };
        let projected = group.projected(&table(chart.dim, |a, b| self.rate(Coordinate::M(a, b))));
        for (z, _, rate) in &mut self.rates {
            if let Coordinate::M(a, b) = z {
                *rate = projected[*a][*b].clone();
            }
        }
        let (momenta, velocities) = (chart.dependent(), group.dependent(velocity));
        self.rates.retain(|(_, symbol, _)| listed(&momenta)(*symbol).is_none());
        self.shared.retain(|(symbol, _)| listed(&velocities)(*symbol).is_none());
        self.substitute(&listed(&[momenta, velocities].concat()))
    }

    /// The rate of a coordinate; zero of one that is not among those that move.
    pub(super) fn rate(&self, z: Coordinate) -> Polynomial {
        let found = self.rates.iter().find(|(known, ..)| *known == z);
        found.map_or_else(Polynomial::zero, |(.., rate)| rate.clone())
    }

    /// Replaces atoms by polynomials in every definition and every rate.
    pub fn substitute(&self, value: &impl Fn(Expr) -> Option<Polynomial>) -> Self {
        self.mapped(&mut |p| p.substitute(value))
    }

    /// The system with other forms of the same polynomials.
    pub fn mapped(&self, each: &mut impl FnMut(&Polynomial) -> Polynomial) -> Self {
        Self {
            shared: self.shared.iter().map(|(s, p)| (*s, each(p))).collect(),
            kernels: self.kernels.iter().map(|kernel| kernel.with_arguments(&mut *each)).collect(),
            rates: self.rates.iter().map(|(z, s, p)| (*z, *s, each(p))).collect(),
            work: self.work.as_ref().map(|(s, p)| (*s, each(p))),
        }
    }

    /// Adds quantities and what they add to the rates.
    pub fn add(&mut self, load: &Load) {
        share(&mut self.shared, load.shared.iter().cloned());
        self.kernels.extend(load.kernels.iter().cloned());
        for (coordinate, force) in &load.forces {
            for (_, _, rate) in self.rates.iter_mut().filter(|(z, _, _)| z == coordinate) {
                rate.add_scaled(force, &Rational::ONE);
            }
        }
        if let Some((symbol, power)) = &load.work {
            let (_, sum) = self.work.get_or_insert_with(|| (*symbol, Polynomial::zero()));
            sum.add_scaled(power, &Rational::ONE);
        }
    }

    /// Adds another system, with the rates of what moves there alone.
    pub(super) fn join(&mut self, other: &Self) {
        for (z, symbol, _) in &other.rates {
            if self.rates.iter().all(|(known, ..)| known != z) {
                self.rates.push((*z, *symbol, Polynomial::zero()));
            }
        }
        self.add(&Load {
            shared: other.shared.clone(),
            kernels: other.kernels.clone(),
            forces: other.rates.iter().map(|(z, _, rate)| (*z, rate.clone())).collect(),
            work: other.work.clone(),
        });
    }

    /// Drops shared quantities and calls that nothing uses, and puts in place those that are a single constant or atom.
    pub fn tidied(mut self, arena: &Arena) -> Self {
        let trivial: Vec<(Expr, Polynomial)> = self
            .shared
            .iter()
            .filter(|(_, p)| {
                p.as_constant().is_some() || p.as_atom().is_some_and(|atom| arena.as_symbol(atom).is_some())
            })
            .cloned()
            .collect();
        let known = |atom: Expr| trivial.iter().find(|(s, _)| *s == atom).map(|(_, p)| p);
        // One may stand for another.
        let value = |atom: Expr| {
            let mut value = known(atom)?;
            while let Some(next) = value.terms().next().and_then(|(m, _)| known(*m.first()?)) {
                value = next;
            }
            Some(value.clone())
        };
        // Those that stand in a function as well stay there, and are idle elsewhere.
        self = self.substitute(&value);
        loop {
            let used = self.symbols(arena);
            let used = |symbol: &Expr| used.contains(symbol);
            let idle: Vec<Expr> = self.shared.iter().map(|(s, _)| *s).filter(|s| !used(s)).collect();
            let called: Vec<bool> =
                self.kernels.iter().map(|kernel| kernel.outputs().any(|s| used(&s))).collect();
            if idle.is_empty() && called.iter().all(|called| *called) {
                break;
            }
            let mut called = called.into_iter();
            self.kernels.retain(|_| called.next().unwrap_or(true));
            self.shared.retain(|(s, _)| !idle.contains(s));
        }
        self
    }

    /// Definitions, arguments of calls, rates.
    pub(super) fn polynomials(&self) -> impl Iterator<Item = &Polynomial> {
        let shared = self.shared.iter().map(|(_, p)| p);
        shared
            .chain(self.kernels.iter().flat_map(Kernel::inputs))
            .chain(self.rates.iter().map(|(_, _, p)| p))
            .chain(self.work.iter().map(|(_, p)| p))
    }

    /// The symbols whose rates it holds.
    pub fn moved(&self, arena: &Arena) -> Vec<Symbol> {
        self.rates.iter().map(|(_, symbol, _)| arena.symbol_of(*symbol)).collect()
    }

    /// The number of definitions, arguments and rates that use a symbol.
    pub fn mentions(&self, arena: &Arena, symbol: Expr) -> usize {
        self.polynomials().filter(|p| p.any_symbol(arena, &mut |s| s == symbol)).count()
    }

    /// Every symbol that a definition, a call or a rate uses.
    fn symbols(&self, arena: &Arena) -> FxHashSet<Expr> {
        used(arena, self.polynomials())
    }
}
