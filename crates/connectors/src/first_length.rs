//! The length of a first segment that gives a tension. Where more line only lies down on the bottom, more line means less
//! tension; where it hangs, the tension falls, has a least value, and rises with the weight. The tighter of the two
//! lengths is the one that is meant.

use windlass_base::units::Dim;
use windlass_catenary::{Aim, Line, LineError};
use windlass_model::ClassError;

/// Most steps of each search.
const MOST: usize = 200;

/// The shortest length (m) with which the fairlead, `x` beside the anchor and at elevation `z`, bears the tension.
///
/// # Errors
/// A tension no length gives; a line that cannot be solved. `told` makes an error of the line one of its class.
pub fn for_tension(
    line: &Line,
    [x, z]: [f64; 2],
    wanted: f64,
    told: impl Fn(&LineError) -> ClassError,
) -> Result<f64, ClassError> {
    match line.first_length(x, z, Some(Aim::Tension(wanted))) {
        Ok(length) => return Ok(length),
        Err(LineError::NoLength { .. }) => {}
        Err(error) => return Err(told(&error)),
    }
    let tension = |length: f64| {
        let state = line.clone().with_first_length(length).and_then(|l| l.at_distance(x, z));
        state.map(|s| s.top_tension).map_err(|e| told(&e))
    };
    // pulled so hard to the side alone, the tension is more; from there on longer
    let tight = line.first_length(x, z, Some(Aim::Horizontal(wanted))).map_err(|e| told(&e))?;
    let mut walked = [(tight, tension(tight)?); 2];
    let mut step = 1e-4 * tight;
    for _ in 0..MOST {
        let [before, last] = walked;
        let next = (last.0 + step, tension(last.0 + step)?);
        if next.1 <= wanted {
            return between(last.0, next.0, wanted, tension);
        }
        if next.1 >= last.1 * (1.0 - 1e-12) {
            let (least, there) = lowest(before.0, next.0, tension)?;
            if there <= wanted {
                return between(before.0, least, wanted, tension);
            }
            let text = "no length of the first segment gives {}; the least tension is {}";
            return Err(ClassError::of(text, &[(wanted, Dim::Force), (there, Dim::Force)]));
        }
        walked = [last, next];
        step *= 1.5;
    }
    Err(ClassError::of("no length of the first segment found that gives {}", &[(wanted, Dim::Force)]))
}

/// The length between a tight and a slacker one at which the tension is what is wanted.
fn between(
    mut tight: f64,
    mut slack: f64,
    wanted: f64,
    tension: impl Fn(f64) -> Result<f64, ClassError>,
) -> Result<f64, ClassError> {
    for _ in 0..MOST {
        let middle = 0.5 * (tight + slack);
        if middle <= tight || middle >= slack {
            break;
        }
        if tension(middle)? > wanted {
            tight = middle;
        } else {
            slack = middle;
        }
    }
    let found = tension(slack)?;
    if (found - wanted).abs() <= 1e-9 * wanted {
        return Ok(slack);
    }
    let text = "no length of the first segment gives {}; the nearest is {}";
    Err(ClassError::of(text, &[(wanted, Dim::Force), (found, Dim::Force)]))
}

/// The length of the least tension between two, and that tension: by golden sections.
fn lowest(
    mut low: f64,
    mut high: f64,
    tension: impl Fn(f64) -> Result<f64, ClassError>,
) -> Result<(f64, f64), ClassError> {
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    let at = |length: f64| tension(length).map(|t| (length, t));
    let mut left = at(high - share * (high - low))?;
    let mut right = at(low + share * (high - low))?;
    for _ in 0..MOST {
        if high - low <= 1e-9 * high {
            break;
        }
        if left.1 < right.1 {
            (high, right) = (right.0, left);
            left = at(high - share * (high - low))?;
        } else {
            (low, left) = (left.0, right);
            right = at(low + share * (high - low))?;
        }
    }
    Ok(if left.1 < right.1 { left } else { right })
}
