//! The free ground as polygons with holes: the union of walkable areas minus obstacles and a margin of a radius.

use super::error::{NavError, Ring};
use super::inflate::{Inflation, disc};
use super::lattice::{Lattice, LatticePoint, WIDEST, steps, turn};
use crate::space::{Obstacle, Walkable};
use glam::DVec2;
use i_overlay::core::{fill_rule::FillRule, overlay::Overlay, overlay::ShapeType, overlay_rule::OverlayRule};

/// Polygons with holes: each is a list of contours with the ground to their left.
pub(super) type Shapes = Vec<Vec<Vec<LatticePoint>>>;

/// Number of contours above which they are united before they are subtracted from the ground.
const MANY: usize = 64;
/// Maximum number of contours that are united in one operation.
const GROUP: usize = 8;
/// Number of corners above which a boundary is cut into pieces, so that their strips can be united in groups.
const LONG: usize = 4096;
/// Edges of a piece of a boundary.
const PIECE: usize = 8;

/// Returns the free ground for the centre of a disc of `radius`. Without walkable areas the ground is the box `bounds`,
/// extended so that there is a path around every obstacle.
pub(super) fn free_ground(
    walkable: &[Walkable],
    obstacles: &[Obstacle],
    radius: f64,
    bounds: (DVec2, DVec2),
) -> Result<(Lattice, Shapes), NavError> {
    let (low, high) = extent(walkable, obstacles, radius, bounds)?;
    let lattice = Lattice::near((low + high) * 0.5);
    let mut solid = merge(solids(&lattice, obstacles, radius)?);
    let ground = if walkable.is_empty() {
        vec![vec![[low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)].map(|p| lattice.point(p)).to_vec()]]
    } else {
        let ground = unite(&lattice, walkable)?;
        strips(&ground, radius, &mut solid);
        ground
    };
    let free = subtract(&ground, &solid);
    if free.is_empty() { Err(NavError::NoRoom { radius }) } else { Ok((lattice, free)) }
}

/// Returns `shapes` without the points nearer than `radius` to their boundary.
pub(super) fn erode(shapes: &Shapes, radius: f64) -> Shapes {
    let mut solid = Vec::new();
    strips(shapes, radius, &mut solid);
    subtract(shapes, &solid)
}

/// Returns `shapes` and all points nearer than `radius` to them.
pub(super) fn grow(shapes: &Shapes, radius: f64) -> Shapes {
    let brush = Inflation::new(radius);
    let grown: Vec<_> = shapes.iter().flatten().map(|contour| brush.ring(contour)).collect();
    Overlay::from_subj(&grown).overlay(OverlayRule::Subject, FillRule::Positive)
}

/// Returns an area of any form, given by its corners, as shapes.
pub(super) fn area_shapes(lattice: &Lattice, corners: &[DVec2]) -> Result<Shapes, NavError> {
    Ok(fill(&ring(lattice, corners, Ring::Goal, 3)?))
}

/// Returns a box around all areas and obstacles, and checks its size.
fn extent(
    walkable: &[Walkable],
    obstacles: &[Obstacle],
    radius: f64,
    bounds: (DVec2, DVec2),
) -> Result<(DVec2, DVec2), NavError> {
    if !(radius > 0.0 && radius < WIDEST) {
        return Err(NavError::Limit { what: "the radius of a navigation mesh", value: radius, limit: "> 0" });
    }
    let mut low = DVec2::INFINITY;
    let mut high = DVec2::NEG_INFINITY;
    let mut take = |points: &[DVec2], around: f64, ring: Ring| {
        for (point, at) in points.iter().enumerate() {
            if !at.is_finite() {
                return Err(NavError::NotFinite { ring, point });
            }
            low = low.min(*at - DVec2::splat(around));
            high = high.max(*at + DVec2::splat(around));
        }
        Ok(())
    };
    for (area, ground) in walkable.iter().enumerate() {
        take(&ground.outer, 0.0, Ring::Outer { area })?;
        for (hole, corners) in ground.holes.iter().enumerate() {
            take(corners, 0.0, Ring::Hole { area, hole })?;
        }
    }
    let around = 3.0 * radius + 1.0;
    for (index, obstacle) in obstacles.iter().enumerate() {
        let name = Ring::Obstacle { index };
        match obstacle {
            Obstacle::Circle { center, radius } => {
                if !(*radius > 0.0 && *radius < WIDEST) {
                    return Err(NavError::Limit { what: "the radius of an obstacle", value: *radius, limit: "> 0" });
                }
                take(&[*center], radius + around, name)?;
            }
            Obstacle::Polygon { corners } => take(corners, around, name)?,
            Obstacle::Wall { points } => take(points, around, name)?,
        }
    }
    if walkable.is_empty() {
        for at in [bounds.0, bounds.1] {
            if at.is_finite() {
                low = low.min(at);
                high = high.max(at);
            }
        }
    }
    let size = (high - low).max_element();
    if size > WIDEST {
        return Err(NavError::TooWide { size, limit: WIDEST });
    }
    if low.is_finite() && high.is_finite() { Ok((low, high)) } else { Err(NavError::NoRoom { radius }) }
}

