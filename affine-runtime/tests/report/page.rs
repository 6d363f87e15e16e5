//! The page of a run, read back: its numbers are those of the trajectory, and it asks for nothing from elsewhere.

use affine_runtime::Trajectory;
use affine_runtime::prelude::*;
use serde_json::Value;

#[affine_model(
    dim = 3,
    kinetic(dalembert = 1, space_translation = 1),
    potential = orthogonality(2) + x[3],
    dissipation(dalembert = 0.1),
)]
struct Block;

#[affine_model(dim = 2, kinetic(casimir2 = 0.2, body_inertia = 1), potential = neo_hookean(0.5) + 2*q^2)]
struct Disc;

#[affine_model(
    dim = 2,
    metrics(space = diag(4, 1), body = diag(1, 1)),
    kinetic(casimir2 = 0.2, body_inertia = 1)
)]
struct Skew;

/// The text between two marks.
fn between<'a>(page: &'a str, start: &str, end: &str) -> &'a str {
    let (_, after) = page.split_once(start).unwrap_or_else(|| panic!("no {start}"));
    after.split_once(end).unwrap_or_else(|| panic!("no {end}")).0
}

/// What a reader sees.
fn plain(page: &str) -> String {
    page.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&")
}

fn data(page: &str) -> Value {
    serde_json::from_str(between(page, "<script type=\"application/json\" id=\"data\">", "</script>"))
        .unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// The page asks for nothing: every address in it is a part of itself.
fn assert_alone(page: &str) {
    for word in ["http:", "https:", "//cdn", "src=", "href=", "@import", "url(", "fetch(", "import "] {
        assert!(!page.contains(word), "{word}");
    }
    assert!(page.contains("default-src 'none'"));
    for word in ["<!--", "/*data*/", "/*script*/"] {
        assert!(!page.contains(word), "{word} is not filled in");
    }
}

/// Frames are the start, the outputs and the end, exactly; drifts those of `conservation()`.
fn assert_read_back<const N: usize, P: Phase<N>>(run: &Trajectory<N, P>) -> Value {
    let page = run.to_html();
    assert_alone(&page);
    let data = data(&page);
    assert_eq!(data["n"], N);
    let (times, outputs) = (numbers(&data["t"]), numbers(&data["outputs"]));
    assert_eq!(outputs, run.times());
    assert_eq!((times[0], *times.last().unwrap()), (run.start().0, run.end().0));
    for (t, point) in run.iter().chain([run.start(), run.end()]) {
        let k = times.iter().position(|time| *time == t).unwrap();
        let body = run.orthonormal(point);
        assert_eq!(numbers(&data["x"][k]), body.x().as_slice());
        let phi = Matrix::<N>::from_row_slice(&numbers(&data["phi"][k]));
        assert_eq!(&phi, body.phi());
        // What stretches have of phi without being computed from it: their product, and the sum of their squares.
        let stretches = numbers(&data["stretches"][k]);
        let sum: f64 = stretches.iter().sum();
        assert!((sum - N as f64 * body.mean_log_stretch()).abs() < 1e-12);
        let squares: f64 = stretches.iter().map(|q| (2.0 * q).exp()).sum();
        assert!((squares - phi.norm_squared()).abs() < 1e-12 * squares);
    }
    let conservation = run.conservation();
    let drifts = data["drifts"].as_array().unwrap();
    assert_eq!(drifts.len(), conservation.drifts().len());
    let table = between(&page, "<table>", "</table>");
    for (found, drift) in drifts.iter().zip(conservation.drifts()) {
        assert_eq!(found["symbol"], drift.quantity.symbol());
        assert_eq!(numbers(&found["values"]), run.relative_drifts(drift));
        assert!(table.contains(&format!("<td>{:.2e}</td>", drift.relative())));
    }
    let plain = plain(&page);
    assert!(plain.contains(&run.why().to_string()));
    let energies = data["energies"].as_array().unwrap();
    assert_eq!(
        (&energies[0]["symbol"], numbers(&energies[0]["values"])),
        (&"H".into(), run.energies().to_vec())
    );
    assert_eq!(energies.len() == 2, conservation.balance().is_some());
    // Every formula is a document of MathML, in which no error is marked.
    let formulas: Vec<&str> =
        page.split("<math").skip(1).map(|rest| rest.split_once("</math>").unwrap().0).collect();
    assert_eq!(formulas.len(), 2 + run.description().equations.len());
    for formula in formulas {
        roxmltree::Document::parse(&format!("<math{formula}</math>")).unwrap();
        assert!(!formula.contains("merror") && !formula.contains("178"), "{formula}");
    }
    data
}

fn thrown() -> Trajectory<3, <Block as Model<3>>::Point<f64>> {
    let (x, v) = (Vector::<3>::zeros(), Vector::<3>::new(1.0, 0.0, 3.0));
    let rate = Matrix::<3>::new(0.2, -1.0, 0.0, 1.0, 0.0, 0.5, 0.0, 0.0, -0.3);
    let start = Block.at_velocity(x, Matrix::<3>::identity(), v, rate).unwrap();
    let top =
        Event::new("top \"</script>\" & <b>", |_, point: &<Block as Model<3>>::Point<f64>| point.p()[2]);
    // Outputs that are neither start nor end.
    Simulation::new(&Block, start).until(6.0).output([0.5, 1.0, 2.5, 5.0]).event(top.falling()).run().unwrap()
}

#[test]
fn a_page_holds_the_run() {
    let run = thrown();
    let data = assert_read_back(&run);
    assert_eq!(data["t"].as_array().unwrap().len(), 6);
    assert_eq!(data["events"].as_array().unwrap().len(), 1);
    assert_eq!(data["events"][0]["name"], run.events()[0].name);
    assert_eq!(data["events"][0]["t"].as_f64(), Some(run.events()[0].t));
    assert!(run.conservation().balance().is_some_and(|balance| {
        let page = run.to_html();
        page.contains("&lt;b&gt;") && page.contains(&balance.to_string().replace('>', "&gt;"))
    }));
    // Names of the user end neither the data nor the page.
    assert_eq!(run.to_html().matches("</script>").count(), 2);
}

#[test]
fn discs_runs_backward_and_single_points_have_pages() {
    let start = Disc.at_velocity(Matrix::<2>::identity(), Matrix::<2>::new(0.3, 0.5, -0.2, 0.1)).unwrap();
    let simulation = |t_end: f64| Simulation::new(&Disc, start).until(t_end).run().unwrap();
    for t_end in [3.0, -3.0, 0.0] {
        assert_read_back(&simulation(t_end));
    }
}

#[test]
fn bodies_with_metrics_are_drawn_where_lengths_are_those_of_the_metrics() {
    let spin = Comoving(Matrix::<2>::new(0.1, 0.3, -0.2, 0.2));
    let start = Skew.at_momentum(Matrix::<2>::identity(), spin).unwrap();
    let run = Simulation::new(&Skew, start).until(1.0).every(0.5).run().unwrap();
    let data = assert_read_back(&run);
    // g = diag(4, 1): the first axis of space is twice as long.
    assert_eq!(numbers(&data["phi"][0]), [2.0, 0.0, 0.0, 1.0]);
}

#[test]
fn a_page_is_written() {
    let folder = std::env::temp_dir();
    let path = folder.join(format!("affine-page-{}.html", std::process::id()));
    let run = thrown();
    run.save_html(&path).unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), run.to_html());
    std::fs::remove_file(&path).unwrap();
    assert!(run.save_html(folder.join("no such folder").join("page.html")).is_err());
}

