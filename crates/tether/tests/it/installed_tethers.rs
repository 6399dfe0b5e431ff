//! Installed tethers against closed forms and against each other; what is refused.

use crate::installed_example as example;

use nalgebra::{Matrix6, Vector3};
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::BodyStep;
use windlass_hydro::current::CurrentField;
use windlass_hydro::sea::{Component, Sea, Water};
use windlass_model::{ClassError, Stretching};
use windlass_tether::TetherLine;
use windlass_tether::compatibility::Compatibility;
use windlass_tether::installed::description::InstalledDescription;
use windlass_tether::installed::{
    DefaultTaken, EndSprings, Installation, InstalledHistory, InstalledRunSettings, InstalledTether, InternalFluid,
    Keep, NodeConstraint, RigChange,
};
use windlass_tether::structure::flow::{FlowAt, FlowWaves, WaterFlow};
use windlass_tether::structure::wave::DeepWave;
use windlass_tether::structure::{Structure, StructureForces};

const NATIVE: Compatibility = Compatibility::native();

/// A structure that nothing moves, or that goes where its velocity takes it.
#[derive(Debug)]
struct Unmoved;

impl Structure for Unmoved {
    fn forces(&mut self, _: &BodyStep, _: &FlowAt, _: bool, out: &mut StructureForces) -> Result<(), ClassError> {
        *out =
            StructureForces { mooring: out.mooring, inertia: Matrix6::identity() * 1e30, ..StructureForces::default() };
        Ok(())
    }
}

/// An upright tether of the example's tube in `elements`, 100 m below water to 50 m under it, pinned at both ends, its structure's centre of
/// gravity at the attachment.
fn upright(elements: usize, stretch: f64) -> (InstalledTether, Vector3<f64>) {
    let mut element = example::tethers()[0].line.elements()[0];
    element.length = 200.0 / elements as f64;
    let line = TetherLine::with_numbered_nodes(vec![element; elements]).unwrap();
    let anchor = Vector3::new(3.0, -2.0, -250.0);
    let springs = EndSprings { rotation: [0.0; 2], ..EndSprings::default() };
    let tether = InstalledTether {
        anchor_springs: springs,
        vessel_springs: springs,
        ..InstalledTether::new("T", line, anchor, Vector3::zeros())
    };
    (tether, anchor + Vector3::z() * (200.0 + stretch))
}

fn still_water() -> WaterFlow {
    WaterFlow::still_water(1025.0, 9.81).unwrap()
}

/// A run of an unmoved structure.
fn hold(
    tether: InstalledTether,
    at: Vector3<f64>,
    flow: &WaterFlow,
    [step, time]: [f64; 2],
    velocity: Vector3<f64>,
) -> InstalledHistory {
    let mut history = InstalledHistory::new(1, Keep::Always);
    let velocity = Six::new(velocity.x, velocity.y, velocity.z, 0.0, 0.0, 0.0);
    let states = (time / step) as usize + 1;
    let course = InstalledRunSettings { start: 0.0, step, states, pose: Pose::from_position(at.into()), velocity };
    let mut structure = Unmoved;
    Installation::new(&mut structure, vec![tether], flow, NATIVE).unwrap().run(&course, &mut history).unwrap();
    history
}

fn last(series: &[f64]) -> f64 {
    *series.last().unwrap()
}

