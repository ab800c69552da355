//! `throng compare`: figures, films, pages.

use crate::shared::{WALK, call, folder, names, stderr, stdout};
use serde_json::Value;
use std::path::Path;

fn json(folder: &Path, arguments: &str) -> Value {
    serde_json::from_str(&stdout(&call(folder, &format!("{arguments} --json")).success())).unwrap()
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

/// The figures that depend on the machine.
const SPEEDS: [&str; 2] = ["agent_steps_per_second", "us_per_agent_step"];

#[test]
fn figures_are_those_of_the_same_run() {
    let folder = folder();
    let all = json(folder.path(), "compare circle --models orca,vo,orca:time_horizon=4 --seeds 1,3");
    assert_eq!((&all["scene"], &all["seeds"]), (&Value::from("circle"), &serde_json::json!([1, 3])));
    let alone =
        ["", "--set avoid.vo.neighbours=10 --set avoid.vo.neighbour_distance=5.0", "--set avoid.orca.time_horizon=4"];
    for (k, (label, set)) in ["orca", "vo", "orca:time_horizon=4"].into_iter().zip(alone).enumerate() {
        let model = &all["models"][k];
        assert_eq!(model["model"], label);
        for (n, seed) in [1, 3].into_iter().enumerate() {
            let found = &model["runs"][n];
            let want = json(folder.path(), &format!("run circle --no-files --no-expect --seed {seed} {set}"));
            assert_eq!(found["seed"], seed);
            for (key, value) in found.as_object().unwrap().iter().filter(|(key, _)| !SPEEDS.contains(&key.as_str())) {
                assert!(
                    key == "seed" || value == &want[key],
                    "{label}, seed {seed}, {key}: {value}, not {}",
                    want[key]
                );
            }
        }
        let time = |n: usize| model["runs"][n]["time"].as_f64().unwrap();
        let median = model["median"]["time"].as_f64().unwrap();
        assert!((median - 0.5 * (time(0) + time(1))).abs() < 1e-9, "{median}");
        assert_eq!(model["least"]["time"], time(0).min(time(1)));
    }
    assert!(names(folder.path()).is_empty(), "no file is written without -o");
}

#[test]
fn the_table_holds_every_model_and_on_request_every_run() {
    let folder = folder();
    let table = stdout(&call(folder.path(), "compare doorway --models orca,none --seeds 1..3 --limit 2").success());
    assert!(table.starts_with("doorway: seeds 1 to 3, medians"), "{table}");
    let lines: Vec<&str> = table.lines().collect();
    assert!(lines[1].contains("arrived") && lines[1].contains("turning °/s"), "{table}");
    assert!(lines[2].starts_with("  orca ") && lines[3].contains('–') && lines[4].starts_with("  none "), "{table}");
    let all = stdout(
        &call(folder.path(), "compare doorway --models orca,none --seeds 1..3 --limit 2 --all -o a.csv -o a.md")
            .success(),
    );
    assert_eq!(all.matches("    seed ").count(), 6, "{all}");
    let csv = read(folder.path(), "a.csv");
    assert_eq!(csv.lines().count(), 7, "{csv}");
    assert!(csv.starts_with("model,seed,agents,arrived,") && csv.contains("\nnone,2,"), "{csv}");
    let columns: Vec<usize> = csv.lines().map(|line| line.split(',').count()).collect();
    assert!(columns.iter().all(|count| *count == columns[0]), "{columns:?}");
    let md = read(folder.path(), "a.md");
    assert!(md.contains("| **orca** |") && md.contains("| seed 2 |"), "{md}");
}

#[test]
fn results_are_the_same_for_any_number_of_threads() {
    let folder = folder();
    let run = |threads: usize| {
        let files = format!("-o {threads}.csv -o {threads}.html -o {threads}.gif -o {threads}.mp4");
        let options = format!("--threads {threads} {files} --size 320x200 --duration 3 -q");
        call(folder.path(), &format!("compare doorway -m rvo,orca,hrvo --seeds 1..2 {options}")).success();
    };
    run(1);
    run(3);
    for name in ["gif", "mp4"] {
        let bytes = |threads: usize| std::fs::read(folder.path().join(format!("{threads}.{name}"))).unwrap();
        assert!(bytes(1) == bytes(3), "{name}");
    }
    let figures = |threads: usize| -> Vec<String> {
        let text = read(folder.path(), &format!("{threads}.csv"));
        let head: Vec<&str> = text.lines().next().unwrap().split(',').collect();
        let same = |line: &str| {
            let cells = line.split(',').zip(&head).filter(|(_, key)| !SPEEDS.contains(key)).map(|(cell, _)| cell);
            cells.collect::<Vec<_>>().join(",")
        };
        text.lines().map(same).collect()
    };
    assert_eq!(figures(1), figures(3));
    let data = |threads: usize| page_data(&read(folder.path(), &format!("{threads}.html")));
    assert!(data(1) == data(3));
}

/// Returns the data of a page's script.
fn page_data(page: &str) -> Value {
    let (_, rest) = page.split_once("<script type=\"application/json\" id=\"data\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

/// Asserts that every opened tag is closed, in order. Returns the number of tags by name.
fn balanced(page: &str) -> std::collections::BTreeMap<String, usize> {
    const VOID: [&str; 8] = ["meta", "input", "br", "path", "circle", "polygon", "polyline", "!doctype"];
    let (mut open, mut counts, mut rest) = (Vec::new(), std::collections::BTreeMap::new(), page);
    while let Some((_, after)) = rest.split_once('<') {
        let (tag, behind) = after.split_once('>').expect("a tag ends");
        let name: String = tag.trim_start_matches('/').chars().take_while(|c| !c.is_whitespace()).collect();
        let name = name.trim_end_matches('/').to_lowercase();
        rest = behind;
        if tag.starts_with('/') {
            assert_eq!(open.pop().as_ref(), Some(&name), "</{name}>");
            continue;
        }
        *counts.entry(name.clone()).or_insert(0) += 1;
        match &*name {
            "script" | "style" => rest = behind.split_once(&format!("</{name}>")).expect("it is closed").1,
            name if VOID.contains(&name) || tag.ends_with('/') => {}
            _ => open.push(name),
        }
    }
    assert!(open.is_empty(), "{open:?}");
    counts
}

fn decoded(text: &str) -> Vec<u8> {
    let digit = |c: u8| match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let digits: Vec<u8> = text.bytes().filter(|c| *c != b'=').map(digit).collect();
    let whole = |four: &[u8]| four.iter().fold(0u32, |word, d| word << 6 | u32::from(*d)) << (6 * (4 - four.len()));
    digits.chunks(4).flat_map(|four| whole(four).to_be_bytes()[1..four.len()].to_vec()).collect()
}

#[test]
fn a_page_holds_the_positions_of_all_agents_in_every_frame() {
    let folder = folder();
    call(folder.path(), "compare circle -m vo,orca -o a.html -o a.csv --duration 4 -q").success();
    call(folder.path(), "run circle -o b.csv --duration 4 --no-expect -q").success();
    let page = read(folder.path(), "a.html");
    let counts = balanced(&page);
    assert_eq!((counts["canvas"], counts["table"], counts["h1"]), (2, 1, 1));
    assert_eq!(page.matches("<figure class=\"plot\">").count(), 5);
    assert_eq!(page.matches("class=\"three\"").count(), 2);
    assert!(!page.contains("http://") && !page.contains("https://") && !page.contains("{{"), "no links, no gaps");
    let data = page_data(&page);
    let tracks = &data["tracks"];
    assert_eq!((&data["agents"], tracks["radius"].as_array().unwrap().len()), (&Value::from(36), 36));
    // 100 steps, the start and the end.
    for run in tracks["runs"].as_array().unwrap() {
        assert_eq!((&run["frames"], &run["end"]), (&Value::from(102), &Value::from(4.0)));
    }
    let bytes = decoded(tracks["runs"][1]["words"].as_str().unwrap());
    let words: Vec<u32> = bytes.chunks_exact(4).map(|b| u32::from_le_bytes(b.try_into().unwrap())).collect();
    assert_eq!(words.len(), 102 * 36);
    let number = |value: &Value| value.as_f64().unwrap();
    let quantum = number(&tracks["quantum"]);
    let (x, y) = (number(&tracks["corner"][0]), number(&tracks["corner"][1]));
    let table = read(folder.path(), "b.csv");
    for (row, word) in table.lines().skip(1).zip(&words) {
        let cells: Vec<&str> = row.split(',').collect();
        let want = [cells[3], cells[4]].map(|cell| cell.parse::<f64>().unwrap());
        let found = [x + f64::from(word & 4095) * quantum, y + f64::from(word >> 12 & 4095) * quantum];
        for (a, b) in want.into_iter().zip(found) {
            assert!((a - b).abs() <= 0.5001 * quantum && quantum < 0.01, "{row}: {found:?}");
        }
    }
}

#[test]
fn a_page_is_made_of_any_text() {
    let folder = folder();
    let scene = format!("title = \"</script><b>{{{{data}}}} & 'co'\"\nabout.see = \"1 < 2\"\n{WALK}");
    std::fs::write(folder.path().join("walk.toml"), scene.replace("\"a\"", "\"<i>\"")).unwrap();
    call(folder.path(), "compare walk.toml -m none,orca -o a.html -o a.svg -q").success();
    let page = read(folder.path(), "a.html");
    balanced(&page);
    assert!(page.contains("<h1>&lt;/script&gt;&lt;b&gt;{{data}} &amp; 'co'</h1>") && page.contains("1 &lt; 2"));
    assert_eq!(page_data(&page)["groups"][0], "<i>");
}

#[test]
fn films_show_all_models_on_one_sheet() {
    let folder = folder();
    let path = folder.path();
    let files = "-o a.mp4 -o a.png -o a.svg -o a/";
    call(path, &format!("compare headon -m none,vo,orca {files} --fps 5 --size 480x200 --limit 2 -q")).success();
    assert_eq!(names(path), ["a", "a.mp4", "a.png", "a.svg"]);
    assert_eq!(names(&path.join("a")).len(), 11);
    let svg = read(path, "a.svg");
    assert_eq!(svg.matches("<svg").count(), 4);
    assert!(svg.contains(">none<") && svg.contains(">vo<") && svg.contains("of 2 arrived") && svg.contains("2.0 s"));
    let png = std::fs::read(path.join("a.png")).unwrap();
    let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    assert_eq!((number(16), number(20)), (480, 200));
    assert_eq!(&std::fs::read(path.join("a.mp4")).unwrap()[4..8], b"ftyp");
}

#[test]
fn errors_appear_before_anything_runs() {
    let refuses = |arguments: &str, wanted: &[&str]| {
        let folder = folder();
        let message = stderr(&call(folder.path(), &format!("compare circle {arguments}")).code(2));
        wanted.iter().for_each(|part| assert!(message.contains(part), "{part:?} is not in:\n{message}"));
        assert!(names(folder.path()).is_empty());
    };
    refuses("-m orcs", &["error: --models orcs: there is no model `orcs`", "did you mean `orca`?", "hrvo"]);
    refuses("-m rvo,rvo", &["--models: rvo is given twice"]);
    refuses("-m orca:horizon=4", &["--models orca:horizon=4", "did you mean `time_horizon`?"]);
    refuses(
        "-m orca:time_horizon=-1",
        &["--models orca:time_horizon=-1: orca.time_horizon is -1", "time_horizon is -1", "more than 0"],
    );
    for (seeds, wanted) in [("5..1", "5 is more than 1"), ("a", "`a` is not a seed"), ("1,1", "1 is given twice")] {
        refuses(&format!("--seeds {seeds}"), &["--seeds", wanted, "hint: write 1..5, or 1,3,7"]);
    }
    refuses("--seeds 1..99999999999", &["more than 10000 seeds"]);
    refuses("--seed 1 --seeds 2", &["cannot be used with"]);
    refuses("-o no/a.html", &["no/a.html", "there is no folder no"]);
    refuses("-o a.csv -o no/a.mp4", &["no/a.mp4", "there is no folder no"]);
    refuses("-o a.txt", &["a.txt", ".html", ".md", ".csv"]);
    refuses("-o a.md -o a.md", &["a.md is given twice"]);
    let many: Vec<String> = (1..=10).map(|k| format!("orca:time_horizon={k}")).collect();
    refuses(&format!("-m {} -o a.mp4", many.join(",")), &["10 models", "room for 9"]);
}

const BOUNDS: &str = "[bounds]\narrived_share = { at_least = 1 }\noverlap_depth = { at_most = 0.01 }\n\"time\" = { at_least = 1, at_most = 60 }\n";

/// Two agents of a group that neither avoid each other nor are kept apart.
const THROUGH: &str = "\
[[group]]
name = \"left\"
place.point = [-3.0, 0.0]
goal.point = [3.0, 0.0]
look_ahead = false
guard = false

[[group]]
name = \"right\"
place.point = [3.0, 0.1]
goal.point = [-3.0, 0.1]
look_ahead = false
guard = false
";

#[test]
fn runs_are_graded_by_bounds() {
    let folder = folder();
    let path = folder.path();
    std::fs::write(path.join("through.toml"), THROUGH).unwrap();
    std::fs::write(path.join("b.toml"), BOUNDS).unwrap();
    let command = "compare through.toml -m none,orca --seeds 1..2 --bounds b.toml --junit grades.xml";
    let text = stdout(&call(path, command).code(1));
    assert!(text.contains("bounds of b.toml\n  none FAILED: 0 of 2 runs within the bounds\n"), "{text}");
    assert!(text.contains("    seed 2: overlap_depth is 0.") && text.contains(", not at most 0.01\n"), "{text}");
    assert!(
        text.contains("  orca passed: 2 of 2 runs within the bounds\n") && text.contains("wrote grades.xml"),
        "{text}"
    );
    let xml = read(path, "grades.xml");
    let counts = balanced(&xml.replace("<?xml version=\"1.0\" encoding=\"UTF-8\"?>", ""));
    assert_eq!((counts["testsuite"], counts["testcase"], counts["failure"]), (2, 12, 2), "{xml}");
    assert!(xml.contains("<testsuites name=\"through\" tests=\"12\" failures=\"2\" errors=\"0\">"), "{xml}");
    assert!(xml.contains("<testsuite name=\"none\" tests=\"6\" failures=\"2\""), "{xml}");
    assert!(xml.contains("classname=\"through.none\" name=\"seed 1: overlap_depth at most 0.01\"><failure message=\"overlap_depth is 0."), "{xml}");
    let all: Value = serde_json::from_str(&stdout(&call(path, &format!("{command} --json")).code(1))).unwrap();
    let grades = &all["grades"];
    assert_eq!((&grades["bounds"], &grades["passed"]), (&Value::from("b.toml"), &Value::from(false)));
    let [none, orca] = [0, 1].map(|k| &grades["models"][k]);
    assert_eq!((&none["passed"], &orca["passed"]), (&Value::from(false), &Value::from(true)));
    let checks = none["runs"][0]["checks"].as_array().unwrap();
    let names: Vec<_> = checks.iter().map(|check| check["measure"].as_str().unwrap()).collect();
    assert_eq!(names, ["arrived_share", "overlap_depth", "time"]);
    // the oracle: the figures of the run beside it
    let run = &all["models"][0]["runs"][0];
    let found = |k: usize| checks[k]["found"].as_f64().unwrap();
    assert!((found(1) - (1.0 - run["least_separation"].as_f64().unwrap())).abs() < 1e-12, "{run}");
    assert_eq!((Some(found(0)), Some(found(2))), (run["arrived"].as_f64().map(|n| n / 2.0), run["time"].as_f64()));
    let passes: Vec<_> = checks.iter().map(|check| check["passed"].as_bool().unwrap()).collect();
    assert_eq!(passes, [true, false, true]);
}

#[test]
fn runs_within_the_bounds_succeed() {
    let folder = folder();
    let path = folder.path();
    let bounds = format!(
        "{BOUNDS}mean_swing = {{ at_most = 1 }}\nmean_speed = {{ at_least = 0.5 }}\nstuck = {{ at_most = 0 }}\n"
    );
    std::fs::write(path.join("b.toml"), bounds).unwrap();
    call(path, "compare headon -m orca,rvo --seeds 1..3 --bounds b.toml -q").success();
    let all = json(path, "compare headon -m orca --seeds 1..2 --bounds b.toml -o a.csv");
    for run in all["grades"]["models"][0]["runs"].as_array().unwrap() {
        let checks = run["checks"].as_array().unwrap();
        let found =
            |name: &str| checks.iter().find(|check| check["measure"] == name).unwrap()["found"].as_f64().unwrap();
        // every seed has figures over time
        assert!((0.5..2.0).contains(&found("mean_speed")) && (0.0..0.2).contains(&found("mean_swing")), "{run}");
    }
    assert!(json(path, "compare headon -m orca --limit 1")["grades"].is_null());
    // without a report on standard output, a failure is told on standard error
    std::fs::write(path.join("b.toml"), "[bounds]\ntime = { at_most = 0.5 }\n").unwrap();
    let told = stderr(&call(path, "compare headon -m orca --bounds b.toml -q --limit 1").code(1));
    assert!(told.contains("orca FAILED: 0 of 1 runs") && told.contains("time is 1, not at most 0.5"), "{told}");
}

#[test]
fn figures_of_rules_have_bounds_too() {
    let folder = folder();
    let path = folder.path();
    std::fs::write(path.join("b.toml"), "[bounds]\n\"figures.gaols\" = { at_most = 1000 }\n").unwrap();
    let message = stderr(&call(path, "compare soccer -m orca --limit 2 --bounds b.toml").code(2));
    assert!(message.contains("b.toml:2:") && message.contains("there is no measure `figures.gaols`"), "{message}");
    let known = message.rsplit("figures.").next().unwrap().split([',', '\n']).next().unwrap();
    std::fs::write(path.join("b.toml"), format!("[bounds]\n\"figures.{known}\" = {{ at_least = -1 }}\n")).unwrap();
    call(path, "compare soccer -m orca --limit 2 --bounds b.toml -q").success();
}

#[test]
fn mistakes_of_bounds_appear_before_anything_runs() {
    for (bounds, wanted) in [
        ("", "b.toml:1:1: the key `bounds` is missing here"),
        ("[bounds]\n", "there are no bounds"),
        ("[bounds]\ntmie = { at_most = 1 }\n", "b.toml:2:1: there is no measure `tmie`"),
        ("[bounds]\ntime = {}\n", "b.toml:2:8: `time` has neither at_least nor at_most"),
        ("[bounds]\ntime = { at_least = 2, at_most = 1 }\n", "b.toml:2:8: time is at least 2 and at most 1"),
        ("[bounds]\ntime = { at_most = inf }\n", "b.toml:2:8: a bound of `time` is not finite"),
        ("[bounds]\ntime = { most = 1 }\n", "b.toml:2:10: there is no key `most` here"),
        ("[bounds]\ntime = 5\n", "b.toml:2:8:"),
        ("[bounds\n", "this is not TOML"),
    ] {
        let folder = folder();
        std::fs::write(folder.path().join("b.toml"), bounds).unwrap();
        let command = "compare circle -m orca --bounds b.toml --junit grades.xml -o a.csv";
        let message = stderr(&call(folder.path(), command).code(2));
        assert!(message.contains(wanted), "{wanted:?} is not in:\n{message}");
        assert_eq!(names(folder.path()), ["b.toml"]);
    }
    let folder = folder();
    let refuses = |arguments: &str, wanted: &str| {
        let message = stderr(&call(folder.path(), &format!("compare circle {arguments}")).code(2));
        assert!(message.contains(wanted), "{wanted:?} is not in:\n{message}");
    };
    refuses("--junit grades.xml", "--bounds <FILE>");
    refuses("--bounds no.toml", "there is no file no.toml");
}

#[test]
fn the_picture_shows_the_moment_at_which_the_models_differ_most() {
    let folder = folder();
    let scene = format!("{WALK}[time]\nuntil = \"limit\"\nlimit = 8\n");
    std::fs::write(folder.path().join("walk.toml"), &scene).unwrap();
    std::fs::write(folder.path().join("given.toml"), format!("{scene}[view]\nmoment = 3.0\n")).unwrap();
    let models = "--models orca,none -q";
    let time = |arguments: &str| {
        call(folder.path(), &format!("compare {arguments} {models} -o picture.svg")).success();
        let svg = read(folder.path(), "picture.svg");
        let shown = svg.split(" s</text>").next().and_then(|text| text.rsplit('>').next()).unwrap().to_owned();
        shown.parse::<f64>().unwrap_or_else(|_| panic!("{shown}"))
    };
    assert_eq!(time("walk.toml --frame 2"), 2.0);
    assert_eq!(time("given.toml"), 3.0);
    assert_eq!(time("given.toml --frame 1"), 1.0);
    assert_eq!(time("walk.toml"), 8.0, "they never differ: the last moment");
    let crossing = time("headon");
    let last =
        json(folder.path(), "compare headon --models orca,none")["models"][0]["median"]["time"].as_f64().unwrap();
    assert!(
        crossing > 1.0 && crossing < last - 1.0,
        "they differ most where they pass each other: {crossing} of {last} s"
    );
}
