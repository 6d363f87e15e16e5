//! What was derived, as rustdoc and as a constant.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use crate::derive::{Component, Conserved, Equations};
use crate::ir::count::Operations;

use super::context::Context;
use super::domain;
use super::groups::groups;
use super::names::variant;
use super::number::number;

/// Documentation below the user's own, line by line.
pub(super) fn docs(context: &Context) -> Vec<String> {
    let model = context.model;
    let formulas = &model.description.formulas;
    let mut lines = vec![
        format!("`{}`", formulas.kinetic_energy.text),
        String::new(),
        format!("`{}`", formulas.hamiltonian.text),
        String::new(),
    ];
    lines.extend(equations(context));
    if !formulas.left_out.is_empty() {
        lines.push("Left out of the state:".to_owned());
        lines.extend(formulas.left_out.iter().map(|left_out| format!("- {}", left_out.what)));
        lines.push(String::new());
    }
    lines.push(match model.description.signature {
        Some((p, 0)) => format!("The kinetic metric is positive definite, ({p}, 0)."),
        Some((0, q)) => format!("The kinetic metric is negative definite, (0, {q})."),
        Some((p, q)) => format!("The kinetic metric is indefinite, ({p}, {q})."),
        None if model.point.velocity_side.is_none() => {
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
    let invariant = match (model.description.has_forces, model.constraint) {
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
    lines.push(format!("Conserved: {}.", listed(&model.description.conserved)));
    if model.translation.is_some() {
        lines.push(String::new());
        lines.push(format!("With `p = 0`: {}.", listed(&model.description.conserved_at_rest)));
    }
    lines.into_iter().map(indented).collect()
}

/// Hamilton's equations, and what they cost. The reduced ones are long, and stand in the description alone, which programs
/// print.
fn equations(context: &Context) -> Vec<String> {
    let (full, reduced) = (&context.model.dynamics.full, &context.model.dynamics.reduced);
    let counted =
        |what: &str, equations: &Equations| format!("{what}, {}", counts(equations.program.operations()));
    let what = match full == reduced {
        true => "Hamilton's equations, which are the reduced ones too",
        false => "Hamilton's equations",
    };
    let mut lines = vec![format!("{}:", counted(what, full)), "```text".to_owned()];
    lines.extend(context.model.description.formulas.equations.iter().map(|f| f.text.clone()));
    lines.push("```".to_owned());
    if full != reduced {
        lines.push(format!("{}: `DESCRIPTION.reduced_equations`.", counted("Reduced equations", reduced)));
        lines.push(String::new());
    }
    lines
}

/// A line of documentation as `///` writes it.
pub(super) fn indented(line: String) -> String {
    if line.is_empty() { line } else { format!(" {line}") }
}

fn listed(conserved: &Conserved) -> String {
    let whole = conserved.whole.iter().map(|candidate| format!("`{candidate:?}`"));
    let components = conserved.components.iter().map(|component| format!("`{}`", component.symbol));
    whole.chain(components).collect::<Vec<_>>().join(", ")
}

/// What is conserved as expressions.
fn conserved(context: &Context, Conserved { whole, components }: &Conserved) -> TokenStream {
    let rt = &context.names.rt;
    let whole = whole.iter().map(|candidate| {
        let name = variant(candidate);
        quote!(#rt::Conserved::#name)
    });
    let components = components.iter().map(|Component { symbol, entries }| {
        let terms = entries.iter().map(|entry| {
            let (factor, of) = (Literal::i64_unsuffixed(entry.factor), variant(entry.of));
            let (row, column) = (number(entry.row), number(entry.column));
            quote!(#rt::Entry { factor: #factor, of: #rt::Conserved::#of, row: #row, column: #column })
        });
        quote!(#rt::Conserved::Component(#rt::Component { symbol: #symbol, entries: &[#(#terms),*] }))
    });
    let list = whole.chain(components);
    quote!(&[#(#list),*])
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
    let [mul, add, div] = [o.mul, o.add, o.div].map(number);
    let arithmetic = quote!(#rt::Operations::arithmetic(#mul, #add, #div));
    let others = [("sqrt", o.sqrt), ("exp", o.exp), ("ln", o.ln)];
    let others = others.iter().filter(|(_, count)| *count > 0).map(|(name, count)| {
        let (name, count) = (format_ident!("{name}"), number(*count));
        quote!(#name: #count,)
    });
    let others: TokenStream = others.collect();
    if others.is_empty() { arithmetic } else { quote!(#rt::Operations { #others ..#arithmetic }) }
}

/// What the plain array and the reduced state have both, as the values of two fields, and the statement before these where it
/// is the same of both.
fn of_both<D: PartialEq + ?Sized>(
    [full, reduced]: [(&str, &D); 2],
    written: impl Fn(&D) -> TokenStream,
) -> (TokenStream, TokenStream) {
    let [name, other] = [full.0, reduced.0].map(|name| format_ident!("{name}"));
    let value = written(full.1);
    if full.1 == reduced.1 {
        return (quote!(let #name = #value;), quote!(#name, #other: #name,));
    }
    let differing = written(reduced.1);
    (TokenStream::new(), quote!(#name: #value, #other: #differing,))
}

/// A formula as an expression.
pub(super) fn formula(context: &Context, text: &str, latex: Option<&str>) -> TokenStream {
    let rt = &context.names.rt;
    match latex {
        Some(latex) => quote!(#rt::Formula { text: #text, latex: ::core::option::Option::Some(#latex) }),
        None => quote!(#rt::Formula::plain(#text)),
    }
}

/// The description as an expression.
pub(super) fn constant(context: &Context) -> TokenStream {
    let (model, rt) = (context.model, &context.names.rt);
    let name = context.names.model.to_string();
    let formulas = &model.description.formulas;
    let kinetic_energy =
        formula(context, &formulas.kinetic_energy.text, formulas.kinetic_energy.latex.as_deref());
    let hamiltonian = formula(context, &formulas.hamiltonian.text, formulas.hamiltonian.latex.as_deref());
    let left_out = formulas.left_out.iter().map(|left_out| {
        let (what, scope) = (&left_out.what, variant(left_out.scope));
        quote!(#rt::Scope::#scope.without(#what))
    });
    let both = [
        of_both([("equations", &formulas.equations), ("reduced_equations", &formulas.reduced)], |list| {
            let list = list.iter().map(|f| formula(context, &f.text, f.latex.as_deref()));
            quote!(&[#(#list),*])
        }),
        of_both(
            [
                ("conserved", &model.description.conserved),
                ("conserved_at_rest", &model.description.conserved_at_rest),
            ],
            |list| conserved(context, list),
        ),
        of_both(
            [("full", &model.dynamics.full.groups), ("reduced", &model.dynamics.reduced.groups)],
            |list| groups(context, list),
        ),
        of_both(
            [
                ("full_operations", &model.dynamics.full.program.operations()),
                ("reduced_operations", &model.dynamics.reduced.program.operations()),
            ],
            |count| operations(context, *count),
        ),
    ];
    let (shared, fields): (TokenStream, TokenStream) = both.into_iter().unzip();
    // The multiplier of a constraint depends on the velocity.
    let second_order = model.constraint.is_none() && model.dynamics.reduced.is_second_order();
    let named = |name: &str, value: TokenStream| {
        let name = format_ident!("{name}");
        quote!(#name: #value,)
    };
    let some = |value: TokenStream| quote!(::core::option::Option::Some(#value));
    let list = |entries: Vec<TokenStream>| (!entries.is_empty()).then(|| quote!(&[#(#entries),*]));
    let said = [
        (
            "signature",
            model.description.signature.map(|(p, q)| {
                let (p, q) = (number(p), number(q));
                some(quote!((#p, #q)))
            }),
        ),
        ("constraint", context.constraint().map(some)),
        ("second_order", second_order.then(|| quote!(true))),
        ("series", (!model.dynamics.reduced.has_series()).then(|| quote!(false))),
        ("dilates", model.description.dilates.then(|| quote!(true))),
        ("domain", list(domain::guards(context))),
        ("custom_potential", domain::is_custom(context).then(|| quote!(true))),
        ("angles", list(domain::angles(context))),
        ("left_out", list(left_out.collect())),
    ];
    let said = said.into_iter().filter_map(|(name, value)| value.map(|value| named(name, value)));
    let description = quote! {
        #rt::Description {
            name: #name,
            kinetic_energy: #kinetic_energy,
            hamiltonian: #hamiltonian,
            #fields
            #(#said)*
            ..#rt::Description::PLAIN
        }
    };
    if shared.is_empty() { description } else { quote!({ #shared #description }) }
}
