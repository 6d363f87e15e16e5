//! Models through the public pipeline, and their programs at phase points.

use std::cell::RefCell;
use std::collections::{BTreeSet, HashMap};

use affine_codegen::algebra::Function;
use affine_codegen::algebra::evaluate::Field;
use affine_codegen::algebra::kernel::Callee;
use affine_codegen::derive::{Model, derive};
use affine_codegen::diagnostics::{Rejected, gate};
use affine_codegen::ir::{Op, Program};
use affine_codegen::symbol::{Quantity, Symbol};
use affine_codegen::{check, range, spec};
use affine_oracle::Random;
use affine_runtime::scalar::Scalar;
use qd::Quad;

use super::number::{Dual, Number};
use super::place::{Place, Principal, Square, determinant, dual_product, short, square, sum};

/// Fields that an energy may name.
const ITEM: &str = "struct Model { a: f64, b: f64 }";

/// The derived model; of one that is refused the first lines of its messages.
pub(crate) fn derived(args: &str) -> Result<Model, Vec<String>> {
    let pipeline = || -> Result<Model, Rejected> {
        let (args, item) = (args.parse().expect("tokens"), ITEM.parse().expect("tokens"));
        let spec = gate(|found| spec::parse(args, item, found))?;
        gate(|found| check::as_written(&spec, found))?;
        let energy = gate(|found| check::energy(&spec, found))?;
        let model = derive(energy, false).expect("what passed the checks");
        gate(|found| range::representable(&spec, &model, found))?;
        Ok(model)
    };
    let first = |message: String| message.lines().next().unwrap_or_default().to_owned();
    pipeline().map_err(|rejected| rejected.diagnostics().map(|one| first(one.to_string())).collect())
}

/// Numbers that programs run on, from those of 31 digits.
pub(crate) trait Machine: Field {
    fn from_quad(value: Quad) -> Self;
    fn to_quad(&self) -> Quad;
}

impl Machine for Number {
    fn from_quad(value: Quad) -> Self {
        Self(value)
    }
    fn to_quad(&self) -> Quad {
        self.0
    }
}

impl Machine for f64 {
    fn from_quad(value: Quad) -> Self {
        value.0
    }
    fn to_quad(&self) -> Quad {
        Quad::from(*self)
    }
}

/// Coordinates of every chart by the names of programs, from `(x, p)` and `(phi, Pi)`.
pub(crate) fn charts(
    (x, p): (&[Dual], &[Dual]),
    (phi, pi): (&Square<Dual>, &Square<Dual>),
) -> HashMap<String, Dual> {
    let n = phi.len();
    let (sigma_hat, sigma) = (dual_product(pi, phi), dual_product(phi, pi));
    let total = square(n, |i, j| x[i].times(&p[j]).plus(&sigma[i][j]));
    let p_hat: Vec<Dual> = (0..n).map(|a| sum((0..n).map(|i| phi[i][a].times(&p[i])))).collect();
    let q = determinant(phi).apply(Function::Ln).times(&Dual::constant(Quad::ONE / Quad::from(n as f64)));
    let mut list = HashMap::from([
        ("inverse_dilatation".to_owned(), q.negated().apply(Function::Exp)),
        ("dilatation".to_owned(), q.apply(Function::Exp)),
        ("q".to_owned(), q),
    ]);
    for (name, vector) in [("x", x), ("p", p), ("p_hat", &p_hat)] {
        list.extend(vector.iter().enumerate().map(|(i, value)| (format!("{name}_{}", i + 1), *value)));
    }
    let matrices =
        [("phi", phi), ("pi", pi), ("sigma_hat", &sigma_hat), ("sigma", &sigma), ("total", &total)];
    for (name, matrix) in matrices {
        let entry = |k: usize| (format!("{name}_{}{}", k / n + 1, k % n + 1), matrix[k / n][k % n]);
        list.extend((0..n * n).map(entry));
    }
    list
}

/// Numbers by the names of programs.
pub(crate) type Named = HashMap<String, Quad>;

/// What a program reads beside coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reads {
    /// The plain array of all coordinates in the model's own frames, and the time.
    State,
    /// The reduced state, with the constants of its trajectory.
    Reduced,
    /// What those constants come from.
    Trajectory,
    /// A phase point with the logarithms of its stretches.
    Point,
}

/// A phase point: a place with canonical momenta.
pub(crate) struct Phase {
    pub(crate) place: Place,
    pub(crate) p: Vec<Quad>,
    pub(crate) pi: Square<Quad>,
    known: Named,
    principal: Principal,
    /// What programs read and nothing provides.
    pub(crate) unknown: RefCell<BTreeSet<String>>,
}

