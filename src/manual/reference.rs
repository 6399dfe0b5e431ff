//! The reference: a page a menu, one each of class types, string functions, reports and spectra.

use super::Page;
use super::markdown::{code, command_section, describe_owner, escape, sentence, table, unit_names};
use crate::commands::report_columns::{ReportColumn, report_columns};
use crate::commands::{COMMANDS, Command, FUNCTION_HELP, menu, status_rows};
use windlass_base::units::UnitSystem;
use windlass_connectors::{CLASSES, SECTIONS, class_specs};
use windlass_hydro::gusts::GUST_SPECTRA;
use windlass_hydro::sea::spectra::SPECTRA;
use windlass_language::flow::specs::CONTROL;
use windlass_language::functions;
use windlass_language::spec::{CommandSpec, Kind, MenuSpec, describe_expected};

/// What stands on top of each page.
pub(super) const MADE: &str =
    "<!-- Made from the declarations in the source by `windlass manual`; do not edit. -->\n\n";

/// A page of commands.
struct Chapter {
    file: &'static str,
    title: &'static str,
    head: &'static str,
    /// The menus whose commands it has; empty: those of every menu.
    menus: &'static [&'static MenuSpec],
}

const CHAPTERS: &[Chapter] = &[
    Chapter {
        file: "main",
        title: "Main menu",
        head: "Commands of the main menu: they open the other menus and solve.",
        menus: &[&menu::MAIN],
    },
    Chapter {
        file: "everywhere",
        title: "Commands of every menu",
        head: "Internal commands begin with `&` and act in every menu.",
        menus: &[],
    },
    Chapter {
        file: "model",
        title: "Model: INMODEL and MEDIT",
        head: "Records that make the model: bodies, points, weights, classes, connectors.",
        menus: &[&menu::INMODEL, &menu::MEDIT],
    },
    Chapter {
        file: "surfaces",
        title: "Hull surfaces: &SURFACE, BLOCK, MESH, PGEN",
        head: "Records that give the surface of a hull.",
        menus: &[&menu::SURFACE, &menu::BLOCK, &menu::MESH, &menu::PGEN],
    },
    Chapter {
        file: "environment",
        title: "Environment data: &DATA, &BATHYMETRY",
        head: "Curves, profiles and the bottom, which `&ENV` names.",
        menus: &[&menu::ENVIRONMENT, &menu::CURVES, &menu::BATHYMETRY],
    },
    Chapter {
        file: "selection",
        title: "Selectors: &SELECT",
        head: "Records that gather names under a selector.",
        menus: &[&menu::SELECT],
    },
    Chapter {
        file: "connector-tables",
        title: "Connector design: CONN_DESIGN",
        head: "Tables of a line's force against distance, its shape, and moves of a body in its mooring.",
        menus: &[&menu::CONN_DESIGN],
    },
    Chapter {
        file: "hydrostatics",
        title: "Stability: HSTATICS",
        head: "Hydrostatics, floating position, righting and heeling arms, stability criteria, longitudinal strength and tanks.",
        menus: &[&menu::HSTATICS],
    },
    Chapter {
        file: "hydrodynamics",
        title: "Hydrodynamic data: HYDRODYNAMICS",
        head: "Databases of bodies by records, and tables of databases.",
        menus: &[&menu::HYDRODYNAMICS, &menu::I_TOTAL],
    },
    Chapter {
        file: "frequency",
        title: "Frequency domain: FREQ_RESPONSE",
        head: "Motions and forces in regular waves and in a sea.",
        menus: &[&menu::FREQ_RESPONSE],
    },
    Chapter {
        file: "post-processing",
        title: "Results of a run: PRCPOST",
        head: "Tables of a run in the time domain. Each opens the disposition menu.",
        menus: &[&menu::PRCPOST],
    },
    Chapter {
        file: "disposition",
        title: "Disposition of a table",
        head: "What can be done with a table: reports, files, plots, statistics, new columns.",
        menus: &[&menu::DISPOSITION, &menu::REPORT, &menu::BUILDG],
    },
    Chapter {
        file: "summary",
        title: "Summaries: &SUMMARY",
        head: "Summaries of the model.",
        menus: &[&menu::SUMMARY],
    },
];

