//! Plots: one description, drawn through plotters onto three surfaces: SVG, PNG, and the terminal.

mod raster;
mod terminal;

use crate::language::units::UnitSystem;
use crate::report::format;
use crate::table::{Cell, Table};
use plotters::chart::{ChartBuilder, SeriesLabelPosition};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{Circle, PathElement};
use plotters::prelude::{BLACK, Color, DrawingBackend, IntoFont, RGBColor, SVGBackend, WHITE};
use plotters::series::LineSeries;
use std::cell::RefCell;
use std::rc::Rc;

/// A line of a chart; points without a finite value break it.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Points in user units.
    pub points: Vec<Option<(f64, f64)>>,
}

/// What is to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Title.
    pub title: String,
    /// Label of the horizontal axis, with its unit.
    pub x_label: String,
    /// Label of the vertical axis, with its unit.
    pub y_label: String,
    /// The lines.
    pub series: Vec<Series>,
}

/// Why a plot could not be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlotError {
    /// No finite point.
    #[error("there is nothing to plot: no finite points")]
    Empty,
    /// The plotting library or the PNG encoder refused.
    #[error("the plot could not be drawn: {0}")]
    Backend(String),
    /// A file name that ends neither in .svg nor in .png.
    #[error("a plot file ends in .svg or .png, not `{0}`")]
    Kind(String),
}

/// Colours that stay apart for colour-blind eyes (Okabe and Ito 2008), in fixed order.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];
/// Up to this many points a curve shows its points too.
const FEW: usize = 60;

impl Chart {
    /// A chart of columns of a table against its first one.
    pub fn of(table: &Table, units: UnitSystem) -> Chart {
        let (x, ys) = match table.columns.split_first() {
            Some((x, ys)) => (Some(x), ys),
            None => (None, [].as_slice()),
        };
        let value = |cell: Option<&Cell>, dim: crate::language::units::Dim| {
            cell.and_then(Cell::number).map(|v| dim.from_si(v, units)).filter(|v| v.is_finite())
        };
        let series = ys.iter().map(|y| Series {
            name: super::columns::long_name(y),
            points: (0..table.rows())
                .map(|row| {
                    let x = x.and_then(|x| value(x.cells.get(row), x.dim))?;
                    Some((x, value(y.cells.get(row), y.dim)?))
                })
                .collect(),
        });
        let mut labels: Vec<String> = Vec::new();
        for y in ys {
            let unit = y.dim.label(units);
            if !unit.is_empty() && !labels.contains(&unit) {
                labels.push(unit);
            }
        }
        let y_label = match ys {
            [one] => format::head(one, units),
            _ => labels.join(", "),
        };
        Chart {
            title: table.title.clone(),
            x_label: x.map_or(String::new(), |x| format::head(x, units)),
            y_label,
            series: series.collect(),
        }
    }

