//! Frames that wait in a temporary file, for formats that store data by agent or by attribute.

use super::rate::Rate;
use crate::{Body, Frame, Output, OutputError, Setting};
use glam::{DVec2, Quat, Vec3};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::Path;
use throng_figure::{FASTEST, Person, slerp};

/// The longest time between two moments that suffices for people to walk, and between moments that are added, seconds.
const COARSE: f64 = 0.0401;
const FINE: f64 = 0.02;
/// The longest way of a person from one moment to the next that suffices, and between moments that are added, metres:
/// between moments, the rotations of a file lower the feet of those that hurry.
const COARSE_WAY: f64 = 0.08;
const FINE_WAY: f64 = 0.06;
/// The share of the ways that may be longer.
const HURRIED: f64 = 1e-3;
/// The longest time in which moments are added, seconds.
const GAP: f64 = 2.0;

/// Bytes of a row: the index of the agent and ten numbers.
pub(super) const ROW: usize = 44;

/// An agent of the recording.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpilledAgent {
    pub(crate) number: u32,
    pub(crate) group: u32,
    /// Metres.
    pub(crate) radius: f32,
    /// The first state.
    pub(crate) first: SpilledState,
}

/// The motion state of an agent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SpilledState {
    /// Metres from the origin of the setting.
    pub(crate) place: Vec3,
    /// m/s.
    pub(crate) velocity: Vec3,
    /// Rotation from facing +x upright.
    pub(crate) rotation: Quat,
}

impl SpilledState {
    fn of(body: &Body, origin: DVec2) -> Self {
        Self {
            place: (body.position - origin).as_vec2().extend(body.altitude),
            velocity: body.velocity.extend(body.vertical_velocity),
            rotation: body.basis.map_or_else(|| Quat::from_rotation_z(body.heading), |basis| basis.rotation()),
        }
    }

    /// Returns the state at a share of the time to another, 0 to 1.
    fn between(&self, other: &Self, share: f64) -> Self {
        let part = share as f32;
        Self {
            place: self.place.lerp(other.place, part),
            velocity: self.velocity.lerp(other.velocity, part),
            rotation: slerp(self.rotation.as_dquat(), other.rotation.as_dquat(), share).as_quat(),
        }
    }

    /// Returns the bytes of a row: a number and a state.
    pub(super) fn row(&self, number: u32) -> [u8; ROW] {
        let mut row = [0; ROW];
        row[..4].copy_from_slice(&number.to_le_bytes());
        let numbers = self.place.to_array().into_iter().chain(self.velocity.to_array()).chain(self.rotation.to_array());
        row[4..].chunks_exact_mut(4).zip(numbers).for_each(|(to, value)| to.copy_from_slice(&value.to_le_bytes()));
        row
    }

    pub(super) fn of_row(row: &[u8; ROW]) -> (u32, Self) {
        let word = |k: usize| [row[4 * k], row[4 * k + 1], row[4 * k + 2], row[4 * k + 3]];
        let value = |k: usize| f32::from_le_bytes(word(k));
        let (place, velocity) = (Vec3::from([1, 2, 3].map(value)), Vec3::from([4, 5, 6].map(value)));
        (u32::from_le_bytes(word(0)), Self { place, velocity, rotation: Quat::from_array([7, 8, 9, 10].map(value)) })
    }
}

/// Frames that wait on disk: 44 bytes per agent and frame, beside the output file. Memory holds the agents and a single
/// frame.
#[derive(Debug)]
pub(crate) struct Spill {
    file: BufWriter<File>,
    origin: DVec2,
    /// All agents, in order of their first frames.
    pub(crate) agents: Vec<SpilledAgent>,
    index: BTreeMap<u32, u32>,
    /// The latest frame of each agent.
    last: Vec<u32>,
    /// The time of each frame, seconds, and its number of agents.
    pub(crate) moments: Vec<(f64, u32)>,
    pub(super) rate: Rate,
    /// Corners of the bounding box of all positions, world coordinates.
    pub(super) seen: [DVec2; 2],
}

impl Spill {
    /// Starts a spill file beside the file of `output`.
    ///
    /// # Errors
    /// A system error.
    pub(super) fn new(output: &Output, setting: &Setting) -> Result<Self, OutputError> {
        Ok(Self {
            file: BufWriter::new(beside(output).map_err(|error| output.error(error))?),
            origin: setting.origin,
            agents: Vec::new(),
            index: BTreeMap::new(),
            last: Vec::new(),
            moments: Vec::new(),
            rate: Rate::default(),
            seen: [DVec2::INFINITY, DVec2::NEG_INFINITY],
        })
    }

