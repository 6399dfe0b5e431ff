//! What `&PARAMETER` says of all computations, and what is missing in a model that they would need.

use crate::{Body, ClassError, LoadKind, Model, WaveAction};

/// What holds for all computations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parameters {
    /// Whether solves go on without what a body lacks and without effects that are not computed, and reports say so.
    pub accept_missing: bool,
    /// Drag coefficient of tubes whose record gives none (`-DRGTUB`).
    pub tube_drag: Option<f64>,
    /// Added mass coefficient of tubes whose record gives none (`-AMCTUB`).
    pub tube_added_mass: Option<f64>,
    /// Shape coefficient of tubes in wind whose record gives none (`-WCSTUBE`).
    pub tube_wind: Option<f64>,
    /// Drag coefficient of plates whose record gives none (`-DRGPLA`).
    pub plate_drag: Option<f64>,
    /// The dividing period of first-order and low-frequency motion (s), where one is given.
    pub dividing: Option<f64>,
}

impl Model {
    /// The bodies that move under the pressure of waves on their hull (`-DIFTYPE FK`) and have no added mass but that of members:
    /// neither `#AMASS` nor a database.
    pub fn without_added_mass(&self) -> Vec<&Body> {
        let lacks = |body: &&Body| {
            let pressed = |p: &crate::Part| p.pieces.iter().any(|piece| piece.waves == WaveAction::Pressure);
            let given = self.loads.iter().filter(|l| matches!(l.kind, LoadKind::AddedMass(_)));
            let own = |part: &str| self.parts_of(body).any(|p| Model::key(&p.name) == Model::key(part));
            let moves = body.prescribed.is_none() && body.ignored.len() < 6;
            moves
                && body.database.is_none()
                && self.parts_of(body).any(pressed)
                && !given.into_iter().any(|load| own(&load.part))
        };
        self.bodies.values().filter(lacks).collect()
    }

    /// Sees that no body would swing by its dry mass alone, unless that is accepted.
    ///
    /// # Errors
    /// Bodies without added mass, by name.
    pub fn check_added_mass(&self) -> Result<(), ClassError> {
        let missing = self.without_added_mass();
        if missing.is_empty() || self.parameters.accept_missing {
            return Ok(());
        }
        let names: Vec<&str> = missing.iter().map(|b| b.name.as_str()).collect();
        let text = format!(
            "no added mass of {}: -DIFTYPE FK has the pressure of the undisturbed waves alone, and periods by dry mass are too short",
            names.join(", ")
        );
        Err(ClassError::new(text).help(
            "give #AMASS or DATABASE; &PARAMETER -ACCEPT_MISSING YES goes on without added mass and says so in every report",
        ))
    }

    /// Remarks that every report of forces and motions has: what is computed by a shortcut, and what is missing and accepted.
    pub fn caveats(&self) -> Vec<String> {
        let missing = self.without_added_mass();
        let names: Vec<&str> = missing.iter().map(|b| b.name.as_str()).collect();
        let accepted = (!names.is_empty() && self.parameters.accept_missing).then(|| {
            format!("without added mass and radiation, as &PARAMETER -ACCEPT_MISSING accepts: {}", names.join(", "))
        });
        let databases = self.bodies.values().flat_map(|body| self.database_caveats(body));
        let others = self.interpolated_lines().into_iter().chain(accepted).chain(self.accepted_effects());
        others.chain(databases).collect()
    }
}
