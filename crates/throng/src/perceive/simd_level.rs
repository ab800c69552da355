//! The SIMD instructions that the vectorised paths use.

use fearless_simd::Level;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::Simd;

/// The SIMD instructions of a step. All levels give bit-identical results. The choice serves measurements and tests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SimdLevel {
    /// The best instructions that the processor has, selected at run time.
    #[default]
    Best,
    /// Scalar code only: the reference.
    Plain,
    /// At most SSE2: vectors of four.
    Sse2,
    /// At most SSE4.2: vectors of four.
    Sse42,
    /// At most AVX2: vectors of eight.
    Avx2,
}

impl SimdLevel {
    /// All levels.
    pub const ALL: [Self; 5] = [Self::Best, Self::Plain, Self::Sse2, Self::Sse42, Self::Avx2];

    /// Returns the best level up to this one; `None` for scalar code.
    pub fn level(self) -> Option<Level> {
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

    /// Returns the name of the instructions in use on this processor; `None` for scalar code or if the processor has no
    /// SIMD instructions.
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
