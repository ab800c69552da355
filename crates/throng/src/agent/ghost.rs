//! Ghosts: copies of the rows of other worlds, of which other agents read a part.

use super::{Columns, GroupId, Hindrance, JourneyId, ProgressMark, Rounding, ScriptId, Status};
use crate::navigate::{RouteProgress, Turn};
use glam::{Vec2, Vec3};

/// The words of a ghost.
pub(crate) type GhostWords = [u32; 32];

/// What a word has for no script.
const NO_SCRIPT: u32 = u32::MAX;

const HINDRANCES: [Hindrance; 5] =
    [Hindrance::None, Hindrance::Queueing, Hindrance::WaitingForRoom, Hindrance::Blocked, Hindrance::Oscillating];

impl Status {
    const ALL: [Self; 4] = [Self::Walking, Self::Waiting, Self::Arrived, Self::Stranded];

    /// Returns the status with a number; `None` if there is no such status.
    pub(crate) fn numbered(number: u32) -> Option<Self> {
        Self::ALL.get(number as usize).copied()
    }
}

impl Columns {
    /// Returns what other agents read of an agent, as words.
    pub(crate) fn ghost(&self, row: usize) -> GhostWords {
        let (position, velocity, core) = (self.position[row], self.velocity[row], self.core[row]);
        let Rounding(rounding) = self.rounding[row];
        let ProgressMark { queue_ticks, hindrance, .. } = self.progress_mark[row];
        let RouteProgress { leg, turn, stalled, .. } = self.travel[row];
        let commanded = self.commanded[row].unwrap_or_default();
        let flags = [self.status[row] as u8 | (turn as u8) << 4, hindrance as u8, queue_ticks];
        let [status_and_turn, hindrance, queue_ticks] = flags.map(u32::from);
        let is_commanded = u32::from(self.commanded[row].is_some());
        [
            self.number[row],
            position.x.to_bits(),
            position.y.to_bits(),
            self.altitude[row].to_bits(),
            velocity.x.to_bits(),
            velocity.y.to_bits(),
            self.vertical_velocity[row].to_bits(),
            self.heading[row].to_bits(),
            self.spin[row].to_bits(),
            self.radius[row].to_bits(),
            core.x.to_bits(),
            core.y.to_bits(),
            self.preferred_speed[row].to_bits(),
            self.max_speed[row].to_bits(),
            self.max_acceleration[row].to_bits(),
            self.max_turn_rate[row].to_bits(),
            self.tracking_error[row].to_bits(),
            self.priority[row].to_bits(),
            self.layers[row],
            self.avoids[row],
            self.group[row].0,
            self.journey[row].0,
            self.script[row].map_or(NO_SCRIPT, |script| script.0),
            commanded.x.to_bits(),
            commanded.y.to_bits(),
            commanded.z.to_bits(),
            leg,
            status_and_turn | hindrance << 8 | queue_ticks << 16,
            is_commanded,
            stalled.to_bits(),
            rounding.x.to_bits(),
            rounding.y.to_bits(),
        ]
    }

    /// Adds rows of ghosts. Columns that only the world of an agent reads get any value: one that takes no memory, if all
    /// rows have the same. Returns `None` for words that no [`ghost`](Self::ghost) has.
    pub(crate) fn push_ghosts(&mut self, ghosts: &[GhostWords]) -> Option<()> {
        let Self {
            slot,
            number,
            position,
            rounding,
            altitude,
            velocity,
            vertical_velocity,
            heading,
            attitude,
            memory,
            spin,
            radius,
            core,
            preferred_speed,
            vehicle,
            max_speed,
            max_acceleration,
            max_turn_rate,
            time_gap,
            tracking_error,
            priority,
            governed,
            layers,
            avoids,
            group,
            journey,
            script,
            status,
            commanded,
            user_data,
            travel,
            progress_mark,
            entered,
            arrived,
            on_way,
            walked,
            turned,
            course_turned,
            shortest,
        } = self;
        let count = ghosts.len();
        for words in ghosts {
            let float = |index: usize| f32::from_bits(words[index]);
            number.push(words[0]);
            position.push(Vec2::new(float(1), float(2)));
            rounding.push(Rounding(Vec2::new(float(30), float(31))));
            altitude.push(float(3));
            velocity.push(Vec2::new(float(4), float(5)));
            vertical_velocity.push(float(6));
            heading.push(float(7));
            spin.push(float(8));
            radius.push(float(9));
            core.push(Vec2::new(float(10), float(11)));
            preferred_speed.push(float(12));
            max_speed.push(float(13));
            max_acceleration.push(float(14));
            max_turn_rate.push(float(15));
            tracking_error.push(float(16));
            priority.push(float(17));
            layers.push(words[18]);
            avoids.push(words[19]);
            group.push(GroupId(words[20]));
            journey.push(JourneyId(words[21]));
            script.push((words[22] != NO_SCRIPT).then_some(ScriptId(words[22])));
            commanded.push((words[28] != 0).then(|| Vec3::new(float(23), float(24), float(25))));
            let [status_and_turn, hindrance, queue_ticks, _] = words[27].to_le_bytes();
            let turn = Turn::numbered(u32::from(status_and_turn >> 4))?;
            travel.push(RouteProgress::seen(words[26], turn, float(29)));
            status.push(Status::numbered(u32::from(status_and_turn & 15))?);
            let hindrance = *HINDRANCES.get(usize::from(hindrance))?;
            progress_mark.push(ProgressMark { queue_ticks, hindrance, ..ProgressMark::default() });
        }
        let rows = number.len();
        slot.resize(rows, u32::MAX);
        for sums in [walked, turned, course_turned, shortest] {
            sums.resize(rows, 0.0);
        }
        (0..count).for_each(|_| memory.push());
        attitude.extend_with_any(count);
        vehicle.extend_with_any(count);
        user_data.extend_with_any(count);
        for column in [time_gap, governed] {
            column.extend_with_any(count);
        }
        for column in [entered, arrived, on_way] {
            column.extend_with_any(count);
        }
        Some(())
    }
}
