//! Draws people with all looks, walking: `cargo run --release -p throng-render --example lineup -- lineup.png`. Women are in
//! front, then men, then children.

use glam::{DVec2, DVec3, Mat3, Vec3};
use std::error::Error;
use throng_figure::{Build, LOOKS, Level, Look, Mesh as Figure, Person, Sample, Skeleton, Walk};
use throng_render::{Body, Material, Mesh, Picture, Scene, View, linear};

const SIZE: [u32; 2] = [1920, 760];
/// The distance of neighbours and of rows, metres.
const BESIDE: f64 = 0.85;
const BEHIND: f64 = 1.6;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "lineup.png".into());
    let people = Build::ALL.into_iter().enumerate();
    let people = people.flat_map(|(row, build)| (0..LOOKS).map(move |look| (row, build, look)));
    let meshes = people.map(|(row, build, look)| walker(row, build, look)).collect::<Result<Vec<_>, _>>()?;
    let bodies = meshes.iter().map(|(mesh, place)| Body {
        mesh,
        place: *place,
        turn: Mat3::IDENTITY,
        material: Material::plain(Vec3::ONE),
        thin: false,
    });
    let ground = Some(Material::plain(linear(0xe8_e6e0)));
    let scene = Scene { ground, bodies: bodies.collect(), ..Scene::default() };
    let view = View::look(DVec3::new(-2.0, -9.0, 2.2), DVec3::new(-2.0, 0.5, 0.9), 0.28, SIZE);
    let picture = Picture::render(&scene, &view, SIZE)?;
    let mut encoder = png::Encoder::new(std::fs::File::create(&path)?, SIZE[0], SIZE[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(picture.bytes())?;
    Ok(())
}

/// Returns a person in the middle of its walk, and its place.
fn walker(row: usize, build: Build, look: u8) -> Result<(Mesh<'static>, DVec3), Box<dyn Error>> {
    let person = Person { look, ..Person::new(1, u64::from(look)) }.with_build(build);
    let person = if build == Build::Child { person.with_height(1.2) } else { person };
    let column = f64::from(look);
    let (heading, middle) = (0.3 + 0.55 * column, 2.0 + 0.07 * column);
    let place = DVec2::new(BESIDE * (column - 7.5), BEHIND * row as f64);
    let way = DVec2::from_angle(heading) * 1.3;
    let sample = |time: f64| Sample { time, position: place + way * (time - middle), heading };
    let samples: Vec<Sample> = (0..150).map(|k| sample(f64::from(k) * 0.04)).collect();
    let pose = Walk::recorded(&person, &samples)?.pose(middle);
    let (skeleton, figure, clothes) = (Skeleton::new(&person), Figure::new(build, Level::Fine), Look::new(look));
    let place = place.extend(0.0);
    let (positions, normals) = figure.skinned(&skeleton, person.height, &skeleton.world(&pose), place);
    let light = |[r, g, b]: [u8; 3]| linear(u32::from_be_bytes([0, r, g, b]));
    let colors: Vec<Vec3> = figure.colours(&clothes).into_iter().map(light).collect();
    Ok((Mesh::new(positions, normals, colors, figure.triangles_of(&clothes))?, place))
}
