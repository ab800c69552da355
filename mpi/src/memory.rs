//! The memory of this process.

use std::fs;

/// Returns the greatest memory that this process has had so far, bytes; 0 if the system does not tell. Linux does.
pub fn peak() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    kibibytes(&status).unwrap_or(0) * 1024
}

fn kibibytes(status: &str) -> Option<u64> {
    status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?.trim().strip_suffix(" kB")?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::kibibytes;

    #[test]
    fn the_peak_is_read() {
        assert_eq!(kibibytes("Name:\tx\nVmHWM:\t   1234 kB\nVmRSS:\t 9 kB\n"), Some(1234));
        assert_eq!(kibibytes("VmRSS:\t 9 kB\n"), None);
    }
}
