//! Writes BVH.

use super::UNITS;
use super::euler::Order;
use crate::formats::Writer;
use crate::formats::by_agent::by_agent;
use crate::formats::spill::{Spill, beside};
use crate::people::{FigureStyle, People, axes};
use crate::{Frame, Output, OutputError, Setting};
use glam::{DVec2, DVec3};
use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use throng_figure::{JOINTS, Joint, Skeleton, Walk};

/// Frames per second of a recording with a single moment.
const RATE: f64 = 25.0;

/// Collects trajectories during a run and writes the files at the end. The [module](super) describes them.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("*.bvh");
/// use throng::{Agent, Settings, World};
/// use throng_record::formats::bvh::BvhWriter;
/// use throng_record::{Frame, Output, Setting, Writer};
/// let mut world = World::new(Settings::default())?;
/// world.add_agent(Agent::at([0.0, 0.0]))?;
/// let frame = Frame::of(&world);
/// let mut writer = BvhWriter::new(Output::create(&path)?, &Setting::default())?;
/// writer.push(&frame)?;
/// Box::new(writer).finish()?;
/// let name = format!("{}.bvh", frame.bodies[0].number);
/// assert!(std::fs::read_to_string(folder.path().join(name))?.starts_with("HIERARCHY\nROOT Hips\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct BvhWriter {
    output: Output,
    setting: Setting,
    spill: Spill,
}

impl BvhWriter {
    /// Starts to collect.
    ///
    /// # Errors
    /// The name has no `*`, agents fly, or a system error, such as a full disk.
    pub fn new(output: Output, setting: &Setting) -> Result<Self, OutputError> {
        if name(output.path(), 0).is_none() {
            return Err(OutputError::OnePerson { path: output.path().to_path_buf() });
        }
        if setting.in_space {
            let why = "the agents of this scene fly, and .bvh files hold people on foot; write another format";
            return Err(output.error(io::Error::other(why)));
        }
        let spill = Spill::new(&output, setting)?;
        Ok(Self { output, setting: setting.clone(), spill })
    }

    fn write(mut self) -> Result<(), OutputError> {
        let (origin, output) = (self.setting.origin, &self.output);
        let people = People::of(FigureStyle::Skins, &self.setting, &mut self.spill, output);
        let people = people.map_err(|error| output.error(error))?.with_characters(&self.setting);
        let period = 1.0 / self.spill.rate.mean().unwrap_or(RATE);
        // an error of a person's file names that file
        let mut failed = None;
        let scratch = beside(output).map_err(|error| output.error(error))?;
        let all = by_agent(&mut self.spill, scratch, |agent, track| {
            let (Some(walk), Some(path)) = (people.walk(agent, track)?, name(output.path(), agent.number)) else {
                return Ok(());
            };
            let skeleton = people.body(agent, walk.person()).skeleton(walk.person().height);
            person(output, &path, (&walk, &skeleton), period, origin).map_err(|error| {
                failed = Some(error);
                io::Error::other("a person's file")
            })
        });
        failed.map_or_else(|| all.map_err(|error| output.error(error)), Err)
    }
}

impl Writer for BvhWriter {
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        self.spill.push(frame).map_err(|error| self.output.error(error))
    }

    fn finish(self: Box<Self>) -> Result<(), OutputError> {
        self.write()
    }
}

/// Returns the name of a person's file: the number in place of the last `*`; `None` if there is no `*`.
fn name(path: &Path, number: u32) -> Option<PathBuf> {
    let name = path.file_name()?.to_str()?;
    let (before, after) = name.rsplit_once('*')?;
    Some(path.with_file_name(format!("{before}{number}{after}")))
}

/// Writes the file of a person.
fn person(
    output: &Output,
    path: &Path,
    (walk, skeleton): (&Walk, &Skeleton),
    period: f64,
    origin: DVec2,
) -> Result<(), OutputError> {
    let mut file = output.another(path)?;
    let (from, to) = walk.span();
    let frames = libm::round((to - from) / period) as u64 + 1;
    let mut text = String::from("HIERARCHY\n");
    joint(&mut text, skeleton, Joint::Hips, 0);
    let _ = write!(text, "MOTION\nFrames: {frames}\nFrame Time: {period:.9}\n");
    file.put(text.as_bytes())?;
    let mut before = [[0.0; 3]; JOINTS];
    for frame in 0..frames {
        let pose = walk.pose(from + frame as f64 * period);
        text.clear();
        let hips = axes::exact_point(pose.hips + origin.extend(0.0)) * UNITS;
        hips.to_array().iter().for_each(|&value| number(&mut text, value));
        for joint in Joint::ALL {
            let at = joint.index();
            let rotation = pose.rotations[at];
            let turned = if joint == Joint::Hips { axes::exact_turn(rotation) } else { axes::own_turn(rotation) };
            before[at] = order(joint).angles(turned, before[at]);
            before[at].iter().for_each(|angle| number(&mut text, angle.to_degrees()));
        }
        text.push('\n');
        file.write_all(text.as_bytes()).map_err(|error| file.error(error))?;
    }
    file.finish()
}

/// Returns the order of the rotations of a joint. The middle angle of the hips is their pitch, that of the other joints
/// their twist: neither comes near a right angle in walking.
fn order(joint: Joint) -> Order {
    if joint == Joint::Hips { Order::Zxy } else { Order::Zyx }
}

/// Writes a number with four decimals, after a blank unless it is the first of its line.
fn number(text: &mut String, value: f64) {
    if !text.is_empty() {
        text.push(' ');
    }
    // no -0
    let _ = write!(text, "{:.4}", (value * 1e4).round() / 1e4 + 0.0);
}

/// Writes a joint and the joints below it.
fn joint(text: &mut String, skeleton: &Skeleton, at: Joint, depth: usize) {
    let indent = "\t".repeat(depth);
    let line = |offset: DVec3| {
        let mut line = String::new();
        axes::exact_own(offset * UNITS).to_array().iter().for_each(|&value| number(&mut line, value));
        line
    };
    let (kind, place, offset) = match at.parent() {
        None => ("ROOT", "6 Xposition Yposition Zposition", DVec3::ZERO),
        Some(_) => ("JOINT", "3", skeleton.offset(at)),
    };
    let (name, channels) = (at.name(), order(at).channels());
    let _ = write!(
        text,
        "{indent}{kind} {name}\n{indent}{{\n{indent}\tOFFSET {}\n{indent}\tCHANNELS {place} {channels}\n",
        line(offset)
    );
    let children = || Joint::ALL.into_iter().filter(|child| child.parent() == Some(at));
    children().for_each(|child| joint(text, skeleton, child, depth + 1));
    if children().next().is_none() {
        let tip = end(skeleton, at);
        let _ = write!(text, "{indent}\tEnd Site\n{indent}\t{{\n{indent}\t\tOFFSET {}\n{indent}\t}}\n", line(tip));
    }
    let _ = writeln!(text, "{indent}}}");
}

/// Returns where a bone without children ends, against its joint, metres.
fn end(skeleton: &Skeleton, at: Joint) -> DVec3 {
    let along = skeleton.offset(at);
    match at {
        Joint::Head => DVec3::Z * (2.0 * along.length()),
        Joint::LeftToeBase | Joint::RightToeBase => DVec3::X * (0.6 * along.x),
        _ => along * 0.5,
    }
}
