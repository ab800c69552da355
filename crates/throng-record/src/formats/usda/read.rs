//! Reads USD.

use super::cursor::{TextPart, UsdaFlaw};
use super::layer::{self, Prim};
use super::{CODES, TIMES};
use crate::formats::names::Names;
use crate::formats::{FormatFlaw, Reading, describe, keys};
use crate::trajectories::{RADIUS, Sample, Trajectories};
use glam::{DVec3, Quat, Vec3};
use throng::Status;

const HINT: &str = "supported is USD as text with a PointInstancer, as `throng run -o NAME.usda` writes it";

/// Reads a stage as throng writes it.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<Trajectories, FormatFlaw> {
    parse(bytes, reading).map_err(|flaw| on_line(bytes, flaw, HINT))
}

/// Returns the error of a file with its line.
pub(super) fn on_line(bytes: &[u8], (at, why): UsdaFlaw, hint: &'static str) -> FormatFlaw {
    let before = bytes.get(..at).unwrap_or(bytes);
    let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
    FormatFlaw { line: Some(line), why, hint: Some(hint) }
}

/// Parses a file.
pub(super) fn stage(bytes: &[u8]) -> Result<Prim<'_>, UsdaFlaw> {
    let text = std::str::from_utf8(bytes).map_err(|error| (error.valid_up_to(), "the file is not text".to_owned()))?;
    layer::parse(text)
}

fn parse(bytes: &[u8], reading: &Reading) -> Result<Trajectories, UsdaFlaw> {
    let stage = stage(bytes)?;
    let Some((path, agents)) = stage.children.iter().find_map(|prim| instancer(prim, Vec::new())) else {
        return Err((0, "there is no PointInstancer".to_owned()));
    };
    let mut names = Names::default();
    // the metadata of the scene are on the topmost prim
    let setting = describe::setting(|key| said(path[0], key), &mut names).map_err(|why| (0, why))?;
    let axes = Axes::of(&stage, &path, reading)?;
    let crowd = Crowd::of(agents, path[0], axes.unit, &mut names)?;
    let positions = agents.attribute("positions").filter(|positions| !positions.samples.is_empty());
    let positions = positions.ok_or((0, "the positions have no time samples".to_owned()))?;
    let times = times(path[0], &stage, positions.samples.iter().map(|&(code, _)| code).collect())?;
    let mut tracks = Trajectories { setting, ..Trajectories::default() };
    for (&(code, places), time) in positions.samples.iter().zip(times) {
        let moment = UsdaMoment::of(agents, code, places, crowd.numbers.len())?;
        let there = (0..crowd.numbers.len()).filter(|&k| moment.gone.binary_search(&crowd.numbers[k]).is_err());
        tracks.spots.extend(there.map(|k| {
            let (number, group, radius) = (crowd.numbers[k], crowd.groups[k], crowd.radii[k]);
            let ahead = moment.turn(k) * Vec3::X;
            Sample {
                number,
                group,
                time,
                place: axes.place(triple(&moment.places, k)),
                velocity: (moment.velocities.as_ref().map_or(DVec3::ZERO, |all| triple(all, k)) * axes.unit).as_vec3(),
                heading: ahead.y.atan2(ahead.x),
                radius,
                status: Status::Walking,
            }
        }));
    }
    tracks.setting.groups = names.into_names();
    tracks.sort();
    tracks.complete(agents.attribute("velocities").is_none(), agents.attribute("orientations").is_none());
    Ok(tracks)
}

/// Finds the first instancer within a prim. Returns the prims above it, and the instancer.
fn instancer<'p, 'a>(prim: &'p Prim<'a>, mut above: Vec<&'p Prim<'a>>) -> Option<(Vec<&'p Prim<'a>>, &'p Prim<'a>)> {
    above.push(prim);
    if prim.kind == "PointInstancer" {
        return Some((above, prim));
    }
    prim.children.iter().find_map(|child| instancer(child, above.clone()))
}

/// Returns the value of a prim's metadata key.
fn said(prim: &Prim, key: &str) -> Option<String> {
    let texts = prim.value(&key.replace('.', ":"))?.texts();
    if key == keys::GROUPS { serde_json::to_string(&texts).ok() } else { texts.into_iter().next() }
}

/// Returns the time codes of a second.
pub(super) fn codes_per_second(stage: &Prim) -> Result<f64, UsdaFlaw> {
    let rate = stage.value("timeCodesPerSecond").or_else(|| stage.value("framesPerSecond"));
    rate.map_or(Ok(CODES), |rate| rate.number().and_then(|value| positive(value, rate)))
}

/// Returns the times of the samples at time codes, seconds.
fn times(world: &Prim, stage: &Prim, codes: Vec<f64>) -> Result<Vec<f64>, UsdaFlaw> {
    let said = world.value(TIMES).map(|times| times.numbers(1)).transpose()?;
    if let Some(times) = said.filter(|times| times.len() == codes.len()) {
        return Ok(times);
    }
    let rate = codes_per_second(stage)?;
    Ok(codes.into_iter().map(|code| code / rate).collect())
}

fn positive(value: f64, of: TextPart) -> Result<f64, UsdaFlaw> {
    if value > 0.0 { Ok(value) } else { Err((of.at, format!("the value is {value}, but must be more than 0"))) }
}

