//! Who belongs together, as data sets say it: a group a line, the numbers of its members between blanks.

use crate::formats::Flaw;

const HINT: &str = "such a file has a line a group, the numbers of its members between blanks";

/// The groups of a file such as UCY's `groups.txt`, as OpenTraj has it. The first line may say how many there are instead. Somebody may
/// be in several: the groups of students03 are such.
///
/// ```
/// let groups = throng_record::pedestrian::groups(b"2\n6 18 421\n7 8\n")?;
/// assert_eq!(groups, [vec![6, 18, 421], vec![7, 8]]);
/// # Ok::<(), throng_record::Flaw>(())
/// ```
///
/// # Errors
/// With its line: what is no number of a person.
pub fn groups(bytes: &[u8]) -> Result<Vec<Vec<u32>>, Flaw> {
    let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    let lines = text.lines().zip(1..).map(|(line, at)| (at, line.split('#').next().unwrap_or_default()));
    let mut said: Vec<Vec<u32>> = Vec::new();
    for (line, members) in lines {
        let member = |word: &str| {
            let why = || format!("`{word}` is no number of a person");
            word.parse().map_err(|_| Flaw { line: Some(line), why: why(), hint: Some(HINT) })
        };
        let members: Vec<u32> =
            members.split([' ', '\t', ',']).filter(|word| !word.is_empty()).map(member).collect::<Result<_, _>>()?;
        if !members.is_empty() {
            said.push(members);
        }
    }
    let others = said.len().saturating_sub(1);
    if said.first().is_some_and(|first| first[..] == [others as u32]) {
        said.remove(0);
    }
    Ok(said)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_first_line_may_count_the_others() {
        let read = |text: &str| groups(text.as_bytes()).unwrap();
        assert_eq!(read("1 2\r\n\n3\t4 5 # friends\n"), [vec![1, 2], vec![3, 4, 5]]);
        assert_eq!(read("3\n4 5\n"), [vec![3], vec![4, 5]], "one alone");
        assert_eq!((read("1\n4 5\n"), read(""), read("0\n")), (vec![vec![4, 5]], vec![], vec![]));
    }

    #[test]
    fn mistakes_have_lines() {
        let wrong = |text: &str| groups(text.as_bytes()).unwrap_err();
        assert_eq!((wrong("1 2\n\n3 x\n").line, wrong("1 2\n-3\n").line), (Some(3), Some(2)));
        assert!(wrong("1 2 4294967296\n").hint.unwrap().contains("a line a group"));
        assert_eq!(groups(b"1 2\n2 3\n").unwrap(), [vec![1, 2], vec![2, 3]]);
    }
}
