//! What the zero-length classes share: reading their springs, and making the element of them.
//!
//! Source: [MOSES-FLEX GSPR].

use super::mooring::no_curve;
use super::spring_law::{Dashpot, Elastic, SpringGroup};
use super::viscous::ViscoelasticLaw;
use super::zero_law::{ContactGeometry, Friction, Sense, ZeroLaw};
use super::zero_length::{ZeroLength, element_turns};
use super::{checks, options as o};
use nalgebra::{Matrix3, Vector3};
use windlass_base::choice::{Choice, Dof};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::spec::{DatumKey, ValueKey};
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Args;
use windlass_model::{
    ClassError, ClassRecord, ClassRole, Connection, Connector, ConnectorCategory, ConnectorClass, ConnectorElement,
    LengthClass, Surroundings,
};

/// One restrained degree of freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct Restraint {
    /// Which.
    pub dof: Dof,
    /// Spring value (N/m or N m/rad).
    pub stiffness: f64,
    /// Allowable force or moment (N or N m), where checked.
    pub allowable: Option<f64>,
}

/// The springs, dashpots and friction of a record.
#[derive(Clone, Debug)]
pub struct Springs {
    /// As given.
    pub restraints: Vec<Restraint>,
    /// Whether Z is as Y.
    pub symmetric: bool,
    curves: [Option<Vec<(f64, f64)>>; 3],
    dashpots: [Option<Dashpot>; 3],
    convolutions: Vec<(usize, String, Span)>,
    friction: Option<f64>,
}

/// The datum of a generalized spring before its restraints.
pub const SENSE: DatumKey<Sense> = DatumKey::choice(&o::GENERALIZED, "SENSE");

/// The keys of a restraint among the data of a record.
#[derive(Clone, Copy)]
pub struct RestraintKeys {
    /// Its degree of freedom, with which each restraint begins.
    pub dof: DatumKey<Dof>,
    /// Its stiffness.
    pub stiffness: DatumKey<f64>,
    /// Its allowable force, of records that have one.
    pub allowable: Option<DatumKey<f64>>,
}

const DOF: DatumKey<Dof> = DatumKey::choice(&o::GENERALIZED, "DF");
const STIFFNESS: DatumKey<f64> = DatumKey::number(&o::GENERALIZED, "SPV");
const ALLOWABLE: DatumKey<f64> = DatumKey::number(&o::GENERALIZED, "AF");
/// The restraints of `GSPR`, `FOUNDATION`, `ROLLER` and their like.
pub const GENERALIZED_RESTRAINTS: RestraintKeys =
    RestraintKeys { dof: DOF, stiffness: STIFFNESS, allowable: Some(ALLOWABLE) };

/// Restraints among the data of a record.
///
/// # Errors
/// The same degree of freedom twice.
pub fn restraints(args: &Args, keys: RestraintKeys) -> Outcome<Vec<Restraint>> {
    let mut list: Vec<(Restraint, Span)> = Vec::new();
    for group in args.groups_from(keys.dof) {
        let (Some(dof), span) = (group.choice(keys.dof), group.position(keys.dof)) else { continue };
        if let Some((_, first)) = list.iter().find(|(r, _)| r.dof == dof) {
            return Err(Diagnostic::error(format!("degree of freedom {} is given twice", dof.word()), span)
                .other(*first, "first given here"));
        }
        let stiffness = group.number(keys.stiffness).unwrap_or(0.0);
        let made = Restraint { dof, stiffness, allowable: keys.allowable.and_then(|key| group.number(key)) };
        list.push((made, span));
    }
    Ok(list.into_iter().map(|(r, _)| r).collect())
}

/// Checks `-SYMMETRIC`: only Y properties are given then. Where it is the default, Z properties do away with it.
///
/// # Errors
/// A Z property beside -SYMMETRIC.
fn symmetric(args: &Args, list: &[Restraint], default: bool) -> Outcome<bool> {
    let on = args.switch(&o::SYMMETRIC, default);
    let has_z = list.iter().any(|r| matches!(r.dof, Dof::Z | Dof::Rz))
        || [o::Z_PY, o::Z_DAMPING].iter().any(|option| args.option_if_declared(option).is_some());
    if let Some(given) = args.option(&o::SYMMETRIC).filter(|_| on)
        && has_z
    {
        return Err(Diagnostic::error("with -SYMMETRIC only the Y properties are given; Z follows", given.span));
    }
    Ok(on && !has_z)
}

