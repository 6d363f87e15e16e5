//! A Hamiltonian as stated on the momentum side, and the kinetic energy that belongs to it.

use crate::algebra::{Arena, Matrix, Polynomial, Rational};

use super::constraint::Constraint;
use super::direction::Direction;
use super::hamiltonian::{Hamiltonian, Isotropic};
use super::hessian::Hessian;
use super::kinetic::{Kinetic, Translation};
use super::term::{Coefficient, Frame, Term, TermKind};

/// `a/2 tr X^2 + b/2 (tr X)^2 + c/2 |W|^2 + d/3 tr X^3`, `W = X - X^T`, and `k/2 |p_hat|^2` or `k/2 |p|^2`.
#[derive(Clone, Debug)]
pub struct Stated {
    /// Dimension of space.
    pub dim: usize,
    /// The group that the motion is confined to; `None` for GL+(n).
    pub constraint: Option<Constraint>,
    /// Frame of `X`: that of the squared norm, or else of the translation; the Casimirs are the same in both.
    pub frame: Frame,
    /// Each internal term alone, with its place among the terms.
    pub parts: Vec<(usize, Isotropic)>,
    /// Place, frame and `k = 1/m` of the translation.
    pub translation: Option<(usize, Frame, Polynomial)>,
}

impl Stated {
    /// The sum of the internal terms.
    pub fn invariants(&self) -> Isotropic {
        let mut sum = Isotropic::zero();
        for (_, part) in &self.parts {
            sum.casimir2.add_scaled(&part.casimir2, &Rational::ONE);
            sum.casimir1_squared.add_scaled(&part.casimir1_squared, &Rational::ONE);
            sum.skew.add_scaled(&part.skew, &Rational::ONE);
            sum.casimir3.add_scaled(&part.casimir3, &Rational::ONE);
        }
        sum
    }

    /// Is there a cubic term? Then the velocity is quadratic in the momentum and does not determine it.
    pub fn is_cubic(&self) -> bool {
        !self.invariants().casimir3.is_zero()
    }

    /// The eigenvalues on the momenta that the constraint leaves.
    pub fn eigenvalues(&self) -> Vec<(Direction, Polynomial)> {
        let mut list = self.unconfined_eigenvalues().to_vec();
        list.retain(|(direction, _)| self.leaves_free(*direction));
        list
    }

    fn leaves_free(&self, direction: Direction) -> bool {
        self.constraint.is_none_or(|group| group.leaves_free(direction))
    }

    /// Eigenvalues of the quadratic part on symmetric traceless, skew and trace momenta: `a`, `2c - a`, `a + n b`, from
    /// `tr X^2 = -tr X X^T` and `|W|^2 = 2 tr X X^T` on skew `X`.
    fn unconfined_eigenvalues(&self) -> [(Direction, Polynomial); 3] {
        let sum = self.invariants();
        let rotation = sum.skew.scaled(&Rational::from(2)).sub(&sum.casimir2);
        let dilatation = sum.casimir1_squared.scaled(&Rational::whole(self.dim)).add(&sum.casimir2);
        [
            (Direction::Shear, sum.casimir2),
            (Direction::Rotation, rotation),
            (Direction::Dilatation, dilatation),
        ]
    }

    /// The form on momenta in place of velocities: `phi -> A phi B` changes `Sigma_hat` as `Oh` and `Sigma` as `Om`, so
    /// that what is invariant of the one is of the other. Of all momenta, those that a constraint takes away too: the
    /// groups are those of the Hamiltonian as stated.
    pub fn on_momenta(&self, arena: &mut Arena) -> Kinetic {
        let spin = Matrix::symbols(arena, self.frame.momentum(), self.dim);
        let rows = spin.atoms();
        let internal = self.parts.iter().map(|(place, part)| (*place, part.energy(&rows))).collect();
        Kinetic { internal, ..self.of_the_centre(arena, spin) }
    }

    /// The energy of the centre of mass, without an internal form in `velocity`.
    fn of_the_centre(&self, arena: &mut Arena, velocity: Matrix) -> Kinetic {
        Kinetic {
            constraint: None,
            dim: self.dim,
            frame: self.frame,
            velocity,
            terms: Vec::new(),
            internal: Vec::new(),
            translation: self.mass(arena),
            congruent: None,
        }
    }

