//! `throng measure`.

use crate::shared::{call, folder, names, stderr, stdout};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;

fn measured(folder: &Path, arguments: &str) -> Value {
    serde_json::from_str(&stdout(&call(folder, &format!("measure {arguments} --json")).success())).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

/// Returns three agents that fly in circles at 2 m/s, and a standing agent of another group.
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
    // The velocity on a circle turns: its autocorrelation is the cosine of the angle, which falls to 1/e at acos(1/e).
    let falls = (1f64 / std::f64::consts::E).acos() / 2.0;
    assert!((number(&flies["correlation"]["time"]) - falls).abs() < 2e-3, "{}", flies["correlation"]["time"]);
    assert!(all["groups"][1]["nearest"]["mean"].is_null() && all["groups"][1]["correlation"]["time"].is_null());
    let part = measured(folder.path(), "run.csv --group flies --from 2 --to 4");
    assert_eq!((part["groups"].as_array().unwrap().len(), &part["groups"][0]["moments"]), (1, &101.into()));
}

/// A file beside has the figures that it has alone, and its curves are in the plots.
#[test]
fn a_scene_is_measured_beside_a_recording() {
    let folder = folder();
    let flies =
        circles().lines().filter(|line| !line.contains("post")).fold(String::new(), |all, line| all + line + "\n");
    std::fs::write(folder.path().join("flies.csv"), flies).unwrap();
    let alone = measured(folder.path(), "flies.csv --lag 1");
    let both = measured(folder.path(), "flocking --to 3 --lag 1 --beside flies.csv");
    assert_eq!((&alone["beside"], both["groups"].as_array().unwrap().len()), (&Value::Null, 1));
    for key in ["agents", "moments", "speed", "nearest", "correlation", "size"] {
        assert_eq!(both["beside"][key], alone["groups"][0][key], "{key}");
    }
    let lines = |options: &str| {
        call(folder.path(), &format!("measure flocking --to 3 {options} -o page.html -q")).success();
        std::fs::read_to_string(folder.path().join("page.html")).unwrap().matches("line m4").count()
    };
    // speed, velocity, acceleration, nearest, autocorrelation, and the legend
    assert_eq!((lines(""), lines("--beside flies.csv")), (0, 6));
    let missing = call(folder.path(), "measure flocking --to 1 --beside none.csv");
    assert!(stderr(&missing.failure()).contains("none.csv"));
}

