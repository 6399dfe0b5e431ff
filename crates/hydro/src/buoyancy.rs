//! Buoyancy of a body's hull: the pieces of its parts, as solids in the system of the body.

use super::hull::{Combination, CombinationError, Fault, Solid, SubmergedVolume, Surface, TubeHull, intersect};
use super::stability::WaterSlabs;
use super::{BodyLoad, Category, Immersed, Load};
use nalgebra::{Matrix3, Vector2, Vector3};
use windlass_base::geometry::{Place, Position};
use windlass_base::pose::Pose;
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_model::{Attribute, Body, ClassError, Model, Part, Piece, Shape, bar_panels, box_panels};

/// Corners of panels nearer than this share of the size of a piece are one (files often keep seven digits).
const WELD_DISTANCE_SHARE: f64 = 1e-6;

/// Sides of the prism that a tube is to wind and current: with 64 its width is within 0.1 % of the diameter from every side.
pub(super) const TUBE_PRISM_SIDES: u32 = 64;

/// A piece as a solid of its body.
#[derive(Debug)]
pub(super) enum SolidForm {
    Surface(Surface),
    Tube(TubeHull),
}

impl SolidForm {
    /// That of a piece.
    ///
    /// # Errors
    /// A piece without panels or with a surface that is not closed or looks the wrong way.
    pub(super) fn of_piece(part: &Part, piece: &Piece) -> Result<SolidForm, ClassError> {
        let solid = Solidified::new(part, piece, Surface::leaks);
        let fatal = solid.faults.into_iter().find(|fault| fault.fatal);
        match (fatal, solid.form) {
            (None, Some(form)) => Ok(form),
            (fatal, _) => {
                let error =
                    fatal.map_or_else(|| ClassError::new(format!("piece {} has no volume", piece.name)), |f| f.error);
                Err(ClassError { span: Some(piece.span), ..error })
            }
        }
    }

    /// Its volume (m3).
    pub(super) fn volume(&self) -> f64 {
        match self {
            SolidForm::Surface(surface) => surface.volume(),
            SolidForm::Tube(TubeHull { ends: [a, b], diameter }) => {
                std::f64::consts::FRAC_PI_4 * diameter * diameter * (b - a).norm()
            }
        }
    }

    /// What of it is below a height in a pose.
    pub(super) fn wet(&self, pose: &Pose, level: f64) -> SubmergedVolume {
        match self {
            SolidForm::Surface(surface) => surface.wet(pose, level),
            SolidForm::Tube(tube) => tube.wet(pose, level),
        }
    }

    /// Its least and greatest height in a pose (m, global).
    pub(super) fn reach(&self, pose: &Pose) -> [f64; 2] {
        let height = |at: &Vector3<f64>| pose.origin.z + (pose.axes * at).z;
        let span = |heights: &mut dyn Iterator<Item = f64>| {
            heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
        };
        match self {
            SolidForm::Surface(surface) => span(&mut surface.vertices.iter().map(height)),
            SolidForm::Tube(TubeHull { ends, diameter }) => {
                let [a, b] = *ends;
                let axis = (pose.axes * (b - a)).try_normalize(0.0).unwrap_or_else(Vector3::z);
                let beside = 0.5 * diameter * (1.0 - axis.z * axis.z).max(0.0).sqrt();
                let [low, high] = span(&mut ends.iter().map(height));
                [low - beside, high + beside]
            }
        }
    }

    /// Integrals of xx, xy .. zz over what of it is below a height (m5), about the origin of the pose in global axes; a tube as a prism of
    /// its volume.
    pub(super) fn second_moments(&self, pose: &Pose, level: f64) -> Matrix3<f64> {
        match self {
            SolidForm::Surface(surface) => surface.second_moments(pose, level),
            SolidForm::Tube(tube) => tube.prism(TUBE_PRISM_SIDES).map_or_else(Matrix3::zeros, |prism| {
                prism.second_moments(pose, level) * (self.volume() / prism.volume())
            }),
        }
    }

