//! The help window: keys, tools and the mouse.

use crate::direct::Tool;
use crate::keys::KEYS;
use eframe::egui::{Align2, Context, Grid, Id, Label, Modal, RichText, ScrollArea, Ui, Window};

const MOUSE: [(&str, &str); 11] = [
    ("drag", "move the plan; orbit around the target"),
    ("Shift drag, right drag", "move the target in orbit"),
    ("wheel, pinch", "zoom at the pointer"),
    ("click", "select an agent"),
    ("double click", "show the whole scene"),
    ("3, 3 < 45, 3 x 2", "while drawing: a length, with a direction, or sides; Enter ends"),
    ("Shift, Alt", "while drawing: straight; without snapping"),
    ("arrows, Enter", "with a tool: move its pointer (with Shift: finely), press and release it"),
    ("drop a file", "open a scene"),
    ("two fingers", "move and zoom; rotate in orbit"),
    ("long press", "the right button"),
];

/// The width of a table, points.
const COLUMN: f32 = 480.0;
/// The width of the column of keys, and what the window needs beside the text, points.
const KEY: f32 = 92.0;
const BESIDE: f32 = 60.0;

/// Shows the help while it is `open`. Returns whether the user wants all settings reset.
pub fn help(ctx: &Context, open: &mut bool) -> bool {
    let window = Window::new("Help").open(open).collapsible(false).resizable(false);
    let shown = window.anchor(Align2::CENTER_CENTER, [0.0, 0.0]).show(ctx, |ui| {
        let rows = KEYS.iter().map(|(.., key, says)| (*key, *says));
        let tools = Tool::all().map(|tool| (tool.says().1, tool.says().2)).chain(MOUSE);
        let screen = ctx.content_rect().size();
        let resets = ui.button("Reset all settings…").clicked();
        ui.separator();
        ScrollArea::vertical().max_height(screen.y - 220.0).show(ui, |ui| {
            // beside each other, or below in a narrow window
            let shown = |ui: &mut Ui| {
                table(ui, "keys", rows);
                ui.add_space(24.0);
                table(ui, "tools", tools);
            };
            if screen.x < 2.0 * COLUMN { shown(ui) } else { ui.horizontal_top(shown).inner }
        });
        resets
    });
    shown.and_then(|shown| shown.inner).unwrap_or_default()
}

/// Asks whether all settings are reset, while it is `open`. Returns whether the user agrees.
pub fn resetting(ctx: &Context, open: &mut bool) -> bool {
    if !*open {
        return false;
    }
    let modal = Modal::new(Id::unique("resetting")).show(ctx, |ui| {
        ui.set_max_width(360.0);
        ui.label("Reset the colours, layers, panels and speed to what they are at first? Scenes and files stay.");
        ui.add_space(10.0);
        ui.horizontal(|ui| [ui.button("Reset").clicked(), ui.button("Keep").clicked()]).inner
    });
    let [resets, keeps] = modal.inner;
    *open = !(resets || keeps || modal.should_close());
    resets
}

fn table(ui: &mut Ui, name: &str, rows: impl Iterator<Item = (&'static str, &'static str)>) {
    // texts are wrapped where a line does not fit
    let most = COLUMN.min(ui.ctx().content_rect().width() - BESIDE) - KEY;
    Grid::new(name).num_columns(2).spacing([16.0, 3.0]).show(ui, |ui| {
        for (key, says) in rows {
            for (text, width) in [(RichText::new(key).strong(), KEY), (RichText::new(says), most)] {
                ui.scope(|ui| {
                    ui.set_max_width(width);
                    ui.add(Label::new(text).wrap());
                });
            }
            ui.end_row();
        }
    });
}
