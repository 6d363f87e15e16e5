//! The reduced equations, which runs integrate, where the state is part of a phase point as it is: what turns with the body or
//! moves in closed form is left to tests of its own.

use std::collections::HashMap;

use affine_codegen::mechanics::reduction::Reduction;
use affine_codegen::symbol::Symbol;
use qd::Quad;

use super::check::{Mistakes, Point, compare};
use super::model::{Named, Reads, charts};
use super::number::{Dual, Rounded};
use super::place::{Square, applied, inverse, product, square, transposed};

/// Is every state variable a function of the phase point at the same time?
fn is_plain(reduction: &Reduction) -> bool {
    let moves_by_itself = reduction.turn.is_some() || reduction.dilatation.is_some();
    let commuting = &reduction.commuting;
    let is_apart = commuting.rotation.is_some() || commuting.drift.is_some() || reduction.conserved.affine;
    !moves_by_itself && !is_apart
}

/// Rates of `x`, `phi`, `p` and `Pi`.
struct Rates {
    x: Vec<Quad>,
    phi: Square<Quad>,
    p: Vec<Quad>,
    pi: Square<Quad>,
}

fn minus(a: &Square<Quad>, b: &Square<Quad>) -> Square<Quad> {
    square(a.len(), |i, j| a[i][j] - b[i][j])
}

impl Point<'_> {
    /// The reduced equations follow from the whole ones; whether they were looked at.
    pub(crate) fn reduced(&self, mistakes: &mut Mistakes) -> bool {
        let model = self.case.model;
        if !is_plain(&model.dynamics.reduction) {
            return false;
        }
        let expected = self.along(&self.canonical(&self.run(&model.dynamics.full.program, Reads::State)));
        let found = self.run(&model.dynamics.reduced.program, Reads::Reduced);
        let terms = expected.values().map(|rate| rate.error).fold(1.0, f64::max);
        let error = self.forces().iter().map(|(_, force)| force.error).fold(terms, f64::max);
        for name in model.dynamics.reduced.symbols().iter().map(Symbol::to_string) {
            let expected = Rounded { error, ..expected[&name] };
            compare(&format!("reduced d_{name}"), found[&format!("d_{name}")], expected, mistakes);
        }
        true
    }

    /// Canonical rates, from those of the model's own frames.
    fn canonical(&self, whole: &Named) -> Rates {
        let phase = &self.phase;
        let n = phase.place.dim();
        let matrix = |name: &str| -> Option<Square<Quad>> {
            let rate = |i: usize, j: usize| whole[&format!("d_{name}_{}{}", i + 1, j + 1)];
            whole.contains_key(&format!("d_{name}_11")).then(|| square(n, rate))
        };
        let vector = |name: &str| -> Option<Vec<Quad>> {
            (0..n).map(|i| whole.get(&format!("d_{name}_{}", i + 1)).copied()).collect()
        };
        let (phi, still, back) =
            (matrix("phi").expect("rates"), vec![Quad::ZERO; n], inverse(&phase.place.phi));
        let pi = matrix("pi").unwrap_or_else(|| match (matrix("sigma_hat"), matrix("sigma")) {
            (Some(body), _) => product(&minus(&body, &product(&phase.pi, &phi)), &back),
            (_, Some(space)) => product(&back, &minus(&space, &product(&phi, &phase.pi))),
            _ => panic!("no affine momentum"),
        });
        let from_body = |rate: Vec<Quad>| {
            let carried = applied(&transposed(&phi), &phase.p);
            let left: Vec<Quad> = (0..n).map(|a| rate[a] - carried[a]).collect();
            applied(&transposed(&back), &left)
        };
        let p = vector("p").or_else(|| vector("p_hat").map(from_body)).unwrap_or_else(|| still.clone());
        Rates { x: vector("x").unwrap_or(still), phi, p, pi }
    }

    /// Rates of the coordinates of every chart, and of the work of forces that change with the time.
    fn along(&self, rates: &Rates) -> HashMap<String, Rounded> {
        let phase = &self.phase;
        let n = phase.place.dim();
        let moving = |value: Quad, rate: Quad| {
            let mut moving = Dual::constant(value);
            moving.slopes[0] = Rounded::stored(rate);
            moving
        };
        let vector =
            |value: &[Quad], rate: &[Quad]| (0..n).map(|i| moving(value[i], rate[i])).collect::<Vec<_>>();
        let matrix =
            |value: &Square<Quad>, rate: &Square<Quad>| square(n, |i, j| moving(value[i][j], rate[i][j]));
        let place = &phase.place;
        let all = charts(
            (&vector(&place.x, &rates.x), &vector(&phase.p, &rates.p)),
            (&matrix(&place.phi, &rates.phi), &matrix(&phase.pi, &rates.pi)),
        );
        let work = ("work".to_owned(), self.energy.slopes[0]);
        all.into_iter().map(|(name, value)| (name, value.slopes[0])).chain([work]).collect()
    }
}
