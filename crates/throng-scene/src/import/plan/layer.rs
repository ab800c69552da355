//! What is on a layer of a plan, by its name.

/// What is on a layer. Where a name says several, the first of these holds: the wall of an exit is an exit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Role {
    /// Where people leave.
    Exit,
    /// Where people are at the start.
    Start,
    /// What is solid.
    Obstacle,
    /// What can be walked on.
    Walkable,
}

/// The words that say so, by their beginnings: `wall` is in `Walls`, `A-WALL-FULL` and `outerWall`.
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

/// What is known by these names.
pub(crate) const KNOWN: &str = "walkable, floor, area, room, space; wall, obstacle, column, furniture; exit, door, goal; start, spawn, entrance, people";

/// What a name says, if it has a word that is known.
pub(crate) fn role(name: &str) -> Option<Role> {
    let words = words(name);
    let says = |known: &[&str]| words.iter().any(|word| known.iter().any(|known| word.starts_with(known)));
    WORDS.iter().find(|(_, known)| says(known)).map(|(role, _)| *role)
}

/// The words of a name, in small letters: what is no letter, and a capital after a small letter, begins another.
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
