//! A rectangle with axes: linear, or logarithmic to base 10.

use super::canvas::{Canvas, Lettering, Pen, Spot};
use super::palette::{GRID, INK};

/// Height of the figures at axes.
const FIGURES: f64 = 11.0;
/// Height of the names of axes.
const NAMES: f64 = 12.0;
/// Digits behind the first that tell doubles from each other.
const MOST_DIGITS: f64 = 16.0;

/// One direction of a [`Panel`].
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    scale: Scale,
    from: f64,
    to: f64,
    /// Values with their labels; an empty label leaves a grid line.
    ticks: Vec<(f64, String)>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Scale {
    Linear,
    Logarithmic,
}

impl Axis {
    /// A linear axis over the finite ones among the values, with about `count` ticks at multiples of 1, 2 or 5
    /// times a power of ten.
    pub(super) fn linear(values: impl IntoIterator<Item = f64>, count: usize) -> Self {
        let (low, high) = bounds(values).unwrap_or((0.0, 1.0));
        let margin = if high > low { 0.05 * (high - low) } else { 0.5 * (1.0 + high.abs()) };
        Self::ticked(low - margin, high + margin, count)
    }

    /// A linear axis from one value to another, for what fills it from end to end.
    pub(super) fn tight(from: f64, to: f64, count: usize) -> Self {
        if from == to { Self::linear([from], count) } else { Self::ticked(from, to, count) }
    }

    fn ticked(from: f64, to: f64, count: usize) -> Self {
        let spacing = round_spacing((to - from).abs() / count as f64);
        let (low, high) = (from.min(to), from.max(to));
        // The slack keeps a tick at an end that rounding has moved.
        let first = (low / spacing - 1e-9).ceil() as i64;
        let last = (high / spacing + 1e-9).floor() as i64;
        // Between the least numbers there are no others.
        let multiples = (first..=last).take_while(|_| spacing > 0.0);
        let ticks = multiples.map(|k| k as f64 * spacing).map(|v| (v, figure(v, spacing))).collect();
        Self { scale: Scale::Linear, from, to, ticks }
    }

    /// A logarithmic axis that holds the positive finite ones among the values, labelled by `label` at no more
    /// than `count` powers of ten; where the values lie within about two decades, at 1, 2 and 5 times each of
    /// them.
    pub(super) fn decades(
        values: impl IntoIterator<Item = f64>,
        count: usize,
        label: impl Fn(f64) -> String,
    ) -> Self {
        let positive = values.into_iter().filter(|&v| v > 0.0);
        let (low, high) = bounds(positive).unwrap_or((1.0, 10.0));
        // Marks do not touch the frame. A quotient of all that doubles hold is none.
        let margin = 1.15 * 10_f64.powf(0.03 * (high.log10() - low.log10()));
        let (low, high) = ((low / margin).max(f64::from_bits(1)), (high * margin).min(f64::MAX));
        let (first, last) = (low.log10().floor() as i32, high.log10().ceil() as i32);
        let round = || (first..=last).flat_map(|k| [1, 2, 5].map(|m| decimal(m, k)));
        let round = || round().filter(|v| *v > 0.0 && v.is_finite());
        let from = round().rfind(|&v| v <= low).unwrap_or(low);
        let to = round().find(|&v| v >= high).unwrap_or(high);
        let inside = |v: &f64| from <= *v && *v <= to;
        let ticks = if high / low <= 150.0 {
            round().filter(inside).map(|v| (v, label(v))).collect()
        } else {
            let powers: Vec<f64> = (first..=last).map(|k| decimal(1, k)).filter(inside).collect();
            let stride = powers.len().div_ceil(count);
            // Labels start from the largest value, the coarse end of errors.
            let labelled = |index: usize| (powers.len() - 1 - index).is_multiple_of(stride);
            let text = |index: usize| if labelled(index) { label(powers[index]) } else { String::new() };
            powers.iter().enumerate().map(|(index, &v)| (v, text(index))).collect()
        };
        Self { scale: Scale::Logarithmic, from, to, ticks }
    }

    /// The same axis, running the other way.
    pub(super) fn reversed(self) -> Self {
        Self { from: self.to, to: self.from, ..self }
    }

