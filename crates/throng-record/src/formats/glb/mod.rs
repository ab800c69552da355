//! Trajectories as binary [glTF 2.0](https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html), for engines and the
//! web.
//!
//! Lengths are metres. As in all glTF, y is up: the point (x, y, z) of the scene is (x, z, -y) of the file. In a body's
//! own space, +z points ahead, as in any glTF model.
//!
//! | node | what |
//! |---|---|
//! | `World` | stands at the origin of the scene |
//! | `Ground`, `Obstacles` | meshes; obstacles are 1 m high |
//! | `Agents/Agent_7` and so on | an agent by its number: the mesh of its group, scaled by its radius; `extras` hold its `number`, `group` (its name), `radius` (metres), and `from` and `to` (seconds): the times of its first and last sample |
//! | `Agents/Agent_7/Hips` and so on | the joints of a person: an agent on the ground with a radius of at most 0.5 m, in a file of at most 300 agents. Its node has no mesh, and its size is 1; `extras.build` is `woman`, `man` or `child`; with the body of a file, `extras.legs` holds the lengths of legs and feet in heights |
//! | `Body_7` | the mesh that the joints bend, in the root of the scene |
//!
//! The only animation moves and turns the agents. Its seconds count from the first frame. An agent has the scale 0
//! before its first and after its last sample; the scale steps at the frame in which the agent appears and at the first
//! frame without it. `asset.extras` holds the metadata of the scene ([`keys`](super::keys)) and `throng.times`: the
//! buffer view with the times of the frames as `f64`, seconds of the scene.
//!
//! Samples that linear interpolation restores are left out: at every frame, the interpolated position is within 1 mm of
//! the original along each axis, and the rotation within 0.4°. Where that saves nothing, all samples are written and
//! share their times. Rotations take 16 bits per number. Times within an animation are `f32`: after three hours they
//! are accurate to 1 ms, which is 1.5 mm of a walking agent. While a file is written, up to 110 bytes per agent and
//! frame wait beside it on disk, for a person up to 280. A file can have 4 GiB.
//!
//! Of files that throng wrote, every frame is read. Of files of other programs, every node that an animation moves is
//! read, at the times of the animation's samples.

mod baked;
mod baked_read;
mod bin;
pub(crate) mod character;
mod data;
mod figures;
mod json;
mod kept;
mod materials;
mod motion;
mod nodes;
mod part;
mod people;
#[cfg(test)]
mod people_tests;
mod read;
mod sampler;
pub(crate) mod set;
#[cfg(test)]
mod set_tests;
#[cfg(test)]
mod tests;
mod texture;
mod write;

pub use write::GlbWriter;

use super::Format;
use crate::people::FigureStyle;

/// glTF as one file: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "glb",
    title: "binary glTF 2.0",
    kept: false,
    sniff: None,
    columns: false,
    styles: &FigureStyle::ALL,
    create: Some(|output, setting, choice| Ok(Box::new(GlbWriter::new(output, setting)?.style(choice.figures)))),
    read: Some(read::read),
    figures: Some(figures::read),
};

/// The key of the buffer view with the times, in `asset.extras`.
const TIMES: &str = "throng.times";

/// Returns times as seconds since the first time, as the animation holds them: `f32` that strictly increase.
fn seconds(times: &[f64]) -> Vec<f32> {
    let mut seconds: Vec<f32> = Vec::with_capacity(times.len());
    for time in times {
        let since = (time - times[0]) as f32;
        let least = seconds.last().map_or(0.0, |last| last.next_up());
        seconds.push(since.max(least));
    }
    seconds
}
