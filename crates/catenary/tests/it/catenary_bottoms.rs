//! Lines over slopes and uneven bottoms, with friction, lifted by buoys, and of very many segments, against numbers that
//! were not made here.

use windlass_catenary::{Heap, Joint, Line, SeabedModel, Segment};

fn close(got: f64, want: f64, scale: f64, what: &str) {
    assert!((got - want).abs() <= scale, "{what}: {got} for {want}");
}

fn flat(depth: f64, friction: f64) -> Option<SeabedModel> {
    Some(SeabedModel { elevation: -depth, slope: 0.0, friction })
}

#[test]
fn moorings_over_slopes_match_closed_form() {
    // tests/data/static_slopes.py: 60 moorings of eight lines, slopes within 0.06
    let mut reader = csv::Reader::from_path("../../tests/data/static_slopes.csv").unwrap();
    let mut regimes = std::collections::BTreeMap::new();
    for row in reader.records() {
        let row = row.unwrap();
        let v = |i: usize| row[i].parse::<f64>().unwrap();
        let label = format!("mooring {} line {}", &row[0], &row[1]);
        let segment = Segment { length: v(4), weight: v(5), ea: v(6) };
        let floor = SeabedModel { elevation: -v(3), slope: v(7), friction: v(8) };
        let line = Line::new(vec![segment], vec![], -v(3), 1e4).unwrap().with_seabed(Some(floor)).unwrap();
        let state = line.at_distance(v(2), 0.0).unwrap_or_else(|e| panic!("{label}: {e}"));
        // 1e-8 of the tension at the fairlead, as for the lines over a flat bottom
        let scale = 1e-8 * v(9).hypot(v(10));
        close(state.force, v(9), scale, &label);
        close(state.top_vertical, v(10), scale, &label);
        close(state.anchor_horizontal, v(11), scale, &label);
        close(state.anchor_vertical, v(12), scale, &label);
        close(state.grounded, v(13), 1e-7 * segment.length, &label);
        let heap = match &row[14] {
            "heap_anchor" => Some(Heap::Anchor),
            "heap_touchdown" => Some(Heap::Touchdown),
            _ => None,
        };
        assert_eq!(state.heap.map(|h| h.0), heap, "{label}");
        *regimes.entry(row[14].to_string()).or_insert(0) += 1;
        // and back from the force
        if state.force > 1e-3 * scale / 1e-8 {
            let back = line.at_horizontal_force(state.force, 0.0).unwrap();
            close(back.x, v(2), 1e-8 * segment.length + scale / state.stiffness[0][0], &label);
        }
    }
    assert!(regimes.len() == 5 && regimes.values().all(|n| *n >= 10), "{regimes:?}");
}

#[test]
fn friction_acts_between_touchdowns_around_lifted_segment() {
    // an equilibrium found by shooting over the touchdowns, closed to 1e-9: H 274,521 N, T 786,929 N, 840 m on the bottom and
    // touchdown 5 m before the anchor
    let area = 0.25 * std::f64::consts::PI * 0.1 * 0.1;
    let part = |length, weight, emod: f64| Segment { length, weight, ea: emod * 1e6 * area };
    let parts = vec![part(3900.0, 270.0, 58569.019), part(2200.0, -68.0, 216_450.72), part(1200.0, 49.0, 152_788.75)];
    let line = Line::new(parts, vec![Joint::Free, Joint::Weight(2300.0)], -1900.0, 0.0).unwrap();
    let state = line.with_seabed(flat(1900.0, 0.96)).unwrap().at_distance(5700.0, 0.0).unwrap();
    close(state.force, 274_521.0, 0.5, "H");
    close(state.top_tension, 786_929.0, 0.5, "T");
    // 840 m before the light segment, 5 m before the anchor
    close(state.segments[0].grounded, 840.0, 0.5, "on the bottom");
    close(state.segments[2].grounded, 5.0, 0.5, "at the anchor");
}

#[test]
fn seabed_is_detected_below_distant_spring_buoy() {
    // scipy: 229.681 m hang, the buoy lifts V = 2500 N on either side of it, the rest lies with H; T + EA, H and V as in [IRVINE-1981]
    let ea = 2e11 * 0.25 * std::f64::consts::PI * 0.084 * 0.084;
    let part = Segment { length: 300.0, weight: 1200.0, ea };
    let buoy = Joint::SpringBuoy { capacity: 5000.0, depth: 0.0 };
    let line = Line::new(vec![part; 3], vec![Joint::Free, buoy], -100.0, 0.0).unwrap();
    let state = line.at_distance(870.0, 0.0).unwrap();
    close(state.top_tension, 376_593.278674, 1e-3, "T");
    close(state.force, 256_627.547873, 1e-3, "H");
    close(state.grounded, 900.0 - 229.680936929 - 5000.0 / 1200.0, 1e-6, "on the bottom");
    assert!(state.below_bottom.is_empty());
}

