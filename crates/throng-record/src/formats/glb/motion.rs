//! Trajectories as an animation.

use super::bin::Bin;
use super::json::{Animation, Channel, Node, Sampler, Target};
use super::kept::kept;
use crate::formats::spill::{SpilledAgent, SpilledState};
use crate::people::axes;
use glam::{DVec3, Quat, Vec3};
use std::collections::BTreeMap;
use std::io;
use throng_figure::slerp;

/// Greatest error of a position along each axis, metres.
const PLACE: f64 = 1e-3;
/// Greatest error of a rotation about each axis, radians.
const TURN: f64 = 3.5e-3;
/// Greatest rotation between two written samples with others between them, radians. Blender interpolates the numbers of a
/// rotation, not its angle: up to this rotation that makes a difference of 5e-4 rad.
const REACH: f64 = 0.5;

/// An animation under construction.
#[derive(Debug)]
pub struct GlbMotion<'a> {
    /// The seconds of the frames.
    seconds: &'a [f32],
    /// Accessors of runs of consecutive frames, by the first frame and the number of frames.
    runs: BTreeMap<(usize, usize), usize>,
    animation: Animation,
}

impl<'a> GlbMotion<'a> {
    /// Starts an animation of frames at `seconds`.
    pub fn new(seconds: &'a [f32]) -> Self {
        Self { seconds, runs: BTreeMap::new(), animation: Animation::default() }
    }

    /// Writes the shared seconds, if any.
    ///
    /// # Errors
    /// A system error, or the file becomes too large.
    pub fn finish(self, bin: &mut Bin) -> io::Result<Animation> {
        if !self.runs.is_empty() {
            let view = bin.view(None)?;
            bin.put(self.seconds.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<_>>().as_slice())?;
            self.runs.into_values().for_each(|at| bin.accessors[at].buffer_view = Some(view));
        }
        Ok(self.animation)
    }

    /// Returns the frames in which an agent is there.
    pub fn visit(&self, track: &[(u32, SpilledState)]) -> Visit {
        let moments: Vec<usize> = track.iter().map(|&(moment, _)| moment as usize).collect();
        let seconds = moments.iter().map(|&moment| f64::from(self.seconds[moment])).collect();
        Visit { moments, seconds }
    }

    /// Adds an agent: sets its node to its first position and adds the channels that move it. `at` is the index of the
    /// node, `scale` its size. Returns the positions and rotations as readers restore them, at each frame of the visit.
    ///
    /// # Errors
    /// A system error, or the file becomes too large.
    pub fn agent(
        &mut self,
        bin: &mut Bin,
        (at, node): (usize, &mut Node),
        scale: Vec3,
        (agent, track, visit): (&SpilledAgent, &[(u32, SpilledState)], &Visit),
    ) -> io::Result<(Vec<Vec3>, Vec<Quat>)> {
        let points: Vec<Vec3> = track.iter().map(|(_, state)| axes::point(state.place)).collect();
        let turns: Vec<Quat> = track.iter().map(|(_, state)| axes::turn(state.rotation)).collect();
        let rest = (axes::point(agent.first.place).as_dvec3() * 1e4).round() / 1e4;
        node.translation = Some(rest.to_array());
        let points = self.translate(bin, (at, rest), visit, points, PLACE)?;
        let rest = axes::turn(agent.first.rotation);
        node.rotation = Some(rest.to_array());
        let turns = self.rotate(bin, (at, rest), visit, turns, TURN)?;
        node.scale = Some(scale.to_array());
        let (changes, sizes) = self.presence(&visit.moments, scale);
        if changes.len() > 1 {
            let values = bin.vectors(&sizes, false)?;
            self.channel(bin, (at, "scale"), changes, values, Some("STEP"))?;
        }
        Ok((points, turns))
    }

    /// Adds a channel that moves a node through these points, unless it stays at its position `rest`. Positions between
    /// written samples are within `error` along each axis, metres. Returns the points as readers restore them.
    ///
    /// # Errors
    /// A system error, or the file becomes too large.
    pub fn translate(
        &mut self,
        bin: &mut Bin,
        (node, rest): (usize, DVec3),
        visit: &Visit,
        points: Vec<Vec3>,
        error: f64,
    ) -> io::Result<Vec<Vec3>> {
        if !points.iter().any(|point| (point.as_dvec3() - rest).abs().max_element() > error) {
            return Ok(vec![rest.as_vec3(); points.len()]);
        }
        let way = |from: usize, to: usize| points[to].as_dvec3() - points[from].as_dvec3();
        let kept = self.cheaper(&visit.moments, 12, kept(&visit.seconds, error, f64::INFINITY, way));
        let values: Vec<Vec3> = kept.iter().map(|&k| points[k]).collect();
        let values = bin.vectors(&values, false)?;
        self.channel(bin, (node, "translation"), kept.iter().map(|&k| visit.moments[k]).collect(), values, None)?;
        Ok(visit.restored(&kept, |from, to, part| points[from].lerp(points[to], part as f32)))
    }

