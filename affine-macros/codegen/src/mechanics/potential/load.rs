//! The forces of a potential in every chart.

use crate::algebra::ring::table;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Linear, Momentum};
use crate::mechanics::equations::Load;
use crate::symbol::{Quantity, Symbol};

use super::Potential;
use super::base::{Along, Base};
use super::excess::Isochoric;
use super::principal;
use super::pulled_back::PulledBack;
use super::rewriting::through_dilatation;
use super::second::{self, through_second_invariant};
use super::sums::Sums;
use super::writing::{Means, Writing};

/// What the forces of a potential in a chart are made of: a way of writing, and what is shared so far.
pub(super) struct Draft<'a> {
    pub(super) chart: &'a Chart,
    pub(super) along: Along,
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
        let along = match chart.momentum {
            Momentum::Body => Along::Body,
            Momentum::Space | Momentum::Total => Along::Space,
            Momentum::Canonical => Along::Placement,
        };
        let means = Means::new(arena, chart, writing);
        let mut draft = Draft { chart, along, means, load: Load::default(), pulled_back: None };
        if self.has_single_stretches() {
            let (kernel, shared) = principal::computed(arena, chart, writing.counts());
            draft.load.kernels.push(kernel);
            draft.share(shared);
        }
        let mut slopes = self.weighted(arena, &mut draft);
        if self.has_single_stretches() {
            slopes = on_axes(arena, chart.dim, slopes, writing.counts());
        }
        let mut forces = draft.forces(arena, &slopes);
        if chart.momentum == Momentum::Total {
            for (base, slope) in &slopes {
                let Base::Position(b) = base else { continue };
                let slope = draft.named(arena, base.slope(), slope);
                for (a, x) in chart.x.iter().enumerate() {
                    forces[a][*b].add_product(&slope, &Polynomial::atom(*x), &Rational::ONE);
                }
            }
        }
        if let Some(group) = chart.confined {
            forces = group.projected(&forces);
        }
        let forces = forces.into_iter().enumerate().flat_map(|(a, row)| {
            row.into_iter().enumerate().map(move |(b, force)| (Coordinate::M(a, b), force))
        });
        let mut forces: Vec<_> = forces.collect();
        for i in 0..chart.p.len() {
            forces.push((Coordinate::P(i), draft.force_on_centre(arena, &slopes, i)));
        }
        draft.load.forces = forces;
        draft.finished(arena)
    }

    /// The slopes with the numbers that they carry in a force, and on the way `dU/dt` at rest of `phi` and `x` and the sums that
    /// all of them raise to powers.
    fn weighted(&self, arena: &mut Arena, draft: &mut Draft) -> Vec<(Base, Polynomial)> {
        let mut sums = Sums::of_slopes();
        let mut named: Vec<(Base, Expr)> = Vec::new();
        for (base, slope) in &self.slopes {
            let form = through_dilatation(arena, *slope);
            let moved = base.degree() - i32::from(base.is_moved(draft.along));
            let form = draft.means.prepared(arena, form, moved);
            named.push((*base, sums.named(arena, form)));
        }
        if let Some(time) = self.time {
            let form = arena.derivative(self.energy, time);
            let form = through_dilatation(arena, form);
            let form = draft.means.prepared(arena, form, 0);
            let form = sums.named(arena, form);
            let power = draft.normal_form(arena, form);
            draft.load.work = Some((arena.symbol(Quantity::Work), power));
        }
        let slopes: Vec<(Base, Polynomial)> =
            named.into_iter().map(|(base, form)| (base, draft.normal_form(arena, form))).collect();
        let mut slopes: Vec<(Base, Polynomial)> =
            slopes.into_iter().map(|(base, form)| (base, form.scaled(&base.weight(self.dim)))).collect();
        let mut known: Vec<(Expr, Polynomial)> =
            sums.known().iter().map(|(symbol, sum)| (*symbol, draft.normal_form(arena, *sum))).collect();
        draft.pull_back(arena, &mut slopes, &mut known);
        for (symbol, form) in known {
            // Where all of the force vanishes with one, its digits are those of the force.
            let is_factor = slopes.iter().all(|(_, slope)| slope.terms().all(|(m, _)| m.contains(&symbol)));
            draft.raised(arena, (symbol, form), is_factor);
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
    let power = |base: &Base| match base {
        Base::MeanLogStretch => Some(0),
        Base::Trace if at_rest => Some(2),
        Base::TraceOfSquare if at_rest => Some(4),
        Base::TraceOfCube if at_rest => Some(6),
        _ => None,
    };
    let (mut isotropic, mut rest) = (Vec::new(), Vec::new());
    for (base, slope) in slopes {
        match power(&base) {
            Some(power) => isotropic.push((power, slope)),
            None => rest.push((base, slope)),
        }
    }
    for (power, slope) in isotropic {
        for k in 0..n {
            let stretch = principal::stretch(arena, k);
            let projected = Polynomial::term(vec![stretch; power], Rational::ONE);
            let slope = slope.mul(&projected);
            let axis = Base::LogStretch(k);
            match rest.iter_mut().find(|(base, _)| *base == axis) {
                Some((_, own)) => own.add_scaled(&slope, &Rational::ONE),
                None => rest.push((axis, slope)),
            }
        }
    }
    rest
}

impl Draft<'_> {
    /// Shares quantities that are not shared yet.
    pub(super) fn share(&mut self, definitions: Vec<(Expr, Polynomial)>) {
        for (symbol, definition) in definitions {
            if self.load.shared.iter().all(|(known, _)| *known != symbol) {
                self.load.shared.push((symbol, definition));
            }
        }
    }

    /// A coefficient of a force: named where it moves, as it stands where it is of parameters alone.
    pub(super) fn named(
        &mut self,
        arena: &mut Arena,
        symbol: impl Into<Symbol>,
        form: &Polynomial,
    ) -> Polynomial {
        if !form.any_symbol(arena, &mut |s| !arena.is_parameter(s)) {
            return form.clone();
        }
        let symbol = arena.symbol(symbol);
        self.share(vec![(symbol, form.clone())]);
        Polynomial::atom(symbol)
    }

    /// The coefficient that a slope is in a force.
    pub(super) fn coefficient(&mut self, arena: &mut Arena, base: Base, slope: &Polynomial) -> Polynomial {
        let counted = self.means.counted(arena, slope);
        let form = match (base, self.along) {
            (Base::LogStretch(k), Along::Space | Along::Placement) => {
                counted.mul(&principal::inverse_square(arena, k))
            }
            _ => counted,
        };
        self.named(arena, base.slope(), &form)
    }

    /// Takes `x . Ct x` for the entries of `Ct`, where slopes, sums and power have them nowhere else.
    fn pull_back(
        &mut self,
        arena: &mut Arena,
        slopes: &mut Vec<(Base, Polynomial)>,
        sums: &mut [(Expr, Polynomial)],
    ) {
        if self.chart.confined.is_some() || matches!(self.means, Means::Unit(_)) {
            return;
        }
        let Some(mut found) = PulledBack::of(arena, self.chart, slopes) else { return };
        slopes.retain(|(base, _)| !matches!(base, Base::Finger(..)));
        let slope = found.through(arena, &found.slope);
        found.slope = self.named(arena, Quantity::SlopeByPulledBack, &slope);
        let slopes = slopes.iter_mut().map(|(_, slope)| slope);
        let work = self.load.work.iter_mut().map(|(_, power)| power);
        for form in slopes.chain(sums.iter_mut().map(|(_, sum)| sum)).chain(work) {
            *form = found.through(arena, form).by_names(&[(found.slope.clone(), slope.clone())]);
        }
        self.share(found.definitions(self.chart));
        self.pulled_back = Some(found);
    }

    /// The normal form of a part of a slope.
    fn normal_form(&mut self, arena: &mut Arena, form: Expr) -> Polynomial {
        let form = self.means.normal_form(arena, form);
        if matches!(self.means, Means::Unit(_)) {
            return form;
        }
        let Some(shorter) = through_second_invariant(arena, &form) else { return form };
        self.share(vec![second::definition(arena, self.chart)]);
        shorter
    }

    /// Shares a sum that is raised to a power.
    fn raised(&mut self, arena: &mut Arena, (symbol, form): (Expr, Polynomial), is_factor: bool) {
        let mut form = form;
        if is_factor
            && let Some(isochoric) = self.means.isochoric(arena)
            && let Some(counted) = isochoric.through_excess(arena, &form)
        {
            let definitions = Isochoric::definitions(&isochoric, arena);
            self.share(definitions);
            form = counted;
        }
        form = self.means.known(arena, symbol, form, is_factor);
        self.share(vec![(symbol, form)]);
    }

    /// `Q_tr`, or `phi^T Q_tr` beside `p_hat`; the slopes carry the sign.
    fn force_on_centre(&mut self, arena: &mut Arena, slopes: &[(Base, Polynomial)], i: usize) -> Polynomial {
        let mut force = Polynomial::zero();
        for (base, slope) in slopes {
            let Base::Position(j) = base else { continue };
            let body = self.chart.linear == Some(Linear::Body);
            if !body && *j != i {
                continue;
            }
            let slope = self.named(arena, base.slope(), slope);
            match body {
                true => force.add_product(&slope, &Polynomial::atom(self.chart.phi.0[*j][i]), &Rational::ONE),
                false => force.add_scaled(&slope, &Rational::ONE),
            }
        }
        force
    }

    /// What is shared completed by the definitions of the tensors, the cofactors and the volume.
    fn finished(mut self, arena: &mut Arena) -> Load {
        self.means.settle(arena, &mut self.load);
        let uses_root = {
            let root = arena.symbols([
                Quantity::Dilatation,
                Quantity::InverseDilatation,
                Quantity::ExcessDilatation,
            ]);
            let mut is_root = |symbol: Expr| root.contains(&symbol);
            let shared = self.load.shared.iter().map(|(_, form)| form);
            shared
                .chain(self.load.forces.iter().map(|(_, form)| form))
                .chain(self.load.work.iter().map(|(_, form)| form))
                .any(|form| form.any_symbol(arena, &mut is_root))
        };
        let definitions = self.means.definitions(arena, self.chart, uses_root);
        self.share(definitions);
        self.load
    }

    /// The forces on the affine momentum.
    fn forces(&mut self, arena: &mut Arena, slopes: &[(Base, Polynomial)]) -> Vec<Vec<Polynomial>> {
        let mut forces = match self.along {
            Along::Placement => self.on_placement(arena, slopes),
            _ => self.on_spin(arena, slopes),
        };
        let Some(pulled_back) = self.pulled_back.take() else { return forces };
        let [left, right] = pulled_back.direction(self.along);
        for (b, entry) in right.iter().enumerate() {
            let weighted = pulled_back.slope.mul(&Polynomial::atom(*entry));
            let weighted = self.named(arena, Quantity::Weighted.at([b + 1]), &weighted);
            for (row, entry) in forces.iter_mut().zip(left) {
                row[b].add_product(&weighted, &Polynomial::atom(*entry), &Rational::ONE);
            }
        }
        forces
    }

    pub(super) fn empty(&self) -> Vec<Vec<Polynomial>> {
        table(self.chart.dim, |_, _| Polynomial::zero())
    }
}
