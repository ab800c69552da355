//! Searching the velocities that a body can have for the cheapest.

use super::View;
use crate::Error;
use crate::random::Purpose;
use glam::Vec2;
use std::f32::consts::TAU;

/// Which velocities are tried. The preferred one is always the first; of equal costs the first wins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Search {
    /// The present velocity, standing still, and a pattern over all velocities, aligned with the preferred one, that is
    /// refined about the best so far (Recast's Detour crowd; MODELS 1.2.1). No random numbers: little trembling.
    #[default]
    Adaptive,
    /// So many drawn evenly from the disc of speeds, anew in every step, as the authors of RVO do: they tremble.
    Random {
        /// How many. Limit: 1 to 100,000.
        candidates: u32,
    },
}

/// Points of the pattern: on each of two rings.
const ANGLES: usize = 16;
/// How often the pattern is refined; it is halved each time.
const DEPTH: usize = 6;

impl Search {
    pub(super) fn check(self) -> Result<(), Error> {
        match self {
            Self::Adaptive => Ok(()),
            Self::Random { candidates } => {
                let right = (1..=100_000).contains(&candidates);
                Error::unless(right, "candidates", candidates as f32, "from 1 to 100,000")
            }
        }
    }
}

/// The cheapest velocity that the search finds. `cost` tells of a wish the velocity that is possible, and its cost; one
/// that would not be less than the best so far, which it is given, need not be exact.
pub(super) fn cheapest(search: Search, view: &View<'_>, mut cost: impl FnMut(Vec2, f32) -> (Vec2, f32)) -> Vec2 {
    let mut best = (view.preferred, f32::INFINITY);
    let mut candidate = |v: Vec2| {
        let (v, cost) = cost(v, best.1);
        if cost < best.1 {
            best = (v, cost);
        }
        best.0
    };
    let center = candidate(view.preferred);
    match search {
        Search::Adaptive => adaptive(view, candidate),
        Search::Random { candidates } => (0..candidates).fold(center, |_, k| {
            let (sin, cos) = libm::sincosf(view.dice.nth(k, Purpose::CandidateAcross) * TAU);
            // evenly over the disc
            let speed = view.dice.nth(k, Purpose::CandidateAlong).sqrt() * view.max_speed;
            candidate(Vec2::new(cos, sin) * speed)
        }),
    }
}

fn adaptive(view: &View<'_>, mut candidate: impl FnMut(Vec2) -> Vec2) -> Vec2 {
    candidate(view.velocity);
    let mut center = candidate(Vec2::ZERO);
    let ahead = view.preferred.try_normalize().unwrap_or(Vec2::X);
    // the inner ring is turned by half a step
    let rings = [0.0, 0.5].map(|turn| {
        std::array::from_fn::<Vec2, ANGLES, _>(|i| {
            let (sin, cos) = libm::sincosf((i as f32 + turn) * (TAU / ANGLES as f32));
            Vec2::new(cos, sin).rotate(ahead)
        })
    });
    let mut radius = view.max_speed;
    for depth in 0..DEPTH {
        let origin = if depth == 0 { Vec2::ZERO } else { center };
        for (ring, reach) in rings.iter().zip([radius, radius * 0.5]) {
            for direction in ring {
                center = candidate(origin + *direction * reach);
            }
        }
        radius *= 0.5;
    }
    center
}