#[test]
fn tension_includes_stretch_pressure_weight_contents_and_caps() {
    let (mut tether, at) = upright(4, 0.05);
    tether.fluid = InternalFluid { pressure: 2e6, density: 850.0 };
    tether.caps = [0.3, 0.4];
    let tube = tether.line.elements()[0].tube();
    let (area, outer, inner) = (tube.area(), tube.external_area(), tube.internal_area());
    let history = hold(tether.clone(), at, &still_water(), [0.1, 0.1], Vector3::zeros());
    // depths of the ends 250 m and 49.95 m; wall strain EA 0.05/200, in the middle
    let (deep, high) = (250.0, 49.95);
    let (out, inside) = (|h: f64| 1025.0 * 9.81 * h, |h: f64| 2e6 + 850.0 * 9.81 * h);
    let weight = (7816.94 * area + 850.0 * inner - 1025.0 * outer) * 9.81 * 200.0;
    let middle = 0.5 * (deep + high);
    let effective = 2.15e11 * area * 0.05 / 200.0 + out(middle) * outer - inside(middle) * inner;
    let near = |got: f64, want: f64| assert!((got / want - 1.0).abs() < 1e-6, "{got} {want}");
    near(history.end(0, 3, true, 0)[0], effective + 0.5 * weight);
    near(history.end(0, 0, false, 0)[0], effective - 0.5 * weight);
    near(history.end(0, 3, true, 1)[0], effective + 0.5 * weight - out(high) * outer + inside(high) * inner);
    near(history.force(7, 2)[0], -(effective + 0.5 * weight - out(high) * 0.4));
    let description = InstalledDescription::new(&tether, at, &still_water()).unwrap();
    near(description.tension, effective);
    // the free hanging reaction balances steel, contents, displaced water and the caps
    near(description.hanging, weight + out(deep) * 0.3 - out(250.0 - 200.0) * 0.4);
}

#[test]
fn tether_in_current_bows_like_a_stretched_string() {
    let (tether, at) = upright(10, 0.2);
    let flow = WaterFlow { current: CurrentField::uniform(1.0, std::f64::consts::PI), ..still_water() };
    let history = hold(tether, at, &flow, [0.25, 200.0], Vector3::zeros());
    // ends pinned: w = (q/T) (s (L - s)/2 - (1 - cosh ...)/k^2) with k^2 = T/EI; q on the tension with the bow's own stretch
    let load = 0.5 * 1025.0 * 0.75 * 1.1176;
    let pull = last(&history.end(0, 4, true, 0));
    let ei: f64 = 2.15e11 * 0.018_800_5;
    let (length, k) = (200.2, (pull / ei).sqrt());
    let want = load / pull * (length * length / 8.0 - (1.0 - 1.0 / (k * length / 2.0).cosh()) / (k * k));
    let got = last(&history.node(0, 5, 0));
    // the tension varies by 0.01 % from the middle, the section is rounded to 2e-6; the current damps what swung
    assert!((got / want - 1.0).abs() < 2e-4, "{got} {want}");
    assert!(last(&history.node(0, 5, 4)).abs() < 1e-6 && last(&history.node(0, 5, 1)).abs() < 1e-12);
    // half of the load is the structure's, along X
    let push = last(&history.force(7, 0));
    assert!((push / (load * length / 2.0) - 1.0).abs() < 2e-3, "{push}");
}

#[test]
fn structure_constraint_reacts_and_gap_allows_motion() {
    let (mut tether, at) = upright(10, 0.2);
    let flow = WaterFlow { current: CurrentField::uniform(1.0, std::f64::consts::PI), ..still_water() };
    let load = 0.5 * 1025.0 * 0.75 * 1.1176 * 200.2;
    tether.constraints = vec![NodeConstraint::VesselLateral { node: 5, gap: 0.0 }];
    let held = hold(tether.clone(), at, &flow, [0.25, 200.0], Vector3::zeros());
    assert!(last(&held.node(0, 5, 0)).abs() < 1e-12);
    // two spans: a middle support bears 5/8 of a stiff beam's load and 1/2 of a string's, an end 3/16 and 1/4
    let push = last(&held.force(7, 0));
    assert!(push > 0.75 * load - 1.0 && push < 0.8125 * load, "{push} {load}");

    tether.constraints = vec![NodeConstraint::VesselLateral { node: 5, gap: 0.04 }];
    let gap = hold(tether.clone(), at, &flow, [0.25, 200.0], Vector3::zeros());
    let off = last(&gap.node(0, 5, 0));
    let free = last(
        &hold(
            InstalledTether { constraints: Vec::new(), ..tether.clone() },
            at,
            &flow,
            [0.25, 200.0],
            Vector3::zeros(),
        )
        .node(0, 5, 0),
    );
    // the edge is ten times the node's mass over the square of the step: 75 kN on 6.7e6 N/m at most
    assert!(free > 0.06 && off > 0.04 && off < 0.052, "{free} {off}");

    tether.constraints = vec![NodeConstraint::FixedLateral { node: 5 }, NodeConstraint::VesselRotation { node: 10 }];
    let fixed = hold(tether, at, &flow, [0.25, 100.0], Vector3::zeros());
    assert!(last(&fixed.node(0, 5, 0)).abs() < 1e-12 && last(&fixed.node(0, 10, 3)).abs() < 1e-12);
    // a fixed support's share is not the structure's
    assert!(last(&fixed.force(7, 0)) < 0.35 * load);
}