    /// Replaces the label of the tick at a value, if there is one.
    pub(super) fn relabel(mut self, value: f64, label: &str) -> Self {
        if let Some(tick) = self.ticks.iter_mut().find(|tick| tick.0 == value) {
            tick.1 = label.to_owned();
        }
        self
    }

    /// Place of a value along the axis: 0 where it begins, 1 where it ends; not finite for what has no place.
    fn place(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.from) / (self.to - self.from),
            Scale::Logarithmic => (value.log10() - self.from.log10()) / (self.to.log10() - self.from.log10()),
        }
    }
}

/// The double nearest to `m 10^k`, which a product of doubles is not.
pub(super) fn decimal(m: u32, k: i32) -> f64 {
    format!("{m}e{k}").parse().unwrap_or(f64::NAN)
}

/// 1, 2 or 5 times a power of ten, at or above a spacing.
fn round_spacing(spacing: f64) -> f64 {
    let power = 10f64.powf(spacing.log10().floor());
    let multiple = [1.0, 2.0, 5.0].into_iter().find(|m| m * power >= spacing * (1.0 - 1e-9));
    multiple.unwrap_or(10.0) * power
}

/// A figure with the digits that tell it from its neighbours at the spacing: a small or large one with an exponent, where that is
/// shorter.
fn figure(value: f64, spacing: f64) -> String {
    let exponent = |value: f64| (value.log10() + 1e-9).floor();
    let decimals = (-exponent(spacing)).max(0.0) as usize;
    // Multiples of the spacing come out as -0 too.
    let value = if value.abs() < 0.5 * spacing { 0.0 } else { value };
    let digits = (exponent(value.abs()) - exponent(spacing)).clamp(1.0, MOST_DIGITS) as usize;
    let scientific = format!("{value:.digits$e}");
    if decimals <= 4 && value.abs() < 1e6 {
        return format!("{value:.decimals$}");
    }
    // Nothing with that many zeros is shorter.
    if decimals > scientific.len() || value.abs() >= 1e17 {
        return scientific;
    }
    let plain = format!("{value:.decimals$}");
    if plain.len() <= scientific.len() { plain } else { scientific }
}

/// About how wide a label at an axis is.
fn width(label: &str) -> f64 {
    0.6 * FIGURES * label.chars().count() as f64
}

/// A time to about a hundredth of the interval it belongs to.
pub(super) fn brief_time(t: f64, span: f64) -> String {
    if span == 0.0 { format!("{t}") } else { figure(t, round_spacing(span.abs() / 100.0)) }
}

fn bounds(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values.into_iter().filter(|v| v.is_finite()).fold(None, |bounds, v| match bounds {
        None => Some((v, v)),
        Some((low, high)) => Some((v.min(low), v.max(high))),
    })
}

/// A rectangle of the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Area {
    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }
    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }
    pub(super) fn centre(&self) -> Spot {
        ((self.left + self.right) / 2.0, (self.top + self.bottom) / 2.0)
    }
}

/// An area with a horizontal and a vertical axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Panel {
    pub(super) area: Area,
    pub(super) x: Axis,
    pub(super) y: Axis,
}

impl Panel {
    /// Where a point lies on the page; `None` for what has no place on an axis.
    pub(super) fn spot(&self, x: f64, y: f64) -> Option<Spot> {
        let Area { left, bottom, .. } = self.area;
        let spot =
            (left + self.x.place(x) * self.area.width(), bottom - self.y.place(y) * self.area.height());
        (spot.0.is_finite() && spot.1.is_finite()).then_some(spot)
    }

