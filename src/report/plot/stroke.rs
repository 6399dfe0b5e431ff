//! How curves differ: colours, and dashes once the colours are used up.

use plotters::prelude::RGBColor;

/// Colours that stay apart for colour-blind eyes [OKABE-ITO-2008], in fixed order.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];
/// Dashes and gaps by turns (pixels): drawn through, dashed, dotted, dash-dotted, long dashes. With the colours, 35 curves differ.
const PATTERNS: [&[f64]; 5] = [&[], &[9.0, 5.0], &[2.5, 4.0], &[10.0, 4.0, 2.5, 4.0], &[18.0, 6.0]];

/// The look of one curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveStyle {
    /// Colour of its stroke and points.
    pub colour: RGBColor,
    /// Dashes and gaps by turns (pixels); none of a curve that is drawn through.
    pub pattern: &'static [f64],
}

impl CurveStyle {
    /// The look of the curve of a number (from 0).
    pub fn new(index: usize) -> CurveStyle {
        let (round, colour) = (index / COLOURS.len(), index % COLOURS.len());
        CurveStyle {
            colour: COLOURS.get(colour).copied().unwrap_or(RGBColor(0, 0, 0)),
            pattern: PATTERNS.get(round % PATTERNS.len()).copied().unwrap_or_default(),
        }
    }
}

/// The dashes of a path: `pattern` holds the lengths of dashes and gaps by turns, in the units of the points. The pattern runs on
/// around corners. A path without a pattern is one piece.
pub fn dashes(points: &[(i32, i32)], pattern: &[f64]) -> Vec<Vec<(i32, i32)>> {
    let whole: f64 = pattern.iter().sum();
    if whole <= 0.0 || pattern.iter().any(|length| !length.is_finite() || *length < 0.0) {
        return if points.len() > 1 { vec![points.to_vec()] } else { Vec::new() };
    }
    let mut pieces: Vec<Vec<(i32, i32)>> = Vec::new();
    let (mut number, mut left) = (0usize, pattern.first().copied().unwrap_or(0.0));
    let mut open = false;
    for (a, b) in points.iter().zip(points.iter().skip(1)) {
        let (dx, dy) = (f64::from(b.0) - f64::from(a.0), f64::from(b.1) - f64::from(a.1));
        let length = dx.hypot(dy);
        if length == 0.0 {
            continue;
        }
        let at = |s: f64| {
            let part = |from: i32, by: f64| (f64::from(from) + by * s / length).round() as i32;
            (part(a.0, dx), part(a.1, dy))
        };
        let mut done = 0.0;
        while done < length {
            let end = (done + left).min(length);
            if number.is_multiple_of(2) {
                match pieces.last_mut().filter(|_| open) {
                    Some(piece) => piece.push(at(end)),
                    None => pieces.push(vec![at(done), at(end)]),
                }
                open = true;
            }
            left -= end - done;
            done = end;
            if left <= 1e-9 {
                number = (number + 1) % pattern.len();
                left = pattern.get(number).copied().unwrap_or(whole).max(1e-3);
                open = false;
            }
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_continue_around_a_corner() {
        let path = [(0, 0), (10, 0), (10, 10)];
        assert_eq!(
            dashes(&path, &[4.0, 4.0]),
            [vec![(0, 0), (4, 0)], vec![(8, 0), (10, 0), (10, 2)], vec![(10, 6), (10, 10)]]
        );
        assert!(dashes(&[(5, 5)], &[4.0, 4.0]).is_empty());
        assert_eq!(dashes(&path, &[]), [path.to_vec()]);
    }

    #[test]
    fn thirty_five_curves_look_different() {
        let styles: Vec<CurveStyle> = (0..35).map(CurveStyle::new).collect();
        for (index, style) in styles.iter().enumerate() {
            assert!(styles.iter().skip(index + 1).all(|other| other != style), "{index}");
        }
        assert_eq!(CurveStyle::new(35), styles[0]);
    }
}
