//! Runs the program under mpirun, and compares its states with those of the undivided world.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use throng_record::Trajectories;

const PROGRAM: &str = env!("CARGO_BIN_EXE_throng-mpi");

/// Returns a command that starts this number of ranks.
fn mpirun(ranks: usize) -> Command {
    let mut command = Command::new("mpirun");
    // Open MPI runs neither as root nor more ranks than cores unless it is told to
    for name in ["OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"] {
        command.env(name, "1");
    }
    command.env("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe");
    command.env("OMPI_MCA_mpi_yield_when_idle", "1");
    command.args(["-n", &ranks.to_string(), PROGRAM]);
    command
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Runs a scene; returns what the program has said.
fn run(ranks: usize, folder: &Path, arguments: &[&str]) -> Output {
    let mut command = mpirun(ranks);
    command.arg("run").args(arguments).arg("-o").arg(folder).args(["--threads", "1"]);
    command.output().expect("mpirun starts")
}

/// Returns the hashes that a run has printed after its steps.
fn hashes(output: &Output) -> Vec<(u64, String)> {
    assert!(output.status.success(), "{}", text(&output.stderr));
    let lines = text(&output.stdout);
    let hash = |line: &str| {
        let mut words = line.split_whitespace();
        Some((words.next()?.parse().ok()?, words.next()?.to_owned())).filter(|(_, hash)| hash.len() == 16)
    };
    lines.lines().filter_map(hash).collect()
}

/// Returns the hashes of the undivided world after its steps.
fn undivided(scene: &str, set: &[(&str, &str)], seconds: f64) -> Vec<(u64, String)> {
    let mut scene = throng_scene::open(scene).unwrap().scene;
    set.iter().for_each(|(key, value)| scene.set(key, value).unwrap());
    let (mut world, _) = scene.build().unwrap();
    let mut hashes = Vec::new();
    while world.time() + 0.5 * scene.time.step < seconds && !world.finished() {
        world.step();
        hashes.push((world.steps(), format!("{:016x}", world.state_hash())));
    }
    hashes
}

/// Compares all states of a run on 1, 2 and 4 ranks with those of the undivided world.
fn assert_same(scene: &str, set: &[(&str, &str)], seconds: f64) {
    let expected = undivided(scene, set, seconds);
    assert!(expected.len() > 20);
    for ranks in [1, 2, 4] {
        let folder = tempfile::tempdir().unwrap();
        let seconds = seconds.to_string();
        let changes: Vec<String> = set.iter().map(|(key, value)| format!("--set={key}={value}")).collect();
        // the ground is divided anew every 7 steps if the ranks are uneven, as they are where cores are few
        let mut arguments = vec![scene, "--hashes", "--every", "0", "--balance", "7", "--time", &seconds];
        arguments.extend(changes.iter().map(String::as_str));
        let output = run(ranks, folder.path(), &arguments);
        assert_eq!(hashes(&output), expected, "{scene} on {ranks} ranks");
    }
}

#[test]
fn crossing_streams_have_the_bits_of_one_world() {
    assert_same("crossing", &[], 6.0);
}

#[test]
fn a_crowd_at_a_door_has_the_bits_of_one_world() {
    assert_same("doorway", &[], 12.0);
}

#[test]
fn counterflow_in_a_corridor_has_the_bits_of_one_world() {
    assert_same("corridor", &[], 12.0);
}

/// A flock with sums in the order of cells, and followers of a leader that may be in another rank.
#[test]
fn flocks_and_leaders_have_the_bits_of_one_world() {
    for (scene, seconds) in [("flocking", 5.0), ("formation", 10.0)] {
        assert_same(scene, &[], seconds);
    }
}

/// Writes a city, and returns its options.
fn city(folder: &Path, people: u32) -> Vec<String> {
    let made =
        Command::new(PROGRAM).args(["city", "--people", &people.to_string(), "-o"]).arg(folder).output().unwrap();
    assert!(made.status.success(), "{}", text(&made.stderr));
    let path = |name: &str| folder.join(name).display().to_string();
    vec![path("city.toml"), "--people".into(), path("people.parquet")]
}

/// People from a file, which no rank has all of, and parts of trajectories that are joined.
#[test]
fn a_city_is_the_same_on_any_number_of_ranks() {
    let folder = tempfile::tempdir().unwrap();
    let city = city(folder.path(), 3000);
    let runs: Vec<_> = [1, 3]
        .into_iter()
        .map(|ranks| {
            let run_folder = folder.path().join(ranks.to_string());
            let mut arguments: Vec<&str> = city.iter().map(String::as_str).collect();
            arguments.extend(["--hashes", "--time", "4", "--every", "0.5"]);
            let hashes = hashes(&run(ranks, &run_folder, &arguments));
            assert_eq!(hashes.len(), 40);
            (hashes, Trajectories::read(&run_folder).unwrap())
        })
        .collect();
    assert_eq!(runs[0].0, runs[1].0);
    assert_eq!(runs[0].1.spots, runs[1].1.spots);
    let first = runs[0].1.spots.partition_point(|spot| spot.time == 0.0);
    assert_eq!(first, 3000);
}

/// Waits until a condition holds.
fn wait(what: &str, child: &mut Child, mut holds: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !holds() {
        assert!(child.try_wait().unwrap().is_none(), "the run ended before {what}");
        assert!(begin.elapsed() < Duration::from_secs(120), "no {what} in two minutes");
        sleep(Duration::from_millis(20));
    }
}

/// Returns the ids of the processes with a folder in their command lines, without mpirun.
fn ranks_of(folder: &Path) -> Vec<String> {
    let named = folder.display().to_string();
    let processes = fs::read_dir("/proc").unwrap().filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let is_rank = |id: &String| {
        let line = fs::read(format!("/proc/{id}/cmdline")).unwrap_or_default();
        text(&line).contains(&named) && text(&line).starts_with(PROGRAM)
    };
    processes.filter(|name| name.bytes().all(|byte| byte.is_ascii_digit())).filter(is_rank).collect()
}

fn signal(kind: &str, process: &str) {
    assert!(Command::new("kill").args([kind, process]).status().unwrap().success());
}

/// A rank is killed; the run goes on from the checkpoint with another number of ranks, and ends in the same state.
#[test]
fn a_run_survives_a_killed_rank() {
    let folder = tempfile::tempdir().unwrap();
    // a moment and a checkpoint after every step: each file holds one moment
    let arguments = ["doorway", "--hashes", "--time", "12", "--every", "0.04", "--checkpoint", "0.000001"];
    let mut command = mpirun(3);
    command.arg("run").args(arguments).arg("-o").arg(folder.path()).args(["--threads", "1"]);
    let mut job = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let manifest = folder.path().join("checkpoint.json");
    let steps = || {
        let manifest: serde_json::Value =
            serde_json::from_slice(&fs::read(&manifest).unwrap_or_default()).unwrap_or_default();
        manifest["steps"].as_u64().unwrap_or(0)
    };
    wait("checkpoint", &mut job, || steps() >= 20);
    signal("-9", &ranks_of(folder.path())[1]);
    assert!(!job.wait().unwrap().success());

    let begun = steps();
    let resumed = run(2, folder.path(), &["doorway", "--resume", "--hashes", "--time", "12", "--every", "0.04"]);
    let expected = undivided("doorway", &[], 12.0);
    assert_eq!(hashes(&resumed), expected[begun as usize..]);
    // the files have every moment once
    let all = Trajectories::read(folder.path()).unwrap();
    let mut times: Vec<f64> = all.spots.iter().map(|spot| spot.time).collect();
    times.dedup();
    assert_eq!(times.len(), 301);
}

/// SIGUSR1 is what a job scheduler sends before the end of the time of a job.
#[test]
fn a_run_that_is_asked_to_end_can_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = mpirun(2);
    command.args(["run", "corridor", "--time", "20", "--threads", "1", "-o"]).arg(folder.path());
    let mut job = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    wait("first file", &mut job, || fs::read_dir(folder.path()).is_ok_and(|mut files| files.next().is_some()));
    signal("-USR1", &ranks_of(folder.path())[0]);
    let output = job.wait_with_output().unwrap();
    assert!(!output.status.success() && text(&output.stderr).contains("--resume goes on"), "{}", text(&output.stderr));

    let resumed = run(1, folder.path(), &["corridor", "--time", "20", "--resume", "--hashes"]);
    assert_eq!(hashes(&resumed).last(), undivided("corridor", &[], 20.0).last());
}

