//! The help window: keys, tools and the mouse.

use crate::direct::Tool;
use crate::keys::KEYS;
use eframe::egui::{Align2, Context, Grid, RichText, Ui, Window};

const MOUSE: [(&str, &str); 8] = [
    ("drag", "move the plan; orbit around the target"),
    ("Shift drag, right drag", "move the target in orbit"),
    ("wheel, pinch", "zoom at the pointer"),
    ("click", "select an agent"),
    ("double click", "show the whole scene"),
    ("drop a file", "open a scene"),
    ("two fingers", "move and zoom; rotate in orbit"),
    ("long press", "the right button"),
];

/// Shows the help while it is `open`.
pub fn help(ctx: &Context, open: &mut bool) {
    let window = Window::new("Help").open(open).collapsible(false).resizable(false);
    window.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(ctx, |ui| {
        let rows = KEYS.iter().map(|(.., key, says)| (*key, *says));
        let tools = Tool::all().map(|tool| (tool.says().1, tool.says().2)).chain(MOUSE);
        ui.horizontal_top(|ui| {
            table(ui, "keys", rows);
            ui.add_space(24.0);
            table(ui, "tools", tools);
        });
    });
}

fn table(ui: &mut Ui, name: &str, rows: impl Iterator<Item = (&'static str, &'static str)>) {
    Grid::new(name).num_columns(2).spacing([24.0, 3.0]).show(ui, |ui| {
        for (key, says) in rows {
            ui.label(RichText::new(key).strong());
            ui.label(says);
            ui.end_row();
        }
    });
}
