//! Damaged scene files cause an error, never a panic.

use throng_scene::{Purpose, Random, Scene, gallery};

#[test]
fn damaged_files_never_panic() {
    let pieces =
        ["-", "0", "nan", "inf", "[", "]", "{", "}", "\"", "\n", "=", ".", "9", "1e300", "é", "#", ",", "[[group]]\n"];
    let mut failed = 0;
    for name in gallery::names().filter(|name| *name != "ring-1000") {
        let text = gallery::text(name).unwrap();
        for k in 0..60 {
            let mut random = Random::new(1, 2, k, Purpose::Choice);
            let mut pick = |n: usize| (random.bits() % n as u64) as usize;
            let mut damaged: Vec<char> = text.chars().collect();
            for _ in 0..1 + pick(3) {
                let at = pick(damaged.len());
                let length = pick(4).min(damaged.len() - at);
                let piece = if pick(3) == 0 { "" } else { pieces[pick(pieces.len())] };
                damaged.splice(at..at + length, piece.chars());
            }
            let damaged: String = damaged.into_iter().collect();
            if let Err(error) = Scene::parse("damaged.toml", damaged).and_then(|scene| scene.plan()) {
                failed += 1;
                assert!(!error.message.is_empty() && error.at.is_some(), "{error}");
                assert!(error.to_string().starts_with("damaged.toml:"), "{error}");
            }
        }
    }
    assert!(failed > 100, "{failed}");
}

#[test]
fn truncated_files_never_panic() {
    for name in ["box", "office", "bottleneck"] {
        let text = gallery::text(name).unwrap();
        for (end, _) in text.char_indices().step_by(7) {
            let _ = Scene::parse("cut.toml", &text[..end]).and_then(|scene| scene.plan());
        }
    }
}

#[test]
fn files_that_are_too_large_are_not_read_to_their_end() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.toml");
    std::fs::File::create(&path).unwrap().set_len(17 << 20).unwrap();
    let error = Scene::load(&path).unwrap_err();
    assert_eq!(error.message, format!("{} is larger than 16 MB", path.display()));
    #[cfg(unix)]
    {
        let scene = "walkable.file = \"/dev/zero\"\n[[group]]\ncount = 1\nplace.point = [0, 0]\n".parse::<Scene>();
        let error = scene.and_then(|scene| scene.plan().map(drop)).unwrap_err();
        assert_eq!(error.message, "/dev/zero is larger than 64 MB");
    }
}

#[test]
fn tables_without_end_are_refused_before_they_are_read() {
    let text = "[[group]]\n".repeat(100_001);
    let error = Scene::parse("many.toml", text).unwrap_err();
    assert!(
        error.to_string().starts_with("many.toml:100001:1: there are more than 100000 tables `[[group]]`"),
        "{error}"
    );
}

#[test]
fn large_scenes_are_laid_out_in_good_time() {
    let scene: Scene = "[[group]]\nplace.grid = { columns = 500, rows = 400, spacing = 1 }\ngoal.shift = { by = [9, 0] }\n\
                        [[group]]\nname = \"b\"\ncount = 20_000\nplace.rectangle = { center = [500, 500], size = [200, 200] }\n"
        .parse()
        .unwrap();
    assert_eq!(scene.plan().unwrap().agents.len(), 220_000);
}
