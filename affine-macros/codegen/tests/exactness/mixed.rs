//! Sums of terms of different frames: every program equal to the oracle's velocity form and canonical brackets.

use affine_codegen::check;
use affine_codegen::derive::{Model, derive};
use affine_codegen::diagnostics::gate;
use affine_codegen::mechanics::form::Form;
use affine_codegen::mechanics::kinetic::Kinetic as Part;
use affine_codegen::mechanics::mixed::laws_hold;
use affine_codegen::mechanics::motion::Motion;
use affine_codegen::mechanics::term::Frame;
use affine_codegen::spec;
use affine_oracle::{Kinetic, Matrix, Observable, Random, State, Term, rational};

use super::components::assert_both_complete;
use super::derivation::point;
use super::models::{literal, matrix_literal, symmetric};
use super::points::{Values, agree, coordinates, exact, fraction, own, put, rates, run, velocities};
use super::reduction::{equations, turned};

/// Internal and translational terms, by the names of the specification.
const SUMS: [&[&str]; 18] = [
    &["dalembert", "casimir2"],
    &["dalembert", "casimir2", "casimir1_squared", "space_translation"],
    &["dalembert", "body_inertia", "body_translation"],
    &["dalembert_matrix", "body_inertia_matrix", "casimir2"],
    &["dalembert_matrix", "space_inertia_matrix", "space_translation"],
    &["dalembert", "body_inertia", "space_inertia", "casimir1_squared"],
    &["body_inertia", "space_inertia"],
    &["body_inertia_matrix", "space_inertia_matrix", "casimir2", "body_translation", "space_translation"],
    &["flat_tensor", "body_inertia"],
    &["dalembert", "body_tensor"],
    &["dalembert", "space_tensor", "casimir1_squared"],
    &["body_inertia", "space_tensor"],
    // Tensors that act on the rows of the velocity alone, beside an inertia that does.
    &["body_inertia", "space_inertia", "space_tensor_rows"],
    &["space_inertia", "body_inertia_matrix", "body_tensor_rows"],
    &["body_inertia", "casimir2", "body_translation", "space_translation"],
    &["space_inertia_matrix", "body_translation", "space_translation"],
    &["dalembert_matrix", "body_translation", "space_translation"],
    &["body_tensor", "casimir2", "body_translation", "space_translation"],
];

/// A random sum of terms, as text and for the oracle.
struct Sum {
    text: String,
    terms: Vec<Term>,
    kinetic: Kinetic,
}

impl Sum {
    fn new(random: &mut Random, n: usize, names: &[&str]) -> Self {
        loop {
            let (mut texts, mut terms) = (Vec::new(), Vec::new());
            for name in names {
                let key = name.trim_end_matches("_matrix").trim_end_matches("_rows");
                let (value, term) = term(random, n, name);
                texts.push(format!("{key} = {value}"));
                terms.push(term);
            }
            let kinetic = Kinetic::new(n, terms.clone()).unwrap();
            let text = format!("dim = {n}, kinetic({}), emit(metric, acceleration)", texts.join(", "));
            if kinetic.signature(&Matrix::identity(n)).unwrap().zero == 0 {
                let moving = kinetic.has_translation();
                let text = if moving { text } else { text.replace(", acceleration", "") };
                return Sum { text, terms, kinetic };
            }
        }
    }
}

