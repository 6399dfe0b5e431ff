//! The typed model: environment, line types, vessels, lines. Values are in the units of the file: m, te, kN, s, deg.

use crate::data::{Data, Given};
use crate::yaml::{Entry, Node};
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};
use windlass_base::span::Span;

/// A model that was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextModel {
    /// The water.
    pub environment: Environment,
    /// LineTypes.
    pub line_types: Vec<LineType>,
    /// Vessels.
    pub vessels: Vec<Vessel>,
    /// Lines.
    pub lines: Vec<Line>,
}

/// A sea.
#[derive(Clone, Debug, PartialEq)]
pub enum WaveTrain {
    /// A linear wave.
    Airy {
        /// Direction it travels toward (deg).
        toward: f64,
        /// Height (m).
        height: f64,
        /// Period (s).
        period: f64,
        /// The place of its type.
        span: Span,
    },
    /// A JONSWAP sea.
    Jonswap {
        /// Direction it travels toward (deg).
        toward: f64,
        /// Significant height (m).
        height: f64,
        /// Peak period (s).
        period: f64,
        /// Peak enhancement.
        gamma: f64,
        /// The place of its type.
        span: Span,
    },
}

/// Environment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Environment {
    /// The place of its name; none of a model without one.
    pub span: Option<Span>,
    /// Depth (m).
    pub depth: Option<Given<f64>>,
    /// Density of the water (te/m3).
    pub density: Option<Given<f64>>,
    /// Normal stiffness of the seabed (kN/m/m2).
    pub seabed_stiffness: Option<Given<f64>>,
    /// Waves; those of no height are left out.
    pub waves: Vec<WaveTrain>,
    /// Speed (m/s) and direction it flows toward (deg).
    pub current: Option<[Given<f64>; 2]>,
    /// Depth (m), factor and rotation (deg).
    pub current_profile: Vec<[f64; 3]>,
    /// Speed (m/s) and direction it blows toward (deg).
    pub wind: Option<[Given<f64>; 2]>,
}

/// A line type.
#[derive(Clone, Debug, PartialEq)]
pub struct LineType {
    /// Its name.
    pub name: Given<String>,
    /// Outer diameter (m).
    pub outer: Given<f64>,
    /// Inner diameter (m).
    pub inner: f64,
    /// Mass without contents (te/m).
    pub mass: Given<f64>,
    /// Axial stiffness (kN).
    pub ea: Given<f64>,
    /// Bending stiffness (kN m2).
    pub ei: f64,
    /// Drag coefficients across and along, the latter on pi times the diameter.
    pub drag: [f64; 2],
    /// Added-mass coefficients across and along.
    pub added: [f64; 2],
    /// Diameter for drag across (m); none: the outer one.
    pub drag_diameter: Option<f64>,
    /// Friction on the seabed.
    pub friction: f64,
}

/// A vessel, by its place alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Vessel {
    /// Its name.
    pub name: Given<String>,
    /// X, Y, Z (m).
    pub position: [f64; 3],
    /// Heel, trim, heading (deg).
    pub orientation: [f64; 3],
}

/// What an end of a line is held by.
#[derive(Clone, Debug, PartialEq)]
pub enum Holder {
    /// A place in space.
    Fixed,
    /// The seabed, above which Z counts.
    Anchored,
    /// The vessel of this name, in its axes.
    Vessel(String),
}

/// An end of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct LineEnd {
    /// What holds it.
    pub holder: Given<Holder>,
    /// X, Y, Z (m).
    pub at: [f64; 3],
}

/// A section of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// The name of its line type.
    pub line_type: Given<String>,
    /// Unstretched length (m).
    pub length: Given<f64>,
    /// Segments.
    pub segments: usize,
}

/// A line.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Its name.
    pub name: Given<String>,
    /// Ends A and B.
    pub ends: [LineEnd; 2],
    /// Sections from end A.
    pub sections: Vec<Section>,
    /// Density of the contents (te/m3).
    pub contents: f64,
}

