//! What a figure says in words.

use throng::Explanation;
use throng::avoid::Cause;
use throng_record::Setting;

/// Velocities closer than this are the same, m/s.
const SAME: f32 = 5e-3;
/// More names than this are counted.
const NAMES: usize = 4;

/// The title, and a line below it.
pub(super) fn title(setting: &Setting, why: &Explanation) -> [String; 2] {
    let Explanation { number, time, seconds, .. } = why;
    let (name, parameters) = why.model.split_once('{').unwrap_or((&why.model, ""));
    let parameters = parameters.trim_end_matches('}').trim().replace('_', " ").replace(": ", " ");
    let parameters = parameters.replace("Some(", "").replace([')', '{', '}'], "");
    let parameters = if parameters.is_empty() { parameters } else { format!(" ({parameters})") };
    // short names are acronyms
    let name = if name.trim().len() <= 4 { name.trim().to_uppercase() } else { name.trim().to_owned() };
    [
        format!("{}: agent {number} at {time:.2} s, {name}", setting.title),
        format!("{name}{parameters}, choosing for {seconds:.4} s"),
    ]
}

/// What decided, and what would happen.
pub(super) fn caption(why: &Explanation) -> Vec<String> {
    let mut lines = vec![format!("{} {}", decided(why), collisions(why))];
    let (body, guard) = (why.limited.distance(why.chosen), why.guarded.distance(why.limited));
    let mut later = Vec::new();
    if body > SAME {
        later.push(format!("The body cannot do that at once: it misses it by {body:.2} m/s."));
    }
    if guard > SAME {
        later.push(format!("The guard changes it by {guard:.2} m/s, so that nobody overlaps."));
    }
    if !later.is_empty() {
        lines.push(later.join(" "));
    }
    lines
}

fn decided(why: &Explanation) -> String {
    let away = why.chosen.distance(why.preferred);
    if away <= SAME {
        return "Chosen: what is preferred.".into();
    }
    if why.chosen.distance(why.relaxed) <= SAME {
        return format!("Chosen: {away:.2} m/s from preferred, which it comes to in its relaxation time.");
    }
    let held = why.held_by(why.chosen);
    let deepest = held.first().map_or(0.0, |(_, depth)| *depth);
    let causes: Vec<Cause> =
        held.iter().filter(|(_, d)| (*d > 0.0) == (deepest > 0.0)).map(|(cause, _)| *cause).collect();
    let names = names(&causes, why);
    match deepest {
        _ if causes.is_empty() => format!("Chosen: {away:.2} m/s from preferred."),
        0.0 => format!("Chosen: {away:.2} m/s from preferred, held by {names}."),
        deep => format!("Chosen: {away:.2} m/s from preferred, up to {deep:.2} m/s inside what {names} forbid."),
    }
}

fn collisions(why: &Explanation) -> String {
    let touches = |velocity| match why.collision(velocity) {
        Some((time, cause)) if time < 0.05 => format!("touches {} at once", names(&[cause], why)),
        Some((time, cause)) => format!("touches {} after {time:.1} s", names(&[cause], why)),
        None => "touches nobody".into(),
    };
    let (preferred, chosen) = (touches(why.preferred), touches(why.chosen));
    if why.chosen.distance(why.preferred) <= SAME {
        format!("If all others keep their velocities, it {chosen}.")
    } else {
        format!("If all others keep their velocities, preferred {preferred}, chosen {chosen}.")
    }
}

/// The causes by name: numbers of neighbours first.
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
        None => "nobody".into(),
    }
}
