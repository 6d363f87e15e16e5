//! What is read from an attribute and a struct, and what happens to the struct when a model is refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_codegen::check;
use affine_codegen::diagnostics::gate;
use affine_codegen::expand;
use affine_codegen::spec::{Claim, Named, Spec, TermKind, Value, parse};
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

fn read(args: TokenStream, item: TokenStream) -> Spec {
    let spec = gate(|found| parse(args, item, found)).expect("a specification");
    gate(|found| check::as_written(&spec, found)).expect("a well-posed specification");
    spec
}

fn terms(spec: &Spec) -> Vec<(TermKind, Vec<String>)> {
    let texts = |value: &Value| value.expressions().map(ToString::to_string).collect();
    spec.kinetic.iter().map(|term| (term.kind.value, texts(&term.value))).collect()
}

#[test]
fn the_drunk_missile() {
    let spec = read(
        quote! {
            dim = 3,
            symmetry(space = affine, body = metric),
            kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1),
        },
        quote!(
            pub struct DrunkMissile;
        ),
    );
    assert_eq!(spec.dim.value, 3);
    let symmetry = spec.symmetry.expect("a claim");
    assert_eq!((symmetry.space.value, symmetry.body.value), (Claim::Affine, Claim::Metric));
    let expected = [
        (TermKind::Casimir2, "0.2"),
        (TermKind::Casimir1Squared, "0.1"),
        (TermKind::BodyInertia, "1"),
        (TermKind::BodyTranslation, "1"),
    ];
    assert_eq!(terms(&spec), expected.map(|(kind, value)| (kind, vec![value.to_owned()])));
    assert_eq!(spec.item.ident, "DrunkMissile");
    assert!(spec.item.fields.is_empty() && spec.runtime.is_none() && spec.emit.is_empty());
}

#[test]
fn fields_generics_matrices_and_the_rest() {
    let item = quote! {
        #[derive(Clone, Debug)]
        pub(crate) struct Droplet<'a, P: Potential> where P: Copy {
            pub i: f64,
            a: ::core::primitive::f64,
            label: &'a str,
            potential: P,
        }
    };
    let spec = read(
        quote! {
            crate = ::elsewhere::runtime,
            require(positive_definite,),
            dim = 2,
            symmetry(body = none),
            kinetic(dalembert = [[i, a*(1 + i)], [a + a*i, i^2]], space_translation = 2*i + n),
        },
        item.clone(),
    );
    let expected = [
        (TermKind::Dalembert, vec!["i", "a*(1 + i)", "a + a*i", "i^2"]),
        (TermKind::SpaceTranslation, vec!["2*i + n"]),
    ];
    let expected =
        expected.map(|(kind, texts)| (kind, texts.into_iter().map(str::to_owned).collect::<Vec<_>>()));
    assert_eq!(terms(&spec), expected);
    assert_eq!(spec.item.tokens.to_string(), item.to_string());
    assert_eq!(spec.item.attributes.len(), 1);
    assert_eq!(spec.item.generics.params.len(), 2);
    assert_eq!(spec.item.visibility.to_token_stream().to_string(), "pub (crate)");
    let reals: Vec<bool> = spec.item.fields.iter().map(|field| field.is_real()).collect();
    assert_eq!(reals, [true, true, false, false]);
    assert_eq!(spec.runtime.expect("a path").to_token_stream().to_string(), ":: elsewhere :: runtime");
    assert_eq!(spec.require.len(), 1);
    let claims = spec.symmetry.map(|s| [s.space.value, s.body.value]).expect("a claim");
    assert_eq!(claims, [Claim::None; 2]);
}

#[test]
fn every_term_is_read_in_both_dimensions() {
    for n in [2_usize, 3] {
        for kind in TermKind::ALL {
            let name: TokenStream = kind.name().parse().expect("a name");
            let value: TokenStream = if kind.is_tensor() {
                let row = |i| (0..n * n).map(|j| if i == j { "1," } else { "0," }).collect::<String>();
                let rows: Vec<String> = (0..n * n).map(|i| format!("[{}]", row(i))).collect();
                format!("[{}]", rows.join(",")).parse().expect("a matrix")
            } else {
                quote!(1)
            };
            let n = proc_macro2::Literal::usize_unsuffixed(n);
            // A translation alone is no model.
            let internal = kind.is_translation().then(|| quote!(casimir2 = 1,));
            let spec = read(
                quote!(dim = #n, kinetic(#internal #name = #value)),
                quote!(
                    struct M;
                ),
            );
            assert!(spec.term(*kind).is_some());
        }
    }
}

#[test]
fn a_refused_struct_is_emitted_unchanged_with_every_reason() {
    let item = quote! {
        #[derive(Clone)]
        #[repr(C)]
        pub struct Model<T> where T: Copy { #[doc = "kept"] pub a: f64, t: T }
    };
    let tokens = expand(quote!(dim = 4, kinetic(casimir2 = b), emit(splitting)), item.clone()).to_string();
    let rest = tokens.strip_prefix(&item.to_string()).expect("the item comes first");
    assert_eq!(rest.matches(":: core :: compile_error !").count(), 3);
}

#[test]
fn an_accepted_struct_is_emitted_too() {
    let item = quote!(
        #[derive(Clone)]
        pub struct Model {
            pub a: f64,
        }
    );
    let tokens = expand(quote!(dim = 2, kinetic(casimir2 = a, body_inertia = 1)), item.clone()).to_string();
    assert!(tokens.starts_with(&item.to_string()) && !tokens.contains("compile_error"));
}

#[test]
fn the_longest_expressions_pass_every_rule() {
    let sum = vec!["a"; 257].join("+");
    let divisor = vec!["a"; 256].join("-");
    let nested = format!("{}a{}", "2*(1 + ".repeat(15), ")".repeat(15));
    for value in [sum, format!("1/({divisor})"), nested] {
        let value: TokenStream = value.parse().expect("tokens");
        let spec = read(
            quote!(dim = 2, kinetic(dalembert = #value)),
            quote!(
                struct M {
                    a: f64,
                }
            ),
        );
        assert!(gate(|found| check::form(&spec, found)).is_ok());
    }
}
