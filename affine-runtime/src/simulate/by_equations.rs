//! Methods for any equations of motion: explicit Runge-Kutta steps and Gauss collocation.

use super::by_radau::tableau;
use super::course::Course;
use super::layout::{Layout, has_work, placement_in};
use super::method::Method;
use super::motion::{At, Begun, Boxed, Purpose, begun, boxed, expansion};
use super::stepper::Explicit;
use crate::error::{Reason, Setting};
use crate::inner::Reaction;
use crate::integrate::gauss::Tableau;
use crate::integrate::lie::{Chart, Coordinates};
use crate::integrate::radau::Differences;
use crate::integrate::{Gauss, Radau, RungeKutta5, RungeKutta8};
use crate::model::{Constraint, Group, Model, StateVector};

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
    let layout = const { Layout::of(M::DESCRIPTION.reduced, N) };
    let system = move |model: &H, course: &Course<'_, M::Point<f64>>| {
        let (state, constants) = model.model().reduce(course.t0, course.start);
        let of_model = model.clone();
        let equations = move |t: f64, reduced: &M::Reduced<f64>| {
            of_model.model().reduced_equations(t, &constants, reduced)
        };
        // What is carried along would spoil the geometry of Gauss collocation: it is computed from the rest.
        let (of_rest, of_model) = (equations.clone(), model.clone());
        let closed = move |t: f64, reduced: &M::Reduced<f64>| of_rest(t, &of_model.model().renewed(reduced));
        let expand = expansion(model, constants);
        Ok(Equations { state, equations, closed, expand, evaluations: 0 })
    };
    by_equations::<N, M, _, _, _, _, _, _, NAMED>(
        at,
        coordinates,
        (M::DESCRIPTION.reduced, layout),
        system,
        method,
        spent,
    )
}

/// The phase point of a separable isochoric body on SL(n): its equations are the free ones, to which the multiplier is
/// added.
pub(super) fn with_reaction<'a, const N: usize, M, H, const NAMED: bool>(
    at: At<'_, N, M, H>,
    method: Method,
    spent: &mut u64,
) -> Result<Boxed<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    H: Purpose<'a, N, Model = M>,
{
    let groups = M::DESCRIPTION.full;
    let layout = const { Layout::of(M::DESCRIPTION.full, N) };
    let system = move |model: &H, course: &Course<'_, M::Point<f64>>| {
        let of_model = model.clone();
        let free = move |t: f64, full: &M::Full<f64>| of_model.model().free_equations(t, full);
        let start = model.model().flatten(course.start);
        let reaction = Reaction::<N>::of(groups, &free, (course.t0, &start));
        let reaction = reaction.map_err(|failure| course.reason(failure, M::DESCRIPTION.name))?;
        let (state, evaluations) = (reaction.with_velocity(&start), reaction.evaluations());
        let (of_points, of_model) = (reaction.clone(), model.clone());
        let expand =
            move |_: f64, full: &M::Full<f64>| of_model.model().unflatten(&of_points.with_momentum(full));
        let equations = move |t: f64, full: &M::Full<f64>| reaction.rates(&free, t, full);
        Ok(Equations { state, closed: equations.clone(), equations, expand, evaluations })
    };
    let chart = chart::<N, M>(groups)?;
    by_equations::<N, M, _, _, _, _, _, _, NAMED>(at, chart, (groups, layout), system, method, spent)
}

/// A state with its equations of motion.
struct Equations<S, F, G, E> {
    state: S,
    equations: F,
    /// Those for implicit methods.
    closed: G,
    expand: E,
    /// Evaluations that it took to set them up.
    evaluations: u64,
}

/// A state by a method for any equations.
fn by_equations<'a, const N: usize, M, S, C, F, G, E, H, const NAMED: bool>(
    at: At<'_, N, M, H>,
    coordinates: C,
    (groups, layout): (&'static [Group], Layout),
    system: impl Fn(&H, &Course<'_, M::Point<f64>>) -> Result<Equations<S, F, G, E>, Reason> + Copy + 'a,
    method: Method,
    spent: &mut u64,
) -> Result<Boxed<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    S: StateVector<f64> + 'a,
    C: Coordinates<S> + 'a,
    F: Fn(f64, &S) -> S + 'a,
    G: Fn(f64, &S) -> S + 'a,
    E: Fn(f64, &S) -> M::Point<f64> + 'a,
    H: Purpose<'a, N, Model = M>,
{
    match method {
        Method::Gauss { stages, step } if const { NAMED } => {
            let tableau = Tableau::of_stages(stages).ok_or(Setting::Stages { given: stages })?;
            boxed(at, layout, spent, move |model, course| {
                let Equations { state, closed, expand, evaluations, .. } = system(model, course)?;
                let begin = (course.t0, state);
                let gauss = Gauss::within(coordinates, closed, tableau, begin, course.t_end, step);
                Ok(Begun { evaluations, ..begun::<N, M, _, _>(course, gauss, expand)? })
            })
        }
        Method::Radau { stages } if const { NAMED || has_work(&M::DESCRIPTION) } => {
            boxed(at, layout, spent, move |model, course| {
                let Equations { state, closed, expand, evaluations, .. } = system(model, course)?;
                let Course { t0, t_end, tolerance, .. } = *course;
                let tableau = tableau(stages, tolerance)?;
                let (equations, start) = ((closed, Differences), (t0, state));
                let radau = Radau::within(coordinates, equations, tableau, groups, start, t_end, tolerance);
                Ok(Begun { evaluations, ..begun::<N, M, _, _>(course, radau, expand)? })
            })
        }
        Method::RungeKutta5 if const { NAMED } => boxed(at, layout, spent, move |model, course| {
            let Equations { state, equations, expand, evaluations, .. } = system(model, course)?;
            let Course { t0, t_end, tolerance, .. } = *course;
            let steps = RungeKutta5::within(coordinates, equations, groups, (t0, state), t_end, tolerance);
            Ok(Begun { evaluations, ..begun::<N, M, _, _>(course, steps.map(Explicit::new), expand)? })
        }),
        _ => boxed(at, layout, spent, move |model, course| {
            let Equations { state, equations, expand, evaluations, .. } = system(model, course)?;
            let Course { t0, t_end, tolerance, .. } = *course;
            let steps = RungeKutta8::within(coordinates, equations, groups, (t0, state), t_end, tolerance);
            Ok(Begun { evaluations, ..begun::<N, M, _, _>(course, steps.map(Explicit::new), expand)? })
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
