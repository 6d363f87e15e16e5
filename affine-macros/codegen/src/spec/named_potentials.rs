//! Potentials with a name: short for an expression of the language.

/// `name(parameters)`, read as its formula with the arguments in place of the parameters.
///
/// | name | U | what it is |
/// |---|---|---|
/// | `hyperbolic_dilatation(kappa)` | `kappa/2 sinh(q)^2 = kappa/8 (D^2 + D^-2 - 2)` | binds the dilatation for q -> -inf and +inf; like `harmonic_dilatation` near q = 0 (section 5) |
/// | `harmonic_dilatation(kappa)` | `kappa/2 q^2` | Hooke's law in the mean logarithmic stretch (section 5) |
/// | `dissociation(kappa)` | `-kappa/2 / cosh(q)^2 = kappa/2 (tanh(q)^2 - 1)` | a well of depth kappa/2: beyond it the body expands or collapses freely (section 5) |
/// | `neo_hookean(c)` | `c (tr(G) det^(-2/n) - n)` | shear only: unchanged by a dilatation, zero on rotations; Rivlin, Phil. Trans. R. Soc. A 240 (1948) 459, in its isochoric form |
/// | `saint_venant_kirchhoff(lambda, mu)` | `lambda/2 tr(E)^2 + mu tr(E^2)`, `E = (G - 1)/2` | linear in the Green strain E, finite at det = 0; Ciarlet, Mathematical Elasticity I (1988) |
/// | `orthogonality(k)` | `k tr((G - 1)^2)` | penalty that keeps phi near the rotations and reflections (affine body dynamics, Lan et al., ACM Trans. Graph. 41 (2022) 67) |
/// | `gas(k)` | `k exp(-2 q) = k det^(-2/n)` | internal energy of a monatomic gas under adiabatic change: volume^(1 - gamma) with gamma = 1 + 2/n |
#[derive(Clone, Copy, Debug)]
pub struct NamedPotential {
    /// Its name.
    pub name: &'static str,
    /// Its parameters, each once in the formula.
    pub parameters: &'static [&'static str],
    /// The formula in the language of the potentials.
    pub formula: &'static str,
}

/// All of them.
pub const NAMED_POTENTIALS: [NamedPotential; 7] = [
    NamedPotential { name: "hyperbolic_dilatation", parameters: &["kappa"], formula: "kappa/2*sinh(q)^2" },
    NamedPotential { name: "harmonic_dilatation", parameters: &["kappa"], formula: "kappa/2*q^2" },
    NamedPotential { name: "dissociation", parameters: &["kappa"], formula: "-kappa/2/cosh(q)^2" },
    // det^(-2/n) = exp(-2q): finite where det itself over- or underflows.
    NamedPotential { name: "neo_hookean", parameters: &["c"], formula: "c*(tr(G)*exp(-2*q) - n)" },
    // tr E = (tr G - n)/2, tr(E^2) = (tr(G^2) - 2 tr G + n)/4.
    NamedPotential {
        name: "saint_venant_kirchhoff",
        parameters: &["lambda", "mu"],
        formula: "lambda/8*(tr(G) - n)^2 + mu/4*(tr(G*G) - 2*tr(G) + n)",
    },
    NamedPotential { name: "orthogonality", parameters: &["k"], formula: "k*(tr(G*G) - 2*tr(G) + n)" },
    NamedPotential { name: "gas", parameters: &["k"], formula: "k*exp(-2*q)" },
];
