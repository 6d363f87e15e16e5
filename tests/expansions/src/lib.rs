//! The reviewed expansions of `tests/snapshots`, compiled as ordinary code without the standard library: no lint
//! of the compiler, of the workspace or of clippy has anything to say.
#![no_std]
#![deny(warnings)]

// What the snapshot of `crate = crate::renamed::runtime` reads.
mod renamed {
    pub(crate) use affine_runtime as runtime;
}

include!(concat!(env!("OUT_DIR"), "/expansions.rs"));
