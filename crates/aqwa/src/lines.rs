//! Mooring lines of deck 14 and the properties they refer to.
//!
//! A property (POLY; SWIR; COMP with its ECAT, ECAX, ECAH, ECAB, BUOY and CLMP cards) serves all NLIN cards that follow it, up
//! to the next one. Sections are listed from the anchor upwards. DWT0 and DWAL serve the LNDW cards that follow them.
//!
//! Source: [AQWA-REF deck 14]; [AQWA-CONN 5.8.3] for what a section holds.

use super::card::Field;
use super::layout::CardRecord;
use super::remarks::Remarks;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Most sections of a composite line.
const MAX_SECTIONS: i64 = 10;
/// Elements of a dynamic line (NLID).
pub const DYNAMIC_ELEMENTS: u32 = 50;
/// Steepest sea bed that is read (degrees): the bed of a CATENARY is at most 10 in 1.
const MAX_SLOPE_DEGREES: f64 = 84.0;
/// Added mass, drag and inline drag coefficients of a section where ECAH leaves them blank [AQWA-CONN 5.8.3.1].
const SECTION_COEFFICIENTS: [f64; 3] = [1.0, 1.0, 0.025];
/// Most points of the table of a composite line.
const MAX_TABLE_POINTS: i64 = 600;

/// Where a line is fixed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// First structure; 0 is the fixed reference.
    pub structure1: Field<i64>,
    /// Node on it.
    pub node1: Field<i64>,
    /// Second structure; 0 is the fixed reference.
    pub structure2: Field<i64>,
    /// Node on it.
    pub node2: Field<i64>,
}

impl Ends {
    /// Structure and node of both ends.
    pub fn numbers(&self) -> [i64; 4] {
        [self.structure1, self.node1, self.structure2, self.node2].map(|field| field.value)
    }
}

/// What a mooring line is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LineKind {
    /// LINE: linear elastic.
    Elastic {
        /// Stiffness (force a length).
        stiffness: f64,
        /// Unstretched length.
        length: f64,
    },
    /// LNDW: linear elastic on a winch.
    Winched {
        /// Stiffness at the start length.
        stiffness: f64,
        /// Length at the start.
        start: f64,
        /// Length at which the winch stops.
        end: f64,
        /// Speed of the drum, positive pays out.
        speed: f64,
        /// Tension above which the drum stands; 0 for none.
        tension: f64,
        /// When the drum begins to turn (DWT0, s).
        begins: f64,
        /// Additional length of the stiffness (DWAL).
        added: f64,
    },
    /// FORC: constant force towards the second node.
    Force(
        /// The force.
        f64,
    ),
    /// WNCH: constant tension.
    Winch {
        /// Tension.
        tension: f64,
        /// Length.
        length: f64,
        /// Friction factor while winding in.
        winding_in: f64,
        /// Friction factor while paying out.
        paying_out: f64,
    },
    /// NLIN, NLID: as the property of this index says.
    Property {
        /// Index of the property.
        property: usize,
        /// Winch tension; 0 for none.
        tension: f64,
        /// Unstretched length, for POLY.
        length: f64,
        /// Friction factor while winding in.
        winding_in: f64,
        /// Friction factor while paying out.
        paying_out: f64,
        /// Whether cable dynamics was asked for (NLID).
        dynamic: bool,
    },
}

/// A pulley on a LINE (PULY).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulley {
    /// Structure and node of the pulley, then of the end of the line behind it.
    pub ends: Ends,
    /// Ratio of the tensions of a line that runs; 1 without friction.
    pub ratio: f64,
    /// The card.
    pub span: Span,
}

/// A mooring line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MooringLine {
    /// Where it is fixed.
    pub ends: Ends,
    /// What it is.
    pub kind: LineKind,
    /// The pulley it runs over.
    pub pulley: Option<Pulley>,
    /// The card.
    pub span: Span,
}

