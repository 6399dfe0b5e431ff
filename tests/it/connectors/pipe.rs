//! A pipe on five rollers: the balance of what it exerts on them, its stiffness, its shape against the field's theory.

use crate::common::run::model;

use windlass_base::pose::{Pose, Six};
use windlass_model::{ConnectorElement, ConnectorResponse, End, Model, PIPE, RunRequirement, Situation, SolverCache};

/// A stinger 150 m in radius; the pipe weighs 300 N/m in water and in air.
fn stinger(tension: f64) -> Model {
    model(&format!(
        "&ENV -DEPTH 50\nMEDIT\n*R1 35.65 0 1.70\n*R2 26.82 0 3.58\n*R3 17.97 0 4.92\n*R4 9 0 5.73\n*R5 0 0 6\n\
         ~ROLL ROLLER COMPRESSION Z 2E7\n~PIPE ROD 323.9 15.9 -LEN 12 -WTPLEN 300 -BUOY 0\nCONNECTOR R1 ~ROLL *R1\nCONNECTOR R2 ~ROLL *R2\n\
         CONNECTOR R3 ~ROLL *R3\nCONNECTOR R4 ~ROLL *R4\nCONNECTOR R5 ~ROLL *R5\n\
         PIPE ~PIPE R1 R2 R3 R4 R5 -PIPE_TENSION {tension} {tension}\nEND"
    ))
}

fn pipe(model: &Model) -> (Box<dyn ConnectorElement>, Vec<End>) {
    let laid = model.pipe(model.assemblies.get(PIPE).unwrap(), None, RunRequirement::default()).unwrap().unwrap();
    let (supports, element) = (laid.supports, laid.element);
    let ends = supports.iter().map(|c| End::at_rest(model.end_pose(c, 0).unwrap())).collect();
    (element, ends)
}

fn answer(model: &Model, element: &dyn ConnectorElement, ends: &[End]) -> ConnectorResponse {
    let surroundings = model.surroundings();
    let at = Situation { ends, step: None, surroundings: &surroundings };
    let mut out = ConnectorResponse::default();
    let mut state = vec![0.0; element.states()];
    element.evaluate(&at, &state.clone(), &mut state, &mut SolverCache::new(), &mut out).unwrap();
    out
}

#[test]
fn pipe_on_rollers_rolls_and_seabed_lacks_weight_by_its_height() {
    let (w, tension) = (300.0_f64, 4e5);
    let model = stinger(tension);
    let (element, ends) = pipe(&model);
    let out = answer(&model, element.as_ref(), &ends);
    let sum = out.wrench.iter().fold(Six::zeros(), |sum, w| sum + w);
    // no roller pulls the pipe down, and the tip of the stinger is pressed
    for (i, wrench) in out.wrench.iter().enumerate() {
        assert!(wrench[2] <= 0.0, "{i} {wrench}");
    }
    assert!(out.wrench[0][2] < -1e3 && out.wrench[1][2] < -1e3, "{}", out.wrench[0]);
    // a pipe that rolls goes along itself without work: what the tensioner pulls along it is the tension on the bottom and the weight
    // times the height, whatever lies between
    let surroundings = model.surroundings();
    let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
    let state = vec![0.0; element.states()];
    let mut nodes = Vec::new();
    element.as_nodal().unwrap().find_nodes(&at, &state, &mut nodes).unwrap();
    let leaves = (nodes[1].position - nodes[0].position).normalize();
    let bottom = tension * leaves.x - w * (nodes[0].position.z + 50.0);
    assert!((sum[0] / bottom - 1.0).abs() < 2e-4, "{} {bottom} {leaves}", sum[0]);
    // between bottom and last roller it is a catenary but for the boundary layers: its arc by H and the height, and over the stinger
    // its own length, some 36.4. The touchdown moves by sqrt(EI/H), 9.8 m, toward the vessel [PEDERSEN-1975]; so much less pipe hangs,
    // and half of it at the top
    let (a, height): (f64, f64) = (bottom / w, 51.7);
    let arc = (height * height + 2.0 * height * a).sqrt();
    let along: f64 =
        [(8.83_f64, 1.88_f64), (8.85, 1.34), (8.97, 0.81), (9.0, 0.27)].iter().map(|(x, z)| x.hypot(*z)).sum();
    let layer = w * (3.66e7_f64 / bottom).sqrt();
    assert!((-sum[2] - w * (arc + along)).abs() < 2.0 * layer, "{} {} {layer}", -sum[2], w * (arc + along));
    // and the tensioner holds what it was given
    let summary = element.summary(&at, &state).unwrap();
    assert!((summary.tension.unwrap() / tension - 1.0).abs() < 1e-3, "{summary:?}");
}

