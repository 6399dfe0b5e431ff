//! A mooring line as an engine sees it: forces on its two ends at any place of these, followed from one place to the next.

use super::extended_line::{end_wrenches, solve_with_link};
use super::extension::{EndPull, ExtensibleLine, Extension};
use super::line_profile::LineProfile;
use super::mooring::{Mooring, too_short, too_short_note};
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::borrow::Cow;
use windlass_base::pose::Six;
use windlass_catenary::{CatenaryWarmStart, Interpolated, LineError, LineForces};
use windlass_model::{
    AnchoredConnector, AnchoredResponse, ClassError, ConnectorElement, ConnectorResponse, ConnectorSummary, End,
    Placement, Situation, SolverCache,
};

/// Angle (rad) over which forces of a line on a bathymetry are compared: a hundredth of the distance between faces of a long line's
/// profile, and forces that are proven to 1e-9 leave 1e-5 of the tension over it.
const AZIMUTH_DIFFERENCE_RAD: f64 = 1e-4;

/// A line between two ends.
#[derive(Clone, Debug)]
pub struct LineElement {
    mooring: Mooring,
}

/// The table of a line at one elevation of its fairlead.
struct TableAt {
    /// The elevation (m).
    elevation: f64,
    /// The bottom that its rows lie on, by the direction from the fairlead to the anchor; any where that is a plane.
    azimuth: Option<[f64; 2]>,
    /// Distance of its first row (m).
    nearest: f64,
    forces: Interpolated,
}

impl LineElement {
    /// The element of a line whose ends are where its placement says.
    ///
    /// # Errors
    /// A line that sees the bottom between ends that both move.
    pub fn new(mooring: Mooring) -> Result<Self, ClassError> {
        mooring.distance_and_direction()?;
        let line = &mooring.line;
        if line.floor().is_some() && !mooring.position.to_ground {
            return Err(ClassError::new("a line that lies on the bottom needs its other end in the ground")
                .help("use H_CAT between two bodies"));
        }
        Ok(LineElement { mooring })
    }

    /// Horizontal distance, its direction from the first end to the other, and the elevation of the first end in the line's
    /// own system: a line that sees neither bottom nor surface goes up and down with its other end.
    ///
    /// # Errors
    /// Another number of ends than two.
    fn horizontal_distance(&self, ends: &[End]) -> Result<(f64, [f64; 2], f64), ClassError> {
        let [from, to] = End::origins(ends)?;
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        let x = dx.hypot(dy);
        let along = if x > 0.0 { [dx / x, dy / x] } else { [1.0, 0.0] };
        let z = if self.mooring.position.to_ground { from.z } else { self.mooring.line.anchor() + from.z - to.z };
        Ok((x, along, z))
    }

    fn forces(&self, x: f64, z: f64, cache: &mut SolverCache) -> Result<LineForces, LineError> {
        if self.mooring.tabulated {
            return self.interpolate_forces(x, z, cache);
        }
        match cache.get_or_insert::<Option<CatenaryWarmStart>>(|_| true, || None) {
            Some(warm) => self.mooring.line.solve_forces(x, z, warm),
            None => self.mooring.line.solve_forces(x, z, &mut None),
        }
    }

    /// The forces from the table at the elevation `z` of the fairlead; exact ones nearer than its first row.
    fn interpolate_forces(&self, x: f64, z: f64, cache: &mut SolverCache) -> Result<LineForces, LineError> {
        let azimuth = self.mooring.profile.as_ref().map(LineProfile::azimuth);
        let is_here = |kept: &TableAt| kept.elevation == z && kept.azimuth == azimuth;
        if !cache.get().is_some_and(is_here) {
            let (rows, _) = self.mooring.table(z)?;
            let nearest = rows.first().map_or(0.0, |row| row.state.x);
            let forces = Interpolated::new(&rows)?;
            cache.set(TableAt { elevation: z, azimuth, nearest, forces });
        }
        match cache.get::<TableAt>() {
            Some(table) if x >= table.nearest => Ok(table.forces.forces(x)),
            _ => self.mooring.line.at_distance(x, z).map(|state| LineForces::from(&state)),
        }
    }

