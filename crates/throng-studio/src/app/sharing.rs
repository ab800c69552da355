//! Pictures and links.

use super::App;
use crate::Options;
use crate::face::Face;
use crate::keep::Leaving;
use crate::opened::Opened;
use crate::play::RunMoment;
use crate::share::{self, Seen};
use crate::view::FirstView;
use crate::{outside, picture};
use eframe::egui::Rect;
use glam::Vec2;

/// What an address asks for, until the run of its scene is there.
pub(super) struct Visit {
    /// The run before.
    before: u64,
    view: FirstView,
}

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

    /// Puts a link to exactly this view into the address, and copies it.
    pub(super) fn share(&mut self, shown: Option<&RunMoment>) {
        let eye = &self.views[0].eye;
        let size = Vec2::new(self.place.width(), self.place.height());
        let seen = |shown: &RunMoment| Seen {
            step: shown.step,
            selected: self.views[0].selected,
            camera: (eye.mode(), eye.pose(size)),
            settings: &self.settings,
        };
        let link = match shown {
            Some(shown) => share::link_of(&self.document, &seen(shown)),
            None => share::link(&self.document),
        };
        let says = match outside::address(&link) {
            Ok(address) => {
                self.ctx.copy_text(address);
                "the address of this view is copied".into()
            }
            Err(says) => says,
        };
        self.notice = Some(says);
    }

    /// Shows what a new address of the open page says: the part after `#`.
    pub(super) fn visit(&mut self, address: &str, run: u64) {
        let options = Options::of_address(address);
        let own = self.opened.own(&self.settings);
        let mut settings = own.clone();
        let options = options.and_then(|options| options.adjust(&mut settings).map(|()| options));
        let options = match options {
            Ok(options) => options,
            Err(says) => return self.notice = Some(says),
        };
        (self.settings, self.opened) = (settings, Opened::new(&options.with));
        self.set_speed(self.settings.speed);
        self.put_beside();
        let none = if options.scene.is_none() { Face::Start } else { Face::Studio };
        self.turn_to(options.face.unwrap_or(none));
        self.still = options.at_step;
        self.visit = Some(Visit { before: run, view: options.first_view() });
        if let Some(scene) = options.scene {
            self.leave(Leaving::Open(scene));
        }
    }

    /// Begins the views as the address says, once the run of its scene is there.
    pub(super) fn arrive(&mut self, run: u64) {
        if let Some(visit) = self.visit.take_if(|visit| visit.before != run) {
            self.views.iter_mut().for_each(|view| view.begin(visit.view.clone()));
        }
    }
}
