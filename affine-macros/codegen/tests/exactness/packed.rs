use super::models::derived;
use affine_codegen::ir::packed::Packed;
#[test]
fn show() {
    let t = std::fs::read_to_string("/work/wt/columns/tests/snapshots.rs").unwrap();
    let flat = t.replace("\\\n", "");
    for line in flat.lines() {
        let Some((name, rest)) = line.trim().split_once(": \"") else { continue };
        let Some((args, _)) = rest.split_once('"') else { continue };
        if !name.ends_with("_3")
            || args.contains("constraint")
            || args.contains("group")
            || name.contains("custom")
            || name.contains("field")
        {
            continue;
        }
        let args: String = args.split_whitespace().collect::<Vec<_>>().join(" ");
        let args: &'static str = Box::leak(args.into_boxed_str());
        let Ok((model, d)) = std::panic::catch_unwind(|| {
            let t = std::time::Instant::now();
            (derived(args, "struct Body;"), t.elapsed())
        }) else {
            continue;
        };
        let t = std::time::Instant::now();
        let p = Packed::cheapest(&model.reduced.program, &model.reduced.groups);
        println!(
            "{name}: steps {} derived {d:?} packed {:?} cost {:?} {}",
            model.reduced.program.steps.len(),
            t.elapsed(),
            p.map(|p| p.1),
            Packed::of(&model.reduced.program, &model.reduced.groups).is_some()
        );
    }
}
