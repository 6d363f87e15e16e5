//! Reduced equations: the exact motion of the energy that is left when its commuting pieces are split off.

use affine_codegen::algebra::Rational;
use affine_codegen::derive::Model;
use affine_codegen::mechanics::charts::Momentum;
use affine_codegen::mechanics::closed_form::ClosedForm;
use affine_codegen::mechanics::reduction::{Commuting, Reduction};
use affine_codegen::mechanics::term::Frame;
use affine_codegen::symbol::Quantity;
use affine_oracle::{Kinetic, Matrix, Observable, Random, Rational as Exact, State, rational};

use super::derivation::point;
use super::models::{FAMILIES, Internal, Sample, TRANSLATIONS, Translation};
use super::points::{Values, coordinates, exact, names, rates, run};

/// The energy of the reduced equations.
pub(crate) fn rest(sample: &Sample, reduction: &Reduction) -> Kinetic {
    let Commuting { rotation, drift } = &reduction.commuting;
    let skew = rotation.is_some();
    assert!(!skew || matches!(sample.internal, Internal::Body | Internal::Space));
    let mut terms = if skew { sample.without_skew_part() } else { sample.internal_terms() };
    if drift.is_none() {
        terms.extend(sample.translational_term());
    }
    Kinetic::new(sample.n, terms).unwrap()
}

/// A point that respects the turn of space: `p = (p_1, 0, 0)`, and `I(O)_13 = 0`.
pub(crate) fn turned(state: State) -> State {
    let n = state.dimension();
    let mut p = vec![rational(0, 1); n];
    p[0] = state.p.entry(0, 0);
    let p = Matrix::from_rationals(n, 1, &p);
    let sigma = &state.phi * &state.pi;
    let mut entries = sigma.entries();
    // p_3 = 0, so that I(O)_13 = Sigma_13.
    entries[n - 1] = if n == 3 { rational(0, 1) } else { entries[n - 1].clone() };
    State::with_affine_spin(state.x, state.phi, p, &Matrix::from_rationals(n, n, &entries)).unwrap()
}

/// What the split-off pieces contribute to `H`.
fn split_energy(reduction: &Reduction, kinetic: &Kinetic, state: &State) -> Exact {
    let norm = |observable: Observable| observable.value(kinetic, state).unwrap().entry(0, 0);
    let half = rational(1, 2);
    let mut sum = rational(0, 1);
    let Commuting { rotation, drift } = &reduction.commuting;
    let rotation = rotation.iter().map(|rotation| {
        let square = match rotation.frame {
            Frame::Body => norm(Observable::VorticityNorm),
            _ => norm(Observable::SpinNorm),
        };
        (&rotation.inverse_mass, square)
    });
    let square = (&state.p.transpose() * &state.p).entry(0, 0);
    let drift = drift.iter().map(|drift| (&drift.inverse_mass, square.clone()));
    for (inverse, square) in rotation.chain(drift) {
        sum += exact(&inverse.as_constant().unwrap()) * square * &half;
    }
    sum
}

#[test]
fn every_family_is_reduced_exactly() {
    let mut random = Random::new(21);
    let mut turns = 0;
    for n in [2, 3] {
        for internal in FAMILIES {
            for translation in TRANSLATIONS {
                let sample = Sample::new(&mut random, n, internal, translation);
                let model = sample.derived();
                let rest = rest(&sample, &model.dynamics.reduction);
                for _ in 0..2 {
                    let mut state = point(&mut random, &sample.kinetic);
                    if model.dynamics.reduction.turn.is_some() {
                        turns += 1;
                        state = turned(state);
                    }
                    let split = split_energy(&model.dynamics.reduction, &sample.kinetic, &state);
                    let whole = sample.kinetic.hamiltonian(&state).unwrap().entry(0, 0);
                    if !rest.has_translation() {
                        state = state.at_rest();
                    }
                    let main = rest.hamiltonian(&state).unwrap().entry(0, 0);
                    assert_eq!(whole, main + split, "{}", sample.args);
                    equations(&sample.args, &model, &rest, &state, &Values::new());
                }
            }
        }
    }
    assert!(turns > 10);
}

