//! Branches with folds, bifurcations and collisions that are known.

use affine_runtime::Error;
use affine_runtime::analysis::{
    AnalysisError, Branch, BranchPoint, Condition, Continuation, Generator, Special, StabilityVerdict,
    branch_diagram, lyapunov_spectrum,
};
use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::frames::Body as OnBody;
use affine_runtime::frames::Matrix;
use affine_runtime::prelude::*;
use affine_runtime::scalar::Scalar;

use crate::models::{Disc, turning};

fn only<const N: usize, P>(branch: &Branch<N, P>, kind: Special) -> Vec<&BranchPoint<N, P>> {
    branch.special.iter().filter(|(own, _)| *own == kind).map(|(_, point)| point).collect()
}

/// Rows "rotating disc, critical points" and "elongated branch": from rest by the momentum, the planar Maclaurin and Jacobi.
#[test]
fn a_disc_branches_and_then_breaks() {
    let family = |spin: f64| {
        let disc = Disc { i: 1.0, kappa: 4.0, c1: 0.05 }.prepare()?;
        Ok((disc, vec![Condition::MomentumMap(0, spin)]))
    };
    let continuation = Continuation::new(&[Generator::rotation(1, 2)], (-0.01, 1.3), 0.1, family);
    let disc = Disc { i: 1.0, kappa: 4.0, c1: 0.05 }.prepare().unwrap();
    let rest = disc.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let round = continuation.run(&rest, 0.0).unwrap();
    let bifurcation = only(&round, Special::Bifurcation);
    assert_eq!(bifurcation.len(), 1, "{round}");
    assert!((bifurcation[0].parameter - 0.6648270638631039).abs() < 1e-9, "{round}");
    assert!((bifurcation[0].stretches()[0] - 1.0511838859648149).abs() < 1e-9, "{round}");
    assert!((bifurcation[0].turn.velocities[0] - 0.300830111875804).abs() < 1e-9);
    let collision = only(&round, Special::Collision);
    assert_eq!(collision.len(), 1, "{round}");
    assert!((collision[0].parameter - 0.9878477221590611).abs() < 1e-9, "{round}");
    assert!((collision[0].stretches()[0] - 1.104447329082993).abs() < 1e-9, "{round}");
    assert!(only(&round, Special::Fold).is_empty());
    let (first, last) = (&round.points[0], round.points.last().unwrap());
    assert_eq!(first.stability.verdict, StabilityVerdict::Stable);
    assert!(matches!(last.stability.verdict, StabilityVerdict::Unstable { .. }));
    assert_eq!(round.to_csv().lines().count(), round.points.len() + 1);

    let far = Continuation::new(&[Generator::rotation(1, 2)], (0.0, 2.2), 0.1, family);
    let elongated = far.switch(bifurcation[0], 0.05).unwrap();
    for point in &elongated.points {
        // r^2 + s^2 = (kappa/16 c1)(det^2 - 1), with r, s = (Q1 +- Q2)/2.
        let q = point.stretches();
        let det = q[0] * q[1];
        let sum = (q[0] * q[0] + q[1] * q[1]) / 2.0;
        assert!((sum - 4.0 / 0.8 * (det * det - 1.0)).abs() < 1e-11, "{q:?}");
        assert_eq!(point.stability.verdict, StabilityVerdict::Stable, "{q:?}");
    }
    let diagram =
        branch_diagram("Discs", &[&round, &elongated], ("S_12", "stretches"), BranchPoint::stretches);
    let svg = diagram.to_svg();
    assert!(["stable", "unstable", "special points"].iter().all(|name| svg.contains(name)), "{svg}");
    assert!(!svg.contains("undecided"));
    assert!(elongated.points.len() > 10 && elongated.points.last().unwrap().stretches()[0] > 2.5);
}

