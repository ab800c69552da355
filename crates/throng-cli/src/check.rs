//! `throng check`: whether a scene can be run, and what it would do.

use crate::failure::Failure;
use crate::out::Out;
use crate::progress::waiting;
use crate::source::{Loaded, SceneArgs};
use std::collections::BTreeMap;
use throng::{Goal, Obstacle, World};
use throng_scene::{Built, Scene, SubSteps, Until};

/// How many findings of a kind are written out.
const SHOWN: usize = 5;

/// Validates a scene and writes what it would do to standard output.
///
/// # Errors
/// The scene cannot be built, or standard output cannot be written.
pub fn check(args: &SceneArgs, out: &mut Out) -> Result<(), Failure> {
    let loaded = args.load()?;
    let (mut world, built) = loaded.build(false)?;
    // figures of groups are read, so that a wrong file is found
    loaded.setting(&world, &built)?;
    let Loaded { name, scene, notes, .. } = &loaded;
    let title = if scene.title.is_empty() { String::new() } else { format!(": {}", scene.title) };
    out.line(format_args!("{name}{title}"))?;
    people(scene, &built, out)?;
    place(&built, out)?;
    game(scene, &world, out)?;
    let overlapping = world.overlapping();
    // The first step plans the ways of all agents.
    waiting(false, "planning", || world.step());
    time(scene, &world, out)?;
    expectations(scene, out)?;
    for note in notes.iter().chain(&built.notes) {
        out.line(format_args!("  note       {note}"))?;
    }
    let found = overlaps(&overlapping, out)? | unreachable(&world, &built, out)?;
    let verdict = if found { "the scene can be run, with the warnings above" } else { "the scene is valid" };
    out.line(format_args!("{verdict}"))
}

/// Writes the rules of the scene's game and the figures they count.
fn game(scene: &Scene, world: &World, out: &mut Out) -> Result<(), Failure> {
    let Some(rules) = &scene.rules else { return Ok(()) };
    let figures: Vec<&str> = world.figures().map(|(name, _)| name).collect();
    out.line(format_args!("  rules      {rules}, which count {}", figures.join(", ")))
}

fn people(scene: &Scene, built: &Built, out: &mut Out) -> Result<(), Failure> {
    let entering = if built.entering > 0 { format!(", {} of them enter later", built.entering) } else { String::new() };
    out.line(format_args!("  agents     {}{entering}", built.agents))?;
    for group in &built.groups {
        out.line(format_args!("  group      {}: {}", group.name, group.numbers.len()))?;
    }
    let count = |test: fn(&Goal) -> bool| built.goals.iter().filter(|(_, goal)| test(goal)).count();
    let kinds = [
        (count(|goal| matches!(goal, Goal::Point { .. })), "point"),
        (count(|goal| matches!(goal, Goal::Air { .. })), "air point"),
        (count(|goal| matches!(goal, Goal::Area { .. })), "area"),
        (count(|goal| matches!(goal, Goal::Exit { .. })), "exit"),
    ];
    let some = kinds.iter().filter(|(n, _)| *n > 0);
    let kinds: Vec<String> = some.map(|(n, what)| format!("{n} {what}{}", if *n == 1 { "" } else { "s" })).collect();
    let kinds = if kinds.is_empty() { format!("none: {}", without_goals(scene)) } else { kinds.join(", ") };
    out.line(format_args!("  goals      {kinds}"))
}

/// Describes what agents without goals do.
fn without_goals(scene: &Scene) -> &'static str {
    let mut steers = scene.groups.iter().map(|group| group.steer.is_some());
    match (steers.clone().any(|steers| steers), steers.all(|steers| steers)) {
        (_, true) => "all agents move by their steering",
        (true, false) => "agents with `steer` move by it, all others stay",
        (false, false) => "all agents stay",
    }
}

fn place(built: &Built, out: &mut Out) -> Result<(), Failure> {
    let [low, high] = built.bounds;
    let (width, height) = (high.x - low.x, high.y - low.y);
    let around = format!("{width:.1} m by {height:.1} m from ({:.1}, {:.1})", low.x, low.y);
    let holes: usize = built.walkable.iter().map(|area| area.holes.len()).sum();
    let ground = match built.walkable.len() {
        0 => "open ground".to_owned(),
        1 if holes == 0 => "walkable ground without holes".to_owned(),
        1 => format!("walkable ground, holes: {holes}"),
        n => format!("{n} walkable areas, holes: {holes}"),
    };
    out.line(format_args!("  place      {around}, {ground}"))?;
    if !built.obstacles.is_empty() {
        let walls = built.obstacles.iter().filter(|o| matches!(o, Obstacle::Wall { .. })).count();
        let solid = built.obstacles.len() - walls;
        out.line(format_args!("  obstacles  solid: {solid}, walls: {walls}"))?;
    }
    if !built.surfaces.is_empty() || !built.paths.is_empty() {
        out.line(format_args!("  steer by   surfaces: {}, paths: {}", built.surfaces.len(), built.paths.len()))?;
    }
    Ok(())
}

