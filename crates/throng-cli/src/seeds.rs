//! Parses the numbers that options name.

use crate::failure::Failure;
use throng_record::sweep::whole_numbers;

/// Returns the seeds of `--seeds`, in order: `1..5`, or `1,3,7`.
///
/// # Errors
/// A seed is not a whole number or is given twice, or there are too many seeds.
pub fn seeds(text: &str) -> Result<Vec<u64>, Failure> {
    numbers("--seeds", "seed", text)
}

/// Returns the numbers of an option, in order; `what` is the name of such a number.
///
/// # Errors
/// A number is not whole or is given twice, or there are too many.
pub fn numbers(option: &str, what: &str, text: &str) -> Result<Vec<u64>, Failure> {
    let wrong = |why: String| Failure::hint(format!("{option} {text}: {why}"), "write 1..5, or 1,3,7");
    whole_numbers(what, text).map_err(wrong)
}
