//! Goals of plug-ins.

use glam::{DVec2, DVec3};
use throng::Goal;
use throng::parameters::parameters;
use throng_scene::{AgentJourney, AgentStart, Error, GoalRule, Kind, Plan, Plugins, Random, Scene};

/// What the goal of an agent is.
#[parameters]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Sort {
    /// A point east of its start.
    #[default]
    East,
    /// A point at random.
    Drawn,
    /// The mirror of its start at the centre of the place.
    Mirror,
    /// The area on its side, of two.
    Side,
    /// An exit.
    Leave,
    /// There and back, with a wait.
    Round,
    /// Nothing.
    Nothing,
    /// A point that is none.
    Nan,
    /// A tolerance of 0.
    Exact,
    /// A wait that is negative.
    Early,
    /// An area with two corners.
    Flat,
}

/// A goal of some sort.
#[parameters]
#[derive(Debug)]
struct Errand {
    /// The sort.
    sort: Sort,
    /// How far, metres.
    #[parameter(default = 5.0, unit = "m", above = 0, most = 100)]
    far: f64,
    /// The agent at which it panics.
    panics: Option<u64>,
}

fn square(x: f64) -> Vec<DVec2> {
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(dx, dy)| DVec2::new(x + dx, dy)).to_vec()
}

impl GoalRule for Errand {
    fn goal(&self, agent: &AgentStart, random: &mut Random) -> AgentJourney {
        assert!(self.panics != Some(agent.k as u64), "no agent {}", agent.k);
        let east = agent.at + self.far * DVec3::X;
        let corners = square(if agent.k < agent.n / 2 { -self.far } else { self.far });
        match self.sort {
            Sort::East => agent.point(east, 0.2).into(),
            Sort::Drawn => agent.point(DVec3::new(random.between(-9.0, 9.0), random.unit(), 0.0), 0.2).into(),
            Sort::Mirror => agent.point(2.0 * agent.center - agent.at, 0.2).into(),
            Sort::Side => Goal::Area { corners }.into(),
            Sort::Leave => Goal::Exit { corners: square(20.0) }.into(),
            Sort::Round => AgentJourney {
                stops: vec![(agent.point(east, 0.2), 1.5), (agent.point(agent.at, 0.2), 0.0)],
                repeat: true,
            },
            Sort::Nothing => AgentJourney { stops: vec![], repeat: false },
            Sort::Nan => agent.point(DVec3::NAN, 0.2).into(),
            Sort::Exact => agent.point(east, 0.0).into(),
            Sort::Early => AgentJourney { stops: vec![(agent.point(east, 0.2), -1.0)], repeat: false },
            Sort::Flat => Goal::Area { corners: corners[..2].to_vec() }.into(),
        }
    }

    fn check(&self) -> Result<(), throng::Error> {
        assert!(self.far != 13.0, "not thirteen");
        Ok(())
    }
}

fn plugins() -> Plugins {
    Plugins::new().goal::<Errand>()
}

fn scene(lines: &str) -> Scene {
    let text = format!("[[group]]\ncount = 4\nplace.line = {{ from = [-3, 0], to = [3, 0] }}\n{lines}");
    let mut scene = Scene::parse("a.toml", text).unwrap();
    plugins().equip(&mut scene);
    scene
}

fn plan(lines: &str) -> Result<Plan, Error> {
    scene(lines).plan()
}

/// Returns the goals of each agent, with the seconds to wait there, and whether they repeat.
fn journeys(plan: &Plan) -> Vec<(Vec<(&Goal, f32)>, bool)> {
    let journey = |index: Option<usize>| &plan.journeys[index.unwrap()];
    let journeys = plan.agents.iter().map(|planned| journey(planned.journey));
    let stops = |stops: &[(usize, f32)]| stops.iter().map(|(goal, wait)| (&plan.goals[*goal], *wait)).collect();
    journeys.map(|journey| (stops(&journey.stops), journey.repeat)).collect()
}

#[test]
fn each_agent_gets_its_point() {
    let plan = plan("goal.errand = { far = 6 }").unwrap();
    for (planned, (stops, repeat)) in plan.agents.iter().zip(journeys(&plan)) {
        let at = planned.agent.position.truncate() + DVec2::X * 6.0;
        assert_eq!((stops, repeat), (vec![(&Goal::Point { at, tolerance: 0.2 }, 0.0)], false));
    }
}

