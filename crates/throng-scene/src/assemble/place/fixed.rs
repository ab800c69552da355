//! Placements with a fixed position for each agent.

use crate::assemble::MAX_AGENTS;
use crate::assemble::limits::{HIGHEST, Limit, MAX_COORDINATE, check, check_point, check_spot};
use crate::file::Problem;
use crate::geometry::{DVec2, DVec3};
use crate::random::Random;
use crate::registry::{BuildPlacement, Placement, PlacementContext};
use crate::scene::{Grid, Line, Point, PointPlace, PointsPlace, Ring, Sphere};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

impl BuildPlacement for PointPlace {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem> {
        check_point(&at.path, &self.0)?;
        Ok(Arc::new(self))
    }
}

impl Placement for PointPlace {
    fn position(&self, _: usize, _: usize, _: &mut Random) -> Option<DVec3> {
        Some(level(self.0))
    }

    fn capacity(&self) -> Option<u64> {
        Some(1)
    }
}

impl BuildPlacement for PointsPlace {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem> {
        self.0.iter().enumerate().try_for_each(|(i, point)| check_point(&at.path.index(i), point))?;
        Ok(Arc::new(self))
    }
}

impl Placement for PointsPlace {
    fn position(&self, k: usize, _: usize, _: &mut Random) -> Option<DVec3> {
        self.0.get(k % self.0.len().max(1)).map(|point| level(*point))
    }

    fn capacity(&self) -> Option<u64> {
        Some(self.0.len() as u64)
    }
}

impl BuildPlacement for Line {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem> {
        check_point(&at.path.key("from"), &self.from)?;
        check_point(&at.path.key("to"), &self.to)?;
        Ok(Arc::new(self))
    }
}

impl Placement for Line {
    fn position(&self, k: usize, n: usize, _: &mut Random) -> Option<DVec3> {
        let t = if n > 1 { k as f64 / (n - 1) as f64 } else { 0.5 };
        Some(DVec2::from_array(self.from).lerp(DVec2::from_array(self.to), t).extend(0.0))
    }

    fn center(&self) -> Option<DVec3> {
        Some(DVec2::from_array(self.from).lerp(DVec2::from_array(self.to), 0.5).extend(0.0))
    }
}

impl BuildPlacement for Ring {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem> {
        check_point(&at.path.key("center"), &self.center)?;
        check(&at.path.key("radius"), self.radius, Limit::UpTo(MAX_COORDINATE))?;
        check(&at.path.key("start"), self.start, Limit::Finite)?;
        Ok(Arc::new(self))
    }
}

impl Placement for Ring {
    fn position(&self, k: usize, n: usize, _: &mut Random) -> Option<DVec3> {
        let (sin, cos) = libm::sincos(self.start.to_radians() + TAU * k as f64 / n as f64);
        Some((DVec2::from_array(self.center) + self.radius * DVec2::new(cos, sin)).extend(0.0))
    }

    fn center(&self) -> Option<DVec3> {
        Some(level(self.center))
    }
}

impl BuildPlacement for Sphere {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem> {
        let radius = at.path.key("radius");
        check_spot(&at.path.key("center"), &self.center)?;
        check(&radius, self.radius, Limit::UpTo(HIGHEST))?;
        check(&radius, self.radius, Limit::UpTo(self.center[2])).map_err(|problem| {
            problem.hint("all of the sphere must be above the ground: put its center higher, or make it smaller")
        })?;
        Ok(Arc::new(self))
    }
}

impl Placement for Sphere {
    /// Returns positions at even heights, each a golden angle on from the one before.
    fn position(&self, k: usize, n: usize, _: &mut Random) -> Option<DVec3> {
        let golden = PI * (3.0 - 5.0_f64.sqrt());
        let z = 1.0 - (2 * k + 1) as f64 / n as f64;
        let (sin, cos) = libm::sincos(golden * k as f64);
        let around = (DVec2::new(cos, sin) * (1.0 - z * z).sqrt()).extend(z);
        Some(DVec3::from_array(self.center) + around * self.radius)
    }

    fn sets_altitude(&self) -> bool {
        true
    }

    fn center(&self) -> Option<DVec3> {
        Some(DVec3::from_array(self.center))
    }
}

impl BuildPlacement for Grid {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem> {
        let most = Limit::UpTo(MAX_AGENTS as f64);
        check_point(&at.path.key("center"), &self.center)?;
        check(&at.path.key("columns"), self.columns as f64, most)?;
        check(&at.path.key("rows"), self.rows as f64, most)?;
        check(&at.path.key("spacing"), self.spacing, Limit::UpTo(MAX_COORDINATE))?;
        check(&at.path.key("rotation"), self.rotation, Limit::Finite)?;
        Ok(Arc::new(self))
    }
}

impl Placement for Grid {
    fn position(&self, k: usize, _: usize, _: &mut Random) -> Option<DVec3> {
        let k = k as u64 % (self.columns * self.rows).max(1);
        let along = |k: u64, n: u64| (k as f64 - (n - 1) as f64 * 0.5) * self.spacing;
        let (x, y) = (along(k % self.columns, self.columns), along(k / self.columns, self.rows));
        let (sin, cos) = libm::sincos(self.rotation.to_radians());
        Some((DVec2::from_array(self.center) + DVec2::new(cos * x - sin * y, sin * x + cos * y)).extend(0.0))
    }

    fn capacity(&self) -> Option<u64> {
        self.columns.checked_mul(self.rows).or(Some(u64::MAX))
    }

    fn center(&self) -> Option<DVec3> {
        Some(level(self.center))
    }
}

/// Returns a point on the ground.
pub(super) fn level(point: Point) -> DVec3 {
    DVec2::from_array(point).extend(0.0)
}
