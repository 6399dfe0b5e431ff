//! Decks 3 to 5: materials, geometries, and the water.
//!
//! Source: [AQWA-REF decks 3, 4, 5]; [AQWA-TETHER 8.1.3 to 8.1.5] and the listing's card echo.

use super::card::Field;
use super::elements::ElementShape;
use super::layout::{CardLayout, CardRecord, Slot, int, num};
use super::remarks::Remarks;
use indexmap::IndexMap;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Drag coefficient of a TUBE without a CONT card (assumed: [AQWA-REF deck 4] speaks of defaults, its values were not
/// seen; both decks of [AQWA-TETHER 8] give these).
pub const DEFAULT_DRAG: f64 = 0.75;
/// Added mass coefficient of a TUBE without a CONT card (assumed as [`DEFAULT_DRAG`]).
pub const DEFAULT_ADDED_MASS: f64 = 1.0;

/// Cards of deck 3.
pub const MATERIALS: &[CardLayout] = &[CardLayout::new(
    "",
    &[
        int("material group", 16),
        num("density or mass", 21).not_below_zero(),
        num("Young's modulus or second property", 31).not_below_zero(),
        num("third property", 41).not_below_zero(),
    ],
)
.freely()];

const DOF_SLOTS: &[Slot] = &[
    int("geometry group", 16),
    num("parameter 1 (diameter; Ixx)", 21),
    num("parameter 2 (wall thickness; Ixy)", 31),
    num("parameter 3 (Ixz)", 41),
    num("parameter 4 (Iyy)", 51),
    num("parameter 5 (Iyz)", 61),
    num("parameter 6 (Izz)", 71),
];

/// Cards of deck 4.
pub const GEOMETRIES: &[CardLayout] = &[
    CardLayout::new("TUBE", DOF_SLOTS).freely(),
    CardLayout::new("PMAS", DOF_SLOTS).freely(),
    CardLayout::assume("STUB", DOF_SLOTS).freely(),
    CardLayout::assume("DISC", DOF_SLOTS).freely(),
    CardLayout::new(
        "CONT",
        &[
            num("drag coefficient", 21).not_below_zero().or("0.75"),
            num("added mass coefficient", 31).not_below_zero().or("1.0"),
        ],
    )
    .freely(),
];

/// Cards of deck 5.
pub const GLOBALS: &[CardLayout] = &[
    CardLayout::new("DPTH", &[num("depth of water", 11)]),
    CardLayout::new("DENS", &[num("density of water", 11)]),
    CardLayout::new("ACCG", &[num("acceleration due to gravity", 11)]),
];

/// A material group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialCard {
    /// TUBE: density, Young's modulus (tethers). PMAS: mass. STUB: mass and two inertias a length. PBOY: displaced mass.
    pub properties: [Field<f64>; 3],
    /// The card.
    pub span: Span,
}

/// A geometry group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// Kind of element it is for.
    pub shape: ElementShape,
    /// Number of the group.
    pub group: i64,
    /// TUBE: diameter, wall thickness. PMAS: Ixx, Ixy, Ixz, Iyy, Iyz, Izz about the centre of gravity.
    pub parameters: [Field<f64>; 6],
    /// Drag coefficient of the CONT card.
    pub drag: Option<Field<f64>>,
    /// Added mass coefficient of the CONT card.
    pub added_mass: Option<Field<f64>>,
    /// The card.
    pub span: Span,
}

impl Geometry {
    /// The drag coefficient in force (no unit).
    pub fn drag(&self) -> f64 {
        self.drag.map_or(DEFAULT_DRAG, |given| given.value_or(DEFAULT_DRAG))
    }

    /// The added mass coefficient in force (no unit).
    pub fn added_mass(&self) -> f64 {
        self.added_mass.map_or(DEFAULT_ADDED_MASS, |given| given.value_or(DEFAULT_ADDED_MASS))
    }
}

/// The water and gravity, in the units of the deck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterAndGravity {
    /// Depth.
    pub depth: f64,
    /// Density of the water.
    pub density: f64,
    /// Acceleration due to gravity; it shows the unit of length.
    pub gravity: f64,
    /// Where the depth was given.
    pub depth_span: Option<Span>,
    /// Where gravity was given.
    pub gravity_span: Option<Span>,
    /// Where the density was given.
    pub density_span: Option<Span>,
}

impl Default for WaterAndGravity {
    fn default() -> Self {
        WaterAndGravity {
            depth: 1000.0,
            density: 1025.0,
            gravity: 9.81,
            depth_span: None,
            gravity_span: None,
            density_span: None,
        }
    }
}

/// Materials by group.
pub type Materials = IndexMap<i64, MaterialCard>;

/// Geometries by the kind of element and the group: groups of different kinds may have the same number.
pub type Geometries = IndexMap<(ElementShape, i64), Geometry>;

/// The materials of the cards of deck 3.
pub fn read_materials(records: &[CardRecord], remarks: &mut Remarks) -> Materials {
    let mut list = Materials::new();
    for record in records {
        let group = record.int(16);
        if group.value <= 0 {
            remarks.add(
                Diagnostic::error("deck 3, columns 16-20: a material group has a number from 1 on", group.span)
                    .label("material group"),
            );
            continue;
        }
        if let Some(earlier) = list.get(&group.value) {
            let earlier: &MaterialCard = earlier;
            remarks.add(
                Diagnostic::error(format!("deck 3: material group {} is given twice", group.value), group.span)
                    .other(earlier.span, "given here first"),
            );
            continue;
        }
        list.insert(group.value, MaterialCard { properties: record.reals(21), span: record.span });
    }
    list
}

