//! The forces of a kinetic energy in the shortest of several ways.
//!
//! On the motion the momentum `M` of the chart is the sum of the momenta `m` of the parts. So one of these is what the others
//! leave of `M`, and in the rates `M` may be written as the sum, where much of it cancels against the forces. Under a
//! constraint `M` stands for the class of all momenta that differ by what no velocity of the group sees: then only
//! the second holds, since rates depend on the class alone, while the force on a part needs the momentum itself. On SL(n) the
//! members of a class differ by multiples of the identity, and one entry of the sum tells which is meant: there the first
//! holds as well.

use crate::algebra::definitions::needed;
use crate::algebra::ring::{Square, pairs, table};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::Coordinate;
use crate::mechanics::constraint::Constraint;
use crate::mechanics::equations::Form;
use crate::mechanics::metric::Definitions;

use super::action::of_the_placement;
use super::lagrangian::{Contribution, Lagrangian};
use super::{Kinetics, paired};

/// Forces with what they share.
struct Way {
    shared: Definitions,
    force: Square<Polynomial>,
}

impl Lagrangian {
    /// The energy by its equations, where `inverse` defines the velocities: the way with the fewest terms, and a second where
    /// their number leaves it open which is the shortest.
    pub fn kinetics(&self, arena: &mut Arena, velocity: &Matrix, inverse: &Definitions) -> Vec<Kinetics> {
        let mut counted: Vec<(usize, Kinetics)> = Vec::new();
        for way in self.ways(arena) {
            let Some(kinetics) = self.in_way(arena, way, velocity, inverse) else { continue };
            let is_same = |(_, known): &(usize, Kinetics)| {
                (&known.forces, &known.shared) == (&kinetics.forces, &kinetics.shared)
            };
            if !counted.iter().any(is_same) {
                counted.push((operations(arena, &kinetics), kinetics));
            }
        }
        counted.sort_by_key(|(count, _)| *count);
        let least = counted.first().map_or(0, |(count, _)| *count);
        let most = if self.is_projected() { least + least / 20 } else { least };
        let near = counted.into_iter().take(2).filter(|(count, _)| *count <= most);
        near.map(|(_, kinetics)| Kinetics { shared: [inverse.clone(), kinetics.shared].concat(), ..kinetics })
            .collect()
    }

    fn is_projected(&self) -> bool {
        self.chart.confined.is_some() && self.conjugate.iter().any(|(y, _)| matches!(y, Coordinate::M(..)))
    }

    fn ways(&self, arena: &mut Arena) -> Vec<Way> {
        let parts = self.contributions(arena);
        let mut ways = vec![self.as_it_stands(&parts, false)];
        if self.is_projected() {
            ways.push(self.momentum_as_sum(&parts));
            ways.push(self.as_it_stands(&parts, true));
        }
        if !self.is_projected() || self.chart.confined == Some(Constraint::Isochoric) {
            let moved = (0..parts.len()).filter(|k| parts[*k].named().count() == self.conjugate.len());
            for k in moved {
                ways.push(self.left_by_others(&parts, k, false));
                // Factors that several terms have are found in the sum, or in what is left of it.
                let is_long = |(_, sum): &(Polynomial, Polynomial)| sum.terms().len() > 1;
                if self.in_own_velocities(&parts).any(|part| part.momentum.iter().any(is_long)) {
                    ways.push(self.left_by_others(&parts, k, true));
                }
            }
        }
        ways
    }

    /// The forces as the parts have them, those of the parts in the velocities of the chart `written_out`.
    fn as_it_stands(&self, parts: &[Contribution], written_out: bool) -> Way {
        let mut shared = Definitions::new();
        for part in parts {
            shared.extend(part.shared.iter().cloned());
            shared.extend(part.named().map(|(name, sum)| (name, sum.clone())));
        }
        let force = table(self.chart.dim, |a, b| {
            let forces = self.parts.iter().zip(parts).map(|(part, found)| {
                let plain = written_out && part.definitions.is_none();
                if plain { &found.written_out[a][b] } else { &found.force[a][b] }
            });
            forces.sum()
        });
        Way { shared, force }
    }