#[test]
fn a_scene_has_the_same_figures_as_its_recording() {
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
fn it_writes_text_and_a_page() {
    let folder = folder();
    std::fs::write(folder.path().join("run.csv"), circles()).unwrap();
    let message = stdout(&call(folder.path(), "measure run.csv -o a.html").success());
    assert!(
        message.contains("run.csv, flies: 3 agents, 0.00 to 7.98 s, 400 moments") && message.contains("wrote a.html")
    );
    assert!(message.contains("autocorrelation falls to 1/e in") && message.contains("radius of gyration"), "{message}");
    let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
    assert_eq!(page.matches("<svg viewBox=\"0 0 560").count(), 16, "eight plots per group");
    assert!(!page.contains("NaN") && !page.contains("inf") && !page.contains("{{"), "{page}");
    assert_eq!(names(folder.path()), ["a.html", "run.csv"]);
}

#[test]
fn errors_name_the_problem() {
    let folder = folder();
    std::fs::write(folder.path().join("run.csv"), circles()).unwrap();
    for (arguments, text) in [
        ("run.csv --group birds", "the groups are: flies, post"),
        ("run.csv --seed 3", "a recording cannot be changed"),
        ("run.csv --from 3 --to 2", "give --to more than --from"),
        ("run.csv --from 30", "no agent is present from 30 s to the end"),
        ("run.csv -o a.mp4", "end the name in .html"),
        ("none.csv", "cannot read none.csv"),
        ("none.toml", "none.toml"),
    ] {
        let message = stderr(&call(folder.path(), &format!("measure {arguments}")).code(2));
        assert!(message.contains(text), "{arguments}: {message}");
    }
    assert_eq!(names(folder.path()), ["run.csv"]);
}

/// Returns people in two files, 1 m apart, walking east at 1.2 m/s, in the Archive's format: centimetres, ten frames
/// per second.
fn stream() -> String {
    let mut text = "# framerate: 10\n# id frame x/cm y/cm z/cm\n".to_owned();
    for number in 0..80u32 {
        let (start, y) = (-0.5 * f64::from(number), 0.5 + f64::from(number % 2));
        for frame in 0..300u32 {
            let x = start + 0.12 * f64::from(frame) + 0.003;
            let _ = writeln!(text, "{number} {frame} {:.4} {:.4} 176", 100.0 * x, 100.0 * y);
        }
    }
    text
}

#[test]
fn a_stream_of_people_has_its_density_speed_and_flow() {
    let folder = folder();
    std::fs::write(folder.path().join("stream.txt"), stream()).unwrap();
    let asked =
        "stream.txt --from 10 --to 25 --area 1,0,4,2 --line 2,0,2,2 --cut-off 3 -o s.html -o s.csv -o s.png -o s.svg";
    let people = &measured(folder.path(), asked)["people"];
    let near = |value: &Value, want: f64, within: f64| {
        assert!((number(value) - want).abs() < within, "{value}, not {want}");
    };
    assert_eq!(
        (&people["people"], &people["moments"], &people["directions"]),
        (&80.into(), &151.into(), &Value::from([80, 0]))
    );
    near(&people["speed"]["mean"], 1.2, 1e-5);
    near(&people["effort"]["mean"], 2.23 + 1.26 * 1.44, 1e-4);
    near(&people["path_ratio"]["most"], 1.0, 1e-6);
    near(&people["nearest"], 1.0, 1e-6);
    assert_eq!((&people["collisions"], &people["near_misses"]), (&0.into(), &0.into()));
    let (area, line) = (&people["areas"][0], &people["lines"][0]);
    near(&area["density"], 1.0, 0.05);
    near(&area["voronoi_speed"], 1.2, 1e-4);
    near(&line["steady_specific_flow"], 1.2, 0.02);
    assert_eq!((&line["leftwards"], &line["length"]), (&0.into(), &2.0.into()));
    assert!(people["lane_order"].is_null() && number(&people["frame_rate"]).round() == 10.0);
    let table = std::fs::read_to_string(folder.path().join("s.csv")).unwrap();
    assert_eq!((table.lines().count(), table.lines().nth(1).unwrap().split(',').count()), (152, 9));
    assert!(std::fs::read_to_string(folder.path().join("s.html")).unwrap().contains("Fundamental diagram"));
    let plots = std::fs::read_to_string(folder.path().join("s.svg")).unwrap();
    assert!(plots.contains("N(t): people that have crossed line") && !plots.contains("NaN"), "{plots}");
    let text = stdout(&call(folder.path(), "measure stream.txt --line 2,0,2,2").success());
    assert!(text.contains("80 people") && text.contains("steady flow"), "{text}");
}

#[test]
fn several_areas_and_lines_are_measured_at_once() {
    let folder = folder();
    std::fs::write(folder.path().join("stream.txt"), stream()).unwrap();
    let areas = ["1,0,4,2", "8,0,2,1"];
    let lines = ["2,0,2,2", "5,2,5,0"];
    let each = |k: usize| {
        let asked = format!("stream.txt --from 10 --to 25 --area {} --line {} --cut-off 3", areas[k], lines[k]);
        measured(folder.path(), &asked)["people"].clone()
    };
    let (one, two) = (each(0), each(1));
    let asked: String = (0..2).map(|k| format!(" --area {} --line {}", areas[k], lines[k])).collect();
    let all =
        measured(folder.path(), &format!("stream.txt --from 10 --to 25{asked} --cut-off 3 -o a.csv -o a.parquet"));
    let both = |key: &str| Value::from([one[key][0].clone(), two[key][0].clone()].to_vec());
    assert_eq!((&all["people"]["areas"], &all["people"]["lines"]), (&both("areas"), &both("lines")));
    assert_ne!(one["areas"], two["areas"]);
    // Cells end at the walkable ground and at solids in it, whichever file format describes them.
    let plan = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).unwrap();
        let asked = format!("stream.txt --from 10 --to 25 --area 1,0,4,2 --walkable {name}");
        number(&measured(folder.path(), &asked)["people"]["areas"][0]["voronoi_speed"])
    };
    let whole = plan("whole.wkt", "POLYGON ((0 0, 20 0, 20 2, 0 2, 0 0))");
    let holed =
        plan("holed.wkt", "POLYGON ((0 0, 20 0, 20 2, 0 2, 0 0), (2.1 0.9, 2.3 0.9, 2.3 1.1, 2.1 1.1, 2.1 0.9))");
    let drawn = plan(
        "drawn.svg",
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="2000" height="200">
        <rect id="floor" width="2000" height="200"/><rect id="column" x="210" y="90" width="20" height="20"/></svg>"#,
    );
    assert!((holed - drawn).abs() < 1e-4 && (holed - whole).abs() > 1e-3, "{whole}, {holed}, {drawn}");
    let message = stderr(&call(folder.path(), "measure stream.txt --area 1,0,4,2 --walkable drawn.svg").success());
    assert!(message.contains("note: a pixel, or unit of the view box, is taken to be 0.01 m"), "{message}");
    let table = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    let heads = "time,people,speed,lane_order,density_1,area_speed_1,voronoi_density_1,voronoi_speed_1,\
                 density_2,area_speed_2,voronoi_density_2,voronoi_speed_2,crossed_1,crossed_2";
    assert_eq!(table.lines().next(), Some(heads));
    assert_eq!(std::fs::read(folder.path().join("a.parquet")).unwrap()[..4], *b"PAR1");
}

