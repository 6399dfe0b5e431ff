//! Drawing a scene in one view on any surface of plotters.

use super::labels::{Label, Sheet};
use super::view::{View, ViewFrame, ViewKind, hull};
use crate::report::plot::draw::to_plot_error;
use crate::report::plot::{PlotError, terminal};
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, PathElement, Polygon, Rectangle, Text, TriangleMarker};
use plotters::prelude::{BLACK, Color, DrawingBackend, RGBColor, WHITE};
use plotters::style::{IntoTextStyle, TextStyle};
use std::collections::BTreeSet;
use windlass_solve::scene::{Outline, Scene, Sign, Stroke};

/// The water, the ground, and their edges.
const WATER: (RGBColor, RGBColor) = (RGBColor(232, 242, 250), RGBColor(86, 150, 200));
const GROUND: (RGBColor, RGBColor) = (RGBColor(238, 228, 212), RGBColor(125, 95, 60));
/// A body: inside.
const BODY: RGBColor = RGBColor(205, 205, 205);
const FAINT: RGBColor = RGBColor(150, 150, 150);
const LINE: RGBColor = RGBColor(0, 90, 160);
/// Length of the arrows of the axes (pixels).
const ARROW: f64 = 28.0;
/// Size of text on a page.
const TEXT: i32 = 15;

/// Every stroke in the order it is drawn, with its words in the legend.
pub const STROKES: [(Stroke, &str); 5] = [
    (Stroke::Bottom, "bottom under a line"),
    (Stroke::Inactive, "inactive"),
    (Stroke::Straight, "connector, straight"),
    (Stroke::Line, "mooring line"),
    (Stroke::Unsolved, "line without a solution"),
];
/// Every sign in the order it is drawn, with its words in the legend.
pub const SIGNS: [(Sign, &str); 5] = [
    (Sign::Origin, "origin of a body"),
    (Sign::Joint, "joint of segments"),
    (Sign::Touchdown, "touchdown"),
    (Sign::Fairlead, "fairlead"),
    (Sign::Anchor, "anchor"),
];

/// A surface: a page, or the characters of a terminal.
pub struct PictureStyle {
    /// Whether it is made of characters.
    pub terminal: bool,
    /// Width and height of a letter (pixels).
    pub letter: (i32, i32),
}

type DrawOutcome<T> = Result<T, PlotError>;

/// A surface with its look: every element goes through it.
pub struct Pen<'a, B: DrawingBackend> {
    area: &'a DrawingArea<B, Shift>,
    look: &'a PictureStyle,
}

impl<'a, B: DrawingBackend> Pen<'a, B> {
    /// On a surface.
    pub fn new(area: &'a DrawingArea<B, Shift>, look: &'a PictureStyle) -> Self {
        Pen { area, look }
    }

    /// Writes text, its upper left corner at a pixel.
    pub fn text(&self, text: &str, at: (i32, i32), size: i32, colour: RGBColor) -> DrawOutcome<()> {
        let style: TextStyle = ("sans-serif", size).into_text_style(self.area).color(&colour);
        self.area.draw(&Text::new(text.to_string(), at, style)).map_err(to_plot_error)
    }

    fn path(&self, points: Vec<(i32, i32)>, colour: RGBColor, width: u32) -> DrawOutcome<()> {
        let width = if self.look.terminal { 1 } else { width };
        self.area.draw(&PathElement::new(points, colour.stroke_width(width))).map_err(to_plot_error)
    }

    /// A path of dashes and gaps of so many pixels.
    fn draw_dashed(&self, points: &[(i32, i32)], (colour, width): (RGBColor, u32), dash: [f64; 2]) -> DrawOutcome<()> {
        for piece in dashes(points, dash) {
            self.path(piece.to_vec(), colour, width)?;
        }
        Ok(())
    }

    fn fill(&self, corners: [(i32, i32); 2], colour: RGBColor) -> DrawOutcome<()> {
        if self.look.terminal {
            return Ok(());
        }
        self.area.draw(&Rectangle::new(corners, colour.filled())).map_err(to_plot_error)
    }

