//! Names of vectors: `green_1` holds `green_11`, `green_12`, `green_13`.

use std::collections::HashSet;

use proc_macro2::Ident;
use quote::format_ident;

use crate::emit::pattern::ident;
use crate::ir::packed::{Four, Lane, Packed};
use crate::symbol::Symbol;

/// A name for each vector that has one; of the vectors of the state, which has these components, each has.
pub(super) fn of_vectors(packed: &Packed, components: &[Symbol]) -> Vec<Option<Ident>> {
    let program = &packed.program;
    let named = program.names.iter().map(|(_, name)| name);
    let inputs = program.symbols().filter(|s| !s.is_parameter() && !components.contains(s));
    let mut taken: HashSet<Ident> = named.chain(inputs).map(ident).collect();
    let mut names = Vec::new();
    for (index, vector) in packed.vectors.iter().enumerate() {
        let is_named = !matches!(vector.made, Four::All(_) | Four::Gathered(_) | Four::Neg(_));
        let name = common(&of_lanes(packed, components, index)).filter(|_| is_named);
        let name = match name.map(|name| ident(&name)).filter(|name| !taken.contains(name)) {
            None if matches!(vector.made, Four::State(_)) => Some(format_ident!("state_{}", index + 1)),
            name => name,
        };
        taken.extend(name.clone());
        names.push(name);
    }
    names
}

/// The symbols of the values in the lanes of a vector; none where one has none. Those of the state stand also where the
/// equations do not read them.
fn of_lanes<'n>(packed: &'n Packed, components: &'n [Symbol], index: usize) -> Vec<&'n Symbol> {
    let vector = &packed.vectors[index];
    if let Four::State(place) = vector.made {
        return packed.state[place].iter().flatten().map(|k| &components[*k]).collect();
    }
    let lanes = vector.lanes.iter().filter(|lane| **lane != Lane::Free);
    let names = lanes.map(|lane| match lane {
        Lane::Of(value) => packed.program.own_name(*value),
        _ => None,
    });
    names.collect::<Option<_>>().unwrap_or_default()
}

/// What is common to components of one quantity: the quantity, and the index of the line that they stand in.
fn common(symbols: &[&Symbol]) -> Option<Symbol> {
    let [first, rest @ ..] = symbols else { return None };
    if rest.is_empty() {
        return Some((*first).clone());
    }
    let whole = first.with_indices(&[]);
    if rest.iter().any(|other| other.with_indices(&[]) != whole) {
        return None;
    }
    let line = first.indices().iter().find(|k| rest.iter().all(|other| other.indices().contains(k)));
    match (line, first.indices()) {
        (Some(line), [_, _]) => Some(whole.with_indices(&[*line])),
        (None, [_]) => Some(whole),
        _ => None,
    }
}
