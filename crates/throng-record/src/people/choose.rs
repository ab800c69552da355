//! Which agents of a recording are people, and how they walk.

use super::body::PersonBody;
use super::{FigureStyle, MOST_SKINS};
use crate::formats::spill::{Spill, SpilledAgent, SpilledState};
use crate::{Output, Setting};
use glam::Vec3;
use std::io;
use std::sync::Arc;
use throng_figure::{Character, Person, Sample, Walk};

/// The longest recording with figures, seconds.
const LONGEST: f64 = 14_400.0;

/// The people of a recording.
#[derive(Clone, Debug)]
pub(crate) struct People {
    /// How they are written: never [`FigureStyle::Auto`].
    pub(crate) style: FigureStyle,
    times: Vec<f64>,
    /// The bodies of groups, from files.
    characters: Vec<Option<Arc<Character>>>,
}

impl People {
    /// Returns the people of a recording, in this style. A recording with figures gets as many moments as these need.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub(crate) fn of(style: FigureStyle, setting: &Setting, spill: &mut Spill, output: &Output) -> io::Result<Self> {
        let [first, last] = [spill.moments.first(), spill.moments.last()].map(|moment| moment.map_or(0.0, |at| at.0));
        let few = !setting.in_space && spill.agents.len() <= MOST_SKINS && last - first <= LONGEST;
        let style = match style {
            FigureStyle::Auto if few => FigureStyle::Skins,
            FigureStyle::Auto => FigureStyle::None,
            chosen => chosen,
        };
        let walks = |agent: &SpilledAgent| Person::of_agent(agent.number, agent.radius).is_some();
        if style != FigureStyle::None && spill.agents.iter().any(walks) {
            spill.refine(output)?;
        }
        let times = spill.moments.iter().map(|&(time, _)| time).collect();
        Ok(Self { style, times, characters: Vec::new() })
    }

    /// Returns the people with the bodies that their groups have from files: they walk on the legs of these bodies.
    pub(crate) fn with_characters(self, setting: &Setting) -> Self {
        Self { characters: setting.characters.clone(), ..self }
    }

    /// Returns the body that an agent has from a file.
    fn character(&self, agent: &SpilledAgent) -> Option<&Arc<Character>> {
        self.characters.get(agent.group as usize)?.as_ref()
    }

    /// Returns the body of a person that an agent is. Bodies of files count from 0, in the order of the groups.
    pub(crate) fn body(&self, agent: &SpilledAgent, person: &Person) -> PersonBody<'_> {
        let Some(character) = self.character(agent) else { return PersonBody::Build(person.build, person.look) };
        let mut before: Vec<&Arc<Character>> = Vec::new();
        for other in self.characters.iter().flatten() {
            if Arc::ptr_eq(other, character) {
                break;
            }
            if !before.iter().any(|known| Arc::ptr_eq(known, other)) {
                before.push(other);
            }
        }
        PersonBody::Character(before.len(), character)
    }

    /// Whether an agent is a person.
    pub(crate) fn has(&self, agent: &SpilledAgent) -> bool {
        self.person(agent).is_some()
    }

    /// Returns the person that an agent is; `None` if it is none.
    pub(crate) fn person(&self, agent: &SpilledAgent) -> Option<Person> {
        let person = Person::of_agent(agent.number, agent.radius).filter(|_| self.style != FigureStyle::None)?;
        Some(self.character(agent).map_or(person, |character| character.person(person)))
    }

    /// Returns the walk of an agent; `None` if it is not a person.
    ///
    /// # Errors
    /// A position is not finite, or the recording lasts more than four hours.
    pub(crate) fn walk(&self, agent: &SpilledAgent, track: &[(u32, SpilledState)]) -> io::Result<Option<Walk>> {
        let Some(person) = self.person(agent) else { return Ok(None) };
        let sample = |(moment, state): &(u32, SpilledState)| {
            let ahead = (state.rotation * Vec3::X).as_dvec3();
            let heading = libm::atan2(ahead.y, ahead.x);
            Sample { time: self.times[*moment as usize], position: state.place.truncate().as_dvec2(), heading }
        };
        let samples: Vec<Sample> = track.iter().map(sample).collect();
        let walk = Walk::recorded(&person, &samples);
        walk.map(Some).map_err(|error| io::Error::other(format!("agent {}: {error}", agent.number)))
    }
}
