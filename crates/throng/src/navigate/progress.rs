//! Progress of an agent on its journey: the current leg, its route, and whether it advances.

use super::Route;
use glam::{DVec2, Vec2};
use serde::{Deserialize, Serialize};

/// Right of way between agents that block each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Turn {
    /// No agreement with other agents.
    #[default]
    Free,
    /// The agent goes first: the agents in its way step aside.
    First,
    /// Another agent goes first: this agent goes to a refuge and waits there.
    Aside,
}

impl Turn {
    /// Returns the turn with a number; `None` if there is no such turn.
    pub(crate) fn numbered(number: u32) -> Option<Self> {
        [Self::Free, Self::First, Self::Aside].get(number as usize).copied()
    }

    /// Returns a rank: an agent that goes first ranks above an agent that steps aside.
    pub(crate) fn rank(self) -> i32 {
        match self {
            Self::Free => 0,
            Self::First => 1,
            Self::Aside => -1,
        }
    }
}

/// Progress of an agent on its journey.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RouteProgress {
    /// Index of the stop that the agent is on its way to.
    pub leg: u32,
    /// Metres of route that were still ahead when the agent last advanced by a radius; infinite before it sets off.
    /// Used for agents that agree with others on a right of way when stuck.
    pub mark: f32,
    /// Distance that it could have walked since then, in radii.
    pub stalled: f32,
    /// The agent's right of way.
    pub turn: Turn,
    /// Whether the way to the stop is planned; without a route it is straight to the stop's point.
    planned: bool,
    /// Whether the length of this leg has been recorded.
    pub(crate) measured: bool,
    /// Whether the agent arrived at the point itself, so that it returns to the point when pushed.
    pub at_point: bool,
    /// Whether the agent waits for room in the area of the stop.
    waits_for_room: bool,
    /// Whether there are metres still to rise or sink on the way.
    slopes: bool,
    /// Metres from the point of the stop on arrival.
    pub(crate) arrived_at: f32,
    /// `None`: all values in it are those at the start of a leg.
    rare: Option<Box<RouteDetails>>,
}

/// State that an agent which walks unhindered in the open does not need.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct RouteDetails {
    /// The route to the stop, unless the way is straight.
    route: Option<Route>,
    /// The route to the refuge where the agent waits until other agents have passed.
    refuge: Option<Box<Route>>,
    /// The point that the agent heads for now, world coordinates.
    aim: DVec2,
    /// Metres still to rise on the way, negative to sink, if the way slopes.
    rise: f32,
    /// Metres of way still ahead along the ground, if the way slopes.
    along: f32,
    /// Distance from an area in a wall that counts as arrived, metres.
    gap: f32,
    /// Seconds that the agent still waits at the stop.
    wait: f32,
    /// The standing place in the area of the stop.
    standing: Option<Standing>,
}

/// The place in a goal area that an agent has chosen to stand at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Standing {
    /// World coordinates.
    pub at: DVec2,
    /// Metres from where the area can be entered, along paths inside the area.
    pub depth: f64,
    /// Metres from the place when the agent last came nearer by a radius; 0: it stands there.
    pub(crate) nearest: f32,
    /// Seconds since then.
    pub(crate) idle: f32,
    /// The number of earlier places that the agent failed to reach.
    pub(crate) tries: u8,
}

impl Default for RouteProgress {
    fn default() -> Self {
        Self {
            leg: 0,
            mark: f32::INFINITY,
            stalled: 0.0,
            turn: Turn::Free,
            planned: false,
            measured: false,
            at_point: false,
            waits_for_room: false,
            slopes: false,
            arrived_at: 0.0,
            rare: None,
        }
    }
}

impl RouteProgress {
    /// Returns what other agents read of the progress of an agent.
    pub(crate) fn seen(leg: u32, turn: Turn, stalled: f32) -> Self {
        Self { leg, turn, stalled, ..Self::default() }
    }

    /// Starts a leg of the journey.
    pub(crate) fn begin(&mut self, leg: u32) {
        *self = Self { leg, ..Self::default() };
    }

    /// Sets out for the stop of this leg again.
    pub(crate) fn set_out_again(&mut self) {
        *self = Self { leg: self.leg, measured: self.measured, ..Self::default() };
    }

    /// Returns the place in the area of the stop that the agent has chosen to stand at.
    pub fn standing(&self) -> Option<&Standing> {
        self.rare.as_ref()?.standing.as_ref()
    }

    pub(crate) fn standing_mut(&mut self) -> Option<&mut Standing> {
        self.rare.as_mut()?.standing.as_mut()
    }

    /// Chooses a place to stand at, and the route to it.
    pub(crate) fn stand_at(&mut self, at: DVec2, depth: f64, route: Route, tries: u8) {
        let rare = self.rare_mut();
        rare.standing = Some(Standing { at, depth, nearest: f32::INFINITY, idle: 0.0, tries });
        self.set_way(Some(route));
    }

    /// Whether the agent waits for room in the area of the stop.
    pub fn waits_for_room(&self) -> bool {
        self.waits_for_room
    }

    pub(crate) fn set_waits_for_room(&mut self, waits: bool) {
        self.waits_for_room = waits;
    }

    /// Returns the metres still to rise on the way, negative to sink; 0 if the goal is on the ground.
    pub fn rise(&self) -> f32 {
        self.rare.as_ref().filter(|_| self.slopes).map_or(0.0, |rare| rare.rise)
    }

