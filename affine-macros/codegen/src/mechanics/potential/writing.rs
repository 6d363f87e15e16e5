//! Ways of writing one and the same force, of which the generator takes the shortest among those that lose no digits.

mod steepness;

use std::rc::Rc;

use crate::algebra::arena::Node;
use crate::algebra::ring::{add_scalar, table};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::equations::Load;
use crate::mechanics::metric::Definitions;
use crate::symbol::Quantity;

use super::Potential;
use super::base::Base;
use super::excess::{Isochoric, mean_square};
use super::principal::Principal;
use super::rewriting::through_dilatation;
use super::scaled::{self, scaled_bases};
use super::strain::Strains;
use super::sums::Sums;
use super::tensors::{TENSORS, Tensors, cofactors, definitions, own, squares, symbols};
use super::undeformed::{Counted, Undeformed};
use super::volume::Volume;

/// A way of writing the forces of a potential.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Writing {
    /// Through the tensors and invariants themselves.
    #[default]
    Plain,
    /// Through `G - 1` or `Ct - 1`, on the diagonals of all through differences: nothing cancels near the undeformed state.
    Differences,
    /// Through the deviator of `G` or `Ct` and a mean that is counted from the undeformed state, on `Pi` as `phi^-T` times that:
    /// nothing cancels near any dilatation.
    Deviators,
    /// Through `G^-1 (G - 1)`, in place of `G (tr(G) - G)`: energies of `I2` over powers of `det`, as `tr(G^-1)` is one.
    Inverses,
    /// Through `D` and the isochoric part `phi/D`, whose powers stay within the range of numbers where `phi` is extreme.
    Isochoric,
}

/// The form of the slopes, and how forces are written with them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Way {
    /// Are they the other slopes of the potential?
    pub other_slopes: bool,
    /// How forces are written.
    pub writing: Writing,
}

/// What a way of writing works with.
pub(super) struct Means {
    pub(super) writing: Writing,
    pub(super) volume: Volume,
    /// The quantities that are counted from the undeformed state, where any are.
    pub(super) strains: Option<Rc<Strains>>,
    undeformed: Undeformed,
}

/// Powers of sums are multiplied out at `phi = 1` where the sums have no more terms there.
const MOST_AT_REST: usize = 2;

impl Writing {
    /// Does it count from the undeformed state?
    pub fn counts(self) -> bool {
        matches!(self, Self::Differences | Self::Deviators | Self::Inverses)
    }
}

impl Potential {
    /// The ways in which its forces in a chart may be written.
    pub fn ways(&self, arena: &mut Arena, chart: &Chart) -> Vec<Way> {
        let ways = |slopes: &Self, arena: &mut Arena, other_slopes: bool| -> Vec<Way> {
            let writings = slopes.writings(arena, chart).into_iter();
            writings.map(|writing| Way { other_slopes, writing }).collect()
        };
        let mut list = ways(self, arena, false);
        if let Some(other) = self.by_other_slopes() {
            list.extend(ways(&other, arena, true));
        }
        list
    }

    /// The same with the other slopes alone, if there are any.
    fn by_other_slopes(&self) -> Option<Self> {
        let slopes = self.other_slopes.clone()?;
        Some(Self { slopes, other_slopes: None, ..self.clone() })
    }

    /// What it adds to Hamilton's equations of a chart in a given way.
    pub fn load_by(&self, arena: &mut Arena, chart: &Chart, way: Way) -> Load {
        match (way.other_slopes, self.by_other_slopes()) {
            (false, _) => self.load_in(arena, chart, way.writing),
            (true, Some(other)) => other.load_in(arena, chart, way.writing),
            // What is left of a potential may have no others.
            (true, None) => self.load_in(arena, chart, Writing::Plain),
        }
    }

    /// The ways of writing forces with its slopes.
    fn writings(&self, arena: &mut Arena, chart: &Chart) -> Vec<Writing> {
        if chart.confined.is_some() {
            return vec![Writing::Plain];
        }
        let mut list = vec![Writing::Plain, Writing::Differences];
        if self.has_single_stretches() {
            return list;
        }
        let any = |wanted: &[Base]| self.slopes.iter().any(|(base, _)| wanted.contains(base));
        // Of entries of tensors alone it is the way before.
        let has_mean = any(&[Base::Trace(1), Base::Trace(2), Base::MeanLogStretch]);
        if has_mean && !any(&[Base::Trace(3)]) {
            list.push(Writing::Deviators);
            list.extend(self.is_of_minors(arena).then_some(Writing::Inverses));
        }
        if self.is_steep(arena) {
            list.push(Writing::Isochoric);
        }
        list
    }

