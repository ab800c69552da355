//! The pose of a scene, on which no result may depend.

use glam::DVec2;
use throng_scene::Random;

/// A rotation about the origin, then a shift.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    degrees: f64,
    shift: DVec2,
}

impl Pose {
    /// Draws a rotation and a shift of at most 200 m along each axis.
    pub fn draw(random: &mut Random) -> Self {
        let degrees = random.between(0.0, 360.0);
        Self { degrees, shift: DVec2::new(random.between(-200.0, 200.0), random.between(-200.0, 200.0)) }
    }

    /// Returns a point in scene file syntax.
    pub fn point(&self, x: f64, y: f64) -> String {
        let at = DVec2::from_angle(self.degrees.to_radians()).rotate(DVec2::new(x, y)) + self.shift;
        format!("[{:.6}, {:.6}]", at.x, at.y)
    }

    /// Returns a list of points.
    pub fn points(&self, points: &[[f64; 2]]) -> String {
        let points: Vec<String> = points.iter().map(|&[x, y]| self.point(x, y)).collect();
        format!("[{}]", points.join(", "))
    }

    /// Returns a rectangle from its lower left to its upper right corner.
    pub fn rectangle(&self, low: [f64; 2], high: [f64; 2]) -> String {
        format!("{{ {} }}", self.sides(low, high))
    }

    /// Returns a rectangle with more keys.
    pub fn rectangle_with(&self, low: [f64; 2], high: [f64; 2], more: &str) -> String {
        format!("{{ {}, {more} }}", self.sides(low, high))
    }

    fn sides(&self, [x, y]: [f64; 2], [to_x, to_y]: [f64; 2]) -> String {
        let center = self.point(0.5 * (x + to_x), 0.5 * (y + to_y));
        format!("center = {center}, size = [{:.6}, {:.6}], rotation = {:.6}", to_x - x, to_y - y, self.degrees)
    }

    /// Returns the rotation, degrees.
    pub fn degrees(&self) -> f64 {
        self.degrees
    }
}
