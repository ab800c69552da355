//! What is said of a file in its metadata, by name and text, where a kind of file has room for that.

/// Title of the scene.
pub const TITLE: &str = "throng.title";
/// The program and its version.
pub const PROGRAM: &str = "throng.program";
/// The units of the columns, in words.
pub const UNITS: &str = "throng.units";
/// Moments a second; missing where they do not come evenly.
pub const RATE: &str = "throng.frame_rate";
/// The names of all groups, a JSON array of strings.
pub const GROUPS: &str = "throng.groups";
/// What can be walked on, WKT; empty: everywhere but on obstacles.
pub const WALKABLE: &str = "throng.walkable";
/// What is solid, WKT; a circle is a polygon of 64 corners.
pub const OBSTACLES: &str = "throng.obstacles";
/// `true` if somebody flies.
pub const IN_SPACE: &str = "throng.in_space";
