//! Processor time of this thread and of this program, which does not include other programs on the machine.

use std::time::Duration;

/// Returns the processor time of this thread so far.
#[cfg(unix)]
pub fn thread_time() -> Duration {
    time(rustix::time::ClockId::ThreadCPUTime)
}

/// Returns the processor time of this program so far, all threads; `None` if the system does not report it.
#[cfg(unix)]
pub fn process_time() -> Option<Duration> {
    Some(time(rustix::time::ClockId::ProcessCPUTime))
}

#[cfg(unix)]
fn time(clock: rustix::time::ClockId) -> Duration {
    let now = rustix::time::clock_gettime(clock);
    Duration::new(u64::try_from(now.tv_sec).unwrap_or(0), u32::try_from(now.tv_nsec).unwrap_or(0))
}

/// Returns wall-clock time: processor time is not measured on this system.
#[cfg(not(unix))]
pub fn thread_time() -> Duration {
    use std::sync::LazyLock;
    use std::time::Instant;
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

/// Returns the processor time of this program so far, all threads; `None` if the system does not report it.
#[cfg(not(unix))]
pub fn process_time() -> Option<Duration> {
    None
}
