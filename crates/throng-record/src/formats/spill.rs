//! Moments that wait in a temporary file, for kinds of files that say agent by agent, or thing by thing, what comes moment by moment.

use super::rate::Rate;
use crate::{Body, Frame, Output, OutputError, Setting};
use glam::{DVec2, Quat, Vec3};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::Path;

/// Bytes of a row in the file: whose it is, and ten numbers.
pub(super) const ROW: usize = 44;

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
    /// From facing +x upright.
    pub(super) rotation: Quat,
}

impl State {
    fn of(body: &Body, origin: DVec2) -> Self {
        Self {
            place: (body.position - origin).as_vec2().extend(body.altitude),
            velocity: body.velocity.extend(body.climb),
            rotation: body.basis.map_or_else(|| Quat::from_rotation_z(body.heading), |basis| basis.rotation()),
        }
    }

    /// The bytes of a row: a number, and a state.
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

/// Moments that wait: 44 bytes an agent and moment on the disk, next to the file that is to be; in memory, who there is, and one moment.
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
        Ok(Self {
            file: BufWriter::new(beside(output).map_err(|error| output.error(error))?),
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
    pub(super) fn push(&mut self, frame: &Frame) -> io::Result<()> {
        self.rate.push(frame.time);
        self.moments.push((frame.time, frame.bodies.len() as u32));
        for body in &frame.bodies {
            let state = State::of(body, self.origin);
            let agents = &mut self.agents;
            let at = *self.index.entry(body.number).or_insert_with(|| {
                let radius = body.shape().girth();
                agents.push(Agent { number: body.number, group: body.group, radius, first: state });
                agents.len() as u32 - 1
            });
            self.seen = [self.seen[0].min(body.position), self.seen[1].max(body.position)];
            self.file.write_all(&state.row(at))?;
        }
        Ok(())
    }

    /// Calls `each` with every moment in turn: its number, its time, and who was there (an index into [`agents`](Self::agents)) and how.
    ///
    /// # Errors
    /// The system's, and those of `each`.
    pub(super) fn replay(
        &mut self,
        mut each: impl FnMut(u32, f64, &[(u32, State)]) -> io::Result<()>,
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
                rows.push(State::of_row(&row));
            }
            each(moment as u32, time, &rows)?;
        }
        Ok(())
    }
}

/// A file without a name, in the folder of that of `output`.
///
/// # Errors
/// The system's.
pub(super) fn beside(output: &Output) -> io::Result<File> {
    let folder = output.own_file().and_then(Path::parent).filter(|folder| !folder.as_os_str().is_empty());
    folder.map_or_else(tempfile::tempfile, tempfile::tempfile_in)
}
