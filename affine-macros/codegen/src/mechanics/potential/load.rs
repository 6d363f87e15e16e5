//! The forces of a potential in every chart.

use crate::algebra::ring::{Square, adjugate, table};
use crate::algebra::{Arena, Expr, Function, Matrix, Polynomial, Rational};
use crate::mechanics::charts::{Chart, Coordinate, Linear, Momentum};
use crate::mechanics::equations::Load;

use super::base::Base;
use super::excess::{self, through_excess};
use super::principal::{self, Principal};
use super::rewriting::through_dilatation;
use super::scaled::{self, scaled_bases};
use super::second::{self, through_second_invariant};
use super::sums::Sums;
use super::tensors::{Along, Tensors, cofactors, definitions, direction, placement};
use super::{Potential, is_parameter};

impl Potential {
    /// What it adds to Hamilton's equations of a chart.
    pub fn load(&self, arena: &mut Arena, chart: &Chart) -> Load {
        let mut load = Load::default();
        if self.has_single_stretches() {
            let (kernel, shared) = principal::computed(arena, chart);
            load.kernels.push(kernel);
            load.shared.extend(shared);
        }
        let mut tensors = self.tensors(arena, chart);
        let steep = chart.confined.is_none() && self.is_steep(arena);
        if steep {
            tensors = self.unit_tensors(arena);
        }
        let along = match chart.momentum {
            Momentum::Body => Along::Body,
            Momentum::Space | Momentum::Total => Along::Space,
            Momentum::Canonical => Along::Placement,
        };
        let weighted = self.weighted(arena, chart, (along, steep), &mut load);
        load.shared.extend(definitions(arena, self.dim, chart));
        if steep {
            let inverse = arena.symbol("inverse_dilatation");
            load.shared.extend(scaled::definitions(arena, chart, inverse));
        }
        load.shared.extend(cofactors(arena, chart));
        load.shared.extend(self.dilatation(arena, chart));
        let mut forces = table(self.dim, |a, b| {
            let mut force = Polynomial::zero();
            for (base, slope) in &weighted {
                let entry = match along {
                    Along::Placement => direction(*base, along, &tensors, b, a),
                    _ => direction(*base, along, &tensors, a, b),
                };
                force.add_product(slope, &entry, &Rational::ONE);
                if let (Momentum::Total, Base::Position(j)) = (chart.momentum, base)
                    && *j == b
                {
                    force.add_product(slope, &Polynomial::atom(chart.x[a]), &Rational::ONE);
                }
            }
            force
        });
        if let Some(group) = chart.confined {
            forces = group.projected(&forces);
        }
        for (a, row) in forces.into_iter().enumerate() {
            load.forces.extend(row.into_iter().enumerate().map(|(b, force)| (Coordinate::M(a, b), force)));
        }
        for i in 0..chart.p.len() {
            load.forces.push((Coordinate::P(i), force_on_centre(chart, &weighted, i)));
        }
        load
    }

    /// The slopes with the numbers that they carry in a force, named where they move.
    fn weighted(
        &self,
        arena: &mut Arena,
        chart: &Chart,
        (along, steep): (Along, bool),
        load: &mut Load,
    ) -> Vec<(Base, Polynomial)> {
        let mut weighted: Vec<(Base, Polynomial)> = Vec::new();
        // The slopes by the sums: where all of the force vanishes with one, its digits are those of the force.
        let (mut sums, mut forms) = (Sums::default(), Vec::new());
        for (base, slope) in &self.slopes {
            let form = through_dilatation(arena, *slope);
            let form = match steep {
                true => self.of_unit(arena, form, base.degree() - i32::from(base.is_moved(along))),
                false => form,
            };
            let form = sums.named(arena, form);
            let form = normal_form(arena, form, (chart, steep), load);
            forms.push(form.clone());
            let form = form.scaled(&base.weight(self.dim));
            let form = match (base, along) {
                (Base::LogStretch(_), Along::Body) => form,
                (Base::LogStretch(k), _) => form.mul(&principal::inverse_square(arena, *k)),
                _ => form,
            };
            // A slope in parameters alone is a coefficient, not a quantity of the motion.
            let moves = form.any_symbol(arena, &mut |s| !is_parameter(arena, s));
            let symbol = arena.symbol(&base.slope_name());
            let mut slope = if moves { Polynomial::atom(symbol) } else { form.clone() };
            if moves {
                load.shared.push((symbol, form));
            }
            // dq/dphi = cof/(n det): the factor that all entries share.
            if (*base, chart.momentum) == (Base::MeanLogStretch, Momentum::Canonical) {
                let swelling = arena.symbol("swelling");
                load.shared.push((swelling, slope.mul(&Polynomial::atom(arena.symbol("inverse_det")))));
                slope = Polynomial::atom(swelling);
            }
            weighted.push((*base, slope));
        }
        for (symbol, sum) in sums.known() {
            let mut form = normal_form(arena, *sum, (chart, steep), load);
            let is_factor = |form: &Polynomial| form.terms().all(|(monomial, _)| monomial.contains(symbol));
            if steep
                && forms.iter().all(is_factor)
                && let Some(counted) = through_excess(arena, self.dim, &form)
            {
                form = counted;
                share(load, excess::definitions(arena, self.dim));
            }
            load.shared.push((*symbol, form));
        }
        weighted
    }

