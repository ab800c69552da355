//! Social groups, as data sets list them: a line per group, the numbers of its members separated by blanks.

use crate::formats::FormatFlaw;

const HINT: &str = "such a file has a line per group: the numbers of its members, separated by blanks";

/// Reads a file such as UCY's `groups.txt`, as distributed by OpenTraj. The first line may be the number of groups
/// instead. An agent may be in several groups, as in students03.
///
/// ```
/// let groups = throng_record::pedestrian::groups(b"2\n6 18 421\n7 8\n")?;
/// assert_eq!(groups, [vec![6, 18, 421], vec![7, 8]]);
/// # Ok::<(), throng_record::FormatFlaw>(())
/// ```
///
/// # Errors
/// A member is not an agent number; the error has the line.
pub fn groups(bytes: &[u8]) -> Result<Vec<Vec<u32>>, FormatFlaw> {
    let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    let lines = text.lines().zip(1..).map(|(line, at)| (at, line.split('#').next().unwrap_or_default()));
    let mut groups: Vec<Vec<u32>> = Vec::new();
    for (line, members) in lines {
        let member = |word: &str| {
            let why = || format!("`{word}` is not an agent number");
            word.parse().map_err(|_| FormatFlaw { line: Some(line), why: why(), hint: Some(HINT) })
        };
        let members: Vec<u32> =
            members.split([' ', '\t', ',']).filter(|word| !word.is_empty()).map(member).collect::<Result<_, _>>()?;
        if !members.is_empty() {
            groups.push(members);
        }
    }
    let others = groups.len().saturating_sub(1);
    if groups.first().is_some_and(|first| first[..] == [others as u32]) {
        groups.remove(0);
    }
    Ok(groups)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_first_line_may_count_the_others() {
        let read = |text: &str| groups(text.as_bytes()).unwrap();
        assert_eq!(read("1 2\r\n\n3\t4 5 # friends\n"), [vec![1, 2], vec![3, 4, 5]]);
        assert_eq!(read("3\n4 5\n"), [vec![3], vec![4, 5]], "a group of a single agent");
        assert_eq!((read("1\n4 5\n"), read(""), read("0\n")), (vec![vec![4, 5]], vec![], vec![]));
    }

    #[test]
    fn mistakes_have_lines() {
        let wrong = |text: &str| groups(text.as_bytes()).unwrap_err();
        assert_eq!((wrong("1 2\n\n3 x\n").line, wrong("1 2\n-3\n").line), (Some(3), Some(2)));
        assert!(wrong("1 2 4294967296\n").hint.unwrap().contains("a line per group"));
        assert_eq!(groups(b"1 2\n2 3\n").unwrap(), [vec![1, 2], vec![2, 3]]);
    }
}
