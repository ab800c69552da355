//! Unsaved work is never lost without a question.

use eframe::{App as _, Storage};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::collections::BTreeMap;
use throng_studio::document::Document;
use throng_studio::keep::{Draft, remember, remembered};
use throng_studio::{App, Options};

/// A storage in memory.
#[derive(Default)]
struct Memory(BTreeMap<String, String>);

impl Storage for Memory {
    fn get_string(&self, key: &str) -> Option<String> {
        self.0.get(key).cloned()
    }

    fn set_string(&mut self, key: &str, value: String) {
        self.0.insert(key.into(), value);
    }

    fn remove_string(&mut self, key: &str) {
        self.0.remove(key);
    }

    fn flush(&mut self) {}
}

/// Opens a studio that was closed with an unsaved change of the scene `circle`.
fn left(options: Options) -> Harness<'static, App> {
    left_with(|text| format!("# mine\n{text}"), options)
}

/// Opens a studio that was closed with an unsaved text of the scene `circle`.
fn left_with(edit: impl Fn(&str) -> String, options: Options) -> Harness<'static, App> {
    let mut document = Document::gallery("circle").unwrap();
    document.edit(edit(document.text()));
    let mut memory = Memory::default();
    remember(&mut memory, Draft::KEY, &Draft::of(&document));
    let app = App::new(&eframe::egui::Context::default(), Some(&memory), options).unwrap();
    let mut frame = eframe::Frame::_new_kittest();
    Harness::builder()
        .with_size([1600.0, 900.0])
        .with_max_steps(400)
        .build_ui_state(move |ui, app: &mut App| app.ui(ui, &mut frame), app)
}

/// Waits until a label exists.
fn wait(harness: &mut Harness<'static, App>, label: &str) {
    for _ in 0..400 {
        if harness.query_all_by_label_contains(label).next().is_some() {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
        harness.run_steps(2);
    }
    panic!("there is no {label}");
}

/// Returns the draft that the studio would store now.
fn draft(harness: &mut Harness<'static, App>) -> Option<Draft> {
    let mut memory = Memory::default();
    harness.state_mut().save(&mut memory);
    remembered::<Option<Draft>>(&memory, Draft::KEY).unwrap()
}

fn click(harness: &mut Harness<'static, App>, label: &str) {
    // scenes with citations are in the gallery twice
    harness.get_all_by_label(label).next().unwrap().click();
    harness.run_steps(4);
}

#[test]
fn what_was_not_saved_is_there_again_and_is_asked_about() {
    let mut harness = left(Options::default());
    harness.run_steps(4);
    assert!(harness.query_by_label_contains("restored: the changes of circle").is_some());
    assert!(draft(&mut harness).is_some());
    click(&mut harness, "Seek and flee");
    assert!(harness.query_by_label("circle has changes that are not saved.").is_some());
    click(&mut harness, "Keep editing");
    assert!(harness.query_by_label("Keep editing").is_none());
    assert!(draft(&mut harness).is_some(), "the changes are kept");
    click(&mut harness, "Seek and flee");
    click(&mut harness, "Discard");
    assert!(harness.query_by_label("Discard").is_none());
    assert_eq!(draft(&mut harness), None);
}

#[test]
fn a_scene_named_at_the_start_opens_and_the_unsaved_text_waits() {
    let mut harness = left(Options { scene: Some("box".into()), ..Options::default() });
    wait(&mut harness, "restart (R)");
    assert!(harness.query_by_label("Keep editing").is_none() && draft(&mut harness).is_none());
    let aside = |harness: &mut Harness<'static, App>| {
        let mut memory = Memory::default();
        harness.state_mut().save(&mut memory);
        remembered::<Vec<Draft>>(&memory, Draft::ASIDE).unwrap().len()
    };
    assert_eq!(aside(&mut harness), 1, "it is stored again");
    assert!(harness.query_by_label("circle has changes of an earlier session that were not saved.").is_some());
    click(&mut harness, "Open them");
    assert!(harness.query_by_label("Open them").is_none());
    assert!(draft(&mut harness).is_some() && aside(&mut harness) == 0);
}