    /// A sample of a stroke, from left to right.
    pub fn stroke(&self, stroke: Stroke, points: Vec<(i32, i32)>) -> DrawOutcome<()> {
        let (short, long) = if self.look.terminal { (2.0, 4.0) } else { (4.0, 8.0) };
        match stroke {
            Stroke::Bottom => self.path(points, GROUND.1, 2),
            Stroke::Inactive => self.draw_dashed(&points, (FAINT, 1), [short, short]),
            Stroke::Straight => self.path(points, RGBColor(0, 128, 96), 2),
            Stroke::Line => self.path(points, LINE, 2),
            Stroke::Unsolved => self.draw_dashed(&points, (RGBColor(213, 94, 0), 2), [long, long]),
        }
    }

    /// A sign at a pixel.
    pub fn sign(&self, sign: Sign, at: (i32, i32)) -> DrawOutcome<()> {
        if self.look.terminal {
            let colour = terminal::colour(mark_index(sign), true);
            return self.area.draw_pixel(at, &colour).map_err(to_plot_error);
        }
        let (x, y) = at;
        match sign {
            Sign::Origin => {
                self.path(vec![(x - 6, y), (x + 6, y)], BLACK, 1)?;
                self.path(vec![(x, y - 6), (x, y + 6)], BLACK, 1)
            }
            Sign::Joint => {
                self.area.draw(&Rectangle::new([(x - 3, y - 3), (x + 3, y + 3)], LINE.filled())).map_err(to_plot_error)
            }
            Sign::Touchdown => {
                self.area.draw(&Circle::new(at, 4, WHITE.filled())).map_err(to_plot_error)?;
                self.area.draw(&Circle::new(at, 4, LINE.stroke_width(1))).map_err(to_plot_error)
            }
            Sign::Fairlead => self.area.draw(&Circle::new(at, 3, BLACK.filled())).map_err(to_plot_error),
            Sign::Anchor => self.area.draw(&TriangleMarker::new(at, 7, GROUND.1.filled())).map_err(to_plot_error),
        }
    }

    /// The axes of a view, about a pixel.
    pub fn axes(&self, view: &View, at: (i32, i32)) -> DrawOutcome<()> {
        for (name, [h, v]) in view.axes() {
            let off = |length: f64| (at.0 + (length * h).round() as i32, at.1 - (length * v).round() as i32);
            let tip = off(ARROW);
            self.path(vec![at, tip], BLACK, 1)?;
            // the two strokes of the head, a sixth of a turn off the shaft
            for turn in [0.5f64, -0.5] {
                let (s, c) = turn.sin_cos();
                let back = (7.0 * (h * c - v * s), 7.0 * (h * s + v * c));
                self.path(vec![tip, (tip.0 - back.0.round() as i32, tip.1 + back.1.round() as i32)], BLACK, 1)?;
            }
            let (x, y) = off(ARROW + 10.0);
            let width = 8 * i32::try_from(name.len()).unwrap_or(1);
            self.text(name, (x - width / 2, y - 8), TEXT, BLACK)?;
        }
        Ok(())
    }

    /// A scale bar that ends at a pixel, of a length in pixels, with its words.
    pub fn scale(&self, (right, y): (i32, i32), length: i32, words: &str) -> DrawOutcome<()> {
        let left = right - length;
        self.path(vec![(left, y), (right, y)], BLACK, 2)?;
        for x in [left, right] {
            self.path(vec![(x, y - 5), (x, y + 5)], BLACK, 2)?;
        }
        let width = 8 * i32::try_from(words.chars().count()).unwrap_or(0);
        self.text(words, (left - width - 10, y - 8), TEXT, BLACK)
    }

    /// The edge of a view.
    pub fn frame(&self, frame: &ViewFrame) -> DrawOutcome<()> {
        let [left, top, width, height] = frame.at;
        let corners = [(left, top), (left + width, top + height)];
        self.area.draw(&Rectangle::new(corners, FAINT.stroke_width(1))).map_err(to_plot_error)
    }

