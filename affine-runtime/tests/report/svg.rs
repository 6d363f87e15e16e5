//! Reading pictures back.

use affine_runtime::frames::Vector;
use roxmltree::{Document, Node};

pub(crate) type Spot = (f64, f64);

/// A parsed SVG document; parsing it is the test that it is well-formed.
pub(crate) struct Picture<'a> {
    document: Document<'a>,
}

impl<'a> Picture<'a> {
    pub(crate) fn of(text: &'a str) -> Self {
        let document = Document::parse(text).expect("well-formed XML");
        let root = document.root_element();
        assert_eq!(root.tag_name().name(), "svg");
        assert_eq!(root.tag_name().namespace(), Some("http://www.w3.org/2000/svg"));
        Self { document }
    }

    fn all(&self, tag: &'static str) -> impl Iterator<Item = Node<'_, 'a>> {
        self.document.descendants().filter(move |node| node.has_tag_name(tag))
    }

    pub(crate) fn count(&self, tag: &'static str) -> usize {
        self.all(tag).count()
    }

    pub(crate) fn texts(&self) -> impl Iterator<Item = &str> {
        self.all("text").map(|node| node.text().unwrap().trim())
    }

    /// Numbers of corners of all polylines.
    pub(crate) fn polylines(&self) -> Vec<usize> {
        self.all("polyline").map(|node| points(node).len()).collect()
    }

    pub(crate) fn polyline(&self, index: usize) -> Vec<Spot> {
        points(self.all("polyline").nth(index).unwrap())
    }

    /// Polygons of so many corners.
    pub(crate) fn polygons(&self, corners: usize) -> Vec<Vec<Spot>> {
        self.all("polygon").map(points).filter(|points| points.len() == corners).collect()
    }

    /// Centres of discs of a radius.
    pub(crate) fn discs(&self, radius: f64) -> Vec<Spot> {
        let discs = self.all("circle").filter(|node| number(*node, "r") == radius);
        discs.map(|node| (number(node, "cx"), number(node, "cy"))).collect()
    }

    /// The documented view: azimuth 35, elevation 25 degrees.
    pub(crate) fn right(v: &Vector<3>) -> f64 {
        let (sin, cos) = 35f64.to_radians().sin_cos();
        cos * v[1] - sin * v[0]
    }

    pub(crate) fn up(v: &Vector<3>) -> f64 {
        let (sin, cos) = 35f64.to_radians().sin_cos();
        let (sin_e, cos_e) = 25f64.to_radians().sin_cos();
        cos_e * v[2] - sin_e * (cos * v[0] + sin * v[1])
    }

    /// Every text stays on the page and off every other text, by a generous estimate of its width.
    pub(crate) fn assert_legible(&self) {
        let root = self.document.root_element();
        let (width, height) = (number(root, "width"), number(root, "height"));
        let boxes: Vec<(&str, [f64; 4])> =
            self.all("text").map(|node| (node.text().unwrap().trim(), text_box(node))).collect();
        for (k, (text, [left, top, right, bottom])) in boxes.iter().enumerate() {
            assert!(*left >= 0.0 && *top >= 0.0 && *right <= width && *bottom <= height, "{text:?} is cut");
            for (other, [l, t, r, b]) in &boxes[k + 1..] {
                let overlap = left < r && l < right && top < b && t < bottom;
                assert!(!overlap, "{text:?} overlaps {other:?}");
            }
        }
    }
}

fn number(node: Node<'_, '_>, name: &str) -> f64 {
    node.attribute(name).unwrap().parse().unwrap()
}

fn points(node: Node<'_, '_>) -> Vec<Spot> {
    let pair = |text: &str| {
        let (x, y) = text.split_once(',').unwrap();
        (x.parse::<f64>().unwrap(), y.parse::<f64>().unwrap())
    };
    node.attribute("points").unwrap().split_whitespace().map(pair).collect()
}

/// Left, top, right, bottom of a text on the page, with letters 0.6 as wide as the font is high.
fn text_box(node: Node<'_, '_>) -> [f64; 4] {
    let size = number(node, "font-size");
    let (x, y) = (number(node, "x"), number(node, "y"));
    let length = 0.6 * size * node.text().unwrap().trim().chars().count() as f64;
    let before = match node.attribute("text-anchor").unwrap() {
        "start" => 0.0,
        "middle" => 0.5 * length,
        _ => length,
    };
    let (above, below) =
        if node.attribute("dy") == Some("0.76em") { (0.0, size) } else { (0.5 * size, 0.5 * size) };
    if node.attribute("transform").is_some() {
        // Read from bottom to top.
        [x - above, y - length + before, x + below, y + before]
    } else {
        [x - before, y - above, x - before + length, y + below]
    }
}

/// Width and height.
pub(crate) fn extent(points: &[Spot]) -> Spot {
    let (low, high) = corners(points);
    (high.0 - low.0, high.1 - low.1)
}

/// The rectangles around two sets of points share nothing.
pub(crate) fn apart(a: &[Spot], b: &[Spot]) -> bool {
    let (a, b) = (corners(a), corners(b));
    a.1.0 < b.0.0 || b.1.0 < a.0.0 || a.1.1 < b.0.1 || b.1.1 < a.0.1
}

fn corners(points: &[Spot]) -> (Spot, Spot) {
    points.iter().fold(((f64::MAX, f64::MAX), (f64::MIN, f64::MIN)), |(low, high), p| {
        ((low.0.min(p.0), low.1.min(p.1)), (high.0.max(p.0), high.1.max(p.1)))
    })
}
