//! The items of crates, read from their sources, and where their paths lead.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::{Attribute, Ident, Item, UseTree, Visibility};

/// A crate with a module in it: its names from the root, that of the crate first.
pub(crate) type Place = Vec<String>;

/// What a module says.
#[derive(Default)]
pub(crate) struct Module {
    /// Types, functions, traits, constants and macros, and whether they are public.
    pub(crate) items: BTreeMap<String, bool>,
    /// Modules, and whether they are public.
    pub(crate) children: BTreeMap<String, bool>,
    pub(crate) imports: Vec<Import>,
}

/// One name of a `use`, or `*`.
pub(crate) struct Import {
    pub(crate) name: String,
    path: Vec<String>,
    pub(crate) is_public: bool,
}

/// The modules of some crates.
pub(crate) struct Sources(pub(crate) BTreeMap<Place, Module>);

/// Where a path leads: to a module, to an item of one, to both.
#[derive(Default)]
pub(crate) struct Target {
    pub(crate) module: Option<Place>,
    /// The item's place and name, or what it is called elsewhere.
    pub(crate) item: Option<(Place, String)>,
}

/// Re-exports that lead in a circle end here.
const MOST_STEPS: usize = 16;

impl Sources {
    /// The crates whose `src` folders are given by name.
    pub(crate) fn read(crates: &[(&str, PathBuf)]) -> Self {
        let mut sources = Self(BTreeMap::new());
        for (name, src) in crates {
            let file = syn::parse_file(&fs::read_to_string(src.join("lib.rs")).unwrap()).unwrap();
            sources.module(vec![(*name).to_owned()], file.items, src);
        }
        sources
    }

    /// Reads the items of a module whose children stand in a folder.
    fn module(&mut self, place: Place, items: Vec<Item>, folder: &Path) {
        let mut module = Module::default();
        for item in items {
            let Some((attributes, visibility, name)) = declared(&item) else {
                if let Item::Use(item) = item
                    && is_there(&item.attrs)
                {
                    imports(&item.tree, &[], is_public(&item.vis), &mut module.imports);
                }
                continue;
            };
            if !is_there(attributes) {
                continue;
            }
            let (name, is_public) = (name.to_string(), is_public(visibility));
            let Item::Mod(item) = item else {
                module.items.insert(name, is_public);
                continue;
            };
            module.children.insert(name.clone(), is_public);
            let below = folder.join(&name);
            let items = item.content.map_or_else(
                || {
                    let file = [below.with_extension("rs"), below.join("mod.rs")];
                    let file = file.into_iter().find(|file| file.exists()).unwrap();
                    syn::parse_file(&fs::read_to_string(file).unwrap()).unwrap().items
                },
                |(_, items)| items,
            );
            self.module([place.clone(), vec![name]].concat(), items, &below);
        }
        self.0.insert(place, module);
    }

    /// Where a path of a module leads; nowhere where it leaves the crates.
    pub(crate) fn followed(&self, from: &Place, import: &Import) -> Target {
        self.steps(from, &import.path, MOST_STEPS)
    }

    fn steps(&self, from: &Place, path: &[String], left: usize) -> Target {
        let outside = || Target { module: None, item: Some((path.to_vec(), String::new())) };
        let Some((first, rest)) = path.split_first().filter(|_| left > 0) else { return Target::default() };
        let root = vec![first.clone()];
        let (at, rest) = match first.as_str() {
            "crate" => (vec![from[0].clone()], rest),
            "self" => (from.clone(), rest),
            "super" => (from[..from.len() - 1].to_vec(), rest),
            _ if self.0.contains_key(&root) => (root, rest),
            _ => (from.clone(), path),
        };
        self.below(&at, rest, left).unwrap_or_else(outside)
    }

