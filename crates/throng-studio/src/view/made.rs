//! What takes too long for a frame, and is made beside it.

use eframe::egui::Context;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};

/// Something that is made anew when what it is made of has changed: beside the window, one at a time, so that what changes
/// all the time is made as often as that goes. Until then there is what was made before.
pub struct Made<K, T> {
    /// Of what, and what it is; `None` where making it failed.
    made: Option<(K, Option<Arc<T>>)>,
    begun: Option<(K, Receiver<T>)>,
}

impl<K, T> Default for Made<K, T> {
    fn default() -> Self {
        Self { made: None, begun: None }
    }
}

impl<K: PartialEq, T: Send + 'static> Made<K, T> {
    /// What was made last, of this or of what there was before; begins to make it of `key` where that is another one.
    pub fn of(&mut self, key: K, ctx: &Context, make: impl FnOnce() -> T + Send + 'static) -> Option<Arc<T>> {
        self.take();
        let known = |have: Option<&K>| have == Some(&key);
        if self.begun.is_none() && !known(self.made.as_ref().map(|(of, _)| of)) {
            self.begun = Some((key, crate::outside::beside(ctx, make)));
            // what was made at once is there now
            self.take();
        }
        self.made.as_ref().and_then(|(_, made)| made.clone())
    }

    fn take(&mut self) {
        let Some((key, receiver)) = self.begun.take() else { return };
        match receiver.try_recv() {
            Ok(made) => self.made = Some((key, Some(Arc::new(made)))),
            Err(TryRecvError::Empty) => self.begun = Some((key, receiver)),
            // it panicked, and would again
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
        let (ctx, mut made) = (Context::default(), Made::default());
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
