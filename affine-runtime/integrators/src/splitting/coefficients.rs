//! Compositions of the exact flows of pieces.
//!
//! With the sweeps `chi_h = exp(hA) exp(hB) exp(hC)` through the pieces and `chi*_h` back, a step is
//!
//! ```text
//! chi*_(w_1 h) chi_(w_2 h) chi*_(w_3 h) ... chi_(w_2s h),          w_(2s+1-j) = w_j
//! ```
//!
//! (read from either end). Neighbouring flows of one piece are one: for two pieces it is the splitting
//! `A(c_1 h) B(c_2 h) A(c_3 h) ...` with `c_j = w_(j-1) + w_j`, and conditions on `c` for order `p` with two pieces are
//! conditions on `w` with any number of them (R. McLachlan, SIAM J. Sci. Comput. 16 (1995) 151-168). Published
//! methods are given by `c`.
//!
//! * Orders 4 and 6: S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313-330, methods S6 and S10; where
//!   `[B, [B, [B, A]]] = 0`, the Runge-Kutta-Nystrom methods SRKN6b and SRKN14a of the same article.
//! * Order 4 where the first piece is much larger than the second: S. Blanes, F. Casas, A. Farres, J. Laskar, J. Makazaga,
//!   A. Murua, Appl. Numer. Math. 68 (2013) 58-72, method ABA(10,4): errors of the first power of the small piece are of
//!   order 10, those of higher powers of order 4. Digits are those that its conditions leave.
//! * Order 2: G. Strang, SIAM J. Numer. Anal. 5 (1968) 506-517.
//! * Order 8: composition s17odr8a of W. Kahan, R.-C. Li, Math. Comp. 66 (1997) 1089-1099, of Strang's steps.

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod order_conditions;

use crate::composition::Composition;

/// Sweeps of the longest method.
const MOST: usize = 34;

/// `c_1, c_2, ...` of S6 without the last two of the half, which follow from the sums.
const S6: [f64; 5] = [
    0.079_203_696_431_195_7,
    0.209_515_106_613_362,
    0.353_172_906_049_774,
    -0.143_851_773_179_818,
    -0.042_065_080_357_719_5,
];

const S10: [f64; 9] = [
    0.050_262_764_400_392_2,
    0.148_816_447_901_042,
    0.413_514_300_428_344,
    -0.132_385_865_767_784,
    0.045_079_889_794_397_7,
    0.067_307_604_692_185,
    -0.188_054_853_819_569,
    0.432_666_402_578_175,
    0.541_960_678_450_780,
];

/// `c_1, c_2, ...` of SRKN6b, which begins with `B`.
const SRKN6B: [f64; 5] = [
    0.082_984_406_417_405_2,
    0.245_298_957_184_271,
    0.396_309_801_498_368,
    0.604_872_665_711_080,
    -0.039_056_304_922_348_6,
];

const SRKN14A: [f64; 13] = [
    0.037_859_319_840_611_6,
    0.091_719_152_624_461_65,
    0.102_635_633_102_435,
    0.183_983_170_005_006,
    -0.025_867_888_266_558_7,
    -0.056_534_365_832_888_27,
    0.314_241_403_071_447,
    0.004_914_688_774_712_854,
    -0.130_144_459_517_415,
    0.143_761_127_168_358,
    0.106_417_700_369_543,
    0.328_567_693_746_804,
    -0.008_794_243_128_510_58,
];

const ABA104: [f64; 6] = [
    0.047_067_100_645_972_506,
    0.118_881_917_368_197_02,
    0.184_756_935_417_088_1,
    0.241_050_460_551_501_57,
    0.282_706_005_679_836_2,
    -0.273_286_666_705_323_8,
];

/// A composition of flows: [`Sweeps::of_order`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sweeps {
    order: usize,
    /// Do sweeps begin with the last piece?
    from_last: bool,
    /// May the pieces change places, at about the same errors?
    may_swap: bool,
    count: usize,
    weights: [f64; MOST],
}

