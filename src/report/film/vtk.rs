//! A film as a series of legacy VTK files, one an instant, and the list of them that ParaView opens.
//!
//! Source: The VTK User's Guide, "VTK File Formats", simple legacy formats; the list is ParaView's `.series` (JSON).

use crate::report::embedded::string;
use std::fmt::Write;
use windlass_solve::film::{ConnectorState, Film};

/// One file of the series.
pub struct VtkStep {
    /// Its name.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// The name of an instant's file: `RUN.vtk` has `RUN_0000.vtk`, `RUN_0001.vtk`, ...
fn name(file: &str, frame: usize) -> String {
    format!("{}_{frame:04}.vtk", file.strip_suffix(".vtk").unwrap_or(file))
}

/// The files of a film, made one by one. `file` is the name that ends in `.vtk`.
pub fn steps<'a>(film: &'a Film, title: &'a str, file: &'a str) -> impl Iterator<Item = VtkStep> + 'a {
    (0..film.times.len()).map(move |frame| VtkStep { name: name(file, frame), text: text(film, title, frame) })
}

/// The list of a series with the time of each file: the name and the text.
pub fn series(film: &Film, file: &str) -> VtkStep {
    let folder = |path: &str| path.rsplit(['/', '\\']).next().unwrap_or_default().to_string();
    let row = |(frame, time): (usize, &f64)| {
        format!("    {{ \"name\": {}, \"time\": {time:?} }}", string(&folder(&name(file, frame))))
    };
    let rows: Vec<String> = film.times.iter().enumerate().map(row).collect();
    let text = format!("{{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n{}\n  ]\n}}\n", rows.join(",\n"));
    VtkStep { name: format!("{file}.series"), text }
}

/// One instant: lines as polylines, bodies as triangles; tension (N) and share of the break at points, what a cell
/// belongs to at cells. Where a number does not apply it is zero, as ParaView has no other word.
fn text(film: &Film, title: &str, frame: usize) -> String {
    let heading: String = format!("{title} at {} s", film.times.get(frame).copied().unwrap_or(f64::NAN))
        .chars()
        .filter(|c| c.is_ascii() && !c.is_control())
        .take(255)
        .collect();
    let (mut points, mut lines, mut polygons) = (Vec::new(), Vec::new(), Vec::new());
    let (mut tensions, mut shares, mut owners) = (Vec::new(), Vec::new(), Vec::new());
    let strands = film.strands.iter().filter(|s| s.states.get(frame).is_some_and(|s| *s != ConnectorState::Inactive));
    for strand in strands {
        let first = points.len();
        points.extend_from_slice(strand.points_at(frame));
        let range = frame * strand.count..(frame + 1) * strand.count;
        let of = |list: &[f64]| -> Vec<f64> {
            let found = list.get(range.clone()).unwrap_or_default();
            (0..strand.count).map(|n| found.get(n).copied().filter(|v| v.is_finite()).unwrap_or(0.0)).collect()
        };
        tensions.extend(of(&strand.tensions));
        shares.extend(of(&strand.shares));
        lines.push((first..points.len()).collect::<Vec<_>>());
        // lines from 1, in the order of the film
        owners.push(film.strands.iter().position(|s| s.name == strand.name).map_or(0, |n| n as i64 + 1));
    }
    for (number, actor) in film.actors.iter().enumerate() {
        let Some(pose) = actor.poses.get(frame) else { continue };
        let first = points.len();
        points.extend(actor.solid.points.iter().map(|at| <[f64; 3]>::from(pose.point((*at).into()))));
        for triangle in &actor.solid.triangles {
            polygons.push(triangle.map(|n| first + n as usize).to_vec());
            // bodies below zero, so that they and lines are distinguished
            owners.push(-(number as i64) - 1);
        }
    }
    tensions.resize(points.len(), 0.0);
    shares.resize(points.len(), 0.0);
    let mut out = format!("# vtk DataFile Version 3.0\n{heading}\nASCII\nDATASET POLYDATA\n");
    // writing to a string does not fail
    let _ = writeln!(out, "POINTS {} double", points.len());
    for [x, y, z] in &points {
        let _ = writeln!(out, "{x} {y} {z}");
    }
    for (kind, cells) in [("LINES", &lines), ("POLYGONS", &polygons)] {
        if cells.is_empty() {
            continue;
        }
        let size: usize = cells.iter().map(|c| c.len() + 1).sum();
        let _ = writeln!(out, "{kind} {} {size}", cells.len());
        for cell in cells {
            let numbers: Vec<String> = cell.iter().map(usize::to_string).collect();
            let _ = writeln!(out, "{} {}", cell.len(), numbers.join(" "));
        }
    }
    let _ = writeln!(out, "CELL_DATA {}\nSCALARS owner int 1\nLOOKUP_TABLE default", owners.len());
    for owner in &owners {
        let _ = writeln!(out, "{owner}");
    }
    let _ = writeln!(out, "POINT_DATA {}", points.len());
    for (name, list) in [("tension_N", &tensions), ("tension_over_break", &shares)] {
        let _ = writeln!(out, "SCALARS {name} double 1\nLOOKUP_TABLE default");
        for value in list {
            let _ = writeln!(out, "{value}");
        }
    }
    out
}
