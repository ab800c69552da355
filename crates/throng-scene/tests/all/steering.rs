//! Steering in scenes becomes the library's behaviours.

use glam::{DVec2, Vec3};
use throng::motion::{Forces, Integrator, Locomotion, Motor, Vehicle};
use throng::parameters::Angle;
use throng::space::surface::Surface;
use throng::steer::{BoxedBehaviour, GroupFilter, Target};
use throng_scene::{Kind, Plan, Scene};
use throng_steer::{Neighbourhood, Pattern};

/// Returns a scene of two groups around [100, 50], with the steering of the wolf.
fn scene(steer: &str) -> Scene {
    let text = format!(
        "[[group]]\nname = \"sheep\"\nplace.points = [[90, 50], [110, 50]]\n\
         [[group]]\nname = \"wolf\"\nplace.point = [100, 50]\nsteer.{steer}\n\
         [[mover]]\nname = \"cart\"\nbody.radius = 1\nscript = [{{ time = 0, at = [100, 60] }}]\n"
    );
    text.parse().unwrap_or_else(|error| panic!("{steer}: {error}"))
}

fn plan(scene: &Scene) -> Plan {
    scene.plan().unwrap_or_else(|error| panic!("{error}"))
}

/// Asserts that the wolf steers by this behaviour, as the library prints it.
#[track_caller]
fn assert_steers(said: &str, expected: impl Into<BoxedBehaviour>) {
    let scene = scene(said);
    let branch = plan(&scene).groups[1].guidance.behaviour.clone().expect("it steers");
    assert_eq!(format!("{branch:?}"), format!("{:?}", expected.into()), "{said}");
    let text = scene.to_toml().unwrap();
    assert_eq!(text.parse::<Scene>().unwrap(), scene, "{text}");
    scene.build().unwrap_or_else(|error| panic!("{said}: {error}"));
}

/// [103, 54] relative to the origin, which is the centre of the scene.
const PLACE: Vec3 = Vec3::new(3.0, -1.0, 0.0);

#[test]
fn what_is_not_said_is_the_librarys_default() {
    let goal = Target::Goal;
    assert_eq!(plan(&scene("wander = {}")).settings.origin, DVec2::new(100.0, 55.0));
    assert_steers("seek = { target = \"goal\" }", throng_steer::Seek { target: goal });
    assert_steers("flee = { target = \"goal\" }", throng_steer::Flee::new(goal));
    assert_steers("arrive = { target = \"goal\" }", throng_steer::Arrive::new(goal));
    assert_steers("pursue = { quarry = \"goal\" }", throng_steer::Pursue::new(goal));
    assert_steers("evade = { menace = \"goal\" }", throng_steer::Evade::new(goal));
    assert_steers("wander = {}", throng_steer::Wander::default());
    assert_steers("fractal_wander = {}", throng_steer::FractalWander::default());
    assert_steers("look_where_you_go = {}", throng_steer::LookWhereYouGo);
    assert_steers("separation = {}", throng_steer::Separation::default());
    assert_steers("alignment = {}", throng_steer::Alignment::default());
    assert_steers("cohesion = {}", throng_steer::Cohesion::default());
    assert_steers("match_velocity = {}", throng_steer::MatchVelocity::default());
    assert_steers("flocking = {}", throng_steer::Flocking::default());
    assert_steers("boids = {}", throng_steer::Boids::default());
    assert_steers("avoid_neighbours = {}", throng_steer::AvoidNeighbours::default());
    assert_steers("close_avoidance = {}", throng_steer::CloseAvoidance::default());
    assert_steers("unaligned_avoidance = {}", throng_steer::UnalignedAvoidance::default());
    assert_steers("follow_leader = { leader = \"goal\" }", throng_steer::FollowLeader::new(goal));
    assert_steers("queue = { of.wander = {} }", throng_steer::Queue::new(throng_steer::Wander::default()));
    assert_steers(
        "stop_and_wait = { of.wander = {} }",
        throng_steer::StopAndWait::new(throng_steer::Wander::default()),
    );
    let plain = Scene { groups: vec![throng_scene::Group::default()], ..Scene::default() };
    assert_eq!(plan(&plain).agents[0].agent.motor, Motor::default());
    assert_eq!(plan(&scene("wander = {}")).agents[2].agent.motor, Motor::Vehicle(Vehicle::default()));
}

