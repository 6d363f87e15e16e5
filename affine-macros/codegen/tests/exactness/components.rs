//! Components of momenta that are conserved where no momentum is as a whole: each of them has bracket 0 with `H`, exactly, and
//! there are as many as the brackets of all linear momenta leave, counted modulo a prime.

use affine_codegen::derive::{Component, Conserved};
use affine_oracle::{Kinetic, Matrix, Motion, Observable, Random, Rational, State, Term, rational};

use super::derivation::point;
use super::models::{derived, diagonal_literal, diagonal_matrix, matrix_literal};

/// What is looked at together.
const TOGETHER: [&[Observable]; 6] = [
    &[
        Observable::LinearMomentum,
        Observable::Spin,
        Observable::OrbitalAngularMomentum,
        Observable::Vorticity,
    ],
    &[Observable::AffineSpin],
    &[Observable::TotalAffineMomentum],
    &[Observable::ComovingAffineSpin],
    &[Observable::CanonicalMomentum],
    &[Observable::ComovingLinearMomentum],
];

const LINEAR: [&str; 13] = [
    "LinearMomentum",
    "ComovingLinearMomentum",
    "OrbitalAngularMomentum",
    "TotalAffineMomentum",
    "TotalAngularMomentum",
    "AffineSpin",
    "Deviator",
    "Spin",
    "ComovingAffineSpin",
    "ComovingDeviator",
    "Vorticity",
    "CanonicalMomentum",
    "Casimir1",
];

const PRIME: u64 = (1 << 31) - 1;

fn residue(value: &Rational) -> u64 {
    let prime = rational(PRIME as i64, 1);
    let part = |whole: Rational| -> u64 {
        let rest = &whole - (&whole / &prime).floor() * &prime;
        rest.to_integer().try_into().unwrap()
    };
    let below = part(Rational::from(value.denom().clone()));
    assert_ne!(below, 0);
    part(Rational::from(value.numer().clone())) * power(below, PRIME - 2) % PRIME
}

fn power(base: u64, exponent: u64) -> u64 {
    match exponent {
        0 => 1,
        _ if exponent % 2 == 1 => base * power(base, exponent - 1) % PRIME,
        _ => power(base * base % PRIME, exponent / 2),
    }
}

/// The reduced echelon form of some rows, each with the column of its leading 1.
fn echelon(mut rows: Vec<Vec<u64>>) -> Vec<(usize, Vec<u64>)> {
    let mut leading = Vec::new();
    for column in 0..rows.first().map_or(0, Vec::len) {
        let rank = leading.len();
        let Some(pivot) = (rank..rows.len()).find(|r| rows[*r][column] != 0) else { continue };
        rows.swap(rank, pivot);
        let scale = power(rows[rank][column], PRIME - 2);
        rows[rank].iter_mut().for_each(|entry| *entry = *entry * scale % PRIME);
        let above = rows[rank].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(r, _)| *r != rank) {
            let factor = PRIME - row[column];
            row.iter_mut().zip(&above).for_each(|(entry, above)| *entry = (*entry + factor * above) % PRIME);
        }
        leading.push(column);
    }
    leading.into_iter().zip(rows).collect()
}

fn rank(rows: Vec<Vec<u64>>) -> usize {
    echelon(rows).len()
}

/// A basis of the vectors that all rows annihilate.
fn annihilated(columns: usize, rows: Vec<Vec<u64>>) -> Vec<Vec<u64>> {
    let rows = echelon(rows);
    let free = (0..columns).filter(|column| rows.iter().all(|(leading, _)| leading != column));
    let vector = |free: usize| {
        let mut vector = vec![0; columns];
        vector[free] = 1;
        rows.iter().for_each(|(leading, row)| vector[*leading] = (PRIME - row[free]) % PRIME);
        vector
    };
    free.map(vector).collect()
}

fn dot(a: &[u64], b: &[u64]) -> u64 {
    a.iter().zip(b).fold(0, |sum, (a, b)| (sum + a * b) % PRIME)
}

fn value(component: &Component, of: &dyn Fn(Observable) -> Matrix) -> Rational {
    let terms = component.entries.iter().map(|entry| {
        let momentum = of(Observable::named(&format!("{:?}", entry.of)).unwrap());
        momentum.entry(entry.row - 1, entry.column - 1) * rational(entry.factor, 1)
    });
    terms.fold(rational(0, 1), |sum, term| sum + term)
}

