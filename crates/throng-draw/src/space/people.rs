//! Agents that are people: figures that walk with planted feet.

use super::light::light_of;
use crate::look::Look;
use crate::{AgentShape, Color, ColorBy, Shape, Style};
use glam::{DVec2, Vec3};
use std::collections::BTreeMap;
use throng_figure::{Build, Level, Live, Look as Clothes, Mesh as Figure, Person, Region, Sample, Skeleton};
use throng_record::{Body, Frame, Setting};
use throng_render::{Mesh, linear};

/// The largest radius of a person, metres.
const LARGEST: f32 = 0.5;
/// Below this radius a person is a child of this height, metres.
const CHILD: f32 = 0.18;
const CHILD_HEIGHT: f64 = 1.2;
/// The heights in the picture from which people have the finer levels, pixels.
const LEVELS: [(Level, f64); 3] = [(Level::Fine, 140.0), (Level::Medium, 60.0), (Level::Coarse, 22.0)];
/// An agent that appears while it moves has walked straight before, for this time and up to this much more, seconds. The
/// times differ, so that agents that appear at once do not march in step.
const BEFORE: f64 = 1.0;
const SPREAD: f64 = 1.3;
/// The time from sample to sample of the walk before, seconds.
const SAMPLE: f64 = 0.05;

/// The people of a recording, by agent number.
#[derive(Debug, Default)]
pub(crate) struct People {
    /// Whether agents of the scene are people.
    any: bool,
    /// Whether clothes have the colours of agents; otherwise those of people.
    colored: bool,
    figures: BTreeMap<u32, (Live, Skeleton)>,
    bodies: BTreeMap<(u8, Level), Figure>,
}

impl People {
    /// Creates the people of a recording that begins with `first`. They have clothes of many colours if the colours of
    /// agents say nothing: if they show the group, and there is one.
    pub fn new(setting: &Setting, style: &Style, first: &Frame) -> Self {
        let group = first.bodies.first().map_or(0, |body| body.group);
        let one = setting.groups.len() < 2 && first.bodies.iter().all(|body| body.group == group);
        let named = style.groups.iter().any(Option::is_some);
        let colored = !one || named || style.color_by != ColorBy::Group;
        Self { any: !setting.in_space, colored, ..Self::default() }
    }

    /// Whether an agent is a person: a disc on the ground of the size of people, or an agent with the shape of one.
    fn has(&self, body: &Body, look: &Look) -> bool {
        let person = body.basis.is_none() && body.core == glam::Vec2::ZERO && body.radius <= LARGEST;
        let shape = look.form(body);
        shape == AgentShape::Shaped(Shape::Walker) || self.any && person && shape == AgentShape::Body
    }

    /// Moves people to a moment. Absent agents are dropped.
    pub fn follow(&mut self, frame: &Frame, look: &Look) {
        let mut before = std::mem::take(&mut self.figures);
        let mut now = BTreeMap::new();
        for body in frame.bodies.iter().filter(|body| self.has(body, look)) {
            let sample = Sample { time: frame.time, position: body.position, heading: f64::from(body.heading) };
            let known = before.remove(&body.number).and_then(|(mut live, skeleton)| {
                let known = live.sample().time == sample.time || live.step(sample).is_ok();
                known.then_some((live, skeleton))
            });
            if let Some(figure) = known.or_else(|| arrived(body, sample)) {
                now.insert(body.number, figure);
            }
        }
        self.figures = now;
        for (live, _) in self.figures.values() {
            let build = live.person().build;
            for level in Level::ALL {
                self.bodies.entry((build as u8, level)).or_insert_with(|| Figure::new(build, level));
            }
        }
    }

    /// Returns the figure of an agent about its position, at a scale in pixels per metre; `None` if it is not a person.
    pub fn mesh(&self, body: &Body, look: &Look, scale: f32) -> Option<Mesh<'static>> {
        let (live, skeleton) = self.figures.get(&body.number)?;
        let person = live.person();
        let height = f64::from(scale) * person.height;
        let level = LEVELS.iter().find(|(_, least)| height >= *least).map_or(Level::Blocks, |(level, _)| *level);
        let figure = self.bodies.get(&(person.build as u8, level))?;
        let joints = skeleton.world(&live.pose());
        let (positions, normals) = figure.skinned(skeleton, person.height, &joints, body.center());
        let clothes = Clothes::new(person.look);
        let coat = look.coat(body).fill;
        let color = |region: &Region| self.color(*region, &clothes, coat);
        let colors: Vec<Vec3> = figure.regions.iter().map(color).collect();
        Mesh::new(positions, normals, colors, figure.triangles.clone()).ok()
    }

    fn color(&self, region: Region, clothes: &Clothes, coat: Color) -> Vec3 {
        let [r, g, b] = clothes.colour(region);
        let covered = region == Region::Top
            || region == Region::Sleeves && clothes.colour(Region::Sleeves) == clothes.colour(Region::Top);
        if self.colored && covered { light_of(coat) } else { linear(u32::from_be_bytes([0, r, g, b])) }
    }
}

/// Returns the person of an agent that appears, as if it had walked straight before; `None` without a finite position.
fn arrived(body: &Body, sample: Sample) -> Option<(Live, Skeleton)> {
    let mut person = Person::new(0, u64::from(body.number));
    if body.radius < CHILD {
        person = person.with_build(Build::Child).with_height(CHILD_HEIGHT);
    }
    let velocity = body.velocity.as_dvec2();
    let velocity = if velocity.is_finite() { velocity } else { DVec2::ZERO };
    let share = (f64::from(body.number) * 0.618_033_988_749_895).fract();
    let count = ((BEFORE + SPREAD * share) / SAMPLE) as u32;
    let before = |left: u32| {
        let time = f64::from(left) * SAMPLE;
        Sample { time: sample.time - time, position: sample.position - velocity * time, ..sample }
    };
    let mut live = Live::new(person, before(count)).ok()?;
    for left in (0..count).rev() {
        live.step(before(left)).ok()?;
    }
    let skeleton = Skeleton::new(live.person());
    Some((live, skeleton))
}
