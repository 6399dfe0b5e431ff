//! `windlass --man`: one page with the program and all its commands.

use clap::Command;
use clap_mangen::Man;
use std::io::{Error, Write};

/// The man page of a command line. A command of it has a section with its synopsis, options and exit codes as subsections, for
/// there is no page of its own.
///
/// # Errors
/// Those of writing into memory: none are known.
pub fn man_page(mut command: Command) -> Result<Vec<u8>, Error> {
    command.build();
    let man = Man::new(command.clone());
    let mut page = Vec::new();
    man.render_title(&mut page)?;
    let mut rest = Vec::new();
    man.render_name_section(&mut rest)?;
    man.render_synopsis_section(&mut rest)?;
    man.render_description_section(&mut rest)?;
    man.render_options_section(&mut rest)?;
    page.extend(without_preamble(&rest));
    page.extend(last_section(&man, "SH")?);
    for own in command.get_subcommands() {
        write_command(own, &mut page)?;
    }
    Ok(page)
}

/// The section of a command, and those of its own commands behind it.
fn write_command(command: &Command, page: &mut Vec<u8>) -> Result<(), Error> {
    if command.is_hide_set() {
        return Ok(());
    }
    let name = command.get_bin_name().unwrap_or(command.get_name());
    writeln!(page, ".SH {}", name.to_uppercase().replace(' ', "\\ "))?;
    let man = Man::new(command.clone());
    let mut parts = Vec::new();
    man.render_description_section(&mut parts)?;
    man.render_synopsis_section(&mut parts)?;
    if command.get_arguments().any(|argument| !argument.is_hide_set()) {
        man.render_options_section(&mut parts)?;
    }
    let parts = String::from_utf8_lossy(&without_preamble(&parts)).replace(".SH DESCRIPTION\n", "");
    let parts = parts.replace(".SH SYNOPSIS", ".SS Synopsis").replace(".SH OPTIONS", ".SS Options");
    page.extend(parts.into_bytes());
    page.extend(last_section(&man, "SS")?);
    command.get_subcommands().try_for_each(|own| write_command(own, page))
}

/// What stands below the options in the help, exit codes and the like, its lines as they are; nothing where there is none.
fn last_section(man: &Man, level: &str) -> Result<Vec<u8>, Error> {
    let mut text = Vec::new();
    man.render_extra_section(&mut text)?;
    let text = String::from_utf8_lossy(&without_preamble(&text)).into_owned();
    let lines = text.trim_start_matches(".SH EXTRA").trim();
    if lines.is_empty() {
        return Ok(Vec::new());
    }
    let head = if level == "SH" { "NOTES" } else { "Notes" };
    Ok(format!(".{level} {head}\n.nf\n{lines}\n.fi\n").into_bytes())
}

/// A part without the lines that define quotes, which a page has once.
fn without_preamble(part: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(part);
    let kept = text.lines().filter(|line| !line.starts_with(".ie ") && !line.starts_with(".el "));
    kept.map(|line| format!("{line}\n")).collect::<String>().into_bytes()
}
