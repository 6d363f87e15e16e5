//! Double-double numbers, sums of two doubles with 106 bits, as scalars.

use qd::Quad;

use super::{Real, Scalar};

/// Arguments up to this size are for power series.
const SMALL: f64 = 1.0;
/// Beside numbers from this size on 1 is less than a rounding. Infinite ones are among them, whose sums and products would be NaN.
const LARGE: f64 = 1e40;
/// Counts up to this one are exact doubles.
const MOST_QUARTERS: f64 = 9007199254740992.0;
/// Terms of a power series in the square of an argument of at most 1: the next is below `1/31!`.
const TERMS: u32 = 14;

/// Angles beyond `2^53 pi/2`, some 1.4e16, have neither sine nor cosine nor tangent here: these are NaN. Below, the angle counts
/// to `2^-106` of its size.
impl Scalar for Quad {
    fn constant(hi: f64, lo: f64) -> Self {
        if hi.is_finite() { Quad::from(hi) + Quad::from(lo) } else { Quad::from(hi) }
    }
    fn sqrt(self) -> Self {
        if self.0 < 0.0 { Quad::NAN } else { Quad::sqrt(self) }
    }
    fn cbrt(self) -> Self {
        let root = Quad::from(libm::cbrt(self.0));
        if root.0 == 0.0 || !root.0.is_finite() {
            return root;
        }
        // A step of Newton's method doubles the digits, here and below.
        let square = root * root;
        root - (square * root - self) / (square + square + square)
    }
    fn exp(self) -> Self {
        multiple_of_exp(1.0, self)
    }
    fn exp_m1(self) -> Self {
        if self.0.abs() > SMALL {
            let exp = Scalar::exp(self);
            return if exp.0 > LARGE { exp } else { exp - Quad::ONE };
        }
        let half = self * Quad::from(0.5);
        let sinh = odd_series(half, 1.0);
        (sinh + sinh) * Scalar::exp(half)
    }
    fn ln(self) -> Self {
        let exponent = libm::rint(libm::log2(self.0));
        if !exponent.is_finite() {
            return Quad::from(libm::log(self.0));
        }
        let near_one = scaled(self, -exponent as i32);
        (near_one - Quad::ONE).ln_1p() + Quad::LN_2 * Quad::from(exponent)
    }
    fn ln_1p(self) -> Self {
        if self.0 > LARGE {
            return Scalar::ln(self);
        }
        let logarithm = Quad::from(libm::log1p(self.0));
        if logarithm.0 == 0.0 || !logarithm.0.is_finite() {
            return logarithm;
        }
        let less = logarithm.exp_m1();
        logarithm - (less - self) / (less + Quad::ONE)
    }
    fn sin(self) -> Self {
        let (quarter, rest) = quarters(self);
        let size = if quarter % 2 == 0 { odd_series(rest, -1.0) } else { even_series(rest, -1.0) };
        if quarter < 2 { size } else { -size }
    }
    fn cos(self) -> Self {
        let (quarter, rest) = quarters(self);
        let size = if quarter % 2 == 0 { even_series(rest, -1.0) } else { odd_series(rest, -1.0) };
        if quarter == 0 || quarter == 3 { size } else { -size }
    }
    fn tan(self) -> Self {
        Scalar::sin(self) / Scalar::cos(self)
    }
    fn sinh(self) -> Self {
        if self.0.abs() <= SMALL {
            return odd_series(self, 1.0);
        }
        let half = multiple_of_exp(0.5, Scalar::abs(self));
        let size = if half.0 > LARGE { half } else { half - Quad::from(0.25) / half };
        size.copysign(self)
    }
    fn cosh(self) -> Self {
        let half = multiple_of_exp(0.5, Scalar::abs(self));
        if half.0 > LARGE { half } else { half + Quad::from(0.25) / half }
    }
    fn tanh(self) -> Self {
        let less = (-scaled(Scalar::abs(self), 1)).exp_m1();
        (-less / (less + Quad::from(2.0))).copysign(self)
    }
    fn asinh(self) -> Self {
        let value = Quad::from(libm::asinh(self.0));
        if value.0 == 0.0 || !value.0.is_finite() {
            return value;
        }
        if self.0.abs() > LARGE {
            return (Scalar::ln(Scalar::abs(self)) + Quad::LN_2).copysign(self);
        }
        value - (Scalar::sinh(value) - self) / Scalar::cosh(value)
    }
    fn abs(self) -> Self {
        Quad::abs(self)
    }
    fn copysign(self, sign: Self) -> Self {
        if self.0.is_sign_negative() == sign.0.is_sign_negative() { self } else { -self }
    }
    fn max(self, other: Self) -> Self {
        if self > other || self.0.is_nan() { self } else { other }
    }
}

