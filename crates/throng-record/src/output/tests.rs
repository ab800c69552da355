//! Files are complete or not there.

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