    /// Do tensors in the forces have powers of `D` beyond the third beside them? The product may be of degree 0, and `D^4`
    /// leaves the range of numbers where `phi` does not.
    fn is_steep(&self, arena: &mut Arena) -> bool {
        self.slopes.iter().any(|(base, slope)| {
            let form = through_dilatation(arena, *slope);
            let form = Polynomial::normal_form(arena, form);
            // By name: a symbol that is not needed would come into being.
            let named = |atom: Expr, name: &str| arena.name(atom) == Some(name);
            let power =
                |monomial: &[Expr], name: &str| monomial.iter().filter(|atom| named(**atom, name)).count();
            let is_tensor = |name: &str| {
                ["trace_", "green_", "finger_", "phi_"].iter().any(|stem| name.starts_with(stem))
            };
            let of_tensors = |monomial: &[Expr]| {
                let mut found = |symbol: Expr| arena.name(symbol).is_some_and(is_tensor);
                base.degree() > 0 || monomial.iter().any(|atom| arena.any_symbol(*atom, &mut found))
            };
            let is_steep = |monomial: &[Expr]| {
                ["dilatation", "inverse_dilatation"].iter().any(|name| power(monomial, name) > 2)
            };
            form.terms().any(|(monomial, _)| is_steep(monomial) && of_tensors(monomial))
        })
    }

    /// `D^degree` times an expression in `D`, `1/D` and base functions, through `Psi`.
    fn of_unit(&self, arena: &mut Arena, form: Expr, degree: i32) -> Expr {
        let [d, inverse_d] = ["dilatation", "inverse_dilatation"].map(|name| arena.symbol(name));
        let reciprocal = arena.pow(d, -1).unwrap_or(d);
        let mut values = scaled_bases(arena, self.dim, d);
        values.push((inverse_d, reciprocal));
        let value = |symbol: Expr| values.iter().find(|(known, _)| *known == symbol).map(|(_, value)| *value);
        // Powers of D are not zero.
        let form = arena.substitute(form, &value).unwrap_or(form);
        arena.product(&[(form, 1), (d, degree)]).unwrap_or(form)
    }

    /// The tensors of `Psi`.
    fn unit_tensors(&self, arena: &mut Arena) -> Tensors<Polynomial> {
        let n = self.dim;
        let mut symbols = |base: fn(usize, usize) -> Base| -> Square<Polynomial> {
            (0..n).map(|a| (0..n).map(|b| Polynomial::atom(base(a, b).unit(arena))).collect()).collect()
        };
        let (green, finger, phi) = (symbols(Base::Green), symbols(Base::Finger), symbols(Base::Placement));
        let cofactors = Matrix::symbols(arena, "cofactor", n).0;
        let cofactors =
            cofactors.iter().map(|row| row.iter().copied().map(Polynomial::atom).collect()).collect();
        Tensors { phi, green, finger, cofactors, principal: Principal::new(arena, n) }
    }

    fn tensors(&self, arena: &mut Arena, chart: &Chart) -> Tensors<Polynomial> {
        let n = self.dim;
        let mut symbols = |base: fn(usize, usize) -> Base| -> Square<Polynomial> {
            (0..n).map(|a| (0..n).map(|b| Polynomial::atom(base(a, b).symbol(arena))).collect()).collect()
        };
        let (green, finger) = (symbols(Base::Green), symbols(Base::Finger));
        let phi = placement(chart);
        let cofactors = Matrix::symbols(arena, "cofactor", n).0;
        let cofactors =
            cofactors.iter().map(|row| row.iter().copied().map(Polynomial::atom).collect()).collect();
        Tensors { phi, green, finger, cofactors, principal: Principal::new(arena, n) }
    }

