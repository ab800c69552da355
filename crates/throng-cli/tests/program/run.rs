//! `throng run`: summaries, files, expectations.

use crate::shared::{WALK, call, folder, names, stderr, stdout};
use serde_json::Value;
use std::path::Path;

/// The keys of `--json` in their order. They are documented and must stay.
const KEYS: [&str; 35] = [
    "scene",
    "agents",
    "arrived",
    "removed",
    "resting",
    "queueing",
    "waiting_for_room",
    "blocked",
    "oscillating",
    "stranded",
    "stuck",
    "without_progress_30s",
    "time",
    "time_ratio",
    "path_ratio",
    "least_separation",
    "overlaps",
    "guard_share",
    "pushed_share",
    "backwards_share",
    "heading_change_deg_per_s",
    "course_change_deg_per_s",
    "steps",
    "agent_steps_per_second",
    "figures",
    "expect",
    "sub_steps",
    "least_wall_separation",
    "state_hash",
    "swarms",
    "wall_seconds",
    "step_seconds",
    "cpu_per_simulated_second",
    "interrupted",
    "files",
];

fn json(folder: &Path, arguments: &str) -> Value {
    serde_json::from_str(&stdout(&call(folder, &format!("{arguments} --json")).success())).unwrap()
}

/// Returns the lines of a table without the heading.
fn rows(path: &Path) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn without_a_file_name_the_video_is_named_after_the_scene() {
    let folder = folder();
    let summary = json(folder.path(), "run headon --size 320x240");
    assert_eq!(names(folder.path()), ["headon.mp4"]);
    let keys: Vec<&str> = summary.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(keys, KEYS);
    assert_eq!((&summary["arrived"], &summary["agents"]), (&Value::from(2), &Value::from(2)));
    assert_eq!(summary["expect"]["passed"], true);
    assert_eq!(summary["files"], serde_json::json!(["headon.mp4"]));
    let video = std::fs::read(folder.path().join("headon.mp4")).unwrap();
    assert_eq!(&video[4..8], b"ftyp");
}

#[test]
fn help_describes_every_key() {
    let help = stdout(&call(folder().path(), "run --help").success());
    for key in KEYS {
        assert!(help.contains(key), "{key}");
    }
}

#[test]
fn several_files_at_once() {
    let folder = folder();
    let path = folder.path();
    let files = "-o a.mp4 -o b.gif -o c.png -o d.svg -o e.csv -o f/";
    call(path, &format!("run headon {files} --size 160x120 --fps 5 --duration 2 --no-expect -q")).success();
    assert_eq!(names(path), ["a.mp4", "b.gif", "c.png", "d.svg", "e.csv", "f"]);
    // 0 to 2 s at 5 pictures per second.
    assert_eq!(names(&path.join("f")).len(), 11);
    // 50 steps and the start, two agents each.
    let rows = rows(&path.join("e.csv"));
    assert_eq!(rows.len(), 51 * 2);
    assert_eq!((&rows[0][1], &rows[1][1]), (&"left".to_owned(), &"right".to_owned()));
    assert_eq!(rows[101][2], "2");
}

#[test]
fn video_can_be_faster_or_slower_than_the_scene() {
    let folder = folder();
    for (name, options, pictures) in [("fast", "--speed-up 4", 6 + 1), ("slow", "--speed-up 0.25", 100)] {
        let arguments = format!("run headon -o {name}/ --size 64x48 --duration 1 --no-expect -q {options}");
        call(folder.path(), &arguments).success();
        let found = names(&folder.path().join(name)).len();
        assert!(found.abs_diff(pictures) <= 2, "{name}: {found}");
    }
}

#[test]
fn a_chosen_moment_is_shown() {
    let folder = folder();
    call(folder.path(), "run headon -o a.svg --frame 3 -q").success();
    assert!(std::fs::read_to_string(folder.path().join("a.svg")).unwrap().contains("3.0 s"));
}

#[test]
fn values_of_the_scene_can_be_set() {
    let folder = folder();
    let plain = json(folder.path(), "run headon --no-files");
    let slow = json(folder.path(), "run headon --no-files --set speed.preferred=0.65 --set expect.within=20");
    assert!(slow["time"].as_f64().unwrap() > 1.8 * plain["time"].as_f64().unwrap());
}

