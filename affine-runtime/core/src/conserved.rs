//! Values of conserved quantities at a phase point.

use crate::frames::{Matrix, Vector};
use crate::kinematics::Kinematics;
use crate::metrics::{Bases, Tensor};
use crate::model::{Component, Conserved, Entry};
use crate::norm::norm;
use crate::state::Phase;

/// Independent components of a quantity: at most nine, in the dimensions 2 and 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Components {
    values: [f64; 9],
    len: usize,
}

impl Components {
    /// The components: a vector's, a matrix's row by row, the entries above the diagonal of a skew matrix row by
    /// row, or one number.
    #[must_use]
    pub fn as_slice(&self) -> &[f64] {
        &self.values[..self.len]
    }

    /// Euclidean norm: Frobenius for a matrix, `sqrt(-tr(S^2)/2)` for a skew matrix.
    #[must_use]
    pub fn norm(&self) -> f64 {
        norm(self.as_slice())
    }

    /// Euclidean norm of the difference to the same quantity elsewhere.
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        let differences = self.as_slice().iter().zip(other.as_slice()).map(|(a, b)| a - b);
        Self::collect(differences).norm()
    }

    fn collect(components: impl Iterator<Item = f64>) -> Self {
        let mut collected = Self { values: [0.0; 9], len: 0 };
        for (place, component) in collected.values.iter_mut().zip(components) {
            *place = component;
            collected.len += 1;
        }
        collected
    }

    fn number(value: f64) -> Self {
        Self::collect(core::iter::once(value))
    }

    fn vector<const N: usize>(v: &Vector<N>) -> Self {
        Self::collect(v.iter().copied())
    }

    fn matrix<const N: usize>(m: &Matrix<N>) -> Self {
        Self::collect((0..N * N).map(|k| m[(k / N, k % N)]))
    }

    fn skew<const N: usize>(tensor: impl Tensor<N>, bases: Option<&Bases<N>>) -> Self {
        let m = tensor.components(bases);
        let above = (0..N * N).map(|k| (k / N, k % N)).filter(|(a, b)| a < b);
        Self::collect(above.map(|(a, b)| m[(a, b)]))
    }
}

/// The sum of the multiples of what stands for the entries.
fn sum(component: Component, value: impl Fn(&Entry) -> Option<f64>) -> Option<f64> {
    component.entries.iter().map(|entry| Some(entry.factor as f64 * value(entry)?)).sum()
}

/// Where an entry stands among the [components](Components::as_slice) of its momentum.
fn place<const N: usize>(entry: &Entry) -> Option<usize> {
    let row = entry.row.checked_sub(1).filter(|row| *row < N)?;
    let column = entry.column.checked_sub(1).filter(|column| *column < N)?;
    match entry.of {
        Conserved::LinearMomentum | Conserved::ComovingLinearMomentum => (column == 0).then_some(row),
        Conserved::OrbitalAngularMomentum
        | Conserved::TotalAngularMomentum
        | Conserved::Spin
        | Conserved::Vorticity => (row < column).then(|| row * (N - 1) + column - 1 - row * (row + 1) / 2),
        _ => Some(row * N + column),
    }
}

impl Conserved {
    /// The quantity at a phase point (Slawianowski et al., sections 2 and 5); `None` for the energy, which
    /// belongs to the model and not to the point, and for entries that a momentum does not have.
    ///
    /// `bases` are those of the model, [`Model::bases`](crate::model::Model::bases), and `None` of a point that stands in
    /// orthonormal ones. The entries are those in the bases of the point, of angular momenta and vorticity
    /// [`components`](crate::model::Model::components).
    #[must_use]
    pub fn of<const N: usize, P: Phase<N>>(self, point: &P, bases: Option<&Bases<N>>) -> Option<Components> {
        let there = point.in_orthonormal(bases);
        Some(match self {
            Self::Energy => return None,
            Self::LinearMomentum => Components::vector(&point.p()),
            Self::ComovingLinearMomentum => Components::vector(&point.p_hat().0.0),
            Self::OrbitalAngularMomentum => Components::skew(there.orbital_angular_momentum(), bases),
            Self::TotalAffineMomentum => Components::matrix(&point.total_affine_momentum().0.0),
            Self::TotalAngularMomentum => Components::skew(there.total_angular_momentum(), bases),
            Self::AffineSpin => Components::matrix(&point.sigma().0.0),
            Self::Deviator => Components::matrix(&point.sigma().deviator().0.0),
            Self::Spin => Components::skew(there.spin(), bases),
            Self::SpinNorm => Components::number(there.spin().norm_squared()),
            Self::ComovingAffineSpin => Components::matrix(&point.sigma_hat().0.0),
            Self::ComovingDeviator => Components::matrix(&point.sigma_hat().deviator().0.0),
            Self::Vorticity => Components::skew(there.vorticity(), bases),
            Self::VorticityNorm => Components::number(there.vorticity().norm_squared()),
            Self::CanonicalMomentum => Components::matrix(&point.pi().0.0),
            Self::Casimir1 => Components::number(point.casimir(1)),
            Self::Casimir2 => Components::number(point.casimir(2)),
            Self::Casimir3 => Components::number(point.casimir(3)),
            Self::DeviatorCasimir2 => Components::number(point.shear_casimir(2)),
            Self::DeviatorCasimir3 => Components::number(point.shear_casimir(3)),
            Self::Component(component) => Components::number(sum(component, |entry| {
                Some(*entry.of.of(point, bases)?.as_slice().get(place::<N>(entry)?)?)
            })?),
        })
    }

