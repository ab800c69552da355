//! `throng sweep`: plans, tables, interrupts, parts.

use crate::shared::{call, folder, names, stderr, stdout};
use serde_json::Value;
use std::path::Path;

/// A room with a door; one number is its width.
const DOOR: &str = "\
time = { step = 0.05, until = \"empty\", limit = 60.0 }

[walkable]
rectangles = [
    { center = [-2.0, 0.0], size = [4.0, 4.0] },
    { center = [0.5, 0.0], size = [1.02, 1.0] },
    { center = [3.0, 0.0], size = [4.0, 4.0] },
]

[[group]]
count = 12
place.rectangle = { center = [-2.0, 0.0], size = [3.6, 3.6] }
goal.exit.rectangle = { center = [4.5, 0.0], size = [1.0, 4.0] }

[expect]
arrived = \"all\"
";

const PLAN: &str = "\
scenes = \"door.toml\"
seeds = \"3..5\"
limit = 12

[[vary]]
walkable.rectangles.1.size.1 = [0.8, 1.6]

[[vary]]
count = [5, 9]
avoid.orca.time_horizon = [1, 2]

[columns]
walkable.rectangles.1.size.1 = \"width\"

[record]
people = true

[[record.line]]
name = \"door\"
from = [0.5, -2.0]
to = [0.5, 2.0]

[[record.area]]
name = \"front\"
shape.rectangle = { center = [-0.5, 0.0], size = [1.0, 1.0] }
";

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).unwrap();
}

fn read(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).unwrap()
}

/// Creates a folder with the plan and its scene.
fn planned() -> tempfile::TempDir {
    let folder = folder();
    write(folder.path(), "door.toml", DOOR);
    write(folder.path(), "plan.toml", PLAN);
    folder
}

fn json(folder: &Path, arguments: &str) -> Value {
    serde_json::from_str(&stdout(&call(folder, &format!("{arguments} --json")).success())).unwrap()
}

/// Returns the rows of a table in JSON.
fn rows(folder: &Path, name: &str) -> Vec<Value> {
    serde_json::from_slice(&read(folder, name)).unwrap()
}

/// Returns (made, kept) of a report.
fn counts(report: &Value) -> (u64, u64) {
    (report["made"].as_u64().unwrap(), report["kept"].as_u64().unwrap())
}

#[test]
fn a_row_is_the_run_of_its_parameters_and_seed() {
    let folder = planned();
    let path = folder.path();
    let report = json(path, "sweep plan.toml -o a.json -o a.csv -o a.parquet");
    assert_eq!((counts(&report), report["runs"].as_u64()), ((12, 0), Some(12)));
    assert_eq!(names(path), ["a.csv", "a.json", "a.parquet", "a.runs", "door.toml", "plan.toml"]);
    let rows = rows(path, "a.json");
    assert_eq!(rows.len(), 12);
    // the seed changes fastest, then the last axis
    let numbered = [(0.8, 5, 1), (0.8, 9, 2), (1.6, 5, 1), (1.6, 9, 2)]
        .into_iter()
        .flat_map(|axis| [3, 4, 5].map(|seed| (axis, seed)));
    for (index, (((width, count, horizon), seed), row)) in numbered.zip(&rows).enumerate() {
        let found =
            ["index", "width", "count", "avoid.orca.time_horizon", "seed"].map(|key| row[key].as_f64().unwrap());
        assert_eq!(found, [index as f64, width, f64::from(count), f64::from(horizon), f64::from(seed)]);
        assert_eq!((&row["scene"], &row["error"]), (&Value::from("door.toml"), &Value::Null));
        if index % 4 != 1 {
            continue;
        }
        // the oracles: the run of the same scene, and the measures of its trajectories
        let set = format!(
            "--set walkable.rectangles.1.size.1={width} --set count={count} --set avoid.orca.time_horizon={horizon}"
        );
        let command = format!("run door.toml {set} --seed {seed} --limit 12 --no-expect -o run.parquet --rate 10");
        let run = json(path, &command);
        for key in [
            "agents",
            "arrived",
            "time",
            "state_hash",
            "overlaps",
            "least_separation",
            "least_wall_separation",
            "guard_share",
            "sub_steps",
            "path_ratio",
        ] {
            assert_eq!(row[key], run[key], "{key} of run {index}");
        }
        let people = &json(path, "measure run.parquet --line 0.5,-2,0.5,2 --area=-1,-0.5,1,1")["people"];
        let (line, area) = (&people["lines"][0], &people["areas"][0]);
        for (column, want) in [
            ("door.crossed", &line["crossed"]),
            ("door.flow", &line["flow"]),
            ("door.steady_flow", &line["steady_flow"]),
            ("front.density", &area["density"]),
            ("front.voronoi_density", &area["voronoi_density"]),
            ("people.speed", &people["speed"]["mean"]),
            ("people.travel_time", &people["travel_time"]["mean"]),
            ("people.nearest", &people["nearest"]),
        ] {
            let (found, want) = (row[column].as_f64(), want.as_f64());
            let close =
                found.zip(want).map_or(found == want, |(found, want)| (found - want).abs() < 1e-4 * (1.0 + want.abs()));
            assert!(close, "{column} of run {index}: {found:?}, not {want:?}");
        }
        assert_eq!(row["passed"], run["arrived"] == run["agents"], "run {index}");
    }
    // the other tables hold the same
    let csv = String::from_utf8(read(path, "a.csv")).unwrap();
    assert_eq!(csv.lines().count(), 13);
    let heads: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    assert_eq!(heads, rows[0].as_object().unwrap().keys().map(String::as_str).collect::<Vec<_>>());
    assert_eq!(&heads[..6], ["index", "scene", "width", "avoid.orca.time_horizon", "count", "seed"]);
    assert_eq!(&read(path, "a.parquet")[..4], b"PAR1");
}

