//! How people are written.

use std::fmt;
use std::str::FromStr;

/// The most agents of a recording that become skins or skeletons without being asked for: engines take too long to load
/// more.
pub const MOST_SKINS: usize = 300;

/// How the people of a recording are written to formats that have figures (`.glb`, `.usda`, `.bvh`).
///
/// ```
/// use throng_record::people::FigureStyle;
/// assert_eq!("baked".parse(), Ok(FigureStyle::Baked));
/// assert!("ghosts".parse::<FigureStyle>().unwrap_err().contains("auto, skins, baked, none"));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FigureStyle {
    /// Skins, in recordings of at most [`MOST_SKINS`] agents and four hours, without flying agents. Otherwise plain
    /// bodies.
    #[default]
    Auto,
    /// A skeleton and a skin for each person.
    Skins,
    /// Poses in one buffer, for shaders that draw thousands of people.
    Baked,
    /// Plain bodies without joints.
    None,
}

impl FigureStyle {
    /// All styles.
    pub const ALL: [Self; 4] = [Self::Auto, Self::Skins, Self::Baked, Self::None];

    /// Returns the name of the style, as [`FromStr`] reads it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Skins => "skins",
            Self::Baked => "baked",
            Self::None => "none",
        }
    }
}

impl fmt::Display for FigureStyle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for FigureStyle {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = Self::ALL.into_iter().find(|style| style.name() == text);
        known.ok_or_else(|| format!("write one of {}", Self::ALL.map(Self::name).join(", ")))
    }
}
