//! Plots: one description, drawn through plotters onto three surfaces: SVG, PNG, and the terminal.

mod axis;
pub(super) mod draw;
mod polar;
pub(super) mod raster;
pub(super) mod terminal;

use crate::language::units::UnitSystem;
use crate::report::{format, page};
use crate::table::{Cell, Table};
use draw::{Look, draw, refused};
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::prelude::SVGBackend;
use std::cell::RefCell;
use std::rc::Rc;

/// Size of a plot in a file (pixels).
const SIZE: (u32, u32) = (900, 600);

/// A line of a chart; points without a finite value break it, and where no two neighbours have one there are marks alone.
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
    /// Whether it is a polar plot: both axes have one scale, and circles and rays stand in place of a mesh.
    pub polar: bool,
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
    /// A file name that ends neither in .svg nor in .png.
    #[error("a plot file ends in .svg or .png, not `{0}`")]
    Kind(String),
}

impl Series {
    /// The points that can be drawn.
    fn finite(&self) -> impl Iterator<Item = (f64, f64)> {
        self.points.iter().filter_map(|p| finite(*p))
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

fn finite(point: Option<(f64, f64)>) -> Option<(f64, f64)> {
    point.filter(|(x, y)| x.is_finite() && y.is_finite())
}

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
            polar: false,
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
            let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
            draw(self, &area, &Look::PAGE)?;
            area.present().map_err(refused)?;
        }
        Ok(text.into_bytes())
    }

    /// The chart as PNG.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn png(&self) -> Result<Vec<u8>, PlotError> {
        let canvas = Rc::new(RefCell::new(raster::Canvas::new(SIZE.0, SIZE.1)));
        draw(self, &DrawingArea::from(&canvas), &Look::PAGE)?;
        canvas.borrow().encode().map_err(|e| PlotError::Backend(e.to_string()))
    }

    /// The chart for a terminal of so many columns and lines; the legend stands below.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn terminal(&self, columns: usize, lines: usize) -> Result<String, PlotError> {
        let (columns, lines) = (columns.clamp(20, 200), lines.clamp(10, 100));
        // three lines are for the title and the names of the axes
        let canvas = Rc::new(RefCell::new(terminal::Canvas::new(columns, lines - 3)));
        draw(self, &DrawingArea::from(&canvas), &Look::terminal(columns, lines - 3))?;
        let mut text = String::new();
        for line in [page::centre(&self.title, columns), self.y_label.clone()] {
            text.push_str(line.trim_end());
            text.push('\n');
        }
        text.push_str(&canvas.borrow().text());
        text.push_str(page::centre(&self.x_label, columns).trim_end());
        text.push('\n');
        if self.series.len() > 1 {
            for (index, series) in self.series.iter().enumerate() {
                text.push_str(&format!("   {}  {}\n", terminal::mark(index), series.name));
            }
        }
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::units::Dim;
    use crate::table::Digits;
    use proptest::prelude::*;

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
            polar: false,
        };
        assert_eq!(series(vec![None]).svg(), Err(PlotError::Empty));
        assert_eq!(series(vec![Some((f64::NAN, 1.0)), Some((0.0, f64::INFINITY))]).png(), Err(PlotError::Empty));
        assert_eq!(series(vec![Some((0.0, 1e300))]).svg(), Err(PlotError::Range(0.0, 1e300)));
        assert!(series(vec![Some((1.0, 2.0))]).terminal(60, 15).is_ok());
    }

    #[test]
    fn a_missing_point_breaks_the_line_and_many_points_have_no_marks() {
        let count = |chart: &Chart, what: &str| {
            let svg = String::from_utf8(chart.svg().unwrap()).unwrap();
            svg.matches(what).count()
        };
        let broken = chart();
        let mut whole = broken.clone();
        whole.series[0].points[10] = Some((10.0, 100.0));
        assert_eq!(count(&broken, "<circle"), 29);
        assert_eq!(count(&whole, "<circle"), 30);
        assert_eq!(count(&broken, "stroke=\"#0072B2\""), count(&whole, "stroke=\"#0072B2\"") + 1);
        whole.series[0].points = (0..100).map(|n| Some((f64::from(n), 0.0))).collect();
        assert_eq!(count(&whole, "<circle"), 0);
    }

    #[test]
    fn a_column_of_single_points_is_marks_that_no_line_hides_and_no_line_joins() {
        let line = Series { name: "Z".into(), points: (0..9).map(|n| Some((f64::from(n), 1.0))).collect() };
        let at = |rows: &[usize]| {
            let point = |n: usize| rows.contains(&n).then_some((n as f64, 1.0));
            Series { name: "Joint".into(), points: (0..9).map(point).collect() }
        };
        let chart = |series| Chart {
            title: String::new(),
            x_label: String::new(),
            y_label: String::new(),
            series,
            polar: false,
        };
        // a gap, then a point by itself within a line, then marks that stand before the line among the columns
        let mut broken = line.clone();
        broken.points[4] = None;
        broken.points[6] = None;
        for (series, large, small) in [
            (vec![line.clone(), at(&[2, 5])], 3, 0),
            (vec![at(&[2, 5]), line.clone()], 3, 0),
            (vec![broken.clone(), at(&[2])], 2, 1),
            (vec![line.clone(), broken], 0, 18),
        ] {
            let marks: Vec<(usize, usize)> = series
                .iter()
                .enumerate()
                .filter(|(_, s)| s.name == "Joint")
                .map(|(i, s)| (i, s.finite().count()))
                .collect();
            let drawn = chart(series);
            let svg = String::from_utf8(drawn.svg().unwrap()).unwrap();
            let circles = |radius: &str| svg.matches(&format!("r=\"{radius}\"")).count();
            assert_eq!((circles("6"), circles("3")), (large, small), "{svg}");
            let screen = drawn.terminal(60, 16).unwrap();
            let plot: String = screen.lines().take(14).collect();
            for (index, count) in marks {
                assert_eq!(plot.matches(terminal::mark(index)).count(), count, "{screen}");
            }
            let whole =
                Chart { series: drawn.series.iter().filter(|s| s.name != "Joint").cloned().collect(), ..drawn.clone() };
            assert_eq!(drawn.png().unwrap() != whole.png().unwrap(), large > 0);
        }
    }

    #[test]
    fn units_that_differ_are_all_named_and_the_legend_tells_the_lines() {
        let mut t = Table::new("t");
        for (name, dim) in [("X", Dim::Length), ("Force", Dim::Force), ("On Bottom", Dim::Length)] {
            t = t.column("", name, dim, Digits::Usual);
        }
        t.push(vec![1.0.into(), 2.0.into(), 3.0.into()]).unwrap();
        t.push(vec![2.0.into(), 3.0.into(), 2.0.into()]).unwrap();
        let chart = Chart::of(&t, UnitSystem::SI);
        assert_eq!(chart.y_label, "N, m");
        let svg = String::from_utf8(chart.svg().unwrap()).unwrap();
        let screen = chart.terminal(60, 16).unwrap();
        assert!(["Force", "On Bottom"].iter().all(|n| svg.contains(n) && screen.contains(n)), "{screen}");
        assert_eq!(screen.lines().count(), 18);
        for lines in [10, 16, 24, 41] {
            let screen = chart.terminal(72, lines).unwrap();
            let last: Vec<&str> = screen.lines().skip(lines - 2).take(1).flat_map(str::split_whitespace).collect();
            assert!(last.contains(&"1.0") && last.contains(&"2.0"), "no labels under the axis of\n{screen}");
        }
        assert!(screen.lines().all(|l| l.chars().count() <= 60 && l == l.trim_end()), "{screen}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]
        #[test]
        fn any_points_are_drawn_or_refused(
            points in prop::collection::vec(prop::option::of((any::<f64>(), any::<f64>())), 0..6),
            columns in 0usize..250,
            lines in 0usize..60,
        ) {
            let series = vec![Series { name: "a".into(), points: points.clone() }, Series { name: "b".into(), points }];
            let title = "\u{1b}t".to_string();
            for polar in [false, true] {
                let (series, title) = (series.clone(), title.clone());
                let chart = Chart { title, x_label: String::new(), y_label: String::new(), series, polar };
                let drawn = chart.terminal(columns, lines);
                prop_assert_eq!(drawn.is_ok(), chart.svg().is_ok());
            }
        }
    }
}
