//! Changes of texts: lines, words, numbers and brackets.

use super::LARGEST;
use crate::rng::Rng;
use std::ops::Range;

/// Numbers within and beyond the limits of readers, and values of other types.
const NUMBERS: [&str; 30] = [
    "nan",
    "inf",
    "-inf",
    "-1",
    "0",
    "-0.0",
    "1",
    "0.5",
    "1e-9",
    "-1e-320",
    "1e5",
    "1e8",
    "100000001",
    "1e9",
    "-1e9",
    "1e16",
    "1e38",
    "1e308",
    "1e999",
    "255",
    "65536",
    "1000000",
    "2147483648",
    "4294967295",
    "4294967296",
    "9007199254740993",
    "9223372036854775807",
    "99999999999999999999",
    "0x10",
    "1_000",
];
const VALUES: [&str; 16] = [
    "true",
    "false",
    "null",
    "\"\"",
    "\"a\"",
    "[]",
    "{}",
    "[0, 0]",
    "[0, 0, 0]",
    "[[0, 0], [1, 0], [1, 1]]",
    "{ uniform = [0, 1] }",
    "{ a = 1 }",
    "\"1\"",
    "''",
    "[1e308, -1e308]",
    "\u{1b}[2J\u{202e}",
];
const BRACKETS: [&str; 10] = ["[", "{", "(", "<g>", "[[", "{a={", "((", "\"", "[{a=", "GEOMETRYCOLLECTION("];

/// Returns the text with a single change.
pub(super) fn changed(text: &str, other: &str, rng: &mut Rng) -> String {
    match rng.below(14) {
        0..=2 => replaced(text, |word| word.starts_with(|c: char| c.is_ascii_digit() || c == '-'), rng, &NUMBERS),
        3 => replaced(text, |_| true, rng, &NUMBERS),
        4 => replaced(text, |_| true, rng, &VALUES),
        5 => with_other_value(text, rng),
        6 | 7 => with_swapped_words(text, rng),
        8 => with_word_of(text, other, rng),
        9 => by_lines(text, other, rng, |lines, _, rng| {
            lines.remove(rng.below(lines.len()));
        }),
        10 => by_lines(text, other, rng, |lines, _, rng| {
            let line = lines[rng.below(lines.len())];
            let many = [1, 1, 1, 2, 50, 2000][rng.below(6)].min(LARGEST / line.len());
            let at = rng.below(lines.len() + 1);
            drop(lines.splice(at..at, std::iter::repeat_n(line, many)));
        }),
        11 => by_lines(text, other, rng, |lines, _, rng| {
            let (a, b) = (rng.below(lines.len()), rng.below(lines.len()));
            lines.swap(a, b);
        }),
        12 => by_lines(text, other, rng, |lines, other, rng| {
            let (at, from) = (rng.below(lines.len() + 1), rng.below(other.len()));
            lines.truncate(at);
            lines.extend_from_slice(&other[from..]);
        }),
        _ => nested(text, rng),
    }
}

/// Returns the words of a text: names and numbers.
fn words(text: &str) -> Vec<Range<usize>> {
    let is_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '+' | '-');
    let mut words = Vec::new();
    let mut start = None;
    for (at, c) in text.char_indices().chain([(text.len(), ' ')]) {
        match (start, is_word(c)) {
            (None, true) => start = Some(at),
            (Some(from), false) => {
                words.push(from..at);
                start = None;
            }
            _ => {}
        }
    }
    words
}

/// Replaces a word that `fits` by an entry of a list.
fn replaced(text: &str, fits: impl Fn(&str) -> bool, rng: &mut Rng, list: &[&str]) -> String {
    let words: Vec<_> = words(text).into_iter().filter(|word| fits(&text[word.clone()])).collect();
    let mut out = text.to_owned();
    if !words.is_empty() {
        out.replace_range(rng.pick(&words).clone(), list[rng.below(list.len())]);
    }
    out
}

/// Replaces the value after an `=` or `:`, up to the end of the line, by a value of another type or by that of another
/// line.
fn with_other_value(text: &str, rng: &mut Rng) -> String {
    let mut values: Vec<Range<usize>> = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let end = start + line.trim_end_matches('\n').len();
        let signs = line.char_indices().filter(|(_, c)| matches!(c, '=' | ':'));
        values.extend(signs.map(|(at, _)| start + at + 1..end));
        start += line.len();
    }
    if values.is_empty() {
        return replaced(text, |_| true, rng, &VALUES);
    }
    let value = rng.pick(&values).clone();
    let new =
        if rng.below(2) == 0 { (*rng.pick(&VALUES)).to_owned() } else { text[rng.pick(&values).clone()].to_owned() };
    let mut out = text.to_owned();
    out.replace_range(value, &format!(" {new}"));
    out
}

/// Swaps two words.
fn with_swapped_words(text: &str, rng: &mut Rng) -> String {
    let words = words(text);
    if words.len() < 2 {
        return text.to_owned();
    }
    let (a, b) = (rng.pick(&words).clone(), rng.pick(&words).clone());
    let (a, b) = if a.start <= b.start { (a, b) } else { (b, a) };
    if a == b {
        return text.to_owned();
    }
    [&text[..a.start], &text[b.clone()], &text[a.end..b.start], &text[a.clone()], &text[b.end..]].concat()
}

/// Replaces a word by a word of another text.
fn with_word_of(text: &str, other: &str, rng: &mut Rng) -> String {
    let others: Vec<&str> = words(other).into_iter().map(|word| &other[word]).collect();
    if others.is_empty() { text.to_owned() } else { replaced(text, |_| true, rng, &others) }
}

/// Changes the lines of a text, of which there is at least one.
fn by_lines<'t>(
    text: &'t str,
    other: &'t str,
    rng: &mut Rng,
    change: impl FnOnce(&mut Vec<&'t str>, &[&'t str], &mut Rng),
) -> String {
    let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
    let others: Vec<&str> = other.split_inclusive('\n').collect();
    if lines.is_empty() || others.is_empty() {
        return text.to_owned();
    }
    change(&mut lines, &others, rng);
    lines.concat()
}

/// Repeats a bracket many times at a place; half of the time it closes all of them again.
fn nested(text: &str, rng: &mut Rng) -> String {
    let words = words(text);
    let at = if words.is_empty() { 0 } else { rng.pick(&words).start };
    let (open, many) = (rng.pick(&BRACKETS), *rng.pick(&[1, 10, 100, 5000]));
    let closing = |c: char| match c {
        '[' => Some("]"),
        '{' => Some("}"),
        '(' => Some(")"),
        '<' => Some("</g>"),
        _ => None,
    };
    let close: String =
        if rng.below(2) == 0 { open.chars().rev().filter_map(closing).collect() } else { String::new() };
    [&text[..at], &open.repeat(many), "1", &close.repeat(many), &text[at..]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_names_and_numbers() {
        let text = "a_b = [-1.5e+3, é]";
        assert_eq!(words(text).into_iter().map(|word| &text[word]).collect::<Vec<_>>(), ["a_b", "-1.5e+3", "é"]);
    }

    #[test]
    fn every_change_takes_every_text() {
        for text in ["", "\n", "é", "a = 1\nb: [2, 3]\n", "1"] {
            for k in 0..2000 {
                let _ = changed(text, "x = 5\n", &mut Rng::of(1, text, k));
                let _ = changed("x = 5\n", text, &mut Rng::of(2, text, k));
            }
        }
    }
}
