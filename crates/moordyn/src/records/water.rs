//! Depth, currents, waves and seafloor of a deck.

use super::{Like, Writer, number, numbers, rounded};
use crate::Deck;
use crate::files::{self, FileText, NeededFile};
use crate::tables::AxialStiffness;
use std::f64::consts::TAU;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;

/// The files of MoorDyn that have no name in a deck.
const CURRENT_PROFILE: &str = "current_profile.txt";
const WAVE_FREQUENCIES: &str = "wave_frequencies.txt";
const WAVE_ELEVATION: &str = "wave_elevation.txt";
/// Names in the model.
const BOTTOM: &str = "MOORDYN_BOTTOM";
const CURRENT_X: &str = "MOORDYN_X";
const CURRENT_Y: &str = "MOORDYN_Y";
const WAVES: &str = "MOORDYN_WAVES";
/// Pairs of a record on one line.
const PAIRS_PER_LINE: usize = 8;

impl Deck {
    /// The files beside the deck that its records need.
    pub fn files(&self) -> Vec<NeededFile> {
        let mut list = Vec::new();
        let options = &self.options;
        if let Some(given) = &options.seafloor_file {
            list.push(NeededFile { name: given.value.clone(), span: given.span });
        }
        if let Some(given) = options.currents.as_ref().filter(|given| given.value == 1) {
            list.push(NeededFile { name: CURRENT_PROFILE.to_string(), span: given.span });
        }
        if let Some(given) = &options.wave_kinematics {
            let name = match given.value {
                2 | 7 => Some(WAVE_FREQUENCIES),
                3 => Some(WAVE_ELEVATION),
                _ => None,
            };
            list.extend(name.map(|name| NeededFile { name: name.to_string(), span: given.span }));
        }
        for kind in &self.line_types {
            if let AxialStiffness::Table(name) = &kind.stiffness.value {
                list.push(NeededFile { name: name.clone(), span: kind.stiffness.span });
            }
        }
        let mut seen: Vec<String> = Vec::new();
        list.retain(|file| {
            let is_new = !seen.contains(&file.name);
            seen.push(file.name.clone());
            is_new
        });
        list
    }
}

/// Pairs over several lines of one record.
fn pairs(values: impl Iterator<Item = (f64, f64)>) -> String {
    let mut text = String::new();
    for (index, (a, b)) in values.enumerate() {
        text.push_str(if index > 0 && index % PAIRS_PER_LINE == 0 { " \\\n " } else { " " });
        text.push_str(&numbers(&[a, b]));
    }
    text
}

