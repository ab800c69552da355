//! The panels, operated through their widgets.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;
use std::time::Duration;
use throng_record::{Choice, Column};
use throng_scene::gallery;
use throng_studio::document::Document;
use throng_studio::keep::{Answer, Leaving, Unfinished};
use throng_studio::panels::{
    self, Beside, Gallery, Naming, Record, RecordRequest, Recorded, TextRequest, Tuned, Tuning,
};
use throng_studio::play::{Command, Engine, RunMoment, Speed, Trouble};
use throng_studio::settings::Settings;
use throng_studio::view::{Coloring, Heat, Mode, ViewOptions};

fn shown(step: u64) -> Arc<RunMoment> {
    let mut engine = Engine::default();
    engine.command(Command::Load {
        name: "circle".into(),
        scene: Arc::new(gallery::scene("circle").unwrap()),
        run: false,
    });
    engine.command(Command::Seek(step));
    while engine.idle().is_some() {
        engine.work(Duration::from_millis(20));
    }
    engine.shown().unwrap()
}

#[test]
fn the_gallery_finds_and_opens() {
    let mut gallery = Gallery::default();
    gallery.search.push_str("ring 36");
    let about = gallery::scene("box").unwrap().about;
    let mut asked: Option<String> = None;
    let mut harness = Harness::new_ui(|ui| asked = asked.take().or(gallery.ui(ui, &Arc::default(), "box", &about)));
    assert!(harness.query_by_label("Boids of 1987").is_none(), "the search excludes it");
    assert!(harness.query_by_label(about.look_for.as_deref().unwrap()).is_some());
    harness.get_by_label("Ring of 36").click();
    harness.run();
    drop(harness);
    assert_eq!(asked.as_deref(), Some("circle"));
}

#[test]
fn the_bar_plays() {
    let shown = shown(7);
    let (mut settings, mut view, mut asked) = (Settings::default(), ViewOptions::default(), Vec::new());
    let mut harness = Harness::builder().with_size([1100.0, 60.0]).build_ui(|ui| {
        asked.extend(panels::bar(ui, &shown, &mut settings, &mut view));
    });
    for says in ["run (Space)", "one step forward (Right)", "one step back (Left)", "restart (R)"] {
        harness.get_by_label(says).click();
        harness.run();
    }
    drop(harness);
    let asked: Vec<String> = asked.iter().map(|command| format!("{command:?}")).collect();
    assert_eq!(asked, ["Run", "Step", "Back", "Restart"]);
    assert_eq!((settings.speed, view.eye.mode()), (Speed::Times(1.0), Mode::Plan));
}

#[test]
fn the_text_says_what_is_wrong_and_where() {
    let mut document = Document::gallery("circle").unwrap();
    document.edit(document.text().replace("count", "cuont"));
    let mut asked = None;
    let mut harness = Harness::builder().with_size([600.0, 700.0]).build_ui(|ui| {
        asked = asked.or(panels::text(ui, &mut document, None));
    });
    let wrong = "circle.toml:";
    assert!(harness.query_by_label_contains(wrong).is_some());
    harness.get_by_label("Apply").click();
    harness.run();
    harness.get_by_label("Undo").click();
    harness.run();
    assert!(harness.query_by_label_contains(wrong).is_none(), "the edit is undone");
    harness.get_by_label("Apply").click();
    harness.run();
    drop(harness);
    assert_eq!(asked, Some(TextRequest::Apply), "invalid text is not applied");
}

#[test]
fn what_the_player_found_wrong_is_said() {
    let mut document = Document::gallery("circle").unwrap();
    let trouble = Trouble::Panic("a metre is enough".into());
    let harness = Harness::new_ui(|ui| _ = panels::text(ui, &mut document, Some(&trouble)));
    assert!(harness.query_by_label_contains("a metre is enough").is_some());
}

#[test]
fn the_summary_has_the_figures() {
    let shown = shown(120);
    let harness = Harness::new_ui(|ui| panels::summary(ui, &shown));
    assert!(harness.query_by_label("Ring of 36").is_some());
    assert!(harness.query_by_label(&format!("{:016x}", shown.hash)).is_some());
}

