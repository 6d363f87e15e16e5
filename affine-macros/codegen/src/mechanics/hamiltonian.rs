//! Inverse Legendre transformation and Hamiltonian, in any chart that admits them as polynomials.

use crate::algebra::ring::{
    Square, above_diagonal, pairs, product, table, times, trace, trace_of_product, transpose,
};
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};

use super::charts::{Chart, Linear, Momentum};
use super::constraint::Constraint;
use super::direction::Direction;
use super::hessian::{Hessian, NumericBlock};
use super::kinetic::Kinetic;
use super::metric::Definitions;
use super::shared::CentreVelocity;
use super::term::Frame;
use super::weight::Weight;

/// The kinetic Hamiltonian in pieces.
#[derive(Clone, Debug)]
#[must_use]
pub struct Hamiltonian {
    /// Dimension of space.
    pub dim: usize,
    /// The group that the motion is confined to; `None` for GL+(n).
    pub constraint: Option<Constraint>,
    /// Frame in which the internal energy has constant coefficients.
    pub frame: Frame,
    /// The affine spin of that frame.
    pub momentum: Matrix,
    /// The affine velocity as a function of the affine spin: `O = (dH/dX)^T`, linear without `C(3)`.
    pub velocity: Vec<Vec<Polynomial>>,
    /// `C(2)/(2 alpha) + C(1)^2/(2 beta) + |W|^2/(2 mu)`, where the energy is isotropic, and what is stated of `C(3)`.
    pub isotropic: Option<Isotropic>,
    /// Frame and `1/m` of the translational energy.
    pub translation: Option<(Frame, Polynomial)>,
    /// Inverse blocks that only the fields' values give.
    pub numeric_blocks: Vec<NumericBlock>,
    /// The weight `D^2` of the internal energy, where it has one; `velocity` then contains `D^-2`.
    pub weight: Option<Weight>,
}

/// Coefficients of an isotropic Hamiltonian, (4.24).
#[derive(Clone, Debug)]
#[must_use]
pub struct Isotropic {
    /// `1/alpha`, of `C(2)/2`.
    pub casimir2: Polynomial,
    /// `1/beta`, of `C(1)^2/2`.
    pub casimir1_squared: Polynomial,
    /// `1/mu`, of `|W|^2/2` with `W = X - X^T`, `|W|^2` the sum over `a < b` of `W_ab^2`.
    pub skew: Polynomial,
    /// Of `C(3)/3`, for Hamiltonians stated with it.
    pub casimir3: Polynomial,
}

impl Hamiltonian {
    /// Inverts the Legendre transformation; `None` where it is degenerate.
    pub fn new(arena: &mut Arena, kinetic: &Kinetic, hessian: &Hessian) -> Option<Self> {
        let n = kinetic.dim;
        let inverse = hessian.inverse(arena)?;
        let momentum = Matrix::symbols(arena, kinetic.frame.momentum(), n);
        // X = (dT/dO)^T: the momentum conjugate to O_ab is X_ba.
        let conjugate: Vec<Expr> = momentum.transpose().0.into_iter().flatten().collect();
        let linear_form = |row: &Vec<Polynomial>| {
            row.iter().zip(&conjugate).map(|(c, x)| c.mul(&Polynomial::atom(*x))).sum()
        };
        let mut flat: Vec<Polynomial> = inverse.matrix.iter().map(linear_form).collect();
        let weight = Weight::of(arena, kinetic);
        if let Some(Weight { inverse, .. }) = weight {
            flat.iter_mut().for_each(|velocity| *velocity = velocity.mul(&Polynomial::atom(inverse)));
        }
        let translation = match kinetic.translation {
            None => None,
            Some(t) => Some((t.frame, Polynomial::reciprocal(arena, t.mass)?)),
        };
        Some(Self {
            dim: n,
            constraint: kinetic.constraint,
            frame: kinetic.frame,
            momentum,
            velocity: flat.chunks(n).map(<[Polynomial]>::to_vec).collect(),
            isotropic: match kinetic.frame {
                // The Casimirs of the affine group are no functions of Pi alone.
                Frame::Flat => None,
                // Nor is one of D and the momenta a sum of such pieces.
                _ if weight.is_some() => None,
                Frame::Body | Frame::Space => isotropic(arena, kinetic.confined(), hessian, n),
            },
            translation,
            numeric_blocks: inverse.numeric_blocks,
            weight,
        })
    }

