//! Functions whose differential equation names another function of the same argument.

use crate::algebra::{Function, Rational};
use crate::ir::steps::Steps;
use crate::ir::{Op, Program, Value};

/// The function that the derivative of `function` is made of, up to sign.
pub(super) fn companion(function: Function) -> Option<Function> {
    match function {
        Function::Sin => Some(Function::Cos),
        Function::Cos => Some(Function::Sin),
        Function::Sinh => Some(Function::Cosh),
        Function::Cosh => Some(Function::Sinh),
        _ => None,
    }
}

/// The program with the companion of each function behind it: `cos u` for `sin u`, `1 + y^2` for `y = tan u`.
pub(super) fn completed(program: &Program) -> Program {
    let mut steps = Steps::default();
    let mut place: Vec<Value> = Vec::with_capacity(program.steps.len());
    for step in &program.steps {
        let step = step.renumbered(&place);
        let value = steps.step(step.clone());
        place.push(value);
        let Op::Call(function, argument) = step else { continue };
        if let Some(other) = companion(function) {
            steps.step(Op::Call(other, argument));
        } else if let Function::Tan | Function::Tanh = function {
            let one = steps.step(Op::Constant(Rational::ONE));
            let square = steps.step(Op::Mul(value, value));
            let slope = if function == Function::Tan { Op::Add(one, square) } else { Op::Sub(one, square) };
            steps.step(slope);
        }
    }
    let names = program.names.iter().map(|(v, n)| (place[*v], n.clone())).collect();
    let outputs = program.outputs.iter().map(|(n, v)| (n.clone(), place[*v])).collect();
    Program { steps: steps.list, names, outputs, ..Program::default() }
}

/// The value that the rule of `function` at `value` reads besides its argument.
pub(super) fn companion_of(program: &Program, value: Value) -> Option<Value> {
    let Op::Call(function, argument) = program.steps[value] else { return None };
    let position = |op: Op| program.steps.iter().position(|step| *step == op);
    if let Some(other) = companion(function) {
        return position(Op::Call(other, argument));
    }
    let square = position(Op::Mul(value, value))?;
    program.steps.iter().position(|step| match *step {
        Op::Add(_, b) => function == Function::Tan && b == square,
        Op::Sub(_, b) => function == Function::Tanh && b == square,
        _ => false,
    })
}
