//! Loads of wind, current and waves that records put on parts, and the matrices of `#DRAG`, `#DAMP` and `#AMASS`.
//!
//! Source: [MOSES-REF load_g]; [MOSES-HELP lgroup]. Everything is in the axes of its part; the floors above turn it into
//! forces.

use crate::Model;
use indexmap::IndexMap;
use nalgebra::Matrix6;
use windlass_base::geometry::Position;
use windlass_base::span::Span;
use windlass_base::wildcard::matches;

/// What decides whether a load is one of wind or of current.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fluid {
    /// The global height of its point: wind above the water, current below.
    ByHeight,
    /// Wind, wherever it is.
    Air,
    /// Current, wherever it is.
    Water,
}

/// A kind of load with its values.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadKind {
    /// Areas times shape coefficients along the axes of the part (m2).
    Area([f64; 3]),
    /// A flat plate: its area times drag coefficient (m2), and its normal of length one.
    Plate {
        /// Area times drag coefficient (m2).
        area: f64,
        /// Unit normal, in the part.
        normal: [f64; 3],
    },
    /// Force and moment over the square of the speed, by the direction the stream comes from.
    Coefficients {
        /// Direction in the part (rad, from x toward y), then six coefficients (N s2/m2, N s2/m); directions grow.
        rows: Vec<(f64, [f64; 6])>,
        /// Whether the other side mirrors this one.
        symmetric: bool,
    },
    /// Linear drag: force and moment over velocity and rate, on what moves through the water (N s/m, N s, N m s).
    Drag(Matrix6<f64>),
    /// Linear damping of the body's own motion; no current drives it.
    Damping(Matrix6<f64>),
    /// Added mass (kg, kg m, kg m2).
    AddedMass(Matrix6<f64>),
    /// Buoyancy at a point: the upward force when it is all under water (N), and the sides of the box about the point that it grows
    /// with (m).
    Buoyancy {
        /// The force (N).
        force: f64,
        /// Lengths along the axes of the part (m).
        size: [f64; 3],
    },
    /// A small body in the water.
    Lump(Lump),
    /// A constant force on the axes of space (N).
    Force([f64; 3]),
    /// Eddy damping of the roll of the hull of its part, times this factor.
    EddyDamping(f64),
    /// Damping of the roll of its body about the x axis of the part.
    RollDamping(RollDamping),
    /// Mean wave drift in waves from one direction.
    Drift {
        /// Direction in the part that the waves come from (rad).
        heading: f64,
        /// Period (s), then force and moment over the square of the wave amplitude (N/m2, N/m); periods grow.
        rows: Vec<(f64, [f64; 6])>,
        /// Whether the other side mirrors this one.
        symmetric: bool,
    },
}

/// Damping of roll as it is given; all of it acts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RollDamping {
    /// Moment over the rate (N m s).
    pub linear: f64,
    /// Moment over the square of the rate (N m s2).
    pub quadratic: f64,
    /// Share of the critical damping of roll about the centre of gravity.
    pub critical: f64,
}

/// A small body in the water.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lump {
    /// Its volume (m3).
    pub volume: f64,
    /// Whether its volume has buoyancy: that of a junction has it already.
    pub is_buoyant: bool,
    /// Whether all of it acts wherever the point is, and not the share that is under water.
    pub is_constant: bool,
    /// Drag coefficient times area along the axes of the part (m2).
    pub drag_areas: [f64; 3],
    /// The same against turning about them (m5).
    pub rotary_drag: [f64; 3],
    /// Coefficients of added mass along them, on the displaced mass.
    pub added: [f64; 3],
    /// Whether the acceleration of the water does nothing: waves then act by drag alone.
    pub ignores_water_acceleration: bool,
}

/// A load on a point of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct PartLoad {
    /// Its part.
    pub part: String,
    /// Where it acts, in the part (m).
    pub at: Position,
    /// Wind or current.
    pub fluid: Fluid,
    /// What it is.
    pub kind: LoadKind,
    /// Factors of its force in air and in water; one where none was given.
    pub shape_coefficients: [f64; 2],
    /// Its category.
    pub category: String,
    /// The load group it belongs to; none: that of its part.
    pub group: Option<String>,
    /// Where it was given.
    pub span: Span,
}

impl PartLoad {
    /// One at the origin of a part, in no load group of its own and of the category that records without one have.
    pub fn at_origin(part: &str, kind: LoadKind, span: Span) -> Self {
        PartLoad {
            part: part.to_string(),
            at: [0.0; 3],
            fluid: Fluid::Water,
            kind,
            shape_coefficients: [1.0; 2],
            category: crate::EXTRA.to_string(),
            group: None,
            span,
        }
    }
}

/// Nodes of a part whose loads share a name, which `&APPLY` multiplies.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadGroup {
    /// Its name as written.
    pub name: String,
    /// The part of its nodes.
    pub part: String,
    /// Its nodes; none: those that carry its loads.
    pub nodes: Vec<String>,
    /// Where it was described.
    pub span: Span,
}

