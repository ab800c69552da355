//! Floor plans and JuPedSim scenarios become plain scenes.

use super::data::data;
use super::run::{files, run};
use std::path::PathBuf;
use throng_scene::{ChoiceGoal, Described, ExitGoal, Goal, JourneyGoal, Kind, Scene, Walkable, import, open};

#[test]
fn every_jupedsim_scenario_becomes_a_scene_that_builds() {
    let folder = data("jupedsim");
    let mut agents = vec![];
    for path in files(&folder) {
        let imported = open(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let (_, built) = imported.scene.build().unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let text = imported.scene.to_toml().unwrap();
        assert_eq!(text.parse::<Scene>().unwrap(), imported.scene, "{}", path.display());
        assert!(!imported.notes.is_empty());
        agents.push((path.file_name().unwrap().to_str().unwrap().to_owned(), built.agents));
    }
    let expected = [
        ("Rimea-10.zip", 13),
        ("bottleneck-zone", 50),
        ("bottleneck.zip", 50),
        ("corridor_simple.json", 10),
        ("issue_15_narrow_exit.json", 1),
        ("quickstart.zip", 104),
        ("scenario.zip", 6),
        ("stage-routing-square-room", 10),
        ("template-scenario.zip", 20),
        ("waiting-stage-corridor", 6),
    ];
    assert_eq!(agents, expected.map(|(name, n)| (name.to_owned(), n)));
}

#[test]
fn stages_and_waiting_times_become_journeys() {
    let folder = data("jupedsim");
    let scene = open(folder.join("stage-routing-square-room")).unwrap().scene;
    let JourneyGoal(stops) = scene.groups[0].goal.as_ref().and_then(Goal::read).unwrap();
    assert_eq!(stops.len(), 3);
    assert_eq!(stops[0].wait, Some(5.0.into()));
    assert!(stops[1].wait.is_none() && stops[2].goal.name == ExitGoal::NAME);
    assert_eq!((scene.seed, scene.time.limit), (42, 80.0));
}

#[test]
fn what_does_not_map_is_said() {
    let folder = data("jupedsim");
    let notes = open(folder.join("issue_15_narrow_exit.json")).unwrap().notes.join("\n");
    assert!(notes.contains("jps-zones_0: zone with 0.5 times the speed: left out"), "{notes}");
    assert!(notes.contains("jps-exits_0: no room for") && notes.contains("made larger"), "{notes}");
    let notes = open(folder.join("quickstart.zip")).unwrap().notes.join("\n");
    assert!(notes.contains("the model WarpDriverModel"), "{notes}");
    assert!(notes.contains("jps-distributions_0, jps-distributions_1 and 10 more: no journey"), "{notes}");
}

#[test]
fn every_jupedsim_scenario_runs_to_its_end() {
    let folder = data("jupedsim");
    for path in files(&folder) {
        let what = path.display().to_string();
        assert!(run(&what, &open(&path).unwrap().scene), "{what}: not all agents arrived");
    }
}

#[test]
fn flows_premovement_and_weights_map() {
    let config = r#"{
        "walkable_area_wkt": "POLYGON ((0 0, 20 0, 20 5, 0 5, 0 0))",
        "distributions": { "d": {
            "coordinates": [[0, 0], [4, 0], [4, 5], [0, 5]],
            "parameters": {
                "number": 10, "radius": 0.2, "radius_distribution": "uniform", "radius_min": 0.1, "radius_max": 0.2,
                "v0": 1.2, "v0_distribution": "gaussian", "v0_std": 0.1,
                "use_flow_spawning": true, "flow_start_time": 5, "flow_end_time": 10,
                "use_premovement": true, "premovement_distribution": "uniform",
                "premovement_param_a": 1, "premovement_param_b": 3
            },
            "journey_weights": [{ "journey_id": "a", "weight": 70 }, { "journey_id": "b", "weight": 30 }]
        } },
        "exits": { "e": { "coordinates": [[18, 0], [20, 0], [20, 5], [18, 5]] } },
        "checkpoints": { "c": { "coordinates": [[9, 1], [10, 1], [10, 2], [9, 2]], "waiting_time": 2 } },
        "journeys_v2": [{ "id": "a", "sequence": ["e"] }, { "id": "b", "sequence": ["c", "e"] }]
    }"#;
    let imported = import::jupedsim::from_text(config, None).unwrap();
    let group = &imported.scene.groups[0];
    let ChoiceGoal(list) = group.goal.as_ref().and_then(Goal::read).unwrap();
    assert!(list[0].weight == 70.0 && list.len() == 2);
    let plan = imported.scene.plan().unwrap();
    let times: Vec<f64> = plan.agents.iter().map(|a| a.enters.unwrap()).collect();
    assert_eq!((times[0], times[9]), (5.0, 9.5));
    for planned in &plan.agents {
        let wait = plan.journeys[planned.journey.unwrap()].stops[0].1;
        assert!((1.0..=3.0).contains(&wait) && (0.1..=0.2).contains(&planned.agent.radius));
    }
}

