//! Combinations of behaviours, and modifiers of a behaviour.

use super::super::limits::{Limit, check, check_some};
use super::super::rules::no_figure;
use super::single::noise;
use super::{BehaviourContext, BuildBehaviour, angle, or};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::registry::Steer;
use crate::scene::steer::*;
use throng::steer::BoxedBehaviour;
use throng_steer::Neighbourhood;

/// Default time for which a draw of dithering holds, seconds.
const HOLDS: f32 = 0.1;
/// Default deviation of direction (radians) and speed (a part): looks natural.
const WAVERING: (f32, f32) = (0.175, 0.08);

impl BehaviourContext<'_> {
    fn branches(&self, parts: &[Steer], at: &Path) -> Result<Vec<BoxedBehaviour>, Problem> {
        parts.iter().enumerate().map(|(i, part)| self.branch(part, &at.index(i))).collect()
    }

    fn weighted(&self, parts: &[Weighted], at: &Path) -> Result<Vec<(f32, BoxedBehaviour)>, Problem> {
        let one = |(i, part): (usize, &Weighted)| {
            check_some(&at.index(i).key("weight"), part.weight, Limit::NotNegative)?;
            Ok((or(part.weight, 1.0), self.branch(&part.of, &at.index(i).key("of"))?))
        };
        parts.iter().enumerate().map(one).collect()
    }

    fn condition(&self, condition: &Condition, at: &Path) -> Result<throng_steer::Condition, Problem> {
        let all = |conditions: &[Condition], at: &Path| -> Result<Vec<_>, Problem> {
            conditions.iter().enumerate().map(|(i, one)| self.condition(one, &at.index(i))).collect()
        };
        let apart = |apart: &Apart, at: &Path| Ok((self.target(&apart.target, &at.key("target"))?, apart.than as f32));
        Ok(match condition {
            Condition::Nearer(than) => {
                let (target, than) = apart(than, &at.key("nearer"))?;
                throng_steer::Condition::Nearer(target, than)
            }
            Condition::Farther(than) => {
                let (target, than) = apart(than, &at.key("farther"))?;
                throng_steer::Condition::Farther(target, than)
            }
            Condition::After(seconds) => throng_steer::Condition::After(*seconds as f32),
            Condition::Crowded(Crowd { near, least }) => {
                let near = self.near(near, Neighbourhood::default(), &at.key("crowded.near"))?;
                throng_steer::Condition::Crowded(near, *least as usize)
            }
            Condition::Done(_) => throng_steer::Condition::Done,
            Condition::Chance(rate) => throng_steer::Condition::Chance(*rate as f32),
            Condition::Figure(counted) => self.counted(counted, &at.key("figure"))?,
            Condition::Not(condition) => {
                throng_steer::Condition::Not(self.condition(condition, &at.key("not"))?.into())
            }
            Condition::All(conditions) => throng_steer::Condition::All(all(conditions, &at.key("all"))?),
            Condition::Any(conditions) => throng_steer::Condition::Any(all(conditions, &at.key("any"))?),
        })
    }

    fn counted(
        &self,
        Counted { of, at_least, at_most }: &Counted,
        at: &Path,
    ) -> Result<throng_steer::Condition, Problem> {
        let index = self.figures.iter().position(|known| known == of);
        let index = index.ok_or_else(|| no_figure(self.scene, &at.key("of"), of, self.figures))?;
        let bounds = (at_least.unwrap_or(f64::NEG_INFINITY), at_most.unwrap_or(f64::INFINITY));
        Ok(throng_steer::Condition::Figure(index, bounds.0, bounds.1))
    }
}

impl BuildBehaviour for WeightedSum {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::WeightedSum(making.weighted(&self.0, at)?).into())
    }
}

impl BuildBehaviour for RunningSum {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::RunningSum(making.weighted(&self.0, at)?).into())
    }
}

impl BuildBehaviour for Priority {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let parts = making.branches(&self.of, &at.key("of"))?;
        Ok(throng_steer::Priority { epsilon: or(self.epsilon, 0.0), parts }.into())
    }
}

