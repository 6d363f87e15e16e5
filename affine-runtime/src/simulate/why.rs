//! Which method ran, and what was left out.

use core::fmt;

use super::choice::{NYSTROM_TOLERANCE, TAYLOR_TOLERANCE};
use super::friction::STIFF_FRICTION;
use super::layout::has_work;
use super::method::Method;
use super::trajectory::{Computation, Trajectory};
use crate::inner::ORDER;
use crate::integrate::FusedArithmetic;
use crate::integrate::radau::Tableau;
use crate::integrate::taylor::order_for;
use crate::model::{Conserved, Constraint, Description, LeftOut, Quantity, Scope};
use crate::state::Phase;

/// What is left of `det phi`, where half of its digits are lost.
const HALF_LOST: f64 = 1e-8;
/// Condition numbers from here on take more than half the digits.
const WORTH_SAYING: f64 = 1e8;

/// What symplectic steps make of an energy that is conserved.
const BOUNDED: &str = "; the energy error stays bounded while steps resolve the motion";
/// What pieces of a Hamiltonian keep.
const KEPT_BY_PIECES: &str = "momenta that every piece conserves (p, spin, vorticity, angular momenta, where the model \
     conserves them) and Casimirs";
/// What pieces are beside forces that no potential has, and what they keep.
const PIECES_WITH_WORK: &str = "kicks of forces and the fading of momenta by friction are pieces among the symplectic ones, and \
     their work is exact in each; kept up to rounding: momenta that every piece conserves";

/// Why a trajectory was computed the way it was; displays as text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Why {
    description: &'static Description,
    computation: Computation,
}

impl<const N: usize, P: Phase<N>> Trajectory<N, P> {
    /// Which method ran and why, what the derivation of the model left out, and what the start let the run leave
    /// out.
    #[must_use]
    pub fn why(&self) -> Why {
        Why { description: self.description, computation: self.computation }
    }
}

impl Why {
    fn method(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Computation { asked, method, tolerance, closed_form_exists, .. } = self.computation;
        match method {
            Method::ClosedForm if asked == Method::ClosedForm => {
                writeln!(f, "closed form, as asked for: exact up to rounding, no steps")
            }
            Method::ClosedForm => {
                writeln!(f, "closed form: this model has one from this start; exact up to rounding, no steps")
            }
            Method::RungeKutta8 | Method::RungeKutta5 | Method::Automatic => {
                let order = if method == Method::RungeKutta5 { 5 } else { 8 };
                write!(f, "Runge-Kutta of order {order}, relative error {tolerance:e} per step: ")?;
                match (asked, closed_form_exists) {
                    (Method::RungeKutta8 | Method::RungeKutta5, true) => {
                        writeln!(f, "as asked for; Method::Automatic would take the closed form")
                    }
                    (Method::RungeKutta8 | Method::RungeKutta5, false) => {
                        writeln!(f, "as asked for; there is no closed form")
                    }
                    _ => writeln!(f, "the model has no closed form from this start"),
                }
            }
            Method::Taylor { order } => {
                let order = order.unwrap_or(order_for(tolerance));
                write!(f, "Taylor series of order {order}, relative error {tolerance:e} per step: ")?;
                match (asked, closed_form_exists) {
                    (Method::Automatic, _) => writeln!(
                        f,
                        "the model has no closed form from this start, and at tolerances up to {TAYLOR_TOLERANCE:e} \
                         this is cheaper than Runge-Kutta"
                    ),
                    (_, true) => writeln!(f, "as asked for; Method::Automatic would take the closed form"),
                    (_, false) => writeln!(f, "as asked for; there is no closed form"),
                }
            }
            Method::RungeKuttaNystrom12 | Method::RungeKuttaNystrom8 => self.nystrom(f),
            Method::Gauss { stages, step } => self.gauss(f, stages, step),
            Method::Radau { stages } => self.radau(f, stages),
            Method::Rattle { order, step } => self.rattle(f, order, step),
            Method::Splitting { order, step } => self.splitting(f, order, step),
            Method::AdaptiveSplitting { order } => self.adaptive_splitting(f, order.unwrap_or(ORDER)),
        }
    }