impl Real for Quad {
    const EPSILON: Self = Quad::EPSILON;

    fn hypot(self, other: Self) -> Self {
        let (a, b) = (Scalar::abs(self), Scalar::abs(other));
        if a.0.is_infinite() || b.0.is_infinite() {
            return Quad::INFINITY;
        }
        let large = Scalar::max(a, b);
        if large.0 == 0.0 || large.0.is_nan() {
            return large;
        }
        let ratio = Scalar::min(a, b) / large;
        large * Quad::sqrt(ratio * ratio + Quad::ONE)
    }
    fn is_finite(self) -> bool {
        self.0.is_finite() && self.1.is_finite()
    }
    fn to_f64(self) -> f64 {
        self.0
    }
}

/// `x + s x^3/3! + s^2 x^5/5! + ...`: the hyperbolic sine for `s = 1`, the sine for `s = -1`.
fn odd_series(x: Quad, sign: f64) -> Quad {
    x * series(x * x * Quad::from(sign), 1)
}

/// `1 + s x^2/2! + s^2 x^4/4! + ...`: the cosine for `s = -1`.
fn even_series(x: Quad, sign: f64) -> Quad {
    series(x * x * Quad::from(sign), 0)
}

/// `1 + z/((d + 1)(d + 2)) + z^2/((d + 1) ... (d + 4)) + ...`.
fn series(z: Quad, d: u32) -> Quad {
    (1..=TERMS).rev().fold(Quad::ONE, |sum, k| {
        let factors = f64::from((2 * k + d - 1) * (2 * k + d));
        Quad::ONE + sum * z / Quad::from(factors)
    })
}

/// `2^exponent x`.
fn scaled(x: Quad, exponent: i32) -> Quad {
    Quad(libm::scalbn(x.0, exponent), libm::scalbn(x.1, exponent))
}

/// `factor exp(x)` of a factor of at most 1; not by the exponential itself, which ends before doubles do.
fn multiple_of_exp(factor: f64, x: Quad) -> Quad {
    let root = libm::exp(0.5 * x.0);
    let size = factor * root * root;
    if size == 0.0 || !size.is_finite() {
        return Quad::from(size);
    }
    let root = Quad::exp(scaled(x, -1));
    Quad::from(factor) * root * root
}

