//! Forces and potentials that fields compute: in every form, under kinetic energies of every frame, against forces on
//! the canonical momenta, `N = phi^-1 Q = Q_hat phi^-1`.

use affine_oracle::{Kinetic, Random, State};
use affine_runtime::force::{Force, Motion, Translation};
use affine_runtime::frames::Body as OnBody;
use affine_runtime::model::{Conserved, Description, Quantity};
use affine_runtime::potential::{Class, Place, Potential, Slopes};
use affine_runtime::prelude::*;
use affine_runtime::sampling;
use affine_runtime::scalar::Scalar;

use crate::canonical::{T0, assert_charts_lead_back, assert_reduced_equations_move, groups};
use crate::families::{matrix, vector};
use crate::stated::{
    body_inertia, body_translation, casimir2, dalembert_scalar, is_moving, phase_point, space_inertia,
    space_translation, states,
};
use affine_tests::fields::{
    Fibre, Field, Gyroscope, Kneading, Magnet, Spring, Stirring, Wall, Wind, blown, deflected, gyrated,
    kneaded, stirred, under,
};
use affine_tests::reference::{Reference, assert_close};
use affine_tests::tolerances::{POWER_BALANCE, UNDER_POTENTIAL};

/// A model with forces, and the forces on its canonical momenta.
trait Pushed<const N: usize>: Model<N> + Sized {
    const TRANSLATION: bool;
    /// What motion after motion conserves.
    const CONSERVED: &'static [Conserved];

    fn body() -> Self;
    fn kinetic() -> Kinetic;
    fn push(motion: &Motion<N>) -> (Vec<f64>, Vec<f64>);
    fn at(&self, state: &State) -> Self::Point<f64>;

    fn states() -> Vec<State> {
        states(N, 8101..8104, Self::TRANSLATION)
    }

    fn reference(kinetic: &Kinetic, t: f64, state: &State) -> Reference {
        let free = kinetic.expected(state).unwrap();
        let motion = Motion {
            t,
            x: vector(&state.x.to_f64()),
            phi: matrix(&state.phi.to_f64()),
            x_dot: vector(&free.x_dot),
            phi_dot: matrix(&free.phi_dot),
        };
        let (on_p, on_pi) = Self::push(&motion);
        Reference::pushed(kinetic, state, &on_p, &on_pi)
    }
}

fn agrees_with_the_oracle<const N: usize, M: Pushed<N>>() {
    let (model, kinetic) = (M::body(), M::kinetic());
    for state in M::states() {
        let reference = M::reference(&kinetic, T0, &state);
        let point = model.at(&state);
        let rates = model.hamilton_equations(T0, &model.flatten(&point));
        for (name, rate) in groups(M::DESCRIPTION.full, rates.as_ref()) {
            reference.assert_rate(name, rate, UNDER_POTENTIAL);
        }
        let tolerance = UNDER_POTENTIAL * reference.condition;
        assert_charts_lead_back(&model, &point, &state, tolerance);
        assert_reduced_equations_move(&model, &point, UNDER_POTENTIAL, &|t, state| {
            M::reference(&kinetic, t, state)
        });
    }
    assert_eq!(M::DESCRIPTION.conserved, M::CONSERVED);
}

/// Energy against work, or conserved where the forces have no power.
fn energy_is_accounted_for<const N: usize, M: Pushed<N>>() {
    let model = M::body();
    let start = model.at(&M::states()[0]);
    let run = Simulation::new(&model, start).from(T0).until(T0 + 0.25).tolerance(1e-12).run().unwrap();
    match run.power_balance() {
        Some(balance) => {
            assert!(balance.relative() <= POWER_BALANCE, "{balance}");
            assert!(balance.work.abs() > 1e-3 * balance.scale, "{balance}");
            assert!(!has(M::DESCRIPTION, Conserved::Energy));
            assert!((model.power(T0, &start) - slope(&model, &start)).abs() < 1e-6 * balance.scale);
        }
        None => {
            assert!(has(M::DESCRIPTION, Conserved::Energy));
            assert!(M::DESCRIPTION.reduced.iter().all(|group| group.quantity != Quantity::Work));
            assert!(run.conservation().worst() <= POWER_BALANCE, "{}", run.conservation());
            assert_eq!(model.power(T0, &start), 0.0);
        }
    }
}

fn has(description: Description, quantity: Conserved) -> bool {
    description.conserved.contains(&quantity)
}

