//! Families of relative equilibria that a parameter runs through.

use core::fmt;
use core::fmt::Write;

use super::error::AnalysisError;
use super::linear::Column;
use super::relative::RelativeEquilibrium;
use super::stability::{Stability, StabilityVerdict};
use crate::state::Phase;

/// What is special about a point of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Special {
    /// The parameter turns back.
    Fold,
    /// A direction has no stiffness in the frame that moves, or with friction an eigenvalue is zero: another branch begins.
    Bifurcation,
    /// Two frequencies meet and leave as growth: a Hamiltonian Hopf bifurcation, also of forces that do no work.
    Collision,
    /// With friction: an oscillation that fell begins to grow, or the other way round.
    Hopf,
}

/// A point of a branch.
#[derive(Clone, Debug)]
pub struct BranchPoint<const N: usize, P> {
    /// The parameter.
    pub parameter: f64,
    /// The relative equilibrium.
    pub turn: RelativeEquilibrium<N, P>,
    /// Its stability.
    pub stability: Stability<N>,
    pub(super) stretches: Vec<f64>,
    pub(super) unknowns: Column,
    pub(super) tangent: Column,
}

/// A branch: points in order, and what is special between them.
#[derive(Clone, Debug)]
pub struct Branch<const N: usize, P> {
    /// The points, from the start.
    pub points: Vec<BranchPoint<N, P>>,
    /// Special points, each located to rounding, in the same order.
    pub special: Vec<(Special, BranchPoint<N, P>)>,
    /// Why there is no point after the last one, where the branch has not left the range: what the family says of the parameter
    /// there, or that steps have become too short. `None` also after 2000 points.
    pub ended: Option<AnalysisError>,
}

impl<const N: usize, P: Phase<N>> BranchPoint<N, P> {
    /// The stretches of the placement, from the largest; lengths are those of the metrics.
    #[must_use]
    pub fn stretches(&self) -> Vec<f64> {
        self.stretches.clone()
    }

    fn fields(&self) -> Vec<String> {
        let verdict = match self.stability.verdict {
            StabilityVerdict::Unstable { .. } => "unstable".to_owned(),
            StabilityVerdict::Undecided(doubt) => format!("undecided: {doubt:?}"),
            StabilityVerdict::Stable => "stable".to_owned(),
            StabilityVerdict::LinearlyStable => "linearly stable".to_owned(),
        };
        let rate = self.stability.eigenvalues.iter().map(|one| one.value.re).fold(0.0, f64::max);
        let numbers = [self.parameter].into_iter().chain(self.turn.velocities.iter().copied());
        let numbers = numbers.chain(self.stretches()).chain([rate, self.turn.residual]);
        numbers.map(|number| format!("{number:?}")).chain([verdict]).collect()
    }
}

impl<const N: usize, P: Phase<N>> Branch<N, P> {
    /// The points as comma-separated values.
    #[must_use]
    pub fn to_csv(&self) -> String {
        let velocities = self.points.first().map_or(0, |point| point.turn.velocities.len());
        let numbered =
            |name: &str, count: usize| (1..=count).map(|k| format!(",{name}_{k}")).collect::<String>();
        let mut text = format!(
            "parameter{}{},rate,residual,stability\n",
            numbered("velocity", velocities),
            numbered("Q", N)
        );
        self.points.iter().for_each(|point| text += &(point.fields().join(",") + "\n"));
        text
    }
}

/// The special points, one a line, and why the branch has ended within the range.
impl<const N: usize, P: Phase<N>> fmt::Display for Branch<N, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut lines = String::new();
        for (kind, point) in &self.special {
            write!(lines, "\n{kind:?} at {:.12}, stretches {:.9?}", point.parameter, point.stretches())?;
        }
        if let Some(reason) = &self.ended {
            write!(lines, "\nended: {reason}")?;
        }
        write!(f, "{} points{lines}", self.points.len())
    }
}