/// A degree of freedom on which an option acts must be restrained.
fn check_restrained(list: &[Restraint], dof: Dof, symmetric: bool, at: Span) -> Outcome<()> {
    let like_y = match dof {
        Dof::Z => Dof::Y,
        Dof::Rz => Dof::Ry,
        Dof::X | Dof::Y | Dof::Rx | Dof::Ry => dof,
    };
    if list.iter().any(|r| r.dof == dof || (symmetric && r.dof == like_y)) {
        return Ok(());
    }
    let known: Vec<&str> = list.iter().map(|r| r.dof.word()).collect();
    Err(Diagnostic::error(format!("degree of freedom {} is not restrained", dof.word()), at)
        .label(format!("expected {}", known.join(" or "))))
}

/// `-CONVOLUTION DF NAME`: each acts in a degree of freedom that is restrained, once in each.
///
/// # Errors
/// Another degree of freedom, or one given twice, at its word.
fn convolutions(args: &Args, list: &[Restraint], symmetric: bool) -> Outcome<Vec<(usize, String, Span)>> {
    let mut seen: Vec<(usize, String, Span)> = Vec::new();
    for given in args.occurrences(&o::CONVOLUTION_DF) {
        const DF: ValueKey<Dof> = o::CONVOLUTION_DF.choice("DF");
        const NAME: ValueKey<str> = o::CONVOLUTION_DF.word("CVL_NAME");
        let (Some(dof), Some(name)) = (given.choice(DF), given.word(NAME)) else { continue };
        let span = given.position(DF);
        check_restrained(list, dof, symmetric, span)?;
        let number = dof.index();
        // of a symmetric element Y and Z are the same
        let like = |d: usize| if symmetric && d % 3 == 2 { d - 1 } else { d };
        if let Some((.., first)) = seen.iter().find(|(other, ..)| like(*other) == like(number)) {
            return Err(Diagnostic::error(format!("-CONVOLUTION is given twice for {}", dof.word()), span)
                .other(*first, "first given here"));
        }
        seen.push((number, name.to_string(), given.position(NAME)));
    }
    Ok(seen)
}

impl Springs {
    /// Reads a record with its restraints.
    ///
    /// # Errors
    /// What contradicts itself, at its place.
    pub fn read(args: &Args, keys: RestraintKeys, symmetric_default: bool) -> Outcome<Self> {
        let list = restraints(args, keys)?;
        let symmetric = symmetric(args, &list, symmetric_default)?;
        let convolutions = convolutions(args, &list, symmetric)?;
        Springs::from_options(args, list, symmetric, convolutions)
    }

    /// Reads the options of a record beside restraints that are known.
    ///
    /// # Errors
    /// As [`Springs::read`].
    pub fn from_options(
        args: &Args,
        list: Vec<Restraint>,
        symmetric: bool,
        convolutions: Vec<(usize, String, Span)>,
    ) -> Outcome<Self> {
        let mut curves = [None, None, None];
        for ((option, dof), slot) in
            [(o::X_PY, Dof::X), (o::Y_PY, Dof::Y), (o::Z_PY, Dof::Z)].into_iter().zip(&mut curves)
        {
            let Some(given) = args.option_if_declared(&option) else { continue };
            let points = checks::py_curve(given)?;
            check_restrained(&list, dof, symmetric, given.span)?;
            *slot = Some(points);
        }
        let dashpots = [o::X_DAMPING, o::Y_DAMPING, o::Z_DAMPING].map(|option| Dashpot::read(args, &option));
        let friction = args.number_if_declared(&o::FRICTION_MU);
        Ok(Springs { restraints: list, symmetric, curves, dashpots, convolutions, friction })
    }

    /// Every degree of freedom that has a spring, Z ones of a symmetric element among them.
    fn dof_stiffnesses(&self) -> Vec<(usize, f64, Option<f64>)> {
        let own = |r: &Restraint| (r.dof.index(), r.stiffness, r.allowable);
        let mut list: Vec<_> = self.restraints.iter().map(own).collect();
        if self.symmetric {
            let like: Vec<_> = list.iter().filter(|r| r.0 % 3 == 1).map(|r| (r.0 + 1, r.1, r.2)).collect();
            list.extend(like);
        }
        list.sort_by_key(|r| r.0);
        list
    }

