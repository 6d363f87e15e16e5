//! Multiply-adds: a product that is read once, by a sum, joins it.

use super::{Op, Program, Value};

/// Fuses products into the sums that alone read them.
pub fn fuse(program: &Program) -> Program {
    let uses = program.uses();
    let named: Vec<Value> = program.names.iter().map(|(v, _)| *v).collect();
    let product = |v: Value| match program.steps[v] {
        Op::Mul(a, b) if uses[v] == 1 && !named.contains(&v) => Some((a, b)),
        _ => None,
    };
    let mut result = Program::default();
    let mut place = vec![0; program.steps.len()];
    for (k, step) in program.steps.iter().enumerate() {
        let fused = match *step {
            // A chain grows at its end: the right operand of a sum is the newer product.
            Op::Add(a, b) => {
                product(b).map(|p| (p, a, false, false)).or_else(|| product(a).map(|p| (p, b, false, false)))
            }
            Op::Sub(a, b) => {
                product(b).map(|p| (p, a, true, false)).or_else(|| product(a).map(|p| (p, b, false, true)))
            }
            _ => None,
        };
        place[k] = match fused {
            None => push(&mut result, step.renumbered(&place)),
            Some(((x, y), term, negative_product, negative_term)) => {
                let (mut x, y, mut term) = (place[x], place[y], place[term]);
                if negative_product {
                    x = push(&mut result, Op::Neg(x));
                }
                if negative_term {
                    term = push(&mut result, Op::Neg(term));
                }
                push(&mut result, Op::MulAdd(x, y, term))
            }
        };
    }
    result.ending_as(program, &place)
}

fn push(program: &mut Program, op: Op) -> Value {
    program.steps.push(op);
    program.steps.len() - 1
}
