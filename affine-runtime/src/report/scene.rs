//! The motion in space: the body at a few times, and the path of its centre of mass.

use super::axes::{Area, decimal};
use super::canvas::{Canvas, Lettering, Pen, Spot};
use super::palette::{Colour, INK, early_to_late};
use super::view::{Planar, View};
use crate::frames::{Matrix, Vector};

/// A body at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Body<const N: usize> {
    pub(super) x: Vector<N>,
    pub(super) phi: Matrix<N>,
    /// Place of the time in the interval of the trajectory, 0 to 1.
    pub(super) fraction: f64,
}

/// Opacity of a body's surface: what lies behind stays visible.
const FILLING: f64 = 0.16;

/// What is drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scene<const N: usize> {
    pub(super) bodies: Vec<Body<N>>,
    /// Path of the centre of mass with fractions of time; empty for a body without translation.
    pub(super) path: Vec<(f64, Vector<N>)>,
}

/// From the picture plane to the page, with one scale for both directions.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fit {
    middle: Planar,
    spot: Spot,
    scale: f64,
}

impl Fit {
    /// Everything in the middle of the area, as large as it can be.
    fn new(points: impl Iterator<Item = Planar>, area: &Area) -> Self {
        let finite = points.filter(|(x, y)| x.is_finite() && y.is_finite());
        let box_of = finite.fold(None, |extent: Option<(Planar, Planar)>, (x, y)| match extent {
            None => Some(((x, y), (x, y))),
            Some((low, high)) => Some(((low.0.min(x), low.1.min(y)), (high.0.max(x), high.1.max(y)))),
        });
        let (low, high) = box_of.unwrap_or(((-1.0, -1.0), (1.0, 1.0)));
        let scale = (area.width() / (high.0 - low.0)).min(area.height() / (high.1 - low.1));
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let middle = ((low.0 + high.0) / 2.0, (low.1 + high.1) / 2.0);
        Self { middle, spot: area.centre(), scale }
    }

    fn spot(&self, (x, y): Planar) -> Spot {
        (self.spot.0 + self.scale * (x - self.middle.0), self.spot.1 - self.scale * (y - self.middle.1))
    }
}

impl<const N: usize> Scene<N> {
    /// Draws bodies and path into the area, and the axes of space at a spot. Bodies that stay where they are stand side by side,
    /// in reading order: on top of one another they hide what they do. So do bodies of the plane that would cover one another,
    /// and their path has an area of its own.
    pub(super) fn paint(&self, canvas: &mut Canvas, area: &Area, path_alone: &Area, axes: Spot) {
        let view = View::<N>::new();
        let outlines: Vec<Vec<Planar>> = self.bodies.iter().map(|body| view.outline(&body.phi)).collect();
        let centres: Vec<Planar> = self.bodies.iter().map(|body| view.project(&body.x)).collect();
        let is_apart = self.path.is_empty() || (N == 2 && cover(&outlines, &centres));
        let places = if is_apart { side_by_side(&outlines) } else { centres };
        let outlines: Vec<Vec<Planar>> = outlines
            .into_iter()
            .zip(&places)
            .map(|(outline, place)| shifted(outline, *place).collect())
            .collect();
        let path: Vec<(f64, Planar)> = self.path.iter().map(|(s, x)| (*s, view.project(x))).collect();
        let along = || path.iter().map(|point| point.1);
        let with_path = along().filter(|_| !is_apart);
        let fit = Fit::new(outlines.iter().flatten().copied().chain(with_path), area);

        for ((body, outline), &place) in self.bodies.iter().zip(&outlines).zip(&places) {
            let colour = early_to_late(body.fraction);
            let outline: Vec<Spot> = outline.iter().map(|&point| fit.spot(point)).collect();
            canvas.polygon(outline.iter().copied(), colour, FILLING);
            for mark in view.marks(&body.phi) {
                let spots = shifted(mark, place).map(|point| fit.spot(point));
                canvas.polyline(spots, Pen::new(colour, 0.9).opacity(0.6));
            }
            canvas.polyline(outline.iter().chain(outline.first()).copied(), Pen::new(colour, 1.6));
        }
        let fit_of_path = if is_apart { Fit::new(along(), path_alone) } else { fit };
        self.paint_path(canvas, &view, &path, &fit_of_path);
        if is_apart && !path.is_empty() {
            let heading = (path_alone.left, path_alone.top - 14.0);
            canvas.text("path of the centre", heading, Lettering::new(11.0, INK));
        }
        axes_of_space(&view, canvas, axes, fit.scale);
    }

    fn paint_path(&self, canvas: &mut Canvas, view: &View<N>, path: &[(f64, Planar)], fit: &Fit) {
        for (fraction, piece) in coloured_pieces(path) {
            let pen = Pen::new(early_to_late(fraction), 1.6);
            canvas.polyline(piece.iter().map(|&point| fit.spot(point)), pen);
        }
        for body in self.bodies.iter().filter(|_| !path.is_empty()) {
            canvas.disc(fit.spot(view.project(&body.x)), 3.0, early_to_late(body.fraction));
        }
    }
}

/// Do bodies with these outlines cover one another about these centres? By the discs that hold them.
fn cover(outlines: &[Vec<Planar>], centres: &[Planar]) -> bool {
    let reach = |outline: &Vec<Planar>| outline.iter().map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
    let discs: Vec<(f64, Planar)> = outlines.iter().map(reach).zip(centres.iter().copied()).collect();
    discs
        .iter()
        .enumerate()
        .any(|(k, (own, (x, y)))| discs[..k].iter().any(|(other, (u, v))| (x - u).hypot(y - v) < own + other))
}