#[test]
fn the_help_has_every_key() {
    let mut open = true;
    let harness = Harness::new_ui(|ui| panels::help(ui.ctx(), &mut open));
    for says in ["Tab", "next camera", "double click"] {
        assert!(harness.query_by_label(says).is_some(), "{says}");
    }
}

#[test]
fn sliders_change_the_text() {
    let mut document = Document::gallery("circle").unwrap();
    let (mut tuning, mut last) = (Tuning::default(), None);
    {
        let mut harness = Harness::builder().with_size([500.0, 1400.0]).build_ui(|ui| {
            if let Some(tuned) = tuning.ui(ui, &mut document) {
                last = Some(tuned);
            }
        });
        // the slider that the scene names, and that of the model
        assert_eq!(harness.query_all_by_label("time horizon").count(), 2);
        harness.get_by_role_and_label(eframe::egui::Role::ComboBox, "avoid").click();
        harness.run();
        harness.get_by_label("hrvo").click();
        harness.run();
    }
    assert_eq!(last, Some(Tuned::Changed));
    assert!(document.text().contains("avoid = { hrvo = {} }"), "{}", document.text());
    assert_eq!(document.scene().unwrap().groups[0].avoid, Some(throng_scene::Avoid::named("hrvo")));
    assert!(document.undo() && document.text() == gallery::text("circle").unwrap());
}

#[test]
fn the_view_menu_switches_what_is_seen() {
    let mut settings = Settings::default();
    let setting = shown(0).setting.clone();
    {
        let mut harness = Harness::builder().with_size([500.0, 500.0]).build_ui(|ui| {
            panels::layers(ui, &mut settings, Some(&setting));
        });
        harness.get_by_label("View").click();
        harness.run();
        for says in ["navigation mesh", "grid", "density"] {
            harness.get_by_label(says).click();
            harness.run();
        }
        // the menu stays open and shows the new choices
        harness.get_by_label("10 s").click();
        harness.run();
        assert!(harness.query_by_label("no group follows one").is_some());
    }
    assert!(settings.layers.mesh && !settings.grid);
    assert_eq!((settings.layers.heat, settings.layers.window), (Heat::Density, 10.0));
}

#[test]
fn the_key_says_what_colours_mean() {
    let shown = shown(3);
    for coloring in Coloring::ALL {
        let settings = Settings { coloring, ..Settings::default() };
        let mut view = ViewOptions::default();
        let harness = Harness::builder().with_size([600.0, 500.0]).build_ui(|ui| {
            let response = view.ui(ui, &shown, &settings);
            panels::key(ui, response.rect, &view.key(&shown, &settings), "circle");
        });
        // one group and one model need no key, and no agent flies
        let expected = match coloring {
            Coloring::Group | Coloring::Model => continue,
            Coloring::Goal => "a colour for each goal",
            other => other.label(),
        };
        assert!(harness.query_by_label_contains(expected).is_some(), "{expected}");
    }
}

#[test]
fn a_recording_is_asked_for_and_cancelled() {
    let shown = shown(50);
    let unused = |name: &str, ending: &str| std::path::PathBuf::from(format!("{name}{ending}"));
    let (mut record, mut asked) = (Record::default(), Vec::new());
    record.toggle();
    for share in [None, Some(0.4)] {
        let beside = Beside {
            shown: &shown,
            size: [640, 480],
            corner: [1100.0, 40.0].into(),
            camera: "plan",
            share,
            unused: &unused,
        };
        let mut harness = Harness::builder().with_size([1200.0, 700.0]).build_ui(|ui| {
            asked.extend(record.ui(ui.ctx(), &beside));
        });
        harness.run();
        if share.is_none() {
            harness.get_by_label("now").click();
            harness.run();
            harness.get_by_role_and_label(eframe::egui::Role::Button, "Record").click();
        } else {
            harness.get_by_label("Cancel").click();
        }
        harness.run();
    }
    assert_eq!(asked, [Recorded::Begin, Recorded::Cancel]);
    assert_eq!((record.wish.file.as_str(), record.wish.from), ("circle.mp4", shown.frame.time));
}

