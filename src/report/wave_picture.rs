//! A picture of waves at bodies: their elevation around them in plan, and their pressure on the hulls, seen from below.

use crate::report::format;
use crate::report::plot::draw::to_plot_error;
use crate::report::plot::{PlotError, SUBPIXELS, draw_svg, raster};
use nalgebra::{Complex, Vector3};
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{PathElement, Polygon, Rectangle, Text};
use plotters::prelude::{BLACK, Color, DrawingBackend, RGBColor, WHITE};
use plotters::style::{IntoTextStyle, TextStyle};
use std::cell::RefCell;
use std::f64::consts::PI;
use std::rc::Rc;

type C = Complex<f64>;

/// Stops of the colours of amplitudes, from least to largest: they grow lighter evenly, for eyes that see few colours and for paper.
const AMPLITUDE_STOPS: [[f64; 3]; 5] =
    [[0.27, 0.0, 0.33], [0.23, 0.32, 0.55], [0.13, 0.57, 0.55], [0.37, 0.79, 0.38], [0.99, 0.91, 0.14]];
/// Those of values of both signs: white is none.
const SIGNED_STOPS: [[f64; 3]; 5] =
    [[0.02, 0.19, 0.38], [0.57, 0.77, 0.87], [0.97, 0.97, 0.97], [0.96, 0.65, 0.51], [0.4, 0.0, 0.12]];
/// A body in the plan.
const BODY: RGBColor = RGBColor(205, 205, 205);
/// Side of a block of one colour (pixels).
const BLOCK: i32 = 2;
/// Bands of a scale of colours, about.
const BANDS: f64 = 16.0;
/// Margin of the page (pixels).
const MARGIN: i32 = 16;
/// Height of the title (pixels).
const TITLE: i32 = 44;
/// Height of a line of words (pixels).
const LINE: i32 = 26;
/// Width of a bar of colours with its numbers (pixels).
const BAR: i32 = 110;
/// Largest height of the plan over the width of the page.
const PLAN_SHARE: f64 = 0.75;
/// Height of a view of the hulls over its width.
const HULL_SHARE: f64 = 0.62;
/// How far below the horizon the viewer of the hulls stands (rad).
const BELOW: f64 = 25.0 * PI / 180.0;
/// How far beside the direction of the waves (rad).
const ASIDE: f64 = 40.0 * PI / 180.0;

/// Elevations on a grid (of an amplitude of 1), row by row from the lowest y; not finite within the bodies.
pub struct WaveGrid {
    /// x and y of its first point (m).
    pub low: [f64; 2],
    /// Distance of its points (m).
    pub step: f64,
    /// Points along x.
    pub columns: usize,
    /// The values.
    pub values: Vec<C>,
}

/// What is drawn. All is in global axes, for an amplitude of 1 m and the time factor `exp(-i omega t)`.
pub struct WavePicture {
    /// Title.
    pub title: String,
    /// What waves they are.
    pub waves: String,
    /// Elevations around the bodies.
    pub grid: WaveGrid,
    /// Sides of the waterlines (m).
    pub waterlines: Vec<[[f64; 2]; 2]>,
    /// Panels of the hulls (m), counter-clockwise as seen from the water, with the pressure on each over that of a column of water of the amplitude.
    pub panels: Vec<([Vector3<f64>; 4], C)>,
    /// Where the waves go to (rad).
    pub heading: f64,
    /// The phase of the instant that is shown (rad), the crest of the undisturbed wave being at the origin at 0; none of amplitudes.
    pub phase: Option<f64>,
    /// A length (m) and its words, for the scale of the plan.
    pub scale: (f64, String),
    /// Width of the page (pixels).
    pub width: i32,
}

/// A scale of colours in bands.
struct ColourScale {
    low: f64,
    step: f64,
    bands: usize,
    stops: [[f64; 3]; 5],
}

