//! Menge projects become scenes.

use super::data::data;
use std::path::PathBuf;
use throng_scene::{
    AreaGoal, ChoiceGoal, CycleGoal, Goal, JourneyGoal, Kind, Number, PointGoal, PointsPlace, Region, Shape, Walkable,
    import, open,
};

const SCENE: &str = r#"<Experiment version="2.0">
    <Common time_step="0.1" />
    <AgentProfile name="one">
        <Common max_neighbors="8" obstacleSet="1" neighbor_dist="4" r="0.2" pref_speed="1.1" max_speed="2" max_accel="5" priority="0.5">
            <Property name="pref_speed" dist="u" min="0.9" max="1.3" />
        </Common>
        <ORCA tau="3.0" tauObst="0.15" />
    </AgentProfile>
    <AgentProfile name="two" inherits="one"><Common r="0.3" /></AgentProfile>
    <AgentGroup>
        <ProfileSelector type="const" name="two" />
        <StateSelector type="const" name="Walk" />
        <Generator type="rect_grid" anchor_x="1" anchor_y="2" offset_x="1" offset_y="2" count_x="2" count_y="3" rotation="90" />
    </AgentGroup>
    <ObstacleSet type="explicit" class="1">
        <Obstacle closed="1"><Vertex p_x="-20" p_y="-20" /><Vertex p_x="-20" p_y="20" /><Vertex p_x="20" p_y="20" /><Vertex p_x="20" p_y="-20" /></Obstacle>
        <Obstacle closed="1"><Vertex p_x="4" p_y="-1" /><Vertex p_x="6" p_y="-1" /><Vertex p_x="6" p_y="1" /></Obstacle>
        <Obstacle closed="0"><Vertex p_x="8" p_y="0" /><Vertex p_x="8" p_y="4" /></Obstacle>
    </ObstacleSet>
    <ObstacleSet type="explicit" class="2"><Obstacle closed="1"><Vertex p_x="0" p_y="0" /><Vertex p_x="1" p_y="0" /></Obstacle></ObstacleSet>
</Experiment>"#;

const BEHAVIOR: &str = r#"<BFSM>
    <GoalSet id="0"><Goal type="point" id="0" x="10" y="10" /><Goal type="AABB" id="1" min_x="12" min_y="-4" max_x="16" max_y="-2" /></GoalSet>
    <State name="Walk" final="0"><GoalSelector type="explicit" goal_set="0" goal="0" /><VelComponent type="goal" /></State>
    <State name="Rest" final="0"><GoalSelector type="identity" /><VelComponent type="zero" /></State>
    <State name="Leave" final="0"><GoalSelector type="explicit" goal_set="0" goal="1" /><VelComponent type="goal" /></State>
    <State name="Done" final="1"><GoalSelector type="identity" /></State>
    <Transition from="Walk" to="Rest"><Condition type="goal_reached" distance="0.5" /></Transition>
    <Transition from="Rest" to="Leave"><Condition type="timer" dist="u" min="2" max="4" per_agent="1" /></Transition>
    <Transition from="Leave" to="Done"><Condition type="goal_reached" distance="0.25" /></Transition>
    <Transition from="Walk,Leave" to="Done"><Condition type="agent_property" /></Transition>
</BFSM>"#;

/// Writes a project of a scene and a behaviour into a new folder.
fn project(scene: &str, behavior: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("itS.xml"), scene).unwrap();
    std::fs::write(folder.path().join("itB.xml"), behavior).unwrap();
    let path = folder.path().to_owned();
    (folder, path)
}

