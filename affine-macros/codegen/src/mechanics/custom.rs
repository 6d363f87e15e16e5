//! Forces and potentials that a field of the model or a function of the runtime computes.
//!
//! The equations call it: its results are quantities like any other. What is known of it is what the
//! specification says: the form of a force and whether it has power, the class of a potential.

use crate::algebra::kernel::{Asked, Callee, Group};
use crate::algebra::residue::Residue;
use crate::algebra::ring::{self, Square, dot, product, sum, table, times, trace_of_product, transpose};
use crate::algebra::{Arena, Expr, Kernel, Matrix, Polynomial, Rational};
use crate::symbol::Quantity;

use super::charts::{Chart, Linear, Momentum};
use super::conserved::{Conservation, Momenta};
use super::equations::Load;
use super::group_point::{GroupPoint, inverse};
use super::shared::{CentreVelocity, Shared, on_momenta};
use super::term::Frame;
use super::transport;

/// A field, or a function of the runtime, that computes a force or a potential.
#[derive(Clone, Debug)]
pub struct Custom {
    /// Its place among them, from 1; fields come first.
    pub place: usize,
    /// Its name.
    pub name: String,
    /// What it computes.
    pub role: Role,
    /// Which of both it is.
    pub by: By,
}

/// What computes a force or a potential.
#[derive(Clone, Copy, Debug)]
pub enum By {
    /// A field of the model.
    Field,
    /// The gravity of a homogeneous ellipsoid on itself, `-3/5 k R_F(Q_1^2, Q_2^2, Q_3^2)` with this `k`.
    SelfGravity(Expr),
}

impl By {
    /// What an energy is in units of what is called for it.
    pub(super) fn unit(self, arena: &mut Arena) -> Polynomial {
        match self {
            Self::Field => Polynomial::constant(Rational::ONE),
            Self::SelfGravity(strength) => {
                let three_fifths = &Rational::from(3) * &Rational::one_over(5);
                Polynomial::normal_form(arena, strength).scaled(&-&three_fifths)
            }
        }
    }
}

/// What a field computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A force.
    Force {
        /// On which momentum.
        on: On,
        /// It has no power.
        gyroscopic: bool,
        /// It depends on no velocity: what it is told of one is zero.
        at_rest: bool,
    },
    /// A potential.
    Potential {
        /// Under which rotations it does not change.
        class: Class,
        /// It depends on `x`.
        moves: bool,
    },
}

/// The momentum that a force acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum On {
    /// `Q` on `Sigma`.
    Space,
    /// `Q_hat` on `Sigma_hat`.
    Body,
    /// `Q_tr` on `p`.
    Centre,
}

/// Rotations that leave a potential unchanged, `U(A phi B) = U(phi)`; the runtime knows them by their numbers in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// All rotations of space and body: a function of the stretches.
    Isotropic,
    /// Those of space: a function of `G`.
    Green,
    /// Those of the body: a function of `Ct`.
    Finger,
    /// None that is known.
    General,
}

impl Class {
    fn keeps_spin(self) -> bool {
        matches!(self, Self::Isotropic | Self::Green)
    }

    fn keeps_vorticity(self) -> bool {
        matches!(self, Self::Isotropic | Self::Finger)
    }
}

impl Custom {
    /// What it adds to Hamilton's equations of a chart.
    pub fn load(&self, arena: &mut Arena, chart: &Chart, velocity: &CentreVelocity) -> Load {
        let mut shared = Shared { arena, list: Vec::new() };
        let (kernel, affine, centre, work) = match self.role {
            Role::Force { on, gyroscopic, at_rest } => {
                self.force(&mut shared, chart, velocity, (on, gyroscopic, at_rest))
            }
            Role::Potential { class, moves } => self.slopes(&mut shared, chart, class, moves),
        };
        let centre = match chart.linear {
            // phi^T Q_tr
            Some(Linear::Body) if !centre.is_empty() => times(&transpose(&chart.placement()), &centre),
            _ => centre,
        };
        let forces = on_momenta(chart, &affine, centre);
        let work = work.map(|power| (shared.arena.symbol(Quantity::Work), power));
        Load { shared: shared.list, kernels: vec![kernel], forces, work }
    }