#[test]
fn the_bytes_are_the_same_for_any_number_of_threads() {
    let folder = planned();
    let path = folder.path();
    for threads in [1, 3] {
        let tables = format!("-o {threads}.parquet -o {threads}.csv -o {threads}.json");
        call(path, &format!("sweep plan.toml --threads {threads} {tables} -q")).success();
    }
    for ending in ["parquet", "csv", "json"] {
        assert!(read(path, &format!("1.{ending}")) == read(path, &format!("3.{ending}")), "{ending}");
    }
}

#[test]
fn parts_make_the_same_table_as_the_whole() {
    let folder = planned();
    let path = folder.path();
    call(path, "sweep plan.toml -o whole.parquet -q").success();
    let missing = stderr(&call(path, "sweep plan.toml -o parts.parquet --collect").code(2));
    assert!(missing.contains("12 of 12 runs are not in parts.runs: 0,1,2,3,4,5,6,7 and more"), "{missing}");
    for (index, chosen) in [("7..11", 5), ("0", 1), ("1,3,5", 3), ("0..5", 6)] {
        let report = json(path, &format!("sweep plan.toml -o parts.parquet --index {index}"));
        assert_eq!((report["chosen"].as_u64(), report["files"].as_array().unwrap().len()), (Some(chosen), 0));
    }
    let missing = stderr(&call(path, "sweep plan.toml -o parts.parquet --collect").code(2));
    assert!(missing.contains("1 of 12 runs are not in parts.runs: 6") && missing.contains("--index 6"), "{missing}");
    call(path, "sweep plan.toml -o parts.parquet --index 6 -q").success();
    let report = json(path, "sweep plan.toml -o parts.parquet --collect");
    assert_eq!((counts(&report), &report["files"][0]), ((0, 12), &Value::from("parts.parquet")));
    assert!(read(path, "parts.parquet") == read(path, "whole.parquet"));
}

#[test]
fn only_what_changed_is_made_again() {
    let folder = planned();
    let path = folder.path();
    call(path, "sweep plan.toml -q").success();
    let again = |want: (u64, u64), what: &str| assert_eq!(counts(&json(path, "sweep plan.toml")), want, "{what}");
    again((0, 12), "nothing changed");
    // a comment, a title and the order of values change no run
    write(path, "plan.toml", &format!("# more\ntitle = \"x\"\n{}", PLAN.replace("[0.8, 1.6]", "[1.6, 0.8]")));
    write(path, "door.toml", &format!("# more\n{DOOR}"));
    again((0, 12), "order and comments");
    write(path, "plan.toml", &PLAN.replace("[0.8, 1.6]", "[0.8, 1.2, 1.6]"));
    again((6, 12), "one more width");
    write(path, "plan.toml", &PLAN.replace("\"3..5\"", "[3, 9]"));
    again((4, 4), "another seed");
    write(path, "plan.toml", &PLAN.replace("limit = 12", "limit = 11"));
    again((12, 0), "another limit");
    write(path, "plan.toml", PLAN);
    write(path, "door.toml", &DOOR.replace("until = \"empty\"", "until = \"limit\""));
    again((12, 0), "another scene");
    // damaged results are made again
    for entry in std::fs::read_dir(path.join("plan.runs")).unwrap() {
        std::fs::write(entry.unwrap().path(), "{").unwrap();
    }
    again((12, 0), "damaged results");
}

