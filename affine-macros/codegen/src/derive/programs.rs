//! Hamilton's equations and the reduced equations in their shortest forms.

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr};
use crate::ir::Program;
use crate::ir::fuse::fuse;
use crate::mechanics::body::Body;
use crate::mechanics::charts::{Chart, Linear, Momentum};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::equations::{Form, System};
use crate::mechanics::potential::Potential;
use crate::mechanics::reduction::Reduction;
use crate::mechanics::reduction::carried::Carried;
use crate::optimise::{Batch, straight_line};
use crate::symbol::{Asked, Capability, Quantity};

use super::batch::{batch, program as program_of, split_batch, unbound};
use super::equations::Equations;
use super::second_order::Halves;
use super::splitting::{PrincipalProgram, Programs};
use super::ways::Run;

impl Body<'_> {
    /// Hamilton's equations of a chart under a potential in place of its own, in the shortest of several ways; with the work of
    /// the forces where the array has a place for it.
    pub(super) fn full_equations(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        (potential, has_work): (Option<&Potential>, bool),
        coefficients: &mut Constants,
    ) -> Option<Equations> {
        // Symmetric and skew parts are entries already where a constraint leaves only one of them.
        let parts = chart.confined.is_none_or(|group| group == Constraint::Isochoric);
        let (mut ways, mut work): (Vec<Batch>, Vec<Expr>) = (Vec::new(), Vec::new());
        for (system, form) in self.systems(arena, chart, potential)? {
            let system = System { work: system.work.filter(|_| has_work), ..system };
            work = system.work.iter().map(|(symbol, _)| *symbol).collect();
            let system = if self.motion.hamiltonian().is_some() { system } else { system.tidied(arena) };
            ways.push(batch(arena, &system));
            if form == Form::Expanded && parts {
                ways.push(split_batch(arena, chart, &system));
            }
        }
        let inputs = self.inputs(arena, chart);
        Some(shortest(arena, (chart, &work), &ways, &inputs, coefficients))
    }

    /// The reduction with the shortest equations, its programs, and those of what is asked for beside them.
    pub(super) fn shortest_reduction(
        &self,
        arena: &mut Arena,
        rotations: bool,
        asked: Asked,
        coefficients: &mut Constants,
    ) -> Option<Reduced> {
        let reductions = self.reductions(arena, rotations, asked)?;
        let time = self.time(arena);
        let h = self.motion.hamiltonian();
        let pieces = |arena: &mut Arena, reduction: &Reduction, constants: &mut Constants| {
            let split = h.filter(|_| asked.has(Capability::Splitting));
            let split = split.and_then(|h| Programs::of(arena, (h, self), reduction, constants));
            let halves = h.filter(|_| asked.has(Capability::Nystrom));
            let second_order = halves.and_then(|h| Halves::of(arena, (h, self), reduction, constants));
            let (splitting, axes) = split.unzip();
            Pieces { splitting, axes: axes.unwrap_or_default(), second_order }
        };
        shortest_reduction(arena, reductions, time, pieces, coefficients)
    }
}

/// Equations over the coordinates of a chart and the work, in the shortest of several ways.
fn shortest(
    arena: &mut Arena,
    (chart, work): (&Chart, &[Expr]),
    ways: &[Batch],
    inputs: &[Expr],
    coefficients: &mut Constants,
) -> Equations {
    let program = shortest_program(arena, ways, coefficients, &|a| inputs.contains(&a));
    let linear = chart.linear.map_or(Quantity::LinearMomentum, Linear::quantity);
    let momenta: Vec<Expr> = chart.independent_momenta().into_iter().map(|z| chart.symbol(z)).collect();
    let groups = [
        (Quantity::Position, arena.symbols_of(&chart.x)),
        (Quantity::Placement, arena.symbols_of(&chart.phi.0.concat())),
        (linear, arena.symbols_of(&chart.p)),
        (chart.momentum.quantity(), arena.symbols_of(&momenta)),
        (Quantity::Work, arena.symbols_of(work)),
    ];
    Equations {
        groups: groups.into_iter().filter(|(_, symbols)| !symbols.is_empty()).collect(),
        dependent: dependent(arena, chart),
        program: fuse(&program),
    }
}

