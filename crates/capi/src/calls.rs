//! The exported functions: pointers become slices, strings and handles, and the types of this crate and the engines do the rest.
//!
//! Every function takes null for any pointer: it is then refused, or does nothing. What else a caller must keep is in the header, and stands
//! below as the reason of each unsafe block: a handle is one that was made here and not freed; a text ends in NUL; an array has as many
//! numbers as are said; a handle is used by one thread at a time.

#![allow(unsafe_code, reason = "the boundary to C")]
#![deny(clippy::undocumented_unsafe_blocks)]
#![allow(clippy::missing_safety_doc, reason = "the header says what callers keep")]

use crate::session::{CSession, CTable, c_text};
use nalgebra::Vector3;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};
use windlass::hosted::{LineWater, internal_error, keep_panics_quiet};
use windlass_catenary::{FlatBottom, Segment};
use windlass_line_dynamics::{
    CoupledLine, CoupledLines, PlaneBottom, Rod, RodSegment, SeabedLaw, Surroundings, UniformFluid,
};

/// All is done.
const DONE: c_int = 0;
/// A record, a line or a step was refused.
const REFUSED: c_int = 1;
/// A null pointer, an index out of range, a text that is not UTF-8.
const WRONG_CALL: c_int = 2;
/// A defect of windlass.
const INTERNAL: c_int = 3;

thread_local! {
    /// Why the last call of this thread did not do what it was asked.
    static LAST_ERROR: RefCell<CString> = RefCell::default();
}

fn keep_error(text: &str) {
    LAST_ERROR.with(|last| *last.borrow_mut() = c_text(text));
}

fn refuse<T>(text: &str) -> Option<T> {
    keep_error(text);
    None
}

/// The value of a call, or what stands for a failed one.
fn guarded<T>(failed: T, call: impl FnOnce() -> T) -> T {
    keep_panics_quiet();
    catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|_| {
        keep_error(&internal_error());
        failed
    })
}

/// A text of the caller.
///
/// # Safety
/// Null, or a text that ends in NUL and stays as it is during the call.
unsafe fn text<'a>(given: *const c_char, name: &str) -> Option<&'a str> {
    if given.is_null() {
        return refuse(&format!("{name} is null"));
    }
    // SAFETY: not null, and a text that ends in NUL by the contract of this function
    let bytes = unsafe { CStr::from_ptr(given) };
    bytes.to_str().ok().or_else(|| refuse(&format!("{name} is not UTF-8")))
}

/// Numbers of the caller.
///
/// # Safety
/// Null, or an array of `count` numbers that stays as it is during the call.
unsafe fn numbers<'a>(given: *const f64, count: usize, name: &str) -> Option<&'a [f64]> {
    if given.is_null() {
        return if count == 0 { Some(&[]) } else { refuse(&format!("{name} is null")) };
    }
    if count > isize::MAX as usize / size_of::<f64>() {
        return refuse(&format!("{name} cannot have {count} numbers"));
    }
    // SAFETY: not null, of a possible size, and `count` numbers by the contract of this function
    Some(unsafe { std::slice::from_raw_parts(given, count) })
}

/// Room for numbers of the caller, apart from its inputs. It is written and never read: it need not be initialised.
#[derive(Clone, Copy)]
struct Room {
    start: *mut f64,
    count: usize,
}

impl Room {
    /// Room that is there, or none where the caller does not want the numbers.
    fn wanted(start: *mut f64, count: usize) -> Option<Room> {
        (!start.is_null()).then_some(Room { start, count })
    }

    /// Writes numbers, as many as there is room for.
    ///
    /// # Safety
    /// There is room for `count` numbers.
    unsafe fn write_all(self, values: impl IntoIterator<Item = f64>) {
        for (at, value) in values.into_iter().take(self.count).enumerate() {
            // SAFETY: `at` is below `count`, for which there is room by the contract of this function
            unsafe { self.start.add(at).write(value) };
        }
    }
}

