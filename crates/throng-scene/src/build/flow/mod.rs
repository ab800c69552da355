//! From what a scene says of vector fields to fields.
//!
//! A kind of field is made by its own `impl Make`; what is wrong with its numbers, the library says.

mod combine;
mod goal;
mod govern;
mod map;
mod noise;
mod paint;
mod picture;
mod sketch;
mod space;
mod table;

use super::limits::{Limit, check, check_point, check_some};
use super::steer::{Around, refused};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::scene::flow::{Flow, Towards, Whirl};
use crate::scene::steer::Position;
use crate::scene::{Group, Point, Scene};
use glam::Vec3;
use std::cell::{OnceCell, RefCell};
use std::sync::Arc;
use throng::field::{Anchor, Field, Map, Uniform};
use throng::space::Place;

pub(super) use govern::note_silence;

/// A field that was made.
#[derive(Clone)]
pub(super) struct Made {
    pub field: Arc<dyn Field>,
    /// What it was sketched with, if it was, metres from its origin.
    pub anchors: Vec<Anchor>,
    /// How much it covers, if it was painted: so much counts.
    pub cover: Option<Arc<Map>>,
}

impl Made {
    fn of(field: impl Field + 'static) -> Self {
        Self { field: Arc::new(field), anchors: vec![], cover: None }
    }
}

/// What fields are made with.
pub(super) struct Flows<'a> {
    pub scene: &'a Scene,
    /// The world's origin.
    pub origin: DVec2,
    /// Lower left and upper right corner of the scene.
    pub bounds: [DVec2; 2],
    /// What is solid, in world coordinates.
    pub place: &'a Place,
    /// Surfaces and obstacles by name.
    pub around: &'a Around<'a>,
    /// What is worth knowing of what was made.
    pub notes: &'a RefCell<Vec<String>>,
    /// The fields of the scene, once they are made.
    pub made: OnceCell<Vec<Made>>,
}

/// Where a field is made.
#[derive(Clone)]
struct At<'a> {
    flows: &'a Flows<'a>,
    /// Leads to what is said of it.
    path: Path,
    /// What places are relative to.
    origin: DVec2,
    /// The fields that it can name: so many of the first.
    known: usize,
    /// What it belongs to, for people.
    of: String,
}

/// What fields are made from.
trait Make {
    fn make(&self, at: &At) -> Result<Made, Problem>;
}

impl Flows<'_> {
    /// The fields of the scene, in its order.
    pub fn all(&self) -> Result<&[Made], Problem> {
        let fields = &self.scene.fields;
        let one = |i: usize| {
            let said = &fields[i];
            super::surface::check_name(
                &Path::of("field").index(i),
                &said.name,
                fields[..i].iter().map(|other| &other.name),
            )?;
            self.named(i, self.origin)
        };
        let made = (0..fields.len()).map(one).collect::<Result<_, _>>()?;
        Ok(self.made.get_or_init(|| made))
    }

    /// A field of the scene, with its places relative to an origin.
    fn named(&self, i: usize, origin: DVec2) -> Result<Made, Problem> {
        let said = &self.scene.fields[i];
        let at = At {
            flows: self,
            path: Path::of("field").index(i).key("flow"),
            origin,
            known: i,
            of: format!("field `{}`", said.name),
        };
        at.make(&said.flow).map_err(|problem| match problem.message.starts_with("field `") {
            true => problem,
            false => Problem { message: format!("field `{}`: {}", said.name, problem.message), ..problem },
        })
    }

    /// What a group says, by its position, with its places relative to the world's origin.
    pub fn make(&self, flow: &Flow, path: Path, group: usize) -> Result<Made, Problem> {
        self.at(path, group).make(flow)
    }

    /// Where a group says something: it can name all fields of the scene.
    fn at(&self, path: Path, group: usize) -> At<'_> {
        let name = Group::name_at(&self.scene.groups[group].name, group);
        At { flows: self, path, origin: self.origin, known: self.scene.fields.len(), of: format!("group `{name}`") }
    }
}