#[test]
fn what_trajectories_have_is_chosen() {
    use eframe::egui::Role;
    let mut engine = Engine::default();
    let scene = gallery::scene("crossing").unwrap();
    engine.command(Command::Load { name: "crossing".into(), scene: Arc::new(scene.clone()), run: false });
    engine.command(Command::Beside("rvo".parse().ok()));
    while engine.idle().is_some() {
        engine.work(Duration::from_millis(20));
    }
    let shown = engine.shown().unwrap();
    assert!(shown.setting.groups.len() > 1 && shown.beside.is_some());
    let unused = |name: &str, ending: &str| std::path::PathBuf::from(format!("{name}{ending}"));
    let mut record = Record::default();
    record.toggle();
    let mut sizes = Vec::new();
    {
        let beside = Beside {
            shown: &shown,
            size: [640, 480],
            corner: [1100.0, 40.0].into(),
            camera: "plan",
            share: None,
            unused: &unused,
        };
        let mut harness = Harness::builder().with_size([1200.0, 900.0]).build_ui(|ui| {
            record.ui(ui.ctx(), &beside);
            sizes.push(record.wish.size_beside(&shown, [640, 480]));
        });
        harness.run();
        for (combo, entry) in [("format", "trajectories (.csv, .rec, ..)"), ("models", "rvo")] {
            harness.get_by_role_and_label(Role::ComboBox, combo).click();
            harness.run();
            harness.get_by_label(entry).click();
            harness.run();
        }
        harness.get_by_label("fewer").click();
        harness.run();
        harness.get_by_label("agents").focus();
        harness.run();
        harness.get_by_label("agents").type_text("1, 5-9");
        harness.run();
        let group = shown.setting.groups[0].clone();
        for (menu, entries) in [("groups", vec![group.as_str()]), ("columns", vec!["time", "y"])] {
            harness.get_by_role_and_label(Role::Button, menu).click();
            harness.run();
            for entry in entries {
                harness.get_by_role_and_label(Role::CheckBox, entry).click();
                harness.run();
            }
            harness.key_press(eframe::egui::Key::Escape);
            harness.run();
        }
    }
    assert_eq!((sizes[0], sizes[sizes.len() - 1]), ([1280, 480], [640, 480]), "two views, and one");
    let (wish, group) = (&record.wish, shown.setting.groups[0].clone());
    use throng_studio::record::{Format, Which};
    assert_eq!(wish.which(), Which::Other);
    let both = RecordRequest { which: Which::Both, ..wish.clone() };
    assert_eq!((both.which(), RecordRequest { format: Format::Gif, ..both }.which()), (Which::Own, Which::Both));
    let choice = wish.chosen.choice([1.0, 2.0], std::path::Path::new("a.csv")).unwrap();
    let expected = Choice {
        from: 1.0,
        to: 2.0,
        rate: Some(10.0),
        agents: vec![1..=1, 5..=9],
        groups: vec![group],
        columns: vec![Column::Time, Column::Y],
        ..Choice::default()
    };
    assert_eq!(choice, expected);
    let others = wish.chosen.choice([1.0, 2.0], std::path::Path::new("a.rec")).unwrap();
    assert_eq!(others, Choice { columns: Vec::new(), ..expected }, "the format has no selectable columns");
    record.wish.chosen.agents = "me".into();
    let says = record.wish.chosen.choice([0.0, 1.0], std::path::Path::new("a.csv")).unwrap_err();
    assert!(says.contains("such as 1,5,10-20"), "{says}");
}

#[test]
fn the_text_keeps_the_focus_when_an_error_appears() {
    let mut document = Document::gallery("circle").unwrap();
    let before = document.text().to_owned();
    {
        let mut harness = Harness::builder().with_size([500.0, 700.0]).build_ui(|ui| {
            panels::text(ui, &mut document, None);
        });
        harness.get_by_label("text of the scene").focus();
        harness.run();
        for letter in ["w", "h", "a", "t"] {
            harness.event(eframe::egui::Event::Text(letter.into()));
            harness.run();
        }
    }
    let mut more: Vec<char> = document.text().chars().collect();
    before.chars().for_each(|letter| _ = more.iter().position(|&other| other == letter).map(|at| more.remove(at)));
    more.sort_unstable();
    assert_eq!(more, ['a', 'h', 't', 'w']);
    assert!(document.scene().is_err());
}

