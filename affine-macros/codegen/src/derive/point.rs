//! Legendre transformation and energies at one point.

use std::slice::from_ref;

use crate::algebra::bind::Constants;
use crate::algebra::ring::Square;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::ir::fuse::fuse;
use crate::mechanics::body::Body;
use crate::mechanics::charts::Chart;
use crate::mechanics::forces::Forces;
use crate::mechanics::metric::{Definitions, share};
use crate::mechanics::mixed::Legendre;
use crate::mechanics::potential::{Base, Potential};
use crate::optimise::Batch;
use crate::symbol::{Frame, Quantity};

use super::batch::numbered;
use super::domain::domain;
use super::model::{MixedMasses, PointPrograms, VelocitySide};
use super::programs::shortest_program;

impl Body<'_> {
    /// The programs of a point of a chart.
    pub(super) fn programs(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        coefficients: &mut Constants,
    ) -> Option<PointPrograms> {
        let (n, frame) = (chart.dim, self.motion.frame());
        let phi = chart.phi.0.concat();
        let point = self.point(arena, chart);
        let domain = domain(arena, chart, self.potential, coefficients, &point);
        let mut program = |arena: &mut Arena, ways: &[Batch], inputs: &[Expr]| {
            let varies = |a: Expr| inputs.contains(&a) || phi.contains(&a);
            fuse(&shortest_program(arena, ways, coefficients, &varies))
        };
        let velocities = Matrix::symbols(arena, frame.velocity(), n);
        let [x_dot, v_hat, p] =
            [Quantity::CentreVelocity, Quantity::ComovingCentreVelocity, Quantity::LinearMomentum]
                .map(|of| arena.components(of, n));
        let moving = [x_dot.clone(), v_hat, moving_matrices(arena, n)].concat();
        let forms = self.motion.legendre(arena);
        let kinetic_energy = forms.first().map(|form| self.kinetic_energy(arena, form, &moving));
        let legendre = |Legendre { shared, momenta, .. }: Legendre| {
            let named = |(frame, values): (Frame, Square<Polynomial>)| {
                let names = Matrix::symbols(arena, frame.momentum(), n);
                matrix_batch(arena, &names, &values).results
            };
            let results = momenta.into_iter().flat_map(named).collect();
            given(arena, Batch { shared, results, ..Batch::default() }, &moving)
        };
        let legendre: Vec<Batch> = forms.into_iter().map(legendre).collect();
        let legendre = kinetic_energy.is_some().then(|| program(arena, &legendre, &moving));
        let (shared, values) = self.motion.velocity(arena);
        let velocity = Batch { shared, ..matrix_batch(arena, &velocities, &values) };
        let momenta = Matrix::symbols(arena, frame.momentum(), n).0.concat();
        let velocity = program(arena, from_ref(&velocity), &momenta);
        let velocity_side = legendre.zip(kinetic_energy).map(|(legendre, energy)| VelocitySide {
            legendre,
            kinetic_energy: program(arena, from_ref(&energy), &moving),
        });
        let power = self.power(arena, chart)?.map(|batch| program(arena, from_ref(&batch), &point));
        let near = self.potential.map(|u| u.energy_at_a_point(arena, chart));
        let near = self.hamiltonian(arena, chart, near)?;
        let far_away = match self.potential.and_then(|u| u.energy_far_away(arena, chart)) {
            Some(value) => Some(self.hamiltonian(arena, chart, Some(value))?),
            None => None,
        };
        let hamiltonian = program(arena, from_ref(&near), &point);
        let hamiltonian_far_away = far_away.map(|batch| program(arena, from_ref(&batch), &point));
        let mass = self.mass(arena).map(|batch| program(arena, from_ref(&batch), &[]));
        let mixed_masses = match self.motion.masses.are_mixed() {
            true => {
                let [momentum, velocity] = self.centre(arena, &x_dot)?;
                let momentum = program(arena, &[given(arena, momentum, &moving)], &moving);
                Some(MixedMasses { momentum, velocity: program(arena, from_ref(&velocity), &p) })
            }
            false => None,
        };
        let isotropic = self.isotropic().map(|batch| program(arena, from_ref(&batch), &[]));
        Some(PointPrograms {
            velocity_side,
            velocity,
            mass,
            mixed_masses,
            hamiltonian,
            hamiltonian_far_away,
            domain,
            power,
            isotropic,
        })
    }

    /// What functions of a point read.
    fn point(&self, arena: &mut Arena, chart: &Chart) -> Vec<Expr> {
        let mut inputs = self.inputs(arena, chart);
        if self.potential.is_some() {
            inputs.extend(placement_inputs(arena, chart.dim));
        }
        inputs
    }

    /// `1/m` where there is one mass, and `m` where momenta are determined by velocities.
    fn mass(&self, arena: &mut Arena) -> Option<Batch> {
        let mass = self.motion.masses.single()?;
        let mut results = vec![(Quantity::InverseMass.into(), Polynomial::reciprocal(arena, mass)?)];
        if self.motion.determines_momentum() {
            results.push((Quantity::Mass.into(), Polynomial::normal_form(arena, mass)));
        }
        Some(Batch { results, ..Batch::default() })
    }

    /// The Legendre transformation of a centre of mass with two masses, and its inverse.
    fn centre(&self, arena: &mut Arena, x_dot: &[Expr]) -> Option<[Batch; 2]> {
        let (_, shared) = self.motion.masses.velocity(arena)?;
        let (definitions, momentum, _) = self.motion.masses.legendre(arena, x_dot);
        let results = numbered(Quantity::LinearMomentum, momentum).collect();
        let momentum = Batch { shared: definitions, results, ..Batch::default() };
        let named = |s: &Expr| (arena.symbol_of(*s), Polynomial::atom(*s));
        Some([momentum, Batch { shared, results: x_dot.iter().map(named).collect(), ..Batch::default() }])
    }

    /// `1/alpha`, `1/beta`, `1/mu` of an isotropic energy, and the coefficient of `C(3)/3` where there is one.
    fn isotropic(&self) -> Option<Batch> {
        let iso = self.motion.polynomial()?.1.isotropic.as_ref()?;
        let named = [
            (Quantity::InverseAlpha, &iso.casimir2),
            (Quantity::InverseBeta, &iso.casimir1_squared),
            (Quantity::InverseMu, &iso.skew),
        ];
        let mut results = named.map(|(name, p)| (name.into(), p.clone())).to_vec();
        if !iso.casimir3.is_zero() {
            results.push((Quantity::Casimir3.into(), iso.casimir3.clone()));
        }
        Some(Batch { results, ..Batch::default() })
    }

    /// `T_int` and the energy of the centre of mass, from what is known of a point that moves.
    fn kinetic_energy(&self, arena: &mut Arena, form: &Legendre, moving: &[Expr]) -> Batch {
        let mut energy =
            Batch { shared: form.shared.clone(), ..result(Quantity::Energy, form.energy.clone()) };
        let x_dot = arena.components(Quantity::CentreVelocity, self.motion.dim());
        let (_, _, of_centre) = self.motion.masses.legendre(arena, &x_dot);
        energy.results[0].1.add_scaled(&of_centre, &Rational::ONE);
        given(arena, energy, moving)
    }

    /// `H` at a point of a chart, from the value of the potential and what that shares.
    fn hamiltonian(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        potential: Option<(Polynomial, Definitions)>,
    ) -> Option<Batch> {
        let (shared, energy) = self.motion.energy(arena, chart)?;
        let mut batch = Batch { shared, ..result(Quantity::Energy, energy) };
        if let Some((value, shared)) = potential {
            join(&mut batch, &value, shared);
        }
        for custom in &self.forces.customs {
            if let Some((value, kernel)) = custom.energy(arena, chart) {
                join(&mut batch, &value, Definitions::new());
                batch.kernels.push(kernel);
            }
        }
        Some(batch)
    }

    /// The power of the forces that no potential has, and of the time in a potential.
    fn power(&self, arena: &mut Arena, chart: &Chart) -> Option<Option<Batch>> {
        if self.forces.is_empty() && !self.forces.driven {
            return Some(None);
        }
        // Another potential has no power.
        let driving: Option<&Potential> = self.potential.filter(|_| self.forces.driven);
        let forces = Forces { accounted: self.forces.driven, ..self.forces.clone() };
        let body = Body { forces: &forces, ..*self };
        let (system, _) = body.systems(arena, chart, driving)?.swap_remove(0);
        let Some((_, power)) = system.work else { return Some(None) };
        let batch =
            Batch { shared: system.shared, kernels: system.kernels, ..result(Quantity::Power, power) };
        Some(Some(batch.pruned(arena)))
    }
}

