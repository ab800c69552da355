//! Work that is done behind the back of who asks for it: by another thread, in order, with a bounded backlog.

use std::fmt;
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, channel, sync_channel};
use std::thread::JoinHandle;

/// How many things may wait.
const WAITING: usize = 2;

/// How a doer does one thing.
type Work<D, T, E> = fn(&mut D, T) -> Result<(), E>;

/// Hands things to a doer (a film, a table) on a thread of its own, which deals with them in order. At most two wait
/// and one is dealt with: then who hands over waits. The first error ends the work.
///
/// ```
/// use throng_record::Behind;
/// let mut sum = Behind::start("sum", 0, |sum, part: i32| {
///     *sum += part;
///     if part < 0 { Err("a negative part") } else { Ok(()) }
/// });
/// assert!((0..10).all(|part| sum.push(part)));
/// assert_eq!(sum.finish(), Ok(45));
/// ```
pub struct Behind<D, T, E> {
    work: Work<D, T, E>,
    place: Place<D, T, E>,
}

enum Place<D, T, E> {
    There(There<D, T, E>),
    /// The system had no thread to give.
    Here(Result<D, E>),
}

struct There<D, T, E> {
    queue: Option<SyncSender<T>>,
    worker: Option<JoinHandle<Result<D, E>>>,
}

impl<D: Send + 'static, T: Send + 'static, E: Send + 'static> Behind<D, T, E> {
    /// Puts `doer` on a thread called `name`. Where the system has no thread to give, things are done at once.
    pub fn start(name: &str, doer: D, work: Work<D, T, E>) -> Self {
        let (queue, things) = sync_channel::<T>(WAITING);
        // The doer goes over by a channel of its own, so that it is still here if the thread does not start.
        let (hand_over, taken) = channel::<D>();
        let worker = std::thread::Builder::new().name(name.into()).spawn(move || {
            let mut doer = taken.recv().expect("the doer is sent as soon as the thread runs");
            things.into_iter().try_for_each(|thing| work(&mut doer, thing))?;
            Ok(doer)
        });
        let place = match worker {
            Ok(worker) => {
                hand_over.send(doer).expect("the thread waits for the doer");
                Place::There(There { queue: Some(queue), worker: Some(worker) })
            }
            Err(_) => Place::Here(Ok(doer)),
        };
        Self { work, place }
    }

    /// Hands over the next thing. `false`: the work has failed, at this thing or at one before it;
    /// [`finish`](Self::finish) tells why.
    #[must_use]
    pub fn push(&mut self, thing: T) -> bool {
        match &mut self.place {
            // the thread hangs up at an error only
            Place::There(there) => there.queue.as_ref().is_some_and(|queue| queue.send(thing).is_ok()),
            Place::Here(result) => {
                if let Ok(doer) = result
                    && let Err(error) = (self.work)(doer, thing)
                {
                    *result = Err(error);
                }
                result.is_ok()
            }
        }
    }

    /// Waits until everything is done, and gives the doer back.
    ///
    /// # Errors
    /// The first error of the work.
    pub fn finish(self) -> Result<D, E> {
        match self.place {
            Place::Here(result) => result,
            Place::There(mut there) => {
                there.queue = None;
                let worker = there.worker.take().expect("the thread is there until finish");
                worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
            }
        }
    }
}

impl<D, T, E> Drop for There<D, T, E> {
    fn drop(&mut self) {
        self.queue = None;
        if let Some(worker) = self.worker.take() {
            // What it has to say does not matter any more; the doer cleans up after itself.
            let _ = worker.join();
        }
    }
}

impl<D, T, E> fmt::Debug for Behind<D, T, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Behind").finish_non_exhaustive()
    }
}

/// Memory that goes round: what is handed to others is used again when nobody holds it any more.
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
    /// Lends something that nobody holds, after `fill` has made of it what it is to be. It may come with what it was
    /// before.
    pub fn make(&mut self, fill: impl FnOnce(&mut T)) -> Arc<T> {
        let free = self.all.iter_mut().position(|one| Arc::get_mut(one).is_some());
        let at = free.unwrap_or_else(|| {
            self.all.push(Arc::default());
            self.all.len() - 1
        });
        let one = &mut self.all[at];
        fill(Arc::get_mut(one).expect("nobody else holds it"));
        one.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::Receiver;

    type Slow = (Receiver<()>, Vec<Arc<u32>>);

    /// A doer that waits for leave before each thing.
    fn slow(leave: Receiver<()>) -> Behind<Slow, Arc<u32>, String> {
        Behind::start("slow", (leave, Vec::new()), |(leave, done), thing| {
            leave.recv().map_err(|_| "nobody lets it".to_string())?;
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
    fn who_is_too_fast_waits() {
        let (let_on, leave) = channel();
        let (tell, told) = channel();
        let mut behind = slow(leave);
        let hasty = std::thread::spawn(move || {
            for k in 10..20 {
                assert!(behind.push(Arc::new(k)));
                tell.send(k).unwrap();
            }
            behind.finish().unwrap().1.len()
        });
        let patience = std::time::Duration::from_millis(200);
        let handed_over = |patience| std::iter::from_fn(|| told.recv_timeout(patience).ok()).count();
        assert_eq!(handed_over(patience), WAITING + 1, "two wait, one is dealt with");
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
        assert!((8..=8 + WAITING).contains(&pushed), "{pushed}: at most those that waited were taken in vain");
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
    fn who_is_dropped_leaves_no_thread_behind() {
        let (let_on, leave) = channel();
        let mut behind = slow(leave);
        let thing = Arc::new(1);
        assert!(behind.push(thing.clone()));
        let_on.send(()).unwrap();
        drop(behind);
        assert_eq!(Arc::strong_count(&thing), 1, "the doer is gone, with all it held");
    }

    #[test]
    fn a_pool_holds_no_more_than_was_lent_at_once() {
        let mut pool = Pool::<Vec<u32>>::default();
        let slow = pool.make(|numbers| numbers.push(0));
        for k in 1..50 {
            let one = pool.make(|numbers| *numbers = vec![k]);
            assert_eq!((slow.as_slice(), one.as_slice()), (&[0][..], &[k][..]), "what is lent stays as it is");
        }
        assert_eq!(pool.all.len(), 2);
    }
}
