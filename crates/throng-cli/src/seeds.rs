//! Parses the seeds that options name.

use crate::failure::Failure;

/// More seeds than this are taken for a mistyped number.
const MOST_SEEDS: usize = 10_000;

/// Returns the seeds of `--seeds`, in order: `1..5`, or `1,3,7`.
///
/// # Errors
/// A seed is not a whole number or is given twice, or there are too many seeds.
pub fn seeds(text: &str) -> Result<Vec<u64>, Failure> {
    let wrong = |what: String| Failure::hint(format!("--seeds {text}: {what}"), "write 1..5, or 1,3,7");
    let number = |text: &str| text.trim().parse::<u64>().ok().filter(|seed| i64::try_from(*seed).is_ok());
    let mut seeds = Vec::new();
    for part in text.split(',') {
        let (from, to) = part.split_once("..").unwrap_or((part, part));
        let to = to.strip_prefix('=').unwrap_or(to);
        let (Some(from), Some(to)) = (number(from), number(to)) else {
            return Err(wrong(format!("`{part}` is not a seed: seeds are whole numbers from 0")));
        };
        if from > to {
            return Err(wrong(format!("{from} is more than {to}")));
        }
        if to - from >= (MOST_SEEDS - seeds.len()) as u64 {
            return Err(wrong(format!("these are more than {MOST_SEEDS} seeds")));
        }
        seeds.extend(from..=to);
    }
    match seeds.iter().enumerate().find(|(k, seed)| seeds[..*k].contains(seed)) {
        Some((_, twice)) => Err(wrong(format!("{twice} is given twice"))),
        None => Ok(seeds),
    }
}
