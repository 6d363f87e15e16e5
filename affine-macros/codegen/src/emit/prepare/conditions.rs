//! What is asked of the values of the fields, and what only numbers give: inverse blocks and principal axes.

use proc_macro2::TokenStream;
use quote::quote;

use crate::derive::splitting::PrincipalProgram;
use crate::derive::{Condition, NumericBlock, Relation};
use crate::emit::body::Body;
use crate::emit::context::Context;
use crate::emit::fields::over_fields;
use crate::emit::metrics;
use crate::emit::names::Names;
use crate::emit::number::{double, number};
use crate::emit::pattern::{identifiers, table};

/// What must not vanish.
pub(super) fn well_posed(names: &Names, conditions: &[Condition]) -> TokenStream {
    let (rt, entries) = (&names.rt, conditions.iter().map(|one| condition(one, names)));
    quote!(#rt::well_posed(&[#(#entries),*])?;)
}

fn condition(condition: &Condition, names: &Names) -> TokenStream {
    let positive = condition.positive;
    let text = format!("{} {} 0", condition.factor.name(), if positive { ">" } else { "!=" });
    let (given, sought) = match condition.relation {
        Relation::MomentumOfVelocity => ("velocity", "momentum"),
        Relation::VelocityOfMomentum => ("momentum", "velocity"),
    };
    let remedy = if positive {
        "choose fields that make it positive".to_owned()
    } else {
        format!("choose fields that keep it away from zero, or the {sought} does not determine the {given}")
    };
    let reason = format!(
        "on {} the {sought} is {} times the {given}; {remedy}",
        condition.directions,
        condition.factor.name()
    );
    held(condition, &text, &reason, names)
}

/// What the dissipation must not be: negative.
pub(super) fn semidefinite(names: &Names, conditions: &[Condition]) -> TokenStream {
    let rt = &names.rt;
    let entries = conditions.iter().map(|condition| {
        let text = format!("{} >= 0", condition.factor.name());
        let reason = format!(
            "on {} the dissipation function R is half of {} times the square of the velocity; where R < 0 its \
             forces would feed energy in",
            condition.directions,
            condition.factor.name(),
        );
        held(condition, &text, &reason, names)
    });
    quote!(#rt::semidefinite(&[#(#entries),*])?;)
}

/// The same of a block whose eigenvalues numbers give.
pub(super) fn semidefinite_form(names: &Names, block: &NumericBlock) -> TokenStream {
    let rt = &names.rt;
    let Body { lets, results } = over_fields(names, &block.program);
    let (size, count) = (block.size, block.size * (block.size + 1) / 2);
    let (entries, terms) = results.split_at(count);
    let (size, count) = (number(size), number(count));
    quote! {
        {
            #lets
            #rt::semidefinite_form::<#size, #count, _>([#(#entries),*], #rt::total_size([#(#terms),*]))?;
        }
    }
}

/// A condition with the program of its value and of the sizes that rounding errors are measured by.
fn held(condition: &Condition, text: &str, reason: &str, names: &Names) -> TokenStream {
    let (positive, rt, t) = (condition.positive, &names.rt, &names.scalar);
    let Body { lets, results } = over_fields(names, &condition.program);
    let (value, sizes) =
        results.split_first().map_or((quote!(#t::zero()), &[][..]), |(value, sizes)| (value.clone(), sizes));
    quote! {
        {
            #lets
            #rt::Condition {
                condition: #text,
                reason: #reason,
                positive: #positive,
                value: #rt::Real::to_f64(#value),
                size: #rt::total_size([#(#sizes),*]),
            }
        }
    }
}

/// The statement that inverts a block in numbers, and names the entries of the inverse.
pub(super) fn inverse(context: &Context, block: &NumericBlock) -> TokenStream {
    let (names, rt, t) = (context.names, &context.names.rt, &context.names.scalar);
    let Body { lets, results } = over_fields(names, &block.program);
    let names_of_entries = identifiers(&block.inverse);
    let (dim, size, positive) = (context.dim(), number(block.size), block.positive);
    let count = number(block.inverse.len());
    let (entries, terms) = results.split_at(block.inverse.len());
    let basis = block.basis.iter().map(|vector| {
        let entries = vector.iter().map(|(place, weight)| {
            let (place, weight) = (number(*place), double(weight.to_doubles().0));
            quote!((#place, #weight))
        });
        quote!(&[#(#entries),*])
    });
    let inverted = quote! {
        #rt::inverse_form::<#dim, #size, #count, _>(
            [#(#entries),*],
            #rt::total_size([#(#terms),*]),
            #positive,
            [#(#basis),*],
        )
    };
    let inverted = metrics::told_in_given_bases(context, inverted);
    quote! {
        let [#(#names_of_entries),*]: [#t; #count] = {
            #lets
            #inverted?
        };
    }
}

/// Eigenvalues and eigenvectors of a form.
pub(super) fn principal(names: &Names, form: &PrincipalProgram) -> TokenStream {
    let rt = &names.rt;
    let Body { lets, results } = over_fields(names, &form.program);
    let (size, count) = (number(form.values.len()), number(results.len()));
    let values = identifiers(&form.values);
    let vectors = table(&form.vectors);
    quote! {
        let ([#(#values),*], #vectors) = {
            #lets
            #rt::principal_axes::<#size, #count, _>([#(#results),*])
        };
    }
}
