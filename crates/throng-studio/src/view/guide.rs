//! The moving camera of a scene. It moves the view until the user does.

use super::eye::Eye;
use super::mode::Mode;
use super::moment::interpolated;
use crate::play::RunMoment;
use glam::Vec2;
use throng_draw::{FilmCamera, Style};
use throng_record::Frame;
use throng_scene::Camera;

/// The camera of a scene, and whether it moves the view.
#[derive(Default)]
pub(super) struct Guide {
    /// The camera in the text of the scene.
    said: Option<Camera>,
    /// The camera, if it moves.
    camera: Option<FilmCamera>,
    /// The eye that the camera led to last; `None` while the user moves the view.
    eye: Option<Eye>,
    /// The time at which the camera waits, seconds.
    waits: Option<f64>,
}

impl Guide {
    /// Takes the camera of a scene that is opened. Returns the camera if the films are not plans.
    pub fn open(&mut self, shown: &RunMoment, size: Vec2) -> Option<FilmCamera> {
        let camera = film_camera(shown, size);
        let said = shown.scene.view.camera.clone();
        *self = Self { said, camera: camera.clone().filter(|camera| !camera.is_still()), ..Self::default() };
        camera
    }

    /// Whether the scene has another camera than the one that was opened.
    pub fn is_outdated(&self, shown: &RunMoment) -> bool {
        self.said != shown.scene.view.camera
    }

    /// Takes the changed camera of the scene. If the user has moved the view, the camera waits for another time. A plan,
    /// and a camera that follows an agent, stay.
    pub fn change(&mut self, shown: &RunMoment, size: Vec2, eye: Eye) {
        let waits = (self.eye.is_none() || self.waits.is_some()).then(|| shown.time());
        self.open(shown, size);
        (self.eye, self.waits) = (Some(eye).filter(|eye| eye.mode() == Mode::Orbit), waits);
    }

    /// Moves the view from now on.
    pub fn begin(&mut self, eye: Eye) {
        (self.eye, self.waits) = (Some(eye), None);
    }

    /// Ends: the user moves the view.
    pub fn end(&mut self) {
        self.eye = None;
    }

    /// Whether the camera moves the view, or will.
    pub fn leads(&self) -> bool {
        self.camera.is_some() && self.eye.is_some()
    }

    /// Moves an eye to the place of the camera, unless another part of the studio or the user has moved it.
    pub fn lead(&mut self, eye: &mut Eye, shown: &RunMoment, share: f32) {
        self.eye = self.eye.filter(|before| before == eye);
        self.waits = self.waits.filter(|time| *time == shown.time());
        let Some(camera) = self.camera.as_mut().filter(|_| self.eye.is_some() && self.waits.is_none()) else { return };
        let (sight, angle) = camera.turn(&Frame { time: shown.time(), ..interpolated(shown, share) });
        eye.look(sight, angle);
    }

    /// Notes the eye at the end of a frame.
    pub fn follow(&mut self, eye: Eye) {
        self.eye = self.eye.map(|_| eye);
    }
}

/// Returns the camera of the films of a scene, `None` for plans.
fn film_camera(shown: &RunMoment, size: Vec2) -> Option<FilmCamera> {
    let [width, height] = size.to_array().map(|side| side.max(1.0) as u32);
    FilmCamera::new(&shown.setting, &Style { width, height, ..Style::said(&shown.scene) }, &shown.first)
}
