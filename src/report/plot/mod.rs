//! Plots: one description, drawn through plotters onto three surfaces: SVG, PNG, and the terminal.

mod axis;
pub(super) mod draw;
mod html;
mod polar;
pub(super) mod raster;
pub(super) mod stroke;
pub(super) mod terminal;

use crate::report::{format, page};
use draw::{PlotStyle, draw, to_plot_error};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::prelude::SVGBackend;
use std::cell::RefCell;
use std::rc::Rc;
use windlass_base::table::{Cell, Column, Table};
use windlass_base::units::{Dim, UnitSystem};

/// Units of a drawn page a pixel: places and widths are in tenths of a pixel, so that strokes are not bound to whole ones.
pub const SUBPIXELS: i32 = 10;
/// Largest ratio of the sides of lengths over lengths that are drawn to one scale unless something else is asked for.
const MAX_SIDES_RATIO: f64 = 5.0;

/// Size of a plot in a file, without its legend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlotSize {
    /// Width (pixels).
    pub width: u32,
    /// Height (pixels).
    pub height: u32,
}

impl Default for PlotSize {
    fn default() -> Self {
        PlotSize { width: 900, height: 600 }
    }
}

/// A line of a chart; points without a finite value break it, and where no two neighbours have one there are marks alone.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlotSeries {
    /// Name in the legend.
    pub name: String,
    /// Points in user units.
    pub points: Vec<Option<(f64, f64)>>,
    /// Whether it goes by the axis on the right.
    pub right: bool,
}

/// What is to be drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Label of the horizontal axis, with its unit.
    pub x_label: String,
    /// Label of the vertical axis, with its unit.
    pub y_label: String,
    /// Label of the axis on the right, with its unit, where there is one.
    pub right_label: Option<String>,
    /// The lines.
    pub series: Vec<PlotSeries>,
    /// Whether it is a polar plot: both axes have one scale, and circles and rays stand in place of a mesh.
    pub polar: bool,
    /// Whether both axes have one scale, so that lengths can be compared.
    pub equal: bool,
    /// How large it is in a file.
    pub size: PlotSize,
}

/// Why a plot could not be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlotError {
    /// No finite point.
    #[error("there is nothing to plot: no finite points")]
    Empty,
    /// A polar plot over what is no direction.
    #[error("a polar plot goes over directions, and {0} is no angle")]
    NoAngle(String),
    /// A polar plot of a distance below zero.
    #[error("a polar plot has no distances below zero, and {0} is {1}")]
    Negative(String, f64),
    /// A point beyond what an axis can bear.
    #[error("the point {0:e}, {1:e} is too large to be plotted")]
    Range(f64, f64),
    /// The plotting library or the PNG encoder refused.
    #[error("the plot could not be drawn: {0}")]
    Backend(String),
    /// A file name that ends in none of .svg, .png and .html.
    #[error("a plot file ends in .svg, .png or .html, not `{0}`")]
    Kind(String),
    /// A file name of a picture that ends in neither .svg nor .png.
    #[error("a picture file ends in .svg or .png, not `{0}`")]
    PictureKind(String),
    /// More units than there are axes for.
    #[error("{0} cannot share an axis: one plot has two units at most, on the left and on the right")]
    Units(String),
    /// All columns on the right.
    #[error("no column is left for the axis on the left")]
    NoLeft,
    /// A polar plot as a page.
    #[error("a polar plot goes to .svg, .png or the terminal")]
    PolarPage,
    /// More points than a page bears.
    #[error("a page bears {most} points, and these are {0}: -RECORD or -VALUES takes a part of the rows", most = html::MAX_PAGE_POINTS)]
    TooMany(usize),
}

