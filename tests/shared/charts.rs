//! What generated models of every kind are held against: layouts, the ways between charts, the flow of the reduced
//! equations.

use affine_oracle::{Matrix as Exact, Observable, Rational, State, rational, rounded};
use affine_runtime::model::{Conserved, Group, StateVector};
use affine_runtime::prelude::*;
use affine_runtime::scalar::Real;

use crate::dual::Dual;
use crate::reference::{Reference, assert_close, entries, exact_state, norm};

/// Time of the start.
pub const T0: f64 = 0.25;

/// The components of a plain array, group after group.
pub fn groups<'a, T>(layout: &'static [Group], array: &'a [T]) -> Vec<(&'static str, &'a [T])> {
    let mut rest = array;
    let parts = layout.iter().map(|group| {
        let (part, after) = rest.split_at(group.len);
        rest = after;
        (group.name(), part)
    });
    let parts: Vec<_> = parts.collect();
    assert!(rest.is_empty(), "the layout covers the array");
    parts
}

/// What a phase point is of, by name.
type Parts<T> = [(&'static str, Vec<T>); 7];

/// The parts of a point, each momentum in every frame. What is done with them is compiled once for all models.
fn parts<const N: usize, T: Real>(point: &impl Phase<N, T>) -> Parts<T> {
    [
        ("x", point.x().as_slice().to_vec()),
        ("phi", entries(point.phi())),
        ("p", point.p().as_slice().to_vec()),
        ("p_hat", point.p_hat().0.0.as_slice().to_vec()),
        ("Sigma", entries(&point.sigma().0.0)),
        ("Sigma_hat", entries(&point.sigma_hat().0.0)),
        ("Pi", entries(&point.pi().0.0)),
    ]
}

/// `point` is that of `state`.
pub fn assert_charts_lead_back<const N: usize, M: Model<N>>(
    model: &M,
    point: &M::Point<f64>,
    state: &State,
    tolerance: f64,
) {
    let (reduced, constants) = model.reduce(T0, point);
    assert_parts(parts(&model.unflatten(&model.flatten(point))), state, tolerance);
    assert_parts(parts(&model.expand(T0, &constants, &reduced)), state, tolerance);
}

fn assert_parts(parts: Parts<f64>, state: &State, tolerance: f64) {
    for (what, found) in parts {
        let expected = match what {
            "x" => state.x.to_f64(),
            "phi" => state.phi.to_f64(),
            "p" => state.p.to_f64(),
            "Pi" => state.pi.to_f64(),
            _ => continue,
        };
        assert_close(what, &found, &expected, norm(&expected), tolerance);
    }
}

/// Of everything a point has, in every frame; at a time away from the start, by which the pieces that commute have
/// moved the point. There the reduced state of the start stands for another point, as good as any; `reference` is the
/// exact motion through it.
pub fn assert_reduced_equations_move<const N: usize, M: Model<N>>(
    model: &M,
    start: &M::Point<f64>,
    tolerance: f64,
    reference: &dyn Fn(f64, &State) -> Reference,
) {
    // Rotations by angles of order 1.
    let t = T0 + 0.75 * start.phi().norm() / model.velocity(start).phi_dot.norm();
    let (reduced, constants) = model.reduce(T0, start);
    let spin = M::DESCRIPTION.full.last().unwrap().name();
    let state = exact_state(spin, &model.expand(t, &constants, &reduced));

    let mut full = M::Full::<Dual>::zeros();
    fix(full.as_mut(), model.flatten(start).as_ref());
    let (mut reduced, constants) = model.reduce(Dual::fixed(T0), &model.unflatten(&full));
    let now = Dual { value: t, slope: 1.0 };
    let rates = model.reduced_equations(now, &constants, &reduced);
    move_by(reduced.as_mut(), rates.as_ref());
    assert_rates(parts(&model.expand(now, &constants, &reduced)), &reference(t, &state), tolerance);
}

fn fix(duals: &mut [Dual], values: &[f64]) {
    duals.iter_mut().zip(values).for_each(|(dual, value)| *dual = Dual::fixed(*value));
}

fn move_by(state: &mut [Dual], rates: &[Dual]) {
    state.iter_mut().zip(rates).for_each(|(state, rate)| state.slope = rate.value);
}

fn assert_rates(moving: Parts<Dual>, reference: &Reference, tolerance: f64) {
    for (name, moving) in moving {
        let slopes: Vec<f64> = moving.iter().map(|dual| dual.slope).collect();
        reference.assert_rate(name, &slopes, tolerance);
    }
}

/// Does the quantity exist for such a model?
pub fn exists(quantity: Observable, n: usize, translation: bool) -> bool {
    use Observable::{
        Casimir3, ComovingLinearMomentum, DeviatorCasimir3, LinearMomentum, OrbitalAngularMomentum,
        TotalAffineMomentum, TotalAngularMomentum,
    };
    match quantity {
        LinearMomentum
        | ComovingLinearMomentum
        | OrbitalAngularMomentum
        | TotalAffineMomentum
        | TotalAngularMomentum => translation,
        Casimir3 | DeviatorCasimir3 => n == 3,
        _ => true,
    }
}

/// The quantities that are listed as a whole. The components beside them do not change along the motions of these brackets, but
/// for roundings of size `zero`; of each momentum that `exists` and is not listed as a whole, every entry that does not change is
/// among them.
pub fn listed_as_a_whole(
    listed: &[Conserved],
    exists: &dyn Fn(Observable) -> bool,
    zero: f64,
    brackets: &dyn Fn(Observable) -> Vec<Exact>,
) -> Vec<Observable> {
    let (mut whole, mut components) = (Vec::new(), Vec::new());
    for quantity in listed {
        match quantity {
            Conserved::Component(component) => components.push(component),
            quantity => whole.push(observable(*quantity)),
        }
    }
    let rates = |of: Observable, row: usize, column: usize| -> Vec<Rational> {
        brackets(of).iter().map(|rate| rate.entry(row - 1, column - 1)).collect()
    };
    for component in &components {
        let (mut sums, mut size) = (Vec::new(), 0.0);
        for entry in component.entries {
            let rates = rates(observable(entry.of), entry.row, entry.column);
            sums.resize(rates.len(), rational(0, 1));
            sums.iter_mut().zip(rates).for_each(|(sum, rate)| *sum += rational(entry.factor, 1) * rate);
            size += entry.factor.abs() as f64;
        }
        assert!(sums.iter().all(|rate| rounded(rate).abs() <= zero * size), "{}: {sums:?}", component.symbol);
    }
    for of in [
        Observable::LinearMomentum,
        Observable::Spin,
        Observable::OrbitalAngularMomentum,
        Observable::Vorticity,
    ] {
        if !exists(of) || whole.contains(&of) {
            continue;
        }
        let (rows, columns) = brackets(of)[0].shape();
        for (row, column) in (1..=rows).flat_map(|row| (1..=columns).map(move |column| (row, column))) {
            if of == Observable::LinearMomentum || row < column {
                let is_at_rest = rates(of, row, column).iter().all(|rate| rounded(rate).abs() <= zero);
                let is_listed = components.iter().any(|component| match component.entries {
                    [entry] => (observable(entry.of), entry.row, entry.column) == (of, row, column),
                    _ => false,
                });
                assert_eq!(is_listed, is_at_rest, "{of:?}, entry {row}{column}");
            }
        }
    }
    whole
}

fn observable(quantity: Conserved) -> Observable {
    Observable::named(&format!("{quantity:?}")).unwrap()
}

/// `N x N`, from row-major entries.
pub fn matrix<const N: usize>(entries: &[f64]) -> Matrix<N> {
    Matrix::from_row_slice(entries)
}

/// A vector.
pub fn vector<const N: usize>(entries: &[f64]) -> Vector<N> {
    Vector::from_column_slice(entries)
}