#[test]
fn profiles_generators_obstacles_and_states_map() {
    let (_keep, folder) = project(SCENE, BEHAVIOR);
    let imported = open(&folder).unwrap_or_else(|error| panic!("{error}"));
    let (scene, notes) = (imported.scene, imported.notes.join("\n"));
    assert_eq!(open(folder.join("itS.xml")).unwrap().scene, scene);
    assert_eq!(open(folder.join("itB.xml")).unwrap().scene, scene);
    scene.build().unwrap_or_else(|error| panic!("{error}"));
    let [group] = scene.groups.as_slice() else { panic!("{:?}", scene.groups) };
    assert_eq!((group.name.as_str(), group.priority, scene.time.step), ("two", 0.5, 0.1));
    assert!(matches!(group.body, throng_scene::Body::Radius(Number::Constant(0.3))));
    assert_eq!(group.speed.preferred, Number::Uniform([0.9, 1.3]));
    // rotated by 90 degrees: x becomes y and y becomes -x
    let PointsPlace(points) = group.place.read().unwrap();
    let expected = [[1.0, 2.0], [1.0, 3.0], [-1.0, 2.0], [-1.0, 3.0], [-3.0, 2.0], [-3.0, 3.0]];
    assert!(points.iter().zip(expected).all(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1]) < 1e-6), "{points:?}");
    // a clockwise outline has all agents inside
    assert!(matches!(&scene.walkable, Some(Walkable::Polygon(area)) if area.outer.len() == 4));
    let shapes: Vec<&Shape> = scene.obstacles.iter().map(|obstacle| &obstacle.shape).collect();
    assert!(matches!(shapes.as_slice(), [Shape::Polygon(_), Shape::Wall(_)]), "{shapes:?}");
    assert!(notes.contains("obstacles of class 2: no profile heeds them: left out"), "{notes}");
    assert!(notes.contains("left out (condition `agent_property`)"), "{notes}");
    let JourneyGoal(stops) = group.goal.as_ref().and_then(Goal::read).unwrap();
    assert_eq!(stops[0].goal.read(), Some(PointGoal { at: [10.0, 10.0], tolerance: 0.5 }));
    assert_eq!(stops[0].wait, Some(Number::Uniform([2.0, 4.0])));
    assert!(
        matches!(stops[1].goal.read(), Some(AreaGoal(Region::Rectangle(r))) if r.center == [14.0, -3.0] && r.size == [4.5, 2.5])
    );
    assert_eq!(stops.len(), 2);
}

