//! The forces of a potential in every chart.

use crate::algebra::polynomial::add_to;
use crate::algebra::rational::exponent;
use crate::algebra::ring::{Square, outer, pairs, sum, table, times, transpose};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Linear, Momentum};
use crate::mechanics::equations::Load;
use crate::mechanics::metric::{Definitions, share};
use crate::symbol::{Frame, Quantity, Symbol};

use super::Potential;
use super::base::Base;
use super::principal;
use super::pulled_back::PulledBack;
use super::rewriting::through_dilatation;
use super::sums::Sums;
use super::tensors::{definition_of_second, through_second_invariant};
use super::writing::{Means, Writing};

/// What the forces of a potential in a chart are made of: a way of writing, and what is shared so far.
pub(super) struct Draft<'a> {
    pub(super) arena: &'a mut Arena,
    pub(super) chart: &'a Chart,
    /// The frame whose momentum the chart has.
    pub(super) along: Frame,
    pub(super) means: Means,
    pub(super) load: Load,
    /// The position beside the entries of `Ct`, where these stand nowhere else.
    pulled_back: Option<PulledBack>,
}

impl Potential {
    /// What it adds to Hamilton's equations of a chart, in the way that was [chosen](Self::written) for the chart.
    pub fn load(&self, arena: &mut Arena, chart: &Chart) -> Load {
        self.load_by(arena, chart, self.way(chart))
    }

    /// The same with its slopes in a given way of writing.
    pub(super) fn load_in(&self, arena: &mut Arena, chart: &Chart, writing: Writing) -> Load {
        let (along, means) = (chart.frame(), Means::new(arena, chart, writing));
        let mut draft = Draft { arena, chart, along, means, load: Load::default(), pulled_back: None };
        if self.has_single_stretches() {
            let (kernel, shared) = principal::computed(draft.arena, chart, writing.counts());
            draft.load.kernels.push(kernel);
            draft.share(shared);
        }
        let mut slopes = self.weighted(&mut draft);
        if self.has_single_stretches() {
            slopes = on_axes(draft.arena, chart.dim, slopes, writing.counts());
        }
        let mut forces = draft.forces(&slopes);
        let centre = draft.force_on_centre(&slopes);
        if chart.momentum == Momentum::Total {
            let x = Polynomial::vector(&chart.x);
            forces = sum(&forces, &outer(&x, &centre));
        }
        if let Some(group) = chart.confined {
            forces = group.projected(&forces);
        }
        let on_momentum = pairs(chart.dim).map(|(a, b)| (Coordinate::M(a, b), forces[a][b].clone()));
        draft.load.forces = on_momentum.collect();
        draft.load.forces.extend(centre.into_iter().enumerate().map(|(i, force)| (Coordinate::P(i), force)));
        draft.finished()
    }

    /// The slopes with the numbers that they carry in a force, and on the way `dU/dt` at rest of `phi` and `x` and the sums that
    /// all of them raise to powers.
    fn weighted(&self, draft: &mut Draft) -> Vec<(Base, Polynomial)> {
        let mut sums = Sums::of_slopes();
        let mut prepared = |draft: &mut Draft, form: Expr, moved: i32| {
            let form = through_dilatation(draft.arena, form);
            let form = draft.means.prepared(draft.arena, form, moved);
            sums.named(draft.arena, form)
        };
        let mut named: Vec<(Base, Expr)> = Vec::new();
        for (base, slope) in &self.slopes {
            // Along the placement itself one power of D less.
            let less = usize::from(draft.along == Frame::Flat);
            let moved = exponent(base.degree().saturating_sub(less));
            named.push((*base, prepared(draft, *slope, moved)));
        }
        if let Some(time) = self.time {
            let form = draft.arena.derivative(self.energy, time);
            let form = prepared(draft, form, 0);
            let power = draft.normal_form(form);
            draft.load.work = Some((draft.arena.symbol(Quantity::Work), power));
        }
        let mut slopes: Vec<(Base, Polynomial)> =
            named.into_iter().map(|(base, form)| (base, draft.normal_form(form))).collect();
        for (base, form) in &mut slopes {
            *form = form.scaled(&base.weight(self.dim));
        }
        let mut known: Definitions =
            sums.known().iter().map(|(symbol, sum)| (*symbol, draft.normal_form(*sum))).collect();
        draft.pull_back(&mut slopes, &mut known);
        for (symbol, form) in known {
            // Where all of the force vanishes with one, its digits are those of the force.
            let is_factor = slopes.iter().all(|(_, slope)| slope.terms().all(|(m, _)| m.contains(&symbol)));
            draft.raised((symbol, form), is_factor);
        }
        slopes
    }
}

/// The slope by `q` as a part of those by all `q_a`: the unit matrix is the sum of the projections on the axes. Where all are
/// to cancel `at_rest`, those by `tr G^k` too, `G^k` having `Q_a^2k` on the axes.
fn on_axes(
    arena: &mut Arena,
    n: usize,
    slopes: Vec<(Base, Polynomial)>,
    at_rest: bool,
) -> Vec<(Base, Polynomial)> {
    let is_isotropic = |base: Base| match base {
        Base::MeanLogStretch => true,
        Base::Trace(_) => at_rest,
        _ => false,
    };
    let (isotropic, mut rest): (Vec<_>, Vec<_>) =
        slopes.into_iter().partition(|(base, _)| is_isotropic(*base));
    for (base, slope) in isotropic {
        for k in 0..n {
            let stretch = principal::stretch(arena, k);
            let slope = slope.mul(&Polynomial::monomial(vec![stretch; base.degree()]));
            add_to(&mut rest, Base::LogStretch(k), &slope);
        }
    }
    rest
}

