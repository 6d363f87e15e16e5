//! The expansions that `tests/snapshots` has in full, compiled as ordinary code without the standard library: no lint
//! of the compiler, of the workspace or of clippy has anything to say.
#![no_std]
#![deny(warnings)]

// What `two_polar_ratios_2` reads: `crate = crate::renamed::runtime`.
mod renamed {
    pub(crate) use affine_runtime as runtime;
}

include!(concat!(env!("OUT_DIR"), "/expansions.rs"));
