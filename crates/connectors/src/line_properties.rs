//! Line classes in numbers that do not depend on an engine, from the parts of their dynamic lines.

use super::dynamic_line::{LinePart, Seabed};
use windlass_line_dynamics::TensionLaw;
use windlass_model::{AttachedMass, AxialLaw, ClassError, LineSeabed, SegmentProperties};

/// The properties of a part.
///
/// # Errors
/// A law of stretch that is neither one stiffness nor a table, a buoy on a pendant.
pub fn segment(part: &LinePart, elements: Option<usize>, density: f64) -> Result<SegmentProperties, ClassError> {
    let made = &part.segment;
    let axial = match &made.axial {
        TensionLaw::Linear(ea) => AxialLaw::Linear(*ea),
        TensionLaw::Table(points) => AxialLaw::Table(points.clone()),
        TensionLaw::Polynomial(_) => {
            return Err(ClassError::new("its stiffness follows powers of the strain").help("-STRETCH gives a table"));
        }
        TensionLaw::Viscoelastic(_) => {
            return Err(ClassError::new("it is a fibre rope with a static and a dynamic stiffness")
                .help("&PARAMETER -STIFFNESS LOWER, UPPER before the class chooses one of -EA_BOUNDS"));
        }
    };
    if part.joint.is_some_and(|joint| joint.pendant > 0.0) {
        return Err(ClassError::new("a buoy floats above it on a pendant"));
    }
    let attached = part.joint.map(|joint| AttachedMass {
        mass: joint.mass,
        volume: joint.volume,
        drag_area: joint.drag,
        added: if joint.volume > 0.0 { joint.added * joint.volume * density } else { joint.added },
    });
    Ok(SegmentProperties {
        length: made.length,
        elements,
        mass: made.mass,
        displaced: made.displaced,
        outside: made.contact_diameter,
        axial,
        axial_damping: made.axial_damping,
        bending: made.bending,
        has_bore: made.tube.is_some_and(|tube| tube.inner > 0.0),
        drag_diameter: made.drag_diameter,
        drag: [made.drag_normal, made.drag_tangential],
        added_area: made.added_area,
        added: [made.added_normal, made.added_tangential],
        attached,
    })
}

/// The bottom under a line.
///
/// # Errors
/// A slope of the line's own, friction that is another across the line.
pub fn seabed(seabed: &Seabed) -> Result<LineSeabed, ClassError> {
    if seabed.slopes() {
        return Err(ClassError::new("it lies on a slope of its own").help("&BATHYMETRY gives a bottom to all lines"));
    }
    if seabed.across.is_some_and(|across| across != seabed.along) {
        return Err(ClassError::new("its friction across the line is not that along it"));
    }
    Ok(LineSeabed {
        stiffness: seabed.stiffness,
        damping: seabed.damping,
        friction: seabed.along,
        friction_damping: seabed.friction_damping,
        depth: seabed.depth,
    })
}
