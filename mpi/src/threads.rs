//! The threads of a rank.

use crate::args::RunArgs;
use crate::failure::Failure;
use crate::ranks::Ranks;
use std::fs;

/// Starts the threads of a rank: as many as asked for, or its share of the cores of the machine.
///
/// # Errors
/// The system refuses threads.
pub fn start(args: &RunArgs, ranks: &Ranks) -> Result<(), Failure> {
    // cores that the process is not bound away from
    let free = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let share = (of_machine().unwrap_or(free) / ranks.on_this_machine()).max(1);
    let wanted = args.threads.unwrap_or(share);
    let threads = args.threads.unwrap_or(share.min(free));
    if wanted > free && ranks.is_first() && !args.quiet {
        eprintln!(
            "warning: rank 0 is bound to {free} of {wanted} cores\n  hint: mpirun binds ranks to cores; for threads start it \
             with --bind-to none, or --map-by numa --bind-to numa"
        );
    }
    // this thread is one of them, because MPI is called from the main thread
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).use_current_thread().build_global();
    pool.map_err(|error| Failure::Here(format!("cannot start {threads} threads: {error}")))
}

/// Returns the number of cores of the machine, if the system tells. Linux does.
fn of_machine() -> Option<usize> {
    count(fs::read_to_string("/sys/devices/system/cpu/online").ok()?.trim())
}

/// Returns the count of a list of numbers and ranges, such as `0-3,8`.
fn count(list: &str) -> Option<usize> {
    let size = |range: &str| {
        let (first, last) = range.split_once('-').unwrap_or((range, range));
        Some(1 + last.parse::<usize>().ok()?.checked_sub(first.parse().ok()?)?)
    };
    list.split(',').map(size).sum()
}

#[cfg(test)]
mod tests {
    use super::count;

    #[test]
    fn cores_are_counted() {
        assert_eq!(["0", "0-31", "0-3,8,10-11"].map(count), [Some(1), Some(32), Some(7)]);
        assert_eq!(["", "3-1", "a"].map(count), [None; 3]);
    }
}