impl BuildBehaviour for Dithering {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let one = |(i, part): (usize, &Probable)| {
            let at = at.key("of").index(i);
            check_some(&at.key("probability"), part.probability, Limit::Between(0.0, 1.0))?;
            Ok((or(part.probability, 1.0), making.branch(&part.of, &at.key("of"))?))
        };
        let parts = self.of.iter().enumerate().map(one).collect::<Result<_, Problem>>()?;
        Ok(throng_steer::Dithering { every: or(self.every, HOLDS), parts }.into())
    }
}

impl BuildBehaviour for Allocation {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let parts = making.branches(&self.of, &at.key("of"))?;
        Ok(throng_steer::Allocation { budget: or(self.budget, 1.0), parts }.into())
    }
}

impl BuildBehaviour for ContextSteering {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::ContextSteering::new(making.weighted(&self.of, &at.key("of"))?);
        if let Some(directions) = self.directions {
            check(&at.key("directions"), directions as f64, Limit::Between(4.0, 64.0))?;
        }
        Ok(throng_steer::ContextSteering {
            directions: self.directions.map_or(standard.directions, |directions| directions as usize),
            horizon: or(self.horizon, standard.horizon),
            groups: making.groups(self.groups.as_ref(), &at.key("groups"))?,
            barriers: making.barriers(&self.obstacles, at)?,
            ..standard
        }
        .into())
    }
}

impl BuildBehaviour for Switch {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        // a switch starts in its first state
        let (first, others): (Vec<_>, Vec<_>) = self.states.iter().partition(|(name, _)| **name == self.first);
        let states: Vec<_> = first.into_iter().chain(others).collect();
        let names: Vec<&str> = states.iter().map(|(name, _)| name.as_str()).collect();
        let find = |name: &str, at: &Path| {
            names.iter().position(|known| *known == name).ok_or_else(|| {
                let problem = Problem::new(at, Kind::UnknownKey, format!("there is no state `{name}`"));
                match names[..] {
                    [] => problem.hint("add it: states.NAME = { of.wander = {} }"),
                    _ => problem.hint(format!("there is: {}", names.join(", "))),
                }
            })
        };
        find(&self.first, &at.key("first"))?;
        let mut made = vec![];
        for (name, state) in &states {
            let at = at.key("states").name(name);
            let mut exits = vec![];
            for (i, exit) in state.exits.iter().enumerate() {
                let at = at.key("exits").index(i);
                let condition = making.condition(&exit.when, &at.key("when"))?;
                condition.check().map_err(|error| super::refused(&at.key("when"), &error))?;
                exits.push((condition, find(&exit.to, &at.key("to"))?));
            }
            made.push(throng_steer::State { behaviour: making.branch(&state.of, &at.key("of"))?, exits });
        }
        Ok(throng_steer::Switch(made).into())
    }
}

impl BuildBehaviour for Amortised {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let of = making.branch(&self.of, &at.key("of"))?;
        Ok(throng_steer::Amortised { every: self.every as f32, of }.into())
    }
}

impl BuildBehaviour for Hold {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let of = making.branch(&self.of, &at.key("of"))?;
        Ok(throng_steer::Hold { seconds: self.seconds as f32, of }.into())
    }
}

impl BuildBehaviour for Irregular {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        check_some(&at.key("angle"), self.angle, Limit::Between(0.0, 85.0))?;
        let (most, part) = WAVERING;
        Ok(throng_steer::Irregular {
            angle: angle(self.angle, most),
            speed: or(self.speed, part),
            noise: noise(&self.noise),
            of: making.branch(&self.of, &at.key("of"))?,
        }
        .into())
    }
}

impl BuildBehaviour for Limited {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::Limited {
            max_speed: or(self.max_speed, f32::INFINITY),
            max_force: or(self.max_force, f32::INFINITY),
            of: making.branch(&self.of, &at.key("of"))?,
        }
        .into())
    }
}

impl BuildBehaviour for StopAndWait {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::StopAndWait::new(making.branch(&self.of, &at.key("of"))?);
        Ok(throng_steer::StopAndWait {
            groups: making.groups(self.groups.as_ref(), &at.key("groups"))?,
            within: or(self.within, standard.within),
            wait: (or(self.least_wait, standard.wait.0), or(self.most_wait, standard.wait.1)),
            clear: or(self.clear, standard.clear),
            ..standard
        }
        .into())
    }
}
