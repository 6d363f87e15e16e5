//! Quadratic forms that are degenerate, not definite, or less symmetric than claimed.

use std::fmt;

use super::message::{Text, equated, text};
use super::names::names;

/// A defect of the kinetic energy as a whole.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FormMistake {
    /// Two terms whose sum has a mass matrix that depends on the placement.
    MixedFrames {
        /// One term.
        first: &'static str,
        /// The velocity in which it has constant coefficients.
        first_velocity: &'static str,
        /// The other term.
        second: &'static str,
        /// The velocity in which that one has constant coefficients.
        second_velocity: &'static str,
    },
    /// Only translation terms, or none.
    NoKineticEnergy,
    /// The isotropic form vanishes on some directions.
    Degenerate {
        /// The eigenvalue: `I + A + n B`.
        eigenvalue: String,
        /// The same in the user's numbers: `1 + 2 + 3*(-1)`.
        numbers: String,
        /// The directions.
        directions: Directions,
    },
    /// A stated Hamiltonian whose velocity vanishes on some momenta.
    DegenerateHamiltonian {
        /// The eigenvalue: `2 vorticity_squared - casimir2`.
        eigenvalue: String,
        /// The same in the user's numbers: `2*0.1 - 0.2`; `None` where there is none to write.
        numbers: Option<String>,
        /// The momenta.
        directions: Directions,
    },
    /// A tensor, or a sum of terms with one, that has a kernel.
    DegenerateTensor {
        /// The terms: `body_tensor`, `body_tensor + casimir2`.
        terms: String,
        /// The velocity in which the form is constant: `Oh`, `Om`, `phi_dot`.
        velocity: &'static str,
        /// A velocity on which it vanishes.
        kernel: String,
    },
    /// A sum of terms of different frames that is degenerate at every placement.
    DegenerateSum {
        /// The terms, joined by `+`.
        terms: String,
    },
    /// `require(positive_definite)` fails.
    NotPositiveDefinite {
        /// What shows it, in the user's numbers: `I - A = 1 - 2 is negative`.
        defect: String,
    },
    /// A claimed symmetry that a term does not have.
    ClaimBroken {
        /// `space` or `body`.
        side: &'static str,
        /// How the group acts: `in space, phi -> L phi`.
        action: &'static str,
        /// The claim: `affine` or `metric`.
        claim: &'static str,
        /// A claim of less that is not none.
        less: Option<&'static str>,
        /// The group: `GL(3)`, `O(2)`.
        group: String,
        /// The term that breaks it.
        term: &'static str,
        /// The transformation under which it changes: `the generator E[1,2]`, `the reflection diag(-1, 1)`.
        transformation: String,
    },
    /// An affine claim on both sides beside a translation term.
    AffineTranslation {
        /// The translation term.
        term: &'static str,
    },
}

names! { FormMistake
    MixedFrames => "mixed-frames",
    NoKineticEnergy => "no-kinetic-energy",
    Degenerate => "degenerate",
    DegenerateHamiltonian => "degenerate-hamiltonian",
    DegenerateTensor => "degenerate-tensor",
    DegenerateSum => "degenerate-sum",
    NotPositiveDefinite => "not-positive-definite",
    ClaimBroken => "claim-broken",
    AffineTranslation => "affine-translation",
}

