//! Steps on SL(n), SO(n) and R+ SO(n): the charts, orders, what stays on the group, the free top.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod chart;
mod curve;
mod drift;
mod jacobi;
mod order;
mod top;
