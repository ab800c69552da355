//! The common interface of a simulated world and of a replay.

use super::intervened::Act;
use super::observed::Observed;
use super::reel::Reel;
use super::run_moment::{Cost, Trouble};
use std::sync::Arc;
use throng::{Explanation, Summary};
use throng_record::{Frame, Setting};
use throng_scene::{Intervention, Scene};

/// A run at one of its moments.
pub(super) trait Playable {
    /// Returns the number of steps since the start.
    fn steps(&self) -> u64;
    /// Returns the time since the start, seconds.
    fn time(&self) -> f64;
    /// Whether this is the last moment.
    fn over(&self) -> bool;
    /// Advances to the next moment and updates `cost`.
    fn step(&mut self, cost: &mut Cost) -> Result<(), Trouble>;
    /// Goes back to a step, or to the last reachable moment before it.
    fn back_to(&mut self, step: u64);
    /// Writes the current moment into `frame`.
    fn capture(&self, frame: &mut Frame);
    /// Returns all agents for measurement.
    fn observe(&self) -> Observed;
    /// Returns the summary: a new one if `fresh`, else one that is updated at intervals.
    fn summary(&mut self, fresh: bool) -> Arc<Summary>;
    /// Sets the agent to explain.
    fn explain(&mut self, _: Option<u32>) {}
    /// Returns the explanation: a new one if `fresh`, else one that is updated at intervals, which grow with the `step`
    /// time.
    fn explanation(&mut self, _fresh: bool, _step: f64) -> Option<Arc<Explanation>> {
        None
    }
    /// Continues with a new scene, if only its groups differ from `old`. Returns the new setting, `None` if the scene
    /// differs in more.
    fn tune(&mut self, _new: &Arc<Scene>, _old: &Scene, _title: &str) -> Result<Option<Setting>, Trouble> {
        Ok(None)
    }
    /// Does what the user asks for at the current moment. A replay cannot be changed.
    fn intervene(&mut self, _: &Act) -> Result<(), Trouble> {
        Err(Trouble::Refused("a replay of recorded trajectories cannot be changed".into()))
    }
    /// Returns what the user has done so far.
    fn interventions(&self) -> Arc<[Intervention]> {
        Arc::default()
    }
    /// Returns the setting if an intervention has changed it.
    fn changed_setting(&self, _shown: &Setting) -> Option<Setting> {
        None
    }
    /// Returns a hash of the state.
    fn hash(&self) -> u64 {
        0
    }
    /// Returns the bytes of saved states.
    fn kept(&self) -> usize {
        0
    }
    /// Returns the replayed trajectories.
    fn reel(&self) -> Option<Arc<Reel>> {
        None
    }
}
