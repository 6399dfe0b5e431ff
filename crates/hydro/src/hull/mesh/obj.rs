//! Wavefront OBJ: vertices `v x y z` and faces `f a b c ..`, an index alone or before slashes, negative from the last vertex back. Other
//! records (normals, texture, groups, materials) do not concern the shape and are passed over.

use super::{MeshFile, at_line, shorten_for_message, triple};
use crate::hull::HullError;

/// Records that say something of shape which is not read.
const CURVED: [&str; 5] = ["curv", "curv2", "surf", "cstype", "vp"];

/// Reads the faces of an OBJ file.
///
/// # Errors
/// The line whose numbers are missing or wrong; a shape of curves.
pub fn read(bytes: &[u8]) -> Result<MeshFile, HullError> {
    let text = String::from_utf8_lossy(bytes);
    let mut file = MeshFile::default();
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut faces: Vec<(usize, Vec<usize>)> = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((n, line)) = lines.next() {
        let mut record = line.to_string();
        while record.ends_with('\\') {
            record.pop();
            let Some((_, more)) = lines.next() else { break };
            record.push(' ');
            record.push_str(more);
        }
        let at = n + 1;
        let mut words = record.split('#').next().unwrap_or_default().split_whitespace();
        match words.next() {
            Some("v") => vertices.push(triple(&mut words, at)?),
            Some("f") => {
                let face: Result<Vec<usize>, HullError> = words.map(|w| index(w, vertices.len(), at)).collect();
                let face = face?;
                if face.len() < 3 {
                    return Err(at_line(at, format!("a face of {} corners; it has three or more", face.len())));
                }
                faces.push((at, face));
            }
            Some("o") if file.title.is_empty() => file.title = words.collect::<Vec<_>>().join(" "),
            Some(word) if CURVED.contains(&word) => {
                return Err(at_line(at, format!("`{word}`: curves and curved surfaces are not read, only v and f")));
            }
            _ => {}
        }
    }
    // a face may come before its vertices
    for (at, face) in faces {
        let corner = |&n: &usize| {
            let missing = || at_line(at, format!("vertex {} of a face; the file has {}", n + 1, vertices.len()));
            vertices.get(n).copied().ok_or_else(missing)
        };
        file.panels.push(face.iter().map(corner).collect::<Result<_, _>>()?);
    }
    Ok(file)
}

/// The vertex a corner of a face names, from 0.
fn index(word: &str, so_far: usize, line: usize) -> Result<usize, HullError> {
    let stated = word.split('/').next().unwrap_or_default();
    let value: i64 =
        stated.parse().map_err(|_| at_line(line, format!("`{}` is no vertex number", shorten_for_message(word))))?;
    let found = if value > 0 { usize::try_from(value - 1).ok() } else { None };
    let back = || usize::try_from(value.unsigned_abs()).ok().filter(|n| *n > 0).and_then(|n| so_far.checked_sub(n));
    found.or_else(|| if value < 0 { back() } else { None }).ok_or_else(|| {
        at_line(
            line,
            format!("vertex {value} of a face; they are counted from 1, or -1 back from the last of {so_far}"),
        )
    })
}
