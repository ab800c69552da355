//! `throng validate`: the figures, the files, the exit codes.

use crate::shared::{call, folder, names, stderr, stdout};
use serde_json::Value;

#[test]
fn figures_have_the_documented_keys_and_determine_the_exit_code() {
    let folder = folder();
    let assert =
        call(folder.path(), "validate head-on --seeds 1 --set keep_right=0 --json -q -o a.html -o b.json").code(1);
    let shown: Value = serde_json::from_str(&stdout(&assert)).unwrap();
    let help = stdout(&call(folder.path(), "validate --help").success());
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    let experiment = &shown["experiments"][0];
    let figure = &experiment["figures"][1];
    for key in [&shown, experiment, figure].into_iter().flat_map(keys) {
        assert!(help.contains(&key), "{key}");
    }
    assert_eq!(
        (&experiment["name"], &shown["seeds"], &shown["model"]),
        (&"head-on".into(), &serde_json::json!([1]), &Value::Null)
    );
    assert_eq!((&figure["name"], &figure["tolerance"]), (&"passes".into(), &serde_json::json!([0.7, 1.2])));
    let figures: Vec<&Value> =
        shown["experiments"].as_array().unwrap().iter().flat_map(|of| of["figures"].as_array().unwrap()).collect();
    let required = figures.iter().filter(|figure| !figure["ok"].is_null()).count();
    let met = figures.iter().filter(|figure| figure["ok"] == true).count();
    assert_eq!((&shown["required"], &shown["met"]), (&required.into(), &met.into()));
    assert!(met < required);
    assert_eq!(names(folder.path()), ["a.html", "b.json"]);
    let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
    assert!(
        page.contains("Head-on pair")
            && page.contains("OUTSIDE")
            && !page.contains("http://")
            && !page.contains("https://")
    );
}

#[test]
fn the_figures_are_the_same_for_any_number_of_threads() {
    let folder = folder();
    let figures = |threads: u32| {
        let text = stdout(&call(
            folder.path(),
            &format!("validate single-file --quick --seeds 1,2 --json -q --set time.limit=30 --threads {threads}"),
        ));
        serde_json::from_str::<Value>(&text).unwrap()["experiments"].take()
    };
    assert_eq!(figures(1), figures(3));
}

#[test]
fn scenes_are_kept_and_run() {
    let folder = folder();
    call(folder.path(), "validate lone-walker --seeds 4 -q --keep kept");
    assert_eq!(names(&folder.path().join("kept")), ["lone-walker-24-m.toml"]);
    call(folder.path(), "run kept/lone-walker-24-m.toml --no-files -q").success();
}

#[test]
fn experiments_are_listed_and_errors_name_the_problem() {
    let folder = folder();
    let list = stdout(&call(folder.path(), "validate --list").success());
    assert!(
        list.contains("single-file")
            && list.contains("0.8 m")
            && list.contains("[1 m]")
            && list.contains("counterflow"),
        "{list}"
    );
    let message = |arguments: &str| stderr(&call(folder.path(), &format!("validate {arguments}")).code(2));
    assert!(message("doors").contains("there is no experiment `doors`") && message("doors").contains("corridor, door"));
    assert!(message("door --model orcs").contains("there is no model `orcs`"));
    assert!(
        message("lone-walker --set nothing=1").contains("lone-walker 24 m"),
        "{}",
        message("lone-walker --set nothing=1")
    );
    assert!(message("door -o a.png").contains("end it in .html or .json"));
    assert!(message("door families").contains("cannot be combined"));
}

#[test]
fn a_trial_of_the_families_is_reproduced_by_its_index() {
    let folder = folder();
    let assert = call(folder.path(), "validate families --seed 1 --trial 4 --json -q --keep kept --set time.limit=1");
    let shown: Value = serde_json::from_str(&stdout(&assert.code(1))).unwrap();
    assert_eq!((&shown["runs"], &shown["failed"][0]["name"]), (&1.into(), &"bus-4".into()));
    assert!(shown["failed"][0]["flaws"].as_str().unwrap().contains("not arrived"));
    assert_eq!(names(&folder.path().join("kept")), ["bus-4.toml"]);
}
