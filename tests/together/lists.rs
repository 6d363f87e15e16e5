//! What is tried beside each other: kinetic energies, features and centres of mass, as models state them, and the parts that
//! this makes of a model. One list for what is refused, `excluded`, and for the values of what is accepted, `main`.
#![allow(dead_code, reason = "each of the programs that read it reads its own part")]

use affine_codegen::check::{Part, refusals};
use affine_codegen::spec::{Capability, Named};

/// Keys of a model, with the names of drawn numbers in braces, and the parts that they make of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stated {
    pub(crate) name: &'static str,
    pub(crate) keys: &'static str,
    pub(crate) parts: &'static [Part],
}

const fn stated(name: &'static str, keys: &'static str, parts: &'static [Part]) -> Stated {
    Stated { name, keys, parts }
}

/// Kinetic energies that rotations of space and body leave alone, so that a lattice is refused by the table or not at all.
pub(crate) const ENERGIES: [Stated; 7] = [
    stated("body", "kinetic(casimir2 = {a}, body_inertia = {i}{centre})", &[Part::AffineVelocities]),
    stated("space", "kinetic(casimir2 = {a}, space_inertia = {i}{centre})", &[Part::AffineVelocities]),
    stated("flat", "kinetic(dalembert = {j}{centre})", &[Part::PhiDot]),
    stated(
        "flat and body",
        "kinetic(dalembert = {j}, body_inertia = {i}{centre})",
        &[Part::Sum, Part::PhiDot],
    ),
    stated(
        "flat, space and Casimir",
        "kinetic(dalembert = {j}, space_inertia = {i}, casimir2 = {a}{centre})",
        &[Part::Sum, Part::PhiDot],
    ),
    stated(
        "momenta",
        "hamiltonian(casimir2 = {c}, vorticity_squared = {d}{centre})",
        &[Part::AffineVelocities],
    ),
    stated(
        "cubic momenta",
        "hamiltonian(casimir2 = {c}, casimir3 = {a}{centre})",
        &[Part::AffineVelocities, Part::Casimir3],
    ),
];

pub(crate) const FEATURES: [Stated; 15] = [
    stated("free", "", &[Part::Free]),
    stated("potential", "potential = {k}*tr(G)", &[Part::Energy]),
    stated("driven", "potential = {k}*tr(G)*cos({w}*t)", &[Part::Energy, Part::OnTime]),
    stated("stretches", "potential = {k}*pairs(d^4)", &[Part::Energy, Part::OnStretches]),
    stated("field", "potential = custom(f, isotropic)", &[Part::FieldPotential]),
    stated("gravity", "potential = self_gravity({k})", &[Part::SelfGravity]),
    stated("isochoric", "constraint = isochoric", &[Part::Free, Part::Confined]),
    stated("conformal", "constraint = conformal", &[Part::Free, Part::Confined, Part::Similar]),
    stated("rigid", "constraint = rigid", &[Part::Free, Part::Confined, Part::Similar]),
    stated(
        "metrics",
        "metrics(space = {G}, body = {H}), potential = {k}*q^2",
        &[Part::Energy, Part::Metrics],
    ),
    stated(
        "friction",
        "dissipation(casimir1_squared = {i}), potential = {k}*q^2",
        &[Part::Energy, Part::Friction],
    ),
    stated(
        "driven friction",
        "dissipation(casimir1_squared = {i}), potential = {k}*q^2*cos({w}*t)",
        &[Part::Energy, Part::Friction, Part::OnTime],
    ),
    stated("force", "forces = custom(f, spatial), potential = {k}*q^2", &[Part::Energy, Part::Force]),
    stated(
        "gyroscope",
        "forces = custom(f, spatial, gyroscopic), potential = {k}*q^2",
        &[Part::Energy, Part::Force],
    ),
    stated(
        "kick",
        "forces = custom(f, comoving, position), potential = {k}*q^2",
        &[Part::Energy, Part::Kick],
    ),
];

/// The centre of mass: held, or free with its mass in space or in the body.
pub(crate) const CENTRES: [Stated; 3] = [
    stated("held", "", &[]),
    stated("space", "space_translation = {m}", &[]),
    stated("body", "body_translation = {m}", &[Part::BodyTranslation]),
];

/// What a centre that is free may be in.
pub(crate) const PULLS: [Stated; 2] = [
    stated("free", "", &[Part::Free]),
    stated("pulled", "potential = {k}*x[1]^2", &[Part::Energy, Part::OnCentre]),
];

/// A model: an energy, a feature and a centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub(crate) energy: Stated,
    pub(crate) feature: Stated,
    pub(crate) centre: Stated,
}

/// Every energy with every feature, held and with one of the free centres in turn, so that each feature meets both; and with
/// every free centre by itself and pulled.
pub(crate) fn pairs() -> impl Iterator<Item = Pair> {
    let [held, free @ ..] = CENTRES;
    let held = move |energy| FEATURES.into_iter().map(move |feature| Pair { energy, feature, centre: held });
    let turns = move |(row, energy): (usize, Stated)| {
        let moving = FEATURES.into_iter().enumerate().skip(1);
        moving.map(move |(column, feature)| Pair { energy, feature, centre: free[(row + column) % 2] })
    };
    let pulled = move |energy| {
        let pulls = move |centre| PULLS.into_iter().map(move |feature| Pair { energy, feature, centre });
        free.into_iter().flat_map(pulls)
    };
    let turned = ENERGIES.into_iter().enumerate().flat_map(turns);
    ENERGIES.into_iter().flat_map(held).chain(turned).chain(ENERGIES.into_iter().flat_map(pulled))
}

