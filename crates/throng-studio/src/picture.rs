//! Screenshots of the window.

use eframe::egui::{ColorImage, Rect};

/// Encodes an image as PNG.
///
/// # Errors
/// The image has no pixels.
pub fn png(image: &ColorImage) -> Result<Vec<u8>, png::EncodingError> {
    let [width, height] = image.size.map(|side| side as u32);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(image.as_raw())?;
    Ok(bytes)
}

/// Cuts a screenshot of the window to `rect`, given in points.
pub fn part(image: &ColorImage, rect: Rect, pixels_per_point: f32) -> ColorImage {
    let [width, height] = image.size.map(|side| side as f32 / pixels_per_point);
    let whole = Rect::from_min_max([0.0, 0.0].into(), [width, height].into());
    let part = rect.intersect(whole);
    if part.is_positive() { image.region(&part, Some(pixels_per_point)) } else { image.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::Color32;

    #[test]
    fn a_part_of_the_window_becomes_a_file() {
        let mut image = ColorImage::filled([8, 6], Color32::BLACK);
        image.pixels[2 * 8 + 4] = Color32::WHITE;
        let view = part(&image, Rect::from_min_max([2.0, 1.0].into(), [99.0, 99.0].into()), 2.0);
        assert_eq!((view.size, view.pixels[0]), ([4, 4], Color32::WHITE));
        let file = png(&view).unwrap();
        let read = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        assert_eq!((read.info().width, read.info().height), (4, 4));
        assert!(png(&ColorImage::default()).is_err());
    }
}