    /// The forces with a link at the first end, and where the line itself begins (distance, elevation).
    fn forces_with_link(
        &self,
        x: f64,
        z: f64,
        by: Extension,
        cache: &mut SolverCache,
    ) -> Result<(LineForces, [f64; 2]), LineError> {
        if by == Extension::NONE {
            return self.forces(x, z, cache).map(|forces| (forces, [x, z]));
        }
        let start = cache.get::<Option<CatenaryWarmStart>>().and_then(Option::as_ref).map(CatenaryWarmStart::fairlead);
        let rise = z - self.mooring.line.anchor();
        let apart = x.hypot(rise);
        let straight = if apart > 0.0 { [x / apart, rise / apart] } else { [0.0, 1.0] };
        solve_with_link(by, [x, z], straight, start, self.mooring.line.length(), |x, z| self.forces(x, z, cache))
    }

    /// The same; none of a weightless line that is not tight.
    fn forces_if_taut(
        &self,
        x: f64,
        z: f64,
        by: Extension,
        cache: &mut SolverCache,
    ) -> Result<Option<(LineForces, [f64; 2])>, ClassError> {
        match self.forces_with_link(x, z, by, cache) {
            Ok(found) => Ok(Some(found)),
            Err(LineError::Undetermined) if self.mooring.weightless() => Ok(None),
            Err(error) => Err(self.mooring.error(&error)),
        }
    }

    /// The element with its line on the bottom in a direction from the fairlead to the anchor.
    fn at_azimuth(&self, along: [f64; 2]) -> Result<Cow<'_, LineElement>, ClassError> {
        match &self.mooring.profile {
            Some(profile) if profile.azimuth() != along => {
                let profile = profile.with_azimuth(along);
                let line = profile.lay(self.mooring.line.clone()).map_err(|e| self.mooring.error(&e))?;
                let mooring = Mooring { line, profile: Some(profile), ..self.mooring.clone() };
                Ok(Cow::Owned(LineElement { mooring }))
            }
            _ => Ok(Cow::Borrowed(self)),
        }
    }

    /// How the pull on the first end and on the other change with the direction from the first to the other (N/rad), for a line
    /// on a bathymetry: a line that turns lies on another profile.
    fn rates_by_azimuth(&self, x: f64, along: [f64; 2], z: f64, by: Extension) -> Result<[[f64; 2]; 2], ClassError> {
        if self.mooring.profile.is_none() || x == 0.0 {
            return Ok([[0.0; 2]; 2]);
        }
        let [ux, uy] = along;
        let turned = |angle: f64| -> Result<LineForces, ClassError> {
            let (sin, cos) = angle.sin_cos();
            let there = self.at_azimuth([ux * cos - uy * sin, uy * cos + ux * sin])?;
            let found =
                there.forces_with_link(x, z, by, &mut SolverCache::new()).map_err(|e| self.mooring.error(&e))?;
            Ok(found.0)
        };
        let (before, after) = (turned(-AZIMUTH_DIFFERENCE_RAD)?, turned(AZIMUTH_DIFFERENCE_RAD)?);
        let rate = |a: [f64; 2], b: [f64; 2]| {
            [(b[0] - a[0]) / (2.0 * AZIMUTH_DIFFERENCE_RAD), (b[1] - a[1]) / (2.0 * AZIMUTH_DIFFERENCE_RAD)]
        };
        Ok([rate(before.fairlead, after.fairlead), rate(before.anchor, after.anchor)])
    }

    /// The line with its ends there.
    ///
    /// # Errors
    /// Another number of ends than two.
    fn with_ends(&self, ends: &[End]) -> Result<Mooring, ClassError> {
        let [fairlead, other] = End::origins(ends)?.map(Into::into);
        let position = Placement { fairlead, other: Some(other), ..self.mooring.position.clone() };
        let (_, _, z) = self.horizontal_distance(ends)?;
        let [x, y, own] = position.fairlead;
        // elevations in the line's own system
        let rise = z - own;
        Ok(Mooring {
            position: Placement { fairlead: [x, y, z], ..position },
            surface: self.mooring.surface + rise,
            bottom: self.mooring.bottom.map(|b| b + rise),
            ..self.mooring.clone()
        })
    }
}