impl LoadKind {
    /// The name of its record.
    pub const fn name(&self) -> &'static str {
        match self {
            LoadKind::Area(_) => "#AREA",
            LoadKind::Plate { .. } => "#PLATE",
            LoadKind::Coefficients { .. } => "#TABLE",
            LoadKind::Drag(_) => "#DRAG",
            LoadKind::Damping(_) => "#DAMP",
            LoadKind::AddedMass(_) => "#AMASS",
            LoadKind::Buoyancy { .. } => "#BUOY",
            LoadKind::Lump(_) => "#LUMP",
            LoadKind::Force(_) => "#FORCE",
            LoadKind::EddyDamping(_) => "#TANAKA",
            LoadKind::RollDamping(_) => "#ROLL_DAMPING",
            LoadKind::Drift { .. } => "#DRIFT",
        }
    }
}

/// What of a load category `&APPLY` multiplies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attribute {
    /// Weights.
    Dead,
    /// Buoyancy of `#BUOY` and of members.
    Buoyancy,
    /// Wind.
    Wind,
    /// Current, and linear drag and damping.
    Drag,
    /// Added mass.
    AddedMass,
}

/// A multiplier of the attributes of some categories.
#[derive(Clone, Debug, PartialEq)]
pub struct AttributeMultiplier {
    /// A category, a pattern or a selector.
    pub categories: String,
    /// What it multiplies; none: every attribute.
    pub attribute: Option<Attribute>,
    /// The multiplier.
    pub factor: f64,
}

/// Multipliers of loads: those of a force category, those of all loads of a part or a load group, and those of attributes of load
/// categories. A load has the product of the three.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Multipliers {
    /// By the name of a force category.
    pub categories: IndexMap<String, f64>,
    /// By the name of a part or a load group in upper case.
    pub parts: IndexMap<String, f64>,
    /// Of attributes of load categories; of several that fit the last counts.
    pub attributes: Vec<AttributeMultiplier>,
    /// Margins of the weights of load categories, as factors, beside their multipliers; of several that fit the last counts.
    pub margins: Vec<AttributeMultiplier>,
}

impl Multipliers {
    /// The multiplier of a force category of loads on a part; one where none was given.
    pub fn factor(&self, category: &str, part: &str) -> f64 {
        let one = |table: &IndexMap<String, f64>, name: &str| table.get(name).copied().unwrap_or(1.0);
        one(&self.categories, category) * self.group(part)
    }

    /// The multiplier of a load group, or of the one that every part has; one where none was given.
    pub fn group(&self, name: &str) -> f64 {
        self.parts.get(&name.to_ascii_uppercase()).copied().unwrap_or(1.0)
    }
}

impl Model {
    /// The multiplier of an attribute of a load category; one where none was given.
    pub fn attribute_factor(&self, category: &str, attribute: Attribute) -> f64 {
        let fits = |rule: &&AttributeMultiplier| {
            rule.attribute.is_none_or(|own| own == attribute)
                && match self.selectors.get(&Model::key(&rule.categories)) {
                    Some(selector) => selector.matches(category, self),
                    None => matches(&rule.categories, category),
                }
        };
        let last = |rules: &[AttributeMultiplier]| rules.iter().rev().find(fits).map_or(1.0, |rule| rule.factor);
        last(&self.multipliers.attributes) * last(&self.multipliers.margins)
    }

    /// The multiplier of an attribute of a load: that of its load group or part times that of its category.
    pub fn load_factor(&self, part: &str, group: Option<&str>, category: &str, attribute: Attribute) -> f64 {
        self.multipliers.group(group.unwrap_or(part)) * self.attribute_factor(category, attribute)
    }

    /// The multiplier of an attribute of a member: that of its part times that of its category; one of a piece that is no member.
    pub fn member_factor(&self, part: &str, piece: &crate::Piece, attribute: Attribute) -> f64 {
        piece.category.as_ref().map_or(1.0, |category| self.load_factor(part, None, category, attribute))
    }

    /// The multiplier of an attribute by the category of a member alone; one of a piece that is no member.
    pub fn member_category_factor(&self, piece: &crate::Piece, attribute: Attribute) -> f64 {
        piece.category.as_ref().map_or(1.0, |category| self.attribute_factor(category, attribute))
    }

    /// Gives every weight the multiplier that `&APPLY` says.
    pub fn refresh_weight_multipliers(&mut self) {
        let factors: Vec<Vec<f64>> = self
            .parts
            .values()
            .map(|part| {
                let factor =
                    |w: &crate::Weight| self.load_factor(&part.name, w.group.as_deref(), &w.category, Attribute::Dead);
                part.weights.iter().map(factor).collect()
            })
            .collect();
        for (part, factors) in self.parts.values_mut().zip(factors) {
            for (weight, factor) in part.weights.iter_mut().zip(factors) {
                weight.multiplier = factor;
            }
        }
    }
}