/// The list of a motion through these points is what the brackets of the momenta leave, without repetition.
pub(crate) fn assert_complete(what: &str, kinetic: &Kinetic, conserved: &Conserved, motions: &[Motion]) {
    let linear: Vec<Observable> = conserved
        .whole
        .iter()
        .map(|candidate| format!("{candidate:?}"))
        .filter(|name| LINEAR.contains(&name.as_str()))
        .map(|name| Observable::named(&name).unwrap())
        .collect();
    let entries = |of: &dyn Fn(Observable) -> Matrix, list: &[Observable]| -> Vec<u64> {
        list.iter().flat_map(|observable| of(*observable).entries()).map(|entry| residue(&entry)).collect()
    };
    // One row for each point: what is conserved as a whole, with its components, with everything that is.
    let (mut whole, mut listed) = (Vec::new(), Vec::new());
    for motion in motions {
        let of = |observable: Observable| observable.value(kinetic, motion.state()).unwrap();
        let rate = |observable: Observable| motion.bracket(observable).unwrap();
        whole.push(entries(&of, &linear));
        let mut list = entries(&of, &linear);
        for component in &conserved.components {
            assert_eq!(value(component, &rate), rational(0, 1), "{what}: {}", component.symbol);
            list.push(residue(&value(component, &of)));
        }
        listed.push(list);
    }
    let mut all = listed.clone();
    for momenta in TOGETHER {
        let of = |motion: &Motion| -> Vec<u64> {
            entries(&|observable| observable.value(kinetic, motion.state()).unwrap(), momenta)
        };
        let rates = motions.iter().map(|m| entries(&|observable| m.bracket(observable).unwrap(), momenta));
        let rates: Vec<Vec<u64>> = rates.collect();
        let conserved = annihilated(rates[0].len(), rates);
        for (row, motion) in all.iter_mut().zip(motions) {
            let values = of(motion);
            row.extend(conserved.iter().map(|vector| dot(vector, &values)));
        }
    }
    let [whole, listed, all] = [whole, listed, all].map(rank);
    assert_eq!(listed, all, "{what}: {conserved:?}");
    assert_eq!(listed - whole, conserved.components.len(), "{what}: {conserved:?}");
}

/// More points than what is conserved has dimensions.
fn states(random: &mut Random, kinetic: &Kinetic, at_rest: bool) -> Vec<State> {
    let n = kinetic.dimension();
    let count = if kinetic.has_translation() && !at_rest { 2 * n + 4 * n * n } else { 3 * n * n };
    let state = |_| {
        let state = point(random, kinetic);
        match at_rest {
            true => State::new(Matrix::zeros(n, 1), state.phi, Matrix::zeros(n, 1), state.pi).unwrap(),
            false => state,
        }
    };
    (0..count + 2).map(state).collect()
}

/// Both lists of a model without forces.
pub(crate) fn assert_both_complete(
    what: &str,
    random: &mut Random,
    kinetic: &Kinetic,
    lists: [&Conserved; 2],
) {
    for (at_rest, conserved) in [false, true].into_iter().zip(lists) {
        let states = states(random, kinetic, at_rest);
        let motions: Vec<Motion> = states.iter().map(|state| kinetic.motion(state).unwrap()).collect();
        assert_complete(&format!("{what}, at rest: {at_rest}"), kinetic, conserved, &motions);
    }
}

fn symbols(conserved: &Conserved) -> Vec<String> {
    let whole = conserved.whole.iter().map(|candidate| format!("{candidate:?}"));
    whole.chain(conserved.components.iter().map(|component| component.symbol.clone())).collect()
}

/// The model of a statement; its list is this one, and complete.
fn lists(dim: usize, statement: &str, terms: Vec<Term>, expected: &[&str]) {
    let args = format!("dim = {dim}, {statement}");
    let model = derived(&args, "struct Model;");
    assert_eq!(symbols(&model.description.conserved), expected, "{args}");
    let kinetic = Kinetic::new(dim, terms).unwrap();
    assert_both_complete(
        &args,
        &mut Random::new(71),
        &kinetic,
        [&model.description.conserved, &model.description.conserved_at_rest],
    );
}

/// `diag(2, 2, 3)` with its axis along each of the coordinates; the plane across it, and the other two.
fn tops() -> [(String, Matrix, &'static str, [&'static str; 2]); 3] {
    [
        (2, "12", ["3*sigma_hat_13 - 2*sigma_hat_31", "3*sigma_hat_23 - 2*sigma_hat_32"]),
        (1, "13", ["3*sigma_hat_12 - 2*sigma_hat_21", "2*sigma_hat_23 - 3*sigma_hat_32"]),
        (0, "23", ["2*sigma_hat_12 - 3*sigma_hat_21", "2*sigma_hat_13 - 3*sigma_hat_31"]),
    ]
    .map(|(axis, plane, tilted)| {
        let entries: Vec<Rational> = (0..3).map(|a| rational(if a == axis { 3 } else { 2 }, 1)).collect();
        (diagonal_literal(&entries), diagonal_matrix(&entries), plane, tilted)
    })
}

#[test]
fn soft_symmetric_tops() {
    for (text, inertia, plane, tilted) in tops() {
        let (spin, vorticity) = (format!("S_{plane}"), format!("Vort_{plane}"));
        let both = vec![Term::SpaceInertia(inertia.clone()), Term::BodyInertia(inertia.clone())];
        let statement = format!("kinetic(space_inertia = {text}, body_inertia = {text})");
        lists(3, &statement, both, &["Energy", "Casimir1", &spin, &vorticity]);

        let dalembert = vec![Term::DAlembert(inertia)];
        let args = format!("dim = 3, kinetic(dalembert = {text}), potential = tr(G)^2 + 1/det");
        let model = derived(&args, "struct Model;");
        assert_eq!(
            symbols(&model.description.conserved),
            ["Energy", "Spin", "SpinNorm", &vorticity],
            "{args}"
        );
        let free = format!("kinetic(dalembert = {text})");
        let expected = ["Energy", "Spin", "SpinNorm", "CanonicalMomentum", &vorticity];
        // Of phi_dot alone, T is the same after every rotation that J calls so.
        lists(3, &free, dalembert, &[&expected[..], &tilted].concat());
    }
}

