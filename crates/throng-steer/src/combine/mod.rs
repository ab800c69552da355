//! Behaviours that combine other behaviours or cure their defects.

mod allocation;
mod amortised;
mod condition;
mod context;
mod dithering;
mod hold;
mod irregular;
mod limited;
mod machine;
mod priority;
mod running_sum;
mod stop_and_wait;
mod switch;
mod weighted_sum;

pub use allocation::Allocation;
pub(super) use allocation::Budget;
pub use amortised::Amortised;
pub use condition::Condition;
pub use context::ContextSteering;
pub use dithering::Dithering;
pub use hold::Hold;
pub use irregular::Irregular;
pub use limited::Limited;
pub use priority::Priority;
pub use running_sum::RunningSum;
pub use stop_and_wait::StopAndWait;
pub use switch::{State, Switch};
pub use weighted_sum::WeightedSum;

use throng::motion::Steering;

/// Returns the sum of the forces, with the facing of the first steering that has one.
fn add(sum: Option<Steering>, more: Steering) -> Steering {
    match sum {
        Some(sum) => Steering { force: sum.force + more.force, facing: sum.facing.or(more.facing) },
        None => more,
    }
}
