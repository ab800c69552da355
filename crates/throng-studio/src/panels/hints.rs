//! Hints for a new user of the studio, one at a time.

use eframe::egui::{RichText, Ui};

/// All hints. A hint ends when the user does what it says, or goes on.
const HINTS: [&str; 5] = [
    "Drag the view to move it. The wheel, or two fingers, zoom.",
    "Click an agent to select it: the view shows what it sees and where it wants to go.",
    "Why draws the velocities that the agent may choose from, while it walks.",
    "Tune has all parameters as sliders. The run follows them.",
    "The tools at the left edit the scene. The last seven change it while it runs. ? lists all keys.",
];

/// The hints for a new user.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hints {
    at: Option<usize>,
}

impl Hints {
    /// Begins with the first hint.
    pub fn begin(&mut self) {
        self.at = Some(0);
    }

    /// Whether a hint is shown.
    pub fn open(&self) -> bool {
        self.at.is_some()
    }

    /// Shows the present hint. `done` tells for the second, third and fourth hint whether the user has done what they
    /// say. Returns whether the hints have ended.
    pub fn ui(&mut self, ui: &mut Ui, done: [bool; 3]) -> bool {
        let Some(at) = self.at.and_then(|at| next(at, done)) else {
            self.at = None;
            return true;
        };
        self.at = Some(at);
        let mut left = false;
        ui.set_max_width(420.0);
        ui.label(HINTS[at]);
        ui.horizontal(|ui| {
            if ui.button(if at + 1 < HINTS.len() { "Next hint" } else { "Got it" }).clicked() {
                self.at = Some(at + 1).filter(|&at| at < HINTS.len());
            }
            left = at + 1 < HINTS.len() && ui.button("No hints").clicked();
            ui.label(RichText::new(format!("{} of {}", at + 1, HINTS.len())).weak());
        });
        if left {
            self.at = None;
        }
        self.at.is_none()
    }
}

/// Returns the first hint from `at` on that is not done, `None` after the last.
fn next(at: usize, done: [bool; 3]) -> Option<usize> {
    (at..HINTS.len()).find(|&at| at.checked_sub(1).and_then(|at| done.get(at)) != Some(&true))
}

#[cfg(test)]
mod tests {
    use super::next;

    #[test]
    fn hints_that_are_done_are_left_out() {
        assert_eq!(next(0, [false; 3]), Some(0));
        assert_eq!(next(1, [false; 3]), Some(1));
        assert_eq!(next(1, [true, false, true]), Some(2));
        assert_eq!(next(2, [false, true, true]), Some(4));
        assert_eq!(next(5, [false; 3]), None);
    }
}
