//! What file dialogs ask for.

/// What a dialog asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asks {
    /// A scene, trajectories, or a floor plan.
    Open,
    /// A set.
    Set,
    /// A file to write, which may exist.
    Save,
}
