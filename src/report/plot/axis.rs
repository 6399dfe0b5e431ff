//! An axis: its range, its round ticks, and where a value stands between two pixels.

use crate::report::format;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// Values beyond this are not drawn: the arithmetic of an axis would leave the range of double precision.
pub const MAX_PLOTTED_VALUE: f64 = 1e100;

/// The range of an axis, and about how many ticks it bears.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotAxis {
    low: f64,
    high: f64,
    most: usize,
}

impl PlotAxis {
    /// An axis with at most `most` ticks that shows all `values` (finite, not beyond [`MAX_PLOTTED_VALUE`]) with a little room.
    /// `None` without a value.
    pub fn fit(values: impl Iterator<Item = f64>, most: usize) -> Option<PlotAxis> {
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        if low > high {
            return None;
        }
        let (span, size) = (high - low, low.abs().max(high.abs()));
        // what differs by rounding only is one value
        let room = if span > 1e-9 * size && span > 1.0 / MAX_PLOTTED_VALUE {
            0.03 * span
        } else if size > 1.0 / MAX_PLOTTED_VALUE {
            0.5 * size
        } else {
            1.0
        };
        Some(PlotAxis { low: low - room, high: high + room, most: most.max(2) })
    }

    /// An axis from one value to a larger one.
    pub fn spanning(low: f64, high: f64, most: usize) -> PlotAxis {
        PlotAxis { low, high, most }
    }

    /// The same two axes with one scale for both on a plane of so many units of the surface to the right and up: the one
    /// that would be drawn larger is widened about its middle.
    pub fn with_equal_scales(x: &PlotAxis, y: &PlotAxis, [width, height]: [f64; 2]) -> (PlotAxis, PlotAxis) {
        let length = |axis: &PlotAxis| axis.high - axis.low;
        let scale = (length(x) / width.max(1.0)).max(length(y) / height.max(1.0));
        let widened = |axis: &PlotAxis, room: f64| {
            let (middle, half) = (0.5 * (axis.low + axis.high), 0.5 * scale * room.max(1.0));
            PlotAxis { low: middle - half, high: middle + half, most: axis.most }
        };
        (widened(x, width), widened(y, height))
    }

    /// Where a value stands: 0 at the low end, 1 at the high one.
    pub fn share(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    /// The value that stands at a share of the way from the low end to the high one.
    pub fn value(&self, share: f64) -> f64 {
        self.low + share * (self.high - self.low)
    }

    /// Distance of the ticks when there are at most `most`: 1, 2 or 5 times a power of ten.
    fn step(&self, most: usize) -> f64 {
        let rough = (self.high - self.low) / most as f64;
        let power = 10f64.powf(rough.log10().floor());
        [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * power).find(|s| *s >= rough * 0.999_999).unwrap_or(10.0 * power)
    }

    /// The ticks, from the low end up.
    pub fn ticks(&self, most: usize) -> Vec<f64> {
        let step = self.step(most);
        let (first, last) = ((self.low / step).ceil(), (self.high / step).floor());
        // counted in whole numbers; an axis never has more ticks than it may
        (0..=most).map(|k| first + k as f64).take_while(|k| *k <= last).map(|k| k * step).collect()
    }

    /// The label of a tick.
    pub fn label(&self, value: f64) -> String {
        format::tick(value, self.step(self.most), self.low.abs().max(self.high.abs()))
    }
}

impl Ranged for PlotAxis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let length = f64::from(limit.1) - f64::from(limit.0);
        limit.0 + (length * self.share(*value).clamp(-1.0, 2.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // the fine mesh asks for many more points than the ticks: it gets a fifth of their distance
        let most = if hint.max_num_points() > 2 * self.most { 5 * self.most } else { self.most };
        self.ticks(most)
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for PlotAxis {
    fn format_ext(&self, value: &f64) -> String {
        self.label(*value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn ticks_are_round_and_few() {
        let axis = PlotAxis::fit([5449.0, 8021.0].into_iter(), 8).unwrap();
        let labels: Vec<String> = axis.ticks(8).into_iter().map(|t| axis.label(t)).collect();
        assert_eq!(labels, ["5500", "6000", "6500", "7000", "7500", "8000"]);
        let axis = PlotAxis::fit([0.0, 2.5e-4].into_iter(), 6).unwrap();
        let labels: Vec<String> = axis.ticks(6).into_iter().map(|t| axis.label(t)).collect();
        assert_eq!(labels, ["0", "0.00005", "0.00010", "0.00015", "0.00020", "0.00025"]);
    }

    #[test]
    fn equal_scales_give_both_axes_the_same_length_a_unit() {
        let axis = |low, high| PlotAxis { low, high, most: 8 };
        let (x, y) = PlotAxis::with_equal_scales(&axis(0.0, 100.0), &axis(-5.0, 5.0), [800.0, 400.0]);
        assert_eq!((x.low, x.high), (0.0, 100.0));
        assert_eq!((y.low, y.high), (-25.0, 25.0));
    }

    proptest! {
        #[test]
        fn axis_of_any_values_has_ticks_inside(
            values in prop::collection::vec(any::<f64>().prop_filter("drawable", |v| v.abs() <= MAX_PLOTTED_VALUE), 1..5),
            most in 2usize..12,
        ) {
            let axis = PlotAxis::fit(values.iter().copied(), most).unwrap();
            prop_assert!(values.iter().all(|v| (0.0..=1.0).contains(&axis.share(*v))));
            let ticks = axis.ticks(most);
            prop_assert!(ticks.len() <= most + 1);
            for tick in &ticks {
                prop_assert!((-1e-9..=1.0 + 1e-9).contains(&axis.share(*tick)));
                prop_assert!(axis.label(*tick).len() <= 24);
            }
            let labels: Vec<String> = ticks.iter().map(|t| axis.label(*t)).collect();
            prop_assert!(labels.windows(2).all(|w| w[0] != w[1]), "{labels:?}");
        }
    }
}