    /// The places of the terms that are zero on all momenta that the constraint leaves, `X = P X`.
    pub fn vanishing(&self, arena: &mut Arena) -> Vec<usize> {
        let on_momenta = Kinetic { constraint: self.constraint, ..self.on_momenta(arena) };
        let vanishes =
            |(place, energy): &&(usize, Polynomial)| Hessian::new(&on_momenta.only(*place, energy)).is_zero();
        on_momenta.internal.iter().filter(vanishes).map(|(place, _)| *place).collect()
    }

    /// The kinetic energy on the velocity side, `I`, `A`, `B` from `I + A = 1/a`, `I - A = 1/(2c - a)`,
    /// `I + A + n B = 1/(a + n b)`; without internal form for a cubic Hamiltonian. `None` where it is degenerate.
    ///
    /// A constraint restricts it to the velocities of a Lie algebra, which in either frame is a sum of the invariant
    /// directions: of the three reciprocals those that it leaves free are taken, and the others do not matter.
    pub fn kinetic(&self, arena: &mut Arena) -> Option<Kinetic> {
        if self.is_cubic() {
            let velocity = Matrix::symbols(arena, self.frame.velocity(), self.dim);
            return Some(self.of_the_centre(arena, velocity));
        }
        let mut reciprocal = |(_, value): (Direction, Polynomial)| -> Option<Polynomial> {
            let value = value.expression(arena);
            Polynomial::reciprocal(arena, value)
        };
        let [shear, rotation, dilatation] = self.unconfined_eigenvalues();
        // What no velocity reads is chosen so that the terms are few.
        let shear = if self.leaves_free(Direction::Shear) { shear } else { rotation.clone() };
        let dilatation = if self.leaves_free(Direction::Dilatation) { dilatation } else { shear.clone() };
        let (shear, rotation, dilatation) =
            (reciprocal(shear)?, reciprocal(rotation)?, reciprocal(dilatation)?);
        let half = Rational::HALF;
        let nth = Rational::one_over(self.dim);
        let inertia = if self.frame == Frame::Space { TermKind::SpaceInertia } else { TermKind::BodyInertia };
        let coefficients = [
            (TermKind::Casimir2, shear.sub(&rotation).scaled(&half)),
            (TermKind::Casimir1Squared, dilatation.sub(&shear).scaled(&nth)),
            (inertia, shear.add(&rotation).scaled(&half)),
        ];
        let mut terms: Vec<Term> = coefficients
            .into_iter()
            .filter(|(_, value)| !value.is_zero())
            .map(|(kind, value)| Term { kind, value: Coefficient::Scalar(value.expression(arena)) })
            .collect();
        if let Some(t) = self.mass(arena) {
            let kind =
                if t.frame == Frame::Body { TermKind::BodyTranslation } else { TermKind::SpaceTranslation };
            terms.push(Term { kind, value: Coefficient::Scalar(t.mass) });
        }
        Kinetic::under(arena, self.dim, &terms, self.constraint).ok()
    }

    /// The Hamiltonian as it stands, for one that is no quadratic form.
    pub fn hamiltonian(&self, arena: &mut Arena) -> Hamiltonian {
        let momentum = Matrix::symbols(arena, self.frame.momentum(), self.dim);
        let invariants = self.invariants();
        let energy = invariants.energy(&momentum.atoms());
        // O = (dH/dX)^T
        let velocity = momentum.transpose().0.iter().map(|row| energy.gradient(row)).collect();
        Hamiltonian {
            constraint: None,
            dim: self.dim,
            frame: self.frame,
            momentum,
            velocity,
            isotropic: Some(invariants),
            translation: self.translation.as_ref().map(|(_, frame, k)| (*frame, k.clone())),
            numeric_blocks: Vec::new(),
            weight: None,
        }
    }

    /// `m = 1/k`.
    fn mass(&self, arena: &mut Arena) -> Option<Translation> {
        let (place, frame, inverse) = self.translation.as_ref()?;
        let inverse = inverse.expression(arena);
        let mass = arena.pow(inverse, -1)?;
        Some(Translation { frame: *frame, mass, place: *place })
    }
}
