//! What the scenes of the gallery say to viewers: texts, sliders and presets.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use throng_scene::{About, Error, Scene, gallery};

/// The steps that a changed scene makes.
const STEPS: usize = 3;

/// Calls a function for each scene of the gallery, on all processors.
fn for_each_scene(check: impl Fn(&str, &Scene) + Sync) {
    let names: Vec<&str> = gallery::names().collect();
    let next = AtomicUsize::new(0);
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(name) = names.get(next.fetch_add(1, Ordering::Relaxed)) {
                    check(name, &gallery::scene(name).unwrap());
                }
            });
        }
    });
}

/// Builds a scene and makes some steps.
fn begin(scene: Result<Scene, Error>) -> Result<(), Error> {
    let (mut world, built) = scene?.build()?;
    assert!(built.agents > 0);
    (0..STEPS).for_each(|_| world.step());
    Ok(())
}

#[test]
fn every_scene_has_words_and_sliders() {
    let mut titles = BTreeSet::new();
    for name in gallery::names() {
        let scene = gallery::scene(name).unwrap();
        let keys: Vec<&str> = scene.about.texts().map(|(key, _)| key).filter(|key| *key != "shows").collect();
        assert_eq!(keys, ["see", "look_for", "why", "try", "source"], "{name}");
        assert!(!scene.about.sliders.is_empty(), "{name}");
        assert!(titles.insert(scene.title.clone()), "two scenes are titled {}", scene.title);
        for (key, text) in scene.about.texts() {
            assert!(text.ends_with('.') || ["source", "shows"].contains(&key), "{name}: {key} is no sentence: {text}");
        }
    }
}

#[test]
fn papers_are_the_scenes_with_citations_in_the_order_of_years() {
    let papers = gallery::papers();
    let cited = |name: &&str| gallery::scene(name).unwrap().about.shows.is_some();
    let mut names: Vec<&str> = papers.iter().map(|&(name, _)| name).collect();
    let years: Vec<u32> = papers
        .iter()
        .map(|(name, citation)| {
            assert_eq!(gallery::scene(name).unwrap().about.shows.as_deref(), Some(*citation));
            let words = citation.split(|c: char| !c.is_ascii_digit());
            words.filter_map(|word| word.parse().ok()).find(|year| (1980..2030).contains(year)).expect(citation)
        })
        .collect();
    assert!(years.is_sorted() && years.len() > 8, "{years:?}");
    names.sort_unstable();
    let mut all: Vec<&str> = gallery::names().filter(cited).collect();
    all.sort_unstable();
    assert_eq!(names, all);
}

#[test]
fn every_slider_has_the_value_of_its_scene() {
    for name in gallery::names() {
        let scene = gallery::scene(name).unwrap();
        for slider in &scene.about.sliders {
            let now = scene.number(&slider.path).unwrap().unwrap_or(slider.min);
            assert!((slider.min..=slider.max).contains(&now), "{name}: {} is {now}", slider.name);
        }
    }
}

#[test]
fn every_scene_starts_at_both_ends_of_every_slider() {
    for_each_scene(|name, scene| {
        for slider in &scene.about.sliders {
            for end in [slider.min, slider.max] {
                let mut changed = scene.clone();
                let set = changed.set(&slider.path, &end.to_string());
                begin(set.map(|()| changed)).unwrap_or_else(|error| panic!("{name}: {} = {end}: {error}", slider.name));
            }
        }
    });
}

#[test]
fn every_scene_starts_with_each_of_its_presets() {
    for_each_scene(|name, scene| {
        for preset in &scene.about.presets {
            let changed = scene.with_preset(&preset.name);
            assert_ne!(changed.as_ref(), Ok(scene), "{name}: {} changes nothing", preset.name);
            begin(changed).unwrap_or_else(|error| panic!("{name}: {}: {error}", preset.name));
        }
    });
}

/// Words do not change the simulation.
#[test]
fn a_scene_without_words_has_the_same_steps() {
    for name in ["circle", "flocking", "swarm-aggregation"] {
        let scene = gallery::scene(name).unwrap();
        let silent = Scene { about: About::default(), ..scene.clone() };
        let [hash, other] = [scene, silent].map(|scene| {
            let (mut world, _) = scene.build().unwrap();
            (0..10).for_each(|_| world.step());
            world.state_hash()
        });
        assert_eq!(hash, other, "{name}");
    }
}

const SCENE: &str = r#"
[[group]]
name = "a"
place.point = [0, 0]
body.radius = 0.2
avoid.orca = { time_horizon = 2, neighbours = 5 }
[[group]]
name = "b"
place.points = [[5, 0], [7, 0]]
avoid.orca.time_horizon = 4
[about]
preset = [
    { name = "wide", with = { "group.a.body.radius" = 0.5, "group.b.look_ahead" = false } },
    { name = "another model", with = { avoid = { rvo = {} } } },
]
"#;

#[test]
fn numbers_are_read_by_the_paths_of_set() {
    let mut scene: Scene = SCENE.parse().unwrap();
    for (path, number) in [
        ("group.a.body.radius", 0.2),
        ("groups.0.body.radius", 0.2),
        ("avoid.orca.time_horizon", 2.0),
        ("group.b.avoid.orca.time_horizon", 4.0),
        ("group.b.place.points.1.0", 7.0),
    ] {
        assert_eq!(scene.number(path), Ok(Some(number)), "{path}");
    }
    for path in ["body.radius", "avoid.orca.neighbours", "group.b.place.points.2.0", "seed"] {
        assert_eq!(scene.number(path), Ok(None), "{path}");
    }
    for path in ["group.c.count", "time..step", "group.a.name"] {
        assert!(scene.number(path).is_err(), "{path}");
    }
    scene.set("group.a.body.radius", "0.3").unwrap();
    assert_eq!(scene.number("group.a.body.radius"), Ok(Some(0.3)));
    scene.groups[0].body = throng_scene::Body::Radius(0.4.into());
    assert_eq!(scene.number("group.a.body.radius"), Ok(Some(0.4)));
}

#[test]
fn a_preset_changes_what_it_names() {
    let scene: Scene = SCENE.parse().unwrap();
    let wide = scene.with_preset("wide").unwrap();
    assert_eq!(wide.number("group.a.body.radius"), Ok(Some(0.5)));
    assert!(!wide.groups[1].look_ahead.unwrap_or(true));
    let other = scene.with_preset("another model").unwrap();
    assert!(other.groups.iter().all(|group| group.local_model().name == "rvo"));
    assert_eq!(
        scene.with_preset("wdie").unwrap_err().to_string(),
        "the scene has no preset `wdie`\n  hint: there is: wide, another model"
    );
    assert_eq!(
        Scene::default().with_preset("wide").unwrap_err().to_string(),
        "the scene has no preset `wide`\n  hint: it has no presets: change values with --set"
    );
}
