//! Properties of a line at a given horizontal force that need no reference numbers.

use proptest::prelude::*;
use windlass_catenary::{Buoy, FlatBottom, Joint, Line, LineState, Segment};

fn segment() -> impl Strategy<Value = Segment> {
    (20.0..1500.0_f64, 1.0..3.7_f64, 4.5..10.0_f64).prop_map(|(length, weight, ea)| Segment {
        length,
        weight: 10f64.powf(weight),
        ea: 10f64.powf(ea),
    })
}

fn joint() -> impl Strategy<Value = Joint> {
    prop_oneof![
        Just(Joint::Free),
        (1e3..1e6_f64).prop_map(Joint::Weight),
        (1e3..1e6_f64, 0.0..900.0_f64).prop_map(|(capacity, depth)| Joint::SpringBuoy { capacity, depth }),
    ]
}

fn line() -> impl Strategy<Value = Line> {
    line_and_joints().prop_map(|(line, _, _)| line)
}

fn line_and_joints() -> impl Strategy<Value = (Line, Vec<Joint>, f64)> {
    let parts = (prop::collection::vec((segment(), joint()), 1..6), 50.0..2500.0_f64);
    parts.prop_filter_map("a pendant longer than the depth", |(parts, depth)| {
        let segments: Vec<_> = parts.iter().map(|p| p.0).collect();
        let joints: Vec<_> = parts.iter().skip(1).map(|p| p.1).collect();
        Some((Line::new(segments, joints.clone(), -depth, 0.0).ok()?, joints, depth))
    })
}

/// The vertical forces on the line add up to nothing: the fairlead carries the weight that hangs less the lifts.
fn balance(line: &Line, state: &LineState) -> f64 {
    let hanging: f64 =
        line.segments().iter().zip(&state.segments).map(|(s, at)| s.weight * (s.length - at.grounded)).sum();
    state.top_vertical - state.anchor_vertical - hanging + state.joints.iter().map(|j| j.lift).sum::<f64>()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn slope_matches_finite_difference_of_distance(line in line(), h in 2.0..6.5_f64, draft in 0.0..30.0_f64) {
        let h = 10f64.powf(h);
        let at = |h: f64| line.at_horizontal_force(h, -draft);
        let (Ok(middle), Ok(plus), Ok(minus)) = (at(h), at(h * 1.00001), at(h * 0.99999)) else { return Ok(()) };
        let buoys = |s: &LineState| s.joints.iter().map(|j| j.buoy).collect::<Vec<_>>();
        let aground = |s: &LineState| s.segments.iter().map(|g| g.grounded > 0.0).collect::<Vec<_>>();
        prop_assume!(buoys(&plus) == buoys(&minus) && aground(&plus) == aground(&minus));
        let slope = (plus.x - minus.x) / (2e-5 * h);
        prop_assert!((slope - middle.dx_dh).abs() <= 1e-4 * middle.dx_dh + 1e-10 * line.length() / (1e-5 * h),
            "{slope} {} {line:?} {h}", middle.dx_dh);
    }

    #[test]
    fn line_hangs_between_fairlead_and_anchor_and_its_forces_balance(
        parts in prop::collection::vec((segment(), 0.0..5e5_f64), 1..6), depth in 50.0..2500.0_f64, h in 2.0..6.5_f64,
    ) {
        let h = 10f64.powf(h);
        let segments: Vec<_> = parts.iter().map(|p| p.0).collect();
        let joints: Vec<_> = parts.iter().skip(1).map(|p| Joint::Weight(p.1)).collect();
        let line = Line::new(segments, joints, -depth, 0.0).unwrap();
        let state = line.at_horizontal_force(h, 0.0).unwrap();
        prop_assert!(balance(&line, &state).abs() < 1e-9 * (h + state.top_tension), "{line:?} {h} {state:?}");
        prop_assert!(state.anchor_vertical >= 0.0 && state.joints.iter().all(|j| j.z > -depth - 1e-6));
    }

    #[test]
    fn line_cut_in_pieces_matches_whole_line(s in segment(), cuts in prop::collection::vec(0.1..1.0_f64, 1..5),
                                             depth in 50.0..2500.0_f64, h in 2.0..6.5_f64) {
        let h = 10f64.powf(h);
        let total: f64 = cuts.iter().sum();
        let pieces: Vec<_> = cuts.iter().map(|c| Segment { length: s.length * c / total, ..s }).collect();
        let joints = vec![Joint::Free; pieces.len() - 1];
        let whole = Line::new(vec![s], vec![], -depth, 0.0).unwrap().at_horizontal_force(h, 0.0).unwrap();
        let pieces = Line::new(pieces, joints, -depth, 0.0).unwrap().at_horizontal_force(h, 0.0).unwrap();
        prop_assert!((whole.x - pieces.x).abs() <= 1e-9 * (s.length + depth + whole.x.abs()), "{whole:?} {pieces:?}");
        prop_assert!((whole.top_vertical - pieces.top_vertical).abs() <= 1e-8 * whole.top_tension);
        prop_assert!((whole.dx_dh - pieces.dx_dh).abs() <= 1e-7 * whole.dx_dh);
    }

    #[test]
    fn solutions_from_both_directions_agree(s in segment(), depth in 50.0..2500.0_f64, h in 2.0..6.5_f64) {
        let h = 10f64.powf(h);
        let line = Line::new(vec![s], vec![], -depth, 0.0).unwrap();
        let state = line.at_horizontal_force(h, 0.0).unwrap();
        prop_assume!(state.x > 0.0);
        let back = s.solve_end_forces(state.x, depth, Some(FlatBottom::default())).unwrap();
        // what the rounding of the distance makes of the force
        let slack = 1e-8 * state.top_tension + 1e-15 * (s.length + depth + state.x) * back.stiffness[0][0];
        prop_assert!((back.fairlead[0] - h).abs() <= slack, "{back:?} {state:?}");
        prop_assert!((back.fairlead[1] - state.top_vertical).abs() <= slack * (1.0 + depth / state.x));
        prop_assert!((back.grounded - state.grounded).abs() <= 1e-6 * s.length);
    }

    #[test]
    fn forces_scale_with_weight_and_stiffness(s in segment(), x in 0.05..1.3_f64, z in -0.9..0.9_f64, by in 0.01..100.0_f64) {
        let (x, z) = (x * s.length, z * s.length);
        let one = s.solve_end_forces(x, z, None).unwrap();
        let other = Segment { weight: s.weight * by, ea: s.ea * by, ..s }.solve_end_forces(x, z, None).unwrap();
        let tension = one.fairlead[0].hypot(one.fairlead[1]).max(one.anchor[1].abs());
        let slack = 1e-9 * tension + 1e-14 * s.ea;
        prop_assert!((one.fairlead[0] * by - other.fairlead[0]).abs() <= slack * by, "{one:?} {other:?}");
    }

    #[test]
    fn stiff_line_matches_inextensible_catenary(length in 50.0..2000.0_f64, w in 10.0..5000.0_f64,
                                                 x in 0.05..0.95_f64, z in -0.9..0.9_f64) {
        // (H/w) sinh(w x/2H) = sqrt(L2 - z2)/2 (closed inextensible form)
        let (x, z) = (x * length, z * length);
        prop_assume!(x.hypot(z) < 0.99 * length);
        let got = Segment { length, weight: w, ea: 1e9 * w * length }.solve_end_forces(x, z, None).unwrap();
        let a = got.fairlead[0] / w;
        let rigid = 2.0 * a * (0.5 * x / a).sinh();
        let want = ((length - z) * (length + z)).sqrt();
        prop_assert!((rigid / want - 1.0).abs() < 1e-6, "{rigid} {want}");
    }
}