/// A text that is no scene, and a scene that cannot be built.
#[test]
fn an_invalid_draft_opens_its_text_and_the_saved_scene_plays() {
    let edits: [fn(&str) -> String; 2] =
        [|text| text.replace("count", "cuont"), |text| text.replace("preferred = 1.5", "preferred = 1.8")];
    for (edit, says) in edits.into_iter().zip(["cuont", "speed.max is 1.5"]) {
        let mut harness = left_with(edit, Options::default());
        wait(&mut harness, "restart (R)");
        wait(&mut harness, says);
        assert!(harness.query_by_label("text of the scene").is_some());
        assert!(draft(&mut harness).is_some());
    }
}

#[test]
fn after_it_has_stopped_the_text_is_shown_and_nothing_plays() {
    let mut harness = left(Options { rest: true, ..Options::default() });
    harness.run_steps(4);
    assert!(harness.query_by_label_contains("the studio stopped while circle played").is_some());
    assert!(harness.query_by_label("text of the scene").is_some() && draft(&mut harness).is_some());
    assert!(harness.query_by_label("run (Space)").is_none(), "no run exists");
    click(&mut harness, "Seek and flee");
    click(&mut harness, "Discard");
    for _ in 0..200 {
        std::thread::sleep(std::time::Duration::from_millis(10));
        harness.run_steps(2);
        if harness.query_by_label("restart (R)").is_some() {
            return;
        }
    }
    panic!("another scene does not play");
}

/// A dropped file.
#[derive(Debug)]
struct Dropped(std::path::PathBuf);

impl eframe::egui::DroppedFile for Dropped {
    fn path(&self) -> &std::path::Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

#[test]
fn what_is_dropped_is_opened_once_it_was_asked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, "title = \"dropped\"\n[[group]]\nname = \"a\"\ncount = 3\nplace.point = [1, 2]\n").unwrap();
    let mut harness = left(Options { with: vec!["panels.text=true".into()], ..Options::default() });
    harness.run_steps(4);
    harness.input_mut().dropped_files.push(std::sync::Arc::new(Dropped(path.clone())));
    harness.run_steps(4);
    assert!(harness.query_by_label("circle has changes that are not saved.").is_some());
    click(&mut harness, "Discard");
    let named = harness.query_all_by_label_contains(&path.display().to_string()).count();
    assert!(named > 0, "the text panel shows its name");
}

/// A saved file is named with its folder for some seconds, and is offered later.
#[test]
fn a_saved_file_is_named_and_remembered() {
    use eframe::egui::{Key, Modifiers};
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    std::fs::write(&path, "[[group]]\ncount = 3\nplace.ring = { radius = 4 }\n").unwrap();
    let options = Options { scene: Some(path.display().to_string()), ..Options::default() };
    let app = App::new(&eframe::egui::Context::default(), None, options).unwrap();
    let mut frame = eframe::Frame::_new_kittest();
    let mut harness = Harness::builder()
        .with_size([1600.0, 900.0])
        .with_max_steps(400)
        .build_ui_state(move |ui, app: &mut App| app.ui(ui, &mut frame), app);
    wait(&mut harness, "restart (R)");
    let mut raw = eframe::egui::RawInput::default();
    let (key, modifiers) = (Key::S, Modifiers::COMMAND);
    raw.events.push(eframe::egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers });
    let window = eframe::egui::Context::default();
    harness.state_mut().raw_input_hook(&window, &mut raw);
    harness.run_steps(4);
    let says = format!("saved: {}", path.display());
    assert!(harness.query_all_by_label_contains(&says).next().is_some());
    let mut memory = Memory::default();
    harness.state_mut().save(&mut memory);
    let settings: throng_studio::settings::Settings = remembered(&memory, eframe::APP_KEY).unwrap();
    assert_eq!(settings.recent, [path.display().to_string()]);
    click(&mut harness, "Open…");
    assert!(harness.query_all_by_label(&path.display().to_string()).next().is_some(), "it is offered");
}

#[test]
fn settings_are_reset_after_a_question() {
    let with = ["dark=true", "panels.plots=true", "trails=0"].map(str::to_owned).to_vec();
    let mut harness = left(Options { with, ..Options::default() });
    wait(&mut harness, "restart (R)");
    let settings = |harness: &mut Harness<'static, App>| -> throng_studio::settings::Settings {
        let mut memory = Memory::default();
        harness.state_mut().save(&mut memory);
        remembered(&memory, eframe::APP_KEY).unwrap()
    };
    assert!(settings(&mut harness).dark);
    let help = |harness: &mut Harness<'static, App>| {
        harness.get_by_role_and_label(eframe::egui::Role::Button, "?").click();
        harness.run_steps(4);
    };
    for (answer, dark) in [("Keep", true), ("Reset", false)] {
        help(&mut harness);
        click(&mut harness, "Reset all settings…");
        click(&mut harness, answer);
        assert_eq!((settings(&mut harness).dark, settings(&mut harness).panels.plots), (dark, dark));
        help(&mut harness);
    }
    assert_eq!(settings(&mut harness), throng_studio::settings::Settings::default());
    assert!(draft(&mut harness).is_some(), "the text stays");
}

