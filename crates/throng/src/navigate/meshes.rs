//! Navigation meshes for the sizes of bodies, the goal areas on them, and the path trees to goals. All are built on
//! first use.

use super::tree::{self, Growth, Tree, TreeScratch};
use super::{Area, Goal, NavError, NavMesh, Path, Unreachable};
use crate::agent::GoalId;
use crate::parallel;
use crate::space::{Obstacle, Place, is_inside};
use glam::DVec2;
use std::collections::BTreeMap;

/// A mesh for each size of body, in steps of a millimetre.
#[derive(Clone, Debug, Default)]
pub struct Meshes {
    classes: BTreeMap<u32, Class>,
    /// The trees by size of body and goal.
    trees: BTreeMap<(u32, GoalId), CachedTree>,
    /// The size of their memory, bytes.
    tree_bytes: usize,
    /// The number of searches so far.
    asked: u64,
}

/// A request for a path.
pub(crate) struct PathRequest {
    /// The row of the agent.
    pub row: usize,
    /// The radius of its body.
    pub radius: f32,
    /// The start of the path.
    pub from: DVec2,
    /// The goal of the path.
    pub goal: GoalId,
    /// The shortest path, and the distance from an area that counts as arrived: 0 where the area can be entered.
    pub found: Option<Result<(Path, f64), Unreachable>>,
}

/// A tree that is kept for later requests.
#[derive(Clone, Debug)]
struct CachedTree {
    tree: Tree,
    /// The number of the search that used it last.
    asked: u64,
}

#[derive(Clone, Debug)]
struct Class {
    mesh: Result<NavMesh, NavError>,
    areas: BTreeMap<GoalId, Option<Area>>,
}

/// Distance that paths keep from walls beyond the body's radius, millimetres.
const CLEARANCE: f64 = 1.0;

/// Maximum size of all trees that are kept, bytes.
const MOST_TREE_BYTES: usize = 80 << 20;

/// Returns the size class of a radius, in millimetres: rounded up.
fn class_of(radius: f32) -> u32 {
    (f64::from(radius) * 1000.0 - 0.01).ceil() as u32
}

impl Meshes {
    /// Builds the meshes and areas for agents with these radii on their way to these goals. Where no walkable area is
    /// given, `extent` is a box around everything that matters.
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
            if let (Ok(mesh), Some(corners)) = (&class.mesh, goals[goal.index()].corners()) {
                class.areas.entry(goal).or_insert_with(|| mesh.area(corners).ok());
            }
        }
    }

    /// Discards the areas and trees of a goal that has changed.
    pub(crate) fn forget(&mut self, goal: GoalId) {
        let bytes = &mut self.tree_bytes;
        self.trees.retain(|&(_, of), kept| {
            let stays = of != goal;
            *bytes -= if stays { 0 } else { kept.tree.bytes() };
            stays
        });
        self.classes.values_mut().for_each(|class| _ = class.areas.remove(&goal));
    }

    /// Returns the mesh for bodies of this radius; `None` if it has not been built or there is no free ground for them.
    pub fn mesh(&self, radius: f32) -> Option<&NavMesh> {
        self.classes.get(&class_of(radius))?.mesh.as_ref().ok()
    }

    /// Finds the requested paths. Requests for the same goal and size share a tree. The paths do not depend on which
    /// trees are kept.
    pub(crate) fn find(&mut self, goals: &[Goal], asked: &mut [PathRequest]) {
        self.find_keeping(MOST_TREE_BYTES, goals, asked);
    }

    /// As [`find`](Self::find), with a maximum size of the trees that are kept, bytes.
    fn find_keeping(&mut self, most: usize, goals: &[Goal], asked: &mut [PathRequest]) {
        self.asked += 1;
        let to = |asked: &PathRequest| (class_of(asked.radius), asked.goal);
        asked.sort_by_key(|asked| (to(asked), asked.row));
        let mut groups: Vec<PathRequestGroup<'_>> = asked
            .chunk_by_mut(|one, other| to(one) == to(other))
            .map(|asked| {
                let key = to(&asked[0]);
                let tree = self.trees.remove(&key).map(|kept| kept.tree);
                self.tree_bytes -= tree.as_ref().map_or(0, Tree::bytes);
                let (class, goal) = (self.classes.get(&key.0), &goals[key.1.index()]);
                PathRequestGroup { key, class, goal, asked, tree }
            })
            .collect();
        let share = most / groups.len().max(1);
        parallel::rows(&mut groups, |scratch: &mut TreeScratch, _, group| {
            group.run(scratch);
            // so that all trees of this search fit
            group.tree.take_if(|tree| tree.bytes() > share);
        });
        let found: Vec<_> = groups.into_iter().filter_map(|group| Some((group.key, group.tree?))).collect();
        let bytes: usize = found.iter().map(|(_, tree)| tree.bytes()).sum();
        if self.tree_bytes + bytes > most {
            self.make_room(most - bytes);
        }
        self.tree_bytes += bytes;
        self.trees.extend(found.into_iter().map(|(key, tree)| (key, CachedTree { tree, asked: self.asked })));
    }

    /// Discards the least recently used trees until the others fit in half of `most` bytes: so this is seldom needed.
    fn make_room(&mut self, most: usize) {
        let mut by_use: Vec<_> = self.trees.iter().map(|(&key, kept)| (kept.asked, key)).collect();
        by_use.sort_unstable();
        for (_, key) in by_use {
            if self.tree_bytes <= most / 2 {
                break;
            }
            self.tree_bytes -= self.trees.remove(&key).map_or(0, |kept| kept.tree.bytes());
        }
    }
}

