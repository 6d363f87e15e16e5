//! Models that the compiler refuses, in folders by kind of mistake: one mistake a file, with what the user sees.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use affine_codegen::diagnostics::{Diagnostic, Rejected};
use proc_macro2::{LineColumn, Span, TokenStream, TokenTree};
use quote::ToTokens;
use rayon::prelude::*;
use syn::{Attribute, Item, Meta};

/// What the compiler itself is asked about, which takes it a quarter of a second a case: the kinds of items, several mistakes
/// together, lines that it shortens, programs that use a refused model, and well-posed models with calls that they have no
/// answer to.
///
/// `INSTA_UPDATE=always cargo test --test ill_posed` asks it about all, and writes its answers.
#[test]
fn the_compiler_says_so() {
    let compiler = Compiler::new();
    let writes = std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always");
    let is_asked = |path: &PathBuf| {
        let kinds = ["refused_calls", "item", "together", "used_afterwards"];
        writes || is_shortened(path) || kinds.iter().any(|kind| path.parent().unwrap().ends_with(kind))
    };
    let asked = cases().into_iter().chain(files(&folder("refused_calls"))).filter(is_asked);
    let asked: Vec<PathBuf> = asked.collect();
    assert!(asked.len() > 20, "{}", asked.len());
    let answer = |path: &PathBuf| {
        let (said, place) = (compiler.answer(path), path.with_extension("stderr"));
        if writes {
            fs::write(place, &said).unwrap();
            return None;
        }
        (fs::read_to_string(place).unwrap() != said).then(|| format!("{}:\n{said}\n", path.display()))
    };
    let wrong: Vec<String> = asked.par_iter().filter_map(answer).collect();
    assert!(wrong.is_empty(), "these cases now read:\n\n{}", wrong.join("\n"));
}

/// The compiler, beside what the cases use.
struct Compiler {
    runtime: String,
}

impl Compiler {
    fn new() -> Self {
        let mut cargo = Command::new(env!("CARGO"));
        // The selection of all tests, by which features of dependencies are those with which they have been built.
        cargo.args([
            "test",
            "--workspace",
            "--exclude=affine",
            "--lib",
            "--no-run",
            "--quiet",
            "--message-format=json",
        ]);
        let output = cargo.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let artifacts = String::from_utf8(output.stdout).unwrap();
        let mut paths = artifacts.split('"').filter(|text| text.ends_with(".rmeta"));
        let runtime = paths.find(|path| path.contains("/libaffine_runtime-")).expect("the runtime is built");
        Self { runtime: runtime.to_owned() }
    }

    /// What it says of a program that it refuses.
    fn answer(&self, path: &Path) -> String {
        let mut rustc = Command::new("rustc");
        rustc.args(["--edition=2024", "--crate-type=bin", "--emit=metadata", "--color=never", "--verbose"]);
        rustc.arg(format!("--out-dir={}", env!("CARGO_TARGET_TMPDIR")));
        rustc.arg(format!("--extern=affine_runtime={}", self.runtime));
        rustc.arg(format!("-Ldependency={}", Path::new(&self.runtime).parent().unwrap().display()));
        // Where the workspace was built, for the excerpts of its sources.
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let output = rustc.arg(path.strip_prefix(root).unwrap()).current_dir(root).output().unwrap();
        assert!(!output.status.success(), "{} compiles", path.display());
        let said = String::from_utf8(output.stderr).unwrap();
        let (said, _) = said.split_once("error: aborting due to").unwrap_or_else(|| panic!("{said}"));
        without_lines_of_others(said.trim_end()) + "\n"
    }
}

/// Excerpts of the workspace keep their files and no numbers of lines, which move with every change, nor the margin that the
/// compiler leaves for those.
fn without_lines_of_others(said: &str) -> String {
    said.split("\n\n").map(without_lines_of_others_in).collect::<Vec<_>>().join("\n\n")
}

