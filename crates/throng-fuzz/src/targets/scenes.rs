//! Scenes: scene files, changes of scenes, scenarios and projects of other programs.

use super::scratch;
use std::path::Path;
use throng_record::Frame;
use throng_record::sweep::{FileFingerprints, Fingerprint, Plan, collect, run_one};
use throng_scene::{Kind, Plugins, Scene, gallery};

/// Greatest number of agents of scenes that are laid out: larger scenes may exceed the time limit.
const LAID_OUT: u64 = 20_000;
/// Greatest number of agents of worlds that are advanced.
const STEPPED: usize = 300;
/// Number of steps of a world.
const STEPS: usize = 5;
/// The end of runs of sweeps, seconds.
const LIMIT: f64 = 0.1;
/// Greatest number of changes of a scene.
const CHANGES: usize = 30;

/// Reads a scene file.
pub(super) fn scene(bytes: &[u8]) -> Result<(), String> {
    scratch::file("input.toml", bytes, |path| {
        let scene = Scene::load(path).map_err(|error| error.to_string())?;
        check(&scene)
    })
}

/// Changes a gallery scene as `--set` does. The first line is the name of the scene, each further line a change.
pub(super) fn set(bytes: &[u8]) -> Result<(), String> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines();
    let mut scene = gallery::scene(lines.next().unwrap_or_default().trim()).map_err(|error| error.to_string())?;
    for change in lines.filter(|line| !line.trim().is_empty()).take(CHANGES) {
        let (key, value) = change.split_once('=').ok_or("a change is KEY=VALUE")?;
        scene.set(key.trim(), value.trim()).map_err(|error| error.to_string())?;
    }
    check(&scene)
}

/// Reads a plan of a sweep, and makes some steps of its first run.
pub(super) fn sweep(bytes: &[u8]) -> Result<(), String> {
    let text = String::from_utf8_lossy(bytes);
    let plan = Plan::parse("input.toml", &text, "", &Plugins::new());
    let mut plan = plan.map_err(|error| error.to_string())?;
    plan.limit = Some(LIMIT);
    let run = plan.run(0).expect("a plan has at least one run");
    assert!(plan.run(plan.len()).is_none() && plan.run(plan.len() - 1).is_some(), "the number of runs");
    let files = FileFingerprints::default();
    assert_eq!(Fingerprint::of(&run, &files), Fingerprint::of(&run, &files));
    let scene = run.scene().map_err(|error| error.to_string())?;
    let count = scene.groups.iter().map(|group| group.count.unwrap_or(0)).fold(0, u64::saturating_add);
    if count > LAID_OUT || scene.plan().map_err(|error| error.to_string())?.agents.len() > STEPPED {
        return Ok(());
    }
    let mut steps = 0;
    let row = run_one(&run, || {
        steps += 1;
        steps <= STEPS
    });
    let table = collect(&plan, row.clone());
    assert_eq!(table.rows(), usize::from(row.is_some()));
    Ok(())
}

/// Opens a file of this name as a scene.
pub(super) fn open(name: &str, bytes: &[u8]) -> Result<(), String> {
    scratch::file(name, bytes, opened)
}

/// Opens a project of several files, each after a line `--- NAME`; names have no folders.
pub(super) fn menge(bytes: &[u8]) -> Result<(), String> {
    let text = String::from_utf8_lossy(bytes);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut first = None;
    for part in format!("\n{text}").split("\n--- ").skip(1) {
        let (name, text) = part.split_once('\n').unwrap_or((part, ""));
        let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_');
        let name = name.trim();
        if name.starts_with('.') || name.is_empty() || name.len() > 60 || !name.chars().all(plain) {
            return Err("a file name must consist of at most 60 letters, digits, `.`, `-` and `_`".into());
        }
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("a file in the temporary folder");
        first.get_or_insert(path);
    }
    opened(&first.ok_or("there is no line `--- NAME`")?)
}

fn opened(path: &Path) -> Result<(), String> {
    let imported = throng_scene::open(path).map_err(|error| error.to_string())?;
    check(&imported.scene)
}

/// Uses a scene: writes and reads it, builds its world, and advances it by some steps.
pub(super) fn check(scene: &Scene) -> Result<(), String> {
    let text = scene.to_toml().map_err(|error| error.to_string())?;
    let again: Scene = text.parse().unwrap_or_else(|error| panic!("a written scene cannot be read: {error}\n{text}"));
    let twice = again.to_toml().unwrap_or_else(|error| panic!("a scene that was read cannot be written: {error}"));
    assert_eq!(twice, text, "a scene that was written and read");
    let count = scene.groups.iter().map(|group| group.count.unwrap_or(0)).fold(0, u64::saturating_add);
    if count > LAID_OUT {
        return Ok(());
    }
    let plan = scene.plan().map_err(|error| {
        // there are no plug-ins: it is throng that panicked
        assert!(error.kind != Kind::Panic, "{error}");
        error.to_string()
    })?;
    if plan.agents.len() > STEPPED {
        return Ok(());
    }
    let (mut world, _) = scene.build().map_err(|error| error.to_string())?;
    for step in 0..STEPS {
        world.step();
        for body in Frame::of(&world).bodies {
            let finite = body.position.is_finite() && body.velocity.is_finite() && body.heading.is_finite();
            assert!(finite && body.altitude.is_finite(), "after step {step} agent {} is {body:?}", body.number);
        }
    }
    Ok(())
}
