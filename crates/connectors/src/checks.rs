//! Checks that several classes share.

use super::options as o;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::values::{Args, Given};
use windlass_model::{ClassError, Connection, Connector};

/// A P-Y curve: points (force N, deflection m) growing in both, as [MOSES-FLEX -X_PY] asks.
///
/// # Errors
/// A point with a force and no deflection or the other way round, two points with the same force, a force that does not grow, or a deflection that does not grow, at its value.
pub fn py_curve(given: &Given) -> Outcome<Vec<(f64, f64)>> {
    // -Y_PY and -Z_PY name their values alike
    const FORCE: ValueKey<f64> = o::X_PY.number("P");
    const DEFLECTION: ValueKey<f64> = o::X_PY.number("Y");
    let mut points: Vec<(f64, f64)> = Vec::new();
    for pair in given.groups() {
        let (Some(force), Some(deflection)) = (pair.number(FORCE), pair.number(DEFLECTION)) else { continue };
        if let Some((last_force, last_deflection)) = points.last() {
            if force <= *last_force {
                return Err(Diagnostic::error(
                    format!("the forces of {} must grow from point to point", given.name()),
                    pair.position(FORCE),
                )
                .label("not larger than the one before"));
            }
            if deflection <= *last_deflection {
                return Err(Diagnostic::error(
                    format!("the deflections of {} must grow with the force", given.name()),
                    pair.position(DEFLECTION),
                )
                .label("not larger than the one before"));
            }
        }
        if (force == 0.0) != (deflection == 0.0) {
            return Err(Diagnostic::error(
                format!("{} begins at zero force and zero deflection", given.name()),
                pair.position(FORCE),
            )
            .label("one of the two is zero alone"));
        }
        points.push((force, deflection));
    }
    Ok(points)
}

/// All P-Y curves of a record.
///
/// # Errors
/// As [`py_curve`].
pub fn py_curves(args: &Args) -> Outcome<()> {
    for option in [o::X_PY, o::Y_PY, o::Z_PY] {
        if let Some(given) = args.option_if_declared(&option) {
            py_curve(given)?;
        }
    }
    Ok(())
}

/// The length of every segment must be defined (seed: "every segment's length must be defined for flexible classes").
///
/// # Errors
/// A record without `-LEN`.
pub fn length(args: &Args, kind: &str) -> Outcome<f64> {
    args.option_number(&o::LEN).ok_or_else(|| {
        Diagnostic::error(format!("{kind} lacks -LEN: every segment's length must be defined"), args.span)
            .help("form: -LEN L")
    })
}

/// One or two points, of which `bodies` are on a body, and the most of both that the class takes.
///
/// # Errors
/// Too many points, or both on bodies (be it the same) for a class that only goes to ground.
pub fn ends(kind: &str, connector: &Connector, bodies: usize, most_points: usize, most_bodies: usize) -> Outcome<()> {
    if connector.points.len() > most_points {
        return Err(Diagnostic::error(
            format!("a {kind} takes {most_points} point, its other end is fixed by its class"),
            connector.span,
        ));
    }
    if connector.tug.is_some() {
        return Err(Diagnostic::error(format!("-TUG belongs to a TUG_BOAT, not to a {kind}"), connector.span));
    }
    if bodies > most_bodies {
        return Err(Diagnostic::error(
            format!("a {kind} connects a body to ground, and both points are on bodies"),
            connector.span,
        )
        .help("use H_CAT, SL_ELEM or ROD between two points of bodies"));
    }
    if connector.anchor.is_some() && connector.points.len() > 1 {
        return Err(Diagnostic::error("a connector between two points has no anchor", connector.span)
            .label("-ANCHOR and a second point are given"));
    }
    Ok(())
}

/// A class whose connectors act in an assembly, which gives the second end.
///
/// # Errors
/// A connector outside of one: its second end would be the ground.
pub fn in_assembly(kind: &str, connection: &Connection) -> Result<(), ClassError> {
    if connection.to_ground {
        let text = format!("a {kind} exerts no force of its own: the assembly it belongs to gives its second end");
        return Err(ClassError::new(text).with_span(connection.connector.span));
    }
    Ok(())
}
