//! Tests that broken recordings of pedestrians are refused.

use super::shared::draws;
use throng_record::{Reading, Trajectories, TrajectoriesError};

const AT_25: Reading = Reading { rate: Some(25.0), unit: None };

#[test]
fn broken_text_is_an_error_or_read_and_never_large() {
    let files: [(&str, &str); 5] = [
        ("a.txt", "# framerate: 25\n# id frame x/cm y/cm\n1 0 10.5 -2 176\n1 1 11 -2.5 176\n2 1 0 0 180\n"),
        ("obsmat.txt", "1 1 2.5 0 3 0.1 0 -1\n11 1 2.6 0 2 0.1 0 -1\n"),
        ("a.traj", "pedestrianId simTime endTime-PID1 startX startY endX endY\n1 0 0.5 0 0 1 1\n1 0.5 1 1 1 2 1\n"),
        ("b.traj", "timeStep pedestrianId x y targetId\n1 1 0.5 2 1\n2 1 0.7 2 1\n"),
        ("a.csv", "ID,Frame,x,y,v_x,v_y\n21,1010,0.2,-0.1,0.4,0.09\n21,1020,0.3,-0.1,0.4,0.03\n"),
    ];
    let mut draw = draws();
    let pieces: [&[u8]; 9] = [b"\n", b" ", b"-", b"1e300", b"nan", b"#", b"\xff", b",\"", b"4294967296"];
    for (name, text) in files {
        assert!(Trajectories::of_file(name, text.as_bytes(), &AT_25).is_ok(), "{name}");
        for _ in 0..4000 {
            let mut bytes = text.as_bytes().to_vec();
            for _ in 0..=draw() % 4 {
                let at = draw() % (bytes.len() + 1);
                match draw() % 3 {
                    0 => bytes.truncate(at),
                    1 => drop(bytes.splice(at..at, pieces[draw() % pieces.len()].iter().copied())),
                    _ => bytes.get_mut(at).into_iter().for_each(|byte| *byte = draw() as u8),
                }
            }
            match Trajectories::of_file(name, &bytes, &AT_25) {
                Ok(tracks) => assert!(tracks.spots.len() <= 1000 * bytes.len()),
                Err(error) => assert!(matches!(error, TrajectoriesError::Content { .. })),
            }
        }
    }
}
