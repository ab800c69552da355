//! A plan as a scene: agents start in the start places, or anywhere on the ground, and leave by the nearest exit.

use super::super::{Imported, roomy};
use super::PlanOptions;
use super::assemble::{PlanParts, Start};
use crate::assemble::{has_room, solid_shape};
use crate::error::{Error, Kind};
use crate::geometry::{DVec2, Solid, bounds, contains, rectangle, signed_area};
use crate::registry::{Goal, Place};
use crate::scene::{
    Area, Body, ExitGoal, Group, NearestGoal, Number, PointsPlace, PolygonPlace, Rectangle, Region, Scene, Walkable,
    WalkablePlace,
};
use std::path::Path;

/// Ground per agent if the plan gives no number, m².
const EACH: f64 = 4.0;
/// Maximum of that number.
const MOST: f64 = 1000.0;
/// Up to this part of a place under bodies, positions are drawn at random.
const DRAWN: f64 = 0.45;
/// Distance between bodies in rows, relative to contact.
const APART: f64 = 1.01;
/// The least distance between bodies at the start, metres.
const GAP: f64 = 0.05;

pub(super) fn scene(name: &str, mut parts: PlanParts, ask: &PlanOptions) -> Result<Imported, Error> {
    let stem = Path::new(name).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let goal = goal(name, &mut parts, ask)?;
    if parts.walkable.is_empty() && parts.starts.is_empty() {
        let message = "nothing of this plan says where people can be";
        return Err(Error::new(Kind::Geometry, message)
            .hint("name the layer of the ground `walkable`, or one of places to start from `start`"));
    }
    let groups = if parts.starts.is_empty() {
        let size = parts.walkable.iter().map(Area::size).sum();
        let count = ask.people.unwrap_or_else(|| chosen(&mut parts, size));
        let place = WalkablePlace { gap: GAP }.into();
        vec![Group { name: "people".into(), count: Some(count), place, goal: Some(goal), ..Group::default() }]
    } else {
        starting(&mut parts, ask, &goal)
    };
    let count: u64 = groups.iter().filter_map(|group| group.count).sum();
    let mut areas = std::mem::take(&mut parts.walkable);
    let walkable = match areas.len() {
        0 => None,
        1 => areas.pop().map(Walkable::Polygon),
        _ => Some(Walkable::Polygons(areas)),
    };
    let title = format!("{count} {} {stem}", if count == 1 { "person leaves" } else { "people leave" });
    let scene = Scene { title, walkable, obstacles: parts.obstacles, groups, ..Scene::default() };
    Ok(Imported { scene, notes: parts.notes.lines() })
}

/// Returns the goal: the requested exit, or else the nearest of the plan's exits.
fn goal(name: &str, parts: &mut PlanParts, ask: &PlanOptions) -> Result<Goal, Error> {
    let radius = f64::from(throng::Agent::default().radius);
    let walkable: Vec<_> = parts.walkable.iter().map(Area::walkable).collect();
    let solid = solid(parts, radius);
    if let Some([x, y, width, height]) = ask.exit {
        let exit = Rectangle::between([x, y], [x + width, y + height]);
        reachable(&walkable, &solid, &exit, radius)?;
        return Ok(ExitGoal(Region::Rectangle(exit)).into());
    }
    if parts.exits.is_empty() {
        let other = match name.ends_with(".wkt") {
            true => format!("write a scene file with `walkable.file = \"{name}\"` and a [[group]]"),
            false => "give the layer of its exits a name such as `exit`".to_owned(),
        };
        let hint =
            format!("say where the exit is and how many people: --exit x,y,width,height --people 500; or {other}");
        return Err(
            Error::new(Kind::NotAScene, format!("{name} is a floor plan, not a scene: it has no exit")).hint(hint)
        );
    }
    let mut exits = vec![];
    for (i, corners) in parts.exits.iter().enumerate() {
        let exit = roomy(&solid, corners, radius, &format!("exit {}", i + 1), &mut parts.notes);
        exits.push(ExitGoal(exit).into());
    }
    Ok(if exits.len() == 1 { exits.remove(0) } else { NearestGoal(exits).into() })
}

/// Returns a group for every start place: the requested number of agents, divided by the areas of the places, or the
/// plan's number, or as many as there is room for.
fn starting(parts: &mut PlanParts, ask: &PlanOptions, goal: &Goal) -> Vec<Group> {
    let sizes: Vec<f64> = parts.starts.iter().map(|start| signed_area(&start.corners).abs()).collect();
    let counts = match ask.people {
        Some(people) => shares(people, &sizes),
        None => {
            let said: Vec<Option<u64>> = parts.starts.iter().map(|start| start.people).collect();
            let unsaid = sizes.iter().zip(&said).filter(|(_, said)| said.is_none());
            let unsaid: Vec<f64> = unsaid.map(|(size, _)| *size).collect();
            let mut rest = if unsaid.is_empty() { vec![] } else { shares(chosen(parts, unsaid.iter().sum()), &unsaid) }
                .into_iter();
            said.into_iter().map(|said| said.or_else(|| rest.next()).unwrap_or_default()).collect()
        }
    };
    let group = |(i, (start, count)): (usize, (&Start, u64))| Group {
        name: if parts.starts.len() == 1 { "people".into() } else { format!("people-{}", i + 1) },
        count: Some(count),
        place: standing(start, count, parts),
        goal: Some(goal.clone()),
        body: start.radius.map_or_else(Body::default, |radius| Body::Radius(Number::Constant(radius))),
        ..Group::default()
    };
    let groups = parts.starts.iter().zip(counts).enumerate().map(group);
    groups.filter(|group| group.count.is_some_and(|count| count > 0)).collect()
}

