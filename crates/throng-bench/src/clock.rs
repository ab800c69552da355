//! How long this thread, and this program, have worked: what others do on the same machine does not count.

use std::time::Duration;

/// Processor time of this thread so far.
#[cfg(unix)]
pub fn thread_time() -> Duration {
    time(rustix::time::ClockId::ThreadCPUTime)
}

/// Processor time of this program so far, all threads; `None` where the system does not tell.
#[cfg(unix)]
pub fn process_time() -> Option<Duration> {
    Some(time(rustix::time::ClockId::ProcessCPUTime))
}

#[cfg(unix)]
fn time(clock: rustix::time::ClockId) -> Duration {
    let now = rustix::time::clock_gettime(clock);
    Duration::new(u64::try_from(now.tv_sec).unwrap_or(0), u32::try_from(now.tv_nsec).unwrap_or(0))
}

/// Time on the clock: processor time is not asked for here.
#[cfg(not(unix))]
pub fn thread_time() -> Duration {
    use std::sync::LazyLock;
    use std::time::Instant;
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

/// Processor time of this program so far, all threads; `None` where the system does not tell.
#[cfg(not(unix))]
pub fn process_time() -> Option<Duration> {
    None
}