/// A point between two sections of a composite line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompositeJoint {
    /// Whether it is a buoy (BUOY); else a clump weight (CLMP).
    pub buoy: bool,
    /// Mass.
    pub mass: f64,
    /// Mass of the water displaced.
    pub displaced: f64,
    /// Added mass.
    pub added: f64,
    /// Drag coefficient times area.
    pub drag: f64,
    /// The card.
    pub span: Span,
}

/// Added mass and drag of a section (ECAH).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionResistance {
    /// Added mass coefficient.
    pub added_mass: f64,
    /// Drag coefficient.
    pub drag: f64,
    /// Diameter for drag; 0 for that of the area.
    pub diameter: f64,
    /// Inline drag coefficient.
    pub inline: f64,
}

/// A section of a composite line (ECAT and the cards that follow it).
#[derive(Clone, Debug, PartialEq)]
pub struct CompositeSection {
    /// Mass a length.
    pub mass: f64,
    /// Area of the cross-section.
    pub area: f64,
    /// EA; by default 5.0E6 times the mass a length.
    pub stiffness: f64,
    /// Greatest tension; by default 5.0E4 times the mass a length.
    pub tension: f64,
    /// Unstretched length.
    pub length: f64,
    /// ECAX: EA grows by k1 e + k2 e^2 + k3 e^3 with the strain e.
    pub growth: Option<[f64; 3]>,
    /// ECAH in force.
    pub resistance: Option<SectionResistance>,
    /// Whether the ECAH in force is that of a section before.
    pub inherits_resistance: bool,
    /// ECAB: EI; 0 when not given.
    pub bending: f64,
    /// BUOY or CLMP at the upper end.
    pub joint: Option<CompositeJoint>,
    /// The field of a length that is to be found for the pretension of an NLID card; none where the length is given.
    pub found_length: Option<Span>,
    /// The card.
    pub span: Span,
}

/// A composite catenary (COMP).
#[derive(Clone, Debug, PartialEq)]
pub struct Composite {
    /// Vertical levels and horizontal offsets of its table.
    pub points: (i64, i64),
    /// Sections that were announced.
    pub announced: Field<i64>,
    /// Lowest and highest Z of the first attachment.
    pub heights: (f64, f64),
    /// Slope of the sea bed (degrees).
    pub slope: f64,
    /// The sections, from the anchor upwards.
    pub sections: Vec<CompositeSection>,
    /// The card.
    pub span: Span,
}

/// What a non-linear line refers to.
#[derive(Clone, Debug, PartialEq)]
pub enum Property {
    /// POLY: tension P1 e + P2 e^2 + .. + P5 e^5 of the extension e.
    Polynomial([f64; 5]),
    /// SWIR: tension k (e - d tanh(e/d)) of the extension e.
    SteelWire {
        /// Asymptotic stiffness k.
        stiffness: f64,
        /// Asymptotic offset d.
        offset: f64,
    },
    /// COMP with its sections.
    Composite(Composite),
}

/// A line that breaks (LBRK): in LIBR and FER before anything is solved, in DRIF and NAUT during the run [AQWA-REF LBRK].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineBreak {
    /// Number of the spectrum in which it is broken, of LIBR and FER.
    pub spectrum: Field<i64>,
    /// Number of the line, in the order of input.
    pub line: Field<i64>,
    /// Time of the break, or with a tension from which on it may break (s).
    pub time: Field<f64>,
    /// Tensions at the first and the second structure at which it breaks; 0 for none.
    pub tensions: [Field<f64>; 2],
    /// The card.
    pub span: Span,
}

impl LineBreak {
    /// Reads a card LBRK.
    pub fn read(record: &CardRecord, remarks: &mut Remarks) -> LineBreak {
        let spectrum = record.int(11);
        if spectrum.value > 1 {
            remarks.add(
                Diagnostic::error("deck 14, LBRK, columns 11-15: one spectrum is run, the first", spectrum.span)
                    .label("1 or nothing belongs here"),
            );
        }
        LineBreak {
            spectrum,
            line: record.int(16),
            time: record.real(31),
            tensions: [record.real(41), record.real(51)],
            span: record.span,
        }
    }

