//! Random potentials, in the words in which users write them, against their own plain definition: forces, energies, powers,
//! domains and what is conserved. Nothing is compiled: derived programs are run as they are.
//!
//! `DRAWN_CASES=5000 DRAWN_SEED=7 cargo test --test drawn -- --nocapture` draws others, and more.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod check;
mod conserved;
mod draw;
mod energy;
mod matrices;
mod model;
mod number;
mod place;
mod reduced;
mod traced;

use std::collections::HashMap;
use std::time::Instant;

use affine_codegen::algebra::Function;
use affine_codegen::derive::Model;
use affine_oracle::Random;

use check::Case;
use draw::{Drawing, Placement, Words};
use energy::{Atom, Energy};
use number::size;
use place::{Measures, Place};

/// The families of kinetic energies, by the frame of their momenta.
const FAMILIES: [&str; 3] =
    ["dalembert = 2", "casimir2 = 0.2, body_inertia = 1.5", "casimir1_squared = 0.1, space_inertia = 1.25"];
const TRANSLATIONS: [&str; 3] = ["", ", space_translation = 2", ", body_translation = 3"];

/// Placements of each energy: moderate strains, in which nothing that is wrong hides as a small part.
const PLACES: usize = 2;
const STRAIN: f64 = 0.3;

/// Slopes beyond this say nothing more, and nothing of users; where all are below, the energy is a constant, by an identity
/// of its functions or to all digits.
const LARGEST: f64 = 1e6;
const SMALLEST: f64 = 1e-6;

/// What a force or an energy may differ by in double precision, in roundings of the definition: it is computed in another
/// order.
const ROUNDINGS: f64 = 10.0;

/// An energy with the arguments of its model.
struct Drawn {
    energy: Energy,
    kinetic: String,
    args: String,
    places: Vec<Place>,
}

impl Drawn {
    /// The energy at a place in the list, in its turn for each translation and family; how many were drawn for it.
    fn new(random: &mut Random, n: usize, k: usize) -> (Self, usize) {
        let translation = TRANSLATIONS[k % 3];
        let kinetic = format!("dim = {n}, kinetic({}{translation})", FAMILIES[k / 3 % 3]);
        for tries in 1.. {
            let words = Words::at(random, n, !translation.is_empty());
            // Not the same depths in each chart.
            let depth = [1, 2, 1, 2, 3][(k + k / 9) % 5];
            // Functions of single stretches are multiplied out, for longer than a test has time.
            let depth = if words.placement == Placement::Stretches { depth.min(2) } else { depth };
            let energy = Drawing { random, words }.any(depth);
            let places: Vec<Place> = (0..PLACES).map(|_| Place::random(random, n, STRAIN)).collect();
            if places.iter().all(|place| is_moderate(&energy, place)) {
                let args = format!("{kinetic}, potential = {}", energy.text(n));
                return (Self { energy, kinetic, args, places }, tries);
            }
        }
        unreachable!("there are moderate energies")
    }
}

fn is_moderate(energy: &Energy, place: &Place) -> bool {
    let value = energy.value(&Measures::at(place, energy.is_stretched()));
    let all = value.slopes.iter().chain([&value.value]).all(|slope| size(slope.value) < LARGEST);
    all && value.slopes.iter().any(|slope| size(slope.value) > SMALLEST)
}

/// What came of all cases.
#[derive(Default)]
struct Seen {
    drawn: usize,
    refused: Vec<String>,
    wrong: Vec<String>,
    /// Places at which the reduced equations were looked at, and lists of conserved quantities that are short.
    reduced: usize,
    short: Vec<String>,
    /// The worst errors of forces and of energies, and the longest derivation.
    roundings: [f64; 2],
    seconds: f64,
}

