//! Panics of code that a program brings along: caught, and told with the name of whose they are.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// Runs code that may be somebody else's: a panic in it becomes what it says. What the code was changing may be left half
/// changed. Where panics end the program, as in web pages, they do.
///
/// # Errors
/// What the panic says.
///
/// ```
/// assert_eq!(throng_scene::caught(|| 2 + 2), Ok(4));
/// assert_eq!(throng_scene::caught(|| panic!("two and two")), Err::<(), _>("two and two".into()));
/// ```
pub fn caught<T>(code: impl FnOnce() -> T) -> Result<T, String> {
    CATCHING.set(CATCHING.get() + 1);
    let result = catch_unwind(AssertUnwindSafe(code)).map_err(|panic| words(&*panic));
    CATCHING.set(CATCHING.get() - 1);
    result
}

thread_local! {
    /// How many [`caught`] are at work in this thread.
    static CATCHING: Cell<u32> = const { Cell::new(0) };
}

/// From now on panics that are [`caught`] say nothing on standard error: whoever caught them tells it.
pub fn hush() {
    let loud = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if CATCHING.get() == 0 {
            loud(panic);
        }
    }));
}

/// Runs code of a plug-in: a panic in it goes on as one that says whose it is.
pub(crate) fn named<T>(kind: &str, name: &str, code: impl FnOnce() -> T) -> T {
    caught(code).unwrap_or_else(|says| resume_unwind(Box::new(format!("{kind} `{name}`: {says}"))))
}

fn words(panic: &(dyn Any + Send)) -> String {
    let says = panic.downcast_ref::<String>().map(String::as_str);
    says.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("a panic without words").to_owned()
}
