//! The mean speed of walking agents.

use throng::{Status, World};

/// The mean speed of walking agents over a run, as `[expect] mean_speed` checks it.
///
/// ```
/// use throng_scene::{WalkingSpeed, gallery};
///
/// let (mut world, _) = gallery::scene("headon")?.build()?;
/// let mut speed = WalkingSpeed::default();
/// for _ in 0..50 {
///     world.step();
///     speed.step(&world);
/// }
/// assert!(speed.mean() > 0.5 && WalkingSpeed::default().mean().is_nan());
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WalkingSpeed {
    /// The sum of all speeds, nanometres a second.
    sum: i128,
    /// The number of speeds.
    count: u64,
}

impl WalkingSpeed {
    /// Adds the speeds of the agents that walk now. Called after every step.
    pub fn step(&mut self, world: &World) {
        let agents = world.relative_columns();
        for row in (0..agents.len()).filter(|&row| agents.status[row] == Status::Walking) {
            self.sum += nanometres(agents.speed(row));
            self.count += 1;
        }
    }

    /// Returns the mean over agents and steps, m/s; NaN if no agent walked, so that no bound holds.
    pub fn mean(&self) -> f64 {
        self.sum as f64 * 1e-9 / self.count as f64
    }
}

/// Converts a length, or a speed, to whole nanometres: their sum does not depend on the order of the rows.
pub(super) fn nanometres(length: f32) -> i128 {
    (f64::from(length) * 1e9).round() as i128
}