/// Sections whose objects load nothing by themselves, or are told by others.
const SILENT_SECTIONS: &[&str] = &[
    "VesselTypes",
    "Groups",
    "VariableData",
    "BrowserGroups",
    "RayleighDampingCoefficients",
    "SupportTypes",
    "DrawingData",
];
/// Most segments of a section.
const MAX_SEGMENTS: f64 = 1e5;
/// Segments of a section that says nothing of them.
const DEFAULT_SEGMENTS: usize = 20;

/// Reads what the tree of a file says.
pub(crate) fn read(tree: &Node, messages: &mut Vec<Diagnostic>) -> TextModel {
    let mut made = TextModel::default();
    if let Err(error) = sections(tree, &mut made, messages) {
        messages.push(*error);
    }
    names_once(made.line_types.iter().map(|kind| &kind.name), "line type", messages);
    names_once(made.vessels.iter().map(|vessel| &vessel.name), "vessel", messages);
    names_once(made.lines.iter().map(|line| &line.name), "line", messages);
    check_names(&made, messages);
    made
}

fn sections(tree: &Node, made: &mut TextModel, messages: &mut Vec<Diagnostic>) -> Outcome<()> {
    let mut data = Data::new(tree, "the file")?;
    if let Some(node) = data.node("General") {
        keep(general(node, messages), messages);
    }
    if let Some(entry) = data.entry("Environment")
        && let Some(found) = keep(environment(&entry.value, messages), messages)
    {
        made.environment = Environment { span: Some(entry.span), ..found };
    }
    made.line_types = objects(&mut data, "LineTypes", line_type, messages);
    made.vessels = objects(&mut data, "Vessels", vessel, messages);
    made.lines = objects(&mut data, "Lines", line, messages);
    if made.lines.is_empty() && messages.is_empty() {
        return Err(Diagnostic::error("the model has no Lines", tree.span).label("expected a section Lines"));
    }
    let mut silent = Vec::new();
    for entry in data.left() {
        if SILENT_SECTIONS.contains(&entry.name.as_str()) {
            silent.push(entry);
        } else if !entry.value.items().is_empty() || !entry.value.entries().is_empty() || entry.name == "includefile" {
            let known = ["General", "Environment", "LineTypes", "Vessels", "Lines"];
            let error = Diagnostic::error(format!("{} is not read: its loads would be lost", entry.name), entry.span);
            messages.push(match suggest(&entry.name, known) {
                Some(help) => *error.help(help),
                None => *error.help(format!("read are {}", known.join(", "))),
            });
        }
    }
    note_unused("sections", &silent, messages);
    Ok(())
}

/// A result, its error among the messages.
fn keep<T>(result: Outcome<T>, messages: &mut Vec<Diagnostic>) -> Option<T> {
    result.map_err(|error| messages.push(*error)).ok()
}

