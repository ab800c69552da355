//! Parses the values of attributes.

use super::cursor::{TextPart, UsdaFlaw};
use crate::formats::text;

impl TextPart<'_> {
    fn wrong(&self, why: String) -> UsdaFlaw {
        (self.at, why)
    }

    /// Returns the numbers of the value, in order, ignoring brackets: a multiple of `each` numbers.
    ///
    /// # Errors
    /// The count is not a multiple of `each`, or a field is not a finite number.
    pub fn numbers(&self, each: usize) -> Result<Vec<f64>, UsdaFlaw> {
        let fields = self.text.split(|c: char| "[](), \t\r\n".contains(c)).filter(|field| !field.is_empty());
        // a number outside the range of `f32` is not a valid coordinate
        let number = |field: &str| field.parse().ok().filter(|value: &f64| (*value as f32).is_finite());
        let numbers = fields.map(|field| {
            let at = self.at + (field.as_ptr() as usize - self.text.as_ptr() as usize);
            number(field).ok_or_else(|| (at, format!("`{}` is no number", field.chars().take(40).collect::<String>())))
        });
        let numbers = numbers.collect::<Result<Vec<f64>, UsdaFlaw>>()?;
        match numbers.len() % each {
            0 => Ok(numbers),
            _ => Err(self.wrong(format!("{} numbers do not make groups of {each}", numbers.len()))),
        }
    }

    /// Returns the only number of the value.
    ///
    /// # Errors
    /// The value is not a single number.
    pub fn number(&self) -> Result<f64, UsdaFlaw> {
        match self.numbers(1)?[..] {
            [number] => Ok(number),
            _ => Err(self.wrong("the value is not one number".to_owned())),
        }
    }

    /// Returns whole numbers, such as agent numbers.
    ///
    /// # Errors
    /// A number is negative, too large or not whole.
    pub fn whole(&self) -> Result<Vec<u32>, UsdaFlaw> {
        let whole =
            |value: f64| text::person(value).ok_or_else(|| self.wrong(format!("{value} is not a whole number from 0")));
        self.numbers(1)?.into_iter().map(whole).collect()
    }

    /// Returns the texts of the value, in order.
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

/// Returns the text before a quote, unescaped, and the rest after it.
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
        let part = |text| TextPart { at: 10, text };
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
