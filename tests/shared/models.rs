//! A model for every method, with the start of a motion: what each method serves, and what it is held to.

use affine_runtime::prelude::*;

/// In a potential that holds its centre; equations of second order.
#[affine_model(
    dim = 2,
    kinetic(dalembert = [[1, 0.25], [0.25, 2]], space_translation = 2),
    potential = tr(G)/2 - ln(det) + x[1]^2/2 + x[2]^4/4 + x[1]*phi[1,2],
    emit(nystrom),
)]
pub struct Anchored;

/// An affine metric and inertia in the body; power series.
#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 2),
    potential = hyperbolic_dilatation(10) + neo_hookean(0.5) + x[1]^2/2,
    emit(taylor),
)]
pub struct Vibrating;

/// On linear springs; exact flows.
#[affine_model(dim = 2, kinetic(dalembert = 1, space_translation = 1), potential = tr(G)/2 + norm(x)^2/2, emit(splitting))]
pub struct Springs;

/// Without forces; a closed form.
#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1, space_translation = 2))]
pub struct Free;

/// Pushed by a potential that depends on time, and braked.
#[affine_model(
    dim = 2,
    kinetic(dalembert = 1, space_translation = 1),
    potential = (1 + sin(3*t)/2)*tr(G)/2 - ln(det) + x[1]^2*cos(t),
    dissipation(dalembert = 0.1, space_translation = 0.2),
)]
pub struct Driven;

/// A symmetric top on the rotations.
#[affine_model(
    dim = 3,
    constraint = rigid,
    kinetic(dalembert = diag(1, 1, 0.5), space_translation = 1),
    potential = 0.7*phi[3,3] + norm(x)^2/2,
    emit(splitting),
)]
pub struct Top;

/// An incompressible body.
#[affine_model(
    dim = 2,
    constraint = isochoric,
    kinetic(dalembert = 1, space_translation = 1),
    potential = tr(G)/2 + norm(x)^2/2,
)]
pub struct Droplet;

/// A model, a start, and all methods that serve it.
pub struct Served<M, P> {
    /// The model.
    pub model: M,
    /// The start.
    pub start: P,
    /// The methods, those of equal steps with the step that was asked for.
    pub methods: Vec<Method>,
}

type Point<M, const N: usize> = <M as Model<N>>::Point<f64>;

const EVERYWHERE: [Method; 4] =
    [Method::Automatic, Method::RungeKutta8, Method::RungeKutta5, Method::Radau { stages: None }];

/// The methods that serve every model, and others.
fn everywhere_and(others: impl IntoIterator<Item = Method>) -> Vec<Method> {
    EVERYWHERE.into_iter().chain(others).collect()
}

/// Collocation takes two evaluations and more for a stage: steps twice as long.
fn gauss(stages: usize, step: f64) -> Method {
    Method::Gauss { stages, step: 2.0 * step }
}

fn adaptive(order: Option<usize>) -> Method {
    Method::AdaptiveSplitting { order }
}

fn placement() -> Matrix<2> {
    Matrix::<2>::new(1.1, 0.2, -0.1, 0.9)
}

fn momentum() -> Matrix<2> {
    Matrix::<2>::new(0.3, -0.2, 0.5, 0.1)
}

fn centre() -> (Vector<2>, Vector<2>) {
    (Vector::<2>::new(0.4, -0.3), Vector::<2>::new(0.2, 0.5))
}

/// [`Anchored`], its start and its methods.
pub fn anchored(step: f64) -> Served<Anchored, Point<Anchored, 2>> {
    let (x, p) = centre();
    let start = Anchored.at_momentum(x, placement(), p, TwoPoint(momentum())).unwrap();
    let nystrom = [Method::RungeKuttaNystrom8, Method::RungeKuttaNystrom12];
    let methods = everywhere_and(nystrom.into_iter().chain([gauss(2, step), gauss(3, step)]));
    Served { model: Anchored, start, methods }
}

/// [`Vibrating`], its start and its methods.
pub fn vibrating(step: f64) -> Served<Vibrating, Point<Vibrating, 2>> {
    let (x, p) = centre();
    let start = Vibrating.at_momentum(x, placement(), p, Comoving(momentum())).unwrap();
    let orders = [None, Some(12)].map(|order| Method::Taylor { order });
    Served { model: Vibrating, start, methods: everywhere_and(orders.into_iter().chain([gauss(3, step)])) }
}

/// [`Springs`], its start and its methods.
pub fn springs(step: f64) -> Served<Springs, Point<Springs, 2>> {
    let (x, p) = centre();
    let start = Springs.at_momentum(x, placement(), p, TwoPoint(momentum())).unwrap();
    let pieces = [2, 4, 6, 8].map(|order| Method::Splitting { order, step });
    let methods = everywhere_and(pieces.into_iter().chain([None, Some(6)].map(adaptive)));
    Served { model: Springs, start, methods }
}

/// [`Driven`], its start and its methods.
pub fn driven(step: f64) -> Served<Driven, Point<Driven, 2>> {
    let (x, p) = centre();
    let start = Driven.at_momentum(x, placement(), p, TwoPoint(momentum())).unwrap();
    Served { model: Driven, start, methods: everywhere_and([gauss(2, step), gauss(3, step)]) }
}

/// [`Free`], its start and its methods.
pub fn free(step: f64) -> Served<Free, Point<Free, 2>> {
    let (x, p) = centre();
    let start = Free.at_momentum(x, placement(), p, Comoving(momentum())).unwrap();
    Served { model: Free, start, methods: everywhere_and([Method::ClosedForm, gauss(2, step)]) }
}

/// [`Top`], its start and its methods.
pub fn top(step: f64) -> Served<Top, Point<Top, 3>> {
    let omega = Matrix::<3>::new(0.0, -2.0, 0.1, 2.0, 0.0, -0.3, -0.1, 0.3, 0.0);
    let (x, v) = (Vector::<3>::new(0.4, -0.3, 0.1), Vector::<3>::new(0.2, 0.5, -0.1));
    let start = Top.at_velocity(x, Matrix::<3>::identity(), v, omega).unwrap();
    let pieces = [2, 4, 6, 8].map(|order| Method::Splitting { order, step });
    let others = [gauss(2, step), gauss(3, step), adaptive(Some(8))];
    let methods = everywhere_and(pieces.into_iter().chain(others));
    Served { model: Top, start, methods }
}

/// [`Droplet`], its start and its methods.
pub fn droplet(step: f64) -> Served<Droplet, Point<Droplet, 2>> {
    let (x, v) = (Vector::<2>::new(0.4, -0.3), Vector::<2>::new(0.2, 0.5));
    let phi = Matrix::<2>::new(2.0, 0.0, 0.0, 0.5);
    let start = Droplet.at_velocity(x, phi, v, Matrix::<2>::new(0.4, 0.0, 0.6, -0.1)).unwrap();
    let rattles = [2, 4, 6, 8].map(|order| Method::Rattle { order, step });
    let methods = everywhere_and(rattles.into_iter().chain([gauss(2, step), gauss(3, step)]));
    Served { model: Droplet, start, methods }
}
