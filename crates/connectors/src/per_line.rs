//! Options that hold for a whole line: they may stand on any record of its class, everywhere with the same value.

use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::values::{Args, Given};

/// The options of a whole line that its records have given so far, each where it was given last.
#[derive(Clone, Debug, Default)]
pub struct PerLineOptions {
    given: Vec<Given>,
}

impl PerLineOptions {
    /// Compares the options of these names on a further record with those before it.
    ///
    /// # Errors
    /// Unlike values, with both places.
    pub fn check(&self, args: &Args, names: &[&str]) -> Outcome<()> {
        for name in names {
            let (Some(first), Some(given)) = (self.option(name), args.option(name)) else { continue };
            let (before, now) = (first.values.iter(), given.values.iter());
            if !before.map(|v| &v.content).eq(now.map(|v| &v.content)) {
                return Err(Diagnostic::error(
                    format!("{name} holds for the whole line and is given two unlike values"),
                    given.span,
                )
                .other(first.span, "first given here"));
            }
        }
        Ok(())
    }

    /// Takes over the options of these names from a record; true when it has any.
    pub fn take(&mut self, args: &Args, names: &[&str]) -> bool {
        let mut taken = false;
        for given in names.iter().filter_map(|name| args.option(name)) {
            self.given.retain(|g| g.name != given.name);
            self.given.push(given.clone());
            taken = true;
        }
        taken
    }

    /// An option by its full name, if given.
    pub fn option(&self, name: &str) -> Option<&Given> {
        self.given.iter().find(|g| g.name == name)
    }

    /// The first number of an option.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.option(name).and_then(|g| g.number(0))
    }
}
