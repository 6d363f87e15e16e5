//! Expressions: precedence, exactness, printing.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_codegen::algebra::{Function, Rational};
use affine_codegen::diagnostics::{Diagnostic, ExpressionMistake, Rejected, gate};
use affine_codegen::lower::constant;
use affine_codegen::spec::{
    Expression, ExpressionKind, MatrixName, NAMED_POTENTIALS, Named, Operator, parse_expression,
    parse_potential,
};
use proc_macro2::{Ident, Span, TokenStream};
use proptest::prelude::*;

fn try_read(source: &str) -> Result<Expression, Rejected> {
    let tokens: TokenStream = source.parse().expect("tokens");
    gate(|found| parse_expression(tokens, found))
}

fn read(source: &str) -> Expression {
    try_read(source).unwrap_or_else(|rejected| panic!("{source}: {:?}", rejected.diagnostics().next()))
}

/// Every operation in parentheses.
fn grouped(expression: &Expression) -> String {
    let pair = |left: &Expression, sign, right: &Expression| {
        format!("({} {sign} {})", grouped(left), grouped(right))
    };
    match &expression.kind {
        ExpressionKind::Number(value) => value.to_string(),
        ExpressionKind::Symbol(name) => name.to_string(),
        ExpressionKind::FieldEntry(field, row, column) => format!("{field}[{row},{column}]"),
        ExpressionKind::Negate(one) => format!("(-{})", grouped(one)),
        ExpressionKind::Binary(operator, left, right) => {
            let sign = match operator {
                Operator::Add => "+",
                Operator::Subtract => "-",
                Operator::Multiply => "*",
                Operator::Divide => "/",
                Operator::Power => "^",
            };
            pair(left, sign, right)
        }
        ExpressionKind::Call(function, one) => format!("{}({})", function.name(), grouped(one)),
        ExpressionKind::Trace(factors) => {
            format!("tr({})", factors.iter().map(|factor| factor.name()).collect::<Vec<_>>().join("*"))
        }
        ExpressionKind::PolynomialTrace(trace) => match &trace.products {
            Some(products) => grouped(products),
            None => format!("tr({})", grouped(&trace.written)),
        },
        ExpressionKind::Matrix(matrix) => matrix.name().to_owned(),
        ExpressionKind::InverseTrace(matrix) => format!("tr({}^-1)", matrix.name()),
        ExpressionKind::Entry(matrix, row, column) => format!("{}[{row},{column}]", matrix.name()),
        ExpressionKind::Component(index) => format!("x[{index}]"),
        ExpressionKind::Norm => "norm(x)".to_owned(),
        ExpressionKind::Pairs(one) => format!("pairs({})", grouped(one)),
    }
}

fn try_potential(source: &str) -> Result<Expression, Rejected> {
    let tokens: TokenStream = source.parse().expect("tokens");
    gate(|found| parse_potential(tokens, found))
}

fn potential(source: &str) -> Expression {
    try_potential(source).unwrap_or_else(|rejected| panic!("{source}: {:?}", rejected.diagnostics().next()))
}

#[test]
fn precedence_is_that_of_mathematics() {
    let cases = [
        ("-q^2", "(-(q ^ 2))"),
        ("2^-1", "(2 ^ (-1))"),
        ("a/2*b^2+c", "(((a / 2) * (b ^ 2)) + c)"),
        ("a*s^2+c", "((a * (s ^ 2)) + c)"),
        ("2^3^2", "(2 ^ (3 ^ 2))"),
        ("2^-3^2", "(2 ^ (-(3 ^ 2)))"),
        ("2^-a*b", "((2 ^ (-a)) * b)"),
        ("(-q)^2", "((-q) ^ 2)"),
        ("-a*b", "((-a) * b)"),
        ("-a^2*b", "((-(a ^ 2)) * b)"),
        ("a*-b", "(a * (-b))"),
        ("a--b", "(a - (-b))"),
        ("a-b-c", "((a - b) - c)"),
        ("a-(b-c)", "(a - (b - c))"),
        ("a/b/c", "((a / b) / c)"),
        ("a/b*c", "((a / b) * c)"),
        ("a+b*c^d-e", "((a + (b * (c ^ d))) - e)"),
        ("((a))", "a"),
        ("n*n", "(n * n)"),
        ("r#type + crate", "(r#type + crate)"),
    ];
    for (source, expected) in cases {
        assert_eq!(grouped(&read(source)), expected, "{source}");
    }
}

