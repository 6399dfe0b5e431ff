//! Records of MOSES that windlass does not have: one message each, and no cascade.

use super::Session;
use crate::commands::absent::{Absent, Loss};
use crate::commands::{Effect, Menu};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_language::record::Word;
use windlass_model::UnmodelledEffect;

impl Session {
    /// Says what is lost with a record, once; keeps an effect that solves would need; passes over the menu that it opens.
    pub(super) fn answer_absent(&mut self, entry: &'static Absent, first: &Word) -> Outcome<Effect> {
        let passes = entry.opens.filter(|_| !self.interactive);
        self.job.menus.extend(passes.map(Menu::Refused));
        self.judge_absent(entry.loss);
        if entry.name == "ASSEMBLY LLEG" {
            // all legs together have this name
            let position = self.interpreter.sources.location(first.span);
            self.keep_missing_names(["&LWAY"], &position);
        }
        if self.job.absent_said.contains(&entry.name) {
            return Ok(Effect::Done);
        }
        self.job.absent_said.push(entry.name);
        let explain = |mut said: Box<Diagnostic>| {
            said.help.extend((!entry.instead.is_empty()).then(|| entry.instead.to_string()));
            said.help.extend(passes.map(|menu| format!("its records up to {} are passed over", menu.end)));
            said
        };
        let span = first.span;
        match entry.loss {
            Loss::Results => {
                self.errors_of_absent += 1;
                return Err(explain(Diagnostic::error(entry.sentence(), span)));
            }
            Loss::Nothing => self.job.notices.push(*explain(Diagnostic::remark(entry.sentence(), span))),
            Loss::Solves(matters_to) => {
                self.job.notices.push(*explain(Diagnostic::warning(entry.sentence(), span)));
                let (record, effect) = (entry.name.to_string(), entry.what.to_string());
                self.job.model.keep_unmodelled(UnmodelledEffect { record, effect, matters_to, span });
            }
        }
        Ok(Effect::Done)
    }
}
