//! Tethers in time: the two examples of [AQWA-TETHER 8] with statistics and fatigue, and a tether of 25 to 200 elements for three hours. In a form
//! that a program can read: name, records, least seconds of a run, tab between; then `real time`, how many times quicker than real time.
//!
//! Seconds are those of the processor, where the system reports them, else those of the clock.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

mod measured;

use std::time::Instant;
use windlass_model::Model;
use windlass_signal::tether::fatigue::{Endurance, FatigueSettings};
use windlass_solve::tethered::{TetherRunSettings, TetherStatistics, Tethered, run};

/// The model that a script has before its run.
fn model_before_run(name: &str) -> Model {
    let path = format!("{}/scripts/{name}.cif", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    measured::model_from_records(text.split("TDOM").next().unwrap())
}

/// A straight steel tube afloat in a sea of 50 components, cut into elements.
fn afloat(elements: usize) -> Model {
    measured::model_from_records(&format!(
        "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1027 -GRAVITY 9.81\n\
         &ENV -DEPTH 345 -SEA JONSWAP 20 4 9 2 -COMPONENTS 50 -STRETCHING EXPONENTIAL -RAMP 0\nMEDIT\n*E -280 0 -0.5\n\
         &DESCRIBE BODY TUG -IGNORE X Y Z RX RY RZ\n*V 0 0 -0.5\n#WEIGHT *V 1000 1 1 1\n\
         ~T TETHER 1.1176 0.038 -LEN 280 -REFINE {elements} -DENSITY 7817 -EMODULUS 2.15E11\n\
         CONNECTOR T ~T *V *E -TOWED -V_MOORING 0.5 0.5 0.5 -A_MOORING 0.5 0.5 0.5\nEND\n"
    ))
}

/// Everything that a listing has of a run.
fn print_result(made: &Tethered) {
    let whole = TetherStatistics::new(made, 24.75, f64::INFINITY);
    let asked = FatigueSettings { duration: 1.0, curve: Endurance::KILONEWTONS.in_unit(1000.0), peak_time: 10_800.0 };
    for tether in &made.tethers {
        whole.type_one(made, tether).unwrap();
        whole.type_two(made, tether).unwrap();
        if tether.towed {
            whole.fatigue(made, tether, asked).unwrap();
        }
    }
}

fn pass(name: &str, model: &Model, settings: TetherRunSettings, statistics: bool) {
    let mut least = f64::INFINITY;
    let begin = Instant::now();
    let mut records;
    loop {
        let (start, clock) = (measured::processor(), Instant::now());
        let made = run(model, settings, &mut |_| true).unwrap();
        if statistics {
            print_result(&made);
        }
        let spent = measured::processor().zip(start).map(|(end, start)| end - start).filter(|s| *s > 0.5);
        least = least.min(spent.unwrap_or(clock.elapsed().as_secs_f64()));
        records = made.times.len();
        if begin.elapsed().as_secs_f64() > 4.0 {
            break;
        }
    }
    println!("{name}\t{records}\t{least:.9}");
    println!("real time\t{:.0}", settings.observed / least);
}

fn main() {
    let settings = |observed, step, store| TetherRunSettings {
        start: 0.0,
        observed,
        step,
        store,
        compatible: true,
        slam: 1.0,
        tow: [0.0; 2],
        transient: 0.0,
        keep: true,
    };
    pass("towed example, statistics and fatigue", &model_before_run("towed_tether"), settings(375.0, 0.25, 2), true);
    pass("installed example", &model_before_run("installed_tether"), settings(25.0, 0.25, 1), true);
    for elements in [25, 50, 100, 200] {
        let name = format!("towed, {elements} elements, three hours");
        pass(&name, &afloat(elements), settings(10_800.0, 0.1, 10), false);
    }
}
