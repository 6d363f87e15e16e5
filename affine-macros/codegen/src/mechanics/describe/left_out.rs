//! What the reduction took out of the state.

use super::momentum_names;
use crate::mechanics::carried::Carried;
use crate::mechanics::charts::Momentum;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::reduce::{ClosedForm, Commuting, Layout, Reduction};
use crate::mechanics::separation::Slope;

/// What the reduction took out of the state, one sentence each.
pub fn left_out(h: &Hamiltonian, reduction: &Reduction, closed: Option<(ClosedForm, bool)>) -> Vec<String> {
    let mut list = Vec::new();
    if h.translation.is_none() {
        list.push("x and p: the model has no translation".to_owned());
    }
    for piece in &reduction.commuting {
        list.push(match piece {
            Commuting::Vorticity(_) => {
                "the |Vort|^2/(2 mu) of H: it commutes with the rest and is applied exactly, phi -> phi exp(-t Vort/mu)"
            }
            Commuting::Spin(_) => {
                "the |S|^2/(2 mu) of H: it commutes with the rest and is applied exactly, phi -> exp(-t S/mu) phi"
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
        // The flow that is applied exactly turns the momentum of its own frame.
        Layout::Constant if turns(reduction) => list.push(format!("{name}: conserved by the rest of H")),
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

/// Does a piece that is applied exactly move the momentum of the reduced chart?
fn turns(reduction: &Reduction) -> bool {
    reduction.commuting.iter().any(|piece| {
        matches!(
            (piece, reduction.chart.momentum),
            (Commuting::Vorticity(_), Momentum::Body) | (Commuting::Spin(_), Momentum::Space)
        )
    })
}
