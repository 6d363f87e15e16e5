//! Constraints: motion confined to a subgroup `G` of GL+(n), velocities to its Lie algebra `g`, momenta to `g*`.
//!
//! `T*G` is what is left of `T*GL` over `G` once momenta that differ by a covector that vanishes on `g` are one. The
//! pairing `tr(X O)` identifies `g*` with the image of a projection `P`, and a Hamiltonian `H(P X)` has Hamilton's
//! equations on GL whose flow keeps `G`; of the rates of the momenta `P` takes what acts on `g`. For the three groups
//! here `P` commutes with conjugation by elements of `G`, so that `Sigma = phi Sigma_hat phi^-1` holds for the
//! projected momenta too.

mod terms;

use crate::algebra::ring::{Ring, Square, add_scalar, deviator, table, trace};
use crate::algebra::{Expr, Matrix, Polynomial, Rational};

use super::direction::{BasisVector, Direction};
use super::term::TermKind;

pub use crate::symbol::Constraint;

impl Constraint {
    /// Name of the group.
    pub fn group_name(self, n: usize) -> String {
        match self {
            Self::Isochoric => format!("SL({n})"),
            Self::Rigid => format!("SO({n})"),
            Self::Conformal => format!("R+ SO({n})"),
        }
    }

    /// Does `g` contain the invariant directions of this kind?
    pub fn leaves_free(self, kind: Direction) -> bool {
        match self {
            Self::Isochoric => kind != Direction::Dilatation,
            Self::Rigid => kind == Direction::Rotation,
            Self::Conformal => matches!(kind, Direction::Rotation | Direction::Dilatation),
        }
    }

    /// Dimension of `G`.
    pub fn dimension(self, n: usize) -> usize {
        let rotations = n * (n - 1) / 2;
        match self {
            Self::Isochoric => n * n - 1,
            Self::Rigid => rotations,
            Self::Conformal => rotations + 1,
        }
    }

    /// The term that a term is on `G`: with `phi^T phi = 1` is `tr(phi_dot J phi_dot^T) = tr(Oh J Oh^T)` and
    /// `|phi^-1 x_dot| = |x_dot|`.
    pub fn same_as(self, kind: TermKind) -> TermKind {
        match (self, kind) {
            (Self::Rigid, TermKind::Dalembert) => TermKind::BodyInertia,
            (Self::Rigid, TermKind::BodyTranslation) => TermKind::SpaceTranslation,
            _ => kind,
        }
    }

    /// The form that a term has on `G`, where that is not yet the same term: with `phi^T phi = D^2 1` is
    /// `tr(phi_dot J phi_dot^T) = D^2 tr(Oh J Oh^T)`, with a [weight](super::weight).
    pub fn form_of(self, kind: TermKind) -> TermKind {
        match (self, kind) {
            (Self::Conformal, TermKind::Dalembert) => TermKind::BodyInertia,
            _ => self.same_as(kind),
        }
    }

    /// `P X`: the traceless part, the skew part, or the skew part and the trace. Also the orthogonal projection of
    /// velocities on `g`.
    pub fn projected<R: Ring>(self, m: &Square<R>) -> Square<R> {
        let half = Rational::HALF;
        let skew = || {
            table(m.len(), |a, b| {
                let mut entry = R::zero();
                entry.plus(&m[a][b], &half);
                entry.plus(&m[b][a], &-&half);
                entry
            })
        };
        match self {
            Self::Isochoric => deviator(m),
            Self::Rigid => skew(),
            Self::Conformal => {
                let (mut result, mut mean) = (skew(), R::zero());
                mean.plus(&trace(m), &Rational::one_over(m.len()));
                add_scalar(&mut result, &mean);
                result
            }
        }
    }

    /// Are affine velocities and their momenta traceless?
    pub fn is_traceless(self) -> bool {
        !self.leaves_free(Direction::Dilatation)
    }

    /// The entries of a matrix in the image of `P` that are linear in others, by those: the last of the diagonal; all
    /// below it, and the diagonal, or all but the first of it.
    pub fn dependent(self, m: &Matrix) -> Vec<(Expr, Polynomial)> {
        let n = m.dim();
        let minus = |of: Expr| Polynomial::term(vec![of], Rational::MINUS_ONE);
        let mut list = Vec::new();
        match self {
            Self::Isochoric => {
                let sum: Polynomial = (0..n - 1).map(|a| minus(m.0[a][a])).sum();
                list.push((m.0[n - 1][n - 1], sum));
            }
            Self::Rigid => list.extend((0..n).map(|a| (m.0[a][a], Polynomial::zero()))),
            Self::Conformal => list.extend((1..n).map(|a| (m.0[a][a], Polynomial::atom(m.0[0][0])))),
        }
        if self != Self::Isochoric {
            list.extend(
                (0..n).flat_map(|a| (0..a).map(move |b| (a, b))).map(|(a, b)| (m.0[a][b], minus(m.0[b][a]))),
            );
        }
        list
    }

    /// Bases of `g`, one of which makes the form of an energy shortest: invariant directions, and where `g` has enough
    /// of them, single entries.
    pub fn bases(self, n: usize, invariant: Vec<BasisVector>) -> Vec<Vec<BasisVector>> {
        let free: Vec<BasisVector> = invariant.into_iter().filter(|v| self.leaves_free(v.kind)).collect();
        if self != Self::Isochoric {
            return vec![free];
        }
        let single = |k| BasisVector { kind: Direction::Entry, entries: vec![(k, Rational::ONE)] };
        let mut entries: Vec<BasisVector> = (0..n * n).filter(|k| k % (n + 1) != 0).map(single).collect();
        let diagonal = free.iter().filter(|v| v.entries.iter().all(|(k, _)| k % (n + 1) == 0));
        entries.extend(diagonal.map(|v| BasisVector { kind: Direction::Entry, entries: v.entries.clone() }));
        vec![entries, free]
    }
}
