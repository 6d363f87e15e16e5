//! Random energies, of few words or of many.

use affine_codegen::algebra::Function;
use affine_codegen::spec::NAMED_POTENTIALS;
use affine_oracle::Random;

use super::energy::{Atom, Energy};
use super::traced::{Tensor, Traced};

/// What of the placement an energy may name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Placement {
    /// Nothing.
    Nothing,
    /// `q`, `D`, `det` and the last invariant.
    Dilatation,
    /// What a dilatation leaves as it is.
    Shear,
    /// Invariants and traces.
    Isotropic,
    /// With single stretches.
    Stretches,
    /// With entries of `G`, of `Ct`, or of all three matrices.
    Green,
    Finger,
    General,
}

/// What of the centre it may name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Centre {
    Nothing,
    /// `norm(x)`.
    Norm,
    /// With what `x` is to `Ct`, a number beside a rotation of space.
    Tide,
    Coordinates,
}

/// The words of an energy.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Words {
    pub(crate) n: usize,
    pub(crate) placement: Placement,
    pub(crate) centre: Centre,
    pub(crate) time: bool,
    pub(crate) fields: bool,
}

const PLACEMENTS: [Placement; 8] = [
    Placement::Isotropic,
    Placement::Green,
    Placement::Stretches,
    Placement::Dilatation,
    Placement::Finger,
    Placement::Shear,
    Placement::General,
    Placement::Nothing,
];

impl Words {
    /// Words for the energy at a place in the list; of a body whose centre moves, or is fixed.
    pub(crate) fn at(random: &mut Random, n: usize, moves: bool) -> Self {
        let centres = [Centre::Nothing, Centre::Norm, Centre::Tide, Centre::Coordinates];
        let centre = if moves { centres[chosen(random, 4)] } else { Centre::Nothing };
        let placements = if centre == Centre::Nothing { 7 } else { 8 };
        let placement = PLACEMENTS[chosen(random, placements)];
        Self { n, placement, centre, time: chosen(random, 6) == 0, fields: chosen(random, 4) == 0 }
    }
}

pub(crate) fn chosen(random: &mut Random, count: usize) -> usize {
    usize::try_from(random.integer(0, count as i64 - 1)).expect("a place")
}

fn pick<T: Clone>(random: &mut Random, list: &[T]) -> T {
    list[chosen(random, list.len())].clone()
}

/// Numbers as they are written.
const NUMBERS: [&str; 9] = ["2", "0.5", "3", "1.25", "0.1", "0.75", "5", "0.02", "1.3"];

fn number(digits: &'static str) -> Energy {
    Energy::Atom(Atom::Number(digits))
}

fn add(a: Energy, b: Energy) -> Energy {
    Energy::Add(Box::new(a), Box::new(b))
}

fn subtract(a: Energy, b: Energy) -> Energy {
    Energy::Subtract(Box::new(a), Box::new(b))
}

fn multiply(a: Energy, b: Energy) -> Energy {
    Energy::Multiply(Box::new(a), Box::new(b))
}

fn divide(a: Energy, b: Energy) -> Energy {
    Energy::Divide(Box::new(a), Box::new(b))
}

fn power(a: Energy, k: i32, l: u32) -> Energy {
    Energy::Power(Box::new(a), k, l)
}

fn call(function: Function, a: Energy) -> Energy {
    Energy::Call(function, Box::new(a))
}

fn atom(atom: Atom) -> Energy {
    Energy::Atom(atom)
}

/// `tr(G^2*Ct)`: factors and their powers.
fn trace(factors: &[(Tensor, usize)]) -> Energy {
    let factor = |(tensor, power): &(Tensor, usize)| match power {
        1 => Traced::Matrix(*tensor),
        power => Traced::Power(Box::new(Traced::Matrix(*tensor)), *power),
    };
    let product = |a, b| Traced::Multiply(Box::new(a), Box::new(b));
    traced(factors.iter().map(factor).reduce(product).expect("a factor"))
}

fn traced(inside: Traced) -> Energy {
    atom(Atom::Trace(Box::new(inside)))
}

/// What is drawn from.
pub(crate) struct Drawing<'a> {
    pub(crate) random: &'a mut Random,
    pub(crate) words: Words,
}

