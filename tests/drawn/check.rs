//! A drawn energy in one chart: the programs of its model against its plain definition.

use affine_codegen::derive::Model;
use affine_codegen::ir::Program;
use affine_codegen::mechanics::potential::Bound;
use affine_codegen::symbol::{Quantity, Symbol};
use affine_oracle::Random;
use qd::Quad;

use super::energy::Energy;
use super::model::{Named, Phase, Reads};
use super::number::{Dual, Number, Rounded, size};
use super::place::{Measures, Place, Square, square};

/// What a program may differ by from the plain definition, in units of [`Rounded::error`], what one rounding in every operand
/// and operation of the definition does to the result.
///
/// Programs run with 31 digits, a rounding of 1e-32 and its error of as many units as there are operations. They reorder: a
/// power that is multiplied out, or a sum over a common divisor, loses digits that the definition keeps. Seven are left for
/// that; a wrong term is wrong by a part of itself.
const SAME: f64 = 1e-25;

/// What is found in place of what is expected.
pub(crate) type Mistakes = Vec<String>;

/// A model and its energy as written, with the same model without potential.
pub(crate) struct Case<'a> {
    pub(crate) model: &'a Model,
    pub(crate) free: &'a Model,
    pub(crate) energy: &'a Energy,
}

/// A point of a case: what programs read, and the energy there with its slopes.
pub(crate) struct Point<'a> {
    pub(crate) case: &'a Case<'a>,
    pub(crate) phase: Phase,
    pub(crate) energy: Dual,
}

impl Case<'_> {
    /// Everything at one place, with random momenta; whether the reduced equations were looked at.
    pub(crate) fn check(&self, random: &mut Random, place: &Place, mistakes: &mut Mistakes) -> bool {
        let phase = Phase::new(random, place, true);
        let energy = self.energy.value(&Measures::at(place, self.energy.is_stretched()));
        let point = Point { case: self, phase, energy };
        point.equations(mistakes);
        point.hamiltonians(mistakes);
        point.power(mistakes);
        point.domain(mistakes);
        let reduced = point.reduced(mistakes);
        point
            .phase
            .unknown
            .take()
            .into_iter()
            .for_each(|name| mistakes.push(format!("{name} is read and not known")));
        reduced
    }

    /// The worst errors in double precision of a force and of the energy, at rest, in units of [`Rounded::error`] and of the
    /// last place.
    pub(crate) fn rounding(&self, random: &mut Random, place: &Place) -> [f64; 2] {
        let phase = Phase::new(random, place, false);
        let energy = self.energy.value(&Measures::at(place, self.energy.is_stretched()));
        let point = Point { case: self, phase, energy };
        let model = self.model;
        let run = |program: &Program, reads| point.phase.run::<f64>(model, program, reads);
        let ratio = |found: Quad, expected: Rounded| {
            size(found - expected.value) / (f64::EPSILON * expected.error.max(f64::MIN_POSITIVE))
        };
        let rates = run(&model.dynamics.full.program, Reads::State);
        let forces = point.forces().into_iter().map(|(name, force)| ratio(rates[&name], force));
        let potential = if model.description.has_forces { point.energy.value } else { Rounded::ZERO };
        [forces.fold(0.0, f64::max), ratio(run(&model.point.hamiltonian, Reads::Point)["energy"], potential)]
    }
}

