//! The mistakes, idea by idea.

use std::fmt;

use super::capability::CapabilityMistake;
use super::constraint::ConstraintMistake;
use super::expression::ExpressionMistake;
use super::fault::FaultMistake;
use super::force::ForceMistake;
use super::form::FormMistake;
use super::message::Text;
use super::metric::MetricMistake;
use super::notation::NotationMistake;
use super::potential::PotentialMistake;
use super::term::TermMistake;
use super::together::TogetherMistake;

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.text().write(self.name(), f)
    }
}

/// Hands on what every idea has; a new one is a row here and a file beside this one.
macro_rules! ideas {
    ($(#[doc = $doc:literal] $idea:ident($mistake:ident),)*) => {
        /// A mistake in a model, as the user should hear of it; `Display` is the full message.
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub enum Diagnostic {
            $(#[doc = $doc] $idea($mistake),)*
        }

        impl Diagnostic {
            /// The stable short name of the mistake, which also ends the first line of its message.
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$idea(mistake) => mistake.name(),)*
                }
            }

            /// The names of all mistakes, idea by idea.
            pub fn names() -> impl Iterator<Item = &'static str> {
                [$($mistake::NAMES),*].into_iter().flatten().copied()
            }

            fn text(&self) -> Text {
                match self {
                    $(Self::$idea(mistake) => mistake.text(),)*
                }
            }
        }

        $(impl From<$mistake> for Diagnostic {
            fn from(mistake: $mistake) -> Self {
                Self::$idea(mistake)
            }
        })*
    };
}

ideas! {
    /// A mistake of notation.
    Notation(NotationMistake),
    /// A capability that the model does not have.
    Capability(CapabilityMistake),
    /// A mistake in an expression.
    Expression(ExpressionMistake),
    /// A mistake in a potential.
    Potential(PotentialMistake),
    /// A mistake in a term of the energy.
    Term(TermMistake),
    /// A mistake in a metric, or beside one.
    Metric(MetricMistake),
    /// What does not go with a constraint.
    Constraint(ConstraintMistake),
    /// A defect of the kinetic energy as a whole.
    Form(FormMistake),
    /// A mistake in a force or in the dissipation.
    Force(ForceMistake),
    /// Parts that exclude each other.
    Together(TogetherMistake),
    /// A mistake of the macro.
    Fault(FaultMistake),
}
