//! The style of the panels. It uses the colours of the pictures.

use eframe::egui::style::Spacing;
use eframe::egui::{Color32, Context, CornerRadius, FontFamily, FontId, Shadow, Stroke, TextStyle, Visuals};
use throng_draw::{Color, Theme};

/// Converts a colour of pictures to a colour of panels.
pub fn color(color: Color) -> Color32 {
    Color32::from_rgba_unmultiplied(color.r, color.g, color.b, color.a)
}

/// Returns the background of the panels, a little lighter than the ground.
pub fn panel(theme: &Theme) -> Color {
    theme.ground.mix(Color::rgb(0xffffff), if theme.text.r > theme.ground.r { 0.04 } else { 0.55 })
}

/// Applies the colours of a theme to the panels. On a touch screen, buttons are larger.
pub fn apply(ctx: &Context, theme: &Theme, dark: bool, touch: bool) {
    let mut visuals = if dark { Visuals::dark() } else { Visuals::light() };
    let accent = theme.palette[0];
    let line = Stroke::new(1.0, color(theme.edge.alpha(0.35)));
    let (panel, raised) = (color(panel(theme)), color(theme.outside));
    visuals.panel_fill = panel;
    visuals.window_fill = panel;
    visuals.window_stroke = line;
    visuals.weak_text_color = Some(color(theme.quiet));
    visuals.window_shadow = Shadow { offset: [0, 4], blur: 18, spread: 0, color: Color32::from_black_alpha(40) };
    visuals.extreme_bg_color = if dark { color(theme.outside) } else { Color32::WHITE };
    visuals.faint_bg_color = raised;
    visuals.selection.bg_fill = color(accent.alpha(if dark { 0.55 } else { 0.22 }));
    visuals.selection.stroke = Stroke::new(1.0, color(if dark { theme.text } else { accent }));
    visuals.hyperlink_color = color(accent.legible(&[self::panel(theme)], theme.text, 4.5));
    let widgets = &mut visuals.widgets;
    for widget in [
        &mut widgets.noninteractive,
        &mut widgets.inactive,
        &mut widgets.hovered,
        &mut widgets.active,
        &mut widgets.open,
    ] {
        widget.corner_radius = CornerRadius::same(5);
        widget.expansion = 0.0;
        widget.bg_stroke = Stroke::NONE;
        widget.fg_stroke = Stroke::new(1.0, color(theme.text));
        widget.weak_bg_fill = raised;
        widget.bg_fill = raised;
    }
    widgets.noninteractive.bg_stroke = line;
    widgets.noninteractive.fg_stroke = Stroke::new(1.0, color(theme.text));
    widgets.inactive.weak_bg_fill = Color32::TRANSPARENT;
    widgets.hovered.weak_bg_fill = color(theme.obstacle.alpha(0.6));
    widgets.hovered.bg_fill = color(theme.obstacle);
    widgets.active.weak_bg_fill = color(theme.obstacle);
    widgets.active.bg_fill = color(theme.edge);
    ctx.set_visuals(visuals);
    ctx.all_styles_mut(|style| {
        style.spacing.item_spacing = [8.0, 5.0].into();
        let usual = Spacing::default();
        style.spacing.button_padding = if touch { [10.0, 11.0] } else { [8.0, 4.0] }.into();
        style.spacing.interact_size.y = if touch { 40.0 } else { usual.interact_size.y };
        style.spacing.icon_width = if touch { 22.0 } else { usual.icon_width };
        style.interaction.selectable_labels = false;
        let sizes =
            [(TextStyle::Heading, 18.0), (TextStyle::Body, 14.0), (TextStyle::Button, 14.0), (TextStyle::Small, 14.0)];
        for (text, size) in sizes {
            style.text_styles.insert(text, FontId::new(size, FontFamily::Proportional));
        }
        style.text_styles.insert(TextStyle::Monospace, FontId::new(14.0, FontFamily::Monospace));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_type_is_smaller_than_14_points() {
        let ctx = Context::default();
        apply(&ctx, &Theme::light(), false, false);
        assert!(ctx.global_style().text_styles.values().all(|font| font.size >= 14.0));
    }
}