#[test]
fn first_segment_above_spring_buoy_may_hang_below_seabed() {
    // scipy: a symmetric catenary between the surface and the buoy there, the second segment down to where it touches down
    let ea = 2e11 * 0.25 * std::f64::consts::PI * 0.084 * 0.084;
    let part = |length| Segment { length, weight: 1200.0, ea };
    let buoy = Joint::SpringBuoy { capacity: 300e3, depth: 0.0 };
    let line = Line::new(vec![part(300.0), part(600.0)], vec![buoy], -50.0, 0.0).unwrap();
    let state = line.at_distance(700.0, 0.0).unwrap();
    close(state.force, 30_729.714631, 1e-3, "H");
    close(state.top_tension, 182_604.258881, 1e-3, "T");
    close(state.joints[0].lift, 265_363.746732, 1e-3, "buoy");
    close(state.grounded, 528.863544390, 1e-6, "on the bottom");
    let &[(1, below)] = state.below_bottom.as_slice() else { panic!("{:?}", state.below_bottom) };
    close(below, 126.574300433 - 50.0, 1e-6, "below the bottom");
}

/// A line of 500 m cut in so many parts; whether each has a weight of its own.
fn line_in_parts(parts: usize, varied: bool, friction: f64) -> Line {
    let share = |i: usize| if varied { 1.0 + 0.3 * ((i * 7919) % 101) as f64 / 101.0 } else { 1.0 };
    let segment = |i: usize| Segment { length: 500.0 / parts as f64, weight: 600.0 * share(i), ea: 7e8 };
    let segments = (0..parts).map(segment).collect();
    let line = Line::new(segments, vec![Joint::Free; parts - 1], -100.0, 0.0).unwrap();
    line.with_seabed(flat(100.0, friction)).unwrap()
}

#[test]
fn line_cut_in_1000_parts_matches_uncut_line() {
    for friction in [0.0, 0.5] {
        let whole = line_in_parts(1, false, friction).at_distance(480.0, 0.0).unwrap();
        let mut work = Vec::new();
        for parts in [30, 1000, 10_000] {
            let state = line_in_parts(parts, false, friction).at_distance(480.0, 0.0).unwrap();
            close(state.force, whole.force, 1e-11 * whole.force, "H");
            close(state.top_tension, whole.top_tension, 1e-11 * whole.top_tension, "T");
            close(state.grounded, whole.grounded, 1e-9 * 500.0, "on the bottom");
            assert!(state.segments.len() == parts && state.residual <= 1e-9 * state.top_tension);
            work.push(state.iterations);
        }
        // each iteration goes once along the line: as many for ten thousand parts as for thirty
        assert!(work.iter().all(|w| *w <= 200), "{work:?}");
    }
}

#[test]
fn thousand_different_parts_carry_their_weights() {
    for (parts, friction) in [(40, 0.0), (1000, 0.0), (1000, 0.3)] {
        let line = line_in_parts(parts, true, friction);
        let state = line.at_distance(480.0, 0.0).unwrap();
        // what hangs is carried by the fairlead; friction takes mu times what lies
        let lies = |(s, at): (&Segment, &windlass_catenary::SegmentState)| s.weight * at.grounded;
        let lying: f64 = line.segments().iter().zip(&state.segments).map(lies).sum();
        let all: f64 = line.segments().iter().map(|s| s.weight * s.length).sum();
        close(state.top_vertical, all - lying, 1e-9 * all, "V");
        close(state.anchor_horizontal, state.force - friction * lying, 1e-9 * all, "H at the anchor");
    }
}

