//! The linker keeps what it was told of calls: where they are, and of what.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // Linkers of other systems have no such flag.
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux") {
        println!("cargo::rustc-link-arg-bins=-Wl,--emit-relocs");
    }
}
