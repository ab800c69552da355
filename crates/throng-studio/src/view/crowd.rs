//! Geometry of agents and trails. It is rebuilt for each new state.

use super::colors::Coloring;
use super::geometry::{Disc, Figure, Geometry};
use super::key::{self, Row};
use super::moment::pairs;
use super::people::{self, PersonLook};
use super::trails::RunTrails;
use crate::play::{PosesBetween, RunMoment};
use crate::settings::Settings;
use std::sync::Arc;
use throng_draw::{AgentShape, Look};
use throng_record::Frame;

/// The spacing of trail points, in radii of a body. It grows in proportion beyond `MANY` agents.
const SPACING: f64 = 0.6;
const MANY: f64 = 5000.0;
/// Beyond this number of agents no trails are drawn.
const MOST_TRAILS: usize = 20_000;

/// What the agents are drawn from: the state, the people of it, the settings, the run, and whether in a plan.
struct CrowdKey {
    frame: Arc<Frame>,
    people: PosesBetween,
    settings: Settings,
    run: u64,
    arriving: bool,
    plan: bool,
}

impl CrowdKey {
    fn is(&self, shown: &RunMoment, settings: &Settings, plan: bool) -> bool {
        let people = self.people.iter().map(Arc::as_ptr).eq(shown.people.iter().map(Arc::as_ptr));
        let same = people && Arc::ptr_eq(&self.frame, &shown.frame) && self.run == shown.run;
        same && self.arriving == shown.arriving && self.settings == *settings && self.plan == plan
    }
}

/// The agents as drawn last.
#[derive(Default)]
pub struct Crowd {
    trails: RunTrails,
    of: Option<CrowdKey>,
    /// The distance that each agent has moved, metres, by number.
    ways: Vec<(u32, f32)>,
    layers: [Arc<Geometry>; 2],
    /// How people are drawn, in the order of the poses.
    looks: Vec<PersonLook>,
    key: Vec<Row>,
}

impl Crowd {
    /// Returns the geometry of trails and of agents, for a plan or for a view in space.
    pub fn layers(
        &mut self,
        shown: &RunMoment,
        settings: &Settings,
        plan: bool,
        look: &dyn Fn() -> Look,
    ) -> [Arc<Geometry>; 2] {
        if !self.of.as_ref().is_some_and(|of| of.is(shown, settings, plan)) {
            if self.of.as_ref().is_some_and(|of| of.run != shown.run) {
                self.ways = Vec::new();
            }
            let look = look();
            self.key = key::of_agents(&look, settings.coloring, shown);
            let trails = self.trails(shown, settings, &look);
            self.layers =
                [Arc::new(Geometry { deep: !plan, ..trails }), Arc::new(self.agents(shown, settings, plan, &look))];
            let (frame, people, settings) = (shown.frame.clone(), shown.people.clone(), settings.clone());
            self.of = Some(CrowdKey { frame, people, settings, run: shown.run, arriving: shown.arriving, plan });
        }
        self.layers.clone()
    }

    /// Returns how people are drawn in a view in space, in the order of the poses.
    pub fn looks(&self) -> &[PersonLook] {
        &self.looks
    }

    /// Returns the key of the agents' colours.
    pub fn key(&self) -> &[Row] {
        &self.key
    }

    fn trails(&mut self, shown: &RunMoment, settings: &Settings, look: &Look) -> Geometry {
        let mut ribbons = Geometry::default();
        let seconds = if shown.frame.bodies.len() > MOST_TRAILS { 0.0 } else { f64::from(settings.trails) };
        let radius = shown.frame.bodies.first().map_or(0.2, |body| f64::from(body.radius));
        let spacing = SPACING * radius * (shown.frame.bodies.len() as f64 / MANY).max(1.0);
        self.trails.follow(shown, seconds, spacing, |body| Some(look.ink(body)));
        if seconds <= 0.0 {
            return ribbons;
        }
        let origin = shown.setting.origin.extend(0.0);
        for track in self.trails.trails.tracks.values() {
            let Some(color) = track.color else { continue };
            let points = track.fading(shown.frame.time, seconds);
            let ends: Vec<_> =
                points.map(|(at, half, opacity)| ((at - origin).as_vec3(), half, color.alpha(opacity))).collect();
            ribbons.ribbon(&ends);
        }
        ribbons
    }

    fn agents(&mut self, shown: &RunMoment, settings: &Settings, plan: bool, look: &Look) -> Geometry {
        let new = self.of.as_ref().is_none_or(|of| !Arc::ptr_eq(&of.frame, &shown.frame));
        let origin = shown.setting.origin;
        let mut agents = Geometry { deep: !plan, ..Geometry::default() };
        agents.discs.reserve(shown.frame.bodies.len());
        let mut people = people::drawn(shown, settings, plan);
        // a single group needs no colour
        let plain = settings.coloring == Coloring::Group && shown.setting.groups.len() < 2;
        self.looks.clear();
        let mut gone = std::mem::take(&mut self.ways).into_iter().peekable();
        for (from, body) in pairs(shown) {
            // both lists are sorted by number
            while gone.next_if(|(number, _)| *number < body.number).is_some() {}
            let before = gone.next_if(|(number, _)| *number == body.number).map_or(0.0, |(_, way)| way);
            let coat = look.coat(body);
            if let Some(((_, person), rest)) = people.split_first().filter(|((number, _), _)| *number == body.number) {
                people = rest;
                let own = look.form(body) == AgentShape::Body;
                self.looks.push(match (own, plain) {
                    (false, _) => PersonLook::Hidden,
                    (true, true) => PersonLook::Own,
                    (true, false) => PersonLook::Top(coat.fill),
                });
                if own {
                    if settings.layers.shadows {
                        agents.discs.push(Disc::shadow(from, &people::broad(body, person), coat, origin));
                    }
                    continue;
                }
            }
            let Some(shape) = settings.marks.shape(body, look.form(body), plan) else {
                agents.discs.push(Disc::agent(from, body, coat, origin));
                continue;
            };
            if settings.layers.shadows {
                agents.discs.push(Disc::shadow(from, body, coat, origin));
            }
            let last = from.position.distance(body.position) as f32;
            let way = if new { before + last } else { before };
            self.ways.push((body.number, way));
            // the phase depends on the number, so that agents do not move in unison
            let own = 2.4 * body.number as f32;
            let phase = |time: f64, way: f32| own + shape.phase(time as f32, way, body.radius);
            let phases = [phase(shown.before.time, way - last), phase(shown.frame.time, way)];
            agents.figures[shape as usize].push(Figure::new(shape, [from, body], phases, coat.fill, origin));
        }
        if shown.setting.in_space {
            // from above, higher agents cover lower ones
            agents.discs.sort_by(|a, b| a.altitude().total_cmp(&b.altitude()));
        }
        agents
    }
}
