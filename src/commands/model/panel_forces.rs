//! `G_PRESSURE`: added mass, damping and wave forces of bodies by panels, where they stand. Several bodies are solved together: each has a
//! database with the radiation of the others. What was computed is kept beside the answers (`report/pressure_file.rs`) and taken from there by a run with
//! the same mesh and settings.

use crate::commands::model::database;
use crate::commands::model::hydrodynamics::settle_pressure;
use crate::commands::model::panel_check;
use crate::commands::model::panel_drift::{self, DriftSource, POOR_AGREEMENT};
use crate::commands::{Job, count};
use crate::report::pressure_file::{BodyDrift, FileBody, KEY, NO_DRIFT, PressureFile};
use indicatif::{ProgressBar, ProgressStyle};
use nalgebra::{Complex, Rotation3, Vector3};
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use sysinfo::{ProcessRefreshKind, ProcessesToUpdate, System};
use windlass_base::choice::{Choice, Dof};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_diffraction::{
    DampedPatch, DiffractionBody, DiffractionError, DiffractionProblem, ExcitationDifference, ExcitationPair,
    FrequencyForces, FrequencyLimit, HullMesh, MOTIONS, MeshQuality, MirrorPlanes, Water, WaveSolution,
    excitation_differences,
};
use windlass_hydro::Floating;
use windlass_hydro::database::checks::MODES;
use windlass_hydro::database::radiation::{OgilvieQuality, Radiation};
use windlass_hydro::database::{DatabaseError, capytaine};
use windlass_hydro::wetted_hull::WettedHull;
use windlass_language::source::LARGEST_FILE;
use windlass_model::{AttachedDatabase, Body, Database, DriftMethod, Model, PanelSizes, WaveAction};

/// Panels of the whole hull where no size is given.
const USUAL_PANELS: f64 = 1000.0;
/// Panels a wave length below which a result is poor, and below which it is none.
const POOR_PANELS_A_WAVE: f64 = 8.0;
const LEAST_PANELS_A_WAVE: f64 = 4.0;
/// Most panels of the part of a hull that is solved.
const MAX_PANELS: usize = 20_000;
/// Panels across a rectangle of damped surface, at least.
const LEAST_LID_PANELS: f64 = 2.0;
/// Growth of a size of panels that does not fit, how often it grows (a thousandfold in all), and how often the step that fits is halved.
const SIZE_GROWTH: f64 = 1.15;
const MAX_SIZE_TRIES: usize = 50;
const SIZE_HALVINGS: usize = 5;
/// Bytes of a pair of panels in a symmetry class, its Rankine part included.
const BYTES_A_PAIR: u64 = 24;
/// Bytes that matrices may take where the system does not say how much memory is free.
const USUAL_MEMORY: u64 = 8 << 30;
/// Panels a wave length that the shortest of the usual periods has.
const USUAL_PANELS_A_WAVE: f64 = 16.0;
/// Frequencies where no periods are given: from the first, by a step, to the last (rad/s).
const USUAL_FREQUENCIES: [f64; 3] = [0.1, 0.05, 2.0];
/// Exciting forces by pressure and by Haskind's relation that differ by more than this share of the largest are warned of.
const POOR_EXCITATION: f64 = 0.05;
/// Water below the keel less deep than this share of a panel is warned of: with a half, added mass in heave of a barge with a tenth of its draught below it is
/// 2 % off.
const LEAST_GAP_OF_PANEL: f64 = 0.5;
/// A bottom nearer to the keel than this share of the draught is at it: its image would lie on the panels.
const LEAST_CLEARANCE: f64 = 1e-3;
const HULL_HELP: &str =
    "BLOCK, PGEN, PANEL or a mesh file give closed pieces; &INSTATE -LOCATE or &EQUI puts the body at its draught";
/// The six motions of a body.
const MOTION_NAMES: [&str; 6] = ["surge", "sway", "heave", "roll", "pitch", "yaw"];
/// How the source of a database begins that was made here.
pub const SOURCE: &str = "G_PRESSURE";

/// Bodies that stand or are turned by less than this (m, rad) from each other's planes of symmetry share them.
const SAME_PLACE: f64 = 1e-9;

/// What is asked for.
pub struct PanelRequest {
    /// Where the waves go to, from the heading of the first body (rad).
    pub headings: Vec<f64>,
    /// Periods (s); none chooses them by the panels.
    pub periods: Vec<f64>,
    /// Size of the panels (m); none chooses it by the hulls.
    pub size: Option<f64>,
    /// Size of the panels at sharp edges and at the waterline over that of the others.
    pub edge_share: f64,
    /// Depth (m) instead of that of the environment.
    pub depth: Option<f64>,
    /// Rectangles of damped surface: x and y of two corners in axes of the group (m), and the damping.
    pub lids: Vec<[f64; 5]>,
    /// Whether mean drift is found.
    pub has_drift: bool,
    /// Whether a check of the results follows.
    pub is_checked: bool,
    /// A file of results of another job.
    pub kept: Option<PathBuf>,
    /// Where the record stands.
    pub span: Span,
}

/// A meshed body. Positions are those of the group: x along the heading of its first body, the origin below or above the origin of that body
/// at the water level.
pub struct MeshedBody {
    /// Name of the body.
    pub name: String,
    /// Key of the body.
    pub key: String,
    hull: WettedHull,
    /// Where its origin is (m).
    pub origin: Vector3<f64>,
    /// From there to its centre of gravity (m); of a body without mass to the water level.
    arm: Vector3<f64>,
    /// Its heading from that of the group (rad).
    pub turn: f64,
    has_lid: bool,
    /// Whether its panels are smaller at edges.
    is_refined: bool,
    /// Whether it stands on the bottom.
    stands: bool,
    /// Panels of its mesh, of the part that is solved.
    panels: usize,
    lid_panels: usize,
    /// Displaced volume of its panels, with those of the images (m3).
    volume: f64,
}

/// The bodies of a problem, and what was chosen for them.
pub struct MeshedBodies {
    /// The bodies.
    pub bodies: Vec<MeshedBody>,
    /// Heading of the group (rad), and where its origin is on the plan (m).
    pub heading: f64,
    /// Where the origin of the group is on the plan (m).
    pub place: [f64; 2],
    /// Size of the panels (m).
    pub size: f64,
    /// Size of the panels at sharp edges and at the waterline over that of the others.
    pub edge_share: f64,
    /// Frequencies, growing (rad/s).
    pub frequencies: Vec<f64>,
    /// The water.
    pub water: Water,
    /// Rectangles of damped surface, as they were asked for.
    pub lids: Vec<[f64; 5]>,
    mirrors: MirrorPlanes,
    parts: Vec<DiffractionBody>,
    patches: Vec<DampedPatch>,
}

