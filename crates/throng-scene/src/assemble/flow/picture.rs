//! Fields and maps from the pixels of pictures.

use super::sketch::SPEED;
use crate::assemble::limits::{Limit, check};
use crate::error::{Error, Kind};
use crate::file::{Problem, read_bytes};
use crate::geometry::DVec2;
use crate::registry::{BuildField, FieldContext};
use crate::scene::flow::{Picture, PixelEncoding};
use glam::Vec2;
use std::f32::consts::TAU;
use std::io::Cursor;
use std::sync::Arc;
use throng::field::Field;
use throng_field::Sampled;

/// Maximum number of pixels of a picture.
const MOST: usize = 1 << 24;

/// A picture: red, green, blue and alpha of each pixel, 0 to 1, row by row from the top.
pub(super) struct Image {
    /// Whether its pixels have colours; else they are grey.
    coloured: bool,
    width: usize,
    pixels: Vec<[f32; 4]>,
}

/// Values decoded from pixels, at the corners of a grid, row by row from the bottom.
pub(super) struct Pixels<T> {
    pub low: DVec2,
    pub cell: f64,
    pub columns: usize,
    pub values: Vec<T>,
}

impl Image {
    /// Decodes the pixels of a picture that covers a box, each at its centre. The outermost pixels are repeated once,
    /// so that the field reaches the edge. Pixels are squares with the width that the box gives them: if the box of
    /// `at` has another height, that is an error.
    pub fn over<T: Copy>(
        &self,
        at: &FieldContext,
        [low, high]: [DVec2; 2],
        says: impl Fn([f32; 4]) -> T,
    ) -> Result<Pixels<T>, Problem> {
        self.fits(at, [low, high])?;
        let (width, height) = (self.width, self.pixels.len() / self.width);
        let cell = (high.x - low.x) / width as f64;
        let columns = width + 2;
        let clamp = |at: usize, count: usize| at.saturating_sub(1).min(count - 1);
        let value = |row: usize, column: usize| {
            let (row, column) = (height - 1 - clamp(row, height), clamp(column, width));
            says(self.pixels[row * width + column])
        };
        let values = (0..height + 2).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let values = values.map(|(row, column)| value(row, column)).collect();
        Ok(Pixels { low: low - 0.5 * cell, cell, columns, values })
    }

    /// Checks that pixels are squares, within half a pixel of the height.
    fn fits(&self, at: &FieldContext, [low, high]: [DVec2; 2]) -> Result<(), Problem> {
        let (width, height) = (self.width as f64, (self.pixels.len() / self.width) as f64);
        let (size, pixel) = (high - low, (high.x - low.x) / width);
        if (size.y / pixel - height).abs() < 0.5 {
            return Ok(());
        }
        let message = format!(
            "a picture of {width} x {height} pixels lies over {:.2} m x {:.2} m: its pixels are not square",
            size.x, size.y
        );
        let hint = format!("max is {:.3} m above min", pixel * height);
        Err(Problem::new(&at.path.key("max"), Kind::Geometry, message).hint(hint))
    }
}

/// Reads a PNG file; its name is relative to the scene file.
pub(super) fn read(at: &FieldContext, name: &str) -> Result<Image, Problem> {
    let path = at.path.key("file");
    let file = at.scene.folder().join(name);
    let shown = file.display().to_string();
    let problem = |error: Error| {
        let problem = Problem::new(&path, error.kind, error.message);
        Problem { hint: error.hint, ..problem }
    };
    let bytes = read_bytes(&file).map_err(problem)?;
    let no_png = |error: png::DecodingError| {
        let problem = Problem::new(&path, Kind::Syntax, format!("{shown} cannot be read as PNG: {error}"));
        problem.hint("save it as PNG, 8 or 16 bits a channel")
    };
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
    let mut reader = decoder.read_info().map_err(no_png)?;
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    if width.saturating_mul(height) > MOST {
        let message = format!("{shown} has {width} x {height} pixels, but may have at most {MOST}");
        return Err(Problem::new(&path, Kind::Count, message).hint("scale it down"));
    }
    let mut bytes = vec![0; reader.output_buffer_size().unwrap_or(0)];
    let frame = reader.next_frame(&mut bytes).map_err(no_png)?;
    let bytes = &bytes[..frame.buffer_size()];
    let values: Vec<f32> = match frame.bit_depth {
        png::BitDepth::Sixteen => {
            let pairs = bytes.as_chunks().0.iter();
            pairs.map(|&pair| f32::from(u16::from_be_bytes(pair)) / f32::from(u16::MAX)).collect()
        }
        _ => bytes.iter().map(|&byte| f32::from(byte) / 255.0).collect(),
    };
    let coloured = matches!(frame.color_type, png::ColorType::Rgba | png::ColorType::Rgb);
    let pixels = match frame.color_type {
        png::ColorType::Rgba => values.as_chunks().0.to_vec(),
        png::ColorType::Rgb => values.as_chunks().0.iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect(),
        png::ColorType::GrayscaleAlpha => values.as_chunks().0.iter().map(|&[grey, a]| [grey, grey, grey, a]).collect(),
        _ => values.iter().map(|&grey| [grey, grey, grey, 1.0]).collect(),
    };
    Ok(Image { coloured, width, pixels })
}

impl BuildField for Picture {
    fn make(&self, at: &FieldContext) -> Result<Arc<dyn Field>, Problem> {
        let corners = at.corners(self.min, self.max)?;
        let speed = self.speed.unwrap_or(SPEED);
        check(&at.path.key("speed"), speed, Limit::UpTo(1000.0))?;
        let picture = read(at, &self.file)?;
        if !picture.coloured {
            let message = format!("{} is grey: its pixels give a speed, but no direction", self.file);
            let problem = Problem::new(&at.path.key("file"), Kind::WrongType, message);
            return Err(problem.hint("a flow map has red for x and green for y; a grey picture can be a `map`"));
        }
        let speed = speed as f32;
        let encoding = self.encoding.unwrap_or_default();
        let velocity = |[red, green, blue, alpha]: [f32; 4]| match encoding {
            PixelEncoding::FlowMap => {
                // 8 bits have no value for half of the range: values within 0.6 of a step of it are zero
                let part = |value: f32| if (value - 0.5).abs() < 0.6 / 255.0 { 0.0 } else { 2.0 * value - 1.0 };
                Vec2::new(part(red), part(green)) * (speed * alpha)
            }
            PixelEncoding::Direction => {
                let most = red.max(green).max(blue);
                let range = most - red.min(green).min(blue);
                if range == 0.0 {
                    return Vec2::ZERO;
                }
                let sixth = match most {
                    _ if most == red => (green - blue) / range,
                    _ if most == green => (blue - red) / range + 2.0,
                    _ => (red - green) / range + 4.0,
                };
                let (sin, cos) = libm::sincosf(sixth * (TAU / 6.0));
                Vec2::new(cos, sin) * (speed * range * alpha)
            }
        };
        let Pixels { low, cell, columns, values } = picture.over(at, corners, velocity)?;
        Ok(Arc::new(Sampled::new(low, cell, columns, values).map_err(|error| at.refused(&error))?))
    }
}
