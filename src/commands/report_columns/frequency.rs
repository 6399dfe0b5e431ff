//! Reports of the frequency domain.

use super::*;

const AMPLITUDE: &[Dim] = &[
    Dim::Length,
    Dim::Angle,
    Dim::Velocity,
    Dim::AngularVelocity,
    Dim::Acceleration,
    Dim::AngularAcceleration,
    Dim::Force,
    Dim::Moment,
];
const DENSITY: &[Dim] = &[
    Dim::SpectralDensity,
    Dim::AngleDensity,
    derived(0, 2, -1),
    derived(0, 2, -3),
    derived(0, 0, -1),
    derived(0, 0, -3),
    derived(2, 0, 1),
    derived(2, 2, 1),
];

pub(super) static REPORTS: &[ReportColumns] = &[
    ReportColumns {
        printed_by: "MOTION, FR_POINT, CONFORCE, FR_CFORCE, FR_FCARGO, EXFORCE of FREQ_RESPONSE",
        titles: &[
            "Motion of @",
            "Velocity of @",
            "Acceleration of @",
            "Forces of Connectors",
            "Force of a Cargo at @",
            "Exciting Forces",
        ],
        columns: &[
            column("Encounter", TIME, "period at which a body under way meets the waves"),
            column("@: @ Amp", AMPLITUDE, "amplitude in a wave with an amplitude of one length"),
            column("@: @ Phase", ANGLE, "lag behind the crest at the global origin"),
            column("Density: Wave", &[Dim::SpectralDensity], "spectral density of the sea"),
            column("Density: @", DENSITY, "spectral density of the response"),
        ],
    },
    ReportColumns {
        printed_by: "STATISTICS, ST_POINT, ST_CFORCE, ST_FCARGO of FREQ_RESPONSE",
        titles: &["Statistics: @"],
        columns: &[
            column("Result", NONE, "what the row is of"),
            column("Axis", NONE, "the axis, along it and about it"),
            column("@Mean", AMPLITUDE, "mean"),
            column("@RMS Wave", AMPLITUDE, "standard deviation at the frequencies of the waves"),
            column("@RMS Slow", AMPLITUDE, "standard deviation at those of slow drift"),
            column("@RMS", AMPLITUDE, "standard deviation of both"),
            column("@Signif.", AMPLITUDE, "significant amplitude: twice the standard deviation"),
            column(
                "@Maximum",
                AMPLITUDE,
                "amplitude about the mean: the most probable of the duration, or that of -PROBABILITY",
            ),
            column("@Tz", TIME, "mean period between zero up-crossings"),
        ],
    },
    ReportColumns {
        printed_by: "MATRICES -FILE of FREQ_RESPONSE",
        titles: &["Matrices of the Equations of Motion"],
        columns: &[
            column(
                "M@",
                &[derived(1, -1, 2), derived(1, 0, 2), derived(1, 1, 2)],
                "element of the mass matrix with added mass, by row and column",
            ),
            column("B@", &[derived(1, -1, 1), derived(1, 0, 1), derived(1, 1, 1)], "element of the damping matrix"),
            column(
                "K@",
                &[Dim::ForcePerLength, Dim::Force, derived(1, -1, 0), derived(1, 0, 0), derived(1, 1, 0)],
                "element of the stiffness matrix",
            ),
        ],
    },
    ReportColumns {
        printed_by: "G_PRESSURE of HYDRODYNAMICS",
        titles: &["Pressures on @"],
        columns: &[
            column("Period", &[Dim::Time], "period of the waves"),
            column("Wave Length", &[Dim::Length], "length of the waves"),
            column("Panels a Wave", NONE, "wave length over the size of the panels"),
            column(
                "Haskind",
                NONE,
                "difference of exciting forces by pressure and by Haskind's relation, per cent of the largest of the motion, in that where it is largest",
            ),
            column("In", NONE, "the motion of which Haskind is"),
            column("Products", NONE, "products with the matrices until the equations were solved"),
            column(
                "Drift",
                NONE,
                "largest difference of mean drift by control surfaces from that of the waves far away, per cent of the largest; of a body alone where its drift is largest",
            ),
            column(
                "Near Field",
                NONE,
                "largest difference of the drift of a body by the pressure on its hull from its drift, which acts, per cent of its largest force",
            ),
        ],
    },
    ReportColumns {
        printed_by: "G_MDRIFT of HYDRODYNAMICS",
        titles: &["Mean Drift by Panels of @"],
        columns: &[
            column("Period", &[Dim::Time], "period of the waves"),
            column("Heading", ANGLE, "where the waves of the largest drift come from, from the heading of the body"),
            column(
                "Far Field: Far @",
                &[derived(1, -2, 0)],
                "force over the square of the wave amplitude, by the waves far away",
            ),
            column("Control Surface: Surface @", &[derived(1, -2, 0)], "the same by the control surface"),
            column("Near Field: Near @", &[derived(1, -2, 0)], "the same by the pressure on the hull"),
            column(
                "Difference: of Surface",
                NONE,
                "largest difference of the control surface from the far field over all headings, per cent of the largest force",
            ),
            column("Difference: of Near Field", NONE, "the same of the pressure on the hull"),
        ],
    },
    ReportColumns {
        printed_by: "V_MATRICES of HYDRODYNAMICS",
        titles: &["Added Mass and Damping of @"],
        columns: &[
            column(
                "Added Mass: A @",
                &[derived(1, 0, 0), derived(1, 1, 0), derived(1, 2, 0)],
                "added mass times gravity: force along the first axis by an acceleration along the second",
            ),
            column(
                "Damping: B @",
                &[derived(1, -1, 1), derived(1, 0, 1), derived(1, 1, 1)],
                "radiation damping: force along the first axis by a velocity along the second",
            ),
        ],
    },
];
