//! The lines that are measured, and the path their fairleads take.

#![allow(clippy::unwrap_used)]

use std::f64::consts::{FRAC_PI_4, TAU};
use windlass_base::units::{METRES_PER_FOOT, NEWTONS_PER_KIP};
use windlass_catenary::{FlatBottom, Joint, Line, Segment};

/// Steps of the path.
pub const STEPS: usize = 100;

/// A line of tests/data/catenary_2000.csv whose fairlead goes once around an ellipse.
pub struct Moving {
    segment: Segment,
    x: f64,
    z: f64,
    bottom: Option<FlatBottom>,
}

impl Moving {
    /// The 2,000 lines.
    pub fn all() -> Vec<Moving> {
        let read = |row: csv::StringRecord| {
            let v = |i: usize| row[i].parse::<f64>().unwrap();
            let segment = Segment { length: v(4), ea: v(5), weight: v(6) };
            Moving { segment, x: v(2), z: v(3), bottom: (&row[8] == "0").then(|| FlatBottom { friction: v(7) }) }
        };
        csv::Reader::from_path("tests/data/catenary_2000.csv").unwrap().records().map(|r| read(r.unwrap())).collect()
    }

    /// The fairlead at a step: 1 % of the length to and fro, half of that up and down, but neither beyond the anchor,
    /// nor into the bottom or, from where it lies on it, off it.
    fn fairlead_at_step(&self, step: usize) -> (f64, f64) {
        let phase = TAU * step as f64 / STEPS as f64;
        let x = (self.x + 0.01 * self.segment.length * phase.sin()).max(0.0);
        let rise = 0.005 * self.segment.length * (phase.cos() - 1.0);
        match self.bottom {
            Some(_) if self.z == 0.0 => (x, 0.0),
            Some(_) => (x, (self.z + rise).max(0.5 * self.z)),
            None => (x, self.z + rise),
        }
    }

    /// The horizontal force where the line is given.
    pub fn cold(&self) -> f64 {
        self.segment.solve_end_forces(self.x, self.z, self.bottom).unwrap().fairlead[0]
    }

    /// The sum of horizontal forces along the path, each from nothing.
    pub fn cold_along(&self) -> f64 {
        (1..=STEPS)
            .map(|n| self.fairlead_at_step(n))
            .map(|(x, z)| self.segment.solve_end_forces(x, z, self.bottom).unwrap().fairlead[0])
            .sum()
    }

    /// The same, each from the one before, and the first from the line as given.
    pub fn followed_along(&self) -> f64 {
        let mut last = self.segment.solve_end_forces(self.x, self.z, self.bottom).unwrap();
        let mut sum = 0.0;
        for (x, z) in (1..=STEPS).map(|n| self.fairlead_at_step(n)) {
            last = self.segment.solve_warm_start(x, z, self.bottom, &last).unwrap();
            sum += last.fairlead[0];
        }
        sum
    }
}

/// The four-segment line of [MOSES-FLEX example] with its spring buoy sunk and held: name, line, breaks.
pub fn table_lines() -> Vec<(&'static str, Line, [f64; 4])> {
    let segment = |od: f64, length: f64, weight: f64, e: f64| Segment {
        length: length * METRES_PER_FOOT,
        weight: weight * NEWTONS_PER_KIP / METRES_PER_FOOT,
        ea: e * FRAC_PI_4 * od * od * NEWTONS_PER_KIP,
    };
    let wire = |length: f64| segment(4.625, length, 0.03751, 2900.0);
    [("sunk buoy", 100.0, 0.0), ("held buoy", 200.0, 50.0)]
        .map(|(name, capacity, pendant)| {
            let buoy = Joint::SpringBuoy { capacity: capacity * NEWTONS_PER_KIP, depth: pendant * METRES_PER_FOOT };
            let segments = vec![wire(500.0), wire(4000.0), segment(4.375, 2000.0, 0.1582, 4350.0), wire(2000.0)];
            let line =
                Line::new(segments, vec![buoy, Joint::Free, Joint::Free], -3000.0 * METRES_PER_FOOT, 0.0).unwrap();
            (name, line, [1008.0, 1008.0, 902.0, 1008.0].map(|b| b * NEWTONS_PER_KIP))
        })
        .into()
}
