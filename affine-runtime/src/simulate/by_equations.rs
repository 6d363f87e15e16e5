//! Methods for any equations of motion: explicit Runge-Kutta steps and Gauss collocation.

use super::by_radau::tableau;
use super::course::Course;
use super::layout::{Layout, has_work, moves_on_group, placement_in};
use super::method::Method;
use super::motion::{At, Goal, Launched, Purpose, begun, expansion, launched};
use crate::error::{Reason, Setting};
use crate::integrate::gauss::Tableau;
use crate::integrate::lie::{Chart, Coordinates};
use crate::integrate::radau::Differences;
use crate::integrate::{Gauss, Radau, RungeKutta5, RungeKutta8};
use crate::model::{Constraint, Group, Handle, Model};

/// The reduced state by a method for any equations. Bodies without constraints by [`Method::Radau`] step their velocities.
pub(super) fn reduced<'a, const N: usize, M, C, H, const NAMED: bool>(
    at: At<'_, N, M, H>,
    coordinates: C,
    method: Method,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    C: Coordinates<M::Reduced<f64>> + 'a,
    H: Purpose<'a, N, Model = M>,
{
    let (groups, layout) = (M::DESCRIPTION.reduced, const { Layout::of(M::DESCRIPTION.reduced, N) });
    let begun_at = |model: &H, course: &Course<'_, M::Point<f64>>| {
        let (state, constants) = model.model().reduce(course.t0, course.start);
        let of_model = model.clone();
        let equations = move |t: f64, reduced: &M::Reduced<f64>| {
            of_model.model().reduced_equations(t, &constants, reduced)
        };
        ((course.t0, state), equations, expansion(model, constants))
    };
    match method {
        Method::Gauss { stages, step } if const { NAMED } => by_gauss(at, coordinates, (stages, step), goal),
        Method::Radau { stages }
            if const { moves_on_group(&M::DESCRIPTION, N) && (NAMED || has_work(&M::DESCRIPTION)) } =>
        {
            launched(at, layout, goal, move |model, course| {
                let (state, constants) = model.model().reduce(course.t0, course.start);
                let Course { t0, t_end, tolerance, .. } = *course;
                let tableau = tableau(stages, tolerance)?;
                let equations = (closed(model, constants), Differences);
                let begin = (t0, state);
                let radau = Radau::within(coordinates, equations, tableau, groups, begin, t_end, tolerance);
                begun::<N, M, _, _>(course, radau, expansion(model, constants))
            })
        }
        Method::RungeKutta5 if const { NAMED } => launched(at, layout, goal, move |model, course| {
            let (begin, equations, expand) = begun_at(model, course);
            let Course { t_end, tolerance, .. } = *course;
            let steps = RungeKutta5::within(coordinates, equations, groups, begin, t_end, tolerance);
            begun::<N, M, _, _>(course, steps, expand)
        }),
        _ => launched(at, layout, goal, move |model, course| {
            let (begin, equations, expand) = begun_at(model, course);
            let Course { t_end, tolerance, .. } = *course;
            let steps = RungeKutta8::within(coordinates, equations, groups, begin, t_end, tolerance);
            begun::<N, M, _, _>(course, steps, expand)
        }),
    }
}

/// The reduced state by Gauss collocation.
pub(super) fn by_gauss<'a, const N: usize, M, C, H>(
    at: At<'_, N, M, H>,
    coordinates: C,
    (stages, step): (usize, f64),
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    C: Coordinates<M::Reduced<f64>> + 'a,
    H: Purpose<'a, N, Model = M>,
{
    let tableau = Tableau::of_stages(stages).ok_or(Setting::Stages { given: stages })?;
    let layout = const { Layout::of(M::DESCRIPTION.reduced, N) };
    launched(at, layout, goal, move |model, course| {
        let (state, constants) = model.model().reduce(course.t0, course.start);
        let equations = closed(model, constants);
        let gauss = Gauss::within(coordinates, equations, tableau, (course.t0, state), course.t_end, step);
        begun::<N, M, _, _>(course, gauss, expansion(model, constants))
    })
}

/// The equations of a state of which what is carried along is computed from the rest: it would spoil the geometry of collocation.
fn closed<const N: usize, M: Model<N>, H: Handle<N, Model = M>>(
    model: &H,
    constants: M::Constants<f64>,
) -> impl Fn(f64, &M::Reduced<f64>) -> M::Reduced<f64> + use<N, M, H> {
    let model = model.clone();
    move |t, reduced| {
        let model = model.model();
        model.reduced_equations(t, &constants, &model.renewed(reduced))
    }
}

/// The chart of the group to which the motion is confined, for states that hold the placement.
pub(super) fn chart<const N: usize, M: Model<N>>(groups: &[Group]) -> Result<Chart<N>, Setting> {
    let confined: Option<Constraint> = M::DESCRIPTION.constraint;
    let chart =
        confined.zip(placement_in(groups, N)).map(|(group, placement)| Chart::new(group, placement.start));
    chart.ok_or(Setting::NotSeparable { model: M::DESCRIPTION.name })
}
