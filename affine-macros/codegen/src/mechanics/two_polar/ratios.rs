//! The lattice in ratios of stretches, where its equations are rational.
//!
//! With `t_ab = exp(q_b - q_a)`, `M = U + W`, `N = U - W`, momenta divided by `alpha`, and `C(2)/2` for the energy:
//!
//! ```text
//! 1/sh^2 x = 4 t/(1-t)^2,  1/ch^2 x = 4 t/(1+t)^2,  ch x/sh x = (1+t)/(1-t),  r = 1/(1-t^2)
//! chi_hat = t r^2 ((1+t^2) U + 2t W),  theta_hat = t r^2 ((1+t^2) W + 2t U)
//! dt_ab/dt = t_ab (p_b - p_a),  dp_a/dt = sum over b of chi_hat_ab theta_hat_ab/(t r),  dU/dt = [U, theta_hat],  dW/dt = [W, chi_hat]
//! ```
//!
//! The rest of an isotropic energy, `(tr Sigma)^2` and `|Vort|^2` or `|S|^2`, moves the mean of `q_a` uniformly and one frame.
//! What stands above is not written here: the equations of the lattice are brought to these variables, and the forces
//! divided by the angular velocities, exactly.

use crate::algebra::division::{content, quotient};
use crate::algebra::fault::never_missing;
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::hamiltonian::{Hamiltonian, Isotropic};
use crate::symbol::Quantity;

use super::{Coordinate, Equations, Lattice, Stable};

/// State, definitions and equations.
#[derive(Clone, Debug)]
pub struct Ratios {
    /// `t_ab` of neighbours, `b = a + 1`.
    pub ratios: Vec<Expr>,
    /// `p_a/alpha`.
    pub p: Vec<Expr>,
    /// `U_ab`, `W_ab`, `a < b`.
    pub couplings: [Vec<Expr>; 2],
    /// What the rates share.
    pub shared: Vec<(Expr, Polynomial)>,
    /// Rates of what moves, in the order of the state.
    pub rates: Vec<(Expr, Polynomial)>,
}

/// The symbols of one pair.
struct Pair {
    at: (usize, usize),
    recip: Expr,
    u: Expr,
    w: Expr,
    /// `chi_hat`, `theta_hat`.
    angular: [Expr; 2],
    /// The same as polynomials in the symbols above.
    angular_forms: [Polynomial; 2],
    /// `theta_hat` without `t r`, and the same as a polynomial.
    body: (Expr, Polynomial),
}

impl Ratios {
    /// The equations of a lattice of `C(2)/2`; `None` where the energy has no Casimirs.
    pub fn of(arena: &mut Arena, lattice: &Lattice, h: &Hamiltonian) -> Option<Self> {
        h.isotropic.as_ref()?;
        let mut unit = h.clone();
        let casimir2 = Polynomial::constant(Rational::ONE);
        unit.isotropic = Some(Isotropic { casimir2, ..Isotropic::zero() });
        let equations = lattice.equations(arena, &unit);
        let stable = Stable::new(arena, lattice);
        let mut shared = Vec::new();
        let mut pairs = Vec::new();
        let symbols = Symbols::new(arena, lattice);
        let in_ratios = |p: &Polynomial| symbols.in_ratios(&stable, lattice, p);
        for (k, at) in lattice.pairs().enumerate() {
            let forms = [&equations.chi[k], &equations.theta[k]].map(in_ratios);
            pairs.push(pair(arena, &symbols, (k, at), forms, &mut shared));
        }
        let mut rates = Vec::new();
        for (a, ratio) in symbols.neighbours(lattice.dim).into_iter().enumerate() {
            let [next, own] = [a + 1, a].map(|place| rate_of(&equations, Coordinate::Q(place)));
            let rate = Polynomial::atom(ratio).mul(&next.sub(&own));
            rates.push((ratio, rate));
        }
        for (a, p) in lattice.p.iter().enumerate() {
            rates.push((*p, force(&in_ratios(&rate_of(&equations, Coordinate::P(a))), &pairs)));
        }
        if lattice.dim > 2 {
            rates.extend(turning(lattice, &pairs, &symbols));
        }
        Some(Self {
            ratios: symbols.neighbours(lattice.dim),
            p: lattice.p.clone(),
            couplings: [symbols.u.clone(), symbols.w.clone()],
            shared,
            rates,
        })
    }
}

