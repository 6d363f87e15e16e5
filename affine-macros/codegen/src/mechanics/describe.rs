//! The derivation as formulas, in text and LaTeX. A matrix formula is stated only after its components were
//! compared with the derived ones.

use crate::algebra::arena::Node;
use crate::algebra::ring::{difference, outer, product, times, transpose};
use crate::algebra::{Arena, Expr, Polynomial, Rational};

use super::carried::Carried;
use super::charts::{Chart, Coordinate, Linear, Momentum};
use super::constraint::Constraint;
use super::equations::{Form, System, gradient, rate, velocities};
use super::forces::Forces;
use super::hamiltonian::{Hamiltonian, Isotropic};
use super::kinetic::{Coefficient, Frame, Kinetic, Term, TermKind};
use super::notation::{latex, plain};
use super::potential::Potential;
use super::reduce::{ClosedForm, Commuting, Layout, Reduction};
use super::separation::Slope;

/// A formula in both notations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// Plain text.
    pub text: String,
    /// LaTeX.
    pub latex: String,
}

/// A sum under construction.
pub(super) struct Sum {
    text: String,
    latex: String,
}

impl Sum {
    pub(super) fn new(left: &str, left_latex: &str) -> Self {
        Self { text: format!("{left} ="), latex: format!("{left_latex} =") }
    }

    /// Adds `coefficient * body`, with the sign in front.
    pub(super) fn add(&mut self, arena: &mut Arena, coefficient: &Polynomial, body: (&str, &str)) {
        if coefficient.is_zero() {
            return;
        }
        let negative = coefficient.terms().all(|(_, c)| c.is_negative());
        let first = self.text.ends_with('=');
        let sign = match (negative, first) {
            (true, true) => " -",
            (true, false) => " - ",
            (false, true) => " ",
            (false, false) => " + ",
        };
        let size = if negative { coefficient.scaled(&Rational::MINUS_ONE) } else { coefficient.clone() };
        let factor = size.expression(arena);
        let one = arena.as_constant(factor).is_some_and(Rational::is_one);
        self.text.push_str(sign);
        self.latex.push_str(sign);
        if !one {
            let (text, latex) = (plain(arena, factor), latex(arena, factor));
            let bracket = matches!(arena.node(factor), Node::Sum(_, terms) if terms.len() > 1);
            self.text += &if bracket { format!("({text}) ") } else { format!("{text} ") };
            self.latex += &if bracket { format!("\\left({latex}\\right) ") } else { format!("{latex}\\, ") };
        }
        self.text.push_str(body.0);
        self.latex.push_str(body.1);
    }

    pub(super) fn finish(mut self) -> Formula {
        if self.text.ends_with('=') {
            self.text.push_str(" 0");
            self.latex.push_str(" 0");
        }
        Formula { text: self.text, latex: self.latex }
    }
}

/// `T` as the sum of its terms.
pub fn kinetic_energy(arena: &mut Arena, kinetic: &Kinetic) -> Formula {
    let mut sum = Sum::new("T", "T");
    quadratic_terms(arena, &mut sum, kinetic.frame, &kinetic.terms);
    sum.finish()
}

/// Adds the terms of a quadratic form in the velocity of `frame`.
pub(super) fn quadratic_terms(arena: &mut Arena, sum: &mut Sum, frame: Frame, terms: &[Term]) {
    let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
    let (o, o_latex) = match frame {
        Frame::Body => ("Omega_hat", "\\hat\\Omega"),
        Frame::Space => ("Omega", "\\Omega"),
        Frame::Flat => ("phi_dot", "\\dot\\varphi"),
    };
    for term in terms {
        let (coefficient, (text, latex)) = match (term.kind, &term.value) {
            (TermKind::Casimir2, Coefficient::Scalar(c)) => {
                (*c, (format!("tr({o}^2)"), format!("\\operatorname{{tr}}{o_latex}^2")))
            }
            (TermKind::Casimir1Squared, Coefficient::Scalar(c)) => {
                (*c, (format!("(tr {o})^2"), format!("(\\operatorname{{tr}}{o_latex})^2")))
            }
            (TermKind::BodyTranslation, Coefficient::Scalar(m)) => {
                (*m, ("|phi^-1 dx/dt|^2".into(), "|\\varphi^{-1}\\dot x|^2".into()))
            }
            (TermKind::SpaceTranslation, Coefficient::Scalar(m)) => {
                (*m, ("|dx/dt|^2".into(), "|\\dot x|^2".into()))
            }
            (_, Coefficient::Scalar(c)) => {
                (*c, (format!("tr({o} {o}^T)"), format!("\\operatorname{{tr}}({o_latex}{o_latex}^T)")))
            }
            (kind, Coefficient::Matrix(_)) if !kind.is_tensor() => (
                arena.constant(Rational::ONE),
                (format!("tr({o} J {o}^T)"), format!("\\operatorname{{tr}}({o_latex} J {o_latex}^T)")),
            ),
            (_, Coefficient::Matrix(_)) => (
                arena.constant(Rational::ONE),
                (
                    format!("K[(A,B),(C,D)] {o}[A,B] {o}[C,D]"),
                    format!("K_{{(AB)(CD)}}\\,{o_latex}_{{AB}}{o_latex}_{{CD}}"),
                ),
            ),
        };
        let weight = Polynomial::normal_form(arena, coefficient).scaled(&half);
        sum.add(arena, &weight, (&text, &latex));
    }
}