    /// `1/2 tr(X O(X))` in the frame's own affine spin, for a quadratic form; `H_int` itself with `C(3)`.
    pub fn internal(&self) -> Polynomial {
        if let Some(iso) = self.isotropic.as_ref().filter(|iso| !iso.casimir3.is_zero()) {
            return iso.energy(&self.momentum.atoms());
        }
        let product =
            |(a, b): (usize, usize)| Polynomial::atom(self.momentum.0[b][a]).mul(&self.velocity[a][b]);
        pairs(self.dim).map(product).sum::<Polynomial>().scaled(&Rational::HALF)
    }

    /// `dO_k/dX_l`, constant for a quadratic form: of entries row-major, `l` transposed.
    pub fn slopes(&self) -> Square<Polynomial> {
        let n = self.dim;
        table(n * n, |k, l| self.velocity[k / n][k % n].derivative(self.momentum.0[l % n][l / n]))
    }

    /// Is the energy a general tensor in an affine frame? Then nothing of its own momentum is conserved:
    /// `[X, O(X)] = 0` for every `X` only where `O` is a multiple of `X` and the identity.
    pub fn is_tensor(&self) -> bool {
        // The few momenta of a rigid or conformal motion make short equations whatever their coefficients.
        let small = matches!(self.constraint, Some(Constraint::Rigid | Constraint::Conformal));
        self.isotropic.is_none() && self.frame != Frame::Flat && !small
    }

    /// What defines the weight of the internal energy, if it has one.
    pub fn weight_definitions(&self) -> Definitions {
        self.weight.as_ref().map_or_else(Definitions::new, |weight| weight.definitions.clone())
    }

    /// How the velocity of the centre of mass follows.
    pub fn centre_velocity(&self) -> CentreVelocity {
        match &self.translation {
            None => CentreVelocity::Fixed,
            Some((frame, inverse_mass)) => CentreVelocity::PerMass(*frame, inverse_mass.clone()),
        }
    }

    /// The internal energy in a chart, with its skew part (of isotropic energies) left out on request; `None`
    /// where it is not a polynomial there, and for `I(O)` where that is not conserved: `Sigma = I(O) - x p^T` only
    /// makes it longer.
    pub fn internal_in(&self, chart: &Chart, without_skew: bool) -> Option<Polynomial> {
        match &self.isotropic {
            Some(iso) if without_skew || iso.skew.is_zero() => {
                (chart.momentum != Momentum::Canonical).then(|| iso.casimirs(&spatial_or_own(chart)))
            }
            _ if chart.momentum == Momentum::of(self.frame) => Some(self.internal()),
            _ => None,
        }
    }

    /// `H` in a chart of the model's own frame.
    pub fn energy_in(&self, chart: &Chart) -> Polynomial {
        self.internal().add(&self.translation_in(chart))
    }

    /// The affine momenta in which it is a polynomial, each for one frame.
    pub fn momenta(&self) -> Vec<Momentum> {
        match self.isotropic {
            Some(_) => vec![Momentum::of(self.frame), Momentum::Body, Momentum::Space],
            None => vec![Momentum::of(self.frame)],
        }
    }

    /// The translational energy in a chart.
    pub fn translation_in(&self, chart: &Chart) -> Polynomial {
        let Some((frame, inverse_mass)) = &self.translation else { return Polynomial::zero() };
        let squares = match (frame, chart.linear) {
            (Frame::Body, Some(Linear::Space)) => comoving(chart),
            _ => Polynomial::vector(&chart.p),
        };
        squares.iter().map(|p| p.mul(p).mul(inverse_mass).scaled(&Rational::HALF)).sum()
    }
}