#[test]
fn places_agents_and_groups_are_the_worlds() {
    let seek = |target| throng_steer::Seek { target };
    assert_steers("seek = { target = [103, 54] }", seek(Target::Point(PLACE)));
    assert_steers("seek = { target = [103, 54, 7.5] }", seek(Target::Point(PLACE.with_z(7.5))));
    assert_steers("seek = { target = { group = \"sheep\" } }", seek(Target::Agent(0)));
    assert_steers("seek = { target = { group = \"sheep\", agent = 1 } }", seek(Target::Agent(1)));
    assert_steers("seek = { target = { group = \"cart\" } }", seek(Target::Agent(3)));
    for (said, groups) in [
        ("all", GroupFilter::All),
        ("own", GroupFilter::OwnGroup),
        ("others", GroupFilter::OtherGroups),
        ("sheep", GroupFilter::Group(1)),
        ("wolf", GroupFilter::Group(2)),
        ("cart", GroupFilter::Group(3)),
    ] {
        assert_steers(&format!("seek = {{ target = {{ nearest = {said:?} }} }}"), seek(Target::Nearest(groups)));
    }
}

#[test]
fn a_quarry_is_found_by_its_name() {
    let scene: Scene = "[[group]]\nplace.points = [[0, 0], [0, 9]]\n\
        [[group]]\nname = \"dog\"\nplace.point = [20, 0]\nsteer.arrive = { target = { group = \"group-1\", agent = 1 } }\n"
        .parse()
        .unwrap();
    let (mut world, _) = scene.build().unwrap();
    (0..600).for_each(|_| world.step());
    let (dog, quarry) = (world.relative_columns().position[2], world.relative_columns().position[1]);
    assert!(dog.distance(quarry) < 0.5, "{dog} {quarry}");
}

