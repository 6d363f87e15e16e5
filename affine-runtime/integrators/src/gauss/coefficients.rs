//! Coefficients of the Gauss collocation methods (Kuntzmann-Butcher) of 2, 3, 4 and 6 stages.
//!
//! Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd edition, Springer 2006, section
//! II.1.3: nodes are the roots of the shifted Legendre polynomial, weights and matrix integrals of the Lagrange
//! polynomials through them. What is stored is not `a_ij` but `mu_ij = a_ij/b_j`, whose condition of symplecticity
//! `mu_ij + mu_ji = 1` doubles fulfil exactly (M. Antonana, J. Makazaga, A. Murua, Numer. Algorithms 76 (2017)
//! 861-880): rounded `a_ij` would make quadratic invariants drift.
//!
//! More stages cost fewer evaluations from an error of about 1e-9 on, where iterations start close to what they seek:
//! `cargo run --release --example work_precision -- symplectic`.

#[cfg(test)]
pub(crate) mod legendre_roots;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod order_conditions;

use crate::newton::Mode;

/// The most stages there are.
pub(super) const MOST_STAGES: usize = 6;
/// Modes of that method.
pub(super) const MODES: usize = 3;

/// A Gauss collocation method, of [`Tableau::TWO`] stages, [`Tableau::THREE`], [`Tableau::FOUR`] or [`Tableau::SIX`].
///
/// ```text
/// L_i = h b_i f(t + c_i h, y + sum_j mu_ij L_j),    y_1 = y + sum_i L_i,    mu_ij = a_ij/b_j
/// ```
#[derive(Debug, PartialEq)]
pub struct Tableau {
    pub(super) nodes: &'static [f64],
    pub(super) weights: &'static [f64],
    pub(super) ratios: [[f64; MOST_STAGES]; MOST_STAGES],
    /// Of the matrix `b_i a_ij/b_j`.
    pub(super) modes: &'static [Mode],
}

/// `mu_ij` from those below the diagonal, row by row: `mu_ji = 1 - mu_ij`, which doubles between 1/2 and 2 fulfil exactly.
const fn symplectic(below: &[&[f64]]) -> [[f64; MOST_STAGES]; MOST_STAGES] {
    let mut ratios = [[0.0; MOST_STAGES]; MOST_STAGES];
    let mut i = 0;
    while i < below.len() {
        ratios[i][i] = 0.5;
        let mut j = 0;
        while j < i {
            ratios[i][j] = below[i][j];
            ratios[j][i] = 1.0 - below[i][j];
            j += 1;
        }
        i += 1;
    }
    ratios
}

impl Tableau {
    /// Two stages, order 4.
    pub const TWO: Self = Self {
        nodes: &[0.211_324_865_405_187_1, 0.788_675_134_594_812_9],
        weights: &[0.5, 0.5],
        ratios: symplectic(&[&[], &[1.077_350_269_189_625_7]]),
        modes: &[Mode {
            eigenvalue: (0.25, 0.144_337_567_297_406_43),
            right: &[(1.0, 0.0), (0.0, -3.732_050_807_568_877)],
            left: &[(1.0, 0.0), (0.0, 0.267_949_192_431_122_7)],
        }],
    };

    /// Three stages, order 6.
    pub const THREE: Self = Self {
        nodes: &[0.112_701_665_379_258_31, 0.5, 0.887_298_334_620_741_7],
        weights: &[0.277_777_777_777_777_8, 0.444_444_444_444_444_4, 0.277_777_777_777_777_8],
        ratios: symplectic(&[
            &[],
            &[1.080_947_501_931_112_6],
            &[0.964_758_001_544_89, 1.080_947_501_931_112_6],
        ]),
        modes: &[
            Mode {
                eigenvalue: (0.142_342_788_441_943_92, 0.135_799_925_708_153_8),
                right: &[
                    (1.0, 0.0),
                    (-3.603_675_786_145_865_7, -3.517_365_070_857_906),
                    (-7.924_480_066_670_396, 5.793_026_094_808_575),
                ],
                left: &[
                    (0.567_687_886_216_141_6, 0.257_735_201_273_432_47),
                    (-0.051_372_763_302_028_605, 0.193_182_518_931_155_73),
                    (-0.031_192_119_675_403_814, -0.055_326_275_139_417_87),
                ],
            },
            Mode {
                eigenvalue: (0.215_314_423_116_112_18, 0.0),
                right: &[(1.0, 0.0), (2.635_166_257_971_907_3, 0.0), (13.859_658_089_371_628, 0.0)],
                left: &[
                    (0.432_312_113_783_858_36, 0.0),
                    (0.051_372_763_302_028_605, 0.0),
                    (0.031_192_119_675_403_814, 0.0),
                ],
            },
        ],
    };

