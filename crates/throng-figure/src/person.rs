//! The person that walks a trajectory: build, height and manner of walking.

use crate::math::{normal, uniform};
use crate::pose::Legs;

/// The largest radius of an agent that is a person, m.
const LARGEST: f32 = 0.5;
/// Below this radius an agent is a child, m. The bodies of adult pedestrians have radii from 0.13 m on: they keep more
/// distance than their bodies.
const CHILD: f32 = 0.11;
/// Height of a child, m.
const CHILD_HEIGHT: f64 = 1.2;

/// The proportions of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Build {
    /// A woman.
    Woman,
    /// A man.
    Man,
    /// A child: a larger head, shorter legs.
    Child,
}

impl Build {
    /// All builds.
    pub const ALL: [Build; 3] = [Build::Woman, Build::Man, Build::Child];

    /// Returns the name: `woman`, `man` or `child`.
    pub fn name(self) -> &'static str {
        match self {
            Build::Woman => "woman",
            Build::Man => "man",
            Build::Child => "child",
        }
    }

    /// Returns the build of a name.
    ///
    /// ```
    /// use throng_figure::Build;
    ///
    /// assert!(Build::ALL.into_iter().all(|build| Build::named(build.name()) == Some(build)));
    /// assert_eq!(Build::named("robot"), None);
    /// ```
    pub fn named(name: &str) -> Option<Build> {
        Build::ALL.into_iter().find(|build| build.name() == name)
    }
}

/// A side of the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// The left side.
    Left,
    /// The right side.
    Right,
}

impl Side {
    /// Both sides, left first.
    pub const BOTH: [Side; 2] = [Side::Left, Side::Right];

    /// Returns the sign of the side along the y axis of the body: 1 for the left side, -1 for the right side.
    pub fn sign(self) -> f64 {
        match self {
            Side::Left => 1.0,
            Side::Right => -1.0,
        }
    }

    /// Returns the opposite side.
    pub fn other(self) -> Side {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }

    /// Returns 0 for the left side and 1 for the right side.
    pub fn index(self) -> usize {
        self as usize
    }
}

/// A person: what makes two people on the same trajectory walk differently.
///
/// ```
/// use throng_figure::Person;
///
/// let person = Person::new(7, 12);
/// assert_eq!(person, Person::new(7, 12));
/// assert!(person.height > 1.3 && person.height < 2.1);
/// assert_ne!(person.height, Person::new(7, 13).height);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Person {
    /// Proportions of the body.
    pub build: Build,
    /// Lengths of the legs and feet: those of the build, or of a [`Character`](crate::Character).
    pub legs: Legs,
    /// Height, m, greater than 0.
    pub height: f64,
    /// Factor of the length of steps, about 1.
    pub stride: f64,
    /// Factor of the distance of the feet, about 1.
    pub width: f64,
    /// Factor of the swing of the arms, about 1.
    pub arms: f64,
    /// Factor of the lateral motion of the pelvis, about 1.
    pub sway: f64,
    /// Angle by which feet point outward, rad.
    pub turnout: f64,
    /// Forward lean of the trunk, rad.
    pub lean: f64,
    /// The foot that steps first where either could.
    pub lead: Side,
    /// Where in the cycle of two steps the person is at first, in 0..1. It keeps people from walking in step.
    pub phase: f64,
    /// Number of the look, in 0..16: the colours of skin, hair and clothes.
    pub look: u8,
    /// The number from which the times of glances and shifts of weight come.
    pub seed: u64,
}

impl Person {
    /// Returns an adult that is a function of the seed of a run and the number of an agent.
    ///
    /// Heights are normally distributed: women 1.63 m (standard deviation 0.065 m), men 1.76 m (0.07 m).
    pub fn new(seed: u64, number: u64) -> Person {
        let draw = |purpose| uniform(seed, number, purpose);
        let build = if draw(1) < 0.5 { Build::Woman } else { Build::Man };
        let (mean, deviation) = match build {
            Build::Woman => (1.63, 0.065),
            _ => (1.76, 0.07),
        };
        Person {
            build,
            legs: Legs::of(build),
            height: mean + deviation * normal(seed, number, 2),
            stride: 0.94 + 0.12 * draw(3),
            width: 0.85 + 0.3 * draw(4),
            arms: 0.6 + 0.7 * draw(5),
            sway: if draw(6) < 0.5 { 1.0 } else { 1.3 },
            turnout: (5.0 + 4.0 * normal(seed, number, 7)).clamp(-3.0, 15.0).to_radians(),
            lean: (1.5 * normal(seed, number, 8)).to_radians(),
            lead: if draw(9) < 0.5 { Side::Left } else { Side::Right },
            phase: draw(10),
            look: (draw(11) * 16.0) as u8,
            seed: seed ^ number.wrapping_mul(0x9E37_79B9_7F4A_7C15),
        }
    }

    /// Returns the person of an agent on the ground, by its number and its radius (m): an adult, or below 0.11 m a child
    /// of 1.2 m. Returns `None` above 0.5 m: the agent is no person.
    ///
    /// ```
    /// use throng_figure::{Build, Person};
    ///
    /// assert_eq!(Person::of_agent(12, 0.25), Some(Person::new(0, 12)));
    /// assert_eq!(Person::of_agent(12, 0.1).map(|child| child.build), Some(Build::Child));
    /// assert_eq!(Person::of_agent(12, 1.0), None);
    /// ```
    pub fn of_agent(number: u32, radius: f32) -> Option<Person> {
        let person = Person::new(0, u64::from(number));
        let adult = radius >= CHILD;
        (radius <= LARGEST).then(
            || {
                if adult { person } else { person.with_build(Build::Child).with_height(CHILD_HEIGHT) }
            },
        )
    }

    /// Returns the person with this height, m. Heights outside 0.5..=2.5 are limited to it.
    pub fn with_height(self, height: f64) -> Person {
        Person { height: if height.is_finite() { height.clamp(0.5, 2.5) } else { self.height }, ..self }
    }

    /// Returns the person with the proportions of `build`.
    pub fn with_build(self, build: Build) -> Person {
        Person { build, legs: Legs::of(build), ..self }
    }

    /// Returns the length of the leg from the hip joint to the ankle, m.
    pub fn leg(&self) -> f64 {
        self.legs.leg() * self.height
    }
}
