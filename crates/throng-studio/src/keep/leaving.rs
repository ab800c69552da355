//! Leaving a text that is not saved.

/// What would lose the changes of the text.
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

/// What people want to be done with the changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Writes them to the file.
    Save,
    /// Lets them go.
    Discard,
    /// Stays with them.
    Keep,
}

impl Leaving {
    /// What there is to decide.
    pub fn says(&self, name: &str) -> String {
        match self {
            Self::Open(_) | Self::New => format!("{name} has changes that are not saved."),
            Self::Reload(_) => {
                format!("The file of {name} was written by somebody else, and the text here has changes.")
            }
            Self::Close => format!("{name} has changes that are not saved. Close the studio?"),
        }
    }

    /// The answers, and what they are called here.
    pub fn answers(&self) -> [(Answer, &'static str); 3] {
        let [save, discard] = match self {
            Self::Open(_) | Self::New | Self::Close => ["Save", "Discard"],
            Self::Reload(_) => ["Save mine", "Take the file's"],
        };
        [(Answer::Save, save), (Answer::Discard, discard), (Answer::Keep, "Keep editing")]
    }
}