    /// Whether a time or a tension says when it breaks in a run.
    pub fn has_condition(&self) -> bool {
        self.time.value > 0.0 || self.tensions.iter().any(|field| field.value > 0.0)
    }

    /// The error of one of LIBR or FER that names no spectrum.
    pub fn refuse_without_spectrum(&self) -> Box<Diagnostic> {
        Diagnostic::error("deck 14, LBRK, columns 11-15: this field is blank", self.spectrum.span)
            .label("the number of the spectrum in which the line is broken, of LIBR and FER, belongs here: 1")
            .help("a time and a tension, columns 31-60, are of DRIF and NAUT")
    }

    /// The error of one that has neither a time nor a tension.
    pub fn refuse_without_condition(&self) -> Box<Diagnostic> {
        Diagnostic::error("deck 14, LBRK: neither a time nor a breaking tension is given", self.span)
            .label("the line would break at 0 s")
            .help("a time in columns 31-40, or a tension in 41-50 or 51-60; without the card the line holds")
    }
}

/// The walk through the cards of mooring lines.
#[derive(Clone, Debug, Default)]
pub struct LineCardParser {
    resistance: Option<SectionResistance>,
    /// DWT0 and DWAL in force.
    winching: (f64, f64),
    /// The last property card, while no line refers to it.
    unused_property: Option<(String, Span)>,
    /// DWT0 and DWAL cards that no LNDW card has followed.
    unused_winching: Vec<(String, Span)>,
}

impl LineCardParser {
    /// Takes a card.
    pub fn take(
        &mut self,
        record: &CardRecord,
        properties: &mut Vec<Property>,
        lines: &mut Vec<MooringLine>,
        remarks: &mut Remarks,
    ) {
        let value = |column: usize| record.real(column).value;
        let kind = match record.keyword.as_str() {
            "POLY" => {
                self.begin_property(record, properties, remarks);
                let coefficients = record.reals(31).map(|field| field.value);
                if coefficients == [0.0; 5] {
                    remarks.add(
                        Diagnostic::error("deck 14, POLY, columns 31-80: all coefficients are 0", record.span)
                            .label("a line of this property has no tension"),
                    );
                }
                properties.push(Property::Polynomial(coefficients));
                return;
            }
            "COMP" => {
                self.begin_property(record, properties, remarks);
                properties.push(Property::Composite(composite(record, remarks)));
                self.resistance = None;
                return;
            }
            "SWIR" => {
                self.begin_property(record, properties, remarks);
                let (stiffness, offset) = (value(31), value(41));
                if stiffness <= 0.0 || offset <= 0.0 {
                    remarks.add(
                        Diagnostic::error(
                            "deck 14, SWIR: a steel wire has a stiffness and an offset above 0",
                            record.span,
                        )
                        .label("asymptotic stiffness in columns 31-40, asymptotic offset in 41-50"),
                    );
                }
                properties.push(Property::SteelWire { stiffness, offset });
                return;
            }
            "ECAT" | "ECAX" | "ECAH" | "ECAB" | "BUOY" | "CLMP" => {
                self.section(record, properties, remarks);
                return;
            }
            "PULY" => {
                pulley(record, lines.last_mut(), remarks);
                return;
            }
            "DWT0" | "DWAL" => {
                let field = record.real(31);
                if let Some(earlier) = self.unused_winching.iter().position(|(given, _)| *given == record.keyword) {
                    report_unused(self.unused_winching.remove(earlier), "LNDW", remarks);
                }
                self.unused_winching.push((record.keyword.clone(), record.span));
                if record.keyword == "DWT0" {
                    self.winching.0 = field.value;
                } else {
                    self.winching.1 = field.value;
                }
                return;
            }
            "LINE" => LineKind::Elastic { stiffness: value(31), length: value(41) },
            "LNDW" => {
                self.unused_winching.clear();
                LineKind::Winched {
                    stiffness: value(31),
                    start: value(41),
                    end: value(51),
                    speed: value(61),
                    tension: value(71),
                    begins: self.winching.0,
                    added: self.winching.1,
                }
            }
            "FORC" => LineKind::Force(value(31)),
            "WNCH" => {
                LineKind::Winch { tension: value(31), length: value(41), winding_in: value(51), paying_out: value(61) }
            }
            _ => {
                self.complete(properties, remarks);
                let Some(property) = properties.len().checked_sub(1) else {
                    remarks.add(
                        Diagnostic::error(
                            format!("deck 14, {}: no property comes before this line", record.keyword),
                            record.span,
                        )
                        .help("POLY, SWIR, or COMP with its ECAT cards, belongs before it"),
                    );
                    return;
                };
                self.use_property();
                // NLID is refused but for a composite
                let winch = value(31) > 0.0 || record.keyword == "NLID";
                let has_length = matches!(properties.get(property), Some(Property::Composite(_)));
                if !has_length && !winch && !record.real(41).given {
                    remarks.add(
                        Diagnostic::error(
                            format!("deck 14, {}, columns 41-50: this field is blank", record.keyword),
                            record.real(41).span,
                        )
                        .label("unstretched length belongs here")
                        .help("0.0 is a line that pulls by its whole distance"),
                    );
                }
                LineKind::Property {
                    property,
                    tension: value(31),
                    length: value(41),
                    winding_in: value(51),
                    paying_out: value(61),
                    dynamic: record.keyword == "NLID",
                }
            }
        };
        if let LineKind::Elastic { stiffness, length } = kind
            && (stiffness <= 0.0 || length < 0.0)
        {
            remarks.add(
                Diagnostic::error(
                    "deck 14, LINE: a line has a stiffness above 0 and a length not below 0",
                    record.span,
                )
                .label("stiffness in columns 31-40, unstretched length in 41-50"),
            );
        }
        check_winch(&kind, record, remarks);
        let ends = Ends {
            structure1: record.int(11),
            node1: record.int(16),
            structure2: record.int(21),
            node2: record.int(26),
        };
        lines.push(MooringLine { ends, kind, pulley: None, span: record.span });
    }

