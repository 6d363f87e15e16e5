//! Vectors from the results down.

use super::cost::{self, OF_A_SUM};
use super::vector::{Four, Index, Lane, Lanes, Vector};
use crate::ir::{Op, Program, Value};
use crate::symbol::{Quantity, Symbol};

/// Vectors that are in no order yet.
pub(super) struct Draft {
    pub(super) state: Vec<[Option<usize>; 4]>,
    pub(super) vectors: Vec<Vector>,
    /// The rates of the vectors of the state.
    pub(super) rates: Vec<Index>,
    /// Instructions of all, and of the scalar steps that they need, about.
    pub(super) cost: usize,
}

/// How often it is tried whether lanes go together: models of all families take less than a hundred attempts. Where vectors that
/// cost more than they save stand in each other, as squares of squares of matrices do, each level takes five times as many.
const MOST_ATTEMPTS: usize = 1024;

/// The vectors that make the rates of those of the state.
pub(super) fn pack(program: &Program, names: &[Symbol], state: Vec<[Option<usize>; 4]>) -> Draft {
    let input =
        |name: &Symbol| program.steps.iter().position(|op| matches!(op, Op::Input(own) if own == name));
    let inputs: Vec<Option<Value>> = names.iter().map(input).collect();
    let lanes_of = |vector: &[Option<usize>; 4], value: &dyn Fn(usize) -> Option<Value>| {
        vector.map(|component| component.and_then(value).map_or(Lane::Free, Lane::Of))
    };
    let of_state = state.iter().enumerate().map(|(k, vector)| Vector {
        lanes: lanes_of(vector, &|component| inputs[component]),
        made: Four::State(k),
    });
    let moving = program.depending(|input| input.quantity() == Some(Quantity::Time) || names.contains(input));
    let mut packer = Packer { program, moving, vectors: of_state.collect(), attempts: 0 };
    let rates =
        state.iter().map(|vector| packer.pack(lanes_of(vector, &|k| Some(program.outputs[k].1)))).collect();
    let cost = packer.cost() + OF_A_SUM * state.len();
    Draft { state, vectors: packer.vectors, rates, cost }
}

struct Packer<'p> {
    program: &'p Program,
    /// Values that depend on the state or on the time.
    moving: Vec<bool>,
    vectors: Vec<Vector>,
    attempts: usize,
}

/// Operands of the lanes of a vector.
type Operands<const K: usize> = [Lanes; K];

