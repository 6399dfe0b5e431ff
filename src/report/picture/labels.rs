//! Names beside what they name: each stands where it hides the least, and none over another.

/// How far a name may stand from its place, nearest first, in heights of a letter.
const LABEL_DISTANCES: [f64; 6] = [0.35, 0.9, 1.7, 2.8, 4.2, 6.0];
/// What it costs a place that another named point is as near to the name as its own: more than ink below the whole name.
const AMBIGUITY_COST: f64 = 1.5;
/// Where a name may stand beside its place: to the right, upward (1, 0 or -1 each).
const SIDES: [(i32, i32); 8] = [(1, 0), (1, 1), (1, -1), (0, 1), (0, -1), (-1, 0), (-1, 1), (-1, -1)];
/// Names that are tried; those behind are counted as left out.
const MAX_LABELS: usize = 2000;

/// What is to be named.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The name.
    pub text: String,
    /// The pixel it names.
    pub at: (i32, i32),
    /// Which colour it has: an index of the drawing's own.
    pub tone: usize,
}

/// A name that found its place.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedLabel {
    /// The name.
    pub label: Label,
    /// Left, top, width, height (pixels).
    pub at: [i32; 4],
    /// Whether another named point is as near: a line to its own point tells them apart.
    pub is_ambiguous: bool,
}

/// The drawing as the names see it: where ink is.
pub struct Sheet {
    /// Left, top, width, height (pixels).
    at: [i32; 4],
    letter: (i32, i32),
    /// Pixels of a cell of ink.
    cell: (i32, i32),
    columns: i32,
    ink: Vec<bool>,
}

impl Sheet {
    /// A rectangle without ink; letters are so many pixels wide and high.
    pub fn new(at: [i32; 4], letter: (i32, i32)) -> Sheet {
        let cell = ((letter.0 / 2).max(1), (letter.1 / 4).max(1));
        let columns = at[2] / cell.0 + 1;
        let cells = i64::from(columns) * i64::from(at[3] / cell.1 + 1);
        Sheet { at, letter, cell, columns, ink: vec![false; usize::try_from(cells).unwrap_or(0)] }
    }

    fn index(&self, x: i32, y: i32) -> Option<usize> {
        let (column, row) = ((x - self.at[0]).div_euclid(self.cell.0), (y - self.at[1]).div_euclid(self.cell.1));
        let inside = (0..self.columns).contains(&column) && row >= 0;
        usize::try_from(i64::from(row) * i64::from(self.columns) + i64::from(column)).ok().filter(|_| inside)
    }

    /// Notes a stroke.
    pub fn mark(&mut self, points: &[(i32, i32)]) {
        for (a, b) in points.iter().zip(points.iter().skip(1)) {
            let (dx, dy) = (b.0 - a.0, b.1 - a.1);
            let steps = (dx.abs() / self.cell.0).max(dy.abs() / self.cell.1) + 1;
            for step in 0..=steps {
                let part = |d: i32| (f64::from(d) * f64::from(step) / f64::from(steps)).round() as i32;
                if let Some(slot) = self.index(a.0 + part(dx), a.1 + part(dy)).and_then(|i| self.ink.get_mut(i)) {
                    *slot = true;
                }
            }
        }
    }

    /// Ink under a rectangle, as a share of it.
    fn hidden(&self, [left, top, width, height]: [i32; 4]) -> f64 {
        let (mut covered, mut all) = (0u32, 0u32);
        for y in (top..top + height).step_by(usize::try_from(self.cell.1).unwrap_or(1)) {
            for x in (left..left + width).step_by(usize::try_from(self.cell.0).unwrap_or(1)) {
                all += 1;
                covered += u32::from(self.index(x, y).and_then(|i| self.ink.get(i)).copied().unwrap_or(true));
            }
        }
        f64::from(covered) / f64::from(all.max(1))
    }

    /// Places names in the order given: each where it covers the least ink near its place, inside of the sheet and over
    /// no other name. Those that find no place are left out; their number is the second value.
    pub fn position(&self, labels: Vec<Label>) -> (Vec<PlacedLabel>, usize) {
        let mut placed: Vec<PlacedLabel> = Vec::new();
        let count = labels.len();
        let mut points: Vec<(i32, i32)> = labels.iter().take(MAX_LABELS).map(|label| label.at).collect();
        points.sort_unstable();
        points.dedup();
        for label in labels.into_iter().take(MAX_LABELS) {
            let free = |at: &[i32; 4]| self.holds(at) && !placed.iter().any(|p| overlap(&p.at, at));
            let spots = LABEL_DISTANCES.iter().flat_map(|reach| SIDES.iter().map(move |side| (*reach, *side)));
            let spots = spots.map(|(reach, side)| (reach, self.label_rectangle(&label, reach, side)));
            let best = spots.filter(|(_, at)| free(at)).map(|(reach, at)| {
                let is_ambiguous = self.is_ambiguous(&label, &at, &points);
                let cost = self.hidden(at) + 0.12 * reach + if is_ambiguous { AMBIGUITY_COST } else { 0.0 };
                (cost, at, is_ambiguous)
            });
            // the first of equals, so that the picture is the same every time
            let best = best.fold(None, |best: Option<(f64, [i32; 4], bool)>, new| match best {
                Some(old) if old.0 <= new.0 => Some(old),
                _ => Some(new),
            });
            placed.extend(best.map(|(_, at, is_ambiguous)| PlacedLabel { label, at, is_ambiguous }));
        }
        let left_out = count - placed.len();
        (placed, left_out)
    }

