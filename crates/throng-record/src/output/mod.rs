//! A file that appears under its name only when it is complete.

mod claim;
mod error;
mod place;
#[cfg(test)]
mod tests;

pub use error::OutputError;

use claim::{claim, claim_new};
use place::{Part, Place, Temporary, temporary};
use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// A file being written: it grows under a temporary name in the folder of its target and takes the target's name,
/// replacing what was there, in [`finish`](Self::finish). Dropped before that, it leaves nothing behind. The temporary file of a
/// process that was killed stays until [`remove_leftovers`](Self::remove_leftovers).
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
    /// `None`: `file` is the target itself. Before the file, so that it is removed before the lock on the file ends.
    temporary: Option<Temporary>,
    file: Place,
}

/// How long bytes of a file that is kept may wait before the system has them.
const SETTLED: Duration = Duration::from_secs(1);

/// What takes a complete file, under its name, where there are no folders.
pub type Hand = fn(&Path, Vec<u8>) -> io::Result<()>;

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

    /// Removes the temporary files that killed processes left in the folder of `path`, a minute after they were last written. Files
    /// that are being written stay. On Windows it does nothing.
    pub fn remove_leftovers(path: impl AsRef<Path>) {
        #[cfg(unix)]
        place::remove_leftovers(&folder_of(path.as_ref()));
        #[cfg(not(unix))]
        let _ = path;
    }

    /// Begins a file that can be read before it is complete: until then it is called as `path` with `.part` behind it, and so it
    /// stays if the program ends, or the output is dropped, once something was [settled](Self::settle). What was there under that name is gone.
    /// One process at a time writes it.
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
    /// As [`create`](Self::create); [`OutputError::Busy`] if it is being written already.
    pub fn create_kept(path: impl AsRef<Path>) -> Result<Self, OutputError> {
        Self::begin(path.as_ref(), |target| {
            let part = part_of(target);
            let file = claim_new(&part)?;
            file.set_len(0)?;
            Ok((file, Temporary::Kept(Part { path: part, settled: None })))
        })
    }

    /// Goes on with a file that is [kept](Self::create_kept), complete or not, after so many of its bytes; `path` is the name it has
    /// when it is complete. Until it is again, it has the other name.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("diary");
    /// std::fs::write(&path, "Monday. The end.")?;
    /// let mut output = throng_record::Output::append_kept(&path, 8)?;
    /// output.put(b"Tuesday. ")?;
    /// output.finish()?;
    /// assert_eq!(std::fs::read(&path)?, b"Monday. Tuesday. ");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`create_kept`](Self::create_kept); there is no such file.
    pub fn append_kept(path: impl AsRef<Path>, keep: u64) -> Result<Self, OutputError> {
        Self::begin(path.as_ref(), |target| {
            let part = part_of(target);
            let mut file = if target.exists() {
                let _name = claim_new(&part)?;
                let file = claim(target)?;
                std::fs::rename(target, &part)?;
                file
            } else {
                claim(&part)?
            };
            file.set_len(keep)?;
            file.seek(SeekFrom::End(0))?;
            Ok((file, Temporary::Kept(Part { path: part, settled: Some(Instant::now()) })))
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
        let Self { path, target, temporary, mut file } = self;
        // The file stays open, and so locked, until it has its name.
        let done = match &mut file {
            Place::File(file) => file.flush(),
            Place::Memory(bytes, hand) => hand(&target, std::mem::take(bytes)),
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

/// What a file that is kept is called until it is complete.
pub(crate) fn part_of(target: &Path) -> PathBuf {
    let mut part = target.as_os_str().to_owned();
    part.push(".part");
    part.into()
}

/// The folder of a file; `.` for a bare name.
fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_path_buf(),
        _ => PathBuf::from("."),
    }
}
