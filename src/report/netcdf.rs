//! Tables as NetCDF-3: a variable for each column over the dimension `row`, with the name that it has in a CSV file, its unit and its name in full.
//!
//! Source: The NetCDF Classic Format (Unidata); attributes as the CF Conventions 1.11, sections 2.5 and 3.1. Text is an array of
//! characters. Whole numbers are 32 bits wide, and doubles where that does not hold them.

use super::stored::{ColumnValues, SOURCE, StoreError, stored_columns};
use netcdf3::{DataSet, FileWriter, Version};
use std::cell::RefCell;
use std::io::{Cursor, Seek, SeekFrom, Write};
use std::rc::Rc;
use windlass_base::table::Table;
use windlass_base::units::UnitSystem;

/// The dimension of rows.
const ROW: &str = "row";
/// Stands for a whole number that is missing: `NC_FILL_INT`.
const NO_WHOLE: i32 = -2_147_483_647;
/// Stands for a number that is missing: `NC_FILL_DOUBLE`. (The library finds no variable again that has an attribute which is no number.)
const NO_NUMBER: f64 = 9.969_209_968_386_869e36;
/// Files beyond this have the form with offsets of 64 bits (bytes).
const MAX_CLASSIC_BYTES: usize = 1 << 30;
/// Longest name of a variable (bytes).
const MAX_NAME_BYTES: usize = 120;

/// A file in memory that is still at hand when its writer is gone.
#[derive(Clone, Debug, Default)]
pub(super) struct Shared(Rc<RefCell<Cursor<Vec<u8>>>>);

impl Shared {
    /// The bytes of the file.
    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.0.take().into_inner()
    }
}

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl Seek for Shared {
    fn seek(&mut self, to: SeekFrom) -> std::io::Result<u64> {
        self.0.borrow_mut().seek(to)
    }
}

/// What a variable holds.
enum Data {
    Doubles(Vec<f64>),
    Wholes(Vec<i32>),
    /// Characters, rows of a width.
    Letters(Vec<u8>, usize),
}

/// The bytes of the file.
///
/// # Errors
/// Columns that the format cannot hold, and what the writer refuses.
pub fn bytes(table: &Table, units: UnitSystem) -> Result<Vec<u8>, StoreError> {
    let columns = stored_columns(table, units)?;
    let names = names(columns.iter().map(|c| c.head.as_str()));
    let mut set = DataSet::new();
    set.add_fixed_dim(ROW, table.rows()).map_err(to_store_error)?;
    set.add_global_attr_string("title", &table.title).map_err(to_store_error)?;
    set.add_global_attr_string("source", SOURCE).map_err(to_store_error)?;
    set.add_global_attr_string("Conventions", "CF-1.11").map_err(to_store_error)?;
    let mut all = Vec::new();
    for (column, name) in columns.into_iter().zip(names) {
        let data = data(column.values);
        match &data {
            Data::Doubles(_) => {
                set.add_var_f64(&name, &[ROW]).map_err(to_store_error)?;
                set.add_var_attr_f64(&name, "_FillValue", vec![NO_NUMBER]).map_err(to_store_error)?;
            }
            Data::Wholes(_) => {
                set.add_var_i32(&name, &[ROW]).map_err(to_store_error)?;
                set.add_var_attr_i32(&name, "_FillValue", vec![NO_WHOLE]).map_err(to_store_error)?;
            }
            Data::Letters(_, width) => {
                let long = format!("{name}_length");
                set.add_fixed_dim(&long, *width).map_err(to_store_error)?;
                set.add_var_u8(&name, &[ROW, &long]).map_err(to_store_error)?;
            }
        }
        if !matches!(data, Data::Letters(..)) {
            // plain numbers have the unit 1
            let unit = if column.unit.is_empty() { "1" } else { &column.unit };
            set.add_var_attr_string(&name, "units", unit).map_err(to_store_error)?;
        }
        set.add_var_attr_string(&name, "long_name", &column.long_name).map_err(to_store_error)?;
        all.push((name, data));
    }
    let size: usize = all
        .iter()
        .map(|(_, d)| match d {
            Data::Doubles(list) => 8 * list.len(),
            Data::Wholes(list) => 4 * list.len(),
            Data::Letters(list, _) => list.len(),
        })
        .sum();
    let version = if size > MAX_CLASSIC_BYTES { Version::Offset64Bit } else { Version::Classic };
    let shared = Shared::default();
    let mut writer = FileWriter::open_seek_write("", Box::new(shared.clone())).map_err(to_store_error)?;
    writer.set_def(&set, version, 0).map_err(to_store_error)?;
    for (name, data) in &all {
        match data {
            Data::Doubles(list) => writer.write_var_f64(name, list),
            Data::Wholes(list) => writer.write_var_i32(name, list),
            Data::Letters(list, _) => writer.write_var_u8(name, list),
        }
        .map_err(to_store_error)?;
    }
    writer.close().map_err(to_store_error)?;
    Ok(shared.into_bytes())
}

pub(super) fn to_store_error(error: impl std::fmt::Debug) -> StoreError {
    StoreError::Library(format!("{error:?}"))
}

