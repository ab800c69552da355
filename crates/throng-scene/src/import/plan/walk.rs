//! The walkable part of a triangle mesh: one level of it, as areas.
//!
//! Faces no steeper than 45° that share edges, or are joined by steps no higher than 0.4 m, are a level. One level is
//! taken: the selected one, or else the largest. Where another face is between 0.4 m and 2 m above it, agents cannot
//! pass.

use super::super::obj::{ObjUp, Triangles, triangles};
use super::drawing::{Drawing, FARTHEST, FilePosition, PlanShape, UNIT};
use super::levels::Levels;
use super::overlay::{difference, union, wall};
use crate::error::{Error, Kind};
use crate::geometry::{DVec2, DVec3, points, signed_area};
use crate::scene::Area;

/// The cosine of the steepest slope.
const STEEPEST: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// The highest step, metres.
pub(super) const STEP: f64 = 0.4;
/// The headroom that people need, metres.
const HEADROOM: f64 = 2.0;
/// The maximum number of triangles.
const MOST: usize = 200_000;

pub(super) type Face = [DVec3; 3];

/// Reads the walkable part. The vertical axis is the one along which more of the mesh is walkable.
///
/// # Errors
/// Those of OBJ; or there are too many triangles, no walkable face, or no such level.
pub(super) fn read(text: &str, unit: f64, asked: Option<u64>) -> Result<Drawing, Error> {
    let Triangles { points: corners, triangles } = triangles(text, ObjUp::Z)?;
    if triangles.len() > MOST {
        let message = format!("this mesh has {} triangles, more than {MOST}", triangles.len());
        return Err(Error::new(Kind::OutOfRange, message).hint("export less of it, or a coarser mesh"));
    }
    let face = |triangle: &[u32; 3]| triangle.map(|i| corners[i as usize].as_dvec3() * unit);
    if let Some(far) = corners.iter().find(|p| f64::from(p.abs().max_element()) * unit > FARTHEST) {
        let message = format!("the point {far} is farther than {FARTHEST} m away");
        return Err(Error::new(Kind::OutOfRange, message).hint(UNIT));
    }
    let as_is: Vec<Face> = triangles.iter().map(face).collect();
    let turned: Vec<Face> = as_is.iter().map(|face| face.map(|p| DVec3::new(p.x, -p.z, p.y))).collect();
    let flat = |faces: &[Face]| faces.iter().filter(|face| is_walkable(face)).map(size).sum::<f64>();
    let (y, z) = (flat(&turned), flat(&as_is));
    let faces = if y >= z { turned } else { as_is };
    if y.max(z) <= 0.0 {
        let message = "nothing of this mesh can be walked on: all of it is steeper than 45°, or faces down";
        return Err(Error::new(Kind::Geometry, message).hint("turn the faces of the floor so that their front is up"));
    }
    let mut drawing = Drawing::default();
    drawing
        .notes
        .whole(format!("{} is up: along it more of the mesh can be walked on", if y >= z { "y" } else { "z" }));
    let Levels { level, others, note } = Levels::of(&faces, asked)?;
    if let Some(note) = note {
        drawing.notes.whole(note);
    }
    let plan = |face: &Face| face.map(|p| p.truncate()).to_vec();
    let outlines: Vec<Vec<DVec2>> = level.iter().filter(|face| is_walkable(face)).map(plan).collect();
    let stacked = outlines.iter().map(|outline| signed_area(outline).abs()).sum::<f64>();
    let ground = union(&outlines);
    let flat: f64 = ground.iter().map(Area::size).sum();
    if stacked > flat * 1.01 {
        let lies = stacked - flat;
        drawing
            .notes
            .whole(format!("{lies:.1} m² of the level lie above others of it: people walk there as if on one floor"));
    }
    let mut areas = difference(&ground, &blocked(&level, &others)?);
    areas.sort_by(|a, b| b.size().total_cmp(&a.size()));
    let cut: f64 = areas.iter().skip(1).map(Area::size).sum();
    if cut > 0.01 {
        drawing.notes.whole(format!(
            "{cut:.1} m² that are cut off from the rest, such as the tops of what stands there, are left out"
        ));
    }
    for Area { outer, holes } in areas.into_iter().take(1) {
        drawing.add(
            "walkable",
            PlanShape::Area(points(&outer), holes.iter().map(|hole| points(hole)).collect()),
            FilePosition::Line(1),
        );
    }
    Ok(drawing)
}

/// Returns the outlines of other faces that block bodies on the level.
fn blocked(level: &[Face], others: &[Face]) -> Result<Vec<Vec<DVec2>>, Error> {
    let reach = |face: &Face| {
        let [a, b, c] = face.map(|p| p.truncate());
        [a.min(b).min(c), a.max(b).max(c)]
    };
    let mut floors: Vec<([DVec2; 2], &Face)> =
        level.iter().filter(|face| is_walkable(face)).map(|face| (reach(face), face)).collect();
    floors.sort_by(|a, b| a.0[0].x.total_cmp(&b.0[0].x));
    let widest = floors.iter().map(|([low, high], _)| high.x - low.x).fold(0.0, f64::max);
    let mut out = vec![];
    for face in others {
        let [low, high] = reach(face);
        let from = floors.partition_point(|(floor, _)| floor[0].x < low.x - widest);
        let near = floors[from..].iter().take_while(|(floor, _)| floor[0].x <= high.x);
        for (_, floor) in near.filter(|([l, h], _)| h.cmpge(low).all() && l.cmple(high).all()) {
            out.extend(shadow(face, floor));
            if out.len() > MOST * 5 {
                let message = "too much stands on this mesh to be cut out of it";
                return Err(Error::new(Kind::OutOfRange, message).hint("export the walkable faces alone"));
            }
        }
    }
    Ok(out)
}

