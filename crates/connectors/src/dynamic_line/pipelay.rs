//! How a pipe is laid: its course over the supports to the bottom, and its length.

use super::describe::{LineDescription, LinePart};
use super::element::DynamicLine;
use super::environment::ground;
use super::mesh::{Cut, check_element_count, mesh, to_class_error};
use super::pipelay_supports::{PipeLay, SupportedPart, Tensioner};
use super::rod_cache::{Base, RodCache};
use super::state_layout::StateLayout;
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;
use windlass_base::pose::Pose;
use windlass_base::units::Dim;
use windlass_line_dynamics::{self as rod, Rod, RodState};
use windlass_model::{ClassError, End, PipeLayout, Situation};

/// Elements between two supports, where -REFINE does not say.
const ELEMENTS_BETWEEN_SUPPORTS: usize = 8;
/// Elements over a length sqrt(EI/H), in which the bend at an end decays, where -REFINE does not say.
const PER_LAYER: f64 = 4.0;
/// Fewest and most elements from the first support on, where -REFINE does not say.
const FREE_SPAN_ELEMENTS: [f64; 2] = [60.0, 3000.0];
/// Length over which the brake of the tensioner yields as the pipe does (m).
const BRAKE_LENGTH_M: f64 = 10.0;
/// How often it is cut at the tensioner until it ends there.
const MAX_LENGTH_CORRECTIONS: usize = 4;
/// How far from the tensioner it may end (m).
const TENSIONER_TOLERANCE_M: f64 = 1e-3;
/// Least cosine of the angle between the X axis of a support and the way of the pipe.
const MIN_SUPPORT_COSINE: f64 = 0.5;

/// Where a pipe goes before it comes to rest.
struct PipePath {
    /// Corners, from the tensioner (m).
    points: Vec<Vector3<f64>>,
    /// Point of each support, from the first to the tensioner.
    at: Vec<usize>,
    /// Elements and length (m) of each span, from the tensioner, and of what is beyond the first support.
    spans: Vec<(usize, f64)>,
    /// Tension at the tensioner (N).
    pulled: f64,
}

impl PipePath {
    /// Straight from support to support; a catenary from the first to the bottom, and as much again on it.
    fn new(part: &LinePart, layout: &PipeLayout, bottom: f64) -> Result<PipePath, ClassError> {
        let around = layout.surroundings;
        let segment = part.with_growth(layout.ambient.map(|a| a.as_ref()), 0.5 * bottom);
        let weight = |density: f64| (segment.mass - density * segment.displaced) * around.gravity;
        let (in_air, in_water) = (weight(0.0), weight(around.water_density));
        let hung = |(node, hang): (&Pose, &f64)| node.origin - Vector3::z() * *hang;
        let stations: Vec<_> = layout.nodes.iter().zip(&layout.hang).map(hung).collect();
        let (Some(first), Some(last)) = (stations.first(), stations.last()) else {
            return Err(ClassError::new("a pipe needs a support"));
        };
        let single = stations.len() < 2;
        let height = first.z - bottom;
        let risen = in_air * (last.z - first.z);
        // TLOW is the tension at the first davit; on rollers the tensioner begins between its limits
        let pulled = match layout.upper {
            Some(upper) if single => upper,
            Some(upper) => 0.5 * (layout.lower + upper),
            None => layout.lower + risen,
        };
        // by weight from the tensioner down to the first support, and from there to the bottom
        let dry = (first.z - around.tide).clamp(0.0, height.max(0.0));
        let horizontal = pulled - risen - in_air * dry - in_water * (height - dry);
        if height <= 0.0 || in_water <= 0.0 || horizontal <= 0.0 {
            let text = "its tension of {} does not carry it to the bottom, {} below the first support, at {} in water";
            let values = [(pulled, Dim::Force), (height, Dim::Length), (in_water, Dim::ForcePerLength)];
            return Err(
                ClassError::with_values(text, &values).help("-PIPE_TENSION needs more than weight times height")
            );
        }
        let elements = |length: f64, own: f64| {
            let counted = segment.length / segment.elements as f64;
            let wanted = if segment.elements > 1 { (length / counted).ceil() } else { own };
            wanted.clamp(1.0, rod::MAX_ELEMENTS as f64) as usize
        };
        let mut made = PipePath { points: vec![*last], at: Vec::new(), spans: Vec::new(), pulled };
        made.at.push(0);
        for pair in stations.windows(2).rev() {
            let [near, far] = pair else { continue };
            made.extend_to(elements((near - far).norm(), ELEMENTS_BETWEEN_SUPPORTS as f64), |s| far + (near - far) * s);
            made.at.insert(0, made.points.len() - 1);
        }
        let layer = (segment.bending / horizontal).sqrt();
        if single {
            let own = (height / layer * PER_LAYER).clamp(FREE_SPAN_ELEMENTS[0], FREE_SPAN_ELEMENTS[1]).ceil();
            made.extend_to(elements(height, own), |s| first - Vector3::z() * (height * s));
            return Ok(made);
        }
        let across = Vector3::new(first.x - last.x, first.y - last.y, 0.0);
        let Some(toward) = across.try_normalize(1e-9) else {
            return Err(ClassError::new("its first and last support stand above each other, so that it goes nowhere"));
        };
        let a = horizontal / in_water;
        let arc = (height * height + 2.0 * height * a).sqrt();
        let whole = arc + arc.max(20.0 * layer);
        let own = (whole / layer * PER_LAYER).clamp(FREE_SPAN_ELEMENTS[0], FREE_SPAN_ELEMENTS[1]).ceil();
        let landed = a * (arc / a).asinh();
        made.extend_to(elements(whole, own), |s| {
            let up = arc - whole * s;
            let (along, z) =
                if up > 0.0 { (landed - a * (up / a).asinh(), a.hypot(up) - a) } else { (landed - up, 0.0) };
            Vector3::new(first.x, first.y, bottom + z) + toward * along
        });
        Ok(made)
    }

