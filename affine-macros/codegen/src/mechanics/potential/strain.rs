//! Strains and their invariants through `phi - 1`, a difference without rounding near the undeformed state.
//!
//! Entries beside the diagonal are small there as they are. On the diagonal, with `h = phi_aa - 1`,
//! `G_aa - 1 = h (1 + phi_aa) + ..`, `cof_aa - 1 = h_b phi_cc + h_c - ..` and `det - 1 = h_1 + (cof_11 - 1) phi_11 + ..`.

mod deviator;

use crate::algebra::ring::{Square, adjugate, pairs, table, upper};
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Momentum};
use crate::symbol::{Quantity, Symbol};

use super::Base;
use super::principal;
use super::undeformed::{Counted, Undeformed};
use super::volume::Volume;

/// Quantities of a chart, counted from the undeformed state.
pub(super) struct Strains {
    n: usize,
    phi: Square<Polynomial>,
    volume: Volume,
    /// `phi_aa - 1`
    excess: Vec<Expr>,
    /// `G_aa - 1`
    green: Vec<Expr>,
    /// `Ct_aa - 1`
    finger: Vec<Expr>,
    /// `cof_aa - phi_aa`
    asymmetry: Vec<Expr>,
    /// `cof_aa - 1`, and the cofactors.
    cofactor_excess: Vec<Expr>,
    cofactors: Square<Expr>,
    /// Does the chart read `Ct`, or `G`?
    spatial: bool,
    /// Are the cofactors wanted as such?
    canonical: bool,
}

impl Strains {
    pub(super) fn new(arena: &mut Arena, chart: &Chart, volume: Volume) -> Self {
        let n = chart.dim;
        let [excess, green, finger, asymmetry, cofactor_excess] = [
            Quantity::Excess,
            Quantity::AxialStrain,
            Quantity::SpatialAxialStrain,
            Quantity::CofactorDifference,
            Quantity::CofactorExcess,
        ]
        .map(|of| arena.components(of, n));
        let cofactors = Matrix::symbols(arena, Quantity::Cofactor, n).0;
        Self {
            n,
            phi: chart.placement(),
            volume,
            excess,
            green,
            finger,
            asymmetry,
            cofactor_excess,
            cofactors,
            spatial: matches!(chart.momentum, Momentum::Space | Momentum::Total),
            canonical: chart.momentum == Momentum::Canonical,
        }
    }

    /// What is known of all symbols, those first whose changes cost least.
    pub(super) fn known(&self, arena: &mut Arena) -> Undeformed {
        let atom = Polynomial::atom;
        let mut list = Vec::new();
        let mut tensor = |arena: &mut Arena, base: fn(usize, usize) -> Base, diagonal: &[Expr]| {
            for (a, b) in pairs(self.n) {
                let symbol = base(a, b).symbol(arena);
                list.push((
                    symbol,
                    if a == b {
                        Counted::from(1, atom(diagonal[a]))
                    } else {
                        Counted::vanishing(atom(symbol))
                    },
                ));
            }
        };
        tensor(arena, Base::Green, &self.green);
        tensor(arena, Base::Finger, &self.finger);
        tensor(arena, Base::Placement, &self.excess);
        for (a, row) in self.cofactors.iter().enumerate() {
            for (b, symbol) in row.iter().enumerate() {
                let change = if a == b { self.cofactor_excess[a] } else { *symbol };
                list.push((*symbol, Counted::from(i64::from(a == b), atom(change))));
            }
        }
        let [first, of_square, of_cube, minors] = invariants(arena);
        let n = Rational::whole(self.n);
        let traces = [(Base::Trace, first), (Base::TraceOfSquare, of_square), (Base::TraceOfCube, of_cube)];
        for (base, excess) in traces {
            list.push((base.symbol(arena), Counted::from(n.clone(), atom(excess))));
        }
        let nth = Rational::one_over(self.n);
        list.push((
            arena.symbol(Quantity::MeanSquareStretch),
            Counted::from(1, Polynomial::term(vec![first], nth)),
        ));
        for small in self.deviator(arena).concat().iter().flat_map(Polynomial::atoms) {
            list.push((*small, Counted::vanishing(atom(*small))));
        }
        let squared = arena.symbol(Quantity::DeviatorSquared);
        list.push((squared, Counted::vanishing(atom(squared))));
        let mut second = atom(minors);
        second.add_term(vec![first], &Rational::whole(self.n - 1));
        let minors = Rational::whole(self.n * (self.n - 1) / 2);
        list.push((arena.symbol(Quantity::SecondInvariant), Counted::from(minors, second)));
        for k in 0..self.n {
            let q = Base::LogStretch(k).symbol(arena);
            list.push((q, Counted::vanishing(atom(q))));
            let growth = arena.apply(Function::ExpM1, q);
            let inverse = principal::inverse_stretch(arena, k);
            let decay = Polynomial::term(vec![growth, inverse], Rational::MINUS_ONE);
            list.push((principal::stretch(arena, k), Counted::from(1, atom(growth))));
            list.push((inverse, Counted::from(1, decay)));
        }
        let q = Base::MeanLogStretch.symbol(arena);
        list.push((q, Counted::vanishing(atom(q))));
        let Volume { det, inverse_det, d, inverse_d, .. } = self.volume;
        let [excess_det, excess_d] = arena.symbols([Quantity::ExcessDeterminant, Quantity::ExcessDilatation]);
        let minus = Rational::MINUS_ONE;
        list.push((det, Counted::from(1, atom(excess_det))));
        list.push((
            inverse_det,
            Counted::from(1, Polynomial::term(vec![excess_det, inverse_det], minus.clone())),
        ));
        let last = vec![
            (d, Counted::from(1, atom(excess_d))),
            (inverse_d, Counted::from(1, Polynomial::term(vec![excess_d, inverse_d], minus))),
        ];
        Undeformed::new(list, last)
    }