    /// Draws grid, axes, figures and the axes' names.
    pub(super) fn frame(&self, canvas: &mut Canvas, x_name: &str, y_name: &str) {
        let Area { left, top, right, bottom } = self.area;
        let figures = Lettering::new(FIGURES, INK);
        let grid = Pen::new(GRID, 0.7);
        // Where there is no room for a label, the grid line stays.
        let (mut last, mut of_last) = (f64::NEG_INFINITY, 0.0);
        for (value, label) in &self.x.ticks {
            let (x, own) = (left + self.x.place(*value) * self.area.width(), width(label));
            canvas.line((x, top), (x, bottom), grid);
            if !label.is_empty() && (x - last).abs() > 0.5 * (own + of_last) {
                canvas.text(label, (x, bottom + 7.0), figures.centred().below());
                (last, of_last) = (x, own);
            }
        }
        for (value, label) in &self.y.ticks {
            let y = bottom - self.y.place(*value) * self.area.height();
            canvas.line((left, y), (right, y), grid);
            if !label.is_empty() {
                canvas.text(label, (left - 7.0, y), figures.before());
            }
        }
        let edge = Pen::new(INK, 0.9);
        canvas.line((left, bottom), (right, bottom), edge);
        canvas.line((left, top), (left, bottom), edge);
        let names = Lettering::new(NAMES, INK).centred();
        canvas.text(x_name, (self.area.centre().0, bottom + 24.0), names.below());
        let widest = self.y.ticks.iter().fold(51.0, |widest, tick| width(&tick.1).max(widest));
        canvas.text(y_name, (left - 7.0 - widest, self.area.centre().1), names.upward());
    }

