//! Hostile surroundings: names chosen to collide with those of emitted code.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(missing_docs, unreachable_pub, non_camel_case_types, non_snake_case, dead_code)]

use affine_runtime::model::{Model, StateVector};
use affine_runtime::state::Phase;

#[path = "hygiene/capable.rs"]
mod capable;

/// The emitted pieces agree with each other: `H - U = T` along `point -> velocity`, and `reduce` then `expand` gives
/// the point back.
fn works<const N: usize, M: Model<N>>(model: &M) {
    let mut full = M::Full::<f64>::zeros();
    for (k, value) in full.as_mut().iter_mut().enumerate() {
        // Arbitrary, but for the placement, whose diagonal dominates.
        *value = 0.1 + 0.07 * ((k * k + 3 * k) % 11) as f64;
    }
    let skip = usize::from(M::DESCRIPTION.full[0].name() == "x") * N;
    (0..N).for_each(|k| full.as_mut()[skip + k * (N + 1)] = 2.0);
    let point = model.unflatten(&full);
    let mut resting = full;
    resting.as_mut()[skip + N * N..].fill(0.0);
    let energy = model.hamiltonian(0.0, &point) - model.hamiltonian(0.0, &model.unflatten(&resting));
    let difference = energy - model.kinetic_energy(point.phi(), &model.velocity(&point));
    // A few hundred roundings of terms of the size of the energy.
    assert!(difference.abs() < 1e-13 * energy.abs().max(1.0), "{}: {difference}", M::DESCRIPTION.name);
    let (reduced, constants) = model.reduce(0.0, &point);
    let back = model.flatten(&model.expand(0.0, &constants, &reduced));
    for (a, b) in back.as_ref().iter().zip(full.as_ref()) {
        assert!((a - b).abs() < 1e-13, "{}: {a} {b}", M::DESCRIPTION.name);
    }
}

/// Structs named like the names that emitted code introduces or mentions.
mod names {
    macro_rules! units {
        ($($name:ident)*) => {
            $(
                #[affine_runtime::affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, body_translation = 2))]
                pub struct $name;
            )*
            pub fn work() {
                $(super::works(&$name);)*
            }
        };
    }
    units! {
        T T_ rt rt_ Constants Option Some None Vec Matrix Vector Centre Model Result Ok Err Phase PhasePoint Real
        Scalar Body Space Comoving Spatial Momentum Clone Copy Debug PartialEq PhantomData Description Formula
        Geodesic Motion Conserved Prepared Reduced Full Point Box String
    }
}

/// The same with coefficients from fields, named like local variables of emitted code.
mod fields {
    macro_rules! structs {
        ($($name:ident)*) => {
            $(
                #[affine_runtime::affine_model(
                    dim = 3,
                    kinetic(
                        casimir2 = x_1 + phi_11 + c_1, casimir1_squared = k_1 + t1 + r1_2,
                        body_inertia = self_ + one + T, body_translation = m + zero + value_1
                    )
                )]
                pub struct $name {
                    pub x_1: f64, pub phi_11: f64, pub c_1: f64, pub k_1: f64, pub t1: f64, pub r1_2: f64,
                    pub self_: f64, pub one: f64, pub T: f64, pub m: f64, pub zero: f64, pub value_1: f64,
                }
            )*
            pub fn work() {
                $(super::works(&$name {
                    x_1: 0.1, phi_11: 0.1, c_1: 0.1, k_1: 0.1, t1: 0.1, r1_2: 0.1, self_: 0.5, one: 0.5, T: 0.5,
                    m: 0.5, zero: 0.5, value_1: 0.5,
                }.prepare().unwrap());)*
            }
        };
    }
    structs! { T rt Constants Option Result Ok Model coefficients }
}

/// Raw identifiers.
mod raw {
    #[affine_runtime::affine_model(dim = 2, kinetic(casimir2 = r#type, body_inertia = 2*r#fn))]
    pub struct r#struct {
        pub r#type: f64,
        pub r#fn: f64,
    }

    pub fn work() {
        super::works(&r#struct { r#type: 0.2, r#fn: 0.5 }.prepare().unwrap());
    }
}

/// Modules, types, functions, traits and macros that shadow what emitted code needs.
mod shadows {
    pub mod core {}
    pub mod std {}
    pub mod affine_runtime {}
    pub mod rt {}
    pub struct usize;
    pub struct f64;
    pub struct Option;
    pub fn Some() {}
    pub fn Ok() {}
    pub trait Clone {}
    pub trait Scalar {
        fn constant(_: u8) -> u8;
        fn fma(self) -> u8;
    }
    impl<S> Scalar for S {
        fn constant(_: u8) -> u8 {
            0
        }
        fn fma(self) -> u8 {
            0
        }
    }
    #[allow(unused_macros)]
    macro_rules! vec {
        () => {};
    }

    #[::affine_runtime::affine_model(
        dim = 3,
        kinetic(casimir2 = 0.2, body_inertia = 1, space_translation = 3)
    )]
    pub struct Literal;

    #[::affine_runtime::affine_model(dim = 2, kinetic(casimir2 = a, space_inertia = 1, body_translation = a))]
    pub struct Fields {
        pub a: ::core::primitive::f64,
    }

    pub fn work() {
        super::works(&Literal);
        super::works(&Fields { a: 0.3 }.prepare().unwrap());
    }
}

/// No prelude: not even `Some` is in scope.
mod without_prelude {
    #![no_implicit_prelude]

    #[::affine_runtime::affine_model(dim = 3, kinetic(dalembert = [[a, 1, 0], [1, a, 0], [0, 0, 1]]))]
    pub struct Fields {
        pub a: f64,
    }