    /// Adds what of it is below a water surface in a pose, slab by slab, times a factor; a tube as a prism of its volume.
    pub(super) fn add_slabs(&self, pose: &Pose, water: &WaterSlabs, factor: f64, sums: &mut [SubmergedVolume]) {
        match self {
            SolidForm::Surface(surface) => water.add_surface(surface, pose, factor, sums),
            SolidForm::Tube(tube) => {
                if let Some(prism) = tube.prism(TUBE_PRISM_SIDES) {
                    water.add_surface(&prism, pose, factor * self.volume() / prism.volume(), sums);
                }
            }
        }
    }

    /// Its least and greatest distance from the origin of a pose along a horizontal direction (m).
    pub(super) fn reach_along(&self, pose: &Pose, ahead: &Vector2<f64>) -> [f64; 2] {
        let distance = |at: &Vector3<f64>| ahead.dot(&(pose.axes * at).xy());
        let span = |list: &mut dyn Iterator<Item = f64>| {
            list.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], s| [low.min(s), high.max(s)])
        };
        match self {
            SolidForm::Surface(surface) => span(&mut surface.vertices.iter().map(distance)),
            SolidForm::Tube(TubeHull { ends, diameter }) => {
                let axis = (pose.axes * (ends[1] - ends[0])).try_normalize(0.0).unwrap_or_else(Vector3::z);
                let along = ahead.dot(&axis.xy());
                let beside = 0.5 * diameter * (1.0 - along * along).max(0.0).sqrt();
                let [low, high] = span(&mut ends.iter().map(distance));
                [low - beside, high + beside]
            }
        }
    }

    /// Its surface, of a tube that of a prism; `None` of a tube without length.
    fn surface(self) -> Option<Surface> {
        match self {
            SolidForm::Surface(surface) => Some(surface),
            SolidForm::Tube(tube) => tube.prism(TUBE_PRISM_SIDES),
        }
    }
}

/// The hull of a body in the water of the environment in force.
#[derive(Debug)]
pub struct Hull {
    pieces: Vec<(f64, SolidForm)>,
    /// Height of the water's surface (m, global).
    level: f64,
    /// Weight of water (N/m3).
    water_weight: f64,
}

impl Hull {
    /// That of a body; `None` when no piece of it displaces water.
    ///
    /// # Errors
    /// A piece without panels or with a surface that is not closed or looks the wrong way.
    pub fn new(model: &Model, body: &Body) -> Result<Option<Self>, ClassError> {
        let mut pieces = Vec::new();
        for part in model.parts_of(body) {
            for piece in part.pieces.iter().filter(|p| p.permeability != 0.0 && p.compartment.is_none()) {
                let solid = Solidified::new(part, piece, Surface::leaks);
                if let Some(fault) = solid.faults.iter().find(|f| f.fatal) {
                    return Err(ClassError { span: Some(piece.span), ..fault.error.clone() }
                        .help(format!("{} has no buoyancy before this is corrected", body.name)));
                }
                let share = piece.permeability * model.member_factor(&part.name, piece, Attribute::Buoyancy);
                pieces.extend(solid.form.map(|form| (share, form)));
            }
        }
        let water = model.surroundings();
        let made = Hull { pieces, level: water.tide, water_weight: water.water_density * water.gravity };
        Ok((!made.pieces.is_empty()).then_some(made))
    }

    /// What of it is below the water's surface in a pose.
    pub fn wet(&self, pose: &Pose) -> SubmergedVolume {
        let mut sum = SubmergedVolume::default();
        for (permeability, form) in &self.pieces {
            sum.add(&form.wet(pose, self.level), *permeability);
        }
        sum
    }

    /// Weight of the water (N/m3).
    pub fn water_weight(&self) -> f64 {
        self.water_weight
    }
}

impl BodyLoad for Hull {
    fn category(&self) -> Category {
        Category::Buoyancy
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let load = self.wet(pose).load(self.water_weight);
        if load.wrench.iter().chain(load.stiffness.iter()).all(|x| x.is_finite()) {
            Ok(load)
        } else {
            Err(ClassError::new("the buoyancy has no value where the body is"))
        }
    }

