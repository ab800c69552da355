//! Nothing that people have written is lost.

use eframe::{App as _, Storage};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::collections::BTreeMap;
use throng_studio::document::Document;
use throng_studio::keep::{Draft, remember, remembered};
use throng_studio::{App, Options};

/// What is remembered, in memory.
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

/// A studio that was left with a change of the scene `circle`.
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

/// What would be remembered now.
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
    click(&mut harness, "box");
    assert!(harness.query_by_label("circle has changes that are not saved.").is_some());
    click(&mut harness, "Keep editing");
    assert!(harness.query_by_label("Keep editing").is_none());
    assert!(draft(&mut harness).is_some(), "they are still there");
    click(&mut harness, "box");
    click(&mut harness, "Discard");
    assert!(harness.query_by_label("Discard").is_none());
    assert_eq!(draft(&mut harness), None);
}

#[test]
fn who_asks_for_another_scene_is_asked_first() {
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
    assert!(harness.query_by_label("run (Space)").is_none(), "there is nothing to run");
    click(&mut harness, "box");
    click(&mut harness, "Discard");
    for _ in 0..200 {
        std::thread::sleep(std::time::Duration::from_millis(10));
        harness.run_steps(2);
        if harness.query_by_label("restart (R)").is_some() {
            return;
        }
    }
    panic!("another scene plays");
}

/// A file that was dropped.
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
    assert!(named > 0, "the text panel has its name");
}
