//! Random models: kinetic energies of every family with random potentials, friction, forces and constraints.

use affine_oracle::Random;

use super::super::models::{FAMILIES, Internal, Sample, TRANSLATIONS, Translation, literal};
use super::super::points::fraction;

/// A model as its user writes it.
#[derive(Clone, Debug)]
pub(super) struct Drawn {
    pub(super) args: String,
}

/// What the forces of a model look the same under.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Forces {
    /// None.
    Free,
    /// Functions of `q`.
    Dilatational,
    /// `U_dil(q) + U_sh(Psi)`, whose dilatation moves by itself.
    Separable,
    /// Functions of the invariants of `G`.
    Isotropic,
    /// Functions of single stretches.
    Stretches,
    /// Functions of `G`, of `Ct`, of entries of `phi`.
    Green,
    Finger,
    Placement,
    /// Functions of `|x|` and of `x`, alone and with the placement.
    Radial,
    Centre,
    Coupled,
    /// Friction with one frame, of all velocities, of the centre alone.
    Damped,
    Viscous,
    Dragged,
    /// What a field computes: potentials of each class, forces of each form.
    Computed(&'static str),
}

pub(super) const FORCES: [Forces; 22] = [
    Forces::Free,
    Forces::Dilatational,
    Forces::Separable,
    Forces::Isotropic,
    Forces::Stretches,
    Forces::Green,
    Forces::Finger,
    Forces::Placement,
    Forces::Radial,
    Forces::Centre,
    Forces::Coupled,
    Forces::Damped,
    Forces::Viscous,
    Forces::Dragged,
    Forces::Computed("isotropic"),
    Forces::Computed("green"),
    Forces::Computed("finger"),
    Forces::Computed("general"),
    Forces::Computed("isotropic, position"),
    Forces::Computed("spatial"),
    Forces::Computed("comoving"),
    Forces::Computed("translation"),
];

impl Forces {
    /// Do they act on a centre of mass alone, or tell where it is?
    fn need_a_centre(self) -> bool {
        matches!(self, Self::Radial | Self::Centre | Self::Coupled | Self::Dragged)
            || matches!(self, Self::Computed("isotropic, position" | "translation"))
    }

    /// Are they computed by functions that a program calls?
    pub(super) fn call_the_runtime(self) -> bool {
        matches!(self, Self::Stretches | Self::Computed(_))
    }

    /// Do they move a body whose energy is written so?
    pub(super) fn act_on(self, energy: &str) -> bool {
        let of_velocities = matches!(self, Self::Damped | Self::Viscous | Self::Dragged)
            || matches!(self, Self::Computed("spatial" | "comoving" | "translation"));
        let strains =
            matches!(self, Self::Separable | Self::Isotropic | Self::Stretches | Self::Green | Self::Finger);
        match self {
            _ if self.need_a_centre() && !energy.contains("translation") => false,
            // The velocity is no linear function of the momentum.
            Self::Computed(_) => !energy.contains("casimir3"),
            _ if of_velocities => !energy.contains("casimir3"),
            Self::Dilatational => !energy.contains("isochoric") && !energy.contains("rigid"),
            _ => !(strains && energy.contains("rigid")),
        }
    }