/// The same of one error.
fn without_lines_of_others_in(error: &str) -> String {
    let (mut of_others, mut margin, mut own_margin) = (false, 0, 1);
    let mut lines = Vec::new();
    for line in error.lines() {
        let text = line.trim_start();
        let indent = &line[..line.len() - text.len()];
        let digits = text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let numbered = digits > 0 && text[digits..].trim_start().starts_with('|');
        if let Some((arrow, place)) = text.split_once(' ').filter(|(arrow, _)| ["-->", ":::"].contains(arrow))
        {
            margin = indent.len();
            of_others = !place.starts_with("tests/");
            let file = match place.strip_prefix("tests/") {
                Some(own) => own.to_owned(),
                None => format!("$WORKSPACE/{}", place.split(':').next().unwrap()),
            };
            lines.push(format!("{indent}{arrow} {file}"));
        } else if numbered && of_others {
            lines.push(format!("{indent}{}{}", " ".repeat(digits), &text[digits..]));
        } else {
            own_margin = if numbered { own_margin.max(digits) } else { own_margin };
            lines.push(line.to_owned());
        }
    }
    let spare = " ".repeat(margin.saturating_sub(own_margin));
    // A message without a margin goes on below itself.
    let mut without_margin = true;
    let narrower = lines.iter().map(|line| {
        let text = line.trim_start();
        without_margin = (without_margin || text.len() == line.len())
            && !text.starts_with(|c: char| c.is_ascii_digit() || "|=-:".contains(c));
        if without_margin { line } else { line.strip_prefix(&spare).unwrap_or(line) }
    });
    narrower.collect::<Vec<_>>().join("\n")
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.filter(|path| path.extension().is_some_and(|extension| extension == "rs")).collect()
}

/// Cases with a line that is wider than what the compiler prints.
const SHORTENED: [&str; 2] = ["expression/expression_size", "symmetry/reflection"];

fn is_shortened(path: &Path) -> bool {
    SHORTENED.iter().any(|case| path.with_extension("").ends_with(case))
}

/// What the compiler makes of the errors of the macro; a case costs five milliseconds.
#[test]
fn every_refusal_is_printed_so() {
    let mut wrong = String::new();
    for (path, said) in outcomes() {
        let printed = printed(&path);
        if is_shortened(&path) {
            assert_ne!(printed.trim_end(), said.trim_end(), "{} is not shortened", path.display());
            continue;
        }
        if printed.trim_end() != said.trim_end() {
            wrong += &format!("{}:\n{printed}\n", path.display());
        }
    }
    assert!(wrong.is_empty(), "these cases now read:\n\n{wrong}");
}

/// The errors of every model of a program, as the compiler prints them.
fn printed(path: &Path) -> String {
    let source = fs::read_to_string(path).unwrap();
    let file = syn::parse_file(&source).unwrap();
    let name = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap().display().to_string();
    let errors = file.items.into_iter().flat_map(|item| {
        let Some((attribute, item)) = model(item) else { return Vec::new() };
        let args = match &attribute.meta {
            Meta::List(list) => list.tokens.clone(),
            _ => TokenStream::new(),
        };
        let Err(rejected) = affine_codegen::model(args, item) else { return Vec::new() };
        places(&rejected)
            .into_iter()
            .zip(rejected.diagnostics())
            .map(|(place, message)| error(&source, &name, &attribute, place, &message.to_string()))
            .collect()
    });
    errors.collect::<Vec<_>>().join("\n")
}

/// The attribute, and the item without it.
fn model(mut item: Item) -> Option<(Attribute, TokenStream)> {
    let attributes = match &mut item {
        Item::Struct(item) => &mut item.attrs,
        Item::Enum(item) => &mut item.attrs,
        Item::Fn(item) => &mut item.attrs,
        _ => return None,
    };
    let known = attributes.iter().position(|attribute| attribute.path().is_ident("affine_model"))?;
    let attribute = attributes.remove(known);
    Some((attribute, item.to_token_stream()))
}

/// From the first to the last token of each `compile_error!`; `None` is the place of the attribute itself.
fn places(rejected: &Rejected) -> Vec<Option<Span>> {
    let tokens: Vec<TokenTree> = rejected.compile_errors().into_iter().collect();
    let place = |error: &[TokenTree]| {
        let whole = error.first()?.span().join(error.last()?.span())?;
        whole.source_text().filter(|text| !text.is_empty()).map(|_| whole)
    };
    tokens.chunks(8).map(place).collect()
}

