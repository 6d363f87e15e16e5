//! The programs of a model: those of the chosen reduction against those of the full equations.

use affine_codegen::algebra::Polynomial;
use affine_codegen::algebra::evaluate::Field;
use affine_codegen::derive::Model;
use affine_codegen::ir::Program;
use affine_oracle::Random;

use super::equations::{Named, run};
use super::number::Number;
use super::point::{Dilatation, Point, Slope, Taken};
use super::whole::{TRIES, follows_the_placement};

/// Rates by the names of what they are rates of.
fn rates(program: &Program, inputs: &Named) -> Option<Named> {
    let rates = run(program, inputs)?;
    let of = |name: &str| name.strip_prefix("d_").expect("a rate").to_owned();
    Some(rates.into_iter().map(|(name, rate)| (of(&name), rate)).collect())
}

/// What the reduction of a model whose coefficients are numbers took out.
fn taken(model: &Model) -> Taken {
    let number = |p: &Polynomial| Number::from_rational(&p.as_constant().expect("a number"));
    let none = Named::new();
    let dilatation = model.dynamics.dilatation.as_ref().map(|program| {
        let motion = run(program, &none).expect("numbers");
        let isotropic =
            run(model.point.isotropic.as_ref().expect("an isotropic energy"), &none).expect("numbers");
        Dilatation {
            alpha: isotropic["inverse_alpha"].inverse(),
            inverse_mass: motion["inverse_dilatational_mass"],
            slope: match (motion.get("stiffness"), motion.get("scale")) {
                (None, _) => Slope::Zero,
                (Some(stiffness), None) => Slope::Linear(*stiffness),
                (Some(stiffness), Some(scale)) => {
                    let power = (1..=8).find(|j| Number::integer(*j) == Number::integer(2) * *scale);
                    Slope::Hyperbolic(*stiffness, power.expect("a power of D"))
                }
            },
        }
    });
    Taken::new(model.constraint, &model.dynamics.reduction, dilatation, &number)
}

/// The expansion of the reduced motion against the full one, at a random point.
pub(super) fn check(random: &mut Random, args: &str, model: &Model) {
    let taken = taken(model);
    let coefficients = run(&model.prepared.coefficients, &Named::new()).expect("numbers");
    for _ in 0..TRIES {
        let point = Point::random(random, &taken);
        let mut here = point.reduced(&taken);
        here.extend(coefficients.clone());
        let Some(constants) = run(&model.dynamics.trajectory, &here) else { continue };
        here.extend(constants);
        let Some(reduced) = rates(&model.dynamics.reduced.program, &here) else { continue };
        let phase = point.expanded(&taken, &reduced);
        let (mut there, moving) = phase.coordinates(model.frame);
        there.extend(coefficients.clone());
        there.insert("t".to_owned(), point.t);
        let Some(expected) = rates(&model.dynamics.full.program, &there) else { continue };
        for (name, expected) in &expected {
            assert_eq!(
                &moving[name], expected,
                "{name} of {args}, reduced to {:?}",
                model.dynamics.reduced.groups
            );
        }
        if let (Some(program), Some(work)) = (&model.point.power, reduced.get("work")) {
            let Some(power) = run(program, &there) else { continue };
            assert_eq!(power["power"], *work, "power of {args}");
        }
        follows_the_placement(args, &point, &phase, &reduced);
        return;
    }
    panic!("no point of {args} at which its functions have values");
}