    /// Ends the walk.
    pub fn finish(&mut self, properties: &[Property], remarks: &mut Remarks) {
        self.complete(properties, remarks);
        if let Some((keyword, span)) = self.unused_property.take() {
            if properties.len() > 1 {
                report_unused((keyword, span), "NLIN, NLID or FLIN", remarks);
            } else {
                let message = format!("deck 14, {keyword}: no NLIN, NLID or FLIN card refers to this property");
                remarks.add(Diagnostic::warning(message, span).label("it has no effect"));
            }
        }
        for unused in self.unused_winching.drain(..) {
            report_unused(unused, "LNDW", remarks);
        }
    }

    /// A card refers to the last property.
    pub fn use_property(&mut self) {
        self.unused_property = None;
    }

    /// Ends the property before; one that no line refers to stands in the wrong place.
    fn begin_property(&mut self, record: &CardRecord, properties: &[Property], remarks: &mut Remarks) {
        self.complete(properties, remarks);
        if let Some(unused) = self.unused_property.replace((record.keyword.clone(), record.span)) {
            report_unused(unused, "NLIN, NLID or FLIN", remarks);
        }
    }

    /// Checks that the last composite has the sections it announced.
    fn complete(&self, properties: &[Property], remarks: &mut Remarks) {
        let Some(Property::Composite(last)) = properties.last() else { return };
        let found = i64::try_from(last.sections.len()).unwrap_or(i64::MAX);
        if found != last.announced.value {
            let key = format!("sections {}", properties.len());
            let message = format!("deck 14, COMP: {} sections are announced, {found} follow", last.announced.value);
            remarks.add_once(&key, || {
                Diagnostic::error(message, last.announced.span).label("number of sections, columns 26-30")
            });
        } else if let [first, .., top] = last.sections.as_slice() {
            if let Some(section) = last.sections.iter().find(|section| section.inherits_resistance) {
                remarks.add_once("inherited resistance", || {
                    let text = "deck 14, ECAT: this section has no ECAH of its own: that before it holds";
                    Diagnostic::remark(text, section.span)
                });
            }
            remarks.add_once("order of sections", || {
                let text = "deck 14, COMP: its sections are taken in their order from the anchor upwards";
                Diagnostic::remark(text, first.span)
                    .label("the section at the anchor, the second end of a line")
                    .other(top.span, "the section at the fairlead, its first end")
                    .help("assumed: no public page shows a line with the places of its sections")
            });
        }
    }

