//! What the options -PISTON, -CONVOLUTION and -X_DAMPING add to a line.
//!
//! Source: [MOSES-FLEX], on lines other than ROD: a line is "a set of springs in series, a dashpot, and a hydraulic tension control device". Piston and viscoelastic
//! spring lengthen the line at its first end, along its tension there (see [`Extension`]). The manual does not say where the dashpot acts:
//! here along the chord between the two ends, against the rate of its length, on both ends alike, and only in time steps and while the
//! line has a tension; it does not enter the tension that the piston controls.

use super::extension::{EndPull, Extended, Extension};
use super::mooring::{convolution, no_curve};
use super::options as o;
use super::per_line::PerLineOptions;
use super::piston::{Piston, PistonState};
use super::spring_law::Dashpot;
use super::viscous::{Affine, ViscoelasticLaw};
use nalgebra::{Matrix3, Vector3};
use windlass_base::span::Span;
use windlass_model::{
    ClassError, Connection, Element, ElementResponse, ElementSummary, End, Note, Situation, SolverCache, SpringState,
};

/// The devices of a class.
#[derive(Clone, Debug, Default)]
pub struct Devices {
    /// -PISTON.
    pub piston: Option<Piston>,
    /// -X_DAMPING.
    pub dashpot: Option<Dashpot>,
    /// The curve of a viscoelastic spring, with its place.
    pub convolution: Option<(String, Span)>,
}

/// What a table or a shape of a line with a piston says of it.
pub const NOMINAL: &str = "here the piston of -PISTON stands at its nominal position";

impl Devices {
    /// Of a line's options.
    pub fn read(options: &PerLineOptions) -> Devices {
        let dashpot = options.option(&o::X_DAMPING_LINE).and_then(Dashpot::from_given);
        let piston = options.option(&o::PISTON).and_then(Piston::read);
        Devices { piston, dashpot, convolution: convolution(options) }
    }

    /// Whether there are none.
    pub fn is_none(&self) -> bool {
        self.piston.is_none() && self.dashpot.is_none() && self.convolution.is_none()
    }

    /// What is reported of a line whose piston does not move.
    pub fn notes(&self) -> Vec<Note> {
        self.piston.iter().map(|_| NOMINAL.into()).collect()
    }

    /// The element of a line with them; `line` has none of them.
    ///
    /// # Errors
    /// A curve that is not defined, or is no convolution, or does not keep any stiffness.
    pub fn element(&self, connection: &Connection, line: Box<dyn Extended>) -> Result<Box<dyn Element>, ClassError> {
        let viscous = match &self.convolution {
            None => None,
            Some((name, span)) => {
                let law = (connection.curve)(name).and_then(ViscoelasticLaw::fit).map(|fit| fit.law);
                let law = law.ok_or_else(|| no_curve(name, *span))?;
                if law.long_term <= 0.0 {
                    let text = "a viscoelastic spring in a line must keep some stiffness at last";
                    return Err(ClassError::new(text).with_span(*span));
                }
                Some(law)
            }
        };
        Ok(Box::new(DeviceElement { line, piston: self.piston, dashpot: self.dashpot, viscous }))
    }
}

/// A line with devices, as an engine sees it. Its state: the position of the piston (m), then that of the viscoelastic spring.
#[derive(Debug)]
struct DeviceElement {
    line: Box<dyn Extended>,
    piston: Option<Piston>,
    dashpot: Option<Dashpot>,
    viscous: Option<ViscoelasticLaw>,
}

/// Where the devices stand.
struct DeviceState {
    pull: EndPull,
    /// Position of the piston and what it does.
    piston: Option<(f64, PistonState)>,
    /// Force against deflection of the viscoelastic spring.
    affine: Option<Affine>,
    /// All that lengthens the line.
    extension: Extension,
}

impl DeviceElement {
    /// States of the piston, and those of the spring.
    fn parts<'a>(&self, states: &'a [f64]) -> (Option<f64>, &'a [f64]) {
        match self.piston {
            Some(_) => (states.first().copied(), states.get(1..).unwrap_or_default()),
            None => (None, states),
        }
    }

    fn find_forces(
        &self,
        at: &Situation,
        committed: &[f64],
        cache: &mut SolverCache,
        out: &mut ElementResponse,
    ) -> Result<DeviceState, ClassError> {
        let dt = at.step.map(|s| s.dt);
        let (before, memory) = self.parts(committed);
        let affine = self.viscous.as_ref().map(|v| v.step(dt, memory));
        let spring =
            affine.map_or(Extension::NONE, |a| Extension { length: -a.rest / a.slope, compliance: 1.0 / a.slope });
        let mut pull_at = |by: f64| {
            let extension = Extension { length: spring.length + by, ..spring };
            self.line.pull(at.ends, extension, cache, out).map(|pull| (extension, pull, -axial(out, &pull.along)))
        };
        let Some(piston) = self.piston else {
            let (extension, pull, _) = pull_at(0.0)?;
            return Ok(DeviceState { pull, piston: None, affine, extension });
        };
        let mut last = None;
        let stand = piston.stand(before.unwrap_or(piston.nominal), dt, |s| {
            let (extension, pull, slope) = pull_at(s - piston.nominal)?;
            last = Some((s, extension, pull));
            Ok((pull.tension, slope))
        })?;
        let (extension, pull) = match last {
            Some((s, extension, pull)) if s == stand.0 => (extension, pull),
            _ => pull_at(stand.0 - piston.nominal).map(|(extension, pull, _)| (extension, pull))?,
        };
        Ok(DeviceState { pull, piston: Some(stand), affine, extension })
    }

    fn remember(&self, at: &Situation, committed: &[f64], trial: &mut [f64], found: &DeviceState) {
        let (_, memory) = self.parts(committed);
        let (own, rest) = trial.split_at_mut(trial.len().min(usize::from(self.piston.is_some())));
        if let (Some((position, _)), Some(first)) = (found.piston, own.first_mut()) {
            *first = position;
        }
        if let (Some(law), Some(line)) = (&self.viscous, found.affine) {
            law.advance(at.step.map(|s| s.dt), memory, (found.pull.tension - line.rest) / line.slope, rest);
        }
    }
}

