//! A kinetic energy by its Legendre transformation, whatever its mass matrix.
//!
//! The mass matrix of the internal motion stands on a basis of the admissible velocities. It is constant in one frame, or
//! `D^2` times such a matrix, and the velocity is a polynomial in the momentum; or it depends on the placement and is
//! factorised, and the velocity is a list of definitions. That of the centre of mass is constant in one frame, too, or
//! depends on the placement where there are masses in both.

use crate::algebra::ring::{Square, table};
use crate::algebra::{Arena, Polynomial, Rational};

use super::charts::{Chart, Linear, Momentum};
use super::constraint::Constraint;
use super::equations::{Form, Load};
use super::form::Mass;
use super::hamiltonian::Hamiltonian;
use super::hessian::NumericBlock;
use super::kinetic::Kinetic;
use super::kinetics::Kinetics;
use super::metric::{Definitions, share};
use super::mixed::{Internal, Legendre, Masses};
use super::momentum_side::Stated;
use super::shared::CentreVelocity;
use super::term::Frame;
use crate::symbol::Quantity;

/// A kinetic energy with its Legendre transformation inverted.
pub struct Motion {
    /// The energies, each with constant coefficients in its frame.
    pub parts: Vec<Kinetic>,
    /// The masses of the centre of mass.
    pub masses: Masses,
    inverse: Inverse,
    /// The equations of the internal motion in each form that may be the shortest, where the centre of mass, if there is one,
    /// is no part of its Hamiltonian.
    apart: Vec<(Kinetics, Form)>,
}

/// The inverse Legendre transformation of the internal motion.
enum Inverse {
    /// The velocity is a polynomial in the momentum. One mass is part of the Hamiltonian.
    Polynomial(Box<Hamiltonian>),
    /// The velocity is defined through the factorised mass matrix.
    Factorised(Box<Internal>),
}

impl Motion {
    /// Inverts the Legendre transformation of the parts; a cubic Hamiltonian stays as `stated`. `None` where it is
    /// degenerate.
    pub fn new(arena: &mut Arena, parts: Vec<Kinetic>, mass: Mass, stated: Option<&Stated>) -> Option<Self> {
        let masses = Masses::of(&parts);
        let cubic = stated.filter(|stated| stated.is_cubic());
        let inverse = match (mass, cubic) {
            (Mass::Constant(_), Some(stated)) => Inverse::Polynomial(Box::new(stated.hamiltonian(arena))),
            (Mass::Constant(hessian), None) => {
                Inverse::Polynomial(Box::new(Hamiltonian::new(arena, parts.first()?, &hessian)?))
            }
            (Mass::Factorised(internal), _) => Inverse::Factorised(internal),
        };
        let mut motion = Self { parts, masses, inverse, apart: Vec::new() };
        if motion.hamiltonian().is_none() {
            let chart = motion.chart(arena, false);
            motion.apart = motion.internal_kinetics(arena, &chart);
        }
        Some(motion)
    }

    /// The energies of the internal motion.
    pub fn internal(&self) -> impl Iterator<Item = &Kinetic> {
        self.parts.iter().filter(|part| !part.internal.is_empty())
    }

    /// Dimension of space.
    pub fn dim(&self) -> usize {
        match &self.inverse {
            Inverse::Polynomial(h) => h.dim,
            Inverse::Factorised(internal) => internal.velocity.dim(),
        }
    }

    /// `n^2` or the dimension of the group, and `n` more with translation.
    pub fn degrees_of_freedom(&self) -> usize {
        let n = self.dim();
        let internal = self.constraint().map_or(n * n, |group| group.dimension(n));
        internal + if self.masses.are_none() { 0 } else { n }
    }

    /// The group that the motion is confined to; `None` for GL+(n).
    pub fn constraint(&self) -> Option<Constraint> {
        self.parts.first().and_then(|part| part.constraint)
    }

    /// The frame of velocity and momentum.
    pub fn frame(&self) -> Frame {
        match &self.inverse {
            Inverse::Polynomial(h) => h.frame,
            Inverse::Factorised(internal) => internal.frame(),
        }
    }

    /// The affine momenta in which forces may be wanted, each for one frame.
    pub fn momenta(&self) -> Vec<Momentum> {
        self.hamiltonian().map_or_else(|| vec![Momentum::of(self.frame())], Hamiltonian::momenta)
    }

    /// The internal energy with its Hamiltonian, where the velocity is a polynomial in the momentum.
    pub fn polynomial(&self) -> Option<(&Kinetic, &Hamiltonian)> {
        match &self.inverse {
            Inverse::Polynomial(h) => self.parts.first().map(|kinetic| (kinetic, &**h)),
            Inverse::Factorised(_) => None,
        }
    }

