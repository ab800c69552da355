//! Behaviours of a single agent, or of an agent towards a target.

use super::super::limits::{Limit, check, check_some};
use super::{BehaviourContext, BuildBehaviour, angle, or};
use crate::file::{Path, Problem};
use crate::scene::steer::*;
use glam::{USizeVec3, Vec3};
use throng::steer::BoxedBehaviour;
use throng_steer::FollowFlow as Follow;

/// Default distance at which behaviours start to slow down, if the library has none, metres.
pub(super) const SLOWING_DISTANCE: f32 = 1.0;

impl BuildBehaviour for Flee {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::Flee::from(making.target(&self.target, &at.key("target"))?);
        Ok(throng_steer::Flee { panic_distance: or(self.panic_distance, standard.panic_distance), ..standard }.into())
    }
}

impl BuildBehaviour for Pursue {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let quarry = making.target(&self.quarry, &at.key("quarry"))?;
        Ok(throng_steer::Pursue { quarry, prediction: prediction(&self.prediction) }.into())
    }
}

impl BuildBehaviour for Evade {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::Evade::from(making.target(&self.menace, &at.key("menace"))?);
        let panic_distance = or(self.panic_distance, standard.panic_distance);
        Ok(throng_steer::Evade { prediction: prediction(&self.prediction), panic_distance, ..standard }.into())
    }
}

impl BuildBehaviour for OffsetPursuit {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let quarry = making.target(&self.quarry, &at.key("quarry"))?;
        let distance = self.distance as f32;
        Ok(throng_steer::OffsetPursuit { quarry, prediction: prediction(&self.prediction), distance }.into())
    }
}

impl BuildBehaviour for Shadow {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::Shadow {
            quarry: making.target(&self.quarry, &at.key("quarry"))?,
            distance: self.distance as f32,
            slowing_distance: or(self.slowing_distance, SLOWING_DISTANCE),
        }
        .into())
    }
}

impl BuildBehaviour for Interpose {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::Interpose {
            between: [making.target(&self.from, &at.key("from"))?, making.target(&self.to, &at.key("to"))?],
            ratio: or(self.ratio, 0.5),
            slowing_distance: or(self.slowing_distance, SLOWING_DISTANCE),
        }
        .into())
    }
}

impl BuildBehaviour for KeepStation {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::KeepStation {
            leader: making.target(&self.leader, &at.key("leader"))?,
            offset: Vec3::from_array(self.offset.0.map(|x| x as f32)),
            slowing_distance: or(self.slowing_distance, SLOWING_DISTANCE),
        }
        .into())
    }
}

impl BuildBehaviour for Dock {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let pitch = self.pitch.unwrap_or(0.0);
        check(&at.key("pitch"), pitch, Limit::Between(-90.0, 90.0))?;
        check_some(&at.key("time"), self.time, Limit::NotNegative)?;
        Ok(throng_steer::Dock {
            place: making.place(self.place, &at.key("place"))?,
            direction: direction(self.heading, pitch),
            speed: or(self.speed, 0.0),
            time: self.time,
        }
        .into())
    }
}

impl BuildBehaviour for Wander {
    fn make(&self, _: &BehaviourContext, _: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::Wander::default();
        let strength = or(self.strength, standard.strength);
        Ok(throng_steer::Wander { strength, rate: angle(self.rate, standard.rate) }.into())
    }
}

impl BuildBehaviour for FractalWander {
    fn make(&self, _: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        check_some(&at.key("angle"), self.angle, Limit::Between(0.0, 85.0))?;
        let standard = throng_steer::FractalWander::default();
        Ok(throng_steer::FractalWander { angle: angle(self.angle, standard.angle), noise: noise(&self.noise) }.into())
    }
}

impl BuildBehaviour for Explore {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let cells = [self.columns, self.rows, self.levels.unwrap_or(1)];
        for (key, cells) in ["columns", "rows", "levels"].into_iter().zip(cells) {
            check(&at.key(key), cells as f64, Limit::Between(1.0, 4096.0))?;
        }
        Ok(throng_steer::Explore {
            low: making.place(self.min, &at.key("min"))?,
            high: making.place(self.max, &at.key("max"))?,
            cells: USizeVec3::from_array(cells.map(|cells| cells as usize)),
        }
        .into())
    }
}

