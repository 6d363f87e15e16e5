//! Calls of what a feature has do not compile without it, and the compiler names the feature. Each case is compiled with the
//! features of this package alone, whatever the others ask for.

#[test]
fn calls_name_the_feature() {
    trybuild::TestCases::new().compile_fail("calls/*.rs");
}
