//! Trajectories as binary [glTF 2.0](https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html): for engines and the web.
//!
//! Lengths are metres, and y is up, as glTF wants it: the point (x, y, z) of the scene is (x, z, -y) of the file. What faces ahead in
//! a body's own space is +z, as of any model in glTF.
//!
//! | node | what |
//! |---|---|
//! | `World` | stands at the origin of the scene |
//! | `Ground`, `Obstacles` | meshes; what is solid is 1 m high |
//! | `Agents/Agent_7` and so on | an agent by its number: the mesh of its group, scaled by its radius; `extras` are its `number`, `group` (its name), `radius` (metres), and `from` and `to` (seconds): when it was there first and last |
//!
//! The one animation moves and turns the agents. Its seconds count from the first moment. Who has not come yet, or has gone, has the scale
//! 0: that steps at the moment in which it comes, and at the first without it. `asset.extras` has what there is to say of the scene
//! ([`keys`](super::keys)), and `throng.times`: the buffer view with the times of the moments as doubles, seconds of the scene.
//!
//! What going straight gives back is left out: a place is within 1 mm of what it was along each axis, and a rotation within 0.4°, at
//! every moment, where one goes straight (and turns evenly) from what is there to what is there. Where that saves nothing, all are there,
//! and share their times. Rotations are 16 bits a number.
//! Times within an animation are singles: after three hours they are good to 1 ms, which is 1.5 mm of somebody who walks.
//! While a file is made, up to 110 bytes an agent and moment wait beside it on the disk. A file can have 4 GiB.
//!
//! Read is what throng wrote, to every moment of it, and of files of others whatever node an animation moves along, at the moments
//! for which the animation says something.

mod axes;
mod bin;
mod by_agent;
mod data;
mod json;
mod kept;
mod motion;
mod read;
mod sampler;
#[cfg(test)]
mod tests;
mod write;

pub use write::GlbWriter;

use super::Format;

/// glTF as one file: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "glb",
    title: "binary glTF 2.0",
    kept: false,
    sniff: None,
    columns: false,
    create: Some(|output, setting, _| Ok(Box::new(GlbWriter::new(output, setting)?))),
    read: Some(read::read),
};

/// The key of the buffer view with the times, in `asset.extras`.
const TIMES: &str = "throng.times";

/// Moments in seconds since the first, as the animation has them: singles that grow.
fn seconds(times: &[f64]) -> Vec<f32> {
    let mut seconds: Vec<f32> = Vec::with_capacity(times.len());
    for time in times {
        let since = (time - times[0]) as f32;
        let least = seconds.last().map_or(0.0, |last| last.next_up());
        seconds.push(since.max(least));
    }
    seconds
}
