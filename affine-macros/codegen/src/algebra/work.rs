//! How much is multiplied out: what the time of an expansion grows with, counted where a clock would scatter.

use std::cell::Cell;

thread_local! {
    static PRODUCTS: Cell<u64> = const { Cell::new(0) };
}

/// Counts products of terms.
pub(super) fn add(products: usize) {
    PRODUCTS.set(PRODUCTS.get() + products as u64);
}

/// Products of terms of polynomials that this thread has formed so far.
pub fn products() -> u64 {
    PRODUCTS.get()
}
