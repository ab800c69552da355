//! Tests of the frame rate that the velocities of a file imply.

use throng_record::{Reading, Trajectories};

/// Returns a table of an agent that walks at 1.3 m/s, a row every 0.4 s, with stated speed `stated`, m/s. `time` is the
/// name of the column of times, which increase by `step`.
fn table(time: &str, step: f64, stated: f64) -> String {
    let row = |k: u32| format!("1,{},{:.3},0,{stated},0\n", step * f64::from(k), 0.52 * f64::from(k));
    (0..20).map(row).fold(format!("number,{time},x,y,vx,vy\n"), |text, row| text + &row)
}

fn notes(text: &str, rate: Option<f64>) -> Vec<String> {
    Trajectories::of_file("a.csv", text.as_bytes(), &Reading { rate, unit: None }).unwrap().notes
}

#[test]
fn a_contradiction_beyond_a_fifth_is_noted() {
    assert_eq!(notes(&table("time", 0.4, 1.3), None), [""; 0]);
    assert_eq!(notes(&table("time", 0.4, 1.5), None), [""; 0]);
    assert!(notes(&table("time", 0.4, 1.6), None)[0].contains("1.23 times"));
    assert!(notes(&table("time", 0.4, 1.0), None)[0].contains("0.77 times"));
    // six frames are 0.4 s at 15 per second
    assert_eq!(notes(&table("frame", 6.0, 1.3), Some(15.0)), [""; 0]);
    let found = notes(&table("frame", 6.0, 1.3), Some(25.0));
    assert!(found[0].contains("0.60 times") && found[0].contains("--frame-rate 15 "), "{found:?}");
}

#[test]
fn standing_turning_and_missing_velocities_are_no_contradiction() {
    let rows = |place: &dyn Fn(u32) -> String| (0..30).map(place).collect::<String>();
    let head = "number,time,x,y,vx,vy\n".to_owned();
    let stands = rows(&|k| format!("1,{k},{},0,0.15,0\n", f64::from(k % 2) * 0.01));
    // back and forth, as stated
    let turns = rows(&|k| format!("1,{k},{},0,{},0\n", k % 2, if k % 2 == 0 { -5 } else { 5 }));
    let few = (0..10).map(|k| format!("1,{k},{k},0,9,0\n")).collect::<String>();
    for text in [stands, turns, few] {
        assert_eq!(notes(&(head.clone() + &text), None), [""; 0], "{text}");
    }
    let silent = rows(&|k| format!("1,{k},{},0\n", 3 * k));
    assert_eq!(notes(&("number,time,x,y\n".to_owned() + &silent), None), [""; 0]);
}

/// Returns a walk at 1.3 m/s, a row every 0.4 s, in a video of `rate` frames per second.
fn video(rate: f64) -> String {
    let row = |k: u32| format!("{} 1 {:.4} 0 2 1.3 0 0\n", 0.4 * rate * f64::from(k), 0.52 * f64::from(k));
    (0..20).map(row).collect()
}

#[test]
fn velocities_imply_the_frame_rate() {
    let interval = |rate: f64, said: Option<f64>| {
        let tracks =
            Trajectories::of_file("obsmat.txt", video(rate).as_bytes(), &Reading { rate: said, unit: None }).unwrap();
        (tracks.spots[1].time - tracks.spots[0].time, tracks.notes.len())
    };
    for (rate, notes) in [(25.0, 0), (15.0, 1), (30.0, 1), (12.5, 1)] {
        let (seconds, found) = interval(rate, None);
        assert!((seconds - 0.4).abs() < 1e-9 && found == notes, "{rate}: {seconds} {found}");
    }
    // the user's rate takes precedence, with a note; an implausible implied rate is ignored, with a note
    assert_eq!(interval(15.0, Some(30.0)), (0.2, 1));
    assert_eq!(interval(1.0, None), (0.016, 1));
}
