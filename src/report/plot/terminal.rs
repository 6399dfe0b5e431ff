//! A surface for plotters made of braille cells: every character of the terminal is two dots wide and four high, text
//! stands in whole cells.

use plotters::style::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontTransform,
};
use std::convert::Infallible;

/// A grid of characters.
pub struct TextCanvas {
    columns: usize,
    lines: usize,
    dots: Vec<u8>,
    marks: Vec<Option<char>>,
    letters: Vec<Option<char>>,
}

/// Marks that tell several lines apart; the first line is drawn in dots.
const MARKS: [char; 6] = ['\u{2836}', 'x', 'o', '+', '#', '@'];

/// The mark of a line in the legend.
pub fn mark(index: usize) -> char {
    MARKS.get(index % MARKS.len()).copied().unwrap_or('*')
}

/// The colour that stands for a line on this surface; [`Canvas`] takes its mark from it, and with `alone` to use one
/// for the first line too.
pub fn colour(index: usize, alone: bool) -> RGBColor {
    RGBColor(1, if alone { 2 } else { 1 }, u8::try_from(index % MARKS.len()).unwrap_or(0))
}

impl TextCanvas {
    /// An empty surface.
    pub fn new(columns: usize, lines: usize) -> Self {
        let cells = columns * lines;
        TextCanvas { columns, lines, dots: vec![0; cells], marks: vec![None; cells], letters: vec![None; cells] }
    }

    /// The surface as text, trailing blanks taken off.
    pub fn text(&self) -> String {
        let mut out = String::new();
        for line in 0..self.lines {
            let row = (0..self.columns).map(|column| {
                let at = line * self.columns + column;
                let letter = self.letters.get(at).copied().flatten().or_else(|| self.marks.get(at).copied().flatten());
                let dots = self.dots.get(at).copied().unwrap_or(0);
                letter.unwrap_or_else(|| {
                    if dots == 0 { ' ' } else { char::from_u32(0x2800 + u32::from(dots)).unwrap_or(' ') }
                })
            });
            out.push_str(row.collect::<String>().trim_end());
            out.push('\n');
        }
        out
    }

    fn cell(&self, x: i32, y: i32) -> Option<usize> {
        let (x, y) = (usize::try_from(x).ok()? / 2, usize::try_from(y).ok()? / 4);
        (x < self.columns && y < self.lines).then(|| y * self.columns + x)
    }
}

/// The braille bit of a dot within its cell.
fn bit(x: i32, y: i32) -> u8 {
    match (x.rem_euclid(2), y.rem_euclid(4)) {
        (0, 3) => 0x40,
        (1, 3) => 0x80,
        (0, row) => 1 << row,
        (_, row) => 8 << row,
    }
}

impl DrawingBackend for TextCanvas {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        let pin = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        (pin(2 * self.columns), pin(4 * self.lines))
    }

    fn ensure_prepared(&mut self) -> Result<(), DrawingErrorKind<Infallible>> {
        Ok(())
    }

    fn present(&mut self) -> Result<(), DrawingErrorKind<Infallible>> {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, colour: BackendColor) -> Result<(), DrawingErrorKind<Infallible>> {
        let white = colour.rgb == (255, 255, 255);
        if let Some(cell) = self.cell(at.0, at.1).filter(|_| !white && colour.alpha > 0.0) {
            let line = match colour.rgb {
                (1, 2, index) => Some(usize::from(index)),
                (1, 1, index) if index > 0 => Some(usize::from(index)),
                _ => None,
            };
            if let Some(line) = line {
                if let Some(slot) = self.marks.get_mut(cell) {
                    *slot = Some(mark(line));
                }
            } else if let Some(dots) = self.dots.get_mut(cell) {
                *dots |= bit(at.0, at.1);
            }
        }
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        upper_left: BackendCoord,
        bottom_right: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        if style.color().rgb == (255, 255, 255) {
            return Ok(());
        }
        plotters_backend::rasterizer::draw_rect(self, upper_left, bottom_right, style, fill)
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        _: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        Ok((2 * u32::try_from(text.chars().count()).unwrap_or(0), 4))
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &S,
        at: BackendCoord,
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        let count = i32::try_from(text.chars().count()).unwrap_or(0);
        let turned = !matches!(style.transform(), FontTransform::None);
        let anchor = style.anchor();
        let shift = match anchor.h_pos {
            HPos::Left => 0,
            HPos::Center => -count / 2,
            HPos::Right => -count,
        };
        let rise = match anchor.v_pos {
            VPos::Top | VPos::Center => 0,
            VPos::Bottom => -1,
        };
        // a turned label (the vertical axis) stands upright at the top of its axis instead
        let (mut column, line) = if turned { (0, 1) } else { (at.0 / 2 + shift, at.1 / 4 + rise) };
        column = column.clamp(0, (i32::try_from(self.columns).unwrap_or(0) - count).max(0));
        for (offset, letter) in (0..count).zip(text.chars()) {
            if let Some(cell) = self.cell(2 * (column + offset), 4 * line)
                && let Some(slot) = self.letters.get_mut(cell)
            {
                *slot = Some(letter);
            }
        }
        Ok(())
    }
}
