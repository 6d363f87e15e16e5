//! The integrators, each begun on the state that it steps.

use super::by_equations::{by_gauss, chart, reduced};
use super::by_radau::by_radau;
use super::by_rattle::by_rattle;
use super::choice::choose;
use super::course::Course;
use super::layout::{Layout, carries_dilatation, has_work, moves_on_group};
use super::method::Method;
use super::motion::{At, Goal, Launched, Purpose, begun, expansion, launched};
use super::range::in_range;
use super::stiffness::{PiecesOf, adaptive};
use crate::error::{Reason, Setting};
use crate::inner::{InVectors, is_emitted};
use crate::integrate::lie::Flat;
use crate::integrate::nystrom::Tableau;
use crate::integrate::{RungeKutta5, RungeKutta8, RungeKuttaNystrom, Splitting, Taylor};
use crate::model::Model;
use crate::state::Phase;
use affine_core::system::{Packing, SecondOrder, Series};

/// Begins to integrate `model` by the best method there is, or one that the automatic choice has.
pub(super) fn automatic<'a, const N: usize, M: Model<N> + 'a, H: Purpose<'a, N, Model = M>>(
    model: &H,
    course: &Course<'_, M::Point<f64>>,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason> {
    begin::<N, M, H, false>(model, course, goal)
}

/// Begins to integrate `model` by the method that was asked for.
pub(super) fn named<'a, const N: usize, M: Model<N> + 'a, H: Purpose<'a, N, Model = M>>(
    model: &H,
    course: &Course<'_, M::Point<f64>>,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason> {
    begin::<N, M, H, true>(model, course, goal)
}

/// Begins to integrate `model` by splitting in equal steps, which is what was asked for.
pub(super) fn by_splitting<'a, const N: usize, M: Model<N> + 'a, H: Purpose<'a, N, Model = M>>(
    model: &H,
    course: &Course<'_, M::Point<f64>>,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason> {
    let Method::Splitting { order, step } = course.method else {
        return Err(not_emitted::<N, M>("splitting"));
    };
    goal.choice.needs_determinant = const { carries_dilatation(&M::DESCRIPTION) };
    if goal.choice.needs_determinant {
        in_range(course.t0, model.model().orthonormal(course.start).phi())?;
    }
    by_pieces((model, course), |model: H| M::splitting(model), (order, step), goal)
}

/// Begins to integrate `model` by Runge-Kutta steps of order 8, which is what was asked for.
pub(super) fn by_any_steps<'a, const N: usize, M: Model<N> + 'a, H: Purpose<'a, N, Model = M>>(
    model: &H,
    course: &Course<'_, M::Point<f64>>,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason> {
    by_any_equations::<N, M, H, false>((model, course), Method::RungeKutta8, goal)
}

/// Begins to integrate `model`. What depends on the model alone, and on whether the program names methods, is decided by
/// constants: only the integrators that can be taken are compiled.
fn begin<'a, const N: usize, M: Model<N> + 'a, H: Purpose<'a, N, Model = M>, const NAMED: bool>(
    model: &H,
    course: &Course<'_, M::Point<f64>>,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason> {
    if const { M::IS_GEODESIC && !NAMED } {
        return Err(Setting::NoClosedForm { model: M::DESCRIPTION.name }.into());
    }
    choose::<N, M>(model.model(), course, goal.choice);
    let method = goal.choice.method;
    if goal.choice.needs_determinant {
        in_range(course.t0, model.model().orthonormal(course.start).phi())?;
    }
    let at = (model, course);
    match method {
        Method::RungeKuttaNystrom12 => {
            by_halves(at, |model: H| M::second_order(model), &Tableau::ORDER_12, goal)
        }
        Method::RungeKuttaNystrom8 => {
            by_halves(at, |model: H| M::second_order(model), &Tableau::ORDER_8, goal)
        }
        Method::Taylor { order } => by_series(at, |model: H| M::taylor(model), order, goal),
        Method::AdaptiveSplitting { order } => {
            by_adaptive_pieces::<N, M, _, _, NAMED>(at, |model: H| M::splitting(model), order, goal)
        }
        Method::Splitting { order, step } if const { NAMED } => {
            by_pieces(at, |model: H| M::splitting(model), (order, step), goal)
        }
        Method::Rattle { order, step } if const { NAMED } => {
            by_rattle(at, |model: H| M::unconstrained(model), (order, step), goal)
        }
        Method::Radau { stages }
            if const { !moves_on_group(&M::DESCRIPTION, N) && (NAMED || has_work(&M::DESCRIPTION)) } =>
        {
            by_radau(at, stages, goal)
        }
        Method::RungeKutta8 | Method::RungeKutta5 | Method::Gauss { .. } | Method::Radau { .. } => {
            by_any_equations::<N, M, _, NAMED>(at, method, goal)
        }
        // Of a closed form there are no steps, and the choice has put a method in the place of the automatic one, which is none
        // of those that are equal steps.
        Method::ClosedForm | Method::Automatic | Method::Splitting { .. } | Method::Rattle { .. } => {
            by_any_equations::<N, M, _, NAMED>(at, Method::RungeKutta8, goal)
        }
    }
}

