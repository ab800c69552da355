//! Thinking every few steps: Reynolds, Big fast crowds on PS3, Sandbox 2006; OpenSteer's "think frequency".

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Branch, Reason, View, Why};
use glam::Vec3;

/// Asks a part only every so often, and keeps what it said in between. Agents are spread over time by chance.
///
/// ```
/// use throng::steer::{Amortised, Flocking};
/// let thrifty = Amortised { every: 0.1, of: Flocking::default().into() };
/// ```
#[derive(Clone, Debug)]
pub struct Amortised {
    /// Seconds from one time to the next. Limit: > 0.
    pub every: f32,
    /// What is asked.
    pub of: Branch,
}

/// Words that are its own.
const OWN: usize = 10;

impl Behaviour for Amortised {
    /// Seconds since it was asked, and until it is again; what it said: whether force, whether facing, and both.
    fn memory(&self) -> usize {
        OWN + self.of.words()
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let (own, mut memory) = memory.split_at_mut(OWN);
        let [since, until, says, faces, kept @ ..] = own else { return None };
        *since += view.seconds;
        // nearest to when it is due
        if *until > 0.0 && *since + 0.5 * view.seconds < *until {
            let facing = (*faces > 0.0).then(|| Vec3::from_slice(&kept[3..]));
            let kept = Vec3::from_slice(kept);
            why.note(|| Reason::Keeps(kept));
            return (*says > 0.0).then_some(Steering { force: kept, facing });
        }
        *until = if *until > 0.0 { self.every } else { self.every * view.dice.draw(0) };
        *since = 0.0;
        // what it says holds until it is asked again
        let view = View { seconds: until.max(view.seconds), ..*view };
        let said = self.of.steer_as(0, &view, &mut memory, why);
        *says = if said.is_some() { 1.0 } else { 0.0 };
        let Steering { force, facing } = said.unwrap_or_default();
        *faces = if facing.is_some() { 1.0 } else { 0.0 };
        kept[..3].copy_from_slice(&force.to_array());
        kept[3..].copy_from_slice(&facing.unwrap_or_default().to_array());
        said
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("time from one thought to the next", self.every)?;
        self.of.check()
    }
}