fn term(random: &mut Random, n: usize, name: &str) -> (String, Term) {
    let number = fraction(random);
    let size = if number < rational(0, 1) { -number.clone() } else { number.clone() };
    let mass = rational(1, 3) * &size;
    let (inertia, tensor) = (random.inertia(n), symmetric(random, n * n));
    let rows = row_by_row(&inertia);
    match name {
        "dalembert" => (literal(&size), Term::dalembert(n, size)),
        "dalembert_matrix" => (matrix_literal(&inertia), Term::DAlembert(inertia)),
        "casimir2" => (literal(&number), Term::Casimir2(number)),
        "casimir1_squared" => (literal(&number), Term::Casimir1Squared(number)),
        "body_inertia" => (literal(&number), Term::body_inertia(n, number)),
        "space_inertia" => (literal(&number), Term::space_inertia(n, number)),
        "body_inertia_matrix" => (matrix_literal(&inertia), Term::BodyInertia(inertia)),
        "space_inertia_matrix" => (matrix_literal(&inertia), Term::SpaceInertia(inertia)),
        "body_tensor" => (matrix_literal(&tensor), Term::BodyTensor(tensor)),
        "space_tensor" => (matrix_literal(&tensor), Term::SpaceTensor(tensor)),
        "body_tensor_rows" => (matrix_literal(&rows), Term::BodyTensor(rows)),
        "space_tensor_rows" => (matrix_literal(&rows), Term::SpaceTensor(rows)),
        "flat_tensor" => (matrix_literal(&tensor), Term::FlatTensor(tensor)),
        "body_translation" => (literal(&mass), Term::BodyTranslation(mass)),
        "space_translation" => (literal(&mass), Term::SpaceTranslation(mass)),
        other => panic!("no term {other}"),
    }
}

/// The tensor `K[nA+B][nC+D] = delta_AC J_BD` of `tr(O J O^T)`.
fn row_by_row(inertia: &Matrix) -> Matrix {
    let n = inertia.shape().0;
    let places = (0..n).flat_map(|a| (0..n).flat_map(move |b| (0..n).map(move |d| (a, b, d))));
    places.fold(Matrix::zeros(n * n, n * n), |sum, (a, b, d)| {
        &sum + &Matrix::unit(n * n, n * a + b, n * a + d).scaled(&inertia.entry(b, d))
    })
}

fn form(args: &str) -> Form {
    let spec = gate(|found| spec::parse(args.parse().unwrap(), "struct Model;".parse().unwrap(), found))
        .unwrap_or_else(|_| panic!("{args}"));
    assert!(gate(|found| check::as_written(&spec, found)).is_ok(), "{args}");
    gate(|found| check::energy(&spec, found)).unwrap_or_else(|_| panic!("{args}"))
}

fn derived(args: &str) -> Model {
    derive(form(args), false).expect("a derivation")
}

/// Every sum in the plane and in space.
fn sums(random: &mut Random) -> Vec<(Sum, Model)> {
    let mut list = Vec::new();
    for n in [2, 3] {
        for names in SUMS {
            let sum = Sum::new(random, n, names);
            let model = derived(&sum.text);
            list.push((sum, model));
        }
    }
    list
}

/// The affine velocity and spin of a frame.
fn names(frame: Frame) -> (&'static str, &'static str) {
    match frame {
        Frame::Body => ("omega_hat_", "sigma_hat_"),
        Frame::Space => ("omega_", "sigma_"),
        Frame::Flat => ("phi_dot_", "pi_"),
    }
}

fn stem(values: &Values, stem: &str) -> Values {
    values.iter().filter_map(|(k, v)| Some((k.strip_prefix(stem)?.to_owned(), v.clone()))).collect()
}

#[test]
fn every_sum_is_derived_exactly() {
    let mut random = Random::new(51);
    for (sum, model) in sums(&mut random) {
        for _ in 0..2 {
            let state = point(&mut random, &sum.kinetic);
            programs_agree(&sum, &model, &state);
            reduction_agrees(&sum, &model, &state);
            quantities_agree(&sum, &model, &state);
        }
    }
}

