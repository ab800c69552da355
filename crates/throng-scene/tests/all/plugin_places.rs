//! Placements of plug-ins.

use glam::{DVec2, DVec3};
use throng::parameters::parameters;
use throng_scene::{Error, Kind, Place, Placement, Plugins, Purpose, Random, Scene};

/// In a row along x. It can panic at an agent, and place an agent nowhere.
#[parameters]
#[derive(Debug)]
struct Row {
    /// Distance between agents, metres.
    #[parameter(default = 1.0, unit = "m", above = 0, most = 100)]
    step: f64,
    /// The height of each agent above the one before, metres.
    #[parameter(default = 0.0, unit = "m", least = 0)]
    rise: f64,
    /// The number of positions.
    room: Option<u64>,
    /// The agent at which it panics.
    panics: Option<u64>,
    /// The agent that is nowhere.
    nowhere: Option<u64>,
}

impl Placement for Row {
    fn position(&self, k: usize, _: usize, _: &mut Random) -> Option<DVec3> {
        assert!(self.panics != Some(k as u64), "no agent {k}");
        if self.room.is_some_and(|room| k as u64 >= room) {
            return None;
        }
        let x = if self.nowhere == Some(k as u64) { f64::NAN } else { self.step };
        Some(k as f64 * DVec3::new(x, 0.0, self.rise))
    }

    fn sets_altitude(&self) -> bool {
        self.rise > 0.0
    }

    fn capacity(&self) -> Option<u64> {
        self.room
    }

    fn check(&self) -> Result<(), throng::Error> {
        assert!(self.step != 13.0, "not thirteen");
        Ok(())
    }
}

/// At random in a half disc: candidates in the lower half are none.
#[parameters]
#[derive(Debug)]
struct HalfDisc {
    /// The radius, metres.
    #[parameter(required, unit = "m", above = 0)]
    radius: f64,
    /// The least distance between bodies, metres.
    #[parameter(default = 0.0, unit = "m")]
    gap: f64,
}

impl Placement for HalfDisc {
    fn position(&self, _: usize, _: usize, random: &mut Random) -> Option<DVec3> {
        let at = self.radius * DVec2::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        (at.y > 0.0 && at.length() < self.radius).then(|| at.extend(0.0))
    }

    fn is_drawn(&self) -> bool {
        true
    }

    fn gap(&self) -> f64 {
        self.gap
    }
}

fn plugins() -> Plugins {
    Plugins::new().placement::<Row>().placement::<HalfDisc>()
}

fn scene(lines: &str) -> Scene {
    let mut scene = Scene::parse("a.toml", format!("[[group]]\n{lines}")).unwrap();
    plugins().equip(&mut scene);
    scene
}

fn starts(lines: &str) -> Result<Vec<DVec3>, Error> {
    Ok(scene(lines).plan()?.agents.into_iter().map(|planned| planned.agent.position).collect())
}

#[test]
fn each_agent_gets_its_position() {
    let at = |x: f64, z: f64| DVec3::new(x, 0.0, z);
    assert_eq!(starts("count = 3\nplace.row = {}"), Ok(vec![at(0.0, 0.0), at(1.0, 0.0), at(2.0, 0.0)]));
    assert_eq!(starts("place.row = { step = 2, room = 2 }"), Ok(vec![at(0.0, 0.0), at(2.0, 0.0)]));
    assert_eq!(starts("count = 2\naltitude = 4\nplace.row = {}"), Ok(vec![at(0.0, 4.0), at(1.0, 4.0)]));
    assert_eq!(starts("count = 2\nplace.row = { rise = 3 }"), Ok(vec![at(0.0, 0.0), at(1.0, 3.0)]));
}

