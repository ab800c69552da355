//! Unions, differences and outlines of polygons with holes.

use crate::error::{Error, Kind};
use crate::geometry::{DVec2, bounds, points, signed_area};
use crate::scene::{Area, Point};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
#[cfg(feature = "svg")]
use i_overlay::mesh::float::{stroke::offset::StrokeOffset, style::StrokeStyle};

type OverlayRing = Vec<Point>;

/// Greater coordinates are not processed here.
pub(super) const FARTHEST: f64 = 1e9;

/// Half the width of walls without a width, metres.
pub(super) const THIN: f64 = 0.01;

/// Returns the union of outlines of any orientation.
pub(in super::super) fn union(outlines: &[Vec<DVec2>]) -> Vec<Area> {
    let rings: Vec<OverlayRing> = outlines.iter().map(|outline| turned(outline)).collect();
    areas(rings.overlay(&Vec::<OverlayRing>::new(), OverlayRule::Subject, FillRule::NonZero))
}

/// Returns the union of areas minus outlines.
pub(super) fn difference(ground: &[Area], less: &[Vec<DVec2>]) -> Vec<Area> {
    let mut rings: Vec<OverlayRing> = vec![];
    for Area { outer, holes } in ground {
        rings.push(turned(&points(outer)));
        // opposite orientation: ground of another area in the hole stays ground
        rings.extend(holes.iter().map(|hole| turned(&points(hole)).into_iter().rev().collect()));
    }
    let less: Vec<OverlayRing> = less.iter().map(|outline| turned(outline)).collect();
    areas(rings.overlay(&less, OverlayRule::Difference, FillRule::NonZero))
}

/// Returns the union of outlines minus the union of solid outlines: areas that are separate from each other. Outlines
/// may overlap, and have either orientation.
///
/// ```
/// use glam::DVec2;
/// use throng_scene::import::plan::cut_ground;
/// let square = |low: f64, high: f64| [(low, low), (high, low), (high, high), (low, high)].map(DVec2::from).to_vec();
/// let ground = cut_ground(&[square(0.0, 4.0), square(3.0, 6.0)], &[square(1.0, 2.0)])?;
/// assert_eq!((ground.len(), ground[0].holes.len()), (1, 1));
/// # Ok::<(), throng_scene::Error>(())
/// ```
///
/// # Errors
/// A coordinate is not finite, or farther than 1e9 m away.
pub fn cut_ground(ground: &[Vec<DVec2>], solids: &[Vec<DVec2>]) -> Result<Vec<throng::Walkable>, Error> {
    let far = ground.iter().chain(solids).flatten().find(|at| !at.is_finite() || at.abs().max_element() > FARTHEST);
    if let Some(far) = far {
        let message = format!("the corner {far} is farther than {FARTHEST} m away");
        return Err(Error::new(Kind::OutOfRange, message).hint("move the shapes to where the scene is"));
    }
    let areas = difference(&union(ground), solids);
    let walkable = |area: Area| {
        let holes = area.holes.iter().map(|hole| points(hole)).collect();
        throng::Walkable { outer: points(&area.outer), holes }
    };
    Ok(areas.into_iter().map(walkable).collect())
}

/// Returns the areas that rings enclose, by the even-odd or the non-zero rule.
pub(super) fn enclosed(rings: &[Vec<DVec2>], even_odd: bool) -> Vec<Area> {
    let rule = if even_odd { FillRule::EvenOdd } else { FillRule::NonZero };
    let rings: Vec<OverlayRing> = rings.iter().map(|ring| ring.iter().map(DVec2::to_array).collect()).collect();
    areas(rings.overlay(&Vec::<OverlayRing>::new(), OverlayRule::Subject, rule))
}

/// Returns the areas of a stroked line.
#[cfg(feature = "svg")]
pub(super) fn stroked(line: &[DVec2], closed: bool, style: StrokeStyle<Point>) -> Vec<Area> {
    let line: OverlayRing = line.iter().map(DVec2::to_array).collect();
    areas(line.stroke(style, closed))
}