#[test]
fn info_reports_the_contents_of_a_file() {
    let folder = folder();
    std::fs::write(folder.path().join("stream.txt"), stream()).unwrap();
    std::fs::write(folder.path().join("frames.csv"), "ID,Frame,x,y\n4,10,0,0\n4,20,60,0\n").unwrap();
    let info = |arguments: &str| -> Value {
        serde_json::from_str(&stdout(&call(folder.path(), &format!("info {arguments} --json")).success())).unwrap()
    };
    let stream = info("stream.txt");
    assert_eq!((&stream["people"], &stream["moments"], &stream["unit"]), (&80.into(), &300.into(), &0.01.into()));
    assert!((number(&stream["speed"]["median"]) - 1.2).abs() < 1e-3 && number(&stream["frame_rate"]).round() == 10.0);
    let frames = info("frames.csv --frame-rate 25 --unit cm");
    assert!(
        (number(&frames["speed"]["most"]) - 1.5).abs() < 1e-6 && (number(&frames["frame_rate"]) - 2.5).abs() < 1e-9
    );
    let text = stdout(&call(folder.path(), "info stream.txt").success());
    assert!(text.contains("people     80") && text.contains("unit       0.01 m"), "{text}");
    let wrong = stderr(&call(folder.path(), "info frames.csv").code(2));
    assert!(wrong.contains("does not state the frame rate") && wrong.contains("--frame-rate 25"), "{wrong}");
    let wrong = stderr(&call(folder.path(), "measure flocking --line 0,0,1,1").code(2));
    assert!(wrong.contains("throng run SCENE -o NAME.csv"), "{wrong}");
}

/// Coordinates beyond the limit (1e8 m) are refused, and at the limit nothing panics.
#[test]
fn coordinates_out_of_their_limits_are_refused() {
    let folder = folder();
    for (y, code) in [("1e16", 2), ("1e300", 2), ("1.1e8", 2), ("nan", 2), ("1e8", 0), ("1e-300", 0)] {
        let row = |number: u32, time: u32, x: u32, sign: &str| format!("{number},{time},{x},{sign}{y}\n");
        let rows = [row(1, 0, 0, ""), row(1, 1, 1, ""), row(2, 0, 5, "-"), row(2, 1, 4, "-"), row(3, 0, 9, "")];
        std::fs::write(folder.path().join("far.csv"), format!("number,time,x,y\n{}", rows.concat())).unwrap();
        for asked in ["", " --area=-1,-1,2,2", " --area=-1,-1,2,2 --cut-off 2 --line 0,0,1,1"] {
            let message = stderr(&call(folder.path(), &format!("measure far.csv{asked}")).code(code));
            assert!(code == 0 || message.starts_with("error: far.csv:2: "), "{y}: {message}");
        }
    }
}

/// The feet of the same people stand in every file that has joints.
#[test]
fn feet_stand_in_every_file_of_people() {
    let folder = folder();
    let run = "run circle --no-expect -q --duration 6 --rate 25";
    call(folder.path(), &format!("{run} -o run.glb -o run.usda -o *.bvh")).success();
    call(folder.path(), &format!("{run} --figures baked -o baked.glb")).success();
    for (file, people) in [("run.glb", 36), ("run.usda", 36), ("baked.glb", 36), ("7.bvh", 1)] {
        let feet = stdout(&call(folder.path(), &format!("measure {file} --feet --json")).success());
        let feet: Value = serde_json::from_str(&feet).unwrap();
        assert_eq!(feet["people"], people, "{file}");
        assert!(number(&feet["steps"]) >= 5.0 * f64::from(people), "{file}: {feet}");
        assert!(number(&feet["mean_slide"]) < 0.003 && number(&feet["largest_slide"]) < 0.01, "{file}: {feet}");
    }
    let files = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(files, 3 + 36, "a file for each person");
    let wrong = stderr(&call(folder.path(), "measure circle.csv --feet").code(2));
    assert!(wrong.contains("throng run SCENE -o NAME.glb"), "{wrong}");
    std::fs::write(folder.path().join("run.csv"), "number,time,x,y\n1,0,0,0\n").unwrap();
    let wrong = stderr(&call(folder.path(), "measure run.csv --feet").code(2));
    assert!(wrong.starts_with("error: run.csv: files of this kind have no figures"), "{wrong}");
}