/// Code with its text.
macro_rules! with_its_text {
    ($again:ident, $text:ident, $run:ident: $of:ty, { $($code:tt)* }) => {
        // Values of matrix fields convert themselves to the type of the field, which may be theirs.
        #[allow(clippy::useless_conversion)]
        fn $again() -> affine_runtime::Result<$of> {
            $($code)*
            Ok($run)
        }
        const $text: &str = stringify!($($code)*);
    };
}

#[affine_model(
    dim = 2,
    kinetic(casimir2 = 0.2, body_inertia = j, body_translation = r#type),
    potential = neo_hookean(k) + 2*q^2,
    dissipation(body_inertia = r),
)]
struct Family {
    k: f64,
    j: Matrix<2>,
    r#type: f64,
    r: [[f64; 2]; 2],
}

with_its_text!(again, AGAIN, run: Trajectory<2, <PreparedFamily as Model<2>>::Point<f64>>, {
    let model = Family {
        k: 0.1, r#type: 2.0, j: [[1.0, 0.25], [0.25, 1.5]].into(), r: [[0.5, 0.125], [0.125, 0.25]].into()
    }.prepare()?;
    let start = model.at_momentum(
        Vector::<2>::new(0.5, 1e-20),
        Matrix::<2>::new(1.1, 0.2, -0.1, 0.9),
        Vector::<2>::new(0.1, -0.3),
        Comoving(Matrix::<2>::new(0.1, 0.7, -0.2, 0.3)),
    )?;
    let run = Simulation::new(&model, start)
        .from(0.25).until(1.5).tolerance(1e-9).method(Method::Gauss { stages: 3, step: 0.125 }).run()?;
});

