//! Options that hold for a whole line: they may stand on any record of its class, everywhere with the same value.

use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::values::{Args, Given};
use windlass_language::spec::OptionSpec;

/// The options of a whole line that its records have given so far, each where it was given last.
#[derive(Clone, Debug, Default)]
pub struct PerLineOptions {
    given: Vec<Given>,
}

impl PerLineOptions {
    /// Compares these options on a further record with those before it.
    ///
    /// # Errors
    /// Unlike values, with both places.
    pub fn check(&self, args: &Args, options: &[OptionSpec]) -> Outcome<()> {
        for option in options {
            let (Some(first), Some(given)) = (self.option(option), args.option(option)) else { continue };
            let (before, now) = (first.values.iter(), given.values.iter());
            if !before.map(|v| &v.content).eq(now.map(|v| &v.content)) {
                return Err(Diagnostic::error(
                    format!("{} holds for the whole line and is given two unlike values", option.name),
                    given.span,
                )
                .other(first.span, "first given here"));
            }
        }
        Ok(())
    }

    /// Takes over these options from a record; true when it has any.
    pub fn take(&mut self, args: &Args, options: &[OptionSpec]) -> bool {
        let mut taken = false;
        for given in options.iter().filter_map(|option| args.option(option)) {
            self.given.retain(|g| !g.is(given.option));
            self.given.push(given.clone());
            taken = true;
        }
        taken
    }

    /// An option, if given.
    pub fn option(&self, option: &OptionSpec) -> Option<&Given> {
        self.given.iter().find(|given| given.is(option))
    }

    /// The first number of an option.
    pub fn number(&self, option: &OptionSpec) -> Option<f64> {
        self.option(option).and_then(|g| g.first_number())
    }
}
