//! The symbols of the mechanics: the one list of what formulas name besides the fields of a model.

use super::letter::{Letter, applied, factor, of, one, power, raised, share, whole};
use super::letters;
use crate::algebra::text::Written;
use crate::symbol::{Factor, Quantity, Symbol};

/// Every symbol; `#` stands for indices.
pub const SYMBOLS: &[Letter] = &[
    whole("n", "n", "the dimension"),
    one(Quantity::Time, "t", "t", "the time"),
    // The configuration and its velocity.
    letters::CENTRE,
    of(Quantity::Position, "x_#", "x_{#}", "its components"),
    of(Quantity::CentreVelocity, "x_dot_#", "\\dot x_{#}", "its velocity"),
    of(Quantity::ComovingCentreVelocity, "v_hat_#", "\\hat v_{#}", "the co-moving velocity phi^-1 dx/dt"),
    letters::COMOVING_CENTRE_VELOCITY,
    letters::PLACEMENT,
    of(Quantity::Placement, "phi_#", "\\varphi_{#}", "its entries"),
    raised(of(Quantity::InversePlacement, "phi_inverse_#", "\\varphi^{-1}_{#}", "entries of phi^-1")),
    letters::PLACEMENT_VELOCITY,
    of(Quantity::PlacementVelocity, "phi_dot_#", "\\dot\\varphi_{#}", "its entries"),
    letters::AFFINE_VELOCITY,
    of(Quantity::AffineVelocity, "omega_#", "\\Omega_{#}", "its entries"),
    letters::COMOVING_AFFINE_VELOCITY,
    of(Quantity::ComovingAffineVelocity, "omega_hat_#", "\\hat\\Omega_{#}", "its entries"),
    // Momenta.
    letters::LINEAR_MOMENTUM,
    of(
        Quantity::LinearMomentum,
        "p_#",
        "p_{#}",
        "its components; momenta of stretches in the two-polar form",
    ),
    letters::COMOVING_LINEAR_MOMENTUM,
    of(Quantity::ComovingLinearMomentum, "p_hat_#", "\\hat p_{#}", "its components"),
    share(
        Quantity::LinearMomentum,
        "p_body_#",
        "p_{\\mathrm{body},#}",
        "the share of the mass in the body, phi^-T m_body v_hat",
    ),
    letters::CANONICAL_MOMENTUM,
    of(Quantity::CanonicalMomentum, "pi_#", "\\Pi_{#}", "its entries"),
    letters::AFFINE_SPIN,
    of(Quantity::AffineSpin, "sigma_#", "\\Sigma_{#}", "its entries"),
    letters::COMOVING_AFFINE_SPIN,
    of(Quantity::ComovingAffineSpin, "sigma_hat_#", "\\hat\\Sigma_{#}", "its entries"),
    letters::TOTAL_AFFINE_MOMENTUM,
    letters::ORIGIN,
    of(Quantity::TotalAffineMomentum, "I_#", "I_{#}", "entries of the total affine momentum"),
    letters::SPIN,
    of(Quantity::Spin, "S_#", "S_{#}", "its entries"),
    letters::VORTICITY,
    of(Quantity::Vorticity, "Vort_#", "V_{#}", "its entries"),
    letters::SPIN_IN_THE_BODY,
    letters::SPIN_IN_SPACE,
    letters::SPIN_IN_DPHI,
    // Deformation.
    letters::GREEN,
    of(Quantity::Green, "G_#", "G_{#}", "its entries"),
    of(Quantity::Finger, "Ct_#", "\\tilde C_{#}", "entries of phi phi^T"),
    applied(power(Quantity::Trace, 1, "tr(G)", "\\operatorname{tr}G", "the trace of G")),
    applied(power(Quantity::Trace, 2, "tr(G^2)", "\\operatorname{tr}G^2", "the trace of G^2")),
    applied(power(Quantity::Trace, 3, "tr(G^3)", "\\operatorname{tr}G^3", "the trace of G^3")),
    of(Quantity::GreenSquare, "G2_#", "[G^2]_{#}", "entries of G^2"),
    of(Quantity::FingerSquare, "Ct2_#", "[\\tilde C^2]_{#}", "entries of Ct^2"),
    one(Quantity::SecondInvariant, "I2", "I_{2}", "the second invariant ((tr G)^2 - tr G^2)/2"),
    one(Quantity::IsochoricExcess, "w_bar", "\\bar w", "tr(G/D^2) - n"),
    one(Quantity::MeanSquare, "tau", "\\tau", "the n-th part of tr(G/D^2)"),
    one(
        Quantity::IsochoricDeviatorSquared,
        "tr(B_bar^2)",
        "\\operatorname{tr}\\bar B^2",
        "the trace of the square of the deviator of G/D^2",
    ),
    of(Quantity::IsochoricDeviator, "B_bar_#", "\\bar B_{#}", "entries of that deviator"),
    applied(one(Quantity::Determinant, "det", "\\det\\varphi", "the determinant of phi")),
    one(Quantity::Dilatation, "D", "D", "the mean stretch det^(1/n)"),
    one(Quantity::MeanLogStretch, "q", "q", "the mean logarithmic stretch ln D"),
    of(Quantity::InverseTensor, "K_#", "K_{#}", "entries of the inverse of G, or of Ct"),
    of(Quantity::InverseStrain, "E_#", "E_{#}", "entries of 1 - G^-1, or of 1 - Ct^-1"),
    of(Quantity::Stretches, "Q_#", "Q_{#}", "the stretches, singular values of phi"),
    letters::STRETCH,
    of(Quantity::LogStretches, "q_#", "q_{#}", "the logarithmic stretches ln Q_a"),
    letters::PRINCIPAL_AXIS,
    of(Quantity::Axis, "e_#", "e_{#}", "their components"),
    letters::STRETCHED_AXIS,
    of(Quantity::StretchedAxis, "f_#", "f_{#}", "its components"),
    of(Quantity::UnitGreen, "G_bar_#", "\\bar G_{#}", "entries of G/D^2"),
    of(Quantity::UnitFinger, "Ct_bar_#", "\\bar{\\tilde C}_{#}", "entries of Ct/D^2"),
    applied(power(Quantity::UnitTrace, 1, "tr(G_bar)", "\\operatorname{tr}\\bar G", "the trace of G/D^2")),
    applied(power(
        Quantity::UnitTrace,
        2,
        "tr(G_bar^2)",
        "\\operatorname{tr}\\bar G^2",
        "the trace of its square",
    )),
    applied(power(
        Quantity::UnitTrace,
        3,
        "tr(G_bar^3)",
        "\\operatorname{tr}\\bar G^3",
        "the trace of its cube",
    )),
    of(Quantity::UnitGreenSquare, "G2_bar_#", "[\\bar G^2]_{#}", "entries of the square of G/D^2"),
    of(
        Quantity::UnitFingerSquare,
        "Ct2_bar_#",
        "[\\bar{\\tilde C}^2]_{#}",
        "entries of the square of Ct/D^2",
    ),
    whole("G_bar", "\\bar G", "the Green deformation tensor of phi/D"),
    of(Quantity::IsochoricPlacement, "Psi_#", "\\Psi_{#}", "entries of phi/D"),
    of(
        Quantity::Cofactor,
        "cof_#",
        "\\operatorname{cof}_{#}",
        "cofactors of phi/D, or of phi where D is not carried",
    ),
    of(Quantity::IsochoricVelocity, "O_#", "O_{#}", "entries of the isochoric velocity s + w"),
    of(Quantity::Shear, "s_#", "s_{#}", "its symmetric part"),
    of(Quantity::Turn, "w_#", "w_{#}", "its skew part"),
    of(
        Quantity::SumCouplings,
        "m_#",
        "M_{#}",
        "the coupling of stretches (spin and vorticity), in the two-polar form",
    ),
    of(Quantity::DifferenceCouplings, "n_#", "N_{#}", "the other one"),
    // Energies and forces.
    letters::KINETIC_ENERGY,
    letters::INTERNAL_ENERGY,
    letters::ENERGY_IN_THE_BODY,
    letters::ENERGY_IN_SPACE,
    letters::ENERGY_IN_DPHI,
    letters::HAMILTONIAN,
    letters::POTENTIAL,
    letters::SELF_GRAVITY,
    letters::CARLSON_RF,
    letters::RAYLEIGH,
    one(Quantity::Work, "work", "W", "the work of the forces that no potential has"),
    letters::FORCE,
    letters::COMOVING_FORCE,
    letters::AFFINE_FORCE,
    letters::COMOVING_AFFINE_FORCE,
    letters::CANONICAL_FORCE,
    letters::PROJECTION,
    whole("Lambda", "\\Lambda", "the multiplier of a constraint"),
    of(Quantity::Drag, "Q_R_#", "Q_{R,#}", "the part of Q that R has in space"),
    of(Quantity::ComovingDrag, "Q_hat_R_#", "\\hat Q_{R,#}", "the part of Q_hat that R has in the body"),
    of(Quantity::FlatDrag, "N_flat_#", "N_{\\mathrm{flat},#}", "the part of N that R has in dphi/dt"),
    of(Quantity::Push, "N_R_#", "N_{R,#}", "the part of N that R has in other frames than that of the chart"),
    of(Quantity::CentreDrag, "F_R_#", "F_{R,#}", "the force of R on the centre of mass"),
    // The response of a potential: Q_hat = beta_0 1 + beta_1 G + beta_2 G^2 and its like.
    of(Quantity::Raised, "zeta_#", "\\zeta_{#}", "sums that the potential raises to a power"),
    one(Quantity::Pressure, "beta_0", "\\beta_{0}", "the response to q, -1/n dU/dq"),
    of(
        Quantity::Stress,
        "beta_#",
        "\\beta_{#}",
        "the response to tr(G), tr(G^2) and tr(G^3), -2, -4 and -6 times the slope of U",
    ),
    of(
        Quantity::Piola,
        "PK_#",
        "\\mathsf{S}_{#}",
        "entries of the second Piola-Kirchhoff tensor, as in the force",
    ),
    of(Quantity::SlopeByGreen, "beta_G_#", "\\beta_{G_{#}}", "the response to an entry of G"),
    of(Quantity::SlopeByFinger, "beta_Ct_#", "\\beta_{\\tilde C_{#}}", "the response to an entry of Ct"),
    of(Quantity::SlopeByPlacement, "beta_phi_#", "\\beta_{\\varphi_{#}}", "the response to an entry of phi"),
    of(Quantity::SlopeByPosition, "beta_x_#", "\\beta_{x_{#}}", "the response to a component of x"),
    of(Quantity::PulledBack, "x_hat_#", "\\hat x_{#}", "the position pulled back to the body, phi^T x"),
    of(Quantity::PushedForward, "chi_#", "\\chi_{#}", "components of Ct x = phi x_hat"),
    applied(one(Quantity::PulledBackSquare, "|x_hat|^2", "|\\hat x|^2", "its square, x . Ct x")),
    one(
        Quantity::SlopeByPulledBack,
        "beta_x_hat",
        "\\beta_{\\hat x}",
        "the response to it, -2 times the slope of U",
    ),
    of(Quantity::Weighted, "xi_#", "\\xi_{#}", "that times x, or times x_hat in the body"),
    of(Quantity::Tension, "tau_#", "\\tau_{#}", "the response to q_a; over Q_a^2 where it stands at f_a"),
    // Mass matrices and their factors.
    whole("J", "J", "an inertia that no field is"),
    whole("K", "K", "a tensor that no field is"),
    whole("J_body", "J_{\\mathrm{body}}", "that of the terms in Omega_hat"),
    whole("J_space", "J_{\\mathrm{space}}", "that of the terms in Omega"),
    whole("J_flat", "J_{\\mathrm{flat}}", "that of the terms in dphi/dt"),
    whole("K_body", "K_{\\mathrm{body}}", "that of the terms in Omega_hat"),
    whole("K_space", "K_{\\mathrm{space}}", "that of the terms in Omega"),
    whole("K_flat", "K_{\\mathrm{flat}}", "that of the terms in dphi/dt"),
    whole("J_R", "J_{R}", "an inertia-like matrix of R"),
    whole("K_R", "K_{R}", "a tensor of R"),
    whole("J_R_body", "J_{R,\\mathrm{body}}", "that of the terms in Omega_hat"),
    whole("J_R_space", "J_{R,\\mathrm{space}}", "that of the terms in Omega"),
    whole("J_R_flat", "J_{R,\\mathrm{flat}}", "that of the terms in dphi/dt"),
    whole("K_R_body", "K_{R,\\mathrm{body}}", "that of the terms in Omega_hat"),
    whole("K_R_space", "K_{R,\\mathrm{space}}", "that of the terms in Omega"),
    whole("K_R_flat", "K_{R,\\mathrm{flat}}", "that of the terms in dphi/dt"),
    whole("Gamma", "\\Gamma", "a block of the mass matrix"),
    whole("Gamma_#", "\\Gamma_{#}", "blocks of the mass matrix"),
    letters::SPACE_FACTOR,
    letters::BODY_FACTOR,
    factor(Factor::Pivot, "d_#", "d_{#}", "pivots of the mass matrix of the centre, L diag(d) L^T"),
    factor(Factor::Lower, "L_#", "L_{#}", "its lower factor L"),
    factor(Factor::Rest, "u_#", "u_{#}", "entries of diag(d) L^T"),
    factor(Factor::Forward, "y_#", "y_{#}", "the solution of L y = p_hat"),
    factor(Factor::Backward, "z_#", "z_{#}", "a component of the solution of L^T z = y/d"),
];

