//! Properties of the line engine that need no reference numbers: closed inelastic form, one segment as many, scaling,
//! equilibrium, stiffness by differences, clumps on the bottom, and numbers it must refuse.

use proptest::prelude::*;
use windlass_catenary::{Joint, Line, LineError, Segment, table};

fn line(segments: &[(f64, f64, f64)], joints: &[Joint], depth: f64) -> Line {
    let segments =
        segments.iter().map(|(length, weight, ea)| Segment { length: *length, weight: *weight, ea: *ea }).collect();
    Line::new(segments, joints.to_vec(), -depth, 0.0).unwrap()
}

#[test]
fn nearly_rigid_grounded_line_matches_inelastic_catenary() {
    // [IRVINE-1981 1.2]: s = sqrt(d (d + 2 H/w)), x = H/w acosh(1 + w d/H) + L - s, T = H + w d
    for (h, w, d, l) in [(5e5, 1500.0, 200.0, 1200.0), (3e4, 900.0, 80.0, 700.0), (2e6, 2000.0, 500.0, 3000.0)] {
        let state = line(&[(l, w, 1e18)], &[], d).at_horizontal_force(h, 0.0).unwrap();
        let s = (d * (d + 2.0 * h / w)).sqrt();
        assert!((state.x - (h / w * (1.0 + w * d / h).acosh() + l - s)).abs() < 1e-8 * l, "{state:?}");
        assert!((state.top_tension - (h + w * d)).abs() < 1e-9 * state.top_tension);
        assert!((state.grounded - (l - s)).abs() < 1e-9 * l);
        assert!(state.residual <= 1e-12 * l);
    }
}

#[test]
fn clump_on_seabed_is_carried_by_seabed() {
    let clump = line(&[(300.0, 1000.0, 5e8), (500.0, 1000.0, 5e8)], &[Joint::Weight(4e5)], 200.0);
    // lying: no vertical force at the joint; lifting: part of the clump; lifted: all of it
    let lying = clump.at_horizontal_force(1e4, 0.0).unwrap();
    assert_eq!((lying.joints[0].lift, lying.joints[0].z), (0.0, -200.0));
    let lifting = clump.at_horizontal_force(3.0e5, 0.0).unwrap();
    assert!(
        lifting.joints[0].lift < 0.0 && lifting.joints[0].lift > -4e5 && (lifting.joints[0].z + 200.0).abs() < 1e-6,
        "{lifting:?}"
    );
    let lifted = clump.at_horizontal_force(4e6, 0.0).unwrap();
    assert!(lifted.joints[0].lift == -4e5 && lifted.joints[0].z > -199.0, "{lifted:?}");
}

#[test]
fn invalid_line_or_force_is_refused() {
    let good = Segment { length: 100.0, weight: 10.0, ea: 1e6 };
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        assert!(Line::new(vec![Segment { length: bad, ..good }], vec![], -50.0, 0.0).is_err());
        assert!(Line::new(vec![Segment { ea: bad, ..good }], vec![], -50.0, 0.0).is_err());
        assert!(line(&[(100.0, 10.0, 1e6)], &[], 50.0).at_horizontal_force(bad, 0.0).is_err());
        assert_eq!(table(&line(&[(100.0, 10.0, 1e6)], &[], 50.0), &[bad], 1e3, 0.0).err(), Some(LineError::Breaks));
    }
    assert!(Line::new(vec![], vec![], -50.0, 0.0).is_err());
    assert!(Line::new(vec![good, good], vec![], -50.0, 0.0).is_err());
    let short = line(&[(100.0, 10.0, 1e6), (100.0, 10.0, 1e6)], &[Joint::Free], 50.0);
    assert_eq!(table(&short, &[1e3], 1e3, 0.0).err(), Some(LineError::Breaks));
    assert!(matches!(short.at_horizontal_force(1e3, -60.0), Err(LineError::BelowBottom(_))));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn segment_cut_in_pieces_matches_whole_segment(
        h in 3.0f64..7.0, w in 1.0f64..4.0, depth in 20.0f64..2000.0, over in 1.01f64..6.0, cut in 0.05f64..0.95, ea in 6.0f64..10.0,
    ) {
        let (h, w, ea, length) = (10f64.powf(h), 10f64.powf(w), 10f64.powf(ea), depth * over);
        let whole = line(&[(length, w, ea)], &[], depth).at_horizontal_force(h, 0.0).unwrap();
        let pieces = line(&[(length * cut, w, ea), (length * (1.0 - cut), w, ea)], &[Joint::Free], depth);
        let pieces = pieces.at_horizontal_force(h, 0.0).unwrap();
        prop_assert!((whole.x - pieces.x).abs() <= 1e-9 * length.max(whole.x));
        prop_assert!((whole.top_tension - pieces.top_tension).abs() <= 1e-9 * whole.top_tension);
        prop_assert!((whole.grounded - pieces.grounded).abs() <= 1e-8 * length);
    }

    #[test]
    fn line_carries_its_weight_and_stiffness_matches_finite_difference(
        h in 3.0f64..6.5, w1 in 1.0f64..4.0, w2 in 1.0f64..4.0, depth in 20.0f64..2000.0, over in 1.02f64..4.0, clump in 0.0f64..1e5,
        ea in 7.0f64..10.0,
    ) {
        let (h, w1, w2, ea) = (10f64.powf(h), 10f64.powf(w1), 10f64.powf(w2), 10f64.powf(ea));
        let l = 0.5 * depth * over;
        let line = line(&[(l, w1, ea), (l, w2, ea)], &[Joint::Weight(clump)], depth);
        let state = line.at_horizontal_force(h, 0.0).unwrap();
        let weights = [w1, w2];
        let hanging: f64 = state.segments.iter().zip(weights).map(|(s, w)| w * (l - s.grounded)).sum();
        let carried = hanging - state.joints[0].lift;
        prop_assert!((state.top_vertical - state.anchor_vertical - carried).abs() <= 1e-9 * state.top_tension.max(carried), "{state:?}");
        let d = 1e-6 * h;
        let (up, down) = (line.at_horizontal_force(h + d, 0.0).unwrap(), line.at_horizontal_force(h - d, 0.0).unwrap());
        // the same contact on both sides: the derivative jumps where a joint touches down
        let same = |a: f64, b: f64| (a == 0.0) == (b == 0.0);
        prop_assume!(up.segments.iter().zip(&down.segments).all(|(a, b)| same(a.grounded, b.grounded)));
        prop_assume!(same(up.joints[0].lift + clump, down.joints[0].lift + clump));
        let difference = (up.x - down.x) / (2.0 * d);
        prop_assert!((difference - state.dx_dh).abs() <= 1e-4 * state.dx_dh + 1e-9 * state.x / d, "{difference} {}", state.dx_dh);
    }

    #[test]
    fn line_forces_scale_with_length(h in 3.0f64..6.0, depth in 50.0f64..1000.0, over in 1.02f64..4.0, scale in 0.1f64..10.0) {
        let h = 10f64.powf(h);
        let one = line(&[(depth * over, 500.0, 1e9)], &[], depth).at_horizontal_force(h, 0.0).unwrap();
        // lengths by s, weight per length kept: forces by s
        let other = line(&[(depth * over * scale, 500.0, 1e9 * scale)], &[], depth * scale).at_horizontal_force(h * scale, 0.0).unwrap();
        prop_assert!((other.x - scale * one.x).abs() <= 1e-9 * other.x);
        prop_assert!((other.top_tension - scale * one.top_tension).abs() <= 1e-9 * other.top_tension);
    }
}
