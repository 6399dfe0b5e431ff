//! Drawing a chart on any surface of plotters: axes, mesh, curves, legend.

use super::axis::PlotAxis;
use super::{Chart, PlotError, PlotSeries, terminal};
use plotters::chart::{ChartBuilder, DualCoordChartContext};
use plotters::coord::Shift;
use plotters::coord::cartesian::Cartesian2d;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind};
use plotters::element::{Circle, PathElement, Rectangle, Text};
use plotters::prelude::{BLACK, ChartContext, Color, DrawingBackend, RGBColor, WHITE};
use plotters::series::LineSeries;

/// Colours that stay apart for colour-blind eyes [OKABE-ITO-2008], in fixed order.
pub const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];
/// Up to this many points a curve shows its points too, where no other column is of marks alone.
const MAX_MARKED_POINTS: usize = 60;
/// Radius of a point of a curve, and of a mark that stands alone (pixels).
const MARK_RADII: (i32, i32) = (3, 6);
/// Height of a line of the legend and length of the stroke in it (pixels).
const LEGEND: (i32, i32) = (20, 26);

/// What differs between a page and a terminal: sizes in pixels of the surface, numbers of ticks.
pub struct PlotStyle {
    pub terminal: bool,
    pub text: i32,
    margin: i32,
    areas: (i32, i32),
    ticks: (usize, usize),
    mark: i32,
}

impl PlotStyle {
    /// A page of 900 by 600 pixels.
    pub const PAGE: PlotStyle =
        PlotStyle { terminal: false, text: 15, margin: 16, areas: (54, 92), ticks: (10, 10), mark: 5 };

