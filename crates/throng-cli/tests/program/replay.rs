//! `throng replay`.

use crate::shared::{call, folder, names, stderr, stdout};
use serde_json::Value;
use std::fmt::Write;
use std::path::Path;

/// Three who walk alone.
const ALONE: &str = "\
[time]
step = 0.1
[[group]]
name = \"a\"
count = 3
place.points = [[0.0, 0.0], [0.0, 20.0], [0.0, 40.0]]
goal.shift = { by = [12.0, 0.0] }
keep_right = 0.0
";

fn replayed(folder: &Path, arguments: &str) -> Value {
    serde_json::from_str(&stdout(&call(folder, &format!("replay {arguments} --json")).success())).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Two streams against each other through a corridor, as the Archive writes them; 25 frames a second.
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
fn a_run_of_the_same_model_comes_out_the_same() {
    let folder = folder();
    let at = folder.path();
    std::fs::write(at.join("alone.toml"), ALONE).unwrap();
    call(at, "run alone.toml -o alone.csv -q").success();
    let all = replayed(at, "alone.csv --step 0.1 --set keep_right=0 --every 3");
    let people = &all["people"];
    assert_eq!((&people["recorded"], &people["entered"], &people["overlapping"]), (&3.into(), &3.into(), &0.into()));
    let horizons = all["from_entry"].as_array().unwrap();
    assert_eq!((horizons.len(), &horizons[3]["horizon"]), (4, &Value::Null));
    // who stood at the start goes on with the velocity after it: a little ahead
    assert!(number(&horizons[2]["final"]["replay"]["mean"]) < 0.2, "{}", horizons[2]);
    let ahead = &all["predicted"]["horizons"][2];
    assert!(number(&ahead["final"]["replay"]["mean"]) < 0.1 && number(&ahead["people"]) == 3.0, "{ahead}");
    assert!(all["predicted"]["alone"].is_null() && number(&all["speed"]["distance"]) < 0.2);
    assert_eq!(all["summary"]["overlaps"], 0);
}

#[test]
fn walls_groups_and_lines_are_told() {
    let folder = folder();
    let at = folder.path();
    let write = |name: &str, text: &str| std::fs::write(at.join(name), text).unwrap();
    write("streams.txt", &streams());
    write("corridor.wkt", "POLYGON ((-8 -2, 8 -2, 8 2, -8 2, -8 -2))");
    write("groups.txt", "2\n0 4\n1 3 5\n");
    let all =
        replayed(at, "streams.txt --map corridor.wkt --line 0,-2,0,2 --radius 0.15 --table people.csv -o again.csv");
    assert_eq!((&all["map"]["areas"], &all["map"]["through"]), (&1.into(), &0.into()));
    assert_eq!((&all["people"]["entered"], &all["people"]["moved"]), (&12.into(), &0.into()));
    let [alone, together] = ["alone", "in_groups"].map(|who| number(&all["predicted"][who]["people"]));
    assert_eq!(alone + together, number(&all["predicted"]["horizons"][2]["people"]));
    assert!(alone > 0.0 && together > 0.0 && !all["crossings"].is_null());
    assert_eq!(all["recorded"]["lines"][0]["crossed"], 12);
    let table = std::fs::read_to_string(at.join("people.csv")).unwrap();
    let lines: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!((lines.len(), lines[0].len(), lines[0][7]), (13, 7 + 12, "replay_1"));
    assert!(lines.iter().all(|line| line.len() == 19) && (lines[5][1], lines[6][1], lines[7][1]) == ("0", "1", ""));
    // straight on at constant speed, both simple predictions are right
    assert!(lines[1..].iter().all(|line| line[8].parse::<f64>().unwrap() < 1e-3), "{table}");
    // the replayed are at the recording's times
    let info: Value = serde_json::from_str(&stdout(&call(at, "info again.csv --json").success())).unwrap();
    assert_eq!(info["people"], 12);
    // the same corridor, drawn in millimetres
    let corners = "10 -8000 20 -2000 10 8000 20 -2000 10 8000 20 2000 10 -8000 20 2000";
    let drawn = format!("0 SECTION 2 ENTITIES 0 LWPOLYLINE 8 floor 70 1 {corners} 0 ENDSEC\n").replace(' ', "\n");
    write("corridor.dxf", &drawn);
    let [wkt, dxf] = ["corridor.wkt", "corridor.dxf --plan-unit 0.001"].map(|map| {
        let all = replayed(at, &format!("streams.txt --map {map} --every 0 --radius 0.15"));
        (all["from_entry"].clone(), all["map"].clone())
    });
    assert_eq!(wkt, dxf);
    let text = stdout(&call(at, "replay streams.txt --map corridor.wkt --every 0").success());
    assert!(text.contains("12 people") && text.contains("KS distance") && text.contains("groups     2"), "{text}");
    assert!(!text.contains("ahead") && text.contains("at the end, final"), "{text}");
    // walls that are elsewhere, and the same moved to where they belong
    write("map.xml", "<a><Line x1='-9' y1='98' x2='9' y2='98'/><Line x1='-9' y1='102' x2='9' y2='102'/></a>");
    let moved = replayed(at, "streams.txt --map-offset 0,-100 --every 0 --from 1 --until 4");
    assert_eq!(
        (&moved["map"]["obstacles"], &moved["map"]["through"], &moved["from"]),
        (&2.into(), &0.into(), &1.0.into())
    );
    assert_eq!(replayed(at, "streams.txt --no-map --every 0 --until 2")["map"]["obstacles"], 0);
    let one = replayed(at, "streams.txt --threads 1 --every 2");
    let three = replayed(at, "streams.txt --threads 3 --every 2");
    for key in ["from_entry", "predicted", "speed", "replay"] {
        assert_eq!(one[key], three[key], "{key}");
    }
}

#[test]
fn both_are_drawn_side_by_side() {
    let folder = folder();
    let at = folder.path();
    std::fs::write(at.join("streams.txt"), streams()).unwrap();
    let files = "-o a.png -o a.svg -o a.mp4 -o f/ -o a.rec --fps 2 --size 400x200 --frame 3";
    call(at, &format!("replay streams.txt {files} --every 0 --model rvo -q")).success();
    assert_eq!(names(at), ["a.mp4", "a.png", "a.rec", "a.svg", "f", "streams.txt"]);
    let picture = std::fs::read_to_string(at.join("a.svg")).unwrap();
    assert!(picture.contains("recorded") && picture.contains("rvo") && picture.contains("streams.txt"));
    assert!(names(&at.join("f")).len() > 10);
    assert!(throng_record::Tracks::read(at.join("a.rec")).unwrap().spots[0].time < 1e-6);
}

#[test]
fn mistakes_are_named() {
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
        ("streams.txt --groups bad.txt", "bad.txt:2: `you` is no number of a person"),
        ("streams.txt --map-offset 0,1", "say which map: --map FILE"),
        ("streams.txt --model orcs", "did you mean `orca`?"),
        ("streams.txt --set speed.preferred=1", "chosen by --speed and --radius"),
        ("streams.txt --set avoid.orca.horizon=1", "time_horizon"),
        ("streams.txt --table a.txt", "end the name in .csv"),
        ("streams.txt -o a.xyz", "a.xyz: cannot tell what to write from this name"),
        ("streams.txt --from 3 --until 2", "give --until more than --from"),
        ("streams.txt --from 300", "nobody was seen twice"),
        ("streams.txt --speed fast", "a part such as 50%"),
        ("once.csv", "nobody was seen twice"),
        ("flies.csv", "above the ground"),
        ("none.txt", "cannot read none.txt"),
    ] {
        let told = stderr(&call(at, &format!("replay {arguments}")).code(2));
        assert!(told.contains(text), "{arguments}: {told}");
    }
    assert_eq!(names(at), before);
    let all = replayed(at, "streams.txt --map only-walls.toml --every 0 --until 2");
    assert_eq!(all["map"]["obstacles"], 1, "a map needs nobody in it");
}
