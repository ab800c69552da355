//! Reads the people of a stage: where their joints are.

use super::cursor::UsdaFlaw;
use super::layer::Prim;
use super::people::LEGS;
use super::read::{codes_per_second, on_line, stage};
use crate::formats::FormatFlaw;
use crate::people::{Figure, Figures};
use glam::{DQuat, DVec3};
use throng_figure::{Build, JOINTS, Joint, Legs, Person, Placed, slerp};

const HINT: &str =
    "figures are SkelRoots with the 19 joints that `throng run -o NAME.usda` writes: Hips, Spine and so on";

/// Reads the people of a stage.
///
/// # Errors
/// The file is not a stage, has no people, or they have other joints.
pub(super) fn read(bytes: &[u8]) -> Result<Figures, FormatFlaw> {
    parse(bytes).map_err(|flaw| on_line(bytes, flaw, HINT))
}

fn parse(bytes: &[u8]) -> Result<Figures, UsdaFlaw> {
    let stage = stage(bytes)?;
    let rate = codes_per_second(&stage)?;
    let mut found = Vec::new();
    walkers(&stage, &mut found);
    if found.is_empty() {
        return Err((0, "the file has no SkelRoot with a SkelAnimation".to_owned()));
    }
    let people = found.into_iter().map(|(root, walk)| UsdaPerson::of(root, walk, rate));
    let people = people.collect::<Result<Vec<_>, UsdaFlaw>>()?;
    let longest = people.iter().map(|person| &person.rotations).max_by_key(|samples| samples.len());
    let span = longest.and_then(|samples| Some((samples.first()?.0, samples.last()?.0, samples.len())));
    let period = span.map_or(1.0, |(first, last, count)| (last - first) / (count.max(2) - 1) as f64);
    let all = people.into_iter().map(UsdaPerson::figure).collect();
    Ok(Figures { all, period: if period > 0.0 { period } else { 1.0 / rate } })
}

/// Finds the roots of skeletons that have an animation with samples.
fn walkers<'p, 'a>(prim: &'p Prim<'a>, found: &mut Vec<(&'p Prim<'a>, &'p Prim<'a>)>) {
    for child in &prim.children {
        let moves = |walk: &&Prim| walk.attribute("rotations").is_some_and(|own| !own.samples.is_empty());
        let walk = child.children.iter().filter(|own| own.kind == "SkelAnimation").find(moves);
        match walk.filter(|_| child.kind == "SkelRoot") {
            Some(walk) => found.push((child, walk)),
            None => walkers(child, found),
        }
    }
}

/// Values at seconds, in order.
type Samples<T> = Vec<(f64, T)>;

/// A person of a stage.
struct UsdaPerson {
    number: u32,
    person: Person,
    /// Whether it is visible, from each second on.
    visible: Samples<bool>,
    places: Samples<DVec3>,
    turns: Samples<DQuat>,
    /// The joints in the order of [`Joint::ALL`].
    rotations: Samples<[DQuat; JOINTS]>,
    /// Metres.
    offsets: [DVec3; JOINTS],
}

