//! Kinematic quantities against reference values computed with 60 digits (`data/kinematics.py`).
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use affine_runtime::__private::phase_point;
use affine_runtime::Error;
use affine_runtime::frames::{
    AffineVelocity, Body, Canonical, Comoving, Frame, Matrix, Space, TwoPoint, Vector,
};
use affine_runtime::kinematics::{InertialQuadrupole, Kinematics, LinearVelocity};
use affine_runtime::model::Velocity;
use affine_runtime::state::{Centre, Orthonormal, Phase, PhasePoint, Pinned};

/// Allowed error of each quantity: `factor * epsilon * condition^power`, relative to the largest entry of the
/// quantity, or to the scale that the check names where terms cancel. `condition` is that of `phi`.
const TOLERANCES: &[(&str, f64, i32, &str)] = &[
    ("q", 2.0, 0, "one logarithm; the graded placements have a condition number of about 3 once scaled"),
    ("D", 2.0, 0, "one logarithm and one exponential of a number below 3"),
    ("Psi", 2.0, 0, "as D, and a division"),
    ("G", 2.0, 0, "a product of two matrices"),
    ("G_inverse", 4.0, 1, "an inverse and a product"),
    ("C", 4.0, 1, "an inverse and a product"),
    ("C_inverse", 2.0, 0, "a product of two matrices"),
    ("E", 2.0, 0, "a product and two sums; relative to E however small it is"),
    ("e", 4.0, 1, "an inverse, two products and two sums; relative to e however small it is"),
    ("G_powers", 4.0, 0, "three products of positive definite matrices"),
    ("C_powers", 6.0, 1, "as G_powers, from an inverse"),
    ("invariants", 4.0, 1, "sums of squared minors; a minor of phi cancels"),
    ("J_phi", 4.0, 0, "two products"),
    ("Omega", 2.0, 1, "an inverse and a product"),
    ("Omega_hat", 2.0, 1, "an inverse and a product"),
    ("v_hat", 2.0, 1, "an inverse and a product"),
    ("p_hat", 2.0, 0, "a product"),
    ("q_dot", 2.0, 1, "trace of Omega"),
    ("omega", 2.0, 1, "as Omega"),
    ("omega_hat", 2.0, 1, "as Omega"),
    ("phi_dot", 4.0, 1, "there and back: an inverse and two products"),
    ("x_dot", 4.0, 1, "there and back: an inverse and two products"),
    ("Sigma", 4.0, 2, "from another frame: an inverse between two products"),
    ("Sigma_hat", 4.0, 2, "from another frame: an inverse between two products"),
    ("sigma", 4.0, 2, "as Sigma"),
    ("sigma_hat", 4.0, 2, "as Sigma_hat"),
    ("S", 4.0, 2, "as Sigma"),
    ("V", 4.0, 2, "as Sigma_hat"),
    ("S_norm2", 6.0, 2, "a square of S"),
    ("V_norm2", 6.0, 2, "a square of V"),
    ("Lambda", 0.5, 0, "single products"),
    ("L", 2.0, 0, "differences of single products"),
    ("I", 4.0, 2, "as Sigma"),
    ("Jtot", 4.0, 2, "as Sigma"),
    ("pairing", 4.0, 2, "trace of a product in any frame"),
    ("pairing_x", 4.0, 1, "a product in any frame"),
    ("casimirs", 8.0, 1, "three products; no change of frame"),
    ("shear_casimirs", 8.0, 1, "three products; no change of frame"),
];

/// Lines of the data file that are given, not computed.
const INPUTS: [&str; 6] = ["phi", "condition", "J", "Pi", "x", "p"];

struct Case {
    name: String,
    n: usize,
    values: BTreeMap<String, Vec<f64>>,
    checked: RefCell<BTreeSet<String>>,
}

fn cases(n: usize) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    for line in include_str!("data/kinematics.txt").lines().filter(|line| !line.starts_with('#')) {
        let mut words = line.split(' ');
        let head = words.next().unwrap();
        if head == "case" {
            let name = words.next().unwrap().to_owned();
            let n = words.next().unwrap().parse().unwrap();
            cases.push(Case { name, n, values: BTreeMap::new(), checked: RefCell::default() });
        } else {
            let values = words.map(|word| word.parse().unwrap()).collect();
            cases.last_mut().unwrap().values.insert(head.to_owned(), values);
        }
    }
    cases.into_iter().filter(|case| case.n == n).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |max, value| value.abs().max(max))
}

