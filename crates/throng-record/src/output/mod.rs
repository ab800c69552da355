//! A file that appears under its name only when it is complete.

mod claim;
mod error;
mod place;
#[cfg(test)]
mod tests;

pub use error::OutputError;

use claim::{claim, claim_new};
use place::{OutputPlace, Temporary, UnfinishedFile, temporary};
use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// A file being written. It grows under a temporary name in the folder of its target. [`finish`](Self::finish) renames
/// it to the target, replacing an existing file. An output that is dropped before that leaves no file. The temporary
/// file of a killed process stays until [`remove_leftovers`](Self::remove_leftovers).
///
/// A file that can be read before it is complete is started with [`create_kept`](Self::create_kept) instead, and stays.
///
/// A target that exists and is not an ordinary file (a pipe, `/dev/stdout`) is written to directly.
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
    /// The path of the finished file: `path` with symbolic links followed.
    target: PathBuf,
    /// `None`: `file` is the target itself. Declared before the file, so that it is removed before the lock on the file
    /// ends.
    temporary: Option<Temporary>,
    file: OutputPlace,
}

/// Longest time that bytes of a kept file wait before they are passed to the system.
const SETTLED: Duration = Duration::from_secs(1);

/// Receives a complete file and its name on systems without folders.
pub type Hand = fn(&Path, Vec<u8>) -> io::Result<()>;

impl Output {
    /// Starts a file that will be called `path`.
    ///
    /// # Errors
    /// The folder is missing or not writable, or `path` is a folder.
    pub fn create(path: impl AsRef<Path>) -> Result<Self, OutputError> {
        Self::begin(path.as_ref(), |target| {
            let folder = folder_of(target);
            // The extension is kept for programs that depend on it.
            let suffix = target.extension().map(|e| format!(".{}", e.to_string_lossy())).unwrap_or_default();
            let (file, temporary) = temporary(&folder, &suffix)?.into_parts();
            Ok((file, Temporary::Removed(temporary)))
        })
    }

    /// Removes temporary files of killed processes from the folder of `path`, a minute after they were last written.
    /// Files that are being written stay. On Windows the function does nothing.
    pub fn remove_leftovers(path: impl AsRef<Path>) {
        #[cfg(unix)]
        place::remove_leftovers(&folder_of(path.as_ref()));
        #[cfg(not(unix))]
        let _ = path;
    }

