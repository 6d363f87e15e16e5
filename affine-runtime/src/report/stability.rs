//! Stiff and extreme cases: what was promised of each, and what came out.

mod picture;
mod table;

use crate::error::Error;

/// What a result is held against. None of them is the method under test at another tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Oracle {
    /// A formula for the motion.
    ClosedForm,
    /// A reference solution of more digits than a double has.
    Reference,
    /// A run at the tolerance 1e-14, by another method than the one under test.
    TighterRun,
    /// Two motions that are one by an exact symmetry of the equations, or a constant of the motion.
    Invariance,
    /// The body under the constraint that a stiff potential tends to; the distance between the two is of the order of the
    /// compliance and part of the demand.
    Limit,
    /// The text of the interface: what is refused, and how.
    Documentation,
}

impl Oracle {
    /// In a word or two.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Reference => "reference",
            Self::TighterRun => "tighter run",
            Self::Invariance => "invariance",
            Self::Limit => "limit",
            Self::Documentation => "documented",
        }
    }
}

/// What is demanded of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Demand {
    /// It runs, with an error of at most so much; to refuse it is to fall short.
    Held(f64),
    /// It is refused, in words that contain these.
    Refused(&'static str),
    /// It runs with an error of at most so much, or is refused in words: beyond what is promised, but nothing is
    /// silently wrong.
    HeldOrRefused(f64),
}

/// How a case ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// The case ran to its end.
    Ran {
        /// Error against the oracle.
        error: f64,
        /// Steps taken; 0 for a closed form.
        steps: u64,
    },
    /// It was refused or stopped, with these words.
    Stopped(String),
}

/// Finding against demand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// As accurate as demanded.
    Held,
    /// Refused, as demanded or allowed.
    Refused,
    /// Neither as accurate as demanded, nor refused where that is allowed.
    FellShort,
}

impl Verdict {
    /// In a word or two.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Held => "held",
            Self::Refused => "refused",
            Self::FellShort => "fell short",
        }
    }
}

/// One row: what was tried, what was demanded, what came out.
#[derive(Clone, Debug, PartialEq)]
pub struct StabilityCase {
    /// Under which heading it stands.
    pub heading: &'static str,
    /// The model: frames and special terms of its energy.
    pub model: &'static str,
    /// Dimension.
    pub n: usize,
    /// The extreme, with its number.
    pub scene: String,
    /// What the error is an error of.
    pub quantity: &'static str,
    /// What it is held against.
    pub oracle: Oracle,
    /// What is demanded.
    pub demand: Demand,
    /// How the case ended.
    pub finding: Finding,
}

impl StabilityCase {
    /// Finding against demand; an error that is not a number is never held.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match (self.demand, &self.finding) {
            (Demand::Held(most) | Demand::HeldOrRefused(most), Finding::Ran { error, .. })
                if *error <= most =>
            {
                Verdict::Held
            }
            (Demand::Refused(words), Finding::Stopped(text)) if text.contains(words) => Verdict::Refused,
            (Demand::HeldOrRefused(_), Finding::Stopped(_)) => Verdict::Refused,
            _ => Verdict::FellShort,
        }
    }
}

/// Cases in the order in which they were tried; displays as a table.
///
/// ```
/// use affine_runtime::report::{Demand, Oracle, Scene, StabilityReport};
///
/// let mut report = StabilityReport::new();
/// report.heading("long roads");
/// let scene = Scene { model: "straight line", n: 2, scene: "t = 1e9".into(), quantity: "phi", oracle: Oracle::ClosedForm };
/// report.case(scene, Demand::Held(1e-12), || Ok((3e-16, 0)));
/// assert_eq!(report.fell_short().count(), 0);
/// assert!(report.to_string().contains("held"));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StabilityReport {
    heading: &'static str,
    cases: Vec<StabilityCase>,
}

/// What a case is about.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The model: frames and special terms of its energy.
    pub model: &'static str,
    /// Dimension.
    pub n: usize,
    /// The extreme, with its number.
    pub scene: String,
    /// What the error is an error of.
    pub quantity: &'static str,
    /// What it is held against.
    pub oracle: Oracle,
}

impl StabilityReport {
    /// Without cases.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The heading of the cases to follow.
    pub fn heading(&mut self, heading: &'static str) {
        self.heading = heading;
    }

    /// Tries a case: the error and the number of steps, or what stopped it.
    pub fn case(
        &mut self,
        scene: Scene,
        demand: Demand,
        attempt: impl FnOnce() -> Result<(f64, u64), Error>,
    ) -> &StabilityCase {
        let finding = match attempt() {
            Ok((error, steps)) => Finding::Ran { error, steps },
            Err(error) => Finding::Stopped(error.to_string()),
        };
        let index = self.cases.len();
        self.add(scene, demand, finding);
        &self.cases[index]
    }

    /// A case that was tried elsewhere.
    pub(super) fn add(&mut self, scene: Scene, demand: Demand, finding: Finding) {
        let Scene { model, n, scene, quantity, oracle } = scene;
        let heading = self.heading;
        self.cases.push(StabilityCase { heading, model, n, scene, quantity, oracle, demand, finding });
    }

    /// All cases.
    #[must_use]
    pub fn cases(&self) -> &[StabilityCase] {
        &self.cases
    }

    /// The cases that are neither as accurate as demanded nor refused as allowed.
    pub fn fell_short(&self) -> impl Iterator<Item = &StabilityCase> {
        self.cases.iter().filter(|case| case.verdict() == Verdict::FellShort)
    }
}
