//! Colours that stay apart with any colour vision.

/// Red, green, blue.
pub(super) type Colour = (u8, u8, u8);

/// Text and axes.
pub(super) const INK: Colour = (40, 40, 40);
/// Grid lines.
pub(super) const GRID: Colour = (222, 222, 222);
/// Paper.
pub(super) const PAPER: Colour = (255, 255, 255);

/// Okabe and Ito's palette without black and yellow, which do not stand on white paper or are taken by text
/// (M. Okabe, K. Ito, Color Universal Design, 2008).
const CATEGORIES: [Colour; 6] =
    [(0, 114, 178), (213, 94, 0), (0, 158, 115), (204, 121, 167), (86, 180, 233), (230, 159, 0)];

/// Colour of the `index`-th category; repeats after [`category_count`].
pub(super) fn category(index: usize) -> Colour {
    CATEGORIES[index % CATEGORIES.len()]
}

/// Number of colours that [`category`] tells apart.
pub(super) const fn category_count() -> usize {
    CATEGORIES.len()
}

/// Every eighth of the dark part of viridis (S. van der Walt, N. Smith, 2015), which grows evenly in lightness:
/// the yellow end is left out, since it does not stand on white paper.
const SEQUENCE: [Colour; 8] = [
    (68, 1, 84),
    (71, 40, 120),
    (62, 74, 137),
    (49, 104, 142),
    (38, 130, 142),
    (31, 158, 137),
    (64, 183, 112),
    (133, 204, 60),
];

/// Colour of the fraction 0 (early, dark) to 1 (late, bright) of a time interval.
pub(super) fn early_to_late(fraction: f64) -> Colour {
    let last = SEQUENCE.len() - 1;
    let place = fraction.clamp(0.0, 1.0) * last as f64;
    let below = (place.floor() as usize).min(last - 1);
    let weight = place - below as f64;
    let mix = |a: u8, b: u8| (f64::from(a) + weight * (f64::from(b) - f64::from(a))).round() as u8;
    let (a, b) = (SEQUENCE[below], SEQUENCE[below + 1]);
    (mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_colours_run_from_end_to_end() {
        assert_eq!(early_to_late(0.0), SEQUENCE[0]);
        assert_eq!(early_to_late(1.0), SEQUENCE[7]);
        assert_eq!(early_to_late(0.5), (44, 117, 142), "half way between the fourth and the fifth");
    }
}
