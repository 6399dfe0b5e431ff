//! The rows of a CSV file of lines: which column gives what, the line each row begins at, and what is wrong with a row.

use csv::ByteRecord;
use std::borrow::Cow;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use windlass_base::diagnostic::nearest;
use windlass_catenary::{FlatBottom, LineError, Segment};
use windlass_language::source::LARGEST_FILE;
use windlass_language::spec::Range;

/// Longest row taken (bytes); a quote that is never closed ends here.
const LONGEST_ROW: usize = 1 << 20;
/// Headers listed in a message.
const MAX_LISTED_HEADERS: usize = 16;

/// Why a file of lines cannot be used at all.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// The system, or what the CSV reader refuses.
    #[error("{0}")]
    Unreadable(String),
    /// Nothing in it.
    #[error("it is empty: expected a header of column names and rows below it")]
    Empty,
    /// A needed column is not there.
    #[error("it has no column {name}")]
    NoColumn {
        /// The column.
        name: &'static str,
        /// The nearest headers, or all.
        help: String,
    },
    /// A column that is needed once stands twice.
    #[error("column {0} stands in it twice")]
    Twice(&'static str),
}

impl From<csv::Error> for InputError {
    fn from(error: csv::Error) -> Self {
        InputError::Unreadable(error.to_string())
    }
}

/// Why a row of the file has no solution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RowError {
    /// Cells without a header, or headers without a cell.
    #[error("it has {cells} cells under {heads} headers")]
    Width {
        /// Cells of the row.
        cells: usize,
        /// Headers of the file.
        heads: usize,
    },
    /// A cell that is needed and blank.
    #[error("{0} is missing")]
    Missing(&'static str),
    /// A cell that holds no finite number.
    #[error("{name} must be a finite number, this is `{text}`")]
    NotANumber {
        /// Its column.
        name: &'static str,
        /// What it holds.
        text: String,
    },
    /// A number out of range.
    #[error("{name} must be {wanted}, this is {value}")]
    OutOfRange {
        /// Its column.
        name: &'static str,
        /// Its range in words.
        wanted: &'static str,
        /// The number.
        value: f64,
    },
    /// The line cannot be solved.
    #[error("{0}")]
    Unsolved(#[from] LineError),
}

/// One line to be solved, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineCase {
    /// The line.
    pub segment: Segment,
    /// Horizontal distance of the fairlead from the anchor (m).
    pub x: f64,
    /// Elevation of the fairlead above the anchor (m).
    pub z: f64,
    /// The bottom; none for a suspended line.
    pub bottom: Option<FlatBottom>,
}

/// Where the data of a case stand in a row.
#[derive(Debug)]
struct Columns {
    id: usize,
    x: usize,
    z: usize,
    length: usize,
    ea: usize,
    weight: usize,
    friction: Option<usize>,
    suspended: Option<usize>,
}

const NEEDED: [&str; 6] = ["id", "x_m", "z_m", "length_m", "EA_N", "w_N_per_m"];
const FRICTION: &str = "friction";
const SUSPENDED: &str = "suspended";

impl Columns {
    fn from_heads(heads: &[String]) -> Result<Self, InputError> {
        let find = |name: &'static str| {
            let mut positions = (0..).zip(heads).filter(|(_, head)| head.eq_ignore_ascii_case(name)).map(|(at, _)| at);
            match (positions.next(), positions.next()) {
                (found, None) => Ok(found),
                _ => Err(InputError::Twice(name)),
            }
        };
        let needed = |name| find(name)?.ok_or_else(|| InputError::NoColumn { name, help: similar_heads(name, heads) });
        let [id, x, z, length, ea, weight] = NEEDED;
        Ok(Columns {
            id: needed(id)?,
            x: needed(x)?,
            z: needed(z)?,
            length: needed(length)?,
            ea: needed(ea)?,
            weight: needed(weight)?,
            friction: find(FRICTION)?,
            suspended: find(SUSPENDED)?,
        })
    }
}

