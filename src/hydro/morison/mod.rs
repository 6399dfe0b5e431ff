//! Round members in waves and current, by Morison's formula (Morison, O'Brien, Johnson and Schaaf, Petroleum Transactions
//! AIME 189, 1950, 149-154; in the form of relative velocity of DNV-RP-C205, 6.2.3).
//!
//! Of a length of a member, with A = pi D^2/4, u and a the velocity and acceleration of the water without the member on its axis,
//! v and b those of the member, and n and t their parts across and along the axis:
//! - drag: `1/2 rho Cd D |u - v|_n (u - v)_n` and `1/2 rho Cdt pi D |u - v|_t (u - v)_t`; current adds to u;
//! - pressure of the undisturbed waves: the hydrostatic pressure up to the surface where it is at the time, and of the dynamic
//!   pressure p `rho A a_n` across and the difference of `A p` of the ends along the axis. At the surface the dynamic pressure
//!   is what makes the whole pressure zero, so that an upright member bears on it with `A p` of its foot alone;
//! - added mass: `rho Ca A (a - b)_n`, and `rho Caa pi D^3/12 (a - b)_t` at each wet end.
//!
//! Where the surface cuts sections, drag and friction act on the share of a section's height that is wet, inertia on the share of
//! its area, in water of the middle of what is wet. The acceleration of the water is that at a place; what the water brings along
//! (u . grad u), the slap on sections that enter the water (category SLAM), and drag of flat ends are left out.
//!
//! The body's part of the added mass under the mean level, where the body was when the load was made, is part of its inertia. What the
//! surface and the motion take or give is a force in a step of time: `-(A(t) - A) (v - v_before) / dt`, A(t) of the place expected at
//! the end of the step. That is implicit and stays stable, as no difference is larger than the added mass itself. A member whose wet
//! length changes so does no work of its own: the formula has `A(t) b` and not `d(A v)/dt`, whose rest is slamming.
//!
//! Water is asked for once a step, at four Gauss points of each segment (and four more where its sections are cut, or the profile
//! of the current has a point), at the place
//! expected at the step's end. Drag takes the velocity of every trial, hydrostatics its place, both with their exact change.

mod added;
mod member;
mod under_way;

use super::hull::Tube;
use super::sea::Sea;
use super::steady::{Medium, Steady};
use super::{BodyLoad, Category, Load, MovingLoad, Underway};
use crate::model::{Body, ClassError, Model, Part, Piece, Pose, Shape, Six, WaveAction};
use member::Rod;
use nalgebra::{Matrix6, Vector3};
use std::f64::consts::PI;
use std::sync::Arc;
use under_way::UnderWay;

/// Most segments of a member.
const MOST: usize = 64;
/// Length of a segment times the mean wave number of the sea. Over it exp(kz) is integrated by four points within 3e-7 of itself.
const REACH: f64 = 2.0;

/// The members of a body, and what acts on them.
#[derive(Debug)]
pub struct Members {
    rods: Vec<Rod>,
    steady: Arc<Steady>,
    /// Heights at which the current begins to change otherwise (m, global), highest first.
    kinks: Vec<f64>,
    under_way: Option<UnderWay>,
}

/// The members of a body: their load, where there is any, and their added mass about its origin (body axes) under the mean level where
/// the body stands. `under_way` is `None` of a body at rest, else with the sea there is.
///
/// # Errors
/// An environment that cannot be computed.
pub fn of(
    model: &Model,
    body: &Body,
    under_way: Option<Option<&Arc<Sea>>>,
) -> Result<(Option<Members>, Matrix6<f64>), ClassError> {
    let there = |piece: &Piece| piece.member.is_some();
    if !model.parts_of(body).any(|part| part.pieces.iter().any(there)) {
        return Ok((None, Matrix6::zeros()));
    }
    let steady = Arc::new(Steady::streams(model, &model.environment)?);
    let sea = under_way.flatten();
    let reach = REACH / sea.map_or(0.0, |sea| mean_number(sea));
    let mut rods = Vec::new();
    for part in model.parts_of(body) {
        rods.extend(part.pieces.iter().filter_map(|piece| rod(model, &steady, (part, piece), reach)));
    }
    let pose = Pose::of(&body.place);
    let added = added::at_rest(&rods, &pose, steady.around.tide);
    let acts = !rods.is_empty() && (under_way.is_some() || !steady.still(Medium::Water));
    let load = acts.then(|| {
        let kinks = kinks(&steady);
        let under_way = under_way.map(|sea| UnderWay::new(sea.cloned(), (&rods, &kinks), &steady, &added));
        Members { rods, steady, kinks, under_way }
    });
    Ok((load, added))
}

