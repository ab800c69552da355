//! Plots steps over speed beside published curves: `cargo run --release -p throng-figure --example gait > gait.svg`.

#![allow(clippy::print_stdout)]

use glam::DVec2;
use std::fmt::Write;
use throng_figure::{Error, Person, Sample, Side, Walk};

/// The height of the person, metres.
const HEIGHT: f64 = 1.75;
/// The size of a plot, and the space around it, pixels.
const SIZE: [f64; 2] = [250.0, 220.0];
const MARGIN: [f64; 2] = [52.0, 40.0];
/// The speeds of the plots, m/s.
const SPEEDS: [f64; 2] = [0.2, 2.0];
const INK: &str = "#33383f";
const COLORS: [&str; 3] = ["#35719a", "#b2423a", "#8a6d1f"];

/// A published curve: its name, and its value at a speed.
type Curve = (&'static str, fn(f64) -> f64);

/// A plot: its title, the limits and the step of its axis, and what is drawn.
struct Plot {
    title: &'static str,
    limits: [f64; 2],
    step: f64,
    /// The value of steps: length (m), number a minute, share of the cycle on the ground.
    value: fn([f64; 3]) -> f64,
    curves: &'static [Curve],
}

const PLOTS: [Plot; 3] = [
    Plot {
        title: "length of steps, m",
        limits: [0.2, 1.0],
        step: 0.2,
        value: |steps| steps[0],
        curves: &[("Grieve, Gear 1966", grieve), ("Inman 1981", inman)],
    },
    Plot {
        title: "steps a minute",
        limits: [40.0, 160.0],
        step: 20.0,
        value: |steps| steps[1],
        curves: &[("Grieve, Gear 1966", |v| 60.0 * v / grieve(v)), ("Inman 1981", |v| 60.0 * v / inman(v))],
    },
    Plot {
        title: "share of the cycle on the ground",
        limits: [0.5, 0.75],
        step: 0.05,
        value: |steps| steps[2],
        curves: &[("Kirtley 1985", |v| 0.642 - 0.035 * v), ("Hansen 2017", |v| 0.629 - 0.034 * v)],
    },
];

fn grieve(v: f64) -> f64 {
    0.463 * HEIGHT * (v / HEIGHT).powf(0.43)
}

fn inman(v: f64) -> f64 {
    (0.24 * HEIGHT * v).sqrt()
}

/// Returns the mean length of steps (m), their number a minute, and the share of the cycle on the ground, of a walk of
/// half a minute at a speed (m/s): read off its footfalls.
fn steps(speed: f64) -> Result<[f64; 3], Error> {
    let person = Person { stride: 1.0, ..Person::new(2, 3) }.with_height(HEIGHT);
    let sample = |moment: u32| {
        let time = f64::from(moment) / 25.0;
        Sample { time, position: DVec2::new(speed * time, 0.0), heading: 0.0 }
    };
    let walk = Walk::recorded(&person, &(0..1000).map(sample).collect::<Vec<_>>())?;
    let plants: Vec<_> = walk.plants(Side::Left).filter(|plant| plant.strike > 5.0 && plant.lift < 35.0).collect();
    let cycles = (plants.len() - 1) as f64;
    let (first, last) = (plants[0], plants[plants.len() - 1]);
    let cycle = (last.strike - first.strike) / cycles;
    let ground: f64 = plants[..plants.len() - 1].iter().map(|plant| plant.lift - plant.strike).sum();
    Ok([first.ankle.distance(last.ankle) / cycles / 2.0, 120.0 / cycle, ground / cycles / cycle])
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let speeds: Vec<f64> = (2..=19).map(|tenths| f64::from(tenths) / 10.0).collect();
    let measured = speeds.iter().map(|&speed| steps(speed)).collect::<Result<Vec<_>, _>>()?;
    let [wide, high] = [SIZE[0] + MARGIN[0] + 12.0, SIZE[1] + 2.0 * MARGIN[1]];
    let mut svg = String::new();
    writeln!(
        svg,
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{}" height="{high}" font-family="sans-serif" font-size="11" fill="{INK}">
<rect width="100%" height="100%" fill="white"/>"#,
        wide * PLOTS.len() as f64
    )?;
    for (k, plot) in PLOTS.iter().enumerate() {
        let left = wide * k as f64 + MARGIN[0];
        let x = |speed: f64| left + SIZE[0] * (speed - SPEEDS[0]) / (SPEEDS[1] - SPEEDS[0]);
        let y = |value: f64| MARGIN[1] + SIZE[1] * (1.0 - (value - plot.limits[0]) / (plot.limits[1] - plot.limits[0]));
        writeln!(svg, r#"<text x="{left}" y="{}" font-size="13">{}</text>"#, MARGIN[1] - 14.0, plot.title)?;
        for line in 0..=((plot.limits[1] - plot.limits[0]) / plot.step).round() as u32 {
            let value = plot.limits[0] + f64::from(line) * plot.step;
            let (at, to) = (y(value), left + SIZE[0]);
            writeln!(svg, r##"<path d="M{left} {at:.1}H{to}" stroke="#ddd" fill="none"/>"##)?;
            let label = (value * 100.0).round() / 100.0;
            writeln!(svg, r#"<text x="{}" y="{:.1}" text-anchor="end">{label}</text>"#, left - 6.0, at + 4.0)?;
        }
        for speed in [0.5, 1.0, 1.5, 2.0] {
            let below = MARGIN[1] + SIZE[1] + 16.0;
            writeln!(svg, r#"<text x="{:.1}" y="{below}" text-anchor="middle">{speed} m/s</text>"#, x(speed))?;
        }
        for (row, (name, curve)) in plot.curves.iter().enumerate() {
            let points = speeds.iter().map(|&speed| format!("{:.1},{:.1}", x(speed), y(curve(speed))));
            let points = points.collect::<Vec<_>>().join(" ");
            let color = COLORS[row];
            writeln!(svg, r#"<polyline points="{points}" stroke="{color}" stroke-width="1.5" fill="none"/>"#)?;
            let under = MARGIN[1] + 16.0 + 15.0 * row as f64;
            writeln!(svg, r#"<text x="{}" y="{under}" fill="{color}">{name}</text>"#, left + 8.0)?;
        }
        for (&speed, &steps) in speeds.iter().zip(&measured) {
            writeln!(svg, r#"<circle cx="{:.1}" cy="{:.1}" r="2.6"/>"#, x(speed), y((plot.value)(steps)))?;
        }
        let under = MARGIN[1] + 16.0 + 15.0 * plot.curves.len() as f64;
        writeln!(svg, r#"<text x="{}" y="{under}">● footfalls of throng</text>"#, left + 8.0)?;
    }
    println!("{svg}</svg>");
    Ok(())
}