impl FormMistake {
    pub(super) fn text(&self) -> Text {
        match self {
            Self::MixedFrames { first, first_velocity, second, second_velocity } => text(
                format!("`{first}` and `{second}` do not go together in this version"),
                format!(
                    "`{first}` is a constant form in {first_velocity}, `{second}` in {second_velocity}: \
                     their sum has a mass matrix that depends on phi"
                ),
                format!("keep `{first}` or `{second}`"),
            ),
            Self::NoKineticEnergy => text(
                "there is no kinetic energy of the internal motion",
                "without a term in phi_dot the Legendre transformation has no inverse: Sigma = (dT/dOm)^T = 0",
                "add `casimir2`, `body_inertia`, `space_inertia`, `dalembert`, `body_tensor`, `space_tensor` or `flat_tensor`",
            ),
            Self::Degenerate { eigenvalue, numbers, directions } => text(
                format!(
                    "the kinetic energy is degenerate: {} = 0 on {directions}",
                    equated(eigenvalue, numbers)
                ),
                format!(
                    "the Legendre transformation X = I O^T + A O + B tr(O) 1 (4.18), (4.20) has the eigenvalue \
                     {eigenvalue} there; the momentum does not determine the velocity"
                ),
                format!(
                    "change a coefficient so that {eigenvalue} is not zero; I is the sum of the inertias, \
                     A is `casimir2`, B is `casimir1_squared`"
                ),
            ),
            Self::DegenerateHamiltonian { eigenvalue, numbers, directions } => {
                let equated = numbers.as_ref().map(|numbers| equated(eigenvalue, numbers));
                let value = equated.unwrap_or_else(|| eigenvalue.clone());
                let directions = directions.of("momenta");
                text(
                    format!("the Hamiltonian is degenerate: {value} = 0 on {directions}"),
                    format!(
                        "the velocity O = a X + b tr(X) 1 - c (X - X^T) has the eigenvalue {eigenvalue} there; it does \
                         not determine the momentum X"
                    ),
                    format!(
                        "change a coefficient so that {eigenvalue} is not zero; a is `casimir2`, b `casimir1_squared`, \
                         c `vorticity_squared` or `spin_squared`"
                    ),
                )
            }
            Self::DegenerateTensor { terms, velocity, kernel } => text(
                format!("the kinetic energy is degenerate: `{terms}` vanishes on {velocity} = {kernel}"),
                "the Legendre transformation X[B,A] = K[(A,B),(C,D)] O[C,D] (4.6), (4.8) gives zero momentum \
                 there; the momentum does not determine the velocity",
                "change a coefficient, or add a term that is not zero on this velocity",
            ),
            Self::DegenerateSum { terms } => text(
                format!("the kinetic energy `{terms}` is degenerate at every placement"),
                "its terms have constant coefficients in different velocities, so that the mass matrix over phi_dot \
                 depends on phi; its determinant is zero for all phi, and the momentum Pi = (dT/dphi_dot)^T does not \
                 determine the velocity",
                "add a term that is not zero on any velocity, such as `dalembert` or `body_inertia`",
            ),
            Self::NotPositiveDefinite { defect } => text(
                format!("the kinetic energy is not positive definite: {defect}"),
                "`require(positive_definite)` asks for T > 0 at every velocity that is not zero; an isotropic form has it iff \
                 I > |A| and I + A + n B > 0",
                "change the coefficients, or remove the requirement: indefinite energies are legitimate",
            ),
            Self::ClaimBroken { side, action, claim, less, group, term, transformation } => text(
                format!("`{term}` breaks the claim `{side} = {claim}`"),
                format!(
                    "the claim is that T is invariant under {group} acting {action}, and T of `{term}` changes under \
                     {transformation}",
                ),
                format!(
                    "claim less, {}, or replace the term",
                    match less {
                        Some(less) => format!("`{side} = {less}` or `{side} = none`"),
                        None => format!("`{side} = none`"),
                    },
                ),
            ),
            Self::AffineTranslation { term } => text(
                format!("`{term}` cannot be affine in space and in the body at once"),
                "every form on the affine group that is invariant on both sides is degenerate (section 4, \
                 after (4.5)): a translational energy needs a metric on one side",
                format!("claim `metric` on one side, or remove `{term}`"),
            ),
        }
    }
}

/// The invariant parts of an affine velocity `O` under rotations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Directions {
    /// `(O + O^T)/2 - (tr O/n) 1`.
    SymmetricTraceless,
    /// `(O - O^T)/2`.
    Skew,
    /// `(tr O/n) 1`.
    Trace,
}

impl Directions {
    /// Those of velocities, or of momenta.
    fn of(self, what: &str) -> String {
        match self {
            Self::SymmetricTraceless => format!("symmetric traceless {what} (shear)"),
            Self::Skew => format!("skew {what} (rotation)"),
            Self::Trace => "multiples of the identity (dilatation)".to_owned(),
        }
    }
}

impl fmt::Display for Directions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.of("velocities"))
    }
}
