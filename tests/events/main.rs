//! Events where they are easily missed: many of them, several at one time, and contacts.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod collapse;
mod contact;
mod corner;
mod models;
mod rest;
mod rotation;
mod zero;
