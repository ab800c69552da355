//! The rules of a game: changes to a world beyond the agents' own motion.

use crate::{Error, World};
use std::fmt::Debug;

/// The rules of a game: changes to a world beyond the agents' own motion. For example, a caught agent starts again, a
/// ball bounces, or a goal is counted.
///
/// Rules have no state of their own. Everything that they must remember is in their figures: named numbers that start
/// at zero. The world keeps, clones and saves the figures. Behaviours read them
/// ([`SteeringInput::figures`](crate::steer::SteeringInput::figures)), and the `[expect]` table of a scene can test
/// them. So one value of the rules serves any number of worlds, and a new game needs a new world only. [`World::draw`]
/// returns the world's random numbers, and [`World::members`] returns the agents of a group in the order of their
/// numbers. Rules that use only these give the same bits for the same scene.
///
/// ```
/// use glam::DVec3;
/// use std::sync::Arc;
/// use throng::{Agent, AgentRef, Error, Rules, Settings, World};
///
/// /// An agent farther from the origin than this distance, metres, starts again at the origin.
/// #[derive(Debug)]
/// struct Leash(f64);
///
/// impl Rules for Leash {
///     fn figures(&self) -> Vec<String> {
///         vec!["returns".into()]
///     }
///
///     fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
///         for id in world.agent_ids() {
///             let Some(agent) = world.agent(id).map(AgentRef::to_agent).filter(|agent| agent.position.length() > self.0) else { continue };
///             world.replace(id, Agent { position: DVec3::ZERO, ..agent })?;
///             figures[0] += 1.0;
///         }
///         Ok(())
///     }
/// }
///
/// let mut world = World::new(Settings::default())?;
/// let id = world.add_agent(Agent::at([9.0, 0.0]))?;
/// world.set_rules(Arc::new(Leash(5.0)))?;
/// world.step();
/// assert_eq!((world.figure("returns"), world.position(id)), (Some(1.0), Some(DVec3::ZERO)));
/// # Ok::<(), Error>(())
/// ```
pub trait Rules: Debug + Send + Sync {
    /// Returns the names of the figures. All names differ.
    fn figures(&self) -> Vec<String>;

    /// Checks before the first step that the world has everything the rules need, and sets the figures that do not
    /// start at zero.
    ///
    /// # Errors
    /// What is missing. The world then has no rules.
    fn begin(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        let _ = (world, figures);
        Ok(())
    }

    /// Acts after every step: reads the world, changes it and updates the figures. `figures` has one number for each
    /// name.
    ///
    /// # Errors
    /// The error of a change that the world refused. [`World::refused`] returns it; the run continues.
    fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error>;

    /// Returns the state of the game in a few words, for pictures and summaries: `"2 : 1"`. Empty by default.
    fn standing(&self, world: &World, figures: &[f64]) -> String {
        let _ = (world, figures);
        String::new()
    }
}

/// The page on custom rules: its example is a test.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/rules.md")]
struct RulesPage;