    /// Draws a line through points, interrupted where a point has no place.
    pub(super) fn curve(&self, canvas: &mut Canvas, points: impl Iterator<Item = (f64, f64)>, pen: Pen) {
        let mut piece = Vec::new();
        for (x, y) in points {
            match self.spot(x, y) {
                Some(spot) => piece.push(spot),
                None => canvas.polyline(piece.drain(..), pen),
            }
        }
        canvas.polyline(piece, pen);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|tick| tick.1.as_str()).filter(|label| !label.is_empty()).collect()
    }

    #[test]
    fn linear_ticks_are_round() {
        assert_eq!(labels(&Axis::tight(0.0, 10.0, 5)), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(labels(&Axis::tight(-0.31, 0.29, 5)), ["-0.2", "0.0", "0.2"]);
        assert_eq!(labels(&Axis::tight(3.0, 1.0, 4)), ["1.0", "1.5", "2.0", "2.5", "3.0"], "backward");
        assert_eq!(labels(&Axis::tight(0.0, 3e7, 3)), ["0", "1.0e7", "2.0e7", "3.0e7"]);
        assert_eq!(labels(&Axis::tight(0.0, 2e-5, 2)), ["0.0e0", "1.0e-5", "2.0e-5"]);
    }

    #[test]
    fn neighbours_have_labels_of_their_own() {
        let late = Axis::tight(1e7, 1e7 + 2.0, 4);
        assert_eq!(labels(&late), ["10000000.0", "10000000.5", "10000001.0", "10000001.5", "10000002.0"]);
        assert_eq!(labels(&Axis::tight(1.0, 1.000_004, 2)), ["1.000000", "1.000002", "1.000004"]);
        assert_eq!(labels(&Axis::tight(4.5e12, 4.52e12, 2)), ["4.50e12", "4.51e12", "4.52e12"]);
        for middle in [0.0, 1.0, -1.0, 0.3, 7e-9, 123.0, 999_999.0, -1e7, 3.3e12, 1e20, 1e-200, 1e200] {
            for part in [1.0, 1e-1, 1e-3, 1e-6, 1e-9, 1e-12] {
                let half = part * if middle == 0.0 { 1.0 } else { f64::abs(middle) };
                for count in [5, 10] {
                    let axis = Axis::tight(middle - half, middle + half, count);
                    let texts = labels(&axis);
                    assert!(texts.len() > 1 && texts.windows(2).all(|pair| pair[0] != pair[1]), "{texts:?}");
                    for (value, text) in &axis.ticks {
                        // A text is its value, to what lies between two.
                        let spacing = axis.ticks[1].0 - axis.ticks[0].0;
                        let read = text.parse().unwrap_or(f64::NAN);
                        assert!((read - value).abs() < 0.01 * spacing, "{text}");
                    }
                }
            }
        }
        assert_eq!([brief_time(1e7 + 1.25, 2.0), brief_time(0.5, 2.0)], ["10000001.25", "0.50"]);
    }

    #[test]
    fn a_single_value_and_no_value_have_an_axis() {
        for values in [vec![2.0], vec![], vec![f64::NAN, f64::INFINITY], vec![0.0, 0.0]] {
            let axis = Axis::linear(values, 4);
            assert!(axis.to > axis.from && axis.ticks.len() >= 2, "{axis:?}");
        }
        let axis = Axis::decades([0.0, f64::NAN], 4, |v| format!("{v:e}"));
        assert_eq!(labels(&axis), ["5e-1", "1e0", "2e0", "5e0", "1e1", "2e1"], "no positive value");
    }

    #[test]
    fn axes_hold_all_that_doubles_hold() {
        let axis = Axis::decades([5e-324, 1.0, 1e308], 6, |v| format!("{v:e}"));
        assert!(axis.ticks.len() < 700 && (2..=7).contains(&labels(&axis).len()), "{:?}", labels(&axis));
        for (value, place) in [(5e-324, 0.0), (1e-8, 0.5), (f64::MAX, 1.0)] {
            assert!((axis.place(value) - place).abs() < 0.01, "{value:e}: {}", axis.place(value));
        }
        for values in [[-5e-324, 5e-324], [0.0, 1e-323], [-1e308, 1e308]] {
            assert!(Axis::linear(values, 5).ticks.len() < 12, "{values:?}");
        }
    }

    #[test]
    fn decades_hold_the_values_and_few_labels() {
        // The margin of 1.15 (1.3e11)^0.03 = 2.5 takes the ends to 1e-14 and 1e-2.
        let axis = Axis::decades([3e-14, 4e-3, f64::NAN, 0.0], 6, |v| format!("{v:e}"));
        assert_eq!((axis.from, axis.to), (1e-14, 1e-2));
        assert_eq!(axis.ticks.len(), 13);
        assert_eq!(labels(&axis), ["1e-14", "1e-11", "1e-8", "1e-5", "1e-2"]);
        assert_eq!(axis.place(1e-8), 0.5);
        assert_eq!(axis.reversed().place(1e-14), 1.0);
    }

    #[test]
    fn narrow_ranges_have_ticks_within_the_decade() {
        let axis = Axis::decades([1.3e-17, 7e-17], 6, |v| format!("{v:e}"));
        assert_eq!(labels(&axis), ["1e-17", "2e-17", "5e-17", "1e-16"]);
        let one = Axis::decades([3.0], 6, |v| format!("{v:e}"));
        assert_eq!(labels(&one), ["2e0", "5e0"]);
        assert_eq!(labels(&one.relabel(5.0, "five")), ["2e0", "five"]);
    }

    /// On an axis of ten ticks there is room for every other long label, and the name of the other axis stands beside its labels.
    #[test]
    fn long_labels_have_room() {
        let area = Area { left: 84.0, top: 0.0, right: 610.0, bottom: 130.0 };
        let panel = Panel { area, x: Axis::tight(1e7, 1e7 + 2.0, 10), y: Axis::tight(1.0, 1.000_000_004, 2) };
        let drawn = Canvas::draw(700, 200, |canvas| panel.frame(canvas, "t", "q"));
        assert_eq!((panel.x.ticks.len(), drawn.matches(">10000000").count()), (11, 3), "{drawn}");
        assert!(drawn.contains(">10000000.0<") && drawn.contains(">10000000.4<"), "{drawn}");
        let name = drawn.lines().find(|line| line.contains(">q<")).unwrap_or_default();
        let x = name.split(['"', '(', ' ', ',']).filter_map(|word| word.parse::<f64>().ok()).next();
        assert!(x.is_some_and(|x| x < 84.0 - 7.0 - 11.0 * 0.5 * FIGURES), "{name}");
    }

    #[test]
    fn a_panel_places_its_corners() {
        let area = Area { left: 10.0, top: 20.0, right: 110.0, bottom: 70.0 };
        let panel = Panel { area, x: Axis::tight(0.0, 4.0, 4), y: Axis::tight(-1.0, 1.0, 4) };
        assert_eq!(panel.spot(0.0, -1.0), Some((10.0, 70.0)));
        assert_eq!(panel.spot(1.0, 1.0), Some((35.0, 20.0)));
        assert_eq!(panel.spot(f64::NAN, 0.0), None);
    }
}
