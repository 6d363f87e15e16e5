//! Quantities that are emitted when asked for.

use crate::algebra::bind::Constants;
use crate::algebra::ring::{Square, multiple, pairs, product, scalar, table, transpose};
use crate::algebra::substitute::listed;
use crate::algebra::{Arena, Expr, Matrix, Polynomial, Rational};
use crate::ir::Program;
use crate::mechanics::balance::{CENTRE, INTERNAL, Laws};
use crate::mechanics::body::Body;
use crate::mechanics::charts::{Chart, Coordinate, Momentum};
use crate::mechanics::equations::System;
use crate::mechanics::hamiltonian::Hamiltonian;
use crate::mechanics::kinetic::Kinetic;
use crate::mechanics::metric::{Definitions, share};
use crate::mechanics::mixed::{self, Factorisation};
use crate::mechanics::motion::Motion;
use crate::mechanics::term::Frame;
use crate::optimise::Batch;
use crate::symbol::{Asked, Aspect, Capability, Factorised, Quantity, Symbol};

use super::batch::{self, numbered, program};

/// Quantities that are emitted where they are asked for.
pub struct Quantities {
    /// The configuration metric, where asked for.
    pub metric: Option<Metric>,
    /// Point -> acceleration of the centre of mass, where asked for.
    pub acceleration: Option<Program>,
    /// The balance laws, where asked for.
    pub balance: Option<Balance>,
}

/// The configuration metric over `(x_dot, phi_dot)`.
pub struct Metric {
    /// Number of rows.
    pub size: usize,
    /// `phi ->` entries, row after row.
    pub entries: Program,
    /// `phi ->` entries of the inverse, row after row.
    pub inverse: Program,
}

/// The balance laws of a d'Alembert model.
pub struct Balance {
    /// Quantities of the internal motion, matrices.
    pub internal: BalancedQuantities,
    /// Quantities of the centre of mass, vectors, where it moves.
    pub centre: Option<BalancedQuantities>,
}

/// The two sides of balance laws.
pub struct BalancedQuantities {
    /// Each quantity with the frame of its components.
    pub quantities: Vec<(Quantity, Frame)>,
    /// Point -> their entries, one quantity after the other.
    pub program: Program,
}

impl Body<'_> {
    /// What is asked for, its programs reading the coordinates of a chart.
    pub(super) fn quantities(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        asked: Asked,
        coefficients: &mut Constants,
    ) -> Option<Quantities> {
        let metric = match asked.has(Capability::Metric) {
            true => Some(metric(arena, self.motion, coefficients)?),
            false => None,
        };
        let inputs = self.inputs(arena, chart);
        let acceleration = match asked.has(Capability::Acceleration) {
            true => {
                let (system, _) = self.systems(arena, chart, self.potential)?.swap_remove(0);
                Some(acceleration(arena, &system, &inputs, coefficients))
            }
            false => None,
        };
        let balance = match asked.has(Capability::Balance) {
            true => {
                let (kinetics, _) = self.motion.kinetics(arena, chart).into_iter().next()?;
                let (mut added, count) =
                    (self.loads(arena, chart, self.potential)?, self.motion.added(arena, chart)?.len());
                // What the centre of mass adds to the kinetic energy comes first.
                let acting = added.split_off(count);
                let own =
                    self.motion.hamiltonian().filter(|_| self.motion.internal().all(Kinetic::is_dalembert));
                let laws = Laws::new(arena, chart, (&kinetics, &added, own), &acting);
                Some(balance(arena, &laws, &inputs, coefficients))
            }
            false => None,
        };
        Some(Quantities { metric, acceleration, balance })
    }
}

/// The mass matrix over `(x_dot, phi_dot)` of a motion, and its inverse.
fn metric(arena: &mut Arena, motion: &Motion, coefficients: &mut Constants) -> Option<Metric> {
    let dim = motion.dim();
    let mixed::Metric { mut shared, mut internal, centre } = mixed::Metric::new(arena, dim, &motion.parts);
    if let Some(weight) = motion.polynomial().and_then(|(_, h)| h.weight.as_ref()) {
        let square = Polynomial::atom(weight.square);
        internal.iter_mut().flatten().for_each(|entry| *entry = entry.mul(&square));
        shared.extend(weight.definitions.iter().cloned());
    }
    let entries = joined(&centre, &internal);
    let inverse = inverse(arena, motion, (&shared, &centre, &internal))?;
    let (size, results) = (entries.len(), of_matrix(&entries));
    let entries = Batch { shared, results, ..Batch::default() }.pruned(arena);
    let phi = Matrix::symbols(arena, Quantity::Placement, dim).0.concat();
    let mut program = |batch: &Batch| program(arena, batch, coefficients, &phi);
    let entries = program(&entries);
    Some(Metric { size, entries, inverse: program(&inverse) })
}