    /// Definitions of these symbols, and of others through them; what is not used goes later.
    pub(super) fn definitions(&self, arena: &mut Arena) -> Vec<(Expr, Polynomial)> {
        let mut list = Vec::new();
        for (a, excess) in self.excess.iter().enumerate() {
            list.push((*excess, plus(self.phi[a][a].clone(), -1)));
        }
        self.tensors(arena, &mut list);
        self.deviators(arena, &mut list);
        self.invariants(arena, &mut list);
        self.volumes(arena, &mut list);
        list
    }

    /// The entries on the diagonals of `G` and `Ct`.
    fn tensors(&self, arena: &mut Arena, list: &mut Vec<(Expr, Polynomial)>) {
        for a in 0..self.n {
            let own = &self.phi[a][a];
            let mut strain = Polynomial::atom(self.excess[a]).mul(own);
            strain.add_term(vec![self.excess[a]], &Rational::ONE);
            let whole = own.mul(own);
            let squares = |entry: &dyn Fn(usize) -> Polynomial| {
                (0..self.n).filter(|i| *i != a).map(|i| entry(i).mul(&entry(i))).sum()
            };
            let column = (self.green[a], Base::Green(a, a), squares(&|i| self.phi[i][a].clone()));
            let row = (self.finger[a], Base::Finger(a, a), squares(&|i| self.phi[a][i].clone()));
            for (symbol, base, beside) in [column, row] {
                let shared = arena.symbol(beside_diagonal(base));
                list.push((shared, beside));
                let with = |of: &Polynomial| {
                    let mut sum = of.clone();
                    sum.add_term(vec![shared], &Rational::ONE);
                    sum
                };
                list.push((symbol, with(&strain)));
                list.push((base.symbol(arena), with(&whole)));
            }
        }
    }

    /// Traces, of `G` or of `Ct`.
    fn invariants(&self, arena: &mut Arena, list: &mut Vec<(Expr, Polynomial)>) {
        let [first, of_square, of_cube, minors] = invariants(arena);
        let (mut sum, mut squares, mut products) =
            (Polynomial::zero(), Polynomial::zero(), Polynomial::zero());
        let strain = if self.spatial { &self.finger } else { &self.green };
        for a in 0..self.n {
            sum.add_term(vec![strain[a]], &Rational::ONE);
            let whole = if self.spatial { Base::Finger(a, a) } else { Base::Green(a, a) }.symbol(arena);
            squares.add_term(vec![strain[a], whole], &Rational::ONE);
            squares.add_term(vec![strain[a]], &Rational::ONE);
            for b in a + 1..self.n {
                let beside = if self.spatial { Base::Finger(a, b) } else { Base::Green(a, b) }.symbol(arena);
                squares.add_term(vec![beside, beside], &Rational::from(2));
                products.add_term(vec![strain[a], strain[b]], &Rational::ONE);
                products.add_term(vec![beside, beside], &Rational::MINUS_ONE);
            }
        }
        list.push((first, sum));
        list.push((of_square, squares));
        list.push((minors, products));
        // tr G^3 - n = 3 (tr G^2 - n) - 3 (tr G - n) + tr M^3
        let mut cubes = Polynomial::term(vec![of_square], Rational::from(3));
        cubes.add_term(vec![first], &Rational::from(-3));
        for (a, b) in pairs(self.n) {
            cubes.add_product(&self.strain(arena, a, b), &self.square(arena, a, b), &Rational::ONE);
        }
        list.push((of_cube, cubes));
        for (a, b) in upper(self.n) {
            list.push((square(arena, a, b), self.times_strain(arena, a, b, Self::strain)));
        }
    }