#[test]
fn a_file_that_the_scene_names_belongs_to_its_runs() {
    let folder = folder();
    let path = folder.path();
    let ground =
        |width: f64| write(path, "hall.wkt", &format!("POLYGON ((-1 -2, {width} -2, {width} 2, -1 2, -1 -2))"));
    ground(9.0);
    write(path, "hall.toml", "walkable.file = \"hall.wkt\"\n[[group]]\nplace.point = [0, 0]\ngoal.point = [3, 0]\n");
    write(path, "plan.toml", "scenes = [\"hall.toml\", \"headon\"]\nseeds = [1, 2]\nlimit = 1\n");
    call(path, "sweep plan.toml -q").success();
    assert_eq!(counts(&json(path, "sweep plan.toml")), (0, 4));
    ground(8.0);
    assert_eq!(counts(&json(path, "sweep plan.toml")), (2, 2));
}

#[test]
fn a_run_that_cannot_be_made_has_a_row_and_the_others_go_on() {
    let folder = planned();
    let path = folder.path();
    write(path, "plan.toml", &PLAN.replace("count = [5, 9]", "count = [5, 100000]"));
    let told = stdout(&call(path, "sweep plan.toml -o a.json -o a.parquet").code(1));
    assert!(told.contains("12 runs; 12 made now, 0 kept before") && told.contains("run 3 could not be made"), "{told}");
    assert!(told.contains("and 1 more could not be made") && told.contains("wrote a.json"), "{told}");
    let rows = rows(path, "a.json");
    for (index, row) in rows.iter().enumerate() {
        let fails = index / 3 % 2 == 1;
        assert_eq!((row["error"].is_string(), row["state_hash"].is_null()), (fails, fails), "{row}");
    }
    let report = call(path, "sweep plan.toml -o a.json -o a.parquet --json").code(1);
    let report: Value = serde_json::from_str(&stdout(&report)).unwrap();
    assert_eq!((counts(&report), &report["failed"][0]["index"]), ((0, 12), &Value::from(3)));
}

#[test]
fn a_dry_run_lists_the_runs_and_makes_none() {
    let folder = planned();
    let path = folder.path();
    let list = stdout(&call(path, "sweep plan.toml --dry-run").success());
    assert_eq!(list.lines().count(), 14, "{list}");
    assert!(list.starts_with("  run      scene  width  avoid.orca.time_horizon  count  seed"), "{list}");
    assert!(list.ends_with("12 of 12 runs, 0 of them finished and kept in plan.runs\n"), "{list}");
    assert_eq!(names(path), ["door.toml", "plan.toml"]);
    call(path, "sweep plan.toml --index 4 -q").success();
    let list = json(path, "sweep plan.toml --dry-run --index 3..5");
    let kept: Vec<_> =
        list["list"].as_array().unwrap().iter().map(|run| (run["index"].as_u64(), run["kept"].as_bool())).collect();
    assert_eq!(kept, [(Some(3), Some(false)), (Some(4), Some(true)), (Some(5), Some(false))]);
    assert_eq!(list["list"][0]["parameters"]["count"], 9);
}

/// Asserts that a changed plan is refused with a message that contains all of `wanted`, and nothing is written.
fn refuses(from: &str, to: &str, wanted: &[&str]) {
    let folder = planned();
    assert!(PLAN.contains(from), "{from}");
    write(folder.path(), "plan.toml", &PLAN.replacen(from, to, 1));
    let message = stderr(&call(folder.path(), "sweep plan.toml").code(2));
    wanted.iter().for_each(|part| assert!(message.contains(part), "{part:?} is not in:\n{message}"));
    assert_eq!(names(folder.path()), ["door.toml", "plan.toml"]);
}