    /// A terminal of so many characters; titles stand outside of the drawing.
    pub fn terminal(columns: usize, lines: usize) -> PlotStyle {
        let ticks = ((columns / 12).clamp(2, 10), (lines / 4).clamp(2, 10));
        PlotStyle { terminal: true, text: 4, margin: 0, areas: (8, 22), ticks, mark: 3 }
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
    let (mut paper, x, y) = if chart.polar {
        let (plane, x, y) = super::polar::plane(chart, area, look)?;
        (Paper::One(Box::new(plane)), x, y)
    } else {
        draw_mesh(chart, area, look)?
    };
    let taken = chart.on_the_left(&y, right_axis(chart, look).as_ref());
    let (chart, plane) = (&taken, paper.plane());
    // marks that stand alone are drawn last, so that no line hides them
    for marks in [false, true] {
        for (index, series) in chart.series.iter().enumerate().filter(|(_, s)| s.is_marks() == marks) {
            curve(plane, index, series, (look, shows_points(chart, series)))?;
        }
    }
    if chart.series.len() > 1 && !look.terminal {
        legend(chart, plane, (&x, &y))?;
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
    let mut builder = ChartBuilder::on(area);
    builder.margin(look.margin).x_label_area_size(look.areas.0).y_label_area_size(look.areas.1);
    if !look.terminal {
        builder.caption(&chart.title, ("sans-serif", 22));
    }
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
        mesh.light_line_style(RGBColor(240, 240, 240)).bold_line_style(RGBColor(215, 215, 215));
    }
    mesh.draw().map_err(to_plot_error)?;
    if let (Paper::Two(both), Some(axis)) = (&mut paper, &right) {
        let label = |v: &f64| axis.label(*v);
        let mut ticks = both.configure_secondary_axes();
        ticks
            .y_labels(look.ticks.1)
            .y_label_formatter(&label)
            .set_all_tick_mark_size(look.mark)
            .label_style(("sans-serif", look.text));
        if !look.terminal {
            ticks.y_desc(chart.right_label.clone().unwrap_or_default()).axis_desc_style(("sans-serif", look.text));
        }
        ticks.draw().map_err(to_plot_error)?;
    }
    Ok((paper, x, y))
}

fn colour(index: usize) -> RGBColor {
    COLOURS.get(index % COLOURS.len()).copied().unwrap_or(BLACK)
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
    let (colour, stroke) = if look.terminal { (terminal::colour(index, marks), 1) } else { (colour(index), 2) };
    let radius = match (look.terminal, marks) {
        (true, _) => 0,
        (false, true) => MARK_RADII.1,
        (false, false) => MARK_RADII.0,
    };
    for points in series.runs() {
        plane.draw_series(LineSeries::new(points.clone(), colour.stroke_width(stroke))).map_err(to_plot_error)?;
        if points.len() == 1 || (points_too && !look.terminal) {
            plane
                .draw_series(points.iter().map(|p| Circle::new(*p, radius, colour.filled())))
                .map_err(to_plot_error)?;
        }
    }
    Ok(())
}

/// The legend, in the corner where it hides the fewest points.
fn legend<B: DrawingBackend>(
    chart: &Chart,
    plane: &PlotSurface<'_, B>,
    axes: (&PlotAxis, &PlotAxis),
) -> Result<(), PlotError> {
    let area = plane.plotting_area().strip_coord_spec();
    let (width, height) = area.dim_in_pixel();
    let (width, height) = (i32::try_from(width).unwrap_or(0), i32::try_from(height).unwrap_or(0));
    let letters = chart.series.iter().map(|s| s.legend_name().chars().count()).max().unwrap_or(0);
    let box_width = 8 * i32::try_from(letters).unwrap_or(0) + LEGEND.1 + 30;
    let box_height = LEGEND.0 * i32::try_from(chart.series.len()).unwrap_or(0) + 10;
    let (right, low) = (width - box_width - 10, height - box_height - 10);
    let hidden = |corner: &(i32, i32)| {
        let inside = |at: i32, from: i32, size: i32| (from - 8..from + size + 8).contains(&at);
        let pixel = |share: f64, size: i32| (share * f64::from(size)).round() as i32;
        let points = chart.series.iter().flat_map(PlotSeries::finite);
        let covered = points.filter(|p| {
            inside(pixel(axes.0.share(p.0), width), corner.0, box_width)
                && inside(pixel(1.0 - axes.1.share(p.1), height), corner.1, box_height)
        });
        covered.count()
    };
    let corners = [(10, 10), (right, 10), (right, low), (10, low)];
    let (left, top) = corners.into_iter().min_by_key(hidden).unwrap_or((10, 10));
    let frame = [(left, top), (left + box_width, top + box_height)];
    area.draw(&Rectangle::new(frame, WHITE.mix(0.9).filled())).map_err(to_plot_error)?;
    area.draw(&Rectangle::new(frame, RGBColor(150, 150, 150))).map_err(to_plot_error)?;
    for (index, series) in chart.series.iter().enumerate() {
        let y = top + 5 + LEGEND.0 * i32::try_from(index).unwrap_or(0) + LEGEND.0 / 2;
        let stroke = vec![(left + 10, y), (left + 10 + LEGEND.1, y)];
        let marks = series.is_marks();
        if !marks {
            area.draw(&PathElement::new(stroke, colour(index).stroke_width(2))).map_err(to_plot_error)?;
        }
        if marks || shows_points(chart, series) {
            let radius = if marks { MARK_RADII.1 } else { MARK_RADII.0 };
            area.draw(&Circle::new((left + 10 + LEGEND.1 / 2, y), radius, colour(index).filled()))
                .map_err(to_plot_error)?;
        }
        let at = (left + 20 + LEGEND.1, y - 8);
        area.draw(&Text::new(series.legend_name(), at, ("sans-serif", 15))).map_err(to_plot_error)?;
    }
    Ok(())
}

/// What a surface refuses, as an error of ours.
pub fn to_plot_error<E: std::error::Error + Send + Sync>(error: DrawingAreaErrorKind<E>) -> PlotError {
    PlotError::Backend(error.to_string())
}
