//! Rooted trees, one for each order condition.

use std::collections::BTreeSet;

/// A rooted tree by the sorted list of its branches.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Tree(pub(super) Vec<Tree>);

impl Tree {
    /// `|t|`.
    pub(super) fn size(&self) -> usize {
        1 + self.0.iter().map(Tree::size).sum::<usize>()
    }

    /// `gamma(t)`.
    pub(super) fn density(&self) -> usize {
        self.size() * self.0.iter().map(Tree::density).product::<usize>()
    }

    /// The tree with one more branch at the root.
    pub(super) fn with_branch(&self, branch: &Tree) -> Tree {
        let mut branches = self.0.clone();
        branches.push(branch.clone());
        branches.sort();
        Tree(branches)
    }

    /// All trees of at most `nodes` nodes, by number of nodes less one.
    pub(super) fn up_to(nodes: usize) -> Vec<Vec<Self>> {
        let mut found = vec![vec![Self(Vec::new())]];
        for size in 2..=nodes {
            let mut larger = BTreeSet::new();
            for rest in 1..size {
                for stem in &found[rest - 1] {
                    larger.extend(found[size - rest - 1].iter().map(|branch| stem.with_branch(branch)));
                }
            }
            found.push(larger.into_iter().collect());
        }
        found
    }
}
