//! Invalid inputs and their messages: exit code 2, with the position, the error and a hint, and no output file.

use crate::shared::{WALK, call, folder, names, stderr};

/// Asserts that a scene is refused with a message that contains all of `wanted`.
fn refused(scene: &str, wanted: &[&str]) {
    let folder = folder();
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    for command in ["run", "check", "show"] {
        let message = stderr(&call(folder.path(), &format!("{command} scene.toml")).code(2));
        assert!(message.starts_with("error: scene.toml:"), "{message}");
        for part in wanted {
            assert!(message.contains(part), "{part:?} is not in:\n{message}");
        }
    }
    assert_eq!(names(folder.path()), ["scene.toml"]);
}

/// Asserts that arguments are refused with a message that contains all of `wanted`, and leave no file.
fn refuses(arguments: &str, wanted: &[&str]) {
    let folder = folder();
    let message = stderr(&call(folder.path(), arguments).code(2));
    for part in wanted {
        assert!(message.contains(part), "{part:?} is not in:\n{message}");
    }
    assert_eq!(names(folder.path()), Vec::<String>::new());
}

#[test]
fn unknown_key() {
    refused(&WALK.replace("place", "plaec"), &["scene.toml:3:1:", "no key `plaec`", "did you mean `place`?"]);
}

#[test]
fn wrong_type() {
    refused(&WALK.replace("[5.0, 0.0]", "\"there\""), &["scene.toml:4:14:", "the text \"there\"", "a point [x, y]"]);
}

#[test]
fn out_of_range() {
    refused(&format!("{WALK}body.radius = -1\n"), &["scene.toml:5:15:", "body.radius is -1", "more than 0"]);
}

#[test]
fn not_a_number() {
    refused(&WALK.replace("5.0", "nan"), &["scene.toml:4:15:", "is NaN", "finite"]);
}

#[test]
fn not_toml() {
    refused("[[group", &["scene.toml:1:", "this is not TOML"]);
}

#[test]
fn polygon_that_crosses_itself() {
    let ground = "walkable.polygon.outer = [[-5.0, -5.0], [5.0, 5.0], [5.0, -5.0], [-5.0, 5.0]]\n";
    refused(
        &format!("{ground}{WALK}"),
        &["scene.toml:1:26:", "crosses itself at (0, 0)", "in order along the outline"],
    );
}

#[test]
fn agent_in_a_wall() {
    let rock = "[[obstacle]]\nshape.circle = { center = [0.0, 0.0], radius = 1.0 }\n";
    refused(&format!("{WALK}{rock}"), &["scene.toml:3:15:", "starts inside obstacle 1", "move it"]);
}

#[test]
fn two_agents_in_one_place() {
    let twin = WALK.replace("\"a\"", "\"b\"");
    refused(&format!("{WALK}{twin}"), &["scene.toml:7:15:", "start at one place, (0, 0)", "move them apart"]);
}

#[test]
fn goal_in_a_wall() {
    let rock = "[[obstacle]]\nshape.circle = { center = [5.0, 0.0], radius = 1.0 }\n";
    refused(&format!("{WALK}{rock}"), &["scene.toml:4:14:", "the goal, (5, 0), is inside obstacle 1", "move the goal"]);
}

#[test]
fn no_agents() {
    refused("title = \"empty\"\n", &["the scene has no agents", "add a [[group]]"]);
}

#[test]
fn too_many() {
    let many = WALK.replace("point = [0.0, 0.0]", "disc = { center = [0.0, 0.0], radius = 5.0 }");
    refused(&format!("{many}count = 1_000_000_000\n"), &["scene.toml:5:9:", "1000000000 agents", "limit of 20000000"]);
}

#[test]
fn missing_scenes() {
    refuses("run nothing.toml", &["error: there is no file nothing.toml", "hint:"]);
    refuses("run cirle", &["there is no scene `cirle`", "did you mean `circle`?"]);
    refuses("check plan.wkt --exit 0,0,1,1 --people 3", &["plan.wkt"]);
    refuses("run circle --people 3", &["--exit, --people, --plan-unit and --level are for floor plans"]);
}

