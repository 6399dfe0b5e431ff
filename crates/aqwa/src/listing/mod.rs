//! The pages of the listing that show what a deck says, with the headings, columns, digits and order of [AQWA-TETHER 8].
//!
//! A page is a [`Table`]. Values are in the units of the deck. Where the listing prints digits that go with the row, the cells are texts of one
//! width. Pages of the analysis (tethers, modes, histories, statistics) are those of the engines; page breaks and banners are left out.

mod geometry;
mod start;
mod water;

use super::Deck;
use super::echo::Echo;
use super::job::Program;
use windlass_base::fortran::{exponent, format_fixed};
use windlass_base::table::{Column, Digits, Table};
use windlass_base::units::Dim;

/// A part of the listing.
#[derive(Clone, Debug, PartialEq)]
pub enum ListingPart {
    /// The echo of a deck.
    Echo(Echo),
    /// A page of data.
    Page(Table),
}

const WHOLE: Digits = Digits::Decimals(0);
const THREE_DECIMALS: Digits = Digits::Decimals(3);
/// Four decimals in E format.
const FIVE_FIGURES: Digits = Digits::Scientific(5);
const FREEDOMS: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

impl Deck {
    /// What the listing has before the tethers: the echo of the cards and the data, stage by stage.
    pub fn listing_before_tethers(&self) -> Vec<ListingPart> {
        let (mut first, mut second, mut last) = (Vec::new(), Vec::new(), Vec::new());
        for echo in self.echo().into_iter().filter(|echo| !echo.lines.is_empty() && self.job.has_deck(echo.deck)) {
            let stage = match echo.deck {
                1..=5 => &mut first,
                6..=8 => &mut second,
                _ => &mut last,
            };
            stage.push(ListingPart::Echo(echo));
        }
        let pages = |list: Vec<Table>| list.into_iter().map(ListingPart::Page);
        // the pages of a stage come when it is run or was run
        let (_, finish) = self.job.stages;
        first.extend(pages(self.geometry_pages()));
        if finish >= 2 {
            second.extend(pages(self.hydrostatic_pages()));
        }
        if finish >= 4 {
            last.extend(pages(self.water_pages()));
        }
        first.into_iter().chain(second).chain(last).collect()
    }

    /// What the listing has between the tethers and the motion, but the lines of the spectrum: how the analysis starts. Only DRIF and NAUT have it.
    pub fn listing_before_motion(&self) -> Vec<Table> {
        let (_, finish) = self.job.stages;
        let lists = finish >= 4 && matches!(self.job.program, Program::Drift | Program::Naut);
        if lists { self.start_pages() } else { Vec::new() }
    }
}

/// The fact of a text.
fn fact(table: Table, name: &str, value: String) -> Table {
    table.fact(name, value, Dim::None)
}

/// A matrix of six with its rows named, as the listing has stiffness, added mass and damping.
fn six_by_six(title: String, group: &str, matrix: &[[f64; 6]; 6]) -> Table {
    let rows: Vec<(&str, [f64; 6])> = FREEDOMS.into_iter().zip(*matrix).collect();
    Table::new(title)
        .with_rows(&rows)
        .text("", |(name, _)| *name)
        .columns(group, FREEDOMS, Dim::None, FIVE_FIGURES, |(_, row)| *row)
        .build()
}