/// An error that underlines a part of one line.
fn error(source: &str, file: &str, attribute: &Attribute, place: Option<Span>, message: &str) -> String {
    let whole = || attribute.pound_token.span.join(attribute.bracket_token.span.close()).unwrap();
    let (note, place) = match place {
        Some(place) => ("", place),
        None => (NOTE, whole()),
    };
    let (LineColumn { line, column }, end) = (place.start(), place.end());
    assert_eq!(line, end.line, "{file}: one line is underlined");
    let number = line.to_string();
    let margin = " ".repeat(number.len());
    let code = source.lines().nth(line - 1).unwrap();
    let (indent, carets) = (" ".repeat(column), "^".repeat(end.column - column));
    let message = message.replace('\n', "\n       ");
    let bar = if note.is_empty() { String::new() } else { format!("{margin} |\n{margin} = {note}\n") };
    format!(
        "error: {message}\n{margin}--> {file}:{line}:{}\n{margin} |\n{number} | {code}\n{margin} | {indent}{carets}\n{bar}",
        column + 1
    )
}

/// What the compiler adds where an error stands at the attribute.
const NOTE: &str = "note: this error originates in the attribute macro `affine_model` (in Nightly builds, run with -Z macro-backtrace for more info)";

/// Calls of what a feature has do not compile without it, and the compiler names the feature: `affine-features` is checked
/// with the features that it asks for itself.
#[test]
fn calls_name_the_feature_that_is_off() {
    let folder = folder("features");
    let mut cargo = Command::new(env!("CARGO"));
    cargo
        .args(["check", "--profile=test", "--quiet", "--color=never", "--package=affine-features"])
        // Of the compiler alone: one that looks for lints writes types otherwise.
        .env_remove("RUSTC_WORKSPACE_WRAPPER")
        .current_dir(&folder);
    let output = cargo.output().unwrap();
    assert!(!output.status.success(), "the calls compile without the feature");
    let said = String::from_utf8(output.stderr).unwrap();
    let (said, _) = said.split_once("\nFor more information").unwrap_or_else(|| panic!("{said}"));
    assert_eq!(
        said.trim_end(),
        fs::read_to_string(folder.join("report.stderr")).unwrap().trim_end(),
        "\n{said}"
    );
}

fn cases() -> Vec<PathBuf> {
    let kinds = fs::read_dir(folder("ill_posed")).unwrap().map(|entry| entry.unwrap().path());
    kinds.flat_map(|kind| files(&kind)).collect()
}

/// What the compiler says, case by case.
fn outcomes() -> Vec<(PathBuf, String)> {
    let outcome = |path: PathBuf| {
        let text = fs::read_to_string(path.with_extension("stderr")).unwrap();
        (path, text)
    };
    cases().into_iter().map(outcome).collect()
}

/// Users depend on one crate: what it consists of is named in no message.
#[test]
fn inner_crates_are_not_named() {
    let calls = Path::new(env!("CARGO_MANIFEST_DIR")).join("refused_calls");
    let calls = fs::read_dir(calls).unwrap().map(|entry| entry.unwrap().path());
    let calls = calls.filter(|path| path.extension().is_some_and(|extension| extension == "stderr"));
    let calls: Vec<_> = calls.map(|path| (path.clone(), fs::read_to_string(path).unwrap())).collect();
    assert!(!calls.is_empty());
    for (path, text) in outcomes().into_iter().chain(calls) {
        let named = ["affine_core", "affine_integrators"].into_iter().find(|name| text.contains(name));
        assert_eq!(named, None, "{}", path.display());
    }
}

/// What no specification leads to: a fault of the macro itself.
const OF_THE_MACRO: &str = "impossible";

#[test]
fn every_mistake_has_a_case() {
    let outcomes = outcomes();
    let seen = |name: &str| {
        name == OF_THE_MACRO || outcomes.iter().any(|(_, text)| text.contains(&format!(" [{name}]\n")))
    };
    let missing: BTreeSet<&str> = Diagnostic::names().filter(|name| !seen(name)).collect();
    assert!(missing.is_empty(), "no case for {missing:?}");
}

/// Every error is one of ours: a refused model, used or not, raises no others.
#[test]
fn nothing_cascades() {
    for (path, text) in outcomes() {
        let errors = text.lines().filter(|line| line.starts_with("error") || line.starts_with("warning"));
        for line in errors {
            let ours = Diagnostic::names().any(|name| line.ends_with(&format!(" [{name}]")));
            assert!(ours, "{}: {line}", path.display());
        }
    }
}

#[test]
fn two_mistakes_arrive_together() {
    let (_, text) = outcomes().into_iter().find(|(path, _)| path.ends_with("two_mistakes.rs")).unwrap();
    assert!(text.contains(" [unknown-symbol]\n") && text.contains(" [division-by-zero]\n"), "{text}");
}