#[test]
fn invalid_outputs() {
    refuses("run headon -o no/a.mp4", &["no/a.mp4", "there is no folder no"]);
    refuses("run headon -o no/a.csv", &["no/a.csv", "there is no folder no"]);
    refuses("run headon -o no/a/", &["no/a"]);
    refuses("run headon -o a.xyz", &["a.xyz", ".csv", "/ for a folder"]);
    refuses("run headon -o .", &["it is a folder", "end the name in /"]);
    refuses("run headon -o a.csv -o a.csv", &["a.csv is given twice"]);
    // The second file cannot be written, so the first is not written either.
    refuses("run headon -o a.csv -o no/b.csv", &["there is no folder no"]);
}

#[test]
fn invalid_values() {
    refuses("run headon --set foo=1", &["--set foo=1", "no key `foo`"]);
    refuses("run headon --set time.step=abc", &["--set time.step", "should be a number"]);
    refuses("run headon --set time.step=0", &["--set time.step=0", "from 0.00001 to 10"]);
    refuses("run headon --set time.step=1e-9", &["time.step is 0.000000001", "from 0.00001 to 10"]);
    refuses("run headon --set foo", &["write KEY=VALUE"]);
    refuses("run headon --size 3", &["width x height"]);
    refuses("run headon --fps 0", &["greater than 0"]);
    refuses("run headon --limit nan", &["greater than 0"]);
    refuses("run headon --camera 1,1,1,1", &["the camera sees 0 by 0 m"]);
    refuses("run headon --camera 1,1,1", &["four numbers"]);
}

/// Text from files reaches the terminal without control characters, in reports and in errors.
#[test]
fn control_characters_are_escaped() {
    let folder = folder();
    let path = folder.path();
    let evil = r"\u001b]0;pwn\u0007\u001b[31m\u007f\u009b31m\u202e\r";
    let scene = WALK.replace("\"a\"", &format!("\"g{evil}\""));
    let scene = format!("title = \"t{evil}\"\n{scene}");
    std::fs::write(path.join("scene.toml"), &scene).unwrap();
    std::fs::write(path.join("wrong.toml"), format!("{scene}body.radius = -1\n")).unwrap();
    // A file with raw control characters.
    std::fs::write(path.join("raw.toml"), "title = \"\u{1b}[31m\"\n").unwrap();
    std::fs::write(path.join("run.csv"), "number,group,time,x,y\n1,g\u{1b}[31m\u{9b}m,0,0,0\n").unwrap();
    call(path, "run scene.toml -o a.csv").success();
    for (arguments, code) in [
        ("check scene.toml", 0),
        ("run scene.toml -o a.csv --groups b", 2),
        ("run scene.toml -o a.csv --set group.b.count=1", 2),
        ("run wrong.toml", 2),
        ("check wrong.toml", 2),
        ("check raw.toml", 2),
        ("info run.csv", 0),
        ("info run.csv --json", 0),
        ("info a.csv", 0),
        ("measure run.csv --group b", 2),
    ] {
        let output = call(path, arguments).code(code).get_output().clone();
        let message = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
        assert!(message.contains(r"\u001b["), "{arguments}: {message}");
        let control = |c: char| c.is_control() && !matches!(c, '\n' | '\t') || c == '\u{202e}';
        assert!(!message.contains(control), "{arguments}: {message:?}");
    }
}

#[cfg(unix)]
#[test]
fn video_without_ffmpeg() {
    let folder = folder();
    let mut command = crate::shared::throng(folder.path());
    let message = stderr(&command.env("PATH", folder.path()).args(["run", "headon", "-o", "a.mkv"]).assert().code(2));
    assert!(message.contains("ffmpeg") && message.contains("install it"), "{message}");
    assert_eq!(names(folder.path()), Vec::<String>::new());
}

#[cfg(target_os = "linux")]
#[test]
fn full_disk() {
    let folder = folder();
    for name in ["a.csv", "a.mp4", "a.png", "a.gif"] {
        std::os::unix::fs::symlink("/dev/full", folder.path().join(name)).unwrap();
        let message = stderr(&call(folder.path(), &format!("run headon -q --size 160x120 -o {name}")).code(2));
        assert!(message.contains(name) && message.contains("the disk is full"), "{message}");
    }
    let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_throng")).arg("list").stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("the disk is full"));
}