    fn as_immersed(&self) -> Option<&dyn Immersed> {
        Some(self)
    }
}

impl Immersed for Hull {
    fn lift(&self) -> f64 {
        self.water_weight
    }

    fn wet(&self, pose: &Pose) -> SubmergedVolume {
        Hull::wet(self, pose)
    }

    fn wet_slabs(&self, pose: &Pose, water: &WaterSlabs) -> Vec<SubmergedVolume> {
        let mut sums = vec![SubmergedVolume::default(); water.count()];
        self.pieces.iter().for_each(|(share, form)| form.add_slabs(pose, water, *share, &mut sums));
        sums
    }

    fn reach_along(&self, pose: &Pose, ahead: &Vector2<f64>) -> [f64; 2] {
        join_reaches(self.pieces.iter().map(|(_, form)| form.reach_along(pose, ahead)))
    }
}

/// The reach of several things together.
pub(super) fn join_reaches(reaches: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    reaches.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| [low.min(a), high.max(b)])
}

/// The surface of a piece in its body, its tubes as prisms; `None` of a piece without panels or one that bounds no volume.
///
/// # Errors
/// A piece without panels or with a surface that is not closed or looks the wrong way.
pub(super) fn skin(part: &Part, piece: &Piece) -> Result<Option<Surface>, ClassError> {
    let solid = Solidified::new(part, piece, Surface::leaks);
    match (solid.faults.iter().find(|f| f.fatal), solid.form) {
        (Some(fault), _) => Err(ClassError { span: Some(piece.span), ..fault.error.clone() }.help(
            "it takes no wind and current before this is corrected; or give it -CS_WIND 0 0 0 -CS_CURRENT 0 0 0",
        )),
        (None, form) => Ok(form.and_then(SolidForm::surface)),
    }
}

/// What a check of a piece found.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceFault {
    /// The sentence.
    pub error: ClassError,
    /// Whether the piece has no buoyancy with it.
    pub fatal: bool,
    /// Whether nothing is wrong: it is only worth knowing.
    pub remark: bool,
}

/// A piece as a solid of its body, with what is wrong with it.
struct Solidified {
    form: Option<SolidForm>,
    faults: Vec<PieceFault>,
}

impl Solidified {
    /// With the faults that a check of its surface finds. All are asked for once, when the piece is complete; afterwards those
    /// that keep it from being a solid.
    fn new(part: &Part, piece: &Piece, check: fn(&Surface) -> Vec<Fault>) -> Self {
        let name = &piece.name;
        let failed = |why: String| {
            let error = ClassError::new(format!("piece {name}: {why}"));
            Solidified { form: None, faults: vec![PieceFault { error, fatal: true, remark: false }] }
        };
        let panels = match piece.shape.with_displacement(&part.position) {
            Shape::Tube { ends, diameter } => {
                let tube = TubeHull { ends: ends.map(Vector3::from), diameter };
                return Solidified { form: Some(SolidForm::Tube(tube)), faults: Vec::new() };
            }
            Shape::Block { low, high } => box_panels(low, high),
            Shape::Bar { ends, sides } => bar_panels(&ends, &sides),
            Shape::Panels(panels) => panels,
        };
        if panels.is_empty() {
            return failed("it has no panels".into());
        }
        let mut surface = match Surface::from_panels(&panels, WELD_DISTANCE_SHARE * size(&panels)) {
            Ok(surface) => surface,
            Err(error) => return failed(error.to_string()),
        };
        let mut faults = Vec::new();
        if surface.volume() < 0.0 {
            for face in &mut surface.faces {
                face.reverse();
            }
            let error = ClassError::new(format!("piece {name}: all its panels look inward; they are turned"));
            faults.push(PieceFault { error, fatal: false, remark: true });
        }
        faults.extend(summarise_faults(name, &check(&surface)));
        Solidified { form: Some(SolidForm::Surface(surface)), faults }
    }
}

