//! Where a hook, its body and its lines begin: `-INITIAL`, `-VERTICAL` and `-ORIENT` of a tip-hook set.

use crate::report::format::report;
use nalgebra::{Matrix3, Rotation3, Vector3};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::span::Span;
use windlass_base::table::{Cell, Digits};
use windlass_base::units::{Dim, UnitSystem};
use windlass_connectors::hook::{SlingConstraint, SlingObjective, hanging, hook};
use windlass_model::{Connector, Model};

/// A tip-hook set that is being defined.
pub struct Rigging<'a> {
    /// The body of its slings.
    pub body: &'a str,
    /// The line to the boom.
    pub boom: &'a str,
    /// The slings.
    pub slings: &'a [String],
    /// Its record.
    pub span: Span,
    /// The units it is reported in.
    pub units: UnitSystem,
}

impl Rigging<'_> {
    fn reach(&self, model: &Model, name: &str) -> Outcome<SlingConstraint> {
        let missing = || Diagnostic::error(format!("connector {name} has no length"), self.span);
        let connector = model.connectors.get(&Model::key(name)).ok_or_else(missing)?;
        let node = model.end_pose(connector, 0).ok_or_else(missing)?.origin;
        Ok(SlingConstraint { node, length: model.first_length(connector).ok_or_else(missing)? })
    }

    fn slings(&self, model: &Model) -> Outcome<Vec<SlingConstraint>> {
        self.slings.iter().map(|name| self.reach(model, name)).collect()
    }

    fn too_short(&self) -> Box<Diagnostic> {
        let text = format!("{} are too short to meet in a hook", self.slings.join(", "));
        Diagnostic::error(text, self.span).help("their lengths are those of -LEN, or of &CONNECTOR -LENGTH")
    }

    /// Where the hook begins with the body and the lengths as they are.
    ///
    /// # Errors
    /// Slings that do not meet.
    pub fn begin(&self, model: &Model) -> Outcome<Vector3<f64>> {
        let boom = self.reach(model, self.boom)?;
        hook(&self.slings(model)?, SlingObjective::Near(boom.node)).ok_or_else(|| self.too_short())
    }

    /// Moves the body until its hook is the length of the boom's line below the boom; `turned` so that it hangs from it. The
    /// place of the hook (m).
    ///
    /// # Errors
    /// Slings that do not meet; a body without weight that should hang.
    pub fn move_body(&self, model: &mut Model, turned: bool) -> Outcome<Vector3<f64>> {
        let boom = self.reach(model, self.boom)?;
        let slings = self.slings(model)?;
        let key = Model::key(self.body);
        let Some(body) = model.bodies.get(&key) else { return Err(self.too_short()) };
        let pose = Pose::from_place(&body.position);
        let (at, turn) = if turned {
            let mass = windlass_hydro::laden_mass(model, body).map_err(|e| e.diagnostic(self.span, self.units))?;
            if mass.mass <= 0.0 {
                return Err(Diagnostic::error(format!("{} has no weight that could hang", body.name), self.span));
            }
            let centre = pose.point(mass.centre);
            let at = hanging(&slings, centre, Vector3::z()).ok_or_else(|| self.too_short())?;
            let upside = Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
            (at, Rotation3::rotation_between(&(at - centre), &Vector3::z()).unwrap_or(upside))
        } else {
            (hook(&slings, SlingObjective::Along(Vector3::z())).ok_or_else(|| self.too_short())?, Rotation3::identity())
        };
        let to = boom.node - Vector3::z() * boom.length;
        let moved = Pose { origin: to - turn * (at - pose.origin), axes: turn * pose.axes };
        let position = if turned {
            moved.position(&body.position)
        } else {
            // angles that stay keep their numbers
            Place { shift: moved.origin.into(), ..body.position }
        };
        if let Some(body) = model.bodies.get_mut(&key) {
            body.previous = body.position;
            body.position = position;
        }
        Ok(to)
    }

    /// Gives the lines lengths without sag with the body where it is. Returns the place of the hook (m) and the report.
    ///
    /// # Errors
    /// Slings that do not meet, or that reach beyond the boom.
    pub fn straighten(&self, model: &mut Model) -> Outcome<(Vector3<f64>, Vec<String>)> {
        let at = self.begin(model)?;
        let boom = self.reach(model, self.boom)?;
        if (at - boom.node).norm() <= 1e-6 * boom.length {
            let text = format!("the slings reach the boom: no length is left for {}", self.boom);
            return Err(Diagnostic::error(text, self.span).help("shorten the slings, or put the boom higher"));
        }
        let with_unit = |length: f64| {
            let digits = report(&Cell::Number(length), Dim::Length, Digits::Usual, self.units);
            format!("{digits} {}", Dim::Length.label(self.units))
        };
        let mut said = Vec::new();
        for name in std::iter::once(self.boom).chain(self.slings.iter().map(String::as_str)) {
            let SlingConstraint { node, length } = self.reach(model, name)?;
            let straight = (at - node).norm();
            if (straight - length).abs() <= 1e-9 * length {
                continue;
            }
            said.push(format!("connector {name}: {} (was {}): no sag", with_unit(straight), with_unit(length)));
            if let Some(connector) = model.connectors.get_mut(&Model::key(name)) {
                connector.first_length = Some(straight);
            }
        }
        Ok((at, said))
    }
}

