//! What the reduction took out of the state.

use super::momentum_names;
use crate::mechanics::carried::Carried;
use crate::mechanics::charts::Momentum;
use crate::mechanics::reduce::{ClosedForm, Commuting, Layout, Reduction};
use crate::mechanics::separation::Slope;

/// Something that is not integrated, and in which runs it is not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// What it is and why, in words.
    pub what: String,
    /// The runs.
    pub scope: Scope,
}

/// The runs that leave something out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Every run of the model.
    Model,
    /// Those by the reduced equations.
    Reduction,
    /// Those by methods that integrate what the reduced state carries along.
    Carried,
    /// Those with `p = 0`.
    Rest,
}

impl Scope {
    /// Something that these runs leave out.
    pub fn without(self, what: impl Into<String>) -> LeftOut {
        LeftOut { what: what.into(), scope: self }
    }
}

/// What the reduction took out of the state, one sentence each; `moves` where there is a centre of mass.
pub fn left_out(moves: bool, reduction: &Reduction, closed: Option<(ClosedForm, bool)>) -> Vec<LeftOut> {
    let mut list = Vec::new();
    if !moves {
        list.push(Scope::Model.without("x and p: the model has no translation"));
    }
    list.extend(reduction.commuting.iter().map(|piece| {
        Scope::Reduction.without(match piece {
            Commuting::Vorticity(_) => {
                "the |Vort|^2/(2 mu) of H: it commutes with the rest and is applied exactly, phi -> phi exp(-t Vort/mu)"
            }
            Commuting::Spin(_) => {
                "the |S|^2/(2 mu) of H: it commutes with the rest and is applied exactly, phi -> exp(-t S/mu) phi"
            }
            Commuting::Drift(_) => "x and p: the centre of mass moves freely, x = x0 + t p/m",
        })
    }));
    let (name, ..) = momentum_names(reduction.chart.momentum);
    if let Some(separation) = &reduction.separation {
        let path = match separation.slope {
            Slope::Zero => "moves freely",
            Slope::Linear(_) => "swings harmonically",
            Slope::Hyperbolic { .. } => "moves by an elliptic function",
        };
        list.push(Scope::Reduction.without(format!(
            "the dilatation: phi = e^q Psi with det Psi = 1, and q {path}; the state is Psi with O, the traceless part \
             of {name} over alpha, in parts O = s + w, symmetric and skew"
        )));
        if !reduction.fixed.is_empty() {
            list.push(Scope::Reduction.without("w: conserved"));
        }
    }
    list.extend(reduction.carried.iter().map(|carried| {
        Scope::Carried.without(match carried {
            Carried::InverseDilatation => {
                "the root of det phi: 1/D = (det phi)^(-1/n) is integrated beside phi"
            }
            Carried::MeanLogStretch => "the logarithm of det phi: q = ln(det phi)/n is integrated beside phi",
        })
    }));
    match reduction.layout {
        // The flow that is applied exactly turns the momentum of its own frame.
        Layout::Constant if turns(reduction) => {
            list.push(Scope::Reduction.without(format!("{name}: conserved by the rest of H")));
        }
        Layout::Constant => list.push(Scope::Reduction.without(format!("{name}: conserved"))),
        Layout::Entries => {}
    }
    if reduction.chart.linear.is_some() && reduction.turned {
        let turned = "p: conserved; space is turned so that only its first component is left";
        list.push(Scope::Reduction.without(turned));
    }
    list.extend(closed.map(|(_, only_at_rest)| closed_form(only_at_rest)));
    list
}

/// What a closed form leaves out: all integration, or that of motions with `p = 0`.
fn closed_form(only_at_rest: bool) -> LeftOut {
    match only_at_rest {
        false => Scope::Model.without("integration: every motion has a closed form"),
        true => Scope::Rest.without("integration of motions with p = 0: they have a closed form"),
    }
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