#[test]
fn what_does_not_fit_is_said_with_its_place() {
    for (lines, kind, place, says) in [
        ("place.rwo = {}", Kind::UnknownKey, (2, 7), "`rwo` is not one of the choices here"),
        ("count = 2\nplace.row = { stpe = 2 }", Kind::UnknownKey, (3, 15), "there is no key `stpe` here"),
        ("count = 2\nplace.row = { step = 0 }", Kind::OutOfRange, (3, 22), "step is 0, but must be more than 0"),
        ("count = 2\nplace.row = { step = \"far\" }", Kind::WrongType, (3, 22), "but should be a number"),
        ("count = 2\nplace.half_disc = {}", Kind::MissingKey, (3, 19), "the key `radius` is missing here"),
        ("place.row = {}", Kind::MissingKey, (1, 1), "the key `count` is missing"),
        ("count = 9\nplace.row = { room = 3 }", Kind::Conflict, (2, 9), "count is 9, but its place has 3 spots"),
        ("count = 2\nplace.row = { step = 0.1 }", Kind::Overlap, (3, 13), "their centres are 0.1 m apart"),
        ("count = 2\naltitude = 1\nplace.row = { rise = 1 }", Kind::Conflict, (3, 12), "place.row and altitude both"),
        ("count = 4\nplace.row = { step = 13 }", Kind::Panic, (3, 13), "a plug-in panicked: place `row`: not thirteen"),
        ("count = 4\nplace.row = { panics = 3 }", Kind::Panic, (3, 13), "a plug-in panicked: place `row`: no agent 3"),
        ("count = 4\nplace.row = { nowhere = 2 }", Kind::OutOfRange, (3, 13), "place `row` puts agent 2 at [NaN"),
        ("count = 9\nplace.half_disc = { radius = 0.3 }", Kind::NoRoom, (3, 19), "of 9 agents fit into its place"),
        (
            "count = 2\nplace.half_disc = { radius = 3, gap = -1 }",
            Kind::OutOfRange,
            (3, 19),
            "a gap of -1, but it must",
        ),
        (
            "place.row = { room = 1 }\nsource = { rate = 1, end = 3 }",
            Kind::NoRoom,
            (2, 13),
            "only 1 of 3 agents fit into its place",
        ),
    ] {
        let error = starts(lines).unwrap_err();
        assert!(error.message.contains(says), "{lines}: {error}");
        assert_eq!((error.kind, error.at), (kind, Some(place)), "{lines}: {error}");
    }
    let hint = starts("place.rwo = {}").unwrap_err().hint.unwrap();
    assert!(hint.contains("did you mean `row`?") && hint.contains("walkable, row, half_disc"), "{hint}");
}

#[test]
fn what_is_said_is_written_as_it_was() {
    let scene = scene("count = 2\nplace.row = { step = 2 }");
    let again: Scene = scene.to_toml().unwrap().parse().unwrap();
    assert_eq!(scene, again);
    assert_eq!(scene.groups[0].place, Place::of(&Row { step: 2.0, ..Row::default() }));
}

#[test]
fn the_schema_has_the_placements_and_their_parameters() {
    let schema = plugins().schema();
    let sound = jsonschema::validator_for(&schema).unwrap();
    for (place, good) in [
        ("row = {}", true),
        ("row = { step = 2 }", true),
        ("row = { step = 0 }", false),
        ("row = { stpe = 2 }", false),
        ("half_disc = {}", false),
        ("ring = { radius = 7 }", true),
        ("rwo = {}", false),
    ] {
        let text: toml::Value = toml::from_str(&format!("[[group]]\ncount = 2\nplace.{place}")).unwrap();
        assert_eq!(sound.is_valid(&serde_json::to_value(text).unwrap()), good, "{place}");
    }
}

#[test]
fn drawn_positions_are_inside_and_clear_of_all() {
    for seed in 0..32 {
        let mut random = Random::new(seed, 0, 0, Purpose::Choice);
        let n = random.between(1.0, 40.0) as usize;
        let (gap, x, radius) = (random.between(0.0, 0.3), random.between(-3.0, 3.0), random.between(0.1, 0.3));
        let mut scene = scene(&format!(
            "count = {n}\nplace.half_disc = {{ radius = 6, gap = {gap} }}\nbody.radius = {radius}\n\
             [[group]]\nplace.point = [{x}, 3]\n[[obstacle]]\nshape.circle = {{ center = [0, 0.5], radius = 1 }}"
        ));
        scene.seed = seed;
        let plan = scene.plan().unwrap();
        let bodies: Vec<(DVec3, f64)> =
            plan.agents.iter().map(|planned| (planned.agent.position, f64::from(planned.agent.radius))).collect();
        for (k, (spot, radius)) in bodies[..n].iter().enumerate() {
            assert!(spot.length() < 6.0 && spot.y > 0.0 && spot.z == 0.0, "{seed}: {spot}");
            assert!(spot.truncate().distance(DVec2::new(0.0, 0.5)) >= 1.0 + radius - 1e-6, "{seed}: {spot}");
            for (other, extent) in bodies[..k].iter().chain(&bodies[n..]) {
                assert!(spot.distance(*other) >= radius + extent + gap - 1e-6, "{seed}: {spot} {other}");
            }
        }
        assert_eq!(scene.plan().unwrap().agents, plan.agents);
    }
}
