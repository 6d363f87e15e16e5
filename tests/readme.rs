//! What README, guide and audit show: programs that can be copied, commands that exist, sentences that can be read.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn text(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The README files of the workspace and of its crates.
const READMES: [&str; 6] = [
    "README.md",
    "affine-runtime/README.md",
    "affine-runtime/core/README.md",
    "affine-runtime/integrators/README.md",
    "affine-macros/README.md",
    "affine-macros/codegen/README.md",
];

/// These, the pages of the guide and the parts of its gallery, with their paths.
fn guide() -> Vec<(String, String)> {
    let pages = ["affine-runtime/docs", "affine-runtime/docs/gallery"].into_iter().flat_map(|folder| {
        let pages = files(folder, ".md").into_iter();
        pages.map(move |name| format!("{folder}/{name}"))
    });
    pages.chain(READMES.map(str::to_owned)).map(|name| (name.clone(), text(&name))).collect()
}

/// Names of the files of a folder that end so.
fn files(folder: &str, end: &str) -> BTreeSet<String> {
    let files = fs::read_dir(root().join(folder)).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name.ends_with(end)).collect()
}

/// Lines that rustdoc hides are shown everywhere else, and statements without a function compile nowhere else.
#[test]
fn examples_are_programs() {
    let mut examples = 0;
    for (page, text) in guide() {
        for example in text.split("```rust\n").skip(1).map(|rest| rest.split("```").next().unwrap()) {
            examples += 1;
            assert!(example.contains("fn main()"), "{page}: {example}");
            assert!(!example.lines().any(|line| line == "#" || line.starts_with("# ")), "{page}: {example}");
        }
    }
    assert!(examples >= 25, "{examples}");
}

/// The files that a page links, beside it.
fn linked(page: &str) -> impl Iterator<Item = &str> {
    let targets = page.split("](").skip(1).map(|rest| rest.split([')', '#']).next().unwrap());
    targets.filter(|target| !target.starts_with("http") && !target.contains("::"))
}

/// Links lead to files; pages of the guide name each other as rustdoc does, and each is one of its modules.
#[test]
fn links_lead_somewhere_and_every_page_is_in_the_guide() {
    let mut links = 0;
    for target in
        linked(&text("README.md")).chain(linked(&text("tests/AUDIT.md")).filter(|to| to.ends_with(".md")))
    {
        links += 1;
        let beside = [root().join(target), root().join("tests").join(target)];
        assert!(beside.iter().any(|path| path.exists()), "no file {target}");
    }
    assert!(links >= 12, "{links}");

    let library = text("affine-runtime/src/lib.rs");
    let lists = library.split("pages! {").skip(1).map(|list| list.split_once('}').unwrap().0);
    let modules: BTreeSet<&str> = lists.flat_map(str::split_whitespace).collect();
    let pages = guide();
    let names = files("affine-runtime/docs", ".md");
    let names: BTreeSet<&str> =
        names.iter().map(|name| name.trim_end_matches(".md")).filter(|name| *name != "gallery").collect();
    assert_eq!(modules, names);
    // A file beside a page is none beside its module.
    for (path, page) in pages.iter().filter(|(path, _)| path.contains("/docs/")) {
        assert_eq!(linked(page).collect::<Vec<_>>(), [""; 0], "{path}");
    }
}

/// Bytes of all pictures, which travel with the crate and stand in one page of its documentation.
const PICTURES: u64 = 500_000;

/// The gallery has a text and a picture of each of its parts, and an example of that name.
#[test]
fn the_gallery_has_a_picture_of_each_example() {
    let library = text("affine-runtime/src/lib.rs");
    let (_, list) = library.split_once("gallery! {\n").unwrap();
    let listed: BTreeSet<&str> = list.split_once('}').unwrap().0.split_whitespace().collect();
    let folder = "affine-runtime/docs/gallery";
    for end in [".md", ".svg"] {
        let names = files(folder, end);
        assert_eq!(names.iter().map(|name| name.trim_end_matches(end)).collect::<BTreeSet<_>>(), listed);
    }
    let mut size = 0;
    for name in listed {
        assert!(text(&format!("{folder}/{name}.md")).starts_with("# "), "{name}");
        // What rustdoc takes as it is: one element without an empty line.
        let picture = text(&format!("{folder}/{name}.svg"));
        assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"), "{name}");
        assert!(!picture.contains("\n\n"), "{name}");
        size += picture.len() as u64;
        program(&root().join("examples"), name);
    }
    assert!(size < PICTURES, "{size}");
}

/// Words of the longest sentence that a reader has to hold together.
const LONGEST_SENTENCE: usize = 30;

#[test]
fn no_sentence_is_long() {
    for (page, text) in guide() {
        let long: Vec<String> =
            sentences(&text).filter(|sentence| words(sentence) > LONGEST_SENTENCE).collect();
        assert!(long.is_empty(), "{page}: {long:#?}");
    }
}

