//! Cameras: their position, their control, and their smooth motion.

mod pose;

use super::mode::Mode;
use glam::{DVec2, DVec3, Vec2};
use throng_draw::{Camera, Followed, Following, Lens, Motion, Projector, Sight, Viewpoint, WorldBox};

/// The vertical field of view in perspective, radians.
const FIELD_OF_VIEW: f64 = 0.66;
/// The first orbit: azimuth from +x and elevation above the ground, radians.
const AZIMUTH: f64 = -2.0;
const ELEVATION: f64 = 0.6;
/// The least and the greatest distance of the camera, metres.
const DISTANCES: (f64, f64) = (0.5, 20_000.0);
/// The least and the greatest scale, points of the screen per metre.
const SCALES: (f64, f64) = (0.005, 5_000.0);
/// Rotation of an orbit per point of the screen, radians.
const TURN: f64 = 0.006;

/// The rate at which a camera approaches its place, 1/s: most of a motion takes half a second.
const HASTE: f64 = 7.0;

/// A camera with its target pose and its current pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    mode: Mode,
    center: DVec2,
    scale: f64,
    target: DVec3,
    azimuth: f64,
    elevation: f64,
    distance: f64,
    /// Distance to the followed agent, in radii of the agent.
    aside: f64,
    /// The vertical field of view in perspective, radians.
    angle: f64,
    followed: Option<Followed>,
    shown: Sight,
    /// Half the extent of the scene, metres.
    reach: f64,
}

impl Default for Eye {
    fn default() -> Self {
        let mut eye = Self {
            mode: Mode::Plan,
            center: DVec2::ZERO,
            scale: 30.0,
            target: DVec3::ZERO,
            azimuth: AZIMUTH,
            elevation: ELEVATION,
            distance: 30.0,
            aside: 30.0,
            angle: FIELD_OF_VIEW,
            followed: None,
            shown: Sight { eye: DVec3::Z, target: DVec3::ZERO },
            reach: 10.0,
        };
        eye.shown = eye.wanted();
        eye
    }
}

impl Eye {
    /// Returns the mode.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Sets the mode. The camera moves smoothly to the new pose.
    pub fn set_mode(&mut self, mode: Mode) {
        if self.mode == Mode::Plan && mode == Mode::Orbit {
            self.target = self.center.extend(self.target.z);
        }
        self.mode = mode;
    }

    /// Fits a box of this height, metres, into a picture of this size, points of the screen.
    pub fn fit(&mut self, bounds: WorldBox, height: f64, size: Vec2) {
        let margin = Vec2::splat(28.0).min(size * 0.1);
        let camera = Camera::fit(bounds, margin, size - margin);
        (self.center, self.scale) = (camera.center, camera.scale.clamp(SCALES.0, SCALES.1));
        let extent = (bounds.max - bounds.min).extend(height);
        self.reach = 0.5 * extent.length().max(1.0);
        self.target = camera.center.extend(0.5 * height);
        (self.azimuth, self.elevation) = (AZIMUTH, ELEVATION);
        let narrow = f64::from((size.x / size.y.max(1.0)).min(1.0));
        self.angle = FIELD_OF_VIEW;
        self.distance = self.reach / (0.5 * self.angle).tan() / narrow.max(0.1) * 0.92;
        self.shown = self.wanted();
    }

    /// Looks from a place at a target, with this vertical field of view, degrees.
    pub fn look(&mut self, sight: Sight, field_of_view: f64) {
        let from = sight.eye - sight.target;
        self.target = sight.target;
        self.distance = from.length().clamp(DISTANCES.0, DISTANCES.1);
        self.azimuth = from.y.atan2(from.x);
        self.elevation = (from.z / from.length().max(1e-9)).clamp(-1.0, 1.0).asin();
        self.angle = field_of_view.to_radians();
        self.shown = self.wanted();
    }

    /// Orbits from now on: from the present place if the view is in space.
    pub fn stay(&mut self) {
        let (mode, sight) = (self.mode, self.shown);
        self.set_mode(Mode::Orbit);
        if mode != Mode::Plan {
            self.look(sight, self.angle.to_degrees());
        }
    }

