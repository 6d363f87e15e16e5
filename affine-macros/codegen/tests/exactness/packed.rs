use affine_codegen::ir::packed::Packed;

use super::models::derived;

#[test]
fn show() {
    for (name, args) in [
        (
            "P2",
            "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1), potential = hyperbolic_dilatation(10) + neo_hookean(0.5)",
        ),
        (
            "P2r",
            "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, space_inertia = 1), potential = hyperbolic_dilatation(10) + neo_hookean(0.5)",
        ),
        (
            "P1",
            "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1)",
        ),
        (
            "P3",
            "dim = 3, kinetic(dalembert = diag(1, 1.5, 2)), potential = hyperbolic_dilatation(10) + neo_hookean(0.5)",
        ),
        (
            "P7",
            "dim = 3, kinetic(casimir2 = 0.2, casimir1_squared = 0.1, body_inertia = 1, body_translation = 1), potential = hyperbolic_dilatation(10000) + neo_hookean(0.5)",
        ),
    ] {
        let t = std::time::Instant::now();
        let model = derived(args, "struct Body;");
        let d = t.elapsed();
        let t = std::time::Instant::now();
        let packed = Packed::cheapest(&model.reduced.program, &model.reduced.groups).unwrap();
        println!(
            "{name}: derived {d:?} packed {:?} cost {} vectors {} state {:?}",
            t.elapsed(),
            packed.cost(),
            packed.state.len(),
            packed.state
        );
        println!("{}", Packed::of(&model.reduced.program, &model.reduced.groups).is_some());
        let names = |v: usize| match &packed.program.steps[v] {
            affine_codegen::ir::Op::Input(n) => n.clone(),
            op => packed
                .program
                .names
                .iter()
                .chain(packed.program.outputs.iter().map(|(n, v)| (*v, n.clone())).collect::<Vec<_>>().iter())
                .find(|(x, _)| *x == v)
                .map_or(format!("{op:?}"), |(_, n)| n.clone()),
        };
        for step in &packed.steps {
            match step {
                affine_codegen::ir::packed::Step::Scalar(v) => println!("  scalar {}", names(*v)),
                affine_codegen::ir::packed::Step::Vector(i) => {
                    let v = packed.vectors[*i];
                    println!("  {i}: {:?} {:?}", v.made, v.lanes.map(|l| l.value().map(names)))
                }
            }
        }
    }
}
