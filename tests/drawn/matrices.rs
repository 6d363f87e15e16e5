//! Traces of polynomials in matrices, which stay matrices: at random placements and far from rest, in every chart.

use qd::Quad;

use affine_oracle::Random;

use super::energy::{Atom, Energy};
use super::place::{Place, product, square};
use super::traced::{Tensor, Traced};
use super::{Drawn, FAMILIES, STRAIN, Seen, model};

fn number(digits: &'static str) -> Traced {
    Traced::Number(Box::new(Energy::Atom(Atom::Number(digits))))
}

fn add(a: Traced, b: Traced) -> Traced {
    Traced::Add(Box::new(a), Box::new(b))
}

fn subtract(a: Traced, b: Traced) -> Traced {
    Traced::Subtract(Box::new(a), Box::new(b))
}

fn multiply(a: Traced, b: Traced) -> Traced {
    Traced::Multiply(Box::new(a), Box::new(b))
}

fn power(a: Traced, k: usize) -> Traced {
    Traced::Power(Box::new(a), k)
}

fn trace(inside: Traced) -> Energy {
    Energy::Atom(Atom::Trace(Box::new(inside)))
}

/// Powers of sums, of products, of both within each other, beside scalars and other powers, and products that meet on the
/// circle of a trace.
fn energies() -> Vec<Energy> {
    let [green, finger, phi] =
        [Tensor::Green, Tensor::Finger, Tensor::Placement].map(|tensor| move || Traced::Matrix(tensor));
    let sum = || add(green(), finger());
    let pair = || multiply(green(), finger());
    let mean = Traced::Number(Box::new(Energy::Divide(
        Box::new(trace(finger())),
        Box::new(Energy::Atom(Atom::Dimension)),
    )));
    let field = Traced::Number(Box::new(Energy::Atom(Atom::Field(0))));
    let mut list = vec![
        trace(power(sum(), 4)),
        trace(power(sum(), 5)),
        trace(power(sum(), 9)),
        trace(power(subtract(sum(), number("2")), 4)),
        trace(power(pair(), 3)),
        trace(power(subtract(pair(), number("1")), 3)),
        trace(power(add(phi(), multiply(number("0.5"), green())), 5)),
        trace(multiply(power(subtract(phi(), number("1")), 2), power(sum(), 3))),
        trace(power(subtract(green(), mean), 4)),
        trace(multiply(multiply(green(), power(add(finger(), field.clone()), 2)), green())),
        trace(add(multiply(field, power(sum(), 2)), power(power(add(phi(), finger()), 2), 2))),
        trace(multiply(sum(), subtract(green(), multiply(number("2"), finger())))),
        trace(multiply(multiply(green(), multiply(phi(), green())), multiply(phi(), green()))),
        trace(power(subtract(green(), number("1")), 7)),
        trace(power(subtract(phi(), number("1")), 2)),
        trace(multiply(subtract(green(), number("1")), subtract(finger(), number("1")))),
    ];
    let less = Energy::Subtract(Box::new(trace(power(sum(), 3))), Box::new(Energy::Atom(Atom::Number("5"))));
    list.push(Energy::Power(Box::new(less), 3, 1));
    list
}

/// A strained body, a hardly strained one, and one that is long in one direction and short in another.
fn places(random: &mut Random, n: usize) -> Vec<Place> {
    let mut places: Vec<Place> =
        [STRAIN, STRAIN, 1.0 / 64.0].map(|strain| Place::random(random, n, strain)).into();
    let stretches = [30.0, 0.05, 2.0].map(Quad::from);
    let [mut far, other] = [0, 1].map(|_| Place::random(random, n, STRAIN));
    let stretched = square(n, |i, a| far.phi[i][a] * stretches[a]);
    far.phi = product(&stretched, &other.phi);
    places.push(far);
    places
}

fn look_at(n: usize) {
    let mut random = Random::new(11);
    let mut seen = Seen::default();
    for family in FAMILIES {
        let kinetic = format!("dim = {n}, kinetic({family})");
        let free = model::derived(&kinetic).unwrap();
        for energy in energies() {
            let args = format!("{kinetic}, potential = {}", energy.text(n));
            let mut places = places(&mut random, n);
            let last = places.len() - 1;
            // Rounding is looked at at the first one.
            for k in [0, last] {
                places.swap(0, k);
                let (energy, kinetic, places) = (energy.clone(), kinetic.clone(), places.clone());
                seen.look(&mut random, &free, &Drawn { energy, kinetic, args: args.clone(), places });
            }
        }
    }
    let Seen { refused, wrong, .. } = &seen;
    assert!(refused.is_empty() && wrong.is_empty(), "{}\n{}", refused.join("\n"), wrong.join("\n"));
}

#[test]
fn in_the_plane() {
    look_at(2);
}

#[test]
fn in_space() {
    look_at(3);
}

/// Operations of the full equations and of the reduced ones: multiplications and additions at most.
const COSTS: [(&str, [usize; 2]); 10] = [
    ("tr((G + Ct)^2)", [144, 144]),
    ("tr((G + Ct)^4)", [194, 194]),
    ("tr((G + Ct)^5)", [189, 189]),
    ("tr((G + Ct)^16)", [296, 296]),
    ("tr((G + Ct - 2)^4)", [200, 197]),
    ("tr((G*Ct)^3)", [294, 294]),
    ("tr((G*Ct - 1)^2)", [282, 267]),
    ("tr((G - 1)^4)", [141, 148]),
    ("tr(G^16)", [237, 237]),
    ("tr((G + Ct)*(G - Ct))", [0, 0]),
];

#[test]
fn operations() {
    let mut wrong = Vec::new();
    for (energy, most) in COSTS {
        let model =
            model::derived(&format!("dim = 3, kinetic(dalembert = 1), potential = {energy}")).unwrap();
        let found = [&model.dynamics.full.program, &model.dynamics.reduced.program].map(|program| {
            let operations = program.operations();
            assert_eq!(operations.mul + operations.add, operations.weight(), "{energy}");
            [operations.mul, operations.add]
        });
        println!("{energy}: {found:?}");
        if found.iter().zip(&most).any(|([mul, add], most)| mul + add > *most) {
            wrong.push(format!("{energy}: {found:?} where {most:?} were enough"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
