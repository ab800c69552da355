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
const AVERAGE: f32 = 0.3;
/// Part of the preferred speed below which an agent makes no progress.
const NO_PROGRESS: f32 = 0.15;
/// Seconds without progress after which an agent counts as blocked.
const PATIENCE: f32 = 0.7;
/// Seconds without progress after which detours go to either side: on the right there may be a wall.
const EITHER_SIDE: f32 = 4.0;
/// Range of the angle of a detour, radians: 30 to 120 degrees.
const DETOUR_ANGLE: (f32, f32) = (std::f32::consts::FRAC_PI_6, 4.0 * std::f32::consts::FRAC_PI_6);
/// Range of the time a detour is held, seconds.
const DETOUR_TIME: (f32, f32) = (0.5, 1.5);

/// Whose turn it is where people block each other's ways.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Turn {
    /// Nobody has agreed on anything.
    #[default]
    Free,
    /// Its own: others step aside.
    First,
    /// Somebody else's: it goes to where it waits.
    Aside(Route),
}

impl Turn {
    /// Who goes first is above who steps aside.
    pub(crate) fn rank(&self) -> i32 {
        match self {
            Self::Free => 0,
            Self::First => 1,
            Self::Aside(_) => -1,
        }
    }
}

/// How an agent's journey goes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Travel {
    /// Index of the stop it is on its way to.
    pub leg: u32,
    /// Seconds it still waits at the stop.
    pub wait: f32,
    /// Part of the preferred speed that it has made towards where it wants to go, averaged.
    pub progress: f32,
    /// Seconds without progress.
    pub blocked: f32,
    /// Seconds without progress, detours included.
    pub without_progress: f32,
    /// Metres of way that were still ahead when it last got on by a radius.
    pub mark: Option<f32>,
    /// Radii that it could have walked since then.
    pub stalled: f32,
    /// Whose turn it is.
    pub turn: Turn,
    /// Angle of the detour it makes, radians to the right; negative to the left.
    pub detour: f32,
    /// Seconds it still makes it.
    pub detour_left: f32,
    /// Its way to the stop, once planned.
    pub route: Option<Route>,
    /// What it heads for now, world coordinates.
    pub aim: DVec2,
    /// Metres of way still ahead, along the ground.
    pub remaining: f32,
    /// Metres still to rise on that way, negative to sink; 0 for those whose goal is on the ground.
    pub rise: f32,
    /// How near to an area in a wall counts as there, metres.
    pub gap: f32,
    /// Whether the length of this leg has been noted.
    pub measured: bool,
    /// Whether it arrived at the very point, and so comes back to it when pushed.
    pub at_point: bool,
}

impl Travel {
    /// Starts a leg of the journey.
    pub(crate) fn begin(&mut self, leg: u32) {
        *self = Self { leg, progress: 1.0, ..Self::default() };
    }

    /// Metres still ahead in space.
    pub fn distance(&self) -> f32 {
        if self.rise == 0.0 { self.remaining } else { Vec2::new(self.remaining, self.rise).length() }
    }

    /// The parts of the speed along the ground and upwards: both are to come to an end together.
    pub(crate) fn slope(&self) -> Vec2 {
        if self.rise == 0.0 { Vec2::X } else { Vec2::new(self.remaining, self.rise).normalize_or(Vec2::Y) }
    }

    /// Takes a turn, or gives it up: patience begins anew.
    pub(crate) fn take(&mut self, turn: Turn) {
        (self.blocked, self.without_progress, self.detour, self.detour_left) = (0.0, 0.0, 0.0, 0.0);
        (self.mark, self.stalled) = (None, 0.0);
        self.turn = turn;
    }

    /// Whatever its turn was, it is free. Who was aside needs another way.
    pub(crate) fn give_up_turn(&mut self) {
        if self.turn != Turn::Free {
            self.route = if self.turn == Turn::First { self.route.take() } else { None };
            self.take(Turn::Free);
        }
    }

    /// Notes whether the agent gets on: `step` is in radii that it walks when nothing hinders it.
    pub(crate) fn stall(&mut self, radius: f32, step: f32) {
        match self.mark {
            Some(mark) if self.distance() > mark - radius => self.stalled += step,
            _ => (self.mark, self.stalled) = (Some(self.distance()), 0.0),
        }
    }

    /// Notes how far the agent got in the last step, and tells by what angle to the right its preferred direction
    /// is to be turned. `made` is the part of the preferred speed it had towards `direction`; `queues`
    /// tells whether somebody ahead goes the same way.
    pub(crate) fn detour(&mut self, made: f32, step: f32, dice: Dice, queues: impl FnOnce() -> bool) -> f32 {
        self.progress += (made - self.progress) * (step / AVERAGE).min(1.0);
        self.without_progress = if self.progress >= NO_PROGRESS { 0.0 } else { self.without_progress + step };
        if self.detour_left > 0.0 {
            self.detour_left -= step;
            if self.detour_left <= 0.0 {
                self.detour = 0.0;
                self.blocked = 0.0;
            }
            return self.detour;
        }
        if self.progress >= NO_PROGRESS {
            self.blocked = 0.0;
            return 0.0;
        }
        self.blocked += step;
        if self.blocked >= PATIENCE {
            if queues() {
                self.blocked = 0.0;
            } else {
                let left = self.without_progress > EITHER_SIDE && dice.between((0.0, 1.0), Purpose::DetourSide) < 0.5;
                let angle = dice.between(DETOUR_ANGLE, Purpose::DetourAngle);
                self.detour = if left { -angle } else { angle };
                self.detour_left = dice.between(DETOUR_TIME, Purpose::DetourTime);
            }
        }
        self.detour
    }
}

/// `direction` turned to the right by `angle` radians.
pub(crate) fn turned_right(direction: Vec2, angle: f32) -> Vec2 {
    let (sin, cos) = libm::sincosf(angle);
    Vec2::new(cos * direction.x + sin * direction.y, cos * direction.y - sin * direction.x)
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
            let angle = travel.detour(0.0, STEP, Dice { seed: 3, number, step }, || queues);
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
            assert_eq!(travel.detour(0.5, 0.05, Dice { seed: 1, number: 1, step }, || false), 0.0);
        }
    }
}
