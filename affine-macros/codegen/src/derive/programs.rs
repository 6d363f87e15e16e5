//! Hamilton's equations and the reduced equations in their shortest forms.

use crate::algebra::bind::Constants;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::ir::Program;
use crate::ir::fuse::fuse;
use crate::mechanics::asked::Asked;
use crate::mechanics::charts::{Chart, Coordinate, Linear, Momentum};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::equations::{Form, System};
use crate::mechanics::forces::Forces;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::kinetics::Kinetics;
use crate::mechanics::loads::loads;
use crate::mechanics::potential::Potential;
use crate::mechanics::reduce::{self, Layout, Reduction};
use crate::mechanics::term::Frame;
use crate::optimise::{Batch, straight_line};
use crate::symbol::{Quantity, Symbol};

use super::batch::{batch, split_batch};
use super::equations::Equations;
use super::second_order::Halves;
use super::splitting::Programs;

/// Chart and Hamiltonian of the equations that users of other codes write down: all momenta in the model's frames.
pub(super) fn full_chart(arena: &mut Arena, h: &Hamiltonian) -> (Chart, Polynomial) {
    let linear = h.translation.as_ref().map(|(frame, _)| match (frame, h.frame) {
        (Frame::Body, Frame::Body) => Linear::Body,
        _ => Linear::Space,
    });
    let chart = Chart::new(arena, h.dim, Momentum::of(h.frame), linear).under(h.confined());
    let full = reduce::own_hamiltonian(h, &chart);
    (chart, full)
}

/// The shortest of the ways to write the equations.
pub(super) fn full_equations(
    arena: &mut Arena,
    h: &Hamiltonian,
    chart: &Chart,
    full_h: &Polynomial,
    potential: Option<&Potential>,
    forces: &Forces,
    coefficients: &mut Constants,
) -> Equations {
    let mut loads = loads(arena, chart, h, potential, forces);
    // The plain array has no place for the work.
    loads.iter_mut().for_each(|load| load.work = None);
    let kinetics = Kinetics::polynomial(arena, chart, full_h);
    let mut through_velocity = kinetics.system(Form::ThroughVelocity);
    loads.iter().for_each(|load| through_velocity.add(load));
    let mut ways: Vec<Batch> = vec![batch(arena, &through_velocity)];
    if !h.is_tensor() {
        let mut expanded = kinetics.system(Form::Expanded);
        loads.iter().for_each(|load| expanded.add(load));
        ways.push(batch(arena, &expanded));
        // Symmetric and skew parts are entries already where a constraint leaves only one of them.
        if chart.confined.is_none_or(|group| group == Constraint::Isochoric) {
            ways.push(split_batch(arena, chart, &expanded));
        }
    }
    let time = time(arena, potential, forces);
    shortest(arena, chart, &ways, time, coefficients)
}

/// The time as a symbol, where any force depends on it.
fn time(arena: &mut Arena, potential: Option<&Potential>, forces: &Forces) -> Option<Expr> {
    potential.and_then(Potential::time).or_else(|| forces.time(arena))
}