impl Draft<'_> {
    /// Shares quantities that are not shared yet.
    pub(super) fn share(&mut self, definitions: Definitions) {
        share(&mut self.load.shared, definitions);
    }

    /// A coefficient of a force: named where it moves, as it stands where it is of parameters alone.
    pub(super) fn named(&mut self, symbol: impl Into<Symbol>, form: &Polynomial) -> Polynomial {
        if !form.any_symbol(self.arena, &mut |s| !self.arena.is_parameter(s)) {
            return form.clone();
        }
        let symbol = self.arena.symbol(symbol);
        self.share(vec![(symbol, form.clone())]);
        Polynomial::atom(symbol)
    }

    /// The coefficient that a slope is in a force.
    pub(super) fn coefficient(&mut self, base: Base, slope: &Polynomial) -> Polynomial {
        let mut form = self.means.counted(self.arena, slope);
        if let (Base::LogStretch(k), Frame::Space | Frame::Flat) = (base, self.along) {
            form = form.mul(&principal::inverse_square(self.arena, k));
        }
        self.named(base.slope(), &form)
    }

    /// Takes `x . Ct x` for the entries of `Ct`, where slopes, sums and power have them nowhere else.
    fn pull_back(&mut self, slopes: &mut Vec<(Base, Polynomial)>, sums: &mut [(Expr, Polynomial)]) {
        if self.chart.confined.is_some() || self.means.is_unit() {
            return;
        }
        let Some(mut found) = PulledBack::of(self.arena, self.chart, slopes) else { return };
        slopes.retain(|(base, _)| !matches!(base, Base::Finger(..)));
        let slope = found.through(self.arena, &found.slope);
        found.slope = self.named(Quantity::SlopeByPulledBack, &slope);
        let slopes = slopes.iter_mut().map(|(_, slope)| slope);
        let work = self.load.work.iter_mut().map(|(_, power)| power);
        for form in slopes.chain(sums.iter_mut().map(|(_, sum)| sum)).chain(work) {
            *form = found.through(self.arena, form).by_names(&[(found.slope.clone(), slope.clone())]);
        }
        self.share(found.definitions(self.chart));
        self.pulled_back = Some(found);
    }

    /// The normal form of a part of a slope.
    fn normal_form(&mut self, form: Expr) -> Polynomial {
        let form = self.means.normal_form(self.arena, form);
        if self.means.is_unit() {
            return form;
        }
        let Some(shorter) = through_second_invariant(self.arena, &form) else { return form };
        let definition = definition_of_second(self.arena, self.chart);
        self.share(vec![definition]);
        shorter
    }

    /// Shares a sum that is raised to a power.
    fn raised(&mut self, (symbol, mut form): (Expr, Polynomial), is_factor: bool) {
        if is_factor
            && let Some(isochoric) = self.means.isochoric(self.arena)
            && let Some(counted) = isochoric.through_excess(self.arena, &form)
        {
            let definitions = isochoric.definitions(self.arena);
            self.share(definitions);
            form = counted;
        }
        form = self.means.known(self.arena, symbol, form, is_factor);
        self.share(vec![(symbol, form)]);
    }

    /// `Q_tr`, or `phi^T Q_tr` beside `p_hat`; the slopes carry the sign. Nothing where the chart has no `p`.
    fn force_on_centre(&mut self, slopes: &[(Base, Polynomial)]) -> Vec<Polynomial> {
        let mut push = vec![Polynomial::zero(); self.chart.p.len()];
        for (base, slope) in slopes {
            if let Base::Position(i) = base
                && let Some(push) = push.get_mut(*i)
            {
                *push = self.named(base.slope(), slope);
            }
        }
        match self.chart.linear {
            Some(Linear::Body) => times(&transpose(&self.chart.placement()), &push),
            _ => push,
        }
    }

    /// What is shared completed by the definitions of the tensors, the cofactors and the volume.
    fn finished(mut self) -> Load {
        self.means.settle(self.arena, &mut self.load);
        let roots = [Quantity::Dilatation, Quantity::InverseDilatation, Quantity::ExcessDilatation];
        let roots = self.arena.symbols(roots);
        let mut is_root = |symbol| roots.contains(&symbol);
        let Load { shared, forces, work, .. } = &self.load;
        let shared = shared.iter().chain(work).map(|(_, form)| form);
        let mut forms = shared.chain(forces.iter().map(|(_, form)| form));
        let uses_root = forms.any(|form| form.any_symbol(self.arena, &mut is_root));
        let definitions = self.means.definitions(self.arena, self.chart, uses_root);
        self.share(definitions);
        self.load
    }

    /// The forces on the affine momentum.
    fn forces(&mut self, slopes: &[(Base, Polynomial)]) -> Square<Polynomial> {
        let mut forces = match self.along {
            Frame::Flat => self.on_placement(slopes),
            _ => self.on_spin(slopes),
        };
        let Some(pulled_back) = self.pulled_back.take() else { return forces };
        let [left, right] = pulled_back.direction(self.along);
        for (b, entry) in right.iter().enumerate() {
            let weighted = pulled_back.slope.mul(&Polynomial::atom(*entry));
            let weighted = self.named(Quantity::Weighted.at([b + 1]), &weighted);
            for (row, entry) in forces.iter_mut().zip(left) {
                row[b].add_product(&weighted, &Polynomial::atom(*entry), &Rational::ONE);
            }
        }
        forces
    }

    pub(super) fn empty(&self) -> Square<Polynomial> {
        table(self.chart.dim, |_, _| Polynomial::zero())
    }
}
