//! A recording in a thread of its own.

use super::{Begin, Job, Subject, Take};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// A thread works for so long before it says how far it is.
const SLICE: Duration = Duration::from_millis(50);

/// A [`Job`] that works in a thread of its own; dropped, it stops, and leaves nothing if it was not done.
pub struct Threaded {
    told: Arc<Told>,
    end: Receiver<Result<(), String>>,
    thread: Option<JoinHandle<()>>,
}

/// What a thread and who started it tell each other.
#[derive(Default)]
struct Told {
    /// How much is done: the bits of a number from 0 to 1.
    share: AtomicU32,
    stop: AtomicBool,
    /// What there is is to be completed.
    finish: AtomicBool,
}

impl Threaded {
    /// Starts the thread; it calls `wake` now and then, and when it is done.
    ///
    /// # Errors
    /// The system starts no thread.
    pub fn start(subject: Subject, take: Take, begin: Begin, wake: impl Fn() + Send + 'static) -> Result<Self, String> {
        let (told, (sender, end)) = (Arc::new(Told::default()), channel());
        let shared = told.clone();
        let work = move || {
            let done = work(&subject, &take, begin, &shared, &wake);
            tell(&sender, done);
            wake();
        };
        let thread = std::thread::Builder::new().name("throng-recording".into()).spawn(work);
        let thread = thread.map_err(|error| format!("the recording's thread does not start: {error}"))?;
        Ok(Self { told, end, thread: Some(thread) })
    }

    /// How much is done, 0 to 1.
    pub fn share(&self) -> f32 {
        f32::from_bits(self.told.share.load(Ordering::Relaxed))
    }

    /// Completes the file with what there is of it, soon.
    ///
    /// # Errors
    /// None: [`done`](Self::done) tells.
    pub fn finish(&mut self) -> Result<(), String> {
        self.told.finish.store(true, Ordering::Relaxed);
        Ok(())
    }

    /// Whether the file is complete.
    ///
    /// # Errors
    /// There will be none; why.
    pub fn done(&mut self) -> Result<bool, String> {
        match self.end.try_recv() {
            Ok(done) => done.map(|()| true),
            Err(TryRecvError::Empty) => Ok(false),
            Err(TryRecvError::Disconnected) => Err("the recording broke off".into()),
        }
    }
}

impl Drop for Threaded {
    fn drop(&mut self) {
        self.told.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // one that panicked has cleaned up
            let _ = thread.join();
        }
    }
}

fn tell(end: &Sender<Result<(), String>>, done: Result<(), String>) {
    // who does not listen any more has stopped it
    let _ = end.send(done);
}

fn work(subject: &Subject, take: &Take, begin: Begin, told: &Told, wake: &impl Fn()) -> Result<(), String> {
    let mut job = Job::new(subject, take, begin)?;
    while !told.stop.load(Ordering::Relaxed) {
        if told.finish.load(Ordering::Relaxed) {
            return job.finish();
        }
        if job.work(SLICE)? {
            return Ok(());
        }
        told.share.store(job.share().to_bits(), Ordering::Relaxed);
        wake();
    }
    Ok(())
}