impl Packer<'_> {
    /// The vector with these lanes.
    fn pack(&mut self, lanes: Lanes) -> Index {
        let lanes = lanes.map(|lane| self.without_sign(lane));
        if let Some(known) = self.known(lanes) {
            return known;
        }
        if let Some(positive) = opposite(lanes) {
            let positive = self.pack(positive);
            return self.push(lanes, Four::Neg(positive));
        }
        if let Some(value) = single(lanes) {
            return self.push(lanes, Four::All(value));
        }
        if lanes.iter().filter_map(|lane| lane.value()).all(|v| !self.moving[v]) {
            return self.push(lanes, Four::Gathered(lanes));
        }
        self.cheaper(lanes)
    }

    /// By one operation, or gathered.
    fn cheaper(&mut self, lanes: Lanes) -> Index {
        self.attempts += 1;
        if self.attempts > MOST_ATTEMPTS {
            return self.push(lanes, Four::Gathered(lanes));
        }
        let mark = self.vectors.len();
        let Some(together) = self.together(lanes) else { return self.push(lanes, Four::Gathered(lanes)) };
        let cost_together = self.cost();
        let made = self.vectors.split_off(mark);
        let gathered = self.push(lanes, Four::Gathered(lanes));
        if self.cost() < cost_together {
            return gathered;
        }
        self.vectors.truncate(mark);
        self.vectors.extend(made);
        together
    }

    /// By the operation that makes every lane.
    fn together(&mut self, lanes: Lanes) -> Option<Index> {
        let is = |wanted: &dyn Fn(&Op) -> bool| {
            lanes.iter().filter_map(|lane| lane.value()).any(|v| wanted(&self.program.steps[v]))
        };
        let any_product = is(&|op| matches!(op, Op::Mul(..)));
        let any_fused = is(&|op| matches!(op, Op::MulAdd(..)));
        // Of the other sign a sum has no operands here.
        let any_sum = lanes.iter().any(
            |lane| matches!(lane, Lane::Of(v) if matches!(self.program.steps[*v], Op::Add(..) | Op::Sub(..))),
        );
        let made = if any_fused {
            let [a, b, c] = self.operands(lanes, Self::as_fused)?;
            let [a, b] = self.aligned([a, b]);
            let [a, b, c] = [a, b, c].map(|operand| self.pack(operand));
            Four::MulAdd(a, b, c)
        } else if let (true, Some(factors)) = (any_product, self.operands(lanes, Self::as_product)) {
            let factors = self.aligned(factors);
            let [a, b] = factors.map(|operand| self.pack(operand));
            Four::Mul(a, b)
        } else if let (true, Some(terms)) = (any_sum, self.operands(lanes, Self::as_difference)) {
            let [a, b] = terms.map(|operand| self.pack(operand));
            Four::Sub(a, b)
        } else if any_sum {
            let terms = self.operands(lanes, |packer, lane| Some(packer.as_sum(lane)))?;
            let terms = self.aligned(terms);
            let [a, b] = terms.map(|operand| self.pack(operand));
            Four::Add(a, b)
        } else {
            return None;
        };
        Some(self.push(lanes, made))
    }

    /// The operands of each lane.
    fn operands<const K: usize>(
        &self,
        lanes: Lanes,
        of: impl Fn(&Self, Lane) -> Option<[Lane; K]>,
    ) -> Option<Operands<K>> {
        let mut operands = [[Lane::Free; 4]; K];
        for (place, lane) in lanes.into_iter().enumerate().filter(|(_, lane)| *lane != Lane::Free) {
            for (operand, entry) in operands.iter_mut().zip(of(self, lane)?) {
                operand[place] = entry;
            }
        }
        Some(operands)
    }

    fn as_fused(&self, lane: Lane) -> Option<[Lane; 3]> {
        if let Lane::Of(v) = lane
            && let Op::MulAdd(a, b, c) = self.program.steps[v]
        {
            return Some([a, b, c].map(Lane::Of));
        }
        // A product with nothing added.
        self.as_product(lane).map(|[a, b]| [a, b, Lane::MinusZero])
    }

    fn as_product(&self, lane: Lane) -> Option<[Lane; 2]> {
        match (lane, &self.program.steps[lane.value()?]) {
            (Lane::Of(_), Op::Mul(a, b)) => Some([Lane::Of(*a), Lane::Of(*b)]),
            (_, Op::Mul(a, b)) => Some([Lane::Minus(*a), Lane::Of(*b)]),
            _ => None,
        }
    }

    fn as_difference(&self, lane: Lane) -> Option<[Lane; 2]> {
        match (lane, &self.program.steps[lane.value()?]) {
            (Lane::Of(_), Op::Sub(a, b)) => Some([Lane::Of(*a), Lane::Of(*b)]),
            _ => None,
        }
    }

    fn as_sum(&self, lane: Lane) -> [Lane; 2] {
        match lane {
            Lane::Of(v) => match self.program.steps[v] {
                Op::Add(a, b) => [Lane::Of(a), Lane::Of(b)],
                Op::Sub(a, b) => [Lane::Of(a), Lane::Minus(b)],
                _ => [lane, Lane::MinusZero],
            },
            lane => [lane, Lane::MinusZero],
        }
    }

    /// Operands that may be exchanged, lane by lane, so that they are vectors that are known, or cheap.
    fn aligned(&self, [a, b]: Operands<2>) -> Operands<2> {
        let mut wanted: Vec<Lanes> = self.vectors.iter().map(|vector| vector.lanes).collect();
        let entries = a.iter().chain(&b).filter(|lane| lane.value().is_some());
        wanted.extend(entries.map(|lane| [*lane; 4]));
        let mut best = [a, b];
        let mut least = self.difficulty(best);
        for wanted in wanted {
            if least == 0 {
                break;
            }
            let Some(other) = exchanged([a, b], wanted) else { continue };
            let difficulty = self.difficulty(other);
            if difficulty < least {
                (best, least) = (other, difficulty);
            }
        }
        best
    }

    /// A guess at what it costs to have these vectors.
    fn difficulty(&self, operands: Operands<2>) -> usize {
        let of = |lanes: Lanes| {
            let lanes = lanes.map(|lane| self.without_sign(lane));
            let is_fixed = lanes.iter().filter_map(|lane| lane.value()).all(|v| !self.moving[v]);
            if is_fixed || self.known(lanes).is_some() {
                0
            } else if single(lanes).is_some() {
                1
            } else {
                4
            }
        };
        operands.into_iter().map(of).sum()
    }

    /// A vector that has these lanes.
    fn known(&self, lanes: Lanes) -> Option<Index> {
        // Loops and no iterators: most of the time of an unoptimised build would go here.
        let mut index = 0;
        while index < self.vectors.len() {
            let own = &self.vectors[index].lanes;
            let mut place = 0;
            while place < 4 && (lanes[place] == Lane::Free || own[place] == lanes[place]) {
                place += 1;
            }
            if place == 4 {
                return Some(index);
            }
            index += 1;
        }
        None
    }

    /// `-a` as the other sign of `a`.
    fn without_sign(&self, lane: Lane) -> Lane {
        match (lane, lane.value().map(|v| &self.program.steps[v])) {
            (Lane::Of(_), Some(Op::Neg(a))) => self.without_sign(Lane::Minus(*a)),
            (Lane::Minus(_), Some(Op::Neg(a))) => self.without_sign(Lane::Of(*a)),
            _ => lane,
        }
    }

    fn push(&mut self, lanes: Lanes, made: Four) -> Index {
        let all = match made {
            Four::All(value) => [Lane::Of(value); 4],
            _ => lanes,
        };
        self.vectors.push(Vector { lanes: all, made });
        self.vectors.len() - 1
    }

    /// Instructions of all vectors, and of the scalar steps that they need.
    fn cost(&self) -> usize {
        // What is found in a lane needs no step.
        let mut found = vec![false; self.program.steps.len()];
        let mut open: Vec<Value> = Vec::new();
        let mut cost = 0;
        for vector in &self.vectors {
            cost += cost::of_vector(self.program, vector.made);
            match vector.made {
                Four::All(value) => open.push(value),
                Four::Gathered(lanes) => open.extend(lanes.into_iter().filter_map(Lane::value)),
                _ => {
                    for lane in vector.lanes {
                        if let Lane::Of(value) = lane {
                            found[value] = true;
                        }
                    }
                }
            }
        }
        while let Some(value) = open.pop() {
            if !found[value] {
                found[value] = true;
                cost += cost::of_number(&self.program.steps[value]);
                open.extend(self.program.steps[value].operands());
            }
        }
        cost
    }
}

