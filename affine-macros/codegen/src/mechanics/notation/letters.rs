//! Symbols that formulas of matrices are made of.

use super::letter::{Letter, whole};

pub(in crate::mechanics) const CENTRE: Letter = whole("x", "x", "the place of the centre of mass");
pub(in crate::mechanics) const COMOVING_CENTRE_VELOCITY: Letter =
    whole("v_hat", "\\hat v", "the co-moving velocity phi^-1 dx/dt");
pub(in crate::mechanics) const PLACEMENT: Letter = whole("phi", "\\varphi", "the placement");
pub(in crate::mechanics) const PLACEMENT_VELOCITY: Letter =
    whole("phi_dot", "\\dot\\varphi", "the velocity of the placement");
pub(in crate::mechanics) const AFFINE_VELOCITY: Letter =
    whole("Omega", "\\Omega", "the affine velocity dphi/dt phi^-1");
pub(in crate::mechanics) const COMOVING_AFFINE_VELOCITY: Letter =
    whole("Omega_hat", "\\hat\\Omega", "the co-moving affine velocity phi^-1 dphi/dt");
pub(in crate::mechanics) const LINEAR_MOMENTUM: Letter = whole("p", "p", "the linear momentum");
pub(in crate::mechanics) const COMOVING_LINEAR_MOMENTUM: Letter =
    whole("p_hat", "\\hat p", "the co-moving linear momentum phi^T p");
pub(in crate::mechanics) const CANONICAL_MOMENTUM: Letter =
    whole("Pi", "\\Pi", "the canonical affine momentum");
pub(in crate::mechanics) const AFFINE_SPIN: Letter = whole("Sigma", "\\Sigma", "the affine spin phi Pi");
pub(in crate::mechanics) const COMOVING_AFFINE_SPIN: Letter =
    whole("Sigma_hat", "\\hat\\Sigma", "the co-moving affine spin Pi phi");
pub(in crate::mechanics) const TOTAL_AFFINE_MOMENTUM: Letter =
    whole("I", "I", "the total affine momentum I(O) = x p^T + Sigma");
pub(in crate::mechanics) const ORIGIN: Letter = whole("O", "O", "the origin, in I(O)");
pub(in crate::mechanics) const SPIN: Letter = whole("S", "S", "the spin Sigma - Sigma^T");
pub(in crate::mechanics) const VORTICITY: Letter =
    whole("Vort", "V", "the vorticity Sigma_hat - Sigma_hat^T");
pub(in crate::mechanics) const SPIN_IN_THE_BODY: Letter =
    whole("X", "X", "the affine spin of the energy in the body; any matrix, beside P");
pub(in crate::mechanics) const SPIN_IN_SPACE: Letter =
    whole("Y", "Y", "the affine spin of the energy in space, seen from the body");
pub(in crate::mechanics) const SPIN_IN_DPHI: Letter =
    whole("Z", "Z", "the affine spin of the energy in dphi/dt, seen from the body");
pub(in crate::mechanics) const GREEN: Letter = whole("G", "G", "the Green deformation tensor phi^T phi");
pub(in crate::mechanics) const STRETCH: Letter = whole("Q_a", "Q_{a}", "one of them");
pub(in crate::mechanics) const PRINCIPAL_AXIS: Letter =
    whole("e_a", "e_{a}", "the principal axes in the body, G e_a = Q_a^2 e_a");
pub(in crate::mechanics) const STRETCHED_AXIS: Letter = whole("f_a", "f_{a}", "phi e_a");
pub(in crate::mechanics) const KINETIC_ENERGY: Letter = whole("T", "T", "the kinetic energy");
pub(in crate::mechanics) const INTERNAL_ENERGY: Letter =
    whole("T_int", "T_{\\mathrm{int}}", "that of the internal motion");
pub(in crate::mechanics) const ENERGY_IN_THE_BODY: Letter =
    whole("T_body", "T_{\\mathrm{body}}", "the terms in Omega_hat");
pub(in crate::mechanics) const ENERGY_IN_SPACE: Letter =
    whole("T_space", "T_{\\mathrm{space}}", "the terms in Omega");
pub(in crate::mechanics) const ENERGY_IN_DPHI: Letter =
    whole("T_flat", "T_{\\mathrm{flat}}", "the terms in dphi/dt");
pub(in crate::mechanics) const HAMILTONIAN: Letter = whole("H", "H", "the Hamiltonian");
pub(in crate::mechanics) const POTENTIAL: Letter = whole("U", "U", "the potential");
pub(in crate::mechanics) const SELF_GRAVITY: Letter =
    whole("U_g", "U_{\\mathrm{g}}", "the energy of the body in its own gravity");
pub(in crate::mechanics) const CARLSON_RF: Letter =
    whole("R_F", "R_F", "Carlson's integral R_F, of the squared stretches");
pub(in crate::mechanics) const RAYLEIGH: Letter = whole("R", "R", "Rayleigh's dissipation function");
pub(in crate::mechanics) const FORCE: Letter = whole("F", "F", "the force on p");
pub(in crate::mechanics) const COMOVING_FORCE: Letter = whole("F_hat", "\\hat F", "the force on p_hat");
pub(in crate::mechanics) const AFFINE_FORCE: Letter = whole("Q", "Q", "the force on Sigma");
pub(in crate::mechanics) const COMOVING_AFFINE_FORCE: Letter =
    whole("Q_hat", "\\hat Q", "the force on Sigma_hat");
pub(in crate::mechanics) const CANONICAL_FORCE: Letter = whole("N", "N", "the force on Pi");
pub(in crate::mechanics) const PROJECTION: Letter =
    whole("P", "P", "the projection on the Lie algebra of a constraint");
pub(in crate::mechanics) const SPACE_FACTOR: Letter =
    whole("A", "A", "the factor of the metric of space, g = A^T A");
pub(in crate::mechanics) const BODY_FACTOR: Letter =
    whole("B", "B", "the factor of the metric of the body, eta = B^T B");
