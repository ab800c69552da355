//! What is to be recorded.

use std::path::{Path, PathBuf};
use throng_draw::Style;
use throng_draw::sink::Kind;
use throng_record::Choice;

/// What a recording becomes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// H.264 video.
    #[cfg_attr(not(target_arch = "wasm32"), default)]
    Video,
    /// A looping animation.
    #[cfg_attr(target_arch = "wasm32", default)]
    Gif,
    /// A folder of pictures.
    Pictures,
    /// Where everybody was at every step.
    Trajectories,
}

impl Format {
    /// Those that can be written here: a web page has no folders, and no encoder of video.
    pub const ALL: &[Self] = if cfg!(target_arch = "wasm32") {
        &[Self::Gif, Self::Trajectories]
    } else {
        &[Self::Video, Self::Gif, Self::Pictures, Self::Trajectories]
    };

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Video => "video (.mp4)",
            Self::Gif => "animation (.gif)",
            Self::Pictures => "pictures (a folder of .png)",
            Self::Trajectories => "trajectories (.csv, .rec, ..)",
        }
    }

    /// How its name ends.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Video => ".mp4",
            Self::Gif => ".gif",
            Self::Pictures => "/",
            Self::Trajectories => ".csv",
        }
    }

    /// What the name of a file says.
    ///
    /// # Errors
    /// It says nothing that can be recorded; how names end.
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

/// What is to be recorded, and how.
#[derive(Clone, Debug)]
pub struct Take {
    /// The file; its ending says what it becomes.
    pub path: PathBuf,
    /// From when to when, and what of it trajectories have.
    pub choice: Choice,
    /// Pictures a second, 0.001 to 1000.
    pub rate: f64,
    /// Seconds of the scene in a second of video, greater than 0.
    pub speed_up: f64,
    /// What pictures look like.
    pub style: Style,
}
