//! A state machine as files describe it.

use super::{Condition, State};
use throng::parameters::{Given, Kind, Parameter, Parameters, Value, parameters};
use throng::steer::BoxedBehaviour;

/// One behaviour at a time: a state machine.
#[parameters]
struct Switch {
    /// The name of the first state.
    #[parameter(required)]
    first: String,
    /// The states, by name.
    #[parameter(required)]
    states: Vec<(String, NamedState)>,
}

/// A state of a switch.
#[parameters]
struct NamedState {
    /// The behaviour of the state.
    #[parameter(required)]
    of: BoxedBehaviour,
    /// The exits of the state: the agent takes the first exit with a condition that holds.
    exits: Vec<Exit>,
}

/// An exit of a state.
#[parameters]
struct Exit {
    /// The name of the next state.
    #[parameter(required)]
    to: String,
    /// The condition.
    #[parameter(required)]
    when: Condition,
}

/// Files name the states. The first state comes first, then the rest in the order of their names.
impl Value for super::Switch {
    const KIND: Kind = Switch::KIND;

    fn read<G: Given>(given: &G, _: Option<Self>) -> Result<Self, G::Error> {
        if let Kind::Table(table) = Self::KIND {
            given.table(&table())?;
        }
        let key = |given: &G, key: &str| given.get(key).ok_or_else(|| given.missing(key));
        let mut states = key(given, "states")?.named()?;
        let named: Vec<String> = states.iter().map(|(name, _)| name.clone()).collect();
        let mut names: Vec<&str> = named.iter().map(String::as_str).collect();
        let first = key(given, "first")?.one_of("state", &names)?;
        states[..=first].rotate_right(1);
        names[..=first].rotate_right(1);
        let exit = |given: &G| {
            if let Kind::Table(table) = Exit::KIND {
                given.table(&table())?;
            }
            let when = key(given, "when")?;
            let condition = Condition::read(&when, None)?;
            condition.check().map_err(|error| when.refused(error))?;
            Ok((condition, key(given, "to")?.one_of("state", &names)?))
        };
        let state = |(_, given): &(String, G)| {
            if let Kind::Table(table) = NamedState::KIND {
                given.table(&table())?;
            }
            let exits = given.get("exits").map(|exits| exits.list()?.iter().map(exit).collect()).transpose()?;
            Ok(State { behaviour: key(given, "of")?.behaviour()?, exits: exits.unwrap_or_default() })
        };
        states.iter().map(state).collect::<Result<_, _>>().map(Self)
    }
}

impl Parameters for super::Switch {
    const NAME: &'static str = Switch::NAME;
    const ABOUT: &'static str = Switch::ABOUT;
    const PARAMETERS: &'static [Parameter] = Switch::PARAMETERS;
}
