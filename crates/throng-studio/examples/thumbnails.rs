//! Renders the thumbnails of the gallery: each scene at its `moment`.
//!
//! usage: cargo run -p throng-studio --example thumbnails [SCENE ...]

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use throng_draw::{Painter, Style};
use throng_record::{Frame, moment};
use throng_scene::gallery;

/// Twice the displayed size.
const SIZE: (u32, u32) = (216, 144);

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("thumbnails");
    std::fs::create_dir_all(&folder)?;
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let mut names = gallery::names().filter(|name| asked.is_empty() || asked.iter().any(|other| other == name));
    names.try_for_each(|name| thumbnail(name, folder.join(format!("{name}.png"))))
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

/// Writes RGBA pixels as an indexed PNG. Colours that are equal apart from their lowest bits share the most frequent
/// colour among them. The number of ignored bits is the smallest that leaves at most 256 colours.
fn write(path: &Path, pixels: &[u8]) -> Result<(), Failure> {
    let cells = |bits: u32| {
        let mut counts: BTreeMap<[u8; 3], BTreeMap<[u8; 3], u32>> = BTreeMap::new();
        for pixel in pixels.chunks_exact(4) {
            let color = [pixel[0], pixel[1], pixel[2]];
            *counts.entry(color.map(|c| c >> bits)).or_default().entry(color).or_default() += 1;
        }
        counts
    };
    let (bits, cells) =
        (0..8).map(|bits| (bits, cells(bits))).find(|(_, cells)| cells.len() <= 256).ok_or("no palette")?;
    let commonest =
        |counts: &BTreeMap<[u8; 3], u32>| counts.iter().max_by_key(|(_, count)| **count).map(|(color, _)| *color);
    let palette: Vec<u8> = cells.values().filter_map(commonest).flatten().collect();
    let keys: Vec<[u8; 3]> = cells.into_keys().collect();
    let index = |pixel: &[u8]| keys.binary_search(&[pixel[0] >> bits, pixel[1] >> bits, pixel[2] >> bits]).unwrap_or(0);
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), SIZE.0, SIZE.1);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_compression(png::Compression::High);
    encoder.set_palette(palette);
    let indices: Vec<u8> = pixels.chunks_exact(4).map(|pixel| index(pixel) as u8).collect();
    encoder.write_header()?.write_image_data(&indices)?;
    Ok(())
}
