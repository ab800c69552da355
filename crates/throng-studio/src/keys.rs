//! The keyboard: as in OpenSteerDemo where it makes sense.

use crate::direct::Tool;
use eframe::egui::{Event, Key, Modifiers};

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Runs, or pauses.
    Play,
    /// A step on.
    Step,
    /// A step back.
    Back,
    /// From the start.
    Restart,
    /// The next scene of the gallery.
    NextScene,
    /// The scene before.
    PreviousScene,
    /// Selects the next agent.
    NextAgent,
    /// The next camera.
    NextCamera,
    /// The next speed.
    NextSpeed,
    /// Draws what the selected agent has in mind, or not.
    Annotations,
    /// Trails, or none.
    Trails,
    /// Sees everything.
    Fit,
    /// Light or dark.
    Dark,
    /// Opens or closes the gallery.
    Gallery,
    /// Opens or closes the text.
    Text,
    /// Opens or closes the summary.
    Summary,
    /// Shows or hides the sliders.
    Tuning,
    /// Opens or closes the plots.
    Plots,
    /// Opens or closes why the selected agent goes where it goes.
    Why,
    /// Opens or closes the help.
    Help,
    /// Closes what is open, selects nobody.
    Leave,
    /// Takes a tool.
    Take(Tool),
    /// Takes what is selected out of the scene.
    Remove,
    /// One more of a group.
    More,
    /// One fewer.
    Fewer,
    /// A new scene.
    New,
    /// Opens a file.
    Open,
    /// Saves the scene.
    Save,
    /// Saves it under another name.
    SaveAs,
    /// Takes an edit back.
    Undo,
    /// Does it again.
    Redo,
}

/// Every key, what it does, and how the help says it. `true`: with the command key.
pub const KEYS: [(bool, Key, Action, &str, &str); 29] = [
    (false, Key::Space, Action::Play, "Space", "run or pause"),
    (false, Key::ArrowRight, Action::Step, "Right", "a step on"),
    (false, Key::ArrowLeft, Action::Back, "Left", "a step back"),
    (false, Key::R, Action::Restart, "R", "restart"),
    (false, Key::Tab, Action::NextScene, "Tab", "next scene (with Shift: the one before)"),
    (false, Key::S, Action::NextAgent, "S", "select the next agent"),
    (false, Key::C, Action::NextCamera, "C", "next camera"),
    (false, Key::F, Action::NextSpeed, "F", "next speed"),
    (false, Key::A, Action::Annotations, "A", "annotations of the selected agent"),
    (false, Key::T, Action::Trails, "T", "trails"),
    (false, Key::Home, Action::Fit, "Home", "see everything (or double click)"),
    (false, Key::D, Action::Dark, "D", "light or dark"),
    (false, Key::G, Action::Gallery, "G", "gallery"),
    (false, Key::E, Action::Text, "E", "text of the scene"),
    (false, Key::I, Action::Summary, "I", "how the run goes"),
    (false, Key::U, Action::Tuning, "U", "sliders for what groups are"),
    (false, Key::H, Action::Plots, "H", "figures against time"),
    (false, Key::W, Action::Why, "W", "why the selected agent goes where it goes"),
    (false, Key::Questionmark, Action::Help, "?", "this help"),
    (false, Key::Escape, Action::Leave, "Esc", "close, select nobody"),
    (false, Key::Delete, Action::Remove, "Delete", "take what is selected out of the scene"),
    (false, Key::Plus, Action::More, "+", "one more of the selected agent's group"),
    (false, Key::Minus, Action::Fewer, "−", "one fewer"),
    (true, Key::S, Action::Save, "Ctrl S", "save the scene (with Shift: under another name)"),
    (true, Key::N, Action::New, "Ctrl N", "a new scene"),
    (true, Key::O, Action::Open, "Ctrl O", "open a scene file, or trajectories to replay"),
    (true, Key::Z, Action::Undo, "Ctrl Z", "undo (with Shift: redo)"),
    (true, Key::Y, Action::Redo, "Ctrl Y", "redo"),
    (true, Key::Enter, Action::Play, "Ctrl Enter", "run or pause, in the text too"),
];

/// Takes the keys that do something out of what has happened. While somebody writes, only those with the command key do.
pub fn take(events: &mut Vec<Event>, writing: bool) -> Vec<Action> {
    let mut actions = Vec::new();
    events.retain(|event| match event {
        Event::Key { key, pressed, modifiers, .. } => {
            let Some(action) = action(*key, *modifiers, writing) else { return true };
            if *pressed {
                actions.push(action);
            }
            false
        }
        _ => true,
    });
    actions
}

fn action(key: Key, modifiers: Modifiers, writing: bool) -> Option<Action> {
    let command = modifiers.command;
    if modifiers.alt || (writing && !command) {
        return None;
    }
    // a keyboard may say so either way
    let key = match key {
        Key::Slash if modifiers.shift => Key::Questionmark,
        Key::Equals if modifiers.shift => Key::Plus,
        key => key,
    };
    let found = KEYS.iter().find(|(with, known, ..)| (*with, *known) == (command, key)).map(|found| found.2);
    let found = found.or_else(|| Tool::of_key(key).filter(|_| !command).map(Action::Take))?;
    // a text has an undo of its own
    if writing && matches!(found, Action::Undo | Action::Redo) {
        return None;
    }
    Some(match found {
        Action::NextScene if modifiers.shift => Action::PreviousScene,
        Action::Undo if modifiers.shift => Action::Redo,
        Action::Save if modifiers.shift => Action::SaveAs,
        found => found,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(key: Key, pressed: bool, modifiers: Modifiers) -> Event {
        Event::Key { key, physical_key: None, pressed, repeat: false, modifiers }
    }

    #[test]
    fn a_key_acts_once_when_it_is_pressed() {
        let none = Modifiers::NONE;
        let mut events =
            vec![key(Key::Space, true, none), key(Key::Space, false, none), key(Key::Tab, true, Modifiers::SHIFT)];
        assert_eq!(take(&mut events, false), [Action::Play, Action::PreviousScene]);
        assert!(events.is_empty());
        let mut events = vec![key(Key::Slash, true, Modifiers::SHIFT), key(Key::Questionmark, true, Modifiers::SHIFT)];
        assert_eq!(take(&mut events, false), [Action::Help, Action::Help]);
        let mut events = vec![key(Key::Equals, true, Modifiers::SHIFT), key(Key::Minus, true, none)];
        assert_eq!(take(&mut events, false), [Action::More, Action::Fewer]);
    }

    #[test]
    fn a_key_does_one_thing() {
        let mut keys: Vec<(bool, Key)> = KEYS.iter().map(|(with, key, ..)| (*with, *key)).collect();
        // who leaves what is open has the hand again
        let tools = Tool::all().filter(|tool| *tool != Tool::Hand);
        keys.extend(tools.map(|tool| (false, tool.says().0)));
        let all = keys.len();
        keys.sort();
        keys.dedup();
        assert_eq!(keys.len(), all);
    }

    #[test]
    fn who_writes_is_not_disturbed() {
        let mut events = vec![
            key(Key::R, true, Modifiers::NONE),
            key(Key::S, true, Modifiers::COMMAND),
            key(Key::Z, true, Modifiers::COMMAND),
        ];
        assert_eq!(take(&mut events, true), [Action::Save]);
        assert_eq!(events.len(), 2);
    }
}
