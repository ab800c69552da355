//! Formats and settings of a recording.

use std::path::{Path, PathBuf};
use throng_draw::Style;
use throng_draw::sink::Kind;
use throng_record::Choice;

/// The format of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// H.264 video.
    #[cfg_attr(not(target_arch = "wasm32"), default)]
    Video,
    /// A looping animation.
    #[cfg_attr(target_arch = "wasm32", default)]
    Gif,
    /// A folder of numbered pictures.
    Pictures,
    /// The positions of the agents at every sample.
    Trajectories,
}

impl Format {
    /// The formats of this platform. A web page can write neither folders nor video.
    pub const ALL: &[Self] = if cfg!(target_arch = "wasm32") {
        &[Self::Gif, Self::Trajectories]
    } else {
        &[Self::Video, Self::Gif, Self::Pictures, Self::Trajectories]
    };

    /// Returns the label.
    pub fn label(self) -> &'static str {
        match self {
            Self::Video => "video (.mp4)",
            Self::Gif => "animation (.gif)",
            Self::Pictures => "pictures (a folder of .png)",
            Self::Trajectories => "trajectories (.csv, .rec, ..)",
        }
    }

    /// Returns the ending of the file name.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Video => ".mp4",
            Self::Gif => ".gif",
            Self::Pictures => "/",
            Self::Trajectories => ".csv",
        }
    }

    /// Returns the format that a file name selects.
    ///
    /// # Errors
    /// The name selects no recordable format. The message lists the endings.
    pub fn of(path: &Path) -> Result<Self, String> {
        let table = throng_record::Format::of(path).is_some_and(throng_record::Format::is_written);
        let said = match Kind::of(path) {
            Err(_) if table => Some(Self::Trajectories),
            Ok(Kind::Mp4 | Kind::Pipe) => Some(Self::Video),
            Ok(Kind::Gif) => Some(Self::Gif),
            Ok(Kind::Folder) => Some(Self::Pictures),
            _ => None,
        };
        said.filter(|said| Self::ALL.contains(said)).ok_or_else(|| {
            let ends: Vec<&str> = Self::ALL.iter().map(|format| format.ending()).collect();
            format!(
                "{}: cannot tell what to record from this name; end it in one of {}",
                path.display(),
                ends.join("  ")
            )
        })
    }
}

/// The settings of a recording.
#[derive(Clone, Debug)]
pub struct Take {
    /// The file. Its ending selects the format.
    pub path: PathBuf,
    /// The time span, and the choice of trajectories.
    pub choice: Choice,
    /// Pictures per second, 0.001 to 1000.
    pub rate: f64,
    /// Seconds of the scene per second of video, greater than 0.
    pub speed_up: f64,
    /// The style of pictures.
    pub style: Style,
}
