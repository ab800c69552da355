//! Jumping: gdx-ai's Jump; Millington, Artificial intelligence for games, 2006, chapter 3.

use glam::Vec3;

/// The velocity with which to take off so as to land a way off: `leap` leads from the takeoff to the landing, metres, z up;
/// upwards at `rise` m/s, against gravity (> 0, m/s²). `None` if it does not rise as high as the landing is, or would have
/// to go faster along the ground than `most` m/s.
///
/// A [`Dock`](super::Dock) at the takeoff, with the direction and the speed of its level part, runs up to it; in the air
/// nobody steers.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::takeoff;
/// let velocity = takeoff(Vec3::new(3.0, 0.0, 0.0), 5.0, 10.0, 4.0).expect("it is a second in the air");
/// assert!(velocity.distance(Vec3::new(3.0, 0.0, 5.0)) < 1e-5);
/// ```
pub fn takeoff(leap: Vec3, rise: f32, gravity: f32, most: f32) -> Option<Vec3> {
    // of the two times at which it is as high as the landing, the later: it comes from above
    let square = rise * rise - 2.0 * gravity * leap.z;
    let time = (rise + square.max(0.0).sqrt()) / gravity;
    if square < 0.0 || time <= 0.0 {
        return None;
    }
    let level = leap.with_z(0.0) / time;
    (level.length() <= most).then_some(level.with_z(rise))
}