/// What a handle stands for.
///
/// # Safety
/// Null, or a handle of this type that was made here, is not freed, and that no other call uses meanwhile.
unsafe fn handle<'a, T>(given: *mut T) -> Option<&'a mut T> {
    // SAFETY: null gives none; else the handle is valid and used by this call alone, by the contract of this function
    unsafe { given.as_mut() }.or_else(|| refuse("the handle is null"))
}

/// The same, to be read.
///
/// # Safety
/// As [`handle`], but other calls that read may use it meanwhile.
unsafe fn shared<'a, T>(given: *const T) -> Option<&'a T> {
    // SAFETY: null gives none; else the handle is valid and nothing writes to it, by the contract of this function
    unsafe { given.as_ref() }.or_else(|| refuse("the handle is null"))
}

/// Gives back the memory of a handle.
///
/// # Safety
/// Null, or a handle of this type that was made here by `Box::into_raw`, and is not used again.
unsafe fn free<T>(given: *mut T) {
    if !given.is_null() {
        // SAFETY: a handle that `Box::into_raw` made and nobody uses again, by the contract of this function
        let held = unsafe { Box::from_raw(given) };
        guarded((), || drop(held));
    }
}

/// The version, as `0.2.0`.
#[unsafe(no_mangle)]
pub extern "C" fn windlass_version() -> *const c_char {
    const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
        Ok(version) => version,
        Err(_) => c"",
    };
    VERSION.as_ptr()
}

/// Why the last call of this thread did not do what it was asked; empty before the first.
#[unsafe(no_mangle)]
pub extern "C" fn windlass_last_error() -> *const c_char {
    LAST_ERROR.with(|last| last.borrow().as_ptr())
}

/// A new session of a root.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_session_new(root: *const c_char) -> *mut CSession {
    // SAFETY: a text by the header
    let Some(root) = (unsafe { text(root, "root") }) else { return std::ptr::null_mut() };
    guarded(std::ptr::null_mut(), || Box::into_raw(Box::new(CSession::new(root))))
}

/// Frees a session.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_session_free(session: *mut CSession) {
    // SAFETY: a session that is not used again, by the header
    unsafe { free(session) }
}

/// Runs records.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_session_run(session: *mut CSession, records: *const c_char) -> c_int {
    // SAFETY: a session of this thread and a text, by the header
    let (Some(session), Some(records)) = (unsafe { (handle(session), text(records, "records")) }) else {
        return WRONG_CALL;
    };
    guarded(INTERNAL, || judged(session, |session| session.run(records)))
}

/// Runs a script or a deck.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_session_run_file(session: *mut CSession, path: *const c_char) -> c_int {
    // SAFETY: a session of this thread and a text, by the header
    let (Some(session), Some(path)) = (unsafe { (handle(session), text(path, "path")) }) else {
        return WRONG_CALL;
    };
    guarded(INTERNAL, || judged(session, |session| session.run_file(path)))
}

fn judged(session: &mut CSession, run: impl FnOnce(&mut CSession) -> bool) -> c_int {
    if run(session) {
        return DONE;
    }
    keep_error(&session.error().to_string_lossy());
    REFUSED
}

/// A text of a session, empty of a null handle.
///
/// # Safety
/// As [`shared`].
unsafe fn said(session: *const CSession, of: fn(&CSession) -> &CStr) -> *const c_char {
    // SAFETY: by the contract of this function
    unsafe { shared(session) }.map_or(c"".as_ptr(), |session| of(session).as_ptr())
}

/// What the last call printed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_session_text(session: *const CSession) -> *const c_char {
    // SAFETY: a session that nothing writes to, by the header
    unsafe { said(session, CSession::text) }
}

/// The error of the last call, as it is printed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_session_error(session: *const CSession) -> *const c_char {
    // SAFETY: a session that nothing writes to, by the header
    unsafe { said(session, CSession::error) }
}

/// Warnings and notes of the last call, as they are printed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_session_warnings(session: *const CSession) -> *const c_char {
    // SAFETY: a session that nothing writes to, by the header
    unsafe { said(session, CSession::warnings) }
}

/// Line of the error of the last call; 0 without one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_session_error_line(session: *const CSession) -> usize {
    // SAFETY: a session that nothing writes to, by the header
    unsafe { shared(session) }.and_then(CSession::error_place).map_or(0, |(line, _)| line)
}