/// Adds up a state along the line in small steps, with nothing of the engine but its end forces; what contradicts
/// equilibrium, geometry or the states of the buoys.
fn contradiction(line: &Line, joints: &[Joint], depth: f64, h: f64, state: &LineState) -> Option<String> {
    const STEPS: usize = 20_000;
    let (mut x, mut z) = (0.0, 0.0);
    let force = 1e-7 * (h + state.top_tension + line.segments().iter().map(|s| s.weight * s.length).sum::<f64>());
    let position = 2e-4 * line.segments().iter().map(|s| s.length * (1.0 + (h + 1e6) / s.ea)).sum::<f64>();
    for (index, (s, at)) in line.segments().iter().zip(&state.segments).enumerate() {
        let hanging = s.length - at.grounded;
        if (at.top_vertical - s.weight * hanging - at.bottom_vertical).abs() > force {
            return Some(format!("weight of segment {}", index + 1));
        }
        // down to the touchdown, along the bottom, and up again; or all the way at once
        let above = if at.grounded > 0.0 { at.top_vertical / s.weight } else { s.length };
        for (length, from) in [(above, at.top_vertical), (hanging - above, 0.0)] {
            let ds = length / STEPS as f64;
            for step in 0..STEPS {
                let v = from - s.weight * ds * (step as f64 + 0.5);
                let stretch = ds * (1.0 / h.hypot(v) + 1.0 / s.ea);
                x += h * stretch;
                z -= v * stretch;
            }
        }
        x += at.grounded * (1.0 + h / s.ea);
        let (Some(joint), Some(found)) = (joints.get(index), state.joints.get(index)) else { continue };
        if (found.x - x).abs() > position || (found.z - z).abs() > position {
            return Some(format!("joint {} at {x} {z}", index + 1));
        }
        let jump = state.segments[index + 1].top_vertical - at.bottom_vertical;
        let on_bottom = (z + depth).abs() < position;
        let carried = if matches!(joint, Joint::Weight(_)) { 0.0 } else { found.reaction };
        if (jump - found.lift - carried).abs() > force || found.reaction < 0.0 || (found.reaction > 0.0 && !on_bottom) {
            return Some(format!("joint {} is off balance by {}", index + 1, jump - found.lift - carried));
        }
        let fits = match joint {
            Joint::Free => found.lift == 0.0,
            // on the bottom, the line carries a part of the clump and the bottom the rest
            Joint::Weight(w) => found.lift == -w || (on_bottom && found.lift >= -w - force && found.lift <= force),
            Joint::SpringBuoy { capacity, depth } => {
                found.lift >= -force
                    && found.lift <= capacity + force
                    && (found.lift <= force || found.z <= -depth + position)
                    && (found.lift >= capacity - force || found.z >= -depth - position)
            }
            Joint::Buoy { .. } => false,
        };
        if !fits {
            return Some(format!("state of joint {}", index + 1));
        }
    }
    let ends = (x - state.x).abs() < position && (z + depth).abs() < position;
    (!ends).then(|| format!("the anchor at {x} {z}"))
}

