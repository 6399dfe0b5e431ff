//! Drawing a scene in one view on any surface of plotters.

use super::labels::{Label, Sheet};
use super::view::{View, ViewFrame, ViewKind, hull};
use crate::report::plot::draw::to_plot_error;
use crate::report::plot::stroke::dashes;
use crate::report::plot::{PlotError, terminal};
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, PathElement, Polygon, Rectangle, Text, TriangleMarker};
use plotters::prelude::{BLACK, Color, DrawingBackend, RGBColor, WHITE};
use plotters::style::{IntoTextStyle, ShapeStyle, TextStyle};
use std::collections::BTreeSet;
use windlass_solve::scene::{Outline, Scene, Sign, Stroke};

/// The water, the ground, and their edges.
const WATER: (RGBColor, RGBColor) = (RGBColor(232, 242, 250), RGBColor(86, 150, 200));
const GROUND: (RGBColor, RGBColor) = (RGBColor(238, 228, 212), RGBColor(125, 95, 60));
/// A body: inside.
const BODY: RGBColor = RGBColor(205, 205, 205);
const FAINT: RGBColor = RGBColor(150, 150, 150);
const LINE: RGBColor = RGBColor(0, 90, 160);
const PIPE: RGBColor = RGBColor(70, 70, 80);
/// Length of the arrows of the axes (pixels).
const ARROW: f64 = 28.0;
/// Size of text on a page.
const TEXT: i32 = 15;

/// Every stroke in the order it is drawn, with its words in the legend.
pub const STROKES: [(Stroke, &str); 8] = [
    (Stroke::Bottom, "bottom under a line"),
    (Stroke::Inactive, "inactive"),
    (Stroke::Straight, "connector, straight"),
    (Stroke::Fender, "fender"),
    (Stroke::Sling, "sling"),
    (Stroke::Line, "line"),
    (Stroke::Pipe, "rod or pipe"),
    (Stroke::Unsolved, "line without a solution"),
];
/// Every sign in the order it is drawn, with its words in the legend.
pub const SIGNS: [(Sign, &str); 7] = [
    (Sign::Origin, "origin of a body"),
    (Sign::Joint, "joint of segments"),
    (Sign::PipeSupport, "support of a pipe"),
    (Sign::Fender, "end of a fender"),
    (Sign::Touchdown, "touchdown"),
    (Sign::Fairlead, "fairlead"),
    (Sign::Anchor, "anchor"),
];

/// A surface: a page, or the characters of a terminal.
pub struct PictureStyle {
    /// Whether it is made of characters.
    pub terminal: bool,
    /// Units of the surface a pixel.
    pub unit: i32,
    /// Width and height of a letter (units of the surface).
    pub letter: (i32, i32),
}

impl PictureStyle {
    /// Units of the surface of so many pixels.
    pub fn px(&self, pixels: i32) -> i32 {
        pixels * self.unit
    }

    /// Width of a text (units of the surface).
    pub fn text_width(&self, text: &str) -> i32 {
        self.letter.0.saturating_mul(i32::try_from(text.chars().count()).unwrap_or(0))
    }
}

type DrawOutcome<T> = Result<T, PlotError>;

/// Stops of the colours of tension, from least to largest, as in films.
const TENSION_STOPS: [[f64; 3]; 5] =
    [[0.06, 0.2, 0.55], [0.42, 0.13, 0.62], [0.78, 0.18, 0.4], [0.93, 0.43, 0.1], [0.99, 0.75, 0.08]];
/// Colours that a line is drawn in: neighbours differ less than one sees.
const TENSION_STEPS: i32 = 32;

/// The colours of tension: from the least to the largest one that is shown (N).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TensionScale {
    /// Least tension (N).
    pub low: f64,
    /// Largest tension (N).
    pub high: f64,
}

