//! Makes the thumbnails of the gallery: every scene at the moment that tells what it is about.
//!
//! usage: cargo run -p throng-studio --example thumbnails [SCENE ...]

use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use throng_draw::{Painter, Style};
use throng_record::{Frame, moment};
use throng_scene::gallery;

/// Twice the size that they are shown in.
const SIZE: (u32, u32) = (216, 144);

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("thumbnails");
    std::fs::create_dir_all(&folder)?;
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let names = gallery::names().filter(|name| asked.is_empty() || asked.iter().any(|other| other == name));
    names.map(|name| thumbnail(name, folder.join(format!("{name}.png")))).collect()
}

fn thumbnail(name: &str, path: PathBuf) -> Result<(), Failure> {
    let scene = gallery::scene(name)?;
    let (mut world, built) = scene.build()?;
    let mut frame = Frame::default();
    moment::capture(&world, &mut frame);
    let (width, height) = SIZE;
    let style = Style { width, height, legend: false, trails: 3.0, ..Style::said(&scene) };
    let mut painter = Painter::new(&moment::setting(&world, &built, name), &style, &frame)?;
    while world.time() < scene.moment() && !scene.time.over(&world) {
        painter.follow(&frame);
        world.step();
        moment::capture(&world, &mut frame);
    }
    write(&path, painter.paint(&frame).data())
}

/// Writes red, green, blue and opacity as a picture with a palette: colours lose as few bits as leave 256 of them.
fn write(path: &Path, pixels: &[u8]) -> Result<(), Failure> {
    let rounded = |bits: u32| {
        let round = move |c: u8| ((u32::from(c) + ((1 << bits) >> 1)) >> bits << bits).min(255) as u8;
        let colors = pixels.chunks_exact(4).map(move |p| [round(p[0]), round(p[1]), round(p[2])]);
        colors.collect::<Vec<[u8; 3]>>()
    };
    let palette = |colors: &[[u8; 3]]| colors.iter().copied().collect::<BTreeSet<_>>();
    let colors = (0..8).map(rounded).find(|colors| palette(colors).len() <= 256).ok_or("too many colours")?;
    let palette: Vec<[u8; 3]> = palette(&colors).into_iter().collect();
    let index = |color: &[u8; 3]| palette.binary_search(color).map_or(0, |at| at as u8);
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), SIZE.0, SIZE.1);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_compression(png::Compression::High);
    encoder.set_palette(palette.concat());
    let indices: Vec<u8> = colors.iter().map(index).collect();
    encoder.write_header()?.write_image_data(&indices)?;
    Ok(())
}