    /// Four stages, order 8.
    pub const FOUR: Self = Self {
        nodes: &[
            0.069_431_844_202_973_71,
            0.330_009_478_207_571_87,
            0.669_990_521_792_428_1,
            0.930_568_155_797_026_3,
        ],
        weights: &[
            0.173_927_422_568_726_92,
            0.326_072_577_431_273_05,
            0.326_072_577_431_273_05,
            0.173_927_422_568_726_92,
        ],
        ratios: symplectic(&[
            &[],
            &[1.081_589_750_032_28],
            &[0.961_274_073_432_114_2, 1.085_503_751_410_519_2],
            &[1.020_440_420_684_040_7, 0.961_274_073_432_114_2, 1.081_589_750_032_28],
        ]),
        modes: &[
            Mode {
                eigenvalue: (0.091_566_240_265_717_64, 0.115_662_613_013_127_61),
                right: &[
                    (1.0, 0.0),
                    (-4.407_906_162_960_276, -2.038_079_356_626_995_2),
                    (1.956_350_560_873_687_5, 14.172_079_476_546_111),
                    (20.006_393_348_887_375, 2.451_429_585_978_250_4),
                ],
                left: &[
                    (0.262_764_938_774_174_9, 0.360_939_595_053_997),
                    (-0.106_602_058_395_206_38, 0.131_174_083_173_971_45),
                    (-0.017_945_385_679_590_583, -0.054_497_473_560_133_82),
                    (0.015_117_700_182_453_21, 0.016_188_805_843_547_73),
                ],
            },
            Mode {
                eigenvalue: (0.158_433_759_734_282_36, 0.047_441_012_571_108_436),
                right: &[
                    (1.0, 0.0),
                    (-0.183_973_085_212_134_43, -2.179_323_672_288_696_4),
                    (0.975_706_178_857_198, -15.154_242_246_930_496),
                    (-17.520_351_737_427_564, -33.356_205_315_130_055),
                ],
                left: &[
                    (0.737_235_061_225_825_2, 0.256_157_940_742_097_63),
                    (0.106_602_058_395_206_38, 0.129_570_862_711_988_4),
                    (0.017_945_385_679_590_583, 0.016_183_951_073_785_927),
                    (-0.015_117_700_182_453_21, 0.014_161_312_178_817_012),
                ],
            },
        ],
    };

