//! `throng measure --feet`: how well the feet of exported people stand.

use super::args::MeasureArgs;
use crate::failure::Failure;
use crate::out::Out;
use serde_json::{Value, json};
use throng_figure::measure::{FeetMeasure, FeetReport};
use throng_record::people::{Figure, Figures};

/// Moments of a measurement for each frame of a file: what readers interpolate counts.
const FINER: f64 = 4.0;

/// Measures the figures of a file.
///
/// # Errors
/// The file cannot be read, or has no figures.
pub fn measure(args: &MeasureArgs, out: &mut Out) -> Result<(), Failure> {
    let name = args.of.display();
    let bytes = std::fs::read(&args.of).map_err(|error| {
        Failure::hint(format!("{name}: {error}"), "--feet reads a file: throng run SCENE -o NAME.glb writes one")
    })?;
    let found = Figures::of_file(&args.of, &bytes)?;
    let step = found.period / FINER;
    let each: Vec<(&Figure, FeetReport)> = found.all.iter().map(|figure| (figure, report(figure, step))).collect();
    let all = over(each.iter().map(|(_, report)| report));
    if args.report.json {
        let person = |(figure, report): &(&Figure, FeetReport)| {
            let mut object = object(report);
            object["number"] = json!(figure.number);
            object["height"] = json!(figure.person.height);
            object
        };
        let mut object = object(&all);
        object["people"] = json!(each.len());
        object["each"] = each.iter().map(person).collect();
        out.line(format_args!("{object}"))?;
    } else if !args.report.quiet {
        let cm = |metres: f64| 100.0 * metres;
        out.line(format_args!("{name}: {} people, {} steps", each.len(), all.steps))?;
        let [mean, most, largest] = [all.mean_slide, all.p95_slide, all.largest_slide].map(cm);
        out.line(format_args!(
            "  slide          {mean:.2} cm a step, 95th percentile {most:.2} cm, largest {largest:.2} cm"
        ))?;
        out.line(format_args!("  skating ratio  {:.2} %", 100.0 * all.skating_ratio))?;
        out.line(format_args!("  below ground   {:.2} cm at most", cm(all.penetration)))?;
        out.line(format_args!("  off the ground {:.2} % of the time", 100.0 * all.airborne))?;
        out.line(format_args!("  feet apart     {:.1} cm at least", cm(all.least_gap)))?;
    }
    out.flush()
}

/// Measures a person at moments `step` seconds apart.
fn report(figure: &Figure, step: f64) -> FeetReport {
    let mut feet = FeetMeasure::new(&figure.person);
    let [from, to] = figure.seconds;
    let moments = ((to - from) / step).round() as usize;
    for second in (0..=moments).map(|k| from + k as f64 * step) {
        if let Some(joints) = figure.joints(second) {
            feet.push(second, &joints);
        }
    }
    feet.report()
}

/// Returns the report of all people: means over steps and moments, and the worst values.
fn over<'r>(each: impl Iterator<Item = &'r FeetReport> + Clone) -> FeetReport {
    let steps: usize = each.clone().map(|report| report.steps).sum();
    let people = each.clone().count().max(1) as f64;
    let over_steps = |of: fn(&FeetReport) -> f64| {
        each.clone().map(|report| of(report) * report.steps as f64).sum::<f64>() / steps.max(1) as f64
    };
    let mean = |of: fn(&FeetReport) -> f64| each.clone().map(of).sum::<f64>() / people;
    let most = |of: fn(&FeetReport) -> f64| each.clone().map(of).fold(0.0, f64::max);
    let least = |of: fn(&FeetReport) -> f64| each.clone().map(of).fold(f64::INFINITY, f64::min);
    FeetReport {
        steps,
        mean_slide: over_steps(|report| report.mean_slide),
        p95_slide: over_steps(|report| report.p95_slide),
        largest_slide: most(|report| report.largest_slide),
        mean_path: over_steps(|report| report.mean_path),
        skating_ratio: mean(|report| report.skating_ratio),
        penetration: most(|report| report.penetration),
        airborne: mean(|report| report.airborne),
        least_gap: least(|report| report.least_gap),
        least_distance: least(|report| report.least_distance),
    }
}

fn object(report: &FeetReport) -> Value {
    json!({
        "steps": report.steps,
        "mean_slide": report.mean_slide,
        "p95_slide": report.p95_slide,
        "largest_slide": report.largest_slide,
        "mean_path": report.mean_path,
        "skating_ratio": report.skating_ratio,
        "penetration": report.penetration,
        "airborne": report.airborne,
        "least_gap": report.least_gap,
    })
}
