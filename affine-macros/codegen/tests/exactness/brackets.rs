//! The table of brackets against the canonical bracket, from which all of it follows.

use affine_codegen::algebra::{Arena, Expr, Polynomial, Rational};
use affine_codegen::mechanics::brackets::{bracket, poisson};
use affine_codegen::mechanics::charts::{Chart, Coordinate, Linear, Momentum};

/// Every chart in which the brackets of coordinates are linear in coordinates.
const CHARTS: [(Momentum, Option<Linear>); 8] = [
    (Momentum::Canonical, None),
    (Momentum::Canonical, Some(Linear::Space)),
    (Momentum::Space, None),
    (Momentum::Space, Some(Linear::Space)),
    (Momentum::Body, None),
    (Momentum::Body, Some(Linear::Space)),
    (Momentum::Body, Some(Linear::Body)),
    (Momentum::Total, Some(Linear::Space)),
];

fn charts(n: usize) -> impl Iterator<Item = (Arena, Chart)> {
    CHARTS.into_iter().map(move |(momentum, linear)| {
        let mut arena = Arena::new();
        let chart = Chart::new(&mut arena, n, momentum, linear);
        (arena, chart)
    })
}

fn atom(chart: &Chart, coordinate: Coordinate) -> Polynomial {
    Polynomial::atom(chart.symbol(coordinate))
}

#[test]
fn the_canonical_chart() {
    for n in [2, 3] {
        let mut arena = Arena::new();
        let chart = Chart::new(&mut arena, n, Momentum::Canonical, Some(Linear::Space));
        for a in chart.coordinates() {
            for b in chart.coordinates() {
                let expected = match (a, b) {
                    (Coordinate::X(i), Coordinate::P(j)) if i == j => 1,
                    (Coordinate::P(i), Coordinate::X(j)) if i == j => -1,
                    // Pi[A][i] is conjugate to phi[i][A].
                    (Coordinate::Phi(i, a), Coordinate::M(b, j)) if (i, a) == (j, b) => 1,
                    (Coordinate::M(b, j), Coordinate::Phi(i, a)) if (i, a) == (j, b) => -1,
                    _ => 0,
                };
                assert_eq!(
                    bracket(&chart, a, b),
                    Polynomial::constant(Rational::from(expected)),
                    "{a:?} {b:?}"
                );
            }
        }
    }
}

#[test]
fn antisymmetry() {
    for n in [2, 3] {
        for (_, chart) in charts(n) {
            for a in chart.coordinates() {
                assert!(bracket(&chart, a, a).is_zero());
                for b in chart.coordinates() {
                    let mut sum = bracket(&chart, a, b);
                    sum.add_scaled(&bracket(&chart, b, a), &Rational::ONE);
                    assert!(sum.is_zero(), "{a:?} {b:?} in {:?}", chart.momentum);
                }
            }
        }
    }
}

/// `{{a, b}, c} + cyclic = 0` for all triples of coordinates.
#[test]
fn jacobi() {
    for n in [2, 3] {
        for (_, chart) in charts(n) {
            let all = chart.coordinates();
            for (i, a) in all.iter().enumerate() {
                for (j, b) in all.iter().enumerate().skip(i + 1) {
                    for c in &all[j + 1..] {
                        let mut sum = Polynomial::zero();
                        for (a, b, c) in [(a, b, c), (b, c, a), (c, a, b)] {
                            let inner = poisson(&chart, &bracket(&chart, *a, *b), &atom(&chart, *c));
                            sum.add_scaled(&inner, &Rational::ONE);
                        }
                        assert!(sum.is_zero(), "{a:?} {b:?} {c:?} in {:?}", chart.momentum);
                    }
                }
            }
        }
    }
}

/// Coordinates of any chart as functions on the canonical one.
pub(crate) struct Canonical {
    pub(crate) chart: Chart,
}

impl Canonical {
    pub(crate) fn new(arena: &mut Arena, n: usize) -> Self {
        Self { chart: Chart::new(arena, n, Momentum::Canonical, Some(Linear::Space)) }
    }