/// `T = tr(X O) - H` of a Hamiltonian with `C(3)`, on momenta: the cubic term counts twice (Euler).
pub fn kinetic_energy_of_momenta(arena: &mut Arena, h: &Hamiltonian) -> Formula {
    let mut doubled = h.clone();
    if let Some(iso) = &mut doubled.isotropic {
        iso.casimir3 = iso.casimir3.scaled(&Rational::from(2));
    }
    let Formula { text, latex } = kinetic_hamiltonian(arena, &doubled, &Polynomial::zero());
    let named = |formula: String| formula.replacen('H', "T", 1);
    Formula { text: named(text), latex: named(latex) }
}

/// `H`, through the Casimirs where it is isotropic.
pub fn hamiltonian(
    arena: &mut Arena,
    h: &Hamiltonian,
    full: &Polynomial,
    potential: Option<&Potential>,
    forces: &Forces,
) -> Formula {
    let dependent = h.confined().map_or_else(Vec::new, |group| group.dependent(&h.momentum));
    let value = |atom: Expr| dependent.iter().find(|(s, _)| *s == atom).map(|(_, value)| value.clone());
    let mut formula = kinetic_hamiltonian(arena, h, &full.substitute(&value));
    if let Some(u) = potential {
        formula.text += &format!(" + {}", plain(arena, u.energy));
        formula.latex += &format!(" + {}", latex(arena, u.energy));
    }
    for custom in forces.potentials() {
        formula.text += &format!(" + {}", custom.text);
        formula.latex += &format!(" + {}", custom.latex);
    }
    formula
}

fn kinetic_hamiltonian(arena: &mut Arena, h: &Hamiltonian, full: &Polynomial) -> Formula {
    let Some(iso) = &h.isotropic else {
        let form = full.expression(arena);
        return Formula {
            text: format!("H = {}", plain(arena, form)),
            latex: format!("H = {}", latex(arena, form)),
        };
    };
    let half = Rational::ratio(1, 2).unwrap_or(Rational::ONE);
    let mut sum = Sum::new("H", "H");
    let (x, hat, skew) = match h.frame {
        Frame::Body => ("Sigma_hat", "\\hat\\Sigma", ("|Vort|^2", "\\|V\\|^2")),
        _ => ("Sigma", "\\Sigma", ("|S|^2", "\\|S\\|^2")),
    };
    sum.add(
        arena,
        &iso.casimir2.scaled(&half),
        (&format!("tr({x}^2)"), &format!("\\operatorname{{tr}}{hat}^2")),
    );
    sum.add(
        arena,
        &trace_coefficient(h, iso).scaled(&half),
        (&format!("(tr {x})^2"), &format!("(\\operatorname{{tr}}{hat})^2")),
    );
    sum.add(arena, &iso.skew.scaled(&half), skew);
    let third = Rational::ratio(1, 3).unwrap_or(Rational::ONE);
    sum.add(
        arena,
        &iso.casimir3.scaled(&third),
        (&format!("tr({x}^3)"), &format!("\\operatorname{{tr}}{hat}^3")),
    );
    if let Some((frame, inverse_mass)) = &h.translation {
        let body = match frame {
            Frame::Body => ("|phi^T p|^2", "|\\varphi^T p|^2"),
            _ => ("|p|^2", "|p|^2"),
        };
        sum.add(arena, &inverse_mass.scaled(&half), body);
    }
    sum.finish()
}

/// The coefficient of the trace of the affine spin, which is zero where a constraint makes it traceless.
fn trace_coefficient(h: &Hamiltonian, iso: &Isotropic) -> Polynomial {
    match h.confined().is_some_and(Constraint::is_traceless) {
        true => Polynomial::zero(),
        false => iso.casimir1_squared.clone(),
    }
}

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
    let names = force_names(chart, potential, forces);
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