impl Writer<'_> {
    /// A file that was opened for the deck; refused where it was not.
    pub(super) fn file(&mut self, name: &str, span: Span) -> Option<FileText<String>> {
        let found = self.files.get(name).cloned();
        if found.is_none() {
            self.refuse(span, format!("the file {name} is not there"), "expected it in the folder of the deck");
        }
        found
    }

    pub(super) fn parse<T>(
        &mut self,
        (name, span): (&str, Span),
        parse: fn(&str, windlass_base::span::SourceId) -> Outcome<T>,
    ) -> Option<T> {
        let file = self.file(name, span)?;
        match parse(&file.text, file.source) {
            Ok(made) => Some(made),
            Err(error) => {
                self.wrong.push(*error.other(span, "the deck asks for the file here"));
                None
            }
        }
    }

    /// Curves and bottom, and what the environment says of them.
    pub(super) fn water(&mut self) -> String {
        let deck = self.deck;
        let options = &deck.options;
        let mut said = String::new();
        if let Some(given) = options.seafloor_file.as_ref() {
            said.push_str(&self.seafloor(&given.value, given.span));
        }
        if let Some(given) = options.currents.as_ref().filter(|given| given.value == 1) {
            said.push_str(&self.current(given.span));
        }
        match options.wave_kinematics.as_ref().map(|given| (given.value, given.span)) {
            Some((2 | 7, span)) => said.push_str(&self.wave_components(span)),
            Some((3, span)) => said.push_str(&self.wave_elevation(span)),
            _ => {}
        }
        said
    }

    fn seafloor(&mut self, name: &str, span: Span) -> String {
        let Some(floor) = self.parse((name, span), files::seafloor) else { return String::new() };
        self.record("OPTIONS", span, &format!("&BATHYMETRY {BOTTOM}"));
        for chunk in floor.x.chunks(PAIRS_PER_LINE) {
            self.record("OPTIONS", span, &format!("X {}", numbers(chunk)));
        }
        for (y, heights) in floor.y.iter().zip(floor.heights.chunks(floor.x.len().max(1))) {
            let mut text = format!("Y {}", number(*y));
            for chunk in heights.chunks(PAIRS_PER_LINE) {
                text.push_str(&format!(" \\\n {}", numbers(chunk)));
            }
            self.record("OPTIONS", span, &text);
        }
        self.record("OPTIONS", span, "END");
        let text = match self.like {
            Like::Right => {
                "between the points of the seafloor the bottom is bicubic and pushes along its normal; MoorDyn's is bilinear and pushes straight up, as the bottom does with -LIKE MOORDYN"
            }
            Like::MoorDyn => {
                "the bottom pushes straight up, as in MoorDyn; between the points of the seafloor it is bicubic, MoorDyn's is bilinear"
            }
        };
        self.remark(span, text);
        format!(" -BATHYMETRY {BOTTOM}")
    }

    fn current(&mut self, span: Span) -> String {
        let Some(profile) = self.parse((CURRENT_PROFILE, span), files::current_profile) else { return String::new() };
        let mut said = String::new();
        for (axis, (name, from)) in [(CURRENT_X, 180.0), (CURRENT_Y, 270.0)].into_iter().enumerate() {
            let velocities = profile.rows.iter().map(|(depth, velocity)| (*depth, velocity[axis]));
            let rows: Vec<(f64, f64)> = velocities.collect();
            if rows.iter().all(|(_, velocity)| *velocity == 0.0) {
                continue;
            }
            // a curve has two points, and is constant beyond them
            let more = rows.first().filter(|_| rows.len() == 1).map(|(depth, velocity)| (depth + 1.0, *velocity));
            let text = pairs(rows.iter().copied().chain(more));
            self.record("OPTIONS", span, &format!("&DATA CURVES C_PROFILE {name}{text}"));
            said.push_str(&format!(" {name} {}", number(from)));
        }
        if said.is_empty() { said } else { format!(" -CURRENT{said}") }
    }

    fn wave_components(&mut self, span: Span) -> String {
        let Some(waves) = self.parse((WAVE_FREQUENCIES, span), files::wave_components) else { return String::new() };
        if waves.is_empty() {
            return String::new();
        }
        let mut text = " -STRETCHING WHEELER -WAVES".to_string();
        for wave in &waves {
            let from = (wave.toward.to_degrees() + 180.0).rem_euclid(360.0);
            let phase = wave.phase.to_degrees().rem_euclid(360.0);
            let row = [TAU / wave.frequency, wave.amplitude, phase, from].map(rounded);
            text.push_str(&format!(" \\\n {}", numbers(&row)));
        }
        text
    }

    fn wave_elevation(&mut self, span: Span) -> String {
        let Some(points) = self.parse((WAVE_ELEVATION, span), files::wave_elevation) else { return String::new() };
        let text = pairs(points.iter().copied());
        self.record("OPTIONS", span, &format!("&DATA CURVES S_HISTORY {WAVES}{text}"));
        let mean = points.iter().map(|(_, elevation)| elevation).sum::<f64>() / points.len() as f64;
        if mean.abs() > 1e-6 {
            let text = format!(
                "the mean of the elevation, {} m, is left out: -TIDE of &ENV raises the level",
                number(rounded(mean))
            );
            self.out.notes.push(*Diagnostic::warning(text, span));
        }
        let text = "the waves of the elevation travel toward +x and repeat with its length; all of its frequencies are kept, where MoorDyn cuts above 0.5 Hz";
        self.remark(span, text);
        format!(" -STRETCHING WHEELER -S_HISTORY {WAVES} 180")
    }
}
