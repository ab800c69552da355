//! The metadata keys of formats that store metadata as pairs of texts.

/// Title of the scene.
pub const TITLE: &str = "throng.title";
/// The program and its version.
pub const PROGRAM: &str = "throng.program";
/// The units of the columns, in words.
pub const UNITS: &str = "throng.units";
/// Frames per second; missing if frames come at uneven times.
pub const RATE: &str = "throng.frame_rate";
/// The names of all groups, a JSON array of strings.
pub const GROUPS: &str = "throng.groups";
/// The walkable area, WKT; empty: everywhere outside obstacles.
pub const WALKABLE: &str = "throng.walkable";
/// The obstacles, WKT; a circle is a polygon of 64 corners.
pub const OBSTACLES: &str = "throng.obstacles";
/// `true` if some agents fly.
pub const IN_SPACE: &str = "throng.in_space";
