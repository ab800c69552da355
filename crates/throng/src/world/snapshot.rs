//! Saving and loading the state of a world.

use super::{Settings, Slots, World, control::OwnJourneys, fnv_1a, schedule::Schedule, standoff::Standoff};
use crate::Error;
use crate::agent::{Columns, JourneyId};
use crate::navigate::{Goal, Journey, Legs, Script, Unreachable};
use crate::space::Place;
use crate::steer::{BoxedBehaviour, Stimulus};
use crate::summary::Tally;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// First bytes of every saved state: its kind and the version of its layout. The hash of the rest follows, 8 bytes.
const MAGIC: &[u8] = b"throng state 14\n";

/// Everything that changes while a world runs.
#[derive(Serialize, Deserialize)]
struct SavedWorld {
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
    stimuli: Vec<Stimulus>,
    figures: Vec<(String, f64)>,
    own_journeys: OwnJourneys,
    field_memories: Vec<Vec<f32>>,
    extent: Option<(DVec2, DVec2)>,
}

impl World {
    /// Returns the whole state as bytes. A world that [loads](Self::load) them continues with the same bits. Groups are
    /// saved by name only, since their models are code. Of [rules](crate::Rules) the figures are saved.
    pub fn save(&self) -> Vec<u8> {
        let state = SavedWorld {
            settings: self.settings,
            steps: self.steps,
            agents: self.agents.clone(),
            slots: self.slots.clone(),
            groups: self.local_groups.iter().map(|group| group.name.clone()).collect(),
            goals: self.goals.clone(),
            journeys: self.journeys.clone(),
            choices: self.choices.clone(),
            scripts: self.scripts.clone(),
            place: self.place.clone(),
            schedule: self.schedule.clone(),
            tally: self.tally.clone(),
            stranded: self.stranded.clone(),
            standoffs: self.standoffs.clone(),
            stimuli: self.stimuli.clone(),
            figures: self.game.saved(),
            own_journeys: self.own_journeys.clone(),
            field_memories: self.field_memories(),
            extent: self.extent,
        };
        // writing to memory cannot fail, and all types are serialisable
        let body = postcard::to_stdvec(&state).unwrap_or_default();
        [MAGIC, &fnv_1a(body.iter().copied()).to_le_bytes(), &body].concat()
    }

    /// Replaces the state of the world by a [saved](Self::save) one. The world must have groups of the same names, and
    /// rules with the same figures, as a world built from the same scene has. A hash in the state detects damage. The
    /// content is trusted: a forged state may cause a panic.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the bytes are not a saved state or are damaged, or if groups or rules differ. The world
    /// is unchanged.
    pub fn load(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let fail = |why: String| Error::Snapshot { why };
        let sealed = bytes.strip_prefix(MAGIC).ok_or_else(|| fail("it begins with something else".into()))?;
        let (hash, body) = sealed.split_first_chunk().ok_or_else(|| fail("it ends too early".into()))?;
        if *hash != fnv_1a(body.iter().copied()).to_le_bytes() {
            return Err(fail("its bytes are not as they were saved".into()));
        }
        let state: SavedWorld = postcard::from_bytes(body).map_err(|error| fail(error.to_string()))?;
        let names: Vec<&String> = self.local_groups.iter().map(|group| &group.name).collect();
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
        self.adapted = adapted.ok_or_else(|| fail("its field memories do not fit this world's fields".into()))?;
        self.settings = state.settings;
        self.place = state.place;
        self.agents = Columns::default();
        self.place_changed();
        self.steps = state.steps;
        self.agents = state.agents;
        let words = self.local_groups.iter().filter_map(|group| group.steering.as_ref()).map(BoxedBehaviour::words);
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
        self.stimuli = state.stimuli;
        self.events.clear();
        self.own_journeys = state.own_journeys;
        self.game.figures = state.figures.into_iter().map(|(_, value)| value).collect();
        self.extent = state.extent;
        self.prepare_all_meshes();
        Ok(())
    }
}