impl Seen {
    fn look(&mut self, random: &mut Random, free: &Model, Drawn { energy, args, places, .. }: &Drawn) {
        let start = Instant::now();
        let model = match model::derived(args) {
            Ok(model) => model,
            Err(messages) => return self.refused.push(format!("{args}\n    {}", messages.join("\n    "))),
        };
        let seconds = start.elapsed().as_secs_f64();
        let case = Case { model: &model, free, energy };
        let mut mistakes = Vec::new();
        for place in places {
            self.reduced += usize::from(case.check(random, place, &mut mistakes));
        }
        if case.conserves(random, places, &mut mistakes) {
            self.short.push(args.clone());
        }
        let roundings = case.rounding(random, &places[0]);
        println!("{seconds:.3} s, {:.1e} and {:.1e} roundings: {args}", roundings[0], roundings[1]);
        for (what, roundings) in ["a force", "the energy"].into_iter().zip(roundings) {
            if roundings.is_nan() || roundings > ROUNDINGS {
                mistakes.push(format!("{what} is wrong by {roundings:e} roundings"));
            }
        }
        if !mistakes.is_empty() {
            self.wrong.push(format!("{args}\n    {}", mistakes.join("\n    ")));
        }
        self.roundings = std::array::from_fn(|k| self.roundings[k].max(roundings[k]));
        self.seconds = self.seconds.max(seconds);
    }

    fn report(&self, count: usize) {
        let Self { drawn, refused, wrong, reduced, short, roundings, seconds } = self;
        println!("{drawn} drawn for {count} cases; the longest derivation took {seconds:.2} s");
        println!("{reduced} of {} reduced equations are plain", PLACES * count);
        println!("worst of forces and energies: {:.1e} and {:.1e} roundings", roundings[0], roundings[1]);
        println!("{} lists are short:\n{}", short.len(), short.join("\n"));
        println!("{} are refused:\n{}", refused.len(), refused.join("\n"));
        assert!(wrong.is_empty(), "{} of {count} are wrong:\n{}", wrong.len(), wrong.join("\n"));
        assert!(refused.len() * 50 <= count, "{} of {count} are refused", refused.len());
        assert!(short.len() * 50 <= count, "{} of {count} lists are short", short.len());
        assert!(*drawn < 2 * count && *reduced > count / 2, "little is looked at");
    }
}

fn setting(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).map_or(otherwise, |text| text.parse().expect("a number"))
}

/// So many cases in one dimension.
fn look_at(n: usize, count: u64) {
    let mut random = Random::new(setting("DRAWN_SEED", 1));
    let count = usize::try_from(setting("DRAWN_CASES", count)).unwrap();
    let mut free: HashMap<String, Model> = HashMap::new();
    let mut seen = Seen::default();
    for k in 0..count {
        let (drawn, tries) = Drawn::new(&mut random, n, k);
        seen.drawn += tries;
        let free = free.entry(drawn.kinetic.clone());
        let free = free.or_insert_with_key(|args| model::derived(args).unwrap());
        seen.look(&mut random, free, &drawn);
    }
    seen.report(count);
}

#[test]
fn in_the_plane() {
    look_at(2, 162);
}

#[test]
fn in_space() {
    look_at(3, 117);
}

/// Energies whose models once did not compile: the name of a sum in a function was taken away.
#[test]
fn once_wrong() {
    let mut random = Random::new(3);
    let second = Energy::Atom(Atom::Invariant(2));
    let squared = Energy::Power(Box::new(second), 2, 1);
    let places = vec![Place::random(&mut random, 3, STRAIN)];
    for function in [Function::Exp, Function::Ln, Function::Cos, Function::Tanh] {
        for family in FAMILIES {
            let energy = Energy::Call(function, Box::new(squared.clone()));
            let kinetic = format!("dim = 3, kinetic({family})");
            let args = format!("{kinetic}, potential = {}", energy.text(3));
            let drawn = Drawn { energy, kinetic, args, places: places.clone() };
            let mut seen = Seen::default();
            seen.look(&mut random, &model::derived(&drawn.kinetic).unwrap(), &drawn);
            assert!(seen.wrong.is_empty() && seen.refused.is_empty(), "{:?}{:?}", seen.wrong, seen.refused);
        }
    }
}
