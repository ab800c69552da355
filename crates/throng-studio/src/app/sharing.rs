//! Pictures and links.

use super::App;
use crate::{outside, picture, share};
use eframe::egui::Rect;

impl App {
    /// Takes a picture of the next frame, cut to `rect`.
    pub(super) fn picture(&self, rect: Rect) {
        let (ctx, news, name) = (self.ctx.clone(), self.news.0.clone(), self.document.name.clone());
        let unit = ctx.pixels_per_point();
        self.ctx.request_screenshot(move |image| {
            let file = picture::png(&picture::part(&image, rect, unit)).map_err(|error| error.to_string());
            let says = file.and_then(|bytes| outside::hand_over(&name, "png", &bytes));
            // sending fails only after the studio has closed
            let _ = news.send(says.unwrap_or_else(|says| format!("there is no picture: {says}")));
            ctx.request_repaint();
        });
    }

    /// Puts a link to this exact scene into the address, and copies it.
    pub(super) fn share(&mut self) {
        let says = match outside::address(&share::link(&self.document)) {
            Ok(address) => {
                self.ctx.copy_text(address);
                "the address of this scene is copied".into()
            }
            Err(says) => says,
        };
        self.notice = Some(says);
    }
}
