//! What an installed tether reports of its ends and its length: arc, what elements bear, what the structure feels.

use super::{Bending, LOOK_AHEAD, PerLength, PlaneMotion, Stage};
use crate::beam::{self, Vector4};
use crate::installed::axis::{TetherAxis, tilt};
use crate::installed::tension::{TensionModel, TetherTension};
use nalgebra::Vector3;

impl Bending {
    /// How much longer the tether is than its axis (m): `1/2 int w'^2 ds` with the cubic of each element, of a length altogether (m).
    pub fn arc(&self, motion: &[PlaneMotion; 2], length: f64) -> f64 {
        let stretch = length / self.length;
        let of = |(index, cell): (usize, &PerLength)| -> f64 {
            let part = |m: &PlaneMotion| {
                beam::twice_energy(0.0, 1.0, cell.length * stretch, &beam::of_element(&m.deflection, index))
            };
            0.5 * motion.iter().map(part).sum::<f64>()
        };
        self.cells.iter().enumerate().map(of).sum()
    }

    /// What each end of an element bears at a stage, by plane: force across and moment of its slope on it, `K x + M a - F` with the place that
    /// the stage looks ahead to, so that those of two elements at a node balance.
    pub fn end_loads(&self, element: usize, second: bool, stage: &Stage, axial: &TensionModel) -> [Vector4; 2] {
        let Some(cell) = self.cells.get(element) else { return [[0.0; 4]; 2] };
        let stretch = stage.tension.length / self.length;
        let length = cell.length * stretch;
        let mass = beam::mass(cell.mass[0] / stretch + cell.mass[1], length);
        let (bends, pulls) =
            (beam::stiffness(cell.bending, length), beam::geometric(axial.middle(element, stage.tension), length));
        let ends = [element, element + 1].map(|node| self.shares[node]);
        [0, 1].map(|plane| {
            let end = stage.axis.parts(stage.attachment.acceleration)[plane];
            let turn = end / stage.tension.length;
            let frame = [ends[0] * end, turn, ends[1] * end, turn];
            let a = beam::of_element(&self.found[usize::from(second)][plane], element);
            let x = beam::of_element(&self.now[plane].deflection, element);
            let v = beam::of_element(&self.now[plane].velocity, element);
            let ahead: Vector4 = std::array::from_fn(|i| x[i] + LOOK_AHEAD * stage.dt * (v[i] + 0.5 * stage.dt * a[i]));
            let all: Vector4 = std::array::from_fn(|i| a[i] + frame[i]);
            let mut sum = beam::times(&bends, &ahead);
            beam::add(&mut sum, 1.0, &beam::times(&pulls, &ahead));
            beam::add(&mut sum, 1.0, &beam::times(&mass, &all));
            if self.axial > 0.0 {
                let motion = if second { &self.trial } else { &self.now };
                let at_stage = beam::of_element(&motion[plane].deflection, element);
                let more = beam::geometric(self.tension_ahead[usize::from(second)], length);
                beam::add(&mut sum, 1.0, &beam::times(&more, &at_stage));
            }
            beam::add(&mut sum, -1.0, &self.loads[plane][element]);
            sum
        })
    }

    /// What the structure bears across the axis, by plane (N): what is missing in the balance of the unknown at the top but for the inertia
    /// that it has with the axis ([`Bending::entrained_mass`]). Places and loads are those of the stage now gathered; the acceleration against the
    /// axis is that of the stage before.
    pub fn top_shear(&self, second: bool, tension: &TetherTension, axial: &TensionModel) -> [f64; 2] {
        let last = self.cells.len().saturating_sub(1);
        let Some(cell) = self.cells.get(last) else { return [0.0; 2] };
        let length = cell.length * tension.length / self.length;
        let mass = self.top_mass(tension);
        let (bends, pulls) =
            (beam::stiffness(cell.bending, length), beam::geometric(axial.middle(last, tension), length));
        let motion = if second { &self.trial } else { &self.now };
        [0, 1].map(|plane| {
            let x = beam::of_element(&motion[plane].deflection, last);
            let a = beam::of_element(&self.found[usize::from(!second)][plane], last);
            let load = self.loads[plane][last][2];
            beam::dot(&bends[2], &x) + beam::dot(&pulls[2], &x) + beam::dot(&mass, &a) - load
        })
    }

    /// The row of the top's deflection in the mass of the last element.
    fn top_mass(&self, tension: &TetherTension) -> Vector4 {
        let stretch = tension.length / self.length;
        let mass = |c: &PerLength| beam::mass(c.mass[0] / stretch + c.mass[1], c.length * stretch)[2];
        mass(&self.cells[self.cells.len() - 1])
    }

    /// The mass (kg) across the axis that rides on the structure's end with the axis itself.
    pub fn entrained_mass(&self, tension: &TetherTension) -> f64 {
        // a tether has an element, and so two nodes
        let top = self.shares.len() - 1;
        let turn = 1.0 / tension.length;
        let frame = [self.shares[top - 1], turn, self.shares[top], turn];
        beam::dot(&self.top_mass(tension), &frame)
    }

    /// Slopes at the structure by plane (rad).
    pub fn top_slopes(&self, motion: &[PlaneMotion; 2]) -> [f64; 2] {
        [0, 1].map(|p| motion[p].deflection[motion[p].deflection.len() - 1])
    }

    /// What the coil at the structure does to it by plane (N m), against the slope.
    pub fn coil(&self, motion: &[PlaneMotion; 2], axis: &TetherAxis, upright: Vector3<f64>) -> [f64; 2] {
        let (slopes, vessel) = (self.top_slopes(motion), tilt(upright));
        [0, 1].map(|p| self.springs[1][p] * (slopes[p] + axis.tilt[p] - vessel[p] - self.rest[1][p]))
    }
}
