//! The menus: commands list those they belong to, and say which one they open.

use windlass_language::spec::MenuSpec;

/// MAIN.
pub static MAIN: MenuSpec = MenuSpec { name: "MAIN", end: "END" };
/// INMODEL.
pub static INMODEL: MenuSpec = MenuSpec { name: "INMODEL", end: "END_INMODEL" };
/// MEDIT.
pub static MEDIT: MenuSpec = MenuSpec { name: "MEDIT", end: "END_MEDIT" };
/// CONN_DESIGN.
pub static CONN_DESIGN: MenuSpec = MenuSpec { name: "CONN_DESIGN", end: "END_CONN_DESIGN" };
/// PRCPOST.
pub static PRCPOST: MenuSpec = MenuSpec { name: "PRCPOST", end: "END_PRCPOST" };
/// DISPOSITION.
pub static DISPOSITION: MenuSpec = MenuSpec { name: "DISPOSITION", end: "END_DISPOSE" };
/// REPORT.
pub static REPORT: MenuSpec = MenuSpec { name: "REPORT", end: "END_REPORT" };
/// ENVIRONMENT.
pub static ENVIRONMENT: MenuSpec = MenuSpec { name: "ENVIRONMENT", end: "END_&DATA" };
/// CURVES.
pub static CURVES: MenuSpec = MenuSpec { name: "CURVES", end: "END_&DATA" };
/// SHAPES.
pub static SHAPES: MenuSpec = MenuSpec { name: "SHAPES", end: "END_&DATA" };
/// SELECT.
pub static SELECT: MenuSpec = MenuSpec { name: "SELECT", end: "END_&SELECT" };
/// SURFACE.
pub static SURFACE: MenuSpec = MenuSpec { name: "SURFACE", end: "END_&SURFACE" };
/// BLOCK.
pub static BLOCK: MenuSpec = MenuSpec { name: "BLOCK", end: "END_BLOCK" };
/// MESH.
pub static MESH: MenuSpec = MenuSpec { name: "MESH", end: "END_MESH" };
/// PGEN.
pub static PGEN: MenuSpec = MenuSpec { name: "PGEN", end: "END_PGEN" };
/// BUILDG.
pub static BUILDG: MenuSpec = MenuSpec { name: "BUILDG", end: "END_&BUILDG" };
/// BATHYMETRY.
pub static BATHYMETRY: MenuSpec = MenuSpec { name: "BATHYMETRY", end: "END_&BATHYMETRY" };
/// HSTATICS.
pub static HSTATICS: MenuSpec = MenuSpec { name: "HSTATICS", end: "END_HSTATICS" };
/// FREQ_RESPONSE.
pub static FREQ_RESPONSE: MenuSpec = MenuSpec { name: "FREQ_RESPONSE", end: "END_FREQ_RESPONSE" };

/// HYDRODYNAMICS.
pub static HYDRODYNAMICS: MenuSpec = MenuSpec { name: "HYDRODYNAMICS", end: "END_HYDRODYNAMICS" };
/// I_TOTAL.
pub static I_TOTAL: MenuSpec = MenuSpec { name: "I_TOTAL", end: "END_I_TOTAL" };
/// SUMMARY.
pub static SUMMARY: MenuSpec = MenuSpec { name: "SUMMARY", end: "END_&SUMMARY" };

/// All of them.
pub static ALL: [&MenuSpec; 22] = [
    &MAIN,
    &INMODEL,
    &MEDIT,
    &CONN_DESIGN,
    &PRCPOST,
    &DISPOSITION,
    &REPORT,
    &ENVIRONMENT,
    &CURVES,
    &SHAPES,
    &SELECT,
    &SURFACE,
    &BLOCK,
    &MESH,
    &PGEN,
    &BUILDG,
    &BATHYMETRY,
    &HSTATICS,
    &FREQ_RESPONSE,
    &SUMMARY,
    &HYDRODYNAMICS,
    &I_TOTAL,
];

/// The names of menus, joined by a word.
pub fn join_names(menus: &[&MenuSpec], by: &str) -> String {
    menus.iter().map(|menu| menu.name).collect::<Vec<_>>().join(by)
}
