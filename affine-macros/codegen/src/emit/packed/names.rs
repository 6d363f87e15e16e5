//! Names of vectors: `green_1` holds `green_11`, `green_12`, `green_13`.

use std::collections::HashSet;

use crate::ir::packed::{Four, Lane, Packed};
use crate::ir::{Op, Value};

/// A name for each vector that has one; of the vectors of the state, which has these components, each has.
pub(super) fn of_vectors(packed: &Packed, components: &[String]) -> Vec<Option<String>> {
    let program = &packed.program;
    let mut taken: HashSet<String> = program.names.iter().map(|(_, name)| name.clone()).collect();
    taken.extend(program.steps.iter().filter_map(|op| match op {
        Op::Input(symbol) => Some(symbol.to_string()).filter(|name| !components.contains(name)),
        _ => None,
    }));
    let mut names = Vec::new();
    for (index, vector) in packed.vectors.iter().enumerate() {
        let is_named = !matches!(vector.made, Four::All(_) | Four::Gathered(_) | Four::Neg(_));
        let name = common(&of_lanes(packed, components, index)).filter(|_| is_named);
        let name = match name.filter(|name| !taken.contains(name)) {
            None if matches!(vector.made, Four::State(_)) => Some(format!("state_{}", index + 1)),
            name => name,
        };
        taken.extend(name.clone());
        names.push(name);
    }
    names
}

/// Names of the values in the lanes of a vector; none where one has no name. Those of the state stand also where the
/// equations do not read them.
fn of_lanes<'n>(packed: &'n Packed, components: &'n [String], index: usize) -> Vec<&'n str> {
    let vector = &packed.vectors[index];
    if let Four::State(place) = vector.made {
        return packed.state[place].iter().flatten().map(|k| components[*k].as_str()).collect();
    }
    let lanes = vector.lanes.iter().filter(|lane| **lane != Lane::Free);
    let names = lanes.map(|lane| match lane {
        Lane::Of(value) => name(packed, *value),
        _ => None,
    });
    names.collect::<Option<_>>().unwrap_or_default()
}

/// What the derivation calls a value.
pub(super) fn name(packed: &Packed, value: Value) -> Option<&str> {
    let known = packed.program.names.iter().find(|(v, _)| *v == value).map(|(_, name)| name);
    let result = packed.program.outputs.iter().find(|(_, v)| *v == value).map(|(name, _)| name);
    known.or(result).map(String::as_str)
}

/// What is common to the names of components: the stem, and the index of the line that they stand in.
fn common(names: &[&str]) -> Option<String> {
    let [first, rest @ ..] = names else { return None };
    if rest.is_empty() {
        return Some((*first).to_owned());
    }
    let (stem, digits) = first.rsplit_once('_')?;
    let others: Vec<&str> =
        rest.iter().map(|name| name.strip_prefix(stem)?.strip_prefix('_')).collect::<Option<_>>()?;
    let line = digits.chars().find(|digit| others.iter().all(|other| other.contains(*digit)));
    match line {
        Some(line) if digits.len() == 2 => Some(format!("{stem}_{line}")),
        None if digits.len() == 1 => Some(stem.to_owned()),
        _ => None,
    }
}