#[test]
fn nested_collections_and_multipolygons_are_flattened() {
    let text = "GEOMETRYCOLLECTION (GEOMETRYCOLLECTION (POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 2 1, 2 2, 1 1))), \
                MULTIPOLYGON (((5 5, 6 5, 6 6, 5 5)), ((7 7, 8 7, 8 8, 7 7))), POINT (1 1))";
    let areas = import::wkt::areas(text).unwrap();
    assert_eq!(areas.len(), 3);
    assert_eq!((areas[0].outer.len(), areas[0].holes[0].len()), (4, 3));
    for wrong in ["", "POLYGON ((0 0", "POINT (1 1)", "hello", &"GEOMETRYCOLLECTION (".repeat(100_000)] {
        assert!(import::wkt::areas(wrong).is_err(), "{wrong:.40}");
    }
}

#[test]
fn a_floor_plan_alone_is_no_scene_but_can_become_one() {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.wkt");
    std::fs::write(&plan, "POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0))").unwrap();
    let error = open(&plan).unwrap_err();
    assert_eq!(error.kind, Kind::NotAScene);
    assert!(error.hint.as_deref().is_some_and(|hint| hint.contains("walkable.file = \"plan.wkt\"")), "{error}");

    let ask = import::plan::PlanOptions { exit: Some([18.0, 4.0, 2.0, 2.0]), people: Some(50), ..Default::default() };
    let scene = import::plan::load(&plan, &ask).unwrap().scene;
    assert!(matches!(scene.walkable, Some(Walkable::Polygon(_))));
    assert_eq!(scene.plan().unwrap().agents.len(), 50);

    let file = folder.path().join("scene.toml");
    std::fs::write(&file, "walkable.file = \"plan.wkt\"\n[[group]]\nplace.point = [1, 1]\n").unwrap();
    let scene = Scene::load(&file).unwrap();
    assert_eq!(scene.plan().unwrap().walkable[0].outer.len(), 4);

    std::fs::write(&plan, "POLYGON ((0 0, 20 10, 20 0, 0 10, 0 0))").unwrap();
    let error = scene.plan().unwrap_err();
    assert_eq!(error.kind, Kind::Geometry);
    assert!(
        error.to_string().contains("plan.wkt: polygon 1: this outline crosses itself at (10.000, 5.000)"),
        "{error}"
    );
}

#[test]
fn what_is_no_scene_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let kind = |path: PathBuf| open(path).unwrap_err().kind;
    assert_eq!(kind(path("a.zip", "not a zip")), Kind::Syntax);
    assert_eq!(kind(path("a.json", "{ ")), Kind::Syntax);
    assert_eq!(kind(path("b.json", "{}")), Kind::NotAScene);
    assert_eq!(kind(path("a.png", "")), Kind::NotAScene);
    assert_eq!(kind(folder.path().to_owned()), Kind::File);
    assert_eq!(open("nowhere").unwrap_err().kind, Kind::UnknownScene);
    assert_eq!(open("circle").unwrap().scene.title, "Ring of 36");
}

