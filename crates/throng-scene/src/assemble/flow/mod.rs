//! Builds fields from the vector fields of a scene.
//!
//! Fields that need more than their parameters have descriptions ([`crate::scene::flow`]), each with its `impl BuildField`.
//! The library checks the numbers.

mod combine;
mod goal;
mod govern;
mod map;
mod names;
mod paint;
mod picture;
mod sketch;
mod space;
mod table;

use super::limits::{Limit, check, check_point};
use super::steer::{Around, refused};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::registry::Flow;
use crate::scene::flow::Named;
use crate::scene::steer::{ObstacleNames, Position};
use crate::scene::{Group, Point, Scene};
use glam::Vec3;
use std::cell::{OnceCell, RefCell};
use std::sync::Arc;
use throng::field::Field;
use throng::space::Place;
use throng::space::surface::Surface;
use throng::steer::Barriers;
use throng_field::{Anchor, Map};

pub(super) use govern::note_silence;

/// A field that was made.
#[derive(Clone)]
pub(crate) struct BuiltField {
    pub field: Arc<dyn Field>,
    /// The anchors of a sketch, metres from its origin; empty for other fields.
    pub anchors: Vec<Anchor>,
    /// How much a painted field covers, which multiplies its weight.
    pub cover: Option<Arc<Map>>,
}

impl BuiltField {
    pub fn of(field: impl Field + 'static) -> Self {
        Self { field: Arc::new(field), anchors: vec![], cover: None }
    }
}

/// The input for building fields.
pub(super) struct Flows<'a> {
    pub scene: &'a Scene,
    /// The world's origin.
    pub origin: DVec2,
    /// The lower left and upper right corner of the scene.
    pub bounds: [DVec2; 2],
    /// The ground and obstacles, in world coordinates.
    pub place: &'a Place,
    /// Surfaces and obstacles by name.
    pub around: &'a Around<'a>,
    /// Notes about the fields.
    pub notes: &'a RefCell<Vec<String>>,
    /// The fields of the scene, once they are built.
    pub made: OnceCell<Vec<BuiltField>>,
}

/// The context in which a field is built.
#[derive(Clone)]
pub(crate) struct FieldContext<'a> {
    flows: &'a Flows<'a>,
    /// The path to the field in the scene.
    path: Path,
    /// The origin of its coordinates.
    origin: DVec2,
    /// The number of fields, from the first on, that it can refer to.
    known: usize,
    /// The name of its owner, for people.
    of: String,
}

/// A description from which a field is built.
pub(crate) trait BuildField {
    fn make(&self, at: &FieldContext) -> Result<BuiltField, Problem>;
}

