//! Functions on phase space that a model may conserve.

use crate::error::Error;
use crate::kinetic::Kinetic;
use crate::matrix::Matrix;
use crate::ring::Ring;
use crate::state::State;

macro_rules! observables {
    ($($(#[$meta:meta])* $name:ident),* $(,)?) => {
        /// A function on phase space; the variants' names are those of the runtime's list of conserved quantities.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Observable { $($(#[$meta])* $name),* }

        impl Observable {
            /// All observables.
            pub const ALL: &'static [Observable] = &[$(Observable::$name),*];

            /// The name of the variant.
            pub fn name(self) -> &'static str {
                match self { $(Observable::$name => stringify!($name)),* }
            }

            /// The observable of that name.
            pub fn named(name: &str) -> Option<Observable> {
                Self::ALL.iter().copied().find(|observable| observable.name() == name)
            }
        }
    };
}

observables! {
    /// The Hamiltonian `H`.
    Energy,
    /// `p`.
    LinearMomentum,
    /// `p_hat = phi^T p`.
    ComovingLinearMomentum,
    /// `x p^T - p x^T`.
    OrbitalAngularMomentum,
    /// `I(O) = x p^T + Sigma`.
    TotalAffineMomentum,
    /// `I(O) - I(O)^T`.
    TotalAngularMomentum,
    /// `Sigma = phi Pi`.
    AffineSpin,
    /// `sigma = Sigma - (tr Sigma/n) 1`.
    Deviator,
    /// `S = Sigma - Sigma^T`.
    Spin,
    /// `|S|^2 = -tr(S^2)/2`.
    SpinNorm,
    /// `Sigma_hat = Pi phi`.
    ComovingAffineSpin,
    /// `Sigma_hat - (tr Sigma_hat/n) 1`.
    ComovingDeviator,
    /// `Vort = Sigma_hat - Sigma_hat^T`.
    Vorticity,
    /// `|Vort|^2 = -tr(Vort^2)/2`.
    VorticityNorm,
    /// `Pi`.
    CanonicalMomentum,
    /// `tr Sigma`.
    Casimir1,
    /// `tr Sigma^2`.
    Casimir2,
    /// `tr Sigma^3`.
    Casimir3,
    /// `tr sigma^2`.
    DeviatorCasimir2,
    /// `tr sigma^3`; identically 0 for `n = 2`.
    DeviatorCasimir3,
}

impl Observable {
    /// The value at `state`: `n x n` for tensors, `n x 1` for vectors, `1 x 1` for scalars.
    ///
    /// # Errors
    /// Those of [`Kinetic::hamiltonian`] for [`Observable::Energy`]; otherwise none.
    pub fn value<R: Ring>(self, kinetic: &Kinetic, state: &State<R>) -> Result<Matrix<R>, Error> {
        self.of_state(state).map_or_else(|| kinetic.hamiltonian(state), Ok)
    }

    /// The same where it is a function of the state alone; `None` for [`Observable::Energy`].
    pub(crate) fn of_state<R: Ring>(self, state: &State<R>) -> Option<Matrix<R>> {
        let State { x, phi, p, pi } = state;
        let sigma = || phi * pi;
        let sigma_hat = || pi * phi;
        let orbital = || x * &p.transpose();
        Some(match self {
            Observable::Energy => return None,
            Observable::LinearMomentum => p.clone(),
            Observable::ComovingLinearMomentum => &phi.transpose() * p,
            Observable::OrbitalAngularMomentum => orbital().skew(),
            Observable::TotalAffineMomentum => &orbital() + &sigma(),
            Observable::TotalAngularMomentum => (&orbital() + &sigma()).skew(),
            Observable::AffineSpin => sigma(),
            Observable::Deviator => sigma().deviator(),
            Observable::Spin => sigma().skew(),
            Observable::SpinNorm => squared_norm(&sigma().skew()),
            Observable::ComovingAffineSpin => sigma_hat(),
            Observable::ComovingDeviator => sigma_hat().deviator(),
            Observable::Vorticity => sigma_hat().skew(),
            Observable::VorticityNorm => squared_norm(&sigma_hat().skew()),
            Observable::CanonicalMomentum => pi.clone(),
            Observable::Casimir1 => sigma().trace(),
            Observable::Casimir2 => power_trace(&sigma(), 2),
            Observable::Casimir3 => power_trace(&sigma(), 3),
            Observable::DeviatorCasimir2 => power_trace(&sigma().deviator(), 2),
            Observable::DeviatorCasimir3 => power_trace(&sigma().deviator(), 3),
        })
    }
}

/// `-tr(S^2)/2`.
fn squared_norm<R: Ring>(skew: &Matrix<R>) -> Matrix<R> {
    power_trace(skew, 2).scaled(&crate::ring::rational(-1, 2))
}

/// `tr X^k`, `k >= 1`.
fn power_trace<R: Ring>(matrix: &Matrix<R>, k: usize) -> Matrix<R> {
    (1..k).fold(matrix.clone(), |power, _| &power * matrix).trace()
}
