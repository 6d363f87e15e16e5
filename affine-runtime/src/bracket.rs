//! Poisson brackets of functions of a phase point, by numbers with a derivative.

use crate::dual::Dual;
use crate::frames::{Matrix, Vector};
use crate::inner::projected;
use crate::model::{Constraint, Model, StateVector};
use crate::scalar::Real;
use crate::state::Phase;

/// `{F, G} = dF/dq dG/dp - dF/dp dG/dq` at a phase point, with the canonical pairs `x, p` and `phi_iA, Pi_Ai` (section 2 of
/// Slawianowski et al., whose brackets of affine spins have this sign; see the errata of the guide for one that has not).
///
/// `F` and `G` are functions of the point in numbers with a derivative, whatever the frame of the model. `{F, H}` is the rate of
/// `F` along the flow where no force acts that has no potential. Under a constraint the bracket is that of the phase space of its
/// group, to which momenta are projected before functions see them. A body without translation has `x = p = 0`.
///
/// ```
/// use affine_runtime::bracket::poisson_bracket;
/// use affine_runtime::dual::Dual;
/// use affine_runtime::prelude::*;
///
/// #[affine_model(dim = 3, kinetic(casimir2 = 0.2, body_inertia = 1), potential = tr(G)/2)]
/// struct Body;
///
/// let phi = Matrix::<3>::new(1.0, 0.2, 0.0, 0.1, 0.9, 0.0, 0.0, -0.1, 1.1);
/// let spin = Comoving(Matrix::<3>::new(0.1, 0.4, -0.3, -0.2, 0.1, 0.2, 0.3, -0.1, 0.0));
/// let point = Body.at_momentum(phi, spin)?;
/// // {S_12, S_23} = -S_13, and the spin is conserved.
/// let bracket = poisson_bracket(&Body, &point, |at| at.spin().0.0[(0, 1)], |at| at.spin().0.0[(1, 2)]);
/// assert!((bracket + point.spin().0.0[(0, 2)]).abs() < 1e-14);
/// let energy = |at: &_| Body.hamiltonian(Dual::fixed(0.0), at);
/// assert!(poisson_bracket(&Body, &point, |at| at.spin().0.0[(0, 1)], energy).abs() < 1e-14);
/// # Ok::<(), affine_runtime::Error>(())
/// ```
pub fn poisson_bracket<const N: usize, M: Model<N>, T: Real>(
    model: &M,
    point: &M::Point<T>,
    f: impl Fn(&M::Point<Dual<T>>) -> Dual<T>,
    g: impl Fn(&M::Point<Dual<T>>) -> Dual<T>,
) -> T {
    let mut full = M::Full::<Dual<T>>::zeros();
    let entries = model.flatten(point);
    full.as_mut().iter_mut().zip(entries.as_ref()).for_each(|(both, entry)| *both = Dual::fixed(*entry));
    let point = model.unflatten(&full);
    let constraint = M::DESCRIPTION.constraint;
    let (f, g) = (gradient(constraint, &point, f), gradient(constraint, &point, g));
    f.paired_with(&g) - g.paired_with(&f)
}

/// Canonical coordinates of a point, or the derivatives of a function by them, each where its coordinate stands.
#[derive(Clone, Copy)]
struct Coordinates<const N: usize, T> {
    x: Vector<N, T>,
    p: Vector<N, T>,
    phi: Matrix<N, T>,
    pi: Matrix<N, T>,
}

impl<const N: usize, T: Real> Coordinates<N, T> {
    /// `dF/dx . dG/dp + tr(dF/dphi dG/dPi)`.
    fn paired_with(&self, other: &Self) -> T {
        self.x.dot(&other.p) + self.phi.transpose().dot(&other.pi)
    }
}

fn gradient<const N: usize, T: Real, P: Phase<N, Dual<T>>>(
    constraint: Option<Constraint>,
    point: &P,
    f: impl Fn(&P) -> Dual<T>,
) -> Coordinates<N, T> {
    let here = Coordinates { x: point.x(), p: point.p(), phi: *point.phi(), pi: point.pi().0.0 };
    let slope = |along: &dyn Fn(&mut Coordinates<N, Dual<T>>) -> &mut Dual<T>| {
        let mut varied = here;
        along(&mut varied).slope = T::one();
        let Coordinates { x, p, phi, pi } = varied;
        let varied = point.with_canonical(phi, pi, x, p);
        let confined = constraint.map(|own| varied.moved(x, phi, |spin| projected(own, spin)));
        f(&confined.unwrap_or(varied)).slope
    };
    Coordinates {
        x: Vector::<N, T>::from_fn(|i, _| slope(&|varied| &mut varied.x[i])),
        p: Vector::<N, T>::from_fn(|i, _| slope(&|varied| &mut varied.p[i])),
        phi: Matrix::<N, T>::from_fn(|i, a| slope(&|varied| &mut varied.phi[(i, a)])),
        pi: Matrix::<N, T>::from_fn(|a, i| slope(&|varied| &mut varied.pi[(a, i)])),
    }
}
