//! The method of order 8 for several bodies at once, each in a lane with steps of its own.

mod attempt;
mod before;
mod dense;
mod end;

use attempt::{AT_BEGIN, AT_END, Attempt, Slopes};
use before::Before;
use pulp::{Simd, WithSimd};

use super::dormand_prince_853::*;
use super::field::STAGES;
use super::pair::DormandPrince853;
use super::start::Start;
use super::step::Pair;
use crate::error_norm::{GROUPS as MEASURED, Measured, NormInLanes};
use crate::lanes::Lanes;
use crate::lanes::equations::Equations;
use crate::lanes::parts::{in_lanes, part, parts, set_part};
use crate::step_size::Controller;
use crate::step_size::in_lanes::{Clocks, fate};
use affine_core::model::StateVector;

/// Bodies in lanes: [`RungeKutta8`](super::RungeKutta8) of each, operation by operation, at its own time and with its own
/// steps. A lane that is done is given the next body, while the others are on their way.
pub struct RungeKutta8InLanes<T, S, F> {
    f: F,
    norm: NormInLanes<T>,
    tolerance: f64,
    clocks: Clocks<T>,
    y: S,
    trial: S,
    stages: Slopes<S>,
    /// Estimated errors of the last attempts over their lengths, and sizes.
    measured: [Measured<T>; MEASURED],
    /// Where the last attempts began, if that is kept.
    before: Option<Before<T, S>>,
}

