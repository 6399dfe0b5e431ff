//! A rod and its state rebuilt from their numbers go on as the first ones do, to the last bit.

use super::super::*;
use nalgebra::Vector3;

#[test]
fn rod_changed_by_winch_restores_from_snapshot_bit_for_bit() {
    let segment = |elements| RodSegment {
        axial_damping: 1e4,
        drag_normal: 1.2,
        added_normal: 1.0,
        ..RodSegment::line(100.0, elements, 80.0, 1e7, 0.2)
    };
    let buoy = super::buoy(6);
    let rope = ViscoelasticRope { slow: TensionLaw::Linear(1e7), fast: [2e7, 5.0], relaxation: 3.0 };
    let rope = RodSegment { axial: TensionLaw::Viscoelastic(Box::new(rope)), ..segment(6) };
    let mut rod = Rod::new("line", vec![rope, segment(9)], vec![buoy]).unwrap();
    let fluid = UniformFluid::moving(1025.0, Vector3::new(0.2, 0.5, 0.0));
    let bottom = PlaneBottom { height: -80.0, slope: [0.0, 0.0] };
    let ground = SeabedLaw {
        damping: 1e3,
        penetration_scale: 0.05,
        friction_along: 0.3,
        friction_across: 0.6,
        ..SeabedLaw::elastic(1e5)
    };
    let world = LineEnvironment { bottom: Some((&bottom, ground)), ..LineEnvironment::new(&fluid, 9.81) };
    let (a, b) = (Vector3::new(0.0, 0.0, -80.0), Vector3::new(165.0, 0.0, -5.0));
    let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
    let ends = [RodEnd::pin(a), RodEnd::pin(b)];
    RodSolver::new(&rod, RodSettings::default()).statics(&rod, &mut state, &world, ends).unwrap();
    rod.set_length(14, 14.0, 0.4).unwrap();
    rod.divide(14, &mut state).unwrap();
    rod.join(1, &mut state).unwrap();
    let run = |rod: &Rod, state: &mut RodState, steps: usize| {
        let mut solver = RodSolver::new(rod, RodSettings::default());
        (0..steps)
            .map(|_| {
                let time = state.time + 0.1;
                let lift = RodEndMotion { position: b + Vector3::z() * (0.5 * time), ..RodEndMotion::at_rest(b) };
                solver.step(rod, state, &world, time, [ends[0], RodEnd::from_motion(lift)]).unwrap()
            })
            .last()
            .unwrap()
    };
    run(&rod, &mut state, 7);
    let mut numbers = vec![1.5];
    state.pack(&mut numbers);
    assert_eq!(numbers.len() - 1, RodState::packed_len(&rod));
    let again = Rod::with_mesh("line", rod.segments().to_vec(), rod.attachments().to_vec(), &rod.mesh()).unwrap();
    assert_eq!(again, rod);
    let mut later = RodState::unpack(&again, &numbers[1..]).unwrap();
    assert_eq!(later, state);
    assert_eq!(run(&rod, &mut state, 5), run(&again, &mut later, 5));
    assert_eq!(later, state);
}

#[test]
fn twisted_state_is_restored_and_wrong_one_refused() {
    let segment =
        RodSegment { compression: true, bending: 400.0, torsion: 300.0, ..RodSegment::line(10.0, 8, 2.0, 1e6, 0.1) };
    let rod = Rod::new("pipe", vec![segment.clone()], vec![]).unwrap();
    let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::new(7.0, 1.0, 0.0)]).unwrap();
    state.director[3] = Vector3::new(0.3, -0.2, 0.9);
    state.time = 4.25;
    let mut numbers = Vec::new();
    state.pack(&mut numbers);
    assert_eq!(RodState::unpack(&rod, &numbers).unwrap(), state);
    let message = RodState::unpack(&rod, &numbers[1..]).unwrap_err().to_string();
    assert_eq!(message, "pipe: its state is 172 numbers, not 171");
    numbers[5] = f64::NAN;
    assert!(RodState::unpack(&rod, &numbers).unwrap_err().to_string().contains("number 6 of its state is NaN"));
    let made = |mesh: &[(f64, f64, usize)]| Rod::with_mesh("pipe", vec![segment.clone(); 2], vec![], mesh);
    assert!(made(&[(1.0, 0.0, 0), (1.0, 0.0, 1)]).is_ok());
    for mesh in [
        &[][..],
        &[(1.0, 0.0, 2)],
        &[(0.0, 0.0, 0)],
        &[(1.0, f64::NAN, 0)],
        &[(f64::INFINITY, 0.0, 0)],
        &[(1.0, 0.0, 1), (1.0, 0.0, 0)],
    ] {
        assert!(made(mesh).is_err(), "{mesh:?}");
    }
}