/// Gives a body the system of its slings' nodes; everything stays where it is.
///
/// # Errors
/// Fewer than three slings, nodes on a line, a body with other connectors or a hydrostatic stiffness of its own system.
pub fn orient(model: &mut Model, body: &str, slings: &[String], span: Span) -> Outcome<()> {
    let key = Model::key(body);
    let nodes: Vec<Vector3<f64>> = slings
        .iter()
        .filter_map(|name| model.connectors.get(&Model::key(name)))
        .filter_map(|c| model.end(c, 0).map(Vector3::from))
        .collect();
    let (front, back, side) = match nodes.as_slice() {
        [a, b, c] => ((a + b) / 2.0, *c, a - b),
        [a, b, c, d] => ((a + b) / 2.0, (c + d) / 2.0, a - b),
        _ => return Err(Diagnostic::error("-ORIENT asks for three or four slings", span)),
    };
    let own = |c: &Connector| {
        let on = |p: &String| model.points.get(&Model::key(p)).and_then(|p| model.body_of(p));
        c.points.iter().any(|p| on(p).is_some_and(|b| Model::key(&b.name) == key))
    };
    let of_set = |c: &Connector| slings.contains(&c.name) && c.offsets == [[0.0; 3]; 2];
    if let Some(other) = model.connectors.values().find(|c| own(c) && !of_set(c)) {
        let text = format!("-ORIENT would turn the axes of {}, which is on {body}", other.name);
        return Err(Diagnostic::error(text, span)
            .other(other.span, "defined here")
            .help("define the set with -ORIENT before the other connectors of its body, its slings without -GO1"));
    }
    let Some(old) = model.bodies.get(&key) else { return Ok(()) };
    if old.linear.is_some() || model.loads.iter().any(|l| part_of(model, &l.part, &key)) {
        let text = format!("-ORIENT would turn the loads and the hydrostatic stiffness of {body}");
        return Err(Diagnostic::error(text, span).help("define the set with -ORIENT before them"));
    }
    let flat = || Diagnostic::error("the nodes of the slings lie on a line: they give no system", span);
    let x = (front - back).try_normalize(1e-9).ok_or_else(flat)?;
    let y = (side - x * x.dot(&side)).try_normalize(1e-9).ok_or_else(flat)?;
    let axes = Matrix3::from_columns(&[x, y, x.cross(&y)]);
    let (from, to) = (Pose::from_place(&old.position), Pose { origin: (front + back) / 2.0, axes });
    let position = to.position(&Place::default());
    // the new pose as its place gives it back
    let to = Pose::from_place(&position);
    for part in model.parts.values_mut().filter(|p| Model::key(&p.body) == key) {
        let was = Pose::from_place(&part.position);
        let axes = to.axes.transpose() * from.axes * was.axes;
        part.position = Pose { origin: to.local(from.point(was.origin)), axes }.position(&Place::default());
    }
    if let Some(body) = model.bodies.get_mut(&key) {
        body.position = position;
        body.previous = position;
    }
    Ok(())
}

/// Whether a part belongs to a body.
fn part_of(model: &Model, part: &str, body: &str) -> bool {
    model.parts.get(&Model::key(part)).is_some_and(|p| Model::key(&p.body) == body)
}
