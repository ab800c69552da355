//! A sink that works on a thread of its own, while the next picture is painted.

use super::FrameSink;
use crate::{Error, Image};
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};
use std::thread::JoinHandle;

/// How many pictures may wait.
const WAITING: usize = 3;

/// Hands pictures to another sink on a thread of its own. The result is the same; an error comes out one of the next
/// times it is asked something.
#[derive(Debug)]
pub struct Ahead {
    work: Option<SyncSender<Image>>,
    /// Pictures that have been dealt with, to be used again.
    used: Receiver<Image>,
    worker: Option<JoinHandle<Result<Box<dyn FrameSink>, Error>>>,
}

impl Ahead {
    /// Puts `sink` on a thread of its own; where the system has no thread to give, `sink` is handed back as it is.
    pub fn start(sink: Box<dyn FrameSink>) -> Box<dyn FrameSink> {
        let (work, pictures) = sync_channel::<Image>(WAITING);
        let (done, used) = channel();
        // The sink goes over by a channel of its own, so that it is still here if the thread does not start.
        let (hand_over, taken) = channel::<Box<dyn FrameSink>>();
        let worker = std::thread::Builder::new().name("throng-film".into()).spawn(move || {
            let mut sink = taken.recv().expect("the sink is sent as soon as the thread runs");
            for image in pictures {
                sink.push(&image)?;
                // Nobody may be left to use it again.
                let _ = done.send(image);
            }
            Ok(sink)
        });
        match worker {
            Ok(worker) => {
                hand_over.send(sink).expect("the thread waits for the sink");
                Box::new(Self { work: Some(work), used, worker: Some(worker) })
            }
            Err(_) => sink,
        }
    }

    /// Waits for the thread to end.
    fn join(&mut self) -> Result<Box<dyn FrameSink>, Error> {
        self.work = None;
        let worker = self.worker.take().ok_or(Error::Ended)?;
        worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    }
}

impl FrameSink for Ahead {
    fn push(&mut self, image: &Image) -> Result<(), Error> {
        let mut copy = match self.used.try_recv() {
            Ok(copy) if (copy.width(), copy.height()) == (image.width(), image.height()) => copy,
            _ => image.clone(),
        };
        copy.copy_from(image);
        match self.work.as_ref().map(|work| work.send(copy)) {
            Some(Ok(())) => Ok(()),
            // The thread only stops early at an error.
            _ => self.join().map(|_| ()),
        }
    }

    fn finish(mut self: Box<Self>) -> Result<(), Error> {
        self.join()?.finish()
    }
}

impl Drop for Ahead {
    fn drop(&mut self) {
        self.work = None;
        if let Some(worker) = self.worker.take() {
            // What it has to say does not matter any more; its sink cleans up after itself.
            let _ = worker.join();
        }
    }
}
