//! The benchmark problems: models, starts, reference ends.

use affine_runtime::capability::{InLanes, Taylor};
use affine_runtime::prelude::*;

/// Problem P1: affine in space, metrical in the body, with translation; no potential.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    emit(taylor, splitting, lanes),
)]
pub(crate) struct DrunkMissile;

/// Problems P2, P5 and P8: affine in space, metrical in the body.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(c1),
    emit(taylor, splitting, lanes),
)]
pub(crate) struct Vibrating {
    /// Stiffness of the dilatation.
    pub(crate) kappa: f64,
    /// Stiffness of the shear.
    pub(crate) c1: f64,
}

/// Problem P2r: metrical in space, affine in the body.
#[affine_model(
    dim = 3,
    symmetry(space = metric, body = affine),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5),
    emit(taylor, splitting, lanes),
)]
pub(crate) struct Mirrored;

/// Problems P3 and P6: d'Alembert, anisotropic body.
#[affine_model(
    dim = 3,
    kinetic(dalembert = diag(1, 1.5, 2)),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
    emit(taylor, nystrom, splitting, lanes),
)]
pub(crate) struct Elastic {
    /// Stiffness of the dilatation.
    pub(crate) kappa: f64,
}

/// Problem P7: the stiff body with translation.
#[affine_model(
    dim = 3,
    symmetry(space = affine, body = metric),
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
    potential = hyperbolic_dilatation(kappa) + neo_hookean(0.5),
    emit(taylor, splitting, lanes),
)]
pub(crate) struct StiffMissile {
    /// Stiffness of the dilatation.
    pub(crate) kappa: f64,
}

/// Linear momentum of P1 and P7.
pub(crate) const P: [f64; 3] = [0.3, -0.2, 0.5];

/// What is done with every problem.
pub(crate) trait Visitor {
    /// One problem: its name, model, start at time 0, and the phase point at `t_end` by the reference.
    ///
    /// # Errors
    /// Those of what is done.
    fn visit<M: InLanes<3, Point<f64>: Send + Sync> + Taylor<3> + Sync>(
        &mut self,
        name: &'static str,
        model: &M,
        ends: [M::Point<f64>; 2],
        t_end: f64,
    ) -> affine_runtime::Result<()>;
}

/// Visits all problems.
///
/// # Errors
/// Those of the visitor.
pub(crate) fn visit(visitor: &mut impl Visitor) -> affine_runtime::Result<()> {
    let p = Vector::<3>::from(P);
    let moving = |row: &Row| DrunkMissile.at_momentum(row.x, row.phi, p, Comoving(row.spin));
    // The file of P1 has no row for the start, which is that of P7.
    let [start, _] = rows(include_str!("../../tests/data/p7.csv"));
    let [_, end] = rows(include_str!("../../tests/data/p1.csv"));
    visitor.visit("P1", &DrunkMissile, [moving(&start)?, moving(&end)?], end.t)?;

    for (name, kappa, c1, data) in [
        ("P2", 10.0, 0.5, include_str!("../../tests/data/p2.csv")),
        ("P5 1e4", 1e4, 0.5, include_str!("../../tests/data/p5_1e4.csv")),
        ("P5 1e6", 1e6, 0.5, include_str!("../../tests/data/p5_1e6.csv")),
        ("P5 large", 1e4, 0.5, include_str!("../../tests/data/p5_large.csv")),
        ("P8", 10.0, 1e4, include_str!("../../tests/data/p8.csv")),
    ] {
        let model = Vibrating { kappa, c1 }.prepare()?;
        let [start, end] = rows(data);
        let at = |row: &Row| model.at_momentum(row.phi, Comoving(row.spin));
        visitor.visit(name, &model, [at(&start)?, at(&end)?], end.t)?;
    }

    let [start, end] = rows(include_str!("../../tests/data/p2r.csv"));
    let at = |row: &Row| Mirrored.at_momentum(row.phi, Spatial(row.spin));
    visitor.visit("P2r", &Mirrored, [at(&start)?, at(&end)?], end.t)?;

    for (name, kappa, data) in [
        ("P3", 10.0, include_str!("../../tests/data/p3.csv")),
        ("P6", 1e6, include_str!("../../tests/data/p6.csv")),
    ] {
        let model = Elastic { kappa }.prepare()?;
        let [start, end] = rows(data);
        let at = |row: &Row| model.at_momentum(row.phi, TwoPoint(row.spin));
        visitor.visit(name, &model, [at(&start)?, at(&end)?], end.t)?;
    }

    let [start, end] = rows(include_str!("../../tests/data/p7.csv"));
    let model = StiffMissile { kappa: 1e4 }.prepare()?;
    let at = |row: &Row| model.at_momentum(row.x, row.phi, p, Comoving(row.spin));
    visitor.visit("P7", &model, [at(&start)?, at(&end)?], end.t)
}

/// A row of a reference solution.
pub(crate) struct Row {
    /// Time.
    pub(crate) t: f64,
    /// Centre of mass; zero without translation.
    pub(crate) x: Vector<3>,
    /// Placement.
    pub(crate) phi: Matrix<3>,
    /// Affine spin, in the frame of the model.
    pub(crate) spin: Matrix<3>,
}

/// First and last row of a reference solution: `t`, `x` with translation, `phi`, `p_hat` for P1, the affine spin.
pub(crate) fn rows(data: &str) -> [Row; 2] {
    let mut lines = data.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    let row = |line: Option<&str>| {
        let numbers: Vec<f64> =
            line.unwrap_or_default().split(',').map(|number| number.parse().unwrap_or(f64::NAN)).collect();
        let (x, phi) = if numbers.len() > 19 { (1, 4) } else { (0, 1) };
        let vector =
            |from: usize| Vector::<3>::from_fn(|i, _| numbers.get(from + i).copied().unwrap_or(f64::NAN));
        let matrix = |from: usize| {
            Matrix::<3>::from_fn(|i, j| numbers.get(from + 3 * i + j).copied().unwrap_or(f64::NAN))
        };
        Row {
            t: numbers[0],
            x: if x == 0 { Vector::<3>::zeros() } else { vector(x) },
            phi: matrix(phi),
            spin: matrix(numbers.len().saturating_sub(9)),
        }
    };
    let first = row(lines.next());
    [first, row(lines.next_back())]
}
