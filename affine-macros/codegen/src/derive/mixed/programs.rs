//! Legendre transformation and energies at one placement.

use std::slice::from_ref;

use crate::algebra::bind::Constants;
use crate::algebra::ring::table;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::derive::Domain;
use crate::derive::MixedMasses;
use crate::derive::constant::{legendre_batch, matrix_batch, placement_inputs, result};
use crate::derive::domain::domain;
use crate::derive::programs::shortest_program;
use crate::ir::Program;
use crate::ir::fuse::fuse;
use crate::mechanics::charts::Chart;
use crate::mechanics::metric::Definitions;
use crate::mechanics::mixed::Legendre;
use crate::optimise::Batch;
use crate::symbol::Quantity;

use super::{Body, Inner};

/// The programs of one placement.
pub(super) struct Programs {
    pub(super) legendre: Program,
    pub(super) velocity: Program,
    pub(super) mass: Option<Program>,
    pub(super) mixed_masses: Option<MixedMasses>,
    pub(super) kinetic_energy: Program,
    pub(super) hamiltonian: Program,
    pub(super) hamiltonian_far_away: Option<Program>,
    pub(super) domain: Option<Domain>,
    pub(super) power: Option<Program>,
    pub(super) isotropic: Option<Program>,
}

impl Body<'_> {
    pub(super) fn programs(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        coefficients: &mut Constants,
    ) -> Option<Programs> {
        let n = self.mixed.dim;
        let phi = chart.phi.0.concat();
        let mut inline = |arena: &mut Arena, ways: &[Batch], inputs: &[Expr]| {
            let varies = |a: Expr| inputs.contains(&a) || phi.contains(&a);
            fuse(&shortest_program(arena, ways, coefficients, &varies))
        };
        let velocities = Matrix::symbols(arena, self.inner.frame().velocity(), n);
        let momenta = Matrix::symbols(arena, self.inner.frame().momentum(), n);
        let [v, x_dot, p] = [Quantity::GivenVelocity, Quantity::CentreVelocity, Quantity::LinearMomentum]
            .map(|of| arena.components(of, n));
        let (legendre, [velocity, mut energy]) = self.internal(arena, &velocities, &momenta);
        self.centre_energy(arena, &v, &mut energy);
        let inputs = [velocities.0.concat(), v].concat();
        let mass = self.mass(arena).map(|batch| inline(arena, from_ref(&batch), &[]));
        let mixed_masses = match self.masses.are_mixed() {
            true => {
                let [momentum, velocity] = self.centre(arena, &x_dot)?;
                let (momentum, velocity) =
                    (inline(arena, from_ref(&momentum), &x_dot), inline(arena, from_ref(&velocity), &p));
                Some(MixedMasses { momentum, velocity })
            }
            false => None,
        };
        let near = self.potential.map(|u| u.energy_at_a_point(arena, chart));
        let (hamiltonian, at_a_point) = self.hamiltonian(arena, chart, near)?;
        let far_away = match self.potential.and_then(|u| u.energy_far_away(arena, chart)) {
            Some(value) => Some(self.hamiltonian(arena, chart, Some(value))?.0),
            None => None,
        };
        let power = self.power(arena, chart)?.map(|batch| inline(arena, from_ref(&batch), &at_a_point));
        let isotropic = self.isotropic();
        Some(Programs {
            legendre: inline(arena, &legendre, &inputs),
            velocity: inline(arena, from_ref(&velocity), &momenta.0.concat()),
            mass,
            mixed_masses,
            kinetic_energy: inline(arena, from_ref(&energy), &inputs),
            hamiltonian: inline(arena, from_ref(&hamiltonian), &at_a_point),
            hamiltonian_far_away: far_away.map(|batch| inline(arena, from_ref(&batch), &at_a_point)),
            power,
            isotropic: isotropic.map(|batch| inline(arena, from_ref(&batch), &[])),
            domain: domain(arena, chart, self.potential, coefficients, &[phi, at_a_point].concat()),
        })
    }

    /// The Legendre transformation of the internal motion, its inverse, and `T_int`.
    fn internal(&self, arena: &mut Arena, velocities: &Matrix, momenta: &Matrix) -> (Vec<Batch>, [Batch; 2]) {
        let internal = match &self.inner {
            Inner::Constant(kinetic, h) => {
                let velocity = matrix_batch(arena, velocities, &h.velocity);
                let energy = result("energy", kinetic.internal_energy());
                return (vec![legendre_batch(arena, kinetic)], [velocity, energy]);
            }
            Inner::Varying(internal) => internal,
        };
        let forms = internal.legendre(arena, self.mixed);
        let energy = Batch { shared: forms[0].shared.clone(), ..result("energy", forms[0].energy.clone()) };
        let solution = table(velocities.dim(), |i, a| Polynomial::atom(internal.velocity.0[i][a]));
        let velocity =
            Batch { shared: internal.shared.clone(), ..matrix_batch(arena, velocities, &solution) };
        let legendre = |Legendre { shared, momentum, .. }: Legendre| {
            Batch { shared, ..matrix_batch(arena, momenta, &momentum) }.pruned(arena)
        };
        (forms.into_iter().map(legendre).collect(), [velocity, energy.pruned(arena)])
    }

    /// `1/m` and `m`, where there is one mass.
    fn mass(&self, arena: &mut Arena) -> Option<Batch> {
        let mass = match (self.masses.body, self.masses.space) {
            (Some(mass), None) | (None, Some(mass)) => mass,
            _ => return None,
        };
        let reciprocal = arena.pow(mass, -1)?;
        let [inverse, mass] = [reciprocal, mass].map(|m| Polynomial::normal_form(arena, m));
        let results = vec![("inverse_mass".into(), inverse), ("mass".into(), mass)];
        Some(Batch { results, ..Batch::default() })
    }

    /// The Legendre transformation of a centre of mass with two masses, and its inverse.
    fn centre(&self, arena: &mut Arena, x_dot: &[Expr]) -> Option<[Batch; 2]> {
        let (_, shared) = self.masses.velocity(arena)?;
        let (definitions, momentum, _) = self.masses.legendre(arena, x_dot);
        let results = momentum.into_iter().zip(1..).map(|(p, i): (Polynomial, usize)| (format!("p_{i}"), p));
        let momentum = Batch { shared: definitions, results: results.collect(), ..Batch::default() };
        let named = |s: &Expr| (arena.symbol_name(*s), Polynomial::atom(*s));
        Some([momentum, Batch { shared, results: x_dot.iter().map(named).collect(), ..Batch::default() }])
    }

    /// `1/alpha`, `1/beta`, `1/mu` of an isotropic internal energy.
    fn isotropic(&self) -> Option<Batch> {
        let Inner::Constant(_, h) = &self.inner else { return None };
        let iso = h.isotropic.as_ref()?;
        let named = [
            ("inverse_alpha", &iso.casimir2),
            ("inverse_beta", &iso.casimir1_squared),
            ("inverse_mu", &iso.skew),
        ];
        let results = named.map(|(name, p)| (name.to_owned(), p.clone())).to_vec();
        Some(Batch { results, ..Batch::default() })
    }

    /// Adds `m/2 |v|^2` in the frame of the translation; with two masses `v = x_dot`.
    fn centre_energy(&self, arena: &mut Arena, v: &[Expr], energy: &mut Batch) {
        if self.masses.are_mixed() {
            let (shared, _, of_both) = self.masses.legendre(arena, v);
            let known: Vec<Expr> = energy.shared.iter().map(|(symbol, _)| *symbol).collect();
            energy.shared.extend(shared.into_iter().filter(|(s, _)| !known.contains(s)));
            energy.results[0].1.add_scaled(&of_both, &Rational::ONE);
        } else if let Some(mass) = self.masses.space.or(self.masses.body) {
            let mass = Polynomial::normal_form(arena, mass);
            let half = Rational::HALF;
            for v in v {
                let square = Polynomial::term(vec![*v, *v], Rational::ONE);
                energy.results[0].1.add_product(&square, &mass, &half);
            }
        }
    }

    /// `H` at a point from the potential and what that shares, with its inputs.
    fn hamiltonian(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        potential: Option<(Polynomial, Definitions)>,
    ) -> Option<(Batch, Vec<Expr>)> {
        let mut batch = match &self.inner {
            Inner::Varying(internal) => {
                Batch { shared: internal.shared.clone(), ..result("energy", internal.energy.clone()) }
            }
            Inner::Constant(_, h) => result("energy", h.internal()),
        };
        let mut inputs: Vec<Expr> = chart.coordinates().into_iter().map(|z| chart.symbol(z)).collect();
        let join = |batch: &mut Batch, value: &Polynomial, shared: Definitions| {
            batch.results[0].1.add_scaled(value, &Rational::ONE);
            let fresh: Definitions = shared
                .into_iter()
                .filter(|(s, _)| !batch.shared.iter().any(|(known, _)| known == s))
                .collect();
            batch.shared.extend(fresh);
        };
        if !self.masses.are_none() {
            let (_, shared) = self.masses.velocity(arena)?;
            join(&mut batch, &self.masses.energy(arena, chart), shared);
        }
        if let Some((value, shared)) = potential {
            join(&mut batch, &value, shared);
            inputs.extend(placement_inputs(arena, chart.dim));
        }
        for custom in &self.forces.customs {
            if let Some((value, kernel)) = custom.energy(arena, chart) {
                join(&mut batch, &value, Definitions::new());
                batch.kernels.push(kernel);
            }
        }
        inputs.extend(self.time(arena));
        Some((batch, inputs))
    }

    /// The power of the forces that no potential has, and of the time in a potential, where it is accounted for.
    fn power(&self, arena: &mut Arena, chart: &Chart) -> Option<Option<Batch>> {
        if self.forces.is_empty() && !self.forces.driven {
            return Some(None);
        }
        // Another potential has no power.
        let driving = self.potential.filter(|_| self.forces.driven);
        let system = self.systems_under(arena, chart, driving)?.swap_remove(0);
        let Some((_, power)) = system.work else { return Some(None) };
        let results = vec![("power".to_owned(), power)];
        let batch = Batch { shared: system.shared, kernels: system.kernels, results };
        Some(Some(batch.pruned(arena)))
    }
}
