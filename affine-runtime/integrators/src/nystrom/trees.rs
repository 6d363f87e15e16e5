//! Trees of Nystrom methods, one for each order condition.
//!
//! `q'' = f(q)` has a tree for each product of derivatives of `f` along `q'` and along values of `f`: a root with `k` bare
//! leaves and branches `t_1 ... t_m` that are trees again, of order
//!
//! ```text
//! rho(t)   = 1 + k + sum_j (rho(t_j) + 1)
//! Phi_i(t) = c_i^k prod_j sum_l a_il Phi_l(t_j),        gamma(t) = rho(t) prod_j (rho(t_j) + 1) gamma(t_j)
//! sum_i b'_i Phi_i(t) = 1/gamma(t)                      for rho(t) <= p
//! sum_i b_i Phi_i(t)  = 1/((rho(t) + 1) gamma(t))       for rho(t) <= p - 1
//! ```
//!
//! (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, section II.14, Theorem 14.13.)

use std::collections::BTreeMap;

/// A tree: bare leaves, and the sorted list of its branches.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Tree {
    leaves: usize,
    branches: Vec<Tree>,
}

impl Tree {
    /// `rho(t)`.
    pub(super) fn order(&self) -> usize {
        1 + self.leaves + self.branches.iter().map(|branch| branch.order() + 1).sum::<usize>()
    }

    /// `gamma(t)`.
    pub(super) fn density(&self) -> usize {
        self.order() * self.branches.iter().map(|t| (t.order() + 1) * t.density()).product::<usize>()
    }
}

/// A tree with its weights `Phi_i(t)`, and with `sum_l a_il Phi_l(t)` for trees that have it as a branch.
pub(super) struct Condition<W> {
    pub(super) tree: Tree,
    pub(super) weights: W,
    as_branch: W,
}

/// A number for each stage, in some exact arithmetic.
pub(super) trait Method<W> {
    /// 1 for each stage.
    fn ones(&self) -> W;
    /// The nodes.
    fn nodes(&self) -> W;
    /// Products stage by stage.
    fn product(&self, a: &W, b: &W) -> W;
    /// `sum_l a_il w_l`.
    fn through(&self, weights: &W) -> W;
}

/// All trees up to an order, by order less one.
pub(super) fn conditions<W>(method: &impl Method<W>, last: usize) -> Vec<Vec<Condition<W>>> {
    let condition = |(tree, weights): (Tree, W)| {
        let as_branch = method.through(&weights);
        Condition { tree, weights, as_branch }
    };
    let nodes = method.nodes();
    let bare = Tree { leaves: 0, branches: Vec::new() };
    let mut found = vec![vec![condition((bare, method.ones()))]];
    for order in 2..=last {
        // A leaf or a branch more at the root of a smaller tree gives every tree, some several times.
        let mut larger: BTreeMap<Tree, W> = BTreeMap::new();
        for stem in &found[order - 2] {
            let tree = Tree { leaves: stem.tree.leaves + 1, ..stem.tree.clone() };
            larger.insert(tree, method.product(&stem.weights, &nodes));
        }
        for rest in 1..order.saturating_sub(1) {
            for stem in &found[rest - 1] {
                for branch in &found[order - rest - 2] {
                    let mut tree = stem.tree.clone();
                    tree.branches.push(branch.tree.clone());
                    tree.branches.sort();
                    larger.entry(tree).or_insert_with(|| method.product(&stem.weights, &branch.as_branch));
                }
            }
        }
        found.push(larger.into_iter().map(condition).collect());
    }
    found
}