/// The pages of the reference, the list of them first.
pub fn build_pages() -> Vec<Page> {
    let mut listed = Vec::new();
    let mut pages = Vec::new();
    for chapter in CHAPTERS {
        let specs = specs_of_chapter(chapter);
        let text = format!("# {}\n\n{MADE}{}\n\n{}", escape(chapter.title), chapter.head, sections(&specs, ""));
        listed.push([link(chapter.title, chapter.file), list_names(specs.iter().map(|spec| spec.name))]);
        pages.push(page(chapter.file, &text));
    }
    let mut add = |file: &str, title: &str, names: String, body: String| {
        listed.push([link(title, file), names]);
        pages.push(page(file, &format!("# {}\n\n{MADE}{body}", escape(title))));
    };
    let control: Vec<&CommandSpec> = CONTROL.iter().collect();
    add(
        "control",
        "Variables, branches, loops, macros",
        list_names(CONTROL.iter().map(|spec| spec.name)),
        format!("Records that steer the interpreter. They act in every menu.\n\n{}", sections(&control, "")),
    );
    add("classes", "Classes", list_names(class_specs().map(|spec| spec.name)), class_sections());
    let functions = functions::FUNCTION_HELP.iter().chain(FUNCTION_HELP);
    add(
        "functions",
        "String functions",
        list_names(functions.clone().map(|(name, ..)| *name)),
        "A string function is replaced by its result before the record is read.\n\n".to_string()
            + &functions.map(function_section).collect::<String>(),
    );
    let kinds: Vec<_> = status_rows().collect();
    add("status", "Kinds of &STATUS", list_names(kinds.iter().map(|kind| kind.0)), status_table(&kinds));
    add("columns", "Columns of reports", "every column, its unit and its meaning".to_string(), column_tables());
    add("spectra", "Wave and gust spectra", list_names(SPECTRA.iter().map(|s| s.name)), spectra_tables());
    let head = "Every command, option, class, function and report, from the declarations that the program itself reads. \
                Numbers are in the units of `&DIMEN`: feet and kips unless it says otherwise; where two units are named, the \
                first is that of feet and kips, the second that of metres and kilonewtons. Words may be shortened to any beginning that \
                is unique; a beginning that is unique among the names of MOSES stays valid. `&HELP NAME` prints the same at the terminal.\n\n";
    let index = format!("# Reference\n\n{MADE}{head}{}", table(["Page", "Names"], &listed));
    pages.insert(0, page("index", &index));
    pages
}

fn page(file: &str, text: &str) -> Page {
    Page { path: format!("reference/{file}.md"), text: format!("{}\n", text.trim_end()) }
}

fn link(title: &str, file: &str) -> String {
    format!("[{}]({file}.md)", escape(title))
}

fn list_names<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(code).collect::<Vec<_>>().join(" ")
}

fn belongs(command: &Command, chapter: &Chapter) -> bool {
    match chapter.menus {
        [] => command.spec.menus.is_empty(),
        // a command of several menus stands where its first menu has its page
        menus => command.spec.menus.first().is_some_and(|first| menus.contains(first)),
    }
}

fn specs_of_chapter(chapter: &Chapter) -> Vec<&'static CommandSpec> {
    COMMANDS.iter().filter(|command| belongs(command, chapter)).map(|command| command.spec).collect()
}

fn sections(specs: &[&CommandSpec], lead: &str) -> String {
    specs.iter().map(|spec| command_section(spec, lead)).collect()
}

