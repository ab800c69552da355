//! Obstacles and ground.

use super::super::notes::Notes;
use super::super::plan::union;
use super::nav;
use super::xml::{Xml, children};
use crate::error::{Error, Kind};
use crate::file::read_text;
use crate::geometry::{DVec2, contains, crossing, signed_area};
use crate::import::short;
use crate::scene::{Area, Obstacle, Shape};
use std::path::Path;

/// The ground and obstacles of a project.
#[derive(Debug, Default)]
pub(super) struct MengeGround {
    pub walkable: Vec<Area>,
    pub obstacles: Vec<Obstacle>,
}

/// Reads the obstacles that at least one profile heeds. `heeded` has the bits of their classes, `people` the places of
/// all agents.
pub(super) fn read(
    xml: &Xml,
    folder: &Path,
    heeded: u64,
    people: &[DVec2],
    notes: &mut Notes,
) -> Result<MengeGround, Error> {
    let mut ground = MengeGround::default();
    // outlines that agents walk around are counter-clockwise, outlines around agents clockwise
    let mut rooms: Vec<Vec<DVec2>> = vec![];
    for node in children(xml.document.root_element(), "ObstacleSet") {
        let class = xml.number(node, "class")?.unwrap_or(1.0) as u64;
        if class & heeded == 0 {
            notes.about(&format!("obstacles of class {class}"), "no profile heeds them: left out");
            continue;
        }
        match xml.text(node, "type")? {
            "explicit" => {
                for obstacle in children(node, "Obstacle") {
                    let mut points = vec![];
                    for vertex in children(obstacle, "Vertex") {
                        points.push(DVec2::new(xml.needed(vertex, "p_x")?, xml.needed(vertex, "p_y")?));
                    }
                    points.dedup();
                    let closed = obstacle.attribute("closed").is_some_and(|closed| closed != "0" && closed != "false");
                    if points.len() < 2 {
                        return Err(xml.wrong(obstacle, Kind::Geometry, "this obstacle has fewer than two vertices"));
                    }
                    let solid = closed && points.len() > 2 && crossing(&points).is_none();
                    if solid && signed_area(&points) > 0.0 {
                        ground.obstacles.push(Shape::Polygon(plain(&points)).into());
                    } else if solid && signed_area(&points) < 0.0 {
                        rooms.push(points);
                    } else {
                        ground.obstacles.push(wall(points, closed));
                    }
                }
            }
            "nav_mesh" => {
                let file = folder.join(xml.text(node, "file_name")?.replace('\\', "/"));
                let text = read_text(&file)?;
                let polygons = nav::polygons(&text).map_err(|error| error.file(file.display().to_string()))?;
                ground.walkable.extend(union(&polygons));
                notes.whole("the navigation mesh is the ground; its heights are left out");
            }
            other => {
                let shown = short(other);
                return Err(xml.wrong(node, Kind::UnknownKey, format!("obstacles of the kind `{shown}` are not read")));
            }
        }
    }
    if ground.walkable.is_empty() && people.iter().all(|p| rooms.iter().any(|room| contains(room, *p))) {
        ground.walkable = rooms.iter().map(|room| Area { outer: plain(room), holes: vec![] }).collect();
    } else {
        // an agent is outside of them
        ground.obstacles.extend(rooms.into_iter().map(|room| wall(room, true)));
    }
    Ok(ground)
}

fn wall(mut points: Vec<DVec2>, closed: bool) -> Obstacle {
    if closed {
        points.extend(points.first().copied());
    }
    Shape::Wall(plain(&points)).into()
}

fn plain(points: &[DVec2]) -> Vec<[f64; 2]> {
    points.iter().map(DVec2::to_array).collect()
}
