//! Save, load, continue.

use super::{Settings, Slots, World, schedule::Schedule, standoff::Standoff};
use crate::Error;
use crate::agent::{Columns, JourneyId};
use crate::navigate::{Goal, Journey, Legs, Script, Unreachable};
use crate::space::Place;
use crate::steer::{Branch, Event};
use crate::summary::Tally;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// Begins every saved state: what it is, and the version of its layout.
const MAGIC: &[u8] = b"throng state 12\n";

/// Everything that changes while a world runs.
#[derive(Serialize, Deserialize)]
struct State {
    settings: Settings,
    steps: u64,
    agents: Columns,
    slots: Slots,
    groups: Vec<String>,
    goals: Vec<Goal>,
    journeys: Vec<Journey>,
    choices: Vec<Vec<JourneyId>>,
    scripts: Vec<Script>,
    place: Place,
    schedule: Schedule,
    tally: Tally,
    stranded: Vec<(u32, Unreachable)>,
    standoffs: Vec<Standoff>,
    events: Vec<Event>,
    figures: Vec<(String, f64)>,
    field_memories: Vec<Vec<f32>>,
    extent: Option<(DVec2, DVec2)>,
}

impl World {
    /// The whole state as bytes. A world that [loads](Self::load) them continues with the same bits. Groups are
    /// kept by name only, since their models are code; of [rules](crate::Rules), the figures.
    pub fn save(&self) -> Vec<u8> {
        let state = State {
            settings: self.settings,
            steps: self.steps,
            agents: self.agents.clone(),
            slots: self.slots.clone(),
            groups: self.groups.iter().map(|group| group.name.clone()).collect(),
            goals: self.goals.clone(),
            journeys: self.journeys.clone(),
            choices: self.choices.clone(),
            scripts: self.scripts.clone(),
            place: self.place.clone(),
            schedule: self.schedule.clone(),
            tally: self.tally.clone(),
            stranded: self.stranded.clone(),
            standoffs: self.standoffs.clone(),
            events: self.events.clone(),
            figures: self.game.saved(),
            field_memories: self.field_memories(),
            extent: self.extent,
        };
        // writing to memory cannot fail, and all types are serialisable
        postcard::to_extend(&state, MAGIC.to_vec()).unwrap_or_default()
    }

    /// Puts the world into a [saved](Self::save) state. The world must have the same groups, by name, and
    /// rules with the same figures: one built from the same scene has.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the bytes are not a saved state or groups or rules differ; the world is as it was.
    pub fn load(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let fail = |why: String| Error::Snapshot { why };
        let body = bytes.strip_prefix(MAGIC).ok_or_else(|| fail("it begins with something else".into()))?;
        let state: State = postcard::from_bytes(body).map_err(|error| fail(error.to_string()))?;
        let names: Vec<&String> = self.groups.iter().map(|group| &group.name).collect();
        if !names.iter().copied().eq(&state.groups) {
            return Err(fail(format!("its groups are {:?}, this world's {names:?}", state.groups)));
        }
        if !self.game.has(state.figures.iter().map(|(name, _)| name)) {
            let names = |all: &[(String, f64)]| all.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
            let (saved, own) = (names(&state.figures), names(&self.game.saved()));
            return Err(fail(format!("its rules have the figures {saved:?}, this world's {own:?}")));
        }
        if !state.agents.is_whole() {
            return Err(fail("its columns differ in length".into()));
        }
        let adapted = self.fields_that_remember(state.field_memories);
        self.adapted = adapted.ok_or_else(|| fail("its fields remember other places than this world's".into()))?;
        self.settings = state.settings;
        self.place = state.place;
        self.agents = Columns::default();
        self.place_changed();
        self.steps = state.steps;
        self.agents = state.agents;
        let words = self.groups.iter().filter_map(|group| group.steering.as_ref()).map(Branch::words);
        self.agents.memory.widen(words.max().unwrap_or(0));
        self.slots = state.slots;
        self.goals = state.goals;
        self.journeys = state.journeys;
        self.choices = state.choices;
        self.scripts = state.scripts;
        self.legs = Legs::new(&self.journeys, &self.goals);
        self.schedule = state.schedule;
        self.tally = state.tally;
        self.stranded = state.stranded;
        self.standoffs = state.standoffs;
        self.events = state.events;
        self.game.figures = state.figures.into_iter().map(|(_, value)| value).collect();
        self.extent = state.extent;
        self.prepare_all_meshes();
        Ok(())
    }
}
