//! RATTLE: the body without its constraint, and the multiplier step by step.

use super::layout::Layout;
use super::motion::{At, Begun, Goal, Launched, Purpose, begun, launched};
use crate::decompose::LinearMap;
use crate::error::{Reason, Setting};
use crate::frames::Matrix;
use crate::inner::{Unconstrained, is_emitted};
use crate::integrate::Rattle;
use crate::integrate::rattle::Composition;
use crate::model::{Group, Model, Quantity, StateVector};
use crate::state::Phase;

/// Evaluations that a start takes to find its momentum.
const EVALUATIONS: u64 = 2;

/// Placement and canonical momentum by RATTLE.
pub(super) fn by_rattle<'a, const N: usize, M, R, H>(
    at: At<'_, N, M, H>,
    capability: impl Fn(H) -> Option<R> + Copy + 'a,
    (order, step): (usize, f64),
    goal: Goal<'_, 'a, N, H>,
) -> Result<Launched<'a, N, H>, Reason>
where
    M: Model<N> + 'a,
    R: Unconstrained + 'a,
    H: Purpose<'a, N, Model = M>,
{
    let refused = || Setting::NotSeparable { model: M::DESCRIPTION.name };
    if const { !is_emitted::<R>() } {
        return Err(refused().into());
    }
    let composition = Composition::of_order(order).ok_or(Setting::Order { given: order })?;
    let layout = const { Layout::of(R::GROUPS, N) };
    launched(at, layout, goal, move |model: &H, course| {
        let free = capability(model.clone()).ok_or_else(refused)?;
        let start = *course.start;
        let begin = (course.t0, canonical::<N, R>(&free, course.t0, &start));
        let expand = move |_: f64, state: &R::State| point::<N, R, _>(state, &start);
        let equations = move |t: f64, state: &R::State| free.rates(t, state);
        let rattle = Rattle::<N, _, _>::new(equations, R::GROUPS, composition, begin, course.t_end, step);
        let begun = begun::<N, M, _, _>(course, rattle, expand)?;
        Ok(Begun { evaluations: begun.evaluations + EVALUATIONS, ..begun })
    })
}

/// A point as a canonical state. Momenta that differ by a multiple of `phi^-1` act alike on the velocities that keep
/// `det phi = 1`: the one is taken whose velocity does.
fn canonical<const N: usize, R: Unconstrained>(free: &R, t: f64, start: &impl Phase<N>) -> R::State {
    let (phi, pi) = (*start.phi(), start.pi().0.0);
    let (x, p) = (start.x(), start.p());
    let state = |pi: &Matrix<N>| {
        let mut state = R::State::zeros();
        for (group, components) in groups(R::GROUPS, state.as_mut()) {
            for (k, component) in components.iter_mut().enumerate() {
                *component = match group {
                    Quantity::Position => x[k],
                    Quantity::LinearMomentum => p[k],
                    Quantity::Placement => phi[(k / N, k % N)],
                    Quantity::Work => 0.0,
                    _ => pi[(k / N, k % N)],
                };
            }
        }
        state
    };
    let to_body = phi.inverse();
    let growth = |pi: &Matrix<N>| {
        let mut rates = free.rates(t, &state(pi));
        let velocity = groups(R::GROUPS, rates.as_mut()).find(|(group, _)| *group == Quantity::Placement);
        velocity.map_or(0.0, |(_, velocity)| (to_body * Matrix::<N>::from_row_slice(velocity)).trace())
    };
    state(&(pi - to_body * (growth(&pi) / growth(&to_body))))
}

/// The point of a canonical state: of `Sigma_hat = Pi phi` the traceless part.
fn point<const N: usize, R: Unconstrained, P: Phase<N>>(state: &R::State, like: &P) -> P {
    let mut state = *state;
    let (mut phi, mut pi) = (Matrix::<N>::zeros(), Matrix::<N>::zeros());
    let mut centre = [[0.0; N]; 2];
    for (group, components) in groups(R::GROUPS, state.as_mut()) {
        match group {
            Quantity::Position => centre[0].copy_from_slice(components),
            Quantity::LinearMomentum => centre[1].copy_from_slice(components),
            Quantity::Placement => phi = Matrix::<N>::from_row_slice(components),
            Quantity::Work => {}
            _ => pi = Matrix::<N>::from_row_slice(components),
        }
    }
    let spin = pi * phi;
    let spin = spin - Matrix::<N>::identity() * (spin.trace() / N as f64);
    let matrices = phi.iter().chain(spin.iter());
    let mut entries = matrices.chain(centre.iter().flatten()).copied();
    like.with_entries(&mut || entries.next().unwrap_or_default())
}

/// The groups of a state, one after the other.
fn groups<'s>(
    layout: &'static [Group],
    mut state: &'s mut [f64],
) -> impl Iterator<Item = (Quantity, &'s mut [f64])> {
    layout.iter().map(move |group| {
        let (components, rest) = core::mem::take(&mut state).split_at_mut(group.len);
        state = rest;
        (group.quantity, components)
    })
}
