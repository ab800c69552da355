//! An agent on its way: the corners of its path that are still ahead, kept up to date at little cost.

use super::mesh::NavMesh;
use super::polyanya::Path;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// An agent that has moved this far looks again at what it can see, metres.
const LOOK: f64 = 0.1;

/// Near a corner it looks at every step: so near that the next corner is likely to come into view, metres.
const NEAR: f64 = 0.25;

/// What an agent should head for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Heading {
    /// The next corner of the path.
    Corner(DVec2),
    /// The end of the path: no corner is left before it.
    End(DVec2),
    /// The path does not hold any more, its next corner is out of sight: plan a new one.
    Lost,
}

/// The part of a path that an agent still has before it.
///
/// It looks only now and then, when the agent has moved or is near a corner: two rays on the mesh. A corner is dropped
/// as soon as the one after it is in view. When the next corner has gone out of view (the agent was pushed round a
/// corner) and the one dropped before is in view, the agent goes back to that; else the route is lost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Route {
    /// Corners ahead, the next one last.
    ahead: Vec<DVec2>,
    /// The corner that was dropped last.
    passed: Option<DVec2>,
    /// Where the agent looked last.
    looked: Option<DVec2>,
    lost: bool,
}

impl Route {
    /// The route along a path.
    pub fn new(path: &Path) -> Self {
        Self { ahead: path.corners.iter().rev().copied().collect(), passed: None, looked: None, lost: false }
    }

    /// What to head for from `position`. Call it every step; once it says [`Heading::Lost`] it says so until it is
    /// replaced.
    pub fn advance(&mut self, mesh: &NavMesh, position: DVec2) -> Heading {
        let Some(&next) = self.ahead.last() else { return Heading::Lost };
        let near = self.ahead.len() > 1 && position.distance_squared(next) < NEAR * NEAR;
        let moved = self.looked.is_none_or(|last| last.distance_squared(position) >= LOOK * LOOK);
        if !self.lost && (near || moved) {
            self.looked = Some(position);
            self.look(mesh, mesh.nearest(position));
        }
        match self.ahead.last() {
            Some(&next) if !self.lost => {
                if self.ahead.len() > 1 {
                    Heading::Corner(next)
                } else {
                    Heading::End(next)
                }
            }
            _ => Heading::Lost,
        }
    }

    fn look(&mut self, mesh: &NavMesh, eye: DVec2) {
        let mut in_view = false;
        while let [.., after, next] = self.ahead[..] {
            if !mesh.visible(eye, after) {
                break;
            }
            self.passed = Some(next);
            self.ahead.pop();
            in_view = true;
        }
        if in_view || self.ahead.last().is_none_or(|&next| mesh.visible(eye, next)) {
            return;
        }
        match self.passed.take() {
            Some(corner) if mesh.visible(eye, corner) => self.ahead.push(corner),
            _ => self.lost = true,
        }
    }

    /// The points still ahead, the next one first.
    pub fn corners(&self) -> impl ExactSizeIterator<Item = DVec2> + '_ {
        self.ahead.iter().rev().copied()
    }

    /// The end of the path.
    pub fn end(&self) -> Option<DVec2> {
        self.ahead.first().copied()
    }

    /// Length of the way still ahead from `position`, metres.
    pub fn remaining(&self, position: DVec2) -> f64 {
        let mut at = position;
        self.corners().fold(0.0, |sum, corner| {
            let sum = sum + corner.distance(at);
            at = corner;
            sum
        })
    }
}
