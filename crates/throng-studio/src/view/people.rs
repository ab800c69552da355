//! Agents drawn as walking people: bodies at levels of detail, moved by the matrices of their joints.

use super::geometry::paint;
use crate::play::{Poses, RunMoment};
use crate::settings::Settings;
use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec2};
use std::sync::Arc;
use throng_draw::{Color, Followed, Projector};
use throng_figure::{Build, Character, Level, Person};
use throng_record::Body;

/// The number of bodies: of each build at each level.
pub const BODIES: usize = Build::ALL.len() * Level::ALL.len();

/// A person nearer to the eye than this is not drawn: the eye is in its head, metres.
const NEAREST: f64 = 0.6;

/// The radius of a person on the ground, in heights.
const BREADTH: f32 = 0.13;

/// A person that is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct DrawnPerson {
    /// The numbers among the poses before and now (-1: there is none before); the number of the look; 0.
    pub slots: [f32; 4],
    /// The colour of the top. Without opacity, it is that of the look.
    pub top: [u8; 4],
}

/// How a person is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PersonLook {
    /// In its own clothes.
    Own,
    /// With a top of this colour.
    Top(Color),
    /// Not at all: the scene gives the agent another shape.
    Hidden,
}

/// The people of a view.
#[derive(Clone, Debug)]
pub struct DrawnPeople {
    /// The poses between which the people are.
    pub poses: [Arc<Poses>; 2],
    /// Interpolation weight between the poses.
    pub share: f32,
    /// The people with each body, in the order of [`body`].
    pub bodies: [Vec<DrawnPerson>; BODIES],
    /// The people with each body of a file.
    pub figures: Vec<(Arc<Character>, Vec<DrawnPerson>)>,
}

/// Returns the people that are drawn, in a plan or in a view in space.
pub fn drawn<'a>(shown: &'a RunMoment, settings: &Settings, plan: bool) -> &'a [(u32, Person)] {
    shown.people.last().filter(|_| settings.draws_people(&shown.scene, plan)).map_or(&[], |poses| &poses.people)
}

/// Returns the person of an agent, if there is one.
pub fn person(people: &[(u32, Person)], number: u32) -> Option<&Person> {
    people.binary_search_by_key(&number, |(number, _)| *number).ok().map(|at| &people[at].1)
}

/// Returns an agent as broad as its person, which may be broader than its body.
pub fn broad(body: &Body, person: &Person) -> Body {
    Body { radius: body.radius.max(BREADTH * person.height as f32), core: Vec2::ZERO, ..*body }
}

/// Returns what a camera follows of an agent: of a person, the middle of the body.
pub fn followed(body: &Body, people: &[(u32, Person)]) -> Followed {
    let plain = Followed::from(body);
    let Some(person) = person(people, body.number) else { return plain };
    Followed { center: plain.center + DVec3::Z * 0.5 * person.height, radius: 0.11 * person.height, ..plain }
}

/// Returns the number of a body.
pub fn body(build: Build, level: Level) -> usize {
    build as usize * Level::ALL.len() + level as usize
}

