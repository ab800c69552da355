//! Prints the table of `docs/characters.md`: how well feet stand on trajectories, in files of 25 moments a second that
//! are read back at 100 moments a second.
//!
//! `cargo run --release -p throng-figure --example feet`

#![allow(clippy::print_stdout)]

#[path = "../tests/all/paths.rs"]
mod paths;

use throng_figure::measure::{FeetMeasure, FeetReport};
use throng_figure::{Error, Live, Person, Pose, Skeleton, Walk};

const PEOPLE: u64 = 8;

/// Returns the report of poses that are 1/25 s apart.
fn report(person: &Person, poses: &[Pose]) -> FeetReport {
    let skeleton = Skeleton::new(person);
    let mut measure = FeetMeasure::new(person);
    for (moment, pair) in poses.windows(2).enumerate() {
        for quarter in 0..4 {
            let share = f64::from(quarter) / 4.0;
            measure.push((moment as f64 + share) / 25.0, &skeleton.world(&pair[0].towards(&pair[1], share)));
        }
    }
    measure.report()
}

fn main() -> Result<(), Error> {
    println!("| trajectory | recorded: slide, mean | largest | below the ground | live: slide, mean | largest |");
    println!("|---|---|---|---|---|---|");
    for (name, samples) in paths::all() {
        let mut cells = Vec::new();
        for live in [false, true] {
            let (mut mean, mut largest, mut deepest) = (0.0, 0.0_f64, 0.0_f64);
            for number in 0..PEOPLE {
                let person = Person::new(3, number);
                let poses: Vec<Pose> = if live {
                    let mut live = Live::new(person, samples[0])?;
                    samples[1..].iter().map(|sample| live.step(*sample)).collect::<Result<_, _>>()?
                } else {
                    let walk = Walk::recorded(&person, &samples)?;
                    samples.iter().map(|sample| walk.pose(sample.time)).collect()
                };
                let report = report(&person, &poses);
                mean += report.mean_slide / PEOPLE as f64;
                largest = largest.max(report.largest_slide);
                deepest = deepest.max(report.penetration);
            }
            cells.push(format!("{:.1} mm", 1000.0 * mean));
            cells.push(format!("{:.1} mm", 1000.0 * largest));
            if !live {
                cells.push(format!("{:.1} mm", 1000.0 * deepest));
            }
        }
        println!("| {name} | {} |", cells.join(" | "));
    }
    Ok(())
}