/// Returns the inflated outlines of all obstacles.
fn solids(lattice: &Lattice, obstacles: &[Obstacle], radius: f64) -> Result<Vec<Vec<LatticePoint>>, NavError> {
    let brush = Inflation::new(radius);
    let mut solid = Vec::new();
    for (index, obstacle) in obstacles.iter().enumerate() {
        let name = Ring::Obstacle { index };
        match obstacle {
            Obstacle::Circle { center, radius: own } => solid.push(disc(lattice.point(*center), own + radius)),
            Obstacle::Wall { points } => {
                let mut chain: Vec<_> = points.iter().map(|&point| lattice.point(point)).collect();
                chain.dedup();
                if chain.len() < 2 {
                    return Err(NavError::TooFewCorners { ring: name, found: chain.len(), needed: 2 });
                }
                solid.push(brush.chain(&chain));
            }
            Obstacle::Polygon { corners } => {
                let corners = ring(lattice, corners, name, 2)?;
                let filled = fill(&corners);
                if filled.is_empty() {
                    solid.push(brush.chain(&corners));
                }
                solid.extend(filled.iter().flatten().map(|contour| brush.ring(contour)));
            }
        }
    }
    Ok(solid)
}

/// Returns the union of walkable areas, as disjoint areas. A single area is unchanged; others are rounded to the
/// lattice.
pub(crate) fn union(areas: Vec<Walkable>) -> Result<Vec<Walkable>, NavError> {
    if areas.len() < 2 {
        return Ok(areas);
    }
    let (low, high) = extent(&areas, &[], 1.0, (DVec2::ZERO, DVec2::ZERO))?;
    let lattice = Lattice::near((low + high) * 0.5);
    let metres = |contour: Vec<LatticePoint>| contour.into_iter().map(|point| lattice.metres(point)).collect();
    let walkable = |shape: Vec<Vec<LatticePoint>>| {
        let mut contours = shape.into_iter().map(metres);
        Walkable { outer: contours.next().unwrap_or_default(), holes: contours.collect() }
    };
    Ok(unite(&lattice, &areas)?.into_iter().map(walkable).collect())
}

/// Returns the union of walkable areas.
fn unite(lattice: &Lattice, walkable: &[Walkable]) -> Result<Shapes, NavError> {
    let mut union = Overlay::new(64);
    for (area, ground) in walkable.iter().enumerate() {
        let outer = fill(&ring(lattice, &ground.outer, Ring::Outer { area }, 3)?);
        let mut holes = Vec::new();
        for (hole, corners) in ground.holes.iter().enumerate() {
            holes.extend(fill(&ring(lattice, corners, Ring::Hole { area, hole }, 3)?).into_iter().flatten());
        }
        union.add_source(&if holes.is_empty() { outer } else { subtract(&outer, &holes) }, ShapeType::Subject);
    }
    Ok(union.overlay(OverlayRule::Subject, FillRule::Positive))
}

/// Adds outlines of the strips along the boundary of `shapes`, on their inside.
fn strips(shapes: &Shapes, radius: f64, solid: &mut Vec<Vec<LatticePoint>>) {
    let brush = Inflation::new(radius);
    for contour in shapes.iter().flatten() {
        if contour.len() > LONG {
            let closed = [contour, &contour[..1]].concat();
            // pieces share the corners where they meet
            let pieces =
                (0..contour.len()).step_by(PIECE).map(|from| &closed[from..closed.len().min(from + PIECE + 1)]);
            solid.extend(merge(pieces.map(|piece| brush.chain(piece)).collect()));
        } else {
            let wall: Vec<_> = contour.iter().rev().copied().collect();
            solid.push(brush.ring(&wall));
            solid.push(contour.clone());
        }
    }
}