impl At<'_> {
    fn make(&self, flow: &Flow) -> Result<Made, Problem> {
        let (key, made): (&str, &dyn Make) = match flow {
            Flow::Uniform(velocity) => {
                let at = self.key("uniform");
                velocity.0.iter().enumerate().try_for_each(|(i, x)| check(&at.path.index(i), *x, Limit::Finite))?;
                return Ok(Made::of(Uniform(Vec3::from_array(velocity.0.map(|x| x as f32)))));
            }
            Flow::Named(name) => return self.known(name),
            Flow::Whirl(of) => ("whirl", of),
            Flow::Towards(of) => ("towards", of),
            Flow::Sketch(of) => ("sketch", of),
            Flow::SketchInSpace(of) => ("sketch_in_space", of),
            Flow::Paint(of) => ("paint", of),
            Flow::Picture(of) => ("picture", of),
            Flow::Table(of) => ("table", of),
            Flow::ToGoal(of) => ("to_goal", of),
            Flow::ThroughSpace(of) => ("through_space", of),
            Flow::Noise(of) => ("noise", of),
            Flow::Sum(of) => ("sum", &combine::Parts { of, blended: false }),
            Flow::Blend(of) => ("blend", &combine::Parts { of, blended: true }),
            Flow::Keyframes(of) => ("keyframes", of),
            Flow::AroundWalls(of) => ("around_walls", of),
            Flow::Sampled(of) => ("sampled", of),
        };
        made.make(&self.key(key))
    }

    /// A field of the scene.
    fn known(&self, name: &str) -> Result<Made, Problem> {
        let fields = &self.flows.scene.fields;
        let known = &fields[..self.known];
        if let Some(i) = known.iter().position(|field| field.name == name) {
            // those who name it share it
            return match self.flows.made.get() {
                Some(made) if self.origin == self.flows.origin => Ok(made[i].clone()),
                _ => self.flows.named(i, self.origin),
            };
        }
        let message = format!("there is no field `{name}` above");
        let below = fields[self.known..].iter().any(|field| field.name == name);
        let hint = match known {
            _ if below => "it is below: put it above those that name it".to_owned(),
            [] => "there is none: add a [[field]] with this name".to_owned(),
            known => {
                let names: Vec<&str> = known.iter().map(|field| field.name.as_str()).collect();
                format!("there are: {}", names.join(", "))
            }
        };
        Err(Problem::new(&self.path.key("named"), Kind::UnknownKey, message).hint(hint))
    }

    /// Further down.
    fn key(&self, key: &str) -> Self {
        Self { path: self.path.key(key), ..self.clone() }
    }

    /// Further down, in a list.
    fn index(&self, index: usize) -> Self {
        Self { path: self.path.index(index), ..self.clone() }
    }

    /// A place, relative to the origin.
    fn place(&self, key: &str, point: Point) -> Result<DVec2, Problem> {
        self.place_at(&self.path.key(key), point)
    }

    fn place_at(&self, path: &Path, point: Point) -> Result<DVec2, Problem> {
        check_point(path, &point)?;
        Ok(DVec2::from_array(point) - self.origin)
    }

    /// A place in space, relative to the origin.
    fn position(&self, key: &str, Position([x, y, z]): Position) -> Result<Vec3, Problem> {
        check(&self.path.key(key).index(2), z, Limit::Finite)?;
        Ok(self.place(key, [x, y])?.as_vec2().extend(z as f32))
    }

    /// Places, relative to the origin.
    fn places(&self, key: &str, points: &[Point]) -> Result<Vec<DVec2>, Problem> {
        let path = self.path.key(key);
        points.iter().enumerate().map(|(i, &point)| self.place_at(&path.index(i), point)).collect()
    }

    /// Two corners of a box, relative to the origin.
    fn corners(&self, min: Point, max: Point) -> Result<[DVec2; 2], Problem> {
        let (low, high) = (self.place("min", min)?, self.place("max", max)?);
        if low.cmplt(high).all() {
            return Ok([low, high]);
        }
        let message = format!("it goes from ({}, {}) to ({}, {})", min[0], min[1], max[0], max[1]);
        Err(Problem::new(&self.path.key("max"), Kind::OutOfRange, message).hint("max is right of min and above it"))
    }

    /// What the library refuses.
    fn refused(&self, error: &throng::Error) -> Problem {
        refused(&self.path, error)
    }

    /// Notes something worth knowing, with the name of what it is about.
    fn note(&self, what: impl std::fmt::Display) {
        let note = format!("{}: {what}", self.of);
        let mut notes = self.flows.notes.borrow_mut();
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
}

impl Make for Whirl {
    fn make(&self, at: &At) -> Result<Made, Problem> {
        check(&at.path.key("speed"), self.speed, Limit::Finite)?;
        let center = at.position("center", self.center)?.with_z(0.0);
        let spin = Vec3::Z * self.speed as f32;
        Ok(Made::of(move |place: Vec3, _: f64| {
            spin.cross((place - center).with_z(0.0).try_normalize().unwrap_or_default())
        }))
    }
}

impl Make for Towards {
    fn make(&self, at: &At) -> Result<Made, Problem> {
        check(&at.path.key("speed"), self.speed, Limit::Finite)?;
        check_some(&at.path.key("slow"), self.slow, Limit::Positive)?;
        check_some(&at.path.key("within"), self.within, Limit::Positive)?;
        let (to, speed, slow) = (at.position("at", self.at)?, self.speed as f32, self.slow.unwrap_or(0.5) as f32);
        let within = self.within.map_or(f32::INFINITY, |within| within as f32);
        Ok(Made::of(move |place: Vec3, _: f64| {
            let way = to - place;
            let distance = way.length();
            if distance > within { Vec3::ZERO } else { way * (speed / distance.max(slow)) }
        }))
    }
}
