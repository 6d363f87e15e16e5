//! Evaluation times of right-hand sides beside the best generated C, in one run.
//!
//! *Same function*: Hamilton's equations of the phase point as the model has it. *Same task*: the reduced equations,
//! which are what is integrated.

use affine_runtime::capability::{InLanes, Taylor};
use affine_runtime::lanes::{F64x8, FastF64x8, Lanes};
use affine_runtime::model::StateVector;

use crate::by_hand;
use crate::compiled::{Compiled, STATEMENTS};
use crate::problems::Visitor;
use crate::timing::{Equations, alone, in_lanes};

/// Times every problem once; those that differ in their numbers alone are left out.
pub(crate) struct RightHandSides {
    pub(crate) compiled: Compiled,
}

impl Visitor for RightHandSides {
    fn visit<M: InLanes<3, Point<f64>: Send + Sync> + Taylor<3> + Sync>(
        &mut self,
        name: &'static str,
        model: &M,
        [start, _]: [M::Point<f64>; 2],
        _t_end: f64,
    ) -> affine_runtime::Result<()> {
        if !["P1", "P2", "P2r", "P3", "P7"].contains(&name) {
            return Ok(());
        }
        let state = by_hand::state(name);
        let mut best = [f64::INFINITY; 3];
        for (tool, _) in STATEMENTS {
            let times = self.compiled.times(tool, name, &state).unwrap_or([f64::NAN; 3]);
            best = std::array::from_fn(|k| best[k].min(times[k]));
        }
        let function = alone(model.flatten(&start), |y| model.hamilton_equations(0.0, y));
        let (reduced, constants) = model.reduce(0.0, &start);
        let task = alone(reduced, |y| model.reduced_equations(0.0, &constants, y));
        let beside = |best: f64, times: &[f64]| {
            let times: String = times.iter().map(|time| format!("{time:>9.1}{:>6.2}", time / best)).collect();
            format!("{best:>8.1}{times}")
        };
        println!(
            "{name:<9}{}  {}  {}",
            beside(best[0], &[function.chain, task.chain]),
            beside(best[1], &[function.throughput, task.throughput]),
            beside(
                best[2],
                &[
                    reduced_in_lanes::<F64x8, M>(model, &start),
                    reduced_in_lanes::<FastF64x8, M>(model, &start)
                ]
            ),
        );
        Ok(())
    }
}

/// What the columns are.
pub(crate) fn print_head() {
    println!(
        "times of one evaluation in ns, reading and writing included, and their ratios to the least of the C by SymPy and CasADi\n"
    );
    let columns = format!("{:>8}{:>9}{:>6}{:>9}{:>6}", "C", "function", "", "task", "");
    println!("{:<9}{:<38}  {:<38}  in lanes", "", "dependent chain", "state after state");
    println!(
        "{:<9}{columns}  {columns}  {:>8}{:>9}{:>6}{:>9}{:>6}",
        "problem", "C", "strict", "", "fast", ""
    );
}

/// The reduced equations, in lanes.
pub(crate) fn reduced_in_lanes<T: Lanes, M: InLanes<3>>(model: &M, start: &M::Point<f64>) -> f64 {
    let (reduced, constants) = model.reduce(0.0, start);
    let constants = M::constants_in_lanes::<T>(&[constants]);
    let mut state = M::Reduced::<T>::zeros();
    for (component, value) in state.as_mut().iter_mut().zip(reduced.as_ref()) {
        *component = T::from_lanes(|_| *value);
    }
    in_lanes::<T, _>(state, &Reduced::<T, M> { model, constants })
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
