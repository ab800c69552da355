//! Agents that are people: figures that walk with planted feet, with throng's bodies or those of files.

use super::light::light_of;
use crate::look::Look;
use crate::{AgentShape, Color, ColorBy, Shape, Style};
use glam::{DVec2, Vec2, Vec3};
use std::collections::BTreeMap;
use std::sync::Arc;
use throng::parallel;
use throng_figure::{
    Build, Character, JOINTS, Level, Live, Look as Clothes, Mesh as Figure, Person, Placed, Pose, Region, Sample,
    Skeleton, Walk,
};
use throng_record::people::Walks;
use throng_record::{Body, Frame, Setting};
use throng_render::{Mesh, linear};

/// A person that follows an agent.
#[derive(Debug)]
struct Walker {
    steps: Steps,
    skeleton: Skeleton,
}

/// How a person finds its steps.
#[derive(Debug)]
enum Steps {
    /// From what has been.
    Live(Box<Live>),
    /// From its whole way, which [`Setting::walks`] knows: the time.
    Planned(f64),
}

/// The people of a recording, by agent number.
#[derive(Debug, Default)]
pub(crate) struct People {
    /// Whether agents of the size of people are people.
    wanted: bool,
    /// Whether clothes have the colours of agents; otherwise those of people.
    colored: bool,
    /// The bodies of groups, from files.
    characters: Vec<Option<Arc<Character>>>,
    /// The walks that are known.
    walks: Option<Arc<Walks>>,
    figures: BTreeMap<u32, Box<Walker>>,
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
        let (characters, walks) = (setting.characters.clone(), setting.walks.clone());
        Self { wanted: style.people, colored, characters, walks, ..Self::default() }
    }

    /// Whether an agent is a person: a disc of the size of people that is on the ground when it appears, or an agent with
    /// the shape of a person.
    fn has(&self, body: &Body, look: &Look, known: bool) -> bool {
        let disc = body.basis.is_none() && body.core == Vec2::ZERO;
        let shape = look.form(body);
        let stands = known || body.altitude == 0.0;
        shape == AgentShape::Shaped(Shape::Walker) || self.wanted && stands && disc && shape == AgentShape::Body
    }

    /// Moves people to a moment. Absent agents are dropped.
    pub fn follow(&mut self, frame: &Frame, look: &Look) {
        let mut before = std::mem::take(&mut self.figures);
        let mut now: Vec<(&Body, Option<Box<Walker>>)> = Vec::with_capacity(frame.bodies.len());
        for body in &frame.bodies {
            let known = before.remove(&body.number);
            if self.has(body, look, known.is_some()) {
                now.push((body, known));
            }
        }
        let people = &*self;
        parallel::ranges(&mut now[..], |_, now| {
            for (body, walker) in now {
                let sample = Sample { time: frame.time, position: body.position, heading: f64::from(body.heading) };
                if !walker.as_mut().is_some_and(|walker| walker.steps.follow(sample)) {
                    *walker = people.arrived(body, sample).map(Box::new);
                }
            }
        });
        self.figures = now.into_iter().filter_map(|(body, walker)| Some((body.number, walker?))).collect();
        let people = self.figures.iter().filter_map(|(number, walker)| self.person(*number, &walker.steps));
        let builds: BTreeMap<u8, Build> = people.map(|person| (person.build as u8, person.build)).collect();
        for (key, build) in builds {
            for level in Level::ALL {
                self.bodies.entry((key, level)).or_insert_with(|| Figure::new(build, level));
            }
        }
    }

    /// Returns the person of an agent that appears, in the middle of its way; `None` if it is no person, or without a finite
    /// position.
    fn arrived(&self, body: &Body, sample: Sample) -> Option<Walker> {
        let character = self.character(body);
        if let Some(walk) = self.walk(body.number) {
            let skeleton = Character::dressed(character, *walk.person()).1;
            return Some(Walker { steps: Steps::Planned(sample.time), skeleton });
        }
        let (person, skeleton) = Character::dressed(character, Person::of_agent(body.number, body.radius)?);
        let velocity = if body.velocity.is_finite() { body.velocity.as_dvec2() } else { DVec2::ZERO };
        let live = Live::moving(person, sample, velocity).ok()?;
        Some(Walker { steps: Steps::Live(Box::new(live)), skeleton })
    }

    /// Returns the walk of an agent, if it is known.
    fn walk(&self, number: u32) -> Option<&Walk> {
        self.walks.as_ref()?.get(number)
    }

    fn person<'a>(&'a self, number: u32, steps: &'a Steps) -> Option<&'a Person> {
        match steps {
            Steps::Live(live) => Some(live.person()),
            Steps::Planned(_) => Some(self.walk(number)?.person()),
        }
    }

    fn pose(&self, number: u32, steps: &Steps) -> Option<Pose> {
        match steps {
            Steps::Live(live) => Some(live.pose()),
            Steps::Planned(time) => Some(self.walk(number)?.pose(*time)),
        }
    }

    /// Returns the body that the people of an agent's group have; `None`: throng's.
    fn character(&self, body: &Body) -> Option<&Character> {
        self.characters.get(body.group as usize)?.as_deref()
    }

    /// Returns the figure of an agent about its position, at a scale in pixels per metre; `None` if it is not a person.
    pub fn mesh(&self, body: &Body, look: &Look, scale: f32) -> Option<Mesh<'static>> {
        let Walker { steps, skeleton } = &**self.figures.get(&body.number)?;
        let person = self.person(body.number, steps)?;
        let joints = skeleton.world(&self.pose(body.number, steps)?);
        if let Some(character) = self.character(body) {
            return shaped(character, (person, skeleton, &joints), body);
        }
        let level = Level::for_height(f64::from(scale) * person.height);
        let figure = self.bodies.get(&(person.build as u8, level))?;
        let (positions, normals) = figure.skinned(skeleton, person.height, &joints, body.center());
        let clothes = Clothes::new(person.look);
        let coat = look.coat(body).fill;
        let color = |region: &Region| self.color(*region, &clothes, coat);
        let colors: Vec<Vec3> = figure.regions.iter().map(color).collect();
        Mesh::new(positions, normals, colors, figure.triangles_of(&clothes)).ok()
    }

    fn color(&self, region: Region, clothes: &Clothes, coat: Color) -> Vec3 {
        let [r, g, b] = clothes.colour(region).unwrap_or_default();
        let colored = self.colored && clothes.is_top(region);
        if colored { light_of(coat) } else { linear(u32::from_be_bytes([0, r, g, b])) }
    }
}

impl Steps {
    /// Goes on to a sample. Returns false if the steps must begin anew.
    fn follow(&mut self, sample: Sample) -> bool {
        match self {
            Self::Live(live) => live.sample() == sample || live.step(sample).is_ok(),
            Self::Planned(time) => {
                *time = sample.time;
                true
            }
        }
    }
}

/// Returns the body of a file about the position of an agent.
fn shaped(
    character: &Character,
    (person, skeleton, joints): (&Person, &Skeleton, &[Placed; JOINTS]),
    body: &Body,
) -> Option<Mesh<'static>> {
    let mesh = character.mesh();
    let (positions, normals) = mesh.skinned(skeleton, person.height, joints, body.center());
    let light = |[r, g, b]: &[u8; 3]| linear(u32::from_be_bytes([0, *r, *g, *b]));
    let colors: Vec<Vec3> = character.colours().iter().map(light).collect();
    Mesh::new(positions, normals, colors, mesh.triangles.clone()).ok()
}
