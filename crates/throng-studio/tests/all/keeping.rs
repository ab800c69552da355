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
    let mut document = Document::gallery("circle").unwrap();
    document.edit(format!("# mine\n{}", document.text()));
    let mut memory = Memory::default();
    remember(&mut memory, Draft::KEY, &Draft::of(&document));
    let app = App::new(&eframe::egui::Context::default(), Some(&memory), options).unwrap();
    let mut frame = eframe::Frame::_new_kittest();
    Harness::builder()
        .with_size([1600.0, 900.0])
        .with_max_steps(400)
        .build_ui_state(move |ui, app: &mut App| app.ui(ui, &mut frame), app)
}

/// Returns the draft that the studio would store now.
fn draft(harness: &mut Harness<'static, App>) -> Option<Draft> {
    let mut memory = Memory::default();
    harness.state_mut().save(&mut memory);
    remembered::<Option<Draft>>(&memory, Draft::KEY).unwrap()
}

fn click(harness: &mut Harness<'static, App>, label: &str) {
    harness.get_by_label(label).click();
    harness.run_steps(4);
}

#[test]
fn what_was_not_saved_is_there_again_and_is_asked_about() {
    let mut harness = left(Options::default());
    harness.run_steps(4);
    assert!(harness.query_by_label_contains("restored: the changes of circle").is_some());
    assert!(draft(&mut harness).is_some());
    click(&mut harness, "Ring of 36 among boxes");
    assert!(harness.query_by_label("circle has changes that are not saved.").is_some());
    click(&mut harness, "Keep editing");
    assert!(harness.query_by_label("Keep editing").is_none());
    assert!(draft(&mut harness).is_some(), "the changes are kept");
    click(&mut harness, "Ring of 36 among boxes");
    click(&mut harness, "Discard");
    assert!(harness.query_by_label("Discard").is_none());
    assert_eq!(draft(&mut harness), None);
}

#[test]
fn a_scene_named_at_the_start_is_opened_after_a_question() {
    let mut harness = left(Options { scene: Some("box".into()), ..Options::default() });
    harness.run_steps(4);
    click(&mut harness, "Keep editing");
    assert!(draft(&mut harness).is_some());
}

#[test]
fn after_it_has_stopped_the_text_is_shown_and_nothing_plays() {
    let mut harness = left(Options { rest: true, ..Options::default() });
    harness.run_steps(4);
    assert!(harness.query_by_label_contains("the studio stopped while circle played").is_some());
    assert!(harness.query_by_label("text of the scene").is_some() && draft(&mut harness).is_some());
    assert!(harness.query_by_label("run (Space)").is_none(), "no run exists");
    click(&mut harness, "Ring of 36 among boxes");
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
    click(&mut harness, "Record");
    harness.get_by_label("file").focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(2);
    harness.get_by_label("file").type_text(&path.display().to_string());
    harness.run_steps(2);
    let buttons: Vec<_> = harness.get_all_by_role_and_label(Role::Button, "Record").collect();
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
    click(&mut harness, "Ring of 36 among boxes");
    assert!(harness.query_by_label_contains("flock.mp4 is still being recorded.").is_some());
    click(&mut harness, "Go on recording");
    assert!(harness.query_by_label("Finish now").is_some() && !path.exists());
    click(&mut harness, "Ring of 36");
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
