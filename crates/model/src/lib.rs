//! The model database: bodies, parts, points, classes, connectors, curves, environments, selectors, defaults.
//!
//! It holds SI values and the places they were written, in the order they were defined, and knows no physics. It
//! declares what a connector class can be asked ([`ConnectorClass`]); the floors above implement it.
//!
//! # Example
//! ```
//! use windlass_model::{Body, Model};
//!
//! let mut model = Model::default();
//! model.bodies.insert(Model::key("Barge"), Body { name: "Barge".into(), ..Body::default() });
//! assert_eq!(model.bodies["BARGE"].name, "Barge");
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod along;
mod ambient;
mod assembly;
pub mod bathymetry;
mod body;
mod class;
mod compartment;
mod connector;
mod curve;
mod database;
mod defaults;
mod draft_mark;
mod element;
mod environment;
mod fatigue;
mod hull;
mod idealisation;
mod line;
mod line_properties;
mod load;
mod member_section;
mod names;
mod note;
pub mod options;
mod parameters;
mod prescribed;
mod scheme;
mod selector;
mod sensor;
mod tether;
mod tie;
mod unmodelled;

pub use along::{EnergyBalance, LineMode, LineNode, LineSide, LineStress};
pub use ambient::{Ambient, Contents, Filling, Flow};
pub use assembly::{
    Assemblies, Assembly, AssemblyKind, Drum, DrumControl, LaidPipe, PIPE, PipeLayout, ReevedLayout, ReevedSpan,
    line_name,
};
pub use bathymetry::Bathymetry;
pub use body::{Body, EXTRA, GROUND, Junction, LOOSE_SURFACES, Mass, Part, Point, STR_MODEL, Weight};
pub use class::{
    AnchoredClass, Class, ClassError, ClassRecord, ClassRole, ConnectorClass, DynamicLineClass, LengthClass, PipeClass,
    ReevedLineClass, SegmentedClass, StaticLineClass, StaticSeabed, TetherSectionsClass, WallMaterial,
};
pub use compartment::{Compartment, FreeSurface, Hole, HoleKind, TankContents};
pub use connector::{Anchor, Connector, Tug};
pub use curve::{Curve, CurveKind};
pub use database::{
    Amplitudes, AttachedDatabase, Database, DriftMethod, DriftTable, InteractingBodies, Interaction, PanelSizes, Qtf,
    Stance,
};
pub use defaults::{Coordinates, DefaultMaterial, Defaults, RopeStiffness, WaveDefaults};
pub use draft_mark::DraftMark;
pub use element::{
    AnchoredConnector, AnchoredResponse, Connection, ConnectorCategory, ConnectorElement, ConnectorResponse,
    ConnectorSummary, DynamicConnector, End, FenderState, NodalConnector, PlacedConnector, RunRequirement, Situation,
    SolverCache, SpringState, StiffTie, TiedBodies, TimeStep,
};
pub use environment::{
    Components, Current, CurveReference, Division, ElevationHistory, Environment, FormulaChoice, GivenWave, GustParts,
    PeriodType, Phasing, SeaDefinition, Stretching, Surroundings, TimeWindow, Wind, WindCode, WindLaw,
};
pub use fatigue::{FatigueCurve, FatigueKind, FatigueSegment, FatigueSelection, ThicknessCorrection};
pub use hull::{Breadths, ElementOf, LinearHydrostatics, Member, Piece, Shape, WaveAction, bar_panels, box_panels};
pub use idealisation::{Idealisation, add_model_column};
pub use line::{
    AbsentRow, Condition, FoundLength, LineChange, LineConfiguration, LineLoads, LineModel, LineSampling, Placement,
};
pub use line_properties::{AttachedMass, AxialLaw, LineProperties, LineSeabed, SegmentProperties};
pub use load::{Attribute, AttributeMultiplier, Fluid, LoadGroup, LoadKind, Lump, Multipliers, PartLoad, RollDamping};
pub use member_section::{MemberSection, SectionOutline};
pub use names::EntityKind;
pub use note::Note;
pub use parameters::Parameters;
pub use prescribed::{GivenMotion, PathRow, Prescription, ResponseRow, Responses, Sinusoid};
pub use scheme::SchemeWeights;
pub use selector::Selector;
pub use sensor::{SensorRecord, SensorSignal};
pub use tether::{TetherConstraint, TetherEnds, TetherHold, TetherSection, TetherUse};
pub use tie::TieResponse;
pub use unmodelled::{SolveKind, UnmodelledEffect};