/// The rate of `H` over a short run, by differences.
fn slope<const N: usize, M: Model<N>>(model: &M, start: &M::Point<f64>) -> f64 {
    let h = 1e-4;
    let at = |t: f64| {
        let run = Simulation::new(model, *start).from(T0).until(T0 + t).tolerance(1e-13).run().unwrap();
        model.hamiltonian(T0 + t, run.end().1)
    };
    (at(h) - at(-h)) / (2.0 * h)
}

macro_rules! pushed {
    ($($name:ident $n:literal $centre:ident [$($term:ident)*] ($($kinetic:tt)*) ($($spec:tt)*) $field:ident
        [$($conserved:ident)*] |$motion:ident| $push:expr;)*) => { $(
        mod $name {
            #[allow(clippy::wildcard_imports)]
            use super::*;

            #[affine_model(dim = $n, kinetic($($kinetic)*), $($spec)*)]
            struct Body {
                field: $field,
            }

            impl Pushed<$n> for Body {
                const TRANSLATION: bool = is_moving!($centre);
                const CONSERVED: &'static [Conserved] = &[$(Conserved::$conserved),*];

                fn body() -> Self {
                    Body { field: $field { strength: 0.75 } }
                }
                fn kinetic() -> Kinetic {
                    Kinetic::new($n, vec![$($term($n)),*]).unwrap()
                }
                fn push($motion: &Motion<$n>) -> (Vec<f64>, Vec<f64>) {
                    $push
                }
                fn at(&self, state: &State) -> Self::Point<f64> {
                    phase_point!($centre self state)
                }
            }

            #[test]
            fn equations() {
                agrees_with_the_oracle::<$n, Body>();
            }
            #[test]
            fn energy() {
                energy_is_accounted_for::<$n, Body>();
            }
        }
    )* };
}