/// All requests for paths to one goal by agents of one size.
struct PathRequestGroup<'a> {
    key: (u32, GoalId),
    class: Option<&'a Class>,
    goal: &'a Goal,
    asked: &'a mut [PathRequest],
    tree: Option<Tree>,
}

impl PathRequestGroup<'_> {
    fn run(&mut self, scratch: &mut TreeScratch) {
        let Self { key: (_, id), class, goal, asked, tree } = self;
        let Some(class) = class else {
            asked.iter_mut().for_each(|asked| asked.found = Some(Ok((straight(asked.from, goal), 0.0))));
            return;
        };
        let (mut triangles, mut places) = Default::default();
        let area = class.areas.get(id).and_then(Option::as_ref);
        let target = match (&class.mesh, goal.corners(), area) {
            (Ok(mesh), None, _) => mesh.point_target(goal.middle(), &mut triangles, &mut places),
            (Ok(mesh), Some(_), Some(area)) => mesh.area_target(area),
            _ => Err(Unreachable::GoalInWall { at: goal.middle(), distance: f64::INFINITY }),
        };
        let growth = Growth::of(asked.len());
        for asked in asked.iter_mut() {
            let found = match &class.mesh {
                Err(_) => Err(Unreachable::StartInWall { at: asked.from, distance: f64::INFINITY }),
                Ok(mesh) => tree::path(tree, mesh, &target, (asked.from, growth), scratch),
            };
            asked.found = Some(found.map(|path| (path, area.map_or(0.0, Area::gap))));
        }
    }
}

/// Returns the path without walls: to the point, or a short distance into the area.
fn straight(from: DVec2, goal: &Goal) -> Path {
    let end = match goal.corners() {
        None => goal.middle(),
        Some(corners) if is_inside(corners, from) => from,
        // a tenth of the distance from the rim to the middle
        Some(corners) => nearest_on_ring(corners, from).lerp(goal.middle(), 0.1),
    };
    Path { start: from, corners: vec![end], length: from.distance(end) }
}

/// Returns the point of a closed ring nearest to `p`.
pub(crate) fn nearest_on_ring(corners: &[DVec2], p: DVec2) -> DVec2 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let nearest = edges.map(|(&a, &b)| crate::space::nearest_on_segment(a, b, p));
    nearest.min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p))).unwrap_or(p)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Walkable;

    #[test]
    fn what_is_found_does_not_depend_on_what_is_kept_and_no_more_is_kept_than_there_is_room_for() {
        let corners = [(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)].map(DVec2::from);
        let blocks = (0..16).map(|k| DVec2::new((k % 4) as f64, (k / 4) as f64) * 4.5 + 3.0);
        let obstacles = blocks.map(|at| Some(Obstacle::rectangle(at, DVec2::splat(2.0), 0.3))).collect();
        let place = Place { areas: vec![Walkable { outer: corners.to_vec(), holes: vec![] }], obstacles };
        let goals: Vec<Goal> =
            (0..6).map(|k| Goal::Point { at: DVec2::new(0.6 + 3.7 * f64::from(k), 0.7), tolerance: 0.1 }).collect();
        let all = || (0..60).map(|row| (row, GoalId((row * row % 6) as u32)));
        let mut meshes = Meshes::default();
        meshes.prepare(all().map(|(_, goal)| (0.2, goal)), &place, &goals, (DVec2::ZERO, DVec2::ZERO));
        let size = meshes.mesh(0.2).unwrap().vertices().len() * 16;
        let found = |most: usize, at_once: usize| {
            let mut meshes = meshes.clone();
            let mut found = Vec::new();
            let asked: Vec<(usize, GoalId)> = all().collect();
            for asked in asked.chunks(at_once) {
                let ask = |&(row, goal): &(usize, GoalId)| {
                    let from = DVec2::new(0.5 + 0.3 * row as f64, 19.4);
                    PathRequest { row, radius: 0.2, from, goal, found: None }
                };
                let mut asked: Vec<PathRequest> = asked.iter().map(ask).collect();
                meshes.find_keeping(most, &goals, &mut asked);
                assert!(meshes.trees.values().map(|kept| kept.tree.bytes()).sum::<usize>() <= most);
                assert_eq!(meshes.trees.values().map(|kept| kept.tree.bytes()).sum::<usize>(), meshes.tree_bytes);
                found.extend(asked.into_iter().map(|asked| (asked.row, asked.found.unwrap().unwrap())));
            }
            found.sort_by_key(|&(row, _)| row);
            found
        };
        let expected = found(usize::MAX, 60);
        assert!(expected.iter().filter(|(_, (path, _))| path.corners.len() > 1).count() > 40);
        for (most, at_once) in [(0, 1), (0, 60), (size, 7), (2 * size, 1), (3 * size + 1, 20)] {
            assert_eq!(found(most, at_once), expected, "{most}, {at_once}");
        }
    }
}
