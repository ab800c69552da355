//! A row of controls that adapts to its width.

use eframe::egui::{Align, Button, Layout, Ui, vec2};

/// The width of the button that shows the rest, points.
const MORE: f32 = 60.0;

/// The widths of the controls and the greatest height, as shown last, and whether those that do not fit are visible.
#[derive(Clone, Default)]
struct Row {
    widths: Vec<f32>,
    height: f32,
    open: bool,
}

/// Shows the controls that fit beside each other, first ones first. A button at the end shows the rest in rows below.
/// `rest` is shown in the width that is left.
pub fn row<T: Copy>(
    ui: &mut Ui,
    name: &str,
    items: &[T],
    mut show: impl FnMut(&mut Ui, T),
    rest: impl FnOnce(&mut Ui),
) {
    let id = ui.make_persistent_id(name);
    let mut row: Row = ui.data(|data| data.get_temp(id)).unwrap_or_default();
    if row.widths.len() != items.len() {
        // all widths are unknown: this pass measures them and is not shown
        row.widths = vec![0.0; items.len()];
        ui.ctx().request_discard("the widths of a row");
    }
    let gap = ui.spacing().item_spacing.x;
    let count = fitting(&row.widths, gap, ui.available_width(), MORE);
    let middle = Layout::left_to_right(Align::Center);
    let mut measure = |ui: &mut Ui, k: usize, row: &mut Row| {
        let size = ui.scope(|ui| show(ui, items[k])).response.rect.size();
        if (size.x - row.widths[k]).abs() > 0.5 || size.y > row.height + 0.5 {
            (row.widths[k], row.height) = (size.x, size.y.max(row.height));
            ui.ctx().request_repaint();
        }
    };
    ui.allocate_ui_with_layout(vec2(ui.available_width(), row.height), middle, |ui| {
        (0..count).for_each(|k| measure(ui, k, &mut row));
        if count < items.len() {
            let more = ui.add(Button::selectable(row.open, "More").min_size(vec2(MORE, 0.0)));
            if more.on_hover_text("the controls that do not fit into the window").clicked() {
                row.open = !row.open;
            }
        }
        rest(ui);
    });
    if count < items.len() && row.open {
        ui.horizontal_wrapped(|ui| {
            for k in count..items.len() {
                let size = vec2(row.widths[k], row.height);
                ui.allocate_ui_with_layout(size, middle, |ui| measure(ui, k, &mut row));
            }
        });
    }
    ui.data_mut(|data| data.insert_temp(id, row));
}

/// Returns how many of the controls fit. If not all do, a button of the width `more` follows them.
fn fitting(widths: &[f32], gap: f32, whole: f32, more: f32) -> usize {
    let end = |sum: &mut f32, width: &f32| {
        *sum += width + gap;
        Some(*sum)
    };
    let ends: Vec<f32> = widths.iter().scan(0.0, end).collect();
    if ends.last().is_none_or(|end| end - gap <= whole) {
        return widths.len();
    }
    ends.iter().take_while(|&&end| end + more <= whole).count()
}

#[cfg(test)]
mod tests {
    use super::fitting;

    #[test]
    fn what_fits_comes_first() {
        let widths = [50.0, 60.0, 70.0];
        assert_eq!(fitting(&widths, 10.0, 200.0, 30.0), 3);
        assert_eq!(fitting(&widths, 10.0, 199.0, 30.0), 2);
        assert_eq!(fitting(&widths, 10.0, 159.0, 30.0), 1);
        assert_eq!(fitting(&widths, 10.0, 80.0, 30.0), 0);
        assert_eq!(fitting(&[], 10.0, 0.0, 30.0), 0);
    }
}
