//! Lists of whole numbers as text, such as `1..5`.

/// More numbers than this are taken for a mistyped number.
const MOST: usize = 10_000;

/// Returns the numbers that a text names, in order: `1..5` (1 to 5), or `1,3,7`.
///
/// ```
/// use throng_record::sweep::whole_numbers;
/// assert_eq!(whole_numbers("seed", "1..3,9"), Ok(vec![1, 2, 3, 9]));
/// assert_eq!(whole_numbers("seed", "x").unwrap_err(), "`x` is not a seed: seeds are whole numbers from 0");
/// ```
///
/// # Errors
/// A number is not whole or is given twice, or there are too many. The message says which; `what` is the name of such a
/// number, for the message.
pub fn whole_numbers(what: &str, text: &str) -> Result<Vec<u64>, String> {
    let number = |text: &str| text.trim().parse::<u64>().ok().filter(|number| i64::try_from(*number).is_ok());
    let mut numbers = Vec::new();
    for part in text.split(',') {
        let (from, to) = part.split_once("..").unwrap_or((part, part));
        let to = to.strip_prefix('=').unwrap_or(to);
        let (Some(from), Some(to)) = (number(from), number(to)) else {
            return Err(format!("`{part}` is not {} {what}: {what}s are whole numbers from 0", article(what)));
        };
        if from > to {
            return Err(format!("{from} is more than {to}"));
        }
        if to - from >= (MOST - numbers.len()) as u64 {
            return Err(format!("these are more than {MOST} {what}s"));
        }
        numbers.extend(from..=to);
    }
    twice(&numbers).map_or(Ok(()), |number| Err(format!("{number} is given twice")))?;
    Ok(numbers)
}

/// Returns a number that a list holds twice.
fn twice(numbers: &[u64]) -> Option<u64> {
    let mut sorted = numbers.to_vec();
    sorted.sort_unstable();
    sorted.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}

fn article(what: &str) -> &'static str {
    if what.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}
