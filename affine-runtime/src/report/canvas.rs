//! Drawing on a page of SVG.

use core::fmt::{Display, Write};

use super::escaped;
use super::palette::{Colour, PAPER};

/// A point of the page: to the right, downward.
pub(super) type Spot = (f64, f64);

/// A page being drawn: the document so far.
pub(super) struct Canvas {
    document: String,
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
    /// Where the spot is along the line, and how far the text is moved down, in the words of SVG.
    anchor: &'static str,
    down: &'static str,
    bold: bool,
    upward: bool,
}

impl Lettering {
    /// Begins at the spot, vertically centred.
    pub(super) fn new(size: f64, colour: Colour) -> Self {
        Self { size, colour, anchor: "start", down: "0.35em", bold: false, upward: false }
    }
    /// Centred about the spot.
    pub(super) fn centred(self) -> Self {
        Self { anchor: "middle", ..self }
    }
    /// Ends at the spot.
    pub(super) fn before(self) -> Self {
        Self { anchor: "end", ..self }
    }
    /// Hangs below the spot.
    pub(super) fn below(self) -> Self {
        Self { down: "0.76em", ..self }
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

impl Canvas {
    /// The SVG document of a page of the given width and height.
    pub(super) fn draw(width: u32, height: u32, paint: impl FnOnce(&mut Canvas)) -> String {
        let document = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\" font-family=\"sans-serif\">\n"
        );
        let mut canvas = Canvas { document };
        canvas.rectangle((0.0, 0.0), (f64::from(width), f64::from(height)), PAPER);
        paint(&mut canvas);
        canvas.document + "</svg>\n"
    }

    /// A straight line.
    pub(super) fn line(&mut self, from: Spot, to: Spot, pen: Pen) {
        let [x1, y1, x2, y2] = [from.0, from.1, to.0, to.1].map(Length);
        self.element(format_args!("line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {}", Stroke(pen)));
    }

    /// A line through the spots, but for those nobody can tell from their neighbours; nothing for fewer than two.
    pub(super) fn polyline(&mut self, spots: impl IntoIterator<Item = Spot>, pen: Pen) {
        let spots = thinned(spots);
        if spots.len() > 1 {
            self.element(format_args!("polyline points=\"{}\" {}", places(spots), Stroke(pen)));
        }
    }

    /// A closed surface.
    pub(super) fn polygon(&mut self, corners: impl IntoIterator<Item = Spot>, colour: Colour, opacity: f64) {
        let colour = Hue(colour);
        self.element(format_args!(
            "polygon points=\"{}\" fill=\"{colour}\" fill-opacity=\"{opacity}\"",
            places(corners)
        ));
    }

    /// A filled rectangle between two corners.
    pub(super) fn rectangle(&mut self, corner: Spot, opposite: Spot, colour: Colour) {
        let ((x, y), colour) = (corner, Hue(colour));
        let (width, height) = (opposite.0 - x, opposite.1 - y);
        self.element(format_args!(
            "rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{colour}\"",
            Length(x),
            Length(y),
            Length(width),
            Length(height)
        ));
    }

    /// A filled disc.
    pub(super) fn disc(&mut self, centre: Spot, radius: f64, colour: Colour) {
        let (x, y, colour) = (Length(centre.0), Length(centre.1), Hue(colour));
        self.element(format_args!("circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{colour}\""));
    }

    /// One line of text, unless it is empty.
    pub(super) fn text(&mut self, text: &str, spot: Spot, lettering: Lettering) {
        if text.is_empty() {
            return;
        }
        let Lettering { size, colour, anchor, down, bold, upward } = lettering;
        let (x, y, colour) = (Length(spot.0), Length(spot.1), Hue(colour));
        let weight = if bold { " font-weight=\"bold\"" } else { "" };
        let turn = if upward { format!(" transform=\"rotate(270 {x} {y})\"") } else { String::new() };
        self.write(format_args!(
            "<text x=\"{x}\" y=\"{y}\" dy=\"{down}\" text-anchor=\"{anchor}\" font-size=\"{size}\"{weight} fill=\"{colour}\"{turn}>\
             {}</text>\n",
            escaped(text)
        ));
    }

    /// An element without content: its name and attributes.
    fn element(&mut self, content: impl Display) {
        self.write(format_args!("<{content}/>\n"));
    }

    fn write(&mut self, content: impl Display) {
        // Strings take whatever is written to them.
        let _ = write!(self.document, "{content}");
    }
}

/// A length or coordinate, to a hundredth of the page's unit, without noughts that say nothing.
struct Length(f64);

impl Display for Length {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        // No sign where nothing is left.
        write!(f, "{}", (self.0 * 100.0).round() / 100.0 + 0.0)
    }
}

fn places(spots: impl IntoIterator<Item = Spot>) -> String {
    let place = |(x, y): Spot| format!("{},{}", Length(x), Length(y));
    spots.into_iter().map(place).collect::<Vec<_>>().join(" ")
}