#[test]
fn what_is_said_is_so() {
    let goal = Target::Goal;
    assert_steers(
        "arrive = { target = \"goal\", slowing_distance = 2, tolerance = 0.25 }",
        throng_steer::Arrive { target: goal, slowing_distance: 2.0, tolerance: 0.25 },
    );
    assert_steers(
        "flee = { target = \"goal\", panic_distance = 3 }",
        throng_steer::Flee { target: goal, panic_distance: 3.0 },
    );
    assert_steers(
        "pursue = { quarry = \"goal\", prediction.constant = 2 }",
        throng_steer::Pursue { quarry: goal, prediction: throng_steer::Prediction::Constant(2.0) },
    );
    assert_steers(
        "evade = { menace = \"goal\", prediction.distance = { per_metre = 0.5, most = 4 }, panic_distance = 3 }",
        throng_steer::Evade {
            menace: goal,
            prediction: throng_steer::Prediction::Distance { per_metre: 0.5, most: 4.0 },
            panic_distance: 3.0,
        },
    );
    assert_steers(
        "offset_pursuit = { quarry = \"goal\", prediction.cases = { most = 5 }, distance = 2 }",
        throng_steer::OffsetPursuit {
            quarry: goal,
            prediction: throng_steer::Prediction::Cases { most: 5.0 },
            distance: 2.0,
        },
    );
    assert_steers(
        "head_for = { heading = 0, full = 0.5 }",
        throng_steer::HeadFor { full: 0.5, ..throng_steer::HeadFor::new(Angle::default()) },
    );
    assert_steers("constant_force = [1, -2]", throng_steer::ConstantForce(Vec3::new(1.0, -2.0, 0.0)));
    let all = throng_steer::EvadeAll { groups: GroupFilter::OtherGroups, ahead: 0.25, near: 3.0, behind: 0.125 };
    assert_steers("evade_all = { ahead = 0.25, near = 3, behind = 0.125 }", all);
    assert_steers(
        "slip_through = { target = \"goal\", evade = { groups = \"own\" }, ahead = 0.5, width = 4, turn = 90 }",
        throng_steer::SlipThrough {
            evade: throng_steer::EvadeAll { groups: GroupFilter::OwnGroup, ..throng_steer::EvadeAll::default() },
            ahead: 0.5,
            width: 4.0,
            turn: Angle::degrees(90.0),
            ..throng_steer::SlipThrough::new(goal)
        },
    );
    assert_steers(
        "shadow = { quarry = \"goal\", distance = 2 }",
        throng_steer::Shadow { quarry: goal, distance: 2.0, slowing_distance: 1.0 },
    );
    assert_steers(
        "interpose = { from = \"goal\", to = [103, 54] }",
        throng_steer::Interpose { from: goal, to: Target::Point(PLACE), ratio: 0.5, slowing_distance: 1.0 },
    );
    assert_steers(
        "keep_station = { leader = \"goal\", offset = [-2, 1], slowing_distance = 4 }",
        throng_steer::KeepStation { leader: goal, offset: Vec3::new(-2.0, 1.0, 0.0), slowing_distance: 4.0 },
    );
    assert_steers(
        "dock = { place = [103, 54], heading = 0, pitch = 0, time = 5 }",
        throng_steer::Dock { time: Some(5.0), ..throng_steer::Dock::new(PLACE, Angle::default()) },
    );
    assert_steers(
        "wander = { strength = 0.5, rate = 180 }",
        throng_steer::Wander { strength: 0.5, rate: Angle::degrees(180.0) },
    );
    assert_steers(
        "explore = { min = [99, 50], max = [103, 54], columns = 4, rows = 2 }",
        throng_steer::Explore { min: Vec3::new(-1.0, -5.0, 0.0), max: PLACE, columns: 4, rows: 2, levels: 1 },
    );
    assert_steers(
        "forage = { food = \"goal\", range = 5 }",
        throng_steer::Forage { food: goal, range: 5.0, of: throng_steer::Wander::default().into() },
    );
    assert_steers("face = { target = \"goal\" }", throng_steer::Face { target: goal });
    assert_steers("match_orientation = { with = \"goal\" }", throng_steer::MatchOrientation { with: goal });
    assert_steers(
        "takeoff = { from = [103, 54], to = [104.5, 54], rise = 5, gravity = 10 }",
        throng_steer::Docking { place: PLACE, direction: Vec3::X * 1.5, speed: 1.5, time: None },
    );
    assert_steers("fear = { range = 9, fades = 4 }", throng_steer::Fear { range: 9.0, fades: 4.0 });
    assert_steers("move_forward = { part = 0.5 }", throng_steer::MoveForward { part: 0.5 });
    assert_steers("target_speed = { speed = 0.5 }", throng_steer::TargetSpeed { speed: 0.5 });
    assert_steers(
        "tether = { to = [103, 54], length = 9 }",
        throng_steer::Tether { to: Target::Point(PLACE), length: 9.0 },
    );
    let near = Neighbourhood {
        distance: 3.0,
        angle: Angle::degrees(90.0),
        always: 2.0,
        most: 7,
        groups: GroupFilter::OwnGroup,
    };
    assert_steers(
        "cohesion = { near = { distance = 3, angle = 90, always = 2, most = 7, groups = \"own\" }, full = 3 }",
        throng_steer::Cohesion { near, full: 3.0 },
    );
    let flock = throng_steer::Flocking::default();
    assert_steers(
        "flocking = { cohesion = { weight = 0.5 }, groups = \"all\" }",
        throng_steer::Flocking {
            cohesion: throng_steer::Rule { weight: 0.5, ..flock.cohesion },
            groups: GroupFilter::All,
            ..flock
        },
    );
    let boids = throng_steer::Boids::default();
    assert_steers(
        "boids = { strengths = { matching = 0.5, migrate = 0 }, migration = \"goal\" }",
        throng_steer::Boids {
            strengths: throng_steer::Strengths { matching: 0.5, migrate: 0.0, ..boids.strengths },
            migration: Some(goal),
            ..boids
        },
    );
    assert_steers(
        "keep_formation = { leader = { group = \"sheep\" }, pattern = \"wedge\", spacing = 1.5 }",
        throng_steer::KeepFormation {
            leader: Target::Agent(0),
            pattern: Pattern::Wedge,
            count: Some(1),
            spacing: 1.5,
            slowing_distance: 1.0,
        },
    );
}

