//! The Radau method, over velocities where friction makes the motion stiff.

use super::course::Course;
use super::layout::Layout;
use super::motion::{At, Begun, Goal, Launched, Purpose, begun, launched};
use super::velocities::Variables;
use crate::error::{Reason, Setting};
use crate::integrate::Radau;
use crate::integrate::radau::Tableau;
use crate::model::Model;

/// The reduced state of a body that moves freely in GL(n).
pub(super) fn by_radau<'a, const N: usize, M, H>(
    at: At<'_, N, M, H>,
    stages: Option<usize>,
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    H: Purpose<'a, N, Model = M>,
{
    let (groups, layout) = (M::DESCRIPTION.reduced, const { Layout::of(M::DESCRIPTION.reduced, N) });
    launched(at, layout, goal, move |model: &H, course| {
        let Course { t0, t_end, tolerance, .. } = *course;
        let tableau = tableau(stages, tolerance)?;
        let (state, variables, evaluations) = Variables::at(model, (t0, course.start));
        let (of_rates, of_points) = (variables.clone(), variables.clone());
        let rates = move |t: f64, z: &M::Reduced<f64>| of_rates.rates(t, z);
        let expand = move |t: f64, z: &M::Reduced<f64>| of_points.point(t, z);
        let radau = Radau::new((rates, variables), tableau, groups, (t0, state), t_end, tolerance);
        Ok(Begun { evaluations, ..begun::<N, M, _, _>(course, radau, expand)? })
    })
}

/// The method of so many stages, or that for a tolerance.
pub(super) fn tableau(stages: Option<usize>, tolerance: f64) -> Result<&'static Tableau, Setting> {
    match stages {
        Some(given) => Tableau::of_stages(given).ok_or(Setting::RadauStages { given }),
        None => Ok(Tableau::for_tolerance(tolerance)),
    }
}
