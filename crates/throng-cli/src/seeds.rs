//! Seeds, as options name them.

use crate::failure::Failure;

/// More seeds than this are a slip of the pen.
const MOST_SEEDS: usize = 10_000;

/// The seeds of `--seeds`, in order: `1..5`, or `1,3,7`.
///
/// # Errors
/// They are no whole numbers, too many, or one comes twice.
pub fn seeds(text: &str) -> Result<Vec<u64>, Failure> {
    let wrong = |what: String| Failure::hint(format!("--seeds {text}: {what}"), "write 1..5, or 1,3,7");
    let number = |text: &str| text.trim().parse::<u64>().ok().filter(|seed| i64::try_from(*seed).is_ok());
    let mut seeds = Vec::new();
    for part in text.split(',') {
        let (from, to) = part.split_once("..").unwrap_or((part, part));
        let to = to.strip_prefix('=').unwrap_or(to);
        let (Some(from), Some(to)) = (number(from), number(to)) else {
            return Err(wrong(format!("`{part}` is no seed, a whole number that is not negative")));
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