use indexmap::IndexMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};
use windlass_base::geometry::Position;
use windlass_base::pose::Pose;
use windlass_base::span::Span;

/// The whole database. Keys are names in upper case, with their marker (`~`, `*`, `:`).
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Bodies.
    pub bodies: IndexMap<String, Body>,
    /// Parts; each belongs to a body.
    pub parts: IndexMap<String, Part>,
    /// Points; each belongs to a part, or to ground.
    pub points: IndexMap<String, Point>,
    /// Loads of wind, current and waves on parts, and matrices of drag, damping and added mass.
    pub loads: Vec<PartLoad>,
    /// Multipliers of `&APPLY`.
    pub multipliers: Multipliers,
    /// What `&PARAMETER` said.
    pub parameters: Parameters,
    /// Parameters saved by `&PARAMETER -SAVE`, innermost last.
    pub saved_parameters: Vec<Parameters>,
    /// Records whose effect no solver computes, but for those of pieces.
    pub unmodelled: Vec<UnmodelledEffect>,
    /// Sensors.
    pub sensors: IndexMap<String, SensorRecord>,
    /// Draft marks.
    pub draft_marks: IndexMap<String, DraftMark>,
    /// Classes.
    pub classes: IndexMap<String, Class>,
    /// Connectors.
    pub connectors: IndexMap<String, Connector>,
    /// Assemblies.
    pub assemblies: Assemblies,
    /// Curves.
    pub curves: IndexMap<String, Curve>,
    /// Bottoms over a grid.
    pub bathymetries: IndexMap<String, Arc<Bathymetry>>,
    /// What pipes hold, under a name.
    pub fillings: IndexMap<String, Filling>,
    /// Fatigue curves and what `&REP_SELECT` chose of them.
    pub fatigue: FatigueSelection,
    /// Environments kept under a name.
    pub environments: IndexMap<String, Environment>,
    /// Selectors.
    pub selectors: IndexMap<String, Selector>,
    /// The environment in force.
    pub environment: Environment,
    /// Defaults in force.
    pub defaults: Defaults,
    /// Defaults of waves in force.
    pub wave_defaults: WaveDefaults,
    /// Defaults saved by `&DEFAULT -SAVE`, innermost last.
    pub saved_defaults: Vec<(Defaults, WaveDefaults)>,
    /// Interior compartments.
    pub compartments: IndexMap<String, Compartment>,
    /// Holes of compartments.
    pub holes: IndexMap<String, Hole>,
    /// The compartment that pieces now being given belong to; none: the hull of their part.
    pub current_compartment: Option<String>,
    /// Load groups.
    pub load_groups: IndexMap<String, LoadGroup>,
    /// The load group that loads now being given belong to; none: that of their part.
    pub current_load_group: Option<String>,
    /// The part that points now being defined belong to.
    pub current_part: Option<String>,
    /// The piece that panels now being given belong to.
    pub current_piece: Option<String>,
    /// Set by Ctrl-C: an engine that takes long gives up.
    pub interrupt: Arc<AtomicBool>,
}

impl Model {
    /// The key of a name.
    pub fn key(name: &str) -> String {
        name.to_ascii_uppercase()
    }

    /// Whether Ctrl-C has been pressed since the record began.
    pub fn is_interrupted(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }

    /// What every line and body is surrounded by, from the environment in force and the defaults.
    pub fn surroundings(&self) -> Surroundings {
        self.surroundings_in(&self.environment)
    }

    /// What every line and body would be surrounded by in an environment.
    pub fn surroundings_in(&self, env: &Environment) -> Surroundings {
        Surroundings {
            water_density: env.water_density.unwrap_or(self.defaults.water_density),
            air_density: self.defaults.air_density,
            gravity: self.defaults.gravity,
            depth: env.depth.or(self.defaults.depth),
            tide: env.tide.unwrap_or(0.0),
        }
    }

    /// The bottom over a grid of an environment; none where it is flat.
    pub fn bathymetry_in(&self, env: &Environment) -> Option<&Arc<Bathymetry>> {
        env.bathymetry.as_ref().and_then(|named| self.bathymetries.get(&Model::key(&named.kind)))
    }

