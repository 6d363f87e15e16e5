//! What is conserved: a quantity of the free motion stays so exactly where the energy is the same after every motion of the
//! group that the quantity generates. Elements are drawn, and the energy is evaluated as written.

use affine_codegen::mechanics::conserved::{Candidate, Entry};
use affine_oracle::Random;
use affine_runtime::scalar::Scalar;
use qd::Quad;

use super::check::{Case, Mistakes, same};
use super::number::{Rounded, size};
use super::place::{Measures, Place, Square, applied, product, short, square};

/// Elements of a group at each place.
const ELEMENTS: usize = 2;

/// How far a place goes along what a component generates.
const STEP: f64 = 1e-12;

impl Case<'_> {
    /// Both lists, moving and at rest, by the energy at these places; whether a list is short, of an energy with roots: that
    /// `sqrt(a)^2` is `a` is no part of the proofs, in which a function is one of any kind.
    pub(crate) fn conserves(&self, random: &mut Random, places: &[Place], mistakes: &mut Mistakes) -> bool {
        let mut kept =
            |candidate: &Candidate| places.iter().all(|place| self.keeps(random, *candidate, place));
        let left = |list: &[Candidate], kept: &mut dyn FnMut(&Candidate) -> bool| -> Vec<Candidate> {
            list.iter().copied().filter(kept).collect()
        };
        let moving = left(&self.free.description.conserved.whole, &mut kept);
        // A force on the centre of mass does not leave it at rest.
        let at_rest = match kept(&Candidate::LinearMomentum) {
            true => left(&self.free.description.conserved_at_rest.whole, &mut kept),
            false => moving.clone(),
        };
        let lists = [
            ("conserved", &self.model.description.conserved.whole, moving),
            ("conserved at rest", &self.model.description.conserved_at_rest.whole, at_rest),
        ];
        let mut is_short = self.keeps_components(places, mistakes);
        for (what, found, expected) in lists {
            let within = found.iter().all(|candidate| expected.contains(candidate));
            if *found != expected && within && self.energy.has_roots() {
                is_short = true;
            } else if *found != expected {
                mistakes.push(format!("{what}: {found:?} is not {expected:?}"));
            }
        }
        is_short
    }

    /// The components: along what they generate the energy does not change; along what entries of momenta generate that are
    /// conserved without it, it does, where these are not listed. Whether any of an energy with roots is missing.
    fn keeps_components(&self, places: &[Place], mistakes: &mut Mistakes) -> bool {
        let (model, free) = (self.model, self.free);
        let changes = |entries: &[Entry]| places.iter().any(|place| self.changes(entries, place));
        for component in model
            .description
            .conserved
            .components
            .iter()
            .chain(&model.description.conserved_at_rest.components)
        {
            if changes(&component.entries) {
                mistakes.push(format!("{} is not conserved", component.symbol));
            }
        }
        let mut is_short = false;
        for of in [
            Candidate::LinearMomentum,
            Candidate::Spin,
            Candidate::OrbitalAngularMomentum,
            Candidate::Vorticity,
        ] {
            if !free.description.conserved.whole.contains(&of)
                || model.description.conserved.whole.contains(&of)
            {
                continue;
            }
            let n = places[0].dim();
            let above = (1..=n).flat_map(|row| (row + 1..=n).map(move |column| (row, column)));
            let entries: Vec<(usize, usize)> = match of {
                Candidate::LinearMomentum => (1..=n).map(|row| (row, 1)).collect(),
                _ => above.collect(),
            };
            for (row, column) in entries {
                let entry = Entry { factor: 1, of, row, column };
                let listed =
                    model.description.conserved.components.iter().any(|known| known.entries == [entry]);
                let is_missing = !listed && !changes(&[entry]);
                if is_missing && self.energy.has_roots() {
                    is_short = true;
                } else if is_missing {
                    mistakes.push(format!("{of:?}, entry {row}{column}, is conserved"));
                }
            }
        }
        is_short
    }

    /// Does the energy at this place change along what the entries generate?
    fn changes(&self, entries: &[Entry], place: &Place) -> bool {
        let value = |place: &Place| self.energy.value(&Measures::at(place, self.energy.is_stretched())).value;
        let there = along(entries, place, Quad::from(STEP));
        let (here, there) = (value(place), value(&there));
        let change = size(there.value - here.value);
        // To second order in the step, and to the first where it changes.
        change > 1e-8 * STEP * (1.0 + size(here.value))
    }

    /// Is the energy at this place that after motions of the group?
    fn keeps(&self, random: &mut Random, candidate: Candidate, place: &Place) -> bool {
        let value = |place: &Place| self.energy.value(&Measures::at(place, self.energy.is_stretched())).value;
        let here = value(place);
        (0..ELEMENTS).all(|_| {
            let there = value(&moved(random, candidate, place));
            same(there.value, Rounded { error: here.error + there.error, ..here })
        })
    }
}

