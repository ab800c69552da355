//! The role of a layer of a plan, by its name.

/// The role of a layer. If a name has words of several roles, the first of these applies: the wall of an exit is an
/// exit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Role {
    /// Agents leave here.
    Exit,
    /// Agents start here.
    Start,
    /// An obstacle.
    Obstacle,
    /// Walkable ground.
    Walkable,
}

/// The words of each role. A word matches the beginning of a word of a name: `wall` is in `Walls`, `A-WALL-FULL` and
/// `outerWall`.
const WORDS: [(Role, &[&str]); 4] = [
    (Role::Exit, &["exit", "egress", "door", "goal", "target", "destination", "sink"]),
    (
        Role::Start,
        &["start", "spawn", "entrance", "entry", "people", "crowd", "pedestrian", "agent", "distribution", "source"],
    ),
    (
        Role::Obstacle,
        &[
            "wall",
            "obstacle",
            "column",
            "cols",
            "pillar",
            "furniture",
            "furn",
            "block",
            "barrier",
            "fence",
            "hole",
            "solid",
        ],
    ),
    (Role::Walkable, &["walk", "floor", "flor", "area", "room", "space", "ground", "corridor", "hall"]),
];

/// The words that messages list.
pub(crate) const KNOWN: &str = "walkable, floor, area, room, space; wall, obstacle, column, furniture; exit, door, goal; start, spawn, entrance, people";

/// Returns the role of a name, if it has a known word.
pub(crate) fn role(name: &str) -> Option<Role> {
    let words = words(name);
    let says = |known: &[&str]| words.iter().any(|word| known.iter().any(|known| word.starts_with(known)));
    WORDS.iter().find(|(_, known)| says(known)).map(|(role, _)| *role)
}

/// Returns the words of a name in lower case. A character that is not a letter, and a capital after a small letter,
/// start a new word.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut small = false;
    for letter in name.chars() {
        if !letter.is_alphabetic() || (small && letter.is_uppercase()) {
            words.push(String::new());
        }
        small = letter.is_lowercase();
        if let (true, Some(word)) = (letter.is_alphabetic(), words.last_mut()) {
            word.extend(letter.to_lowercase());
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_layers_say_what_is_on_them() {
        for (name, says) in [
            ("Walls", Some(Role::Obstacle)),
            ("A-WALL-FULL", Some(Role::Obstacle)),
            ("outerWall2", Some(Role::Obstacle)),
            ("walkablearea", Some(Role::Walkable)),
            ("Ground_floor", Some(Role::Walkable)),
            ("jps-exits", Some(Role::Exit)),
            ("ExitDoors", Some(Role::Exit)),
            ("wall with exit", Some(Role::Exit)),
            ("jps-distributions", Some(Role::Start)),
            ("START AREA", Some(Role::Start)),
            ("ROOM", Some(Role::Walkable)),
            ("0", None),
            ("", None),
            ("Background", None),
            ("drywall", None),
            ("layer1", None),
        ] {
            assert_eq!(role(name), says, "{name}");
        }
    }
}
