//! Runs of one step, so that callgrind counts what a run costs beside its steps: the instructions of 2000 runs less those of 1000 are
//! those of 1000 runs alone.

use affine_runtime::capability::{InLanes, Taylor};
use affine_runtime::prelude::*;

use crate::problems::Visitor;

/// Part of the problem's time that is one step at this tolerance.
const PART: f64 = 1e-4;
const TOLERANCE: f64 = 1e-3;

/// So many runs of one problem.
pub(crate) struct Runs {
    pub(crate) of: String,
    pub(crate) count: u64,
    /// Steps that all of them took.
    pub(crate) steps: u64,
}

impl Visitor for Runs {
    fn visit<M: InLanes<3, Point<f64>: Send + Sync> + Taylor<3> + Sync>(
        &mut self,
        name: &'static str,
        model: &M,
        [start, _]: [M::Point<f64>; 2],
        t_end: f64,
    ) -> affine_runtime::Result<()> {
        if name == self.of {
            for _ in 0..self.count {
                let run = Simulation::new(model, start)
                    .until(PART * t_end)
                    .tolerance(TOLERANCE)
                    .output([])
                    .run()?;
                self.steps += run.statistics().steps;
            }
        }
        Ok(())
    }
}
