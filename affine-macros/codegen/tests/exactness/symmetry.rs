//! Symmetry groups against brute force: random exact group elements applied to the energy itself.

use affine_codegen::diagnostics::{Diagnostic, FormMistake};
use affine_codegen::mechanics::form::Form;
use affine_codegen::mechanics::kinetic::Kinetic as Symbolic;
use affine_codegen::mechanics::symmetry::{Breaker, Group, Side, broken_by, largest_group};
use affine_oracle::{Kinetic, Matrix, Random, Rational, Term, rational};
use num_traits::Zero;

use super::models::{FAMILIES, Sample, TRANSLATIONS, form, literal, matrix_literal};
use super::points::fraction;
use super::tensors::isotropic;

/// `T` at a random motion and at its image under `phi -> A phi`, `x -> A x`, or `phi -> phi B`.
fn is_invariant(random: &mut Random, kinetic: &Kinetic, side: Side, element: &Matrix) -> bool {
    let n = kinetic.dimension();
    let (phi, x_dot, phi_dot) = (random.placement(n), random.matrix(n, 1), random.matrix(n, n));
    let image = match side {
        Side::Space => kinetic.energy(&(element * &phi), &(element * &x_dot), &(element * &phi_dot)),
        Side::Body => kinetic.energy(&(&phi * element), &x_dot, &(&phi_dot * element)),
    };
    kinetic.energy(&phi, &x_dot, &phi_dot).unwrap() == image.unwrap()
}

/// A random element of GL(n).
fn linear(random: &mut Random, n: usize) -> Matrix {
    loop {
        let entries: Vec<_> = (0..n * n).map(|_| fraction(random)).collect();
        let element = Matrix::from_rationals(n, n, &entries);
        if !element.determinant().is_zero() {
            return element;
        }
    }
}

/// `(1 - W)(1 + W)^-1` for a random skew `W` (Cayley), perhaps times a reflection.
fn orthogonal(random: &mut Random, n: usize, reflect: bool) -> Matrix {
    let entries: Vec<_> = (0..n * n).map(|_| fraction(random)).collect();
    let skew = Matrix::from_rationals(n, n, &entries).skew();
    let one = Matrix::identity(n);
    let rotation = &(&one - &skew) * &(&one + &skew).inverse().unwrap();
    if reflect { &rotation * &reflection(n) } else { rotation }
}

fn reflection(n: usize) -> Matrix {
    &Matrix::identity(n) - &Matrix::unit(n, 0, 0).scaled(&rational(2, 1))
}

fn by_force(random: &mut Random, kinetic: &Kinetic, side: Side) -> Group {
    let n = kinetic.dimension();
    let affine = (0..3).all(|_| {
        let element = linear(random, n);
        is_invariant(random, kinetic, side, &element)
    });
    let metric = [true, false, true, false].into_iter().all(|reflect| {
        let element = orthogonal(random, n, reflect);
        is_invariant(random, kinetic, side, &element)
    });
    match (affine, metric) {
        (true, _) => Group::Affine,
        (false, true) => Group::Metric,
        (false, false) => Group::Less,
    }
}

/// An element of the one-parameter group that is named; it generates the group up to closure.
fn element(n: usize, breaker: Breaker) -> Matrix {
    let one = Matrix::identity(n);
    match breaker {
        Breaker::Generator(a, b) => &one + &Matrix::unit(n, a - 1, b - 1).scaled(&rational(2, 1)),
        // cos = 3/5, sin = 4/5: an angle that is no rational part of the full one.
        Breaker::Rotation(a, b) => {
            let (a, b) = (a - 1, b - 1);
            let diagonal = &Matrix::unit(n, a, a) + &Matrix::unit(n, b, b);
            let skew = &Matrix::unit(n, a, b) - &Matrix::unit(n, b, a);
            let turned = &diagonal.scaled(&rational(3, 5)) + &skew.scaled(&rational(4, 5));
            &(&one - &diagonal) + &turned
        }
        Breaker::Reflection => reflection(n),
    }
}

/// What generates a group, in the order in which it is tried.
fn generators(n: usize, group: Group) -> Vec<Breaker> {
    let pairs = || (1..=n).flat_map(move |a| (1..=n).map(move |b| (a, b)));
    let mut list: Vec<Breaker> = match group {
        Group::Affine => pairs().map(|(a, b)| Breaker::Generator(a, b)).collect(),
        _ => pairs().filter(|(a, b)| a < b).map(|(a, b)| Breaker::Rotation(a, b)).collect(),
    };
    list.push(Breaker::Reflection);
    list
}

fn check(random: &mut Random, args: &str, terms: &[Term], n: usize) -> [Group; 2] {
    let kinetic = Kinetic::new(n, terms.to_vec()).unwrap();
    let Form { parts, space_group, body_group, .. } =
        form(args, "struct Model;").unwrap_or_else(|_| panic!("{args}"));
    let mut groups = [Group::Less; 2];
    for (k, (side, known)) in [(Side::Space, space_group), (Side::Body, body_group)].into_iter().enumerate() {
        groups[k] = largest_group(&parts[0], side);
        assert_eq!(groups[k], by_force(random, &kinetic, side), "{side:?} of {args}");
        assert_eq!(groups[k], known);
        for group in [Group::Affine, Group::Metric] {
            named(random, &parts[0], &kinetic, terms, (side, group));
        }
    }
    groups
}

