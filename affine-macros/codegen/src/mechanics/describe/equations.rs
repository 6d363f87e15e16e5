//! Affine velocity and Hamilton's equations, by matrices where a known form holds.

use super::hamiltonian::trace_coefficient;
use super::known_forms::known_forms;
use super::{Formula, Sum, momentum_names, velocity_names};
use crate::algebra::{Arena, Expr, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Linear, Momentum};
use crate::mechanics::constraint::Constraint;
use crate::mechanics::equations::{Form, gradient, rate, velocities};
use crate::mechanics::forces::Forces;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::notation::{latex, plain};
use crate::mechanics::potential::Potential;

/// Affine velocity and Hamilton's equations: as matrices where the known forms hold, by components otherwise.
/// A potential adds its generalised force, named.
pub fn equations(
    arena: &mut Arena,
    h: &Hamiltonian,
    chart: &Chart,
    full: &Polynomial,
    potential: Option<&Potential>,
    forces: &Forces,
) -> Vec<Formula> {
    let velocity = velocities(arena, chart, full);
    let slopes = gradient(chart, full);
    // A tensor's velocity stays a symbol: written out, nothing in its commutators cancels.
    let form = if h.is_tensor() { Form::ThroughVelocity } else { Form::Expanded };
    let known = known_forms(h, chart, &velocity, form);
    // For the canonical momentum the velocity is the rate of phi itself.
    let mut list = match chart.momentum {
        Momentum::Canonical => Vec::new(),
        _ => vec![affine_velocity(arena, h, chart)],
    };
    let groups: [(&str, &str, Vec<Coordinate>); 4] = [
        ("dx/dt", "\\dot x", (0..chart.x.len()).map(Coordinate::X).collect()),
        ("dphi/dt", "\\dot\\varphi", pairs(chart.dim, Coordinate::Phi)),
        (
            if chart.linear == Some(Linear::Body) { "dp_hat/dt" } else { "dp/dt" },
            if chart.linear == Some(Linear::Body) { "\\dot{\\hat p}" } else { "\\dot p" },
            (0..chart.p.len()).map(Coordinate::P).collect(),
        ),
        (momentum_names(chart.momentum).2, momentum_names(chart.momentum).3, pairs(chart.dim, Coordinate::M)),
    ];
    let names = force_names(h, chart, potential, forces);
    for (left, left_latex, coordinates) in groups.into_iter().filter(|(_, _, c)| !c.is_empty()) {
        let derived: Vec<Polynomial> =
            coordinates.iter().map(|z| rate(chart, &slopes, &velocity, form, *z)).collect();
        let known = known.iter().find(|k| {
            k.components.len() == derived.len() && k.components.iter().zip(&derived).all(|(a, b)| a == b)
        });
        let force = match coordinates[0] {
            Coordinate::P(_) => names[0].as_ref(),
            Coordinate::M(..) => names[1].as_ref(),
            Coordinate::X(_) | Coordinate::Phi(..) | Coordinate::Carried(_) => None,
        };
        match (known, force) {
            (Some(k), None) => list.push(Formula {
                text: format!("{left} = {}", k.text),
                latex: format!("{left_latex} = {}", k.latex),
            }),
            (Some(k), Some((name, name_latex, ..))) => {
                let with = |kinetic: &str, force: &str| match kinetic {
                    "0" => force.to_owned(),
                    _ => format!("{kinetic} + {force}"),
                };
                list.push(Formula {
                    text: format!("{left} = {}", with(&k.text, name)),
                    latex: format!("{left_latex} = {}", with(&k.latex, name_latex)),
                });
            }
            (None, Some((name, name_latex, ..))) => {
                list.extend(coordinates.iter().zip(&derived).map(|(z, p)| {
                    let symbol = chart.symbol(*z);
                    let form = p.expression(arena);
                    let index = index_of(arena, symbol);
                    Formula {
                        text: format!(
                            "d{}/dt = {} + {name}_{index}",
                            plain(arena, symbol),
                            plain(arena, form)
                        ),
                        latex: format!(
                            "\\dot{{{}}} = {} + {name_latex}_{{{index}}}",
                            latex(arena, symbol),
                            latex(arena, form)
                        ),
                    }
                }));
            }
            (None, None) => list.extend(coordinates.iter().zip(&derived).map(|(z, p)| {
                let symbol = chart.symbol(*z);
                let form = p.expression(arena);
                Formula {
                    text: format!("d{}/dt = {}", plain(arena, symbol), plain(arena, form)),
                    latex: format!("\\dot{{{}}} = {}", latex(arena, symbol), latex(arena, form)),
                }
            })),
        }
    }
    for (name, name_latex, definition) in names.into_iter().flatten() {
        list.push(Formula {
            text: format!("{name} = {}", definition.text),
            latex: format!("{name_latex} = {}", definition.latex),
        });
    }
    list.extend(forces.formulas(arena));
    match h.constraint {
        Some(group) => under_constraint(h, group, list),
        None => list,
    }
}

