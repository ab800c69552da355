//! A recording in its own thread.

use super::{Begin, Job, Subject, Take};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// The working time before the thread reports its progress.
const SLICE: Duration = Duration::from_millis(50);

/// A [`Job`] in its own thread. Dropping it stops the thread and removes an incomplete file.
pub struct ThreadedJob {
    shared: Arc<Shared>,
    end: Receiver<Result<(), String>>,
    thread: Option<JoinHandle<()>>,
}

/// The state shared by the thread and its owner.
#[derive(Default)]
struct Shared {
    /// The completed share: the bits of an `f32` from 0 to 1.
    share: AtomicU32,
    stop: AtomicBool,
    /// Whether to complete the file now.
    finish: AtomicBool,
}

impl ThreadedJob {
    /// Starts the thread. The thread calls `wake` at intervals and at the end.
    ///
    /// # Errors
    /// The system starts no thread.
    pub fn start(subject: Subject, take: Take, begin: Begin, wake: impl Fn() + Send + 'static) -> Result<Self, String> {
        let (shared, (sender, end)) = (Arc::new(Shared::default()), channel());
        let of_thread = shared.clone();
        let work = move || {
            let done = work(&subject, &take, begin, &of_thread, &wake);
            tell(&sender, done);
            wake();
        };
        let thread = std::thread::Builder::new().name("throng-recording".into()).spawn(work);
        let thread = thread.map_err(|error| format!("the recording's thread does not start: {error}"))?;
        Ok(Self { shared, end, thread: Some(thread) })
    }

    /// Returns the completed share, 0 to 1.
    pub fn share(&self) -> f32 {
        f32::from_bits(self.shared.share.load(Ordering::Relaxed))
    }

    /// Requests to complete the file with the frames that exist.
    ///
    /// # Errors
    /// None. [`done`](Self::done) returns the outcome.
    pub fn finish(&mut self) -> Result<(), String> {
        self.shared.finish.store(true, Ordering::Relaxed);
        Ok(())
    }

    /// Whether the file is complete.
    ///
    /// # Errors
    /// The recording failed.
    pub fn done(&mut self) -> Result<bool, String> {
        match self.end.try_recv() {
            Ok(done) => done.map(|()| true),
            Err(TryRecvError::Empty) => Ok(false),
            Err(TryRecvError::Disconnected) => Err("the recording has stopped".into()),
        }
    }
}

impl Drop for ThreadedJob {
    fn drop(&mut self) {
        self.shared.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // a panicked thread has cleaned up
            let _ = thread.join();
        }
    }
}

fn tell(end: &Sender<Result<(), String>>, done: Result<(), String>) {
    // sending fails only after the recording was dropped
    let _ = end.send(done);
}

fn work(subject: &Subject, take: &Take, begin: Begin, shared: &Shared, wake: &impl Fn()) -> Result<(), String> {
    let mut job = Job::new(subject, take, begin)?;
    while !shared.stop.load(Ordering::Relaxed) {
        if shared.finish.load(Ordering::Relaxed) {
            return job.finish();
        }
        if job.work(SLICE)? {
            return Ok(());
        }
        shared.share.store(job.share().to_bits(), Ordering::Relaxed);
        wake();
    }
    Ok(())
}