/// The longest side of the box around panels (m).
fn size(panels: &[Vec<Position>]) -> f64 {
    let extent = Shape::Panels(panels.to_vec()).extent().unwrap_or_default();
    let [low, high] = extent.map(Vector3::from);
    (high - low).amax()
}

/// The first fault of each sort, and how many more there are.
fn summarise_faults(name: &str, faults: &[Fault]) -> Vec<PieceFault> {
    let of_sort = |fatal: bool| {
        let sort = faults.iter().filter(|f| matches!(f, Fault::Cut { .. } | Fault::Degenerate { .. }) != fatal);
        let more = sort.clone().count().saturating_sub(1);
        sort.take(1)
            .map(|fault| {
                let mut error = sentence(name, fault);
                if more > 0 {
                    error.message = error.message.then(format!("; and {more} more such faults"));
                }
                PieceFault { error, fatal, remark: false }
            })
            .next()
    };
    [true, false].into_iter().filter_map(of_sort).collect()
}

fn sentence(name: &str, fault: &Fault) -> ClassError {
    const AT: &str = "({}, {}, {})";
    let (what, positions): (String, Vec<[f64; 3]>) = match fault {
        Fault::Open { edge } => {
            (format!("it is open: there is a panel on one side only of the edge from {AT} to {AT}"), edge.to_vec())
        }
        Fault::Crowded { edge, faces } => (format!("{faces} panels meet at the edge from {AT} to {AT}"), edge.to_vec()),
        Fault::Turned { edge } => {
            (format!("the panels at the edge from {AT} to {AT} look to different sides"), edge.to_vec())
        }
        Fault::InsideOut { at, .. } => (format!("the part at {AT} is inside out"), vec![*at]),
        Fault::Cut { at, .. } => {
            (format!("panels cut each other at {AT}; what they both enclose counts twice"), vec![*at])
        }
        Fault::Degenerate { at, .. } => (format!("a panel at {AT} has no area"), vec![*at]),
    };
    let values: Vec<(f64, Dim)> = positions.into_iter().flatten().map(|x| (x, Dim::Length)).collect();
    ClassError::with_values(format!("piece {name}: {what}"), &values)
}

/// The least and the greatest coordinates of a piece in its body (m).
fn bounds(part: &Part, piece: &Piece) -> [Vector3<f64>; 2] {
    let (corners, beside): (Vec<[f64; 3]>, f64) = match piece.shape.with_displacement(&part.position) {
        Shape::Panels(panels) => (panels.into_iter().flatten().collect(), 0.0),
        Shape::Block { low, high } => (vec![low, high], 0.0),
        Shape::Bar { ends, sides } => (bar_panels(&ends, &sides).into_iter().flatten().collect(), 0.0),
        Shape::Tube { ends, diameter } => (ends.to_vec(), 0.5 * diameter),
    };
    let beside = Vector3::repeat(beside);
    let none = [Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)];
    corners
        .into_iter()
        .map(Vector3::from)
        .fold(none, |[low, high], c| [low.inf(&(c - beside)), high.sup(&(c + beside))])
}

/// Whether nothing of one lies in the other.
fn are_disjoint(a: &[Vector3<f64>; 2], b: &[Vector3<f64>; 2]) -> bool {
    let ([a_low, a_high], [b_low, b_high]) = (a, b);
    (0..3).any(|i| a_low[i] >= b_high[i] || b_low[i] >= a_high[i])
}

/// A piece that is a tube, in its body.
fn tube_of(part: &Part, piece: &Piece) -> Option<TubeHull> {
    match &piece.shape {
        Shape::Tube { ends, diameter } => {
            let ends = ends.map(|at| Vector3::from(part.position.apply(at)));
            Some(TubeHull { ends, diameter: *diameter })
        }
        _ => None,
    }
}

/// What is wrong with a piece by itself; places in the system of the body.
pub fn piece_faults(part: &Part, piece: &Piece) -> Vec<PieceFault> {
    Solidified::new(part, piece, Surface::faults).faults
}

