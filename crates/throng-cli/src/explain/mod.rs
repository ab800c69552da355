//! `throng explain`: why one agent chooses its velocity.

pub mod args;
mod json;

use crate::failure::Failure;
use crate::files::one_picture;
use crate::out::Out;
use crate::source::Loaded;
use args::ExplainArgs;
use std::path::PathBuf;
use throng::{AgentId, World};
use throng_draw::{Figure, Style, Theme};
use throng_record::{Frame, moment};
use throng_scene::Built;

/// Draws the velocity space of an agent, or writes it as JSON.
///
/// # Errors
/// The scene cannot be built, the agent is not present at that time, or a file cannot be written.
pub fn explain(args: &ExplainArgs, out: &mut Out) -> Result<(), Failure> {
    let loaded = args.scene.load()?;
    let paths = match (args.output.is_empty(), args.json) {
        (true, false) => vec![PathBuf::from(format!("{}-agent-{}.svg", loaded.name, args.agent))],
        _ => args.output.clone(),
    };
    paths.iter().try_for_each(|path| one_picture(path, "explain"))?;
    let (world, built, id) = go_to(args, &loaded)?;
    let Some(why) = world.explain(id) else { return Err(absent(args, &world, "is not present")) };
    if !paths.is_empty() {
        let title = if loaded.scene.title.is_empty() { &loaded.name } else { &loaded.scene.title };
        let mut frame = Frame::default();
        moment::capture(&world, &mut frame);
        let theme = if args.dark { Theme::dark() } else { Theme::light() };
        let style = Style { width: args.size.0, height: args.size.1, theme, ..Style::default() };
        let figure = Figure::explain(&moment::setting(&world, &built, title), &frame, &why, &style)?;
        paths.iter().try_for_each(|path| figure.write(path))?;
    }
    if args.json {
        return out.line(format_args!("{}", json::of(&loaded.name, &why, &paths)));
    }
    paths.iter().try_for_each(|path| out.line(format_args!("wrote {}", path.display())))
}

/// Runs the scene up to the moment and returns the agent's id.
fn go_to(args: &ExplainArgs, loaded: &Loaded) -> Result<(World, Built, AgentId), Failure> {
    let (mut world, built) = loaded.build(false)?;
    let Loaded { name, scene, .. } = loaded;
    if args.agent as usize >= built.agents {
        let numbers = if built.agents == 1 { "only 0".to_owned() } else { format!("0 to {}", built.agents - 1) };
        let text = format!("--agent {}: there is no agent {} in {name}", args.agent, args.agent);
        return Err(Failure::hint(text, format!("its agents have the numbers {numbers}")));
    }
    let mut was_there = false;
    while world.time() + 0.5 * scene.time.step <= args.time {
        if scene.time.over(&world) {
            let end = (world.time() * 1e6).round() / 1e6;
            let text = format!("--time {}: {name} ends at {end} s", args.time);
            return Err(Failure::hint(text, format!("give at most --time {end}")));
        }
        was_there |= id(&world, args.agent).is_some();
        world.step();
    }
    match id(&world, args.agent) {
        Some(id) => Ok((world, built, id)),
        None => Err(absent(args, &world, if was_there { "has left" } else { "has not entered" })),
    }
}

fn id(world: &World, number: u32) -> Option<AgentId> {
    world.relative_columns().number.iter().position(|&other| other == number).map(|row| world.id(row))
}

/// Returns the error for an agent that is not present, with the agents that are.
fn absent(args: &ExplainArgs, world: &World, why: &str) -> Failure {
    let text = format!("--agent {}: agent {} {why} at {:.2} s", args.agent, args.agent, world.time());
    let mut numbers = world.relative_columns().number.clone();
    numbers.sort_unstable();
    let there = if numbers.is_empty() { "none".to_owned() } else { ranges(&numbers) };
    Failure::hint(text, format!("agents present at that time: {there}; or give another --time"))
}

/// Formats sorted numbers as ranges: `0 to 3, 7, 9 to 12`.
fn ranges(numbers: &[u32]) -> String {
    /// Further ranges are cut off.
    const SHOWN: usize = 12;
    let runs: Vec<&[u32]> = numbers.chunk_by(|a, b| a + 1 == *b).collect();
    let names = runs.iter().take(SHOWN).map(|run| match run {
        [single] => single.to_string(),
        [first, .., last] => format!("{first} to {last}"),
        [] => String::new(),
    });
    let mut names: Vec<String> = names.collect();
    if runs.len() > SHOWN {
        names.push("...".into());
    }
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::ranges;

    #[test]
    fn numbers_are_written_as_ranges() {
        assert_eq!(ranges(&[0, 1, 2, 3, 7, 9, 10]), "0 to 3, 7, 9 to 10");
        let odd: Vec<u32> = (0..40).map(|k| 2 * k).collect();
        assert!(ranges(&odd).ends_with("20, 22, ..."), "{}", ranges(&odd));
    }
}
