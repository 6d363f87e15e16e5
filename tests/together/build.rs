//! Writes a model for each pair that the table accepts, with everything that it lets be emitted, and numbers of its own.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::PathBuf;
use std::{env, fs};

use affine_codegen::spec::{Capability, Named};

mod lists;

use lists::{Drawn, Pair, pairs};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=lists.rs");
    let (mut code, mut list) = (String::new(), String::new());
    for (number, pair) in pairs().enumerate() {
        let Some(accepted) = pair.accepted() else { continue };
        let drawn = Drawn::new(number as u64, pair.dim());
        let emitted: Vec<&str> = accepted.iter().map(|capability| capability.name()).collect();
        code += &module(number, &pair, &accepted, &pair.keys(&emitted.join(", "), &drawn), &drawn);
        list += &format!("({number}, pair_{number}::subject as fn() -> Subject), ");
    }
    code += &format!("pub(crate) fn subjects() -> Vec<(usize, fn() -> Subject)> {{ vec![{list}] }}\n");
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    fs::write(out.join("subjects.rs"), code).unwrap();
}

/// The model of a pair, and how its capabilities are asked.
fn module(number: usize, pair: &Pair, accepted: &[Capability], keys: &str, drawn: &Drawn) -> String {
    let n = pair.dim();
    let strength = drawn.value('s');
    let (item, model) = match field(pair) {
        Some(field) => (
            format!("Body {{ f: {field} }}"),
            format!("Body {{ f: {field} {{ strength: {strength:?} }} }}.prepare().unwrap()"),
        ),
        None => ("Body;".to_owned(), "Body".to_owned()),
    };
    let mut asked = String::new();
    // With a momentum squared in it a velocity does not say which momentum it belongs to.
    if !pair.energy.keys.contains("casimir3") {
        let centre = if pair.centre.keys.is_empty() { "held" } else { "free" };
        asked += &format!(".velocities(legendre!({n} {centre} model))");
    }
    for capability in accepted {
        asked += &match capability {
            // What every model has.
            Capability::Tangent | Capability::Latex => String::new(),
            Capability::Metric => format!(".metric(metric!({n} model))"),
            Capability::Acceleration => format!(".acceleration(acceleration!({n} model))"),
            Capability::Balance if pair.centre.keys.is_empty() => format!(".balance(balance!({n} model))"),
            Capability::Balance => {
                format!(".balance(balance!({n} model)).centre(centre_balance!({n} model))")
            }
            Capability::TwoPolar if accepted.contains(&Capability::Splitting) => {
                format!(".two_polar::<{n}, _>(model).lattice_pieces::<{n}, _>(model)")
            }
            other => format!(".{}::<{n}, _>(model)", other.name()),
        };
    }
    assert!(accepted.contains(&Capability::Tangent), "changes are what reduced equations are looked at by");
    format!(
        "mod pair_{number} {{
            use crate::subject::*;
            #[affine_model({keys})]
            struct {item}
            pub(super) fn subject() -> Subject {{
                let model = leaked({model});
                Subject::new::<{n}, _>(model){asked}
            }}
        }}\n"
    )
}

/// The type of the field, where there is one.
fn field(pair: &Pair) -> Option<&'static str> {
    Some(match pair.feature.name {
        "field" => "Spring",
        "force" => "Stirring",
        "gyroscope" => "Gyroscope",
        "kick" => "Squeeze",
        _ => return None,
    })
}