/// Random lines with buoys and clumps: every one has a configuration, or an error that says why.
#[test]
fn lines_with_buoys_are_solved_or_refused_with_reason() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    use windlass_catenary::LineError;
    let mut runner = TestRunner::deterministic();
    let (mut solved, mut refused, mut other) = (0, 0, Vec::new());
    let mut buoys = [0; 3];
    for _ in 0..1000 {
        let ((line, joints, depth), h) = (line_and_joints(), 2.0..6.5_f64).new_tree(&mut runner).unwrap().current();
        let h = 10f64.powf(h);
        match line.at_horizontal_force(h, 0.0) {
            Ok(state) => {
                solved += 1;
                for joint in &state.joints {
                    match joint.buoy {
                        Some(Buoy::Slack) => buoys[0] += 1,
                        Some(Buoy::Held) => buoys[1] += 1,
                        Some(Buoy::Sunk) => buoys[2] += 1,
                        None => {}
                    }
                }
                if let Some(what) = contradiction(&line, &joints, depth, h, &state) {
                    other.push(format!("{what}: {h} {line:?} {state:?}"));
                }
            }
            Err(LineError::Pendant { .. }) => refused += 1,
            Err(error) => other.push(format!("{error} {h} {line:?}")),
        }
    }
    println!("{solved} solved, {refused} refused, {} wrong; buoys slack, held, sunk {buoys:?}", other.len());
    assert!(buoys.iter().all(|n| *n > 30), "the sample does not meet every state: {buoys:?}");
    assert!(other.is_empty(), "{}", other.iter().take(5).cloned().collect::<Vec<_>>().join("\n"));
}

#[test]
fn force_is_recovered_from_its_distance() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::deterministic();
    let (mut found, mut wrong) = (0, Vec::new());
    for _ in 0..1000 {
        let (line, h) = (line(), 3.0..6.5_f64).new_tree(&mut runner).unwrap().current();
        let h = 10f64.powf(h);
        let Ok(there) = line.at_horizontal_force(h, 0.0) else { continue };
        if there.x <= 0.0 {
            continue;
        }
        // 1e-7 of the tension, or what the rounding of the distance makes of the force
        match line.at_distance(there.x, 0.0) {
            Ok(back) if (back.force - h).abs() <= 1e-7 * there.top_tension + 1e-13 * line.length() / there.dx_dh => {
                found += 1
            }
            other => wrong.push(format!("{h} {there:?} {other:?}")),
        }
    }
    assert!(found > 900 && wrong.is_empty(), "{found} found, {} wrong\n{}", wrong.len(), wrong.first().unwrap());
}

#[test]
fn extreme_lines_are_errors_and_never_nan() {
    let values = [1e-300, 1e-9, 1.0, 1e9, 1e300];
    for length in values {
        for weight in [-1e300, -1.0, 0.0, 1e-300, 1.0, 1e300] {
            for (ea, h) in values.into_iter().flat_map(|ea| values.map(|h| (ea, h))) {
                for joint in [Joint::Free, Joint::Weight(1e300), Joint::SpringBuoy { capacity: 1e300, depth: 1.0 }] {
                    for depth in [0.0, 1.0, 1e300] {
                        let s = Segment { length, weight, ea };
                        let Ok(line) = Line::new(vec![s, s], vec![joint], -depth, 0.0) else { continue };
                        let Ok(state) = line.at_horizontal_force(h, 0.0) else { continue };
                        let line =
                            [state.x, state.dx_dh, state.top_tension, state.anchor_vertical, state.grounded_stretched];
                        let joints = state.joints.iter().flat_map(|j| [j.x, j.z, j.lift]);
                        let parts = state.segments.iter().flat_map(|s| [s.top_tension, s.bottom_tension, s.grounded]);
                        assert!(
                            line.into_iter().chain(joints).chain(parts).all(f64::is_finite),
                            "{s:?} {joint:?} {h} {depth}: {state:?}"
                        );
                    }
                }
            }
        }
    }
}
