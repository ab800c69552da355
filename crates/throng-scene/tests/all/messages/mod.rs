//! Every mistake has a message with its position and a hint.

mod about;
mod numbers;
mod places;
mod steering;
mod text;
mod whole;

use throng_scene::{Kind, Scene};

/// Returns a scene of one group; `line` is line 5, in the group's table.
fn group(line: &str) -> String {
    format!("title = \"t\"\n\n[[group]]\nname = \"walkers\"\n{line}\n")
}

/// Returns the message of a scene that must fail.
fn message(text: &str) -> (Kind, String) {
    let read = Scene::parse("a.toml", text).and_then(|scene| scene.check_about().map(|()| scene));
    let error = match read {
        Err(error) => error,
        Ok(scene) => scene.build().map(|_| ()).unwrap_err(),
    };
    (error.kind, error.to_string())
}

/// Asserts that a scene fails with this message.
#[track_caller]
fn assert_message(text: &str, kind: Kind, expected: &str) {
    let (found, message) = message(text);
    assert_eq!(message, expected.trim_matches('\n'), "\n--- found:\n{message}\n---");
    assert_eq!(found, kind);
}

/// Returns a scene of one group at a point; `line` is line 6.
fn steers(line: &str) -> String {
    group(&format!("place.point = [0, 0]\n{line}"))
}