    fn section(&mut self, record: &CardRecord, properties: &mut [Property], remarks: &mut Remarks) {
        let keyword = record.keyword.as_str();
        let value = |column: usize| record.real(column).value;
        if keyword == "ECAH" {
            let [added_mass, drag, inline] = SECTION_COEFFICIENTS;
            self.resistance = Some(SectionResistance {
                added_mass: record.real(31).value_or(added_mass),
                drag: record.real(51).value_or(drag),
                diameter: value(61),
                inline: record.real(71).value_or(inline),
            });
        }
        let Some(Property::Composite(composite)) = properties.last_mut() else {
            remarks.add(
                Diagnostic::error(format!("deck 14, {keyword}: this is a card of a composite line"), record.span)
                    .label("a COMP card belongs before it"),
            );
            return;
        };
        if keyword == "ECAT" {
            match ecat(record, self.resistance) {
                Ok(section) => composite.sections.push(section),
                Err(error) => remarks.add(error),
            }
            return;
        }
        let Some(section) = composite.sections.last_mut() else {
            if keyword != "ECAH" {
                remarks.add(
                    Diagnostic::error(format!("deck 14, {keyword}: there is no section yet"), record.span)
                        .label("an ECAT card belongs before it"),
                );
            }
            return;
        };
        match keyword {
            "ECAX" => section.growth = Some([value(31), value(41), value(51)]),
            "ECAH" => {
                section.resistance = self.resistance;
                section.inherits_resistance = false;
            }
            "ECAB" => section.bending = value(31),
            _ => {
                let (mass, displaced) = (value(31), value(41));
                let (wrong, side) =
                    if keyword == "BUOY" { (mass >= displaced, "below") } else { (mass <= displaced, "above") };
                if wrong {
                    let message =
                        format!("deck 14, {keyword}: a mass of {mass} is not {side} the displaced mass of {displaced}");
                    remarks.add(
                        Diagnostic::error(message, record.span)
                            .label("mass in columns 31-40, displaced mass in 41-50")
                            .help("a buoy weighs less than the water it displaces, a clump weight more"),
                    );
                }
                section.joint = Some(CompositeJoint {
                    buoy: keyword == "BUOY",
                    mass: value(31),
                    displaced: value(41),
                    added: value(51),
                    drag: value(61),
                    span: record.span,
                });
            }
        }
    }
}

/// Refuses a card that serves those behind it, where none of them follows: it stands in the wrong place.
fn report_unused((keyword, span): (String, Span), followers: &str, remarks: &mut Remarks) {
    remarks.add(
        Diagnostic::error(format!("deck 14, {keyword}: no {followers} card follows that it would serve"), span)
            .label("it has no effect here")
            .help("it belongs before the lines it is for; leave it out if there are none"),
    );
}

