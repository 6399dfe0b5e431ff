//! A pixel surface for plotters with a drawn font (Noto Sans Mono, SIL Open Font License), encoded as PNG: no font
//! files, the same bytes everywhere.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};
use plotters::style::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontTransform,
};
use std::convert::Infallible;

/// An RGB image.
pub struct RasterCanvas {
    width: u32,
    height: u32,
    pixels: Vec<u8>,
}

impl RasterCanvas {
    /// A white image.
    pub fn new(width: u32, height: u32) -> Self {
        RasterCanvas { width, height, pixels: vec![255; 3 * width as usize * height as usize] }
    }

    /// The image as PNG.
    pub fn encode(&self) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        writer.finish()?;
        Ok(bytes)
    }

    fn blend(&mut self, x: i32, y: i32, colour: BackendColor) {
        let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return };
        if x >= self.width || y >= self.height {
            return;
        }
        let at = 3 * (y as usize * self.width as usize + x as usize);
        let (r, g, b) = colour.rgb;
        for (offset, value) in [r, g, b].into_iter().enumerate() {
            if let Some(pixel) = self.pixels.get_mut(at + offset) {
                let mixed = f64::from(*pixel) * (1.0 - colour.alpha) + f64::from(value) * colour.alpha;
                *pixel = mixed.round() as u8;
            }
        }
    }
}

/// The drawn size of the font nearest to a font size of plotters.
fn raster(size: f64) -> RasterHeight {
    if size >= 20.0 { RasterHeight::Size24 } else { RasterHeight::Size16 }
}

fn text_size(text: &str, size: f64) -> (i32, i32) {
    let pixels = |n: usize| i32::try_from(n).unwrap_or(0);
    let letter = get_raster_width(FontWeight::Regular, raster(size));
    (pixels(letter * text.chars().count()), pixels(raster(size).val()))
}

impl DrawingBackend for RasterCanvas {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    fn ensure_prepared(&mut self) -> Result<(), DrawingErrorKind<Infallible>> {
        Ok(())
    }

    fn present(&mut self) -> Result<(), DrawingErrorKind<Infallible>> {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, colour: BackendColor) -> Result<(), DrawingErrorKind<Infallible>> {
        self.blend(at.0, at.1, colour);
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let (width, height) = text_size(text, style.size());
        Ok((width.unsigned_abs(), height.unsigned_abs()))
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &S,
        at: BackendCoord,
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        let (width, height) = text_size(text, style.size());
        let anchor = style.anchor();
        let dx = match anchor.h_pos {
            HPos::Left => 0,
            HPos::Center => -width / 2,
            HPos::Right => -width,
        };
        let dy = match anchor.v_pos {
            VPos::Top => 0,
            VPos::Center => -height / 2,
            VPos::Bottom => -height,
        };
        let letter_width = get_raster_width(FontWeight::Regular, raster(style.size()));
        let colour = style.color();
        for (letter, left) in text.chars().zip((0i32..).step_by(letter_width)) {
            let glyph = |c| get_raster(c, FontWeight::Regular, raster(style.size()));
            let Some(glyph) = glyph(letter).or_else(|| glyph('?')) else { continue };
            for (row, line) in (0i32..).zip(glyph.rows()) {
                for (column, ink) in (0i32..).zip(line) {
                    let (u, v) = (dx + left + column, dy + row);
                    let (u, v) = match style.transform() {
                        FontTransform::None => (u, v),
                        FontTransform::Rotate90 => (-v, u),
                        FontTransform::Rotate180 => (-u, -v),
                        FontTransform::Rotate270 => (v, -u),
                    };
                    let alpha = colour.alpha * f64::from(*ink) / 255.0;
                    self.blend(at.0.saturating_add(u), at.1.saturating_add(v), BackendColor { alpha, ..colour });
                }
            }
        }
        Ok(())
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        plotters_backend::rasterizer::draw_line(self, from, to, style)
    }
}
