//! The records of a session as they were executed, for `&HISTORY`, `&SAVE` and the file of a run.

use super::Command;
use super::check_list::CheckedAs;
use windlass_language::record::Word;

/// Bytes of records that are kept; a session that executes more is not kept any longer.
const MAX_BYTES: usize = 64 << 20;
/// Commands of the terminal, which a script of the session has no use for.
const TERMINAL_COMMANDS: [&str; 5] = ["&HELP", "&HISTORY", "&SAVE", "&UNDO", "&FINISH"];
/// Options of &DEVICE whose file the session reads in place: the records of the file are kept.
const READING_OPTIONS: [&str; 4] = ["-AUXIN", "-IAUXIN", "-COMIN", "-ICOMIN"];

/// What a record was.
#[derive(Clone, Copy, Default)]
pub enum Executed {
    /// Nothing that a script would need: the call of a macro, whose records follow.
    #[default]
    Nothing,
    /// A command.
    Command(&'static Command),
    /// A row of a menu that takes rows, or the END of a menu.
    Row,
}

/// A record that was executed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExecutedRecord {
    /// Its text, substituted.
    pub text: String,
    /// Whether the model needs it: it makes the model, or places what is in it.
    pub makes_model: bool,
    /// Whether `&UNDO` took it back.
    pub is_undone: bool,
}

/// The records of a session.
#[derive(Clone, Debug, Default)]
pub struct Journal {
    records: Vec<ExecutedRecord>,
    bytes: usize,
    /// Of each open menu but the main one, whether the record that opened it makes the model.
    pub(super) menus: Vec<bool>,
    /// There were more records than are kept.
    overflows: bool,
}

impl Journal {
    /// The records, in order.
    pub fn records(&self) -> &[ExecutedRecord] {
        &self.records
    }

    /// Whether there were more records than are kept.
    pub fn overflows(&self) -> bool {
        self.overflows
    }

    /// Keeps a record that was executed, with the number of open menus behind it.
    pub fn keep(&mut self, text: &str, words: &[Word], executed: Executed, open_menus: usize) {
        let inner = self.menus.last().copied();
        let makes_model = match executed {
            Executed::Nothing => return self.follow_menus(open_menus, false),
            Executed::Row => inner.unwrap_or(true),
            Executed::Command(command) => {
                let name = command.spec.name;
                let reads = |word: &Word| {
                    let begins = |option: &&str| option.starts_with(&word.text.to_ascii_uppercase());
                    word.text.len() > 2 && READING_OPTIONS.iter().any(begins)
                };
                if TERMINAL_COMMANDS.contains(&name) || (name == "&DEVICE" && words.iter().any(reads)) {
                    return self.follow_menus(open_menus, false);
                }
                match CheckedAs::from_command(command) {
                    CheckedAs::Run | CheckedAs::RunWithRows => true,
                    CheckedAs::Solve => name != "TDOM",
                    CheckedAs::SetVariable | CheckedAs::WithoutEffect | CheckedAs::Read => false,
                }
            }
        };
        self.follow_menus(open_menus, makes_model);
        self.push(text, makes_model);
    }

    /// Keeps a record that stands for the end of a file that a menu was read from.
    pub fn keep_end(&mut self, open_menus: usize) {
        let makes_model = self.menus.last().copied().unwrap_or(true);
        self.follow_menus(open_menus, makes_model);
        self.push("END", makes_model);
    }

    fn push(&mut self, text: &str, makes_model: bool) {
        self.bytes = self.bytes.saturating_add(text.len() + size_of::<ExecutedRecord>());
        if self.bytes > MAX_BYTES {
            self.overflows = true;
            return;
        }
        self.records.push(ExecutedRecord { text: text.to_string(), makes_model, is_undone: false });
    }

    /// Follows menus that were opened and left.
    fn follow_menus(&mut self, open_menus: usize, makes_model: bool) {
        self.menus.resize(open_menus.saturating_sub(1), makes_model);
    }

    /// Marks the records from one number up to another as taken back; the first of them, and how many more there are.
    pub(super) fn take_back(&mut self, from: usize, to: usize) -> (String, usize) {
        let taken = self.records.get_mut(from..to.max(from)).unwrap_or_default();
        let fresh = taken.iter_mut().filter(|record| !record.is_undone);
        let texts: Vec<&String> = fresh
            .map(|record| {
                record.is_undone = true;
                &record.text
            })
            .collect();
        (texts.first().map_or(String::new(), |text| (*text).clone()), texts.len().saturating_sub(1))
    }

    /// The records as a script, those that were taken back left out; with `model_alone` only what the model needs.
    pub fn script(&self, model_alone: bool) -> String {
        let kept = self.records.iter().filter(|record| !record.is_undone && (record.makes_model || !model_alone));
        kept.flat_map(|record| [record.text.as_str(), "\n"]).collect()
    }
}
