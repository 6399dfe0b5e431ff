//! STL: triangles, in text (`solid` .. `facet` .. `vertex`) or binary (80 bytes, a count, 50 bytes a triangle). Normals stated in it are
//! not used: the order of corners defines the outside, as the format demands of both.

use super::{MeshFile, at_line, shorten_for_message, triple};
use crate::hull::HullError;

/// Bytes before the triangles of a binary file: a title and their count.
const HEADER_BYTES: usize = 84;
/// Bytes of a triangle: normal, three corners, two bytes that mean nothing.
const BYTES_PER_TRIANGLE: usize = 50;

/// Reads the triangles of an STL file, text or binary.
///
/// # Errors
/// The line or triangle that is not whole.
pub fn read(bytes: &[u8]) -> Result<MeshFile, HullError> {
    let stated = bytes.get(80..HEADER_BYTES).and_then(|b| b.try_into().ok()).map(|b| u32::from_le_bytes(b) as usize);
    let fits = stated.and_then(|n| n.checked_mul(BYTES_PER_TRIANGLE)).and_then(|n| n.checked_add(HEADER_BYTES))
        == Some(bytes.len());
    // a binary title may begin with `solid` too: the length decides
    let text = bytes.trim_ascii_start().get(..5).is_some_and(|b| b.eq_ignore_ascii_case(b"solid"));
    match stated {
        Some(_) if fits => binary(bytes),
        _ if text => ascii(&String::from_utf8_lossy(bytes)),
        Some(n) => Err(HullError::Byte {
            at: 80,
            why: format!(
                "{n} triangles stated, which take {} bytes; the file has {} (and does not begin with `solid`)",
                n as u64 * BYTES_PER_TRIANGLE as u64 + HEADER_BYTES as u64,
                bytes.len()
            ),
        }),
        None => Err(HullError::Byte {
            at: bytes.len(),
            why: "the file ends within its first 84 bytes, and does not begin with `solid`".into(),
        }),
    }
}

fn binary(bytes: &[u8]) -> Result<MeshFile, HullError> {
    let (head, body) = bytes.split_at(HEADER_BYTES.min(bytes.len()));
    let title = head.get(..80).unwrap_or_default().split(|b| *b == 0).next().unwrap_or_default();
    let title = String::from_utf8_lossy(title).trim().to_string();
    let mut panels = Vec::with_capacity(body.len() / BYTES_PER_TRIANGLE);
    for (n, record) in body.chunks_exact(BYTES_PER_TRIANGLE).enumerate() {
        let mut values = record.chunks_exact(4).skip(3).map(|b| b.try_into().map_or(f32::NAN, f32::from_le_bytes));
        let mut corner = || std::array::from_fn(|_| f64::from(values.next().unwrap_or(f32::NAN)));
        let panel: Vec<[f64; 3]> = (0..3).map(|_| corner()).collect();
        if panel.iter().flatten().any(|x| !x.is_finite()) {
            let why = format!("triangle {}: a coordinate is not a finite number", n + 1);
            return Err(HullError::Byte { at: HEADER_BYTES + n * BYTES_PER_TRIANGLE, why });
        }
        panels.push(panel);
    }
    Ok(MeshFile { panels, title, ..MeshFile::default() })
}

fn ascii(text: &str) -> Result<MeshFile, HullError> {
    let mut file = MeshFile::default();
    let mut corners: Option<Vec<[f64; 3]>> = None;
    let mut last = 0;
    for (n, line) in text.lines().enumerate() {
        last = n + 1;
        let mut words = line.split_whitespace();
        let Some(word) = words.next() else { continue };
        match word.to_ascii_lowercase().as_str() {
            "solid" if corners.is_none() => {
                if file.title.is_empty() {
                    file.title = words.collect::<Vec<_>>().join(" ");
                }
            }
            "facet" | "endsolid" if corners.is_none() => {}
            "endfacet" if corners.is_none() => {}
            "outer" if corners.is_none() => corners = Some(Vec::new()),
            "vertex" => match &mut corners {
                Some(list) => list.push(triple(&mut words, last)?),
                None => return Err(at_line(last, "`vertex` outside `outer loop` .. `endloop`")),
            },
            "endloop" => match corners.take() {
                Some(list) if list.len() >= 3 => file.panels.push(list),
                Some(list) => return Err(at_line(last, format!("a loop of {} corners; it has three", list.len()))),
                None => return Err(at_line(last, "`endloop` without `outer loop`")),
            },
            _ => {
                let wanted = if corners.is_some() { "vertex or endloop" } else { "facet, outer loop or endsolid" };
                return Err(at_line(last, format!("`{}`; expected {wanted}", shorten_for_message(word))));
            }
        }
    }
    if corners.is_some() {
        return Err(at_line(last, "the file ends within a loop"));
    }
    Ok(file)
}