/// With friction eigenvalues tell: one is zero where a body buckles, and two are imaginary where a force that follows it flutters.
#[test]
fn friction_lets_branches_be_told() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1),
        potential = (phi[1,1] - 1)^2 + (phi[2,2] - 1)^2 + phi[2,1]^2 + phi[1,2]^4/4 - a/2*phi[1,2]^2,
        dissipation(body_inertia = 0.3)
    )]
    struct Buckling {
        a: f64,
    }
    let family = |a: f64| Ok((Buckling { a }.prepare()?, Vec::new()));
    let model = Buckling { a: -1.0 }.prepare().unwrap();
    let one = Matrix::<2>::identity();
    let guess = model.at_velocity(one, one * 0.0).unwrap();
    let branch = Continuation::new(&[], (-1.5, 1.0), 0.1, family).run(&guess, -1.0).unwrap();
    let [(Special::Bifurcation, point)] = branch.special.as_slice() else { panic!("{branch}") };
    assert!(point.parameter.abs() < 1e-9, "{branch}");
    let buckled = Continuation::new(&[], (-0.5, 1.0), 0.1, family).switch(point, 0.1).unwrap();
    let last = buckled.points.last().unwrap();
    assert!((last.turn.point.phi()[(0, 1)].powi(2) - last.parameter).abs() < 1e-9, "{buckled}");
    assert_eq!(last.stability.verdict, StabilityVerdict::Stable);

    // z'' + c z' + (k - i b) z = 0 of z = phi_12 + i phi_21: at b = c sqrt(k) oscillations begin to grow.
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1),
        potential = (phi[1,1] - 1)^2 + (phi[2,2] - 1)^2 + phi[1,2]^2 + phi[2,1]^2,
        dissipation(body_inertia = 0.3),
        forces = custom(follower, comoving),
    )]
    struct Fluttering {
        follower: Follower,
    }
    let family = |b: f64| Ok((Fluttering { follower: Follower { b } }.prepare()?, Vec::new()));
    let model = Fluttering { follower: Follower { b: 0.1 } }.prepare().unwrap();
    let guess = model.at_velocity(one, one * 0.0).unwrap();
    let branch = Continuation::new(&[], (0.0, 1.0), 0.1, family).run(&guess, 0.1).unwrap();
    let [(Special::Hopf, point)] = branch.special.as_slice() else { panic!("{branch}{}", branch.to_csv()) };
    assert!((point.parameter - 0.3 * 2.0_f64.sqrt()).abs() < 1e-9, "{branch}");
}

/// A force that a potential does not have.
#[derive(Clone, Copy, Debug)]
struct Follower {
    b: f64,
}

impl Force<2> for Follower {
    type Form = OnBody;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Matrix<2, T> {
        let b = T::constant(self.b, 0.0);
        let zero = T::zero();
        // It pairs with phi^-1 phi_dot as a trace.
        Matrix::<2, T>::new(zero, b * motion.phi[(0, 1)], -b * motion.phi[(1, 0)], zero)
    }
}

/// A rotor that a force drives round in a bearing with friction, `z'' + c z' + (k - i w) z = 0`: at `w = c sqrt(k)` it begins to whirl,
/// wherever the steps end.
#[test]
fn special_points_on_steps_are_found() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = 2*norm(x)^2 + (phi[1,1] - 1)^2 + (phi[2,2] - 1)^2 + phi[1,2]^2 + phi[2,1]^2,
        dissipation(space_translation = c, dalembert = 0.1),
        forces = custom(driven, translation),
    )]
    struct Rotor {
        c: f64,
        driven: Driven,
    }
    let none = Vector::<2>::zeros();
    for (c, steps) in [(0.2, [0.1, 0.07]), (0.25, [0.1, 0.125]), (0.5, [0.25, 0.1])] {
        let family = |w: f64| Ok((Rotor { c, driven: Driven { w } }.prepare()?, Vec::new()));
        let (model, _) = family(0.0).unwrap();
        let guess = model.at_velocity(none, Matrix::<2>::identity(), none, Matrix::<2>::zeros()).unwrap();
        for step in steps {
            let branch = Continuation::new(&[], (0.0, 3.0 * c), step, family).run(&guess, 0.0).unwrap();
            let [(Special::Hopf, point)] = branch.special.as_slice() else { panic!("{c}, {step}: {branch}") };
            assert!((point.parameter - 2.0 * c).abs() < 1e-9, "{c}, {step}: {branch}");
        }
    }
}

/// A force on the centre of mass, across the way to it.
#[derive(Clone, Copy, Debug)]
struct Driven {
    w: f64,
}

impl Force<2> for Driven {
    type Form = Translation;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        let w = T::constant(self.w, 0.0);
        Vector::<2, T>::new(-w * motion.x[1], w * motion.x[0])
    }
}