/// Returns the number of agents if the plan gives none, with a note.
fn chosen(parts: &mut PlanParts, size: f64) -> u64 {
    let count = (size / EACH).clamp(1.0, MOST) as u64;
    parts.notes.whole(format!("nothing says how many people there are: {count}, one on every {EACH} m² and {MOST} at most; --people N changes it"));
    count
}

/// Divides a number in proportion to sizes. The largest remainders get the rest.
fn shares(people: u64, sizes: &[f64]) -> Vec<u64> {
    let whole: f64 = sizes.iter().sum();
    let exact: Vec<f64> = sizes.iter().map(|size| people as f64 * size / whole).collect();
    let mut counts: Vec<u64> = exact.iter().map(|share| *share as u64).collect();
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by(|i, k| exact[*k].fract().total_cmp(&exact[*i].fract()).then(i.cmp(k)));
    let left = people.saturating_sub(counts.iter().sum());
    for i in order.into_iter().cycle().take((left as usize).min(sizes.len())) {
        counts[i] += 1;
    }
    counts
}

/// Returns the solid parts for bodies up to a radius.
fn solid(parts: &PlanParts, radius: f64) -> Solid {
    let obstacles: Vec<_> = parts.obstacles.iter().map(|obstacle| solid_shape(&obstacle.shape)).collect();
    Solid::new(&parts.walkable.iter().map(Area::walkable).collect::<Vec<_>>(), &obstacles, radius)
}

/// Returns the positions of the agents of a start place: random; or, if there are too many agents for that, in
/// staggered rows with evenly spread gaps.
fn standing(start: &Start, count: u64, parts: &PlanParts) -> Place {
    let corners = &start.corners;
    let drawn = PolygonPlace { corners: corners.iter().map(DVec2::to_array).collect(), gap: 0.0 }.into();
    let radius = start.radius.unwrap_or(f64::from(throng::Agent::default().radius));
    let bodies = count as f64 * std::f64::consts::PI * radius * radius;
    let Some([low, high]) = bounds(corners.iter().copied()).filter(|_| bodies > DRAWN * signed_area(corners).abs())
    else {
        return drawn;
    };
    let solid = solid(parts, radius);
    let step = DVec2::new(2.0, 3f64.sqrt()) * radius * APART;
    let [columns, rows] = ((high - low) / step).to_array().map(|count| count.min(2000.0) as u32 + 1);
    let spot = |(row, column): (u32, u32)| {
        let shift = if row % 2 == 1 { 0.5 } else { 0.0 };
        low + DVec2::new(f64::from(column) + shift, f64::from(row)) * step + radius * 1e-3
    };
    let spots = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))).map(spot);
    let free: Vec<DVec2> = spots.filter(|p| contains(corners, *p) && solid.fits(*p, radius)).collect();
    if (free.len() as u64) < count {
        return drawn;
    }
    let chosen = (0..count as usize).map(|k| free[k * free.len() / count as usize].to_array());
    PointsPlace(chosen.collect()).into()
}

/// Checks that a body of the default size fits somewhere in an exit.
fn reachable(ground: &[throng::Walkable], solid: &Solid, exit: &Rectangle, radius: f64) -> Result<(), Error> {
    if has_room(solid, &rectangle(exit), radius) {
        return Ok(());
    }
    let reach = bounds(ground.iter().flat_map(|area| area.outer.iter().copied())).unwrap_or_default();
    let [low, high] = reach.map(|p| format!("({:.1}, {:.1})", p.x, p.y));
    let ([x, y], [width, height]) = (exit.center, exit.size);
    let radius = throng::Agent::default().radius;
    Err(Error::new(
        Kind::GoalInWall,
        format!(
            "the exit, {width} by {height} m round ({x}, {y}), has no room for a body of radius {radius} m on the \
             ground, which lies between {low} and {high}"
        ),
    )
    .hint("move it, or make it reach further in: it counts as entered when the body's centre is inside"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_in_proportion_and_sum_up() {
        assert_eq!(shares(10, &[1.0, 1.0, 2.0]), [3, 2, 5]);
        assert_eq!(shares(0, &[1.0, 1.0]), [0, 0]);
        assert_eq!(shares(7, &[1e-3, 1e3]), [0, 7]);
        for people in 0..50 {
            assert_eq!(shares(people, &[1.0, 0.3, 7.7, 2.2]).iter().sum::<u64>(), people);
        }
    }
}
