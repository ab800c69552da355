//! How an agent's journey goes: the leg it is on, its way, and whether it gets on.

use super::Route;
use glam::{DVec2, Vec2};
use serde::{Deserialize, Serialize};

/// Whose turn it is where people block each other's ways.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Turn {
    /// Nobody has agreed on anything.
    #[default]
    Free,
    /// Its own: others step aside.
    First,
    /// Somebody else's: it goes to where it waits.
    Aside,
}

impl Turn {
    /// Who goes first is above who steps aside.
    pub(crate) fn rank(self) -> i32 {
        match self {
            Self::Free => 0,
            Self::First => 1,
            Self::Aside => -1,
        }
    }
}

/// How an agent's journey goes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Travel {
    /// Index of the stop it is on its way to.
    pub leg: u32,
    /// Metres of way that were still ahead when it last got on by a radius; infinite if it has yet to set off. Of those
    /// only who agree with others when stuck.
    pub mark: f32,
    /// Radii that it could have walked since then.
    pub stalled: f32,
    /// Whose turn it is.
    pub turn: Turn,
    /// Whether its way to the stop is planned: straight to the stop's point if it has no route.
    planned: bool,
    /// Whether the length of this leg has been noted.
    pub(crate) measured: bool,
    /// Whether it arrived at the very point, and so comes back to it when pushed.
    pub at_point: bool,
    /// Metres from the point of the stop when it arrived there.
    pub(crate) arrived_at: f32,
    /// `None`: everything in it is as at the start of a leg.
    rare: Option<Box<Rare>>,
}

/// What those who walk unhindered in the open have no use for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Rare {
    /// Its way to the stop, unless it is straight.
    route: Option<Route>,
    /// Its way to where it waits until others have passed.
    refuge: Option<Box<Route>>,
    /// What it heads for now, world coordinates.
    aim: DVec2,
    /// Metres still to rise on the way, negative to sink; 0 for those whose goal is on the ground.
    rise: f32,
    /// Metres of way still ahead along the ground, where there is something to rise.
    along: f32,
    /// How near to an area in a wall counts as there, metres.
    gap: f32,
    /// Seconds it still waits at the stop.
    wait: f32,
    /// Where it stands in the area of the stop.
    standing: Option<Standing>,
    /// Whether it waits for room in the area of the stop.
    waits_for_room: bool,
}

/// The place in a goal area that an agent has chosen to stand at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Standing {
    /// World coordinates.
    pub at: DVec2,
    /// Metres from where the area can be entered, on ways inside the area.
    pub depth: f64,
    /// Metres from the place when it last got nearer by a radius; 0: it stands there.
    pub(crate) nearest: f32,
    /// Seconds since then.
    pub(crate) idle: f32,
    /// How many places it did not get to before.
    pub(crate) tries: u8,
}

impl Default for Travel {
    fn default() -> Self {
        Self {
            leg: 0,
            mark: f32::INFINITY,
            stalled: 0.0,
            turn: Turn::Free,
            planned: false,
            measured: false,
            at_point: false,
            arrived_at: 0.0,
            rare: None,
        }
    }
}

impl Travel {
    /// Starts a leg of the journey.
    pub(crate) fn begin(&mut self, leg: u32) {
        *self = Self { leg, ..Self::default() };
    }

    /// Sets out for the stop of this leg again.
    pub(crate) fn set_out_again(&mut self) {
        *self = Self { leg: self.leg, measured: self.measured, ..Self::default() };
    }

    /// The place in the area of the stop that it has chosen to stand at.
    pub fn standing(&self) -> Option<&Standing> {
        self.rare.as_ref()?.standing.as_ref()
    }

    pub(crate) fn standing_mut(&mut self) -> Option<&mut Standing> {
        self.rare.as_mut()?.standing.as_mut()
    }

    /// Goes to stand at a place, on a route.
    pub(crate) fn stand_at(&mut self, at: DVec2, depth: f64, route: Route, tries: u8) {
        let rare = self.rare_mut();
        rare.standing = Some(Standing { at, depth, nearest: f32::INFINITY, idle: 0.0, tries });
        self.set_way(Some(route));
    }

    /// Whether it waits for room in the area of the stop.
    pub fn waits_for_room(&self) -> bool {
        self.rare.as_ref().is_some_and(|rare| rare.waits_for_room)
    }

    pub(crate) fn set_waits_for_room(&mut self, waits: bool) {
        if waits || self.rare.is_some() {
            self.rare_mut().waits_for_room = waits;
        }
    }

    /// Metres still to rise on the way, negative to sink; 0 for those whose goal is on the ground.
    pub fn rise(&self) -> f32 {
        self.rare.as_ref().map_or(0.0, |rare| rare.rise)
    }