    /// The same potential with a way of writing its forces beside a momentum.
    pub fn written(mut self, momentum: Momentum, way: Way) -> Self {
        self.writings.push((momentum, way));
        self
    }

    /// The way that was chosen for a chart.
    pub(super) fn way(&self, chart: &Chart) -> Way {
        let momentum = match chart.momentum {
            // The same forces stand beside it.
            Momentum::Total => Momentum::Space,
            momentum => momentum,
        };
        let chosen = self.writings.iter().find(|(known, _)| *known == momentum && chart.confined.is_none());
        chosen.map_or(Way::default(), |(_, way)| *way)
    }

    /// Is it a function of `I2` in which `tr G^2` has no part but that? `dU/d(tr G) = dU/dI1 + I1 dU/dI2` is then shorter
    /// without the second term.
    fn is_of_minors(&self, arena: &mut Arena) -> bool {
        let mut sums = Sums::default();
        let mut slope = |wanted: Base| {
            let form = through_dilatation(arena, listed(&self.slopes)(wanted)?);
            let form = sums.named(arena, form);
            Some(Polynomial::normal_form(arena, form).scaled(&wanted.weight(self.dim)))
        };
        let Some((first, second)) = slope(Base::Trace(1)).zip(slope(Base::Trace(2))) else { return false };
        let mut without = first.clone();
        without.add_product(&second, &Polynomial::atom(Base::Trace(1).symbol(arena)), &Rational::ONE);
        self.dim == 3 && without.terms().len() < first.terms().len()
    }
}

impl Means {
    pub(super) fn new(arena: &mut Arena, chart: &Chart, writing: Writing) -> Self {
        let volume = Volume::new(arena, chart.dim);
        let strains = writing.counts().then(|| Rc::new(Strains::new(arena, chart, volume)));
        let undeformed = strains.as_ref().map_or_else(Undeformed::default, |strains| strains.known(arena));
        Self { writing, volume, strains, undeformed }
    }

    /// Is it written through `D` and `Psi`?
    pub(super) fn is_unit(&self) -> bool {
        self.writing == Writing::Isochoric
    }

    /// A slope before its sums are named; `moved` is the power of `D` in what it stands beside.
    pub(super) fn prepared(&self, arena: &mut Arena, form: Expr, moved: i32) -> Expr {
        if !self.is_unit() {
            return form;
        }
        let Volume { n, d, inverse_d, .. } = self.volume;
        let reciprocal = arena.reciprocal(d);
        let mut values = scaled_bases(arena, n, d);
        values.push((inverse_d, reciprocal));
        // Powers of D are not zero.
        let form = arena.replaced(form, &listed(&values));
        arena.certain_product(&[(form, 1), (d, moved)])
    }

    /// The normal form of a part of a slope: without products of `D` and `1/D`.
    pub(super) fn normal_form(&self, arena: &mut Arena, form: Expr) -> Polynomial {
        if !self.is_unit() {
            return self.volume.collected(arena, form);
        }
        let Volume { d, inverse_d, .. } = self.volume;
        let reciprocal = arena.reciprocal(d);
        scaled::collected(arena, form, d).substitute(&listed(&[(reciprocal, Polynomial::atom(inverse_d))]))
    }

    /// A slope over the determinant.
    pub(super) fn over_det(&self, slope: &Polynomial) -> Polynomial {
        let over = slope.mul(&Polynomial::atom(self.volume.inverse_det));
        if self.is_unit() { over } else { self.volume.reduced(&over) }
    }

    /// Is it a function of the volume and of parameters alone?
    pub(super) fn is_of_volume(&self, arena: &Arena, form: &Polynomial) -> bool {
        let Volume { det, inverse_det, d, inverse_d, .. } = self.volume;
        let known = [det, inverse_det, d, inverse_d];
        !form.any_symbol(arena, &mut |s| {
            !(known.contains(&s)
                || arena.quantity(s) == Some(Quantity::MeanLogStretch)
                || arena.is_parameter(s))
        })
    }

