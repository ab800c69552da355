//! Reads the joints of BVH.

use super::UNITS;
use super::euler::about;
use crate::formats::FormatFlaw;
use crate::people::{Figure, Figures, axes, fitted, legs_of};
use glam::{DQuat, DVec3};
use throng_figure::{JOINTS, Joint, Person, Placed};

const HINT: &str =
    "supported is BVH with the 19 joints that `throng run -o 'people/*.bvh'` writes: Hips, Spine and so on";
/// Greatest number of joints of a file.
const MOST: usize = 1000;

/// Reads the person of a file.
///
/// # Errors
/// The file is not BVH, is damaged, or lacks one of the joints.
pub(super) fn read(bytes: &[u8]) -> Result<Figures, FormatFlaw> {
    let text = String::from_utf8_lossy(bytes);
    let mut words = Words { text: &text, at: 0 };
    let parsed = words.file();
    let line = text.get(..words.at).map(|before| 1 + before.trim_end().matches('\n').count());
    parsed.map_err(|why| FormatFlaw { line, why, hint: Some(HINT) })
}

/// A joint of the file.
struct FileJoint {
    name: String,
    parent: Option<usize>,
    offset: DVec3,
    /// What each number of a frame changes, in order: an axis, and whether it rotates about it.
    channels: Vec<(DVec3, bool)>,
}

/// The motion of a file: joints, and the numbers of all frames.
struct Motion {
    joints: Vec<FileJoint>,
    /// The joints of the file that are those of [`Joint::ALL`].
    ours: [usize; JOINTS],
    frames: Vec<Vec<f64>>,
    period: f64,
}

/// The words of a text.
struct Words<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Words<'a> {
    /// Returns the next word; at the end of the text, an error.
    fn word(&mut self) -> Result<&'a str, String> {
        let rest = &self.text[self.at..];
        let start = rest.len() - rest.trim_start().len();
        let word = rest[start..].split_whitespace().next().ok_or("the file is cut off")?;
        self.at += start + word.len();
        Ok(word)
    }

    fn expect(&mut self, words: &str) -> Result<(), String> {
        words.split(' ').try_for_each(|want| match self.word()? {
            found if found == want => Ok(()),
            found => Err(format!("`{}` stands where `{want}` is expected", found.chars().take(40).collect::<String>())),
        })
    }

    fn number(&mut self) -> Result<f64, String> {
        let word = self.word()?;
        let number = word.parse().ok().filter(|value: &f64| value.abs() < 1e12);
        number.ok_or_else(|| format!("`{}` is no number", word.chars().take(40).collect::<String>()))
    }

    fn vector(&mut self) -> Result<DVec3, String> {
        Ok(DVec3::new(self.number()?, self.number()?, self.number()?))
    }

    fn file(&mut self) -> Result<Figures, String> {
        let joints = self.hierarchy()?;
        let find = |joint: Joint| {
            let at = joints.iter().position(|own| own.name.trim_start_matches("mixamorig:") == joint.name());
            at.ok_or_else(|| format!("there is no joint {}", joint.name()))
        };
        let mut ours = [0; JOINTS];
        for joint in Joint::ALL {
            ours[joint.index()] = find(joint)?;
        }
        self.expect("MOTION Frames:")?;
        let count = self.number()?;
        self.expect("Frame Time:")?;
        let period = self.number()?;
        let width: usize = joints.iter().map(|joint| joint.channels.len()).sum();
        // every number takes two bytes at least
        let most = (self.text.len() - self.at) / (2 * width.max(1)) + 1;
        if !(count >= 1.0 && count.fract() == 0.0 && period > 0.0 && period < 1e4) {
            return Err(format!("{count} frames, {period} s apart, are no motion"));
        }
        if count > most as f64 {
            return Err("the file is cut off: it has fewer frames than it states".to_owned());
        }
        let mut frame = || (0..width).map(|_| self.number()).collect::<Result<Vec<f64>, String>>();
        let frames: Vec<Vec<f64>> = (0..count as usize).map(|_| frame()).collect::<Result<_, _>>()?;
        let offsets = ours.map(|at| axes::own_place(joints[at].offset) / UNITS);
        let (build, height, alike) = fitted(&offsets);
        let mut person = Person::new(0, 0).with_build(build).with_height(height);
        let last = (frames.len() - 1) as f64 * period;
        let motion = Motion { joints, ours, frames, period };
        if !alike {
            // a foot that is flat on the ground has its ankle lowest
            let low = |joints: [Placed; JOINTS]| {
                joints[Joint::LeftFoot.index()].position.z.min(joints[Joint::RightFoot.index()].position.z)
            };
            let moments = (0..motion.frames.len()).map(|frame| low(motion.joints(frame as f64 * period)));
            person.legs = legs_of(&offsets, height, moments.fold(f64::INFINITY, f64::min));
        }
        let figure = Figure::new((0, person, [0.0, last]), move |second| Some(motion.joints(second)));
        Ok(Figures { all: vec![figure], period })
    }

    /// Reads the hierarchy. A parent is before its children.
    fn hierarchy(&mut self) -> Result<Vec<FileJoint>, String> {
        self.expect("HIERARCHY ROOT")?;
        let mut joints: Vec<FileJoint> = Vec::new();
        let mut open: Vec<usize> = Vec::new();
        loop {
            let name = self.word()?.to_owned();
            if joints.len() >= MOST {
                return Err(format!("the file has more than {MOST} joints"));
            }
            self.expect("{ OFFSET")?;
            let offset = self.vector()?;
            self.expect("CHANNELS")?;
            let count = self.number()?;
            if !(0.0..=6.0).contains(&count) {
                return Err(format!("a joint has 0 to 6 channels, not {count}"));
            }
            let channels = (0..count as usize).map(|_| channel(self.word()?)).collect::<Result<_, String>>()?;
            let parent = open.last().copied();
            open.push(joints.len());
            joints.push(FileJoint { name, parent, offset, channels });
            loop {
                match self.word()? {
                    "JOINT" => break,
                    "End" => {
                        self.expect("Site { OFFSET")?;
                        self.vector()?;
                        self.expect("}")?;
                    }
                    "}" => {
                        open.pop();
                        if open.is_empty() {
                            return Ok(joints);
                        }
                    }
                    other => {
                        let word: String = other.chars().take(40).collect();
                        return Err(format!("`{word}` stands where JOINT, End Site or }} is expected"));
                    }
                }
            }
        }
    }
}