/// The state by a method for any equations: those in vectors, or those on a group.
fn by_any_equations<'a, const N: usize, M: Model<N> + 'a, H: Purpose<'a, N, Model = M>, const NAMED: bool>(
    at: At<'_, N, M, H>,
    method: Method,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason> {
    if const { !moves_on_group(&M::DESCRIPTION, N) } {
        free::<N, M, _, _, NAMED>(at, |model: H| M::packing(model), method, goal)
    } else {
        reduced::<N, M, _, _, NAMED>(at, chart::<N, M>(M::DESCRIPTION.reduced)?, method, goal)
    }
}

/// The reduced state by its Taylor series.
fn by_series<'a, const N: usize, M, R, H>(
    at: At<'_, N, M, H>,
    capability: impl Fn(H) -> Option<R> + Copy + 'a,
    order: Option<usize>,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    R: Series<M::Reduced<f64>, M::Constants<f64>> + 'a,
    H: Purpose<'a, N, Model = M>,
{
    if const { !is_emitted::<R>() } {
        return Err(not_emitted::<N, M>("taylor"));
    }
    let (groups, layout) = (M::DESCRIPTION.reduced, const { Layout::of(M::DESCRIPTION.reduced, N) });
    launched(at, layout, goal, move |model: &H, course| {
        let series = capability(model.clone()).ok_or_else(|| not_emitted::<N, M>("taylor"))?;
        let (reduced, constants) = model.model().reduce(course.t0, course.start);
        let Course { t0, t_end, tolerance, .. } = *course;
        let taylor = Taylor::new((series, constants), groups, (t0, reduced), t_end, tolerance, order);
        let expand = expansion(model, constants);
        begun::<N, M, _, _>(course, taylor, expand)
    })
}

/// The reduced state by the exact flows of pieces.
fn by_pieces<'a, const N: usize, M, R, H>(
    at: At<'_, N, M, H>,
    capability: impl Fn(H) -> Option<R> + Copy + 'a,
    (order, step): (usize, f64),
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    R: PiecesOf<N, M> + 'a,
    H: Purpose<'a, N, Model = M>,
{
    if const { !is_emitted::<R>() } {
        return Err(not_emitted::<N, M>("splitting"));
    }
    let layout = const { Layout::of(M::DESCRIPTION.reduced, N) };
    launched(at, layout, goal, move |model: &H, course| {
        let pieces = capability(model.clone()).ok_or_else(|| not_emitted::<N, M>("splitting"))?;
        let (reduced, constants) = model.model().reduce(course.t0, course.start);
        let begin = (course.t0, reduced);
        let splitting = Splitting::new((pieces, constants), order, begin, course.t_end, step);
        let expand = expansion(model, constants);
        begun::<N, M, _, _>(course, splitting.ok_or(Setting::Order { given: order })?, expand)
    })
}

