//! Mechanics of affinely-rigid bodies: energies in; equations of motion, conserved quantities and checked motions out.
//!
//! An affinely-rigid body deforms homogeneously. It has the placement `x, phi` with `phi` in GL+(n), n = 2 or 3: the body
//! point `a` is at `x + phi a`. The attribute [`affine_model`] turns energies into a [`Model`]. A [`Simulation`] runs it to an
//! end, and a [`Flow`] steps it in a loop of your own.
//!
//! ```
//! use affine_runtime::prelude::*;
//!
//! /// A soft ball, thrown: elastic energy and gravity.
//! #[affine_model(
//!     dim = 3,
//!     kinetic(dalembert = 0.2, space_translation = 1),
//!     potential = neo_hookean(2) + 5*(det - 1)^2 + 9.81*x[3],
//! )]
//! struct Ball;
//!
//! let start = Ball.at_velocity(
//!     Vector::<3>::zeros(),                                  // x
//!     Matrix::<3>::identity(),                               // phi
//!     Vector::<3>::new(1.0, 0.0, 5.0),                       // x_dot
//!     Matrix::<3>::new(0.0, -2.0, 0.0, 2.0, 0.3, 0.0, 0.0, 0.0, 0.0), // phi_dot
//! )?;
//! let run = Simulation::new(&Ball, start).until(1.0).run()?;
//! println!("{}", run.conservation()); // drift of everything that Ball conserves
//! println!("{}", run.why()); // which method ran, and why
//! let (_, end) = run.end();
//! assert!((end.x()[2] - (5.0 - 9.81 / 2.0)).abs() < 1e-8);
//! println!("strain {}", end.lagrange_strain().0.0);
//! # Ok::<(), affine_runtime::Error>(())
//! ```
//!
//! # Where to read on
//!
//! | you want | page |
//! |---|---|
//! | to begin | [`guide::first_run`] |
//! | to see a motion, and what was seen | [`guide::pictures`], [`guide::gallery`] |
//! | the model of a paper | [`guide::models`] |
//! | every key of the attribute | [`affine_model`] |
//! | energies, potentials, constraints, forces | [`guide::energies`], [`guide::potentials`], [`guide::constraints`], [`guide::forces`] |
//! | to run it | [`Simulation`], [`guide::events`], [`guide::long_runs`], [`guide::methods`] |
//! | many bodies, frame loops | [`guide::ensembles`], [`guide::frame_loops`] |
//! | to know whether to believe it | [`guide::reading`] |
//! | to find out what is wrong | [`guide::mistakes`] |
//! | where it rests and turns, and whether that is stable | [`guide::analysis`] |
//! | the equations in another tool | [`guide::elsewhere`] |
//! | stretches as a lattice | [`guide::lattice`] |
//!
//! | module | holds |
//! |---|---|
//! | [`prelude`] | what a scene needs |
//! | [`frames`], [`kinematics`], [`state`] | quantities that know where they live, and phase points |
//! | [`model`], [`capability`] | what the attribute emits, as traits |
//! | [`simulate`] | runs, events, flows, ensembles |
//! | [`inertia`], [`material`] | inertias of shapes; material points, and moments about any point |
//! | [`force`], [`potential`] | forces and potentials of your own |
//! | [`analysis`] | Jacobians, equilibria, stability, branches |
//! | [`decompose`], [`lattice`] | functions of matrices, polar and two-polar form of placements |
//! | [`variation`], [`dual`], [`parametric`] | derivatives |
//! | [`bracket`] | Poisson brackets of functions of a point |
//! | [`elliptic`] | the integrals that self-gravity consists of |
//!
//! # Names
//!
//! ```text
//! Omega     = phi_dot phi^-1     Sigma     = phi Pi = (dT/dOmega)^T        spatial
//! Omega_hat = phi^-1 phi_dot     Sigma_hat = Pi phi = (dT/dOmega_hat)^T    co-moving
//!                                Pi        = (dT/dphi_dot)^T               conjugate to phi
//! ```
//!
//! Space and body carry the identity metric, or that of `metrics(...)`, of which a phase point is read in orthonormal bases,
//! [`Model::orthonormal`]; there `^T` is the plain transpose. Spatial, co-moving and two-point
//! quantities, velocities and momenta are different types (see [`frames`] and [`kinematics`]): a formula that
//! mixes them does not compile. Equation numbers are those of Slawianowski et al., *Affine symmetry in mechanics
//! of collective and internal modes, Part I*; where that differs, [`guide::errata`] says so.
//!
//! # Features
//!
//! | feature | gives |
//! |---|---|
//! | `macros` (default) | the attribute |
//! | `std` (default) | [`simulate`]; without it models and conversions, without allocation |
//! | `csv` (default) | tables of trajectories |
//! | `report` | pictures, pages on which the body moves, error against run time |
//! | `gltf` | [`gltf`]: motions for viewers and modellers |
//! | `analysis` | [`analysis`]: Jacobians, equilibria, stability, branches |
//! | `parallel` | ensembles on all processors |
//! | `progress` | a bar that shows how many bodies of an ensemble are done |
//! | `rand` | starts of ensembles that are drawn, `starts` |
//! | `serde` | points, runs, bodies, stops, tables, checkpoints and descriptions that can be written and read |
//! | `approx` | points that `assert_relative_eq!` compares |
//! | `npy`, `parquet` | tables as archives of NumPy arrays, or as Parquet |
//! | `double-double` | numbers of 31 digits |
#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(feature = "analysis")]
pub mod analysis;
pub mod bracket;
#[cfg(feature = "std")]
pub mod counting;
pub mod decompose;
pub mod dual;
pub mod elliptic;
pub mod force;
#[cfg(feature = "gltf")]
pub mod gltf;
pub mod inertia;
pub mod lattice;
pub mod material;
#[cfg(feature = "std")]
mod numbers;
pub mod potential;
mod private;
#[cfg(feature = "report")]
pub mod report;
pub mod sampling;
pub mod signature;
#[cfg(feature = "std")]
pub mod simulate;
#[cfg(feature = "rand")]
pub mod starts;
#[cfg(feature = "analysis")]
mod tape;
pub mod variation;
#[cfg(all(feature = "std", not(feature = "report")))]
mod without_report;