/// Centre of mass and internal motion side by side.
fn joined(centre: &Square<Polynomial>, internal: &Square<Polynomial>) -> Square<Polynomial> {
    let (moving, size) = (centre.len(), centre.len() + internal.len());
    let mut entries = vec![vec![Polynomial::zero(); size]; size];
    for (offset, block) in [(0, centre), (moving, internal)] {
        for (i, row) in block.iter().enumerate() {
            entries[offset + i][offset..offset + row.len()].clone_from_slice(row);
        }
    }
    entries
}

/// The inverse of the mass matrix, in blocks: of the centre of mass and of the internal motion.
fn inverse(
    arena: &mut Arena,
    motion: &Motion,
    (shared, centre, internal): (&Definitions, &Square<Polynomial>, &Square<Polynomial>),
) -> Option<Batch> {
    let chart = Chart::new(arena, motion.dim(), Momentum::Canonical, None);
    let mut defined = Definitions::new();
    let of_centre = match motion.masses.single() {
        Some(mass) => {
            let inverse_mass = Polynomial::reciprocal(arena, mass)?;
            of_one_mass(&chart, motion.masses.frame(), &inverse_mass)
        }
        None if centre.is_empty() => Vec::new(),
        None => {
            defined.clone_from(shared);
            columns(arena, (Factorised::Centre, centre, 1), &mut defined, &chart)?
        }
    };
    let first = centre.len() + 1;
    let (definitions, of_internal) = match (motion.polynomial(), motion.factorised()) {
        (Some((_, h)), _) => (h.weight_definitions(), slopes(&chart, h)),
        (None, Some(internal)) if motion.constraint().is_some() => {
            internal.inverse_on_the_group(arena, first)
        }
        (None, _) => {
            let mut shared = shared.clone();
            let matrix = columns(arena, (Factorised::Internal, internal, first), &mut shared, &chart)?;
            (shared, matrix)
        }
    };
    share(&mut defined, definitions);
    let results = of_matrix(&joined(&of_centre, &of_internal));
    Some(Batch { shared: defined, results, ..Batch::default() }.pruned(arena))
}

/// That of the internal motion from the inverse Legendre transformation in the energy's own frame, `d(phi_dot)_iA/dPi_Bj`:
/// with `phi_dot = phi Oh`, `Sigma_hat = Pi phi` or `phi_dot = Om phi`, `Sigma = phi Pi` a polynomial in `phi`.
fn slopes(chart: &Chart, h: &Hamiltonian) -> Square<Polynomial> {
    let (n, phi, own) = (h.dim, &chart.phi.0, h.slopes());
    let own = |[i, a]: [usize; 2], [j, b]: [usize; 2]| &own[n * i + a][n * j + b];
    table(n * n, |row, column| {
        let ([i, a], [j, b]) = ([row / n, row % n], [column / n, column % n]);
        let through = |slope: &Polynomial, factors| slope.mul(&Polynomial::monomial(factors));
        match h.frame {
            Frame::Flat => own([i, a], [j, b]).clone(),
            Frame::Body => pairs(n).map(|(c, d)| through(own([c, a], [d, b]), [phi[i][c], phi[j][d]])).sum(),
            Frame::Space => pairs(n).map(|(k, l)| through(own([i, k], [j, l]), [phi[k][a], phi[l][b]])).sum(),
        }
    })
}

/// That of a centre of mass with one mass: `1/m`, or `phi phi^T/m` where the body carries it.
fn of_one_mass(chart: &Chart, frame: Option<Frame>, inverse_mass: &Polynomial) -> Square<Polynomial> {
    let phi = chart.placement();
    let form = match frame {
        Some(Frame::Body) => product(&phi, &transpose(&phi)),
        _ => scalar(chart.dim, &Polynomial::constant(Rational::ONE)),
    };
    multiple(&form, inverse_mass)
}

/// The columns of the inverse of a matrix that depends on the placement, numbered from `first` on: the solutions for unit
/// momenta.
fn columns(
    arena: &mut Arena,
    (of, matrix, first): (Factorised, &Square<Polynomial>, usize),
    shared: &mut Definitions,
    chart: &Chart,
) -> Option<Square<Polynomial>> {
    let size = matrix.len();
    let factorisation = Factorisation::new(arena, of, matrix, shared, chart)?;
    let column = |unit: usize| {
        let mut momenta = vec![Polynomial::zero(); size];
        momenta[unit] = Polynomial::constant(Rational::ONE);
        Polynomial::vector(&factorisation.column(arena, first + unit, &momenta, shared))
    };
    Some((0..size).map(column).collect())
}

