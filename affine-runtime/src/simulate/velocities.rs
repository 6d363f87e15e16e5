//! Variables of a motion with stiff friction: affine velocities in place of momenta.

use super::layout::{Layout, momentum_in, placement_in};
use crate::decompose::LinearMap;
use crate::dual::Dual;
use crate::frames::Matrix;
use crate::integrate::radau::{Differences, Exact, Jacobian};
use crate::model::{Handle, Model, StateVector};
use crate::scalar::Real;

/// Components of the affine velocity of a body in space.
const COMPONENTS: usize = 9;
/// Less than this part of what something is made from is rounding.
const ROUNDING: f64 = 1e-9;

/// The frame in which a velocity is read.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Frame {
    /// `Omega_hat = phi^-1 phi_dot`.
    Comoving,
    /// `Omega = phi_dot phi^-1`.
    Spatial,
}

impl Frame {
    fn velocity<const N: usize, T: Real>(self, phi: &Matrix<N, T>, phi_dot: &Matrix<N, T>) -> Matrix<N, T> {
        match self {
            Self::Comoving => phi.inverse() * phi_dot,
            Self::Spatial => phi_dot * phi.inverse(),
        }
    }
    fn phi_dot<const N: usize>(self, phi: &Matrix<N>, velocity: &Matrix<N>) -> Matrix<N> {
        match self {
            Self::Comoving => phi * velocity,
            Self::Spatial => velocity * phi,
        }
    }
}

/// The equations of motion over a reduced state, or over the same with the affine velocity in the place of the internal
/// momentum.
///
/// Friction `R(Omega)` holds a velocity at `O(1/r)`, in the frame in which `R` does not depend on the placement. There the
/// slow motions lie in a plane; over momenta that are no constant image of that velocity they lie in a curved manifold,
/// which no long step can follow. The velocity is read off the equations, `phi_dot` as the reduced state has it, and is
/// linear in the momentum.
pub(super) struct Variables<const N: usize, M: Model<N>, H> {
    handle: H,
    constants: M::Constants<f64>,
    varied: M::Constants<Dual<f64>>,
    /// `None`: the momenta are as good.
    frame: Option<Frame>,
}

impl<const N: usize, M: Model<N>, H: Clone> Clone for Variables<N, M, H> {
    fn clone(&self) -> Self {
        Self { handle: self.handle.clone(), ..*self }
    }
}

impl<const N: usize, M: Model<N>, H: Handle<N, Model = M>> Variables<N, M, H> {
    const PLACEMENT: Option<core::ops::Range<usize>> = placement_in(M::DESCRIPTION.reduced, N);
    const MOMENTUM: Option<core::ops::Range<usize>> = momentum_in(M::DESCRIPTION.reduced, N);

    /// The state at a start, with its variables and the evaluations that it took to find them.
    pub(super) fn at(handle: &H, (t0, point): (f64, &M::Point<f64>)) -> (M::Reduced<f64>, Self, u64) {
        let model = handle.model();
        let (state, constants) = model.reduce(t0, point);
        let mut full = M::Full::<Dual<f64>>::zeros();
        let values = model.flatten(point);
        full.as_mut().iter_mut().zip(values.as_ref()).for_each(|(dual, value)| *dual = Dual::fixed(*value));
        let (_, varied) = model.reduce(Dual::fixed(t0), &model.unflatten(&full));
        let mut variables = Self { handle: handle.clone(), constants, varied, frame: None };
        let Some((frame, evaluations)) = variables.frame_of_friction(t0, &state) else {
            return (state, variables, 0);
        };
        variables.frame = frame;
        (variables.of_state(t0, &state), variables, evaluations + 1)
    }

    /// The phase point of variables.
    pub(super) fn point(&self, t: f64, z: &M::Reduced<f64>) -> M::Point<f64> {
        let model = self.handle.model();
        model.expand(t, &self.constants, &model.renewed(&self.state(t, z)))
    }

    /// Their time derivatives.
    pub(super) fn rates(&self, t: f64, z: &M::Reduced<f64>) -> M::Reduced<f64> {
        let state = self.state(t, z);
        let mut rates = self.equations(t, &state);
        if let Some((frame, _, momentum)) = self.blocks() {
            let velocity = self.varied_velocity(frame, t, &state, &rates);
            let block = rates.as_mut()[momentum].iter_mut();
            block.zip(velocity.transpose().iter()).for_each(|(rate, velocity)| *rate = velocity.slope);
        }
        rates
    }

    fn equations(&self, t: f64, state: &M::Reduced<f64>) -> M::Reduced<f64> {
        let model = self.handle.model();
        model.reduced_equations(t, &self.constants, &model.renewed(state))
    }