    /// `det`, `D = det^(1/n)`, `1/D`, `1/det`, `q`, with one root.
    fn dilatation(&self, arena: &mut Arena, chart: &Chart) -> Vec<(Expr, Polynomial)> {
        let n = self.dim;
        let [det, inverse_det, d, inverse_d, q] =
            ["det", "inverse_det", "dilatation", "inverse_dilatation", "q"].map(|name| arena.symbol(name));
        let root = arena.apply(if n == 2 { Function::Sqrt } else { Function::Cbrt }, det);
        let logarithm = arena.apply(Function::Ln, det);
        let nth = i64::try_from(n).ok().and_then(|n| Rational::ratio(1, n)).unwrap_or(Rational::ONE);
        // Symbols and functions of symbols are not the number zero.
        let reciprocal = |arena: &mut Arena, of: Expr| Polynomial::atom(arena.pow(of, -1).unwrap_or(of));
        let uses_root = self.slopes.iter().any(|(_, slope)| {
            let form = through_dilatation(arena, *slope);
            arena.any_symbol(form, &mut |s| s == d || s == inverse_d)
        });
        let inverse = match uses_root {
            true => Polynomial::term(vec![inverse_d; n], Rational::ONE),
            false => reciprocal(arena, det),
        };
        // The forces on Pi contain the cofactors themselves; elsewhere the determinant alone is needed.
        let first_row: Vec<Polynomial> = match chart.momentum {
            Momentum::Canonical => {
                let cofactors = Matrix::symbols(arena, "cofactor", n);
                cofactors.0[0].iter().map(|cofactor| Polynomial::atom(*cofactor)).collect()
            }
            _ => adjugate(&placement(chart)).iter().map(|row| row[0].clone()).collect(),
        };
        let mut determinant = Polynomial::zero();
        for (entry, cofactor) in chart.phi.0[0].iter().zip(first_row) {
            determinant.add_product(&Polynomial::atom(*entry), &cofactor, &Rational::ONE);
        }
        let mut product = vec![inverse_d; n - 1];
        product.push(det);
        vec![
            (det, determinant),
            (inverse_d, reciprocal(arena, root)),
            (d, Polynomial::term(product, Rational::ONE)),
            (inverse_det, inverse),
            (q, Polynomial::term(vec![logarithm], nth)),
        ]
    }
}

/// Shares quantities that are not shared yet.
fn share(load: &mut Load, definitions: Vec<(Expr, Polynomial)>) {
    for (symbol, definition) in definitions {
        if load.shared.iter().all(|(known, _)| *known != symbol) {
            load.shared.push((symbol, definition));
        }
    }
}

/// The normal form of a part of a slope: with `1/D` as an atom, and without products of `D` and `1/D` where it is steep; elsewhere
/// through the second invariant, which it shares.
fn normal_form(arena: &mut Arena, form: Expr, (chart, steep): (&Chart, bool), load: &mut Load) -> Polynomial {
    if !steep {
        let form = Polynomial::normal_form(arena, form);
        let Some(shorter) = through_second_invariant(arena, &form) else { return form };
        share(load, vec![second::definition(arena, chart)]);
        return shorter;
    }
    let [d, inverse_d] = ["dilatation", "inverse_dilatation"].map(|name| arena.symbol(name));
    let reciprocal = arena.pow(d, -1).unwrap_or(d);
    let named = |atom: Expr| (atom == reciprocal).then(|| Polynomial::atom(inverse_d));
    scaled::collected(arena, form, d).substitute(&named)
}

/// `Q_tr`, or `phi^T Q_tr` beside `p_hat`; the slopes carry the sign.
fn force_on_centre(chart: &Chart, weighted: &[(Base, Polynomial)], i: usize) -> Polynomial {
    let mut force = Polynomial::zero();
    for (base, slope) in weighted {
        match (base, chart.linear) {
            (Base::Position(j), Some(Linear::Body)) => {
                force.add_product(slope, &Polynomial::atom(chart.phi.0[*j][i]), &Rational::ONE);
            }
            (Base::Position(j), _) if *j == i => force.add_scaled(slope, &Rational::ONE),
            _ => {}
        }
    }
    force
}
