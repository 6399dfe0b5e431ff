//! A polar plot: the distance from the middle over the direction, which is counted from +X, to the right, toward +Y, up.

use super::axis::PlotAxis;
use super::draw::{PlotStyle, PlotSurface, to_plot_error};
use super::{Chart, PlotError, PlotSeries, SUBPIXELS};
use crate::report::format;
use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{PathElement, Pixel, Text};
use plotters::prelude::{BLACK, DrawingBackend, RGBColor};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{IntoFont, TextStyle};
use windlass_base::table::Table;
use windlass_base::units::{Dim, UnitSystem};

/// Rays of a page, and directions named on a terminal (degrees).
const RAYS: (i32, i32) = (30, 90);
/// Distance of the dots that a circle is on a terminal (degrees).
const DOTS: i32 = 6;
/// Height of the line below a page's plot (pixels).
const FOOTER_HEIGHT: u32 = 34 * SUBPIXELS.unsigned_abs();

impl Chart {
    /// A polar chart of columns of a table over its first one, which holds directions.
    ///
    /// # Errors
    /// A first column that holds no angles; a distance below zero.
    pub fn polar(table: &Table, units: UnitSystem) -> Result<Chart, PlotError> {
        let angles = table.columns().first().filter(|c| c.dim == Dim::Angle);
        let angles = angles.ok_or_else(|| {
            PlotError::NoAngle(table.columns().first().map_or(String::new(), super::super::columns::long_name))
        })?;
        let mut made = Chart { polar: true, ..Chart::from_table(table, units)? };
        if made.right_label.is_some() {
            let names: Vec<String> = table.columns().iter().skip(1).map(|c| format::head(c, units)).collect();
            return Err(PlotError::Units(names.join(", ")));
        }
        for series in &mut made.series {
            for (point, angle) in series.points.iter_mut().zip(&angles.cells) {
                let Some((_, distance)) = *point else { continue };
                if distance < 0.0 {
                    return Err(PlotError::Negative(series.name.clone(), distance));
                }
                *point = angle.number().map(|a| (distance * a.cos(), distance * a.sin()));
            }
        }
        let distance = match table.columns().get(1..) {
            Some([one]) => format::head(one, units),
            _ => made.y_label.clone(),
        };
        made.x_label = format!("directions from +X (right) toward +Y (up); distance: {distance}");
        made.y_label = String::new();
        Ok(made)
    }
}

/// Draws the circles and rays of a polar chart, and returns the plane for its curves with its axes.
///
/// # Errors
/// As [`super::draw::draw`].
pub fn plane<'a, B: DrawingBackend + 'a>(
    chart: &Chart,
    area: &DrawingArea<B, Shift>,
    look: &PlotStyle,
) -> Result<(PlotSurface<'a, B>, PlotAxis, PlotAxis), PlotError> {
    let farthest = chart
        .series
        .iter()
        .flat_map(PlotSeries::finite)
        .map(|(x, y)| x.hypot(y))
        .fold(None, |far, r| Some(far.map_or(r, |f: f64| f.max(r))));
    let farthest = farthest.ok_or(PlotError::Empty)?;
    let radii = PlotAxis::fit([0.0, farthest].into_iter(), 5).ok_or(PlotError::Empty)?;
    let rings: Vec<f64> = radii.ticks(5).into_iter().filter(|r| *r > 0.0).collect();
    let rim = rings.iter().copied().fold(if farthest > 0.0 { farthest } else { 1.0 }, f64::max);
    let upper = if look.terminal {
        area.clone()
    } else {
        let (_, height) = area.dim_in_pixel();
        let (upper, lower) = area.split_vertically(height.saturating_sub(FOOTER_HEIGHT));
        let (width, _) = lower.dim_in_pixel();
        let middle = i32::try_from(width / 2).unwrap_or(0);
        lower
            .draw(&Text::new(chart.x_label.clone(), (middle, 8 * look.unit), centred_style(look, VPos::Top)))
            .map_err(to_plot_error)?;
        look.below_title(&upper, &chart.title)?
    };
    let (width, height) = upper.dim_in_pixel();
    let (width, height) = (f64::from(width.max(1)), f64::from(height.max(1)));
    // room for the names of the directions
    let reach = 1.15 * rim;
    let scale = reach / (0.5 * width.min(height));
    let axis = |pixels: f64| PlotAxis::spanning(-0.5 * pixels * scale, 0.5 * pixels * scale, 5);
    let (x, y) = (axis(width), axis(height));
    let mut plane = ChartBuilder::on(&upper).build_cartesian_2d(x.clone(), y.clone()).map_err(to_plot_error)?;
    let at = |degrees: i32, r: f64| {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        (r * cos, r * sin)
    };
    let grey = RGBColor(200, 200, 200);
    for ring in &rings {
        if look.terminal {
            let dots = (0..360).step_by(DOTS as usize).map(|d| Pixel::new(at(d, *ring), BLACK));
            plane.draw_series(dots).map_err(to_plot_error)?;
        } else {
            let circle: Vec<(f64, f64)> = (0..=360).step_by(3).map(|d| at(d, *ring)).collect();
            plane
                .draw_series(std::iter::once(PathElement::new(circle, look.stroke(grey, 1))))
                .map_err(to_plot_error)?;
        }
    }
    let every = if look.terminal { RAYS.1 } else { RAYS.0 };
    for degrees in (0..360).step_by(every as usize) {
        if !look.terminal {
            let ray = PathElement::new(vec![(0.0, 0.0), at(degrees, rim)], look.stroke(grey, 1));
            plane.draw_series(std::iter::once(ray)).map_err(to_plot_error)?;
        }
        let name = Text::new(degrees.to_string(), at(degrees, 1.08 * rim), centred_style(look, VPos::Center));
        plane.draw_series(std::iter::once(name)).map_err(to_plot_error)?;
    }
    for ring in &rings {
        let name = Text::new(radii.label(*ring), at(75, *ring), centred_style(look, VPos::Center));
        plane.draw_series(std::iter::once(name)).map_err(to_plot_error)?;
    }
    Ok((plane, x, y))
}