/// A magnetic field holds a charge on a hill, `z'' + i b z' - z = 0`, above `b = 2`, where two frequencies meet.
#[test]
fn forces_without_work_let_frequencies_meet() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = -norm(x)^2/2 + (phi[1,1] - 1)^2 + (phi[2,2] - 1)^2 + phi[1,2]^2 + phi[2,1]^2,
        forces = custom(field, translation, gyroscopic),
    )]
    struct Charged {
        field: Magnetic,
    }
    let none = Vector::<2>::zeros();
    let family = |b: f64| Ok((Charged { field: Magnetic { b } }.prepare()?, Vec::new()));
    let (model, _) = family(1.0).unwrap();
    let guess = model.at_velocity(none, Matrix::<2>::identity(), none, Matrix::<2>::zeros()).unwrap();
    for step in [0.25, 0.3] {
        let branch = Continuation::new(&[], (1.0, 3.0), step, family).run(&guess, 1.0).unwrap();
        let [(Special::Collision, point)] = branch.special.as_slice() else { panic!("{step}: {branch}") };
        assert!((point.parameter - 2.0).abs() < 1e-9, "{step}: {branch}");
    }
}

/// A force across the velocity of the centre of mass.
#[derive(Clone, Copy, Debug)]
struct Magnetic {
    b: f64,
}

impl Force<2> for Magnetic {
    type Form = Translation;
    const GYROSCOPIC: bool = true;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Vector<2, T> {
        let b = T::constant(self.b, 0.0);
        Vector::<2, T>::new(b * motion.x_dot[1], -b * motion.x_dot[0])
    }
}

/// A pitchfork at 0, which a step would pass beyond the end of the range: the branch goes as far as the range, in either direction of
/// the arclength.
#[test]
fn branches_go_as_far_as_the_range() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1, space_translation = 1),
        potential = x[1]^4/4 - l*x[1]^2/2 + x[2]^2/2 + (phi[1,1] - 1)^2 + (phi[2,2] - 1)^2 + phi[1,2]^2 + phi[2,1]^2,
    )]
    struct Forked {
        l: f64,
    }
    let family = |l: f64| {
        if (-1.0..=0.04).contains(&l) {
            Ok((Forked { l }.prepare()?, Vec::new()))
        } else {
            Err(Error::Placement { determinant: l })
        }
    };
    let (model, none) = (Forked { l: -1.0 }.prepare().unwrap(), Vector::<2>::zeros());
    let guess = model.at_velocity(none, Matrix::<2>::identity(), none, Matrix::<2>::zeros()).unwrap();
    for step in [0.099, 0.25, 0.5, 3.0] {
        let branch = Continuation::new(&[], (-1.0, 0.04), step, family).run(&guess, -1.0).unwrap();
        let [(Special::Bifurcation, point)] = branch.special.as_slice() else { panic!("{step}: {branch}") };
        assert!(point.parameter.abs() < 1e-9, "{step}: {branch}");
        assert_eq!((branch.points.last().unwrap().parameter, branch.ended), (0.04, None), "{step}");
    }
    // From where the other branch is, x^2 = l, back to the fork and over it.
    let wide = |l: f64| Ok((Forked { l }.prepare()?, Vec::new()));
    let straight = Continuation::new(&[], (-1.0, 0.5), 0.1, wide).run(&guess, -1.0).unwrap();
    let [(Special::Bifurcation, fork)] = straight.special.as_slice() else { panic!("{straight}") };
    let away = Continuation::new(&[], (-1.0, 0.5), 0.1, wide).switch(fork, 0.05).unwrap();
    let last = away.points.last().unwrap();
    assert_eq!((last.parameter, away.ended), (0.5, None));
    assert!((last.turn.point.x()[0].powi(2) - 0.5).abs() < 1e-12);
}

/// With other metrics the same disc branches where it did, and its stretches are those by these metrics.
#[test]
fn stretches_of_branches_are_those_of_the_metrics() {
    #[affine_model(
        dim = 2,
        metrics(space = diag(4, 1), body = diag(1, 9)),
        kinetic(dalembert = 1),
        potential = hyperbolic_dilatation(4) + neo_hookean(0.05)
    )]
    struct Measured;
    let family = |spin: f64| Ok((Measured, vec![Condition::MomentumMap(0, spin)]));
    // Orthonormal: diag(2, 1) phi diag(1, 1/3).
    let round = Matrix::<2>::new(0.5, 0.0, 0.0, 3.0);
    let guess = Measured.at_velocity(round, Matrix::<2>::zeros()).unwrap();
    let turn = [Generator::rotation(1, 2)];
    let branch = Continuation::new(&turn, (-0.01, 0.8), 0.1, family).run(&guess, 0.0).unwrap();
    let [(Special::Bifurcation, point)] = branch.special.as_slice() else { panic!("{branch}") };
    assert!((point.parameter - 0.6648270638631039).abs() < 1e-9, "{branch}");
    for stretch in point.stretches() {
        assert!((stretch - 1.0511838859648149).abs() < 1e-9, "{branch}");
    }
    assert!(branch.to_string().contains("stretches [1.051183886, 1.051183886]"), "{branch}");
}

