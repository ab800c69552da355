//! The agents' state, a column a fact.

/// Columns.
#[derive(Clone, Debug, Default)]
pub struct Columns {}
