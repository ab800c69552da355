//! A file that appears under its name only when it is complete.

use std::fmt;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tempfile::{NamedTempFile, TempPath};

/// Why a file could not be written. Every message names the path and says what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// The folder the file should go to is not there.
    #[error("cannot write {}: there is no folder {}; create it, or name another", path.display(), folder.display())]
    FolderMissing {
        /// The file.
        path: PathBuf,
        /// The folder that is missing.
        folder: PathBuf,
    },
    /// The path is a folder.
    #[error("cannot write {}: it is a folder; add a file name", path.display())]
    IsFolder {
        /// The path.
        path: PathBuf,
    },
    /// The system does not let us write there.
    #[error("cannot write {}: permission denied; check the folder's permissions, or write elsewhere", path.display())]
    Denied {
        /// The file.
        path: PathBuf,
    },
    /// No room is left.
    #[error("cannot write {}: the disk is full; free some space, or write to another disk", path.display())]
    Full {
        /// The file.
        path: PathBuf,
    },
    /// The file has reached the greatest size that is allowed.
    #[error(
        "cannot write {}: a file may not grow larger here; raise the limit (`ulimit -f`), or write to another disk",
        path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
    },
    /// It could not be completed, and what there is of it can be read.
    #[error("{error}\n  hint: what was written until then is in {}, and is read as the whole would be", part.display())]
    Kept {
        /// Why.
        error: Box<OutputError>,
        /// The file that is there.
        part: PathBuf,
    },
    /// Anything else the system reports.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

impl OutputError {
    /// The error of the system as an error about `path`.
    pub fn new(path: &Path, source: io::Error) -> Self {
        let path = path.to_path_buf();
        match source.kind() {
            io::ErrorKind::NotFound => Self::FolderMissing { folder: folder_of(&path), path },
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => Self::Denied { path },
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => Self::Full { path },
            io::ErrorKind::FileTooLarge => Self::TooLarge { path },
            io::ErrorKind::IsADirectory => Self::IsFolder { path },
            _ => Self::Io { path, source },
        }
    }

    /// The file it is about.
    pub fn path(&self) -> &Path {
        match self {
            Self::FolderMissing { path, .. }
            | Self::IsFolder { path }
            | Self::Denied { path }
            | Self::Full { path }
            | Self::TooLarge { path }
            | Self::Io { path, .. } => path,
            Self::Kept { error, .. } => error.path(),
        }
    }
}

/// A file being written: it grows under a temporary name in the folder of its target and takes the target's name,
/// replacing what was there, in [`finish`](Self::finish). Dropped before that, it leaves nothing behind.
///
/// What can be read before it is complete is begun with [`create_kept`](Self::create_kept) instead, and stays.
///
/// A target that exists and is no ordinary file (a pipe, `/dev/stdout`) is written to directly.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("hello.txt");
/// use std::io::Write;
/// let mut output = throng_record::Output::create(&path)?;
/// output.write_all(b"hello")?;
/// assert!(!path.exists());
/// output.finish()?;
/// assert_eq!(std::fs::read(&path)?, b"hello");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    /// Where the finished file goes: `path` with symbolic links followed.
    target: PathBuf,
    file: Place,
    /// `None`: `file` is the target itself.
    temporary: Option<Temporary>,
}

/// The file that is not yet complete.
#[derive(Debug)]
enum Temporary {
    /// Is removed when dropped.
    Removed(TempPath),
    /// Stays.
    Kept(Part),
}

/// A file that stays as soon as the system has something of it.
#[derive(Debug)]
struct Part {
    path: PathBuf,
    /// When its bytes were last handed to the system.
    settled: Option<Instant>,
}

impl Drop for Part {
    fn drop(&mut self) {
        if self.settled.is_none() {
            // what cannot be removed stays, and is empty
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

impl Temporary {
    fn path(&self) -> &Path {
        match self {
            Self::Removed(path) => path,
            Self::Kept(part) => &part.path,
        }
    }

    fn persist(self, target: &Path) -> io::Result<()> {
        match self {
            Self::Removed(path) => path.persist(target).map_err(|error| error.error),
            Self::Kept(part) => std::fs::rename(&part.path, target),
        }
    }
}

/// How long bytes of a file that is kept may wait before the system has them.
const SETTLED: Duration = Duration::from_secs(1);

/// What takes a complete file, under its name, where there are no folders.
pub type Hand = fn(&Path, Vec<u8>) -> io::Result<()>;

/// Where bytes are until the file is complete.
enum Place {
    File(BufWriter<File>),
    Memory(Vec<u8>, Hand),
}

impl fmt::Debug for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(file) => file.fmt(f),
            Self::Memory(bytes, _) => write!(f, "{} bytes", bytes.len()),
        }
    }
}

impl Place {
    fn of(&mut self) -> &mut dyn Write {
        match self {
            Self::File(file) => file,
            Self::Memory(bytes, _) => bytes,
        }
    }
}