/// Stiffness of the first end along a direction (N/m).
fn axial(out: &ElementResponse, along: &Vector3<f64>) -> f64 {
    out.stiffness.first().map_or(0.0, |k| along.dot(&(k.fixed_view::<3, 3>(0, 0) * along)))
}

/// Takes the stiffness away with which the tension would change. A link at the first end that grows by da acts as that end moved by
/// da along the tension t, so that with K the stiffness without control and da such that the tension stays,
/// K'ij = Kij - (Ki1 t)(t' K1j) / (t' K11 t).
fn hold(along: &Vector3<f64>, out: &mut ElementResponse) {
    let axial = axial(out, along);
    let [k11, k12, k21, k22] = out.stiffness.as_mut_slice() else { return };
    if axial <= 0.0 {
        return;
    }
    let part = |block: &nalgebra::Matrix6<f64>| block.fixed_view::<3, 3>(0, 0).into_owned();
    let (columns, rows) =
        ([part(k11) * along, part(k21) * along], [part(k11), part(k12)].map(|k| along.transpose() * k));
    for (i, blocks) in columns.iter().zip([[k11, k12], [k21, k22]]) {
        for (j, block) in rows.iter().zip(blocks) {
            let mut view = block.fixed_view_mut::<3, 3>(0, 0);
            view -= i * j / axial;
        }
    }
}

/// Adds a dashpot along the chord between two ends.
fn damp(dashpot: &Dashpot, ends: &[End], out: &mut ElementResponse) {
    let [first, second] = ends else { return };
    let along = second.pose.origin - first.pose.origin;
    let chord = along.norm();
    if chord == 0.0 {
        return;
    }
    let unit = along / chord;
    let rate = (second.velocity - first.velocity).fixed_rows::<3>(0).into_owned();
    let speed = unit.dot(&rate);
    let (force, slope) = dashpot.act(&Vector3::new(speed, 0.0, 0.0), [true, false, false]);
    let (force, slope) = (force.x, slope[(0, 0)]);
    let across = (Matrix3::identity() - unit * unit.transpose()) / chord;
    // the direction turns, and with it the part of the rate along it
    let by_place = across * force + unit * (across * rate).transpose() * slope;
    let by_rate = unit * unit.transpose() * slope;
    if let [near, far] = out.wrench.as_mut_slice() {
        for (wrench, sign) in [(near, 1.0), (far, -1.0)] {
            let mut part = wrench.fixed_rows_mut::<3>(0);
            part += unit * (force * sign);
        }
    }
    out.damping.resize(4, nalgebra::Matrix6::zeros());
    for (blocks, more) in [(&mut out.stiffness, by_place), (&mut out.damping, by_rate)] {
        for (index, block) in blocks.iter_mut().enumerate() {
            let sign = if index == 0 || index == 3 { 1.0 } else { -1.0 };
            let mut part = block.fixed_view_mut::<3, 3>(0, 0);
            part += more * sign;
        }
    }
}

impl Element for DeviceElement {
    fn states(&self) -> usize {
        usize::from(self.piston.is_some()) + self.viscous.as_ref().map_or(0, ViscoelasticLaw::states)
    }

    fn start(&self, state: &mut [f64]) {
        if let (Some(piston), Some(first)) = (self.piston, state.first_mut()) {
            *first = piston.nominal;
        }
    }

    fn evaluate(
        &self,
        at: &Situation,
        committed: &[f64],
        trial: &mut [f64],
        cache: &mut SolverCache,
        out: &mut ElementResponse,
    ) -> Result<(), ClassError> {
        let found = self.find_forces(at, committed, cache, out)?;
        if found.piston.is_some_and(|(_, does)| does.holds()) {
            hold(&found.pull.along, out);
        }
        self.remember(at, committed, trial, &found);
        if let Some(dashpot) = self.dashpot.filter(|_| at.step.is_some() && found.pull.tension != 0.0) {
            damp(&dashpot, at.ends, out);
        }
        Ok(())
    }

    fn summary(&self, at: &Situation, committed: &[f64]) -> Result<ElementSummary, ClassError> {
        let found = self.find_forces(at, committed, &mut SolverCache::new(), &mut ElementResponse::default())?;
        let mut summary = self.line.summary_with_link(at.ends, found.extension)?;
        if let Some((position, does)) = found.piston {
            summary.notes.push(does.note());
            let force = found.pull.tension;
            summary.springs.push(SpringState { dof: "PISTON".into(), deflection: position, force, allowable: None });
        }
        Ok(summary)
    }

    fn compression_onset(&self) -> Option<f64> {
        self.line.compression_onset()
    }
}
