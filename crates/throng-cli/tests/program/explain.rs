//! `throng explain`.

use crate::shared::{WALK, call, folder, names, stderr, stdout};
use serde_json::Value;
use std::path::Path;

fn explained(folder: &Path, arguments: &str) -> Value {
    serde_json::from_str(&stdout(&call(folder, &format!("explain {arguments} --json")).success())).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

fn vector(value: &Value) -> [f64; 2] {
    [number(&value[0]), number(&value[1])]
}

#[test]
fn it_draws_an_svg_named_after_the_scene_or_the_given_files() {
    let folder = folder();
    let output = call(folder.path(), "explain headon --agent 1 --time 2").success();
    assert_eq!(stdout(&output), "wrote headon-agent-1.svg\n");
    call(folder.path(), "explain headon -a 1 -t 2 -o a.png -o a.svg --size 400x300 --dark").success();
    assert_eq!(names(folder.path()), ["a.png", "a.svg", "headon-agent-1.svg"]);
    let svg = std::fs::read_to_string(folder.path().join("headon-agent-1.svg")).unwrap();
    assert!(svg.contains("agent 1 at 2.00 s, ORCA") && svg.contains(r#"width="1200""#));
    let dark = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(dark.contains(r#"width="400""#) && dark.contains("#20252c"));
}

#[test]
fn every_model_and_every_scene_can_be_explained() {
    let folder = folder();
    let velocity_obstacles = ["orca", "avo", "hrvo", "clearpath", "rvo", "rvo_lab", "vo"];
    let repulsion = ["collision_free_speed", "anticipation_velocity", "social_force", "moussaid_2009", "power_law"];
    for model in velocity_obstacles.into_iter().chain(repulsion) {
        for scene in ["circle", "doorway", "pillars"] {
            let set = format!("--set avoid={{{model}={{}}}}");
            let why = explained(folder.path(), &format!("{scene} --agent 3 --time 1 {set} -o {model}.svg"));
            let name = why["model"].as_str().unwrap().to_lowercase();
            assert!(name.starts_with(&model.replace('_', "")), "{name}");
            assert_eq!(why["files"][0], format!("{model}.svg"));
            let pushes = why["reasons"].as_array().unwrap().iter().any(|reason| reason["push"].is_array());
            assert_eq!(pushes, repulsion.contains(&model), "{model} in {scene}: {}", why["reasons"]);
        }
    }
}

#[test]
fn the_keys_of_the_help_are_those_of_the_json() {
    let folder = folder();
    let why = explained(folder.path(), "circle --agent 3 --time 2");
    assert_eq!(names(folder.path()), Vec::<String>::new(), "--json alone writes no picture");
    let help = stdout(&call(folder.path(), "explain --help").success());
    let keys = help.split("Keys of --json").nth(1).unwrap();
    for key in why.as_object().unwrap().keys().chain(why["neighbours"][0].as_object().unwrap().keys()) {
        assert!(keys.contains(key.as_str()), "--help does not describe {key}");
    }
    let size = vector(&why["velocity"]).iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!(size > 0.5 && size <= number(&why["max_speed"]) + 1e-6);
    assert_eq!((&why["agent"], number(&why["time"])), (&Value::from(3), 2.0));
    assert!(why["neighbours"].as_array().unwrap().iter().all(|other| number(&other["agent"]) != 3.0));
    assert_eq!(why["reasons"].as_array().unwrap().len(), why["neighbours"].as_array().unwrap().len());
}

#[test]
fn an_agent_without_neighbours_has_nothing_to_avoid() {
    let folder = folder();
    std::fs::write(folder.path().join("walk.toml"), WALK).unwrap();
    let why = explained(folder.path(), "walk.toml --agent 0 --time 1");
    assert_eq!((&why["chosen"], &why["collision"]["preferred"]), (&why["relaxed"], &Value::Null));
    call(folder.path(), "explain walk.toml --agent 0").success();
    assert_eq!(names(folder.path()), ["walk-agent-0.svg", "walk.toml"]);
}

#[test]
fn errors_say_why_an_agent_is_not_present() {
    let folder = folder();
    let late = "\
[[group]]
name = \"late\"
place.point = [0.0, 3.0]
goal.exit.rectangle = { center = [2.0, 3.0], size = [1.0, 1.0] }
source = { start = 1.0, count = 1, rate = 1.0 }
";
    std::fs::write(folder.path().join("two.toml"), format!("{WALK}{late}")).unwrap();
    let refused = |arguments: &str, wanted: &[&str]| {
        let message = stderr(&call(folder.path(), &format!("explain {arguments}")).code(2));
        for part in wanted {
            assert!(message.contains(part), "{part:?} is not in:\n{message}");
        }
        assert_eq!(names(folder.path()), ["two.toml"]);
    };
    refused("two.toml --agent 7", &["there is no agent 7 in two", "0 to 1"]);
    refused("two.toml --agent 1", &["agent 1 has not entered at 0.00 s", "agents present at that time: 0"]);
    refused("two.toml --agent 1 --time 3.5", &["agent 1 has left at 3.52 s", "agents present at that time: 0"]);
    refused("two.toml --agent 0 --time 90", &["--time 90: two ends at", "give at most --time "]);
    refused("two.toml --agent 0 -o a.mp4", &["a.mp4: `explain` draws one picture", ".png or .svg"]);
    refused("two.toml --agent 0 -o no/a.png", &["there is no folder no"]);
    refused("two.toml", &["--agent <N>"]);
    refused("two.toml --agent 0 --time=-1", &["at least 0"]);
}
