//! Times curl noise: `cargo run --release -p throng-bench --example noise_timing`.
#![allow(clippy::print_stdout)]

#[path = "shared/median.rs"]
mod median;

use glam::Vec3;
use median::median;
use std::hint::black_box;
use throng::Error;
use throng::field::Field;
use throng::space::surface::{Cylinder, Sphere};
use throng_field::{CurlNoise, NoiseWall, Octave, Potential};

/// Random places in a cube of 10 m.
fn places(count: usize) -> Vec<Vec3> {
    let mut state = 7_u64;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f32 / (1_u64 << 53) as f32
    };
    (0..count).map(|_| Vec3::new(draw(), draw(), draw()) * 10.0).collect()
}

/// Returns nanoseconds per place.
fn time(count: usize, work: impl FnMut()) -> f64 {
    median(work) * 1e9 / count as f64
}

fn main() -> Result<(), Error> {
    let places = places(200_000);
    let numbers: Vec<u32> = (0..places.len() as u32).collect();
    let mut out = vec![Vec3::ZERO; places.len()];
    println!("nanoseconds per place, one thread");
    println!(
        "{:10} {:>12} {:>12} {:>12} {:>12} {:>12}",
        "", "1 octave", "3 octaves", "individuals", "one at a time", "two walls"
    );
    for potential in [Potential::Plane, Potential::Space, Potential::Crossed] {
        let noise = |octaves: usize| CurlNoise::new(potential, &Octave::turbulence(0.4, 0.5, 1.0, octaves)?, 1);
        let (one, three) = (noise(1)?, noise(3)?);
        let lamp = NoiseWall::new(Sphere::new(Vec3::splat(5.0), 0.5)?, 0.4)?;
        let column = NoiseWall::new(Cylinder::new(Vec3::X * 3.0, Vec3::new(3.0, 0.0, 10.0), 0.5)?, 0.4)?;
        let walls = noise(1)?.with_wall(lamp).with_wall(column);
        let count = places.len();
        let all = [
            time(count, || one.velocities(&places, 1.0, black_box(&mut out))),
            time(count, || three.velocities(&places, 1.0, black_box(&mut out))),
            time(count, || one.velocities_of_individuals(&places, &numbers, 1.0, black_box(&mut out))),
            time(count, || out.iter_mut().zip(&places).for_each(|(out, &place)| *out = one.velocity(place, 1.0))),
            time(count, || walls.velocities(&places, 1.0, black_box(&mut out))),
        ];
        print!("{:10}", format!("{potential:?}"));
        all.iter().for_each(|nanoseconds| print!(" {nanoseconds:12.1}"));
        println!();
    }
    Ok(())
}