#[test]
fn combinations_nest() {
    let wander = || BoxedBehaviour::from(throng_steer::Wander::default());
    let seek = || BoxedBehaviour::from(throng_steer::Seek { target: Target::Goal });
    assert_steers(
        "weighted_sum = [{ weight = 2, of.wander = {} }, { of.seek = { target = \"goal\" } }]",
        throng_steer::WeightedSum(vec![(2.0, wander()), (1.0, seek())]),
    );
    assert_steers("running_sum = [{ of.wander = {} }]", throng_steer::RunningSum(vec![(1.0, wander())]));
    let shy = throng_steer::Priority { epsilon: 0.0, parts: vec![seek(), wander()] };
    assert_steers("priority = [{ seek = { target = \"goal\" } }, { wander = {} }]", shy.clone());
    assert_steers(
        "priority = { epsilon = 0.5, of = [{ priority = [{ seek = { target = \"goal\" } }, { wander = {} }] }] }",
        throng_steer::Priority { epsilon: 0.5, parts: vec![shy.into()] },
    );
    assert_steers(
        "dithering = { of = [{ probability = 0.9, of.wander = {} }, { of.wander = {} }] }",
        throng_steer::Dithering { every: 0.1, parts: vec![(0.9, wander()), (1.0, wander())] },
    );
    assert_steers(
        "allocation = { budget = 0.9, of = [{ wander = {} }] }",
        throng_steer::Allocation { budget: 0.9, parts: vec![wander()] },
    );
    assert_steers("amortised = { every = 0.2, of.wander = {} }", throng_steer::Amortised { every: 0.2, of: wander() });
    assert_steers("hold = { seconds = 0.2, of.wander = {} }", throng_steer::Hold { seconds: 0.2, of: wander() });
    assert_steers(
        "limited = { max_speed = 0.5, of.wander = {} }",
        throng_steer::Limited { max_speed: 0.5, max_force: f32::INFINITY, of: wander() },
    );
    let noise = throng_steer::Noise { period: 3.0, octaves: 1, gain: 0.25, turbulent: true };
    assert_steers(
        "irregular = { angle = 0, speed = 0.5, noise = { period = 3, octaves = 1, gain = 0.25, turbulent = true }, of.wander = {} }",
        throng_steer::Irregular { angle: Angle::default(), speed: 0.5, noise, of: wander() },
    );
    let keen = throng_steer::ContextSteering::new(vec![(2.0, wander()), (1.0, seek())]);
    let parts = "of = [{ weight = 2, of.wander = {} }, { of.seek = { target = \"goal\" } }]";
    assert_steers(&format!("context_steering = {{ {parts} }}"), keen.clone());
    assert_steers(
        &format!("context_steering = {{ {parts}, directions = 8, horizon = 3, groups = \"sheep\" }}"),
        throng_steer::ContextSteering { directions: 8, horizon: 3.0, groups: GroupFilter::Group(1), ..keen },
    );
    use throng_steer::Condition;
    let near = Neighbourhood { most: 3, ..Neighbourhood::default() };
    assert_steers(
        "switch = { first = \"stroll\", states = { \
            back = { of.seek = { target = \"goal\" } }, \
            stroll = { of.wander = {}, exits = [ \
                { to = \"back\", when.nearer = { target = \"goal\", than = 3 } }, \
                { to = \"stroll\", when.any = [{ after = 4 }, { not.done = {} }, { all = [{ chance = 0.5 }] }] }, \
                { to = \"back\", when.crowded = { near = { most = 3 }, least = 2 } } ] } } }",
        throng_steer::Switch(vec![
            throng_steer::State {
                behaviour: wander(),
                exits: vec![
                    (Condition::Nearer { target: Target::Goal, than: 3.0 }, 1),
                    (
                        Condition::Any(vec![
                            Condition::After(4.0),
                            Condition::Not(Condition::Done.into()),
                            Condition::All(vec![Condition::Chance(0.5)]),
                        ]),
                        0,
                    ),
                    (Condition::Crowded { near, least: 2 }, 1),
                ],
            },
            throng_steer::State { behaviour: seek(), exits: vec![] },
        ]),
    );
}