/// A symmetry axis that is none of the coordinates: `2 + a a^T`, `a = (1, 2, -1)`.
#[test]
fn oblique_tops() {
    let inertia = [3, 2, -1, 2, 6, -2, -1, -2, 3].map(|entry| rational(entry, 1));
    let inertia = Matrix::from_rationals(3, 3, &inertia);
    let text = matrix_literal(&inertia);
    let terms = vec![Term::SpaceInertia(inertia.clone()), Term::BodyInertia(inertia)];
    // epsilon_abc a_c
    let (spin, vorticity) = ("S_12 + 2*S_13 - S_23", "Vort_12 + 2*Vort_13 - Vort_23");
    let statement = format!("kinetic(space_inertia = {text}, body_inertia = {text})");
    lists(3, &statement, terms, &["Energy", "Casimir1", spin, vorticity]);
}

#[test]
fn weights() {
    let model = |potential: &str, terms: &str| {
        derived(&format!("dim = 3, kinetic({terms}), potential = {potential}"), "struct Model;")
    };
    let terms = "dalembert = 1, space_translation = 2";
    let heavy = model("2*9.81*x[3] + tr(G)^2", terms);
    let about_the_vertical = ["p_1", "p_2", "x_1*p_2 - x_2*p_1"];
    let own = ["Energy", "Spin", "SpinNorm", "Vorticity", "VorticityNorm"];
    assert_eq!(symbols(&heavy.description.conserved), [&own[..], &about_the_vertical].concat());
    assert_eq!(heavy.description.conserved_at_rest, heavy.description.conserved);
    // What holds space and body together leaves the sum of both angular momenta.
    let hung = model("x[1]*phi[1,3] + x[2]*phi[2,3] + x[3] + tr(G)^2", terms);
    assert_eq!(symbols(&hung.description.conserved), ["Energy", "I_12 - I_21", "Vort_12"]);
    // Of the plane of x and y, U knows the distance alone; of the body nothing.
    let held = model("x[1]^2 + x[2]^2 + x[3]^4", terms);
    let list = symbols(&held.description.conserved);
    assert!(list.ends_with(&["x_1*p_2 - x_2*p_1".to_owned()]), "{list:?}");
}

/// Turned together, space one way and the body the other.
#[test]
fn rotations_of_both() {
    for (potential, sign) in [("tr(G)^2 + phi[1,1] + phi[2,2]", "-"), ("tr(G)^2 + phi[1,1] - phi[2,2]", "+")]
    {
        for n in [2, 3] {
            let args = format!("dim = {n}, kinetic(dalembert = 1), potential = {potential}");
            let model = derived(&args, "struct Model;");
            assert_eq!(
                symbols(&model.description.conserved),
                ["Energy".to_owned(), format!("S_12 {sign} Vort_12")],
                "{args}"
            );
        }
    }
}

/// What fields compute is known by its form alone.
#[test]
fn forces_of_fields() {
    let model = |terms: &str, forces: &str| {
        let args = format!("dim = 3, kinetic({terms}), {forces}");
        symbols(&derived(&args, "struct Model { w: Wind }").description.conserved)
    };
    let top = "dalembert = diag(2, 2, 3)";
    let of_class = |class: &str| model(top, &format!("potential = custom(w, {class})"));
    assert_eq!(of_class("isotropic"), ["Energy", "Spin", "SpinNorm", "Vort_12"]);
    assert_eq!(model(top, "potential = self_gravity(2)"), of_class("isotropic"));
    assert_eq!(of_class("green"), ["Energy", "Spin", "SpinNorm"]);
    assert_eq!(of_class("finger"), ["Energy", "Vort_12"]);
    assert_eq!(of_class("general"), ["Energy"]);
}

/// Friction, and the components that are at rest in its frame.
#[test]
fn friction() {
    let model = |dissipation: &str| {
        let terms = "space_inertia = diag(2, 2, 3), body_inertia = diag(2, 2, 3), space_translation = 2";
        let args = format!("dim = 3, kinetic({terms}), dissipation({dissipation})");
        symbols(&derived(&args, "struct Model;").description.conserved)
    };
    let centre = ["LinearMomentum", "OrbitalAngularMomentum"];
    let list = model("casimir1_squared = 1");
    assert!(list.ends_with(&["S_12".to_owned(), "Vort_12".to_owned()]), "{list:?}");
    assert!(centre.iter().all(|momentum| list.contains(&(*momentum).to_owned())), "{list:?}");
    assert!(!model("body_inertia = 1").iter().any(|symbol| symbol.contains("_12")));
}
