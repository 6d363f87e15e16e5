//! The momenta that are linear in `p` and `Pi`: the generators of translations and of the left and right action.

use crate::algebra::Rational;
use crate::algebra::evaluate::Field;
use crate::algebra::residue::Residue;
use crate::algebra::ring::{Ring, Square, outer, product, table, times, transpose};

use super::candidate::Candidate;

/// All of them at a point modulo a prime, or their rates there: `p`, `p_hat` and `x p^T` of a body that moves, and `Sigma`,
/// `Sigma_hat`, `Pi`.
///
/// [Given](Momenta::given) in the user's bases, what the entries of angular momenta and vorticity are read off stands after them:
/// `g Sigma`, `Sigma_hat eta^-1` and `g x p^T`, whose differences across the diagonal are skew.
#[derive(Clone, Debug)]
pub(in crate::mechanics) struct Momenta {
    layout: Layout,
    list: Vec<Residue>,
}

/// Where each of them stands in the list.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub(super) dim: usize,
    /// Does the centre move?
    pub(super) moves: bool,
    /// Do they stand in the user's bases?
    pub(super) is_given: bool,
}

/// `A` of space and `B` of the body modulo a prime, `x' = A x`, `phi' = A phi B^-1` in orthonormal bases, each before its inverse.
pub(super) type Factors = [[Square<Residue>; 2]; 2];

/// A sum of whole multiples of places of the list.
pub(super) type Combination = Vec<(i64, usize)>;

/// Row and column of an entry, from 1; the column of a vector is 1.
pub(super) type Place = (usize, usize);

impl Momenta {
    /// `p`, `p_hat` and `x p^T` of a body that moves, and `Sigma`, `Sigma_hat`, `Pi`.
    pub(in crate::mechanics) fn new(
        centre: Option<(&[Residue], &[Residue], &Square<Residue>)>,
        internal: [&Square<Residue>; 3],
    ) -> Self {
        let layout = Layout { dim: internal[0].len(), moves: centre.is_some(), is_given: false };
        let centre = centre.map(|(p, p_hat, orbital)| [p, p_hat, &orbital.concat()].concat());
        let mut list = centre.unwrap_or_default();
        list.extend(internal.into_iter().flatten().flatten());
        Self { layout, list }
    }

    /// The rates by forces on `p` and `Pi` at a place.
    pub(in crate::mechanics) fn by_forces(
        (x, phi): (&[Residue], &Square<Residue>),
        on_p: &[Residue],
        on_pi: &Square<Residue>,
    ) -> Self {
        let on_p_hat = times(&transpose(phi), on_p);
        let centre = (on_p, on_p_hat.as_slice(), &outer(x, on_p));
        Self::new(Some(centre), [&product(phi, on_pi), &product(on_pi, phi), on_pi])
    }

    /// Those of which the one at `place` is 1 and the others are 0.
    pub(super) fn unit(layout: Layout, place: usize) -> Self {
        let one = Residue::from_rational(&Rational::ONE);
        let list = (0..layout.len()).map(|other| if other == place { one } else { Residue::ZERO });
        Self { layout: Layout { is_given: false, ..layout }, list: list.collect() }
    }

    /// The same in the user's bases.
    pub(super) fn given(&self, [[a, a_inverse], [b, b_inverse]]: &Factors) -> Self {
        let (n, sigma) = (self.layout.dim, self.layout.internal());
        let (orbital, sigma_hat, pi) = (2 * n, sigma + n * n, sigma + 2 * n * n);
        let changed = |left: &Square<Residue>, start: usize, right: &Square<Residue>| {
            let own = table(n, |i, j| self.list[start + n * i + j]);
            product(&product(left, &own), right).concat()
        };
        let covector = |factor, start: usize| times(&transpose(factor), &self.list[start..start + n]);
        let lowered = |start| changed(&transpose(a), start, a);
        let mut list = Vec::new();
        if self.layout.moves {
            list = [covector(a, 0), covector(b, n), changed(a_inverse, orbital, a)].concat();
        }
        list.extend([changed(a_inverse, sigma, a), changed(b_inverse, sigma_hat, b)].concat());
        list.extend([changed(b_inverse, pi, a), lowered(sigma)].concat());
        list.extend(changed(b_inverse, sigma_hat, &transpose(b_inverse)));
        if self.layout.moves {
            list.extend(lowered(orbital));
        }
        Self { layout: Layout { is_given: true, ..self.layout }, list }
    }

    /// Those of a body whose centre does not move.
    pub(in crate::mechanics) fn internal(mut self) -> Self {
        self.list.drain(..self.layout.internal());
        self.layout.moves = false;
        self
    }

    /// Do those vanish that the candidate consists of?
    pub(in crate::mechanics) fn keep(&self, candidate: Candidate) -> bool {
        self.entries(candidate.generator()).iter().all(Ring::vanishes)
    }

