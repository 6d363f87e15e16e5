//! Ways of writing one and the same force, of which the generator takes the shortest among those that lose no digits.

mod steepness;

use crate::algebra::arena::Node;
use crate::algebra::ring::{Square, pairs, table};
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::mechanics::equations::Load;
use crate::symbol::Quantity;

use super::Potential;
use super::base::Base;
use super::excess::{Isochoric, mean_square};
use super::principal::Principal;
use super::rewriting::through_dilatation;
use super::scaled::{self, scaled_bases};
use super::second;
use super::strain::Strains;
use super::sums::Sums;
use super::tensors::{SQUARES, Tensors, UNIT_SQUARES, cofactors, definitions, squares};
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
pub(super) enum Means {
    Plain(Volume),
    Strains(Box<Counting>),
    Unit(Volume),
}

/// Powers of sums are multiplied out at `phi = 1` where the sums have no more terms there.
const MOST_AT_REST: usize = 2;

/// What counting from the undeformed state takes.
pub(super) struct Counting {
    volume: Volume,
    pub(super) strains: Strains,
    undeformed: Undeformed,
    pub(super) writing: Writing,
}

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
        if self.has_single_stretches() {
            return vec![Writing::Plain, Writing::Differences];
        }
        let mut list = vec![Writing::Plain, Writing::Differences];
        let any = |wanted: &[Base]| self.slopes.iter().any(|(base, _)| wanted.contains(base));
        // Of entries of tensors alone it is the way before.
        let has_mean = any(&[Base::Trace, Base::TraceOfSquare, Base::MeanLogStretch]);
        if has_mean && !any(&[Base::TraceOfCube]) {
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
        let chosen = self.writings.iter().find(|(known, _)| *known == momentum);
        match chart.confined {
            None => chosen.map_or(Way::default(), |(_, way)| *way),
            Some(_) => Way::default(),
        }
    }

    /// Is it a function of `I2` in which `tr G^2` has no part but that? `dU/d(tr G) = dU/dI1 + I1 dU/dI2` is then shorter
    /// without the second term.
    fn is_of_minors(&self, arena: &mut Arena) -> bool {
        let mut sums = Sums::default();
        let mut slope = |wanted: Base| {
            let form = self.slopes.iter().find(|(base, _)| *base == wanted).map(|(_, slope)| *slope)?;
            let form = through_dilatation(arena, form);
            let form = sums.named(arena, form);
            Some(Polynomial::normal_form(arena, form).scaled(&wanted.weight(self.dim)))
        };
        let Some((first, second)) = slope(Base::Trace).zip(slope(Base::TraceOfSquare)) else { return false };
        let mut without = first.clone();
        without.add_product(&second, &Polynomial::atom(Base::Trace.symbol(arena)), &Rational::ONE);
        self.dim == 3 && without.terms().len() < first.terms().len()
    }
}

impl Means {
    pub(super) fn new(arena: &mut Arena, chart: &Chart, writing: Writing) -> Self {
        let volume = Volume::new(arena, chart.dim);
        match writing {
            Writing::Plain => Self::Plain(volume),
            Writing::Isochoric => Self::Unit(volume),
            Writing::Differences | Writing::Deviators | Writing::Inverses => {
                let strains = Strains::new(arena, chart, volume);
                let undeformed = strains.known(arena);
                Self::Strains(Box::new(Counting { volume, strains, undeformed, writing }))
            }
        }
    }

    fn volume(&self) -> Volume {
        match self {
            Self::Plain(volume) | Self::Unit(volume) => *volume,
            Self::Strains(counting) => counting.volume,
        }
    }

    /// A slope before its sums are named; `moved` is the power of `D` in what it stands beside.
    pub(super) fn prepared(&self, arena: &mut Arena, form: Expr, moved: i32) -> Expr {
        let Self::Unit(volume) = self else { return form };
        let reciprocal = arena.reciprocal(volume.d);
        let mut values = scaled_bases(arena, volume.dim(), volume.d);
        values.push((volume.inverse_d, reciprocal));
        let value = |symbol: Expr| values.iter().find(|(known, _)| *known == symbol).map(|(_, value)| *value);
        // Powers of D are not zero.
        let form = arena.replaced(form, &value);
        arena.certain_product(&[(form, 1), (volume.d, moved)])
    }

