//! The editor of the text: colours, line numbers, and the line of the error.

use crate::document::{Token, tokens};
use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{
    Align, Align2, Color32, FontId, Id, Margin, Rect, Response, Role, TextBuffer, TextEdit, TextStyle, Ui, WidgetInfo,
    pos2,
};

/// The space between a line number and the text, points of the screen.
const GAP: f32 = 8.0;

/// Shows the text, and marks the line `wrong`, counted from 1. Scrolls to this line if `scroll`. Returns the response of
/// the editor.
pub(super) fn code(ui: &mut Ui, text: &mut String, wrong: Option<usize>, scroll: bool) -> Response {
    let font = TextStyle::Monospace.resolve(ui.style());
    let digits = text.lines().count().max(99).to_string().len();
    let gutter = digits as f32 * ui.fonts_mut(|fonts| fonts.glyph_width(&font, '0')) + GAP + 4.0;
    let mut layout = |ui: &Ui, text: &dyn TextBuffer, width: f32| {
        let mut job = coloured(ui, text.as_str(), &font);
        job.wrap.max_width = width;
        ui.fonts_mut(|fonts| fonts.layout_job(job))
    };
    let margin = Margin { left: gutter.min(120.0) as i8, ..Margin::same(4) };
    // a fixed id, so that the field keeps the focus when an error message appears above it
    let edit = TextEdit::multiline(text).id(Id::unique("text of the scene")).code_editor().layouter(&mut layout);
    let shown = edit.margin(margin).desired_width(f32::INFINITY).desired_rows(30).show(ui);
    let response = shown.response.response;
    response.widget_info(|| WidgetInfo::labeled(Role::MultilineTextInput, true, "text of the scene"));
    let (left, visuals, clip) = (response.rect.left(), ui.visuals().clone(), ui.clip_rect());
    let (mut line, mut begins) = (1, true);
    for row in &shown.galley.rows {
        let rect = row.rect().translate(shown.galley_pos.to_vec2());
        let whole = Rect::from_x_y_ranges(response.rect.x_range(), rect.y_range());
        let is_wrong = wrong == Some(line);
        if is_wrong && clip.intersects(whole) {
            ui.painter().rect_filled(whole, 0.0, error(visuals.dark_mode).gamma_multiply(0.16));
        }
        if is_wrong && scroll && begins {
            ui.scroll_to_rect(whole, Some(Align::Center));
        }
        if begins && clip.intersects(whole) {
            let color = if is_wrong { error(visuals.dark_mode) } else { visuals.weak_text_color() };
            let at = pos2(left + gutter - GAP, rect.top());
            ui.painter().text(at, Align2::RIGHT_TOP, line.to_string(), font.clone(), color);
        }
        (line, begins) = if row.ends_with_newline { (line + 1, true) } else { (line, false) };
    }
    response
}

/// Returns the colour of errors.
pub(super) fn error(dark: bool) -> Color32 {
    if dark { Color32::from_rgb(0xf0, 0x8a, 0x80) } else { Color32::from_rgb(0xa8, 0x2c, 0x22) }
}

fn coloured(ui: &Ui, text: &str, font: &FontId) -> LayoutJob {
    let mut job = LayoutJob::default();
    for (range, token) in tokens(text) {
        let format = TextFormat::simple(font.clone(), color(ui, token));
        job.append(&text[range], 0.0, format);
    }
    job
}

/// Returns the colour of a part. Its contrast with the ground of the editor is at least 4.5.
fn color(ui: &Ui, token: Token) -> Color32 {
    let [light, dark] = match token {
        Token::Other => return ui.visuals().text_color(),
        Token::Comment => [0x66_6b_70, 0x9a_a0_a6],
        Token::Table => [0x8a_2f_6b, 0xe0_9a_c8],
        Token::Key => [0x2a_55_a5, 0x8f_b4_ff],
        Token::String => [0x2c_6a_45, 0x95_d0_a4],
        Token::Number => [0x8f_4a_08, 0xe6_b1_7e],
    };
    let [_, r, g, b] = u32::to_be_bytes(if ui.visuals().dark_mode { dark } else { light });
    Color32::from_rgb(r, g, b)
}