/// What stands in a header instead of a column that is not there.
fn similar_heads(name: &str, heads: &[String]) -> String {
    let known = |head: &str| NEEDED.iter().chain(&[FRICTION, SUSPENDED]).any(|n| n.eq_ignore_ascii_case(head));
    let others = || heads.iter().map(String::as_str).filter(|head| !known(head));
    let all =
        |list: Vec<&str>| list.into_iter().map(|head| format!("`{}`", brief(head))).collect::<Vec<_>>().join(", ");
    match nearest(name, others()) {
        _ if heads.len() == 1 => format!(
            "columns are separated by commas, and {} holds none",
            all(heads.iter().map(String::as_str).collect())
        ),
        close if !close.is_empty() => format!("the nearest header is {}", all(close)),
        _ => format!("its headers are {}", all(heads.iter().map(String::as_str).take(MAX_LISTED_HEADERS).collect())),
    }
}

/// A file of lines being read.
pub struct Input {
    /// The column names, without the blanks around them.
    pub heads: Vec<String>,
    columns: Columns,
    reader: csv::Reader<ByLine>,
    record: ByteRecord,
}

impl std::fmt::Debug for Input {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Input").field("columns", &self.columns).finish_non_exhaustive()
    }
}

impl Input {
    /// Opens a file and reads its header.
    ///
    /// # Errors
    /// What the system refuses, a file that is empty or too large, a column that is missing or stands twice.
    pub fn open(file: File) -> Result<Self, InputError> {
        let system = |e: std::io::Error| InputError::Unreadable(e.to_string());
        if file.metadata().map_err(system)?.len() > LARGEST_FILE {
            return Err(InputError::Unreadable(format!("it has more than {LARGEST_FILE} bytes")));
        }
        let mut reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(ByLine::new(file));
        let mut record = ByteRecord::new();
        if !reader.read_byte_record(&mut record)? {
            return Err(InputError::Empty);
        }
        let heads: Vec<String> = record.iter().map(|cell| String::from_utf8_lossy(cell).trim().to_string()).collect();
        let columns = Columns::from_heads(&heads)?;
        Ok(Input { heads, columns, reader, record })
    }

    /// The next row; `None` behind the last.
    ///
    /// # Errors
    /// What the system or the CSV reader refuses.
    pub fn next_row(&mut self) -> Result<Option<InputRow<'_>>, InputError> {
        self.reader.get_mut().row = 0;
        if !self.reader.read_byte_record(&mut self.record)? {
            return Ok(None);
        }
        let inner = self.record.as_slice().iter().filter(|byte| **byte == b'\n').count() as u64;
        let line = self.reader.get_ref().lines.saturating_sub(inner);
        Ok(Some(InputRow { line, cells: &self.record, heads: self.heads.len(), columns: &self.columns }))
    }
}

/// One row of the file.
pub struct InputRow<'a> {
    /// The line of the file it begins at, from 1.
    pub line: u64,
    /// What it holds.
    pub cells: &'a ByteRecord,
    heads: usize,
    columns: &'a Columns,
}

impl InputRow<'_> {
    /// The line it describes.
    ///
    /// # Errors
    /// What is wrong with the row.
    pub fn case(&self) -> Result<LineCase, RowError> {
        let surplus = self.cells.iter().skip(self.heads).any(|cell| !cell.trim_ascii().is_empty());
        if self.cells.len() < self.heads || surplus {
            return Err(RowError::Width { cells: self.cells.len(), heads: self.heads });
        }
        let c = self.columns;
        let [_, x, z, length, ea, weight] = NEEDED;
        let segment = Segment {
            length: self.required_number(c.length, length, Range::Positive)?,
            weight: self.required_number(c.weight, weight, Range::Any)?,
            ea: self.required_number(c.ea, ea, Range::Positive)?,
        };
        let (x, z) = (self.required_number(c.x, x, Range::NotNegative)?, self.required_number(c.z, z, Range::Any)?);
        let optional = |at: Option<usize>, name, range| match at {
            Some(at) => self.number(at, name, range).map(|value| value.unwrap_or(0.0)),
            None => Ok(0.0),
        };
        let friction = optional(c.friction, FRICTION, Range::NotNegative)?;
        let suspended = optional(c.suspended, SUSPENDED, Range::Any)?;
        let bottom = match suspended {
            0.0 => Some(FlatBottom { friction }),
            1.0 => None,
            value => return Err(RowError::OutOfRange { name: SUSPENDED, wanted: "0 or 1", value }),
        };
        Ok(LineCase { segment, x, z, bottom })
    }

    /// What the row calls its line.
    pub fn id(&self) -> String {
        brief(&self.text(self.columns.id))
    }

    fn text(&self, at: usize) -> Cow<'_, str> {
        match String::from_utf8_lossy(self.cells.get(at).unwrap_or_default()) {
            Cow::Borrowed(text) => text.trim().into(),
            Cow::Owned(text) => text.trim().to_string().into(),
        }
    }

    fn required_number(&self, at: usize, name: &'static str, range: Range) -> Result<f64, RowError> {
        self.number(at, name, range)?.ok_or(RowError::Missing(name))
    }

    /// The number of a cell; `None` of a blank one.
    fn number(&self, at: usize, name: &'static str, range: Range) -> Result<Option<f64>, RowError> {
        let text = self.text(at);
        if text.is_empty() {
            return Ok(None);
        }
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
        let value = value.ok_or_else(|| RowError::NotANumber { name, text: brief(&text) })?;
        let wanted = match range {
            Range::Positive if value <= 0.0 => "greater than zero",
            Range::NotNegative if value < 0.0 => "zero or more",
            _ => return Ok(Some(value)),
        };
        Err(RowError::OutOfRange { name, wanted, value })
    }
}

