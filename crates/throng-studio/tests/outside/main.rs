//! Tests of the studio on a virtual screen of Linux.

#[cfg(target_os = "linux")]
mod window;

#[path = "../../../throng/tests/shared/outside.rs"]
#[allow(dead_code, reason = "these tests need no data")]
mod outside;

#[cfg(target_os = "linux")]
fn main() {
    let screen = ["Xvfb", "openbox", "xdotool"].map(outside::Need::Program);
    outside::run(vec![
        outside::test("people_walk_in_a_view_in_space", &screen[..1], window::people_walk_in_a_view_in_space),
        outside::test("a_film_is_replayed", &screen, window::a_film_is_replayed),
        outside::test(
            "a_file_is_chosen_in_the_dialog_of_the_system",
            &screen,
            window::a_file_is_chosen_in_the_dialog_of_the_system,
        ),
        outside::test(
            "a_scene_is_played_directed_lost_and_found",
            &screen,
            window::a_scene_is_played_directed_lost_and_found,
        ),
    ]);
}

#[cfg(not(target_os = "linux"))]
fn main() {
    outside::run(vec![]);
}