    fn blocks(&self) -> Option<(Frame, core::ops::Range<usize>, core::ops::Range<usize>)> {
        Some((self.frame?, Self::PLACEMENT?, Self::MOMENTUM?))
    }

    /// The affine velocity of a state that moves at given rates, with its time derivative.
    fn varied_velocity(
        &self,
        frame: Frame,
        t: f64,
        state: &M::Reduced<f64>,
        rates: &M::Reduced<f64>,
    ) -> Matrix<N, Dual<f64>> {
        let mut moving = M::Reduced::<Dual<f64>>::zeros();
        for (dual, (value, slope)) in
            moving.as_mut().iter_mut().zip(state.as_ref().iter().zip(rates.as_ref()))
        {
            *dual = Dual { value: *value, slope: *slope };
        }
        let model = self.handle.model();
        let t = Dual { value: t, slope: 1.0 };
        let rates = model.reduced_equations(t, &self.varied, &model.renewed(&moving));
        let placement = Self::PLACEMENT.unwrap_or(0..0);
        let block =
            |values: &M::Reduced<Dual<f64>>| Matrix::from_row_slice(&values.as_ref()[placement.clone()]);
        frame.velocity(&block(&moving), &block(&rates))
    }

    /// How fast the affine velocity is, or is made by forces while the body moves by its own size; 1 where neither is.
    fn speed(&self, t: f64, state: &M::Reduced<f64>) -> f64 {
        let velocity = self.varied_velocity(Frame::Comoving, t, state, &self.equations(t, state));
        let acceleration = velocity.map(|entry| entry.slope).norm();
        let speed = velocity.map(|entry| entry.value).norm() + libm::sqrt(acceleration);
        if speed.is_finite() && speed > 0.0 { speed } else { 1.0 }
    }

    /// The affine velocity of a state.
    fn velocity(&self, frame: Frame, t: f64, state: &M::Reduced<f64>) -> Option<Matrix<N>> {
        let placement = Self::PLACEMENT?;
        let rates = self.equations(t, state);
        let block = |values: &M::Reduced<f64>| Matrix::from_row_slice(&values.as_ref()[placement.clone()]);
        Some(frame.velocity(&block(state), &block(&rates)))
    }

    /// The variables of a state.
    fn of_state(&self, t: f64, state: &M::Reduced<f64>) -> M::Reduced<f64> {
        let Some((frame, _, momentum)) = self.blocks() else { return *state };
        let Some(velocity) = self.velocity(frame, t, state) else { return *state };
        let mut variables = *state;
        put(&mut variables.as_mut()[momentum], &velocity);
        variables
    }

    /// The state of variables.
    fn state(&self, t: f64, z: &M::Reduced<f64>) -> M::Reduced<f64> {
        match self.frame {
            Some(frame) => self.state_in(frame, t, z),
            None => *z,
        }
    }

    /// The momentum of a velocity: `phi_dot` is linear in it. What has no solution is not finite.
    fn state_in(&self, frame: Frame, t: f64, z: &M::Reduced<f64>) -> M::Reduced<f64> {
        let (Some(placement), Some(momentum)) = (Self::PLACEMENT, Self::MOMENTUM) else { return *z };
        let wanted: Matrix<N> = {
            let block = |range: &core::ops::Range<usize>| Matrix::from_row_slice(&z.as_ref()[range.clone()]);
            frame.phi_dot(&block(&placement), &block(&momentum))
        };
        let mut state = *z;
        state.as_mut()[momentum.clone()].fill(0.0);
        let moved = |state: &M::Reduced<f64>| -> [f64; COMPONENTS] {
            let rates = self.equations(t, state);
            core::array::from_fn(|k| rates.as_ref().get(placement.start + k).copied().unwrap_or(0.0))
        };
        let at_rest = moved(&state);
        let mut form = nalgebra::SMatrix::<f64, COMPONENTS, COMPONENTS>::identity();
        let mut target = nalgebra::SVector::<f64, COMPONENTS>::zeros();
        for (k, place) in momentum.clone().enumerate() {
            let mut unit = state;
            unit.as_mut()[place] = 1.0;
            let moved = moved(&unit);
            (0..N * N).for_each(|i| form[(i, k)] = moved[i] - at_rest[i]);
            target[k] = wanted[(k / N, k % N)] - at_rest[k];
        }
        let solution = form.lu().solve(&target);
        for (k, place) in momentum.enumerate() {
            state.as_mut()[place] = solution.map_or(f64::NAN, |solution| solution[k]);
        }
        state
    }

