use affine_runtime::affine_model;
use affine_runtime::force::{Force, Motion};
use affine_runtime::frames::{Matrix, Space};
use affine_runtime::scalar::Scalar;

struct Wind;

impl Force<2> for Wind {
    type Form = Space;
    fn force<T: Scalar>(&self, motion: &Motion<2, T>) -> Matrix<2, T> {
        motion.phi_dot
    }
}

#[affine_model(dim = 2, kinetic(casimir2 = k), forces = custom(wind, spatial))]
struct Model {
    k: f64,
    wind: Wind,
}

fn main() {}
