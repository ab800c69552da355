//! Navigation meshes for bodies of many sizes, and the areas to reach on them, made when first needed.

use super::{Area, Goal, NavError, NavMesh, Path, Search, Unreachable};
use crate::agent::GoalId;
use crate::space::{Obstacle, Place, is_inside};
use glam::DVec2;
use std::collections::BTreeMap;

/// A mesh for each size of body, in steps of a millimetre.
#[derive(Clone, Debug, Default)]
pub struct Meshes {
    classes: BTreeMap<u32, Class>,
}

#[derive(Clone, Debug)]
struct Class {
    mesh: Result<NavMesh, NavError>,
    areas: BTreeMap<GoalId, Option<Area>>,
}

/// Millimetres that paths keep from walls beyond the body's radius.
const CLEARANCE: f64 = 1.0;

/// The size a radius belongs to, in millimetres: rounded up.
fn class_of(radius: f32) -> u32 {
    (f64::from(radius) * 1000.0 - 0.01).ceil() as u32
}

impl Meshes {
    /// Makes what agents with these radii on their way to these goals need. `extent` is a box round everything that
    /// matters where no walkable area is given.
    pub(crate) fn prepare(
        &mut self,
        needs: impl Iterator<Item = (f32, GoalId)>,
        place: &Place,
        goals: &[Goal],
        extent: (DVec2, DVec2),
    ) {
        let mut obstacles: Option<Vec<Obstacle>> = None;
        for (radius, goal) in needs {
            let class = self.classes.entry(class_of(radius)).or_insert_with(|| {
                let obstacles = obstacles.get_or_insert_with(|| place.obstacles().cloned().collect());
                let radius = (f64::from(class_of(radius)) + CLEARANCE) * 1e-3;
                Class { mesh: NavMesh::build(&place.areas, obstacles, radius, extent), areas: BTreeMap::new() }
            });
            if let (Ok(mesh), Goal::Area { corners } | Goal::Exit { corners }) = (&class.mesh, &goals[goal.index()]) {
                class.areas.entry(goal).or_insert_with(|| mesh.area(corners).ok());
            }
        }
    }

    /// The mesh for bodies of this radius; `None` if there is no ground for them, or no walls at all.
    pub fn mesh(&self, radius: f32) -> Option<&NavMesh> {
        self.classes.get(&class_of(radius))?.mesh.as_ref().ok()
    }

    /// The shortest way to a goal, and how near to an area counts as there: 0 where its ground can be entered.
    pub(crate) fn path(
        &self,
        search: &mut Search,
        radius: f32,
        from: DVec2,
        id: GoalId,
        goal: &Goal,
    ) -> Result<(Path, f64), Unreachable> {
        let Some(class) = self.classes.get(&class_of(radius)) else { return Ok((straight(from, goal), 0.0)) };
        let Ok(mesh) = &class.mesh else {
            return Err(Unreachable::StartInWall { at: from, distance: f64::INFINITY });
        };
        match goal {
            Goal::Point { at, .. } => mesh.path(search, from, *at).map(|path| (path, 0.0)),
            Goal::Area { .. } | Goal::Exit { .. } => match class.areas.get(&id).and_then(Option::as_ref) {
                Some(area) => mesh.path_to(search, from, area).map(|path| (path, area.gap())),
                None => Err(Unreachable::GoalInWall { at: goal.middle(), distance: f64::INFINITY }),
            },
        }
    }
}

/// The way in the open: to the point, or a little way into the area.
fn straight(from: DVec2, goal: &Goal) -> Path {
    let end = match goal {
        Goal::Point { at, .. } => *at,
        Goal::Area { corners } | Goal::Exit { corners } if is_inside(corners, from) => from,
        Goal::Area { corners } | Goal::Exit { corners } => {
            let nearest = nearest_on_ring(corners, from);
            // a tenth of the way from the rim to the middle
            nearest.lerp(goal.middle(), 0.1)
        }
    };
    Path { start: from, corners: vec![end], length: from.distance(end) }
}

/// The point of a closed ring nearest to `p`.
pub(crate) fn nearest_on_ring(corners: &[DVec2], p: DVec2) -> DVec2 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let nearest = edges.map(|(&a, &b)| crate::space::nearest_on_segment(a, b, p));
    nearest.min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p))).unwrap_or(p)
}
