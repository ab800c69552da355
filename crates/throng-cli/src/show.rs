//! `throng show`: a picture of the start of a scene.

use crate::args::ShowArgs;
use crate::failure::Failure;
use crate::files::one_picture;
use crate::out::Out;
use std::path::PathBuf;
use throng_draw::{Film, Style};
use throng_record::{Frame, moment};

/// Draws the start of a scene.
///
/// # Errors
/// The scene cannot be built, or the picture cannot be written.
pub fn show(args: &ShowArgs, out: &mut Out) -> Result<(), Failure> {
    let loaded = args.scene.load()?;
    let path = args.output.clone().unwrap_or_else(|| PathBuf::from(format!("{}.png", loaded.name)));
    one_picture(&path, "show")?;
    let (world, built) = loaded.build(false)?;
    let style = Style { trails: 0.0, ..args.look.style(&loaded.scene, built.bounds)? };
    let mut frame = Frame::default();
    moment::capture(&world, &mut frame);
    let mut film = Film::create(&path, &loaded.setting(&world, &built)?, &style, 25.0)?;
    film.push(&frame)?;
    film.finish()?;
    out.line(format_args!("wrote {}", path.display()))
}