    /// The entries of a candidate, up to whole factors; none where it is no such momentum.
    pub(in crate::mechanics) fn entries(&self, candidate: Candidate) -> Vec<Residue> {
        self.layout.entries(candidate).iter().map(|(_, entry)| self.value(entry)).collect()
    }

    /// The value of a combination.
    pub(super) fn value(&self, combination: &Combination) -> Residue {
        let mut sum = Residue::ZERO;
        combination.iter().for_each(|(factor, place)| sum.plus(&self.list[*place], &Rational::from(*factor)));
        sum
    }

    /// All of them.
    pub(super) fn list(&self) -> &[Residue] {
        &self.list
    }
}

impl Layout {
    /// Where those of the internal motion begin.
    fn internal(self) -> usize {
        if self.moves { self.dim * (self.dim + 2) } else { 0 }
    }

    /// How many there are in orthonormal bases.
    pub(super) fn len(self) -> usize {
        self.internal() + 3 * self.dim * self.dim
    }

    /// The entries of a candidate, row by row, of skew matrices those above the diagonal, up to whole factors; none of what is no
    /// such momentum.
    pub(super) fn entries(self, candidate: Candidate) -> Vec<(Place, Combination)> {
        let n = self.dim;
        if !candidate.exists(n, self.moves) {
            return Vec::new();
        }
        let (orbital, sigma) = (2 * n, self.internal());
        let (sigma_hat, pi) = (sigma + n * n, sigma + 2 * n * n);
        let [spin, vorticity, angular] = match self.is_given {
            true => [0, 1, 2].map(|k| self.len() + k * n * n),
            false => [sigma, sigma_hat, orbital],
        };
        match candidate {
            Candidate::LinearMomentum => self.vector(0),
            Candidate::ComovingLinearMomentum => self.vector(n),
            Candidate::OrbitalAngularMomentum => self.skew(&[angular]),
            Candidate::TotalAffineMomentum => self.matrix(&[orbital, sigma]),
            Candidate::TotalAngularMomentum => self.skew(&[angular, spin]),
            Candidate::AffineSpin => self.matrix(&[sigma]),
            Candidate::Deviator => self.deviator(sigma),
            Candidate::Spin => self.skew(&[spin]),
            Candidate::ComovingAffineSpin => self.matrix(&[sigma_hat]),
            Candidate::ComovingDeviator => self.deviator(sigma_hat),
            Candidate::Vorticity => self.skew(&[vorticity]),
            Candidate::CanonicalMomentum => self.matrix(&[pi]),
            Candidate::Casimir1 => vec![((1, 1), self.trace(sigma))],
            Candidate::Energy
            | Candidate::SpinNorm
            | Candidate::VorticityNorm
            | Candidate::Casimir2
            | Candidate::Casimir3
            | Candidate::DeviatorCasimir2
            | Candidate::DeviatorCasimir3 => Vec::new(),
        }
    }

    /// `tr Sigma - tr Sigma_hat`, which is zero.
    pub(super) fn equal_traces(self) -> Combination {
        let sigma = self.internal();
        let other =
            self.trace(sigma + self.dim * self.dim).into_iter().map(|(factor, place)| (-factor, place));
        self.trace(sigma).into_iter().chain(other).collect()
    }

    fn vector(self, start: usize) -> Vec<(Place, Combination)> {
        (0..self.dim).map(|i| ((i + 1, 1), vec![(1, start + i)])).collect()
    }

    fn each(self, entry: impl Fn(usize, usize) -> Combination) -> Vec<(Place, Combination)> {
        let n = self.dim;
        (0..n * n).map(|k| (k / n, k % n)).map(|(a, b)| ((a + 1, b + 1), entry(a, b))).collect()
    }

    /// A sum of matrices.
    fn matrix(self, starts: &[usize]) -> Vec<(Place, Combination)> {
        self.each(|a, b| starts.iter().map(|start| (1, start + self.dim * a + b)).collect())
    }

    /// The differences across the diagonal of a sum of matrices.
    fn skew(self, starts: &[usize]) -> Vec<(Place, Combination)> {
        let across = |a, b| [(1, self.dim * a + b), (-1, self.dim * b + a)];
        let difference =
            |a, b| starts.iter().flat_map(|start| across(a, b).map(|(sign, k)| (sign, start + k))).collect();
        self.each(difference).into_iter().filter(|((row, column), _)| row < column).collect()
    }

    fn trace(self, start: usize) -> Combination {
        (0..self.dim).map(|a| (1, start + (self.dim + 1) * a)).collect()
    }

    /// `n` times the traceless part on the diagonal.
    fn deviator(self, start: usize) -> Vec<(Place, Combination)> {
        let minus_trace = || self.trace(start).into_iter().map(|(factor, place)| (-factor, place));
        self.each(|a, b| match a == b {
            true => minus_trace().chain((0..self.dim).map(|_| (1, start + (self.dim + 1) * a))).collect(),
            false => vec![(1, start + self.dim * a + b)],
        })
    }
}
