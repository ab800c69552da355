//! Renders a plaza with 200 people: `cargo run --release -p throng-render --example plaza -- plaza.png`. A second argument
//! is how often it is rendered; the times are printed.

#![allow(clippy::print_stdout)]

mod scene;

use scene::{Plaza, SIZE, view};
use std::error::Error;
use std::time::Instant;
use throng_render::Picture;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().unwrap_or_else(|| "plaza.png".into());
    let frames: usize = arguments.next().map_or(Ok(5), |count| count.parse())?;
    let (plaza, view) = (Plaza::new(200), view());
    let scene = plaza.scene();
    let mut picture = Picture::render(&scene, &view, SIZE)?;
    for _ in 1..frames {
        let start = Instant::now();
        picture = Picture::render(&scene, &view, SIZE)?;
        println!("{:.1} ms", start.elapsed().as_secs_f64() * 1e3);
    }
    let mut encoder = png::Encoder::new(std::fs::File::create(&path)?, SIZE[0], SIZE[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(picture.bytes())?;
    Ok(())
}