impl UsdaPerson {
    fn of(root: &Prim, walk: &Prim, rate: f64) -> Result<Self, UsdaFlaw> {
        let lacks = |what: &str| (0, format!("the SkelRoot {} has no {what}", root.name));
        let number = root.value("throng:number").ok_or_else(|| lacks("throng:number"))?.whole()?;
        let number = *number.first().ok_or_else(|| lacks("throng:number"))?;
        let build = root.value("throng:build").and_then(|build| Build::named(build.texts().first()?));
        let build = build.ok_or_else(|| lacks("throng:build of woman, man or child"))?;
        let height = root.value("throng:height").ok_or_else(|| lacks("throng:height"))?.number()?;
        let mut person = Person::new(0, u64::from(number)).with_build(build).with_height(height);
        if let Some(legs) = root.value(LEGS) {
            let lengths = legs.numbers(1)?.try_into();
            person.legs = Legs::of_lengths(lengths.map_err(|_| (legs.at, "legs have 8 lengths".to_owned()))?);
        }
        let named = walk.value("joints").ok_or_else(|| lacks("joints"))?.texts();
        let find = |joint: &Joint| {
            let at = named.iter().position(|path| path.rsplit('/').next() == Some(joint.name()));
            at.ok_or_else(|| lacks(&format!("joint {}", joint.name())))
        };
        let order: Vec<usize> = Joint::ALL.iter().map(find).collect::<Result<_, _>>()?;
        let translations = walk.value("translations").ok_or_else(|| lacks("translations"))?;
        let (at, numbers) = (translations.at, translations.numbers(3)?);
        if numbers.len() != 3 * named.len() {
            return Err((at, format!("{} translations stand for {} joints", numbers.len() / 3, named.len())));
        }
        let offset = |&joint: &usize| DVec3::from_slice(&numbers[3 * joint..]) * height;
        let offsets: Vec<DVec3> = order.iter().map(offset).collect();
        let lists = |prim: &Prim, name: &str, width: usize| -> Result<Samples<Vec<f64>>, UsdaFlaw> {
            let samples = prim.attribute(name).map(|own| own.samples.as_slice()).unwrap_or_default();
            let all = samples.iter().map(|(code, part)| match part.numbers(1)? {
                numbers if numbers.len() == width => Ok((code / rate, numbers)),
                numbers => Err((part.at, format!("there are {} numbers where {width} are expected", numbers.len()))),
            });
            let all: Samples<Vec<f64>> = all.collect::<Result<_, _>>()?;
            if all.is_empty() { Err(lacks(&format!("samples of {name}"))) } else { Ok(all) }
        };
        let rotations = lists(walk, "rotations", 4 * named.len())?
            .into_iter()
            .map(|(second, numbers)| (second, std::array::from_fn(|joint| quaternion(&numbers[4 * order[joint]..]))));
        let places = lists(root, "xformOp:translate", 3)?;
        let turns = lists(root, "xformOp:orient", 4)?;
        let visible = root.attribute("visibility").map(|own| own.samples.as_slice()).unwrap_or_default();
        Ok(Self {
            number,
            person,
            visible: visible.iter().map(|(code, part)| (code / rate, part.text != "\"invisible\"")).collect(),
            places: places.into_iter().map(|(second, at)| (second, DVec3::from_slice(&at))).collect(),
            turns: turns.into_iter().map(|(second, at)| (second, quaternion(&at))).collect(),
            rotations: rotations.collect(),
            offsets: std::array::from_fn(|joint| offsets[joint]),
        })
    }

    fn figure(self) -> Figure {
        let seconds = [self.rotations[0].0, self.rotations[self.rotations.len() - 1].0];
        Figure::new((self.number, self.person, seconds), move |second| self.joints(second))
    }

    /// Returns where the joints are at a second; `None` while the person is invisible.
    fn joints(&self, second: f64) -> Option<[Placed; JOINTS]> {
        let shown = self.visible.partition_point(|&(from, _)| from <= second);
        if self.visible.get(shown.wrapping_sub(1)).is_some_and(|&(_, there)| !there) {
            return None;
        }
        let (from, to, share) = between(&self.places, second);
        let base = from.lerp(*to, share);
        let (from, to, share) = between(&self.turns, second);
        let turn = slerp(*from, *to, share);
        let (from, to, share) = between(&self.rotations, second);
        let mut placed = [Placed { position: base, rotation: turn }; JOINTS];
        for joint in Joint::ALL {
            let k = joint.index();
            let above =
                joint.parent().map_or(Placed { position: base, rotation: turn }, |parent| placed[parent.index()]);
            placed[k] = Placed {
                position: above.position + above.rotation * self.offsets[k],
                rotation: above.rotation * slerp(from[k], to[k], share),
            };
        }
        Some(placed)
    }
}

/// Returns the values before and after a second, and the share of the way between them.
fn between<T>(samples: &Samples<T>, second: f64) -> (&T, &T, f64) {
    let behind = samples.partition_point(|&(at, _)| at <= second);
    let (before, behind) = (&samples[behind.max(1) - 1], &samples[behind.min(samples.len() - 1)]);
    let whole = behind.0 - before.0;
    (&before.1, &behind.1, if whole > 0.0 { ((second - before.0) / whole).clamp(0.0, 1.0) } else { 0.0 })
}

/// Returns a rotation of four numbers, the real part first.
fn quaternion(numbers: &[f64]) -> DQuat {
    let turn = DQuat::from_xyzw(numbers[1], numbers[2], numbers[3], numbers[0]);
    if turn.length_squared() > 1e-6 { turn.normalize() } else { DQuat::IDENTITY }
}