    /// Whether another named point is about as near to a name's rectangle as its own point.
    fn is_ambiguous(&self, label: &Label, at: &[i32; 4], points: &[(i32, i32)]) -> bool {
        let own = distance(at, label.at);
        let is_other = |p: &&(i32, i32)| (p.0 - label.at.0).abs() + (p.1 - label.at.1).abs() > self.letter.0 / 4;
        points.iter().filter(is_other).any(|p| distance(at, *p) < own + f64::from(self.letter.0))
    }

    /// The rectangle of a name on a side of its place, on whole letters where the sheet is made of them.
    fn label_rectangle(&self, label: &Label, reach: f64, (h, v): (i32, i32)) -> [i32; 4] {
        let letters = self.letter.0.saturating_mul(i32::try_from(label.text.chars().count()).unwrap_or(0));
        // wide capitals need more than the width of a letter
        let width = if self.in_characters() { letters } else { letters.saturating_add(self.letter.0 / 2) };
        let height = self.letter.1;
        let slant = if h != 0 && v != 0 { 0.7 } else { 1.0 };
        let by = ((slant * reach * f64::from(height)).round() as i32).max(self.letter.0);
        let left = match h {
            1 => label.at.0 + by,
            -1 => label.at.0 - by - width,
            _ => label.at.0 - width / 2,
        };
        let top = match v {
            1 => label.at.1 - by - height,
            -1 => label.at.1 + by,
            _ => label.at.1 - height / 2,
        };
        if !self.in_characters() {
            return [left, top, width, height];
        }
        let whole = |at: i32, size: i32| at.div_euclid(size) * size;
        [whole(left, self.letter.0), whole(top + height / 2, height), width, height]
    }

    /// Whether the sheet is made of characters: names stand on whole ones.
    fn in_characters(&self) -> bool {
        self.letter.1 <= 4
    }

    fn holds(&self, at: &[i32; 4]) -> bool {
        let [left, top, width, height] = self.at;
        at[0] >= left && at[1] >= top && at[0] + at[2] <= left + width && at[1] + at[3] <= top + height
    }
}

/// Distance of a point from a rectangle; zero within it.
fn distance([left, top, width, height]: &[i32; 4], (x, y): (i32, i32)) -> f64 {
    let beyond = |at: i32, from: i32, size: i32| f64::from((from - at).max(at - from - size).max(0));
    beyond(x, *left, *width).hypot(beyond(y, *top, *height))
}

fn overlap(a: &[i32; 4], b: &[i32; 4]) -> bool {
    a[0] < b[0] + b[2] && b[0] < a[0] + a[2] && a[1] < b[1] + b[3] && b[1] < a[1] + a[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn label(text: &str, at: (i32, i32)) -> Label {
        Label { text: text.into(), at, tone: 0 }
    }

    #[test]
    fn labels_at_one_point_are_offset_and_hidden_ones_counted() {
        let sheet = Sheet::new([0, 0, 300, 200], (8, 16));
        let (placed, left_out) = sheet.position((0..200).map(|n| label(&format!("N{n}"), (150, 100))).collect());
        assert!(placed.len() > 12 && placed.len() + left_out == 200, "{}", placed.len());
        for (i, a) in placed.iter().enumerate() {
            assert!(sheet.holds(&a.at));
            assert!(placed.iter().skip(i + 1).all(|b| !overlap(&a.at, &b.at)));
        }
    }

    #[test]
    fn label_stands_nearer_its_own_point_than_any_other() {
        // two points four letters apart: each name on the far side of the other point
        let sheet = Sheet::new([0, 0, 300, 200], (8, 16));
        let (placed, _) = sheet.position(vec![label("F1", (150, 100)), label("F2", (182, 100))]);
        assert!(placed.iter().all(|p| !p.is_ambiguous), "{placed:?}");
        for name in &placed {
            let other = if name.label.text == "F1" { (182, 100) } else { (150, 100) };
            assert!(distance(&name.at, name.label.at) < distance(&name.at, other), "{placed:?}");
        }
        // of two points in nearly one place one name is ambiguous, and has a line to its point
        let (placed, _) = sheet.position(vec![label("A", (150, 100)), label("B", (153, 100))]);
        assert!(placed.iter().any(|p| p.is_ambiguous), "{placed:?}");
    }

    #[test]
    fn label_keeps_clear_of_lines() {
        let mut sheet = Sheet::new([0, 0, 300, 200], (8, 16));
        assert_eq!(sheet.position(vec![label("NAME", (150, 100))]).0[0].at[0], 158);
        // a stroke to the right of the place sends it elsewhere
        sheet.mark(&[(150, 100), (290, 100)]);
        let (placed, _) = sheet.position(vec![label("NAME", (150, 100))]);
        assert_eq!(sheet.hidden(placed[0].at), 0.0, "{placed:?}");
    }

    #[test]
    fn terminal_label_is_aligned_to_whole_characters() {
        let sheet = Sheet::new([0, 0, 80, 80], (2, 4));
        for (placed, at) in [(41, 43), (17, 3)].map(|at| (sheet.position(vec![label("AB", at)]).0, at)) {
            assert!(placed[0].at[0] % 2 == 0 && placed[0].at[1] % 4 == 0, "{at:?} {placed:?}");
            assert_eq!(placed[0].at[1] / 4, at.1 / 4);
        }
    }
}
