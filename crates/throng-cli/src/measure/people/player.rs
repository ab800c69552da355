//! The measured people in the page's player.

use crate::failure::Failure;
use crate::interrupt;
use crate::tracks::limit;
use glam::DVec2;
use std::collections::BTreeMap;
use std::path::Path;
use throng_draw::page::{Player, Scenery};
use throng_draw::{Style, WorldBox, palette};
use throng_record::pedestrian::Question;
use throng_record::{Frame, Moments, Sample, Trajectories};

/// Returns a player of the samples that `counts` selects, with the measured areas and lines.
///
/// # Errors
/// The page would have more moments than the limit.
pub fn player(
    path: &Path,
    tracks: &Trajectories,
    question: &Question,
    counts: impl Fn(&Sample) -> bool,
) -> Result<Player, Failure> {
    let mut spots: Vec<Sample> = tracks.spots.iter().filter(|spot| counts(spot)).copied().collect();
    // The player stores a trajectory for every number up to the largest, so people are renumbered without gaps.
    let mut dense = BTreeMap::new();
    for spot in &spots {
        let next = dense.len() as u32;
        dense.entry(spot.number).or_insert(next);
    }
    spots.iter_mut().for_each(|spot| spot.number = dense[&spot.number]);
    let moments = Moments::of(Trajectories { setting: tracks.setting.clone(), spots, ..Trajectories::default() });
    let mut setting = moments.setting.clone();
    if setting.walkable.is_empty() {
        setting.walkable.clone_from(&question.ground.walkable);
    }
    let unit = WorldBox { min: DVec2::ZERO, max: DVec2::ONE };
    let view = WorldBox::of(&setting, &moments.all_bodies()).unwrap_or(unit);
    let (start, step, last) = (moments.time(0), moments.period(), moments.count().saturating_sub(1));
    let scenery = Scenery {
        view,
        all: view,
        colors: (0..setting.groups.len().max(1)).map(|group| palette(group).hex()).collect(),
        trails: Style::default().trails,
        points: Vec::new(),
        marked: question.areas.iter().map(|area| area.corners().to_vec()).collect(),
        counted: question.lines.iter().map(|line| vec![line.from, line.to]).collect(),
        agents: moments.total(),
        gone: "gone",
        start,
        setting,
    };
    let mut player = Player::new(scenery, 1, dense.len(), step);
    let mut frame = Frame::default();
    // The player takes one moment per step; the previous moment fills in for a missing one.
    let (mut moment, steps) = (0, ((moments.time(last) - start) / step).round());
    limit(path, "moments of a page", steps, [start, moments.time(last)], "choose a part with --from and --to")?;
    for k in (0..=steps as u64).take_while(|_| !interrupt::asked()) {
        while moment < last && moments.time(moment + 1) < start + (k as f64 + 0.5) * step {
            moment += 1;
        }
        moments.capture(moment, &mut frame);
        player.push(k, [(0, &frame)]);
    }
    moments.capture(last, &mut frame);
    player.end(0, &frame);
    Ok(player)
}
