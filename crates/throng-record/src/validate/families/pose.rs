//! Where a scene lies: nothing may depend on it.

use glam::DVec2;
use throng_scene::Random;

/// A rotation about the origin, then a shift.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    degrees: f64,
    shift: DVec2,
}

impl Pose {
    /// Any rotation, and a shift of at most 200 m.
    pub fn draw(random: &mut Random) -> Self {
        let degrees = random.between(0.0, 360.0);
        Self { degrees, shift: DVec2::new(random.between(-200.0, 200.0), random.between(-200.0, 200.0)) }
    }

    /// A point of a scene file.
    pub fn point(&self, x: f64, y: f64) -> String {
        let at = DVec2::from_angle(self.degrees.to_radians()).rotate(DVec2::new(x, y)) + self.shift;
        format!("[{:.6}, {:.6}]", at.x, at.y)
    }

    /// A list of points.
    pub fn points(&self, points: &[[f64; 2]]) -> String {
        let points: Vec<String> = points.iter().map(|&[x, y]| self.point(x, y)).collect();
        format!("[{}]", points.join(", "))
    }

    /// A rectangle from its lower left to its upper right corner.
    pub fn rectangle(&self, low: [f64; 2], high: [f64; 2]) -> String {
        format!("{{ {} }}", self.sides(low, high))
    }

    /// The same with more keys.
    pub fn rectangle_with(&self, low: [f64; 2], high: [f64; 2], more: &str) -> String {
        format!("{{ {}, {more} }}", self.sides(low, high))
    }

    fn sides(&self, [x, y]: [f64; 2], [to_x, to_y]: [f64; 2]) -> String {
        let center = self.point(0.5 * (x + to_x), 0.5 * (y + to_y));
        format!("center = {center}, size = [{:.6}, {:.6}], rotation = {:.6}", to_x - x, to_y - y, self.degrees)
    }

    /// The rotation, degrees.
    pub fn degrees(&self) -> f64 {
        self.degrees
    }
}