pub use affine_core::{
    balance, conserved, error, frames, geodesic, kinematics, metrics, model, parametric, scalar, state,
};
pub(crate) use affine_integrators as integrate;
/// Numbers that are several, side by side: bodies of an ensemble in the vectors of a processor.
pub mod lanes {
    pub use affine_integrators::lanes::{F64x8, FastF64x8, Lanes};
}

/// What a model has beyond the default, by `emit(...)`, and how code that serves every model finds it.
pub mod capability {
    pub use crate::variation::Tangent;
    pub use affine_core::capability::{InLanes, SecondOrderEquations, Splitting, Taylor};
}

/// What of the other crates is for this one alone.
mod inner {
    pub(crate) use affine_core::__private::far_from_undeformed;
    pub(crate) use affine_core::__private::numerics::*;
    pub(crate) use affine_core::__private::projected;
    #[cfg(feature = "std")]
    pub(crate) use affine_core::__private::{Unconstrained, gathered, on_the_group};
    #[cfg(feature = "std")]
    pub(crate) use affine_core::system::Sum;
    pub(crate) use affine_integrators::__private::accumulate;
    pub(crate) use affine_integrators::__private::runs::*;
}

/// What emitted code uses besides the public traits. No stable interface: it changes with the macro.
#[doc(hidden)]
pub mod __private {
    pub use crate::private::*;
}

/// Matrices and vectors, of the version whose types are in what this crate takes and gives.
pub use nalgebra;

pub use error::{Error, Result};
pub use model::Model;
#[cfg(feature = "std")]
pub use simulate::{Ensemble, Flow, Flows, Method, Simulation, Trajectory};

#[cfg(feature = "macros")]
pub use affine_macros::affine_model;

/// What a scene needs.
pub mod prelude {
    pub use crate::decompose::LinearMap;
    pub use crate::frames::{AffineSpin, AffineVelocity, Comoving, Matrix, Spatial, TwoPoint, Vector};
    pub use crate::kinematics::Kinematics;
    pub use crate::model::Model;
    pub use crate::state::Phase;

    #[cfg(feature = "std")]
    pub use crate::simulate::{Ensemble, Event, Flow, Flows, Method, Simulation, Trajectory};

    #[cfg(feature = "macros")]
    pub use crate::affine_model;
}

