//! Expressions: precedence, exactness, printing.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use affine_codegen::algebra::Rational;
use affine_codegen::check::constant;
use affine_codegen::diagnostics::{Diagnostic, Rejected, gate};
use affine_codegen::spec::{Expression, ExpressionKind, Operator, parse_expression};
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
        ExpressionKind::Negate(one) => format!("(-{})", grouped(one)),
        ExpressionKind::Add(left, right) => pair(left, "+", right),
        ExpressionKind::Subtract(left, right) => pair(left, "-", right),
        ExpressionKind::Multiply(left, right) => pair(left, "*", right),
        ExpressionKind::Divide(left, right) => pair(left, "/", right),
        ExpressionKind::Power(left, right) => pair(left, "^", right),
    }
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
fn long_and_deep_expressions_are_refused_not_overflowed() {
    let deep = format!("{}1{}", "(".repeat(400), ")".repeat(400));
    let signs = format!("{}1", "-".repeat(5000));
    let powers = vec!["2"; 5000].join("^");
    let sum = vec!["a"; 5000].join("+");
    for source in [deep, signs, powers, sum] {
        let rejected = try_read(&source).map(|_| ()).expect_err("a refusal");
        assert!(matches!(rejected.diagnostics().next(), Some(Diagnostic::ExpressionSize { .. })));
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
}
