//! The window, operated with mouse and keyboard on a virtual screen. Keys and closing need a window manager.

use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// The time limit of a wait.
const PATIENCE: Duration = Duration::from_secs(60);

/// A virtual screen with a window manager and the studio. Dropping it ends all three.
struct Desk {
    folder: tempfile::TempDir,
    display: String,
    others: Vec<Child>,
    studio: Option<Child>,
}

impl Desk {
    /// Starts the screen.
    fn new() -> Self {
        let screen = ["-screen", "0", "1400x900x24", "-nolisten", "tcp", "-displayfd", "1"];
        let mut server =
            Command::new("Xvfb").args(screen).stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        assert!(!number.is_empty(), "Xvfb does not start");
        let display = format!(":{}", number.trim());
        let mut desk = Self { folder: tempfile::tempdir().unwrap(), display, others: vec![server], studio: None };
        let manager = desk.command("openbox").stderr(Stdio::null()).spawn().unwrap();
        desk.others.push(manager);
        desk
    }

    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.env("DISPLAY", &self.display).env_remove("WAYLAND_DISPLAY").env("LIBGL_ALWAYS_SOFTWARE", "1");
        command.env("HOME", self.folder.path()).env_remove("XDG_DATA_HOME").current_dir(self.folder.path());
        // programs of a test, and no services of the machine's desktop
        let programs = std::env::var("PATH").unwrap_or_default();
        command.env("PATH", format!("{}:{programs}", self.folder.path().display()));
        command.env("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent");
        command
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.folder.path().join(name)
    }

    /// Starts the studio and waits until it shows a scene.
    fn start(&mut self, arguments: &[&str]) {
        let _ = std::fs::remove_file(self.path("state.json"));
        let mut command = self.command(env!("CARGO_BIN_EXE_throng-studio"));
        self.studio = Some(command.args(["--state", "state.json"]).args(arguments).spawn().unwrap());
        self.wait("the studio shows a scene", |_| true);
        let find = "search --sync --onlyvisible --name ^throng$ windowactivate --sync windowsize --sync 1280 800";
        self.xdotool(find);
        // a view needs some frames to settle its size
        std::thread::sleep(Duration::from_millis(800));
    }

    fn xdotool(&self, script: &str) {
        let done = self.command("xdotool").args(script.split(' ')).stdout(Stdio::null()).status().unwrap();
        assert!(done.success(), "xdotool {script}");
    }

    fn key(&self, key: &str) {
        self.xdotool(&format!("key --delay 60 {key}"));
    }

    /// Presses *Browse...* of a window that asks for a name, with keys: from the field over the button that takes the name.
    fn browse(&self) {
        for key in ["Tab", "Tab", "space"] {
            // the focus moves once a frame
            std::thread::sleep(Duration::from_secs(1));
            self.key(key);
        }
    }

    /// Clicks at a position of the window.
    fn click(&self, x: i32, y: i32) {
        self.xdotool(&format!("getactivewindow mousemove --window %1 --sync {x} {y} sleep 0.2 click 1 sleep 0.1"));
    }

    /// Waits until the state of the studio meets a condition.
    fn wait(&mut self, what: &str, so: impl Fn(&Value) -> bool) -> Value {
        let begin = Instant::now();
        let mut last = Value::Null;
        while begin.elapsed() < PATIENCE {
            let text = std::fs::read_to_string(self.path("state.json")).unwrap_or_default();
            if let Ok(state) = serde_json::from_str::<Value>(&text) {
                if so(&state) {
                    return state;
                }
                last = state;
            }
            let ended = self.studio.as_mut().and_then(|studio| studio.try_wait().unwrap());
            assert_eq!(ended, None, "it has ended before {what}");
            std::thread::sleep(Duration::from_millis(50));
        }
        self.picture(Path::new("/tmp/throng-window.png"));
        panic!("{what}: {last}; a picture of the screen is in /tmp/throng-window.png");
    }

    /// Waits until the studio exits by itself. Returns whether it succeeded.
    fn ends(&mut self) -> bool {
        let begin = Instant::now();
        let studio = self.studio.as_mut().unwrap();
        while begin.elapsed() < PATIENCE {
            if let Some(status) = studio.try_wait().unwrap() {
                return status.success();
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        panic!("it does not end");
    }

    fn kill(&mut self) {
        if let Some(mut studio) = self.studio.take() {
            studio.kill().unwrap();
            studio.wait().unwrap();
        }
    }

    fn picture(&self, path: &Path) {
        let _ = self.command("import").args(["-window", "root"]).arg(path).status();
    }
}

impl Drop for Desk {
    fn drop(&mut self) {
        for child in self.studio.iter_mut().chain(self.others.iter_mut().rev()) {
            // fails only for a program that has ended
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

fn asks(state: &Value, what: &str) -> bool {
    state["asks"].as_str().is_some_and(|says| says.contains(what))
}

/// The position of the button that runs and pauses, in the window.
const RUN: (i32, i32) = (100, 775);
/// A position in the view without agents.
const EMPTY: (i32, i32) = (560, 500);

pub fn a_scene_is_played_directed_lost_and_found() {
    let mut desk = Desk::new();
    desk.start(&["circle", "--at-step", "3"]);
    desk.wait("it is paused at its step", |state| state["step"] == 3 && state["playing"] == false);
    desk.click(RUN.0, RUN.1);
    desk.wait("a click runs it", |state| state["playing"] == true && state["step"].as_u64() > Some(10));
    desk.key("space");
    desk.wait("a key pauses it", |state| state["playing"] == false);
    // 2, 4 and 10 times real time, then as fast as possible
    (0..4).for_each(|_| desk.key("f"));
    desk.key("space");
    let end = desk.wait("it runs to its end", |state| state["over"] == true);
    assert_eq!((&end["agents"], &end["arrived"]), (&36.into(), &36.into()));
    desk.key("Left");
    desk.wait("a step back", |state| state["over"] == false && state["step"].as_u64() < end["step"].as_u64());
    desk.key("s");
    desk.wait("a key selects", |state| state["selected"].is_u64());

    // unsaved changes
    desk.key("p");
    desk.click(EMPTY.0, EMPTY.1);
    desk.wait("an agent is added", |state| state["agents"] == 37 && state["unsaved"] == true);
    desk.key("alt+F4");
    desk.wait("closing asks", |state| asks(state, "Close the studio?"));
    desk.key("Escape");
    desk.wait("it stays", |state| state["asks"].is_null());
    // a thread stores the draft every 3 s
    std::thread::sleep(Duration::from_millis(4500));
    desk.kill();
    desk.start(&[]);
    desk.wait("it comes back after a crash", |state| state["agents"] == 37 && state["unsaved"] == true);

    // a file that other programs change
    desk.key("ctrl+s");
    desk.wait("it is saved", |state| state["unsaved"] == false);
    let file = desk.path("circle.toml");
    let saved = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, saved.replace("Ring of 36", "Ring of others")).unwrap();
    desk.wait("the changed file runs", |state| state["title"] == "Ring of others");
    desk.key("p");
    desk.click(EMPTY.0 + 60, EMPTY.1);
    desk.wait("an agent is added", |state| state["unsaved"] == true);
    std::fs::write(&file, saved.replace("Ring of 36", "Ring of none")).unwrap();
    desk.wait("a question chooses between the two texts", |state| asks(state, "changed by another program"));
    desk.key("Escape");
    desk.wait("the own text stays", |state| state["asks"].is_null() && state["unsaved"] == true);
    assert!(std::fs::read_to_string(&file).unwrap().contains("Ring of none"));
    desk.key("ctrl+s");
    desk.wait("it is saved", |state| state["unsaved"] == false);
    assert!(std::fs::read_to_string(&file).unwrap().contains("Ring of others"));
    desk.key("alt+F4");
    assert!(desk.ends());
}

pub fn a_film_is_replayed() {
    let mut desk = Desk::new();
    let rows: String = (0..50).map(|k| format!("1,{0},{0},0\n2,{0},0,{0}\n", f64::from(k) * 0.1)).collect();
    std::fs::write(desk.path("two.csv"), format!("number,time,x,y\n{rows}")).unwrap();
    desk.start(&["two.csv"]);
    desk.key("f");
    let end = desk.wait("it runs to its end", |state| state["over"] == true);
    assert_eq!((&end["agents"], &end["step"], &end["scene"]), (&2.into(), &49.into(), &"two".into()));
    desk.key("alt+F4");
    assert!(desk.ends(), "there is nothing to lose");
}

pub fn a_file_is_chosen_in_the_dialog_of_the_system() {
    use std::os::unix::fs::PermissionsExt;
    let mut desk = Desk::new();
    let file = desk.path("chosen.toml");
    std::fs::write(&file, "title = \"Chosen\"\n[[group]]\nplace.point = [0, 0]\ngoal.point = [9, 0]\n").unwrap();
    // without a portal, the dialog is that of the program zenity, which prints the path
    let dialog = desk.path("zenity");
    std::fs::write(&dialog, format!("#!/bin/sh\necho \"$*\" >> asked\necho {}\n", file.display())).unwrap();
    std::fs::set_permissions(&dialog, std::fs::Permissions::from_mode(0o755)).unwrap();
    desk.start(&["circle", "--at-step", "3"]);
    desk.key("ctrl+o");
    desk.wait("a name is asked for", |state| state["asks"] == "Open");
    desk.browse();
    desk.wait("the chosen scene runs", |state| state["title"] == "Chosen");
    let asked = std::fs::read_to_string(desk.path("asked")).unwrap();
    assert!(asked.contains("--file-selection") && asked.contains("*.toml"), "{asked}");
    // the dialog has asked whether the file is replaced
    desk.key("p");
    desk.click(EMPTY.0, EMPTY.1);
    desk.wait("an agent is added", |state| state["agents"] == 2 && state["unsaved"] == true);
    desk.key("ctrl+shift+s");
    desk.wait("a name is asked for", |state| state["asks"] == "Save as");
    desk.browse();
    desk.wait("it is saved", |state| state["unsaved"] == false);
    assert!(std::fs::read_to_string(&file).unwrap().len() > 90, "the file has the new agent");
    desk.key("alt+F4");
    assert!(desk.ends(), "there is nothing to lose");
}

/// Returns the red, green and blue of the pixels of a picture of the window.
fn pixels(desk: &mut Desk, arguments: &[&str]) -> Vec<[u8; 3]> {
    let path = desk.path("picture.png");
    let mut command = desk.command(env!("CARGO_BIN_EXE_throng-studio"));
    command.args(["--size", "900x600", "--screenshot", "picture.png"]).args(arguments);
    let plain = ["panels.gallery=false", "panels.summary=false", "trails=0", "grid=false"];
    desk.studio = Some(command.args(plain.iter().flat_map(|setting| ["--with", setting])).spawn().unwrap());
    assert!(desk.ends(), "it takes a picture");
    let mut reader = png::Decoder::new(BufReader::new(std::fs::File::open(path).unwrap())).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let channels = info.color_type.samples();
    bytes[..info.buffer_size()].chunks_exact(channels).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}

pub fn people_walk_in_a_view_in_space() {
    let mut desk = Desk::new();
    let circle = ["circle", "--at-step", "150", "--camera", "orbit"];
    let people = pixels(&mut desk, &circle);
    assert!(people == pixels(&mut desk, &circle), "the same moment is the same picture");
    let walkers = pixels(&mut desk, &[&circle[..], &["--with", "layers.people=false"]].concat());
    // clothes have warm colours, the agents of the group are blue
    let warm = |pixels: &[[u8; 3]]| pixels.iter().filter(|[r, _, b]| *r > b.saturating_add(30)).count();
    assert!(warm(&people) > 800 && warm(&walkers) < 50, "{} and {} warm pixels", warm(&people), warm(&walkers));
    let speed = pixels(&mut desk, &[&circle[..], &["--with", "coloring=Speed"]].concat());
    let differ = people.iter().zip(&speed).filter(|(a, b)| a != b).count();
    assert!(differ > 500, "tops have the colour of the speed: {differ} pixels differ");
}
