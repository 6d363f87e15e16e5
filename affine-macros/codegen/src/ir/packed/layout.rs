//! Which components of the state stand side by side.

use crate::symbol::Symbol;

/// Vectors of one group, by the indices of components.
type Vectors = Vec<[Option<usize>; 4]>;

/// The vectors of a state, group by group.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    names: Vec<Symbol>,
    groups: Vec<Vectors>,
    /// Other ways for a group.
    others: Vec<(usize, Vectors)>,
}

impl Layout {
    /// Matrices by rows, all else in its order.
    pub(super) fn in_rows(groups: &[Vec<Symbol>]) -> Self {
        let (mut names, mut chosen, mut others) = (Vec::new(), Vec::new(), Vec::new());
        for (place, components) in groups.iter().enumerate() {
            let first = names.len();
            names.extend(components.iter().cloned());
            let mut ways = Vec::from_iter(lines(components, first, |line, other| (line, other)));
            ways.extend(lines(components, first, |line, other| (other, line)));
            ways.push(in_order(first, components.len()));
            let mut ways = ways.into_iter();
            chosen.extend(ways.next());
            others.extend(ways.map(|way| (place, way)));
        }
        Self { names, groups: chosen, others }
    }

    /// The components of the state.
    pub(super) fn names(&self) -> &[Symbol] {
        &self.names
    }

    /// All vectors.
    pub(super) fn vectors(&self) -> Vectors {
        self.groups.concat()
    }

    /// Other ways for one group each.
    pub(super) fn alternatives(&self) -> Vec<(usize, Vectors)> {
        self.others.clone()
    }

    /// With another way for a group.
    pub(super) fn with(&self, (group, way): &(usize, Vectors)) -> Self {
        let mut layout = self.clone();
        layout.groups[*group].clone_from(way);
        layout
    }
}

/// Four at a time.
fn in_order(first: usize, count: usize) -> Vectors {
    let component = |k: usize| (k < count).then_some(first + k);
    (0..count).step_by(4).map(|k| [k, k + 1, k + 2, k + 3].map(component)).collect()
}

/// The lines of a matrix of dimension 3, `entry` being the indices of an entry. A component that a line of a symmetric
/// matrix shares with an earlier one stands in both, and moves in both alike.
fn lines(
    components: &[Symbol],
    first: usize,
    entry: impl Fn(usize, usize) -> (usize, usize),
) -> Option<Vectors> {
    let places: Vec<(usize, usize)> = components.iter().map(indices).collect::<Option<_>>()?;
    if places.len() < 4 || !places.iter().any(|(i, j)| *i == 3 || *j == 3) {
        return None;
    }
    let find = |(i, j): (usize, usize)| {
        let at = |wanted: (usize, usize)| places.iter().position(|place| *place == wanted);
        at((i, j)).or_else(|| at((j, i))).map(|k| first + k)
    };
    let mut vectors: Vectors = Vec::new();
    for line in 1..=3 {
        let vector = [find(entry(line, 1)), find(entry(line, 2)), find(entry(line, 3)), None];
        let known = |k: &usize| vectors.iter().flatten().flatten().any(|other| other == k);
        if !vector.iter().flatten().all(known) {
            vectors.push(vector);
        }
    }
    Some(vectors)
}

/// `(1, 2)` of `phi_12`.
fn indices(symbol: &Symbol) -> Option<(usize, usize)> {
    match symbol {
        Symbol::Component(_, indices) => match **indices {
            [i @ 1..=3, j @ 1..=3] => Some((i, j)),
            _ => None,
        },
        _ => None,
    }
}