    /// Lifts what lies lower onto a bottom over a grid; the far end lies on it.
    fn settle_on(&mut self, layout: &PipeLayout) {
        let Some(ambient) = layout.ambient.filter(|a| a.has_bottom_grid()) else { return };
        let end = self.points.len().saturating_sub(1);
        for (i, point) in self.points.iter_mut().enumerate() {
            if let Some((height, _)) = ambient.bottom(point.x, point.y) {
                point.z = if i == end { height } else { point.z.max(height) };
            }
        }
    }

    /// Goes on by a span of so many elements to the points at shares of it.
    fn extend_to(&mut self, elements: usize, at: impl Fn(f64) -> Vector3<f64>) {
        let mut length = 0.0;
        for n in 1..=elements {
            let point = at(n as f64 / elements as f64);
            length += self.points.last().map_or(0.0, |before| (point - before).norm());
            self.points.push(point);
        }
        self.spans.push((elements, length));
    }
}

impl DynamicLine {
    /// A pipe laid over its supports: its first part's section, as long as it needs to be.
    ///
    /// # Errors
    /// No depth, a support below the bottom, a tension too small to reach the bottom, supports along which it cannot run, no rest.
    pub fn build_pipe(description: LineDescription, layout: PipeLayout) -> Result<Self, ClassError> {
        let PipeLayout { supports, nodes, surroundings, .. } = &layout;
        check_options(&description, &layout)?;
        let part = description.parts.first().ok_or_else(|| ClassError::new("the class has no record"))?;
        let mut course = PipePath::new(part, &layout, bottom(&description, &layout)?)?;
        course.settle_on(&layout);
        let held = find_supported_parts(&layout, &course)?;
        // a riser goes down from its roller
        let down = Matrix3::new(0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0);
        let turn = if nodes.len() < 2 { down } else { Matrix3::identity() };
        let mut tensioner = tensioner(&layout, course.pulled)?;
        let ends: Vec<End> = nodes.iter().map(|n| End::at_rest(*n)).collect();
        let at = Situation { ends: &ends, step: None, surroundings };
        let stretched = 1.0 + course.pulled / part.ea();
        course.spans.iter_mut().for_each(|(_, length)| *length /= stretched);
        for cut in 0.. {
            let laid = PipeLay {
                supports: supports.clone(),
                holds: held.clone(),
                tensioner,
                turn,
                anchor: course.points.last().copied().unwrap_or_default(),
                shape: course.points.clone(),
            };
            let line = along_course(&description, part, &layout, (&course, laid))?;
            let Some(tensioner) = tensioner.as_mut().filter(|t| t.stiffness == 0.0) else { return Ok(line) };
            // it is cut where the tensioner holds it as laid
            let rest = line.find_rest(&at, &mut RodCache::new(&line.base))?.state;
            let end = ends.last().zip(rest.node_position(0));
            let short =
                end.map_or(0.0, |(end, x)| (end.pose.axes * turn * tensioner.along).dot(&(x - end.pose.origin)));
            course.points = rest.node_positions();
            match course.spans.first_mut() {
                Some((_, length))
                    if short.abs() > TENSIONER_TOLERANCE_M && cut < MAX_LENGTH_CORRECTIONS && *length + short > 0.0 =>
                {
                    *length += short
                }
                _ => (tensioner.at, tensioner.stiffness) = (short, part.ea() / BRAKE_LENGTH_M),
            }
        }
        Err(ClassError::new("it does not end at its tensioner"))
    }
}

/// What of its class a pipe cannot have.
fn check_options(description: &LineDescription, layout: &PipeLayout) -> Result<(), ClassError> {
    if description.seabed.slope.is_some_and(|s| s != 0.0) {
        let error = ClassError::new("a pipe is laid on the bottom of the environment, and its class has a -SLOPE");
        return Err(error.help("&BATHYMETRY and &ENV -BATHYMETRY make a bottom that slopes"));
    }
    if description.holds.iter().any(Option::is_some) {
        return Err(ClassError::new("a pipe is held by its supports, and its class has a -CLAMP"));
    }
    if description.parts.first().is_some_and(|p| p.joint.is_some()) {
        return Err(ClassError::new("a pipe is alike all along, and its class has a -CLUMP"));
    }
    if layout.upper.is_none() && layout.nodes.len() < 2 {
        let error = ClassError::new("a pipe hangs from two davits or more");
        return Err(error.help("a single roller makes a vertical riser of it"));
    }
    Ok(())
}

