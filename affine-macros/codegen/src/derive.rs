//! The derivation of one model: from its quadratic form to straight-line programs, ready to be written down.

mod batch;
mod body;
mod conditions;
mod conserved;
mod domain;
mod equations;
mod formulas;
mod invariance;
mod lattice;
mod metrics;
mod model;
mod point;
mod prepared;
mod programs;
mod quantities;
pub mod second_order;
pub mod splitting;
mod stated;
mod unconstrained;
mod ways;
mod well_posed;
mod written;

use crate::algebra::bind::Constants;
use crate::ir::fuse::fuse;
use crate::mechanics::body::Body;
use crate::mechanics::describe::{Described, Notation};
use crate::mechanics::form::Form;
use crate::mechanics::motion::Motion;
use crate::optimise::straight_line;
use crate::symbol::{Capability, Quantity};

use body::Kept;
use prepared::{coefficient_program, damping, in_order, inverted, well_posed};
use programs::Reduced;
use ways::Ways;

pub use conserved::{Component, Conserved};
pub use domain::Domain;
pub use equations::Equations;
pub use lattice::{PieceProgram, PiecePrograms, RatioProgram, TwoPolar};
pub use metrics::{ChangeOfBases, GivenMatrix, GivenSource};
use model::{Dynamics, Facts, Methods};
pub use model::{Formulas, MixedMasses, Model, PointPrograms, Regularity, Variational, VelocitySide};
pub use prepared::{Prepared, Step};
pub use quantities::{Balance, BalancedQuantities, Metric, Quantities};
pub use well_posed::{Condition, Factor, NumericBlock, Relation};
pub use written::{Part, Written};

/// Derives a model; `None` only for energies that the checks refuse.
pub fn derive(form: Form, require_positive: bool) -> Option<Model> {
    let Form { mut arena, parts, mass, positive, stated, potential, forces, asked, .. } = form;
    let arena = &mut arena;
    let hessian = mass.constant().cloned();
    let motion = Motion::new(arena, parts, mass, stated.as_ref())?;
    let free = unconstrained::motion(arena, &motion, &forces);
    let momenta = [motion.momenta(), free.as_ref().map(Motion::momenta).unwrap_or_default()].concat();
    let written = potential.map(|u| Ways::new(arena, &u, motion.dim(), &momenta));
    let at_points = written.as_ref().map(|ways| &ways.at_points);
    let potential = written.as_ref().map(|ways| &ways.along_motions);
    let body = Body { motion: &motion, potential, forces: &forces };
    let mut coefficients = Constants::new(Quantity::Coefficient);
    let bases = form.metrics.as_ref().map(|metrics| metrics.factors(arena, &mut form.rebased.clone()));
    let Kept { moving, at_rest, rotations } = body.kept(arena, bases.as_ref())?;
    let closed_form = body.closed_form(arena);
    let chart = motion.full_chart(arena);
    // The plain array has no place for the work.
    let full = body.full_equations(arena, &chart, (at_points, false), &mut coefficients)?;
    let unconstrained = match &free {
        Some(free) => Some(unconstrained::equations(arena, free, (at_points, &forces), &mut coefficients)?),
        None => None,
    };
    let Reduced { reduction, equations: reduced, pieces, trajectory } =
        body.shortest_reduction(arena, rotations, asked, &mut coefficients)?;
    let described = Described {
        energies: &motion.parts,
        blocks: motion.numeric_blocks(),
        forces: &forces,
        metrics: form.metrics.as_ref(),
        rebased: &form.rebased,
        latex: asked.has(Capability::Latex),
    };
    let notation = Notation::new(arena, &described);
    let formulas = body.formulas(arena, &notation, &chart, &reduction, closed_form)?;
    let point = body.programs(arena, &chart, &mut coefficients)?;
    let dilatation = reduction
        .dilatation
        .as_ref()
        .map(|separation| fuse(&straight_line(arena, &separation.batch(), &mut coefficients, &|_| false)));
    if form.unitary {
        // Nothing but the lattice is emitted: no other coefficient is computed.
        coefficients = Constants::new(Quantity::Coefficient);
    }
    let lattice = motion.hamiltonian().filter(|_| asked.has(Capability::TwoPolar));
    let two_polar = lattice.map(|h| {
        lattice::two_polar(arena, &notation, h, potential, (form.unitary, asked), &mut coefficients)
    });
    let regularity = conditions::regularity(arena, &motion, positive, require_positive, &mut coefficients)?;
    let quantities = body.quantities(arena, &chart, asked, &mut coefficients)?;
    let description = Facts {
        conserved: Conserved::of(arena, &notation, form.metrics.as_ref(), &moving),
        conserved_at_rest: Conserved::of(arena, &notation, form.metrics.as_ref(), &at_rest),
        signature: conditions::signature(arena, &motion, hessian.as_ref(), positive, require_positive),
        has_forces: !body.is_free(),
        groups: (form.space_group, form.body_group),
        dilates: match &pieces.splitting {
            Some(pieces) => pieces.dilates(),
            None => body.dilates(arena, &reduction),
        },
        formulas,
    };
    let conditions = match &stated {
        None => conditions::conditions(arena, &motion, hessian.as_ref(), require_positive),
        Some(stated) => stated::conditions(arena, stated, require_positive),
    };
    let checks = well_posed(conditions)
        .chain(inverted(arena, free.as_ref().unwrap_or(&motion), require_positive))
        .chain(pieces.axes.into_iter().map(Step::PrincipalAxes))
        .chain(damping(arena, &forces))
        .collect();
    let change = form.metrics.map(|metrics| ChangeOfBases::of(arena, metrics, &form.rebased));
    let (metrics, bases) = change.unzip();
    let model = Model {
        dim: motion.dim(),
        constraint: motion.constraint(),
        frame: motion.frame(),
        translation: motion.masses.frame(),
        regularity,
        point,
        quantities,
        dynamics: Dynamics {
            full,
            reduced,
            passage: reduction.passage(arena),
            reduction,
            trajectory,
            closed_form,
            dilatation,
        },
        description,
        methods: Methods {
            two_polar,
            taylor: None,
            splitting: pieces.splitting,
            tangent: None,
            second_order: pieces.second_order,
            packed: None,
            unconstrained,
        },
        metrics,
        prepared: Prepared {
            steps: in_order(bases.flatten(), checks),
            coefficients: coefficient_program(arena, &coefficients),
        },
    };
    Some(model.completed(asked))
}