#[test]
fn lines_over_ridges_and_hollows_match_hand_solved_contacts() {
    // tests/data/static_profiles.py: 1200 N/m, EA 6e8 N; H, V, pull on the anchor, length on the bottom
    type ProfileCase<'a> = (f64, &'a [(f64, f64)], [f64; 2], [f64; 5]);
    const VALLEY: &[(f64, f64)] = &[(0.0, -200.0), (400.0, -220.0), (1000.0, -190.0)];
    const RIDGE: &[(f64, f64)] = &[(0.0, -220.0), (250.0, -190.0), (1000.0, -215.0)];
    const TIP: &[(f64, f64)] = &[(0.0, -260.0), (300.0, -170.0), (1000.0, -400.0)];
    const BRIDGE: &[(f64, f64)] = &[(0.0, -230.0), (150.0, -200.0), (230.0, -260.0), (310.0, -195.0), (1000.0, -215.0)];
    let cases: [ProfileCase; 8] = [
        (0.0, VALLEY, [900.0, 968.0], [404878.505986, 505113.436421, 419032.286778, -20951.614339, 530.936488844]),
        (0.0, RIDGE, [800.0, 876.0], [259683.088596, 411573.498071, 233128.710162, 27975.445219, 525.808665813]),
        (0.0, TIP, [700.0, 765.0], [410936.386259, 453797.770888, 299264.224035, 89779.267210, 313.018044632]),
        (0.0, BRIDGE, [900.0, 976.0], [315983.836103, 447349.786527, 278363.136438, 55672.627288, 432.976921185]),
        (0.2, VALLEY, [900.0, 968.0], [405852.317653, 505615.369706, 292328.824135, -14616.441207, 533.439959944]),
        (0.2, RIDGE, [800.0, 876.0], [260136.149196, 411810.714437, 102640.985977, 12316.918317, 525.598400491]),
        (0.2, TIP, [700.0, 765.0], [411304.681303, 453905.679901, 192053.080969, 57615.924291, 313.057638499]),
        (0.2, BRIDGE, [900.0, 976.0], [336315.556233, 457296.219797, 148784.226590, 29756.845318, 422.246514812]),
    ];
    for (friction, positions, [x, length], want) in cases {
        let label = format!("{friction} {positions:?}");
        let (_, anchor) = positions[0];
        let segment = Segment { length, weight: 1200.0, ea: 6e8 };
        let line = Line::new(vec![segment], vec![], anchor, 0.0).unwrap().over_profile(positions, friction).unwrap();
        let state = line.at_distance(x, -10.0).unwrap_or_else(|e| panic!("{label}: {e}"));
        let got = [state.force, state.top_vertical, state.anchor_horizontal, state.anchor_vertical, state.grounded];
        for (got, want) in got.into_iter().zip(want) {
            close(got, want, 1e-8 * 6e5, &label);
        }
        // the stiffness is the difference of the forces
        let d = 1e-4;
        let at = |dx: f64, dz: f64| line.at_distance(x + dx, -10.0 + dz).unwrap();
        for (column, (plus, minus)) in [(at(d, 0.0), at(-d, 0.0)), (at(0.0, d), at(0.0, -d))].into_iter().enumerate() {
            let force = [plus.force - minus.force, plus.top_vertical - minus.top_vertical];
            let far = [plus.anchor_horizontal - minus.anchor_horizontal, plus.anchor_vertical - minus.anchor_vertical];
            let scale = 1e-5 * (state.stiffness[0][0] + state.stiffness[1][1]);
            for row in 0..2 {
                close(state.stiffness[row][column], force[row] / (2.0 * d), scale, &label);
                close(state.coupling[row][column], far[row] / (2.0 * d), scale, &label);
            }
        }
        // the shape does not pass below the bottom, and runs to the anchor
        let shape = line.shape(&state, 200);
        assert!(shape.iter().all(|p| p.z >= line.bottom_at(x - p.x).unwrap() - 1e-6), "{label}");
        let last = shape.last().unwrap();
        close(last.x, x, 1e-6, &label);
        close(last.z, anchor, 1e-6, &label);
    }
}

#[test]
fn excess_length_heaps_in_hollow_without_friction() {
    // it comes down 1 in 10 to the hollow with T = 0 there, and hangs on the anchor by w times the height
    let positions = [(0.0, -200.0), (400.0, -220.0), (1000.0, -160.0)];
    let segment = Segment { length: 1100.0, weight: 1200.0, ea: 1e15 };
    let line = Line::new(vec![segment], vec![], -200.0, 0.0).unwrap().over_profile(&positions, 0.0).unwrap();
    let state = line.at_distance(700.0, -10.0).unwrap();
    // on a frictionless bottom T - w z is the same all along: zero tension at the hollow, w times its depth below the anchor
    close(state.top_tension, 1200.0 * (220.0 - 10.0), 1e-3, "T");
    close(state.anchor_horizontal.hypot(state.anchor_vertical), 1200.0 * 20.0, 1e-3, "T at the anchor");
    let Some((Heap::Hollow(at), length)) = state.heap else { panic!("{:?}", state.heap) };
    let (x, z) = state.touchdown.unwrap();
    let hangs = (state.top_vertical - state.force * 0.1) / 1200.0;
    let lies = (700.0 - x - 400.0).hypot(z + 220.0) + 400f64.hypot(20.0);
    close(at, 400.0, 1e-9, "hollow");
    close(length, 1100.0 - hangs - lies, 1e-6, "heap");
}

