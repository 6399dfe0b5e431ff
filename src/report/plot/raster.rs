//! A pixel surface for plotters with a bitmap font, encoded as PNG: no font files, the same bytes everywhere.

use font8x8::UnicodeFonts;
use plotters::style::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontTransform,
};
use std::convert::Infallible;

/// An RGB image.
pub struct Canvas {
    width: u32,
    height: u32,
    pixels: Vec<u8>,
}

impl Canvas {
    /// A white image.
    pub fn new(width: u32, height: u32) -> Self {
        Canvas { width, height, pixels: vec![255; 3 * width as usize * height as usize] }
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

/// Pixels of a glyph per unit of its 8 by 8 grid, for a font size: whole numbers keep the letters sharp.
fn magnification(size: f64) -> i32 {
    if size >= 20.0 { 2 } else { 1 }
}

fn text_size(text: &str, size: f64) -> (i32, i32) {
    let scale = magnification(size);
    (8 * scale * i32::try_from(text.chars().count()).unwrap_or(0), 8 * scale)
}

impl DrawingBackend for Canvas {
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
        let scale = magnification(style.size());
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
        for (index, letter) in text.chars().enumerate() {
            let glyph = font8x8::BASIC_FONTS.get(letter).or_else(|| font8x8::BASIC_FONTS.get('?')).unwrap_or([0; 8]);
            let left = dx + 8 * scale * i32::try_from(index).unwrap_or(0);
            for (row, bits) in (0i32..).zip(glyph) {
                for column in (0..8).filter(|c| bits & (1u8 << c) != 0) {
                    for (i, j) in (0..scale).flat_map(|i| (0..scale).map(move |j| (i, j))) {
                        let (u, v) = (left + scale * column + i, dy + scale * row + j);
                        let (u, v) = match style.transform() {
                            FontTransform::None => (u, v),
                            FontTransform::Rotate90 => (-v, u),
                            FontTransform::Rotate180 => (-u, -v),
                            FontTransform::Rotate270 => (v, -u),
                        };
                        self.blend(at.0 + u, at.1 + v, style.color());
                    }
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
