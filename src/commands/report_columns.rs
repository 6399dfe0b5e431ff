//! What the columns of reports mean, for `&HELP`: heads that their unit alone does not explain.

use windlass_base::units::Dim;

/// A column of reports.
pub struct ReportColumn {
    /// Its head.
    pub name: &'static str,
    /// Where it stands.
    pub report: &'static str,
    /// What it measures.
    pub dim: Dim,
    /// What it is, with its sign or direction.
    pub meaning: &'static str,
}

const fn column(name: &'static str, report: &'static str, dim: Dim, meaning: &'static str) -> ReportColumn {
    ReportColumn { name, report, dim, meaning }
}

/// The columns, by the reports they stand in.
pub static REPORT_COLUMNS: &[ReportColumn] = &[
    column("Ten Top", "TABLE, &STATUS F_CONNECTOR", Dim::Force, "tension at the first end (the top, the fairlead)"),
    column(
        "Max T/TB",
        "TABLE, MOVE, &STATUS F_CONNECTOR",
        Dim::None,
        "largest tension along the line over the break (MBL) of its segment: T/MBL, the utilisation",
    ),
    column("Crit. Seg", "TABLE, &STATUS F_CONNECTOR", Dim::None, "the segment, from the first end, that has Max T/TB"),
    column("T/TB", "GEOMETRY, CONFORCE", Dim::None, "tension over the break (MBL) of the segment: T/MBL"),
    column(
        "DF/DX",
        "TABLE",
        Dim::ForcePerLength,
        "change of the horizontal force with the horizontal distance: the stiffness of the line",
    ),
    column("Line on Bottom", "TABLE", Dim::Length, "unstretched length on the seabed: the grounded length"),
    column("V. Pull", "&STATUS F_CONNECTOR", Dim::Force, "what the anchor bears, positive upward"),
    column("H. Pull", "&STATUS F_CONNECTOR", Dim::Force, "what the anchor bears horizontally, toward the first end"),
    column("Unstretched", "&STATUS F_CONNECTOR", Dim::Length, "length of the line without tension"),
    column("Arc Length", "GEOMETRY", Dim::Length, "length along the line from its first end"),
    column("Arc", "ROD, &STATUS ROD", Dim::Length, "length along the line from its first end to the node"),
    column("Excursion", "MOVE, WATCH", Dim::Length, "horizontal distance from where the body stood"),
    column("Restoring", "MOVE", Dim::Force, "force of the connectors against the move; positive pushes the body back"),
    column("Transverse", "MOVE", Dim::Force, "force of the connectors across the move, positive toward its left"),
    column(
        "Intact Force",
        "MOVE -REMOVE",
        Dim::Force,
        "restoring force of the mooring with all its lines, at the same excursion",
    ),
    column(
        "Accel/g",
        "&EQUI",
        Dim::None,
        "residual force over the weight: the acceleration left, as a fraction of gravity",
    ),
    column("Declination", "&STATUS LINE_ANGLES", Dim::Angle, "angle of the line below the horizontal at its fairlead"),
    column(
        "Azimuth",
        "&STATUS LINE_ANGLES",
        Dim::Angle,
        "horizontal direction of the line at its fairlead, from +X toward +Y",
    ),
    column("Uplift", "&STATUS LINE_ANGLES", Dim::Angle, "angle of the line above the seabed at its anchor"),
    column("Deflection", "&STATUS F_CONNECTOR, TDOM", Dim::Length, "how far a fender or spring is compressed"),
    column("of Rated", "&STATUS F_CONNECTOR, TDOM", Dim::None, "deflection of a fender over its rated deflection"),
    column(
        "Std. Dev.",
        "STATISTIC, TDOM, STATISTICS",
        Dim::None,
        "standard deviation about the mean, in the unit of the column",
    ),
    column("Tz", "STATISTICS", Dim::Time, "mean period between zero up-crossings"),
    column("Kurtosis", "STATISTIC", Dim::None, "excess over 3, the kurtosis of a Gaussian process"),
    column("Quasi-Static", "TDOM", Dim::Force, "largest tension of the run's quasi-static line"),
    column("Dynamic", "TDOM", Dim::Force, "largest tension of the same line replayed as a dynamic line"),
    column("Touchdown", "ROD, &STATUS", Dim::Length, "where the line first meets the seabed, from its first end"),
    column("Utilisation", "FATIGUE, STAB_OK", Dim::None, "what is used of what is allowed"),
    column("Damage", "FATIGUE", Dim::None, "Miner's sum; 1 is the end of life"),
    column("CDR", "FATIGUE", Dim::None, "cumulative damage ratio of all environments"),
    column("m0", "SPECTRUM", Dim::None, "area below the spectrum: the variance of the signal"),
    column("Direction", "MOVE, &STATUS", Dim::Angle, "toward which a body is moved, from +X toward +Y"),
    column("From", "WATCH, &STATUS", Dim::Angle, "where a force, sea or wind comes from, from +X toward +Y"),
    column("Heading", "MOVE, RAO", Dim::Angle, "of a body its yaw; of waves where they come from"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_explained_column_stands_in_the_source_of_a_report() {
        let mut text = String::new();
        let mut folders = vec![std::path::PathBuf::from("crates"), "src".into()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).unwrap().flatten() {
                let path = entry.path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("report_columns.rs") {
                    text.push_str(&std::fs::read_to_string(path).unwrap());
                }
            }
        }
        for column in REPORT_COLUMNS {
            assert!(text.contains(&format!("\"{}", column.name)), "{} stands in no report", column.name);
        }
    }
}
