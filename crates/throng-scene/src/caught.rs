//! Panics of code that a program brings along: caught, and told with the name of whose they are.

use std::any::Any;
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
    catch_unwind(AssertUnwindSafe(code)).map_err(|panic| words(&*panic))
}

/// Runs code of a plug-in: a panic in it goes on as one that says whose it is.
pub(crate) fn named<T>(kind: &str, name: &str, code: impl FnOnce() -> T) -> T {
    caught(code).unwrap_or_else(|says| resume_unwind(Box::new(format!("{kind} `{name}`: {says}"))))
}

fn words(panic: &(dyn Any + Send)) -> String {
    let says = panic.downcast_ref::<String>().map(String::as_str);
    says.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("a panic without words").to_owned()
}
