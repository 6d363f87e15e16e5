//! Probe.
#![allow(missing_docs)]
use std::time::Instant;
fn main() {
    for text in [
        "(tr(G)-3)^4",
        "(tr(G)-3)^6",
        "(tr(G)-3)^8",
        "(tr(G)-3)^16",
        "tr(G*G*G)^2",
        "(I2-3)^3",
        "(I2-3)^4",
        "(tr(G)*exp(-2*q)-3)^6",
        "-1/norm(x)+0.05*tr(G)/norm(x)^3-0.15*(Ct[1,1]*x[1]^2+Ct[2,2]*x[2]^2+Ct[3,3]*x[3]^2+2*Ct[1,2]*x[1]*x[2]+2*Ct[1,3]*x[1]*x[3]+2*Ct[2,3]*x[2]*x[3])/norm(x)^5+10*(tr(G*G)-2*tr(G)+3)",
    ] {
        let tr = if text.contains('x') && text.contains("norm") { ", space_translation = 1" } else { "" };
        let args = format!("dim = 3, kinetic(dalembert = 1{tr}), potential = {text}");
        let now = Instant::now();
        let out = affine_codegen::expand(args.parse().unwrap(), "struct M;".parse().unwrap());
        println!("{text:.40}: {:.3} s, {} tokens", now.elapsed().as_secs_f64(), out.to_string().len());
    }
}