impl ColourScale {
    /// That of values, from zero, or of both signs.
    fn new(values: impl Iterator<Item = f64>, is_signed: bool) -> Self {
        let largest = values.filter(|value| value.is_finite()).fold(0.0, |most: f64, value| most.max(value.abs()));
        let largest = if largest > 0.0 { largest } else { 1.0 };
        let wanted = if is_signed { 2.0 } else { 1.0 } * largest / BANDS;
        let power = 10f64.powf(wanted.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|step| *step >= wanted).unwrap_or(wanted);
        let half = (largest / step - 1e-9).ceil().max(1.0);
        let (low, bands) = if is_signed { (-half * step, 2.0 * half) } else { (0.0, half) };
        let stops = if is_signed { SIGNED_STOPS } else { AMPLITUDE_STOPS };
        ColourScale { low, step, bands: bands as usize, stops }
    }

    fn band(&self, value: f64) -> usize {
        let at = ((value - self.low) / self.step).floor();
        if at > 0.0 { (at as usize).min(self.bands - 1) } else { 0 }
    }

    fn colour(&self, band: usize) -> RGBColor {
        let at = (band as f64 + 0.5) / self.bands as f64 * 4.0;
        let below = (at.floor() as usize).min(3);
        let stop = |n: usize| self.stops.get(n).copied().unwrap_or_default();
        let (from, to) = (stop(below), stop(below + 1));
        let [r, g, b] = [0, 1, 2].map(|i| (255.0 * (from[i] + (at - below as f64) * (to[i] - from[i]))).round() as u8);
        RGBColor(r, g, b)
    }

    fn words(&self, edge: usize) -> String {
        let value = self.low + self.step * edge as f64;
        format::tick(value, self.step, self.step * self.bands as f64)
    }
}

impl WaveGrid {
    fn rows(&self) -> usize {
        self.values.len() / self.columns.max(1)
    }

    fn value(&self, column: usize, row: usize) -> C {
        self.values.get(row * self.columns + column).copied().unwrap_or(C::new(f64::NAN, f64::NAN))
    }

    /// The value that is shown at a place, between those of the points as contours are; of those that are not finite the others stand in.
    fn shown_at(&self, [x, y]: [f64; 2], phase: Option<f64>) -> f64 {
        let share = |at: f64, low: f64, count: usize| {
            let s = ((at - low) / self.step).clamp(0.0, count.saturating_sub(1) as f64);
            let first = (s.floor() as usize).min(count.saturating_sub(2));
            (first, s - first as f64)
        };
        let (column, u) = share(x, self.low[0], self.columns);
        let (row, v) = share(y, self.low[1], self.rows());
        let corners = [(0, 0, (1.0 - u) * (1.0 - v)), (1, 0, u * (1.0 - v)), (0, 1, (1.0 - u) * v), (1, 1, u * v)];
        let (mut sum, mut weight) = (0.0, 0.0);
        for (dx, dy, share) in corners {
            let value = shown(self.value(column + dx, row + dy), phase);
            if value.is_finite() {
                sum += value * (share + 1e-9);
                weight += share + 1e-9;
            }
        }
        sum / weight
    }
}

/// Whether a place is within waterlines.
pub fn is_within(waterlines: &[[[f64; 2]; 2]], [x, y]: [f64; 2]) -> bool {
    let crossed = waterlines
        .iter()
        .filter(|[a, b]| (a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]));
    crossed.count() % 2 == 1
}

/// The shown value of an amplitude: its size, or what it is at a phase.
fn shown(value: C, phase: Option<f64>) -> f64 {
    phase.map_or(value.norm(), |phase| (value * C::from_polar(1.0, -phase)).re)
}

/// A surface to draw on, in pixels.
struct Sheet<'a, B: DrawingBackend> {
    area: &'a DrawingArea<B, Shift>,
}

