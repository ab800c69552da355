//! Trajectories read back: who was where, and when.

use crate::Setting;
use crate::consistency;
use crate::formats::{FORMATS, Flaw, Format, Reading};
use crate::limits;
use glam::{DVec3, Vec3};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use throng::Status;

/// Who was where, and when.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tracks {
    /// The place and the names, as far as the file says them; groups in the order in which they come.
    pub setting: Setting,
    /// Everything that the file says, by time, then by number.
    pub spots: Vec<Spot>,
    /// Metres in the unit of length of the file, of a kind that has none of its own: as it was said or found.
    pub unit: Option<f64>,
    /// What was found when it was read that a user of the file should know, such as velocities that contradict places and times.
    pub notes: Vec<String>,
}

/// Where somebody was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Its number.
    pub number: u32,
    /// Index into the groups of [`Tracks::setting`].
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
    /// What it is doing.
    pub status: Status,
}

/// The radius of a body that the file says none of, metres.
pub(crate) const RADIUS: f32 = 0.2;

/// Why a table cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum TracksError {
    /// The system does not let it be read.
    #[error("cannot read {}: {source}", path.display())]
    File {
        /// Its name.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// It is no file of trajectories, or a broken one.
    #[error("{}", content(path, flaw))]
    Content {
        /// Its name.
        path: PathBuf,
        /// What is wrong.
        flaw: Flaw,
    },
    /// Its name ends as none of those that are read.
    #[error("{}: cannot tell what this is from its name\n  hint: what is read ends in {}", path.display(), endings())]
    Unknown {
        /// Its name.
        path: PathBuf,
    },
}

impl Tracks {
    /// Reads a file of trajectories, by the ending of its name ([`FORMATS`](crate::formats::FORMATS)).
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("run.csv");
    /// use throng_record::Tracks;
    /// std::fs::write(&path, "time,number,x,y,z\n0,7,1.5,2,3\n0.1,7,1.6,2,3\n")?;
    /// let tracks = Tracks::read(&path)?;
    /// assert_eq!((tracks.spots.len(), tracks.spots[1].place.x), (2, 1.6));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`TracksError::File`] if it cannot be read, [`TracksError::Unknown`] if its name does not say what it is,
    /// [`TracksError::Content`] if it is not what its name says, with the line where there are lines.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, TracksError> {
        Self::read_as(path, &Reading::default())
    }

    /// The same of a file of which more is known than it says itself.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_as(path: impl AsRef<Path>, reading: &Reading) -> Result<Self, TracksError> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(|source| TracksError::File { path: path.into(), source })?;
        Self::of_file(path, &bytes, reading)
    }

    /// The same of a file that is in memory: `path` says what kind it is, and is what errors call it.
    ///
    /// # Errors
    /// As [`read`](Self::read), but the first.
    pub fn of_file(path: impl AsRef<Path>, bytes: &[u8], reading: &Reading) -> Result<Self, TracksError> {
        let path = path.as_ref();
        let read = Format::of_file(path, bytes)
            .and_then(Format::reader)
            .ok_or_else(|| TracksError::Unknown { path: path.into() })?;
        let content = |flaw| TracksError::Content { path: path.into(), flaw };
        let mut tracks = read(bytes, reading).map_err(content)?;
        limits::tracks(&tracks).map_err(content)?;
        tracks.notes.extend(consistency::contradiction(&tracks.spots, reading));
        tracks.notes.iter_mut().for_each(|note| *note = format!("{}: {note}", path.display()));
        Ok(tracks)
    }

    /// Whether the name of a file is that of trajectories that are read.
    pub fn are_in(path: impl AsRef<Path>) -> bool {
        Format::of(path).and_then(Format::reader).is_some()
    }

    /// Puts them into a place that is known from elsewhere, whose setting is theirs then; `false`, and nothing changes, if it has not all of
    /// their groups. A group without a name is called by its index.
    pub fn put_into(&mut self, place: &Setting) -> bool {
        let find = |name: &String| (0..place.groups.len() as u32).find(|&group| place.group_name(group) == *name);
        let Some(groups) = self.setting.groups.iter().map(find).collect::<Option<Vec<u32>>>() else { return false };
        self.spots.iter_mut().for_each(|spot| spot.group = groups[spot.group as usize]);
        self.setting = place.clone();
        true
    }

    /// By time, then by number.
    pub(crate) fn sort(&mut self) {
        self.spots.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.number.cmp(&b.number)));
    }

    /// Makes velocities of ways, and headings of velocities, where the file says none.
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

    /// The moments, in order, with who of a group was where, by number.
    pub fn moments(&self, group: u32) -> impl Iterator<Item = (f64, Vec<(u32, DVec3)>)> + '_ {
        self.spots.chunk_by(|a, b| a.time == b.time).map(move |spots| {
            let members = spots.iter().filter(|spot| spot.group == group);
            (spots[0].time, members.map(|spot| (spot.number, spot.place)).collect())
        })
    }
}

/// What is wrong with a file, in words.
fn content(path: &Path, flaw: &Flaw) -> String {
    let line = flaw.line.map_or_else(String::new, |line| format!("{line}:"));
    let hint = flaw.hint.map_or_else(String::new, |hint| format!("\n  hint: {hint}"));
    format!("{}:{line} {}{hint}", path.display(), flaw.why)
}

/// How the names of all files end that are read.
fn endings() -> String {
    let read = FORMATS.iter().filter(|format| format.is_read()).map(|format| format!(".{}", format.ending));
    read.collect::<Vec<_>>().join(", ")
}