#[test]
fn agents_in_the_air_get_points_in_the_air() {
    let plan = plan("altitude = 3\ngoal.errand = {}").unwrap();
    let heights = plan.goals.iter().map(|goal| match goal {
        Goal::Air { at, .. } => at.z,
        goal => panic!("{goal:?}"),
    });
    assert_eq!(heights.collect::<Vec<_>>(), [3.0; 4]);
}

#[test]
fn the_centre_of_the_place_is_known() {
    let own = plan("goal.opposite = { tolerance = 0.2 }").unwrap();
    let errand = plan("goal.errand = { sort = \"mirror\" }").unwrap();
    assert_eq!(own.goals, errand.goals);
}

#[test]
fn agents_share_areas_and_exits_but_no_points() {
    let sides = plan("goal.errand = { sort = \"side\" }").unwrap();
    assert_eq!(sides.goals, [-5.0, 5.0].map(|x| Goal::Area { corners: square(x) }));
    let chosen: Vec<Option<usize>> = sides.agents.iter().map(|planned| planned.journey).collect();
    assert!(chosen[0] == chosen[1] && chosen[1] != chosen[2] && chosen[2] == chosen[3], "{chosen:?}");
    let exit = plan("goal.errand = { sort = \"leave\" }").unwrap();
    assert_eq!((exit.goals.len(), exit.journeys.len()), (1, 1));
    // an area of the scene is the same area
    let area =
        "goal.nearest = [{ errand = { sort = \"leave\" } }, { exit.rectangle = { center = [20, 0], size = [2, 2] } }]";
    assert_eq!(plan(area).unwrap().goals.len(), 1);
    let mut entering: Scene =
        "[[group]]\nplace.point = [0, 0]\nsource = { rate = 1, end = 3 }\ngoal.errand = {}".parse().unwrap();
    plugins().equip(&mut entering);
    let east = Goal::Point { at: DVec2::new(5.0, 0.0), tolerance: 0.2 };
    assert_eq!(entering.plan().unwrap().goals, vec![east; 3]);
}

#[test]
fn journeys_keep_their_waits_and_their_end() {
    let plan = plan("goal.errand = { sort = \"round\", far = 2 }").unwrap();
    for (planned, (stops, repeat)) in plan.agents.iter().zip(journeys(&plan)) {
        let start = planned.agent.position.truncate();
        let middles: Vec<(DVec2, f32)> = stops.iter().map(|(goal, wait)| (goal.middle(), *wait)).collect();
        assert_eq!((middles, repeat), (vec![(start + DVec2::X * 2.0, 1.5), (start, 0.0)], true));
    }
}

#[test]
fn a_goal_can_be_part_of_other_goals() {
    let plan = plan("goal.journey = [{ goal.errand = {}, wait = 2 }, { goal.point = [0, 9] }]").unwrap();
    for (planned, (stops, repeat)) in plan.agents.iter().zip(journeys(&plan)) {
        let there = planned.agent.position.truncate() + DVec2::X * 5.0;
        assert_eq!((stops[0].0.middle(), stops[0].1, stops[1].0.middle()), (there, 2.0, DVec2::new(0.0, 9.0)));
        assert!(!repeat);
    }
    let nearest = self::plan("goal.nearest = [{ errand = { far = 2 } }, { point = [3, 1] }]").unwrap();
    for (planned, (stops, _)) in nearest.agents.iter().zip(journeys(&nearest)) {
        let start = planned.agent.position.truncate();
        let far = start.distance(DVec2::new(3.0, 1.0)).min(2.0);
        assert!((stops[0].0.middle().distance(start) - far).abs() < 1e-9, "{start}");
    }
}

#[test]
fn rules_have_random_numbers_of_their_own_and_agents_too() {
    let lines = "goal.journey = [{ goal.errand = { sort = \"drawn\" } }, { goal.errand = { sort = \"drawn\" } }]";
    let drawn = plan(lines).unwrap();
    let mut places: Vec<[u64; 2]> = drawn.goals.iter().map(|goal| goal.middle().to_array().map(f64::to_bits)).collect();
    assert_eq!(places.len(), 8);
    places.sort_unstable();
    places.dedup();
    assert_eq!(places.len(), 8, "all are different");
    assert_eq!(plan(lines).unwrap().goals, drawn.goals, "and the same each time");
}