    /// What [`Method::Automatic`] did without. Whether a tolerance allows steps by pieces, these alone tell for sure.
    fn not_emitted(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Computation { method, missing, stiffness, .. } = self.computation;
        match (missing, stiffness) {
            (Some(key), _) => {
                writeln!(
                    f,
                    "not emitted: `emit({key})` would give a method that is cheaper at this tolerance"
                )
            }
            (None, Some(radians)) if method == Method::RungeKutta8 => writeln!(
                f,
                "not emitted: with `emit(splitting)` a first step of {radians:.0} radians of the stiff dilatation would be tried, and \
                 splitting be taken, which is cheaper, where it meets this tolerance"
            ),
            _ => Ok(()),
        }
    }

    fn nystrom(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Computation { asked, method, tolerance, .. } = self.computation;
        let (order, range) = match method {
            Method::RungeKuttaNystrom8 => (8, "above"),
            _ => (12, "up to"),
        };
        write!(f, "Runge-Kutta-Nystrom of order {order}, relative error {tolerance:e} per step: ")?;
        match asked {
            Method::Automatic => writeln!(
                f,
                "the model has no closed form from this start, and its equations are q'' = f(t, q), for which this is \
                 cheaper than methods for equations of first order; order {order} at tolerances {range} \
                 {NYSTROM_TOLERANCE:e}"
            ),
            _ => writeln!(f, "as asked for; there is no closed form"),
        }
    }

    fn radau(&self, f: &mut fmt::Formatter<'_>, stages: Option<usize>) -> fmt::Result {
        let Computation { tolerance, friction, stiff_since, .. } = self.computation;
        let stages = stages.unwrap_or(Tableau::for_tolerance(tolerance).stages());
        let order = 2 * stages - 1;
        write!(f, "Radau IIA of {stages} stages, order {order}, relative error {tolerance:e} per step: ")?;
        match friction {
            Some(rate) => {
                write!(
                    f,
                    "friction takes velocities away at a rate of about {rate:.1e}, more than {STIFF_FRICTION} times "
                )?;
                match stiff_since {
                    Some(t) => write!(f, "from t = {t} on, where these steps began")?,
                    None => write!(f, "in this run")?,
                }
                writeln!(f, ": explicit steps would have to follow that, and these do not")
            }
            None => writeln!(f, "as asked for"),
        }
    }

    fn rattle(&self, f: &mut fmt::Formatter<'_>, order: usize, step: f64) -> fmt::Result {
        write!(f, "RATTLE of order {order}, equal steps of at most {step:e}")?;
        if let Some(residual) = self.computation.residual {
            write!(f, ", det phi = 1 solved to {residual:.1e}")?;
        }
        writeln!(f, ": as asked for")?;
        writeln!(
            f,
            "kept up to rounding: det phi = 1, tr(phi^-1 phi_dot) = 0, and what the model conserves of p, spin and \
             vorticity"
        )?;
        writeln!(f, "symplectic: the energy error stays bounded while steps resolve the motion")
    }

    fn splitting(&self, f: &mut fmt::Formatter<'_>, order: usize, step: f64) -> fmt::Result {
        writeln!(
            f,
            "splitting of order {order} by exact flows of pieces of H, equal steps of at most {step:e}: as asked for{}",
            if self.computation.closed_form_exists {
                "; Method::Automatic would take the closed form"
            } else {
                ""
            }
        )?;
        if has_work(self.description) {
            return writeln!(f, "{PIECES_WITH_WORK}");
        }
        writeln!(
            f,
            "symplectic: a Poisson map; kept up to rounding: {KEPT_BY_PIECES}{}",
            self.of_energy(BOUNDED)
        )?;
        if self.computation.closed_form_exists {
            return Ok(());
        }
        writeln!(f, "for what it keeps over long runs; Method::Automatic would take adaptive steps")
    }

    fn adaptive_splitting(&self, f: &mut fmt::Formatter<'_>, order: usize) -> fmt::Result {
        let Computation { tolerance, stiffness, closed_form_exists, .. } = self.computation;
        write!(
            f,
            "splitting of order {order} by exact flows of pieces of H, relative error {tolerance:e} per step: "
        )?;
        match (stiffness, closed_form_exists) {
            (Some(radians), _) => writeln!(
                f,
                "the dilatation is stiff and moves along its closed form: steps of more than {radians:.0} radians of it meet \
                 the tolerance, which is cheaper than to resolve it"
            ),
            (None, true) => writeln!(f, "as asked for; Method::Automatic would take the closed form"),
            (None, false) => writeln!(f, "as asked for"),
        }?;
        if has_work(self.description) {
            return writeln!(f, "{PIECES_WITH_WORK}; energy and work balance to the tolerance");
        }
        let energy = self.of_energy(": the energy is kept to the tolerance");
        writeln!(
            f,
            "kept up to rounding: {KEPT_BY_PIECES}; not symplectic, since steps follow the error{energy}"
        )
    }

