//! Times fields through anchors: `cargo run --release -p throng-bench --example field_timing`.
#![allow(clippy::print_stdout)]

#[path = "shared/median.rs"]
mod median;

use glam::DVec2;
use median::median;
use std::hint::black_box;
use throng_field::{Anchor, Anchors, Sampled, Sketch};

/// Anchors at random in a square of 100 m, each with a random velocity.
fn anchors(count: usize) -> Vec<Anchor> {
    let mut state = 7_u64;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut vector = |size: f64| DVec2::new(draw(), draw()) * size;
    (0..count).map(|_| Anchor::new(vector(100.0), vector(2.0) - 1.0)).collect()
}

/// Returns milliseconds.
fn time(work: impl FnMut()) -> f64 {
    median(work) * 1e3
}

fn main() -> Result<(), throng::Error> {
    for count in [100, 1000, 2000] {
        let all = anchors(count);
        let mut field = Anchors::new(&all, Sketch::default())?;
        println!("{count} anchors");
        println!(
            "  made                       {:8.2} ms",
            time(|| drop(black_box(Anchors::new(&all, Sketch::default()))))
        );
        let drag = time(|| field.set_velocity(0, DVec2::X).expect("it is there"));
        println!("  a velocity dragged         {drag:8.2} ms");
        let (low, high) = (DVec2::ZERO, DVec2::splat(102.2));
        let sample = time(|| drop(black_box(Sampled::of(&field, low, high, 0.2, 0.0))));
        println!("  a grid of 512 x 512        {sample:8.2} ms");
    }
    Ok(())
}