    /// Adds a frame. If a number occurs twice, its first body counts.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub(super) fn push(&mut self, frame: &Frame) -> io::Result<()> {
        self.rate.push(frame.time);
        let (moment, mut count) = (self.moments.len() as u32, 0);
        for body in &frame.bodies {
            let state = SpilledState::of(body, self.origin);
            let agents = &mut self.agents;
            let at = *self.index.entry(body.number).or_insert_with(|| {
                let radius = body.shape().clearance_radius();
                agents.push(SpilledAgent { number: body.number, group: body.group, radius, first: state });
                agents.len() as u32 - 1
            });
            self.last.resize(self.agents.len(), u32::MAX);
            // a recording may have a number twice in a frame; a file organised by agent cannot
            if std::mem::replace(&mut self.last[at as usize], moment) == moment {
                continue;
            }
            count += 1;
            self.seen = [self.seen[0].min(body.position), self.seen[1].max(body.position)];
            self.file.write_all(&state.row(at))?;
        }
        self.moments.push((frame.time, count));
        Ok(())
    }

    /// Calls `each` with every frame in turn: its index, its time, and the states of its agents (by index into
    /// [`agents`](Self::agents)).
    ///
    /// # Errors
    /// A system error, or an error of `each`.
    pub(super) fn replay(
        &mut self,
        mut each: impl FnMut(u32, f64, &[(u32, SpilledState)]) -> io::Result<()>,
    ) -> io::Result<()> {
        self.file.flush()?;
        let file = self.file.get_mut();
        file.rewind()?;
        let mut reader = BufReader::with_capacity(1 << 16, file);
        let (mut row, mut rows) = ([0; ROW], Vec::new());
        for (moment, &(time, count)) in self.moments.iter().enumerate() {
            rows.clear();
            for _ in 0..count {
                reader.read_exact(&mut row)?;
                rows.push(SpilledState::of_row(&row));
            }
            each(moment as u32, time, &rows)?;
        }
        Ok(())
    }
}

impl Spill {
    /// Adds moments, so that people have poses often enough for their feet to stay where they are: at least 50 a second
    /// where there were fewer than 25, and one every 6 cm where those that hurry had fewer than one every 8 cm. Agents that are
    /// there before and after are interpolated. Gaps of more than two seconds stay.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub(crate) fn refine(&mut self, output: &Output) -> io::Result<()> {
        let hurry = self.hurry()?;
        let (coarse, fine) = (COARSE.min(COARSE_WAY / hurry), FINE.min(FINE_WAY / hurry));
        let parts = |from: f64, to: f64| {
            let time = to - from;
            if time > coarse && time <= GAP { (time / fine - 1e-6).ceil() as u32 } else { 1 }
        };
        if !self.moments.windows(2).any(|two| parts(two[0].0, two[1].0) > 1) {
            return Ok(());
        }
        let mut file = BufWriter::new(beside(output)?);
        let mut moments: Vec<(f64, u32)> = Vec::with_capacity(self.moments.len());
        let mut last: BTreeMap<u32, SpilledState> = BTreeMap::new();
        self.replay(|_, time, rows| {
            let before = moments.last().map_or(time, |&(time, _)| time);
            let next: BTreeMap<u32, SpilledState> = rows.iter().copied().collect();
            let parts = parts(before, time);
            for part in 1..parts {
                let share = f64::from(part) / f64::from(parts);
                let mut count = 0;
                for (agent, state) in &last {
                    if let Some(other) = next.get(agent) {
                        file.write_all(&state.between(other, share).row(*agent))?;
                        count += 1;
                    }
                }
                moments.push((before + (time - before) * share, count));
            }
            for (agent, state) in rows {
                file.write_all(&state.row(*agent))?;
            }
            moments.push((time, rows.len() as u32));
            last = next;
            Ok(())
        })?;
        self.rate = Rate::default();
        moments.iter().for_each(|&(time, _)| self.rate.push(time));
        (self.file, self.moments) = (file, moments);
        Ok(())
    }

    /// Returns the speed that nearly no person exceeds, m/s. Ways that are jumps do not count.
    fn hurry(&mut self) -> io::Result<f64> {
        const STEPS: f64 = 100.0;
        let is_person = |agent: &SpilledAgent| Person::of_agent(agent.number, agent.radius).is_some();
        let people: Vec<bool> = self.agents.iter().map(is_person).collect();
        let mut counts = [0u64; (FASTEST * STEPS) as usize];
        let (mut before, mut last) = (0.0, BTreeMap::new());
        self.replay(|_, time, rows| {
            for (agent, state) in rows.iter().filter(|(agent, _)| people[*agent as usize]) {
                let Some(place) = last.insert(*agent, state.place).filter(|_| time > before) else { continue };
                let speed = f64::from(state.place.distance(place)) / (time - before);
                if let Some(count) = counts.get_mut((speed * STEPS) as usize) {
                    *count += 1;
                }
            }
            before = time;
            Ok(())
        })?;
        let allowed = (counts.iter().sum::<u64>() as f64 * HURRIED) as u64;
        let mut faster = 0;
        let exceeded = counts.iter().rposition(|count| {
            faster += count;
            faster > allowed
        });
        Ok(exceeded.map_or(0.0, |step| (step + 1) as f64 / STEPS))
    }
}

