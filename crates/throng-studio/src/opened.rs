//! The settings that the `[view]` of a scene gives when the scene is opened.

use crate::settings::Settings;
use crate::view::Streams;
use std::sync::Arc;
use throng_draw::{FlowLayer, Style};
use throng_scene::{DrawnFields, Scene};

/// The settings that a scene can give.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Given {
    trails: f32,
    streams: Streams,
    stream_speed: bool,
}

impl Given {
    fn of(settings: &Settings) -> Self {
        let layers = &settings.layers;
        Self { trails: settings.trails, streams: layers.streams, stream_speed: layers.stream_speed }
    }

    fn put_into(self, settings: &mut Settings) {
        settings.trails = self.trails;
        (settings.layers.streams, settings.layers.stream_speed) = (self.streams, self.stream_speed);
    }

    /// Returns these settings, and those of `own` where the user has not changed what the scene gave.
    fn unless(self, given: Self, own: Self) -> Self {
        Self {
            trails: if self.trails == given.trails { own.trails } else { self.trails },
            streams: if self.streams == given.streams { own.streams } else { self.streams },
            stream_speed: if self.stream_speed == given.stream_speed { own.stream_speed } else { self.stream_speed },
        }
    }
}

/// The opened scene, and the settings that it gave. The user's changes take precedence, and the user's own settings return
/// with the next scene.
#[derive(Clone, Debug, Default)]
pub struct Opened {
    /// The name of the scene, and the keys of its `[view]` that settings follow.
    of: Option<(Arc<str>, Option<f64>, DrawnFields)>,
    /// The settings of the user and of the scene, when the scene was opened.
    own: Option<(Given, Given)>,
    /// The settings that the start options give; scenes do not change them.
    fixed: Vec<String>,
}

impl Opened {
    /// Creates it for a studio that was started with these settings, `key=value`.
    pub fn new(with: &[String]) -> Self {
        let key = |said: &String| said.split_once('=').map_or_else(|| said.clone(), |(key, _)| key.to_owned());
        Self { fixed: with.iter().map(key).collect(), ..Self::default() }
    }

    /// Gives the settings of a scene when it is opened, and when its `[view]` gives others.
    pub fn open(&mut self, name: &Arc<str>, scene: &Scene, settings: &mut Settings) {
        let of = Some((name.clone(), scene.view.trails, scene.view.field.clone()));
        if self.of == of {
            return;
        }
        self.of = of;
        *settings = self.own(settings);
        let own = Given::of(settings);
        let (mut given, is_free) = (own, |key: &str| !self.fixed.iter().any(|fixed| fixed == key));
        if let Some(seconds) = scene.view.trails.filter(|_| is_free("trails")) {
            given.trails = seconds as f32;
        }
        if let Some(flow) = Style::said(scene).flow {
            let has = |layer: FlowLayer| flow.layers.contains(&layer);
            if is_free("layers.streams") {
                given.streams = match has(FlowLayer::Arrows) && !has(FlowLayer::Streamlines) {
                    true => Streams::Arrows,
                    false if has(FlowLayer::Streamlines) || has(FlowLayer::Lic) => Streams::Lines,
                    false => Streams::None,
                };
            }
            if is_free("layers.stream_speed") {
                given.stream_speed = has(FlowLayer::Speed);
            }
        }
        given.put_into(settings);
        self.own = Some((own, given));
    }

    /// Returns the user's own settings: those that the scene did not give, or that the user has changed since.
    pub fn own(&self, settings: &Settings) -> Settings {
        let mut all = settings.clone();
        if let Some((own, given)) = self.own {
            Given::of(settings).unless(given, own).put_into(&mut all);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(view: &str) -> Scene {
        Scene::parse("scene.toml", format!("[[group]]\nplace.point = [0, 0]\ngoal.point = [5, 0]\n[view]\n{view}"))
            .unwrap()
    }

    #[test]
    fn a_scene_gives_its_trails_and_fields_and_the_user_changes_them() {
        let (mut settings, mut opened) = (Settings::default(), Opened::new(&[]));
        let usual = settings.clone();
        let flows = scene("trails = 4.0\nfield = [\"arrows\", \"speed\"]");
        opened.open(&"a".into(), &flows, &mut settings);
        let layers = settings.layers;
        assert_eq!((settings.trails, layers.streams, layers.stream_speed), (4.0, Streams::Arrows, true));
        assert_eq!(opened.own(&settings), usual, "what is kept are the settings of the user");
        settings.trails = 0.0;
        opened.open(&"a".into(), &flows, &mut settings);
        assert_eq!(settings.trails, 0.0, "the user's change stays");
        opened.open(&"b".into(), &scene(""), &mut settings);
        assert_eq!(settings, Settings { trails: 0.0, ..usual.clone() }, "and the scene's settings end with the scene");
        opened.open(&"c".into(), &scene("field = true"), &mut settings);
        assert_eq!((settings.layers.streams, settings.trails), (Streams::Lines, 0.0));
    }

    #[test]
    fn settings_follow_the_text() {
        let (mut settings, mut opened) = (Settings::default(), Opened::new(&[]));
        let usual = settings.clone();
        for (view, trails) in [("", 1.5), ("trails = 4.0", 4.0), ("trails = 0.5", 0.5), ("", 1.5)] {
            opened.open(&"a".into(), &scene(view), &mut settings);
            assert_eq!(settings, Settings { trails, ..usual.clone() }, "{view}");
        }
    }

    #[test]
    fn start_options_take_precedence() {
        let (mut settings, mut opened) =
            (Settings { trails: 0.5, ..Settings::default() }, Opened::new(&["trails=0.5".into()]));
        opened.open(&"a".into(), &scene("trails = 4.0"), &mut settings);
        assert_eq!(settings.trails, 0.5);
    }
}
