//! `throng replay`.

use crate::shared::{call, folder, names, stderr, stdout};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;

/// Three agents that walk without meeting.
const ALONE: &str = "\
[time]
step = 0.1
[[group]]
name = \"a\"
count = 3
place.points = [[0.0, 0.0], [0.0, 20.0], [0.0, 40.0]]
goal.shift = { by = [12.0, 0.0] }
body = { radius = 0.2 }
keep_right = 0.0
relaxation_time = 0.0
";

fn replayed(folder: &Path, arguments: &str) -> Value {
    serde_json::from_str(&stdout(&call(folder, &format!("replay {arguments} --json")).success())).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

/// Returns two opposite streams in a corridor, in the Archive's format, with 25 frames per second.
fn streams() -> String {
    let mut text = "# framerate: 25\n# id frame x/m y/m\n".to_owned();
    for number in 0..12u32 {
        let (way, lane) = (if number % 2 == 0 { 1.0 } else { -1.0 }, f64::from(number % 4) - 1.5);
        for frame in 0..150u32 {
            let x = way * (-5.0 + 0.05 * f64::from(frame));
            let _ = writeln!(text, "{number} {} {x:.4} {lane:.4} 1.7", frame + 20 * (number / 2));
        }
    }
    text
}

#[test]
fn a_replay_with_the_same_model_reproduces_the_run() {
    let folder = folder();
    let at = folder.path();
    std::fs::write(at.join("alone.toml"), ALONE).unwrap();
    call(at, "run alone.toml -o alone.csv -q").success();
    let all = replayed(at, "alone.csv --step 0.1 --set keep_right=0 --set relaxation_time=0 --every 3");
    let (recorded, orca) = (&all["recorded"], &all["models"][0]);
    assert_eq!((&orca["model"], &recorded["entered"]), (&"orca".into(), &3.into()));
    assert_eq!((&orca["entered"], &orca["overlapping"]), (&3.into(), &0.into()));
    let horizons = all["from_entry"].as_array().unwrap();
    assert_eq!((horizons.len(), &horizons[3]["horizon"]), (4, &Value::Null));
    // The agents stood at the start of the run but enter with the velocity after it, and so are a little ahead.
    assert!(number(&horizons[2]["final"]["orca"]["mean"]) < 0.2, "{}", horizons[2]);
    let ahead = &all["predicted"]["horizons"][2];
    assert!(number(&ahead["final"]["orca"]["mean"]) < 0.1 && number(&ahead["people"]) == 3.0, "{ahead}");
    assert!(all["predicted"]["alone"].is_null());
    // nearly all speeds are the preferred speed and differ in their last bits: a distance of distributions would
    // measure rounding
    let apart = |key: &str| (number(&orca["speed"][key]) - number(&recorded["speed"][key])).abs();
    assert!(apart("median") < 1e-4 && apart("mean") < 0.03, "{}", orca["speed"]);
    assert_eq!(orca["summary"]["overlaps"], 0);
}

#[test]
fn walls_groups_and_lines_are_used() {
    let folder = folder();
    let at = folder.path();
    let write = |name: &str, text: &str| std::fs::write(at.join(name), text).unwrap();
    write("streams.txt", &streams());
    write("corridor.wkt", "POLYGON ((-8 -2, 8 -2, 8 2, -8 2, -8 -2))");
    write("groups.txt", "2\n0 4\n1 3 5\n");
    let all =
        replayed(at, "streams.txt --map corridor.wkt --line 0,-2,0,2 --radius 0.15 --table people.csv -o again.csv");
    assert_eq!((&all["map"]["areas"], &all["map"]["through"]), (&1.into(), &0.into()));
    let orca = &all["models"][0];
    assert_eq!((&orca["entered"], &orca["moved"]), (&12.into(), &0.into()));
    let [alone, together] = ["alone", "in_groups"].map(|key| number(&all["predicted"][key]["people"]));
    assert_eq!(alone + together, number(&all["predicted"]["horizons"][2]["people"]));
    assert!(alone > 0.0 && together > 0.0 && !orca["crossings"].is_null());
    assert_eq!(all["recorded"]["people"]["lines"][0]["crossed"], 12);
    let table = std::fs::read_to_string(at.join("people.csv")).unwrap();
    let lines: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!((lines.len(), lines[0].len(), lines[0][7]), (13, 7 + 12, "orca_1"));
    assert!(lines.iter().all(|line| line.len() == 19) && (lines[5][1], lines[6][1], lines[7][1]) == ("0", "1", ""));
    // People walk straight at constant speed: both simple predictors are exact.
    assert!(lines[1..].iter().all(|line| line[8].parse::<f64>().unwrap() < 1e-3), "{table}");
    // The replay has the recording's times.
    let info: Value = serde_json::from_str(&stdout(&call(at, "info again.csv --json").success())).unwrap();
    assert_eq!(info["people"], 12);
    // The same corridor, drawn in millimetres.
    let corners = "10 -8000 20 -2000 10 8000 20 -2000 10 8000 20 2000 10 -8000 20 2000";
    let drawn = format!("0 SECTION 2 ENTITIES 0 LWPOLYLINE 8 floor 70 1 {corners} 0 ENDSEC\n").replace(' ', "\n");
    write("corridor.dxf", &drawn);
    let [wkt, dxf] = ["corridor.wkt", "corridor.dxf --plan-unit 0.001"].map(|map| {
        let all = replayed(at, &format!("streams.txt --map {map} --every 0 --radius 0.15"));
        (all["from_entry"].clone(), all["map"].clone())
    });
    assert_eq!(wkt, dxf);
    let text = stdout(&call(at, "replay streams.txt --map corridor.wkt --every 0").success());
    assert!(text.contains("12 people") && text.contains("KS distance") && text.contains("2 groups"), "{text}");
    assert!(!text.contains("ahead") && text.contains("at the end"), "{text}");
    // Walls in other coordinates, moved to the recording by an offset.
    write("map.xml", "<a><Line x1='-9' y1='98' x2='9' y2='98'/><Line x1='-9' y1='102' x2='9' y2='102'/></a>");
    let moved = replayed(at, "streams.txt --map-offset 0,-100 --every 0 --from 1 --until 4");
    assert_eq!(
        (&moved["map"]["obstacles"], &moved["map"]["through"], &moved["from"]),
        (&2.into(), &0.into(), &1.0.into())
    );
    assert_eq!(replayed(at, "streams.txt --no-map --every 0 --until 2")["map"]["obstacles"], 0);
    let one = replayed(at, "streams.txt --threads 1 --every 2");
    let three = replayed(at, "streams.txt --threads 3 --every 2");
    for key in ["from_entry", "predicted", "models", "recorded"] {
        assert_eq!(one[key], three[key], "{key}");
    }
}

#[test]
fn recording_and_replay_are_drawn_side_by_side() {
    let folder = folder();
    let at = folder.path();
    std::fs::write(at.join("streams.txt"), streams()).unwrap();
    let files = "-o a.png -o a.svg -o a.mp4 -o f/ -o a.rec --fps 2 --size 400x200 --frame 3";
    call(at, &format!("replay streams.txt {files} --every 0 --model rvo -q")).success();
    assert_eq!(names(at), ["a.mp4", "a.png", "a.rec", "a.svg", "f", "streams.txt"]);
    let picture = std::fs::read_to_string(at.join("a.svg")).unwrap();
    assert!(picture.contains("recorded") && picture.contains("rvo") && picture.contains("streams.txt"));
    assert!(names(&at.join("f")).len() > 10);
    assert!(throng_record::Trajectories::read(at.join("a.rec")).unwrap().spots[0].time < 1e-6);
}

/// The figures of each of several models equal those of a replay by that model alone.
#[test]
fn several_models_have_the_figures_of_each_alone() {
    let folder = folder();
    let at = folder.path();
    std::fs::write(at.join("streams.txt"), streams()).unwrap();
    // bodies so wide that the streams must make way, each model in its way
    let both = replayed(
        at,
        "streams.txt --radius 0.45 --model orca --model rvo:time_horizon=4 --every 2 -o a.rec --table both.csv",
    );
    let columns = |name: &str| -> Vec<(String, Vec<String>)> {
        let text = std::fs::read_to_string(at.join(name)).unwrap();
        let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
        let column = |k: usize| (lines[0][k].to_owned(), lines[1..].iter().map(|line| line[k].to_owned()).collect());
        (0..lines[0].len()).map(column).collect()
    };
    let table = columns("both.csv");
    for (k, model) in ["orca", "rvo:time_horizon=4"].into_iter().enumerate() {
        let alone =
            replayed(at, &format!("streams.txt --radius 0.45 --model {model} --every 2 -o alone.rec --table one.csv"));
        assert_eq!((&both["models"][k], &both["recorded"]), (&alone["models"][0], &alone["recorded"]));
        let horizons = |all: &Value| {
            let ahead = all["predicted"]["horizons"].as_array().unwrap().clone();
            [all["from_entry"].as_array().unwrap().clone(), ahead].concat()
        };
        for (both, alone) in horizons(&both).iter().zip(horizons(&alone)) {
            for figure in ["average", "final"] {
                for key in [model, "constant_velocity", "straight"] {
                    assert_eq!(both[figure][key], alone[figure][key], "{model}, {figure}, {key}");
                }
            }
            assert_eq!(both["final"].as_object().unwrap().len(), 4);
        }
        assert!(columns("one.csv").iter().all(|column| table.contains(column)), "{model}");
        let name = ["a-orca.rec", "a-rvo-time_horizon=4.rec"][k];
        assert!(both["files"].as_array().unwrap().contains(&name.into()), "{}", both["files"]);
        assert_eq!(std::fs::read(at.join(name)).unwrap(), std::fs::read(at.join("alone.rec")).unwrap());
    }
    assert_ne!(both["models"][0]["people"], both["models"][1]["people"]);
    let text = stdout(&call(at, "replay streams.txt --model orca,hrvo --every 2").success());
    for row in ["  recorded  ", "  orca  ", "  hrvo  ", "  constant velocity  ", "  straight to the goal  "] {
        assert!(text.contains(row), "{row}: {text}");
    }
    call(at, "replay streams.txt --model orca,hrvo,none -o all.svg --every 0 -q").success();
    let picture = std::fs::read_to_string(at.join("all.svg")).unwrap();
    assert!(["recorded", "orca", "hrvo", "none"].iter().all(|name| picture.contains(&format!(">{name}<"))));
}

#[test]
fn a_page_has_tables_plots_and_all_people() {
    let folder = folder();
    let at = folder.path();
    std::fs::create_dir(at.join("deep")).unwrap();
    std::fs::write(at.join("deep/streams.txt"), streams()).unwrap();
    let message = stdout(&call(at, "replay deep/streams.txt --model orca,rvo --line 0,-2,0,2 -o a.html").success());
    assert!(message.contains("wrote a.html"), "{message}");
    let page = std::fs::read_to_string(at.join("a.html")).unwrap();
    assert!(page.contains("<title>streams.txt: replayed</title>") && page.contains("<h1>streams.txt</h1>"));
    assert!(!page.contains("{{") && !page.contains("http"), "no unfilled names and no network access");
    assert_eq!(page.matches("class=\"panel\"").count(), 3);
    for plot in ["Displacement since entry", "Displacement ahead", "Speed", "nearest neighbour", "People", "N(t)"] {
        assert!(page.contains(&format!("<figcaption>{plot}")) || page.contains(plot), "{plot}");
    }
    // The same figures as in the terminal.
    let rows = message.lines().filter(|line| line.starts_with("  rvo"));
    let cells: Vec<&str> =
        rows.flat_map(|row| row.split("  ").map(str::trim)).filter(|cell| !cell.is_empty()).collect();
    assert!(cells.len() > 20);
    cells.iter().for_each(|cell| assert!(page.contains(&format!(">{cell}</t")), "{cell}"));
    // All people are in the player, at 25 frames per second for 10 s.
    let data = page.split("id=\"data\">").nth(1).and_then(|rest| rest.split("</script>").next()).unwrap();
    let data: Value = serde_json::from_str(data).unwrap();
    let runs = data["tracks"]["runs"].as_array().unwrap();
    assert_eq!((runs.len(), &data["agents"], data["tracks"]["radius"].as_array().unwrap().len()), (3, &12.into(), 12));
    assert!(runs.iter().all(|run| run["frames"] == runs[0]["frames"] && number(&run["frames"]) > 240.0), "{runs:?}");
    call(at, "replay deep/streams.txt --every 0 -o none.html -q").success();
    assert!(!std::fs::read_to_string(at.join("none.html")).unwrap().contains("Displacement ahead"));
}

#[test]
fn errors_name_the_problem() {
    let folder = folder();
    let at = folder.path();
    let write = |name: &str, text: &str| std::fs::write(at.join(name), text).unwrap();
    write("streams.txt", &streams());
    write("bad.xml", "<a>\n<Line x1='1' y1='2' x2='x' y2='0'/></a>");
    write("bad.txt", "1 2\n2 you\n");
    write("once.csv", "number,time,x,y\n1,0,0,0\n2,0,1,1\n");
    write("flies.csv", "number,time,x,y,z\n1,0,0,0,3\n1,1,1,1,3\n");
    write("only-walls.toml", "[[obstacle]]\nshape.wall = [[-9.0, 3.0], [9.0, 3.0]]\n");
    let before = names(at);
    for (arguments, text) in [
        ("streams.txt --map bad.xml", "bad.xml:2: x2=\"x\" is no number"),
        ("streams.txt --map none.xml", "cannot read none.xml"),
        ("streams.txt --groups bad.txt", "bad.txt:2: `you` is not an agent number"),
        ("streams.txt --map-offset 0,1", "give a map: --map FILE"),
        ("streams.txt --model orcs", "did you mean `orca`?"),
        ("streams.txt --model orca --model orca", "--model: orca is given twice"),
        ("streams.txt -o a.rec -o a.rec", "a.rec is given twice"),
        ("streams.txt --set speed.preferred=1", "use --speed for preferred speeds"),
        ("streams.txt --set avoid.orca.horizon=1", "time_horizon"),
        ("streams.txt --table a.txt", "end the name in .csv"),
        ("streams.txt -o a.xyz", "a.xyz: cannot tell what to write from this name"),
        ("streams.txt --from 3 --until 2", "give --until more than --from"),
        ("streams.txt --from 300", "no person has two samples"),
        (
            "streams.txt -o a.png --model vo,rvo,hrvo,none,orca,orca:time_horizon=1,orca:time_horizon=2,orca:time_horizon=3,orca:time_horizon=4",
            "10 panels",
        ),
        ("streams.txt --speed fast", "a part such as 50%"),
        ("once.csv", "no person has two samples"),
        ("flies.csv", "above the ground"),
        ("none.txt", "cannot read none.txt"),
    ] {
        let message = stderr(&call(at, &format!("replay {arguments}")).code(2));
        assert!(message.contains(text), "{arguments}: {message}");
    }
    assert_eq!(names(at), before);
    let all = replayed(at, "streams.txt --map only-walls.toml --every 0 --until 2");
    assert_eq!(all["map"]["obstacles"], 1, "a map needs no agents");
}

/// Returns two people 20 m apart with velocities, one row every 6 frames, as OpenTraj writes a video of 15 frames per
/// second. The first person stands for 6 s.
fn of_15_frames() -> String {
    let speed = |number: u32, row: u32| f64::from(u8::from(number == 2 || !(10..25).contains(&row)));
    let mut text = String::new();
    for number in 1..=2u32 {
        let mut x = 0.0;
        for row in 0..40u32 {
            let _ = writeln!(text, "{} {number} {x:.4} 0 {}.0 {} 0 0", 6 * row, 20 * number, speed(number, row));
            x += 0.4 * speed(number, row);
        }
    }
    text
}

#[test]
fn every_command_notes_a_frame_rate_that_velocities_contradict() {
    let folder = folder();
    let at = folder.path();
    std::fs::write(at.join("obsmat.txt"), of_15_frames()).unwrap();
    let commands = [
        "replay obsmat.txt",
        "measure obsmat.txt",
        "info obsmat.txt",
        "convert obsmat.txt -o a.csv",
        "render obsmat.txt -o a.png",
    ];
    for command in commands {
        let message = stderr(&call(at, command).success());
        assert!(
            message.contains("note: obsmat.txt: the velocities imply 15 frames per second"),
            "{command}: {message}"
        );
        let message = stderr(&call(at, &format!("{command} --frame-rate 25")).success());
        assert!(
            message.contains("note: ") && message.contains("at --frame-rate 15 they would agree, not at 25"),
            "{command}: {message}"
        );
        let message = stderr(&call(at, &format!("{command} --frame-rate 15")).success());
        assert!(!message.contains("note: "), "{command}: {message}");
        if !command.starts_with("info") {
            assert_eq!(stderr(&call(at, &format!("{command} -q")).success()), "", "{command}");
        }
    }
    let info: Value = serde_json::from_str(&stdout(&call(at, "info obsmat.txt --json").success())).unwrap();
    assert!((number(&info["frame_rate"]) - 2.5).abs() < 1e-9);
}

#[test]
fn recorded_pauses_are_replayed() {
    let folder = folder();
    let at = folder.path();
    std::fs::write(at.join("obsmat.txt"), of_15_frames()).unwrap();
    let standing = |options: &str| {
        let all = replayed(at, &format!("obsmat.txt --set keep_right=0 --every 0 {options}"));
        let of = |own: &Value| number(&own["microscopic"]["standing"]);
        (of(&all["recorded"]), of(&all["models"][0]), all["recorded"]["pauses"]["count"].clone())
    };
    let (recorded, again, pauses) = standing("");
    // 15 of 78 steps.
    assert!((recorded - 15.0 / 78.0).abs() < 1e-3 && (again - recorded).abs() < 0.03, "{recorded} {again}");
    assert_eq!(pauses, 1);
    let (same, none, pauses) = standing("--no-pauses");
    assert!(same == recorded && none < 0.02 && pauses == 0, "{same} {none}");
    let text = stdout(&call(at, "replay obsmat.txt --every 0").success());
    assert!(text.contains("pauses: 1, of 1 people, 5 s together") && text.contains("Every 0.4 s"), "{text}");
}
