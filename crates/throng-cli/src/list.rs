//! `throng list`: the scenes of the gallery.

use crate::args::ListArgs;
use crate::failure::Failure;
use crate::out::Out;
use crate::sheet::pick;
use throng_scene::{Scene, gallery};

/// Writes the titles and names of scenes, group by group, to standard output.
///
/// # Errors
/// A name is neither a scene nor a group, or standard output cannot be written.
pub fn list(args: &ListArgs, out: &mut Out) -> Result<(), Failure> {
    if args.long || !args.scenes.is_empty() {
        return long(args, out);
    }
    let title = |name| gallery::title(name).unwrap_or_default();
    let widest = gallery::names().map(|name| title(name).chars().count()).max().unwrap_or(0);
    for (group, names) in gallery::groups() {
        if !args.names {
            out.line(format_args!("{group}"))?;
        }
        for name in names {
            match args.names {
                true => out.line(format_args!("{name}"))?,
                false => out.line(format_args!("  {:widest$}  {name}", title(name)))?,
            }
        }
    }
    Ok(())
}

/// Writes what each scene says to viewers.
fn long(args: &ListArgs, out: &mut Out) -> Result<(), Failure> {
    let (_, scenes) = pick::pick(&args.scenes)?;
    for (k, loaded) in scenes.iter().enumerate() {
        if k > 0 {
            out.line(format_args!(""))?;
        }
        out.line(format_args!("{}  ({})", loaded.title(), loaded.name))?;
        about(&loaded.scene, out)?;
    }
    Ok(())
}

fn about(scene: &Scene, out: &mut Out) -> Result<(), Failure> {
    for (key, text) in scene.about.texts() {
        out.line(format_args!("  {:8}  {text}", key.replace('_', " ")))?;
    }
    for slider in &scene.about.sliders {
        let unit = slider.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"));
        let now = scene.number(&slider.path)?.map_or_else(String::new, |now| format!("{now}{unit}, "));
        let range = format!("{now}from {} to {}{unit}", slider.min, slider.max);
        out.line(format_args!("  slider    {} ({}): {range}", slider.name, slider.path))?;
    }
    for preset in &scene.about.presets {
        let changes: Vec<String> = preset.with.iter().map(|(path, value)| format!("{path}={value}")).collect();
        out.line(format_args!("  preset    {}: {}", preset.name, changes.join(", ")))?;
    }
    Ok(())
}