    /// Adds a channel that turns a node, unless it keeps its rotation `rest`. Rotations between written samples are within
    /// `error` about each axis, radians. Returns the rotations as readers restore them.
    ///
    /// # Errors
    /// A system error, or the file becomes too large.
    pub fn rotate(
        &mut self,
        bin: &mut Bin,
        (node, rest): (usize, Quat),
        visit: &Visit,
        mut turns: Vec<Quat>,
        error: f64,
    ) -> io::Result<Vec<Quat>> {
        // each with the sign closer to the one before, so that interpolation takes the shorter way
        for k in 1..turns.len() {
            turns[k] = if turns[k - 1].dot(turns[k]) < 0.0 { -turns[k] } else { turns[k] };
        }
        let angles = |from: Quat, to: Quat| (from.conjugate() * to).to_scaled_axis().as_dvec3();
        if !turns.iter().any(|&turn| angles(rest, turn).abs().max_element() > error) {
            return Ok(vec![rest; turns.len()]);
        }
        let way = |from: usize, to: usize| angles(turns[from], turns[to]);
        let kept = self.cheaper(&visit.moments, 8, kept(&visit.seconds, error, REACH, way));
        let values: Vec<Quat> = kept.iter().map(|&k| turns[k]).collect();
        let values = bin.turns(&values)?;
        self.channel(bin, (node, "rotation"), kept.iter().map(|&k| visit.moments[k]).collect(), values, None)?;
        // the same bits on every machine
        let mix = |from: usize, to: usize, part| slerp(turns[from].as_dquat(), turns[to].as_dquat(), part).as_quat();
        Ok(visit.restored(&kept, mix))
    }

    /// Returns the samples to write, of `size` bytes each: the needed samples with their own times, or all samples with
    /// shared times if that is no larger.
    fn cheaper(&self, moments: &[usize], size: usize, needed: Vec<usize>) -> Vec<usize> {
        let less = needed.len() * (size + 4) < moments.len() * size;
        if less || !is_run(moments) { needed } else { (0..moments.len()).collect() }
    }

    /// Returns the frames at which an agent appears or disappears, the first frame included, and its scale from each of
    /// them on.
    fn presence(&self, moments: &[usize], scale: Vec3) -> (Vec<usize>, Vec<Vec3>) {
        let mut changes = vec![(0, Vec3::ZERO)];
        for run in moments.chunk_by(|a, b| a + 1 == *b) {
            changes.extend([(run[0], scale), (run[0] + run.len(), Vec3::ZERO)]);
        }
        changes.retain(|&(moment, _)| moment < self.seconds.len());
        // an agent that is present from the start does not appear
        let from = usize::from(changes.get(1).is_some_and(|&(moment, _)| moment == 0));
        changes.drain(from..).unzip()
    }

    /// Adds a channel that changes a property of a node at some frames.
    fn channel(
        &mut self,
        bin: &mut Bin,
        (node, path): (usize, &'static str),
        moments: Vec<usize>,
        output: usize,
        interpolation: Option<&'static str>,
    ) -> io::Result<()> {
        let input = self.times(bin, &moments)?;
        let Animation { channels, samplers } = &mut self.animation;
        channels.push(Channel { sampler: samplers.len(), target: Target { node: Some(node), path: path.into() } });
        samplers.push(Sampler { input, output, interpolation: interpolation.map(Into::into) });
        Ok(())
    }

    /// Returns the accessor of the times of some frames.
    fn times(&mut self, bin: &mut Bin, moments: &[usize]) -> io::Result<usize> {
        if !is_run(moments) {
            let seconds: Vec<f32> = moments.iter().map(|&moment| self.seconds[moment]).collect();
            return bin.times(&seconds);
        }
        let (from, count) = (moments[0], moments.len());
        let some = &self.seconds[from..from + count];
        Ok(*self.runs.entry((from, count)).or_insert_with(|| bin.times_of(from, some)))
    }
}

/// Whether frames are consecutive.
fn is_run(moments: &[usize]) -> bool {
    moments.windows(2).all(|two| two[0] + 1 == two[1])
}

/// The frames in which an agent is there.
#[derive(Debug)]
pub struct Visit {
    /// The indices of the frames.
    pub moments: Vec<usize>,
    /// Their seconds.
    pub seconds: Vec<f64>,
}

impl Visit {
    /// Returns the values at all frames, interpolated between the frames that are kept: `mix` gets the kept frames before
    /// and after, and the part of the way between them.
    fn restored<T>(&self, kept: &[usize], mix: impl Fn(usize, usize, f64) -> T) -> Vec<T> {
        let mut next = 0;
        let value = |k: usize| {
            while next + 1 < kept.len() && kept[next + 1] <= k {
                next += 1;
            }
            let (from, to) = (kept[next], kept[(next + 1).min(kept.len() - 1)]);
            let whole = self.seconds[to] - self.seconds[from];
            mix(from, to, if whole > 0.0 { (self.seconds[k] - self.seconds[from]) / whole } else { 0.0 })
        };
        (0..self.seconds.len()).map(value).collect()
    }
}