type Reader<T> = fn(&mut Data<'_>, &mut Vec<Diagnostic>) -> Outcome<T>;

fn objects<T>(data: &mut Data<'_>, section: &str, reader: Reader<T>, messages: &mut Vec<Diagnostic>) -> Vec<T> {
    let Some(node) = data.node(section) else { return Vec::new() };
    let mut made = Vec::new();
    for item in node.items() {
        let read = Data::new(item, section).and_then(|mut own| {
            let value = reader(&mut own, messages)?;
            note_unused(section, &own.left(), messages);
            Ok(value)
        });
        made.extend(keep(read, messages));
    }
    made
}

/// A note that names what does nothing here, at the first of it.
fn note_unused(what: &str, left: &[&Entry], messages: &mut Vec<Diagnostic>) {
    let Some(first) = left.first() else { return };
    let names: Vec<&str> = left.iter().map(|entry| entry.name.as_str()).collect();
    let text = format!("{what}: not used: {}", names.join("; "));
    if !messages.iter().any(|message| message.message == text) {
        messages.push(*Diagnostic::remark(text, first.span));
    }
}

fn name(data: &mut Data<'_>, what: &str) -> Outcome<Given<String>> {
    let given = data
        .word("Name")?
        .ok_or_else(|| Diagnostic::error(format!("{what} has no Name"), data.span).label("expected Name"))?;
    Ok(Given { value: given.value.to_string(), span: given.span })
}

fn general(node: &Node, messages: &mut Vec<Diagnostic>) -> Outcome<()> {
    let mut data = Data::new(node, "General")?;
    data.only("UnitsSystem", &["SI"], "values are taken in m, te, kN")?;
    note_unused("General", &data.left(), messages);
    Ok(())
}

fn environment(node: &Node, messages: &mut Vec<Diagnostic>) -> Outcome<Environment> {
    let mut data = Data::new(node, "Environment")?;
    data.zero("WaterSurfaceZ", "heights count from the water surface")?;
    data.only("VerticalDensityVariation", &["Constant"], "water has one density")?;
    data.only("SeabedType", &["Flat"], "give the bottom by &BATHYMETRY")?;
    data.zero("SeabedSlope", "give the bottom by &BATHYMETRY")?;
    data.only("SeabedModel", &["Elastic"], "the seabed is elastic")?;
    data.only("HorizontalCurrentFactor", &["~"], "the current is the same at every place")?;
    let depth = match data.number("WaterDepth")? {
        Some(given) => Some(given),
        None => data.number("SeabedOriginDepth")?,
    };
    if let Some(given) = depth.as_ref().filter(|given| given.value <= 0.0) {
        return Err(
            Diagnostic::error(format!("the depth is {}", given.value), given.span).label("must be greater than 0")
        );
    }
    let density = data.number("Density")?;
    if let Some(given) = density.as_ref().filter(|given| given.value <= 0.0) {
        return Err(
            Diagnostic::error(format!("Density is {}", given.value), given.span).label("must be greater than 0")
        );
    }
    let seabed_stiffness = data.number("SeabedNormalStiffness")?.filter(|given| given.value > 0.0);
    let mut waves = Vec::new();
    if let Some(list) = data.node("WaveTrains") {
        for item in list.items() {
            let mut own = Data::new(item, "WaveTrains")?;
            waves.extend(wave_train(&mut own)?);
            note_unused("WaveTrains", &own.left(), messages);
        }
    }
    let speed = data.not_negative("RefCurrentSpeed")?.filter(|given| given.value != 0.0);
    let toward = data.number("RefCurrentDirection")?.unwrap_or_default();
    let mut current_profile = Vec::new();
    if let Some(rows) = data.table("CurrentDepth")? {
        for row in &rows.rows {
            let depth = rows.needed(row, "CurrentDepth")?.value;
            let factor = rows.needed(row, "CurrentFactor")?.value;
            let turned = rows.number(row, "CurrentRotation")?.map_or(0.0, |given| given.value);
            if current_profile.last().is_some_and(|[last, ..]: &[f64; 3]| *last >= depth) {
                return Err(Diagnostic::error("CurrentDepth must grow from row to row", row.span));
            }
            current_profile.push([depth, factor, turned]);
        }
    }
    if speed.is_some() {
        data.only("CurrentModel", &["Variation scheme"], "its current would be lost")?;
        data.only("VerticalCurrentVariationMethod", &["Interpolated"], "its current would be lost")?;
        data.only("MultipleCurrentDataCanBeDefined", &["No"], "its currents would be lost")?;
    }
    let wind_speed = data.number("WindSpeed")?.filter(|given| given.value != 0.0);
    let wind_toward = data.number("WindDirection")?.unwrap_or_default();
    if wind_speed.is_some() {
        data.only("WindType", &["Constant"], "its wind would be lost")?;
    }
    note_unused("Environment", &data.left(), messages);
    Ok(Environment {
        span: None,
        depth,
        density,
        seabed_stiffness,
        waves,
        current: speed.map(|speed| [speed, toward]),
        current_profile,
        wind: wind_speed.map(|speed| [speed, wind_toward]),
    })
}

fn wave_train(data: &mut Data<'_>) -> Outcome<Option<WaveTrain>> {
    let Some(kind) = data.word("WaveType")? else { return Ok(None) };
    let toward = data.number("WaveDirection")?.map_or(0.0, |given| given.value);
    let span = kind.span;
    let lacks = |what: &str| Diagnostic::error(format!("the {} wave has no {what}", kind.value), span);
    match kind.value {
        "Airy" | "Single Airy" => {
            let height = data.number("WaveHeight")?.ok_or_else(|| lacks("WaveHeight"))?.value;
            if height == 0.0 {
                return Ok(None);
            }
            let period = data.size("WavePeriod", "the wave")?.value;
            Ok(Some(WaveTrain::Airy { toward, height, period, span }))
        }
        "JONSWAP" => {
            let height = data.number("WaveHs")?.ok_or_else(|| lacks("WaveHs"))?.value;
            if height == 0.0 {
                return Ok(None);
            }
            let period = data.size("WaveTp", "the wave")?.value;
            let gamma = data.size("WaveGamma", "the wave")?.value;
            Ok(Some(WaveTrain::Jonswap { toward, height, period, gamma, span }))
        }
        other => {
            // of no height it loads nothing
            let heights = [data.number("WaveHeight")?, data.number("WaveHs")?];
            if heights.iter().flatten().next().is_some() && heights.iter().flatten().all(|given| given.value == 0.0) {
                return Ok(None);
            }
            let error =
                Diagnostic::error(format!("a wave train of type {other} is not read: its loads would be lost"), span);
            Err(error
                .label("expected Airy or JONSWAP")
                .help("give it height 0, and the sea by -SEA of &ENV: REGULAR, STOKES, spectra"))
        }
    }
}

fn line_type(data: &mut Data<'_>, _: &mut Vec<Diagnostic>) -> Outcome<LineType> {
    let name = name(data, "a line type")?;
    data.only("Category", &["General"], "its section would be lost")?;
    let outer = data.size("OD", "the line type")?;
    let inner = data.number("ID")?.map_or(0.0, |given| given.value);
    if !(0.0..outer.value).contains(&inner) {
        return Err(Diagnostic::error(format!("ID {inner} is not within OD {}", outer.value), outer.span));
    }
    let mass = data.size("MassPerUnitLength", "the line type")?;
    let ea = data.size("EA", "the line type")?;
    let [ei, across] = data.numbers("EI", [0.0, f64::NAN])?;
    let uneven = |a: f64, b: f64| !b.is_nan() && a != b;
    if uneven(ei, across) {
        return Err(Diagnostic::error(
            format!("EI {ei} and {across}: a line bends alike in all directions"),
            name.span,
        ));
    }
    data.zero("CentreOfMass", "the mass of a line is in its middle")?;
    data.only("BulkModulus", &["Infinity"], "lines do not change their volume")?;
    data.zero("Cl", "lift is not computed")?;
    data.zero("Cs", "slamming is not computed")?;
    data.zero("TensionTorqueCoupling", "lines have no torsion")?;
    data.only("ExpansionTable", &["None"], "lines have no expansion by a table")?;
    let [cd, cdy, cd_axial] = data.numbers("Cd", [1.2, f64::NAN, 0.0])?;
    let [ca, cay, ca_axial] = data.numbers("Ca", [1.0, f64::NAN, 0.0])?;
    if uneven(cd, cdy) || uneven(ca, cay) {
        return Err(Diagnostic::error("drag or added mass in x is not that in y", name.span));
    }
    let drag_diameter = data.number("NormalDragLiftDiameter")?.map(|given| given.value);
    let axial_diameter = data.number("AxialDragLiftDiameter")?.map_or(outer.value, |given| given.value);
    let used = drag_diameter.unwrap_or(outer.value);
    let cd_axial = if used > 0.0 { cd_axial * axial_diameter / used } else { 0.0 };
    let friction = data.not_negative("SeabedLateralFrictionCoefficient")?.map_or(0.0, |given| given.value);
    if let Some(axial) = data.number("SeabedAxialFrictionCoefficient")?.filter(|given| given.value != friction) {
        return Err(Diagnostic::error("friction along the line is not that across it", axial.span)
            .label(format!("expected {friction}, or ~")));
    }
    Ok(LineType {
        name,
        outer,
        inner,
        mass,
        ea,
        ei,
        drag: [cd, cd_axial],
        added: [ca, ca_axial],
        drag_diameter,
        friction,
    })
}

fn vessel(data: &mut Data<'_>, _: &mut Vec<Diagnostic>) -> Outcome<Vessel> {
    let name = name(data, "a vessel")?;
    let position = data.numbers("InitialPosition", [0.0; 3])?;
    // names of other versions, of which no file can be cited: a turn must not be lost
    for other in ["InitialHeel", "InitialTrim", "InitialHeading"] {
        data.zero(other, "a vessel is turned by Orientation")?;
    }
    let orientation = data.numbers("Orientation", [0.0; 3])?;
    if orientation.iter().filter(|angle| **angle != 0.0).count() > 1 {
        return Err(Diagnostic::error(format!("vessel {} is turned about more than one axis", name.value), name.span));
    }
    Ok(Vessel { name, position, orientation })
}

fn line(data: &mut Data<'_>, messages: &mut Vec<Diagnostic>) -> Outcome<Line> {
    let name = name(data, "a line")?;
    data.refuse_rows("AttachmentType", "what is attached would be lost")?;
    data.only("PreBendSpecifiedBy", &["Curvature"], "lines are straight without load")?;
    data.refuse_rows("PreBendx", "lines are straight without load")?;
    data.only("PyModel", &["(none)"], "soil around a line is not computed")?;
    data.only("StaticsVIV", &["None"], "vortex-induced vibration is not computed")?;
    data.only("DynamicsVIV", &["None"], "vortex-induced vibration is not computed")?;
    data.only("DragFormulation", &["Standard"], "drag is that of Morison")?;
    data.zero("ContentsPressure", "pressure of the contents is not read")?;
    data.zero("ContentsFlowRate", "the contents do not flow")?;
    data.only("ContentsMethod", &["Uniform"], "its contents would be lost")?;
    let contents = data.not_negative("ContentsDensity")?.map_or(0.0, |given| given.value);
    if let Some(rows) = data.table("ConnectionxBendingStiffness")? {
        for row in &rows.rows {
            for column in ["ConnectionxBendingStiffness", "ConnectionyBendingStiffness"] {
                if let Some(node) =
                    rows.node(row, column).filter(|node| node.text().and_then(|t| t.parse::<f64>().ok()) != Some(0.0))
                {
                    let shown = node.text().unwrap_or("a list");
                    let error = Diagnostic::error(format!("{column} {shown} is not read: ends turn freely"), node.span);
                    return Err(error
                        .label("expected 0")
                        .help("&HELP ~CLASS ROD -CLAMP holds an end in its direction"));
                }
            }
        }
    }
    let ends = connections(data, &name)?;
    let mut sections = Vec::new();
    let Some(rows) = data.table("LineType")? else {
        return Err(Diagnostic::error(format!("line {} has no sections", name.value), name.span)
            .label("expected LineType, Length, TargetSegmentLength"));
    };
    rows.check_columns(&["LineType", "Length", "TargetSegmentLength", "NumberOfSegments"], messages)?;
    for row in &rows.rows {
        let kind = rows.word(row, "LineType")?;
        let length = rows.needed(row, "Length")?;
        if length.value <= 0.0 {
            return Err(
                Diagnostic::error(format!("Length is {}", length.value), length.span).label("must be greater than 0")
            );
        }
        let segments = match (rows.number(row, "NumberOfSegments")?, rows.number(row, "TargetSegmentLength")?) {
            (Some(count), _) if count.value >= 1.0 && count.value <= MAX_SEGMENTS => count.value as usize,
            (None, Some(target)) if target.value > 0.0 && (length.value / target.value) <= MAX_SEGMENTS => {
                (length.value / target.value).round().max(1.0) as usize
            }
            (None, None) => DEFAULT_SEGMENTS,
            (Some(wrong), _) | (None, Some(wrong)) => {
                return Err(Diagnostic::error(format!("a section cannot be cut by {}", wrong.value), wrong.span)
                    .label(format!("at most {MAX_SEGMENTS} segments")));
            }
        };
        let line_type = Given { value: kind.value.to_string(), span: kind.span };
        sections.push(Section { line_type, length, segments });
    }
    if sections.is_empty() {
        return Err(Diagnostic::error(format!("line {} has no sections", name.value), rows.span));
    }
    Ok(Line { name, ends, sections, contents })
}

fn holder(word: &str) -> Holder {
    match word {
        "Fixed" => Holder::Fixed,
        "Anchored" => Holder::Anchored,
        vessel => Holder::Vessel(vessel.to_string()),
    }
}

/// Both ends: the rows of the table Connection, ConnectionX ..
fn connections(data: &mut Data<'_>, name: &Given<String>) -> Outcome<[LineEnd; 2]> {
    if let Some(rows) = data.table("Connection")? {
        let [a, b] = rows.rows.as_slice() else {
            let text = format!("line {} has {} ends", name.value, rows.rows.len());
            return Err(Diagnostic::error(text, rows.span).label("expected End A and End B"));
        };
        let end = |row| -> Outcome<LineEnd> {
            let word = rows.word(row, "Connection")?;
            let at = [
                rows.needed(row, "ConnectionX")?.value,
                rows.needed(row, "ConnectionY")?.value,
                rows.needed(row, "ConnectionZ")?.value,
            ];
            Ok(LineEnd { holder: Given { value: holder(word.value), span: word.span }, at })
        };
        return Ok([end(a)?, end(b)?]);
    }
    let error = Diagnostic::error(format!("line {} has no Connection", name.value), name.span);
    Err(error.label("expected the table Connection, ConnectionX, ConnectionY, ConnectionZ"))
}

fn names_once<'a>(list: impl Iterator<Item = &'a Given<String>>, what: &str, messages: &mut Vec<Diagnostic>) {
    let mut known = std::collections::BTreeMap::new();
    for name in list {
        if let Some(earlier) = known.insert(name.value.as_str(), name.span) {
            let error = Diagnostic::error(format!("{what} {} is defined twice", name.value), name.span);
            messages.push(*error.other(earlier, "defined here first"));
        }
    }
}