fn rate_of(equations: &Equations, coordinate: Coordinate) -> Polynomial {
    let found = equations.rates.iter().find(|(z, ..)| *z == coordinate);
    never_missing(found.map(|(.., rate)| rate.clone()), "every coordinate has a rate", Polynomial::zero())
}

/// Symbols of all pairs, in their order.
struct Symbols {
    pairs: Vec<(usize, usize)>,
    ratio: Vec<Expr>,
    recip: Vec<Expr>,
    u: Vec<Expr>,
    w: Vec<Expr>,
}

impl Symbols {
    fn new(arena: &mut Arena, lattice: &Lattice) -> Self {
        let pairs: Vec<(usize, usize)> = lattice.pairs().collect();
        let mut of_pairs = |of: Quantity| -> Vec<Expr> {
            pairs.iter().map(|(a, b)| arena.symbol(of.at([a + 1, b + 1]))).collect()
        };
        let [ratio, recip, u, w] =
            [Quantity::Ratio, Quantity::Reciprocal, Quantity::RatioU, Quantity::RatioW].map(&mut of_pairs);
        Self { pairs, ratio, recip, u, w }
    }

    fn neighbours(&self, n: usize) -> Vec<Expr> {
        (1..n).filter_map(|b| self.ratio_of(b - 1, b)).collect()
    }

    fn ratio_of(&self, a: usize, b: usize) -> Option<Expr> {
        self.pairs.iter().position(|pair| *pair == (a, b)).map(|k| self.ratio[k])
    }

    /// `U + W` for `M`, `U - W` for `N`.
    fn coupling(&self, lattice: &Lattice, atom: Expr) -> Option<Polynomial> {
        let (place, sign) = match lattice.m.iter().position(|m| *m == atom) {
            Some(place) => (place, Rational::ONE),
            None => (lattice.n.iter().position(|n| *n == atom)?, Rational::MINUS_ONE),
        };
        let mut sum = Polynomial::atom(self.u[place]);
        sum.add_term(vec![self.w[place]], &sign);
        Some(sum)
    }

    /// A polynomial of the lattice in these symbols.
    fn in_ratios(&self, stable: &Stable, lattice: &Lattice, polynomial: &Polynomial) -> Polynomial {
        let quotients = stable.quotients();
        let one = Polynomial::constant(Rational::ONE);
        let value = |atom: Expr| {
            if let Some(coupling) = self.coupling(lattice, atom) {
                return Some(coupling);
            }
            let (k, which) = quotients.iter().enumerate().find_map(|(k, functions)| {
                functions.iter().position(|function| *function == atom).map(|which| (k, which))
            })?;
            let (t, r) = (self.ratio[k], self.recip[k]);
            // (1 + t) and (1 - t) over one denominator: 1/(1 - t) = (1 + t) r.
            let t_alone = Polynomial::atom(t);
            let side = if which % 2 == 0 { one.add(&t_alone) } else { one.sub(&t_alone) };
            let factor = if which < 2 { vec![t, r, r] } else { vec![r] };
            Some(side.mul(&side).mul(&Polynomial::monomial(factor)))
        };
        stable.rewritten(polynomial).substitute(&value)
    }
}