#[test]
fn flows_carry() {
    for (flow, expected) in [("uniform = [0.5, 0]", DVec2::X), ("whirl = { center = [0, -5], speed = -0.5 }", DVec2::X)]
    {
        let text =
            format!("time.step = 0.1\n[[group]]\nplace.points = [[0, 0]]\nsteer.follow_flow = {{ flow.{flow} }}\n");
        let (mut world, _) = text.parse::<Scene>().unwrap().build().unwrap();
        (0..20).for_each(|_| world.step());
        let velocity = world.relative_columns().velocity[0].as_dvec2();
        assert!(
            velocity.normalize().dot(expected) > 0.95 && (velocity.length() - 0.5).abs() < 0.01,
            "{flow} {velocity}"
        );
    }
}

#[test]
fn agents_that_steer_have_only_the_given_interaction_rules() {
    let group = |more: &str| plan(&scene(&format!("wander = {{}}\n{more}"))).groups[1].clone();
    let bare = group("");
    assert!(!bare.guard && !bare.look_ahead && !bare.resolve);
    assert!(format!("{:?}", bare.model).contains("NoAvoidance"));
    let polite = group("guard = true\nlook_ahead = true\nkeep_right = 5\navoid.orca = {}");
    assert!(polite.guard && polite.look_ahead && (0.08..0.09).contains(&polite.keep_right));
    assert!(format!("{:?}", polite.model).contains("Orca"));
    let sharp = group("avoid.none = { neighbours = 30, neighbour_distance = 12 }");
    assert_eq!((sharp.neighbours, sharp.neighbour_distance), (30, 12.0));
}

#[test]
fn vehicles_are_as_said_and_their_bodies_as_fast() {
    let scene = scene(
        "wander = {}\nvehicle = { kind = \"banking\", mass = 2, max_force = 8, max_speed = 9, min_speed = 3, turn_rate = 180, \
         low_speed = 0.2, response = 0.5, smoothing = 0.1, integrator = \"euler\", forces = { thrust = 4, up = 3 } }",
    );
    let plan = plan(&scene);
    let agent = &plan.agents[2].agent;
    assert_eq!(
        agent.motor,
        Motor::Vehicle(Vehicle {
            mass: 2.0,
            max_force: 8.0,
            forces: Forces { thrust: 4.0, up: 3.0, ..Forces::default() },
            max_speed: 9.0,
            min_speed: 3.0,
            max_turn_rate: Angle::degrees(180.0),
            low_speed: 0.2,
            response: 0.5,
            smoothing: 0.1,
            locomotion: Locomotion::Banking,
            integrator: Integrator::Euler,
        })
    );
    assert_eq!(agent.preferred_speed, 9.0);
    assert_eq!(scene.to_toml().unwrap().parse::<Scene>().unwrap(), scene);
}

#[test]
fn a_program_adds_behaviours_of_its_own() {
    let mut scene = scene("priority = [{ hunt = {} }]");
    let error = scene.plan().unwrap_err();
    assert_eq!(error.kind, Kind::UnknownKey);
    assert!(error.to_string().contains("`hunt` is not one of the choices here"), "{error}");
    scene.plugins.behaviours.add("hunt", |cast| {
        assert!(cast.group("lost").is_err() && cast.agent("lost", 0).is_err() && cast.path("nowhere").is_none());
        Ok(throng_steer::Seek { target: Target::Point(cast.place(103.0, 54.0)) }.into())
    });
    // the behaviour has the name under which it was added
    let built = format!("{:?}", plan(&scene).groups[1].guidance.behaviour.as_ref().unwrap());
    let made = BoxedBehaviour::from(throng_steer::Seek { target: Target::Point(PLACE) });
    assert!(built.contains(&format!("NamedBehaviour {{ name: \"hunt\", branch: {made:?} }}")), "{built}");
    // the behaviours stay with the scene
    scene.set("time.step", "0.1").unwrap();
    assert!(scene.plan().is_ok());
}