#[test]
fn slack_line_with_buoy_on_slope_rises_above_its_heap() {
    // 1000 N/m, EA 6e8 N, 30 kN of lift, fairlead 400 m from the anchor at z = -10, slope of 1 in 10. By scipy from [IRVINE-1981],
    // contacts closed by hand: the loop under the buoy stands upright on a heap (first and third line), and in the second line
    // the touchdowns at both sides of the buoy are roots of the way to the anchor
    // first and second length, slope, V, H and V at the anchor, spare length, place and elevation of the buoy
    type SlopeCase = (f64, f64, f64, [f64; 6]);
    let cases: [SlopeCase; 3] = [
        (200.0, 550.0, -0.1, [129985.91971723, 39800.16098059, -3980.01609806, 188.03245438, 0.0, -124.9998125]),
        (
            500.0,
            250.0,
            -0.1,
            [129985.91971723, 37217.54857286, -3721.75485729, 214.11683970, 152.61570071, -118.20755232],
        ),
        (600.0, 150.0, 0.1, [83075.48443782, 0.0, 0.0, 290.91163817, 400.0, -84.9998125]),
    ];
    for (first, second, slope, want) in cases {
        let part = |length| Segment { length, weight: 1000.0, ea: 6e8 };
        let line = Line::new(vec![part(first), part(second)], vec![Joint::Weight(-30e3)], -100.0, 0.0).unwrap();
        let line = line.with_seabed(Some(SeabedModel { elevation: -100.0, slope, friction: 0.0 })).unwrap();
        let state = line.at_distance(400.0, -10.0).unwrap_or_else(|e| panic!("{slope}: {e}"));
        let (_, heap) = state.heap.unwrap();
        let joint = state.joints[0];
        let forces = [state.top_vertical, state.anchor_horizontal, state.anchor_vertical];
        for (got, want) in forces.into_iter().chain([heap, joint.x, joint.z]).zip(want) {
            close(got, want, 2e-3, &format!("{slope} {state:?}"));
        }
    }
}

#[test]
fn line_between_two_friction_regions_is_solved() {
    // a light segment rises to an anchor above the bottom: the later it leaves the bottom the less tension friction has left it, and
    // the higher it rises. scipy (fsolve from 1008 starts, one root), from [IRVINE-1981]: both contacts and the anchor closed to 1e-10
    let part = |length, weight, ea| Segment { length, weight, ea };
    let parts = vec![part(360.3, 4250.0, 1.97e9), part(341.3, 1510.0, 7.5e8), part(126.0, 13.0, 2.8e9)];
    let line = Line::new(parts, vec![Joint::Weight(-185.3e3), Joint::Free], -182.4, 0.0).unwrap();
    let line = line.with_seabed(Some(SeabedModel { elevation: -303.0, slope: -0.147, friction: 0.914 })).unwrap();
    let state = line.at_distance(538.0, -46.0).unwrap();
    close(state.force, 267802.28263, 1e-2, "H");
    close(state.top_vertical, 1458587.41372, 1e-2, "V");
    close(state.anchor_horizontal, 4144.55699, 1e-2, "H at the anchor");
    close(state.anchor_vertical, -14450.84138, 1e-2, "V at the anchor");
    close(state.grounded, 232.56958, 1e-4, "on the bottom");
    close(state.joints[0].x, 167.95413, 1e-4, "buoy");
}

#[test]
fn distance_for_a_force_is_found_on_slope_with_two_weights() {
    // heavy chain, then a light rope of which 286 m carry tension; no friction. scipy (brentq, one root in the length that hangs)
    let parts = vec![
        Segment { length: 323.0, weight: 2772.0, ea: 1.376e9 },
        Segment { length: 363.7, weight: 17.7, ea: 1.04e7 },
    ];
    let line = Line::new(parts, vec![Joint::Free], -294.2, 0.0).unwrap();
    let line = line.with_seabed(Some(SeabedModel { elevation: -294.2, slope: 0.0835, friction: 0.0 })).unwrap();
    let state = line.at_horizontal_force(26_700.0, -60.8).unwrap();
    close(state.x, 434.663283781, 1e-6, "distance");
    close(state.top_vertical, 580660.7392, 1e-3, "V");
    close(state.heap.unwrap().1, 77.529478105, 1e-6, "heap");
}