    /// Moves the view, or rotates it if `turning`.
    pub fn drag(&mut self, by: Vec2, turning: bool, size: Vec2) {
        let by = by.as_dvec2();
        match self.mode {
            Mode::Plan => self.center -= DVec2::new(by.x, -by.y) / self.scale,
            Mode::Orbit if !turning => {
                let metres = self.distance / self.focal(size);
                let ahead = -DVec2::from_angle(self.azimuth);
                let shift = -ahead.perp() * -by.x + ahead * by.y / self.elevation.sin().max(0.2);
                self.target += (shift * metres).extend(0.0);
            }
            _ => {
                self.azimuth -= by.x * TURN;
                self.elevation = (self.elevation + by.y * TURN).clamp(0.03, 1.55);
            }
        }
        self.arrive();
    }

    /// Rotates the ground clockwise on the picture, radians. A plan does not rotate.
    pub fn turn(&mut self, by: f64) {
        if self.mode != Mode::Plan {
            self.azimuth += by;
            self.arrive();
        }
    }

    /// Zooms by a factor. In a plan, the ground at the pixel `at` stays there.
    pub fn zoom(&mut self, at: Vec2, factor: f64, size: Vec2) {
        match self.mode {
            Mode::Plan => {
                let held = self.plan(size).point(at);
                self.scale = (self.scale * factor).clamp(SCALES.0, SCALES.1);
                self.center += held - self.plan(size).point(at);
            }
            Mode::Orbit => self.distance = (self.distance / factor).clamp(DISTANCES.0, DISTANCES.1),
            _ => self.aside = (self.aside / factor).clamp(4.0, 2000.0),
        }
        self.arrive();
    }

    /// Advances the smooth motion by `seconds`.
    pub fn settle(&mut self, followed: Option<Followed>, seconds: f64) {
        self.followed = followed.or(self.followed);
        self.shown.approach(self.wanted(), seconds, HASTE);
    }

    /// Whether the camera is still moving.
    pub fn moves(&self) -> bool {
        let wanted = self.wanted();
        let off = self.shown.eye.distance(wanted.eye) + self.shown.target.distance(wanted.target);
        self.mode != Mode::Plan && off > 1e-3 * wanted.eye.distance(wanted.target)
    }

    /// Input of the user takes effect without smoothing.
    fn arrive(&mut self) {
        if !self.mode.follows() {
            self.shown = self.wanted();
        }
    }

    fn wanted(&self) -> Sight {
        let out = DVec2::from_angle(self.azimuth).extend(0.0) * self.elevation.cos() + DVec3::Z * self.elevation.sin();
        match (self.mode.chase(), &self.followed) {
            (Some(chase), Some(followed)) => chase.sight(followed, self.aside, self.shown.eye),
            _ => Sight { eye: self.target + out * self.distance, target: self.target },
        }
    }

    fn focal(&self, size: Vec2) -> f64 {
        0.5 * f64::from(size.y) / (0.5 * self.angle).tan()
    }

    fn plan(&self, size: Vec2) -> Camera {
        Camera { center: self.center, anchor: size * 0.5, scale: self.scale }
    }

    /// Returns the viewpoint of a recording in perspective that starts with the current view. It follows the agent
    /// `number` if the camera follows an agent.
    pub fn viewpoint(&self, number: Option<u32>) -> Viewpoint {
        let follow = self.mode.chase().zip(number);
        Viewpoint {
            eye: Some(self.shown.eye),
            target: Some(self.shown.target),
            field_of_view: self.angle.to_degrees(),
            motion: follow.map_or(Motion::Still, |(chase, number)| {
                Motion::Follow(Following { number, chase, aside: self.aside })
            }),
        }
    }

    /// Returns the part of the ground that is visible in a plan of this size, points of the screen.
    pub fn seen(&self, size: Vec2) -> WorldBox {
        let half = size.as_dvec2() * 0.5 / self.scale;
        WorldBox { min: self.center - half, max: self.center + half }
    }

    /// Returns the projection from the world to a picture of this size, points of the screen.
    pub fn projector(&self, size: Vec2) -> Projector {
        match self.mode {
            Mode::Plan => Projector::Plan(self.plan(size)),
            _ => {
                let Sight { eye, target } = self.shown;
                Projector::Perspective(Lens::new(eye, target, self.focal(size), size * 0.5, self.reach))
            }
        }
    }
}

