//! Errors of trajectories.

/// The reason for which a trajectory has no poses.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Error {
    /// There is no sample.
    #[error("the trajectory has no samples; pass at least one")]
    Empty,
    /// A number of a sample is not finite.
    #[error("sample {index}: a number is not finite; leave the sample out")]
    NotFinite {
        /// Number of the sample, from 0.
        index: usize,
    },
    /// A sample is not later than the one before it.
    #[error(
        "sample {index}: time {time} s is not after the time of the sample before it; sort the samples and leave repeated times out"
    )]
    Time {
        /// Number of the sample, from 0.
        index: usize,
        /// Time of the sample, s.
        time: f64,
    },
    /// The trajectory is longer than four hours.
    #[error("the trajectory lasts {duration} s; split it into parts of at most 14400 s")]
    TooLong {
        /// Time from the first to the last sample, s.
        duration: f64,
    },
}