/// Functions that formulas call by name.
pub const FUNCTIONS: &[&str] =
    &["tr", "exp", "ln", "sqrt", "cbrt", "abs", "sin", "cos", "tan", "sinh", "cosh", "tanh", "asinh", "diag"];

/// What stands for the `#` of a template in a name: the indices, or nothing where the template has none.
fn index<'a>(template: &str, name: &'a str) -> Option<&'a str> {
    match template.split_once('#') {
        None => (template == name).then_some(""),
        Some((before, after)) => name
            .strip_prefix(before)?
            .strip_suffix(after)
            .filter(|index| !index.is_empty() && index.bytes().all(|c| c.is_ascii_digit())),
    }
}

/// Text and LaTeX of a symbol of the derivation; `None` where it is none of the list.
pub(super) fn written(symbol: &Symbol) -> Option<[Written; 2]> {
    let found = |letter: &'static Letter| Some((letter, letter.of?.indices(symbol)?));
    let (letter, indices) = SYMBOLS.iter().find_map(found)?;
    let index: String = indices.iter().map(usize::to_string).collect();
    let filled = |template: &str| template.replace('#', &index);
    Some([Written::letter(filled(letter.text)), Written { body: filled(letter.latex), shape: letter.shape }])
}

/// Is a word of a formula a symbol, a differential of one, or a function?
pub fn is_symbol(word: &str) -> bool {
    let is_one = |word: &str| SYMBOLS.iter().any(|symbol| index(symbol.text, word).is_some());
    FUNCTIONS.contains(&word) || is_one(word) || word.strip_prefix('d').is_some_and(is_one)
}

/// Is a letter of LaTeX a symbol, or where entries are asked for that of a matrix or vector?
pub(super) fn is_letter(latex: &str, entries: bool) -> bool {
    let entry = format!("{latex}_{{#}}");
    SYMBOLS.iter().any(|symbol| symbol.latex == latex || (entries && symbol.latex == entry))
}