#[test]
fn tether_group_force_is_scaled_by_its_factor() {
    let (tether, at) = upright(3, 0.1);
    let one = hold(tether.clone(), at, &still_water(), [0.1, 0.1], Vector3::zeros());
    let four = hold(InstalledTether { group: 4.0, ..tether }, at, &still_water(), [0.1, 0.1], Vector3::zeros());
    assert!((four.force(7, 2)[0] / one.force(7, 2)[0] - 4.0).abs() < 1e-14);
}

#[test]
fn lowered_tether_impacts_its_stop_and_never_hangs_at_anchor() {
    let (tether, at) = upright(3, 0.0);
    // down at 0.1 m/s; in the middle under water it shortens by p A L/EA = 0.0106 m before it is slack
    let down = |stop: Option<f64>| {
        let tether = InstalledTether { lower_stop: stop, ..tether.clone() };
        hold(tether, at, &still_water(), [0.05, 10.0], Vector3::new(0.0, 0.0, -0.1))
    };
    let tube = tether.line.elements()[0].tube();
    let ea = 2.15e11 * tube.area();
    let free = down(None);
    let [event] = free.events() else { panic!("{:?}", free.events()) };
    let depth = 150.0;
    let short = 1025.0 * 9.81 * depth * tube.external_area() * 200.0 / ea;
    // the weight in water, 3.8 kN, shares in it by 3 %; states are 5 mm apart
    assert!(event.change == RigChange::Slack && (event.time * 0.1 - short).abs() < 5.5e-3, "{event:?} {short}");
    // then it pulls with its weight in water
    let weight = (7816.94 * tube.area() - 1025.0 * tube.external_area()) * 9.81 * 200.0;
    assert!((last(&free.force(7, 2)) / -weight - 1.0).abs() < 1e-9);

    let stopped = down(Some(0.5));
    let hit = stopped.events().iter().find(|e| matches!(e.change, RigChange::LowerStop { .. })).unwrap();
    assert!((hit.time - event.time - 5.0).abs() < 0.15, "{hit:?}");
    // 1 m down, half a metre of it on the stop less what it was short
    let pushed = last(&stopped.force(7, 2)) / (ea / 200.0);
    assert!((pushed - (0.5 - short)).abs() < 1e-3, "{pushed}");

    let never = down(Some(0.0));
    assert!(never.events().is_empty() && last(&never.end(0, 1, true, 0)) < -0.9 * ea / 200.0);
}

#[test]
fn slack_only_output_keeps_slack_instants() {
    let (flow, mut platform) = (example::water(), example::platform(Compatibility::aqwa_5_4()));
    let mut history = InstalledHistory::new(10, Keep::WhenSlack(0.001));
    let mut all = Installation::new(&mut platform, example::tethers(), &flow, Compatibility::aqwa_5_4()).unwrap();
    all.run(&example::course(), &mut history).unwrap();
    assert_eq!((history.tether_times(0), history.tether_times(2)), (&[6.5][..], &[][..]));
    assert_eq!((history.node(0, 0, 0).len(), history.events().len(), history.times().len()), (1, 4, 11));
}

/// A run of the example in a water.
fn example_in(flow: &WaterFlow, states: usize) -> InstalledHistory {
    example_by(flow, 0.25, states)
}