/// How many quarters of a turn an angle has, modulo 4, and the rest, at most an eighth; to `2^-106` of the angle, and NaN where
/// they are too many to be counted.
fn quarters(angle: Quad) -> (u32, Quad) {
    let quarter = Quad::PI * Quad::from(0.5);
    let count = libm::rint((angle / quarter).0);
    let rest = if count.abs() > MOST_QUARTERS { Quad::NAN } else { angle - quarter * Quad::from(count) };
    (libm::fmod(libm::fmod(count, 4.0) + 4.0, 4.0) as u32, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    type Function = fn(Quad) -> Quad;

    const FUNCTIONS: [(&str, Function); 13] = [
        ("sqrt", Scalar::sqrt),
        ("cbrt", Scalar::cbrt),
        ("exp", Scalar::exp),
        ("exp_m1", Scalar::exp_m1),
        ("ln", Scalar::ln),
        ("ln_1p", Scalar::ln_1p),
        ("sin", Scalar::sin),
        ("cos", Scalar::cos),
        ("tan", Scalar::tan),
        ("sinh", Scalar::sinh),
        ("cosh", Scalar::cosh),
        ("tanh", Scalar::tanh),
        ("asinh", Scalar::asinh),
    ];

    /// Name, argument, and value in two doubles, computed with 60 digits.
    #[allow(clippy::excessive_precision, clippy::unreadable_literal)]
    const VALUES: &[(&str, f64, f64, f64)] = &[
        ("exp", -3.3, 0.036883167401240015, -2.8625274258701676e-18),
        ("exp", -0.7, 0.4965853037914095, 9.827550225511106e-18),
        ("exp", -1e-05, 0.9999900000499998, 5.730256126450165e-18),
        ("exp", 0.001, 1.0010005001667084, -4.290842058948394e-17),
        ("exp", 0.5, 1.6487212707001282, -4.731568479435833e-17),
        ("exp", 0.99, 2.691234472349262, 2.1279278704367211e-16),
        ("exp", 1.01, 2.7456010150169163, 1.8307716508471274e-16),
        ("exp", 2.5, 12.182493960703473, 2.0334002173348147e-16),
        ("exp", 7.0, 1096.6331584284585, 9.869752640434095e-14),
        ("exp", 20.0, 485165195.4097903, 4.880277289790406e-10),
        ("exp_m1", -3.3, -0.96311683259876, 3.1831942093665975e-17),
        ("exp_m1", -0.7, -0.5034146962085905, 9.827550225511106e-18),
        ("exp_m1", -1e-05, -9.999950000166666e-06, -7.687946724313578e-22),
        ("exp_m1", 0.001, 0.0010005001667083417, 2.598544094203749e-20),
        ("exp_m1", 0.5, 0.6487212707001282, -4.731568479435833e-17),
        ("exp_m1", 0.99, 1.6912344723492623, -9.251817881359191e-18),
        ("exp_m1", 1.01, 1.7456010150169166, -3.896743984031857e-17),
        ("exp_m1", 2.5, 11.182493960703473, 2.0334002173348147e-16),
        ("exp_m1", 7.0, 1095.6331584284585, 9.869752640434095e-14),
        ("exp_m1", 20.0, 485165194.4097903, 4.880277289790406e-10),
        ("sin", -3.3, 0.1577456941432482, -4.1057111622248306e-18),
        ("sin", -0.7, -0.644217687237691, -2.8740567927338755e-18),
        ("sin", -1e-05, -9.999999999833334e-06, -6.182336062862823e-22),
        ("sin", 0.001, 0.0009999998333333417, 5.670638989736153e-21),
        ("sin", 0.5, 0.479425538604203, -5.103969860556013e-18),
        ("sin", 0.99, 0.8360259786005205, -1.3225434092417684e-17),
        ("sin", 1.01, 0.8468318446180152, 2.1482101005267866e-20),
        ("sin", 2.5, 0.5984721441039565, -5.521403334082375e-17),
        ("sin", 7.0, 0.6569865987187891, 2.937261786543214e-17),
        ("sin", 20.0, 0.9129452507276277, -1.1889007125365703e-17),
        ("cos", -3.3, -0.9874797699088649, -3.2489331196047457e-17),
        ("cos", -0.7, 0.7648421872844885, -4.013780434022238e-17),
        ("cos", -1e-05, 0.99999999995, 4.137435208440879e-18),
        ("cos", 0.001, 0.9999995000000417, -7.831485455398128e-18),
        ("cos", 0.5, 0.8775825618903728, -4.2623149864279997e-17),
        ("cos", 0.99, 0.5486898605815875, 5.315974627281537e-17),
        ("cos", 1.01, 0.5318607213743555, -1.3116821882683055e-17),
        ("cos", 2.5, -0.8011436155469337, -1.8674742705085553e-17),
        ("cos", 7.0, 0.7539022543433046, 3.728245359710072e-17),
        ("cos", 20.0, 0.40808206181339196, 2.5226139669269e-17),
        ("tan", -3.3, -0.15974574766003222, 2.308758304629972e-18),
        ("tan", -0.7, -0.8422883804630794, 3.9128846706146343e-17),
        ("tan", -1e-05, -1.0000000000333334e-05, -4.576136819360367e-22),
        ("tan", 0.001, 0.0010000003333334668, -6.486837852282393e-20),
        ("tan", 0.5, 0.5463024898437905, 2.9096576216837176e-17),
        ("tan", 0.99, 1.5236767410179022, 6.208015589956119e-17),
        ("tan", 1.01, 1.5922060242195704, 4.634569983651448e-17),
        ("tan", 2.5, -0.7470222972386603, 3.6166133011893774e-17),
        ("tan", 7.0, 0.8714479827243188, -4.504356604978944e-17),
        ("tan", 20.0, 2.237160944224742, 5.580201602943427e-17),
        ("sinh", -3.3, -13.537877876628322, 5.721971989542219e-16),
        ("sinh", -0.7, -0.7585837018395335, 4.9693841630321686e-17),
        ("sinh", -1e-05, -1.0000000000166668e-05, 6.182319396196156e-22),
        ("sinh", 0.001, 0.001000000166666675, -3.571742859983052e-20),
        ("sinh", 0.5, 0.5210953054937474, -2.3328183476404597e-17),
        ("sinh", 0.99, 1.1598288906636083, 5.006974334899048e-18),
        ("sinh", 1.01, 1.1906910177226966, 1.3471451188672345e-17),
        ("sinh", 2.5, 6.0502044810397875, -1.5266669624477375e-16),
        ("sinh", 7.0, 548.3161232732465, 3.278482817431654e-14),
        ("sinh", 20.0, 242582597.70489514, -7.865629467297586e-10),
        ("cosh", -3.3, 13.574761044029561, 3.4781316283956937e-16),
        ("cosh", -0.7, 1.255169005630943, -3.986629140481058e-17),
        ("cosh", -1e-05, 1.00000000005, -4.136601875107545e-18),
        ("cosh", 0.001, 1.0000005000000416, 7.443797190204747e-17),
        ("cosh", 0.5, 1.1276259652063807, 8.703480114456192e-17),
        ("cosh", 0.99, 1.531405581685654, -1.425879221625824e-17),
        ("cosh", 1.01, 1.55490999729422, -5.243889102899092e-17),
        ("cosh", 2.5, 6.132289479663686, 3.560067179782552e-16),
        ("cosh", 7.0, 548.3170351552121, -4.777413949159163e-14),
        ("cosh", 20.0, 242582597.70489514, 1.2745906757087991e-09),
        ("tanh", -3.3, -0.9972829600991421, -2.0750489070819206e-18),
        ("tanh", -0.7, -0.6043677771171635, 2.7916180015425346e-17),
        ("tanh", -1e-05, -9.999999999666668e-06, 4.5758701526937e-22),
        ("tanh", 0.001, 0.0009999996666668, 1.7800613799166557e-20),
        ("tanh", 0.5, 0.46211715726000974, 2.1916603238260928e-17),
        ("tanh", 0.99, 0.7573623242165263, 5.172437339463871e-18),
        ("tanh", 1.01, 0.7657620182484389, 3.166672515037369e-17),
        ("tanh", 2.5, 0.9866142981514303, -2.4529238788172874e-17),
        ("tanh", 7.0, 0.9999983369439447, -1.612443653741189e-17),
        ("tanh", 20.0, 1.0, -8.496708510583178e-18),
        ("sqrt", 1e-09, 3.1622776601683795e-05, -9.946806139223485e-22),
        ("sqrt", 0.3, 0.5477225575051661, 2.890126723719787e-17),
        ("sqrt", 0.999, 0.999499874937461, -4.288166151612508e-17),
        ("sqrt", 1.0009765625, 1.0004881620988826, 2.426835460944239e-17),
        ("sqrt", 2.3, 1.51657508881031, 5.0922868534347466e-17),
        ("sqrt", 77.5, 8.803408430829505, -6.54972630691232e-17),
        ("cbrt", 1e-09, 0.001, -5.615122579506676e-23),
        ("cbrt", 0.3, 0.6694329500821695, -6.398340323701905e-18),
        ("cbrt", 0.999, 0.999666555493786, -4.6567728733136015e-17),
        ("cbrt", 1.0009765625, 1.000325414926972, 2.312834043163875e-17),
        ("cbrt", 2.0, 1.2599210498948732, -2.589933375300507e-17),
        ("cbrt", 77.5, 4.263509491640799, -3.3012075747437414e-16),
        ("ln", 1e-09, -20.72326583694641, -6.485730665985714e-16),
        ("ln", 0.3, -1.2039728043259361, 8.935521583403776e-17),
        ("ln", 0.999, -0.0010005003335835344, -2.5644777003677798e-20),
        ("ln", 1.0009765625, 0.0009760859730554589, -2.8791156534096714e-20),
        ("ln", 2.25, 0.8109302162163288, -5.762276051925285e-18),
        ("ln", 77.5, 4.350277936359301, -6.72757173844173e-17),
        ("ln_1p", 1e-09, 9.999999995e-10, 7.493897403823754e-26),
        ("ln_1p", 0.3, 0.26236426446749106, -1.6067257209028454e-17),
        ("ln_1p", 0.999, 0.692647055518263, 1.1490898013639325e-17),
        ("ln_1p", 1.0009765625, 0.6936353426394467, -4.5275542856335454e-17),
        ("ln_1p", 2.0, 1.0986122886681098, -9.07129723500153e-17),
        ("ln_1p", 77.5, 4.363098624788363, -4.409904509955569e-16),
        ("ln_1p", -1e-07, -1.0000000500000033e-07, 2.44146596723983e-24),
        ("ln_1p", -0.625, -0.9808292530117262, -4.9262074302888635e-17),
        ("asinh", -330000.0, -13.399995114004904, -1.2500545050900916e-16),
        ("asinh", -2.5, -1.6472311463710958, 8.953786186897676e-17),
        ("asinh", -0.7, -0.6526665660823557, -1.3538893500858175e-17),
        ("asinh", -1e-9, -1e-9, 1.6666666666666669e-28),
        ("asinh", 1e-5, 9.999999999833334e-06, 6.1824027295294845e-22),
        ("asinh", 0.3, 0.29567304756342244, -1.351693404864361e-17),
        ("asinh", 0.999, 0.8806663034322094, 4.224107114790325e-17),
        ("asinh", 2.0, 1.4436354751788103, 4.124885142212745e-17),
        ("asinh", 77.5, 5.043466737629791, -3.3229645656042943e-16),
        ("asinh", 1e200, 461.2101657793691, -2.3993297946353776e-14),
        ("exp", -600.0, 2.6503965530043108e-261, 6.377342817491395e-278),
        ("exp", 709.0, 8.218407461554972e+307, -1.955965507696277e+291),
        ("exp", 709.78, 1.7928227943945155e+308, 8.276293660642251e+291),
        ("exp_m1", 709.0, 8.218407461554972e+307, -1.955965507696277e+291),
        ("exp_m1", -709.5, -1.0, 0.0),
        ("sinh", 45.0, 1.7467135528742547e+19, 218.01739861670305),
        ("sinh", -710.4, -1.6663642832806496e+308, -6.844817567326341e+290),
        ("cosh", 45.0, 1.7467135528742547e+19, 218.01739861670305),
        ("cosh", -709.0, 4.109203730777486e+307, -9.779827538481386e+290),
        ("cosh", 710.4, 1.6663642832806496e+308, 6.844817567326341e+290),
        ("ln", 1e+308, 709.1962086421661, -1.3557607434536328e-14),
        ("ln", 1e-308, -709.1962086421661, 1.3477913123503017e-14),
        ("ln", 1.000000001, 1.000000082240371e-09, -7.801400238815362e-27),
        ("ln", 5e-324, -744.4400719213812, -4.422444340918698e-14),
        ("ln_1p", 1e+308, 709.1962086421661, -1.3557607434536328e-14),
        ("asinh", -1.7976931348623157e+308, -710.475860073944, 3.5071590463208723e-14),
    ];

    #[test]
    fn functions_have_thirty_digits() {
        for (name, function) in FUNCTIONS {
            let cases: Vec<_> = VALUES.iter().filter(|case| case.0 == name).collect();
            assert!(cases.len() >= 6, "{name}");
            for &&(_, x, hi, lo) in &cases {
                let error = ((function(Quad::from(x)) - Quad(hi, lo)).0 / hi).abs();
                // Some ten roundings of 1e-32; scaling by powers of two costs the exponential a few more.
                assert!(error < 2e-30, "{name}({x}): {error:e}");
            }
        }
    }

    /// Where values leave the range of doubles they are infinite, zero or one.
    #[test]
    fn beyond_the_range() {
        let infinite = Quad::INFINITY;
        for x in [710.0, 1e6, f64::MAX, f64::INFINITY].map(Quad::from) {
            assert_eq!([Scalar::exp(x), x.exp_m1()], [infinite; 2], "{x:?}");
            let falling = [Scalar::exp(scaled(-x, 1)), (-x).exp_m1(), Scalar::tanh(-x)];
            assert_eq!(falling.map(Real::to_f64), [0.0, -1.0, -1.0], "{x:?}");
        }
        for x in [711.0, 1e6, f64::MAX, f64::INFINITY].map(Quad::from) {
            assert_eq!([Scalar::cosh(x), Scalar::cosh(-x), Scalar::sinh(x)], [infinite; 3], "{x:?}");
            assert_eq!(Scalar::sinh(-x), -infinite, "{x:?}");
        }
        let (zero, below) = (Quad::ZERO, Quad::from(-1e-300));
        assert_eq!([Scalar::ln(infinite), Scalar::ln_1p(infinite), -Scalar::ln(zero)], [infinite; 3]);
        assert!(
            [Scalar::ln(below), Scalar::ln(Quad::NAN), Scalar::exp(Quad::NAN)].iter().all(|v| v.0.is_nan())
        );
    }

    /// Sine and cosine of large angles, computed with 60 digits, and none of larger ones.
    #[test]
    fn large_angles() {
        for (angle, sine, cosine) in [
            (100000.0, 0.03574879797201651, -0.9993608074382124),
            (-1000000000000000.0, -0.8582727931702359, -0.5131937377869703),
            (1.4e+16, -0.9525296565795657, -0.3044458134650805),
        ] {
            let error = |value: Quad, expected: f64| (value.0 - expected).abs();
            let x = Quad::from(angle);
            assert!(
                error(Scalar::sin(x), sine) < angle * 2e-32 + 2e-16,
                "sin({angle:e}): {:?}",
                Scalar::sin(x)
            );
            assert!(
                error(Scalar::cos(x), cosine) < angle * 2e-32 + 2e-16,
                "cos({angle:e}): {:?}",
                Scalar::cos(x)
            );
        }
        for angle in [1.5e16, -1e17, 1e18, 1e22, 1e300, f64::MAX, f64::INFINITY].map(Quad::from) {
            let values = [Scalar::sin(angle), Scalar::cos(angle), Scalar::tan(angle)];
            assert!(values.iter().all(|value| value.0.is_nan()), "{angle:?}: {values:?}");
        }
    }

    #[test]
    fn signs_sizes_and_edges() {
        let (a, b) = (Quad(3e200, 0.0), Quad(-4e200, 0.0));
        assert!((a.hypot(b).0 / 5e200 - 1.0).abs() < 1e-15);
        assert_eq!(b.copysign(a), Quad(4e200, -0.0));
        assert!(Scalar::sqrt(b).0.is_nan() && !Real::is_finite(Quad::INFINITY) && Real::is_finite(a));
        assert_eq!(
            [Scalar::cbrt(Quad::ZERO), Quad::ZERO.ln_1p(), Quad::ZERO.hypot(Quad::ZERO)],
            [Quad::ZERO; 3]
        );
        assert_eq!(Quad::constant(0.1, 1e-18).to_f64(), 0.1);
        assert_eq!(Quad::constant(f64::NEG_INFINITY, 0.0), -Quad::INFINITY);
        assert!(Quad::constant(f64::NAN, 0.0).0.is_nan());
        // As those of doubles.
        for x in [0.0, -3.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for y in [0.0, 4.0, f64::NAN, f64::INFINITY] {
                let (own, double) = (Quad::from(x).hypot(Quad::from(y)).0, Real::hypot(x, y));
                assert!(own == double || own.is_nan() && double.is_nan(), "{x} {y}: {own} {double}");
            }
        }
    }
}
