//! Drawing a chart on any surface of plotters: axes, mesh, curves, legend.

use super::axis::PlotAxis;
use super::stroke::{CurveStyle, dashes};
use super::{Chart, PlotError, PlotSeries, PlotSize, SUBPIXELS, terminal};
use plotters::chart::{ChartBuilder, DualCoordChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind};
use plotters::element::{Circle, PathElement, Text};
use plotters::prelude::{BLACK, ChartContext, Color, DrawingBackend, RGBColor, WHITE};
use plotters::style::ShapeStyle;

/// Up to this many points a curve shows its points too, where no other column is of marks alone.
const MAX_MARKED_POINTS: usize = 60;
/// Radius of a point of a curve, and of a mark that stands alone (pixels).
const MARK_RADII: (i32, i32) = (3, 6);
/// Pixels from one tick to the next, about, along the page and up: room for its number.
const PIXELS_PER_TICK: [u32; 2] = [90, 60];
/// Least and most ticks of an axis.
const TICKS: [usize; 2] = [6, 16];
/// Width of a letter of a large title (pixels).
const TITLE_LETTER: u32 = 12;
/// Width of the stroke of a curve (pixels).
const CURVE_WIDTH: u32 = 2;
/// Height of a row of the legend, length of the stroke in it, width of a letter, room between two entries (pixels).
const LEGEND: [i32; 4] = [20, 34, 8, 26];
/// Most letters of a name in the legend; a longer one is cut.
const MAX_LEGEND_LETTERS: i32 = 60;
/// Most rows of a legend; further names are counted in its last row.
const MAX_LEGEND_ROWS: usize = 12;

/// What differs between a page and a terminal: sizes in pixels of the surface, numbers of ticks.
pub struct PlotStyle {
    pub terminal: bool,
    /// Units of the surface a pixel.
    pub unit: i32,
    pub text: i32,
    pub title: i32,
    margin: i32,
    areas: (i32, i32),
    ticks: (usize, usize),
    mark: i32,
}

impl PlotStyle {
    /// The page of a chart, in tenths of a pixel: as many ticks as its sides have room for, and a title as wide as it at most.
    pub fn page(chart: &Chart) -> PlotStyle {
        let PlotSize { width, height } = chart.size;
        let ([along, up], [least, most]) = (PIXELS_PER_TICK, TICKS);
        let ticks = |count: u32| usize::try_from(count).unwrap_or(0).clamp(least, most);
        let letters = u32::try_from(chart.title.chars().count()).unwrap_or(u32::MAX);
        let title = if letters.saturating_mul(TITLE_LETTER) > width { 15 } else { 22 };
        PlotStyle {
            terminal: false,
            unit: SUBPIXELS,
            text: 15 * SUBPIXELS,
            title: title * SUBPIXELS,
            margin: 16 * SUBPIXELS,
            areas: (54 * SUBPIXELS, 92 * SUBPIXELS),
            ticks: (ticks(width / along), ticks(height / up)),
            mark: 5 * SUBPIXELS,
        }
    }

    /// A terminal of so many characters; titles stand outside of the drawing.
    pub fn terminal(columns: usize, lines: usize) -> PlotStyle {
        let ticks = ((columns / 12).clamp(2, 10), (lines / 4).clamp(2, 10));
        PlotStyle { terminal: true, unit: 1, text: 4, title: 0, margin: 0, areas: (8, 22), ticks, mark: 3 }
    }

    /// Writes a title clear of the upper edge, and returns the surface below it.
    pub fn below_title<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        title: &str,
    ) -> Result<DrawingArea<B, Shift>, PlotError> {
        let area = area.margin(self.margin / 2, 0, 0, 0);
        area.titled(title, ("sans-serif", self.title)).map_err(to_plot_error)
    }

    /// A stroke of so many pixels.
    pub fn stroke(&self, colour: RGBColor, width: u32) -> ShapeStyle {
        colour.stroke_width(width.saturating_mul(self.unit.unsigned_abs()))
    }
}

/// A surface with its axes.
pub type PlotSurface<'a, B> = ChartContext<'a, B, Cartesian2d<PlotAxis, PlotAxis>>;