/// What happens to the body in a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It has come to the end.
    Arrived,
    /// It has taken as many steps as it may.
    Limited,
    /// It cannot go on, or not in lanes.
    Stuck,
}

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> RungeKutta8InLanes<T, S, F> {
    /// Lanes without bodies, for motions to `t_end` of at most so many steps. All are to be given one before the first
    /// step: there is no motion from a state of zeros. One that has come to the end stays there, until the end is
    /// [another](Self::aim) or the lane is given the next.
    pub fn new(f: F, t_end: f64, tolerance: f64, max_steps: u64) -> Self {
        const { assert!(T::LANES.is_multiple_of(8), "lanes fill the vectors of every processor") }
        const { assert!(F::GROUPS.len() <= MEASURED, "all groups are measured") }
        Self {
            f,
            norm: NormInLanes::new(F::GROUPS),
            tolerance,
            clocks: Clocks::new(
                Controller::of(DormandPrince853::ERROR_ORDER, DormandPrince853::MARGIN),
                t_end,
                max_steps,
            ),
            y: S::zeros(),
            trial: S::zeros(),
            stages: [S::zeros(); STAGES + 1],
            measured: [Measured::nothing(); MEASURED],
            before: None,
        }
    }

    /// The equations.
    pub fn equations(&self) -> &F {
        &self.f
    }

    /// The equations, to be changed between steps.
    pub fn equations_mut(&mut self) -> &mut F {
        &mut self.f
    }

    /// Goes on to another end, by at most so many steps.
    pub fn aim(&mut self, t_end: f64, max_steps: u64) {
        self.clocks.aim(t_end, max_steps);
    }

    /// Puts a body into a lane.
    pub fn start<R: StateVector<f64>>(&mut self, lane: usize, (t0, y0): (f64, &R), start: &Start<R>) {
        let from = y0.as_ref().iter().zip(start.slope.as_ref());
        for ((y, slope), (y0, slope0)) in self.y.as_mut().iter_mut().zip(self.stages[0].as_mut()).zip(from) {
            y.set_lane(lane, *y0);
            slope.set_lane(lane, *slope0);
        }
        self.norm.set_lane(lane, &start.error_norm);
        self.clocks.start(lane, t0, start.length);
        self.before.iter_mut().for_each(|before| before.t.set_lane(lane, t0));
    }

    /// Stops what moves in a lane, from now on where its last step began, if that is kept: equations are evaluated there.
    pub fn rest(&mut self, lane: usize) {
        let has_stepped = self.has_stepped(lane);
        self.clocks.rest(lane);
        if let Some(before) = self.before.as_ref().filter(|_| has_stepped) {
            let at_begin = self.stages[AT_BEGIN];
            for (now, begin) in [(&mut self.y, &before.y), (&mut self.stages[0], &at_begin)] {
                let numbers = now.as_mut().iter_mut().zip(begin.as_ref());
                numbers.for_each(|(now, begin)| now.set_lane(lane, begin.lane(lane)));
            }
        }
    }

    /// Tries one step in every lane; what becomes of a body, where its way ends.
    pub fn advance(&mut self) -> impl Iterator<Item = (usize, Fate)> + use<T, S, F> {
        if let Some(before) = &mut self.before {
            before.begin(self.clocks.t, &self.y);
            self.stages[AT_BEGIN] = self.stages[0];
        }
        let is_a_last_resort = self.f.are_a_last_resort();
        let fates = in_lanes::<T, _>(Trial(self), is_a_last_resort);
        // Most steps are nobody's last, and all lanes are seen at once.
        let are_under_way = fates.as_slice().iter().all(|fate| *fate == fate::UNDER_WAY);
        let ended = if are_under_way { 0..0 } else { 0..T::LANES };
        ended.filter_map(move |lane| match fates.lane(lane) {
            fate::UNDER_WAY => None,
            fate::ARRIVED => Some((lane, Fate::Arrived)),
            fate::LIMITED => Some((lane, Fate::Limited)),
            _ => Some((lane, Fate::Stuck)),
        })
    }

    /// States reached.
    pub fn y(&self) -> &S {
        &self.y
    }

    #[inline(always)]
    fn step<V: Simd>(&mut self, simd: V) -> T {
        let Self { f, y, trial, stages, clocks, measured, .. } = self;
        let (t, end) = (clocks.t, clocks.end);
        let mut attempt = Attempt { f, t, end, h: end - t, y, stages, trial };
        attempt.stage(simd, NODES[0], &A2);
        attempt.stage(simd, NODES[1], &A3);
        attempt.stage(simd, NODES[2], &A4);
        attempt.stage(simd, NODES[3], &A5);
        attempt.stage(simd, NODES[4], &A6);
        attempt.stage(simd, NODES[5], &A7);
        attempt.stage(simd, NODES[6], &A8);
        attempt.stage(simd, NODES[7], &A9);
        attempt.stage(simd, NODES[8], &A10);
        attempt.stage(simd, NODES[9], &A11);
        attempt.stage(simd, NODES[10], &A12);
        let doubt = attempt.end(simd, measured);
        let h = attempt.h.abs();
        let lasting = h.max(clocks.lasting);
        let error =
            h / T::constant(self.tolerance, 0.0) * self.norm.largest(simd, lasting, F::GROUPS, measured);
        self.turn(simd, error, doubt)
    }

    /// Accepts the steps with errors of at most 1 whose slopes at the end are finite; what becomes of the lanes.
    #[inline(always)]
    fn turn<V: Simd>(&mut self, simd: V, error: T, doubt: T) -> T {
        let (mut errors, mut unsound) = (T::zero(), doubt);
        for lane in 0..T::LANES {
            unsound.set_lane(lane, if self.f.is_sound(&self.trial, lane) { unsound.lane(lane) } else { 1.0 });
        }
        let (zero, one) = (simd.splat_f64s(0.0), simd.splat_f64s(1.0));
        for k in 0..parts::<V, T>() {
            let mut not_finite = zero;
            for slope in self.stages[AT_END].as_ref() {
                // 0, or NaN once one of them is not finite.
                not_finite = simd.add_f64s(not_finite, simd.mul_f64s(zero, part(simd, slope, k)));
            }
            let error = simd.add_f64s(part(simd, &error, k), not_finite);
            // Accepted, and then given up.
            let is_plain = simd.equal_f64s(part(simd, &doubt, k), zero);
            let error = simd.select_f64s(is_plain, error, zero);
            // A lane at the end keeps what it has reached.
            let (t, end) = (part(simd, &self.clocks.t, k), part(simd, &self.clocks.end, k));
            let error = simd.select_f64s(simd.equal_f64s(t, end), simd.splat_f64s(f64::NAN), error);
            let is_accepted = simd.less_than_or_equal_f64s(error, one);
            set_part(simd, &mut errors, k, error);
            for i in 0..S::LEN {
                let (slope, trial) = (self.stages[AT_END].as_ref()[i], self.trial.as_ref()[i]);
                let (first, y) = (&mut self.stages[0].as_mut()[i], &mut self.y.as_mut()[i]);
                for (kept, next) in [(first, slope), (y, trial)] {
                    let (before, after) = (part(simd, kept, k), part(simd, &next, k));
                    set_part(simd, kept, k, simd.select_f64s(is_accepted, after, before));
                }
            }
        }
        self.clocks.turn(errors, unsound)
    }
}

/// A step in every lane.
struct Trial<'a, T, S, F>(&'a mut RungeKutta8InLanes<T, S, F>);