/// A text short enough for a message, on one line.
fn brief(text: &str) -> String {
    const MAX_SHOWN_CHARS: usize = 24;
    let shown = text.chars().take(MAX_SHOWN_CHARS).map(|c| if c.is_control() { ' ' } else { c });
    let end = if text.chars().count() > MAX_SHOWN_CHARS { " .." } else { "" };
    shown.chain(end.chars()).collect()
}

/// The bytes of a file, handed out a line at a time, so that it is known at which line a row has ended.
struct ByLine {
    file: BufReader<File>,
    /// Lines handed out, the last perhaps in part.
    lines: u64,
    within: bool,
    /// Bytes handed out for the present row.
    row: usize,
}

impl ByLine {
    fn new(file: File) -> Self {
        ByLine { file: BufReader::with_capacity(1 << 16, file), lines: 0, within: false, row: 0 }
    }
}

impl Read for ByLine {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        let have = self.file.fill_buf()?;
        let line = have.iter().position(|byte| *byte == b'\n').map_or(have, |end| have.split_at(end + 1).0);
        let taken = line.take(into.len() as u64).read(into)?;
        if taken > 0 {
            self.lines += u64::from(!self.within);
            self.within = taken < line.len() || !line.ends_with(b"\n");
        }
        self.file.consume(taken);
        self.row += taken;
        if self.row > LONGEST_ROW {
            let text = format!("the row that ends after line {} has more than {LONGEST_ROW} bytes", self.lines);
            return Err(std::io::Error::other(format!("{text}; is a quote not closed?")));
        }
        Ok(taken)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "id,x_m,z_m,length_m,EA_N,w_N_per_m";

