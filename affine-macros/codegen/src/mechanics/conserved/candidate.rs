//! What a model may conserve as a whole.

use crate::mechanics::charts::Chart;
use crate::mechanics::constraint::Constraint;

/// An enumeration of candidates, and a list of them in this order.
macro_rules! candidates {
    ($($(#[$of:meta])* $candidate:ident,)*) => {
        /// What a model may conserve, named as in the runtime.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Candidate {
            $($(#[$of])* $candidate,)*
        }

        impl Candidate {
            const ALL: &[Self] = &[$(Self::$candidate),*];
        }
    };
}

candidates! {
    /// Energy `H`.
    Energy,
    /// `p`
    LinearMomentum,
    /// `p_hat = phi^T p`
    ComovingLinearMomentum,
    /// `x p^T - p x^T`
    OrbitalAngularMomentum,
    /// `I(O) = x p^T + Sigma`
    TotalAffineMomentum,
    /// `I(O) - I(O)^T`
    TotalAngularMomentum,
    /// `Sigma`
    AffineSpin,
    /// traceless part of `Sigma`
    Deviator,
    /// `S = Sigma - Sigma^T`
    Spin,
    /// `|S|^2`
    SpinNorm,
    /// `Sigma_hat`
    ComovingAffineSpin,
    /// traceless part of `Sigma_hat`
    ComovingDeviator,
    /// `Vort = Sigma_hat - Sigma_hat^T`
    Vorticity,
    /// `|Vort|^2`
    VorticityNorm,
    /// `Pi`
    CanonicalMomentum,
    /// `tr Sigma`
    Casimir1,
    /// `tr Sigma^2`
    Casimir2,
    /// `tr Sigma^3`
    Casimir3,
    /// `tr sigma^2` of the deviator
    DeviatorCasimir2,
    /// `tr sigma^3` of the deviator
    DeviatorCasimir3,
}

impl Candidate {
    /// Of a power or a norm the momentum that it is made of: where a force leaves that at rest whatever it is, it leaves its
    /// powers, which generate what it does itself.
    pub(in crate::mechanics) fn generator(self) -> Candidate {
        match self {
            Candidate::Casimir2 | Candidate::Casimir3 => Candidate::AffineSpin,
            Candidate::DeviatorCasimir2 | Candidate::DeviatorCasimir3 => Candidate::Deviator,
            Candidate::SpinNorm => Candidate::Spin,
            Candidate::VorticityNorm => Candidate::Vorticity,
            other => other,
        }
    }

    /// Does the quantity exist for a model of this dimension, with or without translation?
    pub(super) fn exists(self, dim: usize, translation: bool) -> bool {
        match self {
            Candidate::LinearMomentum
            | Candidate::ComovingLinearMomentum
            | Candidate::OrbitalAngularMomentum
            | Candidate::TotalAffineMomentum
            | Candidate::TotalAngularMomentum => translation,
            Candidate::Casimir3 | Candidate::DeviatorCasimir3 => dim == 3,
            _ => true,
        }
    }

    /// Is it under the constraint neither a number nor another candidate under a second name? `Sigma` is traceless for
    /// SL(n) and `S/2` for SO(n); where `phi` is a rotation up to scale, `|Vort| = |S|` and the deviator is `S/2`.
    fn means_something(self, group: Constraint) -> bool {
        let deviators = matches!(
            self,
            Candidate::Deviator
                | Candidate::ComovingDeviator
                | Candidate::DeviatorCasimir2
                | Candidate::DeviatorCasimir3
        );
        let casimirs = matches!(self, Candidate::Casimir1 | Candidate::Casimir2 | Candidate::Casimir3);
        let spins = matches!(self, Candidate::AffineSpin | Candidate::ComovingAffineSpin);
        match group {
            Constraint::Isochoric => !deviators && self != Candidate::Casimir1,
            Constraint::Rigid => !deviators && !casimirs && !spins && self != Candidate::VorticityNorm,
            Constraint::Conformal => !deviators && self != Candidate::VorticityNorm,
        }
    }
}

/// A multiple of an entry of a momentum in the user's bases, row and column from 1; of a vector the column is 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// How often it is taken.
    pub factor: i64,
    /// The momentum.
    pub of: Candidate,
    /// The row.
    pub row: usize,
    /// The column.
    pub column: usize,
}

/// The quantities that exist in a chart.
pub fn candidates(chart: &Chart) -> Vec<Candidate> {
    let exists = |c: &Candidate| {
        c.exists(chart.dim, chart.linear.is_some())
            && chart.confined.is_none_or(|group| c.means_something(group))
    };
    Candidate::ALL.iter().copied().filter(exists).collect()
}
