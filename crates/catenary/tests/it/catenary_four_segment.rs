//! The example line that ends [MOSES-FLEX] against independent values (feet, kips; X within 0.1 ft,
//! forces within 0.1 kips: the digits the values were given with).

use windlass_base::units::{METRES_PER_FOOT, NEWTONS_PER_KIP};
use windlass_catenary::{Buoy, DEFAULT_ROWS, Joint, Line, Segment, TableRow, table};

fn area(od: f64) -> f64 {
    std::f64::consts::FRAC_PI_4 * od * od
}

/// The printed line with a spring buoy of this capacity (kips) on a pendant of this length (ft).
fn line(capacity: f64, pendant: f64) -> Line {
    let segment = |od: f64, length: f64, weight: f64, e: f64| Segment {
        length: length * METRES_PER_FOOT,
        weight: weight * NEWTONS_PER_KIP / METRES_PER_FOOT,
        ea: e * area(od) * NEWTONS_PER_KIP,
    };
    let wire = |length: f64| segment(4.625, length, 37.51 / 1000.0, 2900.0);
    let segments = vec![wire(500.0), wire(4000.0), segment(4.375, 2000.0, 158.2 / 1000.0, 4350.0), wire(2000.0)];
    let buoy = Joint::SpringBuoy { capacity: capacity * NEWTONS_PER_KIP, depth: pendant * METRES_PER_FOOT };
    Line::new(segments, vec![buoy, Joint::Free, Joint::Free], -3000.0 * METRES_PER_FOOT, 0.0).unwrap()
}

fn example(capacity: f64, pendant: f64) -> (Vec<TableRow>, [f64; 4]) {
    let breaks = [4.625, 4.625, 4.375, 4.625].map(|od| 60.0 * area(od) * NEWTONS_PER_KIP);
    (table(&line(capacity, pendant), &breaks, breaks[0], 0.0).unwrap().0, breaks)
}

fn close(got: f64, want: f64, within: f64, what: &str) {
    assert!((got - want).abs() <= within, "{what}: {got} is not {want} within {within}");
}

#[test]
fn buoy_of_printed_example_stays_submerged_and_rows_match() {
    let (rows, breaks) = example(100.0, 0.0);
    assert_eq!(rows.len(), DEFAULT_ROWS);
    close(breaks[0] / NEWTONS_PER_KIP, 1008.0, 0.05, "break of the wire");
    close(breaks[2] / NEWTONS_PER_KIP, 902.0, 0.05, "break of segment 3");
    assert!(rows.iter().all(|r| r.state.joints[0].buoy == Some(Buoy::Sunk)));
    for (n, depth) in [(1, 406.0), (15, 300.0), (29, 237.0)] {
        close(-rows[n].state.joints[0].z / METRES_PER_FOOT, depth, 0.5, "depth of the buoy");
    }
    let (one, fifteen, last) = (&rows[1], &rows[15], &rows[29]);
    close(one.state.x / METRES_PER_FOOT, 5681.9, 0.1, "X of row 1");
    close(one.state.top_tension / NEWTONS_PER_KIP, 17.2, 0.1, "top tension of row 1");
    close(one.state.segments[1].top_tension / NEWTONS_PER_KIP, 98.4, 0.1, "segment 2 top of row 1");
    assert!(one.state.segments[0].bottom_vertical < 0.0, "the first segment starts as a hanging U");
    close(fifteen.state.force / NEWTONS_PER_KIP, 269.68, 0.01, "H of row 15");
    close(fifteen.state.x / METRES_PER_FOOT, 7536.6, 0.1, "X of row 15");
    close(fifteen.state.top_tension / NEWTONS_PER_KIP, 341.5, 0.1, "top tension of row 15");
    close(fifteen.state.segments[1].top_tension / NEWTONS_PER_KIP, 396.6, 0.1, "segment 2 top of row 15");
    close(fifteen.state.grounded / METRES_PER_FOOT, 3110.0, 1.0, "grounded length of row 15");
    close(last.state.x / METRES_PER_FOOT, 8021.1, 0.1, "X of row 29");
    close(last.state.top_tension / NEWTONS_PER_KIP, 1142.3, 0.1, "top tension of row 29");
    close(last.state.anchor_vertical / NEWTONS_PER_KIP, 77.1, 0.1, "anchor pull of row 29");
    for (n, row) in rows.iter().enumerate().skip(1) {
        assert_eq!(row.critical, if n <= 22 { 2 } else { 3 }, "critical segment of row {n}");
    }
}

#[test]
fn larger_buoy_on_pendant_is_restrained_and_then_sinks() {
    let (rows, _) = example(200.0, 50.0);
    for (n, row) in rows.iter().enumerate() {
        let want = if n <= 9 { Buoy::Held } else { Buoy::Sunk };
        assert_eq!(row.state.joints[0].buoy, Some(want), "row {n}");
    }
    close(rows[5].state.x / METRES_PER_FOOT, 6615.6, 0.1, "X of row 5");
    close(rows[5].state.joints[0].z / METRES_PER_FOOT, -50.0, 1e-9, "the held joint");
    close(rows[5].state.joints[0].lift / NEWTONS_PER_KIP, 143.4, 0.1, "buoyancy used in row 5");
    close(rows[10].state.x / METRES_PER_FOOT, 7235.2, 0.1, "X of row 10");
    close(-rows[10].state.joints[0].z / METRES_PER_FOOT, 67.9, 0.1, "depth in row 10");
    close(-rows[15].state.joints[0].z / METRES_PER_FOOT, 191.2, 0.1, "depth in row 15");
}

#[test]
fn segment_stiffness_matches_solid_area() {
    let line = line(100.0, 0.0);
    let ea: Vec<f64> = line.segments().iter().map(|s| s.ea / NEWTONS_PER_KIP).collect();
    close(ea[0], 48_720.0, 1.0, "AE of the wire");
    close(ea[2], 65_394.0, 1.0, "AE of segment 3");
}

#[test]
fn stiffness_column_matches_finite_difference_of_distance() {
    let (rows, _) = example(200.0, 50.0);
    let line = line(200.0, 50.0);
    for n in [3, 9, 12, 20, 29] {
        let state = &rows[n].state;
        let d = 1e-5 * state.force;
        let up = line.at_horizontal_force(state.force + d, 0.0).unwrap();
        let down = line.at_horizontal_force(state.force - d, 0.0).unwrap();
        let difference = (up.x - down.x) / (2.0 * d);
        assert!((difference / state.dx_dh - 1.0).abs() < 1e-6, "row {n}: {difference} against {}", state.dx_dh);
    }
}