impl Output {
    /// Begins a file that will be called `path`.
    ///
    /// # Errors
    /// The folder is missing or cannot be written to, or `path` is a folder.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, OutputError> {
        Self::begin(path.as_ref(), |target| {
            let folder = folder_of(target);
            // The extension is kept, for programs that go by it.
            let suffix = target.extension().map(|e| format!(".{}", e.to_string_lossy())).unwrap_or_default();
            let (file, temporary) = temporary(&folder, &suffix)?.into_parts();
            Ok((file, Temporary::Removed(temporary)))
        })
    }

    /// Begins a file that can be read before it is complete: until then it is called as `path` with `.part` behind it, and so it
    /// stays if the program ends, or the output is dropped, once something was [settled](Self::settle). What was there under that name is gone.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("diary");
    /// let mut output = throng_record::Output::create_kept(&path)?;
    /// output.put(b"Monday. ")?;
    /// output.settle(true)?;
    /// drop(output);
    /// assert_eq!(std::fs::read(folder.path().join("diary.part"))?, b"Monday. ");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`create`](Self::create).
    pub fn create_kept(path: impl AsRef<Path>) -> Result<Self, OutputError> {
        Self::begin(path.as_ref(), |target| {
            let mut part = target.as_os_str().to_owned();
            part.push(".part");
            let file = File::create(&part)?;
            Ok((file, Temporary::Kept(Part { path: part.into(), settled: None })))
        })
    }

    /// Begins a file; `open` makes the one in which it grows.
    fn begin(path: &Path, open: impl FnOnce(&Path) -> io::Result<(File, Temporary)>) -> Result<Self, OutputError> {
        let path = path.to_path_buf();
        let fail = |source| OutputError::new(&path, source);
        // A name that ends in a separator means a folder, whether or not it exists.
        if path.is_dir() || path.as_os_str().as_encoded_bytes().last().is_some_and(|&b| b == b'/') {
            return Err(OutputError::IsFolder { path });
        }
        if path.exists() && !path.is_file() {
            let file = File::options().write(true).open(&path).map_err(fail)?;
            let file = Place::File(BufWriter::new(file));
            return Ok(Self { target: path.clone(), path, file, temporary: None });
        }
        let target = if path.exists() { path.canonicalize().map_err(fail)? } else { path.clone() };
        let folder = folder_of(&target);
        if !folder.is_dir() {
            return Err(OutputError::FolderMissing { path, folder });
        }
        let (file, temporary) = open(&target).map_err(fail)?;
        let file = Place::File(BufWriter::with_capacity(1 << 16, file));
        Ok(Self { path, target, file, temporary: Some(temporary) })
    }

    /// Begins a file in memory, which is handed over when it is complete: for where there are no folders, as in a web page.
    pub fn handed(path: impl AsRef<Path>, hand: Hand) -> Self {
        let path = path.as_ref().to_path_buf();
        Self { target: path.clone(), path, file: Place::Memory(Vec::new(), hand), temporary: None }
    }

    /// The name it will have.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The name of the file that is being written now.
    pub fn temporary_path(&self) -> &Path {
        self.temporary.as_ref().map_or(&self.target, Temporary::path)
    }

    /// The file that is being written, for what opens it by its name; `None` where bytes go elsewhere, to a pipe or into memory.
    pub fn own_file(&self) -> Option<&Path> {
        self.temporary.as_ref().map(Temporary::path)
    }

    /// An error met while writing it, with its path.
    pub fn error(&self, source: io::Error) -> OutputError {
        failed(&self.path, self.temporary.as_ref(), source)
    }

    /// Hands what was written to the system, so that it outlives the program: at once where `now`, else the first time and
    /// if it has not been done for a second. Of a file that is not [kept](Self::create_kept) nothing is to outlive it.
    ///
    /// # Errors
    /// The system's, such as a full disk.
    pub fn settle(&mut self, now: bool) -> Result<(), OutputError> {
        if let Some(Temporary::Kept(part)) = &mut self.temporary
            && (now || part.settled.is_none_or(|settled| settled.elapsed() > SETTLED))
        {
            part.settled = Some(Instant::now());
            self.file.of().flush().map_err(|source| self.error(source))?;
        }
        Ok(())
    }

    /// Appends `bytes`.
    ///
    /// # Errors
    /// The system's, such as a full disk.
    pub fn put(&mut self, bytes: &[u8]) -> Result<(), OutputError> {
        self.file.of().write_all(bytes).map_err(|source| self.error(source))
    }

    /// Gives the complete file its name.
    ///
    /// # Errors
    /// The last bytes cannot be written, or the file cannot be renamed. Nothing is left behind then, but of a file that is
    /// [kept](Self::create_kept).
    pub fn finish(self) -> Result<(), OutputError> {
        let Self { path, target, file, temporary } = self;
        let done = match file {
            Place::File(mut file) => file.flush(),
            Place::Memory(bytes, hand) => hand(&target, bytes),
        };
        let Some(temporary) = temporary else { return done.map_err(|source| OutputError::new(&path, source)) };
        done.map_err(|source| failed(&path, Some(&temporary), source))?;
        temporary.persist(&target).map_err(|source| OutputError::new(&path, source))
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.of().write(bytes)
    }

    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.of().write_all(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.of().flush()
    }
}

/// An error about a file that has been begun.
fn failed(path: &Path, temporary: Option<&Temporary>, source: io::Error) -> OutputError {
    let error = OutputError::new(path, source);
    match temporary {
        Some(Temporary::Kept(part)) if part.settled.is_some() => {
            OutputError::Kept { error: Box::new(error), part: part.path.clone() }
        }
        _ => error,
    }
}

/// The folder of a file; `.` for a bare name.
fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

fn temporary(folder: &Path, suffix: &str) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".throng-").suffix(suffix);
    #[cfg(unix)]
    {
        // Temporary files are private by default; a result is as readable as any other file (the umask applies).
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
