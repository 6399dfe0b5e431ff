//! Springs at the ends of a tether: the TSPA and TSPV cards of deck 14.
//!
//! Source: [AQWA-TETHER A.2 and 8.1.14].

use super::card::Field;
use super::remarks::Remarks;
use super::tethers::Tether;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Stiffness of an end spring that is not given [AQWA-TETHER A.2].
pub const DEFAULT_SPRING_STIFFNESS: f64 = 1.0e15;
/// A TSPA or TSPV card.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndSpringCard {
    /// Whether the tether is towed.
    pub towed: bool,
    /// Installed: inline, then two rotational. Towed: three translational.
    pub stiffness: [Field<f64>; 3],
    /// The card.
    pub span: Span,
}

/// The stiffnesses in force of the springs at an end.
///
/// Installed [AQWA-TETHER A.2]: inline 1.0E15 where blank, zero or negative, rotational 0 where negative, all three 1.0E15 where the
/// card is missing. Towed [AQWA-TETHER 8.1.14]: 1.0E15 in place of zero.
pub fn in_force(spring: Option<EndSpringCard>, towed: bool) -> [f64; 3] {
    let Some(spring) = spring else { return [DEFAULT_SPRING_STIFFNESS; 3] };
    let [first, second, third] = spring.stiffness.map(|field| field.value);
    if towed {
        [first, second, third].map(|value| if value == 0.0 { DEFAULT_SPRING_STIFFNESS } else { value })
    } else {
        [if first <= 0.0 { DEFAULT_SPRING_STIFFNESS } else { first }, second.max(0.0), third.max(0.0)]
    }
}

/// Says what A.2 and 8.1.14 say of the springs of a tether.
pub fn check(tether: &Tether, remarks: &mut Remarks) {
    let ends = [("TSPA", tether.description.anchor), ("TSPV", tether.description.vessel)];
    if let [(_, Some(anchor)), (_, Some(vessel))] = ends
        && anchor.towed != vessel.towed
    {
        remarks.add(
            Diagnostic::error("deck 14: a tether is towed at both ends or at none", vessel.span)
                .label("flag in column 15")
                .other(anchor.span, "the other end"),
        );
    }
    if !tether.is_towed() && tether.description.lower_stop.is_none() {
        remarks.add_once("TLOW missing", || {
            Diagnostic::remark("deck 14: no TLOW card; a slack tether hangs free and meets no lower stop", tether.span)
                .help(
                    "so for every installed tether without the card; TLOW 0.0 keeps a tether from hanging free (A.11)",
                )
        });
    }
    for (keyword, spring) in ends {
        if tether.is_towed() {
            check_towed(keyword, spring, tether.span, remarks);
        } else {
            check_installed(keyword, spring, tether.span, remarks);
        }
    }
}

fn check_towed(keyword: &str, spring: Option<EndSpringCard>, at: Span, remarks: &mut Remarks) {
    let help = "a towed tether has soft springs at both ends, as of its mooring lines, a few kN/m (8.1.14)";
    let Some(spring) = spring else {
        let message = format!("deck 14: this towed tether has no {keyword} card; 1.0E15 is taken in each direction");
        remarks.add(Diagnostic::warning(message, at).help(help));
        return;
    };
    if let Some(negative) = spring.stiffness.iter().find(|stiffness| stiffness.value < 0.0) {
        remarks.add(Diagnostic::error(format!("deck 14, {keyword}: a stiffness is not below 0"), negative.span));
    }
    if let Some(zero) = spring.stiffness.iter().find(|stiffness| stiffness.value == 0.0) {
        let message = format!("deck 14, {keyword}: a zero spring of a towed tether is taken as the default, 1.0E15");
        remarks.add(Diagnostic::warning(message, zero.span).help(help));
    }
}

fn check_installed(keyword: &str, spring: Option<EndSpringCard>, at: Span, remarks: &mut Remarks) {
    let Some(spring) = spring else {
        remarks.add_once(&format!("{keyword} missing"), || {
            let message =
                format!("deck 14: no {keyword} card; 1.0E15 is taken for the inline and both rotational springs");
            Diagnostic::remark(message, at).help("so for every installed tether without the card [AQWA-TETHER A.2]")
        });
        return;
    };
    let [inline, second, third] = spring.stiffness;
    if inline.value <= 0.0 {
        remarks.add_once(&format!("{keyword} inline"), || {
            Diagnostic::remark(format!("deck 14, {keyword}: the inline stiffness is taken as 1.0E15"), inline.span)
                .help("so for every installed tether where it is blank, zero or negative [AQWA-TETHER A.2]")
        });
    }
    for rotational in [second, third] {
        if rotational.value < 0.0 {
            remarks.add(Diagnostic::remark(
                format!("deck 14, {keyword}: the negative rotational stiffness is taken as 0 [AQWA-TETHER A.2]"),
                rotational.span,
            ));
        }
    }
}