    /// The bathymetry that a static line lies on: that of the environment in force, where neither its class nor its anchor says
    /// another depth or a slope.
    pub fn bathymetry_under(&self, connector: &Connector) -> Option<&Arc<Bathymetry>> {
        let class = self.classes.get(&Model::key(&connector.class))?;
        let follows = class.object.as_line().is_some_and(|line| line.seabed() == StaticSeabed::Bathymetry);
        let on_grid = connector.points.len() < 2 && follows;
        let stands_on_it = connector.anchor.is_some_and(|anchor| anchor.elevation.is_none());
        self.bathymetry_in(&self.environment).filter(|_| on_grid && stands_on_it)
    }

    /// Depth below z = 0 at which a connector has its anchor (m) where nothing else is said: that of its class, else of the bottom there.
    pub fn anchor_depth(&self, connector: &Connector) -> Option<f64> {
        let class = self.classes.get(&Model::key(&connector.class))?;
        let mut around = self.surroundings();
        if let (Some(anchor), Some(bottom)) = (connector.anchor, self.bathymetry_in(&self.environment)) {
            let [x, y] = anchor.at;
            around.depth = Some(-bottom.elevation_and_slopes(x, y).0);
        }
        class.object.as_anchored()?.anchor_depth(&around)
    }

    /// Global coordinates of a point (m), in the present configuration of its body.
    pub fn global(&self, point: &Point) -> Position {
        let part = self.parts.get(&Model::key(&point.part));
        let in_body = part.map_or(point.at, |p| p.position.apply(point.at));
        let body = part.and_then(|p| self.bodies.get(&Model::key(&p.body)));
        body.map_or(in_body, |b| b.position.apply(in_body))
    }

    /// Global position of one end of a connector (0 or 1), with its offset, in the present configuration; `None` when
    /// that end is ground.
    pub fn end(&self, connector: &Connector, index: usize) -> Option<Position> {
        let point = connector.points.get(index).and_then(|name| self.points.get(&Model::key(name)))?;
        let offset = connector.offsets.get(index).copied().unwrap_or_default();
        let turned = self.body_of(point).map_or(offset, |b| b.position.rotate(offset));
        let [x, y, z] = self.global(point);
        let [dx, dy, dz] = turned;
        Some([x + dx, y + dy, z + dz])
    }

    /// The pose of one end of a connector (0 or 1), in the present configuration: its point with its offset and the axes of
    /// its body; `None` when it has no such point.
    pub fn end_pose(&self, connector: &Connector, index: usize) -> Option<Pose> {
        let point = connector.points.get(index).and_then(|name| self.points.get(&Model::key(name)))?;
        let body = self.body_of(point).map(|b| Pose::from_place(&b.position)).unwrap_or_default();
        self.end(connector, index).map(|at| Pose { origin: at.into(), ..body })
    }

    /// The poses of both ends of a connector, in the present configuration. Behind a single point stands the anchor of a line,
    /// else the place where the point was when the connector was defined.
    pub fn end_poses(&self, connector: &Connector) -> [Pose; 2] {
        let first = self.end_pose(connector, 0).unwrap_or_default();
        let [_, defined] = connector.defined;
        let anchor = || self.placement(connector).other.filter(|_| connector.anchor.is_some()).map(Pose::from_position);
        [first, self.end_pose(connector, 1).or_else(anchor).unwrap_or(defined)]
    }

    /// A remark that names the lines whose forces are interpolated in tables.
    pub fn interpolated_lines(&self) -> Option<String> {
        let tabulated = |c: &&Connector| {
            c.active
                && !self.is_dynamic_line(c)
                && self
                    .classes
                    .get(&Model::key(&c.class))
                    .and_then(|k| k.object.as_line())
                    .is_some_and(|k| k.is_tabulated())
        };
        let names: Vec<&str> = self.connectors.values().filter(tabulated).map(|c| c.name.as_str()).collect();
        let shown = list_names(&names);
        (!names.is_empty())
            .then(|| format!("forces interpolated in tables of thirty points (-TABLE), not solved: {shown}"))
    }

