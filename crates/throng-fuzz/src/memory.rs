//! Limits and measures the memory of the process.

use cap::Cap;
use std::alloc::System;

/// Measures the heap, and refuses allocations beyond its limit.
#[global_allocator]
static HEAP: Cap<System> = Cap::new(System, usize::MAX);

/// Address space beyond the limit of the heap: code, stacks, and allocations of C libraries.
#[cfg(unix)]
const BESIDE: u64 = 1 << 30;

/// Limits the heap to `bytes`, and on Unix the address space to a gigabyte more. An allocation beyond the limit ends
/// the process.
///
/// # Errors
/// The process already uses more, or the system refuses the limit.
pub fn limit(bytes: u64) -> Result<(), String> {
    let heap = usize::try_from(bytes).unwrap_or(usize::MAX);
    HEAP.set_limit(heap).map_err(|()| format!("{} bytes are allocated already", HEAP.allocated()))?;
    #[cfg(unix)]
    {
        use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
        let Rlimit { maximum, .. } = getrlimit(Resource::As);
        let wanted = bytes.saturating_add(BESIDE);
        let current = Some(maximum.map_or(wanted, |most| most.min(wanted)));
        setrlimit(Resource::As, Rlimit { current, maximum })
            .map_err(|error| format!("the address space cannot be limited: {error}"))?;
    }
    Ok(())
}

/// Returns the peak memory of the process so far, bytes: the larger of heap and resident memory, if the system reports
/// the latter.
pub fn peak() -> u64 {
    (HEAP.max_allocated() as u64).max(resident().unwrap_or(0))
}

/// Returns the peak resident memory so far, as Linux reports it.
fn resident() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kilobytes << 10)
}