/// Checks that a run ends with this message, on one of the ranks.
fn assert_refused(output: &Output, words: &[&str]) {
    let said = text(&output.stderr);
    assert!(!output.status.success(), "not refused: {}", text(&output.stdout));
    words.iter().for_each(|words| assert!(said.contains(words), "`{words}` is not in:\n{said}"));
}

#[test]
fn what_cannot_be_divided_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |arguments: &[&str], words: &[&str]| assert_refused(&run(2, folder.path(), arguments), words);
    refused(&["boids-open"], &["group `birds`", "wrap around"]);
    refused(&["soccer"], &["rules see the whole world"]);
    refused(&["no-such-scene"], &["no-such-scene"]);
    refused(&["circle", "--people", "none.parquet"], &["cannot read none.parquet"]);
    refused(&["circle", "--set", "time.stap=1"], &["stap"]);
    refused(&["circle", "--every=-1"], &["must not be negative"]);
}

#[test]
fn wrong_people_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let text_file = folder.path().join("people.parquet");
    fs::write(&text_file, "x,y\n1,2\n").unwrap();
    let refused = |words: &[&str]| {
        let arguments = ["circle", "--people", text_file.to_str().unwrap()];
        assert_refused(&run(2, &folder.path().join("run"), &arguments), words);
    };
    refused(&["is no Parquet file", "x, y, goal_x, goal_y"]);
    // a table of trajectories is none of people
    fs::remove_file(&text_file).unwrap();
    let output = throng_record::Output::create(&text_file).unwrap();
    let setting = throng_record::Setting::default();
    let writer = throng_record::formats::parquet::ParquetWriter::new(output, &setting, &[]).unwrap();
    throng_record::Writer::finish(Box::new(writer)).unwrap();
    refused(&["has no column `goal_x`"]);
}

