#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]
use affine_codegen::expand;
fn show(args: &str, item: &str) {
    let t = expand(args.parse().unwrap(), item.parse().unwrap());
    let file = syn::parse2(t).unwrap();
    println!("//// {args}\n{}", prettyplease::unparse(&file));
}
#[test]
fn show_all() {
    let which = std::env::var("WHICH").unwrap_or_default();
    let item = std::env::var("ITEM").unwrap_or("pub struct M;".into());
    show(&which, &item);
}
