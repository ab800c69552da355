//! Reads people with all poses in one buffer.

use super::baked::{BAKED, Baked, BakedPerson, HIPS, TURNS};
use super::data::Data;
use crate::people::{Figure, Figures, axes};
use glam::{DQuat, DVec3, Quat, Vec3};
use throng_figure::{Build, JOINTS, Joint, Person, Placed, slerp};

/// Reads the people of a file with the key [`BAKED`]; `times` are those of its frames.
///
/// # Errors
/// The description is not valid, or names poses that are not in the file.
pub fn figures(data: &Data, times: &[f64], period: f64) -> Result<Figures, String> {
    let known = data.root.asset.extras.get(BAKED).cloned().unwrap_or_default();
    let baked: Baked = serde_json::from_value(known).map_err(|error| format!("{BAKED} is not valid: {error}"))?;
    if !baked.joints.iter().map(String::as_str).eq(Joint::ALL.iter().map(|joint| joint.name())) {
        return Err(format!("{BAKED} has other joints"));
    }
    let poses = [data.view(baked.hips)?.0, data.view(baked.rotations)?.0];
    let figure = |person: &BakedPerson| -> Result<Figure, String> {
        let missing = || format!("{BAKED} names no body of agent {}", person.number);
        let body = baked.bodies.get(person.body).ok_or_else(missing)?;
        let known = Person::new(0, u64::from(person.number));
        let (known, turns) = match &body.figure {
            None => {
                (known.with_build(Build::named(&body.build).ok_or_else(missing)?), &[[0.0, 0.0, 0.0, 1.0]; JOINTS][..])
            }
            Some(figure) => (Person { legs: (&figure.legs).into(), ..known }, &figure.turns[..]),
        };
        let known = known.with_height(person.height);
        let others = |_| format!("body {} of {BAKED} has other joints", person.body);
        let offsets = <[[f32; 3]; JOINTS]>::try_from(&body.offsets[..]).map_err(others)?;
        let offsets = offsets.map(|offset| axes::own_place(Vec3::from(offset).as_dvec3()) * person.height);
        let turns = <[[f32; 4]; JOINTS]>::try_from(turns).map_err(others)?;
        let turns = turns.map(|[x, y, z, w]| Quat::from_xyzw(z, x, y, w).as_dquat());
        let visit = |visit: &[u64; 3]| Visit::of(visit, times, poses);
        let visits: Option<Vec<Visit>> = person.visits.iter().map(visit).collect();
        let visits = visits.filter(|visits| !visits.is_empty());
        let visits = visits.ok_or_else(|| format!("{BAKED} names missing poses of agent {}", person.number))?;
        let last = &visits[visits.len() - 1].seconds;
        let seconds = [visits[0].seconds[0], last[last.len() - 1]];
        Ok(Figure::new((person.number, known, seconds), move |second| {
            let visit = visits.iter().rfind(|visit| visit.seconds[0] <= second)?;
            let joints = visit.joints(second, &offsets)?;
            let own = |joint: usize| joints[joint].rotation * turns[joint].conjugate();
            Some(std::array::from_fn(|joint| Placed { rotation: own(joint), ..joints[joint] }))
        }))
    };
    Ok(Figures { all: baked.people.iter().map(figure).collect::<Result<_, _>>()?, period })
}

/// Consecutive frames in which a person is there.
struct Visit {
    /// The seconds of the frames, at least one.
    seconds: Vec<f64>,
    hips: Vec<u8>,
    turns: Vec<u8>,
}

impl Visit {
    /// Reads a visit; `None` if it has no frame, or its frames or poses are not in the file.
    fn of(visit: &[u64; 3], times: &[f64], [hips, turns]: [&[u8]; 2]) -> Option<Self> {
        let [first, count, pose] = visit.map(|value| usize::try_from(value).ok());
        let (first, count, pose) = (first?, count?, pose?);
        let poses = |bytes: &[u8], size: usize| {
            let from = pose.checked_mul(size)?;
            bytes.get(from..from.checked_add(count.checked_mul(size)?)?).map(<[u8]>::to_vec)
        };
        let seconds = times.get(first..first.checked_add(count)?)?.iter().map(|time| time - times[0]).collect();
        (count > 0).then_some(Self { seconds, hips: poses(hips, HIPS)?, turns: poses(turns, TURNS)? })
    }

    /// Returns where the joints are at a second; `None` after the last frame.
    fn joints(&self, second: f64, offsets: &[DVec3; JOINTS]) -> Option<[Placed; JOINTS]> {
        let after = self.seconds.partition_point(|&at| at <= second);
        // the seconds of readers are singles
        if after == self.seconds.len() && second > self.seconds[after - 1] + 1e-3 {
            return None;
        }
        let (before, after) = (after.max(1) - 1, after.min(self.seconds.len() - 1));
        let whole = self.seconds[after] - self.seconds[before];
        let share = if whole > 0.0 { (second - self.seconds[before]) / whole } else { 0.0 };
        let hips = self.place(before).lerp(self.place(after), share);
        let turned = |k: usize| axes::body(slerp(self.turn(before, k), self.turn(after, k), share));
        let mut placed = [Placed { position: axes::place(hips), rotation: turned(0) }; JOINTS];
        for joint in &Joint::ALL[1..] {
            let above = placed[joint.parent().map_or(0, Joint::index)];
            placed[joint.index()] = Placed {
                position: above.position + above.rotation * offsets[joint.index()],
                rotation: turned(joint.index()),
            };
        }
        Some(placed)
    }

    fn place(&self, frame: usize) -> DVec3 {
        let bytes = &self.hips[HIPS * frame..][..HIPS];
        let part = |k: usize| f32::from_le_bytes([bytes[k], bytes[k + 1], bytes[k + 2], bytes[k + 3]]).into();
        DVec3::new(part(0), part(4), part(8))
    }

    fn turn(&self, frame: usize, joint: usize) -> DQuat {
        let bytes = &self.turns[TURNS * frame + 8 * joint..][..8];
        let part = |k: usize| f64::from(i16::from_le_bytes([bytes[k], bytes[k + 1]])) / f64::from(i16::MAX);
        let turn = DQuat::from_xyzw(part(0), part(2), part(4), part(6));
        if turn.length_squared() > 1e-6 { turn.normalize() } else { DQuat::IDENTITY }
    }
}
