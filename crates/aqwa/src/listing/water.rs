//! Pages of decks 6 to 13: frequencies, stiffness, coefficients, environment, constraints, waves.

use super::{Column, FREEDOMS, THREE_DECIMALS, WHOLE, fact, format_fixed, six_by_six};
use crate::Deck;
use crate::hydrostatics::HydrostaticsDecks;
use crate::job::Program;
use crate::surroundings::UniformStream;
use crate::waves::{RegularWave, SpectrumCard, SpectrumForm, WaveDeck};
use std::f64::consts::TAU;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::sea::density::{SpectralPeak, Spectrum};
use windlass_hydro::sea::dispersion::wave_number;

impl Deck {
    /// Decks 6 to 8: wave frequencies and directions, and the linear stiffness of structures that have one.
    pub(super) fn hydrostatic_pages(&self) -> Vec<Table> {
        let mut list = vec![self.frequency_table()];
        for (number, data) in (1..).zip(&self.hydrostatics) {
            list.extend(stiffness_table(number, data));
        }
        list
    }

    /// Decks 9 to 13: coefficients at drift frequency, loads of wind and current, environment, constraints, waves.
    pub(super) fn water_pages(&self) -> Vec<Table> {
        let drift = self.job.program == Program::Drift;
        let mut list = Vec::new();
        for structure in &self.structures {
            let data = usize::try_from(structure.number - 1).ok().and_then(|index| self.hydrostatics.get(index));
            if drift {
                list.extend(drift_tables(structure.number, data));
            }
            let title = format!(
                "Wind / Current Loads for Unit Amplitude / Velocity and Thruster Forces for Structure {}",
                structure.number
            );
            let mut table = Table::new(title);
            table.note("NO THRUSTER FORCES");
            list.push(table);
        }
        let deep = &self.surroundings;
        if !drift || deep.current.is_some() || deep.wind.is_some() || !deep.profile.is_empty() {
            list.extend(self.environment_tables());
        }
        list.push(self.constraint_table());
        match &self.waves {
            WaveDeck::Still => {}
            WaveDeck::Spectra(spectra) => list.extend(spectra.iter().map(|sea| self.spectrum_table(sea))),
            WaveDeck::Regular(wave) => list.push(self.wave_table(wave)),
        }
        list
    }

    fn frequency_table(&self) -> Table {
        let mut rows: Vec<(i64, f64)> = Vec::new();
        let mut directions: Vec<(i64, f64)> = Vec::new();
        for (number, data) in (1..).zip(&self.hydrostatics) {
            rows.extend(data.frequencies.iter().map(|frequency| (number, *frequency)));
            directions.extend(data.directions.iter().map(|direction| (number, *direction)));
        }
        let depth = self.global.depth;
        let number = |w: f64| wave_number(w, Some(depth), self.global.gravity).ok();
        let mut table = Table::new("Wave Frequencies/Periods and Directions")
            .with_rows(&rows)
            .column("", "STRUCTURE", Dim::None, WHOLE, |(structure, _)| *structure)
            .column("FREQUENCY", "(RAD/SEC)", Dim::None, Digits::Decimals(5), |(_, w)| *w)
            .column("FREQUENCY", "(HERTZ)", Dim::None, Digits::Decimals(5), |(_, w)| w / TAU)
            .column("PERIOD", "(SECONDS)", Dim::None, Digits::Decimals(2), |(_, w)| TAU / w)
            .column("WAVE", "NUMBER", Dim::None, Digits::Decimals(5), |(_, w)| number(*w))
            .column("WAVE", "LENGTH", Dim::None, Digits::Decimals(2), |(_, w)| number(*w).map(|k| TAU / k))
            .column("DEPTH RATIO", "D/L", Dim::None, Digits::Decimals(2), |(_, w)| number(*w).map(|k| depth * k / TAU))
            .column("DEPTH RATIO", "K*D", Dim::None, Digits::Decimals(2), |(_, w)| number(*w).map(|k| depth * k))
            .build();
        if rows.is_empty() {
            table.note("FREQUENCIES *UNDEFINED*");
        }
        if directions.is_empty() {
            table.note("DIRECTIONS *UNDEFINED*");
        }
        for (structure, direction) in directions {
            table.note(format!("STRUCTURE {structure} DIRECTION {}", format_fixed(direction, 2)));
        }
        table
    }