/// The shortest of several programs for the same results.
pub(super) fn shortest_program(
    arena: &mut Arena,
    ways: &[Batch],
    coefficients: &mut Constants,
    varies: &impl Fn(Expr) -> bool,
) -> Program {
    let (program, chosen) = ways
        .iter()
        .map(|way| {
            let mut constants = coefficients.clone();
            (straight_line(arena, way, &mut constants, varies), constants)
        })
        .min_by_key(|(program, _)| program.operations().weight())
        .unwrap_or_else(|| (Program::default(), coefficients.clone()));
    *coefficients = chosen;
    program
}

/// Entries of the affine momentum that a constraint makes linear in others.
fn dependent(arena: &mut Arena, chart: &Chart) -> Program {
    let results = chart.dependent().into_iter();
    let results = results.map(|(symbol, value)| (arena.symbol_of(symbol), value)).collect();
    unbound(arena, results)
}

/// What is asked for beside the reduced equations, as programs over the same state.
#[derive(Default)]
pub(super) struct Pieces {
    /// The flows of the pieces of `H`.
    pub(super) splitting: Option<Programs>,
    /// Forms whose principal axes these read.
    pub(super) axes: Vec<PrincipalProgram>,
    /// The halves of the equations.
    pub(super) second_order: Option<Halves>,
}

/// A reduction with its programs.
pub(super) struct Reduced {
    pub(super) reduction: Reduction,
    pub(super) equations: Equations,
    pub(super) pieces: Pieces,
    pub(super) trajectory: Program,
}

/// The reduction of several with the shortest equations, its programs, and those of its `pieces`.
fn shortest_reduction(
    arena: &mut Arena,
    candidates: Vec<Reduction>,
    time: Option<Expr>,
    pieces: impl FnOnce(&mut Arena, &Reduction, &mut Constants) -> Pieces,
    coefficients: &mut Constants,
) -> Option<Reduced> {
    let mut built: Vec<(Reduction, Program, Constants)> = Vec::new();
    for candidate in candidates {
        let mut states = candidate.symbols();
        states.extend(time);
        let mut constants = Constants::new(Quantity::Constant);
        let way = batch(arena, &candidate.system);
        let program = straight_line(arena, &way, &mut constants, &|a| states.contains(&a));
        built.push((candidate, program, constants));
    }
    let is_flat = |(reduction, ..): &(Reduction, Program, Constants)| {
        reduction.chart.momentum == Momentum::Canonical && reduction.dilatation.is_none()
    };
    let carries = |(reduction, ..): &(Reduction, Program, Constants)| {
        reduction.carried.contains(&Carried::InverseDilatation)
    };
    let far = built.iter().find(|one| is_flat(one) && carries(one));
    let far =
        far.map(|(reduction, program, constants)| (reduction.chart.dim, Run::new(arena, program, constants)));
    let mut best: Option<(usize, usize)> = None;
    for (k, one) in built.iter().enumerate() {
        let (reduction, program, constants) = one;
        // Powers of det phi leave the range of numbers sooner than those of what is carried.
        if let Some((n, far)) = &far
            && is_flat(one)
            && !carries(one)
            && !Run::new(arena, program, constants).reaches_as_far_as(far, *n)
        {
            continue;
        }
        let states = reduction.symbols().len();
        let weight = program.operations().weight() + states + usize::from(time.is_some());
        if best.is_none_or(|(least, _)| weight < least) {
            best = Some((weight, k));
        }
    }
    let (reduction, program, mut constants) = built.swap_remove(best?.1);
    let pieces = pieces(arena, &reduction, &mut constants);
    let inputs: Vec<Expr> = trajectory_symbols(&reduction);
    let definitions = Batch {
        results: constants.entries.iter().map(|(s, p)| (arena.symbol_of(*s), p.clone())).collect(),
        ..Batch::default()
    };
    let trajectory = program_of(arena, &definitions, coefficients, &inputs);
    let groups = reduction.states.iter().map(|(group, of)| (*group, arena.symbols_of(of))).collect();
    let dependent = match reduction.conserved.affine {
        true => Program::default(),
        false => dependent(arena, &reduction.chart),
    };
    let equations = Equations { groups, dependent, program: fuse(&program) };
    Some(Reduced { reduction, equations, pieces, trajectory })
}

/// What `trajectory` reads: `p` where the state depends on it, and the constant part of the affine momentum.
fn trajectory_symbols(reduction: &Reduction) -> Vec<Expr> {
    let (chart, conserved) = (&reduction.chart, &reduction.conserved);
    let momentum = if conserved.affine { chart.m.0.concat() } else { conserved.components.clone() };
    [chart.p.clone(), momentum].concat()
}