/// The breaker and the term that are named do break the symmetry; all breakers before it do not.
fn named(
    random: &mut Random,
    symbolic: &Symbolic,
    kinetic: &Kinetic,
    terms: &[Term],
    (side, group): (Side, Group),
) {
    let n = kinetic.dimension();
    let breaker = broken_by(symbolic, side, group);
    for generator in generators(n, group) {
        let invariant = is_invariant(random, kinetic, side, &element(n, generator));
        let Some((breaker, place)) = breaker.filter(|(breaker, _)| *breaker == generator) else {
            assert!(invariant, "{generator:?} on {side:?} breaks {terms:?}");
            continue;
        };
        assert!(!invariant, "{breaker:?} on {side:?} does not break {terms:?}");
        let alone = Kinetic::new(n, vec![terms[place].clone()]).unwrap();
        assert!(!is_invariant(random, &alone, side, &element(n, breaker)), "term {place} of {terms:?}");
        return;
    }
    assert_eq!(breaker, None);
}

#[test]
fn groups_of_every_family() {
    let mut random = Random::new(101);
    for n in [2, 3] {
        for internal in FAMILIES {
            for translation in TRANSLATIONS {
                let sample = Sample::new(&mut random, n, internal, translation);
                check(&mut random, &sample.args, &sample.terms, n);
            }
        }
    }
}

/// Isotropic tensors have the group of the named terms, GL(n) with `I = 0` included.
#[test]
fn groups_of_isotropic_tensors() {
    let mut random = Random::new(102);
    for n in [2, 3] {
        for i in [rational(0, 1), rational(2, 3)] {
            let k = isotropic(n, &i, &rational(5, 1), &rational(1, 7));
            let group = if i.is_zero() { Group::Affine } else { Group::Metric };
            let body = format!("dim = {n}, kinetic(body_tensor = {})", matrix_literal(&k));
            let groups = check(&mut random, &body, &[Term::BodyTensor(k.clone())], n);
            assert_eq!(groups, [Group::Affine, group]);
            let space = format!("dim = {n}, kinetic(space_tensor = {})", matrix_literal(&k));
            let groups = check(&mut random, &space, &[Term::SpaceTensor(k.clone())], n);
            assert_eq!(groups, [group, Group::Affine]);
        }
    }
}

/// `I/2 tr(O O^T) + c tr(O)(O12 - O21)`: left alone by SO(2), changed by a reflection.
fn chiral(c: &Rational) -> Matrix {
    let one = rational(3, 1);
    let zero = rational(0, 1);
    let (plus, minus) = (c.clone(), -c);
    let rows = [
        [&one, &plus, &minus, &zero],
        [&plus, &one, &zero, &plus],
        [&minus, &zero, &one, &minus],
        [&zero, &plus, &minus, &one],
    ];
    let entries: Vec<Rational> = rows.iter().flatten().map(|entry| (*entry).clone()).collect();
    Matrix::from_rationals(4, 4, &entries)
}

#[test]
fn rotations_without_reflections_are_not_enough() {
    let mut random = Random::new(103);
    let k = chiral(&rational(1, 2));
    for (term, energy, side) in [
        ("body_tensor", Term::BodyTensor(k.clone()), Side::Body),
        ("space_tensor", Term::SpaceTensor(k.clone()), Side::Space),
    ] {
        let args = format!("dim = 2, kinetic({term} = {})", matrix_literal(&k));
        let kinetic = Kinetic::new(2, vec![energy.clone()]).unwrap();
        for _ in 0..4 {
            let rotation = orthogonal(&mut random, 2, false);
            assert!(is_invariant(&mut random, &kinetic, side, &rotation));
        }
        let groups = check(&mut random, &args, &[energy], 2);
        assert_eq!(groups[if side == Side::Space { 0 } else { 1 }], Group::Less);
        let name = if side == Side::Space { "space" } else { "body" };
        let claimed = format!("symmetry({name} = metric), {args}");
        let refusal = form(&claimed, "struct Chiral;").err().expect("refused");
        let found: Vec<&Diagnostic> = refusal.diagnostics().collect();
        let [Diagnostic::Form(FormMistake::ClaimBroken { side, group, term: broken, transformation, .. })] =
            found.as_slice()
        else {
            panic!("{:?}", found.iter().map(ToString::to_string).collect::<Vec<_>>())
        };
        assert_eq!((*side, group.as_str(), *broken), (name, "O(2)", term));
        assert_eq!(transformation, "the reflection diag(-1, 1)");
        // In three dimensions no such energy exists: rotations alone already make a form isotropic.
        assert!(form(&format!("symmetry({name} = none), {args}"), "struct Chiral;").is_ok());
    }
}

/// A claim names the term that breaks it, beside terms that do not.
#[test]
fn claims_name_the_term() {
    let mut random = Random::new(104);
    for n in [2, 3] {
        let i = literal(&fraction(&mut random));
        let args = format!(
            "dim = {n}, symmetry(space = affine, body = affine), kinetic(casimir2 = 20, body_inertia = {i})"
        );
        let refusal = form(&args, "struct Model;").err().expect("refused");
        let found: Vec<&Diagnostic> = refusal.diagnostics().collect();
        let [Diagnostic::Form(FormMistake::ClaimBroken { side, term, transformation, .. })] =
            found.as_slice()
        else {
            panic!("one mistake")
        };
        assert_eq!((*side, *term), ("body", "body_inertia"));
        assert_eq!(transformation, "the generator E[1,1]");
    }
}
