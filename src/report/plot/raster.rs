//! A pixel surface for plotters: antialiased paths (tiny-skia) and a drawn font (Noto Sans Mono, SIL Open Font License), encoded
//! as PNG. No font files, the same bytes everywhere.
//!
//! Coordinates and stroke widths are in tenths of a pixel ([`SUBPIXELS`]).

use super::SUBPIXELS;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};
use plotters::style::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontTransform,
};
use std::convert::Infallible;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, PremultipliedColorU8, Rect, Stroke, Transform,
};

/// An RGB image.
pub struct RasterCanvas {
    /// `None` where no image of that size fits into memory.
    image: Option<Pixmap>,
    size: (u32, u32),
}

impl RasterCanvas {
    /// A white image of so many pixels.
    pub fn new(width: u32, height: u32) -> Self {
        let mut image = Pixmap::new(width, height);
        if let Some(image) = &mut image {
            image.fill(Color::WHITE);
        }
        RasterCanvas { image, size: (width, height) }
    }

    /// The image as PNG.
    ///
    /// # Errors
    /// An image of no size, which the encoder refuses.
    pub fn encode(&self) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.size.0, self.size.1);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        let pixels = self.image.iter().flat_map(|image| image.pixels());
        let colours: Vec<u8> = pixels.flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
        writer.write_image_data(&colours)?;
        writer.finish()?;
        Ok(bytes)
    }

    /// Lays a colour over one pixel; the image is opaque everywhere.
    fn blend(&mut self, x: i32, y: i32, (r, g, b): (u8, u8, u8), alpha: f64) {
        let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return };
        let Some(image) = self.image.as_mut().filter(|_| x < self.size.0 && y < self.size.1) else { return };
        let position = y as usize * self.size.0 as usize + x as usize;
        let Some(pixel) = image.pixels_mut().get_mut(position) else { return };
        let mix = |old: u8, new: u8| (f64::from(old) * (1.0 - alpha) + f64::from(new) * alpha).round() as u8;
        let mixed = [mix(pixel.red(), r), mix(pixel.green(), g), mix(pixel.blue(), b)];
        if let Some(mixed) = PremultipliedColorU8::from_rgba(mixed[0], mixed[1], mixed[2], 255) {
            *pixel = mixed;
        }
    }

    fn fill(&mut self, path: Option<Path>, colour: BackendColor) {
        if let (Some(image), Some(path)) = (&mut self.image, path) {
            image.fill_path(&path, &paint(colour), FillRule::Winding, Transform::identity(), None);
        }
    }

    fn stroke<S: BackendStyle>(&mut self, path: Option<Path>, style: &S) {
        if let (Some(image), Some(path)) = (&mut self.image, path) {
            let width = (style.stroke_width() as f32 / SUBPIXELS as f32).max(0.1);
            let stroke = Stroke { width, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() };
            image.stroke_path(&path, &paint(style.color()), &stroke, Transform::identity(), None);
        }
    }
}

/// Pixels of a coordinate in tenths of a pixel.
fn pixels(at: i32) -> f32 {
    at as f32 / SUBPIXELS as f32
}

fn paint(colour: BackendColor) -> Paint<'static> {
    let (r, g, b) = colour.rgb;
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, (255.0 * colour.alpha.clamp(0.0, 1.0)).round() as u8);
    paint
}

/// A path through points; closed or open.
fn path(points: impl IntoIterator<Item = BackendCoord>, closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for (index, (x, y)) in points.into_iter().enumerate() {
        if index == 0 {
            builder.move_to(pixels(x), pixels(y));
        } else {
            builder.line_to(pixels(x), pixels(y));
        }
    }
    if closed {
        builder.close();
    }
    builder.finish()
}

/// The drawn size of the font nearest to a font size in tenths of a pixel.
fn raster(size: f64) -> RasterHeight {
    if size >= 20.0 * f64::from(SUBPIXELS) { RasterHeight::Size24 } else { RasterHeight::Size16 }
}

/// Width and height of a text (pixels).
fn text_size(text: &str, size: f64) -> (i32, i32) {
    let whole = |n: usize| i32::try_from(n).unwrap_or(i32::MAX / SUBPIXELS);
    let letter = get_raster_width(FontWeight::Regular, raster(size));
    (whole(letter.saturating_mul(text.chars().count())), whole(raster(size).val()))
}

impl DrawingBackend for RasterCanvas {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        let tenths = |n: u32| n.saturating_mul(SUBPIXELS.unsigned_abs());
        (tenths(self.size.0), tenths(self.size.1))
    }

    fn ensure_prepared(&mut self) -> Result<(), DrawingErrorKind<Infallible>> {
        Ok(())
    }

    fn present(&mut self) -> Result<(), DrawingErrorKind<Infallible>> {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, colour: BackendColor) -> Result<(), DrawingErrorKind<Infallible>> {
        let dot = Rect::from_xywh(pixels(x), pixels(y), 1.0, 1.0);
        self.fill(dot.map(PathBuilder::from_rect), colour);
        Ok(())
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        self.stroke(path([from, to], false), style);
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        self.stroke(path(points, false), style);
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (left, top): BackendCoord,
        (right, bottom): BackendCoord,
        style: &S,
        fill: bool,
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        let corners = path([(left, top), (right, top), (right, bottom), (left, bottom)], true);
        if fill {
            self.fill(corners, style.color())
        } else {
            self.stroke(corners, style)
        }
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        (x, y): BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        let circle = PathBuilder::from_circle(pixels(x), pixels(y), radius as f32 / SUBPIXELS as f32);
        if fill {
            self.fill(circle, style.color())
        } else {
            self.stroke(circle, style)
        }
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &S,
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        self.fill(path(corners, true), style.color());
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let (width, height) = text_size(text, style.size());
        let tenths = |n: i32| n.saturating_mul(SUBPIXELS).unsigned_abs();
        Ok((tenths(width), tenths(height)))
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
        let (r, g, b) = colour.rgb;
        let origin = (pixels(at.0).round() as i32, pixels(at.1).round() as i32);
        for (letter, left) in text.chars().zip((0i32..).step_by(letter_width)) {
            let glyph = |c| get_raster(c, FontWeight::Regular, raster(style.size()));
            let Some(glyph) = glyph(letter).or_else(|| glyph('?')) else { continue };
            for (row, line) in (0i32..).zip(glyph.rows()) {
                for (column, ink) in (0i32..).zip(line).filter(|(_, ink)| **ink > 0) {
                    let (u, v) = (dx + left + column, dy + row);
                    let (u, v) = match style.transform() {
                        FontTransform::None => (u, v),
                        FontTransform::Rotate90 => (-v, u),
                        FontTransform::Rotate180 => (-u, -v),
                        FontTransform::Rotate270 => (v, -u),
                    };
                    let alpha = colour.alpha * f64::from(*ink) / 255.0;
                    self.blend(origin.0.saturating_add(u), origin.1.saturating_add(v), (r, g, b), alpha);
                }
            }
        }
        Ok(())
    }
}