/// Viscosity that rests in a body that turns changes neither the branch nor where it loses its stiffness: there it becomes unstable.
#[test]
fn viscous_discs_branch_where_others_do() {
    #[affine_model(
        dim = 2,
        kinetic(dalembert = 1),
        potential = hyperbolic_dilatation(4) + neo_hookean(0.05),
        dissipation(space_inertia = 0.05, casimir2 = 0.05)
    )]
    struct Viscous;
    let family = |spin: f64| Ok((Viscous, vec![Condition::MomentumMap(0, spin)]));
    let guess = Viscous.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let turn = [Generator::rotation(1, 2)];
    let branch = Continuation::new(&turn, (0.01, 0.8), 0.1, family).run(&guess, 0.01).unwrap();
    let [(Special::Bifurcation, point)] = branch.special.as_slice() else { panic!("{branch}") };
    assert!((point.parameter - 0.6648270638631039).abs() < 1e-9, "{branch}");
    let (first, last) = (&branch.points[0], branch.points.last().unwrap());
    assert_eq!(first.stability.verdict, StabilityVerdict::Stable);
    assert!(matches!(last.stability.verdict, StabilityVerdict::Unstable { .. }));
    // The elongated discs of the branch without friction.
    let far = Continuation::new(&turn, (0.0, 1.0), 0.1, family).switch(point, 0.05).unwrap();
    for point in &far.points {
        let q = point.stretches();
        let sum = (q[0] * q[0] + q[1] * q[1]) / 2.0;
        assert!((sum - 4.0 / 0.8 * ((q[0] * q[1]).powi(2) - 1.0)).abs() < 1e-11, "{q:?}");
        assert_eq!(point.stability.verdict, StabilityVerdict::Stable, "{q:?}");
    }
}

/// Where two branches cross there is no single continuation.
#[test]
fn crossings_are_no_starts() {
    let family = |spin: f64| {
        let disc = Disc { i: 1.0, kappa: 4.0, c1: 0.05 }.prepare()?;
        Ok((disc, vec![Condition::MomentumMap(0, spin)]))
    };
    let disc = Disc { i: 1.0, kappa: 4.0, c1: 0.05 }.prepare().unwrap();
    let phi = Matrix::<2>::identity() * 1.0511838859648149;
    let guess = disc.at_velocity(phi, turning(0.300830111875804) * phi).unwrap();
    let turn = [Generator::rotation(1, 2)];
    let refused = Continuation::new(&turn, (0.0, 1.3), 0.1, family).run(&guess, 0.6648270638631039);
    let expected = AnalysisError::Degenerate { kernel: 3, expected: 1 };
    assert_eq!(refused.unwrap_err(), expected);
}

/// A field as the parameter: a body that is pressed along an axis buckles.
#[test]
fn a_field_is_a_parameter() {
    #[affine_model(dim = 2, kinetic(dalembert = 1), potential = phi[1,1]^4/4 - a*phi[1,1]^2/2 + phi[1,2]^2 + phi[2,1]^2 + (phi[2,2] - 1)^2 + 0.3*phi[1,1])]
    struct Buckling {
        a: f64,
    }
    // Critical points of the potential: a = x^2 + 0.3/x, with a fold at x^3 = 0.15.
    let family = |a: f64| Ok((Buckling { a }.prepare()?, Vec::new()));
    let model = Buckling { a: 2.0 }.prepare().unwrap();
    let guess = model.at_velocity(Matrix::<2>::new(0.16, 0.0, 0.0, 1.0), Matrix::<2>::zeros()).unwrap();
    let backward = Continuation::new(&[], (0.0, 3.0), 0.1, family).run(&guess, 2.0).unwrap();
    assert!(backward.special.is_empty(), "{backward}");
    let guess = model.at_velocity(Matrix::<2>::new(1.3, 0.0, 0.0, 1.0), Matrix::<2>::zeros()).unwrap();
    // Towards smaller values: the parameter is turned round.
    let reversed = |b: f64| Ok((Buckling { a: -b }.prepare()?, Vec::new()));
    let branch = Continuation::new(&[], (-2.5, 0.0), 0.1, reversed).run(&guess, -2.0).unwrap();
    let folds = only(&branch, Special::Fold);
    let x = 0.15_f64.cbrt();
    assert_eq!(folds.len(), 1, "{branch}");
    assert!((folds[0].parameter + x * x + 0.3 / x).abs() < 1e-12, "{branch}");
    let grows =
        |point: &BranchPoint<2, _>| matches!(point.stability.verdict, StabilityVerdict::Unstable { .. });
    assert!(!grows(&branch.points[0]) && grows(branch.points.last().unwrap()));
}

