//! Net evaluation times of right-hand sides beside those written by hand over nalgebra, in one run.
//!
//! *Same function*: Hamilton's equations of the phase point as the model has it. *Same task*: the reduced equations,
//! which are what is integrated.

use affine_runtime::capability::InLanes;
use affine_runtime::lanes::{FastF64x8, Lanes, Widest};
use affine_runtime::model::StateVector;

use crate::by_hand;
use crate::problems::Visitor;
use crate::timing::{Equations, Times, net, net_in_lanes};

/// Times every problem once; those that differ in their numbers alone are left out.
pub(crate) struct RightHandSides;

impl Visitor for RightHandSides {
    fn visit<M: InLanes<3>>(
        &mut self,
        name: &'static str,
        model: &M,
        [start, _]: [M::Point<f64>; 2],
        _t_end: f64,
    ) -> affine_runtime::Result<()> {
        let Some(by_hand) = by_hand::times(name) else { return Ok(()) };
        let function = timed(model.flatten(&start), |y| model.hamilton_equations(0.0, y));
        let (reduced, constants) = model.reduce(0.0, &start);
        let task = timed(reduced, |y| model.reduced_equations(0.0, &constants, y));
        let columns = |kind: fn(&Times) -> f64| {
            let (by_hand, function, task) = (kind(&by_hand), kind(&function), kind(&task));
            format!(
                "{by_hand:>9.1}{function:>9.1}{task:>9.1}{:>8.2}{:>8.2}",
                function / by_hand,
                task / by_hand
            )
        };
        let lanes = [in_lanes::<Widest, M>(model, &start), in_lanes::<FastF64x8, M>(model, &start)];
        println!(
            "{name:<9}{}   {}   {:>9.1}{:>9.1}",
            columns(|times| times.chain),
            columns(|times| times.throughput),
            lanes[0],
            lanes[1],
        );
        Ok(())
    }
}

/// What the columns are.
pub(crate) fn print_head() {
    println!("net evaluation times in ns: written by hand, same function, same task; ratios to the first\n");
    let columns = format!("{:>9}{:>9}{:>9}{:>8}{:>8}", "by hand", "function", "task", "f/hand", "t/hand");
    println!("{:<9}{:<43}   {:<43}   in lanes, task", "", "dependent chain", "state after state");
    println!("{:<9}{columns}   {columns}   {:>9}{:>9}", "problem", "strict", "fast");
}

/// The reduced equations, in lanes.
fn in_lanes<T: Lanes, M: InLanes<3>>(model: &M, start: &M::Point<f64>) -> f64 {
    let (reduced, constants) = model.reduce(0.0, start);
    let constants = M::constants_in_lanes::<T>(&[constants]);
    let mut state = M::Reduced::<T>::zeros();
    for (component, value) in state.as_mut().iter_mut().zip(reduced.as_ref()) {
        *component = T::from_lanes(|_| *value);
    }
    net_in_lanes::<T, _>(state, &Reduced::<T, M> { model, constants })
}

struct Reduced<'a, T: Lanes, M: InLanes<3>> {
    model: &'a M,
    constants: M::Constants<T>,
}

impl<T: Lanes, M: InLanes<3>> Equations<M::Reduced<T>> for Reduced<'_, T, M> {
    #[inline(always)]
    fn slope(&self, y: &M::Reduced<T>, slope: &mut M::Reduced<T>) {
        M::equations_in_lanes(|_| self.model, T::zero(), &self.constants, y, slope);
    }
}

/// States of the sizes that the problems have.
fn timed<S: AsRef<[f64]> + AsMut<[f64]> + Copy>(start: S, f: impl Fn(&S) -> S) -> Times {
    match start.as_ref().len() {
        12 => sized::<12, S>(start, f),
        14 => sized::<14, S>(start, f),
        18 => sized::<18, S>(start, f),
        19 => sized::<19, S>(start, f),
        20 => sized::<20, S>(start, f),
        21 => sized::<21, S>(start, f),
        22 => sized::<22, S>(start, f),
        24 => sized::<24, S>(start, f),
        25 => sized::<25, S>(start, f),
        _ => Times { chain: f64::NAN, throughput: f64::NAN },
    }
}

fn sized<const D: usize, S: AsRef<[f64]> + AsMut<[f64]> + Copy>(start: S, f: impl Fn(&S) -> S) -> Times {
    let array = |state: &S| -> [f64; D] { std::array::from_fn(|k| state.as_ref()[k]) };
    net(array(&start), |y| {
        let mut state = start;
        state.as_mut().copy_from_slice(y);
        array(&f(&state))
    })
}
