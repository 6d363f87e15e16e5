//! The embedded pairs of methods.

use super::field::Stages;
use super::judged::Judged;
use super::step::{OneStep, Pair};
use super::{dormand_prince_54 as dp54, dormand_prince_853 as dp853};
use affine_core::model::StateVector;
use affine_core::scalar::Scalar;

/// The method of Dormand and Prince of order 8 with error estimators of orders 5 and 3 and a dense output of order 7.
#[derive(Clone, Copy, Debug)]
pub struct DormandPrince853;

/// A step of the method of order 8.
pub type Step<S> = OneStep<DormandPrince853, S>;

impl Pair for DormandPrince853 {
    const NAME: &'static str = "RungeKutta8";
    const ERROR_ORDER: f64 = 8.0;
    // Every fourth step was rejected on P2, P7 and P8. With the margin one in twenty is, and the same errors cost 6 percent
    // less on P2, 8 on P5, 13 on P8, from 1e-3 to 1e-9; nothing more nor less at 1e-12, where no step was rejected.
    const MARGIN: f64 = 3.0;
    const STAGES: &'static [(usize, f64)] = dp853::NODES.split_at(11).0;
    const DENSE_EVALUATIONS: u64 = 3;
    const NEEDS_END: bool = false;
    const SUMS_ARE_LONG: bool = true;

    #[inline(always)]
    fn place<S: StateVector<f64>>(
        step: &OneStep<Self, S>,
        f: &impl Stages<S>,
        stage: usize,
        newest: &S,
    ) -> S {
        use dp853::*;
        match stage {
            0 => step.place(f, newest, &A2),
            1 => step.place(f, newest, &A3),
            2 => step.place(f, newest, &A4),
            3 => step.place(f, newest, &A5),
            4 => step.place(f, newest, &A6),
            5 => step.place(f, newest, &A7),
            6 => step.place(f, newest, &A8),
            7 => step.place(f, newest, &A9),
            8 => step.place(f, newest, &A10),
            9 => step.place(f, newest, &A11),
            _ => step.place(f, newest, &A12),
        }
    }

    #[inline(always)]
    fn rise<S: StateVector<f64>>(step: &OneStep<Self, S>, f: &impl Stages<S>) -> S {
        step.combination(f, &dp853::B)
    }

    #[inline(always)]
    fn error_slopes<S: StateVector<f64>>(step: &OneStep<Self, S>, f: &impl Stages<S>, rise: &S) -> (S, S) {
        let third = f.plus_multiple(rise, -1.0, &step.combination(f, &dp853::B3));
        (step.combination(f, &dp853::E5), third)
    }

    #[inline(always)]
    fn error((fifth, third): (f64, f64)) -> f64 {
        if fifth == 0.0 { 0.0 } else { fifth / Scalar::sqrt(fifth + 0.01 * third) }
    }

    #[inline(never)]
    fn largest(judged: &Judged<'_>) -> f64 {
        judged.largest(Self::error)
    }

    fn dense<S: StateVector<f64>>(step: &mut OneStep<Self, S>, f: &impl Stages<S>) -> [S; 4] {
        use dp853::*;
        step.stage(f, NODES[12], &A14);
        step.stage(f, NODES[13], &A15);
        step.stage(f, NODES[14], &A16);
        [
            step.combination(f, &D4),
            step.combination(f, &D5),
            step.combination(f, &D6),
            step.combination(f, &D7),
        ]
    }
}

/// The method of Dormand and Prince of order 5 with an embedded solution and a dense output of order 4.
#[derive(Clone, Copy, Debug)]
pub struct DormandPrince54;

impl Pair for DormandPrince54 {
    const NAME: &'static str = "RungeKutta5";
    const ERROR_ORDER: f64 = 5.0;
    const MARGIN: f64 = 1.0;
    const STAGES: &'static [(usize, f64)] = dp54::NODES.split_at(5).0;
    const DENSE_EVALUATIONS: u64 = 0;
    const NEEDS_END: bool = true;
    const SUMS_ARE_LONG: bool = false;

    #[inline(always)]
    fn place<S: StateVector<f64>>(
        step: &OneStep<Self, S>,
        f: &impl Stages<S>,
        stage: usize,
        newest: &S,
    ) -> S {
        use dp54::*;
        match stage {
            0 => step.place(f, newest, &A2),
            1 => step.place(f, newest, &A3),
            2 => step.place(f, newest, &A4),
            3 => step.place(f, newest, &A5),
            _ => step.place(f, newest, &A6),
        }
    }

    #[inline(always)]
    fn rise<S: StateVector<f64>>(step: &OneStep<Self, S>, f: &impl Stages<S>) -> S {
        step.combination(f, &dp54::B)
    }

    #[inline(always)]
    fn error_slopes<S: StateVector<f64>>(step: &OneStep<Self, S>, f: &impl Stages<S>, _rise: &S) -> (S, S) {
        (step.combination(f, &dp54::E), S::zeros())
    }

    #[inline(always)]
    fn error((fourth, _): (f64, f64)) -> f64 {
        Scalar::sqrt(fourth)
    }

    #[inline(never)]
    fn largest(judged: &Judged<'_>) -> f64 {
        judged.largest(Self::error)
    }

    fn dense<S: StateVector<f64>>(step: &mut OneStep<Self, S>, f: &impl Stages<S>) -> [S; 4] {
        [step.combination(f, &dp54::D), S::zeros(), S::zeros(), S::zeros()]
    }
}
