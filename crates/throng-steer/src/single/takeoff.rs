//! Jumping: gdx-ai's Jump; Millington, Artificial intelligence for games, 2006, chapter 3.

use super::Docking;
use crate::{ForGroup, GroupFacts};
use glam::Vec3;
use throng::Error;
use throng::parameters::{SpacePlace, parameters};
use throng::steer::BoxedBehaviour;

/// Runs up to a leap, as gdx-ai's jump does.
///
/// The agent runs up to the take-off point, in the direction and at the speed that make a leap land at another point.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Takeoff {
    /// The take-off point.
    #[parameter(required, from = SpacePlace)]
    pub from: Vec3,
    /// The landing point.
    #[parameter(required, from = SpacePlace)]
    pub to: Vec3,
    /// Vertical velocity at take-off, m/s: enough to reach the height of the landing point.
    #[parameter(required, unit = "m/s", least = 0)]
    pub rise: f32,
    /// Gravitational acceleration, m/s².
    #[parameter(default = 9.81, unit = "m/s²", above = 0)]
    pub gravity: f32,
}

impl ForGroup for Takeoff {
    fn for_group(self, group: &GroupFacts) -> Result<BoxedBehaviour, Error> {
        let (rise, most) = (self.rise, group.max_speed);
        let leap = takeoff(self.to - self.from, rise, self.gravity, most);
        let run = leap.map(|velocity| velocity.with_z(0.0)).filter(|run| run.length() > 0.0);
        let run = run.ok_or_else(|| Error::Shape {
            what: "a leap".into(),
            why: format!(
                "an agent that rises at {rise} m/s and runs at {most} m/s at most cannot leap there: set a greater rise, \
                 or a `to` nearer to `from`, not above it"
            ),
        })?;
        Ok(Docking { place: self.from, direction: run, speed: run.length(), time: None }.into())
    }
}

/// Returns the velocity at takeoff for a jump. `leap` leads from the takeoff to the landing, metres, z up; `rise` is
/// the vertical velocity, m/s; `gravity` is > 0, m/s². `None` if the jump does not rise to the height of the landing,
/// or would need a horizontal speed above `most` m/s.
///
/// A [`Docking`](super::Docking) at the takeoff, with the direction and the speed of the horizontal part, is the run-up; an
/// agent in the air does not steer.
///
/// ```
/// use glam::Vec3;
/// use throng_steer::takeoff;
/// let velocity = takeoff(Vec3::new(3.0, 0.0, 0.0), 5.0, 10.0, 4.0).expect("it is a second in the air");
/// assert!(velocity.distance(Vec3::new(3.0, 0.0, 5.0)) < 1e-5);
/// ```
pub fn takeoff(leap: Vec3, rise: f32, gravity: f32, most: f32) -> Option<Vec3> {
    // the later of the two times at the landing's height: the agent lands from above
    let square = rise * rise - 2.0 * gravity * leap.z;
    let time = (rise + square.max(0.0).sqrt()) / gravity;
    if square < 0.0 || time <= 0.0 {
        return None;
    }
    let level = leap.with_z(0.0) / time;
    (level.length() <= most).then_some(level.with_z(rise))
}
