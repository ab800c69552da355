//! Where the eye is, and where it looks.

use super::{Followed, Following, Lens, Sight};
use crate::WorldBox;
use glam::{DVec2, DVec3, Vec2};
use throng_record::{Frame, Setting};

/// From where everything is seen if nobody says: this many radians above the ground, and so far round from +x.
const ELEVATION: f64 = 0.36;
const AZIMUTH: f64 = -2.0;
/// Those who fly as vehicles have so much more room upwards, over how high they are at first: they roam.
const HEADROOM: f64 = 0.45;
/// The target is moved so often until as much is above it in the picture as is below.
const CENTERING: usize = 8;
/// Corners of the circle that everything stays in while the eye goes round.
const ROUND: usize = 16;

/// From where a picture in perspective is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// Where the eye is, metres; `None`: slightly above everybody, far enough away to see everything.
    pub eye: Option<DVec3>,
    /// What is in the middle of the picture; `None`: the middle of everything.
    pub target: Option<DVec3>,
    /// The angle between the top and the bottom of the picture, degrees, greater than 0 and less than 180.
    pub field_of_view: f64,
    /// How fast the eye goes round its target, degrees a second, counter-clockwise from above.
    pub orbit: f64,
    /// Whom it goes with instead of going round: it begins where it would be after a while, seen from [`eye`](Self::eye).
    pub follow: Option<Following>,
}

impl Default for Viewpoint {
    fn default() -> Self {
        Self { eye: None, target: None, field_of_view: 35.0, orbit: 0.0, follow: None }
    }
}

/// What there is to see: a box on the ground and how high it is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub ground: WorldBox,
    pub height: f64,
}

impl Extent {
    /// Everything above `ground` in the first frame and where everybody goes. Who flies needs as much room as it is high.
    pub(crate) fn of(ground: WorldBox, setting: &Setting, first: &Frame) -> Self {
        let bodies = first.bodies.iter().map(|body| f64::from(body.altitude + body.shape().bound()));
        let goals = setting.goals.iter().filter_map(|goal| goal.altitude());
        let shells = setting.shells.iter().flat_map(|shell| shell.facets.iter().flatten());
        let heights = shells.map(|corner| f64::from(corner.z));
        let height = bodies.chain(goals).chain(heights).filter(|z| z.is_finite()).fold(0.0, f64::max);
        if !setting.in_space || !setting.walkable.is_empty() {
            return Self { ground, height };
        }
        let roam = first.bodies.iter().any(|body| body.basis.is_some());
        // where surfaces are drawn, they say how high it is
        let height = if roam && setting.shells.is_empty() { height * (1.0 + HEADROOM) } else { height };
        Self { ground: ground.at_least(height), height }
    }

    pub(crate) fn middle(&self) -> DVec3 {
        ((self.ground.min + self.ground.max) * 0.5).extend(0.5 * self.height)
    }

    /// How far it reaches from its middle.
    pub(crate) fn reach(&self) -> f64 {
        0.5 * (self.ground.max - self.ground.min).extend(self.height).length()
    }

    /// Points round it, from its middle: its corners, or those of a circle that it can turn in.
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

/// An eye on its orbit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Orbit {
    /// From the target to the eye at the start.
    from: DVec3,
    pub target: DVec3,
    /// Radians a second.
    rate: f64,
    focal: f64,
    anchor: Vec2,
    reach: f64,
    /// Whom it goes with; and from where it sees it, since when.
    follow: Option<Following>,
    sight: Option<(Sight, f64)>,
}

impl Orbit {
    /// The eye of a picture this high, pixels, whose things of interest lie between the pixels `low` and `high`.
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
            // a corner fits if it is no farther aside, over how far it is away, than the edge of the picture
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

    /// What is in the middle of the picture.
    pub(crate) fn middle(&self) -> DVec3 {
        self.sight.map_or(self.target, |(sight, _)| sight.target)
    }

    /// Whether the eye moves.
    pub(crate) fn moves(&self) -> bool {
        self.rate != 0.0 || self.follow.is_some()
    }

    /// Lets the eye go where it goes by the time of a frame.
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

    /// The eye at a time.
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