    fn force(
        &self,
        shared: &mut Shared,
        chart: &Chart,
        centre: &CentreVelocity,
        (on, gyroscopic, at_rest): (On, bool, bool),
    ) -> Parts {
        let n = chart.dim;
        let phi_dot = shared.phi_dot(chart);
        let phi_dot = shared.matrix(Quantity::PlacementVelocity, &phi_dot);
        let x_dot = shared.x_dot(chart, centre);
        let mut arguments = vec![Group::Scalar(Polynomial::atom(shared.arena.symbol(Quantity::Time)))];
        arguments.extend(placed(chart));
        let zero = table(n, |_, _| Polynomial::zero());
        let told = if at_rest { (Vec::new(), zero.clone()) } else { (x_dot.clone(), phi_dot.clone()) };
        arguments.push(Group::Vector(or_zero(told.0, n)));
        arguments.push(Group::Matrix(told.1));
        let mut centre = vec![Polynomial::zero(); chart.p.len()];
        let mut affine = zero;
        let power;
        let (name, results) = match on {
            On::Centre => {
                let push = self.vector(shared.arena, n);
                centre = Polynomial::vector(&push[..x_dot.len()]);
                power = dot(centre.iter().zip(&x_dot));
                ("translational_force", Group::Vector(push))
            }
            On::Space | On::Body => {
                let (home, name) = match on {
                    On::Space => (Frame::Space, "spatial_force"),
                    _ => (Frame::Body, "comoving_force"),
                };
                let symbols = self.matrix(shared.arena, Quantity::FieldForce, n);
                let force = symbols.atoms();
                let phi = chart.placement();
                if home == chart.frame() {
                    let own = chart.velocity(shared.arena).atoms();
                    power = trace_of_product(&force, &own);
                    affine = force;
                } else {
                    let push = transport::momentum(home, &force, &shared.inverse(&phi));
                    let push = shared.matrix(Quantity::FieldPush.at([self.place]), &push);
                    power = trace_of_product(&push, &phi_dot);
                    affine = transport::momentum(chart.frame(), &push, &phi);
                }
                (name, Group::Matrix(symbols.0))
            }
        };
        let callee = Callee::Custom(self.place, Asked::Force(name, gyroscopic));
        let kernel = Kernel { callee, arguments, results: vec![results] };
        (kernel, affine, centre, (!gyroscopic).then_some(power))
    }

    /// The gravity of a homogeneous ellipsoid on itself.
    pub fn self_gravity(place: usize, strength: Expr) -> Self {
        let role = Role::Potential { class: Class::Isotropic, moves: false };
        Self { place, name: "self_gravity".to_owned(), role, by: By::SelfGravity(strength) }
    }

    /// `Q_tr = -dU/dx` and the force `-(dU/dphi)^T` on `Pi`.
    fn slopes(&self, shared: &mut Shared, chart: &Chart, class: Class, moves: bool) -> Parts {
        let n = chart.dim;
        let (along_x, along_phi) =
            (self.vector(shared.arena, n), self.matrix(shared.arena, Quantity::FieldSlope, n));
        let opposite = self.by.unit(shared.arena).neg();
        let negative = |symbol: &Expr| opposite.mul(&Polynomial::atom(*symbol));
        let push = table(n, |a, i| negative(&along_phi.0[i][a]));
        let affine = transport::momentum(chart.frame(), &push, &chart.placement());
        let centre = match (moves, chart.linear) {
            (true, Some(_)) => along_x.iter().map(negative).collect(),
            _ => vec![Polynomial::zero(); chart.p.len()],
        };
        let slopes = Group::Matrix(along_phi.0);
        let kernel = match self.by {
            By::Field => Kernel {
                callee: Callee::Custom(self.place, Asked::Slopes(class as u8, moves)),
                arguments: placed(chart),
                results: vec![Group::Vector(along_x), slopes],
            },
            By::SelfGravity(_) => Kernel {
                callee: Callee::EllipsoidalSlopes,
                arguments: vec![Group::Matrix(chart.placement())],
                results: vec![slopes],
            },
        };
        (kernel, affine, centre, None)
    }

    /// The energy of a potential at a point of a chart, and the call that gives it.
    pub fn energy(&self, arena: &mut Arena, chart: &Chart) -> Option<(Polynomial, Kernel)> {
        let Role::Potential { class, moves } = self.role else { return None };
        let energy = arena.symbol(Quantity::FieldPotential.at([self.place]));
        let (callee, arguments) = match self.by {
            By::Field => (Callee::Custom(self.place, Asked::Energy(class as u8, moves)), placed(chart)),
            By::SelfGravity(_) => (Callee::Ellipsoidal, vec![Group::Matrix(chart.placement())]),
        };
        let kernel = Kernel { callee, arguments, results: vec![Group::Scalar(energy)] };
        Some((self.by.unit(arena).mul(&Polynomial::atom(energy)), kernel))
    }