impl Flows<'_> {
    /// Returns the fields of the scene, in its order.
    pub fn all(&self) -> Result<&[BuiltField], Problem> {
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

    /// Builds a field of the scene, with its places relative to an origin.
    fn named(&self, i: usize, origin: DVec2) -> Result<BuiltField, Problem> {
        let said = &self.scene.fields[i];
        let at = FieldContext {
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

    /// Builds a field of a group, by its position, with its places relative to the world's origin.
    pub fn make(&self, flow: &Flow, path: Path, group: usize) -> Result<BuiltField, Problem> {
        self.at(path, group).make(flow)
    }

    /// Returns the context of a group, which can refer to all fields of the scene.
    fn at(&self, path: Path, group: usize) -> FieldContext<'_> {
        let name = Group::name_at(&self.scene.groups[group].name, group);
        FieldContext {
            flows: self,
            path,
            origin: self.origin,
            known: self.scene.fields.len(),
            of: format!("group `{name}`"),
        }
    }
}

impl FieldContext<'_> {
    fn make(&self, flow: &Flow) -> Result<BuiltField, Problem> {
        self.flows.scene.plugins.fields.make(flow, self)
    }

    /// Returns the path to the field in the scene.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the origin of the coordinates of the field.
    pub fn origin(&self) -> DVec2 {
        self.origin
    }

    /// Returns a field of the scene by its name.
    fn known(&self, name: &str) -> Result<BuiltField, Problem> {
        let fields = &self.flows.scene.fields;
        let known = &fields[..self.known];
        if let Some(i) = known.iter().position(|field| field.name == name) {
            // all references share one field
            return match self.flows.made.get() {
                Some(made) if self.origin == self.flows.origin => Ok(made[i].clone()),
                _ => self.flows.named(i, self.origin),
            };
        }
        let message = format!("there is no field `{name}` above");
        let below = fields[self.known..].iter().any(|field| field.name == name);
        let hint = match known {
            _ if below => "it is below: put it above the fields that name it".to_owned(),
            [] => "there is none: add a [[field]] with this name".to_owned(),
            known => {
                let names: Vec<&str> = known.iter().map(|field| field.name.as_str()).collect();
                format!("there are: {}", names.join(", "))
            }
        };
        Err(Problem::new(&self.path, Kind::UnknownKey, message).hint(hint))
    }

    /// Returns the context of a key.
    pub fn key(&self, key: &str) -> Self {
        Self { path: self.path.key(key), ..self.clone() }
    }

    /// Returns the context of an entry of a list.
    fn index(&self, index: usize) -> Self {
        Self { path: self.path.index(index), ..self.clone() }
    }

    /// Returns a place, relative to the origin.
    fn place(&self, key: &str, point: Point) -> Result<DVec2, Problem> {
        self.place_at(&self.path.key(key), point)
    }

    fn place_at(&self, path: &Path, point: Point) -> Result<DVec2, Problem> {
        check_point(path, &point)?;
        Ok(DVec2::from_array(point) - self.origin)
    }

    /// Returns a place in space, relative to the origin.
    fn position(&self, key: &str, Position([x, y, z]): Position) -> Result<Vec3, Problem> {
        check(&self.path.key(key).index(2), z, Limit::Finite)?;
        Ok(self.place(key, [x, y])?.as_vec2().extend(z as f32))
    }

    /// Returns places, relative to the origin.
    fn places(&self, key: &str, points: &[Point]) -> Result<Vec<DVec2>, Problem> {
        let path = self.path.key(key);
        points.iter().enumerate().map(|(i, &point)| self.place_at(&path.index(i), point)).collect()
    }

    /// Returns two corners of a box, relative to the origin.
    fn corners(&self, min: Point, max: Point) -> Result<[DVec2; 2], Problem> {
        let (low, high) = (self.place("min", min)?, self.place("max", max)?);
        if low.cmplt(high).all() {
            return Ok([low, high]);
        }
        let message = format!("it goes from ({}, {}) to ({}, {})", min[0], min[1], max[0], max[1]);
        Err(Problem::new(&self.path.key("max"), Kind::OutOfRange, message).hint("max is right of min and above it"))
    }

    /// Returns surfaces and obstacles by name.
    fn sides(&self, names: &ObstacleNames, path: &Path) -> Result<Barriers, Problem> {
        if self.origin != self.flows.origin {
            let problem = Problem::new(path, Kind::Conflict, "a field that moves with agents has no walls");
            return Err(problem.hint("leave out `walls` in fields of `around`"));
        }
        self.flows.around.sides(names, path, "leave out `walls` for no walls")
    }

    /// Returns surfaces by name.
    fn walls(&self, names: &ObstacleNames) -> Result<Vec<Arc<dyn Surface>>, Problem> {
        let sides = self.sides(names, &self.path.key("walls"))?;
        Ok(sides.0.into_iter().map(|side| side.surface).collect())
    }

    /// Converts an error of the library.
    fn refused(&self, error: &throng::Error) -> Problem {
        refused(&self.path, error)
    }

    /// Adds a note, with the name of the field's owner.
    fn note(&self, what: impl std::fmt::Display) {
        let note = format!("{}: {what}", self.of);
        let mut notes = self.flows.notes.borrow_mut();
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
}

impl BuildField for Named {
    fn make(&self, at: &FieldContext) -> Result<BuiltField, Problem> {
        at.known(&self.0)
    }
}