impl Point<'_> {
    /// The results of one of the model's programs.
    pub(crate) fn run(&self, program: &Program, reads: Reads) -> Named {
        self.phase.run::<Number>(self.case.model, program, reads)
    }

    /// Slopes of the energy along `phi`.
    fn slopes(&self) -> Square<Rounded> {
        let n = self.phase.place.dim();
        square(n, |i, a| self.energy.slopes[4 + n * i + a])
    }

    /// What the rates of momenta gain: `Pi' = -F^T`, `Sigma_hat' = -F^T phi`, `Sigma' = -phi F^T`, `p' = -dU/dx`,
    /// `p_hat' = -phi^T dU/dx`, by the names of programs.
    pub(crate) fn forces(&self) -> Vec<(String, Rounded)> {
        let (n, place) = (self.phase.place.dim(), &self.phase.place);
        let f = self.slopes();
        let phi = square(n, |i, a| Rounded::stored(place.phi[i][a]));
        let sum = |term: &dyn Fn(usize) -> Rounded| {
            (0..n).fold(Rounded::ZERO, |sum, k| sum.plus(term(k))).negated()
        };
        let pull = |i: usize| self.energy.slopes[1 + i];
        let groups = self.case.model.dynamics.full.groups.iter();
        let listed = groups.flat_map(|(group, names)| {
            let entry = |(k, symbol): (usize, &Symbol)| {
                let (a, b) = (k / n, k % n);
                let force = match *group {
                    Quantity::CanonicalMomentum => f[b][a].negated(),
                    Quantity::ComovingAffineSpin => sum(&|i| f[i][a].times(phi[i][b])),
                    Quantity::AffineSpin => sum(&|c| phi[a][c].times(f[b][c])),
                    Quantity::LinearMomentum => pull(k).negated(),
                    Quantity::ComovingLinearMomentum => sum(&|i| phi[i][k].times(pull(i))),
                    Quantity::Position | Quantity::Placement => Rounded::ZERO,
                    other => panic!("{other:?} is no group"),
                };
                (format!("d_{symbol}"), force)
            };
            names.iter().enumerate().map(entry).collect::<Vec<_>>()
        });
        listed.collect()
    }

    /// Hamilton's equations are those of the kinetic energy, and the forces.
    fn equations(&self, mistakes: &mut Mistakes) {
        let Case { model, free, .. } = self.case;
        let found = self.run(&model.dynamics.full.program, Reads::State);
        let without = self.phase.run::<Number>(free, &free.dynamics.full.program, Reads::State);
        for (name, force) in self.forces() {
            let expected = Rounded::stored(without[&name]).plus(force);
            compare(&name, found[&name], expected, mistakes);
        }
    }

    /// `H = T + U`, in each of its forms.
    fn hamiltonians(&self, mistakes: &mut Mistakes) {
        let Case { model, free, .. } = self.case;
        let kinetic = self.phase.run::<Number>(free, &free.point.hamiltonian, Reads::Point)["energy"];
        // A constant moves nothing and leaves no trace, as is written in the checks; that its slopes vanish is looked at.
        let potential = if model.description.has_forces { self.energy.value } else { Rounded::ZERO };
        let expected = Rounded::stored(kinetic).plus(potential);
        compare("energy", self.run(&model.point.hamiltonian, Reads::Point)["energy"], expected, mistakes);
        if let Some(program) = &model.point.hamiltonian_far_away {
            compare("energy far away", self.run(program, Reads::Point)["energy"], expected, mistakes);
        }
    }

    /// `dH/dt = dU/dt`, where a program has it.
    fn power(&self, mistakes: &mut Mistakes) {
        let expected = self.energy.slopes[0];
        let program = self.case.model.point.power.as_ref();
        let found = program.map_or(Quad::ZERO, |program| self.run(program, Reads::Point)["power"]);
        compare("power", found, expected, mistakes);
    }

    /// The energy has a value here, so that every guard says so.
    fn domain(&self, mistakes: &mut Mistakes) {
        let Some(domain) = &self.case.model.point.domain else { return };
        for program in [&domain.program].into_iter().chain(&domain.far_away) {
            let values = self.run(program, Reads::Point);
            for (k, guard) in domain.guards.iter().enumerate() {
                let value = values[&format!("guard_{}", k + 1)].0;
                let holds = match guard.bound {
                    Bound::Positive => value > 0.0,
                    Bound::NotNegative => value >= 0.0,
                    Bound::NotZero => value != 0.0,
                    Bound::Angle => true,
                };
                if !holds {
                    mistakes.push(format!("{} of {}: {value:e}", guard.argument, guard.part));
                }
            }
        }
    }
}

/// The difference is that of rounding.
pub(crate) fn same(found: Quad, expected: Rounded) -> bool {
    size(found - expected.value) <= SAME * expected.error
}

pub(crate) fn compare(name: &str, found: Quad, expected: Rounded, mistakes: &mut Mistakes) {
    if !same(found, expected) {
        let (found, right) = (found.0, expected.value.0);
        mistakes.push(format!("{name}: {found:e} is not {right:e}, of terms of {:e}", expected.error));
    }
}
