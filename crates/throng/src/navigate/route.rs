//! An agent on its way: the corners of its path that are still ahead, kept up to date at little cost.

use super::mesh::NavMesh;
use super::passage::{Bend, Passages};
use super::path::Path;
use super::visible::{Sight, Wall};
use crate::space::nearest_on_outline;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// An agent that has moved this far looks again at what it can see, metres.
const LOOK: f64 = 0.1;

/// Near a corner it looks at every step: so near that the next corner is likely to come into view, metres.
const NEAR: f64 = 0.25;

/// How many of the corners dropped last it may go back to: a rounded corner of a wall is some of them.
const BACK: usize = 8;

/// How much longer than the straight line the way by such a corner may be, in radii. Who would really have to turn back
/// plans again: else it might drift off and turn back for ever.
const BACK_DETOUR: f64 = 0.25;

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
/// corner) and one of those dropped before is in view and not out of the way, the agent goes by that; else the route is
/// lost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Saved")]
pub struct Route {
    /// Where the path begins.
    start: DVec2,
    /// All corners of the path, its end last.
    corners: Vec<DVec2>,
    /// Index of the next one.
    next: u32,
    /// Where the agent looked last.
    looked: Option<DVec2>,
    lost: bool,
    /// Where the agent goes through the next passage, as it found when it looked last.
    place: Option<DVec2>,
    /// Half of the widths of the passages at the corners, as far as they are known.
    #[serde(skip_serializing)]
    passages: Passages,
    /// Length of the way from the next corner on, metres.
    #[serde(skip_serializing)]
    beyond: f64,
    #[serde(skip_serializing)]
    guess: Guess,
}

/// What the last look found: where to look first the next time. No answer depends on it.
#[derive(Clone, Copy, Debug, Default)]
struct Guess {
    /// The triangle the agent was in.
    triangle: Option<u32>,
    /// The wall that hid the corner after the next.
    wall: Option<Wall>,
}

impl PartialEq for Guess {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// What of a route is saved.
#[derive(Deserialize)]
struct Saved {
    start: DVec2,
    corners: Vec<DVec2>,
    next: u32,
    looked: Option<DVec2>,
    lost: bool,
    place: Option<DVec2>,
}

impl From<Saved> for Route {
    fn from(Saved { start, corners, next, looked, lost, place }: Saved) -> Self {
        let (passages, guess) = Default::default();
        let mut route = Self { start, corners, next, looked, lost, place, passages, beyond: 0.0, guess };
        route.go_on_to(next);
        route
    }
}

impl Route {
    /// The route along a path.
    pub fn new(path: &Path) -> Self {
        let (start, corners) = (path.start, path.corners.clone());
        Saved { start, corners, next: 0, looked: None, lost: false, place: None }.into()
    }

    /// What to head for from `position`. Call it every step; once it says [`Heading::Lost`] it says so until it is
    /// replaced.
    pub fn advance(&mut self, mesh: &NavMesh, position: DVec2) -> Heading {
        self.advance_taut(mesh, position);
        self.heading()
    }

    /// The same, for an agent that keeps its lateral place: it goes through the passage at each corner as far from it as it is
    /// from the walls on that side, but no farther than the middle, and into an `area` where that is nearest to it. `off` tells
    /// how far it is from walls, in metres: those from which a direction leads away.
    pub(crate) fn advance_in_place(
        &mut self,
        mesh: &NavMesh,
        position: DVec2,
        area: Option<&[DVec2]>,
        off: impl Fn(DVec2) -> f64,
    ) -> Heading {
        if self.advance_taut(mesh, position) {
            if let Some(area) = area.filter(|_| self.is_last() && !self.lost) {
                self.end_near(mesh, position, area);
            }
            self.place = if self.lost { None } else { self.find_place(mesh, position, off) };
        }
        match (self.heading(), self.place) {
            (Heading::Corner(_) | Heading::End(_), Some(place)) => Heading::Corner(place),
            (heading, _) => heading,
        }
    }

    /// Lets the way end at the nearest point of an area, if that is in sight.
    fn end_near(&mut self, mesh: &NavMesh, position: DVec2, area: &[DVec2]) {
        let end = nearest_on_outline(area, position);
        let (eye, here) = mesh.stand_near(self.guess.triangle, position);
        if mesh.visible_from(here, eye, end)
            && let Some(last) = self.corners.last_mut()
        {
            *last = end;
            // the last bend is another one now
            self.passages.forget_from(self.corners.len().saturating_sub(2));
        }
    }

