//! `throng measure`.

use crate::shared::{call, folder, names, stderr, stdout};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;

fn measured(folder: &Path, arguments: &str) -> Value {
    serde_json::from_str(&stdout(&call(folder, &format!("measure {arguments} --json")).success())).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Three who fly round circles at 2 m/s, and one of another group who stands.
fn circles() -> String {
    let mut text = "number,group,time,x,y,z\n".to_owned();
    for k in 0..400u32 {
        let time = f64::from(k) * 0.02;
        for number in 0..3u32 {
            let angle = 2.0 * time + 2.0 * f64::from(number);
            let _ = writeln!(text, "{number},flies,{time},{},{},{}", angle.cos(), angle.sin(), 10 * number);
        }
        let _ = writeln!(text, "9,post,{time},0,0,0");
    }
    text
}

#[test]
fn a_table_is_measured_group_by_group() {
    let folder = folder();
    std::fs::write(folder.path().join("run.csv"), circles()).unwrap();
    let all = measured(folder.path(), "run.csv --lag 1");
    assert_eq!((&all["groups"][0]["name"], &all["groups"][1]["name"]), (&"flies".into(), &"post".into()));
    let flies = &all["groups"][0];
    assert!((number(&flies["speed"]["mean"]) - 2.0).abs() < 1e-3 && number(&flies["agents"]) == 3.0);
    assert!((number(&flies["nearest"]["least"]) - 10.0).abs() < 0.2, "{}", flies["nearest"]);
    let axes = flies["acceleration"].as_array().unwrap();
    assert!((number(&axes[0]["most"]) - 4.0).abs() < 0.01 && number(&axes[2]["most"]) == 0.0);
    // round a circle velocities turn: the cosine falls to 1/e where that of the angle does
    let falls = (1f64 / std::f64::consts::E).acos() / 2.0;
    assert!((number(&flies["correlation"]["time"]) - falls).abs() < 2e-3, "{}", flies["correlation"]["time"]);
    assert!(all["groups"][1]["nearest"]["mean"].is_null() && all["groups"][1]["correlation"]["time"].is_null());
    let part = measured(folder.path(), "run.csv --group flies --from 2 --to 4");
    assert_eq!((part["groups"].as_array().unwrap().len(), &part["groups"][0]["moments"]), (1, &101.into()));
}

#[test]
fn a_scene_is_run_and_the_same_as_its_recording() {
    let folder = folder();
    let first = measured(folder.path(), "flocking --to 3");
    call(folder.path(), "run flocking --duration 3 -o flock.csv --no-expect -q").success();
    let second = measured(folder.path(), "flock.csv");
    let figures = |all: &Value| all["groups"].clone();
    for (a, b) in figures(&first).as_array().unwrap().iter().zip(figures(&second).as_array().unwrap()) {
        for key in ["moments", "agents", "name"] {
            assert_eq!(a[key], b[key]);
        }
        for (a, b) in [(&a["speed"]["mean"], &b["speed"]["mean"]), (&a["size"], &b["size"])] {
            assert!((number(a) - number(b)).abs() < 1e-4 * number(a).abs(), "{a} and {b}");
        }
    }
    let one = stdout(&call(folder.path(), "measure flocking --to 2 -q --threads 1 --json").success());
    assert_eq!(one, stdout(&call(folder.path(), "measure flocking --to 2 -q --threads 3 --json").success()));
}

#[test]
fn it_tells_people_and_writes_a_page() {
    let folder = folder();
    std::fs::write(folder.path().join("run.csv"), circles()).unwrap();
    let told = stdout(&call(folder.path(), "measure run.csv -o a.html").success());
    assert!(told.contains("run.csv, flies: 3 agents, 0.00 to 7.98 s, 400 moments") && told.contains("wrote a.html"));
    assert!(told.contains("autocorrelation falls to 1/e in") && told.contains("radius of gyration"), "{told}");
    let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
    assert_eq!(page.matches("<svg viewBox=\"0 0 560").count(), 16, "eight plots a group");
    assert!(!page.contains("NaN") && !page.contains("inf") && !page.contains("{{"), "{page}");
    assert_eq!(names(folder.path()), ["a.html", "run.csv"]);
}

#[test]
fn mistakes_are_named() {
    let folder = folder();
    std::fs::write(folder.path().join("run.csv"), circles()).unwrap();
    for (arguments, text) in [
        ("run.csv --group birds", "there is: flies, post"),
        ("run.csv --seed 3", "what is recorded cannot be changed"),
        ("run.csv --from 3 --to 2", "give --to more than --from"),
        ("run.csv --from 30", "nobody was there from 30 s to the end"),
        ("run.csv -o a.png", "end the name in .html"),
        ("none.csv", "cannot read none.csv"),
        ("none.toml", "none.toml"),
    ] {
        let told = stderr(&call(folder.path(), &format!("measure {arguments}")).code(2));
        assert!(told.contains(text), "{arguments}: {told}");
    }
    assert_eq!(names(folder.path()), ["run.csv"]);
}
