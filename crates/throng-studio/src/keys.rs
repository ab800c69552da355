//! The keyboard. Keys follow OpenSteerDemo where possible.

use crate::direct::Tool;
use eframe::egui::{Event, Key, Modifiers};

/// An action of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Runs or pauses.
    Play,
    /// Steps forward.
    Step,
    /// Steps back.
    Back,
    /// Restarts the scene.
    Restart,
    /// Opens the next scene of the gallery.
    NextScene,
    /// Opens the previous scene of the gallery.
    PreviousScene,
    /// Selects the next agent.
    NextAgent,
    /// Selects the next camera.
    NextCamera,
    /// Selects the next speed.
    NextSpeed,
    /// Shows or hides the annotations of the selected agent.
    Annotations,
    /// Shows or hides trails.
    Trails,
    /// Fits the whole scene into the view.
    Fit,
    /// Switches between the light and the dark theme.
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
    /// Opens or closes the velocity space of the selected agent.
    Why,
    /// Opens or closes the help.
    Help,
    /// Closes what is open and clears the selection.
    Leave,
    /// Selects a tool.
    Take(Tool),
    /// Removes the selected item from the scene.
    Remove,
    /// Makes the view a key of the scene's camera.
    KeyCamera,
    /// Adds an agent to a group.
    More,
    /// Removes an agent from a group.
    Fewer,
    /// Opens a new scene.
    New,
    /// Opens a file.
    Open,
    /// Saves the scene.
    Save,
    /// Saves the scene under another name.
    SaveAs,
    /// Undoes an edit.
    Undo,
    /// Redoes an edit.
    Redo,
}

/// All keys: whether the command key is held, the key, its action, its label, and its help text.
pub const KEYS: [(bool, Key, Action, &str, &str); 30] = [
    (false, Key::Space, Action::Play, "Space", "run or pause"),
    (false, Key::ArrowRight, Action::Step, "Right", "one step forward"),
    (false, Key::ArrowLeft, Action::Back, "Left", "one step back"),
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
    (false, Key::I, Action::Summary, "I", "summary of the run"),
    (false, Key::U, Action::Tuning, "U", "sliders for the parameters of the groups"),
    (false, Key::H, Action::Plots, "H", "plots against time"),
    (false, Key::W, Action::Why, "W", "why the selected agent moves as it does"),
    (false, Key::Questionmark, Action::Help, "?", "this help"),
    (false, Key::Escape, Action::Leave, "Esc", "close, clear the selection"),
    (false, Key::Delete, Action::Remove, "Delete", "remove the selected item from the scene"),
    (false, Key::Insert, Action::KeyCamera, "Insert", "key the camera: films of the scene look from here at this time"),
    (false, Key::Plus, Action::More, "+", "add an agent to the group of the selected agent"),
    (false, Key::Minus, Action::Fewer, "−", "remove an agent from that group"),
    (true, Key::S, Action::Save, "Ctrl S", "save the scene (with Shift: under another name)"),
    (true, Key::N, Action::New, "Ctrl N", "a new scene"),
    (true, Key::O, Action::Open, "Ctrl O", "open a scene file, or trajectories to replay"),
    (true, Key::Z, Action::Undo, "Ctrl Z", "undo (with Shift: redo)"),
    (true, Key::Y, Action::Redo, "Ctrl Y", "redo"),
    (true, Key::Enter, Action::Play, "Ctrl Enter", "run or pause, also while editing the text"),
];

/// Removes the events of keys that have an action, and returns the actions. While the user types text, only keys with
/// the command key act.
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
    // keyboard layouts report these keys in either form
    let key = match key {
        Key::Slash if modifiers.shift => Key::Questionmark,
        Key::Equals if modifiers.shift => Key::Plus,
        key => key,
    };
    let found = KEYS.iter().find(|(with, known, ..)| (*with, *known) == (command, key)).map(|found| found.2);
    let found = found.or_else(|| Tool::of_key(key).filter(|_| !command).map(Action::Take))?;
    // a text field has its own undo
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
        // Escape leaves what is open and thereby selects the hand
        let tools = Tool::all().filter(|tool| *tool != Tool::Hand);
        keys.extend(tools.map(|tool| (false, tool.says().0)));
        let all = keys.len();
        keys.sort();
        keys.dedup();
        assert_eq!(keys.len(), all);
    }

    #[test]
    fn keys_do_not_act_while_text_is_edited() {
        let mut events = vec![
            key(Key::R, true, Modifiers::NONE),
            key(Key::S, true, Modifiers::COMMAND),
            key(Key::Z, true, Modifiers::COMMAND),
        ];
        assert_eq!(take(&mut events, true), [Action::Save]);
        assert_eq!(events.len(), 2);
    }
}
