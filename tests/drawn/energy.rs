//! Energies as users write them: text, and value by the plain definition of everything that the text names.

use affine_codegen::algebra::Function;
use affine_codegen::spec::NAMED_POTENTIALS;
use qd::Quad;

use super::number::Dual;
use super::place::{Measures, Square, dual_product, square, sum};
use super::traced::{Tensor, Traced};

/// What stands by itself. Indices count from 1, as in the text.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Atom {
    /// A decimal number, as written.
    Number(&'static str),
    /// `n`.
    Dimension,
    /// The field `a` or `b`.
    Field(usize),
    Time,
    /// `q`, `D` and `det`.
    LogDilatation,
    Dilatation,
    Determinant,
    /// `I1..In`.
    Invariant(usize),
    /// `tr(G^2*Ct)`, `tr((G - 1)^2)`.
    Trace(Box<Traced>),
    Entry(Tensor, usize, usize),
    Position(usize),
    Norm,
    /// In a sum over stretches `q_a` and `Q_a`; in `pairs` the difference `d`.
    LogStretch,
    Stretch,
    Difference,
}

/// An energy, or a part of one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Energy {
    Atom(Atom),
    Add(Box<Energy>, Box<Energy>),
    Subtract(Box<Energy>, Box<Energy>),
    Multiply(Box<Energy>, Box<Energy>),
    Divide(Box<Energy>, Box<Energy>),
    Negate(Box<Energy>),
    /// `a^k`, and `a^(k/l)` of what is positive.
    Power(Box<Energy>, i32, u32),
    Call(Function, Box<Energy>),
    /// `log(a)`, `log1p(a)`, `expm1(a)`.
    Phrase(&'static str, Box<Energy>),
    /// `f(q_1) + .. + f(q_n)`, and their product.
    Sum(Box<Energy>),
    Product(Box<Energy>),
    /// `pairs(f(d))`.
    Pairs(Box<Energy>),
    /// `name(coefficient, ..)`, by the place in the table.
    Named(usize, Vec<Energy>),
}

/// Stretches that a part stands for: one, or two.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Chosen(usize, usize);

/// How tightly a text is bound.
pub(crate) const SUM: u8 = 0;
pub(crate) const PRODUCT: u8 = 1;
const SIGN: u8 = 2;
pub(crate) const POWER: u8 = 3;
pub(crate) const ALONE: u8 = 4;

impl Energy {
    /// As in the attribute.
    pub(crate) fn text(&self, n: usize) -> String {
        self.bound(n, Chosen::default(), SUM)
    }

    /// In brackets where it is not bound as tightly as this.
    pub(crate) fn bound(&self, n: usize, chosen: Chosen, least: u8) -> String {
        let (text, level) = self.written(n, chosen);
        if level < least { format!("({text})") } else { text }
    }

    fn written(&self, n: usize, chosen: Chosen) -> (String, u8) {
        let of = |one: &Self, least: u8| one.bound(n, chosen, least);
        match self {
            Self::Atom(atom) => (atom.text(n, chosen), ALONE),
            Self::Add(a, b) => (format!("{} + {}", of(a, SUM), of(b, PRODUCT)), SUM),
            Self::Subtract(a, b) => (format!("{} - {}", of(a, SUM), of(b, PRODUCT)), SUM),
            Self::Multiply(a, b) => (format!("{}*{}", of(a, PRODUCT), of(b, SIGN)), PRODUCT),
            Self::Divide(a, b) => (format!("{}/{}", of(a, PRODUCT), of(b, SIGN)), PRODUCT),
            Self::Negate(a) => (format!("-{}", of(a, SIGN)), SIGN),
            Self::Power(a, k, 1) => (format!("{}^{k}", of(a, ALONE)), POWER),
            Self::Power(a, k, l) => (format!("{}^({k}/{l})", of(a, ALONE)), POWER),
            Self::Call(function, a) => (format!("{}({})", function.name(), of(a, SUM)), ALONE),
            Self::Phrase(name, a) => (format!("{name}({})", of(a, SUM)), ALONE),
            Self::Sum(f) => {
                let terms: Vec<String> = (1..=n).map(|a| f.bound(n, Chosen(a, a), PRODUCT)).collect();
                (terms.join(" + "), SUM)
            }
            Self::Product(f) => {
                let factors: Vec<String> = (1..=n).map(|a| f.bound(n, Chosen(a, a), SIGN)).collect();
                (factors.join("*"), PRODUCT)
            }
            Self::Pairs(f) => (format!("pairs({})", of(f, SUM)), ALONE),
            Self::Named(place, coefficients) => {
                let list: Vec<String> = coefficients.iter().map(|c| of(c, SUM)).collect();
                (format!("{}({})", NAMED_POTENTIALS[*place].name, list.join(", ")), ALONE)
            }
        }
    }

