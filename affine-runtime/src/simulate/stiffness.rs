//! Whether a motion is stiff in what a piece of it has in closed form.

use super::course::Course;
use super::layout::momentum_in;
use super::range::by_halves;
use crate::inner::is_emitted;
use crate::inner::{EVALUATIONS_OF_FASTEST, fastest};
use crate::integrate::splitting::Pieces;
use crate::integrate::{AdaptiveSplitting, Failure};
use crate::model::Model;

/// Steps by pieces pay from so many radians of the fastest motion times `tolerance^(1/8)` on: three compositions of seven
/// flows, each as long as some dozen evaluations, take the time of some twenty steps of order 8, which are
/// `9 tolerance^(1/8)` radians long at the most; and later steps may be half as long as the first.
const STIFF: f64 = 475.0;
/// Trying one costs a part of a run of so many.
const WORTH_A_TRIAL: f64 = 10.0;

/// Where steps by pieces are not emitted, they are named from this tolerance up, at which a trial of them meets it. At tighter ones
/// what a dilatation does to the rest within a step may be too much, more or less from start to start.
const SURE: f64 = 1e-2;
/// They are named where the rest of the motion makes at most so many radians within such a step: a shear as stiff as the
/// dilatation makes hundreds, and the trial fails.
const RESOLVED: f64 = 1.0;

/// Exact flows of the pieces of a model.
pub(super) trait PiecesOf<const N: usize, M: Model<N>>:
    Pieces<M::Reduced<f64>, M::Constants<f64>>
{
}
impl<const N: usize, M: Model<N>, R: Pieces<M::Reduced<f64>, M::Constants<f64>>> PiecesOf<N, M> for R {}

/// An integration by the pieces of a model.
type ByPieces<const N: usize, M, R> =
    AdaptiveSplitting<<M as Model<N>>::Reduced<f64>, <M as Model<N>>::Constants<f64>, R>;

/// The integration by pieces from the start of a course; `None` where there is no such order.
pub(super) fn adaptive<const N: usize, M: Model<N>, R: PiecesOf<N, M>>(
    model: &M,
    pieces: R,
    order: Option<usize>,
    (reduced, constants): (M::Reduced<f64>, M::Constants<f64>),
    course: &Course<'_, M::Point<f64>>,
) -> Option<Result<ByPieces<N, M, R>, Failure>> {
    let Course { t0, t_end, tolerance, .. } = *course;
    let closed =
        |t: f64, reduced: &M::Reduced<f64>| model.reduced_equations(t, &constants, &model.renewed(reduced));
    let equations = (&closed, M::DESCRIPTION.reduced);
    AdaptiveSplitting::new((pieces, constants), order, equations, (t0, reduced), t_end, tolerance)
}

/// What a trial has shown.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Trial {
    /// How many radians of the fastest motion steps by pieces can be long, where that is worth while.
    pub(super) radians: Option<f64>,
    /// What it took: a step, and as many evaluations as a start.
    pub(super) evaluations: u64,
}

/// How long steps by pieces would be, and how many radians of the fastest motion that is, where a course is long enough for
/// a trial of one.
fn worth_a_trial<const N: usize, M: Model<N>>(
    (model, constants): (&M, &M::Constants<f64>),
    (reduced, course): (&M::Reduced<f64>, &Course<'_, M::Point<f64>>),
) -> Option<(f64, f64)> {
    let closed =
        |t: f64, reduced: &M::Reduced<f64>| model.reduced_equations(t, constants, &model.renewed(reduced));
    let radians = STIFF * libm::pow(course.tolerance, 0.125);
    let length = radians / fastest(&closed, (course.t0, reduced));
    (length * WORTH_A_TRIAL <= (course.t_end - course.t0).abs()).then_some((length, radians))
}

/// How many radians of a stiff dilatation steps by pieces would pass over, were these emitted, at tolerances at which a trial of them
/// is as good as sure: the pieces alone tell. It takes twice the evaluations of a look at the fastest motion.
pub(super) fn would_pass_over<const N: usize, M: Model<N>>(
    model: &M,
    course: &Course<'_, M::Point<f64>>,
) -> Option<f64> {
    let may_be =
        const { M::DESCRIPTION.dilates } && course.tolerance >= SURE && M::splitting(model).is_none();
    if !may_be || !by_halves::<N, M>(model, course) {
        return None;
    }
    let momentum = const { momentum_in(M::DESCRIPTION.reduced, N) }?;
    let (reduced, constants) = model.reduce(course.t0, course.start);
    let (length, radians) = worth_a_trial((model, &constants), (&reduced, course))?;
    // A stiff dilatation acts on all of the diagonal alike.
    let others = |t: f64, reduced: &M::Reduced<f64>| {
        let mut rates = model.reduced_equations(t, &constants, &model.renewed(reduced));
        let diagonal = || momentum.clone().step_by(N + 1);
        let mean = diagonal().map(|entry| rates.as_ref()[entry]).sum::<f64>() / N as f64;
        diagonal().for_each(|entry| rates.as_mut()[entry] -= mean);
        rates
    };
    let is_resolved = length * fastest(&others, (course.t0, &reduced)) < RESOLVED;
    is_resolved.then_some(radians)
}

/// Whether steps by pieces are worth while: where one of the pieces has a stiff motion in closed form, and the tolerance lets
/// a first step pass over several turns of it.
pub(super) fn stiffness<const N: usize, M: Model<N>, R: PiecesOf<N, M>>(
    model: &M,
    pieces: Option<R>,
    course: &Course<'_, M::Point<f64>>,
) -> Trial {
    if const { !(is_emitted::<R>() && R::DILATES) } {
        return Trial::default();
    }
    let (reduced, constants) = model.reduce(course.t0, course.start);
    let looked = Trial { radians: None, evaluations: EVALUATIONS_OF_FASTEST };
    let Some((length, radians)) = worth_a_trial((model, &constants), (&reduced, course)) else {
        return looked;
    };
    let begun = pieces.and_then(|pieces| adaptive(model, pieces, None, (reduced, constants), course));
    let Some(Ok(mut integration)) = begun else { return looked };
    let radians = integration.allows(length).then_some(radians);
    Trial { radians, evaluations: looked.evaluations + integration.statistics().evaluations }
}
