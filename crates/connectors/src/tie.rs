//! A weightless line that only pulls, along the chord between its ends: what SLING and DAVIT are.
//!
//! Source: [MOSES-FLEX SLING]: lines whose force depends only upon the distance between the ends, of stiffness AE/L.

use super::checks;
use super::section::{LineSection, properties};
use super::spring::no_anchor;
use nalgebra::{Matrix3, Matrix6};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_model::{
    ClassError, ClassRecord, ClassRole, Connection, Connector, ConnectorClass, ConnectorElement, ConnectorResponse,
    ConnectorSummary, LengthClass, Note, Situation, SolverCache, Surroundings,
};

/// The force of a tie on its first end, toward the second.
#[derive(Clone, Debug, PartialEq)]
pub struct TieForce {
    /// AE (N).
    pub ea: f64,
    /// Unstretched length (m).
    pub length: f64,
    /// Breaking tension (N).
    pub breaking: f64,
    /// Whether it was given.
    pub break_is_given: bool,
}

impl TieForce {
    /// Tension at a distance of its ends (N), and its slope (N/m).
    pub fn tension(&self, distance: f64) -> (f64, f64) {
        let stiffness = self.ea / self.length;
        let stretch = distance - self.length;
        if stretch > 0.0 { (stiffness * stretch, stiffness) } else { (0.0, 0.0) }
    }

    fn chord(at: &Situation) -> Result<(nalgebra::Vector3<f64>, f64), ClassError> {
        let [first, second] = at.ends else { return Err(ClassError::new("a sling has two ends")) };
        let apart = second.pose.origin - first.pose.origin;
        Ok((apart, apart.norm()))
    }
}

impl ConnectorElement for TieForce {
    fn evaluate(
        &self,
        at: &Situation,
        _: &[f64],
        _: &mut [f64],
        _: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        let (apart, distance) = TieForce::chord(at)?;
        let (tension, slope) = self.tension(distance);
        out.clear(2);
        if tension == 0.0 {
            return Ok(());
        }
        let n = apart / distance;
        let block = n * n.transpose() * slope + (Matrix3::identity() - n * n.transpose()) * (tension / distance);
        let mut whole = Matrix6::zeros();
        whole.fixed_view_mut::<3, 3>(0, 0).copy_from(&block);
        out.stiffness = vec![whole, -whole, -whole, whole];
        for (wrench, sign) in out.wrench.iter_mut().zip([1.0, -1.0]) {
            wrench.fixed_rows_mut::<3>(0).copy_from(&(n * (sign * tension)));
        }
        Ok(())
    }

    fn summary(&self, at: &Situation, _: &[f64]) -> Result<ConnectorSummary, ClassError> {
        let (_, distance) = TieForce::chord(at)?;
        let (tension, _) = self.tension(distance);
        let ratio = tension / self.breaking;
        let mut notes: Vec<Note> = Vec::new();
        if tension == 0.0 {
            notes.push("it is slack".into());
        }
        if ratio > 1.0 {
            notes.push(Note::warning("it is beyond its breaking tension"));
        }
        let over_given_break = self.break_is_given.then_some((ratio, 1));
        let (tension, ratio, critical) = (Some(tension), Some(ratio), Some(1));
        Ok(ConnectorSummary {
            tension,
            ratio,
            critical,
            over_given_break,
            solution: "exact",
            notes,
            ..ConnectorSummary::default()
        })
    }
}

/// A class of ties in an assembly.
#[derive(Debug)]
pub struct TieClass {
    kind: &'static str,
    role: ClassRole,
    section: Option<LineSection>,
}

impl TieClass {
    /// Reads the last of a class's records.
    ///
    /// # Errors
    /// No length.
    pub fn read(records: &[ClassRecord], kind: &'static str, role: ClassRole) -> Outcome<Self> {
        let section = records.last().map(|r| LineSection::read(r, kind, false)).transpose()?;
        Ok(TieClass { kind, role, section })
    }
}

impl ConnectorClass for TieClass {
    fn kind(&self) -> &'static str {
        self.kind
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        no_anchor(self.kind, connector)?;
        checks::ends(self.kind, connector, bodies, 1, 1)
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let stiffness = self.section.map(|s| s.ea / s.length);
        let section = self.section.as_slice();
        properties(name, self.kind, section, surroundings).fact("Stiffness AE/L", stiffness, Dim::ForcePerLength)
    }

    fn role(&self) -> ClassRole {
        self.role
    }

    /// Between the node and the end that an assembly gives: it asks with `to_ground` false.
    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        let section = self.section.ok_or_else(|| ClassError::new("the class has no record"))?;
        checks::in_assembly(self.kind, connection)?;
        let length = connection.connector.first_length.unwrap_or(section.length);
        Ok(Box::new(TieForce {
            ea: section.ea,
            length,
            breaking: section.breaking,
            break_is_given: section.break_is_given,
        }))
    }

    fn as_length(&self) -> Option<&dyn LengthClass> {
        Some(self)
    }
}

impl LengthClass for TieClass {
    fn first_length(&self) -> Option<f64> {
        self.section.map(|s| s.length)
    }

    fn is_adjustable(&self) -> bool {
        true
    }
}