    /// What stands in the attribute.
    fn written(self, random: &mut Random, n: usize, energy: &str) -> String {
        let c = positive(random);
        let translates = energy.contains("translation");
        let confined = energy.contains("constraint");
        let potential = |terms: &[&str], random: &mut Random| {
            let one = terms[chosen(random, terms.len())];
            let other = terms[chosen(random, terms.len())];
            let time = ["", "", "", "*(2 + cos(3*t))"][chosen(random, 4)];
            let number = positive(random);
            format!(", potential = {c}*({one}){time} + {number}*({other})")
        };
        match self {
            Self::Free => String::new(),
            Self::Dilatational => potential(
                &["q^2", "sinh(q)^2", "det^2 - det", "cosh(2*q) + 1/D", "ln(det)^2", "tanh(q)"],
                random,
            ),
            Self::Separable => {
                let dilatational = ["q^2/2", "sinh(q)^2", "0"][chosen(random, 3)];
                let shear = ["tr(G)*exp(-2*q)", "exp(-4*q)*tr(G*G) + tr(G)^2*exp(-4*q)"][chosen(random, 2)];
                let fibre = ["", "", " + G[1,1]*exp(-2*q)", " + Ct[1,2]*exp(-2*q)"][chosen(random, 4)];
                format!(", potential = {c}*({dilatational}) + {shear}{fibre}")
            }
            Self::Isotropic => {
                let terms =
                    ["tr(G)", "tr(G)^2", "tr(G*G)", "tr(G)*exp(-2*q)", "tr(G)*q", "exp(tr(G)/4)", "1/tr(G)"];
                potential(&[&terms[..], &["I2 + q", "tr(G) - 2*ln(det)"]].concat(), random)
            }
            Self::Stretches => {
                let terms = match n {
                    2 => ["q1^2 + q2^2", "Q1 + Q2", "pairs(cosh(d))", "exp(2*q1) + exp(2*q2)"],
                    _ => ["q1^2 + q2^2 + q3^2", "Q1 + Q2 + Q3", "pairs(cosh(d))", "pairs(d^2)"],
                };
                potential(&terms, random)
            }
            Self::Green => potential(&["G[1,1]", "G[1,2]^2", "G[2,2]*q", "G[1,1]*tr(G)"], random),
            Self::Finger => potential(&["Ct[1,1]", "Ct[1,2]^2", "Ct[2,2]*q", "Ct[1,1]*tr(G)"], random),
            Self::Placement => {
                potential(&["phi[1,2]", "phi[1,1]^2", "phi[2,1]*tr(G)", "sin(phi[2,2])"], random)
            }
            Self::Radial => potential(&["norm(x)^2", "norm(x)", "-1/norm(x)", "exp(norm(x)^2)"], random),
            Self::Centre => potential(&["x[1]", "x[2]^2", "x[1]*x[2]", "cos(x[1])"], random),
            Self::Coupled => potential(
                &["x[1]*phi[1,2]", "x[2]*tr(G)", "norm(x)^2*q", "norm(x)*G[1,1]", "x[1]^2 + Ct[1,1]"],
                random,
            ),
            Self::Damped => {
                let affine = ["body_inertia", "space_inertia", "dalembert"][chosen(random, 3)];
                format!(", dissipation({affine} = {c}){}", under(random, confined))
            }
            Self::Viscous => {
                let centre =
                    if translates { [", space_translation = 2", ", body_translation = 3"] } else { [""; 2] };
                let (centre, matrix) = (centre[chosen(random, 2)], (1..=n).map(|k| k.to_string()));
                let matrix = matrix.collect::<Vec<_>>().join(", ");
                let other = ["space_inertia", "body_inertia"][chosen(random, 2)];
                let casimir = if confined { "" } else { "casimir1_squared = 3/2, " };
                format!(", dissipation({casimir}{other} = diag({matrix}){centre}){}", under(random, confined))
            }
            Self::Dragged => {
                let centre = ["space_translation", "body_translation"][chosen(random, 2)];
                format!(", dissipation({centre} = {c}){}", under(random, confined))
            }
            Self::Computed(role @ ("spatial" | "comoving" | "translation")) => {
                format!(", forces = custom(f, {role}){}", under(random, confined))
            }
            Self::Computed(class) => {
                let beside = if confined { ["", " + phi[1,2]", ""] } else { ["", " + q^2", " + tr(G)"] };
                let beside = beside[chosen(random, 3)];
                match class == "isotropic" && n == 3 && chosen(random, 2) == 1 {
                    true => format!(", potential = self_gravity({c}){beside}"),
                    false => format!(", potential = custom(f, {class}){beside}"),
                }
            }
        }
    }
}

/// A potential beside other forces, or none.
fn under(random: &mut Random, confined: bool) -> &'static str {
    match confined {
        false => ["", ", potential = tr(G)", ", potential = sinh(q)^2 + G[1,1]"][chosen(random, 3)],
        true => ["", ", potential = phi[1,2]"][chosen(random, 2)],
    }
}

fn chosen(random: &mut Random, count: usize) -> usize {
    usize::try_from(random.integer(0, count as i64 - 1)).unwrap()
}

