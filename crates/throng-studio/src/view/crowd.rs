//! Agents and their trails as geometry, made anew when the state is.

use super::colors::Colors;
use super::geometry::{Disc, Geometry};
use crate::play::Shown;
use crate::settings::Settings;
use std::sync::Arc;
use throng_draw::Trails;
use throng_record::Frame;

/// Points of a trail are this far apart, in radii of a body.
const SPACING: f64 = 0.6;
/// Of more agents than this no trails are drawn.
const MOST_TRAILS: usize = 5000;

/// The agents as they were drawn last.
#[derive(Default)]
pub struct Crowd {
    trails: Trails,
    of: Option<(Arc<Frame>, Settings, u64)>,
    layers: [Arc<Geometry>; 2],
}

impl Crowd {
    /// Trails, and agents.
    pub fn layers(&mut self, shown: &Shown, settings: &Settings, colors: &dyn Fn() -> Colors) -> [Arc<Geometry>; 2] {
        let same = |(frame, with, run): &(Arc<Frame>, Settings, u64)| {
            Arc::ptr_eq(frame, &shown.frame) && with == settings && *run == shown.run
        };
        if !self.of.as_ref().is_some_and(same) {
            if self.of.as_ref().is_some_and(|(_, _, run)| *run != shown.run) {
                self.trails = Trails::default();
            }
            let colors = colors();
            self.layers = [Arc::new(self.trails(shown, settings, &colors)), Arc::new(agents(shown, &colors))];
            self.of = Some((shown.frame.clone(), settings.clone(), shown.run));
        }
        self.layers.clone()
    }

    fn trails(&mut self, shown: &Shown, settings: &Settings, colors: &Colors) -> Geometry {
        let mut ribbons = Geometry::default();
        let seconds = if shown.frame.bodies.len() > MOST_TRAILS { 0.0 } else { f64::from(settings.trails) };
        let radius = shown.frame.bodies.first().map_or(0.2, |body| f64::from(body.radius));
        self.trails.follow(&shown.frame, seconds, SPACING * radius, |body| Some(colors.coat(body).fill));
        if seconds <= 0.0 {
            return ribbons;
        }
        let origin = shown.setting.origin.extend(0.0);
        for track in self.trails.tracks.values() {
            let Some(color) = track.color else { continue };
            let points = track.fading(shown.frame.time, seconds);
            let ends: Vec<_> =
                points.map(|(at, half, opacity)| ((at - origin).as_vec3(), half, color.alpha(opacity))).collect();
            ribbons.ribbon(&ends);
        }
        ribbons
    }
}

fn agents(shown: &Shown, colors: &Colors) -> Geometry {
    let (before, now) = (&shown.before.bodies, &shown.frame.bodies);
    let origin = shown.setting.origin;
    let mut agents = Geometry::default();
    agents.discs.reserve(now.len());
    let mut k = 0;
    for body in now {
        // both are by number
        while before.get(k).is_some_and(|other| other.number < body.number) {
            k += 1;
        }
        let from = before.get(k).filter(|other| other.number == body.number).unwrap_or(body);
        agents.discs.push(Disc::agent(from, body, colors.coat(body), origin));
    }
    if shown.setting.in_space {
        // from above, who is higher hides who is lower
        agents.discs.sort_by(|a, b| a.altitude().total_cmp(&b.altitude()));
    }
    agents
}