/// Equations over the coordinates of a chart, in the shortest of several ways.
pub(super) fn shortest(
    arena: &mut Arena,
    chart: &Chart,
    ways: &[Batch],
    time: Option<Expr>,
    coefficients: &mut Constants,
) -> Equations {
    let mut inputs: Vec<Expr> = chart.coordinates().into_iter().map(|z| chart.symbol(z)).collect();
    inputs.extend(time);
    let program = shortest_program(arena, ways, coefficients, &|a| inputs.contains(&a));
    let symbols = |list: &[Expr]| -> Vec<Symbol> { list.iter().map(|s| arena.symbol_of(*s)).collect() };
    let linear = chart.linear.map_or(Quantity::LinearMomentum, Linear::quantity);
    let groups = [
        (Quantity::Position, symbols(&chart.x)),
        (Quantity::Placement, symbols(&chart.phi.0.concat())),
        (linear, symbols(&chart.p)),
        (chart.momentum.quantity(), symbols(&independent_momenta(chart))),
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

fn independent_momenta(chart: &Chart) -> Vec<Expr> {
    let momenta = chart.independent().into_iter().filter(|z| matches!(z, Coordinate::M(..)));
    momenta.map(|z| chart.symbol(z)).collect()
}

/// Entries of the affine momentum that a constraint makes linear in others.
fn dependent(arena: &mut Arena, chart: &Chart) -> Program {
    let results = chart.dependent().into_iter();
    let results = results.map(|(symbol, value)| (arena.symbol_name(symbol), value));
    let batch = Batch { results: results.collect(), ..Batch::default() };
    fuse(&straight_line(arena, &batch, &mut Constants::new(Quantity::Coefficient), &|_| true))
}

/// What is asked for beside the reduced equations, as programs over the same state.
#[derive(Default)]
pub(super) struct Pieces {
    /// The flows of the pieces of `H`.
    pub(super) splitting: Option<Programs>,
    /// The halves of the equations.
    pub(super) second_order: Option<Halves>,
}

/// A reduction with its programs.
pub(super) struct Reduced {
    pub(super) reduction: Reduction,
    pub(super) equations: Equations,
    pub(super) pieces: Pieces,
    pub(super) trajectory: Program,
    pub(super) fixed: Vec<String>,
}

/// The reduction with the shortest equations, and its programs.
pub(super) fn best_reduction(
    arena: &mut Arena,
    h: &Hamiltonian,
    potential: Option<&Potential>,
    forces: &Forces,
    (rotations, asked): (bool, Asked),
    coefficients: &mut Constants,
) -> Option<Reduced> {
    // The squares of an anisotropic energy move each momentum, also one that their sum conserves.
    let in_squares = h.isotropic.is_none() && h.frame != Frame::Flat;
    let halves = asked.nystrom || (asked.splitting && in_squares);
    let pieces = asked.nystrom || asked.splitting;
    let candidates = reduce::candidates(arena, h, potential, forces, (rotations, halves, pieces));
    let time = time(arena, potential, forces);
    let pieces = |arena: &mut Arena, reduction: &Reduction, constants: &mut Constants| {
        let split = asked.splitting.then(|| Programs::of(arena, h, potential, reduction, constants));
        let halves = asked.nystrom.then(|| Halves::of(arena, h, potential, reduction, constants));
        Pieces { splitting: split.flatten(), second_order: halves.flatten() }
    };
    shortest_reduction(arena, candidates, time, pieces, coefficients)
}

/// The reduction of several with the shortest equations, its programs, and those of its `pieces`.
pub(super) fn shortest_reduction(
    arena: &mut Arena,
    candidates: Vec<Reduction>,
    time: Option<Expr>,
    pieces: impl FnOnce(&mut Arena, &Reduction, &mut Constants) -> Pieces,
    coefficients: &mut Constants,
) -> Option<Reduced> {
    let mut best: Option<(usize, Reduction, Program, Constants)> = None;
    for candidate in candidates {
        let mut states: Vec<Expr> = candidate.states.iter().flat_map(|(_, s)| s.clone()).collect();
        states.extend(time);
        let mut constants = Constants::new(Quantity::Constant);
        let way = batch(arena, &candidate.system);
        let program = straight_line(arena, &way, &mut constants, &|a| states.contains(&a));
        let weight = program.operations().weight() + states.len();
        if best.as_ref().is_none_or(|(least, ..)| weight < *least) {
            best = Some((weight, candidate, program, constants));
        }
    }
    let (_, reduction, program, mut constants) = best?;
    let pieces = pieces(arena, &reduction, &mut constants);
    let inputs: Vec<Expr> = trajectory_symbols(&reduction);
    let definitions = Batch {
        results: constants.entries.iter().map(|(s, p)| (arena.symbol_name(*s), p.clone())).collect(),
        ..Batch::default()
    };
    let trajectory = fuse(&straight_line(arena, &definitions, coefficients, &|a| inputs.contains(&a)));
    let name = |s: &Expr| arena.symbol_name(*s);
    let symbol = |s: &Expr| arena.symbol_of(*s);
    let groups = reduction.states.iter().map(|(g, s)| (*g, s.iter().map(symbol).collect())).collect();
    let fixed = reduction.fixed.iter().map(name).collect();
    let dependent = match reduction.layout {
        Layout::Constant => Program::default(),
        Layout::Entries => dependent(arena, &reduction.chart),
    };
    let equations = Equations { groups, dependent, program: fuse(&program) };
    Some(Reduced { reduction, equations, pieces, trajectory, fixed })
}

/// What `trajectory` reads: `p` where the state depends on it, and the constant part of the affine momentum.
fn trajectory_symbols(reduction: &Reduction) -> Vec<Expr> {
    let chart = &reduction.chart;
    let momentum = match reduction.layout {
        Layout::Constant => chart.m.0.concat(),
        Layout::Entries => reduction.fixed.clone(),
    };
    [chart.p.clone(), momentum].concat()
}

/// The power of the forces at a point, with what it shares; `None` where there are no forces.
pub(super) fn power_batch(
    arena: &mut Arena,
    h: &Hamiltonian,
    chart: &Chart,
    full_h: &Polynomial,
    potential: Option<&Potential>,
    forces: &Forces,
) -> Option<Batch> {
    let Kinetics { shared, .. } = Kinetics::polynomial(arena, chart, full_h);
    let mut system = System { shared, ..System::default() };
    // Another potential has no power.
    let driving = potential.filter(|_| forces.driven);
    loads(arena, chart, h, driving, forces).iter().for_each(|load| system.add(load));
    let dependent = chart.dependent();
    let system = system.substitute(&|atom| {
        dependent.iter().find(|(symbol, _)| *symbol == atom).map(|(_, value)| value.clone())
    });
    let (_, power) = system.work?;
    let results = vec![("power".to_owned(), power)];
    let batch = Batch { shared: system.shared, kernels: system.kernels, results };
    Some(if driving.is_some() { batch.pruned(arena) } else { batch })
}
