//! Which instructions the many-at-once paths run on.

use fearless_simd::Level;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::Simd;

/// Which instructions a step is made with. All give the same bits: this is for measuring, and for tests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Instructions {
    /// The best that the processor has, chosen when the step is made.
    #[default]
    Best,
    /// One agent after the other: the reference.
    Plain,
    /// At most SSE2: four lanes.
    Sse2,
    /// At most SSE4.2: four lanes.
    Sse42,
    /// At most AVX2: eight lanes.
    Avx2,
}

impl Instructions {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Best, Self::Plain, Self::Sse2, Self::Sse42, Self::Avx2];

    /// The best level up to this; none to go one by one.
    pub(crate) fn level(self) -> Option<Level> {
        let best = Level::new();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let limited = match self {
            Self::Best | Self::Plain => None,
            Self::Sse2 => best.as_sse2().map(|simd| simd.level()),
            Self::Sse42 => best.as_sse4_2().map(|simd| simd.level()),
            Self::Avx2 => best.as_avx2().map(|simd| simd.level()),
        };
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let limited = None;
        (self != Self::Plain).then(|| limited.unwrap_or(best))
    }

    /// The name of what it comes to on this processor: none for one by one, or where vectors are not known.
    pub fn found(self) -> Option<&'static str> {
        let level = self.level()?;
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let name = match level {
            Level::Avx512(_) => Some("avx512"),
            Level::Avx2(_) => Some("avx2"),
            Level::Sse4_2(_) => Some("sse4.2"),
            Level::Sse2(_) => Some("sse2"),
            _ => None,
        };
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let name = (!level.is_fallback()).then_some("128 bits");
        name
    }
}