    /// One view of a scene within its frame; the number of names that found no place.
    pub fn view(&self, scene: &Scene, view: &View, frame: &ViewFrame, names: bool) -> DrawOutcome<usize> {
        let mut sheet = Sheet::new(frame.at, self.look.letter);
        let mut labels = Vec::new();
        let pixel = |at: [f64; 3]| frame.pixel(view.project(at));
        match view.kind {
            ViewKind::Plan => {}
            ViewKind::Elevation => self.levels(scene, view, frame, (&mut sheet, &mut labels))?,
            ViewKind::Axonometric => self.planes(scene, view, frame)?,
        }
        for body in &scene.bodies {
            self.body(body, &pixel, &mut sheet)?;
            labels.push(Label { text: body.name.clone(), at: pixel(body.origin), tone: 0 });
        }
        for path in STROKES.iter().flat_map(|(stroke, _)| scene.paths.iter().filter(move |p| p.stroke == *stroke)) {
            let mut points: Vec<(i32, i32)> = path.points.iter().map(|at| pixel(*at)).collect();
            points.dedup();
            sheet.mark(&points);
            let named = if path.grounded { points.last() } else { points.get(points.len() / 2) };
            if let Some(at) = named.filter(|_| path.stroke != Stroke::Bottom) {
                labels.push(Label { text: path.name.clone(), at: *at, tone: 1 });
            }
            self.stroke(path.stroke, points)?;
        }
        for mark in SIGNS.iter().flat_map(|(sign, _)| scene.marks.iter().filter(move |m| m.sign == *sign)) {
            let (x, y) = pixel(mark.at);
            sheet.mark(&[(x - 3, y), (x + 3, y)]);
            self.sign(mark.sign, (x, y))?;
            if !mark.name.is_empty() {
                labels.push(Label { text: mark.name.clone(), at: (x, y), tone: 2 });
            }
        }
        self.names(&sheet, labels, names)
    }

    /// A body: each shape filled within its convex hull, then its edges, thin; edges that fall together are drawn once.
    fn body(&self, body: &Outline, pixel: &dyn Fn([f64; 3]) -> (i32, i32), sheet: &mut Sheet) -> DrawOutcome<()> {
        let rings: Vec<_> = body.shapes.iter().map(|s| hull(s.iter().map(|at| pixel(*at)).collect())).collect();
        for ring in rings.iter().filter(|ring| ring.len() > 2 && !self.look.terminal) {
            self.area.draw(&Polygon::new(ring.clone(), BODY.filled())).map_err(to_plot_error)?;
        }
        let mut drawn = BTreeSet::new();
        for [a, b] in body.edges.iter().map(|edge| edge.map(pixel)) {
            if a != b && drawn.insert((a.min(b), a.max(b))) {
                self.path(vec![a, b], RGBColor(110, 110, 110), 1)?;
            }
        }
        for ring in rings {
            let closed: Vec<_> = ring.iter().chain(ring.first()).copied().collect();
            sheet.mark(&closed);
            self.path(closed, BLACK, 2)?;
        }
        Ok(())
    }

    /// Writes the names; those of water and ground whether names are wanted or not.
    fn names(&self, sheet: &Sheet, mut labels: Vec<Label>, names: bool) -> DrawOutcome<usize> {
        labels.retain(|l| names || l.tone >= 3);
        // what is largest is named first
        labels.sort_by_key(|l| if l.tone >= 3 { 0 } else { l.tone + 1 });
        let (placed, left_out) = sheet.place(labels);
        let tones = [BLACK, LINE, RGBColor(90, 90, 90), WATER.1, GROUND.1];
        for name in &placed {
            let [left, top, width, height] = name.at;
            let (x, y) = name.label.at;
            let near = (x.clamp(left, left + width), y.clamp(top, top + height));
            if !self.look.terminal && (near.0 - x).abs().max((near.1 - y).abs()) > 20 {
                self.path(vec![(x, y), near], RGBColor(190, 190, 190), 1)?;
            }
        }
        for name in placed {
            let colour = tones.get(name.label.tone).copied().unwrap_or(BLACK);
            let [left, top, ..] = name.at;
            self.text(&name.label.text, (left, top), TEXT, colour)?;
        }
        Ok(left_out)
    }