#[test]
fn only_the_seed_changes_random_values() {
    let folder = folder();
    let table = |name: &str, options: &str| {
        call(folder.path(), &format!("run doorway -o {name} --duration 1 --no-expect -q {options}")).success();
        std::fs::read(folder.path().join(name)).unwrap()
    };
    let first = table("a.csv", "--seed 7 --threads 1");
    assert!(first == table("b.csv", "--seed 7 --threads 3"));
    assert!(first != table("c.csv", "--seed 8"));
}

#[test]
fn an_expectation_that_fails_gives_exit_code_1() {
    let folder = folder();
    let failed = call(folder.path(), "run headon --no-files --set expect.within=1").code(1);
    assert!(stdout(&failed).contains("within FAILED: expected 1, found 8.16"), "{}", stdout(&failed));
    call(folder.path(), "run headon --no-files --set expect.within=1 --no-expect").success();
    let report = call(folder.path(), "run headon --no-files --json --set expect.within=1").code(1);
    let report: Value = serde_json::from_str(&stdout(&report)).unwrap();
    assert_eq!(report["expect"]["passed"], false);
    assert_eq!(report["expect"]["checks"][1]["name"], "within");
    // The files are written all the same.
    call(folder.path(), "run headon -q -o a.csv --set expect.within=1").code(1);
    assert_eq!(names(folder.path()), ["a.csv"]);
}

#[test]
fn every_kind_of_expectation_is_measured() {
    let folder = folder();
    let expect = "[expect]\narrived = 1\nwithin = 9\nleast_separation = 1.0\nleast_wall_separation = 1.0\n\
                  heading_change = 90.0\nmean_speed = 1.0\nfinal_speed = 1.4\n\
                  waiting_for_room = 0\nblocked = 0\noscillating = 0\nstuck = 0\nwithout_progress_30s = 0\n\
                  flow = [{ from = [2.0, -1.0], to = [2.0, 1.0], at_most = 1.0 }]\n";
    std::fs::write(folder.path().join("walk.toml"), format!("{WALK}{expect}")).unwrap();
    let report = json(folder.path(), "run walk.toml --no-files");
    let checks = report["expect"]["checks"].as_array().unwrap();
    let names: Vec<&str> = checks.iter().map(|check| check["name"].as_str().unwrap()).collect();
    let separations = ["least_separation", "least_wall_separation"];
    let hindered = ["waiting_for_room", "blocked", "oscillating", "stuck", "without_progress_30s"];
    let speeds = ["heading_change", "mean_speed", "final_speed"];
    let all = [&["arrived", "within"][..], &separations, &speeds, &hindered, &["flow.0.at_most"]].concat();
    assert_eq!(names, all);
    // A single agent in the open has no separation.
    assert!(checks[2]["found"].is_null() && checks[2]["passed"] == true, "{}", checks[2]);
    call(folder.path(), "run walk.toml --no-files --set expect.mean_speed=1.4").code(1);
    call(folder.path(), "run walk.toml --no-files --set expect.arrived=2").code(1);
}

#[test]
fn limits() {
    let folder = folder();
    let limited = call(folder.path(), "run headon --no-files --limit 2 --json").code(1);
    let report: Value = serde_json::from_str(&stdout(&limited)).unwrap();
    assert_eq!((&report["time"], &report["steps"]), (&Value::from(2.0), &Value::from(50)));
    let longer = json(folder.path(), "run headon --no-files --duration 12");
    assert_eq!(longer["time"], 12.0);
}

#[test]
fn a_floor_plan_needs_an_exit_and_people() {
    let folder = folder();
    let plan = "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0), (4 2, 5 2, 5 3, 4 3, 4 2))";
    std::fs::write(folder.path().join("room.wkt"), plan).unwrap();
    let report = json(folder.path(), "run room.wkt --exit 9,0,1,5 --people 20 --no-files");
    assert_eq!((&report["removed"], &report["scene"]), (&Value::from(20), &Value::from("room")));
    let refused = call(folder.path(), "run room.wkt --no-files").code(2);
    assert!(stderr(&refused).contains("--exit x,y,width,height --people"));
}

#[test]
fn an_unreachable_goal_is_reported() {
    let folder = folder();
    let wall = "[[obstacle]]\nshape.wall = [[3.0,-2.0], [7.0,-2.0], [7.0,2.0], [3.0,2.0], [3.0,-2.0]]\n";
    std::fs::write(folder.path().join("walk.toml"), format!("{WALK}{wall}")).unwrap();
    let report = call(folder.path(), "run walk.toml --no-files").success();
    assert!(stdout(&report).contains("agent 0 cannot reach its goal: there is no way"), "{}", stdout(&report));
    let checked = call(folder.path(), "check walk.toml").success();
    assert!(stdout(&checked).contains("agent 0 of a cannot reach its goal: there is no way"), "{}", stdout(&checked));
}

