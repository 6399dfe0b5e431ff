//! Mesh files: STL, WAMIT GDF and Wavefront OBJ, as panels.

mod gdf;
mod obj;
mod stl;
mod walls;

pub use walls::close_above_waterline;

use super::HullError;
use windlass_base::choices;

choices! {
    /// The kinds of mesh files.
    pub enum MeshKind {
        /// Stereolithography, in text or binary.
        Stl = "STL",
        /// Geometric data file of WAMIT: flat quadrilaterals with planes of symmetry.
        Gdf = "GDF",
        /// Wavefront OBJ: `v` and `f` records.
        Obj = "OBJ",
    }
}

/// What a mesh file holds. Coordinates are as in the file, in its own unit of length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshFile {
    /// Polygons, corners counter-clockwise as seen from outside; mirrored ones included.
    pub panels: Vec<Vec<[f64; 3]>>,
    /// Its title; empty without one.
    pub title: String,
    /// Whether the file gave one side only of the planes x = 0 and y = 0 (GDF: ISX, ISY), and the other was mirrored.
    pub mirrored: [bool; 2],
    /// Characteristic length ULEN of a GDF, in the file's unit; coordinates are not scaled by it.
    pub length: Option<f64>,
    /// Gravity of a GDF, by which its unit can be determined: 9.8 in metres, 32.2 in feet.
    pub gravity: Option<f64>,
}

/// Reads a mesh file. Memory is in proportion to its length: numbers stated in it are checked against what follows.
///
/// # Errors
/// What does not have the form: reported with its line, or its byte in a binary file.
pub fn read_mesh(kind: MeshKind, bytes: &[u8]) -> Result<MeshFile, HullError> {
    match kind {
        MeshKind::Stl => stl::read(bytes),
        MeshKind::Gdf => gdf::read(bytes),
        MeshKind::Obj => obj::read(bytes),
    }
}

/// An error of a line, from 1.
fn at_line(number: usize, why: impl Into<String>) -> HullError {
    HullError::Line { number, why: why.into() }
}

/// A finite number; exponents may be written with D as Fortran does.
fn number(word: &str) -> Option<f64> {
    let plain = word.strip_suffix(',').unwrap_or(word);
    let value: f64 = plain.parse().or_else(|_| plain.replace(['d', 'D'], "e").parse()).ok()?;
    value.is_finite().then_some(value)
}

/// A coordinate triple from words.
fn triple<'a>(words: &mut impl Iterator<Item = &'a str>, line: usize) -> Result<[f64; 3], HullError> {
    let mut at = [0.0; 3];
    for (value, name) in at.iter_mut().zip(["x", "y", "z"]) {
        let word = words.next().ok_or_else(|| at_line(line, format!("no {name}; a corner has x y z")))?;
        *value =
            number(word).ok_or_else(|| at_line(line, format!("`{}` is not a number", shorten_for_message(word))))?;
    }
    Ok(at)
}

/// The beginning of a word, as an error shows it.
fn shorten_for_message(word: &str) -> String {
    word.chars().take(24).map(|c| if c.is_control() { '?' } else { c }).collect()
}
