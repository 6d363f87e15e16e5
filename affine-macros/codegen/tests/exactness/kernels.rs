//! Calls of runtime functions: placed before what reads them, left out where nothing does.

use std::collections::HashMap;

use affine_codegen::algebra::bind::Constants;
use affine_codegen::algebra::kernel::{Callee, Group};
use affine_codegen::algebra::{Arena, Expr, Kernel, Polynomial, Rational};
use affine_codegen::ir::fuse::fuse;
use affine_codegen::ir::{Op, Program};
use affine_codegen::optimise::{Batch, straight_line};
use affine_codegen::symbol::{Quantity, Symbol};

use super::points::run;

/// `doubled = x + x` goes into a call, whose first result goes with `x` into `y`; the second result of the call and a
/// whole second call are not read.
fn program(arena: &mut Arena) -> Program {
    let [x, doubled, first, second, idle] =
        ["x", "doubled", "first", "second", "idle"].map(|name| arena.symbol(Symbol::Field(name.to_owned())));
    let kernel = |argument: Expr, results: Vec<Expr>| Kernel {
        callee: Callee::Stretches,
        arguments: vec![Group::Matrix(vec![vec![Polynomial::atom(argument)]])],
        results: vec![Group::Vector(results)],
    };
    let batch = Batch {
        shared: vec![(doubled, Polynomial::term(vec![x], Rational::from(2)))],
        kernels: vec![kernel(first, vec![idle]), kernel(doubled, vec![first, second])],
        results: vec![(Quantity::Value.into(), Polynomial::term(vec![x, first], Rational::ONE))],
    };
    fuse(&straight_line(arena, &batch, &mut Constants::new(Quantity::Coefficient), &|atom| atom == x))
}

#[test]
fn a_call_stands_before_what_reads_it() {
    let program = program(&mut Arena::new());
    let [call] = program.calls.as_slice() else { panic!("{:?}", program.calls) };
    let read =
        program.steps.iter().position(|step| *step == Op::Input(Symbol::Field("first".to_owned()))).unwrap();
    assert!(call.operands().iter().all(|argument| *argument < read), "{program:?}");
    let [argument] = call.operands()[..] else { panic!("{call:?}") };
    assert!(matches!(program.steps[argument], Op::Mul(..) | Op::Add(..)), "{program:?}");
}

#[test]
fn results_are_inputs() {
    let program = program(&mut Arena::new());
    let point = HashMap::from(
        [("self.x", 3), ("self.first", 5)].map(|(name, k)| (name.to_owned(), Rational::from(k))),
    );
    assert_eq!(run(&program, &point)["value"], Rational::from(15));
}