/// Puts a pulley on the last line.
fn pulley(record: &CardRecord, line: Option<&mut MooringLine>, remarks: &mut Remarks) {
    let mut refuse = |message: String, span: Span, help: &str| {
        remarks.add(Diagnostic::error(format!("deck 14, PULY: {message}"), span).help(help));
    };
    let Some(line) = line.filter(|line| matches!(line.kind, LineKind::Elastic { length, .. } if length > 0.0)) else {
        return refuse(
            "no LINE with a length comes before this pulley".into(),
            record.span,
            "a pulley is on the LINE before it",
        );
    };
    if line.pulley.is_some() {
        return refuse("a line over two pulleys is not modelled".into(), record.span, "one pulley a line is");
    }
    for (column, columns) in [(31, "31-40, angle"), (41, "41-50, radius")] {
        let field = record.real(column);
        if field.value != 0.0 {
            let message = format!("columns {columns}: {} is not modelled", field.value);
            return refuse(message, field.span, "the pulley is a point here: leave the field blank");
        }
    }
    let ends =
        Ends { structure1: record.int(11), node1: record.int(16), structure2: record.int(21), node2: record.int(26) };
    let [structure, node, behind, _] = ends.numbers();
    let [.., second, last] = line.ends.numbers();
    if (structure, node) != (second, last) {
        let message = format!(
            "the pulley is at node {node} of structure {structure}, the line ends at node {last} of structure {second}"
        );
        return refuse(
            message,
            record.span,
            "assumed: columns 11-20 repeat the second end of the LINE, columns 21-30 are the end behind the pulley",
        );
    }
    if behind != structure {
        return refuse(
            "a line over a pulley between two structures is not modelled".into(),
            record.span,
            "the pulley and the end behind it are on one structure, as fairlead and winch are",
        );
    }
    let given = [51, 61].map(|column| record.real(column));
    if let Some(wrong) = given.iter().find(|field| field.given && field.value != 0.0 && field.value < 1.0) {
        return refuse(
            format!("{} is no ratio of tensions T2/T1", wrong.value),
            wrong.span,
            "1 or more belongs in columns 51-60 and 61-70",
        );
    }
    // the sheave turns or the line slides over it, whichever is easier
    let ratio = given.iter().map(|field| field.value).filter(|ratio| *ratio > 0.0).reduce(f64::min).unwrap_or(1.0);
    line.pulley = Some(Pulley { ends, ratio, span: record.span });
}

/// What the numbers of a winch must be.
fn check_winch(kind: &LineKind, record: &CardRecord, remarks: &mut Remarks) {
    match *kind {
        LineKind::Winched { stiffness, start, end, speed, tension, .. } => {
            let wrong =
                [("31-40", "stiffness", stiffness), ("41-50", "initial length", start), ("51-60", "final length", end)];
            for (columns, what, value) in wrong {
                if value <= 0.0 {
                    let message = format!("deck 14, LNDW, columns {columns}: the {what} is above 0");
                    remarks.add(Diagnostic::error(message, record.span).label(format!("{value} stands here")));
                }
            }
            if speed * (end - start) < 0.0 || (speed != 0.0 && end == start) {
                let (turns, wanted) = if speed > 0.0 { ("pays out", "above") } else { ("winds in", "below") };
                remarks.add(
                    Diagnostic::warning("deck 14, LNDW: this drum never turns", record.span)
                        .label(format!(
                            "it {turns} from {start} to {end}: the final length, columns 51-60, is not {wanted} the initial one"
                        ))
                        .help("a positive speed, columns 61-70, pays out up to the final length, a negative one winds in down to it"),
                );
            }
            if speed == 0.0 || tension < 0.0 {
                remarks.add(
                    Diagnostic::error(
                        "deck 14, LNDW: a drum has a speed, and a greatest tension not below 0",
                        record.span,
                    )
                    .label("speed in columns 61-70, greatest tension in 71-80"),
                );
            }
        }
        LineKind::Winch { tension, length, winding_in, paying_out }
        | LineKind::Property { tension, length, winding_in, paying_out, .. } => {
            let friction = winding_in.abs() >= 1.0 || paying_out < 0.0;
            if tension < 0.0 || length < 0.0 || friction {
                remarks.add(
                    Diagnostic::error(
                        format!(
                            "deck 14, {}: tension and length are not below 0, friction factors are",
                            record.keyword
                        ) + " below 1 winding in and not below 0 paying out",
                        record.span,
                    )
                    .label("tension in columns 31-40, length in 41-50, friction in 51-60 and 61-70"),
                );
            }
        }
        LineKind::Elastic { .. } | LineKind::Force(_) => {}
    }
}

