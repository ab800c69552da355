//! The lessons: their scenes are built, their pauses lie within the runs, and their exercises can be solved.

use throng_scene::{Expectations, Scene, lessons};

/// Whether a run of a scene meets its expectations.
fn meets(scene: &Scene) -> (bool, String) {
    let (mut world, built) = scene.build().unwrap();
    let mut watched = Expectations::new(&scene.expect, &world, &built);
    while !scene.time.over(&world) {
        world.step();
        watched.step(&world);
    }
    let outcome = watched.verdict(&world);
    let failed: Vec<String> = outcome.checks.iter().filter(|check| !check.passed).map(|c| format!("{c:?}")).collect();
    (outcome.passed, failed.join("\n"))
}

#[test]
fn scenes_are_built_and_questions_are_answered_in_time() {
    for lesson in lessons::all() {
        for step in &lesson.steps {
            let at = format!("{}: {}", lesson.name, step.title);
            let scene = step.scene().unwrap_or_else(|error| panic!("{at}: {error}"));
            scene.build().unwrap_or_else(|error| panic!("{at}: {error}"));
            if let Some(model) = &step.beside {
                let model = throng_scene::Model::parse(model, &scene.plugins.models).unwrap();
                scene.with_model(&model).unwrap().build().unwrap();
            }
            if let Some(question) = &step.question {
                assert!(question.answers.len() >= 2 && question.right < question.answers.len(), "{at}");
                assert!(question.pause > 0.0 && question.pause < scene.time.limit, "{at}");
            }
            // two lines of a slide
            let texts = [&step.text].into_iter().chain(step.question.iter().map(|question| &question.because));
            texts.for_each(|text| assert!(text.chars().count() <= 300, "{at}: {text}"));
        }
        assert!(lesson.steps.iter().any(|step| step.question.is_some() || step.exercise.is_some()), "{}", lesson.name);
    }
}

#[test]
fn exercises_fail_before_and_are_met_by_their_solutions() {
    let mut exercises = 0;
    for lesson in lessons::all() {
        for step in lesson.steps.iter().filter(|step| step.exercise.is_some()) {
            let at = format!("{}: {}", lesson.name, step.title);
            assert!(!meets(&step.scene().unwrap()).0, "{at}: nothing is to be done");
            let (met, failed) = meets(&step.solved().unwrap());
            assert!(met, "{at}: the solution fails\n{failed}");
            exercises += 1;
        }
    }
    assert_eq!(exercises, lessons::all().len(), "each lesson has an exercise");
}

/// Returns the page: each lesson as a reader without the studio needs it, with the lecturer's notes.
fn page() -> String {
    let mut page = String::from(
        "# Lessons\nSix lessons for courses and for readers on their own: scenes in an order, with questions to answer before the scene goes on, and an exercise each. The\n\
         studio shows them (a click on the name *throng*, or `throng-studio --face lesson-boids`), the web page with `?lesson-boids`; programs read them with\n\
         `throng_scene::lessons`. This page is generated from the same files (`crates/throng-scene/lessons`). Questions pause the scene at the given time: let the class\n\
         vote, then go on. An exercise is solved when the scene's own `[expect]` passes at the end of a run.\n",
    );
    for lesson in lessons::all() {
        page += &format!("\n## {}\n{}\n", lesson.title, lesson.summary);
        for (k, step) in lesson.steps.iter().enumerate() {
            page += &format!("\n### {}. {}\nScene `{}`", k + 1, step.title, step.scene);
            let changes: Vec<String> = step.with.iter().map(|(path, value)| format!("`{path} = {value}`")).collect();
            if !changes.is_empty() {
                page += &format!(" with {}", changes.join(", "));
            }
            page += &step.beside.as_ref().map_or(String::new(), |model| format!(", beside `{model}`"));
            page += &format!(". {}\n", step.text);
            if let Some(question) = &step.question {
                page += &format!("\nPause at {} s: **{}**\n\n", question.pause, question.ask);
                for answer in &question.answers {
                    page += &format!("- {answer}\n");
                }
                page += &format!("\nRight: *{}*. {}\n", question.answers[question.right], question.because);
            }
            if let Some(exercise) = &step.exercise {
                let solution: Vec<String> =
                    exercise.solution.iter().map(|(path, value)| format!("`{path} = {value}`")).collect();
                page += &format!("\nTask: {} A solution: {}.\n", exercise.task, solution.join(", "));
            }
            if let Some(note) = &step.note {
                page += &format!("\nFor the lecturer: {note}\n");
            }
        }
    }
    page
}

#[test]
fn the_page_has_every_lesson() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/lessons.md");
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(&path, page()).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == page(), "docs/lessons.md is not current: UPDATE=1 cargo test -p throng-scene lessons");
}