impl<T: Lanes, S: StateVector<T>, F: Equations<T, S>> WithSimd for Trial<'_, T, S, F> {
    type Output = T;
    #[inline(always)]
    fn with_simd<V: Simd>(self, simd: V) -> T {
        self.0.step(simd)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::F64x8;
    use crate::{Failure, RungeKutta8};
    use affine_core::__private::numerics::IS_FUSED;
    use affine_core::model::{Group, Quantity};
    use affine_core::scalar::Scalar;
    use core::array;
    use pulp::Arch;

    const GROUPS: &[Group] = &[Group::new(Quantity::Position, 1), Group::new(Quantity::Other("v"), 1)];
    const T_END: f64 = 20.0;
    const TOLERANCE: f64 = 1e-10;

    /// `x'' = -x^3`: the larger the amplitude, the faster.
    fn slope<T: Scalar>([x, v]: &[T; 2]) -> [T; 2] {
        [*v, -(*x * *x * *x)]
    }

    struct Duffing;

    impl<T: Lanes> Equations<T, [T; 2]> for Duffing {
        const GROUPS: &'static [Group] = GROUPS;
        #[inline(always)]
        fn slope(&self, _t: T, y: &[T; 2], rates: &mut [T; 2]) {
            *rates = slope(y);
        }
        #[inline(always)]
        fn is_sound(&self, _y: &[T; 2], _lane: usize) -> bool {
            true
        }
    }

    fn start(y: &[f64; 2]) -> Result<Start<[f64; 2]>, Failure> {
        let start = Start::of::<DormandPrince853>(&|_, y| slope(y), GROUPS, (0.0, y), T_END, TOLERANCE);
        start.map(|(start, _)| start)
    }

    /// One body after the other through eight lanes: each is there as many attempts as it takes alone, and none waits.
    #[test]
    fn no_lane_waits_for_another() -> Result<(), Failure> {
        let bodies: Vec<[f64; 2]> = (0..21).map(|k| [0.1 * 1.3_f64.powi(k), 0.0]).collect();
        let mut alone = Vec::new();
        for y in &bodies {
            let mut integration = RungeKutta8::new(|_, y| slope(y), GROUPS, (0.0, *y), T_END, TOLERANCE)?;
            while !integration.is_finished() {
                integration.advance()?;
            }
            let cost = integration.statistics();
            alone.push((*integration.y(), cost.steps + cost.rejected));
        }
        let mut lanes = RungeKutta8InLanes::<F64x8, _, _>::new(Duffing, T_END, TOLERANCE, 1_000_000);
        let (mut waiting, mut begun, mut found) = (8..bodies.len(), Vec::new(), vec![None; bodies.len()]);
        for lane in 0..8 {
            lanes.start(lane, (0.0, &bodies[lane]), &start(&bodies[lane])?);
            begun.push((lane, 0));
        }
        for attempt in 1_u64.. {
            for (lane, fate) in lanes.advance() {
                let (body, begin) = begun[lane];
                assert_eq!(fate, Fate::Arrived);
                found[body] = Some((lanes.y().map(|component| component.lane(lane)), attempt - begin));
                match waiting.next() {
                    Some(next) => {
                        lanes.start(lane, (0.0, &bodies[next]), &start(&bodies[next])?);
                        begun[lane] = (next, attempt);
                    }
                    None => lanes.rest(lane),
                }
            }
            if found.iter().all(Option::is_some) {
                break;
            }
        }
        let alone: Vec<_> = alone.into_iter().map(Some).collect();
        assert_eq!(found, alone);
        let attempts: Vec<u64> = alone.iter().flatten().map(|(_, attempts)| *attempts).collect();
        // One more where the target promises a fused multiply-add.
        let slow = if IS_FUSED { 19 } else { 18 };
        assert_eq!((attempts[0], attempts[20]), (slow, 2515), "slow and fast bodies");
        Ok(())
    }

    /// To an end, a further one and one before it, with lanes that wait for others and one that rests: where each is alone, and
    /// where its last steps began.
    #[test]
    fn lanes_go_on_to_other_ends() -> Result<(), Failure> {
        let bodies: Vec<[f64; 2]> = (0..8).map(|k| [0.3 * 1.7_f64.powi(k), -0.0]).collect();
        let ends = [T_END, T_END + 0.01, 25.0, 3.0];
        let alone = |y: &[f64; 2]| RungeKutta8::new(|_, y| slope(y), GROUPS, (0.0, *y), T_END, TOLERANCE);
        let mut alone = bodies.iter().map(alone).collect::<Result<Vec<_>, _>>()?;
        let mut lanes = RungeKutta8InLanes::<F64x8, _, _>::new(Duffing, T_END, TOLERANCE, 1_000_000);
        lanes.keep();
        for lane in 0..8 {
            lanes.start(lane, (0.0, &bodies[lane]), &start(&bodies[lane])?);
        }
        lanes.rest(2);
        for t_end in ends {
            lanes.aim(t_end, 1_000_000);
            let mut is_moving: [bool; 8] = array::from_fn(|lane| lane != 2);
            alone.iter_mut().for_each(|body| body.aim(t_end));
            while is_moving.contains(&true) {
                for (lane, fate) in lanes.advance() {
                    assert_eq!((fate, is_moving[lane]), (Fate::Arrived, true), "{lane}, {t_end}");
                    is_moving[lane] = false;
                    let body = &mut alone[lane];
                    let mut begin = (body.t(), *body.y());
                    while !body.is_finished() {
                        begin = (body.t(), *body.y());
                        body.advance()?;
                    }
                    assert_eq!(lanes.begin(lane), Some(begin), "{lane}, {t_end}");
                }
            }
            for (lane, body) in alone.iter().enumerate().filter(|(lane, _)| *lane != 2) {
                let reached = lanes.y().map(|component| component.lane(lane).to_bits());
                assert_eq!((lanes.t(lane), reached), (t_end, body.y().map(f64::to_bits)), "{lane}, {t_end}");
            }
        }
        lanes.aim(4.0, 2);
        let stopped = loop {
            let fates: Vec<_> = lanes.advance().collect();
            if !fates.is_empty() {
                break fates;
            }
        };
        assert!(stopped.iter().any(|(_, fate)| *fate == Fate::Limited), "{stopped:?}");
        Ok(())
    }

    /// States after some attempts on one kind of vectors, with the fates on the way, as bits.
    fn course<T: Lanes>(attempt: impl Fn(Trial<'_, T, [T; 2], Duffing>) -> T) -> Result<Vec<u64>, Failure> {
        let mut lanes = RungeKutta8InLanes::new(Duffing, T_END, TOLERANCE, 1_000_000);
        for lane in 0..8 {
            let y = [1.5_f64.powi(lane as i32), 0.1];
            lanes.start(lane, (0.0, &y), &start(&y)?);
        }
        let mut seen = Vec::new();
        for _ in 0..60 {
            let fates = attempt(Trial(&mut lanes));
            let numbers = [fates, lanes.y[0], lanes.y[1], lanes.clocks.t];
            seen.extend(numbers.iter().flat_map(|lanes| lanes.as_slice()).map(|number| number.to_bits()));
        }
        Ok(seen)
    }

    /// The bits of lanes, the same on all vectors.
    fn on_all_vectors<T: Lanes>() -> Result<Vec<u64>, Failure> {
        let widest = course::<T>(|trial| Arch::new().dispatch(trial))?;
        assert_eq!(course::<T>(|trial| pulp::Scalar::vectorize(pulp::Scalar, trial))?, widest);
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = pulp::x86::V3::try_new() {
            assert_eq!(course::<T>(|trial| Simd::vectorize(avx2, trial))?, widest);
        }
        assert_eq!(course::<T>(|trial| in_lanes::<T, _>(trial, true))?, widest, "as a last resort");
        Ok(widest)
    }

    #[test]
    fn vectors_of_any_width_round_the_same() -> Result<(), Failure> {
        let (rounded_as_numbers, fused) =
            (on_all_vectors::<F64x8>()?, on_all_vectors::<<F64x8 as Lanes>::Fused>()?);
        assert_eq!(rounded_as_numbers == fused, IS_FUSED, "lanes round as numbers do, unless asked");
        Ok(())
    }

    #[test]
    fn a_lane_stops_after_too_many_steps() -> Result<(), Failure> {
        let mut lanes = RungeKutta8InLanes::<F64x8, _, _>::new(Duffing, T_END, TOLERANCE, 3);
        for lane in 0..8 {
            let y = [if lane == 5 { 1.0 } else { 1e-6 }, 0.0];
            lanes.start(lane, (0.0, &y), &start(&y)?);
        }
        let mut fates = Vec::new();
        for _ in 0..3 {
            for (lane, fate) in lanes.advance() {
                fates.push((lane, fate));
                lanes.rest(lane);
            }
        }
        assert!(fates.contains(&(5, Fate::Limited)), "{fates:?}");
        Ok(())
    }
}