/// The same by a step.
fn example_by(flow: &WaterFlow, step: f64, states: usize) -> InstalledHistory {
    let mut platform = example::platform(NATIVE);
    let mut history = InstalledHistory::new(1, Keep::Always);
    let pose = Pose::from_position([0.0, 0.0, -17.4]);
    let course = InstalledRunSettings { pose, step, states, ..example::course() };
    // anchors so deep that it rests upright at this height: 140,489 kN over sixteen (tests/it/floating/aqwa_tether_platform.rs), of which 1,981 kN are of
    // the pressure on the middle of the tether
    let stretch = (140_489e3 / 16.0 - 1_981e3) / 1.044_058e8;
    let mut tethers = example::tethers();
    tethers.iter_mut().for_each(|t| t.anchor.z = -17.4 + t.attachment.z - 265.4055 - stretch);
    Installation::new(&mut platform, tethers, flow, NATIVE).unwrap().run(&course, &mut history).unwrap();
    history
}

#[test]
fn sea_of_one_component_matches_airy_regular_wave() {
    let mut wave = DeepWave::new(2.0, 12.0, 0.7, 9.81).unwrap();
    wave.second = false;
    let component =
        Component { frequency: wave.frequency, number: wave.number, amplitude: 2.0, toward: wave.toward, phase: 0.0 };
    let water = Water { depth: None, level: 0.0, gravity: 9.81, density: 1025.0 };
    let sea = Sea::airy(vec![component], water, 0.0, Stretching::Exponential);
    let regular = example_in(&still_water().with_waves(FlowWaves::Deep(wave)), 200);
    let irregular = example_in(&still_water().with_waves(FlowWaves::Sea(Arc::new(sea))), 200);
    for direction in 0..6 {
        for (a, b) in regular.motion(0, direction).iter().zip(irregular.motion(0, direction)) {
            // rounding of 200 steps
            assert!((a - b).abs() < 1e-9, "{direction} {a} {b}");
        }
    }
    assert!(regular.motion(0, 1).iter().any(|y| y.abs() > 0.1));
}

#[test]
fn irregular_sea_is_reproducible_with_tensions_about_pretension() {
    let component = |i: u32| {
        let frequency = 0.3 + 0.02 * f64::from(i);
        Component {
            frequency,
            number: frequency * frequency / 9.81,
            amplitude: 0.3,
            toward: [1.0, 0.0],
            phase: f64::from(i * i),
        }
    };
    let water = Water { depth: None, level: 0.0, gravity: 9.81, density: 1025.0 };
    let sea = Arc::new(Sea::airy((0..40).map(component).collect(), water, 20.0, Stretching::Exponential));
    let flow = still_water().with_waves(FlowWaves::Sea(sea));
    let (one, other) = (example_in(&flow, 1200), example_in(&flow, 1200));
    assert_eq!(one.motion(0, 4), other.motion(0, 4));
    let tension = one.end(0, 1, true, 0);
    let mean = tension.iter().sum::<f64>() / tension.len() as f64;
    // the waves' own mean is small, and 300 s leave some of the slow surge
    assert!((mean / (140_489e3 / 16.0) - 1.0).abs() < 0.02, "{mean}");
    assert!(one.events().is_empty());
}

#[test]
fn halving_step_shows_second_order() {
    let wave = DeepWave::new(1.0, 12.0, 0.0, 9.81).unwrap();
    let flow = still_water().with_waves(FlowWaves::Deep(wave));
    let surge = |step: f64| last(&example_by(&flow, step, (20.0 / step).round() as usize + 1).motion(0, 0));
    let [a, b, c] = [0.2, 0.1, 0.05].map(surge);
    let ratio = (a - b) / (b - c);
    assert!((b - c).abs() < 1e-3 && ratio.abs() > 3.0, "{a} {b} {c} {ratio}");
}