/// Column of the error of the last call; 0 without one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_session_error_column(session: *const CSession) -> usize {
    // SAFETY: a session that nothing writes to, by the header
    unsafe { shared(session) }.and_then(CSession::error_place).map_or(0, |(_, column)| column)
}

/// How many tables the last call showed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_session_tables(session: *const CSession) -> usize {
    // SAFETY: a session that nothing writes to, by the header
    unsafe { shared(session) }.map_or(0, |session| session.tables().len())
}

/// A table of the last call.
///
/// # Safety
/// As [`shared`].
unsafe fn table<'a>(session: *const CSession, table: usize) -> Option<&'a CTable> {
    // SAFETY: by the contract of this function
    let session = unsafe { shared(session) }?;
    session.tables().get(table).or_else(|| refuse(&format!("there is no table {table}")))
}

/// Title of a table; null of one that is not there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_table_title(session: *const CSession, at: usize) -> *const c_char {
    // SAFETY: a session that nothing writes to, by the header
    unsafe { table(session, at) }.map_or(std::ptr::null(), |table| table.title.as_ptr())
}

/// Rows of a table.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_table_rows(session: *const CSession, at: usize) -> usize {
    // SAFETY: a session that nothing writes to, by the header
    unsafe { table(session, at) }.map_or(0, |table| table.rows)
}

/// Columns of a table.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_table_columns(session: *const CSession, at: usize) -> usize {
    // SAFETY: a session that nothing writes to, by the header
    unsafe { table(session, at) }.map_or(0, |table| table.columns.len())
}

/// Name of a column, with its unit; null of one that is not there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_table_name(session: *const CSession, at: usize, column: usize) -> *const c_char {
    // SAFETY: a session that nothing writes to, by the header
    let found = unsafe { table(session, at) }.and_then(|table| table.columns.get(column));
    found.map_or(std::ptr::null(), |column| column.name.as_ptr())
}

/// Unit of a column, empty of plain numbers and text; null of one that is not there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_table_unit(session: *const CSession, at: usize, column: usize) -> *const c_char {
    // SAFETY: a session that nothing writes to, by the header
    let found = unsafe { table(session, at) }.and_then(|table| table.columns.get(column));
    found.map_or(std::ptr::null(), |column| column.unit.as_ptr())
}

/// Numbers of a column, NaN where there is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_table_numbers(
    session: *const CSession,
    at: usize,
    column: usize,
    values: *mut f64,
    count: usize,
) -> c_int {
    // SAFETY: a session that nothing writes to, by the header
    let Some(found) = (unsafe { table(session, at) }) else { return WRONG_CALL };
    let Some(column) = found.columns.get(column) else {
        keep_error(&format!("table {at} has no column {column}"));
        return WRONG_CALL;
    };
    let Some(room) = Room::wanted(values, count).filter(|_| count >= found.rows) else {
        keep_error(&format!("there is no room for {} rows", found.rows));
        return WRONG_CALL;
    };
    // SAFETY: room for `count` numbers, by the header
    unsafe { room.write_all(column.numbers.iter().copied()) };
    DONE
}

/// Text of a cell of a column of text; null of any other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_table_text(
    session: *const CSession,
    at: usize,
    column: usize,
    row: usize,
) -> *const c_char {
    // SAFETY: a session that nothing writes to, by the header
    let found = unsafe { table(session, at) }.and_then(|table| table.columns.get(column)?.texts.as_ref()?.get(row));
    found.map_or(std::ptr::null(), |text| text.as_ptr())
}