    /// What a path within a module leads to.
    fn below(&self, at: &Place, path: &[String], left: usize) -> Option<Target> {
        let module = self.0.get(at)?;
        let Some((name, rest)) = path.split_first() else {
            return Some(Target { module: Some(at.clone()), item: None });
        };
        if name == "super" {
            return self.below(&at[..at.len() - 1].to_vec(), rest, left);
        }
        let child = [at.clone(), vec![name.clone()]].concat();
        let item = module.items.contains_key(name).then(|| (at.clone(), name.clone()));
        if !rest.is_empty() && module.children.contains_key(name) {
            return self.below(&child, rest, left);
        }
        let module_too = module.children.contains_key(name).then_some(child);
        if item.is_some() || module_too.is_some() {
            return Some(Target { module: module_too, item });
        }
        let mut imported = module.imports.iter().filter(|import| import.name == *name);
        let globs = module.imports.iter().filter(|import| import.name == "*");
        if let Some(import) = imported.next() {
            return Some(self.steps(at, &[&import.path, rest].concat(), left - 1));
        }
        globs.filter(|_| left > 1).find_map(|import| {
            let inner = self.steps(at, &import.path, left - 1).module?;
            self.below(&inner, path, left - 1)
        })
    }

    /// All items that a user reaches from a crate, by where they are defined.
    pub(crate) fn reachable(&self, name: &str) -> BTreeSet<(Place, String)> {
        let (mut found, mut seen) = (BTreeSet::new(), BTreeSet::new());
        self.collect(&vec![name.to_owned()], &mut found, &mut seen);
        found
    }

    fn collect(&self, place: &Place, found: &mut BTreeSet<(Place, String)>, seen: &mut BTreeSet<Place>) {
        if place.last().is_some_and(|name| name == "__private") || !seen.insert(place.clone()) {
            return;
        }
        let module = &self.0[place];
        let public = |(name, is_public): (&String, &bool)| is_public.then(|| name.clone());
        found.extend(module.items.iter().filter_map(public).map(|name| (place.clone(), name)));
        for child in module.children.iter().filter_map(public) {
            self.collect(&[place.clone(), vec![child]].concat(), found, seen);
        }
        for import in module.imports.iter().filter(|import| import.is_public) {
            let Target { module, item } = self.followed(place, import);
            if let Some(item) = item {
                // What a macro defines, or another crate, goes by the name that it has here.
                let is_known = !item.1.is_empty();
                found.insert(if is_known { item } else { (item.0, import.name.clone()) });
            }
            if let Some(module) = module {
                self.collect(&module, found, seen);
            }
        }
    }
}

/// Attributes, visibility and name of what is no `use` and no `impl`.
fn declared(item: &Item) -> Option<(&Vec<Attribute>, &Visibility, &Ident)> {
    Some(match item {
        Item::Const(item) => (&item.attrs, &item.vis, &item.ident),
        Item::Enum(item) => (&item.attrs, &item.vis, &item.ident),
        Item::Fn(item) => (&item.attrs, &item.vis, &item.sig.ident),
        Item::Mod(item) => (&item.attrs, &item.vis, &item.ident),
        Item::Static(item) => (&item.attrs, &item.vis, &item.ident),
        Item::Struct(item) => (&item.attrs, &item.vis, &item.ident),
        Item::Trait(item) => (&item.attrs, &item.vis, &item.ident),
        Item::Type(item) => (&item.attrs, &item.vis, &item.ident),
        _ => return None,
    })
}

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

/// Is it there with all features, outside of tests and documentation?
fn is_there(attributes: &[Attribute]) -> bool {
    attributes.iter().filter(|attribute| attribute.path().is_ident("cfg")).all(|attribute| {
        let condition = attribute.meta.require_list().unwrap().tokens.to_string();
        !["test", "doc", "doctest", "not"]
            .iter()
            .any(|word| condition.split(|c: char| !c.is_alphanumeric()).any(|part| part == *word))
    })
}

fn imports(tree: &UseTree, before: &[String], is_public: bool, all: &mut Vec<Import>) {
    let with = |name: &Ident| [before, &[name.to_string()]].concat();
    let (name, path) = match tree {
        UseTree::Path(tree) => return imports(&tree.tree, &with(&tree.ident), is_public, all),
        UseTree::Group(group) => {
            return group.items.iter().for_each(|tree| imports(tree, before, is_public, all));
        }
        UseTree::Name(tree) if tree.ident == "self" => {
            (before.last().cloned().unwrap_or_default(), before.to_vec())
        }
        UseTree::Name(tree) => (tree.ident.to_string(), with(&tree.ident)),
        UseTree::Rename(tree) => (tree.rename.to_string(), with(&tree.ident)),
        UseTree::Glob(_) => ("*".to_owned(), before.to_vec()),
    };
    all.push(Import { name, path, is_public });
}
