//! The key of colours and lines, in a corner of the view.

use crate::style;
use crate::view::{Row, Sign};
use eframe::egui::{Align2, Area, Frame, Id, Rect, RichText, Sense, Shape, Stroke, Ui, vec2};

/// The size of a colour ramp and the length of a line, points of the screen.
const RAMP: [f32; 2] = [120.0, 9.0];
const LINE: f32 = 22.0;
/// The number of steps of a ramp.
const STEPS: usize = 40;

/// Shows the key in the lower left corner of a view.
pub fn key(ui: &Ui, view: Rect, parts: &[Vec<Row>], name: &str) {
    if parts.iter().all(Vec::is_empty) {
        return;
    }
    let area = Area::new(Id::unique(("key", name))).pivot(Align2::LEFT_BOTTOM).interactable(false);
    let fill = ui.visuals().panel_fill.gamma_multiply(0.86);
    area.fixed_pos(view.left_bottom() + vec2(12.0, -12.0)).show(ui.ctx(), |ui| {
        Frame::new().fill(fill).corner_radius(6).inner_margin(8).show(ui, |ui| {
            ui.spacing_mut().item_spacing = vec2(8.0, 2.0);
            for (k, part) in parts.iter().filter(|part| !part.is_empty()).enumerate() {
                if k > 0 {
                    ui.add_space(6.0);
                }
                part.iter().for_each(|row| show(ui, row));
            }
        });
    });
}

fn show(ui: &mut Ui, row: &Row) {
    let says = || RichText::new(&row.says).small();
    match row.sign {
        Sign::Ramp | Sign::Heat(..) | Sign::Tone(_) => {
            ui.label(says());
            ui.horizontal(|ui| {
                ui.label(RichText::new("0").small().weak());
                ramp(ui, row.sign);
                ui.label(RichText::new(number(row.most)).small().weak());
            });
        }
        _ => {
            ui.horizontal(|ui| {
                sign(ui, row.sign);
                ui.label(says());
            });
        }
    }
}

fn ramp(ui: &mut Ui, sign: Sign) {
    let (rect, _) = ui.allocate_exact_size(RAMP.into(), Sense::hover());
    for k in 0..STEPS {
        let edge = |k: usize| rect.left() + rect.width() * k as f32 / STEPS as f32;
        let step = Rect::from_x_y_ranges(edge(k)..=edge(k + 1), rect.y_range());
        let color = sign.color((k as f32 + 0.5) / STEPS as f32);
        ui.painter().rect_filled(step, 0.0, color.map(style::color).unwrap_or_default());
    }
}

fn sign(ui: &mut Ui, sign: Sign) {
    let (rect, _) = ui.allocate_exact_size(vec2(LINE, 12.0), Sense::hover());
    match sign {
        Sign::Spot(color) => _ = ui.painter().circle_filled(rect.center(), 4.5, style::color(color)),
        Sign::Line(color, dashed) => {
            let (ends, stroke) = ([rect.left_center(), rect.right_center()], Stroke::new(1.8, style::color(color)));
            if dashed {
                ui.painter().extend(Shape::dashed_line(&ends, stroke, 4.0, 3.0));
            } else {
                ui.painter().line_segment(ends, stroke);
            }
        }
        _ => {}
    }
}

/// Formats a number with at most two decimals.
fn number(most: f32) -> String {
    ((f64::from(most) * 100.0).round() / 100.0).to_string()
}
