//! The number of agents, and when they enter.

use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::registry::ChosenPlacement;
use crate::scene::{Group, Scene, Source};

/// The maximum number of agents of a scene.
pub const MAX_AGENTS: u64 = 20_000_000;

/// The number of agents of a group, and when each enters (`None`: all are there from the start).
#[derive(Debug)]
pub(super) struct Count {
    pub agents: usize,
    pub enters: Option<Vec<f64>>,
}

/// Returns the counts of all groups. Nothing large is allocated before all counts are known to be within the limit.
pub(super) fn counts(scene: &Scene, places: &[ChosenPlacement]) -> Result<Vec<Count>, Problem> {
    let mut total = 0;
    let mut numbers = vec![];
    for (i, (group, place)) in scene.groups.iter().zip(places).enumerate() {
        let path = Path::of("group").index(i);
        let number = match group.source.is_empty() {
            true => standing(&path, i, group, place.capacity)?,
            false => entering(&path, i, group)?,
        };
        total += number;
        if number > MAX_AGENTS || total > MAX_AGENTS {
            let message = format!("{total} agents are more than the limit of {MAX_AGENTS} (MAX_AGENTS)");
            return Err(
                Problem::new(&path.key("count"), Kind::Count, message).hint("use fewer agents, or several scenes")
            );
        }
        numbers.push(number as usize);
    }
    if total == 0 {
        let path = if scene.groups.is_empty() { Path::default() } else { Path::of("group").index(0).key("count") };
        let hint = "add a [[group]] with a `count` of at least 1 and a `place`";
        return Err(Problem::new(&path, Kind::Count, "the scene has no agents").hint(hint));
    }
    let groups = scene.groups.iter().zip(numbers);
    Ok(groups.map(|(group, agents)| Count { agents, enters: times(group, agents) }).collect())
}

/// Returns the count of a group that is there from the start. `spots` is the number of positions of its place.
fn standing(path: &Path, i: usize, group: &Group, spots: Option<u64>) -> Result<u64, Problem> {
    match (group.count, spots) {
        (Some(count), Some(spots)) if count > spots => {
            let named = Group::name_at(&group.name, i);
            let message = format!("group `{named}`: count is {count}, but its place has {spots} spots");
            let problem = Problem::new(&path.key("count"), Kind::Conflict, message);
            Err(if spots == 1 {
                problem.hint("use place.grid, place.disc or another place with room for all, or a source")
            } else {
                problem.hint("make the two numbers agree, or leave out `count`")
            })
        }
        (Some(count), _) => Ok(count),
        (None, Some(spots)) => Ok(spots),
        (None, None) => Err(missing_count(path, i, group)),
    }
}

fn missing_count(path: &Path, i: usize, group: &Group) -> Problem {
    let message = format!("group `{}`: the key `count` is missing", Group::name_at(&group.name, i));
    Problem::new(path, Kind::MissingKey, message).hint("say how many agents: count = 36")
}

/// Returns the count of a group that enters through sources.
fn entering(path: &Path, i: usize, group: &Group) -> Result<u64, Problem> {
    let mut total = 0u64;
    for (k, source) in group.source.iter().enumerate() {
        let path = path.key("source").index(k);
        if source.rate.is_some() && source.interval.is_some() {
            let message = format!("{} has both a rate and an interval", path.below_list());
            return Err(Problem::new(&path, Kind::Conflict, message).hint("keep one of them"));
        }
        if let Some(end) = source.end
            && end <= source.start
        {
            let message = format!("{} ends at {end} s, but starts at {} s", path.below_list(), source.start);
            return Err(Problem::new(&path.key("end"), Kind::OutOfRange, message));
        }
        let Some(interval) = interval(source) else {
            let message = format!("{} does not say how fast agents enter", path.below_list());
            return Err(Problem::new(&path, Kind::MissingKey, message)
                .hint("give `rate` (agents a second), `interval` (seconds), or `end` together with `count`"));
        };
        let until_end = source.end.map(|end| ((end - source.start) / interval).ceil().max(1.0) as u64);
        match source.count.into_iter().chain(until_end).min().or(group.count) {
            Some(n) => total = total.saturating_add(n),
            None => {
                let message = format!("{} never ends", path.below_list());
                return Err(Problem::new(&path, Kind::MissingKey, message)
                    .hint("give the source an `end` or a `count`, or the group a `count`"));
            }
        }
    }
    if group.count == Some(0) {
        return Err(missing_count(path, i, group));
    }
    Ok(group.count.map_or(total, |count| count.min(total)))
}

/// Returns the seconds between two agents of a source.
fn interval(source: &Source) -> Option<f64> {
    match (source.interval, source.rate, source.end, source.count) {
        (Some(interval), ..) => Some(interval),
        (_, Some(rate), ..) => Some(1.0 / rate),
        (_, _, Some(end), Some(count)) if count > 0 => Some((end - source.start) / count as f64),
        (_, _, _, Some(0)) => Some(1.0),
        _ => None,
    }
}

/// Returns when each agent of a group enters: the times of the sources in order.
fn times(group: &Group, agents: usize) -> Option<Vec<f64>> {
    if group.source.is_empty() {
        return None;
    }
    let mut all: Vec<f64> = vec![];
    for source in &group.source {
        let interval = interval(source).unwrap_or(1.0);
        let most = source.count.map_or(agents, |count| agents.min(count as usize));
        let times = (0..most).map(|k| source.start + k as f64 * interval);
        all.extend(times.take_while(|time| source.end.is_none_or(|end| *time < end - 1e-9)));
    }
    all.sort_by(f64::total_cmp);
    // A source loses an agent if its last interval rounds away: the last agent then enters together with the one
    // before.
    let last = all.last().copied().unwrap_or(0.0);
    all.resize(agents, last);
    Some(all)
}
