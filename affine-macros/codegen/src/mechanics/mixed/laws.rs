//! What each part of a sum of energies adds to the momentum and to its rate, as a sentence and as numbers: the sentences are
//! stated after their values were compared with those of the derived equations, modulo a prime.

use crate::algebra::evaluate::Field;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{self, Ring, Square, difference, outer, sum, table, times, transpose};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::equations::Load;
use crate::mechanics::group_point::{GroupPoint, inverse};
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::notation::{Letter, Sentence, Summand, commutator, letters, placement, product, slope};
use crate::mechanics::term::Frame;
use crate::mechanics::transport;

use super::Masses;

/// What a part adds.
pub(super) struct Law {
    /// The name of its momentum in its own frame and of the energy, where the momentum has a name.
    pub(super) own: Option<(Letter, Own)>,
    /// Its momentum in the frame of the sum.
    pub(super) momentum: fn() -> Sentence,
    /// What it adds to the rate.
    pub(super) rate: Option<fn() -> Summand>,
    /// Momentum and rate.
    value: fn(&Placed) -> [Square<Residue>; 2],
}

/// What the momentum of a part is.
type Own = fn() -> Sentence;

fn inverse_placement() -> Sentence {
    placement().inverse()
}

/// `(dT/dO)^T`
fn momentum(energy: Letter, velocity: Letter) -> Sentence {
    slope(energy, velocity).transposed()
}

fn in_the_body() -> Sentence {
    momentum(letters::ENERGY_IN_THE_BODY, letters::COMOVING_AFFINE_VELOCITY)
}

fn in_space() -> Sentence {
    momentum(letters::ENERGY_IN_SPACE, letters::AFFINE_VELOCITY)
}

fn seen_from_the_body() -> Sentence {
    product([inverse_placement(), in_space(), placement()])
}

fn in_dphi() -> Sentence {
    momentum(letters::ENERGY_IN_DPHI, letters::PLACEMENT_VELOCITY)
}

/// A part at a point: `X = (dT/dO)^T`, its velocity `O`, that of the sum, `phi` and `phi^-1`.
struct Placed {
    x: Square<Residue>,
    o: Square<Residue>,
    velocity: Square<Residue>,
    phi: Square<Residue>,
    psi: Square<Residue>,
}

// Parts have letters of their own: the affine spin is that of the whole sum.
const BODY: Law = Law {
    own: Some((letters::SPIN_IN_THE_BODY, in_the_body)),
    momentum: || product([Sentence::from(letters::SPIN_IN_THE_BODY), inverse_placement()]),
    rate: Some(|| {
        let [o, x] = [letters::COMOVING_AFFINE_VELOCITY, letters::SPIN_IN_THE_BODY].map(Sentence::from);
        Summand::minus(product([o, x, inverse_placement()]))
    }),
    value: |at| {
        let momentum = ring::product(&at.x, &at.psi);
        [momentum.clone(), negative(&ring::product(&at.o, &momentum))]
    },
};

// phi^-1 X of the spin X in space is Y phi^-1, and phi^-1 Omega is Omega_hat phi^-1.
const SPACE: Law = Law {
    own: Some((letters::SPIN_IN_SPACE, seen_from_the_body)),
    momentum: || product([Sentence::from(letters::SPIN_IN_SPACE), inverse_placement()]),
    rate: Some(|| {
        let [y, o] = [letters::SPIN_IN_SPACE, letters::COMOVING_AFFINE_VELOCITY].map(Sentence::from);
        Summand::minus(product([y, o, inverse_placement()]))
    }),
    value: |at| {
        let momentum = ring::product(&at.psi, &at.x);
        [momentum.clone(), negative(&ring::product(&momentum, &at.o))]
    },
};

const FLAT: Law = Law { own: None, momentum: in_dphi, rate: None, value: |at| [at.x.clone(), zero(&at.x)] };

const BODY_ON_A_GROUP: Law = Law {
    own: Some((letters::SPIN_IN_THE_BODY, in_the_body)),
    momentum: || Sentence::from(letters::SPIN_IN_THE_BODY),
    rate: Some(|| Summand::plus(commutator(letters::SPIN_IN_THE_BODY, letters::COMOVING_AFFINE_VELOCITY))),
    value: |at| [at.x.clone(), difference(&ring::product(&at.x, &at.o), &ring::product(&at.o, &at.x))],
};

const SPACE_ON_A_GROUP: Law = Law {
    own: Some((letters::SPIN_IN_SPACE, seen_from_the_body)),
    momentum: || Sentence::from(letters::SPIN_IN_SPACE),
    rate: None,
    value: |at| [ring::product(&ring::product(&at.psi, &at.x), &at.phi), zero(&at.x)],
};

const FLAT_ON_A_GROUP: Law = Law {
    own: Some((letters::SPIN_IN_DPHI, || product([in_dphi(), placement()]))),
    momentum: || Sentence::from(letters::SPIN_IN_DPHI),
    rate: Some(|| {
        Summand::plus(product([letters::SPIN_IN_DPHI, letters::COMOVING_AFFINE_VELOCITY].map(Sentence::from)))
    }),
    value: |at| {
        let momentum = ring::product(&at.x, &at.phi);
        [momentum.clone(), ring::product(&momentum, &at.velocity)]
    },
};