    /// The value and its derivatives.
    pub(crate) fn value(&self, at: &Measures) -> Dual {
        self.of(at, Chosen::default())
    }

    pub(crate) fn of(&self, at: &Measures, chosen: Chosen) -> Dual {
        let value = |one: &Self| one.of(at, chosen);
        let n = at.phi.len();
        match self {
            Self::Atom(atom) => atom.of(at, chosen),
            Self::Add(a, b) => value(a).plus(&value(b)),
            Self::Subtract(a, b) => value(a).plus(&value(b).negated()),
            Self::Multiply(a, b) => value(a).times(&value(b)),
            Self::Divide(a, b) => value(a).times(&value(b).power(-1, 1)),
            Self::Negate(a) => value(a).negated(),
            Self::Power(a, k, l) => value(a).power(*k, *l),
            Self::Call(function, a) => value(a).apply(*function),
            Self::Phrase("log", a) => value(a).apply(Function::Ln),
            Self::Phrase("log1p", a) => value(a).plus(&number(1.0)).apply(Function::Ln),
            Self::Phrase(_, a) => value(a).apply(Function::Exp).plus(&number(-1.0)),
            Self::Sum(f) => sum((1..=n).map(|a| f.of(at, Chosen(a, a)))),
            Self::Product(f) => {
                (2..=n).fold(f.of(at, Chosen(1, 1)), |product, a| product.times(&f.of(at, Chosen(a, a))))
            }
            Self::Pairs(f) => {
                let pairs = (1..=n).flat_map(|a| (a + 1..=n).map(move |b| (a, b)));
                sum(pairs.map(|(a, b)| f.of(at, Chosen(a, b))))
            }
            Self::Named(place, coefficients) => {
                named(NAMED_POTENTIALS[*place].name, &coefficients.iter().map(value).collect::<Vec<_>>(), at)
            }
        }
    }

    /// Does it name stretches?
    pub(crate) fn is_stretched(&self) -> bool {
        self.has(&|part| matches!(part, Self::Sum(_) | Self::Product(_) | Self::Pairs(_)))
    }

    /// Does it take roots, by name or in a norm?
    pub(crate) fn has_roots(&self) -> bool {
        self.has(&|part| matches!(part, Self::Call(Function::Sqrt, _) | Self::Atom(Atom::Norm)))
    }

    fn has(&self, wanted: &dyn Fn(&Self) -> bool) -> bool {
        let below = |part: &Self| part.has(wanted);
        wanted(self)
            || match self {
                Self::Atom(_) | Self::Named(..) => false,
                Self::Add(a, b) | Self::Subtract(a, b) | Self::Multiply(a, b) | Self::Divide(a, b) => {
                    below(a) || below(b)
                }
                Self::Negate(a) | Self::Power(a, ..) | Self::Call(_, a) | Self::Phrase(_, a) => below(a),
                Self::Sum(f) | Self::Product(f) | Self::Pairs(f) => below(f),
            }
    }
}

fn number(value: f64) -> Dual {
    Dual::constant(Quad::from(value))
}

/// `ln(det phi)/n`.
fn log_dilatation(at: &Measures) -> Dual {
    at.det.apply(Function::Ln).times(&number(at.phi.len() as f64).power(-1, 1))
}

fn trace(a: &Square<Dual>) -> Dual {
    sum((0..a.len()).map(|k| a[k][k]))
}

