//! What cannot be divided.

use crate::Error;
use crate::agent::{Agent, Group};
use crate::field::Governed;
use crate::navigate::{Goal, Journey};
use crate::world::State;

/// Whether a reason applies, and the reason.
type Reason = (bool, &'static str);

/// Returns an error with the group and the reason if a crowd cannot be divided with the same bits.
pub(super) fn refuse(state: &State) -> Result<(), Error> {
    let first = |reasons: &[Reason]| reasons.iter().find(|(applies, _)| *applies).map(|&(_, why)| why);
    if let Some(why) = first(&of_world(state)) {
        return Err(Error::Undivided { what: why.into() });
    }
    let agents: Vec<Agent> =
        (0..state.agents.len()).map(|row| state.to_agent(row)).chain(state.schedule.all().cloned()).collect();
    for (index, group) in state.local_groups.iter().enumerate() {
        let mut members = agents.iter().filter(|agent| agent.group.index() == index).peekable();
        if members.peek().is_none() {
            continue;
        }
        let why = first(&of_group(group)).or_else(|| members.find_map(|agent| of_agent(state, agent)));
        if let Some(why) = why {
            return Err(Error::Undivided { what: format!("group `{}`: {why}", group.name) });
        }
    }
    Ok(())
}

/// Reasons that concern the whole world.
fn of_world(state: &State) -> [Reason; 2] {
    [
        (state.game.has_rules(), "its rules see the whole world, and may change any agent"),
        (!state.choices.is_empty(), "agents that choose among goals count the agents on the way to each goal"),
    ]
}

/// Reasons in the properties of a group.
fn of_group(group: &Group) -> [Reason; 3] {
    let field = group.guidance.field.as_ref();
    let follows = |field: &Governed| field.around.iter().any(|around| !around.reach.is_finite());
    [
        (field.is_some_and(follows), "its field follows agents at any distance: give the field a finite reach"),
        (group.model.together().is_some(), "its local model chooses the velocities of all its agents together"),
        (group.wrap_around.is_some(), "its agents wrap around, so that they jump to a far place"),
    ]
}

/// Returns the reason in an agent, present or scheduled.
fn of_agent(state: &State, agent: &Agent) -> Option<&'static str> {
    let Journey { stops, repeat } = &state.journeys[agent.journey.index()];
    let last = stops.last().map(|stop| &state.goals[stop.goal.index()]);
    let stays = !repeat && matches!(last, Some(Goal::Area { .. }));
    stays.then_some("its agents end in an area, where each chooses a place among the places of all others")
}
