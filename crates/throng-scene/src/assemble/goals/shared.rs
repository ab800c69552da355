//! Goals that all agents of a group share.

use crate::assemble::check::{check_points, check_rectangle};
use crate::assemble::ground::check_polygon;
use crate::assemble::limits::{Limit, MAX_COORDINATE, check, check_point, check_spot};
use crate::file::{Path, Problem};
use crate::geometry::{DVec2, DVec3, outline_of_region};
use crate::registry::{BuildGoal, GoalContext, GoalTree};
use crate::scene::{AirGoal, AreaGoal, ExitGoal, PointGoal, Region};

impl BuildGoal for PointGoal {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        check_point(&at.path, &self.at)?;
        check_tolerance(at, self.tolerance)?;
        let goal = throng::Goal::Point { at: DVec2::from_array(self.at), tolerance: self.tolerance as f32 };
        Ok(at.same(goal, "the goal"))
    }
}

impl BuildGoal for AirGoal {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        check_spot(&at.path.key("at"), &self.at)?;
        check_tolerance(at, self.tolerance)?;
        let goal = throng::Goal::Air { at: DVec3::from_array(self.at), tolerance: self.tolerance as f32 };
        Ok(at.same(goal, "the goal"))
    }
}

impl BuildGoal for AreaGoal {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        check_region(&at.path, &self.0)?;
        Ok(at.same(throng::Goal::Area { corners: outline_of_region(&self.0) }, "the goal's area"))
    }
}

impl BuildGoal for ExitGoal {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        check_region(&at.path, &self.0)?;
        Ok(at.same(throng::Goal::Exit { corners: outline_of_region(&self.0) }, "the exit"))
    }
}

/// Checks the distance that counts as arrival.
pub(super) fn check_tolerance(at: &GoalContext, tolerance: f64) -> Result<(), Problem> {
    check(&at.path.key("tolerance"), tolerance, Limit::Positive)
}

/// Checks the numbers of a region at a path.
pub(in crate::assemble) fn check_region(path: &Path, region: &Region) -> Result<(), Problem> {
    match region {
        Region::Disc(disc) => {
            check_point(&path.key("disc.center"), &disc.center)?;
            check(&path.key("disc.radius"), disc.radius, Limit::UpTo(MAX_COORDINATE))
        }
        Region::Rectangle(r) => check_rectangle(&path.key("rectangle"), r),
        Region::Polygon(corners) => {
            check_points(&path.key("polygon"), corners)?;
            check_polygon(&path.key("polygon"), corners, "the goal's area")
        }
    }
}