/// Functions of the placement that potentials are evaluated with.
fn placement_inputs(arena: &mut Arena, n: usize) -> Vec<Expr> {
    let mut inputs = vec![Base::MeanLogStretch.symbol(arena), arena.symbol(Quantity::Dilatation)];
    inputs.extend((0..n).map(|a| Base::LogStretch(a).symbol(arena)));
    inputs
}

/// What products of matrices give of a placement that moves: the affine velocities in all frames, and `phi^-1`.
fn moving_matrices(arena: &mut Arena, n: usize) -> Vec<Expr> {
    let affine = [Frame::Body, Frame::Space, Frame::Flat].map(Frame::velocity);
    let matrices = affine.into_iter().chain([Quantity::InversePlacement]);
    matrices.flat_map(|of| Matrix::symbols(arena, of, n).0.concat()).collect()
}

/// A batch that is given some of its quantities.
fn given(arena: &Arena, mut batch: Batch, quantities: &[Expr]) -> Batch {
    batch.shared.retain(|(symbol, _)| !quantities.contains(symbol));
    batch.pruned(arena)
}

/// Adds to the first result a value with what it shares.
fn join(batch: &mut Batch, value: &Polynomial, shared: Definitions) {
    batch.results[0].1.add_scaled(value, &Rational::ONE);
    share(&mut batch.shared, shared);
}

fn result(of: Quantity, polynomial: Polynomial) -> Batch {
    Batch { results: vec![(of.into(), polynomial)], ..Batch::default() }
}

fn matrix_batch(arena: &Arena, names: &Matrix, values: &[Vec<Polynomial>]) -> Batch {
    let results = arena.symbols_of(&names.0.concat()).into_iter().zip(values.concat()).collect();
    Batch { results, ..Batch::default() }
}