pushed! {
    stirring_left 3 pinned [body_inertia casimir2] (body_inertia = 1.5, casimir2 = 0.25)
        (forces = custom(field, spatial)) Stirring [] |motion| stirred(motion);
    stirring_missile 2 moving [body_inertia casimir2 body_translation]
        (body_inertia = 1.5, casimir2 = 0.25, body_translation = 1.25)
        (forces = custom(field, spatial)) Stirring [LinearMomentum] |motion| stirred(motion);
    stirring_right 2 moving [space_inertia casimir2 space_translation]
        (space_inertia = 1.5, casimir2 = 0.25, space_translation = 1.25)
        (forces = custom(field, spatial)) Stirring [LinearMomentum OrbitalAngularMomentum] |motion| stirred(motion);
    stirring_dalembert 3 pinned [dalembert_scalar] (dalembert = 1.5)
        (forces = custom(field, spatial)) Stirring [] |motion| stirred(motion);
    kneading_left 2 pinned [body_inertia casimir2] (body_inertia = 1.5, casimir2 = 0.25)
        (forces = custom(field, comoving)) Kneading [] |motion| kneaded(motion);
    kneading_right 3 pinned [space_inertia casimir2] (space_inertia = 1.5, casimir2 = 0.25)
        (forces = custom(field, comoving)) Kneading [] |motion| kneaded(motion);
    kneading_dalembert 2 pinned [dalembert_scalar] (dalembert = 1.5)
        (forces = custom(field, comoving)) Kneading [] |motion| kneaded(motion);
    wind_missile 3 moving [body_inertia casimir2 body_translation]
        (body_inertia = 1.5, casimir2 = 0.25, body_translation = 1.25)
        (forces = custom(field, translation)) Wind [Vorticity VorticityNorm] |motion| blown(motion);
    wind_right 2 moving [space_inertia casimir2 space_translation]
        (space_inertia = 1.5, casimir2 = 0.25, space_translation = 1.25)
        (forces = custom(field, translation)) Wind
        [Spin SpinNorm ComovingAffineSpin ComovingDeviator Vorticity VorticityNorm
            Casimir1 Casimir2 DeviatorCasimir2]
        |motion| blown(motion);
    magnet 2 moving [dalembert_scalar space_translation] (dalembert = 1.5, space_translation = 1.25)
        (forces = custom(field, translation, gyroscopic)) Magnet
        [Energy Spin SpinNorm Vorticity VorticityNorm CanonicalMomentum] |motion| deflected(motion);
    gyroscope_left 2 pinned [body_inertia casimir2] (body_inertia = 1.5, casimir2 = 0.25)
        (forces = custom(field, spatial, gyroscopic)) Gyroscope [Energy] |motion| gyrated(motion);
    gyroscope_dalembert 3 pinned [dalembert_scalar] (dalembert = 1.5)
        (forces = custom(field, spatial, gyroscopic)) Gyroscope [Energy] |motion| gyrated(motion);
    spring_left 2 pinned [body_inertia casimir2] (body_inertia = 1.5, casimir2 = 0.25)
        (potential = custom(field, isotropic)) Spring [Energy Spin SpinNorm Vorticity VorticityNorm]
        |motion| under(motion, |place| place.trace_green() * 0.75);
    spring_and_more 3 pinned [dalembert_scalar] (dalembert = 1.5)
        (potential = q^2/2 + custom(field, isotropic)) Spring [Energy Spin SpinNorm Vorticity VorticityNorm]
        |motion| under(motion, |place| place.trace_green() * 0.75 + place.q() * place.q() * 0.5);
    spring_missile 3 moving [body_inertia casimir2 body_translation]
        (body_inertia = 1.5, casimir2 = 0.25, body_translation = 1.25)
        (potential = custom(field, isotropic)) Spring
        [Energy LinearMomentum TotalAngularMomentum Vorticity VorticityNorm]
        |motion| under(motion, |place| place.trace_green() * 0.75);
    fibre_left 3 pinned [body_inertia casimir2] (body_inertia = 1.5, casimir2 = 0.25)
        (potential = custom(field, green)) Fibre [Energy Spin SpinNorm]
        |motion| under(motion, |place| place.green(1, 1).power(2) * 0.75);
    fibre_right 2 pinned [space_inertia casimir2] (space_inertia = 1.5, casimir2 = 0.25)
        (potential = custom(field, green)) Fibre [Energy Spin SpinNorm]
        |motion| under(motion, |place| place.green(1, 1).power(2) * 0.75);
    wall_left 2 pinned [body_inertia casimir2] (body_inertia = 1.5, casimir2 = 0.25)
        (potential = custom(field, finger)) Wall [Energy Vorticity VorticityNorm]
        |motion| under(motion, |place| place.finger(1, 2).power(2) * 0.75);
    field_missile 2 moving [body_inertia casimir2 body_translation]
        (body_inertia = 1.5, casimir2 = 0.25, body_translation = 1.25)
        (potential = custom(field, general, position)) Field [Energy]
        |motion| under(motion, |place| place.x(1) * place.trace_green() * 0.75);
    field_right 3 moving [space_inertia casimir2 space_translation]
        (space_inertia = 1.5, casimir2 = 0.25, space_translation = 1.25)
        (potential = custom(field, general, position)) Field [Energy]
        |motion| under(motion, |place| place.x(1) * place.trace_green() * 0.75);
}

/// Two forces, a dissipation, parameters and generics in one model.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = a, body_inertia = i, space_translation = 1),
    potential = a*q^2 + custom(spring, isotropic),
    dissipation(body_inertia = r),
    forces = custom(push, translation) + custom(stirring, spatial),
)]
struct Everything<F: Force<2, Form = Translation> + Clone> {
    a: f64,
    i: f64,
    r: f64,
    spring: Spring,
    push: F,
    stirring: Stirring,
}

#[test]
fn forces_of_all_kinds_go_together() {
    let everything = Everything {
        a: 0.25,
        i: 1.5,
        r: 0.5,
        spring: Spring { strength: 0.5 },
        push: Wind { strength: 0.25 },
        stirring: Stirring { strength: 0.125 },
    };
    let model = everything.prepare().unwrap();
    let state = Random::new(5).state(2);
    let (phi, pi) = (matrix(&state.phi.to_f64()), TwoPoint(matrix(&state.pi.to_f64())));
    let start = model.at_momentum(vector(&state.x.to_f64()), phi, vector(&state.p.to_f64()), pi).unwrap();
    let run = Simulation::new(&model, start).until(0.5).tolerance(1e-12).run().unwrap();
    let balance = run.power_balance().unwrap();
    assert!(balance.relative() <= POWER_BALANCE, "{balance}");
    assert_close("power", &[model.power(0.0, &start)], &[slope_at(&model, &start)], balance.scale, 1e-6);
    let description = <PreparedEverything<Wind> as Model<2>>::DESCRIPTION;
    assert_eq!(description.conserved, []);
    let equations: Vec<&str> = description.equations.iter().map(|formula| formula.text).collect();
    assert!(equations.contains(&"dH/dt = -2 R + F[push].dx/dt + tr(Q[stirring] Omega)"), "{equations:?}");
    assert!(description.hamiltonian.text.ends_with("+ U[spring]"), "{}", description.hamiltonian.text);
    let defect = Everything { r: -0.5, ..everything }.prepare().map(|_| ()).unwrap_err().to_string();
    assert!(defect.contains("I + A >= 0"), "{defect}");
}