    /// `G/D^2`, where that is at hand.
    pub(super) fn isochoric(&self, arena: &mut Arena) -> Option<Isochoric> {
        let mean = mean_square(arena);
        let Volume { n, inverse_d, .. } = self.volume;
        if self.is_unit() {
            let mut deviator = symbols(arena, n, Base::Green, true);
            add_scalar(&mut deviator, &Polynomial::atom(mean).neg());
            return Some(Isochoric { trace: vec![Base::Trace(1).unit(arena)], deviator });
        }
        let deviator = self.strains.as_ref()?.deviator(arena);
        let trace = vec![Base::Trace(1).symbol(arena), inverse_d, inverse_d];
        let over = |a: usize, b: usize| Polynomial::monomial([deviator.0[a][b], inverse_d, inverse_d]);
        Some(Isochoric { trace, deviator: table(n, over) })
    }

    /// A sum that is raised to a power, as it is to be computed; `counted` where all of the force vanishes with it.
    pub(super) fn known(
        &mut self,
        arena: &mut Arena,
        symbol: Expr,
        form: Polynomial,
        counted: bool,
    ) -> Polynomial {
        if self.strains.is_none() {
            return form;
        }
        let parts = self.undeformed.of(arena, &form);
        let terms = parts.at_rest.terms().len();
        let parts = match terms {
            0 => Counted::from(0, Polynomial::atom(symbol)),
            1..=MOST_AT_REST => parts,
            _ => Counted::constant(Polynomial::atom(symbol)),
        };
        self.undeformed.know(symbol, parts);
        let small = self.undeformed.counted(arena, &form);
        // One more division is not worth it where other terms hide the sum.
        let excess = arena.symbol(Quantity::ExcessDilatation);
        if counted || !small.any_symbol(arena, &mut |s| s == excess) { small } else { form }
    }

    /// A coefficient of a force, with what cancels at the undeformed state taken apart.
    pub(super) fn counted(&mut self, arena: &mut Arena, form: &Polynomial) -> Polynomial {
        match self.strains {
            Some(_) => self.undeformed.counted(arena, form),
            None => form.clone(),
        }
    }

    /// An exponential that is there less one too is one more than that.
    pub(super) fn settle(&self, arena: &Arena, load: &mut Load) {
        let forces = load.forces.iter_mut().map(|(_, form)| form);
        let mut forms: Vec<_> = load.shared.iter_mut().map(|(_, form)| form).chain(forces).collect();
        let mut values = Vec::new();
        for (atom, counted) in self.undeformed.exponentials(arena) {
            let is_growth = |atom: &&Expr| matches!(arena.node(**atom), Node::Function(Function::ExpM1, _));
            let growth: Vec<&Expr> = counted.change.atoms().filter(is_growth).collect();
            if forms.iter().any(|form| form.mentions(|atom| growth.contains(&&atom))) {
                values.push((atom, counted.at_rest.add(&counted.change)));
            }
        }
        if !values.is_empty() {
            forms.iter_mut().for_each(|form| **form = form.substitute(&listed(&values)));
        }
    }

    /// Definitions of the tensors, the cofactors and the volume; what is not used goes later.
    pub(super) fn definitions(&self, arena: &mut Arena, chart: &Chart, uses_root: bool) -> Definitions {
        let mut list = Vec::new();
        list.extend(self.strains.iter().flat_map(|strains| strains.definitions(arena)));
        list.extend(definitions(arena, &chart.placement(), own(chart), false));
        if self.is_unit() {
            list.extend(scaled::definitions(arena, chart, self.volume.inverse_d));
        }
        list.extend(cofactors(arena, chart));
        list.extend(self.volume.definitions(arena, chart, uses_root));
        list
    }

    /// The tensors that forces are written with.
    pub(super) fn tensors(&self, arena: &mut Arena, chart: &Chart) -> Tensors<Polynomial> {
        let (n, unit) = (chart.dim, self.is_unit());
        let [green, finger] = TENSORS.map(|tensor| symbols(arena, n, tensor, unit));
        let phi = if unit { symbols(arena, n, Base::Placement, unit) } else { chart.placement() };
        let cofactors = Matrix::symbols(arena, Quantity::Cofactor, n).atoms();
        let squares = squares(arena, n, unit);
        Tensors { phi, green, finger, squares, cofactors, principal: Principal::new(arena, n) }
    }
}
