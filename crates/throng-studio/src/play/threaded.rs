//! An engine in its own thread, so that the window does not wait for steps.

use super::engine::{Command, Engine};
use super::run_moment::{RunMoment, Trouble};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// The working time before the thread publishes a state.
const SLICE: Duration = Duration::from_millis(12);

/// The state that the thread publishes.
type Window = Arc<Mutex<(Option<Arc<RunMoment>>, Option<Trouble>)>>;

/// An [`Engine`] in its own thread. Dropping it stops the thread.
pub struct ThreadedEngine {
    commands: Option<Sender<Command>>,
    window: Window,
    thread: Option<JoinHandle<()>>,
}

impl ThreadedEngine {
    /// Starts the thread. The thread calls `wake` after each new state.
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

    /// Sends a command to the engine.
    pub fn command(&mut self, command: Command) {
        if let Some(commands) = &self.commands {
            // fails only after the engine has stopped; the last state stays
            let _ = commands.send(command);
        }
    }

    /// Returns the current state, `None` before the first scene.
    pub fn shown(&mut self) -> Option<Arc<RunMoment>> {
        self.window.lock().unwrap_or_else(PoisonError::into_inner).0.clone()
    }

    /// Returns the last error.
    pub fn trouble(&self) -> Option<Trouble> {
        self.window.lock().unwrap_or_else(PoisonError::into_inner).1.clone()
    }
}

impl Drop for ThreadedEngine {
    fn drop(&mut self) {
        self.commands = None;
        if let Some(thread) = self.thread.take() {
            // a panicked thread has nothing to finish
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