#[test]
fn numbers_are_exact() {
    let cases = [
        ("0.1 + 0.2 - 0.3", "0"),
        ("0.2", "1/5"),
        ("1e-3", "1/1000"),
        ("1_000.5", "2001/2"),
        ("2.", "2"),
        ("1E2", "100"),
        ("2.5e+1", "25"),
        ("-3^2", "-9"),
        ("2^-1", "1/2"),
        ("2^3^2", "512"),
        ("6/2*3", "9"),
        ("n^2 - 1", "8"),
        ("(1/3 - 1/2)^-2", "36"),
    ];
    for (source, expected) in cases {
        let value = constant(&read(source), 3).expect(source);
        assert_eq!(value.to_string(), expected, "{source}");
    }
    assert_eq!(constant(&read("a - a"), 3), None);
    assert_eq!(constant(&read("1/0"), 3), None);
}

#[test]
fn a_fragment_of_a_macro_is_one_operand() {
    use proc_macro2::{Delimiter, Group, TokenTree};
    let sum = Group::new(Delimiter::None, "1 + 2".parse().expect("tokens"));
    let mut tokens = TokenStream::from(TokenTree::Group(sum));
    tokens.extend("^2".parse::<TokenStream>().expect("tokens"));
    let expression = gate(|found| parse_expression(tokens, found)).expect("an expression");
    assert_eq!(grouped(&expression), "((1 + 2) ^ 2)");
}

#[test]
fn printing_is_sparing_with_parentheses() {
    for source in [
        "-q^2",
        "2^-1",
        "a/2*b^2 + c",
        "(a + b)*c",
        "a - (b - c)",
        "(-a)^2",
        "(a^b)^c",
        "a^b^c",
        "a*(b*c)",
        "-(a*b)",
        "--a",
        "0.2",
        "1e-30",
        "2e300",
        "1000.5",
        "0.000001",
        "0",
        "a*-b",
        "2^-a*b",
        "(1/3)^2",
    ] {
        assert_eq!(read(source).to_string(), source);
    }
}

#[test]
fn functions_and_entries_bind_like_names() {
    let cases = [
        ("-sinh(q)^2", "(-(sinh(q) ^ 2))"),
        ("kappa/2*sinh(q)^2", "((kappa / 2) * (sinh(q) ^ 2))"),
        ("exp(-2*q^2 + t)*tr(G)", "(exp((((-2) * (q ^ 2)) + t)) * tr(G))"),
        ("tr( G * Ct*phi ) - n", "(tr(G*Ct*phi) - n)"),
        ("2^G[1,2]", "(2 ^ G[1,2])"),
        ("phi[2, 1]^2/Ct[1,1]", "((phi[2,1] ^ 2) / Ct[1,1])"),
        ("m*x[3] - k/norm(x)", "((m * x[3]) - (k / norm(x)))"),
        ("ln(sqrt(det))^-1", "(ln(sqrt(det)) ^ (-1))"),
        ("pairs(cosh(d) - 1)/2", "(pairs((cosh(d) - 1)) / 2)"),
        (
            "sin(t) + cos(t) + tan(t) + cosh(q) + tanh(q) + abs(q)",
            "(((((sin(t) + cos(t)) + tan(t)) + cosh(q)) + tanh(q)) + abs(q))",
        ),
    ];
    for (source, expected) in cases {
        assert_eq!(grouped(&potential(source)), expected, "{source}");
    }
    let ExpressionKind::Trace(factors) = potential("tr(phi*G*Ct)").kind else { panic!("a trace") };
    assert_eq!(factors, [MatrixName::Placement, MatrixName::Green, MatrixName::Finger]);
}

#[test]
fn coefficients_have_no_functions() {
    for source in ["sinh(q)", "tr(G)", "G[1,2]", "x[1]", "norm(x)", "harmonic_dilatation(1)", "1 + pairs(d)"]
    {
        let rejected = try_read(source).map(|_| ()).expect_err("a refusal");
        assert!(
            matches!(
                rejected.diagnostics().next(),
                Some(Diagnostic::Expression(ExpressionMistake::FunctionCall { .. }))
            ),
            "{source}"
        );
    }
}

