//! Reciprocals of cube roots as one function, which costs less than a root and a division.

use crate::algebra::{Function, Rational};

use super::{Op, Program, Value};

/// The program with `a r^(-1/3)` in place of `a / cbrt(r)`, where nothing else reads the root.
pub fn with_inverse_roots(program: &Program) -> Program {
    let uses = program.uses();
    let named: Vec<Value> = program.names.iter().map(|(v, _)| *v).collect();
    let radicand = |v: Value| match program.steps[v] {
        Op::Call(Function::Cbrt, a) if uses[v] == 1 && !named.contains(&v) => Some(a),
        _ => None,
    };
    let mut result = Program::default();
    let mut place = vec![0; program.steps.len()];
    for (k, step) in program.steps.iter().enumerate() {
        let inverse = match *step {
            Op::Div(a, b) => radicand(b).map(|radicand| (a, radicand)),
            _ => None,
        };
        result.steps.push(match inverse {
            None => step.renumbered(&place),
            Some((_, radicand)) => Op::Call(Function::InverseCbrt, place[radicand]),
        });
        if let Some((a, _)) = inverse
            && program.steps[a] != Op::Constant(Rational::ONE)
        {
            let root = result.steps.len() - 1;
            result.steps.push(Op::Mul(place[a], root));
        }
        place[k] = result.steps.len() - 1;
    }
    result.ending_as(program, &place)
}
