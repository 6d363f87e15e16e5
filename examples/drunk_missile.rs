//! Drunk missile.
fn main() {}