    /// The contributions of the parts in the velocities of the chart.
    fn in_own_velocities<'a>(&self, parts: &'a [Contribution]) -> impl Iterator<Item = &'a Contribution> {
        let own = self.parts.iter().zip(parts).filter(|(part, _)| part.definitions.is_none());
        own.map(|(_, contribution)| contribution)
    }

    /// The momentum of part `k` as `M - sum of the others`; those in the velocities of the chart `written_out`, which one
    /// term always is. Under `det phi = 1` a multiple of the identity more, which the first entry tells.
    fn left_by_others(&self, parts: &[Contribution], k: usize, written_out: bool) -> Way {
        let Way { mut shared, force } = self.as_it_stands(parts, false);
        let names: Vec<Expr> = parts[k].named().map(|(name, _)| name).collect();
        let rest = |place: usize| {
            let mut rest = Polynomial::atom(self.chart.symbol(self.conjugate[place].0));
            for (j, other) in parts.iter().enumerate().filter(|(j, _)| *j != k) {
                let (name, sum) = &other.momentum[place];
                let is_short = self.parts[j].definitions.is_none() && (written_out || sum.terms().len() < 2);
                rest.add_scaled(if is_short { sum } else { name }, &Rational::MINUS_ONE);
            }
            rest
        };
        let first = self.conjugate.iter().position(|(y, _)| *y == Coordinate::M(0, 0));
        let first = first.filter(|_| self.is_projected());
        let told = first.map(|place| names[place]);
        shared.retain(|(known, _)| !names.contains(known) || told == Some(*known));
        for (place, ((y, _), name)) in self.conjugate.iter().zip(&names).enumerate() {
            let mut value = rest(place);
            match (first, *y) {
                (Some(first), _) if place == first => continue,
                (Some(first), Coordinate::M(a, b)) if a == b => {
                    value.add_scaled(&Polynomial::atom(names[first]), &Rational::ONE);
                    value.add_scaled(&rest(first), &Rational::MINUS_ONE);
                }
                _ => {}
            }
            shared.push((*name, value));
        }
        Way { shared, force }
    }

    /// `M` in its bracket with itself as the sum of the parts.
    fn momentum_as_sum(&self, parts: &[Contribution]) -> Way {
        let Way { shared, mut force } = self.as_it_stands(parts, false);
        let slopes: Vec<_> = self.conjugate.iter().map(|(y, o)| (*y, Polynomial::atom(*o))).collect();
        let sum = |atom: Expr| {
            let place = self.conjugate.iter().position(|(y, _)| self.chart.symbol(*y) == atom)?;
            let sum: Polynomial = parts.iter().map(|part| &part.momentum[place].0).sum();
            Some(sum)
        };
        for (y, _) in &self.conjugate {
            if let Coordinate::M(a, b) = *y {
                let bracket = paired(&self.chart, *y, &slopes);
                force[a][b].add_scaled(&bracket.substitute(&sum), &Rational::ONE);
                force[a][b].add_scaled(&bracket, &Rational::MINUS_ONE);
            }
        }
        Way { shared, force }
    }

    /// The equations of a way, without what `inverse` defines; `None` where the way needs `phi^-1` and nothing defines it.
    fn in_way(
        &self,
        arena: &mut Arena,
        way: Way,
        velocity: &Matrix,
        inverse: &Definitions,
    ) -> Option<Kinetics> {
        let n = self.chart.dim;
        let force = table(n, |a, b| self.placed(&way.force[a][b]));
        let known = |symbol: &Expr| inverse.iter().any(|(found, _)| found == symbol);
        let shared = way.shared.iter().filter(|(symbol, _)| !known(symbol));
        let shared: Definitions = shared.map(|(symbol, value)| (*symbol, self.placed(value))).collect();
        let needed = needed(arena, &shared, force.iter().flatten());
        let shared: Definitions = shared.into_iter().filter(|(symbol, _)| needed.contains(symbol)).collect();
        let quantities = of_the_placement(arena, n);
        let missing = |p: &Polynomial| p.mentions(|atom| quantities.contains(&atom) && !known(&atom));
        if force.iter().flatten().chain(shared.iter().map(|(_, value)| value)).any(missing) {
            return None;
        }
        let forces = pairs(n);
        let forces = forces.map(|(a, b)| (Coordinate::M(a, b), force[a][b].clone()));
        Some(Kinetics {
            chart: self.chart.clone(),
            velocity: velocity.clone(),
            shared,
            slopes: self.conjugate.iter().map(|(y, o)| (*y, Polynomial::atom(*o))).collect(),
            forces: forces.filter(|(_, force)| !force.is_zero()).collect(),
        })
    }
}

/// Multiplications and additions of the equations as they are written, before anything is shared between them.
fn operations(arena: &Arena, kinetics: &Kinetics) -> usize {
    let system = kinetics.system(Form::ThroughVelocity).tidied(arena);
    let shared = system.shared.iter().map(|(_, value)| value);
    let of_term = |(monomial, c): (&Vec<Expr>, &Rational)| monomial.len() + usize::from(!c.abs().is_one());
    let of = |p: &Polynomial| p.terms().map(of_term).sum::<usize>().saturating_sub(1);
    shared.chain(system.rates.iter().map(|(_, _, rate)| rate)).map(of).sum()
}
