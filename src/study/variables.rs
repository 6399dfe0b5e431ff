//! Whether a script uses the columns of its table. The text of the script and of the files that it inserts is searched for `%NAME%`,
//! `%(NAME)` and `&V_EXIST(NAME)`. Where that cannot be known without running it (a name made of variables, an inserted file with a name of
//! variables, a macro library, a file that cannot be read) nothing is said.

use crate::report::files::read_regular;
use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};
use windlass_study::lost::{CONDITION, PROBABILITY};
use windlass_study::stiffness::STIFFNESS;
use windlass_study::table::{CASE, CaseTable, MEMBER, SEED, SEED_OF};

/// Longest script that is searched (bytes).
const LARGEST_SCRIPT: u64 = 1 << 26;
/// Most files that are searched.
const MOST_FILES: usize = 1000;

/// Names of the variables that a script uses, in capitals; none where that is not known before it runs.
fn names_used(model: &Path) -> Option<BTreeSet<String>> {
    let (mut names, mut seen, mut files) = (BTreeSet::new(), HashSet::new(), vec![model.to_path_buf()]);
    while let Some(file) = files.pop() {
        if !seen.insert(file.clone()) {
            continue;
        }
        if seen.len() > MOST_FILES {
            return None;
        }
        let bytes = read_regular(&file, LARGEST_SCRIPT).ok()?;
        for line in String::from_utf8_lossy(&bytes).lines() {
            if !line.trim_start().starts_with('$') {
                files.extend(inserted(line, &file)?);
                collect_names(line, &mut names)?;
            }
        }
    }
    Some(names)
}

/// The file that a line inserts; the outer `None` where it cannot be told.
fn inserted(line: &str, script: &Path) -> Option<Option<PathBuf>> {
    let mut words = line.split_whitespace();
    let first = words.next().unwrap_or_default().to_ascii_uppercase();
    let is_short_of = |whole: &str, least: usize| first.len() >= least && whole.starts_with(&first);
    if is_short_of("USE_MAC", 3) {
        return None;
    }
    if !is_short_of("&INSERT", 4) {
        return Some(None);
    }
    let name = words.next()?.trim_matches(['\'', '"']);
    if name.contains(['%', '&']) {
        return None;
    }
    let beside = script.parent().map(|folder| folder.join(name));
    beside.into_iter().chain([PathBuf::from(name)]).find(|path| path.is_file()).map(Some)
}

fn name_at(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len());
    text.get(..end).unwrap_or_default()
}

/// Adds the names of a line; `None` where one is made of others.
fn collect_names(line: &str, names: &mut BTreeSet<String>) -> Option<()> {
    for part in line.split('%').skip(1) {
        let name = match part.strip_prefix('(') {
            // %(A%B%) is named by what B holds
            Some(inner) if !inner.contains(')') => return None,
            Some(inner) => name_at(inner.trim_start()),
            None => name_at(part),
        };
        names.insert(name.to_ascii_uppercase());
    }
    let capitals = line.to_ascii_uppercase();
    for part in capitals.split("&V_EXIST(").skip(1) {
        names.insert(name_at(part.trim_start()).to_owned());
    }
    Some(())
}

/// What is wrong with a table that has a column which its script does not use, and which names no case; none where all are used.
pub(super) fn complaint(table: &CaseTable, file: &str, model: &Path) -> Option<String> {
    let own = [CASE, MEMBER, SEED, SEED_OF, CONDITION, PROBABILITY, STIFFNESS].map(str::to_owned);
    let is_known = |column: &str, list: &[String]| list.iter().any(|known| known.eq_ignore_ascii_case(column));
    let used = names_used(model)?;
    let unused = table.columns.iter().find(|column| {
        !used.contains(&column.to_ascii_uppercase()) && !is_known(column, &own) && !is_known(column, &table.naming)
    })?;
    let without_column = |name: &&str| !is_known(name, &table.columns);
    let near = windlass_base::diagnostic::did_you_mean(
        &unused.to_ascii_uppercase(),
        used.iter().map(String::as_str).filter(without_column),
    );
    let near = near.map_or_else(String::new, |near| format!("; {near}"));
    Some(format!("{file}: column {unused}: no record of {} uses %{unused}%{near}", model.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_between_signs_of_per_cent_and_of_v_exist() {
        let mut names = BTreeSet::new();
        assert_eq!(collect_names("&ENV %hs% A%TP&B 'x%(GAMMA )y' &V_EXIST( LOST)", &mut names), Some(()));
        for name in ["HS", "TP", "GAMMA", "LOST"] {
            assert!(names.contains(name), "{name}: {names:?}");
        }
        assert_eq!(collect_names("%(A%B%)", &mut names), None);
        assert_eq!(inserted("&ENV HS", Path::new("a.cif")), Some(None));
        assert_eq!(inserted("&INSERT %F%", Path::new("a.cif")), None);
        assert_eq!(inserted("use_mac box", Path::new("a.cif")), None);
    }
}
