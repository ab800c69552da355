//! Makes a film of a generated recording: `cargo run --release --example demo -- film.mp4`, or any other ending.

#[path = "shared/scene.rs"]
mod scene;

use throng_draw::{ColorBy, Film, Style, Theme};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "demo.png".into());
    let mut style = Style::default();
    // Further arguments change the look: dark, speed, goal, large.
    for word in std::env::args().skip(2) {
        match word.as_str() {
            "dark" => style.theme = Theme::dark(),
            "speed" => style.color_by = ColorBy::Speed { max: None },
            "goal" => style.color_by = ColorBy::Goal,
            "large" => (style.width, style.height) = (1280, 720),
            _ => return Err(format!("unknown word: {word}").into()),
        }
    }
    let mut film = Film::create(path, &scene::crossing(), &style, 25.0)?;
    for k in 0..=150 {
        film.push(&scene::moment(k))?;
    }
    film.finish()?;
    Ok(())
}
