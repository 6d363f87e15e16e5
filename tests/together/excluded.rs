//! What goes together: every part beside every other, held against the table, and the table in the documentation.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_codegen::check::{Part, Refusal, refusals, table};
use affine_codegen::model;
use affine_codegen::spec::{Capability, Named};
use proc_macro2::TokenStream;

mod lists;

use lists::{Drawn, pairs};

/// What an expansion says: nothing, or the short names of its mistakes and its text.
fn said(keys: &str) -> Option<(Vec<&'static str>, String)> {
    let tokens = |text: &str| text.parse::<TokenStream>().expect("tokens");
    let field = if keys.contains("custom") { "struct M { f: F }" } else { "struct M;" };
    let rejected = model(tokens(keys), tokens(field)).err()?;
    let names = rejected.diagnostics().map(|diagnostic| diagnostic.name()).collect();
    Some((names, rejected.diagnostics().map(|diagnostic| format!("{diagnostic}\n")).collect()))
}

/// An expansion is refused by the table exactly if two of its parts stand in it.
fn assert_as_the_table(keys: &str, parts: &[Part]) {
    let pairs = refusals().filter(|refusal| parts.contains(&refusal.part) && parts.contains(&refusal.beside));
    // What a potential depends on is seen where nothing is wrong before.
    let late = [Part::OnTime, Part::OnStretches, Part::OnCentre];
    let (late, early): (Vec<Refusal>, Vec<Refusal>) = pairs.partition(|pair| late.contains(&pair.beside));
    let first = if early.is_empty() { late } else { early };
    let reasons: Vec<&str> = first.iter().map(|refusal| refusal.why).collect();
    let (names, text) = said(keys).unwrap_or_default();
    let by_the_table = names.iter().filter(|name| **name == "beside").count();
    assert_eq!(by_the_table > 0, !reasons.is_empty(), "{keys}: {parts:?}\n{reasons:#?}\n{text}");
    for reason in &reasons {
        assert!(text.contains(reason), "{keys}: not said: {reason}\n{text}");
    }
    // What else may be wrong is no matter of pairs.
    let known = ["beside", "fixed-centre"];
    assert!(names.iter().all(|name| known.contains(name)), "{keys}: {names:?}\n{text}");
}

/// Every energy with every feature and every centre, with everything that can be emitted.
#[test]
fn every_pair_as_the_table_says() {
    let mut tried = 0;
    for (number, pair) in pairs().enumerate() {
        let drawn = Drawn::new(number as u64, pair.dim());
        for capability in Capability::ALL.iter().copied() {
            let asked = match capability {
                Capability::Ratios => "two_polar, ratios",
                other => other.name(),
            };
            let mut parts = pair.parts();
            parts.push(Part::Emitted(capability));
            if capability == Capability::Ratios {
                parts.push(Part::Emitted(Capability::TwoPolar));
            }
            assert_as_the_table(&pair.keys(asked, &drawn), &parts);
            tried += 1;
        }
    }
    assert_eq!(tried, 7 * (15 + 14 + 2 * 2) * 11);
}

/// Whatever the table lets be emitted beside a pair goes together at once; `main` compiles it.
#[test]
fn everything_that_goes_with_a_pair_goes_together() {
    let mut tried = 0;
    for (number, pair) in pairs().enumerate() {
        let Some(accepted) = pair.accepted() else { continue };
        let emitted: Vec<&str> = accepted.iter().map(|capability| capability.name()).collect();
        let keys = pair.keys(&emitted.join(", "), &Drawn::new(number as u64, pair.dim()));
        assert_eq!(
            said(&keys),
            None,
            "{}, {}, centre {}",
            pair.energy.name,
            pair.feature.name,
            pair.centre.name
        );
        tried += 1;
    }
    assert_eq!(tried, 7 * (15 + 14 + 2 * 2) - 20);
}

/// The page of the attribute has the table.
#[test]
fn the_table_is_documented() {
    let page = include_str!("../../affine-macros/docs/attribute.md");
    assert!(page.contains(&table()), "the page of the attribute should have:\n{}", table());
}
