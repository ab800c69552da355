//! Work in the background: another thread does it, in order, with a bounded backlog.

use std::fmt;
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, channel, sync_channel};
use std::thread::JoinHandle;

/// Greatest number of items that wait.
const WAITING: usize = 2;

/// How the worker handles one item.
type Work<D, T, E> = fn(&mut D, T) -> Result<(), E>;

/// Passes items to a worker (a film, a table) on its own thread, which handles them in order. The worker handles one
/// item while at most two wait; then the caller blocks. The first error ends the work.
///
/// ```
/// use throng_record::BackgroundWriter;
/// let mut sum = BackgroundWriter::start("sum", 0, |sum, part: i32| {
///     *sum += part;
///     if part < 0 { Err("a negative part") } else { Ok(()) }
/// });
/// assert!((0..10).all(|part| sum.push(part)));
/// assert_eq!(sum.finish(), Ok(45));
/// ```
pub struct BackgroundWriter<D, T, E> {
    work: Work<D, T, E>,
    place: BufferSlot<D, T, E>,
}

enum BufferSlot<D, T, E> {
    There(There<D, T, E>),
    /// The system could not start a thread.
    Here(Result<D, E>),
}

struct There<D, T, E> {
    queue: Option<SyncSender<T>>,
    worker: Option<JoinHandle<Result<D, E>>>,
}

impl<D: Send + 'static, T: Send + 'static, E: Send + 'static> BackgroundWriter<D, T, E> {
    /// Moves `doer` to a thread called `name`. If the system cannot start a thread, items are handled at once by the
    /// caller's thread.
    pub fn start(name: &str, doer: D, work: Work<D, T, E>) -> Self {
        let (queue, things) = sync_channel::<T>(WAITING);
        // `doer` is sent through a channel, so that it is still here if the thread does not start.
        let (hand_over, taken) = channel::<D>();
        let worker = std::thread::Builder::new().name(name.into()).spawn(move || {
            let mut doer = taken.recv().expect("the worker is sent as soon as the thread runs");
            things.into_iter().try_for_each(|thing| work(&mut doer, thing))?;
            Ok(doer)
        });
        let place = match worker {
            Ok(worker) => {
                hand_over.send(doer).expect("the thread waits for the worker");
                BufferSlot::There(There { queue: Some(queue), worker: Some(worker) })
            }
            Err(_) => BufferSlot::Here(Ok(doer)),
        };
        Self { work, place }
    }

    /// Passes on the next item. Returns `false` if the work has failed at this item or an earlier one;
    /// [`finish`](Self::finish) returns the error.
    #[must_use]
    pub fn push(&mut self, thing: T) -> bool {
        match &mut self.place {
            // the thread closes the channel only at an error
            BufferSlot::There(there) => there.queue.as_ref().is_some_and(|queue| queue.send(thing).is_ok()),
            BufferSlot::Here(result) => {
                if let Ok(doer) = result
                    && let Err(error) = (self.work)(doer, thing)
                {
                    *result = Err(error);
                }
                result.is_ok()
            }
        }
    }

    /// Waits until all items are handled, and returns the worker.
    ///
    /// # Errors
    /// The first error of the work.
    pub fn finish(self) -> Result<D, E> {
        match self.place {
            BufferSlot::Here(result) => result,
            BufferSlot::There(mut there) => {
                there.queue = None;
                let worker = there.worker.take().expect("the thread exists until finish");
                worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            }
        }
    }
}

impl<D, T, E> Drop for There<D, T, E> {
    fn drop(&mut self) {
        self.queue = None;
        if let Some(worker) = self.worker.take() {
            // The result no longer matters; the worker releases what it holds.
            let _ = worker.join();
        }
    }
}

impl<D, T, E> fmt::Debug for BackgroundWriter<D, T, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Behind").finish_non_exhaustive()
    }
}

/// Reusable memory: a value that was lent is used again once no other handle to it exists.
///
/// ```
/// let mut pool = throng_record::Pool::<Vec<u32>>::default();
/// let numbers = pool.make(|numbers| numbers.extend([1, 2, 3]));
/// let memory = numbers.as_ptr();
/// drop(numbers);
/// assert_eq!(pool.make(|numbers| numbers.clear()).as_ptr(), memory);
/// ```
#[derive(Debug, Default)]
pub struct Pool<T> {
    all: Vec<Arc<T>>,
}