/// Draws a chart.
///
/// # Errors
/// A chart without a point or with one beyond all measure, or a surface that refuses.
pub fn draw<B: DrawingBackend>(chart: &Chart, area: &DrawingArea<B, Shift>, look: &PlotStyle) -> Result<(), PlotError> {
    let points = || chart.series.iter().flat_map(PlotSeries::finite);
    if let Some((x, y)) = points().find(|(x, y)| x.abs().max(y.abs()) > super::axis::MAX_PLOTTED_VALUE) {
        return Err(PlotError::Range(x, y));
    }
    area.fill(&WHITE).map_err(to_plot_error)?;
    let (area, below) = match legend_height(chart) {
        rows if rows > 0 && !look.terminal => {
            let height = area.dim_in_pixel().1;
            let legend = (rows * look.unit).unsigned_abs();
            let (upper, lower) = area.split_vertically(height.saturating_sub(legend));
            (upper, Some(lower))
        }
        _ => (area.clone(), None),
    };
    let (mut paper, _, y) = if chart.polar {
        let (plane, x, y) = super::polar::plane(chart, &area, look)?;
        (Paper::One(Box::new(plane)), x, y)
    } else {
        draw_mesh(chart, &area, look)?
    };
    let taken = chart.on_the_left(&y, right_axis(chart, look).as_ref());
    let (chart, plane) = (&taken, paper.plane());
    // marks that stand alone are drawn last, so that no line hides them
    for marks in [false, true] {
        for (index, series) in chart.series.iter().enumerate().filter(|(_, s)| s.is_marks() == marks) {
            curve(plane, index, series, (look, shows_points(chart, series)))?;
        }
    }
    if let Some(below) = below {
        legend(chart, &below, look)?;
    }
    Ok(())
}

/// A surface with the axes on the left and those on the right.
type TwoPlanes<'a, B> = DualCoordChartContext<'a, B, Cartesian2d<PlotAxis, PlotAxis>, Cartesian2d<PlotAxis, PlotAxis>>;

/// What a chart is drawn on.
enum Paper<'a, B: DrawingBackend> {
    One(Box<PlotSurface<'a, B>>),
    /// With an axis on the right.
    Two(Box<TwoPlanes<'a, B>>),
}

impl<'a, B: DrawingBackend> Paper<'a, B> {
    /// The plane of the axes below and on the left.
    fn plane(&mut self) -> &mut PlotSurface<'a, B> {
        match self {
            Paper::One(plane) => plane,
            Paper::Two(both) => both,
        }
    }
}

/// The axis on the right, of the curves that go by it.
fn right_axis(chart: &Chart, look: &PlotStyle) -> Option<PlotAxis> {
    chart.right_label.as_ref()?;
    PlotAxis::fit(chart.series.iter().filter(|s| s.right).flat_map(PlotSeries::finite).map(|p| p.1), look.ticks.1)
}

impl Chart {
    /// The same with all points in terms of the axis on the left, at the same place of the picture.
    fn on_the_left(&self, left: &PlotAxis, right: Option<&PlotAxis>) -> Chart {
        let mut made = self.clone();
        if let Some(right) = right {
            for point in made.series.iter_mut().filter(|s| s.right).flat_map(|s| &mut s.points).flatten() {
                point.1 = left.value(right.share(point.1));
            }
        }
        made
    }
}

