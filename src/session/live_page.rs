//! The page of a job, written as the job goes.

use super::Session;
use crate::report::live::LivePage;
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_solve::scene::{Scene, SceneOptions};

impl Session {
    /// Writes the page of the job, where one was asked for; one that cannot be written is given up with a warning, and the job goes on.
    pub fn write_page(&mut self, state: &str) {
        let Some(mut file) = self.job.page.take() else { return };
        let job = &self.job;
        let choice = SceneOptions { connector: &|_| true, body: &|_| true, stop: &|| job.is_interrupted() };
        let scene = Scene::build(&job.model, &choice).map(|(scene, _)| scene);
        let root = job.output.folder.root.file_name().map_or("windlass".into(), |name| name.to_string_lossy());
        let title = job.titles.first().filter(|title| !title.is_empty()).map_or(root.as_ref(), String::as_str);
        let page = LivePage {
            title,
            state,
            scene: scene.as_ref(),
            tables: &job.last_tables,
            run: job.run.as_ref(),
            units: job.units,
        };
        match file.write(&page) {
            Ok(()) => self.job.page = Some(file),
            Err(error) => {
                let text = format!("{error}; the job goes on without it");
                self.report(Diagnostic::plain(Severity::Warning, text));
            }
        }
    }
}
