//! Leaving a text that is not saved, or a recording that is not done.

/// What people want to leave for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Leaving {
    /// Opens another scene.
    Open(String),
    /// Begins an empty scene.
    New,
    /// Takes the text that somebody else wrote to the file.
    Reload(String),
    /// Closes the studio.
    Close,
}

/// What there is to decide about before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unfinished {
    /// Changes of the text that are not saved.
    Text,
    /// A recording under way.
    Recording,
}

/// What people want to be done with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Writes the text to its file; completes the recording with what there is of it.
    Save,
    /// Lets it go.
    Discard,
    /// Stays with it.
    Keep,
    /// Leaves; the recording goes on beside.
    Beside,
}

impl Leaving {
    /// What there is to decide.
    pub fn says(&self, of: Unfinished, name: &str) -> String {
        match (of, self) {
            (Unfinished::Text, Self::Open(_) | Self::New) => format!("{name} has changes that are not saved."),
            (Unfinished::Text, Self::Reload(_)) => {
                format!("The file of {name} was written by somebody else, and the text here has changes.")
            }
            (Unfinished::Text, Self::Close) => format!("{name} has changes that are not saved. Close the studio?"),
            (Unfinished::Recording, Self::Close) => {
                format!("{name} is still being recorded. Close the studio?")
            }
            (Unfinished::Recording, _) => format!("{name} is still being recorded."),
        }
    }

    /// The answers, and what they are called here.
    pub fn answers(&self, of: Unfinished) -> Vec<(Answer, &'static str)> {
        let (save, discard, keep) = match (of, self) {
            (Unfinished::Text, Self::Open(_) | Self::New | Self::Close) => ("Save", "Discard", "Keep editing"),
            (Unfinished::Text, Self::Reload(_)) => ("Save mine", "Take the file's", "Keep editing"),
            (Unfinished::Recording, Self::Close) => ("Finish and keep", "Discard", "Go on recording"),
            (Unfinished::Recording, _) => {
                return vec![(Answer::Save, "Finish and keep"), (Answer::Beside, "Go on recording")];
            }
        };
        vec![(Answer::Save, save), (Answer::Discard, discard), (Answer::Keep, keep)]
    }
}