fn composite(record: &CardRecord, remarks: &mut Remarks) -> Composite {
    let points = (record.int(11).value_or(15), record.int(16).value_or(40));
    let announced = record.int(26);
    if !(1..=MAX_SECTIONS).contains(&announced.value) {
        remarks.add(
            Diagnostic::error(
                format!("deck 14, COMP, columns 26-30: {} is not a valid number of sections", announced.value),
                announced.span,
            )
            .label(format!("1 to {MAX_SECTIONS} belongs here")),
        );
    }
    if points.0 < 1 || points.1 < 1 || points.0.saturating_mul(points.1) > MAX_TABLE_POINTS {
        remarks.add(
            Diagnostic::error(format!("deck 14, COMP: a table of {} by {} points", points.0, points.1), record.span)
                .label(format!("columns 11-15 times columns 16-20 is 1 to {MAX_TABLE_POINTS}")),
        );
    }
    let whole = [11, 16, 21].map(|column| (record.int(column).given, record.int(column).span));
    let heights = [31, 41].map(|column| (record.real(column).given, record.real(column).span));
    if let Some((_, span)) = whole.into_iter().chain(heights).find(|(given, _)| *given) {
        remarks.add_once("table of a composite", || {
            Diagnostic::remark("deck 14, COMP: no table is made; a line is solved exactly at each position", span)
                .label("columns 11-25 and 31-50 describe the table, its warnings and its symmetry: they limit nothing and change no result")
        });
    }
    let [lowest, highest] = [record.real(31), record.real(41)];
    if lowest.given && highest.given && lowest.value > highest.value {
        remarks.add(
            Diagnostic::error(
                format!(
                    "deck 14, COMP, columns 31-50: the lowest Z, {}, is above the highest, {}",
                    lowest.value, highest.value
                ),
                lowest.span,
            )
            .label("Z of the first attachment, lowest in columns 31-40, highest in 41-50"),
        );
    }
    let slope = record.real(51);
    if slope.value.abs() >= MAX_SLOPE_DEGREES {
        remarks.add(
            Diagnostic::error(
                format!("deck 14, COMP, columns 51-60: {} is no slope of a sea bed", slope.value),
                slope.span,
            )
            .label(format!("degrees, between -{MAX_SLOPE_DEGREES} and {MAX_SLOPE_DEGREES}")),
        );
    } else if slope.value != 0.0 {
        remarks.add_once("slope of a composite", || {
            Diagnostic::remark("deck 14, COMP, columns 51-60: no source gives the sign of the slope", slope.span)
                .label("assumed: degrees, positive where the bed rises from the anchor toward the structure")
        });
    }
    Composite {
        points,
        announced,
        heights: (record.real(31).value, record.real(41).value),
        slope: record.real(51).value,
        sections: Vec::new(),
        span: record.span,
    }
}

fn ecat(record: &CardRecord, resistance: Option<SectionResistance>) -> Result<CompositeSection, Box<Diagnostic>> {
    let (mass, length) = (record.real(31), record.real(71));
    if mass.value <= 0.0 {
        return Err(Diagnostic::error(
            "deck 14, ECAT, columns 31-40: a section has a mass a length above 0",
            mass.span,
        ));
    }
    if length.value < 1.0 {
        return Err(Diagnostic::error("deck 14, ECAT, columns 71-80: a section is at least 1 long", length.span));
    }
    Ok(CompositeSection {
        mass: mass.value,
        area: record.real(41).value,
        stiffness: record.real(51).value_or(5.0e6 * mass.value),
        tension: record.real(61).value_or(5.0e4 * mass.value),
        length: length.value,
        growth: None,
        resistance,
        inherits_resistance: resistance.is_some(),
        bending: 0.0,
        joint: None,
        found_length: Some(record.int(26)).filter(|flag| flag.value != 0).map(|flag| flag.span),
        span: record.span,
    })
}