    /// The frame of the friction, none where the momenta are a constant image of the velocity there or where the velocity is
    /// not linear in them; and the evaluations that it took. `None` where there is no friction, or no momentum of all
    /// components.
    fn frame_of_friction(&self, t: f64, state: &M::Reduced<f64>) -> Option<(Option<Frame>, u64)> {
        let (placement, momentum) = (Self::PLACEMENT?, Self::MOMENTUM?);
        let mut elsewhere = *state;
        for (k, place) in placement.enumerate() {
            // Any other placement near by.
            elsewhere.as_mut()[place] *= 1.0 + 0.01 * ((k * k) % 7) as f64;
        }
        let work = const { Layout::of(M::DESCRIPTION.reduced, N) }.work?;
        let speed = self.speed(t, state);
        let power = |frame: Frame, state: &M::Reduced<f64>, part: f64| {
            let mut moving = *state;
            let size = part * speed;
            let pattern = Matrix::<N>::from_fn(|i, j| size * (1.0 + ((2 * i + j * j) % 5) as f64));
            put(&mut moving.as_mut()[momentum.clone()], &pattern);
            self.equations(t, &self.state_in(frame, t, &moving)).as_ref()[work]
        };
        let dependence = |frame: Frame| {
            // The power of other forces is linear in the velocity: that of friction, and where there is none, theirs.
            let [here, there] = [state, &elsewhere].map(|state| {
                let [ahead, behind] = [1.0, -1.0].map(|part| power(frame, state, part));
                let of_friction = ahead + behind - 2.0 * power(frame, state, 0.0);
                let of_others = ahead - behind;
                if of_friction.abs() > ROUNDING * of_others.abs() { of_friction } else { of_others }
            });
            (here - there).abs() / (here.abs() + there.abs())
        };
        let (body, space) = (dependence(Frame::Comoving), dependence(Frame::Spatial));
        let frame = if body <= space { Frame::Comoving } else { Frame::Spatial };
        let [here, there] = [state, &elsewhere].map(|state| self.velocity(frame, t, state));
        let is_constant = (here? - there?).norm() <= ROUNDING * here?.norm();
        let mut moving = *state;
        put(&mut moving.as_mut()[momentum.clone()], &here?);
        let again = self.state_in(frame, t, &moving);
        let [again, before] =
            [&again, state].map(|state| Matrix::<N>::from_row_slice(&state.as_ref()[momentum.clone()]));
        let is_linear = (again - before).norm() <= ROUNDING * before.norm();
        let evaluations = 12 * (solving(N) + 1) + 4 + solving(N);
        Some(((!is_constant && is_linear).then_some(frame), evaluations))
    }
}

/// Numbers with a derivative where momenta are the variables, differences where they are found by solving.
impl<const N: usize, M: Model<N>, H: Handle<N, Model = M>> Jacobian<M::Reduced<f64>> for Variables<N, M, H> {
    fn columns(
        &self,
        f: &dyn Fn(f64, &M::Reduced<f64>) -> M::Reduced<f64>,
        at: (f64, &M::Reduced<f64>, &M::Reduced<f64>),
        extent: &M::Reduced<f64>,
        columns: &mut [M::Reduced<f64>],
    ) -> u64 {
        if self.frame.is_some() {
            return Differences.columns(f, at, extent, columns);
        }
        let model = self.handle.model();
        let column = |t: f64, y: &M::Reduced<f64>, component: usize| {
            let mut varied = M::Reduced::<Dual<f64>>::zeros();
            varied.as_mut().iter_mut().zip(y.as_ref()).for_each(|(dual, value)| *dual = Dual::fixed(*value));
            varied.as_mut()[component].slope = 1.0;
            let rates = model.reduced_equations(Dual::fixed(t), &self.varied, &model.renewed(&varied));
            let mut column = M::Reduced::<f64>::zeros();
            column.as_mut().iter_mut().zip(rates.as_ref()).for_each(|(entry, rate)| *entry = rate.slope);
            column
        };
        Exact(column).columns(f, at, extent, columns)
    }

    /// Momenta of a velocity take one for each component and one at rest, rates and their derivative one each.
    fn worth(&self) -> u64 {
        if self.frame.is_some() { solving(N) + 2 } else { 1 }
    }
}

/// Evaluations that it takes to find a momentum.
fn solving(n: usize) -> u64 {
    (n * n) as u64 + 1
}

/// Writes a matrix row by row.
fn put<const N: usize>(block: &mut [f64], matrix: &Matrix<N>) {
    block.iter_mut().zip(matrix.transpose().iter()).for_each(|(entry, value)| *entry = *value);
}