/// Pages of the guide: a module of each text in `docs/`. A page names another one in brackets alone, `[energies]`, and items
/// likewise where their paths stand here.
#[cfg(all(doc, feature = "macros", feature = "std"))]
macro_rules! pages {
    ($($page:ident)*) => { $(
        #[doc = include_str!(concat!("../docs/", stringify!($page), ".md"))]
        ///
        /// [`Dual`]: crate::dual::Dual
        /// [`elliptic`]: crate::elliptic
        /// [`Ensemble`]: crate::simulate::Ensemble
        /// [`poisson_bracket`]: crate::bracket::poisson_bracket
        /// [`Event`]: crate::simulate::Event
        /// [`Flow`]: crate::simulate::Flow
        /// [`Flows`]: crate::simulate::Flows
        /// [`Member`]: crate::simulate::Member
        /// [`Method::Rattle`]: crate::simulate::Method::Rattle
        /// [`Generator`]: crate::analysis::Generator
        /// [`inertia`]: crate::inertia
        /// [`MassDistribution::from_rotational`]: crate::inertia::MassDistribution::from_rotational
        /// [`Table`]: crate::simulate::Table
        /// [`Trajectory`]: crate::simulate::Trajectory
        /// [`Variation`]: crate::variation::Variation
        pub mod $page {}
    )* };
}

/// The page of pictures: of each example its text and its picture, which stand in `docs/gallery/` under its name.
#[cfg(all(doc, feature = "macros", feature = "std"))]
macro_rules! gallery {
    ($($example:ident)*) => {
        #[doc = include_str!("../docs/gallery.md")]
        $(
            #[doc = ""]
            #[doc = include_str!(concat!("../docs/gallery/", stringify!($example), ".md"))]
            // Wider than a phone, where it can be moved.
            #[doc = "\n<div style=\"overflow-x: auto\">"]
            #[doc = include_str!(concat!("../docs/gallery/", stringify!($example), ".svg"))]
            #[doc = "</div>\n"]
        )*
        pub mod gallery {}
    };
}

/// Pages to read, one a subject; [`first_run`](guide::first_run) is where to begin.
///
/// | page | for |
/// |---|---|
/// | [`first_run`](guide::first_run) | a body that falls, line by line |
/// | [`models`](guide::models) | which model is mine: from papers to attributes |
/// | [`energies`](guide::energies) | kinetic energies, frames, Hamiltonians, metrics |
/// | [`potentials`](guide::potentials) | elastic energies, gravity, time |
/// | [`constraints`](guide::constraints) | rigid, incompressible and conformal bodies |
/// | [`forces`](guide::forces) | friction, and forces and potentials of your own |
/// | [`events`](guide::events) | events, output, runs that stop early |
/// | [`long_runs`](guide::long_runs) | which method, which step, which tolerance |
/// | [`bits`](guide::bits) | which runs have the same bits |
/// | [`methods`](guide::methods) | what each method keeps |
/// | [`ensembles`](guide::ensembles) | many starts, many parameters |
/// | [`frame_loops`](guide::frame_loops) | bodies that your own loop steps |
/// | [`reading`](guide::reading) | what `why()` and `conservation()` say |
/// | [`lattice`](guide::lattice) | stretches and the two-polar form |
/// | [`mistakes`](guide::mistakes) | what goes wrong most often |
/// | [`analysis`](guide::analysis) | equilibria, stability, branches |
/// | [`elsewhere`](guide::elsewhere) | the equations in other tools, Jacobians |
/// | [`pictures`](guide::pictures) | pictures, pages that move, and files for viewers |
/// | [`errata`](guide::errata) | where this crate and the paper differ |
/// | [`gallery`](guide::gallery) | the examples, with pictures |
#[cfg(all(doc, feature = "macros", feature = "std"))]
pub mod guide {
    pages! {
        first_run models energies potentials constraints forces events long_runs bits methods ensembles frame_loops reading lattice
        mistakes errata
    }
    gallery! {
        drunk_missile planar_geodesics phase_portrait sutherland vibrating_body section sweep statistics falling_bodies
        ellipsoids gas_cloud work_precision
    }
    // Their programs need these features.
    #[cfg(any(not(doctest), all(feature = "gltf", feature = "report")))]
    pages! {
        pictures
    }
    #[cfg(any(not(doctest), feature = "analysis"))]
    pages! {
        analysis elsewhere
    }
}

/// The examples of the README, compiled.
#[cfg(all(doctest, feature = "macros", feature = "std"))]
#[doc = include_str!("../README.md")]
mod readme {}
