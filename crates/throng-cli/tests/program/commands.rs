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