    /// Whether a connector is a dynamic line: its class does, or `&CONNECTOR -DYNAMICS` says so.
    pub fn is_dynamic_line(&self, connector: &Connector) -> bool {
        let class = self.classes.get(&Model::key(&connector.class));
        connector.dynamics.is_some() || class.is_some_and(|c| c.object.idealisation() == Idealisation::Dynamic)
    }

    /// The element a connector is to an engine, between its ends as they are, in water and air at rest.
    ///
    /// # Errors
    /// As [`Model::element_in`].
    pub fn element(&self, connector: &Connector) -> Result<Box<dyn ConnectorElement>, ClassError> {
        self.element_in(connector, None)
    }

    /// The element a connector is to an engine, between its ends as they are; `ambient` surrounds those that feel water, wind and
    /// bottom all along themselves.
    ///
    /// # Errors
    /// A class that is not defined or exerts no force; values that make no element here.
    pub fn element_in(
        &self,
        connector: &Connector,
        ambient: Option<&Arc<dyn Ambient>>,
    ) -> Result<Box<dyn ConnectorElement>, ClassError> {
        self.element_of_run(connector, ambient, RunRequirement::default())
    }

    /// The same in a run, with what that asks of a dynamic line.
    ///
    /// # Errors
    /// As [`Model::element_in`].
    pub fn element_of_run(
        &self,
        connector: &Connector,
        ambient: Option<&Arc<dyn Ambient>>,
        duty: RunRequirement,
    ) -> Result<Box<dyn ConnectorElement>, ClassError> {
        if let Some(element) = self.reeved_element(connector)? {
            return Ok(element);
        }
        let class = self.classes.get(&Model::key(&connector.class));
        let class = class.ok_or_else(|| ClassError::new(format!("there is no class {}", connector.class)))?;
        let placement = self.placement(connector);
        let connection = Connection {
            connector,
            ends: self.end_poses(connector),
            to_ground: placement.to_ground,
            placement,
            curve: &|name| self.curves.get(&Model::key(name)),
            surroundings: &self.surroundings(),
            ambient,
            duty,
            tied: &|| self.tied_bodies(connector),
        };
        match connector.dynamics {
            Some(elements) => class.dynamic_line(&connection, elements),
            None => class.object.element(&connection),
        }
    }

    /// The bodies at the ends of a connector, as a rigid tie sees them.
    fn tied_bodies(&self, connector: &Connector) -> TiedBodies {
        let mut made = TiedBodies::default();
        let points = connector.points.iter().filter_map(|name| self.points.get(&Model::key(name)));
        for body in points.filter_map(|point| self.body_of(point)) {
            let mass = Mass::from_parts(self.parts_of(body), self.defaults.gravity);
            let own = mass.inertia_about(mass.centre).diagonal();
            let given = body.database.as_ref().filter(|attached| attached.hydrostatics);
            let of_database = given.and_then(|attached| attached.data.hydrostatics.as_ref());
            let hydrostatics = body.linear.iter().map(|linear| &linear.stiffness).chain(of_database);
            let diagonals: Vec<_> = hydrostatics.map(|matrix| matrix.diagonal()).collect();
            let most = |from: usize| {
                diagonals.iter().flat_map(|d| d.iter().skip(from).take(3)).fold(0.0, |m: f64, k| m.max(*k))
            };
            made.inertia = [made.inertia[0].max(mass.mass), made.inertia[1].max(own.max())];
            made.stiffness = [made.stiffness[0].max(most(0)), made.stiffness[1].max(most(3))];
        }
        made
    }

    /// The ends of a connector, in the present configuration.
    pub fn placement(&self, connector: &Connector) -> Placement {
        let class = self.classes.get(&Model::key(&connector.class));
        let depth = self.anchor_depth(connector);
        let series = class
            .and_then(|c| c.object.as_line()?.series_curve())
            .and_then(|(name, _)| self.curves.get(&Model::key(name)));
        let on_body = |name: &String| self.points.get(&Model::key(name)).is_some_and(|p| self.body_of(p).is_some());
        let far = connector.anchor.and_then(|a| {
            let [x, y] = a.at;
            a.elevation.or(depth.map(|d| -d)).map(|z| [x, y, z])
        });
        Placement {
            fairlead: self.end(connector, 0).unwrap_or_default(),
            other: self.end(connector, 1).or(far),
            to_ground: !connector.points.get(1).is_some_and(on_body),
            anchored: connector.points.len() < 2,
            first_length: connector.first_length,
            series: series.and_then(Curve::long_term_stiffness),
            bathymetry: self.bathymetry_under(connector).cloned(),
        }
    }

