//! Which agents are people, and which.

use throng_figure::{Build, Person};

/// The largest radius of a person, metres.
const LARGEST: f32 = 0.5;
/// Below this radius a person is a child, metres.
const CHILD: f32 = 0.18;
/// Height of a child, metres.
const CHILD_HEIGHT: f64 = 1.2;

/// Returns the person that an agent on the ground is, by its number and its radius (m): none above 0.5 m, a child below
/// 0.18 m.
///
/// ```
/// use throng_record::person;
/// assert!(person(7, 0.2).is_some_and(|person| person.height > 1.3));
/// assert!(person(7, 0.8).is_none());
/// ```
pub fn person(number: u32, radius: f32) -> Option<Person> {
    let adult = Person::new(0, u64::from(number));
    match radius {
        _ if radius > LARGEST => None,
        _ if radius < CHILD => Some(adult.with_build(Build::Child).with_height(CHILD_HEIGHT)),
        _ => Some(adult),
    }
}

/// The builds, and their names in files.
pub(crate) const BUILDS: [(Build, &str); 3] = [(Build::Woman, "woman"), (Build::Man, "man"), (Build::Child, "child")];

/// Returns the name of a build in files: `woman`, `man` or `child`.
pub fn build_name(build: Build) -> &'static str {
    BUILDS.into_iter().find(|(known, _)| *known == build).map_or("man", |(_, name)| name)
}
