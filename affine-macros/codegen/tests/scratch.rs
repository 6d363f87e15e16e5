#![allow(clippy::unwrap_used, missing_docs)]
use affine_codegen::algebra::bind::Constants;
use affine_codegen::algebra::*;
use affine_codegen::mechanics::{
    charts::*, conserved, equations::*, hamiltonian::*, hessian::*, kinetic::*, reduce,
};
use affine_codegen::optimise::*;

fn q(t: &str) -> Rational {
    Rational::parse_decimal(t).unwrap()
}

fn run(name: &str, dim: usize, terms: &[(TermKind, &str)]) {
    let start = std::time::Instant::now();
    let mut arena = Arena::new();
    let terms: Vec<Term> = terms
        .iter()
        .map(|(k, v)| Term {
            kind: *k,
            value: Coefficient::Scalar(match Rational::parse_decimal(v) {
                Some(x) => arena.constant(x),
                None => arena.symbol(v),
            }),
        })
        .collect();
    let kinetic = Kinetic::new(&mut arena, dim, &terms).unwrap();
    let hessian = Hessian::new(&mut arena, &kinetic);
    let h = Hamiltonian::new(&mut arena, &kinetic, &hessian).unwrap();
    let t1 = start.elapsed();
    println!("== {name}: {} blocks, iso {:?}", hessian.blocks.len(), h.isotropic.is_some());
    for r in reduce::candidates(&mut arena, &h) {
        let mut constants = Constants::new("k");
        let states: Vec<Expr> = r.states.iter().flat_map(|(_, s)| s.clone()).collect();
        let batch = Batch {
            shared: r.system.shared.clone(),
            results: r
                .system
                .rates
                .iter()
                .map(|(_, s, p)| (arena.name(*s).unwrap().to_owned(), p.clone()))
                .collect(),
        };
        let program = straight_line(&mut arena, &batch, &mut constants, &|a| states.contains(&a));
        println!(
            "{:?} {:?} turned {} states {:?} constants {} ops {:?}",
            r.chart.momentum,
            r.layout,
            r.turned,
            r.states.iter().map(|(n, s)| (n, s.len())).collect::<Vec<_>>(),
            constants.entries.len(),
            program.operations()
        );
    }
    let t2 = start.elapsed();
    let own = reduce::own_chart(&mut arena, &h);
    let full = reduce::own_hamiltonian(&h, &own);
    println!("conserved {:?}", conserved::conserved(&mut arena, &own, &full));
    let t3 = start.elapsed();
    // full
    let linear = h
        .translation
        .as_ref()
        .map(|(f, _)| if *f == Frame::Body && h.frame == Frame::Body { Linear::Body } else { Linear::Space });
    let chart = Chart::new(&mut arena, dim, Momentum::of(h.frame), linear);
    let mut hh = h.internal();
    hh.add_scaled(&h.translation_in(&chart), &Rational::ONE);
    for form in [Form::Expanded, Form::ThroughVelocity] {
        for adapted in [false, true] {
            let system = hamilton(&mut arena, &chart, &hh, form);
            let mut shared = system.shared.clone();
            let mut system = system;
            if adapted {
                let splits = reduce::split_symmetric(&mut arena, &chart);
                system = system.substitute(&|a| {
                    splits.iter().find_map(|s| {
                        if s.upper == a {
                            Some(s.value(1))
                        } else if s.lower == a {
                            Some(s.value(-1))
                        } else {
                            None
                        }
                    })
                });
                shared = system.shared.clone();
                for s in &splits {
                    let half = Rational::ratio(1, 2).unwrap();
                    let mut p = Polynomial::term(vec![s.upper], half.clone());
                    p.add_term(vec![s.lower], &half);
                    shared.push((s.symmetric, p));
                    let mut p = Polynomial::atom(s.upper);
                    p.add_term(vec![s.lower], &Rational::MINUS_ONE);
                    shared.push((s.skew, p));
                }
            }
            let states: Vec<Expr> = chart.coordinates().iter().map(|c| chart.symbol(*c)).collect();
            let batch = Batch {
                shared,
                results: system
                    .rates
                    .iter()
                    .map(|(_, s, p)| (arena.name(*s).unwrap().to_owned(), p.clone()))
                    .collect(),
            };
            let mut constants = Constants::new("c");
            let program = straight_line(&mut arena, &batch, &mut constants, &|a| states.contains(&a));
            println!(
                "full {form:?} adapted {adapted} ops {:?} = {}",
                program.operations(),
                program.operations().weight()
            );
        }
    }
    println!("times {t1:?} {t2:?} {t3:?} {:?}", start.elapsed());
}

#[test]
fn p1() {
    use TermKind::*;
    for n in [2, 3] {
        run(
            "L+T",
            n,
            &[(Casimir2, "0.2"), (Casimir1Squared, "0.1"), (BodyInertia, "1"), (BodyTranslation, "1")],
        );
        run(
            "L+T fields",
            n,
            &[(Casimir2, "a"), (Casimir1Squared, "b"), (BodyInertia, "i"), (BodyTranslation, "m")],
        );
        run("R", n, &[(Casimir2, "0.2"), (Casimir1Squared, "0.1"), (SpaceInertia, "1")]);
        run(
            "R+Tbody",
            n,
            &[(Casimir2, "0.2"), (Casimir1Squared, "0.1"), (SpaceInertia, "1"), (BodyTranslation, "1")],
        );
        run("AA+Tspace", n, &[(Casimir2, "0.2"), (Casimir1Squared, "0.1"), (SpaceTranslation, "1")]);
        run("dA+T", n, &[(Dalembert, "1"), (SpaceTranslation, "1")]);
        run("dA+Tb", n, &[(Dalembert, "1"), (BodyTranslation, "1")]);
    }
}
