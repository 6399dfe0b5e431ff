//! The installed example of [AQWA-TETHER 8.2]: a tension leg platform of tubes on four groups of tethers, in SI.

#![allow(dead_code, clippy::unwrap_used)]

use nalgebra::{Matrix3, Vector3};
use windlass_base::pose::{Pose, Six};
use windlass_tether::compatibility::Compatibility;
use windlass_tether::installed::{EndSprings, Impact, InstalledRunSettings, InstalledTether};
use windlass_tether::line::ElementLabel;
use windlass_tether::structure::flow::{FlowWaves, WaterFlow};
use windlass_tether::structure::tubes::{AQWA_FRICTION, TubeMember, Tubes};
use windlass_tether::structure::wave::DeepWave;
use windlass_tether::{TetherElement, TetherLine};

/// The centre of gravity above the keel (m).
const CENTRE: Vector3<f64> = Vector3::new(0.0, 0.0, 63.6);
const CORNERS: [[f64; 2]; 4] = [[-52.63, 52.63], [-52.63, -52.63], [52.63, -52.63], [52.63, 52.63]];

/// Its tubes, from the centre of gravity.
pub fn tubes() -> Vec<TubeMember> {
    let at = |x: f64, y: f64, z: f64| Vector3::new(x, y, z) - CENTRE;
    let mut made = Vec::new();
    for [x, y] in [[40.0, 40.0], [-40.0, 40.0], [-40.0, -40.0], [40.0, -40.0]] {
        for [from, to] in [[0.0, 28.5], [28.5, 57.0], [57.0, 114.0]] {
            let ends = [at(x, y, from), at(x, y, to)];
            made.push(TubeMember { ends, diameter: 31.1, drag: 0.75, added: 1.0, friction: AQWA_FRICTION });
        }
    }
    let (a, b, z) = (28.3377, 47.43, 8.124);
    for [from, to] in [[[-a, b], [a, b]], [[-b, -a], [-b, a]], [[-a, -b], [a, -b]], [[b, -a], [b, a]]] {
        let ends = [at(from[0], from[1], z), at(to[0], to[1], z)];
        made.push(TubeMember { ends, diameter: 13.0, drag: 0.75, added: 1.48, friction: AQWA_FRICTION });
    }
    made
}

pub fn platform(compatibility: Compatibility) -> Tubes {
    let inertia = Matrix3::from_diagonal(&Vector3::new(1.0339e12, 0.9529e12, 0.7349e12));
    Tubes::new(268.8e6, inertia, tubes(), compatibility).unwrap()
}

pub fn tethers() -> Vec<InstalledTether> {
    let tether = |(number, [x, y]): (usize, &[f64; 2])| {
        let hundred = 100 * (number as i64 + 1);
        let element = |nodes: [i64; 2]| TetherElement {
            length: 88.4685,
            outer_diameter: 1.1176,
            wall_thickness: 0.038,
            density: 7816.94,
            youngs_modulus: 2.15e11,
            drag: 0.75,
            added_mass: 1.0,
            label: ElementLabel { nodes: nodes.map(|n| hundred + n), material: 101, geometry: 101 },
        };
        let line = TetherLine::new([[4, 3], [3, 2], [2, 1]].map(element).to_vec()).unwrap();
        let (anchor, top) = (Vector3::new(*x, *y, -329.73543), Vector3::new(*x, *y, 12.85) - CENTRE);
        let springs = EndSprings::from_card(Some([0.0, 5729.578e3, 5729.578e3])).0;
        InstalledTether {
            anchor_springs: springs,
            vessel_springs: springs,
            impact: Some(Impact { factor: 3e8, half_life: 2.5 }),
            lower_stop: Some(100.0),
            group: 4.0,
            ..InstalledTether::new((number + 1).to_string(), line, anchor, top)
        }
    };
    CORNERS.iter().enumerate().map(tether).collect()
}

pub fn water() -> WaterFlow {
    WaterFlow::still_water(1025.0, 9.81)
        .unwrap()
        .with_waves(FlowWaves::Deep(DeepWave::new(15.0, 15.0, 0.0, 9.81).unwrap()))
}

pub fn course() -> InstalledRunSettings {
    let pose = Pose::from_position([-46.0, 0.0, -17.4]);
    InstalledRunSettings { start: 0.0, step: 0.25, states: 101, pose, velocity: Six::zeros() }
}