    /// The normal form of a part of a slope: without products of `D` and `1/D`.
    pub(super) fn normal_form(&self, arena: &mut Arena, form: Expr) -> Polynomial {
        let volume = self.volume();
        let Self::Unit(_) = self else { return volume.collected(arena, form) };
        let reciprocal = arena.reciprocal(volume.d);
        let named = |atom: Expr| (atom == reciprocal).then(|| Polynomial::atom(volume.inverse_d));
        scaled::collected(arena, form, volume.d).substitute(&named)
    }

    /// A slope over the determinant.
    pub(super) fn over_det(&self, slope: &Polynomial) -> Polynomial {
        let volume = self.volume();
        let over = slope.mul(&Polynomial::atom(volume.inverse_det));
        if let Self::Unit(_) = self { over } else { volume.reduced(&over) }
    }

    /// Is it a function of the volume and of parameters alone?
    pub(super) fn is_of_volume(&self, arena: &Arena, form: &Polynomial) -> bool {
        let Volume { det, inverse_det, d, inverse_d, .. } = self.volume();
        let known = [det, inverse_det, d, inverse_d];
        !form.any_symbol(arena, &mut |s| {
            !(known.contains(&s)
                || arena.quantity(s) == Some(Quantity::MeanLogStretch)
                || arena.is_parameter(s))
        })
    }

    /// `G/D^2`, where that is at hand.
    pub(super) fn isochoric(&self, arena: &mut Arena) -> Option<Isochoric> {
        let n = self.volume().dim();
        let mean = mean_square(arena);
        match self {
            Self::Plain(_) => None,
            Self::Unit(_) => {
                let trace = vec![Base::Trace.unit(arena)];
                let mut deviator = table(n, |_, _| Polynomial::zero());
                for (a, b) in pairs(n) {
                    deviator[a][b] = Polynomial::atom(Base::Green(a, b).unit(arena));
                    if a == b {
                        deviator[a][b].add_term(vec![mean], &Rational::MINUS_ONE);
                    }
                }
                Some(Isochoric { trace, deviator })
            }
            Self::Strains(counting) => {
                let Counting { volume, strains, .. } = &**counting;
                let trace = vec![Base::Trace.symbol(arena), volume.inverse_d, volume.inverse_d];
                let squared = Polynomial::term(vec![volume.inverse_d; 2], Rational::ONE);
                let mut deviator = strains.deviator(arena);
                for entry in deviator.iter_mut().flatten() {
                    *entry = entry.mul(&squared);
                }
                Some(Isochoric { trace, deviator })
            }
        }
    }

    /// A sum that is raised to a power, as it is to be computed; `counted` where all of the force vanishes with it.
    pub(super) fn known(
        &mut self,
        arena: &mut Arena,
        symbol: Expr,
        form: Polynomial,
        counted: bool,
    ) -> Polynomial {
        let Self::Strains(counting) = self else { return form };
        let undeformed = &mut counting.undeformed;
        let parts = undeformed.of(arena, &form);
        if parts.at_rest.is_zero() {
            undeformed.know(symbol, Counted::vanishing(Polynomial::atom(symbol)));
        } else if parts.at_rest.terms().len() <= MOST_AT_REST {
            undeformed.know(symbol, parts);
        } else {
            undeformed.know(symbol, Counted::constant(Polynomial::atom(symbol)));
        }
        let small = undeformed.counted(arena, &form);
        // One more division is not worth it where other terms hide the sum.
        let excess = arena.symbol(Quantity::ExcessDilatation);
        if counted || !small.any_symbol(arena, &mut |s| s == excess) { small } else { form }
    }

    /// What stands before the unit matrix: `v + a m + b m^2 + ..`, where the mean `m` of `G` is `tr(G)/n` or 1.
    pub(super) fn offset(&mut self, arena: &mut Arena, powers: &[Polynomial]) -> Polynomial {
        let Self::Strains(counting) = self else { return Polynomial::zero() };
        let Counting { volume, strains, undeformed, writing } = &mut **counting;
        let deviates = *writing == Writing::Deviators;
        let mean = match deviates {
            true => Polynomial::atom(arena.symbol(Quantity::MeanSquareStretch)),
            false => Polynomial::constant(Rational::ONE),
        };
        let mut sum = Polynomial::zero();
        let mut power = Polynomial::constant(Rational::ONE);
        for coefficient in powers {
            sum.add_product(coefficient, &power, &Rational::ONE);
            power = power.mul(&mean);
        }
        if deviates {
            sum = strains.through_deviator(arena, &sum);
        }
        let sum = volume.reduced(&sum);
        undeformed.counted(arena, &sum)
    }

