//! Strains and their invariants through `phi - 1`, a difference without rounding near the undeformed state.
//!
//! Entries beside the diagonal are small there as they are. On the diagonal, with `h = phi_aa - 1`,
//! `G_aa - 1 = h (1 + phi_aa) + ..`, `cof_aa - 1 = h_b phi_cc + h_c - ..` and `det - 1 = h_1 + (cof_11 - 1) phi_11 + ..`.

mod deviator;

use crate::algebra::rational::exponent;
use crate::algebra::ring::{Square, above_diagonal, adjugate, dot, pairs, product, table, transpose, upper};
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::mechanics::charts::Chart;
use crate::mechanics::metric::Definitions;
use crate::symbol::{Quantity, Symbol};

use super::base::{Base, log_stretches};
use super::excess::over_powers;
use super::principal;
use super::tensors::{TENSORS, minors, own, symbols};
use super::undeformed::{Counted, Undeformed};
use super::volume::{Volume, first_cofactors};

/// Quantities of a chart, counted from the undeformed state.
pub(super) struct Strains {
    n: usize,
    phi: Square<Polynomial>,
    volume: Volume,
    /// `phi_aa - 1`
    excess: Vec<Expr>,
    /// `G_aa - 1` and `Ct_aa - 1`
    axial: [Vec<Expr>; 2],
    /// `cof_aa - phi_aa`
    pub(super) asymmetry: Vec<Expr>,
    /// `cof_aa - 1`, and the cofactors.
    cofactor_excess: Vec<Expr>,
    cofactors: Square<Expr>,
    /// Those of the first row, as the chart has them.
    first_cofactors: Vec<Polynomial>,
    /// Which of `G` and `Ct` does the chart read?
    own: usize,
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
        Self {
            n,
            phi: chart.placement(),
            volume,
            excess,
            axial: [green, finger],
            asymmetry,
            cofactor_excess,
            cofactors: Matrix::symbols(arena, Quantity::Cofactor, n).0,
            first_cofactors: first_cofactors(arena, chart),
            own: own(chart),
        }
    }

    /// What is known of all symbols, those first whose changes cost least.
    pub(super) fn known(&self, arena: &mut Arena) -> Undeformed {
        let atom = Polynomial::atom;
        let mut list = Vec::new();
        let mut know = |symbol, at_rest: i64, change| list.push((symbol, Counted::from(at_rest, change)));
        let [green, finger, placement] = [Base::Green, Base::Finger, Base::Placement].map(
            |base: fn(usize, usize) -> Base| -> Square<Expr> {
                table(self.n, |a, b| base(a, b).symbol(arena))
            },
        );
        let [green_strain, finger_strain] = &self.axial;
        for (matrix, on_diagonal) in [
            (&green, green_strain),
            (&finger, finger_strain),
            (&placement, &self.excess),
            (&self.cofactors, &self.cofactor_excess),
        ] {
            for (a, b) in pairs(self.n) {
                let change = if a == b { on_diagonal[a] } else { matrix[a][b] };
                know(matrix[a][b], i64::from(a == b), atom(change));
            }
        }
        let n = i64::from(exponent(self.n));
        let [first, of_square, of_cube, minors] = invariants(arena);
        for (base, excess) in Base::TRACES.into_iter().zip([first, of_square, of_cube]) {
            know(base.symbol(arena), n, atom(excess));
        }
        let mean = Polynomial::term(vec![first], Rational::one_over(self.n));
        know(arena.symbol(Quantity::MeanSquareStretch), 1, mean);
        let mut small = self.deviator(arena).0.concat();
        small.push(arena.symbol(Quantity::DeviatorSquared));
        small.into_iter().for_each(|small| know(small, 0, atom(small)));
        let mut second = atom(minors);
        second.add_term(vec![first], &Rational::whole(self.n - 1));
        know(arena.symbol(Quantity::SecondInvariant), n * (n - 1) / 2, second);
        for (k, q) in log_stretches(arena, self.n).into_iter().enumerate() {
            know(q, 0, atom(q));
            let growth = arena.apply(Function::ExpM1, q);
            let inverse = principal::inverse_stretch(arena, k);
            know(principal::stretch(arena, k), 1, atom(growth));
            know(inverse, 1, Polynomial::monomial([growth, inverse]).neg());
        }
        let q = Base::MeanLogStretch.symbol(arena);
        know(q, 0, atom(q));
        let Volume { det, inverse_det, d, inverse_d, .. } = self.volume;
        let [excess_det, excess_d] = arena.symbols([Quantity::ExcessDeterminant, Quantity::ExcessDilatation]);
        know(det, 1, atom(excess_det));
        know(inverse_det, 1, Polynomial::monomial([excess_det, inverse_det]).neg());
        let last = vec![
            (d, Counted::from(1, atom(excess_d))),
            (inverse_d, Counted::from(1, Polynomial::monomial([excess_d, inverse_d]).neg())),
        ];
        Undeformed::new(list, last)
    }

    /// Definitions of these symbols, and of others through them; what is not used goes later.
    pub(super) fn definitions(&self, arena: &mut Arena) -> Definitions {
        let mut list = Vec::new();
        let one = Polynomial::constant(Rational::ONE);
        for (a, excess) in self.excess.iter().enumerate() {
            list.push((*excess, self.phi[a][a].sub(&one)));
        }
        self.tensors(arena, &mut list);
        self.deviators(arena, &mut list);
        self.invariants(arena, &mut list);
        self.volumes(arena, &mut list);
        list
    }

    /// The entries on the diagonals of `G` and `Ct`.
    fn tensors(&self, arena: &mut Arena, list: &mut Definitions) {
        let transposed = transpose(&self.phi);
        for a in 0..self.n {
            let (own, excess) = (&self.phi[a][a], Polynomial::atom(self.excess[a]));
            let (strain, whole) = (excess.mul(own).add(&excess), own.mul(own));
            for (k, line) in [&transposed[a], &self.phi[a]].into_iter().enumerate() {
                let base = TENSORS[k](a, a);
                let others = line.iter().enumerate().filter(|(i, _)| *i != a);
                let beside = arena.symbol(beside_diagonal(base));
                list.push((beside, dot(others.map(|(_, entry)| (entry, entry)))));
                let beside = Polynomial::atom(beside);
                list.push((self.axial[k][a], strain.add(&beside)));
                list.push((base.symbol(arena), whole.add(&beside)));
            }
        }
    }

    /// Traces, of `G` or of `Ct`.
    fn invariants(&self, arena: &mut Arena, list: &mut Definitions) {
        let [first, of_square, of_cube, of_minors] = invariants(arena);
        let strain = self.strain(arena);
        let mut squares = Polynomial::zero();
        for (a, row) in strain.iter().enumerate() {
            let whole = Polynomial::atom(TENSORS[self.own](a, a).symbol(arena));
            squares.add_product(&row[a], &whole, &Rational::ONE);
            squares.add_scaled(&row[a], &Rational::ONE);
        }
        for (a, b) in above_diagonal(self.n) {
            squares.add_product(&strain[a][b], &strain[a][b], &Rational::from(2));
        }
        list.push((first, (0..self.n).map(|a| &strain[a][a]).sum()));
        list.push((of_square, squares));
        list.push((of_minors, minors(&strain)));
        // tr G^3 - n = 3 (tr G^2 - n) - 3 (tr G - n) + tr M^3
        let mut cubes = Polynomial::term(vec![of_square], Rational::from(3));
        cubes.add_term(vec![first], &Rational::from(-3));
        let square = self.square(arena);
        cubes = cubes.add(&dot(strain.iter().flatten().zip(square.atoms().iter().flatten())));
        list.push((of_cube, cubes));
        let value = product(&strain, &strain);
        list.extend(upper(self.n).map(|(a, b)| (square.0[a][b], value[a][b].clone())));
    }

    /// Cofactors, determinant, its logarithm and root.
    fn volumes(&self, arena: &mut Arena, list: &mut Definitions) {
        for a in 0..self.n {
            let c = neighbour(a);
            let (difference, sign) = difference(arena, c, a);
            let asymmetry = self.cofactor_change(a, Polynomial::term(vec![difference], sign));
            list.push((self.asymmetry[a], asymmetry));
            let excess = self.cofactor_change(a, Polynomial::atom(self.excess[c]));
            list.push((self.cofactor_excess[a], excess));
        }
        let [excess, excess_d, beside] = arena.symbols([
            Quantity::ExcessDeterminant,
            Quantity::ExcessDilatation,
            Quantity::BesideDeterminant,
        ]);
        let row = &self.phi[0];
        list.push((beside, dot(row.iter().zip(&self.first_cofactors).skip(1))));
        let mut change = Polynomial::atom(self.excess[0]);
        change.add_product(&Polynomial::atom(self.cofactor_excess[0]), &row[0], &Rational::ONE);
        list.push((excess, change.add(&Polynomial::atom(beside))));
        let Volume { det, inverse_det, d, .. } = self.volume;
        list.push((det, row[0].mul(&self.first_cofactors[0]).add(&Polynomial::atom(beside))));
        let over = over_powers(arena, d, self.n);
        list.push((excess_d, Polynomial::monomial([excess, over])));
        // ln det = arsinh((det - 1/det)/2) = arsinh(((det - 1) + (det - 1)/det)/2)
        let argument = Polynomial::atom(excess).add(&Polynomial::monomial([excess, inverse_det]));
        let argument = argument.scaled(&Rational::HALF).expression(arena);
        let nth = Rational::one_over(self.n);
        let logarithm = arena.apply(Function::Asinh, argument);
        list.push((Base::MeanLogStretch.symbol(arena), Polynomial::term(vec![logarithm], nth)));
    }

    /// A change of `cof_aa`: `cof_aa - 1 = h_b phi_cc + h_c - ..`, in the plane `h_c`, and
    /// `cof_aa - phi_aa = h_b phi_cc + (phi_cc - phi_aa) - ..`, in the plane `phi_cc - phi_aa`, by that of `phi_cc`, the
    /// neighbour on the diagonal; the difference in brackets has no rounding near the undeformed state.
    fn cofactor_change(&self, a: usize, mut change: Polynomial) -> Polynomial {
        let c = neighbour(a);
        for b in (0..self.n).filter(|b| *b != a && *b != c) {
            change.add_product(&Polynomial::atom(self.excess[b]), &self.phi[c][c], &Rational::ONE);
            change.add_product(&self.phi[b][c], &self.phi[c][b], &Rational::MINUS_ONE);
        }
        change
    }

    /// `G - 1`, or `Ct - 1` where the chart reads that.
    pub(super) fn strain(&self, arena: &mut Arena) -> Square<Polynomial> {
        let mut strain = symbols(arena, self.n, TENSORS[self.own], false);
        for (a, axial) in self.axial[self.own].iter().enumerate() {
            strain[a][a] = Polynomial::atom(*axial);
        }
        strain
    }

    /// The square of the strain, as symbols.
    pub(super) fn square(&self, arena: &mut Arena) -> Matrix {
        Matrix::symmetric(arena, Quantity::StrainSquare, self.n)
    }

    /// `G^-1 (G - 1)`, or `Ct^-1 (Ct - 1)` where the chart reads that, as symbols with their definitions.
    pub(super) fn times_inverse(&self, arena: &mut Arena) -> (Square<Polynomial>, Definitions) {
        let n = self.n;
        let [inverses, products] =
            [Quantity::InverseTensor, Quantity::InverseStrain].map(|of| Matrix::symmetric(arena, of, n));
        let adjugate = adjugate(&symbols(arena, n, TENSORS[self.own], false));
        let over = arena.symbol(Quantity::InverseDeterminantSquared);
        let mut list = vec![(over, Polynomial::monomial([self.volume.inverse_det; 2]))];
        let over = Polynomial::atom(over);
        list.extend(upper(n).map(|(a, b)| (inverses.0[a][b], adjugate[a][b].mul(&over))));
        let values = product(&inverses.atoms(), &self.strain(arena));
        list.extend(upper(n).map(|(a, b)| (products.0[a][b], values[a][b].clone())));
        (products.atoms(), list)
    }
}