    /// How near to an area in a wall counts as there, metres.
    pub fn gap(&self) -> f32 {
        self.rare.as_ref().map_or(0.0, |rare| rare.gap)
    }

    /// Seconds it still waits at the stop.
    pub fn wait(&self) -> f32 {
        self.rare.as_ref().map_or(0.0, |rare| rare.wait)
    }

    /// Notes how many metres it has still to rise, and to go along the ground.
    pub(crate) fn set_rise(&mut self, metres: f32, along: f32) {
        self.set(metres, |rare| &mut rare.rise);
        if metres != 0.0 {
            self.rare_mut().along = along;
        }
    }

    pub(crate) fn set_gap(&mut self, metres: f32) {
        self.set(metres, |rare| &mut rare.gap);
    }

    pub(crate) fn set_wait(&mut self, seconds: f32) {
        self.set(seconds, |rare| &mut rare.wait);
    }

    fn set(&mut self, value: f32, part: impl Fn(&mut Rare) -> &mut f32) {
        if value != 0.0 || self.rare.is_some() {
            *part(self.rare_mut()) = value;
        }
    }

    fn rare_mut(&mut self) -> &mut Rare {
        self.rare.get_or_insert_default()
    }

    /// Metres still ahead in space, where so many are ahead along the ground.
    pub(crate) fn distance(&self, along: f32) -> f32 {
        let rise = self.rise();
        if rise == 0.0 { along } else { Vec2::new(along, rise).length() }
    }

    /// The parts of the speed along the ground and upwards: both are to come to an end together.
    pub(crate) fn slope(&self) -> Vec2 {
        match &self.rare {
            Some(rare) if rare.rise != 0.0 => Vec2::new(rare.along, rare.rise).normalize_or(Vec2::Y),
            _ => Vec2::X,
        }
    }

    /// Whether its way to the stop is planned.
    pub(crate) fn has_way(&self) -> bool {
        self.planned
    }

    /// Whether its way leads straight to the point of the stop.
    pub(crate) fn is_straight(&self) -> bool {
        self.planned && self.route().is_none()
    }

    /// Whether its way leads straight to the point of the stop, on the ground, and nothing is in its way.
    #[inline]
    pub(crate) fn is_plain(&self) -> bool {
        self.planned && self.rare.is_none() && self.turn == Turn::Free
    }

    /// The route it follows, unless it goes straight: to the stop, or to where it waits until others have passed.
    pub fn route(&self) -> Option<&Route> {
        let rare = self.rare.as_ref()?;
        rare.refuge.as_deref().or(rare.route.as_ref())
    }

    pub(crate) fn route_mut(&mut self) -> Option<&mut Route> {
        let rare = self.rare.as_mut()?;
        rare.refuge.as_deref_mut().or(rare.route.as_mut())
    }

    /// Whether, while the agent stands, where it is on its way stays as it is.
    pub(crate) fn is_settled(&self) -> bool {
        self.turn == Turn::Free && self.route().is_none_or(Route::is_last)
    }

    /// Its route to the stop, even while it steps aside.
    pub(crate) fn route_to_stop(&self) -> Option<&Route> {
        self.rare.as_ref()?.route.as_ref()
    }

    /// What it heads for now, world coordinates, unless it goes straight.
    pub(crate) fn aim(&self) -> Option<DVec2> {
        Some(self.rare.as_ref().filter(|_| !self.is_straight())?.aim)
    }

    pub(crate) fn set_aim(&mut self, aim: DVec2) {
        self.rare_mut().aim = aim;
    }

    /// Takes a way to the stop; `None`: straight to its point.
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

    /// Takes a turn, or gives it up: patience begins anew.
    pub(crate) fn take(&mut self, turn: Turn) {
        if let Some(rare) = &mut self.rare {
            rare.refuge = None;
        }
        (self.mark, self.stalled) = (f32::INFINITY, 0.0);
        self.turn = turn;
    }

    /// Steps aside, to the end of a route.
    pub(crate) fn step_aside(&mut self, route: Route) {
        self.take(Turn::Aside);
        self.rare_mut().refuge = Some(Box::new(route));
    }

    /// Whatever its turn was, it is free. Who was aside needs another way.
    pub(crate) fn give_up_turn(&mut self) {
        if self.turn == Turn::Aside {
            self.lose_way();
        }
        if self.turn != Turn::Free {
            self.take(Turn::Free);
        }
    }

    /// Notes whether the agent gets on that has `remaining` metres to go: `step` is in radii that it walks when nothing
    /// hinders it.
    pub(crate) fn stall(&mut self, remaining: f32, radius: f32, step: f32) {
        if remaining > self.mark - radius {
            self.stalled += step;
        } else {
            (self.mark, self.stalled) = (remaining, 0.0);
        }
    }
}
