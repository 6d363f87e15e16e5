//! The integrators, each begun on the state that it steps.

use super::layout::{Layout, carries_dilatation, has_multiplier, is_canonical, moves_on_group, placement_in};
use super::mechanics::Course;
use super::motion::{Expanded, Expansion};
use super::range::in_range;
use super::recorder::Recorder;
use super::stepper::{Explicit, Stepper};
use super::stiffness::{PiecesOf, Trial, adaptive, stiffness};
use super::{Method, NYSTROM_TOLERANCE, TAYLOR_TOLERANCE};
use crate::error::Reason;
use crate::error::Setting;
use crate::inner::is_emitted;
use crate::integrate::gauss::Tableau as Collocation;
use crate::integrate::lie::{Chart, Coordinates, Flat};
use crate::integrate::nystrom::Tableau;
use crate::integrate::rattle::{Composition, Reaction};
use crate::integrate::runge_kutta::{Field, InVectors, Pair, RungeKutta};
use crate::integrate::{
    Failure, Gauss, Rattle, RungeKutta5, RungeKutta8, RungeKuttaNystrom, Splitting, Taylor,
};
use crate::model::{Constraint, Group, Model, StateVector};
use crate::state::Phase;
use crate::system::Packing;

/// Follows the motion of `model` by the best method there is, or one that the automatic choice has.
pub(super) fn automatic<const N: usize, M: Model<N>>(
    model: &M,
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    integrate::<N, M, false>(model, course, recorder)
}

/// Follows the motion of `model` by the method that was asked for.
pub(super) fn named<const N: usize, M: Model<N>>(
    model: &M,
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    integrate::<N, M, true>(model, course, recorder)
}

/// Follows the motion of `model`. What depends on the model alone, and on whether the program names methods, is decided by
/// constants: only the integrators that can be taken are compiled.
fn integrate<const N: usize, M: Model<N>, const NAMED: bool>(
    model: &M,
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    let method = chosen(model, course, recorder);
    recorder.trajectory.computation.method = method;
    recorder.needs_determinant = const { carries_dilatation(&M::DESCRIPTION) } && forms_determinant(method);
    if recorder.needs_determinant {
        in_range(course.t0, model.orthonormal(course.start).phi())?;
    }
    match method {
        Method::Rattle { order, step } if const { NAMED } => {
            by_rattle(model, (order, step), course, recorder)
        }
        Method::Taylor { order } => by_series(model, order, course, recorder),
        Method::Splitting { order, step } if const { NAMED } => {
            by_pieces(model, (order, step), course, recorder)
        }
        Method::AdaptiveSplitting { order } => {
            by_adaptive_pieces::<N, M, _, NAMED>(model, model.splitting(), order, course, recorder)
        }
        Method::RungeKuttaNystrom12 => by_halves(model, &Tableau::ORDER_12, course, recorder),
        Method::RungeKuttaNystrom8 => by_halves(model, &Tableau::ORDER_8, course, recorder),
        _ if const { !moves_on_group(&M::DESCRIPTION, N) } => {
            free::<N, M, _, NAMED>(model, model.packing(), method, course, recorder)
        }
        _ if const { is_canonical(&M::DESCRIPTION) } => {
            with_reaction::<N, M, NAMED>(model, method, course, recorder)
        }
        _ => {
            reduced::<N, M, _, NAMED>(model, chart::<N, M>(M::DESCRIPTION.reduced)?, method, course, recorder)
        }
    }
}

/// Forces are computed from the placement alone, nothing being carried along.
fn forms_determinant(method: Method) -> bool {
    matches!(
        method,
        Method::RungeKuttaNystrom12
            | Method::RungeKuttaNystrom8
            | Method::Splitting { .. }
            | Method::AdaptiveSplitting { .. }
    )
}

