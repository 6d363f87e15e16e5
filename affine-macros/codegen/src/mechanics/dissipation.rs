//! Rayleigh's dissipation function `R`: a quadratic form in the velocities, whose slopes are forces.
//!
//! `Q_hat = -(dR/dOh)^T`, `Q = -(dR/dOm)^T`, `N = -(dR/dphi_dot)^T`, each in the frame in which its part of `R` has
//! constant coefficients, and `Q_tr = -dR/dx_dot`. By Euler's theorem on homogeneous functions their power is `-2 R`
//! (Goldstein, *Classical Mechanics*, section 1.5).

mod invariance;

use crate::algebra::ring::{Square, dot, product, sum, table, times, trace_of_product, transpose};
use crate::algebra::{Arena, Polynomial, Rational};
use crate::symbol::Quantity;

use super::charts::{Chart, Linear};
use super::equations::Load;
use super::hessian::Hessian;
use super::kinetic::Kinetic;
use super::metrics::Metrics;
use super::shared::{CentreVelocity, Shared, on_momenta};
use super::term::{Coefficient, Frame, Term};
use super::transport;

/// A dissipation function.
#[derive(Clone, Debug)]
pub struct Dissipation {
    dim: usize,
    /// The forms in the affine velocity, one for each frame in which some terms are constant.
    pub parts: Vec<Part>,
    /// The coefficients of `1/2 |phi^-1 x_dot|^2` (`Body`) and `1/2 |x_dot|^2` (`Space`).
    pub centre: Vec<(Frame, Polynomial)>,
}

/// The terms that have constant coefficients in one frame.
#[derive(Clone, Debug)]
pub struct Part {
    /// The form, written as a kinetic energy is.
    pub form: Kinetic,
    /// Its Hessian on the affine velocities.
    pub hessian: Hessian,
}

impl Part {
    /// `-(dR/dO)^T` at a velocity `o` of its frame, in the ring of the velocity.
    fn force(&self, o: &Square<Polynomial>) -> Square<Polynomial> {
        let flat = o.concat();
        table(o.len(), |a, b| dot(self.hessian.matrix[b * o.len() + a].iter().zip(&flat)).neg())
    }
}

impl Dissipation {
    /// The sum of `terms`. The Casimir terms, which have constant coefficients in both affine frames, count with the
    /// terms of the body, or else with those of space, or else with the frame `own` of the kinetic energy.
    pub fn new(arena: &mut Arena, dim: usize, own: Frame, terms: &[Term]) -> Self {
        let has = |frame: Frame| terms.iter().any(|term| term.kind.internal_frame() == Some(frame));
        let either = match own {
            _ if has(Frame::Body) => Frame::Body,
            _ if has(Frame::Space) => Frame::Space,
            Frame::Flat => Frame::Body,
            own => own,
        };
        let mut parts = Vec::new();
        for frame in [Frame::Body, Frame::Space, Frame::Flat] {
            let internal = terms.iter().filter(|term| term.kind.translation_frame().is_none());
            let of_frame = |term: &&Term| term.kind.internal_frame().unwrap_or(either) == frame;
            let of_frame: Vec<Term> = internal.filter(of_frame).cloned().collect();
            if !of_frame.is_empty() {
                let form = Kinetic::in_frame(arena, dim, frame, &of_frame, None);
                parts.push(Part { hessian: Hessian::new(&form), form });
            }
        }
        let mut centre = Vec::new();
        for term in terms {
            if let (Some(frame), Coefficient::Scalar(c)) = (term.kind.translation_frame(), &term.value) {
                centre.push((frame, Polynomial::normal_form(arena, *c)));
            }
        }
        Self { dim, parts, centre }
    }

    /// With the blocks of its Hessians in rational bases, from its terms in the user's.
    pub fn decide_by(&mut self, arena: &mut Arena, metrics: &Metrics, stated: &[Term]) {
        for part in &mut self.parts {
            let of_part = |term: &&Term| part.form.terms.iter().any(|own| own.kind == term.kind);
            let terms: Vec<Term> = stated.iter().filter(of_part).cloned().collect();
            part.form.congruent = metrics.congruent(arena, &part.form, &terms);
            part.hessian = Hessian::new(&part.form);
        }
    }

    /// What is left of it while the centre of mass is at rest.
    pub fn at_rest(&self) -> Option<Self> {
        (!self.parts.is_empty()).then(|| Self { centre: Vec::new(), ..self.clone() })
    }

    /// Does it slow the centre of mass?
    pub fn slows_the_centre(&self) -> bool {
        !self.centre.is_empty()
    }

    /// What it adds to Hamilton's equations of a chart, with its power `-2 R`.
    pub fn load(&self, arena: &mut Arena, chart: &Chart, velocity: &CentreVelocity) -> Load {
        let mut shared = Shared { arena, list: Vec::new() };
        let (affine, mut power) = self.affine_force(&mut shared, chart);
        let centre = self.centre_force(&mut shared, chart, velocity, &mut power);
        let forces = on_momenta(chart, &affine, centre);
        let work = shared.arena.symbol(Quantity::Work);
        Load { shared: shared.list, kernels: Vec::new(), forces, work: Some((work, power)) }
    }