/// Defines what one pair shares.
fn pair(
    arena: &mut Arena,
    symbols: &Symbols,
    (k, at): (usize, (usize, usize)),
    angular_forms: [Polynomial; 2],
    shared: &mut Vec<(Expr, Polynomial)>,
) -> Pair {
    let (ratio, recip, u, w) = (symbols.ratio[k], symbols.recip[k], symbols.u[k], symbols.w[k]);
    let mut named = |of: Quantity| arena.symbol(of.at([at.0 + 1, at.1 + 1]));
    let [square, gap, even, twice, decay] =
        [Quantity::RatioSquare, Quantity::Gap, Quantity::Even, Quantity::Twice, Quantity::Decay]
            .map(&mut named);
    let [space, body, chi, theta] =
        [Quantity::SpaceRatio, Quantity::BodyRatio, Quantity::LeftAngular, Quantity::RightAngular]
            .map(&mut named);
    if let (Some(first), Some(second)) = (symbols.ratio_of(at.0, at.0 + 1), symbols.ratio_of(at.0 + 1, at.1))
    {
        shared.push((ratio, Polynomial::monomial([first, second])));
    }
    let one = Polynomial::constant(Rational::ONE);
    // A symbol is not the number zero.
    let below = arena.reciprocal(gap);
    shared.extend([
        (square, Polynomial::monomial([ratio, ratio])),
        (gap, one.sub(&Polynomial::atom(square))),
        (even, one.add(&Polynomial::atom(square))),
        (twice, Polynomial::term(vec![ratio], Rational::from(2))),
        (recip, Polynomial::atom(below)),
        (decay, Polynomial::monomial([ratio, recip])),
    ]);
    // t^2 = even - 1, t = twice/2.
    let even_less = Polynomial::atom(even).sub(&one);
    let paired = |primitive: &Polynomial| {
        let mut sum = Polynomial::zero();
        for (monomial, c) in primitive.terms() {
            let power = monomial.iter().filter(|atom| **atom == ratio).count();
            let rest: Vec<Expr> = monomial.iter().copied().filter(|atom| *atom != ratio).collect();
            let mut term = Polynomial::term(rest, c.clone());
            for _ in 0..power / 2 {
                term = term.mul(&even_less);
            }
            if power % 2 == 1 {
                term = term.mul(&Polynomial::term(vec![twice], Rational::HALF));
            }
            sum.add_scaled(&term, &Rational::ONE);
        }
        sum
    };
    let [chi_form, theta_form] = &angular_forms;
    let [_, body_form] = [(space, chi, chi_form), (body, theta, theta_form)].map(|(side, angular, form)| {
        let (mut common, primitive) = content(form);
        // One reciprocal goes with the sum, the rest with t.
        let with_recip = common.iter().position(|atom| *atom == recip).map(|at| common.remove(at));
        let factor: Vec<Expr> = with_recip.into_iter().collect();
        let scale = Polynomial::monomial(factor);
        shared.push((side, paired(&primitive).mul(&scale)));
        let mut outer = vec![side];
        match common == sorted([ratio, recip]) {
            true => outer.push(decay),
            false => outer.extend(common),
        }
        shared.push((angular, Polynomial::monomial(outer)));
        primitive.mul(&scale)
    });
    Pair { at, recip, u, w, angular: [chi, theta], angular_forms, body: (body, body_form) }
}

fn sorted(mut atoms: [Expr; 2]) -> Vec<Expr> {
    atoms.sort_unstable();
    atoms.to_vec()
}

/// A force with its part of every pair divided by the angular velocities, where that goes without remainder.
fn force(rate: &Polynomial, pairs: &[Pair]) -> Polynomial {
    let mut sum = Polynomial::zero();
    for pair in pairs {
        let part: Polynomial = rate
            .terms()
            .filter(|(monomial, _)| monomial.contains(&pair.recip))
            .map(|(monomial, c)| Polynomial::term(monomial.clone(), c.clone()))
            .sum();
        let divided = quotient(&part, &pair.angular_forms[0]).and_then(|part| quotient(&part, &pair.body.1));
        match divided {
            Some(rest) => {
                let product = Polynomial::monomial([pair.angular[0], pair.body.0]);
                sum.add_product(&rest, &product, &Rational::ONE);
            }
            None => sum.add_scaled(&part, &Rational::ONE),
        }
    }
    sum
}

/// `U` and `W` through the brackets, with `dH/dM = (theta_hat + chi_hat)/2` and `dH/dN = (theta_hat - chi_hat)/2`.
fn turning(lattice: &Lattice, pairs: &[Pair], symbols: &Symbols) -> Vec<(Expr, Polynomial)> {
    let slope = |pair: &Pair, sign: &Rational| {
        let [chi, theta] = pair.angular.map(Polynomial::atom);
        theta.add(&chi.scaled(sign)).scaled(&Rational::HALF)
    };
    let rate = |z: Coordinate| {
        let mut sum = Polynomial::zero();
        for pair in pairs {
            let (c, d) = pair.at;
            for (y, sign) in
                [(Coordinate::M(c, d), Rational::ONE), (Coordinate::N(c, d), Rational::MINUS_ONE)]
            {
                let bracket = lattice.bracket(z, y).substitute(&|atom| symbols.coupling(lattice, atom));
                sum.add_product(&bracket, &slope(pair, &sign), &Rational::ONE);
            }
        }
        sum
    };
    let combined = |pair: &Pair, sign: &Rational| {
        let (a, b) = pair.at;
        rate(Coordinate::M(a, b)).add(&rate(Coordinate::N(a, b)).scaled(sign)).scaled(&Rational::HALF)
    };
    let sums = pairs.iter().map(|pair| (pair.u, combined(pair, &Rational::ONE)));
    let differences = pairs.iter().map(|pair| (pair.w, combined(pair, &Rational::MINUS_ONE)));
    sums.chain(differences).collect()
}
