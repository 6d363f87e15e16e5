//! Takes the headers off the snapshots.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    let folder = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap()).join("../snapshots");
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut snapshots: Vec<PathBuf> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "snap"))
        .collect();
    snapshots.sort();
    let mut code = String::new();
    for path in snapshots {
        let snapshot = fs::read_to_string(&path).unwrap();
        let (_, expansion) =
            snapshot[3..].split_once("\n---\n").expect("a header between two lines of dashes");
        let name = path.file_stem().unwrap().to_str().unwrap();
        code += &format!("/// `{name}`\npub mod {name} {{\n{expansion}}}\n");
    }
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    fs::write(out.join("expansions.rs"), code).unwrap();
}