fn shifted(points: Vec<Planar>, by: Planar) -> impl Iterator<Item = Planar> {
    points.into_iter().map(move |(x, y)| (x + by.0, y + by.1))
}

/// Bodies side by side in one row.
const IN_A_ROW: usize = 3;
/// Distance of their centres, in widths or heights of the largest.
const SPACING: f64 = 1.08;

/// Centres of bodies on a grid with room for the largest, in reading order.
fn side_by_side(outlines: &[Vec<Planar>]) -> Vec<Planar> {
    let reach = |coordinate: fn(&Planar) -> f64| {
        outlines.iter().flatten().map(coordinate).fold(0.0, |reach: f64, c| reach.max(c.abs()))
    };
    let (width, height) = (2.0 * SPACING * reach(|point| point.0), 2.0 * SPACING * reach(|point| point.1));
    let place = |k: usize| ((k % IN_A_ROW) as f64 * width, -((k / IN_A_ROW) as f64) * height);
    (0..outlines.len()).map(place).collect()
}

/// Colours along the path: that many.
const COLOURS_OF_PATH: usize = 32;

/// The path cut where its colour changes, each piece with the fraction of time that colours it.
fn coloured_pieces(path: &[(f64, Planar)]) -> Vec<(f64, Vec<Planar>)> {
    let step = |fraction: f64| (fraction * COLOURS_OF_PATH as f64).floor();
    let mut pieces: Vec<(f64, Vec<Planar>)> = Vec::new();
    for ends in path.windows(2) {
        let ((s, from), (_, to)) = (ends[0], ends[1]);
        match pieces.last_mut() {
            Some((begun, piece)) if step(*begun) == step(s) => piece.push(to),
            _ => pieces.push((s, vec![from, to])),
        }
    }
    pieces
}

/// Room for the arrows of the axes.
const ARROW: f64 = 48.0;

/// Arrows along the axes of space from a spot, of one length in space that is a round number: the scale of the
/// picture.
fn axes_of_space<const N: usize>(view: &View<N>, canvas: &mut Canvas, origin: Spot, scale: f64) {
    let length = round_length(ARROW / scale);
    let (pen, letters) = (Pen::new(INK, 1.1), Lettering::new(11.0, INK).centred());
    for axis in 0..N {
        let mut arrow = Vector::<N>::zeros();
        arrow[axis] = length * scale;
        let (x, y) = view.project(&arrow);
        let tip = (origin.0 + x, origin.1 - y);
        canvas.line(origin, tip, pen);
        arrow_head(canvas, origin, tip, INK);
        let reach = x.hypot(y);
        let label = (tip.0 + 10.0 * x / reach, tip.1 - 10.0 * y / reach);
        canvas.text(&format!("x{}", axis + 1), label, letters);
    }
    let caption = format!("length of arrows: {length}");
    canvas.text(&caption, (origin.0 - ARROW, origin.1 + ARROW), Lettering::new(11.0, INK));
}

fn arrow_head(canvas: &mut Canvas, from: Spot, tip: Spot, colour: Colour) {
    let (dx, dy) = (tip.0 - from.0, tip.1 - from.1);
    let reach = dx.hypot(dy);
    let (ux, uy) = (dx / reach, dy / reach);
    let back = (tip.0 - 6.0 * ux, tip.1 - 6.0 * uy);
    let corners = [tip, (back.0 - 2.5 * uy, back.1 + 2.5 * ux), (back.0 + 2.5 * uy, back.1 - 2.5 * ux)];
    canvas.polygon(corners, colour, 1.0);
}

/// 1, 2 or 5 times a power of ten, at or below a length.
fn round_length(length: f64) -> f64 {
    let exponent = length.log10().floor() as i32;
    let candidates = [1, 2, 5, 10].map(|m| decimal(m, exponent));
    candidates.into_iter().rfind(|&c| c <= length * (1.0 + 1e-9)).unwrap_or(length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fit_keeps_proportions_and_fills_the_area() {
        let area = Area { left: 0.0, top: 0.0, right: 200.0, bottom: 100.0 };
        let fit = Fit::new([(-1.0, 0.0), (1.0, 4.0), (f64::NAN, 9.0)].into_iter(), &area);
        assert_eq!(fit.scale, 25.0, "the height decides");
        assert_eq!(fit.spot((0.0, 0.0)), (100.0, 100.0));
        assert_eq!(fit.spot((0.0, 4.0)), (100.0, 0.0));
        let point = Fit::new([(3.0, 3.0)].into_iter(), &area);
        assert_eq!((point.scale, point.spot((3.0, 3.0))), (1.0, (100.0, 50.0)), "a single point has no size");
    }

    #[test]
    fn pieces_of_the_path_join() {
        let path: Vec<(f64, Planar)> =
            (0..=100).map(|k| (f64::from(k) / 100.0, (f64::from(k), 0.0))).collect();
        let pieces = coloured_pieces(&path);
        assert_eq!(pieces.len(), COLOURS_OF_PATH);
        for pair in pieces.windows(2) {
            assert_eq!(pair[0].1.last(), pair[1].1.first());
        }
        assert_eq!(pieces.iter().map(|p| p.1.len() - 1).sum::<usize>(), 100);
    }

    #[test]
    fn arrows_have_round_lengths() {
        for (length, round) in [(1.0, 1.0), (1.99, 1.0), (0.53, 0.5), (37.0, 20.0), (9.99, 5.0), (1e-7, 1e-7)]
        {
            assert_eq!(round_length(length), round);
        }
    }
}
