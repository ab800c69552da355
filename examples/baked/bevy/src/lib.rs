//! Draws thousands of walking people in Bevy: [`crowd::BakedCrowd`] and [`crowd::BakedCrowdPlugin`] are the part for
//! other programs.

pub mod crowd;
pub mod glb;
#[cfg(test)]
mod tests;