/// Returns what a channel changes.
fn channel(name: &str) -> Result<(DVec3, bool), String> {
    let axis = match name.get(..1) {
        Some("X") => DVec3::X,
        Some("Y") => DVec3::Y,
        Some("Z") => DVec3::Z,
        _ => DVec3::ZERO,
    };
    match name.get(1..) {
        Some("position") if axis != DVec3::ZERO => Ok((axis, false)),
        Some("rotation") if axis != DVec3::ZERO => Ok((axis, true)),
        _ => Err(format!("`{}` is no channel", name.chars().take(40).collect::<String>())),
    }
}

impl Motion {
    /// Returns where the joints are at a second, in the axes of the scene. Between frames every number is interpolated
    /// linearly, as most programs do.
    fn joints(&self, second: f64) -> [Placed; JOINTS] {
        let at = (second / self.period).clamp(0.0, (self.frames.len() - 1) as f64);
        let (before, share) = (at as usize, at.fract());
        let after = (before + 1).min(self.frames.len() - 1);
        let mut numbers = self.frames[before].iter().zip(&self.frames[after]).map(|(a, b)| a + (b - a) * share);
        let mut placed: Vec<Placed> = Vec::with_capacity(self.joints.len());
        for joint in &self.joints {
            let (mut position, mut rotation) = (joint.offset, DQuat::IDENTITY);
            for (&(axis, turns), value) in joint.channels.iter().zip(&mut numbers) {
                if turns {
                    rotation *= about(axis, value.to_radians());
                } else {
                    position += axis * value;
                }
            }
            placed.push(match joint.parent.map(|parent| placed[parent]) {
                None => Placed { position, rotation },
                Some(parent) => Placed {
                    position: parent.position + parent.rotation * position,
                    rotation: parent.rotation * rotation,
                },
            });
        }
        self.ours.map(|at| {
            let Placed { position, rotation } = placed[at];
            Placed { position: axes::place(position) / UNITS, rotation: axes::body(rotation) }
        })
    }
}