struct Hue(Colour);

impl Display for Hue {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let (red, green, blue) = self.0;
        write!(f, "#{red:02x}{green:02x}{blue:02x}")
    }
}

struct Stroke(Pen);

impl Display for Stroke {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Pen { colour, opacity, width } = self.0;
        write!(f, "stroke=\"{}\" stroke-width=\"{width}\"", Hue(colour))?;
        if opacity < 1.0 { write!(f, " stroke-opacity=\"{opacity}\"") } else { Ok(()) }
    }
}

/// A spot of a line nearer to the one before it does not show.
const INVISIBLE: f64 = 0.25;
/// Nor does one that is as near to the line without it.
const FLAT: f64 = 0.05;

/// The spots without those nearer than [`INVISIBLE`] to the one kept before them, and without those that the line does not need
/// to stay within [`FLAT`] of all others (Douglas and Peucker, Cartographica 10 (1973) 112); the last is kept.
fn thinned(spots: impl IntoIterator<Item = Spot>) -> Vec<Spot> {
    let mut apart: Vec<Spot> = Vec::new();
    let mut dropped = None;
    for spot in spots {
        match apart.last() {
            Some(last) if (spot.0 - last.0).hypot(spot.1 - last.1) < INVISIBLE => dropped = Some(spot),
            _ => {
                apart.push(spot);
                dropped = None;
            }
        }
    }
    apart.extend(dropped);
    let mut kept: Vec<Spot> = apart.first().copied().into_iter().collect();
    // Pieces of the line by their ends, the first one last.
    let mut pieces: Vec<(usize, usize)> =
        (1..apart.len()).next_back().map(|last| (0, last)).into_iter().collect();
    while let Some((from, to)) = pieces.pop() {
        let off = |k: &usize| distance(apart[*k], (apart[from], apart[to]));
        match (from + 1..to).max_by(|a, b| off(a).total_cmp(&off(b))).filter(|k| off(k) > FLAT) {
            Some(furthest) => pieces.extend([(furthest, to), (from, furthest)]),
            None => kept.push(apart[to]),
        }
    }
    kept
}

/// From a spot to a stretch between two others.
fn distance(spot: Spot, (from, to): (Spot, Spot)) -> f64 {
    let (along, across) = ((to.0 - from.0, to.1 - from.1), (spot.0 - from.0, spot.1 - from.1));
    let square = along.0 * along.0 + along.1 * along.1;
    let part =
        if square > 0.0 { ((across.0 * along.0 + across.1 * along.1) / square).clamp(0.0, 1.0) } else { 0.0 };
    (across.0 - part * along.0).hypot(across.1 - part * along.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_lose_only_what_does_not_show() {
        let arc: Vec<Spot> =
            (0..=4000).map(|k| f64::from(k) / 1000.0).map(|s| (40.0 * s.cos(), 40.0 * s.sin())).collect();
        let kept = thinned(arc.iter().copied());
        assert!(kept.len() < 100 && kept[0] == arc[0] && kept.last() == arc.last(), "{}", kept.len());
        for spot in &arc {
            let off =
                kept.windows(2).map(|pair| distance(*spot, (pair[0], pair[1]))).fold(f64::MAX, f64::min);
            assert!(off < FLAT + 0.01, "{off}");
        }
        let straight = (0..=1000).map(|k| (f64::from(k) * 0.01, 0.0));
        assert_eq!(thinned(straight), [(0.0, 0.0), (10.0, 0.0)]);
        assert_eq!(thinned([(0.0, 0.0), (3.0, 1.0), (5.0, 5.0)]).len(), 3);
        assert_eq!(thinned([(1.0, 1.0), (1.0, 1.0)]).len(), 2, "a line without length is a point");
        assert_eq!(thinned([(1.0, 1.0)]).len(), 1);
        assert!(thinned([]).is_empty());
    }

    #[test]
    fn documents_are_well_formed_and_short() {
        let document = Canvas::draw(20, 10, |canvas| {
            canvas.line((1.004, 2.0), (-0.001, 1.0 / 3.0), Pen::new((255, 0, 16), 1.5).opacity(0.5));
            canvas.text("a < b & c", (5.0, 5.0), Lettering::new(8.0, (0, 0, 0)).centred().upward());
        });
        let lines: Vec<&str> = document.lines().collect();
        assert_eq!(lines.len(), 5, "a page, its paper, a line, a text, the end");
        assert_eq!(
            lines[2],
            "<line x1=\"1\" y1=\"2\" x2=\"0\" y2=\"0.33\" stroke=\"#ff0010\" stroke-width=\"1.5\" stroke-opacity=\"0.5\"/>"
        );
        assert!(lines[3].ends_with("transform=\"rotate(270 5 5)\">a &lt; b &amp; c</text>"), "{}", lines[3]);
    }
}