/// Returns the part of a face that is at the height of bodies above a floor face, projected to the horizontal plane.
fn shadow(face: &Face, floor: &Face) -> Option<Vec<DVec2>> {
    let up = (floor[1] - floor[0]).cross(floor[2] - floor[0]);
    let above = |p: DVec3| (p - floor[0]).dot(up) / up.z;
    let mut rest: Vec<DVec3> = face.to_vec();
    for k in 0..3 {
        let (a, b) = (floor[k].truncate(), floor[(k + 1) % 3].truncate());
        rest = clipped(&rest, |p| (b - a).perp_dot(p.truncate() - a));
    }
    rest = clipped(&rest, |p| above(p) - STEP);
    rest = clipped(&rest, |p| HEADROOM - above(p));
    let plan: Vec<DVec2> = rest.iter().map(|p| p.truncate()).collect();
    if plan.len() < 2 || signed_area(&plan).abs() > 1e-6 {
        return (plan.len() > 2).then_some(plan);
    }
    let from = plan.iter().copied().fold(plan[0], |a, b| if b.distance(plan[0]) > a.distance(plan[0]) { b } else { a });
    let to = plan.iter().copied().fold(from, |a, b| if b.distance(from) > a.distance(from) { b } else { a });
    (from != to).then(|| wall(from, to))
}

/// Returns the part of a convex outline where a linear function is at least 0.
fn clipped(outline: &[DVec3], side: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut out = vec![];
    for (a, b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
        let (s, t) = (side(*a), side(*b));
        if s >= 0.0 {
            out.push(*a);
        }
        if (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0) {
            out.push(a.lerp(*b, s / (s - t)));
        }
    }
    out
}

pub(super) fn is_walkable(face: &Face) -> bool {
    let normal = (face[1] - face[0]).cross(face[2] - face[0]);
    normal.z > STEEPEST * normal.length()
}

/// Returns the area of a face in the horizontal plane, m².
pub(super) fn size(face: &Face) -> f64 {
    signed_area(&face.map(|p| p.truncate())).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a box above a floor, y up; `low` is the height of its bottom.
    fn boxed(low: f64) -> String {
        let mut text = String::from("v 0 0 0\nv 10 0 0\nv 10 0 -10\nv 0 0 -10\nf 1 2 3 4\n");
        for (x, y, z) in [(4, 0, 4), (6, 0, 4), (6, 0, 6), (4, 0, 6), (4, 3, 4), (6, 3, 4), (6, 3, 6), (4, 3, 6)] {
            text += &format!("v {x} {} -{z}\n", f64::from(y) + low);
        }
        // bottom, top, sides
        text + "f 8 7 6 5\nf 9 10 11 12\nf 5 6 10 9\nf 6 7 11 10\nf 7 8 12 11\nf 8 5 9 12\n"
    }

    fn ground(text: &str) -> (f64, usize) {
        let drawing = read(text, 1.0, None).unwrap();
        let PlanShape::Area(outer, holes) = &drawing.items[0].form else { panic!("{drawing:?}") };
        (signed_area(outer).abs() - holes.iter().map(|hole| signed_area(hole).abs()).sum::<f64>(), holes.len())
    }

    #[test]
    fn what_stands_on_the_floor_is_a_hole_in_it() {
        let (size, holes) = ground(&boxed(0.0));
        // its walls reach out by a centimetre
        assert_eq!(holes, 1);
        assert!((size - (100.0 - 2.02 * 2.02)).abs() < 1e-3, "{size}");
    }

    #[test]
    fn people_walk_under_what_is_high_enough() {
        let (size, holes) = ground(&boxed(2.5));
        assert!(holes == 0 && (size - 100.0).abs() < 1e-6, "{size}");
        let (size, holes) = ground(&boxed(1.5));
        assert!(holes == 1 && (size - 96.0).abs() < 0.1, "{size}");
    }

    #[test]
    fn steps_join_floors_and_a_storey_does_not() {
        let floors = |rise: f64| {
            format!(
                "v 0 0 0\nv 5 0 0\nv 5 0 -4\nv 0 0 -4\nv 5 {rise} 0\nv 5 {rise} -4\nv 9 {rise} 0\nv 9 {rise} -4\n\
                 f 1 2 3 4\nf 2 5 6 3\nf 5 7 8 6\n"
            )
        };
        assert!((ground(&floors(0.2)).0 - 36.0).abs() < 1e-6);
        assert!((ground(&floors(3.0)).0 - 20.0).abs() < 0.2);
    }
}
