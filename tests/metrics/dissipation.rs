//! Dissipation beside metrics.

use affine_oracle::{Kinetic, Matrix as Exact, Random, State, Term, rational};
use affine_runtime::model::Conserved;
use affine_runtime::prelude::*;

use super::forces::BALANCE;
use super::{agrees_under, close, pinned, plane, product, space};

/// Dissipation in every frame, its matrices carried as those of the kinetic energy are.
#[test]
fn in_every_frame() {
    macro_rules! damped {
        ($($n:literal $metrics:ident ($($kinetic:tt)*) ($($damping:tt)*)
            |$g:ident $g_inverse:ident $eta:ident $eta_inverse:ident $j:ident| $energy:expr, $loss:expr;)*) => { $( {
            #[affine_model(
                dim = $n, metrics(space = g, body = eta), kinetic($($kinetic)*), dissipation($($damping)*)
            )]
            struct Prepared {
                g: Matrix<$n>,
                eta: Matrix<$n>,
                j: Matrix<$n>,
            }
            let [$g, $g_inverse, $eta, $eta_inverse] = $metrics();
            let $j = inertia($n);
            let (kinetic, loss) =
                (Kinetic::new($n, $energy).unwrap(), Kinetic::new($n, $loss).unwrap());
            let _ = (&$g_inverse, &$eta_inverse);
            let [g, eta, j] = [&$g, &$eta, &$j].map(|m| Matrix::<$n>::from_row_slice(&m.to_f64()));
            let model = Prepared { g, eta, j }.prepare().unwrap();
            let (at, back) = pinned!(model, $n);
            loses(&model, &kinetic, &loss, at, back);
        } )* };
    }
    damped! {
        2 plane (casimir2 = 0.2, body_inertia = j) (body_inertia = j, casimir2 = 0.25)
            |g g_inverse eta eta_inverse j|
            vec![Term::BodyTensor(product(2, &eta, &j)), Term::Casimir2(rational(1, 5))],
            vec![Term::BodyTensor(product(2, &eta, &j)), Term::Casimir2(rational(1, 4))];
        3 space (dalembert = j) (space_inertia = j, body_inertia = 0.5)
            |g g_inverse eta eta_inverse j|
            vec![Term::FlatTensor(product(3, &g, &j))],
            vec![
                Term::SpaceTensor(product(3, &g, &j)),
                Term::BodyTensor(product(3, &eta, &eta_inverse).scaled(&rational(1, 2))),
            ];
        3 space (space_inertia = j, casimir2 = 0.1) (dalembert = j, space_inertia = 0.5)
            |g g_inverse eta eta_inverse j|
            vec![Term::SpaceTensor(product(3, &g, &j)), Term::Casimir2(rational(1, 10))],
            vec![
                Term::FlatTensor(product(3, &g, &j)),
                Term::SpaceTensor(product(3, &g, &g_inverse).scaled(&rational(1, 2))),
            ];
    }
}

/// The same with numbers, whose forms are decided exactly: `R >= 0` with a kernel.
#[test]
fn in_numbers() {
    #[affine_model(
        dim = 2,
        metrics(space = [[2, 0.5], [0.5, 1.5]], body = [[1, -0.4], [-0.4, 3]]),
        kinetic(casimir2 = 0.2, body_inertia = [[1.5, 0.25], [0.25, 2]]),
        dissipation(space_inertia = [[1, 2], [2, 4]], body_inertia = 0.5)
    )]
    struct Numbers;
    let [g, _, eta, eta_inverse] = plane();
    let kinetic = Kinetic::new(
        2,
        vec![
            Term::BodyTensor(product(2, &eta, &super::twentieths(2, &[30, 5, 5, 40]))),
            Term::Casimir2(rational(1, 5)),
        ],
    )
    .unwrap();
    let loss = Kinetic::new(
        2,
        vec![
            Term::SpaceTensor(product(2, &g, &super::twentieths(2, &[20, 40, 40, 80]))),
            Term::BodyTensor(product(2, &eta, &eta_inverse).scaled(&rational(1, 2))),
        ],
    )
    .unwrap();
    let (at, back) = pinned!(Numbers, 2);
    loses(&Numbers, &kinetic, &loss, at, back);
}

fn inertia(n: usize) -> Exact {
    match n {
        2 => super::twentieths(2, &[30, 5, 5, 40]),
        _ => super::twentieths(3, &[30, 5, 0, 5, 40, -10, 0, -10, 25]),
    }
}

fn loses<const N: usize, M: Model<N>>(
    model: &M,
    kinetic: &Kinetic,
    loss: &Kinetic,
    at: impl Fn(&State) -> M::Point<f64>,
    back: impl Fn(&M::Point<f64>, &affine_runtime::model::Velocity<N>) -> M::Point<f64>,
) {
    let under = |state: &State| kinetic.motion(state).unwrap().damped(loss).unwrap().expected().unwrap();
    agrees_under(model, kinetic, under, &at, back);
    assert!(!M::DESCRIPTION.conserved.contains(&Conserved::Energy));
    for seed in 0..4 {
        let state = Random::new(3100 + seed).state(N).at_rest();
        let state = State { x: state.p.clone(), ..state };
        let free = kinetic.motion(&state).unwrap();
        // dE/dt = -2 R.
        let (x_dot, phi_dot) = (free.rate().x.clone(), free.rate().phi.clone());
        let value = loss.energy(&state.phi, &x_dot, &phi_dot).unwrap().to_f64()[0];
        close("power", &[model.power(0.0, &at(&state))], &[-2.0 * value], value.abs());
    }
    let state = Random::new(3101).state(N).at_rest();
    let start = at(&State { x: state.p.clone(), ..state });
    let run = Simulation::new(model, start).until(0.125).tolerance(1e-12).run().unwrap();
    let balance = run.power_balance().unwrap();
    assert!(balance.relative() <= BALANCE && balance.work < 0.0, "{balance}");
}