impl Isotropic {
    /// `H = 0`.
    pub fn zero() -> Self {
        let [casimir2, casimir1_squared, skew, casimir3] = std::array::from_fn(|_| Polynomial::zero());
        Self { casimir2, casimir1_squared, skew, casimir3 }
    }

    /// `H` of an affine spin.
    pub fn energy(&self, spin: &Square<Polynomial>) -> Polynomial {
        self.casimirs(spin).add(&self.skew_norm(spin))
    }

    /// `C(2)/(2 alpha) + C(1)^2/(2 beta)` of an affine spin, and what there is of `C(3)`.
    pub fn casimirs(&self, spin: &Square<Polynomial>) -> Polynomial {
        let (c1, c2) = (trace(spin), trace_of_product(spin, spin));
        let mut sum = c2.mul(&self.casimir2).add(&c1.mul(&c1).mul(&self.casimir1_squared));
        sum = sum.scaled(&Rational::HALF);
        if !self.casimir3.is_zero() {
            let c3 = trace_of_product(&product(spin, spin), spin);
            sum.add_product(&c3, &self.casimir3, &Rational::THIRD);
        }
        sum
    }

    /// `|W|^2/(2 mu)` of an affine spin.
    pub fn skew_norm(&self, spin: &Square<Polynomial>) -> Polynomial {
        let squares = above_diagonal(spin.len()).map(|(a, b)| spin[a][b].sub(&spin[b][a])).map(|w| w.mul(&w));
        squares.sum::<Polynomial>().mul(&self.skew).scaled(&Rational::HALF)
    }
}

/// `p_hat = phi^T p`.
fn comoving(chart: &Chart) -> Vec<Polynomial> {
    times(&transpose(&chart.placement()), &Polynomial::vector(&chart.p))
}

/// The chart's affine momentum, or `Sigma = I(O) - x p^T` where that is the total one.
pub fn spatial_or_own(chart: &Chart) -> Vec<Vec<Polynomial>> {
    let orbital = chart.momentum == Momentum::Total;
    table(chart.dim, |i, j| {
        let own = Polynomial::atom(chart.m.0[i][j]);
        if orbital { own.sub(&Polynomial::monomial([chart.x[i], chart.p[j]])) } else { own }
    })
}

/// The isotropic coefficients, where shear, rotation and dilatation each have one eigenvalue, or are not free.
fn isotropic(
    arena: &mut Arena,
    constraint: Option<Constraint>,
    hessian: &Hessian,
    n: usize,
) -> Option<Isotropic> {
    let mut common = |kind: Direction| {
        // No momentum moves the body in a direction that is not free.
        if constraint.is_some_and(|group| !group.leaves_free(kind)) {
            return Some(Polynomial::zero());
        }
        let mut found: Option<Polynomial> = None;
        for block in hessian.blocks.iter().filter(|b| b.basis[0].kind == kind) {
            let eigenvalue = block.eigenvalue()?;
            if found.as_ref().is_some_and(|f| *f != eigenvalue) {
                return None;
            }
            found = Some(eigenvalue);
        }
        let value = found?.expression(arena);
        Polynomial::reciprocal(arena, value)
    };
    let shear = common(Direction::Shear)?;
    let rotation = common(Direction::Rotation)?;
    let dilatation = common(Direction::Dilatation)?;
    // H = |shear|^2/(2 shear) + |skew|^2/(2 rotation) + (tr)^2/(2 n dilatation), rewritten by
    // C(2) = |symmetric|^2 - |skew|^2 and |W|^2 = 2 |skew|^2 (sum over all entries on the right).
    let (casimir1_squared, skew) = (dilatation.sub(&shear), shear.add(&rotation));
    Some(Isotropic {
        casimir2: shear,
        casimir1_squared: casimir1_squared.scaled(&Rational::one_over(n)),
        skew: skew.scaled(&Rational::HALF),
        casimir3: Polynomial::zero(),
    })
}