impl DrawnPeople {
    /// Returns the people that are seen. `looks` says how they are drawn, in the order of the poses. `unit` is the number of pixels per point of the screen.
    pub fn seen(
        shown: &RunMoment,
        looks: &[PersonLook],
        share: f32,
        (projector, size, unit): (&Projector, Vec2, f32),
    ) -> Option<Self> {
        let parts = shown.people.len().checked_sub(1)?;
        let at = (share * parts as f32).clamp(0.0, parts as f32);
        let part = (at as usize).min(parts.checked_sub(1)?);
        let poses = [part, part + 1].map(|part| shown.people[part].clone());
        let mut bodies: [Vec<DrawnPerson>; BODIES] = Default::default();
        let mut figures: Vec<(Arc<Character>, Vec<DrawnPerson>)> = Vec::new();
        let mut before = 0;
        let mut moving = shown.frame.bodies.iter();
        for (now, ((number, person), look)) in poses[1].people.iter().zip(looks).enumerate() {
            // all lists are sorted by number
            let known = &poses[0].people;
            before += known[before..].iter().take_while(|(other, _)| other < number).count();
            let had = known.get(before).is_some_and(|(other, _)| other == number);
            let Some(agent) = moving.find(|body| body.number == *number) else { break };
            let middle = agent.position.extend(0.5 * person.height);
            let top = match look {
                PersonLook::Hidden => continue,
                PersonLook::Own => [0; 4],
                PersonLook::Top(color) => paint(*color),
            };
            let Some(height) = seen(projector, size, middle, person.height) else { continue };
            let before = if had { before as f32 } else { -1.0 };
            let drawn = DrawnPerson { slots: [before, now as f32, person.look.into(), 0.0], top };
            let Some(character) = shown.figures.character(agent.group) else {
                bodies[body(person.build, Level::for_height((height * unit).into()))].push(drawn);
                continue;
            };
            match figures.iter_mut().find(|(known, _)| Arc::ptr_eq(known, character)) {
                Some((_, people)) => people.push(drawn),
                None => figures.push((character.clone(), vec![drawn])),
            }
        }
        Some(Self { poses, share: at - part as f32, bodies, figures })
    }

    /// Returns the size of the buffers in bytes, with the poses of one moment.
    pub fn bytes(&self) -> usize {
        let lists = self.bodies.iter().chain(self.figures.iter().map(|(_, people)| people));
        let people: usize = lists.map(|people| size_of_val(people.as_slice())).sum();
        people + size_of_val(self.poses[1].joints.as_slice())
    }
}

/// Returns the height of a person on the screen, points, `None` outside of the view and at the eye.
fn seen(projector: &Projector, size: Vec2, middle: DVec3, height: f64) -> Option<f32> {
    if let Projector::Perspective(lens) = projector {
        let beside = lens.eye - middle;
        if beside.truncate().length() < NEAREST && beside.z.abs() < 0.5 * height + NEAREST {
            return None;
        }
    }
    let at = projector.pixel(middle)?;
    let tall = (projector.scale(middle) * height) as f32;
    let inside = at.cmpge(Vec2::splat(-tall)) & at.cmple(size + tall);
    inside.all().then_some(tall)
}

#[cfg(test)]
mod tests {
    use super::super::moment::nearest;
    use super::*;
    use crate::play::{Command, Engine};
    use glam::DVec2;
    use std::time::Duration;
    use throng_draw::Lens;

    const SIZE: Vec2 = Vec2::new(800.0, 600.0);

    /// Returns a moment of the circle with people.
    fn shown() -> Arc<RunMoment> {
        let mut engine = Engine::default();
        let scene = Arc::new(throng_scene::gallery::scene("circle").unwrap());
        engine.command(Command::Load { name: "circle".into(), scene, run: false });
        engine.command(Command::People(true));
        engine.command(Command::Seek(40));
        while engine.idle().is_some() {
            engine.work(Duration::from_millis(20));
        }
        engine.shown().unwrap()
    }

    /// Returns the view of a point from a distance, with this number of pixels per metre at one metre.
    fn view(target: DVec3, away: f64, focal: f64) -> Projector {
        Projector::Perspective(Lens::new(target + DVec3::new(0.0, -away, 0.1), target, focal, SIZE * 0.5, away))
    }

    #[test]
    fn the_level_is_that_of_the_height_on_the_screen() {
        let found = [500.0, 140.0, 139.0, 60.0, 59.0, 22.0, 21.0, 0.0].map(Level::for_height);
        use Level::{Blocks, Coarse, Fine, Medium};
        assert_eq!(found, [Fine, Fine, Medium, Medium, Coarse, Coarse, Blocks, Blocks]);
    }