/// Forces of single lines.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_catenary_solve(
    count: usize,
    x: *const f64,
    z: *const f64,
    length: *const f64,
    ea: *const f64,
    w: *const f64,
    friction: *const f64,
    seabed: c_int,
    h: *mut f64,
    v: *mut f64,
    anchor_h: *mut f64,
    anchor_v: *mut f64,
    grounded: *mut f64,
    failed: *mut usize,
) -> c_int {
    // SAFETY: arrays of `count` numbers, by the header
    let inputs = unsafe {
        [(x, "x"), (z, "z"), (length, "length"), (ea, "ea"), (w, "w")].map(|(at, name)| numbers(at, count, name))
    };
    let [Some(x), Some(z), Some(length), Some(ea), Some(w)] = inputs else { return WRONG_CALL };
    // SAFETY: null, or an array of `count` numbers, by the header
    let friction = if friction.is_null() { None } else { unsafe { numbers(friction, count, "friction") } };
    let mut missed = 0;
    let ended = guarded(INTERNAL, || {
        let lines = x.iter().zip(z).zip(length).zip(ea).zip(w).enumerate();
        for (at, ((((x, z), length), ea), w)) in lines {
            let segment = Segment { length: *length, weight: *w, ea: *ea };
            let friction = friction.and_then(|all| all.get(at)).copied().unwrap_or(0.0);
            let bottom = (seabed != 0).then_some(FlatBottom { friction });
            let found = match segment.solve_end_forces(*x, *z, bottom) {
                Ok(f) => [f.fairlead[0], f.fairlead[1], f.anchor[0], f.anchor[1], f.grounded],
                Err(error) => {
                    missed += 1;
                    if missed == 1 {
                        keep_error(&format!("line {at}: {error}"));
                    }
                    [f64::NAN; 5]
                }
            };
            for (value, start) in found.into_iter().zip([h, v, anchor_h, anchor_v, grounded]) {
                if !start.is_null() {
                    // SAFETY: room for `count` numbers by the header, and `at` is below `count`
                    unsafe { start.add(at).write(value) };
                }
            }
        }
        if missed == 0 { DONE } else { REFUSED }
    });
    if !failed.is_null() {
        // SAFETY: room for one number, by the header
        unsafe { failed.write(missed) };
    }
    ended
}

/// A dynamic line: see the header.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct WindlassLine {
    length: f64,
    mass: f64,
    ea: f64,
    axial_damping: f64,
    ei: f64,
    diameter: f64,
    cd_normal: f64,
    cd_axial: f64,
    ca_normal: f64,
    ca_axial: f64,
    elements: usize,
    anchor: [f64; 3],
    fairlead: [f64; 3],
}

/// What surrounds dynamic lines: see the header.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct WindlassSurroundings {
    density: f64,
    gravity: f64,
    current: [f64; 3],
    depth: f64,
    seabed_stiffness: f64,
    seabed_damping: f64,
    friction: f64,
    longest_step: f64,
    environment: *const c_char,
}

impl WindlassLine {
    fn build(&self, number: usize) -> Result<CoupledLine, String> {
        if self.anchor.iter().chain(&self.fairlead).any(|c| !c.is_finite()) {
            return Err(format!("line {number}: an end is not finite"));
        }
        let segment = RodSegment {
            axial_damping: self.axial_damping,
            bending: self.ei,
            drag_normal: self.cd_normal,
            drag_tangential: self.cd_axial,
            added_normal: self.ca_normal,
            added_tangential: self.ca_axial,
            ..RodSegment::line(self.length, self.elements, self.mass, self.ea, self.diameter)
        };
        let rod = Rod::new(&format!("line {number}"), vec![segment], Vec::new()).map_err(|error| error.to_string())?;
        Ok(CoupledLine { rod, anchor: self.anchor.into(), fairlead: self.fairlead.into() })
    }
}

impl WindlassSurroundings {
    fn build(&self, environment: Option<&str>) -> Result<Surroundings, String> {
        for (name, value) in [
            ("density", self.density),
            ("gravity", self.gravity),
            ("seabed_stiffness", self.seabed_stiffness),
            ("seabed_damping", self.seabed_damping),
            ("friction", self.friction),
        ] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(format!("{name} is {value}: it is zero or more"));
            }
        }
        if self.current.iter().any(|c| !c.is_finite()) || self.depth.is_infinite() {
            return Err("the current or the depth is not finite".into());
        }
        let law = SeabedLaw {
            damping: self.seabed_damping,
            friction_along: self.friction,
            friction_across: self.friction,
            ..SeabedLaw::elastic(self.seabed_stiffness)
        };
        let depth = Some(self.depth).filter(|depth| !depth.is_nan());
        let water = LineWater { depth, density: self.density, gravity: self.gravity };
        let ambient = environment.map(|options| water.ambient(options)).transpose();
        let ambient = ambient.map_err(|error| error.rendered.trim_end().to_owned())?;
        Ok(Surroundings {
            ambient,
            water: UniformFluid::moving(self.density, self.current.into()),
            bottom: (!self.depth.is_nan()).then_some((PlaneBottom { height: -self.depth, slope: [0.0; 2] }, law)),
            gravity: self.gravity,
        })
    }
}