fn triple(numbers: &[f64], k: usize) -> DVec3 {
    DVec3::from_slice(&numbers[3 * k..])
}

/// The origin and the unit of positions.
struct Axes {
    origin: DVec3,
    unit: f64,
}

impl Axes {
    fn of(stage: &Prim, path: &[&Prim], reading: &Reading) -> Result<Self, UsdaFlaw> {
        if let Some(axis) = stage.value("upAxis").filter(|axis| axis.texts() != ["Z"]) {
            return Err((axis.at, format!("{} is up, but only stages with z up are supported", axis.text)));
        }
        let unit =
            stage.value("metersPerUnit").map_or(Ok(0.01), |unit| unit.number().and_then(|v| positive(v, unit)))?;
        let mut origin = DVec3::ZERO;
        let moves =
            path.iter().flat_map(|prim| &prim.attributes).filter(|attribute| attribute.name.starts_with("xformOp:"));
        for attribute in moves {
            let value =
                attribute.value.filter(|_| attribute.name == "xformOp:translate" && attribute.samples.is_empty());
            let value =
                value.ok_or_else(|| (0, format!("{} is not supported, only constant translations", attribute.name)))?;
            match value.numbers(3)?[..] {
                [x, y, z] => origin += DVec3::new(x, y, z),
                _ => return Err((value.at, "the value is not three numbers".to_owned())),
            }
        }
        Ok(Self { origin, unit: reading.unit.unwrap_or(unit) })
    }

    fn place(&self, at: DVec3) -> DVec3 {
        (self.origin + at) * self.unit
    }
}

/// The constant properties of all agents.
struct Crowd {
    numbers: Vec<u32>,
    groups: Vec<u32>,
    /// Metres.
    radii: Vec<f32>,
}

impl Crowd {
    fn of(agents: &Prim, world: &Prim, unit: f64, names: &mut Names) -> Result<Self, UsdaFlaw> {
        let list = |name: &str| agents.value(name).map(|part| part.whole().map(|list| (part.at, list))).transpose();
        let (at, mut kinds) = list("protoIndices")?.ok_or((0, "there are no protoIndices".to_owned()))?;
        let (_, numbers) = list("ids")?.unwrap_or_else(|| (at, (0..kinds.len() as u32).collect()));
        let scales = agents.value("scales").map(|part| part.numbers(3)).transpose()?;
        let wide = |scales: Vec<f64>| scales.into_iter().step_by(3).map(|scale| (scale * unit) as f32).collect();
        let radii: Vec<f32> = scales.map_or_else(|| vec![RADIUS; kinds.len()], wide);
        if numbers.len() != kinds.len() || radii.len() != kinds.len() {
            let (ids, kinds, scales) = (numbers.len(), kinds.len(), radii.len());
            return Err((at, format!("there are {kinds} protoIndices, {ids} ids and {scales} scales")));
        }
        // the prototype of a person is not that of its group
        if let Some((_, groups)) = list("primvars:group")?.filter(|(_, groups)| groups.len() == kinds.len()) {
            kinds = groups;
        }
        let said = world.value(&keys::GROUPS.replace('.', ":")).map(|groups| groups.texts()).unwrap_or_default();
        let name = |kind: u32| said.get(kind as usize).filter(|name| !name.is_empty()).cloned();
        let groups = kinds.iter().map(|&kind| names.index(&name(kind).unwrap_or_else(|| kind.to_string()))).collect();
        Ok(Self { numbers, groups, radii })
    }
}

/// All agents at a frame.
struct UsdaMoment {
    places: Vec<f64>,
    velocities: Option<Vec<f64>>,
    turns: Option<Vec<f64>>,
    /// The numbers of invisible agents, in order.
    gone: Vec<u32>,
}

impl UsdaMoment {
    fn of(agents: &Prim, code: f64, places: TextPart, count: usize) -> Result<Self, UsdaFlaw> {
        let part = |name: &str| agents.attribute(name).and_then(|attribute| attribute.at(code));
        let lists = |part: TextPart, each: usize| match part.numbers(each)? {
            numbers if numbers.len() == each * count => Ok(numbers),
            numbers => {
                Err((part.at, format!("the list has {} values, but there are {count} ids", numbers.len() / each)))
            }
        };
        let mut gone = part("invisibleIds").map_or(Ok(Vec::new()), |gone| gone.whole())?;
        gone.sort_unstable();
        Ok(Self {
            places: lists(places, 3)?,
            velocities: part("velocities").map(|part| lists(part, 3)).transpose()?,
            turns: part("orientations").map(|part| lists(part, 4)).transpose()?,
            gone,
        })
    }

    /// Returns the rotation of an agent: USD writes the real part first.
    fn turn(&self, k: usize) -> Quat {
        let Some([w, x, y, z]) = self.turns.as_ref().and_then(|turns| turns[4 * k..].first_chunk()) else {
            return Quat::IDENTITY;
        };
        let turn = Quat::from_xyzw(*x as f32, *y as f32, *z as f32, *w as f32);
        if turn.length_squared() > 1e-6 { turn.normalize() } else { Quat::IDENTITY }
    }
}
