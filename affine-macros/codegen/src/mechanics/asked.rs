//! What a model can be asked for.

/// What is asked for besides the equations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Asked {
    /// The two-polar form.
    pub two_polar: bool,
    /// Its equations in ratios of stretches.
    pub ratios: bool,
    /// The exact flows of pieces of the Hamiltonian.
    pub splitting: bool,
    /// The equations as `q'' = f(t, q)`.
    pub nystrom: bool,
    /// The Taylor coefficients of a motion.
    pub taylor: bool,
    /// The variational equations.
    pub tangent: bool,
    /// The configuration metric and its inverse.
    pub metric: bool,
    /// The acceleration of the centre of mass.
    pub acceleration: bool,
    /// The balance laws of a d'Alembert model.
    pub balance: bool,
    /// The formulas of the description in LaTeX, beside plain text.
    pub latex: bool,
}