    fn environment_tables(&self) -> Vec<Table> {
        let deep = &self.surroundings;
        let of_hulls = self.hydrostatics.iter().find_map(|data| data.current);
        let stream = |flow: Option<UniformStream>| flow.map_or([0.0; 2], |f| [f.speed.value, f.direction.value]);
        let mut table = Table::new("Environmental Parameters");
        for (name, flow) in [("CURRENT", deep.current.or(of_hulls)), ("WIND", deep.wind)] {
            for (what, value) in ["VELOCITY", "DIRECTION"].into_iter().zip(stream(flow)) {
                table = fact(table, &format!("UNIFORM {name} {what}"), format_fixed(value, 3));
            }
        }
        if deep.profile.is_empty() {
            table.note("NO PROFILED CURRENT");
            return vec![table];
        }
        let profile = Table::new("Profiled Current")
            .with_rows(&deep.profile)
            .column("", "Z", Dim::None, THREE_DECIMALS, |layer| layer.height)
            .column("CURRENT", "VELOCITY", Dim::None, THREE_DECIMALS, |layer| layer.speed)
            .column("CURRENT", "DIRECTION", Dim::None, THREE_DECIMALS, |layer| layer.direction)
            .build();
        vec![table, profile]
    }

    fn constraint_table(&self) -> Table {
        let mut columns = vec![Column::new(
            "STRUCTURE",
            "NUMBER",
            Dim::None,
            WHOLE,
            self.structures.iter().map(|structure| structure.number),
        )];
        for (dof, name) in (1..).zip(FREEDOMS) {
            let active = |number: i64| !self.held.iter().any(|h| h.structure.value == number && h.dof.value == dof);
            let cell = |number| if active(number) { Cell::Text("X".into()) } else { Cell::Missing };
            let cells = self.structures.iter().map(|structure| cell(structure.number));
            columns.push(Column::new("ACTIVE FREEDOMS TABLE", name, Dim::None, WHOLE, cells));
        }
        Table::from_columns("Constraints", columns)
    }

    fn spectrum_table(&self, sea: &SpectrumCard) -> Table {
        let mut list: Vec<(&str, String)> = Vec::new();
        let gravity = self.global.gravity;
        let kind = match &sea.form {
            SpectrumForm::PiersonMoskowitz { .. } => "PIERSON-MOSKOWITZ",
            SpectrumForm::Jonswap { .. } | SpectrumForm::JonswapHeight { .. } => "JONSWAP",
            SpectrumForm::Gaussian { .. } => "GAUSSIAN",
            SpectrumForm::Given(_) => "USER DEFINED",
        };
        list.push(("TYPE OF WAVE SPECTRUM", kind.to_string()));
        list.push(("LOWER FREQUENCY LIMIT", format_fixed(sea.range.0, 3)));
        list.push(("UPPER FREQUENCY LIMIT", format_fixed(sea.range.1, 3)));
        let height = match &sea.form {
            SpectrumForm::PiersonMoskowitz { height, period } => {
                list.push(("ZERO CROSSING PERIOD", format_fixed(*period, 3)));
                *height
            }
            SpectrumForm::Jonswap { gamma, alpha, peak } => {
                list.push(("GAMMA", format_fixed(*gamma, 3)));
                list.push(("ALPHA", format_fixed(*alpha, 5)));
                list.push(("PEAK FREQUENCY", format_fixed(*peak, 3)));
                let hump = SpectralPeak::from_alpha(*alpha, *peak, *gamma, gravity);
                4.0 * Spectrum::from_peaks(vec![hump], None).moment(0).sqrt()
            }
            SpectrumForm::JonswapHeight { gamma, height, peak } => {
                list.push(("GAMMA", format_fixed(*gamma, 3)));
                list.push(("PEAK FREQUENCY", format_fixed(*peak, 3)));
                *height
            }
            SpectrumForm::Gaussian { sigma, height, peak } => {
                list.push(("SIGMA", format_fixed(*sigma, 3)));
                list.push(("PEAK FREQUENCY", format_fixed(*peak, 3)));
                *height
            }
            SpectrumForm::Given(pairs) => {
                let area = |pair: &[(f64, f64)]| match pair {
                    [(low, one), (high, other)] => 0.5 * (one + other) * (high - low),
                    _ => 0.0,
                };
                4.0 * pairs.windows(2).map(area).sum::<f64>().max(0.0).sqrt()
            }
        };
        list.push(("SIGNIFICANT WAVE HEIGHT", format_fixed(height, 3)));
        list.push(("NUMBER OF WAVE SPECTRAL LINES", sea.lines.to_string()));
        list.push(("SPECTRAL DIRECTION", format_fixed(sea.direction, 2)));
        list.push(("TETHER TOWING SPEED", format_fixed(sea.towing.map_or(0.0, |(speed, _)| speed), 2)));
        list.push(("TETHER STEADY OFFSET", format_fixed(0.0, 2)));
        let wind = sea.wind.or(self.surroundings.wind).map_or([0.0; 2], |f| [f.speed.value, f.direction.value]);
        list.push(("WIND SPEED", format_fixed(wind[0], 2)));
        list.push(("WIND DIRECTION", format_fixed(wind[1], 2)));
        list.push(("WIND REFERENCE HEIGHT", format_fixed(0.0, 2)));
        list.push(("WIND SPECTRUM TYPE", "NONE".into()));
        list.push(("NUMBER OF WIND SPECTRAL LINES", "0".into()));
        list.push(("RANDOM NUMBER SEED (IF APPLICABLE)", sea.seed.to_string()));
        let mut table =
            list.into_iter().fold(Table::new("Spectral Parameters"), |table, (name, value)| fact(table, name, value));
        table.note("NUMBER OF RASTERS is left out: spectra are integrated by formula");
        table
    }