/// Returns the point on the ground at a pixel, `None` above the horizon.
pub fn ground(projector: &Projector, pixel: Vec2) -> Option<DVec2> {
    match projector {
        Projector::Plan(camera) => Some(camera.point(pixel)),
        Projector::Perspective(lens) => {
            let sight = lens.sight(pixel);
            let way = -lens.eye.z / sight.z;
            (way > 0.0 && way.is_finite()).then(|| (lens.eye + sight * way).truncate())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Vec2 = Vec2::new(800.0, 600.0);

    fn eye(mode: Mode) -> Eye {
        let mut eye = Eye::default();
        eye.set_mode(mode);
        eye.fit(WorldBox { min: DVec2::new(-1810.0, 3.0), max: DVec2::new(-1790.0, 13.0) }, 2.0, SIZE);
        eye
    }

    #[test]
    fn from_the_screen_to_the_ground_and_back() {
        for mode in [Mode::Plan, Mode::Orbit] {
            let projector = eye(mode).projector(SIZE);
            for pixel in [Vec2::new(400.0, 300.0), Vec2::new(120.0, 500.0), Vec2::new(700.0, 250.0)] {
                let point = ground(&projector, pixel).unwrap();
                assert!(projector.pixel(point.extend(0.0)).unwrap().distance(pixel) < 1e-2, "{mode:?} {pixel}");
            }
        }
    }

    #[test]
    fn what_is_at_the_pointer_stays_there() {
        let mut eye = eye(Mode::Plan);
        let pointer = Vec2::new(150.0, 480.0);
        let held = ground(&eye.projector(SIZE), pointer).unwrap();
        eye.zoom(pointer, 3.0, SIZE);
        assert!(ground(&eye.projector(SIZE), pointer).unwrap().distance(held) < 1e-6);
        eye.drag(Vec2::new(30.0, -20.0), false, SIZE);
        assert!(ground(&eye.projector(SIZE), pointer + Vec2::new(30.0, -20.0)).unwrap().distance(held) < 1e-6);
    }

    #[test]
    fn the_ground_turns_with_the_fingers() {
        let mut eye = eye(Mode::Orbit);
        // looks almost straight down
        eye.drag(Vec2::new(0.0, 1000.0), true, SIZE);
        let middle = SIZE * 0.5;
        let pixel = middle + Vec2::new(100.0, 0.0);
        let held = ground(&eye.projector(SIZE), pixel).unwrap();
        eye.turn(0.5);
        let turned = eye.projector(SIZE).pixel(held.extend(0.0)).unwrap() - middle;
        // y points down
        assert!((turned - Vec2::from_angle(0.5) * 100.0).length() < 8.0, "{turned}");
    }

    #[test]
    fn everything_is_seen_from_everywhere() {
        for mode in [Mode::Plan, Mode::Orbit] {
            let projector = eye(mode).projector(SIZE);
            for corner in [(-1810.0, 3.0, 0.0), (-1790.0, 13.0, 2.0), (-1810.0, 13.0, 2.0)] {
                let pixel = projector.pixel(corner.into()).unwrap();
                assert!(pixel.cmpge(Vec2::ZERO).all() && pixel.cmple(SIZE).all(), "{mode:?}: {pixel}");
            }
        }
    }

    #[test]
    fn a_camera_reaches_the_agent_it_follows() {
        let followed = Followed { center: DVec3::new(5.0, 5.0, 0.0), forward: DVec3::X, radius: 0.3 };
        for mode in Mode::ALL.into_iter().filter(|mode| mode.follows()) {
            let mut eye = eye(mode);
            (0..300).for_each(|_| eye.settle(Some(followed), 0.02));
            assert!(!eye.moves(), "{mode:?}");
            // the point of view shows what is ahead of the agent, not the agent
            let ahead = if mode == Mode::PointOfView { followed.forward * 20.0 * followed.radius } else { DVec3::ZERO };
            let seen = eye.projector(SIZE).pixel(followed.center + ahead).unwrap();
            assert!(seen.distance(SIZE * 0.5) < 220.0, "{mode:?}: {seen}");
        }
        assert_eq!(Mode::ALL.iter().fold(Mode::Plan, |mode, _| mode.next()), Mode::Plan);
    }
}