fn slope_at<const N: usize, M: Model<N>>(model: &M, start: &M::Point<f64>) -> f64 {
    let h = 1e-4;
    let at = |t: f64| {
        let run = Simulation::new(model, *start).until(t).tolerance(1e-13).run().unwrap();
        model.hamiltonian(t, run.end().1)
    };
    (at(h) - at(-h)) / (2.0 * h)
}

#[test]
fn gyroscopic_forces_are_found_out() {
    sampling::check_force::<2, _>(&Gyroscope { strength: 0.75 }, sampling::motions(20)).unwrap();
    sampling::check_force::<3, _>(&Magnet { strength: 2.0 }, sampling::motions(20)).unwrap();
    // What claims nothing is not held against anything.
    sampling::check_force::<3, _>(&Wind { strength: 2.0 }, sampling::motions(20)).unwrap();

    struct False;
    impl Force<2> for False {
        type Form = OnBody;
        const GYROSCOPIC: bool = true;
        fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Matrix<2, T> {
            motion.phi_dot
        }
    }
    let found = sampling::check_force::<2, _>(&False, sampling::motions(20)).unwrap_err();
    assert!(matches!(found, sampling::Unsound::Power { power, scale, .. } if power.abs() > 0.01 * scale));
    assert!(found.to_string().contains("gyroscopic"), "{found}");
}

#[test]
fn classes_and_slopes_are_found_out() {
    fn sound<P: Potential<2> + Potential<3>>(potential: &P) {
        sampling::check_potential::<2, _>(potential, sampling::places(20)).unwrap();
        sampling::check_potential::<3, _>(potential, sampling::places(20)).unwrap();
    }
    sound(&Spring { strength: 0.75 });
    sound(&Fibre { strength: 0.75 });
    sound(&Wall { strength: 0.75 });
    sound(&Field { strength: 0.75 });

    /// Another potential with a false claim or a false slope.
    struct Off<const WRONG_SLOPE: bool>;
    impl<const WRONG_SLOPE: bool> Potential<3> for Off<WRONG_SLOPE> {
        const CLASS: Class = if WRONG_SLOPE { Class::Green } else { Class::Isotropic };
        fn energy<T: Scalar>(&self, place: &Place<3, T>) -> T {
            Fibre { strength: 1.0 }.energy(place)
        }
        fn slopes<T: Scalar>(&self, place: &Place<3, T>) -> Slopes<3, T> {
            let slopes = Fibre { strength: 1.0 }.slopes(place);
            if WRONG_SLOPE { Slopes { phi: slopes.phi.transpose(), ..slopes } } else { slopes }
        }
    }
    /// A false claim of a small energy.
    struct Small;
    impl Potential<3> for Small {
        const CLASS: Class = Class::Isotropic;
        fn energy<T: Scalar>(&self, place: &Place<3, T>) -> T {
            T::constant(1e-12, 0.0) * place.phi[(0, 0)]
        }
        fn slopes<T: Scalar>(&self, _: &Place<3, T>) -> Slopes<3, T> {
            let mut phi = Matrix::<3, T>::from_fn(|_, _| T::zero());
            phi[(0, 0)] = T::constant(1e-12, 0.0);
            Slopes { x: Vector::<3, T>::from_fn(|_, _| T::zero()), phi }
        }
    }
    let small = sampling::check_potential::<3, _>(&Small, sampling::places(20)).unwrap_err();
    assert!(matches!(small, sampling::Unsound::Class { .. }), "{small}");
    let class = sampling::check_potential::<3, _>(&Off::<false>, sampling::places(20)).unwrap_err();
    assert!(matches!(class, sampling::Unsound::Class { class: Class::Isotropic, .. }), "{class}");
    assert!(class.to_string().contains("Isotropic"), "{class}");
    let slope = sampling::check_potential::<3, _>(&Off::<true>, sampling::places(20)).unwrap_err();
    assert!(matches!(slope, sampling::Unsound::Slope { coordinate: (1, 2), .. }), "{slope}");
    assert!(slope.to_string().contains("phi[1,2]"), "{slope}");
}
