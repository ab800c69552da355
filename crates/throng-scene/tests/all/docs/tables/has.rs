//! Everything that throng has by name, in one sentence each, with the scenes of the gallery that use it.

use super::schema::Schema;
use super::{Uses, registered, table};
use throng_scene::Rulebook;

/// The number of scenes that a row lists.
const SHOWN: usize = 8;

pub fn tables(schema: &Schema, uses: &Uses) -> Vec<(String, String)> {
    let combinations: Vec<&str> =
        registered().iter().filter(|known| known.folder == "combine").map(|known| known.name).collect();
    let choices = |registry: &str| -> Vec<(String, String)> {
        schema.choices(registry).iter().map(|choice| (choice.name.to_owned(), choice.about.clone())).collect()
    };
    let (combinations, behaviours): (Vec<_>, Vec<_>) =
        choices("Steer").into_iter().partition(|(name, _)| combinations.contains(&name.as_str()));
    let book = Rulebook::default();
    let rules = book.names().map(|name| (name.to_owned(), book.about(name).unwrap().to_owned())).collect();
    let table = |name: &str, key: &str, registry: &str, rows: Vec<(String, String)>| {
        let rows = rows.into_iter().map(|(name, about)| {
            assert!(!about.is_empty(), "`{name}` has no description");
            vec![format!("`{name}`"), sentence(&about), scenes(&uses.scenes(registry, &name))]
        });
        (format!("what throng has: {name}"), table(&[key, "what it is", "scenes"], rows))
    };
    vec![
        table("placements", "`place.`", "Place", choices("Place")),
        table("goals", "`goal.`", "Goal", choices("Goal")),
        table("behaviours", "`steer.`", "Steer", behaviours),
        table("combinations", "`steer.`", "Steer", combinations),
        table("local models", "`avoid.`", "Avoid", choices("Avoid")),
        table("fields", "`flow.`", "Flow", choices("Flow")),
        table("rules", "`rules =`", "rules", rules),
    ]
}

/// Returns the first sentence of a text.
fn sentence(text: &str) -> String {
    let ends = text.match_indices(". ").map(|(at, _)| at + 1);
    let end = ends.into_iter().find(|&end| text[end + 1..].starts_with(char::is_uppercase));
    text[..end.unwrap_or(text.len())].to_owned()
}

/// Returns the first scenes, and the number of the rest.
fn scenes(all: &[&str]) -> String {
    let shown = if all.len() > SHOWN + 1 { SHOWN } else { all.len() };
    let names: Vec<String> = all[..shown].iter().map(|name| format!("`{name}`")).collect();
    match all.len() - shown {
        0 => names.join(", "),
        rest => format!("{} and {rest} more", names.join(", ")),
    }
}

#[test]
fn a_sentence_ends_before_the_next_one() {
    assert_eq!(sentence("Of Jin (Jin et al. 2008). The rest."), "Of Jin (Jin et al. 2008).");
    assert_eq!(sentence("One only."), "One only.");
    assert_eq!(sentence("No dot"), "No dot");
}

#[test]
fn long_lists_of_scenes_are_cut() {
    let names: Vec<String> = (0..12).map(|number| format!("s{number}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    assert_eq!(scenes(&[]), "");
    assert_eq!(scenes(&names[..2]), "`s0`, `s1`");
    assert!(scenes(&names[..9]).ends_with("`s8`"));
    assert!(scenes(&names[..10]).ends_with("`s7` and 2 more"));
}