    /// The law of the springs.
    ///
    /// # Errors
    /// A convolution curve that is not there.
    pub fn law(&self, connection: &Connection, sense: Sense, contact: ContactGeometry) -> Result<ZeroLaw, ClassError> {
        let all = self.dof_stiffnesses();
        let mut groups: Vec<SpringGroup> = Vec::new();
        for (dof, stiffness, _) in &all {
            // of a symmetric element the second lateral translation acts with the first
            if self.symmetric && *dof == 2 {
                if let Some(group) = groups.iter_mut().find(|g| g.dofs.first() == Some(&1)) {
                    group.dofs.push(2);
                }
                continue;
            }
            let curve = self.curves.get(*dof).and_then(Option::as_deref);
            let elastic = Elastic::new(*stiffness, curve);
            groups.push(SpringGroup { dofs: vec![*dof], elastic, viscous: self.viscous(*dof, connection)? });
        }
        let mut dashpots = Vec::new();
        for (axis, dashpot) in self.dashpots.iter().enumerate() {
            let takes = |other: usize| axis == other || (self.symmetric && axis == 1 && other == 2);
            dashpots.extend(dashpot.map(|d| (d, [takes(0), takes(1), takes(2)])));
        }
        let friction = match self.friction {
            None => Friction::None,
            Some(mu) if all.iter().any(|r| r.0 == 1 || r.0 == 2) => Friction::Limit(mu),
            Some(mu) => Friction::Rate(mu),
        };
        Ok(ZeroLaw { sense, contact, groups, dashpots, friction, pushes_only: false })
    }

    fn viscous(&self, dof: usize, connection: &Connection) -> Result<Option<ViscoelasticLaw>, ClassError> {
        // Z of a symmetric element stands for Y and the other way round
        let like = |d: usize| if self.symmetric && d % 3 == 2 { d - 1 } else { d };
        let Some((_, name, span)) = self.convolutions.iter().find(|(d, ..)| like(*d) == like(dof)) else {
            return Ok(None);
        };
        let missing = || no_curve(name, *span);
        let curve = (connection.curve)(name).ok_or_else(missing)?;
        let fit = ViscoelasticLaw::fit(curve).ok_or_else(missing)?;
        let factor = if dof > 2 { curve.metres * curve.metres } else { 1.0 };
        Ok(Some(fit.law.times(factor)))
    }

    /// The element of a connector whose axes are carried by the first end.
    ///
    /// # Errors
    /// As [`Springs::law`].
    pub fn element(
        &self,
        connection: &Connection,
        sense: Sense,
        contact: ContactGeometry,
        rest: Vector3<f64>,
    ) -> Result<Box<dyn ConnectorElement>, ClassError> {
        let (turn, other_turn) = element_turns(connection, 0, Matrix3::identity());
        let law = self.law(connection, sense, contact)?;
        let listed = self.reported_stiffnesses();
        Ok(Box::new(ZeroLength {
            holder: 0,
            turn,
            other_turn,
            rest,
            law,
            listed,
            category: ConnectorCategory::Flexible,
        }))
    }

    /// What reports list.
    pub fn reported_stiffnesses(&self) -> Vec<(usize, Option<f64>)> {
        self.dof_stiffnesses().into_iter().map(|(dof, _, allowable)| (dof, allowable)).collect()
    }
}

/// GSPR and FOUNDATION: generalized springs in chosen degrees of freedom.
#[derive(Debug)]
pub struct GeneralizedSpring {
    kind: &'static str,
    sense: Sense,
    springs: Springs,
    offset: f64,
    role: ClassRole,
}

impl GeneralizedSpring {
    /// Reads the last of a class's records.
    ///
    /// # Errors
    /// What contradicts itself, at its place.
    pub fn read(records: &[ClassRecord], kind: &'static str) -> Outcome<Self> {
        let record = records.last().ok_or_else(|| Diagnostic::error("a class needs a record", Span::default()))?;
        let args = &record.args;
        looks_along_x(args, kind)?;
        Ok(GeneralizedSpring {
            kind,
            sense: args.choice(SENSE).unwrap_or(Sense::Both),
            springs: Springs::read(args, GENERALIZED_RESTRAINTS, false)?,
            offset: args.number_if_declared(&o::LEN_OFFSET).unwrap_or(0.0),
            role: ClassRole::Connector,
        })
    }