/// The geometries of the cards of deck 4.
pub fn read_geometries(records: &[CardRecord], remarks: &mut Remarks) -> Geometries {
    let mut list = Geometries::new();
    // what a CONT card continues: the card directly before it
    let mut continued = None;
    for record in records {
        let Some(shape) = ElementShape::from_keyword(&record.keyword) else {
            match continued.take().and_then(|key| list.get_mut(&key)) {
                Some(geometry) => {
                    geometry.drag = Some(record.real(21));
                    geometry.added_mass = Some(record.real(31));
                }
                None => remarks.add(
                    Diagnostic::error("deck 4, CONT: there is no card that this one continues", record.span)
                        .label("a TUBE, STUB or DISC card belongs directly before it"),
                ),
            }
            continue;
        };
        let group = record.int(16);
        if group.value <= 0 {
            let message = format!("deck 4, {}, columns 16-20: a geometry group has a number from 1 on", record.keyword);
            remarks.add(Diagnostic::error(message, group.span).label("geometry group"));
        }
        let key = (shape, group.value);
        continued = (shape != ElementShape::PointMass).then_some(key);
        if let Some(earlier) = list.get(&key) {
            let message = format!("deck 4: {} group {} is given twice", record.keyword, group.value);
            remarks.add(Diagnostic::error(message, group.span).other(earlier.span, "given here first"));
            continue;
        }
        let parameters = record.reals(21);
        let geometry =
            Geometry { shape, group: group.value, parameters, drag: None, added_mass: None, span: record.span };
        match shape {
            ElementShape::Tube => check_tube(&geometry, remarks),
            ElementShape::PointMass => check_inertia(&geometry, remarks),
            _ => {}
        }
        list.insert(key, geometry);
    }
    list
}

/// Moments of inertia are not below 0; products may be.
fn check_inertia(geometry: &Geometry, remarks: &mut Remarks) {
    for (index, name) in [(0, "Ixx"), (3, "Iyy"), (5, "Izz")] {
        let Some(inertia) = geometry.parameters.get(index).filter(|inertia| inertia.value < 0.0) else { continue };
        let (first, last) = (21 + 10 * index, 30 + 10 * index);
        let message = format!("deck 4, PMAS, columns {first}-{last}: an {name} of {} is below 0", inertia.value);
        remarks.add(Diagnostic::error(message, inertia.span).label("a moment of inertia is 0 or above"));
    }
}

fn check_tube(geometry: &Geometry, remarks: &mut Remarks) {
    let [diameter, wall, ..] = geometry.parameters;
    if diameter.value <= 0.0 {
        remarks.add(
            Diagnostic::error("deck 4, TUBE, columns 21-30: a tube has a diameter above 0", diameter.span)
                .label("diameter"),
        );
    } else if wall.value < 0.0 || wall.value > diameter.value / 2.0 {
        remarks.add(
            Diagnostic::error("deck 4, TUBE, columns 31-40: a wall is between 0 and half the diameter", wall.span)
                .label("wall thickness"),
        );
    }
    if let Some(other) = geometry.parameters.iter().skip(2).find(|p| p.value != 0.0) {
        remarks.add_once("tube parameters", || {
            Diagnostic::warning(
                "deck 4, TUBE: parameters 3 to 6 (cuts and ends of the tube) have no effect",
                other.span,
            )
            .label("the ends are taken as closed and uncut")
        });
    }
}

/// The water of the cards of deck 5.
pub fn read_global(records: &[CardRecord], remarks: &mut Remarks) -> WaterAndGravity {
    let mut global = WaterAndGravity::default();
    for record in records {
        let value = record.real(11);
        if value.given && value.value <= 0.0 {
            let message = format!("deck 5, {}, columns 11-20: {} is not above 0", record.keyword, value.value);
            let (what, help) = match record.keyword.as_str() {
                "DPTH" => {
                    ("depth of water", "the depth is measured down from the still water level: 100.0 is 100 deep")
                }
                "DENS" => ("density of water", "the unit of mass over the unit of length cubed: 1025.0 or 1.025"),
                _ => ("acceleration due to gravity", "it is counted downward: 9.81 or 32.2"),
            };
            remarks.add(Diagnostic::error(message, value.span).label(format!("{what} belongs here")).help(help));
            continue;
        }
        if !value.given {
            let message =
                format!("deck 5, {}, columns 11-20: this field is blank and the default is taken", record.keyword);
            remarks.add(Diagnostic::remark(message, record.span));
        }
        match record.keyword.as_str() {
            "DPTH" => {
                global.depth = value.value_or(global.depth);
                global.depth_span = Some(value.span);
            }
            "DENS" => {
                global.density = value.value_or(global.density);
                global.density_span = Some(value.span);
            }
            _ => {
                global.gravity = value.value_or(global.gravity);
                global.gravity_span = Some(value.span);
            }
        }
    }
    for (keyword, unset) in [("DPTH", 1000.0), ("DENS", 1025.0), ("ACCG", 9.81)] {
        // a card that could not be read is none of which a default is taken
        if !remarks.has_error() && !records.iter().any(|record| record.keyword == keyword) {
            remarks.add_once(keyword, || {
                Diagnostic::plain(
                    windlass_base::diagnostic::Severity::Note,
                    format!("deck 5 has no {keyword} card: {unset} is taken"),
                )
                .into()
            });
        }
    }
    global
}
