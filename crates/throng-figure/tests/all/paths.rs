//! Trajectories for the tests.

use glam::DVec2;
use throng_figure::Sample;

/// Returns samples of a body with forward speed, sideways speed (m/s) and angular speed (rad/s) as functions of time.
pub fn driven(rate: f64, duration: f64, drive: impl Fn(f64) -> (f64, f64, f64)) -> Vec<Sample> {
    let (mut position, mut heading) = (DVec2::new(3.0, -2.0), 0.4_f64);
    let fine = 20;
    let step = 1.0 / (rate * f64::from(fine));
    let mut samples = Vec::new();
    for moment in 0..=(duration * rate) as i32 {
        samples.push(Sample { time: f64::from(moment) / rate, position, heading });
        for part in 0..fine {
            let (forward, left, turning) = drive(f64::from(moment) / rate + f64::from(part) * step);
            let ahead = DVec2::new(heading.cos(), heading.sin());
            position += (ahead * forward + ahead.perp() * left) * step;
            heading += turning * step;
        }
    }
    samples
}

/// Returns the named trajectories on which all people are tested, 25 samples a second.
pub fn all() -> Vec<(&'static str, Vec<Sample>)> {
    let on = |start: f64, t: f64| f64::from(t >= start);
    vec![
        ("stands", driven(25.0, 10.0, |_| (0.0, 0.0, 0.0))),
        ("0.05 m/s", driven(25.0, 20.0, |_| (0.05, 0.0, 0.0))),
        ("0.15 m/s", driven(25.0, 12.0, |_| (0.15, 0.0, 0.0))),
        ("0.5 m/s", driven(25.0, 12.0, |_| (0.5, 0.0, 0.0))),
        ("0.9 m/s", driven(25.0, 12.0, |_| (0.9, 0.0, 0.0))),
        ("1.3 m/s", driven(25.0, 12.0, |_| (1.3, 0.0, 0.0))),
        ("1.8 m/s", driven(25.0, 12.0, |_| (1.8, 0.0, 0.0))),
        ("2.1 m/s", driven(25.0, 12.0, |_| (2.1, 0.0, 0.0))),
        ("2.6 m/s", driven(25.0, 12.0, |_| (2.6, 0.0, 0.0))),
        ("3.5 m/s", driven(25.0, 12.0, |_| (3.5, 0.0, 0.0))),
        ("start, stop", driven(25.0, 12.0, move |t| (1.3 * (on(2.0, t) - on(8.0, t)), 0.0, 0.0))),
        ("stop, go", driven(25.0, 12.0, |t| (1.0 * f64::from((t as i64) % 2 == 0), 0.0, 0.0))),
        ("queue", driven(25.0, 20.0, |t| (0.6 * f64::from(t % 3.0 < 0.7), 0.0, 0.0))),
        ("circle 0.5 m", driven(25.0, 12.0, |_| (0.5, 0.0, 1.0))),
        ("circle 1 m", driven(25.0, 12.0, |_| (1.2, 0.0, -1.2))),
        ("sideways 0.3", driven(25.0, 12.0, |_| (0.0, 0.3, 0.0))),
        ("sideways 0.6", driven(25.0, 12.0, |_| (0.0, -0.6, 0.0))),
        ("aslant", driven(25.0, 12.0, |_| (0.8, 0.5, 0.0))),
        ("backwards 0.6", driven(25.0, 12.0, |_| (-0.6, 0.0, 0.0))),
        ("on the spot", driven(25.0, 12.0, |_| (0.0, 0.0, 1.57))),
        ("on the spot, right", driven(25.0, 12.0, |_| (0.0, 0.0, -0.5))),
        ("right angles", driven(25.0, 12.0, |t| (1.3, 0.0, if t % 3.0 > 2.96 { 39.27 } else { 0.0 }))),
        ("about face", driven(25.0, 12.0, |t| (1.0, 0.0, if t % 4.0 > 3.6 { 7.85 } else { 0.0 }))),
        ("wobble", driven(25.0, 12.0, |t| (1.2 + 0.3 * (1.7 * t).sin(), 0.2 * (2.9 * t).sin(), 0.8 * (1.1 * t).sin()))),
        (
            "start, run, stop",
            driven(25.0, 14.0, |t| ((1.2 * (t - 1.0)).clamp(0.0, 3.0).min((13.0 - t).max(0.0)), 0.0, 0.0)),
        ),
    ]
}