    /// The Hamiltonian of the whole motion, where it is a polynomial in the coordinates of a chart.
    pub fn hamiltonian(&self) -> Option<&Hamiltonian> {
        self.polynomial().map(|(_, h)| h).filter(|_| !self.masses.are_mixed())
    }

    /// The factorised mass matrix of the internal motion, where it depends on the placement.
    pub fn factorised(&self) -> Option<&Internal> {
        match &self.inverse {
            Inverse::Polynomial(_) => None,
            Inverse::Factorised(internal) => Some(internal),
        }
    }

    /// Inverse blocks that only the fields' values give.
    pub fn numeric_blocks(&self) -> &[NumericBlock] {
        self.polynomial().map_or(&[], |(_, h)| &h.numeric_blocks)
    }

    /// Does the velocity determine the momentum? That of a cubic Hamiltonian does not.
    pub fn determines_momentum(&self) -> bool {
        let isotropic = self.polynomial().and_then(|(_, h)| h.isotropic.as_ref());
        isotropic.is_none_or(|iso| iso.casimir3.is_zero())
    }

    /// The chart of its own frame with spatial `p`, or without translation.
    pub fn chart(&self, arena: &mut Arena, moving: bool) -> Chart {
        let linear = (moving && !self.masses.are_none()).then_some(Linear::Space);
        Chart::new(arena, self.dim(), Momentum::of(self.frame()), linear).under(self.constraint())
    }

    /// The chart of the equations that users of other codes write down: all momenta in the model's frames.
    pub fn full_chart(&self, arena: &mut Arena) -> Chart {
        let translation = self.hamiltonian().and_then(|h| h.translation.as_ref());
        match (translation, self.frame()) {
            (Some((Frame::Body, _)), Frame::Body) => {
                let chart = Chart::new(arena, self.dim(), Momentum::Body, Some(Linear::Body));
                chart.under(self.constraint())
            }
            _ => self.chart(arena, true),
        }
    }

    /// The equations of the energy in a chart, but for what it [adds](Self::added), in each form that may be the shortest.
    pub fn kinetics(&self, arena: &mut Arena, chart: &Chart) -> Vec<(Kinetics, Form)> {
        match self.hamiltonian() {
            Some(_) => self.internal_kinetics(arena, chart),
            None => self.apart.iter().map(|(kinetics, form)| (kinetics.beside(chart), *form)).collect(),
        }
    }

    /// Those of what is left of it once the skew part of an isotropic energy, on demand, and the energy of a centre of mass
    /// that the chart does not have are split off; none where that is no polynomial in the chart.
    pub fn kinetics_without(&self, arena: &mut Arena, chart: &Chart, skew: bool) -> Vec<(Kinetics, Form)> {
        let Some(h) = self.hamiltonian() else { return self.kinetics(arena, chart) };
        let Some(mut energy) = h.internal_in(chart, skew) else { return Vec::new() };
        energy.add_scaled(&h.translation_in(chart), &Rational::ONE);
        in_both_forms(Kinetics::polynomial(arena, chart, &energy), h)
    }

    /// The equations of what is inverted, with one mass where that is part of it.
    fn internal_kinetics(&self, arena: &mut Arena, chart: &Chart) -> Vec<(Kinetics, Form)> {
        match &self.inverse {
            Inverse::Polynomial(h) => {
                in_both_forms(Kinetics::polynomial(arena, chart, &h.energy_in(chart)), h)
            }
            Inverse::Factorised(internal) => {
                let ways = internal.kinetics(arena).into_iter();
                ways.map(|kinetics| (kinetics, Form::ThroughVelocity)).collect()
            }
        }
    }

    /// What the weight of the energy, and the centre of mass where it is no part of the Hamiltonian, add to these equations,
    /// before any projection.
    pub fn added(&self, arena: &mut Arena, chart: &Chart) -> Option<Vec<Load>> {
        let weighted = self.polynomial().and_then(|(_, h)| h.weight.as_ref().map(|weight| (weight, h)));
        let mut loads: Vec<Load> =
            weighted.into_iter().map(|(weight, h)| weight.load(chart, &h.internal())).collect();
        if chart.linear.is_some() && !self.moves_in_hamiltonian() {
            loads.push(self.masses.kinetics(arena, chart)?.load());
        }
        Some(loads)
    }

    /// Is the energy of the centre of mass part of the Hamiltonian?
    fn moves_in_hamiltonian(&self) -> bool {
        self.polynomial().is_some_and(|(_, h)| h.translation.is_some())
    }

