//! What the affine momentum of a chart generates on the placement: the derivations `E_ab f = {f, M_ab}`.
//!
//! On `phi` they stand in the bracket table. From `psi phi = 1` and `G = phi^T phi` follow `E psi = -psi (E phi) psi` and
//! `E G = (E phi)^T phi + phi^T E phi`: for `Sigma_hat`, `E_AB psi_Cj = -d_CB psi_Aj` and
//! `E_AB G_CD = d_CA G_BD + d_DA G_CB`.

use crate::algebra::ring::{Square, dot, pairs, product, table, transpose};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::mechanics::brackets::bracket;
use crate::mechanics::charts::{Chart, Coordinate};
use crate::mechanics::potential::Base;
use crate::symbol::Quantity;

/// The derivations of a chart.
pub(super) struct Action {
    dim: usize,
    /// Entries of `phi`, `psi` and `G`.
    quantities: Vec<Expr>,
    /// What each derivation makes of them, entry `[n a + b][quantity]`.
    images: Vec<Vec<Polynomial>>,
}

impl Action {
    pub(super) fn new(arena: &mut Arena, chart: &Chart) -> Self {
        let n = chart.dim;
        let phi = chart.placement();
        let quantities = of_the_placement(arena, n);
        let (inverse, green) = quantities.split_at(n * n);
        let psi = table(n, |a, i| Polynomial::atom(inverse[n * a + i]));
        let unit = |a: usize, b: usize| Polynomial::constant(Rational::from(i64::from(a == b)));
        let places: Vec<(usize, usize)> = pairs(n).collect();
        let known = |value: &dyn Fn(usize, usize) -> Polynomial, sums: &Square<Polynomial>| -> Vec<_> {
            places.iter().map(|(a, b)| (value(*a, *b), sums[*a][*b].clone())).collect()
        };
        let units = [known(&unit, &product(&psi, &phi)), known(&unit, &product(&phi, &psi))].concat();
        let strains = known(&|a, b| Polynomial::atom(green[n * a + b]), &product(&transpose(&phi), &phi));
        let mut images = Vec::new();
        for (a, b) in &places {
            let moved = table(n, |k, c| bracket(chart, Coordinate::Phi(k, c), Coordinate::M(*a, *b)));
            let of_inverse = product(&product(&psi, &moved), &psi);
            let of_green = product(&transpose(&moved), &phi);
            let mut image = moved.concat();
            image.extend(of_inverse.concat().iter().map(|p| p.by_names(&units).neg()));
            let both = |(c, d): &(usize, usize)| of_green[*c][*d].add(&of_green[*d][*c]).by_names(&strains);
            image.extend(places.iter().map(both));
            images.push(image);
        }
        Self { dim: n, quantities: [chart.phi.0.concat(), quantities].concat(), images }
    }

    /// `E_ab f` of a polynomial in such quantities and others, which are held.
    pub(super) fn derivative(&self, f: &Polynomial, a: usize, b: usize) -> Polynomial {
        dot(f.gradient(&self.quantities).iter().zip(&self.images[self.dim * a + b]))
    }
}

/// The entries of `psi = phi^-1` and of `G`.
pub(super) fn of_the_placement(arena: &mut Arena, n: usize) -> Vec<Expr> {
    let mut list = Matrix::symbols(arena, Quantity::InversePlacement, n).0.concat();
    list.extend(pairs(n).map(|(a, b)| Base::Green(a, b).symbol(arena)));
    list
}
