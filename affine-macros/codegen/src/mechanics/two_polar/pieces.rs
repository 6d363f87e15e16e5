//! The Hamiltonian of a lattice in pieces whose flows are known.
//!
//! A summand of the energy is solved exactly where its equations show one of two forms for every coordinate that it
//! moves, both decided on polynomials:
//!
//! ```text
//! z' = f                      z -> z + t f                      f of what the summand leaves alone
//! z' = w y,  y' = -w z        z -> z cos tw + y sin tw          w likewise
//! ```
//!
//! So are `sum p_a^2/(2 alpha) + p^2/(2 beta)`, which moves the places, and `M_ab^2 f(q_a - q_b)` and `N_ab^2 g(q_a - q_b)`
//! for each pair: they push the momenta of the pair, and turn the other couplings and the frames by a constant angular
//! velocity. Summands of one pair commute, and are one piece with the potential; different pairs do not, for `n = 3`.
//!
//! `|Vort|^2` or `|S|^2` in the energy commutes with everything and turns one frame: it is no piece, but a rotation
//! from outside that is known for all times.

use crate::algebra::polynomial::add_to;
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Polynomial};
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::potential::OnAxes;
use crate::symbol::Symbol;

use super::{Frames, Lattice};

/// Pieces whose flows make up the motion.
#[derive(Clone, Debug)]
pub struct Pieces {
    /// The drift first.
    pub list: Vec<Piece>,
    /// Are there two, `A` and `B`, with `[B, [B, [B, A]]] = 0`?
    pub nystrom: bool,
}

/// A piece: what it adds, and what it turns, at rates that it leaves alone.
#[derive(Clone, Debug, Default)]
pub struct Piece {
    /// What it is, as text.
    pub name: String,
    /// Coordinates and their constant rates.
    pub shifts: Vec<(Expr, Polynomial)>,
    /// Rotations, one after the other; they commute.
    pub turns: Vec<Turn>,
    /// What the rates and angular velocities share.
    pub shared: Vec<(Expr, Polynomial)>,
}

/// `z' = w y`, `y' = -w z` for every plane `(z, y)`.
#[derive(Clone, Debug)]
pub struct Turn {
    /// `w`.
    pub angular: Polynomial,
    /// The planes `(z, y)` that turn with it.
    pub planes: Vec<(Expr, Expr)>,
}

/// A summand of the energy and its equations over the lattice and its frames.
struct Summand {
    energy: Option<Polynomial>,
    rates: Vec<(Expr, Polynomial)>,
    flow: Piece,
}

impl Pieces {
    /// The pieces of a lattice; `None` where a summand has no flow of either form.
    pub fn of(
        arena: &mut Arena,
        lattice: &Lattice,
        frames: &Frames,
        h: &Hamiltonian,
        potential: Option<&OnAxes>,
    ) -> Option<Self> {
        let mut summands = Vec::new();
        for (name, energy) in parts(arena, lattice, h) {
            let rates = field(arena, lattice, frames, energy.clone());
            let flow = exact_flow(arena, name, &rates)?;
            summands.push(Summand { energy: Some(energy), rates, flow });
        }
        summands.extend(potential.map(|u| kick(lattice, u)));
        let mut groups: Vec<Vec<Summand>> = Vec::new();
        for summand in summands {
            let fits = |group: &&mut Vec<Summand>| {
                group.iter().all(|other| {
                    leaves_alone(arena, other, &summand)
                        && leaves_alone(arena, &summand, other)
                        && commute(arena, other, &summand)
                })
            };
            match groups.iter_mut().find(fits) {
                Some(group) => group.push(summand),
                None => groups.push(vec![summand]),
            }
        }
        let nystrom = is_nystrom(&groups);
        Some(Self { list: groups.into_iter().map(together).collect(), nystrom })
    }
}

/// The kinetic energy by the momenta and couplings that its terms contain, without the norm that commutes.
fn parts(arena: &mut Arena, lattice: &Lattice, h: &Hamiltonian) -> Vec<(String, Polynomial)> {
    let mut h = h.clone();
    if let Some(iso) = &mut h.isotropic {
        iso.skew = Polynomial::zero();
    }
    let energy = lattice.hamiltonian(arena, &h);
    let mut parts: Vec<(Option<Symbol>, Polynomial)> = Vec::new();
    for (monomial, c) in energy.terms() {
        let coupling = monomial.iter().find(|atom| lattice.m.contains(atom) || lattice.n.contains(atom));
        let coupling = coupling.map(|atom| arena.symbol_of(*atom));
        add_to(&mut parts, coupling, &Polynomial::term(monomial.clone(), c.clone()));
    }
    // The drift first, then pair after pair.
    let pairs: Vec<(usize, usize)> = lattice.pairs().collect();
    let rank = |coupling: &Option<Symbol>| {
        let is_of = |symbol: &Symbol, (a, b): &(usize, usize)| *symbol.indices() == [a + 1, b + 1];
        let place = coupling.as_ref().and_then(|symbol| pairs.iter().position(|pair| is_of(symbol, pair)));
        place.map_or(0, |k| k + 1)
    };
    parts.sort_by_key(|(coupling, _)| rank(coupling));
    let name = |coupling: Option<Symbol>| match coupling {
        None => "drift".to_owned(),
        Some(symbol) => format!("{}^2", symbol.to_string().to_uppercase()),
    };
    parts.into_iter().map(|(coupling, energy)| (name(coupling), energy)).collect()
}