/// Elevation of the bottom (m) below the support nearest to it.
fn bottom(description: &LineDescription, layout: &PipeLayout) -> Result<f64, ClassError> {
    let first = layout.nodes.first().map(|n| n.origin).unwrap_or_default();
    let charted = layout.ambient.filter(|a| a.has_bottom_grid()).and_then(|a| a.bottom(first.x, first.y));
    let flat = description.seabed.depth.or(layout.surroundings.depth).map(|depth| -depth);
    charted.map(|(height, _)| height).or(flat).ok_or_else(|| {
        ClassError::new("a pipe is laid on the bottom, and there is no depth").help("&ENV -DEPTH gives one")
    })
}

/// The pipe of a course.
fn along_course(
    description: &LineDescription,
    part: &LinePart,
    layout: &PipeLayout,
    (course, laid): (&PipePath, PipeLay),
) -> Result<DynamicLine, ClassError> {
    let around = layout.surroundings;
    let sized = |(elements, length): &(usize, f64)| {
        let mut made = part.clone();
        (made.segment.length, made.segment.elements) = (*length, *elements);
        made
    };
    let parts: Vec<LinePart> = course.spans.iter().map(sized).collect();
    let lengths: Vec<f64> = course.spans.iter().map(|(_, length)| *length).collect();
    let (elements, first) = course.spans.first().copied().unwrap_or((1, 0.0));
    let grown = if layout.ambient.is_some_and(|a| a.grows()) { course.points.as_slice() } else { &[] };
    check_element_count(&parts, first)?;
    let cut = Cut::new(&parts, &lengths, layout.ambient.map(|a| a.as_ref()), grown);
    let mut mesh = mesh(&parts, first);
    cut.bands.lay(&mut mesh);
    let rod = Rod::with_mesh(layout.name, cut.segments, Vec::new(), &mesh).map_err(to_class_error)?;
    Ok(DynamicLine {
        layout: StateLayout::new(rod.nodes() - 1, RodState::packed_len(&rod) + 2, layout.balance),
        first,
        nominal: first / elements as f64,
        base: Arc::new(Base {
            description: description.clone(),
            attached: Vec::new(),
            bands: cut.bands,
            ground: ground(&description.seabed, rod.segments(), around),
            rod,
            ambient: layout.ambient.cloned(),
            plane: None,
            flat: description.seabed.depth.or(around.depth).map(|depth| -depth),
            holds: [None, None],
            freed: false,
            scheme: layout.scheme,
            moving_ends: [false, false],
            laid: Some(laid),
        }),
    })
}

/// The tensioner of a pipe on rollers, which pulls as it does when it is laid however far its end is.
fn tensioner(layout: &PipeLayout, pulled: f64) -> Result<Option<Tensioner>, ClassError> {
    let (Some(upper), [.., last]) = (layout.upper, layout.nodes.as_slice()) else { return Ok(None) };
    let along = match layout.nodes.as_slice() {
        [first, .., _] => direction_through_support(last, layout.ways.last(), &first.origin)?,
        _ => Vector3::x(),
    };
    Ok(Some(Tensioner { along, at: 0.0, tension: [pulled, layout.lower, upper], stiffness: 0.0 }))
}

/// What each support holds: davits the nodes below them, rollers what crosses them, and the last of them the end.
fn find_supported_parts(layout: &PipeLayout, course: &PipePath) -> Result<Vec<SupportedPart>, ClassError> {
    let last = layout.nodes.len().saturating_sub(1);
    let of =
        |(i, (node, at)): (usize, (&Pose, &usize))| match layout.nodes.get(i + 1).filter(|_| layout.upper.is_some()) {
            Some(next) if i < last => {
                Ok(SupportedPart::Crossing(-direction_through_support(node, layout.ways.get(i), &next.origin)?))
            }
            _ => Ok(SupportedPart::Node(*at)),
        };
    layout.nodes.iter().zip(&course.at).enumerate().map(of).collect()
}

/// The way of a pipe through a support, in the axes of its node: along the X axis of its law, toward a place.
fn direction_through_support(
    node: &Pose,
    x: Option<&Vector3<f64>>,
    position: &Vector3<f64>,
) -> Result<Vector3<f64>, ClassError> {
    let x = x.copied().unwrap_or_else(Vector3::x);
    let way = (position - node.origin).try_normalize(1e-9).map_or(0.0, |way| way.dot(&(node.axes * x)));
    if way.abs() < MIN_SUPPORT_COSINE {
        let error = ClassError::new("a pipe runs along the X axes of its supports, and these lie across it");
        return Err(error.help("-EULER of the CONNECTOR turns the axes of a roller"));
    }
    Ok(x * way.signum())
}
