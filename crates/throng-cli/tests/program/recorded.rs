//! `throng convert` and `throng render`.

use crate::shared::{call, folder, names, stderr, stdout, throng};
use std::fmt::Write;
use std::path::Path;
use std::time::Duration;

/// Returns two people that walk east at 1 m/s, one of them from 2 s on, with ten moments per second.
fn walk() -> String {
    let mut text = "number,group,time,x,y\n".to_owned();
    for k in 0..=40 {
        let time = f64::from(k) / 10.0;
        let _ = writeln!(text, "7,left,{time},{time},1");
        if k >= 20 {
            let _ = writeln!(text, "12,right,{time},{time},3");
        }
    }
    text
}

/// Returns the heading of a table, and its rows as numbers.
fn rows(folder: &Path, name: &str) -> (String, Vec<Vec<f64>>) {
    let text = std::fs::read_to_string(folder.join(name)).unwrap();
    let (head, rest) = text.split_once('\n').unwrap();
    let row = |line: &str| line.split(',').map(|field| field.parse().unwrap_or(f64::NAN)).collect();
    (head.to_owned(), rest.lines().map(row).collect())
}

#[test]
fn all_formats_are_read_back() {
    let folder = folder();
    let path = folder.path();
    std::fs::write(path.join("walk.csv"), walk()).unwrap();
    call(path, "convert walk.csv -o a.parquet -o a.rec -o a.sqlite -o a.usda -q").success();
    for kind in ["parquet", "rec", "sqlite"] {
        call(path, &format!("convert a.{kind} -o {kind}.csv --columns number,time,x,y -q")).success();
        let (head, found) = rows(path, &format!("{kind}.csv"));
        assert_eq!((head.as_str(), found.len()), ("number,time,x,y", 62));
        for row in found {
            assert!((row[1] - row[2]).abs() < 1e-4, "{kind}: {row:?}");
        }
    }
}