/// Ranks with other scenes, as with other files on two machines.
#[test]
fn ranks_with_other_scenes_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let part = |preferred: &str| {
        let set = format!("group.eastward.speed.preferred={preferred}");
        let folder = folder.path().display().to_string();
        ["-n", "1", PROGRAM, "run", "corridor", "--set", &set, "-o", &folder].map(str::to_owned)
    };
    let mut command = mpirun(1);
    let environment: Vec<_> =
        command.get_envs().filter_map(|(name, value)| Some((name.to_owned(), value?.to_owned()))).collect();
    command = Command::new("mpirun");
    let output = command.envs(environment).args(part("1.2")).arg(":").args(part("1.3")).output().unwrap();
    assert_refused(&output, &["rank 1 has another scene"]);
}

#[test]
fn a_checkpoint_that_does_not_fit_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    assert_refused(&run(2, path, &["corridor", "--resume"]), &["checkpoint.json", "start the run without --resume"]);
    let begun = run(2, path, &["corridor", "--time", "5", "--checkpoint", "0.0001", "--every", "0"]);
    assert!(begun.status.success(), "{}", text(&begun.stderr));
    assert_refused(&run(2, path, &["corridor"]), &["holds a run that can go on"]);
    assert_refused(&run(2, path, &["crossing", "--resume"]), &["a checkpoint of another scene"]);

    let manifest = path.join("checkpoint.json");
    let kept = fs::read_to_string(&manifest).unwrap();
    fs::write(&manifest, kept.replace(env!("CARGO_PKG_VERSION"), "0.0.7")).unwrap();
    assert_refused(&run(2, path, &["corridor", "--resume"]), &["is of version 0.0.7"]);
    fs::write(&manifest, &kept[..20]).unwrap();
    assert_refused(&run(2, path, &["corridor", "--resume"]), &["is no manifest"]);
    fs::write(&manifest, &kept).unwrap();

    let said: serde_json::Value = serde_json::from_str(&kept).unwrap();
    let state = path.join(said["folder"].as_str().unwrap()).join("state-00001");
    let bytes = fs::read(&state).unwrap();
    fs::write(&state, &bytes[..bytes.len() / 2]).unwrap();
    assert_refused(&run(2, path, &["corridor", "--resume"]), &["saved"]);
    fs::remove_file(&state).unwrap();
    assert_refused(
        &run(2, path, &["corridor", "--resume"]),
        &["cannot read the state of rank 1", "copy them to one folder"],
    );
}

/// A rank that cannot write ends the run on all ranks.
#[test]
fn a_full_disk_on_one_rank_ends_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let arguments =
        format!("run crossing --every 0.04 --format rec --time 20 --threads 1 -o {}", folder.path().display());
    // the second rank may write 8 blocks, and gets an error for the next
    let limited = format!("trap '' XFSZ; ulimit -f 8; exec {PROGRAM} {arguments}");
    let mut command = mpirun(1);
    command.args(arguments.split(' ')).args([":", "-n", "1", "bash", "-c", &limited]);
    // Open MPI has the limit too, and may say so in its own words
    assert_refused(&command.output().unwrap(), &["rank 1: cannot write", "a file may not grow larger here"]);
}
