//! `throng bench`: the runs, the table, the files.

use crate::shared::{call, folder, names, stderr, stdout};
use serde_json::Value;
use std::path::Path;

/// The keys of `--json` in their order. They are documented and must stay.
const KEYS: [&str; 18] = [
    "work",
    "agents",
    "threads",
    "guard",
    "ns_per_agent_step",
    "least_ns_per_agent_step",
    "cpu_ns_per_agent_step",
    "stages",
    "cpu_per_simulated_second",
    "bytes_per_agent",
    "warm_up",
    "steps",
    "repeats",
    "step_seconds",
    "agent_steps",
    "version",
    "profile",
    "machine",
];

fn json(folder: &Path, arguments: &str) -> Vec<Value> {
    serde_json::from_str(&stdout(&call(folder, &format!("bench {arguments} --json -q")).success())).unwrap()
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

#[test]
fn runs_have_the_documented_keys() {
    let folder = folder();
    let runs = json(folder.path(), "crossing --agents 50 200 --threads 1,2 --guard both --steps 3 --repeat 2");
    let help = stdout(&call(folder.path(), "bench --help").success());
    for run in &runs {
        assert_eq!(keys(run), KEYS);
        assert_eq!(keys(&run["stages"]), ["perceive", "intend", "avoid", "guard", "move"]);
        for key in keys(run).into_iter().chain(keys(&run["machine"])).chain(keys(&run["stages"])) {
            assert!(help.contains(key), "{key}");
        }
        assert_eq!((&run["steps"], &run["repeats"], &run["warm_up"]), (&3.into(), &2.into(), &20.into()));
        let number = |key: &str| run[key].as_f64().unwrap();
        assert_eq!(number("agent_steps"), 3.0 * number("agents"));
        assert!(number("least_ns_per_agent_step") <= number("ns_per_agent_step"));
        let stages = run["stages"].as_object().unwrap().values().map(|ns| ns.as_f64().unwrap());
        assert!(stages.clone().all(|ns| ns > 0.0) && stages.sum::<f64>() > 0.5 * number("ns_per_agent_step"));
        // A position, a velocity and a radius alone take 20 bytes.
        assert!((20.0..1e6).contains(&number("bytes_per_agent")));
    }
    let which = |run: &Value| (run["agents"].as_u64(), run["guard"] == "on", run["threads"].as_u64());
    let wanted = [50, 200].into_iter().flat_map(|agents| {
        [false, true].into_iter().flat_map(move |guard| [1, 2].map(|threads| (Some(agents), guard, Some(threads))))
    });
    assert_eq!(runs.iter().map(which).collect::<Vec<_>>(), wanted.collect::<Vec<_>>());
}

#[test]
fn every_work_of_the_list_can_be_measured() {
    let folder = folder();
    let list = stdout(&call(folder.path(), "bench --list").success());
    let works: Vec<&str> = list.lines().map(|line| line.split_whitespace().next().unwrap()).collect();
    let runs = json(folder.path(), "all --agents 40 --threads 1 --steps 1 --warm-up 1 --repeat 1");
    assert_eq!(runs.iter().map(|run| run["work"].as_str().unwrap()).collect::<Vec<_>>(), works);
    assert!(runs.iter().all(|run| run["agents"] == 40 && run["guard"] == "off"));
}

#[test]
fn scenes_and_floor_plans_are_measured_as_they_are() {
    let folder = folder();
    let options = "--threads 1 --steps 2 --repeat 1";
    let runs = json(folder.path(), &format!("headon circle --set time.step=0.05 {options}"));
    assert_eq!(runs.iter().map(|run| run["agents"].as_u64().unwrap()).collect::<Vec<_>>(), [2, 36]);
    assert!(runs.iter().all(|run| run["guard"] == "on" && run["step_seconds"] == 0.05));
    assert_eq!(json(folder.path(), &format!("headon --guard off {options}"))[0]["guard"], "off");
    std::fs::write(folder.path().join("hall.wkt"), "POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0))").unwrap();
    let runs = json(folder.path(), &format!("hall.wkt --exit 18,4,2,2 --people 30 {options}"));
    assert_eq!((&runs[0]["work"], &runs[0]["agents"]), (&"hall".into(), &30.into()));
}

#[test]
fn the_table_and_the_files() {
    let folder = folder();
    let asked = "bench at-rest --agents 50 --threads 1 --steps 2 --repeat 1 -o a.json -o a.md";
    let shown = stdout(&call(folder.path(), asked).success());
    let lines: Vec<&str> = shown.lines().collect();
    assert!(lines[0].contains("throng 0.") && lines[0].contains("cores"), "{shown}");
    let heads: Vec<&str> = lines[1].split_whitespace().collect();
    let cells: Vec<&str> = lines[2].split_whitespace().collect();
    assert_eq!((heads.len(), cells.len()), (13, 13), "{shown}");
    assert_eq!(cells[..4], ["at-rest", "50", "1", "off"]);
    assert_eq!(lines[3..], ["wrote a.json", "wrote a.md"]);
    assert_eq!(names(folder.path()), ["a.json", "a.md"]);
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let runs: Vec<Value> = serde_json::from_str(&read("a.json")).unwrap();
    assert_eq!(runs.len(), 1);
    assert!(read("a.md").ends_with("|\n") && read("a.md").contains("\n| at-rest | 50 | 1 | off |"));
}

#[test]
fn errors_name_the_argument() {
    let folder = folder();
    let refuses = |arguments: &str, wanted: &[&str]| {
        let message = stderr(&call(folder.path(), &format!("bench {arguments}")).code(2));
        for part in wanted {
            assert!(message.contains(part), "{part:?} is not in:\n{message}");
        }
        assert_eq!(names(folder.path()), Vec::<String>::new());
    };
    refuses("--agents 0", &["'0'", "from 1 to 20000000"]);
    refuses("--agents 21M", &["'21M'", "from 1 to 20000000"]);
    refuses("--threads 0", &["'0'", "from 1 to 1024"]);
    refuses("--steps 0", &["'0'"]);
    refuses("crosing", &["no work and no scene `crosing`", "crossing", "throng list"]);
    refuses("nothing.toml", &["there is no file nothing.toml"]);
    refuses("circle --agents 5", &["--agents is for reference works", "--set count=N"]);
    refuses("crossing --seed 3", &["--seed is for scenes", "--guard change a work"]);
    refuses("-o a.csv", &["a.csv", ".json or .md"]);
    refuses("-o no/a.json", &["there is no folder no"]);
    refuses("-o a.md -o a.md", &["a.md is given twice"]);
}
