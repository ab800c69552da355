//! The parts of a TOML text, for its colours. A text that is no TOML has parts too.

use std::ops::Range;

/// The kind of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Token {
    /// A comment.
    Comment,
    /// The head of a table, with its brackets.
    Table,
    /// A key, dotted or not.
    Key,
    /// A string.
    String,
    /// A number, a date, or a boolean.
    Number,
    /// Anything else: spaces and punctuation.
    Other,
}

/// Returns the parts of a text in their order. Together they are the text.
pub fn tokens(text: &str) -> Vec<(Range<usize>, Token)> {
    let mut found: Vec<(Range<usize>, Token)> = Vec::new();
    // open brackets and braces of values
    let (mut at, mut depth, mut fresh) = (0, 0_usize, true);
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let (length, token) = match first {
            '#' => (line(rest), Token::Comment),
            '[' if fresh && depth == 0 => (head(rest), Token::Table),
            '"' | '\'' => {
                let length = string(rest, first);
                (length, if is_key(&rest[length..]) { Token::Key } else { Token::String })
            }
            _ if is_word(first) => {
                let length = rest.find(|letter| !is_word(letter)).unwrap_or(rest.len());
                (length, word(&rest[..length], &rest[length..]))
            }
            _ => (first.len_utf8(), Token::Other),
        };
        match first {
            '[' | '{' if token == Token::Other => depth += 1,
            ']' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        fresh = first == '\n' || fresh && first.is_whitespace();
        match found.last_mut() {
            Some((range, Token::Other)) if token == Token::Other => range.end += length,
            _ => found.push((at..at + length, token)),
        }
        at += length;
    }
    found
}

fn line(rest: &str) -> usize {
    rest.find('\n').unwrap_or(rest.len())
}

/// Returns the length of the head of a table, up to its comment.
fn head(rest: &str) -> usize {
    let line = &rest[..line(rest)];
    line.find('#').map_or(line, |end| &line[..end]).trim_end().len()
}

/// Returns the length of a string with its quotes. A string that is not closed ends with its line, or with the text if it
/// has three quotes.
fn string(rest: &str, quote: char) -> usize {
    let three: String = std::iter::repeat_n(quote, 3).collect();
    let (close, end) = match rest.starts_with(&three) {
        true => (three.as_str(), rest.len()),
        false => (&three[..1], line(rest)),
    };
    let mut at = close.len();
    while at < end {
        if rest[at..].starts_with(close) {
            return at + close.len();
        }
        let next = rest[at..].chars().next().map_or(1, char::len_utf8);
        let escaped = quote == '"' && rest[at..].starts_with('\\');
        at += if escaped { next + rest[at + next..].chars().next().map_or(0, char::len_utf8) } else { next };
    }
    at.min(rest.len())
}

fn is_word(letter: char) -> bool {
    letter.is_alphanumeric() || "_-+.:".contains(letter)
}

/// Whether a key ends before `rest`.
fn is_key(rest: &str) -> bool {
    rest.trim_start_matches([' ', '\t']).starts_with(['=', '.'])
}

fn word(word: &str, rest: &str) -> Token {
    let digits = word.trim_start_matches(['+', '-']);
    match word {
        _ if is_key(rest) => Token::Key,
        "true" | "false" => Token::Number,
        _ if digits.starts_with(|first: char| first.is_ascii_digit()) || ["inf", "nan"].contains(&digits) => {
            Token::Number
        }
        _ => Token::Other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the parts of a kind.
    fn of(text: &str, kind: Token) -> Vec<&str> {
        tokens(text).into_iter().filter(|(_, token)| *token == kind).map(|(range, _)| &text[range]).collect()
    }

    #[test]
    fn a_scene_has_its_parts() {
        let text = "# über\ntitle = \"a # \\\" b\" # c\n[[group]] # d\nplace.ring = { radius = -7.5, to = [\n  [1, 2e3],\n] }\nguard = true\n'a b' = '''x\ny'''\n";
        assert_eq!(of(text, Token::Comment), ["# über", "# c", "# d"]);
        assert_eq!(of(text, Token::Table), ["[[group]]"]);
        assert_eq!(of(text, Token::Key), ["title", "place.ring", "radius", "to", "guard", "'a b'"]);
        assert_eq!(of(text, Token::String), ["\"a # \\\" b\"", "'''x\ny'''"]);
        assert_eq!(of(text, Token::Number), ["-7.5", "1", "2e3", "true"]);
    }

    /// Every prefix of a scene is a text that a user may type.
    #[test]
    fn the_parts_are_the_whole_text() {
        for name in ["circle", "boids-in-box", "soccer"] {
            let text = throng_scene::gallery::text(name).unwrap();
            for end in (0..=text.len()).filter(|end| text.is_char_boundary(*end)).step_by(7) {
                let found = tokens(&text[..end]);
                let whole: String = found.iter().map(|(range, _)| &text[range.clone()]).collect();
                assert_eq!(whole, text[..end]);
            }
        }
        for text in ["\"", "\"\\", "'''", "[", "a = \"é\\é", "\"\"\"\\"] {
            assert_eq!(tokens(text).last().map(|(range, _)| range.end), Some(text.len()), "{text}");
        }
    }
}
