//! Tests that files are complete or absent.

use super::*;
use std::path::Path;

fn names(folder: &Path) -> Vec<PathBuf> {
    std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect()
}

#[test]
fn a_dropped_output_leaves_the_old_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.txt");
    std::fs::write(&path, "old").unwrap();
    let mut output = Output::create(&path).unwrap();
    output.put(b"new").unwrap();
    assert_eq!(names(folder.path()).len(), 2);
    drop(output);
    assert_eq!(names(folder.path()), std::slice::from_ref(&path));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
}

#[test]
fn a_finished_output_replaces_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.txt");
    std::fs::write(&path, "old and long").unwrap();
    let mut output = Output::create(&path).unwrap();
    output.put(b"new").unwrap();
    output.finish().unwrap();
    assert_eq!(names(folder.path()), std::slice::from_ref(&path));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "new");
}

#[test]
fn a_file_in_memory_is_handed_over_when_it_is_complete() {
    let hand: Hand = |path, bytes| std::fs::write(path, bytes);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.txt");
    let mut output = Output::handed(&path, hand);
    output.put(b"one ").unwrap();
    output.write_all(b"two").unwrap();
    assert!(names(folder.path()).is_empty());
    output.finish().unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"one two");
    let error = Output::handed("x", |_, _| Err(io::ErrorKind::StorageFull.into())).finish().unwrap_err();
    assert!(matches!(error, OutputError::Full { .. }), "{error}");
}

#[test]
fn a_missing_folder_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("nowhere");
    let error = Output::create(missing.join("out.txt")).unwrap_err();
    assert!(matches!(&error, OutputError::FolderMissing { folder, .. } if *folder == missing), "{error}");
    assert!(error.to_string().contains("create it"), "{error}");
}

#[test]
fn a_folder_is_no_file() {
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(Output::create(folder.path()).unwrap_err(), OutputError::IsFolder { .. }));
    assert!(matches!(Output::create(folder.path().join("new/")).unwrap_err(), OutputError::IsFolder { .. }));
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_reported_as_such() {
    let Ok(mut output) = Output::create("/dev/full") else { return };
    output.put(b"something").unwrap();
    let error = output.finish().unwrap_err();
    assert!(matches!(error, OutputError::Full { .. }), "{error}");
}

#[cfg(unix)]
#[test]
fn the_result_is_as_readable_as_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
    Output::create(&ours).unwrap().finish().unwrap();
    std::fs::write(&plain, "").unwrap();
    let mode = |p: &Path| std::fs::metadata(p).unwrap().permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));
}

#[cfg(unix)]
#[test]
fn a_symbolic_link_stays_and_its_target_is_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let (real, link) = (folder.path().join("real"), folder.path().join("link"));
    std::fs::write(&real, "old").unwrap();
    std::os::unix::fs::symlink(&real, &link).unwrap();
    let mut output = Output::create(&link).unwrap();
    output.put(b"new").unwrap();
    output.finish().unwrap();
    assert!(link.is_symlink());
    assert_eq!(std::fs::read_to_string(&real).unwrap(), "new");
}

#[test]
fn a_kept_file_has_one_writer() {
    let folder = tempfile::tempdir().unwrap();
    let (path, part) = (folder.path().join("run.rec"), folder.path().join("run.rec.part"));
    std::fs::write(&part, "of a process that was killed").unwrap();
    let mut first = Output::create_kept(&path).unwrap();
    first.put(b"first").unwrap();
    first.settle(true).unwrap();
    let second = Output::create_kept(&path).unwrap_err();
    assert!(matches!(&second, OutputError::Busy { path: busy } if *busy == path), "{second}");
    assert!(matches!(Output::append_kept(&path, 5, 0).unwrap_err(), OutputError::Busy { .. }));
    first.finish().unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "first");
    // appending to a complete file replaces a `.part` file, unless that is being written
    let writing = Output::create_kept(&path).unwrap();
    assert!(matches!(Output::append_kept(&path, 5, 0).unwrap_err(), OutputError::Busy { .. }));
    drop(writing);
    assert_eq!(names(folder.path()), std::slice::from_ref(&path));
    // the length differs from that at reading
    for length in [4, 6] {
        assert!(matches!(Output::append_kept(&path, length, 4).unwrap_err(), OutputError::Busy { .. }));
    }
    assert_eq!(names(folder.path()), std::slice::from_ref(&path));
    let mut more = Output::append_kept(&path, 5, 5).unwrap();
    more.put(b" more").unwrap();
    assert!(matches!(Output::create_kept(&path).unwrap_err(), OutputError::Busy { .. }));
    more.finish().unwrap();
    assert_eq!(names(folder.path()), std::slice::from_ref(&path));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "first more");
}

#[test]
fn a_file_that_was_removed_meanwhile_is_no_missing_folder() {
    let folder = tempfile::tempdir().unwrap();
    let output = Output::create_kept(folder.path().join("run.rec")).unwrap();
    std::fs::remove_file(output.temporary_path()).unwrap();
    let error = output.finish().unwrap_err();
    assert!(matches!(error, OutputError::Io { .. }), "{error}");
}

#[cfg(unix)]
#[test]
fn a_link_is_not_followed_where_a_kept_file_grows() {
    let folder = tempfile::tempdir().unwrap();
    let [path, part, other] = ["run.rec", "run.rec.part", "other"].map(|name| folder.path().join(name));
    std::os::unix::fs::symlink(&other, &part).unwrap();
    for there in [false, true] {
        if there {
            std::fs::write(&other, "precious").unwrap();
        }
        let error = Output::create_kept(&path).unwrap_err().to_string();
        assert!(error.contains("run.rec.part is a link or not an ordinary file; remove it"), "{error}");
        assert_eq!(other.exists(), there);
    }
    assert_eq!(std::fs::read_to_string(&other).unwrap(), "precious");
}

#[cfg(unix)]
#[test]
fn temporary_files_of_killed_processes_are_removed() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, minutes: u64| {
        let file = File::create(folder.path().join(name)).unwrap();
        file.set_modified(std::time::SystemTime::now() - Duration::from_mins(minutes)).unwrap();
        file
    };
    file(".throng-killed.csv", 2);
    file(".throng-young.csv", 0);
    file("throng-other.csv", 2);
    let held = file(".throng-held.csv", 2);
    held.lock().unwrap();
    Output::remove_leftovers(folder.path().join("out.csv"));
    let mut left = names(folder.path());
    left.sort();
    let want = [".throng-held.csv", ".throng-young.csv", "throng-other.csv"];
    assert_eq!(left, want.map(|name| folder.path().join(name)));
}

#[cfg(unix)]
#[test]
fn a_temporary_file_is_locked() {
    let folder = tempfile::tempdir().unwrap();
    let output = Output::create(folder.path().join("out.csv")).unwrap();
    let other = File::open(output.temporary_path()).unwrap();
    assert!(matches!(other.try_lock(), Err(std::fs::TryLockError::WouldBlock)));
    drop(output);
    other.try_lock().unwrap();
}
