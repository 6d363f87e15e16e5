//! The energies of the table, as users write them.

use crate::table::{Energy, of};

/// Energies by the names of the table.
macro_rules! energies {
    ($($name:ident: ($dim:literal, $kinetic:tt, $($potential:tt)*));* $(;)?) => {
        $(#[allow(dead_code)]
        mod $name {
            use affine_runtime::prelude::*;
            #[affine_model(dim = $dim, kinetic $kinetic, potential = $($potential)*)]
            pub(super) struct Body;
        })*

        /// Name, dimension and text of each.
        pub(crate) const TEXTS: &[(&str, usize, &str)] =
            &[$((stringify!($name), $dim, stringify!($($potential)*))),*];

        /// All of them.
        pub(crate) fn all() -> Vec<Energy> {
            vec![$(of::<$dim, $name::Body>(stringify!($name), &$name::Body)),*]
        }
    };
}

energies! {
    nh_iso_3: (3, (dalembert = 1), 0.5*(tr(G)*exp(-2*q) - 3) + 2*(det-1)^2);
    nh_ln_3: (3, (dalembert = 1), 0.5*(tr(G) - 3) - ln(det) + 1.25*ln(det)^2);
    nh_2d_2: (2, (dalembert = 1), 0.5*(tr(G) - 2) - ln(det) + 1.25*(det-1)^2);
    mooney_3: (3, (dalembert = 1), 0.5*(I1*exp(-2*q) - 3) + 0.25*(I2*exp(-4*q) - 3) + 2*(det-1)^2);
    yeoh_iso_3: (3, (dalembert = 1), 0.5*(tr(G)*exp(-2*q)-3) - 0.05*(tr(G)*exp(-2*q)-3)^2 + 0.01*(tr(G)*exp(-2*q)-3)^3 + 2*(det-1)^2);
    yeoh_3: (3, (dalembert = 1), 0.5*(tr(G)-3) - 0.05*(tr(G)-3)^2 + 0.01*(tr(G)-3)^3 - ln(det) + ln(det)^2);
    iso3_3: (3, (dalembert = 1), (tr(G)*exp(-2*q)-3)^3);
    trace4_3: (3, (dalembert = 1), (tr(G)-3)^4);
    trace6_3: (3, (dalembert = 1), (tr(G)-3)^6);
    trace8_3: (3, (dalembert = 1), (tr(G)-3)^8);
    trace16_3: (3, (dalembert = 1), (tr(G)-3)^16);
    arruda_3: (3, (dalembert = 1), 0.5*(tr(G)*exp(-2*q) - 3) + 1/160*((tr(G)*exp(-2*q))^2 - 9) + 11/67200*((tr(G)*exp(-2*q))^3 - 27) + 19/3584000*((tr(G)*exp(-2*q))^4 - 81) + 519/2759680000*((tr(G)*exp(-2*q))^5 - 243) + 10*(det-1)^2);
    gent_2: (2, (dalembert = 1), -48.6*ln(1 - (tr(G)-n)/97.2) - ln(det) + ln(det)^2);
    gent_3: (3, (dalembert = 1), -48.6*ln(1 - (tr(G)-n)/97.2) - ln(det) + ln(det)^2);
    fung_i1_3: (3, (dalembert = 1), 0.25*(exp(2*(tr(G)-3)) - 1) - ln(det) + 5*ln(det)^2);
    fung_e_3: (3, (dalembert = 1), 0.5*(exp((tr(G*G) - 2*tr(G) + 3)/2) - 1));
    ogden_3: (3, (dalembert = 1), 0.3*(Q1^2+Q2^2+Q3^2-3) + 0.1*(Q1^4+Q2^4+Q3^4-3) + 0.2*(Q1^-2+Q2^-2+Q3^-2-3));
    ogden_real_3: (3, (dalembert = 1), 6.3/1.3*(exp(1.3*q1)+exp(1.3*q2)+exp(1.3*q3)-3) + 0.0024*(Q1^5+Q2^5+Q3^5-3) + 0.05*(Q1^-2+Q2^-2+Q3^-2-3) - 6.212*ln(det) + 10*ln(det)^2);
    svk_2: (2, (dalembert = 1), 0.1875*(tr(G) - n)^2 + 0.2*(tr(G*G) - 2*tr(G) + n));
    svk_3: (3, (dalembert = 1), 0.1875*(tr(G) - n)^2 + 0.2*(tr(G*G) - 2*tr(G) + n));
    hencky_2: (2, (dalembert = 1), 0.8*(q1^2+q2^2) + 0.75*ln(det)^2);
    hencky_3: (3, (dalembert = 1), 0.8*(q1^2+q2^2+q3^2) + 0.75*ln(det)^2);
    abd_2: (2, (dalembert = 1), 100*(tr(G*G) - 2*tr(G) + n));
    abd_3: (3, (dalembert = 1), 100*(tr(G*G) - 2*tr(G) + n));
    det2_2: (2, (dalembert = 1), 2*(det-1)^2);
    det2_3: (3, (dalembert = 1), 2*(det-1)^2);
    barrier_3: (3, (dalembert = 1), 0.25*tr(G*G) + 1/det);
    lndet2_2: (2, (dalembert = 1), 5*ln(det)^2);
    lndet2_3: (3, (dalembert = 1), 5*ln(det)^2);
    volume_2: (2, (dalembert = 1), 2.5*(det^2 - 1 - 2*ln(det)));
    volume_3: (3, (dalembert = 1), 2.5*(det^2 - 1 - 2*ln(det)));
    blatz_3: (3, (dalembert = 1), 0.5*(I2/I3 + 2*det - 5));
    fibre_3: (3, (dalembert = 1), 0.5*(tr(G)-3) - ln(det) + 0.5*(G[1,1]-1)^4);
    hgo_3: (3, (dalembert = 1), 0.5*(tr(G)-3) - ln(det) + ln(det)^2 + 0.3*(exp(1.5*(G[1,1]-1)^2) - 1));
    cubic2_3: (3, (dalembert = 1), tr(G*G*G)^2);
    i2_3_3: (3, (dalembert = 1), (I2-3)^3);
    tide_3: (3, (dalembert = 1, space_translation = 1), -1/norm(x) + 0.05*tr(G)/norm(x)^3 - 0.15*(Ct[1,1]*x[1]^2 + Ct[2,2]*x[2]^2 + Ct[3,3]*x[3]^2 + 2*Ct[1,2]*x[1]*x[2] + 2*Ct[1,3]*x[1]*x[3] + 2*Ct[2,3]*x[2]*x[3])/norm(x)^5 + 10*(tr(G*G) - 2*tr(G) + 3));
    spring_2: (2, (dalembert = 1, space_translation = 1), 2*(norm(x)-1)^2*tr(G) + 0.3*x[1]*phi[1,2] + 9.81*x[2]);
    driven_2: (2, (dalembert = 1), (1 + 0.25*cos(3*t))*0.25*(tr(G*G) - 2*tr(G) + 2) + 0.2*sin(t)*phi[1,2])
}
