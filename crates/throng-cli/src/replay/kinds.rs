//! The colour classes of people in pictures: the groups of the recording, else people alone and people in groups.

use super::args::StageArgs;
use crate::failure::Failure;
use crate::map::{beside, read};
use std::path::Path;
use throng_record::Trajectories;
use throng_record::pedestrian::groups;
use throng_record::pedestrian::replay::RecordedPeople;

/// The colour classes of people.
#[derive(Clone, Debug, PartialEq)]
pub struct Kinds {
    /// The names of the classes.
    pub names: Vec<String>,
    /// The class of each walk.
    of: Vec<u32>,
}

impl Kinds {
    /// Returns the classes of a recording; `groups` lists the people that walk together.
    pub fn of(tracks: &Trajectories, cast: &RecordedPeople, groups: Option<&[Vec<u32>]>) -> Self {
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

    /// Returns the class of a person, by number.
    pub fn find(&self, cast: &RecordedPeople, number: u32) -> u32 {
        cast.walk_of(number).map_or(0, |walk| self.of[walk])
    }
}

/// Whether each walk belongs to a member of a group of at least two.
pub fn in_groups(cast: &RecordedPeople, groups: &[Vec<u32>]) -> Vec<bool> {
    let mut of = vec![false; cast.people.walks.len()];
    let members = groups.iter().filter(|group| group.len() > 1).flatten();
    members.filter_map(|&member| cast.walk_of(member)).for_each(|walk| of[walk] = true);
    of
}

/// Returns the groups of people that walk together: from the given file, else from a `groups.txt` beside the recording.
///
/// # Errors
/// The file cannot be read.
pub fn together(args: &StageArgs, data: &Path) -> Result<Option<Vec<Vec<u32>>>, Failure> {
    let path = args.groups.clone().or_else(|| beside(data, "groups.txt"));
    path.map(|path| read(&path, groups)).transpose()
}
