//! Drawing on a page of SVG.

use core::fmt;
use std::io;

use plotters::backend::{DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontDesc, FontFamily, FontStyle, FontTransform, RGBAColor, RGBColor, ShapeStyle};

use super::palette::{Colour, PAPER};

/// A point of the page: to the right, downward.
pub(super) type Spot = (f64, f64);

/// The backend takes whole numbers as coordinates; that many of them to one unit of the page keep curves smooth.
const FINENESS: f64 = 20.0;

/// What the backend divides font sizes by.
const BACKEND_FONT_DIVISOR: f64 = 1.24;

/// A page being drawn. What fails is remembered until [`Canvas::draw`] returns.
pub(super) struct Canvas<'a> {
    backend: SVGBackend<'a>,
    failure: Option<io::Error>,
}

/// A line's look.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pen {
    pub(super) colour: Colour,
    /// 0 to 1.
    pub(super) opacity: f64,
    pub(super) width: f64,
}

impl Pen {
    pub(super) fn new(colour: Colour, width: f64) -> Self {
        Self { colour, opacity: 1.0, width }
    }

    pub(super) fn opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }
}

/// A text's look and place relative to its spot.
#[derive(Clone, Copy)]
pub(super) struct Lettering {
    size: f64,
    colour: Colour,
    across: HPos,
    down: VPos,
    bold: bool,
    upward: bool,
}

impl Lettering {
    /// Begins at the spot, vertically centred.
    pub(super) fn new(size: f64, colour: Colour) -> Self {
        Self { size, colour, across: HPos::Left, down: VPos::Center, bold: false, upward: false }
    }
    /// Centred about the spot.
    pub(super) fn centred(self) -> Self {
        Self { across: HPos::Center, ..self }
    }
    /// Ends at the spot.
    pub(super) fn before(self) -> Self {
        Self { across: HPos::Right, ..self }
    }
    /// Hangs below the spot.
    pub(super) fn below(self) -> Self {
        Self { down: VPos::Top, ..self }
    }
    /// Bold.
    pub(super) fn bold(self) -> Self {
        Self { bold: true, ..self }
    }
    /// Read from bottom to top.
    pub(super) fn upward(self) -> Self {
        Self { upward: true, ..self }
    }
}

impl Canvas<'_> {
    /// The SVG document of a page of the given width and height.
    pub(super) fn draw(width: u32, height: u32, paint: impl FnOnce(&mut Canvas<'_>)) -> io::Result<String> {
        let mut document = String::new();
        let fine = |length: u32| (f64::from(length) * FINENESS) as u32;
        let size = (fine(width), fine(height));
        let mut canvas = Canvas { backend: SVGBackend::with_string(&mut document, size), failure: None };
        canvas.rectangle((0.0, 0.0), (f64::from(width), f64::from(height)), PAPER);
        paint(&mut canvas);
        let presented = canvas.backend.present();
        canvas.remember(presented);
        let failure = canvas.failure.take();
        drop(canvas);
        match failure {
            Some(error) => Err(error),
            None => Ok(with_page_size(&document, size, (width, height))),
        }
    }

    /// A straight line.
    pub(super) fn line(&mut self, from: Spot, to: Spot, pen: Pen) {
        let drawn = self.backend.draw_line(fine(from), fine(to), &style(pen));
        self.remember(drawn);
    }

    /// A line through the spots, but for those nobody can tell from their neighbours; nothing for fewer than two.
    pub(super) fn polyline(&mut self, spots: impl IntoIterator<Item = Spot>, pen: Pen) {
        let spots = thinned(spots);
        if spots.len() > 1 {
            let drawn = self.backend.draw_path(spots.into_iter().map(fine), &style(pen));
            self.remember(drawn);
        }
    }

    /// A closed surface.
    pub(super) fn polygon(&mut self, corners: impl IntoIterator<Item = Spot>, colour: Colour, opacity: f64) {
        let pen = Pen::new(colour, 0.0).opacity(opacity);
        let drawn = self.backend.fill_polygon(corners.into_iter().map(fine), &style(pen));
        self.remember(drawn);
    }

    /// A filled rectangle between two corners.
    pub(super) fn rectangle(&mut self, corner: Spot, opposite: Spot, colour: Colour) {
        let drawn = self.backend.draw_rect(fine(corner), fine(opposite), &style(Pen::new(colour, 0.0)), true);
        self.remember(drawn);
    }

    /// A filled disc.
    pub(super) fn disc(&mut self, centre: Spot, radius: f64, colour: Colour) {
        let radius = (radius * FINENESS).round() as u32;
        let drawn = self.backend.draw_circle(fine(centre), radius, &style(Pen::new(colour, 0.0)), true);
        self.remember(drawn);
    }

    /// One line of text.
    pub(super) fn text(&mut self, text: &str, spot: Spot, lettering: Lettering) {
        let weight = if lettering.bold { FontStyle::Bold } else { FontStyle::Normal };
        let size = lettering.size * FINENESS * BACKEND_FONT_DIVISOR;
        let mut font = FontDesc::new(FontFamily::SansSerif, size, weight);
        if lettering.upward {
            font = font.transform(FontTransform::Rotate270);
        }
        let (red, green, blue) = lettering.colour;
        let style = font.color(&RGBColor(red, green, blue)).pos(Pos::new(lettering.across, lettering.down));
        let drawn = self.backend.draw_text(text, &style, fine(spot));
        self.remember(drawn);
    }

    fn remember<E: fmt::Display>(&mut self, drawn: Result<(), E>) {
        if let (Err(error), None) = (drawn, &self.failure) {
            self.failure = Some(io::Error::other(error.to_string()));
        }
    }
}

