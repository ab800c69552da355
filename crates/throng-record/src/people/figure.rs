//! People of files that are read back: where their joints are.

use crate::formats::Format;
use crate::{FormatFlaw, TrajectoriesError};
use std::fmt;
use std::path::Path;
use throng_figure::{JOINTS, Person, Placed};

/// Returns where the joints are at a second; `None` while the person is not there.
type Joints = dyn Fn(f64) -> Option<[Placed; JOINTS]> + Send + Sync;

/// A person of a file.
pub struct Figure {
    /// The number of the agent.
    pub number: u32,
    /// The person: build and height.
    pub person: Person,
    /// The seconds of the file in which the person is there: first and last.
    pub seconds: [f64; 2],
    joints: Box<Joints>,
}

/// The people of a file.
#[derive(Debug)]
pub struct Figures {
    /// The people, in the order of the file.
    pub all: Vec<Figure>,
    /// Seconds from one frame to the next, on average.
    pub period: f64,
}

impl Figure {
    /// Returns a person; `joints` returns where its joints are at a second.
    #[cfg(any(feature = "bvh", feature = "glb", feature = "usda"))]
    pub(crate) fn new(
        (number, person, seconds): (u32, Person, [f64; 2]),
        joints: impl Fn(f64) -> Option<[Placed; JOINTS]> + Send + Sync + 'static,
    ) -> Self {
        Self { number, person, seconds, joints: Box::new(joints) }
    }

    /// Returns where the joints are at a second of the file, metres from the origin of its scene, in the order of
    /// [`Joint::ALL`](throng_figure::Joint::ALL); `None` while the agent is not there. Between two frames they are where
    /// readers of the file interpolate them.
    pub fn joints(&self, second: f64) -> Option<[Placed; JOINTS]> {
        (self.joints)(second)
    }
}

impl fmt::Debug for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Figure").field("number", &self.number).field("seconds", &self.seconds).finish_non_exhaustive()
    }
}

impl Figures {
    /// Reads the people of a file in memory. The ending of `path` determines its format: `.glb`, `.usda` or `.bvh`.
    ///
    /// ```
    /// use throng_record::people::Figures;
    /// let error = Figures::of_file("run.csv", b"number,time,x,y").unwrap_err();
    /// assert!(error.to_string().starts_with("run.csv: files of this kind have no figures"));
    /// ```
    ///
    /// # Errors
    /// The format has no figures, the file is damaged, or its figures do not have the joints of throng's.
    pub fn of_file(path: impl AsRef<Path>, bytes: &[u8]) -> Result<Self, TrajectoriesError> {
        let path = path.as_ref();
        let none = || {
            let why = "files of this kind have no figures".to_owned();
            let hint = Some("figures are in .glb, .usda and .bvh: throng run SCENE -o NAME.glb writes them");
            Err(FormatFlaw { line: None, why, hint })
        };
        let figures = Format::of(path).and_then(Format::figures);
        let found = figures.map_or_else(none, |figures| figures(bytes));
        found.map_err(|flaw| TrajectoriesError::Content { path: path.into(), flaw })
    }
}