    /// Starts a file that can be read before it is complete. Until it is complete, its name is `path` with `.part`
    /// appended. It keeps that name if the program ends, or the output is dropped, after data were
    /// [settled](Self::settle). An existing file of that name is overwritten. A single process may write the file at a
    /// time.
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
            Ok((file, Temporary::Kept(UnfinishedFile { path: part, settled: None })))
        })
    }

    /// Continues a [kept](Self::create_kept) file, complete or not, after the first `keep` of its `length` bytes.
    /// `path` is the name of the complete file. Until it is complete again, it has the name with `.part`.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("diary");
    /// std::fs::write(&path, "Monday. The end.")?;
    /// let mut output = throng_record::Output::append_kept(&path, 16, 8)?;
    /// output.put(b"Tuesday. ")?;
    /// output.finish()?;
    /// assert_eq!(std::fs::read(&path)?, b"Monday. Tuesday. ");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`create_kept`](Self::create_kept), or the file does not exist. [`OutputError::Busy`] also if its length
    /// differs from `length`: another process has written it since it was read.
    pub fn append_kept(path: impl AsRef<Path>, length: u64, keep: u64) -> Result<Self, OutputError> {
        Self::begin(path.as_ref(), |target| {
            let part = part_of(target);
            let as_read = |file: File| match file.metadata()?.len() == length {
                true => Ok(file),
                false => Err(io::Error::from(io::ErrorKind::ResourceBusy)),
            };
            let mut file = if target.exists() {
                let file = as_read(claim(target)?)?;
                let _name = claim_new(&part)?;
                std::fs::rename(target, &part)?;
                file
            } else {
                as_read(claim(&part)?)?
            };
            file.set_len(keep)?;
            file.seek(SeekFrom::End(0))?;
            Ok((file, Temporary::Kept(UnfinishedFile { path: part, settled: Some(Instant::now()) })))
        })
    }

    /// Starts a file; `open` creates the file in which it grows.
    fn begin(path: &Path, open: impl FnOnce(&Path) -> io::Result<(File, Temporary)>) -> Result<Self, OutputError> {
        let path = path.to_path_buf();
        let fail = |source| OutputError::new(&path, source);
        // A name that ends in a separator denotes a folder, whether or not it exists.
        if path.is_dir() || path.as_os_str().as_encoded_bytes().last().is_some_and(|&b| b == b'/') {
            return Err(OutputError::IsFolder { path });
        }
        if path.exists() && !path.is_file() {
            let file = File::options().write(true).open(&path).map_err(fail)?;
            let file = OutputPlace::File(BufWriter::new(file));
            return Ok(Self { target: path.clone(), path, file, temporary: None });
        }
        let target = if path.exists() { path.canonicalize().map_err(fail)? } else { path.clone() };
        let folder = folder_of(&target);
        if !folder.is_dir() {
            return Err(OutputError::FolderMissing { path, folder });
        }
        let (file, temporary) = open(&target).map_err(fail)?;
        let file = OutputPlace::File(BufWriter::with_capacity(1 << 16, file));
        Ok(Self { path, target, file, temporary: Some(temporary) })
    }

    /// Starts a file in memory, which is passed to `hand` when it is complete: for systems without folders, such as web
    /// pages.
    pub fn handed(path: impl AsRef<Path>, hand: Hand) -> Self {
        let path = path.as_ref().to_path_buf();
        Self { target: path.clone(), path, file: OutputPlace::Memory(Vec::new(), hand), temporary: None }
    }

    /// Starts another file where this one would be: in the file system, or in memory.
    ///
    /// # Errors
    /// As [`create`](Self::create).
    pub fn another(&self, path: impl AsRef<Path>) -> Result<Self, OutputError> {
        match &self.file {
            OutputPlace::Memory(_, hand) => Ok(Self::handed(path, *hand)),
            OutputPlace::File(_) => Self::create(path),
        }
    }

    /// Returns the name of the complete file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the name of the file that is being written now.
    pub fn temporary_path(&self) -> &Path {
        self.temporary.as_ref().map_or(&self.target, Temporary::path)
    }

    /// Returns the path of the file that is being written, for code that opens it by name; `None` if bytes go to a pipe
    /// or into memory.
    pub fn own_file(&self) -> Option<&Path> {
        self.temporary.as_ref().map(Temporary::path)
    }

    /// Converts a system error of writing to an error with the file's path.
    pub fn error(&self, source: io::Error) -> OutputError {
        failed(&self.path, self.temporary.as_ref(), source)
    }

    /// Passes the written bytes to the system, so that they survive the program: at once if `now`, else at the first
    /// call and at most once a second. Does nothing for a file that is not [kept](Self::create_kept).
    ///
    /// # Errors
    /// A system error, such as a full disk.
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
    /// A system error, such as a full disk.
    pub fn put(&mut self, bytes: &[u8]) -> Result<(), OutputError> {
        self.file.of().write_all(bytes).map_err(|source| self.error(source))
    }

    /// Gives the complete file its name.
    ///
    /// # Errors
    /// The last bytes cannot be written, or the file cannot be renamed. No file is left then, except a
    /// [kept](Self::create_kept) one.
    pub fn finish(self) -> Result<(), OutputError> {
        let Self { path, target, temporary, mut file } = self;
        // The file stays open, and so locked, until it has its name.
        let done = match &mut file {
            OutputPlace::File(file) => file.flush(),
            OutputPlace::Memory(bytes, hand) => hand(&target, std::mem::take(bytes)),
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

/// Returns an error about a file that has been started.
fn failed(path: &Path, temporary: Option<&Temporary>, source: io::Error) -> OutputError {
    let error = OutputError::new(path, source);
    match temporary {
        Some(Temporary::Kept(part)) if part.settled.is_some() => {
            OutputError::Kept { error: Box::new(error), part: part.path.clone() }
        }
        _ => error,
    }
}

/// Returns the name of an incomplete kept file.
pub(crate) fn part_of(target: &Path) -> PathBuf {
    let mut part = target.as_os_str().to_owned();
    part.push(".part");
    part.into()
}

/// Returns the folder of a file; `.` for a bare name.
fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_path_buf(),
        _ => PathBuf::from("."),
    }
}
