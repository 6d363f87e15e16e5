//! Symmetries by their names.

use super::model::Model;
use crate::mechanics::symmetry::Group;

impl Model {
    /// The groups that leave the kinetic energy unchanged, in space and in the body.
    pub fn invariance(&self) -> [String; 2] {
        let n = self.dim;
        [self.description.groups.0, self.description.groups.1].map(|group| match group {
            Group::Affine => format!("GL({n})"),
            Group::Metric => format!("O({n})"),
            Group::Less => format!("a proper subgroup of O({n})"),
        })
    }

    /// The group that the motion is confined to, and what of these acts on it in space and in the body.
    pub fn confinement(&self) -> Option<(String, [String; 2])> {
        let (n, constraint) = (self.dim, self.constraint?);
        let surviving = [self.description.groups.0, self.description.groups.1].map(|group| match group {
            Group::Affine => constraint.group_name(n),
            Group::Metric => format!("SO({n})"),
            Group::Less => format!("a proper subgroup of SO({n})"),
        });
        Some((constraint.group_name(n), surviving))
    }
}