/// Returns contours around the same ground as these together; fewer contours if there are many.
fn merge(contours: Vec<Vec<LatticePoint>>) -> Vec<Vec<LatticePoint>> {
    if contours.len() > MANY { united(contours) } else { contours }
}

/// Returns the union of contours. Neighbours are united first, because intersecting all contours at once takes memory
/// and time in the square of their number.
fn united(mut parts: Vec<Vec<LatticePoint>>) -> Vec<Vec<LatticePoint>> {
    if parts.len() > GROUP {
        let middle = |contour: &[LatticePoint], across: fn(&LatticePoint) -> i64| {
            let (low, high) = (contour.iter().map(across).min(), contour.iter().map(across).max());
            low.zip(high).map_or(0, |(low, high)| low.midpoint(high))
        };
        let spread = |across| {
            let middles = || parts.iter().map(|contour| middle(contour, across));
            middles().max().zip(middles().min()).map_or(0, |(most, least)| most - least)
        };
        let across: fn(&LatticePoint) -> i64 = if spread(|p| p.x) > spread(|p| p.y) { |p| p.x } else { |p| p.y };
        parts.sort_by_cached_key(|contour| middle(contour, across));
        let rest = parts.split_off(parts.len() / 2);
        parts = [parts, rest].map(united).concat();
    }
    Overlay::from_subj(&parts).overlay(OverlayRule::Subject, FillRule::Positive).concat()
}

/// Returns `shapes` without the inside of `solid`.
fn subtract(shapes: &Shapes, solid: &[Vec<LatticePoint>]) -> Shapes {
    let mut difference = Overlay::from_subj(shapes);
    difference.add_source(solid, ShapeType::Clip);
    difference.overlay(OverlayRule::Difference, FillRule::Positive)
}

/// Returns the inside of a ring, in either orientation; the ring can touch itself.
fn fill(ring: &[LatticePoint]) -> Shapes {
    Overlay::from_subj(ring).overlay(OverlayRule::Subject, FillRule::NonZero)
}

/// Returns the distinct corners of a ring on the lattice, and checks the ring for crossings.
fn ring(lattice: &Lattice, corners: &[DVec2], name: Ring, needed: usize) -> Result<Vec<LatticePoint>, NavError> {
    if let Some(point) = corners.iter().position(|at| !at.is_finite()) {
        return Err(NavError::NotFinite { ring: name, point });
    }
    let mut kept: Vec<(usize, LatticePoint)> =
        corners.iter().enumerate().map(|(index, &at)| (index, lattice.point(at))).collect();
    kept.dedup_by_key(|corner| corner.1);
    while kept.len() > 1 && kept[0].1 == kept[kept.len() - 1].1 {
        kept.pop();
    }
    if kept.len() < needed {
        return Err(NavError::TooFewCorners { ring: name, found: kept.len(), needed });
    }
    let points: Vec<_> = kept.iter().map(|corner| corner.1).collect();
    if let Some((first, second, at)) = crossing(&points) {
        let at = lattice.metres(super::lattice::round(at));
        return Err(NavError::SelfCrossing { ring: name, first: kept[first].0, second: kept[second].0, at });
    }
    Ok(points)
}

/// Returns two edges of a ring that cross, by a sweep along x, and the point where they cross. Touching is not
/// crossing.
fn crossing(ring: &[LatticePoint]) -> Option<(usize, usize, DVec2)> {
    let end = |edge: usize| ring[(edge + 1) % ring.len()];
    let span = |edge: usize| (ring[edge].x.min(end(edge).x), ring[edge].x.max(end(edge).x));
    let mut order: Vec<usize> = (0..ring.len()).collect();
    order.sort_by_key(|&edge| (span(edge).0, edge));
    for (rank, &one) in order.iter().enumerate() {
        for &other in order[rank + 1..].iter().take_while(|&&other| span(other).0 <= span(one).1) {
            let (a, b, c, d) = (ring[one], end(one), ring[other], end(other));
            let (left, right) = (turn(a, b, c), turn(a, b, d));
            if left.signum() * right.signum() < 0 && turn(c, d, a).signum() * turn(c, d, b).signum() < 0 {
                let part = left as f64 / (left as f64 - right as f64);
                return Some((one.min(other), one.max(other), steps(c) + (steps(d) - steps(c)) * part));
            }
        }
    }
    None
}
