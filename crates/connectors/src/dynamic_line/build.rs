//! How a dynamic line is made of its class and the ends of its connector.

use super::describe::{LineDescription, LinePart};
use super::element::DynamicLine;
use super::environment::ground;
use super::mesh::{Cut, JOIN_BELOW_SHARE, attachments, check_element_count, mesh, to_class_error};
use super::rod_cache::{Base, EndDirection};
use super::start;
use super::state_layout::StateLayout;
use crate::mooring::no_other_end;
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_line_dynamics::{self as rod, PlaneBottom, Rod, RodState, SeabedShape};
use windlass_model::{ClassError, Connection};

impl DynamicLine {
    /// The line of a class between the ends of a connector.
    ///
    /// # Errors
    /// Properties that make no rod, more elements than memory should hold, no direction for an end that is held.
    pub fn build(description: LineDescription, connection: &Connection) -> Result<Self, ClassError> {
        let around = connection.surroundings;
        if connection.placement.other.is_none() {
            return Err(no_other_end());
        }
        let ambient = connection.ambient.cloned();
        let ends = connection.ends.map(|p| p.origin);
        let known = |p: &LinePart| p.segment.length;
        let class_first = description.parts.first().map_or(0.0, known);
        let first = connection.placement.first_length.unwrap_or(class_first);
        let mut lengths: Vec<f64> = description.parts.iter().map(known).collect();
        if let Some(length) = lengths.first_mut() {
            *length = first;
        }
        check_element_count(&description.parts, first)?;
        let far = ends[1];
        let anchored = description.seabed.with_anchor && connection.to_ground;
        let depth = if anchored { Some(-far.z) } else { description.seabed.depth };
        let plane = description.seabed.slope.filter(|s| *s != 0.0).map(|slope| {
            // it rises from the second end toward the first
            let across = Vector3::new(ends[0].x - far.x, ends[0].y - far.y, 0.0);
            let toward = across.try_normalize(1e-9).unwrap_or_else(Vector3::x);
            let height = depth.map_or(far.z, |d| -d);
            let rise = [toward.x * slope, toward.y * slope];
            PlaneBottom { height: height - rise[0] * far.x - rise[1] * far.y, slope: rise }
        });
        let flat = depth.or(around.depth).map(|d| -d);
        let bottom = plane.or(flat.map(|height| PlaneBottom { height, slope: [0.0; 2] }));
        let shape = match &ambient {
            Some(a) if a.grows() => {
                let floor = bottom.as_ref().map(|b| (b as &dyn SeabedShape, description.seabed.along));
                start::points(&description.parts, &lengths, ends, floor, around)
            }
            _ => Vec::new(),
        };
        let cut = Cut::new(&description.parts, &lengths, ambient.as_deref(), &shape);
        let mut mesh = mesh(&description.parts, first);
        let counts: Vec<usize> =
            (0..description.parts.len()).map(|part| mesh.iter().filter(|e| e.2 == part).count()).collect();
        cut.bands.lay(&mut mesh);
        let attached = attachments(&description.parts, &counts, around.water_density);
        let nominal = description.parts.first().map_or(1.0, |p| p.segment.length / p.segment.elements.max(1) as f64);
        let rod = Rod::with_mesh(&connection.connector.name, cut.segments, attached.clone(), &mesh)
            .map_err(to_class_error)?;
        // the same however much is wound: an element at the winch is never shorter than half of those of the class
        let of_first = counts.first().copied().unwrap_or(0);
        let wound = connection.duty.longest.map(|l| (l / (JOIN_BELOW_SHARE * nominal)).ceil() as usize);
        let capacity =
            (rod.nodes() - 1 - of_first).saturating_add(wound.map_or(of_first, |most| most.saturating_add(2)));
        if capacity > rod::MAX_ELEMENTS {
            return Err(ClassError::new(format!(
                "its winch would make more than {} elements of it",
                rod::MAX_ELEMENTS
            )));
        }
        let holds = end_directions(&description, connection)?;
        let ground = ground(&description.seabed, rod.segments(), around);
        let layout = StateLayout::new(capacity, RodState::packed_len_with(&rod, capacity), connection.duty.balance);
        let base = Base {
            description,
            rod,
            attached,
            bands: cut.bands,
            ambient,
            plane,
            flat,
            ground,
            holds,
            freed: connection.duty.freed,
            scheme: connection.duty.scheme,
            moving_ends: [true, !connection.to_ground],
            laid: None,
        };
        Ok(DynamicLine { base: Arc::new(base), layout, first, nominal })
    }
}

/// The directions in which the ends are held, in the axes of their holders as defined.
fn end_directions(
    description: &LineDescription,
    connection: &Connection,
) -> Result<[Option<EndDirection>; 2], ClassError> {
    let [a, b] = connection.connector.defined;
    let b = if connection.to_ground { windlass_base::pose::Pose { origin: connection.ends[1].origin, ..b } } else { b };
    let chord = b.origin - a.origin;
    let across = Vector3::new(chord.x, chord.y, 0.0).try_normalize(1e-9).unwrap_or_else(Vector3::x);
    let mut made = [None, None];
    for ((position, hold), pose) in made.iter_mut().zip(&description.holds).zip([a, b]) {
        let Some(hold) = hold else { continue };
        let direction = match hold.declination {
            Some(angle) => across * angle.sin() - Vector3::z() * angle.cos(),
            None => chord.try_normalize(1e-9).ok_or_else(|| {
                ClassError::new("the two ends are at one place: an end that is held has no direction there")
            })?,
        };
        *position = Some((pose.axes.transpose() * direction, hold.stiffness));
    }
    Ok(made)
}