    /// Returns the distance from an area in a wall that counts as arrived, metres.
    pub fn gap(&self) -> f32 {
        self.rare.as_ref().map_or(0.0, |rare| rare.gap)
    }

    /// Returns the seconds that the agent still waits at the stop.
    pub fn wait(&self) -> f32 {
        self.rare.as_ref().map_or(0.0, |rare| rare.wait)
    }

    /// Records the metres still to rise, and to go along the ground.
    pub(crate) fn set_rise(&mut self, metres: f32, along: f32) {
        self.slopes = metres != 0.0;
        if self.slopes {
            let rare = self.rare_mut();
            (rare.rise, rare.along) = (metres, along);
        }
    }

    pub(crate) fn set_gap(&mut self, metres: f32) {
        self.set(metres, |rare| &mut rare.gap);
    }

    pub(crate) fn set_wait(&mut self, seconds: f32) {
        self.set(seconds, |rare| &mut rare.wait);
    }

    fn set(&mut self, value: f32, part: impl Fn(&mut RouteDetails) -> &mut f32) {
        if value != 0.0 || self.rare.is_some() {
            *part(self.rare_mut()) = value;
        }
    }

    fn rare_mut(&mut self) -> &mut RouteDetails {
        self.rare.get_or_insert_default()
    }

    /// Returns the metres still ahead in space, from the metres ahead along the ground.
    pub(crate) fn distance(&self, along: f32) -> f32 {
        let rise = self.rise();
        if rise == 0.0 { along } else { Vec2::new(along, rise).length() }
    }

    /// Returns the parts of the speed along the ground and upwards, so that both distances end at the same time.
    pub(crate) fn slope(&self) -> Vec2 {
        match &self.rare {
            Some(rare) if self.slopes => Vec2::new(rare.along, rare.rise).normalize_or(Vec2::Y),
            _ => Vec2::X,
        }
    }

    /// Whether the way to the stop is planned.
    pub(crate) fn has_way(&self) -> bool {
        self.planned
    }

    /// Whether the way leads straight to the point of the stop.
    pub(crate) fn is_straight(&self) -> bool {
        self.planned && self.route().is_none()
    }

    /// Whether the way leads straight to the point of the stop, on the ground, with the default details and no right of
    /// way.
    #[inline]
    pub(crate) fn is_plain(&self) -> bool {
        self.planned && self.rare.is_none() && self.turn == Turn::Free && !self.waits_for_room
    }

    /// Returns the route that the agent follows, unless its way is straight: to the refuge if it steps aside, else to
    /// the stop.
    pub fn route(&self) -> Option<&Route> {
        let rare = self.rare.as_ref()?;
        rare.refuge.as_deref().or(rare.route.as_ref())
    }

    pub(crate) fn route_mut(&mut self) -> Option<&mut Route> {
        let rare = self.rare.as_mut()?;
        rare.refuge.as_deref_mut().or(rare.route.as_mut())
    }

    /// Whether the state of the route stays the same while the agent stands still.
    pub(crate) fn is_settled(&self) -> bool {
        self.turn == Turn::Free && self.route().is_none_or(Route::is_last)
    }

    /// Returns the route to the stop, even while the agent steps aside.
    pub(crate) fn route_to_stop(&self) -> Option<&Route> {
        self.rare.as_ref()?.route.as_ref()
    }

    /// Returns the point that the agent heads for now, world coordinates, unless its way is straight.
    pub(crate) fn aim(&self) -> Option<DVec2> {
        Some(self.rare.as_ref().filter(|_| !self.is_straight())?.aim)
    }

    pub(crate) fn set_aim(&mut self, aim: DVec2) {
        self.rare_mut().aim = aim;
    }

    /// Sets the way to the stop; `None`: straight to its point.
    pub(crate) fn set_way(&mut self, route: Option<Route>) {
        self.planned = true;
        if route.is_some() || self.rare.is_some() {
            self.rare_mut().route = route;
        }
    }

    pub(crate) fn lose_way(&mut self) {
        self.planned = false;
        if let Some(rare) = &mut self.rare {
            rare.route = None;
        }
    }

    /// Sets the right of way and restarts the measurement of the agent's advance.
    pub(crate) fn take(&mut self, turn: Turn) {
        if let Some(rare) = &mut self.rare {
            rare.refuge = None;
        }
        (self.mark, self.stalled) = (f32::INFINITY, 0.0);
        self.turn = turn;
    }

    /// Makes the agent step aside, to the end of a route.
    pub(crate) fn step_aside(&mut self, route: Route) {
        self.take(Turn::Aside);
        self.rare_mut().refuge = Some(Box::new(route));
    }

    /// Resets the right of way. An agent that stepped aside needs a new way.
    pub(crate) fn give_up_turn(&mut self) {
        if self.turn == Turn::Aside {
            self.lose_way();
        }
        if self.turn != Turn::Free {
            self.take(Turn::Free);
        }
    }

    /// Records whether the agent advances, with `remaining` metres to go. `step` is the distance, in radii, that it
    /// walks when unhindered.
    pub(crate) fn stall(&mut self, remaining: f32, radius: f32, step: f32) {
        if remaining > self.mark - radius {
            self.stalled += step;
        } else {
            (self.mark, self.stalled) = (remaining, 0.0);
        }
    }
}