fn programs_agree(sum: &Sum, model: &Model, state: &State) {
    let (what, kinetic, n) = (&sum.text, &sum.kinetic, model.dim);
    let motion = kinetic.motion(state).unwrap();
    let here = coordinates(kinetic, state);
    let mut moving = velocities(kinetic, state);
    put(&mut moving, "phi", &state.phi);
    let (velocity, spin) = names(model.frame);
    agree(what, &run(&model.point.velocity, &here), velocity, &stem(&moving, velocity), n * n);
    let momenta = run(&model.point.velocity_side.as_ref().unwrap().legendre, &moving);
    let together = if momenta.len() > n * n { sum_of_momenta(&momenta, state) } else { momenta };
    agree(what, &together, spin, &stem(&here, spin), n * n);
    if let Some(masses) = &model.point.mixed_masses {
        agree(what, &run(&masses.velocity, &here), "x_dot_", &stem(&moving, "x_dot_"), n);
        agree(what, &run(&masses.momentum, &moving), "p_", &stem(&here, "p_"), n);
    }
    assert_eq!(
        run(&model.point.velocity_side.as_ref().unwrap().kinetic_energy, &moving)["energy"],
        own(motion.energy()),
        "{what}: T"
    );
    assert_eq!(run(&model.point.hamiltonian, &here)["energy"], own(motion.energy()), "{what}: H");
    let size = n * n + if kinetic.has_translation() { n } else { 0 };
    agree(what, &run(&model.dynamics.full.program, &here), "d_", &rates(&motion), 2 * size);
}

/// `Pi = Sigma_hat phi^-1 + phi^-1 Sigma + Pi'` of the momenta of several frames.
fn sum_of_momenta(momenta: &Values, state: &State) -> Values {
    let (n, inverse) = (state.phi.shape().0, state.phi.inverse().unwrap());
    let mut read = 0;
    let mut matrix = |name: &str| {
        let places = (1..=n).flat_map(|i| (1..=n).map(move |j| (i, j)));
        let entries: Option<Vec<_>> =
            places.map(|(i, j)| momenta.get(&format!("{name}_{i}{j}")).map(exact)).collect();
        read += entries.as_ref().map_or(0, Vec::len);
        entries.map_or(Matrix::zeros(n, n), |entries| Matrix::from_rationals(n, n, &entries))
    };
    let [sigma_hat, sigma, flat] = ["sigma_hat", "sigma", "pi"].map(&mut matrix);
    assert_eq!(read, momenta.len(), "{momenta:?}");
    let mut values = Values::new();
    put(&mut values, "pi", &(&(&(&sigma_hat * &inverse) + &(&inverse * &sigma)) + &flat));
    values
}

/// The reduced equations: those of the energy that a free centre of mass leaves, at a point in turned space.
fn reduction_agrees(sum: &Sum, model: &Model, state: &State) {
    let reduction = &model.dynamics.reduction;
    let mut state = if reduction.turn.is_some() { turned(state.clone()) } else { state.clone() };
    let rest = match reduction.commuting.drift.is_some() {
        false => sum.kinetic.clone(),
        true => {
            state = State { x: Matrix::zeros(model.dim, 1), ..state.at_rest() };
            let pinned = sum.terms.iter().filter(|term| !matches!(term, Term::SpaceTranslation(_)));
            Kinetic::new(model.dim, pinned.cloned().collect()).unwrap()
        }
    };
    equations(&sum.text, model, &rest, &state, &Values::new());
}

/// Metric and inverse, and the acceleration as the derivative of the velocity along the exact motion.
fn quantities_agree(sum: &Sum, model: &Model, state: &State) {
    let (what, kinetic) = (&sum.text, &sum.kinetic);
    let here = coordinates(kinetic, state);
    let metric = model.quantities.metric.as_ref().expect("asked for");
    let expected = kinetic.mass_matrix(&state.phi).unwrap();
    let square = |values: &Values| {
        let entry = |i: usize, j: usize| exact(&values[&format!("entry_{}_{}", i + 1, j + 1)]);
        let entries: Vec<_> = (0..metric.size)
            .flat_map(|i| (0..metric.size).map(move |j| (i, j)))
            .map(|(i, j)| entry(i, j))
            .collect();
        Matrix::from_rationals(metric.size, metric.size, &entries)
    };
    assert!((&square(&run(&metric.entries, &here)) - &expected).is_zero(), "{what}: Gamma");
    let product = &square(&run(&metric.inverse, &here)) * &expected;
    assert!((&product - &Matrix::identity(metric.size)).is_zero(), "{what}: Gamma^-1");
    if let Some(program) = &model.quantities.acceleration {
        let motion = kinetic.motion(state).unwrap();
        let (x_dot, _) = kinetic.velocity(&state.along(motion.rate())).unwrap();
        let mut expected = Values::new();
        put(&mut expected, "acceleration", &x_dot.slope());
        agree(what, &run(program, &here), "", &expected, model.dim);
    }
}