#[test]
fn an_obj_file_becomes_a_surface() {
    use throng::space::surface::Surface;
    // a cube with its lower corner at the origin, y up, with statements that a surface does not need
    let cube = "# a cube\nmtllib none.mtl\no cube\nv 0 0 0\nv 2 0 0 1.0\nv 2 3 0\nv 0 3 0\nvn 0 0 1\nvt 0 0\n\
        v 0 0 -4 0.5 0.5 0.5\nv 2 0 -4\nv 2 3 -4\nv 0 3 -4 # the last\ns off\n\
        f 1/1/1 2/1/1 3//1 4\nf 5 8 7 6\nf 1 5 6 2\nf -5 -6 -2 -1\nf 1 4 8 5\nf 2 6 7 3\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cube.obj");
    std::fs::write(&path, cube).unwrap();
    let mesh = import::obj::load(&path, import::obj::ObjUp::Y).unwrap();
    assert!(mesh.is_closed() && mesh.len() == 12);
    let bounds = mesh.bounds();
    assert_eq!((bounds.low.to_array(), bounds.high.to_array()), ([0.0, 0.0, 0.0], [2.0, 4.0, 3.0]));
    assert_eq!(mesh.query(glam::Vec3::new(1.0, 2.0, 2.5)).distance, -0.5);
}

#[test]
fn a_face_that_is_not_convex_is_cut_into_triangles() {
    // a concave arrow head, in space
    let text = "v 0 0 5\nv 1 0 5\nv 0 1 5\nv 0.1 0.1 5\nf 1 2 4 3\n";
    let import::obj::Triangles { points, triangles } = import::obj::triangles(text, import::obj::ObjUp::Z).unwrap();
    assert_eq!(triangles.len(), 2);
    let size = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|i| points[i as usize]);
        (b - a).cross(c - a).z * 0.5
    };
    assert!(triangles.iter().all(|triangle| size(*triangle) > 0.0), "{triangles:?}");
    assert!((triangles.iter().map(|triangle| size(*triangle)).sum::<f32>() - 0.1).abs() < 1e-6);
}

#[test]
fn errors_in_an_obj_file_have_their_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("it.obj");
    let says = |text: &str, expected: &str| {
        std::fs::write(&path, text).unwrap();
        let error = import::obj::load(&path, import::obj::ObjUp::Z).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    };
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.1 0.1 0\n";
    says("", "it.obj: this file has no faces");
    says(points, "it.obj: this file has no faces");
    says("v 0 0\n", "it.obj:1:1: this point has 2 coordinates, but needs 3");
    says("v 0 0 0\nv 0 x 0", "it.obj:2:5: `x` is not a number");
    says("v 0 NaN 0", "it.obj:1:5: the coordinate `NaN` is not finite");
    says("v 0 0 1e99", "it.obj:1:7: the coordinate `1e99` is not finite");
    says(&format!("{points}f 1 2"), "it.obj:5:1: this face has 2 corners, but needs at least 3");
    says(&format!("{points}f 1 2 5"), "it.obj:5:7: there is no point 5");
    says(&format!("{points}f 0 1 2"), "it.obj:5:3: there is no point 0");
    says(&format!("{points}f 1 2 -5"), "it.obj:5:7: there is no point -5");
    says(&format!("{points}f 1 a/2 3"), "it.obj:5:5: `a/2` names no point");
    says("v 0 0 0\nf 1 1 1\n", "it.obj: a mesh: it has no triangle with three different corners");
    let error = import::obj::load(folder.path().join("none.obj"), import::obj::ObjUp::Z).unwrap_err().to_string();
    assert!(error.contains("none.obj"), "{error}");
}