#[test]
fn what_does_not_fit_is_said_with_its_place() {
    for (goal, kind, column, says) in [
        ("errnd = {}", Kind::UnknownKey, 6, "`errnd` is not one of the choices here"),
        ("errand = { fra = 2 }", Kind::UnknownKey, 17, "there is no key `fra` here"),
        ("errand = { far = 0 }", Kind::OutOfRange, 23, "far is 0, but must be more than 0"),
        ("errand = { far = \"far\" }", Kind::WrongType, 23, "but should be a number"),
        ("errand = { far = 13 }", Kind::Panic, 15, "a plug-in panicked: goal `errand`: not thirteen"),
        ("errand = { panics = 2 }", Kind::Panic, 15, "a plug-in panicked: goal `errand`: no agent 2"),
        ("errand = { sort = \"nothing\" }", Kind::MissingKey, 15, "the journey of agent 0 has no goal"),
        (
            "errand = { sort = \"nan\" }",
            Kind::OutOfRange,
            15,
            "the goal of agent 0 is at (NaN, NaN), which is no place",
        ),
        (
            "errand = { sort = \"exact\" }",
            Kind::OutOfRange,
            15,
            "agent 0 has a tolerance of 0, but it must be more than 0",
        ),
        ("errand = { sort = \"early\" }", Kind::OutOfRange, 15, "agent 0 waits -1 seconds, but must wait 0 or more"),
        ("errand = { sort = \"flat\" }", Kind::Geometry, 15, "the goal of agent 0 has 2 corners"),
        ("journey = [{ goal.errand = { sort = \"round\" } }]", Kind::Conflict, 33, "so that it cannot be a stop"),
        ("nearest = [{ errand = { panics = 0 } }]", Kind::Panic, 28, "goal `errand`: no agent 0"),
    ] {
        let error = plan(&format!("goal.{goal}")).unwrap_err();
        assert!(error.message.contains(says), "{goal}: {error}");
        assert_eq!((error.kind, error.at), (kind, Some((4, column))), "{goal}: {error}");
    }
    let hint = plan("goal.errnd = {}").unwrap_err().hint.unwrap();
    assert!(hint.contains("did you mean `errand`?") && hint.contains("nearest, choice, errand"), "{hint}");
}

#[test]
fn goals_in_walls_are_refused() {
    let wall = "\n[[obstacle]]\nname = \"block\"\nshape.rectangle = { center = [5, 0], size = [6, 6] }\n";
    let lines = |goal: &str| format!("place.line = {{ from = [-3, 0], to = [-1, 0] }}\ngoal.errand = {goal}{wall}");
    let text = |goal: &str| format!("[[group]]\ncount = 4\n{}", lines(goal));
    for (goal, says) in [
        ("{ far = 6 }", "the goal of agent 0, (3, 0), is inside obstacle `block`"),
        ("{ sort = \"side\" }", "the goal's area lies in a wall or off the walkable ground"),
    ] {
        let mut scene: Scene = text(goal).parse().unwrap();
        plugins().equip(&mut scene);
        let error = scene.plan().unwrap_err();
        assert!(error.kind == Kind::GoalInWall && error.message.contains(says), "{error}");
    }
}

#[test]
fn what_is_said_is_written_as_it_was() {
    let scene = scene("goal.journey = [{ goal.errand = { far = 2 }, wait = 1.5 }, { goal.point = [0, 9] }]");
    let again: Scene = scene.to_toml().unwrap().parse().unwrap();
    assert_eq!(scene, again);
}

#[test]
fn the_schema_has_the_goals_and_their_parameters() {
    let sound = jsonschema::validator_for(&plugins().schema()).unwrap();
    for (goal, good) in [
        ("errand = {}", true),
        ("errand = { far = 2, sort = \"side\" }", true),
        ("errand = { far = 0 }", false),
        ("errand = { sort = \"upside\" }", false),
        ("journey = [{ goal.errand = { far = 2 } }]", true),
        ("journey = [{ goal.errand = { far = 0 } }]", false),
        ("errnd = {}", false),
    ] {
        let text: toml::Value = toml::from_str(&format!("[[group]]\nplace.point = [0, 0]\ngoal.{goal}")).unwrap();
        assert_eq!(sound.is_valid(&serde_json::to_value(text).unwrap()), good, "{goal}");
    }
}