impl Pair {
    /// Some of these are for n = 3 alone.
    pub(crate) fn dim(&self) -> usize {
        let in_space = self.energy.keys.contains("casimir3") || self.feature.keys.contains("self_gravity");
        if in_space { 3 } else { 2 }
    }

    /// The arguments of the attribute.
    pub(crate) fn keys(&self, emitted: &str, drawn: &Drawn) -> String {
        let centre = match self.centre.keys {
            "" => String::new(),
            keys => format!(", {keys}"),
        };
        let keys = [self.energy.keys, self.feature.keys].into_iter().filter(|keys| !keys.is_empty());
        let keys = keys.collect::<Vec<_>>().join(", ").replace("{centre}", &centre);
        drawn.filled(&format!("dim = {}, {keys}, emit({emitted})", self.dim()))
    }

    /// The parts, with those that follow from others together.
    pub(crate) fn parts(&self) -> Vec<Part> {
        let mut parts = [self.energy.parts, self.feature.parts, self.centre.parts].concat();
        // Velocities of rotations are one and the same in both frames, up to a rotation.
        if self.feature.keys.contains("rigid") {
            parts.retain(|part| *part != Part::Sum);
        }
        let has = |part: Part, parts: &[Part]| parts.contains(&part);
        let dalembert = has(Part::PhiDot, &parts) && !has(Part::Sum, &parts);
        if self.feature.keys.contains("isochoric") && dalembert {
            parts.push(Part::Sum);
        }
        if self.feature.keys.contains("conformal") && dalembert {
            parts.push(Part::Weight);
        }
        parts
    }

    /// Everything that the table lets be emitted beside them; nothing where they exclude each other themselves.
    pub(crate) fn accepted(&self) -> Option<Vec<Capability>> {
        let parts = self.parts();
        let goes = |parts: &[Part]| {
            !refusals().any(|refusal| parts.contains(&refusal.part) && parts.contains(&refusal.beside))
        };
        // A centre that is held has no acceleration, and no lattice is written in ratios where there is none.
        let beside = |capability: Capability| match capability {
            Capability::Ratios => vec![Capability::TwoPolar, capability],
            other => vec![other],
        };
        let emitted = |capability: &Capability| {
            let with = beside(*capability).into_iter().map(Part::Emitted);
            let moves = !self.centre.keys.is_empty() || *capability != Capability::Acceleration;
            moves && goes(&parts.iter().copied().chain(with).collect::<Vec<_>>())
        };
        goes(&parts).then(|| Capability::ALL.iter().copied().filter(emitted).collect())
    }
}

/// Numbers of a model, in parts of 64.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    /// By name; matrices row by row.
    numbers: Vec<(char, Vec<i64>)>,
}

/// Names of numbers, with the least and the greatest, and whether they are of either sign. A quadratic form of momenta has the
/// eigenvalues `c` and `2d - c`.
const NUMBERS: [(char, i64, i64, bool); 9] = [
    ('a', 9, 23, true),
    ('i', 41, 95, false),
    ('j', 41, 95, false),
    ('c', 41, 63, false),
    ('d', 65, 95, false),
    ('k', 21, 63, false),
    ('w', 65, 127, false),
    ('m', 41, 127, false),
    ('s', 17, 41, false),
];

impl Drawn {
    /// By splitmix64: of another model other numbers.
    pub(crate) fn new(seed: u64, n: usize) -> Self {
        let mut word = seed;
        let mut one = |low: i64, high: i64| {
            word = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mixed = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            low + ((mixed ^ (mixed >> 31)) % u64::try_from(high - low + 1).unwrap_or(1)) as i64
        };
        let mut numbers: Vec<(char, Vec<i64>)> = Vec::new();
        for (name, low, high, signed) in NUMBERS {
            let sign = if signed { 1 - 2 * one(0, 1) } else { 1 };
            numbers.push((name, vec![sign * one(low, high)]));
        }
        // Symmetric, with diagonals that outweigh the rest.
        for name in ['G', 'H'] {
            let mut rows = vec![0; n * n];
            for (i, j) in (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))) {
                let entry = if i == j { one(65, 127) } else { one(-19, 19) };
                (rows[n * i + j], rows[n * j + i]) = (entry, entry);
            }
            numbers.push((name, rows));
        }
        Self { numbers }
    }

    /// The first number of this name.
    pub(crate) fn value(&self, name: char) -> f64 {
        self.sixty_fourths(name).first().map_or(f64::NAN, |number| *number as f64 / 64.0)
    }

    /// The numbers of this name, times 64.
    pub(crate) fn sixty_fourths(&self, name: char) -> &[i64] {
        self.numbers.iter().find(|(other, _)| *other == name).map_or(&[], |(_, numbers)| numbers)
    }

    /// Keys with numbers in place of their names, as decimals that are exact.
    fn filled(&self, keys: &str) -> String {
        let decimal = |number: &i64| format!("{}", *number as f64 / 64.0);
        let text = |numbers: &[i64]| match numbers {
            [number] => decimal(number),
            rows => {
                let n = rows.len().isqrt();
                let row =
                    |row: &[i64]| format!("[{}]", row.iter().map(decimal).collect::<Vec<_>>().join(", "));
                format!("[{}]", rows.chunks(n).map(row).collect::<Vec<_>>().join(", "))
            }
        };
        let fill = |keys: String, (name, numbers): &(char, Vec<i64>)| {
            keys.replace(&format!("{{{name}}}"), &text(numbers))
        };
        self.numbers.iter().fold(keys.to_owned(), fill)
    }
}
