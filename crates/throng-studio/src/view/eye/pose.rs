//! Cameras as text, for links.

use super::{DISTANCES, Eye, SCALES};
use crate::view::Mode;
use glam::{DVec2, DVec3, Vec2};
use throng_draw::Sight;

impl Eye {
    /// Returns the pose as numbers between commas. A plan has its centre and the size of the visible ground, metres, so
    /// that a view of another size shows the same.
    pub fn pose(&self, size: Vec2) -> String {
        let numbers = match self.mode {
            Mode::Plan => {
                let seen = size.as_dvec2() / self.scale;
                vec![self.center.x, self.center.y, seen.x, seen.y]
            }
            _ => {
                let Sight { eye, target } = self.shown;
                let own = [self.target.x, self.target.y, self.target.z, self.azimuth, self.elevation];
                let lens = [self.distance, self.angle, self.aside];
                let shown = [eye.x, eye.y, eye.z, target.x, target.y, target.z];
                [&own[..], &lens, &shown].concat()
            }
        };
        let short = |number: f64| ((number * 1e4).round() / 1e4).to_string();
        numbers.into_iter().map(short).collect::<Vec<_>>().join(",")
    }

    /// Takes a pose of the same mode, for a view of this size. Returns whether the text is a pose.
    pub fn set_pose(&mut self, text: &str, size: Vec2) -> bool {
        let numbers: Result<Vec<f64>, _> = text.split(',').map(str::parse).collect();
        let Ok(numbers) = numbers else { return false };
        if !numbers.iter().all(|number| number.is_finite()) {
            return false;
        }
        match (self.mode, &numbers[..]) {
            (Mode::Plan, &[x, y, width, height]) if width > 0.0 && height > 0.0 => {
                let scale = (size.as_dvec2() / DVec2::new(width, height)).min_element();
                (self.center, self.scale) = (DVec2::new(x, y), scale.clamp(SCALES.0, SCALES.1));
                self.shown = self.wanted();
            }
            (mode, &[x, y, z, azimuth, elevation, distance, angle, aside, ref shown @ ..])
                if mode != Mode::Plan && shown.len() == 6 =>
            {
                self.target = DVec3::new(x, y, z);
                (self.azimuth, self.elevation) = (azimuth, elevation);
                self.distance = distance.clamp(DISTANCES.0, DISTANCES.1);
                (self.angle, self.aside) = (angle.clamp(0.05, 2.5), aside.clamp(4.0, 2000.0));
                self.shown = Sight { eye: DVec3::from_slice(&shown[..3]), target: DVec3::from_slice(&shown[3..]) };
            }
            _ => return false,
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng_draw::WorldBox;

    #[test]
    fn a_pose_shows_the_same_in_a_view_of_another_size() {
        let bounds = WorldBox { min: DVec2::new(-10.0, 3.0), max: DVec2::new(10.0, 13.0) };
        let (size, other) = (Vec2::new(800.0, 600.0), Vec2::new(400.0, 300.0));
        for mode in [Mode::Plan, Mode::Orbit] {
            let mut eye = Eye::default();
            eye.set_mode(mode);
            eye.fit(bounds, 2.0, size);
            eye.drag(Vec2::new(40.0, -25.0), true, size);
            eye.zoom(Vec2::new(200.0, 100.0), 1.7, size);
            let mut same = Eye::default();
            same.set_mode(mode);
            assert!(same.set_pose(&eye.pose(size), other), "{mode:?}");
            let point = DVec3::new(2.0, 5.0, 0.5);
            let [a, b] =
                [(eye, size), (same, other)].map(|(eye, size)| eye.projector(size).pixel(point).unwrap() / size);
            assert!(a.distance(b) < 1e-3, "{mode:?}: {a} {b}");
            for wrong in ["", "1,2", "1,2,3,x", "1,2,0,0", "1,2,NaN,4"] {
                assert!(!same.set_pose(wrong, size), "{wrong}");
            }
        }
    }
}
