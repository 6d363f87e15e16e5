//! What is constant along one trajectory in emitted code, and its coefficients: the constants as far as the reduced equations
//! read them.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::derive::Trajectory;
use crate::symbol::Symbol;

use super::context::Context;
use super::number::number;
use super::pattern::{identifiers, pattern, reads};

/// A constant of a trajectory: a field of its struct.
pub(super) struct Constant {
    pub(super) name: Ident,
    pub(super) shape: Shape,
    doc: String,
    /// What it is at the start, unless a variable of its name is.
    start: Option<TokenStream>,
}

/// What a constant is made of.
#[derive(Clone, Copy)]
pub(super) enum Shape {
    Number,
    Vector,
    Matrix,
    List(usize),
    /// A motion that no equation reads.
    Dilatation,
}

impl Constant {
    fn new(name: &str, shape: Shape, doc: &str) -> Self {
        Self { name: format_ident!("{name}"), shape, doc: format!(" {doc}"), start: None }
    }

    fn starting(self, value: TokenStream) -> Self {
        Self { start: Some(value), ..self }
    }

    /// The field of the struct.
    pub(super) fn field(&self, context: &Context) -> TokenStream {
        let (rt, t, n) = (&context.names.rt, &context.names.scalar, context.dim());
        let (name, doc) = (&self.name, &self.doc);
        let of = match self.shape {
            Shape::Number => quote!(#t),
            Shape::Vector => quote!(#rt::Vector<#n, #t>),
            Shape::Matrix => quote!(#rt::Matrix<#n, #t>),
            Shape::List(size) => {
                let size = number(size);
                quote!([#t; #size])
            }
            Shape::Dilatation => quote!(#rt::Breathing<#t>),
        };
        quote!(#[doc = #doc] pub #name: #of,)
    }

    /// The field of the value that a trajectory starts with.
    pub(super) fn at_the_start(&self) -> TokenStream {
        let name = &self.name;
        match &self.start {
            Some(value) => quote!(#name: #value,),
            None => quote!(#name,),
        }
    }
}

/// The constants of a trajectory that starts at `point` and has these coefficients.
pub(super) fn constants(
    context: &Context,
    parts: &Trajectory,
    coefficients: &[TokenStream],
) -> Vec<Constant> {
    let rt = &context.names.rt;
    let fixed = identifiers(&parts.fixed);
    let names: Vec<String> = parts.fixed.iter().map(Symbol::to_string).collect();
    let components = format!("Conserved components of the affine momentum: {}.", names.join(", "));
    let turn = "Turns space so that `p` lies along the first axis.";
    let rotation = "Generator of the rotation that commutes with the rest of the motion.";
    let dilatation = "The motion of `q = ln(det phi)/n` and its momentum `tr Sigma`.";
    let (drift, equations) =
        ("Velocity `p/m` of the centre of mass.", "Coefficients of the reduced equations.");
    let new = Constant::new;
    let list = [
        (parts.origin, new("t0", Shape::Number, "Time of the start.")),
        (parts.turn, new("turn", Shape::Matrix, turn)),
        (parts.linear, new("p", Shape::Vector, "Linear momentum `p`.")),
        (
            parts.drift,
            new("x0", Shape::Vector, "Centre of mass at the start.").starting(quote!(#rt::Phase::x(point))),
        ),
        (parts.drift, new("drift", Shape::Vector, drift)),
        (parts.conserved, new("momentum", Shape::Matrix, "Conserved affine momentum.")),
        (
            !fixed.is_empty(),
            new("fixed", Shape::List(fixed.len()), &components).starting(quote!([#(#fixed),*])),
        ),
        (parts.rotation.is_some(), new("whirl", Shape::Matrix, rotation)),
        (parts.dilatation.is_some(), new("dilatation", Shape::Dilatation, dilatation)),
        (
            parts.coefficients > 0,
            new("coefficients", Shape::List(parts.coefficients), equations)
                .starting(quote!([#(#coefficients),*])),
        ),
    ];
    list.into_iter().filter_map(|(wanted, constant)| wanted.then_some(constant)).collect()
}

/// The coefficients of a trajectory: `k_1`, `k_2`, ..
pub(super) fn all(context: &Context) -> Vec<Symbol> {
    context.model.dynamics.trajectory.results().cloned().collect()
}

/// The statement that binds those of some inputs, and the name of the parameter that it takes them from.
pub(super) fn coefficients(context: &Context, used: &[Symbol]) -> (TokenStream, TokenStream) {
    let names = all(context);
    if !reads(used, &names) {
        return (TokenStream::new(), quote!(_constants));
    }
    let bound = pattern(&names, used);
    (quote!(let #bound = constants.coefficients;), quote!(constants))
}