/// An SVG image of so many pixels, drawn in tenths of them, with what the drawing returns.
///
/// # Errors
/// Those of the drawing.
pub(in crate::report) fn draw_svg<T>(
    (width, height): (u32, u32),
    draw: impl FnOnce(&DrawingArea<SVGBackend, Shift>) -> Result<T, PlotError>,
) -> Result<(Vec<u8>, T), PlotError> {
    let tenths = |n: u32| n.saturating_mul(SUBPIXELS.unsigned_abs());
    let inner = (tenths(width), tenths(height));
    let mut text = String::new();
    let outcome = {
        let area = SVGBackend::with_string(&mut text, inner).into_drawing_area();
        let outcome = draw(&area)?;
        area.present().map_err(to_plot_error)?;
        outcome
    };
    // the picture has the size of its pixels, and the coordinates of their tenths
    let size = |(width, height): (u32, u32)| format!("width=\"{width}\" height=\"{height}\"");
    Ok((text.replacen(&size(inner), &size((width, height)), 1).into_bytes(), outcome))
}

impl PlotSeries {
    /// The points that can be drawn.
    fn finite(&self) -> impl Iterator<Item = (f64, f64)> {
        self.points.iter().filter_map(|p| finite(*p))
    }

    /// Its name in the legend.
    fn legend_name(&self) -> String {
        if self.right { format!("{} (right)", self.name) } else { self.name.clone() }
    }

    /// Whether no two neighbouring points are there: marks, and no line between them.
    fn is_marks(&self) -> bool {
        self.runs().all(|run| run.len() == 1)
    }

    /// The unbroken pieces of the line.
    fn runs(&self) -> impl Iterator<Item = Vec<(f64, f64)>> {
        let pieces = self.points.split(|p| finite(*p).is_none());
        pieces.filter(|run| !run.is_empty()).map(|run| run.iter().flatten().copied().collect())
    }
}

/// The label of an axis: the head of its only column, else the unit they share.
fn label(columns: &[&Column], units: UnitSystem) -> Result<String, PlotError> {
    if let [one] = columns {
        return Ok(format::head(one, units));
    }
    let unit = |c: &Column| c.dim.label(units);
    match columns.iter().find(|c| Some(unit(c)) != columns.first().map(|f| unit(f))) {
        None => Ok(columns.first().map_or(String::new(), |c| unit(c))),
        Some(_) => {
            let names: Vec<String> = columns.iter().map(|c| format::head(c, units)).collect();
            Err(PlotError::Units(names.join(", ")))
        }
    }
}

fn finite(point: Option<(f64, f64)>) -> Option<(f64, f64)> {
    point.filter(|(x, y)| x.is_finite() && y.is_finite())
}

impl Chart {
    /// A chart of columns of a table against its first one. Columns of a second unit go by the axis on the right.
    ///
    /// # Errors
    /// More than two units.
    pub fn from_table(table: &Table, units: UnitSystem) -> Result<Chart, PlotError> {
        Chart::with_right(table, &[], units)
    }

    /// The same with the columns of these numbers (from 0) on the right; none given, those of another unit than the first.
    ///
    /// # Errors
    /// Columns of different units on one side; none on the left.
    pub fn with_right(table: &Table, right: &[usize], units: UnitSystem) -> Result<Chart, PlotError> {
        let (x, ys) = match table.columns().split_first() {
            Some((x, ys)) => (Some(x), ys),
            None => (None, [].as_slice()),
        };
        let first = ys.first().map(|y| y.dim.label(units));
        let is_right = |index: usize, y: &Column| match right {
            [] => Some(y.dim.label(units)) != first,
            some => some.contains(&(index + 1)),
        };
        let sides: Vec<bool> = ys.iter().enumerate().map(|(index, y)| is_right(index, y)).collect();
        let value = |cell: Option<&Cell>, dim: Dim| {
            cell.and_then(Cell::number).map(|v| dim.from_si(v, units)).filter(|v| v.is_finite())
        };
        let series = ys.iter().zip(&sides).map(|(y, right)| PlotSeries {
            name: super::columns::long_name(y),
            points: (0..table.rows())
                .map(|row| {
                    let x = x.and_then(|x| value(x.cells.get(row), x.dim))?;
                    Some((x, value(y.cells.get(row), y.dim)?))
                })
                .collect(),
            right: *right,
        });
        let side = |right: bool| -> Vec<&Column> {
            ys.iter().zip(&sides).filter(|(_, side)| **side == right).map(|(y, _)| y).collect()
        };
        let (left, on_right) = (side(false), side(true));
        if left.is_empty() && !on_right.is_empty() {
            return Err(PlotError::NoLeft);
        }
        Ok(Chart {
            title: table.title.clone(),
            x_label: x.map_or(String::new(), |x| format::head(x, units)),
            y_label: label(&left, units)?,
            right_label: if on_right.is_empty() { None } else { Some(label(&on_right, units)?) },
            series: series.collect(),
            polar: false,
            equal: false,
            size: PlotSize::default(),
        })
    }