    /// What stands before the unit matrix in `v + a G + b G^2 = c + (a + b tr G) (G - 1) - b det^2 G^-1 (G - 1)`, with the
    /// other coefficients: `c = v + a + b tr G + b (det^2 - I2)`.
    pub(super) fn about_the_inverse(
        &mut self,
        arena: &mut Arena,
        [v, a, b]: [&Polynomial; 3],
    ) -> [Polynomial; 3] {
        let Self::Strains(counting) = self else { return [v, a, b].map(Clone::clone) };
        let Counting { volume, undeformed, .. } = &mut **counting;
        let mut along = a.clone();
        along.add_product(b, &Polynomial::atom(Base::Trace.symbol(arena)), &Rational::ONE);
        let square = Polynomial::term(vec![volume.det; 2], Rational::ONE);
        let mut minors = square.clone();
        minors.add_term(vec![second::symbol(arena)], &Rational::MINUS_ONE);
        let mut sum = v.clone();
        sum.add_scaled(&along, &Rational::ONE);
        sum.add_product(b, &minors, &Rational::ONE);
        let sum = volume.reduced(&sum);
        [undeformed.counted(arena, &sum), along, volume.reduced(&b.mul(&square))]
    }

    /// A coefficient of a force, with what cancels at the undeformed state taken apart.
    pub(super) fn counted(&mut self, arena: &mut Arena, form: &Polynomial) -> Polynomial {
        match self {
            Self::Strains(counting) => counting.undeformed.counted(arena, form),
            _ => form.clone(),
        }
    }

    /// An exponential that is there less one too is one more than that.
    pub(super) fn settle(&self, arena: &mut Arena, load: &mut Load) {
        let Self::Strains(counting) = self else { return };
        let undeformed = &counting.undeformed;
        let is_growth =
            |arena: &Arena, atom: Expr| matches!(arena.node(atom), Node::Function(Function::ExpM1, _));
        let forms = || {
            load.shared.iter().chain([]).map(|(_, form)| form).chain(load.forces.iter().map(|(_, form)| form))
        };
        let mut values = Vec::new();
        for (atom, counted) in undeformed.exponentials(arena) {
            let growth = counted.change.terms().flat_map(|(monomial, _)| monomial.iter().copied());
            let growth: Vec<Expr> = growth.filter(|atom| is_growth(arena, *atom)).collect();
            if forms().any(|form| form.mentions(|atom| growth.contains(&atom))) {
                let mut whole = counted.at_rest.clone();
                whole.add_scaled(&counted.change, &Rational::ONE);
                values.push((atom, whole));
            }
        }
        if values.is_empty() {
            return;
        }
        let value =
            |atom: Expr| values.iter().find(|(known, _)| *known == atom).map(|(_, whole)| whole.clone());
        for (_, form) in &mut load.shared {
            *form = form.substitute(&value);
        }
        for (_, form) in &mut load.forces {
            *form = form.substitute(&value);
        }
    }

    /// Definitions of the tensors, the cofactors and the volume; what is not used goes later.
    pub(super) fn definitions(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        uses_root: bool,
    ) -> Vec<(Expr, Polynomial)> {
        let volume = self.volume();
        let mut list = match self {
            Self::Strains(counting) => counting.strains.definitions(arena),
            _ => Vec::new(),
        };
        list.extend(definitions(arena, chart.dim, chart));
        if let Self::Unit(_) = self {
            list.extend(scaled::definitions(arena, chart, volume.inverse_d));
        }
        list.extend(cofactors(arena, chart));
        list.extend(volume.definitions(arena, chart, uses_root));
        list
    }

    /// The tensors that forces are written with.
    pub(super) fn tensors(&self, arena: &mut Arena, chart: &Chart) -> Tensors<Polynomial> {
        let n = chart.dim;
        let unit = matches!(self, Self::Unit(_));
        let mut symbols = |base: fn(usize, usize) -> Base| -> Square<Polynomial> {
            let mut entry = |a, b| if unit { base(a, b).unit(arena) } else { base(a, b).symbol(arena) };
            table(n, |a, b| Polynomial::atom(entry(a, b)))
        };
        let (green, finger) = (symbols(Base::Green), symbols(Base::Finger));
        let phi = if unit { symbols(Base::Placement) } else { chart.placement() };
        let cofactors = Matrix::symbols(arena, Quantity::Cofactor, n).atoms();
        let squares = squares(arena, n, if unit { UNIT_SQUARES } else { SQUARES });
        Tensors { phi, green, finger, squares, cofactors, principal: Principal::new(arena, n) }
    }
}