    fn wave_table(&self, wave: &RegularWave) -> Table {
        let frequency = if wave.period > 0.0 { TAU / wave.period } else { 0.0 };
        let number = wave_number(frequency, Some(self.global.depth), self.global.gravity).unwrap_or(0.0);
        let length = if number > 0.0 { TAU / number } else { 0.0 };
        let [celerity, slope] = [(length, wave.period), (length, 2.0 * wave.amplitude)]
            .map(|(over, under)| if under > 0.0 { over / under } else { 0.0 });
        let list = [
            ("WAVE FREQUENCY (RADIAN/SEC)", format_fixed(frequency, 5)),
            ("WAVE FREQUENCY (HERTZ)", format_fixed(frequency / TAU, 5)),
            ("WAVE NUMBER", format_fixed(number, 5)),
            ("WAVE AMPLITUDE", format_fixed(wave.amplitude, 2)),
            ("WAVE HEIGHT", format_fixed(2.0 * wave.amplitude, 2)),
            ("WAVE PERIOD", format_fixed(wave.period, 2)),
            ("WAVE LENGTH", format_fixed(length, 2)),
            ("WAVE CELERITY", format_fixed(celerity, 2)),
            ("WAVE SLOPE (1 IN)", format_fixed(slope, 2)),
            ("WAVE DIRECTION", format_fixed(wave.direction, 2)),
            ("DAMPING DECAY FACTOR ZERO AT TIME", format_fixed(0.0, 2)),
            ("TYPE OF WAVE THEORY", if wave.linear { "AIRY" } else { "STOKES2 (D/W)" }.to_string()),
        ];
        let title = "Regular Wave Parameters and Initial Damping Factors";
        list.into_iter().fold(Table::new(title), |table, (name, value)| fact(table, name, value))
    }
}

fn stiffness_table(number: i64, data: &HydrostaticsDecks) -> Option<Table> {
    let stiffness = data.stiffness?;
    let title = format!("Hydrodynamic Parameters for Structure {number} at the Free-Floating Equilibrium Position");
    let value = |field: Option<crate::card::Field<f64>>| super::exponent(field.map_or(0.0, |field| field.value), 4);
    let table = six_by_six(title, "STIFFNESS MATRIX", &stiffness);
    let table = fact(table, "BUOYANCY FORCE", value(data.buoyancy));
    Some(fact(table, "Z POSITION OF THE CENTRE OF GRAVITY", value(data.height)))
}

fn drift_tables(number: i64, data: Option<&HydrostaticsDecks>) -> [Table; 2] {
    let page = |what: &str, matrix: Option<[[f64; 6]; 6]>| {
        let title = format!("Hydrodynamic Parameters for Structure {number}");
        six_by_six(title, &format!("{what} AT DRIFT FREQUENCY"), &matrix.unwrap_or_default())
    };
    [
        page("ADDED MASS", data.and_then(|d| d.added_mass.or(d.drift_added_mass))),
        page("DAMPING", data.and_then(|d| d.damping.or(d.drift_damping))),
    ]
}
