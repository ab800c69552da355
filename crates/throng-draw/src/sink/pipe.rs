//! Any other video, through the program ffmpeg.

use super::{FrameSink, SameSize, check_rate};
use crate::{Error, Image};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::thread::JoinHandle;
use throng_record::Output;

/// Sends pictures to the program ffmpeg, which chooses the format by the ending of the name.
#[derive(Debug)]
pub struct PipeSink {
    output: Output,
    program: PathBuf,
    rate: f64,
    size: SameSize,
    running: Option<Running>,
}

/// The running program; stopped when dropped.
#[derive(Debug)]
struct Running {
    child: Child,
    input: Option<ChildStdin>,
    /// The thread that reads the program's error messages.
    complaints: Option<JoinHandle<String>>,
}

impl PipeSink {
    /// Creates `path` with `rate` pictures per second.
    ///
    /// # Errors
    /// ffmpeg was not found, the folder does not exist or is not writable, or the rate is outside its limits.
    pub fn create(path: impl AsRef<Path>, rate: f64) -> Result<Self, Error> {
        Self::with_program("ffmpeg", path.as_ref(), rate)
    }

    fn with_program(program: impl AsRef<Path>, path: &Path, rate: f64) -> Result<Self, Error> {
        check_rate(rate)?;
        let program = program.as_ref().to_path_buf();
        let output = Output::create(path)?;
        let there = Command::new(&program)
            .arg("-version")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|status| status.success());
        if !there {
            return Err(Error::NoFfmpeg { path: path.to_path_buf() });
        }
        Ok(Self { output, program, rate, size: SameSize::new(path), running: None })
    }

    fn start(&self, width: u32, height: u32) -> Result<Running, Error> {
        let mut command = Command::new(&self.program);
        command.args(["-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba"]);
        command.args(["-video_size", &format!("{width}x{height}"), "-framerate", &self.rate.to_string(), "-i", "-"]);
        // Even sizes, and the same colour space as `.mp4`.
        command.args(["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv"]);
        command.args(["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"]);
        let path = self.output.path();
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
        let codec: &[&str] = match extension.as_str() {
            // A codec that all AVI players support.
            "avi" => &["-c:v", "mpeg4", "-vtag", "xvid", "-q:v", "3", "-pix_fmt", "yuv420p"],
            "webm" => &["-b:v", "0", "-crf", "30", "-deadline", "realtime", "-cpu-used", "6", "-pix_fmt", "yuv420p"],
            "apng" => &["-plays", "0"],
            _ => &["-pix_fmt", "yuv420p", "-q:v", "3"],
        };
        command.args(codec).arg(self.output.temporary_path());
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
        let mut child = command.spawn().map_err(|e| Error::encoder(path, "ffmpeg", e))?;
        let input = child.stdin.take();
        let complaints = child.stderr.take().map(|mut stderr| {
            std::thread::spawn(move || {
                let mut text = Vec::new();
                // Messages that cannot be read cannot be reported.
                let _ = stderr.read_to_end(&mut text);
                String::from_utf8_lossy(&text).trim().to_owned()
            })
        });
        Ok(Running { child, input, complaints })
    }

    /// Returns the program's own error message, or `otherwise`.
    fn failure(&self, running: &mut Running, otherwise: &io::Error) -> Error {
        running.input = None;
        let _ = running.child.wait();
        let said = running.complaints.take().and_then(|thread| thread.join().ok()).unwrap_or_default();
        let message = if said.is_empty() { otherwise.to_string() } else { said };
        Error::encoder(self.output.path(), "ffmpeg", message)
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if self.input.take().is_some() {
            // The program may have ended already.
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

impl FrameSink for PipeSink {
    fn push(&mut self, image: &Image) -> Result<(), Error> {
        self.size.check(image)?;
        let mut running = match self.running.take() {
            Some(running) => running,
            None => self.start(image.width(), image.height())?,
        };
        let written = match &mut running.input {
            Some(input) => input.write_all(image.data()),
            None => Err(io::ErrorKind::BrokenPipe.into()),
        };
        let result = written.map_err(|error| self.failure(&mut running, &error));
        // After an error the program stays without its input, so that `push` and `finish` return errors.
        self.running = Some(running);
        result
    }

    fn finish(mut self: Box<Self>) -> Result<(), Error> {
        self.size.known()?;
        let Some(mut running) = self.running.take() else {
            return Err(Error::Empty { path: self.output.path().to_path_buf() });
        };
        if running.input.take().is_none() {
            return Err(Error::Ended);
        }
        let status = running.child.wait().map_err(|e| Error::encoder(self.output.path(), "ffmpeg", e))?;
        if !status.success() {
            return Err(self.failure(&mut running, &io::Error::other(status.to_string())));
        }
        Ok(self.output.finish()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_program_is_named_with_what_to_do() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("film.mkv");
        let error = PipeSink::with_program("no-such-program-here", &path, 25.0).unwrap_err();
        assert!(matches!(error, Error::NoFfmpeg { .. }));
        let text = error.to_string();
        assert!(text.contains("film.mkv") && text.contains("install") && text.contains(".mp4"), "{text}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
