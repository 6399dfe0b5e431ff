//! Whole rods against closed forms and other programs.

use super::super::*;
use nalgebra::Vector3;

fn chain(elements: usize) -> Segment {
    Segment {
        axial_damping: 1e6,
        drag_normal: 1.333,
        drag_tangential: 0.639,
        added_normal: 1.0,
        added_tangential: 0.5,
        ..Segment::line(900.0, elements, 199.0, 8.54e8, 0.18)
    }
}

#[test]
fn follows_moordyn() {
    let n: usize = std::env::var("N").ok().and_then(|s| s.parse().ok()).unwrap_or(100);
    let dt: f64 = std::env::var("DT").ok().and_then(|s| s.parse().ok()).unwrap_or(0.05);
    let rho: f64 = std::env::var("RHO").ok().and_then(|s| s.parse().ok()).unwrap_or(0.2);
    let soft: f64 = std::env::var("SOFT").ok().and_then(|s| s.parse().ok()).unwrap_or(0.002);
    let tol: f64 = std::env::var("TOL").ok().and_then(|s| s.parse().ok()).unwrap_or(1e-6);
    let rod = Rod::new("chain", vec![chain(n)], vec![]).unwrap();
    let fluid = UniformFluid::still(1025.0);
    let bottom = PlaneBottom { height: -300.0, slope: [0.0, 0.0] };
    let ground = Ground { damping: 3e5, soft, ..Ground::elastic(3e6) };
    let world = World { fluid: &fluid, bottom: Some((&bottom, ground)), gravity: 9.80665, forces: &[] };
    let a = Vector3::new(-800.0, 0.0, -300.0);
    let b = Vector3::new(0.0, 0.0, -10.0);
    let mut state = State::along(&rod, &[a, Vector3::new(-350.0, 0.0, -300.0), b]).unwrap();
    let mut solver = Solver::new(&rod, Settings { rho_inf: rho, tolerance: tol, ..Settings::default() });
    let start = std::time::Instant::now();
    let f = solver.statics(&rod, &mut state, &world, [End::pinned(a), End::pinned(b)]).unwrap();
    println!("statics {:?} {} it {:?}", f.force[1], f.iterations, start.elapsed());
    println!("T {} expected 1248715.5; H 757529 V 992693", f.force[1].norm());
    let path = "/work/shared/validation/moordyn_chain900.csv";
    let reference: Vec<(f64, f64)> = std::fs::read_to_string(path)
        .unwrap()
        .lines()
        .skip(2)
        .map(|l| {
            let v: Vec<f64> = l.split(',').map(|x| x.parse().unwrap()).collect();
            (v[0], v[2].hypot(v[3]))
        })
        .collect();
    let (w, tr) = (2.0 * std::f64::consts::PI / 10.0, 20.0);
    let motion = |t: f64| {
        let p = std::f64::consts::PI / tr;
        let (r, rd, rdd) = if t < tr {
            (0.5 * (1.0 - (p * t).cos()), 0.5 * p * (p * t).sin(), 0.5 * p * p * (p * t).cos())
        } else {
            (1.0, 0.0, 0.0)
        };
        let (s, c) = (w * t).sin_cos();
        let x = r * 5.0 * s;
        let v = 5.0 * (rd * s + r * w * c);
        let acc = 5.0 * (rdd * s + 2.0 * rd * w * c - r * w * w * s);
        Motion { position: b + Vector3::x() * x, velocity: Vector3::x() * v, acceleration: Vector3::x() * acc }
    };
    let steps = (120.0 / dt).round() as usize;
    let cpu = || -> f64 {
        let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
        text.split_whitespace().next().unwrap().parse::<f64>().unwrap() * 1e-9
    };
    let start = cpu();
    let mut history = vec![];
    let (mut its, mut parts) = (0, 0);
    for i in 1..=steps {
        let t = i as f64 * dt;
        let f = solver.step(&rod, &mut state, &world, t, [End::pinned(a), End::moved(motion(t))]).unwrap();
        its += f.iterations;
        parts += f.parts;
        history.push((t, f.force[1].norm()));
    }
    let took = cpu() - start;
    let find = |t: f64| {
        let at = t / dt;
        let i = (at.floor() as usize).clamp(1, history.len() - 1);
        let (p, q) = (history[i - 1], history[i]);
        p.1 + (q.1 - p.1) * (t - p.0) / (q.0 - p.0)
    };
    let late: Vec<_> = reference.iter().filter(|r| r.0 >= 20.0).collect();
    let (lo, hi) = late.iter().fold((f64::INFINITY, 0.0f64), |m, r| (m.0.min(r.1), m.1.max(r.1)));
    let errors: Vec<f64> = late.iter().map(|r| (find(r.0) - r.1) / (hi - lo)).collect();
    let most = errors.iter().fold(0.0f64, |m, e| m.max(e.abs()));
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    println!(
        "N {n} dt {dt}: max {:.3} % rms {:.3} % range {:.0}; {:.2} it/step, {} parts of {steps}, {:.0} x real time",
        100.0 * most,
        100.0 * rms,
        hi - lo,
        its as f64 / steps as f64,
        parts,
        120.0 / took
    );
    if let Ok(file) = std::env::var("REF") {
        let own: Vec<(f64, f64)> = std::fs::read_to_string(file)
            .unwrap()
            .lines()
            .map(|l| {
                let v: Vec<f64> = l.split_whitespace().map(|x| x.parse().unwrap()).collect();
                (v[0], v[1])
            })
            .collect();
        let errors: Vec<f64> = own.iter().filter(|r| r.0 >= 20.0).map(|r| (find(r.0) - r.1) / (hi - lo)).collect();
        let most = errors.iter().fold(0.0f64, |m, e| m.max(e.abs()));
        let grid = own.iter().filter(|r| r.0 >= 20.0 && ((r.0 / dt).round() * dt - r.0).abs() < 1e-6);
        let at_steps = grid.map(|r| (find(r.0) - r.1).abs() / (hi - lo)).fold(0.0, f64::max);
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        println!(
            "N {n} dt {dt}: against own: max {:.3} % (at steps {:.3} %) rms {:.3} %",
            100.0 * most,
            100.0 * at_steps,
            100.0 * rms
        );
    }
    if let Ok(file) = std::env::var("OUT") {
        let text: String = history.iter().map(|(t, f)| format!("{t} {f}\n")).collect();
        std::fs::write(file, text).unwrap();
    }
}