    /// Six stages, order 12.
    pub const SIX: Self = Self {
        nodes: &[
            0.033_765_242_898_423_99,
            0.169_395_306_766_867_73,
            0.380_690_406_958_401_56,
            0.619_309_593_041_598_5,
            0.830_604_693_233_132_2,
            0.966_234_757_101_576,
        ],
        weights: &[
            0.085_662_246_189_585_18,
            0.180_380_786_524_069_3,
            0.233_956_967_286_345_52,
            0.233_956_967_286_345_52,
            0.180_380_786_524_069_3,
            0.085_662_246_189_585_18,
        ],
        ratios: symplectic(&[
            &[],
            &[1.081_847_553_066_453_7],
            &[0.960_142_026_054_455_5, 1.086_768_530_677_668_7],
            &[1.024_230_345_072_584_5, 0.955_704_861_622_852_6, 1.087_548_270_022_611],
            &[
                0.984_175_513_533_873_8,
                1.027_093_755_505_859,
                0.955_704_861_622_852_6,
                1.086_768_530_677_668_7,
            ],
            &[
                1.009_488_195_878_799_8,
                0.984_175_513_533_873_8,
                1.024_230_345_072_584_5,
                0.960_142_026_054_455_5,
                1.081_847_553_066_453_7,
            ],
        ]),
        modes: &[
            Mode {
                eigenvalue: (0.047_445_308_948_037_716, 0.084_722_574_097_167_07),
                right: &[
                    (1.0, 0.0),
                    (-4.257_140_289_149_59, -0.776_972_096_449_64),
                    (10.234_510_685_030_356, 6.724_385_520_614_899_5),
                    (-7.077_362_301_712_117, -29.518_626_557_565_394),
                    (-51.020_064_899_415_45, 29.729_474_385_012_91),
                    (7.021_261_990_412_893, 55.677_952_700_415_86),
                ],
                left: &[
                    (-0.125_976_859_313_230_35, 0.247_238_351_726_418_03),
                    (-0.138_327_494_223_026_84, -0.009_571_876_714_017_007),
                    (0.019_430_129_548_464_6, -0.051_406_410_614_278_42),
                    (0.008_486_384_568_091_747, 0.020_481_834_028_345_528),
                    (-0.007_243_870_064_857_716, -0.007_126_252_689_867_122),
                    (0.004_090_139_281_410_339, 0.002_778_385_182_688_947),
                ],
            },
            Mode {
                eigenvalue: (0.089_573_203_698_748_52, 0.062_971_624_731_703_06),
                right: &[
                    (1.0, 0.0),
                    (-2.889_770_684_538_573_8, -1.509_135_618_155_344_1),
                    (-2.444_867_118_885_888_6, 3.691_277_699_418_055_4),
                    (0.777_421_693_432_839_3, 31.465_922_672_020_593),
                    (117.126_202_557_041_11, 44.094_266_232_358_84),
                    (150.507_270_581_181_67, -55.767_229_940_077_02),
                ],
                left: &[
                    (0.180_005_857_266_740_12, 0.679_341_340_526_739_9),
                    (-0.114_569_311_431_665_27, 0.233_656_830_189_088_45),
                    (-0.050_333_391_979_239_69, -0.003_585_968_434_909_203_4),
                    (-0.005_515_616_175_172_169, -0.004_467_792_712_745_377),
                    (0.003_698_552_892_485_163_4, -0.005_681_043_104_639_423),
                    (-0.000_418_935_544_869_136_5, 0.004_358_450_346_836_401),
                ],
            },
            Mode {
                eigenvalue: (0.112_981_487_353_213_77, 0.023_070_678_358_901_354),
                right: &[
                    (1.0, 0.0),
                    (-1.651_325_212_509_998, -0.724_429_639_115_754_4),
                    (4.319_190_145_122_845, -3.997_765_983_114_966_6),
                    (-3.723_300_453_259_860_4, -36.519_789_771_135_73),
                    (-63.649_750_880_739_774, -154.303_080_282_233_08),
                    (-150.567_588_706_698_2, -203.015_558_263_621_93),
                ],
                left: &[
                    (0.945_971_002_046_490_2, 0.453_687_590_885_617),
                    (0.252_896_805_654_692_1, 0.210_473_886_054_431_18),
                    (0.030_903_262_430_775_087, 0.046_449_262_467_535_724),
                    (-0.002_970_768_392_919_578, 0.008_436_775_967_321_58),
                    (0.003_545_317_172_372_553, -0.000_255_878_204_998_844_15),
                    (-0.003_671_203_736_541_202, 0.001_936_830_414_119_641),
                ],
            },
        ],
    };

    /// The method of `stages` stages, 2, 3, 4 or 6.
    #[must_use]
    pub fn of_stages(stages: usize) -> Option<&'static Self> {
        match stages {
            2 => Some(&Self::TWO),
            3 => Some(&Self::THREE),
            4 => Some(&Self::FOUR),
            6 => Some(&Self::SIX),
            _ => None,
        }
    }

    /// Nodes and weights of the quadrature on [0, 1], exact for polynomials of degree `2 stages - 1`.
    pub(crate) fn quadrature(&self) -> impl Iterator<Item = (f64, f64)> {
        self.nodes.iter().copied().zip(self.weights.iter().copied())
    }

    /// Number of stages.
    #[must_use]
    pub fn stages(&self) -> usize {
        self.nodes.len()
    }

    /// Order, twice the number of stages.
    #[must_use]
    pub fn order(&self) -> usize {
        2 * self.stages()
    }

    /// `w_j` with `L = sum_j w_j L_j` the increment that the polynomial of slopes through `L_j/(h b_j)` at the
    /// nodes gives at `theta`, for a stage of weight `weight` in a step `scale` times as long.
    pub(super) fn continuation(&self, theta: f64, weight: f64, scale: f64) -> [f64; MOST_STAGES] {
        let mut coefficients = [0.0; MOST_STAGES];
        for (j, coefficient) in coefficients.iter_mut().enumerate().take(self.stages()) {
            let others = self.nodes.iter().enumerate().filter(|(k, _)| *k != j);
            let basis: f64 = others.map(|(_, node)| (theta - node) / (self.nodes[j] - node)).product();
            *coefficient = scale * weight / self.weights[j] * basis;
        }
        coefficients
    }
}