    /// Cofactors, determinant, its logarithm and root.
    fn volumes(&self, arena: &mut Arena, list: &mut Vec<(Expr, Polynomial)>) {
        for a in 0..self.n {
            list.push((self.asymmetry[a], self.cofactor_difference(arena, a)));
            list.push((self.cofactor_excess[a], self.cofactor_excess(a)));
        }
        let [excess, excess_d, beside] = arena.symbols([
            Quantity::ExcessDeterminant,
            Quantity::ExcessDilatation,
            Quantity::BesideDeterminant,
        ]);
        let adjugate = adjugate(&self.phi);
        let cofactor = |b: usize| match self.canonical {
            true => Polynomial::atom(self.cofactors[0][b]),
            false => adjugate[b][0].clone(),
        };
        let others: Polynomial = (1..self.n).map(|b| self.phi[0][b].mul(&cofactor(b))).sum();
        list.push((beside, others));
        let mut change = Polynomial::atom(self.excess[0]);
        change.add_product(&Polynomial::atom(self.cofactor_excess[0]), &self.phi[0][0], &Rational::ONE);
        change.add_term(vec![beside], &Rational::ONE);
        list.push((excess, change));
        let Volume { det, inverse_det, d, .. } = self.volume;
        let mut whole = self.phi[0][0].mul(&cofactor(0));
        whole.add_term(vec![beside], &Rational::ONE);
        list.push((det, whole));
        let one = arena.constant(Rational::ONE);
        let mut powers = vec![(one, Rational::ONE), (d, Rational::ONE)];
        if self.n == 3 {
            powers.push((arena.power(d, 2), Rational::ONE));
        }
        let below = arena.linear(&powers);
        // A sum of powers of D and one.
        let reciprocal = arena.reciprocal(below);
        list.push((excess_d, Polynomial::monomial([excess, reciprocal])));
        // ln det = arsinh((det - 1/det)/2) = arsinh(((det - 1) + (det - 1)/det)/2)
        let half = Rational::HALF;
        let mut argument = Polynomial::term(vec![excess], half.clone());
        argument.add_term(vec![excess, inverse_det], &half);
        let argument = argument.expression(arena);
        let nth = Rational::one_over(self.n);
        let logarithm = arena.apply(Function::Asinh, argument);
        list.push((Base::MeanLogStretch.symbol(arena), Polynomial::term(vec![logarithm], nth)));
    }

    /// `cof_aa - 1 = h_b phi_cc + h_c - ..`, in the plane `h_c`.
    fn cofactor_excess(&self, a: usize) -> Polynomial {
        let c = if a == 0 { 1 } else { a - 1 };
        let mut change = Polynomial::atom(self.excess[c]);
        for b in (0..self.n).filter(|b| *b != a && *b != c) {
            change.add_product(&Polynomial::atom(self.excess[b]), &self.phi[c][c], &Rational::ONE);
            change.add_product(&self.phi[b][c], &self.phi[c][b], &Rational::MINUS_ONE);
        }
        change
    }

    /// `cof_aa - phi_aa = h_b phi_cc + (phi_cc - phi_aa) - ..`, in the plane `phi_cc - phi_aa`; the difference in brackets has
    /// no rounding near the undeformed state.
    fn cofactor_difference(&self, arena: &mut Arena, a: usize) -> Polynomial {
        let c = if a == 0 { 1 } else { a - 1 };
        let (difference, sign) = difference(arena, c, a);
        let mut change = Polynomial::term(vec![difference], sign);
        for b in (0..self.n).filter(|b| *b != a && *b != c) {
            change.add_product(&Polynomial::atom(self.excess[b]), &self.phi[c][c], &Rational::ONE);
            change.add_product(&self.phi[b][c], &self.phi[c][b], &Rational::MINUS_ONE);
        }
        change
    }

