//! The order of vectors and scalar steps.

use super::pack::Draft;
use super::vector::{Index, Lane, Packed, Step, Vector};
use crate::ir::{Op, Program, Value};

/// Puts everything that the rates need in order.
pub(super) fn scheduled(program: &Program, draft: Draft) -> Packed {
    let Draft { state, vectors, rates, .. } = draft;
    let mut scheduler = Scheduler {
        program,
        vectors: &vectors,
        needs: needs(program, &vectors),
        done: vec![false; vectors.len()],
        computed: vec![false; program.steps.len()],
        open: Vec::new(),
        open_vectors: Vec::new(),
        steps: Vec::new(),
        in_lanes: Vec::new(),
    };
    for rate in &rates {
        scheduler.vector(*rate);
    }
    let Scheduler { steps, in_lanes, .. } = scheduler;
    Packed { program: program.clone(), state, steps, in_lanes, rates, vectors }
}

/// Which values each value depends on, itself among them.
fn reaches(program: &Program) -> Vec<Vec<bool>> {
    let mut all: Vec<Vec<bool>> = Vec::with_capacity(program.steps.len());
    for (value, op) in program.steps.iter().enumerate() {
        let mut own = vec![false; program.steps.len()];
        own[value] = true;
        for operand in op.operands() {
            unite(&mut own, &all[operand]);
        }
        all.push(own);
    }
    all
}

/// What the operands of each vector depend on, in lanes that others read as well: values; and vectors, itself among
/// them.
fn needs(program: &Program, vectors: &[Vector]) -> Vec<(Vec<bool>, Vec<bool>)> {
    let reaches = reaches(program);
    let mut all: Vec<(Vec<bool>, Vec<bool>)> = Vec::with_capacity(vectors.len());
    for (index, Vector { made, .. }) in vectors.iter().enumerate() {
        let (mut values, mut own) = (vec![false; program.steps.len()], vec![false; vectors.len()]);
        own[index] = true;
        made.values().iter().for_each(|value| unite(&mut values, &reaches[*value]));
        for operand in made.operands() {
            let in_lanes = vectors[operand].lanes.iter().filter_map(|lane| lane.value());
            in_lanes.for_each(|value| unite(&mut values, &reaches[value]));
            unite(&mut values, &all[operand].0);
            unite(&mut own, &all[operand].1);
        }
        all.push((values, own));
    }
    all
}

fn unite(set: &mut [bool], other: &[bool]) {
    set.iter_mut().zip(other).for_each(|(own, other)| *own |= other);
}

struct Scheduler<'p> {
    program: &'p Program,
    vectors: &'p [Vector],
    needs: Vec<(Vec<bool>, Vec<bool>)>,
    done: Vec<bool>,
    /// Values that are known, as scalars or in lanes.
    computed: Vec<bool>,
    /// What is being computed: nothing that depends on it can help.
    open: Vec<Value>,
    /// Vectors that are.
    open_vectors: Vec<Index>,
    steps: Vec<Step>,
    in_lanes: Vec<(Value, (Index, usize))>,
}

impl Scheduler<'_> {
    fn vector(&mut self, index: Index) {
        if self.done[index] {
            return;
        }
        let Vector { lanes, made } = self.vectors[index];
        let before = self.open.len();
        self.open_vectors.push(index);
        self.open.extend(lanes.into_iter().filter_map(Lane::value).filter(|_| made.makes()));
        for operand in made.operands() {
            self.vector(operand);
        }
        for value in made.values() {
            self.scalar(value);
        }
        self.open.truncate(before);
        self.open_vectors.pop();
        self.done[index] = true;
        self.steps.push(Step::Vector(index));
    }

    fn scalar(&mut self, value: Value) {
        if self.computed[value] {
            return;
        }
        if let Some((index, lane)) = self.lane_for(value) {
            self.vector(index);
            self.in_lanes.push((value, (index, lane)));
        } else {
            self.open.push(value);
            for operand in self.program.steps[value].operands() {
                self.scalar(operand);
            }
            self.open.pop();
            if !matches!(self.program.steps[value], Op::Input(_)) {
                self.steps.push(Step::Scalar(value));
            }
        }
        self.computed[value] = true;
    }

    /// A vector in which the value is made, without waiting for what waits for it.
    fn lane_for(&self, value: Value) -> Option<(Index, usize)> {
        let is_free = |index: Index| {
            let (values, vectors) = &self.needs[index];
            !self.open.iter().chain([&value]).any(|open| values[*open])
                && !self.open_vectors.iter().any(|open| vectors[*open])
        };
        self.vectors.iter().enumerate().find_map(|(index, vector)| {
            let lane = vector.lanes.iter().position(|lane| *lane == Lane::Of(value))?;
            (vector.made.makes() && (self.done[index] || is_free(index))).then_some((index, lane))
        })
    }
}
