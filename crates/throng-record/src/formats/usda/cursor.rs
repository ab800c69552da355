//! Goes through the text of a layer: words, brackets and what stands in quotes.

/// What is wrong, and at which byte.
pub type Wrong = (usize, String);

/// A part of the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part<'a> {
    /// At which byte it begins.
    pub at: usize,
    pub text: &'a str,
}

/// A place in the text.
pub struct Cursor<'a> {
    pub text: &'a str,
    pub at: usize,
}

impl<'a> Cursor<'a> {
    /// The byte that is here; `None` at the end.
    pub fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// Goes past a byte, if it is here.
    pub fn takes(&mut self, byte: u8) -> bool {
        let is = self.peek() == Some(byte);
        self.at += usize::from(is);
        is
    }

    /// What is wrong here; at the end, that something is missing.
    pub fn wrong(&self, why: &str) -> Wrong {
        if self.at >= self.text.len() {
            (self.at, "it is cut: a part is missing".to_owned())
        } else {
            (self.at, why.to_owned())
        }
    }

    /// Goes past blanks and a byte that has to be here.
    pub fn expect(&mut self, byte: u8) -> Result<(), Wrong> {
        self.blanks();
        if self.takes(byte) { Ok(()) } else { Err(self.wrong(&format!("`{}` is missing", char::from(byte)))) }
    }

    /// Goes past blanks of a line.
    pub fn spaces(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t')) {
            self.at += 1;
        }
    }

    /// Goes past blanks, line ends, what stands between statements, and comments.
    pub fn blanks(&mut self) {
        while let Some(byte) = self.peek() {
            match byte {
                b' ' | b'\t' | b'\r' | b'\n' | b';' => self.at += 1,
                b'#' => self.line(),
                _ => return,
            }
        }
    }

    /// Goes to the end of the line.
    pub fn line(&mut self) {
        let rest = &self.text.as_bytes()[self.at..];
        self.at += rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
    }

    /// A word; empty if none is here. Words have brackets, as types of lists do.
    pub fn word(&mut self) -> &'a str {
        let from = self.at;
        while self.peek().is_some_and(|byte| byte.is_ascii_alphanumeric() || b"_:.[]+-".contains(&byte) || byte > 127) {
            self.at += 1;
        }
        &self.text[from..self.at]
    }

    /// A value, as it is written.
    pub fn value(&mut self) -> Result<Part<'a>, Wrong> {
        let at = self.at;
        match self.peek() {
            Some(b'[' | b'(' | b'{') => self.nested()?,
            Some(b'"' | b'\'') => self.string()?,
            Some(quote @ (b'<' | b'@')) => self.quoted(quote)?,
            _ if self.word().is_empty() => return Err(self.wrong("a value is missing")),
            _ => {}
        }
        Ok(Part { at, text: &self.text[at..self.at] })
    }

    /// Goes past a bracket, up to the one that closes it.
    pub fn nested(&mut self) -> Result<(), Wrong> {
        let mut open = Vec::new();
        while let Some(byte) = self.peek() {
            match byte {
                b'[' => open.push(b']'),
                b'(' => open.push(b')'),
                b'{' => open.push(b'}'),
                b']' | b')' | b'}' if open.pop() != Some(byte) => {
                    return Err(self.wrong("a bracket closes what is not open"));
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

    /// Goes past a path or the name of a file.
    pub fn quoted(&mut self, open: u8) -> Result<(), Wrong> {
        let close = if open == b'<' { b'>' } else { b'@' };
        let rest = &self.text.as_bytes()[self.at + 1..];
        let length = rest.iter().position(|&byte| byte == close);
        self.at += 2 + length.ok_or_else(|| Cursor { at: self.text.len(), ..*self }.wrong(""))?;
        Ok(())
    }

    /// Goes past a text in one or three quotes.
    pub fn string(&mut self) -> Result<(), Wrong> {
        let bytes = self.text.as_bytes();
        let quote = bytes[self.at];
        let quotes = if bytes[self.at..].starts_with(&[quote; 3]) { 3 } else { 1 };
        self.at += quotes;
        while let Some(byte) = self.peek() {
            match byte {
                b'\\' => self.at = (self.at + 2).min(bytes.len()),
                b'\n' if quotes == 1 => return Err(self.wrong("a text ends with its line")),
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
