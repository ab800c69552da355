//! Scans the text of a layer: words, brackets and quoted texts.

/// The byte of an error and its message.
pub type UsdaFlaw = (usize, String);

/// A part of the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextPart<'a> {
    /// Offset of its first byte.
    pub at: usize,
    pub text: &'a str,
}

/// A position in the text.
pub struct Cursor<'a> {
    pub text: &'a str,
    pub at: usize,
}

impl<'a> Cursor<'a> {
    /// Returns the byte at the cursor; `None` at the end.
    pub fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// Skips a byte if it is at the cursor. Returns whether it was.
    pub fn takes(&mut self, byte: u8) -> bool {
        let is = self.peek() == Some(byte);
        self.at += usize::from(is);
        is
    }

    /// Returns an error at the cursor; at the end, the error is that the file is cut off.
    pub fn wrong(&self, why: &str) -> UsdaFlaw {
        if self.at >= self.text.len() {
            (self.at, "the file is cut off: a part is missing".to_owned())
        } else {
            (self.at, why.to_owned())
        }
    }

    /// Skips blanks and a required byte.
    pub fn expect(&mut self, byte: u8) -> Result<(), UsdaFlaw> {
        self.blanks();
        if self.takes(byte) { Ok(()) } else { Err(self.wrong(&format!("`{}` is missing", char::from(byte)))) }
    }

    /// Skips the blanks of a line.
    pub fn spaces(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t')) {
            self.at += 1;
        }
    }

    /// Skips blanks, line ends, separators of statements, and comments.
    pub fn blanks(&mut self) {
        while let Some(byte) = self.peek() {
            match byte {
                b' ' | b'\t' | b'\r' | b'\n' | b';' => self.at += 1,
                b'#' => self.line(),
                _ => return,
            }
        }
    }

    /// Skips to the end of the line.
    pub fn line(&mut self) {
        let rest = &self.text.as_bytes()[self.at..];
        self.at += rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
    }

    /// Reads a word; empty if there is none. Words include brackets, as in the types of lists.
    pub fn word(&mut self) -> &'a str {
        let from = self.at;
        while self.peek().is_some_and(|byte| byte.is_ascii_alphanumeric() || b"_:.[]+-".contains(&byte) || byte > 127) {
            self.at += 1;
        }
        &self.text[from..self.at]
    }

    /// Returns a value as it is written.
    pub fn value(&mut self) -> Result<TextPart<'a>, UsdaFlaw> {
        let at = self.at;
        match self.peek() {
            Some(b'[' | b'(' | b'{') => self.nested()?,
            Some(b'"' | b'\'') => self.string()?,
            Some(quote @ (b'<' | b'@')) => self.quoted(quote)?,
            _ if self.word().is_empty() => return Err(self.wrong("a value is missing")),
            _ => {}
        }
        Ok(TextPart { at, text: &self.text[at..self.at] })
    }

    /// Skips a bracket up to the matching bracket.
    pub fn nested(&mut self) -> Result<(), UsdaFlaw> {
        let mut open = Vec::new();
        while let Some(byte) = self.peek() {
            match byte {
                b'[' => open.push(b']'),
                b'(' => open.push(b')'),
                b'{' => open.push(b'}'),
                b']' | b')' | b'}' if open.pop() != Some(byte) => {
                    return Err(self.wrong("a bracket closes none that is open"));
                }
                b'"' | b'\'' => {
                    self.string()?;
                    continue;
                }
                b'<' | b'@' => {
                    self.quoted(byte)?;
                    continue;
                }
                b'#' => {
                    self.line();
                    continue;
                }
                _ => {}
            }
            self.at += 1;
            if open.is_empty() {
                return Ok(());
            }
        }
        Err(self.wrong(""))
    }

    /// Skips a path or the name of a file.
    pub fn quoted(&mut self, open: u8) -> Result<(), UsdaFlaw> {
        let close = if open == b'<' { b'>' } else { b'@' };
        let rest = &self.text.as_bytes()[self.at + 1..];
        let length = rest.iter().position(|&byte| byte == close);
        self.at += 2 + length.ok_or_else(|| Cursor { at: self.text.len(), ..*self }.wrong(""))?;
        Ok(())
    }

    /// Skips a text in one or three quotes.
    pub fn string(&mut self) -> Result<(), UsdaFlaw> {
        let bytes = self.text.as_bytes();
        let quote = bytes[self.at];
        let quotes = if bytes[self.at..].starts_with(&[quote; 3]) { 3 } else { 1 };
        self.at += quotes;
        while let Some(byte) = self.peek() {
            match byte {
                b'\\' => self.at = (self.at + 2).min(bytes.len()),
                b'\n' if quotes == 1 => return Err(self.wrong("a text is not closed on its line")),
                _ if bytes[self.at..].starts_with(&[quote; 3][..quotes]) => {
                    self.at += quotes;
                    return Ok(());
                }
                _ => self.at += 1,
            }
        }
        Err(self.wrong(""))
    }
}