impl<B: DrawingBackend> Sheet<'_, B> {
    fn text(&self, text: &str, (x, y): (i32, i32), size: i32) -> Result<(), PlotError> {
        let style: TextStyle = ("sans-serif", size * SUBPIXELS).into_text_style(self.area).color(&BLACK);
        let at = (x * SUBPIXELS, y * SUBPIXELS);
        self.area.draw(&Text::new(text.to_string(), at, style)).map_err(to_plot_error)
    }

    fn block(&self, [(left, top), (right, low)]: [(i32, i32); 2], colour: RGBColor) -> Result<(), PlotError> {
        let corners = [(left * SUBPIXELS, top * SUBPIXELS), (right * SUBPIXELS, low * SUBPIXELS)];
        self.area.draw(&Rectangle::new(corners, colour.filled())).map_err(to_plot_error)
    }

    /// A path through points in tenths of a pixel.
    fn path(&self, points: Vec<(i32, i32)>, colour: RGBColor, width: u32) -> Result<(), PlotError> {
        let style = colour.stroke_width(width);
        self.area.draw(&PathElement::new(points, style)).map_err(to_plot_error)
    }

    /// The bar of a scale, its upper left corner at a place.
    fn bar(&self, scale: &ColourScale, (x, y): (i32, i32), height: i32) -> Result<(), PlotError> {
        let edge = |band: usize| y + height - (f64::from(height) * band as f64 / scale.bands as f64).round() as i32;
        let every = scale.bands.div_ceil(12);
        for band in 0..scale.bands {
            self.block([(x, edge(band + 1)), (x + 18, edge(band))], scale.colour(band))?;
        }
        for band in (0..=scale.bands).step_by(every.max(1)) {
            self.text(&scale.words(band), (x + 24, edge(band) - 8), 15)?;
        }
        Ok(())
    }
}

/// A place of a plan on the page (tenths of a pixel).
struct PlanFrame {
    left: i32,
    low: i32,
    /// Pixels a metre.
    scale: f64,
    origin: [f64; 2],
}

impl PlanFrame {
    fn place(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let unit = f64::from(SUBPIXELS) * self.scale;
        (
            self.left * SUBPIXELS + (unit * (x - self.origin[0])).round() as i32,
            self.low * SUBPIXELS - (unit * (y - self.origin[1])).round() as i32,
        )
    }

    fn point(&self, (x, y): (f64, f64)) -> [f64; 2] {
        [
            self.origin[0] + (x - f64::from(self.left)) / self.scale,
            self.origin[1] + (f64::from(self.low) - y) / self.scale,
        ]
    }
}