/// The equations with what a constraint makes of the rate of the affine momentum: a projection, or a multiplier.
fn under_constraint(h: &Hamiltonian, group: Constraint, mut list: Vec<Formula>) -> Vec<Formula> {
    let momentum = Momentum::of(h.frame);
    let (_, _, rate, rate_latex) = momentum_names(momentum);
    let (left, left_latex) = (format!("{rate} = "), format!("{rate_latex} = "));
    let mut projects = false;
    for formula in &mut list {
        let (Some(text), Some(latex)) =
            (formula.text.strip_prefix(&left), formula.latex.strip_prefix(&left_latex))
        else {
            continue;
        };
        if h.confined().is_none() {
            let (text, latex) = if text == "0" { ("", "") } else { (text, latex) };
            let plus = if text.is_empty() { "" } else { " + " };
            *formula = Formula {
                text: format!("{left}{text}{plus}lambda phi^-1"),
                latex: format!("{left_latex}{latex}{plus}\\lambda\\,\\varphi^{{-1}}"),
            };
        // [X, O] of a momentum that is projected and a velocity in the algebra is projected already.
        } else if text.contains(" + ") || text.contains(" - ") || !text.contains('[') && text != "0" {
            projects = true;
            *formula = Formula {
                text: format!("{left}P({text})"),
                latex: format!("{left_latex}P\\left({latex}\\right)"),
            };
        }
    }
    let (text, latex) = match (h.confined().is_none(), projects) {
        (true, _) => ("lambda: the multiplier of det phi = 1, left to the method", "\\det\\varphi = 1"),
        (false, true) => group.projection(),
        (false, false) => return list,
    };
    list.push(Formula { text: text.to_owned(), latex: latex.to_owned() });
    list
}

/// Name in text and LaTeX, and definition, of the generalised forces on the linear and the affine momentum.
type ForceName = (&'static str, &'static str, Formula);

fn force_names(
    h: &Hamiltonian,
    chart: &Chart,
    potential: Option<&Potential>,
    forces: &Forces,
) -> [Option<ForceName>; 2] {
    let (linear, of_linear) = match chart.linear {
        Some(Linear::Body) => (("F_hat", "\\hat F"), ("-phi^T dU/dx", "-\\varphi^T \\partial U/\\partial x")),
        _ => (("F", "F"), ("-dU/dx", "-\\partial U/\\partial x")),
    };
    let (affine, of_affine) = match chart.momentum {
        Momentum::Body => {
            (("Q_hat", "\\hat Q"), ("-(dU/dphi)^T phi", "-(\\partial U/\\partial\\varphi)^T \\varphi"))
        }
        Momentum::Space | Momentum::Total => {
            (("Q", "Q"), ("-phi (dU/dphi)^T", "-\\varphi (\\partial U/\\partial\\varphi)^T"))
        }
        Momentum::Canonical => (("N", "N"), ("-(dU/dphi)^T", "-(\\partial U/\\partial\\varphi)^T")),
    };
    let moves = potential.is_some_and(Potential::moves_the_centre);
    let mut on_linear: Vec<(String, String)> = Vec::new();
    let mut on_affine: Vec<(String, String)> = Vec::new();
    let owned = |(text, latex): (&str, &str)| (text.to_owned(), latex.to_owned());
    on_linear.extend(moves.then(|| owned(of_linear)));
    on_affine.extend(h.weight.as_ref().map(|_| owned(("2/n T_int 1", "\\tfrac{2}{n} T_{int}\\,1"))));
    on_affine.extend(potential.map(|_| owned(of_affine)));
    forces.name_on(chart, &mut on_linear, &mut on_affine);
    let joined = |(name, latex): (&'static str, &'static str), parts: Vec<(String, String)>| {
        let sum = |parts: Vec<String>| {
            parts.into_iter().reduce(|sum, part| match part.strip_prefix('-') {
                Some(size) => format!("{sum} - {size}"),
                None => format!("{sum} + {part}"),
            })
        };
        let (texts, formulas) = parts.into_iter().unzip();
        Some((name, latex, Formula { text: sum(texts)?, latex: sum(formulas)? }))
    };
    [joined(linear, on_linear), joined(affine, on_affine)]
}

/// The index of a component: `12` of `pi_12`.
fn index_of(arena: &Arena, symbol: Expr) -> String {
    let name = arena.name(symbol).unwrap_or_default();
    name.rsplit('_').next().unwrap_or_default().to_owned()
}

/// The inverse Legendre transformation.
fn affine_velocity(arena: &mut Arena, h: &Hamiltonian, chart: &Chart) -> Formula {
    let (x, x_latex, ..) = momentum_names(chart.momentum);
    let (omega, omega_latex) = velocity_names(chart.momentum);
    let mut sum = Sum::new(omega, omega_latex);
    match &h.isotropic {
        Some(iso) => {
            sum.add(arena, &iso.casimir2, (x, x_latex));
            sum.add(
                arena,
                &trace_coefficient(h, iso),
                (&format!("tr({x}) 1"), &format!("\\operatorname{{tr}}({x_latex})\\,1")),
            );
            sum.add(
                arena,
                &iso.skew.scaled(&Rational::MINUS_ONE),
                (&format!("({x} - {x}^T)"), &format!("({x_latex} - {x_latex}^T)")),
            );
            sum.add(arena, &iso.casimir3, (&format!("{x}^2"), &format!("{x_latex}^2")));
            sum.finish()
        }
        None => Formula {
            text: format!("{omega} = (dH/d{x})^T"),
            latex: format!("{omega_latex} = (\\partial H/\\partial {x_latex})^T"),
        },
    }
}

fn pairs(n: usize, make: fn(usize, usize) -> Coordinate) -> Vec<Coordinate> {
    (0..n).flat_map(|i| (0..n).map(move |j| make(i, j))).collect()
}