impl Case {
    fn has(&self, name: &str) -> bool {
        self.values.contains_key(name)
    }
    fn get(&self, name: &str) -> &[f64] {
        &self.values[name]
    }
    fn matrix<const N: usize>(&self, name: &str) -> Matrix<N> {
        Matrix::from_row_slice(self.get(name))
    }
    fn vector<const N: usize>(&self, name: &str) -> Vector<N> {
        Vector::from_column_slice(self.get(name))
    }
    fn scale(&self, name: &str) -> f64 {
        largest(self.get(name))
    }
    fn check(&self, name: &str, values: &[f64]) {
        self.check_against(name, values, self.scale(name));
    }
    fn check_matrix<const N: usize>(&self, name: &str, value: &Matrix<N>) {
        self.check(name, value.transpose().as_slice());
    }
    fn check_matrix_against<const N: usize>(&self, name: &str, value: &Matrix<N>, scale: f64) {
        self.check_against(name, value.transpose().as_slice(), scale);
    }
    fn check_against(&self, name: &str, values: &[f64], scale: f64) {
        let &(_, factor, power, _) = TOLERANCES.iter().find(|row| row.0 == name).unwrap();
        let condition = if power == 0 { 1.0 } else { self.get("condition")[0] };
        let expected = self.get(name);
        assert_eq!(values.len(), expected.len(), "{} {name}", self.name);
        for (value, expected) in values.iter().zip(expected) {
            let units = (value - expected).abs() / (f64::EPSILON * condition.powi(power) * scale);
            assert!(
                units <= factor,
                "{} (n = {}): {name} = {value:e}, expected {expected:e}: {units} of {factor} units",
                self.name,
                self.n
            );
        }
        self.checked.borrow_mut().insert(name.to_owned());
    }
    fn is_exhausted(&self) {
        for name in self.values.keys() {
            assert!(
                self.checked.borrow().contains(name) || INPUTS.contains(&name.as_str()),
                "{}: {name} was never checked",
                self.name
            );
        }
    }
}

fn point<const N: usize, F: Frame>(case: &Case) -> PhasePoint<N, F, Centre<N>> {
    let centre = Centre { x: case.vector("x"), p: case.vector("p") };
    phase_point(case.matrix("phi"), TwoPoint(case.matrix::<N>("Pi")), centre).unwrap()
}

fn pinned<const N: usize>(case: &Case) -> PhasePoint<N, Canonical, Pinned> {
    phase_point(case.matrix("phi"), TwoPoint(Matrix::<N>::zeros()), Pinned).unwrap()
}

fn check_dilatation<const N: usize>(case: &Case) {
    let point = pinned::<N>(case);
    let scale = if case.name.starts_with("nearly_undeformed") {
        largest((point.phi() - Matrix::<N>::identity()).as_slice())
    } else {
        case.scale("q").max(1.0)
    };
    case.check_against("q", &[point.mean_log_stretch()], scale);
    case.check("D", &[point.dilatation()]);
    case.check_matrix("Psi", &point.isochoric_part());
}

fn check_deformation<const N: usize>(case: &Case, invariants: [f64; N]) {
    let point = pinned::<N>(case);
    case.check_matrix("G", &point.green().0.0);
    case.check_matrix("G_inverse", &point.green_inverse().0.0);
    case.check_matrix("C", &point.cauchy().0.0);
    case.check_matrix("C_inverse", &point.cauchy_inverse().0.0);
    case.check_matrix("E", &point.lagrange_strain().0.0);
    case.check_matrix("e", &point.euler_strain().0.0);
    let powers = |trace: &dyn Fn(u32) -> f64| (1..=N as u32).map(trace).collect::<Vec<_>>();
    case.check("G_powers", &powers(&|k| point.green().power_trace(k)));
    case.check("C_powers", &powers(&|k| point.cauchy().power_trace(k)));
    case.check("invariants", &invariants);
    let body = Comoving(InertialQuadrupole(case.matrix("J")));
    case.check_matrix("J_phi", &point.inertial_quadrupole(body).0.0);
}

fn check_velocities<const N: usize>(case: &Case) {
    let point = point::<N, Canonical>(case);
    let velocity = Velocity { x_dot: case.vector("x_dot"), phi_dot: case.matrix("phi_dot") };
    let (omega, omega_hat) = (point.omega(&velocity), point.omega_hat(&velocity));
    let phi = point.phi();
    case.check_matrix("Omega", &omega.0.0);
    case.check_matrix("Omega_hat", &omega_hat.0.0);
    case.check_matrix_against("omega", &omega.deviator().0.0, case.scale("Omega"));
    case.check_matrix_against("omega_hat", &omega_hat.deviator().0.0, case.scale("Omega_hat"));
    case.check_against("q_dot", &[omega.dilatation_rate()], case.scale("Omega"));
    case.check_against("q_dot", &[omega_hat.dilatation_rate()], case.scale("Omega_hat"));
    // Back again, and across.
    let exact = Comoving(AffineVelocity(case.matrix::<N>("Omega_hat")));
    case.check_matrix("phi_dot", &exact.two_point(phi).0.0);
    case.check_matrix("phi_dot", &exact.spatial(phi).two_point(phi).0.0);
    case.check_matrix("phi_dot", &omega.comoving(phi).two_point(phi).0.0);
    case.check("v_hat", point.v_hat(&velocity).0.0.as_slice());
    let exact = Comoving(LinearVelocity(case.vector::<N>("v_hat")));
    case.check("x_dot", exact.spatial(phi).0.0.as_slice());
}

