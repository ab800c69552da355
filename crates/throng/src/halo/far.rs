//! Agents of other worlds that behaviours read at any distance.
//!
//! A behaviour may ask for any agent by its number, such as a leader, and for its slot among the agents of its group. If
//! the agent is neither an own one nor a ghost, the question is noted and told to all worlds. The world of the agent
//! answers, and the agents are steered once more. A question is asked again at the start of every sub-step after that, so
//! agents are seldom steered twice.

use super::{Agreement, BROKEN, Halo, Told};
use crate::steer::Kinematics;
use crate::world::State;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;

/// Kinds of what worlds tell: a question for an agent, by its number; a question for the members of a group, by its index;
/// the motion of an agent, by its number; the group of an agent, by the number of the agent.
const AGENT_ASKED: u8 = 0;
const GROUP_ASKED: u8 = 1;
const AGENT: u8 = 2;
const MEMBER: u8 = 3;

/// A question of a behaviour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum FarQuestion {
    /// The motion of the agent with a number.
    Agent(u32),
    /// The numbers of the agents of a group.
    Group(u32),
}

/// Questions of behaviours without an answer, from all threads.
#[derive(Debug, Default)]
pub(crate) struct FarQuestions(Mutex<BTreeSet<FarQuestion>>);

impl FarQuestions {
    /// Notes a question.
    fn note(&self, question: FarQuestion) {
        self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).insert(question);
    }

    fn into_told(self) -> Told {
        let all = self.0.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        let key = |question| match question {
            FarQuestion::Agent(number) => (AGENT_ASKED, number),
            FarQuestion::Group(index) => (GROUP_ASKED, index),
        };
        all.into_iter().map(|question| (key(question), Vec::new())).collect()
    }
}

/// What the worlds have told of agents that behaviours ask for. The same in all worlds.
#[derive(Clone, Debug, Default)]
pub(crate) struct FarAgents {
    /// The agents asked for, by number; `None` for an agent that is in no world.
    agents: BTreeMap<u32, Option<Kinematics>>,
    /// The numbers of the agents of the groups asked for, ascending, by index of the group.
    members: BTreeMap<u32, Vec<u32>>,
}

impl FarAgents {
    /// Returns an agent by its number. Notes the question if it has no answer yet.
    pub fn find(&self, number: u32, questions: Option<&FarQuestions>) -> Option<Kinematics> {
        match self.agents.get(&number) {
            Some(&found) => found,
            None => {
                questions?.note(FarQuestion::Agent(number));
                None
            }
        }
    }

    /// Returns the slot of an agent: the number of agents of its group with lower numbers. Notes the question if it has no
    /// answer yet.
    pub fn slot(&self, group: u32, number: u32, questions: Option<&FarQuestions>) -> usize {
        match self.members.get(&group) {
            Some(members) => members.partition_point(|&other| other < number),
            None => {
                if let Some(questions) = questions {
                    questions.note(FarQuestion::Group(group));
                }
                0
            }
        }
    }

    /// Takes new questions of all worlds. Returns whether there are any.
    fn ask(&mut self, told: &Told) -> bool {
        for &(kind, number) in told.keys() {
            match kind {
                AGENT_ASKED => _ = self.agents.entry(number).or_default(),
                _ => _ = self.members.entry(number).or_default(),
            }
        }
        !told.is_empty()
    }

    /// Returns the answers of this world to all questions so far.
    pub fn answers(&self, state: &State) -> Told {
        let mut told = Told::new();
        if self.agents.is_empty() && self.members.is_empty() {
            return told;
        }
        for row in state.own() {
            let (number, group) = (state.agents.number[row], state.agents.group[row].0);
            if self.agents.contains_key(&number) {
                told.insert((AGENT, number), packed(&state.kinematics(row)));
            }
            if self.members.contains_key(&group) {
                told.insert((MEMBER, number), packed(&group));
            }
        }
        told
    }

    /// Takes the answers of all worlds.
    pub fn learn(&mut self, told: &Told) {
        self.agents.values_mut().for_each(|agent| *agent = None);
        self.members.values_mut().for_each(Vec::clear);
        for (&(kind, number), bytes) in told {
            match kind {
                AGENT => _ = self.agents.insert(number, Some(unpacked(bytes))),
                _ => self.members.entry(unpacked(bytes)).or_default().push(number),
            }
        }
    }
}

/// Asks the other worlds the questions of this world. Returns whether any world had a question: then all agents must be
/// steered once more.
pub(crate) fn ask_far(state: &mut State, halo: &mut dyn Halo, questions: FarQuestions) -> bool {
    let asked = halo.agree(Agreement { told: questions.into_told(), ..Agreement::default() }).told;
    if !state.others.far.ask(&asked) {
        return false;
    }
    let told = state.others.far.answers(state);
    let told = halo.agree(Agreement { told, ..Agreement::default() }).told;
    state.others.far.learn(&told);
    true
}

fn packed(value: &impl Serialize) -> Vec<u8> {
    let mut bytes = Vec::new();
    super::write(&mut bytes, value);
    bytes
}

fn unpacked<T: DeserializeOwned>(bytes: &[u8]) -> T {
    postcard::from_bytes(bytes).expect(BROKEN)
}