#[test]
fn the_lists_are_exactly_what_is_conserved() {
    let mut random = Random::new(52);
    for (sum, model) in sums(&mut random) {
        let n = model.dim;
        for at_rest in [false, true] {
            let translation = sum.kinetic.has_translation() && !at_rest;
            let states: Vec<State> = (0..2)
                .map(|_| {
                    let state = point(&mut random, &sum.kinetic);
                    if at_rest { state.at_rest() } else { state }
                })
                .collect();
            let motions: Vec<_> = states.iter().map(|state| sum.kinetic.motion(state).unwrap()).collect();
            let expected: Vec<&str> = Observable::ALL
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
                .collect();
            let list =
                if at_rest { &model.description.conserved_at_rest } else { &model.description.conserved };
            let listed: Vec<String> = list.whole.iter().map(|candidate| format!("{candidate:?}")).collect();
            assert_eq!(listed, expected, "{}, at rest: {at_rest}", sum.text);
        }
        if n == 2 {
            let lists = [&model.description.conserved, &model.description.conserved_at_rest];
            assert_both_complete(&sum.text, &mut random, &sum.kinetic, lists);
        }
    }
}

/// A sum of squares is known to be positive definite at every placement; anything else is checked at run time.
#[test]
fn sums_of_squares_are_positive_definite() {
    let regular = |terms: &str| {
        let model = derived(&format!("dim = 2, kinetic({terms})"));
        (model.description.signature, model.regularity.is_some())
    };
    assert_eq!(regular("dalembert = 1, body_inertia = 2"), (Some((4, 0)), false));
    assert_eq!(regular("dalembert = 1, casimir1_squared = 2"), (Some((4, 0)), false));
    assert_eq!(regular("dalembert = 1, casimir2 = 1"), (None, true));
    // The Casimir goes with either inertia.
    assert_eq!(regular("space_inertia = 2, body_inertia = 0.5, casimir2 = 1"), (Some((4, 0)), false));
    assert_eq!(regular("space_inertia = 0.5, body_inertia = 2, casimir2 = 1"), (Some((4, 0)), false));
    assert_eq!(regular("space_inertia = 1, body_inertia = -2"), (None, true));
    assert_eq!(
        regular("casimir2 = 0.5, body_inertia = 1, body_translation = 1, space_translation = 2"),
        (Some((6, 0)), false)
    );
    assert_eq!(
        regular("casimir2 = 0.5, body_inertia = 1, body_translation = 1, space_translation = -2"),
        (None, true)
    );
    // Only the translation mixes frames, and its masses are positive.
    assert_eq!(
        regular("casimir2 = 2, body_inertia = 1, body_translation = 1, space_translation = 2"),
        (Some((5, 1)), false)
    );
}

/// The sentences about the parts of a sum are held against the derived equations: they are true of all parts together, and
/// of no fewer.
#[test]
fn laws_of_parts_hold_together() {
    for group in ["", "constraint = isochoric, ", "constraint = rigid, ", "constraint = conformal, "] {
        let inertia = if group.contains("rigid") { "dalembert = diag(1, 2)" } else { "dalembert = 2" };
        let masses = "body_translation = 3, space_translation = 1";
        let terms = format!("{inertia}, body_inertia = diag(1, 4), space_inertia = diag(2, 3), {masses}");
        let Form { mut arena, parts, mass, .. } = form(&format!("dim = 2, {group}kinetic({terms})"));
        let motion = Motion::new(&mut arena, parts, mass, None).expect("a regular energy");
        let chart = motion.chart(&mut arena, true);
        let loads = motion.loads(&mut arena, &chart).expect("equations");
        let mut hold = |parts: &[Part]| laws_hold(&mut arena, (parts, &motion.masses), &chart, &loads);
        assert!(hold(&motion.parts), "{group}");
        assert!(!hold(&motion.parts[1..]), "{group}");
    }
}
