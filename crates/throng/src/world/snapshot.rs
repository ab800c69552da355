//! Saving and loading the state of a world.

use super::control::OwnJourneys;
use super::schedule::Schedule;
use super::state::Slots;
use super::{Settings, World, fnv_1a};
use crate::Error;
use crate::agent::{Columns, JourneyId};
use crate::intend::Standoff;
use crate::navigate::{Goal, Journey, Legs, Script, Unreachable};
use crate::space::Place;
use crate::steer::Stimulus;
use crate::summary::Tally;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// First bytes of every saved state: its kind and the version of its layout. The hash of the rest follows, 8 bytes.
const MAGIC: &[u8] = b"throng state 19\n";

/// Everything that changes while a world runs.
#[derive(Serialize, Deserialize)]
pub(super) struct SavedWorld {
    pub settings: Settings,
    pub steps: u64,
    pub agents: Columns,
    pub slots: Slots,
    pub groups: Vec<String>,
    pub goals: Vec<Goal>,
    pub journeys: Vec<Journey>,
    pub choices: Vec<Vec<JourneyId>>,
    pub scripts: Vec<Script>,
    pub place: Place,
    pub schedule: Schedule,
    pub tally: Tally,
    pub stranded: Vec<(u32, Unreachable)>,
    pub standoffs: Vec<Standoff>,
    pub stimuli: Vec<Stimulus>,
    pub figures: Vec<(String, f64)>,
    pub own_journeys: OwnJourneys,
    pub field_memories: Vec<Vec<f32>>,
    pub extent: Option<(DVec2, DVec2)>,
}

impl World {
    /// Returns the whole state as bytes. A world that [loads](Self::load) them continues with the same bits. Groups are
    /// saved by name only, since their models are code. Of [rules](crate::Rules) the figures are saved.
    pub fn save(&self) -> Vec<u8> {
        let state = SavedWorld {
            agents: self.state.agents.clone(),
            slots: self.state.slots.clone(),
            tally: self.state.tally.clone(),
            stranded: self.state.stranded.clone(),
            ..self.saved_for_agents()
        };
        let body = state.bytes();
        [MAGIC, &fnv_1a(body.iter().copied()).to_le_bytes(), &body].concat()
    }

    /// Returns the state without the agents that are present and what they have done. All worlds of a division have the
    /// same.
    pub(super) fn saved_for_agents(&self) -> SavedWorld {
        SavedWorld {
            settings: self.state.settings,
            steps: self.state.steps,
            agents: Columns::default(),
            slots: Slots::default(),
            groups: self.state.local_groups.iter().map(|group| group.name.clone()).collect(),
            goals: self.state.goals.clone(),
            journeys: self.state.journeys.clone(),
            choices: self.state.choices.clone(),
            scripts: self.state.scripts.clone(),
            place: self.state.place.clone(),
            schedule: self.state.schedule.clone(),
            tally: Tally { sub_steps: self.state.tally.sub_steps, ..Tally::default() },
            stranded: Vec::new(),
            standoffs: self.state.standoffs.clone(),
            stimuli: self.state.stimuli.clone(),
            figures: self.state.game.saved(),
            own_journeys: self.state.own_journeys.clone(),
            field_memories: self.state.field_memories(),
            extent: self.state.extent,
        }
    }

    /// Replaces the state of the world by a [saved](Self::save) one. The world must have groups of the same names, and
    /// rules with the same figures, as a world built from the same scene has. A hash in the state detects damage. The
    /// content is trusted: a forged state may cause a panic.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the bytes are not a saved state or are damaged, or if groups or rules differ. The world
    /// is unchanged.
    pub fn load(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let state = SavedWorld::read(bytes)?;
        let names: Vec<&String> = self.state.local_groups.iter().map(|group| &group.name).collect();
        if !names.iter().copied().eq(&state.groups) {
            return Err(fail(format!("its groups are {:?}, this world's {names:?}", state.groups)));
        }
        if !self.state.game.has(state.figures.iter().map(|(name, _)| name)) {
            let names = |all: &[(String, f64)]| all.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
            let (saved, own) = (names(&state.figures), names(&self.state.game.saved()));
            return Err(fail(format!("its rules have the figures {saved:?}, this world's {own:?}")));
        }
        let adapted = self.state.fields_that_remember(state.field_memories);
        self.state.adapted = adapted.ok_or_else(|| fail("its field memories do not fit this world's fields".into()))?;
        self.state.settings = state.settings;
        self.state.place = state.place;
        self.state.agents = Columns::default();
        self.place_changed();
        self.state.steps = state.steps;
        self.state.agents = state.agents;
        let words = self.state.local_groups.iter().map(|group| group.guidance.words());
        self.state.agents.memory.widen(words.max().unwrap_or(0));
        self.state.slots = state.slots;
        self.state.goals = state.goals;
        self.state.journeys = state.journeys;
        self.state.choices = state.choices;
        self.state.scripts = state.scripts;
        self.state.legs = Legs::new(&self.state.journeys, &self.state.goals);
        self.state.schedule = state.schedule;
        self.state.tally = state.tally;
        self.state.stranded = state.stranded;
        self.state.standoffs = state.standoffs;
        self.state.stimuli = state.stimuli;
        self.state.events.clear();
        self.state.own_journeys = state.own_journeys;
        self.state.game.figures = state.figures.into_iter().map(|(_, value)| value).collect();
        self.state.extent = state.extent;
        self.state.prepare_all_meshes();
        Ok(())
    }
}

impl SavedWorld {
    /// Returns the state as bytes, without what [`World::save`] puts before them.
    pub fn bytes(&self) -> Vec<u8> {
        // writing to memory cannot fail, and all types are serialisable
        postcard::to_stdvec(self).unwrap_or_default()
    }

    /// Reads what [`World::save`] has returned.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the bytes are not a saved state, or are damaged.
    pub fn read(bytes: &[u8]) -> Result<Self, Error> {
        let sealed = bytes.strip_prefix(MAGIC).ok_or_else(|| fail("it begins with something else".into()))?;
        let (hash, body) = sealed.split_first_chunk().ok_or_else(|| fail("it ends too early".into()))?;
        if *hash != fnv_1a(body.iter().copied()).to_le_bytes() {
            return Err(fail("its bytes are not as they were saved".into()));
        }
        let state: Self = postcard::from_bytes(body).map_err(|error| fail(error.to_string()))?;
        if !state.agents.is_whole() {
            return Err(fail("its columns differ in length".into()));
        }
        Ok(state)
    }
}

fn fail(why: String) -> Error {
    Error::Snapshot { why }
}