/// Line types and vessels that lines name must be there.
fn check_names(made: &TextModel, messages: &mut Vec<Diagnostic>) {
    // what refers to objects that could not be read is not judged
    if messages.iter().any(|message| message.severity == windlass_base::diagnostic::Severity::Error) {
        return;
    }
    let unknown = |what: &str, name: &str, span: Span, all: &[&str]| {
        let error = Diagnostic::error(format!("{what} {name} is not known"), span);
        *match suggest(name, all.iter().copied()) {
            Some(help) => error.help(help),
            None => error,
        }
    };
    let types: Vec<&str> = made.line_types.iter().map(|kind| kind.name.value.as_str()).collect();
    let vessels: Vec<&str> =
        made.vessels.iter().map(|vessel| vessel.name.value.as_str()).chain(["Fixed", "Anchored"]).collect();
    for line in &made.lines {
        for section in &line.sections {
            if !types.contains(&section.line_type.value.as_str()) {
                messages.push(unknown("line type", &section.line_type.value, section.line_type.span, &types));
            }
        }
        for end in &line.ends {
            if let Holder::Vessel(name) = &end.holder.value
                && !vessels.contains(&name.as_str())
            {
                messages.push(unknown("what a line is connected to,", name, end.holder.span, &vessels));
            }
        }
    }
}
