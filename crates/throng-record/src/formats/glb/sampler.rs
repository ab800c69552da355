//! The values of an animation at a second.

use super::data::Data;
use super::json::{Node, Sampler};
use glam::{DVec3, Quat, Vec3};
use std::collections::BTreeSet;

/// The samplers of each node's properties.
pub struct Channels {
    /// By node: the samplers of its translation, its rotation and its scale.
    samplers: Vec<[Option<usize>; 3]>,
}

impl Channels {
    /// Reads the first animation. All its channels together read at most `most` numbers.
    ///
    /// # Errors
    /// The animation refers to a missing sampler or node, or reads more than `most` numbers.
    pub fn new(data: &Data, most: usize) -> Result<Self, String> {
        let mut samplers = vec![[None; 3]; data.root.nodes.len()];
        let Some(animation) = data.root.animations.first() else { return Ok(Self { samplers }) };
        let mut read = 0u64;
        for channel in &animation.channels {
            let sampler = animation.samplers.get(channel.sampler);
            let sampler = sampler.ok_or_else(|| format!("there is no sampler {}", channel.sampler))?;
            for at in [sampler.input, sampler.output] {
                read = read.saturating_add(data.root.accessors.get(at).map_or(0, |accessor| accessor.count));
            }
            let path = ["translation", "rotation", "scale"].iter().position(|path| *path == channel.target.path);
            if let (Some(path), Some(node)) = (path, channel.target.node) {
                let node = samplers.get_mut(node).ok_or_else(|| format!("there is no node {node}"))?;
                node[path] = Some(channel.sampler);
            }
        }
        if read > most as u64 {
            return Err("its animation reads the same numbers too often".to_owned());
        }
        Ok(Self { samplers })
    }

    /// Whether the animation changes the translation of a node.
    pub fn moves(&self, node: usize) -> bool {
        self.samplers[node][0].is_some()
    }

    /// Whether the animation changes any property of a node.
    pub fn changes(&self, node: usize) -> bool {
        self.samplers[node].iter().any(Option::is_some)
    }

    /// Returns all seconds of the samplers of some nodes, in order.
    ///
    /// # Errors
    /// The numbers are missing.
    pub fn seconds(&self, data: &Data, nodes: impl Iterator<Item = usize>) -> Result<Vec<f32>, String> {
        let samplers = nodes.flat_map(|node| self.samplers[node]).flatten();
        let inputs: BTreeSet<usize> = samplers.map(|sampler| data.root.animations[0].samplers[sampler].input).collect();
        // the bits of non-negative floats are ordered as the floats are
        let mut seconds = BTreeSet::new();
        for input in inputs {
            seconds.extend(times(data, input)?.into_iter().map(|time| (time + 0.0).to_bits()));
        }
        Ok(seconds.into_iter().map(f32::from_bits).collect())
    }

    /// Reads the values of a node.
    ///
    /// # Errors
    /// The numbers are missing, or their interpolation is not supported.
    pub fn of(&self, data: &Data, at: usize, node: &Node) -> Result<SampledNode, String> {
        let [translation, rotation, scale] = self.samplers[at];
        let sampler = |at: usize| &data.root.animations[0].samplers[at];
        Ok(SampledNode {
            rest: node.translation.map_or(DVec3::ZERO, DVec3::from),
            translation: translation.map(|at| Curve::of(data, sampler(at))).transpose()?,
            turn: node.rotation.map_or(Quat::IDENTITY, turn),
            rotation: rotation.map(|at| Curve::of(data, sampler(at))).transpose()?,
            scale: scale.map(|at| Curve::of(data, sampler(at))).transpose()?,
        })
    }
}

/// The values of a node over time.
pub struct SampledNode {
    rest: DVec3,
    translation: Option<Curve<3>>,
    turn: Quat,
    rotation: Option<Curve<4>>,
    scale: Option<Curve<3>>,
}

impl SampledNode {
    /// Returns the position within the parent node.
    pub fn translation(&self, second: f32) -> DVec3 {
        let Some(curve) = &self.translation else { return self.rest };
        let (from, to, part) = curve.at(second);
        DVec3::from(from.map(f64::from)).lerp(DVec3::from(to.map(f64::from)), part)
    }

    /// Returns the rotation within the parent node.
    pub fn rotation(&self, second: f32) -> Quat {
        let Some(curve) = &self.rotation else { return self.turn };
        let (from, to, part) = curve.at(second);
        turn(from).slerp(turn(to), part as f32)
    }

    /// Whether the node is visible: its scale is not 0.
    pub fn is_there(&self, second: f32) -> bool {
        self.scale.as_ref().is_none_or(|curve| {
            let (from, to, part) = curve.at(second);
            Vec3::from(from).lerp(Vec3::from(to), part as f32) != Vec3::ZERO
        })
    }

    /// Whether a second lies between the first and the last second of the node's samplers.
    pub fn covers(&self, second: f32) -> bool {
        let of = |curve: &Option<Curve<3>>| curve.as_ref().map(Curve::ends);
        let turns = self.rotation.as_ref().map(Curve::ends);
        let ends: Vec<_> = [of(&self.translation), turns, of(&self.scale)].into_iter().flatten().collect();
        ends.iter().any(|ends| ends[0] <= second) && ends.iter().any(|ends| second <= ends[1])
    }
}

/// Values over time.
struct Curve<const N: usize> {
    times: Vec<f32>,
    values: Vec<[f32; N]>,
    steps: bool,
}

impl<const N: usize> Curve<N> {
    fn of(data: &Data, sampler: &Sampler) -> Result<Self, String> {
        let steps = match sampler.interpolation.as_deref() {
            None | Some("LINEAR") => false,
            Some("STEP") => true,
            Some(other) => {
                return Err(format!(
                    "its animation interpolates by {other}, which is not supported; bake it to LINEAR"
                ));
            }
        };
        let (times, values) = (times(data, sampler.input)?, data.numbers(sampler.output)?);
        if times.is_empty() || times.len() != values.len() {
            return Err(format!("accessor {} has {} times for {} values", sampler.input, times.len(), values.len()));
        }
        Ok(Self { times, values, steps })
    }

    fn ends(&self) -> [f32; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    /// Returns the values before and after a second, and the fraction of the interval between them.
    fn at(&self, second: f32) -> ([f32; N], [f32; N], f64) {
        let behind = self.times.partition_point(|&time| time <= second);
        let before = behind.saturating_sub(1);
        let behind = behind.min(self.times.len() - 1);
        let (from, to) = (f64::from(self.times[before]), f64::from(self.times[behind]));
        let part = if self.steps || behind == before { 0.0 } else { (f64::from(second) - from) / (to - from) };
        (self.values[before], self.values[behind], part)
    }
}

/// Reads the seconds of a sampler.
fn times(data: &Data, at: usize) -> Result<Vec<f32>, String> {
    let times = data.numbers::<1>(at)?.into_flattened();
    let grow = times.first().is_none_or(|time| *time >= 0.0) && times.windows(2).all(|two| two[0] < two[1]);
    if grow { Ok(times) } else { Err(format!("the times of accessor {at} do not increase from 0")) }
}

/// Returns a unit rotation of a quaternion of any length.
fn turn(numbers: [f32; 4]) -> Quat {
    let turn = Quat::from_array(numbers);
    if turn.length_squared() > 1e-6 { turn.normalize() } else { Quat::IDENTITY }
}
