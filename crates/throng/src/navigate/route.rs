//! Routes: the corners of an agent's path that are still ahead, updated at low cost.

use super::mesh::NavMesh;
use super::passage::{CornerBend, Passages};
use super::path::Path;
use super::visible::{BlockingEdge, VisibleItem};
use crate::space::nearest_on_outline;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// Distance moved after which an agent checks visibility again, metres.
const LOOK: f64 = 0.1;

/// Distance from a corner within which visibility is checked in every step, because the next corner is about to come
/// into view, metres.
const NEAR: f64 = 0.25;

/// Number of the last dropped corners that the agent can go back to: a rounded corner of a wall consists of several.
const BACK: usize = 8;

/// Maximum detour through such a corner, in radii. For a longer detour, which really turns back, the agent plans a new
/// path: otherwise it could drift off and turn back endlessly.
const BACK_DETOUR: f64 = 0.25;

/// The point that an agent heads for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Heading {
    /// The next corner of the path.
    Corner(DVec2),
    /// The end of the path: no corner is left before it.
    End(DVec2),
    /// The path is no longer valid: its next corner is not visible. Plan a new path.
    Lost,
}

/// The part of a path that an agent still has ahead.
///
/// Visibility is checked by two rays on the mesh, only when the agent has moved or is near a corner. A corner is
/// dropped as soon as the corner after it is visible. If the next corner is no longer visible (the agent was pushed
/// around a corner), the agent goes through an earlier corner that is visible and close to its way. Otherwise the route
/// is lost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "SavedRoute")]
pub struct Route {
    /// The start of the path.
    start: DVec2,
    /// All corners of the path, its end last.
    corners: Vec<DVec2>,
    /// Index of the next corner.
    next: u32,
    /// The agent's position at the last check of visibility.
    looked: Option<DVec2>,
    lost: bool,
    /// Where the agent goes through the next passage, from the last check.
    place: Option<DVec2>,
    /// Half of the widths of the passages at the corners, measured when first needed.
    #[serde(skip_serializing)]
    passages: Passages,
    /// Length of the path from the next corner on, metres.
    #[serde(skip_serializing)]
    beyond: f64,
    #[serde(skip_serializing)]
    guess: SearchHint,
}

/// Results of the last check that speed up the next one. No result depends on them.
#[derive(Clone, Copy, Debug, Default)]
struct SearchHint {
    /// The triangle that the agent was in.
    triangle: Option<u32>,
    /// The wall that hid the corner after the next.
    wall: Option<BlockingEdge>,
}

impl PartialEq for SearchHint {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// The saved part of a route.
#[derive(Deserialize)]
struct SavedRoute {
    start: DVec2,
    corners: Vec<DVec2>,
    next: u32,
    looked: Option<DVec2>,
    lost: bool,
    place: Option<DVec2>,
}

impl From<SavedRoute> for Route {
    fn from(SavedRoute { start, corners, next, looked, lost, place }: SavedRoute) -> Self {
        let (passages, guess) = Default::default();
        let mut route = Self { start, corners, next, looked, lost, place, passages, beyond: 0.0, guess };
        route.go_on_to(next);
        route
    }
}

impl Route {
    /// Creates the route along a path.
    pub fn new(path: &Path) -> Self {
        let (start, corners) = (path.start, path.corners.clone());
        SavedRoute { start, corners, next: 0, looked: None, lost: false, place: None }.into()
    }

    /// Returns the point to head for from `position`. Call it in every step. Once it has returned [`Heading::Lost`], it
    /// does so until the route is replaced.
    pub fn advance(&mut self, mesh: &NavMesh, position: DVec2) -> Heading {
        self.advance_taut(mesh, position);
        self.heading()
    }

    /// As [`advance`](Self::advance), for an agent that keeps its lateral position. It goes through the passage at each
    /// corner at the same distance from the corner as it keeps from the walls on that side, but at most in the middle
    /// of the passage, and enters an `area` at the nearest point. `off` returns the agent's distance, metres, from the
    /// walls that a direction leads away from.
    pub(crate) fn advance_in_place<'a>(
        &mut self,
        mesh: &NavMesh,
        position: DVec2,
        area: impl FnOnce() -> Option<&'a [DVec2]>,
        off: impl Fn(DVec2) -> f64,
    ) -> Heading {
        if self.advance_taut(mesh, position) {
            if self.is_last()
                && !self.lost
                && let Some(area) = area()
            {
                self.end_near(mesh, position, area);
            }
            self.place = if self.lost { None } else { self.find_place(mesh, position, off) };
        }
        match (self.heading(), self.place) {
            (Heading::Corner(_) | Heading::End(_), Some(place)) => Heading::Corner(place),
            (heading, _) => heading,
        }
    }

    /// Moves the end of the route to the nearest point of an area, if that is visible.
    fn end_near(&mut self, mesh: &NavMesh, position: DVec2, area: &[DVec2]) {
        let end = nearest_on_outline(area, position);
        let (eye, here) = mesh.stand_near(self.guess.triangle, position);
        if mesh.visible_from(here, eye, end)
            && let Some(last) = self.corners.last_mut()
        {
            *last = end;
            // this changes the last bend
            self.passages.forget_from(self.corners.len().saturating_sub(2));
        }
    }

    /// Returns where an agent that keeps its lateral position goes through the next passage; none if it can head for
    /// the next corner.
    fn find_place(&mut self, mesh: &NavMesh, at: DVec2, off: impl Fn(DVec2) -> f64) -> Option<DVec2> {
        let (next, last) = (self.next as usize, self.corners.len() - 1);
        let point = |index: usize| if index == 0 { self.start } else { self.corners[index - 1] };
        let bend = |index: usize| CornerBend::of([point(index), point(index + 1), point(index + 2)]);
        // a taut path drops corners before the agent has passed them
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

    /// Drops corners where possible. Returns whether it checked visibility.
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

    /// Whether the next corner is the end.
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
            if let VisibleItem::Blocked(wall) = mesh.sight(here, eye, corner) {
                self.guess.wall = wall;
                break;
            }
            furthest += 1;
        }
        let sees = |corner: usize| mesh.visible_from(here, eye, self.corners[corner]);
        if furthest > next {
            self.go_on_to(furthest as u32);
        } else if sees(next) {
            // the next corner is still valid
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

    /// Returns how much longer the way to the next corner is through an earlier corner.
    fn detour(&self, eye: DVec2, back: usize) -> f64 {
        let way = &self.corners[back..=self.next as usize];
        let along: f64 = way.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        way[0].distance(eye) + along - way[way.len() - 1].distance(eye)
    }

    /// Returns the points still ahead, the next one first.
    pub fn corners(&self) -> impl ExactSizeIterator<Item = DVec2> + '_ {
        self.corners.get(self.next as usize..).unwrap_or_default().iter().copied()
    }

    /// Returns the end of the path.
    pub fn end(&self) -> Option<DVec2> {
        self.corners.last().copied()
    }

    /// Returns the length of the path still ahead from `position`, metres.
    pub fn remaining(&self, position: DVec2) -> f64 {
        self.corners().next().map_or(0.0, |corner| corner.distance(position) + self.beyond)
    }
}
