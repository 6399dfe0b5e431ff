//! The elements of a rod, and their properties side by side for those that are taken at once.

use super::element_batch::BATCH_SIZE;
use super::mesh::RodElement;
use std::ops::Deref;

/// The elements of a rod from end A; read as a slice, changed as a whole.
#[derive(Clone, Debug)]
pub(super) struct ElementList {
    elements: Vec<RodElement>,
    columns: ElementColumns,
}

/// Each property of all elements in a list of its own, with room at the end for a batch that is not full.
#[derive(Clone, Debug, Default)]
struct ElementColumns {
    rest: Vec<f64>,
    rate: Vec<f64>,
    ea: Vec<f64>,
    damping: Vec<f64>,
    /// One of an element that resists being shortened, else zero.
    pushes: Vec<f64>,
    mass: Vec<f64>,
    volume: Vec<f64>,
    added: [Vec<f64>; 2],
    drag: [Vec<f64>; 2],
}

/// Properties of a batch of elements as [`RodElement`] has them, a lane for each; lanes beyond the last element are like it.
#[derive(Clone, Debug, Default)]
pub(super) struct ElementLanes {
    pub rest: [f64; BATCH_SIZE],
    pub rate: [f64; BATCH_SIZE],
    pub ea: [f64; BATCH_SIZE],
    pub damping: [f64; BATCH_SIZE],
    /// One of an element that resists being shortened, else zero.
    pub pushes: [f64; BATCH_SIZE],
    pub mass: [f64; BATCH_SIZE],
    pub volume: [f64; BATCH_SIZE],
    pub added: [[f64; BATCH_SIZE]; 2],
    pub drag: [[f64; BATCH_SIZE]; 2],
}

impl ElementList {
    /// The list of some elements.
    pub fn new(elements: Vec<RodElement>) -> Self {
        let columns = ElementColumns::of(&elements);
        ElementList { elements, columns }
    }

    /// Changes the elements.
    pub fn change(&mut self, by: impl FnOnce(&mut Vec<RodElement>)) {
        by(&mut self.elements);
        self.columns = ElementColumns::of(&self.elements);
    }

    /// Copies the properties of the elements from one on; nothing where it is not there.
    #[inline(always)]
    pub fn copy_lanes(&self, first: usize, lanes: &mut ElementLanes) {
        let copy = |lanes: &mut [f64; BATCH_SIZE], column: &[f64]| {
            if let Some(from) = column.get(first..).and_then(|rest| rest.first_chunk()) {
                *lanes = *from;
            }
        };
        let ElementColumns { rest, rate, ea, damping, pushes, mass, volume, added, drag } = &self.columns;
        copy(&mut lanes.rest, rest);
        copy(&mut lanes.rate, rate);
        copy(&mut lanes.ea, ea);
        copy(&mut lanes.damping, damping);
        copy(&mut lanes.pushes, pushes);
        copy(&mut lanes.mass, mass);
        copy(&mut lanes.volume, volume);
        for side in 0..2 {
            copy(&mut lanes.added[side], &added[side]);
            copy(&mut lanes.drag[side], &drag[side]);
        }
    }
}

impl ElementColumns {
    fn of(elements: &[RodElement]) -> Self {
        let column = |property: fn(&RodElement) -> f64| {
            let beyond = elements.last().map_or(0.0, property);
            elements.iter().map(property).chain(std::iter::repeat_n(beyond, BATCH_SIZE - 1)).collect()
        };
        ElementColumns {
            rest: column(|e| e.rest),
            rate: column(|e| e.rate),
            ea: column(|e| e.ea),
            damping: column(|e| e.damping),
            pushes: column(|e| f64::from(u8::from(e.compression))),
            mass: column(|e| e.mass),
            volume: column(|e| e.volume),
            added: [column(|e| e.added[0]), column(|e| e.added[1])],
            drag: [column(|e| e.drag[0]), column(|e| e.drag[1])],
        }
    }
}

impl Deref for ElementList {
    type Target = [RodElement];

    fn deref(&self) -> &[RodElement] {
        &self.elements
    }
}

impl PartialEq for ElementList {
    fn eq(&self, other: &Self) -> bool {
        self.elements == other.elements
    }
}
