//! What is compiled for wide vectors calls nothing that is compiled for others: a right-hand side, stage sums or a norm that the
//! compiler did not inline would be there in narrow vectors, and several times as slow.
//!
//! In release builds for Linux on x86-64, whose calls are told here: `cargo test --release -p affine-inlined`.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeMap;
use std::fs;

use object::{Object, ObjectSection, ObjectSymbol, Relocation, RelocationFlags, RelocationTarget, elf};

/// What may be called from anywhere, by beginnings of names.
const RARELY: [&str; 16] = [
    // Faults that cannot happen, and moves of numbers.
    "core::panicking::",
    "core::slice::index::",
    "memcpy",
    "memmove",
    "memset",
    // Where numbers, or their squares, leave the range that they are usually in.
    "affine_core::norm::scaled_norm",
    "affine_core::scalar::inverse_cbrt::of_any",
    "affine_integrators::error_norm::in_lanes::scaled",
    "affine_integrators::error_norm::in_lanes::measure_again",
    "affine_integrators::runge_kutta::judged::scaled_error",
    "affine_integrators::taylor::TaylorSteps<S,C,R>::is_in_range::{{closure}}",
    "affine_integrators::taylor::TaylorSteps<S,C,R>::takes_a_unit",
    // Where a series may have gaps, or lacks orders.
    "affine_integrators::taylor::TaylorSteps<S,C,R>::proved",
    "affine_integrators::taylor::TaylorSteps<S,C,R>::of_lower_order",
    "libm::math::exp::exp",
    "libm::math::log::log",
];

/// What may be called from one place of a function. The stages of a step are written out, so that a right-hand side which is not
/// inlined is called from a dozen.
const ONCE: [&str; 10] = [
    // The choice of the next step.
    "affine_integrators::step_size::Controller::accept",
    "affine_integrators::step_size::Controller::reject",
    // The error of a step.
    "<affine_integrators::runge_kutta::pair::",
    "<affine_integrators::nystrom::NystromSteps<S,C,R> as affine_integrators::drive::Attempt>::attempt::{{closure}}",
    "affine_integrators::error_norm::ErrorNorm::range",
    "affine_integrators::error_norm::ErrorNorm::new",
    "affine_integrators::error_norm::ErrorNorm::moved_by",
    // One evaluation among those of a step in single numbers.
    "affine_runtime::simulate::by_equations::reduced::{{closure}}::{{closure}}",
    // What the last terms of a series say of a step.
    "affine_integrators::taylor::gaps::are_irregular",
    // The length of the first step of a run in lanes.
    "affine_integrators::runge_kutta::start::in_lanes::Beginning<T,S,F,R>::first_step::{{closure}}",
];

/// A function: where it begins and ends, and its name without hashes.
struct Function(core::ops::Range<u64>, String);

/// Of a program, those with a length.
fn functions(file: &object::File) -> Vec<Function> {
    let functions = file.symbols().filter(|symbol| symbol.is_definition() && symbol.size() > 0);
    let function = |symbol: object::Symbol| {
        let range = symbol.address()..symbol.address() + symbol.size();
        Function(range, name(symbol.name().unwrap()))
    };
    functions.map(function).collect()
}

fn name(symbol: &str) -> String {
    format!("{:#}", rustc_demangle::demangle(symbol))
}

/// What a call leads to; `None` where the place is no call.
fn called(file: &object::File, functions: &[Function], relocation: &Relocation) -> Option<String> {
    let calls = [elf::R_X86_64_PLT32, elf::R_X86_64_GOTPCREL, elf::R_X86_64_GOTPCRELX];
    let RelocationFlags::Elf { r_type } = relocation.flags() else { return None };
    let RelocationTarget::Symbol(index) = relocation.target() else { return None };
    if !calls.contains(&r_type) {
        return None;
    }
    let symbol = file.symbol_by_index(index).unwrap();
    if let Some(name) = symbol.name().ok().filter(|name| !name.is_empty()).map(name) {
        return Some(name);
    }
    // A section with a place in it, from the end of the four bytes that hold the distance.
    let place = symbol.address().wrapping_add_signed(relocation.addend() + 4);
    let function = functions.iter().find(|Function(range, _)| range.contains(&place));
    Some(function.map_or(String::from("?"), |Function(_, name)| name.clone()))
}

#[test]
#[cfg_attr(debug_assertions, ignore = "nothing is inlined without optimisation")]
fn nothing_is_called_that_is_not_inlined() {
    let bytes = fs::read(env!("CARGO_BIN_EXE_steps")).unwrap();
    let file = object::File::parse(&*bytes).unwrap();
    let functions = functions(&file);
    let is_wide = |name: &str| name.starts_with("pulp::x86::") && name.contains("::vectorize::");
    let wide: Vec<&Function> = functions.iter().filter(|Function(_, name)| is_wide(name)).collect();
    // Steps by four methods, and what is beside them, in two copies each.
    assert!(wide.len() >= 16, "{} functions in wide vectors", wide.len());
    let mut calls = BTreeMap::<(u64, String), usize>::new();
    for (place, relocation) in file.sections().flat_map(|section| section.relocations()) {
        let Some(Function(range, _)) = wide.iter().find(|Function(range, _)| range.contains(&place)) else {
            continue;
        };
        if let Some(target) = called(&file, &functions, &relocation) {
            *calls.entry((range.start, target)).or_default() += 1;
        }
    }
    assert!(calls.len() > wide.len(), "the linker kept the places of {} calls", calls.len());
    let is_one_of = |names: &[&str], target: &str| names.iter().any(|name| target.starts_with(name));
    let is_allowed =
        |target: &str, count| is_one_of(&RARELY, target) || count == 1 && is_one_of(&ONCE, target);
    calls.retain(|(_, target), count| !is_allowed(target, *count));
    assert!(calls.is_empty(), "called, and not inlined: {calls:#?}");
}
