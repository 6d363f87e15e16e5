//! Every key and capability of a specification, where std names are shadowed, without a prelude, where warnings are errors,
//! and inside of functions.

use affine_runtime::capability::{InLanes, SecondOrderEquations, Splitting, Tangent, Taylor};
use affine_runtime::force;
use affine_runtime::frames::Vector;
use affine_runtime::lattice::{LatticePieces, TwoPolarForm};
use affine_runtime::scalar::Scalar;

use super::works;

/// A field that is called.
#[derive(Clone)]
pub struct Magnet;

impl force::Force<2> for Magnet {
    type Form = force::Translation;
    const GYROSCOPIC: bool = true;
    fn force<T: Scalar>(&self, motion: &force::Motion<2, T>) -> Vector<2, T> {
        Vector::<2, T>::new(motion.x_dot[1], -motion.x_dot[0])
    }
}

/// With the models of the module of this name in scope: they work, and have their capabilities.
macro_rules! all_work {
    ($models:path) => {{
        use $models as models;
        let isotropic = models::Isotropic { kappa: 10.0, c1: 0.5 }.prepare().unwrap();
        works(&isotropic);
        emits_pieces(&isotropic);
        let flat = models::Flat { m: 2.0, kappa: 0.5 }.prepare().unwrap();
        works(&flat);
        emits_halves(&flat);
        works(&models::Stretched { c: 0.5 }.prepare().unwrap());
        works(&models::Stated { f64: 0.7, core: 0.1 }.prepare().unwrap());
        works(&models::Damped { std: 0.1, Some: Magnet }.prepare().unwrap());
        works(&models::Tensor);
        works(&models::Skewed { x: 0.4, t: 0.5, phi: 0.3, q: 1 }.prepare().unwrap());
        lattice(&models::Circle);
        named(&models::Isochoric, "Isochoric");
        named(&models::Rigid, "Rigid");
    }};
}

fn emits_pieces<const N: usize, M>(_: &M)
where
    M: Taylor<N> + Splitting<N> + Tangent<N> + InLanes<N> + TwoPolarForm<N> + LatticePieces<N>,
{
}

fn emits_halves<const N: usize, M: SecondOrderEquations<N> + Tangent<N> + InLanes<N>>(_: &M) {}

fn lattice<const N: usize>(model: &impl LatticePieces<N>) {
    assert!(!model_pieces(model).is_empty());
}

fn model_pieces<const N: usize, M: LatticePieces<N>>(_: &M) -> &'static [&'static str] {
    M::PIECES
}

fn named<const N: usize, M: affine_runtime::model::Model<N>>(_: &M, name: &str) {
    assert_eq!(M::DESCRIPTION.name, name);
}

/// Names of types, modules, functions, traits and macros that emitted code could mean.
pub mod shadowed {
    pub mod core {}
    pub mod std {}
    pub mod alloc {}
    pub mod affine_runtime {}
    pub mod rt {}
    pub mod nalgebra {}
    pub struct f64;
    pub struct usize;
    pub struct bool;
    pub struct str;
    pub struct Option;
    pub struct Result;
    pub struct Vec;
    pub struct Box;
    pub struct String;
    pub struct PhantomData;
    pub struct T;
    pub fn Some() {}
    pub fn None() {}
    pub fn Ok() {}
    pub fn Err() {}
    pub fn drop() {}
    pub trait Clone {}
    pub trait Copy {}
    pub trait Sized {}
    pub trait Into {}
    pub trait Default {}
    pub trait Fn {}
    pub trait Iterator {}
    /// Methods that could be meant instead of those of the runtime.
    pub trait Meddling {
        fn clone(&self) {}
        fn map(&self) {}
        fn sqrt(&self) {}
        fn exp(&self) {}
        fn constant(&self) {}
        fn zeros(&self) {}
        fn hamiltonian(&self) {}
    }
    impl<S> Meddling for S {}
    #[allow(unused_macros)]
    macro_rules! vec {
        () => {};
    }
    #[allow(unused_macros)]
    macro_rules! concat {
        () => {};
    }
    ::core::include!("models.in");
}

/// Not even `Some` is in scope.
pub mod without_prelude {
    #![no_implicit_prelude]
    ::core::include!("models.in");
}

/// What the compiler finds amiss is an error.
pub mod denied {
    #![deny(
        warnings,
        missing_docs,
        missing_debug_implementations,
        unused,
        nonstandard_style,
        rust_2018_idioms,
        let_underscore,
        unused_qualifications,
        single_use_lifetimes,
        trivial_casts,
        trivial_numeric_casts,
        unsafe_code
    )]
    #![allow(
        missing_debug_implementations,
        unreachable_pub,
        reason = "of the models, which say what they want"
    )]
    ::core::include!("models.in");
}

#[test]
fn with_every_capability() {
    all_work!(super::capable::shadowed);
    all_work!(super::capable::without_prelude);
    all_work!(super::capable::denied);
}
