//! The commands without a file of their own in this folder.

use crate::shared::{call, folder, names, stderr, stdout, throng};

#[test]
fn every_scene_of_the_list_is_valid() {
    let folder = folder();
    let list = stdout(&call(folder.path(), "list --names").success());
    assert!(list.lines().count() >= 15);
    for name in list.lines() {
        let checked = stdout(&call(folder.path(), &format!("check {name}")).success());
        assert!(checked.starts_with(&format!("{name}: ")), "{checked}");
        assert!(checked.ends_with("the scene is valid\n"), "{checked}");
    }
}

#[test]
fn list_prints_titles_before_names() {
    let list = stdout(&call(folder().path(), "list").success());
    let rows: Vec<(&str, &str)> = list.lines().filter_map(|line| line.strip_prefix("  ")?.rsplit_once("  ")).collect();
    let expected = throng_scene::gallery::names().map(|name| (throng_scene::gallery::title(name).unwrap(), name));
    assert!(rows.iter().map(|(title, name)| (title.trim(), *name)).eq(expected), "{list}");
}

#[test]
fn list_of_a_scene_prints_its_words() {
    let folder = folder();
    let list = |arguments: &str| stdout(&call(folder.path(), &format!("list {arguments}")).success());
    let words = list("arrival");
    for line in [
        "Arrival  (arrival)\n",
        "\n  see       Ten actors walk to their marks and stop on them.",
        "\n  look for  The ten slow down",
        "\n  slider    slowing distance (group.actors.steer.arrive.slowing_distance): 4 m, from 0.1 to 10 m\n",
        "\n  preset    too late: group.actors.steer.arrive.slowing_distance=0.1, group.actors.vehicle.max_force=2.0\n",
    ] {
        assert!(words.contains(line), "{line:?} is not in {words}");
    }
    assert_eq!(list("--long").matches("\n  why ").count(), throng_scene::gallery::names().count());
    assert_eq!(list("air").matches("\n  why ").count(), 3);
    std::fs::write(folder.path().join("walk.toml"), crate::shared::WALK).unwrap();
    assert_eq!(list("walk.toml"), "walk  (walk)\n");
    assert!(stderr(&call(folder.path(), "list nowhere").code(2)).contains("there is no scene `nowhere`"));
}

#[test]
fn a_preset_changes_the_scene_before_set_does() {
    let folder = folder();
    let run = |options: &[&str]| {
        let mut command = throng(folder.path());
        let run = command.args(["run", "circle-lab", "--no-files", "--json", "--limit", "0.1"]).args(options).assert();
        serde_json::from_str::<serde_json::Value>(&stdout(&run.code(1))).unwrap()["agents"].as_u64().unwrap()
    };
    assert_eq!([run(&[]), run(&["--preset", "72 people"])], [36, 72]);
    assert_eq!(run(&["--set", "count=9", "--preset", "72 people"]), 9);
}

#[test]
fn show_draws_the_start() {
    let folder = folder();
    call(folder.path(), "show circle").success();
    call(folder.path(), "show corridor -o corridor.svg --size 300x200").success();
    assert_eq!(names(folder.path()), ["circle.png", "corridor.svg"]);
    assert!(stderr(&call(folder.path(), "show circle -o a.mp4").code(2)).contains("end the name in .png or .svg"));
}

#[test]
fn schema_is_json() {
    let schema = stdout(&call(folder().path(), "schema").success());
    let schema: serde_json::Value = serde_json::from_str(&schema).unwrap();
    assert!(schema["properties"]["group"].is_object());
}

#[test]
fn completions_for_every_shell() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = stdout(&call(folder().path(), &format!("completions {shell}")).success());
        assert!(script.contains("throng") && script.contains("speed-up"), "{shell}");
    }
}

#[test]
fn every_command_has_help() {
    for command in [
        "",
        "run",
        "compare",
        "sweep",
        "bench",
        "list",
        "check",
        "show",
        "sheet",
        "measure",
        "replay",
        "explain",
        "schema",
        "completions",
    ] {
        throng(folder().path()).args(command.split_whitespace()).arg("--help").assert().success();
    }
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_is_not_an_error() {
    use std::process::{Command, Stdio};
    for arguments in [&["list"][..], &["schema"], &["completions", "zsh"], &["run", "headon", "--no-files", "--json"]] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_throng"))
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{arguments:?}: {output:?}");
        assert!(output.stderr.is_empty(), "{arguments:?}: {output:?}");
    }
}
