//! The trails of a run, also through the moments that a view did not see.

use crate::play::RunMoment;
use throng_draw::{Color, Trails};
use throng_record::Body;

/// Moments further apart than this, in steps, have others between them.
const APART: f64 = 1.5;

/// The trails of a run.
#[derive(Clone, Debug, Default)]
pub struct RunTrails {
    /// The trails.
    pub trails: Trails,
    run: u64,
}

impl RunTrails {
    /// Adds the shown moment, and the moments on the way to it. Moments that are seen only in passing are left out: which of
    /// them a view sees depends on the speed of the machine.
    pub fn follow(&mut self, shown: &RunMoment, seconds: f64, spacing: f64, color: impl Fn(&Body) -> Option<Color>) {
        if self.run != shown.run {
            *self = Self { run: shown.run, ..Self::default() };
        }
        if shown.arriving {
            return;
        }
        let known = !self.trails.tracks.is_empty() && self.trails.last() < shown.frame.time;
        let last = if known { self.trails.last() } else { f64::NEG_INFINITY };
        let mut unseen = shown.wake.iter().filter(|frame| frame.time > last).peekable();
        let gap = |time: f64| known && time - last > APART * shown.scene.time.step;
        if unseen.peek().is_some_and(|frame| gap(frame.time)) {
            self.trails = Trails::default();
        }
        for frame in unseen.map(|frame| &**frame).chain([&*shown.frame]) {
            self.trails.follow(frame, seconds, spacing, &color);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::play::{Command, Engine};
    use std::sync::Arc;
    use std::time::Duration;
    use throng_scene::gallery;

    /// The length of trails, seconds.
    const LENGTH: f64 = 1.5;
    /// The time of a step or two.
    const SHORT: Duration = Duration::from_micros(50);

    /// Follows all moments that the engine publishes until it rests. It works for at most `budget` at a time.
    fn follow(trails: &mut RunTrails, engine: &mut Engine, command: Command, budget: Duration) {
        engine.command(command);
        loop {
            let works = engine.idle().is_some();
            engine.work(budget);
            let shown = engine.shown().unwrap();
            trails.follow(&shown, LENGTH, 0.1, |_| Some(Color::rgb(0)));
            if !works {
                return;
            }
        }
    }

    fn points(trails: &RunTrails) -> Vec<(u32, Vec<(f64, glam::DVec3)>)> {
        trails.trails.tracks.iter().map(|(number, track)| (*number, track.points.iter().copied().collect())).collect()
    }

    #[test]
    fn trails_of_a_step_do_not_depend_on_the_way_to_it() {
        let scene = Arc::new(gallery::scene("circle").unwrap());
        let load = || Command::Load { name: "circle".into(), scene: scene.clone(), run: false };
        let long = Duration::from_secs(100);
        let to = |budget: Duration, steps: &[u64]| {
            let (mut engine, mut trails) = (Engine::default(), RunTrails::default());
            follow(&mut trails, &mut engine, load(), budget);
            steps.iter().for_each(|&step| follow(&mut trails, &mut engine, Command::Seek(step), budget));
            points(&trails)
        };
        let once = to(long, &[100]);
        assert_eq!(once.len(), 36);
        for (number, points) in &once {
            let (from, to) = (points[0].0, points[points.len() - 1].0);
            assert!((2.3..=2.5).contains(&from) && to == 4.0 && points.len() > 5, "{number}: {points:?}");
        }
        assert_eq!(once, to(SHORT, &[100]), "in small parts");
        assert_eq!(once, to(long, &[30, 100]), "the second way begins where trails ended");
        let single: Vec<u64> = (1..=100).collect();
        let near = |a: &[(u32, Vec<(f64, glam::DVec3)>)], b: &[(u32, Vec<(f64, glam::DVec3)>)]| {
            let ends = |trails: &[(u32, Vec<(f64, glam::DVec3)>)]| -> Vec<[glam::DVec3; 2]> {
                trails.iter().map(|(_, points)| [points[0].1, points[points.len() - 1].1]).collect()
            };
            ends(a).iter().zip(ends(b)).all(|(a, b)| a[0].distance(b[0]) < 0.25 && a[1] == b[1])
        };
        assert!(near(&once, &to(long, &single)), "step by step");
        // back: what was later is gone, and the rest stays
        let back = to(long, &[110, 100]);
        assert!(back.iter().all(|(_, points)| points.last().is_some_and(|point| point.0 == 4.0)));
        assert!(back.iter().all(|(_, points)| points[0].0 <= 3.2), "{back:?}");
    }
}