/// Returns width and height of a PNG file.
fn size(path: &Path) -> (u32, u32) {
    let bytes = std::fs::read(path).unwrap();
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    (number(16), number(20))
}

#[test]
fn options_override_the_view_of_the_scene() {
    let folder = folder();
    let path = folder.path();
    let view = "view = { size = [320, 200], fps = 10 }\n";
    let scene = format!("{view}{}colour = \"#00ff00\"\n", WALK.replace("[5.0", "[1.0"));
    std::fs::write(path.join("walk.toml"), scene).unwrap();
    let run = |options: &str| call(path, &format!("run walk.toml -q --duration 1 {options}")).success();
    run("-o a.png -o a.svg -o a/");
    assert_eq!((size(&path.join("a.png")), names(&path.join("a")).len()), ((320, 200), 11));
    assert!(std::fs::read_to_string(path.join("a.svg")).unwrap().contains("#00ff00"));
    run("-o b.png -o b/ --size 160x120 --fps 5");
    assert_eq!((size(&path.join("b.png")), names(&path.join("b")).len()), ((160, 120), 6));
    // The size of the labs' video.
    call(path, "show circle").success();
    assert_eq!(size(&path.join("circle.png")), (640, 480));
}

/// Compares the summary of swarms with the figures of `throng measure` for a table of every step.
#[test]
fn swarms_are_measured_as_they_run() {
    let folder = folder();
    let report = json(folder.path(), "run swarm-aggregation --limit 6 --no-expect -o swarm.csv");
    let measured = json(folder.path(), "measure swarm.csv");
    let (swarm, group) = (&report["swarms"][0], &measured["groups"][0]);
    assert_eq!(report["swarms"].as_array().unwrap().len(), 1);
    assert_eq!(swarm["name"], group["name"]);
    for (found, expected) in [
        (&swarm["speed"], &group["speed"]["mean"]),
        (&swarm["speed_sd"], &group["speed"]["sd"]),
        (&swarm["nearest"], &group["nearest"]["mean"]),
        (&swarm["size"], &group["size"]),
        (&swarm["correlation_time"], &group["correlation"]["time"]),
    ] {
        let (found, expected) = (found.as_f64().unwrap(), expected.as_f64().unwrap());
        // The run measures every second step, the table every step: speeds over longer times are slightly lower.
        assert!((found / expected - 1.0).abs() < 0.1, "{found}, not {expected}");
    }
    let text = stdout(&call(folder.path(), "run swarm-aggregation --limit 1 --no-expect --no-files").success());
    assert!(text.contains("  swarm      midges: 0."), "{text}");
    assert_eq!(json(folder.path(), "run headon --no-files")["swarms"].as_array().unwrap().len(), 0);
}

#[test]
fn the_hash_is_of_the_last_state() {
    let folder = folder();
    let report = json(folder.path(), "run circle --no-files --duration 4 --no-expect");
    let (mut world, _) = throng_scene::gallery::scene("circle").unwrap().build().unwrap();
    while world.time() < 4.0 - 1e-9 {
        world.step();
    }
    assert_eq!(report["state_hash"], format!("{:016x}", world.state_hash()));
}

#[test]
fn pictures_show_the_obstacles_of_their_moment() {
    let folder = folder();
    let picture = |name: &str, more: &str| {
        let scene = format!(
            "title = \"x\"\ntime = {{ until = \"limit\", limit = 1 }}\nview = {{ min = [-9, -9], max = [9, 9] }}\n\
             [[group]]\nplace.point = [-8, -8]\ngoal.point = [8, -8]\n{more}"
        );
        std::fs::write(folder.path().join(format!("{name}.toml")), scene).unwrap();
        call(folder.path(), &format!("run {name}.toml -q -o {name}.png")).success();
        std::fs::read(folder.path().join(format!("{name}.png"))).unwrap()
    };
    let pillar = "[[obstacle]]\nshape.circle = { center = [0, 6], radius = 1 }\n";
    let bare = picture("bare", "");
    let stands = picture("stands", pillar);
    let opened = picture("opened", &format!("{pillar}[[intervention]]\ntime = 0.4\nchange.open = 0\n"));
    let built = "[[intervention]]\ntime = 0.4\nchange.obstacle.shape.circle = { center = [0, 6], radius = 1 }\n";
    assert!(opened == bare && picture("built", built) == stands && stands != bare);
}