/// The same in steps by their error. The automatic choice takes only pieces with a stiff motion of their own.
fn by_adaptive_pieces<'a, const N: usize, M, R, H, const NAMED: bool>(
    at: At<'_, N, M, H>,
    capability: impl Fn(H) -> Option<R> + Copy + 'a,
    order: Option<usize>,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    R: PiecesOf<N, M> + 'a,
    H: Purpose<'a, N, Model = M>,
{
    if const { !(is_emitted::<R>() && (NAMED || R::DILATES)) } {
        return Err(not_emitted::<N, M>("splitting"));
    }
    let layout = const { Layout::of(M::DESCRIPTION.reduced, N) };
    launched(at, layout, goal, move |model: &H, course| {
        let pieces = capability(model.clone()).ok_or_else(|| not_emitted::<N, M>("splitting"))?;
        let (reduced, constants) = model.model().reduce(course.t0, course.start);
        let integration = adaptive(model.model(), pieces, order, (reduced, constants), course);
        let given = order.unwrap_or_default();
        let expand = expansion(model, constants);
        begun::<N, M, _, _>(course, integration.ok_or(Setting::Order { given })?, expand)
    })
}

/// The halves of the reduced state by Runge-Kutta-Nystrom steps.
fn by_halves<'a, const N: usize, M, R, H>(
    at: At<'_, N, M, H>,
    capability: impl Fn(H) -> Option<R> + Copy + 'a,
    tableau: &'static Tableau,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    R: SecondOrder<M::Reduced<f64>, M::Constants<f64>> + 'a,
    H: Purpose<'a, N, Model = M>,
{
    if const { !is_emitted::<R>() } {
        return Err(not_emitted::<N, M>("nystrom"));
    }
    let (groups, layout) = (M::DESCRIPTION.reduced, const { Layout::of(M::DESCRIPTION.reduced, N) });
    launched(at, layout, goal, move |model: &H, course| {
        let system = capability(model.clone()).ok_or_else(|| not_emitted::<N, M>("nystrom"))?;
        let (reduced, constants) = model.model().reduce(course.t0, course.start);
        let Course { t0, t_end, tolerance, .. } = *course;
        let begin = (t0, reduced);
        let nystrom = RungeKuttaNystrom::new((system, constants), tableau, groups, begin, t_end, tolerance);
        // What follows from the positions is computed where it is asked for, not at every step.
        let model = model.clone();
        let expand = move |t: f64, halves: &M::Reduced<f64>| {
            model.model().expand(t, &constants, &model.model().renewed(halves))
        };
        begun::<N, M, _, _>(course, nystrom, expand)
    })
}

/// The reduced state of a body without constraints, in vectors of four where the model has its equations so; implicit
/// methods take single components.
fn free<'a, const N: usize, M, R, H, const NAMED: bool>(
    at: At<'_, N, M, H>,
    capability: impl Fn(H) -> Option<R> + Copy + 'a,
    method: Method,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    R: Packing<M::Reduced<f64>, M::Constants<f64>> + 'a,
    H: Purpose<'a, N, Model = M>,
{
    if const { !is_emitted::<R>() } {
        return reduced::<N, M, _, _, NAMED>(at, Flat, method, goal);
    }
    let (groups, layout) = (M::DESCRIPTION.reduced, const { Layout::of(M::DESCRIPTION.reduced, N) });
    let field = move |model: &H, course: &Course<'_, M::Point<f64>>| {
        let packing = capability(model.clone()).ok_or_else(|| not_emitted::<N, M>("packing"))?;
        let (reduced, constants) = model.model().reduce(course.t0, course.start);
        let expand = expansion(model, constants);
        Ok::<_, Reason>((InVectors(packing, constants), (course.t0, reduced), expand))
    };
    match method {
        Method::Gauss { stages, step } if const { NAMED } => by_gauss(at, Flat, (stages, step), goal),
        Method::RungeKutta5 if const { NAMED } => launched(at, layout, goal, move |model, course| {
            let (field, begin, expand) = field(model, course)?;
            let steps = RungeKutta5::in_vectors(field, groups, begin, course.t_end, course.tolerance);
            begun::<N, M, _, _>(course, steps, expand)
        }),
        _ => launched(at, layout, goal, move |model, course| {
            let (field, begin, expand) = field(model, course)?;
            let steps = RungeKutta8::in_vectors(field, groups, begin, course.t_end, course.tolerance);
            begun::<N, M, _, _>(course, steps, expand)
        }),
    }
}

/// A capability that the model was not given.
fn not_emitted<const N: usize, M: Model<N>>(key: &'static str) -> Reason {
    Setting::NotEmitted { model: M::DESCRIPTION.name, key }.into()
}