    /// What it leaves of what a chart conserves, whatever the field computes: any force of its form, any slopes of its class.
    pub fn keep(&self, arena: &mut Arena, chart: &Chart, conservation: &mut Conservation) {
        let energy = match self.role {
            Role::Force { gyroscopic, .. } => gyroscopic,
            Role::Potential { .. } => true,
        };
        let placed = Chart::new(arena, chart.dim, Momentum::Body, Some(Linear::Space));
        let rates = |seed| self.rates(&GroupPoint::numbered(arena, &placed, chart.confined, seed), chart);
        conservation.under_forces(arena, energy, &rates);
    }

    /// The rates of the momenta by a force of its form.
    fn rates(&self, point: &GroupPoint, chart: &Chart) -> Momenta {
        let n = chart.dim;
        let any = |k: usize| point.random(format!("{} of {}", k, self.name));
        let square = |k: usize| table(n, |a, b| any(n * (n * k + a) + b));
        let phi = table(n, |i, a| point.value(&Quantity::Placement.at([i + 1, a + 1])));
        let x: Vec<Residue> = (1..=n).map(|i| point.value(&Quantity::Position.at([i]))).collect();
        let symmetric = || sum(&square(1), &transpose(&square(1)));
        let nothing = table(n, |_, _| Residue::ZERO);
        let (on_centre, on_pi) = match self.role {
            Role::Force { on: On::Centre, .. } => (true, nothing),
            Role::Force { on: On::Space, .. } => (false, product(&inverse(&phi), &square(1))),
            Role::Force { on: On::Body, .. } => (false, product(&square(1), &inverse(&phi))),
            Role::Potential { class, moves } => (
                moves,
                match class {
                    Class::General => square(1),
                    Class::Green => product(&symmetric(), &transpose(&phi)),
                    Class::Finger => product(&transpose(&phi), &symmetric()),
                    Class::Isotropic => product(&isotropic(&phi, &any), &transpose(&phi)),
                },
            ),
        };
        let on_p: Vec<Residue> = (0..n).map(|i| if on_centre { any(i) } else { Residue::ZERO }).collect();
        let on_pi = match chart.confined {
            Some(group) => product(&inverse(&phi), &group.projected(&product(&phi, &on_pi))),
            None => on_pi,
        };
        Momenta::by_forces((&x, &phi), &on_p, &on_pi)
    }

    /// Does the centre of mass move as without it, and need not be known to it?
    pub fn leaves_the_centre(&self) -> bool {
        matches!(self.role, Role::Potential { moves: false, .. })
    }

    /// Can it push a centre of mass that is at rest?
    pub fn pushes_from_rest(&self) -> bool {
        matches!(self.role, Role::Force { on: On::Centre, .. } | Role::Potential { moves: true, .. })
    }

    /// Does it look the same from every direction of space?
    pub fn is_isotropic_in_space(&self) -> bool {
        matches!(self.role, Role::Potential { class, moves: false } if class.keeps_spin())
    }

    /// A potential that the squared vorticity (body) or spin (space) of `H` commutes with?
    pub fn commutes_with_rotation(&self, frame: Frame) -> bool {
        match (self.role, frame) {
            (Role::Potential { class, .. }, Frame::Body) => class.keeps_vorticity(),
            (Role::Potential { class, .. }, _) => class.keeps_spin(),
            (Role::Force { .. }, _) => false,
        }
    }

    fn vector(&self, arena: &mut Arena, n: usize) -> Vec<Expr> {
        arena.components(Quantity::FieldPull.at([self.place]), n)
    }

    fn matrix(&self, arena: &mut Arena, of: Quantity, n: usize) -> Matrix {
        Matrix::symbols(arena, of.at([self.place]), n)
    }
}

/// Any isotropic function of `G`: a sum of its powers, of which a matrix has no more than its rows.
fn isotropic(phi: &Square<Residue>, any: &dyn Fn(usize) -> Residue) -> Square<Residue> {
    let (n, green) = (phi.len(), product(&transpose(phi), phi));
    // Horner's scheme.
    (0..n).fold(ring::scalar(n, &Residue::ZERO), |value, k| {
        sum(&product(&value, &green), &ring::scalar(n, &any(n + k)))
    })
}

/// A call, forces on the affine momentum of the chart and on `p`, power of what is no potential.
type Parts = (Kernel, Square<Polynomial>, Vec<Polynomial>, Option<Polynomial>);

/// `x, phi`; `x = 0` where the chart has none.
fn placed(chart: &Chart) -> Vec<Group<Polynomial>> {
    let x = or_zero(Polynomial::vector(&chart.x), chart.dim);
    vec![Group::Vector(x), Group::Matrix(chart.placement())]
}

fn or_zero(vector: Vec<Polynomial>, n: usize) -> Vec<Polynomial> {
    if vector.is_empty() { vec![Polynomial::zero(); n] } else { vector }
}