/// The same lanes with the other sign, where all have one.
fn opposite(lanes: Lanes) -> Option<Lanes> {
    let positive = lanes.map(|lane| match lane {
        Lane::Minus(value) => Lane::Of(value),
        lane => lane,
    });
    let all = lanes.iter().all(|lane| matches!(lane, Lane::Free | Lane::Minus(_)));
    (all && positive != lanes).then_some(positive)
}

/// The value that stands in all lanes.
fn single(lanes: Lanes) -> Option<Value> {
    let mut read = lanes.into_iter().filter(|lane| *lane != Lane::Free);
    match read.next() {
        Some(Lane::Of(value)) => read.all(|lane| lane == Lane::Of(value)).then_some(value),
        _ => None,
    }
}

/// Operands exchanged lane by lane so that the first is `wanted`, where that can be.
fn exchanged([a, b]: Operands<2>, wanted: Lanes) -> Option<Operands<2>> {
    let mut first = [Lane::Free; 4];
    let mut second = [Lane::Free; 4];
    for lane in (0..4).filter(|lane| a[*lane] != Lane::Free) {
        (first[lane], second[lane]) = match wanted[lane] {
            entry if entry == a[lane] => (a[lane], b[lane]),
            entry if entry == b[lane] => (b[lane], a[lane]),
            _ => return None,
        };
    }
    Some([first, second])
}