/// The symbols of `tr G - n`, `tr G^2 - n`, `tr G^3 - n` and of the sum of the minors of `G - 1`.
fn invariants(arena: &mut Arena) -> [Expr; 4] {
    let [first, of_square, of_cube] = [1, 2, 3].map(|power| arena.symbol(Quantity::Strain.at([power])));
    [first, of_square, of_cube, arena.symbol(Quantity::StrainMinors)]
}

/// The entry before one on the diagonal; after the first one, which has none before it.
fn neighbour(a: usize) -> usize {
    if a == 0 { 1 } else { a - 1 }
}

/// The symbol of the difference of two neighbours on the diagonal of `phi`, and its sign.
fn difference(arena: &mut Arena, a: usize, b: usize) -> (Expr, Rational) {
    let symbol = arena.symbol(Quantity::PlacementDifference.at([a.min(b) + 1, a.max(b) + 1]));
    (symbol, if a < b { Rational::ONE } else { Rational::MINUS_ONE })
}

/// The symbol of the part of a diagonal entry that has no diagonal entry of `phi`.
fn beside_diagonal(base: Base) -> Symbol {
    let is_spatial = matches!(base, Base::Finger(..));
    base.quantity().of(if is_spatial { Quantity::BesideFinger } else { Quantity::BesideGreen })
}