/// Lines at rest.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_dynamics_new(
    lines: *const WindlassLine,
    count: usize,
    around: *const WindlassSurroundings,
) -> *mut CoupledLines {
    let none = std::ptr::null_mut();
    if lines.is_null() || count == 0 || count > isize::MAX as usize / size_of::<WindlassLine>() {
        keep_error("there are no lines");
        return none;
    }
    // SAFETY: not null, of a possible size, and `count` lines by the header
    let lines = unsafe { std::slice::from_raw_parts(lines, count) };
    // SAFETY: null, or surroundings by the header
    let Some(around) = (unsafe { around.as_ref() }) else {
        keep_error("the surroundings are null");
        return none;
    };
    // SAFETY: null, or a text that ends in NUL, by the header
    let environment =
        Some(around.environment).filter(|text| !text.is_null()).map(|given| unsafe { text(given, "environment") });
    let environment = match environment {
        Some(None) => return none,
        Some(given) => given,
        None => None,
    };
    guarded(none, || {
        let made = || -> Result<CoupledLines, String> {
            let built: Result<Vec<CoupledLine>, String> =
                lines.iter().enumerate().map(|(at, line)| line.build(at + 1)).collect();
            CoupledLines::new(built?, around.build(environment)?, around.longest_step)
                .map_err(|error| error.to_string())
        };
        match made() {
            Ok(lines) => Box::into_raw(Box::new(lines)),
            Err(error) => {
                keep_error(&error);
                none
            }
        }
    })
}

/// Frees lines.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_dynamics_free(lines: *mut CoupledLines) {
    // SAFETY: lines that are not used again, by the header
    unsafe { free(lines) }
}

fn vectors(list: &[f64]) -> Vec<Vector3<f64>> {
    list.chunks_exact(3).map(Vector3::from_column_slice).collect()
}

/// Takes lines to a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_dynamics_step(
    lines: *mut CoupledLines,
    t: f64,
    x: *const f64,
    v: *const f64,
    force: *mut f64,
) -> c_int {
    // SAFETY: lines of this thread, by the header
    let Some(lines) = (unsafe { handle(lines) }) else { return WRONG_CALL };
    let count = 3 * lines.len();
    // SAFETY: three numbers a line, by the header
    let (Some(x), Some(v)) = (unsafe { (numbers(x, count, "x"), numbers(v, count, "v")) }) else {
        return WRONG_CALL;
    };
    let (x, v) = (vectors(x), vectors(v));
    let ended = guarded(INTERNAL, || match lines.step(t, &x, &v) {
        Ok(()) => DONE,
        Err(error) => {
            keep_error(&error.to_string());
            REFUSED
        }
    });
    if ended == DONE
        && let Some(room) = Room::wanted(force, count)
    {
        let forces = lines.fairlead_forces();
        // SAFETY: room for three numbers a line, by the header
        unsafe { room.write_all(forces.iter().flat_map(|force| [force.x, force.y, force.z])) };
    }
    ended
}

/// Forces on the anchors.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn windlass_dynamics_anchor_forces(lines: *const CoupledLines, force: *mut f64) -> c_int {
    // SAFETY: lines that nothing writes to, by the header
    let Some(lines) = (unsafe { shared(lines) }) else { return WRONG_CALL };
    let Some(room) = Room::wanted(force, 3 * lines.len()) else {
        keep_error("force is null");
        return WRONG_CALL;
    };
    let forces = lines.anchor_forces();
    // SAFETY: room for three numbers a line, by the header
    unsafe { room.write_all(forces.iter().flat_map(|force| [force.x, force.y, force.z])) };
    DONE
}
