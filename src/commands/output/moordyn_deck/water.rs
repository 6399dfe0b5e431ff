//! Current, waves and bottom as the files beside a deck.

use super::system::{DeckWriter, own};
use std::f64::consts::FRAC_PI_2;
use windlass_base::diagnostic::Outcome;
use windlass_hydro::current::CurrentField;
use windlass_hydro::sea::Sea;
use windlass_model::Stretching;

/// Its name in MoorDyn.
const CURRENT_PROFILE: &str = "current_profile.txt";
/// Its name in MoorDyn.
const WAVE_FREQUENCIES: &str = "wave_frequencies.txt";
/// Waves as the sum of their components at the nodes.
const SUM_OF_COMPONENTS: usize = 7;

impl DeckWriter<'_> {
    /// What the environment does to lines.
    pub(super) fn water(&mut self) -> Outcome<()> {
        let model = self.model;
        let env = &model.environment;
        if self.around.tide != 0.0 {
            return Err(
                self.refuse("a deck has no tide", "add it to the depth and take it off the heights of all points")
            );
        }
        if env.growth.is_some() {
            return Err(self.refuse(
                "a deck has no marine growth",
                "write it into the classes: -WTPLEN, -BUOYDIAMETER, -DRAGDIAMETER",
            ));
        }
        if env.filling.is_some() {
            return Err(self.refuse("a deck has no contents of pipes", "add them to -WTPLEN of the classes"));
        }
        if env.wind.is_some_and(|wind| wind.speed != 0.0) {
            self.remark("a deck has no wind: that on lines above the water is left out");
        }
        if env.current_history.is_some() {
            return Err(self.refuse("the current varies with time, which is not written", "&ENV without -C_HISTORY"));
        }
        self.current()?;
        self.waves()?;
        self.seafloor();
        Ok(())
    }

    fn current(&mut self) -> Outcome<()> {
        let found = CurrentField::new(self.model, &self.model.environment, None);
        let field = found.map_err(|error| error.diagnostic(self.span, self.units))?;
        if field.is_none() {
            return Ok(());
        }
        let mut depths = field.kinks();
        depths.extend([0.0, self.depth]);
        depths.sort_by(f64::total_cmp);
        depths.dedup();
        let rows = depths.iter().map(|depth| {
            let (velocity, _) = field.at_depth(*depth);
            format!("{} {} {} 0", 0.0 - depth, velocity.x + 0.0, velocity.y + 0.0)
        });
        let rows: Vec<String> = rows.collect();
        let text = format!("current over the depth\nz ux uy uz\n(m) (m/s) (m/s) (m/s)\n{}\n", rows.join("\n"));
        let file = self.beside(CURRENT_PROFILE);
        self.files.push((file, text));
        self.deck.options.currents = Some(own(1));
        Ok(())
    }

    fn waves(&mut self) -> Outcome<()> {
        let found = Sea::new(self.model, &self.model.environment);
        let Some(sea) = found.map_err(|error| error.diagnostic(self.span, self.units))? else { return Ok(()) };
        if sea.stokes.is_some() {
            return Err(
                self.refuse("a STOKES wave is not linear: a deck has linear waves", "REGULAR is the linear wave")
            );
        }
        let mut text = String::from("0 0 0 0\n");
        for wave in &sea.components {
            // a cos(k x - w t + phase) is a sin(w t - k x + pi/2 - phase)
            let angle = FRAC_PI_2 - wave.phase;
            let [x, y] = wave.toward;
            let (re, im) = (wave.amplitude * angle.cos(), wave.amplitude * angle.sin());
            text.push_str(&format!("{} {re} {im} {}\n", wave.frequency, y.atan2(x)));
        }
        let file = self.beside(WAVE_FREQUENCIES);
        self.files.push((file, text));
        self.deck.options.wave_kinematics = Some(own(SUM_OF_COMPONENTS));
        if sea.ramp > 0.0 {
            self.remark("the waves of a deck are there at once: the ramp is left out");
        }
        if sea.stretching != Stretching::Wheeler {
            self.remark("MoorDyn stretches waves to the surface by Wheeler's rule: -STRETCHING WHEELER does so here");
        }
        Ok(())
    }

    fn seafloor(&mut self) {
        let Some(grid) = self.model.bathymetry_in(&self.model.environment) else { return };
        let [x, y] = grid.places();
        let words = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let mut text = format!("{} {}\n{}\n{}\n", x.len(), y.len(), words(x), words(y));
        let heights: Vec<f64> = grid.point_heights().collect();
        for (py, row) in y.iter().zip(heights.chunks(x.len().max(1))) {
            for (px, z) in x.iter().zip(row) {
                text.push_str(&format!("{px} {py} {z}\n"));
            }
        }
        let name = std::path::Path::new(self.name)
            .file_stem()
            .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let own_name = format!("{name}_seafloor.txt");
        let file = self.beside(&own_name);
        self.files.push((file, text));
        self.deck.options.seafloor_file = Some(own(own_name));
        self.remark(
            "MoorDyn opens the seafloor file in the folder it runs in; its bottom is bilinear and pushes straight up",
        );
    }
}