/// Creates a file without a name, in the folder of the file of `output`.
///
/// # Errors
/// A system error.
pub(super) fn beside(output: &Output) -> io::Result<File> {
    let folder = output.own_file().and_then(Path::parent).filter(|folder| !folder.as_os_str().is_empty());
    folder.map_or_else(tempfile::tempfile, tempfile::tempfile_in)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moments are added where there are few, on the straight line of each agent, and not in long gaps.
    #[test]
    fn moments_are_added_where_there_are_few() {
        let folder = tempfile::tempdir().unwrap();
        let output = Output::create(folder.path().join("run.glb")).unwrap();
        let mut spill = Spill::new(&output, &Setting::default()).unwrap();
        // 0.1 s, 0.04 s, then 3.4 s apart; agent 5 leaves, and agent 6 comes
        let times = [0.0, 0.1, 0.14, 3.54];
        for (k, &time) in times.iter().enumerate() {
            let body = |number: u32| {
                let mut body = Body::walking(number, DVec2::new(time * 1.5, f64::from(number)));
                body.heading = time as f32;
                body
            };
            let bodies = if k < 2 { vec![body(4), body(5)] } else { vec![body(4), body(6)] };
            spill.push(&Frame { time, bodies, ..Frame::default() }).unwrap();
        }
        spill.refine(&output).unwrap();
        let found: Vec<f64> = spill.moments.iter().map(|&(time, _)| (time * 1e6).round() / 1e6).collect();
        assert_eq!(found, [0.0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.14, 3.54]);
        let mut seen = Vec::new();
        spill
            .replay(|_, time, rows| {
                for (agent, state) in rows {
                    assert!((f64::from(state.place.x) - time * 1.5).abs() < 1e-6, "{time}: {state:?}");
                    let turned = state.rotation.angle_between(Quat::from_rotation_z(time as f32));
                    assert!(turned < 1e-3, "{time}: {state:?}");
                    seen.push(*agent);
                }
                Ok(())
            })
            .unwrap();
        assert_eq!(seen, [[0, 1].repeat(6), [0, 2].repeat(2)].concat());
    }

    /// People that hurry have a moment every 6 cm; one that jumps does not change the moments of all.
    #[test]
    fn moments_are_added_where_people_hurry() {
        for (speed, want) in [(1.9, 1), (2.1, 2), (3.2, 3), (0.0, 1)] {
            let folder = tempfile::tempdir().unwrap();
            let output = Output::create(folder.path().join("run.glb")).unwrap();
            let mut spill = Spill::new(&output, &Setting::default()).unwrap();
            for moment in 0..1001u32 {
                let time = 0.04 * f64::from(moment);
                // agent 1 jumps once by 0.5 m; agent 2 is no person, and races
                let jump = if moment > 500 { 0.5 } else { 0.0 };
                let places = [speed * time, 0.1 * time + jump, 9.0 * time];
                let body = |(number, x): (u32, f64)| {
                    let mut body = Body::walking(number, DVec2::new(x, f64::from(number)));
                    body.radius = if number == 2 { 2.0 } else { 0.25 };
                    body
                };
                let bodies = (0..).zip(places).map(body).collect();
                spill.push(&Frame { time, bodies, ..Frame::default() }).unwrap();
            }
            spill.refine(&output).unwrap();
            assert_eq!(spill.moments.len(), 1000 * want + 1, "{speed} m/s");
        }
    }
}