    /// Whether neither side of what is drawn is more than five times the other: one scale for both axes leaves room for the curves.
    pub fn has_similar_sides(&self) -> bool {
        let extent = |pick: fn((f64, f64)) -> f64| {
            let values = || self.series.iter().flat_map(PlotSeries::finite).map(pick);
            values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
        };
        let (x, y) = (extent(|p| p.0), extent(|p| p.1));
        x > 0.0 && y > 0.0 && x.max(y) <= MAX_SIDES_RATIO * x.min(y)
    }

    /// The chart as a file, by the ending of its name.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn file(&self, name: &str) -> Result<Vec<u8>, PlotError> {
        match name.rsplit_once('.').map(|(_, end)| end.to_ascii_lowercase()).as_deref() {
            Some("svg") => self.svg(),
            Some("png") => self.png(),
            Some("html") => self.html(),
            _ => Err(PlotError::Kind(name.to_string())),
        }
    }

    /// The chart as SVG.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn svg(&self) -> Result<Vec<u8>, PlotError> {
        draw_svg(self.page_size(), |area| draw(self, area, &PlotStyle::page(self))).map(|(bytes, ())| bytes)
    }

    /// Width and height of its page (pixels).
    fn page_size(&self) -> (u32, u32) {
        (self.size.width, self.size.height + draw::legend_height(self).unsigned_abs())
    }

    /// The chart as PNG.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        let (width, height) = self.page_size();
        let canvas = Rc::new(RefCell::new(raster::RasterCanvas::new(width, height)));
        draw(self, &DrawingArea::from(&canvas), &PlotStyle::page(self))?;
        canvas.borrow().encode().map_err(|e| PlotError::Backend(e.to_string()))
    }

    /// The chart for a terminal of so many columns and lines; the legend stands below.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn terminal(&self, columns: usize, lines: usize) -> Result<String, PlotError> {
        let (columns, lines) = (columns.clamp(20, 200), lines.clamp(10, 100));
        // three lines are for the title and the names of the axes
        let canvas = Rc::new(RefCell::new(terminal::TextCanvas::new(columns, lines - 3)));
        draw(self, &DrawingArea::from(&canvas), &PlotStyle::terminal(columns, lines - 3))?;
        let mut text = String::new();
        let heads = match &self.right_label {
            Some(right) => {
                // each above its axis
                let room = columns.saturating_sub(self.y_label.chars().count() + 1);
                format!("{} {right:>room$}", self.y_label)
            }
            None => self.y_label.clone(),
        };
        for line in [page::centre(&self.title, columns), heads] {
            text.push_str(line.trim_end());
            text.push('\n');
        }
        text.push_str(&canvas.borrow().text());
        text.push_str(page::centre(&self.x_label, columns).trim_end());
        text.push('\n');
        if self.series.len() > 1 {
            for (index, series) in self.series.iter().enumerate() {
                text.push_str(&format!("   {}  {}\n", terminal::mark(index), series.legend_name()));
            }
        }
        Ok(text)
    }
}

#[cfg(test)]
mod tests;
