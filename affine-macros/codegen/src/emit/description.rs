//! What was derived, as rustdoc and as a constant.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::ir::count::Operations;

use super::context::Context;
use super::domain;
use super::groups::groups;
use super::number::number;
use super::pattern::identifiers;

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
    lines.extend([
        format!("Hamilton's equations, {}:", counts(model.full.program.operations())),
        "```text".to_owned(),
    ]);
    lines.extend(formulas.equations.iter().map(|f| f.text.clone()));
    lines.extend([
        "```".to_owned(),
        format!("Reduced equations, {}:", counts(model.reduced.program.operations())),
        "```text".to_owned(),
    ]);
    lines.extend(formulas.reduced.iter().map(|f| f.text.clone()));
    lines.push("```".to_owned());
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
    let [in_space, in_the_body] = model.invariance();
    let invariant = match (model.has_forces, model.constraint) {
        (_, Some(_)) => "Without its constraint the kinetic energy is invariant",
        (true, None) => "The kinetic energy is invariant",
        (false, None) => "Invariant",
    };
    lines.push(format!("{invariant} under {in_space} in space and {in_the_body} in the body."));
    if let Some((group, [in_space, in_the_body])) = model.confinement() {
        lines.push(format!(
            "The motion is confined to {group}, on which {in_space} in space and {in_the_body} in the body act."
        ));
    }
    lines.push(String::new());
    lines.push(format!("Conserved: {}.", listed(&model.conserved_names())));
    if model.translation.is_some() {
        lines.push(String::new());
        lines.push(format!("With `p = 0`: {}.", listed(&model.conserved_names_at_rest())));
    }
    lines.into_iter().map(indented).collect()
}

/// A line of documentation as `///` writes it.
pub(super) fn indented(line: String) -> String {
    if line.is_empty() { line } else { format!(" {line}") }
}

fn listed(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
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

/// A formula as an expression.
pub(super) fn formula(context: &Context, text: &str, latex: &str) -> TokenStream {
    let rt = &context.names.rt;
    quote!(#rt::Formula { text: #text, latex: #latex })
}

/// The description as an expression.
pub(super) fn constant(context: &Context) -> TokenStream {
    let (model, rt) = (context.model, &context.names.rt);
    let name = context.names.model.to_string();
    let formulas = &model.formulas;
    let kinetic_energy = formula(context, &formulas.kinetic_energy.text, &formulas.kinetic_energy.latex);
    let hamiltonian = formula(context, &formulas.hamiltonian.text, &formulas.hamiltonian.latex);
    let equations = formulas.equations.iter().map(|f| formula(context, &f.text, &f.latex));
    let reduced_equations = formulas.reduced.iter().map(|f| formula(context, &f.text, &f.latex));
    let left_out = formulas.left_out.iter().map(|left_out| {
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
    let conserved = |names: &[String]| {
        let names = identifiers(names);
        quote!(&[#(#rt::Conserved::#names),*])
    };
    let (now, at_rest) = (conserved(&model.conserved_names()), conserved(&model.conserved_names_at_rest()));
    let (full, reduced) = (groups(context, &model.full.groups), groups(context, &model.reduced.groups));
    let constraint = match context.constraint() {
        Some(group) => quote!(::core::option::Option::Some(#group)),
        None => quote!(::core::option::Option::None),
    };
    // The multiplier of a constraint depends on the velocity.
    let second_order = model.constraint.is_none() && model.reduced.is_second_order();
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
            second_order: #second_order,
            domain: #domain,
            angles: #angles,
            left_out: &[#(#left_out),*],
        }
    }
}