    /// The force on the affine momentum of the chart, and its power. What has constant coefficients in another frame
    /// goes through `phi_dot` and the force `N` on `Pi`, so that `phi^-1` stands once on each way.
    fn affine_force(&self, shared: &mut Shared, chart: &Chart) -> (Square<Polynomial>, Polynomial) {
        let n = self.dim;
        let phi = chart.placement();
        let own = chart.velocity(shared.arena).atoms();
        let phi_dot = shared.phi_dot(chart);
        let zero = table(n, |_, _| Polynomial::zero());
        let (mut force, mut push, mut power) = (zero.clone(), zero, Polynomial::zero());
        for part in &self.parts {
            let frame = part.form.frame;
            let at_home = frame == chart.frame();
            let velocity = match frame {
                _ if at_home => own.clone(),
                Frame::Body => {
                    product(&shared.inverse(&phi), &shared.matrix(Quantity::PlacementVelocity, &phi_dot))
                }
                Frame::Space => {
                    product(&shared.matrix(Quantity::PlacementVelocity, &phi_dot), &shared.inverse(&phi))
                }
                Frame::Flat => phi_dot.clone(),
            };
            let velocity = if at_home { velocity } else { shared.matrix(frame.velocity(), &velocity) };
            let drag = shared.matrix(drag(frame), &part.force(&velocity));
            power = power.add(&trace_of_product(&drag, &velocity));
            match frame {
                _ if at_home => force = sum(&force, &drag),
                Frame::Flat => push = sum(&push, &drag),
                Frame::Body | Frame::Space => {
                    push = sum(&push, &transport::momentum(frame, &drag, &shared.inverse(&phi)));
                }
            }
        }
        let push = shared.matrix(Quantity::Push, &push);
        let rest = transport::momentum(chart.frame(), &push, &phi);
        (sum(&force, &rest), power)
    }

    /// `Q_tr`, or `phi^T Q_tr` beside `p_hat`; nothing where the chart has no `p`. Adds its power.
    fn centre_force(
        &self,
        shared: &mut Shared,
        chart: &Chart,
        velocity: &CentreVelocity,
        power: &mut Polynomial,
    ) -> Vec<Polynomial> {
        let Some(linear) = chart.linear else { return Vec::new() };
        let (own, inverse_mass) = match velocity {
            CentreVelocity::Fixed => return Vec::new(),
            CentreVelocity::PerMass(own, inverse_mass) => (own, inverse_mass),
            // `Q_tr = -(c_space 1 + c_body phi^-T phi^-1) x_dot`.
            CentreVelocity::Defined { x_dot, v_hat } => {
                let x_dot = Polynomial::vector(x_dot);
                let slope = |shared: &mut Shared, frame: Frame| match frame {
                    Frame::Body => {
                        let inverse = shared.inverse(&chart.placement());
                        let v_hat = match v_hat {
                            Some(known) => Polynomial::vector(known),
                            None => shared.vector(Quantity::ComovingCentreVelocity, &times(&inverse, &x_dot)),
                        };
                        times(&transpose(&inverse), &v_hat)
                    }
                    _ => x_dot.clone(),
                };
                let force = self.drag_on_centre(shared, slope);
                *power = power.add(&dot(force.iter().zip(&x_dot)));
                return force;
            }
        };
        let phi = chart.placement();
        let p = Polynomial::vector(&chart.p);
        let p_hat = match linear {
            Linear::Body => p.clone(),
            Linear::Space if self.centre.iter().any(|(frame, _)| frame != own) || *own == Frame::Body => {
                shared.vector(Quantity::ComovingLinearMomentum, &times(&transpose(&phi), &p))
            }
            Linear::Space => Vec::new(),
        };
        let per_mass =
            |v: &[Polynomial]| -> Vec<Polynomial> { v.iter().map(|c| c.mul(inverse_mass)).collect() };
        // The velocity conjugate to the chart's linear momentum.
        let velocity = match (linear, own) {
            (Linear::Space, Frame::Body) => times(&phi, &per_mass(&p_hat)),
            _ => per_mass(&p),
        };
        // p = m v in the frame of the mass: there the force is a multiple of the momentum.
        let slope = |shared: &mut Shared, frame: Frame| match (frame == *own, linear, frame) {
            (true, ..) => per_mass(&p),
            (false, Linear::Body, _) => times(&transpose(&phi), &times(&phi, &per_mass(&p))),
            (false, Linear::Space, Frame::Space) => velocity.clone(),
            (false, Linear::Space, _) => {
                let inverse = shared.inverse(&phi);
                let v_hat = shared.vector(Quantity::ComovingCentreVelocity, &times(&inverse, &per_mass(&p)));
                times(&transpose(&inverse), &v_hat)
            }
        };
        let force = self.drag_on_centre(shared, slope);
        *power = power.add(&dot(force.iter().zip(&velocity)));
        force
    }

    /// The force on a centre of mass along which the coefficient of a frame has this slope.
    fn drag_on_centre(
        &self,
        shared: &mut Shared,
        slope: impl Fn(&mut Shared, Frame) -> Vec<Polynomial>,
    ) -> Vec<Polynomial> {
        let mut force = vec![Polynomial::zero(); self.dim];
        for (frame, coefficient) in &self.centre {
            for (sum, slope) in force.iter_mut().zip(&slope(shared, *frame)) {
                sum.add_product(slope, coefficient, &Rational::MINUS_ONE);
            }
        }
        shared.vector(Quantity::CentreDrag, &force)
    }
}

/// The force in a frame.
fn drag(frame: Frame) -> Quantity {
    match frame {
        Frame::Body => Quantity::ComovingDrag,
        Frame::Space => Quantity::Drag,
        Frame::Flat => Quantity::FlatDrag,
    }
}
