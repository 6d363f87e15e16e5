//! Jacobi's elliptic functions by the arithmetic-geometric mean.

/// `(sn, cn, dn)(u | m)`, `0 <= m < 1`: Abramowitz and Stegun, section 16.4; amplitudes by descending from the mean,
/// `sin(2 a_{n-1} - a_n) = (c_n/a_n) sin a_n`.
pub(crate) fn sn_cn_dn(u: f64, m: f64) -> (f64, f64, f64) {
    let (mut a, mut b) = (vec![1.0f64], (1.0 - m).sqrt());
    let mut c = vec![m.sqrt()];
    while c[c.len() - 1].abs() > 1e-17 && a.len() < 20 {
        let last = a[a.len() - 1];
        a.push(0.5 * (last + b));
        c.push(0.5 * (last - b));
        b = (last * b).sqrt();
    }
    let n = a.len() - 1;
    let mut amplitude = 2f64.powi(n as i32) * a[n] * u;
    for k in (1..=n).rev() {
        amplitude = 0.5 * (amplitude + (c[k] / a[k] * amplitude.sin()).asin());
    }
    let (sn, cn) = amplitude.sin_cos();
    (sn, cn, (1.0 - m * sn * sn).sqrt())
}

#[test]
fn values_of_the_tables() {
    // Abramowitz and Stegun, example in 16.4: sn(0.20 | 0.81) = 0.19762; and sn(K/2) = 1/sqrt(1 + sqrt(1 - m)).
    assert!((sn_cn_dn(0.20, 0.81).0 - 0.19762).abs() < 5e-6);
    let half_of_k = 1.854_074_677_301_371_9 / 2.0;
    assert!((sn_cn_dn(half_of_k, 0.5).0 - 1.0 / (1.0 + 0.5f64.sqrt()).sqrt()).abs() < 1e-15);
    assert!((sn_cn_dn(0.7, 0.0).1 - 0.7f64.cos()).abs() < 1e-15);
}
