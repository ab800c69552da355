//! Moments that wait in a temporary file, for kinds of files that say agent by agent, or thing by thing, what comes moment by moment.

use super::rate::Rate;
use crate::{Frame, Output, OutputError, Setting};
use glam::{DVec2, Vec3};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Seek, Write};
use std::path::Path;

/// Bytes of a row in the file: whose it is, and seven numbers.
const ROW: usize = 32;

/// Somebody who was there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Agent {
    pub(super) number: u32,
    pub(super) group: u32,
    /// Metres.
    pub(super) radius: f32,
    /// The place where it came, and so on.
    pub(super) first: State,
}

/// Where and how somebody is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct State {
    /// Metres from the origin of the setting.
    pub(super) place: Vec3,
    /// m/s.
    pub(super) velocity: Vec3,
    /// Radians.
    pub(super) heading: f32,
}

/// Moments that wait: 32 bytes an agent and moment on the disk, next to the file that is to be; in memory, who there is, and one moment.
#[derive(Debug)]
pub(super) struct Spill {
    file: BufWriter<File>,
    origin: DVec2,
    /// Everybody, in the order in which they came.
    pub(super) agents: Vec<Agent>,
    index: BTreeMap<u32, u32>,
    /// The times of the moments, seconds, and how many were there.
    pub(super) moments: Vec<(f64, u32)>,
    pub(super) rate: Rate,
    /// Corners of the box in which everybody was, world coordinates.
    pub(super) seen: [DVec2; 2],
}

impl Spill {
    /// Begins beside the file of `output`.
    ///
    /// # Errors
    /// The system's.
    pub(super) fn new(output: &Output, setting: &Setting) -> Result<Self, OutputError> {
        let beside = output.own_file().and_then(Path::parent).filter(|folder| !folder.as_os_str().is_empty());
        let file = beside.map_or_else(tempfile::tempfile, tempfile::tempfile_in);
        Ok(Self {
            file: BufWriter::new(file.map_err(|error| output.error(error))?),
            origin: setting.origin,
            agents: Vec::new(),
            index: BTreeMap::new(),
            moments: Vec::new(),
            rate: Rate::default(),
            seen: [DVec2::INFINITY, DVec2::NEG_INFINITY],
        })
    }

    /// Takes in a moment.
    ///
    /// # Errors
    /// The system's, such as a full disk.
    pub(super) fn push(&mut self, frame: &Frame) -> std::io::Result<()> {
        self.rate.push(frame.time);
        self.moments.push((frame.time, frame.bodies.len() as u32));
        for body in &frame.bodies {
            let place = (body.position - self.origin).as_vec2().extend(body.altitude);
            let state = State { place, velocity: body.velocity.extend(body.climb), heading: body.heading };
            let agents = &mut self.agents;
            let at = *self.index.entry(body.number).or_insert_with(|| {
                let radius = body.shape().girth();
                agents.push(Agent { number: body.number, group: body.group, radius, first: state });
                agents.len() as u32 - 1
            });
            self.seen = [self.seen[0].min(body.position), self.seen[1].max(body.position)];
            let mut row = [0; ROW];
            row[..4].copy_from_slice(&at.to_le_bytes());
            let numbers = place.to_array().into_iter().chain(state.velocity.to_array()).chain([state.heading]);
            row[4..].chunks_exact_mut(4).zip(numbers).for_each(|(to, value)| to.copy_from_slice(&value.to_le_bytes()));
            self.file.write_all(&row)?;
        }
        Ok(())
    }

    /// Calls `each` with every moment in turn: its number, its time, everybody's state (of who is not there the last, or the first to
    /// come), and whether they are there.
    ///
    /// # Errors
    /// The system's, and those of `each`.
    pub(super) fn replay<E>(
        &mut self,
        fail: impl Fn(std::io::Error) -> E,
        mut each: impl FnMut(usize, f64, &[State], &[bool]) -> Result<(), E>,
    ) -> Result<(), E> {
        self.file.flush().map_err(&fail)?;
        let file = self.file.get_mut();
        file.rewind().map_err(&fail)?;
        let mut reader = BufReader::with_capacity(1 << 16, file);
        let mut states: Vec<State> = self.agents.iter().map(|agent| agent.first).collect();
        let mut there = vec![false; states.len()];
        for (moment, &(time, count)) in self.moments.iter().enumerate() {
            there.fill(false);
            for _ in 0..count {
                let mut row = [0; ROW];
                reader.read_exact(&mut row).map_err(&fail)?;
                let word = |k: usize| [row[4 * k], row[4 * k + 1], row[4 * k + 2], row[4 * k + 3]];
                let value = |k: usize| f32::from_le_bytes(word(k));
                let at = u32::from_le_bytes(word(0)) as usize;
                let (place, velocity) = (Vec3::from([1, 2, 3].map(value)), Vec3::from([4, 5, 6].map(value)));
                states[at] = State { place, velocity, heading: value(7) };
                there[at] = true;
            }
            each(moment, time, &states, &there)?;
        }
        Ok(())
    }
}
