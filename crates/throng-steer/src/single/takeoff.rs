//! Jumping: gdx-ai's Jump; Millington, Artificial intelligence for games, 2006, chapter 3.

use glam::Vec3;

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