    /// The size of what the quantity is made of at a phase point, against which its drift is read: `|Sigma|^2` for
    /// `tr Sigma^2`, `|x| |p| + |Sigma|` for the total affine momentum, so that a quantity that vanishes has a scale
    /// too. `None` for the energy. Point and bases are those of [`of`](Self::of).
    #[must_use]
    pub fn scale<const N: usize, P: Phase<N>>(self, point: &P, bases: Option<&Bases<N>>) -> Option<f64> {
        let there = point.in_orthonormal(bases);
        let sigma = || norm(point.sigma().0.0.as_slice());
        // `F^T m F`, as the components of angular momenta, `F = A`, and of vorticity, `F = B^-T`, are made.
        let both = |m, factor| norm(Option::map_or(factor, m, |f: Matrix<N>| f.tr_mul(&m) * f).as_slice());
        let lowered = |m| both(m, bases.map(|bases| bases.space));
        let sigma_hat = || norm(point.sigma_hat().0.0.as_slice());
        let p = || norm(point.p().as_slice());
        let orbital = || lowered(there.x() * there.p().transpose());
        Some(match self {
            Self::Energy => return None,
            Self::LinearMomentum => p(),
            Self::ComovingLinearMomentum => norm(point.phi().as_slice()) * p(),
            Self::OrbitalAngularMomentum => orbital(),
            Self::TotalAffineMomentum => norm(point.x().as_slice()) * p() + sigma(),
            Self::TotalAngularMomentum => orbital() + lowered(there.sigma().0.0),
            Self::Spin => lowered(there.sigma().0.0),
            Self::AffineSpin | Self::Deviator | Self::Casimir1 => sigma(),
            Self::SpinNorm | Self::Casimir2 | Self::DeviatorCasimir2 => sigma() * sigma(),
            Self::Casimir3 | Self::DeviatorCasimir3 => sigma() * sigma() * sigma(),
            Self::ComovingAffineSpin | Self::ComovingDeviator => sigma_hat(),
            Self::Vorticity => both(there.sigma_hat().0.0, bases.map(|b| b.body_inverse.transpose())),
            Self::VorticityNorm => sigma_hat() * sigma_hat(),
            Self::CanonicalMomentum => norm(point.pi().0.0.as_slice()),
            Self::Component(Component { entries, .. }) => {
                return entries.iter().map(|e| Some(e.factor.abs() as f64 * e.of.scale(point, bases)?)).sum();
            }
        })
    }

