//! Legendre transformation, energies and Hamilton's equations of every family, equal to the oracle's.

use affine_codegen::derive::Model;
use affine_codegen::mechanics::term::Frame;
use affine_codegen::symbol::Aspect;
use affine_oracle::{Kinetic, Random, State, rational};

use super::models::{FAMILIES, Internal, Sample, TRANSLATIONS, Translation};
use super::points::{Values, agree, coordinates, exact, own, rates, run, velocities};

/// A random point; without translation at `x = p = 0`.
pub(crate) fn point(random: &mut Random, kinetic: &Kinetic) -> State {
    let n = kinetic.dimension();
    let state = random.state(n);
    if kinetic.has_translation() {
        return state;
    }
    let nowhere = affine_oracle::Matrix::zeros(n, 1);
    State::new(nowhere.clone(), state.phi, nowhere, state.pi).unwrap()
}

/// Names of the affine velocity and the affine spin of a frame.
fn names(frame: Frame) -> (&'static str, &'static str) {
    match frame {
        Frame::Body => ("omega_hat_", "sigma_hat_"),
        Frame::Space => ("omega_", "sigma_"),
        Frame::Flat => ("phi_dot_", "pi_"),
    }
}

/// All programs of the model's own frames at one point.
pub(crate) fn check(what: &str, model: &Model, kinetic: &Kinetic, state: &State, coefficients: &Values) {
    let n = model.dim;
    let motion = kinetic.motion(state).unwrap();
    let mut here = coordinates(kinetic, state);
    here.extend(coefficients.clone());
    let mut moving = velocities(kinetic, state);
    moving.extend(coefficients.clone());
    let (velocity, spin) = names(model.frame);
    let stem = |values: &Values, stem: &str| -> Values {
        values.iter().filter_map(|(k, v)| Some((k.strip_prefix(stem)?.to_owned(), v.clone()))).collect()
    };

    agree(what, &run(&model.point.velocity, &here), velocity, &stem(&moving, velocity), n * n);
    let velocity_side = model.point.velocity_side.as_ref().expect("the velocity determines the momentum");
    agree(what, &run(&velocity_side.legendre, &moving), spin, &stem(&here, spin), n * n);
    for (program, inputs) in [(&velocity_side.kinetic_energy, &moving), (&model.point.hamiltonian, &here)] {
        let energy = run(program, inputs);
        assert_eq!(energy["energy"], own(motion.energy()), "{what}: energy");
        assert_eq!(energy.len(), 1);
    }
    let size = n * n + if kinetic.has_translation() { n } else { 0 };
    agree(what, &run(&model.dynamics.full.program, &here), "d_", &rates(&motion), 2 * size);
    let rates = model.dynamics.full.symbols().into_iter().map(|symbol| symbol.seen(Aspect::Rate));
    assert!(rates.eq(model.dynamics.full.program.results().cloned()), "{what}: order of the state");
}

#[test]
fn every_family_is_derived_exactly() {
    let mut random = Random::new(11);
    let (mut models, mut indefinite) = (0, 0);
    for n in [2, 3] {
        for internal in FAMILIES {
            for translation in TRANSLATIONS {
                let large = n == 3 && internal as usize >= Internal::BodyTensor as usize;
                for _ in 0..if large { 1 } else { 4 } {
                    let sample = Sample::new(&mut random, n, internal, translation);
                    let model = sample.derived();
                    models += 1;
                    indefinite += usize::from(sample.is_indefinite());
                    for _ in 0..2 {
                        let state = point(&mut random, &sample.kinetic);
                        check(&sample.args, &model, &sample.kinetic, &state, &Values::new());
                    }
                    well_described(&sample, &model);
                }
            }
        }
    }
    assert!(3 * indefinite >= models, "{indefinite} of {models} models are indefinite");
}

/// Dimension, frames, signature, mass.
fn well_described(sample: &Sample, model: &Model) {
    let what = &sample.args;
    assert_eq!(model.dim, sample.n);
    let frame = match sample.internal {
        Internal::Affine if sample.translation == Translation::Space => Frame::Space,
        Internal::Affine
        | Internal::Body
        | Internal::BodyTensor
        | Internal::BodySum
        | Internal::BodyDiagonal
        | Internal::BodyMatrix => Frame::Body,
        Internal::Space
        | Internal::SpaceTensor
        | Internal::SpaceSum
        | Internal::SpaceDiagonal
        | Internal::SpaceMatrix => Frame::Space,
        _ => Frame::Flat,
    };
    assert_eq!(model.frame, frame, "{what}");
    let signature = sample.signature();
    assert_eq!(model.description.signature, Some((signature.positive, signature.negative)), "{what}");
    assert_eq!(model.point.mass.is_some(), sample.translation != Translation::None);
    if let Some(mass) = &model.point.mass {
        let mass = run(mass, &Values::new());
        assert_eq!(exact(&mass["mass"]), sample.m, "{what}");
        assert_eq!(exact(&mass["inverse_mass"]), sample.m.recip(), "{what}");
    }
}

/// (4.24): `1/alpha = 1/(I+A)`, `1/beta = -B/((I+A)(I+A+nB))`, `1/mu = I/(I^2-A^2)`.
#[test]
fn isotropic_coefficients() {
    let mut random = Random::new(12);
    for n in [2, 3] {
        for internal in [Internal::Affine, Internal::Body, Internal::Space] {
            for translation in TRANSLATIONS {
                let sample = Sample::new(&mut random, n, internal, translation);
                let model = sample.derived();
                let found = run(model.point.isotropic.as_ref().expect("isotropic"), &Values::new());
                let (i, a, b) = (&sample.i, &sample.a, &sample.b);
                let shear = i + a;
                let dilatation = &shear + rational(i64::try_from(n).unwrap(), 1) * b;
                assert_eq!(exact(&found["inverse_alpha"]), shear.recip());
                assert_eq!(exact(&found["inverse_beta"]), -b / (&shear * dilatation));
                assert_eq!(exact(&found["inverse_mu"]), i / (i * i - a * a));
                assert_eq!(found.len(), 3);
            }
        }
    }
}

#[test]
fn only_isotropic_affine_energies_have_isotropic_coefficients() {
    let mut random = Random::new(13);
    for internal in [
        Internal::DalembertScalar,
        Internal::DalembertMatrix,
        Internal::BodyTensor,
        Internal::BodyMatrix,
        Internal::FlatTensor,
    ] {
        let sample = Sample::new(&mut random, 2, internal, Translation::None);
        assert!(sample.derived().point.isotropic.is_none(), "{}", sample.args);
    }
}
