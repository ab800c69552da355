//! Results that are kept as hashes, so that every accidental change of a result is noticed.

use std::collections::BTreeSet;
use std::fmt::{Debug, Write};
use std::path::Path;

/// Named results. Each is hashed as the values in its debug format, which determine all bits of numbers except those of NaN.
#[derive(Default)]
pub struct Results(Vec<(String, u64)>);

impl Results {
    /// Adds a result. Results of one name are hashed together. Names of types and fields, and texts, do not count: a renamed
    /// type gives the same hash.
    pub fn add(&mut self, name: &str, result: &impl Debug) {
        if self.0.last().is_none_or(|(last, _)| last != name) {
            self.0.push((name.to_owned(), 0xcbf2_9ce4_8422_2325));
        }
        let (_, hash) = self.0.last_mut().unwrap();
        // FNV-1a
        *hash = values(&format!("{result:?}\n"))
            .bytes()
            .fold(*hash, |h, byte| (h ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    }

    /// Compares the results with the hashes in a file of this folder's parent, such as `all/avoid/kept.txt`.
    ///
    /// The hashes are the same on every machine and in every build: the inputs are computed without the sine of a C
    /// library. A change that keeps results must not change the file. For an intended change of results, `UPDATE=1`
    /// writes the file anew; the changelog mentions it.
    pub fn assert_kept(&self, file: &str) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(file);
        let mut found = String::new();
        for (name, hash) in &self.0 {
            writeln!(found, "{hash:016x} {name}").unwrap();
        }
        let names: BTreeSet<&str> = self.0.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names.len(), self.0.len(), "a name is used for two results");
        if std::env::var_os("UPDATE").is_some() {
            std::fs::write(&path, &found).unwrap();
        }
        let kept = std::fs::read_to_string(&path).unwrap_or_default().replace('\r', "");
        let [old, new]: [BTreeSet<&str>; 2] = [&kept, &found].map(|text| text.lines().collect());
        let differ: Vec<_> = new.difference(&old).chain(old.difference(&new)).collect();
        assert!(differ.is_empty(), "results differ from those of {file} (UPDATE=1 writes it anew): {differ:#?}");
    }
}

/// What of a debug text is a value: numbers, variants without fields, and the structure around them.
fn values(text: &str) -> String {
    let mut values = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        let end = match first {
            '"' => {
                let bytes = rest.as_bytes();
                let mut at = 1;
                while bytes[at] != b'"' {
                    at += if bytes[at] == b'\\' { 2 } else { 1 };
                }
                at + 1
            }
            _ if word > 0 => word,
            _ => first.len_utf8(),
        };
        let (token, after) = rest.split_at(end);
        let is_name = first.is_alphabetic() || first == '_';
        let names_fields = after.starts_with(" {") || after.starts_with('(') || after.starts_with(':');
        let is_option = matches!(token, "Some" | "Ok" | "Err");
        if first != '"' && (!is_name || is_option || !names_fields) {
            values.push_str(token);
        }
        rest = after;
    }
    values
}
