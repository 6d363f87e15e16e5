//! The symbols of the mechanics: the one list of what formulas name besides the fields of a model.

use crate::algebra::text::{Shape, Written};

/// A symbol of formulas.
#[derive(Clone, Copy, Debug)]
pub struct Symbol {
    /// Its name in the derivation; none where formulas alone name it.
    stem: Option<&'static str>,
    /// As text; `#` stands for indices.
    pub text: &'static str,
    /// As LaTeX, likewise.
    pub latex: &'static str,
    /// Where the LaTeX takes brackets.
    shape: Shape,
    /// Its meaning, in words.
    pub meaning: &'static str,
}

/// A quantity of the derivation.
const fn of(stem: &'static str, text: &'static str, latex: &'static str, meaning: &'static str) -> Symbol {
    Symbol { stem: Some(stem), text, latex, shape: Shape::Letter, meaning }
}

/// A matrix, a function or a group that formulas name as a whole.
const fn whole(text: &'static str, latex: &'static str, meaning: &'static str) -> Symbol {
    Symbol { stem: None, text, latex, shape: Shape::Letter, meaning }
}

/// One whose LaTeX has a superscript.
const fn raised(symbol: Symbol) -> Symbol {
    Symbol { shape: Shape::Raised, ..symbol }
}

/// One whose LaTeX is a function without brackets.
const fn applied(symbol: Symbol) -> Symbol {
    Symbol { shape: Shape::Applied, ..symbol }
}

