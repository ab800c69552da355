//! Times flows to goals: `cargo run --release -p throng-bench --example goal_timing`.
#![allow(clippy::print_stdout)]

#[path = "shared/median.rs"]
mod median;

use glam::{DVec2, Vec2, Vec3};
use median::median;
use std::hint::black_box;
use std::sync::Arc;
use throng::Obstacle;
use throng::field::Field;
use throng::space::Place;
use throng_field::{Density, Destination, Terrain, TerrainSettings, ToGoal};

/// Returns milliseconds.
fn time(work: impl FnMut()) -> f64 {
    median(work) * 1e3
}

/// Pillars every 8 m.
fn pillars(size: f64) -> Place {
    let side = (size / 8.0) as usize;
    let pillar = |k: usize| {
        let center = DVec2::new((k % side) as f64 + 0.5, (k / side) as f64 + 0.5) * 8.0;
        Some(Obstacle::Circle { center, radius: 1.0 })
    };
    Place { areas: vec![], obstacles: (0..side * side).map(pillar).collect() }
}

fn main() -> Result<(), throng::Error> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread");
    pool.install(|| {
        for count in [128, 256, 512, 1024] {
            let size = f64::from(count) * 0.25;
            for (what, place) in [("open", Place::default()), ("pillars", pillars(size))] {
                let survey = TerrainSettings { high: DVec2::splat(size), ..TerrainSettings::default() };
                let ground = Arc::new(Terrain::of_place(&place, DVec2::ZERO, survey)?);
                let goal = Destination::Point { at: DVec2::splat(0.5 * size + 0.07), tolerance: 0.2 };
                let flow = ToGoal::new(ground.clone(), vec![goal], 1.3)?;
                println!("{count} x {count}, {what}");
                let surveyed = || drop(black_box(Terrain::of_place(&place, DVec2::ZERO, survey)));
                println!("  surveyed                   {:8.2} ms", time(surveyed));
                let goals = flow.goals().to_vec();
                let made = || drop(black_box(ToGoal::new(ground.clone(), goals.clone(), 1.3)));
                println!("  construction of the flow   {:8.2} ms", time(made));
                let people =
                    |k: u32| Vec2::new((k * 7919 % 5003) as f32, (k * 104_729 % 5003) as f32) * (size as f32 / 5003.0);
                let density = Density::of(&ground, (0..5000).map(people), 1.0)?;
                let counted = || drop(black_box(Density::of(&ground, (0..5000).map(people), 1.0)));
                println!("  density of 5,000 people    {:8.2} ms", time(counted));
                let mut led = flow.clone();
                let again = || led.avoid_crowds(density.cells(), 1.0).expect("a density");
                println!("  led round them             {:8.2} ms", time(again));
                let asked = || {
                    let all = (0..5000).map(people).map(|at| flow.velocity(at.extend(0.0), 0.0));
                    black_box(all.sum::<Vec3>());
                };
                println!("  asked by 5,000 people      {:8.2} ms", time(asked));
            }
        }
        Ok(())
    })
}