fn time(scene: &Scene, world: &World, out: &mut Out) -> Result<(), Failure> {
    let parts = world.summary().sub_steps;
    let sub_steps = match scene.time.sub_steps {
        SubSteps::Auto => format!("divided by need, the first into {parts}"),
        SubSteps::Fixed(n) => format!("each divided into {n}"),
    };
    let (step, limit) = (scene.time.step, scene.time.limit);
    out.line(format_args!("  steps      {step} s, {sub_steps}"))?;
    let until = match scene.time.until {
        Until::Arrived => format!("when all agents have arrived, at the latest at {limit} s"),
        Until::Empty => format!("when no agent is left, at the latest at {limit} s"),
        Until::Limit => format!("at {limit} s"),
    };
    out.line(format_args!("  ends       {until}"))
}

fn expectations(scene: &Scene, out: &mut Out) -> Result<(), Failure> {
    let e = &scene.expect;
    let keys = [
        (e.arrived.is_some(), "arrived"),
        (e.within.is_some(), "within"),
        (e.least_separation.is_some(), "least_separation"),
        (e.least_wall_separation.is_some(), "least_wall_separation"),
        (e.heading_change.is_some(), "heading_change"),
        (e.mean_speed.is_some(), "mean_speed"),
        (e.final_speed.is_some(), "final_speed"),
        (e.waiting_for_room.is_some(), "waiting_for_room"),
        (e.blocked.is_some(), "blocked"),
        (e.oscillating.is_some(), "oscillating"),
        (e.stuck.is_some(), "stuck"),
        (e.without_progress_30s.is_some(), "without_progress_30s"),
        (!e.flow.is_empty(), "flow"),
        (!e.distance.is_empty(), "distance"),
        (!e.speed.is_empty(), "speed"),
        (!e.order.is_empty(), "order"),
        (!e.figure.is_empty(), "figure"),
    ];
    let keys: Vec<&str> = keys.iter().filter(|(there, _)| *there).map(|(_, key)| *key).collect();
    let keys = if keys.is_empty() { "nothing".to_owned() } else { keys.join(", ") };
    out.line(format_args!("  expects    {keys}"))
}

/// Writes the agents that overlap at the start. Returns whether there are any.
fn overlaps(pairs: &[(u32, u32, f64)], out: &mut Out) -> Result<bool, Failure> {
    for (a, b, ratio) in pairs.iter().take(SHOWN) {
        out.line(format_args!("  warning    agents {a} and {b} overlap at the start ({ratio:.3} of touching)"))?;
    }
    if pairs.len() > SHOWN {
        out.line(format_args!("  warning    and {} more pairs overlap", pairs.len() - SHOWN))?;
    }
    Ok(!pairs.is_empty())
}

/// Writes the agents that cannot reach their goals, with the reasons. Returns whether there are any.
fn unreachable(world: &World, built: &Built, out: &mut Out) -> Result<bool, Failure> {
    let mut groups: BTreeMap<&str, Vec<&(u32, throng::navigate::Unreachable)>> = BTreeMap::new();
    for stranded in world.stranded() {
        let group = built.groups.iter().find(|group| group.numbers.contains(&stranded.0));
        groups.entry(group.map_or("", |group| &group.name)).or_default().push(stranded);
    }
    for (name, stranded) in &groups {
        for (number, why) in stranded.iter().take(SHOWN) {
            out.line(format_args!("  warning    agent {number} of {name} cannot reach its goal: {why}"))?;
        }
        if stranded.len() > SHOWN {
            out.line(format_args!("  warning    and {} more of {name} cannot reach a goal", stranded.len() - SHOWN))?;
        }
    }
    if !groups.is_empty() {
        out.line(format_args!(
            "  hint       make a gap wider than the agents, or move the goal; `throng show` draws the scene"
        ))?;
    }
    Ok(!groups.is_empty())
}
