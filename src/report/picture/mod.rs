//! Pictures: a scene in one or more views, on a page (SVG, PNG) or in the terminal.

mod draw;
mod labels;
mod view;

pub use view::View;

use crate::report::format;
use crate::report::page;
use crate::report::plot::draw::to_plot_error;
use crate::report::plot::{PlotError, SUBPIXELS, draw_svg, raster, terminal};
use draw::{Pen, PictureStyle, SIGNS, STROKES, TensionScale, mark_index};
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::prelude::{BLACK, DrawingBackend, RGBColor, WHITE};
use std::cell::RefCell;
use std::rc::Rc;
use view::{Extent, ViewFrame, ViewKind, round_length};
use windlass_base::geometry::{Position, unit_vector};
use windlass_base::units::{Dim, UnitSystem};
use windlass_solve::scene::{Scene, Sign, Stroke};

/// Width of a page unless another is asked for (pixels).
pub const USUAL_WIDTH: i32 = 1000;
/// Margin of a page (tenths of a pixel, as all lengths of a page).
const MARGIN: i32 = 16 * SUBPIXELS;
/// Height of the title, of the words above a view, of the axes and scale below it, of a row of the legend.
const ROW_HEIGHTS: [i32; 4] = [44 * SUBPIXELS, 24 * SUBPIXELS, 68 * SUBPIXELS, 26 * SUBPIXELS];
/// Room left free within the frame of a view: at each side, above and below.
const FRAME_MARGINS: (i32, i32) = (70 * SUBPIXELS, 36 * SUBPIXELS);
/// Least and largest height of a view: of a plan or isometric view, and of an elevation.
const HEIGHTS: [(i32, i32); 2] = [(160 * SUBPIXELS, 620 * SUBPIXELS), (150 * SUBPIXELS, 420 * SUBPIXELS)];
/// Width of a letter of a large title (pixels).
const TITLE_LETTER: i32 = 12;
/// A coordinate beyond this (m) is not drawn.
const MAX_COORDINATE_M: f64 = 1e9;

/// A picture of a system.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Title.
    pub title: String,
    /// What is drawn.
    pub scene: Scene,
    /// From where, one drawing each.
    pub views: Vec<View>,
    /// Whether names are written.
    pub names: bool,
    /// Units of the scale bar.
    pub units: UnitSystem,
    /// Whether lines have the colours of their tension in a file.
    pub tensions: bool,
    /// Where north lies, from +X toward +Y (rad), where plans show it.
    pub north: Option<f64>,
    /// Width in a file (pixels).
    pub width: i32,
}