impl TensionScale {
    /// The scale of all tensions of a scene; `None` where none is known.
    pub fn of_scene(scene: &Scene) -> Option<TensionScale> {
        let all = scene.paths.iter().flat_map(|p| &p.tensions).copied().filter(|t| t.is_finite());
        let range = all.fold(None, |range: Option<(f64, f64)>, t| {
            let (low, high) = range.unwrap_or((t, t));
            Some((low.min(t), high.max(t)))
        });
        range.map(|(low, high)| TensionScale { low, high })
    }

    /// The step of a tension, from 0.
    fn step(&self, tension: f64) -> i32 {
        let share = if self.high > self.low { (tension - self.low) / (self.high - self.low) } else { 0.5 };
        (share.clamp(0.0, 1.0) * f64::from(TENSION_STEPS - 1)).round() as i32
    }

    /// The colour of a step.
    fn colour(step: i32) -> RGBColor {
        let at = f64::from(step.clamp(0, TENSION_STEPS - 1)) / f64::from(TENSION_STEPS - 1) * 4.0;
        let below = (at.floor() as usize).min(TENSION_STOPS.len() - 2);
        let [from, to] = [below, below + 1].map(|n| TENSION_STOPS.get(n).copied().unwrap_or_default());
        let part = |i: usize| {
            let (a, b) = (from.get(i).copied().unwrap_or(0.0), to.get(i).copied().unwrap_or(0.0));
            (255.0 * (a + (at - below as f64) * (b - a))).round() as u8
        };
        RGBColor(part(0), part(1), part(2))
    }
}

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

    fn px(&self, pixels: i32) -> i32 {
        self.look.px(pixels)
    }

    fn edge(&self, colour: RGBColor, width: u32) -> ShapeStyle {
        colour.stroke_width(width.saturating_mul(self.look.unit.unsigned_abs()))
    }

    /// Writes text of a height in pixels, its upper left corner at a place.
    pub fn text(&self, text: &str, at: (i32, i32), size: i32, colour: RGBColor) -> DrawOutcome<()> {
        let style: TextStyle = ("sans-serif", self.px(size)).into_text_style(self.area).color(&colour);
        self.area.draw(&Text::new(text.to_string(), at, style)).map_err(to_plot_error)
    }

    fn path(&self, points: Vec<(i32, i32)>, colour: RGBColor, width: u32) -> DrawOutcome<()> {
        let width = if self.look.terminal { 1 } else { width };
        self.area.draw(&PathElement::new(points, self.edge(colour, width))).map_err(to_plot_error)
    }

    /// A path of dashes and gaps of so many pixels.
    fn draw_dashed(&self, points: &[(i32, i32)], (colour, width): (RGBColor, u32), dash: [f64; 2]) -> DrawOutcome<()> {
        for piece in dashes(points, &dash.map(|length| length * f64::from(self.look.unit))) {
            self.path(piece, colour, width)?;
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
            Stroke::Fender => self.path(points, RGBColor(90, 70, 50), 6),
            Stroke::Sling => self.path(points, RGBColor(140, 60, 140), 2),
            Stroke::Line => self.path(points, LINE, 2),
            Stroke::Pipe => self.path(points, PIPE, 4),
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
                let arm = self.px(6);
                self.path(vec![(x - arm, y), (x + arm, y)], BLACK, 1)?;
                self.path(vec![(x, y - arm), (x, y + arm)], BLACK, 1)
            }
            Sign::Joint => {
                let half = self.px(3);
                let corners = [(x - half, y - half), (x + half, y + half)];
                self.area.draw(&Rectangle::new(corners, LINE.filled())).map_err(to_plot_error)
            }
            Sign::Touchdown => {
                self.area.draw(&Circle::new(at, self.px(4), WHITE.filled())).map_err(to_plot_error)?;
                self.area.draw(&Circle::new(at, self.px(4), self.edge(LINE, 1))).map_err(to_plot_error)
            }
            Sign::PipeSupport => {
                self.area.draw(&Circle::new(at, self.px(5), WHITE.filled())).map_err(to_plot_error)?;
                self.area.draw(&Circle::new(at, self.px(5), self.edge(BLACK, 1))).map_err(to_plot_error)?;
                self.area.draw(&Circle::new(at, self.px(1), BLACK.filled())).map_err(to_plot_error)
            }
            Sign::Fender => {
                let [w, h] = [4, 7].map(|half| self.px(half));
                let corners = [(x - w, y - h), (x + w, y + h)];
                self.area.draw(&Rectangle::new(corners, RGBColor(90, 70, 50).filled())).map_err(to_plot_error)
            }
            Sign::Fairlead => self.area.draw(&Circle::new(at, self.px(3), BLACK.filled())).map_err(to_plot_error),
            Sign::Anchor => {
                self.area.draw(&TriangleMarker::new(at, self.px(7), GROUND.1.filled())).map_err(to_plot_error)
            }
        }
    }

    /// A line in the colours of its tension.
    fn tension_path(
        &self,
        stroke: Stroke,
        points: &[(i32, i32)],
        (tensions, scale): (&[f64], &TensionScale),
    ) -> DrawOutcome<()> {
        let width = if stroke == Stroke::Pipe { 4 } else { 2 };
        let steps: Vec<i32> =
            tensions.iter().zip(tensions.iter().skip(1)).map(|(a, b)| scale.step(0.5 * (a + b))).collect();
        let mut start = 0;
        // pieces of one colour are drawn at once
        for (index, step) in steps.iter().enumerate() {
            if steps.get(index + 1) != Some(step) {
                let piece = points.get(start..=index + 1).unwrap_or_default().to_vec();
                self.path(piece, TensionScale::colour(*step), width)?;
                start = index + 1;
            }
        }
        Ok(())
    }

    /// The bar of the colours of tension, its upper left corner at a place: its least and largest tension in words, and what it shows.
    pub fn tension_bar(&self, (x, y): (i32, i32), [low, high, caption]: [&str; 3]) -> DrawOutcome<()> {
        let (step, height, gap) = (self.px(5), self.px(12), self.px(8));
        let top = y - height / 2;
        self.text(low, (x, y - self.px(8)), TEXT, BLACK)?;
        let left = x + self.look.text_width(low) + gap;
        for number in 0..TENSION_STEPS {
            let corners = [(left + number * step, top), (left + (number + 1) * step, top + height)];
            self.area.draw(&Rectangle::new(corners, TensionScale::colour(number).filled())).map_err(to_plot_error)?;
        }
        let right = left + TENSION_STEPS * step + gap;
        self.text(&format!("{high} {caption}"), (right, y - self.px(8)), TEXT, BLACK)
    }

    /// An arrow to the north about a place: `direction` is where north lies in the picture (to the right, up).
    pub fn north(&self, at: (i32, i32), [h, v]: [f64; 2]) -> DrawOutcome<()> {
        let position = |along: f64, across: f64| {
            let (x, y) = (along * h - across * v, along * v + across * h);
            let unit = f64::from(self.look.unit);
            (at.0 + (unit * x).round() as i32, at.1 - (unit * y).round() as i32)
        };
        let half = |side: f64| vec![position(24.0, 0.0), position(-14.0, side), position(-7.0, 0.0)];
        self.area.draw(&Polygon::new(half(9.0), BLACK.filled())).map_err(to_plot_error)?;
        let other = half(-9.0);
        self.path(other.iter().chain(other.first()).copied().collect(), BLACK, 1)?;
        let (x, y) = position(35.0, 0.0);
        self.text("N", (x - self.look.text_width("N") / 2, y - self.px(8)), TEXT, BLACK)
    }

    /// The axes of a view, about a pixel.
    pub fn axes(&self, view: &View, at: (i32, i32)) -> DrawOutcome<()> {
        for (name, [h, v]) in view.axes() {
            let unit = f64::from(self.look.unit);
            let off = |length: f64| (at.0 + (length * h).round() as i32, at.1 - (length * v).round() as i32);
            let tip = off(ARROW * unit);
            self.path(vec![at, tip], BLACK, 1)?;
            // the two strokes of the head, a sixth of a turn off the shaft
            for turn in [0.5f64, -0.5] {
                let (s, c) = turn.sin_cos();
                let back = (7.0 * unit * (h * c - v * s), 7.0 * unit * (h * s + v * c));
                self.path(vec![tip, (tip.0 - back.0.round() as i32, tip.1 + back.1.round() as i32)], BLACK, 1)?;
            }
            let (x, y) = off((ARROW + 10.0) * unit);
            self.text(name, (x - self.look.text_width(name) / 2, y - self.px(8)), TEXT, BLACK)?;
        }
        Ok(())
    }

    /// A scale bar that ends at a pixel, of a length in pixels, with its words.
    pub fn scale(&self, (right, y): (i32, i32), length: i32, words: &str) -> DrawOutcome<()> {
        let left = right - length;
        self.path(vec![(left, y), (right, y)], BLACK, 2)?;
        for x in [left, right] {
            self.path(vec![(x, y - self.px(5)), (x, y + self.px(5))], BLACK, 2)?;
        }
        let width = self.look.text_width(words);
        self.text(words, (left - width - self.px(10), y - self.px(8)), TEXT, BLACK)
    }

    /// The edge of a view.
    pub fn frame(&self, frame: &ViewFrame) -> DrawOutcome<()> {
        let [left, top, width, height] = frame.at;
        let corners = [(left, top), (left + width, top + height)];
        self.area.draw(&Rectangle::new(corners, self.edge(FAINT, 1))).map_err(to_plot_error)
    }

    /// One view of a scene within its frame; the number of names that found no place.
    pub fn view(
        &self,
        (scene, tensions): (&Scene, Option<&TensionScale>),
        view: &View,
        frame: &ViewFrame,
        names: bool,
    ) -> DrawOutcome<usize> {
        let mut sheet = Sheet::new(frame.at, self.look.letter);
        let mut labels = Vec::new();
        let pixel = |at: [f64; 3]| frame.pixel(view.project(at));
        match view.kind {
            ViewKind::Plan => {}
            ViewKind::Elevation => self.levels(scene, view, frame, (&mut sheet, &mut labels))?,
            ViewKind::Axonometric => self.planes(scene, view, frame)?,
        }
        for body in &scene.bodies {
            self.body(body, (&pixel, view), &mut sheet)?;
            labels.push(Label { text: body.name.clone(), at: pixel(body.origin), tone: 0 });
        }
        for path in STROKES.iter().flat_map(|(stroke, _)| scene.paths.iter().filter(move |p| p.stroke == *stroke)) {
            let mut points: Vec<(i32, i32)> = path.points.iter().map(|at| pixel(*at)).collect();
            let coloured = tensions.filter(|_| path.tensions.len() == points.len() && path.stroke != Stroke::Inactive);
            if let Some(scale) = coloured {
                self.tension_path(path.stroke, &points, (&path.tensions, scale))?;
            }
            points.dedup();
            sheet.mark(&points);
            let named = if path.grounded { points.last() } else { points.get(points.len() / 2) };
            if let Some(at) = named.filter(|_| path.stroke != Stroke::Bottom) {
                labels.push(Label { text: path.name.clone(), at: *at, tone: 1 });
            }
            if coloured.is_none() {
                self.stroke(path.stroke, points)?;
            }
        }
        for mark in SIGNS.iter().flat_map(|(sign, _)| scene.marks.iter().filter(move |m| m.sign == *sign)) {
            let (x, y) = pixel(mark.at);
            sheet.mark(&[(x - self.px(3), y), (x + self.px(3), y)]);
            self.sign(mark.sign, (x, y))?;
            if !mark.name.is_empty() {
                labels.push(Label { text: mark.name.clone(), at: (x, y), tone: 2 });
            }
        }
        self.names(&sheet, labels, names)
    }

    /// A body: its panels that face the viewer are filled, then come its sharp edges, thin, and its silhouette. Edges that fall
    /// together are drawn once. A body without panels is the convex hull of its points.
    fn body(
        &self,
        body: &Outline,
        (pixel, view): (&dyn Fn([f64; 3]) -> (i32, i32), &View),
        sheet: &mut Sheet,
    ) -> DrawOutcome<()> {
        if !self.look.terminal {
            for panel in &body.panels {
                let corners: Vec<(i32, i32)> = panel.iter().map(|at| pixel(*at)).collect();
                if twice_area(&corners) != 0 {
                    // with an edge of its own colour, so that no seam is left between two panels
                    self.area.draw(&Polygon::new(corners.clone(), BODY.filled())).map_err(to_plot_error)?;
                    self.path(corners.iter().chain(corners.first()).copied().collect(), BODY, 1)?;
                }
            }
        }
        let (mut thin, mut thick) = (BTreeSet::new(), BTreeSet::new());
        let viewer = view.viewer();
        for edge in &body.edges {
            let [a, b] = edge.ends.map(pixel);
            let found = if edge.is_silhouette(viewer) {
                &mut thick
            } else if edge.is_sharp() {
                &mut thin
            } else {
                continue;
            };
            if a != b {
                found.insert((a.min(b), a.max(b)));
            }
        }
        for (a, b) in thin.difference(&thick) {
            self.path(vec![*a, *b], RGBColor(110, 110, 110), 1)?;
        }
        for (a, b) in thick {
            sheet.mark(&[a, b]);
            self.path(vec![a, b], BLACK, 2)?;
        }
        let ring = hull(body.points.iter().map(|at| pixel(*at)).collect());
        if ring.len() > 2 && !self.look.terminal {
            self.area.draw(&Polygon::new(ring.clone(), BODY.filled())).map_err(to_plot_error)?;
        }
        let closed: Vec<_> = ring.iter().chain(ring.first()).copied().collect();
        sheet.mark(&closed);
        self.path(closed, BLACK, 2)
    }

    /// Writes the names; those of water and ground whether names are wanted or not.
    fn names(&self, sheet: &Sheet, mut labels: Vec<Label>, names: bool) -> DrawOutcome<usize> {
        labels.retain(|l| names || l.tone >= 3);
        // what is largest is named first
        labels.sort_by_key(|l| if l.tone >= 3 { 0 } else { l.tone + 1 });
        let (placed, left_out) = sheet.position(labels);
        let tones = [BLACK, LINE, RGBColor(90, 90, 90), WATER.1, GROUND.1];
        for name in &placed {
            let [left, top, width, height] = name.at;
            let (x, y) = name.label.at;
            let near = (x.clamp(left, left + width), y.clamp(top, top + height));
            if !self.look.terminal && (name.is_ambiguous || (near.0 - x).abs().max((near.1 - y).abs()) > self.px(14)) {
                self.path(vec![(x, y), near], RGBColor(150, 150, 150), 1)?;
            }
        }
        for name in placed {
            let colour = tones.get(name.label.tone).copied().unwrap_or(BLACK);
            let [left, top, width, height] = name.at;
            if !self.look.terminal {
                // where no free place was left a line runs through the name: it shines through faintly
                let around = [(left, top), (left + width, top + height)];
                self.area.draw(&Rectangle::new(around, WHITE.mix(0.7).filled())).map_err(to_plot_error)?;
            }
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

/// Twice the area of a polygon, positive or negative by the way it runs.
fn twice_area(corners: &[(i32, i32)]) -> i64 {
    let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
    let wide = |v: i32| i64::from(v);
    pairs.map(|(a, b)| wide(a.0) * wide(b.1) - wide(b.0) * wide(a.1)).sum()
}

/// The mark of a sign in a terminal, as an index of its marks.
pub fn mark_index(sign: Sign) -> usize {
    match sign {
        Sign::Touchdown => 1,
        Sign::Fairlead => 2,
        Sign::Origin => 3,
        Sign::Anchor => 4,
        Sign::Joint => 5,
        Sign::PipeSupport => 6,
        Sign::Fender => 7,
    }
}
