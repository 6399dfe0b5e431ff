//! Variables: strings under names, global or local to a macro call.
//!
//! Source: [MOSES-REF lang_local]. A local hides a global or an outer local of the same name; `&SET` changes
//! the variable that is visible under the name, and makes a global when there is none.

use indexmap::IndexMap;

/// Longest value taken (bytes), so that a variable doubled in a loop cannot fill the memory.
pub const LONGEST_VALUE: usize = 1 << 16;
/// Most variables kept at a time.
pub const MAX_VARIABLES: usize = 1_000_000;

/// All variables of a session.
#[derive(Clone, Debug, Default)]
pub struct Variables {
    globals: IndexMap<String, String>,
    scopes: Vec<IndexMap<String, String>>,
}

/// Why a variable could not be set.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VariableError {
    /// The value is too long.
    #[error("the value is longer than {LONGEST_VALUE} characters")]
    TooLong,
    /// There are too many variables.
    #[error("there are more than {MAX_VARIABLES} variables")]
    TooMany,
}

impl Variables {
    /// The value visible under a name (upper and lower case alike).
    pub fn get(&self, name: &str) -> Option<&str> {
        let key = name.to_ascii_uppercase();
        self.scopes.iter().rev().chain(std::iter::once(&self.globals)).find_map(|s| s.get(&key)).map(String::as_str)
    }

    /// Sets the variable visible under a name, or a new global.
    ///
    /// # Errors
    /// A value too long, or too many variables.
    pub fn set(&mut self, name: &str, value: &str) -> Result<(), VariableError> {
        let key = name.to_ascii_uppercase();
        let scope = self.scopes.iter_mut().rev().find(|s| s.contains_key(&key)).unwrap_or(&mut self.globals);
        set_variable(scope, key, value)
    }

    /// Sets a local of the innermost macro (a global outside of macros).
    ///
    /// # Errors
    /// As [`Variables::set`].
    pub fn set_local(&mut self, name: &str, value: &str) -> Result<(), VariableError> {
        let scope = self.scopes.last_mut().unwrap_or(&mut self.globals);
        set_variable(scope, name.to_ascii_uppercase(), value)
    }

    /// Opens a scope for a macro call.
    pub fn enter(&mut self) {
        self.scopes.push(IndexMap::new());
    }

    /// Drops the innermost scope with its locals.
    pub fn leave(&mut self) {
        self.scopes.pop();
    }

    /// All names visible, innermost first.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.scopes.iter().rev().chain(std::iter::once(&self.globals)).flat_map(|s| s.keys().map(String::as_str))
    }
}

fn set_variable(scope: &mut IndexMap<String, String>, key: String, value: &str) -> Result<(), VariableError> {
    if value.len() > LONGEST_VALUE {
        return Err(VariableError::TooLong);
    }
    if scope.len() >= MAX_VARIABLES && !scope.contains_key(&key) {
        return Err(VariableError::TooMany);
    }
    scope.insert(key, value.to_string());
    Ok(())
}