/// Returns the same ground in parts without holes: cuts run through the holes.
pub(super) fn parts(area: Area) -> Vec<OverlayRing> {
    let (mut todo, mut done) = (vec![area], vec![]);
    while let Some(area) = todo.pop() {
        let corners = |ring: &OverlayRing| bounds(ring.iter().map(|p| DVec2::from_array(*p)));
        let (Some([low, high]), Some(hole)) = (corners(&area.outer), area.holes.first().and_then(corners)) else {
            done.push(area.outer);
            continue;
        };
        let (cut, low, high) = ((hole[0].x + hole[1].x) * 0.5, low - 1.0, high + 1.0);
        let rings: Vec<OverlayRing> = std::iter::once(area.outer).chain(area.holes).collect();
        for (from, to) in [(low.x, cut), (cut, high.x)] {
            let half: Vec<OverlayRing> = vec![vec![[from, low.y], [to, low.y], [to, high.y], [from, high.y]]];
            todo.extend(areas(rings.overlay(&half, OverlayRule::Intersect, FillRule::EvenOdd)));
        }
    }
    done
}

/// Returns the outline of a wall without a width: it extends [`THIN`] to each side.
pub(super) fn wall(from: DVec2, to: DVec2) -> Vec<DVec2> {
    let along = (to - from).normalize_or_zero() * THIN;
    let left = along.perp();
    vec![from - along - left, to + along - left, to + along + left, from - along + left]
}

/// Returns the outline in counter-clockwise order.
fn turned(outline: &[DVec2]) -> OverlayRing {
    let mut ring: OverlayRing = outline.iter().map(DVec2::to_array).collect();
    if signed_area(outline) < 0.0 {
        ring.reverse();
    }
    ring
}

fn areas(shapes: Vec<Vec<OverlayRing>>) -> Vec<Area> {
    let area = |shape: Vec<OverlayRing>| {
        let mut rings = shape.into_iter();
        Area { outer: rings.next().unwrap_or_default(), holes: rings.collect() }
    };
    shapes.into_iter().map(area).filter(|area| area.outer.len() > 2).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Vec<DVec2> {
        [(low, low), (low, high), (high, high), (high, low)].map(DVec2::from).to_vec()
    }

    fn size(ring: &[Point]) -> f64 {
        signed_area(&points(ring)).abs()
    }

    #[test]
    fn squares_are_put_together_and_taken_out() {
        let both = union(&[square(0.0, 2.0), square(1.0, 3.0)]);
        assert_eq!((both.len(), both[0].holes.len()), (1, 0));
        assert!((size(&both[0].outer) - 7.0).abs() < 1e-6);
        let ground = |low, high| Area { outer: turned(&square(low, high)), holes: vec![] };
        let framed = difference(&[ground(0.0, 4.0)], &[square(1.0, 3.0)]);
        assert_eq!((framed.len(), framed[0].holes.len()), (1, 1));
        assert!((size(&framed[0].holes[0]) - 4.0).abs() < 1e-6);
        // a hole of one area is filled where another area has ground
        let filled = [framed[0].clone(), ground(1.0, 2.0)];
        let filled = difference(&filled, &[square(2.0, 2.5)]);
        let whole: f64 = filled.iter().map(Area::size).sum();
        assert!((whole - 13.0).abs() < 1e-6, "{whole}");
        let rings = [square(0.0, 4.0), square(1.0, 3.0)];
        assert_eq!(enclosed(&rings, true)[0].holes.len(), 1);
        assert_eq!(enclosed(&rings, false)[0].holes.len(), 0);
    }

    #[test]
    fn parts_have_no_holes_and_the_same_size() {
        let holes: Vec<Vec<DVec2>> =
            (0..5).map(|i| square(f64::from(i) * 2.0 + 0.5, f64::from(i) * 2.0 + 1.5)).collect();
        let ground = Area { outer: turned(&square(0.0, 10.0)), holes: vec![] };
        let area = difference(&[ground], &holes).remove(0);
        assert_eq!(area.holes.len(), 5);
        let parts = parts(area);
        assert!((parts.iter().map(|ring| size(ring)).sum::<f64>() - 95.0).abs() < 1e-5);
    }
}
