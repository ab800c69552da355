//! Panics in code of plug-ins: caught, and reported with the plug-in's name.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// Runs code of a plug-in and turns a panic in it into an error. Data that the code was changing may be left half
/// changed. Where panics abort the program, as in web pages, this function cannot catch them.
///
/// # Errors
/// The message of the panic.
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
    /// The number of [`caught`] calls that are active in this thread.
    static CATCHING: Cell<u32> = const { Cell::new(0) };
}

/// Keeps panics that [`caught`] catches off standard error from now on: the caller of [`caught`] reports them.
pub fn hush() {
    let loud = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if CATCHING.get() == 0 {
            loud(panic);
        }
    }));
}

/// Runs code of a plug-in. A panic in it continues as a panic that names the plug-in.
pub(crate) fn named<T>(kind: &str, name: &str, code: impl FnOnce() -> T) -> T {
    caught(code).unwrap_or_else(|says| resume_unwind(Box::new(format!("{kind} `{name}`: {says}"))))
}

fn words(panic: &(dyn Any + Send)) -> String {
    let says = panic.downcast_ref::<String>().map(String::as_str);
    says.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("a panic without words").to_owned()
}
