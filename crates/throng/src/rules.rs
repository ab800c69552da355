//! The rules of a game: what happens in a world beyond its agents' own steps.

use crate::{Error, World};
use std::fmt::Debug;

/// What happens in a world beyond its agents' own steps: who is caught begins anew, a ball bounces, goals are counted.
///
/// Rules keep no state: all that they must remember is in their figures, numbers with names that begin at zero. The world
/// keeps, clones and saves them, behaviours see them ([`View::figures`](crate::steer::View::figures)), and a scene's
/// `[expect]` can ask for them. So one value of the rules serves any number of worlds, and to play again is to build the
/// world again. Random numbers are the world's ([`World::draw`]); agents are found by group, in the order of their numbers
/// ([`World::members`]). Then the same scene gives the same bits.
///
/// ```
/// use glam::DVec2;
/// use std::sync::Arc;
/// use throng::{Agent, Error, Rules, Settings, World};
///
/// /// Who is more than so many metres from the origin begins there anew.
/// #[derive(Debug)]
/// struct Leash(f64);
///
/// impl Rules for Leash {
///     fn figures(&self) -> Vec<String> {
///         vec!["returns".into()]
///     }
///
///     fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
///         for id in world.everybody() {
///             let Some(agent) = world.agent(id).filter(|agent| agent.position.length() > self.0) else { continue };
///             world.replace(id, Agent { position: DVec2::ZERO, ..agent })?;
///             figures[0] += 1.0;
///         }
///         Ok(())
///     }
/// }
///
/// let mut world = World::new(Settings::default())?;
/// let id = world.add_agent(Agent { position: DVec2::X * 9.0, ..Agent::default() })?;
/// world.set_rules(Arc::new(Leash(5.0)))?;
/// world.step();
/// assert_eq!((world.figure("returns"), world.position(id)), (Some(1.0), Some(DVec2::ZERO)));
/// # Ok::<(), Error>(())
/// ```
pub trait Rules: Debug + Send + Sync {
    /// The names of the figures that they keep; no two are the same.
    fn figures(&self) -> Vec<String>;

    /// Before the first step: sees whether all is there that they need, and sets figures that do not begin at zero.
    ///
    /// # Errors
    /// What is missing; the world then has no rules.
    fn begin(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error> {
        let _ = (world, figures);
        Ok(())
    }

    /// After every step, which is before the next: reads the world, changes it, counts. `figures` has as many numbers as
    /// there are names.
    ///
    /// # Errors
    /// What the world refused. It is kept for [`World::refused`]; the run goes on.
    fn act(&self, world: &mut World, figures: &mut [f64]) -> Result<(), Error>;

    /// How it stands, a few words for pictures and summaries: `"2 : 1"`. Nothing by default.
    fn standing(&self, world: &World, figures: &[f64]) -> String {
        let _ = (world, figures);
        String::new()
    }
}

/// The page on rules of one's own: its example is a test.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/rules.md")]
struct Page;
