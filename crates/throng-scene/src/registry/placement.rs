//! The trait of placements.

use crate::random::Random;
use glam::DVec3;
use throng::Error;

/// Where the agents of a group start: a position for each agent, in world coordinates.
///
/// A plug-in adds one by [`Plugins::placement`](super::Plugins::placement). Its positions are either fixed, or candidates
/// that are drawn until one is clear of walls, obstacles and all other agents ([`is_drawn`](Self::is_drawn)).
///
/// ```
/// use glam::DVec3;
/// use throng::parameters::parameters;
/// use throng_scene::{Placement, Plugins, Random, Scene};
///
/// /// Steps: each agent stands beside and above the agent before it.
/// #[parameters]
/// #[derive(Debug)]
/// struct Steps {
///     /// Distance along x, metres.
///     #[parameter(default = 1.0, unit = "m", above = 0, most = 100)]
///     tread: f64,
///     /// Distance upwards, metres.
///     #[parameter(default = 0.5, unit = "m", least = 0, most = 100)]
///     rise: f64,
/// }
///
/// impl Placement for Steps {
///     fn position(&self, k: usize, _: usize, _: &mut Random) -> Option<DVec3> {
///         Some(k as f64 * DVec3::new(self.tread, 0.0, self.rise))
///     }
///
///     fn sets_altitude(&self) -> bool {
///         true
///     }
/// }
///
/// let mut scene: Scene = "[[group]]\ncount = 3\nplace.steps = { tread = 2 }".parse()?;
/// Plugins::new().placement::<Steps>().equip(&mut scene);
/// let starts = scene.plan()?.agents.into_iter().map(|planned| planned.agent.position);
/// assert_eq!(starts.last(), Some(DVec3::new(4.0, 0.0, 1.0)));
/// # Ok::<(), throng_scene::Error>(())
/// ```
pub trait Placement: Send + Sync {
    /// Returns the position of agent number `k`, from 0, of `n`: x, y and the height above the ground, metres. `random` is
    /// that of the agent. If positions are drawn, it is called again for the next candidate, and goes on with the same
    /// `random`.
    ///
    /// `None`: there is no position for the agent, or, if positions are drawn, this candidate is outside the place.
    fn position(&self, k: usize, n: usize, random: &mut Random) -> Option<DVec3>;

    /// Whether positions are candidates, which are drawn again until one is clear. Fixed positions that are not clear are
    /// errors. Without it, positions are fixed.
    fn is_drawn(&self) -> bool {
        false
    }

    /// The least distance between bodies, if positions are drawn, metres. Limit: >= 0. Without it, 0.
    fn gap(&self) -> f64 {
        0.0
    }

    /// Whether the heights of the positions are those of the agents, so that a group cannot have an `altitude` too.
    /// Without it, positions are on the ground, or at the group's `altitude`.
    fn sets_altitude(&self) -> bool {
        false
    }

    /// The number of positions; `None`: there is one for any number of agents, and the group needs a `count`. If agents
    /// enter through sources, more agents than positions ask for one. Without it, `None`.
    fn capacity(&self) -> Option<u64> {
        None
    }

    /// The centre of the place, for goals that depend on it. `None`: the centre of the box around the positions.
    fn center(&self) -> Option<DVec3> {
        None
    }

    /// Checks what the limits of the parameters do not.
    ///
    /// # Errors
    /// No agents can be placed with these parameters.
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }
}
