//! provisional
use super::{Goal, Journey, Travel};
use crate::agent::Columns;
use crate::space::Place;
use glam::{DVec2, Vec2};
use serde::{Deserialize, Serialize};
/// p
#[derive(Debug, Default)]
pub struct Meshes;
/// p
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Route;
/// p
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Unreachable;
pub(crate) struct Way {
    pub towards: Vec2,
    pub remaining: f32,
}
impl Travel {
    pub(crate) fn way(&mut self, _: &Meshes, goal: &Goal, at: Vec2, _: f32, origin: DVec2) -> Way {
        let towards = (goal.middle() - origin - at.as_dvec2()).as_vec2();
        Way { towards, remaining: towards.length() }
    }
}
pub(crate) fn plan(_: &mut Meshes, agents: &mut Columns, _: &Place, goals: &[Goal], journeys: &[Journey], origin: DVec2) -> Vec<(usize, Unreachable)> {
    for row in 0..agents.len() {
        if agents.travel[row].route.is_none() && let Some(stop) = journeys[agents.journey[row].index()].stops.get(agents.travel[row].leg as usize) {
            agents.travel[row].route = Some(Route);
            agents.trip[row].shortest += (goals[stop.goal.index()].middle() - origin).distance(agents.position[row].as_dvec2());
        }
    }
    vec![]
}