    /// All that moves the coordinates of a chart with spatial `p`, before any projection.
    pub fn loads(&self, arena: &mut Arena, chart: &Chart) -> Option<Vec<Load>> {
        let (kinetics, _) = self.kinetics(arena, chart).into_iter().next()?;
        let mut loads = self.added(arena, chart)?;
        loads.push(kinetics.load());
        Some(loads)
    }

    /// How the velocity of the centre of mass is known to forces.
    pub fn centre_velocity(&self, arena: &mut Arena) -> CentreVelocity {
        if self.moves_in_hamiltonian() || self.masses.are_none() {
            return self.polynomial().map_or(CentreVelocity::Fixed, |(_, h)| h.centre_velocity());
        }
        let n = self.dim();
        let x_dot = arena.components(Quantity::CentreVelocity, n);
        let v_hat = self.masses.body.map(|_| arena.components(Quantity::ComovingCentreVelocity, n));
        CentreVelocity::Defined { x_dot, v_hat }
    }

    /// The velocity `(dH/dM)^T` of the chart under the name that forces know, where the energy has another.
    pub fn velocity_names(&self, arena: &mut Arena, chart: &Chart) -> Load {
        let Some(internal) = self.factorised() else { return Load::default() };
        let symbols = chart.velocity(arena).0.concat();
        let values = internal.velocity.0.concat();
        let renamed = symbols.into_iter().zip(values).filter(|(name, symbol)| name != symbol);
        let shared = renamed.map(|(name, symbol)| (name, Polynomial::atom(symbol))).collect();
        Load { shared, ..Load::default() }
    }

    /// The affine velocity of its frame from the momentum, with what leads there.
    pub fn velocity(&self, arena: &mut Arena) -> (Definitions, Square<Polynomial>) {
        match &self.inverse {
            Inverse::Polynomial(h) => {
                let chart = self.chart(arena, false);
                let velocity = h.velocity.iter().map(|row| row.iter().map(|o| chart.reduced(o)).collect());
                (h.weight_definitions(), velocity.collect())
            }
            Inverse::Factorised(internal) => (internal.shared.clone(), internal.velocity.atoms()),
        }
    }

    /// `H` of the motion at a point of a chart, with what leads there.
    pub fn energy(&self, arena: &mut Arena, chart: &Chart) -> Option<(Definitions, Polynomial)> {
        let (mut shared, mut energy) = match &self.inverse {
            Inverse::Polynomial(h) => (h.weight_definitions(), chart.reduced(&h.energy_in(chart))),
            Inverse::Factorised(internal) => (internal.shared.clone(), internal.energy.clone()),
        };
        if chart.linear.is_some() && !self.moves_in_hamiltonian() {
            let (_, definitions) = self.masses.velocity(arena)?;
            share(&mut shared, definitions);
            energy.add_scaled(&self.masses.energy(arena, chart), &Rational::ONE);
        }
        Some((shared, energy))
    }

    /// The Legendre transformation of the internal motion in each form that may be the shortest; none where velocities do
    /// not determine momenta.
    pub fn legendre(&self, arena: &mut Arena) -> Vec<Legendre> {
        match (&self.inverse, self.parts.first()) {
            (Inverse::Factorised(internal), _) => internal.legendre(arena),
            (Inverse::Polynomial(h), Some(kinetic)) if self.determines_momentum() => {
                vec![of_a_constant_matrix(kinetic, h)]
            }
            _ => Vec::new(),
        }
    }
}

/// Through the velocity, and expanded but for tensors, in which nothing cancels.
fn in_both_forms(kinetics: Kinetics, h: &Hamiltonian) -> Vec<(Kinetics, Form)> {
    let expanded = (!h.is_tensor()).then(|| (kinetics.clone(), Form::Expanded));
    [(kinetics, Form::ThroughVelocity)].into_iter().chain(expanded).collect()
}

/// `X_ab = dT/dO_ba`, projected under a constraint, and `T_int`, both with the weight of the energy.
fn of_a_constant_matrix(kinetic: &Kinetic, h: &Hamiltonian) -> Legendre {
    let (energy, slopes) = (kinetic.internal_energy(), kinetic.momentum());
    let momentum = kinetic.confined().map_or_else(|| slopes.clone(), |group| group.projected(&slopes));
    let weighted = |value: &Polynomial| match &h.weight {
        Some(weight) => value.mul(&Polynomial::atom(weight.square)),
        None => value.clone(),
    };
    Legendre {
        shared: h.weight_definitions(),
        momenta: vec![(kinetic.frame, table(kinetic.dim, |a, b| weighted(&momentum[a][b])))],
        energy: weighted(&energy),
    }
}