    fn open(bytes: &[u8]) -> Result<Input, InputError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("in.csv");
        std::fs::write(&path, bytes).unwrap();
        Input::open(File::open(path).unwrap())
    }

    /// Line and id of each row.
    fn rows(bytes: &[u8]) -> Vec<(u64, String)> {
        let mut input = open(bytes).unwrap();
        let mut rows = Vec::new();
        while let Some(row) = input.next_row().unwrap() {
            rows.push((row.line, row.id()));
        }
        rows
    }

    fn case(text: &str) -> Result<LineCase, RowError> {
        open(text.as_bytes()).unwrap().next_row().unwrap().unwrap().case()
    }

    #[test]
    fn row_has_its_first_line_number_with_any_line_ending() {
        let text = format!("{HEAD}\na,1\n\n\"b\nb\",2\n\nc\nd,\"x\n\n\"\ne");
        let want: Vec<(u64, String)> =
            [(2, "a"), (4, "b b"), (7, "c"), (8, "d"), (11, "e")].map(|(l, t)| (l, t.to_string())).to_vec();
        assert_eq!(rows(text.as_bytes()), want);
        let crlf = rows(text.replace('\n', "\r\n").as_bytes());
        assert_eq!(crlf.iter().map(|r| r.0).collect::<Vec<_>>(), [2, 4, 7, 8, 11]);
        let mixed = format!("\u{feff}{HEAD}\r\na\n\r\nb\r\nc\n");
        assert_eq!(rows(mixed.as_bytes()).iter().map(|r| r.0).collect::<Vec<_>>(), [2, 4, 5]);
        // rows longer than the buffers of the reader
        let long = "z".repeat(200_000);
        let text = format!("{HEAD}\na,{long}\nb,\"{long}\n{long}\"\nc\n");
        assert_eq!(rows(text.as_bytes()).iter().map(|r| r.0).collect::<Vec<_>>(), [2, 3, 5]);
    }

    #[test]
    fn headers_match_in_any_order_case_quotes_and_with_bom() {
        let text = "\u{feff} w_n_per_m ,\"length_m\",ID, Z_M,x_m ,ea_n\r\n 5 ,\" 7\",q,3,4,1e6\r\n";
        let want = LineCase {
            segment: Segment { length: 7.0, weight: 5.0, ea: 1e6 },
            x: 4.0,
            z: 3.0,
            bottom: Some(FlatBottom { friction: 0.0 }),
        };
        assert_eq!(case(text), Ok(want));
    }

    #[test]
    fn absent_or_blank_friction_and_suspended_are_zero() {
        let with = |friction: &str, suspended: &str| {
            case(&format!("{HEAD},friction,suspended\n1,4,3,7,1e6,5,{friction},{suspended}\n")).map(|c| c.bottom)
        };
        assert_eq!(with("", " "), Ok(Some(FlatBottom { friction: 0.0 })));
        assert_eq!(with("0.5", "0"), Ok(Some(FlatBottom { friction: 0.5 })));
        assert_eq!(with("0.5", "1.0"), Ok(None));
        let refused = |friction, suspended| with(friction, suspended).unwrap_err().to_string();
        assert_eq!(refused("0.5", "2"), "suspended must be 0 or 1, this is 2");
        assert_eq!(refused("-1", "0"), "friction must be zero or more, this is -1");
    }

    #[test]
    fn each_kind_of_bad_cell_is_reported_by_its_column() {
        for (row, want) in [
            ("1,4,3,7,1e6", "it has 5 cells under 6 headers"),
            ("1,4,3,7,1e6,5,6", "it has 7 cells under 6 headers"),
            ("1,,3,7,1e6,5", "x_m is missing"),
            ("1,4,3,-7,1e6,5", "length_m must be greater than zero, this is -7"),
            ("1,4,3,7,0,5", "EA_N must be greater than zero, this is 0"),
            ("1,-4,3,7,1e6,5", "x_m must be zero or more, this is -4"),
            ("1,4,3,7,1e6,inf", "w_N_per_m must be a finite number, this is `inf`"),
            ("1,4,\"3,5\",7,1e6,5", "z_m must be a finite number, this is `3,5`"),
            ("1,4,\"a\nb\u{1b}[31m and much more text than that\",7,1e6,5", "`a b [31m and much more t ..`"),
        ] {
            let found = case(&format!("{HEAD}\n{row}\n")).unwrap_err();
            assert!(found.to_string().ends_with(want), "{row}: {found}");
        }
        assert!(case(&format!("{HEAD}\n1,4,3,7,1e6,5,, \n")).is_ok(), "blank cells behind the last header");
    }

    #[test]
    fn missing_header_is_named_with_nearest_match() {
        let of = |head: &str| match open(head.as_bytes()) {
            Err(InputError::NoColumn { name, help }) => format!("{name}: {help}"),
            other => format!("{other:?}"),
        };
        assert_eq!(of("id,x_m,z_m,lenght_m,EA_N,w_N_per_m\n"), "length_m: the nearest header is `lenght_m`");
        assert_eq!(of("id;x_m;z_m\n"), "id: columns are separated by commas, and `id;x_m;z_m` holds none");
        assert_eq!(of("id,X,z_m\n"), "x_m: its headers are `id`, `X`, `z_m`");
        assert!(matches!(open(b"id,x_m,X_M,z_m,length_m,EA_N,w_N_per_m"), Err(InputError::Twice("x_m"))));
        for nothing in [&b""[..], b"\n\r\n", b"\xef\xbb\xbf"] {
            assert!(matches!(open(nothing), Err(InputError::Empty)), "{nothing:?}");
        }
    }

    #[test]
    fn unclosed_quote_ends_at_row_length_limit() {
        let mut input = open(format!("{HEAD}\n\"{}", "a,b\n".repeat(1 << 20)).as_bytes()).unwrap();
        let error = input.next_row().map(|_| ()).unwrap_err().to_string();
        assert!(error.contains("more than 1048576 bytes; is a quote not closed?"), "{error}");
        assert!(input.next_row().is_ok_and(|row| row.is_none()), "nothing is read behind it");
        assert!(open(&vec![b'x'; 2 << 20]).is_err());
    }
}