#[test]
fn named_potentials_are_their_formulas() {
    let cases = [
        ("hyperbolic_dilatation(kappa)", "kappa/2*sinh(q)^2"),
        ("harmonic_dilatation(2*k)", "2*k/2*q^2"),
        ("dissociation(kappa)", "-kappa/2/cosh(q)^2"),
        ("1 - neo_hookean(c1 + c2)", "1 - (c1 + c2)*(tr(G)*exp(-2*q) - n)"),
        ("saint_venant_kirchhoff(1, 0.5)", "1/8*(tr(G) - n)^2 + 0.5/4*(tr(G*G) - 2*tr(G) + n)"),
        ("orthogonality(k)^2", "(k*(tr(G*G) - 2*tr(G) + n))^2"),
        ("gas(exp(-t))", "exp(-t)*exp(-2*q)"),
        // The arguments are the user's, whatever they are called.
        ("saint_venant_kirchhoff(mu, lambda)", "mu/8*(tr(G) - n)^2 + lambda/4*(tr(G*G) - 2*tr(G) + n)"),
        ("gas(gas(k))", "k*exp(-2*q)*exp(-2*q)"),
    ];
    for (source, expected) in cases {
        assert_eq!(grouped(&potential(source)), grouped(&potential(expected)), "{source}");
    }
}

#[test]
fn traces_are_sums_of_traces_of_products() {
    let cases = [
        ("tr((G))", "tr(G)"),
        ("tr(G^3*Ct^2)", "tr(G*G*G*Ct*Ct)"),
        ("tr((G - 1)*(G - 1))", "tr(G*G) - 2*tr(G) + n"),
        ("tr((G - 1)^3)", "tr(G*G*G) - 3*tr(G*G) + 3*tr(G) - n"),
        ("tr(1 - G)", "n - tr(G)"),
        ("tr(-G/4 - 1/4)", "-(0.25*tr(G)) - 0.25*n"),
        ("tr((G + Ct)*G)", "tr(G*G) + tr(Ct*G)"),
        ("tr(a*(b*G + 1)*Ct)", "a*b*tr(G*Ct) + a*tr(Ct)"),
        ("tr((G - a)*(G + a))", "tr(G*G) + 0*a*tr(G) - a*a*n"),
        ("tr(G/a)", "1/a*tr(G)"),
        ("tr(2*G^-1*Ct*Ct^-1 + G*G^-1)", "2*tr(G^-1) + n"),
        ("tr(G^0)", "n"),
        ("tr(tr(G)*Ct)", "tr(G)*tr(Ct)"),
    ];
    for (source, expected) in cases {
        assert_eq!(grouped(&potential(source)), grouped(&potential(expected)), "{source}");
    }
}

#[test]
fn traces_of_polynomials_are_kept_as_they_are_written() {
    for (source, has_products) in [
        ("tr((G + Ct)^4)", false),
        ("tr((G + Ct)^3)", true),
        ("tr((G + Ct + phi + a)^4*(2*G - 1))", false),
        ("tr((G*Ct)^2 - tr(G)/n + G/4)", true),
    ] {
        let read = potential(source);
        assert_eq!(read.to_string(), source);
        let ExpressionKind::PolynomialTrace(trace) = read.kind else { panic!("a trace of {source}") };
        assert_eq!(trace.products.is_some(), has_products, "{source}");
    }
    // What invariants say is told by these.
    for source in ["tr((G - 1)^3)", "tr(G - Ct*Ct)", "tr(2*G*Ct)"] {
        assert!(!matches!(potential(source).kind, ExpressionKind::PolynomialTrace(_)), "{source}");
    }
}

#[test]
fn every_named_potential_uses_each_parameter_once() {
    for named in NAMED_POTENTIALS {
        let marks: Vec<String> = (0..named.parameters.len()).map(|k| format!("mark{k}")).collect();
        let read = potential(&format!("{}({})", named.name, marks.join(", ")));
        let mut names = names(&read);
        names.retain(|name| name != "q" && name != "n");
        names.sort();
        assert_eq!(names, marks, "{}: {read}", named.name);
    }
}

/// The names in an expression.
fn names(expression: &Expression) -> Vec<String> {
    match &expression.kind {
        ExpressionKind::Symbol(name) => vec![name.to_string()],
        _ => expression.operands().into_iter().flat_map(names).collect(),
    }
}

