//! How an agent's journey goes: the leg it is on, and what it does when the crowd leaves it no progress.
//!
//! MODELS 1.9 (the stop rule) and 1.10 (deadlock): keep-right breaks the symmetry of meetings; an agent that others
//! block for a while steps aside for a moment, to the right, by a random angle held for a random time, and to
//! either side when that has not helped for a while; one that queues behind others who go the same way just waits.

use super::Route;
use crate::random::{Dice, Purpose};
use glam::{DVec2, Vec2};
use serde::{Deserialize, Serialize};

/// Seconds over which progress is averaged.
pub(crate) const AVERAGE: f32 = 0.3;
/// Part of the preferred speed below which an agent makes no progress.
pub(crate) const NO_PROGRESS: f32 = 0.15;
/// Seconds without progress after which an agent counts as blocked.
const PATIENCE: f32 = 0.7;
/// Seconds without progress after which detours go to either side: on the right there may be a wall.
const EITHER_SIDE: f32 = 4.0;
/// Range of the angle of a detour, radians: 30 to 120 degrees.
const DETOUR_ANGLE: (f32, f32) = (std::f32::consts::FRAC_PI_6, 4.0 * std::f32::consts::FRAC_PI_6);
/// Range of the time a detour is held, seconds.
const DETOUR_TIME: (f32, f32) = (0.5, 1.5);

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
    /// Part of the preferred speed that it has made towards where it wants to go, averaged.
    pub progress: f32,
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
    /// Seconds without progress.
    blocked: f32,
    /// Seconds without progress, detours included.
    without_progress: f32,
    /// Angle of the detour it makes, radians to the right; negative to the left.
    detour: f32,
    /// Seconds it still makes it.
    detour_left: f32,
}

impl Default for Travel {
    fn default() -> Self {
        Self {
            leg: 0,
            progress: 0.0,
            mark: f32::INFINITY,
            stalled: 0.0,
            turn: Turn::Free,
            planned: false,
            measured: false,
            at_point: false,
            rare: None,
        }
    }
}

impl Travel {
    /// Starts a leg of the journey.
    pub(crate) fn begin(&mut self, leg: u32) {
        *self = Self { leg, progress: 1.0, ..Self::default() };
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

    /// Seconds without progress, detours included.
    pub fn without_progress(&self) -> f32 {
        self.rare.as_ref().map_or(0.0, |rare| rare.without_progress)
    }

    /// Angle of the detour it makes, radians to the right; negative to the left.
    pub fn turned(&self) -> f32 {
        self.rare.as_ref().map_or(0.0, |rare| rare.detour)
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
            (rare.blocked, rare.without_progress, rare.detour, rare.detour_left) = (0.0, 0.0, 0.0, 0.0);
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

    /// Notes how far the agent got in the last step, and tells by what angle to the right its preferred direction
    /// is to be turned. `made` is the part of the preferred speed it had towards `direction`; `queues`
    /// tells whether somebody ahead goes the same way.
    pub(crate) fn detour(
        &mut self,
        made: f32,
        step: f32,
        dice: impl FnOnce() -> Dice,
        queues: impl FnOnce() -> bool,
    ) -> f32 {
        self.progress += (made - self.progress) * (step / AVERAGE).min(1.0);
        let gets_on = self.progress >= NO_PROGRESS;
        if gets_on && self.rare.is_none() {
            return 0.0;
        }
        let rare = self.rare_mut();
        rare.without_progress = if gets_on { 0.0 } else { rare.without_progress + step };
        if rare.detour_left > 0.0 {
            rare.detour_left -= step;
            if rare.detour_left <= 0.0 {
                rare.detour = 0.0;
                rare.blocked = 0.0;
            }
            return rare.detour;
        }
        if gets_on {
            rare.blocked = 0.0;
            return 0.0;
        }
        rare.blocked += step;
        if rare.blocked >= PATIENCE {
            if queues() {
                rare.blocked = 0.0;
            } else {
                let dice = dice();
                let left = rare.without_progress > EITHER_SIDE && dice.between((0.0, 1.0), Purpose::DetourSide) < 0.5;
                let angle = dice.between(DETOUR_ANGLE, Purpose::DetourAngle);
                rare.detour = if left { -angle } else { angle };
                rare.detour_left = dice.between(DETOUR_TIME, Purpose::DetourTime);
            }
        }
        rare.detour
    }
}

/// A turn to the right.
#[derive(Clone, Debug)]
pub(crate) struct Turned {
    sin: f32,
    cos: f32,
}

impl Turned {
    /// By an angle, radians.
    pub fn by(angle: f32) -> Self {
        let (sin, cos) = libm::sincosf(angle);
        Self { sin, cos }
    }

    /// Cosine and sine of the angle.
    #[inline]
    pub fn cos_and_sin(&self) -> Vec2 {
        Vec2::new(self.cos, self.sin)
    }

    /// A direction after it.
    pub fn turned(&self, direction: Vec2) -> Vec2 {
        let Self { sin, cos } = *self;
        Vec2::new(cos * direction.x + sin * direction.y, cos * direction.y - sin * direction.x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// When somebody whom others block begins detours, seconds after it was stopped, and their angles.
    fn detours(number: u32, seconds: f32, queues: bool) -> Vec<(f32, f32)> {
        const STEP: f32 = 0.02;
        let mut travel = Travel::default();
        let (mut begun, mut before) = (Vec::new(), 0.0);
        for step in 0..(seconds / STEP) as u64 {
            let angle = travel.detour(0.0, STEP, || Dice { seed: 3, number, step }, || queues);
            if angle != 0.0 && before == 0.0 {
                begun.push((step as f32 * STEP, angle));
            }
            before = angle;
        }
        begun
    }

    #[test]
    fn detours_go_to_the_right_first_and_later_to_either_side() {
        let all: Vec<(f32, f32)> = (0..300).flat_map(|number| detours(number, 20.0, false)).collect();
        let (early, late): (Vec<_>, Vec<_>) = all.iter().partition(|(time, _)| *time < EITHER_SIDE - 0.1);
        assert!(early.len() > 400 && early.iter().all(|(_, angle)| *angle > 0.0), "the right first");
        let lefts = late.iter().filter(|(time, angle)| *time > EITHER_SIDE + 0.1 && *angle < 0.0).count();
        let share = lefts as f64 / late.len() as f64;
        assert!(late.len() > 1000 && (share - 0.5).abs() < 0.05, "{share} of {} to the left", late.len());
        assert!(all.iter().all(|(_, angle)| (DETOUR_ANGLE.0..=DETOUR_ANGLE.1).contains(&angle.abs())));
    }

    #[test]
    fn who_queues_makes_no_detour_and_who_gets_on_neither() {
        assert_eq!(detours(1, 60.0, true), []);
        let mut travel = Travel::default();
        travel.begin(0);
        for step in 0..1000 {
            assert_eq!(travel.detour(0.5, 0.05, || Dice { seed: 1, number: 1, step }, || false), 0.0);
        }
    }
}