#[test]
fn pipe_stiffness_matches_roller_force_finite_differences() {
    let model = stinger(5e5);
    let (element, ends) = pipe(&model);
    let out = answer(&model, element.as_ref(), &ends);
    let size = out.stiffness.iter().map(|k| k.amax()).fold(0.0, f64::max);
    for (end, dof) in (0..ends.len()).flat_map(|e| (0..6).map(move |f| (e, f))) {
        let step = 1e-4;
        let moved = |sign: f64| {
            let mut motion = Six::zeros();
            motion[dof] = sign * step;
            let mut ends = ends.clone();
            let pose: Pose = ends[end].pose.after_motion(&motion);
            ends[end] = End::at_rest(pose);
            answer(&model, element.as_ref(), &ends).wrench
        };
        let (plus, minus) = (moved(1.0), moved(-1.0));
        for row in 0..ends.len() {
            let slope = -(plus[row] - minus[row]) / (2.0 * step);
            let own = out.stiffness[ends.len() * row + end].column(dof).into_owned();
            // the pipe is solved to some 1e-9 m, against a step of 1e-5
            assert!((slope - own).amax() < 1e-3 * size, "{row} {end} {dof}: {slope} {own}");
        }
    }
}

#[test]
fn davit_points_toward_its_loading_pipe() {
    let model = model(
        "&ENV -DEPTH 50\nMEDIT\n*D1 40 0 12\n*D2 20 0 20\n*D3 0 0 24\n~DAV DAVIT 60 -LEN 10\n~PIPE ROD 323.9 15.9 -LEN 12\nCONNECTOR D1 ~DAV *D1\n\
         CONNECTOR D2 ~DAV *D2\nCONNECTOR D3 ~DAV *D3\nPIPE ~PIPE D1 D2 D3 -PIPE_TENSION 1E5\nEND",
    );
    let (element, ends) = pipe(&model);
    let out = answer(&model, element.as_ref(), &ends);
    let sum = out.wrench.iter().fold(Six::zeros(), |sum, w| sum + w);
    // the pull of the bottom along, toward +X, and weight downward
    assert!(sum[0] > 0.0 && sum[2] < 0.0, "{sum}");
    // nothing but the davits holds it: they bear the tension of what lies, and lean by the ratio of that to the weight
    let surroundings = model.surroundings();
    let (state, mut nodes) = (vec![0.0; element.states()], Vec::new());
    let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
    element.as_nodal().unwrap().find_nodes(&at, &state, &mut nodes).unwrap();
    let lies = nodes.last().unwrap().effective;
    assert!((sum[0] / lies - 1.0).abs() < 1e-3, "{sum} {lies}");
    assert!(sum[0] < 1e5 && nodes[0].effective.abs() < 1.0, "{sum} {}", nodes[0].effective);
}

#[test]
fn rotated_rollers_carry_pipe_across_their_body() {
    let laid = |heading: f64, turned: &str| {
        let at = [(35.65, 1.70), (26.82, 3.58), (17.97, 4.92), (9.0, 5.73), (0.0, 6.0)];
        let (sin, cos) = heading.to_radians().sin_cos();
        let points: String = (1..).zip(at).map(|(i, (r, z))| format!("*R{i} {} {} {z}\n", r * cos, -r * sin)).collect();
        let supports: String = (1..=5).map(|i| format!("CONNECTOR R{i} {turned} ~ROLL *R{i}\n")).collect();
        model(&format!(
            "&ENV -DEPTH 50\nMEDIT\n&DESCRIBE BODY BARGE\n{points}#WEIGHT *R1 1E6 1 1 1\n&INSTATE -LOCATE BARGE 0 0 0 0 0 {heading}\n\
             ~ROLL ROLLER COMPRESSION Z 2E7\n~PIPE ROD 323.9 15.9 -LEN 12 -WTPLEN 300 -BUOY 0\n{supports}\
             PIPE ~PIPE R1 R2 R3 R4 R5 -PIPE_TENSION 4E5 5E5\nEND"
        ))
    };
    let forces = |model: &Model| {
        let (element, ends) = pipe(model);
        answer(model, element.as_ref(), &ends).wrench
    };
    let along = forces(&laid(0.0, ""));
    let across = forces(&laid(90.0, "-EULER 0 0 -90"));
    for (a, b) in along.iter().zip(&across) {
        // of 4.5e5 N, to what statics leave
        assert!((a - b).fixed_rows::<3>(0).norm() < 1.0, "{a} {b}");
    }
}
