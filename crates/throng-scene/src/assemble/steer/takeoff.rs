//! The run-up to a leap.

use super::super::limits::{Limit, check, check_some};
use super::{BehaviourContext, BuildBehaviour, or, vehicle};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::steer::Takeoff;
use throng::steer::BoxedBehaviour;
use throng_steer::Docking;

/// Default gravitational acceleration, m/s².
const GRAVITY: f32 = 9.81;

impl BuildBehaviour for Takeoff {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        check(&at.key("rise"), self.rise, Limit::NotNegative)?;
        check_some(&at.key("gravity"), self.gravity, Limit::Positive)?;
        let (from, to) = (making.place(self.from, &at.key("from"))?, making.place(self.to, &at.key("to"))?);
        let most = vehicle(&making.scene.groups[making.group]).max_speed;
        let leap = throng_steer::takeoff(to - from, self.rise as f32, or(self.gravity, GRAVITY), most);
        let run = leap.map(|velocity| velocity.with_z(0.0)).filter(|run| run.length() > 0.0);
        let run = run.ok_or_else(|| {
            let message =
                format!("an agent that rises at {} m/s and runs at {most} m/s at most cannot leap there", self.rise);
            Problem::new(at, Kind::Conflict, message)
                .hint("set a greater rise, or a `to` nearer to `from`, not above it")
        })?;
        Ok(Docking { place: from, direction: run, speed: run.length(), time: None }.into())
    }
}
