//! Names that textbooks have and the specification language has not, and what is written for them.

/// Names of quantities of a potential.
const QUANTITIES: [(&[&str], &str); 11] = [
    (&["J"], "write `det` for det phi"),
    (&["F"], "write `phi` for the deformation gradient"),
    (
        &["C"],
        "write `G` for the right Cauchy-Green tensor phi^T phi, or `Ct^-1` for the Cauchy deformation tensor, as in `tr(Ct^-1)`",
    ),
    (&["B", "b"], "write `Ct` for the left Cauchy-Green tensor phi phi^T"),
    (
        &["E"],
        "write `(G - 1)/2` for the Green strain: tr(E^2) is `tr((G - 1)^2)/4`, its entries are `(G[1,1] - 1)/2` and `G[1,2]/2`",
    ),
    (&["I", "Id", "eye", "identity"], "write `1` for the identity in a trace, as in `tr((G - 1)^2)`"),
    (&["T"], TRANSPOSED),
    (&["I1bar", "I1_bar", "Ibar1", "J1"], "write `tr(G)*det^(-2/n)` for the first isochoric invariant"),
    (&["I2bar", "I2_bar", "Ibar2", "J2"], "write `I2*det^(-4/n)` for the second isochoric invariant"),
    (&["U", "V"], "write `Q1 + Q2 + Q3` for the trace of a stretch tensor, or `Q1 + Q2` for n = 2"),
    (
        &["lambda1", "lambda2", "lambda3", "lambda_1", "lambda_2", "lambda_3"],
        "write `Q1`, `Q2` and `Q3` for the stretches",
    ),
];

/// Names of functions, with those that programming languages have.
const FUNCTIONS: [(&[&str], &str); 17] = [
    (&["exp2"], "write `exp(a*ln(2))`"),
    (&["dev"], "write `G - tr(G)/n` in a trace, as in `tr((G - tr(G)/n)^2)`"),
    (
        &["max", "min"],
        "use a smooth function: the force is the derivative of the potential, and jumps at a kink",
    ),
    (&["log10"], "write `ln(a)/ln(10)`"),
    (&["log2"], "write `ln(a)/ln(2)`"),
    (&["ln_1p", "ln1p"], "write `log1p(a)`, which is `ln(1 + a)`"),
    (&["exp_m1"], "write `expm1(a)`, which is `exp(a) - 1`"),
    (&["trace", "Tr"], "write `tr(..)`"),
    (&["pow", "powi", "powf"], "write `a^b`, with `^` for powers"),
    (&["det", "determinant"], "write `det` alone for det phi; det G = det Ct is `det^2`"),
    (&["cbrt"], "write `exp(ln(a)/3)`, of what is positive; the cube root of det phi is `D` for n = 3"),
    (&["inv", "inverse", "try_inverse"], "write `G^-1` in a trace, as in `tr(G^-1)`"),
    (&["transpose"], TRANSPOSED),
    (
        &["asin", "acos", "atan", "arcsin", "arccos", "arctan", "atan2"],
        "use one of these, none of which is the inverse of `sin`, `cos` or `tan`, or a potential that a field computes, `custom(field, general)`",
    ),
    (&["asinh", "arsinh", "arcsinh"], "write `ln(a + sqrt(a^2 + 1))`"),
    (&["acosh", "arcosh", "arccosh"], "write `ln(a + sqrt(a^2 - 1))`"),
    (&["atanh", "artanh", "arctanh"], "write `ln((1 + a)/(1 - a))/2`"),
];

/// What is written for a transpose.
const TRANSPOSED: &str =
    "write `G` for phi^T phi and `Ct` for phi phi^T: a transpose stands in no other place";

/// What to write for the name of a quantity.
pub(crate) fn quantity(name: &str) -> Option<&'static str> {
    instead(&QUANTITIES, name)
}

/// What to write for the name of a function.
pub(super) fn function(name: &str) -> Option<&'static str> {
    instead(&FUNCTIONS, name)
}

fn instead(table: &[(&[&str], &'static str)], name: &str) -> Option<&'static str> {
    table.iter().find(|(names, _)| names.contains(&name)).map(|(_, instead)| *instead)
}