/// Class types, each with the options that have no effect in it.
fn class_sections() -> String {
    let head = "A class says what a connector is made of and which law it has: `~NAME TYPE ..`. Further records of the same name \
                add segments where the type has them.\n\n";
    let mut text = head.to_string();
    for kind in CLASSES {
        text.push_str(&command_section(kind.spec, "~NAME "));
        let idle: Vec<[String; 2]> = kind.idle.iter().map(|(option, with)| [code(option.name), escape(with)]).collect();
        text.push_str(&table(["Kept, without effect here", "Acts with"], &idle));
    }
    for kind in SECTIONS {
        text.push_str(&command_section(kind.spec, "~NAME "));
    }
    text
}

fn function_section((name, form, meaning): &(&str, &str, &str)) -> String {
    let parts: Vec<String> = meaning.split(" | ").map(|part| format!("- {}", escape(part.trim()))).collect();
    format!("## {}\n\n```text\n{form}\n```\n\n{}\n\n", escape(name), parts.join("\n"))
}

fn status_table(kinds: &[(&str, String, windlass_language::select::Owner)]) -> String {
    let rows: Vec<[String; 2]> = kinds
        .iter()
        .map(|(name, help, owner)| {
            [code(name), format!("{} {}", escape(&sentence(help)), describe_owner(*owner)).trim_end().to_string()]
        })
        .collect();
    format!(
        "`&STATUS KIND` prints the tables of a kind. `-HARD` writes them to the output file.\n\n{}",
        table(["Kind", "Reports"], &rows)
    )
}

/// What the columns of every report are.
fn column_tables() -> String {
    let head = "What the columns of reports mean, by what prints them. A file has the same columns as the report, its heads with the group and the \
                unit. `Group: Name` is a column below a shared head, as `VLIST` prints it; `@` stands for the name of a body, a connector, \
                a point or a column. `&HELP NAME` finds a column at the terminal.\n\n";
    let unit = |column: &ReportColumn| match column.units {
        [] => "of the column described".to_string(),
        dims => {
            let mut names: Vec<String> =
                dims.iter().map(|dim| unit_names(*dim)).filter(|name| !name.is_empty()).collect();
            names.dedup();
            names.join("; ")
        }
    };
    let sections = report_columns().map(|report| {
        let rows: Vec<[String; 3]> = report
            .columns
            .iter()
            .map(|column| [code(column.head), escape(&unit(column)), escape(&sentence(column.meaning))])
            .collect();
        let titles: Vec<String> = report.titles.iter().map(|title| escape(title)).collect();
        let titles = if report.titles == ["@"] { String::new() } else { format!("Tables: {}.\n\n", titles.join("; ")) };
        format!("## {}\n\n{titles}{}", escape(report.printed_by), table(["Column", "Unit", "Meaning"], &rows))
    });
    format!("{head}{}", sections.collect::<String>())
}

fn spectra_tables() -> String {
    let units = UnitSystem::default();
    let waves: Vec<[String; 3]> = SPECTRA
        .iter()
        .map(|spectrum| {
            let parameters = spectrum.parameters.iter().map(|parameter| {
                let kind = describe_expected(Kind::Number(parameter.dim), units);
                let [low, high] = parameter.range;
                escape(&format!("{}: {}: {kind}, from {low} to {high}", parameter.name, parameter.help))
            });
            [code(spectrum.name), escape(&sentence(spectrum.help)), parameters.collect::<Vec<_>>().join("; ")]
        })
        .collect();
    let gusts: Vec<[String; 2]> =
        GUST_SPECTRA.iter().map(|spectrum| [code(spectrum.name), escape(&sentence(spectrum.help))]).collect();
    format!(
        "Wave spectra of `-SEA` of `&ENV`:\n\n{}Gust spectra of `-W_SPECTRUM`:\n\n{}",
        table(["Spectrum", "Meaning", "Parameters"], &waves),
        table(["Spectrum", "Meaning"], &gusts)
    )
}