/// Every symbol; `#` stands for indices.
pub const SYMBOLS: &[Symbol] = &[
    whole("n", "n", "the dimension"),
    of("t", "t", "t", "the time"),
    // The configuration and its velocity.
    whole("x", "x", "the place of the centre of mass"),
    of("x_#", "x_#", "x_{#}", "its components"),
    of("x_dot_#", "x_dot_#", "\\dot x_{#}", "its velocity"),
    of("v_hat_#", "v_hat_#", "\\hat v_{#}", "the co-moving velocity phi^-1 dx/dt"),
    whole("v_hat", "\\hat v", "the co-moving velocity phi^-1 dx/dt"),
    whole("phi", "\\varphi", "the placement"),
    of("phi_#", "phi_#", "\\varphi_{#}", "its entries"),
    raised(of("phi_inverse_#", "phi_inverse_#", "\\varphi^{-1}_{#}", "entries of phi^-1")),
    whole("phi_dot", "\\dot\\varphi", "the velocity of the placement"),
    of("phi_dot_#", "phi_dot_#", "\\dot\\varphi_{#}", "its entries"),
    whole("Omega", "\\Omega", "the affine velocity dphi/dt phi^-1"),
    of("omega_#", "omega_#", "\\Omega_{#}", "its entries"),
    whole("Omega_hat", "\\hat\\Omega", "the co-moving affine velocity phi^-1 dphi/dt"),
    of("omega_hat_#", "omega_hat_#", "\\hat\\Omega_{#}", "its entries"),
    // Momenta.
    whole("p", "p", "the linear momentum"),
    of("p_#", "p_#", "p_{#}", "its components; momenta of stretches in the two-polar form"),
    whole("p_hat", "\\hat p", "the co-moving linear momentum phi^T p"),
    of("p_hat_#", "p_hat_#", "\\hat p_{#}", "its components"),
    of(
        "body_p_#",
        "p_body_#",
        "p_{\\mathrm{body},#}",
        "the share of the mass in the body, phi^-T m_body v_hat",
    ),
    whole("Pi", "\\Pi", "the canonical affine momentum"),
    of("pi_#", "pi_#", "\\Pi_{#}", "its entries"),
    whole("Sigma", "\\Sigma", "the affine spin phi Pi"),
    of("sigma_#", "sigma_#", "\\Sigma_{#}", "its entries"),
    whole("Sigma_hat", "\\hat\\Sigma", "the co-moving affine spin Pi phi"),
    of("sigma_hat_#", "sigma_hat_#", "\\hat\\Sigma_{#}", "its entries"),
    whole("I", "I", "the total affine momentum I(O) = x p^T + Sigma"),
    whole("O", "O", "the origin, in I(O)"),
    of("total_#", "I_#", "I_{#}", "entries of the total affine momentum"),
    whole("S", "S", "the spin Sigma - Sigma^T"),
    whole("Vort", "V", "the vorticity Sigma_hat - Sigma_hat^T"),
    whole("X", "X", "the affine spin of the energy in the body; any matrix, beside P"),
    whole("Y", "Y", "the affine spin of the energy in space, seen from the body"),
    whole("Z", "Z", "the affine spin of the energy in dphi/dt, seen from the body"),
    // Deformation.
    whole("G", "G", "the Green deformation tensor phi^T phi"),
    of("green_#", "G_#", "G_{#}", "its entries"),
    of("finger_#", "Ct_#", "\\tilde C_{#}", "entries of phi phi^T"),
    applied(of("trace_1", "tr(G)", "\\operatorname{tr}G", "the trace of G")),
    applied(of("trace_2", "tr(G^2)", "\\operatorname{tr}G^2", "the trace of G^2")),
    applied(of("trace_3", "tr(G^3)", "\\operatorname{tr}G^3", "the trace of G^3")),
    of("green_square_#", "G2_#", "[G^2]_{#}", "entries of G^2"),
    of("finger_square_#", "Ct2_#", "[\\tilde C^2]_{#}", "entries of Ct^2"),
    of("second_invariant", "I2", "I_{2}", "the second invariant ((tr G)^2 - tr G^2)/2"),
    of("isochoric_excess", "w_bar", "\\bar w", "tr(G/D^2) - n"),
    of("mean_square", "tau", "\\tau", "the n-th part of tr(G/D^2)"),
    of(
        "isochoric_deviator_squared",
        "tr(B_bar^2)",
        "\\operatorname{tr}\\bar B^2",
        "the trace of the square of the deviator of G/D^2",
    ),
    of("isochoric_deviator_#", "B_bar_#", "\\bar B_{#}", "entries of that deviator"),
    applied(of("det", "det", "\\det\\varphi", "the determinant of phi")),
    of("dilatation", "D", "D", "the mean stretch det^(1/n)"),
    of("q", "q", "q", "the mean logarithmic stretch ln D"),
    of("inverse_tensor_#", "K_#", "K_{#}", "entries of the inverse of G, or of Ct"),
    of("inverse_strain_#", "E_#", "E_{#}", "entries of 1 - G^-1, or of 1 - Ct^-1"),
    of("stretch_#", "Q_#", "Q_{#}", "the stretches, singular values of phi"),
    whole("Q_a", "Q_{a}", "one of them"),
    of("q_#", "q_#", "q_{#}", "the logarithmic stretches ln Q_a"),
    whole("e_a", "e_{a}", "the principal axes in the body, G e_a = Q_a^2 e_a"),
    of("axis_#", "e_#", "e_{#}", "their components"),
    whole("f_a", "f_{a}", "phi e_a"),
    of("stretched_#", "f_#", "f_{#}", "its components"),
    of("unit_green_#", "G_bar_#", "\\bar G_{#}", "entries of G/D^2"),
    of("unit_finger_#", "Ct_bar_#", "\\bar{\\tilde C}_{#}", "entries of Ct/D^2"),
    applied(of("unit_trace_1", "tr(G_bar)", "\\operatorname{tr}\\bar G", "the trace of G/D^2")),
    applied(of("unit_trace_2", "tr(G_bar^2)", "\\operatorname{tr}\\bar G^2", "the trace of its square")),
    applied(of("unit_trace_3", "tr(G_bar^3)", "\\operatorname{tr}\\bar G^3", "the trace of its cube")),
    of("unit_green_square_#", "G2_bar_#", "[\\bar G^2]_{#}", "entries of the square of G/D^2"),
    of("unit_finger_square_#", "Ct2_bar_#", "[\\bar{\\tilde C}^2]_{#}", "entries of the square of Ct/D^2"),
    whole("G_bar", "\\bar G", "the Green deformation tensor of phi/D"),
    of("psi_#", "Psi_#", "\\Psi_{#}", "entries of phi/D"),
    of(
        "cofactor_#",
        "cof_#",
        "\\operatorname{cof}_{#}",
        "cofactors of phi/D, or of phi where D is not carried",
    ),
    of("isochoric_#", "O_#", "O_{#}", "entries of the isochoric velocity s + w"),
    of("shear_#", "s_#", "s_{#}", "its symmetric part"),
    of("turn_#", "w_#", "w_{#}", "its skew part"),
    of("m_#", "m_#", "M_{#}", "the coupling of stretches (spin and vorticity), in the two-polar form"),
    of("n_#", "n_#", "N_{#}", "the other one"),
    // Energies and forces.
    whole("T", "T", "the kinetic energy"),
    whole("T_int", "T_{\\mathrm{int}}", "that of the internal motion"),
    whole("T_body", "T_{\\mathrm{body}}", "the terms in Omega_hat"),
    whole("T_space", "T_{\\mathrm{space}}", "the terms in Omega"),
    whole("T_flat", "T_{\\mathrm{flat}}", "the terms in dphi/dt"),
    whole("H", "H", "the Hamiltonian"),
    whole("U", "U", "the potential"),
    whole("R", "R", "Rayleigh's dissipation function"),
    of("work", "work", "W", "the work of the forces that no potential has"),
    whole("F", "F", "the force on p"),
    whole("F_hat", "\\hat F", "the force on p_hat"),
    whole("Q", "Q", "the force on Sigma"),
    whole("Q_hat", "\\hat Q", "the force on Sigma_hat"),
    whole("N", "N", "the force on Pi"),
    whole("P", "P", "the projection on the Lie algebra of a constraint"),
    whole("Lambda", "\\Lambda", "the multiplier of a constraint"),
    of("drag_#", "Q_R_#", "Q_{R,#}", "the part of Q that R has in space"),
    of("drag_hat_#", "Q_hat_R_#", "\\hat Q_{R,#}", "the part of Q_hat that R has in the body"),
    of("drag_flat_#", "N_flat_#", "N_{\\mathrm{flat},#}", "the part of N that R has in dphi/dt"),
    of("push_#", "N_R_#", "N_{R,#}", "the part of N that R has in other frames than that of the chart"),
    of("drag_centre_#", "F_R_#", "F_{R,#}", "the force of R on the centre of mass"),
    // The response of a potential: Q_hat = beta_0 1 + beta_1 G + beta_2 G^2 and its like.
    of("raised_#", "zeta_#", "\\zeta_{#}", "sums that the potential raises to a power"),
    of("pressure", "beta_0", "\\beta_{0}", "the response to q, -1/n dU/dq"),
    of(
        "stress_#",
        "beta_#",
        "\\beta_{#}",
        "the response to tr(G), tr(G^2) and tr(G^3), -2, -4 and -6 times the slope of U",
    ),
    of("piola_#", "PK_#", "\\mathsf{S}_{#}", "entries of the second Piola-Kirchhoff tensor, as in the force"),
    of("slope_green_#", "beta_G_#", "\\beta_{G_{#}}", "the response to an entry of G"),
    of("slope_finger_#", "beta_Ct_#", "\\beta_{\\tilde C_{#}}", "the response to an entry of Ct"),
    of("slope_phi_#", "beta_phi_#", "\\beta_{\\varphi_{#}}", "the response to an entry of phi"),
    of("slope_x_#", "beta_x_#", "\\beta_{x_{#}}", "the response to a component of x"),
    of("pulled_back_#", "x_hat_#", "\\hat x_{#}", "the position pulled back to the body, phi^T x"),
    of("pushed_forward_#", "chi_#", "\\chi_{#}", "components of Ct x = phi x_hat"),
    applied(of("pulled_back_square", "|x_hat|^2", "|\\hat x|^2", "its square, x . Ct x")),
    of("slope_pulled_back", "beta_x_hat", "\\beta_{\\hat x}", "the response to it, -2 times the slope of U"),
    of("weighted_#", "xi_#", "\\xi_{#}", "that times x, or times x_hat in the body"),
    of("tension_#", "tau_#", "\\tau_{#}", "the response to q_a; over Q_a^2 where it stands at f_a"),
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
    whole("A", "A", "the factor of the metric of space, g = A^T A"),
    whole("B", "B", "the factor of the metric of the body, eta = B^T B"),
    of("pivot_centre_a_#", "d_#", "d_{#}", "pivots of the mass matrix of the centre, L diag(d) L^T"),
    of("lower_centre_a_#", "L_#", "L_{#}", "its lower factor L"),
    of("rest_centre_a_#", "u_#", "u_{#}", "entries of diag(d) L^T"),
    of("forward_centre_a_#", "y_#", "y_{#}", "the solution of L y = p_hat"),
    of("backward_centre_a_#", "z_#", "z_{#}", "a component of the solution of L^T z = y/d"),
];

