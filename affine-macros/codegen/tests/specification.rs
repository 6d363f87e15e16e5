//! What is read from an attribute and a struct, and what happens to the struct when a model is refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_codegen::check;
use affine_codegen::diagnostics::gate;
use affine_codegen::expand;
use affine_codegen::spec::{Claim, POTENTIAL_SYMBOLS, SYMBOLS, Spec, Symbol, Value, parse};
use affine_codegen::symbol::TermKind;
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::parse::Parser;

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
    assert_eq!(spec.item.documented(&[]).to_string(), item.to_string());
    let documented: syn::DeriveInput =
        syn::parse2(spec.item.documented(&["T".to_owned()])).expect("a struct");
    // What the user wrote, a gap, and the line.
    assert_eq!(documented.attrs.len(), 1 + 2);
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
            assert!(spec.term(kind).is_some());
        }
    }
}

fn with_potential(potential: TokenStream) -> Spec {
    read(
        quote!(dim = 3, potential = #potential, kinetic(casimir2 = 1, body_translation = m)),
        quote!(
            struct M {
                m: f64,
                kappa: f64,
                law: Law,
            }
        ),
    )
}

#[test]
fn a_potential_of_every_form() {
    let spec = with_potential(quote!(
        kappa/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n) + D^-2/det + I1*I2 - I3 + tr(Ct*phi)*G[1, 3] + m*x[3]*cos(q)
            + 4*((kappa/norm(x))^12 - (kappa/norm(x))^6)
    ));
    let energy = spec.potential.expect("a potential").energy.to_string();
    let expected = "kappa/2*sinh(q)^2 + 0.5*(tr(G)*exp(-2*q) - n) + D^-2/det + I1*I2 - I3 + tr(Ct*phi)*G[1,3] \
                    + m*x[3]*cos(q) + 4*((kappa/norm(x))^12 - (kappa/norm(x))^6)";
    assert_eq!(energy, expected);
}

#[test]
fn names_of_a_potential_mean_what_the_table_says() {
    let spec = with_potential(quote!(q));
    let letter = |name: &str| {
        let name = proc_macro2::Ident::new(name, proc_macro2::Span::call_site());
        match spec.resolve_in_potential(&name) {
            None => '?',
            Some(Symbol::Dimension) => 'n',
            Some(Symbol::Dilatation) => 'q',
            Some(Symbol::Scale) => 'D',
            Some(Symbol::Determinant) => 'd',
            Some(Symbol::Time) => 't',
            Some(Symbol::Invariant(index)) => char::from_digit(u32::try_from(index).unwrap(), 10).unwrap(),
            Some(Symbol::Stretch(_)) => 's',
            Some(Symbol::Difference) => 'e',
            Some(Symbol::Matrix(_)) => 'M',
            Some(Symbol::Centre) => 'x',
            Some(Symbol::Field(_)) => 'f',
        }
    };
    let names = "n q D det t x G Ct phi I1 I2 I3 q1 Q3 d kappa law I q12 i1 Phi";
    assert_eq!(names.split(' ').map(letter).collect::<String>(), "nqDdtxMMM123sseff????");
    // Every symbol that a field must not hide has a meaning of its own.
    for (name, _) in SYMBOLS.iter().chain(&POTENTIAL_SYMBOLS) {
        assert!(!matches!(letter(name), '?' | 'f'), "{name}");
    }
}

#[test]
fn without_a_potential_fields_may_have_the_names_of_its_symbols() {
    let item = quote!(
        struct M {
            q: f64,
            det: f64,
            G: f64,
        }
    );
    read(quote!(dim = 2, kinetic(casimir2 = q + det, body_inertia = G)), item.clone());
    let spec = gate(|found| parse(quote!(dim = 2, kinetic(casimir2 = 1), potential = q), item, found));
    let rejected =
        gate(|found| check::as_written(&spec.expect("a specification"), found)).expect_err("refused");
    assert_eq!(rejected.diagnostics().filter(|one| one.name() == "hidden-symbol").count(), 3);
}

/// Whatever the signs around them, but a minus of their own.
#[test]
fn summands_that_are_no_formulas_stand_anywhere_in_a_sum() {
    let item = quote!(
        struct M {
            u: Energy,
        }
    );
    let of = |potential: TokenStream| quote!(dim = 3, kinetic(body_inertia = 1), potential = #potential);
    for (potential, counts) in [
        (quote!(custom(u, isotropic) - 30 * q), [1, 0]),
        (quote!(-30 * q + custom(u, isotropic)), [1, 0]),
        (quote!(q * -2 - q ^ -2 + custom(u, isotropic) - -q ^ 2), [1, 0]),
        (quote!(tr(G) + self_gravity(1) - 30 * q), [0, 1]),
        (quote!(self_gravity(1) - 30 * q + custom(u, isotropic)), [1, 1]),
    ] {
        let spec = read(of(potential.clone()), item.clone());
        assert_eq!([spec.customs.len(), spec.self_gravity.len()], counts, "{potential}");
        assert!(spec.potential.is_some(), "{potential}");
    }
    for potential in
        [quote!(-custom(u, isotropic)), quote!(q - self_gravity(1)), quote!(q * -custom(u, isotropic))]
    {
        assert!(gate(|found| parse(of(potential.clone()), item.clone(), found)).is_err(), "{potential}");
    }
}

#[test]
fn a_refused_model_with_a_potential_has_a_stand_in() {
    for potential in [quote!(abs(q)), quote!(kapa * q), quote!(custom(law)), quote!(x[1]), quote!(2 q)] {
        let item = quote!(
            pub struct Model {
                pub kappa: f64,
            }
        );
        let args = quote!(dim = 2, kinetic(casimir2 = kappa), potential = #potential);
        let tokens = expand(args, item).to_string();
        assert!(tokens.contains("compile_error") && tokens.contains("fn prepare"), "{potential}");
    }
}

#[test]
fn a_refused_struct_is_emitted_unchanged_with_every_reason() {
    let item = quote! {
        #[derive(Clone)]
        #[repr(C)]
        pub struct Model<T> where T: Copy { #[doc = "kept"] pub a: f64, t: T }
    };
    let tokens = expand(quote!(dim = 4, kinetic(casimir2 = b), emit(ratios)), item.clone()).to_string();
    let rest = tokens.strip_prefix(&item.to_string()).expect("the item comes first");
    assert_eq!(rest.matches(":: core :: compile_error !").count(), 3);
}

#[test]
fn an_accepted_struct_is_emitted_too() {
    let attribute = quote!(#[derive(Clone)]);
    let declaration = quote!(
        pub struct Model {
            pub a: f64,
        }
    );
    let item = quote!(#attribute #declaration);
    let tokens = expand(quote!(dim = 2, kinetic(casimir2 = a, body_inertia = 1)), item).to_string();
    // Between them stands the documentation, and nothing else.
    let rest = tokens.strip_prefix(&attribute.to_string()).expect("the attribute comes first");
    let (documentation, _) = rest.split_once(&declaration.to_string()).expect("the declaration follows");
    let documentation = syn::Attribute::parse_outer.parse_str(documentation).expect("attributes");
    assert!(documentation.len() > 3 && documentation.iter().all(|line| line.path().is_ident("doc")));
    assert!(!tokens.contains("compile_error"));
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
        assert!(gate(|found| check::energy(&spec, found)).is_ok());
    }
}