/// The mean wave number of a sea, by energy (1/m).
pub(super) fn mean_number(sea: &Sea) -> f64 {
    let energy = |c: &super::sea::Component| c.amplitude * c.amplitude;
    let all: f64 = sea.components.iter().map(energy).sum();
    let numbers: f64 = sea.components.iter().map(|c| energy(c) * c.number).sum();
    if all > 0.0 { numbers / all } else { 0.0 }
}

/// Heights at which the current begins to change otherwise (m, global), highest first: there the integrals are divided.
fn kinks(steady: &Steady) -> Vec<f64> {
    let mut depths = steady.current.kinks();
    depths.retain(|d| *d >= 0.0 && d.is_finite());
    depths.push(0.0);
    depths.sort_by(f64::total_cmp);
    depths.dedup();
    // one that is the same at every depth has none
    if depths.len() == 1 { Vec::new() } else { depths.iter().map(|d| steady.around.tide - d).collect() }
}

/// A tube as a member; `None` of what has no force of Morison's formula.
fn rod(model: &Model, steady: &Steady, (part, piece): (&Part, &Piece), reach: f64) -> Option<Rod> {
    let (Some(own), Shape::Tube { ends, diameter }) = (piece.member, piece.shape.moved(&part.place)) else {
        return None;
    };
    let [from, to] = ends.map(Vector3::from);
    let axis = (to - from).try_normalize(0.0)?;
    let length = (to - from).norm();
    let density = steady.around.water_density;
    let section = PI * diameter * diameter / 4.0;
    let of = |category: Category| model.multipliers.of(category.name(), &part.name);
    let drags = 0.5 * density * diameter * of(Category::ViscousDrag);
    // what a database holds is not counted again
    let own_waves = if piece.waves == WaveAction::Database { 0.0 } else { 1.0 };
    let count = (length / reach).ceil().clamp(1.0, MOST as f64) as usize;
    let corner = |n: usize| from + axis * (length * n as f64 / count as f64);
    Some(Rod {
        from,
        axis,
        length,
        diameter,
        across: drags * own.drag,
        along: drags * PI * own.friction,
        section: section * piece.permeability * own_waves,
        added: density * section * own.added * own_waves,
        end_added: density * PI * diameter.powi(3) / 12.0 * own.end_added * own_waves,
        factor: of(Category::Wave),
        segments: (0..count).map(|n| Tube { ends: [corner(n), corner(n + 1)], diameter }).collect(),
    })
}

impl Members {
    fn checked(load: MovingLoad) -> Result<MovingLoad, ClassError> {
        let MovingLoad { load: Load { wrench, stiffness }, damping } = &load;
        if wrench.iter().chain(stiffness.iter()).chain(damping.iter()).all(|x| x.is_finite()) {
            Ok(load)
        } else {
            Err(ClassError::new("the force of the water on its members has no value where the body is"))
        }
    }
}

impl BodyLoad for Members {
    fn category(&self) -> Category {
        if self.under_way.is_some() { Category::Wave } else { Category::ViscousDrag }
    }

    /// Drag of the current. The mean of the waves' drag, which stays where they go with or against a current, is not in it.
    fn load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let mut sum = Load::none();
        if !self.steady.still(Medium::Water) {
            for load in self.rods.iter().map(|rod| rod.steady(&self.steady, &self.kinks, pose)) {
                sum.wrench += load.wrench;
                sum.stiffness += load.stiffness;
            }
        }
        Members::checked(MovingLoad::of(sum)).map(|made| made.load)
    }

    fn states(&self) -> usize {
        self.under_way.as_ref().map_or(0, |way| way.states())
    }

    fn begin(&self, ahead: &Underway, state: &mut [f64]) -> Result<(), ClassError> {
        if let Some(way) = &self.under_way {
            way.begin(&self.rods, &self.steady, ahead, state);
        }
        Ok(())
    }

    fn moving(&self, at: &Underway, state: &[f64]) -> Result<MovingLoad, ClassError> {
        match &self.under_way {
            Some(way) => Members::checked(way.moving(&self.rods, at, state)),
            None => self.load(at.pose).map(MovingLoad::of),
        }
    }

    fn commit(&self, at: &Underway, state: &mut [f64]) {
        if let Some(way) = &self.under_way {
            way.commit(at, state);
        }
    }

    fn apart(&self, at: &Underway, state: &[f64]) -> Option<(Category, Six)> {
        let way = self.under_way.as_ref()?;
        Some((Category::ViscousDrag, way.drag(at, state).0))
    }
}

/// The pieces of a body that displace water, and that waves move by no pressure: neither members nor of `-DIFTYPE FK`, nor part
/// of a hydrodynamic database. An engine with waves warns of them.
pub fn unmoved<'a>(model: &'a Model, body: &'a Body) -> impl Iterator<Item = &'a Piece> {
    let pieces = model.parts_of(body).flat_map(|part| part.pieces.iter());
    pieces.filter(|p| p.permeability != 0.0 && p.member.is_none() && p.waves == WaveAction::ByForm)
}