impl Sweeps {
    /// The method of order 2, 4, 6 or 8; `nystrom` tells that there are two pieces with `[B, [B, [B, A]]] = 0`.
    #[must_use]
    pub fn of_order(order: usize, nystrom: bool) -> Option<Self> {
        match (order, nystrom) {
            (2, _) => Some(Self::of_steps(2, Composition::of_order(2)?)),
            (4, false) => Some(Self::published((4, true), false, &S6)),
            (4, true) => Some(Self::published((4, false), true, &SRKN6B)),
            (6, false) => Some(Self::published((6, true), false, &S10)),
            (6, true) => Some(Self::published((6, false), false, &SRKN14A)),
            (8, _) => Some(Self::of_steps(8, Composition::of_order(8)?)),
            _ => None,
        }
    }

    /// The same for two pieces with `[B, [B, [B, A]]] = 0`, the first of them much larger than the second.
    #[must_use]
    pub fn near_integrable(order: usize) -> Option<Self> {
        match order {
            4 => Some(Self::published((4, false), false, &ABA104)),
            _ => Self::of_order(order, true),
        }
    }

    /// Halves of symmetric steps.
    fn of_steps(order: usize, composition: &Composition) -> Self {
        let mut weights = [0.0; MOST];
        for (pair, weight) in weights.chunks_exact_mut(2).zip(composition.weights()) {
            pair.fill(0.5 * weight);
        }
        Self { order, from_last: false, may_swap: true, count: 2 * composition.steps(), weights }
    }

    /// From `c_1, ..., c_(s-1)` of a palindrome of `2s + 1` flows; those of each piece sum to 1.
    fn published((order, may_swap): (usize, bool), from_last: bool, first: &[f64]) -> Self {
        let sweeps = first.len() + 1;
        let sum = |parity: usize| first.iter().skip(parity).step_by(2).sum::<f64>();
        // The last two of the half: the one beside the middle, and the middle one, which counts once.
        let beside = 0.5 - sum(first.len() % 2);
        let half = first.iter().copied().chain([beside]);
        let mut weights = [0.0; MOST];
        let mut before = 0.0;
        for (j, c) in half.enumerate() {
            before = c - before;
            weights[j] = before;
            weights[2 * sweeps - 1 - j] = before;
        }
        Self { order, from_last, may_swap, count: 2 * sweeps, weights }
    }

    /// The composition that begins with the last piece in place of the first one, or the other way round. The same one, where its
    /// conditions tell the pieces apart.
    #[must_use]
    pub fn from_the_other_end(&self) -> Self {
        Self { from_last: self.from_last != self.may_swap, ..*self }
    }

    /// Order of the method.
    #[must_use]
    pub fn order(&self) -> usize {
        self.order
    }

    /// Calls `flow(piece, t, c h)` for the flows of a step of length `h`, with the time up to which the first piece has moved.
    #[inline(always)]
    pub(super) fn each_timed(
        &self,
        pieces: usize,
        (t, h): (f64, f64),
        mut flow: impl FnMut(usize, f64, f64),
    ) {
        let mut elapsed = 0.0;
        self.each(
            pieces,
            #[inline(always)]
            |piece, part| {
                flow(piece, t + elapsed * h, part * h);
                elapsed += if piece == 0 { part } else { 0.0 };
            },
        );
    }

    /// Calls `flow(piece, c)` for the flows of one step in their order, `c h` being their times.
    #[inline(always)]
    pub fn each(&self, pieces: usize, mut flow: impl FnMut(usize, f64)) {
        let last = pieces.saturating_sub(1);
        let piece = |place: usize| if self.from_last { last - place } else { place };
        if last == 0 {
            return flow(0, 1.0);
        }
        let mut before = 0.0;
        for j in 0..=self.count {
            let weight = self.weights.get(j).copied().unwrap_or(0.0);
            let forth = j % 2 == 0;
            let places = if j == self.count { 1 } else { last };
            for place in 0..places {
                // At the flow where a sweep ends the next one begins.
                let part = if place == 0 { before + weight } else { weight };
                flow(piece(if forth { place } else { last - place }), part);
            }
            before = weight;
        }
    }
}
