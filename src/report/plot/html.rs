//! A chart as one page of HTML with nothing to be fetched from elsewhere (share/plot): it shows values, zooms, hides curves.

use super::stroke::CurveStyle;
use super::{Chart, PlotError, PlotSeries};
use crate::report::embedded::{self, doubles, list, object, string};

/// Most points of a page.
pub const MAX_PAGE_POINTS: usize = 1_000_000;

const PAGE_PARTS: [(&str, &str); 3] = [
    ("page.html", include_str!("../../../share/plot/page.html")),
    ("style.css", include_str!("../../../share/plot/style.css")),
    ("plot.js", include_str!("../../../share/plot/plot.js")),
];

impl Chart {
    /// The chart as a page.
    ///
    /// # Errors
    /// [`PlotError`].
    pub fn html(&self) -> Result<Vec<u8>, PlotError> {
        if self.polar {
            return Err(PlotError::PolarPage);
        }
        let points = || self.series.iter().flat_map(PlotSeries::finite);
        if points().next().is_none() {
            return Err(PlotError::Empty);
        }
        if let Some((x, y)) = points().find(|(x, y)| x.abs().max(y.abs()) > super::axis::MAX_PLOTTED_VALUE) {
            return Err(PlotError::Range(x, y));
        }
        let count = self.series.iter().map(|s| s.points.len()).sum();
        if count > MAX_PAGE_POINTS {
            return Err(PlotError::TooMany(count));
        }
        let curve = |(index, series): (usize, &PlotSeries)| {
            let of = |pick: fn((f64, f64)) -> f64| {
                doubles(series.points.iter().map(|p| super::finite(*p).map_or(f64::NAN, pick)))
            };
            let CurveStyle { colour, pattern } = CurveStyle::new(index);
            object([
                ("name", string(&series.legend_name())),
                ("right", series.right.to_string()),
                ("marks", series.is_marks().to_string()),
                ("colour", string(&format!("rgb({}, {}, {})", colour.0, colour.1, colour.2))),
                ("dashes", list(pattern.iter().map(f64::to_string))),
                ("x", of(|p| p.0)),
                ("y", of(|p| p.1)),
            ])
        };
        let data = object([
            ("title", string(&self.title)),
            ("x", string(&self.x_label)),
            ("left", string(&self.y_label)),
            ("equal", self.equal.to_string()),
            ("right", self.right_label.as_ref().map_or("null".into(), |l| string(l))),
            ("curves", list(self.series.iter().enumerate().map(curve))),
        ]);
        let page = embedded::page(&PAGE_PARTS, &self.title, data).map_err(|e| PlotError::Backend(format!("{e:#}")))?;
        Ok(page.into_bytes())
    }
}
