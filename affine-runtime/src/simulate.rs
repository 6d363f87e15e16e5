//! Simulations: from a start to output times, with everything that can stop them.

mod accumulation;
mod by_equations;
mod by_radau;
mod by_rattle;
mod checkpoint;
mod choice;
mod chunks;
mod closed_form;
mod collapse;
mod conservation;
mod course;
mod csv;
mod cubic;
mod dense;
mod departure;
mod digest;
mod distortion;
mod domain;
mod energy;
mod ensemble;
mod event;
mod failed;
mod fingerprint;
mod flow;
mod flows;
mod follow;
mod format;
mod friction;
mod guard;
mod in_lanes;
mod interpolant;
mod layout;
mod mechanics;
mod method;
mod methods;
mod motion;
#[cfg(feature = "npy")]
mod npy;
mod orientation;
mod outcome;
mod output;
mod pace;
#[cfg(feature = "parquet")]
mod parquet;
mod point;
mod power_balance;
mod progress;
mod range;
mod recorder;
mod root;
mod round_trip;
mod run;
mod saved;
mod settings;
mod signature;
mod simulation;
mod standing;
mod stepped;
mod stepper;
mod stiffness;
mod table;
mod trajectory;
mod velocities;
mod watcher;
mod why;
mod witness;
#[cfg(feature = "serde")]
mod written;

pub use crate::error::{Callback, Reason, Setting, Stop};
pub use affine_integrators::{Failure, FusedArithmetic, Statistics};
pub use checkpoint::Checkpoint;
pub use conservation::{Conservation, Drift};
pub use ensemble::{Ends, Ensemble, Member};
pub use event::{Event, Occurrence};
pub use flow::Flow;
pub use flows::Flows;
pub use format::Format;
pub use method::Method;
pub use outcome::{Halt, Outcome};
pub use power_balance::PowerBalance;
pub use progress::Progress;
pub use round_trip::RoundTrip;
pub use simulation::Simulation;
pub use table::Table;
pub use trajectory::{Computation, Trajectory};
pub use why::Why;

#[cfg(feature = "report")]
pub(crate) use csv::csv_line;
#[cfg(feature = "report")]
pub(crate) use settings::DEFAULT_TOLERANCE;