#[test]
fn a_lattice_has_six_neighbours_at_the_same_distance() {
    let lattice = |says: &str| {
        let grid = r#"type="rect_grid" anchor_x="1" anchor_y="2" offset_x="1" offset_y="2" count_x="2" count_y="3" rotation="90""#;
        let generator = format!(r#"type="hex_lattice" anchor_x="3" anchor_y="2" density="1.2" width="7.5" {says}"#);
        let (_keep, folder) = project(&SCENE.replace(grid, &generator), BEHAVIOR);
        let imported = open(&folder).unwrap_or_else(|error| panic!("{error}"));
        let PointsPlace(points) = imported.scene.groups[0].place.read().unwrap();
        points
    };
    // discs with a density of 1.2 in the densest packing: each has a hexagon of 1 / 1.2 m²
    let apart = (2.0 / (1.2 * 3f64.sqrt())).sqrt();
    for (direction, count) in [("x", 52), ("y", 56)] {
        let says = |more: &str| format!(r#"row_direction="{direction}" population="50" {more}"#);
        let points = lattice(&says(r#"alignment="center""#));
        assert_eq!(points.len(), count, "{direction}");
        let near =
            |p: &[f64; 2]| points.iter().filter(|q| ((p[0] - q[0]).hypot(p[1] - q[1]) - apart).abs() < 1e-6).count();
        let least = points
            .iter()
            .flat_map(|p| points.iter().map(move |q| (p[0] - q[0]).hypot(p[1] - q[1])))
            .filter(|d| *d > 0.0);
        assert!((least.fold(f64::INFINITY, f64::min) - apart).abs() < 1e-6);
        assert!(points.iter().filter(|p| near(p) == 6).count() > count / 2 && points.iter().all(|p| near(p) <= 6));
        // the first row is centred on the anchor; rotated, along y
        let reach = |points: &[[f64; 2]], k: usize| {
            points.iter().map(|p| p[k]).fold([9e9_f64, -9e9], |[a, b], x: f64| [a.min(x), b.max(x)])
        };
        let [left, right] = reach(&points, 0);
        assert!(((left + right) * 0.5 - 3.0).abs() < 1e-6 && right - left <= 7.5, "{left} to {right}");
        let [low, high] = reach(&lattice(&says(r#"alignment="center" rotation="90""#)), 1);
        assert!(((low + high) * 0.5 - 2.0).abs() < 1e-6, "{low} to {high}");
        assert!((reach(&lattice(&says(r#"alignment="left""#)), 0)[0] - 3.0).abs() < 1e-6);
        assert!((reach(&lattice(&says(r#"alignment="right""#)), 0)[1] - 3.0).abs() < 1e-6);
    }
}

#[test]
fn where_states_are_drawn_and_come_back_people_go_round() {
    let behavior = BEHAVIOR
        .replace(r#"to="Leave"><Condition type="timer" dist="u" min="2" max="4" per_agent="1" />"#, r#"><Condition type="auto" /><Target type="prob"><State name="Walk" weight="3" /><State name="Leave" weight="1" /></Target>"#);
    let (_keep, folder) = project(SCENE, &behavior);
    let imported = open(&folder).unwrap_or_else(|error| panic!("{error}"));
    let ChoiceGoal(choice) = imported.scene.groups[0].goal.as_ref().and_then(Goal::read).unwrap();
    let weights: Vec<f64> = choice.iter().map(|one| one.weight).collect();
    assert_eq!(weights, [0.75, 0.25]);
    assert_eq!(choice[0].goal.read().map(|CycleGoal(stops)| stops.len()), Some(1));
    assert_eq!(choice[1].goal.read().map(|JourneyGoal(stops)| stops.len()), Some(2));
    assert!(imported.notes.iter().any(|note| note.contains("drawn once, at the start")), "{:?}", imported.notes);
}

#[test]
fn errors_in_a_project_have_their_position() {
    let says = |scene: &str, behavior: &str, expected: &str| {
        let (_keep, folder) = project(scene, behavior);
        let error = open(&folder).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    };
    says("<Experiment>", BEHAVIOR, "itS.xml:1:1: this is not XML");
    says("<BFSM/>", BEHAVIOR, "itS.xml:1:1: this is no scene of Menge's");
    says("<Experiment/>", BEHAVIOR, "itS.xml:1:1: this scene has no <AgentGroup>");
    says(SCENE, "<x/>", "itB.xml:1:1: this is no behaviour of Menge's");
    says(&SCENE.replace("\"Walk\"", "\"Wander\""), BEHAVIOR, "agents begin in the state `Wander`");
    says(&SCENE.replace("name=\"two\" />", "name=\"six\" />"), BEHAVIOR, "itS.xml:11:9: there is no profile `six`");
    says(&SCENE.replace("r=\"0.3\"", "r=\"wide\""), BEHAVIOR, "itS.xml:9:45: `r` is `wide`, which is no number");
    says(&SCENE.replace("r=\"0.3\"", "r=\"-1\""), BEHAVIOR, "`r` can be less than 0.001");
    says(&SCENE.replace("anchor_x=\"1\"", ""), BEHAVIOR, "<Generator> has no `anchor_x`");
    says(&SCENE.replace("count_x=\"2\"", "count_x=\"2e9\""), BEHAVIOR, "make the group larger than 1000000");
    says(&SCENE.replace("rect_grid", "hex_lattice"), BEHAVIOR, "<Generator> has no `density`");
    says(&SCENE.replace("rect_grid", "spiral"), BEHAVIOR, "generators of the kind `spiral` are not read");
    says(
        SCENE,
        &BEHAVIOR.replace("to=\"Done\"", "to=\"Gone\""),
        "there is no state `Gone` for this transition to lead to",
    );
    says(SCENE, &BEHAVIOR.replace("dist=\"u\"", "dist=\"q\""), "there is no distribution `q`");
}

#[test]
fn missing_files_are_errors() {
    let (_keep, folder) = project(SCENE, BEHAVIOR);
    std::fs::write(folder.join("otherB.xml"), BEHAVIOR).unwrap();
    std::fs::write(folder.join("thirdB.xml"), BEHAVIOR).unwrap();
    // the scene's own behaviour is found by its name
    assert!(open(folder.join("itS.xml")).is_ok());
    std::fs::remove_file(folder.join("itB.xml")).unwrap();
    let error = open(folder.join("itS.xml")).unwrap_err();
    assert_eq!(error.kind, Kind::NotAScene);
    assert!(error.message.contains("more than one behaviour: otherB.xml, thirdB.xml"), "{error}");
    let path = folder.join("project.xml");
    std::fs::write(&path, r#"<Project scene="itS.xml" behavior="none.xml" />"#).unwrap();
    assert!(open(&path).unwrap_err().message.contains("none.xml"));
    std::fs::write(&path, "<Page />").unwrap();
    assert!(open(&path).unwrap_err().message.contains("the root <Page>"));
}

/// All example projects, with their numbers of agents.
const PROJECTS: [(&str, usize); 10] = [
    ("bottleneck.xml", 5),
    ("circle.xml", 100),
    ("concave", 1),
    ("headon.xml", 2),
    ("maze-roadmap.xml", 0),
    ("maze/mazeFieldB.xml", 0),
    ("maze/mazeMapB.xml", 0),
    ("maze/mazeNMB.xml", 0),
    ("office.xml", 48),
    ("stadium.xml", 90),
];

#[test]
fn every_project_of_the_examples_opens_and_runs() {
    let folder = data("menge");
    for (name, agents) in PROJECTS {
        let imported = import::menge::load(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let (mut world, built) = imported.scene.build().unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(agents == 0 || built.agents == agents, "{name}: {}", built.agents);
        for _ in 0..100 {
            world.step();
        }
        let summary = world.summary();
        assert!(summary.least_separation.min(summary.least_wall_separation) >= 0.9999, "{name}: {summary:?}");
        assert!(summary.stuck < summary.agents, "{name}: {summary:?}");
    }
}