impl BuildBehaviour for Forage {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::Forage {
            food: making.target(&self.food, &at.key("food"))?,
            range: self.range as f32,
            wander: match &self.of {
                Some(steer) => making.branch(steer, &at.key("of"))?,
                None => throng_steer::Wander::default().into(),
            },
        }
        .into())
    }
}

impl BuildBehaviour for Face {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::Face { target: making.target(&self.target, &at.key("target"))? }.into())
    }
}

impl BuildBehaviour for MatchOrientation {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::MatchOrientation { with: making.target(&self.with, &at.key("with"))? }.into())
    }
}

impl BuildBehaviour for LookWhereYouGo {
    fn make(&self, _: &BehaviourContext, _: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::LookWhereYouGo.into())
    }
}

/// Default difference of directions from which on `head_for` uses all of the force: about 11 degrees.
const FULL: f32 = 0.2;

impl BuildBehaviour for HeadFor {
    fn make(&self, _: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        check_some(&at.key("pitch"), self.pitch, Limit::Between(-90.0, 90.0))?;
        let direction = direction(self.heading, self.pitch.unwrap_or(0.0));
        Ok(throng_steer::HeadFor { direction, full: or(self.full, FULL) }.into())
    }
}

impl BuildBehaviour for ConstantForce {
    fn make(&self, _: &BehaviourContext, _: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::ConstantForce(Vec3::from_array(self.0.0.map(|x| x as f32))).into())
    }
}

impl BuildBehaviour for Fear {
    fn make(&self, _: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        check(&at.key("fades"), self.fades, Limit::UpTo(600.0))?;
        Ok(throng_steer::Fear { range: self.range as f32, fades: self.fades as f32 }.into())
    }
}

impl BuildBehaviour for FollowFlow {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let field = making.flows.make(&self.flow, at.key("flow"), making.group)?.field;
        Ok(Follow { field, prediction: or(self.prediction, 0.0) }.into())
    }
}

impl BuildBehaviour for MoveForward {
    fn make(&self, _: &BehaviourContext, _: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::MoveForward { part: self.part as f32 }.into())
    }
}

impl BuildBehaviour for TargetSpeed {
    fn make(&self, _: &BehaviourContext, _: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::TargetSpeed { speed: self.speed as f32 }.into())
    }
}

impl BuildBehaviour for Tether {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::Tether { to: making.target(&self.to, &at.key("to"))?, length: self.length as f32 }.into())
    }
}

/// Returns the direction of a heading and a pitch in degrees.
fn direction(heading: f64, pitch: f64) -> Vec3 {
    let (sin, cos) = libm::sincosf(heading.to_radians() as f32);
    let (up, level) = libm::sincosf(pitch.to_radians() as f32);
    Vec3::new(cos * level, sin * level, up)
}

fn prediction(said: &Option<Prediction>) -> throng_steer::Prediction {
    match said {
        None | Some(Prediction::Cases(Cases { most: None })) => throng_steer::Prediction::default(),
        Some(Prediction::Constant(seconds)) => throng_steer::Prediction::Constant(*seconds as f32),
        Some(Prediction::Distance(ByDistance { per_metre, most })) => {
            throng_steer::Prediction::Distance { per_metre: *per_metre as f32, most: *most as f32 }
        }
        Some(Prediction::Cases(Cases { most: Some(most) })) => throng_steer::Prediction::Cases { most: *most as f32 },
    }
}

pub(super) fn noise(said: &Option<Noise>) -> throng_steer::Noise {
    let standard = throng_steer::Noise::default();
    let Some(said) = said else { return standard };
    throng_steer::Noise {
        period: or(said.period, standard.period),
        octaves: said.octaves.unwrap_or(standard.octaves),
        gain: or(said.gain, standard.gain),
        turbulent: said.turbulent.unwrap_or(standard.turbulent),
    }
}
