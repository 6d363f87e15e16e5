use affine_codegen::ir::packed::Packed;

use super::models::derived;

#[test]
fn show() {
    for (name, args) in [(
        "f",
        "dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = (G[1,1] - 1)^2 + Ct[1,2]^2 + q^2/2",
    )] {
        let model = derived(args, "struct Body;");
        let packed = Packed::cheapest(&model.reduced.program, &model.reduced.groups).unwrap();
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
        println!("{name} {:?}", packed.state);
        for step in &packed.steps {
            match step {
                affine_codegen::ir::packed::Step::Scalar(v) => println!("  scalar {v} {}", names(*v)),
                affine_codegen::ir::packed::Step::Vector(i) => {
                    let v = packed.vectors[*i];
                    println!("  {i}: {:?} {:?} {:?}", v.made, v.lanes, v.lanes.map(|l| l.value().map(names)))
                }
            }
        }
        println!("{:?}", packed.in_lanes);
    }
}
