//! What a run was made with, and a program that makes it again.

use crate::integrate::FusedArithmetic;
use crate::simulate::{Method, Trajectory};
use crate::state::Phase;

/// Names of fields with their numbers: one, or those of a square matrix row by row.
type Values = [(&'static str, Vec<f64>)];

/// Words of the language that are names only in their raw form; the Rust Reference, Keywords.
const KEYWORDS: [&str; 48] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "do", "dyn", "else",
    "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro",
    "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "static", "struct", "trait",
    "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// What was asked for, what it cost, and the fields of the model, line by line.
pub(super) fn settings<const N: usize, P: Phase<N>>(
    run: &Trajectory<N, P>,
    fields: &Values,
) -> Vec<Vec<String>> {
    let (computation, cost) = (run.computation(), run.statistics());
    let mut lines = vec![
        ("from, until", format!("{:?}, {:?}", run.start().0, run.end().0)),
        ("method asked for", format!("{:?}", computation.asked)),
        ("method", format!("{:?}", computation.method)),
        ("tolerance asked for", format!("{:?}", computation.tolerance_asked)),
        ("outputs", run.len().to_string()),
        ("steps, rejected", format!("{}, {}", cost.steps, cost.rejected)),
        ("right-hand sides", cost.evaluations.to_string()),
        ("affine-runtime", env!("CARGO_PKG_VERSION").to_owned()),
        ("multiply-adds fused", FusedArithmetic::here().to_string()),
    ];
    lines.extend(fields.iter().map(|(name, values)| (*name, listed(values))));
    lines.into_iter().map(|(name, value)| vec![name.to_owned(), value]).collect()
}

/// The run as a program: numbers are written so that they are read as the same doubles. Events are those of the user, and only
/// named.
pub(super) fn program<const N: usize, P: Phase<N>>(run: &Trajectory<N, P>, fields: &Values) -> String {
    let (name, computation) = (run.description().name, run.computation());
    let model = match fields {
        [] => format!("// model: the {name} of this run, prepared where it has fields\n"),
        fields => {
            let field = |(name, values): &(&'static str, Vec<f64>)| {
                format!("{}: {}", identifier(name), field_value(values))
            };
            let (name, fields) = (identifier(name), fields.iter().map(field).collect::<Vec<_>>().join(", "));
            format!(
                "// Fields of {name} that its coefficients are not computed from, such as forces, are for you to add.\n\
                 let model = {name} {{ {fields} }}.prepare()?;\n"
            )
        }
    };
    let argument = |(name, values): (&str, Vec<f64>)| {
        let frame = match name {
            "Sigma" => "Spatial",
            "Sigma_hat" => "Comoving",
            "Pi" => "TwoPoint",
            "phi" => return format!("    Matrix::<{N}>::new({}), // {name}\n", listed(&values)),
            _ => return format!("    Vector::<{N}>::new({}), // {name}\n", listed(&values)),
        };
        format!("    {frame}(Matrix::<{N}>::new({})), // {name}\n", listed(&values))
    };
    let start: String = run.start_as_arguments().into_iter().map(argument).collect();
    let ((t0, _), (t_end, _)) = (run.start(), run.end());
    let tolerance = computation.tolerance_asked;
    let method = match computation.asked {
        Method::Automatic => String::new(),
        method => format!(".method(Method::{method:?})"),
    };
    let mut events: Vec<&str> = run.events().iter().map(|event| event.name).collect();
    events.sort_unstable();
    events.dedup();
    let events = match events.is_empty() {
        true => String::new(),
        false => format!("// with the events {events:?}\n"),
    };
    format!(
        "{model}let start = model.at_momentum(\n{start})?;\n{events}let run = Simulation::new(&model, start)\n    \
         .from({t0:?}).until({t_end:?}).tolerance({tolerance:?}){method}.run()?;\n"
    )
}

/// A matrix is written so that fields of either kind take it, arrays of rows and those of nalgebra, which count its columns
/// first: it is symmetric.
fn field_value(values: &[f64]) -> String {
    match values {
        [value] => format!("{value:?}"),
        values => {
            let rows = values.chunks(values.len().isqrt()).map(|row| format!("[{}]", listed(row)));
            format!("[{}].into()", rows.collect::<Vec<_>>().join(", "))
        }
    }
}

/// A name as a program writes it.
fn identifier(name: &str) -> String {
    if KEYWORDS.contains(&name) { format!("r#{name}") } else { name.to_owned() }
}

fn listed(values: &[f64]) -> String {
    values.iter().map(|value| format!("{value:?}")).collect::<Vec<_>>().join(", ")
}