    /// What is said of the energy, where that is conserved.
    fn of_energy(&self, words: &'static str) -> &'static str {
        if self.description.conserved.contains(&Conserved::Energy) { words } else { "" }
    }

    /// The group on which the steps were taken.
    fn group(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let chart = match self.description.constraint {
            Some(Constraint::Isochoric) => "SL(n), in the Cayley chart of unit determinant",
            Some(Constraint::Rigid) => "SO(n), in the Cayley chart",
            Some(Constraint::Conformal) => {
                "R+ SO(n), in the Cayley chart times the exponential of the dilatation"
            }
            None => return Ok(()),
        };
        match self.computation.method {
            Method::ClosedForm | Method::Rattle { .. } => Ok(()),
            Method::Splitting { .. } | Method::AdaptiveSplitting { .. } => {
                writeln!(f, "the flows that move phi are exponentials: it stays on the group up to rounding")
            }
            Method::Taylor { .. } => {
                writeln!(f, "steps in the space around the group: phi leaves it by the error of the steps")
            }
            _ => writeln!(f, "steps on {chart} around the placement: phi stays on the group up to rounding"),
        }
    }

    fn gauss(&self, f: &mut fmt::Formatter<'_>, stages: usize, step: f64) -> fmt::Result {
        write!(
            f,
            "Gauss collocation of {stages} stages, order {}, equal steps of at most {step:e}",
            2 * stages
        )?;
        if let Some(residual) = self.computation.residual {
            write!(f, ", stage equations solved to {residual:.1e}")?;
        }
        let rest = if self.computation.closed_form_exists {
            "; Method::Automatic would take the closed form"
        } else {
            ""
        };
        writeln!(f, ": as asked for{rest}")?;
        let of =
            if self.description.constraint.is_none() { "" } else { " that do not contain the placement" };
        writeln!(
            f,
            "kept up to rounding: linear and quadratic first integrals{of} of the reduced equations"
        )?;
        if self.is_canonical() && self.description.constraint.is_none() {
            let but = if has_work(self.description) { " but for forces that no potential has" } else { "" };
            writeln!(f, "symplectic{but}: the reduced variables are canonical{}", self.of_energy(BOUNDED))
        } else {
            writeln!(
                f,
                "not a Poisson map: the reduced variables are not all canonical; what else the model conserves is \
                 kept to the order of the method"
            )
        }
    }

    /// The reduced variables are positions and their momenta, all of them canonical; of `x` and a constant `p` the
    /// method takes the same step as of `x` and `p`.
    fn is_canonical(&self) -> bool {
        let groups = self.description.reduced;
        let holds = |quantity: Quantity| groups.iter().any(|group| group.quantity == quantity);
        let paired = holds(Quantity::Placement)
            && holds(Quantity::CanonicalMomentum)
            && (holds(Quantity::Position) || !holds(Quantity::LinearMomentum));
        let is_canonical = |quantity: Quantity| {
            use Quantity::{CanonicalMomentum, LinearMomentum, Placement, Position};
            // Functions of `det phi` that are integrated beside the placement follow from it, and nothing follows from the work.
            matches!(quantity, Position | Placement | LinearMomentum | CanonicalMomentum)
                || matches!(quantity, Quantity::InverseDilatation | Quantity::MeanLogStretch | Quantity::Work)
        };
        paired && groups.iter().all(|group| is_canonical(group.quantity))
    }

    /// What the start and the velocities on the way are worth, where the kinetic energy is nearly degenerate.
    fn condition(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.computation.condition {
            Some(condition) if condition > WORTH_SAYING => writeln!(
                f,
                "nearly degenerate: the kinetic energy has the condition number {condition:.1e}, so that velocities and \
                 momenta determine each other to {:.0e}, whatever the tolerance",
                condition * f64::EPSILON
            ),
            _ => Ok(()),
        }
    }

    /// Is what this kind of run leaves out left out of this one?
    fn leaves_out(&self, scope: Scope) -> bool {
        let Computation { method, .. } = self.computation;
        let is_reduced = !matches!(method, Method::ClosedForm | Method::Rattle { .. });
        // The others compute it from the rest of the state.
        let integrates_all =
            matches!(method, Method::RungeKutta8 | Method::RungeKutta5 | Method::Taylor { .. });
        match scope {
            Scope::Model => true,
            Scope::Reduction => is_reduced,
            Scope::Carried => integrates_all,
            Scope::ClosedForm => method == Method::ClosedForm,
        }
    }

    /// What the run asked of itself beyond what it was asked.
    fn tolerance(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Computation { method, tolerance, tolerance_asked, .. } = self.computation;
        if tolerance == tolerance_asked || method.step().is_some() || method == Method::ClosedForm {
            return Ok(());
        }
        writeln!(
            f,
            "a tolerance of {tolerance:e} in place of {tolerance_asked:e}: the mass matrix may degenerate at some placements, and \
             larger errors lead motions onto them that only pass near"
        )
    }

    /// Whether the steps see what the time does.
    fn turns(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.computation.turns {
            Some((part, turns)) if turns > 1.0 => writeln!(
                f,
                "`{part}` makes {turns:.1} turns within one step: what changes faster than the steps is seen at a few points of its \
                 periods, and the error of its mean adds up; compare with a smaller tolerance, or with equal steps that resolve it"
            ),
            _ => Ok(()),
        }
    }

    /// Digits of the determinant that a flat body has lost, or one that is stretched far.
    fn distortion(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.computation.distinctness {
            left if left < HALF_LOST => writeln!(
                f,
                "flat at the end, or stretched far: det phi is {left:.0e} of the products that it is the sum of, so that it, the \
                 inverse of phi, and momenta in the other frame have only {:.0} digits there",
                f64::max(0.0, libm::log10(left / f64::EPSILON))
            ),
            _ => Ok(()),
        }
    }

    /// What the energy says of the run, where that is nothing good.
    fn energy(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Computation { method, tolerance, energy_defect, .. } = self.computation;
        match method.step() {
            None if energy_defect > 0.0 => writeln!(
                f,
                "the energy is off by {energy_defect:.1e} of the largest |T| + |U|, {:.0e} tolerances: compare with a run at a \
                 smaller tolerance",
                energy_defect / tolerance
            ),
            Some(_) if energy_defect > 0.0 => writeln!(
                f,
                "the energy is off by {energy_defect:.1e} of the largest |T| + |U|: the steps do not resolve the motion; \
                 compare with shorter ones"
            ),
            _ => Ok(()),
        }
    }

    /// Directions in which the kinetic energy is negative, which a slip of a sign gives too.
    fn signature(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.description.signature {
            Some((positive, negative)) if negative > 0 => writeln!(
                f,
                "the kinetic energy is indefinite: {positive} positive directions, {negative} negative ones"
            ),
            _ => Ok(()),
        }
    }

    fn power(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.computation.unresolved_power {
            0.0 => Ok(()),
            times => writeln!(
                f,
                "within one step the forces that no potential has would take {times:.1e} times the energy of the body: these \
                 steps turn velocities around that friction ends; take Method::Radau, or shorter steps"
            ),
        }
    }

    fn arithmetic(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(there) = self.computation.fused_before else { return Ok(()) };
        let here = FusedArithmetic::here();
        writeln!(
            f,
            "goes on from another machine: multiply-adds were fused {there} there, and are fused {here} here; no uninterrupted \
             run has the same last bits"
        )
    }

    fn scene(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Computation { method, no_whirl, at_rest, .. } = self.computation;
        // Where a force acts on the centre of mass, it does not stay at rest.
        let stays = self.description.conserved.contains(&Conserved::LinearMomentum);
        if at_rest && stays {
            writeln!(f, "left out of this run: p = 0, the centre of mass exerts nothing on the placement")?;
        }
        if no_whirl && method == Method::ClosedForm {
            writeln!(f, "left out of this run: the skew factor, which is 1 without vorticity or spin")?;
        }
        Ok(())
    }
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.description.name)?;
        self.method(f)?;
        self.not_emitted(f)?;
        self.group(f)?;
        self.signature(f)?;
        self.condition(f)?;
        let applies = |left_out: &&LeftOut| self.leaves_out(left_out.scope);
        for left_out in self.description.left_out.iter().filter(applies) {
            writeln!(f, "left out of the model: {}", left_out.what)?;
        }
        self.scene(f)?;
        self.arithmetic(f)?;
        self.tolerance(f)?;
        self.turns(f)?;
        self.power(f)?;
        self.distortion(f)?;
        self.energy(f)
    }
}