    /// The chart as a file, by the ending of its name.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn file(&self, name: &str) -> Result<Vec<u8>, PlotError> {
        match name.rsplit_once('.').map(|(_, end)| end.to_ascii_lowercase()).as_deref() {
            Some("svg") => self.svg(),
            Some("png") => self.png(),
            _ => Err(PlotError::Kind(name.to_string())),
        }
    }

    /// The chart as SVG.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn svg(&self) -> Result<Vec<u8>, PlotError> {
        let mut text = String::new();
        {
            let area = SVGBackend::with_string(&mut text, (900, 600)).into_drawing_area();
            self.draw(&area, &Look::PAGE)?;
            area.present().map_err(refused)?;
        }
        Ok(text.into_bytes())
    }

    /// The chart as PNG.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        let canvas = Rc::new(RefCell::new(raster::Canvas::new(900, 600)));
        self.draw(&DrawingArea::from(&canvas), &Look::PAGE)?;
        canvas.borrow().encode().map_err(|e| PlotError::Backend(e.to_string()))
    }

    /// The chart for a terminal of so many columns and lines.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn terminal(&self, columns: usize, lines: usize) -> Result<String, PlotError> {
        let canvas = Rc::new(RefCell::new(terminal::Canvas::new(columns.clamp(40, 200), lines.clamp(10, 100))));
        self.draw(&DrawingArea::from(&canvas), &Look::TERMINAL)?;
        let mut text = canvas.borrow().text();
        if self.series.len() > 1 {
            for (index, series) in self.series.iter().enumerate() {
                text.push_str(&format!("   {}  {}\n", terminal::mark(index), series.name));
            }
        }
        Ok(text)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, look: &Look) -> Result<(), PlotError> {
        area.fill(&WHITE).map_err(refused)?;
        let (x, y) = self.ranges().ok_or(PlotError::Empty)?;
        let (x_width, y_width) = (x.end - x.start, y.end - y.start);
        if !(x_width.is_finite() && y_width.is_finite()) {
            return Err(PlotError::Backend("the values span more than a number can hold".into()));
        }
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, ("sans-serif", look.title))
            .margin(look.margin)
            .x_label_area_size(look.x_area)
            .y_label_area_size(look.y_area)
            .build_cartesian_2d(x, y)
            .map_err(refused)?;
        let x_tick = |v: &f64| tick(*v, x_width);
        let y_tick = |v: &f64| tick(*v, y_width);
        let mut mesh = chart.configure_mesh();
        mesh.x_desc(&self.x_label)
            .y_desc(&self.y_label)
            .x_labels(look.x_labels)
            .y_labels(look.y_labels)
            .x_label_formatter(&x_tick)
            .y_label_formatter(&y_tick)
            .label_style(("sans-serif", look.text))
            .axis_desc_style(("sans-serif", look.text));
        if look.terminal {
            mesh.disable_mesh();
        } else {
            mesh.light_line_style(RGBColor(235, 235, 235)).bold_line_style(RGBColor(210, 210, 210));
        }
        mesh.draw().map_err(refused)?;
        for (index, series) in self.series.iter().enumerate() {
            let colour = if look.terminal {
                terminal::colour(index)
            } else {
                COLOURS.get(index % COLOURS.len()).copied().unwrap_or(BLACK)
            };
            let count = series.points.iter().flatten().count();
            let mut labelled = false;
            for run in series.points.split(Option::is_none) {
                let points: Vec<(f64, f64)> = run.iter().flatten().copied().collect();
                if points.is_empty() {
                    continue;
                }
                let line = chart
                    .draw_series(LineSeries::new(points.clone(), colour.stroke_width(look.stroke)))
                    .map_err(refused)?;
                if !labelled && !look.terminal {
                    line.label(&series.name)
                        .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 20, y)], colour.stroke_width(2)));
                    labelled = true;
                }
                if count <= FEW && !look.terminal {
                    chart.draw_series(points.iter().map(|p| Circle::new(*p, 3, colour.filled()))).map_err(refused)?;
                }
            }
        }
        if self.series.len() > 1 && !look.terminal {
            chart
                .configure_series_labels()
                .position(SeriesLabelPosition::UpperLeft)
                .background_style(WHITE.mix(0.85))
                .border_style(RGBColor(160, 160, 160))
                .label_font(("sans-serif", look.text).into_font())
                .draw()
                .map_err(refused)?;
        }
        Ok(())
    }

    /// Ranges of both axes with a little room; `None` without a finite point.
    fn ranges(&self) -> Option<(std::ops::Range<f64>, std::ops::Range<f64>)> {
        let points = || self.series.iter().flat_map(|s| s.points.iter().flatten());
        let range = |pick: fn(&(f64, f64)) -> f64| {
            let (low, high) =
                points().map(pick).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
            let room = if high > low { 0.03 * (high - low) } else { 0.5 * low.abs().max(1.0) };
            if low <= high { Some(low - room..high + room) } else { None }
        };
        Some((range(|p| p.0)?, range(|p| p.1)?))
    }
}

/// Sizes that differ between a page and a terminal.
struct Look {
    terminal: bool,
    title: i32,
    text: i32,
    margin: i32,
    x_area: i32,
    y_area: i32,
    x_labels: usize,
    y_labels: usize,
    stroke: u32,
}

impl Look {
    const PAGE: Look = Look {
        terminal: false,
        title: 22,
        text: 15,
        margin: 16,
        x_area: 50,
        y_area: 80,
        x_labels: 10,
        y_labels: 10,
        stroke: 2,
    };
    const TERMINAL: Look = Look {
        terminal: true,
        title: 4,
        text: 4,
        margin: 0,
        x_area: 14,
        y_area: 22,
        x_labels: 6,
        y_labels: 6,
        stroke: 1,
    };
}

/// A tick label with no more digits than it needs on an axis of this width.
fn tick(value: f64, width: f64) -> String {
    if value.abs() < 1e-9 * width { "0".into() } else { crate::language::functions::eight_figures(value) }
}

fn refused<E: std::error::Error + Send + Sync>(error: DrawingAreaErrorKind<E>) -> PlotError {
    PlotError::Backend(error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::units::Dim;
    use crate::table::Digits;

    fn chart() -> Chart {
        let mut t = Table::new("Line A").column("", "X", Dim::Length, Digits::Usual).column(
            "",
            "Force",
            Dim::Force,
            Digits::Usual,
        );
        for n in 0..30 {
            let x = f64::from(n);
            let y = if n == 10 { Cell::Missing } else { Cell::Number(x * x) };
            t.push(vec![Cell::Number(x), y]).unwrap();
        }
        Chart::of(&t, UnitSystem::SI)
    }

    #[test]
    fn every_surface_shows_title_axes_and_units_and_is_the_same_twice() {
        let svg = String::from_utf8(chart().svg().unwrap()).unwrap();
        for text in ["Line A", "X (m)", "Force (N)", "<polyline"] {
            assert!(svg.contains(text), "{text} is missing from the SVG");
        }
        let screen = chart().terminal(80, 24).unwrap();
        for text in ["Line A", "X (m)", "Force (N)"] {
            assert!(screen.contains(text), "{text} is missing from\n{screen}");
        }
        assert_eq!(chart().png().unwrap(), chart().png().unwrap());
        assert!(chart().png().unwrap().starts_with(b"\x89PNG"));
    }

    #[test]
    fn nothing_finite_is_an_error_and_one_point_is_not() {
        let series = |points| Chart {
            title: String::new(),
            x_label: String::new(),
            y_label: String::new(),
            series: vec![Series { name: String::new(), points }],
        };
        assert_eq!(series(vec![None]).svg(), Err(PlotError::Empty));
        assert!(series(vec![Some((1.0, 2.0))]).terminal(60, 15).is_ok());
    }
}
