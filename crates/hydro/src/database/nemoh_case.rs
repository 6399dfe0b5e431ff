//! `Nemoh.cal`: what NEMOH was asked to compute.
//!
//! Source: [NEMOH-3 Main input file Nemoh.cal]; version 2 has the same lines.

use super::rows::{DatabaseError, SourceFile, number, separates};
use nalgebra::Vector3;

/// One direction of a motion or a force of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NemohDirection {
    /// 0 to 5.
    pub mode: usize,
    /// The point a rotation or moment is about.
    pub about: Option<Vector3<f64>>,
}

/// What is read of a `Nemoh.cal`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct NemohCase {
    /// Density (kg/m3).
    pub density: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
    /// Depth (m); `None` for deep water.
    pub depth: Option<f64>,
    /// Where phases of waves refer to (m).
    pub waves_at: [f64; 2],
    /// Motions and forces of each body.
    pub bodies: Vec<(Vec<NemohDirection>, Vec<NemohDirection>)>,
}

/// The lines of the file, read one by one.
struct FileLines<'a> {
    file: &'a SourceFile,
    rest: std::iter::Enumerate<std::str::Lines<'a>>,
    at: usize,
}

impl<'a> FileLines<'a> {
    fn next_line(&mut self) -> Result<&'a str, DatabaseError> {
        let (index, line) = self.rest.next().ok_or_else(|| self.file.error("it ends too early"))?;
        self.at = index + 1;
        Ok(line)
    }

    /// The numbers a line begins with; more may follow.
    fn numbers<const N: usize>(&mut self) -> Result<[f64; N], DatabaseError> {
        let line = self.next_line()?;
        let words = line.split(separates).filter(|w| !w.is_empty());
        let list: Vec<f64> = words.map_while(number).take(N).collect();
        let wrong =
            |list: Vec<f64>| self.file.wrong_at(self.at, format!("it begins with {} numbers, not {N}", list.len()));
        list.try_into().map_err(wrong)
    }

    /// A count from 0 to a most.
    fn count(&mut self, most: usize, what: &str) -> Result<usize, DatabaseError> {
        let [value] = self.numbers()?;
        if value >= 0.0 && value <= most as f64 && value.fract() == 0.0 {
            Ok(value as usize)
        } else {
            Err(self.file.wrong_at(self.at, format!("{value} is not a valid number of {what}, 0 to {most}")))
        }
    }

    /// A line of a motion or a force: `1 dx dy dz ..` or `2 dx dy dz x y z`.
    fn direction(&mut self) -> Result<NemohDirection, DatabaseError> {
        let [kind, dx, dy, dz, x, y, z] = self.numbers()?;
        let direction = [dx, dy, dz];
        let axis = direction.iter().position(|k| *k == 1.0);
        let others = direction.iter().filter(|k| **k != 0.0).count();
        match (kind, axis) {
            (1.0, Some(axis)) if others == 1 => Ok(NemohDirection { mode: axis, about: None }),
            (2.0, Some(axis)) if others == 1 => {
                Ok(NemohDirection { mode: 3 + axis, about: Some(Vector3::new(x, y, z)) })
            }
            _ => Err(self.file.wrong_at(self.at, "only motions along and about the axes x, y and z are read")),
        }
    }
}

/// Reads a `Nemoh.cal`.
///
/// # Errors
/// A file that does not have the form; motions that are not along or about the axes.
pub(super) fn read(file: &SourceFile) -> Result<NemohCase, DatabaseError> {
    let mut lines = FileLines { file, rest: file.text.lines().enumerate(), at: 0 };
    let mut case = NemohCase::default();
    lines.next_line()?;
    [case.density] = lines.numbers()?;
    [case.gravity] = lines.numbers()?;
    let [depth] = lines.numbers()?;
    case.depth = Some(depth).filter(|d| *d > 0.0);
    case.waves_at = lines.numbers()?;
    lines.next_line()?;
    let bodies = lines.count(1000, "bodies")?;
    for _ in 0..bodies {
        for _ in 0..3 {
            lines.next_line()?;
        }
        let motions = lines.count(1000, "degrees of freedom")?;
        let motions = (0..motions).map(|_| lines.direction()).collect::<Result<Vec<_>, _>>()?;
        let forces = lines.count(1000, "forces")?;
        let forces = (0..forces).map(|_| lines.direction()).collect::<Result<Vec<_>, _>>()?;
        for _ in 0..lines.count(1000, "further lines")? {
            lines.next_line()?;
        }
        case.bodies.push((motions, forces));
    }
    Ok(case)
}

impl NemohCase {
    /// The point that rotations and moments of a body are about: the same for all, else `None`; the origin where none turns.
    pub(super) fn reference_point(&self, body: usize) -> Option<Vector3<f64>> {
        let (motions, forces) = self.bodies.get(body)?;
        let mut points = motions.iter().chain(forces).filter_map(|d| d.about);
        let Some(first) = points.next() else { return Some(Vector3::zeros()) };
        points.all(|p| p == first).then_some(first)
    }
}
