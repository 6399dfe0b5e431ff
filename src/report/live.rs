//! The page of a job that runs: the model with lines that can be chosen, the tables of the last solve, tensions and places of the last
//! run over time (share/live). One file with nothing to be fetched from elsewhere; it loads itself anew when it has changed.

use super::embedded::{self, doubles, list, number, object, string};
use super::format;
use std::io::ErrorKind;
use std::path::PathBuf;
use windlass_base::geometry::Position;
use windlass_base::table::{Column, Fact, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_solve::scene::{Polyline, Scene, Sign, Stroke};
use windlass_solve::time::Run;

/// The page without its data, and what is put into it.
const PAGE_PARTS: [(&str, &str); 3] = [
    ("page.html", include_str!("../../share/live/page.html")),
    ("style.css", include_str!("../../share/live/style.css")),
    ("live.js", include_str!("../../share/live/live.js")),
];
/// Instants of a curve: more are left out evenly.
const MAX_INSTANTS: usize = 1000;
/// Rows of a table that are shown.
const MAX_ROWS: usize = 500;

/// What a page shows.
pub struct LivePage<'a> {
    /// Its title.
    pub title: &'a str,
    /// What the job does now.
    pub state: &'a str,
    /// The model as it stands; none where it cannot be drawn.
    pub scene: Option<&'a Scene>,
    /// What the last solve printed.
    pub tables: &'a [Table],
    /// The last run.
    pub run: Option<&'a Run>,
    /// The user's units.
    pub units: UnitSystem,
}

impl LivePage<'_> {
    /// The page as HTML. Names and texts are data: none of them can be markup.
    ///
    /// # Errors
    /// What the template library reports.
    pub fn html(&self) -> Result<String, minijinja::Error> {
        let scene = self.scene.map_or_else(|| "null".to_string(), |scene| scene_data(scene, self.units));
        let tables = list(self.tables.iter().map(|table| table_data(table, self.units)));
        let curves = list(self.run.map_or(Vec::new(), |run| curves(run, self.units)));
        let length = Dim::Length.label(self.units);
        let body = format!("{scene}{tables}{curves}{}\n{}\n{length}", self.state, self.title);
        let data = object([
            ("title", string(self.title)),
            ("state", string(self.state)),
            ("version", string(&format!("{:016x}", checksum(body.as_bytes())))),
            ("length", string(&length)),
            ("scene", scene),
            ("tables", tables),
            ("curves", curves),
        ]);
        embedded::page(&PAGE_PARTS, self.title, data)
    }
}

/// A page that is written anew as the job goes: whole or not at all.
#[derive(Debug)]
pub struct LivePageFile {
    path: PathBuf,
    /// The page as it was last written.
    written: String,
}

/// Why a page cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum LivePageError {
    /// A file that is none of ours.
    #[error("{0} is there already and is no page of windlass: name another file")]
    Foreign(String),
    /// Not the ending of a page.
    #[error("a page ends in .html, not {0}")]
    Ending(String),
    /// What the system refuses.
    #[error("the page {0} cannot be written: {1}")]
    System(String, std::io::Error),
    /// What the template library refuses.
    #[error("the page cannot be made: {0}")]
    Template(#[from] minijinja::Error),
}

/// What every page of this program holds.
const GENERATOR: &str = "<meta name=\"generator\" content=\"windlass\">";

impl LivePageFile {
    /// A page at a path, where one can be written.
    ///
    /// # Errors
    /// Another ending than .html; a file that is no page of windlass; a folder that cannot be written.
    pub fn new(path: PathBuf) -> Result<Self, LivePageError> {
        let shown = || path.display().to_string();
        if !path.extension().is_some_and(|end| end.eq_ignore_ascii_case("html")) {
            return Err(LivePageError::Ending(shown()));
        }
        match std::fs::read_to_string(&path) {
            Ok(text) if !text.contains(GENERATOR) => return Err(LivePageError::Foreign(shown())),
            Err(error) if error.kind() == ErrorKind::InvalidData => return Err(LivePageError::Foreign(shown())),
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(LivePageError::System(shown(), error)),
            _ => {}
        }
        Ok(LivePageFile { path, written: String::new() })
    }

    /// Writes the page where it has changed. The file is complete at every instant: it takes the place of the one before by its name.
    ///
    /// # Errors
    /// What the system refuses: the page before is still there then.
    pub fn write(&mut self, page: &LivePage) -> Result<(), LivePageError> {
        let html = page.html()?;
        if html == self.written {
            return Ok(());
        }
        let name = self.path.file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned());
        let part = self.path.with_file_name(format!(".{name}.{}.part", std::process::id()));
        let done = std::fs::write(&part, &html).and_then(|()| std::fs::rename(&part, &self.path));
        if let Err(error) = done {
            // what is left of the attempt; there may be nothing
            let _ = std::fs::remove_file(&part);
            return Err(LivePageError::System(self.path.display().to_string(), error));
        }
        self.written = html;
        Ok(())
    }
}

/// FNV-1a, 64 bits: two pages differ where their sums do.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, b| (sum ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3))
}