/// Symbols of the derivation that are powers of others, or others themselves.
const POWERS: &[(&str, &str, i32)] = &[
    ("velocity_#", "phi_dot_#", 1),
    ("unit_phi_#", "psi_#", 1),
    ("inverse_dilatation", "dilatation", -1),
    ("square", "dilatation", 2),
    ("inverse_square", "dilatation", -2),
    ("inverse_det", "det", -1),
    ("inverse_stretch_#", "stretch_#", -1),
    ("inverse_pivot_centre_a_#", "pivot_centre_a_#", -1),
];

/// Symbols of the derivation that formulas write out.
const WRITTEN_OUT: &[&str] = &["swelling"];

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
pub(super) fn written(name: &str) -> Option<[Written; 2]> {
    let (symbol, index) = SYMBOLS.iter().find_map(|symbol| Some((symbol, index(symbol.stem?, name)?)))?;
    let filled = |template: &str| template.replace('#', index);
    Some([Written::letter(filled(symbol.text)), Written { body: filled(symbol.latex), shape: symbol.shape }])
}

/// The symbol that another is a power of, and the exponent.
pub(super) fn power(name: &str) -> Option<(String, i32)> {
    let found = |(template, base, exponent): &(&str, &str, i32)| {
        index(template, name).map(|index| (base.replace('#', index), *exponent))
    };
    POWERS.iter().find_map(found)
}

/// Do formulas write out what it stands for?
pub(super) fn is_written_out(name: &str) -> bool {
    WRITTEN_OUT.contains(&name)
}

/// Is a word of a formula a symbol, a differential of one, or a function?
#[must_use]
pub fn is_symbol(word: &str) -> bool {
    let is_one = |word: &str| SYMBOLS.iter().any(|symbol| index(symbol.text, word).is_some());
    FUNCTIONS.contains(&word) || is_one(word) || word.strip_prefix('d').is_some_and(is_one)
}

/// Is a letter of LaTeX a symbol, or where entries are asked for that of a matrix or vector?
pub(super) fn is_letter(latex: &str, entries: bool) -> bool {
    let entry = format!("{latex}_{{#}}");
    SYMBOLS.iter().any(|symbol| symbol.latex == latex || (entries && symbol.latex == entry))
}