impl MeshedBodies {
    /// Their names in a sentence.
    pub fn names(&self) -> String {
        let names: Vec<&str> = self.bodies.iter().map(|body| body.name.as_str()).collect();
        match names.as_slice() {
            [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
            list => list.concat(),
        }
    }

    /// Pairs of bodies nearer to each other than half a panel, with the distance (m).
    fn narrow_gaps(&self) -> Vec<(&str, &str, f64)> {
        let room = LEAST_GAP_OF_PANEL * self.size;
        let bodies: Vec<_> = self.bodies.iter().zip(&self.parts).collect();
        let mut found = Vec::new();
        for (index, (body, part)) in bodies.iter().enumerate() {
            for (other, beside) in bodies.iter().skip(index + 1) {
                let gap = part.mesh.gap_within(&beside.mesh, room);
                found.extend(gap.map(|gap| (body.name.as_str(), other.name.as_str(), gap)));
            }
        }
        found
    }

    /// Meshes bodies where they stand.
    ///
    /// # Errors
    /// A hull that cannot be meshed; periods too short for the panels; more panels than memory.
    pub fn new(model: &Model, names: &[String], request: &PanelRequest) -> Outcome<Self> {
        MeshedBodies::within(model, names, request, available_memory())
    }

    /// As [`MeshedBodies::new`], with so many bytes of memory.
    fn within(model: &Model, names: &[String], request: &PanelRequest, available: u64) -> Outcome<Self> {
        let around = model.surroundings();
        let depth = request.depth.or(around.depth.map(|depth| depth + around.tide));
        let water = Water { density: around.water_density, gravity: around.gravity, depth };
        let wrong = |text: String| Diagnostic::error(text, request.span);
        if let Some(fault) = fault_of_lids(&request.lids) {
            return Err(wrong(fault));
        }
        let mut hulls: Vec<(String, &Body, WettedHull)> = Vec::new();
        let mut standing = BTreeSet::new();
        for name in names {
            let key = Model::key(name);
            let Some(body) = model.bodies.get(&key) else { continue };
            let mut hull =
                WettedHull::new(model, body, around.tide).map_err(|error| wrong(error.to_string()).help(HULL_HELP))?;
            let draught = hull.draught();
            let near = draught * LEAST_CLEARANCE;
            if let Some(depth) = depth.filter(|depth| *depth <= draught + near) {
                if depth < draught - near || !hull.stand_on_bottom(depth, near) {
                    let text =
                        format!("{name}: the water is {depth} m deep, and the hull reaches down to {draught:.4} m");
                    return Err(wrong(text).help(
                        "-DEPTH gives another depth; &INSTATE -LOCATE or &EQUI puts the body where it floats, or where a flat face of it stands on the bottom",
                    ));
                }
                standing.insert(key.clone());
            }
            hulls.push((key, body, hull));
        }
        let Some((_, first, _)) = hulls.first() else { return Err(wrong("there is no body to mesh".into())) };
        let (heading, place) = (first.position.turn[2], [first.position.shift[0], first.position.shift[1]]);
        let alone = hulls.len() == 1;
        // of several bodies a plane is one if it is one of each of them: those stand along it and are not turned
        let (sine, cosine) = heading.sin_cos();
        let shift_of = |body: &Body| {
            let (dx, dy) = (body.position.shift[0] - place[0], body.position.shift[1] - place[1]);
            let shift = [dx * cosine + dy * sine, dy * cosine - dx * sine];
            shift.map(|x| if x.abs() < SAME_PLACE { 0.0 } else { x })
        };
        let is_plane = |axis: usize| {
            is_mirrored(&request.lids, axis)
                && hulls.iter().all(|(_, body, hull)| {
                    hull.mirrors[axis]
                        && (alone
                            || shift_of(body)[axis] == 0.0 && (body.position.turn[2] - heading).abs() < SAME_PLACE)
                })
        };
        let mirrors = MirrorPlanes { x: is_plane(0), y: is_plane(1) };
        let images = mirrors.images().len() as f64;
        // a hull of own panels is divided by -PANEL alone
        let (own, others): (Vec<&WettedHull>, Vec<&WettedHull>) =
            hulls.iter().map(|(_, _, hull)| hull).partition(|hull| hull.has_own_panels);
        let area: f64 = others.iter().map(|hull| hull.area).sum();
        let usual = (area / (USUAL_PANELS * others.len().max(1) as f64)).sqrt();
        let longest = own.iter().map(|hull| hull.longest_side()).fold(0.0, f64::max);
        // panels larger than the faces are the faces
        let widest = hulls.iter().map(|(_, _, hull)| hull.longest_side()).fold(0.0, f64::max);
        let size = request.size.map_or(usual.max(longest), |size| size.min(widest));
        let of_hull = |hull: &WettedHull| match request.size {
            Some(size) => size,
            None if hull.has_own_panels => hull.longest_side(),
            None => usual,
        };
        // before they are made, and with those of the lids after that
        let least = |hull: &WettedHull| {
            let divided = hull.area / of_hull(hull).powi(2);
            if hull.has_own_panels { divided.max(hull.face_count() as f64) } else { divided }
        };
        let expected = hulls.iter().map(|(_, _, hull)| least(hull)).sum::<f64>() / images;
        let refused = |problem: &ProblemSize, hulls: &[&WettedHull]| {
            let text = format!("{}: {}", names.join(", "), problem.sentence(available));
            let at_size = |size: f64| {
                let sizes = PanelSizes { largest: size, edge_share: request.edge_share };
                ProblemSize::of_panels(hulls, &request.lids, mirrors, sizes)
            };
            let fitting = least_fitting_size(size, problem, available, at_size);
            let lids = if problem.of_patches > 0.0 { "smaller rectangles of -LID" } else { "smaller hulls" };
            wrong(text).help(match fitting {
                Some(size) => format!("-PANEL {size} fits, or {lids}, or hulls with planes of symmetry"),
                None => format!(
                    "no -PANEL that the hulls and lids have room for fits: {lids}, or hulls with planes of symmetry"
                ),
            })
        };
        let damped: f64 =
            request.lids.iter().filter_map(|lid| LidPart::new(lid, size, mirrors)).map(|part| part.panels()).sum();
        let rough = ProblemSize { panels: expected + damped, of_lids: damped, of_patches: damped, classes: images };
        if !rough.fits(available) {
            return Err(refused(&rough, &hulls.iter().map(|(_, _, hull)| hull).collect::<Vec<_>>()));
        }
        let mut bodies = Vec::new();
        let mut parts = Vec::new();
        for (key, body, hull) in hulls {
            let open = |error: DiffractionError| wrong(format!("{}: {error}", body.name));
            let turn = body.position.turn[2] - heading;
            let [x, y] = if alone { [0.0; 2] } else { shift_of(body) };
            let shift = Vector3::new(x, y, 0.0);
            let sizes = sizes_on(&hull, of_hull(&hull), request.edge_share);
            let quads = hull.panels(sizes, [mirrors.x, mirrors.y]);
            let plain = HullMesh::new(&quads, mirrors).map_err(open)?;
            // strips of the lid lie along the body
            let (mesh, has_lid) = plain.with_lid().map_or((plain, false), |mesh| (mesh, true));
            let mesh = if alone { mesh } else { mesh.moved(turn, shift).map_err(open)? };
            let stands = standing.contains(&key);
            // without panels on the bottom that by heights is none
            let volume = mesh.volumes()[if stands { 0 } else { 2 }].abs() * images;
            let origin = shift + Vector3::new(0.0, 0.0, hull.origin_height);
            // loads that contradict themselves are said where motions need them
            let centre =
                Floating::at_rest(model, body).ok().filter(|own| own.mass.mass > 0.0).map(|own| own.mass.centre);
            let to_group = Rotation3::from_axis_angle(&Vector3::z_axis(), turn).matrix() * hull.axes.transpose();
            let arm = centre.map_or(Vector3::new(0.0, 0.0, -hull.origin_height), |centre| to_group * centre);
            let (panels, lid_panels) = (mesh.hull().len(), mesh.lid().len());
            let (name, is_refined) = (body.name.clone(), hull.is_refined_by(sizes));
            bodies.push(MeshedBody {
                name,
                key,
                hull,
                origin,
                arm,
                turn,
                has_lid,
                is_refined,
                stands,
                panels,
                lid_panels,
                volume,
            });
            parts.push(DiffractionBody { mesh, origin });
        }
        let count = |of: &dyn Fn(&MeshedBody) -> usize| bodies.iter().map(of).sum::<usize>() as f64;
        let patches: Vec<DampedPatch> = request
            .lids
            .iter()
            .map(|lid| {
                let quads = LidPart::new(lid, size, mirrors).map_or_else(Vec::new, |part| part.quads());
                DampedPatch { quads, epsilon: lid[4] }
            })
            .collect();
        let of_lids = count(&|body| body.lid_panels) + damped;
        let panels = count(&|body| body.panels) + of_lids;
        let whole = ProblemSize { panels, of_lids, of_patches: damped, classes: images };
        if !whole.fits(available) {
            return Err(refused(&whole, &bodies.iter().map(|body| &body.hull).collect::<Vec<_>>()));
        }
        let frequencies = choose_frequencies(names, request, size, water)?;
        let lids = request.lids.clone();
        let edge_share = request.edge_share;
        Ok(MeshedBodies { bodies, heading, place, size, edge_share, frequencies, water, lids, mirrors, parts, patches })
    }

    /// The problem of the bodies.
    ///
    /// # Errors
    /// Bodies that overlap; a bottom above a keel; an open mesh.
    pub fn problem(&self, span: Span) -> Outcome<DiffractionProblem> {
        DiffractionProblem::with_damped_surface(&self.parts, self.water, &self.patches).map_err(|error| {
            let names: Vec<&str> = self.bodies.iter().map(|body| body.name.as_str()).collect();
            let said = Diagnostic::error(format!("{}: {error}", names.join(", ")), span);
            let named: Vec<String> = names.iter().enumerate().map(|(i, name)| format!("{} is {name}", i + 1)).collect();
            if names.len() == 1 { said } else { said.help(format!("of the bodies {}", named.join(", "))) }
        })
    }

    /// The bodies with their meshes.
    pub fn meshes(&self) -> impl Iterator<Item = (&MeshedBody, &HullMesh)> {
        self.bodies.iter().zip(self.parts.iter().map(|part| &part.mesh))
    }

    /// How good the panels of each body are, with its name and their number.
    pub fn qualities(&self) -> Vec<(String, MeshQuality, usize)> {
        let of = |(body, mesh): (&MeshedBody, &HullMesh)| {
            let bottom = self.water.depth.filter(|_| body.stands);
            (body.name.clone(), MeshQuality::new(mesh, bottom), mesh.hull().len())
        };
        self.meshes().map(of).collect()
    }

    /// The panels of all hulls, with those of the images.
    pub fn panel_count(&self) -> usize {
        self.bodies.iter().map(|body| body.panels).sum::<usize>() * self.mirrors.images().len()
    }

    /// The sizes of the panels that were asked for.
    fn sizes(&self) -> PanelSizes {
        PanelSizes { largest: self.size, edge_share: self.edge_share }
    }

    /// The size of the panels at edges (m), where some are refined.
    fn edge_size(&self) -> Option<f64> {
        self.bodies.iter().any(|body| body.is_refined).then_some(self.size * self.edge_share)
    }

    /// The length of the shortest wave (m).
    pub fn shortest_wave(&self) -> f64 {
        self.frequencies.last().map_or(f64::INFINITY, |w| wave_length(*w, self.water))
    }

    /// What the results depend on, as a hash: meshes, water, frequencies, headings, and what moves the bodies.
    fn key(&self, headings: &[f64], drift: &DriftSource) -> String {
        let mut hasher = Sha256::new();
        hasher.update(concat!("G_PRESSURE ", env!("CARGO_PKG_VERSION"), " ", 9));
        let mut add = |numbers: &mut dyn Iterator<Item = f64>| numbers.for_each(|x| hasher.update(x.to_le_bytes()));
        let Water { density, gravity, depth } = self.water;
        add(&mut [density, gravity, depth.unwrap_or(f64::INFINITY), self.size, self.edge_share].into_iter());
        add(&mut self.frequencies.iter().chain(headings).copied());
        add(&mut [
            self.frequencies.len() as f64,
            f64::from(u8::from(self.mirrors.x)),
            f64::from(u8::from(self.mirrors.y)),
        ]
        .into_iter());
        for (body, part) in self.bodies.iter().zip(&self.parts) {
            add(&mut [body.turn, body.hull.volume].into_iter().chain(part.origin.iter().copied()));
            add(&mut body.hull.axes.iter().copied());
            for panels in [part.mesh.hull(), part.mesh.lid()] {
                add(&mut [panels.len() as f64].into_iter());
                add(&mut panels.iter().flat_map(|panel| panel.corners()).flat_map(|corner| corner.iter().copied()));
            }
        }
        add(&mut self.lids.iter().flatten().copied());
        for number in panel_drift::numbers(drift, self, headings) {
            hasher.update(number.to_le_bytes());
        }
        for body in &self.bodies {
            hasher.update(&body.name);
        }
        hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// The bodies as a file has them.
    fn file_bodies(&self) -> Vec<FileBody> {
        let of = |body: &MeshedBody| FileBody {
            name: body.name.clone(),
            origin: body.origin,
            axes: body.hull.axes * Rotation3::from_axis_angle(&Vector3::z_axis(), -body.turn).matrix(),
            heading: body.turn,
            mass: body.hull.volume * self.water.density,
        };
        self.bodies.iter().map(of).collect()
    }

    /// The databases of the bodies by the bytes of a file.
    pub fn databases(&self, bytes: &[u8]) -> Result<Vec<Database>, String> {
        let alone = self.bodies.len() == 1;
        let source = if alone { SOURCE.to_owned() } else { format!("{SOURCE} of {}", self.names()) };
        let of = |i: usize| {
            let data = capytaine::read(&source, bytes, (!alone).then_some(i + 1)).map_err(|error| error.to_string())?;
            Ok(Database { panels: Some(self.sizes()), ..data })
        };
        (0..self.bodies.len()).map(of).collect()
    }
}

/// The sizes of panels on a hull: own panels are not refined, and of panels larger than the hull one a face is left.
fn sizes_on(hull: &WettedHull, size: f64, edge_share: f64) -> PanelSizes {
    let largest = size.min(hull.longest_side());
    PanelSizes { largest, edge_share: if hull.has_own_panels { 1.0 } else { edge_share } }
}

/// Whether all rectangles of damped surface are the same on both sides of a plane.
fn is_mirrored(lids: &[[f64; 5]], axis: usize) -> bool {
    let sorted = |[x0, y0, x1, y1, epsilon]: &[f64; 5]| [x0.min(*x1), y0.min(*y1), x0.max(*x1), y0.max(*y1), *epsilon];
    let all: Vec<[f64; 5]> = lids.iter().map(sorted).collect();
    all.iter().all(|own| {
        let mut image = *own;
        (image[axis], image[axis + 2]) = (-own[axis + 2], -own[axis]);
        all.iter().any(|other| other.iter().zip(&image).all(|(a, b)| (a - b).abs() <= SAME_PLACE))
    })
}

/// What is wrong with rectangles of damped surface, in words.
fn fault_of_lids(lids: &[[f64; 5]]) -> Option<String> {
    let sides = |[x0, y0, x1, y1, _]: &[f64; 5]| [[x0.min(*x1), x0.max(*x1)], [y0.min(*y1), y0.max(*y1)]];
    lids.iter().map(sides).enumerate().find_map(|(i, own)| {
        if own.iter().any(|[low, high]| high - low <= SAME_PLACE) {
            return Some(format!("the rectangle of -LID {} has no area", i + 1));
        }
        let other = lids[..i]
            .iter()
            .map(sides)
            .position(|other| own.iter().zip(&other).all(|([a, b], [c, d])| b.min(*d) - a.max(*c) > SAME_PLACE))?;
        Some(format!("the rectangles of -LID {} and -LID {} overlap", other + 1, i + 1))
    })
}

/// The part of a rectangle of damped surface that is solved for: its limits along x and y, and panels along both, two at least.
struct LidPart {
    limits: [[f64; 2]; 2],
    counts: [f64; 2],
}

impl LidPart {
    /// None of a lid on the other side of a mirror plane, which is the image of one on this side.
    fn new([x0, y0, x1, y1, _]: &[f64; 5], size: f64, mirrors: MirrorPlanes) -> Option<Self> {
        let part = |a: f64, b: f64, is_mirrored: bool| {
            let (low, high) = (a.min(b), a.max(b));
            if is_mirrored { [low.max(0.0), high] } else { [low, high] }
        };
        let limits = [part(*x0, *x1, mirrors.x), part(*y0, *y1, mirrors.y)];
        let counts = limits.map(|[low, high]| ((high - low) / size).ceil().max(LEAST_LID_PANELS));
        limits.iter().all(|[low, high]| high - low > SAME_PLACE).then_some(LidPart { limits, counts })
    }

    fn panels(&self) -> f64 {
        self.counts[0] * self.counts[1]
    }

    /// Its panels, as many as were found to fit.
    fn quads(&self) -> Vec<[Vector3<f64>; 4]> {
        let at = |i: usize, j: usize| {
            let along = |axis: usize, place: usize| {
                let [low, high] = self.limits[axis];
                low + (high - low) * place as f64 / self.counts[axis]
            };
            Vector3::new(along(0, i), along(1, j), 0.0)
        };
        let [columns, rows] = self.counts.map(|count| count as usize);
        (0..columns)
            .flat_map(|i| (0..rows).map(move |j| (i, j)))
            .map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
            .collect()
    }
}

/// What a problem takes.
struct ProblemSize {
    /// Panels of a symmetry class, those of the lids among them.
    panels: f64,
    of_lids: f64,
    /// Of these lids those that are given.
    of_patches: f64,
    classes: f64,
}

impl ProblemSize {
    /// That of hulls and given lids in panels of sizes; none where the panels make no mesh.
    fn of_panels(
        hulls: &[&WettedHull],
        lids: &[[f64; 5]],
        mirrors: MirrorPlanes,
        PanelSizes { largest: size, edge_share }: PanelSizes,
    ) -> Option<Self> {
        let of_patches: f64 =
            lids.iter().filter_map(|lid| LidPart::new(lid, size, mirrors)).map(|part| part.panels()).sum();
        let (mut of_hulls, mut of_lids) = (0.0, of_patches);
        for hull in hulls {
            let quads = hull.panels(sizes_on(hull, size, edge_share), [mirrors.x, mirrors.y]);
            let plain = HullMesh::new(&quads, mirrors).ok()?;
            of_hulls += plain.hull().len() as f64;
            of_lids += plain.with_lid().map_or(0.0, |mesh| mesh.lid().len() as f64);
        }
        Some(ProblemSize { panels: of_hulls + of_lids, of_lids, of_patches, classes: mirrors.images().len() as f64 })
    }

    fn bytes(&self) -> f64 {
        self.panels * self.panels * self.classes * BYTES_A_PAIR as f64
    }

    fn fits(&self, available: u64) -> bool {
        self.panels <= MAX_PANELS as f64 && self.bytes() <= available as f64
    }

    fn sentence(&self, available: u64) -> String {
        let [needed, free] = [self.bytes(), available as f64].map(gigabytes);
        let lids = if self.of_lids > 0.0 { format!(", {:.0} of them of lids,", self.of_lids) } else { String::new() };
        format!(
            "about {:.0} panels{lids} in each of {:.0} symmetry classes take {needed} of memory: {free} are free, and {MAX_PANELS} panels are the most",
            self.panels, self.classes
        )
    }
}

/// The least size of panels (m) with which a problem fits into memory that does not with a size, to three digits: the problem counts its panels, whole ones along
/// each side. None where none fits.
fn least_fitting_size(
    size: f64,
    refused: &ProblemSize,
    available: u64,
    at_size: impl Fn(f64) -> Option<ProblemSize>,
) -> Option<f64> {
    if !(size.is_finite() && size > 0.0) {
        return None;
    }
    let fits = |size: f64| at_size(size).is_some_and(|problem| problem.fits(available));
    let rounded_up = |size: f64| {
        let digit = 10_f64.powf(size.log10().floor() - 2.0);
        // through decimals, so that it is printed with three digits
        let text =
            format!("{:.*}", (2.0 - size.log10().floor()).max(0.0) as usize, (size / digit - 1e-6).ceil() * digit);
        text.parse().unwrap_or(size)
    };
    // panels go as the inverse square of their size where that divides all, memory as the square of panels
    let by_memory = (refused.bytes() / (available as f64).max(1.0)).powf(0.25);
    let by_count = (refused.panels / MAX_PANELS as f64).sqrt();
    let first = size * by_memory.max(by_count).max(1.0);
    // smaller ones are more than fit: they are not meshed
    let (mut low, mut high) = (first / SIZE_GROWTH, first);
    let mut tries = 0;
    while !fits(rounded_up(high)) {
        tries += 1;
        if tries > MAX_SIZE_TRIES {
            return None;
        }
        (low, high) = (high, high * SIZE_GROWTH);
    }
    for _ in 0..SIZE_HALVINGS {
        let middle = (low * high).sqrt();
        if fits(rounded_up(middle)) { high = middle } else { low = middle }
    }
    Some(rounded_up(high))
}

/// Bytes in words.
fn gigabytes(bytes: f64) -> String {
    if bytes < 1e8 { format!("{:.2} MB", bytes * 1e-6) } else { format!("{:.2} GB", bytes * 1e-9) }
}

/// Bytes of memory that this program may take: what is free, and what the limits of its job or container leave.
fn available_memory() -> u64 {
    let Ok(mut system) = System::new() else { return USUAL_MEMORY };
    system.refresh_memory();
    let free = Some(system.available_memory()).filter(|bytes| *bytes > 0).unwrap_or(USUAL_MEMORY);
    let Ok(own) = sysinfo::get_current_pid() else { return free };
    system.refresh_processes_specifics(ProcessesToUpdate::Some(&[own]), true, ProcessRefreshKind::nothing());
    let limits = system.process(own).and_then(sysinfo::Process::cgroup_limits);
    // what files have left in memory is given back
    limits.map_or(free, |limits| free.min(limits.total_memory.saturating_sub(limits.rss)))
}

/// The frequencies (rad/s), growing, of panels small enough for them all.
fn usual_frequencies() -> impl DoubleEndedIterator<Item = f64> {
    let [first, step, last] = USUAL_FREQUENCIES;
    let all = ((last - first) / step).round() as u32;
    (0..=all).map(move |i| first + step * f64::from(i))
}

/// Which of the usual periods the panels of a problem do not carry, where there are some.
fn left_out_periods(meshed: &MeshedBodies) -> Option<String> {
    let (shortest, last) = (usual_frequencies().next_back()?, *meshed.frequencies.last()?);
    (last < shortest).then(|| {
        format!(
            "{}: the usual periods below {:.2} s are left out, as their waves have less than {USUAL_PANELS_A_WAVE} panels; -PANEL {:.2} has all, down to {:.2} s, and -PERIOD asks for some",
            meshed.names(),
            TAU / last,
            wave_length(shortest, meshed.water) / USUAL_PANELS_A_WAVE,
            TAU / shortest
        )
    })
}

/// The frequencies (rad/s), growing: those asked for, or what the panels carry of the usual ones.
fn choose_frequencies(names: &[String], request: &PanelRequest, size: f64, water: Water) -> Outcome<Vec<f64>> {
    let wrong = |text: String| Diagnostic::error(format!("{}: {text}", names.join(", ")), request.span);
    let wave = |frequency: f64| wave_length(frequency, water);
    let frequencies: Vec<f64> = if request.periods.is_empty() {
        usual_frequencies().filter(|w| wave(*w) >= USUAL_PANELS_A_WAVE * size).collect()
    } else {
        let mut list: Vec<f64> = request.periods.iter().map(|period| TAU / period).collect();
        list.sort_by(f64::total_cmp);
        list.dedup();
        list
    };
    let Some(shortest) = frequencies.last().map(|w| wave(*w)) else {
        let text = format!("panels of {size:.2} m carry none of the usual periods");
        return Err(wrong(text).help("-PANEL gives a smaller size"));
    };
    if shortest < LEAST_PANELS_A_WAVE * size {
        let text = format!(
            "the shortest wave, of {shortest:.2} m, has {:.1} panels of {size:.2} m; at least {LEAST_PANELS_A_WAVE} are needed",
            shortest / size
        );
        return Err(wrong(text).help(format!(
            "-PANEL {:.2} has eight, or leave the shortest periods out",
            shortest / POOR_PANELS_A_WAVE
        )));
    }
    Ok(frequencies)
}

/// Computes the databases of bodies together, or takes them from the file of an earlier run of the same mesh and settings, and attaches them; the
/// report of it is shown.
///
/// # Errors
/// As of [`MeshedBodies::new`] and [`MeshedBodies::problem`]; an interrupt: the bodies keep what they have.
pub fn compute(job: &mut Job, names: &[String], request: &PanelRequest) -> Outcome<()> {
    let span = request.span;
    let meshed = MeshedBodies::new(&job.model, names, request)?;
    let all = meshed.names();
    let wrong = |text: String| Diagnostic::error(format!("{all}: {text}"), span);
    if let Some(text) = left_out_periods(&meshed).filter(|_| request.periods.is_empty()) {
        job.remark(text, span);
    }
    let mut drift = panel_drift::first_source(&job.model, &meshed, request.has_drift);
    let key = meshed.key(&request.headings, &drift);
    let file = format!("{}.nc", names.join("_"));
    let own = kept_file(job, &file, &key).map(|bytes| (job.output.folder.folder.join(&file), bytes));
    let other = || request.kept.as_ref().and_then(|path| Some((path.clone(), matching_file(path, &key)?)));
    let (read_from, kept) = own.or_else(other).unzip();
    if let Some(why) = kept.as_ref().and_then(|bytes| capytaine::attribute(bytes, NO_DRIFT)) {
        drift = DriftSource::None(why);
    }
    // what cannot be read is computed anew
    let is_whole = |bytes: &Vec<u8>| meshed.databases(bytes).is_ok() && Quality::read(&meshed, bytes).is_ok();
    let (read_from, kept) = if kept.as_ref().is_some_and(|bytes| !is_whole(bytes)) {
        if let Some(path) = &read_from {
            job.remark(format!("{} is damaged: the results are computed", path.display()), span);
        }
        drift = panel_drift::first_source(&job.model, &meshed, request.has_drift);
        (None, None)
    } else {
        (read_from, kept)
    };
    let bytes = match kept {
        Some(bytes) => bytes,
        None => solve(job, &meshed, &mut drift, request, &key)?,
    };
    let databases = meshed.databases(&bytes).map_err(wrong)?;
    let quality = Quality::read(&meshed, &bytes).map_err(|error| wrong(error.to_string()))?;
    match &read_from {
        Some(path) => job.say(&format!("read {}: of the same mesh and settings", path.display())),
        None => {
            if let Some(path) = request.kept.as_ref().filter(|path| matching_file(path, &key).is_none()) {
                let text = format!("{} is of another mesh or other settings: the results are computed", path.display());
                job.remark(text, span);
            }
            keep_file(job, &file, &bytes, span);
        }
    }
    let made = databases.clone();
    let table = report(&meshed, &quality, (&drift.said(&meshed, &made), &made));
    for (body, data) in meshed.bodies.iter().zip(databases) {
        take_hull(&mut job.model, body);
        let attached = AttachedDatabase {
            data: Arc::new(data),
            at: [0.0; 3],
            memory: None,
            drift: DriftMethod::Newman,
            drift_damping: None,
            hydrostatics: false,
            span,
        };
        database::attach(job, &body.name, attached, span);
        settle_pressure(&mut job.model, &body.name);
    }
    warn_of_standing(job, &meshed, span);
    for text in panel_drift::place_warnings(&drift) {
        job.warn(text, span);
    }
    warn_of_quality(job, &meshed, &quality, span);
    for text in panel_drift::roll_warnings(&job.model, &drift, &meshed, &made) {
        job.warn(text, span);
    }
    if let DriftSource::None(why) = &drift
        && request.has_drift
    {
        job.warn(format!("{all}: mean drift is left out: {why}"), span);
    }
    job.say_tables(&[table]);
    if request.is_checked { panel_check::check(job, names, request, &meshed, (&made, &quality)) } else { Ok(()) }
}

/// The databases of bodies with another mesh, which are not kept.
///
/// # Errors
/// As of [`compute`].
pub fn solve_bodies(job: &Job, meshed: &MeshedBodies, request: &PanelRequest) -> Outcome<Vec<Database>> {
    let mut drift = panel_drift::source(&job.model, meshed, request.has_drift);
    let bytes = solve(job, meshed, &mut drift, request, "")?;
    let wrong = |text: String| Diagnostic::error(format!("{}: {text}", meshed.names()), request.span);
    meshed.databases(&bytes).map_err(wrong)
}

/// The bytes of a file of an earlier run that has a key.
fn kept_file(job: &Job, file: &str, key: &str) -> Option<Vec<u8>> {
    matching_file(&job.output.folder.resolve(file).ok()?, key)
}

/// The bytes of a file of results that has a key.
fn matching_file(path: &Path, key: &str) -> Option<Vec<u8>> {
    let size = path.symlink_metadata().ok().filter(|data| data.is_file())?.len();
    if size > LARGEST_FILE {
        return None;
    }
    let bytes = std::fs::read(path).ok()?;
    (capytaine::attribute(&bytes, KEY).as_deref() == Some(key)).then_some(bytes)
}

/// Writes what was computed beside the answers; where that is refused it is said.
fn keep_file(job: &mut Job, file: &str, bytes: &[u8], span: Span) {
    match job.output.folder.write(file, bytes) {
        Ok(path) => job.say(&format!("wrote {}", path.display())),
        Err(error) => job.warn(format!("the results are not kept in a file: {error}"), span),
    }
}

/// Solves the problem of bodies: the bytes of its file.
fn solve(
    job: &Job,
    meshed: &MeshedBodies,
    drift: &mut DriftSource,
    request: &PanelRequest,
    key: &str,
) -> Outcome<Vec<u8>> {
    let span = request.span;
    let all = meshed.names();
    let refused = |error: DiffractionError| Diagnostic::error(format!("{all}: {error}"), span);
    let problem = meshed.problem(span)?;
    let mut surfaces = Vec::new();
    if !matches!(drift, DriftSource::None(_)) {
        match panel_drift::surfaces(meshed, &problem) {
            Ok(made) => surfaces = made,
            Err(why) => *drift = DriftSource::None(why),
        }
    }
    let go_on = |bar: &ProgressBar| {
        if job.is_interrupted() {
            bar.finish_and_clear();
            return Err(Diagnostic::error(format!("interrupted: {all} keeps the database it had, if any"), span));
        }
        Ok(())
    };
    let mut drifts: Vec<BodyDrift> = Vec::new();
    let mut add_drift = |drift: &mut DriftSource, waves: &WaveSolution| match panel_drift::of_frequency(
        drift,
        meshed,
        &surfaces,
        waves,
        &request.headings,
    ) {
        Ok(row) => drifts.extend(row),
        Err(why) => *drift = DriftSource::None(why),
    };
    // potentials take memory: they are kept only where the drift waits for all frequencies
    let waits = panel_drift::has_critical_damping(&job.model, drift);
    let (mut made, mut energy): (Vec<FrequencyForces>, Vec<f64>) = Default::default();
    let mut waiting: Vec<WaveSolution> = Vec::new();
    let bar = progress_bar(meshed.frequencies.len());
    for frequency in &meshed.frequencies {
        go_on(&bar)?;
        let waves = problem.solve_waves(*frequency, &request.headings).map_err(refused)?;
        energy.push(waves.energy_difference());
        made.push(waves.forces.clone());
        if waits {
            waiting.push(waves);
        } else {
            add_drift(drift, &waves);
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    if waits {
        panel_drift::settle_critical_damping(&job.model, meshed, &made, drift);
        let bar = progress_bar(waiting.len());
        for waves in &waiting {
            go_on(&bar)?;
            add_drift(drift, waves);
            bar.inc(1);
        }
        bar.finish_and_clear();
    }
    let mut drift_check = None;
    if meshed.bodies.len() == 1 {
        panel_drift::remove_noise(&mut drifts);
        drift_check = panel_drift::check_of_largest(drift, meshed, &problem, &drifts, &request.headings);
    }
    let infinite = problem.added_mass_limit(FrequencyLimit::Infinite).map_err(refused)?;
    let zero = match meshed.water.depth {
        None => Some(problem.added_mass_limit(FrequencyLimit::Zero).map_err(refused)?),
        // that of heave has no limit
        Some(_) => None,
    };
    let drift = if let DriftSource::None(why) = drift { Err(why.as_str()) } else { Ok(drifts.as_slice()) };
    let bodies = meshed.file_bodies();
    let file = PressureFile {
        bodies: &bodies,
        water: meshed.water,
        panel_size: meshed.size,
        edge_size: meshed.edge_size(),
        headings: &request.headings,
        forces: &made,
        energy: &energy,
        infinite: &infinite,
        zero: zero.as_ref(),
        lids: &meshed.lids,
        drift,
        drift_check,
        drift_methods: &panel_drift::methods(&surfaces),
        key,
    };
    file.bytes().map_err(|error| Diagnostic::error(format!("{all}: {error}"), span))
}

/// What a solution is worth, frequency by frequency.
pub struct Quality {
    /// Products of the matrix until the equations were solved.
    products: Vec<f64>,
    /// Exciting forces by pressure and by Haskind's relation, moments about the centre of gravity: in which motion they differ most, and by how much.
    haskind: Vec<Option<ExcitationDifference>>,
    /// Largest difference of the damping from the energy of the waves far away, over the largest of its kind.
    pub energy: Vec<f64>,
    /// Largest difference of added mass and damping from their transposes, over the largest of their kind.
    pub asymmetry: Vec<f64>,
    /// Largest difference of the sum of the drifts of several bodies from that by the waves far away, over the largest; of a body alone that of its drift
    /// by a control surface, not finite but where the drift is largest. None where there is no drift.
    drift: Option<Vec<f64>>,
    /// Largest difference of the drift of a body by the pressure on its hull, over its largest; none where there is no drift.
    near_field: Option<Vec<f64>>,
}

impl Quality {
    fn read(meshed: &MeshedBodies, bytes: &[u8]) -> Result<Self, DatabaseError> {
        let numbers = |name: &str| capytaine::numbers(SOURCE, bytes, name);
        let (energy, motions) = (numbers("energy_difference")?, MOTIONS * meshed.bodies.len());
        let has_zero = numbers("omega")?.first() == Some(&0.0);
        let by_frequency =
            |name: &str| Ok(excitation_by_frequency(&numbers(name)?, (usize::from(has_zero), energy.len()), motions));
        let (by_haskind, by_pressure) = (by_frequency("excitation_force")?, by_frequency("pressure_force")?);
        let pairs: Vec<ExcitationPair> = by_haskind
            .into_iter()
            .zip(by_pressure)
            .map(|(by_haskind, by_pressure)| ExcitationPair { by_haskind, by_pressure })
            .collect();
        let arms: Vec<Vector3<f64>> = meshed.bodies.iter().map(|body| body.arm).collect();
        Ok(Quality {
            products: numbers("products")?,
            haskind: excitation_differences(&pairs, &arms),
            energy,
            asymmetry: numbers("asymmetry")?,
            drift: numbers("drift_difference").ok(),
            near_field: numbers("near_field_difference").ok(),
        })
    }

    /// Difference of exciting forces by pressure and by Haskind's relation at a frequency, over the largest of the motion where it is largest.
    pub fn haskind(&self, at: usize) -> f64 {
        self.haskind.get(at).map_or(f64::NAN, |own| own.map_or(0.0, |own| own.share))
    }

    /// The motion where exciting forces differ most at a frequency, with its body where there are several.
    fn worst_motion(&self, meshed: &MeshedBodies, at: usize) -> String {
        let motion = self.haskind.get(at).copied().flatten().map_or(0, |own| own.motion);
        let name = MOTION_NAMES.get(motion % MOTIONS).copied().unwrap_or_default();
        match (meshed.bodies.len(), meshed.bodies.get(motion / MOTIONS)) {
            (2.., Some(body)) => format!("{} {name}", body.name),
            _ => name.to_owned(),
        }
    }
}

/// Exciting forces of a file, frequency by frequency and then heading by heading: real parts of all, and imaginary parts of all, each with frequencies before these and a
/// last one that have none.
fn excitation_by_frequency(
    values: &[f64],
    (before, frequencies): (usize, usize),
    motions: usize,
) -> Vec<Vec<Vec<Complex<f64>>>> {
    let headings = values.len() / (2 * (before + frequencies + 1) * motions).max(1);
    let (re, im) = values.split_at(values.len() / 2);
    let rows = |part: &'_ [f64]| part.chunks_exact(motions).map(<[f64]>::to_vec).collect::<Vec<_>>();
    let together = |(re, im): (Vec<f64>, Vec<f64>)| re.into_iter().zip(im).map(|(a, b)| Complex::new(a, b)).collect();
    let all: Vec<Vec<Complex<f64>>> = rows(re).into_iter().zip(rows(im)).map(together).collect();
    (0..frequencies).map(|i| all.iter().skip((before + i) * headings).take(headings).cloned().collect()).collect()
}

/// The bar of a loop over periods.
pub fn progress_bar(count: usize) -> ProgressBar {
    let bar = ProgressBar::new(count as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos} of {len} periods, {elapsed} gone, {eta} to go") {
        bar.set_style(style);
    }
    bar
}

/// The pieces of a body become those of a database, as -DIFTYPE 3DDIF says it.
fn take_hull(model: &mut Model, body: &MeshedBody) {
    for part in model.parts.values_mut().filter(|part| Model::key(&part.body) == body.key) {
        for piece in &mut part.pieces {
            if body.hull.pieces.contains(&piece.name) && piece.waves == WaveAction::ByForm && piece.member.is_none() {
                piece.waves = WaveAction::Database;
            }
        }
    }
}

/// Warns of bodies that stand on the bottom and could leave it.
fn warn_of_standing(job: &mut Job, meshed: &MeshedBodies, span: Span) {
    for body in meshed.bodies.iter().filter(|body| body.stands) {
        let ignored = job.model.bodies.get(&body.key).map_or(&[][..], |own| &own.ignored);
        let free: Vec<&str> =
            [Dof::Z, Dof::Rx, Dof::Ry].into_iter().filter(|dof| !ignored.contains(dof)).map(Dof::word).collect();
        if !free.is_empty() {
            let text = format!(
                "{} stands on the bottom, and no pressure of waves acts below it: its added mass, damping and wave forces of {} are those of its sides alone; -IGNORE {} holds it there",
                body.name,
                free.join(", "),
                free.join(" ")
            );
            job.warn(text, span);
        }
    }
}

fn warn_of_quality(job: &mut Job, meshed: &MeshedBodies, quality: &Quality, span: Span) {
    let all = meshed.names();
    let differences = (0..meshed.frequencies.len()).map(|at| (at, quality.haskind(at)));
    let worst = differences.reduce(|most, other| if other.1 > most.1 { other } else { most });
    if let Some((at, poor)) = worst.filter(|(_, poor)| *poor > POOR_EXCITATION) {
        // at edges the difference falls as the size
        let finer = meshed.size * POOR_EXCITATION / poor;
        let text = format!(
            "{all}: the exciting forces of {} by pressure and by Haskind's relation differ by {:.1} % of the largest at a period of {:.2} s, more than {:.0} %: the panels are \
             too large for it, and both may be off to one side by several times that; motions are by less, as the radiation is off alike; about -PANEL {finer:.2} would agree",
            quality.worst_motion(meshed, at),
            100.0 * poor,
            TAU / meshed.frequencies.get(at).copied().unwrap_or(f64::NAN),
            100.0 * POOR_EXCITATION
        );
        job.warn(text, span);
    }
    let apart = quality.drift.iter().flatten().copied().filter(|off| off.is_finite()).fold(0.0, f64::max);
    if apart > POOR_AGREEMENT {
        let ways = match meshed.bodies.len() {
            1 => "far away and by a control surface",
            _ => "of all bodies far away and by their control surfaces",
        };
        // the error falls with the square of the size
        let finer = meshed.size * (POOR_AGREEMENT / apart).sqrt();
        let mut text = format!(
            "{all}: mean drift {ways} differs by {:.1} % of the largest, more than {:.0} %: the panels are too large, -PANEL {finer:.2} would agree",
            100.0 * apart,
            100.0 * POOR_AGREEMENT
        );
        if meshed.lids.iter().any(|[.., epsilon]| *epsilon > 0.0) {
            text.push_str(", or damped lids take momentum of the waves, which the drift far away counts as that of the bodies: EPSILON 0 shows what is of the panels");
        }
        job.warn(text, span);
    }
    let shortest = meshed.frequencies.last().map_or(f64::INFINITY, |w| wave_length(*w, meshed.water));
    if shortest < POOR_PANELS_A_WAVE * meshed.size {
        let text = format!(
            "{all}: the shortest wave has {:.1} panels; -PANEL {:.2} has eight",
            shortest / meshed.size,
            shortest / POOR_PANELS_A_WAVE
        );
        job.warn(text, span);
    }
    for body in meshed.bodies.iter().filter(|body| !body.stands) {
        let clearance = meshed.water.depth.map_or(f64::INFINITY, |depth| depth - body.hull.draught());
        if clearance < LEAST_GAP_OF_PANEL * meshed.size {
            let text = format!(
                "{}: the bottom is {clearance:.2} m below its keel, less than half a panel of {:.2} m: the water between needs smaller panels, -PANEL {:.2} at most",
                body.name,
                meshed.size,
                clearance / LEAST_GAP_OF_PANEL
            );
            job.warn(text, span);
        }
    }
    for (one, other, gap) in meshed.narrow_gaps() {
        let text = format!(
            "the gap between {one} and {other} is {gap:.2} m, less than half a panel of {:.2} m: the water between needs smaller panels, -PANEL {:.2} at most",
            meshed.size,
            gap / LEAST_GAP_OF_PANEL
        );
        job.warn(text, span);
    }
    for body in meshed.bodies.iter().filter(|body| !body.has_lid) {
        let text =
            "its waterline does not close, so that it has no lid: results near irregular frequencies are wrong there";
        job.warn(format!("{}: {text}", body.name), span);
    }
}

/// Length of a wave (m), by Newton's iteration of the dispersion relation.
pub fn wave_length(frequency: f64, water: Water) -> f64 {
    let nu = frequency * frequency / water.gravity;
    let Some(depth) = water.depth else { return TAU / nu };
    let mut k = nu / (nu * depth).tanh().sqrt();
    for _ in 0..20 {
        let t = (k * depth).tanh();
        k -= (k * t - nu) / (t + k * depth * (1.0 - t * t));
    }
    TAU / k
}

/// How well added mass and damping go together, in short.
fn ogilvie_figures(quality: &OgilvieQuality) -> String {
    let percent = |(share, direction): (f64, usize)| {
        format!("{:.2} % in {}", 100.0 * share.abs(), MODES.get(direction).copied().unwrap_or_default())
    };
    let limit = quality.shift.map_or_else(|| "too few frequencies".into(), percent);
    format!("A(infinite) {limit}, frequencies {}", percent(quality.stray))
}

/// What the report of a period shows: shares in per cent.
struct PeriodRow {
    period: f64,
    length: f64,
    haskind: f64,
    /// The motion whose exciting forces differ most.
    worst: String,
    products: usize,
    drift: Option<f64>,
    near_field: Option<f64>,
}

/// What was computed, a row a period.
fn report(meshed: &MeshedBodies, quality: &Quality, (drift, databases): (&str, &[Database])) -> Table {
    let water = meshed.water;
    let at = |list: &[f64], i: usize| list.get(i).copied().unwrap_or(f64::NAN);
    let share =
        |list: &Option<Vec<f64>>, i: usize| list.as_ref().map(|list| 100.0 * at(list, i)).filter(|off| off.is_finite());
    let rows: Vec<PeriodRow> = meshed
        .frequencies
        .iter()
        .enumerate()
        .rev()
        .map(|(i, frequency)| PeriodRow {
            period: TAU / frequency,
            length: wave_length(*frequency, water),
            haskind: 100.0 * quality.haskind(i),
            worst: quality.worst_motion(meshed, i),
            products: at(&quality.products, i) as usize,
            drift: share(&quality.drift, i),
            near_field: share(&quality.near_field, i),
        })
        .collect();
    let planes = match (meshed.mirrors.x, meshed.mirrors.y) {
        (false, false) => "none",
        (true, false) => "fore and aft",
        (false, true) => "port and starboard",
        (true, true) => "fore and aft, port and starboard",
    };
    let images = meshed.mirrors.images().len();
    let table = Table::new(format!("Pressures on {}", meshed.names()))
        .with_rows(&rows)
        .column("", "Period", Dim::Time, Digits::Decimals(2), |row| row.period)
        .column("", "Wave Length", Dim::Length, Digits::Decimals(2), |row| row.length)
        .column("", "Panels a Wave", Dim::None, Digits::Decimals(1), |row| row.length / meshed.size)
        .column("", "Haskind", Dim::None, Digits::Decimals(3), |row| row.haskind)
        .text("In", |row| row.worst.as_str())
        .column("", "Products", Dim::None, Digits::Usual, |row| row.products);
    let table = match &quality.drift {
        Some(_) => table.column("", "Drift", Dim::None, Digits::Decimals(2), |row| row.drift),
        None => table,
    };
    let table = match &quality.near_field {
        Some(_) => table.column("", "Near Field", Dim::None, Digits::Decimals(2), |row| row.near_field),
        None => table,
    };
    let mut table = table.build();
    for (body, data) in meshed.bodies.iter().zip(databases) {
        // of several bodies each fact names its own
        let fact = |text: &str| match meshed.bodies.len() {
            1 => text.to_owned(),
            _ => format!("{}: {text}", body.name),
        };
        let lid = match body.lid_panels {
            0 if body.has_lid => "none is needed".to_owned(),
            0 => "none".to_owned(),
            number => count(number, "panel"),
        };
        table = table.fact(&fact("Pieces"), body.hull.pieces.join(" "), Dim::None);
        table = table.fact(&fact("Panels of the Hull"), body.panels * images, Dim::None);
        if images > 1 {
            table = table.fact(&fact("Of These Solved For"), body.panels, Dim::None);
        }
        table = table.fact(&fact("Lid of the Waterplane"), lid, Dim::None);
        if body.stands {
            table = table.fact(&fact("Keel"), "on the bottom, without panels there", Dim::None);
        }
        table = table.fact(&fact("Displaced Volume"), body.hull.volume, Dim::Volume);
        table = table.fact(&fact("By the Panels"), body.volume, Dim::Volume);
        // of one frequency there is none
        if let Some(radiation) = Radiation::new(data).filter(|made| !made.has_one_frequency) {
            table = table.fact(&fact("Ogilvie's Relation"), ogilvie_figures(&radiation.quality), Dim::None);
        }
    }
    for (number, (lid, patch)) in (1..).zip(meshed.lids.iter().zip(&meshed.patches)) {
        let [x0, y0, x1, y1, epsilon] = *lid;
        for (name, length) in [("from X", x0), ("from Y", y0), ("to X", x1), ("to Y", y1)] {
            table = table.fact(&format!("Damping Lid {number} {name}"), length, Dim::Length);
        }
        table = table.fact(&format!("Damping Lid {number} Panels"), patch.quads.len() * images, Dim::None);
        table = table.fact(&format!("Damping Lid {number} Epsilon"), epsilon, Dim::None);
    }
    table = table.fact("Symmetry", planes, Dim::None);
    table = table.fact("Size of Panels", meshed.size, Dim::Length);
    if let Some(size) = meshed.edge_size() {
        table = table.fact("Panels at Edges", size, Dim::Length);
    }
    table = match water.depth {
        Some(depth) => table.fact("Depth", depth, Dim::Length),
        None => table.fact("Depth", "deep water", Dim::None),
    };
    table = table.fact("Mean Drift", drift, Dim::None);
    if meshed.frequencies.len() > 1 {
        table.note("Ogilvie's relation: by how much added mass at infinite frequency is off that by added mass and damping at all others, and these from it, where most");
    }
    table.note(
        "Haskind: difference of exciting forces by pressure and by Haskind's relation, moments about the centre of gravity, per cent of the largest of the motion at the period, and of a fifth of its largest at all periods at least, in that where it is largest",
    );
    if !meshed.lids.is_empty() {
        table.note("the surface of each damping lid takes energy from the waves by its epsilon: what stands here is that of the epsilon that was given, which measurements or a model of the losses have to tell");
    }
    if quality.drift.is_some() {
        table.note(match meshed.bodies.len() {
            1 => "Drift: difference of the mean drift by a control surface from that of the waves far away, which acts, per cent of the largest, at the period of that",
            _ => "Drift: largest difference of the sum of the bodies' drift in surge, sway and yaw (over the distance of the bodies) from that of the waves far away, per cent of the largest force",
        });
    }
    if quality.near_field.is_some() {
        table.note("Near Field: largest difference of the drift of a body by the pressure on its hull from its drift, which acts, per cent of its largest force; beside sharp edges the velocity has no bound, and the pressure needs far smaller panels there");
    }
    table
}

/// The usual headings: all round by 15 degrees (rad).
pub fn usual_headings() -> Vec<f64> {
    (0..24).map(|i| f64::from(i) * PI / 12.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::files::JobFolder;
    use crate::report::output::Output;
    use crate::session::Session;

    #[test]
    fn memory_of_lids_is_counted_and_refused_beyond_what_is_free() {
        // a box of 40 x 12 x 4 m in panels of 2 m: a quarter of its sides and bottom is 56 panels, of its waterplane 30; (56 + 30)^2 x 4 classes x 24 bytes
        // are 0.71 MB, the hull alone 0.30 MB
        let folder = tempfile::tempdir().unwrap();
        let job = JobFolder::new(folder.path().join("job"), None, false);
        let mut session = Session::new(Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false));
        let records = "&DIMEN -DIMEN METERS KN\nMEDIT\n&DESCRIBE BODY B\n*G 0 0 0\n#WEIGHT *G 19293 4 11 11\n&SURFACE\nBLOCK H -20 -6 -4 20 6 4\nEND_&SURFACE\nEND\n";
        session.open("records", records.to_owned());
        session.run();
        let mut request = PanelRequest {
            headings: vec![0.0],
            periods: vec![8.0],
            size: Some(2.0),
            edge_share: 1.0,
            depth: None,
            lids: Vec::new(),
            has_drift: false,
            is_checked: false,
            kept: None,
            span: Span::default(),
        };
        let made = MeshedBodies::within(&session.job.model, &["B".to_owned()], &request, 711_000);
        let made = made.map_err(|error| error.message).unwrap();
        assert_eq!((made.bodies[0].panels, made.bodies[0].lid_panels), (56, 30));
        let refused = MeshedBodies::within(&session.job.model, &["B".to_owned()], &request, 709_000).err().unwrap();
        let text = format!("{} {}", refused.message, refused.help.join(" "));
        assert!(text.contains("30 of them of lids") && text.contains("0.71 MB"), "{text}");
        // the sides are divided by whole panels: ten along a half as far as 20 m/9
        let size: f64 = text.split("-PANEL ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
        assert!((20.0 / 9.0..20.0 / 9.0 * 1.02).contains(&size), "{text}");
        request.size = Some(size);
        let made = MeshedBodies::within(&session.job.model, &["B".to_owned()], &request, 709_000);
        assert!(made.is_ok(), "{text}");
        // a lid of 3 km by 0.2 m has two panels across, whatever their size: its panels go as the inverse of it, and the memory as its inverse square
        request.size = Some(0.2);
        request.lids = vec![[-1500.0, 20.0, 1500.0, 20.2, 0.1]];
        let refused = MeshedBodies::within(&session.job.model, &["B".to_owned()], &request, 20_000_000).err().unwrap();
        let text = format!("{} {}", refused.message, refused.help.join(" "));
        let size: f64 = text
            .split("-PANEL ")
            .nth(1)
            .unwrap_or_else(|| panic!("{text}"))
            .split(' ')
            .next()
            .unwrap()
            .parse()
            .unwrap();
        request.size = Some(size);
        assert!(MeshedBodies::within(&session.job.model, &["B".to_owned()], &request, 20_000_000).is_ok(), "{text}");
        request.size = Some(0.95 * size);
        assert!(MeshedBodies::within(&session.job.model, &["B".to_owned()], &request, 20_000_000).is_err(), "{text}");
        // nothing fits
        let refused = MeshedBodies::within(&session.job.model, &["B".to_owned()], &request, 100).err().unwrap();
        assert!(refused.help.join(" ").contains("no -PANEL"), "{:?}", refused.help);
    }
}