fn check_momenta<const N: usize, F: Frame>(case: &Case) {
    let point = point::<N, F>(case);
    let velocity = Velocity { x_dot: case.vector("x_dot"), phi_dot: case.matrix("phi_dot") };
    let (spatial, comoving) = (case.scale("Sigma"), case.scale("Sigma_hat"));
    case.check_matrix("Sigma", &point.sigma().0.0);
    case.check_matrix("Sigma_hat", &point.sigma_hat().0.0);
    case.check_matrix_against("sigma", &point.sigma().deviator().0.0, spatial);
    case.check_matrix_against("sigma_hat", &point.sigma_hat().deviator().0.0, comoving);
    case.check_matrix_against("S", &point.spin().0.0, spatial);
    case.check_matrix_against("V", &point.vorticity().0.0, comoving);
    case.check_against("S_norm2", &[point.spin().norm_squared()], spatial * spatial);
    case.check_against("V_norm2", &[point.vorticity().norm_squared()], comoving * comoving);
    case.check_matrix("Lambda", &point.orbital_affine_momentum().0.0);
    case.check_matrix_against("L", &point.orbital_angular_momentum().0.0, case.scale("Lambda"));
    let total = spatial + case.scale("Lambda");
    case.check_matrix_against("I", &point.total_affine_momentum().0.0, total);
    case.check_matrix_against("Jtot", &point.total_angular_momentum().0.0, total);
    case.check("p_hat", point.p_hat().0.0.as_slice());
    let power = spatial * case.scale("Omega") + comoving * case.scale("Omega_hat");
    case.check_against("pairing", &[point.sigma().pair(point.omega(&velocity))], power);
    case.check_against("pairing", &[point.sigma_hat().pair(point.omega_hat(&velocity))], power);
    let rate = TwoPoint(AffineVelocity(velocity.phi_dot));
    case.check_against("pairing", &[point.pi().pair(rate)], power);
    let power = case.scale("p_hat") * case.scale("v_hat");
    case.check_against("pairing_x", &[point.p_hat().pair(point.v_hat(&velocity))], power);
    check_casimirs::<N, F>(case, spatial.max(comoving));
}

fn check_casimirs<const N: usize, F: Frame>(case: &Case, size: f64) {
    let point = point::<N, F>(case);
    // Each power relative to the same power of the largest entry.
    let normed = |k: u32, value: f64| value / size.powi(k as i32);
    for (name, of_point) in [
        ("casimirs", &(|k| point.casimir(k)) as &dyn Fn(u32) -> f64),
        ("shear_casimirs", &|k| point.shear_casimir(k)),
    ] {
        for k in 1..=N as u32 {
            let expected = case.get(name)[k as usize - 1];
            let difference = normed(k, of_point(k)) - normed(k, expected);
            let &(_, factor, power, _) = TOLERANCES.iter().find(|row| row.0 == name).unwrap();
            let allowed = factor * f64::EPSILON * case.get("condition")[0].powi(power);
            assert!(difference.abs() <= allowed, "{}: {name} of order {k}: {difference:e}", case.name);
        }
        case.checked.borrow_mut().insert(name.to_owned());
    }
    assert_eq!(point.dilatational_momentum(), point.casimir(1));
}

fn check_everything<const N: usize>(invariants: fn(&PhasePoint<N, Canonical, Pinned>) -> [f64; N]) {
    let cases = cases(N);
    assert!(cases.len() >= 15);
    for case in &cases {
        check_dilatation::<N>(case);
        if case.has("G") {
            check_deformation::<N>(case, invariants(&pinned(case)));
        }
        if case.has("Pi") {
            check_velocities::<N>(case);
            check_momenta::<N, Space>(case);
            check_momenta::<N, Body>(case);
            check_momenta::<N, Canonical>(case);
        }
        case.is_exhausted();
    }
}

#[test]
fn two_dimensions() {
    check_everything::<2>(|point| point.invariants());
}

#[test]
fn three_dimensions() {
    check_everything::<3>(|point| point.invariants());
}

/// A placement that mirrors is refused, whatever the size of its determinant.
fn check_orientation<const N: usize>() {
    for case in cases(N) {
        let mut mirrored = case.matrix::<N>("phi");
        mirrored.swap_rows(0, 1);
        let refused =
            phase_point::<N, Body, _, f64, Orthonormal>(mirrored, Comoving(Matrix::<N>::zeros()), Pinned)
                .unwrap_err();
        let Error::Placement { determinant } = refused else { panic!("{}: {refused}", case.name) };
        let expected = -(N as f64 * case.get("q")[0]).exp();
        // Zero and infinity included: the determinant itself may leave the range. The exponential magnifies the
        // rounding of its argument, which reaches 1000.
        assert!(
            determinant == expected || (determinant / expected - 1.0).abs() < 2000.0 * f64::EPSILON,
            "{}: {determinant:e}, expected {expected:e}",
            case.name
        );
        assert!(determinant.is_sign_negative(), "{}", case.name);
    }
}

#[test]
fn mirrored_placements_are_refused() {
    check_orientation::<2>();
    check_orientation::<3>();
}