#[test]
fn a_model_is_chosen_and_named() {
    let mut model = String::new();
    let mut changed = 0;
    {
        let models = throng_scene::Models::default();
        let mut harness = Harness::new_ui(|ui| changed += u32::from(panels::beside_by(ui, &models, &mut model)));
        harness.get_by_label("beside").click();
        harness.run();
        harness.get_by_label("hrvo").click();
        harness.run();
    }
    assert_eq!((model.as_str(), changed), ("hrvo", 1));
    let scene = gallery::scene("circle").unwrap().with_model(&model.parse().unwrap()).unwrap();
    let harness = Harness::new_ui(|ui| panels::name_of_models(ui, ui.max_rect(), &scene));
    let painted = harness.output().shapes.iter().any(|shape| match &shape.shape {
        eframe::egui::Shape::Text(text) => text.galley.text() == "hrvo",
        _ => false,
    });
    assert!(painted, "the corner names the model");
}

#[test]
fn a_name_is_asked_for_until_it_is_good() {
    let mut naming = Naming::new("Save as", "Save", "name.toml");
    naming.open("mine");
    let mut harness = Harness::builder().with_size([500.0, 300.0]).build_ui_state(
        |ui, (naming, said): &mut (Naming, Vec<String>)| said.extend(naming.ui(ui.ctx())),
        (naming, Vec::new()),
    );
    harness.run();
    harness.event(eframe::egui::Event::Text(".toml".into()));
    harness.run();
    harness.get_by_label("Save").click();
    harness.run();
    assert_eq!(harness.state().1, ["mine.toml"]);
    harness.state_mut().0.answer(Err("there is a file mine.toml already".into()));
    harness.run();
    assert!(harness.query_by_label("there is a file mine.toml already").is_some());
    harness.key_press(eframe::egui::Key::Enter);
    harness.run();
    assert_eq!(harness.state().1.len(), 2, "Enter confirms too");
    harness.key_press(eframe::egui::Key::Escape);
    harness.run();
    assert!(harness.state().0.name.is_none() && harness.query_by_label("Save").is_none());
    harness.state_mut().0.open("");
    harness.run();
    assert!(harness.query_by_label("there is a file mine.toml already").is_none(), "the refusal is cleared");
    harness.get_by_label("Save").click();
    harness.run();
    assert_eq!(harness.state().1.len(), 2, "an empty name is not accepted");
    harness.state_mut().0.answer(Ok(()));
    harness.run();
    assert!(harness.query_by_label("Save").is_none());
}

#[test]
fn what_is_not_done_is_asked_about() {
    let cases = [
        (Unfinished::Text, Leaving::New, "Discard", Answer::Discard),
        (Unfinished::Text, Leaving::Close, "Save", Answer::Save),
        (Unfinished::Text, Leaving::Reload(String::new()), "Take the file's", Answer::Discard),
        (Unfinished::Text, Leaving::Open("box".into()), "Keep editing", Answer::Keep),
        (Unfinished::Recording, Leaving::Close, "Finish and keep", Answer::Save),
        (Unfinished::Recording, Leaving::Close, "Go on recording", Answer::Keep),
        (Unfinished::Recording, Leaving::Open("box".into()), "Finish and keep", Answer::Save),
        (Unfinished::Recording, Leaving::New, "Go on recording", Answer::Beside),
    ];
    for (of, to, label, answer) in cases {
        let mut answers = Vec::new();
        let mut harness = Harness::new_ui(|ui| answers.extend(panels::leaving(ui.ctx(), "circle", &to, of)));
        harness.run();
        assert!(harness.query_by_label_contains("circle").is_some(), "{to:?} names the document");
        harness.get_by_label(label).click();
        harness.run();
        drop(harness);
        assert_eq!(answers, [answer]);
    }
    let mut answers = Vec::new();
    let ask = |ctx: &eframe::egui::Context| panels::leaving(ctx, "circle", &Leaving::New, Unfinished::Text);
    let mut harness = Harness::new_ui(|ui| answers.extend(ask(ui.ctx())));
    harness.key_press(eframe::egui::Key::Escape);
    harness.run();
    drop(harness);
    assert!(answers.contains(&Answer::Keep), "{answers:?}");
}
