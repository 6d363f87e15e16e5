//! Everything that is emitted about a model.

use super::conserved::Conserved;
use super::domain::Domain;
use super::equations::Equations;
use super::lattice::TwoPolar;
use super::metrics::ChangeOfBases;
use super::prepared::Prepared;
use super::quantities::Quantities;
use super::{second_order, splitting};
use crate::algebra::passage::Passage;
use crate::ir::Program;
use crate::ir::fuse::fuse;
use crate::ir::packed::Packed;
use crate::ir::tangent::with_tangent;
use crate::ir::taylor::Recurrence;
use crate::mechanics::closed_form::ClosedForm;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::describe::Formula;
use crate::mechanics::reduction::Reduction;
use crate::mechanics::reduction::left_out::LeftOut;
use crate::mechanics::symmetry::Group;
use crate::mechanics::term::Frame;
use crate::symbol::{Asked, Capability, Quantity, Symbol};

/// Everything that is emitted about a model.
pub struct Model {
    /// Dimension of space.
    pub dim: usize,
    /// The group that the motion is confined to; `None` for GL+(n).
    pub constraint: Option<Constraint>,
    /// Frame of the internal motion.
    pub frame: Frame,
    /// Frame of the translational energy.
    pub translation: Option<Frame>,
    /// What decides whether the mass matrix is regular at a placement, where that is not known for all.
    pub regularity: Option<Regularity>,
    /// What is computed at one point of phase space.
    pub point: PointPrograms,
    /// Quantities that are emitted where they are asked for.
    pub quantities: Quantities,
    /// Metrics other than the identity.
    pub metrics: Option<ChangeOfBases>,
    /// What `prepare()` computes and checks.
    pub prepared: Prepared,
    /// Hamilton's equations and the motion as it is integrated.
    pub dynamics: Dynamics,
    /// What is told of a model.
    pub description: Facts,
    /// What methods of integration take beside the reduced equations, where asked for or worth while.
    pub methods: Methods,
}

/// What is computed at one point of phase space.
pub struct PointPrograms {
    /// What starts from velocities; with `phi` where the mass matrix depends on it, as in the next ones. `None` where
    /// they do not determine the momentum.
    pub velocity_side: Option<VelocitySide>,
    /// `X -> O`.
    pub velocity: Program,
    /// `1/m` and `m` of the translation.
    pub mass: Option<Program>,
    /// Translation with masses in body and space.
    pub mixed_masses: Option<MixedMasses>,
    /// Point -> `H`.
    pub hamiltonian: Program,
    /// The same where stretches are far from 1, where that takes another form.
    pub hamiltonian_far_away: Option<Program>,
    /// Where the potential has a value, where that is not everywhere.
    pub domain: Option<Domain>,
    /// Point -> power of the forces that no potential has.
    pub power: Option<Program>,
    /// `1/alpha`, `1/beta`, `1/mu` of an isotropic model, and the coefficient of `C(3)/3` where there is one.
    pub isotropic: Option<Program>,
}

/// Hamilton's equations and the motion as it is integrated.
pub struct Dynamics {
    /// Hamilton's equations in the model's own frames.
    pub full: Equations,
    /// The reduced equations.
    pub reduced: Equations,
    /// How the state was reduced.
    pub reduction: Reduction,
    /// From a phase point to the reduced state, and back.
    pub passage: Passage,
    /// The constants of a trajectory as functions of its conserved momenta.
    pub trajectory: Program,
    /// Closed form of the geodesics; whether it needs `p = 0`.
    pub closed_form: Option<(ClosedForm, bool)>,
    /// `1/m`, the stiffness and the scale of the dilatational motion, where it is taken out of the state.
    pub dilatation: Option<Program>,
}

/// What is told of a model.
pub struct Facts {
    /// Conserved quantities.
    pub conserved: Conserved,
    /// Conserved quantities of motions with `p = 0`.
    pub conserved_at_rest: Conserved,
    /// Numbers of positive and negative squares.
    pub signature: Option<(usize, usize)>,
    /// Is there a potential or any other force?
    pub has_forces: bool,
    /// Symmetry groups of space and body that leave the kinetic energy unchanged.
    pub groups: (Group, Group),
    /// Would splitting move the dilatation along a closed form of its own?
    pub dilates: bool,
    /// `T`, `H`, and the equations.
    pub formulas: Formulas,
}

/// What methods of integration take beside the reduced equations, where asked for or worth while.
pub struct Methods {
    /// The two-polar form, where it is asked for.
    pub two_polar: Option<TwoPolar>,
    /// Taylor coefficients of the reduced equations, if asked for.
    pub taylor: Option<Recurrence>,
    /// Exact flows of the pieces of the reduced motion, if asked for.
    pub splitting: Option<splitting::Programs>,
    /// The variational equations, if asked for.
    pub tangent: Option<Variational>,
    /// The equations as `q' = V(p)`, `p' = F(t, q)`, if asked for.
    pub second_order: Option<second_order::Halves>,
    /// The reduced equations in vectors of four, where that pays.
    pub packed: Option<Packed>,
    /// The equations without the constraint `det phi = 1`, of masses, for a method that solves for its multiplier.
    pub unconstrained: Option<Equations>,
}

/// How a change of the state moves.
pub struct Variational {
    /// State and its change -> rates and their changes; `None` where fields compute, or where stretches are found by an
    /// iteration: these take dual numbers too.
    pub program: Option<Program>,
}

/// The Legendre transformation and the energy in velocities.
pub struct VelocitySide {
    /// `O -> X`.
    pub legendre: Program,
    /// `(O, v) -> T`.
    pub kinetic_energy: Program,
}

/// The derivation as formulas.
pub struct Formulas {
    /// `T`.
    pub kinetic_energy: Formula,
    /// `H`.
    pub hamiltonian: Formula,
    /// Hamilton's equations.
    pub equations: Vec<Formula>,
    /// The reduced equations, component by component.
    pub reduced: Vec<Formula>,
    /// What was taken out of the state.
    pub left_out: Vec<LeftOut>,
}

/// Legendre transformation of the centre of mass where it depends on `phi`.
pub struct MixedMasses {
    /// `(phi, x_dot) -> p`.
    pub momentum: Program,
    /// `(phi, p) -> x_dot`.
    pub velocity: Program,
}

/// The mass matrix in blocks that do not mix.
pub struct Regularity {
    /// `phi ->` upper triangle, row after row, then the sizes of the summands of each diagonal entry.
    pub blocks: Vec<(Program, usize)>,
    /// Must it be positive definite?
    pub positive: bool,
}

impl Model {
    /// With what is derived from the reduced equations: recurrence and variational equations, where they are asked for,
    /// and vectors of four.
    pub(super) fn completed(mut self, asked: Asked) -> Self {
        let states = self.dynamics.reduced.symbols();
        let program = &self.dynamics.reduced.program;
        self.methods.taylor = asked.has(Capability::Taylor).then(|| Recurrence::of(program, &states));
        self.methods.tangent = asked.has(Capability::Tangent).then(|| {
            let changes =
                |symbol: &Symbol| symbol.quantity() == Some(Quantity::Constant) || states.contains(symbol);
            Variational { program: program.calls.is_empty().then(|| fuse(&with_tangent(program, &changes))) }
        });
        // Charts of groups take single components; Runge-Kutta-Nystrom steps and closed forms leave nothing to do.
        let is_closed = matches!(self.dynamics.closed_form, Some((_, false)));
        if self.constraint.is_none() && self.methods.second_order.is_none() && !is_closed {
            self.methods.packed = Packed::of(program, &self.dynamics.reduced.components());
        }
        self
    }
}
