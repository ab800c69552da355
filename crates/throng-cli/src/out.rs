//! Standard output and standard error.

use crate::failure::Failure;
use std::borrow::Cow;
use std::fmt::Arguments;
use std::io::{self, BufWriter, ErrorKind, Stdout, Write};

/// Standard output. A closed pipe (`throng list | head -1`) ends the command without a message.
pub struct Out {
    stdout: BufWriter<Stdout>,
}

impl Out {
    /// Creates a buffered writer to standard output.
    pub fn new() -> Self {
        Self { stdout: BufWriter::new(io::stdout()) }
    }

    /// Writes a line. Used as `out.line(format_args!(...))`.
    ///
    /// # Errors
    /// The reader has closed the pipe, or standard output cannot be written.
    pub fn line(&mut self, text: Arguments) -> Result<(), Failure> {
        self.text(format!("{text}\n").as_bytes())
    }

    /// Writes text and escapes its control characters.
    ///
    /// # Errors
    /// Those of [`line`](Self::line).
    pub fn text(&mut self, text: &[u8]) -> Result<(), Failure> {
        let text = String::from_utf8_lossy(text);
        self.stdout.write_all(escaped(&text).as_bytes()).map_err(|error| failure(&error))
    }

    /// Flushes the buffer.
    ///
    /// # Errors
    /// Those of [`line`](Self::line).
    pub fn flush(&mut self) -> Result<(), Failure> {
        self.stdout.flush().map_err(|error| failure(&error))
    }
}

fn failure(error: &io::Error) -> Failure {
    match error.kind() {
        ErrorKind::BrokenPipe => Failure::ClosedPipe,
        ErrorKind::StorageFull => Failure::Error("cannot write to standard output: the disk is full".into()),
        _ => Failure::Error(format!("cannot write to standard output: {error}")),
    }
}

/// Writes a line to standard error and escapes its control characters. Ignores failures.
pub fn complain(text: &str) {
    let _ = writeln!(io::stderr(), "{}", escaped(text));
}

/// Escapes text for a terminal: characters that control the terminal or the direction of the text become `\u001b`,
/// which JSON reads as the same character. Newlines and tabs stay.
pub fn escaped(text: &str) -> Cow<'_, str> {
    if !text.contains(controls) {
        return text.into();
    }
    let escape = |c: char| if controls(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() };
    text.chars().map(escape).collect::<String>().into()
}

/// Whether a character is a control character other than newline and tab, or overrides the direction of the text.
fn controls(c: char) -> bool {
    c.is_control() && !matches!(c, '\n' | '\t') || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Writes notes to standard error, such as on parts of a file that were left out or changed.
pub fn note<'n>(notes: impl IntoIterator<Item = &'n String>) {
    notes.into_iter().for_each(|note| complain(&format!("note: {note}")));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_escaped_and_json_stays_the_same() {
        let title = "a\u{0}\u{1b}[31m\r\u{7f}\u{9b}1m\u{202e}\u{2066}\t\n größe";
        let shown = escaped(title);
        assert_eq!(shown, "a\\u0000\\u001b[31m\\u000d\\u007f\\u009b1m\\u202e\\u2066\t\n größe");
        assert!(!shown.contains(controls));
        let json = serde_json::json!({ "title": title });
        let read: serde_json::Value = serde_json::from_str(&escaped(&json.to_string())).unwrap();
        assert_eq!(read, json);
        assert!(matches!(escaped("plain\n\ttext"), Cow::Borrowed(_)));
    }
}