#[test]
fn options_choose_moments_and_people() {
    let folder = folder();
    let path = folder.path();
    std::fs::write(path.join("walk.csv"), walk()).unwrap();
    let chosen = |choice: &str| {
        call(path, &format!("convert walk.csv -o some.csv --columns time,number,x,vx {choice} -q")).success();
        rows(path, "some.csv").1
    };
    let times = |rows: &[Vec<f64>]| rows.iter().map(|row| (row[0] * 100.0).round() / 100.0).collect::<Vec<_>>();
    assert_eq!(times(&chosen("--from 1 --to 1.2")), [1.0, 1.1, 1.2]);
    assert_eq!(times(&chosen("--rate 2 --agents 1-7")), [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
    assert_eq!(times(&chosen("--groups right --to 2.1")), [2.0, 2.1]);
    // Between two moments, positions are interpolated linearly.
    let between = chosen("--rate 40 --from 2.95 --to 3.05 --agents 12");
    assert_eq!(times(&between), [2.95, 2.98, 3.0, 3.03, 3.05]);
    assert!(between.iter().all(|row| (row[2] - row[0]).abs() < 1e-9 && (row[3] - 1.0).abs() < 1e-5), "{between:?}");
}

#[test]
fn options_choose_what_a_run_writes() {
    let folder = folder();
    let path = folder.path();
    let run = "run doorway --duration 2 --no-expect -q";
    call(path, &format!("{run} -o all.csv")).success();
    call(path, &format!("{run} -o some.csv --rate 10 --from 0.5 --to 1.5 --columns time,number,x,y")).success();
    let ((_, all), (_, some)) = (rows(path, "all.csv"), rows(path, "some.csv"));
    let count = all.iter().filter(|row| row[2] == 0.0).count();
    assert_eq!(some.len(), 11 * count);
    // Interpolates independently between the two steps of 0.04 s around each moment.
    for row in &some {
        let place = |step: f64| {
            let time = step * 0.04;
            let found = all.iter().find(|other| other[0] == row[1] && (other[2] - time).abs() < 1e-9);
            found.map(|other| [other[3], other[4]]).unwrap()
        };
        let steps = row[0] / 0.04;
        let (low, part) = ((steps + 1e-6).floor(), steps - (steps + 1e-6).floor());
        let (a, b) = (place(low), place(if part > 1e-6 { low + 1.0 } else { low }));
        for axis in 0..2 {
            assert!((row[2 + axis] - (a[axis] + (b[axis] - a[axis]) * part)).abs() < 1e-6, "{row:?}");
        }
    }
}

#[test]
fn recordings_are_drawn_on_their_map() {
    let folder = folder();
    let path = folder.path();
    call(path, "run doorway --duration 2 --no-expect -q -o run.csv -o run.png").success();
    call(path, "render run.csv --map doorway -o again.png -o bare.png -o film.gif --fps 5 -q").success();
    assert_eq!(names(path), ["again.png", "bare.png", "film.gif", "run.csv", "run.png"]);
    let message = stdout(&call(path, "render run.csv -o run2.svg --from 1 --to 1.5").success());
    assert!(message.contains("wrote run2.svg"), "{message}");
    let svg = std::fs::read_to_string(path.join("run2.svg")).unwrap();
    assert!(svg.contains("1.5 s") || svg.contains("1.50 s"), "the picture shows the last chosen moment");
}

#[test]
fn errors_name_the_problem() {
    let folder = folder();
    std::fs::write(folder.path().join("walk.csv"), walk()).unwrap();
    std::fs::write(folder.path().join("none.csv"), "number,time,x,y\n").unwrap();
    for (arguments, text) in [
        ("convert walk.csv", "--output"),
        ("convert walk.csv -o a.mp4", "`throng render` draws"),
        ("convert walk.csv -o walk.csv", "write under another name"),
        ("convert walk.csv -o a.csv --groups up", "the groups are: left, right"),
        ("convert walk.csv -o a.rec --columns x,y", "the columns of .rec cannot be chosen"),
        ("convert walk.csv -o a.csv --columns x,y,x", "`x` is named twice"),
        ("convert walk.csv -o a.csv --columns speed", "number, group, time"),
        ("convert walk.csv -o a.csv --agents 9-3", "such as 1,5,10-20"),
        ("convert walk.csv -o a.csv --from 30", "it covers 0.00 to 4.00 s"),
        ("convert walk.csv -o a.csv --rate 1e9", "write a lower rate"),
        ("convert none.csv -o a.csv", "the file has no agents"),
        ("render walk.csv -o a.xyz", "cannot tell what to write"),
        ("render missing.rec", "cannot read missing.rec"),
        ("render walk.csv --map nowhere -o a.png", "nowhere"),
        ("render walk.csv --map nowhere.svg -o a.png", "there is no file nowhere.svg"),
        ("render walk.csv --map-offset 1,0 -o a.png", "give a map: --map FILE"),
        ("run doorway -o a.csv --groups up", "there is no group `up`"),
    ] {
        let message = stderr(&call(folder.path(), arguments).code(2));
        assert!(message.contains(text), "{arguments}: {message}");
    }
    assert_eq!(names(folder.path()), ["none.csv", "walk.csv"]);
}

/// One time stamp far from all others: trajectories are written directly, pictures are refused unless `--to` limits
/// them.
#[test]
fn a_distant_time_does_not_loop_endlessly() {
    let folder = folder();
    let path = folder.path();
    std::fs::write(path.join("far.csv"), "number,time,x,y\n1,0,0,0\n1,0.04,0.05,0\n1,1e9,1,0\n").unwrap();
    let call =
        |arguments: &str| throng(path).args(arguments.split_whitespace()).timeout(Duration::from_secs(20)).assert();
    for kind in ["csv", "rec", "sqlite", "parquet", "usda", "glb"] {
        call(&format!("convert far.csv -o a.{kind} -q")).success();
    }
    for output in ["a.mp4", "a.gif", "a.png", "a.svg", "a/"] {
        let message = stderr(&call(&format!("render far.csv -o {output} -q")).code(2));
        let pictures = "error: far.csv: 25000000000 pictures from 0.00 to 1000000000.00 s";
        assert!(message.starts_with(pictures) && message.contains("--from and --to"), "{message}");
        call(&format!("render far.csv -o {output} --size 64x64 --to 1 -q")).success();
    }
    assert_eq!(names(&path.join("a")).len(), 26, "25 pictures per second, and none after the end");
    let message = stderr(&call("convert far.csv -o b.csv --rate 1").code(2));
    assert!(message.contains("far.csv: 1000000000 moments of --rate from 0.00 to 1000000000.00 s"), "{message}");
    let message = stderr(&call("info far.csv").success());
    assert_eq!(message, "");
    let message = stderr(&call("measure far.csv -o a.html").code(2));
    assert!(
        message.contains("far.csv: 25000000000 moments of a page") && message.contains("--from and --to"),
        "{message}"
    );
    call("measure far.csv -o a.html --to 1").success();
    let message = stderr(&call("replay far.csv").code(2));
    assert!(
        message.contains("far.csv: 25000000000 steps from 0.00") && message.contains("--from and --until"),
        "{message}"
    );
}
