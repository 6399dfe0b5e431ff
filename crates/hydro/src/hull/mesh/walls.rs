//! Meshes of wetted surfaces, which end in the waterline, closed above it.

use std::collections::BTreeMap;

type Corner = [f64; 3];
type Key = [i64; 3];

/// Corners nearer than this share of the extent are one, and so near the plane z = 0 they are in it.
const SAME_SHARE: f64 = 1e-6;

/// Closes a mesh all of whose open sides lie in the plane z = 0, as meshes for programs of potential flow do, by upright walls as high as it is deep and
/// planes above them. The height of the walls; none of a closed mesh, and of one that is open elsewhere, which stays as it is.
pub fn close_above_waterline(panels: &mut Vec<Vec<Corner>>) -> Option<f64> {
    let extent = panels.iter().flatten().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let room = SAME_SHARE * extent;
    if room <= 0.0 {
        return None;
    }
    let key = |at: &Corner| at.map(|x| (x / (4.0 * room)).round() as i64);
    // of each side how often it is there, with its ends as its panel runs
    let mut sides: BTreeMap<[Key; 2], (usize, [Corner; 2])> = BTreeMap::new();
    for panel in panels.iter() {
        for (a, b) in panel.iter().zip(panel.iter().cycle().skip(1)) {
            let mut ends = [key(a), key(b)];
            if ends[0] == ends[1] {
                continue;
            }
            ends.sort_unstable();
            sides.entry(ends).or_insert((0, [*a, *b])).0 += 1;
        }
    }
    let open: Vec<[Corner; 2]> = sides.into_values().filter(|(count, _)| *count == 1).map(|(_, ends)| ends).collect();
    if open.is_empty() || open.iter().flatten().any(|[.., z]| z.abs() > 4.0 * room) {
        return None;
    }
    let mut after: BTreeMap<Key, [Corner; 2]> = open.iter().map(|side| (key(&side[0]), *side)).collect();
    if after.len() != open.len() {
        return None;
    }
    let depth = panels.iter().flatten().fold(0.0, |most: f64, [.., z]| most.max(-z));
    let raised = |[x, y, _]: Corner| [x, y, depth];
    let mut made = Vec::new();
    while let Some((start, first)) = after.pop_first() {
        let mut ring = vec![first];
        let mut end = key(&first[1]);
        while end != start {
            let side = after.remove(&end)?;
            end = key(&side[1]);
            ring.push(side);
        }
        let count = ring.len() as f64;
        let middle = ring.iter().fold([0.0, 0.0, depth], |[x, y, z], [a, _]| [x + a[0] / count, y + a[1] / count, z]);
        for [a, b] in ring {
            made.push(vec![b, a, raised(a), raised(b)]);
            made.push(vec![raised(b), raised(a), middle]);
        }
    }
    panels.extend(made);
    Some(depth)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume by the divergence of z.
    fn volume(panels: &[Vec<Corner>]) -> f64 {
        let of = |[a, b, c]: [Corner; 3]| {
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            0.5 * area * (a[2] + b[2] + c[2]) / 3.0
        };
        let fan =
            |panel: &Vec<Corner>| -> f64 { (2..panel.len()).map(|i| of([panel[0], panel[i - 1], panel[i]])).sum() };
        panels.iter().map(fan).sum()
    }

    #[test]
    fn open_box_becomes_one_of_twice_its_depth() {
        // 4 x 2 x 3 m below the water without a top: 24 m3, and as much above it
        let at = |i: usize, z: f64| [[0.0, 4.0, 4.0, 0.0][i % 4], [0.0, 0.0, 2.0, 2.0][i % 4], z];
        let side = |i: usize| vec![at(i, -3.0), at(i + 1, -3.0), at(i + 1, 0.0), at(i, 0.0)];
        let mut panels: Vec<Vec<Corner>> = (0..4).map(side).collect();
        panels.push((0..4).rev().map(|i| at(i, -3.0)).collect());
        let mut deckless = panels.clone();
        assert_eq!(close_above_waterline(&mut panels), Some(3.0));
        assert!((volume(&panels) - 48.0).abs() < 1e-9, "{}", volume(&panels));
        assert_eq!(close_above_waterline(&mut panels), None);
        // open below the water it stays as it is
        deckless.pop();
        assert_eq!((close_above_waterline(&mut deckless), deckless.len()), (None, 4));
    }
}
