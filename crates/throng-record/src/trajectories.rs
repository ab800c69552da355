//! Trajectories read from files.

use crate::Setting;
use crate::consistency;
use crate::formats::{FORMATS, Format, FormatFlaw, Reading, parts};
use crate::limits;
use glam::{DVec3, Vec3};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use throng::Status;

/// The trajectories of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectories {
    /// The place and the names, as far as the file states them; groups in order of their first samples.
    pub setting: Setting,
    /// All samples of the file, by time, then by number.
    pub spots: Vec<Sample>,
    /// The unit of length of a file without a fixed unit, metres: as the reading stated it, or as it was detected.
    pub unit: Option<f64>,
    /// Notes for the user of the file, such as velocities that contradict positions and times.
    pub notes: Vec<String>,
}

/// A sample: the state of an agent at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The agent number.
    pub number: u32,
    /// Index into the groups of [`Trajectories::setting`].
    pub group: u32,
    /// Seconds.
    pub time: f64,
    /// Metres.
    pub place: DVec3,
    /// Velocity, m/s.
    pub velocity: Vec3,
    /// Direction of the body, radians counter-clockwise from +x.
    pub heading: f32,
    /// Radius of the body, metres.
    pub radius: f32,
    /// The agent's status.
    pub status: Status,
}

/// The radius of bodies if the file states none, metres.
pub(crate) const RADIUS: f32 = 0.2;

/// An error of reading trajectories.
#[derive(Debug, thiserror::Error)]
pub enum TrajectoriesError {
    /// The system cannot read the file.
    #[error("cannot read {}: {source}", path.display())]
    File {
        /// The name of the file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// The file has another format, or is damaged.
    #[error("{}", content(path, flaw))]
    Content {
        /// The name of the file.
        path: PathBuf,
        /// The error in the file.
        flaw: FormatFlaw,
    },
    /// The ending of the file's name is not that of a supported format.
    #[error("{}: the ending of the name is not that of a trajectory format\n  hint: supported endings: {}", path.display(), endings())]
    Unknown {
        /// The name of the file.
        path: PathBuf,
    },
}

impl Trajectories {
    /// Reads a trajectory file. The ending of its name determines its format ([`FORMATS`](crate::formats::FORMATS)). Of a
    /// folder, reads the files called `part-*` as the parts of one recording.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("run.csv");
    /// use throng_record::Trajectories;
    /// std::fs::write(&path, "time,number,x,y,z\n0,7,1.5,2,3\n0.1,7,1.6,2,3\n")?;
    /// let tracks = Trajectories::read(&path)?;
    /// assert_eq!((tracks.spots.len(), tracks.spots[1].place.x), (2, 1.6));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`TrajectoriesError::File`] if the file cannot be read, [`TrajectoriesError::Unknown`] if the ending of its name is unknown,
    /// [`TrajectoriesError::Content`] if its content is invalid, with the line if the file has lines.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, TrajectoriesError> {
        Self::read_as(path, &Reading::default())
    }

    /// Reads a trajectory file with properties that the file does not state.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_as(path: impl AsRef<Path>, reading: &Reading) -> Result<Self, TrajectoriesError> {
        let path = path.as_ref();
        if path.is_dir() {
            return parts::read(path, reading);
        }
        let bytes = std::fs::read(path).map_err(|source| TrajectoriesError::File { path: path.into(), source })?;
        Self::of_file(path, &bytes, reading)
    }

    /// Reads a trajectory file in memory. `path` determines its format and names it in errors.
    ///
    /// # Errors
    /// As [`read`](Self::read), except [`TrajectoriesError::File`].
    pub fn of_file(path: impl AsRef<Path>, bytes: &[u8], reading: &Reading) -> Result<Self, TrajectoriesError> {
        let path = path.as_ref();
        let read = Format::of_file(path, bytes)
            .and_then(Format::reader)
            .ok_or_else(|| TrajectoriesError::Unknown { path: path.into() })?;
        let content = |flaw| TrajectoriesError::Content { path: path.into(), flaw };
        let mut tracks = read(bytes, reading).map_err(content)?;
        limits::tracks(&tracks).map_err(content)?;
        tracks.notes.extend(consistency::contradiction(&tracks.spots, reading));
        tracks.notes.iter_mut().for_each(|note| *note = format!("{}: {note}", path.display()));
        Ok(tracks)
    }

    /// Whether the ending of a file's name is that of a trajectory format that can be read.
    pub fn are_in(path: impl AsRef<Path>) -> bool {
        Format::of(path).and_then(Format::reader).is_some()
    }

    /// Moves the trajectories into a known place, and takes over its setting. Returns `false`, without changes, if the
    /// place lacks one of their groups. The name of a group without a name is its index.
    pub fn put_into(&mut self, place: &Setting) -> bool {
        let find = |name: &String| (0..place.groups.len() as u32).find(|&group| place.group_name(group) == *name);
        let Some(groups) = self.setting.groups.iter().map(find).collect::<Option<Vec<u32>>>() else { return false };
        self.spots.iter_mut().for_each(|spot| spot.group = groups[spot.group as usize]);
        self.setting = place.clone();
        true
    }

    /// Sorts by time, then by number.
    pub(crate) fn sort(&mut self) {
        // -0 and 0 are the same time
        let time = |spot: &Sample| spot.time + 0.0;
        self.spots.sort_by(|a, b| time(a).total_cmp(&time(b)).then(a.number.cmp(&b.number)));
    }

    /// Computes velocities from displacements, and headings from velocities, if the file has none.
    pub(crate) fn complete(&mut self, velocities: bool, headings: bool) {
        let mut last: HashMap<u32, usize> = HashMap::new();
        for at in 0..if velocities || headings { self.spots.len() } else { 0 } {
            let before = last.insert(self.spots[at].number, at).map(|before| self.spots[before]);
            let spot = &mut self.spots[at];
            if velocities && let Some(before) = before {
                spot.velocity = ((spot.place - before.place) / (spot.time - before.time).max(1e-6)).as_vec3();
            }
            if headings {
                let moves = spot.velocity.truncate().length_squared() > 1e-6;
                let stays = before.map_or(0.0, |before| before.heading);
                spot.heading = if moves { spot.velocity.y.atan2(spot.velocity.x) } else { stays };
            }
        }
    }

    /// Returns the times, in order, with the positions of a group's agents, by number.
    pub fn moments(&self, group: u32) -> impl Iterator<Item = (f64, Vec<(u32, DVec3)>)> + '_ {
        self.spots.chunk_by(|a, b| a.time == b.time).map(move |spots| {
            let members = spots.iter().filter(|spot| spot.group == group);
            (spots[0].time, members.map(|spot| (spot.number, spot.place)).collect())
        })
    }
}

/// Returns the message of an error in a file.
fn content(path: &Path, flaw: &FormatFlaw) -> String {
    let line = flaw.line.map_or_else(String::new, |line| format!("{line}:"));
    let hint = flaw.hint.map_or_else(String::new, |hint| format!("\n  hint: {hint}"));
    format!("{}:{line} {flaw}{hint}", path.display())
}

/// Returns the endings of all formats that can be read.
fn endings() -> String {
    let read = FORMATS.iter().filter(|format| format.is_read()).map(|format| format!(".{}", format.ending));
    read.collect::<Vec<_>>().join(", ")
}