impl<T: Default> Pool<T> {
    /// Lends a value without other handles, after `fill` has set it. `fill` may receive a value that was used before.
    pub fn make(&mut self, fill: impl FnOnce(&mut T)) -> Arc<T> {
        let free = self.all.iter_mut().position(|value| Arc::get_mut(value).is_some());
        let at = free.unwrap_or_else(|| {
            self.all.push(Arc::default());
            self.all.len() - 1
        });
        let value = &mut self.all[at];
        fill(Arc::get_mut(value).expect("no other handle exists"));
        value.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::Receiver;

    type Slow = (Receiver<()>, Vec<Arc<u32>>);

    /// A worker that waits for permission before each item.
    fn slow(leave: Receiver<()>) -> BackgroundWriter<Slow, Arc<u32>, String> {
        BackgroundWriter::start("slow", (leave, Vec::new()), |(leave, done), thing| {
            leave.recv().map_err(|_| "no permission".to_string())?;
            if *thing == 7 {
                return Err("seven".into());
            }
            done.push(thing);
            Ok(())
        })
    }

    #[test]
    fn everything_is_done_in_order() {
        let (let_on, leave) = channel();
        let mut behind = slow(leave);
        for k in 10..100 {
            let_on.send(()).unwrap();
            assert!(behind.push(Arc::new(k)));
        }
        let (_, done) = behind.finish().unwrap();
        assert_eq!(done.iter().map(|thing| **thing).collect::<Vec<_>>(), (10..100).collect::<Vec<_>>());
    }

    #[test]
    fn a_caller_that_is_too_fast_waits() {
        let (let_on, leave) = channel();
        let (report, reports) = channel();
        let mut behind = slow(leave);
        let hasty = std::thread::spawn(move || {
            for k in 10..20 {
                assert!(behind.push(Arc::new(k)));
                report.send(k).unwrap();
            }
            behind.finish().unwrap().1.len()
        });
        let patience = std::time::Duration::from_millis(200);
        let handed_over = |patience| std::iter::from_fn(|| reports.recv_timeout(patience).ok()).count();
        assert_eq!(handed_over(patience), WAITING + 1, "two items wait, one is handled");
        let_on.send(()).unwrap();
        assert_eq!(handed_over(patience), 1);
        (0..9).for_each(|_| let_on.send(()).unwrap());
        assert_eq!(hasty.join().unwrap(), 10);
    }

    #[test]
    fn an_error_ends_the_work_and_comes_out_at_the_end() {
        let (let_on, leave) = channel();
        let mut behind = slow(leave);
        (0..20).for_each(|_| let_on.send(()).unwrap());
        let pushed = (0..20).take_while(|&k| behind.push(Arc::new(k))).count();
        assert!((8..=8 + WAITING).contains(&pushed), "{pushed}: only waiting items were accepted and not handled");
        assert!(!behind.push(Arc::new(1)));
        assert_eq!(behind.finish().unwrap_err(), "seven");
    }

    #[test]
    fn an_error_at_the_last_thing_is_not_lost() {
        let (let_on, leave) = channel();
        let mut behind = slow(leave);
        assert!(behind.push(Arc::new(7)));
        let_on.send(()).unwrap();
        assert_eq!(behind.finish().unwrap_err(), "seven");
    }

    #[test]
    fn dropping_ends_the_thread() {
        let (let_on, leave) = channel();
        let mut behind = slow(leave);
        let thing = Arc::new(1);
        assert!(behind.push(thing.clone()));
        let_on.send(()).unwrap();
        drop(behind);
        assert_eq!(Arc::strong_count(&thing), 1, "the worker is dropped, with all it held");
    }

    #[test]
    fn a_pool_holds_no_more_than_was_lent_at_once() {
        let mut pool = Pool::<Vec<u32>>::default();
        let slow = pool.make(|numbers| numbers.push(0));
        for k in 1..50 {
            let other = pool.make(|numbers| *numbers = vec![k]);
            assert_eq!((slow.as_slice(), other.as_slice()), (&[0][..], &[k][..]), "a lent value does not change");
        }
        assert_eq!(pool.all.len(), 2);
    }
}