/// The reduced equations against the motion of `rest`, in a model with these coefficients.
pub(crate) fn equations(what: &str, model: &Model, rest: &Kinetic, state: &State, coefficients: &Values) {
    let mut here = coordinates(rest, state);
    here.extend(coefficients.clone());
    let mut inputs = run(&model.dynamics.trajectory, &here);
    inputs.extend(coefficients.clone());
    let listed = names(&model.dynamics.reduced.symbols());
    for name in &listed {
        inputs.insert(name.clone(), here[name].clone());
    }
    let constants = constants(model);
    for name in names(&model.dynamics.trajectory.inputs()) {
        // Turned space has p = (p_1, 0, 0).
        assert!(
            model.dynamics.reduction.turn.is_none() || !["p_2", "p_3"].contains(&name.as_str()),
            "{what}: {name} is zero"
        );
        assert!(
            constants.contains(&name) || coefficients.contains_key(&name),
            "{what}: the trajectory reads {name}"
        );
    }
    let expected = rates(&rest.motion(state).unwrap());
    let found = run(&model.dynamics.reduced.program, &inputs);
    assert_eq!(found.len(), listed.len());
    for name in &listed {
        assert_eq!(found[&format!("d_{name}")], expected[name], "{what}: {name}");
    }
    // What is not integrated does not move.
    for name in &constants {
        assert_eq!(expected[name], Rational::ZERO, "{what}: {name} is a constant of the trajectory");
    }
}

/// The momenta that are constants of a trajectory: `p`, and all of the affine momentum or a part.
fn constants(model: &Model) -> Vec<String> {
    let n = model.dim;
    let mut list = Vec::new();
    if model.dynamics.reduction.chart.linear.is_some() {
        list.extend((1..=n).map(|i| format!("p_{i}")));
    }
    if model.dynamics.reduction.conserved.affine {
        let stem = model.dynamics.reduction.chart.momentum.quantity().stem();
        list.extend((1..=n).flat_map(|i| (1..=n).map(move |j| format!("{stem}_{i}{j}"))));
    }
    list.extend(names(&model.dynamics.passage.fixed()));
    list
}

/// The reduction of each family: chart, what is split off, what stays in the state, closed form.
#[test]
fn each_family_reduces_as_far_as_it_can() {
    let mut random = Random::new(22);
    for n in [2, 3] {
        for internal in FAMILIES {
            for translation in TRANSLATIONS {
                let sample = Sample::new(&mut random, n, internal, translation);
                let model = sample.derived();
                let reduction = &model.dynamics.reduction;
                let what = &sample.args;
                let flat = model.frame == Frame::Flat;
                let isotropic = matches!(internal, Internal::Affine | Internal::Body | Internal::Space);
                let clash = (internal == Internal::Body && translation == Translation::Space)
                    || (internal == Internal::Space && translation == Translation::Body);
                // Spatial translation commutes with everything internal.
                let drift = translation == Translation::Space;
                assert_eq!(reduction.commuting.drift.is_some(), drift, "{what}");
                // |S|^2 does not commute with |phi^T p|^2; vorticity is conserved by both translations.
                let skew = matches!(internal, Internal::Body)
                    || (internal == Internal::Space && translation != Translation::Body);
                let frame = if internal == Internal::Space { Frame::Space } else { Frame::Body };
                let rotation = reduction.commuting.rotation.as_ref().map(|rotation| rotation.frame);
                assert_eq!(rotation, skew.then_some(frame), "{what}");
                let moving = translation == Translation::Body;
                let rotations = !matches!(
                    internal,
                    Internal::SpaceTensor
                        | Internal::SpaceSum
                        | Internal::SpaceDiagonal
                        | Internal::SpaceMatrix
                        | Internal::FlatTensor
                        | Internal::FlatSum
                );
                let turns = moving && rotations;
                assert_eq!(reduction.turn.is_some(), turns, "{what}");
                if (isotropic && !(clash && moving)) || (flat && !moving) {
                    assert!(reduction.conserved.affine, "{what}");
                }
                let x_in_state = model.dynamics.reduced.has(Quantity::Position);
                assert_eq!(x_in_state, moving, "{what}");
                // At p = 0 the skew part of every isotropic energy commutes with the rest.
                let closed = match (isotropic, model.frame) {
                    (_, Frame::Flat) => Some(ClosedForm::Straight),
                    (false, _) => None,
                    (true, Frame::Body) => Some(ClosedForm::Body),
                    (true, Frame::Space) => Some(ClosedForm::Space),
                };
                assert_eq!(model.dynamics.closed_form, closed.map(|form| (form, moving)), "{what}");
            }
        }
    }
}

/// P1 integrates x and phi alone: p and I(O) are constants of the trajectory.
#[test]
fn the_drunk_missile_integrates_position_and_placement() {
    let args =
        "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)";
    let model = super::models::derived(args, "struct Missile;");
    assert_eq!(model.dynamics.reduction.chart.momentum, Momentum::Total);
    let quantities: Vec<Quantity> =
        model.dynamics.reduced.groups.iter().map(|(quantity, _)| *quantity).collect();
    assert_eq!(quantities, [Quantity::Position, Quantity::Placement]);
    let size: usize = model.dynamics.reduced.groups.iter().map(|(_, components)| components.len()).sum();
    assert_eq!(size, 12);
    assert!(model.prepared.coefficients.outputs.is_empty());
}