#[test]
fn mistakes_of_plans_appear_before_anything_runs() {
    refuses(
        "count =",
        "coutn =",
        &["error: plan.toml:9:1: coutn = 5 in the scene `door.toml`: there is no key `coutn`", "did you mean `count`?"],
    );
    refuses("[5, 9]", "[5, \"many\"]", &["plan.toml:9:13: count = \"many\" in the scene `door.toml`"]);
    refuses(
        "[1, 2]",
        "[1, 2, 3]",
        &["plan.toml:9:9:", "`count` has 2 values, and `avoid.orca.time_horizon` has 3", "a [[vary]] each"],
    );
    refuses("[0.8, 1.6]", "[]", &["plan.toml:6:32:", "has no values"]);
    refuses("[0.8, 1.6]", "{ from = 2, to = 1, by = 0.1 }", &["plan.toml:6:", "is a range from 2 to 1"]);
    refuses("[0.8, 1.6]", "{ from = 0, to = 1, by = 1e-7 }", &["plan.toml:6:", "has more than 1000000 values"]);
    refuses(
        "[0.8, 1.6]",
        "{ from = 0.001, to = 1, count = 400000 }",
        &["plan.toml:5:", "the plan has more than 1000000 runs"],
    );
    refuses(
        "[[vary]]\nwalkable.rectangles.1.size.1 = [0.8, 1.6]",
        "[[vary]]",
        &["plan.toml:5:", "this table varies nothing"],
    );
    refuses("scenes = \"door.toml\"", "scenes = []", &["plan.toml:1:10:", "the plan has no scenes"]);
    refuses(
        "\"door.toml\"",
        "[\"door.toml\", \"crossign\"]",
        &["plan.toml:1:24:", "there is no scene `crossign`", "did you mean `crossing`?"],
    );
    refuses("\"door.toml\"", "\"dor.toml\"", &["plan.toml:1:10: there is no file dor.toml", "door.toml?"]);
    refuses("scenes", "scene", &["plan.toml:1:1: there is no key `scene` here", "did you mean `scenes`?"]);
    refuses("\"3..5\"", "\"5..3\"", &["plan.toml:2:9:", "5 is more than 3"]);
    refuses("\"3..5\"", "[1, 1]", &["plan.toml:2:9:", "1 is given twice"]);
    refuses("limit = 12", "limit = -1", &["plan.toml:3:9: limit is -1"]);
    refuses(
        "limit = 12",
        "set.time.limit = 5\nlimit = 12",
        &["plan.toml:3:", "`time.limit` and `limit` are both given"],
    );
    refuses("limit = 12", "set.count = 5", &["`count` is given twice"]);
    refuses("limit = 12", "set.seed = 5", &["`seed` is not a parameter", "write seeds ="]);
    refuses("= \"width\"", "= \"arrived\"", &["two columns of the table have the name `arrived`", "[columns]"]);
    refuses(
        "[columns]\nwalkable.rectangles.1.size.1",
        "[columns]\nbody.radius",
        &["plan.toml:13:", "`body.radius` does not vary"],
    );
    refuses("name = \"front\"", "name = \"people\"", &["two lines or areas have the name `people`"]);
    refuses("to = [0.5, 2.0]", "to = [0.5, -2.0]", &["the line `door` has no length"]);
    refuses("size = [1.0, 1.0]", "size = [0.0, 1.0]", &["`front` has no area"]);
    refuses("people = true", "interval = 0", &["plan.toml:16:", "interval is 0"]);
}

#[test]
fn mistakes_of_options_appear_before_anything_runs() {
    let folder = planned();
    let refuses = |arguments: &str, wanted: &[&str]| {
        let message = stderr(&call(folder.path(), &format!("sweep {arguments}")).code(2));
        wanted.iter().for_each(|part| assert!(message.contains(part), "{part:?} is not in:\n{message}"));
        assert_eq!(names(folder.path()), ["door.toml", "plan.toml"]);
    };
    refuses("no.toml", &["there is no file no.toml"]);
    refuses("plan.toml --index 12", &["--index 12: there is no run 12", "the runs are 0..11"]);
    refuses("plan.toml --index x", &["`x` is not a run: runs are whole numbers"]);
    refuses("plan.toml --index 1 --collect", &["cannot be used with"]);
    refuses("plan.toml -o a.txt", &["a.txt: cannot tell what to write", ".parquet, .csv or .json"]);
    refuses("plan.toml -o a.csv -o a.csv", &["a.csv is given twice"]);
    refuses("plan.toml -o no/a.csv", &["there is no folder no"]);
    refuses("plan.toml --runs door.toml/x", &["door.toml/x"]);
}