/// That of a part in the velocity of a frame, on a group or on all placements.
pub(super) fn law(frame: Frame, confined: bool) -> &'static Law {
    match (frame, confined) {
        (Frame::Body, false) => &BODY,
        (Frame::Space, false) => &SPACE,
        (Frame::Flat, false) => &FLAT,
        (Frame::Body, true) => &BODY_ON_A_GROUP,
        (Frame::Space, true) => &SPACE_ON_A_GROUP,
        (Frame::Flat, true) => &FLAT_ON_A_GROUP,
    }
}

/// Are the laws of the parts, and that of the centre of mass, the equations that `loads` are in a chart with spatial `p`?
pub fn laws_hold(
    arena: &mut Arena,
    (parts, masses): (&[Kinetic], &Masses),
    chart: &Chart,
    loads: &[Load],
) -> bool {
    let velocity = Matrix::symbols(arena, chart.frame().velocity(), chart.dim);
    let masses = masses.of_body_and_space(arena);
    let points = GroupPoint::all(arena, chart, chart.confined);
    points.into_iter().all(|mut point| {
        loads.iter().for_each(|load| point.define(arena, &load.shared));
        hold_at(arena, &point, (parts, &masses), (chart, &velocity), loads)
    })
}

fn hold_at(
    arena: &Arena,
    point: &GroupPoint,
    (parts, [body, space]): (&[Kinetic], &[Polynomial; 2]),
    (chart, velocity): (&Chart, &Matrix),
    loads: &[Load],
) -> bool {
    let n = chart.dim;
    let value = |p: &Polynomial| point.evaluate(arena, p);
    let of = |m: &Matrix| table(n, |a, b| value(&Polynomial::atom(m.0[a][b])));
    let derived = |z: Coordinate| {
        let forces = loads.iter().flat_map(|load| &load.forces).filter(|(known, _)| *known == z);
        forces.fold(Residue::zero(), |mut sum, (_, force)| {
            sum.plus(&value(force), &Rational::ONE);
            sum
        })
    };
    let projected =
        |m: Square<Residue>| chart.confined.map_or_else(|| m.clone(), |group| group.projected(&m));
    let (phi, velocity) = (of(&chart.phi), of(velocity));
    let psi = inverse(&phi);
    let phi_dot = transport::velocity(chart.frame(), &velocity, &phi);
    let (mut momentum, mut rate) = (zero(&phi), zero(&phi));
    for part in parts.iter().filter(|part| !part.internal.is_empty()) {
        let o = transport::velocity(part.frame, &phi_dot, &psi);
        let form: Vec<Vec<Residue>> = part.form().iter().map(|row| row.iter().map(value).collect()).collect();
        let slopes = times(&form, &o.concat());
        let x = table(n, |a, b| slopes[n * b + a]);
        let at = Placed { x, o, velocity: velocity.clone(), phi: phi.clone(), psi: psi.clone() };
        let [m, m_dot] = (law(part.frame, chart.confined.is_some()).value)(&at);
        (momentum, rate) = (sum(&momentum, &m), sum(&rate, &m_dot));
    }
    let p: Vec<Residue> = chart.p.iter().map(|p: &Expr| value(&Polynomial::atom(*p))).collect();
    let x_dot: Vec<Residue> = (0..p.len()).map(|i| derived(Coordinate::X(i))).collect();
    let v_hat = times(&psi, &x_dot);
    let (body, space) = (scaled(&v_hat, value(body)), scaled(&x_dot, value(space)));
    let p_hat = times(&transpose(&phi), &p);
    let of_both: Vec<Residue> = plus(&body, &times(&transpose(&phi), &space));
    if !p.is_empty() {
        // On a group as p - m_space x_dot = phi^-T m_body v_hat.
        let pulled = if chart.confined.is_some() { body } else { plus(&p, &scaled(&space, minus_one())) };
        rate = difference(&rate, &outer(&v_hat, &pulled));
    }
    projected(momentum) == of(&chart.m)
        && projected(rate) == projected(table(n, |a, b| derived(Coordinate::M(a, b))))
        && of_both == p_hat
}

fn minus_one() -> Residue {
    Residue::from_rational(&Rational::MINUS_ONE)
}

fn zero(like: &Square<Residue>) -> Square<Residue> {
    table(like.len(), |_, _| Residue::zero())
}

fn negative(m: &Square<Residue>) -> Square<Residue> {
    difference(&zero(m), m)
}

fn scaled(v: &[Residue], factor: Residue) -> Vec<Residue> {
    v.iter().map(|entry| entry.mul(&factor)).collect()
}

fn plus(a: &[Residue], b: &[Residue]) -> Vec<Residue> {
    a.iter().zip(b).map(|(a, b)| a.add(b)).collect()
}
