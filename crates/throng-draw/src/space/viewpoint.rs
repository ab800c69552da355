//! The viewpoint and its target.

use super::{Followed, Following, Lens, Sight};
use crate::WorldBox;
use glam::{DVec2, DVec3, Vec2};
use throng_record::{Frame, Setting};

/// The default elevation of the viewpoint above the ground, and its azimuth from +x, radians.
const ELEVATION: f64 = 0.36;
const AZIMUTH: f64 = -2.0;
/// The extra height of the view for agents that fly as vehicles, relative to their first height, because they roam.
const HEADROOM: f64 = 0.45;
/// The number of iterations that centre the scene vertically in the picture.
const CENTERING: usize = 8;
/// The number of corners of the circle that encloses the scene while the viewpoint orbits.
const ROUND: usize = 16;

/// The viewpoint of a picture in perspective.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// The position, metres; `None` for a place slightly above all agents, far enough away to see everything.
    pub eye: Option<DVec3>,
    /// The point in the middle of the picture; `None` for the middle of the scene.
    pub target: Option<DVec3>,
    /// The vertical field of view, degrees, greater than 0 and less than 180.
    pub field_of_view: f64,
    /// The angular velocity of the viewpoint around its target, degrees per second, counter-clockwise from above.
    pub orbit: f64,
    /// The agent to follow instead of orbiting. The film begins at the position to which following leads from
    /// [`eye`](Self::eye).
    pub follow: Option<Following>,
}

impl Default for Viewpoint {
    fn default() -> Self {
        Self { eye: None, target: None, field_of_view: 35.0, orbit: 0.0, follow: None }
    }
}

/// The extent of the scene: a box on the ground and its height.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub ground: WorldBox,
    pub height: f64,
}

impl Extent {
    /// Returns the extent above `ground` of everything in the first frame and of the goals. In space without walkable
    /// ground, the box is at least as wide as it is high.
    pub(crate) fn of(ground: WorldBox, setting: &Setting, first: &Frame) -> Self {
        let bodies = first.bodies.iter().map(|body| f64::from(body.altitude + body.shape().bounding_radius()));
        let goals = setting.goals.iter().filter_map(|goal| goal.altitude());
        let shells = setting.shells.iter().flat_map(|shell| shell.facets.iter().flatten());
        let heights = shells.map(|corner| f64::from(corner.z));
        let height = bodies.chain(goals).chain(heights).filter(|z| z.is_finite()).fold(0.0, f64::max);
        if !setting.in_space || !setting.walkable.is_empty() {
            return Self { ground, height };
        }
        let roam = first.bodies.iter().any(|body| body.basis.is_some());
        // Surfaces define the height if there are any.
        let height = if roam && setting.shells.is_empty() { height * (1.0 + HEADROOM) } else { height };
        Self { ground: ground.at_least(height), height }
    }

    pub(crate) fn middle(&self) -> DVec3 {
        ((self.ground.min + self.ground.max) * 0.5).extend(0.5 * self.height)
    }

    /// Returns the distance of the farthest corner from the middle.
    pub(crate) fn reach(&self) -> f64 {
        0.5 * (self.ground.max - self.ground.min).extend(self.height).length()
    }

    /// Returns the corners relative to the middle; if the view turns, corners of the enclosing circle.
    fn corners(&self, turns: bool) -> impl Iterator<Item = DVec3> {
        let half = (self.ground.max - self.ground.min) * 0.5;
        let count = if turns { ROUND } else { 4 };
        let corner = move |k: usize| match turns {
            true => DVec2::from_angle(k as f64 * std::f64::consts::TAU / ROUND as f64) * half.length(),
            false => half * DVec2::new([1.0, -1.0][k % 2], [1.0, -1.0][k / 2]),
        };
        let up = 0.5 * self.height;
        (0..count).flat_map(move |k| [corner(k).extend(-up), corner(k).extend(up)])
    }
}

/// A moving viewpoint.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Orbit {
    /// The vector from the target to the viewpoint at the start.
    from: DVec3,
    pub target: DVec3,
    /// The angular velocity, radians per second.
    rate: f64,
    focal: f64,
    anchor: Vec2,
    reach: f64,
    /// The agent to follow; the current viewpoint, and the time it was reached.
    follow: Option<Following>,
    sight: Option<(Sight, f64)>,
}

