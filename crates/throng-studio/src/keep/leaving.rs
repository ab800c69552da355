//! Questions before unsaved text is left or an unfinished recording is dropped.

use super::Draft;

/// The action that would leave the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Leaving {
    /// Opens another scene.
    Open(String),
    /// Opens an empty scene.
    New,
    /// Goes to a step of a lesson, both by position.
    Step(usize, usize),
    /// Opens a text that an earlier session did not save.
    Restore(Draft),
    /// Loads the text that another program wrote to the file.
    Reload(String),
    /// Closes the studio.
    Close,
}

/// The unfinished work that the question is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unfinished {
    /// Unsaved changes of the text.
    Text,
    /// A recording under way.
    Recording,
}

/// The answer of the user.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Writes the text to its file, or completes the recording with the frames that exist.
    Save,
    /// Discards the unfinished work.
    Discard,
    /// Stays with the unfinished work.
    Keep,
    /// Performs the action; the recording continues in the background.
    Beside,
}

impl Leaving {
    /// Returns the question.
    pub fn says(&self, of: Unfinished, name: &str) -> String {
        match (of, self) {
            (Unfinished::Text, Self::Open(_) | Self::Step(..) | Self::New | Self::Restore(_)) => {
                format!("{name} has changes that are not saved.")
            }
            (Unfinished::Text, Self::Reload(_)) => {
                format!("The file of {name} was changed by another program, and the text here has unsaved changes.")
            }
            (Unfinished::Text, Self::Close) => format!("{name} has changes that are not saved. Close the studio?"),
            (Unfinished::Recording, Self::Close) => {
                format!("{name} is still being recorded. Close the studio?")
            }
            (Unfinished::Recording, _) => format!("{name} is still being recorded."),
        }
    }

    /// Returns the answers and their labels.
    pub fn answers(&self, of: Unfinished) -> Vec<(Answer, &'static str)> {
        let (save, discard, keep) = match (of, self) {
            (Unfinished::Text, Self::Reload(_)) => ("Save mine", "Take the file's", "Keep editing"),
            (Unfinished::Text, _) => ("Save", "Discard", "Keep editing"),
            (Unfinished::Recording, Self::Close) => ("Finish and keep", "Discard", "Go on recording"),
            (Unfinished::Recording, _) => {
                return vec![(Answer::Save, "Finish and keep"), (Answer::Beside, "Go on recording")];
            }
        };
        vec![(Answer::Save, save), (Answer::Discard, discard), (Answer::Keep, keep)]
    }
}