/// The integrator to take, noted with what was missing for a better one.
fn chosen<const N: usize, M: Model<N>>(
    model: &M,
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Method {
    // Within steps a Nystrom method costs a step for each time that is looked at.
    let in_reach = const { !carries_dilatation(&M::DESCRIPTION) }
        || in_range(course.t0, model.orthonormal(course.start).phi()).is_ok();
    let by_halves = !recorder.has_events() && in_reach;
    let Trial { radians: stiffness, evaluations } = match course.method {
        Method::Automatic if by_halves => stiffness(model, model.splitting(), course),
        _ => Trial::default(),
    };
    recorder.place.spend(evaluations);
    recorder.trajectory.computation.stiffness = stiffness;
    let method = match course.method {
        Method::Automatic if model.second_order().is_some() && by_halves => {
            return if course.tolerance > NYSTROM_TOLERANCE {
                Method::RungeKuttaNystrom8
            } else {
                Method::RungeKuttaNystrom12
            };
        }
        Method::Automatic if by_halves && stiffness.is_some() => {
            return Method::AdaptiveSplitting { order: None };
        }
        Method::Automatic
            if course.tolerance <= TAYLOR_TOLERANCE
                && M::DESCRIPTION.constraint.is_none()
                && model.taylor().is_some() =>
        {
            Method::Taylor { order: None }
        }
        Method::Automatic => Method::RungeKutta8,
        asked => return asked,
    };
    let has_series = M::DESCRIPTION.constraint.is_none() && course.tolerance <= TAYLOR_TOLERANCE;
    recorder.trajectory.computation.missing = if by_halves && M::DESCRIPTION.second_order {
        Some("nystrom")
    } else if has_series && method == Method::RungeKutta8 {
        Some("taylor")
    } else {
        None
    };
    method
}

/// The reduced state by its Taylor series.
fn by_series<const N: usize, M: Model<N>>(
    model: &M,
    order: Option<usize>,
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    let Course { t0, start, t_end, tolerance, .. } = *course;
    let (groups, layout) = (M::DESCRIPTION.reduced, const { Layout::of(M::DESCRIPTION.reduced, N) });
    let (reduced, constants) = model.reduce(t0, start);
    let expand = |t: f64, reduced: &M::Reduced<f64>| model.expand(t, &constants, reduced);
    emitted::<N, M, _>(model.taylor(), "taylor", |series| {
        let integration = Taylor::new((series, constants), groups, (t0, reduced), t_end, tolerance, order);
        follow(integration, (&expand, layout), recorder)
    })
}

/// The reduced state by the exact flows of pieces.
fn by_pieces<const N: usize, M: Model<N>>(
    model: &M,
    (order, step): (usize, f64),
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    let Course { t0, start, t_end, .. } = *course;
    let layout = const { Layout::of(M::DESCRIPTION.reduced, N) };
    let (reduced, constants) = model.reduce(t0, start);
    let expand = |t: f64, reduced: &M::Reduced<f64>| model.expand(t, &constants, reduced);
    emitted::<N, M, _>(model.splitting(), "splitting", |pieces| {
        let integration = Splitting::new((pieces, constants), order, (t0, reduced), t_end, step);
        follow(integration.ok_or(Setting::Order { given: order })?, (&expand, layout), recorder)
    })
}

/// The same in steps by their error. The automatic choice takes only pieces with a stiff motion of their own.
fn by_adaptive_pieces<const N: usize, M: Model<N>, R: PiecesOf<N, M>, const NAMED: bool>(
    model: &M,
    pieces: Option<R>,
    order: Option<usize>,
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    if const { !(NAMED || R::DILATES) } {
        return Err(Setting::NotEmitted { model: M::DESCRIPTION.name, key: "splitting" }.into());
    }
    let layout = const { Layout::of(M::DESCRIPTION.reduced, N) };
    let (reduced, constants) = model.reduce(course.t0, course.start);
    let expand = |t: f64, reduced: &M::Reduced<f64>| model.expand(t, &constants, reduced);
    emitted::<N, M, _>(pieces, "splitting", |pieces| {
        let integration = adaptive(model, pieces, order, (reduced, constants), course);
        let given = order.unwrap_or_default();
        follow(integration.ok_or(Setting::Order { given })?, (&expand, layout), recorder)
    })
}

/// The halves of the reduced state by Runge-Kutta-Nystrom steps.
fn by_halves<const N: usize, M: Model<N>>(
    model: &M,
    tableau: &'static Tableau,
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    let Course { t0, start, t_end, tolerance, .. } = *course;
    let (groups, layout) = (M::DESCRIPTION.reduced, const { Layout::of(M::DESCRIPTION.reduced, N) });
    let (reduced, constants) = model.reduce(t0, start);
    emitted::<N, M, _>(model.second_order(), "nystrom", |system| {
        // What follows from the positions is computed where it is asked for, not at every step.
        let expand = |t: f64, halves: &M::Reduced<f64>| model.expand(t, &constants, &model.renewed(halves));
        let begin = (t0, reduced);
        let integration =
            RungeKuttaNystrom::new((system, constants), tableau, groups, begin, t_end, tolerance);
        follow(integration, (&expand, layout), recorder)
    })
}

/// The reduced state of a body without constraints, in vectors of four where the model has its equations so; implicit
/// methods take single components.
fn free<const N: usize, M: Model<N>, R: Packing<M::Reduced<f64>, M::Constants<f64>>, const NAMED: bool>(
    model: &M,
    packing: Option<R>,
    method: Method,
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    if const { !is_emitted::<R>() } {
        return reduced::<N, M, _, NAMED>(model, Flat, method, course, recorder);
    }
    let Course { t0, start, t_end, tolerance, .. } = *course;
    let (groups, layout) = (M::DESCRIPTION.reduced, const { Layout::of(M::DESCRIPTION.reduced, N) });
    let (reduced, constants) = model.reduce(t0, start);
    let begin = (t0, reduced);
    let expand = |t: f64, reduced: &M::Reduced<f64>| model.expand(t, &constants, reduced);
    emitted::<N, M, _>(packing, "packing", |packing| match method {
        Method::Gauss { stages, step } if const { NAMED } => {
            let closed = |t: f64, reduced: &M::Reduced<f64>| {
                model.reduced_equations(t, &constants, &model.renewed(reduced))
            };
            let integration = gauss(Flat, closed, begin, (stages, t_end, step))?;
            follow(integration, (&expand, layout), recorder)
        }
        Method::RungeKutta5 if const { NAMED } => {
            let field = InVectors(packing, constants);
            let integration = RungeKutta5::in_vectors(field, groups, begin, t_end, tolerance);
            follow_with_dense_output(integration, (&expand, layout), recorder)
        }
        _ => {
            let field = InVectors(packing, constants);
            let integration = RungeKutta8::in_vectors(field, groups, begin, t_end, tolerance);
            follow_with_dense_output(integration, (&expand, layout), recorder)
        }
    })
}

/// What is done with a capability of a model that has it.
fn emitted<const N: usize, M: Model<N>, R>(
    capability: Option<R>,
    key: &'static str,
    act: impl FnOnce(R) -> Result<(), Reason>,
) -> Result<(), Reason> {
    if const { is_emitted::<R>() }
        && let Some(capability) = capability
    {
        return act(capability);
    }
    Err(Setting::NotEmitted { model: M::DESCRIPTION.name, key }.into())
}

/// The reduced state by a method for any equations.
fn reduced<const N: usize, M: Model<N>, C: Coordinates<M::Reduced<f64>>, const NAMED: bool>(
    model: &M,
    coordinates: C,
    method: Method,
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    let (reduced, constants) = model.reduce(course.t0, course.start);
    let equations = |t: f64, reduced: &M::Reduced<f64>| model.reduced_equations(t, &constants, reduced);
    // What is carried along would spoil the geometry of Gauss collocation: it is computed from the rest.
    let closed = |t: f64, reduced: &M::Reduced<f64>| equations(t, &model.renewed(reduced));
    let expand = |t: f64, reduced: &M::Reduced<f64>| model.expand(t, &constants, reduced);
    let state = (M::DESCRIPTION.reduced, const { Layout::of(M::DESCRIPTION.reduced, N) }, reduced);
    let equations = (equations, closed);
    by_equations::<N, _, _, _, _, _, NAMED>(
        coordinates,
        equations,
        state,
        &expand,
        (method, course),
        recorder,
    )
}

/// The phase point of a separable isochoric body on SL(n): its equations are the free ones, to which the multiplier is
/// added.
fn with_reaction<const N: usize, M: Model<N>, const NAMED: bool>(
    model: &M,
    method: Method,
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    let groups = M::DESCRIPTION.full;
    let free = |t: f64, full: &M::Full<f64>| model.free_equations(t, full);
    let start = model.flatten(course.start);
    let reaction = Reaction::<N>::of(groups, &free, (course.t0, &start));
    let reaction = reaction.map_err(|failure| recorder.reason(failure))?;
    recorder.place.spend(reaction.evaluations());
    let equations = |t: f64, full: &M::Full<f64>| reaction.rates(&free, t, full);
    let expand = |_: f64, full: &M::Full<f64>| model.unflatten(&reaction.with_momentum(full));
    let state = (groups, const { Layout::of(M::DESCRIPTION.full, N) }, reaction.with_velocity(&start));
    let chart = chart::<N, M>(groups)?;
    let equations = (equations, equations);
    by_equations::<N, _, _, _, _, _, NAMED>(chart, equations, state, &expand, (method, course), recorder)
}

/// A state by a method for any equations; the second ones are for implicit methods.
fn by_equations<const N: usize, S, P, C, F, G, const NAMED: bool>(
    coordinates: C,
    (equations, closed): (F, G),
    (groups, layout, state): (&'static [Group], Layout, S),
    expand: Expansion<'_, S, P>,
    (method, course): (Method, &Course<'_, P>),
    recorder: &mut Recorder<'_, '_, N, P>,
) -> Result<(), Reason>
where
    S: StateVector<f64>,
    P: Phase<N>,
    C: Coordinates<S>,
    F: Fn(f64, &S) -> S,
    G: Fn(f64, &S) -> S,
{
    let Course { t0, t_end, tolerance, .. } = *course;
    let begin = (t0, state);
    match method {
        Method::Gauss { stages, step } if const { NAMED } => {
            let integration = gauss(coordinates, closed, begin, (stages, t_end, step))?;
            follow(integration, (expand, layout), recorder)
        }
        Method::RungeKutta5 if const { NAMED } => {
            let integration = RungeKutta5::within(coordinates, equations, groups, begin, t_end, tolerance);
            follow_with_dense_output(integration, (expand, layout), recorder)
        }
        _ => {
            let integration = RungeKutta8::within(coordinates, equations, groups, begin, t_end, tolerance);
            follow_with_dense_output(integration, (expand, layout), recorder)
        }
    }
}

/// Gauss collocation by its number of stages, to an end, in steps of a length.
fn gauss<S: StateVector<f64>, C: Coordinates<S>, F: Fn(f64, &S) -> S>(
    coordinates: C,
    equations: F,
    begin: (f64, S),
    (stages, t_end, step): (usize, f64, f64),
) -> Result<Result<Gauss<S, F, C>, Failure>, Setting> {
    let tableau = Collocation::of_stages(stages).ok_or(Setting::Stages { given: stages })?;
    Ok(Gauss::within(coordinates, equations, tableau, begin, t_end, step))
}

/// RATTLE on the phase point itself.
fn by_rattle<const N: usize, M: Model<N>>(
    model: &M,
    (order, step): (usize, f64),
    course: &Course<'_, M::Point<f64>>,
    recorder: &mut Recorder<'_, '_, N, M::Point<f64>>,
) -> Result<(), Reason> {
    if const { !has_multiplier(&M::DESCRIPTION) } {
        return Err(Setting::NotSeparable { model: M::DESCRIPTION.name }.into());
    }
    let composition = Composition::of_order(order).ok_or(Setting::Order { given: order })?;
    let equations = |t: f64, full: &M::Full<f64>| model.free_equations(t, full);
    let expand = |_: f64, full: &M::Full<f64>| model.unflatten(full);
    let (groups, layout) = (M::DESCRIPTION.full, const { Layout::of(M::DESCRIPTION.full, N) });
    let begin = (course.t0, model.flatten(course.start));
    let integration = Rattle::<N, _, _>::new(equations, groups, composition, begin, course.t_end, step);
    follow(integration, (&expand, layout), recorder)
}

/// Follows an integration that has begun.
fn follow<const N: usize, S: StateVector<f64>, P: Phase<N>>(
    mut integration: Result<impl Stepper<S>, Failure>,
    (expand, layout): (Expansion<'_, S, P>, Layout),
    recorder: &mut Recorder<'_, '_, N, P>,
) -> Result<(), Reason> {
    // Where it is: an integration is some thousand bytes.
    match &mut integration {
        Ok(integration) => recorder.follow(&mut Expanded::new(integration, expand, layout)),
        Err(failure) => Err(recorder.reason(*failure)),
    }
}

/// Follows an explicit integration that has begun.
fn follow_with_dense_output<const N: usize, Q, S, F, C, L, P>(
    mut integration: Result<RungeKutta<Q, S, F, C, L>, Failure>,
    (expand, layout): (Expansion<'_, S, P>, Layout),
    recorder: &mut Recorder<'_, '_, N, P>,
) -> Result<(), Reason>
where
    Q: Pair,
    S: StateVector<f64>,
    F: Field<S, C, L>,
    C: Coordinates<S>,
    L: StateVector<f64>,
    P: Phase<N>,
{
    match &mut integration {
        Ok(integration) => {
            let mut dense = None;
            let mut explicit = Explicit::new(integration, &mut dense);
            recorder.follow(&mut Expanded::new(&mut explicit, expand, layout))
        }
        Err(failure) => Err(recorder.reason(*failure)),
    }
}

/// The chart of the group to which the motion is confined, for states that hold the placement.
fn chart<const N: usize, M: Model<N>>(groups: &[Group]) -> Result<Chart<N>, Setting> {
    let confined: Option<Constraint> = M::DESCRIPTION.constraint;
    let chart =
        confined.zip(placement_in(groups, N)).map(|(group, placement)| Chart::new(group, placement.start));
    chart.ok_or(Setting::NotSeparable { model: M::DESCRIPTION.name })
}
