//! What exported files are for.

use crate::record::Format;
use std::path::Path;

/// A purpose of an exported file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Purpose {
    /// The purpose, with the kind of file.
    pub title: &'static str,
    /// The format.
    pub format: Format,
    /// The ending of the file name.
    pub ending: &'static str,
    /// What is in the file, and how to open it.
    pub says: &'static str,
}

const fn trajectories(title: &'static str, ending: &'static str, says: &'static str) -> Purpose {
    Purpose { title, format: Format::Trajectories, ending, says }
}

/// All purposes.
const PURPOSES: [Purpose; 10] = [
    Purpose {
        title: "film (.mp4)",
        format: Format::Video,
        ending: ".mp4",
        says: "The view as H.264 video, for players, slides and editing.",
    },
    Purpose {
        title: "animation (.gif)",
        format: Format::Gif,
        ending: ".gif",
        says: "The view as a picture that moves in a loop, for pages and messages.",
    },
    Purpose {
        title: "pictures (a folder of .png)",
        format: Format::Pictures,
        ending: "/",
        says: "A numbered picture of each moment, for compositing.",
    },
    trajectories(
        "Blender, or a game engine (.glb)",
        ".glb",
        "People with skeletons, skins and their motion, other agents as meshes, ground and obstacles. Blender: File, Import, \
         glTF 2.0. Godot, Unity and three.js open it as a scene. Beyond 300 people, poses are baked into one buffer.",
    ),
    trajectories(
        "Houdini, Maya, Omniverse (.usda)",
        ".usda",
        "A stage of OpenUSD: people as UsdSkel characters, ground and obstacles as meshes. Open it, or refer to it from \
         a layer of your own.",
    ),
    trajectories(
        "characters of your own (.bvh)",
        "-*.bvh",
        "A file for each person, with its number for *: its skeleton with its motion, to put on a rig in MotionBuilder, Maya \
         or Blender.",
    ),
    trajectories(
        "notebook (.parquet)",
        ".parquet",
        "A row for each agent and moment, with types and units: pandas.read_parquet, polars, DuckDB, throng_sim.open.",
    ),
    trajectories("table (.csv)", ".csv", "A row for each agent and moment, as text for spreadsheets and scripts."),
    trajectories(
        "JuPedSim and PedPy (.sqlite)",
        ".sqlite",
        "The database of JuPedSim, with the walkable area: pedpy.load_trajectory_from_jupedsim_sqlite, or jpsvis.",
    ),
    trajectories(
        "throng, to replay (.rec)",
        ".rec",
        "All states, small and exact: throng replay, throng convert, or drop it on the studio.",
    ),
];

/// Returns the purposes of the files that this platform writes.
pub fn purposes() -> impl Iterator<Item = Purpose> {
    let is_written = |purpose: &Purpose| {
        let name = format!("x{}", purpose.ending);
        Format::ALL.contains(&purpose.format) && Format::of(Path::new(&name)) == Ok(purpose.format)
    };
    PURPOSES.into_iter().filter(is_written)
}

/// Returns the purpose of a file of a format, by the ending of its name.
pub fn purpose_of(format: Format, file: &str) -> Option<Purpose> {
    let of_format = || purposes().filter(|purpose| purpose.format == format);
    of_format()
        .find(|purpose| file.ends_with(purpose.ending))
        .or_else(|| of_format().next().filter(|_| format != Format::Trajectories))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_purpose_has_a_format_that_is_written() {
        assert_eq!(purposes().count(), PURPOSES.len());
        for purpose in purposes() {
            assert_eq!(purpose_of(purpose.format, &format!("circle{}", purpose.ending)), Some(purpose));
        }
        assert_eq!(purpose_of(Format::Video, "film.webm").map(|purpose| purpose.title), Some("film (.mp4)"));
        assert_eq!(purpose_of(Format::Trajectories, "a.xyz"), None);
    }
}
