//! Combinations of behaviours, and modifiers of a behaviour.

use super::super::rules::no_figure;
use super::{BehaviourContext, BuildBehaviour};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::steer::*;
use throng::steer::BoxedBehaviour;
use throng_steer::Neighbourhood;

impl BehaviourContext<'_> {
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