/// Draws the axes and mesh of a chart, and returns the paper for its curves with its axes.
fn draw_mesh<'a, B: DrawingBackend + 'a>(
    chart: &Chart,
    area: &DrawingArea<B, Shift>,
    look: &PlotStyle,
) -> Result<(Paper<'a, B>, PlotAxis, PlotAxis), PlotError> {
    let points = || chart.series.iter().flat_map(PlotSeries::finite);
    let x = PlotAxis::fit(points().map(|p| p.0), look.ticks.0).ok_or(PlotError::Empty)?;
    let right = right_axis(chart, look);
    let left = chart.series.iter().filter(|s| right.is_none() || !s.right).flat_map(PlotSeries::finite);
    // with points on the right alone the left axis has their numbers
    let y = PlotAxis::fit(left.map(|p| p.1), look.ticks.1).or_else(|| right.clone()).ok_or(PlotError::Empty)?;
    let area = match look.terminal {
        true => area.clone(),
        false => look.below_title(area, &chart.title)?,
    };
    let (x, y) = if chart.equal {
        let (width, height) = area.dim_in_pixel();
        let sides = if right.is_some() { 2 } else { 1 };
        let room = |whole: u32, taken: i32| f64::from(whole) - f64::from(2 * look.margin + taken);
        let plane = [room(width, sides * look.areas.1), room(height, look.areas.0)];
        // a character cell of the terminal is two dots wide and four high, and twice as high as wide
        PlotAxis::with_equal_scales(&x, &y, plane)
    } else {
        (x, y)
    };
    let mut builder = ChartBuilder::on(&area);
    builder.margin(look.margin).x_label_area_size(look.areas.0).y_label_area_size(look.areas.1);
    if right.is_some() {
        builder.right_y_label_area_size(look.areas.1);
    }
    let plane = builder.build_cartesian_2d(x.clone(), y.clone()).map_err(to_plot_error)?;
    let mut paper = match &right {
        Some(axis) => Paper::Two(Box::new(plane.set_secondary_coord(x.clone(), axis.clone()))),
        None => Paper::One(Box::new(plane)),
    };
    let (x_label, y_label) = (|v: &f64| x.label(*v), |v: &f64| y.label(*v));
    let mut mesh = paper.plane().configure_mesh();
    mesh.x_labels(look.ticks.0)
        .y_labels(look.ticks.1)
        .x_label_formatter(&x_label)
        .y_label_formatter(&y_label)
        .set_all_tick_mark_size(look.mark)
        .label_style(("sans-serif", look.text));
    if look.terminal {
        mesh.disable_mesh();
    } else {
        mesh.x_desc(&chart.x_label).y_desc(&chart.y_label).axis_desc_style(("sans-serif", look.text));
        mesh.light_line_style(look.stroke(RGBColor(240, 240, 240), 1));
        mesh.bold_line_style(look.stroke(RGBColor(215, 215, 215), 1)).axis_style(look.stroke(BLACK, 1));
    }
    mesh.draw().map_err(to_plot_error)?;
    if let (Paper::Two(both), Some(axis)) = (&mut paper, &right) {
        let label = |v: &f64| axis.label(*v);
        let mut ticks = both.configure_secondary_axes();
        ticks
            .y_labels(look.ticks.1)
            .y_label_formatter(&label)
            .set_all_tick_mark_size(look.mark)
            .axis_style(look.stroke(BLACK, 1))
            .label_style(("sans-serif", look.text));
        if !look.terminal {
            ticks.y_desc(chart.right_label.clone().unwrap_or_default()).axis_desc_style(("sans-serif", look.text));
        }
        ticks.draw().map_err(to_plot_error)?;
    }
    Ok((paper, x, y))
}

/// Whether a curve shows its points: they are few, and would not be taken for the marks of another column.
fn shows_points(chart: &Chart, series: &PlotSeries) -> bool {
    series.finite().count() <= MAX_MARKED_POINTS
        && !chart.series.iter().any(|s| s.is_marks() && s.finite().next().is_some())
}

/// One line of the chart, broken where points are missing; its points too when they are to be shown, and always one that
/// stands alone.
fn curve<B: DrawingBackend>(
    plane: &mut PlotSurface<'_, B>,
    index: usize,
    series: &PlotSeries,
    (look, points_too): (&PlotStyle, bool),
) -> Result<(), PlotError> {
    let marks = series.is_marks();
    let style = CurveStyle::new(index);
    let (colour, pattern) =
        if look.terminal { (terminal::colour(index, marks), &[][..]) } else { (style.colour, style.pattern) };
    let pattern: Vec<f64> = pattern.iter().map(|length| length * f64::from(look.unit)).collect();
    let width = if look.terminal { 1 } else { CURVE_WIDTH };
    let radius = match (look.terminal, marks) {
        (true, _) => 0,
        (false, true) => MARK_RADII.1 * look.unit,
        (false, false) => MARK_RADII.0 * look.unit,
    };
    let pixels = plane.plotting_area().strip_coord_spec();
    let corner = pixels.get_base_pixel();
    for points in series.runs() {
        let path: Vec<(i32, i32)> = points
            .iter()
            .map(|p| {
                let (x, y) = plane.backend_coord(p);
                (x - corner.0, y - corner.1)
            })
            .collect();
        for piece in dashes(&path, &pattern) {
            pixels.draw(&PathElement::new(piece, look.stroke(colour, width))).map_err(to_plot_error)?;
        }
        if points.len() == 1 || (points_too && !look.terminal) {
            for at in path {
                pixels.draw(&Circle::new(at, radius, colour.filled())).map_err(to_plot_error)?;
            }
        }
    }
    Ok(())
}