fn of_matrix(entries: &[Vec<Polynomial>]) -> Vec<(Symbol, Polynomial)> {
    let named = |(i, j): (usize, usize)| (Quantity::MatrixEntry.at([i + 1, j + 1]), entries[i][j].clone());
    pairs(entries.len()).map(named).collect()
}

/// `x'' = sum over z of dx'/dz z'`, by the chain rule through every quantity on the way to `x'`.
fn acceleration(
    arena: &mut Arena,
    system: &System,
    inputs: &[Expr],
    coefficients: &mut Constants,
) -> Program {
    let mut flow = Flow { system, slopes: Vec::new(), definitions: Definitions::new() };
    let velocities = system.rates.iter().filter(|(z, _, _)| matches!(z, Coordinate::X(_)));
    let accelerations = velocities.map(|(_, _, rate)| flow.along(arena, rate));
    let results = numbered(Quantity::Acceleration, accelerations).collect();
    let shared = system.shared.iter().cloned().chain(flow.definitions).collect();
    let batch = Batch { shared, results, kernels: system.kernels.clone() }.pruned(arena);
    program(arena, &batch, coefficients, inputs)
}

/// The quantities of the balance laws, entry after entry.
fn balance(arena: &mut Arena, laws: &Laws, inputs: &[Expr], coefficients: &mut Constants) -> Balance {
    let mut program = |results: Vec<(Symbol, Polynomial)>| {
        let (shared, kernels) = (laws.shared.clone(), laws.kernels.clone());
        let batch = Batch { shared, kernels, results }.pruned(arena);
        batch::program(arena, &batch, coefficients, inputs)
    };
    let internal = INTERNAL.iter().zip(&laws.internal);
    let internal = internal.flat_map(|((of, _), matrix)| numbered(*of, matrix.concat())).collect();
    let centre = CENTRE.iter().zip(&laws.centre);
    let centre: Vec<_> = centre.flat_map(|((of, _), vector)| numbered(*of, vector.clone())).collect();
    let mut balanced = |quantities: &[(Quantity, Frame)], results| BalancedQuantities {
        quantities: quantities.to_vec(),
        program: program(results),
    };
    Balance {
        internal: balanced(&INTERNAL, internal),
        centre: (!centre.is_empty()).then(|| balanced(&CENTRE, centre)),
    }
}

/// Derivatives along the flow of a system.
struct Flow<'a> {
    system: &'a System,
    /// Quantities and coordinates whose derivative has been formed.
    slopes: Vec<(Expr, Polynomial)>,
    definitions: Definitions,
}

impl Flow<'_> {
    /// The derivative of a polynomial in coordinates and shared quantities.
    fn along(&mut self, arena: &mut Arena, polynomial: &Polynomial) -> Polynomial {
        let mut symbols = Vec::new();
        polynomial.any_symbol(arena, &mut |symbol| {
            if !symbols.contains(&symbol) {
                symbols.push(symbol);
            }
            false
        });
        let whole = polynomial.expression(arena);
        let mut sum = Polynomial::zero();
        for symbol in symbols {
            let slope = self.slope(arena, symbol);
            if slope.is_zero() {
                continue;
            }
            let outer = arena.derivative(whole, symbol);
            sum.add_product(&Polynomial::normal_form(arena, outer), &slope, &Rational::ONE);
        }
        sum
    }

    /// The derivative of a symbol: a rate of the system, that of a definition, or zero for a parameter.
    fn slope(&mut self, arena: &mut Arena, symbol: Expr) -> Polynomial {
        if let Some(known) = listed(&self.slopes)(symbol) {
            return known;
        }
        let rate = self.system.rates.iter().find(|(_, s, _)| *s == symbol).map(|(_, _, rate)| rate.clone());
        let definition = listed(&self.system.shared)(symbol);
        let value = match (rate, definition) {
            (Some(rate), _) => rate,
            (None, Some(definition)) => self.along(arena, &definition),
            (None, None) => Polynomial::zero(),
        };
        let slope = if value.terms().len() > 1 {
            let rate = arena.about(Aspect::Rate, symbol);
            self.definitions.push((rate, value));
            Polynomial::atom(rate)
        } else {
            value
        };
        self.slopes.push((symbol, slope.clone()));
        slope
    }
}
