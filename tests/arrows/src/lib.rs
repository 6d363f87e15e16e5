//! Which source file of a crate uses which: an arrow from a file to each file that defines something it names.
//!
//! Every path that starts at `crate`, `self`, `super` or a child module is followed, in `use` items and in the middle of
//! expressions and macros alike, through re-exports, to the file where its item stands. Tests within a file are left out.

mod paths;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::{fs, io};

use paths::{Import, Source};

/// The files of a crate with their arrows.
#[derive(Debug, Default)]
pub struct Arrows {
    /// From a file to those that it uses, as paths below the crate's `src`.
    pub of: BTreeMap<String, BTreeSet<String>>,
}

/// A module: its names from the crate's root.
type Module = Vec<String>;

impl Arrows {
    /// The arrows of the crate whose sources stand in a folder.
    ///
    /// # Errors
    /// What reading a file says; a file that is not Rust.
    pub fn read(src: &Path) -> io::Result<Self> {
        let mut sources = BTreeMap::new();
        let root = if src.join("lib.rs").exists() { "lib.rs" } else { "main.rs" };
        read(src, root, Vec::new(), &mut sources)?;
        let tree = Tree(sources);
        let mut arrows = Self::default();
        for (module, (file, source)) in &tree.0 {
            let mut found = BTreeSet::new();
            for path in &source.paths {
                found.extend(tree.file_of(module, path));
            }
            found.remove(file);
            arrows.of.insert(file.clone(), found);
        }
        Ok(arrows)
    }

    /// The circles: sets of files each of which leads to every other one.
    #[must_use]
    pub fn circles(&self) -> Vec<BTreeSet<&str>> {
        let reached: BTreeMap<&str, BTreeSet<&str>> =
            self.of.keys().map(|file| (file.as_str(), self.reached(file))).collect();
        let mut circles: Vec<BTreeSet<&str>> = Vec::new();
        for (file, all) in &reached {
            if circles.iter().any(|circle| circle.contains(file)) {
                continue;
            }
            let circle: BTreeSet<&str> =
                all.iter().copied().filter(|other| reached[other].contains(file)).collect();
            if circle.len() > 1 {
                circles.push(circle);
            }
        }
        circles
    }

    /// The files to which arrows lead from one, by way of others too.
    fn reached(&self, file: &str) -> BTreeSet<&str> {
        let mut all = BTreeSet::new();
        let mut pending: Vec<&str> = self.of.get(file).into_iter().flatten().map(String::as_str).collect();
        while let Some(next) = pending.pop() {
            if all.insert(next) {
                pending.extend(self.of.get(next).into_iter().flatten().map(String::as_str));
            }
        }
        all
    }
}

/// Reads a file and the modules that it declares.
fn read(
    src: &Path,
    file: &str,
    module: Module,
    sources: &mut BTreeMap<Module, (String, Source)>,
) -> io::Result<()> {
    let text = fs::read_to_string(src.join(file))?;
    let source = Source::of(&text).map_err(|error| io::Error::other(format!("{file}: {error}")))?;
    let folder = match module.is_empty() {
        true => String::new(),
        false => format!("{}/", file.trim_end_matches("/mod.rs").trim_end_matches(".rs")),
    };
    let children = source.children.clone();
    sources.insert(module.clone(), (file.to_owned(), source));
    for child in children {
        let places = [format!("{folder}{child}.rs"), format!("{folder}{child}/mod.rs")];
        let place = places.iter().find(|place| src.join(place).exists());
        let place = place.ok_or_else(|| io::Error::other(format!("{file}: no file for `mod {child}`")))?;
        read(src, place, [module.clone(), vec![child]].concat(), sources)?;
    }
    Ok(())
}

/// All modules by their names.
struct Tree(BTreeMap<Module, (String, Source)>);

/// Re-exports that lead in a circle end here.
const MOST_STEPS: usize = 16;

impl Tree {
    /// The file where the item of a path stands that is named in a module; `None` of what is not of this crate.
    fn file_of(&self, module: &Module, path: &[String]) -> Option<String> {
        self.followed(module, path, 0)
    }

    fn followed(&self, module: &Module, path: &[String], steps: usize) -> Option<String> {
        let (mut at, mut rest) = (module.clone(), path);
        match rest.first()?.as_str() {
            "crate" => at.clear(),
            "self" => {}
            "super" => {
                at.pop()?;
            }
            child if self.0.contains_key(&[at.clone(), vec![child.to_owned()]].concat()) => {
                at.push(child.to_owned());
            }
            _ => return None,
        }
        rest = &rest[1..];
        while let Some(name) = rest.first() {
            let next = match name.as_str() {
                "super" => at[..at.len().checked_sub(1)?].to_vec(),
                "self" => at.clone(),
                name => [at.clone(), vec![name.to_owned()]].concat(),
            };
            if !self.0.contains_key(&next) {
                break;
            }
            (at, rest) = (next, &rest[1..]);
        }
        let (file, source) = self.0.get(&at)?;
        let imported =
            rest.first().and_then(|name| source.imports.iter().find(|import| import.name == *name));
        match imported {
            Some(Import { path, .. }) if steps < MOST_STEPS => {
                let whole = [path.as_slice(), &rest[1..]].concat();
                self.followed(&at, &whole, steps + 1).or_else(|| Some(file.clone()))
            }
            _ => Some(file.clone()),
        }
    }
}