    /// Where an agent that keeps its lateral place goes through the next passage; none if it may head for the next corner.
    fn find_place(&mut self, mesh: &NavMesh, at: DVec2, off: impl Fn(DVec2) -> f64) -> Option<DVec2> {
        let (next, last) = (self.next as usize, self.corners.len() - 1);
        let point = |index: usize| if index == 0 { self.start } else { self.corners[index - 1] };
        let bend = |index: usize| Bend::of([point(index), point(index + 1), point(index + 2)]);
        // a taut string leaves corners before the agent has passed them
        let mut first = next;
        while first > next.saturating_sub(BACK) && bend(first - 1).is_some_and(|bend| !bend.is_passed(at)) {
            first -= 1;
        }
        for index in first..last.min(next + 1) {
            let Some(bend) = bend(index).filter(|bend| !bend.is_passed(at)) else { continue };
            let half_width = self.passages.half_width(index, || bend.half_width(mesh));
            let place = bend.place(off(bend.across(at)).clamp(0.0, half_width), half_width);
            let onwards = self.corners[next.max(index + 1).min(last)];
            let is_free = index < next && bend.is_outside(at, onwards, place);
            let far = place.distance_squared(at) > NEAR * NEAR;
            if !is_free && far && mesh.visible_from(self.guess.triangle, at, place) {
                return Some(place);
            }
        }
        None
    }

    fn heading(&self) -> Heading {
        match self.corners.get(self.next as usize) {
            None => Heading::Lost,
            _ if self.lost => Heading::Lost,
            Some(&aim) if self.is_last() => Heading::End(aim),
            Some(&aim) => Heading::Corner(aim),
        }
    }

    /// Drops the corners that it may; tells whether it looked.
    fn advance_taut(&mut self, mesh: &NavMesh, position: DVec2) -> bool {
        let Some(&aim) = self.corners.get(self.next as usize) else { return false };
        let near = !self.is_last() && position.distance_squared(aim) < NEAR * NEAR;
        let moved = self.looked.is_none_or(|last| last.distance_squared(position) >= LOOK * LOOK);
        let looks = !self.lost && (near || moved);
        if looks {
            self.looked = Some(position);
            self.look(mesh, position);
        }
        looks
    }

    /// Whether its next corner is its end.
    pub(crate) fn is_last(&self) -> bool {
        self.next as usize + 1 == self.corners.len()
    }

    fn look(&mut self, mesh: &NavMesh, position: DVec2) {
        let next = self.next as usize;
        let (eye, here) = mesh.stand_near(self.guess.triangle, position);
        self.guess.triangle = here;
        let mut furthest = next;
        while let Some(&corner) = self.corners.get(furthest + 1)
            && !self.guess.wall.is_some_and(|wall| mesh.is_in_the_way(wall, eye, corner))
        {
            if let Sight::Blocked(wall) = mesh.sight(here, eye, corner) {
                self.guess.wall = wall;
                break;
            }
            furthest += 1;
        }
        let sees = |corner: usize| mesh.visible_from(here, eye, self.corners[corner]);
        if furthest > next {
            self.go_on_to(furthest as u32);
        } else if sees(next) {
            // goes on
        } else if let Some(back) = (next.saturating_sub(BACK)..next).rev().find(|&corner| sees(corner))
            && self.detour(eye, back) < BACK_DETOUR * mesh.radius()
        {
            self.go_on_to(back as u32);
        } else {
            self.lost = true;
        }
    }

    fn go_on_to(&mut self, corner: u32) {
        self.next = corner;
        let ahead = self.corners.get(corner as usize..).unwrap_or_default();
        self.beyond = ahead.array_windows().map(|[a, b]| a.distance(*b)).sum();
    }

    /// How much longer the way to the next corner is by one of those before it.
    fn detour(&self, eye: DVec2, back: usize) -> f64 {
        let way = &self.corners[back..=self.next as usize];
        let along: f64 = way.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        way[0].distance(eye) + along - way[way.len() - 1].distance(eye)
    }

    /// The points still ahead, the next one first.
    pub fn corners(&self) -> impl ExactSizeIterator<Item = DVec2> + '_ {
        self.corners.get(self.next as usize..).unwrap_or_default().iter().copied()
    }

    /// The end of the path.
    pub fn end(&self) -> Option<DVec2> {
        self.corners.last().copied()
    }

    /// Length of the way still ahead from `position`, metres.
    pub fn remaining(&self, position: DVec2) -> f64 {
        self.corners().next().map_or(0.0, |corner| corner.distance(position) + self.beyond)
    }
}
