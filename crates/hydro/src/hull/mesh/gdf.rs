//! GDF of WAMIT, low order: a title; ULEN GRAV; ISX ISY; NPAN; then four corners a panel, free over lines. A triangle repeats a
//! corner. Corners run counter-clockwise as seen from the water (WAMIT manual, "The geometric data file").

use super::{MeshFile, at_line, number, shorten_for_message};
use crate::hull::HullError;

/// Reads the panels of a GDF file.
///
/// # Errors
/// The line whose numbers are missing or wrong; panels that are not there.
pub fn read(bytes: &[u8]) -> Result<MeshFile, HullError> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines().enumerate().map(|(n, line)| (n + 1, line));
    let title = lines.next().map(|(_, line)| line.trim().to_string()).unwrap_or_default();
    // blank lines between the header's are passed over; what stands behind its numbers is comment
    let mut header = |what: &str| {
        let filled = lines.find(|(_, line)| !line.trim().is_empty());
        filled.ok_or_else(|| at_line(text.lines().count().max(1), format!("the file ends before {what}")))
    };
    let [length, gravity] = pair(header("ULEN GRAV")?, ["ULEN", "GRAV"])?;
    let symmetry = header("ISX ISY")?;
    let mut mirrored = [false; 2];
    for ((flag, value), name) in mirrored.iter_mut().zip(pair(symmetry, ["ISX", "ISY"])?).zip(["ISX", "ISY"]) {
        *flag = match value {
            0.0 => false,
            1.0 => true,
            _ => return Err(at_line(symmetry.0, format!("{name} is {value}; it is 0, or 1 for a plane of symmetry"))),
        };
    }
    let (at, count) = header("NPAN")?;
    let mut words = fields(count);
    let stated = words.next().unwrap_or_default();
    let panels: usize = stated.parse().map_err(|_| {
        at_line(at, format!("`{}` is not a valid number of panels (NPAN)", shorten_for_message(stated)))
    })?;
    if words.next().and_then(|w| w.parse::<i64>().ok()).is_some_and(|kind| kind != 0) {
        return Err(at_line(at, "a second number (IGDEF): patches of higher order are not read, only flat panels"));
    }
    // a coordinate takes a digit and a blank at least
    if panels > bytes.len() / 24 + 1 {
        return Err(at_line(at, format!("{panels} panels stated; the file is too short for them")));
    }
    let mut file = MeshFile { panels: Vec::with_capacity(panels), title, mirrored, ..MeshFile::default() };
    (file.length, file.gravity) = (Some(length), Some(gravity));
    let mut values: Vec<f64> = Vec::with_capacity(12);
    let mut end = at;
    'file: for (n, line) in lines {
        for word in fields(line) {
            if file.panels.len() == panels {
                break 'file;
            }
            end = n;
            values.push(
                number(word).ok_or_else(|| at_line(n, format!("`{}` is no coordinate", shorten_for_message(word))))?,
            );
            if values.len() == 12 {
                file.panels.push(values.chunks_exact(3).filter_map(|c| c.try_into().ok()).collect());
                values.clear();
            }
        }
    }
    if file.panels.len() < panels {
        let read = file.panels.len();
        return Err(at_line(end, format!("{panels} panels of 12 numbers stated, but only {read} follow")));
    }
    for (axis, _) in mirrored.iter().enumerate().filter(|(_, on)| **on) {
        let other: Vec<Vec<[f64; 3]>> = file.panels.iter().map(|panel| mirror(panel, axis)).collect();
        file.panels.extend(other);
    }
    Ok(file)
}

/// A panel seen in the plane across an axis: its corners in the other order, so that they still run counter-clockwise.
fn mirror(panel: &[[f64; 3]], axis: usize) -> Vec<[f64; 3]> {
    let flipped = panel.iter().rev().map(|corner| {
        let mut at = *corner;
        if let Some(x) = at.get_mut(axis) {
            // no negative zero
            *x = 0.0 - *x;
        }
        at
    });
    flipped.collect()
}

fn fields(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| c.is_whitespace() || c == ',').filter(|w| !w.is_empty())
}

/// The first two numbers of a line.
fn pair((at, line): (usize, &str), names: [&str; 2]) -> Result<[f64; 2], HullError> {
    let mut words = fields(line);
    let mut values = [0.0; 2];
    for (value, name) in values.iter_mut().zip(names) {
        let word = words.next().unwrap_or_default();
        *value = number(word)
            .ok_or_else(|| at_line(at, format!("`{}` is not a number for {name}", shorten_for_message(word))))?;
    }
    Ok(values)
}