/// The place after a motion of the group that a quantity generates. Powers of a quantity generate what it does itself.
fn moved(random: &mut Random, candidate: Candidate, place: &Place) -> Place {
    let n = place.dim();
    let mut there = place.clone();
    let times_phi = |a: &Square<Quad>| product(a, &place.phi);
    let times_x = |a: &Square<Quad>| applied(a, &place.x);
    match candidate {
        Candidate::Energy => there.t = place.t + Quad::from(short(random, 0.1, 1.0)),
        Candidate::LinearMomentum | Candidate::ComovingLinearMomentum => {
            there.x.iter_mut().for_each(|x| *x += Quad::from(short(random, 0.1, 1.0)));
        }
        Candidate::OrbitalAngularMomentum => there.x = times_x(&rotation(random, n)),
        Candidate::TotalAffineMomentum => {
            let a = linear(random, n);
            (there.phi, there.x) = (times_phi(&a), times_x(&a));
        }
        Candidate::TotalAngularMomentum => {
            let r = rotation(random, n);
            (there.phi, there.x) = (times_phi(&r), times_x(&r));
        }
        // No function of phi is left unchanged by all linear maps but a constant.
        Candidate::AffineSpin | Candidate::CanonicalMomentum | Candidate::Casimir2 | Candidate::Casimir3 => {
            there.phi = times_phi(&linear(random, n));
        }
        Candidate::Deviator | Candidate::DeviatorCasimir2 | Candidate::DeviatorCasimir3 => {
            there.phi = times_phi(&special(random, n));
        }
        Candidate::Spin | Candidate::SpinNorm => there.phi = times_phi(&rotation(random, n)),
        Candidate::ComovingAffineSpin => there.phi = product(&place.phi, &linear(random, n)),
        Candidate::ComovingDeviator => there.phi = product(&place.phi, &special(random, n)),
        Candidate::Vorticity | Candidate::VorticityNorm => {
            there.phi = product(&place.phi, &rotation(random, n));
        }
        Candidate::Casimir1 => {
            let scale = Quad::from(short(random, 0.6, 0.9));
            there.phi.iter_mut().flatten().for_each(|entry| *entry *= scale);
        }
    }
    there
}

/// The place after a short way along what a sum of entries of momenta generates: `x_j` by `d/dp_j`, `phi_jA` by `d/dPi_Aj`.
fn along(entries: &[Entry], place: &Place, step: Quad) -> Place {
    let mut there = place.clone();
    let n = place.dim();
    for Entry { factor, of, row, column } in entries {
        let (i, j) = (row - 1, column - 1);
        let signed = |sign: f64| step * Quad::from(sign * *factor as f64);
        let across = [(i, j, signed(1.0)), (j, i, signed(-1.0))];
        for (i, j, step) in across.into_iter().take(if is_skew(*of) { 2 } else { 1 }) {
            let orbital = [
                Candidate::OrbitalAngularMomentum,
                Candidate::TotalAngularMomentum,
                Candidate::TotalAffineMomentum,
            ];
            let spatial = [
                Candidate::AffineSpin,
                Candidate::Spin,
                Candidate::TotalAngularMomentum,
                Candidate::TotalAffineMomentum,
            ];
            if orbital.contains(of) {
                there.x[j] += step * place.x[i];
            }
            for a in 0..n {
                match of {
                    _ if spatial.contains(of) => there.phi[j][a] += step * place.phi[i][a],
                    Candidate::ComovingAffineSpin | Candidate::Vorticity => {
                        there.phi[a][i] += step * place.phi[a][j];
                    }
                    Candidate::ComovingLinearMomentum => there.x[a] += step * place.phi[a][i],
                    Candidate::CanonicalMomentum if a == i => there.phi[j][a] += step,
                    Candidate::LinearMomentum if a == i => there.x[a] += step,
                    _ => {}
                }
            }
        }
    }
    there
}

fn is_skew(of: Candidate) -> bool {
    matches!(
        of,
        Candidate::Spin
            | Candidate::OrbitalAngularMomentum
            | Candidate::TotalAngularMomentum
            | Candidate::Vorticity
    )
}

/// Near the identity.
fn linear(random: &mut Random, n: usize) -> Square<Quad> {
    Place::random(random, n, 0.2).phi
}

/// With determinant 1.
fn special(random: &mut Random, n: usize) -> Square<Quad> {
    let place = Place::random(random, n, 0.2);
    let scale = Scalar::exp(Scalar::ln(place.det()) / Quad::from(-(n as f64)));
    square(n, |i, j| place.phi[i][j] * scale)
}

/// A turn in every plane by an angle `2 atan u`.
fn rotation(random: &mut Random, n: usize) -> Square<Quad> {
    let mut rotation = square(n, |i, j| if i == j { Quad::ONE } else { Quad::ZERO });
    for (a, b) in (0..n).flat_map(|a| (a + 1..n).map(move |b| (a, b))) {
        let u = Quad::from(short(random, 0.1, 0.9));
        let below = Quad::ONE + u * u;
        let (cosine, sine) = ((Quad::ONE - u * u) / below, (u + u) / below);
        let mut turn = square(n, |i, j| if i == j { Quad::ONE } else { Quad::ZERO });
        (turn[a][a], turn[b][b], turn[a][b], turn[b][a]) = (cosine, cosine, -sine, sine);
        rotation = product(&rotation, &turn);
    }
    rotation
}