/// -d(force)/d(place of the first end) for a force `sign` (pull toward the other end, downward): `k` is d(pull)/d(x, z),
/// `across` the horizontal pull over the distance.
fn stiffness_by_place([ux, uy]: [f64; 2], k: [[f64; 2]; 2], across: f64, sign: f64) -> Matrix3<f64> {
    // a fairlead on the bottom is held there without a slope that has an end
    let [[xx, xz], [zx, zz]] = k.map(|row| row.map(|v| if v.is_finite() { v } else { xx_of(k) }));
    let plane = |a: f64, b: f64, same: f64| xx * a * b + across * (same - a * b);
    let side = plane(ux, uy, 0.0);
    let first = Vector3::new(plane(ux, ux, 1.0), side, -zx * ux);
    let second = Vector3::new(side, plane(uy, uy, 1.0), -zx * uy);
    Matrix3::from_columns(&[first, second, Vector3::new(-xz * ux, -xz * uy, zz)]) * sign
}

/// The part of the same that comes of the bottom, where the pull changes by `rate` with the direction (N/rad): the first end that goes
/// across the line by a length turns it by that length over the distance `x`.
fn stiffness_by_azimuth([ux, uy]: [f64; 2], [horizontal, vertical]: [f64; 2], x: f64) -> Matrix3<f64> {
    if x == 0.0 {
        return Matrix3::zeros();
    }
    let across = Vector3::new(-uy, ux, 0.0);
    Vector3::new(horizontal * ux, horizontal * uy, -vertical) * across.transpose() / x
}

/// The same as the block of two ends that exert no moments.
fn end_block(along: [f64; 2], k: [[f64; 2]; 2], across: f64, sign: f64) -> Matrix6<f64> {
    let mut block = Matrix6::zeros();
    block.fixed_view_mut::<3, 3>(0, 0).copy_from(&stiffness_by_place(along, k, across, sign));
    block
}

/// A finite measure of a line's stiffness.
fn xx_of(k: [[f64; 2]; 2]) -> f64 {
    let [[xx, _], _] = k;
    if xx.is_finite() { xx } else { 0.0 }
}