impl WavePicture {
    /// The picture as a file, by the ending of its name.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn file(&self, name: &str) -> Result<Vec<u8>, PlotError> {
        let size = (self.width.unsigned_abs(), self.height().unsigned_abs());
        match name.rsplit_once('.').map(|(_, end)| end.to_ascii_lowercase()).as_deref() {
            Some("svg") => draw_svg(size, |area| self.page(area)).map(|(bytes, ())| bytes),
            Some("png") => {
                let canvas = Rc::new(RefCell::new(raster::RasterCanvas::new(size.0, size.1)));
                self.page(&DrawingArea::from(&canvas))?;
                let bytes = canvas.borrow().encode().map_err(|error| PlotError::Backend(error.to_string()))?;
                Ok(bytes)
            }
            _ => Err(PlotError::PictureKind(name.to_string())),
        }
    }

    /// Width and height of the plan (pixels), and pixels a metre.
    fn plan_size(&self) -> (i32, i32, f64) {
        let room = f64::from(self.width - 2 * MARGIN - BAR);
        let [w, h] = [self.grid.columns, self.grid.rows()].map(|n| self.grid.step * n.saturating_sub(1).max(1) as f64);
        let scale = (room / w).min(f64::from(self.width) * PLAN_SHARE / h);
        ((scale * w).round() as i32, (scale * h).round() as i32, scale)
    }

    /// Width and height of a view of the hulls (pixels).
    fn hull_size(&self) -> (i32, i32) {
        let width = (self.width - 2 * MARGIN - BAR) / 2;
        (width, (f64::from(width) * HULL_SHARE).round() as i32)
    }

    fn height(&self) -> i32 {
        TITLE + 3 * LINE + self.plan_size().1 + 2 * LINE + self.hull_size().1 + LINE + MARGIN
    }

    fn page<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), PlotError> {
        let sheet = Sheet { area };
        area.fill(&WHITE).map_err(to_plot_error)?;
        let letters = i32::try_from(self.title.chars().count()).unwrap_or(i32::MAX);
        sheet.text(&self.title, (MARGIN, 12), if letters.saturating_mul(12) > self.width { 15 } else { 22 })?;
        sheet.text(&self.waves, (MARGIN, TITLE), 15)?;
        let what = |of: &str| match self.phase {
            None => format!("{of}, largest in a period"),
            Some(phase) => format!("{of} at {:.0} degrees of the period", phase.to_degrees()),
        };
        sheet.text(&what("wave elevation over the amplitude"), (MARGIN, TITLE + LINE), 15)?;
        let top = TITLE + 2 * LINE;
        self.plan(&sheet, top)?;
        let top = top + self.plan_size().1 + 2 * LINE;
        sheet.text(&what("pressure on the hulls over density x gravity x amplitude"), (MARGIN, top - LINE), 15)?;
        self.hulls(&sheet, top)
    }

    fn plan<B: DrawingBackend>(&self, sheet: &Sheet<B>, top: i32) -> Result<(), PlotError> {
        let (width, height, scale) = self.plan_size();
        let frame = PlanFrame { left: MARGIN, low: top + height, scale, origin: self.grid.low };
        let value = |at: [f64; 2]| self.grid.shown_at(at, self.phase);
        let colours =
            ColourScale::new(self.grid.values.iter().map(|value| shown(*value, self.phase)), self.phase.is_some());
        // blocks of one colour that lie side by side are drawn at once
        let mut y = 0;
        while y < height {
            let low = (y + BLOCK).min(height);
            let (mut x, mut start) = (0, 0);
            let mut before: Option<Option<usize>> = None;
            loop {
                let middle = frame.point((
                    f64::from(MARGIN) + f64::from(x) + 0.5 * f64::from(BLOCK),
                    f64::from(top) + 0.5 * f64::from(y + low),
                ));
                let own = if x >= width {
                    None
                } else if is_within(&self.waterlines, middle) {
                    Some(None)
                } else {
                    Some(Some(colours.band(value(middle))))
                };
                if own != before {
                    if let Some(band) = before {
                        let colour = band.map_or(BODY, |band| colours.colour(band));
                        sheet.block([(MARGIN + start, top + y), (MARGIN + x, top + low)], colour)?;
                    }
                    (before, start) = (own, x);
                }
                if x >= width {
                    break;
                }
                x = (x + BLOCK).min(width);
            }
            y += BLOCK;
        }
        self.contours(sheet, &frame, &colours)?;
        for side in &self.waterlines {
            sheet.path(side.map(|at| frame.place(at)).to_vec(), BLACK, 16)?;
        }
        let [left, right, low] = [MARGIN, MARGIN + width, top + height].map(|length| length * SUBPIXELS);
        let high = top * SUBPIXELS;
        sheet.path(vec![(left, high), (right, high), (right, low), (left, low), (left, high)], BLACK, 10)?;
        self.arrow(sheet, (MARGIN + 40, top + 40))?;
        let (length, words) = (&self.scale.0, &self.scale.1);
        let bar = (length * scale).round() as i32;
        let y = top + height + 14;
        sheet.block([(MARGIN + width - bar, y), (MARGIN + width, y + 3)], BLACK)?;
        let letters = i32::try_from(words.chars().count()).unwrap_or(0);
        sheet.text(words, (MARGIN + width - bar - 9 * letters - 8, y - 7), 15)?;
        sheet.bar(&colours, (MARGIN + width + 14, top + 8), (height - 16).max(60))
    }

    /// An arrow that the waves run along, about a pixel.
    fn arrow<B: DrawingBackend>(&self, sheet: &Sheet<B>, (x, y): (i32, i32)) -> Result<(), PlotError> {
        let (sine, cosine) = self.heading.sin_cos();
        let at = |along: f64, across: f64| {
            let unit = f64::from(SUBPIXELS);
            (
                x * SUBPIXELS + (unit * (along * cosine - across * sine)).round() as i32,
                y * SUBPIXELS - (unit * (along * sine + across * cosine)).round() as i32,
            )
        };
        sheet.path(vec![at(-28.0, 0.0), at(28.0, 0.0)], BLACK, 24)?;
        sheet.path(vec![at(16.0, 8.0), at(28.0, 0.0), at(16.0, -8.0)], BLACK, 24)
    }

    /// Lines of equal value between the bands (marching squares).
    fn contours<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        frame: &PlanFrame,
        colours: &ColourScale,
    ) -> Result<(), PlotError> {
        let grid = &self.grid;
        let place =
            |column: usize, row: usize| [grid.low[0] + grid.step * column as f64, grid.low[1] + grid.step * row as f64];
        for row in 0..grid.rows().saturating_sub(1) {
            for column in 0..grid.columns.saturating_sub(1) {
                let corners = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
                let values = corners.map(|(c, r)| shown(grid.value(c, r), self.phase));
                if values.iter().any(|value| !value.is_finite()) {
                    continue;
                }
                for band in 1..colours.bands {
                    let level = colours.low + colours.step * band as f64;
                    let crossed: Vec<(i32, i32)> = (0..4)
                        .filter_map(|i| {
                            let j = (i + 1) % 4;
                            let (a, b) = (values[i], values[j]);
                            let share = (level - a) / (b - a);
                            let ([ax, ay], [bx, by]) =
                                (place(corners[i].0, corners[i].1), place(corners[j].0, corners[j].1));
                            ((a < level) != (b < level))
                                .then(|| frame.place([ax + share * (bx - ax), ay + share * (by - ay)]))
                        })
                        .collect();
                    for pair in crossed.chunks_exact(2) {
                        sheet.path(pair.to_vec(), RGBColor(60, 60, 60), 6)?;
                    }
                }
            }
        }
        Ok(())
    }

    fn hulls<B: DrawingBackend>(&self, sheet: &Sheet<B>, top: i32) -> Result<(), PlotError> {
        let (width, height) = self.hull_size();
        let colours =
            ColourScale::new(self.panels.iter().map(|(_, value)| shown(*value, self.phase)), self.phase.is_some());
        let views = [
            (self.heading + PI + ASIDE, "seen from below and from where the waves come"),
            (self.heading + ASIDE, "seen from below and from where they go"),
        ];
        for ((from, words), left) in views.into_iter().zip([MARGIN, MARGIN + width]) {
            self.hull(sheet, &colours, from, [left, top, width, height])?;
            sheet.text(words, (left, top + height), 15)?;
        }
        sheet.bar(&colours, (MARGIN + 2 * width + 14, top + 8), height - 16)
    }

    /// The panels that face a viewer below the water who stands in a direction, the farthest first.
    fn hull<B: DrawingBackend>(
        &self,
        sheet: &Sheet<B>,
        colours: &ColourScale,
        from: f64,
        [left, top, width, height]: [i32; 4],
    ) -> Result<(), PlotError> {
        let out = Vector3::new(from.cos() * BELOW.cos(), from.sin() * BELOW.cos(), -BELOW.sin());
        let right = Vector3::new(-from.sin(), from.cos(), 0.0);
        let up = out.cross(&right);
        let flat = |at: &Vector3<f64>| [at.dot(&right), at.dot(&up)];
        let all = || self.panels.iter().flat_map(|(corners, _)| corners).map(flat);
        let Some(first) = all().next() else { return Ok(()) };
        let (low, high) = all().fold((first, first), |(low, high), [x, y]| {
            ([low[0].min(x), low[1].min(y)], [high[0].max(x), high[1].max(y)])
        });
        let [w, h] = [high[0] - low[0], high[1] - low[1]];
        let scale = (f64::from(width - 20) / w.max(1e-9)).min(f64::from(height - 20) / h.max(1e-9));
        let place = |at: &Vector3<f64>| {
            let [x, y] = flat(at);
            let off = |value: f64, middle: f64| f64::from(SUBPIXELS) * scale * (value - middle);
            (
                (left + width / 2) * SUBPIXELS + off(x, 0.5 * (low[0] + high[0])).round() as i32,
                (top + height / 2) * SUBPIXELS - off(y, 0.5 * (low[1] + high[1])).round() as i32,
            )
        };
        let mut seen: Vec<_> = self
            .panels
            .iter()
            .filter(|([a, b, c, d], _)| (c - a).cross(&(d - b)).dot(&out) > 0.0)
            .map(|panel| (panel.0.iter().sum::<Vector3<f64>>().dot(&out), panel))
            .collect();
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, (corners, value)) in seen {
            let points: Vec<(i32, i32)> = corners.iter().map(place).collect();
            let colour = colours.colour(colours.band(shown(*value, self.phase)));
            sheet.area.draw(&Polygon::new(points.clone(), colour.filled())).map_err(to_plot_error)?;
            let closed = points.iter().chain(points.first()).copied().collect();
            sheet.path(closed, RGBColor(70, 70, 70), 3)?;
        }
        Ok(())
    }
}
