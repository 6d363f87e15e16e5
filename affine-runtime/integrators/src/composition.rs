//! Symmetric compositions of symmetric steps of order 2: a step `h` is made of steps `w_1 h, w_2 h, ..., w_1 h`.
//!
//! Order 4: M. Suzuki, Phys. Lett. A 146 (1990) 319-323, five steps, `w_1 = w_2 = 1/(4 - 4^(1/3))`. Orders 6 and 8: W.
//! Kahan, R.-C. Li, Math. Comp. 66 (1997) 1089-1099, methods s9odr6a and s17odr8a; among compositions of so many steps
//! they have the smallest errors on most problems (Hairer, Lubich, Wanner, Geometric Numerical Integration, section
//! V.3.2).

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod order_conditions;

/// A symmetric composition: [`Composition::of_order`].
#[derive(Debug, PartialEq)]
pub struct Composition {
    order: usize,
    /// The first half; the one in the middle is what is left to 1, so that steps add up to the whole in doubles.
    outer: &'static [f64],
}

impl Composition {
    const TWO: Self = Self { order: 2, outer: &[] };
    const FOUR: Self = Self { order: 4, outer: &[0.414_490_771_794_375_74, 0.414_490_771_794_375_74] };
    const SIX: Self = Self {
        order: 6,
        outer: &[
            0.392_161_444_007_314_1,
            0.332_599_136_789_359_44,
            -0.706_246_172_557_639_4,
            0.082_213_596_293_550_8,
        ],
    };
    const EIGHT: Self = Self {
        order: 8,
        outer: &[
            0.130_202_483_088_890_08,
            0.561_162_981_775_108_4,
            -0.389_474_962_644_847_3,
            0.158_841_906_555_155_6,
            -0.395_903_894_133_237_57,
            0.184_539_640_978_315_7,
            0.258_374_387_686_322,
            0.295_011_723_609_310_3,
        ],
    };

    /// The composition of order 2 (one step), 4 (five), 6 (nine) or 8 (seventeen).
    #[must_use]
    pub fn of_order(order: usize) -> Option<&'static Self> {
        match order {
            2 => Some(&Self::TWO),
            4 => Some(&Self::FOUR),
            6 => Some(&Self::SIX),
            8 => Some(&Self::EIGHT),
            _ => None,
        }
    }

    /// Order of the composition.
    #[must_use]
    pub fn order(&self) -> usize {
        self.order
    }

    /// Number of steps that it is made of.
    #[must_use]
    pub fn steps(&self) -> usize {
        2 * self.outer.len() + 1
    }

    /// Their lengths, in parts of the whole.
    pub fn weights(&self) -> impl Iterator<Item = f64> + '_ {
        let middle = 1.0 - 2.0 * self.outer.iter().sum::<f64>();
        self.outer.iter().copied().chain([middle]).chain(self.outer.iter().rev().copied())
    }
}
