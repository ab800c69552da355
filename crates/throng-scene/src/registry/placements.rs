//! The placements, by name.

use super::choice::{Catalogue, Choice, Described};
use super::entries::{Entries, Entry};
use super::given::{FileGiven, Unmade, made_by_plugin, read_value};
use super::placement::Placement;
use super::schema::of_parameters;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::random::Random;
use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::Value as Json;
use std::sync::Arc;
use throng::parameters::Parameters;
use toml::Value;

/// Where the agents of a group start: the name of a placement, and what its table says.
///
/// ```
/// use throng_scene::{Place, Ring};
/// let place: Place = Ring { radius: 7.0, ..Ring::default() }.into();
/// assert_eq!((place.name.as_str(), place.read::<Ring>().map(|ring| ring.radius)), ("ring", Some(7.0)));
/// ```
pub type Place = Choice<Placements>;

/// The placements that scene files can name: those of throng, then those that a program adds.
#[derive(Clone, Debug)]
pub struct Placements(Entries<PlacementKind>);

/// A kind of placements.
#[derive(Clone, Copy)]
struct PlacementKind {
    make: MakePlacement,
    /// Checks the keys and the kinds of values.
    check_keys: fn(&Value, &Path) -> Result<(), Problem>,
}

/// Makes a placement from what the scene says in this context.
type MakePlacement = fn(&Value, &PlacementContext<'_>) -> Result<Arc<dyn Placement>, Problem>;

/// What placements of throng are made from, besides their parameters.
#[derive(Clone)]
pub(crate) struct PlacementContext<'a> {
    /// The walkable ground; none: everywhere.
    pub areas: &'a [throng::Walkable],
    /// The path to the placement in the scene.
    pub path: Path,
}

/// A description from which a placement is made.
pub(crate) trait BuildPlacement {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem>;
}

/// The placement that a scene chooses.
pub(crate) struct ChosenPlacement {
    pub is_drawn: bool,
    /// The least distance between bodies, metres.
    pub gap: f64,
    pub sets_altitude: bool,
    pub capacity: Option<u64>,
    pub center: Option<DVec3>,
    placement: Arc<dyn Placement>,
    /// The path to it in the scene, its kind and its name.
    path: Path,
    what: String,
}

impl Placements {
    /// Adds a placement of a plug-in, or replaces the placement with the same name. A panic in it names it.
    pub(super) fn add_plugin<P: Placement + Parameters + 'static>(&mut self) {
        let make = PlacementKind {
            make: |given, at| {
                made_by_plugin(&at.path, &what(P::NAME), || {
                    let placement: P = FileGiven::new(given, &at.path).parameters()?;
                    placement.check()?;
                    let placement: Arc<dyn Placement> = Arc::new(placement);
                    Ok(placement)
                })
            },
            check_keys: |given, at| FileGiven::new(given, at).without_limits().parameters::<P>().map(drop),
        };
        self.0.add(Entry { name: P::NAME.into(), about: P::ABOUT, is_plugin: true, schema: of_parameters::<P>, make });
    }

    /// Adds a placement of throng, which a scene describes as a `D`.
    pub(crate) fn add_own<D: Described + JsonSchema + BuildPlacement>(&mut self, about: &'static str) {
        let make = PlacementKind {
            make: |given, at| read_value::<D>(given, &at.path)?.make(at),
            check_keys: |given, at| read_value::<D>(given, at).map(drop),
        };
        let schema = |generator: &mut SchemaGenerator| generator.subschema_for::<D>();
        self.0.add(Entry { name: D::NAME.into(), about, is_plugin: false, schema, make });
    }

    /// Returns the names of all placements.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.names()
    }

    /// Makes the placement that a scene chooses at a path.
    pub(crate) fn make(
        &self,
        place: &Place,
        areas: &[throng::Walkable],
        at: &Path,
    ) -> Result<ChosenPlacement, Problem> {
        let (path, what) = (at.name(&place.name), what(&place.name));
        let entry = self.0.find(&place.name, &path)?;
        let context = PlacementContext { areas, path };
        let placement = (entry.make.make)(&place.parameters, &context)?;
        let path = context.path;
        let chosen = made_by_plugin(&path.clone(), &what.clone(), || {
            Ok(ChosenPlacement {
                is_drawn: placement.is_drawn(),
                gap: placement.gap(),
                sets_altitude: placement.sets_altitude(),
                capacity: placement.capacity(),
                center: placement.center(),
                placement,
                path,
                what,
            })
        })?;
        match chosen.gap.is_finite() && chosen.gap >= 0.0 {
            true => Ok(chosen),
            false => {
                let message = format!("{} has a gap of {}, but it must be 0 or more", chosen.what, chosen.gap);
                Err(Problem::new(&chosen.path, Kind::OutOfRange, message))
            }
        }
    }

    /// Checks that the placement of a choice, if it is known, has the given parameters and can read them.
    pub(crate) fn check_keys(&self, place: &Place, at: &Path) -> Result<(), Problem> {
        let at = at.name(&place.name);
        self.0.get(&place.name).map_or(Ok(()), |entry| (entry.make.check_keys)(&place.parameters, &at))
    }

    /// Returns the name of each placement of a plug-in, and the schema of its choice.
    pub(super) fn plugin_schemas(&self, generator: &mut SchemaGenerator) -> Vec<(&str, Json)> {
        self.0.plugin_schemas(generator)
    }
}

impl ChosenPlacement {
    /// Returns the position of an agent, or a candidate, as [`Placement::position`] does. Its coordinates are finite.
    pub fn position(&self, k: usize, n: usize, random: &mut Random) -> Result<Option<DVec3>, Problem> {
        made_by_plugin(&self.path, &self.what, || match self.placement.position(k, n, random) {
            Some(position) if !position.is_finite() => {
                let message = format!("{} puts agent {k} at {position}, which is no place", self.what);
                Err(Unmade::from(Problem::new(&self.path, Kind::OutOfRange, message)))
            }
            position => Ok(position),
        })
    }
}

impl Default for Placements {
    /// Returns the placements of throng.
    fn default() -> Self {
        let mut placements = Self(Entries::default());
        crate::scene::place::register(&mut placements);
        placements
    }
}

impl Catalogue for Placements {
    const NAME: &'static str = "Place";
    const EXAMPLE: &'static str = "place.ring = { .. }";

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        let description = "Where the agents of a group start.\n\nPoints, line, ring, sphere and grid put agent number k at \
                           the k-th position. Disc, rectangle, polygon and walkable draw a position for each agent, \
                           clear of walls, obstacles and all other agents.";
        Self::default().0.schema(description, generator)
    }
}

/// Returns the kind and name of a placement, for messages.
fn what(name: &str) -> String {
    format!("place `{name}`")
}
