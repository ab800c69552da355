//! What has moments that can be played: a world, or a film of one.

use super::observed::Observed;
use super::reel::Reel;
use super::shown::{Cost, Trouble};
use std::sync::Arc;
use throng::{Explanation, Summary};
use throng_record::{Frame, Setting};
use throng_scene::Scene;

/// What is played, at one of its moments.
pub(super) trait Stage {
    /// Steps made since the start.
    fn steps(&self) -> u64;
    /// Seconds since the start.
    fn time(&self) -> f64;
    /// Whether there is nothing after this moment.
    fn over(&self) -> bool;
    /// Goes on to the next moment; what that costs is mixed into `cost`.
    fn step(&mut self, cost: &mut Cost) -> Result<(), Trouble>;
    /// Goes back to a moment, or to one before it that is within reach.
    fn back_to(&mut self, step: u64);
    /// Makes `frame` show this moment.
    fn capture(&self, frame: &mut Frame);
    /// Everybody, to be measured.
    fn observe(&self) -> Observed;
    /// How it went so far: counted anew where `fresh`, else now and then.
    fn summary(&mut self, fresh: bool) -> Arc<Summary>;
    /// Lets an agent tell why it goes where it goes from now on.
    fn explain(&mut self, _: Option<u32>) {}
    /// Why that goes where it goes: asked anew where `fresh`, else now and then, less often where steps are as slow as this.
    fn explanation(&mut self, _fresh: bool, _step: f64) -> Option<Arc<Explanation>> {
        None
    }
    /// Goes on as a scene says that was `old`, if only its groups are others: what stays the same then.
    fn tune(&mut self, _new: &Arc<Scene>, _old: &Scene, _title: &str) -> Result<Option<Setting>, Trouble> {
        Ok(None)
    }
    /// A hash of the state.
    fn hash(&self) -> u64 {
        0
    }
    /// Bytes of states that are kept to go back to.
    fn kept(&self) -> usize {
        0
    }
    /// The film that is replayed.
    fn reel(&self) -> Option<Arc<Reel>> {
        None
    }
}
