//! A model and its capabilities behind plain arrays: what is asked of all models is compiled once, and not for each.

pub(crate) use affine_runtime::prelude::*;
pub(crate) use affine_tests::fields::{Gyroscope, Spring, Stirring};

pub(crate) use crate::body::Body;
use crate::body::Whole;
pub(crate) use crate::capabilities::{Coefficients, Flows, Forces, InLanes};
pub(crate) use crate::forms::{acceleration, balance, centre_balance, legendre, matrix, metric, vector};
use crate::lattice::{Lattices, Pieces, Ratios};
pub(crate) use crate::squeeze::Squeeze;
use affine_runtime::capability::{InLanes as Lanes, SecondOrderEquations, Splitting, Tangent, Taylor};
use affine_runtime::lattice::{LatticePieces, RatioForm, TwoPolarForm};
use affine_runtime::model::Description;
pub(crate) use affine_tests::reference::entries;

/// Velocities `(x, phi, x_dot, phi_dot)` to momenta, `p` and `Pi` row by row, with `T`.
pub(crate) type Legendre = dyn Fn([&[f64]; 4]) -> (Vec<f64>, Vec<f64>, f64);
/// A form and its inverse at a placement.
pub(crate) type Forms = dyn Fn(&[f64]) -> [Vec<f64>; 2];
/// What a point has at a time, by its plain array.
pub(crate) type AtPoint<const K: usize> = dyn Fn(f64, &[f64]) -> [Vec<f64>; K];

/// A model, as far as it goes.
pub(crate) struct Subject {
    pub(crate) description: Description,
    pub(crate) body: Box<dyn Body>,
    pub(crate) velocities: Option<Box<Legendre>>,
    pub(crate) splitting: Option<Box<dyn Flows>>,
    pub(crate) taylor: Option<Box<dyn Coefficients>>,
    pub(crate) nystrom: Option<Box<dyn Forces>>,
    pub(crate) lanes: Option<Box<dyn InLanes>>,
    pub(crate) two_polar: Option<Box<dyn Lattices>>,
    pub(crate) pieces: Option<Box<dyn Pieces>>,
    pub(crate) ratios: Option<Box<dyn Ratios>>,
    pub(crate) metric: Option<Box<Forms>>,
    pub(crate) acceleration: Option<Box<AtPoint<1>>>,
    pub(crate) balance: Option<Box<AtPoint<6>>>,
    pub(crate) centre: Option<Box<AtPoint<5>>>,
}

/// A model that stays.
pub(crate) fn leaked<M>(model: M) -> &'static M {
    Box::leak(Box::new(model))
}

impl Subject {
    pub(crate) fn new<const N: usize, M: Tangent<N>>(model: &'static M) -> Self {
        Self {
            description: M::DESCRIPTION,
            body: Box::new(Whole::<N, M>(model)),
            velocities: None,
            splitting: None,
            taylor: None,
            nystrom: None,
            lanes: None,
            two_polar: None,
            pieces: None,
            ratios: None,
            metric: None,
            acceleration: None,
            balance: None,
            centre: None,
        }
    }

    pub(crate) fn velocities(
        self,
        legendre: impl Fn([&[f64]; 4]) -> (Vec<f64>, Vec<f64>, f64) + 'static,
    ) -> Self {
        Self { velocities: Some(Box::new(legendre)), ..self }
    }

    pub(crate) fn splitting<const N: usize, M: Splitting<N>>(self, model: &'static M) -> Self {
        Self { splitting: Some(Box::new(Whole::<N, M>(model))), ..self }
    }

    pub(crate) fn taylor<const N: usize, M: Taylor<N>>(self, model: &'static M) -> Self {
        Self { taylor: Some(Box::new(Whole::<N, M>(model))), ..self }
    }

    pub(crate) fn nystrom<const N: usize, M: SecondOrderEquations<N>>(self, model: &'static M) -> Self {
        Self { nystrom: Some(Box::new(Whole::<N, M>(model))), ..self }
    }

    pub(crate) fn lanes<const N: usize, M: Lanes<N>>(self, model: &'static M) -> Self {
        Self { lanes: Some(Box::new(Whole::<N, M>(model))), ..self }
    }

    pub(crate) fn two_polar<const N: usize, M: TwoPolarForm<N>>(self, model: &'static M) -> Self {
        Self { two_polar: Some(Box::new(Whole::<N, M>(model))), ..self }
    }

    pub(crate) fn lattice_pieces<const N: usize, M: LatticePieces<N>>(self, model: &'static M) -> Self {
        Self { pieces: Some(Box::new(Whole::<N, M>(model))), ..self }
    }

    pub(crate) fn ratios<const N: usize, M: RatioForm<N>>(self, model: &'static M) -> Self {
        Self { ratios: Some(Box::new(Whole::<N, M>(model))), ..self }
    }

    pub(crate) fn metric(self, forms: impl Fn(&[f64]) -> [Vec<f64>; 2] + 'static) -> Self {
        Self { metric: Some(Box::new(forms)), ..self }
    }

    pub(crate) fn acceleration(self, at: impl Fn(f64, &[f64]) -> [Vec<f64>; 1] + 'static) -> Self {
        Self { acceleration: Some(Box::new(at)), ..self }
    }

    pub(crate) fn balance(self, at: impl Fn(f64, &[f64]) -> [Vec<f64>; 6] + 'static) -> Self {
        Self { balance: Some(Box::new(at)), ..self }
    }

    pub(crate) fn centre(self, at: impl Fn(f64, &[f64]) -> [Vec<f64>; 5] + 'static) -> Self {
        Self { centre: Some(Box::new(at)), ..self }
    }
}
