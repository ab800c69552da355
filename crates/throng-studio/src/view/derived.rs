//! Background computation of values that take longer than a frame.

use eframe::egui::Context;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

/// A value that is recomputed in the background when its key changes. Only one computation runs at a time. Until it is
/// complete, the previous value stays.
pub struct Derived<K, T> {
    /// The key and the value, `None` if its computation failed.
    made: Option<(K, Option<Arc<T>>)>,
    begun: Option<(K, Receiver<T>)>,
}

impl<K, T> Default for Derived<K, T> {
    fn default() -> Self {
        Self { made: None, begun: None }
    }
}

impl<K: PartialEq, T: Send + 'static> Derived<K, T> {
    /// Returns the value computed last, which may have another key. Starts the computation for `key` if it differs.
    pub fn of(&mut self, key: K, ctx: &Context, make: impl FnOnce() -> T + Send + 'static) -> Option<Arc<T>> {
        self.take();
        let known = |have: Option<&K>| have == Some(&key);
        if self.begun.is_none() && !known(self.made.as_ref().map(|(of, _)| of)) {
            self.begun = Some((key, crate::outside::beside(ctx, make)));
            // a page computes at once, so the value may already be available
            self.take();
        }
        self.made.as_ref().and_then(|(_, made)| made.clone())
    }

    fn take(&mut self) {
        let Some((key, receiver)) = self.begun.take() else { return };
        match receiver.try_recv() {
            Ok(made) => self.made = Some((key, Some(Arc::new(made)))),
            Err(TryRecvError::Empty) => self.begun = Some((key, receiver)),
            // the computation panicked and would panic again
            Err(TryRecvError::Disconnected) => self.made = Some((key, None)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    #[test]
    fn it_is_made_once_and_anew_when_it_changes() {
        let (ctx, mut made) = (Context::default(), Derived::default());
        let mut get = |key: u32| {
            let begin = Instant::now();
            loop {
                match made.of(key, &ctx, move || (key, Instant::now())) {
                    Some(found) if found.0 == key => return found,
                    _ if begin.elapsed() > Duration::from_secs(20) => panic!("it is never made"),
                    _ => std::thread::sleep(Duration::from_millis(1)),
                }
            }
        };
        let first = get(1);
        assert!(Arc::ptr_eq(&first, &get(1)));
        assert_eq!(get(2).0, 2);
        assert!(!Arc::ptr_eq(&first, &get(1)));
    }
}
