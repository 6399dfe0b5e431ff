//! A face of a hull cut into panels.

use crate::wetted_hull::Polygon;
use nalgebra::Vector3;
use windlass_model::PanelSizes;

/// Corners of a panel whose area is less than this share of the square of the size are on a line.
const FLAT_SHARE: f64 = 1e-10;
/// How much longer a panel may be for each length that it is away from a refined edge.
const GROWTH: f64 = 1.0;

/// The length of a panel at a distance from a refined edge (m).
fn length_at(sizes: PanelSizes, distance: f64) -> f64 {
    (sizes.largest * sizes.edge_share + GROWTH * distance).min(sizes.largest)
}

/// Adds the panels of a convex face, of whose sides some are refined: a face that is smaller than a panel is one.
pub fn cells(face: &Polygon, refined: &[bool], sizes: PanelSizes, made: &mut Vec<[Vector3<f64>; 4]>) {
    let side = |i: usize| refined.get(i).copied().unwrap_or_default();
    match face.as_slice() {
        [a, b, c, d] => quadrilateral([*a, *b, *c, *d], [side(0), side(1), side(2), side(3)], sizes, made),
        [first, rest @ ..] => {
            let ends: Vec<[Vector3<f64>; 2]> = face
                .iter()
                .zip(face.iter().cycle().skip(1))
                .enumerate()
                .filter(|(i, _)| side(*i))
                .map(|(_, (a, b))| [*a, *b])
                .collect();
            for pair in rest.windows(2) {
                if let [b, c] = pair {
                    triangle([*first, *b, *c], &ends, sizes, made);
                }
            }
        }
        [] => {}
    }
}

/// Cells of a convex quadrilateral, whose sides a-b, b-c, c-d and d-a are refined or not.
fn quadrilateral(
    [a, b, c, d]: [Vector3<f64>; 4],
    [low, right, high, left]: [bool; 4],
    sizes: PanelSizes,
    made: &mut Vec<[Vector3<f64>; 4]>,
) {
    let (along, across) = ((b - a).norm().max((c - d).norm()), (d - a).norm().max((c - b).norm()));
    let is_one = along.max(across) <= sizes.largest * (1.0 + 1e-9);
    let shares = |length: f64, ends: [bool; 2]| if is_one { vec![0.0, 1.0] } else { division(length, ends, sizes) };
    let (columns, rows) = (shares(along, [left, right]), shares(across, [low, high]));
    let at = |u: f64, v: f64| (a * (1.0 - u) + b * u) * (1.0 - v) + (d * (1.0 - u) + c * u) * v;
    for row in rows.windows(2) {
        for column in columns.windows(2) {
            if let ([v, w], [u, t]) = (row, column) {
                push([at(*u, *v), at(*t, *v), at(*t, *w), at(*u, *w)], sizes, made);
            }
        }
    }
}

/// The cuts of a length (m), as shares of it from 0 to 1, refined toward its first or its second end.
fn division(length: f64, ends: [bool; 2], sizes: PanelSizes) -> Vec<f64> {
    // panels up to a distance from a refined end: int dx/(edge + growth x), then of the largest size
    let edge = sizes.largest * sizes.edge_share.clamp(f64::MIN_POSITIVE, 1.0);
    let reach = (sizes.largest - edge) / GROWTH;
    let from_end = |x: f64, is_refined: bool| {
        let inner = if is_refined { x.min(reach) } else { 0.0 };
        (GROWTH * inner / edge).ln_1p() / GROWTH + (x - inner) / sizes.largest
    };
    let half = 0.5 * length;
    let [first, second] = ends.map(|is_refined| from_end(half, is_refined));
    let whole = first + second;
    let count = (whole - 1e-9).ceil().max(1.0) as usize;
    // where so many panels end
    let inverse = |panels: f64, is_refined: bool| {
        let graded = if is_refined { (GROWTH * reach / edge).ln_1p() / GROWTH } else { 0.0 };
        if panels < graded {
            (GROWTH * panels).exp_m1() * edge / GROWTH
        } else {
            (panels - graded) * sizes.largest + if is_refined { reach } else { 0.0 }
        }
    };
    let cut = |i: usize| {
        let panels = whole * i as f64 / count as f64;
        let x = if panels <= first { inverse(panels, ends[0]) } else { length - inverse(whole - panels, ends[1]) };
        (x / length).clamp(0.0, 1.0)
    };
    (0..=count).map(|i| if i == count { 1.0 } else { cut(i) }).collect()
}