#[test]
fn missing_springs_get_defaults_and_a_note() {
    use DefaultTaken::{Inline, Missing, Rotation};
    let rigid = 1e18;
    assert_eq!(EndSprings::from_card(None), (EndSprings::default(), vec![Missing]));
    let (springs, said) = EndSprings::from_card(Some([0.0, 5.0, -1.0]));
    assert_eq!((springs, said), (EndSprings { inline: rigid, rotation: [5.0, 0.0] }, vec![Inline, Rotation(1)]));
    let (springs, said) = EndSprings::from_card(Some([-3.0, 0.0, 0.0]));
    assert_eq!((springs, said), (EndSprings { inline: rigid, rotation: [0.0; 2] }, vec![Inline]));
    assert_eq!(EndSprings::from_card(Some([7.0, 1.0, 2.0])).1, []);
}

#[test]
fn rigid_coils_hold_ends_and_soft_inline_springs_are_in_series() {
    let (mut tether, at) = upright(6, 0.1);
    let stiffness = InstalledDescription::new(&tether, at, &still_water()).unwrap().stiffness;
    tether.anchor_springs = EndSprings { inline: stiffness, ..EndSprings::default() };
    tether.vessel_springs = EndSprings { inline: stiffness, ..EndSprings::default() };
    let soft = InstalledDescription::new(&tether, at, &still_water()).unwrap().stiffness;
    assert!((soft / stiffness - 1.0 / 3.0).abs() < 1e-6);
    let flow = WaterFlow { current: CurrentField::uniform(1.0, 0.0), ..still_water() };
    let history = hold(tether, at, &flow, [0.1, 20.0], Vector3::zeros());
    for node in [0, 6] {
        assert!(history.node(0, node, 3).iter().all(|slope| slope.abs() < 1e-12));
    }
    assert!(last(&history.node(0, 3, 0)) < -0.01);
}

#[test]
fn invalid_installed_tether_is_refused_with_reason() {
    let (tether, at) = upright(3, 0.1);
    let run = |tether: InstalledTether, course: InstalledRunSettings| {
        let (flow, mut structure) = (still_water(), example::platform(NATIVE));
        let mut history = InstalledHistory::new(1, Keep::Always);
        let made = Installation::new(&mut structure, vec![tether], &flow, NATIVE);
        made.and_then(|mut i| i.run(&course, &mut history)).unwrap_err().to_string()
    };
    let course = InstalledRunSettings { pose: Pose::from_position(at.into()), states: 3, ..example::course() };
    let far = InstalledRunSettings { pose: Pose::from_position((at + Vector3::z() * 30.0).into()), ..course };
    assert!(run(tether.clone(), far).contains("is 200 m long, shorter than its span of 230.1 m"));
    let said = run(InstalledTether { group: 16.0, ..tether.clone() }, InstalledRunSettings { step: 5.0, ..course });
    assert!(said.contains("a step of 5 s is too long") && said.contains("at most is stable"), "{said}");
    assert!(run(tether.clone(), InstalledRunSettings { step: 0.0, ..course }).contains("step"));
    assert!(run(tether.clone(), InstalledRunSettings { states: 0, ..course }).contains("steps"));
    assert!(run(tether.clone(), InstalledRunSettings { velocity: Six::repeat(f64::NAN), ..course }).contains("finite"));
    let held = |c: NodeConstraint| run(InstalledTether { constraints: vec![c], ..tether.clone() }, course);
    assert!(held(NodeConstraint::FixedLateral { node: 0 }).contains("held already"));
    assert!(held(NodeConstraint::FixedRotation { node: 4 }).contains("node 5, and the last is 4"));
    assert!(held(NodeConstraint::VesselLateral { node: 1, gap: -1.0 }).contains("gap"));
    let many = vec![NodeConstraint::FixedRotation { node: 1 }; 6];
    assert!(run(InstalledTether { constraints: many, ..tether.clone() }, course).contains("up to five"));
    assert!(run(InstalledTether { lower_stop: Some(f64::NAN), ..tether.clone() }, course).contains("lower stop"));
    let upside = Vector3::new(tether.anchor.x, tether.anchor.y, -449.0);
    assert!(
        run(tether, InstalledRunSettings { pose: Pose::from_position(upside.into()), ..course })
            .contains("straight below")
    );
}
