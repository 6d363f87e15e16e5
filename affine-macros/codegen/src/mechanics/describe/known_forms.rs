//! Matrix forms that the derived components are compared with.

use super::{momentum_names, velocity_names};
use crate::algebra::ring::{difference, outer, product, times, transpose};
use crate::algebra::{Expr, Polynomial};
use crate::mechanics::charts::{Chart, Linear};
use crate::mechanics::equations::Form;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::kinetic::Frame;

/// A matrix or vector formula with its components.
pub(super) struct Known {
    pub(super) text: String,
    pub(super) latex: String,
    pub(super) components: Vec<Polynomial>,
}

/// Balance laws of section 4 and (3.1), as candidates to compare the derived equations with.
pub(super) fn known_forms(
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

fn bracketed(name: &str) -> String {
    if name.contains("^T") { format!("({name})") } else { name.to_owned() }
}