    /// The same, reported in a FOUNDATION check.
    #[must_use]
    pub fn with_foundation_check(self) -> Self {
        GeneralizedSpring { role: ClassRole::Foundation, ..self }
    }
}

/// SENSE goes by the displacement along element X: without a spring there the others would push and pull alike.
///
/// # Errors
/// TENSION or COMPRESSION without an X spring, at the word.
fn looks_along_x(args: &Args, kind: &str) -> Outcome<()> {
    let keys = GENERALIZED_RESTRAINTS;
    let has_x = args.groups_from(keys.dof).any(|group| group.choice(keys.dof) == Some(Dof::X));
    let Some(sense) = args.choice(SENSE).filter(|sense| *sense != Sense::Both && !has_x) else { return Ok(()) };
    let text = format!("SENSE {} of {kind} goes by element X, which has no spring", sense.word());
    Err(Diagnostic::error(text, args.position(SENSE))
        .label("the springs given would push and pull alike")
        .help("turn element X to their direction with -EULER of CONNECTOR and give X; BOTH for springs that act always; FENDER for a fender"))
}

impl ConnectorClass for GeneralizedSpring {
    fn kind(&self) -> &'static str {
        self.kind
    }

    fn notices(&self, args: &Args, _: UnitSystem, _: &Surroundings) -> Vec<Diagnostic> {
        let mut made = Vec::new();
        let has_x = self.springs.restraints.iter().any(|r| r.dof == Dof::X);
        if let Some(given) = args.option_if_declared(&o::LEN_OFFSET).filter(|_| !has_x && self.offset > 0.0) {
            let text = format!("-LEN of {} offsets element X, which has no spring: it does nothing", self.kind);
            made.push(*Diagnostic::warning(text, given.span));
        }
        if let Some(given) = args.option_if_declared(&o::X_DAMPING).filter(|_| self.sense == Sense::Compression) {
            let text = "this dashpot pulls while the ends part faster than the spring pushes";
            made.push(*Diagnostic::remark(text, given.span).help("a FENDER never pulls"));
        }
        made
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        no_anchor(self.kind, connector)?;
        checks::ends(self.kind, connector, bodies, 2, 2)
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        restraint_table(name, self.kind, &self.springs.restraints)
            .fact("Sense", self.sense.word(), Dim::None)
            .fact("Offset along X", self.offset, Dim::Length)
            .fact("Symmetric about X", if self.springs.symmetric { "YES" } else { "NO" }, Dim::None)
    }

    fn role(&self) -> ClassRole {
        self.role
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        self.springs.element(connection, self.sense, ContactGeometry::Whole, Vector3::x() * self.offset)
    }

    fn as_length(&self) -> Option<&dyn LengthClass> {
        Some(self)
    }
}

impl LengthClass for GeneralizedSpring {
    fn first_length(&self) -> Option<f64> {
        Some(self.offset)
    }
}

/// Only lines to ground have an anchor.
///
/// # Errors
/// `-ANCHOR` on another class.
pub fn no_anchor(kind: &str, connector: &Connector) -> Outcome<()> {
    if connector.anchor.is_some() {
        return Err(Diagnostic::error(format!("-ANCHOR belongs to lines, not to a {kind}"), connector.span));
    }
    Ok(())
}

/// The `&STATUS CLASS` table of restraints.
pub fn restraint_table(name: &str, kind: &str, restraints: &[Restraint]) -> Table {
    let value = |r: &Restraint, turned: bool, value: Option<f64>| value.filter(|_| r.dof.is_rotation() == turned);
    Table::new(format!("Class {name}"))
        .fact("Type", kind, Dim::None)
        .with_rows(restraints)
        .text("DF", |r| r.dof.word())
        .column("Translation", "Stiffness", Dim::ForcePerLength, Digits::Usual, |r| value(r, false, Some(r.stiffness)))
        .column("Translation", "Allowable", Dim::Force, Digits::Usual, |r| value(r, false, r.allowable))
        .column("Rotation", "Rot. Stiffness", Dim::MomentPerRadian, Digits::Usual, |r| {
            value(r, true, Some(r.stiffness))
        })
        .column("Rotation", "Rot. Allowable", Dim::Moment, Digits::Usual, |r| value(r, true, r.allowable))
        .build()
}