fn centred_style(look: &PlotStyle, vertical: VPos) -> TextStyle<'static> {
    TextStyle::from(("sans-serif", look.text).into_font()).pos(Pos::new(HPos::Center, vertical))
}

#[cfg(test)]
mod tests {
    use super::*;
    use windlass_base::table::Digits;

    fn table(distance: impl Fn(f64) -> f64) -> Table {
        let angles: Vec<f64> = (0..=24).map(|n| f64::from(n) * 15.0_f64.to_radians()).collect();
        Table::new("Watch")
            .with_rows(&angles)
            .column("", "From", Dim::Angle, Digits::Usual, |angle| *angle)
            .column("", "Excursion", Dim::Length, Digits::Usual, |angle| distance(*angle))
            .build()
    }

    #[test]
    fn polar_angles_are_counted_from_right_upward() {
        let chart = Chart::polar(&table(|a| 1.0 + a), UnitSystem::SI).unwrap();
        let quarter = std::f64::consts::FRAC_PI_2;
        let (x, y) = chart.series[0].points[6].unwrap();
        assert!(x.abs() < 1e-12 && (y - 1.0 - quarter).abs() < 1e-12);
        assert_eq!(chart.series[0].points[0], Some((1.0, 0.0)));
    }

    #[test]
    fn polar_plot_has_circles_direction_names_and_zero_direction() {
        let chart = Chart::polar(&table(|_| 3.0), UnitSystem::SI).unwrap();
        let svg = String::from_utf8(chart.svg().unwrap()).unwrap();
        let caption = "directions from +X (right) toward +Y (up); distance: Excursion (m)";
        for text in ["Watch", caption, "270", "330"] {
            assert!(svg.contains(text), "{text} is missing from the SVG");
        }
        assert!(chart.png().unwrap().starts_with(b"\x89PNG"));
        let screen = chart.terminal(72, 24).unwrap();
        assert!([caption, "Watch", " 90", "180", "270"].iter().all(|t| screen.contains(t)), "{screen}");
    }

    #[test]
    fn polar_circle_is_round() {
        // the polyline of the curve: as wide as high
        let chart = Chart::polar(&table(|_| 3.0), UnitSystem::SI).unwrap();
        let svg = String::from_utf8(chart.svg().unwrap()).unwrap();
        let line = svg.lines().find(|l| l.contains("<polyline") && l.contains("#0072B2")).unwrap();
        let points = line.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
        let pairs: Vec<(f64, f64)> = points
            .split_whitespace()
            .map(|p| p.split_once(',').unwrap())
            .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
            .collect();
        let span = |of: fn(&(f64, f64)) -> f64| {
            let values = || pairs.iter().map(of);
            values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
        };
        assert!((span(|p| p.0) - span(|p| p.1)).abs() <= 2.0, "{points}");
    }

    #[test]
    fn negative_radius_and_non_angle_column_are_refused() {
        let negative = Chart::polar(&table(|_| -1.0), UnitSystem::SI);
        assert_eq!(negative, Err(PlotError::Negative("Excursion".into(), -1.0)));
        let lengths = Table::from_columns("Watch", table(|_| 1.0).columns()[1..].to_vec());
        assert_eq!(Chart::polar(&lengths, UnitSystem::SI), Err(PlotError::NoAngle("Excursion".into())));
    }
}
