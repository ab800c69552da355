//! Bodies of files, with skeletons of their own, that walk with the same gait.

mod bind;
mod error;
mod measured;
mod rest;

pub use error::CharacterError;
pub use rest::RestBody;

use crate::mesh::Mesh;
use crate::person::Person;
use crate::pose::{Legs, Skeleton};

/// A body of a file that walks: its mesh, the colours of its vertices, its skeleton.
///
/// Poses turn joints from a pose at rest: legs straight down, feet straight ahead, arms 45° from the body. The
/// skeleton holds, for each joint, the turn from the body as it was modelled to that pose, so a body may be modelled with its
/// arms in any direction. Both legs have the mean lengths of the two. [`Character::person`] gives a person these legs:
/// footfalls, height of the pelvis and angles of the knees are then those of the body.
///
/// ```
/// use throng_figure::{Build, Character, CharacterError, Level, Look, Mesh, Person, RestBody, Skeleton};
///
/// // throng's own man, 1.8 m tall, as if it came from a file
/// let (mesh, skeleton) = (Mesh::new(Build::Man, Level::Fine), Skeleton::scaled(Build::Man, 1.8));
/// let body = RestBody {
///     joints: skeleton.world(&skeleton.rest()).map(|joint| Some(joint.position)),
///     positions: mesh.positions.iter().map(|position| position.as_dvec3() * 1.8).collect(),
///     normals: mesh.normals.clone(),
///     numbers: mesh.joints.clone(),
///     weights: mesh.weights.clone(),
///     colours: mesh.colours(&Look::new(0)),
///     triangles: mesh.triangles_of(&Look::new(0)),
/// };
/// let character = Character::new(&body)?;
/// let person = character.person(Person::new(1, 7));
/// assert!((person.leg() - 0.491 * 1.8).abs() < 1e-9);
/// # Ok::<(), CharacterError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Character {
    height: f64,
    legs: Legs,
    /// Of a height of 1 m.
    skeleton: Skeleton,
    mesh: Mesh,
    colours: Vec<[u8; 3]>,
}

impl Character {
    /// Returns the character of a body at rest.
    ///
    /// # Errors
    /// The body has no vertices or triangles, joints are missing, numbers are not finite or out of range, or the body
    /// does not stand: see [`CharacterError`].
    pub fn new(body: &RestBody) -> Result<Character, CharacterError> {
        body.check()?;
        let measured = measured::measure(body)?;
        let (height, legs) = (measured.height, measured.legs);
        let skeleton = bind::skeleton(&measured)?.times(1.0 / height);
        let positions = measured.positions.iter().map(|position| (*position / height).as_vec3()).collect();
        let mut mesh = Mesh {
            positions,
            normals: measured.normals,
            joints: measured.numbers,
            weights: measured.weights,
            regions: Vec::new(),
            triangles: body.triangles.clone(),
        };
        if mesh.normals.is_empty() {
            mesh.find_normals();
        }
        Ok(Character { height, legs, skeleton, mesh, colours: body.colours.clone() })
    }

    /// Returns a person with the height and the legs of the character. Wider hips place the feet farther apart.
    pub fn person(&self, person: Person) -> Person {
        let wider = (self.legs.hip / Legs::MAN.hip).clamp(0.7, 1.6);
        Person { height: self.height, legs: self.legs, width: person.width * wider, ..person }
    }

    /// Returns a person with this body, if there is one, and its skeleton.
    pub fn dressed(character: Option<&Character>, person: Person) -> (Person, Skeleton) {
        match character {
            None => (person, Skeleton::new(&person)),
            Some(character) => {
                let person = character.person(person);
                (person, character.skeleton(person.height))
            }
        }
    }

    /// Returns the height from the lowest to the highest vertex, m.
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Returns the lengths of the legs and feet, in heights.
    pub fn legs(&self) -> Legs {
        self.legs
    }

    /// Returns the skeleton for this height, m.
    pub fn skeleton(&self, height: f64) -> Skeleton {
        self.skeleton.times(height)
    }

    /// Returns the body as it was modelled, for a height of 1 m: it faces along x, and its lowest vertex is at z = 0. It has no
    /// regions.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Returns the colour of each vertex: red, green, blue (sRGB).
    pub fn colours(&self) -> &[[u8; 3]] {
        &self.colours
    }
}