/// Where a piece overlaps others of its body that count as it does, one place (m) a piece in the system of the body; pieces that `is_left_out` names are not
/// looked at.
pub fn piece_overlaps(
    model: &Model,
    body: &Body,
    part: &Part,
    piece: &Piece,
    is_left_out: impl Fn(&str) -> bool,
) -> Vec<PieceFault> {
    let mut faults = Vec::new();
    let Some(surface) = Solidified::new(part, piece, Surface::leaks).form.and_then(SolidForm::surface) else {
        return faults;
    };
    let bounds = bounds(part, piece);
    let round = tube_of(part, piece);
    let others = model.parts_of(body).flat_map(|p| p.pieces.iter().map(move |piece| (p, piece)));
    for other in others.filter(|(_, other)| !is_left_out(&other.name)) {
        // an interior lies within an exterior; two of one sort count twice where they overlap
        let apart =
            other.1.compartment != piece.compartment && (other.1.compartment.is_none() || piece.compartment.is_none());
        // members of BEAM run into each other and into hulls, and are each counted up to their points
        if apart
            || other.1.element.is_some()
            || other.1.name == piece.name
            || other.1.permeability * piece.permeability <= 0.0
        {
            continue;
        }
        if are_disjoint(&bounds, &self::bounds(other.0, other.1)) {
            continue;
        }
        if let (Some(own), Some(beside)) = (&round, tube_of(other.0, other.1))
            && own.is_apart(&beside)
        {
            continue;
        }
        let form = Solidified::new(other.0, other.1, Surface::leaks).form;
        let Some(second) = form.and_then(SolidForm::surface) else { continue };
        if let Some(at) = intersect(&surface, &second) {
            let text = format!(
                "pieces {} and {} overlap at ({{}}, {{}}, {{}}); what they share counts twice",
                other.1.name, piece.name
            );
            let error = ClassError::with_values(text, &at.map(|x| (x, Dim::Length)));
            faults.push(PieceFault { error, fatal: false, remark: false });
        }
    }
    faults
}

/// The panels of what two pieces of a part make together, tubes as prisms; the options of the pieces play no part.
///
/// # Errors
/// A piece that is open, looks the wrong way or has panels that cut each other; nothing left; surfaces that cannot be combined.
pub fn combine_pieces(first: &Piece, second: &Piece, how: Combination) -> Result<Vec<Vec<Position>>, ClassError> {
    let part = Part::new("", "", Place::default(), Span::default());
    let solid = |piece: &Piece| -> Result<Surface, ClassError> {
        let Solidified { form, faults } = Solidified::new(&part, piece, Surface::faults);
        if let Some(fault) = faults.into_iter().find(|fault| !fault.remark) {
            return Err(fault.error);
        }
        form.and_then(SolidForm::surface).ok_or_else(|| ClassError::new(format!("piece {} has no volume", piece.name)))
    };
    let (a, b) = (solid(first)?, solid(second)?);
    let made = a.combined(&b, how).map_err(|error| match error {
        CombinationError::NotSolid { which, fault } => {
            sentence(if which == 0 { &first.name } else { &second.name }, &fault)
        }
        other => ClassError::new(other.to_string()),
    })?;
    let corners = |face: &[u32; 3]| -> Vec<Position> {
        face.iter().filter_map(|n| made.vertices.get(*n as usize)).map(|at| (*at).into()).collect()
    };
    let panels: Vec<Vec<Position>> = made.faces.iter().map(corners).collect();
    // what the model makes of these panels must be the solid that was found
    let read = Surface::from_panels(&panels, WELD_DISTANCE_SHARE * size(&panels));
    let is_sound = read.is_ok_and(|surface| surface.leaks().is_empty());
    if is_sound {
        Ok(panels)
    } else {
        Err(ClassError::new(
            "faces of the two nearly coincide: the result is no closed surface; move one of them a little",
        ))
    }
}
