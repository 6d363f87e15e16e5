//! Methods for any equations of motion: explicit Runge-Kutta steps and Gauss collocation.

use super::by_radau::tableau;
use super::course::Course;
use super::layout::{Layout, has_work, placement_in};
use super::method::Method;
use super::motion::{At, Boxed, Purpose, begun, boxed, expansion};
use crate::error::{Reason, Setting};
use crate::integrate::gauss::Tableau;
use crate::integrate::lie::{Chart, Coordinates};
use crate::integrate::radau::Differences;
use crate::integrate::{Gauss, Radau, RungeKutta5, RungeKutta8};
use crate::model::{Constraint, Group, Model};

/// The reduced state by a method for any equations.
pub(super) fn reduced<'a, const N: usize, M, C, H, const NAMED: bool>(
    at: At<'_, N, M, H>,
    coordinates: C,
    method: Method,
    spent: &mut u64,
) -> Result<Boxed<'a, N, H>, Reason>
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
        // What is carried along would spoil the geometry of Gauss collocation: it is computed from the rest.
        let (of_rest, of_model) = (equations.clone(), model.clone());
        let closed = move |t: f64, reduced: &M::Reduced<f64>| of_rest(t, &of_model.model().renewed(reduced));
        ((course.t0, state), equations, closed, expansion(model, constants))
    };
    match method {
        Method::Gauss { stages, step } if const { NAMED } => {
            let tableau = Tableau::of_stages(stages).ok_or(Setting::Stages { given: stages })?;
            boxed(at, layout, spent, move |model, course| {
                let (begin, _, closed, expand) = begun_at(model, course);
                let gauss = Gauss::within(coordinates, closed, tableau, begin, course.t_end, step);
                begun::<N, M, _, _>(course, gauss, expand)
            })
        }
        Method::Radau { stages } if const { NAMED || has_work(&M::DESCRIPTION) } => {
            boxed(at, layout, spent, move |model, course| {
                let (begin, _, closed, expand) = begun_at(model, course);
                let Course { t_end, tolerance, .. } = *course;
                let tableau = tableau(stages, tolerance)?;
                let equations = (closed, Differences);
                let radau = Radau::within(coordinates, equations, tableau, groups, begin, t_end, tolerance);
                begun::<N, M, _, _>(course, radau, expand)
            })
        }
        Method::RungeKutta5 if const { NAMED } => boxed(at, layout, spent, move |model, course| {
            let (begin, equations, _, expand) = begun_at(model, course);
            let Course { t_end, tolerance, .. } = *course;
            let steps = RungeKutta5::within(coordinates, equations, groups, begin, t_end, tolerance);
            begun::<N, M, _, _>(course, steps, expand)
        }),
        _ => boxed(at, layout, spent, move |model, course| {
            let (begin, equations, _, expand) = begun_at(model, course);
            let Course { t_end, tolerance, .. } = *course;
            let steps = RungeKutta8::within(coordinates, equations, groups, begin, t_end, tolerance);
            begun::<N, M, _, _>(course, steps, expand)
        }),
    }
}

/// The chart of the group to which the motion is confined, for states that hold the placement.
pub(super) fn chart<const N: usize, M: Model<N>>(groups: &[Group]) -> Result<Chart<N>, Setting> {
    let confined: Option<Constraint> = M::DESCRIPTION.constraint;
    let chart =
        confined.zip(placement_in(groups, N)).map(|(group, placement)| Chart::new(group, placement.start));
    chart.ok_or(Setting::NotSeparable { model: M::DESCRIPTION.name })
}