/// The sentences of paragraphs and items of lists; code, tables, pictures and headings left aside.
fn sentences(page: &str) -> impl Iterator<Item = String> {
    let prose: Vec<&str> = page.split("```").step_by(2).collect();
    let lines = prose.join("\n\n");
    let lines = lines.lines().map(str::trim).map(|line| match line.chars().next() {
        Some('|' | '#' | '!') => "\n\n".to_owned(),
        Some('-') => format!("\n\n{line}"),
        _ => format!("{line}\n"),
    });
    let paragraphs: String = lines.collect();
    let paragraphs: Vec<String> = paragraphs.split("\n\n").map(|text| text.replace('\n', " ")).collect();
    paragraphs.into_iter().flat_map(|text| text.split_inclusive(". ").map(str::to_owned).collect::<Vec<_>>())
}

/// Code is one word, whatever stands in it.
fn words(sentence: &str) -> usize {
    let outside = sentence.split('`').enumerate();
    let text: String = outside.map(|(k, text)| if k % 2 == 0 { text } else { "code" }).collect();
    text.split_whitespace().count()
}

/// Commands in code, `cargo test ..` and `cargo run ..`, on one line or two.
fn commands() -> BTreeSet<String> {
    let mut commands = BTreeSet::new();
    let others = ["tests/AUDIT.md", "tests/README.md"].map(|page| (page.to_owned(), text(page)));
    for (_, text) in guide().into_iter().chain(others) {
        let text = text.replace('\n', " ");
        let code =
            text.split('`').filter(|code| code.starts_with("cargo test ") || code.starts_with("cargo run "));
        commands.extend(code.map(str::to_owned));
    }
    commands
}

/// The word after a flag.
fn after<'a>(words: &[&'a str], flag: &str) -> Option<&'a str> {
    words.iter().position(|word| *word == flag).and_then(|at| words.get(at + 1)).copied()
}

/// The folder of a package of the workspace.
fn folder(package: Option<&str>) -> PathBuf {
    let folder = match package {
        None | Some("affine") => "",
        Some("affine-runtime") => "affine-runtime",
        Some("affine-core") => "affine-runtime/core",
        Some("affine-integrators") => "affine-runtime/integrators",
        Some("affine-codegen") => "affine-macros/codegen",
        Some("affine-allocations") => "tests/allocations",
        Some("affine-inlined") => "tests/inlined",
        Some("affine-linked") => "tests/linked",
        Some("affine-together") => "tests/together",
        Some("affine-oracle") => "tests/oracle",
        Some("affine-comparison") => "tests/comparison",
        Some(other) => panic!("no package {other}"),
    };
    root().join(folder)
}

/// `name.rs` or `name/main.rs` in a folder.
fn program(folder: &Path, name: &str) -> PathBuf {
    let candidates = [folder.join(format!("{name}.rs")), folder.join(name).join("main.rs")];
    candidates
        .into_iter()
        .find(|path| path.exists())
        .unwrap_or_else(|| panic!("no {name} in {}", folder.display()))
}

/// All sources below a folder, or a file alone.
fn sources(at: &Path) -> String {
    if at.is_file() {
        return fs::read_to_string(at).unwrap();
    }
    let entries = fs::read_dir(at).unwrap().map(|entry| entry.unwrap().path());
    let below =
        entries.filter(|path| path.is_dir() || path.extension().is_some_and(|extension| extension == "rs"));
    below.map(|path| sources(&path)).collect()
}

#[test]
fn commands_name_what_exists() {
    let commands = commands();
    assert!(commands.len() > 20, "{commands:?}");
    for command in commands {
        // What stands behind ` -- ` is for the program.
        let words: Vec<&str> = command.split_whitespace().take_while(|word| *word != "--").collect();
        let folder = folder(after(&words, "-p"));
        let searched = match (after(&words, "--test"), after(&words, "--example")) {
            (Some(test), _) => {
                // Packages of tests alone have them beside their manifest.
                let apart = folder.join("tests");
                let main = program(if apart.is_dir() { &apart } else { &folder }, test);
                if main.ends_with("main.rs") { main.parent().unwrap().to_owned() } else { main }
            }
            (None, Some(example)) => program(&folder.join("examples"), example),
            (None, None) if folder.join("src").is_dir() => folder.join("src"),
            (None, None) => folder.clone(),
        };
        let names = |pair: &&[&str]| ["-p", "--exclude", "--test", "--example"].contains(&pair[0]);
        let flags: Vec<&str> = words.windows(2).filter(names).map(|pair| pair[1]).collect();
        let filter = words[2..].iter().find(|word| !word.starts_with('-') && !flags.contains(*word));
        let Some(filter) = filter.filter(|_| words[1] == "test") else { continue };
        let found = sources(&searched);
        let named = |path: &str| {
            // The last part of a path may be the beginning of a name.
            path.split("::").all(|part| {
                found.lines().map(str::trim_start).any(|line| {
                    let item = line.trim_start_matches("pub ").trim_start_matches("pub(crate) ");
                    ["fn ", "mod "]
                        .iter()
                        .any(|word| item.strip_prefix(word).is_some_and(|name| name.contains(part)))
                })
            })
        };
        assert!(named(filter), "`{command}` runs nothing: no `{filter}` below {}", searched.display());
    }
}
