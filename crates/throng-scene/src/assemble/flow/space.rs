//! Fields that lead through space.

use crate::assemble::limits::{Limit, check, check_some};
use crate::file::Problem;
use crate::registry::{BuildField, FieldContext};
use crate::scene::flow::ThroughSpace;
use std::sync::Arc;
use throng::field::Field;
use throng_field::{Smoothing, SwarmGuide, Tube, VoxelSettings, Voxels};

/// Default distance that counts as arrival, metres.
const TOLERANCE: f64 = 0.1;
/// Default speed, m/s.
const SPEED: f64 = 1.0;

impl BuildField for ThroughSpace {
    fn make(&self, at: &FieldContext) -> Result<Arc<dyn Field>, Problem> {
        let positive = [("speed", self.speed), ("tube", self.tube), ("cell", self.cell)];
        positive.into_iter().try_for_each(|(key, number)| check_some(&at.path.key(key), number, Limit::Positive))?;
        let others = [
            ("tolerance", self.tolerance),
            ("distance", self.distance),
            ("radius", self.radius),
            ("clearance", self.clearance),
        ];
        others.into_iter().try_for_each(|(key, number)| check_some(&at.path.key(key), number, Limit::NotNegative))?;
        let speed = self.speed.unwrap_or(SPEED);
        check(&at.path.key("speed"), speed, Limit::UpTo(1000.0))?;
        let or = |said: Option<f64>, standard: f32| said.map_or(standard, |said| said as f32);
        let standard = VoxelSettings::default();
        let scan = VoxelSettings {
            low: at.position("min", self.min)?,
            high: at.position("max", self.max)?,
            cell: or(self.cell, standard.cell),
            radius: or(self.radius, standard.radius),
            clearance: or(self.clearance, standard.clearance),
            ..standard
        };
        let walls = match &self.walls {
            Some(walls) => at.walls(walls)?,
            None => vec![],
        };
        let refused = |error| at.refused(&error);
        let space = Arc::new(Voxels::of(&walls, scan).map_err(refused)?);
        let tolerance = self.tolerance.unwrap_or(TOLERANCE) as f32;
        let guide = SwarmGuide::new(space, at.position("to", self.to)?, tolerance, speed as f32).map_err(refused)?;
        let Some(from) = self.from else { return Ok(Arc::new(guide)) };
        let standard = Smoothing::default();
        let smoothing = Smoothing { distance: or(self.distance, standard.distance), ..standard };
        let spine = guide.spine(at.position("from", from)?, smoothing).map_err(refused)?;
        let standard = Tube::default();
        let tube = Tube { radius: or(self.tube, standard.radius), ..standard };
        Ok(Arc::new(guide.along(spine, tube).map_err(refused)?))
    }
}
