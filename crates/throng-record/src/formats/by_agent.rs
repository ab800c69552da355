//! Regroups spilled frames by agent.

use super::spill::{ROW, Spill, SpilledAgent, SpilledState};
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};

/// Number of rows that are sorted in memory at a time (12 MiB); a single frame may have more.
const SORTED: usize = if cfg!(test) { 7 } else { 1 << 18 };

/// Calls `each` with every agent and its states by frame. A second copy of all rows lies in `file` meanwhile
/// ([`beside`](super::spill::beside)); memory holds the rows of one agent.
///
/// # Errors
/// A system error, or an error of `each`.
pub(super) fn by_agent(
    spill: &mut Spill,
    mut file: File,
    mut each: impl FnMut(&SpilledAgent, &[(u32, SpilledState)]) -> io::Result<()>,
) -> io::Result<()> {
    let mut counts = vec![0u64; spill.agents.len()];
    spill.replay(|_, _, rows| {
        rows.iter().for_each(|&(at, _)| counts[at as usize] += 1);
        Ok(())
    })?;
    let ends = counts.iter().scan(0, |end, count| {
        *end += count;
        Some(*end)
    });
    let mut next: Vec<u64> = ends.zip(&counts).map(|(end, count)| end - count).collect();
    let mut rows = Vec::new();
    spill.replay(|moment, _, there| {
        rows.extend(there.iter().map(|(at, state)| (*at, state.row(moment))));
        if rows.len() < SORTED { Ok(()) } else { settle(&mut file, &mut rows, &mut next) }
    })?;
    settle(&mut file, &mut rows, &mut next)?;
    file.rewind()?;
    let mut reader = BufReader::with_capacity(1 << 16, file);
    let (mut track, mut row) = (Vec::new(), [0; ROW]);
    for (agent, count) in spill.agents.iter().zip(counts) {
        track.clear();
        for _ in 0..count {
            reader.read_exact(&mut row)?;
            track.push(SpilledState::of_row(&row));
        }
        each(agent, &track)?;
    }
    Ok(())
}

/// Writes rows to their places; `next` is the place of the next row of each agent.
fn settle(file: &mut File, rows: &mut Vec<(u32, [u8; ROW])>, next: &mut [u64]) -> io::Result<()> {
    rows.sort_by_key(|&(at, _)| at);
    let mut bytes = Vec::new();
    for run in rows.chunk_by(|a, b| a.0 == b.0) {
        bytes.clear();
        run.iter().for_each(|(_, row)| bytes.extend_from_slice(row));
        let next = &mut next[run[0].0 as usize];
        file.seek(SeekFrom::Start(*next * ROW as u64))?;
        file.write_all(&bytes)?;
        *next += run.len() as u64;
    }
    rows.clear();
    Ok(())
}