fn data(values: ColumnValues) -> Data {
    match values {
        ColumnValues::Numbers(list) => Data::Doubles(list.into_iter().map(|v| v.unwrap_or(NO_NUMBER)).collect()),
        ColumnValues::Wholes(list) => {
            let narrow = |v: &Option<i64>| match v {
                Some(v) => i32::try_from(*v).ok().filter(|v| *v != NO_WHOLE),
                None => Some(NO_WHOLE),
            };
            match list.iter().map(narrow).collect() {
                Some(narrowed) => Data::Wholes(narrowed),
                None => Data::Doubles(list.into_iter().map(|v| v.map_or(NO_NUMBER, |v| v as f64)).collect()),
            }
        }
        ColumnValues::Texts(list) => {
            let width = list.iter().flatten().map(String::len).max().unwrap_or(0).max(1);
            let mut letters = Vec::with_capacity(width * list.len());
            for (row, text) in list.iter().enumerate() {
                letters.extend(text.iter().flat_map(|t| t.bytes()));
                letters.resize((row + 1) * width, 0);
            }
            Data::Letters(letters, width)
        }
    }
}

/// The heads of columns as names of variables: what the format does not take becomes an underscore. No two are alike.
fn names<'a>(wanted: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut made: Vec<String> = Vec::new();
    for (number, name) in wanted.enumerate() {
        let taken = |c: char| c != '/' && !c.is_control();
        let mut plain: String = name.chars().map(|c| if taken(c) { c } else { '_' }).collect();
        let whole = |length: &usize| plain.is_char_boundary(*length);
        plain.truncate((0..=MAX_NAME_BYTES.min(plain.len())).rev().find(whole).unwrap_or(0));
        plain.truncate(plain.trim_end().len());
        if plain.chars().next().is_none_or(|c| c.is_ascii() && !(c.is_ascii_alphanumeric() || c == '_')) {
            plain.insert(0, '_');
        }
        while made.contains(&plain) {
            plain = format!("{plain}_{}", number + 1);
        }
        made.push(plain);
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;
    use netcdf3::FileReader;
    use windlass_base::table::Digits;
    use windlass_base::units::Dim;

    #[test]
    fn netcdf_values_units_names_and_text_read_back_bit_for_bit() {
        let tops = [1.0 / 3.0, -1e300, 5e-324];
        let rows = [(0i64, tops[0], "A"), (1, tops[1], "BOW"), (2, tops[2], "")];
        let t = Table::new("A run")
            .with_rows(&rows)
            .column("", "Time", Dim::Time, Digits::Usual, |(n, ..)| (*n != 2).then_some(0.1 * *n as f64))
            .column("Tension", "Ten Top", Dim::Force, Digits::Usual, |(_, top, _)| *top)
            .column("", "Crit. Seg", Dim::None, Digits::Usual, |(n, ..)| (*n != 1).then_some(*n))
            .text("Name", |(.., name)| *name)
            .column("", "2 wide", Dim::None, Digits::Usual, |(n, ..)| *n << 40)
            .build();
        let file = bytes(&t, UnitSystem::SI).unwrap();
        let mut reader = FileReader::open_seek_read("", Box::new(Cursor::new(file))).unwrap();
        {
            let set = reader.data_set();
            assert_eq!(set.get_global_attr_as_string("title").unwrap(), "A run");
            assert_eq!(set.get_global_attr_as_string("source").unwrap(), SOURCE);
            assert_eq!(set.dim_size("row"), Some(3));
            assert_eq!(set.get_var_names(), ["Time (s)", "Ten Top (N)", "Crit. Seg", "Name", "2 wide"]);
            let attr = |var: &str, name: &str| set.get_var_attr_as_string(var, name);
            assert_eq!(attr("Ten Top (N)", "units").unwrap(), "N");
            assert_eq!(attr("Ten Top (N)", "long_name").unwrap(), "Tension: Ten Top");
            assert_eq!((attr("Crit. Seg", "units").unwrap().as_str(), attr("Name", "units")), ("1", None));
        }
        assert_eq!(reader.read_var_f64("Time (s)").unwrap(), [0.0, 0.1, NO_NUMBER]);
        assert_eq!(reader.read_var_f64("Ten Top (N)").unwrap(), tops);
        assert_eq!(reader.read_var_i32("Crit. Seg").unwrap(), [0, NO_WHOLE, 2]);
        assert_eq!(reader.read_var_u8("Name").unwrap(), b"A\0\0BOW\0\0\0");
        assert_eq!(reader.read_var_f64("2 wide").unwrap(), [0.0, (1u64 << 40) as f64, (1u64 << 41) as f64]);
    }

    #[test]
    fn names_keep_what_the_format_takes_and_stay_unique() {
        let made = names(["Ten Top (kips)", "DF/DX (kips/ft)", "", "\u{e9}", "%", "T/TB", "T_TB"].into_iter());
        assert_eq!(made, ["Ten Top (kips)", "DF_DX (kips_ft)", "_", "\u{e9}", "_%", "T_TB", "T_TB_7"]);
    }
}