    /// Water surface and level bottom, seen from the side.
    fn levels(
        &self,
        scene: &Scene,
        view: &View,
        frame: &ViewFrame,
        on: (&mut Sheet, &mut Vec<Label>),
    ) -> DrawOutcome<()> {
        let [left, top, width, height] = frame.at;
        let (right, low) = (left + width, top + height);
        let level = |z: f64| frame.pixel(view.project([0.0, 0.0, z])).1.clamp(top, low);
        let (surface, bottom) = (level(scene.surface), scene.bottom.map(level));
        self.fill([(left, surface), (right, bottom.unwrap_or(low))], WATER.0)?;
        if let Some(y) = bottom {
            self.fill([(left, y), (right, low)], GROUND.0)?;
            self.path(vec![(left, y), (right, y)], GROUND.1, 1)?;
        }
        let line = [(left, surface), (right, surface)];
        let dash = if self.look.terminal { [2.0, 2.0] } else { [f64::from(width), 1.0] };
        self.draw_dashed(&line, (WATER.1, 1), dash)?;
        for (y, text, tone) in [(Some(surface), "water surface", 3), (bottom, "sea bottom", 4)] {
            let Some(y) = y else { continue };
            on.0.mark(&[(left, y), (right, y)]);
            on.1.push(Label { text: text.into(), at: (left, y), tone });
        }
        Ok(())
    }

    /// Water surface and level bottom, seen slantwise: rectangles about all that is drawn.
    fn planes(&self, scene: &Scene, view: &View, frame: &ViewFrame) -> DrawOutcome<()> {
        let levels = [(scene.bottom, GROUND), (Some(scene.surface), WATER)];
        for (z, (inside, edge)) in levels {
            let Some(z) = z else { continue };
            let corners: Vec<_> = super::corners_around(scene, z).map(|at| frame.pixel(view.project(at))).to_vec();
            if !self.look.terminal && edge == GROUND.1 {
                self.area.draw(&Polygon::new(corners.clone(), inside.filled())).map_err(to_plot_error)?;
            }
            let closed: Vec<_> = corners.iter().chain(corners.first()).copied().collect();
            let dash = if self.look.terminal { [1.0, 3.0] } else { [6.0, 4.0] };
            self.draw_dashed(&closed, (edge, 1), dash)?;
        }
        Ok(())
    }
}

/// The mark of a sign in a terminal, as an index of its marks.
pub fn mark_index(sign: Sign) -> usize {
    match sign {
        Sign::Touchdown => 1,
        Sign::Fairlead => 2,
        Sign::Origin => 3,
        Sign::Anchor => 4,
        Sign::Joint => 5,
    }
}

/// The dashes of a path: pieces of it of the first length, the second apart (pixels).
fn dashes(points: &[(i32, i32)], [dash, gap]: [f64; 2]) -> Vec<[(i32, i32); 2]> {
    let mut list = Vec::new();
    let mut done = 0.0;
    for (a, b) in points.iter().zip(points.iter().skip(1)) {
        let (dx, dy) = (f64::from(b.0 - a.0), f64::from(b.1 - a.1));
        let length = dx.hypot(dy);
        let at = |s: f64| (a.0 + (dx * s / length).round() as i32, a.1 + (dy * s / length).round() as i32);
        // periods are counted along the whole path, so that corners do not restart them
        let mut start = -(done % (dash + gap));
        while start < length {
            let (from, to) = (start.max(0.0), (start + dash).min(length));
            if to > from {
                list.push([at(from), at(to)]);
            }
            start += dash + gap;
        }
        done += length;
    }
    list
}

#[cfg(test)]
mod tests {
    use super::dashes;

    #[test]
    fn dashes_continue_around_a_corner() {
        let path = [(0, 0), (10, 0), (10, 10)];
        assert_eq!(
            dashes(&path, [4.0, 4.0]),
            [[(0, 0), (4, 0)], [(8, 0), (10, 0)], [(10, 0), (10, 2)], [(10, 6), (10, 10)]]
        );
        assert!(dashes(&[(5, 5)], [4.0, 4.0]).is_empty());
    }
}