impl Drawing<'_> {
    fn one_of(&mut self, count: usize) -> usize {
        chosen(self.random, count)
    }

    fn number(&mut self) -> Energy {
        match self.one_of(8) {
            0 => divide(number("1"), number("3")),
            1 if self.words.fields => atom(Atom::Field(self.one_of(2))),
            _ => number(pick(self.random, &NUMBERS)),
        }
    }

    /// An energy of at most so many operations within each other.
    pub(crate) fn any(&mut self, depth: usize) -> Energy {
        if depth == 0 {
            return self.any_atom();
        }
        let depth = depth - 1;
        match self.one_of(17) {
            0 | 1 => add(self.any(depth), self.any(depth)),
            2 => subtract(self.any(depth), self.any(depth)),
            3 | 4 => multiply(self.any(depth), self.any(depth)),
            5 => multiply(self.number(), self.any(depth)),
            6 => divide(self.any(depth), self.positive(depth)),
            7 => power(subtract(self.any(depth), self.number()), pick(self.random, &[2, 2, 3, 4, 6]), 1),
            8 => Energy::Negate(Box::new(self.any(depth))),
            9 => self.logarithm(depth),
            10 => self.function(depth),
            12 => power(call(Function::Abs, self.any(depth)), 2, 1),
            11 => power(self.any(depth), pick(self.random, &[2, 3]), 1),
            _ => self.positive(depth),
        }
    }

    fn logarithm(&mut self, depth: usize) -> Energy {
        let of = self.positive(depth);
        match self.one_of(4) {
            0 => Energy::Phrase("log", Box::new(of)),
            1 => Energy::Phrase("log1p", Box::new(of)),
            _ => call(Function::Ln, of),
        }
    }

    /// A function that has a value everywhere, of something small; not so large that it is flat to all digits.
    fn function(&mut self, depth: usize) -> Energy {
        let any = [Function::Sin, Function::Cos, Function::Sinh];
        match self.one_of(8) {
            0 => call(Function::Tan, call(Function::Sin, self.any(depth))),
            1 | 2 => call(Function::Tanh, self.any_atom()),
            3 => Energy::Phrase("expm1", Box::new(multiply(number("0.1"), self.any(depth)))),
            4 => call(pick(self.random, &any), self.any_atom()),
            _ => call(pick(self.random, &any), multiply(number("0.1"), self.any(depth))),
        }
    }

    /// The same, of what is positive at every placement.
    fn positive(&mut self, depth: usize) -> Energy {
        if depth == 0 {
            return self.positive_atom();
        }
        let depth = depth - 1;
        match self.one_of(14) {
            0 => add(self.positive(depth), self.positive(depth)),
            1 => multiply(self.positive(depth), self.positive(depth)),
            2 => multiply(self.number(), self.positive(depth)),
            3 => divide(self.positive(depth), self.positive(depth)),
            4 | 5 => power(self.positive(depth), pick(self.random, &[2, 3, -1, -2]), 1),
            6 => call(Function::Exp, multiply(number("0.1"), self.any(depth))),
            7 => call(Function::Cosh, multiply(number("0.1"), self.any(depth))),
            8 => call(Function::Sqrt, self.positive(depth)),
            9 => add(self.number(), power(self.any(depth), 2, 1)),
            10 => add(number("2"), call(pick(self.random, &[Function::Sin, Function::Cos]), self.any(depth))),
            // The sign of everything positive is not seen, but of these.
            11 => call(Function::Abs, self.positive_placement()),
            12 => multiply(self.positive(depth), self.power_of_dilatation()),
            _ => self.positive_atom(),
        }
    }

    /// `det^(-2/3)`, `exp(-2*q)` and the like.
    fn power_of_dilatation(&mut self) -> Energy {
        let n = self.words.n;
        if matches!(self.words.placement, Placement::Shear | Placement::Nothing) {
            return self.positive_atom();
        }
        let base = pick(self.random, &[Atom::Determinant, Atom::Dilatation, Atom::Invariant(n)]);
        match self.one_of(4) {
            0 => call(
                Function::Exp,
                multiply(Energy::Negate(Box::new(number("2"))), atom(Atom::LogDilatation)),
            ),
            1 => power(atom(base), pick(self.random, &[-2, -1, 2]), 1),
            2 => power(atom(base), pick(self.random, &[-1, 1, 3]), 2),
            _ => power(atom(base), pick(self.random, &[-2, -1, 4]), 3),
        }
    }

    fn any_atom(&mut self) -> Energy {
        let mut list = vec![self.positive_atom()];
        list.extend(self.placement_of_any_sign());
        match self.words.centre {
            Centre::Coordinates => list.push(atom(Atom::Position(1 + self.one_of(self.words.n)))),
            Centre::Nothing | Centre::Norm | Centre::Tide => {}
        }
        if self.words.time {
            let angle = multiply(self.number(), atom(Atom::Time));
            let periodic = pick(self.random, &[Function::Sin, Function::Cos]);
            list.push(pick(self.random, &[atom(Atom::Time), call(periodic, angle)]));
        }
        pick(self.random, &list)
    }

    /// Any component of a matrix.
    fn entry(&mut self, tensor: Tensor) -> Energy {
        let n = self.words.n;
        atom(Atom::Entry(tensor, 1 + self.one_of(n), 1 + self.one_of(n)))
    }

    fn placement_of_any_sign(&mut self) -> Option<Energy> {
        let q = atom(Atom::LogDilatation);
        Some(match self.words.placement {
            Placement::Nothing | Placement::Shear => return None,
            Placement::Dilatation => pick(self.random, &[q, call(Function::Ln, atom(Atom::Determinant))]),
            Placement::Isotropic => match self.one_of(4) {
                0 => self.named(),
                1 => {
                    let tensor = pick(self.random, &[Tensor::Green, Tensor::Finger]);
                    self.strain(tensor)
                }
                _ => q,
            },
            Placement::Stretches => match self.one_of(4) {
                0 => q,
                1 => Energy::Pairs(Box::new(self.of_difference())),
                _ => Energy::Sum(Box::new(self.of_stretch())),
            },
            Placement::Green => self.entry(Tensor::Green),
            Placement::Finger => self.entry(Tensor::Finger),
            Placement::General => match self.one_of(6) {
                0 => trace(&[(Tensor::Placement, 1)]),
                5 => self.trace_of_sums(),
                1 => trace(&[(Tensor::Placement, 1), (Tensor::Green, 1)]),
                2 => self.entry(Tensor::Green),
                _ => self.entry(Tensor::Placement),
            },
        })
    }

    /// `tr((G - 1)^2)`, `tr((G - tr(G)/n)^3)`.
    fn strain(&mut self, tensor: Tensor) -> Energy {
        let number = match self.one_of(3) {
            0 => self.number(),
            1 => number("1"),
            _ => divide(trace(&[(tensor, 1)]), atom(Atom::Dimension)),
        };
        let [matrix, number] = [Traced::Matrix(tensor), Traced::Number(Box::new(number))].map(Box::new);
        traced(Traced::Power(Box::new(Traced::Subtract(matrix, number)), pick(self.random, &[2, 2, 3])))
    }

    /// `tr((2*G + 1)*(phi - 0.5*Ct))`, and powers of each and of both.
    fn trace_of_sums(&mut self) -> Energy {
        let matrices = [Tensor::Green, Tensor::Finger, Tensor::Placement];
        let mut factor = || {
            let scaled = |drawing: &mut Self| {
                let number = Box::new(Traced::Number(Box::new(drawing.number())));
                Traced::Multiply(number, Box::new(Traced::Matrix(pick(drawing.random, &matrices))))
            };
            let [one, other] = [scaled(self), scaled(self)].map(Box::new);
            let number = Box::new(Traced::Number(Box::new(self.number())));
            let sum = match self.one_of(3) {
                0 => Traced::Add(one, number),
                1 => Traced::Subtract(number, one),
                _ => Traced::Subtract(one, other),
            };
            match pick(self.random, &[1, 1, 2, 3]) {
                1 => sum,
                power => Traced::Power(Box::new(sum), power),
            }
        };
        let [one, other] = [factor(), factor()].map(Box::new);
        let product = Traced::Multiply(one, other);
        match self.one_of(3) {
            0 => traced(Traced::Power(Box::new(product), 2)),
            _ => traced(product),
        }
    }

    fn named(&mut self) -> Energy {
        let place = self.one_of(NAMED_POTENTIALS.len());
        let coefficients = NAMED_POTENTIALS[place].parameters.iter().map(|_| self.number()).collect();
        Energy::Named(place, coefficients)
    }

    /// A function of one stretch.
    fn of_stretch(&mut self) -> Energy {
        let [q, stretch] = [Atom::LogStretch, Atom::Stretch].map(atom);
        match self.one_of(6) {
            0 => power(q, pick(self.random, &[1, 2, 3, 4]), 1),
            1 => power(stretch, pick(self.random, &[4, -2, 3, 1]), 1),
            2 => power(stretch, pick(self.random, &[13, -5, 1]), 10),
            3 => call(Function::Exp, multiply(number("1.3"), q)),
            4 => power(subtract(stretch, number("1")), 2, 1),
            _ => multiply(q, power(stretch, 2, 1)),
        }
    }

    /// An even function of the difference of two logarithmic stretches.
    fn of_difference(&mut self) -> Energy {
        let d = atom(Atom::Difference);
        match self.one_of(4) {
            0 => power(d, pick(self.random, &[2, 4]), 1),
            1 => call(Function::Cosh, multiply(self.number(), d)),
            2 => power(call(Function::Sinh, d), 2, 1),
            _ => call(Function::Sqrt, add(number("1"), power(d, 2, 1))),
        }
    }

    fn positive_atom(&mut self) -> Energy {
        let mut list = vec![self.positive_placement()];
        match self.words.centre {
            Centre::Nothing => {}
            Centre::Norm | Centre::Coordinates => list.push(atom(Atom::Norm)),
            Centre::Tide => list.push(self.tide()),
        }
        pick(self.random, &list)
    }

    /// `x . Ct x`; or `|phi^-1 x|^2`, where that is short.
    fn tide(&mut self) -> Energy {
        let n = self.words.n;
        let inverse = n == 2 && self.one_of(2) == 0;
        let mut terms = Vec::new();
        for (i, j) in (1..=n).flat_map(|i| (i..=n).map(move |j| (i, j))) {
            let (row, column) = if inverse { (3 - j, 3 - i) } else { (i, j) };
            let [x, y] = [i, j].map(|i| atom(Atom::Position(i)));
            let term = multiply(multiply(atom(Atom::Entry(Tensor::Finger, row, column)), x), y);
            let term = if i == j { term } else { multiply(number("2"), term) };
            terms.push(if i != j && inverse { Energy::Negate(Box::new(term)) } else { term });
        }
        let sum = terms.into_iter().reduce(add).expect("a term");
        if inverse { divide(sum, power(atom(Atom::Determinant), 2, 1)) } else { sum }
    }

    fn positive_placement(&mut self) -> Energy {
        let n = self.words.n;
        match self.words.placement {
            Placement::Nothing => self.number(),
            Placement::Dilatation => {
                let list = [Atom::Dilatation, Atom::Determinant, Atom::Invariant(n)];
                atom(pick(self.random, &list))
            }
            Placement::Shear => self.shear(),
            Placement::Stretches => match self.one_of(4) {
                0 => Energy::Sum(Box::new(atom(Atom::Stretch))),
                1 => Energy::Sum(Box::new(power(atom(Atom::Stretch), pick(self.random, &[2, 4, -2]), 1))),
                2 => {
                    let square = power(atom(Atom::Stretch), pick(self.random, &[1, 2]), 1);
                    Energy::Product(Box::new(add(number("1"), square)))
                }
                _ => self.isotropic(),
            },
            Placement::Isotropic => self.isotropic(),
            Placement::Green => self.isotropic_or_diagonal(Tensor::Green),
            Placement::Finger => self.isotropic_or_diagonal(Tensor::Finger),
            Placement::General => match self.one_of(4) {
                0 => self.isotropic_or_diagonal(Tensor::Green),
                1 => self.isotropic_or_diagonal(Tensor::Finger),
                2 => trace(&[(Tensor::Green, 1), (Tensor::Finger, 1)]),
                _ => self.isotropic(),
            },
        }
    }

    fn isotropic_or_diagonal(&mut self, tensor: Tensor) -> Energy {
        if self.one_of(2) == 0 {
            return self.isotropic();
        }
        let i = 1 + self.one_of(self.words.n);
        atom(Atom::Entry(tensor, i, i))
    }

    fn isotropic(&mut self) -> Energy {
        let n = self.words.n;
        match self.one_of(10) {
            9 => traced(Traced::Inverse(pick(self.random, &[Tensor::Green, Tensor::Finger]))),
            0 => atom(Atom::Dilatation),
            1 => atom(Atom::Determinant),
            2 => trace(&[(Tensor::Green, 2)]),
            3 => trace(&[(Tensor::Green, 1), (Tensor::Green, 1)]),
            4 => trace(&[(pick(self.random, &[Tensor::Green, Tensor::Finger]), 3)]),
            5 | 6 => atom(Atom::Invariant(1 + self.one_of(n))),
            7 => trace(&[(Tensor::Finger, 1)]),
            _ => trace(&[(Tensor::Green, 1)]),
        }
    }

    /// Traces that a dilatation leaves as they are.
    fn shear(&mut self) -> Energy {
        let n = i32::try_from(self.words.n).expect("2 or 3");
        let (trace, degree) = match self.one_of(3) {
            0 => (trace(&[(Tensor::Green, 2)]), 2),
            1 if n == 3 => (atom(Atom::Invariant(2)), 2),
            _ => (trace(&[(Tensor::Green, 1)]), 1),
        };
        let scale = match self.one_of(3) {
            0 => {
                let exponent = number(if degree == 1 { "2" } else { "4" });
                let exponent = multiply(Energy::Negate(Box::new(exponent)), atom(Atom::LogDilatation));
                call(Function::Exp, exponent)
            }
            1 if n == 3 => power(atom(Atom::Determinant), -2 * degree, 3),
            1 => power(atom(Atom::Determinant), -degree, 1),
            _ => power(atom(Atom::Dilatation), -2 * degree, 1),
        };
        multiply(trace, scale)
    }
}
