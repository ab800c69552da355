//! What values of attributes say.

use super::cursor::{Part, Wrong};
use crate::formats::text;

impl Part<'_> {
    fn wrong(&self, why: String) -> Wrong {
        (self.at, why)
    }

    /// The numbers in it, in order, whatever tuples they are in: `each` of them belong together.
    ///
    /// # Errors
    /// There are others, or something that is no finite number.
    pub fn numbers(&self, each: usize) -> Result<Vec<f64>, Wrong> {
        let fields = self.text.split(|c: char| "[](), \t\r\n".contains(c)).filter(|field| !field.is_empty());
        // what is no single is no place either
        let number = |field: &str| field.parse().ok().filter(|value: &f64| (*value as f32).is_finite());
        let numbers = fields.map(|field| {
            let at = self.at + (field.as_ptr() as usize - self.text.as_ptr() as usize);
            number(field).ok_or_else(|| (at, format!("`{}` is no number", field.chars().take(40).collect::<String>())))
        });
        let numbers = numbers.collect::<Result<Vec<f64>, Wrong>>()?;
        match numbers.len() % each {
            0 => Ok(numbers),
            _ => Err(self.wrong(format!("{} numbers do not make groups of {each}", numbers.len()))),
        }
    }

    /// The one number that it is.
    ///
    /// # Errors
    /// It is none.
    pub fn number(&self) -> Result<f64, Wrong> {
        match self.numbers(1)?[..] {
            [number] => Ok(number),
            _ => Err(self.wrong("it is not one number".to_owned())),
        }
    }

    /// Whole numbers of agents and the like.
    ///
    /// # Errors
    /// They are others.
    pub fn whole(&self) -> Result<Vec<u32>, Wrong> {
        let whole =
            |value: f64| text::person(value).ok_or_else(|| self.wrong(format!("{value} is no whole number from 0")));
        self.numbers(1)?.into_iter().map(whole).collect()
    }

    /// The texts in it, in order.
    pub fn texts(&self) -> Vec<String> {
        let (mut texts, mut rest) = (Vec::new(), self.text);
        while let Some(from) = rest.find(['"', '\'']) {
            rest = &rest[from..];
            let quote = if rest.starts_with("\"\"\"") || rest.starts_with("'''") { &rest[..3] } else { &rest[..1] };
            let (text, behind) = unquoted(&rest[quote.len()..], quote);
            texts.push(text);
            rest = behind;
        }
        texts
    }
}

/// What stands before a quote, and what behind it.
fn unquoted<'a>(text: &'a str, quote: &str) -> (String, &'a str) {
    let (mut out, mut rest) = (String::new(), text);
    while let Some(letter) = rest.chars().next() {
        if let Some(behind) = rest.strip_prefix(quote) {
            return (out, behind);
        }
        rest = &rest[letter.len_utf8()..];
        if letter != '\\' {
            out.push(letter);
            continue;
        }
        let Some(escaped) = rest.chars().next() else { break };
        rest = &rest[escaped.len_utf8()..];
        out.push(match escaped {
            'n' => '\n',
            'r' => '\r',
            't' => '\t',
            other => other,
        });
    }
    (out, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_numbers_and_texts() {
        let part = |text| Part { at: 10, text };
        assert_eq!(part("[(1, -2.5, 3e2), (0,0,0)]").numbers(3).unwrap(), [1.0, -2.5, 300.0, 0.0, 0.0, 0.0]);
        assert_eq!(part("[(1, x)]").numbers(2).unwrap_err(), (15, "`x` is no number".to_owned()));
        assert!(
            part("[1, 2, 3]").numbers(2).is_err() && part("[-1]").whole().is_err() && part("[1, 2]").number().is_err()
        );
        assert_eq!(part("[]").whole().unwrap(), Vec::<u32>::new());
        assert_eq!(
            part(
                r#"["a\"b", 'c', "", """d "e"
f""", "\\\n"]"#
            )
            .texts(),
            ["a\"b", "c", "", "d \"e\"\nf", "\\\n"]
        );
    }
}
