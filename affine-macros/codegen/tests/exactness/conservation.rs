//! The list of conserved quantities: every bracket with `H` on it vanishes exactly, every other is seen not to.

use affine_codegen::derive::Conserved;
use affine_oracle::{Kinetic, Observable, Random};

use super::components::assert_both_complete;
use super::derivation::point;
use super::models::{FAMILIES, Internal, Sample, TRANSLATIONS, derived, matrix_literal, symmetric};

/// The conserved ones of the observables that exist, found at several points.
fn observed(random: &mut Random, kinetic: &Kinetic, at_rest: bool) -> Vec<&'static str> {
    let n = kinetic.dimension();
    let translation = kinetic.has_translation() && !at_rest;
    let states: Vec<_> = (0..3)
        .map(|_| {
            let state = point(random, kinetic);
            if at_rest { state.at_rest() } else { state }
        })
        .collect();
    let motions: Vec<_> = states.iter().map(|state| kinetic.motion(state).unwrap()).collect();
    Observable::ALL
        .iter()
        .filter(|observable| match observable {
            Observable::LinearMomentum
            | Observable::ComovingLinearMomentum
            | Observable::OrbitalAngularMomentum
            | Observable::TotalAffineMomentum
            | Observable::TotalAngularMomentum => translation,
            Observable::Casimir3 | Observable::DeviatorCasimir3 => n == 3,
            _ => true,
        })
        .filter(|observable| motions.iter().all(|m| m.bracket(**observable).unwrap().is_zero()))
        .map(|observable| observable.name())
        .collect()
}

fn names(list: &Conserved) -> Vec<String> {
    list.whole.iter().map(|candidate| format!("{candidate:?}")).collect()
}

#[test]
fn the_list_is_exactly_what_is_conserved() {
    let mut random = Random::new(31);
    for n in [2, 3] {
        for internal in FAMILIES {
            for translation in TRANSLATIONS {
                let sample = Sample::new(&mut random, n, internal, translation);
                let model = sample.derived();
                let moving = observed(&mut random, &sample.kinetic, false);
                assert_eq!(names(&model.description.conserved), moving, "{}", sample.args);
                let at_rest = observed(&mut random, &sample.kinetic, true);
                assert_eq!(names(&model.description.conserved_at_rest), at_rest, "{} at rest", sample.args);
                // In space few: a point for every momentum is many points. Of an inertia of long fractions, which is conserved
                // along the orthogonal group of its own metric, the components have longer ones.
                let lists = [&model.description.conserved, &model.description.conserved_at_rest];
                let is_long = matches!(internal, Internal::DalembertMatrix | Internal::DalembertDiagonal);
                if !is_long && (n == 2 || random.integer(0, 5) == 0) {
                    assert_both_complete(&sample.args, &mut random, &sample.kinetic, lists);
                }
            }
        }
    }
}

/// Coefficients without one of the terms: `B = 0`, `A = 0`, `I = 0` change what is conserved.
#[test]
fn vanishing_coefficients() {
    let mut random = Random::new(32);
    for n in [2, 3] {
        for (terms, energy) in sparse(n) {
            let model = derived(&format!("dim = {n}, kinetic({terms})"), "struct Model;");
            let kinetic = Kinetic::new(n, energy).unwrap();
            assert_eq!(
                names(&model.description.conserved),
                observed(&mut random, &kinetic, false),
                "{terms}, n = {n}"
            );
            assert_eq!(
                names(&model.description.conserved_at_rest),
                observed(&mut random, &kinetic, true),
                "{terms}"
            );
            assert_both_complete(
                terms,
                &mut random,
                &kinetic,
                [&model.description.conserved, &model.description.conserved_at_rest],
            );
        }
    }
}

fn sparse(n: usize) -> Vec<(&'static str, Vec<affine_oracle::Term>)> {
    use affine_oracle::{Term, rational};
    let one = || rational(1, 1);
    vec![
        ("body_inertia = 1", vec![Term::body_inertia(n, one())]),
        ("space_inertia = 1", vec![Term::space_inertia(n, one())]),
        ("casimir2 = 1", vec![Term::Casimir2(one())]),
        (
            "casimir2 = 1, space_translation = 2",
            vec![Term::Casimir2(one()), Term::SpaceTranslation(rational(2, 1))],
        ),
        (
            "casimir2 = -1, body_translation = 2",
            vec![Term::Casimir2(-one()), Term::BodyTranslation(rational(2, 1))],
        ),
        (
            "body_inertia = 1, space_translation = 1",
            vec![Term::body_inertia(n, one()), Term::SpaceTranslation(one())],
        ),
    ]
}

/// A planar energy that rotations leave alone, but not reflections: the vorticity is conserved all the same.
#[test]
fn a_chiral_energy() {
    let mut random = Random::new(33);
    // I/2 tr(O O^T) + c tr(O)(O12 - O21), on (O11, O12, O21, O22).
    let text = "[[3, 1, -1, 0], [1, 3, 0, 1], [-1, 0, 3, -1], [0, 1, -1, 3]]";
    let entries = [3, 1, -1, 0, 1, 3, 0, 1, -1, 0, 3, -1, 0, 1, -1, 3];
    let entries: Vec<_> = entries.iter().map(|e| affine_oracle::rational(*e, 1)).collect();
    let k = affine_oracle::Matrix::from_rationals(4, 4, &entries);
    let kinetic = Kinetic::new(2, vec![affine_oracle::Term::BodyTensor(k)]).unwrap();
    let model = derived(&format!("dim = 2, kinetic(body_tensor = {text})"), "struct Chiral;");
    let list = names(&model.description.conserved);
    assert_eq!(list, observed(&mut random, &kinetic, false));
    assert!(list.contains(&"Vorticity".to_owned()));
}

/// A tensor that is block-diagonal by chance conserves nothing more than a general one.
#[test]
fn sparse_tensors() {
    let mut random = Random::new(34);
    let mut tried = 0;
    while tried < 6 {
        let k = symmetric(&mut random, 4);
        let kinetic = Kinetic::new(2, vec![affine_oracle::Term::SpaceTensor(k.clone())]).unwrap();
        if kinetic.signature(&affine_oracle::Matrix::identity(2)).unwrap().zero > 0 {
            continue;
        }
        tried += 1;
        let args = format!("dim = 2, kinetic(space_tensor = {})", matrix_literal(&k));
        let model = derived(&args, "struct Model;");
        assert_eq!(names(&model.description.conserved), observed(&mut random, &kinetic, false), "{args}");
        assert_both_complete(
            &args,
            &mut random,
            &kinetic,
            [&model.description.conserved, &model.description.conserved_at_rest],
        );
    }
}