impl Orbit {
    /// Creates the viewpoint of a picture `height` pixels high. The scene lies between the pixels `low` and `high`.
    pub(crate) fn new(viewpoint: &Viewpoint, extent: &Extent, height: u32, (low, high): (Vec2, Vec2)) -> Self {
        let focal = 0.5 * f64::from(height) / (0.5 * viewpoint.field_of_view.to_radians()).tan();
        let rate = viewpoint.orbit.to_radians();
        let out = DVec2::from_angle(AZIMUTH).extend(0.0) * ELEVATION.cos() + DVec3::Z * ELEVATION.sin();
        let right = DVec3::Z.cross(out).normalize();
        let up = out.cross(right);
        let half = (high - low).as_dvec2() * 0.5;
        let mut orbit = Self {
            from: out,
            target: viewpoint.target.unwrap_or_else(|| extent.middle()),
            rate,
            focal,
            anchor: (low + high) * 0.5,
            reach: extent.reach(),
            follow: viewpoint.follow,
            sight: None,
        };
        if let Some(eye) = viewpoint.eye {
            orbit.from = eye - orbit.target;
            return orbit;
        }
        let corners: Vec<DVec3> = extent.corners(rate != 0.0).map(|corner| extent.middle() + corner).collect();
        for _ in 0..if viewpoint.target.is_none() { CENTERING } else { 1 } {
            // A corner fits if its lateral offset over its depth is within the edges of the picture.
            let offsets = || corners.iter().map(|&corner| corner - orbit.target);
            let fits = offsets().map(|offset| {
                let aside = DVec2::new(offset.dot(right), offset.dot(up)).abs();
                (aside * focal / half.max(DVec2::ONE)).max_element() + offset.dot(out)
            });
            let distance = fits.fold(1e-3, f64::max);
            let slopes = || offsets().map(|offset| offset.dot(up) / (distance - offset.dot(out)));
            let middle = 0.5 * (slopes().fold(f64::INFINITY, f64::min) + slopes().fold(f64::NEG_INFINITY, f64::max));
            orbit.from = out * distance;
            if viewpoint.target.is_none() {
                orbit.target += DVec3::Z * (middle * distance / up.z);
            }
        }
        orbit
    }

    /// Returns the point in the middle of the picture.
    pub(crate) fn middle(&self) -> DVec3 {
        self.sight.map_or(self.target, |(sight, _)| sight.target)
    }

    /// Moves the viewpoint to its place at the time of a frame.
    pub(crate) fn turn(&mut self, frame: &Frame) -> Lens {
        if let Some(follow) = self.follow
            && let Ok(at) = frame.bodies.binary_search_by_key(&follow.number, |body| body.number)
        {
            let followed = Followed::from(&frame.bodies[at]);
            let from = self.sight.map_or(self.target + self.from, |(sight, _)| sight.eye);
            let wanted = follow.chase.sight(&followed, follow.aside, from);
            let (sight, since) = self.sight.get_or_insert((wanted, frame.time));
            sight.approach(wanted, frame.time - *since);
            *since = frame.time;
        }
        self.lens(frame.time)
    }

    /// Returns the view at a time.
    fn lens(&self, time: f64) -> Lens {
        if let Some((Sight { eye, target }, _)) = self.sight {
            return Lens::new(eye, target, self.focal, self.anchor, self.reach);
        }
        let turn = DVec2::from_angle(self.rate * time);
        let eye = self.target + turn.rotate(self.from.truncate()).extend(self.from.z);
        Lens::new(eye, self.target, self.focal, self.anchor, self.reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_in_the_picture_all_the_way_round() {
        let ground = WorldBox { min: DVec2::new(10.0, -3.0), max: DVec2::new(40.0, 2.0) };
        let (low, high) = (Vec2::splat(20.0), Vec2::new(620.0, 460.0));
        for (height, orbit) in [(0.0, 0.0), (12.0, 0.0), (90.0, 0.0), (12.0, 20.0)] {
            let extent = Extent { ground, height };
            let viewpoint = Viewpoint { orbit, ..Viewpoint::default() };
            let eye = Orbit::new(&viewpoint, &extent, 480, (low, high));
            let mut tightest = f32::INFINITY;
            for time in 0..18 {
                let lens = eye.lens(f64::from(time));
                for corner in extent.corners(false) {
                    let pixel = lens.pixel(extent.middle() + corner).unwrap();
                    tightest = tightest.min((pixel - low).min(high - pixel).min_element());
                }
            }
            assert!((-1e-3..60.0).contains(&tightest), "{height} m high, {orbit}°/s: {tightest} pixels from the edge");
        }
    }
}