/// The program on a page, compiled, makes the run again, bit by bit.
#[test]
fn a_page_tells_how_to_make_its_run_again() {
    let (j, r) = (Matrix::<2>::new(1.0, 0.25, 0.25, 1.5), [[0.5, 0.125], [0.125, 0.25]]);
    let family = Family { k: 0.1, j, r#type: 2.0, r };
    let run = again().unwrap();
    let page = plain(&run.page().fields(&family).to_html());
    let program = between(&page, "<h2>The run again</h2>\n<pre>", "</pre>");
    let tokens = |text: &str| {
        let code = text.lines().map(|line| line.split("//").next().unwrap());
        code.collect::<String>().replace(char::is_whitespace, "")
    };
    // Punctuation that code may have or not.
    assert_eq!(tokens(program).replace(",)", ")"), tokens(AGAIN).replace(",)", ")"));
    assert_eq!(again().unwrap(), run);
    for row in [
        "<td>k</td><td>0.1</td>",
        "<td>j</td><td>1.0, 0.25, 0.25, 1.5</td>",
        "<td>type</td><td>2.0</td>",
        "<td>from, until</td><td>0.25, 1.5</td>",
        "<td>tolerance asked for</td><td>1e-9</td>",
        "<td>method</td><td>Gauss { stages: 3, step: 0.125 }</td>",
    ] {
        assert!(page.contains(row), "{row}");
    }
    assert!(program.contains("// Fields of Family that its coefficients are not computed from"));
    let without = plain(&run.to_html());
    assert!(without.contains("// model: the Family of this run") && !without.contains("<td>k</td>"));
    let own = plain(&run.page().program("fn main() { a < b }").to_html());
    assert!(own.contains("<pre>fn main() { a < b }</pre>") && !own.contains("at_momentum"));
}

/// What happened on the way is named, whatever it is called.
#[test]
fn events_stand_in_the_program() {
    let page = plain(&thrown().to_html());
    assert!(page.contains("// with the events [\"top \\\"</script>\\\" & <b>\"]"));
    assert!(page.contains("TwoPoint(Matrix::<3>::new("));
}

/// What is drawn with is small, and asks for no library.
#[test]
fn the_script_is_short() {
    let page = thrown().to_html();
    let script = between(&page, "<script>\n", "\n</script>");
    assert!(script.lines().count() <= 300, "{}", script.lines().count());
    assert!(script.contains("webgl2") && !script.contains("require"));
}
