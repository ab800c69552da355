//! Precision of gestures: what the pointer snaps to, and typed sizes.

use super::Tool;
use super::parts::Parts;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// The angle between directions that a gesture keeps with Shift, degrees.
const TURN: f64 = 45.0;
/// The characters of typed sizes.
const SIGNS: &str = "0123456789.-x< ";

/// Whether and how gestures snap.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Snapping {
    /// Whether gestures snap to corners, edges and the grid.
    pub on: bool,
    /// The spacing of the grid, metres.
    pub pitch: f64,
}

impl Snapping {
    /// The spacings to choose from, metres.
    pub const PITCHES: [f64; 5] = [0.05, 0.1, 0.25, 0.5, 1.0];
}

impl Default for Snapping {
    fn default() -> Self {
        Self { on: false, pitch: 0.25 }
    }
}

/// What a position has snapped to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Snap {
    /// A corner, a centre or another point.
    Point,
    /// An edge of an outline.
    Edge,
    /// A point of the grid.
    Grid,
    /// A direction: a multiple of 45°.
    Direction,
}

/// Returns the position that a gesture from `from` takes for the pointer at `at`: in a direction of multiples of 45° if
/// `straight`, else at the nearest point or edge of `parts` within `reach` metres, else on the grid. Positions in
/// `except` do not count.
pub fn snapped(
    snapping: Snapping,
    parts: &Parts,
    (from, at): (Option<DVec2>, DVec2),
    straight: bool,
    (reach, except): (f64, Option<DVec2>),
) -> (DVec2, Option<Snap>) {
    if let Some(from) = from.filter(|_| straight) {
        let turns = ((at - from).to_angle().to_degrees() / TURN).round();
        let way = DVec2::from_angle((turns * TURN).to_radians());
        let length = (at - from).dot(way);
        let length = if snapping.on { to_grid(length, snapping.pitch) } else { length };
        return (from + way * length, Some(Snap::Direction));
    }
    if !snapping.on {
        return (at, None);
    }
    let nearest = |points: &mut dyn Iterator<Item = DVec2>| {
        let near = points.filter(|point| point.distance(at) <= reach && except != Some(*point));
        near.min_by(|a, b| a.distance_squared(at).total_cmp(&b.distance_squared(at)))
    };
    if let Some(point) = nearest(&mut parts.handles.iter().map(|handle| handle.at)) {
        return (point, Some(Snap::Point));
    }
    let edges = parts.outlines.iter().filter(|outline| except.is_none_or(|at| !outline.points.contains(&at)));
    let closest = edges.flat_map(|outline| {
        let sides = outline.points.len() - usize::from(!outline.closed && !outline.points.is_empty());
        (0..sides).map(|k| on_side(at, outline.points[k], outline.points[(k + 1) % outline.points.len()]))
    });
    if let Some(point) = nearest(&mut closest.into_iter()) {
        return (point, Some(Snap::Edge));
    }
    let grid = DVec2::new(to_grid(at.x, snapping.pitch), to_grid(at.y, snapping.pitch));
    (grid, Some(Snap::Grid))
}

/// Returns the position of the pointer that gives the typed size to a gesture from `from` towards `at`; `None` if the text
/// is no size. A length is `3`, with a direction in degrees `3 < 45`; sides are `3 x 2`.
pub fn sized(tool: Tool, from: DVec2, at: DVec2, typed: &str) -> Option<DVec2> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let length = |text: &str| number(text).filter(|&length| length > 0.0);
    if let Some((wide, high)) = typed.split_once('x') {
        let toward = |by: f64| if by < 0.0 { -1.0 } else { 1.0 };
        let by = at - from;
        return Some(from + DVec2::new(toward(by.x) * length(wide)?, toward(by.y) * length(high)?));
    }
    if let Some((far, angle)) = typed.split_once('<') {
        return Some(from + DVec2::from_angle(number(angle)?.to_radians()) * length(far)?);
    }
    if tool.spans() {
        return sized(tool, from, at, &format!("{typed}x{typed}"));
    }
    Some(from + (at - from).try_normalize().unwrap_or(DVec2::X) * length(typed)?)
}