#[test]
fn surfaces_are_where_the_scene_says() {
    let text = |shape: &str, more: &str| {
        format!("[[surface]]\nname = \"it\"\nshape.{shape}\n{more}\n[[group]]\nplace.point = [100, 50]\n")
    };
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("roof.obj"), "v 0 0 0\nv 4 0 0\nv 4 0 -4\nv 0 0 -4\nf 1 2 3 4\n").unwrap();
    // a probe that is 1 m from each surface, in the world's coordinates
    for (shape, more, probe) in [
        ("sphere = { radius = 2 }", "at = [100, 50, 1]", [100.0, 53.0, 1.0]),
        ("box = { size = [4, 2, 2] }", "at = [100, 50]\nheading = 90", [100.0, 53.0, 0.0]),
        ("plane = { normal = [0, 0, 5] }", "at = [0, 0, 3]", [100.0, 50.0, 4.0]),
        ("plane = { normal = [1, 0, 0] }", "pitch = 90\nat = [0, 0, 3]", [100.0, 50.0, 4.0]),
        ("rectangle = { size = [4, 2] }", "at = [100, 50]\nroll = 90", [100.0, 49.0, 0.9]),
        ("rectangle = { size = [4, 2] }", "at = [100, 50]\nroll = 90\nheading = 90", [101.0, 51.9, 0.9]),
        ("cylinder = { from = [0, 0, 0], to = [0, 0, 3], radius = 1 }", "at = [100, 50]", [102.0, 50.0, 1.0]),
        ("capsule = { from = [100, 50, 0], to = [100, 50, 3], radius = 1 }", "", [100.0, 50.0, 5.0]),
        ("prism = { corners = [[0, 0], [2, 0], [2, 2], [0, 2]] }", "at = [100, 50]", [101.0, 53.0, 8.0]),
        ("prism = { corners = [[0, 0], [2, 0], [2, 2], [0, 2]], top = 3 }", "at = [100, 50]", [101.0, 51.0, 4.0]),
        ("height_field = { cell = 2, columns = 2, heights = [1, 1, 1, 1] }", "at = [100, 50]", [101.0, 51.0, 2.0]),
        ("mesh = { file = \"roof.obj\" }", "at = [100, 50, 1]", [102.0, 52.0, 2.0]),
    ] {
        let mut scene: Scene = text(shape, more).parse().unwrap_or_else(|error| panic!("{shape}: {error}"));
        scene.origin.folder = dir.path().to_owned();
        let plan = plan(&scene);
        let at = (DVec2::new(probe[0], probe[1]) - plan.settings.origin).as_vec2().extend(probe[2] as f32);
        let found = plan.surfaces[0].surface.query(at);
        assert!((found.distance - 1.0).abs() < 1e-4, "{shape} {more}: {found:?}");
        assert_eq!(scene.to_toml().unwrap().parse::<Scene>().unwrap(), scene);
    }
}

#[test]
fn paths_are_where_the_scene_says() {
    let scene: Scene = "[[path]]\nname = \"round\"\npoints = [[100, 50], [104, 50], [104, 53, 2]]\nradii = [1, 2, 3]\n\
        cyclic = true\n[[group]]\nplace.point = [100, 50]\n"
        .parse()
        .unwrap();
    let plan = plan(&scene);
    let path = &plan.paths[0];
    assert!(path.is_cyclic());
    assert_eq!(path.segments().iter().map(|segment| segment.radius).collect::<Vec<_>>(), [1.0, 2.0, 3.0]);
    assert_eq!(path.segments()[1].end, Vec3::new(4.0, 3.0, 2.0));
    assert_eq!(scene.to_toml().unwrap().parse::<Scene>().unwrap(), scene);
}