/// An entry of the legend.
#[derive(Clone, Copy)]
enum LegendEntry {
    Stroke(Stroke, &'static str),
    Sign(Sign, &'static str),
}

impl LegendEntry {
    /// Its width with the room behind it (tenths of a pixel).
    fn width(self, look: &PictureStyle) -> i32 {
        let (drawn, words) = match self {
            LegendEntry::Stroke(_, words) => (36, words),
            LegendEntry::Sign(_, words) => (18, words),
        };
        look.px(drawn + 22) + look.text_width(words)
    }
}

/// How a page is drawn.
const PAGE_STYLE: PictureStyle =
    PictureStyle { terminal: false, unit: SUBPIXELS, letter: (8 * SUBPIXELS, 16 * SUBPIXELS) };

/// The corners of a rectangle at an elevation about all that a scene holds, with a little room.
fn corners_around(scene: &Scene, z: f64) -> [Position; 4] {
    let extent = Extent::from_points(scene.positions().map(|[x, y, _]| [x, y]));
    let extent = extent.unwrap_or(Extent { low: [0.0; 2], high: [0.0; 2] });
    let [w, h] = extent.size().map(|s| 0.05 * s);
    let ([x0, y0], [x1, y1]) = (extent.low, extent.high);
    [[x0 - w, y0 - h, z], [x1 + w, y0 - h, z], [x1 + w, y1 + h, z], [x0 - w, y1 + h, z]]
}

impl Picture {
    /// What a view reaches; water and ground belong to every view but the plan.
    fn extent(&self, view: &View) -> Result<Extent, PlotError> {
        if let Some(far) =
            self.scene.positions().find(|p| p.iter().any(|c| !c.is_finite() || c.abs() > MAX_COORDINATE_M))
        {
            let size = |i: usize| far.get(i).copied().unwrap_or(f64::NAN);
            return Err(PlotError::Range(size(0), size(1)));
        }
        let mut positions: Vec<Position> = self.scene.positions().collect();
        let first = *positions.first().ok_or(PlotError::Empty)?;
        let levels = [Some(self.scene.surface), self.scene.bottom].into_iter().flatten();
        match view.kind {
            ViewKind::Plan => {}
            ViewKind::Elevation => positions.extend(levels.map(|z| [first[0], first[1], z])),
            ViewKind::Axonometric => positions.extend(levels.flat_map(|z| corners_around(&self.scene, z))),
        }
        Extent::from_points(positions.into_iter().map(|at| view.project(at))).ok_or(PlotError::Empty)
    }

    /// The picture as a file, by the ending of its name, with the number of names that found no place.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn file(&self, name: &str) -> Result<(Vec<u8>, usize), PlotError> {
        match name.rsplit_once('.').map(|(_, end)| end.to_ascii_lowercase()).as_deref() {
            Some("svg") => self.svg(),
            Some("png") => self.png(),
            _ => Err(PlotError::PictureKind(name.to_string())),
        }
    }

    fn svg(&self) -> Result<(Vec<u8>, usize), PlotError> {
        let panels = self.panels()?;
        draw_svg(self.page_size(&panels), |area| self.page(area, &panels))
    }

    fn png(&self) -> Result<(Vec<u8>, usize), PlotError> {
        let panels = self.panels()?;
        let (width, height) = self.page_size(&panels);
        let canvas = Rc::new(RefCell::new(raster::RasterCanvas::new(width, height)));
        let left_out = self.page(&DrawingArea::from(&canvas), &panels)?;
        let bytes = canvas.borrow().encode().map_err(|e| PlotError::Backend(e.to_string()))?;
        Ok((bytes, left_out))
    }

    /// Width and height of the page (pixels).
    fn page_size(&self, panels: &[(View, ViewFrame)]) -> (u32, u32) {
        let pixels = |length: i32| (length / SUBPIXELS).unsigned_abs();
        (pixels(self.width * SUBPIXELS), pixels(self.height(panels)))
    }

    /// The frames of the views on a page, one below the other, each as high as it needs.
    fn panels(&self) -> Result<Vec<(View, ViewFrame)>, PlotError> {
        let [title, head, foot, _] = ROW_HEIGHTS;
        let width = self.width * SUBPIXELS - 2 * MARGIN;
        let mut top = title;
        let mut panels = Vec::new();
        for view in &self.views {
            let extent = self.extent(view)?;
            let [w, h] = extent.size();
            let [plan, side] = HEIGHTS;
            let (least, most) = if view.kind == ViewKind::Elevation { side } else { plan };
            // a wider page is higher too
            let most = (i64::from(most) * i64::from(self.width.max(USUAL_WIDTH)) / i64::from(USUAL_WIDTH)) as i32;
            let natural = f64::from(width - 2 * FRAME_MARGINS.0) * h / w + f64::from(2 * FRAME_MARGINS.1);
            let height = (natural.round() as i32).clamp(least, most);
            panels.push((*view, ViewFrame::fit(&extent, [MARGIN, top + head, width, height], FRAME_MARGINS)));
            top += head + height + foot;
        }
        Ok(panels)
    }

    /// The colours of tension; `None` where they are not wanted or no tension is known.
    fn tension_scale(&self) -> Option<TensionScale> {
        TensionScale::of_scene(&self.scene).filter(|_| self.tensions)
    }

    fn height(&self, panels: &[(View, ViewFrame)]) -> i32 {
        let [title, _, foot, row] = ROW_HEIGHTS;
        let rows = i32::try_from(self.legend_rows().len().max(1)).unwrap_or(1);
        let bar = i32::from(self.tension_scale().is_some());
        panels.last().map_or(title, |(_, frame)| frame.at[1] + frame.at[3] + foot) + (rows + bar) * row + MARGIN / 2
    }

    fn page<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        panels: &[(View, ViewFrame)],
    ) -> Result<usize, PlotError> {
        let look = &PAGE_STYLE;
        let pen = Pen::new(area, look);
        let px = |pixels: i32| look.px(pixels);
        area.fill(&WHITE).map_err(to_plot_error)?;
        let letters = i32::try_from(self.title.chars().count()).unwrap_or(i32::MAX);
        let title_size = if letters.saturating_mul(TITLE_LETTER) > self.width { 15 } else { 22 };
        pen.text(&self.title, (MARGIN, px(12)), title_size, BLACK)?;
        let mut left_out = 0;
        let tensions = self.tension_scale();
        for (view, frame) in panels {
            let [left, top, width, height] = frame.at;
            pen.text(&view.title(), (left, top - px(20)), 15, BLACK)?;
            left_out += pen.view((&self.scene, tensions.as_ref()), view, frame, self.names)?;
            pen.frame(frame)?;
            let (right, low) = (left + width, top + height);
            pen.axes(view, (left + px(44), low + px(50)))?;
            if let (Some(north), ViewKind::Plan) = (self.north, view.kind) {
                let (cos, sin) = unit_vector(north);
                pen.north((right - px(40), top + px(52)), view.project([cos, sin, 0.0]))?;
            }
            let (length, words) = self.scale(frame, 0.25 * f64::from(width));
            pen.scale((right - px(10), low + px(20)), length, &words)?;
        }
        let mut y = self.height(panels) - MARGIN / 2 - ROW_HEIGHTS[3] / 2;
        if let Some(scale) = tensions {
            let [low, high] = [scale.low, scale.high].map(|tension| Dim::Force.from_si(tension, self.units));
            let value = |tension: f64| format::tick(tension, (high - low).max(1e-3 * high.abs()) / 100.0, high.abs());
            let caption = format!("tension along the line ({})", Dim::Force.label(self.units));
            pen.tension_bar((MARGIN, y), [&value(low), &value(high), &caption])?;
            y -= ROW_HEIGHTS[3];
        }
        let grey = RGBColor(60, 60, 60);
        for row in self.legend_rows().into_iter().rev() {
            let mut x = MARGIN;
            for entry in row {
                match entry {
                    LegendEntry::Stroke(stroke, words) => {
                        pen.stroke(stroke, vec![(x, y), (x + px(30), y)])?;
                        pen.text(words, (x + px(36), y - px(8)), 15, grey)?;
                    }
                    LegendEntry::Sign(sign, words) => {
                        pen.sign(sign, (x + px(6), y))?;
                        pen.text(words, (x + px(18), y - px(8)), 15, grey)?;
                    }
                }
                x += entry.width(look);
            }
            y -= ROW_HEIGHTS[3];
        }
        Ok(left_out)
    }