    /// `G - 1`, or `Ct - 1` where the chart reads that.
    pub(super) fn strain(&self, arena: &mut Arena, a: usize, b: usize) -> Polynomial {
        let (diagonal, base): (_, fn(usize, usize) -> Base) =
            if self.spatial { (&self.finger, Base::Finger) } else { (&self.green, Base::Green) };
        Polynomial::atom(if a == b { diagonal[a] } else { base(a, b).symbol(arena) })
    }

    /// The square of that, as symbols.
    pub(super) fn square(&self, arena: &mut Arena, a: usize, b: usize) -> Polynomial {
        Polynomial::atom(square(arena, a, b))
    }

    /// Its cube.
    pub(super) fn cube(&self, arena: &mut Arena, a: usize, b: usize) -> Polynomial {
        self.times_strain(arena, a, b, Self::square)
    }

    /// An entry of the strain times a matrix.
    fn times_strain(
        &self,
        arena: &mut Arena,
        a: usize,
        b: usize,
        entry: fn(&Self, &mut Arena, usize, usize) -> Polynomial,
    ) -> Polynomial {
        let mut sum = Polynomial::zero();
        for c in 0..self.n {
            let (left, right) = (self.strain(arena, a, c), entry(self, arena, c, b));
            sum.add_product(&left, &right, &Rational::ONE);
        }
        sum
    }

    /// `G^-1 (G - 1)`, or `Ct^-1 (Ct - 1)` where the chart reads that, as symbols with their definitions.
    pub(super) fn times_inverse(&self, arena: &mut Arena) -> (Square<Polynomial>, Vec<(Expr, Polynomial)>) {
        let n = self.n;
        let base: fn(usize, usize) -> Base = if self.spatial { Base::Finger } else { Base::Green };
        let mut symbols = |of: Quantity| -> Square<Expr> {
            let entry = |a: usize, b: usize| arena.symbol(of.at([a.min(b) + 1, a.max(b) + 1]));
            table(n, entry)
        };
        let (inverses, products) = (symbols(Quantity::InverseTensor), symbols(Quantity::InverseStrain));
        let entry = |a: usize, b: usize| Polynomial::atom(base(a, b).symbol(arena));
        let tensor: Square<Polynomial> = table(n, entry);
        let adjugate = adjugate(&tensor);
        let over = arena.symbol(Quantity::InverseDeterminantSquared);
        let mut list = vec![(over, Polynomial::term(vec![self.volume.inverse_det; 2], Rational::ONE))];
        for (a, b) in upper(n) {
            list.push((inverses[a][b], adjugate[a][b].mul(&Polynomial::atom(over))));
        }
        for (a, b) in upper(n) {
            let product: Polynomial =
                (0..n).map(|k| Polynomial::atom(inverses[a][k]).mul(&self.strain(arena, k, b))).sum();
            list.push((products[a][b], product));
        }
        let products =
            products.iter().map(|row| row.iter().copied().map(Polynomial::atom).collect()).collect();
        (products, list)
    }

    /// `cof_aa - phi_aa`.
    pub(super) fn asymmetry(&self, a: usize) -> Polynomial {
        Polynomial::atom(self.asymmetry[a])
    }
}

/// The symbols of `tr G - n`, `tr G^2 - n`, `tr G^3 - n` and of the sum of the minors of `G - 1`.
fn invariants(arena: &mut Arena) -> [Expr; 4] {
    let [first, of_square, of_cube] = [1, 2, 3].map(|power| arena.symbol(Quantity::Strain.at([power])));
    [first, of_square, of_cube, arena.symbol(Quantity::StrainMinors)]
}

/// The symbol of an entry of the square of the strain.
fn square(arena: &mut Arena, a: usize, b: usize) -> Expr {
    arena.symbol(Quantity::StrainSquare.at([a.min(b) + 1, a.max(b) + 1]))
}

/// The symbol of the difference of two neighbours on the diagonal of `phi`, and its sign.
fn difference(arena: &mut Arena, a: usize, b: usize) -> (Expr, Rational) {
    let symbol = arena.symbol(Quantity::PlacementDifference.at([a.min(b) + 1, a.max(b) + 1]));
    (symbol, if a < b { Rational::ONE } else { Rational::MINUS_ONE })
}

/// The symbol of the part of a diagonal entry that has no diagonal entry of `phi`.
fn beside_diagonal(base: Base) -> Symbol {
    base.quantity().of(if matches!(base, Base::Finger(..)) {
        Quantity::BesideFinger
    } else {
        Quantity::BesideGreen
    })
}

fn plus(mut of: Polynomial, number: i64) -> Polynomial {
    of.add_term(Vec::new(), &Rational::from(number));
    of
}