fn scene_data(scene: &Scene, units: UnitSystem) -> String {
    let length = |value: f64| number(Dim::Length.from_si(value, units));
    let position = |at: &Position| list([at[0], at[1], at[2]].map(length));
    let path = |path: &Polyline| {
        let kind = match path.stroke {
            Stroke::Inactive => "inactive",
            Stroke::Straight => "straight",
            Stroke::Line | Stroke::Sling | Stroke::Pipe => "line",
            Stroke::Fender => "fender",
            Stroke::Unsolved => "unsolved",
            Stroke::Bottom => "bottom",
        };
        object([
            ("name", string(&path.name)),
            ("kind", string(kind)),
            ("points", list(path.points.iter().map(position))),
        ])
    };
    let bodies = scene.bodies.iter().map(|body| {
        let shapes = body.panels.iter().chain(Some(&body.points).filter(|points| !points.is_empty()));
        let shapes = shapes.map(|shape| list(shape.iter().map(position)));
        object([("name", string(&body.name)), ("origin", position(&body.origin)), ("shapes", list(shapes))])
    });
    let anchors = scene.marks.iter().filter(|mark| mark.sign == Sign::Anchor);
    object([
        ("paths", list(scene.paths.iter().map(path))),
        ("bodies", list(bodies)),
        ("anchors", list(anchors.map(|mark| position(&mark.at)))),
        ("surface", length(scene.surface)),
        ("bottom", scene.bottom.map_or("null".into(), length)),
    ])
}

fn table_data(table: &Table, units: UnitSystem) -> String {
    let head = |c: &Column| list([string(&c.group), string(&c.name), string(&c.dim.label(units))]);
    let text = |c: &Column, row: usize| {
        c.cells.get(row).map_or(String::new(), |cell| format::report(cell, c.dim, c.digits, units))
    };
    let shown = table.rows().min(MAX_ROWS);
    let row = |row: usize| list(table.columns().iter().map(|column| string(&text(column, row))));
    let fact = |fact: &Fact| {
        let value = format::report(&fact.value, fact.dim, fact.digits, units);
        list([string(&fact.name), string(format!("{value} {}", fact.dim.label(units)).trim())])
    };
    let mut notes: Vec<String> = table.notes.iter().map(|note| string(&note.to_string())).collect();
    if shown < table.rows() {
        notes.push(string(&format!("{} rows more are not shown", table.rows() - shown)));
    }
    object([
        ("title", string(&table.title)),
        ("facts", list(table.facts.iter().map(fact))),
        ("heads", list(table.columns().iter().map(head))),
        ("rows", list((0..shown).map(row))),
        ("notes", list(notes)),
    ])
}

/// Tensions at first ends and places of bodies over time.
fn curves(run: &Run, units: UnitSystem) -> Vec<String> {
    let history = &run.history;
    let every = history.len().div_ceil(MAX_INSTANTS).max(1);
    let rows = || history.rows().step_by(every);
    let times = doubles(rows().map(|row| row.first().copied().unwrap_or(f64::NAN)));
    let curve = |name: &str, what: &str, dim: Dim, values: Vec<f64>| {
        object([
            ("name", string(name)),
            ("what", string(&format!("{what} ({})", dim.label(units)))),
            ("x", times.clone()),
            ("y", doubles(values.into_iter().map(|value| dim.from_si(value, units)))),
        ])
    };
    let mut made = Vec::new();
    for (link, columns) in history.layout.links.iter().enumerate() {
        let values: Vec<f64> = rows().filter_map(|row| history.layout.tension(link, row)).collect();
        if values.len() == rows().count() {
            made.push(curve(&columns.name, "tension at the first end", Dim::Force, values));
        }
    }
    for (body, (name, _)) in history.layout.bodies.iter().enumerate() {
        let at = history.layout.body(body);
        for (axis, what) in ["X", "Y", "Z"].into_iter().enumerate() {
            let values = rows().map(|row| row.get(at + axis).copied().unwrap_or(f64::NAN)).collect();
            made.push(curve(name, what, Dim::Length, values));
        }
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;
    use windlass_base::table::Digits;

    #[test]
    fn names_on_the_page_are_data_and_a_change_has_another_version() {
        let names = ["</script><img src=x onerror=alert(1)>"];
        let table = |value: f64| {
            Table::new("Forces <b>").with_rows(&names).text("Name", |name| *name).column(
                "",
                "Force",
                Dim::Force,
                Digits::Usual,
                move |_| value,
            )
        };
        let html = |value: f64, state: &str, title: &str| {
            let tables = [table(value).build()];
            let page = LivePage { title, state, scene: None, tables: &tables, run: None, units: UnitSystem::SI };
            page.html().unwrap()
        };
        let page = html(1.0, "runs", "<i>job");
        assert!(!page.contains("<img") && !page.contains("<b>") && !page.contains("<i>"), "{page}");
        assert_eq!(page.matches("</script>").count(), page.matches("<script").count());
        assert!(!page.contains("http://") && !page.contains("https://"));
        let version = |page: &str| page.split("\"version\":\"").nth(1).unwrap()[..16].to_string();
        assert_eq!(version(&page), version(&html(1.0, "runs", "<i>job")));
        assert_ne!(version(&page), version(&html(2.0, "runs", "<i>job")));
        assert_ne!(version(&page), version(&html(1.0, "done", "<i>job")));
        assert_ne!(version(&page), version(&html(1.0, "runs", "<i>other job")));
    }

    #[test]
    fn page_is_written_whole_or_the_one_before_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("web/live.html");
        std::fs::create_dir(folder.path().join("web")).unwrap();
        let page = |state| LivePage { title: "job", state, scene: None, tables: &[], run: None, units: UnitSystem::SI };
        let mut file = LivePageFile::new(path.clone()).unwrap();
        file.write(&page("one")).unwrap();
        let before = std::fs::read_to_string(&path).unwrap();
        file.write(&page("two")).unwrap();
        assert_ne!(std::fs::read_to_string(&path).unwrap(), before);
        assert_eq!(std::fs::read_dir(folder.path().join("web")).unwrap().count(), 1);
        std::fs::remove_dir_all(folder.path().join("web")).unwrap();
        let error = file.write(&page("three")).unwrap_err().to_string();
        assert!(error.contains("live.html cannot be written"), "{error}");
    }
}