fn force_names(chart: &Chart, potential: Option<&Potential>, forces: &Forces) -> [Option<ForceName>; 2] {
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

/// A matrix or vector formula with its components.
struct Known {
    text: String,
    latex: String,
    components: Vec<Polynomial>,
}

/// Balance laws of section 4 and (3.1), as candidates to compare the derived equations with.
fn known_forms(
    h: &Hamiltonian,
    chart: &Chart,
    velocity: &[Vec<(Expr, Polynomial)>],
    form: Form,
) -> Vec<Known> {
    let n = chart.dim;
    let atoms = |rows: &Vec<Vec<Expr>>| -> Vec<Vec<Polynomial>> {
        rows.iter().map(|row| row.iter().map(|e| Polynomial::atom(*e)).collect()).collect()
    };
    let (phi, m) = (atoms(&chart.phi.0), atoms(&chart.m.0));
    let written = |symbol: Expr, value: &Polynomial| match form {
        Form::Expanded => value.clone(),
        Form::ThroughVelocity => Polynomial::atom(symbol),
    };
    let o: Vec<Vec<Polynomial>> = velocity
        .iter()
        .map(|row| row.iter().map(|(symbol, value)| written(*symbol, value)).collect())
        .collect();
    let p: Vec<Polynomial> = chart.p.iter().map(|e| Polynomial::atom(*e)).collect();
    let (x, x_latex, ..) = momentum_names(chart.momentum);
    let (omega, omega_latex) = velocity_names(chart.momentum);
    let mut known = Vec::new();
    let mut add = |text: String, latex: String, components: Vec<Polynomial>| {
        known.push(Known { text, latex, components });
    };
    add("0".into(), "0".into(), vec![Polynomial::zero(); n]);
    add("0".into(), "0".into(), vec![Polynomial::zero(); n * n]);
    add(format!("phi {omega}"), format!("\\varphi\\,{omega_latex}"), product(&phi, &o).concat());
    add(format!("{omega} phi"), format!("{omega_latex}\\,\\varphi"), product(&o, &phi).concat());
    add("(dH/dPi)^T".into(), "(\\partial H/\\partial \\Pi)^T".into(), o.concat());
    let (xo, ox) = (product(&m, &o), product(&o, &m));
    let body_commutator = difference(&xo, &ox);
    let space_commutator = difference(&ox, &xo);
    add(format!("[{x}, {omega}]"), format!("[{x_latex}, {omega_latex}]"), body_commutator.concat());
    add(format!("[{omega}, {x}]"), format!("[{omega_latex}, {x_latex}]"), space_commutator.concat());
    if let Some((frame, inverse_mass)) = &h.translation {
        let comoving = chart.linear == Some(Linear::Body);
        let ph: Vec<Polynomial> = if comoving { p.clone() } else { times(&transpose(&phi), &p) };
        let name = if comoving { ("p_hat", "\\hat p") } else { ("phi^T p", "\\varphi^T p") };
        let scaled =
            |v: Vec<Polynomial>| -> Vec<Polynomial> { v.iter().map(|c| c.mul(inverse_mass)).collect() };
        add("p / m".into(), "p / m".into(), scaled(p.clone()));
        add(format!("phi {} / m", name.0), format!("\\varphi {} / m", name.1), scaled(times(&phi, &ph)));
        add(format!("{omega}^T p_hat"), format!("{omega_latex}^T \\hat p"), times(&transpose(&o), &p));
        if *frame == Frame::Body {
            let thrust = outer(&scaled(ph.clone()), &ph);
            add(
                format!("[{x}, {omega}] - {0} {0}^T / m", bracketed(name.0)),
                format!("[{x_latex}, {omega_latex}] - {0} {0}^T / m", bracketed(name.1)),
                difference(&body_commutator, &thrust).concat(),
            );
            let spatial = outer(&scaled(times(&phi, &ph)), &p);
            add(
                format!("[{omega}, {x}] - phi phi^T p p^T / m"),
                format!("[{omega_latex}, {x_latex}] - \\varphi\\varphi^T p\\,p^T / m"),
                difference(&space_commutator, &spatial).concat(),
            );
            let flat = difference(&vec![vec![Polynomial::zero(); n]; n], &outer(&scaled(ph), &p));
            add("-phi^T p p^T / m".into(), "-\\varphi^T p\\,p^T / m".into(), flat.concat());
        }
    }
    known
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

/// Shared quantities and rates of a system, component by component; what is a rate itself is written there.
pub fn system(arena: &mut Arena, system: &System) -> Vec<Formula> {
    let value_of_rate = |rate: &Polynomial| {
        system.shared.iter().find(|(s, _)| *rate == Polynomial::atom(*s)).map(|(_, value)| value.clone())
    };
    let is_rate = |s: Expr| system.rates.iter().any(|(_, _, rate)| *rate == Polynomial::atom(s));
    let shared = system.shared.iter().filter(|(s, _)| !is_rate(*s)).map(|(s, p)| (*s, p.clone(), false));
    let rates =
        system.rates.iter().map(|(_, s, p)| (*s, value_of_rate(p).unwrap_or_else(|| p.clone()), true));
    let work = system.work.iter().map(|(s, p)| (*s, p.clone(), true));
    let equations: Vec<(Expr, Polynomial, bool)> = shared.chain(rates).chain(work).collect();
    equations
        .into_iter()
        .map(|(symbol, p, rate)| {
            let form = p.expression(arena);
            let (name, name_latex) = (plain(arena, symbol), latex(arena, symbol));
            let (left, left_latex) = if rate {
                (format!("d{name}/dt"), format!("\\dot{{{name_latex}}}"))
            } else {
                (name, name_latex)
            };
            Formula {
                text: format!("{left} = {}", plain(arena, form)),
                latex: format!("{left_latex} = {}", latex(arena, form)),
            }
        })
        .collect()
}

/// What the reduction took out of the state, one sentence each.
pub fn left_out(h: &Hamiltonian, reduction: &Reduction, closed: Option<(ClosedForm, bool)>) -> Vec<String> {
    let mut list = Vec::new();
    if h.translation.is_none() {
        list.push("x and p: the model has no translation".to_owned());
    }
    for piece in &reduction.commuting {
        list.push(match piece {
            Commuting::Vorticity(_) => {
                "the |Vort|^2 part of H: it commutes with the rest and is applied exactly, phi -> phi exp(-t Vort/mu)"
            }
            Commuting::Spin(_) => {
                "the |S|^2 part of H: it commutes with the rest and is applied exactly, phi -> exp(-t S/mu) phi"
            }
            Commuting::Drift(_) => "x and p: the centre of mass moves freely, x = x0 + t p/m",
        }
        .to_owned());
    }
    let (name, ..) = momentum_names(reduction.chart.momentum);
    if let Some(separation) = &reduction.separation {
        let path = match separation.slope {
            Slope::Zero => "moves freely",
            Slope::Linear(_) => "swings harmonically",
            Slope::Hyperbolic { .. } => "moves by an elliptic function",
        };
        list.push(format!(
            "the dilatation: phi = e^q Psi with det Psi = 1, and q {path}; the state is Psi with O, the traceless part \
             of {name} over alpha, in parts O = s + w, symmetric and skew"
        ));
        if !reduction.fixed.is_empty() {
            list.push("w: conserved".to_owned());
        }
    }
    list.extend(reduction.carried.iter().map(|carried| {
        match carried {
            Carried::InverseDilatation => {
                "the root of det phi: 1/D = (det phi)^(-1/n) is integrated beside phi"
            }
            Carried::MeanLogStretch => "the logarithm of det phi: q = ln(det phi)/n is integrated beside phi",
        }
        .to_owned()
    }));
    match reduction.layout {
        Layout::Constant => list.push(format!("{name}: conserved")),
        Layout::Entries => {}
    }
    if reduction.chart.linear.is_some() && reduction.turned {
        list.push("p: conserved; space is turned so that only its first component is left".to_owned());
    }
    match closed {
        Some((_, false)) => list.push("integration: every motion has a closed form".to_owned()),
        Some((_, true)) => list.push("integration of motions with p = 0: they have a closed form".to_owned()),
        None => {}
    }
    list
}

/// Names of a momentum and of its rate, in text and LaTeX.
fn momentum_names(momentum: Momentum) -> (&'static str, &'static str, &'static str, &'static str) {
    match momentum {
        Momentum::Body => ("Sigma_hat", "\\hat\\Sigma", "dSigma_hat/dt", "\\dot{\\hat\\Sigma}"),
        Momentum::Space => ("Sigma", "\\Sigma", "dSigma/dt", "\\dot\\Sigma"),
        Momentum::Total => ("I(O)", "I(O)", "dI(O)/dt", "\\dot I(O)"),
        Momentum::Canonical => ("Pi", "\\Pi", "dPi/dt", "\\dot\\Pi"),
    }
}

fn velocity_names(momentum: Momentum) -> (&'static str, &'static str) {
    match momentum {
        Momentum::Body => ("Omega_hat", "\\hat\\Omega"),
        Momentum::Space | Momentum::Total => ("Omega", "\\Omega"),
        Momentum::Canonical => ("phi_dot", "\\dot\\varphi"),
    }
}

fn bracketed(name: &str) -> String {
    if name.contains("^T") { format!("({name})") } else { name.to_owned() }
}

fn pairs(n: usize, make: fn(usize, usize) -> Coordinate) -> Vec<Coordinate> {
    (0..n).flat_map(|i| (0..n).map(move |j| make(i, j))).collect()
}
