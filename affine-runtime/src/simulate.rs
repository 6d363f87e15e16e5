//! Simulations: from a start to output times, with everything that can stop them.

mod accumulation;
mod by_equations;
mod by_radau;
mod checkpoint;
mod choice;
mod closed_form;
mod collapse;
mod conservation;
mod course;
#[cfg(feature = "csv")]
mod csv;
mod dense;
mod departure;
mod domain;
mod ensemble;
mod event;
mod failed;
mod fingerprint;
mod flow;
mod follow;
mod friction;
mod guard;
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
mod point;
mod power_balance;
mod progress;
mod range;
mod recorder;
mod root;
mod round_trip;
mod run;
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

pub use crate::error::{Callback, Reason, Setting, Stop};
pub use checkpoint::Checkpoint;
pub use choice::{NYSTROM_TOLERANCE, TAYLOR_TOLERANCE};
pub use conservation::{Conservation, Drift};
pub use ensemble::{Ends, Ensemble, Member};
pub use event::{Direction, Event, Occurrence};
pub use flow::Flow;
pub use friction::STIFF_FRICTION;
pub use method::Method;
pub use outcome::{Halt, Outcome};
pub use power_balance::PowerBalance;
pub use progress::Progress;
pub use round_trip::RoundTrip;
pub use settings::{DEFAULT_MAX_STEPS, DEFAULT_TOLERANCE, NEAR_DEGENERATE};
pub use simulation::Simulation;
pub use table::Table;
pub use trajectory::{Computation, Trajectory};
pub use why::Why;

#[cfg(any(feature = "analysis", feature = "report"))]
pub(crate) use layout::has_multiplier;