    /// Length of a connector's first segment (m): its own, else its class's; `None` for classes without length.
    pub fn first_length(&self, connector: &Connector) -> Option<f64> {
        let class = || self.classes.get(&Model::key(&connector.class)).and_then(Class::first_length);
        connector.first_length.or_else(class)
    }

    /// The body a point belongs to; `None` for ground.
    pub fn body_of(&self, point: &Point) -> Option<&Body> {
        self.parts.get(&Model::key(&point.part)).and_then(|p| self.bodies.get(&Model::key(&p.body)))
    }

    /// The parts of a body.
    pub fn parts_of<'a>(&'a self, body: &'a Body) -> impl Iterator<Item = &'a Part> {
        let key = Model::key(&body.name);
        self.parts.values().filter(move |p| Model::key(&p.body) == key)
    }

    /// The body of the part described last.
    pub fn current_body(&self) -> Option<&Body> {
        let part = self.current_part.as_ref().and_then(|p| self.parts.get(&Model::key(p)))?;
        self.bodies.get(&Model::key(&part.body))
    }

    /// A piece by its name, with its part.
    pub fn piece(&self, name: &str) -> Option<(&Part, &Piece)> {
        let pieces = self.parts.values().flat_map(|part| part.pieces.iter().map(move |piece| (part, piece)));
        pieces.into_iter().find(|(_, piece)| piece.name.eq_ignore_ascii_case(name))
    }

    /// A piece by its name, to be changed.
    pub fn piece_mut(&mut self, name: &str) -> Option<&mut Piece> {
        let pieces = self.parts.values_mut().flat_map(|part| part.pieces.iter_mut());
        pieces.into_iter().find(|piece| piece.name.eq_ignore_ascii_case(name))
    }

    /// Connectors and structural elements that use a class.
    pub fn users_of_class(&self, class: &str) -> Vec<&str> {
        let key = Model::key(class);
        let connectors = self.connectors.values().filter(|c| Model::key(&c.class) == key).map(|c| c.name.as_str());
        let elements = self.parts.values().flat_map(|part| &part.pieces).filter_map(|piece| piece.element.as_ref());
        let mut users: Vec<&str> =
            connectors.chain(elements.filter(|e| Model::key(&e.class) == key).map(|e| e.name.as_str())).collect();
        users.dedup();
        users
    }

    /// Takes a structural element out of the model: its pieces and its weights. Says whether there was one.
    pub fn remove_element(&mut self, name: &str) -> bool {
        let mut found = false;
        for part in self.parts.values_mut() {
            let own = |piece: &Piece| piece.element.as_ref().is_some_and(|e| e.name.eq_ignore_ascii_case(name));
            found |= part.pieces.iter().any(own);
            part.pieces.retain(|piece| !own(piece));
            part.weights.retain(|weight| !weight.element.as_ref().is_some_and(|e| e.eq_ignore_ascii_case(name)));
        }
        found
    }

    /// Connectors that use a point.
    pub fn users_of_point(&self, point: &str) -> Vec<&str> {
        let key = Model::key(point);
        self.connectors
            .values()
            .filter(|c| c.points.iter().any(|p| Model::key(p) == key))
            .map(|c| c.name.as_str())
            .collect()
    }
}

/// Names as a remark lists them: the first eight, and how many more there are.
pub fn list_names(names: &[&str]) -> String {
    const MAX_NAMES: usize = 8;
    let shown = names.iter().take(MAX_NAMES).copied().collect::<Vec<_>>().join(", ");
    match names.len().saturating_sub(MAX_NAMES) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// Looks a name up in one of the model's tables.
///
/// # Errors
/// An unknown name, with the nearest ones.
pub fn find<'a, T>(table: &'a IndexMap<String, T>, name: &str, what: &str, span: Span) -> Outcome<&'a T> {
    table.get(&Model::key(name)).ok_or_else(|| {
        let mut error = Diagnostic::error(format!("unknown {what} {name}"), span);
        match suggest(name, table.keys().map(String::as_str)) {
            Some(help) => error.help.push(help),
            None => error.help.push(format!("no {what} is defined yet")),
        }
        error
    })
}
