//! What was derived, as rustdoc and as a constant.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::ir::count::Operations;
use crate::mechanics::conserved::Candidate;
use crate::mechanics::describe::Formula;
use crate::mechanics::symmetry::Group;

use super::context::Context;
use super::domain;
use super::number::number;

/// Documentation of the implementation, line by line.
pub(super) fn docs(context: &Context) -> Vec<String> {
    let model = context.model;
    let formulas = &model.formulas;
    let mut lines = vec![
        format!("`{}`", formulas.kinetic_energy.text),
        String::new(),
        format!("`{}`", formulas.hamiltonian.text),
        String::new(),
    ];
    let system = |title: &str, operations: Operations, formulas: &[Formula]| {
        let mut lines = vec![format!("{title}, {}:", counts(operations)), "```text".to_owned()];
        lines.extend(formulas.iter().map(|f| f.text.clone()));
        lines.push("```".to_owned());
        lines
    };
    lines.extend(system("Hamilton's equations", model.full.program.operations(), &formulas.equations));
    lines.extend(system("Reduced equations", model.reduced.program.operations(), &formulas.reduced));
    if !formulas.left_out.is_empty() {
        lines.push("Left out of the state:".to_owned());
        lines.extend(formulas.left_out.iter().map(|left_out| format!("- {}", left_out.what)));
        lines.push(String::new());
    }
    lines.push(match model.signature {
        Some((p, 0)) => format!("The kinetic metric is positive definite, ({p}, 0)."),
        Some((0, q)) => format!("The kinetic metric is negative definite, (0, {q})."),
        Some((p, q)) => format!("The kinetic metric is indefinite, ({p}, {q})."),
        None if model.velocity_side.is_none() => {
            "The velocity is quadratic in the momentum: the kinetic metric \
            depends on the momentum, and is singular on a hypersurface of it."
                .to_owned()
        }
        None if model.regularity.is_some() => {
            "The signature of the kinetic metric depends on the placement: it is checked at every start and kept along \
             every motion."
                .to_owned()
        }
        None => "The signature of the kinetic metric depends on the fields.".to_owned(),
    });
    lines.push(String::new());
    let n = model.dim;
    let group = |g: Group| match g {
        Group::Affine => format!("GL({n})"),
        Group::Metric => format!("O({n})"),
        Group::Less => format!("a proper subgroup of O({n})"),
    };
    let invariant = match (model.has_forces, model.constraint) {
        (_, Some(_)) => "Without its constraint the kinetic energy is invariant",
        (true, None) => "The kinetic energy is invariant",
        (false, None) => "Invariant",
    };
    lines.push(format!(
        "{invariant} under {} in space and {} in the body.",
        group(model.groups.0),
        group(model.groups.1)
    ));
    if let Some(constraint) = model.constraint {
        let survives = |g: Group| match g {
            Group::Affine => constraint.name(n),
            Group::Metric => format!("SO({n})"),
            Group::Less => format!("a proper subgroup of SO({n})"),
        };
        lines.push(format!(
            "The motion is confined to {}, on which {} in space and {} in the body act.",
            constraint.name(n),
            survives(model.groups.0),
            survives(model.groups.1)
        ));
    }
    lines.push(String::new());
    lines.push(format!("Conserved: {}.", names(&model.conserved)));
    if model.translation.is_some() {
        lines.push(String::new());
        lines.push(format!("With `p = 0`: {}.", names(&model.conserved_at_rest)));
    }
    lines.into_iter().map(indented).collect()
}

/// A line of documentation as `///` writes it.
pub(super) fn indented(line: String) -> String {
    if line.is_empty() { line } else { format!(" {line}") }
}

fn names(list: &[Candidate]) -> String {
    list.iter().map(|c| format!("`{c:?}`")).collect::<Vec<_>>().join(", ")
}

pub(super) fn counts(operations: Operations) -> String {
    let mut parts =
        vec![format!("{} multiplications", operations.mul), format!("{} additions", operations.add)];
    for (count, one, several) in [
        (operations.div, "division", "divisions"),
        (operations.sqrt, "root", "roots"),
        (operations.exp, "exponential function", "exponential functions"),
        (operations.ln, "logarithm", "logarithms"),
    ] {
        if count > 0 {
            parts.push(format!("{count} {}", if count == 1 { one } else { several }));
        }
    }
    parts.join(", ")
}

/// Operation counts as an expression.
pub(super) fn operations(context: &Context, o: Operations) -> TokenStream {
    let rt = &context.names.rt;
    let [mul, add, div, sqrt, exp, ln] = [o.mul, o.add, o.div, o.sqrt, o.exp, o.ln].map(number);
    quote!(#rt::Operations { mul: #mul, add: #add, div: #div, sqrt: #sqrt, exp: #exp, ln: #ln })
}

/// The description as an expression.
pub(super) fn constant(context: &Context) -> TokenStream {
    let (model, rt) = (context.model, &context.names.rt);
    let name = context.names.model.to_string();
    let formula = |f: &Formula| {
        let (text, latex) = (&f.text, &f.latex);
        quote!(#rt::Formula { text: #text, latex: #latex })
    };
    let kinetic_energy = formula(&model.formulas.kinetic_energy);
    let hamiltonian = formula(&model.formulas.hamiltonian);
    let equations = model.formulas.equations.iter().map(formula);
    let reduced_equations = model.formulas.reduced.iter().map(formula);
    let left_out = model.formulas.left_out.iter().map(|left_out| {
        let (what, scope) = (&left_out.what, format_ident!("{}", format!("{:?}", left_out.scope)));
        quote!(#rt::LeftOut { what: #what, scope: #rt::Scope::#scope })
    });
    let domain = domain::guards(context);
    let angles = domain::angles(context);
    let signature = match model.signature {
        Some((p, q)) => {
            let (p, q) = (number(p), number(q));
            quote!(::core::option::Option::Some((#p, #q)))
        }
        None => quote!(::core::option::Option::None),
    };
    let conserved = |list: &[Candidate]| {
        let entries = list.iter().map(|c| {
            let variant = format_ident!("{c:?}");
            quote!(#rt::Conserved::#variant)
        });
        quote!(&[#(#entries),*])
    };
    let (now, at_rest) = (conserved(&model.conserved), conserved(&model.conserved_at_rest));
    let groups = |groups: &[(&'static str, Vec<String>)]| {
        let entries = groups.iter().map(|(name, components)| {
            let len = number(components.len());
            quote!(#rt::Group { name: #name, len: #len })
        });
        quote!(&[#(#entries),*])
    };
    let (full, reduced) = (groups(&model.full.groups), groups(&model.reduced.groups));
    let constraint = match context.constraint() {
        Some(group) => quote!(::core::option::Option::Some(#group)),
        None => quote!(::core::option::Option::None),
    };
    let full_operations = operations(context, model.full.program.operations());
    let reduced_operations = operations(context, model.reduced.program.operations());
    quote! {
        #rt::Description {
            name: #name,
            kinetic_energy: #kinetic_energy,
            hamiltonian: #hamiltonian,
            equations: &[#(#equations),*],
            reduced_equations: &[#(#reduced_equations),*],
            signature: #signature,
            conserved: #now,
            conserved_at_rest: #at_rest,
            full: #full,
            reduced: #reduced,
            full_operations: #full_operations,
            reduced_operations: #reduced_operations,
            constraint: #constraint,
            domain: #domain,
            angles: #angles,
            left_out: &[#(#left_out),*],
        }
    }
}