    /// The entries of the legend, in rows as wide as the page.
    fn legend_rows(&self) -> Vec<Vec<LegendEntry>> {
        let strokes = self.strokes().map(|(stroke, words)| LegendEntry::Stroke(stroke, words));
        let signs = self.signs().map(|(sign, words)| LegendEntry::Sign(sign, words));
        let room = self.width * SUBPIXELS - 2 * MARGIN;
        let (mut rows, mut filled): (Vec<Vec<LegendEntry>>, i32) = (Vec::new(), room);
        for entry in strokes.chain(signs) {
            let width = entry.width(&PAGE_STYLE);
            // the room behind the last entry of a row may lie in the margin
            if filled + width - PAGE_STYLE.px(22) > room {
                rows.push(Vec::new());
                filled = 0;
            }
            filled += width;
            if let Some(row) = rows.last_mut() {
                row.push(entry);
            }
        }
        rows
    }

    /// A round length in user units that takes at most so many pixels: its pixels, and its words.
    fn scale(&self, frame: &ViewFrame, most: f64) -> (i32, String) {
        let unit = Dim::Length.from_si(1.0, self.units);
        let round = round_length(most / frame.scale * unit);
        let pixels = (round / unit * frame.scale).round() as i32;
        (
            pixels,
            format!(
                "{} {}",
                format::number_in_full(format::rounded_to_fifteen_figures(round)),
                Dim::Length.label(self.units)
            ),
        )
    }

    fn strokes(&self) -> impl Iterator<Item = (Stroke, &'static str)> + '_ {
        STROKES.into_iter().filter(|(stroke, _)| self.scene.paths.iter().any(|p| p.stroke == *stroke))
    }

    fn signs(&self) -> impl Iterator<Item = (Sign, &'static str)> + '_ {
        SIGNS.into_iter().filter(|(sign, _)| self.scene.marks.iter().any(|m| m.sign == *sign))
    }

    /// The picture for a terminal of so many columns and lines, each view in as many; the legend stands below.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn terminal(&self, columns: usize, lines: usize) -> Result<String, PlotError> {
        let (columns, lines) = (columns.clamp(20, 200), lines.clamp(10, 100));
        let look = PictureStyle { terminal: true, unit: 1, letter: (2, 4) };
        let mut text = String::new();
        for view in &self.views {
            // three lines are for the title, the view and the scale
            let size = |n: usize, dots: i32| i32::try_from(n).unwrap_or(0) * dots;
            let extent = self.extent(view)?;
            let [w, h] = extent.size();
            let (width, free) = (size(columns, 2), (size(columns, 2) / 20 + 6, 6));
            // no higher than it needs
            let needed = f64::from(width - 2 * free.0) * h / w + f64::from(2 * free.1);
            let height = ((needed / 4.0).ceil() as usize + 2).min(lines - 3);
            let at = [0, 0, width, size(height, 4)];
            let frame = ViewFrame::fit(&extent, at, free);
            let canvas = Rc::new(RefCell::new(terminal::TextCanvas::new(columns, height)));
            Pen::new(&DrawingArea::from(&canvas), &look).view((&self.scene, None), view, &frame, self.names)?;
            for line in [page::centre(&self.title, columns), page::centre(&view.title(), columns)] {
                text.push_str(line.trim_end());
                text.push('\n');
            }
            text.push_str(&canvas.borrow().text());
            let (dots, words) = self.scale(&frame, 0.5 * f64::from(at[2]));
            let bar = "-".repeat(usize::try_from(dots / 2).unwrap_or(0).saturating_sub(2));
            text.push_str(&format!("   |{bar}|  {words}   {}\n", view.axes_in_words()));
        }
        for (sign, words) in self.signs() {
            text.push_str(&format!("   {}  {words}\n", terminal::mark(mark_index(sign))));
        }
        Ok(text)
    }
}