/// The formulas of named potentials, as the documentation has them.
fn named(name: &str, coefficients: &[Dual], at: &Measures) -> Dual {
    let n = number(at.phi.len() as f64);
    let (q, c) = (log_dilatation(at), &coefficients[0]);
    let half = number(0.5);
    // tr (G - 1) and tr (G - 1)^2.
    let strain =
        square(at.phi.len(), |a, b| if a == b { at.green[a][b].plus(&number(-1.0)) } else { at.green[a][b] });
    let (first, second) = (trace(&strain), trace(&dual_product(&strain, &strain)));
    let shrunk = q.times(&number(-2.0)).apply(Function::Exp);
    match name {
        "hyperbolic_dilatation" => c.times(&half).times(&q.apply(Function::Sinh).power(2, 1)),
        "harmonic_dilatation" => c.times(&half).times(&q.power(2, 1)),
        "dissociation" => c.times(&half).times(&q.apply(Function::Cosh).power(-2, 1)).negated(),
        "neo_hookean" => c.times(&trace(&at.green).times(&shrunk).plus(&n.negated())),
        "saint_venant_kirchhoff" => {
            let squares = c.times(&half).times(&first.power(2, 1)).plus(&coefficients[1].times(&second));
            squares.times(&number(0.25))
        }
        "orthogonality" => c.times(&second),
        "gas" => c.times(&shrunk),
        other => panic!("{other} has no formula here"),
    }
}

impl Atom {
    fn text(&self, n: usize, chosen: Chosen) -> String {
        let Chosen(a, _) = chosen;
        match self {
            Self::Number(digits) => (*digits).to_owned(),
            Self::Dimension => "n".to_owned(),
            Self::Field(k) => ["a", "b"][*k].to_owned(),
            Self::Time => "t".to_owned(),
            Self::LogDilatation => "q".to_owned(),
            Self::Dilatation => "D".to_owned(),
            Self::Determinant => "det".to_owned(),
            Self::Invariant(k) => format!("I{k}"),
            Self::Trace(traced) => format!("tr({})", traced.bound(n, chosen, SUM)),
            Self::Entry(tensor, i, j) => format!("{}[{i},{j}]", tensor.name()),
            Self::Position(i) => format!("x[{i}]"),
            Self::Norm => "norm(x)".to_owned(),
            Self::LogStretch => format!("q{a}"),
            Self::Stretch => format!("Q{a}"),
            Self::Difference => "d".to_owned(),
        }
    }

    fn of(&self, at: &Measures, chosen: Chosen) -> Dual {
        let Chosen(a, b) = chosen;
        let n = at.phi.len();
        match self {
            Self::Number(digits) => decimal(digits),
            Self::Dimension => number(n as f64),
            Self::Field(k) => at.fields[*k],
            Self::Time => at.t,
            Self::LogDilatation => log_dilatation(at),
            Self::Dilatation => log_dilatation(at).apply(Function::Exp),
            Self::Determinant => at.det,
            Self::Invariant(k) => invariant(*k, at),
            Self::Trace(traced) => trace(&traced.of(at, chosen)),
            Self::Entry(tensor, i, j) => tensor.of(at)[i - 1][j - 1],
            Self::Position(i) => at.x[i - 1],
            Self::Norm => sum(at.x.iter().map(|x| x.power(2, 1))).apply(Function::Sqrt),
            Self::LogStretch => at.log_stretches[a - 1],
            Self::Stretch => at.log_stretches[a - 1].apply(Function::Exp),
            Self::Difference => at.log_stretches[a - 1].plus(&at.log_stretches[b - 1].negated()),
        }
    }
}

/// The elementary symmetric functions of the eigenvalues of `G`.
fn invariant(k: usize, at: &Measures) -> Dual {
    let (n, first) = (at.phi.len(), trace(&at.green));
    match k {
        1 => first,
        k if k == n => at.det.power(2, 1),
        _ => {
            let minor = |a: usize, b: usize| {
                let g = &at.green;
                g[a][a].times(&g[b][b]).plus(&g[a][b].times(&g[b][a]).negated())
            };
            sum([minor(0, 1), minor(0, 2), minor(1, 2)].into_iter())
        }
    }
}

/// A decimal number to all digits.
fn decimal(digits: &str) -> Dual {
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let integer: f64 = format!("{whole}{fraction}").parse().expect("digits");
    let places = i32::try_from(fraction.len()).expect("few digits");
    Dual::constant(Quad::from(integer) / Quad::from(10f64.powi(places)))
}