/// Returns the characters of a text that sizes have.
pub fn signs(text: &str) -> impl Iterator<Item = char> {
    text.chars().filter(|sign| SIGNS.contains(*sign))
}

fn to_grid(at: f64, pitch: f64) -> f64 {
    (at / pitch).round() * pitch
}

/// Returns the nearest point of a side.
fn on_side(at: DVec2, from: DVec2, to: DVec2) -> DVec2 {
    let way = to - from;
    let share = if way == DVec2::ZERO { 0.0 } else { ((at - from).dot(way) / way.length_squared()).clamp(0.0, 1.0) };
    from + way * share
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng_scene::gallery;

    const AT: DVec2 = DVec2::new(3.13, -0.62);

    fn snap(snapping: Snapping, from: Option<DVec2>, at: DVec2, straight: bool) -> (DVec2, Option<Snap>) {
        snapped(snapping, &Parts::of(&gallery::scene("box").unwrap()), (from, at), straight, (0.2, None))
    }

    #[test]
    fn gestures_snap_to_points_edges_and_the_grid() {
        let on = Snapping { on: true, pitch: 0.5 };
        assert_eq!(snap(Snapping::default(), None, AT, false), (AT, None));
        let scene = gallery::scene("box").unwrap();
        let parts = Parts::of(&scene);
        let outline = parts.outlines.iter().find(|outline| outline.closed && outline.points.len() == 4).unwrap();
        let [a, b] = [outline.points[0], outline.points[1]];
        assert_eq!(snap(on, None, a + DVec2::new(0.1, -0.05), false), (a, Some(Snap::Point)));
        let side = a + (b - a) * 0.4;
        let (found, to) = snap(on, None, side + (b - a).perp().normalize() * 0.1, false);
        assert!(found.distance(side) < 1e-9 && to == Some(Snap::Edge), "{found} {to:?}");
        let far = DVec2::new(100.13, -40.62);
        assert_eq!(snap(on, None, far, false), (DVec2::new(100.0, -40.5), Some(Snap::Grid)));
    }

    #[test]
    fn with_shift_directions_are_multiples_of_45_degrees() {
        let from = DVec2::new(1.0, 1.0);
        let (at, to) = snap(Snapping::default(), Some(from), DVec2::new(4.0, 1.3), true);
        assert!(at.distance(DVec2::new(4.0, 1.0)) < 1e-9 && to == Some(Snap::Direction));
        let (at, _) = snap(Snapping { on: true, pitch: 0.5 }, Some(from), DVec2::new(3.1, 2.8), true);
        assert!((at - from).length() % 0.5 < 1e-9 && ((at - from).x - (at - from).y).abs() < 1e-9, "{at}");
    }

    #[test]
    fn sizes_are_typed() {
        let (from, at) = (DVec2::new(1.0, 2.0), DVec2::new(0.0, 2.0));
        let of = |tool, typed: &str| sized(tool, from, at, typed);
        assert_eq!(of(Tool::Wall, "3"), Some(DVec2::new(-2.0, 2.0)));
        assert_eq!(of(Tool::Rectangle, "3 x 2.5"), Some(DVec2::new(-2.0, 4.5)));
        assert_eq!(of(Tool::Rectangle, "2"), Some(DVec2::new(-1.0, 4.0)));
        let up = of(Tool::Wall, "2 < 90").unwrap();
        assert!(up.distance(DVec2::new(1.0, 4.0)) < 1e-9);
        for wrong in ["", "x", "-3", "3 x", "1e999", "0", "3.4.5", "< 4"] {
            assert_eq!(of(Tool::Disc, wrong), None, "{wrong}");
        }
        assert_eq!(signs("3a x;2").collect::<String>(), "3 x2");
    }
}