/// An entry of the legend with its width (pixels).
fn legend_width(series: &PlotSeries) -> i32 {
    let letters = i32::try_from(series.legend_name().chars().count()).unwrap_or(0).min(MAX_LEGEND_LETTERS);
    LEGEND[1] + 8 + LEGEND[2] * letters + LEGEND[3]
}

/// The rows of the legend: which curves stand in each, and how many find no room in it.
fn legend_rows(chart: &Chart) -> (Vec<Vec<usize>>, usize) {
    let room = i32::try_from(chart.size.width).unwrap_or(0) - 2 * LEGEND[3];
    let mut rows: Vec<Vec<usize>> = Vec::new();
    let mut filled = room;
    for (index, series) in chart.series.iter().enumerate() {
        let width = legend_width(series);
        if filled + width > room {
            if rows.len() == MAX_LEGEND_ROWS {
                return (rows, chart.series.len() - index);
            }
            rows.push(Vec::new());
            filled = 0;
        }
        filled += width;
        if let Some(row) = rows.last_mut() {
            row.push(index);
        }
    }
    (rows, 0)
}

/// Height of the legend below a page's plot (pixels); none of a single curve.
pub fn legend_height(chart: &Chart) -> i32 {
    if chart.series.len() < 2 {
        return 0;
    }
    let (rows, left_out) = legend_rows(chart);
    LEGEND[0] * i32::try_from(rows.len() + usize::from(left_out > 0)).unwrap_or(0) + 10
}

/// The legend, below the plot.
fn legend<B: DrawingBackend>(chart: &Chart, area: &DrawingArea<B, Shift>, look: &PlotStyle) -> Result<(), PlotError> {
    let at = |x: i32, y: i32| (x * look.unit, y * look.unit);
    let style = ("sans-serif", look.text);
    let (rows, left_out) = legend_rows(chart);
    let mut y = LEGEND[0] / 2;
    for row in rows {
        let mut x = LEGEND[3];
        for series in row.into_iter().filter_map(|index| chart.series.get(index).map(|s| (index, s))) {
            let (index, series) = series;
            let CurveStyle { colour, pattern } = CurveStyle::new(index);
            let marks = series.is_marks();
            if !marks {
                let pattern: Vec<f64> = pattern.iter().map(|length| length * f64::from(look.unit)).collect();
                for piece in dashes(&[at(x, y), at(x + LEGEND[1], y)], &pattern) {
                    area.draw(&PathElement::new(piece, look.stroke(colour, CURVE_WIDTH))).map_err(to_plot_error)?;
                }
            }
            if marks || shows_points(chart, series) {
                let radius = if marks { MARK_RADII.1 } else { MARK_RADII.0 } * look.unit;
                let dot = Circle::new(at(x + LEGEND[1] / 2, y), radius, colour.filled());
                area.draw(&dot).map_err(to_plot_error)?;
            }
            let name = series.legend_name();
            let most = usize::try_from(MAX_LEGEND_LETTERS).unwrap_or(0);
            let name = if name.chars().count() > most {
                name.chars().take(most - 2).chain("..".chars()).collect()
            } else {
                name
            };
            area.draw(&Text::new(name, at(x + LEGEND[1] + 8, y - 8), style)).map_err(to_plot_error)?;
            x += legend_width(series);
        }
        y += LEGEND[0];
    }
    if left_out > 0 {
        let words = format!("and {left_out} more");
        area.draw(&Text::new(words, at(LEGEND[3], y - 8), style)).map_err(to_plot_error)?;
    }
    Ok(())
}

/// What a surface refuses, as an error of ours.
pub fn to_plot_error<E: std::error::Error + Send + Sync>(error: DrawingAreaErrorKind<E>) -> PlotError {
    PlotError::Backend(error.to_string())
}
