//! The velocity space of the selected agent: the figure of `throng explain`, updated live.

use crate::play::RunMoment;
use crate::settings::Settings;
use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions, Window, vec2};
use std::sync::Arc;
use throng::Explanation;
use throng_draw::{Figure, Style, Typeface};

/// The size of the figure, pixels.
const SIZE: (u32, u32) = (1200, 760);

/// The window of the figure.
#[derive(Default)]
pub struct ExplanationWindow {
    drawn: Option<(Arc<Explanation>, bool, TextureHandle)>,
}

impl ExplanationWindow {
    /// Shows the figure while `open`, if there is an explanation.
    pub fn ui(&mut self, ctx: &Context, open: &mut bool, shown: &RunMoment, settings: &Settings, typeface: &Typeface) {
        let Some(why) = shown.explanation.as_ref().filter(|_| *open) else { return };
        let same =
            |(old, dark, _): &(Arc<Explanation>, bool, TextureHandle)| Arc::ptr_eq(old, why) && *dark == settings.dark;
        if !self.drawn.as_ref().is_some_and(same) {
            self.drawn = image(shown, why, settings, typeface)
                .map(|image| (why.clone(), settings.dark, ctx.load_texture("why", image, TextureOptions::LINEAR)));
        }
        let Some((_, _, texture)) = &self.drawn else { return };
        let window = Window::new(format!("Why agent {} moves as it does", why.number));
        window
            .id(eframe::egui::Id::unique("why"))
            .open(open)
            .default_pos([270.0, 60.0])
            .default_size(vec2(620.0, 420.0))
            .resizable(true)
            .show(ctx, |ui| {
                let width = ui.available_width();
                ui.image((texture.id(), vec2(width, width * SIZE.1 as f32 / SIZE.0 as f32)));
            });
    }
}

fn image(shown: &RunMoment, why: &Explanation, settings: &Settings, typeface: &Typeface) -> Option<ColorImage> {
    let (width, height, typeface) = (SIZE.0, SIZE.1, typeface.clone());
    let style = Style { width, height, typeface, theme: settings.theme(), ..Style::said(&shown.scene) };
    let image = Figure::explain(&shown.setting, &shown.frame, why, &style).ok()?.image();
    let size = [image.width() as usize, image.height() as usize];
    Some(ColorImage::from_rgba_unmultiplied(size, image.data()))
}
