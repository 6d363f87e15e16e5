//! The flows of the pieces as programs over the reduced state.

use crate::algebra::bind::Constants;
use crate::algebra::ring::upper;
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::ir::Program;
use crate::mechanics::body::Body;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::reduction::Reduction;
use crate::mechanics::splitting::{Flow, Principal, splitting};
use crate::optimise::Batch;
use crate::symbol::{Aspect, Quantity, Symbol};

use super::batch::{self, batch, numbered, values};
use crate::algebra::passage::DilatationalMotion;

/// The pieces of a reduced motion.
pub struct Programs {
    /// Name and flows of each.
    pub pieces: Vec<(String, Vec<FlowProgram>)>,
    /// See [`Splitting`](crate::mechanics::splitting::Splitting).
    pub nystrom: bool,
}

/// A symmetric form to be brought to its principal axes in numbers.
pub struct PrincipalProgram {
    /// Its upper triangle.
    pub program: Program,
    /// Names of the eigenvalues.
    pub values: Vec<Symbol>,
    /// Names of the eigenvectors' components.
    pub vectors: Vec<Vec<Symbol>>,
}

/// The program of a flow.
pub enum FlowProgram {
    /// State components and their constant rates.
    Shift {
        /// Names of the components that move at constant rates.
        moved: Vec<Symbol>,
        /// Computes their rates.
        program: Program,
    },
    /// State components and their rises over the time `h`.
    Rise {
        /// Names of the components that rise.
        moved: Vec<Symbol>,
        /// Computes their rises.
        program: Program,
    },
    /// An exponential on one side of the placement.
    Exponential {
        /// Components of the placement.
        placement: Vec<Vec<Symbol>>,
        /// Names of the entries of the affine momentum, where it turns along; under a constraint some are not in the state.
        momentum: Option<Vec<Vec<Symbol>>>,
        /// Does the exponential stand on the right?
        right: bool,
        /// The generator, row after row, and the entries of the momentum that turns.
        program: Program,
    },
    /// The dilatation along its closed form.
    Dilatation {
        /// Components of the placement.
        placement: Vec<Vec<Symbol>>,
        /// Components of the affine momentum.
        momentum: Vec<Vec<Symbol>>,
        /// Its closed form.
        motion: DilatationalMotion,
        /// What the closed form reads, and the diagonal of the affine spin.
        program: Program,
    },
}

impl FlowProgram {
    /// What it computes.
    pub fn program(&self) -> &Program {
        match self {
            Self::Shift { program, .. }
            | Self::Rise { program, .. }
            | Self::Exponential { program, .. }
            | Self::Dilatation { program, .. } => program,
        }
    }
}

impl Programs {
    /// Does one of the pieces move the dilatation along a closed form?
    pub fn dilates(&self) -> bool {
        let mut flows = self.pieces.iter().flat_map(|(_, flows)| flows);
        flows.any(|flow| matches!(flow, FlowProgram::Dilatation { .. }))
    }

    /// The pieces of the chosen reduction, and the forms that they need on their principal axes; coefficients that a
    /// trajectory fixes join `constants`.
    pub(super) fn of(
        arena: &mut Arena,
        (h, body): (&Hamiltonian, &Body),
        reduction: &Reduction,
        constants: &mut Constants,
    ) -> Option<(Self, Vec<PrincipalProgram>)> {
        let split = splitting(arena, (h, body), reduction)?;
        let mut varying = reduction.symbols();
        varying.extend(body.time(arena));
        varying.push(arena.symbol(Quantity::TimeOfFlow));
        let mut pieces = Vec::new();
        for piece in split.pieces {
            let flows = piece.flows.iter();
            let flows = flows.map(|flow| written(arena, flow, reduction, &varying, constants)).collect();
            pieces.push((piece.name, flows));
        }
        let axes = split.principal.iter().map(|form| principal(arena, form)).collect();
        Some((Self { pieces, nystrom: split.nystrom }, axes))
    }
}

fn written(
    arena: &mut Arena,
    flow: &Flow,
    reduction: &Reduction,
    varying: &[Expr],
    constants: &mut Constants,
) -> FlowProgram {
    let mut program = |arena: &mut Arena, batch: &Batch| batch::program(arena, batch, constants, varying);
    let table = |arena: &Arena, symbols: &[Expr]| -> Vec<Vec<Symbol>> {
        symbols.chunks(reduction.chart.dim).map(|row| arena.symbols_of(row)).collect()
    };
    let placement = |arena: &Arena| {
        let placement = reduction
            .states
            .iter()
            .find(|(group, _)| matches!(group, Quantity::Placement | Quantity::IsochoricPlacement));
        placement.map_or_else(Vec::new, |(_, symbols)| table(arena, symbols))
    };
    let momentum = |arena: &Arena| table(arena, &reduction.chart.m.0.concat());
    match flow {
        Flow::Shift(system) | Flow::Rise(system) => {
            let (moved, rates) = (system.moved(arena), batch(arena, system));
            let program = program(arena, &rates);
            match flow {
                Flow::Shift(_) => FlowProgram::Shift { moved, program },
                _ => FlowProgram::Rise { moved, program },
            }
        }
        Flow::Exponential { shared, generator, right, turns_momentum } => {
            let results = generator.iter().enumerate().flat_map(|(a, row)| {
                row.iter().enumerate().map(move |(b, y)| (Quantity::Generator.at([a + 1, b + 1]), y.clone()))
            });
            let mut results: Vec<(Symbol, Polynomial)> = results.collect();
            if *turns_momentum {
                let dependent = reduction.chart.dependent();
                let value = |s: Expr| listed(&dependent)(s).unwrap_or_else(|| Polynomial::atom(s));
                let entries = reduction.chart.m.0.concat().into_iter();
                results.extend(entries.map(|s| (arena.symbol_of(s).seen(Aspect::Turned), value(s))));
            }
            let (placement, momentum) = (placement(arena), turns_momentum.then(|| momentum(arena)));
            let program = program(arena, &Batch { shared: shared.clone(), results, ..Batch::default() });
            FlowProgram::Exponential { placement, momentum, right: *right, program }
        }
        Flow::Dilatation { separation, spin } => {
            let mut batch = separation.batch();
            batch.results.extend(numbered(Quantity::Spin, spin.iter().cloned()));
            let program = program(arena, &batch);
            let (placement, momentum) = (placement(arena), momentum(arena));
            FlowProgram::Dilatation { placement, momentum, motion: (&separation.slope).into(), program }
        }
    }
}

fn principal(arena: &mut Arena, form: &Principal) -> PrincipalProgram {
    let program = values(arena, upper(form.values.len()).map(|(i, j)| form.form[i][j].clone()));
    let vectors = form.vectors.iter().map(|vector| arena.symbols_of(vector)).collect();
    PrincipalProgram { program, values: arena.symbols_of(&form.values), vectors }
}
