//! Execution of right-hand sides in vectors of four, in any field.

use affine_codegen::algebra::Rational;
use affine_codegen::algebra::evaluate::Field;
use affine_codegen::ir::packed::{Four, Lane, Packed, Step};
use affine_codegen::ir::{Op, Program, Value};
use affine_codegen::symbol::{Quantity, Symbol};

/// The rates of the components, in their order; `None` where an input has no value, or a lane that is read none.
pub(super) fn run<F: Field>(packed: &Packed, input: &impl Fn(&Symbol) -> Option<F>) -> Option<Vec<F>> {
    let mut run = Run { packed, scalars: vec![None; packed.program.steps.len()], vectors: Vec::new() };
    run.vectors = vec![[const { None }; 4]; packed.vectors.len()];
    for (value, op) in packed.program.steps.iter().enumerate() {
        if let Op::Input(symbol) = op {
            run.scalars[value] = input(symbol);
        }
    }
    for step in &packed.steps {
        match *step {
            Step::Scalar(value) => run.scalars[value] = Some(run.scalar(value)?),
            Step::Vector(index) => run.vectors[index] = run.vector(packed.vectors[index].made)?,
        }
    }
    let rate = |component: usize| {
        let lane = |vector: &[Option<usize>; 4]| vector.iter().position(|own| *own == Some(component));
        let mut places = packed.state.iter().zip(&packed.rates);
        places.find_map(|(vector, rate)| run.vectors[*rate][lane(vector)?].clone())
    };
    (0..packed.program.outputs.len()).map(rate).collect()
}

struct Run<'p, F> {
    packed: &'p Packed,
    scalars: Vec<Option<F>>,
    vectors: Vec<[Option<F>; 4]>,
}

impl<F: Field> Run<'_, F> {
    /// A value, from its lane if it has one.
    fn value(&self, value: Value) -> Option<F> {
        match self.packed.lane(value) {
            Some((index, lane)) => self.vectors[index][lane].clone(),
            None => self.scalars[value].clone(),
        }
    }

    /// A step of the scalar program.
    fn scalar(&self, value: Value) -> Option<F> {
        let op = &self.packed.program.steps[value];
        let operands: Vec<Value> = op.operands();
        let mut steps: Vec<Op> = (0..operands.len()).map(|k| Op::Input(Quantity::Constant.at([k]))).collect();
        let mut place = vec![0; self.packed.program.steps.len()];
        operands.iter().enumerate().for_each(|(k, v)| place[*v] = k);
        steps.push(op.renumbered(&place));
        let alone =
            Program { outputs: vec![(Symbol::Step(value), operands.len())], steps, ..Program::default() };
        let input = |symbol: &Symbol| {
            let k = (0..operands.len()).find(|k| *symbol == Quantity::Constant.at([*k]))?;
            self.value(operands[k])
        };
        alone.run(&input)?.into_iter().next()
    }

    fn vector(&self, four: Four) -> Option<[Option<F>; 4]> {
        let minus = F::from_rational(&Rational::MINUS_ONE);
        let zero = minus.add(&F::from_rational(&Rational::ONE));
        let each = |of: &dyn Fn(usize) -> Option<F>| Some([of(0), of(1), of(2), of(3)]);
        let lane = |index: usize, lane: usize| self.vectors[index][lane].clone();
        match four {
            Four::State(k) => each(&|l| self.scalars[self.packed.vectors[k].lanes[l].value()?].clone()),
            Four::All(value) => each(&|_| self.value(value)),
            Four::Gathered(lanes) => each(&|l| match lanes[l] {
                Lane::Free => None,
                Lane::MinusZero => Some(zero.clone()),
                Lane::Of(value) => self.value(value),
                Lane::Minus(value) => Some(minus.mul(&self.value(value)?)),
            }),
            Four::Neg(a) => each(&|l| Some(minus.mul(&lane(a, l)?))),
            Four::Add(a, b) => each(&|l| Some(lane(a, l)?.add(&lane(b, l)?))),
            Four::Sub(a, b) => each(&|l| Some(lane(a, l)?.add(&minus.mul(&lane(b, l)?)))),
            Four::Mul(a, b) => each(&|l| Some(lane(a, l)?.mul(&lane(b, l)?))),
            Four::MulAdd(a, b, c) => each(&|l| Some(lane(a, l)?.mul(&lane(b, l)?).add(&lane(c, l)?))),
        }
    }
}
