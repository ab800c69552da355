//! The texts of a figure.

use throng::Explanation;
use throng::avoid::Cause;
use throng_record::Setting;

/// The distance below which velocities count as equal, m/s.
const SAME: f32 = 5e-3;
/// The maximum number of names in a list; further neighbours are only counted.
const NAMES: usize = 4;

/// Returns the title and the line below it.
pub(super) fn title(setting: &Setting, why: &Explanation) -> [String; 2] {
    let Explanation { number, time, seconds, .. } = why;
    let (name, parameters) = why.model.split_once('{').unwrap_or((&why.model, ""));
    let parameters = parameters.trim_end_matches('}').trim().replace('_', " ").replace(": ", " ");
    let parameters = parameters.replace("Some(", "").replace([')', '{', '}'], "");
    let parameters = if parameters.is_empty() { parameters } else { format!(" ({parameters})") };
    // Short names are acronyms.
    let name = if name.trim().len() <= 4 { name.trim().to_uppercase() } else { name.trim().to_owned() };
    [
        format!("{}: agent {number} at {time:.2} s, {name}", setting.title),
        format!("{name}{parameters}, choosing for {seconds:.4} s"),
    ]
}

/// Returns the caption: what determined the choice, and the first collisions.
pub(super) fn caption(why: &Explanation) -> Vec<String> {
    let mut lines = vec![format!("{} {}", decided(why), collisions(why))];
    let (body, guard) = (why.limited.distance(why.chosen), why.guarded.distance(why.limited));
    let mut later = Vec::new();
    if body > SAME {
        later.push(format!("The limits of the body change it by {body:.2} m/s."));
    }
    if guard > SAME {
        later.push(format!("The guard changes it by {guard:.2} m/s, so that no agents overlap."));
    }
    if !later.is_empty() {
        lines.push(later.join(" "));
    }
    lines
}

fn decided(why: &Explanation) -> String {
    let away = why.chosen.distance(why.preferred);
    if away <= SAME {
        return "Chosen: the preferred velocity.".into();
    }
    if why.chosen.distance(why.relaxed) <= SAME {
        return format!("Chosen: {away:.2} m/s from preferred, limited by the relaxation time.");
    }
    let held = why.held_by(why.chosen);
    let deepest = held.first().map_or(0.0, |(_, depth)| *depth);
    let causes: Vec<Cause> =
        held.iter().filter(|(_, d)| (*d > 0.0) == (deepest > 0.0)).map(|(cause, _)| *cause).collect();
    let names = names(&causes, why);
    match deepest {
        _ if causes.is_empty() => format!("Chosen: {away:.2} m/s from preferred."),
        0.0 => format!("Chosen: {away:.2} m/s from preferred, held by {names}."),
        deep => format!("Chosen: {away:.2} m/s from preferred, {deep:.2} m/s inside regions forbidden by {names}."),
    }
}

fn collisions(why: &Explanation) -> String {
    let touches = |velocity| match why.collision(velocity) {
        Some((time, cause)) if time < 0.05 => format!("touches {} at once", names(&[cause], why)),
        Some((time, cause)) => format!("touches {} after {time:.1} s", names(&[cause], why)),
        None => "touches no agent or wall".into(),
    };
    let (preferred, chosen) = (touches(why.preferred), touches(why.chosen));
    if why.chosen.distance(why.preferred) <= SAME {
        format!("If all other agents keep their velocities, it {chosen}.")
    } else {
        format!("If all other agents keep their velocities, preferred {preferred}, chosen {chosen}.")
    }
}

/// Returns the names of the causes; numbers of neighbours come first.
fn names(causes: &[Cause], why: &Explanation) -> String {
    let mut numbers: Vec<u32> = causes
        .iter()
        .filter_map(|cause| match *cause {
            Cause::Neighbour(index) => why.neighbours.get(index).map(|other| other.number),
            _ => None,
        })
        .collect();
    numbers.sort_unstable();
    let mut names: Vec<String> = numbers.iter().map(u32::to_string).collect();
    if names.len() > NAMES {
        let more = names.len() - NAMES;
        names.truncate(NAMES);
        names.push(format!("{more} others"));
    }
    match causes.iter().filter(|cause| matches!(cause, Cause::Edge(_) | Cause::Disc(_))).count() {
        0 => {}
        1 => names.push("a wall".into()),
        _ => names.push("walls".into()),
    }
    if causes.contains(&Cause::Body) {
        names.push("its body".into());
    }
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
        None => "none".into(),
    }
}
