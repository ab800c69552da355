//! Trajectories in parts: the folder that a run on several machines writes.

use super::names::Names;
use super::{Format, FormatFlaw, Reading};
use crate::trajectories::{Trajectories, TrajectoriesError};
use std::path::{Path, PathBuf};

/// Reads the trajectories of a folder: all files named `part-*` that are trajectories. Each file has some agents at some
/// times; no agent is in two files at the same time.
///
/// # Errors
/// Those of [`Trajectories::read_as`] for each file; [`TrajectoriesError::Content`] for a folder without parts, and for an agent
/// that is in two files at the same time.
pub(crate) fn read(folder: &Path, reading: &Reading) -> Result<Trajectories, TrajectoriesError> {
    let (mut all, mut names): (Option<Trajectories>, _) = (None, Names::default());
    for path in parts(folder)? {
        let mut part = Trajectories::read_as(&path, reading)?;
        let groups: Vec<u32> = part.setting.groups.iter().map(|name| names.index(name)).collect();
        part.spots.iter_mut().for_each(|spot| spot.group = groups[spot.group as usize]);
        match &mut all {
            None => all = Some(part),
            Some(all) => {
                all.spots.append(&mut part.spots);
                all.notes.append(&mut part.notes);
            }
        }
    }
    let wrong = |why: String, hint| {
        let flaw = FormatFlaw { line: None, why, hint: Some(hint) };
        TrajectoriesError::Content { path: folder.into(), flaw }
    };
    let hint = "such a folder has trajectories in files called part-*, as throng-mpi writes them";
    let mut all = all.ok_or_else(|| wrong("the folder has no parts of trajectories".into(), hint))?;
    all.setting.groups = names.into_names();
    all.sort();
    let twice = all.spots.windows(2).find(|pair| (pair[0].time, pair[0].number) == (pair[1].time, pair[1].number));
    if let Some([spot, _]) = twice {
        let why = format!("agent {} is in two parts at {} s", spot.number, spot.time);
        return Err(wrong(why, "the folder mixes the files of two runs: remove those of one"));
    }
    Ok(all)
}

/// Returns the parts in a folder, by name.
fn parts(folder: &Path) -> Result<Vec<PathBuf>, TrajectoriesError> {
    let failed = |source| TrajectoriesError::File { path: folder.into(), source };
    let mut parts = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let named = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("part-"));
        if named && Format::of(&path).is_some_and(Format::is_read) {
            parts.push(path);
        }
    }
    parts.sort();
    Ok(parts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn the_parts_of_a_folder_are_one_recording() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        write("part-0-0.csv", "time,number,group,x,y,z\n0,7,b,1,2,0\n1,7,b,2,2,0\n");
        write("part-0-1.csv", "time,number,group,x,y,z\n0,3,a,5,2,0\n");
        write("part-1-1.csv", "time,number,group,x,y,z\n1,3,a,6,2,0\n2,7,b,3,2,0\n");
        write("run.json", "{}");
        write("part-notes.md", "no trajectories");
        let all = Trajectories::read(folder.path()).unwrap();
        let seen: Vec<_> = all.spots.iter().map(|spot| (spot.time, spot.number, spot.place.x)).collect();
        assert_eq!(seen, [(0.0, 3, 5.0), (0.0, 7, 1.0), (1.0, 3, 6.0), (1.0, 7, 2.0), (2.0, 7, 3.0)]);
        let name = |spot: usize| &*all.setting.groups[all.spots[spot].group as usize];
        assert_eq!((name(0), name(1)), ("a", "b"));
    }

    #[test]
    fn a_folder_of_two_runs_or_of_none_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let error = Trajectories::read(folder.path()).unwrap_err().to_string();
        assert!(error.contains("has no parts") && error.contains("part-*"), "{error}");
        for rank in 0..2 {
            let path = folder.path().join(format!("part-0-{rank}.csv"));
            fs::write(path, "time,number,x,y,z\n0,7,1,2,0\n").unwrap();
        }
        let error = Trajectories::read(folder.path()).unwrap_err().to_string();
        assert!(error.contains("agent 7 is in two parts at 0 s"), "{error}");
    }
}
