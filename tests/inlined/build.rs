//! The linker keeps what it was told of calls: where they are, and of what.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-link-arg-bins=-Wl,--emit-relocs");
}
