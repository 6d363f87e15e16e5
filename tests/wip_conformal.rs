#![allow(missing_docs)]
use affine_runtime::prelude::*;
#[affine_model(dim = 3, constraint = conformal, kinetic(dalembert = diag(1, 1.5, 2), space_translation = 2), potential = sinh(q)^2 + phi[3,3] + x[1]*phi[1,1])]
struct Ball;
#[affine_model(dim = 2, constraint = conformal, kinetic(dalembert = i))]
struct Disc { i: f64 }
#[test]
fn show() { println!("{:#?}", <Ball as Model<3>>::DESCRIPTION);  println!("{:#?}", <PreparedDisc as Model<2>>::DESCRIPTION);}
