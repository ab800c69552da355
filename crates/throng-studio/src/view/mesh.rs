//! The navigation mesh of path planning, and the planned path of an agent.

use super::derived::Derived;
use super::geometry::{Disc, Geometry, Stroke};
use crate::play::RunMoment;
use eframe::egui::Context;
use glam::Vec3;
use std::sync::Arc;
use throng::navigate::NavMesh;
use throng::steer::SteeringReason;
use throng_draw::Theme;

/// The mesh as drawn last.
#[derive(Default)]
pub struct MeshMap {
    made: Derived<(u64, u32, bool), Geometry>,
}

impl MeshMap {
    /// Returns the triangles of the mesh for bodies of a radius: thin inner edges and stronger boundary edges. Scenes
    /// without walls have no mesh, because paths are straight.
    pub fn layer(&mut self, shown: &RunMoment, radius: f32, theme: &Theme, dark: bool, ctx: &Context) -> Arc<Geometry> {
        let setting = shown.setting.clone();
        if setting.walkable.is_empty() && setting.obstacles.is_empty() {
            return Arc::default();
        }
        let (bounds, theme) = ((shown.bounds.min, shown.bounds.max), theme.clone());
        let make = move || {
            let mesh = NavMesh::build(&setting.walkable, &setting.obstacles, f64::from(radius), bounds);
            mesh.map_or_else(|_| Geometry::default(), |mesh| lines(&mesh, setting.origin, &theme))
        };
        self.made.of((shown.run, radius.to_bits(), dark), ctx, make).unwrap_or_default()
    }
}

/// Returns the edges of a mesh, each once.
fn lines(mesh: &NavMesh, origin: glam::DVec2, theme: &Theme) -> Geometry {
    let mut edges = Geometry::default();
    let inner = Stroke::plain(0.9, theme.text.alpha(0.30));
    let outer = Stroke::plain(1.3, theme.text.alpha(0.55));
    let local = |corner: u32| (mesh.vertices()[corner as usize] - origin).as_vec2().extend(0.0);
    for (index, triangle) in (0u32..).zip(mesh.triangles()) {
        for edge in 0..3 {
            let ends = [triangle[edge], triangle[(edge + 1) % 3]].map(local);
            match mesh.neighbour(index, edge) {
                Some(other) if other < index => {}
                Some(_) => edges.line(&ends, false, inner),
                None => edges.line(&ends, false, outer),
            }
        }
    }
    edges
}

/// Returns the planned path of an agent, as far as its trace has recorded it: a line through its corners to its goal.
pub fn way(shown: &RunMoment, number: u32, theme: &Theme) -> Geometry {
    let mut way = Geometry::default();
    let accounts = &shown.frame.accounts;
    let found = accounts.binary_search_by_key(&number, |account| account.number).ok();
    let Some((account, body)) = found.map(|at| &accounts[at]).zip(super::moment::between(shown, number, shown.share()))
    else {
        return way;
    };
    let corners = account
        .entries
        .iter()
        .filter_map(|told| if let SteeringReason::Via(at) = told.reason { Some(at) } else { None });
    let corners: Vec<Vec3> = corners.collect();
    let aim =
        account.entries.iter().find_map(|told| if let SteeringReason::Aim(at) = told.reason { Some(at) } else { None });
    let begin = (body.position - shown.setting.origin).as_vec2().extend(body.altitude);
    // with corners, the aim equals the first corner
    let end = aim.filter(|_| corners.is_empty());
    let points: Vec<Vec3> = std::iter::once(begin).chain(corners).chain(end).collect();
    way.line(&points, false, Stroke::plain(2.0, theme.goal));
    for &corner in points.iter().skip(1) {
        way.discs.push(Disc::round(corner, 0.0, theme.ground, (1.4, theme.goal), 3.2));
    }
    way
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::play::{Command, Engine};
    use glam::DVec2;
    use throng::Walkable;

    #[test]
    fn a_way_leads_through_no_wall() {
        let mut engine = Engine::default();
        let scene = Arc::new(throng_scene::gallery::scene("maze").unwrap());
        engine.command(Command::Load { name: "maze".into(), scene, run: false });
        engine.command(Command::Explain(Some(0)));
        engine.command(Command::Seek(100));
        while engine.idle().is_some() {
            engine.work(std::time::Duration::from_millis(20));
        }
        let shown = engine.shown().unwrap();
        let way = way(&shown, 0, &Theme::light());
        let local = |at: DVec2| (at - shown.setting.origin).as_vec2();
        let walls = shown.setting.obstacles.iter().filter_map(|obstacle| match obstacle {
            throng::Obstacle::Wall { points } => Some(points),
            _ => None,
        });
        let walls: Vec<_> =
            walls.flat_map(|points| points.windows(2)).map(|ends| [local(ends[0]), local(ends[1])]).collect();
        let side = |p: glam::Vec2, [a, b]: [glam::Vec2; 2]| (b - a).perp_dot(p - a) > 0.0;
        let cross =
            |p: [glam::Vec2; 2], q: [glam::Vec2; 2]| side(p[0], q) != side(p[1], q) && side(q[0], p) != side(q[1], p);
        let pieces: Vec<_> = way.lines.iter().map(|line| line.ends().map(|end| end.truncate())).collect();
        assert!(pieces.len() > 8 && walls.len() > 5, "{} {}", pieces.len(), walls.len());
        assert!(pieces.iter().all(|piece| walls.iter().all(|wall| !cross(*piece, *wall))));
        assert_eq!(pieces[0][0], local(shown.frame.bodies[0].position));
    }

    #[test]
    fn every_edge_of_the_mesh_is_one_line() {
        let corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)].map(DVec2::from).to_vec();
        let hole = [(4.0, 2.0), (4.0, 4.0), (6.0, 4.0), (6.0, 2.0)].map(DVec2::from).to_vec();
        let room = Walkable { outer: corners, holes: vec![hole] };
        let mesh = NavMesh::build(&[room], &[], 0.3, (DVec2::ZERO, DVec2::ZERO)).unwrap();
        let edges = lines(&mesh, DVec2::ZERO, &Theme::light()).lines.len();
        // Euler: V - E + F = 0 for a plane mesh with one hole
        assert_eq!(edges, mesh.vertices().len() + mesh.triangles().len());
    }
}