/// What an energy moves, of coordinates and frames. For `n = 2` the couplings do not move.
fn field(
    arena: &mut Arena,
    lattice: &Lattice,
    frames: &Frames,
    energy: Polynomial,
) -> Vec<(Expr, Polynomial)> {
    let equations = lattice.equations_of(arena, energy);
    let mut rates: Vec<(Expr, Polynomial)> =
        equations.rates.iter().map(|(_, symbol, rate)| (*symbol, rate.clone())).collect();
    for (frame, angular) in [(&frames.left, &equations.chi), (&frames.right, &equations.theta)] {
        rates.extend(frame.iter().enumerate().map(|(k, entry)| (*entry, frames.rate(frame, angular, k))));
    }
    rates.retain(|(_, rate)| !rate.is_zero());
    rates
}

/// The flow of equations that have one of the two forms.
fn exact_flow(arena: &Arena, name: String, rates: &[(Expr, Polynomial)]) -> Option<Piece> {
    let moves = |s: Expr| rates.iter().any(|(symbol, _)| *symbol == s);
    let still = |p: &Polynomial| !p.any_symbol(arena, &mut |s| moves(s));
    let mut piece = Piece { name, ..Piece::default() };
    let mut turned: Vec<Expr> = Vec::new();
    for (z, rate) in rates {
        if still(rate) {
            piece.shifts.push((*z, rate.clone()));
        } else if !turned.contains(z) {
            let (angular, y) = proportional(rate, &moves)?;
            if !still(&angular) || listed(rates)(y)? != angular.mul(&Polynomial::atom(*z)).neg() {
                return None;
            }
            turned.extend([*z, y]);
            add_plane(&mut piece.turns, angular, (*z, y));
        }
    }
    Some(piece)
}

/// `(w, y)` of a rate `w y` with one coordinate `y` that moves.
fn proportional(rate: &Polynomial, moves: &impl Fn(Expr) -> bool) -> Option<(Polynomial, Expr)> {
    let (first, _) = rate.terms().next()?;
    let y = *first.iter().find(|atom| moves(**atom))?;
    let mut angular = Polynomial::zero();
    for (monomial, c) in rate.terms() {
        let mut rest = monomial.clone();
        rest.remove(monomial.iter().position(|atom| *atom == y)?);
        angular.add_term(rest, c);
    }
    Some((angular, y))
}

/// Planes that turn alike, in either sense, share their angular velocity.
fn add_plane(turns: &mut Vec<Turn>, angular: Polynomial, (z, y): (Expr, Expr)) {
    let opposite = angular.neg();
    for turn in turns.iter_mut() {
        if turn.angular == angular {
            return turn.planes.push((z, y));
        }
        if turn.angular == opposite {
            return turn.planes.push((y, z));
        }
    }
    turns.push(Turn { angular, planes: vec![(z, y)] });
}

/// The potential: forces at places that it leaves alone.
fn kick(lattice: &Lattice, potential: &OnAxes) -> Summand {
    let rates: Vec<(Expr, Polynomial)> =
        lattice.p.iter().copied().zip(potential.forces.iter().cloned()).collect();
    let flow = Piece {
        name: "potential".to_owned(),
        shifts: rates.clone(),
        turns: Vec::new(),
        shared: potential.shared.clone(),
    };
    Summand { energy: None, rates, flow }
}

/// Does `one` move nothing that the rates and angular velocities of `other` depend on?
fn leaves_alone(arena: &Arena, one: &Summand, other: &Summand) -> bool {
    let flow = &other.flow;
    let read = flow.shifts.iter().chain(&flow.shared).map(|(_, p)| p);
    let mut read = read.chain(flow.turns.iter().map(|turn| &turn.angular));
    !read.any(|p| p.any_symbol(arena, &mut |s| one.moves(s)))
}

/// Do the flows commute: `{f, g} = 0`, or neither reads what the other moves?
fn commute(arena: &mut Arena, f: &Summand, g: &Summand) -> bool {
    match (&f.energy, &g.energy) {
        (Some(energy), Some(_)) => {
            let energy = energy.expression(arena);
            let term = |(z, rate): &(Expr, Polynomial)| {
                let slope = arena.derivative(energy, *z);
                Polynomial::normal_form(arena, slope).mul(rate)
            };
            g.rates.iter().map(term).sum::<Polynomial>().is_zero()
        }
        _ => f.is_blind_to(arena, g) && g.is_blind_to(arena, f),
    }
}

impl Summand {
    fn moves(&self, symbol: Expr) -> bool {
        self.rates.iter().any(|(z, _)| *z == symbol)
    }

    /// Do its equations not contain what another one moves?
    fn is_blind_to(&self, arena: &Arena, other: &Self) -> bool {
        let mut read = self.rates.iter().chain(&self.flow.shared).map(|(_, p)| p);
        !read.any(|p| p.any_symbol(arena, &mut |s| other.moves(s)))
    }
}

fn together(group: Vec<Summand>) -> Piece {
    let mut all = Piece::default();
    let names: Vec<&str> = group.iter().map(|summand| summand.flow.name.as_str()).collect();
    all.name = names.join(" + ");
    for summand in group {
        summand.flow.shifts.iter().for_each(|(z, rate)| add_to(&mut all.shifts, *z, rate));
        all.turns.extend(summand.flow.turns);
        all.shared.extend(summand.flow.shared);
    }
    all
}

/// Two pieces: of what the second one moves, at rates that it leaves alone, the energy of the first is of degree two.
fn is_nystrom(groups: &[Vec<Summand>]) -> bool {
    let [first, second] = groups else { return false };
    let moved = |atom: &&Expr| second.iter().any(|summand| summand.moves(**atom));
    let quadratic = |energy: &Polynomial| energy.terms().all(|(m, _)| m.iter().filter(moved).count() <= 2);
    second.iter().all(|summand| summand.flow.turns.is_empty())
        && first.iter().all(|summand| summand.energy.as_ref().is_some_and(quadratic))
}