#[test]
fn pendant_longer_than_depth_at_anchor_holds_over_deeper_water() {
    // 120 m of pendant, 100 m of water at the anchor and 200 m from 100 m beyond it on: two catenaries of 500 and 300 N/m meet at
    // a joint 120 m below the surface, all hanging free. scipy: the buoy's lift closes V, H closes the distance
    let positions = [(0.0, -100.0), (100.0, -200.0), (1000.0, -200.0)];
    let part = |length, weight| Segment { length, weight, ea: 5e8 };
    let buoy = Joint::SpringBuoy { capacity: 1e6, depth: 120.0 };
    let line = Line::new(vec![part(300.0, 500.0), part(300.0, 300.0)], vec![buoy], -100.0, 0.0).unwrap();
    let state = line.over_profile(&positions, 0.0).unwrap().at_distance(560.0, -10.0).unwrap();
    close(state.joints[0].z, -120.0, 1e-6, "held");
    close(state.force, 125_969.442838, 1e-3, "H");
    close(state.joints[0].lift, 54_332.568165, 1e-3, "buoy");
    close(state.top_vertical, 131_734.477623, 1e-3, "V");
}

#[test]
fn clump_at_edge_of_heap_is_supported_by_the_length_condition() {
    // slope of 1 in 10 without friction, down to the fairlead: the second segment reaches from the anchor to the clump straight
    // below the fairlead with less than w sin of the clump: (T0 + w sin L / 2) L / EA is what it has to stretch
    let (second, ea) = (400.3, 6e6);
    let part = |length| Segment { length, weight: 1000.0, ea };
    let line = Line::new(vec![part(200.0), part(second)], vec![Joint::Weight(1e5)], -100.0, 0.0).unwrap();
    let line = line.with_seabed(Some(SeabedModel { elevation: -100.0, slope: -0.1, friction: 0.0 })).unwrap();
    let state = line.at_distance(400.0, -10.0).unwrap();
    let way = 400f64.hypot(40.0);
    let (sin, cos) = (40.0 / way, 400.0 / way);
    let least = (way - second) * ea / second - 0.5 * 1000.0 * sin * second;
    assert!(least > 0.0 && least < 1e5 * sin);
    close(state.segments[1].top_tension, least, 1e-2, "T at the clump");
    close(state.anchor_horizontal, (least + 1000.0 * sin * second) * cos, 1e-2, "H at the anchor");
    let hangs = state.top_vertical / 1000.0;
    close(hangs + 0.5 * 1000.0 * hangs * hangs / ea, 130.0, 1e-6, "what hangs");
    close(state.heap.unwrap().1, 200.0 - hangs, 1e-6, "heap");
    close(state.joints[0].reaction, 1e5 * cos, 1e-2, "reaction");
}

#[test]
fn shape_with_friction_has_one_touchdown_point() {
    let segment = Segment { length: 600.0, weight: 1200.0, ea: 6e8 };
    let line = Line::new(vec![segment], vec![], -100.0, 0.0).unwrap().with_seabed(flat(100.0, 0.8)).unwrap();
    let state = line.at_distance(540.0, 0.0).unwrap();
    assert_eq!(state.anchor_horizontal, 0.0);
    // both ends, nine inside, the touchdown
    assert_eq!(line.shape(&state, 9).len(), 12);
}

#[test]
fn lifted_joint_above_surface_is_named_by_both_solvers() {
    // 20 m of water; the first segment comes down, lies, and rises to a joint lifted by 50 kN; the second is whole, or in forty parts
    let part = |length| Segment { length, weight: 500.0, ea: 6e8 };
    let line = |parts: usize| {
        let segments: Vec<Segment> =
            std::iter::once(part(200.0)).chain(vec![part(60.0 / parts as f64); parts]).collect();
        let joints: Vec<Joint> = std::iter::once(Joint::Weight(-5e4)).chain(vec![Joint::Free; parts - 1]).collect();
        Line::new(segments, joints, -20.0, 0.0).unwrap().at_distance(170.0, 0.0).unwrap()
    };
    let (whole, cut) = (line(1), line(40));
    assert!(whole.segments[0].grounded > 10.0 && whole.joints[0].z > 10.0, "{whole:?}");
    let (&[(1, high)], &[(1, same)]) = (whole.above_surface.as_slice(), cut.above_surface.as_slice()) else {
        panic!("{:?} {:?}", whole.above_surface, cut.above_surface)
    };
    close(high, whole.joints[0].z, 1e-9, "height");
    close(same, high, 1e-6, "height");
}