    #[::affine_runtime::affine_model(
        dim = 3,
        kinetic(casimir2 = 0.2, space_inertia = 1, space_translation = 1)
    )]
    pub struct Literal;

    pub fn work() {
        super::works(&Fields { a: 2.0 }.prepare().unwrap());
        super::works(&Literal);
    }
}

/// Generics named like emitted type parameters, with bounds, defaults and lifetimes.
mod generics {
    use affine_runtime::affine_model;

    #[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1))]
    pub struct Tagged<'t, T, const N: usize = 2, rt = u8>
    where
        T: Copy + 't,
    {
        pub tag: [&'t T; N],
        pub other: rt,
    }

    #[affine_model(dim = 2, kinetic(casimir2 = a, body_inertia = 1))]
    #[derive(Clone, Debug)]
    pub struct Parameters<T: Clone, T_> {
        pub a: f64,
        pub history: Vec<(T, T_)>,
    }

    pub fn work() {
        super::works(&Tagged { tag: [&1u8, &2], other: 3u8 });
        super::works(&Parameters { a: 0.2, history: vec![("a", 1.0)] }.prepare().unwrap());
    }
}

/// A specification whose every part is a fragment of a macro, wrapped in an invisible group.
mod fragments {
    macro_rules! model {
        ($visibility:vis $name:ident, $n:literal, $a:expr, $term:ident = $b:expr, $claim:ident, $ty:ty, $runtime:path) => {
            #[affine_runtime::affine_model(
                dim = $n,
                symmetry(space = $claim),
                kinetic(casimir2 = $a, $term = $b, casimir1_squared = 0),
                crate = $runtime
            )]
            $visibility struct $name {
                $visibility a: $ty,
            }
        };
    }
    model!(pub(crate) Fragments, 3, a + 1/5, body_inertia = 2 * (a - 1), affine, f64, ::affine_runtime);

    pub fn work() {
        super::works(&Fragments { a: 2.0 }.prepare().unwrap());
    }
}

/// Structs that a macro of the user writes, of which nothing is called: what lints say of its items they do not say of emitted ones.
#[deny(dead_code)]
mod silent {
    macro_rules! models {
        ($n:literal $unit:ident $fields:ident) => {
            #[affine_runtime::affine_model(dim = $n, kinetic(dalembert = 1, space_translation = 1), emit(metric, balance))]
            pub struct $unit;

            #[affine_runtime::affine_model(dim = $n, kinetic(body_inertia = a))]
            pub struct $fields {
                pub a: f64,
            }
        };
    }
    models! { 2 Unit Fields }
    models! { 3 UnitInSpace FieldsInSpace }
}

/// Lints that the user allows of a struct, or that ask nobody to use it.
#[deny(deprecated, non_camel_case_types)]
mod allowed {
    #[affine_runtime::affine_model(dim = 2, kinetic(body_inertia = a))]
    #[allow(non_camel_case_types)]
    pub struct small_letters {
        pub a: f64,
    }

    #[affine_runtime::affine_model(dim = 2, kinetic(body_inertia = a), emit(lanes))]
    #[deprecated]
    pub struct Old {
        pub a: f64,
    }

    #[affine_runtime::affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1))]
    #[deprecated]
    pub struct OldUnit;
}

/// The runtime under another name.
mod renamed {
    mod inner {
        pub use affine_runtime as runtime;
    }
    use inner::runtime;

    #[runtime::affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = a), crate = self::inner::runtime)]
    struct Private {
        a: f64,
    }

    #[runtime::affine_model(dim = 2, kinetic(casimir2 = 0.2), crate = runtime)]
    pub(super) struct Imported;

    pub fn work() {
        super::works(&Private { a: 1.0 }.prepare().unwrap());
        super::works(&Imported);
    }
}

#[test]
fn hostile_surroundings() {
    names::work();
    fields::work();
    raw::work();
    shadows::work();
    without_prelude::work();
    generics::work();
    fragments::work();
    renamed::work();
}

/// Items in a function, which no path reaches, under generics that they may not use.
fn inside_a_function<T: Copy>(_: T) {
    use affine_runtime::affine_model;

    #[affine_model(dim = 2, kinetic(casimir2 = a, space_inertia = 1, space_translation = 1))]
    struct Local {
        a: f64,
    }

    #[affine_model(dim = 3, kinetic(casimir2 = 0.2))]
    struct LocalUnit;

    works(&Local { a: 0.2 }.prepare().unwrap());
    works(&LocalUnit);
}

#[test]
fn function_bodies() {
    inside_a_function(1);
}

/// Nothing depends on addresses, hash seeds or time.
#[test]
fn deterministic_tokens() {
    let specs = [
        "dim = 3, kinetic(casimir2 = a, casimir1_squared = b, body_inertia = i, body_translation = m)",
        "dim = 3, kinetic(dalembert = [[a, b, 0], [b, i, 0], [0, 0, m]], body_translation = m)",
        "dim = 2, kinetic(casimir2 = a, space_tensor = [[2, 1, 0, 1], [1, 3, 1, 0], [0, 1, 5, 1], [1, 0, 1, 4]])",
        "dim = 2, kinetic(casimir2 = a - a, body_translation = c)",
    ];
    let item = "pub struct Model { a: f64, b: f64, i: f64, m: f64 }";
    let expansion =
        |spec: &str| affine_codegen::expand(spec.parse().unwrap(), item.parse().unwrap()).to_string();
    for spec in specs {
        let first = expansion(spec);
        assert!((0..4).all(|_| expansion(spec) == first), "{spec}");
    }
}
