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
    self, Asks, Beside, Gallery, Named, Naming, Offered, Record, RecordRequest, Recorded, TextRequest, Tuned, Tuning,
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
fn a_search_says_what_it_finds_and_does_not_hide_the_open_scene() {
    let about = gallery::scene("box").unwrap().about;
    let state = (Gallery::default(), "box");
    let mut harness = Harness::builder().with_size([300.0, 900.0]).build_ui_state(
        |ui, (gallery, open): &mut (Gallery, &str)| _ = gallery.ui(ui, &Arc::default(), open, &about),
        state,
    );
    harness.run();
    harness.state_mut().0.search = "boids qwerty".into();
    harness.run();
    assert!(harness.query_by_label_contains("No scene has all words of “boids qwerty”").is_some());
    harness.get_by_label("Clear").click();
    harness.run();
    assert!(harness.state().0.search.is_empty() && harness.query_by_label("Clear").is_none());
    assert!(harness.query_by_label("Swarms").is_some(), "all topics");
    for (search, open, left) in [("boids", "boids-in-box", "boids"), ("boids", "circle", "")] {
        harness.state_mut().0.search = search.into();
        harness.state_mut().1 = open;
        harness.run();
        assert_eq!(harness.state().0.search, left, "{open}");
    }
}

#[test]
fn the_bar_plays() {
    let shown = shown(7);
    let (mut settings, mut view, mut asked) = (Settings::default(), ViewOptions::default(), Vec::new());
    let mut timeline = panels::Timeline::default();
    let mut harness = Harness::builder().with_size([1100.0, 90.0]).build_ui(|ui| {
        asked.extend(panels::bar(ui, &shown, &mut settings, &mut view, &mut timeline, None).commands);
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
        asked = asked.or(panels::text(ui, &mut document, &mut true, None));
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
    let harness = Harness::new_ui(|ui| _ = panels::text(ui, &mut document, &mut true, Some(&trouble)));
    assert!(harness.query_by_label_contains("a metre is enough").is_some());
}

#[test]
fn the_summary_begins_with_what_happened() {
    let shown = shown(120);
    let mut harness = Harness::builder().with_size([300.0, 900.0]).build_ui(|ui| panels::summary(ui, &shown));
    for says in ["Ring of 36", "0 of 36", "mean speed", "overlaps"] {
        assert!(harness.query_by_label(says).is_some(), "{says}");
    }
    let hash = format!("{:016x}", shown.hash);
    assert!(harness.query_by_label(&hash).is_none(), "figures of the engine are folded");
    harness.get_by_label("computation").click();
    harness.run();
    assert!(harness.query_by_label(&hash).is_some());
}

#[test]
fn the_help_has_every_key() {
    let mut open = true;
    let harness = Harness::new_ui(|ui| _ = panels::help(ui.ctx(), &mut open));
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
        // the slider that the scene names, and that of the model, each with its name
        assert_eq!(harness.query_all_by_role_and_label(eframe::egui::Role::Slider, "time horizon").count(), 2);
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

/// The preferred speed must not exceed the greatest speed: the slider stops there, and says why.
#[test]
fn a_slider_stops_where_the_scene_would_be_invalid() {
    use eframe::egui::{Event, Modifiers, PointerButton, Role, pos2};
    let mut document = Document::gallery("circle").unwrap();
    document.set("group.0.speed.preferred", 1.2).unwrap();
    let (mut tuning, mut dragged) = (Tuning::default(), 0);
    {
        let mut harness = Harness::builder().with_size([500.0, 1800.0]).build_ui(|ui| {
            dragged += u32::from(matches!(tuning.ui(ui, &mut document), Some(Tuned::Dragged(_))));
        });
        harness.run();
        let slider = harness.get_by_role_and_label(Role::Slider, "preferred").rect();
        let at = |share: f32| pos2(slider.left() + 110.0 * share, slider.center().y);
        let press = |pressed, pos| Event::PointerButton {
            pos,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        harness.event(Event::PointerMoved(at(0.1)));
        harness.event(press(true, at(0.1)));
        harness.run();
        for share in [0.11, 0.12, 0.13, 0.5, 0.9] {
            harness.event(Event::PointerMoved(at(share)));
            harness.run();
        }
        assert!(harness.query_by_label_contains("speed.max is 1.5").is_some(), "it says why while it is dragged");
        harness.event(press(false, at(0.9)));
        harness.run();
        assert!(harness.query_by_label_contains("speed.max is 1.5").is_some(), "and when it is released");
    }
    let preferred = document.value("group.0.speed.preferred").and_then(|value| value.as_float()).unwrap();
    assert!(preferred == 1.5 && dragged > 1, "{preferred}, {dragged}");
    assert!(document.scene().unwrap().build().is_ok());
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
            harness.get_by_role_and_label(eframe::egui::Role::Button, "Export").click();
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
        for (combo, entry) in [("format", "table (.csv)"), ("models", "rvo")] {
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
            panels::text(ui, &mut document, &mut true, None);
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
fn the_last_edits_have_names_and_are_undone() {
    let mut document = Document::gallery("circle").unwrap();
    let before = document.text().to_owned();
    document.set("group.0.count", 12).unwrap();
    document.set("group.0.body.radius", 0.3).unwrap();
    document.set("group.0.body.radius", 0.25).unwrap();
    let mut asked = None;
    let mut harness = Harness::builder().with_size([600.0, 700.0]).build_ui(|ui| {
        asked = panels::text(ui, &mut document, &mut true, None).or(asked);
    });
    harness.get_by_label("Edits").click();
    harness.run();
    assert!(harness.query_by_label("line 12: body = { radius = 0.25 }").is_some());
    harness.get_by_label("line 8: count = 12").click();
    harness.run();
    drop(harness);
    assert_eq!((document.text(), asked), (before.as_str(), Some(TextRequest::Apply)));
}

/// The lines of the text have numbers, and the text scrolls to the line of an error.
#[test]
fn the_line_of_an_error_is_marked_and_visible() {
    let mut document = Document::gallery("boids-in-box").unwrap();
    let lines = document.text().lines().count();
    let mut harness = Harness::builder().with_size([500.0, 360.0]).build_ui(|ui| {
        panels::text(ui, &mut document, &mut true, None);
    });
    let numbers = |harness: &Harness| -> Vec<(usize, eframe::egui::Color32)> {
        let text = |shape: &eframe::egui::Shape| match shape {
            eframe::egui::Shape::Text(text) => {
                let color = text.galley.job.sections.first().map(|section| section.format.color).unwrap_or_default();
                Some((text.galley.text().parse().ok()?, color))
            }
            _ => None,
        };
        harness.output().shapes.iter().filter_map(|shape| text(&shape.shape)).collect()
    };
    harness.run();
    let first = numbers(&harness);
    assert_eq!(first[0].0, 1);
    assert!(first.len() > 5 && first.iter().all(|(_, color)| *color == first[0].1), "{first:?}");
    drop(harness);
    document.edit(format!("{}wrong = 1\n", document.text()));
    let mut harness = Harness::builder().with_size([500.0, 360.0]).build_ui(|ui| {
        panels::text(ui, &mut document, &mut true, None);
    });
    harness.run();
    let last = numbers(&harness);
    let wrong = last.iter().find(|(number, _)| *number == lines + 1).unwrap_or_else(|| panic!("{last:?}"));
    assert!(wrong.1 != last[0].1 && last[0].0 > 1, "{last:?}");
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
fn two_models_have_their_figures_and_differences() {
    let mut engine = Engine::default();
    engine.command(Command::Speed(Speed::Fastest));
    engine.command(Command::Beside("rvo".parse().ok()));
    let scene = Arc::new(gallery::scene("circle").unwrap());
    engine.command(Command::Load { name: "circle".into(), scene, run: true });
    let words = |engine: &mut Engine| {
        let shown = engine.shown().unwrap();
        let other = shown.beside.clone().unwrap();
        let harness = Harness::new_ui(|ui| panels::figures_of_models(ui, &other, &shown));
        let has = |words: &str| harness.query_all_by_label_contains(words).next().is_some();
        [has("36 of 36 arrived"), has(", ended"), has("s later than orca")]
    };
    engine.work(Duration::from_millis(1));
    assert_eq!(words(&mut engine), [false; 3], "on one clock there is no difference of time");
    while engine.idle().is_some() {
        engine.work(Duration::from_millis(50));
    }
    assert_eq!(words(&mut engine), [true; 3]);
}

/// The window of the explanation: what it says without an agent, and where it is.
#[test]
fn the_explanation_offers_an_agent_and_does_not_cover_it() {
    use eframe::egui::{Rect, pos2};
    use throng_studio::panels::{Explained, ExplanationWindow};
    let mut engine = Engine::default();
    let scene = Arc::new(gallery::scene("circle").unwrap());
    engine.command(Command::Load { name: "circle".into(), scene, run: false });
    engine.command(Command::Explain(Some(4)));
    let shown = engine.shown().unwrap();
    let (settings, typeface) = (Settings::default(), throng_draw::Typeface::default());
    let view = Rect::from_min_max(pos2(0.0, 0.0), pos2(1400.0, 700.0));
    let (selected, at) = (None, Some(pos2(1000.0, 300.0)));
    let of = Explained { shown: &shown, selected, at, view, settings: &settings, typeface: &typeface };
    let window = (ExplanationWindow::default(), of, 0);
    let mut harness = Harness::builder()
        .with_size([1400.0, 700.0])
        .build_ui_state(|ui, (window, of, chosen)| *chosen += u32::from(window.ui(ui.ctx(), &mut true, of)), window);
    harness.run();
    harness.get_by_label("Explain an agent").click();
    harness.run();
    assert_eq!(harness.state().2, 1);
    for at in [pos2(1000.0, 300.0), pos2(300.0, 300.0), pos2(1300.0, 600.0)] {
        harness.state_mut().1 = Explained { selected: Some(4), at: Some(at), ..of };
        harness.run_steps(4);
        let rect = harness.get_by_label("Why agent 4 moves as it does").rect();
        assert!(!rect.contains(at) && rect.width() > 400.0, "{rect:?} covers {at}");
    }
    harness.state_mut().1.selected = Some(99);
    harness.run_steps(2);
    assert!(harness.query_by_label("Agent 99 is not in the scene at this time.").is_some());
}

/// Letters keep their size in a small figure, and the caption has all its words.
#[test]
fn letters_of_a_small_explanation_are_readable() {
    use throng_draw::{Figure, Style};
    let (mut world, built) = gallery::scene("circle").unwrap().build().unwrap();
    (0..120).for_each(|_| world.step());
    let why = world.explain(world.id(4)).unwrap();
    let setting = throng_record::moment::setting(&world, &built, "Ring");
    let frame = throng_record::Frame::of(&world);
    let svg = |width, height, letters| {
        let style = Style { width, height, ..Style::default() };
        Figure::explain_in_letters(&setting, &frame, &why, &style, letters).unwrap().svg()
    };
    let (small, large) = (svg(660, 520, 14.2), svg(1200, 760, 14.0));
    let sizes = |svg: &str| {
        let sizes = svg.split("font-size=\"").skip(1).filter_map(|rest| rest.split('"').next()?.parse::<f32>().ok());
        sizes.fold(f32::INFINITY, f32::min)
    };
    assert!(sizes(&small) >= 12.0 && sizes(&small) > sizes(&large), "{} and {}", sizes(&small), sizes(&large));
    // a narrow figure has the plot alone, and where the height is short, the key yields to it
    let narrow = svg(366, 420, 16.5);
    assert!(!narrow.contains("surroundings") && narrow.contains("velocities"));
    assert!(small.contains("surroundings") && small.contains("after the guard"));
    assert!(!narrow.contains("after the guard"));
    let last = |svg: &str| svg.matches("touches").count();
    assert_eq!(last(&small), last(&large), "no part of the caption is cut");
}

/// Returns the name that the user gave, which replaces no file.
fn named(named: Option<Named>) -> Option<String> {
    named.map(|Named { name, replaces }| {
        assert!(!replaces);
        name
    })
}

#[test]
fn a_name_is_asked_for_until_it_is_good() {
    let mut naming = Naming::new("Save as", "Save", "name.toml", Asks::Save);
    naming.open("mine");
    let mut harness = Harness::builder().with_size([500.0, 300.0]).build_ui_state(
        |ui, (naming, said): &mut (Naming, Vec<String>)| said.extend(named(naming.ui(ui.ctx(), &Offered::default()))),
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

/// A folder is entered, a file of it or a recent file is chosen.
#[test]
fn a_file_is_chosen_from_lists() {
    let mut naming = Naming::new("Open", "Open", "a scene", Asks::Open);
    naming.open("");
    let names = ["plans/", "ring.toml"].map(str::to_owned).to_vec();
    let offered = Offered { folder: "/home/me".into(), names, recent: vec!["/tmp/old.toml".into()] };
    let mut harness = Harness::builder().with_size([700.0, 600.0]).build_ui_state(
        |ui, (naming, said): &mut (Naming, Vec<String>)| said.extend(named(naming.ui(ui.ctx(), &offered))),
        (naming, Vec::new()),
    );
    harness.run();
    assert!(harness.query_by_label("in /home/me").is_some());
    harness.get_by_label("plans/").click();
    harness.run();
    assert_eq!((harness.state().0.name.as_deref(), harness.state().1.len()), (Some("plans/"), 0));
    harness.get_by_label("ring.toml").click();
    harness.run();
    harness.get_by_label("/tmp/old.toml").click();
    harness.run();
    assert_eq!(harness.state().1, ["plans/ring.toml", "/tmp/old.toml"]);
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
