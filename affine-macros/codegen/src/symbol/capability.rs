//! What a model can be asked for.

/// Something that is emitted only when asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Capability {
    /// The exact flows of pieces of the Hamiltonian.
    Splitting,
    /// The Taylor coefficients of a motion.
    Taylor,
    /// The equations as `q'' = f(t, q)`: velocities of momenta and forces of positions, apart.
    Nystrom,
    /// The two-polar form, a lattice.
    TwoPolar,
    /// Its equations in ratios of stretches.
    Ratios,
    /// The variational equations.
    Tangent,
    /// SIMD lanes.
    Lanes,
    /// The configuration metric and its inverse.
    Metric,
    /// The acceleration of the centre of mass.
    Acceleration,
    /// The balance laws of the kinematical spin, of a d'Alembert model.
    Balance,
    /// The formulas of the description in LaTeX, beside plain text.
    Latex,
}

/// What is asked for besides the equations: a bit for each capability.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Asked(u32);

impl Asked {
    /// Is it asked for?
    pub fn has(self, capability: Capability) -> bool {
        self.0 & bit(capability) != 0
    }

    /// The same, with or without one of them.
    pub fn with(self, capability: Capability, asked: bool) -> Self {
        Self(if asked { self.0 | bit(capability) } else { self.0 & !bit(capability) })
    }
}

impl FromIterator<Capability> for Asked {
    fn from_iter<I: IntoIterator<Item = Capability>>(list: I) -> Self {
        list.into_iter().fold(Self::default(), |asked, capability| asked.with(capability, true))
    }
}

const fn bit(capability: Capability) -> u32 {
    1 << capability as u32
}
