//! An engine in a thread of its own, so that no window waits for a step.

use super::engine::{Command, Engine};
use super::shown::{Shown, Trouble};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// A thread works for so long before it shows what it has done.
const SLICE: Duration = Duration::from_millis(12);

/// What a thread has to show.
type Window = Arc<Mutex<(Option<Arc<Shown>>, Option<Trouble>)>>;

/// An [`Engine`] that works in a thread of its own; dropped, it stops.
pub struct Threaded {
    commands: Option<Sender<Command>>,
    window: Window,
    thread: Option<JoinHandle<()>>,
}

impl Threaded {
    /// Starts the thread; it calls `wake` whenever there is something new to see.
    ///
    /// # Errors
    /// The system starts no thread.
    pub fn start(wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let (sender, receiver) = channel();
        let window = Window::default();
        let shared = window.clone();
        let work = move || serve(&receiver, &shared, &wake);
        let thread = std::thread::Builder::new().name("throng-player".into()).spawn(work)?;
        Ok(Self { commands: Some(sender), window, thread: Some(thread) })
    }

    /// Lets the engine do something, soon.
    pub fn command(&mut self, command: Command) {
        if let Some(commands) = &self.commands {
            // an engine that has stopped does nothing: what there is to see stays
            let _ = commands.send(command);
        }
    }

    /// What there is to see; `None` before the first scene.
    pub fn shown(&mut self) -> Option<Arc<Shown>> {
        self.window.lock().unwrap_or_else(PoisonError::into_inner).0.clone()
    }

    /// What went wrong last.
    pub fn trouble(&self) -> Option<Trouble> {
        self.window.lock().unwrap_or_else(PoisonError::into_inner).1.clone()
    }
}

impl Drop for Threaded {
    fn drop(&mut self) {
        self.commands = None;
        if let Some(thread) = self.thread.take() {
            // a thread that panicked has nothing to finish
            let _ = thread.join();
        }
    }
}

fn serve(commands: &Receiver<Command>, window: &Window, wake: &impl Fn()) {
    let mut engine = Engine::default();
    loop {
        let mut news = false;
        let next = match engine.idle() {
            None => commands.recv().map_err(|_| RecvTimeoutError::Disconnected),
            Some(wait) => commands.recv_timeout(wait),
        };
        match next {
            Ok(command) => {
                engine.command(command);
                news = true;
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
        loop {
            match commands.try_recv() {
                Ok(command) => engine.command(command),
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => return,
            }
        }
        news |= engine.work(SLICE);
        if news {
            let seen = (engine.shown(), engine.trouble());
            *window.lock().unwrap_or_else(PoisonError::into_inner) = seen;
            wake();
        }
    }
}