#[test]
fn long_and_deep_expressions_are_refused_not_overflowed() {
    let deep = format!("{}1{}", "(".repeat(400), ")".repeat(400));
    let signs = format!("{}1", "-".repeat(5000));
    let powers = vec!["2"; 5000].join("^");
    let sum = vec!["a"; 5000].join("+");
    for source in [deep, signs, powers, sum] {
        let rejected = try_read(&source).map(|_| ()).expect_err("a refusal");
        assert!(matches!(
            rejected.diagnostics().next(),
            Some(Diagnostic::Expression(ExpressionMistake::ExpressionSize { .. }))
        ));
    }
    let calls = format!("{}1{}", "exp(".repeat(400), ")".repeat(400));
    let named = format!("{}1{}", "gas(".repeat(400), ")".repeat(400));
    let trace = format!("tr({})", vec!["G"; 5000].join("*"));
    let many = vec!["orthogonality(1)"; 60].join("+");
    let inverses = "tr((G + Ct + G^-1)^5)".to_owned();
    for source in [calls, named, trace, many, inverses] {
        let rejected = try_potential(&source).map(|_| ()).expect_err("a refusal");
        assert!(matches!(
            rejected.diagnostics().next(),
            Some(Diagnostic::Expression(ExpressionMistake::ExpressionSize { .. }))
        ));
    }
    assert!(try_read(&vec!["a"; 257].join("+")).is_ok());
    assert!(try_read(&format!("{}1{}", "(".repeat(64), ")".repeat(64))).is_ok());
}

fn here(kind: ExpressionKind) -> Expression {
    Expression { kind, span: Span::call_site().into() }
}

/// Random trees over `digits * 10^power`.
fn any_expression(powers: std::ops::Range<i32>) -> impl Strategy<Value = Expression> {
    let number = (0_i64..100_000, powers).prop_map(|(digits, power)| {
        let value = &Rational::from(digits) * &Rational::from(10).pow(power).expect("ten");
        here(ExpressionKind::Number(value))
    });
    let symbol = prop::sample::select(vec!["a", "b", "n", "kappa"])
        .prop_map(|name| here(ExpressionKind::Symbol(Ident::new(name, Span::call_site()))));
    let operators =
        [Operator::Add, Operator::Subtract, Operator::Multiply, Operator::Divide, Operator::Power];
    prop_oneof![number, symbol].prop_recursive(6, 60, 2, move |inner| {
        prop_oneof![
            1 => inner.clone().prop_map(|one| here(ExpressionKind::Negate(Box::new(one)))),
            5 => (prop::sample::select(operators.to_vec()), inner.clone(), inner)
                .prop_map(|(operator, left, right)| operator.apply(left, right)),
        ]
    })
}

/// Random trees over the forms of potentials.
fn any_potential() -> impl Strategy<Value = Expression> {
    let matrix = prop::sample::select(MatrixName::ALL);
    let leaf = prop_oneof![
        any_expression(0..1),
        prop::collection::vec(matrix.clone(), 1..4).prop_map(|factors| here(ExpressionKind::Trace(factors))),
        prop::sample::select(vec![MatrixName::Green, MatrixName::Finger])
            .prop_map(|matrix| here(ExpressionKind::InverseTrace(matrix))),
        (matrix, 1_usize..4, 1_usize..4).prop_map(|(m, i, j)| here(ExpressionKind::Entry(m, i, j))),
        (1_usize..4).prop_map(|index| here(ExpressionKind::Component(index))),
        Just(()).prop_map(|()| here(ExpressionKind::Norm)),
    ];
    let functions = vec![
        Function::Exp,
        Function::Ln,
        Function::Sqrt,
        Function::Abs,
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
    ];
    let operators = vec![Operator::Add, Operator::Multiply, Operator::Divide, Operator::Power];
    leaf.prop_recursive(3, 12, 2, move |inner| {
        prop_oneof![
            3 => (prop::sample::select(functions.clone()), inner.clone())
                .prop_map(|(function, one)| here(ExpressionKind::Call(function, Box::new(one)))),
            1 => inner.clone().prop_map(|one| here(ExpressionKind::Pairs(Box::new(one)))),
            1 => inner.clone().prop_map(|one| here(ExpressionKind::Negate(Box::new(one)))),
            4 => (prop::sample::select(operators.clone()), inner.clone(), inner)
                .prop_map(|(operator, left, right)| operator.apply(left, right)),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn a_printed_expression_reads_back_as_itself(expression in any_expression(-12..12)) {
        let printed = expression.to_string();
        prop_assert_eq!(grouped(&read(&printed)), grouped(&expression), "{}", printed);
    }

    #[test]
    fn parentheses_around_every_operation_leave_no_choice(expression in any_expression(0..1)) {
        let text = grouped(&expression);
        prop_assert_eq!(grouped(&read(&text)), text);
    }

    #[test]
    fn a_printed_potential_reads_back_as_itself(expression in any_potential()) {
        let printed = expression.to_string();
        prop_assert_eq!(grouped(&potential(&printed)), grouped(&expression), "{}", printed);
    }
}