/// Parts of a triangle, halved across its longest side until that is the diagonal of a square of the size there.
fn triangle(
    corners: [Vector3<f64>; 3],
    refined: &[[Vector3<f64>; 2]],
    sizes: PanelSizes,
    made: &mut Vec<[Vector3<f64>; 4]>,
) {
    // parts of a triangle shrink in both directions: as many as a quadrilateral has, which shrinks in one, leave the root of the share
    let sizes = PanelSizes { edge_share: sizes.edge_share.sqrt(), ..sizes };
    let largest = |[a, b, c]: &[Vector3<f64>; 3]| (a - b).norm().max((b - c).norm()).max((c - a).norm());
    let is_one = largest(&corners) <= sizes.largest * std::f64::consts::SQRT_2;
    let mut open = vec![corners];
    while let Some([a, b, c]) = open.pop() {
        let edges = [(a - b).norm(), (b - c).norm(), (c - a).norm()];
        let turned = if edges[0] >= edges[1] && edges[0] >= edges[2] {
            [a, b, c]
        } else if edges[1] >= edges[2] {
            [b, c, a]
        } else {
            [c, a, b]
        };
        let [p, q, r] = turned;
        let middle = (a + b + c) / 3.0;
        let distance = refined.iter().map(|side| distance_to(side, &middle)).fold(f64::INFINITY, f64::min);
        if is_one || (p - q).norm() <= length_at(sizes, distance) * std::f64::consts::SQRT_2 {
            push([p, q, r, r], sizes, made);
        } else {
            let middle = (p + q) * 0.5;
            open.extend([[p, middle, r], [middle, q, r]]);
        }
    }
}

/// The distance of a point from a straight line between two ends (m).
fn distance_to([a, b]: &[Vector3<f64>; 2], at: &Vector3<f64>) -> f64 {
    let along = b - a;
    let share = ((at - a).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (at - a - along * share).norm()
}

fn push(panel: [Vector3<f64>; 4], sizes: PanelSizes, made: &mut Vec<[Vector3<f64>; 4]>) {
    let [a, b, c, d] = panel;
    if (c - a).cross(&(d - b)).norm() > FLAT_SHARE * (sizes.largest * sizes.edge_share).powi(2) {
        made.push(panel);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_grow_from_a_refined_end() {
        let sizes = PanelSizes { largest: 2.0, edge_share: 0.25 };
        // int dx/(0.5 + x) up to 1.5 is ln 4, then (8 - 1.5)/2: 4.64 panels, five of 0.927 each: the first ends at (e^0.927 - 1)/2
        let cuts = division(8.0, [true, false], sizes);
        let panels = 4.0_f64.ln() + 3.25;
        assert_eq!(cuts.len(), 6);
        let first = ((panels / 5.0).exp() - 1.0) * 0.5 / 8.0;
        assert!((cuts[1] - first).abs() < 1e-12, "{cuts:?}");
        // the others are of the largest size
        assert!((cuts[5] - cuts[4] - panels / 5.0 * 2.0 / 8.0).abs() < 1e-12, "{cuts:?}");
        let turned: Vec<f64> = division(8.0, [false, true], sizes).iter().rev().map(|cut| 1.0 - cut).collect();
        assert!(cuts.iter().zip(&turned).all(|(a, b)| (a - b).abs() < 1e-12), "{cuts:?} {turned:?}");
    }

    #[test]
    fn panels_of_one_size_are_equal() {
        let all_equal = |cuts: &[f64]| cuts.windows(2).all(|pair| (pair[1] - pair[0] - 0.25).abs() < 1e-12);
        assert!(all_equal(&division(10.0, [true, true], PanelSizes::equal(2.5))));
        assert!(all_equal(&division(8.0, [false, false], PanelSizes { largest: 2.5, edge_share: 0.25 })));
    }
}