/// Opens a studio that records a long scene to this file. Returns it with the context of its window.
fn recording(path: &std::path::Path) -> (Harness<'static, App>, eframe::egui::Context) {
    use eframe::egui::{Key, Modifiers, Role};
    let options = Options { scene: Some("flocking".into()), ..Options::default() };
    let window = eframe::egui::Context::default();
    let app = App::new(&window, None, options).unwrap();
    let mut frame = eframe::Frame::_new_kittest();
    let mut harness = Harness::builder()
        .with_size([1600.0, 900.0])
        .with_max_steps(400)
        .build_ui_state(move |ui, app: &mut App| app.ui(ui, &mut frame), app);
    for _ in 0..400 {
        std::thread::sleep(std::time::Duration::from_millis(10));
        harness.run_steps(2);
        if harness.query_by_label("restart (R)").is_some() {
            break;
        }
    }
    click(&mut harness, "Export");
    harness.get_by_label("file").focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(2);
    harness.get_by_label("file").type_text(&path.display().to_string());
    harness.run_steps(2);
    let buttons: Vec<_> = harness.get_all_by_role_and_label(Role::Button, "Export").collect();
    buttons.last().unwrap().click();
    harness.run_steps(4);
    assert!(harness.query_by_label("Finish now").is_some(), "the recording is under way");
    (harness, window)
}

#[test]
fn a_recording_is_finished_or_goes_on_when_something_else_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flock.mp4");
    let (mut harness, _) = recording(&path);
    click(&mut harness, "Seek and flee");
    assert!(harness.query_by_label_contains("flock.mp4 is still being recorded.").is_some());
    click(&mut harness, "Go on recording");
    assert!(harness.query_by_label("Finish now").is_some() && !path.exists());
    click(&mut harness, "Pursuit and evasion");
    click(&mut harness, "Finish and keep");
    for _ in 0..400 {
        if path.exists() {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
        harness.run_steps(2);
    }
    panic!("the finished part is not kept");
}

#[test]
fn the_window_does_not_close_before_a_recording_is_complete() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flock.mp4");
    let (mut harness, window) = recording(&path);
    let close = |harness: &mut Harness<'static, App>| {
        let viewport = harness.input_mut().viewports.entry(eframe::egui::ViewportId::ROOT).or_default();
        viewport.events.push(eframe::egui::ViewportEvent::Close);
        harness.run_steps(1);
        harness.input_mut().viewports.entry(eframe::egui::ViewportId::ROOT).or_default().events.clear();
        harness.run_steps(3);
    };
    close(&mut harness);
    assert!(harness.query_by_label_contains("Close the studio?").is_some());
    click(&mut harness, "Go on recording");
    assert!(harness.query_by_label_contains("Close the studio?").is_none() && !path.exists());
    close(&mut harness);
    click(&mut harness, "Finish and keep");
    for _ in 0..400 {
        std::thread::sleep(std::time::Duration::from_millis(10));
        harness.run_steps(1);
        let mut output = window.run_ui(eframe::egui::RawInput::default(), |_| {});
        output.textures_delta.clear();
        let mut commands = output.viewport_output.values().flat_map(|viewport| &viewport.commands);
        if commands.any(|command| matches!(command, eframe::egui::ViewportCommand::Close)) {
            assert!(path.exists(), "the file is complete first");
            return;
        }
    }
    panic!("the window does not close");
}

/// Errors of the command line end the program before a window opens.
#[test]
fn a_scene_that_does_not_exist_is_an_error() {
    for (arguments, says) in [
        (&["circel"][..], "did you mean circle"),
        (&["plans/none.toml"], "there is no file plans/none.toml"),
        (&["circle", "--with", "coloring=loud"], "coloring is one of: group, speed"),
    ] {
        let done = std::process::Command::new(env!("CARGO_BIN_EXE_throng-studio")).args(arguments).output().unwrap();
        let error = String::from_utf8_lossy(&done.stderr);
        assert!(!done.status.success() && error.contains(says), "{arguments:?}: {error}");
    }
}