fn positive(random: &mut Random) -> String {
    format!("{}/{}", random.integer(1, 9), random.integer(1, 7))
}

/// The field that computes, beside fields for numbers.
pub(super) const ITEM: &str = "struct Model { a: f64, b: f64, i: f64, m: f64, f: Computed }";

impl Drawn {
    /// A model of a family, its numbers written out or fields; `None` where it has no centre for forces on one.
    pub(super) fn of_family(
        random: &mut Random,
        n: usize,
        (internal, translation): (Internal, Translation),
        forces: Forces,
    ) -> Option<Self> {
        let sample = Sample::new(random, n, internal, translation);
        let args = if random.integer(0, 3) == 0 { sample.with_fields().0 } else { sample.args.clone() };
        forces.act_on(&args).then(|| Self { args: format!("{args}{}", forces.written(random, n, &args)) })
    }

    /// A model from its energy as written, under a constraint or not.
    pub(super) fn stated(random: &mut Random, n: usize, energy: &str, forces: Forces) -> Self {
        Self { args: format!("dim = {n}, {energy}{}", forces.written(random, n, energy)) }
    }
}

/// Every family with every translation.
pub(super) fn families() -> Vec<(Internal, Translation)> {
    FAMILIES
        .into_iter()
        .flat_map(|internal| TRANSLATIONS.map(|translation| (internal, translation)))
        .collect()
}

/// Energies that no family has: on momenta, and under each constraint.
pub(super) fn energies(random: &mut Random, n: usize) -> Vec<String> {
    let mut number = || literal(&fraction(random));
    let [a, b, c] = [number(), number(), number()];
    let translations = ["", ", body_translation = 2", ", space_translation = 3/2"];
    let diagonal = &"1, 2, 3"[..3 * n - 2];
    let mut list = Vec::new();
    for translation in translations {
        for norm in ["vorticity_squared", "spin_squared"] {
            list.push(format!(
                "hamiltonian(casimir2 = {a}, casimir1_squared = {b}, {norm} = {c}{translation})"
            ));
            if n == 3 {
                list.push(format!("hamiltonian(casimir2 = {a}, {norm} = {c}, casimir3 = {b}{translation})"));
            }
        }
        list.push(format!("hamiltonian(casimir2 = {a}, casimir1_squared = {b}{translation})"));
        for group in ["isochoric", "rigid", "conformal"] {
            let inertias = [
                "casimir2 = 1/5, body_inertia = 1".to_owned(),
                "casimir2 = 1/5, space_inertia = 1".to_owned(),
                "casimir2 = 1/5".to_owned(),
                format!("casimir2 = 1/5, body_inertia = diag({diagonal})"),
                format!("space_inertia = diag({diagonal})"),
                "dalembert = 2".to_owned(),
                format!("dalembert = diag({diagonal})"),
            ];
            // On SL(n) the masses of d'Alembert are a matrix that depends on the placement.
            let has_one_frame = |inertia: &String| group != "isochoric" || !inertia.contains("dalembert");
            let inertias = inertias.into_iter().filter(has_one_frame);
            list.extend(
                inertias.map(|inertia| format!("constraint = {group}, kinetic({inertia}{translation})")),
            );
        }
    }
    list
}

/// Energies whose mass matrix depends on the placement.
pub(super) const SUMS: [&str; 10] = [
    "kinetic(dalembert = 2, casimir2 = 1/5, space_translation = 1)",
    "kinetic(dalembert = 2, body_inertia = 1/5, body_translation = 1)",
    "kinetic(body_inertia = 1, space_inertia = 2)",
    "kinetic(casimir2 = 1/5, body_inertia = 1, body_translation = 1, space_translation = 2)",
    "kinetic(casimir2 = 1/5, space_inertia = 1, body_translation = 1, space_translation = 2)",
    "kinetic(dalembert = 3, body_translation = 1, space_translation = 2)",
    "constraint = rigid, kinetic(dalembert = 2, space_inertia = 1, space_translation = 2)",
    "kinetic(dalembert = 2, casimir2 = 1/5)",
    "constraint = isochoric, kinetic(dalembert = 2)",
    "constraint = isochoric, kinetic(dalembert = 1, space_translation = 3/2)",
];
