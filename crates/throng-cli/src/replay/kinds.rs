//! How people are told apart in pictures: as the recording has groups, else by whether they belong together.

use super::args::StageArgs;
use crate::failure::Failure;
use crate::map::{beside, read};
use std::path::Path;
use throng_record::Tracks;
use throng_record::pedestrian::groups;
use throng_record::pedestrian::replay::Cast;

/// Kinds of people, a colour each.
#[derive(Clone, Debug, PartialEq)]
pub struct Kinds {
    /// What they are called.
    pub names: Vec<String>,
    /// Which is somebody's, by walk.
    of: Vec<u32>,
}

impl Kinds {
    /// Of a recording; `groups` says who belongs together.
    pub fn of(tracks: &Tracks, cast: &Cast, groups: Option<&[Vec<u32>]>) -> Self {
        let walks = &cast.people.walks;
        let mut of = vec![0; walks.len()];
        if tracks.setting.groups.len() > 1 {
            for spot in &tracks.spots {
                if let Some(walk) = cast.walk_of(spot.number) {
                    of[walk] = spot.group;
                }
            }
            return Self { names: tracks.setting.groups.clone(), of };
        }
        let Some(groups) = groups else { return Self { names: vec!["people".into()], of } };
        in_groups(cast, groups).into_iter().zip(&mut of).for_each(|(is, of)| *of = u32::from(is));
        Self { names: vec!["alone".into(), "in groups".into()], of }
    }

    /// Somebody's, by number.
    pub fn find(&self, cast: &Cast, number: u32) -> u32 {
        cast.walk_of(number).map_or(0, |walk| self.of[walk])
    }
}

/// Whether everybody belongs to somebody, by walk.
pub fn in_groups(cast: &Cast, groups: &[Vec<u32>]) -> Vec<bool> {
    let mut of = vec![false; cast.people.walks.len()];
    let members = groups.iter().filter(|group| group.len() > 1).flatten();
    members.filter_map(|&member| cast.walk_of(member)).for_each(|walk| of[walk] = true);
    of
}

/// Who belongs together: the groups that are asked for, else those of a `groups.txt` beside the recording.
///
/// # Errors
/// The file cannot be read.
pub fn together(args: &StageArgs, data: &Path) -> Result<Option<Vec<Vec<u32>>>, Failure> {
    let path = args.groups.clone().or_else(|| beside(data, "groups.txt"));
    path.map(|path| read(&path, groups)).transpose()
}
