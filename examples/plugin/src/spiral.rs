//! The placement `spiral`.

use glam::DVec3;
use std::f64::consts::PI;
use throng::parameters::parameters;
use throng_scene::{Placement, Random};

/// The golden angle between consecutive agents, radians.
const GOLDEN: f64 = 2.399_963_229_728_653;

/// In a spiral from the centre outwards, like the seeds of a sunflower.
#[parameters]
#[derive(Clone, Debug)]
pub struct Spiral {
    /// The centre.
    pub center: [f64; 2],
    /// Distance between neighbouring agents, about, metres.
    #[parameter(default = 1.0, unit = "m", above = 0, most = 100)]
    pub spacing: f64,
}

impl Placement for Spiral {
    fn position(&self, k: usize, _: usize, _: &mut Random) -> Option<DVec3> {
        let (sin, cos) = libm::sincos(GOLDEN * k as f64);
        // every agent has an area of `spacing` squared
        let far = self.spacing * libm::sqrt((k as f64 + 0.5) / PI);
        Some(self.middle() + far * DVec3::new(cos, sin, 0.0))
    }

    fn center(&self) -> Option<DVec3> {
        Some(self.middle())
    }
}

impl Spiral {
    fn middle(&self) -> DVec3 {
        let [x, y] = self.center;
        DVec3::new(x, y, 0.0)
    }
}