    /// The formula.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Energy => "H",
            Self::LinearMomentum => "p",
            Self::ComovingLinearMomentum => "p_hat = phi^T p",
            Self::OrbitalAngularMomentum => "x p^T - p x^T",
            Self::TotalAffineMomentum => "I = x p^T + Sigma",
            Self::TotalAngularMomentum => "I - I^T",
            Self::AffineSpin => "Sigma",
            Self::Deviator => "sigma = Sigma - (tr Sigma/n) 1",
            Self::Spin => "S = Sigma - Sigma^T",
            Self::SpinNorm => "|S|^2",
            Self::ComovingAffineSpin => "Sigma_hat",
            Self::ComovingDeviator => "Sigma_hat - (tr Sigma_hat/n) 1",
            Self::Vorticity => "Vort = Sigma_hat - Sigma_hat^T",
            Self::VorticityNorm => "|Vort|^2",
            Self::CanonicalMomentum => "Pi",
            Self::Casimir1 => "C(1) = tr Sigma",
            Self::Casimir2 => "C(2) = tr Sigma^2",
            Self::Casimir3 => "C(3) = tr Sigma^3",
            Self::DeviatorCasimir2 => "tr sigma^2",
            Self::DeviatorCasimir3 => "tr sigma^3",
            Self::Component(component) => component.symbol,
        }
    }

    /// The name; of a [`Component`] the formula.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Energy => "energy",
            Self::LinearMomentum => "linear momentum",
            Self::ComovingLinearMomentum => "co-moving linear momentum",
            Self::OrbitalAngularMomentum => "orbital angular momentum",
            Self::TotalAffineMomentum => "total affine momentum",
            Self::TotalAngularMomentum => "total angular momentum",
            Self::AffineSpin => "affine spin",
            Self::Deviator => "deviator of the affine spin",
            Self::Spin => "spin",
            Self::SpinNorm => "squared spin",
            Self::ComovingAffineSpin => "co-moving affine spin",
            Self::ComovingDeviator => "co-moving deviator",
            Self::Vorticity => "vorticity",
            Self::VorticityNorm => "squared vorticity",
            Self::CanonicalMomentum => "canonical momentum",
            Self::Casimir1 => "first Casimir",
            Self::Casimir2 => "second Casimir",
            Self::Casimir3 => "third Casimir",
            Self::DeviatorCasimir2 => "second deviator Casimir",
            Self::DeviatorCasimir3 => "third deviator Casimir",
            Self::Component(component) => component.symbol,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::frames::{Body, Canonical, Frame, Space};
    use crate::state::{Centre, PhasePoint, Pinned};

    /// `phi = [[2, 1], [0, 1]]`, `Pi = [[1, 2], [3, 4]]`, so `Sigma = phi Pi = [[5, 8], [3, 4]]` and
    /// `Sigma_hat = Pi phi = [[2, 3], [6, 7]]`; `x = (1, 2)`, `p = (3, -1)`.
    fn point() -> PhasePoint<2, Canonical, Centre<2>> {
        let centre = Centre { x: Vector::<2>::new(1.0, 2.0), p: Vector::<2>::new(3.0, -1.0) };
        PhasePoint::new(Matrix::<2>::new(2.0, 1.0, 0.0, 1.0), Matrix::<2>::new(1.0, 2.0, 3.0, 4.0), centre)
    }

    #[test]
    fn planar_values_by_hand() {
        let expected: [(Conserved, &[f64], f64); 17] = [
            (Conserved::LinearMomentum, &[3.0, -1.0], 10.0),
            (Conserved::ComovingLinearMomentum, &[6.0, 2.0], 60.0),
            (Conserved::OrbitalAngularMomentum, &[-7.0], 50.0),
            (Conserved::TotalAffineMomentum, &[8.0, 7.0, 9.0, 2.0], f64::NAN),
            (Conserved::TotalAngularMomentum, &[-2.0], f64::NAN),
            (Conserved::AffineSpin, &[5.0, 8.0, 3.0, 4.0], 114.0),
            (Conserved::Deviator, &[0.5, 8.0, 3.0, -0.5], 114.0),
            (Conserved::Spin, &[5.0], 114.0),
            (Conserved::SpinNorm, &[25.0], 12996.0),
            (Conserved::ComovingAffineSpin, &[2.0, 3.0, 6.0, 7.0], 98.0),
            (Conserved::ComovingDeviator, &[-2.5, 3.0, 6.0, 2.5], 98.0),
            (Conserved::Vorticity, &[-3.0], 98.0),
            (Conserved::VorticityNorm, &[9.0], 9604.0),
            (Conserved::CanonicalMomentum, &[1.0, 2.0, 3.0, 4.0], 30.0),
            (Conserved::Casimir1, &[9.0], 114.0),
            (Conserved::Casimir2, &[89.0], 12996.0),
            (Conserved::DeviatorCasimir2, &[48.5], 12996.0),
        ];
        for (quantity, components, square_of_scale) in expected {
            let value = quantity.of(&point(), None).unwrap();
            assert_eq!(value.as_slice(), components, "{quantity:?}");
            let scale = quantity.scale(&point(), None).unwrap();
            if square_of_scale.is_nan() {
                assert!((scale - (50f64.sqrt() + 114f64.sqrt())).abs() < 1e-14, "{quantity:?}");
            } else {
                assert!((scale * scale / square_of_scale - 1.0).abs() < 1e-14, "{quantity:?}");
            }
        }
        assert_eq!(Conserved::Energy.of(&point(), None), None);
        assert_eq!(Conserved::Energy.scale(&point(), None), None);
    }

    #[test]
    fn spatial_values_by_hand() {
        // m^2 = [[-1, 8, 2], [-3, 7, 5], [3, 2, 4]]; the deviator is m - 2.
        let m = Matrix::<3>::new(1.0, 2.0, 0.0, -1.0, 3.0, 1.0, 1.0, 0.0, 2.0);
        let point = PhasePoint::<3, Space, Pinned>::new(Matrix::<3>::identity(), m, Pinned);
        let number = |quantity: Conserved| quantity.of(&point, None).unwrap().as_slice().to_vec();
        assert_eq!(number(Conserved::Casimir1), [6.0]);
        assert_eq!(number(Conserved::Casimir2), [10.0]);
        assert_eq!(number(Conserved::Casimir3), [18.0]);
        assert_eq!(number(Conserved::DeviatorCasimir2), [-2.0]);
        assert_eq!(number(Conserved::DeviatorCasimir3), [6.0]);
        assert_eq!(number(Conserved::Spin), [3.0, -1.0, 1.0], "entries 12, 13, 23");
        assert_eq!(number(Conserved::SpinNorm), [11.0]);
        assert_eq!(number(Conserved::LinearMomentum), [0.0; 3], "a pinned body");
    }

    #[test]
    fn components_by_hand() {
        fn value<const N: usize, P: Phase<N>>(point: &P, entries: &'static [Entry]) -> Option<f64> {
            let value = Conserved::Component(Component { symbol: "", entries }).of(point, None)?;
            assert_eq!(value.as_slice().len(), 1);
            Some(value.as_slice()[0])
        }
        const fn entry(factor: i64, of: Conserved, row: usize, column: usize) -> Entry {
            Entry { factor, of, row, column }
        }
        use Conserved::{AffineSpin, Casimir1, Energy, LinearMomentum, Spin, Vorticity};
        assert_eq!(value(&point(), const { &[entry(1, LinearMomentum, 2, 1)] }), Some(-1.0));
        assert_eq!(value(&point(), const { &[entry(1, AffineSpin, 2, 1)] }), Some(3.0));
        assert_eq!(
            value(&point(), const { &[entry(2, Spin, 1, 2), entry(-3, Vorticity, 1, 2)] }),
            Some(19.0)
        );
        for none in const {
            [
                &[entry(1, LinearMomentum, 1, 2)],
                &[entry(1, LinearMomentum, 3, 1)],
                &[entry(1, Spin, 2, 1)],
                &[entry(1, AffineSpin, 0, 1)],
                &[entry(1, Energy, 1, 1)],
                &[entry(1, Casimir1, 2, 2)],
            ]
        } {
            assert_eq!(value(&point(), none), None, "{none:?}");
        }
        let m = Matrix::<3>::new(1.0, 2.0, 0.0, -1.0, 3.0, 1.0, 1.0, 0.0, 2.0);
        let space = PhasePoint::<3, Space, Pinned>::new(Matrix::<3>::identity(), m, Pinned);
        assert_eq!(value(&space, const { &[entry(1, Spin, 1, 2)] }), Some(3.0));
        assert_eq!(value(&space, const { &[entry(1, Spin, 1, 3)] }), Some(-1.0));
        assert_eq!(value(&space, const { &[entry(1, Spin, 2, 3)] }), Some(1.0));
        // |Sigma|^2 = 114, |Sigma_hat|^2 = 98.
        let both = const { &[entry(2, Spin, 1, 2), entry(-3, Vorticity, 1, 2)] };
        let size =
            Conserved::Component(Component { symbol: "", entries: both }).scale(&point(), None).unwrap();
        assert!((size - (2.0 * 114f64.sqrt() + 3.0 * 98f64.sqrt())).abs() < 1e-13, "{size}");
    }

    #[test]
    fn frames_agree() {
        fn same<F: Frame>(stored: Matrix<2>) {
            let Centre { x, p } = Centre { x: point().x(), p: point().p() };
            let other = PhasePoint::<2, F, _>::new(*point().phi(), stored, Centre { x, p });
            for quantity in [Conserved::AffineSpin, Conserved::Vorticity, Conserved::CanonicalMomentum] {
                let (a, b) = (quantity.of(&other, None).unwrap(), quantity.of(&point(), None).unwrap());
                assert!(a.distance(&b) < 1e-14, "{quantity:?}");
            }
        }
        same::<Space>(Matrix::<2>::new(5.0, 8.0, 3.0, 4.0));
        same::<Body>(Matrix::<2>::new(2.0, 3.0, 6.0, 7.0));
    }
}
