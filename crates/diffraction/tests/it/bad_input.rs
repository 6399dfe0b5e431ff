use nalgebra::{Complex, Vector3};
use windlass_diffraction::{DiffractionBody, DiffractionError, DiffractionProblem, HullMesh, MirrorPlanes, Water};

const WATER: Water = Water { density: 1000.0, gravity: 9.81, depth: None };

/// The bottom of a box, 2 m deep.
fn bottom() -> [Vector3<f64>; 4] {
    // seen from the water below, counter-clockwise
    [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]].map(|[x, y]| Vector3::new(x, y, -2.0))
}

/// Bottom and sides of a box of 1 x 1 m, 2 m deep, about (x + 0.5, 0.5).
fn box_at(x: f64) -> Vec<[Vector3<f64>; 4]> {
    let [a, b, c, d] = bottom();
    let up = |corner: Vector3<f64>| Vector3::new(corner.x, corner.y, 0.0);
    let side = |p: Vector3<f64>, q: Vector3<f64>| [q, p, up(p), up(q)];
    let quads = [[a, b, c, d], side(a, b), side(b, c), side(c, d), side(d, a)];
    quads.map(|quad| quad.map(|corner| corner + Vector3::new(x, 0.0, 0.0))).to_vec()
}

fn body(quads: &[[Vector3<f64>; 4]]) -> DiffractionBody {
    DiffractionBody { mesh: HullMesh::new(quads, MirrorPlanes::default()).unwrap(), origin: Vector3::zeros() }
}

fn problem(water: Water) -> Result<DiffractionProblem, DiffractionError> {
    let mesh = HullMesh::new(&box_at(0.0), MirrorPlanes::default())?;
    DiffractionProblem::new(&[DiffractionBody { mesh, origin: Vector3::zeros() }], water)
}

#[test]
fn wrong_panels_are_refused_with_their_number() {
    let mesh = |quads: &[[Vector3<f64>; 4]], mirrors| HullMesh::new(quads, mirrors).unwrap_err();
    let none = MirrorPlanes::default();
    assert_eq!(mesh(&[], none), DiffractionError::NoPanels);
    assert_eq!(mesh(&[bottom(), [bottom()[0]; 4]], none), DiffractionError::FlatPanel(2));
    let not_finite = bottom().map(|corner| corner * f64::NAN);
    assert_eq!(mesh(&[not_finite], none), DiffractionError::NotFinite(1));
    let raised = bottom().map(|corner| corner + Vector3::new(0.0, 0.0, 2.5));
    assert_eq!(mesh(&[bottom(), raised], none), DiffractionError::AboveWater { panel: 2, height: 0.5 });
    let beyond = bottom().map(|corner| corner - Vector3::new(0.5, 0.0, 0.0));
    assert_eq!(mesh(&[beyond], MirrorPlanes { x: true, y: false }), DiffractionError::BeyondMirror(1));
}

#[test]
fn wrong_water_and_frequencies_are_refused() {
    let water = |water: Water| problem(water).err();
    assert_eq!(water(Water { density: 0.0, ..WATER }), Some(DiffractionError::Water));
    assert_eq!(water(Water { gravity: f64::NAN, ..WATER }), Some(DiffractionError::Water));
    let shallow = DiffractionError::Depth { depth: 1.5, draught: 2.0 };
    assert_eq!(water(Water { depth: Some(1.5), ..WATER }), Some(shallow));
    let problem = problem(WATER).unwrap();
    assert_eq!(problem.solve(0.0, &[0.0]).unwrap_err(), DiffractionError::Frequency(0.0));
    assert!(matches!(problem.solve(f64::INFINITY, &[0.0]), Err(DiffractionError::Frequency(_))));
}

#[test]
fn points_outside_of_water_have_no_potential() {
    let waves = problem(Water { depth: Some(10.0), ..WATER }).unwrap().solve_waves(2.0, &[0.0]).unwrap();
    let motions = vec![vec![Complex::default(); 6]];
    let has_potential = |at: Vector3<f64>| waves.potentials(&motions, &[at]).is_some();
    assert!(has_potential(Vector3::new(4.0, 0.0, -1.0)));
    for z in [0.1, -11.0, f64::NAN] {
        assert!(!has_potential(Vector3::new(4.0, 0.0, z)), "{z}");
    }
    // beyond all tables the propagating wave is left
    assert!(has_potential(Vector3::new(1e6, 0.0, -1.0)));
    assert!(waves.potentials(&[], &[Vector3::zeros()]).is_none());
}

#[test]
fn open_and_inverted_meshes_are_refused() {
    let made = |quads: &[[Vector3<f64>; 4]]| DiffractionProblem::new(&[body(quads)], WATER).err();
    let whole = box_at(0.0);
    assert_eq!(made(&whole), None);
    assert!(matches!(made(&whole[1..]), Some(DiffractionError::OpenMesh { body: 1, .. })));
    assert!(matches!(made(&whole[..4]), Some(DiffractionError::OpenMesh { .. })));
    let turned: Vec<_> = whole.iter().map(|[a, b, c, d]| [*d, *c, *b, *a]).collect();
    assert_eq!(made(&turned), Some(DiffractionError::InsideOut(1)));
    let mut one_turned = whole.clone();
    one_turned[2].reverse();
    assert!(matches!(made(&one_turned), Some(DiffractionError::OpenMesh { .. })));
}

#[test]
fn bodies_of_other_mirror_planes_or_beside_them_are_refused() {
    let half = |x: f64, origin: f64| {
        let quads: Vec<_> = box_at(x).iter().map(|quad| quad.map(|corner| corner)).collect();
        let mesh = HullMesh::new(&quads, MirrorPlanes { x: false, y: true });
        DiffractionBody { mesh: mesh.unwrap(), origin: Vector3::new(0.0, origin, 0.0) }
    };
    let made = |bodies: &[DiffractionBody]| DiffractionProblem::new(bodies, WATER).err();
    assert_eq!(made(&[half(0.0, 0.0), body(&box_at(3.0))]), Some(DiffractionError::OtherMirrors(2)));
    assert_eq!(made(&[half(0.0, 0.0), half(3.0, 0.1)]), Some(DiffractionError::OriginOffMirror(2)));
}

#[test]
fn bodies_that_overlap_or_touch_are_refused() {
    let made = |x: f64| DiffractionProblem::new(&[body(&box_at(0.0)), body(&box_at(x))], WATER).err();
    assert_eq!(made(1.2), None);
    for x in [1.0, 0.9, 0.0] {
        assert!(matches!(made(x), Some(DiffractionError::Overlap { .. })), "{x}");
    }
}