impl Phase {
    /// With random momenta, or at rest.
    pub(crate) fn new(random: &mut Random, place: &Place, moving: bool) -> Self {
        let n = place.dim();
        let mut momentum = || if moving { Quad::from(short(random, -1.0, 1.0)) } else { Quad::ZERO };
        let p: Vec<Quad> = (0..n).map(|_| momentum()).collect();
        let pi: Square<Quad> = (0..n).map(|_| (0..n).map(|_| momentum()).collect()).collect();
        let vector = |list: &[Quad]| list.iter().map(|value| Dual::constant(*value)).collect::<Vec<_>>();
        let matrix = |list: &Square<Quad>| list.iter().map(|row| vector(row)).collect::<Square<Dual>>();
        let all = charts((&vector(&place.x), &vector(&p)), (&matrix(&place.phi), &matrix(&pi)));
        let mut known: Named = all.into_iter().map(|(name, value)| (name, value.value.value)).collect();
        let principal = Principal::of(&place.phi);
        let logarithms = principal.stretches.iter().map(|stretch| Scalar::ln(*stretch));
        known.extend(logarithms.enumerate().map(|(a, q)| (format!("q_{}", a + 1), q)));
        known.insert("t".to_owned(), place.t);
        known.extend(["self.a", "self.b"].map(str::to_owned).into_iter().zip(place.fields));
        Self { place: place.clone(), p, pi, known, principal, unknown: RefCell::default() }
    }

    /// The results of a program by name; with the coefficients that the model is prepared with.
    pub(crate) fn run<F: Machine>(&self, model: &Model, program: &Program, reads: Reads) -> Named {
        let mut inputs = self.results::<F>(&model.prepared.coefficients, &self.named(&["self.a", "self.b"]));
        inputs.extend(self.inputs(model, reads));
        self.results::<F>(program, &inputs)
    }

    /// What a program may read of the point.
    fn inputs(&self, model: &Model, reads: Reads) -> Named {
        let state = match reads {
            Reads::State | Reads::Point => model.dynamics.full.symbols(),
            Reads::Reduced => model.dynamics.reduced.symbols(),
            Reads::Trajectory => Vec::new(),
        };
        let fixed = if reads == Reads::Trajectory { model.dynamics.passage.fixed() } else { Vec::new() };
        let state: Vec<String> = state.iter().chain(&fixed).map(Symbol::to_string).collect();
        let mut names: Vec<&str> = state.iter().map(String::as_str).collect();
        names.push("t");
        match reads {
            Reads::State => {}
            Reads::Reduced => {
                let constants = self.run::<Number>(model, &model.dynamics.trajectory, Reads::Trajectory);
                return self.named(&names).into_iter().chain(constants).collect();
            }
            Reads::Point => names.extend(["q", "dilatation", "q_1", "q_2", "q_3"]),
            Reads::Trajectory => names.extend(["p_1", "p_2", "p_3"]),
        }
        self.named(&names)
    }

    /// Coordinates by name, as far as there are any.
    fn named(&self, names: &[&str]) -> Named {
        names.iter().filter_map(|name| Some(((*name).to_owned(), *self.known.get(*name)?))).collect()
    }

    fn results<F: Machine>(&self, program: &Program, inputs: &Named) -> Named {
        let called = self.called(program);
        let read = |symbol: &Symbol| {
            let name = symbol.to_string();
            let value = inputs.get(&name).or_else(|| called.get(&name)).copied();
            if value.is_none() {
                self.unknown.borrow_mut().insert(name);
            }
            Some(F::from_quad(value.unwrap_or(Quad::NAN)))
        };
        let results = program.run::<F>(&read).expect("a value");
        let names = program.results().map(Symbol::to_string);
        names.zip(results.iter().map(Machine::to_quad)).collect()
    }

    /// What the program asks the runtime for: stretches and principal axes.
    fn called(&self, program: &Program) -> Named {
        let Principal { stretches, stretched, axes } = &self.principal;
        let logarithms: Vec<Quad> = stretches.iter().map(|stretch| Scalar::ln(*stretch)).collect();
        let mut called = HashMap::new();
        for call in &program.calls {
            let logarithms = match call.callee {
                Callee::Stretches => Vec::new(),
                Callee::LogStretches => logarithms.clone(),
                other => panic!("{other:?} in a model of a potential"),
            };
            let values = [stretches.clone(), logarithms, stretched.concat(), axes.concat()].concat();
            // Of the placement itself.
            for operand in call.operands() {
                assert!(matches!(
                    &program.steps[operand],
                    Op::Input(Symbol::Component(Quantity::Placement, _))
                ));
            }
            let names =
                call.results.iter().flat_map(|group| group.entries().into_iter().map(Symbol::to_string));
            called.extend(names.zip(values));
        }
        called
    }
}