#[test]
fn steps_and_starts_that_lead_nowhere_are_refused() {
    let rest = Disc { i: 1.0, kappa: 4.0, c1: 0.05 }.prepare().unwrap();
    let start = rest.at_velocity(Matrix::<2>::identity(), Matrix::<2>::zeros()).unwrap();
    let family = |spin: f64| {
        Ok((Disc { i: 1.0, kappa: 4.0, c1: 0.05 }.prepare()?, vec![Condition::MomentumMap(0, spin)]))
    };
    for (range, step) in [
        ((0.0, 1.0), f64::NAN),
        ((0.0, 1.0), f64::INFINITY),
        ((0.0, 1.0), 0.0),
        ((0.0, 1.0), -0.1),
        ((1.0, 0.0), 0.1),
        ((0.5, 1.0), 0.1),
        ((0.0, f64::NAN), 0.1),
    ] {
        let refused = Continuation::new(&[Generator::rotation(1, 2)], range, step, family).run(&start, 0.1);
        assert!(matches!(refused, Err(AnalysisError::Range { .. })), "{range:?} {step}");
    }
    for time in [0.0, f64::NAN, f64::INFINITY] {
        let refused = lyapunov_spectrum(&rest, &start, time, 1e-9);
        assert!(matches!(refused, Err(AnalysisError::Time(_))), "{time}");
    }
    #[affine_model(dim = 2, kinetic(body_inertia = 1), potential = ln(q))]
    struct Barred;
    // There are no equations at q = 0, and no exponents.
    for phi in [Matrix::<2>::identity(), Matrix::<2>::identity() * 1e200] {
        let start =
            Barred.unflatten(&core::array::from_fn(|k| if k < 4 { phi[(k / 2, k % 2)] } else { 0.1 }));
        let refused = lyapunov_spectrum(&Barred, &start, 1.0, 1e-9);
        assert!(matches!(refused, Err(AnalysisError::Integration(_))), "{phi} {refused:?}");
    }
}

/// A branch that ends within the range keeps its points, and says what the family says there.
#[test]
fn a_family_that_ends_leaves_the_branch_up_to_there() {
    let family = |light: f64| {
        let disc = Disc { i: 1.0 - light, kappa: 4.0, c1: 0.3 }.prepare()?;
        Ok((disc, vec![Condition::Velocity(0, 0.3)]))
    };
    let (disc, _) = family(0.0).unwrap();
    let guess = disc.at_velocity(Matrix::<2>::identity(), turning(0.3)).unwrap();
    let turn = [Generator::rotation(1, 2)];
    let branch = Continuation::new(&turn, (0.0, 2.0), 0.1, family).run(&guess, 0.0).unwrap();
    assert!(matches!(branch.ended, Some(AnalysisError::Model(Error::IllPosed(_)))), "{branch}");
    let last = branch.points.last().unwrap().parameter;
    assert!(branch.points.len() > 5 && (0.99..1.0).contains(&last), "{last}");
    assert!(branch.to_string().contains("\nended: the model is ill-posed"), "{branch}");
    // A range that ends before is left.
    let within = Continuation::new(&turn, (0.0, 0.5), 0.1, family).run(&guess, 0.0).unwrap();
    assert_eq!(within.ended, None);
    // The family may begin with the range.
    let from =
        |light: f64| if light < 0.0 { Err(Error::Placement { determinant: light }) } else { family(light) };
    let same = Continuation::new(&turn, (0.0, 0.5), 0.1, from).run(&guess, 0.0).unwrap();
    assert_eq!((same.points.len(), same.ended), (within.points.len(), None));
}