    #[test]
    fn a_person_is_drawn_once_with_the_body_of_its_build_and_height() {
        let shown = shown();
        let person = shown.frame.bodies[5];
        let (_, own) = shown.people[1].people[5];
        for (focal, expected) in
            [(3000.0, Level::Fine), (700.0, Level::Medium), (300.0, Level::Coarse), (60.0, Level::Blocks)]
        {
            // 10 m away, `focal` / 10 pixels are a metre
            let projector = view(person.position.extend(0.9), 10.0, focal);
            let looks = vec![PersonLook::Top(Color::rgb(0x123456)); 36];
            let people = DrawnPeople::seen(&shown, &looks, 0.25, (&projector, SIZE, 1.0)).unwrap();
            let drawn: Vec<_> = people.bodies.iter().flatten().filter(|drawn| drawn.slots[1] == 5.0).collect();
            assert_eq!(drawn.len(), 1);
            assert_eq!((drawn[0].slots, drawn[0].top), ([5.0, 5.0, own.look.into(), 0.0], [0x12, 0x34, 0x56, 255]));
            assert!(people.bodies[body(own.build, expected)].contains(drawn[0]), "{focal}");
            assert_eq!(people.share, 0.25);
            let hidden = DrawnPeople::seen(&shown, &[PersonLook::Hidden; 36], 0.25, (&projector, SIZE, 1.0)).unwrap();
            assert!(hidden.bodies.iter().all(Vec::is_empty));
        }
    }

    #[test]
    fn people_outside_of_the_view_and_at_the_eye_are_not_drawn() {
        let shown = shown();
        let count = |projector: &Projector| {
            let people = DrawnPeople::seen(&shown, &[PersonLook::Own; 36], 1.0, (projector, SIZE, 1.0)).unwrap();
            people.bodies.iter().flatten().count()
        };
        let all = view(DVec3::ZERO, 60.0, 600.0);
        assert_eq!(count(&all), 36);
        // a look away from the crowd
        assert_eq!(count(&view(DVec3::new(0.0, 500.0, 1.0), 100.0, 600.0)), 0);
        // from the head of an agent
        let head = shown.frame.bodies[3].position.extend(1.6);
        let inside = Projector::Perspective(Lens::new(head, head + DVec3::X, 600.0, SIZE * 0.5, 1.0));
        let people = DrawnPeople::seen(&shown, &[PersonLook::Own; 36], 1.0, (&inside, SIZE, 1.0)).unwrap();
        assert!(people.bodies.iter().flatten().all(|drawn| drawn.slots[1] != 3.0));
    }

    #[test]
    fn a_click_on_the_chest_selects_the_person_in_front() {
        let shown = shown();
        let people = &shown.people[1].people;
        let body = shown.frame.bodies[7];
        // behind it stands no other agent, as the eye is outside of the circle
        let out = (body.position - DVec2::ZERO).normalize();
        let eye = (body.position + out * 8.0).extend(1.5);
        let chest = body.position.extend(1.3);
        let projector = Projector::Perspective(Lens::new(eye, chest, 900.0, SIZE * 0.5, 8.0));
        let at = projector.pixel(chest).unwrap();
        assert_eq!(nearest(&shown, &projector, at, 1.0, people), Some(7));
        assert_ne!(nearest(&shown, &projector, at, 1.0, &[]), Some(7), "a disc on the ground is lower");
        assert_eq!(nearest(&shown, &projector, at - Vec2::new(0.0, 250.0), 1.0, people), None);
    }

    #[test]
    fn every_mesh_fits_into_the_buffers() {
        for build in Build::ALL {
            for level in Level::ALL {
                let mesh = throng_figure::Mesh::new(build, level);
                assert!(mesh.positions.len() <= 1 << 16);
                for (joints, weights) in mesh.joints.iter().zip(&mesh.weights) {
                    assert!(
                        (weights[0] + weights[1] - 1.0).abs() < 1e-5,
                        "two joints move a vertex: {joints:?} {weights:?}"
                    );
                }
            }
        }
    }
}