/// A spot of a line nearer to the one before it does not show.
const INVISIBLE: f64 = 0.25;

/// The spots without those nearer than [`INVISIBLE`] to the one kept before them; the last is kept.
fn thinned(spots: impl IntoIterator<Item = Spot>) -> Vec<Spot> {
    let mut kept: Vec<Spot> = Vec::new();
    let mut dropped = None;
    for spot in spots {
        match kept.last() {
            Some(last) if (spot.0 - last.0).hypot(spot.1 - last.1) < INVISIBLE => dropped = Some(spot),
            _ => {
                kept.push(spot);
                dropped = None;
            }
        }
    }
    kept.extend(dropped);
    kept
}

fn fine((x, y): Spot) -> (i32, i32) {
    ((x * FINENESS).round() as i32, (y * FINENESS).round() as i32)
}

fn style(pen: Pen) -> ShapeStyle {
    let (red, green, blue) = pen.colour;
    ShapeStyle {
        color: RGBAColor(red, green, blue, pen.opacity),
        filled: true,
        stroke_width: (pen.width * FINENESS).round() as u32,
    }
}

/// The backend makes the page as large as its coordinates: the page keeps its own size, the coordinates stay.
/// Lines turn their corners round.
fn with_page_size(document: &str, fine: (u32, u32), page: (u32, u32)) -> String {
    let written = format!("<svg width=\"{}\" height=\"{}\"", fine.0, fine.1);
    let wanted = format!(
        "<svg width=\"{}\" height=\"{}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"",
        page.0, page.1
    );
    document.replacen(&written, &wanted, 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_lose_only_what_does_not_show() {
        let dense = (0..=1000).map(|k| (f64::from(k) * 0.01, 0.0));
        let kept = thinned(dense);
        assert!(kept.len() < 45 && kept[0] == (0.0, 0.0) && kept[kept.len() - 1] == (10.0, 0.0));
        assert!(kept.windows(2).all(|pair| pair[1].0 - pair[0].0 < INVISIBLE + 0.011));
        assert_eq!(thinned([(0.0, 0.0), (3.0, 1.0), (5.0, 5.0)]).len(), 3);
        assert_eq!(thinned([(1.0, 1.0), (1.0, 1.0)]).len(), 2, "a line without length is a point");
    }
}