    fn sum(&self, factors: impl Fn(usize) -> [Expr; 2]) -> Polynomial {
        let mut sum = Polynomial::zero();
        (0..self.chart.dim).for_each(|k| sum.add_term(factors(k).to_vec(), &Rational::ONE));
        sum
    }

    /// `Sigma = phi Pi`.
    pub(crate) fn sigma(&self, i: usize, j: usize) -> Polynomial {
        self.sum(|a| [self.chart.phi.0[i][a], self.chart.m.0[a][j]])
    }

    /// `Sigma_hat = Pi phi`.
    pub(crate) fn sigma_hat(&self, a: usize, b: usize) -> Polynomial {
        self.sum(|i| [self.chart.m.0[a][i], self.chart.phi.0[i][b]])
    }

    fn function(&self, of: &Chart, coordinate: Coordinate) -> Polynomial {
        let c = &self.chart;
        match (coordinate, of.momentum) {
            (Coordinate::X(i), _) => Polynomial::atom(c.x[i]),
            (Coordinate::Phi(i, a), _) => Polynomial::atom(c.phi.0[i][a]),
            // p_hat = phi^T p
            (Coordinate::P(a), _) if of.linear == Some(Linear::Body) => self.sum(|i| [c.phi.0[i][a], c.p[i]]),
            (Coordinate::P(i), _) => Polynomial::atom(c.p[i]),
            (Coordinate::M(i, j), Momentum::Space) => self.sigma(i, j),
            (Coordinate::M(a, b), Momentum::Body) => self.sigma_hat(a, b),
            // I(O) = x p^T + Sigma
            (Coordinate::M(i, j), Momentum::Total) => {
                let mut total = self.sigma(i, j);
                total.add_term(vec![c.x[i], c.p[j]], &Rational::ONE);
                total
            }
            (Coordinate::M(a, i), Momentum::Canonical) => Polynomial::atom(c.m.0[a][i]),
            (Coordinate::Carried(_), _) => unreachable!("no coordinate of phase space"),
        }
    }

    /// A polynomial in the coordinates of a chart, pulled back.
    pub(crate) fn pulled_back(&self, of: &Chart, polynomial: &Polynomial) -> Polynomial {
        polynomial.substitute(&|symbol| {
            let coordinate = of.coordinates().into_iter().find(|z| of.symbol(*z) == symbol)?;
            Some(self.function(of, coordinate))
        })
    }
}

/// Every bracket of every chart is the canonical bracket of what the coordinates are.
#[test]
fn every_chart_follows_from_the_canonical_one() {
    for n in [2, 3] {
        for (mut arena, chart) in charts(n) {
            let canonical = Canonical::new(&mut arena, n);
            for a in chart.coordinates() {
                for b in chart.coordinates() {
                    let (f, g) = (canonical.function(&chart, a), canonical.function(&chart, b));
                    let expected = poisson(&canonical.chart, &f, &g);
                    let found = canonical.pulled_back(&chart, &bracket(&chart, a, b));
                    assert_eq!(found, expected, "{a:?} {b:?} in {:?} {:?}", chart.momentum, chart.linear);
                }
            }
        }
    }
}

/// `I(O) = x p^T + Sigma`: its brackets from the chart of `Sigma` are those of its own chart.
#[test]
fn total_momentum_from_the_spatial_chart() {
    for n in [2, 3] {
        let mut arena = Arena::new();
        let total = Chart::new(&mut arena, n, Momentum::Total, Some(Linear::Space));
        let space = Chart::new(&mut arena, n, Momentum::Space, Some(Linear::Space));
        let image = |symbol: Expr| {
            let (i, j) = (0..n)
                .flat_map(|i| (0..n).map(move |j| (i, j)))
                .find(|(i, j)| total.m.0[*i][*j] == symbol)?;
            let mut sum = Polynomial::atom(space.m.0[i][j]);
            sum.add_term(vec![space.x[i], space.p[j]], &Rational::ONE);
            Some(sum)
        };
        for a in total.coordinates() {
            for b in total.coordinates() {
                let expected = bracket(&total, a, b).substitute(&image);
                let [f, g] = [a, b].map(|z| atom(&total, z).substitute(&image));
                assert_eq!(poisson(&space, &f, &g), expected, "{a:?} {b:?}");
            }
        }
    }
}