impl ExtensibleLine for LineElement {
    fn pull(
        &self,
        ends: &[End],
        by: Extension,
        cache: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<EndPull, ClassError> {
        out.clear(2);
        let (x, along, z) = self.horizontal_distance(ends)?;
        let here = self.at_azimuth(along)?;
        let Some((plane, _)) = here.forces_if_taut(x, z, by, cache)? else {
            return Ok(EndPull { tension: 0.0, along: Vector3::zeros() });
        };
        let ([h, _], [far_h, _]) = (plane.fairlead, plane.anchor);
        let over = |force: f64, k: [[f64; 2]; 2]| if x > 0.0 { force / x } else { xx_of(k) };
        let mut first = end_block(along, plane.stiffness, over(h, plane.stiffness), 1.0);
        let mut other = end_block(along, plane.coupling, over(far_h, plane.coupling), -1.0);
        let [near, far] = here.rates_by_azimuth(x, along, z, by)?;
        for (block, rate, sign) in [(&mut first, near, 1.0), (&mut other, far, -1.0)] {
            let mut translations = block.fixed_view_mut::<3, 3>(0, 0);
            translations += stiffness_by_azimuth(along, rate, x) * sign;
        }
        let wrenches = end_wrenches(&plane, along);
        let pull = wrenches[0].fixed_rows::<3>(0).into_owned();
        out.wrench.copy_from_slice(&wrenches);
        if let [k11, k12, k21, k22] = out.stiffness.as_mut_slice() {
            (*k11, *k12, *k21, *k22) = (first, -first, other, -other);
        }
        Ok(EndPull { tension: pull.norm(), along: pull.try_normalize(0.0).unwrap_or_default() })
    }

    fn summary_with_link(&self, ends: &[End], by: Extension) -> Result<ConnectorSummary, ClassError> {
        let mut ends = ends.to_vec();
        if by != Extension::NONE {
            let (x, [ux, uy], z) = self.horizontal_distance(&ends)?;
            let here = self.at_azimuth([ux, uy])?;
            let [line_x, line_z] = here.forces_if_taut(x, z, by, &mut SolverCache::new())?.map_or([x, z], |(_, at)| at);
            if let Some(first) = ends.first_mut() {
                first.pose.origin += Vector3::new((x - line_x) * ux, (x - line_x) * uy, line_z - z);
            }
        }
        let (_, along, _) = self.horizontal_distance(&ends)?;
        let line = self.at_azimuth(along)?.with_ends(&ends)?;
        let tabulated = line.tabulated;
        let loads = if tabulated { line.tabled_loads()? } else { line.exact_loads()? };
        let mut over_given_break = loads.over_given_break;
        // a table knows its critical segment alone
        if over_given_break.is_none() && tabulated && line.breaks_given.contains(&true) {
            over_given_break = line.exact_loads().ok().and_then(|exact| exact.over_given_break);
        }
        let (x, _, z) = self.horizontal_distance(&ends)?;
        let chord = x.hypot(z - self.mooring.line.anchor());
        let too_short = too_short(chord / self.mooring.line.length(), loads.ratio);
        let mut notes = loads.notes;
        notes.extend(too_short.map(too_short_note));
        Ok(ConnectorSummary {
            tension: Some(loads.tension),
            ratio: Some(loads.ratio),
            critical: Some(loads.critical),
            over_given_break,
            too_short,
            grounded: Some(loads.grounded),
            solution: loads.solution,
            springs: Vec::new(),
            fender: None,
            notes,
        })
    }
}

impl ConnectorElement for LineElement {
    fn evaluate(
        &self,
        at: &Situation,
        _committed: &[f64],
        _trial: &mut [f64],
        cache: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        self.pull(at.ends, Extension::NONE, cache, out).map(|_| ())
    }

    fn as_anchored(&self) -> Option<&dyn AnchoredConnector> {
        self.mooring.position.to_ground.then_some(self)
    }

    fn evaluate_wrenches(
        &self,
        at: &Situation,
        _committed: &[f64],
        cache: &mut SolverCache,
        out: &mut Vec<Six>,
    ) -> Result<(), ClassError> {
        let (x, along, z) = self.horizontal_distance(at.ends)?;
        let found = self.at_azimuth(along)?.forces_if_taut(x, z, Extension::NONE, cache)?;
        out.clear();
        out.extend(found.map_or([Six::zeros(); 2], |(plane, _)| end_wrenches(&plane, along)));
        Ok(())
    }

    fn summary(&self, at: &Situation, _committed: &[f64]) -> Result<ConnectorSummary, ClassError> {
        self.summary_with_link(at.ends, Extension::NONE)
    }
}

impl AnchoredConnector for LineElement {
    fn evaluate_anchored(&self, at: &Situation, cache: &mut SolverCache) -> Result<AnchoredResponse, ClassError> {
        let (x, along, z) = self.horizontal_distance(at.ends)?;
        let here = self.at_azimuth(along)?;
        let Some((plane, _)) = here.forces_if_taut(x, z, Extension::NONE, cache)? else {
            return Ok(AnchoredResponse { wrenches: [Six::zeros(); 2], stiffness: Matrix3::zeros() });
        };
        let [force, _] = plane.fairlead;
        let across = if x > 0.0 { force / x } else { xx_of(plane.stiffness) };
        let [rate, _] = here.rates_by_azimuth(x, along, z, Extension::NONE)?;
        let stiffness = stiffness_by_place(along, plane.stiffness, across, 1.0) + stiffness_by_azimuth(along, rate, x);
        Ok(AnchoredResponse { wrenches: end_wrenches(&plane, along), stiffness })
    }
}

impl Mooring {
    /// Whether none of its segments weighs anything.
    pub(super) fn weightless(&self) -> bool {
        self.line.segments().iter().all(|s| s.weight == 0.0)
    }
}
