//! Builds fields from the vector fields of a scene.
//!
//! Fields that need more than their parameters have descriptions ([`crate::scene::flow`]), each with its [`BuildField`].
//! The library checks the numbers.

mod goal;
mod govern;
mod map;
mod names;
mod paint;
mod picture;
mod sampled;
mod sketch;
mod table;

use super::limits::{Limit, check, check_point};
use super::steer::{Around, refused};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::registry::{BuildField, FieldContext, FieldScene, Names};
use crate::scene::flow::Named;
use crate::scene::steer::Position;
use crate::scene::{Group, Point, Scene};
use glam::Vec3;
use std::cell::{OnceCell, RefCell};
use std::path;
use std::sync::Arc;
use throng::field::Field;
use throng::space::Place;
use throng_field::Anchor;

pub(super) use govern::note_silence;

/// A field of the scene that was made.
#[derive(Clone)]
pub(super) struct BuiltField {
    pub field: Arc<dyn Field>,
    /// The anchors of the sketches of which it is made, metres from its origin.
    pub anchors: Vec<Anchor>,
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

/// The scene, as a field in it sees it.
#[derive(Clone)]
pub(super) struct FieldSite<'a> {
    flows: &'a Flows<'a>,
    /// Whether it moves with agents. Its coordinates are then theirs, else relative to the world's origin.
    moves: bool,
    /// The number of fields, from the first on, that it can refer to.
    known: usize,
    /// The name of its owner, for people.
    of: String,
    /// The anchors of the sketches of which it is made.
    anchors: RefCell<Vec<Anchor>>,
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
            self.named(i, false)
        };
        let made = (0..fields.len()).map(one).collect::<Result<_, _>>()?;
        Ok(self.made.get_or_init(|| made))
    }

    /// Builds a field of the scene, in the coordinates of agents if it moves with them.
    fn named(&self, i: usize, moves: bool) -> Result<BuiltField, Problem> {
        let said = &self.scene.fields[i];
        let site = FieldSite {
            flows: self,
            moves,
            known: i,
            of: format!("field `{}`", said.name),
            anchors: RefCell::default(),
        };
        let made = site.field(&said.flow, &Path::of("field").index(i).key("flow"));
        let field = made.map_err(|problem| match problem.message.starts_with("field `") {
            true => problem,
            false => Problem { message: format!("field `{}`: {}", said.name, problem.message), ..problem },
        })?;
        Ok(BuiltField { field, anchors: site.anchors.into_inner() })
    }

    /// Returns the scene as a field of a group sees it, by the group's position: all fields of the scene, and places
    /// relative to the world's origin.
    pub fn of_group(&self, group: usize) -> FieldSite<'_> {
        let name = Group::name_at(&self.scene.groups[group].name, group);
        FieldSite {
            flows: self,
            moves: false,
            known: self.scene.fields.len(),
            of: format!("group `{name}`"),
            anchors: RefCell::default(),
        }
    }
}

impl FieldSite<'_> {
    /// Returns the context of a field at a path.
    fn context(&self, at: &Path) -> FieldContext<'_> {
        FieldContext { scene: self, path: at.clone() }
    }

    /// Checks that the field stays in place, as walls do.
    fn check_stays(&self, at: &Path, hint: &str) -> Result<(), Problem> {
        match self.moves {
            true => Err(Problem::new(at, Kind::Conflict, "a field that moves with agents has no walls").hint(hint)),
            false => Ok(()),
        }
    }
}

impl FieldScene for FieldSite<'_> {
    fn origin(&self) -> DVec2 {
        if self.moves { DVec2::ZERO } else { self.flows.origin }
    }

    fn bounds(&self) -> [DVec2; 2] {
        self.flows.bounds
    }

    fn ground(&self, at: &Path) -> Result<&Place, Problem> {
        self.check_stays(at, "name another field in `around`")?;
        Ok(self.flows.place)
    }

    fn folder(&self) -> &path::Path {
        &self.flows.scene.origin.folder
    }

    fn known(&self, name: &str, at: &Path) -> Result<Arc<dyn Field>, Problem> {
        let fields = &self.flows.scene.fields;
        let known = &fields[..self.known];
        if let Some(i) = known.iter().position(|field| field.name == name) {
            // all references share one field
            let BuiltField { field, anchors } = match self.flows.made.get() {
                Some(made) if !self.moves => made[i].clone(),
                _ => self.flows.named(i, self.moves)?,
            };
            self.add_anchors(&anchors);
            return Ok(field);
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
        Err(Problem::new(at, Kind::UnknownKey, message).hint(hint))
    }

    fn add_anchors(&self, anchors: &[Anchor]) {
        self.anchors.borrow_mut().extend_from_slice(anchors);
    }

    fn note(&self, what: &str) {
        let note = format!("{}: {what}", self.of);
        let mut notes = self.flows.notes.borrow_mut();
        if !notes.contains(&note) {
            notes.push(note);
        }
    }
}

impl FieldContext<'_> {
    /// Returns a place, relative to the origin.
    fn place(&self, key: &str, point: Point) -> Result<DVec2, Problem> {
        self.place_at(&self.path.key(key), point)
    }

    fn place_at(&self, path: &Path, point: Point) -> Result<DVec2, Problem> {
        check_point(path, &point)?;
        Ok(DVec2::from_array(point) - self.scene.origin())
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

    /// Converts an error of the library.
    fn refused(&self, error: &throng::Error) -> Problem {
        refused(&self.path, error)
    }

    /// Adds a note about the field.
    fn note(&self, what: impl std::fmt::Display) {
        self.scene.note(&what.to_string());
    }
}

impl BuildField for Named {
    fn make(&self, at: &FieldContext) -> Result<Arc<dyn Field>, Problem> {
        at.scene.known(&self.0, &at.path)
    }
}
